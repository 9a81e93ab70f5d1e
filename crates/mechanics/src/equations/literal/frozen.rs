//! Numbers along a motion whose velocities are those of frozen coordinates.

use std::ops::{Add, Div, Mul, Neg, Sub};

use lagrangian_scalar::{Dual, Scalar};

/// A value and its rate, eq. (E16): the rate of a sine is `cos α₀ α̇` and its value `sin α₀`, where
/// `α₀` is the angle with the frozen coordinates at 0. Everything else is as in [`Dual`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frozen<S> {
    pub moving: Dual<S>,
    /// The value where the frozen coordinates are 0.
    pub still: S,
}

macro_rules! operators {
    ($($trait:ident $method:ident,)*) => {$(
        impl<S: Scalar> $trait for Frozen<S> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Frozen {
                    moving: self.moving.$method(other.moving),
                    still: self.still.$method(other.still),
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
            still: -self.still,
        }
    }
}

macro_rules! functions {
    ($($method:ident)*) => {$(
        fn $method(self) -> Self {
            Frozen {
                moving: self.moving.$method(),
                still: self.still.$method(),
            }
        }
    )*};
}

macro_rules! functions_of_two {
    ($($method:ident)*) => {$(
        fn $method(self, other: Self) -> Self {
            Frozen {
                moving: self.moving.$method(other.moving),
                still: self.still.$method(other.still),
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
        still: S::ZERO,
    };
    const ONE: Self = Frozen {
        moving: Dual::<S>::ONE,
        still: S::ONE,
    };

    fn from_f64(x: f64) -> Self {
        Frozen {
            moving: Dual::from_f64(x),
            still: S::from_f64(x),
        }
    }
    fn from_ratio(numerator: i64, denominator: i64) -> Self {
        Frozen {
            moving: Dual::from_ratio(numerator, denominator),
            still: S::from_ratio(numerator, denominator),
        }
    }
    fn pi() -> Self {
        Frozen {
            moving: Dual::pi(),
            still: S::pi(),
        }
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.still.sin_cos();
        let rate = self.moving.derivative;
        let with = |value, slope: S| Frozen {
            moving: Dual {
                value,
                derivative: slope * rate,
            },
            still: value,
        };
        (with(sin, cos), with(cos, -sin))
    }

    functions!(asin acos atan sinh cosh tanh exp ln sqrt abs sign);
    functions_of_two!(atan2 powf min max);

    fn powi(self, exponent: i32) -> Self {
        Frozen {
            moving: self.moving.powi(exponent),
            still: self.still.powi(exponent),
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
