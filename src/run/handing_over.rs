//! Changes a run to time stepping when contacts change too often for each instant to be located, and back to locating every event when
//! they have become quiet.

use std::collections::VecDeque;
use std::vec;
use std::vec::Vec;

use super::{Record, Run, VectorOf};
use crate::balance::Quadratures;
use crate::contact::Mode;
use crate::inputs::InputLaw;
use crate::methods::MethodKind;
use crate::phases::{Change, Phase};
use crate::solution::Handover;
use crate::stepper::ContactChanges;
use crate::{ContactTrouble, Error, Machine, StepError, System};

/// Number of instants of changes that are evaluated together.
const WINDOW: usize = 128;

/// If fewer contacts than this are closed in space, where each step solves for friction cones, events cost less than steps even where contacts share loads in
/// several ways.
const MANY_IN_SPACE: usize = 16;

/// Bounces of fewer contacts than this accumulate in geometric series, whose end is found otherwise.
const FEWEST_CONTACTS: usize = 3;

/// The length of a step, as a fraction of the time in which the largest recent forces would stop the fastest closing gap.
const STEP_FRACTION: f64 = 1.0 / 256.0;

/// Number of steps without a change of contacts after which every event is located again; it doubles each time that this did not last.
const QUIET_STEPS: usize = 64;

/// The machine is at rest if its kinetic energy is at most this fraction of the largest at the ends of steps of time stepping.
const REST_ENERGY: f64 = 1e-20;

/// Steps that have been lengthened at rest are at least so many times as long as the one that was chosen.
const LONG_STEP: f64 = 1.5;

/// How frequently contacts change, and how long they have been quiet.
#[derive(Debug)]
pub(super) struct ContactActivity {
    /// Whether the run may change to time stepping at all.
    is_free: bool,
    /// The number of contacts that are not guides.
    bouncing: usize,
    /// The last instants at which contacts changed.
    times: VecDeque<f64>,
    /// The accelerations at which forces close gaps at these instants, in m/s². At a single instant this may be almost zero: a spring
    /// passes through rest just when it releases.
    closing_accelerations: VecDeque<f64>,
    /// Whether contacts changed last at the same instant as before: several changes at one instant count once.
    is_same_instant: bool,
    /// The number of instants, and for each contact the number of its last.
    count: usize,
    last: Vec<usize>,
    /// Which contacts are second tangents of others.
    across: Vec<bool>,
    /// Number of consecutive steps of time stepping without a change of contacts, and the number required.
    quiet: usize,
    needed: usize,
    /// The length chosen for steps of time stepping, in s, and the largest kinetic energy at their ends, in J.
    step: f64,
    kinetic: f64,
}

impl ContactActivity {
    /// For a machine with these contacts, of which it is said which ones are second tangents of others. So many of them, the last ones, are guides, which do not bounce.
    pub fn new(is_free: bool, guides: usize, across: Vec<bool>) -> Self {
        let contacts = across.len();
        let bouncing = contacts.saturating_sub(guides);
        Self {
            is_free: is_free && bouncing >= FEWEST_CONTACTS,
            bouncing,
            times: VecDeque::new(),
            closing_accelerations: VecDeque::new(),
            is_same_instant: false,
            count: 0,
            last: vec![0; contacts],
            across,
            quiet: 0,
            needed: QUIET_STEPS,
            step: 0.0,
            kinetic: 0.0,
        }
    }

    /// Records the changes at an instant.
    pub fn record_changes(&mut self, t: f64, changes_at_instant: &ContactChanges) {
        if !self.is_free {
            return;
        }
        self.is_same_instant = self.times.back() == Some(&t);
        if !self.is_same_instant {
            self.count += 1;
            if self.times.len() == WINDOW {
                self.times.pop_front();
            }
            self.times.push_back(t);
        }
        let modes = changes_at_instant
            .before
            .iter()
            .zip(&changes_at_instant.after);
        for (k, (before, after)) in modes.enumerate() {
            if before != after {
                self.last[k] = self.count;
            }
        }
        for impact in &changes_at_instant.impacts {
            self.last[impact.contact] = self.count;
        }
    }

