//! Equations of motion that cannot be solved.

use core::fmt::{self, Display};

#[cfg(doc)]
use crate::System;

/// The equations of motion cannot be solved for the accelerations.
///
/// If elimination stopped at a coordinate, some motion of the machine meets no inertia. That happens in poses where coordinates are
/// degenerate (the angle of polar coordinates at radius 0), and in machines with a coordinate that moves no mass. If it stopped at a
/// constraint, that constraint depends on those before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Singular {
    /// Where elimination stopped.
    pub at: Pivot,
    /// The pivot relative to the diagonal element that it came from; 0 if the pivot or the element is 0, and not a number if they have no finite
    /// value, as where numbers overflow. At a contact, 0 if no motion
    /// satisfies its law of friction, and infinite if several do. 0 if no row is the cause.
    pub ratio: f64,
}

/// A row of the equations of motion `M a = f + Gᵀ λ`, `G a = γ`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Pivot {
    /// The row of the coordinate with this index.
    Coordinate(usize),
    /// The row of the constraint with this index.
    Constraint(usize),
    /// The row of the contact with this index: the law of friction has no solution, or several.
    Contact(usize),
    /// No row: the machine provides no workspace for its contacts ([`System::with_workspace`]).
    NoWorkspace,
    /// No row: accelerations that involve the contact with this index are
    /// not differentiated, since a sticking contact has no linearization.
    NotDifferentiated(usize),
}

impl Singular {
    /// Elimination stopped at a coordinate with this pivot, which came from this diagonal element.
    #[cold]
    pub fn new(coordinate: usize, pivot: f64, diagonal: f64) -> Self {
        Self::at(Pivot::Coordinate(coordinate), pivot, diagonal)
    }

    /// Elimination stopped at a constraint with this pivot, which came from this diagonal element.
    #[cold]
    pub fn constraint(constraint: usize, pivot: f64, diagonal: f64) -> Self {
        Self::at(Pivot::Constraint(constraint), pivot, diagonal)
    }

    fn at(at: Pivot, pivot: f64, diagonal: f64) -> Self {
        // A diagonal element of 0 has a pivot of 0, and the ratio 0/0 is reported as 0.
        let ratio = if pivot == 0.0 { 0.0 } else { pivot / diagonal };
        Self { at, ratio }
    }
}

impl Display for Singular {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.at {
            Pivot::Coordinate(index) if self.ratio.is_nan() => write!(
                f,
                "the mass matrix has no finite value in the row of coordinate number {}: numbers overflow, or a formula is undefined there",
                index + 1
            ),
            Pivot::Constraint(index) if self.ratio.is_nan() => write!(
                f,
                "G M⁻¹ Gᵀ has no finite value in the row of constraint number {}: numbers overflow, or a formula is undefined there",
                index + 1
            ),
            Pivot::Coordinate(index) => write!(
                f,
                "the mass matrix cannot be inverted: at coordinate number {} the pivot is {:.1e} of the element on the diagonal",
                index + 1,
                self.ratio
            ),
            Pivot::Constraint(index) => write!(
                f,
                "constraint number {} depends on others: the pivot is {:.1e} of its element on the diagonal of G M⁻¹ Gᵀ",
                index + 1,
                self.ratio
            ),
            Pivot::Contact(index) => {
                let count = if self.ratio == 0.0 {
                    "no"
                } else {
                    "more than one"
                };
                write!(
                    f,
                    "{count} motion satisfies the friction law of contact number {}",
                    index + 1
                )
            }
            Pivot::NoWorkspace => write!(f, "the machine provides no workspace for its contacts"),
            Pivot::NotDifferentiated(index) => write!(
                f,
                "the accelerations cannot be differentiated, because contact number {} may stick or slide",
                index + 1
            ),
        }
    }
}

impl core::error::Error for Singular {}
