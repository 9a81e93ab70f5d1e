//! What can be wrong with a spec that is read while the program runs.

use core::fmt::{self, Display};
use std::string::String;
use std::vec::Vec;

use super::Error;

/// A message about a spec: what is wrong, where, and what to write instead.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Diagnostic {
    /// The kind of mistake, `unknown-name`: the same from version to version. The reference lists them.
    pub code: String,
    /// What is wrong: expected, found.
    pub message: String,
    /// What to change.
    pub help: Option<String>,
    /// The file, or the name that the text was given.
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
    /// What stands there.
    pub message: String,
}

/// Parameters to which neither the spec nor anybody else gave a value.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MissingParameters {
    /// Their names.
    pub names: Vec<String>,
}

/// There is no machine code here.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NoMachineCode {
    /// Why.
    pub why: String,
}

impl Display for NoMachineCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.why)
    }
}

impl core::error::Error for NoMachineCode {}

/// A machine cannot be run in the numbers, or with the bounds, that were asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NoNumbers {
    /// Why not, as the end of a sentence that begins with the machine: `it has constraints`.
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
