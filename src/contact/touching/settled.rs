//! Determines the next state of touching contacts.

use std::vec;
use std::vec::Vec;

use super::super::delassus::{Inertia, matrix};
use super::super::guides::Guides;
use super::super::kinematics::ContactKinematics;
use super::super::problem::{ContactUnknowns, SATURATED};
use super::super::{ContactTrouble, undetermined};
use super::shared::ShareOfLoad;
use super::{Margin, Mode, ROUNDING_OF_FORCES, UnilateralState};
use crate::at::At;
use crate::contact_law::shares::Limit;
use crate::{Singular, StepError, System};

/// How large the residual of a solution may be.
const MOST_RESIDUAL: f64 = 1e-8;

/// Contacts that touch, of which it is asked together what they do next.
struct Settling<'a> {
    touching: &'a UnilateralState,
    here: &'a ContactKinematics,
    t: f64,
    resting: &'a [bool],
    /// What is known of some contacts.
    known_modes: &'a [(usize, Mode)],
    /// The contacts that are asked.
    asked: Vec<usize>,
    /// For each direction of these the acceleration without any contact, and the size of its terms.
    accelerations: Vec<[f64; 2]>,
    /// The products of their images, row after row.
    g: Vec<f64>,
    /// The normal forces that are known, of contacts that yield.
    pressing: Vec<Option<f64>>,
    /// How each slips: from its rate, or found out; none where it may stick.
    slipping: Vec<Option<f64>>,
    /// Which contacts with two tangents are at rest and will slide: in which direction is for their friction to say.
    breaks: Vec<bool>,
    /// What contacts do, of all that there are.
    modes: Vec<Mode>,
    /// Contacts at rest whose friction is used up but which others hold, and how they would slip.
    at_limit: Vec<(usize, Mode)>,
    /// A contact that began to slip last.
    unsettled: usize,
}

/// Forces of the contacts that are asked.
struct SettlingForces {
    /// Those that are known beforehand.
    known: Vec<[f64; 2]>,
    /// The accelerations with these.
    b: Vec<f64>,
    /// Those that have been solved for.
    found: Vec<[f64; 2]>,
    /// The contacts that share their load in another way than by the rule, as their positions among those that are asked.
    shared_otherwise: Vec<usize>,
}

/// What contacts that touch do next.
#[derive(Clone, Debug)]
pub(crate) struct Settled {
    pub modes: Vec<Mode>,
    /// Their forces along normal and tangent. Where a load may be shared in several ways, they are shared in one that every contact allows.
    pub forces: Vec<[f64; 2]>,
    /// The size of the terms of the reaction of each guide, in N; 0 for other contacts.
    pub sizes_of_guides: Vec<f64>,
    /// Contacts that share their load in another way than by the rule for undetermined forces, (E79), although the motion depends on it.
    pub shared_otherwise: Vec<usize>,
    /// Contacts that stick although their friction is used up, because others hold them, and how they would slip.
    pub at_limit: Vec<(usize, Mode)>,
}

