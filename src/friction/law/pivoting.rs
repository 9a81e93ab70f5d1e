//! The states of contacts that depend on each other, by one complementarity problem.
//!
//! In the plane a guide is a pair of opposite contacts, and all guides together are a linear complementarity problem, which is solved by pivoting.
//! In space |N| is the length of a vector: with given lengths the problem is one of friction alone, and the lengths are a fixed point. Either way
//! the forces only tell the states, with which the equations of motion are then solved as in every step, and all conditions are checked.

use std::vec;
use std::vec::Vec;

use super::{Each, Mode, Motion, OpenStates, Parts, length};
use crate::contact_law::problem::{self, ContactUnknowns};

/// A slip rate below this, relative to its terms, is 0 as far as the solution of a complementarity problem shows.
const AT_REST: f64 = 1e-9;

/// The lengths of reactions are a fixed point if they change by no more than this, relative to the greatest.
const SETTLED: f64 = 4.0 * f64::EPSILON;

/// The largest number of iterations for them: a contraction by a factor of 0.9 takes this many for sixteen digits.
const MOST_STEPS: usize = 400;

impl OpenStates {
    /// A motion that is possible, if one is found.
    ///
    /// What cannot be held by static friction slides, with less friction, and the others are asked again.
    pub(super) fn by_pivoting(&self, parts: &Parts<'_>) -> Option<(Mode, Each)> {
        let mut open = self.clone();
        loop {
            let forces = match parts.layout.axes() {
                1 => open.in_plane(parts).or_else(|| open.by_lengths(parts))?,
                _ => open.by_lengths(parts)?,
            };
            let mode = open.mode_with(parts, &forces);
            let (mode, forces) = open.polished(parts, mode)?;
            let is_weaker = |k: &usize| {
                open.motion[*k].is_none()
                    && mode.motion[*k] != Motion::Sticks
                    && parts.static_friction(*k) > parts.friction(*k)
            };
            let weaker: Vec<usize> = (0..parts.layout.contacts()).filter(is_weaker).collect();
            if weaker.is_empty() {
                return self
                    .permits(parts, &mode, &forces)
                    .then_some((mode, forces));
            }
            for k in weaker {
                open.motion[k] = Some(mode.motion[k]);
                open.slip_direction[k] = mode.slip_direction[k];
            }
        }
    }

    /// Whether this is a motion among those in question.
    fn permits(&self, parts: &Parts<'_>, mode: &Mode, forces: &Each) -> bool {
        let mut contacts = 0..parts.layout.contacts();
        parts.admits(mode, forces, self.turned)
            && contacts.all(|k| {
                let is_known = self.motion[k].is_some() && !self.asks_direction(parts, k);
                !self.excludes(mode, k)
                    && self.motion[k].is_none_or(|known| known == mode.motion[k])
                    && (is_known || parts.accelerates_in_its_direction(mode, forces, k))
            })
    }

    /// Whether a contact on a surface slides in a direction that is not known.
    fn asks_direction(&self, parts: &Parts<'_>, contact: usize) -> bool {
        let first = contact - usize::from(parts.layout.is_second(contact));
        self.motion[first] == Some(Motion::SlidesAlong)
            && self.slip_direction[first] == 0.0
            && self.slip_direction[first + 1] == 0.0
    }

