//! Numbers of about 106 bits: unevaluated sums of two `f64`.
//!
//! The basic operations and their error bounds, in units of u = 2⁻⁵³, are from M. Joldes, J.-M.
//! Muller and V. Popescu, *Tight and rigorous error bounds for basic building blocks of double-word
//! arithmetic*, ACM TOMS 44 (2017) 15:1–15:27: sum 3u², product 5u², quotient 10u²; root 4u² (V.
//! Lefèvre et al., *Accurate calculation of Euclidean norms using double-word arithmetic*, ACM TOMS
//! 49 (2023)). Functions are series in these operations; their errors, given at each of them, stay
//! below 64u² = 2⁻¹⁰⁰, relative to the result. (A power has the error of its logarithm, multiplied
//! by the exponent: 2⁻¹⁰⁰ (1 + |y ln x|).) The bounds hold for final and intermediate results
//! between 2⁻⁹⁰⁰ and 2¹⁰²³; closer to 0 the second word underflows.

use core::cmp::Ordering;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::Scalar;
use crate::exact::{fast_two_sum, two_product, two_sum};

/// A number hi + lo with |lo| at most half a unit in the last place of hi: about 106 bits, 32
/// decimal digits.
///
/// ```
/// use lagrangian_scalar::{DoubleDouble, Scalar};
/// let third = DoubleDouble::from_ratio(1, 3);
/// assert_eq!(third.hi(), 1.0 / 3.0);
/// assert!((third + third + third - DoubleDouble::ONE).abs() < DoubleDouble::from(1e-31));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleDouble {
    hi: f64,
    lo: f64,
}

/// π/2 to 318 bits.
const HALF_PI: [f64; 6] = [
    core::f64::consts::FRAC_PI_2,
    6.123233995736766e-17,
    -1.4973849048591698e-33,
    5.562271104316826e-50,
    2.836115989820158e-66,
    8.724931080676243e-84,
];

/// ln 2; the first two parts have 40 bits, so that their products with integers up to 2¹³ are exact.
const LN_2: (f64, f64, DoubleDouble) = (
    0.6931471805592082,
    7.371002565161996e-13,
    DoubleDouble {
        hi: 5.8029889835956905e-25,
        lo: 1.0908259040173159e-41,
    },
);

/// Beyond this many quarter turns their number does not fit into an `f64`.
const MOST_QUARTERS: f64 = (1u64 << 52) as f64;

impl DoubleDouble {
    const UNDEFINED: Self = DoubleDouble {
        hi: f64::NAN,
        lo: f64::NAN,
    };

    /// The nearest `f64`.
    pub fn hi(self) -> f64 {
        self.hi
    }

    /// The lower half: self − hi.
    pub fn lo(self) -> f64 {
        self.lo
    }

    /// hi + lo for |hi| ≥ |lo|. Infinity becomes undefined here, so that it is detected.
    #[inline]
    fn normalized(hi: f64, lo: f64) -> Self {
        let (hi, lo) = fast_two_sum(hi, lo);
        if hi.is_finite() {
            DoubleDouble { hi, lo }
        } else {
            DoubleDouble::UNDEFINED
        }
    }

    fn from_integer(n: i64) -> Self {
        let hi = n as f64;
        DoubleDouble::normalized(hi, (n as i128 - hi as i128) as f64)
    }

    /// self · 2^n.
    fn scaled(self, n: i32) -> Self {
        DoubleDouble::normalized(libm::ldexp(self.hi, n), libm::ldexp(self.lo, n))
    }

    /// e^x − 1, accurate for small x too.
    ///
    /// With x = k ln 2 + r, |r| ≤ 0.35: e^x = 2^k e^r. The error is 28u²: 13u² from the series, 3u²
    /// from each doubling.
    fn exp_m1(self) -> Self {
        if self.hi.abs() > 800.0 {
            // Overflow; or underflow, to −1 exactly.
            return if self.hi < 0.0 {
                -DoubleDouble::ONE
            } else {
                DoubleDouble::UNDEFINED
            };
        }
        let k = libm::rint(self.hi / LN_2.0);
        if k == 0.0 || !self.is_finite() {
            return small_exp_m1(self);
        }
        (small_exp_m1(self.without_ln_2(k)) + Self::ONE).scaled(k as i32) - Self::ONE
    }