impl UnilateralState {
    /// What contacts that touch do next: which of `closed` stay so, and what those of them that are at rest do.
    ///
    /// A contact that slips has a direction, and friction along it. One at rest sticks if it can with its static
    /// friction; if not it slips, with its friction, in the direction in which it is pulled. Of some contacts it may
    /// be known what they do: where a force has just vanished, or friction is used up, nothing else says so.
    pub fn settled<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        closed: &[bool],
        resting: &[bool],
        known_modes: &[(usize, Mode)],
    ) -> Result<Settled, StepError> {
        let At { t, q, v, .. } = at;
        let is_asked = |k: &usize| {
            let pressing = self.carrier[*k].unwrap_or(*k);
            closed[*k] && !known_modes.contains(&(pressing, Mode::Open))
        };
        let asked: Vec<usize> = self.in_order().filter(is_asked).collect();
        if asked.is_empty() {
            return Ok(Settled {
                modes: vec![Mode::Open; closed.len()],
                forces: vec![[0.0; 2]; closed.len()],
                sizes_of_guides: vec![0.0; closed.len()],
                shared_otherwise: Vec::new(),
                at_limit: Vec::new(),
            });
        }
        let free = Self::free(system, at)?;
        let here = self.kinematics(system, (t, q, v));
        let singular = |singular: Singular| StepError::Singular { singular, t };
        let inertia = Inertia::new(system, t, q).map_err(singular)?;
        let mut guides = Guides::default();
        (guides.evaluate(system, (t, q), |direction| here.row(direction))).map_err(singular)?;
        guides.evaluate_loads(system, at);
        let mut settling = Settling::new(
            (self, &here, t),
            (&inertia, &mut guides, &free),
            asked,
            (resting, known_modes),
        );
        for _ in 0..=settling.asked.len() {
            let solved = settling.solve()?;
            if settling.take_modes(&solved) {
                continue;
            }
            let (forces, sizes_of_guides) = settling.forces(&solved);
            let shared_otherwise = solved.shared_otherwise.iter();
            let shared_otherwise = shared_otherwise.map(|place| settling.asked[*place]);
            let shared_otherwise = shared_otherwise.collect();
            let modes = settling.modes;
            let lets_go = |k: usize| match modes[k] {
                Mode::Open => closed[k],
                Mode::Slides(sign) => self.has_friction[k] && sign != 0.0,
                Mode::SlidesAlong(_) => true,
                Mode::Sticks => false,
            };
            let some_let_go =
                known_modes.is_empty() && (0..modes.len()).any(|k| resting[k] && lets_go(k));
            if some_let_go
                && let Some(held) =
                    self.rests_together(system, at, &here, resting, (&modes, &forces))
            {
                return Ok(Settled {
                    sizes_of_guides,
                    ..held
                });
            }
            return Ok(Settled {
                modes,
                forces,
                sizes_of_guides,
                shared_otherwise,
                at_limit: settling.at_limit,
            });
        }
        Err(StepError::Contact {
            contact: self.first(settling.unsettled),
            trouble: ContactTrouble::Unsettled,
            t,
        })
    }

    /// The states and forces with which all contacts at rest stay at rest, if some distribution of the forces that they share permits it. The
    /// solution of the complementarity problem is one distribution, and may release some of them.
    fn rests_together<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        here: &ContactKinematics,
        resting: &[bool],
        (modes, forces): (&[Mode], &[[f64; 2]]),
    ) -> Option<Settled> {
        let at_rest = |k: usize| {
            if self.has_friction[k] {
                Mode::Sticks
            } else {
                Mode::Slides(0.0)
            }
        };
        let held: Vec<Mode> = (modes.iter().enumerate())
            .map(|(k, mode)| if resting[k] { at_rest(k) } else { *mode })
            .collect();
        let mut touching = self.clone();
        touching.set_modes(held);
        for (k, [normal, _]) in forces.iter().enumerate() {
            if self.is_guide(k) && *normal != 0.0 {
                touching.sides[k] = normal.signum();
            }
        }
        let reaction = touching.reaction_here(system, at, here).ok()?;
        let load = touching.shared_load(here, &reaction, at.t).ok()??;
        let free = Self::free(system, at).ok()?;
        let is_still = |direction: &usize| {
            // Its round-off is that of the terms that the forces cancel.
            let [rate, terms] = here.acceleration(*direction, &reaction.a);
            let [_, of_free] = here.acceleration(*direction, &free);
            rate.abs() <= ROUNDING_OF_FORCES * (terms + of_free)
        };
        let holds = |k: usize| match &load.margins[k] {
            Some(ShareOfLoad { margin, .. }) => margin.value > margin.rounding,
            None if touching.modes[k] == Mode::Open || self.across[k] => true,
            None => {
                let normal = load.forces[self.carrier[k].unwrap_or(k)][0];
                // A guide that slides must press to its side.
                let normal = match touching.modes[k] {
                    Mode::Sticks => self.pressing(k, normal),
                    _ => touching.sides[k] * normal,
                };
                let rounding = ROUNDING_OF_FORCES * reaction.sizes[k];
                let used = match (touching.modes[k], self.second(k)) {
                    (Mode::Sticks, None) => load.forces[k][1].abs(),
                    (Mode::Sticks, Some(second)) => load.forces[k][1].hypot(load.forces[second][1]),
                    _ => 0.0,
                };
                normal >= -rounding && used <= here.friction(k)[1] * normal + rounding
            }
        };
        let is_held = touching.held.iter().all(is_still) && (0..modes.len()).all(holds);
        is_held.then_some(Settled {
            modes: touching.modes,
            forces: load.forces,
            sizes_of_guides: Vec::new(),
            shared_otherwise: Vec::new(),
            at_limit: Vec::new(),
        })
    }

    /// The new states of contacts that share forces and no longer hold: of those that limit the shared margin.
    pub fn let_go<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
    ) -> Result<Vec<(usize, Mode)>, StepError> {
        let At { t, q, v, .. } = at;
        let here = self.kinematics(system, (t, q, v));
        let reaction = self.reaction_here(system, at, &here)?;
        let shared = self.shared_load(&here, &reaction, t)?;
        let shared = shared.map_or_else(Vec::new, |load| load.margins);
        let limits = |(k, shared): (usize, Option<ShareOfLoad>)| {
            let ShareOfLoad { margin, limit, .. } = shared?;
            let mode = match limit? {
                Limit::Friction([along, across]) if self.second(k).is_some() => {
                    Mode::SlidesAlong([-along, -across])
                }
                Limit::Friction([along, _]) => Mode::Slides(-along),
                // A guide that slides on presses to its other side then, which is found by its own margin.
                Limit::Pressing if self.is_guide(k) => return None,
                Limit::Pressing => Mode::Open,
            };
            (margin.value < 0.0).then_some((k, mode))
        };
        let mut known: Vec<(usize, Mode)> =
            shared.into_iter().enumerate().filter_map(limits).collect();
        // If some slip, contacts whose normal force has vanished move with them, or lift later.
        if known.iter().any(|(_, mode)| *mode != Mode::Open) {
            known.retain(|(_, mode)| *mode != Mode::Open);
        }
        Ok(known)
    }

    /// These states, corrected where the motion with them contradicts them at once. What slips from rest and is braked sticks, and what exceeds its friction slips.
    /// First those slip whose friction is used up `at_limit` while others hold them: how a load is shared depends on these limits. If no correction leads to
    /// states that hold, they stay as they are.
    pub fn without_contradictions<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        modes: Vec<Mode>,
        (resting, at_limit): (&[bool], &[(usize, Mode)]),
    ) -> Vec<Mode> {
        let slips = |k: usize| resting[k] && matches!(modes[k], Mode::Slides(sign) if sign != 0.0);
        if at_limit.is_empty() && !(0..modes.len()).any(slips) {
            return modes;
        }
        let mut touching = self.clone();
        let mut next = modes.clone();
        let mut tried: Vec<Vec<Mode>> = Vec::new();
        while tried.len() <= 2 * modes.len() && !tried.contains(&next) {
            touching.set_modes(next.clone());
            let Ok(contradicted) = touching.contradicted(system, at, (resting, at_limit)) else {
                break;
            };
            let Some((k, mode)) = contradicted else {
                return next;
            };
            tried.push(next.clone());
            next[k] = mode;
            if let Some(second) = self.second(k) {
                next[second] = mode;
            }
        }
        modes
    }

    /// A contact whose state the motion contradicts, and the state that it would have instead; none if all hold.
    fn contradicted<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        (resting, at_limit): (&[bool], &[(usize, Mode)]),
    ) -> Result<Option<(usize, Mode)>, StepError> {
        let margins = self.margins(system, at)?.each;
        let is_lost = |margin: &Margin| margin.value < -margin.rounding;
        let exceeds = |k: usize| self.modes[k] == Mode::Sticks && is_lost(&margins[k][1]);
        let contacts = || self.in_order();
        if contacts().any(exceeds) {
            let mut limits = at_limit.iter().copied();
            if let Some(limit) = limits.find(|(k, _)| self.modes[*k] == Mode::Sticks) {
                return Ok(Some(limit));
            }
        }
        let here = self.kinematics(system, (at.t, at.q, at.v));
        let reaction = self.reaction_here(system, at, &here)?;
        let is_single = |k: &usize| !self.has_two_tangents(*k);
        if let Some(k) = contacts().filter(is_single).find(|k| exceeds(*k)) {
            return Ok(Some((k, Mode::Slides(-reaction.forces[k][1].signum()))));
        }
        let free = Self::free(system, at)?;
        let is_braked = |k: &usize| {
            let Mode::Slides(sign) = self.modes[*k] else {
                return false;
            };
            let [change, terms] = here.acceleration(2 * k + 1, &reaction.a);
            let [_, of_free] = here.acceleration(2 * k + 1, &free);
            resting[*k] && sign * change < -ROUNDING_OF_FORCES * (terms + of_free)
        };
        let braked = contacts().filter(|k| self.has_friction[*k]).find(is_braked);
        Ok(braked.map(|k| (k, Mode::Sticks)))
    }

    /// These states, with those of some contacts opened that press no more than rounding, and with those opened that these carry.
    pub fn without_unpressed<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        mut modes: Vec<Mode>,
        may_open: impl Fn(usize) -> bool,
    ) -> Result<Vec<Mode>, StepError> {
        let closing: Vec<usize> = (0..modes.len())
            .filter(|k| modes[*k] != Mode::Open && self.carrier[*k].is_none() && may_open(*k))
            .filter(|k| !self.is_guide(*k))
            .collect();
        if closing.is_empty() {
            return Ok(modes);
        }
        let mut touching = self.clone();
        touching.set_modes(modes.clone());
        let margins = touching.margins(system, at)?.each;
        for k in closing {
            let [presses, ..] = margins[k];
            if presses.value <= presses.rounding {
                modes[k] = Mode::Open;
            }
        }
        self.copy_openings_from_carriers(&mut modes);
        Ok(modes)
    }

    /// Lets contacts slip on that did so `before`, are at rest, and have their friction used up `at_limit` against this slip: they have begun to slip at this instant, and
    /// their accelerations cannot tell yet whether they stick. If they stuck, they would have to begin to slip once more.
    pub fn keep_slipping(
        &self,
        modes: &mut [Mode],
        (before, at_limit): (&[Mode], &[(usize, Mode)]),
    ) {
        for &(k, slips) in at_limit {
            let (own, next) = (before[k].direction(), slips.direction());
            if own[0] * next[0] + own[1] * next[1] <= 0.0 {
                continue;
            }
            modes[k] = slips;
            if let Some(second) = self.second(k) {
                modes[second] = slips;
            }
        }
    }

    /// Opens what an open contact carries.
    fn copy_openings_from_carriers(&self, modes: &mut [Mode]) {
        for (k, on) in self.carrier.iter().enumerate() {
            if on.is_some_and(|on| modes[on] == Mode::Open) {
                modes[k] = Mode::Open;
            }
        }
    }
}

