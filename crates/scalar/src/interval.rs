//! Intervals that enclose the true value: every operation rounds outward.
//!
//! R. E. Moore, R. B. Kearfott and M. J. Cloud, *Introduction to Interval Analysis*, SIAM 2009.
//! Sums, products, quotients and roots are widened by one floating-point number if they were
//! rounded, and only then: whether they were is known exactly. Functions are widened by more than
//! the error of `libm`.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::Scalar;
use crate::exact::{two_product, two_sum};

/// All numbers from `lo` to `hi`, both finite; nothing is known if [`is_finite`](Scalar::is_finite) is false.
///
/// ```
/// use lagrangian_scalar::{Interval, Scalar};
/// let tenth = Interval::from_ratio(1, 10);
/// assert!(tenth.lo() < tenth.hi()); // 1/10 is no floating-point number,
/// assert_eq!(Interval::from(0.5) + Interval::from(0.25), Interval::from(0.75)); // but 3/4 is one.
/// assert!(!(tenth / (tenth - tenth)).is_finite());
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Interval {
    lo: f64,
    hi: f64,
}

/// Widening of sin, cos, asin, acos, atan, exp and ln, in units in the last place. The sources of
/// `libm` state errors below 1; a test measures them.
const SIMPLE: u32 = 2;

/// Widening of the functions composed of others: tan, atan2, sinh, cosh, tanh and powers. Their
/// errors are below 2.
const COMPOSED: u32 = 4;

/// Below this magnitude the rounding error of a product or quotient may not be representable as a floating-point number.
const SMALL: f64 = 1e-280;

impl Interval {
    /// Nothing is known: the whole line, and possibly no number at all.
    pub const UNKNOWN: Interval = Interval {
        lo: f64::NEG_INFINITY,
        hi: f64::INFINITY,
    };

    /// All numbers from `lo` to `hi`; [`UNKNOWN`](Self::UNKNOWN) unless `lo` ≤ `hi` and both are finite.
    pub fn new(lo: f64, hi: f64) -> Self {
        if lo.is_finite() && hi.is_finite() && lo <= hi {
            Interval { lo, hi }
        } else {
            Interval::UNKNOWN
        }
    }

    /// The smallest number in it.
    pub fn lo(self) -> f64 {
        self.lo
    }

    /// The largest number in it.
    pub fn hi(self) -> f64 {
        self.hi
    }

    /// An upper bound of `hi − lo`.
    pub fn width(self) -> f64 {
        rounded_up(two_sum(self.hi, -self.lo))
    }

    /// Whether `x` is in it.
    pub fn contains(self, x: f64) -> bool {
        self.lo <= x && x <= self.hi
    }

    /// The smallest interval that contains both.
    fn hull(self, other: Self) -> Self {
        Interval::new(self.lo.min(other.lo), self.hi.max(other.hi))
    }

    /// The intersection with known bounds of a result.
    fn within(self, lo: f64, hi: f64) -> Self {
        if self.is_finite() {
            Interval::new(self.lo.max(lo), self.hi.min(hi))
        } else {
            self
        }
    }

    /// `x`, widened by `ulps` floating-point numbers on both sides.
    fn around(x: f64, ulps: u32) -> Self {
        let (lo, hi) = (0..ulps).fold((x, x), |(lo, hi), _| (lo.next_down(), hi.next_up()));
        Interval::new(lo, hi)
    }

    /// An increasing or decreasing function, accurate to `ulps`.
    fn monotone(self, function: fn(f64) -> f64, ulps: u32) -> Self {
        if !self.is_finite() {
            return self;
        }
        let at_lo = Interval::around(function(self.lo), ulps);
        let at_hi = Interval::around(function(self.hi), ulps);
        if at_lo.is_finite() && at_hi.is_finite() {
            at_lo.hull(at_hi)
        } else {
            Interval::UNKNOWN
        }
    }

    /// The smallest and largest values of a function at the four corners of a box.
    fn corners(self, other: Self, function: impl Fn(f64, f64) -> Interval) -> Self {
        if !self.is_finite() || !other.is_finite() {
            return Interval::UNKNOWN;
        }
        let corners = [
            function(self.lo, other.lo),
            function(self.lo, other.hi),
            function(self.hi, other.lo),
            function(self.hi, other.hi),
        ];
        if corners.iter().all(|corner| corner.is_finite()) {
            corners
                .iter()
                .fold(corners[0], |all, &corner| all.hull(corner))
        } else {
            Interval::UNKNOWN
        }
    }

    fn contains_zero(self) -> bool {
        self.contains(0.0)
    }

    /// Whether an integer number of turns plus `phase` (in turns) may lie in it.
    fn may_contain_phase(self, phase: f64) -> bool {
        let turns = self / (Interval::pi() * Interval::from(2.0)) - Interval::from(phase);
        !turns.is_finite() || libm::floor(turns.hi) >= libm::ceil(turns.lo)
    }

