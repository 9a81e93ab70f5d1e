//! The arguments of a function of several states.

use lagrangian_native::Lanes;

/// The arguments of a call for N states side by side. Arguments that the function does not read may be empty.
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
