//! `lagrangian modes`: where a machine stays, and how it moves about that place.

mod locus;
mod motion;
mod precise;
mod rank;
mod reduced;
mod search;
mod spectrum;
mod vary;

use std::f64::consts::TAU;
use std::fmt::Write as _;

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named};
use lagrangian::{Machine, Simulation, System};
use lagrangian_mechanics::Compiled;
use lagrangian_program::Role;
use lagrangian_symbolic::Dag;
use nalgebra::Complex;
use serde_json::{Map, Value, json};

use crate::call;
use crate::evaluate::set_start;
use crate::failure::Failure;
use crate::output::{self, Destination, SVG, TABLE, keep_apart};
use crate::reading::{self, Reading};
use crate::table;
use motion::{Motion, State, Unsteady};
use reduced::{Fault, Place, Reduced};
use search::{Lost, Wanted};
use spectrum::{Mode, Modes};
use vary::{Critical, Trace};

/// The files that a call asks for.
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
/// If the spec or the call is at fault, or the machine has no equilibrium near its start.
pub fn run(call: &call::Modes) -> Result<(), Failure> {
    let files = Files::new(call)?;
    let dag = Dag::new();
    let compiled = compiled(&call.spec, &dag, &files)?;
    let machine = reading::machine(&compiled, &call.start)?;
    machine.check_parameters().map_err(|missing| {
        Failure::Run(format!(
            "{missing}; set them with --set {}=…",
            missing.names.join("=… --set ")
        ))
    })?;
    reading::check_kept(&machine.start(), &call.keep)?;
    if let Some(vary) = &call.vary {
        let trace = vary::trace(call, vary, &compiled, &machine)?;
        return show(call, &machine, &trace, &files);
    }
    let mut start = machine.start();
    set_start(&mut start, &call.start)?;
    let wanted = wanted(call, &mut start.v)?;
    let q = start.q.values.clone();
    refuse_drives(&machine, &q, &wanted)?;
    start.v.values = rates(&wanted);
    let from = on_constraints(&machine, &call.keep, start)?;
    let motion = motion(&machine, &from, &wanted)?;
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

/// The pose from which to look: where something of the start is kept, the start of a run, which keeps it.
fn on_constraints(
    machine: &InterpretedMachine,
    keep: &call::Keep,
    start: lagrangian::State<Named>,
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
    let run = reading::keep(simulation, keep).run(start);
    Ok(run.map_err(Failure::run)?.start().q.values.clone())
}

/// The steady motion that is reached from `q`, and the motions near it.
fn motion(machine: &InterpretedMachine, q: &[f64], wanted: &Wanted) -> Result<Motion, Failure> {
    let system = machine.prepare();
    let inputs = system.default_inputs().values;
    let rates: Vec<f64> = rates(wanted);
    let mut reduced = Reduced::new(machine, &system, &inputs, &states(q, &rates));
    let found = search::find(&mut reduced, q, wanted);
    let found = found.map_err(|lost| match start_is_unsteady(&mut reduced, q, wanted) {
        // What depends on where it is cannot be balanced for long either.
        Some(unsteady) => failure_of(&system, &unsteady),
        None => failure(&system, wanted, &lost),
    })?;
    let motion = motion::near(&mut reduced, found, &wanted.steady);
    motion.map_err(|unsteady| failure_of(&system, &unsteady))
}

/// Rates of the coordinates that move steadily.
fn rates(wanted: &Wanted) -> Vec<f64> {
    let rates = wanted.rates.iter().zip(&wanted.steady);
    rates
        .map(|(rate, is_steady)| if *is_steady { *rate } else { 0.0 })
        .collect()
}

/// Whether the equations depend, where the search begins, on what is to move steadily.
fn start_is_unsteady(reduced: &mut Reduced<'_>, q: &[f64], wanted: &Wanted) -> Option<Unsteady> {
    if !wanted.steady.contains(&true) {
        return None;
    }
    let mut wide: Vec<_> = q.iter().map(|x| (*x).into()).collect();
    reduced.bring(&mut wide, &|_| true).ok()?;
    let choice = reduced.choose(q, &wanted.steady).ok()?;
    let s = choice.independent.iter().map(|j| match wanted.steady[*j] {
        true => wanted.rates[*j].into(),
        false => 0.0.into(),
    });
    let place = Place {
        s: s.collect(),
        q: wide,
    };
    let (here, bounds) = reduced.linearized(&choice, &place).ok()?;
    let state = State {
        choice: &choice,
        place: &place,
        here: &here,
        bounds: &bounds,
    };
    motion::records(reduced, &state).err()
}

/// The program, as far as nothing sticks in it.
fn compiled<'d>(spec: &call::Spec, dag: &'d Dag, files: &Files) -> Result<Compiled<'d>, Failure> {
    let mut reading = Reading::open(spec)?;
    let model = reading.model(dag);
    reading.keep_from(files.all())?;
    if model
        .as_ref()
        .is_some_and(|model| !model.sliding().is_empty())
    {
        return Err(Failure::run(
            "friction holds a machine that is at rest wherever it stands within a range, and what slides has no linearization there: a \
             machine with `sliding` has no modes; take them of a variant without friction, with a constraint in the place of \
             each guide",
        ));
    }
    if model
        .as_ref()
        .is_some_and(|model| !model.contacts.is_empty())
    {
        return Err(Failure::run(
            "what collides has no linearization: a machine with `contacts` has no modes; say it without them",
        ));
    }
    let compiled = model.and_then(|model| Compiled::new(model, &mut reading.report));
    match compiled {
        Some(compiled) => {
            reading.warn();
            Ok(compiled)
        }
        None => Err(reading.failure()),
    }
}

