//! Errors whose reason is a line of the spec.

use lagrangian::Error;
use lagrangian_spec::model::Model;
use lagrangian_spec::source::{Sources, Span};

/// An error whose reason is a line of the spec.
#[derive(Debug)]
pub struct Placed {
    /// The error.
    pub message: String,
    /// What the line says, where that is not the error itself.
    pub(crate) note: Option<String>,
    pub(crate) span: Span,
    pub(crate) sources: Sources,
}

impl Placed {
    /// An error of a run of this model; `None` if its reason is not a line of the spec.
    pub fn of(error: &Error, model: &Model<'_>, sources: &Sources) -> Option<Placed> {
        match error {
            Error::AssumptionEnded { .. } => Placed::of_message(&error.to_string(), model, sources),
            _ => None,
        }
    }

    /// A message that contains the error of a run of this model; `None` if its reason is not a line of the spec.
    pub fn of_message(message: &str, model: &Model<'_>, sources: &Sources) -> Option<Placed> {
        let mut assumptions = model.assumptions.iter();
        // These are the words of `Error::AssumptionEnded`.
        let stated = assumptions.find(|stated| {
            let words = format!(
                "the machine assumes `{}`, which does not hold at t",
                stated.text
            );
            message.contains(&words)
        })?;
        Some(Placed {
            message: message.to_owned(),
            note: None,
            span: stated.span,
            sources: sources.clone(),
        })
    }

    /// The place in the spec: `swing.machine:7:14`.
    pub fn place(&self) -> String {
        let (line, column) = self.sources.line_column(self.span);
        format!("{}:{line}:{column}", self.sources.name(self.span.source))
    }
}
