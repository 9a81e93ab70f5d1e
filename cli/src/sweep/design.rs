//! The design of a sweep in a call: `--vary`, `--together`, `--samples`, `--table`.

use std::path::Path;

use lagrangian_spec::model::Model;
use lagrangian_spec::token::normalized;
use lagrangian_sweep::design::{Distribution, Factor, Sampling};
use lagrangian_sweep::unit_of;

use crate::call::{self, Assignment, Design};
use crate::failure::Failure;
use crate::runs;

/// The most values that one option lists.
const MOST_LISTED: usize = 1_000_000;

/// A parsed `--vary`.
enum Varied {
    Fixed(Factor),
    Sampled(String, Distribution),
}

/// The factors of a call, in the order of its options.
///
/// # Errors
/// If the call is invalid.
pub fn factors(call: &call::Sweep, model: &Model<'_>) -> Result<Vec<Factor>, Failure> {
    if let Some(path) = &call.table {
        if !call.vary.is_empty() || call.samples.is_some() || !call.together.is_empty() {
            return Err(Failure::Call(
                "--table lists all runs, one in each row: nothing else can be varied".into(),
            ));
        }
        return Ok(vec![listed(path, model)?]);
    }
    let mut factors: Vec<Factor> = Vec::new();
    let mut drawn: Option<usize> = None;
    for text in &call.vary {
        match varied(text, model).map_err(|why| Failure::Call(format!("--vary {text}: {why}")))? {
            Varied::Fixed(factor) => factors.push(factor),
            Varied::Sampled(name, distribution) => {
                let Some(count) = call.samples else {
                    return Err(Failure::Call(format!(
                        "--vary {text}: give the number of values by --samples N, or a grid {name}=FROM..TO:N"
                    )));
                };
                let place = *drawn.get_or_insert_with(|| {
                    factors.push(Factor::Sample {
                        design: match call.design.unwrap_or(Design::Sobol) {
                            Design::Random => Sampling::Random,
                            Design::Latin => Sampling::Latin,
                            Design::Sobol => Sampling::Sobol,
                        },
                        count,
                        seed: call.seed.unwrap_or(0),
                        variables: Vec::new(),
                    });
                    factors.len() - 1
                });
                if let Some(Factor::Sample { variables, .. }) = factors.get_mut(place) {
                    variables.push((name, distribution));
                }
            }
        }
    }
    if drawn.is_none() {
        refuse_sampling(call)?;
    }
    for group in &call.together {
        together(&mut factors, group)
            .map_err(|why| Failure::Call(format!("--together {group}: {why}")))?;
    }
    Ok(factors)
}

/// The values of a table, one run in each row.
fn listed(path: &Path, model: &Model<'_>) -> Result<Factor, Failure> {
    let (headings, mut rows) = super::numbers(path)?;
    let names: Vec<String> = headings
        .iter()
        .map(|(name, _)| normalized(name).into_owned())
        .collect();
    let shown = path.display();
    for (column, (name, (_, written))) in names.iter().zip(&headings).enumerate() {
        let wrong = |why: String| Failure::Call(format!("--table {shown}: column `{name}`: {why}"));
        let unit = unit_of(model, name).map_err(wrong)?;
        // Runs have values in the units that the spec declares.
        if let Some(written) = written {
            let factor = runs::factor(written, &unit)
                .ok_or_else(|| wrong(format!("expected a unit like {unit}, found {written}")))?;
            for row in &mut rows {
                row[column] *= factor;
            }
        }
    }
    if rows.len() > MOST_LISTED {
        return Err(Failure::Call(format!(
            "--table {shown}: more than {MOST_LISTED} rows"
        )));
    }
    if let Some(row) = rows
        .iter()
        .position(|row| row.iter().any(|value| !value.is_finite()))
    {
        return Err(Failure::Call(format!(
            "--table {shown}: row {row} contains something that is not a finite number"
        )));
    }
    Ok(Factor::List { names, rows })
}

/// Refuses the options of sampling where nothing is sampled.
fn refuse_sampling(call: &call::Sweep) -> Result<(), Failure> {
    let options = [
        ("--samples", call.samples.is_some()),
        ("--design", call.design.is_some()),
        ("--seed", call.seed.is_some()),
    ];
    match options.iter().find(|(_, is_given)| *is_given) {
        Some((option, _)) => Err(Failure::Call(format!(
            "{option}: nothing is sampled; --vary NAME=FROM..TO or NAME~normal(MEAN,DEVIATION) would be"
        ))),
        None => Ok(()),
    }
}

/// Joins factors that vary together, at the place of the first of them.
fn together(factors: &mut Vec<Factor>, group: &str) -> Result<(), String> {
    let names: Vec<String> = group
        .split(',')
        .map(|name| normalized(name.trim()).into_owned())
        .collect();
    let mut parts = Vec::new();
    let mut place = None;
    for name in &names {
        let found = factors
            .iter()
            .position(|factor| factor.names() == [name.as_str()]);
        let found = found.ok_or_else(|| format!("`{name}` is not varied by a list or a grid"))?;
        if matches!(factors[found], Factor::Sample { .. }) {
            return Err(format!(
                "`{name}` is sampled, together with all other sampled values"
            ));
        }
        let at = *place.get_or_insert(found);
        parts.push(factors.remove(found));
        if found < at {
            place = Some(at - 1);
        }
    }
    let counts: Vec<u64> = parts.iter().map(Factor::count).collect();
    if counts.windows(2).any(|pair| pair[0] != pair[1]) || parts.len() < 2 {
        let each = names
            .iter()
            .zip(&counts)
            .map(|(name, count)| format!("{name} has {count}"));
        let each: Vec<String> = each.collect();
        return Err(format!(
            "expected two or more names with equal numbers of values; {}",
            each.join(", ")
        ));
    }
    let place = place.unwrap_or(0).min(factors.len());
    factors.insert(place, Factor::Together(parts));
    Ok(())
}

