//! Reports on a fit: text, JSON, warnings.

use std::fmt::Write as _;

use lagrangian_fit::combinations::CombinationForm;
use lagrangian_fit::motion::{Derivatives, Subject};
use lagrangian_fit::searches::{Search, Sigmas};
use lagrangian_fit::statistics::Standing;
use lagrangian_spec::unit::state_of;
use serde_json::{Value, json};

use super::Fitted;
use crate::numbers::shortest;

/// Numbers with a greater correlation than this can hardly be distinguished.
const STRONG: f64 = 0.99;

/// A sum of squares as improbable as a deviation of this many standard deviations is reported.
const IMPROBABLE: f64 = 5.0;

/// The most columns of correlations that are printed.
const MOST_COLUMNS: usize = 8;

/// Warnings about a result.
pub fn warnings(result: &Fitted<'_, '_>) -> Vec<String> {
    let statistics = &result.found.statistics;
    let names: Vec<&str> = result
        .fit
        .sought
        .iter()
        .map(|one| one.name.as_str())
        .collect();
    let list = |standing: Standing| -> Vec<String> {
        let of_standing = (0..names.len()).filter(|j| statistics.standing[*j] == standing);
        of_standing.map(|j| format!("`{}`", names[j])).collect()
    };
    let mut warnings = Vec::new();
    let ineffective = list(Standing::Ineffective);
    if !ineffective.is_empty() {
        let values = match ineffective.len() {
            1 => "its value is",
            _ => "their values are",
        };
        warnings.push(format!(
            "the measurements do not depend on {}; {values} where the search began",
            ineffective.join(", ")
        ));
    }
    let entangled = list(Standing::Entangled);
    if !entangled.is_empty() {
        let all: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        let determined: Vec<String> = result
            .found
            .combinations
            .iter()
            .map(|combination| combination.formula(&all))
            .collect();
        let determined = if determined.is_empty() {
            "no combination of them is".to_owned()
        } else {
            format!(
                "only {} {}",
                determined.join(", "),
                if determined.len() == 1 { "is" } else { "are" }
            )
        };
        warnings.push(format!(
            "{} cannot be told apart: {determined} determined by these measurements",
            entangled.join(", ")
        ));
    }
    let bound = list(Standing::Bound);
    if !bound.is_empty() {
        warnings.push(format!(
            "{} stayed at a bound, beyond which the sum of squares decreases",
            bound.join(", ")
        ));
    }
    for (j, second) in names.iter().enumerate() {
        for (k, first) in names.iter().enumerate().take(j) {
            let strong = statistics.correlation(j, k);
            if let Some(rho) = strong.filter(|rho| rho.abs() > STRONG) {
                warnings.push(format!(
                    "`{first}` and `{second}` can hardly be told apart: their correlation is {rho:.4}"
                ));
            }
        }
    }
    let freedom = statistics.freedom as f64;
    let off = statistics.chi_squared - freedom;
    if result.sigmas == Sigmas::Given
        && freedom > 0.0
        && off.abs() > IMPROBABLE * (2.0 * freedom).sqrt()
    {
        warnings.push(format!(
            "residuals are {:.3} times what --sigma implies: the standard errors are based on --sigma, and are valid only if it is",
            statistics.variance.sqrt()
        ));
    }
    warnings
}

/// A number with as many digits as its standard error justifies: up to two digits of the error.
fn rounded(value: f64, error: Option<f64>) -> (String, String) {
    let Some(error) = error.filter(|error| error.is_finite() && *error > 0.0) else {
        return (significant(value), String::new());
    };
    let place = error.log10().floor() as i32 - 1;
    let size = value.abs().max(error);
    // If the error is nearly zero, the number of digits is limited.
    let place = place.max(size.log10().floor() as i32 - 12);
    if (-6..=6).contains(&(size.log10().floor() as i32)) {
        let digits = usize::try_from(-place).unwrap_or(0);
        let shown = if place > 0 {
            let unit = 10_f64.powi(place);
            ((value / unit).round() * unit, (error / unit).round() * unit)
        } else {
            (value, error)
        };
        let error = if shown.1 < 10_f64.powi(place) {
            format!("{error:.1e}")
        } else {
            format!("{:.digits$}", shown.1)
        };
        (format!("{:.digits$}", shown.0), error)
    } else {
        let digits = usize::try_from(size.log10().floor() as i32 - place).unwrap_or(1);
        (format!("{value:.digits$e}"), format!("{error:.1e}"))
    }
}

