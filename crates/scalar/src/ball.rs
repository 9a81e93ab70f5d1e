//! Numbers of double-double precision with a bound of their error.
//!
//! A [`Ball`] is a centre and a radius that contain the true value: every operation adds the bound
//! of its own rounding error, from [`DoubleDouble`], to the radii of its operands propagated by the
//! derivative of the operation (J. van der Hoeven, *Ball arithmetic*, in A. Beckmann et al. (eds.),
//! Logical approaches to barriers in computing and complexity, Greifswald 2010, 179–208). Two
//! values with disjoint balls are certainly different; two with intersecting balls are equal up to
//! the radii, which after a thousand operations are still of the size 10⁻²⁷.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::{DoubleDouble, Scalar};

/// The bound of the relative error of an operation on [`DoubleDouble`], functions included. The
/// rounding error of the radius itself, some 2⁻⁵⁰ of it, is far smaller than the margin between
/// this bound and the true ones.
const ROUNDING: f64 = 1.0 / (1u128 << 99) as f64;

/// The relative widening of radii wherever they are computed.
const WIDER: f64 = 1.0 + 1.0 / (1u64 << 44) as f64;

/// Below this magnitude a double-double is less accurate than its bounds: 2⁻⁹⁰⁰, which is used as
/// the error there.
const UNDERFLOW: f64 = 1.183_052_186_166_774_7e-271;

/// All numbers within a radius of a double-double; nothing is known if
/// [`is_finite`](Scalar::is_finite) is false.
///
/// ```
/// use lagrangian_scalar::{Ball, Scalar};
/// let third = Ball::from_ratio(1, 3);
/// let one = third + third + third;
/// assert!(one.radius() > 0.0 && one.radius() < 1e-29);
/// assert!(one.contains(1.0) && !one.contains(1.0 + 1e-15));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    centre: DoubleDouble,
    radius: f64,
}

impl Ball {
    const UNKNOWN: Ball = Ball {
        centre: DoubleDouble::ZERO,
        radius: f64::INFINITY,
    };

    /// The centre.
    pub fn centre(self) -> DoubleDouble {
        self.centre
    }

    /// The largest possible distance of the value from the centre.
    pub fn radius(self) -> f64 {
        self.radius
    }

    /// Whether `x` may be the value.
    pub fn contains(self, x: f64) -> bool {
        let distance = (self.centre - DoubleDouble::from(x)).abs();
        distance <= DoubleDouble::from(self.radius)
    }

    /// The largest possible magnitude of the value.
    pub fn magnitude(self) -> f64 {
        (self.size() + self.radius) * WIDER
    }

    /// The magnitude of the centre.
    fn size(self) -> f64 {
        self.centre.hi().abs()
    }

    /// The smallest possible magnitude of the value; 0 or less if it may be 0.
    fn least(self) -> f64 {
        self.size() / WIDER - self.radius
    }

    fn is_zero(self) -> bool {
        self == Ball::ZERO
    }

    /// A rounded result that already had the error `error` before rounding.
    fn rounded(centre: DoubleDouble, error: f64) -> Ball {
        let size = centre.hi().abs();
        let mut radius = (error + ROUNDING * size) * WIDER;
        if size < UNDERFLOW && radius < UNDERFLOW {
            radius = UNDERFLOW;
        }
        if !centre.is_finite() || !radius.is_finite() {
            return Ball::UNKNOWN;
        }
        Ball { centre, radius }
    }

    /// A result for which `slope` bounds the derivative on the whole ball.
    fn by_slope(self, centre: DoubleDouble, slope: f64) -> Ball {
        if self.is_finite() {
            Ball::rounded(centre, slope * self.radius)
        } else {
            Ball::UNKNOWN
        }
    }
}

impl Neg for Ball {
    type Output = Ball;
    fn neg(self) -> Ball {
        Ball {
            centre: -self.centre,
            radius: self.radius,
        }
    }
}

impl Add for Ball {
    type Output = Ball;
    fn add(self, other: Ball) -> Ball {
        match (self.is_zero(), other.is_zero()) {
            (true, _) => other,
            (_, true) => self,
            _ => Ball::rounded(self.centre + other.centre, self.radius + other.radius),
        }
    }
}

