//! Makes a run.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named, Signals};
use lagrangian::methods::{Method, TAYLOR};
use lagrangian::{
    Crossing, Error, InputLaw, Machine as _, Observation, Progress, Simulation, Solution, State,
    StepMotion, System,
};
use lagrangian_sweep::charts::Charts;
use lagrangian_sweep::signals::without_series;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;
use crate::inputs::{self, Law, Raised, Ruled, SharedLaw};
use crate::machine::Machine;
use crate::program::Derived;
use crate::run::Run;

/// How often a run checks for interruption and reports progress.
const BETWEEN: Duration = Duration::from_millis(50);

/// More instants than this are assumed to be a mistake.
const MOST_SAMPLES: f64 = 5e6;

/// The method name for automatic choice.
const AUTO: &str = "auto";

/// The names of methods.
#[pyfunction]
pub fn methods() -> Vec<&'static str> {
    Method::all().map(|method| method.tableau.name).collect()
}

/// A function of the state: the output that a formula became, or a Python function.
enum Watched {
    Output(usize),
    Function(Py<PyAny>),
}

/// An event: name, index of a formula or function, direction (−1, 0, 1), and the occurrence that ends the run.
type Watch = (String, Option<usize>, Option<Py<PyAny>>, i32, Option<usize>);

/// The settings of a run.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Settings {
    t0: f64,
    q: Vec<f64>,
    v: Vec<f64>,
    until: f64,
    relative: f64,
    absolute: f64,
    absolute_of: Vec<(String, f64)>,
    method: String,
    /// The number of runs that share the derivation of a series.
    one_of: u64,
    every: Option<f64>,
    at: Option<Vec<f64>>,
    dense: bool,
    energy: bool,
    first_step: Option<f64>,
    longest_step: Option<f64>,
    max_steps: usize,
    keep: Option<Vec<String>>,
    rules: Vec<Ruled>,
    all_inputs: Option<Py<PyAny>>,
    events: Vec<Watch>,
    /// The index of a formula, or a function, which ends the run when true.
    stop: Option<(Option<usize>, Option<Py<PyAny>>)>,
    progress: Option<Py<PyAny>>,
}

/// The instants at which states are recorded.
#[derive(Clone)]
struct Samples {
    at: Option<Vec<f64>>,
    every: f64,
    t0: f64,
    until: f64,
    /// How many instants have been passed.
    passed: usize,
    states: Vec<State<Named>>,
}

impl Samples {
    /// At the given instants, or at equal intervals.
    fn new(at: Option<Vec<f64>>, every: f64, [t0, until]: [f64; 2]) -> Samples {
        Samples {
            at,
            every,
            t0,
            until,
            passed: 0,
            states: Vec::new(),
        }
    }

    fn next(&self) -> Option<f64> {
        match &self.at {
            Some(times) => times.get(self.passed).copied(),
            None => {
                let t = self.t0 + self.passed as f64 * self.every.copysign(self.until - self.t0);
                // The end is recorded when the run reaches it.
                let left = (self.until - t) * (self.until - self.t0).signum();
                (left > 4.0 * f64::EPSILON * self.until.abs().max(self.t0.abs())).then_some(t)
            }
        }
    }

    fn begin(&mut self, start: &State<Named>) {
        while self.next() == Some(start.t) {
            self.states.push(start.clone());
            self.passed += 1;
        }
    }

    fn take(&mut self, step: &mut dyn StepMotion<InterpretedMachine>) -> Result<(), Error> {
        let [from, to] = step.span();
        while let Some(t) = self.next().filter(|t| (to - t) * (to - from) >= 0.0) {
            self.states.push(step.state(t)?);
            self.passed += 1;
        }
        Ok(())
    }

    /// Records the end if no instants were requested. A recorded start is replaced by the projected one that was run.
    fn end(&mut self, start: &State<Named>, end: &State<Named>) {
        for state in self
            .states
            .iter_mut()
            .take_while(|state| state.t == start.t)
        {
            *state = start.clone();
        }
        if self.at.is_none() && self.states.last().is_none_or(|last| last.t != end.t) {
            self.states.push(end.clone());
        }
    }
}

impl Watched {
    fn of(output: Option<usize>, function: Option<Py<PyAny>>) -> PyResult<Watched> {
        match (output, function) {
            (Some(output), _) => Ok(Watched::Output(output)),
            (None, Some(function)) => Ok(Watched::Function(function)),
            (None, None) => Err(PyValueError::new_err("neither a formula nor a function")),
        }
    }
}

