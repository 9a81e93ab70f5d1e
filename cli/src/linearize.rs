//! `lagrangian linearize`: the linear model of a machine, with its poles, zeros and frequency response.

mod along;
pub mod arrays;
mod files;
mod frequencies;
pub mod mat;
pub mod npz;

use std::f64::consts::TAU;
use std::fmt::Write as _;

use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{Machine, Simulation, State, System};
use lagrangian_linear::model::{Label, LinearModel, Observed, Request, about, along};
use lagrangian_linear::poles::{Pole, poles};
use lagrangian_linear::spectrum::damping;
use lagrangian_linear::zeros::zeros;
use lagrangian_linear::{Complex, DMatrix};
use lagrangian_symbolic::Dag;
use lagrangian_units::{integral_name, rate_unit, state_of};
use serde_json::{Value, json};

use crate::call;
use crate::failure::{Failure, help_with};
use crate::modes::{self, OPTIONS, number};
use crate::numbers::after_number;
use crate::other_chart::{self, OtherChart};
use crate::output;
use crate::reading::{self, places};
use files::Files;

/// Matrices with more columns are not printed.
const MOST_COLUMNS: usize = 8;

/// A model with its evaluation.
struct Linearization {
    model: LinearModel,
    poles: Vec<Pole>,
    zeros: Vec<Complex<f64>>,
}

/// Runs the command.
///
/// # Errors
/// If the spec or the call is invalid, or the machine has no linear model there.
pub fn run(call: &call::Linearize) -> Result<(), Failure> {
    let files = Files::new(call)?;
    let dag = Dag::new();
    let spec = (&call.spec, &call.search.start);
    let (compiled, cartesian) = modes::compiled(spec, &dag, files.all(), "linear model")?;
    let varied = ("--along", call.along.as_ref());
    let machine = modes::prepare(&compiled, &call.search, varied)?;
    if let Some(range) = &call.along {
        let trace = modes::vary::trace(&call.search, ("--along", range), &compiled, &machine)?;
        return along::show(call, &machine, &trace, &files);
    }
    let start = modes::start(&machine, &call.search)?;
    // A name that the machine does not have is an error of the call.
    request(call, &machine)?;
    let found = linear_model(call, &machine, start.clone()).map(|found| (machine, found));
    let (machine, (model, place)) = other_chart::search(found, || {
        let given = (&call.search.start, &call.search.keep);
        let chart = OtherChart::of(&compiled, cartesian, given, &start)?;
        let found = linear_model(call, &chart.machine, chart.start);
        Some(found.map(|found| (chart.machine, found)))
    })?;
    let none = || Failure::run("the eigenvalues cannot be found");
    let result = Linearization {
        poles: poles(&model.a, &model.a_bounds).ok_or_else(none)?,
        zeros: zeros(&model).ok_or_else(none)?,
        model,
    };
    files.write(machine.name(), &names(&machine), &result)?;
    if call.spec.json {
        output::line(format_args!("{:#}", as_json(&names(&machine), &result)))
    } else {
        output::text(&format!("{place}{}", text(&result)))
    }
    Ok(())
}

/// The model that a call asks for, from a start, and a text that describes the operating point.
fn linear_model(
    call: &call::Linearize,
    machine: &InterpretedMachine,
    start: State<Named>,
) -> Result<(LinearModel, String), Failure> {
    let request = request(call, machine)?;
    if call.here {
        about_start(call, (machine, start), &request)
    } else {
        about_motion(call, (machine, start), &request)
    }
}

/// The names of coordinates and of inputs.
fn names(machine: &InterpretedMachine) -> [Vec<String>; 2] {
    let inputs = machine.program().inputs.iter();
    [
        machine
            .prepare()
            .coordinates()
            .map(|q| q.name.to_owned())
            .collect(),
        inputs.map(|slot| slot.name.to_string()).collect(),
    ]
}