impl Sub for Ball {
    type Output = Ball;
    fn sub(self, other: Ball) -> Ball {
        self + -other
    }
}

impl Mul for Ball {
    type Output = Ball;
    fn mul(self, other: Ball) -> Ball {
        if !self.is_finite() || !other.is_finite() {
            return Ball::UNKNOWN;
        }
        if self.is_zero() || other.is_zero() {
            return Ball::ZERO;
        }
        let error =
            self.size() * other.radius + other.size() * self.radius + self.radius * other.radius;
        Ball::rounded(self.centre * other.centre, error * WIDER)
    }
}

impl Div for Ball {
    type Output = Ball;
    fn div(self, other: Ball) -> Ball {
        let least = other.least();
        if least.is_nan() || least <= 0.0 || !self.is_finite() {
            return Ball::UNKNOWN;
        }
        if self.is_zero() {
            return Ball::ZERO;
        }
        let centre = self.centre / other.centre;
        let error = (self.radius + centre.hi().abs() * WIDER * other.radius) / least;
        Ball::rounded(centre, error)
    }
}

impl Scalar for Ball {
    type Stored = Self;

    #[inline(always)]
    fn load(stored: Self) -> Self {
        stored
    }
    #[inline(always)]
    fn store(self) -> Self {
        self
    }

    const ZERO: Self = Ball {
        centre: DoubleDouble::ZERO,
        radius: 0.0,
    };
    const ONE: Self = Ball {
        centre: DoubleDouble::ONE,
        radius: 0.0,
    };

    /// Exact.
    fn from_f64(x: f64) -> Self {
        if x.is_finite() {
            Ball {
                centre: x.into(),
                radius: 0.0,
            }
        } else {
            Ball::UNKNOWN
        }
    }

    /// Exact if `denominator` is 1.
    fn from_ratio(numerator: i64, denominator: i64) -> Self {
        let centre = DoubleDouble::from_ratio(numerator, denominator);
        match denominator {
            1 => Ball {
                centre,
                radius: 0.0,
            },
            _ => Ball::rounded(centre, 0.0),
        }
    }

    fn pi() -> Self {
        Ball::rounded(DoubleDouble::pi(), 0.0)
    }

    /// 0: the radius contains the error.
    fn product_error(self, _: Self) -> Self {
        Ball::ZERO
    }

    /// 0: the radius contains the error.
    fn sum_error(self, _: Self) -> Self {
        Ball::ZERO
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.centre.sin_cos();
        (self.by_slope(sin, 1.0), self.by_slope(cos, 1.0))
    }

    fn asin(self) -> Self {
        // 1 − x² at the end that is nearer to ±1.
        let end = self.magnitude();
        let slope = 1.0 / libm::sqrt((1.0 - end) * (1.0 + end));
        self.by_slope(self.centre.asin(), slope)
    }

    fn acos(self) -> Self {
        let end = self.magnitude();
        let slope = 1.0 / libm::sqrt((1.0 - end) * (1.0 + end));
        self.by_slope(self.centre.acos(), slope)
    }

    fn atan(self) -> Self {
        self.by_slope(self.centre.atan(), 1.0)
    }

    fn atan2(self, x: Self) -> Self {
        let y = self;
        if !y.is_finite() || !x.is_finite() {
            return Ball::UNKNOWN;
        }
        let error = y.radius + x.radius;
        let distance = libm::hypot(x.size(), y.size()) / WIDER - error;
        // The angle jumps across the negative x axis.
        let jumps = y.radius > 0.0 && y.least() <= 0.0 && x.centre.hi() - x.radius <= 0.0;
        if distance <= 0.0 || jumps {
            return Ball::UNKNOWN;
        }
        Ball::rounded(y.centre.atan2(x.centre), error / distance)
    }

    fn sinh(self) -> Self {
        let slope = libm::cosh(self.magnitude()) * WIDER;
        self.by_slope(self.centre.sinh(), slope)
    }

    fn cosh(self) -> Self {
        let slope = libm::cosh(self.magnitude()) * WIDER;
        self.by_slope(self.centre.cosh(), slope)
    }

    fn tanh(self) -> Self {
        self.by_slope(self.centre.tanh(), 1.0)
    }

