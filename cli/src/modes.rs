//! `lagrangian modes`: equilibria and steady motions, and the modes about them.

mod locus;
pub mod vary;

use std::f64::consts::TAU;
use std::fmt::Write as _;

use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{Machine, Simulation, State, System};
use lagrangian_linear::motion::SteadyMotion;
use lagrangian_linear::search::{self, Wanted};
use lagrangian_linear::spectrum::{Mode, Modes, damping};
use lagrangian_linear::steady::{self, Options};
use lagrangian_linear::{Complex, model};
use lagrangian_mechanics::Compiled;
use lagrangian_spec::model::Model;
use lagrangian_spec::source::Sources;
use lagrangian_symbolic::Dag;
use lagrangian_units::{rate_name, rate_unit as unit_of_rate, state_of};
use serde_json::{Map, Value, json};

use crate::call;
use crate::evaluate::{ended_assumptions, set_start};
use crate::failure::Failure;
use crate::other_chart::{self, OtherChart};
use crate::output::{self, Destination, SVG, TABLE, keep_apart};
use crate::reading::{self, Reading};
use crate::table;
use vary::{Critical, Trace};

/// The names of the options that choose the start, for messages.
pub const OPTIONS: Options = Options {
    start: "--start",
    steady: "--steady",
};

/// The files that a call requests.
struct Files {
    out: Option<Destination>,
    plot: Option<Destination>,
}

impl Files {
    fn new(call: &call::Modes) -> Result<Files, Failure> {
        let files = Files {
            out: Destination::of("--out", call.out.as_ref(), TABLE)?,
            plot: Destination::of("--plot", call.plot.as_ref(), SVG)?,
        };
        output::keep_document_apart(files.all(), call.spec.json)?;
        keep_apart(files.all(), &[(&call.spec.path, "the spec")])?;
        Ok(files)
    }

    fn all(&self) -> impl Iterator<Item = &Destination> {
        [&self.out, &self.plot].into_iter().flatten()
    }
}

/// Runs the command.
///
/// # Errors
/// If the spec or the call is invalid, or the machine has no equilibrium near its start.
pub fn run(call: &call::Modes) -> Result<(), Failure> {
    let files = Files::new(call)?;
    let dag = Dag::new();
    let (compiled, cartesian) =
        compiled((&call.spec, &call.search.start), &dag, files.all(), "modes")?;
    let machine = prepare(&compiled, &call.search, ("--vary", call.vary.as_ref()))?;
    if let Some(vary) = &call.vary {
        let trace = vary::trace(&call.search, ("--vary", vary), &compiled, &machine)?;
        return show(call, &machine, &trace, &files);
    }
    let start = start(&machine, &call.search)?;
    let found = find_motion(&machine, start.clone(), &call.search);
    let found = found.map(|reached| (machine, reached));
    let (machine, Reached { q, wanted, motion }) = other_chart::search(found, || {
        let given = (&call.search.start, &call.search.keep);
        let chart = OtherChart::of(&compiled, cartesian, given, &start)?;
        let found = find_motion(&chart.machine, chart.start, &call.search);
        Some(found.map(|reached| (chart.machine, reached)))
    })?;
    let system = machine.prepare();
    let names: Vec<&str> = system.coordinates().map(|q| q.name).collect();
    if call.spec.json {
        let result = as_json(&names, &motion);
        output::line(format_args!("{result:#}"));
    } else {
        let units: Vec<&str> = system.coordinates().map(|q| q.unit).collect();
        output::text(&text(&names, &units, &q, &wanted, &motion));
    }
    Ok(())
}

/// The machine with the parameters of a call, after checking that all have values. One that an option varies has its first value.
pub fn prepare(
    compiled: &Compiled<'_>,
    search: &call::Search,
    (option, vary): (&str, Option<&call::Vary>),
) -> Result<InterpretedMachine, Failure> {
    let mut machine = reading::machine(compiled, &search.start)?;
    reading::set_first(&mut machine, &search.start, (option, vary))?;
    reading::check_parameters(&machine)?;
    reading::check_kept(&machine.start(), &search.keep)?;
    Ok(machine)
}

/// A steady motion, with the start of the search.
pub struct Reached {
    /// The coordinates at the start.
    pub q: Vec<f64>,
    pub wanted: Wanted,
    pub motion: SteadyMotion,
}

