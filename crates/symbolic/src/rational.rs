//! Exact rational numbers: 64-bit if they fit, big integers otherwise.

use core::cmp::Ordering;
use core::fmt;
use core::num::NonZeroI64;
use core::ops::{Add, Mul, Neg, Sub};
use std::sync::Arc;

use lagrangian_scalar::Scalar;
use num_bigint::{BigInt, BigUint, Sign};
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// The largest number of bits of a numerator or a denominator.
///
/// `f64` ranges from 2⁻¹⁰⁷⁴ to 2¹⁰²⁴; a number with four times as many digits is a typing error
/// such as `2^10^9`, and computing it would only fill the memory.
pub const MAX_BITS: u64 = 4096;

/// An exact rational number, in lowest terms.
///
/// Sixteen bytes: numerator and denominator if both fit 64 bits, otherwise a pointer to big integers.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Rational(Repr);

// Canonical: `Small` whenever it fits, so that equality and hash can be derived.
#[derive(Clone, PartialEq, Eq, Hash)]
enum Repr {
    /// Numerator (never `i64::MIN`, so that it can be negated) and denominator (positive).
    Small(i64, NonZeroI64),
    /// `Arc` instead of `Box`, so that big coefficients are cheap to clone, and numbers can be sent across threads.
    Big(Arc<Big>),
}

#[derive(PartialEq, Eq, Hash)]
struct Big {
    numerator: BigInt,
    denominator: BigInt,
}

const UNIT: NonZeroI64 = NonZeroI64::new(1).expect("1 is not 0");

impl Rational {
    /// 0.
    pub const ZERO: Rational = Rational(Repr::Small(0, UNIT));
    /// 1.
    pub const ONE: Rational = Rational(Repr::Small(1, UNIT));
    /// −1.
    pub const MINUS_ONE: Rational = Rational(Repr::Small(-1, UNIT));

    /// `numerator / denominator`; `None` for a denominator of 0.
    pub fn new(numerator: i64, denominator: i64) -> Option<Rational> {
        (denominator != 0).then(|| Rational::from_i128(numerator.into(), denominator.into()))
    }

