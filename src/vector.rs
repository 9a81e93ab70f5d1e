//! The vectors that the integrators do arithmetic on.

use core::fmt::Debug;

/// A row of numbers of a length fixed when the machine is prepared: `[f64; N]` in compiled
/// machines, `Vec<f64>` in interpreted ones.
///
/// With `[f64; N]` the compiler knows every length, unrolls and vectorises; nothing is ever
/// allocated.
pub trait Vector: Clone + Debug + PartialEq {
    /// `length` zeros. An array has its own length and takes no notice of `length`.
    fn zeros(length: usize) -> Self;

    /// The numbers.
    fn as_slice(&self) -> &[f64];

    /// The numbers, to be changed.
    fn as_mut_slice(&mut self) -> &mut [f64];

    /// Zeros, as many as there are numbers in `self`.
    fn zeros_like(&self) -> Self {
        Self::zeros(self.as_slice().len())
    }
}

impl<const N: usize> Vector for [f64; N] {
    #[inline(always)]
    fn zeros(_length: usize) -> Self {
        [0.0; N]
    }

    #[inline(always)]
    fn as_slice(&self) -> &[f64] {
        self
    }

    #[inline(always)]
    fn as_mut_slice(&mut self) -> &mut [f64] {
        self
    }
}

#[cfg(feature = "std")]
impl Vector for std::vec::Vec<f64> {
    fn zeros(length: usize) -> Self {
        std::vec![0.0; length]
    }

    fn as_slice(&self) -> &[f64] {
        self
    }

    fn as_mut_slice(&mut self) -> &mut [f64] {
        self
    }
}
