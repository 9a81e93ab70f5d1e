//! Why a command did not do what it was asked.

use std::fmt::Display;

use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::Sources;
use serde_json::{Map, Value};

/// Why a command did not do what it was asked.
#[derive(Debug)]
pub enum Failure {
    /// The spec is wrong.
    Spec(Box<(Report, Sources)>),
    /// The machine or the run is at fault, or a file cannot be written.
    Run(String),
    /// As [`Failure::Run`], with further fields for programs.
    Detailed(String, Map<String, Value>),
    /// As [`Failure::Run`], but everything was said already.
    Said,
    /// The user ended it, and everything was said.
    Interrupted,
    /// The call is at fault.
    Call(String),
}

impl Failure {
    /// The machine or the run is at fault.
    pub fn run(error: impl Display) -> Failure {
        Failure::Run(error.to_string())
    }

    /// Why, in one sentence, where that was not said before.
    pub fn message(self) -> String {
        match self {
            Failure::Run(message) | Failure::Call(message) | Failure::Detailed(message, _) => {
                message
            }
            Failure::Spec(_) => "the spec is wrong".to_owned(),
            Failure::Said | Failure::Interrupted => String::new(),
        }
    }
}
