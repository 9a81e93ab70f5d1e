//! Arithmetic at the speed of the processor.
//!
//! Generated code is written once, for any [`Scalar`]. This crate provides fast scalars and chooses among them at
//! run time: [`Number::run`] takes a computation on numbers that are stored as `f64`, or as [`Lanes`] of them, and
//! executes it with the best instructions of the processor.
//!
//! | processor | `f64` | `Lanes<2>` | `Lanes<4>` | `Lanes<8>` |
//! | --- | --- | --- | --- | --- |
//! | x86-64 with AVX-512 | fused | 128 bits | 256 bits, 32 registers | 512 bits |
//! | x86-64 with AVX2 and FMA | fused | 128 bits | 256 bits | twice 256 bits |
//! | AArch64 | fused | one by one | one by one | one by one |
//! | others, or `strict-libm` | plain | one by one | one by one | one by one |
//!
//! All rows but the last give the same bits: fused multiply-add where generated code asks for it, and the sine and
//! cosine of [this crate](self#sine-and-cosine). The last row's bits are those of separate multiplications and
//! additions and of `libm`, the same on every machine. In every row a lane's result is that of `f64`, whatever the
//! other lanes hold.
//!
//! # Sine and cosine
//!
//! Within 0.96 units in the last place for |x| ≤ 100 000; beyond, those of `libm`. `src/sincos.rs` contains the proof.
//!
//! # Unsafe code
//!
//! Besides `lagrangian-jit` this is the only crate of the project with unsafe code: instructions that only some
//! processors have cannot be used without it. The register types are not public; a kernel receives them only after the
//! processor has been checked.
//!
//! # Features
//!
//! * `std` (default): detects the features of the processor at run time. Without it only the target features of the
//!   build count, and AArch64 is among the others, as `core` has no fused multiply-add.
//! * `strict-libm`: the last row everywhere.

#![cfg_attr(not(feature = "std"), no_std)]

#[cfg(any(feature = "std", all(target_arch = "x86_64", target_feature = "fma")))]
mod circular;
mod fast_function;
mod lanes;
#[cfg(not(all(target_arch = "aarch64", feature = "std", not(feature = "strict-libm"))))]
mod plain;
#[cfg(any(feature = "std", all(target_arch = "x86_64", target_feature = "fma")))]
mod register;
#[cfg(any(feature = "std", all(target_arch = "x86_64", target_feature = "fma")))]
mod sincos;
#[cfg(any(feature = "std", all(target_arch = "x86_64", target_feature = "fma")))]
mod vector;
#[cfg(all(
    target_arch = "x86_64",
    any(feature = "std", all(target_feature = "avx2", target_feature = "fma")),
    not(feature = "strict-libm")
))]
mod x86;

#[cfg(feature = "text")]
#[doc(hidden)]
pub mod files;
#[cfg(all(
    test,
    target_arch = "x86_64",
    feature = "std",
    not(feature = "strict-libm")
))]
mod tests;
#[doc(hidden)]
pub mod text;

#[doc(hidden)]
pub use lagrangian_scalar as scalar;
pub use lanes::Lanes;

use lagrangian_scalar::{DoubleDouble, Dual, Interval, Kernel, Residue, Scalar};
#[cfg(any(feature = "std", all(target_arch = "x86_64", target_feature = "fma")))]
use lagrangian_scalar::{Piece, series};

/// An `f64` with fused multiply-add and the sine and cosine of this crate, on every machine: an instruction
/// where the build's target features include it, correct but slow elsewhere. [`Number::run`] gives the same
/// bits at full speed.
///
/// ```
/// use lagrangian_native::Fused;
/// use lagrangian_scalar::Scalar;
/// let x = Fused::load(1.0 + f64::EPSILON);
/// let one_more = x.mul_sub(x, Fused::load(1.0 + 2.0 * f64::EPSILON));
/// assert_eq!(one_more.store(), f64::EPSILON * f64::EPSILON); // what a rounded square has lost
/// ```
#[cfg(any(feature = "std", all(target_arch = "x86_64", target_feature = "fma")))]
pub type Fused = vector::Register<f64>;

