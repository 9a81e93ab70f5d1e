//! What a function of several states reads.

use lagrangian_native::Lanes;

/// The arguments of a call, those of N states side by side. What a function does not read may be empty.
#[derive(Clone, Copy, Debug)]
pub struct SeveralArguments<'a, const N: usize> {
    /// The times.
    pub t: Lanes<N>,
    /// Coordinates.
    pub q: &'a [Lanes<N>],
    /// Velocities.
    pub v: &'a [Lanes<N>],
    /// Inputs.
    pub u: &'a [Lanes<N>],
    /// Accelerations.
    pub a: &'a [Lanes<N>],
}