    /// x − k ln 2; |k| < 2¹³.
    fn without_ln_2(self, k: f64) -> Self {
        self - (k * LN_2.0).into() - (k * LN_2.1).into() - LN_2.2 * k.into()
    }

    /// (k mod 4, x − kπ/2) with |x − kπ/2| ≤ π/4, up to rounding of k.
    ///
    /// x and the products of k with the parts of π/2 are summed exactly, six times over (T. Ogita,
    /// S. M. Rump and S. Oishi, *Accurate sum and dot product*, SIAM J. Sci. Comput. 26 (2005)
    /// 1955–1988, algorithm 4.8), so that the remainder is accurate next to multiples of π/2.
    fn quarter_turns(self) -> Option<(i64, Self)> {
        let k = libm::rint(self.hi / HALF_PI[0]);
        if k == 0.0 {
            return Some((0, self));
        }
        if k.is_nan() || k.abs() >= MOST_QUARTERS {
            return None;
        }
        let mut parts = [0.0; 2 + 2 * HALF_PI.len()];
        (parts[0], parts[1]) = (self.hi, self.lo);
        for (pair, part) in parts[2..].chunks_exact_mut(2).zip(HALF_PI) {
            (pair[0], pair[1]) = two_product(-k, part);
        }
        for _ in 0..6 {
            for i in (1..parts.len()).rev() {
                (parts[i - 1], parts[i]) = two_sum(parts[i - 1], parts[i]);
            }
        }
        let rest = parts[1..].iter().rev().sum();
        let (hi, lo) = two_sum(parts[0], rest);
        Some(((k as i64).rem_euclid(4), DoubleDouble { hi, lo }))
    }

    /// √((1 − x)(1 + x)) = √(1 − x²), accurate next to ±1.
    fn complement(self) -> Self {
        ((Self::ONE - self) * (Self::ONE + self)).sqrt()
    }
}

/// e^r − 1 for |r| ≤ 0.35: s = r/32, then e^s − 1 = s(1 + s/2(1 + s/3(…))), where 13 terms suffice
/// as s¹³/14! < 2⁻¹²⁰, and five times e^2s − 1 = 2(e^s − 1) + (e^s − 1)².
fn small_exp_m1(r: DoubleDouble) -> DoubleDouble {
    let s = r.scaled(-5);
    let mut factor = DoubleDouble::ONE;
    for n in (2..=14).rev() {
        factor = DoubleDouble::ONE + s / DoubleDouble::from(n as f64) * factor;
    }
    let mut result = s * factor;
    for _ in 0..5 {
        result = result.scaled(1) + result * result;
    }
    result
}

/// sin r and cos r for |r| ≤ π/4, errors 15u² and 8u²: sin r = r(1 − r²/(2·3)(1 − r²/(4·5)(…))) and
/// cos r = 1 − r²/(1·2)(1 − r²/(3·4)(…)); 14 terms, as (π/4)²⁹/29! < 2⁻¹¹².
fn small_sin_cos(r: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    let square = r * r;
    let (mut sin, mut cos) = (DoubleDouble::ONE, DoubleDouble::ONE);
    for n in (1..=14).rev() {
        let n = 2.0 * n as f64;
        sin = DoubleDouble::ONE - square / (n * (n + 1.0)).into() * sin;
        cos = DoubleDouble::ONE - square / ((n - 1.0) * n).into() * cos;
    }
    (r * sin, cos)
}

impl From<f64> for DoubleDouble {
    #[inline]
    fn from(x: f64) -> Self {
        DoubleDouble::normalized(x, 0.0)
    }
}