    /// Friction forces in the plane.
    fn in_plane(&self, parts: &Parts<'_>) -> Option<Each> {
        let count = parts.layout.contacts();
        let unknowns: Vec<ContactUnknowns> = (0..count)
            .map(|k| match self.motion[k] {
                Some(Motion::Slides(sign)) => ContactUnknowns::SlidingGuide {
                    friction: parts.friction(k),
                    forward: sign > 0.0,
                },
                _ => ContactUnknowns::Guide {
                    friction: parts.static_friction(k),
                },
            })
            .collect();
        let width = 2 * count;
        let (mut g, mut b) = (vec![0.0; width * width], vec![0.0; width]);
        for k in 0..count {
            let (normal, slip) = (parts.components(k).start, parts.slip_rate(k));
            // Reactions are multiplied by the mobility along the guide, so that they are accelerations as well.
            let own = parts.at(1 + k, slip).abs();
            let mobility = if own > 0.0 { own } else { 1.0 };
            g[2 * k * width + 2 * k] = mobility;
            b[2 * k] = mobility * parts.at(0, normal);
            b[2 * k + 1] = parts.at(0, slip);
            for j in 0..count {
                g[2 * k * width + 2 * j + 1] = mobility * parts.at(1 + j, normal);
                g[(2 * k + 1) * width + 2 * j + 1] = parts.at(1 + j, slip);
            }
        }
        let answer = problem::solve(&unknowns, &g, &b, None).ok()?;
        Some(Each::from_fn(count, |k| answer.forces[k][1]))
    }

    /// Friction forces as a fixed point of the normal forces.
    fn by_lengths(&self, parts: &Parts<'_>) -> Option<Each> {
        let count = parts.layout.contacts();
        let width = 2 * count;
        let mut g = vec![0.0; width * width];
        for k in 0..count {
            for j in 0..count {
                g[(2 * k + 1) * width + 2 * j + 1] = parts.at(1 + j, parts.slip_rate(k));
            }
        }
        let is_known = |k: usize| {
            matches!(
                self.motion[k],
                Some(Motion::Slides(_) | Motion::SlidesAlong)
            ) && !self.asks_direction(parts, k)
        };
        let direction = |k: usize| match self.motion[k] {
            Some(Motion::Slides(sign)) => sign,
            _ => self.slip_direction[k],
        };
        let mut forces = Each::new(count, 0.0);
        let mut normals = Each::from_fn(count, |k| parts.reaction(k, &forces)[0].abs());
        for _ in 0..MOST_STEPS {
            let mut b = vec![0.0; width];
            for k in (0..count).filter(|k| is_known(*k)) {
                forces[k] = -parts.friction(k) * normals[k] * direction(k);
            }
            for k in 0..count {
                let slip = parts.slip_rate(k);
                let known = (0..count).filter(|j| is_known(*j));
                let by_known: f64 = known.map(|j| parts.at(1 + j, slip) * forces[j]).sum();
                b[2 * k + 1] = parts.at(0, slip) + by_known;
            }
            let unknowns: Vec<ContactUnknowns> = (0..count)
                .map(|k| match (is_known(k), parts.layout.is_second(k)) {
                    (true, _) => ContactUnknowns::Nothing,
                    (false, true) => ContactUnknowns::SecondTangent,
                    (false, false) => ContactUnknowns::Tangent {
                        friction: match self.motion[k] {
                            Some(Motion::SlidesAlong) => parts.friction(k),
                            _ => parts.static_friction(k),
                        },
                        normal: normals[k],
                    },
                })
                .collect();
            let near: Vec<[f64; 2]> = forces.iter().map(|force| [0.0, *force]).collect();
            let answer = problem::solve(&unknowns, &g, &b, Some(&near)).ok()?;
            for k in (0..count).filter(|k| !is_known(*k)) {
                forces[k] = answer.forces[k][1];
            }
            let next = Each::from_fn(count, |k| parts.reaction(k, &forces)[0].abs());
            let greatest = next.iter().fold(0.0_f64, |most, x| most.max(*x));
            let changes = next.iter().zip(&*normals).map(|(x, y)| (x - y).abs());
            let change = changes.fold(0.0_f64, f64::max);
            normals = next;
            if change <= SETTLED * greatest {
                return Some(forces);
            }
        }
        None
    }

