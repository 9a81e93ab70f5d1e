//! The inputs of a run: formulas, tables, sampled controllers, and Python functions.

use std::sync::{Arc, Mutex, PoisonError};

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named, Signal, Signals};
use lagrangian::{Extrapolation, InputLaw, Interpolation, NoPiece, Piece, Table};
use lagrangian_sweep::plan::Law as Written;
use lagrangian_sweep::signals;
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// A table: its name, times, values, interpolation and extrapolation.
pub type Rows = (String, Vec<f64>, Vec<f64>, String, String);

/// The law of an input: its index, its name, and the index of a formula, a function, or a table; for sampled laws the
/// period and the delay.
pub type Ruled = (
    usize,
    String,
    Option<usize>,
    Option<Py<PyAny>>,
    Option<Rows>,
    Option<[f64; 2]>,
);

/// The laws of all inputs of a run.
pub struct Law {
    /// The signals that drive them.
    pub signals: Signals,
    /// A function that returns all of them.
    pub all: Option<Py<PyAny>>,
    /// The first exception that a function raised.
    pub raised: Raised,
}

/// The signals of a run.
///
/// # Errors
/// If a signal is not possible.
pub fn driven(
    machine: &InterpretedMachine,
    rules: Vec<Ruled>,
    raised: &Raised,
) -> PyResult<Signals> {
    let (mut all, mut sampled, mut sampling) = (Vec::new(), Vec::new(), None);
    for (place, name, output, function, rows, own) in rules {
        let signal = match (output, function, rows) {
            (Some(output), ..) => Signal::Output(output),
            (_, Some(function), _) => called_as_signal(function, &name, raised),
            (.., Some(rows)) => Signal::Table(Arc::new(table(rows)?)),
            _ => return Err(PyValueError::new_err("neither a formula nor a function")),
        };
        match own {
            None => all.push((place, signal)),
            Some(own) => {
                if *sampling.get_or_insert(own) != own {
                    return Err(PyValueError::new_err(format!(
                        "input {name}: all sampled inputs must have the same period and the same delay"
                    )));
                }
                sampled.push((place, signal));
            }
        }
    }
    let wrong =
        |wrong: lagrangian::interpreted::SignalError| PyValueError::new_err(wrong.to_string());
    let signals = Signals::new(machine, all).map_err(wrong)?;
    match sampling {
        None => Ok(signals),
        Some(sampling) => signals
            .and_sampled(machine, sampled, sampling)
            .map_err(wrong),
    }
}

/// A Python function as a signal.
fn called_as_signal(function: Py<PyAny>, name: &str, raised: &Raised) -> Signal {
    let (name, raised) = (format!("input {name}"), raised.clone());
    Signal::Function(Arc::new(move |t, q, v| {
        Python::attach(|py| {
            let value = number(py, &function, &name, (t, q, v));
            value.unwrap_or_else(|error| {
                raised.keep(py, error, t);
                f64::NAN
            })
        })
    }))
}

fn table((name, times, values, between, beyond): Rows) -> PyResult<Table> {
    let between = match between.as_str() {
        "hold" => Interpolation::Hold,
        "linear" => Interpolation::Linear,
        "cubic" => Interpolation::Cubic,
        other => {
            return Err(PyValueError::new_err(format!(
                "kind={other:?}: must be 'hold', 'linear' or 'cubic'"
            )));
        }
    };
    let beyond = match beyond.as_str() {
        "hold" => Extrapolation::Hold,
        "error" => Extrapolation::Error,
        "repeat" => Extrapolation::Repeat,
        other => {
            return Err(PyValueError::new_err(format!(
                "beyond={other:?}: must be 'hold', 'error' or 'repeat'"
            )));
        }
    };
    let table = Table::new(between, beyond, times, values);
    let table = table.map_err(|wrong| PyValueError::new_err(format!("{name}: {wrong}")))?;
    Ok(table.named(name))
}

/// The law of an input from the syntax of the command's option, as JSON in the form of a sweep plan.
#[pyfunction]
pub fn written(text: &str, input: &str, unit: &str) -> PyResult<String> {
    let law: Result<Written, String> =
        signals::parse_input(text).and_then(|written| written.law(input, unit));
    let law = law.map_err(|why| PyValueError::new_err(format!("input {input}: {why}")))?;
    serde_json::to_string(&law).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// An exception that is raised at the end of a run.
#[derive(Clone, Default)]
pub struct Raised(Arc<Mutex<Option<PyErr>>>);

impl Raised {
    /// Keeps the first exception.
    pub fn keep(&self, py: Python<'_>, error: PyErr, t: f64) {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if kept.is_none() {
            // Python 3.10 has no notes.
            let _ = error
                .value(py)
                .call_method1("add_note", (format!("at t = {t} s"),));
            *kept = Some(error);
        }
    }

    pub fn is_kept(&self) -> bool {
        self.0
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .is_some()
    }

    pub fn take(&self) -> Option<PyErr> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

/// Calls a function of t, q and v.
pub fn called<'py>(
    py: Python<'py>,
    function: &Py<PyAny>,
    (t, q, v): (f64, &[f64], &[f64]),
) -> PyResult<Bound<'py, PyAny>> {
    let arrays = [q, v].map(|of| PyArray1::from_slice(py, of));
    let [q, v] = arrays;
    function.bind(py).call1((t, q, v))
}

/// The number that a function returned.
pub fn number(
    py: Python<'_>,
    function: &Py<PyAny>,
    name: &str,
    at: (f64, &[f64], &[f64]),
) -> PyResult<f64> {
    let value = called(py, function, at)?;
    value.extract::<f64>().map_err(|_| {
        let kind = value
            .get_type()
            .name()
            .map_or_else(|_| "?".into(), |name| name.to_string());
        PyValueError::new_err(format!(
            "{name}: the function must return a number, not {kind}"
        ))
    })
}

/// The inputs of a run, shared with its observers.
#[derive(Clone)]
pub struct SharedLaw(pub Arc<Law>);

impl InputLaw<InterpretedSystem> for SharedLaw {
    fn set(
        &self,
        system: &InterpretedSystem,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        inputs: &mut Named,
    ) {
        self.set_in(Piece::ALL, system, t, q, v, inputs);
    }

    fn is_constant(&self) -> bool {
        self.0.all.is_none() && self.0.signals.is_constant()
    }

    fn piece(&self, t: f64, forward: bool, order: u32) -> Result<Piece, NoPiece<'_>> {
        self.0.signals.piece(t, forward, order)
    }

    fn set_in(
        &self,
        piece: Piece,
        system: &InterpretedSystem,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        inputs: &mut Named,
    ) {
        let law = &*self.0;
        let Some(function) = &law.all else {
            return law.signals.set_in(piece, system, t, q, v, inputs);
        };
        let set = Python::attach(|py| {
            let values = called(py, function, (t, q, v)).and_then(|values| {
                let values: Vec<f64> = values.extract()?;
                let (given, wanted) = (values.len(), inputs.values.len());
                if given == wanted {
                    return Ok(values);
                }
                Err(PyValueError::new_err(format!(
                    "inputs: the function returned {given} numbers, the machine has {wanted} inputs"
                )))
            });
            values.map_err(|error| law.raised.keep(py, error, t)).ok()
        });
        match set {
            Some(values) => inputs.values.copy_from_slice(&values),
            None => inputs.values.fill(f64::NAN),
        }
    }

    fn is_constant_in_pieces(&self) -> bool {
        self.0.all.is_none() && self.0.signals.is_constant_in_pieces()
    }

    fn is_partial(&self) -> bool {
        self.0.all.is_none()
    }
}
