//! Steps of Moreau's time stepping.

use std::vec::Vec;

use super::{Model, Stepper};
use crate::at::At;
use crate::attempt::not_finite;
use crate::balance::{ContactShare, Quadratures};
use crate::compensated::two_sum;
use crate::contact::{Mode, SteppedContacts, SteppingMemory, UnilateralState};
use crate::stages::Point;
use crate::{InputLaw, StepError, System, Vector};

/// What is near in a step is known for so many times its length around it: what is moved out of a penetration, which is no deeper than a step is long, takes
/// along what is open by no more than eight times that.
const AROUND: f64 = 16.0;

/// The last step of time stepping.
#[derive(Clone, Debug)]
pub(crate) struct InImpulses<V, M> {
    /// The motion within the step, in powers of the time since its beginning: of the second degree, through the rates
    /// at both ends.
    of_step: Vec<V>,
    stepped: SteppedContacts,
    /// The contacts at its beginning.
    before: Option<UnilateralState>,
    memory: SteppingMemory<V, M>,
}

impl<V: Vector, M: Vector> InImpulses<V, M> {
    pub fn new(q: &V, v: &V) -> Self {
        Self {
            of_step: [q.clone(), v.clone(), q.zeros_like()].into(),
            stepped: SteppedContacts::default(),
            before: None,
            memory: SteppingMemory::new(q),
        }
    }

    /// Coefficients of the motion in the last step.
    pub fn of_step(&self) -> &[V] {
        &self.of_step
    }

    /// Returns the contacts at the beginning of the last step, which is being undone.
    pub fn retreat(&mut self) -> Option<UnilateralState> {
        self.before.take()
    }
}

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// The changes of contacts in the last step of time stepping, and the contacts before it.
    pub(crate) fn stepped(&self) -> Option<(&SteppedContacts, &UnilateralState)> {
        let impulses = self.impulses.as_ref()?;
        Some((&impulses.stepped, impulses.before.as_ref()?))
    }

    /// Takes a step of time stepping.
    pub(super) fn step_in_impulses(&mut self) -> Result<(), StepError> {
        if !self.longest.is_finite() {
            return Err(StepError::NoLength { t: self.now.t });
        }
        let left = (self.end - self.now.t) - self.now.t_low;
        self.control.step = self.longest.copysign(left);
        self.begin();
        let last = self.control.is_last(left, self.longest);
        let h = if last { left } else { self.control.step };
        self.control.last_step = h;
        let attempted = self.attempt_in_impulses(h, last);
        if let Err(error) = attempted {
            if S::MAY_COLLIDE
                && let Some(impulses) = &mut self.impulses
                && let Some(before) = impulses.retreat()
            {
                self.model.touching = Some(before);
            }
            self.now.copy_from(&self.before);
            return Err(error);
        }
        self.control.accept(h, 0.0, 1.0);
        self.accept(h);
        if let Some(impulses) = &self.impulses {
            let SteppedContacts {
                work,
                lost,
                energy_added,
                ..
            } = impulses.stepped;
            self.quadratures
                .add_instantaneous(work, lost - energy_added);
            let lasting = impulses.before.as_ref().map(UnilateralState::modes);
            for impact in &impulses.stepped.impacts {
                let lasts = lasting.is_some_and(|modes| modes[impact.contact] != Mode::Open);
                let part = ContactShare {
                    friction: if lasts { impact.friction_loss() } else { 0.0 },
                    work: impact.work,
                    compliance_loss: 0.0,
                };
                (self.quadratures).add_instantaneous_share(impact.contact, part);
            }
        }
        Ok(())
    }

    fn attempt_in_impulses(&mut self, h: f64, last: bool) -> Result<(), StepError> {
        self.go_to_middle(h);
        self.write_rates_without_impulses(h)?;
        let Self {
            model,
            quadratures,
            before,
            now,
            k,
            stage: (q, v),
            end,
            impulses: Some(impulses),
            ..
        } = self
        else {
            return Ok(());
        };
        if S::MAY_COLLIDE
            && let Some(touching) = &mut model.touching
        {
            let system = model.system.get();
            let t = before.t + (before.t_low + 0.5 * h);
            let u = &model.inputs;
            let of_step = (&mut impulses.stepped, &mut impulses.memory);
            touching.step(
                system,
                At { t, q, v, u },
                (&before.v, &mut now.v),
                h,
                of_step,
            )?;
        }
        let shift = if S::MAY_COLLIDE {
            impulses.memory.shift()
        } else {
            &[]
        };
        write_end((before, &mut *now), h, shift, v);
        // With the accelerations as if nothing touched: what the impulses do to the energy is added at once.
        let t = before.t + (before.t_low + 0.5 * h);
        model.take_rates(quadratures, 1, (t, q, v, &k[1]));
        now.set_time(before, h, (*end, &[last]));
        if let Some(coordinate) = not_finite(&now.q, &now.v, 0) {
            let t = now.t;
            return Err(StepError::NotFinite { coordinate, t });
        }
        model.project(now)?;
        if S::MAY_COLLIDE && model.touching.is_some() {
            let is_counted = quadratures.integrals().is_some();
            leave_penetration(model, now, h, (is_counted, &mut **impulses))?;
        }
        for (i, a) in k[1].as_mut_slice().iter_mut().enumerate() {
            *a = (now.v.as_slice()[i] - before.v.as_slice()[i]) / h;
        }
        write_course(&mut impulses.of_step, (before, &*now), h);
        let stages = self.method.tableau.stages;
        let work = &mut self.control.work;
        (self.model).end(&self.now, &mut self.quadratures, stages, &mut self.k, work)
    }

    /// Writes the place in the middle of the step, and which contacts are near there; and that nothing has happened yet.
    fn go_to_middle(&mut self, h: f64) {
        let Self {
            model,
            before,
            stage: (q, _),
            impulses: Some(impulses),
            ..
        } = self
        else {
            return;
        };
        q.clone_from(&before.q);
        for (q, v) in q.as_mut_slice().iter_mut().zip(before.v.as_slice()) {
            *q += 0.5 * h * v;
        }
        if S::MAY_COLLIDE
            && let Some(touching) = &mut model.touching
        {
            // Impulses change the rates: where they lead out of the box, all contacts are evaluated.
            let ends = [before.t, before.t + h];
            touching.keep_near(model.system.get(), AROUND, |own| {
                own.set_to_line(ends, before.q.as_slice(), q.as_slice());
            });
        }
        impulses.before.clone_from(&model.touching);
        impulses.stepped.clear();
    }

    /// Writes the rates at the end of the step as if nothing touched, with the forces at the rates in its middle.
    fn write_rates_without_impulses(&mut self, h: f64) -> Result<(), StepError> {
        let Self {
            model,
            before,
            now,
            k,
            stage: (q, v),
            control,
            ..
        } = self;
        let half = 0.5 * h;
        let t = before.t + (before.t_low + half);
        let touching = model.touching.take();
        let work = &mut control.work;
        let mut result = model.accelerations(t, q, &before.v, &mut k[1], work);
        if result.is_ok() {
            v.clone_from(&before.v);
            for (v, a) in v.as_mut_slice().iter_mut().zip(k[1].as_slice()) {
                *v += half * a;
            }
            result = model.accelerations(t, q, v, &mut k[1], work);
        }
        model.touching = touching;
        result?;
        now.v.clone_from(&before.v);
        for (v, a) in now.v.as_mut_slice().iter_mut().zip(k[1].as_slice()) {
            *v += h * a;
        }
        Ok(())
    }
}

