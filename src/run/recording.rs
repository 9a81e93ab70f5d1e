//! The records of a run at each step: samples, energies, the step itself.

use super::{LastInterpolant, Model, Run, VectorOf};
use crate::at::At;
use crate::balance::{Energies, Quadratures};
use crate::event::{self, state, step_motion};
use crate::inputs::InputLaw;
use crate::interpolant::Interpolant;
use crate::observation::ConstraintState;
use crate::settings::Progress;
use crate::solution::is_beyond;
use crate::stepper::Stepper;
use crate::{Coordinates, Error, Inputs, Machine, State, StepMotion, System};

/// After so many steps of an implicit method whose residual stays unexplained, the quadrature is not repeated any more. Of an explicit one
/// it is a single step: its dense output represents all of the motion.
const MOST_UNEXPLAINED: usize = 16;

impl<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> Run<'_, '_, M, L, A> {
    /// Records and shows what the settings request of the last step.
    pub(super) fn record_last_step(
        &mut self,
        interpolant: &mut LastInterpolant<M>,
    ) -> Result<(), Error> {
        self.keep_samples(interpolant)?;
        self.show_step(interpolant)?;
        if <M::System as System>::MAY_COLLIDE && self.is_stepped() {
            self.record_step();
        }
        let before = self.record.energies.last().copied();
        let explained = self.record_energies();
        if let Some(before) = before {
            self.explain_residual(&before, explained, interpolant);
        }
        if let Some(steps) = &mut self.record.steps {
            steps.push(&self.stepper);
        }
        if let Some(progress) = &self.callbacks.progress {
            let t = self.stepper.t();
            (progress.lock())(Progress {
                t,
                fraction: (t - self.start) / (self.until - self.start),
                steps: self.stepper.work().steps,
                step: (t - self.stepper.t_before()).abs(),
                stiff_since: (self.stepper.stiff_since()).filter(|_| !self.choosing.is_free()),
            });
        }
        Ok(())
    }

    /// Shows the last step to the observer of steps, if there is one.
    fn show_step(&mut self, interpolant: &mut LastInterpolant<M>) -> Result<(), Error> {
        let Self {
            model,
            stepper,
            callbacks,
            ..
        } = self;
        match &callbacks.observer {
            None => Ok(()),
            Some(observer) => (observer.lock())(&mut LastStep {
                model,
                stepper,
                interpolant,
            }),
        }
    }

    /// The samples within the last step, to be kept or shown. The sample at the end of the run is added when the run ends.
    fn keep_samples(&mut self, interpolant: &mut LastInterpolant<M>) -> Result<(), Error> {
        if let Some(interval) = self.settings.every {
            while let Some(t) = self.next_sample(interval, self.record.samples.len()) {
                let state = self.state_within(t, interpolant)?;
                self.record.samples.push(state);
            }
        }
        for number in 0..self.callbacks.streams.len() {
            loop {
                let stream = &self.callbacks.streams[number];
                let Some(t) = self.next_sample(stream.interval, stream.count) else {
                    break;
                };
                let state = self.state_within(t, interpolant)?;
                self.callbacks.streams[number].show(&state);
            }
        }
        Ok(())
    }

    /// The time of the next sample after `count` ones, if it is within the last step.
    fn next_sample(&self, interval: f64, count: usize) -> Option<f64> {
        let interval = interval.copysign(self.until - self.start);
        let t = self.start + count as f64 * interval;
        let is_later = (t - self.stepper.t()) * interval > 0.0;
        (!is_beyond(t, self.until, interval) && !is_later).then_some(t)
    }

    /// The state at a time within the last step.
    fn state_within(
        &mut self,
        t: f64,
        interpolant: &mut LastInterpolant<M>,
    ) -> Result<State<Coordinates<M>>, Error> {
        let system = self.model.system;
        let (q, v) = if t == self.stepper.t() {
            (self.stepper.q().clone(), self.stepper.v().clone())
        } else {
            let (mut q, mut v) = step_motion(interpolant, &mut self.stepper, system)?.state(t);
            self.stepper
                .project(t, &mut q, &mut v)
                .map_err(|error| Error::of_step(error, system))?;
            (q, v)
        };
        Ok(state(system, (t, q, v)))
    }

    /// Records the present energies, if their balance is kept. Returns the part of the residual of the last step that tolerance and
    /// rounding explain, in J.
    pub(super) fn record_energies(&mut self) -> f64 {
        let Some(energies) = self.energies_now() else {
            return f64::INFINITY;
        };
        let stored = self.stored_now();
        let Self {
            model,
            stepper,
            record,
            ..
        } = self;
        record.kinetic_energy = record.kinetic_energy.max(energies.kinetic);
        let explained = record.explained.take(model.system, stepper, &energies);
        if !self.settings.keep_energies
            && record.energies.len() > 1
            && record.energies.last().is_some_and(Energies::are_finite)
        {
            record.energies.pop();
            record.unilateral.energy_entries.pop();
        }
        record.energies.push(Energies {
            potential: energies.potential + stored,
            ..energies
        });
        if <M::System as System>::MAY_COLLIDE && self.stepper.touching().is_some() {
            let energy_entry = self.energy_entry();
            self.record.unilateral.energy_entries.push(energy_entry);
        }
        explained
    }

