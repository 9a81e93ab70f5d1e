//! Runs given as tables, or made from specs instead.

use std::path::{Path, PathBuf};

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named, TableFile};
use lagrangian::methods::{Method, TAYLOR};
use lagrangian::{InputLaw, Machine, Simulation, Solution, State, System};
use lagrangian_analysis::Curve;
use lagrangian_analysis::curve::Interpolation;
use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::stage;
use lagrangian_spec::resolve::value_in;
use lagrangian_spec::source::Sources;
use lagrangian_sweep::charts::{self, Charts};
use lagrangian_sweep::plan::Law;
use lagrangian_sweep::{signals, verdict};
use lagrangian_symbolic::{Dag, Stage};

use crate::call::{self, Assignment};
use crate::exactness::Exactness;
use crate::failure::{Failure, help_with};
use crate::machine_in_chart::MachineInChart;
use crate::output::{self, Destination, MACHINE, TABLE, ending_is_one_of, keep_apart};
use crate::placed::Placed;
use crate::reading::{self, ChartUse, Reading};
use crate::recording::{ColumnKind, Recording, Run};
use crate::{inputs, methods, progress, simulate};

/// The default number of recorded samples of a run.
const SAMPLES: f64 = 1000.0;

/// The default limit of steps of a run.
pub const STEPS: usize = 10_000_000;

/// What is done with a run.
const ANALYSING: &str = "analysing the run";

/// The default tolerance of a run.
pub const TOLERANCE: f64 = 1e-9;

/// A column of a run.
#[derive(Clone, Debug)]
pub struct Quantity {
    /// Its name.
    pub name: String,
    /// Its unit, if known.
    pub unit: Option<String>,
    /// Its values.
    pub values: Vec<f64>,
    /// Its kind, for the run of a spec.
    pub kind: Option<ColumnKind>,
}

impl Quantity {
    /// Whether there are instants, and none with a value.
    pub fn is_empty(&self) -> bool {
        !self.values.is_empty() && self.values.iter().all(|value| !value.is_finite())
    }

    /// The header of the column: `theta [rad]`.
    pub fn header(&self) -> String {
        header(&self.name, self.unit.as_deref())
    }
}

/// The header of a column: `theta [rad]`.
pub fn header(name: &str, unit: Option<&str>) -> String {
    match unit {
        None | Some("1") => name.to_owned(),
        Some(unit) => format!("{name} [{unit}]"),
    }
}

/// A run, column by column.
#[derive(Clone, Debug)]
pub struct Columns {
    /// The instants, in s, increasing.
    pub times: Vec<f64>,
    /// The columns; all as long as `times`.
    pub columns: Vec<Quantity>,
    /// Whether it was made from a spec.
    pub is_spec: bool,
}

impl Columns {
    fn of(recording: Recording) -> Columns {
        let columns = recording.columns.into_iter().map(|column| Quantity {
            name: column.name,
            unit: Some(column.unit),
            values: column.values,
            kind: Some(column.kind),
        });
        Columns {
            times: recording.times,
            columns: columns.collect(),
            is_spec: true,
        }
    }

    fn of_table(file: &TableFile) -> Result<Columns, Failure> {
        let (mut times, mut columns) = (Vec::new(), Vec::new());
        for (name, unit) in file.columns() {
            let read = file.column_with_gaps(&name);
            let (column_times, values) = read.map_err(|wrong| Failure::Call(wrong.to_string()))?;
            times = column_times;
            columns.push(Quantity {
                name,
                unit,
                values,
                kind: None,
            });
        }
        Ok(Columns {
            times,
            columns,
            is_spec: false,
        })
    }

    /// The column of this name.
    pub fn get(&self, name: &str) -> Option<&Quantity> {
        self.columns.iter().find(|column| column.name == name)
    }

    /// The rates of a column, in its unit per second; `None` if there is no such column, or it has another unit.
    pub fn rates(&self, name: &str) -> Option<Vec<f64>> {
        let column = self.get(name)?;
        let rate = self.get(&format!("der({name})"))?;
        let wanted = column.unit.as_ref().map(|unit| format!("({unit})/s"));
        let factor = match (&rate.unit, &wanted) {
            (Some(rate), Some(wanted)) => factor(rate, wanted)?,
            _ => 1.0,
        };
        Some(rate.values.iter().map(|x| x * factor).collect())
    }

