//! Residues modulo the prime p = 2⁶¹ − 1, with an exact sine and cosine, for proving identities.
//!
//! Give every symbol of two expressions a random value and evaluate both in a finite field. If the
//! expressions are equal the results are always equal, since there is no rounding. If they differ,
//! their difference is a polynomial of some degree d (after clearing denominators), and it vanishes
//! at a random point with probability at most d/p (J. T. Schwartz, *Fast probabilistic algorithms
//! for verification of polynomial identities*, J. ACM 27 (1980) 701–717; R. Zippel, EUROSAM 1979).
//! So agreement at a few points is a proof up to a probability that can be made arbitrarily small.
//! G. H. Gonnet, *Determining equivalence of expressions in random polynomial time*, STOC 1984, did
//! so for expressions with functions.
//!
//! # Sine and cosine
//!
//! The angle x and the point (cos x, sin x) are algebraically independent, but the point must rotate
//! with the angle: the map x ↦ e^{ix} = cos x + i sin x takes sums to products. So a [`Residue`]
//! carries two images of a number, under two ring homomorphisms that agree only on the rationals:
//!
//! * its image in GF(p), or GF(p²) = GF(p)\[i\] if roots need it: this is compared;
//! * its image among the 2-adic numbers, as 128 bits: angles are made from this.
//!
//! The points of the unit circle over GF(p) form a cyclic group of order p + 1 = 2⁶¹ under
//! multiplication in GF(p²), with a generator g. For a 2-adic number x let
//!
//! ```text
//! e^{ix} := g^(2²⁰ x mod 2⁶¹)
//! ```
//!
//! which is a homomorphism from the 2-adic numbers x with at most 20 halvings to the circle. Hence
//! sin² + cos² = 1, all addition theorems, double angles, and half, third, … angles hold exactly,
//! without any bookkeeping by the evaluator. A symbol takes 2⁴⁰ different angles (it is given an
//! odd 2-adic image, so that division keeps all bits), so a wrong identity of degree d in the sines
//! and cosines of a symbol passes with probability at most 2d/2⁴⁰, and at each of several points anew.
//!
//! # π
//!
//! π is transcendental, and so is represented by a random constant in both images. Its known
//! property, e^{iπ} = −1, is handled separately: each number carries the exact rational b of
//! its part bπ as long as it has one (through sums, and products with rationals), and
//! e^{i(x+bπ)} = e^{ix} ζ(b) with ζ(b) a root of unity of the right order. Those of order 2^k
//! lie on the circle; GF(p²) also has those of order 3, 9, 5, 25, 7, 11, 13, …, the divisors of
//! p − 1, so that cos(2π/3) = −1/2. A 2-adic image of π with g^(2²⁰π) = −1 would be simpler,
//! but would make sin(2πft) vanish for all symbols f and t, and e^{iπ/3} equal −1: it would
//! accept wrong equations.
//!
//! # Roots and signs
//!
//! With probability ½, a ∈ GF(p) has a root; √a is then the root that is a square itself, so that
//! √(ab) = √a√b. Otherwise the value is undefined ([`is_finite`](Scalar::is_finite) is false): "a
//! is a square" takes the place of "a > 0", and the test chooses another point. Accordingly sign(x)
//! is the Legendre symbol, |x| = x sign(x) = √(x²), min and max are (a + b ∓ |a − b|)/2. Constants
//! cannot be drawn again. For them signs are the true signs if the value is a known rational, √ of
//! a rational is multiplicative over its prime factors and lies in GF(p²) if necessary, and a
//! constant without any root takes an opaque value.
//!
//! # The other functions
//!
//! * asin, acos, atan, atan2: the 2-adic image is a logarithm on the circle, so sin(asin x) = x,
//!   tan(atan x) = x, cos(atan2(y, x)) = x/√(x² + y²), and the functions agree with each other. If
//!   the root in question does not exist, the angle can be used for everything except sin and cos,
//!   which are then undefined (opaque, for constants).
//! * exp is opaque: a hash of its argument's image in the field, with e^{−x} = 1/e^x. sinh, cosh,
//!   tanh are derived from it.
//! * ln is opaque; so is a power, unless the exponent is n/2.
//!
//! # What is not recognised
//!
//! An equation that passes is true, up to the stated probability. A true one may fail if it needs
//! more than the above: an angle that itself contains sines or roots in two forms (their 2-adic
//! images are hashes of the field's image, so sin²x + cos²x = 1 is not known inside an angle); an
//! angle with more than 20 halvings, as a number with more than 20 decimals, which is opaque (0.1 taken from an `f64` has 55, taken as the
//! ratio 1/10 has 1); a positive constant other than a power of 2 moved out of a root or an
//! absolute value, as in √(9x) = 3√x; functional equations of exp, ln and powers.

