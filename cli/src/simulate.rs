//! `lagrangian simulate`: the motion of a machine.

use std::cell::Cell;
use std::io::IsTerminal;

use indicatif::{ProgressBar, ProgressStyle};
use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::methods::{METHODS, Method};
use lagrangian::{Energies, Error, Machine, Simulation, Solution, System};
use lagrangian_spec::diagnostic::nearest;
use lagrangian_symbolic::Dag;
use serde_json::{Map, Value, json};

use crate::call;
use crate::contacts::{self, Contacts, Found};
use crate::evaluate::set_start;
use crate::failure::Failure;
use crate::output;
use crate::reading::{self, Reading};
use crate::recording::{Column, Kind, Recording};
use crate::report::{self, Report};
use crate::{plot, table};

/// How often a run is recorded where the call does not say.
const SAMPLES: f64 = 1000.0;

/// More rows than this are a slip of the hand: at nine coordinates they fill a gigabyte.
const MOST_SAMPLES: f64 = 5e6;

/// Ticks of the progress bar.
const TICKS: u64 = 1000;

/// A run of a machine read from a spec.
pub type Run = Solution<InterpretedMachine>;

/// Runs the command.
///
/// # Errors
/// If the spec, the run or the call is at fault. What there is of a run that ends early is written and summarized first.
pub fn run(call: &call::Simulate) -> Result<(), Failure> {
    let method = method(&call.method)?;
    let dag = Dag::new();
    let compiled = Reading::open(&call.spec)?.compile(&dag)?;
    let machine = reading::machine(compiled.program.clone(), &call.start)?;
    machine.check_parameters().map_err(|missing| {
        Failure::Run(format!(
            "{missing}; set them with --set {}=…",
            missing.names.join("=… --set ")
        ))
    })?;
    let mut start = machine.start();
    set_start(&mut start, &call.start)?;

    let recorded = call.out.is_some() || call.plot.is_some() || call.report.is_some();
    let interval = call.every.unwrap_or(call.until.abs() / SAMPLES);
    let finer = match call.report {
        Some(_) => {
            let shared = call.out.is_some() || call.plot.is_some();
            report::finer(start.q.values.len(), call.until, interval, shared)
        }
        None => 1,
    };
    let contacts = Contacts::new(&compiled.model, &machine);
    let bar = progress_bar(call.spec.json);
    let shown = Cell::new(0);
    let mut simulation = Simulation::new(&machine)
        .tolerance(call.tolerance)
        .method(method)
        .until(call.until)
        .energy_balance(true)
        .forget_steps()
        .progress(|progress| {
            let ticks = (progress.fraction * TICKS as f64) as u64;
            if ticks > shown.replace(ticks) {
                bar.set_position(ticks);
            }
        });
    if recorded && call.until != 0.0 {
        if call.until.abs() / interval.abs() > MOST_SAMPLES {
            return Err(Failure::Call(format!(
                "--every {interval:e} would record more than {MOST_SAMPLES:e} instants"
            )));
        }
        simulation = simulation.every(interval / f64::from(finer));
    }
    let simulation = contacts.watch(simulation);
    let (run, error) = simulation.run_as_far_as_possible(start).map_err(cause)?;
    bar.finish_and_clear();
    let contacts = contacts.found(&run);

    if recorded {
        let recording = record(&run);
        write(call, machine.name(), &recording.each(finer as usize))?;
        if let Some(path) = &call.report {
            let report = Report {
                call,
                compiled: &compiled,
                contacts: &contacts,
                machine: &machine,
                method,
                run: &run,
                recording: &recording,
                error: error.as_ref(),
            };
            std::fs::write(path, report.page()).map_err(|error| {
                Failure::Call(format!("cannot write {}: {error}", path.display()))
            })?;
        }
    }
    if call.spec.json {
        output::line(format_args!(
            "{:#}",
            document(&run, &contacts, error.as_ref())
        ));
    } else {
        print_summary(&machine, method, &run, &contacts);
    }
    match error {
        None => Ok(()),
        Some(error) => {
            eprintln!("error: {error}");
            Err(Failure::Said)
        }
    }
}

fn method(name: &str) -> Result<&'static Method, Failure> {
    Method::named(name).ok_or_else(|| {
        let names = || METHODS.iter().map(|method| method.tableau.name);
        let help = match nearest(name, names()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("there are: {}", names().collect::<Vec<_>>().join(", ")),
        };
        Failure::Call(format!("no method named `{name}`; {help}"))
    })
}

