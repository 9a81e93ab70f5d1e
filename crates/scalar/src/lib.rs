//! The number types that a machine can be evaluated over.
//!
//! One trait, [`Scalar`], is all that generated code, the interpreter and the evaluator of expressions require of a number.
//! Each type decides how exact it is: `f64` rounds, [`DoubleDouble`] rounds with twice the digits, [`Interval`] encloses,
//! [`Ball`] bounds its error, [`Dual`] carries a derivative, [`Jet`] a truncated power series, and [`Residue`] is exact in
//! a prime field and so proves identities.
#![no_std]

pub mod ball;
pub mod double_double;
pub mod dual;
mod exact;
// Without a feature, unlike that of the runtime: the compiler depends on this crate, and cargo would compile both twice, for the macro without
// the feature and for the command with it.
#[doc(hidden)]
pub mod files;
#[doc(hidden)]
pub mod friction;
pub mod interval;
pub mod jet;
mod kernel;
pub mod projection;
mod real;
pub mod residue;
#[doc(hidden)]
pub mod series;
#[doc(hidden)]
pub mod text;

pub use ball::Ball;
pub use double_double::DoubleDouble;
pub use dual::Dual;
pub use interval::Interval;
pub use jet::Jet;
pub use kernel::{Kernel, Piece};
pub use residue::Residue;

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// A number type that a machine can be evaluated over.
///
/// Provided methods are always inlined, and so must be the implementations for numbers in registers: a function that is
/// not inlined cannot use the instructions that its caller may use.
///
/// Operations never panic. An undefined result (0/0, the root of a negative number) is a value for which
/// [`is_finite`](Scalar::is_finite) is false, and every further operation keeps it so.
pub trait Scalar:
    Copy
    + Debug
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The form in which a number is stored between calls: the type itself, except for numbers that exist in
    /// registers only. Generated code reads its arguments with [`load`](Scalar::load) and writes results
    /// with [`store`](Scalar::store).
    type Stored: Copy;

    /// Loads a stored number.
    fn load(stored: Self::Stored) -> Self;
    /// The number as it is stored.
    fn store(self) -> Self::Stored;

    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// How many pairs of lists are multiplied at once ([`series::sweep`]) if a list that occurs in several pairs is stored and read once: as many
    /// as keep their sums in registers. 0 for numbers that are stored once for each pair, side by side, as a register of several reads them.
    const PAIRS_AT_ONCE: usize = 0;

    /// The number nearest to `x`; exact in every type that contains `f64`.
    fn from_f64(x: f64) -> Self;
    /// The number nearest to `numerator / denominator`, `denominator > 0`.
    fn from_ratio(numerator: i64, denominator: i64) -> Self;
    /// π.
    fn pi() -> Self;
    /// A whole number `n`, `0 < n < 2⁴⁰`, as the divisor of many numbers, for [`over`](Scalar::over).
    #[inline(always)]
    fn divisor(n: i64) -> [Self; 2] {
        [Self::from_ratio(n, 1), Self::ZERO]
    }
    /// `self / n` for a [`divisor`](Scalar::divisor), rounded like a quotient unless that is subnormal; 0 of either sign if
    /// `self` is 0, and not finite if `self` is not.
    #[inline(always)]
    fn over(self, [n, _]: [Self; 2]) -> Self {
        self / n
    }

    /// `self·b + c`; rounded once in types that say so, and like separate operations in all others.
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }
    /// `self·b − c`, rounded like [`mul_add`](Scalar::mul_add).
    #[inline(always)]
    fn mul_sub(self, b: Self, c: Self) -> Self {
        self * b - c
    }
    /// `c − self·b`, rounded like [`mul_add`](Scalar::mul_add).
    #[inline(always)]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        c - self * b
    }
    /// Two sums. Like the functions below, one instruction if a register holds two numbers.
    #[inline(always)]
    fn add_each(a: [Self; 2], b: [Self; 2]) -> [Self; 2] {
        [a[0] + b[0], a[1] + b[1]]
    }
    /// Two differences.
    #[inline(always)]
    fn sub_each(a: [Self; 2], b: [Self; 2]) -> [Self; 2] {
        [a[0] - b[0], a[1] - b[1]]
    }
    /// Two products.
    #[inline(always)]
    fn mul_each(a: [Self; 2], b: [Self; 2]) -> [Self; 2] {
        [a[0] * b[0], a[1] * b[1]]
    }
    /// Two quotients.
    #[inline(always)]
    fn div_each(a: [Self; 2], b: [Self; 2]) -> [Self; 2] {
        [a[0] / b[0], a[1] / b[1]]
    }
    /// [`mul_add`](Scalar::mul_add) twice.
    #[inline(always)]
    fn mul_add_each(a: [Self; 2], b: [Self; 2], c: [Self; 2]) -> [Self; 2] {
        [a[0].mul_add(b[0], c[0]), a[1].mul_add(b[1], c[1])]
    }
    /// [`mul_sub`](Scalar::mul_sub) twice.
    #[inline(always)]
    fn mul_sub_each(a: [Self; 2], b: [Self; 2], c: [Self; 2]) -> [Self; 2] {
        [a[0].mul_sub(b[0], c[0]), a[1].mul_sub(b[1], c[1])]
    }
    /// [`neg_mul_add`](Scalar::neg_mul_add) twice.
    #[inline(always)]
    fn neg_mul_add_each(a: [Self; 2], b: [Self; 2], c: [Self; 2]) -> [Self; 2] {
        [a[0].neg_mul_add(b[0], c[0]), a[1].neg_mul_add(b[1], c[1])]
    }
    /// The rounding error of `self·b`: exactly `self·b − (self * b)`. 0 for types whose products are exact, or whose
    /// error does not matter.
    ///
    /// The phase of a drive, ω·t, is rounded to 1e-14 after a minute at 100 rad/s, a hundred times worse than everything
    /// that follows; with its error known, sine and cosine can be corrected.
    #[inline(always)]
    fn product_error(self, _b: Self) -> Self {
        Self::ZERO
    }

    /// The rounding error of `self + b`: exactly `self + b − (self + b)`; near 0 if a sum is nearly exact.
    ///
    /// O. Møller, *Quasi double-precision in floating point addition*, BIT 5 (1965) 37–50.
    #[inline(always)]
    fn sum_error(self, b: Self) -> Self {
        let sum = self + b;
        let b_kept = sum - self;
        (self - (sum - b_kept)) + (b - b_kept)
    }

    /// Sine and cosine together, at half the cost of computing both separately.
    fn sin_cos(self) -> (Self, Self);
    /// Sines and cosines of several angles; on a processor with vector instructions they cost little more than those of one.
    #[inline(always)]
    fn sin_cos_all<const K: usize>(angles: [Self; K]) -> [(Self, Self); K] {
        angles.map(Self::sin_cos)
    }
    /// Sines and cosines of several angles, and true; or arbitrary numbers and false, if one of the angles in the lanes is too
    /// large for the polynomials that the others take. A caller that then evaluates again, one number after another, has one
    /// branch at the end of its arithmetic instead of one at each angle.
    #[inline(always)]
    fn sin_cos_all_near<const K: usize>(angles: [Self; K]) -> ([(Self, Self); K], bool) {
        (Self::sin_cos_all(angles), true)
    }
    /// `Σⱼ aⱼ b₍n−1−j₎` for `P` pairs of lists of `n` numbers each, stored side by side; summed from the
    /// middle outwards ([`series::convolve_all`]).
    #[inline(always)]
    fn convolve_all<const P: usize>(a: &[[Self::Stored; P]], b: &[[Self::Stored; P]]) -> [Self; P] {
        series::convolve_all(a, b)
    }
    /// Stores a row of numbers that [`convolve_all`](Scalar::convolve_all) reads.
    #[inline(always)]
    fn store_all<const P: usize>(row: &mut [Self::Stored; P], numbers: [Self::Stored; P]) {
        *row = numbers;
    }
    /// Sine.
    #[inline(always)]
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    /// Cosine.
    #[inline(always)]
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// Tangent.
    #[inline(always)]
    fn tan(self) -> Self {
        let (sin, cos) = self.sin_cos();
        sin / cos
    }
    /// Inverse sine, in [−π/2, π/2].
    fn asin(self) -> Self;
    /// Inverse cosine, in [0, π].
    fn acos(self) -> Self;
    /// Inverse tangent, in (−π/2, π/2).
    fn atan(self) -> Self;
    /// The angle of the point (`x`, `self`), in (−π, π].
    fn atan2(self, x: Self) -> Self;
    /// Hyperbolic sine.
    fn sinh(self) -> Self;
    /// Hyperbolic cosine.
    fn cosh(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// e to the power `self`.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// `self` to a real power, for positive `self`.
    fn powf(self, exponent: Self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// −1, 0 or 1 with the sign of `self`; 0 at 0.
    fn sign(self) -> Self;
    /// The smaller of the two.
    fn min(self, other: Self) -> Self;
    /// The larger of the two.
    fn max(self, other: Self) -> Self;

    /// `self` to an integer power, by squaring.
    #[inline(always)]
    fn powi(self, exponent: i32) -> Self {
        let mut result = Self::ONE;
        let mut square = self;
        let mut left = exponent.unsigned_abs();
        while left > 0 {
            if left & 1 == 1 {
                result = result * square;
            }
            left >>= 1;
            if left > 0 {
                square = square * square;
            }
        }
        if exponent < 0 {
            Self::ONE / result
        } else {
            result
        }
    }

    /// Whether `self` is finite and defined (in every lane, if it has several).
    fn is_finite(self) -> bool;
    /// Whether `self > bound` holds for certain (in every lane, for every number of an interval). False if either
    /// is undefined. In a field without an order: whether the two differ.
    fn exceeds(self, bound: Self) -> bool;
    /// The nearest `f64`, for messages.
    fn to_f64(self) -> f64;

    /// Runs a piece of a long function as a function of its own, with the instructions that its caller may use.
    #[inline(never)]
    fn call<P: Piece>(piece: P) -> P::Output {
        piece.run()
    }
}