impl<'a> Settling<'a> {
    fn new(
        (touching, here, t): (&'a UnilateralState, &'a ContactKinematics, f64),
        (inertia, guides, free): (&Inertia, &mut Guides, &[f64]),
        asked: Vec<usize>,
        (resting, known_modes): (&'a [bool], &'a [(usize, Mode)]),
    ) -> Self {
        let directions: Vec<usize> = asked.iter().flat_map(|k| [2 * k, 2 * k + 1]).collect();
        let images: Vec<Vec<f64>> = (directions.iter())
            .map(|direction| inertia.image(here.row(*direction)))
            .collect();
        let mut g = matrix(&images);
        guides.complete(inertia, &asked, &images, &mut g);
        let accelerations = directions.iter().enumerate();
        let accelerations = accelerations.map(|(row, &direction)| {
            if direction.is_multiple_of(2) && touching.is_guide(direction / 2) {
                // What presses the guide, in the unit of its row.
                let unit = g[row * directions.len() + row];
                return guides
                    .reaction(direction / 2, free, &[])
                    .map(|of| unit * of);
            }
            here.acceleration(direction, free)
        });
        let accelerations = accelerations.collect();
        let pressing = asked.iter().map(|k| {
            let pressing = touching.carrier[*k].unwrap_or(*k);
            let pressed = touching.compliant_force_at_closing(here, pressing);
            pressed.map(|pressed| pressed.force.max(0.0))
        });
        let mut settling = Self {
            touching,
            here,
            t,
            resting,
            known_modes,
            accelerations,
            g,
            pressing: pressing.collect(),
            slipping: Vec::new(),
            breaks: Vec::new(),
            modes: vec![Mode::Open; resting.len()],
            at_limit: Vec::new(),
            unsettled: asked[0],
            asked,
        };
        let places = 0..settling.asked.len();
        settling.slipping = places.map(|place| settling.slip_by_rate(place)).collect();
        let slides = |k: &usize| matches!(settling.known_mode(*k), Some(Mode::SlidesAlong(_)));
        settling.breaks = settling.asked.iter().map(slides).collect();
        settling
    }

