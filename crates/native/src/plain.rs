//! Lanes for processors without fused multiply-add, or for builds that do not use it.

use core::array::from_fn;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::{Lanes, Scalar};

/// Lanes with the arithmetic of `f64` for each number separately.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plain<const N: usize>([f64; N]);

impl<const N: usize> Plain<N> {
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Plain(from_fn(|i| f(self.0[i])))
    }

    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Plain(from_fn(|i| f(self.0[i], other.0[i])))
    }

    #[inline(always)]
    fn all(self, other: Self, f: impl Fn(f64, f64) -> bool) -> bool {
        (0..N).all(|i| f(self.0[i], other.0[i]))
    }
}

macro_rules! operator {
    ($($trait:ident $method:ident $operator:tt),*) => {$(
        impl<const N: usize> $trait for Plain<N> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.zip(other, |a, b| a $operator b)
            }
        }
    )*};
}

operator!(Add add +, Sub sub -, Mul mul *, Div div /);

impl<const N: usize> Neg for Plain<N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|x| -x)
    }
}

macro_rules! each {
    ($($method:ident($($argument:ident)?)),* $(,)?) => {$(
        #[inline(always)]
        fn $method(self $(, $argument: Self)?) -> Self {
            each!(@ self $method $($argument)?)
        }
    )*};
    (@ $self:ident $method:ident) => { $self.map(Scalar::$method) };
    (@ $self:ident $method:ident $argument:ident) => { $self.zip($argument, Scalar::$method) };
}

impl<const N: usize> Scalar for Plain<N> {
    type Stored = Lanes<N>;

    #[inline(always)]
    fn load(stored: Lanes<N>) -> Self {
        Plain(stored.0)
    }
    #[inline(always)]
    fn store(self) -> Lanes<N> {
        Lanes(self.0)
    }

    const ZERO: Self = Plain([0.0; N]);
    const ONE: Self = Plain([1.0; N]);

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Plain([x; N])
    }
    #[inline(always)]
    fn from_ratio(numerator: i64, denominator: i64) -> Self {
        Plain([f64::from_ratio(numerator, denominator); N])
    }
    #[inline(always)]
    fn pi() -> Self {
        Plain([core::f64::consts::PI; N])
    }

    each!(
        product_error(b),
        tan(),
        asin(),
        acos(),
        atan(),
        atan2(x),
        sinh(),
        cosh(),
        tanh(),
        exp(),
        ln(),
        sqrt(),
        powf(exponent),
        abs(),
        sign(),
        min(other),
        max(other),
    );

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let pairs = self.0.map(Scalar::sin_cos);
        (Plain(pairs.map(|p| p.0)), Plain(pairs.map(|p| p.1)))
    }

    #[inline(always)]
    fn is_finite(self) -> bool {
        self.all(self, |x, _| x.is_finite())
    }
    #[inline(always)]
    fn exceeds(self, bound: Self) -> bool {
        self.all(bound, |x, bound| x > bound)
    }
    /// The first lane's.
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self.0[0]
    }
}
