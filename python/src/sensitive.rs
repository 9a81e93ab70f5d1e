//! Motions together with their derivatives.

use std::sync::{Mutex, MutexGuard, PoisonError};

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::methods::Method;
use lagrangian::{Error, Sensitive, Simulation, State, Varied};
use lagrangian::{Machine as _, System as _, interpreted::Named};
use lagrangian_linear::starts::{self, Cause};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;
use crate::machine::Machine;
use crate::simulate;

/// How often a run checks for interruption.
const BETWEEN: std::time::Duration = std::time::Duration::from_millis(50);

/// Coordinates, rates, and their derivatives, flat: for each instant, by each variable.
type Motions<'py> = [Bound<'py, PyArray1<f64>>; 4];

/// Why there are no derivatives.
enum Lost {
    /// An error of the run.
    Run(Error),
    /// An error about constraints.
    Held(String),
}

impl From<Error> for Lost {
    fn from(error: Error) -> Lost {
        Lost::Run(error)
    }
}

/// The motion from a start at these instants, and its derivatives by variables, given by kind (`start`, `rate`, or other) and name;
/// `keep` names the numbers of the start that the constraints do not move.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they are settings")]
pub fn sensitivities<'py>(
    machine: &Machine,
    py: Python<'py>,
    by: Vec<(String, String)>,
    start: (f64, Vec<f64>, Vec<f64>),
    instants: Vec<f64>,
    until: f64,
    tolerance: f64,
    method: &str,
    max_steps: usize,
    keep: Option<Vec<String>>,
) -> PyResult<Motions<'py>> {
    machine.check_parameters(py)?;
    let method = Method::named(method)
        .ok_or_else(|| PyValueError::new_err(format!("no method named {method:?}")))?;
    let interrupt = Interrupt::default();
    let made = py.detach(|| -> Result<_, Lost> {
        let own = &machine.machine;
        let sensitive = sensitive(own, &by)?;
        let mut from = own.start();
        (from.t, from.q.values, from.v.values) = start;
        let causes: Vec<Cause> = by.iter().map(|of| cause(machine, of)).collect();
        let from = begin(own, &sensitive, from, (&by, &causes), keep.as_deref())?;
        let mut last = std::time::Instant::now();
        let run = Simulation::new(&sensitive)
            .until(until)
            .tolerance(tolerance)
            .method(method)
            .max_steps(max_steps)
            .progress(|_| {
                if last.elapsed() >= BETWEEN {
                    last = std::time::Instant::now();
                    interrupt.look();
                }
            })
            .stop_if(|_| interrupt.has_come())
            .run_interpreted(from)?;
        if interrupt.has_come() {
            return Ok(Vec::new());
        }
        if own.prepare().constraints().len() > 0 {
            check_drift(own, run.end(), &causes, &by)?;
        }
        Ok(run.at_each(instants)?)
    });
    if let Some(error) = interrupt.raised() {
        return Err(error);
    }
    let states = made.map_err(|error| match error {
        Lost::Held(why) => PyValueError::new_err(why),
        Lost::Run(
            error @ (Error::UnknownVariable { .. }
            | Error::ConstrainedSensitivity { .. }
            | Error::CollidingSensitivity { .. }
            | Error::UnknownCoordinate { .. }
            | Error::InvalidSetting { .. }),
        ) => PyValueError::new_err(error.to_string()),
        Lost::Run(error) => {
            let none: Option<f64> = None;
            errors::raise(py, "RunError", (error.to_string(), none, none))
        }
    })?;
    let values = |of: fn(&State<Varied<Named>>) -> &Varied<Named>| {
        let values = states
            .iter()
            .flat_map(|state| of(state).value.values.clone());
        PyArray1::from_vec(py, values.collect())
    };
    let derivatives = |of: fn(&State<Varied<Named>>) -> &Varied<Named>| {
        let by = states.iter().flat_map(|state| &of(state).by);
        PyArray1::from_vec(py, by.flat_map(|one| one.values.clone()).collect())
    };
    Ok([
        values(|state| &state.q),
        values(|state| &state.v),
        derivatives(|state| &state.q),
        derivatives(|state| &state.v),
    ])
}

/// An exception that Python raises while a run is made, as by Ctrl-C.
#[derive(Default)]
struct Interrupt(Mutex<Option<PyErr>>);

