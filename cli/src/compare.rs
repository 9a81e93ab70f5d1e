//! `lagrangian compare`: the differences of two runs.

use std::fmt::Write as _;
use std::path::Path;

use lagrangian_analysis::curve::common_times;
use lagrangian_analysis::{Difference, difference};
use serde_json::{Value, json};

use crate::call;
use crate::drawing::{self, Curve, Pane};
use crate::failure::Failure;
use crate::modes::number;
use crate::numbers::shortest;
use crate::output::{self, Destination, TABLE, keep_apart};
use crate::runs::{self, Columns, Options, Quantity, SampleInstants, factor, header};
use crate::table;

/// The column of energy errors, which is not part of the motion.
const RESIDUAL: &str = "energy residual";

/// A quantity that both runs have.
struct Compared {
    name: String,
    unit: Option<String>,
    difference: Difference,
    /// For each run how values between rows are interpolated, and an estimate of the error; `None` where no
    /// interpolation is needed.
    between: [Option<(&'static str, f64)>; 2],
    /// The values of both at all instants.
    values: [Vec<f64>; 2],
}

/// Runs the command.
///
/// # Errors
/// If a spec, a table or the call is invalid, or if the runs differ by more than `--within`.
pub fn run(call: &call::Compare) -> Result<(), Failure> {
    let out = (call.out.as_ref(), TABLE);
    let files = Destination::out_and_plot(out, call.plot.as_ref(), call.runs.json)?;
    let all: Vec<&Destination> = files.iter().flatten().collect();
    let read = [
        (call.first.as_path(), "the first run"),
        (call.second.as_path(), "the second run"),
    ];
    keep_apart(all.iter().copied(), &read)?;
    let [first, second] = read_runs(call, &all)?;
    let times = common_times(&first.times, &second.times);
    if times.is_empty() {
        let span = |run: &Columns| {
            let [from, to] = [run.times.first(), run.times.last()];
            let [from, to] = [from, to].map(|t| t.map_or("?".to_owned(), |t| shortest(*t)));
            format!("{from} s to {to} s")
        };
        return Err(Failure::Run(format!(
            "the runs have no time in common: the first goes from {}, the second from {}",
            span(&first),
            span(&second)
        )));
    }
    let (compared, left_out) = compare_quantities(call, &first, &second, &times)?;
    if let Some(file) = &files[0] {
        let columns = compared.iter().map(|one| {
            let values = one.difference.values.as_slice();
            (header(&one.name, one.unit.as_deref()), values)
        });
        let time = ("t [s]".to_owned(), times.as_slice());
        table::write_columns(
            &std::iter::once(time).chain(columns).collect::<Vec<_>>(),
            file,
        )?;
    }
    if let Some(file) = &files[1] {
        file.write_text(&difference_panes(call, &times, &compared).map_err(Failure::Run)?)?;
    }
    let beyond = beyond(call, &compared);
    if call.runs.json {
        let result = as_json(call, &times, &compared, &left_out, &beyond);
        output::line(format_args!("{result:#}"));
    } else {
        output::text(&text(&times, &compared, &left_out, [&first, &second]))
    }
    match (beyond.as_slice(), call.within) {
        ([], _) | (_, None) => Ok(()),
        (beyond, Some(within)) => {
            let list: Vec<String> = beyond
                .iter()
                .map(|one| match one.difference.relative() {
                    Some(share) => format!("{} ({})", one.name, number(share)),
                    None => format!(
                        "{} ({}, of a range of 0)",
                        one.name,
                        number(one.difference.largest)
                    ),
                })
                .collect();
            let floor = match (
                call.floor,
                beyond.iter().any(|one| one.difference.range < 1e-9),
            ) {
                (None, true) => "; --floor accepts differences that are small in absolute terms",
                _ => "",
            };
            Err(Failure::Run(format!(
                "the runs differ by more than {} of their range in {}{floor}",
                number(within),
                list.join(", ")
            )))
        }
    }
}

/// Reads both runs. If one is a table, the run of a spec is evaluated at its rows.
fn read_runs(call: &call::Compare, files: &[&Destination]) -> Result<[Columns; 2], Failure> {
    let paths = [&call.first, &call.second];
    let are_specs = [runs::is_spec(&call.first)?, runs::is_spec(&call.second)?];
    if are_specs == [false, false] {
        runs::refuse_without_spec(&call.runs)?;
    }
    if !are_specs[1] {
        let options = [
            ("--set-second", !call.second_parameters.is_empty()),
            ("--start-second", !call.second_coordinates.is_empty()),
            ("--rate-second", !call.second_rates.is_empty()),
            ("--tolerance-second", call.second_tolerance.is_some()),
            ("--method-second", call.second_method.is_some()),
        ];
        if let Some((option, _)) = options.iter().find(|(_, is_given)| *is_given) {
            return Err(Failure::Call(format!(
                "{option} applies to a second run made from a spec, but the second run is a table"
            )));
        }
    }
    let tables: Vec<Option<Columns>> = paths
        .iter()
        .zip(are_specs)
        .map(|(path, is_spec)| (!is_spec).then(|| runs::table(path)).transpose())
        .collect::<Result<_, _>>()?;
    let rows = tables
        .iter()
        .flatten()
        .next()
        .map(|table| table.times.clone());
    if rows.is_some() && call.runs.every.is_some() {
        return Err(Failure::Call(
            "--every does not apply to a spec that is compared with a table: it is recorded at the rows of the table".into(),
        ));
    }
    let end = rows.as_ref().and_then(|rows| rows.last().copied());
    let made = |k: usize| -> Result<Columns, Failure> {
        if let Some(table) = &tables[k] {
            return Ok(table.clone());
        }
        let mut options = Options::of(paths[k], &call.runs, end.filter(|end| *end > 0.0))?;
        if k == 1 {
            runs::replaced(&mut options.start.parameters, &call.second_parameters);
            runs::replaced(&mut options.start.coordinates, &call.second_coordinates);
            runs::replaced(&mut options.start.rates, &call.second_rates);
            options.tolerance = call.second_tolerance.or(options.tolerance);
            options.method = call.second_method.as_deref().or(options.method);
        }
        let looks = match &rows {
            Some(rows) => SampleInstants::At(rows),
            None => SampleInstants::Even,
        };
        runs::spec(&options, &looks, files)
    };
    Ok([made(0)?, made(1)?])
}

/// Quantities that only one of two runs has.
type LeftOut = [Vec<String>; 2];

/// All quantities that are compared, and those that only one run has.
fn compare_quantities(
    call: &call::Compare,
    first: &Columns,
    second: &Columns,
    times: &[f64],
) -> Result<(Vec<Compared>, LeftOut), Failure> {
    let only = |columns: &Columns, other: &Columns| -> Vec<String> {
        let names = columns.columns.iter().map(|column| column.name.clone());
        names.filter(|name| other.get(name).is_none()).collect()
    };
    let left_out = if call.of.is_empty() {
        [only(first, second), only(second, first)]
    } else {
        [Vec::new(), Vec::new()]
    };
    let wanted: Vec<&Quantity> = if call.of.is_empty() {
        first
            .columns
            .iter()
            .filter(|column| column.name != RESIDUAL && second.get(&column.name).is_some())
            .collect()
    } else {
        first.chosen(&call.of, &call.first)?
    };
    if wanted.is_empty() {
        return Err(Failure::Run("the runs have no quantity in common".into()));
    }
    let mut all = Vec::new();
    for one in wanted {
        all.push(compare_quantity(call, one, (first, second), times)?);
    }
    Ok((all, left_out))
}

/// One quantity of both runs, at these times, in its unit in the first.
fn compare_quantity(
    call: &call::Compare,
    one: &Quantity,
    (first, second): (&Columns, &Columns),
    times: &[f64],
) -> Result<Compared, Failure> {
    let other = second.get(&one.name);
    let other = other.ok_or_else(|| runs::unknown(&one.name, second, &call.second))?;
    // Both are compared in the unit of the first.
    let scale = match (&other.unit, &one.unit) {
        (Some(other_unit), Some(unit)) => factor(other_unit, unit).ok_or_else(|| {
            Failure::Run(format!(
                "`{}` is measured in {unit} in the first run and in {other_unit} in the second",
                one.name
            ))
        })?,
        _ => 1.0,
    };
    let values: Vec<f64> = other.values.iter().map(|x| x * scale).collect();
    let other = Quantity {
        values,
        ..other.clone()
    };
    let rates = [
        first.rates(&one.name),
        second
            .rates(&one.name)
            .map(|rates| rates.iter().map(|x| x * scale).collect()),
    ];
    let curves = [
        first.curve(one, rates[0].as_deref(), call.interpolation),
        second.curve(&other, rates[1].as_deref(), call.interpolation),
    ];
    let Some(difference) = difference(times, &curves[0], &curves[1]) else {
        return Err(Failure::Run(format!(
            "`{}` has no instant at which both runs have a value",
            one.name
        )));
    };
    let is_dense = |curve: &lagrangian_analysis::Curve<'_>| {
        // Rows of one run that the other lacks require interpolation.
        let rows = curve
            .times()
            .iter()
            .filter(|t| (times[0]..=times[times.len() - 1]).contains(*t));
        rows.count() >= times.len()
    };
    let between = [&curves[0], &curves[1]].map(|curve| {
        (!is_dense(curve)).then(|| (curve.interpolation().name(), curve.interpolation_error()))
    });
    let first_values: Vec<f64> = times.iter().map(|t| curves[0].at(*t)).collect();
    let values = first_values
        .iter()
        .zip(&difference.values)
        .map(|(x, d)| x + d)
        .collect();
    Ok(Compared {
        name: one.name.clone(),
        unit: one.unit.clone().or(other.unit),
        difference,
        between,
        values: [first_values, values],
    })
}

/// The quantities that differ by more than the call allows.
fn beyond<'a>(call: &call::Compare, compared: &'a [Compared]) -> Vec<&'a Compared> {
    let Some(within) = call.within else {
        return Vec::new();
    };
    let floor = call.floor.unwrap_or(0.0);
    let is_beyond = |one: &&Compared| {
        one.difference.largest > floor
            && one.difference.relative().is_none_or(|share| share > within)
    };
    compared.iter().filter(is_beyond).collect()
}

