//! A program with values of its parameters.

use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use lagrangian::interpreted::{Engine, InterpretedMachine, InterpretedSystem, Named};
use lagrangian::{Machine as _, System};
use lagrangian_sweep::charts::ChartedPoints;
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;

use crate::errors;
use crate::program::{Derived, Program};

/// The engine of machines that are created from now on: 0 for automatic, 1 for the interpreter, 2 for machine code.
static ENGINE: AtomicU8 = AtomicU8::new(0);

/// The names of engines.
const ENGINES: [(&str, Engine); 3] = [
    ("auto", Engine::Auto),
    ("interpreter", Engine::Interpreter),
    ("jit", Engine::Jit),
];

/// Sets the engine of machines that are created from now on.
#[pyfunction]
pub fn set_engine(name: &str) -> PyResult<()> {
    let place = ENGINES.iter().position(|(known, _)| *known == name);
    let Some(place) = place else {
        return Err(PyValueError::new_err(format!(
            "no engine named {name:?}; there are: auto, interpreter, jit"
        )));
    };
    ENGINE.store(place as u8, Ordering::Relaxed);
    Ok(())
}

/// The engine of machines that are created from now on.
#[pyfunction]
pub fn engine() -> &'static str {
    ENGINES[usize::from(ENGINE.load(Ordering::Relaxed))].0
}

/// A program with values of its parameters and inputs; the base class of `lagrangian.Machine`.
#[pyclass(frozen, subclass, module = "lagrangian._native")]
pub struct Machine {
    pub derived: Arc<Derived>,
    pub machine: InterpretedMachine,
    /// Whether machine code is disabled.
    pub is_interpreted: bool,
    /// The default inputs.
    pub inputs: Named,
    /// Unused systems, kept because creating one for each call would take longer than the call.
    systems: Mutex<Vec<InterpretedSystem>>,
}

/// A system from those that are kept; it goes back to them when this is dropped.
pub struct PooledSystem<'a> {
    system: Option<InterpretedSystem>,
    of: &'a Mutex<Vec<InterpretedSystem>>,
}

impl std::ops::Deref for PooledSystem<'_> {
    type Target = InterpretedSystem;

    fn deref(&self) -> &InterpretedSystem {
        // It is present until this is dropped.
        self.system.as_ref().unwrap_or_else(|| unreachable!())
    }
}

impl Drop for PooledSystem<'_> {
    fn drop(&mut self) {
        let mut systems = self.of.lock().unwrap_or_else(PoisonError::into_inner);
        systems.extend(self.system.take());
    }
}

impl Machine {
    /// A system of this machine for exclusive use.
    pub fn system(&self) -> PooledSystem<'_> {
        let free = self
            .systems
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .pop();
        PooledSystem {
            system: Some(free.unwrap_or_else(|| self.machine.prepare())),
            of: &self.systems,
        }
    }

    /// The machine with the same values in the Cartesian coordinates that its spec names, if it names any.
    pub fn in_cartesian(&self) -> Option<(InterpretedMachine, &ChartedPoints)> {
        let other = self.derived.cartesian()?;
        let mut machine = other.machine.clone();
        let parameters = self.derived.parameters.iter().map(|(name, ..)| name);
        let parameters = parameters.zip(self.machine.parameter_values());
        let inputs = self.derived.inputs.iter().map(|(name, ..)| name);
        for (name, value) in parameters.chain(inputs.zip(&self.inputs.values)) {
            machine.set(name, *value).ok()?;
        }
        let engine = if self.is_interpreted {
            Engine::Interpreter
        } else {
            Engine::Auto
        };
        machine.set_engine(engine).ok()?;
        Some((machine, &other.points))
    }

    pub fn dimension(&self) -> usize {
        self.derived.coordinates.len()
    }

    /// Raises `MissingParameters` where a parameter has no value.
    pub fn check_parameters(&self, py: Python<'_>) -> PyResult<()> {
        let checked = self.machine.check_parameters();
        checked.map_err(|missing| {
            errors::raise(
                py,
                "MissingParameters",
                (missing.to_string(), missing.names),
            )
        })
    }
}

/// The Python function that evaluates batches, because the Python half broadcasts arguments.
static BATCH: PyOnceLock<Py<PyAny>> = PyOnceLock::new();