/// The start of a call.
pub fn start(machine: &InterpretedMachine, search: &call::Search) -> Result<State<Named>, Failure> {
    let mut start = machine.start();
    set_start(&mut start, &search.start)?;
    Ok(start)
}

/// The steady motion that the search reaches from a start.
pub fn find_motion(
    machine: &InterpretedMachine,
    mut start: State<Named>,
    search: &call::Search,
) -> Result<Reached, Failure> {
    let wanted = wanted(search, &mut start.v)?;
    let q = start.q.values.clone();
    refuse_drives(machine, &q, &wanted)?;
    start.v.values = wanted.given();
    let from = on_constraints(machine, &search.keep, start)?;
    let motion = motion(machine, &from, &wanted)?;
    warn_of_ended(machine, (0.0, &motion.found.place.q(), &motion.v));
    Ok(Reached { q, wanted, motion })
}

/// Prints a warning for each fact that the spec assumes and that does not hold at a state.
pub fn warn_of_ended(machine: &InterpretedMachine, state: (f64, &Vec<f64>, &Vec<f64>)) {
    for warning in ended_assumptions(&machine.prepare(), state) {
        output::print_error(format_args!("warning: {warning}"));
    }
}

/// The position at which the search starts: if the call keeps numbers of the start, the projected start of a run.
fn on_constraints(
    machine: &InterpretedMachine,
    keep: &call::Keep,
    start: State<Named>,
) -> Result<Vec<f64>, Failure> {
    let system = machine.prepare();
    let is_kept = match reading::kept_names(keep) {
        Some(names) => !names.is_empty(),
        None => system.kept_at_start().len() != 0,
    };
    if !is_kept || system.constraints().len() == 0 {
        return Ok(start.q.values);
    }
    let simulation = Simulation::new(machine).until(start.t);
    let run = reading::keep(simulation, keep).run_interpreted(start);
    Ok(run.map_err(Failure::run)?.start().q.values.clone())
}

/// The steady motion that the search reaches from `q`, and the small motions about it.
pub fn motion(
    machine: &InterpretedMachine,
    q: &[f64],
    wanted: &Wanted,
) -> Result<SteadyMotion, Failure> {
    let motion = steady::motion(machine, q, wanted);
    let motion =
        motion.map_err(|none| Failure::Run(none.in_words(&machine.prepare(), wanted, OPTIONS)))?;
    // At a corner dual numbers take some slope between the slopes of its sides.
    let smooth = model::check_smooth(machine, &motion);
    smooth.map_err(|none| Failure::Run(none.in_words(&machine.prepare(), OPTIONS)))?;
    Ok(motion)
}

/// Compiles a spec for a purpose, `modes` or a `linear model`, and refuses machines without support for it. Also gives the model in the
/// other chart, if the spec names one.
pub fn compiled<'d, 'a>(
    (spec, start): (&call::Spec, &call::Start),
    dag: &'d Dag,
    files: impl IntoIterator<Item = &'a Destination>,
    noun: &str,
) -> Result<(Compiled<'d>, Option<Box<Model<'d>>>), Failure> {
    let with_sliding = format!(
        "friction can hold a machine at rest anywhere within a range, and sliding friction has no linearization at rest: a \
         machine with `sliding` has no {noun}; use a variant without friction, with a constraint in place of each guide"
    );
    let reading = Reading::open(spec)?.with_values(start);
    let mut cartesian = None;
    let (compiled, _) = compile(reading, dag, files, with_sliding, |model| {
        cartesian = model.cartesian.take();
        Ok(())
    })?;
    Ok((compiled, cartesian))
}