impl PartialOrd for DoubleDouble {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match self.hi.partial_cmp(&other.hi) {
            Some(Ordering::Equal) => self.lo.partial_cmp(&other.lo),
            unequal => unequal,
        }
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        DoubleDouble {
            hi: -self.hi,
            lo: -self.lo,
        }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    /// `AccurateDWPlusDW`, error 3u².
    #[inline]
    fn add(self, other: Self) -> Self {
        let (s, s_error) = two_sum(self.hi, other.hi);
        let (t, t_error) = two_sum(self.lo, other.lo);
        let (s, s_error) = fast_two_sum(s, s_error + t);
        DoubleDouble::normalized(s, s_error + t_error)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    /// `DWTimesDW1`, error 5u².
    #[inline]
    fn mul(self, other: Self) -> Self {
        let (p, error) = two_product(self.hi, other.hi);
        DoubleDouble::normalized(p, error + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    /// `DWDivDW2`: a quotient of `f64` and a correction by the exact remainder, error 15u².
    #[inline]
    fn div(self, other: Self) -> Self {
        let quotient = self.hi / other.hi;
        let remainder = self - other * DoubleDouble::from(quotient);
        DoubleDouble::normalized(quotient, remainder.hi / other.hi)
    }
}

impl Scalar for DoubleDouble {
    type Stored = Self;

    #[inline(always)]
    fn load(stored: Self) -> Self {
        stored
    }
    #[inline(always)]
    fn store(self) -> Self {
        self
    }

    const ZERO: Self = DoubleDouble { hi: 0.0, lo: 0.0 };
    const ONE: Self = DoubleDouble { hi: 1.0, lo: 0.0 };

    #[inline]
    fn from_f64(x: f64) -> Self {
        x.into()
    }

    fn from_ratio(numerator: i64, denominator: i64) -> Self {
        DoubleDouble::from_integer(numerator) / DoubleDouble::from_integer(denominator)
    }

    fn pi() -> Self {
        DoubleDouble {
            hi: 2.0 * HALF_PI[0],
            lo: 2.0 * HALF_PI[1],
        }
    }

    /// Up to |x| = 7·10¹⁵, undefined beyond.
    fn sin_cos(self) -> (Self, Self) {
        let Some((quarter, rest)) = self.quarter_turns() else {
            return (Self::UNDEFINED, Self::UNDEFINED);
        };
        let (sin, cos) = small_sin_cos(rest);
        match quarter {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }

    /// The angle of the point (√(1 − x²), x).
    fn asin(self) -> Self {
        self.atan2(self.complement())
    }

    /// The angle of the point (x, √(1 − x²)).
    fn acos(self) -> Self {
        self.complement().atan2(self)
    }

    fn atan(self) -> Self {
        self.atan2(Self::ONE)
    }

    /// From an approximation a, by rotating the point back by a and finding the remaining angle
    /// δ: tan δ = (y cos a − x sin a)/(x cos a + y sin a), and δ = tan δ to order δ³ ≈ 2⁻¹⁵⁰.
    /// Error 45u².
    fn atan2(self, x: Self) -> Self {
        let y = self;
        let a = libm::atan2(y.hi, x.hi);
        // The origin has no direction: the result is 0 (or π), as for `f64`.
        let largest = libm::fmax(y.hi.abs(), x.hi.abs());
        if largest == 0.0 || !y.is_finite() || !x.is_finite() {
            return if largest == 0.0 {
                a.into()
            } else {
                Self::UNDEFINED
            };
        }
        // The distance of the point does not matter, but must not overflow.
        let scale = -libm::ilogb(largest);
        let (y, x) = (y.scaled(scale), x.scaled(scale));
        let a = DoubleDouble::from(a);
        let (sin, cos) = a.sin_cos();
        a + (y * cos - x * sin) / (x * cos + y * sin)
    }

    /// (s + s/(s + 1))/2 with s = e^|x| − 1: no cancellation at small x. Error 45u².
    fn sinh(self) -> Self {
        let x = self.abs();
        let result = if x.hi > 40.0 {
            // e^−x is below 2⁻¹¹⁴ e^x. Using half of x avoids premature overflow.
            let root = x.scaled(-1).exp();
            root.scaled(-1) * root
        } else {
            let s = x.exp_m1();
            (s + s / (s + Self::ONE)).scaled(-1)
        };
        if self.hi < 0.0 { -result } else { result }
    }

    fn cosh(self) -> Self {
        let x = self.abs();
        if x.hi > 40.0 {
            return x.sinh();
        }
        let e = x.exp();
        (e + Self::ONE / e).scaled(-1)
    }

    /// s/(s + 2) with s = e^2|x| − 1.
    fn tanh(self) -> Self {
        let x = self.abs();
        let result = if x.hi > 40.0 {
            // 1 − tanh x < 2⁻¹¹⁴.
            Self::ONE
        } else {
            let s = x.scaled(1).exp_m1();
            s / (s + DoubleDouble::from(2.0))
        };
        if self.hi < 0.0 { -result } else { result }
    }

    /// 2^k e^(x − k ln 2).
    fn exp(self) -> Self {
        if self.hi < -800.0 {
            return Self::ZERO;
        }
        if self.hi.is_nan() || self.hi > 800.0 {
            return Self::UNDEFINED;
        }
        let k = libm::rint(self.hi / LN_2.0);
        (small_exp_m1(self.without_ln_2(k)) + Self::ONE).scaled(k as i32)
    }

    /// k ln 2 + ln m with x = 2^k m and √½ ≤ m ≤ √2, and ln m = 2 artanh z = 2z(1 + z²/3 + z⁴/5 +
    /// …), z = (m − 1)/(m + 1), |z| ≤ 0.172. 21 terms, as z⁴²/43 < 2⁻¹¹². Error 35u².
    fn ln(self) -> Self {
        if self.hi.is_nan() || self.hi <= 0.0 {
            return Self::UNDEFINED;
        }
        let mut k = libm::ilogb(self.hi);
        if libm::ldexp(self.hi, -k) > core::f64::consts::SQRT_2 {
            k += 1;
        }
        let m = self.scaled(-k);
        let z = (m - Self::ONE) / (m + Self::ONE);
        let square = z * z;
        let mut series = Self::ZERO;
        for n in (0..21).rev() {
            series = series * square + Self::ONE / DoubleDouble::from((2 * n + 1) as f64);
        }
        let ln_m = (z * series).scaled(1);
        let k = k as f64;
        if k == 0.0 {
            return ln_m;
        }
        ln_m + LN_2.2 * k.into() + (k * LN_2.1).into() + (k * LN_2.0).into()
    }

    /// The `f64` root and one Newton step with the exact remainder.
    fn sqrt(self) -> Self {
        if self == Self::ZERO {
            return Self::ZERO;
        }
        if self.hi.is_nan() || self.hi <= 0.0 {
            return Self::UNDEFINED;
        }
        // Keep the square of the root away from overflow and underflow.
        if self.hi > 1e300 {
            return self.scaled(-200).sqrt().scaled(100);
        }
        if self.hi < 1e-250 {
            return self.scaled(300).sqrt().scaled(-150);
        }
        let root = libm::sqrt(self.hi);
        let (square, error) = two_product(root, root);
        let remainder = (self.hi - square - error) + self.lo;
        DoubleDouble::normalized(root, remainder / (2.0 * root))
    }

    /// By squaring for integer exponents, else e^(y ln x).
    fn powf(self, exponent: Self) -> Self {
        let integer = exponent.hi as i32;
        if exponent == DoubleDouble::from(integer as f64) {
            return self.powi(integer);
        }
        if self == Self::ZERO && exponent.hi > 0.0 {
            return Self::ZERO;
        }
        (exponent * self.ln()).exp()
    }

    fn abs(self) -> Self {
        if self.hi < 0.0 { -self } else { self }
    }

    fn sign(self) -> Self {
        if self.hi == 0.0 {
            Self::ZERO
        } else {
            DoubleDouble::from(self.hi.signum())
        }
    }

    fn min(self, other: Self) -> Self {
        // An undefined operand gives an undefined result.
        if self < other || !self.is_finite() {
            self
        } else {
            other
        }
    }

    fn max(self, other: Self) -> Self {
        if self > other || !self.is_finite() {
            self
        } else {
            other
        }
    }

    fn is_finite(self) -> bool {
        self.hi.is_finite()
    }

    fn exceeds(self, bound: Self) -> bool {
        self > bound
    }

    fn to_f64(self) -> f64 {
        self.hi
    }
}
