//! Numbers along a motion whose velocities are those of frozen coordinates.

use std::ops::{Add, Div, Mul, Neg, Sub};

use lagrangian_scalar::{Dual, Scalar};

/// A value and its rate, eq. (E16): the rate of a sine is `cos α₀ α̇` and its value `sin α₀`, where
/// `α₀` is the angle with the frozen coordinates at 0. Everything else is as in [`Dual`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frozen<S> {
    pub moving: Dual<S>,
    /// The value where the frozen coordinates are 0.
    pub at_zero: S,
}

macro_rules! operators {
    ($($trait:ident $method:ident,)*) => {$(
        impl<S: Scalar> $trait for Frozen<S> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Frozen {
                    moving: self.moving.$method(other.moving),
                    at_zero: self.at_zero.$method(other.at_zero),
                }
            }
        }
    )*};
}

operators!(Add add, Sub sub, Mul mul, Div div,);

impl<S: Scalar> Neg for Frozen<S> {
    type Output = Self;
    fn neg(self) -> Self {
        Frozen {
            moving: -self.moving,
            at_zero: -self.at_zero,
        }
    }
}

macro_rules! functions {
    ($($method:ident)*) => {$(
        fn $method(self) -> Self {
            Frozen {
                moving: self.moving.$method(),
                at_zero: self.at_zero.$method(),
            }
        }
    )*};
}

macro_rules! functions_of_two {
    ($($method:ident)*) => {$(
        fn $method(self, other: Self) -> Self {
            Frozen {
                moving: self.moving.$method(other.moving),
                at_zero: self.at_zero.$method(other.at_zero),
            }
        }
    )*};
}

impl<S: Scalar> Scalar for Frozen<S> {
    type Stored = Self;

    fn load(stored: Self) -> Self {
        stored
    }
    fn store(self) -> Self {
        self
    }

    const ZERO: Self = Frozen {
        moving: Dual::<S>::ZERO,
        at_zero: S::ZERO,
    };
    const ONE: Self = Frozen {
        moving: Dual::<S>::ONE,
        at_zero: S::ONE,
    };

    fn from_f64(x: f64) -> Self {
        Frozen {
            moving: Dual::from_f64(x),
            at_zero: S::from_f64(x),
        }
    }
    fn from_ratio(numerator: i64, denominator: i64) -> Self {
        Frozen {
            moving: Dual::from_ratio(numerator, denominator),
            at_zero: S::from_ratio(numerator, denominator),
        }
    }
    fn pi() -> Self {
        Frozen {
            moving: Dual::pi(),
            at_zero: S::pi(),
        }
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.at_zero.sin_cos();
        let rate = self.moving.derivative;
        let with = |value, slope: S| Frozen {
            moving: Dual {
                value,
                derivative: slope * rate,
            },
            at_zero: value,
        };
        (with(sin, cos), with(cos, -sin))
    }

    functions!(asin acos atan sinh cosh tanh exp ln sqrt abs sign);
    functions_of_two!(atan2 powf min max);

    fn powi(self, exponent: i32) -> Self {
        Frozen {
            moving: self.moving.powi(exponent),
            at_zero: self.at_zero.powi(exponent),
        }
    }

    fn is_finite(self) -> bool {
        self.moving.is_finite()
    }
    fn exceeds(self, bound: Self) -> bool {
        self.moving.exceeds(bound.moving)
    }
    fn to_f64(self) -> f64 {
        self.moving.to_f64()
    }
}
