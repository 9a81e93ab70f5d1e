//! Where a state is relative to the constraints of a machine, and the smallest moves onto them, as a list of numbers.
//!
//! With the residuals `g` of the positions and `φ` of the rates, the moves `d` of coordinates and `w` of rates solve
//!
//! ```text
//! M d = Gᵀ μ,  G d = −g,     M w = Gᵀ ν,  G w = −φ
//! ```
//!
//! They are the smallest, in the metric of `M`, that remove the residuals to first order. The compiler writes this list, the proof and the
//! runtime read it; only this module states in which order its numbers are.

use core::ops::Range;

/// The arrangement of the numbers of a projection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ProjectionLayout {
    /// The number of coordinates.
    pub coordinates: usize,
    /// The number of constraints.
    pub constraints: usize,
}

impl ProjectionLayout {
    /// The places of the residuals `g` of the constraints of positions, 0 for those of velocities alone.
    pub const fn positions(self) -> Range<usize> {
        0..self.constraints
    }

    /// The places of the residuals `φ` of the rates.
    pub const fn rates(self) -> Range<usize> {
        after(self.positions(), self.constraints)
    }

    /// The places of the constraint matrix `G`, row by row.
    pub const fn matrix(self) -> Range<usize> {
        after(self.rates(), self.constraints * self.coordinates)
    }

    /// The places of the diagonal of the mass matrix `M`.
    pub const fn inertias(self) -> Range<usize> {
        after(self.matrix(), self.coordinates)
    }

    /// The places of the moves `d` of coordinates.
    pub const fn moves_of_coordinates(self) -> Range<usize> {
        after(self.inertias(), self.coordinates)
    }

    /// The places of the moves `w` of rates.
    pub const fn moves_of_rates(self) -> Range<usize> {
        after(self.moves_of_coordinates(), self.coordinates)
    }

    /// The places of the multipliers `μ` of the moves of coordinates.
    pub const fn multipliers_of_coordinates(self) -> Range<usize> {
        after(self.moves_of_rates(), self.constraints)
    }

    /// The places of the multipliers `ν` of the moves of rates.
    pub const fn multipliers_of_rates(self) -> Range<usize> {
        after(self.multipliers_of_coordinates(), self.constraints)
    }

    /// The places of what the elimination of `G M⁻¹ Gᵀ`, in some order, leaves of each diagonal element.
    pub const fn pivots(self) -> Range<usize> {
        after(self.multipliers_of_rates(), self.constraints)
    }

    /// The places of the diagonal of `G M⁻¹ Gᵀ`.
    pub const fn compliances(self) -> Range<usize> {
        after(self.pivots(), self.constraints)
    }

    /// The number of numbers.
    pub const fn len(self) -> usize {
        self.compliances().end
    }

    /// Whether there are none.
    pub const fn is_empty(self) -> bool {
        self.len() == 0
    }
}

/// So many places behind these.
const fn after(before: Range<usize>, count: usize) -> Range<usize> {
    before.end..before.end + count
}
