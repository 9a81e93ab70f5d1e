//! What emitted Taylor series call.

pub use lagrangian_scalar::series::{Vanished, apply, factor, keep, solve, sweep};

use crate::system::SERIES_ROWS;
use crate::{Scalar, Singular};

/// The most coefficients that emitted code computes of each coordinate; [`TAYLOR`](crate::TAYLOR) asks for 22.
pub const ROWS: usize = SERIES_ROWS;

/// What a step by an emitted series costs, in evaluations of the accelerations within a step of `dop853`, with 12 and with 20 coefficients of
/// the accelerations, of a machine with so many coordinates.
///
/// Through what was measured (`docs/benchmarks.md`, Taylor series): 0.40 µs to 41 ns of the double pendulum, 1.35 µs to 64 ns of the crusher. With
/// 12 coefficients it is two thirds of that.
pub const fn cost(coordinates: usize) -> [f64; 2] {
    let fine = 6.7 + 1.6 * coordinates as f64;
    [0.67 * fine, fine]
}

/// Coefficients of `P` lists side by side, order by order. They begin where a line of the processor's cache does: a wide register of them is
/// read in one piece.
#[repr(align(64))]
pub struct Pack<S, const P: usize>(pub [[S; P]; ROWS]);

impl<S: Copy + Default, const P: usize> Default for Pack<S, P> {
    fn default() -> Self {
        Pack([[S::default(); P]; ROWS])
    }
}

/// The error of a pivot that vanished among these unknowns, of a machine with so many coordinates.
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
