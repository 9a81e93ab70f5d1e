//! The ends of the states of guided contacts in a run: where a state ends, and which follow.

use super::law::{Each, Mode, Motion, OpenStates, Paradox, ROUNDING, length};
use super::per_contact::PerContact;
use super::{Contacts, friction_forces, slips, with_parts};
use crate::at::At;
use crate::contact_law::Margin;
use crate::contact_law::shares::Limit;
use crate::{StepError, System};

/// When another contact comes to rest, slips below this, relative to the largest of the same contact in the run, count as rest.
const AT_REST: f64 = 1e-10;

/// The end of a contact state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Change {
    /// The index of the contact.
    pub contact: usize,
    pub cause: Cause,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Cause {
    /// It came to rest.
    Stopped,
    /// Sticking would require more friction than is available.
    BrokeAway,
    /// Its normal reaction changed sign.
    Turned,
    /// Its slip on a surface became perpendicular to its earlier direction; it continues along its own direction.
    Veered,
}

impl Contacts {
    /// The margins by which the states of the contacts hold, two for each: a sliding contact is on its side of rest and presses to its
    /// side; a sticking contact has friction in reserve.
    pub fn margins<S: System>(
        &self,
        system: &S,
        At { t, q, v, u }: At<'_, S>,
    ) -> Result<PerContact<[Margin; 2]>, StepError> {
        let slips = slips(system, t, q, v);
        let margins = with_parts(system, t, q, v, u, |parts, _| {
            let shared = parts.shared_forces(&self.mode_of(&slips));
            let (friction_forces, shared) = shared.map_err(Paradox::singular)?;
            let mut margins = PerContact::new(self.count, [Margin::ENDLESS; 2]);
            for (k, margin) in margins.iter_mut().enumerate() {
                // The margins along both tangents are those of the first.
                if parts.layout.is_second(k) {
                    continue;
                }
                let [normal, terms] = parts.reaction(k, &friction_forces);
                *margin = match self.mode.motion[k] {
                    Motion::Sticks => {
                        let coefficient = parts.static_friction(k);
                        let reserve = match shared.margin[k] {
                            // What depends on others holds as long as all of them can hold together.
                            Some(value) => Margin {
                                value,
                                rounding: parts.rounding_of_shared(k, &friction_forces, &shared),
                            },
                            None => Margin {
                                value: coefficient * normal.abs() - parts.used(k, &friction_forces),
                                rounding: ROUNDING * coefficient * terms,
                            },
                        };
                        [reserve, Margin::ENDLESS]
                    }
                    Motion::SlidesAlong => {
                        let heading = &self.mode.slip_direction;
                        let value = heading[k] * slips[k] + heading[k + 1] * slips[k + 1];
                        let rounding = 0.0;
                        [Margin { value, rounding }, Margin::ENDLESS]
                    }
                    Motion::Slides(sign) => [
                        Margin {
                            value: sign * slips[k],
                            rounding: 0.0,
                        },
                        match parts.layout.axes() {
                            1 => Margin {
                                value: self.mode.press[k] * normal,
                                rounding: ROUNDING * terms,
                            },
                            // In space a guide has no sides.
                            _ => Margin::ENDLESS,
                        },
                    ],
                };
            }
            Ok(margins)
        });
        margins.map_err(|singular| StepError::Singular { singular, t })
    }

    /// The states that have ended according to their margins, and the index of the margin.
    pub fn ended_by_margins(
        &self,
        margins: &[[Margin; 2]],
    ) -> impl Iterator<Item = (Change, usize)> {
        let lost = |margins: &[Margin; 2], kind: usize| margins[kind].value < 0.0;
        let both = margins.iter().enumerate();
        let both = both.flat_map(|(contact, margins)| [0, 1].map(|kind| (contact, margins, kind)));
        let ended = both.filter(move |(_, margins, kind)| lost(margins, *kind));
        ended.map(|(contact, _, kind)| {
            let cause = match (self.mode.motion[contact], kind) {
                (Motion::Sticks, _) => Cause::BrokeAway,
                (Motion::Slides(_), 0) | (Motion::SlidesAlong, _) => Cause::Stopped,
                (Motion::Slides(_), _) => Cause::Turned,
            };
            (Change { contact, cause }, kind)
        })
    }