    /// Parses `12`, `-0.5`, `9.81e-3`, `1_000.5`, exactly.
    ///
    /// `None` if it is not a number, or one of more than [`MAX_BITS`] bits.
    ///
    /// ```
    /// use lagrangian_symbolic::Rational;
    /// assert_eq!(Rational::parse_decimal("9.81e-3"), Rational::new(981, 100_000));
    /// assert_eq!(Rational::parse_decimal("1e999999999"), None);
    /// ```
    pub fn parse_decimal(text: &str) -> Option<Rational> {
        // 2^MAX_BITS has 1234 decimal digits.
        const MAX_DIGITS: usize = 1233;

        let (negative, text) = match text.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, text),
        };
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, parse_exponent(exponent)?),
            None => (text, 0),
        };
        let (integer, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        if !integer.starts_with(|c: char| c.is_ascii_digit()) || fraction.starts_with('_') {
            return None;
        }
        let mut digits = String::new();
        let mut places: i64 = 0;
        for (part, counts) in [(integer, 0), (fraction, 1)] {
            for c in part.chars().filter(|&c| c != '_') {
                if !c.is_ascii_digit() {
                    return None;
                }
                places += counts;
                if !(c == '0' && digits.is_empty()) {
                    digits.push(c);
                }
            }
        }
        if digits.is_empty() {
            return Some(Rational::ZERO);
        }
        let scale = exponent.saturating_sub(places);
        let scale_digits = usize::try_from(scale.unsigned_abs()).ok()?;
        if digits.len() > MAX_DIGITS || scale_digits > MAX_DIGITS {
            return None;
        }
        let magnitude = BigInt::parse_bytes(digits.as_bytes(), 10)?;
        let signed = if negative { -magnitude } else { magnitude };
        let power = BigInt::from(10).pow(u32::try_from(scale_digits).ok()?);
        let value = if scale < 0 {
            Rational::from_big(signed, power)
        } else {
            Rational::from_big(signed * power, BigInt::one())
        };
        value.within_limits()
    }

    /// The numerator, if numerator and denominator fit 64 bits.
    pub fn numerator(&self) -> Option<i64> {
        match self.0 {
            Repr::Small(numerator, _) => Some(numerator),
            Repr::Big(_) => None,
        }
    }

    /// The denominator (positive), if numerator and denominator fit 64 bits.
    pub fn denominator(&self) -> Option<i64> {
        match self.0 {
            Repr::Small(_, denominator) => Some(denominator.get()),
            Repr::Big(_) => None,
        }
    }

    /// The value, if it is an integer of 64 bits.
    pub fn as_integer(&self) -> Option<i64> {
        match self.0 {
            Repr::Small(numerator, UNIT) => Some(numerator),
            _ => None,
        }
    }

    /// Whether it has no fractional part.
    pub fn is_integer(&self) -> bool {
        match &self.0 {
            Repr::Small(_, denominator) => *denominator == UNIT,
            Repr::Big(big) => big.denominator.is_one(),
        }
    }

    /// Whether it is 0.
    pub fn is_zero(&self) -> bool {
        matches!(self.0, Repr::Small(0, _))
    }

    /// Whether it is 1.
    pub fn is_one(&self) -> bool {
        matches!(self.0, Repr::Small(1, UNIT))
    }

    /// Whether it is below 0.
    pub fn is_negative(&self) -> bool {
        match &self.0 {
            Repr::Small(numerator, _) => *numerator < 0,
            Repr::Big(big) => big.numerator.is_negative(),
        }
    }

    /// The magnitude.
    pub fn abs(&self) -> Rational {
        if self.is_negative() {
            -self
        } else {
            self.clone()
        }
    }

    /// −1, 0 or 1.
    pub fn signum(&self) -> Rational {
        match (self.is_zero(), self.is_negative()) {
            (true, _) => Rational::ZERO,
            (_, true) => Rational::MINUS_ONE,
            _ => Rational::ONE,
        }
    }

    /// The sum, if it stays within [`MAX_BITS`].
    pub fn checked_add(&self, other: &Rational) -> Option<Rational> {
        (self + other).within_limits()
    }

    /// The product, if it stays within [`MAX_BITS`].
    pub fn checked_mul(&self, other: &Rational) -> Option<Rational> {
        (self * other).within_limits()
    }

    /// The quotient; `None` for a divisor of 0, and beyond [`MAX_BITS`].
    pub fn checked_div(&self, other: &Rational) -> Option<Rational> {
        self.checked_mul(&other.recip()?)
    }

    /// `1/self`; `None` for 0.
    pub fn recip(&self) -> Option<Rational> {
        match &self.0 {
            Repr::Small(0, _) => None,
            Repr::Small(numerator, denominator) => {
                let reversed = denominator.get() * numerator.signum();
                let magnitude = NonZeroI64::new(numerator.abs())?;
                Some(Rational(Repr::Small(reversed, magnitude)))
            }
            Repr::Big(big) => Some(Rational::from_big(
                big.denominator.clone(),
                big.numerator.clone(),
            )),
        }
    }

    /// An integer power; `None` for a negative power of 0, and beyond [`MAX_BITS`].
    pub fn pow(&self, exponent: i32) -> Option<Rational> {
        if exponent < 0 {
            let base = self.recip()?;
            return base.pow_unsigned(exponent.unsigned_abs());
        }
        self.pow_unsigned(exponent.unsigned_abs())
    }

    fn pow_unsigned(&self, exponent: u32) -> Option<Rational> {
        if exponent == 0 {
            return Some(Rational::ONE);
        }
        if self.is_zero() || self.is_one() || exponent == 1 {
            return Some(self.clone());
        }
        if *self == Rational::MINUS_ONE {
            let even = exponent.is_multiple_of(2);
            return Some(if even { Rational::ONE } else { self.clone() });
        }
        let (numerator, denominator) = self.to_big();
        // b^n has more than (bits(b) − 1)·n bits.
        let bits = numerator.bits().max(denominator.bits());
        if (bits - 1).saturating_mul(exponent.into()) > MAX_BITS {
            return None;
        }
        Rational::from_big(numerator.pow(exponent), denominator.pow(exponent)).within_limits()
    }

    /// The largest rational of which both are integer multiples, with the sign of `self`; 0 for 0 and 0.
    pub(crate) fn gcd(&self, other: &Rational) -> Rational {
        let sign = if self.is_negative() { -1 } else { 1 };
        match (&self.0, &other.0) {
            (&Repr::Small(a, b), &Repr::Small(c, d)) if b == d => {
                Rational::from_i128(sign * i128::from(a.gcd(&c)), b.get().into())
            }
            _ => {
                let ((a, b), (c, d)) = (self.to_big(), other.to_big());
                Rational::from_big((a * &d).gcd(&(c * &b)) * sign, b * d)
            }
        }
    }

    /// The square root, if it is rational.
    pub fn sqrt(&self) -> Option<Rational> {
        if self.is_negative() {
            return None;
        }
        let (numerator, denominator) = self.to_big();
        let (top, bottom) = (numerator.sqrt(), denominator.sqrt());
        (&top * &top == numerator && &bottom * &bottom == denominator)
            .then(|| Rational::from_big(top, bottom))
    }

    /// The nearest `f64`, ties to even; ±∞ beyond the range of `f64`.
    pub fn to_f64(&self) -> f64 {
        let (numerator, denominator) = self.to_big();
        let magnitude = nearest_f64(numerator.magnitude(), denominator.magnitude());
        if numerator.is_negative() {
            -magnitude
        } else {
            magnitude
        }
    }

    /// The exact value of an `f64`; nothing if it is not finite.
    pub fn exactly(x: f64) -> Option<Rational> {
        if !x.is_finite() {
            return None;
        }
        let bits = x.abs().to_bits();
        let exponent = (bits >> 52) as i32;
        let fraction = (bits & ((1 << 52) - 1)) as i64;
        let (mantissa, power) = if exponent == 0 {
            (fraction, -1074)
        } else {
            (fraction | 1 << 52, exponent - 1075)
        };
        let magnitude = Rational::from(mantissa).checked_mul(&Rational::from(2).pow(power)?)?;
        Some(if x < 0.0 { -magnitude } else { magnitude })
    }

    /// The value as a number of type `S`, by exact operations of `S` wherever possible; as an `f64`
    /// it is the nearest one.
    pub fn evaluate<S: Scalar>(&self) -> S {
        match &self.0 {
            Repr::Small(numerator, denominator) => S::from_ratio(*numerator, denominator.get()),
            Repr::Big(_) => {
                // The nearest `f64` plus the remainder, as in emitted code.
                let nearest = self.to_f64();
                match Rational::exactly(nearest) {
                    Some(exact) if !exact.is_zero() => {
                        S::from_f64(nearest) + (self - &exact).in_digits::<S>()
                    }
                    _ => self.in_digits(),
                }
            }
        }
    }

    /// The number of machine words that it takes on the heap; none if numerator and denominator fit one each.
    pub(crate) fn words(&self) -> usize {
        match &self.0 {
            Repr::Small(..) => 0,
            Repr::Big(big) => {
                // Two allocations with their headers.
                const OVERHEAD: u64 = 12;
                (OVERHEAD + (big.numerator.bits() + big.denominator.bits()) / 64) as usize
            }
        }
    }

    /// The value by its digits, with a possible rounding at each.
    fn in_digits<S: Scalar>(&self) -> S {
        match &self.0 {
            Repr::Small(numerator, denominator) => S::from_ratio(*numerator, denominator.get()),
            Repr::Big(big) => {
                // 0.nnn…/0.ddd… in base 2³², times the power of the base, so that no part overflows.
                let base = S::from_ratio(1 << 32, 1);
                let (top, top_digits) = fraction::<S>(big.numerator.magnitude(), base);
                let (bottom, bottom_digits) = fraction::<S>(big.denominator.magnitude(), base);
                let mut value = top / bottom;
                for _ in bottom_digits..top_digits {
                    value = value * base;
                }
                for _ in top_digits..bottom_digits {
                    value = value / base;
                }
                if big.numerator.is_negative() {
                    -value
                } else {
                    value
                }
            }
        }
    }

    fn within_limits(self) -> Option<Rational> {
        match &self.0 {
            Repr::Small(..) => Some(self),
            Repr::Big(big) => {
                (big.numerator.bits().max(big.denominator.bits()) <= MAX_BITS).then_some(self)
            }
        }
    }

    /// `numerator / denominator` in lowest terms; the denominator is not 0.
    fn from_i128(numerator: i128, denominator: i128) -> Rational {
        let negative = (numerator < 0) != (denominator < 0);
        let (top, bottom) = (numerator.unsigned_abs(), denominator.unsigned_abs());
        let divisor = match (u64::try_from(top), u64::try_from(bottom)) {
            (_, Ok(1)) => 1,
            (Ok(top), Ok(bottom)) => top.gcd(&bottom).into(),
            _ => top.gcd(&bottom),
        };
        let (top, bottom) = (top / divisor, bottom / divisor);
        match (
            i64::try_from(top),
            i64::try_from(bottom).ok().and_then(NonZeroI64::new),
        ) {
            (Ok(top), Some(bottom)) => {
                Rational(Repr::Small(if negative { -top } else { top }, bottom))
            }
            _ => {
                let sign = if negative { Sign::Minus } else { Sign::Plus };
                Rational(Repr::Big(Arc::new(Big {
                    numerator: BigInt::from_biguint(sign, BigUint::from(top)),
                    denominator: BigInt::from(bottom),
                })))
            }
        }
    }

    /// `numerator / denominator` in lowest terms; the denominator is not 0.
    fn from_big(numerator: BigInt, denominator: BigInt) -> Rational {
        let divisor = if denominator.is_negative() {
            -numerator.gcd(&denominator)
        } else {
            numerator.gcd(&denominator)
        };
        let (numerator, denominator) = (numerator / &divisor, denominator / &divisor);
        let small = || {
            let top = numerator.to_i64().filter(|&n| n != i64::MIN)?;
            Some(Repr::Small(top, NonZeroI64::new(denominator.to_i64()?)?))
        };
        match small() {
            Some(small) => Rational(small),
            None => Rational(Repr::Big(Arc::new(Big {
                numerator,
                denominator,
            }))),
        }
    }

    fn to_big(&self) -> (BigInt, BigInt) {
        match &self.0 {
            Repr::Small(numerator, denominator) => {
                (BigInt::from(*numerator), BigInt::from(denominator.get()))
            }
            Repr::Big(big) => (big.numerator.clone(), big.denominator.clone()),
        }
    }
}

