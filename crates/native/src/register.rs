//! Numbers in registers as scalars: fused multiply-add and polynomial sines, for one or several numbers at once.

use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::circular::Sines;
use crate::vector::{Register, Vector};
use crate::{Piece, Scalar};

impl<V: Vector> fmt::Debug for Register<V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.store().fmt(f)
    }
}

impl<V: Vector> PartialEq for Register<V> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.0.store() == other.0.store()
    }
}

macro_rules! operator {
    ($($trait:ident $method:ident),*) => {$(
        impl<V: Vector> $trait for Register<V> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Register(self.0.$method(other.0))
            }
        }
    )*};
}

operator!(Add add, Sub sub, Mul mul, Div div);

impl<V: Vector> Neg for Register<V> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Register(self.0.xor(V::splat(-0.0)))
    }
}

/// Functions of `f64`, applied to each number separately.
macro_rules! each {
    ($($method:ident($($argument:ident)?)),* $(,)?) => {$(
        #[inline(always)]
        fn $method(self $(, $argument: Self)?) -> Self {
            each!(@ self $method $($argument)?)
        }
    )*};
    (@ $self:ident $method:ident) => {
        Register($self.0.map(Scalar::$method))
    };
    (@ $self:ident $method:ident $argument:ident) => {
        Register($self.0.zip($argument.0, Scalar::$method))
    };
}

/// Operations on two numbers each, as the vector has them.
macro_rules! each_of_two {
    ($($method:ident($($argument:ident),*)),* $(,)?) => {$(
        #[inline(always)]
        fn $method($($argument: [Self; 2]),*) -> [Self; 2] {
            let [first, second] = V::$method($([$argument[0].0, $argument[1].0]),*);
            [Register(first), Register(second)]
        }
    )*};
}

/// 1/n for orders n of series and for products of two successive ones; the first is not a reciprocal. A division by such a number would take as long
/// as the chain of operations that an order of a series waits for.
static RECIPROCALS: [f64; 600] = {
    let mut all = [f64::INFINITY; 600];
    let mut n = 1;
    while n < all.len() {
        all[n] = 1.0 / n as f64;
        n += 1;
    }
    all
};

impl<V: Sines> Scalar for Register<V> {
    type Stored = V::Stored;

    #[inline(always)]
    fn load(stored: V::Stored) -> Self {
        Register(V::load(stored))
    }
    #[inline(always)]
    fn store(self) -> V::Stored {
        self.0.store()
    }

    const ZERO: Self = Register(V::ZERO);
    const ONE: Self = Register(V::ONE);
    const PAIRS_AT_ONCE: usize = V::PAIRS_AT_ONCE;

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Register(V::splat(x))
    }
    #[inline(always)]
    fn from_ratio(numerator: i64, denominator: i64) -> Self {
        Register(V::splat(
            match (numerator, RECIPROCALS.get(denominator as usize)) {
                (1, Some(reciprocal)) => *reciprocal,
                _ => f64::from_ratio(numerator, denominator),
            },
        ))
    }
    /// The reciprocal of `n` in two parts: `high`, and what `high` lacks.
    #[inline(always)]
    fn divisor(n: i64) -> [Self; 2] {
        let high = match RECIPROCALS.get(n as usize) {
            Some(reciprocal) => *reciprocal,
            None => 1.0 / n as f64,
        };
        let high = V::splat(high);
        let low = high.neg_mul_add(V::splat(n as f64), V::ONE).mul(high);
        [Register(high), Register(low)]
    }
    /// A product with the reciprocal in two parts, in half the time of a division and with the same result: the error before the last rounding is less than
    /// 2⁻¹⁰⁴ of the quotient. A quotient by `n` that is not itself a number of 53 bits differs from every number of 54 bits, where rounding
    /// changes its direction, by at least 2⁻⁵⁴/n of itself.
    #[inline(always)]
    fn over(self, [high, low]: [Self; 2]) -> Self {
        Register(self.0.mul_add(high.0, self.0.mul(low.0)))
    }
    #[inline(always)]
    fn pi() -> Self {
        Register(V::splat(core::f64::consts::PI))
    }

    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        Register(self.0.mul_add(b.0, c.0))
    }
    #[inline(always)]
    fn mul_sub(self, b: Self, c: Self) -> Self {
        Register(self.0.mul_sub(b.0, c.0))
    }
    #[inline(always)]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        Register(self.0.neg_mul_add(b.0, c.0))
    }
    each_of_two!(
        add_each(a, b),
        sub_each(a, b),
        mul_each(a, b),
        div_each(a, b),
        mul_add_each(a, b, c),
        mul_sub_each(a, b, c),
        neg_mul_add_each(a, b, c),
    );

    #[inline(always)]
    fn product_error(self, b: Self) -> Self {
        Register(self.0.mul_sub(b.0, self.0.mul(b.0)))
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let [pair] = Self::sin_cos_all([self]);
        pair
    }
    #[inline(always)]
    fn sin_cos_all<const K: usize>(angles: [Self; K]) -> [(Self, Self); K] {
        V::sin_cos_all(angles)
    }
    #[inline(always)]
    fn sin_cos_all_near<const K: usize>(angles: [Self; K]) -> ([(Self, Self); K], bool) {
        V::sin_cos_all_near(angles)
    }
    #[inline(always)]
    fn store_all<const P: usize>(row: &mut [V::Stored; P], numbers: [V::Stored; P]) {
        V::store_all(row, numbers);
    }
    #[inline(always)]
    fn convolve_all<const P: usize>(a: &[[V::Stored; P]], b: &[[V::Stored; P]]) -> [Self; P] {
        V::convolve_all(a, b)
    }

    each!(
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
        powf(exponent),
    );

    #[inline(always)]
    fn sqrt(self) -> Self {
        Register(self.0.sqrt())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Register(self.0.abs())
    }
    #[inline(always)]
    fn sign(self) -> Self {
        let x = self.0;
        // ±1 where x is not 0, 0 where it is, x where it is NaN.
        let one = V::splat(1.0).xor(x.and(V::splat(-0.0)));
        let defined = V::select(V::splat(0.0).less(x.abs()), one, V::splat(0.0));
        Register(V::select(x.at_most(x), defined, x))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // A NaN operand gives NaN.
        let least = V::select(self.0.less(other.0), self.0, other.0);
        Register(V::select(self.0.at_most(self.0), least, self.0))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        let most = V::select(other.0.less(self.0), self.0, other.0);
        Register(V::select(self.0.at_most(self.0), most, self.0))
    }

    #[inline(always)]
    fn is_finite(self) -> bool {
        V::all(self.0.abs().less(V::splat(f64::INFINITY)))
    }
    #[inline(always)]
    fn exceeds(self, bound: Self) -> bool {
        V::all(bound.0.less(self.0))
    }
    /// The first number.
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self.0.first()
    }

    #[inline(always)]
    fn call<P: Piece>(piece: P) -> P::Output {
        V::call(piece)
    }
}