    fn exp(self) -> Self {
        let slope = libm::exp(self.centre.hi() + self.radius) * WIDER;
        self.by_slope(self.centre.exp(), slope)
    }

    fn ln(self) -> Self {
        let least = self.least();
        if least.is_nan() || least <= 0.0 || self.centre.hi() <= 0.0 {
            return Ball::UNKNOWN;
        }
        let value = self.by_slope(self.centre.ln(), 1.0 / least);
        // Near 1 the error of the logarithm is not proportional to its value.
        Ball::rounded(value.centre, value.radius + ROUNDING)
    }

    fn sqrt(self) -> Self {
        if self.is_zero() {
            return Ball::ZERO;
        }
        let least = self.least();
        if least.is_nan() || least <= 0.0 || self.centre.hi() <= 0.0 {
            return Ball::UNKNOWN;
        }
        self.by_slope(self.centre.sqrt(), 0.5 / libm::sqrt(least) * WIDER)
    }

    fn powf(self, exponent: Self) -> Self {
        let least = self.least();
        if !self.is_finite() || !exponent.is_finite() {
            return Ball::UNKNOWN;
        }
        let centre = self.centre.powf(exponent.centre);
        if self.is_zero() {
            return Ball::rounded(centre, 0.0);
        }
        if least.is_nan() || least <= 0.0 {
            return Ball::UNKNOWN;
        }
        // The error of y ln |x|, plus that of the logarithm itself.
        let logarithm =
            libm::fmax(libm::log(self.magnitude()).abs(), libm::log(least).abs()) * WIDER;
        let share = exponent.radius * logarithm
            + exponent.magnitude() * (self.radius / least + ROUNDING * logarithm);
        let share = libm::expm1(share * WIDER) * WIDER;
        Ball::rounded(centre, centre.hi().abs() * WIDER * share)
    }

    fn abs(self) -> Self {
        Ball {
            centre: self.centre.abs(),
            radius: self.radius,
        }
    }

    /// Unknown if the value may be 0 but need not be.
    fn sign(self) -> Self {
        if self.is_zero() {
            return Ball::ZERO;
        }
        if self.least() > 0.0 {
            if self.centre.hi() < 0.0 {
                -Ball::ONE
            } else {
                Ball::ONE
            }
        } else {
            Ball::UNKNOWN
        }
    }

    fn min(self, other: Self) -> Self {
        Ball {
            centre: self.centre.min(other.centre),
            radius: self.radius.max(other.radius),
        }
    }

    fn max(self, other: Self) -> Self {
        Ball {
            centre: self.centre.max(other.centre),
            radius: self.radius.max(other.radius),
        }
    }

    fn is_finite(self) -> bool {
        self.radius.is_finite() && self.centre.is_finite()
    }

    fn exceeds(self, bound: Self) -> bool {
        let difference = self - bound;
        difference.is_finite() && difference.centre.hi() > 0.0 && difference.least() > 0.0
    }