/// Writes the place at the end of a step with its rates there, which impulses `shift` in addition, and the mean rates with which it is reached.
fn write_end<V: Vector>(
    (before, now): (&Point<V>, &mut Point<V>),
    h: f64,
    shift: &[f64],
    mean: &mut V,
) {
    now.v_low.as_mut_slice().fill(0.0);
    for i in 0..mean.as_slice().len() {
        let (from, to) = (before.v.as_slice()[i], now.v.as_slice()[i]);
        let shift = shift.get(i).copied().unwrap_or(0.0);
        let by = before.q_low.as_slice()[i] + (0.5 * h * (from + to) + shift);
        let (sum, low) = two_sum(before.q.as_slice()[i], by);
        now.q.as_mut_slice()[i] = sum;
        now.q_low.as_mut_slice()[i] = low;
        mean.as_mut_slice()[i] = 0.5 * (from + to) + shift / h;
    }
}

/// Moves the end of a step out of what it has penetrated, and writes the energy that this adds if it `is_counted`.
fn leave_penetration<S: System, L: InputLaw<S>>(
    model: &mut Model<'_, S, L>,
    now: &mut Point<S::Vector>,
    h: f64,
    (is_counted, impulses): (bool, &mut InImpulses<S::Vector, S::Matrix>),
) -> Result<(), StepError> {
    let energy = |model: &mut Model<'_, S, L>, now: &Point<S::Vector>| {
        model.set_inputs(now.t, &now.q, &now.v);
        let system = model.system.get();
        system.kinetic_energy(now.t, &now.q, &now.v)
            + system.potential_energy(now.t, &now.q, &model.inputs)
    };
    let before = is_counted.then(|| energy(model, now));
    if let Some(touching) = &model.touching {
        let system = model.system.get();
        touching.resolve_penetration(
            system,
            now.t,
            (&mut now.q, &mut now.v),
            h,
            &mut impulses.stepped.penetrated,
            &mut impulses.memory,
        )?;
    }
    if !impulses.stepped.penetrated.is_empty() {
        now.q_low.as_mut_slice().fill(0.0);
        model.project(now)?;
        if let Some(before) = before {
            impulses.stepped.energy_added = energy(model, now) - before;
        }
    }
    Ok(())
}

/// Writes the motion within a step: of the second degree, with the change of the rates, and from its beginning to its end.
fn write_course<V: Vector>(of_step: &mut [V], (before, now): (&Point<V>, &Point<V>), h: f64) {
    let [place, rate, bend] = of_step else {
        return;
    };
    place.clone_from(&before.q);
    for i in 0..bend.as_slice().len() {
        let (from, to) = (before.q.as_slice()[i], now.q.as_slice()[i]);
        let change = (now.v.as_slice()[i] - before.v.as_slice()[i]) / h;
        bend.as_mut_slice()[i] = 0.5 * change;
        // The linear coefficient is such that the polynomial ends where the step does.
        rate.as_mut_slice()[i] = (to - from) / h - 0.5 * h * change;
    }
}
