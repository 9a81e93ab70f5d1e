//! The equations of motion as a stepper evaluates them: with the law of the inputs, constraints and contacts.

use super::Model;
use crate::at::At;
use crate::attempt::not_finite;
use crate::balance::Quadratures;
use crate::constraints::Constraints;
#[cfg(feature = "std")]
use crate::contact::ContactMemory;
use crate::control::Work;
use crate::friction::Contacts;
use crate::inputs::InputLaw;
use crate::methods::MAX_STAGES;
use crate::stages::Point;
use crate::step_error::StepError;
use crate::{System, Vector};
#[cfg(feature = "std")]
use std::boxed::Box;

impl<S: System, L: InputLaw<S>> Model<'_, S, L> {
    /// Evaluates the accelerations and checks that they are finite.
    #[inline]
    pub(super) fn accelerations(
        &mut self,
        t: f64,
        q: &S::Vector,
        v: &S::Vector,
        a: &mut S::Vector,
        work: &mut Work,
    ) -> Result<(), StepError> {
        work.evaluations += 1;
        self.law.set(self.system.get(), t, q, v, &mut self.inputs);
        let known = (&self.constraints, &self.contacts);
        let at = At {
            t,
            q,
            v,
            u: &self.inputs,
        };
        #[cfg(feature = "std")]
        if S::MAY_COLLIDE
            && let Some(touching) = &self.touching
        {
            let memory = self.contact_memory.get_or_insert_with(|| {
                let memory = ContactMemory::new(touching, q);
                Box::new(memory)
            });
            touching.accelerations(self.system.get(), at, memory, a)?;
        } else {
            accelerations(self.system.get(), known, at, a)?;
        }
        #[cfg(not(feature = "std"))]
        accelerations(self.system.get(), known, at, a)?;
        // If any number is not finite, the sum is not, and one test is cheaper than many.
        let sum: f64 = a.as_slice().iter().sum();
        if sum.is_finite() {
            return Ok(());
        }
        match not_finite(a, a, 0) {
            Some(coordinate) => Err(StepError::NotFinite { coordinate, t }),
            None => Ok(()),
        }
    }

    /// Sets the inputs for a state.
    #[cfg(feature = "std")]
    pub(super) fn set_inputs(&mut self, t: f64, q: &S::Vector, v: &S::Vector) {
        self.law.set(self.system.get(), t, q, v, &mut self.inputs);
    }

    /// Evaluates the acceleration at the new point.
    #[inline]
    pub(super) fn end<A: Quadratures<S>>(
        &mut self,
        now: &Point<S::Vector>,
        quadratures: &mut A,
        stages: usize,
        k: &mut [S::Vector; MAX_STAGES],
        work: &mut Work,
    ) -> Result<(), StepError> {
        self.accelerations(now.t, &now.q, &now.v, &mut k[stages], work)?;
        self.take_rates(quadratures, stages, (now.t, &now.q, &now.v, &k[stages]));
        Ok(())
    }

    /// Projects the end of a step onto the constraints; returns whether that moved it.
    #[inline(always)]
    pub(super) fn project(&mut self, now: &mut Point<S::Vector>) -> Result<bool, StepError> {
        #[cfg(feature = "std")]
        if S::MAY_COLLIDE
            && self.system.unilateral_contacts().len() != 0
            && let Some(touching) = &self.touching
        {
            let constrained = touching.machine(self.system.get());
            return match &mut self.constraints {
                Some(constraints) if constrained.constraints().len() != 0 => {
                    let projected = constraints.project(&constrained, &mut now.place());
                    projected.map_err(|error| touching.explain(self.system.get(), error))
                }
                _ => Ok(false),
            };
        }
        let mut moved = false;
        if S::MAY_BE_CONSTRAINED
            && self.system.constraints().len() != 0
            && let Some(constraints) = &mut self.constraints
        {
            moved = constraints.project(self.system.get(), &mut now.place())?;
        }
        if S::MAY_SLIDE
            && self.system.contacts().len() != 0
            && let Some(contacts) = &self.contacts
        {
            let place = now.place();
            let at = (place.t, &*place.q[0], &self.inputs);
            contacts.hold(self.system.get(), at, place.v)?;
        }
        Ok(moved)
    }

    /// Updates contacts and constraints at the end of a step.
    #[inline(always)]
    pub(super) fn accept(&mut self, now: &Point<S::Vector>) {
        if S::MAY_SLIDE
            && self.system.contacts().len() != 0
            && let Some(contacts) = &mut self.contacts
        {
            contacts.accept(self.system.get(), now.t, &now.q, &now.v);
        }
        #[cfg(feature = "std")]
        if S::MAY_COLLIDE && self.system.unilateral_contacts().len() != 0 {
            self.accept_contacts(now);
            return;
        }
        if !S::MAY_BE_CONSTRAINED || self.system.constraints().len() == 0 {
            return;
        }
        if let Some(constraints) = &mut self.constraints {
            constraints.accept(&now.q, &now.v);
            if constraints.at_fork {
                constraints.update_fork(self.system.get(), now.t, &now.q);
            }
            if constraints.redundant {
                // If that fails, the previous rows will do, or the next step returns the error.
                let _ = constraints.choose_again(self.system.get(), now.t, &now.q);
            }
        }
    }

    #[inline(always)]
    pub(super) fn take_rates<A: Quadratures<S>>(
        &mut self,
        quadratures: &mut A,
        stage: usize,
        at: (f64, &S::Vector, &S::Vector, &S::Vector),
    ) {
        quadratures.stage(stage, self.system.get(), at, &self.inputs);
        let (t, q, v, _) = at;
        let here = At {
            t,
            q,
            v,
            u: &self.inputs,
        };
        if S::MAY_SLIDE
            && self.system.contacts().len() != 0
            && let Some(contacts) = &self.contacts
            && quadratures.integrals().is_some()
        {
            let [work, lost] = contacts.power(self.system.get(), here);
            quadratures.add(stage, work, lost);
        }
        #[cfg(feature = "std")]
        if S::MAY_COLLIDE
            && self.system.unilateral_contacts().len() != 0
            && let Some(touching) = &self.touching
            && quadratures.integrals().is_some()
        {
            let memory = self.contact_memory.get_or_insert_with(|| {
                let memory = ContactMemory::new(touching, q);
                Box::new(memory)
            });
            let powers = touching.powers(self.system.get(), here, memory);
            quadratures.add(stage, powers.work, powers.lost);
            quadratures.set_contact_shares(stage, powers.of_each);
        }
    }
}

