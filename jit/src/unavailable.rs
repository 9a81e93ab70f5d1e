//! Why there is no machine code.

use std::fmt;
use std::io;

/// Why there is no machine code.
#[derive(Debug)]
pub enum Unavailable {
    /// No code can be generated for this processor, or the build requires the same bits everywhere.
    Processor,
    /// The system provides no executable pages.
    Pages(io::Error),
    /// The code of a series would be too long.
    TooLong,
    /// An instruction has no encoding: a defect of this crate.
    Encoding(String),
}

impl fmt::Display for Unavailable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unavailable::Processor => f.write_str(
                "machine code is generated only for x86-64 with AVX2 and FMA, in builds without strict-libm",
            ),
            Unavailable::Pages(error) => {
                write!(f, "the operating system provides no pages for machine code: {error}")
            }
            Unavailable::TooLong => f.write_str("the code of the series would be too long"),
            Unavailable::Encoding(error) => write!(f, "an instruction has no encoding: {error}"),
        }
    }
}

impl std::error::Error for Unavailable {}
