//! Why a command did not do what it was asked.

use std::fmt::Display;

use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::Sources;
use serde_json::{Map, Value, json};

use crate::diagnostics;
use crate::interrupt;
use crate::output;

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

    /// Says why: for a reader on standard error, for a program on standard output. Returns the exit status.
    pub fn report(self, json: bool) -> u8 {
        let mut fields = Map::new();
        let (status, message) = match self {
            Failure::Said => return 1,
            Failure::Interrupted => return interrupt::STATUS,
            Failure::Spec(wrong) => {
                let (report, sources) = *wrong;
                if json {
                    let entries = diagnostics::entries(&report, &sources);
                    output::line(format_args!(
                        "{:#}",
                        json!({ "error": "the spec is wrong", "diagnostics": entries })
                    ));
                }
                diagnostics::print(&report, &sources);
                return 1;
            }
            Failure::Run(message) => (1, message),
            Failure::Detailed(message, further) => {
                fields = further;
                (1, message)
            }
            Failure::Call(message) => (2, message),
        };
        if json {
            let mut document = json!({ "error": message });
            if let Some(document) = document.as_object_mut() {
                document.extend(fields);
            }
            output::line(format_args!("{document:#}"));
        }
        output::complain(format_args!("error: {message}"));
        status
    }
}
