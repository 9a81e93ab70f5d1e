//! When a run went on by time stepping, and back.

use crate::Warning;

/// A run with unilateral contacts went on by time stepping, or found every event again.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Handover {
    /// When, in s.
    pub t: f64,
    /// The length of the steps of time stepping that follow, in s, which are longer where everything rests; none where every event is
    /// found again.
    pub step: Option<f64>,
    /// At how many instants contacts had changed last, and within how long, in s. None where they did not settle at one instant, or
    /// where every event is found again.
    pub crowd: Option<(usize, f64)>,
}

/// What the user should know of them.
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