/// A number with seven digits.
fn significant(value: f64) -> String {
    let text = format!("{value:.6e}");
    text.parse::<f64>().map_or(text, shortest)
}

fn in_unit(text: &str, unit: &str) -> String {
    match unit {
        "1" | "" => text.to_owned(),
        unit => format!("{text} {unit}"),
    }
}

/// The text of a result.
pub fn text(result: &Fitted<'_, '_>) -> String {
    let statistics = &result.found.statistics;
    let minimum = &result.found.minimum;
    let sought = &result.fit.sought;
    let mut text = String::new();
    let files: Vec<&str> = result
        .given
        .iter()
        .map(|given| given.label.as_str())
        .collect();
    let classes: Vec<&str> = result
        .classes
        .iter()
        .map(|class| class.name.as_str())
        .collect();
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "{}: {} fitted to {} measurements of {} in {}",
        lagrangian::Machine::name(result.machine),
        sought.len(),
        statistics.measurements,
        classes.join(", "),
        files.join(", ")
    );
    let derivatives = match (result.found.derivatives, result.fit.derivatives().1) {
        (Derivatives::Integrated, _) => "derivatives integrated with the motion".to_owned(),
        (Derivatives::Differences, why) => {
            format!(
                "derivatives by finite differences of runs, since {}",
                why.unwrap_or_default()
            )
        }
    };
    let _ = writeln!(text, "  {derivatives}");
    let _ = writeln!(
        text,
        "  {} steps, {} evaluations: the search {}",
        minimum.steps,
        minimum.evaluations,
        minimum.ending.words()
    );
    if result.searches.len() > 1 {
        text.push_str(&searches(result));
    }
    text.push_str(&values(result));
    if !result.found.combinations.is_empty() {
        text.push_str(&combinations(result));
    }
    text.push_str(&residuals(result));
    text.push_str(&correlations(result));
    text.push_str(&options(result));
    text
}

/// The fitted values with their standard errors.
fn values(result: &Fitted<'_, '_>) -> String {
    let minimum = &result.found.minimum;
    let rows = result.fit.sought.iter().enumerate().map(|(j, one)| {
        let error = result.found.statistics.standard_error(j);
        let (value, shown) = rounded(minimum.x[j], error);
        let note = standing(result, j, &shown);
        (one.name.clone(), in_unit(&value, &one.unit), note)
    });
    let rows: Vec<(String, String, String)> = rows.collect();
    let width = |of: fn(&(String, String, String)) -> &String| {
        let lengths = rows.iter().map(|row| of(row).chars().count());
        lengths.max().unwrap_or(0)
    };
    let (of_names, of_values) = (width(|row| &row.0), width(|row| &row.1));
    let mut text = String::from("  fitted, with standard errors\n");
    for (name, value, note) in &rows {
        let _ = writeln!(text, "    {name:of_names$} = {value:of_values$}  {note}");
    }
    text
}

/// The standard error of a value, of which `shown` are the digits, or why there is none.
fn standing(result: &Fitted<'_, '_>, j: usize, shown: &str) -> String {
    let statistics = &result.found.statistics;
    match (statistics.standing[j], statistics.standard_error(j)) {
        (Standing::Estimated, Some(_)) if shown.is_empty() => "± 0".to_owned(),
        (Standing::Estimated, Some(error)) => {
            let share = (error / result.found.minimum.x[j]).abs();
            if share.is_finite() && share > 0.0 {
                format!("± {shown}   ({})", percent(share))
            } else {
                format!("± {shown}")
            }
        }
        (Standing::Bound, _) => "at its bound".to_owned(),
        (Standing::Ineffective, _) => "has no effect".to_owned(),
        _ => "not determined separately".to_owned(),
    }
}

