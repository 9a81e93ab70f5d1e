//! Unilateral contacts in a run: changes their states where they meet, and reports the changes.

use std::string::String;
use std::vec;
use std::vec::Vec;

use super::contact_search::FoundChange;
use super::{LastInterpolant, Run, VectorOf};
use crate::balance::Quadratures;
use crate::contact::{Impact, Mode};
use crate::event::{self, Crossing, Event, state};
use crate::inputs::InputLaw;
use crate::phases::{Change, EnergyEntry};
use crate::solution::Ending;
use crate::step_error::StepError;
use crate::stepper::{Cause, ContactChanges};
use crate::{
    ContactEvent, ContactEventKind, ContactImpact, ContactTally, ContactTrouble, Error,
    ImpactAcross, Machine, System, Vector,
};

/// How often contacts may change at one instant, for each of them and beyond.
const MOST_CHANGES_AT_ONCE: usize = 8;

/// How often the time of an impact is corrected, at most.
const CORRECTIONS: usize = 8;

/// A gap that closes where it changes with the coordinates by less than this share of what it did at the start, the root of rounding, is taken
/// not to change with them: it does so the less the nearer it is to 0, and how near that is only rounding says.
const VANISHED: f64 = 1.5e-8;

/// How many roundings the energies of a machine have: as many as in its energy balance.
const ROUNDINGS_OF_ENERGIES: f64 = 16.0;

/// A change that waits for the stepper to come to its instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct PendingChange {
    change: FoundChange,
    /// The step to go on with.
    step: f64,
    corrected: usize,
}

/// What is told of a contact: which, what, the direction of its slip along both tangents, and its impact if it is one.
pub(super) type ReportedEvent = (usize, ContactEventKind, [f64; 2], Option<ContactImpact>);

/// What the run does next.
pub(super) enum AfterContacts {
    /// It steps again.
    Step,
    /// It keeps the last step.
    Keep,
    /// It ends.
    End(Ending),
}

impl<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> Run<'_, '_, M, L, A> {
    /// Contacts at the start of the run: what touches there is closed, or bounces.
    pub(super) fn resolve_contacts_at_start(&mut self) -> Result<(), Error> {
        let Some(touching) = self.stepper.touching().clone() else {
            return Ok(());
        };
        let (t, q, v) = (self.stepper.t(), self.stepper.q(), self.stepper.v());
        if let Some(contact) = touching.penetrated(self.model.system, t, q, v) {
            let trouble = ContactTrouble::Penetrates;
            let error = StepError::Contact {
                contact,
                trouble,
                t,
            };
            return Err(self.model.explain(error, q, v));
        }
        self.record.unilateral.losses = vec![0.0; touching.modes().len()];
        if self.settings.method.is_time_stepping() {
            return self.begin_stepping();
        }
        let step = self.settings.first_step.unwrap_or(0.0);
        let v_before = self.stepper.v().clone();
        self.resolve_contacts_now(Cause::Unspecified, step, true)?;
        self.watch_jumps_at_start(&v_before)
    }

    /// Follows the contacts through the last step.
    pub(super) fn follow_contacts(
        &mut self,
        pending_change: &mut Option<PendingChange>,
        interpolant: &mut LastInterpolant<M>,
        looks: bool,
        changes: &mut (f64, usize),
    ) -> Result<AfterContacts, Error> {
        if let Some(pending_change) = pending_change {
            // A gap is 0 at the end of the step, and not only on its dense output.
            if self.stepper.is_done()
                && pending_change.change.closes
                && pending_change.corrected < CORRECTIONS
            {
                let contact = pending_change.change.contact;
                let (t, q, v) = (self.stepper.t(), self.stepper.q(), self.stepper.v());
                let Some(touching) = self.stepper.touching() else {
                    return Ok(AfterContacts::Keep);
                };
                let near = touching.clearances(self.model.system, (t, q, v))[contact];
                let (gap, rate) = (near.value, near.rate);
                let next = t - gap / rate;
                let correction = (next - t).abs();
                let from = self.stepper.t_before();
                let is_within =
                    near.is_rate_of_value && next > from && correction < 0.5 * (t - from);
                if is_within && correction > f64::EPSILON * t.abs() {
                    pending_change.corrected += 1;
                    self.stepper.retreat_to_change(next);
                    return Ok(AfterContacts::Step);
                }
            }
            return Ok(AfterContacts::Keep);
        }
        if !looks {
            return Ok(AfterContacts::Keep);
        }
        let Some((t, change)) = self.contact_found(interpolant)? else {
            return Ok(AfterContacts::Keep);
        };
        let step = self.stepper.last_step();
        self.stepper.retreat_to_change(t);
        *pending_change = Some(PendingChange {
            change,
            step,
            corrected: 0,
        });
        if self.stepper.is_done()
            && let Some(ending) = self.resolve_pending_change(pending_change, changes)?
        {
            return Ok(AfterContacts::End(ending));
        }
        Ok(AfterContacts::Step)
    }

