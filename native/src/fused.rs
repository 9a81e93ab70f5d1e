//! `f64` with fused multiply-add.

use core::ops::{Add, Div, Mul, Neg, Sub};

use lagrangian_scalar::{Kernel, Piece, Scalar};

/// An `f64` in a register of a processor with fused multiply-add: [`Scalar::mul_add`] rounds once.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Fused(pub f64);

/// Runs a kernel with fused multiply-add where the processor has it.
#[inline]
pub(crate) fn run<K: Kernel<f64>>(kernel: K) -> K::Output {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    if has_fma() {
        // SAFETY: the processor has the instructions.
        return unsafe { run_with_fma(kernel) };
    }
    kernel.run::<f64>()
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[inline(always)]
fn has_fma() -> bool {
    std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma")
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx2,fma")]
unsafe fn run_with_fma<K: Kernel<f64>>(kernel: K) -> K::Output {
    kernel.run::<Fused>()
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[inline(never)]
#[target_feature(enable = "avx2,fma")]
unsafe fn call_with_fma<P: Piece>(piece: P) -> P::Output {
    piece.run()
}

macro_rules! operator {
    ($($trait:ident $method:ident $operator:tt),*) => {$(
        impl $trait for Fused {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Fused(self.0 $operator other.0)
            }
        }
    )*};
}

operator!(Add add +, Sub sub -, Mul mul *, Div div /);

impl Neg for Fused {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Fused(-self.0)
    }
}

macro_rules! as_f64 {
    ($($method:ident($($argument:ident),*)),* $(,)?) => {$(
        #[inline(always)]
        fn $method(self $(, $argument: Self)*) -> Self {
            Fused(Scalar::$method(self.0 $(, $argument.0)*))
        }
    )*};
}

impl Scalar for Fused {
    type Stored = f64;

    #[inline(always)]
    fn load(stored: f64) -> Self {
        Fused(stored)
    }
    #[inline(always)]
    fn store(self) -> f64 {
        self.0
    }

    const ZERO: Self = Fused(0.0);
    const ONE: Self = Fused(1.0);

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Fused(x)
    }
    #[inline(always)]
    fn from_ratio(numerator: i64, denominator: i64) -> Self {
        Fused(f64::from_ratio(numerator, denominator))
    }
    #[inline(always)]
    fn pi() -> Self {
        Fused(core::f64::consts::PI)
    }

    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        Fused(self.0.mul_add(b.0, c.0))
    }
    #[inline(always)]
    fn mul_sub(self, b: Self, c: Self) -> Self {
        Fused(self.0.mul_add(b.0, -c.0))
    }
    #[inline(always)]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        Fused((-self.0).mul_add(b.0, c.0))
    }
    #[inline(always)]
    fn product_error(self, b: Self) -> Self {
        Fused(self.0.mul_add(b.0, -(self.0 * b.0)))
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.0.sin_cos();
        (Fused(sin), Fused(cos))
    }

    as_f64!(
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
    fn is_finite(self) -> bool {
        self.0.is_finite()
    }
    #[inline(always)]
    fn exceeds(self, bound: Self) -> bool {
        self.0 > bound.0
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self.0
    }

    #[inline(always)]
    fn call<P: Piece>(piece: P) -> P::Output {
        #[cfg(all(feature = "std", target_arch = "x86_64"))]
        if has_fma() {
            // SAFETY: the processor has the instructions.
            return unsafe { call_with_fma(piece) };
        }
        piece.run()
    }
}
