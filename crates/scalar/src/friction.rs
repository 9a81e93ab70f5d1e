//! The response of a machine to the friction forces of its guided contacts, as a list of numbers.
//!
//! Everything is linear in the friction forces `F`: `x = x₀ + Σ Fₖ xₖ`, where `x` are the accelerations `a`, the multipliers
//! `λ` of constraints, the slip rate `dw/dt` of each contact and its normal reaction `N`. The compiler writes this list, the
//! proof and the runtime read it; only this module states in which order its numbers are.

use core::ops::Range;

/// The arrangement of a response to friction forces.
///
/// The first part of the list is `x₀`, the values without friction; one part for each friction force follows, the effect `xₖ` of a
/// unit of it. A part holds the accelerations, the multipliers, the slip rates and the components of the normal reaction of each
/// contact. All parts are followed by `μ` of each contact and `μ₀` of each. In space a direction for each contact comes last, from
/// which the pressing component of `N` follows: the tangent of a curve, along which nothing presses, or the normal of a surface,
/// along which everything presses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrictionLayout {
    /// The number of coordinates.
    pub coordinates: usize,
    /// The number of constraints.
    pub constraints: usize,
    /// The number of contacts.
    pub contacts: usize,
    /// The number of components of a normal reaction.
    pub axes: usize,
}

/// A part of a response, as lists: without friction, by a unit of a friction force, or with all friction forces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrictionPart<L> {
    /// The accelerations `a`.
    pub accelerations: L,
    /// The multipliers `λ` of the constraints.
    pub multipliers: L,
    /// The slip rates `dw/dt` of the contacts.
    pub slip_rates: L,
    /// The components of the normal reactions `N`, contact after contact.
    pub normals: L,
}

impl<L: IntoIterator> FrictionPart<L> {
    /// The numbers in the order of the list.
    pub fn in_order(self) -> impl Iterator<Item = L::Item> {
        (self.accelerations.into_iter())
            .chain(self.multipliers)
            .chain(self.slip_rates)
            .chain(self.normals)
    }
}

impl FrictionLayout {
    /// The length of a part.
    pub const fn part(self) -> usize {
        self.normal(self.contacts).start
    }

    /// The number of numbers.
    pub const fn len(self) -> usize {
        self.direction(self.contacts).start
    }

    /// Whether there are none.
    pub const fn is_empty(self) -> bool {
        self.len() == 0
    }

    /// The place of the multiplier of a constraint in a part. The accelerations stand before it, from place 0.
    pub const fn multiplier(self, constraint: usize) -> usize {
        self.coordinates + constraint
    }

    /// The place of the slip rate of a contact in a part.
    pub const fn slip_rate(self, contact: usize) -> usize {
        self.multiplier(self.constraints) + contact
    }

    /// The places of the components of the normal reaction of a contact in a part.
    pub const fn normal(self, contact: usize) -> Range<usize> {
        let first = self.slip_rate(self.contacts) + self.axes * contact;
        first..first + self.axes
    }

    /// The place of an entry of the part without friction (0), or of the effect of a unit of the friction of a contact (1 + its
    /// index).
    pub const fn entry(self, part: usize, place: usize) -> usize {
        part * self.part() + place
    }

    /// The place of the coefficient `μ` of a contact.
    pub const fn friction(self, contact: usize) -> usize {
        self.entry(1 + self.contacts, contact)
    }

    /// The place of the coefficient `μ₀` of a contact.
    pub const fn static_friction(self, contact: usize) -> usize {
        self.friction(self.contacts) + contact
    }

    /// The places of the direction of a contact; empty in the plane.
    pub const fn direction(self, contact: usize) -> Range<usize> {
        let components = if self.axes == 1 { 0 } else { self.axes };
        let first = self.static_friction(self.contacts) + components * contact;
        first..first + components
    }

    /// The lists in the numbers of a part.
    pub fn split<T>(self, part: &[T]) -> FrictionPart<&[T]> {
        let (multipliers, slip_rates) = (self.multiplier(0), self.slip_rate(0));
        let normals = self.normal(0).start;
        FrictionPart {
            accelerations: &part[..multipliers],
            multipliers: &part[multipliers..slip_rates],
            slip_rates: &part[slip_rates..normals],
            normals: &part[normals..self.part()],
        }
    }

