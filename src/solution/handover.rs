//! Changes of a run to time stepping and back.

use crate::Warning;

/// A run with unilateral contacts changed to time stepping, or back to locating every event.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Handover {
    /// The time of the change, in s.
    pub t: f64,
    /// The length of the steps of time stepping that follow, in s, which become longer where everything is at rest. `None` if the run
    /// returns to locating every event.
    pub step: Option<f64>,
    /// The number of instants at which contacts had changed last, and the time in which they did, in s. `None` if contacts did not
    /// settle at one instant, or if the run returns to locating every event.
    pub crowd: Option<(usize, f64)>,
}

/// The warning about these changes, if there are any.
pub(crate) fn warning(handovers: &[Handover]) -> Option<Warning> {
    let first = handovers.first()?;
    Some(Warning::HandedOver {
        t: first.t,
        step: first.step?,
        crowd: first.crowd,
        times: handovers.iter().filter(|of| of.step.is_some()).count(),
        back_at: (handovers.last()).and_then(|last| last.step.is_none().then_some(last.t)),
    })
}