fn parse_exponent(text: &str) -> Option<i64> {
    let (sign, digits) = match text.strip_prefix('-') {
        Some(digits) => (-1, digits),
        None => (1, text.strip_prefix('+').unwrap_or(text)),
    };
    let digits: String = digits.chars().filter(|&c| c != '_').collect();
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    // An exponent with more digits than i64 counts as infinite, and is refused unless the mantissa is 0.
    Some(sign * digits.parse::<i64>().unwrap_or(i64::MAX))
}

/// `digits` as a fraction below 1 in base 2³², and the number of these digits.
fn fraction<S: Scalar>(digits: &BigUint, base: S) -> (S, usize) {
    let digits = digits.to_u32_digits();
    let value = digits.iter().fold(S::ZERO, |value, &digit| {
        (value + S::from_ratio(digit.into(), 1)) / base
    });
    (value, digits.len())
}

/// The `f64` nearest to `top/bottom`, ties to even; `bottom` is not 0.
fn nearest_f64(top: &BigUint, bottom: &BigUint) -> f64 {
    if top.is_zero() {
        return 0.0;
    }
    // quotient·2^−shift = top/bottom, with 66 or 67 bits in the quotient; its lowest bit records
    // whether there is a remainder, so that rounding the quotient rounds the exact value.
    let bits = |x: &BigUint| i64::try_from(x.bits()).unwrap_or(i64::MAX);
    let shift = 67 - (bits(top) - bits(bottom));
    let (quotient, rest) = if shift >= 0 {
        (top << shift.unsigned_abs()).div_rem(bottom)
    } else {
        top.div_rem(&(bottom << shift.unsigned_abs()))
    };
    let sticky = u128::from(!rest.is_zero());
    let quotient = quotient.to_u128().unwrap_or(u128::MAX) | sticky;
    let exponent = 127 - i64::from(quotient.leading_zeros()) - shift;
    if exponent > 1023 {
        return f64::INFINITY;
    }
    if exponent >= -1022 {
        // The conversion rounds; both factors of the scale are normal, and their products are exact
        // except for overflow.
        let half = shift / 2;
        return quotient as f64 * power_of_two(-half) * power_of_two(half - shift);
    }
    // Below the normal numbers: count units of 2^−1074; the count is the bit pattern.
    let drop = shift - 1074;
    if drop > 100 {
        return 0.0;
    }
    let (kept, dropped) = (quotient >> drop, quotient & ((1 << drop) - 1));
    let half = 1u128 << (drop - 1);
    let up = dropped > half || (dropped == half && kept & 1 == 1);
    f64::from_bits(u64::try_from(kept).unwrap_or(0) + u64::from(up))
}

