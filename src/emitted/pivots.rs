//! Tests whether the pivots of an elimination are large enough to divide by.

use crate::{Scalar, Singular};

/// The pivots of a machine's eliminations.
///
/// A pivot holds if it exceeds its tolerance times the diagonal element that it was before the elimination. A smaller one
/// consists of rounding errors.
#[derive(Clone, Copy, Debug)]
pub struct Pivots {
    /// The number of coordinates of the machine: further rows belong to constraints.
    pub coordinates: usize,
    /// The fraction of a diagonal element that may be rounding errors.
    pub tolerance: f64,
}

/// A pivot must exceed this multiple of n·2⁻⁵² times its diagonal element, in an elimination of n rows: the compiler derives it
/// (`PIVOT_MARGIN` of `lagrangian-program`).
const MARGIN: f64 = 4.0;

impl Pivots {
    /// The pivots of eliminations with this number of rows, for a machine with this number of coordinates.
    pub const fn new(coordinates: usize, rows: usize) -> Pivots {
        Pivots {
            coordinates,
            tolerance: MARGIN * rows as f64 * f64::EPSILON,
        }
    }

    /// Whether a pivot holds in all lanes; NaN does not.
    #[inline(always)]
    pub fn hold<N: Scalar>(self, pivot: N, diagonal: N) -> bool {
        pivot.exceeds(N::from_f64(self.tolerance) * diagonal)
    }

    /// The first of these pivots that does not hold. Each is given with its row before it and its diagonal element after it.
    #[inline(always)]
    pub fn vanished<N: Scalar, const K: usize>(
        self,
        pivots: [(usize, N, N); K],
    ) -> Option<Singular> {
        for (row, pivot, diagonal) in pivots {
            if !self.hold(pivot, diagonal) {
                return Some(self.singular(row, pivot, diagonal));
            }
        }
        None
    }

    /// Checks these pivots.
    ///
    /// # Errors
    /// The first pivot that does not hold.
    #[inline(always)]
    pub fn check<N: Scalar, const K: usize>(
        self,
        pivots: [(usize, N, N); K],
    ) -> Result<(), Singular> {
        match self.vanished(pivots) {
            Some(singular) => Err(singular),
            None => Ok(()),
        }
    }

    #[cold]
    fn singular<N: Scalar>(self, row: usize, pivot: N, diagonal: N) -> Singular {
        let (pivot, diagonal) = (pivot.to_f64(), diagonal.to_f64());
        match row.checked_sub(self.coordinates) {
            Some(constraint) => Singular::constraint(constraint, pivot, diagonal),
            None => Singular::new(row, pivot, diagonal),
        }
    }
}

#[cfg(all(test, feature = "interpreter"))]
mod tests {
    use super::Pivots;

    #[test]
    fn tolerances_are_those_of_the_compiler() {
        for rows in [1, 2, 7, 13, 40] {
            let tolerance = lagrangian_program::solve::pivot_tolerance(rows);
            assert_eq!(Pivots::new(3, rows).tolerance, tolerance);
        }
    }
}