    fn known_mode(&self, contact: usize) -> Option<Mode> {
        let mut known = self.known_modes.iter();
        let own = known.find(|(known, _)| *known == contact);
        own.map(|(_, mode)| *mode)
    }

    /// The place of the contact that carries the one at this place, if there is one: the place before it.
    fn carrier(&self, place: usize) -> Option<usize> {
        self.touching.carrier[self.asked[place]].map(|_| place - 1)
    }

    /// The row of the products of a direction.
    fn row(&self, row: usize) -> &[f64] {
        let width = self.accelerations.len();
        &self.g[row * width..][..width]
    }

    /// How a contact slips, by its rate or because it is known; none where it may stick.
    fn slip_by_rate(&self, place: usize) -> Option<f64> {
        let Self { touching, here, .. } = self;
        let k = self.asked[place];
        if !touching.has_friction[k] {
            return Some(0.0);
        }
        match self.known_mode(k) {
            Some(Mode::Slides(sign)) => return Some(sign),
            Some(_) => return None,
            None => {}
        }
        if self.resting[k] {
            return None;
        }
        if touching.has_two_tangents(k) {
            let [slip, _] = touching.slip(here, k);
            return Some(slip[usize::from(touching.across[k])] / slip[0].hypot(slip[1]));
        }
        let slip = here.rates[2 * k + 1];
        let [_, terms] = self.accelerations[2 * place + 1];
        match touching.modes[k] {
            // The sign of a slip that is rounding says nothing: it slips as it did.
            Mode::Slides(sign)
                if sign != 0.0 && slip.abs() <= here.rate_rounding_in_time(2 * k + 1, terms) =>
            {
                Some(sign)
            }
            _ => Some(slip.signum()),
        }
    }