fn text(
    times: &[f64],
    compared: &[Compared],
    left_out: &LeftOut,
    [first, second]: [&Columns; 2],
) -> String {
    let ends = [times.first(), times.last()].map(|t| t.map_or(f64::NAN, |t| *t));
    let whose = match (first.is_spec, second.is_spec) {
        (true, true) => "at which both specs are recorded",
        (false, false) => "the rows of both tables",
        _ => "the rows of the table, at which the spec is recorded",
    };
    let mut text = format!(
        "{} instants from {} s to {} s, {whose}\n",
        times.len(),
        shortest(ends[0]),
        shortest(ends[1])
    );
    text.push_str(&table(compared));
    for one in compared {
        let count = one.difference.count;
        if count < times.len() {
            let name = &one.name;
            let _ = writeln!(
                text,
                "{name}: both have a value at {count} of these instants"
            );
        }
    }
    text.push_str(&interpolated(compared));
    for (names, which) in left_out.iter().zip(["first", "second"]) {
        if !names.is_empty() {
            let _ = writeln!(text, "only in the {which}: {}", names.join(", "));
        }
    }
    text
}

/// A row for each quantity, with its difference.
fn table(compared: &[Compared]) -> String {
    let mut text = String::new();
    let heads = [
        "largest",
        "at t [s]",
        "root mean square",
        "range",
        "share of it",
    ];
    let rows: Vec<[String; 6]> = compared
        .iter()
        .map(|one| {
            let difference = &one.difference;
            let share = match difference.relative() {
                Some(share) => number(share),
                None => "–".to_owned(),
            };
            let range = if difference.is_constant {
                format!("{} (constant)", number(difference.range))
            } else {
                number(difference.range)
            };
            [
                header(&one.name, one.unit.as_deref()),
                number(difference.largest),
                number(difference.at),
                number(difference.rms),
                range,
                share,
            ]
        })
        .collect();
    let length = |text: &str| text.chars().count();
    let width = |k: usize| {
        let head = if k == 0 { 0 } else { length(heads[k - 1]) };
        rows.iter()
            .map(|row| length(&row[k]))
            .max()
            .unwrap_or(0)
            .max(head)
    };
    let widths: Vec<usize> = (0..6).map(width).collect();
    let cells = heads
        .iter()
        .zip(&widths[1..])
        .map(|(head, width)| format!("{head:>width$}"));
    let cells: Vec<String> = cells.collect();
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "  {:width$}  {}",
        "",
        cells.join("  "),
        width = widths[0]
    );
    for row in &rows {
        let cells = row[1..].iter().zip(&widths[1..]);
        let cells: Vec<String> = cells
            .map(|(cell, width)| format!("{cell:>width$}"))
            .collect();
        let _ = writeln!(
            text,
            "  {:width$}  {}",
            row[0],
            cells.join("  "),
            width = widths[0]
        );
    }
    text
}

