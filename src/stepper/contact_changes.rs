//! Lets unilateral contacts close, open, stick and slip at the end of a step.

mod fading;
mod settling;

pub(super) use settling::project_onto_closed_contacts;

use std::boxed::Box;
use std::vec::Vec;

use super::in_series::GROWTH_IN_FLIGHT;
use super::{Model, Stepper, move_by_rounding};
use crate::at::At;
use crate::balance::{ContactShare, Quadratures};
use crate::contact::{
    Bounce, ContactMemory, Impact, Mode, ParadoxResolution, StateBox, StepEnds, Told,
    UnilateralState,
};
use crate::inputs::InputLaw;
use crate::stages::Point;
use crate::unilateral::ContactTrouble;
use crate::{StepError, System, Vector};

/// The largest number of consecutive impacts at one instant, per contact.
const MOST_IMPACTS_AT_ONCE: usize = 1000;

/// The next step is at most this many times as long as the flight that follows an impact, so that it does not miss the flight.
const STEP_TO_FLIGHT_RATIO: f64 = 8.0;

/// The same for a step by series, which is not shortened by its error where few forces act.
const SERIES_TO_FLIGHT_RATIO: f64 = 2.0;

/// The reason for which the next states of contacts are determined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Cause {
    /// A gap has closed, or it is only known that something changes.
    Unspecified,
    /// The force of a contact has vanished.
    Lifts(usize),
    /// A corner of a polygon has come to the end of the face that it was on.
    Leaves(usize),
    /// The slip of a contact has stopped.
    Stops(usize),
    /// The friction of a contact is used up; it begins to slip in this direction.
    Breaks(usize, [f64; 2]),
    /// A compliant contact begins to press.
    Presses(usize),
    /// The reaction of a guide has changed its sign: the guide presses to its other side.
    Switches(usize),
    /// A layer turns from loading to unloading, or comes back to its greatest depth.
    Turns(usize),
}

/// The changes at an instant.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactChanges {
    pub impacts: Vec<Impact>,
    /// Impulses that stop slips which are rounding beside the motion: they are no events, and what they take is a loss of their contacts like any other.
    pub slight_impacts: Vec<Impact>,
    /// The states of contacts before, and now.
    pub before: Vec<Mode>,
    pub after: Vec<Mode>,
    /// Contacts whose bounces end, with the time for which these would have continued, in s.
    pub ended: Vec<(usize, f64)>,
    /// Losses in impacts that are not represented by impulses: the last bounces, in J.
    pub lost_at_end: f64,
    /// Layers whose loading changed direction: whether they are loaded now.
    pub turned: Vec<(usize, bool)>,
    /// Guides that slide on and press to their other sides.
    pub switched: Vec<usize>,
    pub told: Told,
    /// The length of the flight that follows, if there is one and its length is known.
    flight: Option<f64>,
}

/// What an instant of changes is compared with: the state before it.
struct StateBefore {
    /// The kinetic energy, in J.
    energy: f64,
    /// The side to which each guide presses.
    sides: Vec<f64>,
    /// The energy that each contact stores, in J, and whether its layer is loaded.
    stored: Vec<f64>,
    loaded: Vec<bool>,
}

impl StateBefore {
    fn of<S: System, L: InputLaw<S>>(
        model: &Model<'_, S, L>,
        touching: &UnilateralState,
        now: &Point<S::Vector>,
    ) -> Self {
        Self {
            energy: model.energy(now),
            sides: touching.sides().to_vec(),
            stored: stored_by_each(model.system.get(), touching, now),
            loaded: touching.loaded().collect(),
        }
    }
}