    /// What is asked of a contact.
    ///
    /// # Errors
    /// Where its slip leaves no motion, or several.
    fn unknowns(&self, place: usize) -> Result<ContactUnknowns, StepError> {
        let k = self.asked[place];
        let [kinetic, at_rest] = self.here.friction(k);
        let static_friction = if self.breaks[place] { kinetic } else { at_rest };
        let (slipping, pressing) = (self.slipping[place], self.pressing[place]);
        if self.touching.across[k] && slipping.is_none() {
            return Ok(ContactUnknowns::SecondTangent);
        }
        if let (Some(on), None) = (self.carrier(place), pressing) {
            return Ok(match slipping {
                Some(sign) => ContactUnknowns::ShareOfCarrier {
                    share: -sign * kinetic,
                    on,
                },
                None => ContactUnknowns::OnCarrier {
                    friction: static_friction,
                    known_normal: 0.0,
                    on,
                },
            });
        }
        Ok(match (slipping, pressing) {
            (Some(sign), _) if self.touching.is_guide(k) => ContactUnknowns::SlidingGuide {
                friction: kinetic,
                forward: sign > 0.0,
            },
            (None, _) if self.touching.is_guide(k) => ContactUnknowns::Guide {
                friction: static_friction,
            },
            (Some(_), Some(_)) => ContactUnknowns::Nothing,
            (None, Some(normal)) => ContactUnknowns::Tangent {
                friction: static_friction,
                normal,
            },
            (None, None) => ContactUnknowns::Both {
                friction: static_friction,
                known_normal: 0.0,
            },
            (Some(sign), None) => ContactUnknowns::Normal {
                share: self.share_of_slip(place, sign)?,
            },
        })
    }

    /// The tangential force of a contact that slips, as a share of its normal force.
    ///
    /// # Errors
    /// Where the normal force accelerates the contact towards closing.
    fn share_of_slip(&self, place: usize, sign: f64) -> Result<f64, StepError> {
        let k = self.asked[place];
        let [friction, _] = self.here.friction(k);
        let trouble = |trouble| StepError::Contact {
            contact: k,
            trouble,
            t: self.t,
        };
        let share = -sign * friction;
        let row = self.row(2 * place);
        let own = row[2 * place];
        let mut coupled = share * row[2 * place + 1];
        let across = self.slipping.get(place + 1).copied().flatten();
        if let (Some(_), Some(sign)) = (self.touching.second(k), across) {
            coupled -= sign * friction * row[2 * place + 3];
        }
        if own == 0.0 {
            return Err(trouble(ContactTrouble::NotHeld));
        }
        // If it were pressed, it would be pressed the more: there is no motion, or there are several.
        if own + coupled <= ROUNDING_OF_FORCES * own {
            return Err(trouble(ContactTrouble::Paradox));
        }
        Ok(share)
    }

