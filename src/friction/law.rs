//! Coulomb's law for contacts in given states, and the search for the states that are possible.

#[cfg(feature = "std")]
mod blocks;
mod elimination;
mod in_space;
mod open_states;
#[cfg(feature = "std")]
mod pivoting;
mod sharing;
#[cfg(all(test, feature = "std"))]
mod tests;
#[cfg(feature = "std")]
mod uniqueness;

use super::per_contact::PerContact;
use crate::scalar::friction::{FrictionLayout, FrictionResponse};
use crate::system::MOST_CONTACTS;
use crate::{Pivot, Singular};
pub(super) use elimination::Equations;
use elimination::SINGULAR;
pub(super) use open_states::{OpenStates, Turned};
pub(super) use sharing::Shared;
use sharing::{Undetermined, beyond};

/// One number for each contact.
pub(super) type Each = PerContact<f64>;

/// Round-off of a condition, relative to its terms.
pub(super) const ROUNDING: f64 = 1e-12;

/// Solutions whose accelerations differ by less than this, relative to the largest, are the same.
const SAME: f64 = 1e-9;

/// The motion of a contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum Motion {
    /// It is at rest on its guide.
    #[default]
    Sticks,
    /// It slides forward (1) or backward (−1).
    Slides(f64),
    /// It slides on a surface, along both of its tangents, in the direction [`Mode::slip_direction`].
    SlidesAlong,
}

/// The states of the contacts: their motion, and the sides to which they press (1 or −1).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Mode {
    pub motion: PerContact<Motion>,
    pub press: Each,
    /// For sliding contacts the components of their direction along the two tangents; both are 0 if the direction is not known.
    pub slip_direction: Each,
}

impl Mode {
    /// That all of so many contacts stick.
    pub(super) fn sticking(contacts: usize) -> Mode {
        Mode {
            motion: PerContact::new(contacts, Motion::Sticks),
            press: Each::new(contacts, 1.0),
            slip_direction: Each::new(contacts, 0.0),
        }
    }

    /// The component along this tangent of a unit friction force that opposes the slip.
    fn share(&self, contact: usize) -> f64 {
        match self.motion[contact] {
            Motion::Sticks => 0.0,
            Motion::Slides(sign) => sign,
            Motion::SlidesAlong => self.slip_direction[contact],
        }
    }
}

/// Whether there is no solution or several, and the first contact concerned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Paradox {
    pub contact: usize,
    pub several: bool,
}

impl Paradox {
    pub fn singular(self) -> Singular {
        Singular {
            at: Pivot::Contact(self.contact),
            ratio: if self.several { f64::INFINITY } else { 0.0 },
        }
    }
}

/// The arrangement of the results of [`System::friction`](crate::System::friction), with what else distinguishes contacts.
#[derive(Clone, Copy)]
pub(super) struct Layout {
    pub response: FrictionLayout,
    /// The contacts that are second tangents of surfaces ([`System::second_tangents`](crate::System::second_tangents)),
    /// as a bit mask.
    pub seconds: u64,
}

impl Layout {
    /// Whether a contact is the second tangent of the surface of the contact before it.
    pub const fn is_second(self, contact: usize) -> bool {
        contact < MOST_CONTACTS && self.seconds >> contact & 1 != 0
    }

    /// Whether a contact is the first of two tangents.
    pub const fn has_second(self, contact: usize) -> bool {
        self.is_second(contact + 1)
    }

    /// The number of contacts.
    pub const fn contacts(self) -> usize {
        self.response.contacts
    }

    /// The number of components of a reaction.
    pub const fn axes(self) -> usize {
        self.response.axes
    }
}

/// The response of the machine to friction forces.
pub(super) struct Parts<'p> {
    pub layout: Layout,
    pub values: &'p [f64],
}

