//! The command `lagrangian`, run in this process.

use std::ffi::OsString;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::RecvTimeoutError;
use std::thread;
use std::time::Duration;

use lagrangian_cli::Answer;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::program::{Program, STACK};

/// How often a running command checks for interruption.
const BETWEEN: Duration = Duration::from_millis(50);

/// Runs the command with these arguments on the standard streams of this process; returns the exit status.
#[pyfunction]
pub fn command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    let name = OsString::from("lagrangian");
    py.detach(|| lagrangian_cli::command(std::iter::once(name).chain(arguments)))
}

/// Runs a command on a file other than a spec, such as a robot description or the rows of a sweep; returns the exit status, the
/// output and the error output.
#[pyfunction]
pub fn answer_of_file(
    py: Python<'_>,
    command: &str,
    path: String,
    options: Vec<String>,
) -> (u8, String, String) {
    let file = lagrangian_sweep::plan::SpecText {
        name: path,
        ..Default::default()
    };
    let stop = Arc::new(AtomicBool::new(false));
    let Answer { status, out, err } =
        py.detach(|| lagrangian_cli::answer(&file, command, &options, &stop));
    (status, out, err)
}

/// Runs a command on a machine in memory; returns the exit status, the output and the error output.
#[pyfunction]
pub fn answer(
    py: Python<'_>,
    program: &Program,
    command: &str,
    options: Vec<String>,
) -> PyResult<(u8, String, String)> {
    let stop = Arc::new(AtomicBool::new(false));
    let answered = py.detach(|| {
        thread::scope(|scope| {
            let (tell, told) = std::sync::mpsc::channel();
            let (spec, stop, options) = (&program.derived.text, &stop, &options);
            let work = move || {
                let _ = tell.send(lagrangian_cli::answer(spec, command, options, stop));
            };
            let thread = thread::Builder::new().stack_size(STACK);
            thread.spawn_scoped(scope, work).map_err(|error| {
                PyRuntimeError::new_err(format!("cannot start a thread: {error}"))
            })?;
            loop {
                match told.recv_timeout(BETWEEN) {
                    Ok(answer) => return Ok(Some(answer)),
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
    let Answer { status, out, err } = answered?.unwrap_or_default();
    Ok((status, out, err))
}