/// The model about the start itself, and a text that describes the operating point.
fn about_start(
    call: &call::Linearize,
    (machine, mut start): (&InterpretedMachine, State<Named>),
    request: &Request,
) -> Result<(LinearModel, String), Failure> {
    let search = &call.search;
    if machine.prepare().constraints().len() > 0 {
        // A run of length zero only projects its start onto the constraints.
        let simulation = Simulation::new(machine).until(start.t);
        let run = reading::keep(simulation, &search.keep).run_interpreted(start);
        start = run.map_err(Failure::run)?.start().clone();
    }
    let model = about(
        machine,
        (start.t, &start.q.values, &start.v.values),
        request,
    );
    let model = model.map_err(|none| Failure::Run(none.in_words(&machine.prepare(), OPTIONS)))?;
    modes::warn_of_ended(machine, (start.t, &model.q, &model.v));
    let mut text = "about the start:\n".to_owned();
    let width = start.q.iter().map(|(name, _)| name.chars().count()).max();
    let width = width.unwrap_or(0);
    for (((name, _), q), v) in start.q.iter().zip(&model.q).zip(&model.v) {
        if let Some(state) = state_of(name) {
            let unit = after_number(&rate_unit(name, start.q.unit(name).unwrap_or("s")));
            let _ = writeln!(text, "  {state:width$}  {}{unit}", number(*v));
            continue;
        }
        let unit = after_number(start.q.unit(name).unwrap_or("1"));
        let _ = write!(text, "  {name:width$}  {}{unit}", number(*q));
        if *v != 0.0 {
            let verb = if unit == " rad" { "turning" } else { "moving" };
            let _ = write!(text, ", {verb} at {}{unit}/s", number(*v));
        }
        text.push('\n');
    }
    Ok((model, text))
}

/// The model about the equilibrium, or along the steady motion, and a text that describes it.
fn about_motion(
    call: &call::Linearize,
    (machine, start): (&InterpretedMachine, State<Named>),
    request: &Request,
) -> Result<(LinearModel, String), Failure> {
    let reached = modes::find_motion(machine, start, &call.search)?;
    let model = along(machine, &reached.motion, request);
    let model = model.map_err(|none| Failure::Run(none.in_words(&machine.prepare(), OPTIONS)))?;
    let system = machine.prepare();
    let names: Vec<&str> = system.coordinates().map(|q| q.name).collect();
    let units: Vec<&str> = system.coordinates().map(|q| q.unit).collect();
    Ok((model, modes::text_of_place(&names, &units, &reached)))
}

/// The inputs and outputs that a call requests.
fn request(call: &call::Linearize, machine: &InterpretedMachine) -> Result<Request, Failure> {
    let system = machine.prepare();
    let all = system.default_inputs();
    let mut inputs = Vec::new();
    for name in &call.inputs {
        let found = places(&all, name);
        if found.is_empty() {
            let known: Vec<String> = all.iter().map(|(name, _)| name.to_owned()).collect();
            return Err(unknown("--inputs", "input", name, &known));
        }
        inputs.extend(found);
    }
    if call.inputs.is_empty() {
        inputs = (0..all.values.len()).collect();
    }
    let start = machine.start();
    let zero = vec![0.0; start.q.values.len()];
    let observed = system.outputs(0.0, &start.q.values, &start.v.values, &zero, &all);
    let constraints: Vec<String> = system.constraints().map(|c| c.name.to_owned()).collect();
    let mut outputs: Vec<Observed> = Vec::new();
    let wanted = call::names_of_option("--outputs", &call.outputs)?;
    for name in &wanted {
        let found = resolve(name, &start.q, &observed, &constraints);
        if found.is_empty() {
            let output_names = observed.iter().map(|(name, _)| name.to_owned());
            let coordinates = start.q.iter().flat_map(|(name, _)| match state_of(name) {
                Some(state) => vec![format!("der({state})"), state],
                None => vec![
                    name.to_owned(),
                    format!("der({name})"),
                    format!("der({name},2)"),
                ],
            });
            let constraints = constraints.iter().map(|name| format!("multiplier({name})"));
            let known: Vec<String> = output_names.chain(coordinates).chain(constraints).collect();
            return Err(unknown("--outputs", "output", name, &known));
        }
        outputs.extend(found);
    }
    if wanted.is_empty() {
        outputs = match observed.values.len() {
            0 => start
                .q
                .iter()
                .enumerate()
                .map(|(i, (name, _))| match state_of(name) {
                    Some(_) => Observed::Rate(i),
                    None => Observed::Coordinate(i),
                })
                .collect(),
            count => (0..count).map(Observed::Output).collect(),
        };
    }
    let mut seen = inputs.iter().enumerate();
    if let Some((_, k)) = seen.find(|(i, k)| inputs[..*i].contains(k)) {
        let name = all.iter().nth(*k).map_or("", |(name, _)| name);
        return Err(Failure::Call(format!(
            "--inputs names `{name}` more than once"
        )));
    }
    let mut seen = outputs.iter().enumerate();
    if seen.any(|(i, output)| outputs[..i].contains(output)) {
        return Err(Failure::Call(
            "--outputs names a quantity more than once".to_owned(),
        ));
    }
    Ok(Request { inputs, outputs })
}