    /// The requested columns. By default these are the coordinates: for a table the columns with a column of rates, or all
    /// if there are none.
    ///
    /// # Errors
    /// If there is no such column.
    pub fn chosen(&self, lists: &[String], run: &Path) -> Result<Vec<&Quantity>, Failure> {
        let wanted = call::names_of_option("--of", lists)?;
        if wanted.is_empty() {
            let has_rates = |column: &&Quantity| match column.kind {
                Some(kind) => kind == ColumnKind::Coordinate,
                None => self.get(&format!("der({})", column.name)).is_some(),
            };
            let moving: Vec<&Quantity> = self.columns.iter().filter(has_rates).collect();
            return Ok(if moving.is_empty() {
                self.columns.iter().collect()
            } else {
                moving
            });
        }
        let mut chosen = Vec::new();
        for name in &wanted {
            // Of a family, all members: `q`, and `der(q)`.
            let member = match name.strip_suffix(')') {
                Some(inside) if inside.starts_with("der(") => format!("{inside}["),
                _ => format!("{name}["),
            };
            let matching = self.columns.iter();
            let matching =
                matching.filter(|column| column.name == *name || column.name.starts_with(&member));
            let before = chosen.len();
            chosen.extend(matching);
            if chosen.len() == before {
                return Err(unknown(name, self, run));
            }
        }
        call::refuse_twice("--of", chosen.iter().map(|column| column.name.as_str()))
            .map_err(Failure::Call)?;
        if let Some(column) = chosen.iter().find(|column| column.is_empty()) {
            return Err(Failure::Run(format!(
                "`{}` has no value at any instant",
                column.name
            )));
        }
        Ok(chosen)
    }

    /// The part of the run from a time on.
    pub fn after(mut self, t: Option<f64>) -> Columns {
        if let Some(t) = t {
            let first = self.times.partition_point(|row| *row < t);
            self.times.drain(..first);
            for column in &mut self.columns {
                column.values.drain(..first);
            }
        }
        self
    }

    /// Warns if a quantity has instants without a value, beside which nothing of it is found. Before its first value and after its
    /// last one it has simply not been measured.
    pub fn warn_of_gaps(&self, quantity: &Quantity) {
        let values = &quantity.values;
        let first = values.iter().position(|value| value.is_finite());
        let last = values.iter().rposition(|value| value.is_finite());
        let between = first.zip(last).map(|(first, last)| &values[first..last]);
        let missing = between.unwrap_or_default().iter();
        let missing = missing.filter(|value| !value.is_finite()).count();
        if missing > 0 {
            let plural = if missing == 1 { "" } else { "s" };
            output::print_error(format_args!(
                "warning: `{}` has no value at {missing} instant{plural} between others: what it does beside them is not found",
                quantity.name
            ));
        }
    }

    /// Warns if a quantity oscillates more than once in two rows, so that it seems to have other frequencies. Returns whether it does.
    pub fn warn_if_undersampled(&self, quantity: &Quantity) -> bool {
        let rates = self.rates(&quantity.name);
        let curve = self.curve(quantity, rates.as_deref(), call::Interpolation::Cubic);
        // Below this runs are not accurate.
        let is_undersampled = curve.is_undersampled(TOLERANCE);
        if is_undersampled {
            output::print_error(format_args!(
                "warning: `{}` oscillates more than once in two rows, as its rates show, so what is found here is not its motion: {}",
                quantity.name,
                if self.is_spec {
                    "record it with a smaller --every"
                } else {
                    "record a table with more rows"
                }
            ));
        }
        is_undersampled
    }

    /// A column as a function of time, with its rates if available.
    pub fn curve<'a>(
        &'a self,
        column: &'a Quantity,
        rates: Option<&'a [f64]>,
        between: call::Interpolation,
    ) -> Curve<'a> {
        let between = match between {
            call::Interpolation::Cubic => Interpolation::Hermite,
            call::Interpolation::Linear => Interpolation::Linear,
        };
        Curve::new(&self.times, &column.values, rates, between)
    }
}

