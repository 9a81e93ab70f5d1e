//! Functions that emitted Taylor series call.

pub use lagrangian_scalar::series::{Vanished, apply, factor, keep, solve, solved, sweep};

pub use crate::series_memory::SeriesMemory;
use crate::system::SERIES_ROWS;
use crate::{Scalar, Singular};

/// The largest number of coefficients of each coordinate that emitted code computes; [`TAYLOR`](crate::TAYLOR) needs 22.
pub const ROWS: usize = SERIES_ROWS;

/// Marks the rows of coefficients beyond those that emitted code computes as not computed.
#[inline(always)]
pub fn leave_out_late_rows<const N: usize>(coefficients: &mut [[f64; N]]) {
    for row in coefficients.iter_mut().skip(ROWS) {
        *row = [f64::NAN; N];
    }
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