    /// A sine or cosine that has its maximum 1 at the phase `top` (in turns) and its minimum −1
    /// half a turn later.
    fn wave(self, function: fn(f64) -> f64, top: f64) -> Self {
        let mut result = self.monotone(function, SIMPLE);
        if !result.is_finite() {
            return result;
        }
        if self.may_contain_phase(top) {
            result.hi = 1.0;
        }
        if self.may_contain_phase(top + 0.5) {
            result.lo = -1.0;
        }
        result.within(-1.0, 1.0)
    }
}

/// At most s + e, for s = fl(s + e).
fn rounded_down((s, e): (f64, f64)) -> f64 {
    if e < 0.0 { s.next_down() } else { s }
}

/// At least s + e, for s = fl(s + e).
fn rounded_up((s, e): (f64, f64)) -> f64 {
    if e > 0.0 { s.next_up() } else { s }
}

/// ab; e of s + e is its rounding error, or anything of the right sign.
fn product(a: f64, b: f64) -> Interval {
    let (p, e) = two_product(a, b);
    if a == 0.0 || b == 0.0 {
        Interval::new(0.0, 0.0)
    } else if p.abs() < SMALL {
        Interval::around(p, 1)
    } else {
        Interval::new(rounded_down((p, e)), rounded_up((p, e)))
    }
}

/// a/b for b ≠ 0. The remainder a − qb is a floating-point number and shows on which side the
/// rounded quotient q lies.
fn quotient(a: f64, b: f64) -> Interval {
    let q = a / b;
    if a == 0.0 {
        return Interval::new(0.0, 0.0);
    }
    let (p, e) = two_product(q, b);
    if q.abs() < SMALL || p.abs() < SMALL || !p.is_finite() {
        return Interval::around(q, 1);
    }
    let remainder = (a - p) - e;
    let error = if b > 0.0 { remainder } else { -remainder };
    Interval::new(rounded_down((q, error)), rounded_up((q, error)))
}

/// √x for x ≥ 0.
fn root(x: f64) -> Interval {
    let r = libm::sqrt(x);
    if x == 0.0 {
        return Interval::new(0.0, 0.0);
    }
    let (square, e) = two_product(r, r);
    if square < SMALL || !square.is_finite() {
        return Interval::around(r, 1);
    }
    let error = (x - square) - e;
    Interval::new(rounded_down((r, error)), rounded_up((r, error)))
}

/// x^n for n ≥ 0, by squaring.
fn power(x: f64, n: u32) -> Interval {
    let (mut result, mut square, mut left) = (Interval::ONE, Interval::from(x), n);
    while left > 0 {
        if left & 1 == 1 {
            result = result * square;
        }
        left >>= 1;
        if left > 0 {
            square = square * square;
        }
    }
    result
}

impl From<f64> for Interval {
    fn from(x: f64) -> Self {
        Interval::new(x, x)
    }
}

/// The interval of an integer.
fn integer(n: i64) -> Interval {
    let x = n as f64;
    let error = (n as i128 - x as i128) as f64;
    Interval::new(rounded_down((x, error)), rounded_up((x, error)))
}

/// Equal bounds. An unknown interval equals nothing.
impl PartialEq for Interval {
    fn eq(&self, other: &Self) -> bool {
        self.is_finite() && self.lo == other.lo && self.hi == other.hi
    }
}

// The operations have many branches: they are called, not copied into each recurrence of a series, which would take longer to compile
// than all methods of integration together.
impl Add for Interval {
    type Output = Self;
    #[inline(never)]
    fn add(self, other: Self) -> Self {
        Interval::new(
            rounded_down(two_sum(self.lo, other.lo)),
            rounded_up(two_sum(self.hi, other.hi)),
        )
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Interval {
            lo: -self.hi,
            hi: -self.lo,
        }
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;
    #[inline(never)]
    fn mul(self, other: Self) -> Self {
        self.corners(other, product)
    }
}

impl Div for Interval {
    type Output = Self;
    #[inline(never)]
    fn div(self, other: Self) -> Self {
        if other.contains_zero() {
            Interval::UNKNOWN
        } else {
            self.corners(other, quotient)
        }
    }
}

impl Scalar for Interval {
    type Stored = Self;

    #[inline(always)]
    fn load(stored: Self) -> Self {
        stored
    }
    #[inline(always)]
    fn store(self) -> Self {
        self
    }

    /// 0: an enclosure contains the error.
    fn sum_error(self, _: Self) -> Self {
        Self::ZERO
    }

    const ZERO: Self = Interval { lo: 0.0, hi: 0.0 };
    const ONE: Self = Interval { lo: 1.0, hi: 1.0 };

    fn from_f64(x: f64) -> Self {
        x.into()
    }

    fn from_ratio(numerator: i64, denominator: i64) -> Self {
        integer(numerator) / integer(denominator)
    }

