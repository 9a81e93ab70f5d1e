//! A plan prepared for running, and its runs.

mod checks;
mod chosen;
mod outcome;
mod table;

use crate::charts::{self, ChartedPoints, Charts};
use crate::design;
use crate::plan::{AUTO, Function, Plan, RecordedFiles};
use crate::reduce::{Formula, StateCache, Tracker};
use crate::rows::{Cell, Column, Rows};
use crate::signals::{self, without_series};
use crate::verdict;
use checks::check;
use lagrangian::interpreted::{Engine, InterpretedMachine, InterpretedSystem, Named, Signals};
use lagrangian::methods::{Method, TAYLOR};
use lagrangian::{Crossing, Ending, Machine, Observation, Simulation, Solution, State, System};
use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::series::{ProvedSeries, SeriesText};
use lagrangian_spec::diagnostic::{Report, Severity, most_similar};
use lagrangian_spec::model::{Coordinate, Model, stage};
use lagrangian_spec::resolve::Formula as OutputFormula;
use lagrangian_spec::source::{Sources, Span};
use lagrangian_spec::unit::{integral_name, rate_unit, state_of};
use lagrangian_symbolic::{Dag, Rational};
use outcome::{Outcome, Recorder, sample};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use table::{columns, names, reductions};

/// More instants in one run than this are assumed to be a mistake.
const MOST_INSTANTS: f64 = 1e6;

/// The size of a group of runs that are started together for execution in lanes, as the number of operations of the program,
/// summed over the runs. Each run stores as many numbers as the program has operations, so this bounds the memory; and the larger
/// the group, the later lanes run empty.
const OPERATIONS_AT_ONCE: u64 = 1 << 20;
const LEAST_GROUP: u64 = 16;
const MOST_GROUP: u64 = 64;

/// Why a plan cannot be run.
#[derive(Debug)]
pub enum PlanError {
    /// The spec, or a formula, is invalid.
    Spec(Box<(Report, Sources)>),
    /// The plan is invalid.
    Plan(String),
}

/// A plan prepared for running; it is shared by all threads.
#[derive(Debug)]
pub struct Sweep {
    plan: Plan,
    machine: InterpretedMachine,
    /// The machine in the Cartesian coordinates that `charts` of the spec names, if it names any and they can express the plan.
    cartesian: Option<Cartesian>,
    /// For each fact that the spec assumes its text and its place in the spec: `swing.machine:7:14`.
    assumptions: Vec<(String, String)>,
    /// The method of all runs; `None` if each of them chooses its methods.
    method: Option<&'static Method>,
    /// Why another method is used than the plan asks for, as a sentence.
    warning: Option<String>,
    constants: Vec<(String, Rational)>,
    varied: Vec<VariedQuantity>,
    signals: Signals,
    /// For each event the index of the output that is its function.
    events: Vec<usize>,
    reductions: Vec<ReductionSource>,
    columns: Vec<Column>,
    sample_columns: Option<Vec<Column>>,
    /// How many runs are started together where they may run in lanes.
    group: u64,
}

/// A machine in Cartesian coordinates, in which runs are made that are shown in the coordinates of the spec.
#[derive(Debug)]
struct Cartesian {
    machine: InterpretedMachine,
    points: ChartedPoints,
}

/// How a reduction is computed.
#[derive(Clone, Debug)]
enum ReductionSource {
    /// From an expression along the motion.
    Along(Tracker),
    /// From the event or contact with this name.
    Of(Function, String),
}

/// What a varied name stands for.
#[derive(Clone, Debug)]
enum VariedQuantity {
    /// A parameter or an input.
    Set(String),
    /// A coordinate at the start.
    Start(String),
    /// Its rate.
    Rate(String),
}

/// The rows of a chunk.
#[derive(Clone, Debug)]
pub struct Chunk {
    /// A row for each run.
    pub rows: Rows,
    /// The samples of all runs, if the plan asks for samples.
    pub samples: Option<Rows>,
    /// The number of failed runs.
    pub failed: u64,
}