/// 2^n for n in the range of normal numbers.
fn power_of_two(n: i64) -> f64 {
    f64::from_bits(((1023 + n) as u64) << 52)
}

impl From<i64> for Rational {
    fn from(n: i64) -> Rational {
        if n == i64::MIN {
            return Rational::from_i128(n.into(), 1);
        }
        Rational(Repr::Small(n, UNIT))
    }
}

impl Neg for &Rational {
    type Output = Rational;
    fn neg(self) -> Rational {
        match &self.0 {
            Repr::Small(numerator, denominator) => Rational(Repr::Small(-numerator, *denominator)),
            Repr::Big(big) => Rational::from_big(-&big.numerator, big.denominator.clone()),
        }
    }
}

impl Add for &Rational {
    type Output = Rational;
    fn add(self, other: &Rational) -> Rational {
        match (&self.0, &other.0) {
            (&Repr::Small(a, b), &Repr::Small(c, d)) => {
                if b == UNIT && d == UNIT {
                    return Rational::from_i128(i128::from(a) + i128::from(c), 1);
                }
                let (a, b, c, d) = (a.into(), b.get().into(), c.into(), d.get().into());
                // Below 2·2⁶³·2⁶³ = 2¹²⁷.
                let (a, b, c, d): (i128, i128, i128, i128) = (a, b, c, d);
                Rational::from_i128(a * d + c * b, b * d)
            }
            _ => {
                let ((a, b), (c, d)) = (self.to_big(), other.to_big());
                Rational::from_big(a * &d + c * &b, b * d)
            }
        }
    }
}