    /// Records a step of time stepping.
    pub fn count_quiet_step(&mut self, is_quiet: bool) {
        self.quiet = if is_quiet { self.quiet + 1 } else { 0 };
    }

    /// Records the acceleration at which forces close gaps.
    fn record_closing_acceleration(&mut self, closing_acceleration: f64) {
        if self.is_same_instant
            && let Some(last) = self.closing_accelerations.back_mut()
        {
            *last = last.max(closing_acceleration);
            return;
        }
        if self.closing_accelerations.len() == WINDOW {
            self.closing_accelerations.pop_front();
        }
        self.closing_accelerations.push_back(closing_acceleration);
    }

    /// The duration of the last `WINDOW` instants, if there were as many, and enough contacts took part.
    fn window(&self) -> Option<f64> {
        let (first, last) = (self.times.front()?, self.times.back()?);
        let since = self.count.saturating_sub(WINDOW);
        let changed = self.last[..self.bouncing].iter();
        let several = changed.filter(|last| **last > since).count() >= FEWEST_CONTACTS;
        (self.times.len() == WINDOW && several).then_some(last - first)
    }
}

impl<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> Run<'_, '_, M, L, A> {
    /// Changes to time stepping if contacts have changed more often than it would take steps. Then it costs less, and where changes
    /// accumulate without end, arbitrarily less.
    pub(super) fn hand_over_if_changes_are_frequent(&mut self) -> Result<(), Error> {
        if !self.activity.is_free {
            return Ok(());
        }
        let step = self.length_of_steps();
        let Some(took) = self.activity.window() else {
            return Ok(());
        };
        if took <= WINDOW as f64 * step {
            self.hand_over(step, Some((WINDOW, took)))?;
        }
        Ok(())
    }

    /// Changes to time stepping if contacts do not settle at one instant and it is allowed; returns whether it does.
    pub(super) fn hand_over_unsettled(&mut self, error: &StepError) -> Result<bool, Error> {
        let StepError::Contact { trouble, .. } = error else {
            return Ok(false);
        };
        let closed = self.stepper.touching().iter();
        let closed = closed.flat_map(|touching| touching.modes());
        let several = closed.filter(|mode| **mode != Mode::Open).count() >= FEWEST_CONTACTS;
        match trouble {
            ContactTrouble::Unsettled => {}
            // With several contacts the cause may be one of them or the problem that they form together.
            ContactTrouble::Jammed
            | ContactTrouble::Paradox
            | ContactTrouble::Unsolved
            | ContactTrouble::NotHeld
                if several => {}
            _ => return Ok(false),
        }
        if !self.activity.is_free {
            return Ok(false);
        }
        let step = self.length_of_steps();
        if let Some(steps) = &mut self.record.steps {
            steps.jump(&self.stepper);
        }
        self.record_energies();
        self.hand_over(step, None)
    }

    /// The length of steps of time stepping.
    fn length_of_steps(&mut self) -> f64 {
        let t = self.stepper.t();
        let [speed, closing_acceleration] = self.stepper.closing_rate_and_acceleration();
        self.activity
            .record_closing_acceleration(closing_acceleration);
        let greatest = self
            .activity
            .closing_accelerations
            .iter()
            .copied()
            .fold(0.0, f64::max);
        let scale = Some(speed / greatest).filter(|scale| *scale > 0.0 && scale.is_finite());
        // Without forces that close gaps the only known time scale is the duration of the run so far.
        let scale = scale.unwrap_or(t - self.start).min(self.until - self.start);
        (STEP_FRACTION * scale).min(self.settings.longest_step)
    }