impl VariedQuantity {
    /// Resolves a name: `omega`, `start(x)`, `rate(x)`. A state of first order is the rate of its integral.
    fn of(name: &str, model: &Model<'_>) -> VariedQuantity {
        let inner = |function: &str| {
            let inner = name.strip_prefix(function)?.strip_prefix('(')?;
            Some(inner.strip_suffix(')')?.trim().to_owned())
        };
        match (inner("start"), inner("rate")) {
            (Some(name), _) => {
                let integral = integral_name(&name);
                let is_meant = |c: &Coordinate<'_>| {
                    let own = c.name.to_string();
                    own == integral || (state_of(&own).is_some() && c.name.base == integral)
                };
                if model.coordinates.iter().any(is_meant) {
                    VariedQuantity::Rate(integral)
                } else {
                    VariedQuantity::Start(name)
                }
            }
            (_, Some(name)) => VariedQuantity::Rate(name),
            _ => VariedQuantity::Set(name.to_owned()),
        }
    }

    /// Whether it is a member of a family; members are set after the family.
    fn is_member(&self) -> bool {
        let (VariedQuantity::Set(name) | VariedQuantity::Start(name) | VariedQuantity::Rate(name)) =
            self;
        name.contains('[')
    }
}

/// The unit of a name given to `--vary`.
///
/// # Errors
/// If the machine has nothing of this name; suggests a similar name.
pub fn unit_of(model: &Model<'_>, name: &str) -> Result<String, String> {
    let place = VariedQuantity::of(name, model);
    let (kind, wanted) = match &place {
        VariedQuantity::Set(name) => ("parameter or input", name),
        VariedQuantity::Start(name) | VariedQuantity::Rate(name) => ("coordinate", name),
    };
    let wanted = &*lagrangian_spec::token::normalized(wanted);
    let coordinates = model.coordinates.iter().map(|c| match c.rate {
        Some(_) => (c.name.to_string(), c.unit_text.clone()),
        None => (c.name.to_string(), c.unit.to_string()),
    });
    let parameters = model
        .parameters
        .iter()
        .map(|p| (p.name.to_string(), p.unit_text.clone()));
    let inputs = model
        .inputs
        .iter()
        .map(|i| (i.name.to_string(), i.unit_text.clone()));
    let known: Vec<(String, String)> = match place {
        VariedQuantity::Set(_) => parameters.chain(inputs).collect(),
        _ => coordinates.collect(),
    };
    let is_meant =
        |name: &str| name == wanted || name.split_once('[').is_some_and(|(base, _)| base == wanted);
    if let Some((name, unit)) = known.iter().find(|(name, _)| is_meant(name)) {
        return Ok(match place {
            VariedQuantity::Rate(_) if state_of(name).is_some() => rate_unit(name, unit),
            VariedQuantity::Rate(_) => format!("({unit})/s"),
            _ => unit.clone(),
        });
    }
    let is_coordinate = model
        .coordinates
        .iter()
        .any(|c| is_meant(&c.name.to_string()));
    let names = || known.iter().map(|(name, _)| name.as_str());
    let help = match most_similar(wanted, names()) {
        _ if is_coordinate && matches!(place, VariedQuantity::Set(_)) => {
            format!("it is a coordinate, whose start is `start({wanted})`")
        }
        Some(near) => format!("did you mean `{near}`?"),
        None if known.is_empty() => "there are none".to_owned(),
        None => format!("there are: {}", names().collect::<Vec<_>>().join(", ")),
    };
    Err(format!("no {kind} named `{wanted}`; {help}"))
}

/// For each fact that the spec assumes its text and its place in the spec.
fn places_of_assumptions(model: &Model<'_>, sources: &Sources) -> Vec<(String, String)> {
    let place = |span: Span| {
        let (line, column) = sources.line_column(span);
        format!("{}:{line}:{column}", sources.name(span.source))
    };
    let stated = model.assumptions.iter();
    stated
        .map(|stated| (stated.text.clone(), place(stated.span)))
        .collect()
}