    /// Repeats the quadrature of work and losses along the last step if its energy balance has an unexplained residual. The step may be too
    /// long for the quadrature, since its length was chosen for the motion alone. A step of an implicit method may also be longer than fast
    /// transients that have decayed, which its dense output does not represent: there the quadrature along it counts only if it explains the
    /// residual.
    fn explain_residual(
        &mut self,
        before: &Energies,
        explained: f64,
        interpolant: &mut LastInterpolant<M>,
    ) {
        let Some(&now) = self.record.energies.last() else {
            return;
        };
        let is_explained = |now: &Energies| now.residual_since(before).abs() <= explained;
        let is_implicit = self.stepper.is_implicit();
        if self.record.unexplained >= if is_implicit { MOST_UNEXPLAINED } else { 1 }
            || self.settings.method.has_fixed_steps()
            || self.is_stepped()
            || !now.are_finite()
            || is_explained(&now)
        {
            return;
        }
        let bound = 0.1 * explained;
        let failed = self.record.unexplained;
        let counts = |work: f64, dissipated: f64| {
            let (work, dissipated) = (now.work + work, now.dissipated + dissipated);
            !is_implicit
                || is_explained(&Energies {
                    work,
                    dissipated,
                    ..now
                })
        };
        let known =
            step_motion(interpolant, &mut self.stepper, self.model.system).is_ok_and(|of_step| {
                matches!(
                    self.stepper
                        .integrate_along(of_step, (bound, failed), counts),
                    Ok(true)
                )
            });
        // Where this does not help, the residual stays, and the run reports it.
        if !known {
            self.record.unexplained += 1;
        } else if let Some(integrals) = self.stepper.quadratures().integrals()
            && let Some(now) = self.record.energies.last_mut()
        {
            (now.work, now.dissipated) = (integrals.work(), integrals.dissipated());
            self.correct_energy_entry();
        }
    }

    /// Present kinetic and potential energy and the integrals so far, if their balance is kept; without [`stored_now`](Self::stored_now).
    fn energies_now(&self) -> Option<Energies> {
        let Self { model, stepper, .. } = self;
        let integrals = stepper.quadratures().integrals()?;
        let (t, q, v) = (stepper.t(), stepper.q(), stepper.v());
        Some(Energies {
            t,
            kinetic: model.system.kinetic_energy(t, q, v),
            potential: model.system.potential_energy(t, q, &model.inputs(t, q, v)),
            work: integrals.work(),
            dissipated: integrals.dissipated(),
        })
    }

    /// Energy that first-order states and compliant contacts store now, in J.
    pub(super) fn stored_now(&self) -> f64 {
        let Self { model, stepper, .. } = self;
        let (t, q, v) = (stepper.t(), stepper.q(), stepper.v());
        let mut stored = model.system.state_energy(t, q, v);
        if <M::System as System>::MAY_COLLIDE
            && let Some(touching) = stepper.touching()
        {
            stored += touching.stored(model.system, t, q, v);
        }
        stored
    }
}

/// The last step, as an observer sees it.
struct LastStep<'w, 'r, 's, S: System, L, K, A> {
    model: &'w Model<'r, S, L>,
    stepper: &'w mut Stepper<'s, S, K, A>,
    interpolant: &'w mut Option<Interpolant<S::Vector>>,
}

impl<M, L, K, A> StepMotion<M> for LastStep<'_, '_, '_, M::System, L, K, A>
where
    M: Machine,
    L: InputLaw<M::System>,
    K: InputLaw<M::System>,
    A: Quadratures<M::System>,
{
    fn span(&self) -> [f64; 2] {
        [self.stepper.t_before(), self.stepper.t()]
    }

    fn is_series(&self) -> bool {
        self.stepper.coefficients().is_some()
    }

    fn state_at(
        &mut self,
        theta: f64,
        q: &mut VectorOf<M>,
        v: &mut VectorOf<M>,
    ) -> Result<f64, Error> {
        let Self { model, stepper, .. } = self;
        if theta == 0.0 {
            q.clone_from(stepper.q_before());
            v.clone_from(stepper.v_before());
            return Ok(stepper.t_before());
        }
        let interpolant = step_motion(self.interpolant, stepper, model.system)?;
        event::state_into(model.system, stepper, interpolant, theta, [q, v])
    }

    fn state(&mut self, t: f64) -> Result<State<Coordinates<M>>, Error> {
        let Self { model, stepper, .. } = self;
        let [from, to] = [stepper.t_before(), stepper.t()];
        let system = model.system;
        let (q, v) = match t {
            _ if t == to => (stepper.q().clone(), stepper.v().clone()),
            _ if t == from => (stepper.q_before().clone(), stepper.v_before().clone()),
            _ => {
                let (mut q, mut v) = step_motion(self.interpolant, stepper, system)?.state(t);
                stepper
                    .project(t, &mut q, &mut v)
                    .map_err(|error| Error::of_step(error, system))?;
                (q, v)
            }
        };
        Ok(state(system, (t, q, v)))
    }

    fn inputs(&self, t: f64, q: &VectorOf<M>, v: &VectorOf<M>) -> Inputs<M> {
        self.model.inputs(t, q, v)
    }

    fn accelerations(
        &self,
        (t, q, v): (f64, &VectorOf<M>, &VectorOf<M>),
        u: &Inputs<M>,
        a: &mut VectorOf<M>,
    ) -> Result<(), Error> {
        let system = self.model.system;
        ConstraintState::of(self.stepper)
            .accelerations(system, At { t, q, v, u }, a)
            .map_err(|error| Error::of_step(error, system))
    }
}