    fn hand_over(&mut self, step: f64, crowd: Option<(usize, f64)>) -> Result<bool, Error> {
        let t = self.stepper.t();
        let Some(touching) = self.stepper.touching() else {
            return Ok(false);
        };
        // Impacts that follow each other in many instants are what `order: sequence` asks for.
        let is_called_for = crowd.is_none() || !touching.takes_impacts_in_sequence();
        let is_possible = is_called_for
            && matches!(
                self.settings.method.kind,
                MethodKind::RungeKutta | MethodKind::Series
            )
            && step > 16.0 * f64::EPSILON * t.abs()
            && step.is_finite()
            && touching.check_stepping(t).is_ok();
        if !is_possible {
            self.activity.is_free = false;
            self.activity.times.clear();
            self.activity.closing_accelerations.clear();
            return Ok(false);
        }
        self.record.unilateral.last = (touching.modes().iter())
            .map(|mode| *mode != Mode::Open)
            .collect();
        if let Err(error) = self.stepper.begin_stepping(step, self.stop) {
            let (q, v) = (self.stepper.q(), self.stepper.v());
            return Err(self.model.explain(error, q, v));
        }
        let kinetic = self.kinetic_energy_now();
        self.activity.times.clear();
        self.activity.closing_accelerations.clear();
        self.activity.quiet = 0;
        (self.activity.step, self.activity.kinetic) = (step, kinetic);
        self.keep_phase(Change::default());
        self.record.handovers.push(Handover {
            t,
            step: Some(step),
            crowd,
        });
        Ok(true)
    }

    pub(super) fn kinetic_energy_now(&self) -> f64 {
        let stepper = &self.stepper;
        let (t, q, v) = (stepper.t(), stepper.q(), stepper.v());
        self.model.system.kinetic_energy(t, q, v)
    }

    /// Undoes the last step of time stepping if it was long, because everything was at rest, but ends in motion.
    pub(super) fn undo_step_into_motion(&mut self) -> bool {
        // The last step of a run may be a little longer than the others, and would be the same again.
        let is_long = self.stepper.last_step() > LONG_STEP * self.activity.step;
        if self.settings.method.is_time_stepping() || !is_long {
            return false;
        }
        let before = self.stepper.stepped();
        let modes = self.stepper.touching().as_ref().map(|now| now.modes());
        let changes = before.map(|(_, before)| before.modes()) != modes;
        if !changes && self.kinetic_energy_now() <= REST_ENERGY * self.activity.kinetic {
            return false;
        }
        self.stepper.retreat(self.stop);
        self.stepper.set_longest_step(self.activity.step);
        self.activity.quiet = 0;
        true
    }

    /// Continues after a step of time stepping: with longer steps if everything has come to rest, or by locating every event again if
    /// contacts have been quiet for long enough.
    pub(super) fn continue_after_time_step(&mut self) -> Result<(), Error> {
        if self.settings.method.is_time_stepping() || self.stepper.is_done() {
            return Ok(());
        }
        let kinetic = self.kinetic_energy_now();
        self.activity.kinetic = self.activity.kinetic.max(kinetic);
        if self.activity.quiet >= QUIET_STEPS && kinetic <= REST_ENERGY * self.activity.kinetic {
            let longer = 2.0 * self.stepper.last_step();
            let longest = longer.clamp(self.activity.step, self.settings.longest_step);
            self.stepper.set_longest_step(longest);
        }
        self.return_to_events_if_quiet()
    }