/// Compiles an opened spec for derivatives of motions, and gives its source texts too; `change` modifies its model before it is derived.
pub fn compiled_with<'d, 'a>(
    reading: Reading,
    dag: &'d Dag,
    files: impl IntoIterator<Item = &'a Destination>,
    noun: &str,
    change: impl FnOnce(&mut Model<'d>) -> Result<(), Failure>,
) -> Result<(Compiled<'d>, Sources), Failure> {
    let with_sliding = format!(
        "finding the {noun} of a machine with `sliding` requires derivatives of its motion, which do not exist where it begins to stick or to \
         slide; use a variant without friction, with a constraint in place of each guide"
    );
    compile(reading, dag, files, with_sliding, change)
}

/// Compiles an opened spec; `change` modifies its model before it is derived. The message explains why `sliding` is not supported.
fn compile<'d, 'a>(
    mut reading: Reading,
    dag: &'d Dag,
    files: impl IntoIterator<Item = &'a Destination>,
    with_sliding: String,
    change: impl FnOnce(&mut Model<'d>) -> Result<(), Failure>,
) -> Result<(Compiled<'d>, Sources), Failure> {
    let mut model = reading.model(dag);
    reading.keep_from(files)?;
    if let Some(model) = &model
        && !model.sliding().is_empty()
    {
        return Err(Failure::Run(with_sliding));
    }
    if let Some(model) = &mut model {
        let derivatives = model.derivatives.clone();
        change(model)?;
        // Across impacts the proved program itself is differentiated, so no derivatives need to be derived.
        if !model.contacts.is_empty() {
            model.derivatives = derivatives;
        }
    }
    let compiled = model.and_then(|model| Compiled::new(model, &mut reading.report));
    match compiled {
        Some(compiled) => {
            reading.warn();
            Ok((compiled, reading.sources))
        }
        None => Err(reading.failure()),
    }
}

/// The unit of the rate of a coordinate.
fn rate_unit(coordinates: &Named, name: &str) -> String {
    let unit = coordinates.unit(name).unwrap_or("1");
    format!("({unit})/s")
}

/// Which coordinates move steadily, and their rates.
fn wanted(search: &call::Search, rates: &mut Named) -> Result<Wanted, Failure> {
    let mut steady = vec![false; rates.values.len()];
    let mut solved = steady.clone();
    for call::Steady { name, rate } in &search.steady {
        let mut probe = rates.clone();
        probe.values.fill(0.0);
        let unknown = |unknown| reading::name_error("coordinate", &unknown);
        probe.set(name, 1.0).map_err(unknown)?;
        if let call::SteadyRate::Given(set) = rate {
            let unit = rate_unit(rates, name);
            reading::assign(rates, set, "--steady", &unit).map_err(|failure| match failure {
                Failure::Call(message) => {
                    Failure::Call(format!("{message}; or `solve`, to find the rate"))
                }
                other => other,
            })?;
        }
        for (k, probed) in probe.values.iter().enumerate() {
            if *probed != 0.0 {
                steady[k] = true;
                solved[k] |= *rate == call::SteadyRate::Solved;
            }
        }
    }
    Ok(Wanted {
        steady,
        solved,
        rates: rates.values.clone(),
        steps: search::MOST_STEPS,
    })
}

/// Refuses a machine whose equations depend on time, because it is at rest nowhere.
fn refuse_drives(machine: &InterpretedMachine, q: &[f64], wanted: &Wanted) -> Result<(), Failure> {
    let Err(names) = steady::drives(machine, q, wanted) else {
        return Ok(());
    };
    let help = if names.is_empty() {
        "give the drive a parameter that stops it, or a coordinate of its own".to_owned()
    } else {
        format!(
            "it comes to rest with --set {}=0",
            names.join("=0, or --set ")
        )
    };
    Err(Failure::Run(format!(
        "the machine is driven: its equations change with time, so it has no equilibrium; {help}"
    )))
}

/// Whether a coordinate moves.
fn is_moving(names: &[&str], motion: &SteadyMotion) -> bool {
    let mut rates = names.iter().zip(&motion.v);
    rates.any(|(name, v)| *v != 0.0 && state_of(name).is_none())
}

/// The name of a coordinate; for the integral of a state of first order the name of the state.
fn shown_name(name: &str) -> String {
    state_of(name).unwrap_or_else(|| name.to_owned())
}

fn as_json(names: &[&str], motion: &SteadyMotion) -> Value {
    let by_name = |values: &[f64]| -> Map<String, Value> {
        let pairs = names.iter().zip(values);
        let pairs = pairs.filter(|(name, _)| state_of(name).is_none());
        pairs
            .map(|(name, x)| ((*name).to_owned(), json!(x)))
            .collect()
    };
    let states = names.iter().zip(&motion.v);
    let states: Map<String, Value> = states
        .filter_map(|(name, x)| Some((state_of(name)?, json!(x))))
        .collect();
    let Modes {
        modes,
        free,
        drifts,
        lost,
        lost_below,
    } = &motion.modes;
    let modes: Vec<Value> = modes
        .iter()
        .map(|mode| {
            let shape = names.iter().zip(&mode.shape).zip(&motion.records);
            let shape: Map<String, Value> = shape
                .filter(|((name, _), is_record)| !**is_record || state_of(name).is_some())
                .map(|((name, x), _)| (shown_name(name), json!([x.re, x.im])))
                .collect();
            json!({
                "kind": mode.kind(),
                "re": mode.lambda.re,
                "im": mode.lambda.im,
                "error": mode.error,
                "frequency": mode.lambda.im / TAU,
                "damping": damping(mode.lambda),
                "shape": shape,
            })
        })
        .collect();
    let mut equilibrium = json!({
        "q": by_name(&motion.found.place.q()),
        "v": by_name(&motion.v),
        "steps": motion.found.steps,
        "free": free,
        "drifts": drifts,
    });
    if !states.is_empty() {
        equilibrium["states"] = Value::Object(states);
    }
    json!({
        "equilibrium": equilibrium,
        "modes": modes,
        "lost": {"modes": lost, "below": lost_below},
    })
}

/// Prints the results along `--vary`, and writes the files.
fn show(
    call: &call::Modes,
    machine: &InterpretedMachine,
    trace: &Trace,
    files: &Files,
) -> Result<(), Failure> {
    let system = machine.prepare();
    let names: Vec<&str> = system.coordinates().map(|q| q.name).collect();
    if let Some(file) = &files.out {
        let units: Vec<&str> = system.coordinates().map(|q| q.unit).collect();
        let columns = columns(&names, &units, trace);
        let columns: Vec<(String, &[f64])> = columns
            .iter()
            .map(|(header, values)| (header.clone(), values.as_slice()))
            .collect();
        table::write_columns(&columns, file)?;
    }
    if let Some(file) = &files.plot {
        let drawing = locus::svg(machine.name(), trace).map_err(Failure::Run)?;
        file.write_text(&drawing)?;
    }
    if call.spec.json {
        let motions = trace.points.iter().map(|point| {
            let mut entry = match &point.motion {
                Ok(motion) => as_json(&names, motion),
                Err(why) => json!({ "error": why }),
            };
            entry["value"] = json!(point.value);
            entry["continues"] = json!(point.continues);
            entry
        });
        let critical = trace.critical.iter().map(|critical| {
            json!({
                "value": critical.value,
                "error": critical.error,
                "growing": critical.growing,
                "oscillating": critical.oscillating,
                "re": critical.lambda.map(|lambda| lambda.re),
                "im": critical.lambda.map(|lambda| lambda.im),
            })
        });
        let result = json!({
            "vary": {"name": trace.name, "unit": trace.unit},
            "critical": critical.collect::<Vec<_>>(),
            "motions": motions.collect::<Vec<_>>(),
        });
        output::line(format_args!("{result:#}"));
    } else {
        output::text(&text_of_trace(trace));
    }
    Ok(())
}

/// A table with a row for each mode at each value.
fn columns(names: &[&str], units: &[&str], trace: &Trace) -> Vec<(String, Vec<f64>)> {
    let with = |name: &str, unit: &str| match unit {
        "1" => name.to_owned(),
        unit => format!("{name} [{unit}]"),
    };
    let mut headers = vec![with(&trace.name, &trace.unit)];
    headers.extend(
        [
            "mode",
            "re [1/s]",
            "im [1/s]",
            "error [1/s]",
            "frequency [Hz]",
        ]
        .map(str::to_owned),
    );
    let is_place: Vec<bool> = names.iter().map(|name| state_of(name).is_none()).collect();
    let of_places = names.iter().zip(units).zip(&is_place);
    let of_places = of_places.filter(|(_, is_place)| **is_place);
    headers.extend(of_places.map(|((name, unit), _)| with(name, unit)));
    let rates = names.iter().zip(units);
    headers.extend(rates.map(|(name, unit)| with(&rate_name(name, ""), &unit_of_rate(name, unit))));
    let mut columns: Vec<(String, Vec<f64>)> = headers
        .into_iter()
        .map(|header| (header, Vec::new()))
        .collect();
    for point in &trace.points {
        let Ok(motion) = &point.motion else { continue };
        for (index, mode) in motion.modes.modes.iter().enumerate() {
            let Mode { lambda, error, .. } = mode;
            let of_mode = [
                point.value,
                index as f64 + 1.0,
                lambda.re,
                lambda.im,
                *error,
                lambda.im / TAU,
            ];
            let q = motion.found.place.q().into_iter().zip(&is_place);
            let q = q.filter(|(_, is_place)| **is_place).map(|(q, _)| q);
            let row = of_mode.into_iter().chain(q).chain(motion.v.iter().copied());
            for ((_, column), x) in columns.iter_mut().zip(row) {
                column.push(x);
            }
        }
    }
    columns
}

/// The ranges in which motions grow or do not exist, and the critical values.
fn text_of_trace(trace: &Trace) -> String {
    let mut text = String::new();
    let unit = match trace.unit.as_str() {
        "1" => String::new(),
        unit => format!(" {unit}"),
    };
    let [first, last] = [trace.points.first(), trace.points.last()];
    let [first, last] = [first, last].map(|point| point.map_or(0.0, |point| point.value));
    let kind = if trace.wanted.steady.contains(&true) {
        "steady motions"
    } else {
        "equilibria"
    };
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "{kind} along {} from {} to {}{unit}, {} values:",
        trace.name,
        number(first),
        number(last),
        trace.points.len()
    );
    // A description of each value; consecutive values with the same description are merged into one line.
    let words = |point: &vary::Point| match &point.motion {
        Ok(motion) => {
            let growing = motion
                .modes
                .modes
                .iter()
                .filter(|mode| mode.lambda.re > 0.0)
                .count();
            match growing {
                0 => "no mode grows".to_owned(),
                1 => "1 mode grows".to_owned(),
                count => format!("{count} modes grow"),
            }
        }
        Err(why) => format!("no solution is found: {why}"),
    };
    let mut index = 0;
    while let Some(point) = trace.points.get(index) {
        let description = words(point);
        let later_points = &trace.points[index + 1..];
        let more = later_points.iter().take_while(|next| {
            words(next) == description && (next.continues || next.motion.is_err())
        });
        let count = more.count();
        let end = &trace.points[index + count];
        let range = match count {
            0 => number(point.value),
            _ => format!("{} to {}", number(point.value), number(end.value)),
        };
        let jump = match (point.motion.is_ok(), point.continues, index) {
            (true, false, 1..) => " (a different motion from before)",
            _ => "",
        };
        let _ = writeln!(text, "  {range}{unit}: {description}{jump}");
        index += count + 1;
    }
    for critical in &trace.critical {
        let Critical {
            value,
            growing,
            oscillating,
            lambda,
            ..
        } = critical;
        let _ = write!(
            text,
            "\ncritical {} = {}{unit}: ",
            trace.name,
            number(*value)
        );
        let count = |list: &[usize; 2], verb: [&str; 2]| {
            let before = match list[0] {
                0 => "no mode".to_owned(),
                1 => "1 mode".to_owned(),
                n => format!("{n} modes"),
            };
            let after = match list[1] {
                0 => "none".to_owned(),
                n => n.to_string(),
            };
            let verb = verb[usize::from(list[0] > 1)];
            format!("{before} {verb} before it, {after} after it")
        };
        let mut parts = Vec::new();
        if growing[0] != growing[1] {
            parts.push(count(growing, ["grows", "grow"]));
        }
        if oscillating[0] != oscillating[1] {
            parts.push(count(oscillating, ["oscillates", "oscillate"]));
        }
        text.push_str(&parts.join("; "));
        match lambda {
            Some(lambda) if lambda.im > 0.0 => {
                let _ = write!(text, ", at {} Hz", number(lambda.im / TAU));
            }
            _ => {}
        }
        text.push('\n');
    }
    text
}

/// The position of a steady motion, with one line for each coordinate.
pub fn text_of_place(
    names: &[&str],
    units: &[&str],
    start: &[f64],
    wanted: &Wanted,
    motion: &SteadyMotion,
) -> String {
    let mut text = String::new();
    let width = names
        .iter()
        .map(|name| shown_name(name).chars().count())
        .max();
    let width = width.unwrap_or(0);
    let found = &motion.found;
    let times = if found.steps == 1 { "step" } else { "steps" };
    let kind = if wanted.steady.contains(&true) {
        "steady motion"
    } else {
        "equilibrium"
    };
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "{kind}, found in {} {times} from the start:",
        found.steps
    );
    for (k, (name, q)) in names.iter().zip(found.place.q()).enumerate() {
        if let Some(state) = state_of(name) {
            let unit = match unit_of_rate(name, units[k]).as_str() {
                "1" => String::new(),
                unit => format!(" {unit}"),
            };
            let _ = writeln!(text, "  {state:width$}  {}{unit}", number(motion.v[k]));
            continue;
        }
        let (moved, unit) = (q - start[k], units[k]);
        // Round-off, in rad or m, is not shown.
        let q = if q.abs() <= 1e-12 { 0.0 } else { q };
        let moved = if moved.abs() <= 1e-12 { 0.0 } else { moved };
        let unit = if unit == "1" {
            String::new()
        } else {
            format!(" {unit}")
        };
        let _ = write!(text, "  {name:width$}  {}{unit}", number(q));
        if motion.v[k] != 0.0 || wanted.solved[k] {
            let verb = if unit == " rad" { "turning" } else { "moving" };
            let _ = write!(text, ", {verb} at {}{unit}/s", number(motion.v[k]));
            if wanted.solved[k] {
                text.push_str(" (found)");
            }
        }
        if moved != 0.0 {
            let _ = write!(text, ", moved by {}", number(moved));
        }
        text.push('\n');
    }
    text
}

