//! The end of a run: at an event or at its last time, and the result that is made of its records.

use std::boxed::Box;
use std::vec::Vec;

use super::explained::ExplainedResidual;
use super::{Finished, Prepared, Record, Run};
use crate::balance::{Energies, EnergyBalance, Quadratures};
use crate::event::{Event, Terminal, state};
use crate::inputs::InputLaw;
use crate::settings::Settings;
use crate::solution::{Ending, Results, Statistics, handover};
use crate::stepper::Stepper;
use crate::tolerance::LEAST_RELATIVE_TOLERANCE;
use crate::{Error, Machine, System, Vector, Warning};

impl<M: Machine> Prepared<'_, '_, M> {
    /// The results of a run that has ended.
    pub(crate) fn results(mut self, finished: Finished<M>) -> (Results<M>, Option<Error>) {
        let Finished {
            end,
            ending,
            error,
            record,
            statistics,
            balance,
            warnings,
            next_step,
            constraints,
            choices,
        } = finished;
        let Record {
            sampled_inputs,
            pieces,
            steps,
            samples,
            events,
            energies,
            contacts,
            unilateral,
            handovers,
            ..
        } = record;
        self.start_warnings.extend(warnings);
        let results = Results {
            method: self.settings.method,
            balance,
            statistics: Statistics {
                seconds: self.clock.elapsed().as_secs_f64(),
                ..statistics
            },
            warnings: self.start_warnings,
            next_step,
            constraints,
            contacts,
            unilateral,
            handovers,
            choices,
            sampled_inputs,
            pieces,
            start: self.start,
            end,
            steps,
            samples,
            events,
            energies,
            ending,
            settings: self.settings,
            system: self.system,
        };
        (results, error)
    }
}

impl<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> Run<'_, '_, M, L, A> {
    /// Ends the run: returns its results with the energy balance and the warnings.
    #[expect(clippy::boxed_local, reason = "out of its box a run would be copied")]
    pub(crate) fn end(mut self: Box<Self>, ending: Result<Ending, Error>) -> Finished<M> {
        if ending.is_ok() {
            self.change_inputs_at_end();
        }
        let (ending, error) = match ending {
            Ok(ending) => (ending, None),
            Err(error) => (Ending::Error, Some(error)),
        };
        let Self {
            model,
            stepper,
            settings,
            mut record,
            next_step,
            callbacks,
            choosing,
            ..
        } = *self;
        let system = model.system;
        let end = state(
            system,
            (stepper.t(), stepper.q().clone(), stepper.v().clone()),
        );
        if settings.every.is_some() && end.t != model.start.0 {
            record.samples.push(end.clone());
        }
        for stream in &mut callbacks.streams {
            stream.end(&end);
        }
        if !record.unilateral.events.is_empty() {
            // The time of a contact event may include the rest of its bounces, within which other events happen.
            let events = &mut record.events;
            events.sort_by(|one, other| one.state.t.total_cmp(&other.state.t));
        }
        let work = stepper.work();
        let has_fixed_steps = settings.method.has_fixed_steps() || !record.handovers.is_empty();
        let balance = balance(
            &stepper,
            &record.energies,
            &record.explained,
            (record.kinetic_energy, has_fixed_steps),
        );
        let mut warnings = warnings_so_far::<M, _, _>(system, settings, &stepper, &record);
        if let Some(balance) = &balance
            && error.is_none()
            && balance.residual().abs() > balance.explained
        {
            warnings.push(Warning::EnergyUnexplained {
                residual: balance.residual(),
                explained: balance.explained,
                relative: balance.relative(),
            });
        }
        Finished {
            end,
            ending,
            error,
            record,
            statistics: Statistics {
                steps: work.steps,
                rejected: work.rejected,
                evaluations: work.evaluations,
                constraint_residual: stepper.constraint_residual(),
                stiff_since: stepper.stiff_since(),
                seconds: 0.0,
            },
            balance,
            warnings,
            next_step: next_step.unwrap_or(stepper.next_step()).abs(),
            constraints: stepper.constraints().clone(),
            choices: choosing.choices,
        }
    }

