//! The pivots of an elimination: which of them are too small to divide by.

use crate::{Scalar, Singular};

/// The pivots of a machine's eliminations.
///
/// A pivot holds where it exceeds its tolerance times the diagonal element it was before the elimination. Below, it is nothing
/// but rounding errors.
#[derive(Clone, Copy, Debug)]
pub struct Pivots {
    /// How many coordinates the machine has: the rows behind these are of constraints.
    pub coordinates: usize,
    /// The share of a diagonal element that may be rounding errors.
    pub tolerance: f64,
}

impl Pivots {
    /// Whether a pivot holds, in all lanes; one that is no number does not.
    #[inline(always)]
    pub fn hold<N: Scalar>(self, pivot: N, diagonal: N) -> bool {
        pivot.exceeds(N::from_f64(self.tolerance) * diagonal)
    }

    /// The first of these pivots that does not hold. Each stands behind its row and before its diagonal element.
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

    /// An error where one of these pivots does not hold.
    ///
    /// # Errors
    /// The first one.
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
