//! Numbers that carry a derivative.
//!
//! The sum x + x′ε with ε² = 0 obeys f(x + x′ε) = f(x) + f′(x) x′ ε: evaluating an expression in
//! such numbers also evaluates its derivative, by the chain rule and without finite differences. W.
//! K. Clifford, *Preliminary sketch of biquaternions*, Proc. London Math. Soc. 4 (1873) 381–395; A.
//! Griewank and A. Walther, *Evaluating Derivatives*, 2nd ed., SIAM 2008, chapter 3.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::Scalar;

/// A value and its derivative with respect to one variable. It can be nested: `Dual<Dual<f64>>` has second derivatives.
///
/// ```
/// use lagrangian_scalar::{Dual, Scalar};
/// let x = Dual::variable(2.0);
/// let y = x * x * x;
/// assert_eq!((y.value, y.derivative), (8.0, 12.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<S> {
    /// The value.
    pub value: S,
    /// Its derivative.
    pub derivative: S,
}

impl<S: Scalar> Dual<S> {
    /// The variable itself: derivative 1.
    pub fn variable(value: S) -> Self {
        Dual {
            value,
            derivative: S::ONE,
        }
    }

    /// A value that does not depend on the variable: derivative 0.
    pub fn constant(value: S) -> Self {
        Dual {
            value,
            derivative: S::ZERO,
        }
    }

    /// f(x), given f(x) and f′(x) at the value.
    fn chain(self, value: S, slope: S) -> Self {
        Dual {
            value,
            derivative: slope * self.derivative,
        }
    }
}

/// 2x, without a constant 2.
fn twice<S: Scalar>(x: S) -> S {
    x + x
}

impl<S: Scalar> Add for Dual<S> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Dual {
            value: self.value + other.value,
            derivative: self.derivative + other.derivative,
        }
    }
}

impl<S: Scalar> Sub for Dual<S> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Dual {
            value: self.value - other.value,
            derivative: self.derivative - other.derivative,
        }
    }
}

impl<S: Scalar> Neg for Dual<S> {
    type Output = Self;
    fn neg(self) -> Self {
        Dual {
            value: -self.value,
            derivative: -self.derivative,
        }
    }
}

impl<S: Scalar> Mul for Dual<S> {
    type Output = Self;
    /// (xy)′ = x′y + xy′.
    fn mul(self, other: Self) -> Self {
        Dual {
            value: self.value * other.value,
            derivative: self.derivative * other.value + self.value * other.derivative,
        }
    }
}

impl<S: Scalar> Div for Dual<S> {
    type Output = Self;
    /// (x/y)′ = (x′ − (x/y) y′)/y.
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Dual {
            value,
            derivative: (self.derivative - value * other.derivative) / other.value,
        }
    }
}

impl<S: Scalar> Scalar for Dual<S> {
    type Stored = Self;

    #[inline(always)]
    fn load(stored: Self) -> Self {
        stored
    }
    #[inline(always)]
    fn store(self) -> Self {
        self
    }

    fn product_error(self, b: Self) -> Self {
        Dual::constant(self.value.product_error(b.value))
    }

    const ZERO: Self = Dual {
        value: S::ZERO,
        derivative: S::ZERO,
    };
    const ONE: Self = Dual {
        value: S::ONE,
        derivative: S::ZERO,
    };

    fn from_f64(x: f64) -> Self {
        Dual::constant(S::from_f64(x))
    }

    fn from_ratio(numerator: i64, denominator: i64) -> Self {
        Dual::constant(S::from_ratio(numerator, denominator))
    }

    fn pi() -> Self {
        Dual::constant(S::pi())
    }

