//! Sweeps: a plan is text, and a chunk of it a pure function of both.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::RecvTimeoutError;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use lagrangian::interpreted::Engine;
use lagrangian_sweep::rows::{Rows, Values};
use lagrangian_sweep::{Chunk, Plan, Sweep, Wrong, chunk_length};
use numpy::PyArray1;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyList;

use crate::errors;

/// How often a chunk looks whether it is to be interrupted.
const BETWEEN: Duration = Duration::from_millis(50);

/// How many plans are remembered.
const REMEMBERED: usize = 8;

/// Plans that were made ready, the last one used at the end.
static KNOWN: Mutex<VecDeque<(String, Arc<Sweep>)>> = Mutex::new(VecDeque::new());

fn made(py: Python<'_>, text: &str) -> PyResult<Arc<Sweep>> {
    let known = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, sweep)) = known().iter().find(|(of, _)| of == text) {
        return Ok(sweep.clone());
    }
    let plan = Plan::from_json(text)
        .map_err(|error| PyValueError::new_err(format!("this is no plan: {error}")))?;
    let sweep = py.detach(|| Sweep::new(plan, Engine::Auto));
    let sweep = Arc::new(sweep.map_err(|wrong| match wrong {
        Wrong::Plan(message) => PyValueError::new_err(message),
        Wrong::Spec(said) => {
            let (report, sources) = &*said;
            errors::of_spec(
                py,
                errors::shown(report, sources),
                errors::told(report, sources),
            )
        }
    })?);
    let mut known = known();
    if known.len() == REMEMBERED {
        known.pop_front();
    }
    known.push_back((text.to_owned(), sweep.clone()));
    Ok(sweep)
}

/// A plan checked and cut into chunks of about a second: its text, its chunks, its runs, and what it warns of.
#[pyfunction]
pub fn plan(py: Python<'_>, text: &str) -> PyResult<(String, u64, u64, Option<String>)> {
    let sweep = made(py, text)?;
    let mut plan = sweep.plan().clone();
    plan.chunk = py.detach(|| chunk_length(&sweep));
    let warning = sweep.warning().map(str::to_owned);
    Ok((plan.to_json(), plan.chunks(), plan.runs(), warning))
}

/// What ends chunks that are under way.
#[pyclass(frozen, module = "lagrangian._native")]
pub struct Stop(Arc<AtomicBool>);

#[pymethods]
impl Stop {
    #[new]
    fn new() -> Stop {
        Stop(Arc::new(AtomicBool::new(false)))
    }

    fn set(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// The rows of a chunk, and the samples of its runs where the plan asks for them: lists of name, unit and values.
#[pyfunction]
#[pyo3(signature = (text, chunk, stop=None))]
pub fn run_chunk<'py>(
    py: Python<'py>,
    text: &str,
    chunk: u64,
    stop: Option<&Stop>,
) -> PyResult<(Bound<'py, PyList>, Option<Bound<'py, PyList>>)> {
    let sweep = made(py, text)?;
    if chunk >= sweep.plan().chunks() {
        return Err(PyValueError::new_err(format!(
            "there is no chunk {chunk}: the plan has {}",
            sweep.plan().chunks()
        )));
    }
    let own = Arc::new(AtomicBool::new(false));
    let stop = stop.map_or(own, |stop| stop.0.clone());
    let made: PyResult<Option<Chunk>> = py.detach(|| {
        std::thread::scope(|scope| {
            let (tell, told) = std::sync::mpsc::channel();
            let (sweep, stop) = (&sweep, &stop);
            scope.spawn(move || {
                let _ = tell.send(sweep.run_chunk(chunk, stop));
            });
            loop {
                match told.recv_timeout(BETWEEN) {
                    Ok(made) => return Ok(made),
                    // The thread has panicked, which its scope passes on.
                    Err(RecvTimeoutError::Disconnected) => return Ok(None),
                    Err(RecvTimeoutError::Timeout) => {}
                }
                if let Err(interrupt) = Python::attach(|py| py.check_signals()) {
                    stop.store(true, Ordering::Relaxed);
                    return Err(interrupt);
                }
            }
        })
    });
    let Some(made) = made? else {
        return Err(PyRuntimeError::new_err("the chunk was stopped"));
    };
    let rows = columns(py, made.rows)?;
    let samples = made
        .samples
        .map(|samples| columns(py, samples))
        .transpose()?;
    Ok((rows, samples))
}

fn columns(py: Python<'_>, rows: Rows) -> PyResult<Bound<'_, PyList>> {
    let list = PyList::empty(py);
    for (column, values) in rows.columns.into_iter().zip(rows.values) {
        let values = match values {
            Values::Number(values) => {
                let values = values.into_iter().map(|value| value.unwrap_or(f64::NAN));
                PyArray1::from_iter(py, values).into_any()
            }
            Values::Count(values) => PyArray1::from_vec(py, values).into_any(),
            Values::Text(values) => PyList::new(py, values)?.into_any(),
        };
        list.append((column.name, column.unit, values))?;
    }
    Ok(list)
}
