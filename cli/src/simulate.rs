//! `lagrangian simulate`: the motion of a machine.

mod summary;

use std::iter;

use lagrangian::interpreted::{InterpretedMachine, Named, Signals};
use lagrangian::methods::{Method, TAYLOR};
use lagrangian::{
    Ending, Error, LEAST_RELATIVE_TOLERANCE, Machine, Simulation, State, System, Warning,
};
use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::series::ProvedSeries;
use lagrangian_spec::source::Sources;
use lagrangian_sweep::charts::{self, Charts};
use lagrangian_sweep::signals::{self, InputArgument};
use lagrangian_sweep::verdict;
use lagrangian_symbolic::Dag;
use serde_json::Value;

use crate::call;
use crate::contacts::{ContactSummary, Contacts};
use crate::failure::Failure;
use crate::global_error::{self, Estimate};
use crate::inputs;
use crate::interrupt::Interrupt;
use crate::machine_in_chart::MachineInChart;
use crate::methods::{self, AUTO};
use crate::numbers::shortest;
use crate::output::{self, Destination, PAGE, SVG, TABLE, keep_apart};
use crate::placed::Placed;
use crate::precise;
use crate::progress;
use crate::reading::{self, ChartUse, Reading};
use crate::recording::{Recording, Run};
use crate::report::{self, CallSettings, Live, Report};
use crate::{plot, table};

/// The default number of recorded samples of a run.
const SAMPLES: f64 = 1000.0;

/// More rows than this are assumed to be a mistake: with nine coordinates they fill a gigabyte.
const MOST_SAMPLES: f64 = 5e6;

/// The default tolerance.
const TOLERANCE: f64 = 1e-9;

/// More numbers than this in all rows are assumed to be a mistake: they fill 1.6 GB, and are stored twice for a moment.
const MOST_NUMBERS: f64 = 2e8;

/// Refuses an interval, given by an option, at which a run of this length has too many instants, or too many numbers if each
/// instant has a row of this width.
///
/// # Errors
/// If there are more than [`MOST_SAMPLES`] instants or [`MOST_NUMBERS`] numbers.
pub fn check_samples(
    option: &str,
    interval: f64,
    length: f64,
    width: usize,
) -> Result<(), Failure> {
    let instants = (length / interval).abs();
    if instants > MOST_SAMPLES {
        return Err(Failure::Call(format!(
            "{option} {interval:e} would record more than {MOST_SAMPLES:e} instants"
        )));
    }
    if instants * width as f64 > MOST_NUMBERS {
        return Err(Failure::Call(format!(
            "{option} {interval:e} would record more than {MOST_NUMBERS:e} numbers: {instants:.0} instants with {width} numbers each"
        )));
    }
    Ok(())
}

/// The number of numbers that are recorded of a machine with this many outputs at each instant, at most.
pub fn width(machine: &InterpretedMachine, outputs: usize) -> usize {
    /// The time, three energies, and the residual of their balance.
    const ALWAYS: usize = 5;
    /// Normal reaction, friction and slip of a guided contact.
    const OF_GUIDE: usize = 3;
    /// Gap, normal reaction, friction, slip, crushing work and loss of a unilateral contact.
    const OF_CONTACT: usize = 6;
    let system = machine.prepare();
    ALWAYS
        + 2 * system.coordinates().count()
        + outputs
        + system.default_inputs().values.len()
        + system.constraints().len()
        + OF_GUIDE * system.contacts().len()
        + OF_CONTACT * system.unilateral_contacts().len()
}

/// The files that a call requests.
struct Files {
    out: Option<Destination>,
    plot: Option<Destination>,
    report: Option<Destination>,
}

