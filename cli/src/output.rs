//! What leaves the command: standard output, standard error, and files.
//!
//! Every text passes through here, since all of it may fail: a pipe that nobody reads any more, a full disk. What cannot be
//! written to standard output is remembered, and decides the exit status at the end ([`finish`]). Files are a matter of
//! [`Destination`].

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

/// What went wrong first with standard output.
static FAILED: OnceLock<io::Error> = OnceLock::new();

/// Whether a file of the command is standard output itself, so that what is said stands beside it.
static IS_TAKEN: AtomicBool = AtomicBool::new(false);

/// Writes a line to standard output.
pub fn line(line: impl Display) {
    text(&format!("{line}\n"));
}

/// Writes a text that ends with its own line break to standard output; to standard error where standard output is a file
/// that was asked for.
pub fn text(text: &str) {
    match IS_TAKEN.load(Ordering::Relaxed) {
        _ if host::keeps(text, false) => {}
        true => complain_as_is(text),
        false => {
            // Why it fails is told once, at the end.
            let _ = bytes(text.as_bytes());
        }
    }
}

/// Writes a line to standard error. Where that fails there is nobody left to tell.
pub fn complain(line: impl Display) {
    complain_as_is(&format!("{line}\n"));
}

fn complain_as_is(text: &str) {
    if host::keeps(text, true) {
        return;
    }
    progress::end();
    let _ = io::stderr().lock().write_all(text.as_bytes());
}

/// Writes to standard output, and remembers what goes wrong.
fn bytes(bytes: &[u8]) -> io::Result<()> {
    progress::end();
    let written = match FAILED.get() {
        Some(error) => Err(same(error)),
        None => io::stdout().lock().write_all(bytes),
    };
    written.map_err(remember)
}

fn remember(error: io::Error) -> io::Error {
    same(FAILED.get_or_init(|| error))
}

/// Takes note of what somebody else wrote to standard output.
pub fn remember_result(written: io::Result<()>) {
    if let Err(error) = written {
        remember(error);
    }
}

/// An error that says the same: the type cannot be copied.
fn same(error: &io::Error) -> io::Error {
    match error.raw_os_error() {
        Some(code) => io::Error::from_raw_os_error(code),
        None => io::Error::from(error.kind()),
    }
}

/// Standard output as a file that was asked for.
struct Taken;

impl Write for Taken {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        bytes(buffer).map(|()| buffer.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        io::stdout().lock().flush().map_err(remember)
    }
}

/// The end of standard output.
///
/// # Errors
/// What went wrong with it first.
pub fn finish() -> io::Result<()> {
    let flushed = io::stdout().lock().flush().map_err(remember);
    match FAILED.get() {
        Some(error) => Err(same(error)),
        None => flushed,
    }
}
