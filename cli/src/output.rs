//! Standard output, for readers that may stop reading.

use std::fmt::Display;
use std::io::Write;

/// Writes a line to standard output. Whoever closes the pipe early (`| head`) has seen enough: that is no error.
pub fn line(text: impl Display) {
    let _ = writeln!(std::io::stdout().lock(), "{text}");
}

/// Writes a text that ends with its own line break.
pub fn text(text: &str) {
    let _ = std::io::stdout().lock().write_all(text.as_bytes());
}