/// The formulas of a plan as outputs of the model, which come after its own.
///
/// # Errors
/// If one that may not depend on accelerations does.
fn formulas(model: &Model<'_>, asked: &[OutputFormula<'_>]) -> Result<Vec<Formula>, PlanError> {
    let own = model.outputs.len() - asked.len();
    let outputs = (own..).zip(&model.outputs[own..]);
    let formulas = outputs.zip(asked).map(|((output, formula), asked)| {
        let reads_accelerations = formula.value.stage() == stage::ACCELERATION;
        if reads_accelerations && !asked.source_name.starts_with("--reduce") {
            return Err(PlanError::Plan(format!(
                "{}: `{}` depends on accelerations, which depend on it in turn or jump where contacts change; only reductions may",
                asked.source_name, asked.text
            )));
        }
        Ok(Formula {
            output,
            reads_accelerations,
        })
    });
    formulas.collect()
}

/// The machine of a plan with its series, the method of its runs, and a warning if that is not the one that the plan asks for.
fn machine(
    plan: &Plan,
    compiled: &Compiled<'_>,
    engine: Engine,
) -> Result<(InterpretedMachine, &'static Method, Option<String>), PlanError> {
    let mut machine = InterpretedMachine::new(compiled.program.clone());
    machine
        .set_engine(engine)
        .map_err(|none| PlanError::Plan(none.to_string()))?;
    let mut method = method(plan)?;
    let mut warning = None;
    if plan.method == AUTO {
        let text = text_of_series(plan, false).map_err(PlanError::Plan)?;
        machine = machine.with_series_on_demand(move || text.derive());
    }
    if std::ptr::eq(method, &TAYLOR) {
        let series = ProvedSeries::derive(&compiled.model);
        if let Err(reason) = &series {
            method = <&Method>::default();
            warning = Some(without(method, reason));
        }
        machine = machine.with_series(series);
    }
    Ok((machine, method, warning))
}

/// The warning that another method is used, since there is no series for this reason.
fn without(method: &Method, reason: impl std::fmt::Display) -> String {
    let name = method.tableau.name;
    format!("no Taylor series: {reason}; {name} is used")
}

/// Checks that every parameter has a value, or is varied.
fn check_parameters(
    machine: &InterpretedMachine,
    varied: &[VariedQuantity],
) -> Result<(), PlanError> {
    let mut probe = machine.clone();
    for place in varied {
        if let VariedQuantity::Set(name) = place {
            let _ = probe.set(name, 1.0); // the name was checked
        }
    }
    probe.check_parameters().map_err(|missing| {
        PlanError::Plan(format!(
            "{missing}; set them with --set {}=…",
            missing.names.join("=… --set ")
        ))
    })
}

fn check_column_names(columns: &[Column]) -> Result<(), PlanError> {
    let mut seen = std::collections::BTreeSet::new();
    let twice = columns
        .iter()
        .find(|column| !seen.insert(column.name.as_str()));
    match twice {
        Some(twice) => Err(PlanError::Plan(format!(
            "two columns would be named `{}`: give the reduction another name",
            twice.name
        ))),
        None => Ok(()),
    }
}

/// How many runs are started together where they may run in lanes.
fn group_size(compiled: &Compiled<'_>) -> u64 {
    let functions = compiled.program.all_functions();
    let operations: usize = functions.map(|function| function.code.len()).sum();
    (OPERATIONS_AT_ONCE / operations.max(1) as u64).clamp(LEAST_GROUP, MOST_GROUP)
}