    /// All numbers in order: those of the parts, then of each contact `μ` and `μ₀`, then in space the directions.
    pub fn arrange<L: IntoIterator>(
        parts: impl IntoIterator<Item = FrictionPart<L>>,
        coefficients: [L; 2],
        directions: L,
    ) -> impl Iterator<Item = L::Item> {
        let parts = parts.into_iter().flat_map(FrictionPart::in_order);
        parts
            .chain(coefficients.into_iter().flatten())
            .chain(directions)
    }
}

/// The response of a machine to friction forces.
#[derive(Clone, Copy, Debug)]
pub struct FrictionResponse<'r, T> {
    /// The arrangement of the numbers.
    pub layout: FrictionLayout,
    /// The numbers, [`FrictionLayout::len`] of them.
    pub values: &'r [T],
}

impl<'r, T: Copy> FrictionResponse<'r, T> {
    /// An entry without friction (part 0), or the effect on it of a unit of the friction of a contact (part 1 + its index).
    pub fn at(&self, part: usize, place: usize) -> T {
        self.values[self.layout.entry(part, place)]
    }

    /// The coefficient `μ` of a contact.
    pub fn friction(&self, contact: usize) -> T {
        self.values[self.layout.friction(contact)]
    }

    /// The coefficient `μ₀` of a contact.
    pub fn static_friction(&self, contact: usize) -> T {
        self.values[self.layout.static_friction(contact)]
    }

    /// In space the direction of a contact from which the pressing component of its reaction follows; empty in the plane.
    pub fn direction(&self, contact: usize) -> &'r [T] {
        &self.values[self.layout.direction(contact)]
    }
}

impl<T: crate::Scalar> FrictionResponse<'_, T> {
    /// An entry with these friction forces: `x₀ + Σ Fₖ xₖ`.
    pub fn with(&self, place: usize, friction_forces: &[T]) -> T {
        let forces = friction_forces.iter().enumerate();
        forces.fold(self.at(0, place), |sum, (k, &force)| {
            sum + force * self.at(1 + k, place)
        })
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::vec::Vec;

    use super::*;

    /// The list of a machine in space with two coordinates, one constraint and two contacts, as [`FrictionLayout`] describes it:
    /// each number is named by what it is.
    #[test]
    fn lists_are_read_as_they_are_written() {
        let layout = FrictionLayout {
            coordinates: 2,
            constraints: 1,
            contacts: 2,
            axes: 3,
        };
        let part = |k: i32| FrictionPart {
            accelerations: [100 * k + 1, 100 * k + 2].to_vec(),
            multipliers: [100 * k + 11].to_vec(),
            slip_rates: [100 * k + 21, 100 * k + 22].to_vec(),
            normals: (1..=6).map(|i| 100 * k + 30 + i).collect(),
        };
        let coefficients = [[1001, 1002].to_vec(), [1011, 1012].to_vec()];
        let directions = (1..=6).map(|i| 1020 + i).collect();
        let list = FrictionLayout::arrange([0, 1, 2].map(part), coefficients, directions);
        let list: Vec<i32> = list.collect();
        assert_eq!(list.len(), layout.len());
        // Three parts of 2 + 1 + 2 + 6 numbers, written out by hand.
        assert_eq!(layout.part(), 11);
        assert_eq!(
            list[11..22],
            [101, 102, 111, 121, 122, 131, 132, 133, 134, 135, 136]
        );
        assert_eq!(list[33..37], [1001, 1002, 1011, 1012]);
        let response = FrictionResponse {
            layout,
            values: &list,
        };
        assert_eq!(response.at(1, layout.multiplier(0)), 111);
        assert_eq!(response.at(2, layout.slip_rate(1)), 222);
        assert_eq!(response.at(2, layout.normal(1).start), 234);
        assert_eq!(response.friction(1), 1002);
        assert_eq!(response.static_friction(0), 1011);
        assert_eq!(response.direction(1), [1024, 1025, 1026]);
        let read = layout.split(&list[11..22]);
        let written = part(1);
        assert_eq!(read.accelerations, written.accelerations);
        assert_eq!(read.multipliers, written.multipliers);
        assert_eq!(read.slip_rates, written.slip_rates);
        assert_eq!(read.normals, written.normals);
    }

    /// In the plane a reaction has one component, and no direction is needed.
    #[test]
    fn in_the_plane_there_are_no_directions() {
        let layout = FrictionLayout {
            coordinates: 3,
            constraints: 0,
            contacts: 1,
            axes: 1,
        };
        // Two parts of 3 + 1 + 1 numbers, μ and μ₀.
        assert_eq!(layout.len(), 12);
        assert!(layout.direction(0).is_empty());
    }
}
