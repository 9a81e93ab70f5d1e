//! Errors of runs whose reason the spec states.

use lagrangian::Error;
use lagrangian_spec::model::Model;
use lagrangian_spec::source::{Sources, Span};

/// An error of a run whose reason the spec states.
#[derive(Debug)]
pub struct Placed {
    /// The error.
    pub message: String,
    pub(crate) span: Span,
    pub(crate) sources: Sources,
}

impl Placed {
    /// An error of a run of this model; `None` if its reason is not a line of the spec.
    pub fn of(error: &Error, model: &Model<'_>, sources: &Sources) -> Option<Placed> {
        let Error::AssumptionEnded { assumption, .. } = error else {
            return None;
        };
        let mut assumptions = model.assumptions.iter();
        let stated = assumptions.find(|stated| stated.text == *assumption)?;
        Some(Placed {
            message: error.to_string(),
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