mod arithmetic;
mod circle;
mod field;
mod ratio;
mod two_adic;

use crate::Scalar;
use circle::{CIRCLE_BITS, GENERATOR, circle_logarithm, root_of_unity, simple_turn};
use field::{Field, P};
use ratio::Ratio;
use two_adic::TwoAdic;

/// The number of halvings of an angle beyond which its sine becomes opaque: e^{ix} = g^(2^HALVINGS x).
const HALVINGS: i32 = 20;

/// A number represented by its images in GF(p²), p = 2⁶¹ − 1, and among the 2-adic numbers; see the
/// [module](crate::residue) for its use.
///
/// Two residues are equal if their images in the field are equal and both are defined.
#[derive(Clone, Copy, Debug)]
pub struct Residue {
    field: Field,
    two_adic: TwoAdic,
    /// The value itself if `is_rational`, otherwise b of a value that is known to be x + bπ.
    ratio: Ratio,
    /// Whether the value is a rational number known exactly.
    is_rational: bool,
    /// Whether it is made from constants only, so that another choice of the symbols would not change it.
    constant: bool,
    /// False if something undefined went into it.
    defined: bool,
}

impl Residue {
    /// The value of the symbol number `index` in the experiment number `seed`: the same for the
    /// same numbers, and independent for different ones.
    ///
    /// ```
    /// use lagrangian_scalar::{Residue, Scalar};
    /// let (x, y) = (Residue::random(1, 0), Residue::random(1, 1));
    /// assert_eq!((x + y).sin(), x.sin() * y.cos() + x.cos() * y.sin());
    /// assert_ne!((x + y).sin(), x.sin() * y.cos() - x.cos() * y.sin());
    /// ```
    pub fn random(seed: u64, index: u64) -> Self {
        let word = |k| hash(Tag::Symbol, &[seed, index, k]);
        Residue {
            field: Field::real(1 + word(0) % (P - 1)),
            two_adic: TwoAdic::odd(wide(word(1), word(2))),
            ratio: Ratio::ZERO,
            is_rational: false,
            constant: false,
            defined: true,
        }
    }

    const UNDEFINED: Residue = Residue {
        field: Field::ZERO,
        two_adic: TwoAdic::Undefined,
        ratio: Ratio::ZERO,
        is_rational: false,
        constant: false,
        defined: false,
    };

    /// The value, if it is a rational number known exactly.
    fn rational(&self) -> Option<Ratio> {
        self.is_rational.then_some(self.ratio)
    }

    /// b of a value that is known to be x + bπ.
    fn turn(&self) -> Ratio {
        if self.is_rational {
            Ratio::ZERO
        } else {
            self.ratio
        }
    }

    /// Whether it is known to be the whole number `n`.
    fn is_exactly(&self, n: i64) -> bool {
        self.is_rational && self.ratio == Ratio::integer(n)
    }

