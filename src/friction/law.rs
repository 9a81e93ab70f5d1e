//! Coulomb's law for contacts in given states, and the search for the states that are possible.

use super::MOST_CONTACTS;
use super::shares::{self, Limit, PARTS, Sharer};
use crate::scalar::Scalar;
use crate::scalar::friction::{FrictionLayout, FrictionResponse};
use crate::{Pivot, Singular};

/// One number for each contact.
pub(super) type Each = [f64; MOST_CONTACTS];

/// Round-off of a condition, relative to its terms.
pub(super) const ROUNDING: f64 = 1e-12;

/// Solutions whose accelerations differ by less than this, relative to the largest, are the same.
const SAME: f64 = 1e-9;

/// A pivot is zero below this, relative to the entries of its row.
const SINGULAR: f64 = 1e-12;

/// The largest number of iterations for the friction forces of several contacts that slide in space. Newton's method takes a few;
/// a contraction by a factor of 0.9 takes this many for sixteen digits.
const MOST_STEPS: usize = 400;

/// How often the directions of reactions at curves in space are turned to where the shared forces have them.
const MOST_TURNS: usize = 50;

/// Number of directions at which the search begins for the direction in which a contact on a surface starts to slide.
const DIRECTIONS: usize = 48;

/// Number of bisections from the angle between two of these directions to its round-off.
const BISECTIONS: usize = 54;

/// The directions of several contacts have converged if none changes by more than this in an iteration.
const SETTLED: f64 = 1e-15;

/// The motion of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Motion {
    /// It is at rest on its guide.
    Sticks,
    /// It slides forward (1) or backward (−1).
    Slides(f64),
    /// It slides on a surface, along both of its tangents, in the direction [`Mode::slip_direction`].
    SlidesAlong,
}

/// The states of the contacts: their motion, and the sides to which they press (1 or −1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mode {
    pub motion: [Motion; MOST_CONTACTS],
    pub press: Each,
    /// For sliding contacts the components of their direction along the two tangents; both are 0 if the direction is not known.
    pub slip_direction: Each,
}

impl Mode {
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
    pub seconds: usize,
}

