//! `lagrangian section`: the states of a run once per period, or where a quantity crosses a value.

use lagrangian_analysis::Curve as Function;
use serde_json::{Value, json};

use crate::call::{self, Direction};
use crate::drawing::{self, Curve, Pane};
use crate::failure::Failure;
use crate::modes::number;
use crate::output::{self, Destination, TABLE, keep_apart};
use crate::runs::{self, Columns, Options, Quantity, SampleInstants};
use crate::{simulate, table};

/// The number of points that are printed.
const SHOWN: usize = 10;

/// Runs the command.
///
/// # Errors
/// If the spec, the table or the call is invalid, or the run fails.
pub fn run(call: &call::Section) -> Result<(), Failure> {
    let out = (call.out.as_ref(), TABLE);
    let files = Destination::out_and_plot(out, call.plot.as_ref(), call.part.runs.json)?;
    let all: Vec<&Destination> = files.iter().flatten().collect();
    let points = points(call, &all)?;
    let shown = shown(call, &points)?;
    if let Some(file) = &files[0] {
        let columns = points.columns.iter();
        let columns = columns.map(|column| (column.header(), column.values.as_slice()));
        let time = ("t [s]".to_owned(), points.times.as_slice());
        table::write_columns(
            &std::iter::once(time).chain(columns).collect::<Vec<_>>(),
            file,
        )?;
    }
    if let Some(file) = &files[1] {
        let [across, upwards, ..] = shown.as_slice() else {
            return Err(Failure::Call(
                "--plot draws one quantity over another: name two by --of".into(),
            ));
        };
        let pairs = across
            .values
            .iter()
            .copied()
            .zip(upwards.values.iter().copied());
        let pane = Pane {
            along: [across.header(), upwards.header()],
            curves: vec![Curve {
                name: format!("{} points", points.times.len()),
                points: pairs.collect(),
            }],
            are_points: true,
        };
        let title = call
            .part
            .run
            .file_name()
            .unwrap_or_default()
            .to_string_lossy();
        file.write_text(&drawing::svg(&title, &[pane]).map_err(Failure::Run)?)?;
    }
    if call.part.runs.json {
        output::line(format_args!("{:#}", as_json(&points, &shown)))
    } else {
        output::text(&text(&points, &shown))
    }
    Ok(())
}

/// The quantities that are printed and drawn: those that `--of` names, or the first coordinate and its rate.
fn shown<'a>(call: &call::Section, points: &'a Columns) -> Result<Vec<&'a Quantity>, Failure> {
    if !call.part.of.is_empty() {
        return points.chosen(&call.part.of, &call.part.run);
    }
    let first = points.chosen(&[], &call.part.run)?;
    let first = first.first().copied();
    let rate = first.and_then(|first| points.get(&format!("der({})", first.name)));
    Ok(first.into_iter().chain(rate).collect())
}

/// All quantities of a run at the points of its section.
fn points(call: &call::Section, files: &[&Destination]) -> Result<Columns, Failure> {
    let part = &call.part;
    let neither = || Failure::Call("give --every-period, or --crossing".into());
    let found = if runs::is_spec(&part.run)? {
        keep_apart(files.iter().copied(), &[(part.run.as_path(), "the run")])?;
        if part.runs.every.is_some() {
            return Err(Failure::Call(
                "--every does not apply to a section of a spec's run".into(),
            ));
        }
        let options = Options::of(&part.run, &part.runs, None)?;
        match (&call.period, &call.crossing) {
            (Some(period), _) => runs::spec(&options, &SampleInstants::Period(period), files)?,
            (None, Some(crossing)) => {
                // `x=0.1*m` means where x − 0.1 m crosses 0.
                let level = crossing.split_once('=');
                let level = level.map(|(name, value)| (name.trim(), value.trim()));
                let formula = match level {
                    Some((name, value)) => format!("({name}) - ({value})"),
                    None => crossing.clone(),
                };
                let looks = SampleInstants::Crossing(&formula, call.direction, level);
                runs::spec(&options, &looks, files)?
            }
            (None, None) => return Err(neither()),
        }
    } else {
        keep_apart(files.iter().copied(), &[(part.run.as_path(), "the run")])?;
        runs::refuse_without_spec(&part.runs)?;
        // Periods are counted from the first row, as those of a spec from its start, whatever --after leaves out.
        let columns = runs::table(&part.run)?;
        let times = match (&call.period, &call.crossing) {
            (Some(period), _) => periods(&columns, period)?,
            (None, Some(crossing)) => crossings(call, &columns, crossing)?,
            (None, None) => return Err(neither()),
        };
        at(&columns, times)
    };
    Ok(found.after(part.after))
}

