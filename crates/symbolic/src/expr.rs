//! Functions and operators of expressions.

use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::dag::Expr;
use crate::node::Function;
use crate::rational::Rational;

impl<'d> Expr<'d> {
    /// The quotient; `None` if it has no value.
    pub fn checked_div(self, divisor: Expr<'d>) -> Option<Expr<'d>> {
        let quotient = self / divisor;
        (!quotient.is_undefined()).then_some(quotient)
    }

    /// Sine.
    pub fn sin(self) -> Expr<'d> {
        self.apply(Function::Sin)
    }
    /// Cosine.
    pub fn cos(self) -> Expr<'d> {
        self.apply(Function::Cos)
    }
    /// Tangent.
    pub fn tan(self) -> Expr<'d> {
        self.apply(Function::Tan)
    }
    /// Inverse sine.
    pub fn asin(self) -> Expr<'d> {
        self.apply(Function::Asin)
    }
    /// Inverse cosine.
    pub fn acos(self) -> Expr<'d> {
        self.apply(Function::Acos)
    }
    /// Inverse tangent.
    pub fn atan(self) -> Expr<'d> {
        self.apply(Function::Atan)
    }
    /// Hyperbolic sine.
    pub fn sinh(self) -> Expr<'d> {
        self.apply(Function::Sinh)
    }
    /// Hyperbolic cosine.
    pub fn cosh(self) -> Expr<'d> {
        self.apply(Function::Cosh)
    }
    /// Hyperbolic tangent.
    pub fn tanh(self) -> Expr<'d> {
        self.apply(Function::Tanh)
    }
    /// e to this power.
    pub fn exp(self) -> Expr<'d> {
        self.apply(Function::Exp)
    }
    /// Natural logarithm.
    pub fn ln(self) -> Expr<'d> {
        self.apply(Function::Ln)
    }
    /// Square root.
    pub fn sqrt(self) -> Expr<'d> {
        self.apply(Function::Sqrt)
    }
    /// Absolute value.
    pub fn abs(self) -> Expr<'d> {
        self.apply(Function::Abs)
    }
    /// −1, 0 or 1.
    pub fn sign(self) -> Expr<'d> {
        self.apply(Function::Sign)
    }
    /// The angle of the point (`x`, `self`).
    pub fn atan2(self, x: Expr<'d>) -> Expr<'d> {
        self.apply_with(Function::Atan2, x)
    }
    /// The smaller of the two.
    pub fn min(self, other: Expr<'d>) -> Expr<'d> {
        self.apply_with(Function::Min, other)
    }
    /// The larger of the two.
    pub fn max(self, other: Expr<'d>) -> Expr<'d> {
        self.apply_with(Function::Max, other)
    }
    /// A power with any exponent.
    pub fn pow(self, exponent: Expr<'d>) -> Expr<'d> {
        self.apply_with(Function::Pow, exponent)
    }
    /// An integer power.
    pub fn powi(self, exponent: i32) -> Expr<'d> {
        self.with(|arena| arena.product(&[(self.id(), exponent)]))
    }
    /// `self²`.
    pub fn square(self) -> Expr<'d> {
        self.powi(2)
    }

    fn apply(self, function: Function) -> Expr<'d> {
        self.with(|arena| arena.function(function, &[self.id()]))
    }

    fn apply_with(self, function: Function, second: Expr<'d>) -> Expr<'d> {
        self.with(|arena| arena.function(function, &[self.id(), second.id()]))
    }
}

/// The node and, unless it is very long, its text.
impl fmt::Debug for Expr<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.size() {
            0..200 => write!(f, "#{}: {self}", self.id().index()),
            size => write!(
                f,
                "#{}: {size} symbols, numbers and operations",
                self.id().index()
            ),
        }
    }
}

impl<'d> Add for Expr<'d> {
    type Output = Expr<'d>;
    fn add(self, other: Expr<'d>) -> Expr<'d> {
        self.with(|arena| arena.sum(&[(self.id(), Rational::ONE), (other.id(), Rational::ONE)]))
    }
}

impl<'d> Sub for Expr<'d> {
    type Output = Expr<'d>;
    fn sub(self, other: Expr<'d>) -> Expr<'d> {
        self.with(|arena| {
            arena.sum(&[
                (self.id(), Rational::ONE),
                (other.id(), Rational::MINUS_ONE),
            ])
        })
    }
}

impl<'d> Mul for Expr<'d> {
    type Output = Expr<'d>;
    fn mul(self, other: Expr<'d>) -> Expr<'d> {
        self.with(|arena| arena.product(&[(self.id(), 1), (other.id(), 1)]))
    }
}

impl<'d> Div for Expr<'d> {
    type Output = Expr<'d>;
    fn div(self, other: Expr<'d>) -> Expr<'d> {
        self.with(|arena| arena.product(&[(self.id(), 1), (other.id(), -1)]))
    }
}

impl<'d> Neg for Expr<'d> {
    type Output = Expr<'d>;
    fn neg(self) -> Expr<'d> {
        self.with(|arena| arena.scaled(Rational::MINUS_ONE, self.id()))
    }
}

// Operators with constants on either side, by the operators above.
macro_rules! with_constants {
    ($($Operator:ident $operator:ident),*) => { $(
        impl<'d> $Operator<Rational> for Expr<'d> {
            type Output = Expr<'d>;
            fn $operator(self, other: Rational) -> Expr<'d> {
                self.$operator(self.dag().constant(other))
            }
        }
        impl<'d> $Operator<i64> for Expr<'d> {
            type Output = Expr<'d>;
            fn $operator(self, other: i64) -> Expr<'d> {
                self.$operator(self.dag().int(other))
            }
        }
        impl<'d> $Operator<Expr<'d>> for Rational {
            type Output = Expr<'d>;
            fn $operator(self, other: Expr<'d>) -> Expr<'d> {
                other.dag().constant(self).$operator(other)
            }
        }
        impl<'d> $Operator<Expr<'d>> for i64 {
            type Output = Expr<'d>;
            fn $operator(self, other: Expr<'d>) -> Expr<'d> {
                other.dag().int(self).$operator(other)
            }
        }
    )* };
}
with_constants!(Add add, Sub sub, Mul mul, Div div);
