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

impl Pivots {
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
