//! Unilateral contacts in a run: when gaps close and forces vanish, and what is told of it.

use std::string::String;
use std::vec;
use std::vec::Vec;

use super::{LastInterpolant, Run, VectorOf};
use crate::at::At;
use crate::balance::Quadratures;
use crate::contact::{Impact, Mode};
use crate::event::{self, Crossing, Event, Triple, state, step_motion};
use crate::inputs::InputLaw;
use crate::phases::{Change, EnergyEntry};
use crate::roots;
use crate::solution::Ending;
use crate::step_error::StepError;
use crate::stepper::{Cause, ContactChanges};
use crate::{
    ContactEvent, ContactEventKind, ContactImpact, ContactTally, ContactTrouble, Error,
    ImpactAcross, Machine, Stepper, System, Vector,
};

/// How often contacts may change at one instant, for each of them and beyond.
const MOST_CHANGES_AT_ONCE: usize = 8;

/// How often the time of an impact is corrected, at most.
const CORRECTIONS: usize = 8;

/// Where several contacts share a load in ways that only all together can tell, a change is looked for so far
/// behind the place where it is seen, as a part of the step.
const BEYOND: f64 = 1e-9;

/// Between two looks at a gap no angle that it depends on turns further than this, in rad.
const TURN_BETWEEN_SAMPLES: f64 = 0.5;

/// Between two looks a gap falls no faster than this many times the greatest of its rates at looks.
const MOST_RATE_GROWTH: f64 = 2.0;

/// A gap that falls below zero for less than this part of the time between two looks is taken not to.
const NARROWEST_DIP: f64 = 1e-8;

/// Where a gap is found below zero, it is open this part of the time between two looks before that, or less.
const SHORT_FALL: f64 = 1.0 / 64.0;

/// The most values of a gap between two looks that tell whether it falls below zero.
const MOST_VALUES_OF_GAP: usize = 2000;

/// What opens at a look is looked at from this part of the way to the next one on.
const OPENED: f64 = 1e-3;

/// A flight that begins at a look with no rate beyond rounding is found if it takes at least this part of the step. A gap that does not
/// open falls by more than its rounding by then.
const LEAST_FLIGHT: f64 = 1e-6;

/// The most looks at a step.
const MOST_SAMPLES: f64 = 1e6;

/// A gap that closes where it changes with the coordinates by less than this share of what it did at the start, the root of rounding, is taken
/// not to change with them: it does so the less the nearer it is to 0, and how near that is only rounding says.
const VANISHED: f64 = 1.5e-8;

/// A slip in space that comes to rest, or turns by a right angle, is followed in a step of its own from this part of the way on; and
/// no further where that part of the step is less than the second.
pub(super) const APPROACH: f64 = 0.9;
pub(super) const LEAST_APPROACH: f64 = 1e-9;

/// Where nothing yet pulls at a contact that begins to slip, the next place to look at is so many times as far.
const LATER: f64 = 4.0;

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