/// Reads `NAME=a..b:k`, `NAME=a..b:k:log`, `NAME=v,w`, `NAME=a..b`, `NAME~distribution(…)`.
fn varied(text: &str, model: &Model<'_>) -> Result<Varied, String> {
    let equals = text.find('=').unwrap_or(text.len());
    if let Some((name, distribution)) = text.split_once('~').filter(|(name, _)| name.len() < equals)
    {
        let name = named(name)?;
        let unit = unit_of(model, &name)?;
        let distribution = distribution_of(&name, distribution.trim(), &unit)?;
        return Ok(Varied::Sampled(name, distribution));
    }
    let wanted = "expected NAME=FROM..TO:COUNT, NAME=VALUE,VALUE,… or NAME~uniform(FROM,TO)";
    let (name, values) = text.split_once('=').ok_or(wanted)?;
    let name = named(name)?;
    let unit = unit_of(model, &name)?;
    let value = |text: &str| value(&name, text, &unit);
    let Some((from, rest)) = values.split_once("..") else {
        let listed = arguments(values);
        if listed.len() > MOST_LISTED {
            return Err(format!(
                "more than {MOST_LISTED} values, the maximum for --vary and --table"
            ));
        }
        let rows = listed.iter().map(|text| Ok(vec![value(text)?]));
        let rows = rows.collect::<Result<Vec<_>, String>>()?;
        let names = vec![name.clone()];
        return Ok(Varied::Fixed(Factor::List { names, rows }));
    };
    let from = value(from)?;
    let mut parts = rest.split(':');
    let to = value(parts.next().unwrap_or_default())?;
    let Some(count) = parts.next() else {
        let distribution = Distribution::Uniform(from, to);
        check(distribution)?;
        return Ok(Varied::Sampled(name.clone(), distribution));
    };
    let log = match parts.next().map(str::trim) {
        None => false,
        Some("log") => true,
        Some(other) => {
            return Err(format!(
                "`:{other}` is not a spacing: expected `:log`, or nothing"
            ));
        }
    };
    let count = call::count(count)
        .map_err(|why| format!("`{}` is not a valid number of values: {why}", count.trim()))?;
    if parts.next().is_some() {
        return Err(wanted.into());
    }
    let have_one_sign = from / to > 0.0;
    if log && !have_one_sign {
        return Err(
            "both ends of a geometric grid must have the same sign, and neither may be 0".into(),
        );
    }
    Ok(Varied::Fixed(Factor::Grid {
        name: name.clone(),
        from,
        to,
        count,
        log,
    }))
}

fn named(name: &str) -> Result<String, String> {
    let name: String = name.chars().filter(|c| !c.is_whitespace()).collect();
    if name.is_empty() {
        Err("expected a name first".into())
    } else {
        Ok(normalized(&name).into_owned())
    }
}

fn value(name: &str, text: &str, unit: &str) -> Result<f64, String> {
    let set = Assignment {
        name: name.to_owned(),
        value: text.trim().to_owned(),
    };
    // Errors must mention the whole option.
    let named = format!(" {name}={}: ", set.value);
    set.value("", unit)
        .map_err(|why| why.strip_prefix(&named).unwrap_or(&why).to_owned())
}

/// The parts between commas that are not inside brackets.
fn arguments(text: &str) -> Vec<&str> {
    let mut depth = 0;
    let parts = text.split(|c: char| {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        c == ',' && depth == 0
    });
    parts.collect()
}

fn distribution_of(name: &str, text: &str, unit: &str) -> Result<Distribution, String> {
    let wanted = "expected uniform(FROM,TO), loguniform(FROM,TO), normal(MEAN,DEVIATION) or triangular(FROM,TO,PEAK)";
    let (kind, rest) = text.split_once('(').ok_or(wanted)?;
    let inner = rest.trim_end().strip_suffix(')').ok_or(wanted)?;
    let values = arguments(inner)
        .into_iter()
        .map(|text| value(name, text, unit));
    let values = values.collect::<Result<Vec<f64>, String>>()?;
    let distribution = match (kind.trim(), values.as_slice()) {
        ("uniform", &[a, b]) => Distribution::Uniform(a, b),
        ("loguniform", &[a, b]) => Distribution::LogUniform(a, b),
        ("normal", &[mean, deviation]) => Distribution::Normal(mean, deviation),
        ("triangular", &[a, b, peak]) => Distribution::Triangular(a, b, peak),
        _ => return Err(wanted.into()),
    };
    check(distribution)?;
    Ok(distribution)
}

/// Checks the parameters of a distribution.
fn check(distribution: Distribution) -> Result<(), String> {
    match distribution {
        Distribution::Uniform(a, b) if a >= b => {
            Err("the first end must be below the second one".into())
        }
        Distribution::LogUniform(a, b) if a >= b || a / b <= 0.0 || b == 0.0 || a == 0.0 => {
            Err("the ends must have the same sign, neither may be 0, and the first must be below the second".into())
        }
        Distribution::Normal(_, deviation) if deviation <= 0.0 => {
            Err("a standard deviation must be greater than 0".into())
        }
        Distribution::Triangular(a, b, peak) if a >= b || !(a..=b).contains(&peak) => {
            Err("the first end must be below the second one, and the peak between them".into())
        }
        _ => Ok(()),
    }
}