impl Files {
    fn new(call: &call::Simulate, written: &[(String, InputArgument)]) -> Result<Files, Failure> {
        let files = Files {
            out: Destination::of("--out", call.out.as_ref(), TABLE)?,
            plot: Destination::of("--plot", call.plot.as_ref(), SVG)?,
            report: Destination::of("--report", call.report.as_ref(), PAGE)?,
        };
        output::keep_document_apart(files.all(), call.spec.json)?;
        let spec = (call.spec.path.as_path(), "the spec");
        let read: Vec<_> = iter::once(spec).chain(inputs::files(written)).collect();
        keep_apart(files.all(), &read)?;
        Ok(files)
    }

    fn all(&self) -> impl Iterator<Item = &Destination> {
        [&self.out, &self.plot, &self.report].into_iter().flatten()
    }
}

/// Why a run ended early, and which files could not be written.
#[derive(Default)]
struct Trouble<'a> {
    /// The error that ended it, and its place in the spec, if it has one.
    error: Option<&'a Error>,
    placed: Option<Placed>,
    /// Whether the user interrupted it by Ctrl-C.
    is_interrupted: bool,
    /// Whether the user interrupted the estimate of its error, after it had reached its end.
    is_estimate_interrupted: bool,
    /// Further errors.
    other: Vec<String>,
}

impl Trouble<'_> {
    /// All reasons for an error status, each as a sentence.
    fn errors(&self) -> Vec<String> {
        let error = self.error.map(verdict::message_of);
        error
            .into_iter()
            .chain(self.other.iter().cloned())
            .collect()
    }

    /// The message that the user interrupted the run.
    fn interruption(&self, run: &Run, until: f64) -> Option<String> {
        let (t, until) = (shortest(run.end().t), shortest(until));
        self.is_interrupted.then(|| {
            format!(
                "the run was interrupted at t = {t} s, of {until} s; everything here ends there"
            )
        })
    }
}

/// Runs the command.
///
/// # Errors
/// If the spec or the call is invalid, or the run fails. The part of a run that ends early is written and summarized first.
pub fn run(call: &call::Simulate) -> Result<(), Failure> {
    check_one_of(call)?;
    if call.precision == call::Precision::Dd {
        return precise::in_double_doubles(call);
    }
    if call.validated {
        return precise::validated(call);
    }
    let (tolerance, method) = (tolerance(call)?, method(call)?);
    check_tolerance_is_used(call, method)?;
    let written = inputs::parse(&call.inputs)?;
    let files = Files::new(call, &written)?;
    let dag = Dag::new();
    let prepared = Prepared::new(call, &dag, (&files, &written), (method, tolerance))?;
    let watched = Contacts::new(&prepared.compiled.model, &prepared.machine);
    let interrupt = Interrupt::watch();
    let (run, error) = prepared.run(call, &files, &watched, &interrupt)?;
    let mut trouble = Trouble {
        error: error.as_ref(),
        placed: error.as_ref().and_then(|error| prepared.placed(error)),
        is_interrupted: matches!(run.ending(), Ending::Stopped),
        is_estimate_interrupted: false,
        other: verdict::energy_error(&run).into_iter().collect(),
    };
    let contacts = watched.results(&run);
    let mut global_error = None;
    if call.global_error && *run.ending() == Ending::End {
        match prepared.global_error(call, &run, &interrupt) {
            Ok(estimate) => global_error = Some(estimate),
            Err(why) => trouble.other.push(why),
        }
        trouble.is_estimate_interrupted = interrupt.was_pressed();
    }
    if files.all().next().is_some() {
        progress::now("writing");
        let recording = record(&run);
        let stride = prepared.refinement(call, &files) as usize;
        let charts = prepared.charts.as_ref();
        let states = recorded_states(&run);
        let table = charts.map(|charts| charts.in_polar(&recording, states));
        let table = table.as_ref().unwrap_or(&recording).each(stride);
        let written = write(&files, prepared.machine.name(), &table);
        trouble.other.extend(written);
        if let Some(file) = &files.report {
            let recording = match charts {
                Some(charts) => charts.with_polar(&recording, states),
                None => recording,
            };
            let report = Report {
                asked: &call_settings(call, tolerance),
                compiled: &prepared.compiled,
                contacts: &contacts,
                machine: &prepared.machine,
                method: prepared.method,
                run: (&run).into(),
                recording: &recording,
                error: error.as_ref().map(ToString::to_string),
                is_interrupted: trouble.is_interrupted,
            };
            let written = prepared.write_page(call, &report, run.warnings(), file);
            trouble.other.extend(written.err());
        }
    }
    print(
        call,
        &prepared,
        &run,
        &contacts,
        global_error.as_ref(),
        &trouble,
    )
}