/// The result as options of `simulate`.
fn options(result: &Fitted<'_, '_>) -> String {
    let mut text = String::from("  as options of simulate\n   ");
    for (one, x) in result.fit.sought.iter().zip(&result.found.minimum.x) {
        let (option, name) = match one.subject {
            Subject::Parameter(_) => ("--set", one.name.clone()),
            Subject::Start(e, place) if result.given.len() == 1 => {
                ("--start", coordinate(result, e, place))
            }
            Subject::Rate(e, place) if result.given.len() == 1 => {
                let name = coordinate(result, e, place);
                match state_of(&name) {
                    Some(state) => ("--start", state),
                    None => ("--rate", name),
                }
            }
            _ => continue,
        };
        let _ = write!(text, " {option} {name}={}", shortest(*x));
    }
    text.push('\n');
    text
}

/// The name of a coordinate.
pub fn coordinate(result: &Fitted<'_, '_>, experiment: usize, place: usize) -> String {
    let start = lagrangian::Machine::start(&result.fit.experiments[experiment].machine);
    let name = start.q.iter().nth(place).map(|(name, _)| name.to_owned());
    name.unwrap_or_default()
}

fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    match percent {
        _ if percent >= 10.0 => format!("{percent:.0} %"),
        _ if percent >= 0.01 => {
            let digits = (1 - percent.log10().floor() as i32).clamp(0, 4) as usize;
            format!("{percent:.digits$} %")
        }
        _ => format!("{share:.0e} of the value"),
    }
}

fn searches(result: &Fitted<'_, '_>) -> String {
    let last = |search: &Search| match &search.end {
        Ok(minimum) if minimum.ending.is_minimum() => minimum.sums.last().copied(),
        _ => None,
    };
    let count = result.searches.len();
    let ends: Vec<f64> = result.searches.iter().filter_map(last).collect();
    let least = ends.iter().copied().fold(f64::INFINITY, f64::min);
    let same = ends
        .iter()
        .filter(|sum| **sum <= least * (1.0 + 1e-6))
        .count();
    let other = ends
        .iter()
        .copied()
        .filter(|sum| *sum > least * (1.0 + 1e-6));
    let next = other.fold(f64::INFINITY, f64::min);
    let next = if next.is_finite() {
        format!(
            "; the next minimum has {:.3} times its sum of squares",
            next / least
        )
    } else {
        String::new()
    };
    format!(
        "  {} of {count} searches ended in a minimum, {same} of them in this one{next}\n",
        ends.len()
    )
}

fn combinations(result: &Fitted<'_, '_>) -> String {
    let sought = &result.fit.sought;
    let names: Vec<String> = sought.iter().map(|one| one.name.clone()).collect();
    let units: Vec<String> = sought.iter().map(|one| one.unit.clone()).collect();
    let x = &result.found.minimum.x;
    let mut text = String::from("  combinations that are determined\n");
    for combination in &result.found.combinations {
        let error = result
            .found
            .statistics
            .standard_error_of(&combination.gradient(x));
        let (value, error) = rounded(combination.value(x), Some(error));
        let unit = combination.unit(&units).unwrap_or_default();
        let local = match combination.kind {
            CombinationForm::Local => "   (for small changes)",
            CombinationForm::Product | CombinationForm::Sum => "",
        };
        let _ = writeln!(
            text,
            "    {} = {}  ± {error}{local}",
            combination.formula(&names),
            in_unit(&value, &unit)
        );
    }
    text
}