/// A number on which machines are evaluated, with the choice of its arithmetic.
pub trait Number: Copy {
    /// Runs a computation in the fastest available arithmetic for such numbers.
    fn run<K: Kernel<Self>>(kernel: K) -> K::Output;

    /// Runs a computation that may fail and stores its result in place.
    ///
    /// Because of their target features, the functions between the arithmetic and the caller are not inlined. A
    /// returned value would go through memory and be copied in pieces of a different size than it was stored in; the
    /// resulting store-forwarding stalls take several times as long as an instruction, a good part of the evaluation of
    /// a small machine.
    ///
    /// # Errors
    /// The errors of the computation; `result` is then left unchanged.
    #[inline(always)]
    fn run_in_place<R, E, K>(kernel: K, result: &mut R) -> Result<(), E>
    where
        K: Kernel<Self, Output = Result<R, E>>,
    {
        let mut error = None;
        let in_place = InPlace {
            kernel,
            result,
            error: &mut error,
        };
        Self::run(in_place);
        match error {
            None => Ok(()),
            Some(error) => Err(error),
        }
    }
}

/// A kernel with the destination of its result.
struct InPlace<'a, K, R, E> {
    kernel: K,
    result: &'a mut R,
    error: &'a mut Option<E>,
}

impl<T: Copy, R, E, K: Kernel<T, Output = Result<R, E>>> Kernel<T> for InPlace<'_, K, R, E> {
    type Output = ();

    #[inline(always)]
    fn run<N: Scalar<Stored = T>>(self) {
        match self.kernel.run::<N>() {
            Ok(result) => *self.result = result,
            Err(error) => *self.error = Some(error),
        }
    }
}

macro_rules! fastest {
    ($($stored:ty: $($native:ident),* else $fused:ty, $plain:ty;)*) => {$(
        impl Number for $stored {
            #[inline]
            fn run<K: Kernel<Self>>(kernel: K) -> K::Output {
                $(
                    #[cfg(all(
                        target_arch = "x86_64",
                        any(feature = "std", all(target_feature = "avx2", target_feature = "fma")),
                        not(feature = "strict-libm")
                    ))]
                    let kernel = match x86::run::<x86::$native, K>(kernel) {
                        Ok(output) => return output,
                        Err(kernel) => kernel,
                    };
                )*
                #[cfg(all(
                    target_arch = "aarch64",
                    feature = "std",
                    not(feature = "strict-libm")
                ))]
                return kernel.run::<vector::Register<$fused>>();
                #[cfg(not(all(
                    target_arch = "aarch64",
                    feature = "std",
                    not(feature = "strict-libm")
                )))]
                return plainly::<$plain, K>(kernel);
            }
        }
    )*};
}

/// Runs a kernel with instructions that any processor has. Not inlined, so that a call of [`Number::run`] is one
/// test and a jump.
#[cfg(not(all(target_arch = "aarch64", feature = "std", not(feature = "strict-libm"))))]
#[inline(never)]
fn plainly<N: Scalar, K: Kernel<N::Stored>>(kernel: K) -> K::Output {
    kernel.run::<N>()
}

fastest! {
    f64: One else f64, f64;
    Lanes<2>: Two else [f64; 2], plain::Plain<2>;
    Lanes<4>: FourOfMany, Four else [f64; 4], plain::Plain<4>;
    Lanes<8>: Eight, TwiceFour else [f64; 8], plain::Plain<8>;
}

macro_rules! plain {
    ($($number:ty),*) => {$(
        impl Number for $number {
            #[inline]
            fn run<K: Kernel<Self>>(kernel: K) -> K::Output {
                kernel.run::<Self>()
            }
        }
    )*};
}

plain!(f32, DoubleDouble, Interval, Residue);

impl<S: Scalar> Number for Dual<S> {
    #[inline]
    fn run<K: Kernel<Self>>(kernel: K) -> K::Output {
        kernel.run::<Self>()
    }
}