    fn from_rational(value: Ratio) -> Self {
        let (n, d) = (value.numerator, value.denominator);
        let Some(inverse) = Field::integer(d).inverse() else {
            return Residue::UNDEFINED; // d is a multiple of p.
        };
        Residue {
            field: Field::integer(n) * inverse,
            two_adic: match d {
                1 => TwoAdic::integer(n),
                _ => TwoAdic::integer(n) / TwoAdic::integer(d),
            },
            ratio: value,
            is_rational: true,
            constant: true,
            defined: true,
        }
    }

    /// A value of which only the image in the field is known; its 2-adic image is derived from
    /// that, with opposite images for x and −x. 0, ±1/2 and ±1 are recognised: cos(π/2) is 0, not
    /// merely something equal to it.
    fn opaque(field: Field, constant: bool) -> Self {
        for twice in -2..=2 {
            if field == Field::integer(twice).half()
                && let Some(value) = Ratio::new(twice as i128, 2)
            {
                return Residue {
                    constant,
                    ..Residue::from_rational(value)
                };
            }
        }
        let (positive, negated) = field.canonical();
        let word = |k| hash(Tag::Image, &[positive.re, positive.im, k]);
        let two_adic = TwoAdic::odd(wide(word(0), word(1)));
        Residue {
            field,
            two_adic: if negated { -two_adic } else { two_adic },
            ratio: Ratio::ZERO,
            is_rational: false,
            constant,
            defined: true,
        }
    }

    /// A function of two numbers of which no property is used.
    fn opaque_function(self, other: Self, tag: Tag) -> Self {
        let (a, b) = (self.field, other.field);
        let value = Field::real(hash(tag, &[a.re, a.im, b.re, b.im]) % P);
        Residue::opaque(value, self.constant && other.constant)
    }

    /// bπ.
    fn pi_times(b: Ratio) -> Self {
        Residue::pi() * Residue::from_rational(b)
    }

    /// e^{ix} and e^{−ix}, if x has a 2-adic image.
    fn unit(self) -> Option<(Field, Field)> {
        // x = angle + bπ, if ζ(b) exists; otherwise bπ stays in the angle.
        let (angle, root) = match self.turn() {
            Ratio::ZERO => (self, None),
            turn => match root_of_unity(turn) {
                Some(root) => (self - Residue::pi_times(turn), Some(root)),
                None => (self, None),
            },
        };
        let root = root.unwrap_or((Field::ONE, Field::ONE));
        if matches!(angle.two_adic, TwoAdic::Undefined) {
            return None;
        }
        let exponent = angle
            .two_adic
            .scaled(HALVINGS)
            .modulo_power_of_two(CIRCLE_BITS)
            .unwrap_or_else(|| angle.opaque_exponent());
        let on_circle = GENERATOR.pow(exponent);
        Some((on_circle * root.0, on_circle.conjugate() * root.1))
    }

    /// A power of the generator for an angle that is not known well enough: equal for equal values,
    /// opposite for opposite values.
    fn opaque_exponent(self) -> u64 {
        let (positive, negated) = self.field.canonical();
        let exponent = hash(Tag::Angle, &[positive.re, positive.im]) | 1;
        if negated {
            exponent.wrapping_neg()
        } else {
            exponent
        }
    }