/// Contacts after the impacts of an instant: which touch, which are closed, and the slips of which have stopped.
struct ContactsMet {
    touches: Vec<bool>,
    closed: Vec<bool>,
    stopped: Vec<bool>,
}

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// The state of the unilateral contacts.
    pub(crate) fn touching(&self) -> &Option<UnilateralState> {
        &self.model.touching
    }

    /// [Undoes](Self::retreat) the last step, and makes `end` the end of the next one, where contacts change.
    pub(crate) fn retreat_to_change(&mut self, end: f64) {
        self.retreat(end);
        self.ends_at_change = true;
    }

    /// Finds out which contacts are near in the last step.
    pub(crate) fn keep_near(&mut self) {
        let Self {
            model,
            now,
            before,
            k,
            newest,
            control,
            taylor,
            ..
        } = self;
        let ends = StepEnds {
            t: [before.t, now.t],
            step: control.last_step,
            before: [&before.q, &before.v, &k[0]].map(S::Vector::as_slice),
            after: [&now.q, &now.v, &k[*newest]].map(S::Vector::as_slice),
        };
        if let Some(touching) = &mut model.touching {
            touching.keep_near(model.system.get(), 0.0, |own| {
                *own = match taylor {
                    Some(taylor) => StateBox::of_series(&ends, taylor.of_step()),
                    None => StateBox::of_step(&ends),
                };
            });
        }
    }

    /// Lets contacts that touch meet, and continues to `end` with the contacts that are closed then. What yields and is pressed
    /// `at_start` has been pressed before.
    pub(crate) fn resolve_contacts(
        &mut self,
        cause: Cause,
        at_start: bool,
        end: f64,
        step: f64,
    ) -> Result<ContactChanges, StepError> {
        let Self {
            model,
            now,
            tolerance,
            ..
        } = self;
        let Some(mut touching) = model.touching.clone() else {
            return Ok(ContactChanges::default());
        };
        let before = StateBefore::of(model, &touching, now);
        let mut changes = ContactChanges {
            before: touching.modes().to_vec(),
            ..ContactChanges::default()
        };
        model.set_inputs(now.t, &now.q, &now.v);
        let fading = model.fading_at_change(cause, &touching, now, tolerance)?;
        let cause = model.known_cause(cause, &touching, now, &fading)?;
        let ContactsMet {
            touches,
            mut closed,
            stopped,
        } = model.close_what_meets(&mut touching, now, (cause, &fading), &mut changes)?;
        let energy_after = model.energy(now);
        model.end_bounces(&mut touching, now, (&touches, &mut closed), &mut changes)?;
        touching.copy_from_carriers(&mut closed);
        let (resting, jammed) = model.settle_closed(
            &mut touching,
            now,
            (cause, &mut closed, stopped),
            &mut changes,
        )?;
        let system = model.system.get();
        touching.record_slips(system, now.t, &now.q, &now.v);
        touching.record_beginning_slips(system, (now.t, &now.q, &now.v), &resting);
        if !matches!(cause, Cause::Turns(_)) || !changes.impacts.is_empty() {
            touching.load_layers(system, now.t, &now.q, &now.v);
        }
        let turned = touching.loaded().zip(before.loaded).enumerate();
        changes.turned = turned
            .filter(|(_, (is, was))| is != was)
            .map(|(k, (is, _))| (k, is))
            .collect();
        let stored_after = stored_by_each(system, &touching, now);
        let stored_before = if at_start {
            stored_after.clone()
        } else {
            before.stored
        };
        model.constraints = project_onto_closed_contacts(system, &touching, now)?;
        changes.after = touching.modes().to_vec();
        changes.switched = touching.switched(&changes.before, &before.sides);
        model.touching = Some(touching);

        if !changes.ended.is_empty() {
            changes.lost_at_end = energy_after + jammed - model.energy(now);
        }
        let gained = energy_after + jammed - before.energy;
        self.book_changes(gained, &changes, [&stored_before, &stored_after]);
        self.begin_again(end, step, changes.flight)?;
        Ok(changes)
    }

    /// Books the energy that an instant of changes took: what impacts added to the kinetic energy, and what each contact stored before and after.
    fn book_changes(&mut self, gained: f64, changes: &ContactChanges, stored: [&[f64]; 2]) {
        let all_impacts = || changes.impacts.iter().chain(&changes.slight_impacts);
        if all_impacts().next().is_some() {
            // The energy that impulses add beyond the losses is work of prescribed motion. Whatever else changes energy at this instant is
            // neither work nor a loss, and shows in the energy balance.
            let impact_losses: f64 = all_impacts().map(|impact| impact.loss).sum();
            let (work, lost) = (gained + impact_losses, impact_losses + changes.lost_at_end);
            self.quadratures.add_instantaneous(work, lost);
        }
        for impact in all_impacts() {
            let part = ContactShare {
                work: impact.work,
                ..ContactShare::default()
            };
            self.quadratures
                .add_instantaneous_share(impact.contact, part);
        }
        let [before, after] = stored;
        for contact in 0..before.len().max(after.len()) {
            let of = |stored: &[f64]| stored.get(contact).copied().unwrap_or(0.0);
            let released = of(before) - of(after);
            if released != 0.0 {
                // If a force vanishes before its contact has recovered, the energy still stored is lost.
                self.quadratures.add_instantaneous(0.0, released);
                let part = ContactShare {
                    compliance_loss: released,
                    ..ContactShare::default()
                };
                self.quadratures.add_instantaneous_share(contact, part);
            }
        }
    }

    /// Continues with the accelerations of the present state.
    fn begin_again(&mut self, end: f64, step: f64, flight: Option<f64>) -> Result<(), StepError> {
        let Self { model, now, k, .. } = self;
        let newest = self.newest;
        model.accelerations(
            now.t,
            &now.q,
            &now.v,
            &mut k[newest],
            &mut self.control.work,
        )?;
        model.take_rates(
            &mut self.quadratures,
            0,
            (now.t, &now.q, &now.v, &k[newest]),
        );
        self.end = end;
        self.longest_first = match flight {
            Some(flight) if flight > 0.0 => SERIES_TO_FLIGHT_RATIO * flight,
            _ if step > 0.0 => GROWTH_IN_FLIGHT * step,
            _ => f64::INFINITY,
        };
        self.control.step = match flight {
            Some(flight) if flight > 0.0 => step.min(STEP_TO_FLIGHT_RATIO * flight),
            _ => step,
        };
        self.ends_at_change = false;
        self.control.begin_anew();
        if let Some(implicit) = &mut self.implicit {
            implicit.forget();
        }
        Ok(())
    }
}