/// The quantities that a name of an output stands for; empty if there are none.
fn resolve(name: &str, q: &Named, outputs: &Named, constraints: &[String]) -> Vec<Observed> {
    let matching = places(outputs, name);
    if !matching.is_empty() {
        return matching.into_iter().map(Observed::Output).collect();
    }
    let inside = |start: &str| name.strip_prefix(start)?.strip_suffix(')').map(str::trim);
    if let Some(constraint) = inside("multiplier(") {
        let all = constraints.iter().enumerate();
        let is_member = |name: &String| {
            name == constraint
                || name
                    .strip_prefix(constraint)
                    .is_some_and(|rest| rest.starts_with('['))
        };
        let found = all.filter(|(_, name)| is_member(name));
        return found.map(|(k, _)| Observed::Multiplier(k)).collect();
    }
    let states = places(q, &integral_name(name));
    if !states.is_empty() {
        return states.into_iter().map(Observed::Rate).collect();
    }
    let Some(inside) = inside("der(") else {
        let coordinates = places(q, name).into_iter();
        return coordinates.map(Observed::Coordinate).collect();
    };
    let states = places(q, &integral_name(inside));
    if !states.is_empty() {
        return states.into_iter().map(Observed::Acceleration).collect();
    }
    match inside.rsplit_once(',') {
        None => places(q, inside).into_iter().map(Observed::Rate).collect(),
        Some((coordinate, order)) => {
            let coordinates = places(q, coordinate.trim()).into_iter();
            match order.trim() {
                "1" => coordinates.map(Observed::Rate).collect(),
                "2" => coordinates.map(Observed::Acceleration).collect(),
                _ => Vec::new(),
            }
        }
    }
}

fn unknown(option: &str, noun: &str, name: &str, known: &[String]) -> Failure {
    let help = help_with(name, known.iter().map(String::as_str));
    Failure::Call(format!("{option} {name}: no {noun} named `{name}`; {help}"))
}

/// The rows of a matrix.
fn rows(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    let rows = matrix.row_iter();
    rows.map(|row| row.iter().copied().collect()).collect()
}

fn as_json(names: &[Vec<String>; 2], result: &Linearization) -> Value {
    let Linearization {
        model,
        poles,
        zeros,
    } = result;
    let by_name = |names: &[String], values: &[f64]| -> Value {
        let pairs = names.iter().zip(values);
        let pairs = pairs.filter(|(name, _)| state_of(name).is_none());
        Value::Object(pairs.map(|(name, x)| (name.clone(), json!(x))).collect())
    };
    let states = names[0].iter().zip(&model.v);
    let states: serde_json::Map<String, Value> = states
        .filter_map(|(name, x)| Some((state_of(name)?, json!(x))))
        .collect();
    let labels = |labels: &[Label]| -> Vec<Value> {
        let labels = labels.iter();
        labels
            .map(|label| json!({"name": label.name, "unit": label.unit}))
            .collect()
    };
    let complex = |x: &Complex<f64>| json!({"re": x.re, "im": x.im});
    let outputs: Vec<String> = model.outputs.iter().map(|y| y.name.clone()).collect();
    let mut at = json!({
        "q": by_name(&names[0], &model.q),
        "v": by_name(&names[0], &model.v),
        "u": by_name(&names[1], &model.u),
        "y": by_name(&outputs, &model.y),
    });
    if !states.is_empty() {
        at["states"] = Value::Object(states);
    }
    json!({
        "at": at,
        "states": labels(&model.states),
        "inputs": labels(&model.inputs),
        "outputs": labels(&model.outputs),
        "A": rows(&model.a),
        "B": rows(&model.b),
        "C": rows(&model.c),
        "D": rows(&model.d),
        "drift": model.drift,
        "basis": model.is_reduced.then(|| rows(&model.basis)),
        "left_out": model.records,
        "eigenvalues": poles.iter().map(|pole| complex(&pole.lambda)).collect::<Vec<_>>(),
        "zeros": zeros.iter().map(complex).collect::<Vec<_>>(),
    })
}