impl Sweep {
    /// Derives the machine of a plan with its formulas, and checks everything that can be checked before the first run.
    ///
    /// # Errors
    /// If the spec or the plan is invalid: what is wrong.
    pub fn new(plan: Plan, engine: Engine) -> Result<Sweep, PlanError> {
        let constants = plan.spec.constants().map_err(PlanError::Plan)?;
        let dag = Dag::new();
        let (mut sources, mut report) = (Sources::new(), Report::new());
        let Some(plain) = model(&plan, &constants, &dag, &[], &mut sources, &mut report) else {
            return Err(PlanError::Spec(Box::new((report, sources))));
        };
        let places = check(&plan, &plain)?;
        let names = names(&plan, &plain);
        let output_formulas: Vec<OutputFormula<'_>> = names
            .iter()
            .map(|(name, source_name, text, unit)| OutputFormula {
                name,
                source_name,
                text,
                unit: unit.as_deref(),
            })
            .collect();
        let of_plain = sources;
        let (mut sources, mut report) = (Sources::new(), Report::new());
        let with = match output_formulas.as_slice() {
            [] => {
                sources = of_plain;
                Some(plain)
            }
            asked => model(&plan, &constants, &dag, asked, &mut sources, &mut report),
        };
        let mut with = with;
        let cartesian = with.as_mut().and_then(|model| model.cartesian.take());
        let compiled = with.and_then(|model| Compiled::for_runs(model, &mut report));
        let Some(compiled) = compiled else {
            return Err(PlanError::Spec(Box::new((report, sources))));
        };
        let assumptions = places_of_assumptions(&compiled.model, &sources);
        let formulas = formulas(&compiled.model, &output_formulas)?;
        let (mut machine, mut method, mut warning) = machine(&plan, &compiled, engine)?;
        set_all(&mut machine, &plan.set).map_err(PlanError::Plan)?;
        let points = ChartedPoints::of(&compiled.model);
        let cartesian = cartesian
            .filter(|_| {
                plan.keep
                    .as_ref()
                    .is_none_or(|names| points.check_kept(names).is_ok())
            })
            .and_then(|model| in_cartesian(&plan, &compiled, (*model, points), engine, method));
        check_parameters(&machine, &places)?;

        let mut formulas = formulas.into_iter();
        let mut next = || {
            formulas.next().unwrap_or(Formula {
                output: 0,
                reads_accelerations: false,
            })
        };
        let signals = signals::signals(&plan.inputs, &machine, || next().output);
        let signals = signals.map_err(PlanError::Plan)?;
        if std::ptr::eq(method, &TAYLOR)
            && let Some(reason) = without_series(&signals, &machine)
        {
            method = <&Method>::default();
            warning = Some(without(method, reason));
        }
        let events: Vec<usize> = plan.events.iter().map(|_| next().output).collect();
        let (reductions, units) = reductions(&plan, &compiled.model, next);
        let (columns, sample_columns) = columns(&plan, &compiled.model, &machine, &units);
        check_column_names(&columns)?;
        Ok(Sweep {
            group: group_size(&compiled),
            machine,
            cartesian,
            assumptions,
            method: (plan.method != AUTO).then_some(method),
            warning,
            constants,
            varied: places,
            signals,
            events,
            reductions,
            columns,
            sample_columns,
            plan,
        })
    }

    /// The plan.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Changes the length of chunks, which changes no row.
    pub fn set_chunk(&mut self, chunk: u64) {
        self.plan.chunk = chunk;
    }

    /// Whether several runs may execute at once in the lanes of the processor: this requires machine code and no
    /// guides (`sliding`). With [`Engine::Auto`] it is true only once machine code has paid off for one run.
    pub fn may_run_in_lanes(&self) -> bool {
        let cartesian = self.cartesian.as_ref();
        let machine = cartesian.map_or(&self.machine, |cartesian| &cartesian.machine);
        machine.may_run_in_lanes()
    }

    /// A warning about the sweep, if there is one.
    pub fn warning(&self) -> Option<&str> {
        self.warning.as_deref()
    }

    /// An empty set of rows of this sweep.
    pub fn empty_rows(&self) -> Rows {
        Rows::new(self.columns.clone())
    }

    /// An empty set of samples; `None` if the plan asks for none.
    pub fn empty_samples(&self) -> Option<Rows> {
        self.sample_columns.clone().map(Rows::new)
    }

    /// Makes the runs of a chunk, the unit of work, which depends only on the plan and the chunk's index. `None` once `stop` is set.
    pub fn run_chunk(&self, chunk: u64, stop: &AtomicBool) -> Option<Chunk> {
        self.run(self.plan.runs_of(chunk), stop, &|_| ())
    }

    /// The message of an error of a run, followed by the place in the spec if that states its reason.
    fn message_of(&self, error: &lagrangian::Error) -> String {
        let message = verdict::message_of(error);
        let lagrangian::Error::AssumptionEnded { assumption, .. } = error else {
            return message;
        };
        let mut stated = self.assumptions.iter();
        match stated.find(|(text, _)| text == assumption) {
            Some((_, place)) => format!("{message} ({place})"),
            None => message,
        }
    }