    /// Lets contacts meet, if the stepper stands where they do. The answer is the event that ends the run.
    pub(super) fn resolve_pending_change(
        &mut self,
        pending_change: &mut Option<PendingChange>,
        (last_t, times): &mut (f64, usize),
    ) -> Result<Option<Ending>, Error> {
        let Some(PendingChange { change, step, .. }) = pending_change.take() else {
            return Ok(None);
        };
        let t = self.stepper.t();
        *times = if *last_t == t { *times + 1 } else { 0 };
        *last_t = t;
        let contacts = self.model.system.unilateral_contacts().len();
        if *times > MOST_CHANGES_AT_ONCE * (1 + contacts) {
            let error = StepError::Contact {
                contact: change.contact,
                trouble: ContactTrouble::Unsettled,
                t,
            };
            if self.hand_over_unsettled(&error)? {
                return Ok(None);
            }
            let (q, v) = (self.stepper.q(), self.stepper.v());
            return Err(self.model.explain(error, q, v));
        }
        let v_before = self.stepper.v().clone();
        self.resolve_contacts_now(change.cause, step, false)?;
        self.hand_over_if_changes_are_frequent()?;
        self.watch_jumps(&v_before)
    }

    pub(super) fn resolve_contacts_now(
        &mut self,
        cause: Cause,
        step: f64,
        at_start: bool,
    ) -> Result<(), Error> {
        let before = (self.settings.hands_over).then(|| self.stepper.snapshot());
        let stored_before = at_start.then(|| self.stored_now());
        self.forget_values();
        let met = (self.stepper).resolve_contacts(cause, at_start, self.stop, step);
        let changes_at_instant = match met {
            Ok(changes_at_instant) => changes_at_instant,
            Err(error) => {
                let (q, v) = (self.stepper.q().clone(), self.stepper.v().clone());
                if let Some(before) = before {
                    self.stepper.restore(before);
                    if self.hand_over_unsettled(&error)? {
                        return Ok(());
                    }
                }
                return Err(self.model.explain(error, &q, &v));
            }
        };
        // Whether what closes on such a gap rests there is for rounding to say: it is not held.
        let closes = |k: usize| {
            !at_start && changes_at_instant.before[k] == Mode::Open && !self.is_compliant(k)
        };
        if let Some(contact) = self.contact_with_small_gradient(VANISHED, closes) {
            let error = StepError::Contact {
                contact,
                trouble: ContactTrouble::NotHeld,
                t: self.stepper.t(),
            };
            return Err((self.model).explain(error, self.stepper.q(), self.stepper.v()));
        }
        self.activity
            .record_changes(self.stepper.t(), &changes_at_instant);
        let told = changes_at_instant.told.clone();
        let (t, record) = (self.stepper.t(), &mut self.record.unilateral);
        record.shared_otherwise.note(t, &told.shared_otherwise);
        record.jammed.note(t, &told.jammed);
        if let Some(before) = stored_before {
            // What is pressed at the start holds its energy from there on.
            let stored = self.stored_now() - before;
            for energies in &mut self.record.energies {
                energies.potential += stored;
            }
        }
        // What touches at the start and is not hit changes nothing there.
        let is_change = !at_start || !changes_at_instant.impacts.is_empty();
        if is_change {
            if let Some(steps) = &mut self.record.steps {
                steps.jump(&self.stepper);
            }
            self.record_energies();
        }
        self.report_changes(&changes_at_instant, at_start);
        // At the start it is only known now what the contacts that touch there take.
        self.correct_energy_entry();
        self.keep_phase(Change {
            cause: Some(cause),
            impacts: changes_at_instant.impacts,
            ended: changes_at_instant
                .ended
                .iter()
                .map(|(contact, _)| *contact)
                .collect(),
        });
        self.follow_flights()
    }