/// A list of names with their units.
fn list(labels: &[Label], singular_and_plural: [&str; 2]) -> String {
    let count = labels.len();
    let noun = singular_and_plural[usize::from(count != 1)];
    let names = labels.iter().map(|label| match label.unit.as_str() {
        "" | "1" => label.name.clone(),
        unit => format!("{} [{unit}]", label.name),
    });
    match count {
        0 => format!("no {noun}\n"),
        _ => format!("{count} {noun}: {}\n", names.collect::<Vec<_>>().join(", ")),
    }
}

fn text(result: &Linearization) -> String {
    let Linearization {
        model,
        poles,
        zeros,
    } = result;
    let mut text = String::new();
    text.push_str(&list(&model.states, ["state", "states"]));
    text.push_str(&list(&model.inputs, ["input", "inputs"]));
    text.push_str(&list(&model.outputs, ["output", "outputs"]));
    if !model.records.is_empty() {
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "left out, since nothing depends on their positions: {}",
            model.records.join(", ")
        );
    }
    for (name, matrix) in [
        ("A", &model.a),
        ("B", &model.b),
        ("C", &model.c),
        ("D", &model.d),
    ] {
        text.push_str(&text_of_matrix(name, matrix));
    }
    if model.drift.iter().any(|x| *x != 0.0) {
        let drift = DMatrix::from_column_slice(model.drift.len(), 1, &model.drift);
        text.push_str(&text_of_matrix("drift", &drift));
    }
    let all: Vec<Complex<f64>> = poles.iter().map(|pole| pole.lambda).collect();
    text.push_str("\npoles:\n");
    text.push_str(&text_of_values(&all));
    if !zeros.is_empty() {
        text.push_str("\nzeros:\n");
        text.push_str(&text_of_values(zeros));
    } else if !model.inputs.is_empty() && !model.outputs.is_empty() {
        text.push_str("\nno zeros\n");
    }
    text
}

/// A matrix in columns; a large one is represented by its size.
fn text_of_matrix(name: &str, matrix: &DMatrix<f64>) -> String {
    let (rows, columns) = matrix.shape();
    if rows == 0 || columns == 0 {
        return String::new();
    }
    if columns > MOST_COLUMNS || rows > 2 * MOST_COLUMNS {
        return format!("\n{name}: {rows} × {columns}, in full with --json or --out\n");
    }
    let cells: Vec<Vec<String>> = matrix
        .row_iter()
        .map(|row| row.iter().map(|x| number(*x)).collect())
        .collect();
    let width = |j: usize| cells.iter().map(|row| row[j].len()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = format!("\n{name} =\n");
    for row in &cells {
        let cells = row.iter().zip(&widths);
        let cells: Vec<String> = cells.map(|(x, width)| format!("{x:>width$}")).collect();
        let _ = writeln!(text, "  {}", cells.join("  "));
    }
    text
}

/// Values of λ, with one line for each pair.
fn text_of_values(values: &[Complex<f64>]) -> String {
    let mut text = String::new();
    for value in values.iter().filter(|value| value.im >= 0.0) {
        let Complex { re, im } = *value;
        let _ = match damping(*value) {
            Some(ratio) => {
                let re = match re {
                    0.0 => String::new(),
                    re => format!("{} ", number(re)),
                };
                let (hertz, ratio) = (number(im / TAU), number(ratio));
                writeln!(
                    text,
                    "  {re}± {}i 1/s: {hertz} Hz, damping ratio {ratio}",
                    number(im)
                )
            }
            None => writeln!(text, "  {} 1/s", number(re)),
        };
    }
    text
}