/// How quantities are interpolated between the rows of each run, with the largest error that this may cause.
fn interpolated(compared: &[Compared]) -> String {
    let mut text = String::new();
    for (k, which) in ["first", "second"].into_iter().enumerate() {
        let between = compared
            .iter()
            .filter_map(|one| one.between[k].map(|found| (one, found)));
        let between: Vec<(&Compared, (&str, f64))> = between.collect();
        let worst = between.iter().max_by(|a, b| {
            let share = |(one, (_, error)): &(&Compared, (&str, f64))| error / one.difference.range;
            share(a).total_cmp(&share(b))
        });
        let mut names: Vec<&str> = between.iter().map(|(_, (name, _))| *name).collect();
        names.sort_unstable();
        names.dedup();
        if let Some((one, (_, error))) = worst {
            let _ = writeln!(
                text,
                "between the rows of the {which}: {}, which may cause an error of up to {} in {}",
                names.join(", "),
                number(*error),
                header(&one.name, one.unit.as_deref())
            );
        }
    }
    text
}

fn as_json(
    call: &call::Compare,
    times: &[f64],
    compared: &[Compared],
    left_out: &LeftOut,
    beyond: &[&Compared],
) -> Value {
    let path = |path: &Path| path.display().to_string();
    let quantities = compared.iter().map(|one| {
        let difference = &one.difference;
        let between = one.between.map(|between| {
            between.map(|(name, error)| json!({"interpolation": name, "error": error}))
        });
        json!({
            "name": one.name,
            "unit": one.unit,
            "largest": difference.largest,
            "at": difference.at,
            "rms": difference.rms,
            "range": difference.range,
            "constant": difference.is_constant,
            "relative": difference.relative(),
            "instants": difference.count,
            "between_rows": between,
        })
    });
    let quantities: Vec<Value> = quantities.collect();
    let mut document = json!({
        "first": path(&call.first),
        "second": path(&call.second),
        "from": times.first(),
        "to": times.last(),
        "instants": times.len(),
        "quantities": quantities,
        "only_in_first": left_out[0],
        "only_in_second": left_out[1],
    });
    if let (Value::Object(fields), Some(within)) = (&mut document, call.within) {
        let names: Vec<&str> = beyond.iter().map(|one| one.name.as_str()).collect();
        fields.insert("within".into(), json!(within));
        fields.insert("beyond".into(), json!(names));
    }
    document
}

