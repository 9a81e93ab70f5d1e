//! Several numbers side by side, as they are kept in memory, and the arithmetic on them for every
//! processor.

use core::array::from_fn;
use core::ops::{Add, Div, Index, IndexMut, Mul, Neg, Sub};

use crate::Scalar;

/// `N` numbers side by side: the same quantity of `N` states, or of `N` sets of parameters. `N` is
/// 2, 4 or 8.
///
/// This is what is kept in memory: `N` `f64`, one after another, at an address that `malloc` may
/// return. Arithmetic on them goes through [`Number::run`](crate::Number::run), in whatever
/// registers the processor has.
///
/// ```
/// use lagrangian_native::Lanes;
/// let angles = Lanes([0.1, 0.2, 0.3, 0.4]);
/// assert_eq!(angles[2], 0.3);
/// assert_eq!(Lanes::<4>::splat(9.81), Lanes([9.81; 4]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(16))]
pub struct Lanes<const N: usize>(pub [f64; N]);

impl<const N: usize> Lanes<N> {
    /// The same number in every lane.
    #[inline(always)]
    pub const fn splat(x: f64) -> Self {
        Lanes([x; N])
    }
}

impl<const N: usize> Default for Lanes<N> {
    /// Zeros.
    #[inline(always)]
    fn default() -> Self {
        Lanes::splat(0.0)
    }
}

impl<const N: usize> From<[f64; N]> for Lanes<N> {
    #[inline(always)]
    fn from(numbers: [f64; N]) -> Self {
        Lanes(numbers)
    }
}

impl<const N: usize> Index<usize> for Lanes<N> {
    type Output = f64;

    #[inline(always)]
    fn index(&self, lane: usize) -> &f64 {
        &self.0[lane]
    }
}

impl<const N: usize> IndexMut<usize> for Lanes<N> {
    #[inline(always)]
    fn index_mut(&mut self, lane: usize) -> &mut f64 {
        &mut self.0[lane]
    }
}

/// Lanes whose arithmetic is that of `f64`, each by itself: where there is no fused multiply-add,
/// or none is wanted.
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
    #[inline(always)]
    fn guarded(self, bound: Self) -> Option<Self> {
        Some(self.zip(bound, |x, bound| if x > bound { x } else { f64::NAN }))
    }
    /// The first lane's.
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self.0[0]
    }
}