    /// Checks that the motion is determined: with these contacts sticking and
    /// sliding, no other combination of pressing sides gives another motion.
    pub fn check<S: System>(
        &self,
        system: &S,
        At { t, q, v, u }: At<'_, S>,
    ) -> Result<(), StepError> {
        let mut memory = None;
        let mode = self.seen(|| slips(system, t, q, v), &mut memory);
        let open_states = OpenStates {
            motion: PerContact::from_fn(self.count, |k| Some(mode.motion[k])),
            slip_direction: mode.slip_direction.clone(),
            excluded: None,
            turned: None,
        };
        with_parts(system, t, q, v, u, |parts, _| {
            if open_states.has_one_motion(parts, mode) {
                return Ok(());
            }
            match open_states.answer(parts) {
                Err(paradox) if paradox.several => Err(paradox.singular()),
                // If there is no motion, the state has ended, which is detected elsewhere.
                _ => Ok(()),
            }
        })
        .map_err(|singular| StepError::Singular { singular, t })
    }

    /// Determines the states again after the state of a contact has ended, and stops contacts that have come to rest. Returns whether
    /// the slip has only turned; then all states are kept.
    pub fn change<S: System>(
        &mut self,
        system: &S,
        (t, q, u): (f64, &S::Vector, &S::Inputs),
        v: [&mut S::Vector; 2],
        change: Change,
        is_at_once: bool,
    ) -> Result<bool, StepError> {
        let now = slips(system, t, q, v[0]);
        let k = change.contact;
        let veers = match (self.mode.motion[k], change.cause) {
            (Motion::SlidesAlong, Cause::Stopped) => {
                !self.has_stopped(system, At { t, q, v: v[0], u }, k)?
            }
            (_, cause) => cause == Cause::Veered,
        };
        if veers {
            self.record_headings(system, t, q, v[0]);
            return Ok(true);
        }
        let resting = self.resting_at_change(&now, change);
        let [v, v_low] = v;
        self.stop_contacts(system, (t, q, u), [&mut *v, v_low], &resting)?;
        let at = At { t, q, v, u };
        let LeavingContacts {
            motion,
            mut slip_direction,
            together,
        } = self.leaving(system, at, (&now, &resting, change))?;
        let own = (k, self.mode.motion[k]);
        // A contact that has come to rest may continue in any direction.
        for k in 0..self.count {
            if motion[k].is_none() {
                slip_direction[k] = 0.0;
            }
        }
        let open_states = OpenStates {
            motion,
            slip_direction,
            excluded: match change.cause {
                Cause::BrokeAway | Cause::Veered => None,
                // It may continue in another direction.
                Cause::Stopped if own.1 == Motion::SlidesAlong => None,
                Cause::Turned => Some((own.0, own.1, Some(self.mode.press[k]))),
                // It did not even begin to slide in this direction.
                Cause::Stopped if is_at_once => Some((own.0, own.1, None)),
                Cause::Stopped => None,
            },
            turned: (change.cause == Cause::Turned).then_some((own.0, own.1, -self.mode.press[k])),
        };
        self.mode = self.decided(system, at, &open_states, &together)?;
        Ok(false)
    }

    /// Which contacts rest where the state of one has ended.
    fn resting_at_change(&self, now: &Each, change: Change) -> PerContact<bool> {
        let mut resting = PerContact::new(self.count, false);
        for (k, rests) in resting.iter_mut().enumerate() {
            *rests = match self.mode.motion[k] {
                Motion::Sticks => true,
                Motion::Slides(_) => now[k].abs() <= AT_REST * self.sizes[k],
                Motion::SlidesAlong => false,
            };
        }
        let sliding = self
            .on_surfaces()
            .filter(|k| self.mode.motion[*k] == Motion::SlidesAlong);
        for k in sliding {
            let stops = change.cause == Cause::Stopped && change.contact == k;
            let rests = stops || self.is_slow(k, now);
            (resting[k], resting[k + 1]) = (rests, rests);
        }
        resting[change.contact] |= change.cause == Cause::Stopped;
        resting
    }