/// The root mean square of the residuals of each column, in its unit.
fn roots(result: &Fitted<'_, '_>) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0_f64); result.classes.len()];
    let mut residuals = result.found.minimum.residuals.iter();
    for experiment in &result.fit.experiments {
        for column in &experiment.columns {
            for _ in column.values.iter().flatten() {
                let r = residuals.next().copied().unwrap_or(0.0) * result.fit.sigmas[column.sigma];
                sums[column.sigma].0 += r * r;
                sums[column.sigma].1 += 1.0;
            }
        }
    }
    sums.iter()
        .map(|(sum, count)| (sum / count).sqrt())
        .collect()
}

fn residuals(result: &Fitted<'_, '_>) -> String {
    let statistics = &result.found.statistics;
    let mut text = String::from("  residuals, root mean square\n");
    for (place, (class, root)) in result.classes.iter().zip(roots(result)).enumerate() {
        let sigma = match result.sigmas {
            Sigmas::Equal => String::new(),
            Sigmas::Given => format!(
                ", standard deviation {} given",
                in_unit(&shortest(result.fit.sigmas[place]), &class.unit)
            ),
            Sigmas::Estimated => format!(
                ", standard deviation {} estimated",
                in_unit(&significant(result.fit.sigmas[place]), &class.unit)
            ),
        };
        let root = in_unit(&format!("{root:.3e}"), &class.unit);
        let _ = writeln!(text, "    {}: {root}{sigma}", class.name);
    }
    let freedom = statistics.freedom;
    let _ = match result.sigmas {
        Sigmas::Equal => writeln!(
            text,
            "    standard deviation {} over {freedom} degrees of freedom, on which the standard errors are based",
            in_unit(
                &format!("{:.3e}", statistics.variance.sqrt()),
                &result.classes[0].unit
            )
        ),
        _ => writeln!(
            text,
            "    χ² = {} over {freedom} degrees of freedom",
            significant(statistics.chi_squared)
        ),
    };
    text
}

fn correlations(result: &Fitted<'_, '_>) -> String {
    let statistics = &result.found.statistics;
    let estimated: Vec<usize> = (0..result.fit.sought.len())
        .filter(|j| statistics.standing[*j] == Standing::Estimated)
        .collect();
    if estimated.len() < 2 {
        return String::new();
    }
    if estimated.len() > MOST_COLUMNS {
        return "  correlations: with --json\n".to_owned();
    }
    let name = |j: usize| result.fit.sought[j].name.as_str();
    let wide = estimated
        .iter()
        .map(|j| name(*j).chars().count())
        .max()
        .unwrap_or(0);
    let mut text = String::from("  correlations\n");
    for (row, j) in estimated.iter().enumerate() {
        let pad = " ".repeat(wide - name(*j).chars().count());
        let _ = write!(text, "    {}{pad}", name(*j));
        for k in &estimated[..=row] {
            let rho = statistics.correlation(*j, *k).unwrap_or(f64::NAN);
            let _ = write!(text, "  {rho:>7.4}");
        }
        text.push('\n');
    }
    text
}

/// The result as JSON.
pub fn document(result: &Fitted<'_, '_>) -> Value {
    let statistics = &result.found.statistics;
    let minimum = &result.found.minimum;
    let count = result.fit.sought.len();
    let matrix = |entry: &dyn Fn(usize, usize) -> Option<f64>| -> Vec<Vec<Option<f64>>> {
        (0..count)
            .map(|j| (0..count).map(|k| entry(j, k)).collect())
            .collect()
    };
    let covariance = matrix(&|j, k| {
        statistics.correlation(j, k)?;
        Some(statistics.covariance[(j, k)])
    });
    json!({
        "machine": lagrangian::Machine::name(result.machine),
        "converged": minimum.ending.is_minimum(),
        "ending": minimum.ending.words(),
        "steps": minimum.steps,
        "evaluations": minimum.evaluations,
        "runs": result.fit.runs[0],
        "runs_with_derivatives": result.fit.runs[1],
        "derivatives": match result.found.derivatives {
            Derivatives::Integrated => "integrated",
            Derivatives::Differences => "differences",
        },
        "fitted": fitted_as_json(result),
        "covariance": covariance,
        "correlation": matrix(&|j, k| statistics.correlation(j, k)),
        "combinations": combinations_as_json(result),
        "measurements": statistics.measurements,
        "degrees_of_freedom": statistics.freedom,
        "chi_squared": statistics.chi_squared,
        "variance": Some(statistics.variance).filter(|it| it.is_finite()),
        "sigma": match result.sigmas {
            Sigmas::Equal => "equal",
            Sigmas::Given => "given",
            Sigmas::Estimated => "estimated",
        },
        "columns": columns_as_json(result),
        "singular_values": statistics.singular_values,
        "sums": minimum.sums,
        "searches": searches_as_json(result),
        "warnings": result.warnings,
    })
}