    /// The forces of a contact that are known.
    fn known_forces(&self, place: usize) -> [f64; 2] {
        let normal = self.pressing[place].unwrap_or(0.0);
        let [friction, _] = self.here.friction(self.asked[place]);
        let share = self.slipping[place].map_or(0.0, |sign| -sign * friction);
        match self.carrier(place) {
            None => [normal, share * normal],
            Some(_) => [0.0, share * normal],
        }
    }

    /// Solves for the forces with what is known of slips by now.
    fn solve(&self) -> Result<SettlingForces, StepError> {
        let places = 0..self.asked.len();
        let unknowns = places.clone().map(|place| self.unknowns(place));
        let unknowns = unknowns.collect::<Result<Vec<_>, _>>()?;
        let known: Vec<[f64; 2]> = places.map(|place| self.known_forces(place)).collect();
        let b: Vec<f64> = (self.accelerations.iter().enumerate())
            .map(|(row, [value, _])| {
                let by = self.row(row).iter().zip(known.iter().flatten());
                by.fold(*value, |sum, (g, force)| sum + g * force)
            })
            .collect();
        let answer = undetermined::solve(&unknowns, &self.g, &b).ok();
        match answer.filter(|answer| answer.residual <= MOST_RESIDUAL) {
            Some(answer) => Ok(SettlingForces {
                known,
                b,
                found: answer.forces,
                shared_otherwise: answer.shared_otherwise,
            }),
            None => Err(self.touching.unsolved(&self.asked, self.t)),
        }
    }

    /// The acceleration along a direction with all forces, and its rounding.
    fn after(&self, solved: &SettlingForces, row: usize) -> (f64, f64) {
        let of = |forces: &[[f64; 2]]| {
            let terms = self.row(row).iter().zip(forces.as_flattened());
            terms.fold([0.0; 2], |[sum, size], (g, force)| {
                [sum + g * force, size + (g * force).abs()]
            })
        };
        let ([by, size], [_, of_known]) = (of(&solved.found), of(&solved.known));
        let size = self.accelerations[row][1] + size + of_known;
        (solved.b[row] + by, ROUNDING_OF_FORCES * size)
    }

    /// The forces of all contacts, and of each guide the size of the terms of its reaction.
    fn forces(&self, solved: &SettlingForces) -> (Vec<[f64; 2]>, Vec<f64>) {
        let mut forces = vec![[0.0; 2]; self.modes.len()];
        let mut sizes_of_guides = vec![0.0; self.modes.len()];
        let parts = solved.known.iter().zip(&solved.found);
        for (place, (known, found)) in parts.enumerate() {
            let k = self.asked[place];
            forces[k] = [known[0] + found[0], known[1] + found[1]];
            if self.touching.is_guide(k) {
                (forces[k][0], sizes_of_guides[k]) = self.reaction(solved, place);
            }
        }
        (forces, sizes_of_guides)
    }

    /// The reaction of a guide with these forces, and the size of its terms, in N.
    fn reaction(&self, solved: &SettlingForces, place: usize) -> (f64, f64) {
        let unit = self.row(2 * place)[2 * place];
        let (near_side, rounding) = self.after(solved, 2 * place);
        let size = rounding / (ROUNDING_OF_FORCES * unit);
        (near_side / unit - solved.found[place][0], size)
    }

    /// Takes what contacts do from their forces. The answer is whether one begins to slip whose friction is less then, so that the forces are others.
    fn take_modes(&mut self, solved: &SettlingForces) -> bool {
        let mut breaks_away = false;
        self.at_limit.clear();
        for place in 0..self.asked.len() {
            let k = self.asked[place];
            self.modes[k] = if self.opens(solved, place) {
                Mode::Open
            } else if self.touching.across[k] {
                // The first tangent says what is done along both.
                self.modes[k - 1]
            } else {
                match (self.slipping[place], self.touching.second(k)) {
                    (Some(sign), Some(_)) => {
                        Mode::SlidesAlong([sign, self.slipping[place + 1].unwrap_or(0.0)])
                    }
                    (Some(sign), None) => Mode::Slides(sign),
                    (None, Some(_)) => self.rest_in_space(solved, place, &mut breaks_away),
                    (None, None) => self.rest_in_plane(solved, place, &mut breaks_away),
                }
            };
        }
        breaks_away
    }