/// The failure that there is no such column.
pub fn unknown(name: &str, columns: &Columns, run: &Path) -> Failure {
    let help = help_with(
        name,
        columns.columns.iter().map(|column| column.name.as_str()),
    );
    Failure::Call(format!(
        "--of {name}: {} has no quantity named `{name}`; {help}",
        run.display()
    ))
}

/// The factor between two units; `None` if they do not measure the same quantity.
pub fn factor(of: &str, unit: &str) -> Option<f64> {
    if of == unit {
        return Some(1.0);
    }
    let (mut sources, mut report) = (Sources::new(), Report::new());
    // A bare number would be interpreted in the other unit.
    let text = format!("1*({of})*s/s");
    let factor = value_in(&text, unit, &mut sources, &mut report);
    factor.filter(|factor| factor.is_finite() && *factor != 0.0)
}

/// Whether a path is a spec instead of a table.
///
/// # Errors
/// If it is neither.
pub fn is_spec(path: &Path) -> Result<bool, Failure> {
    match (
        ending_is_one_of(path, MACHINE),
        ending_is_one_of(path, TABLE),
    ) {
        (true, _) => Ok(true),
        (_, true) => Ok(false),
        _ => Err(Failure::Call(format!(
            "{}: expected a table, `.csv` or `.parquet`, or a spec, `.machine`",
            path.display()
        ))),
    }
}

/// Refuses options for running a spec if there is none.
///
/// # Errors
/// If there is such an option: which one.
pub fn refuse_without_spec(runs: &call::Runs) -> Result<(), Failure> {
    let options = [
        ("--const", !runs.constants.is_empty()),
        ("--until", runs.until.is_some()),
        ("--every", runs.every.is_some()),
        ("--tolerance", runs.tolerance.is_some()),
        ("--method", runs.method.is_some()),
        ("--max-steps", runs.max_steps.is_some()),
        ("--input", !runs.inputs.is_empty()),
        ("--set", !runs.start.parameters.is_empty()),
        ("--start", !runs.start.coordinates.is_empty()),
        ("--rate", !runs.start.rates.is_empty()),
        ("--keep", !runs.keep.names.is_empty()),
        ("--engine", runs.start.running.engine != call::Engine::Auto),
    ];
    match options.iter().find(|(_, is_given)| *is_given) {
        Some((option, _)) => Err(Failure::Call(format!(
            "{option} applies to runs of a spec, and there is none: a table is used as it is"
        ))),
        None => Ok(()),
    }
}

/// Reads a table.
///
/// # Errors
/// If the table is invalid: what is wrong with it.
pub fn table(path: &Path) -> Result<Columns, Failure> {
    progress::now("reading the table");
    let file = signals::table_file(path).map_err(Failure::Call)?;
    let columns = Columns::of_table(&file)?;
    progress::now(ANALYSING);
    Ok(columns)
}