/// A change of contacts that is found in a step.
#[derive(Clone, Copy, Debug)]
struct FoundChange {
    cause: Cause,
    /// The contact that changes, or one of several.
    contact: usize,
    /// Whether its gap closes.
    closes: bool,
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
            return self.begin_stepping(&touching);
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
                    self.stepper.retreat(next);
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
        self.stepper.retreat(t);
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
        Ok(())
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
    pub(super) fn report_changes(&mut self, changes_at_instant: &ContactChanges, at_start: bool) {
        let t = self.stepper.t();
        let mut reported: Vec<ReportedEvent> = Vec::new();
        let size = |impulse: [f64; 2]| impulse[0].abs().max(impulse[1].abs());
        let greatest =
            (changes_at_instant.impacts.iter()).fold(0.0_f64, |most, i| most.max(size(i.impulse)));
        for (place, impact) in changes_at_instant.impacts.iter().enumerate() {
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
                let across = self.across_of(&changes_at_instant.impacts[place..]);
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
        self.record_energy_gains(&changes_at_instant.impacts, t);
        let hit: Vec<usize> = reported.iter().map(|(contact, ..)| *contact).collect();
        for (contact, (before, after)) in changes_at_instant
            .before
            .iter()
            .zip(&changes_at_instant.after)
            .enumerate()
        {
            use ContactEventKind::{Closes, Lifts, Opens, Reverses, Slips, Sticks};
            let (kind, direction) = match (*before, *after) {
                (Mode::Open, Mode::Open) => continue,
                // What leans on a contact closes and opens with it.
                (Mode::Open, _) | (_, Mode::Open) if self.has_carrier(contact) => continue,
                // What is done along both tangents is told of the contact.
                _ if self.is_across(contact) => continue,
                // What is closed before the run does not close; what is hit at its start does.
                (Mode::Open, _) if at_start && !hit.contains(&contact) => continue,
                (Mode::Open, _) => (Closes, 0.0),
                (_, Mode::Open) if self.is_compliant(contact) => (Opens, 0.0),
                (_, Mode::Open) => (Lifts, 0.0),
                (Mode::Slides(from), Mode::Slides(to)) if from != to => (Reverses, to),
                (Mode::Slides(from), Mode::Sticks) if from != 0.0 => (Sticks, 0.0),
                (Mode::Sticks, Mode::Slides(to)) if to != 0.0 => (Slips, to),
                (Mode::SlidesAlong(_), Mode::Sticks) => (Sticks, 0.0),
                (Mode::Sticks, Mode::SlidesAlong(_)) => (Slips, 0.0),
                _ => continue,
            };
            let directions = match kind {
                Slips => after.direction(),
                _ => [direction, 0.0],
            };
            reported.push((contact, kind, directions, None));
        }
        for &(contact, is_loaded) in &changes_at_instant.turned {
            let (before, after) = (
                changes_at_instant.before[contact],
                changes_at_instant.after[contact],
            );
            if before != Mode::Open && after != Mode::Open {
                let kind = if is_loaded {
                    ContactEventKind::Crushes
                } else {
                    ContactEventKind::Turns
                };
                reported.push((contact, kind, [0.0; 2], None));
            }
        }
        let shared = changes_at_instant.lost_at_end / changes_at_instant.ended.len().max(1) as f64;
        for (contact, _) in &changes_at_instant.ended {
            self.record.unilateral.losses[*contact] += shared;
        }
        self.enter_contact_events(reported, &changes_at_instant.ended);
    }

    /// Writes down events of contacts now. `ended` are contacts whose bounces came to their end, with how long these would
    /// have gone on, in s.
    pub(super) fn enter_contact_events(
        &mut self,
        reported: Vec<ReportedEvent>,
        ended: &[(usize, f64)],
    ) {
        let system = self.model.system;
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
        self.record
            .unilateral
            .tallies
            .resize(names.len(), ContactTally::default());
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
    pub(super) fn record_energy_gains(&mut self, impacts: &[Impact], t: f64) {
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
        if -loss <= 1e-12 * (exchanged + kinetic) + of_energies {
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

    /// When contacts change in the last step, and how.
    fn contact_found(
        &mut self,
        interpolant: &mut LastInterpolant<M>,
    ) -> Result<Option<(f64, FoundChange)>, Error> {
        let Self { model, stepper, .. } = self;
        let Some(touching) = stepper.touching().clone() else {
            return Ok(None);
        };
        let system = model.system;
        let roundoff = event::theta_roundoff(stepper);
        let beginning = (
            stepper.t_before(),
            stepper.q_before().clone(),
            stepper.v_before().clone(),
        );
        let clearances = |(t, q, v): &Triple<VectorOf<M>>| touching.clearances(system, (*t, q, v));
        let mut before = clearances(&beginning);
        let mut theta_before = 0.0;
        let looks = looks(system, stepper);
        let thetas = (1..=looks).map(|look| look as f64 / looks as f64);
        // The gap of polygons is a greatest distance: it may fall below zero and come back between two looks. How far it may fall is told by
        // the greatest of its rates, for which the whole step is looked at first.
        let corners: Vec<usize> = system
            .unilateral_contacts()
            .enumerate()
            .filter(|(k, contact)| contact.has_face && touching.modes()[*k] == Mode::Open)
            .map(|(k, _)| k)
            .collect();
        let mut falls = vec![0.0_f64; touching.modes().len()];
        if !corners.is_empty() {
            for theta in thetas.clone() {
                let now = clearances(&event::interpolated_at(stepper, theta));
                for &k in &corners {
                    falls[k] = falls[k].max(now[k].rate.abs()).max(before[k].rate.abs());
                }
            }
        }
        for theta in thetas {
            let looked = event::interpolated_at(stepper, theta);
            let now = clearances(&looked);
            let mut earliest: Option<(f64, FoundChange)> = None;
            for (k, mode) in touching.modes().iter().enumerate() {
                if *mode != Mode::Open || touching.carrier(k).is_some() {
                    continue;
                }
                let (from, to) = (before[k], now[k]);
                let mut between = [theta_before, theta];
                let part = stepper.last_step().abs() * (theta - theta_before);
                let may_fall = |greatest_rate: f64| MOST_RATE_GROWTH * greatest_rate * part;
                let comes_back = from.rate < 0.0
                    && to.rate > 0.0
                    && from.value <= may_fall(to.rate.max(-from.rate));
                let mut closes = to.value < 0.0 || comes_back;
                let fall = may_fall(falls[k]);
                if fall > 0.0 && from.value.min(to.value) < fall {
                    let gap = |theta: f64| {
                        let (t, q, v) = event::interpolated_at(stepper, theta);
                        Ok(touching.clearances(system, (t, &q, &v))[k].value)
                    };
                    let fall_of_step = MOST_RATE_GROWTH * falls[k] * stepper.last_step().abs();
                    let (t, q, v) = &beginning;
                    let rounding = touching.gap_rounding(system, (*t, q, v), k);
                    let fallen = find_penetration(between, (fall_of_step, rounding), gap)?;
                    if let Some(fallen) = fallen {
                        (between, closes) = (fallen, true);
                    }
                }
                if !closes {
                    continue;
                }
                let interpolant = step_motion(interpolant, stepper, system)?;
                let at = |theta: f64| {
                    let (t, q, v) = if theta == 0.0 {
                        beginning.clone()
                    } else {
                        event::state_at(system, stepper, interpolant, theta)?
                    };
                    let near = touching.clearances(system, (t, &q, &v))[k];
                    Ok([near.value, near.rate])
                };
                let is_compliant = touching.is_compliant(k);
                let found = if is_compliant {
                    find_loading_start(between, roundoff, at)?
                } else {
                    closing(between, roundoff, at)?
                };
                if let Some(found) = found
                    && earliest.is_none_or(|(known, ..)| found < known)
                {
                    let cause = if is_compliant {
                        Cause::Presses(k)
                    } else {
                        Cause::Unspecified
                    };
                    let change = FoundChange {
                        cause,
                        contact: k,
                        closes: true,
                    };
                    earliest = Some((found, change));
                }
            }
            if !touching.is_free() {
                let mut exact = None;
                let margins = |(t, q, v): &Triple<VectorOf<M>>| {
                    let inputs = model.inputs(*t, q, v);
                    touching
                        .margins(
                            system,
                            At {
                                t: *t,
                                q,
                                v,
                                u: &inputs,
                            },
                        )
                        .map_err(|error| model.explain(error, q, v))
                };
                let pull = |k: usize, (t, q, v): &Triple<VectorOf<M>>| {
                    let inputs = model.inputs(*t, q, v);
                    touching
                        .pull_along(
                            system,
                            At {
                                t: *t,
                                q,
                                v,
                                u: &inputs,
                            },
                            k,
                        )
                        .map_err(|error| model.explain(error, q, v))
                };
                let seen = margins(&looked)?;
                let doubtful = |k: usize, kind: usize| seen.each[k][kind].value < 0.0;
                for (k, kind) in (0..seen.each.len()).flat_map(|k| [(k, 0), (k, 1), (k, 2), (k, 3)])
                {
                    if !doubtful(k, kind) {
                        continue;
                    }
                    let interpolant = step_motion(interpolant, stepper, system)?;
                    let exactly = |theta: f64| {
                        if theta == 0.0 {
                            return margins(&beginning);
                        }
                        margins(&event::state_at(system, stepper, interpolant, theta)?)
                    };
                    // At both looks, the same for all margins that are doubtful.
                    let [at_first, at_second] = match &exact {
                        Some(exact) => exact,
                        None => exact.insert([exactly(theta_before)?, exactly(theta)?]),
                    };
                    if !at_second.each[k][kind].is_lost_since(at_first.each[k][kind]) {
                        continue;
                    }
                    let shares = at_second.shares[k];
                    let margin = |theta| Ok(exactly(theta)?.each[k][kind].value);
                    let mut found =
                        event::last_positive([theta_before, theta], roundoff, &mut &margin)?;
                    // Where a face ends and when a slip stops is seen in the motion itself, however a load is shared.
                    let mode = touching.modes()[k];
                    let is_of_motion = kind == 3 || kind == 1 && matches!(mode, Mode::Slides(_));
                    let is_shared =
                        shares && !is_of_motion && (kind == 1 || !touching.is_compliant(k));
                    let mut cause = match (is_shared, mode, kind) {
                        (true, ..) => Cause::Unspecified,
                        (_, _, 3) => Cause::Leaves(k),
                        (_, _, 0) => Cause::Lifts(k),
                        (_, _, 2) => Cause::Turns(k),
                        (_, Mode::Slides(_) | Mode::SlidesAlong(_), _) => Cause::Stops(k),
                        _ => {
                            let pull = |theta: f64| {
                                if theta == 0.0 {
                                    return pull(k, &beginning);
                                }
                                let looked = event::state_at(system, stepper, interpolant, theta)?;
                                pull(k, &looked)
                            };
                            Cause::Breaks(k, beginning_slip([found, theta], roundoff, pull)?)
                        }
                    };
                    if is_shared {
                        found = (found + BEYOND).min(theta);
                    }
                    if cause == Cause::Stops(k) && found > LEAST_APPROACH {
                        let (t, q, v) = event::state_at(system, stepper, interpolant, found)?;
                        if !touching.is_slow(system, (t, &q, &v), k) {
                            // It has turned, or stops where the step is too long to tell: up to shortly before.
                            (found, cause) = (APPROACH * found, Cause::Unspecified);
                        }
                    }
                    if earliest.is_none_or(|(known, ..)| found < known) {
                        let change = FoundChange {
                            cause,
                            contact: k,
                            closes: false,
                        };
                        earliest = Some((found, change));
                    }
                }
            }
            if let Some((theta, change)) = earliest {
                let t = if theta == 0.0 {
                    beginning.0
                } else {
                    let interpolant = step_motion(interpolant, stepper, system)?;
                    interpolant.time_at(theta)
                };
                return Ok(Some((t, change)));
            }
            (before, theta_before) = (now, theta);
        }
        Ok(None)
    }
}

/// The direction in which a contact begins to slip whose friction is used up `from` there: it is pulled in this direction there or, if nothing pulls it
/// yet, as where it has no friction and the force on it begins to grow, just after that. `to` is where it is seen.
fn beginning_slip(
    [from, to]: [f64; 2],
    roundoff: f64,
    mut pull: impl FnMut(f64) -> Result<Option<[f64; 2]>, Error>,
) -> Result<[f64; 2], Error> {
    if let Some(direction) = pull(from)? {
        return Ok(direction);
    }
    let mut part = roundoff;
    while part < to - from {
        if let Some(direction) = pull(from + part)? {
            return Ok(direction);
        }
        part *= LATER;
    }
    Ok(pull(to)?.unwrap_or_default())
}

/// Where a gap with kinks that is open at a look first falls below zero before another one: from where it is open to where it is below zero. It falls
/// no faster than by `fall` in a step. Values within `rounding` of zero say nothing: where a gap begins to open, they are negative and positive in turn.
///
/// The bound tells where between two values there can be none below zero, so that none is missed between the kinks (S. A. Piyavskii, USSR Comput. Math. Math.
/// Phys. 12 (1972) 57–67; B. O. Shubert, SIAM J. Numer. Anal. 9 (1972) 379–388).
fn find_penetration(
    [from, to]: [f64; 2],
    (fall, rounding): (f64, f64),
    mut gap: impl FnMut(f64) -> Result<f64, Error>,
) -> Result<Option<[f64; 2]>, Error> {
    let mut first = (from, gap(from)?);
    if first.1 <= 0.0 {
        let opened = from + OPENED * (to - from);
        first = (opened, gap(opened)?);
        if first.1 <= 0.0 {
            return Ok(None);
        }
    }
    let narrowest = NARROWEST_DIP * (to - from);
    // The ends of intervals that follow the first one, the next one last.
    let mut ends = vec![(to, gap(to)?)];
    let mut left = MOST_VALUES_OF_GAP;
    while let Some(&(end, value)) = ends.last() {
        let (start, before) = first;
        let width = end - start;
        let is_fallen = value < -rounding;
        if is_fallen && width <= SHORT_FALL * (to - from) {
            return Ok(Some([start, end]));
        }
        let least = 0.5 * (before + value - fall * width);
        if !is_fallen && (least >= -rounding || width <= narrowest) {
            first = (end, value);
            ends.pop();
            continue;
        }
        if left == 0 {
            break;
        }
        left -= 1;
        let middle = 0.5 * (start + end);
        let place = if is_fallen {
            middle
        } else {
            // Where the gap could be least.
            middle + 0.5 * (before - value) / fall
        };
        ends.push((place, gap(place)?));
    }
    match ends.last() {
        None => return Ok(None),
        Some(&(end, value)) if value < -rounding => return Ok(Some([first.0, end])),
        Some(_) => {}
    }
    // The gap is next to zero over much of the step.
    let mut extent = [None; 2];
    roots::extremes(gap, [first.0, to], &mut extent, [true, false])?;
    let least = extent[0].filter(|(least, _)| *least < -rounding);
    Ok(least.map(|(_, place)| [first.0, place]))
}

/// Into how many parts the looks at contacts divide the last step: four, and more where something turns far that a gap depends on.
fn looks<S: System, L: InputLaw<S>, A: Quadratures<S>>(
    system: &S,
    stepper: &Stepper<'_, S, L, A>,
) -> usize {
    const FEWEST: usize = event::SAMPLE_FRACTIONS.len();
    let at_once = FEWEST as f64 * TURN_BETWEEN_SAMPLES;
    if event::turn(system, stepper, |_| true) <= at_once {
        return FEWEST;
    }
    let (n, m) = (
        stepper.q().as_slice().len(),
        system.unilateral_contacts().len(),
    );
    let mut rows = vec![0.0; 2 * m * n];
    system.contact_matrix(stepper.t(), stepper.q(), &mut rows);
    let counts = |i: usize| (0..m).any(|contact| rows[2 * contact * n + i] != 0.0);
    let turn = event::turn(system, stepper, counts);
    (turn / TURN_BETWEEN_SAMPLES)
        .ceil()
        .clamp(FEWEST as f64, MOST_SAMPLES) as usize
}

/// Where a gap closes between two looks at an open contact, if it does: not before it has opened, where it begins
/// closed, and not where it comes near and goes away again.
fn closing(
    [from, to]: [f64; 2],
    roundoff: f64,
    mut at: impl FnMut(f64) -> Result<[f64; 2], Error>,
) -> Result<Option<f64>, Error> {
    let [gap, rate] = at(from)?;
    let [gap_after, rate_after] = at(to)?;
    let mut open = from;
    if gap <= 0.0 {
        if gap_after >= 0.0 {
            return Ok(None);
        }
        if rate > 0.0 && rate_after < 0.0 {
            // It opens first: up to where it is greatest.
            open = event::root([from, to], roundoff, &mut |theta| Ok(at(theta)?[1]))?;
            if at(open)?[0] <= 0.0 {
                return Ok(Some(open));
            }
        } else if let Some(opened) = find_open([from, to], LEAST_FLIGHT, &mut at)? {
            // It opens by its acceleration alone: the rate is rounding.
            open = opened;
        } else {
            return Ok(Some(if rate <= 0.0 { from } else { to }));
        }
    }
    if gap_after < 0.0 {
        let found = event::root([open, to], roundoff, &mut |theta| Ok(at(theta)?[0]))?;
        return Ok(Some(found));
    }
    if rate < 0.0 && rate_after > 0.0 {
        let nearest = event::root([open, to], roundoff, &mut |theta| Ok(at(theta)?[1]))?;
        // A gap that falls for at most 1e-6 of the step before it opens falls by at most 1e-12 of its later opening: its rate at the start was
        // round-off, and nothing closes.
        let is_rounding = nearest - from <= LEAST_FLIGHT;
        if !is_rounding && at(nearest)?[0] < 0.0 {
            let found = event::root([open, nearest], roundoff, &mut |theta| Ok(at(theta)?[0]))?;
            return Ok(Some(found));
        }
    }
    Ok(None)
}

/// Where what is closed at the first of two looks is open between them, if it is: at the half, quarter, eighth, … of the way, no
/// closer to its beginning than `least`.
fn find_open(
    [from, to]: [f64; 2],
    least: f64,
    at: &mut impl FnMut(f64) -> Result<[f64; 2], Error>,
) -> Result<Option<f64>, Error> {
    let mut part = 0.5 * (to - from);
    while part > least {
        if at(from + part)?[0] > 0.0 {
            return Ok(Some(from + part));
        }
        part *= 0.5;
    }
    Ok(None)
}

/// Where a contact that yields begins to press between two looks, if it does.
fn find_loading_start(
    [from, to]: [f64; 2],
    roundoff: f64,
    mut at: impl FnMut(f64) -> Result<[f64; 2], Error>,
) -> Result<Option<f64>, Error> {
    let [clearance, rate] = at(from)?;
    let [clearance_after, rate_after] = at(to)?;
    if clearance_after < 0.0 {
        let mut open = from;
        if clearance <= 0.0 {
            // It has just opened, and goes on doing so for a while; or it is pressed from here on.
            match find_open([from, to], roundoff, &mut at)? {
                Some(opened) => open = opened,
                None => return Ok(Some(from)),
            }
        }
        let found = event::root([open, to], roundoff, &mut |theta| Ok(at(theta)?[0]))?;
        return Ok(Some(found));
    }
    if clearance >= 0.0 && rate < 0.0 && rate_after > 0.0 {
        let nearest = event::root([from, to], roundoff, &mut |theta| Ok(at(theta)?[1]))?;
        if at(nearest)?[0] < 0.0 {
            let found = event::root([from, nearest], roundoff, &mut |theta| Ok(at(theta)?[0]))?;
            return Ok(Some(found));
        }
    }
    Ok(None)
}