    fn to_f64(self) -> f64 {
        if self.is_finite() {
            self.centre.to_f64()
        } else {
            f64::NAN
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers from −4 to 4 with few digits, so that exact arithmetic on them fits into integers.
    fn eighths(seed: u64) -> impl Iterator<Item = i64> {
        let mut state = seed;
        core::iter::from_fn(move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            Some((state >> 58) as i64 - 32)
        })
    }

    #[test]
    fn sums_products_and_quotients_contain_the_exact_value() {
        let mut numbers = eighths(20_261_122);
        let mut tried = 0;
        for _ in 0..2000 {
            let mut next = || numbers.next().expect("endless");
            let (a, b, c, d) = (next(), next(), next(), next());
            if d == 0 || b == 0 || c == 0 {
                continue;
            }
            // (a/d + b/(3d))·(c/(7b)) − a/(5c) = (3a + b) c/(21 b d) − a/(5c), exactly.
            let ball = |n: i64, d: i64| Ball::from_ratio(n, 1) / Ball::from_ratio(d, 1);
            let quotient_by_balls = (ball(a, d) + ball(b, 3 * d)) * ball(c, 7 * b) - ball(a, 5 * c);
            let numerator = (3 * a + b) * c * 5 * c - a * 21 * b * d;
            let denominator = 21 * b * d * 5 * c;
            // Multiplied by the denominator it is an integer, which is exact.
            let product = quotient_by_balls * Ball::from_ratio(denominator, 1);
            assert!(product.contains(numerator as f64), "{a} {b} {c} {d}");
            // Some ten operations, each bounded by a few roundings of the largest terms, and as much again.
            let size = (15 * a.abs() + 5 * b.abs()) * c * c + 21 * (a * b * d).abs();
            let size = size as f64;
            assert!(
                product.radius() < 256.0 * 0.5f64.powi(104) * size,
                "{product:?}"
            );
            let (a, b) = (numerator as f64, 1e-18 * numerator as f64);
            assert!(numerator == 0 || !(product - Ball::from_f64(a)).contains(b));
            tried += 1;
        }
        assert!(tried > 1500);
    }

    /// The image of every number of a ball is in the ball of images.
    #[test]
    fn functions_contain_the_images_of_all_numbers() {
        type Of<S> = fn(S) -> S;
        let functions: [(Of<Ball>, Of<DoubleDouble>, f64, f64); 13] = [
            (Ball::sin, DoubleDouble::sin, -9.0, 9.0),
            (Ball::cos, DoubleDouble::cos, -9.0, 9.0),
            (Ball::tan, DoubleDouble::tan, -1.4, 1.4),
            (Ball::asin, DoubleDouble::asin, -0.98, 0.98),
            (Ball::acos, DoubleDouble::acos, -0.98, 0.98),
            (Ball::atan, DoubleDouble::atan, -9.0, 9.0),
            (Ball::sinh, DoubleDouble::sinh, -3.0, 3.0),
            (Ball::cosh, DoubleDouble::cosh, -3.0, 3.0),
            (Ball::tanh, DoubleDouble::tanh, -3.0, 3.0),
            (Ball::exp, DoubleDouble::exp, -5.0, 5.0),
            (Ball::ln, DoubleDouble::ln, 0.1, 9.0),
            (Ball::sqrt, DoubleDouble::sqrt, 0.1, 9.0),
            (
                |x| x.powf(Ball::from_ratio(7, 3)),
                |x| x.powf(DoubleDouble::from_ratio(7, 3)),
                0.1,
                9.0,
            ),
        ];
        for (index, (ball, exact, low, high)) in functions.into_iter().enumerate() {
            for step in 0..200 {
                let x = low + (high - low) * (step as f64 + 0.37) / 200.0;
                for radius in [0.0, 1e-25, 1e-9, 1e-3] {
                    let whole = ball(Ball {
                        centre: x.into(),
                        radius,
                    });
                    assert!(whole.is_finite(), "{index} at {x}");
                    for share in [-1.0, -0.4, 0.0, 0.7, 1.0] {
                        let inside = DoubleDouble::from(x) + DoubleDouble::from(share * radius);
                        let distance = (whole.centre - exact(inside)).abs();
                        // The image itself is known to a relative accuracy of 2⁻¹⁰⁰.
                        let slack = 1e-29 * (1.0 + whole.size());
                        assert!(
                            distance.to_f64() <= whole.radius + slack,
                            "{index} at {x} with {radius}"
                        );
                    }
                    // A bound that is far too wide would prove nothing.
                    assert!(whole.radius <= 400.0 * radius + 1e-25 * (1.0 + whole.size()));
                }
            }
        }
    }

    #[test]
    fn what_may_be_zero_has_no_sign_and_divides_nothing() {
        let near = Ball {
            centre: DoubleDouble::from(1e-20),
            radius: 1e-19,
        };
        for unknown in [
            near.sign(),
            Ball::ONE / near,
            near.ln(),
            near.sqrt(),
            Ball::ZERO / Ball::ZERO,
            near.atan2(-Ball::ONE),
            Ball::from_f64(f64::NAN),
        ] {
            assert!(!unknown.is_finite(), "{unknown:?}");
            assert!(!(unknown + Ball::ONE).is_finite() && !(unknown * near).is_finite());
        }
        assert_eq!(Ball::ZERO.sign(), Ball::ZERO);
        assert!(!near.exceeds(Ball::ZERO) && Ball::ONE.exceeds(near));
    }
}