    /// Where energy went in each contact so far.
    pub(super) fn energy_entry(&self) -> EnergyEntry {
        let Self {
            model,
            stepper,
            record,
            ..
        } = self;
        let (Some(integrals), Some(touching)) =
            (stepper.quadratures().integrals(), stepper.touching())
        else {
            return EnergyEntry::default();
        };
        let place = (stepper.t(), stepper.q(), stepper.v());
        let crushed = touching.crushing_works(model.system, place);
        let losses = &record.unilateral.losses;
        let of_each = crushed.into_iter().enumerate().map(|(k, crushing_work)| {
            let part = integrals.of_contact(k);
            let impact_loss = losses.get(k).copied().unwrap_or(0.0);
            touching.energies(k, part, impact_loss, crushing_work)
        });
        EnergyEntry {
            of_each: of_each.collect(),
            powers: (0..losses.len()).map(|k| integrals.power_of(k)).collect(),
        }
    }

    /// Writes down anew where energy went in each contact until now.
    pub(super) fn correct_energy_entry(&mut self) {
        let energy_entry = self.energy_entry();
        if let Some(last) = self.record.unilateral.energy_entries.last_mut() {
            *last = energy_entry;
        }
    }

    /// Writes down what happened.
    pub(super) fn report_changes(&mut self, changes: &ContactChanges, at_start: bool) {
        let mut reported = self.report_impacts(changes);
        let hit: Vec<usize> = reported.iter().map(|(contact, ..)| *contact).collect();
        for (contact, modes) in changes.before.iter().zip(&changes.after).enumerate() {
            // What is closed before the run does not close; what is hit at its start does.
            let closes_silently = at_start && !hit.contains(&contact);
            reported.extend(self.change_of_mode(contact, modes, closes_silently));
        }
        for &guide in &changes.switched {
            reported.push((guide, ContactEventKind::Switches, [0.0; 2], None));
        }
        for &(contact, is_loaded) in &changes.turned {
            let stays_closed = [changes.before[contact], changes.after[contact]];
            if stays_closed.iter().all(|mode| *mode != Mode::Open) {
                let kind = if is_loaded {
                    ContactEventKind::Crushes
                } else {
                    ContactEventKind::Turns
                };
                reported.push((contact, kind, [0.0; 2], None));
            }
        }
        let shared = changes.lost_at_end / changes.ended.len().max(1) as f64;
        for (contact, _) in &changes.ended {
            self.record.unilateral.losses[*contact] += shared;
        }
        self.enter_contact_events(reported, &changes.ended);
    }

    /// Writes down the losses of impacts, and returns those that are events.
    fn report_impacts(&mut self, changes: &ContactChanges) -> Vec<ReportedEvent> {
        let t = self.stepper.t();
        let mut reported = Vec::new();
        let size = |impulse: [f64; 2]| impulse[0].abs().max(impulse[1].abs());
        let greatest = (changes.impacts.iter()).fold(0.0_f64, |most, i| most.max(size(i.impulse)));
        for (place, impact) in changes.impacts.iter().enumerate() {
            let &Impact {
                contact,
                gap_rate,
                slip,
                impulse,
                loss,
                ..
            } = impact;
            self.record.unilateral.losses[contact] += loss;
            // What is at rest and is not hit has an impulse of rounding.
            let has_carrier = self.has_carrier(contact);
            let is_hit = size(impulse) > 1e-12 * greatest && !has_carrier;
            if is_hit {
                let across = self.across_of(&changes.impacts[place..]);
                let impact = ContactImpact {
                    gap_rate,
                    slip,
                    impulse,
                    loss: loss + across.map_or(0.0, |(_, loss)| loss),
                    across: across.map(|(across, _)| across),
                };
                reported.push((contact, ContactEventKind::Impact, [0.0; 2], Some(impact)));
            }
        }
        for impact in &changes.slight_impacts {
            self.record.unilateral.losses[impact.contact] += impact.loss;
        }
        self.record_energy_gains(&changes.impacts, 0.0, t);
        reported
    }

    /// The event that a contact's change of mode is, if it is one. `closes_silently` if closing is none.
    fn change_of_mode(
        &self,
        contact: usize,
        (before, after): (&Mode, &Mode),
        closes_silently: bool,
    ) -> Option<ReportedEvent> {
        use ContactEventKind::{Closes, Lifts, Opens, Reverses, Slips, Sticks};
        let (kind, direction) = match (*before, *after) {
            (Mode::Open, Mode::Open) => return None,
            // What depends on a contact closes and opens with it.
            (Mode::Open, _) | (_, Mode::Open) if self.has_carrier(contact) => return None,
            // What is done along both tangents is told of the contact.
            _ if self.is_across(contact) => return None,
            // A guide is never open.
            (Mode::Open, _) if self.is_guide(contact) => return None,
            (Mode::Open, _) if closes_silently => return None,
            (Mode::Open, _) => (Closes, 0.0),
            (_, Mode::Open) if self.is_compliant(contact) => (Opens, 0.0),
            (_, Mode::Open) => (Lifts, 0.0),
            (Mode::Slides(from), Mode::Slides(to)) if from != to => (Reverses, to),
            (Mode::Slides(from), Mode::Sticks) if from != 0.0 => (Sticks, 0.0),
            (Mode::Sticks, Mode::Slides(to)) if to != 0.0 => (Slips, to),
            (Mode::SlidesAlong(_), Mode::Sticks) => (Sticks, 0.0),
            (Mode::Sticks, Mode::SlidesAlong(_)) => (Slips, 0.0),
            _ => return None,
        };
        let directions = match kind {
            Slips => after.direction(),
            _ => [direction, 0.0],
        };
        Some((contact, kind, directions, None))
    }