impl Settings {
    /// The method with which the run begins.
    fn method(&self) -> PyResult<&'static Method> {
        if self.method == AUTO {
            return Ok(<&Method>::default());
        }
        Method::named(&self.method).ok_or_else(|| {
            let known = methods().join(", ");
            PyValueError::new_err(format!(
                "no method named {:?}; there are: {AUTO}, {known}",
                self.method
            ))
        })
    }

    /// The interval at which states are recorded, in s.
    fn interval(&self) -> PyResult<f64> {
        if let Some(every) = self.every
            && !(every > 0.0 && every.is_finite())
        {
            return Err(PyValueError::new_err(format!(
                "every={every} must be greater than 0"
            )));
        }
        let duration = (self.until - self.t0).abs();
        let every = self.every.unwrap_or(duration / 1000.0);
        if self.at.is_none() && duration / every > MOST_SAMPLES {
            return Err(PyValueError::new_err(format!(
                "every={every:e} would keep more than {MOST_SAMPLES:e} instants"
            )));
        }
        Ok(every)
    }

    /// The start of the run, in the coordinates of the spec.
    fn start(&self, of: &Machine) -> State<Named> {
        let mut start = of.machine.start();
        start.t = self.t0;
        start.q.values.clone_from(&self.q);
        start.v.values.clone_from(&self.v);
        start
    }

    /// Whether the run calls Python functions of the state.
    fn has_functions(&self) -> bool {
        self.all_inputs.is_some()
            || self.rules.iter().any(|rule| rule.3.is_some())
            || self.events.iter().any(|event| event.2.is_some())
            || (self.stop.as_ref()).is_some_and(|(_, function)| function.is_some())
    }
}

/// A function of the state that is watched for changes of its sign.
struct Event {
    name: String,
    watched: Watched,
    crossing: Crossing,
    /// The occurrence that ends the run.
    ends: Option<usize>,
}

impl Event {
    fn of((name, output, function, direction, ends): Watch) -> PyResult<Event> {
        Ok(Event {
            name,
            watched: Watched::of(output, function)?,
            crossing: match direction {
                1 => Crossing::Rising,
                -1 => Crossing::Falling,
                _ => Crossing::Any,
            },
            ends,
        })
    }
}

/// Makes a run; returns it with the error that ended it early, if any.
#[pyfunction]
pub fn simulate(
    py: Python<'_>,
    of: &Machine,
    settings: Settings,
) -> PyResult<(Run, Option<String>)> {
    of.check_parameters(py)?;
    let method = settings.method()?;
    let every = settings.interval()?;
    let has_functions = settings.has_functions();
    let start = settings.start(of);
    // A Python function has the coordinates of the spec as its arguments, and may use the number of turns of an angle.
    let in_cartesian = if has_functions {
        None
    } else {
        py.detach(|| {
            let absolute = settings.absolute_of.iter().map(|(name, _)| name);
            let kept = settings.keep.iter().flatten();
            in_cartesian(of, absolute.chain(kept).cloned().collect(), &start)
        })
    };
    let (machine, start, charts) = match in_cartesian {
        Some((machine, start, charts)) => (machine, start, Some(charts)),
        None => (of.machine.clone(), start, None),
    };
    let raised = Raised::default();
    let signals = inputs::driven(&machine, settings.rules, &raised)?;
    if std::ptr::eq(method, &TAYLOR) {
        check_series(py, &machine, &signals)?;
    }
    let law = Law {
        signals,
        all: settings.all_inputs,
        raised: raised.clone(),
    };
    let events = settings.events.into_iter().map(Event::of);
    let stop = settings.stop;
    let stop = stop
        .map(|(output, function)| Watched::of(output, function))
        .transpose()?;
    let marked_every = match (&settings.at, settings.dense) {
        (None, false) => every,
        // At instants that are not known before.
        _ => 0.0,
    };
    let task = Task {
        charts: charts.as_ref().map(|charts| (charts, marked_every)),
        law: SharedLaw(Arc::new(law)),
        raised: raised.clone(),
        events: events.collect::<PyResult<_>>()?,
        stop,
        progress: settings.progress,
        samples: Samples::new(settings.at, every, [settings.t0, settings.until]),
        method,
        is_automatic: settings.method == AUTO,
        one_of: settings.one_of,
        start,
        until: settings.until,
        tolerance: [settings.relative, settings.absolute],
        absolute_of: settings.absolute_of,
        first_step: settings.first_step,
        longest_step: settings.longest_step,
        max_steps: settings.max_steps,
        dense: settings.dense,
        energy: settings.energy,
        keep: settings.keep,
    };
    let made = py.detach(|| task.run(&machine));
    if let Some(exception) = raised.take() {
        return Err(exception);
    }
    match made {
        Ok((solution, states, error)) => {
            let error = error.map(|error| of.derived.placed(&error));
            Ok((Run::new(solution, states, charts), error))
        }
        Err(error) => Err(of_error(py, &of.derived, &error)),
    }
}

