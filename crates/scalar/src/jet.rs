//! Truncated power series in one variable.
//!
//! `x₀ + x₁ τ + … + x₍N−1₎ τᴺ⁻¹`, without higher powers of `τ`: evaluating an expression in such numbers gives its first
//! Taylor coefficients along a curve. Series programs are compared with them, so functions are composed here by Taylor's
//! formula at `x₀`, or by integrating their derivatives, and not by the recurrences of those programs.

#![expect(
    clippy::needless_range_loop,
    reason = "iterators over coefficients would be compiled once more for each type of number"
)]

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::Scalar;

/// The first `N` Taylor coefficients of a function of one variable, the value first; `N` is at least 1.
///
/// ```
/// use lagrangian_scalar::{Jet, Scalar};
/// let t = Jet::<f64, 4>::variable(0.0);
/// assert_eq!(t.exp().0, [1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet<S, const N: usize>(pub [S; N]);

impl<S: Scalar, const N: usize> Jet<S, N> {
    /// A constant.
    pub fn constant(value: S) -> Self {
        let mut jet = [S::ZERO; N];
        jet[0] = value;
        Jet(jet)
    }

    /// The variable itself: `value + τ`.
    pub fn variable(value: S) -> Self {
        let mut jet = Self::constant(value);
        if N > 1 {
            jet.0[1] = S::ONE;
        }
        jet
    }

    /// `Σ cₙ δⁿ`, where `self = x₀ + δ`.
    fn compose(self, coefficients: [S; N]) -> Self {
        let mut delta = self;
        delta.0[0] = S::ZERO;
        let mut sum = Self::ZERO;
        for n in (0..N).rev() {
            sum = sum * delta + Self::constant(coefficients[n]);
        }
        sum
    }

    /// The function with the value `value` at `x₀` whose derivatives there alternate: `f, f′, f″ …` are
    /// `value`, `slope`, `sign·value`, `sign·slope`, `value` and so on.
    fn alternating(self, value: S, slope: S, sign: i64) -> Self {
        let mut next = [value, slope];
        let mut over_factorial = S::ONE;
        let mut coefficients = [S::ZERO; N];
        for n in 0..N {
            if n > 0 {
                over_factorial = over_factorial * S::from_ratio(1, n as i64);
            }
            coefficients[n] = next[n % 2] * over_factorial;
            next[n % 2] = S::from_ratio(sign, 1) * next[n % 2];
        }
        self.compose(coefficients)
    }

    /// `x^r` for a constant `r`, given its value at `x₀`, by the binomial series.
    fn power(self, value: S, r: S) -> Self {
        let mut coefficients = [value; N];
        for n in 1..N {
            let factor = (r - S::from_ratio(n as i64 - 1, 1)) * S::from_ratio(1, n as i64);
            coefficients[n] = coefficients[n - 1] * factor / self.0[0];
        }
        self.compose(coefficients)
    }

    /// `dx/dτ`; the last coefficient is unknown and set to 0.
    fn derivative(self) -> Self {
        let mut jet = [S::ZERO; N];
        for n in 1..N {
            jet[n - 1] = S::from_ratio(n as i64, 1) * self.0[n];
        }
        Jet(jet)
    }

    /// The integral of `self` with the value `value` at `τ = 0`; the last coefficient of `self` is not read.
    fn integral(self, value: S) -> Self {
        let mut jet = Self::constant(value);
        for n in 1..N {
            jet.0[n] = S::from_ratio(1, n as i64) * self.0[n - 1];
        }
        jet
    }
}

impl<S: Scalar, const N: usize> Add for Jet<S, N> {
    type Output = Self;
    fn add(mut self, other: Self) -> Self {
        for n in 0..N {
            self.0[n] = self.0[n] + other.0[n];
        }
        self
    }
}

impl<S: Scalar, const N: usize> Sub for Jet<S, N> {
    type Output = Self;
    fn sub(mut self, other: Self) -> Self {
        for n in 0..N {
            self.0[n] = self.0[n] - other.0[n];
        }
        self
    }
}

impl<S: Scalar, const N: usize> Neg for Jet<S, N> {
    type Output = Self;
    fn neg(mut self) -> Self {
        for n in 0..N {
            self.0[n] = -self.0[n];
        }
        self
    }
}

impl<S: Scalar, const N: usize> Mul for Jet<S, N> {
    type Output = Self;
    /// The Cauchy product.
    fn mul(self, other: Self) -> Self {
        let mut product = [S::ZERO; N];
        for n in 0..N {
            product[n] = self.0[0] * other.0[n];
            for j in 1..n + 1 {
                product[n] = product[n] + self.0[j] * other.0[n - j];
            }
        }
        Jet(product)
    }
}

impl<S: Scalar, const N: usize> Div for Jet<S, N> {
    type Output = Self;
    /// Long division.
    fn div(self, other: Self) -> Self {
        let mut left = self;
        let mut quotient = [S::ZERO; N];
        for n in 0..N {
            quotient[n] = left.0[n] / other.0[0];
            for j in 1..N - n {
                left.0[n + j] = left.0[n + j] - quotient[n] * other.0[j];
            }
        }
        Jet(quotient)
    }
}

