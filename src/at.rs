//! Where a machine is evaluated.

use crate::System;

/// Time, state and inputs at which a machine is evaluated.
pub struct At<'a, S: System> {
    /// Time, in s.
    pub t: f64,
    /// Coordinates.
    pub q: &'a S::Vector,
    /// Rates.
    pub v: &'a S::Vector,
    /// Inputs.
    pub u: &'a S::Inputs,
}

impl<S: System> Clone for At<'_, S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: System> Copy for At<'_, S> {}
