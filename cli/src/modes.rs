//! `lagrangian modes`: equilibria and steady motions, and the modes about them.

mod locus;
pub mod vary;
mod words;

use std::f64::consts::TAU;

use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{Machine, Simulation, State, System};
use lagrangian_linear::model;
use lagrangian_linear::motion::SteadyMotion;
use lagrangian_linear::search::{self, Wanted};
use lagrangian_linear::spectrum::{Mode, Modes, damping};
use lagrangian_linear::steady::{self, Options};
use lagrangian_mechanics::Compiled;
use lagrangian_spec::model::Model;
use lagrangian_spec::source::Sources;
use lagrangian_symbolic::Dag;
use lagrangian_units::{rate_name, rate_unit as unit_of_rate, state_of};
use serde_json::{Map, Value, json};

use crate::call;
use crate::evaluate::{ended_assumptions, set_start};
use crate::failure::Failure;
pub use crate::numbers::number;
use crate::numbers::shown_name;
use crate::other_chart::{self, OtherChart};
use crate::output::{self, Destination, TABLE, keep_apart};
use crate::reading::{self, Reading};
use crate::table;
use vary::Trace;
pub use words::text_of_place;
use words::{text, text_of_trace};

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
        let out = (call.out.as_ref(), TABLE);
        let [out, plot] = Destination::out_and_plot(out, call.plot.as_ref(), call.spec.json)?;
        let files = Files { out, plot };
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
    let (machine, reached) = other_chart::search(found, || {
        let given = (&call.search.start, &call.search.keep);
        let chart = OtherChart::of(&compiled, cartesian, given, &start)?;
        let found = find_motion(&chart.machine, chart.start, &call.search);
        Some(found.map(|reached| (chart.machine, reached)))
    })?;
    let system = machine.prepare();
    let names: Vec<&str> = system.coordinates().map(|q| q.name).collect();
    if call.spec.json {
        let result = as_json(&names, &reached.motion);
        output::line(format_args!("{result:#}"));
    } else {
        let units: Vec<&str> = system.coordinates().map(|q| q.unit).collect();
        output::text(&text(&names, &units, &reached));
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
    let refused = |model: &Model<'d>| !model.sliding().is_empty();
    let (compiled, _) = compile(reading, dag, files, (refused, with_sliding), |model| {
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
    // Beside contacts, guides are followed from one change to the next as these are.
    let refused = |model: &Model<'d>| !model.sliding().is_empty() && model.contacts.is_empty();
    compile(reading, dag, files, (refused, with_sliding), change)
}

/// Compiles an opened spec; `change` modifies its model before it is derived. The message explains why the `sliding` of a model that is `refused` is not supported.
fn compile<'d, 'a>(
    mut reading: Reading,
    dag: &'d Dag,
    files: impl IntoIterator<Item = &'a Destination>,
    (refused, with_sliding): (impl Fn(&Model<'d>) -> bool, String),
    change: impl FnOnce(&mut Model<'d>) -> Result<(), Failure>,
) -> Result<(Compiled<'d>, Sources), Failure> {
    let mut model = reading.model(dag);
    reading.keep_from(files)?;
    if let Some(model) = &model
        && refused(model)
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