    /// Whether a contact opens with these forces.
    fn opens(&self, solved: &SettlingForces, place: usize) -> bool {
        if let Some(on) = self.carrier(place) {
            return self.modes[self.asked[on]] == Mode::Open;
        }
        if self.pressing[place].is_some() || self.touching.is_guide(self.asked[place]) {
            return false;
        }
        let (opens, rounding) = self.after(solved, 2 * place);
        let rate = self.touching.greatest_rate();
        let rounding = rounding + self.here.acceleration_rounding(self.asked[place], rate);
        // One of both is 0, as far as the problem could be solved: what is pressed more than it opens is closed.
        let pressed = self.row(2 * place)[2 * place] * solved.found[place][0];
        opens > rounding.max(pressed)
    }

    /// What a contact in the plane does that is at rest and stays closed.
    fn rest_in_plane(
        &mut self,
        solved: &SettlingForces,
        place: usize,
        breaks_away: &mut bool,
    ) -> Mode {
        let k = self.asked[place];
        let tangential = solved.found[place][1];
        let normal = solved.found[self.carrier(place).unwrap_or(place)][0];
        let normal = self.pressing[place].unwrap_or(normal);
        let normal = if self.touching.is_guide(k) {
            self.reaction(solved, place).0.abs()
        } else {
            normal
        };
        let [kinetic, at_rest] = self.here.friction(k);
        let most = at_rest * normal;
        let (slips, rounding) = self.after(solved, 2 * place + 1);
        // What does not begin to slip sticks, although its friction is used up: contacts that share a load may share it so
        // while others hold it; and if it has just stopped, or starts exactly at its limit, what follows decides. A slip
        // that begins later is found by its friction, one that is assumed here and does not begin would stop at once.
        let is_held = slips.abs() <= rounding;
        // A contact with friction left sticks, whatever rounding makes of its slip.
        let has_friction_left = tangential.abs() < most * (1.0 - SATURATED);
        if is_held || has_friction_left {
            if !has_friction_left && tangential != 0.0 {
                (self.at_limit).push((k, Mode::Slides(-tangential.signum())));
            }
            return Mode::Sticks;
        }
        let sign = if most > 0.0 {
            -tangential.signum()
        } else {
            slips.signum()
        };
        self.slipping[place] = Some(sign);
        if kinetic != at_rest {
            *breaks_away = true;
            self.unsettled = k;
        }
        Mode::Slides(sign)
    }

    /// What a contact in space does that is at rest and stays closed.
    fn rest_in_space(
        &mut self,
        solved: &SettlingForces,
        place: usize,
        breaks_away: &mut bool,
    ) -> Mode {
        let k = self.asked[place];
        let used = [0, 1].map(|part| solved.found[place + part][1]);
        let normal = self.pressing[place].unwrap_or(solved.found[place][0]);
        let [kinetic, at_rest] = self.here.friction(k);
        let breaks = self.breaks[place];
        let most = normal * if breaks { kinetic } else { at_rest };
        let slips = [1, 3].map(|part| self.after(solved, 2 * place + part));
        let size = used[0].hypot(used[1]);
        let speeds_up = slips[0].0.hypot(slips[1].0);
        let is_still = speeds_up <= slips[0].1.hypot(slips[1].1);
        let has_friction_left = size < most * (1.0 - SATURATED);
        // Without any friction that is used up, only who says that it begins to slip can say in which direction.
        let known_direction = match self.known_mode(k) {
            Some(Mode::SlidesAlong(direction)) => direction,
            _ => [0.0; 2],
        };
        let sticks = if breaks {
            // What would let go with others may have friction left once these slip, as where a body begins to turn about it.
            kinetic < at_rest && has_friction_left && is_still && most > 0.0
        } else {
            // What does not begin to slip sticks, also where others could hold it: contacts that share a load may
            // share it so that the friction of one is used up.
            has_friction_left || is_still
        };
        if sticks || (size == 0.0 && is_still && known_direction == [0.0; 2]) {
            if !has_friction_left && size > 0.0 {
                let direction = used.map(|used| -used / size);
                self.at_limit.push((k, Mode::SlidesAlong(direction)));
            }
            return Mode::Sticks;
        }
        if kinetic != at_rest && !breaks {
            *breaks_away = true;
            (self.breaks[place], self.breaks[place + 1]) = (true, true);
            self.unsettled = k;
        }
        if size > 0.0 {
            Mode::SlidesAlong(used.map(|used| -used / size))
        } else if is_still {
            Mode::SlidesAlong(known_direction)
        } else {
            Mode::SlidesAlong(slips.map(|(slip, _)| slip / speeds_up))
        }
    }
}