/// Evaluates the accelerations; where constraints are dependent, those that satisfy the chosen ones.
#[inline(always)]
pub(crate) fn accelerations<S: System>(
    system: &S,
    (constraints, contacts): (&Option<Constraints<S::Vector>>, &Option<Contacts>),
    At { t, q, v, u }: At<'_, S>,
    a: &mut S::Vector,
) -> Result<(), StepError> {
    if S::MAY_SLIDE
        && system.contacts().len() != 0
        && let Some(contacts) = contacts
    {
        return contacts
            .accelerations(system, At { t, q, v, u }, a)
            .map_err(|singular| StepError::Singular { singular, t });
    }
    if S::MAY_BE_CONSTRAINED
        && system.constraints().len() != 0
        && let Some(constraints) = constraints
        && (constraints.redundant || constraints.at_fork)
    {
        return constraints.accelerations(system, t, q, v, u, a);
    }
    system
        .accelerations(t, q, v, u, a)
        .map_err(|singular| StepError::Singular { singular, t })
}

/// Moves coordinates along their rates by some roundings of the largest coordinate.
#[cfg(feature = "std")]
pub(super) fn move_by_rounding<V: Vector>(q: &mut V, v: &V) {
    const ROUNDINGS: f64 = 64.0;
    let greatest = |of: &V| {
        of.as_slice()
            .iter()
            .fold(0.0_f64, |most, x| most.max(x.abs()))
    };
    let time = ROUNDINGS * f64::EPSILON * greatest(q) / greatest(v);
    if time.is_finite() {
        for (q, v) in q.as_mut_slice().iter_mut().zip(v.as_slice()) {
            *q += time * v;
        }
    }
}

/// Projects a state within a run onto the constraints.
#[inline(always)]
pub(crate) fn project<S: System>(
    system: &S,
    constraints: &Option<Constraints<S::Vector>>,
    t: f64,
    q: &mut S::Vector,
    v: &mut S::Vector,
) -> Result<(), StepError> {
    if S::MAY_BE_CONSTRAINED
        && system.constraints().len() != 0
        && let Some(constraints) = constraints
    {
        return constraints.project_between(system, t, q, v);
    }
    Ok(())
}
