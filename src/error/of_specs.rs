//! Errors of specs that are read at run time.

use core::fmt::{self, Display};
use std::string::String;
use std::vec::Vec;

use super::Error;

/// A message about a spec: what is wrong, where, and what to write instead.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Diagnostic {
    /// The kind of error, `unknown-name`, which is stable across versions. The reference lists them.
    pub code: String,
    /// What is wrong: expected and found.
    pub message: String,
    /// What to change.
    pub help: Option<String>,
    /// The file, or the name that was given to the text.
    pub file: String,
    /// The line, from 1.
    pub line: usize,
    /// The column, in characters, from 1.
    pub column: usize,
    /// The words that are wrong.
    pub words: String,
    /// Other places that explain it.
    pub notes: Vec<Note>,
}

/// A place that explains a message about another one.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Note {
    /// The file.
    pub file: String,
    /// The line, from 1.
    pub line: usize,
    /// The column, in characters, from 1.
    pub column: usize,
    /// The message about this place.
    pub message: String,
}

/// Parameters that have a value neither from the spec nor from the user.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MissingParameters {
    /// Their names.
    pub names: Vec<String>,
}

/// Machine code is not available.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NoMachineCode {
    /// The reason.
    pub why: String,
}

impl Display for NoMachineCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.why)
    }
}

impl core::error::Error for NoMachineCode {}

/// A machine cannot be run in the requested numbers, or with bounds.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NoNumbers {
    /// The reason, as the end of a sentence whose subject is the machine: `it has constraints`.
    pub why: String,
}

impl Display for NoNumbers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.why)
    }
}

impl core::error::Error for NoNumbers {}

/// `chain.machine:6:27: error: there is no function `sine` [unknown-function]`; then the help and other places, indented.
impl Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            code,
            message,
            help,
            file,
            line,
            column,
            notes,
            ..
        } = self;
        write!(f, "{file}:{line}:{column}: error: {message} [{code}]")?;
        if let Some(help) = help {
            write!(f, "\n    help: {help}")?;
        }
        for Note {
            file,
            line,
            column,
            message,
        } in notes
        {
            write!(f, "\n    note: {file}:{line}:{column}: {message}")?;
        }
        Ok(())
    }
}

impl Display for MissingParameters {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verb = if self.names.len() == 1 { "has" } else { "have" };
        write!(
            f,
            "{} {verb} no value: the spec gives no default",
            self.names.join(", ")
        )
    }
}

impl core::error::Error for MissingParameters {}

impl From<MissingParameters> for Error {
    fn from(error: MissingParameters) -> Self {
        Self::MissingParameters(error)
    }
}

impl From<NoMachineCode> for Error {
    fn from(error: NoMachineCode) -> Self {
        Self::NoMachineCode(error)
    }
}

impl From<NoNumbers> for Error {
    fn from(error: NoNumbers) -> Self {
        Self::NoNumbers(error)
    }
}
