//! Compensated sums.

use core::ops::{Add, Sub};

/// A compensated sum: its value is `high + low`, with `|low|` at most half a unit in the last
/// place of `high`.
///
/// A million steps of 10⁻⁶ s add up to 1 s to the last bit; plain addition has an error of 10⁻¹¹ s.
/// D. E. Knuth, *The Art of Computer Programming*, vol. 2, section 4.2.2, theorem B.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Sum<N = f64> {
    pub high: N,
    pub low: N,
}

impl Sum {
    /// The sum with `term` added.
    #[inline(always)]
    pub fn plus(self, term: f64) -> Self {
        let (high, low) = two_sum(self.high, self.low + term);
        Self { high, low }
    }
}

/// Returns `a + b` rounded and its exact rounding error; for double-doubles the error is nearly exact.
#[inline(always)]
pub(crate) fn two_sum<N: Copy + Add<Output = N> + Sub<Output = N>>(a: N, b: N) -> (N, N) {
    let sum = a + b;
    let b_seen = sum - a;
    let a_seen = sum - b_seen;
    (sum, (a - a_seen) + (b - b_seen))
}
