//! Unilateral contacts in time stepping: checks and records.

use std::vec::Vec;

use super::Run;
use super::contacts::ReportedEvent;
use crate::balance::Quadratures;
use crate::contact::Mode;
use crate::inputs::InputLaw;
use crate::phases::{Change, Phase, StepRecord};
use crate::{ContactEventKind, ContactImpact, Error, Machine};

impl<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> Run<'_, '_, M, L, A> {
    /// Checks the contacts at the start of time stepping: none may be penetrated, and time stepping must support
    /// the law of each.
    pub(super) fn begin_stepping(&mut self) -> Result<(), Error> {
        self.stepper.close_guides();
        let Some(touching) = self.stepper.touching() else {
            return Ok(());
        };
        let (t, q, v) = (self.stepper.t(), self.stepper.q(), self.stepper.v());
        touching
            .check_stepping(t)
            .map_err(|error| self.model.explain(error, q, v))?;
        // A guide is closed from the beginning.
        self.record.unilateral.last = (touching.modes().iter())
            .map(|mode| *mode != Mode::Open)
            .collect();
        let phase = Phase {
            since: t,
            until: f64::INFINITY,
            touching: touching.clone(),
            change: Change::default(),
            constraints: self.stepper.constraints().clone(),
        };
        self.push_phase(phase);
        Ok(())
    }

    /// Records the changes of contacts in the last step. A contact that presses for the first time has had an impact;
    /// if it still presses in the next step, it has closed.
    pub(super) fn record_step(&mut self) {
        let Some((stepped, before)) = self.stepper.stepped() else {
            return;
        };
        let Some(now) = self.stepper.touching() else {
            return;
        };
        let mut of_step = core::mem::take(&mut self.record.unilateral.of_step);
        of_step.stepped.clone_from(stepped);
        of_step.before.clear();
        of_step.before.extend_from_slice(before.modes());
        of_step.after.clear();
        of_step.after.extend_from_slice(now.modes());
        let mut switched = Vec::new();
        if before.has_guides() {
            switched = before.switched(now.modes(), now.sides());
            // To which side it pressed before the first step is not known.
            switched.retain(|guide| before.sides()[*guide] != 0.0);
        }
        let StepRecord {
            stepped,
            before,
            after,
            ..
        } = &mut of_step;
        let impacts = &stepped.impacts;
        let t = self.stepper.t();
        let record = &mut self.record.unilateral;
        record.shared_otherwise.note(t, &stepped.shared_otherwise);
        record.jammed.note(t, &stepped.jammed);
        record.left_out.note(t, &stepped.left_out);
        let energy_added = stepped.energy_added / stepped.penetrated.len().max(1) as f64;
        for k in &stepped.penetrated {
            self.record.unilateral.losses[*k] -= energy_added;
        }
        let mut reported: Vec<ReportedEvent> = Vec::new();
        for (place, impact) in impacts.iter().enumerate() {
            // Friction losses while a contact stays closed are not losses of an impact.
            let of_friction = match before[impact.contact] {
                Mode::Open => 0.0,
                _ => impact.friction_loss(),
            };
            self.record.unilateral.losses[impact.contact] += impact.loss - of_friction;
            if before[impact.contact] == Mode::Open && !self.has_carrier(impact.contact) {
                let across = self.across_of(&impacts[place..]);
                let of = ContactImpact {
                    gap_rate: impact.gap_rate,
                    slip: impact.slip,
                    impulse: impact.impulse,
                    loss: impact.loss + across.map_or(0.0, |(_, loss)| loss),
                    across: across.map(|(across, _)| across),
                };
                reported.push((impact.contact, ContactEventKind::Impact, [0.0; 2], Some(of)));
            }
        }
        for (k, (before, after)) in before.iter().zip(&*after).enumerate() {
            reported.extend(self.event_of_step(k, (before, after)));
        }
        for guide in switched {
            reported.push((guide, ContactEventKind::Switches, [0.0; 2], None));
        }
        self.activity.count_quiet_step(reported.is_empty());
        self.enter_contact_events(reported, &[]);
        if !impacts.is_empty() || before != after {
            self.keep_phase_of_step();
        }
        self.record_gains_of_step(&mut of_step, t);
        self.record.unilateral.of_step = of_step;
    }

    /// The event that the change of the mode of a contact in a step is, if it is one.
    fn event_of_step(
        &mut self,
        k: usize,
        (before, after): (&Mode, &Mode),
    ) -> Option<ReportedEvent> {
        use ContactEventKind::{Closes, Lifts, Reverses, Slips, Sticks};
        let (has_carrier, is_across) = (self.has_carrier(k), self.is_across(k));
        let lasts = &mut self.record.unilateral.last[k];
        let kind = match (before, after) {
            (Mode::Open, _) => return None,
            (_, Mode::Open) if has_carrier => return None,
            _ if is_across => return None,
            (_, Mode::Open) if std::mem::take(lasts) => (Lifts, 0.0),
            (_, Mode::Open) => return None,
            _ if !has_carrier && !std::mem::replace(lasts, true) => (Closes, 0.0),
            (Mode::Slides(from), Mode::Slides(to)) if from != to => (Reverses, *to),
            (Mode::Slides(from), Mode::Sticks) if *from != 0.0 => (Sticks, 0.0),
            (Mode::Sticks, Mode::Slides(to)) if *to != 0.0 => (Slips, *to),
            (Mode::SlidesAlong(_), Mode::Sticks) => (Sticks, 0.0),
            (Mode::Sticks, Mode::SlidesAlong(_)) => (Slips, 0.0),
            _ => return None,
        };
        let directions = match kind.0 {
            Slips => after.direction(),
            _ => [kind.1, 0.0],
        };
        Some((k, kind.0, directions, None))
    }

    /// Notes impacts of the step that have created energy: those that inertia couples take it together.
    fn record_gains_of_step(&mut self, of_step: &mut StepRecord, t: f64) {
        let StepRecord {
            stepped,
            before,
            hits,
            ..
        } = of_step;
        let impacts = &stepped.impacts;
        for group in 0..impacts.len() {
            let is_in_group = |place: &usize| stepped.groups[*place] == group;
            let places = || (0..impacts.len()).filter(is_in_group);
            if places().any(|place| before[impacts[place].contact] == Mode::Open) {
                hits.clear();
                hits.extend(places().map(|place| impacts[place]));
                let untold = places().map(|place| stepped.untold[place]).sum();
                self.record_energy_gains(hits, untold, t);
            }
        }
    }
}

/// Checks the step length of a method with fixed steps; passes for other methods.
pub(super) fn check_length(has_fixed_steps: bool, longest: f64) -> Result<(), Error> {
    if has_fixed_steps && !longest.is_finite() {
        Err(Error::InvalidSetting {
            setting: "longest_step",
            value: longest,
            needed: "the length of the steps, in s: the method takes steps of a fixed length",
        })
    } else {
        Ok(())
    }
}
