//! Lets unilateral contacts close, open, stick and slip at the end of a step.

use std::boxed::Box;
use std::vec::Vec;

use super::{Model, Stepper, move_by_rounding};
use crate::at::At;
use crate::balance::{ContactShare, Quadratures};
use crate::constraints::Constraints;
use crate::contact::{
    ContactMemory, Impact, Mode, ParadoxResolution, StateBox, StepEnds, UnilateralState,
};
use crate::inputs::InputLaw;
use crate::stages::Point;
use crate::unilateral::ContactTrouble;
use crate::{StepError, System, Vector};

/// The largest number of consecutive impacts at one instant, per contact.
const MOST_IMPACTS_AT_ONCE: usize = 1000;

/// The next step is at most this many times as long as the flight that follows an impact, so that it does not miss the flight.
const STEP_TO_FLIGHT_RATIO: f64 = 8.0;

/// A slip that has stopped is removed without a further question if that changes the kinetic energy by at most this share: a slip is located to the
/// tolerance of the step, and its square is less.
const SHARE_OF_REST: f64 = 1e-9;

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
    /// A layer turns from loading to unloading, or comes back to its greatest depth.
    Turns(usize),
}

/// The changes at an instant.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactChanges {
    pub impacts: Vec<Impact>,
    /// The states of contacts before, and now.
    pub before: Vec<Mode>,
    pub after: Vec<Mode>,
    /// Contacts whose bounces end, with the time for which these would have continued, in s.
    pub ended: Vec<(usize, f64)>,
    /// Losses in impacts that are not represented by impulses: the last bounces, in J.
    pub lost_at_end: f64,
    /// Layers whose loading changed direction: whether they are loaded now.
    pub turned: Vec<(usize, bool)>,
    /// The length of the flight that follows, if there is one and its length is known.
    flight: Option<f64>,
}

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// The state of the unilateral contacts.
    pub(crate) fn touching(&self) -> &Option<UnilateralState> {
        &self.model.touching
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
            ..
        } = self;
        let ends = StepEnds {
            t: [before.t, now.t],
            step: control.last_step,
            before: [&before.q, &before.v, &k[0]].map(S::Vector::as_slice),
            after: [&now.q, &now.v, &k[*newest]].map(S::Vector::as_slice),
        };
        if let Some(touching) = &mut model.touching {
            touching.keep_near(model.system.get(), 0.0, || StateBox::of_step(&ends));
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
        let Self { model, now, .. } = self;
        let mut changes_at_instant = ContactChanges::default();
        let energy = |model: &Model<'_, S, L>, now: &Point<S::Vector>| {
            model.system.kinetic_energy(now.t, &now.q, &now.v)
        };
        let (t, energy_before) = (now.t, energy(model, now));
        let Some(mut touching) = model.touching.clone() else {
            return Ok(changes_at_instant);
        };
        changes_at_instant.before = touching.modes().to_vec();
        let stored_before = stored_by_each(model.system.get(), &touching, now);
        let loaded_before: Vec<bool> = touching.loaded().collect();
        model.set_inputs(t, &now.q, &now.v);
        // A slip in space that has become perpendicular to its earlier direction may have turned instead of stopped.
        let cause = match cause {
            Cause::Stops(k) => {
                let at = At {
                    t,
                    q: &now.q,
                    v: &now.v,
                    u: &model.inputs,
                };
                if touching.has_stopped(model.system.get(), at, k)? {
                    cause
                } else {
                    // It cannot turn so close to the place at which it was evaluated: the tangents jump here, and the next step has
                    // to begin beyond the jump.
                    move_by_rounding(&mut now.q, &now.v);
                    model.set_inputs(t, &now.q, &now.v);
                    Cause::Unspecified
                }
            }
            cause => cause,
        };
        let known = match cause {
            Cause::Lifts(k) | Cause::Leaves(k) => Some((k, Mode::Open)),
            Cause::Breaks(k, direction) if touching.second(k).is_some() => {
                Some((k, Mode::SlidesAlong(direction)))
            }
            Cause::Breaks(k, [along, _]) => Some((k, Mode::Slides(along.signum()))),
            Cause::Unspecified | Cause::Stops(_) | Cause::Presses(_) | Cause::Turns(_) => None,
        };
        let pairs: Vec<usize> = (0..touching.modes().len())
            .map(|k| touching.first(k))
            .collect();
        let stops = |k: usize| cause == Cause::Stops(pairs[k]);

        let (impacts, touches) = meet(model.system.get(), &mut touching, now)?;
        changes_at_instant.impacts = impacts;
        model.set_inputs(t, &now.q, &now.v);
        let as_held = changes_at_instant.impacts.is_empty();
        let mut closed =
            touching.persisting(model.system.get(), (t, &now.q, &now.v), &touches, as_held);
        match cause {
            Cause::Lifts(k) if touching.is_compliant(k) => closed[k] = false,
            Cause::Leaves(k) => closed[k] = false,
            Cause::Presses(k) => closed[k] = true,
            Cause::Turns(k) => {
                touching.switch_layer(model.system.get(), (t, &now.q, &now.v), k);
            }
            _ => {}
        }
        touching.copy_from_carriers(&mut closed);
        if touching.may_have_paradox() {
            let mut resting = touching.resting(model.system.get(), (t, &now.q, &now.v), &closed);
            for (k, resting) in resting.iter_mut().enumerate() {
                *resting |= stops(k) || cause == Cause::Lifts(k);
            }
            let at = At {
                t,
                q: &now.q,
                v: &now.v,
                u: &model.inputs,
            };
            match touching.resolve_paradox(model.system.get(), at, &closed, &resting)? {
                Some(ParadoxResolution::Opens(k)) => closed[k] = false,
                Some(ParadoxResolution::Impact { impact, change }) => {
                    for (v, by) in now.v.as_mut_slice().iter_mut().zip(change) {
                        *v += by;
                    }
                    now.v_low.as_mut_slice().fill(0.0);
                    changes_at_instant.impacts.push(impact);
                    model.set_inputs(t, &now.q, &now.v);
                    closed = touching.persisting(
                        model.system.get(),
                        (t, &now.q, &now.v),
                        &touches,
                        false,
                    );
                }
                None => {}
            }
        }
        let energy_after = energy(model, now);
        model.end_bounces(&mut touching, now, &mut closed, &mut changes_at_instant)?;
        touching.copy_from_carriers(&mut closed);
        let stopped: Vec<bool> = (0..closed.len()).map(stops).collect();
        let is_hit = !changes_at_instant.impacts.is_empty();
        model.hold_closed(&mut touching, now, (&closed, &stopped, is_hit))?;
        let resting = resting_or_stopped(model.system.get(), &touching, now, (&closed, &stopped));
        let at = At {
            t,
            q: &now.q,
            v: &now.v,
            u: &model.inputs,
        };
        let known: Vec<(usize, Mode)> = known.into_iter().collect();
        let system = model.system.get();
        let mut modes = touching.settled(system, at, &closed, &resting, &known)?;
        let is_same = |modes: &[Mode]| {
            let mut pairs = modes.iter().zip(touching.modes());
            pairs.all(|(after, before)| after.is_like(*before))
        };
        if cause == Cause::Unspecified && is_same(&modes) {
            // Contacts that share a load may exceed what they hold together by so little that the forces above do not show it.
            let let_go = touching.let_go(system, at)?;
            if !let_go.is_empty() {
                modes = touching.settled(system, at, &closed, &resting, &let_go)?;
            }
        }
        if let Cause::Lifts(_) = cause {
            // Contacts that lift at the same instant, by symmetry, would otherwise close each other again and again.
            let was_open =
                |k: usize| changes_at_instant.before[k] == Mode::Open && !touching.is_compliant(k);
            modes = touching.without_unpressed(system, at, modes, was_open)?;
        }
        touching.set_modes(modes);
        touching.record_slips(model.system.get(), t, &now.q, &now.v);
        touching.record_beginning_slips(model.system.get(), (t, &now.q, &now.v), &resting);
        if !matches!(cause, Cause::Turns(_)) || !changes_at_instant.impacts.is_empty() {
            touching.load_layers(model.system.get(), t, &now.q, &now.v);
        }
        let turned = touching.loaded().zip(loaded_before).enumerate();
        changes_at_instant.turned = turned
            .filter(|(_, (is, was))| is != was)
            .map(|(k, (is, _))| (k, is))
            .collect();
        let stored_after = stored_by_each(model.system.get(), &touching, now);
        let stored_before = if at_start {
            stored_after.clone()
        } else {
            stored_before
        };
        model.constraints = project_onto_closed_contacts(model.system.get(), &touching, now)?;
        changes_at_instant.after = touching.modes().to_vec();
        model.touching = Some(touching);

        if !changes_at_instant.ended.is_empty() {
            changes_at_instant.lost_at_end = energy_after - energy(model, now);
        }
        let gained = energy_after - energy_before;
        self.book_changes(gained, &changes_at_instant, [&stored_before, &stored_after]);
        self.begin_again(end, step, changes_at_instant.flight)?;
        Ok(changes_at_instant)
    }

    /// Books the energy that an instant of changes took: what impacts added to the kinetic energy, and what each contact stored before and after.
    fn book_changes(&mut self, gained: f64, changes: &ContactChanges, stored: [&[f64]; 2]) {
        if !changes.impacts.is_empty() {
            // The energy that impulses add beyond the losses is work of prescribed motion. Whatever else changes energy at this instant is
            // neither work nor a loss, and shows in the energy balance.
            let impact_losses: f64 = changes.impacts.iter().map(|impact| impact.loss).sum();
            let (work, lost) = (gained + impact_losses, impact_losses + changes.lost_at_end);
            self.quadratures.add_instantaneous(work, lost);
        }
        for impact in &changes.impacts {
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
        self.control.step = match flight {
            Some(flight) if flight > 0.0 => step.min(STEP_TO_FLIGHT_RATIO * flight),
            _ => step,
        };
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

    /// Closes contacts that were hit and whose bounces end, and notes how long the flights of the others are.
    fn end_bounces(
        &self,
        touching: &mut UnilateralState,
        now: &Point<S::Vector>,
        closed: &mut [bool],
        changes: &mut ContactChanges,
    ) -> Result<(), StepError> {
        let system = self.system.get();
        let mut free = now.v.zeros_like();
        if !changes.impacts.is_empty() {
            // The motion with all contacts that were hit open determines the length of the next flight.
            let mut flying = touching.clone();
            let modes = (closed.iter().zip(touching.modes()))
                .map(|(closed, mode)| if *closed { *mode } else { Mode::Open })
                .collect();
            flying.set_modes(modes);
            let at = At {
                t: now.t,
                q: &now.q,
                v: &now.v,
                u: &self.inputs,
            };
            let mut memory = ContactMemory::new(&flying, &now.q);
            flying.accelerations(system, at, &mut memory, &mut free)?;
        }
        let mut hit: Vec<usize> = changes.impacts.iter().map(|i| i.contact).collect();
        hit.sort_unstable();
        hit.dedup();
        hit.retain(|k| !closed[*k] && touching.carrier(*k).is_none());
        for contact in hit {
            let place = (now.t, &now.q, &now.v);
            let gap_acceleration =
                touching.gap_acceleration(system, place, contact, free.as_slice());
            let left = touching.remaining_bounce_time(system, place, contact, gap_acceleration);
            if let Some(left) = left {
                closed[contact] = true;
                changes.ended.push((contact, left));
            } else if gap_acceleration < 0.0 {
                let flight = 2.0 * touching.openings[contact] / -gap_acceleration;
                let least = changes.flight.map_or(flight, |known| known.min(flight));
                changes.flight = Some(least);
            }
        }
        Ok(())
    }

    /// Brings a state onto the contacts that are closed, without the slips that have stopped, which sets what contacts do.
    fn hold_closed(
        &self,
        touching: &mut UnilateralState,
        now: &mut Point<S::Vector>,
        (closed, stopped, is_hit): (&[bool], &[bool], bool),
    ) -> Result<(), StepError> {
        let system = self.system.get();
        // A slip that has stopped is at rest, and so is one at a contact that has just closed.
        let rests = touching.resting(system, (now.t, &now.q, &now.v), closed);
        let mode = |k: usize| match touching.modes()[k] {
            _ if !closed[k] => Mode::Open,
            _ if stopped[k] => Mode::Sticks,
            Mode::Open => Mode::Slides(0.0),
            // An impact elsewhere may have made it slip, beyond what the impulse of its friction could prevent.
            _ if !rests[k] && is_hit => Mode::Slides(0.0),
            mode => mode,
        };
        let held: Vec<Mode> = (0..closed.len()).map(mode).collect();
        touching.set_modes(held.clone());
        let as_found = now.clone();
        let projected = project_onto_closed_contacts(system, touching, now);
        let energy = |now: &Point<S::Vector>| system.kinetic_energy(now.t, &now.q, &now.v);
        let is_held = projected.is_ok() && energy(now) >= (1.0 - SHARE_OF_REST) * energy(&as_found);
        if is_held
            || !stopped
                .iter()
                .zip(closed)
                .any(|(stops, closed)| *stops && *closed)
        {
            return projected.map(|_| ());
        }
        // Near a dead centre a slip stops whatever friction does, and to hold it there would stop the machine. So forces decide first.
        *now = as_found.clone();
        if self.goes_on(touching, now, (closed, stopped))? {
            return Ok(());
        }
        projected?;
        *now = as_found;
        touching.set_modes(held);
        project_onto_closed_contacts(system, touching, now)?;
        Ok(())
    }

    /// Whether slips that have stopped go on at once. The state is then on the closed contacts with these slips.
    fn goes_on(
        &self,
        touching: &mut UnilateralState,
        now: &mut Point<S::Vector>,
        (closed, stopped): (&[bool], &[bool]),
    ) -> Result<bool, StepError> {
        let system = self.system.get();
        let with_slip = (touching.modes().iter().zip(stopped))
            .map(|(mode, stops)| if *stops { Mode::Slides(0.0) } else { *mode })
            .collect();
        touching.set_modes(with_slip);
        project_onto_closed_contacts(system, touching, now)?;
        let resting = resting_or_stopped(system, touching, now, (closed, stopped));
        let at = At {
            t: now.t,
            q: &now.q,
            v: &now.v,
            u: &self.inputs,
        };
        let goes_on = touching.settled(system, at, closed, &resting, &[])?;
        let mut pairs = goes_on.iter().zip(stopped);
        Ok(!pairs.any(|(mode, stops)| *stops && *mode == Mode::Sticks))
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

/// Impacts of what touches, until none closes. The answer is what they were, and what touches.
fn meet<S: System>(
    system: &S,
    touching: &mut UnilateralState,
    now: &mut Point<S::Vector>,
) -> Result<(Vec<Impact>, Vec<bool>), StepError> {
    let t = now.t;
    let (mut impacts, mut touches) = (Vec::new(), Vec::new());
    for round in 0.. {
        let place = (t, &now.q, &now.v);
        let (near, closes) = touching.near(system, place, impacts.is_empty(), &touches);
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
        let as_held = impacts.is_empty();
        let found = touching.impact(system, t, &now.q, &mut now.v, &takes_part, as_held)?;
        now.v_low.as_mut_slice().fill(0.0);
        impacts.extend(found);
    }
    Ok((impacts, touches))
}

/// Which contacts rest: by their rates, because they have just stopped, or because they stick.
fn resting_or_stopped<S: System>(
    system: &S,
    touching: &UnilateralState,
    now: &Point<S::Vector>,
    (closed, stopped): (&[bool], &[bool]),
) -> Vec<bool> {
    let mut resting = touching.resting(system, (now.t, &now.q, &now.v), closed);
    for (k, resting) in resting.iter_mut().enumerate() {
        *resting |= stopped[k] || touching.modes()[k] == Mode::Sticks;
    }
    resting
}

/// The energy stored in each compliant contact, in J.
fn stored_by_each<S: System>(
    system: &S,
    touching: &UnilateralState,
    now: &Point<S::Vector>,
) -> Vec<f64> {
    touching.stored_by_each(system, now.t, &now.q, &now.v)
}

/// Projects a state onto the closed contacts and the constraints; returns the state of these constraints.
pub(super) fn project_onto_closed_contacts<S: System>(
    system: &S,
    touching: &UnilateralState,
    now: &mut Point<S::Vector>,
) -> Result<Option<Constraints<S::Vector>>, StepError> {
    let constrained = touching.machine(system);
    if constrained.constraints().len() == 0 {
        return Ok(None);
    }
    let mut constraints = Constraints::new(&constrained, &now.q, &now.v);
    // The rates of contacts that close are known to the round-off of those with which they closed, however small they are now.
    let first = system.constraints().len();
    for (place, rate) in touching.rates_of_held().enumerate() {
        constraints.record_rate(first + place, rate);
    }
    let begun = constraints.begin(&constrained, &mut now.place(), None);
    begun.map_err(|error| touching.explain(system, error))?;
    // Contacts that share a load stay dependent for as long as they are closed.
    constraints.at_fork = false;
    Ok(Some(constraints))
}