/// Settings are the fault of the call, everything else that of the machine or the run.
fn cause(error: Error) -> Failure {
    match error {
        Error::InvalidSetting {
            setting,
            value,
            needed,
        } => {
            // One option sets both tolerances of the library.
            let option = if matches!(setting, "relative" | "absolute") {
                "tolerance"
            } else {
                setting
            };
            Failure::Call(format!("--{option} {value:e}: must be {needed}"))
        }
        error => Failure::run(error),
    }
}

fn progress_bar(json: bool) -> ProgressBar {
    if json || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:50} {percent:>3} %  {elapsed} ({eta} left)");
    let bar = ProgressBar::new(TICKS);
    match style {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

fn write(call: &call::Simulate, name: &str, recording: &Recording) -> Result<(), Failure> {
    if let Some(path) = &call.out {
        let written = table::write(recording, path);
        written
            .map_err(|error| Failure::Call(format!("cannot write {}: {error}", path.display())))?;
    }
    if let Some(path) = &call.plot {
        let svg = plot::svg(name, recording).map_err(Failure::Run)?;
        let written = std::fs::write(path, svg);
        written
            .map_err(|error| Failure::Call(format!("cannot write {}: {error}", path.display())))?;
    }
    Ok(())
}

/// The samples of a run, with what can be observed at each.
pub fn record(run: &Run) -> Recording {
    let system = run.system();
    // A run without length has no samples.
    let states = match run.samples() {
        [] => std::slice::from_ref(run.start()),
        states => states,
    };
    let mut columns: Vec<Column> = Vec::new();
    let mut column = |name: String, unit: String, kind| {
        columns.push(Column {
            name,
            unit,
            kind,
            values: Vec::with_capacity(states.len()),
        })
    };
    for quantity in system.coordinates() {
        column(quantity.name.into(), quantity.unit.into(), Kind::Coordinate);
    }
    for quantity in system.coordinates() {
        let unit = match quantity.unit {
            "1" => "1/s".into(),
            unit => format!("{unit}/s"),
        };
        column(format!("der({})", quantity.name), unit, Kind::Rate);
    }
    let start = run.start();
    let (q, v) = (&start.q.values, &start.v.values);
    let outputs = system.outputs(start.t, q, v, &vec![0.0; q.len()], &system.default_inputs());
    for (quantity, _) in system.output_values(&outputs) {
        column(quantity.name.into(), quantity.unit.into(), Kind::Output);
    }
    for constraint in system.constraints() {
        let name = format!("multiplier({})", constraint.name);
        column(name, constraint.multiplier_unit.into(), Kind::Multiplier);
    }
    for name in system.contacts() {
        for (what, unit) in [("normal", "N"), ("friction", "N"), ("slip", "m/s")] {
            column(format!("{what}({name})"), unit.into(), Kind::Contact);
        }
    }
    for name in ["kinetic energy", "potential energy", "total energy"] {
        column(name.into(), "J".into(), Kind::Energy);
    }
    column("energy residual".into(), "J".into(), Kind::Residual);

    let unknown = |count: usize| vec![f64::NAN; count];
    let reactions = system.constraints().len() + 3 * system.contacts().len();
    for state in states {
        // Where a run ends early there may be no accelerations, and then nothing that is made from them.
        let (outputs, reactions, energies) = match run.observe_state(state) {
            Ok(seen) => {
                let (kinetic, potential) = (seen.kinetic_energy, seen.potential_energy);
                let energies = [kinetic, potential, kinetic + potential];
                let contacts = seen.contacts.iter();
                let contacts = contacts.flat_map(|c| [c.normal, c.friction, c.slip]);
                let reactions = seen.multipliers.iter().copied().chain(contacts);
                (seen.outputs.values, reactions.collect(), energies)
            }
            Err(_) => {
                let outputs = unknown(outputs.values.len());
                (outputs, unknown(reactions), [f64::NAN; 3])
            }
        };
        let moving = state.q.values.iter().chain(&state.v.values).copied();
        let residual = residual_at(run.energies(), state.t);
        let observed = outputs.into_iter().chain(reactions);
        let row = moving.chain(observed).chain(energies).chain([residual]);
        for (column, value) in columns.iter_mut().zip(row) {
            column.values.push(value);
        }
    }
    Recording {
        times: states.iter().map(|state| state.t).collect(),
        columns,
    }
}

/// What is left over in the energy balance at a time: known at the ends of steps, interpolated between them.
fn residual_at(energies: &[Energies], t: f64) -> f64 {
    let Some(first) = energies.first() else {
        return 0.0;
    };
    let residual = |e: &Energies| {
        (e.kinetic + e.potential) - (first.kinetic + first.potential) - e.work + e.dissipated
    };
    let forward = energies.last().is_none_or(|last| last.t >= first.t);
    let next = energies.partition_point(|e| if forward { e.t < t } else { e.t > t });
    match (
        next.checked_sub(1).and_then(|before| energies.get(before)),
        energies.get(next),
    ) {
        (Some(a), Some(b)) => {
            let share = (t - a.t) / (b.t - a.t);
            residual(a) + share * (residual(b) - residual(a))
        }
        (Some(only), None) | (None, Some(only)) => residual(only),
        (None, None) => 0.0,
    }
}

fn by_name(numbers: &Named) -> Value {
    Value::Object(
        numbers
            .iter()
            .map(|(name, value)| (name.to_owned(), value.into()))
            .collect::<Map<_, _>>(),
    )
}

fn document(run: &Run, contacts: &[Found], error: Option<&Error>) -> Value {
    let statistics = run.statistics();
    let end = run.end();
    let events: Vec<Value> = contacts::other_events(run, contacts)
        .map(|event| json!({ "t": event.state.t, "name": event.name }))
        .collect();
    let warnings = run.warnings().iter().map(ToString::to_string);
    let warnings = warnings.chain(contacts.iter().flat_map(Found::warnings));
    let warnings: Vec<String> = warnings.collect();
    let mut document = json!({
        "t": end.t,
        "q": by_name(&end.q),
        "v": by_name(&end.v),
        "steps": statistics.steps,
        "rejected": statistics.rejected,
        "evaluations": statistics.evaluations,
        "seconds": statistics.seconds,
        "energy_residual": run.energy_balance().map(|balance| balance.residual()),
        "constraint_residual": statistics.constraint_residual,
        "events": events,
        "warnings": warnings,
    });
    if let Value::Object(fields) = &mut document {
        if !contacts.is_empty() {
            let contacts = contacts.iter().map(Found::json);
            fields.insert("contacts".into(), contacts.collect());
        }
        if let Some(error) = error {
            fields.insert("error".into(), error.to_string().into());
        }
    }
    document
}

/// The shortest text that reads back to the same number.
pub fn shortest(x: f64) -> String {
    match x.abs() {
        size if size == 0.0 || (1e-4..1e9).contains(&size) => x.to_string(),
        _ => format!("{x:e}"),
    }
}

fn print_summary(machine: &InterpretedMachine, method: &Method, run: &Run, contacts: &[Found]) {
    let statistics = run.statistics();
    let (start, end) = (run.start(), run.end());
    output::line(format_args!(
        "{}: t = {} s to {} s, {}",
        machine.name(),
        start.t,
        end.t,
        method.tableau.title
    ));
    output::line(format_args!(
        "  {} steps, {} rejected, {} evaluations, {:.3} s",
        statistics.steps, statistics.rejected, statistics.evaluations, statistics.seconds
    ));
    let width = end
        .q
        .iter()
        .map(|(name, _)| name.chars().count())
        .max()
        .unwrap_or(0);
    output::line(format_args!("  at the end"));
    for ((name, q), (_, v)) in end.q.iter().zip(end.v.iter()) {
        let pad = " ".repeat(width - name.chars().count());
        output::line(format_args!(
            "    {name}{pad} = {:<24} der({name}){pad} = {}",
            shortest(q),
            shortest(v)
        ));
    }
    if let Some(balance) = run.energy_balance() {
        output::line(format_args!("  energy [J]"));
        output::line(format_args!(
            "    at the start {:.6e}, at the end {:.6e}",
            balance.start, balance.end
        ));
        output::line(format_args!(
            "    work of drives and forces {:.6e}, dissipated {:.6e}",
            balance.work, balance.dissipated
        ));
        output::line(format_args!(
            "    left over {:.3e}, {:.1e} of what was turned over",
            balance.residual(),
            balance.relative()
        ));
    }
    if run.system().constraints().len() > 0 {
        output::line(format_args!(
            "  constraints: left over {:.1e} of their terms",
            statistics.constraint_residual
        ));
    }
    if !contacts.is_empty() {
        output::line(format_args!("  rolling contacts"));
    }
    for contact in contacts {
        output::line(format_args!("    {}", contact.line()));
    }
    for event in contacts::other_events(run, contacts) {
        output::line(format_args!(
            "  event {} at t = {} s",
            event.name, event.state.t
        ));
    }
    for warning in run.warnings() {
        output::line(format_args!("  warning: {warning}"));
    }
    for warning in contacts.iter().flat_map(Found::warnings) {
        output::line(format_args!("  warning: {warning}"));
    }
}