/// Refuses `--one-of` where the number of runs has no effect.
fn check_one_of(call: &call::Simulate) -> Result<(), Failure> {
    let is_chosen = call.method == AUTO && call.precision == call::Precision::F64;
    if call.one_of.is_some() && (!is_chosen || call.validated) {
        return Err(Failure::Call(
            "--one-of: only with --method auto, which chooses when to derive a series; other methods do not depend on the number of runs"
                .into(),
        ));
    }
    Ok(())
}

/// Refuses `--tolerance` with a method that has none.
fn check_tolerance_is_used(call: &call::Simulate, method: &Method) -> Result<(), Failure> {
    if call.tolerance.is_some() && has_no_tolerance(method) {
        return Err(Failure::Call(format!(
            "`{}` has no --tolerance: the length of its steps, --longest-step, determines the error",
            call.method
        )));
    }
    Ok(())
}

/// The tolerance of the call.
fn tolerance(call: &call::Simulate) -> Result<f64, Failure> {
    let tolerance = call.tolerance.unwrap_or(TOLERANCE);
    if tolerance < LEAST_RELATIVE_TOLERANCE {
        return Err(Failure::Call(format!(
            "--tolerance {}: the least tolerance is {LEAST_RELATIVE_TOLERANCE:.1e}, which is the limit of round-off; \
             --precision dd allows finer ones",
            shortest(tolerance)
        )));
    }
    Ok(tolerance)
}

/// The method with which a run begins.
fn method(call: &call::Simulate) -> Result<&'static Method, Failure> {
    if call.method == AUTO {
        return Ok(<&Method>::default());
    }
    methods::named_or(&call.method, &[AUTO])
}

/// Whether a method uses no tolerance: its steps have a fixed length, and it solves no equations of a step, or solves them to round-off.
fn has_no_tolerance(method: &Method) -> bool {
    method.has_fixed_steps() && method.tableau.name != "generalized-alpha"
}

/// A machine that is ready to run, with the settings of its run. If the spec names another chart, all of it is in that chart.
struct Prepared<'d> {
    compiled: Compiled<'d>,
    machine: InterpretedMachine,
    signals: Signals,
    method: &'static Method,
    /// Why the method is not the one of the call, if it is not.
    other_method: Option<String>,
    tolerance: f64,
    start: State<Named>,
    /// How the run is shown in the coordinates of the spec, if it is in others.
    charts: Option<Charts>,
    /// The texts of the spec.
    sources: Sources,
}

