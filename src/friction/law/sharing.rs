//! How guides that depend on each other share forces that the equations leave undetermined.

use super::super::per_contact::{FEW_CONTACTS, PerContact, Values};
use super::elimination::{Equations, SINGULAR};
use super::{Each, Mode, Motion, Parts, ROUNDING, dot, unit};
use crate::contact_law::shares::{self, Limit, PARTS, Sharer};

impl Parts<'_> {
    /// Replaces forces that the equations leave undetermined, which are 0 in `forces`, by those that sticking guides allow best.
    pub(super) fn share(
        &self,
        mode: &Mode,
        mut forces: Each,
        undetermined: &Undetermined,
    ) -> (Each, Shared) {
        let count = self.layout.contacts();
        // Where friction of what slides is undetermined, so is the motion, and nothing is shared.
        let slides = |k: &usize| mode.motion[*k] != Motion::Sticks;
        let moves = |of_unit: &[f64]| {
            (0..count).filter(slides).any(|k| {
                let in_space = self.layout.axes() != 1 && self.presses_by(k, of_unit) != [0.0; 3];
                of_unit[k] != 0.0 || in_space
            })
        };
        let mut shared = Shared::none(count);
        if undetermined.number == 0 || undetermined.of_units().any(moves) {
            return (forces, shared);
        }
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
        for (of_unit, y) in undetermined.of_units().zip(&*shared.undetermined) {
            for (force, x) in forces.iter_mut().zip(of_unit) {
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
        // What each undetermined force adds to the forces of each contact.
        let mut by: Effects = Effects::new(PARTS * free * count, 0.0);
        let mut sharers = PerContact::new(count, Sharer::default());
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
            for (i, of_unit) in undetermined.of_units().enumerate() {
                normals[i] = dot(&self.presses_by(k, of_unit), &sides[k]);
                tangentials[i] = of_unit[k];
                if has_second {
                    tangentials[free + i] = of_unit[k + 1];
                }
            }
        }
        let mut groups = PerContact::new(free, 0);
        shares::group(&by, &mut groups);
        for group in 0..free {
            if groups[group] == group {
                share_group((&sharers, &by, &groups, group), shared);
            }
        }
    }

    /// The directions along which normal reactions are measured: in the plane they are numbers, on a surface along its normal, and at a curve
    /// across it, where its reaction is without undetermined forces.
    fn sides(&self, mode: &Mode, forces: &Each, undetermined: &Undetermined) -> Sides {
        let mut sides = Sides::new(self.layout.contacts(), [1.0, 0.0, 0.0]);
        if self.layout.axes() == 1 {
            return sides;
        }
        for (k, side) in sides.iter_mut().enumerate() {
            if mode.motion[k] != Motion::Sticks {
                continue;
            }
            let on_surface = self.layout.is_second(k) || self.layout.has_second(k);
            *side = if on_surface {
                self.direction(k)
            } else {
                let by = undetermined
                    .of_units()
                    .map(|of_unit| self.presses_by(k, of_unit));
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
            let mut depends = false;
            for (of_unit, y) in undetermined.of_units().zip(&*shared.undetermined) {
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

/// Shares the forces of a group. A guide presses to either side: of contacts whose normal reactions depend on what is shared, all combinations
/// of sides are tried if they are few, and else one after the other is turned as long as that helps.
fn share_group(
    (sharers, by, groups, group): (&[Sharer], &[f64], &[usize], usize),
    shared: &mut Shared,
) {
    let free = groups.len();
    let of_contact = |k: usize| &by[PARTS * free * k..][..PARTS * free];
    let turns = |k: &usize| {
        let own = of_contact(*k);
        shares::is_in(own, groups, group) && own[..free].iter().any(|x| *x != 0.0)
    };
    let turning = || (0..sharers.len()).filter(turns);
    // Every other contact presses as it does without undetermined forces.
    let mut sides = Each::from_fn(sharers.len(), |k| {
        if turns(&k) {
            1.0
        } else {
            sharers[k].normal.signum()
        }
    });
    let of_group = (sharers, by, groups, group);
    let mut best = f64::NEG_INFINITY;
    if turning().count() <= FEW_CONTACTS {
        for combination in 0..1_usize << turning().count() {
            for (place, k) in turning().enumerate() {
                sides[k] = if combination >> place & 1 != 0 {
                    -1.0
                } else {
                    1.0
                };
            }
            share_on_sides(of_group, &sides, &mut best, shared);
        }
        return;
    }
    share_on_sides(of_group, &sides, &mut best, shared);
    for _ in 0..MOST_TURNS {
        let before = best;
        for k in turning() {
            let so_far = best;
            sides[k] = -sides[k];
            share_on_sides(of_group, &sides, &mut best, shared);
            if best <= so_far {
                sides[k] = -sides[k];
            }
        }
        if best <= before {
            return;
        }
    }
}

/// Shares the forces of a group whose contacts press to given sides, if that gives more than the best margin so far.
fn share_on_sides(
    (sharers, by, groups, group): (&[Sharer], &[f64], &[usize], usize),
    sides: &Each,
    best: &mut f64,
    shared: &mut Shared,
) {
    let (count, free) = (sharers.len(), groups.len());
    let of_contact = |k: usize| &by[PARTS * free * k..][..PARTS * free];
    let mut sided_by: Effects = Effects::new(by.len(), 0.0);
    sided_by.copy_from_slice(by);
    for (own, side) in sided_by.chunks_exact_mut(PARTS * free).zip(&**sides) {
        own[..free].iter_mut().for_each(|x| *x *= side);
    }
    let sided = PerContact::from_fn(count, |k| Sharer {
        normal: sides[k] * sharers[k].normal,
        ..sharers[k]
    });
    let mut numbers: Values<f64, { shares::numbers_length(FEW_CONTACTS, FEW_CONTACTS) }> =
        Values::new(shares::numbers_length(count, free), 0.0);
    let mut places: Values<usize, { shares::places_length(FEW_CONTACTS, FEW_CONTACTS) }> =
        Values::new(shares::places_length(count, free), 0);
    let (mut undetermined, mut limits) = (Each::new(free, 0.0), PerContact::new(count, None));
    let margin = shares::share(
        &sided,
        (&sided_by, groups, group),
        (&mut numbers, &mut places),
        (&mut undetermined, &mut limits),
    );
    let Some(margin) = margin.filter(|margin| margin.value > *best) else {
        return;
    };
    *best = margin.value;
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

/// What undetermined forces add to the forces of contacts.
type Effects = Values<f64, { PARTS * FEW_CONTACTS * FEW_CONTACTS }>;

/// The directions along which the normal reactions of the contacts are measured.
type Sides = PerContact<[f64; 3]>;

/// Friction forces that the equations of contacts in given states leave open.
#[derive(Clone)]
pub(super) struct Undetermined {
    /// How many of the forces are undetermined.
    pub(super) number: usize,
    /// What a unit of each of them adds to all friction forces, one list after the other.
    of_unit: Values<f64, { FEW_CONTACTS * FEW_CONTACTS }>,
    /// The number of contacts.
    contacts: usize,
}

impl Undetermined {
    /// That nothing is undetermined.
    pub(super) fn none(contacts: usize) -> Undetermined {
        Undetermined {
            number: 0,
            of_unit: Values::new(0, 0.0),
            contacts,
        }
    }

    /// From equations that have been [eliminated](Equations::eliminate).
    pub(super) fn of(equations: &Equations, column_of: &PerContact<Option<usize>>) -> Undetermined {
        let contacts = column_of.len();
        let is_free = |j: &usize| !column_of.contains(&Some(*j));
        let number = (0..contacts).filter(is_free).count();
        if number == 0 {
            return Self::none(contacts);
        }
        let mut of_unit = Values::new(number * contacts, 0.0);
        for (free, of_unit) in (0..contacts)
            .filter(is_free)
            .zip(of_unit.chunks_exact_mut(contacts))
        {
            of_unit[free] = 1.0;
            for (row, column) in equations.rows().zip(&**column_of) {
                if let Some(j) = column {
                    of_unit[*j] = beyond(-row[free] / row[*j], SINGULAR);
                }
            }
        }
        Undetermined {
            number,
            of_unit,
            contacts,
        }
    }

    /// What a unit of each undetermined force adds to all friction forces.
    fn of_units(&self) -> impl Iterator<Item = &[f64]> {
        self.of_unit.chunks_exact(self.contacts.max(1))
    }
}

/// A number, or 0 if it is no more than its rounding.
pub(super) fn beyond(x: f64, rounding: f64) -> f64 {
    if x.abs() > rounding { x } else { 0.0 }
}

/// How guides that depend on each other share their forces: by (E78).
#[derive(Clone, Debug)]
pub(in crate::friction) struct Shared {
    /// The undetermined forces.
    undetermined: Each,
    /// The margin of each contact that shares forces with others: by how much the normal reactions of all of them could be smaller.
    pub margin: PerContact<Option<f64>>,
    /// A bound on how much larger the margin could be.
    residual: Each,
    /// How each contact limits the margin.
    pub limit: PerContact<Option<Limit>>,
    /// The number of the group of contacts that share their load; it is the same for all of them.
    pub group: PerContact<usize>,
}

impl Shared {
    fn none(contacts: usize) -> Shared {
        Shared {
            undetermined: Each::new(contacts, 0.0),
            margin: PerContact::new(contacts, None),
            residual: Each::new(contacts, 0.0),
            limit: PerContact::new(contacts, None),
            group: PerContact::new(contacts, 0),
        }
    }
}
