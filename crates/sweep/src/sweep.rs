//! A plan prepared for running, and its runs.

mod checks;
mod chosen;
mod derived;
mod outcome;
mod runs;
mod table;
mod varied;

pub use varied::unit_of;

use crate::charts::ChartedPoints;
use crate::design;
use crate::plan::{AUTO, Function, Plan};
use crate::reduce::{Formula, Tracker};
use crate::rows::{Cell, Column, Rows};
use crate::signals::{self, without_series};
use crate::verdict;
use checks::check;
use derived::{
    Cartesian, check_parameters, formulas, in_cartesian, machine, model, places_of_assumptions,
    set_all, without,
};
use lagrangian::interpreted::{Engine, InterpretedMachine, Signals};
use lagrangian::methods::{Method, TAYLOR};
use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::Sources;
use lagrangian_symbolic::{Dag, Rational};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use table::{AskedFormula, asked_formulas, columns, reductions};
use varied::VariedQuantity;

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

/// How a reduction is computed.
#[derive(Clone, Debug)]
enum ReductionSource {
    /// From an expression along the motion.
    Along(Tracker),
    /// From the event or contact with this name.
    Of(Function, String),
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
        let asked = asked_formulas(&plan, &plain);
        let asked: Vec<_> = asked.iter().map(AskedFormula::as_output).collect();
        let mut report = Report::new();
        let mut with = if asked.is_empty() {
            Some(plain)
        } else {
            sources = Sources::new();
            model(&plan, &constants, &dag, &asked, &mut sources, &mut report)
        };
        let cartesian = with.as_mut().and_then(|model| model.cartesian.take());
        let compiled = with.and_then(|model| Compiled::for_runs(model, &mut report));
        let Some(compiled) = compiled else {
            return Err(PlanError::Spec(Box::new((report, sources))));
        };
        let assumptions = places_of_assumptions(&compiled.model, &sources);
        let formulas = formulas(&compiled.model, &asked)?;
        let (mut machine, mut method, mut warning) = machine(&plan, &compiled, engine)?;
        set_all(&mut machine, &plan.set).map_err(PlanError::Plan)?;
        let points = ChartedPoints::of(&compiled.model);
        let cartesian = cartesian
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
}
