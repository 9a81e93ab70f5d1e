//! All output of the command: standard output, standard error, and files.
//!
//! Every text passes through here, because writing may fail: a closed pipe, a full disk. An error of standard output is
//! recorded, and determines the exit status at the end ([`finish`]). [`Destination`] handles files.

mod destination;
mod ending;

use std::fmt::Display;
use std::io::{self, Write};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::{host, progress};

pub use destination::{Destination, keep_apart, keep_document_apart};
pub use ending::{
    Endings, LIBRARY, MACHINE, MODEL, ORBIT, PAGE, RUST, SVG, TABLE, UNIT, ending_is_one_of,
};

/// The first error of standard output.
static FAILED: OnceLock<io::Error> = OnceLock::new();

/// Whether an output file of the command is standard output itself, so that messages must go elsewhere.
static IS_TAKEN: AtomicBool = AtomicBool::new(false);

/// Writes a line to standard output.
pub fn line(line: impl Display) {
    text(&format!("{line}\n"));
}

/// Writes a text that ends with a line break to standard output, or to standard error if standard output was
/// requested as a file.
pub fn text(text: &str) {
    if host::captures(text, false) {
        return;
    }
    if IS_TAKEN.load(Ordering::Relaxed) {
        print_error_as_is(text);
    } else {
        // The error is reported once, at the end.
        let _ = bytes(text.as_bytes());
    }
}

/// Writes a line to standard error. Errors of this are ignored, because they cannot be reported.
pub fn print_error(line: impl Display) {
    print_error_as_is(&format!("{line}\n"));
}

fn print_error_as_is(text: &str) {
    if host::captures(text, true) {
        return;
    }
    progress::end();
    let _ = io::stderr().lock().write_all(text.as_bytes());
}

/// Writes to standard output, and records an error.
fn bytes(bytes: &[u8]) -> io::Result<()> {
    progress::end();
    let written = match FAILED.get() {
        Some(error) => Err(same(error)),
        None => io::stdout().lock().write_all(bytes),
    };
    written.map_err(record_failure)
}

fn record_failure(error: io::Error) -> io::Error {
    same(FAILED.get_or_init(|| error))
}

/// Records the result of a write to standard output made elsewhere.
pub fn record_result(written: io::Result<()>) {
    if let Err(error) = written {
        record_failure(error);
    }
}

/// An equivalent error, because the type cannot be cloned.
fn same(error: &io::Error) -> io::Error {
    match error.raw_os_error() {
        Some(code) => io::Error::from_raw_os_error(code),
        None => io::Error::from(error.kind()),
    }
}

/// Standard output that was requested as a file.
struct RedirectedOutput;

impl Write for RedirectedOutput {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        bytes(buffer).map(|()| buffer.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        io::stdout().lock().flush().map_err(record_failure)
    }
}

/// Flushes standard output.
///
/// # Errors
/// The first error of standard output.
pub fn finish() -> io::Result<()> {
    let flushed = io::stdout().lock().flush().map_err(record_failure);
    match FAILED.get() {
        Some(error) => Err(same(error)),
        None => flushed,
    }
}
