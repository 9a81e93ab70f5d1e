//! The reasons why a command fails.

use std::fmt::Display;

use lagrangian_spec::diagnostic::{Report, most_similar};
use lagrangian_spec::model::Model;
use lagrangian_spec::source::Sources;
use serde_json::{Map, Value};

use crate::placed::Placed;

/// Why a command failed.
#[derive(Debug)]
pub enum Failure {
    /// The spec is invalid.
    Spec(Box<(Report, Sources)>),
    /// The machine or the run fails, or a file cannot be written.
    Run(String),
    /// Like [`Failure::Run`], with further fields for programs.
    Detailed(String, Map<String, Value>),
    /// Like [`Failure::Run`], for a reason that the spec states.
    Placed(Box<Placed>),
    /// Like [`Failure::Run`], but the message has been printed.
    AlreadyReported,
    /// The user interrupted it, and the message has been printed.
    Interrupted,
    /// The call is invalid.
    Call(String),
    /// Like [`Failure::Call`], for a value that does not fit a declaration in the spec.
    PlacedCall(Box<Placed>),
}

impl Failure {
    /// A failure of the machine or the run.
    pub fn run(error: impl Display) -> Failure {
        Failure::Run(error.to_string())
    }

    /// The reason in one sentence, unless it has been printed.
    pub fn message(self) -> String {
        match self {
            Failure::Run(message) | Failure::Call(message) | Failure::Detailed(message, _) => {
                message
            }
            Failure::Placed(placed) | Failure::PlacedCall(placed) => placed.message,
            Failure::Spec(_) => "the spec is invalid".to_owned(),
            Failure::AlreadyReported | Failure::Interrupted => String::new(),
        }
    }
}

impl Failure {
    /// This failure, with the place in the spec if its message contains the error of a run whose reason the spec states.
    pub fn placed(self, model: &Model<'_>, sources: &Sources) -> Failure {
        match self {
            Failure::Run(message) => match Placed::of_message(&message, model, sources) {
                Some(placed) => Failure::Placed(Box::new(placed)),
                None => Failure::Run(message),
            },
            other => other,
        }
    }
}

/// Help for a name that is not known: the name that was probably meant, or all that there are.
pub fn help_with<'n>(name: &str, known: impl Iterator<Item = &'n str>) -> String {
    let known: Vec<&str> = known.collect();
    match (most_similar(name, known.iter().copied()), &known[..]) {
        (Some(near), _) => format!("did you mean `{near}`?"),
        (None, []) => "there are none".to_owned(),
        (None, known) => format!("there are: {}", known.join(", ")),
    }
}