    /// The states that these forces tell.
    fn mode_with(&self, parts: &Parts<'_>, forces: &Each) -> Mode {
        let count = parts.layout.contacts();
        let mut mode = Mode::sticking(count);
        for k in (0..count).filter(|k| !parts.layout.is_second(*k)) {
            let rate = |k: usize| parts.sum(parts.slip_rate(k), forces);
            let has_second = parts.layout.has_second(k);
            let [along, terms] = rate(k);
            let [across, more] = if has_second { rate(k + 1) } else { [0.0; 2] };
            let grows = length([along, across]) > AT_REST * (terms + more);
            mode.motion[k] = match self.motion[k] {
                Some(known) => known,
                None if !grows => Motion::Sticks,
                None if has_second => Motion::SlidesAlong,
                None => Motion::Slides(along.signum()),
            };
            self.set_side(parts, &mut mode, k, forces);
            if !has_second || mode.motion[k] == Motion::Sticks {
                continue;
            }
            mode.motion[k + 1] = mode.motion[k];
            for tangent in [k, k + 1] {
                mode.slip_direction[tangent] = match self.motion[k] {
                    Some(_) if !self.asks_direction(parts, k) => self.slip_direction[tangent],
                    // Against the friction force.
                    _ => -forces[tangent] / parts.used(k, forces),
                };
            }
        }
        mode
    }

    /// Sets the side to which a sliding contact in the plane presses.
    fn set_side(&self, parts: &Parts<'_>, mode: &mut Mode, contact: usize, forces: &Each) {
        let is_turned = self
            .turned
            .filter(|(k, motion, _)| *k == contact && *motion == mode.motion[contact]);
        mode.press[contact] = match (mode.motion[contact], is_turned) {
            (Motion::Slides(_), Some((_, _, press))) => press,
            (Motion::Slides(_), None)
                if parts.layout.axes() == 1 && parts.reaction(contact, forces)[0] < 0.0 =>
            {
                -1.0
            }
            _ => 1.0,
        };
    }

    /// Solves the equations of motion in these states, and changes states that do not go with the forces, until all do.
    fn polished(&self, parts: &Parts<'_>, mut mode: Mode) -> Option<(Mode, Each)> {
        let count = parts.layout.contacts();
        for _ in 0..2 * count + 4 {
            let (mut found, mut several) = (None, false);
            let known = parts.each_solution(&mode, &mut |forces| {
                several |= found.is_some();
                found = Some(forces);
            });
            let forces = found.filter(|_| known && !several)?;
            let before = mode.clone();
            for k in (0..count).filter(|k| !parts.layout.is_second(*k)) {
                self.correct(parts, (&before, &mut mode), k, &forces);
            }
            if mode == before {
                return Some((mode, forces));
            }
        }
        None
    }

    /// Changes the state of a contact that does not go with the forces in the states before.
    fn correct(
        &self,
        parts: &Parts<'_>,
        (before, mode): (&Mode, &mut Mode),
        contact: usize,
        forces: &Each,
    ) {
        let one = |k: usize| parts.admits_one(before, forces, k);
        match before.motion[contact] {
            Motion::Sticks if self.motion[contact].is_none() && !one(contact) => {
                if parts.layout.has_second(contact) {
                    for k in [contact, contact + 1] {
                        mode.motion[k] = Motion::SlidesAlong;
                        mode.slip_direction[k] = -forces[k] / parts.used(contact, forces);
                    }
                } else {
                    mode.motion[contact] = Motion::Slides(-forces[contact].signum());
                }
            }
            Motion::Slides(_) | Motion::SlidesAlong
                if self.motion[contact].is_none()
                    && (!parts.accelerates_in_its_direction(before, forces, contact)
                        || self.excludes(before, contact)) =>
            {
                mode.motion[contact] = Motion::Sticks;
                if parts.layout.has_second(contact) {
                    mode.motion[contact + 1] = Motion::Sticks;
                    (
                        mode.slip_direction[contact],
                        mode.slip_direction[contact + 1],
                    ) = (0.0, 0.0);
                }
            }
            Motion::Slides(_) if !one(contact) => mode.press[contact] = -mode.press[contact],
            _ => {}
        }
        if mode.motion[contact] != before.motion[contact] {
            self.set_side(parts, mode, contact, forces);
        }
    }
}