impl<'d> Prepared<'d> {
    fn new(
        call: &call::Simulate,
        dag: &'d Dag,
        (files, written): (&Files, &[(String, InputArgument)]),
        (mut method, tolerance): (&'static Method, f64),
    ) -> Result<Prepared<'d>, Failure> {
        let mut reading = Reading::open(&call.spec)?.with_values(&call.start);
        let laws = reading.drive(written)?;
        let formulas = reading.formulas();
        let compiled = reading.compile_in_charts(dag, files.all(), ChartUse::Required);
        let compiled = compiled.map_err(inputs::as_call_failure)?;
        if call.live && compiled.cartesian.is_some() {
            return Err(Failure::Call(
                "--live: the page cannot run a machine with `charts`; leave out --live, or leave `charts` out of the spec"
                    .into(),
            ));
        }
        let MachineInChart {
            mut compiled,
            mut machine,
            start,
            charts,
            series: text_of_series,
            sources,
        } = MachineInChart::new(compiled, &call.start, &call.keep, ChartUse::Required)?;
        // Formulas of inputs are not outputs of the machine.
        let output_count = compiled.model.outputs.len() - formulas;
        compiled.model.outputs.truncate(output_count);
        let mut numbers = output_count..;
        let signals = signals::signals(&laws, &machine, || numbers.next().unwrap_or(output_count));
        let signals = signals.map_err(Failure::Call)?;
        let mut other_method = None;
        if call.method == AUTO {
            machine = machine.with_series_on_demand(move || text_of_series.derive());
        } else if std::ptr::eq(method, &TAYLOR) {
            machine = machine
                .with_contact_series_on_demand(move || text_of_series.derive_with_contacts());
        }
        if std::ptr::eq(method, &TAYLOR) {
            progress::now("deriving the series");
            let series = ProvedSeries::derive(&compiled.model);
            let reason = series.as_ref().err().map(ToString::to_string);
            let reason = reason.or_else(|| signals::without_series(&signals, &machine));
            if let Some(reason) = reason {
                method = <&Method>::default();
                other_method = Some(warn_without_series(&reason, method));
            }
            machine = machine.with_series(series);
        }
        if call.live
            && let Some(objection) = report::live::reason_not_live(
                &compiled.program,
                method,
                !laws.is_empty(),
                &call.keep.names,
            )
        {
            return Err(Failure::Call(objection));
        }
        Ok(Prepared {
            compiled,
            machine,
            signals,
            method,
            other_method,
            tolerance,
            start,
            charts,
            sources,
        })
    }

    /// An error of the run with its place in the spec, if it has one.
    fn placed(&self, error: &Error) -> Option<Placed> {
        Placed::of(error, &self.compiled.model, &self.sources)
    }

    /// A state of the run in the coordinates of the spec.
    fn shown(&self, state: &State<Named>) -> State<Named> {
        charts::shown(self.charts.as_ref(), state)
    }

    /// By which factor the run is recorded more densely than requested, as the page of the run needs it.
    fn refinement(&self, call: &call::Simulate, files: &Files) -> u32 {
        if files.report.is_none() {
            return 1;
        }
        let shared = files.out.is_some() || files.plot.is_some();
        let coordinates = self.start.q.values.len();
        report::recording_refinement(coordinates, call.until, interval(call), shared)
    }