/// The fitted numbers, as JSON.
fn fitted_as_json(result: &Fitted<'_, '_>) -> Vec<Value> {
    let statistics = &result.found.statistics;
    let minimum = &result.found.minimum;
    let sought = &result.fit.sought;
    let standing = |standing: Standing| match standing {
        Standing::Estimated => "estimated",
        Standing::Bound => "bound",
        Standing::Ineffective => "ineffective",
        Standing::Entangled => "entangled",
    };
    let finite = |x: f64| x.is_finite().then_some(x);
    sought
        .iter()
        .enumerate()
        .map(|(j, one)| {
            let experiment = match one.subject {
                Subject::Parameter(_) => None,
                Subject::Start(e, _) | Subject::Rate(e, _) => Some(result.given[e].label.clone()),
            };
            json!({
                "name": one.name,
                "experiment": experiment,
                "unit": one.unit,
                "value": minimum.x[j],
                "standard_error": statistics.standard_error(j),
                "standing": standing(statistics.standing[j]),
                "from": result.searches[result.best].from[j],
                "bounds": one.bounds.map(finite),
            })
        })
        .collect()
}

/// The measured quantities with their residuals, as JSON.
fn columns_as_json(result: &Fitted<'_, '_>) -> Vec<Value> {
    result
        .classes
        .iter()
        .zip(roots(result))
        .enumerate()
        .map(|(place, (class, root))| {
            json!({
                "name": class.name,
                "unit": class.unit,
                "residual": root,
                "sigma": (result.sigmas != Sigmas::Equal).then(|| result.fit.sigmas[place]),
            })
        })
        .collect()
}

/// The combinations of numbers that the data determine better than the numbers themselves, as JSON.
fn combinations_as_json(result: &Fitted<'_, '_>) -> Vec<Value> {
    let statistics = &result.found.statistics;
    let minimum = &result.found.minimum;
    let sought = &result.fit.sought;
    let names: Vec<String> = sought.iter().map(|one| one.name.clone()).collect();
    let units: Vec<String> = sought.iter().map(|one| one.unit.clone()).collect();
    result
        .found
        .combinations
        .iter()
        .map(|combination| {
            json!({
                "formula": combination.formula(&names),
                "kind": match combination.kind {
                    CombinationForm::Product => "product",
                    CombinationForm::Sum => "sum",
                    CombinationForm::Local => "local",
                },
                "unit": combination.unit(&units),
                "value": combination.value(&minimum.x),
                "standard_error": statistics.standard_error_of(&combination.gradient(&minimum.x)),
                "terms": combination.terms.iter().map(|(j, c)| json!({"name": names[*j], "factor": c})).collect::<Vec<_>>(),
            })
        })
        .collect()
}

/// The searches from all starts, as JSON.
fn searches_as_json(result: &Fitted<'_, '_>) -> Vec<Value> {
    result
        .searches
        .iter()
        .map(|search| match &search.end {
            Ok(minimum) => json!({
                "from": search.from,
                "value": minimum.x,
                "sum": minimum.sums.last(),
                "converged": minimum.ending.is_minimum(),
            }),
            Err(why) => json!({"from": search.from, "error": why}),
        })
        .collect()
}