    fn pi() -> Self {
        // The nearest `f64` is below π.
        let pi = core::f64::consts::PI;
        Interval {
            lo: pi,
            hi: pi.next_up(),
        }
    }

    fn sin_cos(self) -> (Self, Self) {
        (self.sin(), self.cos())
    }

    fn sin(self) -> Self {
        self.wave(libm::sin, 0.25)
    }

    fn cos(self) -> Self {
        self.wave(libm::cos, 0.0)
    }

    /// Increasing from pole to pole; the poles are the zeros of the cosine.
    fn tan(self) -> Self {
        if self.cos().contains_zero() {
            Interval::UNKNOWN
        } else {
            self.monotone(libm::tan, COMPOSED)
        }
    }

    fn asin(self) -> Self {
        // Outside [−1, 1] `libm` gives NaN, hence UNKNOWN.
        self.monotone(libm::asin, SIMPLE)
    }

    fn acos(self) -> Self {
        self.monotone(libm::acos, SIMPLE)
            .within(0.0, Interval::pi().hi)
    }

    fn atan(self) -> Self {
        self.monotone(libm::atan, SIMPLE)
    }

    fn atan2(self, x: Self) -> Self {
        if !self.is_finite() || !x.is_finite() {
            return Interval::UNKNOWN;
        }
        let pi = Interval::pi().hi;
        // The angle jumps by a turn where y changes its sign at x < 0.
        if self.lo < 0.0 && self.hi >= 0.0 && x.lo <= 0.0 {
            return Interval::new(-pi, pi);
        }
        // Elsewhere it is monotone along each side of the box. (Adding 0 turns a negative zero into
        // a positive one.)
        self.corners(x, |y, x| {
            Interval::around(libm::atan2(y + 0.0, x + 0.0), COMPOSED)
        })
        .within(-pi, pi)
    }

    fn sinh(self) -> Self {
        self.monotone(libm::sinh, COMPOSED)
    }

    fn cosh(self) -> Self {
        self.abs()
            .monotone(libm::cosh, COMPOSED)
            .within(1.0, f64::MAX)
    }

    fn tanh(self) -> Self {
        self.monotone(libm::tanh, COMPOSED).within(-1.0, 1.0)
    }

    fn exp(self) -> Self {
        self.monotone(libm::exp, SIMPLE).within(0.0, f64::MAX)
    }

    fn ln(self) -> Self {
        if self.lo <= 0.0 {
            return Interval::UNKNOWN;
        }
        self.monotone(libm::log, SIMPLE)
    }

    fn sqrt(self) -> Self {
        if !self.is_finite() || self.lo < 0.0 {
            return Interval::UNKNOWN;
        }
        Interval::new(root(self.lo).lo, root(self.hi).hi)
    }

    /// Monotone in the base and in the exponent, for a positive base.
    fn powf(self, exponent: Self) -> Self {
        let integer = exponent.lo as i32;
        if exponent == Interval::from(integer as f64) {
            return self.powi(integer);
        }
        if self.lo <= 0.0 {
            return Interval::UNKNOWN;
        }
        self.corners(exponent, |x, y| Interval::around(libm::pow(x, y), COMPOSED))
            .within(0.0, f64::MAX)
    }

    /// Odd powers increase; even ones are powers of the absolute value.
    fn powi(self, exponent: i32) -> Self {
        if !self.is_finite() {
            return self;
        }
        let n = exponent.unsigned_abs();
        let base = if n.is_multiple_of(2) {
            self.abs()
        } else {
            self
        };
        let (at_lo, at_hi) = (power(base.lo, n), power(base.hi, n));
        let result = Interval::new(at_lo.lo, at_hi.hi);
        if exponent < 0 {
            Interval::ONE / result
        } else {
            result
        }
    }

    fn abs(self) -> Self {
        if self.lo >= 0.0 {
            self
        } else if self.hi <= 0.0 {
            -self
        } else {
            Interval::new(0.0, self.hi.max(-self.lo))
        }
    }

    fn sign(self) -> Self {
        self.monotone(Scalar::sign, 0)
    }

    fn min(self, other: Self) -> Self {
        if self.is_finite() && other.is_finite() {
            Interval::new(self.lo.min(other.lo), self.hi.min(other.hi))
        } else {
            Interval::UNKNOWN
        }
    }

    fn max(self, other: Self) -> Self {
        -(-self).min(-other)
    }

    fn is_finite(self) -> bool {
        self.lo.is_finite() && self.hi.is_finite()
    }

    fn exceeds(self, bound: Self) -> bool {
        self.is_finite() && self.lo > bound.hi
    }

    /// The middle.
    fn to_f64(self) -> f64 {
        if self.is_finite() {
            self.lo * 0.5 + self.hi * 0.5
        } else {
            f64::NAN
        }
    }
}