    /// The angle of the direction (`cosine`, `sine`): its 2-adic image is the logarithm on the
    /// circle. `on_circle` says whether cosine² + sine² = 1; if not, the two are only numbers that
    /// determine the angle.
    fn angle(cosine: Field, sine: Field, on_circle: bool, constant: bool) -> Self {
        let (sine, negated) = sine.canonical();
        let words = [cosine.re, cosine.im, sine.re, sine.im, on_circle as u64];
        let image = Field::real(1 + hash(Tag::Inverse, &words) % (P - 1));
        let mut angle = Residue::opaque(image, constant);
        if on_circle && cosine.im == 0 && sine.im == 0 {
            let log = circle_logarithm(Field {
                re: cosine.re,
                im: sine.re,
            });
            if let Some(turn) = simple_turn(log) {
                // A fraction of π with a power of 2 in the denominator: π/4 for tan = 1. By chance,
                // once in 2⁴⁸ times, and for an angle that was itself made from a 2-adic number once in 2²⁸.
                let angle = Residue::pi_times(turn);
                return if negated { -angle } else { angle };
            }
            // Any 2-adic number with these 61 lowest bits will do; the direction determines the
            // other bits too.
            let bits = (hash(Tag::Upper, &words) as u128) << CIRCLE_BITS | log as u128;
            angle.two_adic = TwoAdic::from_bits(bits, 0, 128).scaled(-HALVINGS);
        } else if !constant {
            angle.two_adic = TwoAdic::Undefined;
        }
        if negated { -angle } else { angle }
    }

    /// Whether self < other, for rationals; other numbers have no order.
    fn known_less_than(self, other: Self) -> Option<bool> {
        Some(self.rational()?.less_than(other.rational()?))
    }

    fn half(self) -> Self {
        self / Residue::from_rational(Ratio::integer(2))
    }
}

impl Scalar for Residue {
    type Stored = Self;

    #[inline(always)]
    fn load(stored: Self) -> Self {
        stored
    }
    #[inline(always)]
    fn store(self) -> Self {
        self
    }

    const ZERO: Self = Residue {
        field: Field::ZERO,
        two_adic: TwoAdic::Zero,
        ratio: Ratio::ZERO,
        is_rational: true,
        constant: true,
        defined: true,
    };
    const ONE: Self = Residue {
        field: Field::ONE,
        two_adic: TwoAdic::ONE,
        ratio: Ratio::ONE,
        is_rational: true,
        constant: true,
        defined: true,
    };

    /// Exact: an `f64` is an integer times a power of 2.
    fn from_f64(x: f64) -> Self {
        if !x.is_finite() {
            return Residue::UNDEFINED;
        }
        if x == 0.0 {
            return Residue::ZERO;
        }
        let (significand, exponent) = integer_and_exponent(x);
        let rational = match exponent {
            0..=62 => Ratio::new((significand as i128) << exponent, 1),
            -62..0 => Ratio::new(significand as i128, 1 << -exponent),
            _ => None,
        };
        Residue {
            field: Field::integer(significand) * Field::power_of_two(exponent),
            two_adic: TwoAdic::integer(significand).scaled(exponent),
            ratio: rational.unwrap_or(Ratio::ZERO),
            is_rational: rational.is_some(),
            constant: true,
            defined: true,
        }
    }

    /// Exact.
    fn from_ratio(numerator: i64, denominator: i64) -> Self {
        Ratio::new(numerator as i128, denominator as i128)
            .map_or(Residue::UNDEFINED, Residue::from_rational)
    }

    fn pi() -> Self {
        let word = |k| hash(Tag::Pi, &[k]);
        Residue {
            field: Field::real(1 + word(0) % (P - 1)),
            two_adic: TwoAdic::odd(wide(word(1), word(2))),
            ratio: Ratio::ONE,
            is_rational: false,
            constant: true,
            defined: true,
        }
    }

    /// cos x = (e^{ix} + e^{−ix})/2, sin x = (e^{ix} − e^{−ix})/2i.
    fn sin_cos(self) -> (Self, Self) {
        if !self.defined {
            return (Residue::UNDEFINED, Residue::UNDEFINED);
        }
        let Some((forth, back)) = self.unit() else {
            return (Residue::UNDEFINED, Residue::UNDEFINED);
        };
        let cos = (forth + back).half();
        // 1/i = −i.
        let sin = -(forth - back).half().times_i();
        (
            Residue::opaque(sin, self.constant),
            Residue::opaque(cos, self.constant),
        )
    }