/// A contiguous vector of n numbers, without a copy; `None` for anything else.
fn vector<'py>(given: Option<&Bound<'py, PyAny>>, n: usize) -> Option<PyReadonlyArray1<'py, f64>> {
    let array = given?.cast::<PyArray1<f64>>().ok()?;
    let array = array.try_readonly().ok()?;
    (array.len() == n && array.is_contiguous()).then_some(array)
}

#[pymethods]
impl Machine {
    #[new]
    #[pyo3(signature = (program, parameters, inputs))]
    fn new(program: &Program, parameters: Vec<f64>, inputs: Vec<f64>) -> PyResult<Machine> {
        let derived = program.derived.clone();
        let mut machine = derived.machine.clone();
        let names = derived
            .parameters
            .iter()
            .map(|(name, ..)| name)
            .zip(&parameters);
        let others = derived.inputs.iter().map(|(name, ..)| name).zip(&inputs);
        for (name, value) in names.chain(others) {
            let set = machine.set(name, *value);
            set.map_err(|unknown| PyValueError::new_err(unknown.to_string()))?;
        }
        let engine = ENGINES[usize::from(ENGINE.load(Ordering::Relaxed))].1;
        machine
            .set_engine(engine)
            .map_err(|none| PyValueError::new_err(none.to_string()))?;
        let system = machine.prepare();
        Ok(Machine {
            inputs: system.default_inputs(),
            systems: Mutex::new(vec![system]),
            is_interpreted: matches!(engine, Engine::Interpreter),
            derived,
            machine,
        })
    }

    #[getter(_program)]
    fn program(&self) -> Program {
        Program {
            derived: self.derived.clone(),
        }
    }

    /// The values of parameters and of inputs.
    #[getter(_values)]
    fn values(&self) -> (Vec<f64>, Vec<f64>) {
        (
            self.machine.parameter_values().to_vec(),
            self.inputs.values.clone(),
        )
    }

    /// The start of the spec for these parameters: coordinates and rates.
    fn _start<'py>(
        &self,
        py: Python<'py>,
    ) -> (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>) {
        let start = self.machine.start();
        (
            PyArray1::from_vec(py, start.q.values),
            PyArray1::from_vec(py, start.v.values),
        )
    }

    /// Accelerations. One state given as contiguous arrays is evaluated directly, everything else as a batch.
    #[pyo3(signature = (q=None, v=None, t=None, *, u=None, parameters=None, singular="raise", out=None))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords")]
    fn accelerations<'py>(
        slf: &Bound<'py, Self>,
        q: Option<&Bound<'py, PyAny>>,
        v: Option<&Bound<'py, PyAny>>,
        t: Option<&Bound<'py, PyAny>>,
        u: Option<&Bound<'py, PyAny>>,
        parameters: Option<&Bound<'py, PyAny>>,
        singular: &str,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = slf.py();
        let this = slf.get();
        let n = this.dimension();
        let time = match t {
            None => Some(0.0),
            Some(t) => t
                .cast_exact::<pyo3::types::PyFloat>()
                .ok()
                .map(|t| t.value()),
        };
        if u.is_none()
            && parameters.is_none()
            && out.is_none()
            && singular == "raise"
            && let (Some(t), Some(q), Some(v)) = (time, vector(q, n), vector(v, n))
        {
            let (q, v) = (q.as_slice()?.to_vec(), v.as_slice()?.to_vec());
            let mut a = vec![0.0; n];
            let system = this.system();
            if let Err(found) = system.accelerations(t, &q, &v, &this.inputs, &mut a) {
                this.check_parameters(py)?;
                if t.is_finite() && q.iter().chain(&v).all(|x| x.is_finite()) {
                    return Err(errors::of_singular(py, &*system, found, None));
                }
                a.fill(f64::NAN);
            }
            return Ok(PyArray1::from_vec(py, a).into_any());
        }
        let batch = BATCH.get_or_try_init(py, || {
            let module = py.import("lagrangian._batch")?;
            module.getattr("accelerations").map(Bound::unbind)
        })?;
        let keywords = PyDict::new(py);
        keywords.set_item("u", u)?;
        keywords.set_item("parameters", parameters)?;
        keywords.set_item("singular", singular)?;
        keywords.set_item("out", out)?;
        let t = match t {
            Some(t) => t.clone(),
            None => 0.0_f64.into_pyobject(py)?.into_any(),
        };
        batch.bind(py).call((slf, q, v, t), Some(&keywords))
    }
}