impl<S: System, L: InputLaw<S>> Model<'_, S, L> {
    /// Records the beginning of a step.
    pub(super) fn begin_contacts(&mut self, now: &Point<S::Vector>) {
        if let Some(touching) = &mut self.touching {
            let memory = self.contact_memory.get_or_insert_with(|| {
                let memory = ContactMemory::new(touching, &now.q);
                Box::new(memory)
            });
            touching.record_headings(self.system.get(), (now.t, &now.q, &now.v), memory);
        }
    }

    /// The cause of a change, once more is known: a slip in space that has become perpendicular to its earlier direction may have turned instead of stopped.
    fn known_cause(
        &mut self,
        cause: Cause,
        touching: &UnilateralState,
        now: &mut Point<S::Vector>,
        fading: &[bool],
    ) -> Result<Cause, StepError> {
        let Cause::Stops(k) = cause else {
            return Ok(cause);
        };
        let at = At {
            t: now.t,
            q: &now.q,
            v: &now.v,
            u: &self.inputs,
        };
        if fading[k] || touching.has_stopped(self.system.get(), at, k)? {
            return Ok(cause);
        }
        // It cannot turn so close to the place at which it was evaluated: the tangents jump here, and the next step has to begin beyond the jump.
        move_by_rounding(&mut now.q, &now.v);
        self.set_inputs(now.t, &now.q, &now.v);
        Ok(Cause::Unspecified)
    }

    /// The kinetic energy, in J.
    fn energy(&self, now: &Point<S::Vector>) -> f64 {
        self.system.kinetic_energy(now.t, &now.q, &now.v)
    }

    /// Lets contacts meet, and finds which are closed then.
    fn close_what_meets(
        &mut self,
        touching: &mut UnilateralState,
        now: &mut Point<S::Vector>,
        (cause, fading): (Cause, &[bool]),
        changes: &mut ContactChanges,
    ) -> Result<ContactsMet, StepError> {
        let pairs: Vec<usize> = (0..touching.modes().len())
            .map(|k| touching.first(k))
            .collect();
        let touches = meet(self.system.get(), touching, now, changes)?;
        self.set_inputs(now.t, &now.q, &now.v);
        let place = (now.t, &now.q, &now.v);
        let as_held = changes.impacts.is_empty();
        let mut closed = touching.persisting(self.system.get(), place, &touches, as_held);
        match cause {
            Cause::Lifts(k) if touching.is_compliant(k) => closed[k] = false,
            Cause::Leaves(k) => closed[k] = false,
            Cause::Presses(k) => closed[k] = true,
            Cause::Turns(k) => {
                touching.switch_layer(self.system.get(), place, k);
            }
            _ => {}
        }
        touching.copy_from_carriers(&mut closed);
        let stops = |k: usize| cause == Cause::Stops(pairs[k]) || as_held && fading[pairs[k]];
        let mut met = ContactsMet {
            touches,
            stopped: (0..closed.len()).map(stops).collect(),
            closed,
        };
        if touching.may_have_paradox() {
            self.leave_paradox(touching, now, (cause, &mut met), changes)?;
        }
        Ok(met)
    }

    /// Takes the way out of Painlevé's paradox of a closed contact, if there is one: the contact opens, or has an impact, which changes what is closed.
    fn leave_paradox(
        &mut self,
        touching: &UnilateralState,
        now: &mut Point<S::Vector>,
        (cause, met): (Cause, &mut ContactsMet),
        changes: &mut ContactChanges,
    ) -> Result<(), StepError> {
        let ContactsMet {
            touches,
            closed,
            stopped,
        } = met;
        let t = now.t;
        let mut resting = touching.resting(self.system.get(), (t, &now.q, &now.v), closed);
        for (k, resting) in resting.iter_mut().enumerate() {
            *resting |= stopped[k] || cause == Cause::Lifts(k);
        }
        let at = At {
            t,
            q: &now.q,
            v: &now.v,
            u: &self.inputs,
        };
        match touching.resolve_paradox(self.system.get(), at, closed, &resting)? {
            Some(ParadoxResolution::Opens(k)) => closed[k] = false,
            Some(ParadoxResolution::Impact { impact, change }) => {
                for (v, by) in now.v.as_mut_slice().iter_mut().zip(change) {
                    *v += by;
                }
                now.v_low.as_mut_slice().fill(0.0);
                changes.impacts.push(impact);
                self.set_inputs(t, &now.q, &now.v);
                let place = (t, &now.q, &now.v);
                *closed = touching.persisting(self.system.get(), place, touches, false);
            }
            None => {}
        }
        Ok(())
    }

    /// Closes contacts that touch and whose bounces end, and notes how long the flights of the others are.
    fn end_bounces(
        &self,
        touching: &mut UnilateralState,
        now: &Point<S::Vector>,
        (touches, closed): (&[bool], &mut [bool]),
        changes: &mut ContactChanges,
    ) -> Result<(), StepError> {
        if changes.impacts.is_empty() {
            return Ok(());
        }
        let system = self.system.get();
        let place = (now.t, &now.q, &now.v);
        let is_hit = |k: usize| changes.impacts.iter().any(|impact| impact.contact == k);
        let may_end = |k: &usize| touches[*k] && !closed[*k];
        let bouncing: Vec<usize> = (0..closed.len())
            .filter(may_end)
            .filter(|k| touching.carrier(*k).is_none() && !touching.is_compliant(*k))
            .collect();
        let mut bounces: Vec<(usize, Bounce)> = (bouncing.into_iter())
            .map(|k| (k, touching.bounce(system, place, (k, is_hit(k)))))
            .collect();
        // The motion with all contacts that were hit open determines the length of the next flight. What then comes to rest is closed in the motion that
        // determines it for the others: two bodies that fly together do not fall on each other until the lower one rests.
        let mut modes: Vec<Mode> = (closed.iter().zip(touching.modes()))
            .map(|(closed, mode)| if *closed { *mode } else { Mode::Open })
            .collect();
        loop {
            let mut flying = touching.clone();
            flying.set_modes(modes.clone());
            let at = At {
                t: now.t,
                q: &now.q,
                v: &now.v,
                u: &self.inputs,
            };
            let mut free = now.v.zeros_like();
            let mut memory = ContactMemory::new(&flying, &now.q);
            flying.accelerations(system, at, &mut memory, &mut free)?;
            let falls = touching.gap_accelerations(system, place, free.as_slice());
            changes.flight = None;
            let before = bounces.len();
            bounces.retain(|(contact, bounce)| {
                let falls = falls[*contact];
                if let Some(left) = touching.remaining_bounce_time(bounce, falls) {
                    closed[*contact] = true;
                    modes[*contact] = Mode::Slides(0.0);
                    changes.ended.push((*contact, left));
                    return false;
                }
                if falls < 0.0 && bounce.opening > 0.0 {
                    let flight = 2.0 * bounce.opening / -falls;
                    let least = changes.flight.map_or(flight, |known| known.min(flight));
                    changes.flight = Some(least);
                }
                true
            });
            if bounces.is_empty() || bounces.len() == before {
                return Ok(());
            }
        }
    }

    /// Records the end of a step.
    pub(super) fn accept_contacts(&mut self, now: &Point<S::Vector>) {
        let Some(touching) = &self.touching else {
            return;
        };
        if let Some(constraints) = &mut self.constraints {
            constraints.accept(&now.q, &now.v);
            if constraints.redundant {
                // If that fails, the previous rows will do, or the next step returns the error.
                let constrained = touching.machine(self.system.get());
                let _ = constraints.choose_again(&constrained, now.t, &now.q);
            }
        }
    }
}