    /// A simulation with the settings of the call.
    fn simulation<'r>(
        &'r self,
        call: &'r call::Simulate,
        tolerance: f64,
        interrupt: &'r Interrupt,
    ) -> Simulation<'r, InterpretedMachine, Signals> {
        let simulation = self
            .signals
            .drive(Simulation::new(&self.machine), &self.machine)
            .tolerance(tolerance)
            .method(self.method)
            .until(call.until)
            .longest_step(call.longest_step.unwrap_or(f64::INFINITY))
            .max_steps(call.max_steps)
            .forget_steps()
            .stop_if(move |_| interrupt.was_pressed());
        let simulation = reading::keep(simulation, &call.keep);
        if call.method == AUTO {
            simulation.automatic().one_of(call.one_of.unwrap_or(1))
        } else {
            simulation
        }
    }

    /// Runs the machine as far as possible.
    fn run(
        &self,
        call: &call::Simulate,
        files: &Files,
        contacts: &Contacts,
        interrupt: &Interrupt,
    ) -> Result<(Run, Option<Error>), Failure> {
        progress::at(self.start.t, 0.0, 0);
        progress::run(call.until);
        let mut has_warned = false;
        let mut simulation = self
            .simulation(call, self.tolerance, interrupt)
            .energy_balance(true)
            .progress(|now| {
                progress::at(now.t, now.fraction, now.steps);
                // Reported at once, not after hours of running.
                if let Some(t) = now
                    .stiff_since
                    .filter(|_| !std::mem::replace(&mut has_warned, true))
                {
                    output::print_error(format_args!(
                        "warning: {}: --method radau5",
                        Warning::Stiff { t }
                    ));
                }
            });
        let mut marked_every = f64::INFINITY;
        if files.all().next().is_none() {
            // Only the end is reported, and events if they are asked for.
            simulation = simulation.forget_energies().forget_contact_phases();
            if !call.spec.json {
                simulation = simulation.forget_contact_events();
            }
        } else if call.until != 0.0 {
            let interval = interval(call);
            let width = width(&self.machine, self.compiled.model.outputs.len());
            check_samples("--every", interval, call.until, width)?;
            marked_every = interval / f64::from(self.refinement(call, files));
            simulation = simulation.every(marked_every);
        }
        if call.spec.json && !self.compiled.model.contacts.is_empty() {
            // States are also shown at the events of contacts.
            marked_every = 0.0;
        }
        if let Some(charts) = &self.charts {
            simulation = simulation.each_step(move |step| charts.follow(step, marked_every));
        }
        contacts
            .watch(simulation, !self.signals.is_empty())
            .run_interpreted_as_far_as_possible(self.start.clone())
            .map_err(|error| match self.placed(&error) {
                Some(placed) => Failure::Placed(Box::new(placed)),
                None => cause(error),
            })
    }

    /// Estimates the error at the end of a run.
    ///
    /// # Errors
    /// Why there is no estimate.
    fn global_error(
        &self,
        call: &call::Simulate,
        run: &Run,
        interrupt: &Interrupt,
    ) -> Result<Estimate, String> {
        progress::now("estimating the error");
        let again = |tolerance: f64, start: State<Named>| {
            let simulation = self.simulation(call, tolerance, interrupt);
            let again = simulation.run_interpreted(start).ok()?;
            (*again.ending() == Ending::End).then(|| again.end().clone())
        };
        let is_driven = !self.signals.is_empty();
        let estimated_run = global_error::EstimatedRun {
            machine: &self.machine,
            series: (!is_driven).then(|| ProvedSeries::derive(&self.compiled.model)),
            tolerance: self.tolerance,
            has_fixed_steps: self.method.has_fixed_steps(),
            max_steps: call.max_steps,
        };
        let is_stopped = || interrupt.was_pressed();
        global_error::estimate(estimated_run, (run.start(), run.end()), again, &is_stopped)
    }

    /// Writes the page of a run.
    ///
    /// # Errors
    /// If the file cannot be written, or the page cannot run the machine since a constraint is redundant.
    fn write_page(
        &self,
        call: &call::Simulate,
        report: &Report<'_, '_>,
        warnings: &[Warning],
        file: &Destination,
    ) -> Result<(), String> {
        let mut warnings = warnings.iter();
        let redundant = warnings.find(|it| matches!(it, Warning::RedundantConstraint { .. }));
        if let Some(warning) = redundant.filter(|_| call.live) {
            let spec = call.spec.path.file_name().unwrap_or_default();
            return Err(report::live::without_constraint(
                warning,
                self.machine.name(),
                &spec.to_string_lossy(),
            ));
        }
        let page = if call.live {
            report.page_that_runs(&Live {
                tolerance: self.tolerance,
                most_steps: call.max_steps,
                stated: &self.start,
            })
        } else {
            report.page()
        };
        file.write_text(&page).map_err(Failure::message)
    }
}

/// Warns that there is no Taylor series, so that another method is used; returns the warning.
fn warn_without_series(reason: &str, method: &Method) -> String {
    let name = method.tableau.name;
    let warning = format!("no Taylor series: {reason}; {name} is used");
    output::print_error(format_args!("warning: {warning}"));
    warning
}

/// The interval at which a run is recorded, in s.
fn interval(call: &call::Simulate) -> f64 {
    call.every.unwrap_or(call.until.abs() / SAMPLES)
}

