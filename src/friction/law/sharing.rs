//! How guides that depend on each other share forces that the equations leave undetermined.

use super::super::shares::{Limit, PARTS, Sharer};
use super::super::{MOST_CONTACTS, shares};
use super::elimination::SINGULAR;
use super::{Each, Mode, Motion, Parts, ROUNDING, dot, unit};

impl Parts<'_> {
    /// Replaces forces that the equations leave undetermined, which are 0 in `forces`, by those that sticking guides allow best.
    pub(super) fn share(
        &self,
        mode: &Mode,
        mut forces: Each,
        undetermined: &Undetermined,
    ) -> (Each, Shared) {
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
}

/// How often the directions of reactions at curves in space are turned to where the shared forces have them.
const MOST_TURNS: usize = 50;

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

/// Friction forces that the equations of contacts in given states leave open.
#[derive(Clone, Copy)]
pub(super) struct Undetermined {
    /// How many of the forces are undetermined.
    pub(super) number: usize,
    /// What a unit of each of them adds to all friction forces.
    pub(super) of_unit: [Each; MOST_CONTACTS],
}

impl Undetermined {
    pub(super) const NONE: Undetermined = Undetermined {
        number: 0,
        of_unit: [[0.0; MOST_CONTACTS]; MOST_CONTACTS],
    };

    /// From equations that [`eliminate`] has solved.
    pub(super) fn of(
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
pub(super) fn beyond(x: f64, rounding: f64) -> f64 {
    if x.abs() > rounding { x } else { 0.0 }
}

/// How guides that depend on each other share their forces: by (E78).
#[derive(Clone, Copy, Debug)]
pub(in crate::friction) struct Shared {
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