impl Sub for &Rational {
    type Output = Rational;
    fn sub(self, other: &Rational) -> Rational {
        self + &-other
    }
}

impl Mul for &Rational {
    type Output = Rational;
    fn mul(self, other: &Rational) -> Rational {
        match (&self.0, &other.0) {
            (&Repr::Small(a, b), &Repr::Small(c, d)) => Rational::from_i128(
                i128::from(a) * i128::from(c),
                i128::from(b.get()) * i128::from(d.get()),
            ),
            _ => {
                let ((a, b), (c, d)) = (self.to_big(), other.to_big());
                Rational::from_big(a * c, b * d)
            }
        }
    }
}

// Operators on values, implemented by those on references.
macro_rules! by_value {
    ($($Operator:ident $operator:ident),*) => { $(
        impl $Operator for Rational {
            type Output = Rational;
            fn $operator(self, other: Rational) -> Rational {
                (&self).$operator(&other)
            }
        }
    )* };
}
by_value!(Add add, Sub sub, Mul mul);

impl Neg for Rational {
    type Output = Rational;
    fn neg(self) -> Rational {
        -&self
    }
}

impl Ord for Rational {
    fn cmp(&self, other: &Rational) -> Ordering {
        match (&self.0, &other.0) {
            (&Repr::Small(a, b), &Repr::Small(c, d)) => {
                (i128::from(a) * i128::from(d.get())).cmp(&(i128::from(c) * i128::from(b.get())))
            }
            _ => {
                let ((a, b), (c, d)) = (self.to_big(), other.to_big());
                (a * d).cmp(&(c * b))
            }
        }
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Rational) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Default for Rational {
    fn default() -> Rational {
        Rational::ZERO
    }
}

/// In the spec language: `3`, `-1/2`.
impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Repr::Small(numerator, UNIT) => write!(f, "{numerator}"),
            Repr::Small(numerator, denominator) => write!(f, "{numerator}/{denominator}"),
            Repr::Big(big) if big.denominator.is_one() => write!(f, "{}", big.numerator),
            Repr::Big(big) => write!(f, "{}/{}", big.numerator, big.denominator),
        }
    }
}

