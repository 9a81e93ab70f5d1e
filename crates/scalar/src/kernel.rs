//! Pieces of generated code as values, so that whoever knows the processor decides how they run.
//!
//! A Rust function uses instructions beyond the oldest processor's only if it says so, or is inlined into one that does. So
//! generated arithmetic is always inlined, and handed as a value to a function that says so.

use crate::Scalar;

/// A computation on numbers that are kept as `T`, for any arithmetic on them.
pub trait Kernel<T: Copy> {
    /// Its result.
    type Output;

    /// Computes it in registers of type `N`. Implementations are `#[inline(always)]`.
    fn run<N: Scalar<Stored = T>>(self) -> Self::Output;
}

/// A part of a long function, which runs by itself: see [`Scalar::call`].
pub trait Piece {
    /// Its result.
    type Output;

    /// Runs it. Implementations are `#[inline(always)]`.
    fn run(self) -> Self::Output;
}