/// Prints the results and the errors of a run.
///
/// # Errors
/// If there are errors, or the run was interrupted.
fn print(
    call: &call::Simulate,
    prepared: &Prepared<'_>,
    run: &Run,
    contacts: &[ContactSummary],
    global_error: Option<&Estimate>,
    trouble: &Trouble<'_>,
) -> Result<(), Failure> {
    let interruption = trouble.interruption(run, call.until);
    let errors = trouble.errors();
    if call.spec.json {
        let mut document =
            summary::document(call, prepared, run, contacts, (&interruption, &errors));
        if let (Some(estimate), Value::Object(fields)) = (global_error, &mut document) {
            fields.insert("global_error".into(), estimate.json(run.end()));
        }
        if let (Some(placed), Value::Object(fields)) = (&trouble.placed, &mut document) {
            fields.insert("place".into(), placed.place().into());
        }
        output::line(format_args!("{document:#}"));
    } else {
        summary::print(call, prepared, run, contacts);
        for line in global_error
            .into_iter()
            .flat_map(|estimate| estimate.lines(run.end()))
        {
            output::line(format_args!("  {line}"));
        }
        if let Some(interruption) = &interruption {
            output::line(format_args!("  {interruption}"));
        }
    }
    if let Some(placed) = &trouble.placed {
        crate::diagnostics::print_placed(placed);
    }
    // The error that ended the run is the first.
    for error in errors.iter().skip(usize::from(trouble.placed.is_some())) {
        output::print_error(format_args!("error: {error}"));
    }
    match (errors.is_empty(), interruption) {
        (false, _) if trouble.is_estimate_interrupted => Err(Failure::Interrupted),
        (false, _) => Err(Failure::AlreadyReported),
        (true, Some(_)) => Err(Failure::Interrupted),
        (true, None) => Ok(()),
    }
}

/// The settings of the call for the page of a run.
fn call_settings(call: &call::Simulate, tolerance: f64) -> CallSettings {
    let file = call.spec.path.file_name();
    let inputs = call.inputs.iter();
    CallSettings {
        file: file.map_or_else(String::new, |name| name.to_string_lossy().into_owned()),
        tolerance: shortest(tolerance),
        constants: call
            .spec
            .constants
            .iter()
            .map(|(name, _)| name.clone())
            .collect(),
        inputs: inputs
            .map(|input| (input.name.clone(), input.value.clone()))
            .collect(),
    }
}

/// Invalid settings are errors of the call; everything else is a failure of the machine or the run.
fn cause(error: Error) -> Failure {
    match error {
        Error::InvalidSetting {
            setting: "longest_step",
            value: f64::INFINITY,
            ..
        } => Failure::Call(
            "the method takes steps of a fixed length: give this length, as in --longest-step 1e-3"
                .into(),
        ),
        // Settings that the parser of options accepted.
        Error::InvalidSetting {
            setting,
            value,
            needed,
        } => {
            // One option sets both tolerances of the library.
            let option = match setting {
                "relative" | "absolute" => "--tolerance",
                "sampled" => "--input …,every=",
                "delay" => "--input …,delay=",
                "longest_step" => "--longest-step",
                _ => &format!("--{setting}"),
            };
            let value = shortest(value);
            Failure::Call(format!("{option} {value}: must be {needed}"))
        }
        error => Failure::run(error),
    }
}

/// Writes table and drawing; returns the errors.
fn write(files: &Files, name: &str, recording: &Recording) -> Vec<String> {
    let table = files.out.as_ref().map(|file| table::write(recording, file));
    let drawing = files.plot.as_ref().map(|file| {
        let svg = plot::svg(name, recording).map_err(Failure::Run)?;
        file.write_text(&svg)
    });
    let written = [table, drawing].into_iter().flatten();
    written
        .filter_map(Result::err)
        .map(Failure::message)
        .collect()
}

/// The samples of a run, with all observable quantities at each.
pub fn record(run: &Run) -> Recording {
    Recording::of(run, recorded_states(run))
}

/// The samples of a run; a run of length zero has only its start.
pub fn recorded_states(run: &Run) -> &[State<Named>] {
    match run.samples() {
        [] => std::slice::from_ref(run.start()),
        states => states,
    }
}
