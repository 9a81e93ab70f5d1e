//! Why a command did not do what it was asked.

use std::fmt::Display;
use std::process::ExitCode;

use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::Sources;
use serde_json::json;

use crate::diagnostics;
use crate::output;

/// Why a command did not do what it was asked.
#[derive(Debug)]
pub enum Failure {
    /// The spec is wrong.
    Spec(Box<(Report, Sources)>),
    /// The machine or the run is at fault.
    Run(String),
    /// As [`Failure::Run`], but everything was said already.
    Said,
    /// The call is at fault.
    Call(String),
}

impl Failure {
    /// The machine or the run is at fault.
    pub fn run(error: impl Display) -> Failure {
        Failure::Run(error.to_string())
    }

    /// Says why: for a reader on standard error, for a program on standard output.
    pub fn report(self, json: bool) -> ExitCode {
        let (status, message) = match self {
            Failure::Said => return ExitCode::from(1),
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
                return ExitCode::from(1);
            }
            Failure::Run(message) => (1, message),
            Failure::Call(message) => (2, message),
        };
        if json {
            output::line(format_args!("{:#}", json!({ "error": message })));
        }
        eprintln!("error: {message}");
        ExitCode::from(status)
    }
}