impl Parts<'_> {
    /// The response, whose entries have names.
    const fn response(&self) -> FrictionResponse<'_, f64> {
        FrictionResponse {
            layout: self.layout.response,
            values: self.values,
        }
    }

    /// Entry `i` of a part: without friction (part 0), or per unit of the friction of a contact.
    pub fn at(&self, part: usize, i: usize) -> f64 {
        self.response().at(part, i)
    }

    /// Entry `i` with all friction forces, and the size of its terms.
    pub fn sum(&self, i: usize, friction_forces: &Each) -> [f64; 2] {
        let alone = self.at(0, i);
        let mut sum = [alone, alone.abs()];
        for (k, friction) in friction_forces.iter().enumerate() {
            let term = self.at(1 + k, i) * friction;
            sum = [sum[0] + term, sum[1] + term.abs()];
        }
        sum
    }

    /// Index of the slip rate of a contact in a part.
    pub fn slip_rate(&self, contact: usize) -> usize {
        self.layout.response.slip_rate(contact)
    }

    /// Indices of the components of its normal reaction.
    fn components(&self, contact: usize) -> core::ops::Range<usize> {
        self.layout.response.normal(contact)
    }

    /// Its normal reaction with all friction forces, and the size of its terms: in the plane the force along the normal, in space
    /// the length of the vector.
    pub fn reaction(&self, contact: usize, friction_forces: &Each) -> [f64; 2] {
        let components = self.components(contact);
        if self.layout.axes() == 1 {
            return self.sum(components.start, friction_forces);
        }
        let terms = components.map(|i| self.sum(i, friction_forces)[1]);
        let terms = terms.fold(0.0, |sum, size| sum + size * size);
        let across = self.pressing(contact, friction_forces);
        [dot(&across, &across), terms].map(crate::math::sqrt)
    }

    /// The pressing part of its normal reaction in space.
    fn pressing(&self, contact: usize, friction_forces: &Each) -> [f64; 3] {
        let mut vector = [0.0; 3];
        for (x, i) in vector.iter_mut().zip(self.components(contact)) {
            [*x, _] = self.sum(i, friction_forces);
        }
        self.across(contact, vector)
    }

    /// What friction forces that are undetermined add to its normal reaction: in the plane a number, in space a vector.
    fn presses_by(&self, contact: usize, of_unit: &[f64]) -> [f64; 3] {
        let (mut vector, mut size) = ([0.0; 3], 0.0_f64);
        for (x, i) in vector.iter_mut().zip(self.components(contact)) {
            let mut terms = 0.0;
            for (j, force) in of_unit.iter().enumerate() {
                let term = self.at(1 + j, i) * force;
                *x += term;
                terms += term.abs();
            }
            size = size.max(terms);
        }
        if self.layout.axes() != 1 {
            vector = self.across(contact, vector);
        }
        vector.map(|x| beyond(x, SAME * size))
    }

    /// The direction of a guide in space: along a curve, and across a surface.
    fn direction(&self, contact: usize) -> [f64; 3] {
        let direction = self.response().direction(contact);
        [0, 1, 2].map(|i| direction[i])
    }

    /// The pressing part of a reaction in space: everything except the component along a curve, or the component along the normal
    /// of a surface. The rest only balances forces along the guide that the spec writes in coordinates, which are not forces on
    /// the position of the body.
    fn across(&self, contact: usize, vector: [f64; 3]) -> [f64; 3] {
        let direction = self.direction(contact);
        let along = dot(&direction, &vector);
        let on_surface = self.layout.is_second(contact) || self.layout.has_second(contact);
        [0, 1, 2].map(|i| {
            if on_surface {
                along * direction[i]
            } else {
                vector[i] - along * direction[i]
            }
        })
    }

    /// What a unit of the friction of a contact adds to the normal reaction of another: in the plane a number, in space a vector.
    fn unit_pressing(&self, contact: usize, friction_of: usize) -> [f64; 3] {
        let mut vector = [0.0; 3];
        for (x, i) in vector.iter_mut().zip(self.components(contact)) {
            *x = self.at(1 + friction_of, i);
        }
        if self.layout.axes() == 1 {
            vector
        } else {
            self.across(contact, vector)
        }
    }

    /// The size of [`unit_pressing`](Self::unit_pressing).
    fn presses_by_unit(&self, contact: usize, friction_of: usize) -> f64 {
        let vector = self.unit_pressing(contact, friction_of);
        match self.layout.axes() {
            1 => vector[0].abs(),
            _ => crate::math::sqrt(dot(&vector, &vector)),
        }
    }

    /// Whether no friction force changes a normal reaction.
    fn presses_regardless_of_friction(&self) -> bool {
        let all = || 0..self.layout.contacts();
        all().all(|k| all().all(|by| self.presses_by_unit(k, by) <= SINGULAR))
    }

    pub fn friction(&self, contact: usize) -> f64 {
        self.response().friction(contact)
    }

    pub fn static_friction(&self, contact: usize) -> f64 {
        self.response().static_friction(contact)
    }

    /// The friction forces of contacts in given states.
    /// If guides depend on each other, these are forces with the right sums, which give the right accelerations; those that every guide
    /// allows are in [`shared_forces`](Self::shared_forces).
    ///
    /// # Errors
    /// If no such motion exists, or several may.
    pub fn friction_forces(&self, mode: &Mode) -> Result<Each, Paradox> {
        self.only_solution(mode).map(|(forces, _)| forces)
    }

    /// The friction forces of contacts in given states, and of guides that depend on each other how they share theirs so that all of them
    /// hold best.
    ///
    /// # Errors
    /// As [`friction_forces`](Self::friction_forces).
    #[cfg(feature = "std")]
    pub fn shared_forces(&self, mode: &Mode) -> Result<(Each, Shared), Paradox> {
        let (forces, undetermined) = self.only_solution(mode)?;
        Ok(self.share(mode, forces, &undetermined))
    }

    /// The friction forces of contacts in given states, with those of them 0 that the equations leave undetermined.
    fn only_solution(&self, mode: &Mode) -> Result<(Each, Undetermined), Paradox> {
        if self.layout.axes() == 1 {
            return self.along_normals(mode).ok_or(NO_MOTION);
        }
        let (mut found, mut several) = (None, false);
        let known = self.by_sizes(mode, &mut |friction_forces, undetermined| {
            several |= found.is_some();
            found = Some((friction_forces, undetermined.clone()));
        });
        let sliding = |k: &usize| mode.motion[*k] != Motion::Sticks;
        let contact = (0..self.layout.contacts()).find(sliding).unwrap_or(0);
        match found {
            Some(found) if known && !several => Ok(found),
            _ => Err(Paradox {
                contact: if several || !known { contact } else { 0 },
                several: several || !known,
            }),
        }
    }

    /// Calls `look` with all friction forces that contacts in given states may have; returns false if there may be others.
    fn each_solution(&self, mode: &Mode, look: &mut dyn FnMut(Each)) -> bool {
        match self.layout.axes() {
            1 => {
                if let Some((forces, undetermined)) = self.along_normals(mode) {
                    look(self.share(mode, forces, &undetermined).0);
                }
                true
            }
            _ => self.by_sizes(mode, &mut |forces, undetermined| {
                look(self.share(mode, forces, undetermined).0);
            }),
        }
    }

    /// In the plane the side to which each contact presses is given, and the equations are linear.
    fn along_normals(&self, mode: &Mode) -> Option<(Each, Undetermined)> {
        let count = self.layout.contacts();
        let mut equations = Equations::new(count);
        for (k, row) in equations.rows_mut().enumerate() {
            let (entry, factor, own) = match mode.motion[k] {
                Motion::Sticks => (self.slip_rate(k), 1.0, 0.0),
                Motion::Slides(_) | Motion::SlidesAlong => {
                    let normal = self.components(k).start;
                    (
                        normal,
                        mode.share(k) * mode.press[k] * self.friction(k),
                        1.0,
                    )
                }
            };
            for (j, x) in row[..count].iter_mut().enumerate() {
                *x = factor * self.at(1 + j, entry);
            }
            row[k] += own;
            row[count] = -factor * self.at(0, entry);
        }
        let (forces, column_of) = equations.eliminate()?;
        Some((forces, Undetermined::of(&equations, &column_of)))
    }

    /// Whether contacts in given states can have these friction forces: sticking contacts need no more friction than they have,
    /// and sliding ones press to the given side. The side is not checked for the state that a contact enters when its reaction is
    /// zero, since rounding would decide.
    fn admits(&self, mode: &Mode, friction_forces: &Each, turned: Option<Turned>) -> bool {
        (0..self.layout.contacts()).all(|k| {
            turned == Some((k, mode.motion[k], mode.press[k]))
                // The condition for both tangents is checked at the first.
                || self.layout.is_second(k)
                || self.admits_one(mode, friction_forces, k)
        })
    }

    /// Whether one contact in its state can have these friction forces.
    fn admits_one(&self, mode: &Mode, friction_forces: &Each, contact: usize) -> bool {
        let [normal, terms] = self.reaction(contact, friction_forces);
        match mode.motion[contact] {
            Motion::Sticks => {
                let most = self.static_friction(contact) * normal.abs();
                self.used(contact, friction_forces)
                    <= most + ROUNDING * (most + self.static_friction(contact) * terms)
            }
            Motion::Slides(_) | Motion::SlidesAlong => {
                mode.press[contact] * normal >= -ROUNDING * terms
            }
        }
    }

    /// Whether a contact that starts to slide accelerates in its direction.
    fn accelerates_in_its_direction(
        &self,
        mode: &Mode,
        friction_forces: &Each,
        contact: usize,
    ) -> bool {
        let [rate, terms] = self.sum(self.slip_rate(contact), friction_forces);
        match mode.motion[contact] {
            Motion::Sticks => true,
            Motion::Slides(sign) => sign * rate >= -ROUNDING * terms,
            Motion::SlidesAlong if self.layout.is_second(contact) => true,
            Motion::SlidesAlong => {
                let [across, more] = self.sum(self.slip_rate(contact + 1), friction_forces);
                let ahead =
                    mode.slip_direction[contact] * rate + mode.slip_direction[contact + 1] * across;
                ahead >= -ROUNDING * (terms + more)
            }
        }
    }

    /// The magnitude of the friction of a contact, along both tangents if it has two.
    pub fn used(&self, contact: usize, friction_forces: &Each) -> f64 {
        let along = friction_forces[contact];
        if self.layout.has_second(contact) {
            length([along, friction_forces[contact + 1]])
        } else {
            along.abs()
        }
    }

    /// Whether two solutions give the same accelerations.
    fn same(&self, one: &Each, other: &Each) -> bool {
        let (mut most, mut apart) = (0.0_f64, 0.0_f64);
        for i in 0..self.layout.response.coordinates {
            let ([x, of_x], [y, of_y]) = (self.sum(i, one), self.sum(i, other));
            most = most.max(of_x.max(of_y));
            apart = apart.max((x - y).abs());
        }
        apart <= SAME * most
    }
}

/// A vector of length 1 along another, unless that is 0.
fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let length = crate::math::sqrt(dot(&vector, &vector));
    (length > 0.0).then(|| vector.map(|x| x / length))
}

/// That no forces satisfy the equations.
const NO_MOTION: Paradox = Paradox {
    contact: 0,
    several: false,
};

impl Shared {
    fn least_margin(&self) -> f64 {
        let known = self.margin.iter().flatten();
        known.copied().reduce(f64::min).unwrap_or(f64::NEG_INFINITY)
    }
}

pub(super) fn length([x, y]: [f64; 2]) -> f64 {
    // Scaling prevents underflow and overflow of the squares.
    let most = x.abs().max(y.abs());
    if most > 0.0 && most.is_finite() {
        most * crate::math::sqrt((x / most) * (x / most) + (y / most) * (y / most))
    } else {
        most
    }
}

fn dot(u: &[f64; 3], v: &[f64; 3]) -> f64 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}