    /// Writes down events of contacts now. `ended` are contacts whose bounces came to their end, with how long these would
    /// have gone on, in s.
    pub(super) fn enter_contact_events(
        &mut self,
        reported: Vec<ReportedEvent>,
        ended: &[(usize, f64)],
    ) {
        let system = self.model.system;
        let contacts = system.unilateral_contacts().len();
        let tallies = &mut self.record.unilateral.tallies;
        tallies.resize(contacts, ContactTally::default());
        if reported.is_empty() {
            return;
        }
        let (q, v) = (self.stepper.q().clone(), self.stepper.v().clone());
        let now = state(system, (self.stepper.t(), q, v));
        let names: Vec<String> = (system.unilateral_contacts())
            .map(|contact| contact.name.into())
            .collect();
        let left = |contact: usize, kind: ContactEventKind| {
            let ended = ended.iter().find(|(ended, _)| *ended == contact);
            match (kind, ended) {
                (ContactEventKind::Closes, Some((_, left))) => *left,
                _ => 0.0,
            }
        };
        let mut reported: Vec<(f64, ReportedEvent)> = (reported.into_iter())
            .map(|event| (left(event.0, event.1), event))
            .collect();
        reported.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        // Events that follow the end of bounces are not reported before it: their time is as uncertain.
        let mut latest = self.record.unilateral.last_event.unwrap_or(now.t);
        for (left, (contact, kind, direction, impact)) in reported {
            let mut state = now.clone();
            latest = (now.t + left).min(self.until).max(latest);
            state.t = latest;
            let time_error = left.max(latest - now.t);
            let kept = &mut self.record.unilateral;
            kept.last_event = Some(latest);
            let tally = &mut kept.tallies[contact];
            match kind {
                ContactEventKind::Impact => tally.impacts += 1,
                ContactEventKind::Closes => {
                    (tally.closed_at, tally.time_error) = (Some(latest), time_error);
                }
                _ => {}
            }
            if !self.settings.keep_contact_events {
                continue;
            }
            self.record.events.push(Event {
                name: std::format!("{} {}", names[contact], kind.word()),
                crossing: match kind {
                    ContactEventKind::Lifts | ContactEventKind::Opens | ContactEventKind::Slips => {
                        Crossing::Rising
                    }
                    _ => Crossing::Falling,
                },
                state: state.clone(),
            });
            self.record.unilateral.events.push(ContactEvent {
                contact: names[contact].clone(),
                kind,
                state,
                direction: direction[0],
                across: direction[1],
                time_error,
                impact,
            });
        }
    }

    /// Whether a contact is the rolling of another.
    pub(super) fn has_carrier(&self, contact: usize) -> bool {
        let touching = self.stepper.touching().as_ref();
        touching.is_some_and(|touching| touching.carrier(contact).is_some())
    }

    /// Whether a contact is a guide.
    fn is_guide(&self, contact: usize) -> bool {
        let touching = self.stepper.touching().as_ref();
        touching.is_some_and(|touching| touching.is_guide(contact))
    }

    /// Whether it is the second tangent of a contact.
    pub(super) fn is_across(&self, contact: usize) -> bool {
        let touching = self.stepper.touching().as_ref();
        touching.is_some_and(|touching| touching.first(contact) != contact)
    }

    /// What the first of these impacts did along the second tangent of its contact, if it has one, and the loss of that: what is
    /// next among them.
    pub(super) fn across_of(&self, impacts: &[Impact]) -> Option<(ImpactAcross, f64)> {
        let [own, next, ..] = impacts else {
            return None;
        };
        let is_own = next.contact == own.contact + 1 && self.is_across(next.contact);
        let across = ImpactAcross {
            slip: next.slip,
            impulse: next.impulse[1],
        };
        is_own.then_some((across, next.loss))
    }