/// Impacts of what touches, until none closes; they are added to the changes at this instant. The answer is what touches.
fn meet<S: System>(
    system: &S,
    touching: &mut UnilateralState,
    now: &mut Point<S::Vector>,
    changes: &mut ContactChanges,
) -> Result<Vec<bool>, StepError> {
    let t = now.t;
    let mut touches = Vec::new();
    for round in 0.. {
        let place = (t, &now.q, &now.v);
        let as_held = changes.impacts.is_empty();
        let (near, closes) = touching.near(system, place, as_held, &touches);
        touches = near;
        let Some(contact) = closes.iter().position(|closes| *closes) else {
            break;
        };
        if round == MOST_IMPACTS_AT_ONCE * closes.len() {
            let trouble = ContactTrouble::Unsettled;
            return Err(StepError::Contact {
                contact,
                trouble,
                t,
            });
        }
        let takes_part = touching.next(system, place, &touches);
        let found = touching.impact(
            system,
            t,
            &now.q,
            &mut now.v,
            (&takes_part, as_held),
            &mut changes.told,
        )?;
        now.v_low.as_mut_slice().fill(0.0);
        changes.impacts.extend(found);
    }
    Ok(touches)
}

/// The energy stored in each compliant contact, in J.
fn stored_by_each<S: System>(
    system: &S,
    touching: &UnilateralState,
    now: &Point<S::Vector>,
) -> Vec<f64> {
    touching.stored_by_each(system, now.t, &now.q, &now.v)
}
