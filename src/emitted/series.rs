//! Functions that emitted Taylor series call.

pub use lagrangian_scalar::series::{Vanished, apply, factor, keep, solve, sweep};

use crate::system::SERIES_ROWS;
use crate::{Scalar, Singular};

/// The largest number of coefficients of each coordinate that emitted code computes; [`TAYLOR`](crate::TAYLOR) needs 22.
pub const ROWS: usize = SERIES_ROWS;

/// The cost of a step by an emitted series, in evaluations of the accelerations in a step of `dop853`, with 12 and with 20 coefficients of
/// the accelerations, for a machine with this number of coordinates.
///
/// It interpolates measurements (`docs/benchmarks.md`, Taylor series): 0.40 µs to 41 ns for the double pendulum, 1.35 µs to 64 ns for the
/// crusher. With 12 coefficients it is two thirds of that.
pub const fn cost(coordinates: usize) -> [f64; 2] {
    let fine = 6.7 + 1.6 * coordinates as f64;
    [0.67 * fine, fine]
}

/// Coefficients of `P` lists side by side, order by order, aligned to cache lines so that a vector register is loaded in one piece.
#[repr(align(64))]
pub struct Pack<S, const P: usize>(pub [[S; P]; ROWS]);

impl<S: Copy + Default, const P: usize> Default for Pack<S, P> {
    fn default() -> Self {
        Pack([[S::default(); P]; ROWS])
    }
}

/// The error for a pivot that vanished among these unknowns, for a machine with this number of coordinates.
#[cold]
pub fn singular<N: Scalar>(
    vanished: Vanished<N>,
    members: &[usize],
    coordinates: usize,
) -> Singular {
    let Vanished { row, pivot, scale } = vanished;
    let unknown = members.get(row).copied().unwrap_or(row);
    let (pivot, scale) = (pivot.to_f64(), scale.to_f64());
    match unknown.checked_sub(coordinates) {
        Some(constraint) => Singular::constraint(constraint, pivot, scale),
        None => Singular::new(unknown, pivot, scale),
    }
}
