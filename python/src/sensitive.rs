//! Motions together with their derivatives.

use lagrangian::methods::Method;
use lagrangian::{Error, Sensitive, Simulation, State, Varied};
use lagrangian::{Machine as _, interpreted::Named};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;
use crate::machine::Machine;

/// How often a run looks whether it is to be interrupted.
const BETWEEN: std::time::Duration = std::time::Duration::from_millis(50);

/// Coordinates, rates, and their derivatives, flat: for each instant, by each variable.
type Motions<'py> = [Bound<'py, PyArray1<f64>>; 4];

/// The motion from a start at instants, and its derivatives by variables: kinds (`start`, `rate`, anything else) with names.
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
) -> PyResult<Motions<'py>> {
    machine.check_parameters(py)?;
    let method = Method::named(method)
        .ok_or_else(|| PyValueError::new_err(format!("no method named {method:?}")))?;
    let stop = std::sync::atomic::AtomicBool::new(false);
    let mut raised = None;
    let made = py.detach(|| -> Result<_, Error> {
        let mut sensitive = Sensitive::new(&machine.machine);
        for (kind, name) in &by {
            sensitive = match kind.as_str() {
                "start" => sensitive.by_start(name)?,
                "rate" => sensitive.by_start_rate(name)?,
                _ => sensitive.by(name)?,
            };
        }
        let mut from = machine.machine.start();
        (from.t, from.q.values, from.v.values) = start;
        let from = sensitive.start_from(from);
        let mut last = std::time::Instant::now();
        let run = Simulation::new(&sensitive)
            .until(until)
            .tolerance(tolerance)
            .method(method)
            .max_steps(max_steps)
            .progress(|_| {
                if last.elapsed() >= BETWEEN {
                    last = std::time::Instant::now();
                    if let Err(error) = Python::attach(|py| py.check_signals()) {
                        raised.get_or_insert(error);
                        stop.store(true, std::sync::atomic::Ordering::Relaxed);
                    }
                }
            })
            .stop_if(|_| stop.load(std::sync::atomic::Ordering::Relaxed))
            .run(from)?;
        match stop.load(std::sync::atomic::Ordering::Relaxed) {
            true => Ok(Vec::new()),
            false => run.at_each(instants),
        }
    });
    if let Some(error) = raised {
        return Err(error);
    }
    let states = made.map_err(|error| match error {
        Error::UnknownVariable { .. }
        | Error::ConstrainedSensitivity { .. }
        | Error::UnknownCoordinate { .. }
        | Error::InvalidSetting { .. } => PyValueError::new_err(error.to_string()),
        error => {
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
