//! Steps of a fixed length, on which tolerances have no effect.

#[cfg(feature = "std")]
mod canonical;
#[cfg(feature = "std")]
mod gauss;
#[cfg(feature = "std")]
mod generalized_alpha;
#[cfg(feature = "std")]
mod lobatto;
#[cfg(feature = "std")]
mod rattle;
#[cfg(feature = "std")]
mod reactions;

use super::Stepper;
use crate::attempt::not_finite;
use crate::balance::Quadratures;
use crate::compensated::two_sum;
use crate::methods::Rule;
use crate::stages::Point;
use crate::{InputLaw, StepError, System, Vector};

#[cfg(feature = "std")]
use {
    crate::methods::generalized_alpha::LEFT_AT_INFINITY, gauss::Gauss,
    generalized_alpha::GeneralizedAlpha, rattle::Rattle, std::boxed::Box,
};

/// The memory of a method whose steps have a fixed length.
#[cfg(feature = "std")]
#[derive(Clone, Debug)]
pub(crate) enum Fixed<V, M> {
    Gauss(Gauss<V, M>),
    Rattle(Rattle<V, M>),
    GeneralizedAlpha(GeneralizedAlpha),
}

#[cfg(feature = "std")]
impl<V, M> Fixed<V, M> {
    /// Undoes the last step.
    pub fn retreat(&mut self) {
        if let Self::GeneralizedAlpha(alpha) = self {
            alpha.retreat();
        }
    }

    /// Forgets the previous steps, since the accelerations have jumped.
    pub fn forget(&mut self) {
        if let Self::GeneralizedAlpha(alpha) = self {
            alpha.forget();
        }
    }
}

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// Prepares the steps of a rule, if it supports the machine.
    #[cfg(feature = "std")]
    pub(super) fn begin_fixed(&mut self, rule: Rule) -> Result<(), StepError> {
        let Self { model, now, .. } = self;
        let system = model.system.get();
        let redundant = (model.constraints.as_ref()).is_some_and(|known| known.redundant);
        let fixed = match rule {
            Rule::Explicit | Rule::SemiImplicitEuler => return Ok(()),
            Rule::Gauss => Fixed::Gauss(Gauss::new(system, now, (self.method, redundant))?),
            Rule::Rattle => Fixed::Rattle(Rattle::new(system, now, redundant)?),
            Rule::GeneralizedAlpha => {
                Fixed::GeneralizedAlpha(GeneralizedAlpha::new(system, LEFT_AT_INFINITY))
            }
        };
        self.fixed = Some(Box::new(fixed));
        Ok(())
    }

    /// Takes a step of the length that was set; the last one ends at the end.
    pub(super) fn step_of_fixed_length(&mut self, rule: Rule) -> Result<(), StepError> {
        if !self.longest.is_finite() {
            return Err(StepError::NoLength { t: self.now.t });
        }
        let left = (self.end - self.now.t) - self.now.t_low;
        self.control.step = self.longest.copysign(left);
        self.begin();
        let last = self.control.is_last(left, self.longest);
        let h = if last { left } else { self.control.step };
        self.control.last_step = h;
        let tried = match rule {
            Rule::Explicit => self.attempt(h, last).map(|_| ()),
            Rule::SemiImplicitEuler => self.attempt_by_euler(h, last),
            #[cfg(feature = "std")]
            Rule::Gauss => self.attempt_by_gauss(h, last),
            #[cfg(feature = "std")]
            Rule::Rattle => self.attempt_by_rattle(h, last),
            #[cfg(feature = "std")]
            Rule::GeneralizedAlpha => self.attempt_by_alpha(h, last),
            #[cfg(not(feature = "std"))]
            _ => Err(StepError::NoWorkspace { t: self.now.t }),
        };
        if let Err(error) = tried {
            self.now.copy_from(&self.before);
            return Err(error);
        }
        self.control.accept(h, 0.0, 1.0);
        self.accept(h);
        Ok(())
    }

    /// Takes a semi-implicit Euler step.
    fn attempt_by_euler(&mut self, h: f64, last: bool) -> Result<(), StepError> {
        let Self { before, now, k, .. } = self;
        for i in 0..now.v.as_slice().len() {
            add(&mut now.v, &mut now.v_low, i, h * k[0].as_slice()[i]);
            let rate = now.v.as_slice()[i] + now.v_low.as_slice()[i];
            add(&mut now.q, &mut now.q_low, i, h * rate);
        }
        now.set_time(before, h, (self.end, &[last]));
        self.arrive_without_stages(h)
    }

    /// Completes a step without stages whose end is in `now`: projects it onto the constraints, evaluates the powers at its middle,
    /// and evaluates the acceleration at its end.
    fn arrive_without_stages(&mut self, h: f64) -> Result<(), StepError> {
        let Self {
            method,
            model,
            quadratures,
            now,
            k,
            control,
            ..
        } = self;
        check_finite(now)?;
        model.project(now)?;
        let stages = method.tableau.stages;
        model.end(now, quadratures, stages, k, &mut control.work)?;
        self.take_rates_in_middle(h)
    }

    /// Evaluates the powers at the middle of a step, at the state of the cubic through its ends.
    fn take_rates_in_middle(&mut self, h: f64) -> Result<(), StepError> {
        let Self {
            model,
            quadratures,
            before,
            now,
            k,
            stage: (q, v),
            control,
            ..
        } = self;
        if quadratures.integrals().is_none() {
            return Ok(());
        }
        for i in 0..q.as_slice().len() {
            let at = |end: &Point<S::Vector>| (end.q.as_slice()[i], end.v.as_slice()[i]);
            let (from, to) = (at(before), at(now));
            q.as_mut_slice()[i] = 0.5 * (from.0 + to.0) + 0.125 * h * (from.1 - to.1);
            v.as_mut_slice()[i] = 0.5 * (from.1 + to.1);
        }
        let t = before.t + (before.t_low + 0.5 * h);
        let (_, rest) = k.split_at_mut(1);
        model.accelerations(t, q, v, &mut rest[0], &mut control.work)?;
        model.take_rates(quadratures, 1, (t, q, v, &rest[0]));
        Ok(())
    }
}

/// Adds to a number of a vector, as a compensated sum.
fn add<V: Vector>(high: &mut V, low: &mut V, i: usize, by: f64) {
    let (high, low) = (&mut high.as_mut_slice()[i], &mut low.as_mut_slice()[i]);
    (*high, *low) = two_sum(*high, *low + by);
}

/// Checks that a state has not overflowed.
fn check_finite<V: Vector>(now: &Point<V>) -> Result<(), StepError> {
    match not_finite(&now.q, &now.v, 0) {
        Some(coordinate) => Err(StepError::NotFinite {
            coordinate,
            t: now.t,
        }),
        None => Ok(()),
    }
}