/// Draws for every unit both runs, with the differences below: coordinates and rates, outputs, or the columns
/// named by the call.
fn difference_panes(
    call: &call::Compare,
    times: &[f64],
    compared: &[Compared],
) -> Result<String, String> {
    let title = [&call.first, &call.second].map(|path| {
        path.file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned()
    });
    let mut panes: Vec<(Option<String>, [Pane; 2])> = Vec::new();
    for one in compared {
        let unit = one.unit.clone();
        let curve = |name: String, values: &[f64]| Curve {
            name,
            points: times.iter().copied().zip(values.iter().copied()).collect(),
        };
        let label = |quantity: &str| header(quantity, unit.as_deref());
        let place = panes.iter().position(|(other, _)| *other == unit);
        let place = place.unwrap_or_else(|| {
            let pane = |what: &str| Pane {
                along: ["t [s]".to_owned(), label(what)],
                curves: Vec::new(),
                are_points: false,
            };
            panes.push((unit.clone(), [pane("both"), pane("second − first")]));
            panes.len() - 1
        });
        let (_, [both, apart]) = &mut panes[place];
        both.curves
            .push(curve(format!("{}, first", one.name), &one.values[0]));
        both.curves
            .push(curve(format!("{}, second", one.name), &one.values[1]));
        apart
            .curves
            .push(curve(one.name.clone(), &one.difference.values));
    }
    let panes: Vec<Pane> = panes.into_iter().flat_map(|(_, panes)| panes).collect();
    drawing::svg(&format!("{} and {}", title[0], title[1]), &panes)
}