    /// How contacts that do not rest move where the state of one has ended: what sticks and breaks away begins to slide.
    fn leaving<S: System>(
        &self,
        system: &S,
        At { t, q, v, u }: At<'_, S>,
        (now, resting, change): (&Each, &[bool], Change),
    ) -> Result<LeavingContacts, StepError> {
        let k = change.contact;
        let mut motion =
            PerContact::from_fn(self.count, |k| (!resting[k]).then_some(self.mode.motion[k]));
        // These contacts break away together.
        let mut together = PerContact::new(self.count, false);
        let mut slip_direction = self.mode_of(now).slip_direction;
        if change.cause == Cause::BrokeAway {
            let held = with_parts(system, t, q, v, u, |parts, _| {
                parts.shared_forces(&self.mode).map_err(Paradox::singular)
            });
            let (held, shared) = held.map_err(|singular| StepError::Singular { singular, t })?;
            // What depends on others breaks away with those that limit what all of them can hold.
            let breaks = |j: usize| match shared.limit[j] {
                Some(Limit::Friction([direction, _])) if shared.group[j] == shared.group[k] => {
                    Some(-direction)
                }
                _ => None,
            };
            let is_shared =
                shared.margin[k].is_some() && (0..self.count).any(|j| breaks(j).is_some());
            for j in 0..self.count {
                let direction = if is_shared {
                    breaks(j).filter(|_| motion[j].is_none())
                } else {
                    // It slides against the force that held it. At this instant its slip may not even grow, since the friction of sticking
                    // and of sliding may be equal.
                    (j == k).then(|| -held[j].signum())
                };
                let Some(direction) = direction else {
                    continue;
                };
                if !self.has_second(j) {
                    (motion[j], together[j]) = (Some(Motion::Slides(direction)), is_shared);
                    continue;
                }
                // On a surface the law of friction determines the direction.
                for tangent in [j, j + 1] {
                    (motion[tangent], together[tangent]) = (Some(Motion::SlidesAlong), is_shared);
                    slip_direction[tangent] = 0.0;
                }
            }
        }
        Ok(LeavingContacts {
            motion,
            slip_direction,
            together,
        })
    }

    /// The states that are possible, of those in question. If there are none, those that break away `together` may stick.
    fn decided<S: System>(
        &self,
        system: &S,
        At { t, q, v, u }: At<'_, S>,
        open_states: &OpenStates,
        together: &[bool],
    ) -> Result<Mode, StepError> {
        let decided = with_parts(system, t, q, v, u, |parts, _| {
            let mut answer = open_states.answer(parts);
            if answer.is_err() && together.contains(&true) {
                // Reactions that change with the friction may let some of them go on sticking.
                let is_open = |k: usize| open_states.motion[k].filter(|_| !together[k]);
                let all_open = OpenStates {
                    motion: PerContact::from_fn(self.count, is_open),
                    ..open_states.clone()
                };
                answer = all_open.answer(parts);
            }
            answer.map_err(Paradox::singular)
        });
        let (mode, _) = decided.map_err(|singular| StepError::Singular { singular, t })?;
        Ok(mode)
    }

    /// Whether a sliding contact whose slip has become perpendicular to its direction at the beginning of the step has come to rest:
    /// then the slip is an error left by the step, and not a turn.
    fn has_stopped<S: System>(
        &self,
        system: &S,
        At { t, q, v, u }: At<'_, S>,
        contact: usize,
    ) -> Result<bool, StepError> {
        let slips = slips(system, t, q, v);
        if self.is_slow(contact, &slips) {
            return Ok(true);
        }
        // It has stopped if friction stops it within the resolution of time.
        let braked = with_parts(system, t, q, v, u, |parts, _| {
            let forces = friction_forces(parts, &self.mode_of(&slips))?;
            Ok([contact, contact + 1].map(|k| parts.sum(parts.slip_rate(k), &forces)[0]))
        });
        let braked = braked.map_err(|singular| StepError::Singular { singular, t })?;
        let speed = length([slips[contact], slips[contact + 1]]);
        Ok(speed <= 64.0 * f64::EPSILON * t.abs() * length(braked))
    }

    /// Whether a contact that was reported as stopped still has a slip: then it turns, or the step is too long to find where it stops.
    pub fn still_slips<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        change: Change,
    ) -> bool {
        change.cause == Cause::Stopped
            && self.mode.motion[change.contact] == Motion::SlidesAlong
            && !self.is_slow(change.contact, &slips(system, t, q, v))
    }

    /// Whether a slip counts as rest, relative to the largest so far of the same contact.
    fn is_slow(&self, contact: usize, slips: &Each) -> bool {
        let [first, second] = [contact, contact + 1];
        length([slips[first], slips[second]])
            <= AT_REST * length([self.sizes[first], self.sizes[second]])
    }
}

/// Contacts that move on where the state of one has ended: how each moves if that is known, in which direction, and which of them break away together.
struct LeavingContacts {
    motion: PerContact<Option<Motion>>,
    slip_direction: Each,
    together: PerContact<bool>,
}