impl fmt::Debug for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(numerator: i64, denominator: i64) -> Rational {
        Rational::new(numerator, denominator).expect("a denominator other than 0")
    }

    #[test]
    fn a_rational_takes_sixteen_bytes() {
        assert_eq!(size_of::<Rational>(), 16);
    }

    #[test]
    fn fractions_come_in_lowest_terms() {
        assert_eq!(ratio(6, -4), ratio(-3, 2));
        assert_eq!(ratio(6, -4).to_string(), "-3/2");
        assert_eq!(ratio(0, -7), Rational::ZERO);
        assert_eq!(Rational::new(1, 0), None);
        assert_eq!(ratio(i64::MIN, i64::MIN), Rational::ONE);
    }

    #[test]
    fn what_overflows_becomes_big_and_small_again() {
        let large = Rational::from(i64::MAX);
        let square = &large * &large;
        assert_eq!(square.to_string(), "85070591730234615847396907784232501249");
        assert_eq!(square.numerator(), None);
        assert_eq!(square.checked_div(&large), Some(large.clone()));
        assert_eq!(&Rational::from(i64::MIN) + &Rational::ONE, -&large);
        assert_eq!(-&-&Rational::from(i64::MIN), Rational::from(i64::MIN));
        assert!(Rational::from(i64::MIN) < large && large < square);
        assert_eq!(square.sqrt(), Some(large));
    }

    #[test]
    fn decimals_are_read_exactly() {
        let read = |text| Rational::parse_decimal(text);
        assert_eq!(read("0.1"), Some(ratio(1, 10)));
        assert_eq!(read("-12.50"), Some(ratio(-25, 2)));
        assert_eq!(read("3e5"), Some(ratio(300_000, 1)));
        assert_eq!(read("1_000.5E+1"), Some(ratio(10_005, 1)));
        assert_eq!(read("3."), Some(ratio(3, 1)));
        assert_eq!(read("0e999999999999999999999"), Some(Rational::ZERO));
        for refused in [
            "",
            "-",
            ".5",
            "e5",
            "1e",
            "1e+",
            "1.2.3",
            "0x10",
            "1e999999999",
            "1e-9999999999999999999",
            "٣",
        ] {
            assert_eq!(read(refused), None, "{refused}");
        }
        assert_eq!(read(&"9".repeat(100_000)), None);
    }

    #[test]
    fn absurd_powers_are_refused() {
        assert_eq!(Rational::from(2).pow(1_000_000_000), None);
        assert_eq!(Rational::from(2).pow(i32::MIN), None);
        assert_eq!(Rational::ZERO.pow(-1), None);
        assert_eq!(Rational::MINUS_ONE.pow(i32::MIN), Some(Rational::ONE));
        assert_eq!(ratio(-2, 3).pow(-3), Some(ratio(-27, 8)));
        let mut x = Rational::from(3);
        while let Some(square) = x.checked_mul(&x) {
            x = square;
        }
        assert!(x.pow(2).is_none());
    }

    #[test]
    fn conversion_to_f64_rounds_once() {
        // rustc parses decimals with correct rounding.
        for text in [
            "0.1",
            "9.81",
            "1e300",
            "1e308",
            "2.5e-308",
            "4.9e-324",
            "2.4e-324",
            "2.5e-324",
            "1e-400",
            "1e400",
            "123456789012345678901234567890",
            "9007199254740993",
            "9007199254740992.5",
            "2.2250738585072011e-308",
            "1.7976931348623157e308",
            "1.7976931348623159e308",
            "0.333333333333333333333333333",
        ] {
            let exact = Rational::parse_decimal(text).expect("a decimal number");
            let expected: f64 = text.parse().expect("a decimal number");
            assert_eq!(exact.to_f64(), expected, "{text}");
            assert_eq!((-exact).to_f64(), -expected, "-{text}");
        }
        assert_eq!(ratio(i64::MAX, i64::MAX - 1).to_f64(), 1.0);
        assert_eq!(ratio(1, 3).to_f64(), 1.0 / 3.0);
    }

    #[test]
    fn big_rationals_evaluate_without_overflow() {
        let x = Rational::from(3).pow(2000).expect("3170 bits");
        let y = Rational::from(3).pow(1999).expect("3169 bits");
        assert_eq!(x.evaluate::<f64>(), f64::INFINITY);
        let sum = &x.recip().expect("not 0") + &Rational::ONE;
        assert_eq!(sum.evaluate::<f64>(), 1.0);
        assert_eq!((&x * &y.recip().expect("not 0")).evaluate::<f64>(), 3.0);
    }

    #[test]
    fn long_decimals_are_rounded_once() {
        for text in [
            "0.06171389001427644963589",
            "0.4873649795438425502256",
            "3.14159265358979323846264338327950288",
            "0.1000000000000000055511151231257827",
        ] {
            let exact = Rational::parse_decimal(text).expect("a decimal number");
            let expected: f64 = text.parse().expect("a decimal number");
            assert_eq!(exact.evaluate::<f64>(), expected, "{text}");
            assert_eq!((-exact).evaluate::<f64>(), -expected, "-{text}");
        }
        let tenth = Rational::exactly(0.1).expect("finite");
        assert_eq!(tenth.to_f64(), 0.1);
        assert_eq!(Rational::exactly(f64::INFINITY), None);
    }
}