impl<S: Scalar, const N: usize> Scalar for Jet<S, N> {
    type Stored = Self;

    #[inline(always)]
    fn load(stored: Self) -> Self {
        stored
    }
    #[inline(always)]
    fn store(self) -> Self {
        self
    }

    const ZERO: Self = Jet([S::ZERO; N]);
    const ONE: Self = {
        let mut jet = [S::ZERO; N];
        jet[0] = S::ONE;
        Jet(jet)
    };

    fn from_f64(x: f64) -> Self {
        Jet::constant(S::from_f64(x))
    }
    fn from_ratio(numerator: i64, denominator: i64) -> Self {
        Jet::constant(S::from_ratio(numerator, denominator))
    }
    fn pi() -> Self {
        Jet::constant(S::pi())
    }
    fn product_error(self, b: Self) -> Self {
        Jet::constant(self.0[0].product_error(b.0[0]))
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.0[0].sin_cos();
        (
            self.alternating(sin, cos, -1),
            self.alternating(cos, -sin, -1),
        )
    }

    /// asin′ = 1/√(1 − x²).
    fn asin(self) -> Self {
        let root = ((Self::ONE - self) * (Self::ONE + self)).sqrt();
        (self.derivative() / root).integral(self.0[0].asin())
    }

    /// acos′ = −1/√(1 − x²).
    fn acos(self) -> Self {
        let root = ((Self::ONE - self) * (Self::ONE + self)).sqrt();
        (-self.derivative() / root).integral(self.0[0].acos())
    }

    /// atan′ = 1/(1 + x²).
    fn atan(self) -> Self {
        (self.derivative() / (Self::ONE + self * self)).integral(self.0[0].atan())
    }

    /// (x y′ − y x′)/(x² + y²).
    fn atan2(self, x: Self) -> Self {
        let area = x * self.derivative() - self * x.derivative();
        (area / (x * x + self * self)).integral(self.0[0].atan2(x.0[0]))
    }

    fn sinh(self) -> Self {
        self.alternating(self.0[0].sinh(), self.0[0].cosh(), 1)
    }

    fn cosh(self) -> Self {
        self.alternating(self.0[0].cosh(), self.0[0].sinh(), 1)
    }

    /// tanh′ = 1/cosh².
    fn tanh(self) -> Self {
        let cosh = self.cosh();
        (self.derivative() / (cosh * cosh)).integral(self.0[0].tanh())
    }

    fn exp(self) -> Self {
        let exp = self.0[0].exp();
        self.alternating(exp, exp, 1)
    }

    /// ln′ = 1/x.
    fn ln(self) -> Self {
        (self.derivative() / self).integral(self.0[0].ln())
    }

    fn sqrt(self) -> Self {
        self.power(self.0[0].sqrt(), S::from_ratio(1, 2))
    }

    /// By the binomial series if the exponent is constant, otherwise as `exp(y ln x)`.
    fn powf(self, exponent: Self) -> Self {
        if exponent == Jet::constant(exponent.0[0]) {
            self.power(self.0[0].powf(exponent.0[0]), exponent.0[0])
        } else {
            (exponent * self.ln()).exp()
        }
    }

    /// `sign(x₀)·x`; 0 at the kink, except for the value.
    fn abs(self) -> Self {
        let sign = self.0[0].sign();
        let mut jet = self;
        for n in 1..N {
            jet.0[n] = sign * self.0[n];
        }
        jet.0[0] = self.0[0].abs();
        jet
    }

    fn sign(self) -> Self {
        Jet::constant(self.0[0].sign())
    }

    /// The jet of the smaller value; the mean of both if the values are equal.
    fn min(self, other: Self) -> Self {
        let mut jet = mean(self, other, -(self.0[0] - other.0[0]).sign());
        jet.0[0] = self.0[0].min(other.0[0]);
        jet
    }

    /// The jet of the larger value; the mean of both if the values are equal.
    fn max(self, other: Self) -> Self {
        let mut jet = mean(self, other, (self.0[0] - other.0[0]).sign());
        jet.0[0] = self.0[0].max(other.0[0]);
        jet
    }

    fn is_finite(self) -> bool {
        self.0.into_iter().all(S::is_finite)
    }

    /// Whether the value exceeds that of the bound.
    fn exceeds(self, bound: Self) -> bool {
        self.0[0].exceeds(bound.0[0])
    }

    fn to_f64(self) -> f64 {
        self.0[0].to_f64()
    }
}

/// a for sign 1, b for sign −1, (a + b)/2 for 0.
fn mean<S: Scalar, const N: usize>(a: Jet<S, N>, b: Jet<S, N>, sign: S) -> Jet<S, N> {
    let half = S::from_ratio(1, 2);
    let mut mean = a;
    for n in 0..N {
        mean.0[n] = (a.0[n] * (S::ONE + sign) + b.0[n] * (S::ONE - sign)) * half;
    }
    mean
}