    /// Ends the run at an event within the last step, by repeating the step up to the event. So the end and the energy balance are as
    /// accurate as at every other step. The function must be 0 at the end of that step and not on the dense output of the longer one:
    /// Newton's method corrects the length of the step until only rounding of time or state remains.
    pub(super) fn end_at(&mut self, found: Terminal) -> Result<Ending, Error> {
        self.next_step = Some(self.stepper.last_step());
        let to = self.stepper.t();
        let mut corrected = f64::INFINITY;
        let mut t = found.t;
        loop {
            self.stepper.retreat(t);
            let mut is_step = false;
            while !self.stepper.is_done() {
                if is_step {
                    self.record_last_step(&mut None)?;
                }
                let (q, v) = (self.stepper.q().clone(), self.stepper.v().clone());
                let step = self.stepper.step();
                step.map_err(|error| self.model.explain(error, &q, &v))?;
                is_step = true;
            }
            let state = state(
                self.model.system,
                (t, self.stepper.q().clone(), self.stepper.v().clone()),
            );
            let watch = &mut self.callbacks.watches[found.watch];
            let observe = || {
                self.model
                    .observed_system
                    .observe::<M, A>(&self.stepper, &state)
            };
            let correction = match found.slope {
                Some(slope) if is_step => -watch.value(&state, &observe)? / slope,
                _ => 0.0,
            };
            let next = t + correction;
            let from = self.stepper.t_before();
            let is_within = (next - from) * (to - next) > 0.0;
            // A correction that is not at most half of the last one is rounding, or the function is not linear there.
            if next == t || correction.abs() > 0.5 * corrected || !is_within {
                let name = watch.name.clone();
                if is_step {
                    self.record_last_step(&mut None)?;
                }
                // Events that the dense output placed later, by its error, happened at the same time.
                let events = self.record.events.iter_mut().rev();
                for event in events.take_while(|event| (event.state.t - t) * (to - t) > 0.0) {
                    event.state = state.clone();
                }
                self.record.push_watched(Event {
                    name: name.clone(),
                    crossing: found.crossing,
                    state,
                });
                return Ok(Ending::Event(name));
            }
            corrected = correction.abs();
            t = next;
        }
    }
}

/// The warnings of a run up to now, except about the balance of its energies.
pub(super) fn warnings_so_far<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>>(
    system: &M::System,
    settings: &Settings,
    stepper: &Stepper<'_, M::System, L, A>,
    record: &Record<M>,
) -> Vec<Warning> {
    let mut warnings = warnings(system, settings, stepper);
    if <M::System as System>::MAY_COLLIDE {
        warnings.extend(record.unilateral.warnings(system));
        warnings.extend(handover::warning(&record.handovers));
    }
    warnings
}

fn balance<S: System, L: InputLaw<S>, A: Quadratures<S>>(
    stepper: &Stepper<'_, S, L, A>,
    energies: &[Energies],
    explained: &ExplainedResidual<impl Vector>,
    (kinetic_energy, has_fixed_steps): (f64, bool),
) -> Option<EnergyBalance> {
    let integrals = stepper.quadratures().integrals()?;
    let (first, last) = (energies.first()?, energies.last()?);
    let exchanged = kinetic_energy + integrals.absolute_work() + last.dissipated;
    Some(EnergyBalance {
        explained: if has_fixed_steps {
            f64::INFINITY
        } else {
            explained.total(exchanged)
        },
        start: first.kinetic + first.potential,
        end: last.kinetic + last.potential,
        work: last.work,
        dissipated: last.dissipated,
        exchanged,
    })
}

/// Angles between which numbers are further apart than this, in rad, are reported.
const MOST_SPACING: f64 = 1e-6;

fn warnings<S: System, L: InputLaw<S>, A: Quadratures<S>>(
    system: &S,
    settings: &Settings,
    stepper: &Stepper<'_, S, L, A>,
) -> Vec<Warning> {
    let mut warnings = Vec::new();
    // A relative tolerance of 0 requests control by the absolute tolerance alone.
    if settings.relative > 0.0 && settings.relative < LEAST_RELATIVE_TOLERANCE {
        let (asked, used) = (settings.relative, LEAST_RELATIVE_TOLERANCE);
        warnings.push(Warning::ToleranceRaised { asked, used });
    }
    for (coordinate, &angle) in system.coordinates().zip(stepper.q().as_slice()) {
        let spacing = angle.abs().next_up() - angle.abs();
        if angle.is_finite() && coordinate.unit == "rad" && spacing > MOST_SPACING {
            let name = coordinate.name.into();
            warnings.push(Warning::LargeAngle {
                name,
                angle,
                spacing,
            });
        }
    }
    if let Some(t) = stepper.stiff_since() {
        warnings.push(Warning::Stiff { t });
    }
    warnings
}