    /// Makes these runs; `done` is called after each with whether it failed.
    pub fn run(&self, runs: Range<u64>, stop: &AtomicBool, done: &dyn Fn(bool)) -> Option<Chunk> {
        // Checks of numbers need the model of the spec, which belongs to one thread.
        let dag = Dag::new();
        let sets = self
            .varied
            .iter()
            .any(|place| matches!(place, VariedQuantity::Set(_)));
        let refuses = if sets || !self.plan.set.is_empty() {
            let (mut sources, mut report) = (Sources::new(), Report::new());
            model(
                &self.plan,
                &self.constants,
                &dag,
                &[],
                &mut sources,
                &mut report,
            )
        } else {
            None
        };
        let mut chunk = Chunk {
            rows: self.empty_rows(),
            samples: self.empty_samples(),
            failed: 0,
        };
        let mut numbers = runs;
        while !numbers.is_empty() {
            if stop.load(Ordering::Relaxed) {
                return None;
            }
            let group = if self.may_run_in_lanes() {
                self.group
            } else {
                1
            };
            let last = numbers.end.min(numbers.start.saturating_add(group));
            let runs: Vec<(u64, Vec<f64>)> = (numbers.start..last)
                .map(|run| (run, design::values(&self.plan.design, run)))
                .collect();
            numbers.start = last;
            let outcomes = self.run_group(&runs, refuses.as_ref(), stop)?;
            for ((run, values), mut outcome) in runs.iter().zip(outcomes) {
                chunk.failed += u64::from(outcome.error.is_some());
                done(outcome.error.is_some());
                if let (Some(samples), Some(all)) = (outcome.samples.take(), &mut chunk.samples) {
                    all.extend(samples);
                }
                chunk
                    .rows
                    .push(self.row(*run, values, outcome.into_cells(self.method.is_none())));
            }
        }
        Some(chunk)
    }

    fn row(&self, run: u64, values: &[f64], rest: Vec<Cell>) -> Vec<Cell> {
        let varied = values.iter().map(|value| Cell::Number(Some(*value)));
        std::iter::once(Cell::Count(run))
            .chain(varied)
            .chain(rest)
            .collect()
    }

    /// Makes these runs, in lanes where the machine has code for that; `None` if they were stopped.
    fn run_group(
        &self,
        runs: &[(u64, Vec<f64>)],
        refuses: Option<&Model<'_>>,
        stop: &AtomicBool,
    ) -> Option<Vec<Outcome>> {
        let mut begun: Vec<PreparedRun> = runs
            .iter()
            .map(|(_, values)| self.prepare_run(values, refuses))
            .collect();
        let mut simulations = Vec::new();
        for ((run, _), begun) in runs.iter().zip(&mut begun) {
            if begun.refused.is_none() {
                let start = begun.start.clone();
                simulations.push((self.simulation(*run, begun, stop), start));
            }
        }
        let made = Simulation::run_interpreted_in_lanes(simulations);
        let mut made = made.into_iter();
        let outcomes = runs.iter().zip(begun).map(|((run, _), begun)| {
            let (instants, reductions) = (begun.recorder.at.len(), self.reductions.len());
            let charts = begun.charts.as_ref();
            let start = charts::shown(charts, &begun.start);
            let failed = Outcome::failed(start, instants, reductions);
            if let Some(error) = begun.refused {
                let error = Some(error);
                return Some(Outcome { error, ..failed });
            }
            match made.next()? {
                Ok((solution, error)) => {
                    self.outcome(*run, (&solution, error), (begun.recorder, charts), failed)
                }
                Err(error) => {
                    let error = Some(self.message_of(&error));
                    Some(Outcome { error, ..failed })
                }
            }
        });
        outcomes.collect()
    }