fn text(
    names: &[&str],
    units: &[&str],
    start: &[f64],
    wanted: &Wanted,
    motion: &SteadyMotion,
) -> String {
    let mut text = String::new();
    let width = names
        .iter()
        .map(|name| shown_name(name).chars().count())
        .max();
    let width = width.unwrap_or(0);
    let modes = &motion.modes;
    text.push_str(&text_of_place(names, units, start, wanted, motion));
    if modes.free > 0 {
        let directions = directions(modes.free);
        let _ = writeln!(
            text,
            "its position is not unique: it can change in {} independent {directions}",
            modes.free
        );
    }
    if is_moving(names, motion) && modes.drifts > 0 {
        let directions = directions(modes.drifts);
        let _ = writeln!(
            text,
            "its rates are not unique: they can change in {} independent {directions}",
            modes.drifts
        );
    }
    for (index, mode) in modes.modes.iter().enumerate() {
        let Complex { re, im } = mode.lambda;
        let _ = write!(text, "\nmode {}: ", index + 1);
        let _ = match (mode.kind(), damping(mode.lambda)) {
            ("free", _) => {
                if mode.error > 0.0 {
                    writeln!(text, "free, or slower than {} rad/s", number(mode.error))
                } else {
                    writeln!(text, "free, without a restoring force")
                }
            }
            ("growing", _) => writeln!(
                text,
                "unstable, grows by a factor of e in {} s",
                number(1.0 / re)
            ),
            ("decaying", _) => writeln!(text, "decays by a factor of e in {} s", number(-1.0 / re)),
            (_, Some(ratio)) => {
                let _ = write!(text, "{} Hz, {} rad/s, ", number(im / TAU), number(im));
                if re > 0.0 {
                    let _ = write!(
                        text,
                        "unstable, grows by a factor of e in {} s, ",
                        number(1.0 / re)
                    );
                }
                writeln!(text, "damping ratio {}", number(ratio))
            }
            _ => writeln!(text),
        };
        // All six printed digits must be correct.
        if mode.error > 0.5e-6 * mode.lambda.norm() && mode.kind() != "free" {
            let error = number(mode.error);
            let _ = writeln!(text, "  accurate only to {error} rad/s");
        }
        for (name, x) in names.iter().zip(&mode.shape) {
            // Amplitudes that are negligible beside 1, in rad or m, are not printed; `--json` includes them.
            if x.norm() > 1e-12 {
                let name = shown_name(name);
                let _ = writeln!(text, "  {name:width$}  {}", amplitude(*x));
            }
        }
    }
    let Modes {
        lost, lost_below, ..
    } = modes;
    if *lost > 0 {
        let (motions, are) = if *lost == 1 {
            ("motion", "is")
        } else {
            ("motions", "are")
        };
        let below = number(*lost_below);
        let _ = writeln!(
            text,
            "\n{lost} more {motions} {are} slower than {below} rad/s, too slow compared with the others to be distinguished from rest"
        );
    }
    text
}

fn directions(count: usize) -> &'static str {
    if count == 1 {
        "direction"
    } else {
        "directions"
    }
}

/// A number with six digits, or fewer if exact.
pub fn number(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    match rounded.abs() {
        0.0 => "0".into(),
        1e-3..1e6 => format!("{rounded}"),
        _ => format!("{rounded:e}"),
    }
}

/// A real amplitude with its sign, any other with its phase in degrees.
fn amplitude(x: Complex<f64>) -> String {
    // A phase that is round-off is dropped.
    if x.im.abs() <= 1e-9 * x.norm() {
        return number(x.re);
    }
    let degrees = format!("{:.1}", x.arg().to_degrees());
    format!("{} at {degrees}°", number(x.norm()))
}