    /// The direction (√(1 − x²), x).
    fn asin(self) -> Self {
        if !self.defined {
            return Residue::UNDEFINED;
        }
        let sine = self.field;
        let square = Field::ONE - sine * sine;
        match square.root() {
            Some(root) => Residue::angle(root, sine, root.im == 0, self.constant),
            None => Residue::angle(square, sine, false, self.constant),
        }
    }

    /// π/2 − asin x.
    fn acos(self) -> Self {
        Residue::pi().half() - self.asin()
    }

    /// The direction (1, x)/√(1 + x²).
    fn atan(self) -> Self {
        self.atan2(Residue::ONE)
    }

    /// The direction (x, y)/√(x² + y²).
    fn atan2(self, x: Self) -> Self {
        let (y, constant) = (self, self.constant && x.constant);
        if !y.defined || !x.defined {
            return Residue::UNDEFINED;
        }
        let square = x.field * x.field + y.field * y.field;
        // With √(−a) = i√a the same formula gives a direction that scales correctly, though not on the circle.
        let scale = square.root().and_then(|root| {
            let on_circle = root.im == 0;
            Some((root.inverse()?, on_circle))
        });
        match scale {
            Some((scale, on_circle)) => {
                Residue::angle(x.field * scale, y.field * scale, on_circle, constant)
            }
            None if square.is_zero() => Residue::UNDEFINED,
            None => Residue::angle(x.field, y.field, false, constant),
        }
    }

    fn sinh(self) -> Self {
        let e = self.exp();
        (e - Residue::ONE / e).half()
    }

    fn cosh(self) -> Self {
        let e = self.exp();
        (e + Residue::ONE / e).half()
    }

    fn tanh(self) -> Self {
        self.sinh() / self.cosh()
    }

    /// Opaque, with e^0 = 1 and e^{−x} = 1/e^x.
    fn exp(self) -> Self {
        if !self.defined {
            return Residue::UNDEFINED;
        }
        if self.field.is_zero() {
            return Residue::ONE;
        }
        let (positive, negated) = self.field.canonical();
        let value = Field::real(1 + hash(Tag::Exp, &[positive.re, positive.im]) % (P - 1));
        let value = Residue::opaque(value, self.constant);
        if negated { Residue::ONE / value } else { value }
    }

    /// Opaque, with ln 1 = 0.
    fn ln(self) -> Self {
        if !self.defined || self.field.is_zero() {
            return Residue::UNDEFINED;
        }
        if self.field == Field::ONE {
            return Residue::ZERO;
        }
        self.opaque_function(Residue::ZERO, Tag::Ln)
    }

    fn sqrt(self) -> Self {
        if !self.defined {
            return Residue::UNDEFINED;
        }
        if let Some(value) = self.rational() {
            return root_of_rational(value);
        }
        match self.field.root() {
            // A root outside GF(p) of a number inside: the number counts as negative.
            Some(root) if root.im == 0 || self.field.im != 0 || self.constant => {
                Residue::opaque(root, self.constant)
            }
            None if self.constant => self.opaque_function(Residue::ZERO, Tag::Root),
            _ => Residue::UNDEFINED,
        }
    }

    fn powf(self, exponent: Self) -> Self {
        if !self.defined || !exponent.defined {
            return Residue::UNDEFINED;
        }
        if let Some(Ratio {
            numerator,
            denominator: denominator @ (1 | 2),
        }) = exponent.rational()
            && let Ok(numerator) = i32::try_from(numerator)
        {
            let base = if denominator == 2 { self.sqrt() } else { self };
            return base.powi(numerator);
        }
        self.opaque_function(exponent, Tag::Power)
    }

    fn abs(self) -> Self {
        self * self.sign()
    }

    fn sign(self) -> Self {
        if !self.defined {
            return Residue::UNDEFINED;
        }
        let sign = match self.rational() {
            Some(value) => value.numerator.signum(),
            None => self.field.sign(),
        };
        Residue::from_rational(Ratio::integer(sign))
    }