/// The instants at which a run is sampled.
pub enum SampleInstants<'a> {
    /// At equal intervals.
    Even,
    /// At these, as far as they lie within the run.
    At(&'a [f64]),
    /// Where a formula crosses 0. If it says where a name has a value, these two come with it: the value of an output is in its unit.
    Crossing(&'a str, call::Direction, Option<(&'a str, &'a str)>),
    /// Once per period, which is a formula of parameters, in s.
    Period(&'a str),
}

/// The settings for running a spec.
pub struct Options<'a> {
    pub path: &'a PathBuf,
    pub runs: &'a call::Runs,
    pub start: call::Start,
    pub tolerance: Option<f64>,
    pub method: Option<&'a str>,
    pub until: f64,
}

impl<'a> Options<'a> {
    /// The settings that a call gives for all specs.
    ///
    /// # Errors
    /// If the call does not give the end of the run.
    pub fn of(path: &'a PathBuf, runs: &'a call::Runs, end: Option<f64>) -> Result<Self, Failure> {
        let until = runs.until.or(end).ok_or_else(|| {
            let path = path.display();
            Failure::Call(format!(
                "{path} is a spec: --until must say how long to run it"
            ))
        })?;
        Ok(Options {
            path,
            runs,
            start: call::Start {
                parameters: runs.start.parameters.clone(),
                coordinates: runs.start.coordinates.clone(),
                rates: runs.start.rates.clone(),
                running: runs.start.running,
            },
            tolerance: runs.tolerance,
            method: runs.method.as_deref(),
            until,
        })
    }
}

/// Replaces assignments by others to the same names, or to the families of which they are members.
pub fn replaced(list: &mut Vec<Assignment>, others: &[Assignment]) {
    let replaces = |other: &Assignment, set: &Assignment| {
        let member = set.name.strip_prefix(&other.name);
        member.is_some_and(|index| index.is_empty() || index.starts_with('['))
    };
    list.retain(|set| !others.iter().any(|other| replaces(other, set)));
    list.extend(others.iter().cloned());
}

/// Runs a spec.
///
/// # Errors
/// If the spec or the call is invalid, or the run fails.
pub fn spec(
    options: &Options<'_>,
    looks: &SampleInstants<'_>,
    files: &[&Destination],
) -> Result<Columns, Failure> {
    run_spec(options, looks, files).map(|(_, recording)| Columns::of(recording))
}

/// Runs a spec; returns the run with its chart, and its recording in the coordinates of the spec.
fn run_spec(
    options: &Options<'_>,
    looks: &SampleInstants<'_>,
    files: &[&Destination],
) -> Result<((Run, Option<Charts>), Recording), Failure> {
    let runs = options.runs;
    let method = method(options)?;
    let dag = Dag::new();
    let (reading, laws) = read(options, looks, files)?;
    let formulas = reading.formulas();
    let compiled = reading.compile_in_charts(&dag, files.iter().copied(), ChartUse::IfPossible);
    let compiled = compiled.map_err(inputs::as_call_failure)?;
    let prepared = MachineInChart::new(compiled, &options.start, &runs.keep, ChartUse::IfPossible)?;
    let MachineInChart {
        compiled, machine, ..
    } = &prepared;
    let output_count = compiled.model.outputs.len() - formulas;
    let mut numbers = output_count..;
    let signals = signals::signals(&laws, machine, || numbers.next().unwrap_or(output_count));
    let signals = signals.map_err(Failure::Call)?;
    let simulation = signals
        .drive(Simulation::new(machine), machine)
        .tolerance(options.tolerance.unwrap_or(TOLERANCE))
        .method(method)
        .until(options.until)
        .max_steps(runs.max_steps.unwrap_or(STEPS))
        .energy_balance(true);
    let simulation = reading::keep(simulation, &runs.keep);
    let interval = runs.every.unwrap_or(options.until / SAMPLES);
    let instants = (looks, interval, options.until);
    let (mut simulation, period) = with_instants(simulation, &prepared, output_count, instants)?;
    if let Some(charts) = &prepared.charts {
        let marked_every = match looks {
            SampleInstants::Even => interval,
            // At instants that are not known before: then every mark is kept.
            _ => 0.0,
        };
        simulation = simulation.each_step(move |step| charts.follow(step, marked_every));
    }
    progress::now("simulating");
    let start = prepared.start.clone();
    let ran = simulation.run_interpreted(start).map_err(|error| {
        let placed = Placed::of(&error, &compiled.model, &prepared.sources);
        let message = || Failure::Run(verdict::message_of(&error));
        placed.map_or_else(message, |placed| Failure::Placed(Box::new(placed)))
    })?;
    if let Some(objection) = verdict::energy_error(&ran) {
        return Err(Failure::Run(objection));
    }
    warn(&ran);
    let states = states(&ran, looks, period.unwrap_or(f64::INFINITY))?;
    let recording = charts::record(&ran, &states, prepared.charts.as_ref());
    progress::now(ANALYSING);
    Ok(((ran, prepared.charts), recording))
}

/// Adds what finds the instants of a recording to a run; the length of a period, if they are one apart. Even instants have this interval.
fn with_instants<'a, L: InputLaw<InterpretedSystem>>(
    simulation: Simulation<'a, InterpretedMachine, L>,
    prepared: &MachineInChart<'_>,
    output_count: usize,
    (looks, interval, until): (&SampleInstants<'_>, f64, f64),
) -> Result<(Simulation<'a, InterpretedMachine, L>, Option<f64>), Failure> {
    let MachineInChart {
        compiled,
        machine,
        start,
        ..
    } = prepared;
    let width = simulate::width(machine, output_count);
    match looks {
        SampleInstants::Even => {
            simulate::check_samples("--every", interval, until, width)?;
            Ok((simulation.every(interval).forget_steps(), None))
        }
        SampleInstants::At(_) => Ok((simulation, None)),
        SampleInstants::Crossing(formula, direction, level) => {
            check_crossing(formula, stage_of_last_output(compiled))?;
            let level =
                level.and_then(|(name, value)| level_of(machine, output_count, name, value));
            let (place, level) = level.unwrap_or((compiled.model.outputs.len() - 1, 0.0));
            let simulation = simulation.event_on("crossing", direction.crossing(), move |seen| {
                seen.outputs.values.get(place).copied().unwrap_or(f64::NAN) - level
            });
            Ok((simulation, None))
        }
        SampleInstants::Period(formula) => {
            check_period(formula, stage_of_last_output(compiled))?;
            let place = compiled.model.outputs.len() - 1;
            let length = period_of(machine, start, place, "--every-period", formula)?;
            simulate::check_samples("--every-period", length, until, width)?;
            Ok((simulation, Some(length)))
        }
    }
}

/// The method of a run.
fn method(options: &Options<'_>) -> Result<&'static Method, Failure> {
    let method = methods::named(options.method.unwrap_or(<&Method>::default().tableau.name))?;
    if std::ptr::eq(method, &TAYLOR) {
        return Err(Failure::Call(
            "--method taylor: `simulate --out` writes a table of such a run, which is accepted here"
                .into(),
        ));
    }
    Ok(method)
}

/// Reads a spec with the laws of its inputs. The formula of the instants, if they have one, becomes the last output.
fn read(
    options: &Options<'_>,
    looks: &SampleInstants<'_>,
    files: &[&Destination],
) -> Result<(Reading, Vec<(String, Law)>), Failure> {
    let runs = options.runs;
    let written = inputs::parse(&runs.inputs)?;
    let read: Vec<_> = inputs::files(&written).collect();
    keep_apart(files.iter().copied(), &read)?;
    let given = options.start.parameters.iter();
    let spec = call::Spec {
        path: options.path.clone(),
        constants: runs.constants.clone(),
        given: given.map(|set| set.name.clone()).collect(),
        json: runs.json,
    };
    let mut reading = Reading::open(&spec)?.with_values(&options.start);
    let laws = reading.drive(&written)?;
    match looks {
        SampleInstants::Crossing(formula, _, level) => {
            // A level is a number in the unit of its output, which the formula would not know.
            let output = level.filter(|(name, value)| has_level(&reading, name, value));
            let formula = output.map_or(*formula, |(name, _)| name);
            reading.add_formula("--crossing FORMULA", formula, None)
        }
        SampleInstants::Period(formula) => {
            reading.add_formula("--every-period TIME", formula, Some("s"))
        }
        SampleInstants::Even | SampleInstants::At(_) => {}
    }
    Ok((reading, laws))
}

/// What the last output depends on, which is the formula of the instants.
fn stage_of_last_output(compiled: &Compiled<'_>) -> Stage {
    let last = compiled.model.outputs.last();
    last.map_or(stage::CONSTANT, |output| output.value.stage())
}

/// Checks that a formula that depends on values of this stage may be a period.
fn check_period(formula: &str, stage: Stage) -> Result<(), Failure> {
    if stage > stage::PARAMETER {
        return Err(Failure::Call(format!(
            "--every-period {formula}: a period can depend only on numbers and parameters"
        )));
    }
    Ok(())
}

/// Checks that a formula that depends on values of this stage may cross 0 at an instant.
fn check_crossing(formula: &str, stage: Stage) -> Result<(), Failure> {
    if stage == stage::ACCELERATION {
        return Err(Failure::Call(format!(
            "--crossing {formula}: it depends on accelerations, which may jump"
        )));
    }
    if stage <= stage::PARAMETER {
        return Err(Failure::Call(format!(
            "--crossing {formula}: it depends only on numbers and parameters, so that it never crosses 0; give a formula in coordinates, \
             rates or the time `t`"
        )));
    }
    Ok(())
}

/// The states of a run at the requested instants; `period` is the interval of those in periods, in s.
fn states(
    run: &Run,
    looks: &SampleInstants<'_>,
    period: f64,
) -> Result<Vec<State<Named>>, Failure> {
    let end = run.end().t;
    match looks {
        SampleInstants::Even => Ok(simulate::recorded_states(run).to_vec()),
        SampleInstants::At(times) => {
            let within = times.iter().copied().filter(|t| (0.0..=end).contains(t));
            run.at_each(within).map_err(Failure::run)
        }
        SampleInstants::Crossing(..) => {
            let events = run.events().iter().filter(|event| event.name == "crossing");
            Ok(events.map(|event| event.state.clone()).collect())
        }
        SampleInstants::Period(_) => {
            let count = (end / period * (1.0 + 1e-12)).floor() as usize;
            let times = (0..=count).map(|k| (k as f64 * period).min(end));
            run.at_each(times).map_err(Failure::run)
        }
    }
}

/// Whether the spec has an output with this name, and the value is one of numbers and units in its unit.
fn has_level(reading: &Reading, name: &str, value: &str) -> bool {
    let dag = Dag::new();
    let model = reading.without_formulas().model(&dag);
    let outputs = model.map(|model| model.outputs).unwrap_or_default();
    let output = outputs
        .iter()
        .find(|output| output.name.to_string() == name);
    let set = Assignment {
        name: name.to_owned(),
        value: value.to_owned(),
    };
    output.is_some_and(|output| {
        // As `level_of` reads it.
        let unit = if output.unit.is_scaled() {
            output.unit_text.clone()
        } else {
            output.unit.to_string()
        };
        set.value("--crossing", &unit).is_ok()
    })
}

/// The index of the output with this name, among the outputs of the spec, and a value of numbers and units in its unit.
fn level_of(
    machine: &InterpretedMachine,
    output_count: usize,
    name: &str,
    value: &str,
) -> Option<(usize, f64)> {
    let mut outputs = machine.program().outputs.iter().take(output_count);
    let place = outputs.position(|slot| slot.name.to_string() == name)?;
    let unit = machine.program().outputs[place].label();
    let set = Assignment {
        name: name.to_owned(),
        value: value.to_owned(),
    };
    let level = set.value("--crossing", &unit).ok()?;
    Some((place, level))
}

/// Prints the warnings of a run: violated assumptions, missing energy.
pub fn warn<M: Machine, L>(run: &Solution<M, L>)
where
    L: InputLaw<M::System>,
{
    for warning in run.warnings() {
        output::print_error(format_args!("warning: {warning}"));
    }
}

/// The value of the output with this index, a formula of parameters that is a period.
///
/// # Errors
/// If the value is not a valid period.
pub fn period_of(
    machine: &InterpretedMachine,
    start: &State<Named>,
    output: usize,
    option: &str,
    formula: &str,
) -> Result<f64, Failure> {
    let system = machine.prepare();
    let inputs = system.default_inputs().values;
    let (q, v) = (&start.q.values, &start.v.values);
    let period = system.output(output, start.t, q, v, &[], &inputs);
    if period > 0.0 && period.is_finite() {
        Ok(period)
    } else {
        Err(Failure::Call(format!(
            "{option} {formula}: {period} s is not a period; expected a time greater than 0"
        )))
    }
}

/// One run of a call, from a table or a spec.
///
/// # Errors
/// If the spec, the table or the call is invalid, or the run fails.
pub fn one(part: &call::Part, files: &[&Destination]) -> Result<Columns, Failure> {
    one_with_run(part, files).map(|(columns, _)| columns)
}

/// One run of a call, from a table or a spec; for a spec with the data from which the errors of its
/// quantities are estimated.
///
/// # Errors
/// If the spec, the table or the call is invalid, or the run fails.
pub fn one_with_run(
    part: &call::Part,
    files: &[&Destination],
) -> Result<(Columns, Option<Exactness>), Failure> {
    keep_apart(files.iter().copied(), &[(part.run.as_path(), "the run")])?;
    let (columns, exactness) = if is_spec(&part.run)? {
        let options = Options::of(&part.run, &part.runs, None)?;
        let ((run, charts), recording) = run_spec(&options, &SampleInstants::Even, files)?;
        let tolerance = options.tolerance.unwrap_or(TOLERANCE);
        let exactness = Exactness {
            run,
            tolerance,
            charts,
        };
        (Columns::of(recording), Some(exactness))
    } else {
        refuse_without_spec(&part.runs)?;
        (table(&part.run)?, None)
    };
    Ok((columns.after(part.after), exactness))
}
