//! Arithmetic at the speed of the processor.
//!
//! Generated code is written once, for any [`Scalar`]. This crate has the scalars that make it fast, and chooses among them
//! when a machine runs: [`Number::run`] takes a computation on numbers that are kept as `f64`, and does it with whatever
//! instructions the processor has.
//!
//! It is the only crate of the project with unsafe code.

#![cfg_attr(not(feature = "std"), no_std)]

mod fused;

pub use fused::Fused;

use lagrangian_scalar::{DoubleDouble, Dual, Interval, Kernel, Residue, Scalar};

/// A number that machines are evaluated on, and the arithmetic that is used for it.
pub trait Number: Copy {
    /// Runs a computation in the fastest arithmetic that there is for such numbers here.
    fn run<K: Kernel<Self>>(kernel: K) -> K::Output;
}

impl Number for f64 {
    #[inline]
    fn run<K: Kernel<f64>>(kernel: K) -> K::Output {
        fused::run(kernel)
    }
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