    fn is_compliant(&self, contact: usize) -> bool {
        let mut contacts = self.model.system.unilateral_contacts();
        (contacts.nth(contact)).is_some_and(|contact| contact.compliance.is_some())
    }

    /// Notes impacts that have created energy beyond rounding: that of the impulses, and that of the energies at hand, in whose balance no less
    /// can be seen.
    pub(super) fn record_energy_gains(&mut self, impacts: &[Impact], untold: f64, t: f64) {
        let loss: f64 = impacts.iter().map(|impact| impact.loss).sum();
        let exchanged: f64 = (impacts.iter())
            .map(|i| (i.impulse[0] * i.gap_rate[0]).abs() + (i.impulse[1] * i.slip[0]).abs())
            .sum();
        if loss >= 0.0 {
            return;
        }
        let (t_now, q, v) = (self.stepper.t(), self.stepper.q(), self.stepper.v());
        let inputs = self.model.inputs(t_now, q, v);
        let known = |energy: f64| if energy.is_nan() { 0.0 } else { energy.abs() };
        let kinetic = known(self.kinetic_energy_now()).max(self.record.kinetic_energy);
        let potential =
            known(self.model.system.potential_energy(t_now, q, &inputs) + self.stored_now());
        let of_energies = ROUNDINGS_OF_ENERGIES * f64::EPSILON * (kinetic + potential);
        if -loss <= 1e-12 * (exchanged + kinetic) + of_energies + untold {
            return;
        }
        let kept = &mut self.record.unilateral;
        kept.energy_gains += 1;
        let own = impacts.iter().min_by(|a, b| a.loss.total_cmp(&b.loss));
        if kept.worst.is_none_or(|(.., gain)| gain < -loss) {
            kept.worst = own.map(|own| (own.contact, t, -loss));
        }
    }

    /// Functions that are watched may have jumped with the rates, which were `v_before`, or with accelerations or inputs.
    pub(super) fn watch_jumps(&mut self, v_before: &VectorOf<M>) -> Result<Option<Ending>, Error> {
        let Self {
            model,
            stepper,
            callbacks,
            record,
            ..
        } = self;
        let (t, q, v) = (stepper.t(), stepper.q().clone(), stepper.v().clone());
        let forward = self.until >= self.start;
        let now = state(model.system, (t, q, v));
        let mut ending = None;
        for watch in &mut callbacks.watches {
            if !watch.begun {
                continue;
            }
            let observe = || model.observed_system.observe::<M, A>(stepper, &now);
            let value = watch.value(&now, &observe)?;
            let mut rounding = None;
            if event::may_be_zero_after(value, watch.at_end, watch.touched != 0.0) {
                let known = event::at_end(stepper, v_before);
                let found = watch.value_and_rounding(&model.observed_system, stepper, &known)?;
                rounding = Some(found.1);
            }
            let Some(crossing) = watch.jump(value, rounding, forward) else {
                continue;
            };
            if !watch.crossing.counts(crossing) {
                continue;
            }
            record.push_watched(Event {
                name: watch.name.clone(),
                crossing,
                state: now.clone(),
            });
            if watch.counts() && ending.is_none() {
                ending = Some(Ending::Event(watch.name.clone()));
            }
        }
        Ok(ending)
    }

    /// Functions that are watched may have jumped with the rates in an impact at the start. Their events there are found in the first step.
    fn watch_jumps_at_start(&mut self, v_before: &VectorOf<M>) -> Result<(), Error> {
        if self.stepper.v().as_slice() == v_before.as_slice() {
            return Ok(());
        }
        let Self {
            model,
            stepper,
            callbacks,
            ..
        } = self;
        let known = event::at_end(stepper, v_before);
        for watch in &mut callbacks.watches {
            let (value, rounding) =
                watch.value_and_rounding(&model.observed_system, stepper, &known)?;
            watch.jump_at_start(value, rounding);
        }
        Ok(())
    }

    /// Looks again at the watched functions where the run starts: something has jumped there.
    pub(super) fn begin_watches_again(&mut self) -> Result<(), Error> {
        let Self {
            model,
            stepper,
            callbacks,
            ..
        } = self;
        let now = (stepper.t(), stepper.q().clone(), stepper.v().clone());
        let now = state(model.system, now);
        let observe = || model.observed_system.observe::<M, A>(stepper, &now);
        for watch in &mut callbacks.watches {
            watch.begin(&now, watch.at_zero, &observe)?;
        }
        Ok(())
    }
}