impl Interrupt {
    /// Lets Python handle signals.
    fn look(&self) {
        if let Err(error) = Python::attach(|py| py.check_signals()) {
            self.lock().get_or_insert(error);
        }
    }

    fn has_come(&self) -> bool {
        self.lock().is_some()
    }

    fn raised(&self) -> Option<PyErr> {
        self.lock().take()
    }

    fn lock(&self) -> MutexGuard<'_, Option<PyErr>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A machine with the derivatives by these variables.
fn sensitive<'m>(
    machine: &'m InterpretedMachine,
    by: &[(String, String)],
) -> Result<Sensitive<'m, InterpretedMachine>, Lost> {
    let mut sensitive = Sensitive::new(machine);
    if machine.prepare().constraints().len() > 0 {
        sensitive = sensitive.with_start_on_constraints();
    }
    for (kind, name) in by {
        sensitive = match kind.as_str() {
            "start" => sensitive.by_start(name)?,
            "rate" => sensitive.by_start_rate(name)?,
            _ => sensitive.by(name)?,
        };
    }
    Ok(sensitive)
}

/// The start with its derivatives. On constraints it is projected onto them, and changes with the variables as the projected start does.
fn begin(
    machine: &InterpretedMachine,
    sensitive: &Sensitive<'_, InterpretedMachine>,
    given: State<Named>,
    (by, causes): (&[(String, String)], &[Cause]),
    keep: Option<&[String]>,
) -> Result<State<Varied<Named>>, Lost> {
    if machine.prepare().constraints().len() == 0 {
        return Ok(sensitive.start_from(given));
    }
    let start = project_start(machine, given.clone(), keep).map_err(Lost::Held)?;
    if let Some(constraint) = starts::dependent_constraint(machine, &start) {
        return Err(Lost::Held(format!(
            "the constraint `{constraint}` follows from others, and accelerations have no derivatives then: leave it out"
        )));
    }
    let mut from = sensitive.start_from(start);
    for (k, cause) in causes.iter().enumerate() {
        let bring = |machine: &InterpretedMachine, from| project_start(machine, from, keep);
        let change = starts::change(machine, *cause, |_| given.clone(), bring);
        let violated = |why| Lost::Held(format!("{}({}): {why}", by[k].0, by[k].1));
        [from.q.by[k].values, from.v.by[k].values] = change.map_err(violated)?;
    }
    Ok(from)
}

/// The cause for a kind and a name.
fn cause(machine: &Machine, (kind, name): &(String, String)) -> Cause {
    let coordinates = &machine.derived.coordinates;
    let place = coordinates.iter().position(|(own, ..)| own == name);
    let parameters = &machine.derived.parameters;
    match (kind.as_str(), place) {
        ("start", Some(place)) => Cause::Start(place),
        ("rate", Some(place)) => Cause::Rate(place),
        _ => {
            let parameter = parameters.iter().position(|(own, ..)| own == name);
            parameter.map_or(Cause::Input, Cause::Parameter)
        }
    }
}

/// The start projected onto the constraints.
fn project_start(
    machine: &InterpretedMachine,
    start: State<Named>,
    keep: Option<&[String]>,
) -> Result<State<Named>, String> {
    let run = simulate::keep(Simulation::new(machine).until(start.t), keep)
        .run_interpreted(start)
        .map_err(|error| error.to_string())?;
    Ok(run.start().clone())
}

/// Checks that integration has not moved the motion or its derivatives off the constraints.
fn check_drift(
    machine: &InterpretedMachine,
    end: &State<Varied<Named>>,
    causes: &[Cause],
    by: &[(String, String)],
) -> Result<(), Lost> {
    let at = State {
        t: end.t,
        q: end.q.value.clone(),
        v: end.v.value.clone(),
    };
    let changes = causes.iter().enumerate().map(|(k, cause)| {
        let change = [end.q.by[k].values.clone(), end.v.by[k].values.clone()];
        (*cause, change)
    });
    match starts::drifted(machine, &at, changes) {
        None => Ok(()),
        Some((k, off)) => Err(Lost::Held(format!(
            "errors of steps have moved the motion and its derivative by {} off the constraints, by {off:.1e} of their values: a \
             smaller tolerance keeps them closer",
            by[k].1
        ))),
    }
}