    /// A run with its varied values, ready to start.
    fn prepare_run(&self, values: &[f64], refuses: Option<&Model<'_>>) -> PreparedRun {
        let plan = &self.plan;
        let mut machine = self.machine.clone();
        let mut cartesian = self.cartesian.as_ref().map(|of| of.machine.clone());
        let mut coordinates = [(&plan.start, Vec::new()), (&plan.rate, Vec::new())];
        for is_member in [false, true] {
            if is_member {
                // Of a family that is varied, members keep the values of their own.
                let members = plan.set.iter().filter(|(name, _)| name.contains('['));
                for (name, value) in members {
                    for machine in [Some(&mut machine), cartesian.as_mut()]
                        .into_iter()
                        .flatten()
                    {
                        drop(machine.set(name, *value)); // all names were checked
                    }
                }
            }
            let varied = self.varied.iter().zip(values);
            for (place, value) in varied.filter(|(place, _)| place.is_member() == is_member) {
                match place {
                    // All names were checked.
                    VariedQuantity::Set(name) => {
                        for machine in [Some(&mut machine), cartesian.as_mut()]
                            .into_iter()
                            .flatten()
                        {
                            drop(machine.set(name, *value));
                        }
                    }
                    VariedQuantity::Start(name) => coordinates[0].1.push((name, *value)),
                    VariedQuantity::Rate(name) => coordinates[1].1.push((name, *value)),
                }
            }
        }
        let mut start = machine.start();
        for ((given, varied), numbers) in coordinates.iter().zip([&mut start.q, &mut start.v]) {
            for is_member in [false, true] {
                let given = given.iter().map(|(name, value)| (name, *value));
                let varied = varied.iter().map(|(name, value)| (*name, *value));
                let both = given.chain(varied);
                for (name, value) in both.filter(|(name, _)| name.contains('[') == is_member) {
                    let _ = numbers.set(name, value); // the name was checked
                }
            }
        }
        let trackers = self.reductions.iter().map(|made| match made {
            ReductionSource::Along(tracker) => Some(tracker.clone()),
            ReductionSource::Of(..) => None,
        });
        let recorder = Recorder {
            trackers: trackers.collect(),
            at: vec![None; plan.at.len()],
            samples: self.empty_samples(),
            due: 0,
            cache: StateCache::default(),
        };
        let refused = refuses.and_then(|model| {
            let diagnostics = model.parameter_diagnostics(machine.parameter_values());
            let error = diagnostics
                .iter()
                .find(|diagnostic| diagnostic.code.severity() == Severity::Error)?;
            Some(format!("{} [{}]", error.message, error.code))
        });
        let mut charts = None;
        // A start at a negative distance exists only in the coordinates of the spec.
        if let (Some(in_other), Some(of)) = (cartesian, &self.cartesian)
            && let Ok((made, begun)) = Charts::begin(&of.points, in_other.start(), &start)
        {
            (machine, start, charts) = (in_other, begun, Some(made));
        }
        PreparedRun {
            system: machine.prepare(),
            machine,
            start,
            charts,
            recorder,
            refused,
        }
    }

