//! Sweeps: a plan is a text, and a chunk is a pure function of the plan and its index.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::RecvTimeoutError;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use lagrangian::interpreted::Engine;
use lagrangian_sweep::rows::{Rows, Values};
use lagrangian_sweep::table::Format;
use lagrangian_sweep::{
    Chunk, Contents, Folder, FolderError, Plan, PlanError, Progress, Sweep, chunk_length, contents,
    run_all,
};
use numpy::PyArray1;
use pyo3::exceptions::{PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyList};

use crate::errors;

/// How often a chunk checks for interruption.
const BETWEEN: Duration = Duration::from_millis(50);

/// The size of the cache of plans.
const REMEMBERED: usize = 8;

/// The cache of prepared plans, the most recently used last.
static KNOWN: Mutex<VecDeque<(String, Arc<Sweep>)>> = Mutex::new(VecDeque::new());

fn read(text: &str) -> PyResult<Plan> {
    Plan::from_json(text)
        .map_err(|error| PyValueError::new_err(format!("this is not a plan: {error}")))
}

fn prepare(py: Python<'_>, text: &str) -> PyResult<Arc<Sweep>> {
    let known = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, sweep)) = known().iter().find(|(of, _)| of == text) {
        return Ok(sweep.clone());
    }
    let plan = read(text)?;
    let sweep = py.detach(|| Sweep::new(plan, Engine::Auto));
    let sweep = Arc::new(sweep.map_err(|wrong| match wrong {
        PlanError::Plan(message) => PyValueError::new_err(message),
        PlanError::Spec(said) => {
            let (report, sources) = &*said;
            errors::of_spec(
                py,
                errors::as_text(report, sources),
                errors::as_values(report, sources),
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

/// Checks a plan and cuts it into chunks of about a second; returns its text, the number of chunks, the number of
/// runs, and a warning.
#[pyfunction]
pub fn plan(py: Python<'_>, text: &str) -> PyResult<(String, u64, u64, Option<String>)> {
    let sweep = prepare(py, text)?;
    let mut plan = sweep.plan().clone();
    plan.chunk = py.detach(|| chunk_length(&sweep));
    let warning = sweep.warning().map(str::to_owned);
    Ok((plan.to_json(), plan.chunks(), plan.runs(), warning))
}

/// The contents of the files of a chunk that another process stores: rows and samples.
#[pyfunction]
pub fn chunk_file<'py>(
    py: Python<'py>,
    text: &str,
    chunk: u64,
    ending: &str,
) -> PyResult<(Bound<'py, PyBytes>, Option<Bound<'py, PyBytes>>)> {
    let made = one_chunk(py, &*checked(py, text, chunk)?, chunk, None)?;
    let made = py.detach(|| contents(&made, format(ending)))?;
    let samples = made.samples.map(|samples| PyBytes::new(py, &samples));
    Ok((PyBytes::new(py, &made.rows), samples))
}

fn format(ending: &str) -> Format {
    match ending {
        "csv" => Format::Csv,
        _ => Format::Parquet,
    }
}

/// A sweep whose chunks are stored on disk, so that it can be resumed after any interruption.
#[pyclass(frozen, module = "lagrangian._native")]
pub struct Kept {
    sweep: Arc<Sweep>,
    folder: Mutex<Option<Folder>>,
    /// The file to which chunks are joined at the end; `None` if they stay in their folder.
    file: Option<PathBuf>,
    format: Format,
}

fn trouble(trouble: FolderError) -> PyErr {
    match trouble {
        FolderError::File(path, error) => PyOSError::new_err(format!(
            "cannot write {}: {error}; finished chunks are kept, and the same call continues",
            path.display()
        )),
        FolderError::InUse(_) => PyRuntimeError::new_err(trouble.to_string()),
        FolderError::OtherFiles(..) => PyValueError::new_err(trouble.to_string()),
        FolderError::OtherPlan(differences) => PyValueError::new_err(format!(
            "the folder holds another sweep: {}; fresh=True begins again",
            differences.join("; ")
        )),
    }
}

impl Kept {
    fn folder<T>(&self, work: impl FnOnce(&Folder) -> Result<T, FolderError>) -> PyResult<T> {
        let folder = self.folder.lock().unwrap_or_else(PoisonError::into_inner);
        let folder = folder.as_ref();
        let folder = folder.ok_or_else(|| PyRuntimeError::new_err("the sweep has ended"))?;
        work(folder).map_err(trouble)
    }
}

#[pymethods]
impl Kept {
    /// Opens or creates the folder of a plan. Chunks are joined to `file` at the end; if it is `None` they
    /// stay in the folder.
    #[new]
    fn new(
        py: Python<'_>,
        text: &str,
        folder: PathBuf,
        file: Option<PathBuf>,
        ending: &str,
        fresh: bool,
    ) -> PyResult<Kept> {
        let mut plan = read(text)?;
        let opened = py.detach(|| {
            let folder = Folder::open(&folder, format(ending), false)?;
            if fresh {
                folder.clear()?;
            }
            match folder.plan()? {
                Some(known) => {
                    let differences = plan.differences(&known);
                    if !differences.is_empty() {
                        return Err(FolderError::OtherPlan(differences));
                    }
                    plan.chunk = known.chunk;
                }
                None => folder.begin(&plan)?,
            }
            Ok(folder)
        });
        let folder = opened.map_err(trouble)?;
        let sweep = prepare(py, &plan.to_json())?;
        Ok(Kept {
            sweep,
            folder: Mutex::new(Some(folder)),
            format: format(ending),
            file,
        })
    }

    /// The plan, with the length of the stored chunks.
    #[getter]
    fn plan(&self) -> String {
        self.sweep.plan().to_json()
    }

    /// `csv` or `parquet`.
    #[getter]
    fn ending(&self) -> &'static str {
        self.format.extension()
    }

    /// The missing chunks.
    fn missing(&self, py: Python<'_>) -> PyResult<Vec<u64>> {
        let chunks = 0..self.sweep.plan().chunks();
        py.detach(|| {
            self.folder(|folder| {
                Ok(chunks
                    .filter(|k| !folder.has_chunk(&self.sweep, *k))
                    .collect())
            })
        })
    }

    /// Stores a chunk that was made elsewhere.
    fn keep(
        &self,
        py: Python<'_>,
        chunk: u64,
        rows: Vec<u8>,
        samples: Option<Vec<u8>>,
    ) -> PyResult<()> {
        let contents = Contents { rows, samples };
        py.detach(|| self.folder(|folder| folder.store_contents(chunk, &contents)))
    }

    /// Makes the missing chunks with this number of threads; `tell` is called ten times a second with the number of finished runs.
    /// Ctrl-C stops it and loses the chunks under way.
    fn run(&self, py: Python<'_>, threads: usize, tell: Option<Py<PyAny>>) -> PyResult<()> {
        let stop = AtomicBool::new(false);
        let mut raised = None;
        py.detach(|| {
            let watch = &mut |now: Progress| {
                Python::attach(|py| {
                    let outcome = py.check_signals().and_then(|()| match &tell {
                        Some(tell) => tell.call1(py, (now.done,)).map(drop),
                        None => Ok(()),
                    });
                    if let Err(error) = outcome {
                        stop.store(true, Ordering::Relaxed);
                        raised.get_or_insert(error);
                    }
                });
            };
            self.folder(|folder| run_all(&self.sweep, folder, (threads, None), &stop, watch))
        })?;
        raised.map_or(Ok(()), Err)
    }

    /// The rows, and the samples if the plan asks for them. If there is a file, chunks are joined to it and removed first.
    fn end<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyList>, Option<Bound<'py, PyList>>)> {
        let read = py.detach(|| self.folder(|folder| folder.rows(&self.sweep)));
        let (rows, samples) = read?;
        if let Some(file) = &self.file {
            py.detach(|| self.folder(|folder| folder.join(&self.sweep, file)))?;
            let folder = self
                .folder
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .take();
            folder.map_or(Ok(()), Folder::remove).map_err(trouble)?;
        } else {
            self.folder
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .take();
        }
        let samples = samples.map(|samples| columns(py, samples)).transpose()?;
        Ok((columns(py, rows)?, samples))
    }
}

/// Stops chunks that are under way.
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

/// The prepared plan, after checking that it has a chunk with this index.
fn checked(py: Python<'_>, text: &str, chunk: u64) -> PyResult<Arc<Sweep>> {
    let sweep = prepare(py, text)?;
    let chunks = sweep.plan().chunks();
    if chunk < chunks {
        Ok(sweep)
    } else {
        Err(PyValueError::new_err(format!(
            "there is no chunk {chunk}: the plan has {chunks}"
        )))
    }
}

/// Makes a chunk; Ctrl-C interrupts it.
fn one_chunk(py: Python<'_>, sweep: &Sweep, chunk: u64, stop: Option<&Stop>) -> PyResult<Chunk> {
    let own = Arc::new(AtomicBool::new(false));
    let stop = stop.map_or(own, |stop| stop.0.clone());
    let made: PyResult<Option<Chunk>> = py.detach(|| {
        std::thread::scope(|scope| {
            let (tell, told) = std::sync::mpsc::channel();
            let stop = &stop;
            scope.spawn(move || {
                let _ = tell.send(sweep.run_chunk(chunk, stop));
            });
            loop {
                match told.recv_timeout(BETWEEN) {
                    Ok(made) => return Ok(made),
                    // The thread has panicked; its scope propagates the panic.
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
    made?.ok_or_else(|| PyRuntimeError::new_err("the chunk was stopped"))
}

/// The rows of a chunk, and the samples of its runs if the plan asks for them: lists of name, unit and values.
#[pyfunction]
#[pyo3(signature = (text, chunk, stop=None))]
pub fn run_chunk<'py>(
    py: Python<'py>,
    text: &str,
    chunk: u64,
    stop: Option<&Stop>,
) -> PyResult<(Bound<'py, PyList>, Option<Bound<'py, PyList>>)> {
    let made = one_chunk(py, &*checked(py, text, chunk)?, chunk, stop)?;
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
