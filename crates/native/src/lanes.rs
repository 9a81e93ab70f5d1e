//! Several states side by side, as they are stored in memory.

use core::ops::{Add, Div, Index, IndexMut, Mul, Neg, Sub};

/// `N` numbers side by side: the same quantity of `N` states, or of `N` sets of parameters. `N` is
/// 2, 4 or 8.
///
/// This is the form in memory: `N` `f64`, one after another, at an address that `malloc` may return. The arithmetic
/// of a machine goes through [`Number::run`](crate::Number::run), in the best registers of the processor. The
/// operators of this type compute each lane as an `f64`, with the same bits.
///
/// ```
/// use lagrangian_native::Lanes;
/// let angles = Lanes([0.1, 0.2, 0.3, 0.4]);
/// assert_eq!(angles[2], 0.3);
/// assert_eq!(Lanes::<4>::splat(9.81), Lanes([9.81; 4]));
/// assert_eq!(angles * Lanes::splat(2.0) - angles, angles);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(16))]
pub struct Lanes<const N: usize>(pub [f64; N]);

impl<const N: usize> Lanes<N> {
    /// One number in every lane.
    #[inline(always)]
    pub const fn splat(x: f64) -> Self {
        Lanes([x; N])
    }
}

impl<const N: usize> Default for Lanes<N> {
    /// Zeros.
    #[inline(always)]
    fn default() -> Self {
        Lanes::splat(0.0)
    }
}

impl<const N: usize> From<[f64; N]> for Lanes<N> {
    #[inline(always)]
    fn from(numbers: [f64; N]) -> Self {
        Lanes(numbers)
    }
}

impl<const N: usize> Index<usize> for Lanes<N> {
    type Output = f64;

    #[inline(always)]
    fn index(&self, lane: usize) -> &f64 {
        &self.0[lane]
    }
}

impl<const N: usize> IndexMut<usize> for Lanes<N> {
    #[inline(always)]
    fn index_mut(&mut self, lane: usize) -> &mut f64 {
        &mut self.0[lane]
    }
}

macro_rules! lane_by_lane {
    ($($trait:ident, $method:ident, $sign:tt;)*) => {$(
        impl<const N: usize> $trait for Lanes<N> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // A loop and no closure: a closure called for each lane is not inlined into code for wide registers.
                let mut lanes = self;
                for (lane, other) in lanes.0.iter_mut().zip(other.0) {
                    *lane $sign other;
                }
                lanes
            }
        }
    )*};
}

lane_by_lane! {
    Add, add, +=;
    Sub, sub, -=;
    Mul, mul, *=;
    Div, div, /=;
}

impl<const N: usize> Neg for Lanes<N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        let mut lanes = self;
        for lane in &mut lanes.0 {
            *lane = -*lane;
        }
        lanes
    }
}