/// Checks that the motion has a Taylor series.
fn check_series(py: Python<'_>, machine: &InterpretedMachine, signals: &Signals) -> PyResult<()> {
    let series = py.detach(|| machine.prepare().check_series().map_err(str::to_owned));
    let reason = series.err().or_else(|| without_series(signals, machine));
    match reason {
        None => Ok(()),
        Some(reason) => Err(PyValueError::new_err(format!(
            "method taylor: no series: {reason}"
        ))),
    }
}

/// The machine in the Cartesian coordinates that its spec names, with the start of a run in them; `None` if the run cannot be made in them,
/// since one of these names of coordinates is that of a polar one, or a distance is negative.
fn in_cartesian(
    of: &Machine,
    names: Vec<String>,
    stated: &State<Named>,
) -> Option<(InterpretedMachine, State<Named>, Charts)> {
    let (machine, points) = of.in_cartesian()?;
    points.check_kept(&names).ok()?;
    let (charts, start) = Charts::begin(points, machine.start(), stated).ok()?;
    Some((machine, start, charts))
}

/// The exception for a run that cannot start.
fn of_error(py: Python<'_>, derived: &Derived, error: &Error) -> PyErr {
    match error {
        Error::UnknownCoordinate { .. }
        | Error::InvalidSetting { .. }
        | Error::StartNotFinite { .. }
        | Error::ParameterNotFinite { .. } => PyValueError::new_err(error.to_string()),
        error => {
            let none: Option<f64> = None;
            errors::raise(py, "RunError", (derived.placed(error), none, none))
        }
    }
}

/// The settings of a run.
struct Task<'a> {
    /// The chart in which the run is made, if that is not the one of the spec, and the interval between instants that are recorded.
    charts: Option<(&'a Charts, f64)>,
    law: SharedLaw,
    raised: Raised,
    events: Vec<Event>,
    stop: Option<Watched>,
    progress: Option<Py<PyAny>>,
    samples: Samples,
    method: &'static Method,
    /// Whether the run chooses its methods.
    is_automatic: bool,
    /// Of how many runs it is one, if it does.
    one_of: u64,
    start: State<Named>,
    until: f64,
    /// Relative and absolute tolerance.
    tolerance: [f64; 2],
    absolute_of: Vec<(String, f64)>,
    first_step: Option<f64>,
    longest_step: Option<f64>,
    max_steps: usize,
    dense: bool,
    energy: bool,
    keep: Option<Vec<String>>,
}

/// A run before it begins.
type Prepared<'s> = Simulation<'s, InterpretedMachine, SharedLaw>;

/// An output of the spec, or a formula, at a state.
fn output_at(system: &InterpretedSystem, output: usize, at: &State<Named>, u: &Named) -> f64 {
    system.output(output, at.t, &at.q.values, &at.v.values, &[], &u.values)
}

/// The simulation that keeps only these numbers of its start, if any are named.
pub fn keep<'s, L: InputLaw<InterpretedSystem>>(
    mut simulation: Simulation<'s, InterpretedMachine, L>,
    names: Option<&[String]>,
) -> Simulation<'s, InterpretedMachine, L> {
    if let Some(names) = names {
        simulation = simulation.keep_none();
        for name in names {
            simulation = simulation.keep(name);
        }
    }
    simulation
}

/// A run, the requested states, and the error that ended it early, if any.
type Made = (
    Solution<InterpretedMachine, SharedLaw>,
    Vec<State<Named>>,
    Option<Error>,
);