/// The unit of the rate of a coordinate.
fn rate_unit(coordinates: &Named, name: &str) -> String {
    let unit = coordinates.unit(name).unwrap_or("1");
    format!("({unit})/s")
}

/// Which coordinates turn steadily, and with which rates.
fn wanted(call: &call::Modes, rates: &mut Named) -> Result<Wanted, Failure> {
    let mut steady = vec![false; rates.values.len()];
    let mut solved = steady.clone();
    for call::Steady { name, rate } in &call.steady {
        let mut probe = rates.clone();
        probe.values.fill(0.0);
        let unknown = |unknown| reading::name_error("coordinate", &unknown);
        probe.set(name, 1.0).map_err(unknown)?;
        if let call::SteadyRate::Given(set) = rate {
            let unit = rate_unit(rates, name);
            reading::assign(rates, set, "--steady", &unit).map_err(|failure| match failure {
                Failure::Call(said) => {
                    Failure::Call(format!("{said}; or `solve`, to find the rate"))
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

/// The start, and two states beside it that have nothing in common.
fn states(q: &[f64], v: &[f64]) -> [(Vec<f64>, Vec<f64>); 3] {
    let beside = |list: &[f64], seed: usize| -> Vec<f64> {
        let shift = |k: usize| 0.01 + ((seed + 7 * k) * 29 % 97) as f64 / 997.0;
        list.iter()
            .enumerate()
            .map(|(k, x)| x + shift(k) * x.abs().max(1.0))
            .collect()
    };
    [
        (q.to_vec(), v.to_vec()),
        (beside(q, 1), beside(v, 2)),
        (beside(q, 3), beside(v, 4)),
    ]
}

/// Refuses a machine whose equations change with time: it is at rest nowhere.
fn refuse_drives(machine: &InterpretedMachine, q: &[f64], wanted: &Wanted) -> Result<(), Failure> {
    let reads_time = |role: &Role| {
        let function = machine.program().function(*role);
        function.is_some_and(|function| function.reads().time)
    };
    let roles = [
        Role::MassMatrix,
        Role::Forces,
        Role::ConstraintMatrix,
        Role::ConstraintRates,
        Role::ConstraintDrift,
        Role::ConstraintPositions,
    ];
    if !roles.iter().any(reads_time) {
        return Ok(());
    }
    let states = states(q, &rates(wanted));
    // A drive that parameters hold still, `cos(0*t)`, gives the same numbers at all times. What has none is no answer.
    let stands_still = |machine: &InterpretedMachine| {
        let system = machine.prepare();
        let inputs = system.default_inputs().values;
        Reduced::new(machine, &system, &inputs, &[]).stands_still(&states)
    };
    if stands_still(machine) {
        return Ok(());
    }
    // Nor is a machine without inertia, on which the drive has no hold either.
    let is_regular = |machine: &InterpretedMachine| {
        let system = machine.prepare();
        Reduced::new(machine, &system, &[], &[]).is_regular(&states)
    };
    let has_inertia = is_regular(machine);
    let stops = |name: &&str| {
        let mut still = machine.clone();
        still.set(name, 0.0).is_ok() && (is_regular(&still) || !has_inertia) && stands_still(&still)
    };
    let names: Vec<String> = machine
        .parameters()
        .map(|(parameter, _)| parameter.name.to_owned())
        .collect();
    let names: Vec<&str> = names.iter().map(String::as_str).filter(stops).collect();
    let help = match names.is_empty() {
        true => "give the drive a parameter that stops it, or a coordinate of its own".to_owned(),
        false => format!(
            "it stands still with --set {}=0",
            names.join("=0, or --set ")
        ),
    };
    Err(Failure::Run(format!(
        "the machine is driven: its equations change with time, so that it is at rest nowhere; {help}"
    )))
}

fn name(system: &InterpretedSystem, index: usize) -> String {
    let coordinate = system.coordinates().nth(index);
    coordinate.map_or_else(|| "?".to_owned(), |coordinate| coordinate.name.to_owned())
}

fn failure_of(system: &InterpretedSystem, unsteady: &Unsteady) -> Failure {
    let name = |index: &usize| name(system, *index);
    Failure::Run(match unsteady {
        Unsteady::Depends(index) => format!(
            "`{}` cannot turn steadily: the equations of motion depend on where it is",
            name(index)
        ),
        Unsteady::Follows(index, other) => format!(
            "`{}` cannot turn steadily: the rate of `{}` changes with it, and the equations of motion depend on where that is",
            name(other),
            name(index)
        ),
        Unsteady::Fault(fault) => what(system, fault),
        Unsteady::NoEigenvalues => "the eigenvalues cannot be found".to_owned(),
    })
}

fn what(system: &InterpretedSystem, fault: &Fault) -> String {
    let name = |index: &usize| name(system, *index);
    match fault {
        Fault::Singular(index) => format!(
            "the mass matrix is singular in `{}` on the way to an equilibrium; --start sets another place to look from",
            name(index)
        ),
        Fault::NotFinite(index) => format!(
            "the acceleration of `{}`, or a derivative of it, is not finite on the way to an equilibrium; --start sets another \
             place to look from",
            name(index)
        ),
        Fault::Follows(index) => format!(
            "--steady {0}: by the constraints the rate of `{0}` follows from the others; leave it out, or one of those",
            name(index)
        ),
        Fault::Unmet(index) => {
            let constraint = system.constraints().nth(*index);
            let name = constraint.map_or_else(|| "?".to_owned(), |c| c.name.to_owned());
            format!(
                "the constraint `{name}` cannot be met near the start; --start sets another place to look from"
            )
        }
    }
}

fn failure(system: &InterpretedSystem, wanted: &Wanted, lost: &Lost) -> Failure {
    let kind = match wanted.steady.contains(&true) {
        true => "steady motion",
        false => "equilibrium",
    };
    let place = match wanted.steady.contains(&true) {
        true => "--start sets another place to look from, --steady other rates",
        false => "--start sets another place to look from",
    };
    Failure::Run(match lost {
        Lost::Fault(fault) => what(system, fault),
        Lost::Accelerates(index, left) => format!(
            "there is no {kind} near the start: nothing takes the acceleration {left:.3e} of `{}` away; {place}",
            name(system, *index)
        ),
        Lost::NoEnd(steps) => {
            let times = if *steps == 1 { "step" } else { "steps" };
            format!("no {kind} was found in {steps} {times} from the start; {place}")
        }
    })
}

/// What a mode is.
fn kind(mode: &Mode) -> &'static str {
    let Complex { re, im } = mode.lambda;
    match (re > 0.0, re < 0.0, im > 0.0) {
        (false, false, false) => "free",
        (true, _, true) => "growing oscillation",
        (true, _, false) => "growing",
        (_, true, false) => "decaying",
        _ => "oscillation",
    }
}

/// Of an oscillation `−Re λ/|λ|`; a motion without one has no ratio.
fn damping(mode: &Mode) -> Option<f64> {
    (mode.lambda.im > 0.0).then(|| 0.0 - mode.lambda.re / mode.lambda.norm())
}

fn as_json(names: &[&str], motion: &Motion) -> Value {
    let by_name = |values: &[f64]| -> Map<String, Value> {
        let pairs = names.iter().zip(values);
        pairs
            .map(|(name, x)| ((*name).to_owned(), json!(x)))
            .collect()
    };
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
                .filter(|(_, is_record)| !**is_record)
                .map(|((name, x), _)| ((*name).to_owned(), json!([x.re, x.im])))
                .collect();
            json!({
                "kind": kind(mode),
                "re": mode.lambda.re,
                "im": mode.lambda.im,
                "error": mode.error,
                "frequency": mode.lambda.im / TAU,
                "damping": damping(mode),
                "shape": shape,
            })
        })
        .collect();
    json!({
        "equilibrium": {
            "q": by_name(&motion.found.place.q()),
            "v": by_name(&motion.v),
            "steps": motion.found.steps,
            "free": free,
            "drifts": drifts,
        },
        "modes": modes,
        "lost": {"modes": lost, "below": lost_below},
    })
}

/// Prints what was found along `--vary`, and writes its files.
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

/// A table with a row for each mode of each value.
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
    headers.extend(names.iter().zip(units).map(|(name, unit)| with(name, unit)));
    headers.extend(names.iter().zip(units).map(|(name, unit)| match *unit {
        "1" => format!("der({name}) [1/s]"),
        unit => format!("der({name}) [{unit}/s]"),
    }));
    let mut columns: Vec<(String, Vec<f64>)> = headers
        .into_iter()
        .map(|header| (header, Vec::new()))
        .collect();
    for point in &trace.points {
        let Ok(motion) = &point.motion else { continue };
        for (index, mode) in motion.modes.modes.iter().enumerate() {
            let Mode { lambda, error, .. } = mode;
            let own = [
                point.value,
                index as f64 + 1.0,
                lambda.re,
                lambda.im,
                *error,
                lambda.im / TAU,
            ];
            let q = motion.found.place.q();
            let row = own.into_iter().chain(q).chain(motion.v.iter().copied());
            for ((_, column), x) in columns.iter_mut().zip(row) {
                column.push(x);
            }
        }
    }
    columns
}

/// Where motions grow along the range, where there are none, and what is critical.
fn text_of_trace(trace: &Trace) -> String {
    let mut text = String::new();
    let unit = match trace.unit.as_str() {
        "1" => String::new(),
        unit => format!(" {unit}"),
    };
    let [first, last] = [trace.points.first(), trace.points.last()];
    let [first, last] = [first, last].map(|point| point.map_or(0.0, |point| point.value));
    let kind = match trace.wanted.steady.contains(&true) {
        true => "steady motions",
        false => "equilibria",
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
    // What holds of each value, in words; a stretch of values with the same words is one line.
    let words = |point: &vary::Point| match &point.motion {
        Ok(motion) => {
            let growing = motion
                .modes
                .modes
                .iter()
                .filter(|mode| mode.lambda.re > 0.0)
                .count();
            match growing {
                0 => "none grows".to_owned(),
                1 => "1 motion grows".to_owned(),
                count => format!("{count} motions grow"),
            }
        }
        Err(why) => format!("nothing is found: {why}"),
    };
    let mut index = 0;
    while let Some(point) = trace.points.get(index) {
        let said = words(point);
        let rest = &trace.points[index + 1..];
        let more = rest
            .iter()
            .take_while(|next| words(next) == said && (next.continues || next.motion.is_err()));
        let count = more.count();
        let end = &trace.points[index + count];
        let range = match count {
            0 => number(point.value),
            _ => format!("{} to {}", number(point.value), number(end.value)),
        };
        let jump = match (point.motion.is_ok(), point.continues, index) {
            (true, false, 1..) => " (another motion than before)",
            _ => "",
        };
        let _ = writeln!(text, "  {range}{unit}: {said}{jump}");
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
            let word = |n: usize| match n {
                0 => "none".to_owned(),
                n => n.to_string(),
            };
            let verb = verb[usize::from(list[0] > 1)];
            format!(
                "{} {verb} before it, {} after it",
                word(list[0]),
                word(list[1])
            )
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

fn text(names: &[&str], units: &[&str], start: &[f64], wanted: &Wanted, motion: &Motion) -> String {
    let mut text = String::new();
    let width = names.iter().map(|name| name.chars().count()).max();
    let width = width.unwrap_or(0);
    let (found, modes) = (&motion.found, &motion.modes);
    let times = if found.steps == 1 { "step" } else { "steps" };
    let what = match wanted.steady.contains(&true) {
        true => "steady motion",
        false => "equilibrium",
    };
    // Writing to a String cannot fail.
    let _ = writeln!(text, "{what}, {} {times} from the start:", found.steps);
    for (k, (name, q)) in names.iter().zip(found.place.q()).enumerate() {
        let (moved, unit) = (q - start[k], units[k]);
        // What is nothing but rounding, in rad or m, is not shown.
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
                text.push_str(" as found");
            }
        }
        if moved != 0.0 {
            let _ = write!(text, ", moved by {}", number(moved));
        }
        text.push('\n');
    }
    if modes.free > 0 {
        let ways = if modes.free == 1 { "way" } else { "ways" };
        let _ = writeln!(
            text,
            "it may stand elsewhere as well, in {} {ways}",
            modes.free
        );
    }
    if motion.v.iter().any(|v| *v != 0.0) && modes.drifts > 0 {
        let ways = if modes.drifts == 1 { "way" } else { "ways" };
        let _ = writeln!(
            text,
            "it may move steadily at other rates, in {} {ways}",
            modes.drifts
        );
    }
    for (index, mode) in modes.modes.iter().enumerate() {
        let Complex { re, im } = mode.lambda;
        let _ = write!(text, "\nmode {}: ", index + 1);
        let _ = match (kind(mode), damping(mode)) {
            ("free", _) => {
                let _ = write!(text, "free, nothing brings it back");
                match mode.error > 0.0 {
                    true => writeln!(text, " faster than {} rad/s", number(mode.error)),
                    false => writeln!(text),
                }
            }
            ("growing", _) => writeln!(text, "unstable, grows by e in {} s", number(1.0 / re)),
            ("decaying", _) => writeln!(text, "decays by e in {} s", number(-1.0 / re)),
            (_, Some(ratio)) => {
                let _ = write!(text, "{} Hz, {} rad/s, ", number(im / TAU), number(im));
                if re > 0.0 {
                    let _ = write!(text, "unstable, grows by e in {} s, ", number(1.0 / re));
                }
                writeln!(text, "damping ratio {}", number(ratio))
            }
            _ => writeln!(text),
        };
        // Of six digits that are printed, all are right.
        if mode.error > 0.5e-6 * mode.lambda.norm() && kind(mode) != "free" {
            let error = number(mode.error);
            let _ = writeln!(text, "  known no better than to {error} rad/s");
        }
        for (name, x) in names.iter().zip(&mode.shape) {
            // Beside an amplitude of 1, in rad or m, the rest is nothing to look at; with --json it is there.
            if x.norm() > 1e-12 {
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
            "\n{lost} more {motions} {are} slower than {below} rad/s, too slow beside the others to be told from rest"
        );
    }
    text
}

/// Six digits, or fewer where they say as much.
fn number(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    match rounded.abs() {
        0.0 => "0".into(),
        1e-3..1e6 => format!("{rounded}"),
        _ => format!("{rounded:e}"),
    }
}

/// A real amplitude with its sign, any other with its phase in degrees.
fn amplitude(x: Complex<f64>) -> String {
    // Rounding leaves no phase.
    if x.im.abs() <= 1e-9 * x.norm() {
        return number(x.re);
    }
    let degrees = format!("{:.1}", x.arg().to_degrees());
    format!("{} at {degrees}°", number(x.norm()))
}
