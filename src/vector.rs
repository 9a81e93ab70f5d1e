//! The vectors of the integrators.

use core::fmt::Debug;

use crate::step_number::StepNumber;

/// A row of numbers whose length is fixed when the machine is prepared: `[f64; N]` in compiled
/// machines, `Vec<f64>` in interpreted ones; `[N; D]` for other numbers.
///
/// With `[f64; N]` the compiler knows every length, unrolls and vectorizes loops, and nothing is allocated.
pub trait Vector<N = f64>: Clone + Debug + PartialEq {
    /// `length` zeros. An array has its own length and ignores `length`.
    fn zeros(length: usize) -> Self;

    /// The numbers.
    fn as_slice(&self) -> &[N];

    /// The numbers, mutable.
    fn as_mut_slice(&mut self) -> &mut [N];

    /// Zeros, as many as there are numbers in `self`.
    fn zeros_like(&self) -> Self {
        Self::zeros(self.as_slice().len())
    }

    /// Several vectors of zeros, each with as many as there are numbers in `self`.
    #[doc(hidden)]
    fn several_zeros_like<const K: usize>(&self) -> [Self; K] {
        core::array::from_fn(|_| self.zeros_like())
    }
}

impl<N: StepNumber, const D: usize> Vector<N> for [N; D] {
    #[inline(always)]
    fn zeros(_length: usize) -> Self {
        [N::NOTHING; D]
    }

    #[inline(always)]
    fn as_slice(&self) -> &[N] {
        self
    }

    #[inline(always)]
    fn as_mut_slice(&mut self) -> &mut [N] {
        self
    }
}

#[cfg(feature = "std")]
impl<N: StepNumber> Vector<N> for std::vec::Vec<N> {
    fn zeros(length: usize) -> Self {
        std::vec![N::NOTHING; length]
    }

    fn as_slice(&self) -> &[N] {
        self
    }

    fn as_mut_slice(&mut self) -> &mut [N] {
        self
    }
}