impl Layout {
    /// Whether a contact is the second tangent of the surface of the contact before it.
    pub const fn is_second(self, contact: usize) -> bool {
        self.seconds >> contact & 1 != 0
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
        for (k, friction) in friction_forces[..self.layout.contacts()].iter().enumerate() {
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
    fn presses_by(&self, contact: usize, of_unit: &Each) -> [f64; 3] {
        let (mut vector, mut size) = ([0.0; 3], 0.0_f64);
        for (x, i) in vector.iter_mut().zip(self.components(contact)) {
            let mut terms = 0.0;
            for (j, force) in of_unit[..self.layout.contacts()].iter().enumerate() {
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

    /// Whether no friction force changes a normal reaction, in space.
    fn presses_regardless_of_friction(&self) -> bool {
        let by_friction = |contact: usize, part: usize| {
            let mut vector = [0.0; 3];
            for (x, i) in vector.iter_mut().zip(self.components(contact)) {
                *x = self.at(1 + part, i);
            }
            self.across(contact, vector)
        };
        let all = || 0..self.layout.contacts();
        let is_none = |x: f64| x.abs() <= SINGULAR;
        self.layout.axes() == 3
            && all().all(|k| all().all(|part| by_friction(k, part).into_iter().all(is_none)))
    }

    pub fn friction(&self, contact: usize) -> f64 {
        self.response().friction(contact)
    }

    pub fn static_friction(&self, contact: usize) -> f64 {
        self.response().static_friction(contact)
    }

    /// The friction forces of contacts in given states.
    /// Of guides that depend on each other these are forces with the right sums, which give the right accelerations; those that every guide
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
            found = Some((friction_forces, *undetermined));
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
        let mut rows = [[0.0; MOST_CONTACTS + 1]; MOST_CONTACTS];
        for (k, row) in rows[..count].iter_mut().enumerate() {
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
        let (forces, column_of) = eliminate(&mut rows, count)?;
        Some((forces, Undetermined::of(&rows, count, column_of)))
    }

    /// Replaces forces that the equations leave undetermined, which are 0 in `forces`, by those that sticking guides allow best.
    fn share(&self, mode: &Mode, mut forces: Each, undetermined: &Undetermined) -> (Each, Shared) {
        let (free, count) = (undetermined.number, self.layout.contacts());
        // Where friction of what slides is undetermined, so is the motion, and nothing is shared.
        let slides = |k: &usize| mode.motion[*k] != Motion::Sticks;
        let moves = |of_unit: &Each| {
            (0..count).filter(slides).any(|k| {
                let in_space = self.layout.axes() != 1 && self.presses_by(k, of_unit) != [0.0; 3];
                of_unit[k] != 0.0 || in_space
            })
        };
        if free == 0 || undetermined.of_unit[..free].iter().any(moves) {
            return (forces, Shared::NONE);
        }
        let mut shared = Shared::NONE;
        let mut sides = self.sides(mode, &forces, undetermined);
        for _ in 0..MOST_TURNS {
            let before = shared.least_margin();
            self.share_once(mode, (&forces, &sides), undetermined, &mut shared);
            if !self.turn_sides(mode, (&forces, &mut sides), undetermined, &shared)
                || shared.least_margin() <= before + ROUNDING * before.abs()
            {
                break;
            }
        }
        for (of_unit, y) in undetermined.of_unit[..free].iter().zip(shared.undetermined) {
            for (force, x) in forces[..count].iter_mut().zip(of_unit) {
                *force += y * x;
            }
        }
        (forces, shared)
    }

    /// Shares undetermined forces among guides whose normal reactions are measured along given directions.
    fn share_once(
        &self,
        mode: &Mode,
        (forces, sides): (&Each, &Sides),
        undetermined: &Undetermined,
        shared: &mut Shared,
    ) {
        let (free, count) = (undetermined.number, self.layout.contacts());
        let of_unit = &undetermined.of_unit[..free];
        // What each undetermined force adds to the forces of each contact.
        let mut by = [0.0; PARTS * MOST_CONTACTS * MOST_CONTACTS];
        let by = &mut by[..PARTS * free * count];
        let mut sharers = [Sharer::default(); MOST_CONTACTS];
        for (k, (sharer, by)) in sharers
            .iter_mut()
            .zip(by.chunks_exact_mut(PARTS * free))
            .enumerate()
        {
            // Both tangents of a surface belong to the first.
            if mode.motion[k] != Motion::Sticks || self.layout.is_second(k) {
                continue;
            }
            let has_second = self.layout.has_second(k);
            *sharer = Sharer {
                static_friction: Some(self.static_friction(k)),
                presses: false,
                normal: match self.layout.axes() {
                    1 => self.reaction(k, forces)[0],
                    _ => dot(&self.pressing(k, forces), &sides[k]),
                },
                tangential: [forces[k], if has_second { forces[k + 1] } else { 0.0 }],
            };
            let (normals, tangentials) = by.split_at_mut(free);
            for (i, of_unit) in of_unit.iter().enumerate() {
                normals[i] = dot(&self.presses_by(k, of_unit), &sides[k]);
                tangentials[i] = of_unit[k];
                if has_second {
                    tangentials[free + i] = of_unit[k + 1];
                }
            }
        }
        let mut groups = [0; MOST_CONTACTS];
        let groups = &mut groups[..free];
        shares::group(by, groups);
        let (by, groups) = (&*by, &*groups);
        for group in 0..free {
            if groups[group] == group {
                share_group((&sharers[..count], by, groups, group), shared);
            }
        }
    }

    /// The directions along which normal reactions are measured: in the plane they are numbers, on a surface along its normal, and at a curve
    /// across it, where its reaction is without undetermined forces.
    fn sides(&self, mode: &Mode, forces: &Each, undetermined: &Undetermined) -> Sides {
        let mut sides = [[1.0, 0.0, 0.0]; MOST_CONTACTS];
        if self.layout.axes() == 1 {
            return sides;
        }
        for (k, side) in sides[..self.layout.contacts()].iter_mut().enumerate() {
            if mode.motion[k] != Motion::Sticks {
                continue;
            }
            let on_surface = self.layout.is_second(k) || self.layout.has_second(k);
            *side = if on_surface {
                self.direction(k)
            } else {
                let of_units = undetermined.of_unit[..undetermined.number].iter();
                let by = of_units.map(|of_unit| self.presses_by(k, of_unit));
                let mut all = core::iter::once(self.pressing(k, forces)).chain(by);
                all.find_map(unit).unwrap_or(*side)
            };
        }
        sides
    }

    /// Turns the directions of curves to where their reactions are with the shared forces. `|N| ≥ n·N` for every direction n, so that what holds
    /// with one of them holds, and none of the margins becomes less. The answer is whether any has turned.
    fn turn_sides(
        &self,
        mode: &Mode,
        (forces, sides): (&Each, &mut Sides),
        undetermined: &Undetermined,
        shared: &Shared,
    ) -> bool {
        let mut turned = false;
        let on_curve = |k: &usize| !self.layout.is_second(*k) && !self.layout.has_second(*k);
        let sticks = |k: &usize| mode.motion[*k] == Motion::Sticks;
        let all = 0..if self.layout.axes() == 1 {
            0
        } else {
            self.layout.contacts()
        };
        for k in all.filter(on_curve).filter(sticks) {
            let mut vector = self.pressing(k, forces);
            let of_units = undetermined.of_unit[..undetermined.number].iter();
            let mut depends = false;
            for (of_unit, y) in of_units.zip(shared.undetermined) {
                let by = self.presses_by(k, of_unit);
                depends |= by != [0.0; 3];
                for (x, by) in vector.iter_mut().zip(by) {
                    *x += y * by;
                }
            }
            if let Some(side) = unit(vector).filter(|_| depends) {
                turned |= side != sides[k];
                sides[k] = side;
            }
        }
        turned
    }

    /// The round-off of the margin of a contact that shares forces with others.
    #[cfg(feature = "std")]
    pub fn rounding_of_shared(&self, contact: usize, forces: &Each, shared: &Shared) -> f64 {
        let shares =
            |k: &usize| shared.margin[*k].is_some() && shared.group[*k] == shared.group[contact];
        let terms = |k: usize| {
            let friction = self.static_friction(k);
            let by_friction = if friction > 0.0 {
                self.used(k, forces) / friction
            } else {
                0.0
            };
            self.reaction(k, forces)[1] + by_friction
        };
        let all = (0..self.layout.contacts()).filter(shares).map(terms);
        let rounding = ROUNDING * all.fold(0.0, f64::max);
        rounding.max(shared.residual[contact])
    }

    /// In space a friction force `f = μ |N|` depends on the length of a vector. The forces of sticking contacts depend linearly on
    /// those of sliding ones, so `N = A + B f`, and there remains one equation `f = μ |A + B f|` for each sliding contact, on a
    /// surface for both tangents together.
    ///
    /// Calls `look` with the forces, of which undetermined ones are 0.
    fn by_sizes(&self, mode: &Mode, look: &mut dyn FnMut(Each, &Undetermined)) -> bool {
        let count = self.layout.contacts();
        let mut sliding = [0; MOST_CONTACTS];
        let mut number = 0;
        for (k, motion) in mode.motion[..count].iter().enumerate() {
            if *motion != Motion::Sticks && !self.layout.is_second(k) {
                sliding[number] = k;
                number += 1;
            }
        }
        let sliding = &sliding[..number];
        // The forces without friction in the sliding contacts, and per unit of the friction of each of them.
        let mut forces = [[0.0; MOST_CONTACTS]; MOST_CONTACTS + 1];
        let mut undetermined = Undetermined::NONE;
        for (part, forces) in forces[..=number].iter_mut().enumerate() {
            let mut rows = [[0.0; MOST_CONTACTS + 1]; MOST_CONTACTS];
            for (k, row) in rows[..count].iter_mut().enumerate() {
                if mode.motion[k] == Motion::Sticks {
                    let entry = self.slip_rate(k);
                    for (j, x) in row[..count].iter_mut().enumerate() {
                        *x = self.at(1 + j, entry);
                    }
                    row[count] = if part == 0 { -self.at(0, entry) } else { 0.0 };
                } else {
                    row[k] = 1.0;
                    let first = k - usize::from(self.layout.is_second(k));
                    let own = part > 0 && sliding[part - 1] == first;
                    row[count] = if own { -mode.share(k) } else { 0.0 };
                }
            }
            let Some((solved, column_of)) = eliminate(&mut rows, count) else {
                return true;
            };
            if part == 0 {
                undetermined = Undetermined::of(&rows, count, column_of);
            }
            *forces = solved;
        }
        // `N` of each sliding contact, in the same parts.
        let mut pressing = [[[0.0; 3]; MOST_CONTACTS + 1]; MOST_CONTACTS];
        for (&k, pressing) in sliding.iter().zip(&mut pressing) {
            for (part, vector) in pressing[..=number].iter_mut().enumerate() {
                for (x, i) in vector.iter_mut().zip(self.components(k)) {
                    let start = if part == 0 { self.at(0, i) } else { 0.0 };
                    let by = forces[part][..count].iter().enumerate();
                    *x = by.fold(start, |sum, (j, force)| sum + self.at(1 + j, i) * force);
                }
                *vector = self.across(k, *vector);
            }
        }
        let mut coefficients = [0.0; MOST_CONTACTS];
        for (&k, coefficient) in sliding.iter().zip(&mut coefficients) {
            *coefficient = self.friction(k);
        }
        let sizes = Sizes {
            number,
            coefficients,
            pressing,
        };
        sizes.each(&mut |sizes: &Each| {
            let mut all = forces[0];
            for (of_unit, size) in forces[1..=number].iter().zip(sizes) {
                for (force, by) in all.iter_mut().zip(of_unit) {
                    *force += size * by;
                }
            }
            look(all, &undetermined);
        })
    }

    /// Whether contacts in given states can have these friction forces: sticking contacts need no more friction than they have,
    /// and sliding ones press to the given side. The side is not checked for the state that a contact enters when its reaction is
    /// zero, since rounding would decide.
    fn admits(&self, mode: &Mode, friction_forces: &Each, turned: Option<Turned>) -> bool {
        (0..self.layout.contacts()).all(|k| {
            if turned == Some((k, mode.motion[k], mode.press[k])) {
                return true;
            }
            // The condition for both tangents is checked at the first.
            if self.layout.is_second(k) {
                return true;
            }
            let [normal, terms] = self.reaction(k, friction_forces);
            match mode.motion[k] {
                Motion::Sticks => {
                    let most = self.static_friction(k) * normal.abs();
                    self.used(k, friction_forces)
                        <= most + ROUNDING * (most + self.static_friction(k) * terms)
                }
                Motion::Slides(_) | Motion::SlidesAlong => {
                    mode.press[k] * normal >= -ROUNDING * terms
                }
            }
        })
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

    /// Calls `look` with all friction forces in given states, where the contacts on surfaces in `open` start to slide in
    /// directions that are to be found. Returns false if there may be others.
    fn each_slip_direction(
        &self,
        mode: Mode,
        open: &[usize],
        look: &mut dyn FnMut(Mode, Each),
    ) -> bool {
        match *open {
            [] => self.each_solution(&mode, &mut |forces| look(mode, forces)),
            [contact] => {
                let mut known = true;
                self.find_slip_directions(mode, contact, &mut |mode| {
                    known &= self.each_solution(&mode, &mut |forces| look(mode, forces));
                });
                known
            }
            _ => match self.find_slip_directions_together(mode, open) {
                Some(mode) => self.each_solution(&mode, &mut |forces| look(mode, forces)),
                None => false,
            },
        }
    }

    /// Finds the directions in which a contact on a surface may start to slide while all others are in given states: those in
    /// which its slip grows along itself. The search samples the circle and then bisects to round-off.
    fn find_slip_directions(&self, mut mode: Mode, contact: usize, look: &mut dyn FnMut(Mode)) {
        let mut along = |angle: f64| {
            let (sin, cos) = Scalar::sin_cos(angle);
            (
                mode.slip_direction[contact],
                mode.slip_direction[contact + 1],
            ) = (cos, sin);
            mode
        };
        // The growth of the slip to the left of the direction, and along it.
        let grows = |mode: &Mode| {
            let forces = self.friction_forces(mode).ok()?;
            let [x, y] = [contact, contact + 1].map(|k| self.sum(self.slip_rate(k), &forces)[0]);
            let [a, b] = [
                mode.slip_direction[contact],
                mode.slip_direction[contact + 1],
            ];
            Some([a * y - b * x, a * x + b * y])
        };
        let whole = 2.0 * core::f64::consts::PI;
        let at = |number: usize| whole * number as f64 / DIRECTIONS as f64;
        let mut before = grows(&along(at(0)));
        for number in 1..=DIRECTIONS {
            let (mut from, mut to) = (at(number - 1), at(number));
            let after = grows(&along(to));
            let (Some([mut aside, _]), Some([next, _])) = (before, after) else {
                before = after;
                continue;
            };
            before = after;
            if aside != 0.0 {
                if (aside > 0.0) == (next > 0.0) {
                    continue;
                }
                for _ in 0..BISECTIONS {
                    let middle = 0.5 * (from + to);
                    let Some([value, _]) = grows(&along(middle)) else {
                        break;
                    };
                    if (value > 0.0) == (aside > 0.0) {
                        (from, aside) = (middle, value)
                    } else {
                        to = middle
                    }
                }
                from = 0.5 * (from + to);
            }
            look(along(from));
        }
    }

    /// The directions of several contacts on surfaces that start to slide at once, by iteration over the contacts until none
    /// turns. `None` if one of them could go in several directions, or the iteration does not converge.
    fn find_slip_directions_together(&self, mut mode: Mode, open: &[usize]) -> Option<Mode> {
        for _ in 0..MOST_STEPS {
            let mut turned = 0.0_f64;
            for &contact in open {
                let (mut found, mut several) = (None, false);
                self.find_slip_directions(mode, contact, &mut |next| {
                    let forces = self.friction_forces(&next).ok();
                    if forces.is_some_and(|forces| {
                        self.accelerates_in_its_direction(&next, &forces, contact)
                    }) {
                        several |= found.is_some_and(|known: Mode| {
                            let [a, b] = [
                                known.slip_direction[contact],
                                known.slip_direction[contact + 1],
                            ];
                            let [c, d] = [
                                next.slip_direction[contact],
                                next.slip_direction[contact + 1],
                            ];
                            (a * d - b * c).abs() > SAME || a * c + b * d < 0.0
                        });
                        found = Some(next);
                    }
                });
                let next = found.filter(|_| !several)?;
                for k in [contact, contact + 1] {
                    turned = turned.max((next.slip_direction[k] - mode.slip_direction[k]).abs());
                }
                mode = next;
            }
            if turned <= SETTLED {
                return Some(mode);
            }
        }
        None
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

/// Shares the forces of a group. A guide presses to either side, so all combinations are tried for contacts whose normal reactions depend on
/// what is shared.
fn share_group(
    (sharers, by, groups, group): (&[Sharer], &[f64], &[usize], usize),
    shared: &mut Shared,
) {
    let (count, free) = (sharers.len(), groups.len());
    let of_contact = |k: usize| &by[PARTS * free * k..][..PARTS * free];
    let (mut turning, mut number) = ([0; MOST_CONTACTS], 0);
    for k in (0..count).filter(|k| shares::is_in(of_contact(*k), groups, group)) {
        if of_contact(k)[..free].iter().any(|x| *x != 0.0) {
            turning[number] = k;
            number += 1;
        }
    }
    let mut best = f64::NEG_INFINITY;
    for combination in 0..1_usize << number {
        let mut sided = [Sharer::default(); MOST_CONTACTS];
        sided[..count].copy_from_slice(sharers);
        let mut sided_by = [0.0; PARTS * MOST_CONTACTS * MOST_CONTACTS];
        sided_by[..by.len()].copy_from_slice(by);
        for (k, sharer) in sided[..count].iter_mut().enumerate() {
            let side = match turning[..number].iter().position(|turning| *turning == k) {
                Some(place) if combination >> place & 1 != 0 => -1.0,
                Some(_) => 1.0,
                None => sharer.normal.signum(),
            };
            sharer.normal *= side;
            let normals = &mut sided_by[PARTS * free * k..][..free];
            normals.iter_mut().for_each(|x| *x *= side);
        }
        let mut numbers = [0.0; shares::numbers_length(MOST_CONTACTS, MOST_CONTACTS)];
        let mut places = [0; shares::places_length(MOST_CONTACTS, MOST_CONTACTS)];
        let (mut undetermined, mut limits) = ([0.0; MOST_CONTACTS], [None; MOST_CONTACTS]);
        let margin = shares::share(
            &sided[..count],
            (&sided_by[..by.len()], groups, group),
            (
                &mut numbers[..shares::numbers_length(count, free)],
                &mut places[..shares::places_length(count, free)],
            ),
            (&mut undetermined, &mut limits),
        );
        let Some(margin) = margin.filter(|margin| margin.value > best) else {
            continue;
        };
        best = margin.value;
        for i in (0..free).filter(|i| groups[*i] == group) {
            shared.undetermined[i] = undetermined[i];
        }
        for k in (0..count).filter(|k| shares::is_in(of_contact(*k), groups, group)) {
            shared.margin[k] = Some(margin.value);
            shared.residual[k] = margin.residual;
            shared.limit[k] = limits[k];
            shared.group[k] = group;
        }
    }
}

/// The directions along which the normal reactions of the contacts are measured.
type Sides = [[f64; 3]; MOST_CONTACTS];

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

/// Friction forces that the equations of contacts in given states leave open.
#[derive(Clone, Copy)]
struct Undetermined {
    /// How many of the forces are undetermined.
    number: usize,
    /// What a unit of each of them adds to all friction forces.
    of_unit: [Each; MOST_CONTACTS],
}

impl Undetermined {
    const NONE: Undetermined = Undetermined {
        number: 0,
        of_unit: [[0.0; MOST_CONTACTS]; MOST_CONTACTS],
    };

    /// From equations that [`eliminate`] has solved.
    fn of(
        rows: &[[f64; MOST_CONTACTS + 1]; MOST_CONTACTS],
        count: usize,
        column_of: [Option<usize>; MOST_CONTACTS],
    ) -> Undetermined {
        let mut undetermined = Undetermined::NONE;
        for free in (0..count).filter(|j| !column_of.contains(&Some(*j))) {
            let of_unit = &mut undetermined.of_unit[undetermined.number];
            of_unit[free] = 1.0;
            for (row, column) in rows.iter().zip(column_of) {
                if let Some(j) = column {
                    of_unit[j] = beyond(-row[free] / row[j], SINGULAR);
                }
            }
            undetermined.number += 1;
        }
        undetermined
    }
}

/// A number, or 0 if it is no more than its rounding.
fn beyond(x: f64, rounding: f64) -> f64 {
    if x.abs() > rounding { x } else { 0.0 }
}

/// How guides that depend on each other share their forces: by (E78).
#[derive(Clone, Copy, Debug)]
pub(super) struct Shared {
    /// The undetermined forces.
    undetermined: Each,
    /// The margin of each contact that shares forces with others: by how much the normal reactions of all of them could be smaller.
    pub margin: [Option<f64>; MOST_CONTACTS],
    /// By how much a greater margin may be possible.
    residual: Each,
    /// How each contact limits the margin.
    pub limit: [Option<Limit>; MOST_CONTACTS],
    /// With which others it shares: contacts with the same number.
    pub group: [usize; MOST_CONTACTS],
}

impl Shared {
    const NONE: Shared = Shared {
        undetermined: [0.0; MOST_CONTACTS],
        margin: [None; MOST_CONTACTS],
        residual: [0.0; MOST_CONTACTS],
        limit: [None; MOST_CONTACTS],
        group: [0; MOST_CONTACTS],
    };
}

impl Shared {
    fn least_margin(&self) -> f64 {
        let known = self.margin.iter().flatten();
        known.copied().reduce(f64::min).unwrap_or(f64::NEG_INFINITY)
    }
}

/// The state that a contact enters when its normal reaction is zero: its index, its motion, and the side to which it presses.
pub(super) type Turned = (usize, Motion, f64);

/// The states that are unknown when the state of a contact ends.
#[derive(Clone, Copy)]
pub(super) struct OpenStates {
    /// The motion of each contact, if known.
    pub motion: [Option<Motion>; MOST_CONTACTS],
    /// The direction of each contact that is known to slide; 0 if the direction is unknown too.
    pub slip_direction: Each,
    /// A state that has just proved impossible: a contact, its motion, and possibly the side to which it presses.
    pub excluded: Option<(usize, Motion, Option<f64>)>,
    /// The contact that presses to the other side from here on, unless it stops.
    pub turned: Option<Turned>,
}

impl OpenStates {
    /// If only the slips are known: contacts with a slip slide, the states of the others are unknown.
    pub fn from_slips(slips: &Each, layout: Layout) -> OpenStates {
        let sliding = |slip: f64| (slip != 0.0).then_some(Motion::Slides(slip.signum()));
        let mut open_states = OpenStates {
            motion: slips.map(sliding),
            slip_direction: [0.0; MOST_CONTACTS],
            excluded: None,
            turned: None,
        };
        for k in (0..layout.contacts()).filter(|k| layout.has_second(*k)) {
            let speed = length([slips[k], slips[k + 1]]);
            for k in [k, k + 1] {
                open_states.motion[k] = (speed != 0.0).then_some(Motion::SlidesAlong);
                open_states.slip_direction[k] = if speed != 0.0 { slips[k] / speed } else { 0.0 };
            }
        }
        open_states
    }

    /// The unique solution.
    ///
    /// If static friction exceeds sliding friction, both may be possible; then the contact sticks.
    pub fn answer(&self, parts: &Parts<'_>) -> Result<(Mode, Each), Paradox> {
        let count = parts.layout.contacts();
        let holds_more = (0..count)
            .any(|k| self.motion[k].is_none() && parts.static_friction(k) > parts.friction(k));
        let sticking = |mode: &Mode| {
            let all = mode.motion[..count].iter();
            all.filter(|motion| **motion == Motion::Sticks).count()
        };
        let mut best: Option<(Mode, Each)> = None;
        let mut several = None;
        let mut unknown = None;
        let mut look = |mode: Mode, friction_forces: Each| {
            // That a contact slides may be known without its direction.
            let is_asked = |k: usize| {
                let slides =
                    self.motion[k] == Some(Motion::SlidesAlong) && parts.layout.has_second(k);
                slides && self.slip_direction[k] == 0.0 && self.slip_direction[k + 1] == 0.0
            };
            let accelerates_in_its_direction = |k: usize| {
                let is_known = self.motion[k].is_some() && !is_asked(k);
                is_known || parts.accelerates_in_its_direction(&mode, &friction_forces, k)
            };
            if !parts.admits(&mode, &friction_forces, self.turned)
                || !(0..count).all(accelerates_in_its_direction)
            {
                return;
            }
            let Some((known, other)) = &best else {
                best = Some((mode, friction_forces));
                return;
            };
            let more = sticking(&mode).cmp(&sticking(known));
            if parts.same(&friction_forces, other) {
                if more.is_gt() {
                    best = Some((mode, friction_forces));
                }
            } else if holds_more && more.is_ne() {
                if more.is_gt() {
                    best = Some((mode, friction_forces));
                    several = None;
                }
            } else {
                let differs = |k: &usize| {
                    known.motion[*k] != mode.motion[*k] || known.press[*k] != mode.press[*k]
                };
                several = several.or((0..count).find(differs)).or(Some(0));
            }
        };
        self.each(parts.layout, &mut |mode| {
            let (mut open, mut number) = ([0; MOST_CONTACTS], 0);
            for k in 0..count {
                let slides = mode.motion[k] == Motion::SlidesAlong && parts.layout.has_second(k);
                if slides && mode.slip_direction[k] == 0.0 && mode.slip_direction[k + 1] == 0.0 {
                    open[number] = k;
                    number += 1;
                }
            }
            let known = parts.each_slip_direction(mode, &open[..number], &mut look);
            if !known {
                unknown = (0..count).find(|k| mode.motion[*k] != Motion::Sticks);
            }
        });
        // With normal reactions that friction does not change, the accelerations minimize a strictly convex function, so there are no others.
        // With more friction at rest this holds for what sticks.
        let is_proved = |(mode, _): &(Mode, Each)| {
            let mut asked = (0..count).filter(|k| self.motion[*k].is_none());
            parts.presses_regardless_of_friction()
                && (!holds_more || asked.all(|k| mode.motion[k] == Motion::Sticks))
        };
        let unknown = unknown.filter(|_| !best.as_ref().is_some_and(is_proved));
        match (best, several.or(unknown)) {
            (Some(best), None) => Ok(best),
            (Some(_), Some(contact)) => Err(Paradox {
                contact,
                several: true,
            }),
            (None, _) => Err(Paradox {
                contact: self.excluded.map_or(0, |(contact, ..)| contact),
                several: false,
            }),
        }
    }

    /// Calls `look` with every combination of states that the question leaves open.
    fn each(&self, layout: Layout, look: &mut dyn FnMut(Mode)) {
        const IN_PLANE: [(Motion, f64); 5] = [
            (Motion::Sticks, 1.0),
            (Motion::Slides(1.0), 1.0),
            (Motion::Slides(1.0), -1.0),
            (Motion::Slides(-1.0), 1.0),
            (Motion::Slides(-1.0), -1.0),
        ];
        // In space a guide has no sides.
        const IN_SPACE: [(Motion, f64); 3] = [IN_PLANE[0], IN_PLANE[1], IN_PLANE[3]];
        const ON_SURFACE: [(Motion, f64); 2] = [IN_PLANE[0], (Motion::SlidesAlong, 1.0)];
        let count = layout.contacts();
        let states = |k: usize| match layout.axes() {
            1 => &IN_PLANE[..],
            _ if layout.has_second(k) => &ON_SURFACE[..],
            // The second tangent follows the first.
            _ if layout.is_second(k) => &ON_SURFACE[..1],
            _ => &IN_SPACE[..],
        };
        let mut digits = [0; MOST_CONTACTS];
        loop {
            let mut mode = Mode {
                motion: [Motion::Sticks; MOST_CONTACTS],
                press: [1.0; MOST_CONTACTS],
                slip_direction: [0.0; MOST_CONTACTS],
            };
            let mut is_open = true;
            for (k, &digit) in digits[..count].iter().enumerate() {
                (mode.motion[k], mode.press[k]) = if layout.is_second(k) {
                    (mode.motion[k - 1], 1.0)
                } else {
                    states(k)[digit]
                };
                if mode.motion[k] == Motion::SlidesAlong {
                    mode.slip_direction[k] = self.slip_direction[k];
                }
                is_open &= self.motion[k].is_none_or(|known| known == mode.motion[k]);
                if let Some((contact, motion, press)) = self.excluded
                    && contact == k
                {
                    let same_side = press.is_none_or(|press| press == mode.press[k]);
                    is_open &= !(motion == mode.motion[k] && same_side);
                }
            }
            if is_open {
                look(mode);
            }
            let next = (0..count).find(|k| digits[*k] + 1 < states(*k).len());
            let Some(next) = next else {
                return;
            };
            digits[next] += 1;
            digits[..next].fill(0);
        }
    }
}

/// The unknown friction forces of sliding contacts in space: `f = μ |A + B f|`.
struct Sizes {
    number: usize,
    coefficients: Each,
    /// `A` of each contact, followed by the columns of `B`.
    pressing: [[[f64; 3]; MOST_CONTACTS + 1]; MOST_CONTACTS],
}

impl Sizes {
    /// Calls `look` with all solutions; returns false if there may be others.
    fn each(&self, look: &mut dyn FnMut(&Each)) -> bool {
        match self.number {
            0 => {
                look(&[0.0; MOST_CONTACTS]);
                true
            }
            1 => {
                self.of_one(look);
                true
            }
            _ => {
                if self.is_contraction() {
                    self.by_newton().iter().for_each(look);
                    true
                } else {
                    false
                }
            }
        }
    }

    /// Finds the nonnegative roots of `(1 − μ²B²) f² − 2μ² A·B f − μ²A² = 0`.
    fn of_one(&self, look: &mut dyn FnMut(&Each)) {
        let [a, b] = [self.pressing[0][0], self.pressing[0][1]];
        let square = self.coefficients[0] * self.coefficients[0];
        let (first, half, last) = (
            1.0 - square * dot(&b, &b),
            square * dot(&a, &b),
            square * dot(&a, &a),
        );
        let discriminant = half * half + first * last;
        let mut found = |size: f64| {
            let mut sizes = [0.0; MOST_CONTACTS];
            sizes[0] = size;
            look(&sizes);
        };
        let root = crate::math::sqrt(discriminant.max(0.0));
        if last == 0.0 {
            found(0.0);
        } else if first > 0.0 {
            // The other root is negative. Avoids cancellation.
            found(if half >= 0.0 {
                (half + root) / first
            } else {
                last / (root - half)
            });
        } else if half < 0.0 && discriminant >= 0.0 {
            // Pressing harder would increase the reaction further: there are two motions or none (P. Painlevé).
            found(last / (root - half));
            if first < 0.0 && discriminant > 0.0 {
                found((half - root) / first);
            }
        }
    }

    /// Whether `f ↦ μ |A + B f|` is a contraction in some norm, so that it has a unique fixed point (S. Banach). Forces change by
    /// at most `L = μ |B|` times the change of others, and the spectral radius of a nonnegative matrix is below 1 if and only if
    /// `(1 − L) x = 1` has a nonnegative solution (A. Berman, R. J. Plemmons, *Nonnegative Matrices in the Mathematical Sciences*,
    /// 1979, chapter 6, condition N38).
    fn is_contraction(&self) -> bool {
        let mut rows = [[0.0; MOST_CONTACTS + 1]; MOST_CONTACTS];
        for (i, row) in rows[..self.number].iter_mut().enumerate() {
            for (j, x) in row[..self.number].iter_mut().enumerate() {
                let by = &self.pressing[i][1 + j];
                *x = -self.coefficients[i] * crate::math::sqrt(dot(by, by));
            }
            row[i] += 1.0;
            row[self.number] = 1.0;
        }
        let solved = solve(&mut rows, self.number);
        solved.is_some_and(|x| x[..self.number].iter().all(|x| *x > 0.0))
    }

    /// The fixed point of a contraction. Newton's step linearizes the length of a reaction as its product with its present
    /// direction. If a step does not reduce the residual, it is replaced by the step of the contraction, which does.
    fn by_newton(&self) -> Option<Each> {
        let number = self.number;
        let mut sizes = [0.0; MOST_CONTACTS];
        let mut off = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let mut rows = [[0.0; MOST_CONTACTS + 1]; MOST_CONTACTS];
            let mut contracted = [0.0; MOST_CONTACTS];
            let mut here = 0.0_f64;
            for (i, row) in rows[..number].iter_mut().enumerate() {
                let mut vector = self.pressing[i][0];
                for (by, size) in self.pressing[i][1..=number].iter().zip(sizes) {
                    for (x, by) in vector.iter_mut().zip(by) {
                        *x += by * size;
                    }
                }
                let length = crate::math::sqrt(dot(&vector, &vector));
                contracted[i] = self.coefficients[i] * length;
                here = here.max((sizes[i] - contracted[i]).abs());
                let factor = if length > 0.0 {
                    self.coefficients[i] / length
                } else {
                    0.0
                };
                for (j, x) in row[..number].iter_mut().enumerate() {
                    *x = -factor * dot(&vector, &self.pressing[i][1 + j]);
                }
                row[i] += 1.0;
                row[number] = factor * dot(&vector, &self.pressing[i][0]);
            }
            let largest = contracted.iter().fold(0.0_f64, |most, x| most.max(*x));
            if here <= 4.0 * f64::EPSILON * largest {
                return Some(contracted);
            }
            sizes = match solve(&mut rows, number) {
                Some(next) if here < off => next,
                _ => contracted,
            };
            off = here;
        }
        None
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

/// Solves `count` equations, whose right-hand sides are in the last column, by Gaussian elimination with complete pivoting.
/// Undetermined unknowns become 0; `None` if the equations contradict each other.
pub(super) fn solve(
    rows: &mut [[f64; MOST_CONTACTS + 1]; MOST_CONTACTS],
    count: usize,
) -> Option<Each> {
    eliminate(rows, count).map(|(solution, _)| solution)
}

/// Eliminates like [`solve`], and returns the unknown for which each row has been solved.
fn eliminate(
    rows: &mut [[f64; MOST_CONTACTS + 1]; MOST_CONTACTS],
    count: usize,
) -> Option<(Each, [Option<usize>; MOST_CONTACTS])> {
    let rows = &mut rows[..count];
    for row in rows.iter_mut() {
        let most = row[..count]
            .iter()
            .fold(0.0_f64, |most, x| most.max(x.abs()));
        if most > 0.0 {
            row[..=count].iter_mut().for_each(|x| *x /= most);
        }
    }
    let largest = rows
        .iter()
        .fold(0.0_f64, |most, row| most.max(row[count].abs()));
    let mut column_of = [None; MOST_CONTACTS];
    for done in 0..count {
        let mut pivot = (0.0, 0, 0);
        for (i, row) in rows.iter().enumerate().skip(done) {
            for (j, x) in row[..count].iter().enumerate() {
                if x.abs() > pivot.0 {
                    pivot = (x.abs(), i, j);
                }
            }
        }
        let (size, i, j) = pivot;
        if size <= SINGULAR || size.is_nan() {
            let open = rows[done..].iter().map(|row| row[count].abs());
            if open.fold(0.0_f64, f64::max) > SAME * largest {
                return None;
            }
            break;
        }
        rows.swap(done, i);
        column_of[done] = Some(j);
        let own = rows[done];
        for (other, row) in rows.iter_mut().enumerate() {
            if other == done {
                continue;
            }
            let factor = row[j] / own[j];
            for (x, y) in row[..=count].iter_mut().zip(own) {
                *x -= factor * y;
            }
            row[j] = 0.0;
        }
    }
    let mut solution = [0.0; MOST_CONTACTS];
    for (row, column) in rows.iter().zip(column_of) {
        if let Some(j) = column {
            solution[j] = row[count] / row[j];
        }
    }
    let is_finite = solution.iter().all(|x| x.is_finite());
    is_finite.then_some((solution, column_of))
}
