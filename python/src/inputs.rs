//! What sets the inputs of a run: formulas, tables, and functions in Python.

use std::sync::{Arc, Mutex, PoisonError};

use lagrangian::InputLaw;
use lagrangian::interpreted::{InterpretedSystem, Named};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// What an input does.
pub enum Rule {
    /// It is the output of this number.
    Output(usize),
    /// A function of t, q and v.
    Function(Py<PyAny>),
}

/// All inputs of a run.
pub struct Law {
    /// Which inputs, with their names, and what each does.
    pub rules: Vec<(usize, String, Rule)>,
    /// A function that gives all of them.
    pub all: Option<Py<PyAny>>,
    /// The first exception of a function.
    pub raised: Raised,
}

/// An exception that waits for the end of a run.
#[derive(Clone, Default)]
pub struct Raised(Arc<Mutex<Option<PyErr>>>);

impl Raised {
    /// Keeps the first.
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

/// A number that a function returns.
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
            "{name}: the function is to return a number, not {kind}"
        ))
    })
}

/// The inputs of a run, which what watches it asks as well.
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
        let law = &*self.0;
        if let Some(function) = &law.all {
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
            return;
        }
        for (place, name, rule) in &law.rules {
            inputs.values[*place] = match rule {
                Rule::Output(output) => system.output(*output, t, q, v, &[], &inputs.values),
                Rule::Function(function) => Python::attach(|py| {
                    let name = format!("input {name}");
                    let value = number(py, function, &name, (t, q, v));
                    value.unwrap_or_else(|error| {
                        law.raised.keep(py, error, t);
                        f64::NAN
                    })
                }),
            };
        }
    }

    fn is_constant(&self) -> bool {
        self.0.rules.is_empty() && self.0.all.is_none()
    }
}
