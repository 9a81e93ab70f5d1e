//! Pieces of generated code as values, so that the caller that knows the processor decides how they run.
//!
//! A Rust function uses newer instructions only if it declares so, or if it is inlined into a function that does. So
//! generated arithmetic is always inlined, and is passed as a value to a function that declares the instructions.

use crate::Scalar;

/// A computation on numbers that are stored as `T`, for any arithmetic on them.
pub trait Kernel<T: Copy> {
    /// Its result.
    type Output;

    /// Computes it in registers of type `N`. Implementations are `#[inline(always)]`.
    fn run<N: Scalar<Stored = T>>(self) -> Self::Output;
}

/// A part of a long function that runs as a function of its own: see [`Scalar::call`].
pub trait Piece {
    /// Its result.
    type Output;

    /// Runs it. Implementations are `#[inline(always)]`.
    fn run(self) -> Self::Output;
}