    /// The simulation of a run.
    fn simulation<'r>(
        &'r self,
        run: u64,
        begun: &'r mut PreparedRun,
        stop: &'r AtomicBool,
    ) -> Simulation<'r, InterpretedMachine, Signals> {
        let plan = &self.plan;
        let PreparedRun {
            machine,
            system,
            recorder,
            charts,
            ..
        } = begun;
        let (machine, system, charts) = (&*machine, &*system, charts.as_ref());
        let function = move |output: usize, state: &State<Named>| {
            let mut u = system.default_inputs();
            let State { t, q, v } = state;
            lagrangian::InputLaw::set(&self.signals, system, *t, &q.values, &v.values, &mut u);
            system.output(output, *t, &q.values, &v.values, &[], &u.values)
        };
        let simulation = Simulation::new(machine)
            .tolerance(plan.tolerance)
            .until(plan.until)
            .max_steps(usize::try_from(plan.max_steps).unwrap_or(usize::MAX))
            .energy_balance(true)
            .forget_steps();
        let simulation = match self.method {
            Some(method) => simulation.method(method),
            None => simulation.automatic().one_of(plan.runs()),
        };
        let asks_for_power = (plan.reduce.iter()).any(|of| of.function == Function::Power);
        let simulation = if asks_for_power && plan.after.is_some() {
            simulation
        } else {
            simulation.forget_energies()
        };
        let mut simulation = self.signals.drive(simulation, machine);
        if let Some(keep) = &plan.keep {
            simulation = simulation.keep_none();
            for name in keep {
                simulation = simulation.keep(name);
            }
        }
        for (watch, &output) in plan.events.iter().zip(&self.events) {
            if self.signals.is_sampled() {
                // This copy evaluates formulas; the run itself knows the held values of controllers.
                let system = system.clone();
                let output_of = move |seen: &Observation<InterpretedMachine>| {
                    let (q, v, u) = (&seen.q.values, &seen.v.values, &seen.inputs.values);
                    system.output(output, seen.t, q, v, &[], u)
                };
                simulation = if watch.ends {
                    simulation.until_event_on(&watch.name, Crossing::Any, output_of)
                } else {
                    simulation.event_on(&watch.name, Crossing::Any, output_of)
                };
                continue;
            }
            let function = move |state: &State<Named>| function(output, state);
            simulation = if watch.ends {
                simulation.until_event(&watch.name, Crossing::Any, function)
            } else {
                simulation.event(&watch.name, Crossing::Any, function)
            };
        }
        let records_steps = self
            .reductions
            .iter()
            .any(|made| matches!(made, ReductionSource::Along(_)))
            || !plan.at.is_empty()
            || plan.every.is_some();
        if records_steps || charts.is_some() {
            // States are shown at instants that are not known before, or only at the end.
            let is_recorded = plan.has_samples() || !plan.at.is_empty();
            let marked_every = if is_recorded { 0.0 } else { f64::INFINITY };
            simulation = simulation.each_step(move |step| {
                if let Some(charts) = charts {
                    charts.follow(step, marked_every)?;
                }
                recorder.record_step(plan, run, (system, charts), step)
            });
        }
        simulation.stop_if(|_| stop.load(Ordering::Relaxed))
    }

    /// The outcome of a run that was started; `None` if it was stopped.
    fn outcome(
        &self,
        run: u64,
        (solution, error): (
            &Solution<InterpretedMachine, Signals>,
            Option<lagrangian::Error>,
        ),
        (mut recorder, charts): (Recorder, Option<&Charts>),
        mut outcome: Outcome,
    ) -> Option<Outcome> {
        let plan = &self.plan;
        if *solution.ending() == Ending::Stopped {
            return None;
        }
        let error = error.as_ref().map(|error| self.message_of(error));
        outcome.error = error.or_else(|| verdict::energy_error(solution));
        outcome.status = match (&outcome.error, solution.ending()) {
            (Some(_), _) => "failed".to_owned(),
            (None, Ending::Event(name)) => format!("event {name}"),
            (None, _) => "ended".to_owned(),
        };
        outcome.end = charts::shown(charts, solution.end());
        outcome.steps = solution.statistics().steps as u64;
        if self.method.is_none() {
            outcome.methods = Some(chosen::methods(solution.choices(), solution.handovers()));
        }
        outcome.residual = solution.energy_balance().map(|balance| balance.residual());
        let start = charts::shown(charts, solution.start());
        recorder.record_ends(plan, (run, &start, &outcome.end));
        let after = |t: f64| {
            plan.after
                .is_none_or(|after| (t - after) * plan.until.signum() >= 0.0)
        };
        if let Some(samples) = &mut recorder.samples {
            let events = solution.events().iter();
            for event in
                events.filter(|event| plan.at_events.contains(&event.name) && after(event.state.t))
            {
                let mut cells = sample(run, &charts::shown(charts, &event.state));
                cells.push(Cell::Text(Some(event.name.clone())));
                samples.push(cells);
            }
        }
        outcome.at = recorder.at;
        outcome.samples = recorder.samples;
        if outcome.error.is_none() {
            let made = self.reductions.iter().zip(&recorder.trackers);
            outcome.reductions = made
                .map(|(made, tracker)| match (made, tracker) {
                    (ReductionSource::Of(Function::Power, contact), _) => {
                        let mut names = solution.system().unilateral_contacts();
                        let k = names.position(|of| of.name == contact)?;
                        let since = plan.after.unwrap_or(solution.start().t);
                        let before = match plan.after {
                            Some(after) => solution.contact_energies_at(after)?.get(k)?.lost(),
                            None => 0.0,
                        };
                        let taken = solution.contact_energies().get(k)?.lost() - before;
                        Some(taken / (solution.end().t - since))
                    }
                    (ReductionSource::Of(function, name), _) => {
                        let since = plan.after.unwrap_or(solution.start().t);
                        let events = solution.events().iter();
                        let mut times = events
                            .filter(|event| event.name == *name && after(event.state.t))
                            .map(|event| event.state.t);
                        match function {
                            Function::Count => Some(times.count() as f64),
                            Function::Frequency => {
                                let length = (solution.end().t - since).abs();
                                Some(times.count() as f64 / length)
                            }
                            Function::FirstEvent => times.next(),
                            _ => times.next_back(),
                        }
                    }
                    (_, Some(tracker)) => tracker.result(),
                    (_, None) => None,
                })
                .collect();
        }
        Some(outcome)
    }
}