impl Task<'_> {
    fn run(&self, machine: &InterpretedMachine) -> Result<Made, Error> {
        // Formulas are evaluated while the run uses its own system.
        let system = machine.prepare();
        // The run knows the values that a controller holds at the end of its last step.
        let is_sampled = self.law.0.signals.is_sampled();
        let held: Mutex<Option<Named>> = Mutex::new(None);
        let held = || held.lock().unwrap_or_else(PoisonError::into_inner);
        let mut samples = self.samples.clone();
        samples.begin(&self.start);
        let mut last = Instant::now();
        let mut simulation = Simulation::new(machine)
            .until(self.until)
            .max_steps(self.max_steps)
            .energy_balance(self.energy)
            .method(self.method)
            .law(self.law.clone())
            .each_step(|step| {
                if is_sampled {
                    let [_, to] = step.span();
                    let State { q, v, .. } = step.state(to)?;
                    *held() = Some(step.inputs(to, &q.values, &v.values));
                }
                if let Some((charts, every)) = self.charts {
                    charts.follow(step, every)?;
                }
                samples.take(step)
            })
            .progress(|now| {
                if last.elapsed() >= BETWEEN {
                    last = Instant::now();
                    self.report_progress(now);
                }
            })
            .stop_if(|state| {
                let stops = self.stop.as_ref();
                let stops = stops.is_some_and(|watched| match (watched, &*held()) {
                    (Watched::Output(output), Some(u)) => {
                        output_at(&system, *output, state, u) > 0.0
                    }
                    _ => self.value(&system, watched, "stop", state) > 0.0,
                });
                self.raised.is_kept() || stops
            });
        simulation = self.with_settings(simulation);
        simulation = self.law.0.signals.sample(simulation, machine);
        for event in &self.events {
            simulation = self.with_event(simulation, event, &system);
        }
        let (solution, error) =
            simulation.run_interpreted_as_far_as_possible(self.start.clone())?;
        samples.end(solution.start(), solution.end());
        Ok((solution, samples.states, error))
    }

    /// The value of what is watched, under this name in messages; NaN where a Python function raises an exception.
    fn value(
        &self,
        system: &InterpretedSystem,
        watched: &Watched,
        name: &str,
        state: &State<Named>,
    ) -> f64 {
        let State { t, q, v } = state;
        let (t, q, v) = (*t, &q.values, &v.values);
        match watched {
            Watched::Output(output) => {
                let mut u = system.default_inputs();
                self.law.set(system, t, q, v, &mut u);
                output_at(system, *output, state, &u)
            }
            Watched::Function(function) => Python::attach(|py| {
                let value = inputs::number(py, function, name, (t, q, v));
                value.unwrap_or_else(|error| {
                    self.raised.keep(py, error, t);
                    f64::NAN
                })
            }),
        }
    }

    /// The simulation with tolerances, lengths of steps, and what is kept.
    fn with_settings<'s>(&self, mut simulation: Prepared<'s>) -> Prepared<'s> {
        let [relative, absolute] = self.tolerance;
        simulation = if relative == absolute {
            simulation.tolerance(relative)
        } else {
            simulation.relative(relative).absolute(absolute)
        };
        if let Some(step) = self.first_step {
            simulation = simulation.first_step(step);
        }
        if let Some(step) = self.longest_step {
            simulation = simulation.longest_step(step);
        }
        if !self.dense {
            simulation = simulation.forget_steps();
        }
        if self.is_automatic {
            simulation = simulation.automatic().one_of(self.one_of);
        }
        for (name, of) in &self.absolute_of {
            simulation = simulation.absolute_of(name, *of);
        }
        keep(simulation, self.keep.as_deref())
    }

    /// The simulation with an event. If a controller sets the inputs, a formula has those that the run knows.
    fn with_event<'s>(
        &'s self,
        simulation: Prepared<'s>,
        event: &'s Event,
        system: &'s InterpretedSystem,
    ) -> Prepared<'s> {
        let Event {
            name,
            watched,
            crossing,
            ends,
        } = event;
        if let (true, Watched::Output(output)) = (self.law.0.signals.is_sampled(), watched) {
            let function = move |seen: &Observation<InterpretedMachine>| {
                let (q, v, u) = (&seen.q.values, &seen.v.values, &seen.inputs.values);
                system.output(*output, seen.t, q, v, &[], u)
            };
            return match ends {
                None => simulation.event_on(name, *crossing, function),
                Some(n) => simulation.until_nth_event_on(*n, name, *crossing, function),
            };
        }
        let label = format!("event {name}");
        let function = move |state: &State<Named>| self.value(system, watched, &label, state);
        match ends {
            None => simulation.event(name, *crossing, function),
            Some(n) => simulation.until_nth_event(*n, name, *crossing, function),
        }
    }

    /// Lets Python handle Ctrl-C, and reports progress.
    fn report_progress(&self, now: Progress) {
        Python::attach(|py| {
            let outcome = py.check_signals().and_then(|()| match &self.progress {
                None => Ok(()),
                Some(function) => {
                    let returned = function.bind(py).call1((now.fraction, now.t, now.steps));
                    returned.map(|_| ())
                }
            });
            outcome.unwrap_or_else(|error| self.raised.keep(py, error, now.t));
        });
    }
}