/// The instants once per period in a table, from its first row on.
fn periods(columns: &Columns, period: &str) -> Result<Vec<f64>, Failure> {
    let wrong = |why: String| Failure::Call(format!("--every-period {period}: {why}"));
    let period = call::number(period).map_err(wrong)?;
    if period <= 0.0 {
        return Err(wrong("expected a time greater than 0".into()));
    }
    let [from, to] = [columns.times.first(), columns.times.last()].map(|t| t.map_or(0.0, |t| *t));
    let width = 1 + columns.columns.len();
    simulate::check_samples("--every-period", period, to - from, width)?;
    let count = ((to - from) / period * (1.0 + 1e-12)).floor() as usize;
    Ok((0..=count)
        .map(|k| (from + k as f64 * period).min(to))
        .collect())
}

/// The instants at which a column of a table crosses a value.
fn crossings(call: &call::Section, columns: &Columns, crossing: &str) -> Result<Vec<f64>, Failure> {
    let (name, value) = crossing.split_once('=').unwrap_or((crossing, "0"));
    let name = name.trim();
    let Some(column) = columns.get(name) else {
        let Failure::Call(message) = runs::unknown(name, columns, &call.part.run) else {
            return Ok(Vec::new());
        };
        return Err(Failure::Call(message.replace("--of", "--crossing")));
    };
    let set = call::Assignment {
        name: name.to_owned(),
        value: value.trim().to_owned(),
    };
    let level = set.value("--crossing", column.unit.as_deref().unwrap_or("1"));
    let level = level.map_err(Failure::Call)?;
    if column.is_empty() {
        return Err(Failure::Run(format!(
            "--crossing {crossing}: `{name}` has no value at any instant"
        )));
    }
    columns.warn_of_gaps(column);
    let rates = columns.rates(name);
    let curve = columns.curve(column, rates.as_deref(), call::Interpolation::Cubic);
    let found = curve.crossings(level).into_iter();
    let is_meant = |rises: bool| match call.direction {
        Direction::Up => rises,
        Direction::Down => !rises,
        Direction::Both => true,
    };
    Ok(found
        .filter(|(_, rises)| is_meant(*rises))
        .map(|(t, _)| t)
        .collect())
}

/// All columns of a table at these instants.
fn at(columns: &Columns, times: Vec<f64>) -> Columns {
    let value = |column: &Quantity| {
        let rates = columns.rates(&column.name);
        let curve: Function<'_> =
            columns.curve(column, rates.as_deref(), call::Interpolation::Cubic);
        times.iter().map(|t| curve.at(*t)).collect()
    };
    Columns {
        columns: columns
            .columns
            .iter()
            .map(|column| Quantity {
                values: value(column),
                ..column.clone()
            })
            .collect(),
        times,
        is_spec: false,
    }
}

fn text(points: &Columns, shown: &[&Quantity]) -> String {
    let mut text = format!("{} points\n", points.times.len());
    for (row, t) in points.times.iter().take(SHOWN).enumerate() {
        let values = shown.iter().map(|column| {
            let unit = column.unit.as_deref().filter(|unit| *unit != "1");
            let unit = unit.map_or_else(String::new, |unit| format!(" {unit}"));
            format!("{} = {}{unit}", column.name, number(column.values[row]))
        });
        let values: Vec<String> = values.collect();
        text.push_str(&format!("  t = {} s: {}\n", number(*t), values.join(", ")));
    }
    if points.times.len() > SHOWN {
        text.push_str(&format!(
            "  and {} more, with --json or --out\n",
            points.times.len() - SHOWN
        ));
    }
    text
}

fn as_json(points: &Columns, shown: &[&Quantity]) -> Value {
    let columns = shown
        .iter()
        .map(|column| json!({"name": column.name, "unit": column.unit, "values": column.values}));
    json!({"t": points.times, "quantities": columns.collect::<Vec<Value>>()})
}
