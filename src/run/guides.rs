//! Changes of guided contacts with friction: where a contact stops, breaks away or changes sides.

use super::{LastInterpolant, Run, VectorOf, contact_search};
use crate::at::At;
use crate::balance::Quadratures;
use crate::event::{self, Crossing, Event, Triple, state, step_motion};
use crate::friction::{Cause, Change, Contacts, Motion};
use crate::inputs::InputLaw;
use crate::solution::Ending;
use crate::step_error::StepError;
use crate::{Error, Machine, Pivot, Singular, System};

/// The number of changes of contact states at one instant beyond which they are considered not to settle, unless there are so many contacts
/// that three for each of them, which has three states, are more.
const CHANGES_AT_ONCE: usize = 18;

impl<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> Run<'_, '_, M, L, A> {
    /// The time at which the state of a contact ended in the last step, and the change.
    pub(super) fn contact_changed(
        &mut self,
        interpolant: &mut LastInterpolant<M>,
    ) -> Result<Option<(f64, Change)>, Error> {
        let Self { model, stepper, .. } = self;
        let Some(contacts) = stepper.contacts().clone() else {
            return Ok(None);
        };
        let margins = |(t, q, v): &Triple<VectorOf<M>>| {
            let inputs = model.inputs(*t, q, v);
            contacts
                .margins(
                    model.system,
                    At {
                        t: *t,
                        q,
                        v,
                        u: &inputs,
                    },
                )
                .map_err(|error| model.explain(error, q, v))
        };
        let mut earliest: Option<(f64, f64, Change)> = None;
        let mut theta_before = 0.0;
        let theta_roundoff = event::theta_roundoff(stepper);
        for theta in event::SAMPLE_FRACTIONS {
            let here = margins(&event::interpolated_at(stepper, theta))?;
            for (change, kind) in contacts.ended_by_margins(&here) {
                let interpolant = step_motion(interpolant, stepper, model.system)?;
                let at = |theta| event::state_at(model.system, stepper, interpolant, theta);
                let exactly = |theta| Ok(margins(&at(theta)?)?[change.contact][kind]);
                if !exactly(theta)?.is_lost_since(exactly(theta_before)?) {
                    continue;
                }
                let margin = |theta| exactly(theta).map(|margin| margin.value);
                let mut root =
                    event::last_positive([theta_before, theta], theta_roundoff, &mut &margin)?;
                let mut change = change;
                if root > contact_search::LEAST_APPROACH {
                    let (t, q, v) = at(root)?;
                    if contacts.still_slips(model.system, (t, &q, &v), change) {
                        root *= contact_search::APPROACH;
                        change.cause = Cause::Veered;
                    }
                }
                if earliest.is_none_or(|(known, ..)| root < known) {
                    earliest = Some((root, at(root)?.0, change));
                }
            }
            if let Some((_, t, change)) = earliest {
                return Ok(Some((t, change)));
            }
            theta_before = theta;
        }
        let (t, q, v) = (stepper.t(), stepper.q(), stepper.v());
        let inputs = model.inputs(t, q, v);
        contacts
            .check(
                model.system,
                At {
                    t,
                    q,
                    v,
                    u: &inputs,
                },
            )
            .map_err(|error| model.explain(error, q, v))?;
        Ok(None)
    }

    /// Puts contacts into other states if the stepper is at the end of one of their states. The answer is the event that ends the run.
    pub(super) fn change(
        &mut self,
        pending: &mut Option<(Change, f64)>,
        (last_t, times): &mut (f64, usize),
    ) -> Result<Option<Ending>, Error> {
        let Some((change, step)) = pending.take() else {
            return Ok(None);
        };
        let t = self.stepper.t();
        let is_at_once = *last_t == t;
        (*last_t, *times) = (t, if is_at_once { *times + 1 } else { 0 });
        let contacts = self.model.system.contacts().len();
        if *times > CHANGES_AT_ONCE.max(3 * contacts) {
            let singular = Singular {
                at: Pivot::Contact(change.contact),
                ratio: 0.0,
            };
            let error = StepError::Singular { singular, t };
            return Err(self
                .model
                .explain(error, self.stepper.q(), self.stepper.v()));
        }
        let before = self.stepper.contacts().clone();
        self.forget_values();
        let changed = self.stepper.change(change, is_at_once, self.stop, step);
        if let Err(error) = changed {
            return Err(self
                .model
                .explain(error, self.stepper.q(), self.stepper.v()));
        }
        if let Some(steps) = &mut self.record.steps {
            steps.jump(&self.stepper);
            self.record_energies();
        }
        self.record_contacts(before);
        let v = self.stepper.v().clone();
        self.watch_jumps(&v)
    }

    /// Records the states of the contacts with friction.
    pub(super) fn record_contacts(&mut self, before: Option<Contacts>) {
        let t = self.stepper.t();
        let Some(now) = self.stepper.contacts() else {
            return;
        };
        let names = self.model.system.contacts().enumerate();
        let seconds = self.model.system.second_tangents();
        // Both tangents of a surface are reported under the name of the first.
        for (k, name) in names.filter(|(k, _)| seconds >> k & 1 == 0) {
            let Some(was) = before.as_ref().map(|before| &before.mode) else {
                continue;
            };
            let (word, crossing) = match now.mode.motion[k] {
                Motion::Sticks if was.motion[k] == Motion::Sticks => continue,
                motion if motion == was.motion[k] => match now.mode.press[k] {
                    press if press == was.press[k] => continue,
                    press if press > 0.0 => ("presses the other way", Crossing::Rising),
                    _ => ("presses the other way", Crossing::Falling),
                },
                Motion::Sticks => ("sticks", Crossing::Falling),
                Motion::Slides(_) | Motion::SlidesAlong => ("slides", Crossing::Rising),
            };
            let at = (t, self.stepper.q().clone(), self.stepper.v().clone());
            self.record.events.push(Event {
                name: std::format!("{name} {word}"),
                crossing,
                state: state(self.model.system, at),
            });
        }
        self.record.contacts.push((t, now.for_later_observation()));
    }
}