/// A run before its simulation: its machine with the varied values, its start, and its observers.
struct PreparedRun {
    machine: InterpretedMachine,
    /// Evaluates formulas while the run uses its own system.
    system: InterpretedSystem,
    start: State<Named>,
    /// How the run is shown in the coordinates of the spec, if it is in others.
    charts: Option<Charts>,
    recorder: Recorder,
    /// Why the spec refuses these numbers, if it does.
    refused: Option<String>,
}

/// The model of the plan's spec, with its formulas added.
fn model<'d>(
    plan: &Plan,
    constants: &[(String, Rational)],
    dag: &'d Dag,
    formulas: &[OutputFormula<'_>],
    sources: &mut Sources,
    report: &mut Report,
) -> Option<Model<'d>> {
    let text = &plan.spec;
    let spec = lagrangian_spec::parse(sources, &text.name, &text.text, report);
    let spec = spec.with_given(plan.spec.given.iter().cloned().chain(plan.given()));
    let files = &mut RecordedFiles(&text.files);
    Model::resolve_with(spec, dag, constants, formulas, files, sources, report)
}

/// The machine of a plan in Cartesian coordinates; `None` if they cannot express the plan.
fn in_cartesian(
    plan: &Plan,
    polar: &Compiled<'_>,
    (model, points): (Model<'_>, ChartedPoints),
    engine: Engine,
    method: &Method,
) -> Option<Cartesian> {
    if !model.uncharted.is_empty() {
        return None;
    }
    let mut report = Report::new();
    let compiled = Compiled::for_runs(model, &mut report)?;
    polar.check_chart(&compiled, &mut report)?;
    let mut machine = InterpretedMachine::new(compiled.program.clone());
    machine.set_engine(engine).ok()?;
    if std::ptr::eq(method, &TAYLOR) {
        let series = ProvedSeries::derive(&compiled.model);
        if series.is_err() {
            return None;
        }
        machine = machine.with_series(series);
    }
    if plan.method == AUTO {
        let text = text_of_series(plan, true).ok()?;
        machine = machine.with_series_on_demand(move || text.derive());
    }
    set_all(&mut machine, &plan.set).ok()?;
    Some(Cartesian { machine, points })
}

/// The texts from which the series of a plan's machine is derived, or of that in Cartesian coordinates.
fn text_of_series(plan: &Plan, in_charts: bool) -> Result<SeriesText, String> {
    let mut text = plan.spec.of_series(in_charts)?;
    text.given.extend(plan.given());
    Ok(text)
}

/// The method of a plan; the default one if the sweep is to choose it.
fn method(plan: &Plan) -> Result<&'static Method, PlanError> {
    if plan.method == AUTO {
        return Ok(<&Method>::default());
    }
    let Some(method) = Method::named(&plan.method) else {
        let mut names: Vec<_> = Method::all().map(|method| method.tableau.name).collect();
        names.insert(0, AUTO);
        let message = format!(
            "no method named `{}`; there are: {}",
            plan.method,
            names.join(", ")
        );
        return Err(PlanError::Plan(message));
    };
    if method.has_fixed_steps() {
        let name = method.tableau.name;
        let message = format!(
            "the method `{name}` takes steps of a fixed length, which a plan does not have"
        );
        return Err(PlanError::Plan(message));
    }
    Ok(method)
}

/// Sets values, families before their members.
fn set_all(machine: &mut InterpretedMachine, all: &[(String, f64)]) -> Result<(), String> {
    for is_member in [false, true] {
        for (name, value) in all
            .iter()
            .filter(|(name, _)| name.contains('[') == is_member)
        {
            machine
                .set(name, *value)
                .map_err(|unknown| unknown.to_string())?;
        }
    }
    Ok(())
}