    /// sin′ = cos, cos′ = −sin.
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.chain(sin, cos), self.chain(cos, -sin))
    }

    /// tan′ = 1 + tan².
    fn tan(self) -> Self {
        let tan = self.value.tan();
        self.chain(tan, S::ONE + tan * tan)
    }

    /// asin′ = 1/√(1 − x²).
    fn asin(self) -> Self {
        let x = self.value;
        let slope = S::ONE / ((S::ONE - x) * (S::ONE + x)).sqrt();
        self.chain(x.asin(), slope)
    }

    /// acos′ = −1/√(1 − x²).
    fn acos(self) -> Self {
        let x = self.value;
        let slope = -S::ONE / ((S::ONE - x) * (S::ONE + x)).sqrt();
        self.chain(x.acos(), slope)
    }

    /// atan′ = 1/(1 + x²).
    fn atan(self) -> Self {
        let x = self.value;
        self.chain(x.atan(), S::ONE / (S::ONE + x * x))
    }

    /// (x y′ − y x′)/(x² + y²).
    fn atan2(self, x: Self) -> Self {
        let y = self;
        let area = x.value * y.derivative - y.value * x.derivative;
        Dual {
            value: y.value.atan2(x.value),
            derivative: area / (x.value * x.value + y.value * y.value),
        }
    }

    /// sinh′ = cosh.
    fn sinh(self) -> Self {
        self.chain(self.value.sinh(), self.value.cosh())
    }

    /// cosh′ = sinh.
    fn cosh(self) -> Self {
        self.chain(self.value.cosh(), self.value.sinh())
    }

    /// tanh′ = 1/cosh², which does not cancel where tanh is close to 1.
    fn tanh(self) -> Self {
        let secant = S::ONE / self.value.cosh();
        self.chain(self.value.tanh(), secant * secant)
    }

    /// exp′ = exp.
    fn exp(self) -> Self {
        let exp = self.value.exp();
        self.chain(exp, exp)
    }

    /// ln′ = 1/x.
    fn ln(self) -> Self {
        self.chain(self.value.ln(), S::ONE / self.value)
    }

    /// (√x)′ = 1/(2√x).
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, S::ONE / twice(root))
    }

    /// (x^y)′ = y x^(y−1) x′ + x^y ln x y′; the second term only if the exponent varies, so that a
    /// negative base may have an integer exponent.
    fn powf(self, exponent: Self) -> Self {
        let (x, y) = (self.value, exponent.value);
        let power = x.powf(y);
        let by_base = y * x.powf(y - S::ONE) * self.derivative;
        let derivative = if exponent.derivative == S::ZERO {
            by_base
        } else {
            by_base + power * x.ln() * exponent.derivative
        };
        Dual {
            value: power,
            derivative,
        }
    }

    /// |x|′ = sign x; 0 at the kink.
    fn abs(self) -> Self {
        self.chain(self.value.abs(), self.value.sign())
    }

    /// Constant between its jumps.
    fn sign(self) -> Self {
        self.chain(self.value.sign(), S::ZERO)
    }

    /// The derivative of the smaller one; the mean of both derivatives if the values are equal.
    fn min(self, other: Self) -> Self {
        let sign = (self.value - other.value).sign();
        if sign == S::ONE {
            return other;
        }
        if sign == -S::ONE {
            return self;
        }
        Dual {
            value: self.value.min(other.value),
            derivative: mean(self.derivative, other.derivative, -sign),
        }
    }

    /// The derivative of the larger one; the mean of both derivatives if the values are equal.
    fn max(self, other: Self) -> Self {
        let sign = (self.value - other.value).sign();
        if sign == S::ONE {
            return self;
        }
        if sign == -S::ONE {
            return other;
        }
        Dual {
            value: self.value.max(other.value),
            derivative: mean(self.derivative, other.derivative, sign),
        }
    }

    /// (xⁿ)′ = n xⁿ⁻¹.
    fn powi(self, exponent: i32) -> Self {
        if exponent == 0 {
            return Dual {
                value: self.value.powi(0),
                derivative: S::ZERO * self.derivative,
            };
        }
        let n = S::from_ratio(exponent as i64, 1);
        // The smallest exponent cannot be decremented.
        let below = match exponent.checked_sub(1) {
            Some(below) => self.value.powi(below),
            None => self.value.powi(exponent) / self.value,
        };
        self.chain(self.value.powi(exponent), n * below)
    }

    fn is_finite(self) -> bool {
        self.value.is_finite() && self.derivative.is_finite()
    }

    /// Whether the value exceeds that of the bound.
    fn exceeds(self, bound: Self) -> bool {
        self.value.exceeds(bound.value)
    }

    fn to_f64(self) -> f64 {
        self.value.to_f64()
    }
}

/// a for sign 1, b for sign −1, (a + b)/2 for 0.
fn mean<S: Scalar>(a: S, b: S, sign: S) -> S {
    (a * (S::ONE + sign) + b * (S::ONE - sign)) * S::from_ratio(1, 2)
}