    /// Returns to locating every event if contacts have been quiet for long enough, and few are closed in space or their forces are unique: if contacts share loads in
    /// several ways, as in piles, events cost more than steps.
    fn return_to_events_if_quiet(&mut self) -> Result<(), Error> {
        if self.activity.quiet < self.activity.needed {
            return Ok(());
        }
        let (method, longest) = (self.method_with_contacts(), self.settings.longest_step);
        let step = self.stepper.last_step();
        self.activity.needed *= 2;
        if !self.few_are_closed_in_space() && !self.stepper.contact_forces_are_unique() {
            return Ok(());
        }
        let Ok(changes_at_instant) =
            (self.stepper).end_stepping(method, (longest, step), self.stop)
        else {
            // Time stepping continues.
            return Ok(());
        };
        if let Some(steps) = &mut self.record.steps {
            steps.jump(&self.stepper);
        }
        self.record_energies();
        if changes_at_instant.impacts.is_empty() && changes_at_instant.ended.is_empty() {
            let closed = changes_at_instant.after.iter().enumerate();
            let closed: Vec<usize> = closed
                .filter(|(_, mode)| **mode != Mode::Open)
                .map(|(k, _)| k)
                .collect();
            for &k in &closed {
                self.record.unilateral.losses[k] +=
                    changes_at_instant.lost_at_end / closed.len() as f64;
            }
        }
        self.report_changes(&changes_at_instant, false);
        self.correct_energy_entry();
        self.keep_phase(Change::default());
        self.record.handovers.push(Handover {
            t: self.stepper.t(),
            step: None,
            crowd: None,
        });
        self.follow_flights()
    }

    fn few_are_closed_in_space(&self) -> bool {
        let across = &self.activity.across;
        let modes = self.stepper.touching().iter();
        let modes = modes.flat_map(|touching| touching.modes());
        let closed = modes.zip(across).filter(|(mode, across)| {
            let is_own = !**across;
            is_own && **mode != Mode::Open
        });
        across.contains(&true) && closed.count() < MANY_IN_SPACE
    }

    /// Records the present states of the contacts.
    pub(super) fn keep_phase(&mut self, change: Change) {
        if let Some(touching) = self.stepper.touching() {
            let phase = Phase {
                since: self.stepper.t(),
                until: f64::INFINITY,
                touching: touching.for_later_observation(),
                change,
                constraints: self.stepper.constraints().clone(),
            };
            self.push_phase(phase);
        }
    }

    /// Records the present states of the contacts, which are so since the last step of time stepping began. In time stepping only the constraints of the machine
    /// remain, which are those of the phase before.
    pub(super) fn keep_phase_of_step(&mut self) {
        let since = self.stepper.t_before();
        let Some(touching) = self.stepper.touching() else {
            return;
        };
        let (keeps_all, last_needed) = self.phases_needed();
        let unilateral = &mut self.record.unilateral;
        // A phase that is forgotten leaves its memory to the next one.
        let phase = match unilateral.forget_phase(keeps_all, last_needed) {
            Some(mut phase) => {
                phase.touching.clone_for_later_observation(touching);
                (phase.since, phase.until) = (since, f64::INFINITY);
                phase.change = Change::default();
                phase
            }
            None => Phase {
                since,
                until: f64::INFINITY,
                touching: touching.for_later_observation(),
                change: Change::default(),
                constraints: self.stepper.constraints().clone(),
            },
        };
        unilateral.phases.push(phase);
    }

    /// Records the states of the contacts from some time on, and forgets those before if the settings allow it and nothing needs them.
    pub(super) fn push_phase(&mut self, phase: Phase<VectorOf<M>>) {
        let (keeps_all, last_needed) = self.phases_needed();
        let unilateral = &mut self.record.unilateral;
        unilateral.forget_phase(keeps_all, last_needed);
        unilateral.phases.push(phase);
    }

    /// Whether all phases are kept, and the time of the last sample or event, which needs that in which it is.
    fn phases_needed(&self) -> (bool, f64) {
        let Record {
            samples,
            unilateral,
            ..
        } = &self.record;
        let keeps_all = self.settings.keep_steps || self.settings.keep_contact_phases;
        let sampled = samples.last().map(|sample| sample.t);
        let last_needed =
            sampled.map_or(unilateral.last_watched, |t| t.max(unilateral.last_watched));
        (keeps_all, last_needed)
    }
}