    fn min(self, other: Self) -> Self {
        match self.known_less_than(other) {
            Some(true) => self,
            Some(false) => other,
            None => (self + other - (self - other).abs()).half(),
        }
    }

    fn max(self, other: Self) -> Self {
        match self.known_less_than(other) {
            Some(true) => other,
            Some(false) => self,
            None => (self + other + (self - other).abs()).half(),
        }
    }

    fn is_finite(self) -> bool {
        self.defined
    }

    fn exceeds(self, bound: Self) -> bool {
        self.defined && bound.defined && self.field != bound.field
    }

    /// The rational number, if it is known; otherwise the residue, which only shows whether two
    /// values are equal.
    fn to_f64(self) -> f64 {
        match self.rational() {
            _ if !self.defined => f64::NAN,
            Some(value) => value.numerator as f64 / value.denominator as f64,
            None => self.field.re as f64,
        }
    }
}

impl PartialEq for Residue {
    fn eq(&self, other: &Self) -> bool {
        self.defined && other.defined && self.field == other.field
    }
}

/// √(n/d) = √n √d / d; undefined for negative n.
fn root_of_rational(value: Ratio) -> Residue {
    if value.numerator < 0 {
        return Residue::UNDEFINED;
    }
    root_of_integer(value.numerator as u64) * root_of_integer(value.denominator as u64)
        / Residue::from_rational(Ratio::integer(value.denominator))
}

/// √n as a product over the prime factors of n, with each prime's root by [`Field::root`]: so √12 =
/// 2√3 and √21 = √3√7.
///
/// Factors above 2¹¹ are not searched for, except that n may be a square.
fn root_of_integer(mut n: u64) -> Residue {
    if n == 0 {
        return Residue::ZERO;
    }
    let mut cofactor: i64 = 1;
    let mut root = Field::ONE;
    for q in 2..1 << 11 {
        if q * q > n {
            break; // n is 1 or a prime number
        }
        let mut power = 0;
        while n.is_multiple_of(q) {
            n /= q;
            power += 1;
        }
        for _ in 0..power / 2 {
            cofactor *= q as i64;
        }
        if power % 2 == 1 {
            root = root * Field::real(q).root().unwrap_or(Field::ZERO);
        }
    }
    let rest = n.isqrt();
    if rest * rest == n {
        cofactor *= rest as i64;
    } else {
        root = root * Field::real(n % P).root().unwrap_or(Field::ZERO);
    }
    Residue::from_rational(Ratio::integer(cofactor)) * Residue::opaque(root, true)
}

/// An integer m and n with x = m·2ⁿ, for finite x.
fn integer_and_exponent(x: f64) -> (i64, i32) {
    let bits = x.to_bits();
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let biased = (bits >> 52 & 0x7ff) as i32;
    // Subnormal numbers have no hidden bit.
    let (magnitude, exponent) = match biased {
        0 => (fraction, -1074),
        _ => (fraction | 1 << 52, biased - 1075),
    };
    (if x < 0.0 { -magnitude } else { magnitude }, exponent)
}

/// The purpose of a hash: different tags give independent values.
#[derive(Clone, Copy)]
enum Tag {
    Symbol,
    Pi,
    Image,
    Angle,
    Inverse,
    Upper,
    Exp,
    Ln,
    Root,
    Power,
}

fn wide(high: u64, low: u64) -> u128 {
    (high as u128) << 64 | low as u128
}

/// A hash of the words, each mixed in by a step of SplitMix64.
///
/// G. L. Steele, D. Lea and C. H. Flood, *Fast splittable pseudorandom number generators*, OOPSLA
/// 2014.
fn hash(tag: Tag, words: &[u64]) -> u64 {
    words
        .iter()
        .fold(stir(tag as u64), |state, &word| stir(state ^ stir(word)))
}

fn stir(state: u64) -> u64 {
    let z = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests;
