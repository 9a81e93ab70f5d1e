//! Slips in two directions that fade: their residuals are the errors of steps.

use std::vec;
use std::vec::Vec;

use super::super::{Model, Stepper};
use super::Cause;
use super::settling::resting_or_stopped;
use crate::at::At;
use crate::balance::Quadratures;
use crate::contact::{ContactMemory, Mode, UnilateralState};
use crate::inputs::InputLaw;
use crate::stages::Point;
use crate::tolerance::Tolerance;
use crate::{StepError, System, Vector};

/// A slip in two directions has stopped if it is braked and less than so many errors that a step may have.
const FADING: f64 = 10.0;

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// A contact whose slip in two directions is next to nothing at the end of the last step, is braked there, and would stay at rest, if there is one. The
    /// residual of such a slip consists of errors, which the following steps would turn around rest in ever shorter steps. `memory` knows the contacts there, and
    /// `faster` which of them have slipped faster.
    pub(crate) fn faded_slip(
        &mut self,
        memory: &ContactMemory<S::Vector, S::Matrix>,
        faster: &mut Vec<bool>,
    ) -> Result<Option<usize>, StepError> {
        let Self { model, now, .. } = self;
        let error = fading_rate(&self.tolerance, &now.v);
        let Some(touching) = &model.touching else {
            return Ok(None);
        };
        if !touching.may_fade(memory, &error, faster) {
            return Ok(None);
        }
        let touching = touching.clone();
        model.set_inputs(now.t, &now.q, &now.v);
        let errors: Vec<f64> = (0..now.v.as_slice().len()).map(error).collect();
        let fading = model.fading_slips(&touching, now, &errors)?;
        let mut pairs = fading.iter().zip(faster);
        Ok(pairs.position(|(fades, faster)| *fades && *faster))
    }
}

impl<S: System, L: InputLaw<S>> Model<'_, S, L> {
    /// Which slips in two directions fade where contacts change, if the cause may be one of them.
    pub(super) fn fading_at_change(
        &self,
        cause: Cause,
        touching: &UnilateralState,
        now: &Point<S::Vector>,
        tolerance: &Tolerance<S::Vector>,
    ) -> Result<Vec<bool>, StepError> {
        match cause {
            Cause::Stops(_) | Cause::Unspecified => {
                let error = fading_rate(tolerance, &now.v);
                let errors: Vec<f64> = (0..now.v.as_slice().len()).map(error).collect();
                self.fading_slips(touching, now, &errors)
            }
            _ => Ok(vec![false; touching.modes().len()]),
        }
    }

    /// Which slips in two directions fade, those that `errors` of rates may have turned, of contacts that stick if they are at rest.
    fn fading_slips(
        &self,
        touching: &UnilateralState,
        now: &Point<S::Vector>,
        errors: &[f64],
    ) -> Result<Vec<bool>, StepError> {
        let system = self.system.get();
        let at = At {
            t: now.t,
            q: &now.q,
            v: &now.v,
            u: &self.inputs,
        };
        let mut fading = touching.fading_slips(system, at, errors)?;
        if !fading.contains(&true) {
            return Ok(fading);
        }
        let closed: Vec<bool> = (touching.modes().iter())
            .map(|mode| *mode != Mode::Open)
            .collect();
        let stops: Vec<bool> = (0..closed.len())
            .map(|k| fading[touching.first(k)])
            .collect();
        let resting = resting_or_stopped(system, touching, now, (&closed, &stops));
        let Ok(next) = touching.settled(system, at, &closed, &resting, &[]) else {
            // What they do is found out for all contacts.
            fading.fill(false);
            return Ok(fading);
        };
        let next = next.modes;
        for (fading, next) in fading.iter_mut().zip(next) {
            *fading &= next == Mode::Sticks;
        }
        Ok(fading)
    }
}

/// For each coordinate the rate up to which it may be a residual: what the errors of steps add to a rate of 0.
fn fading_rate<V: Vector>(tolerance: &Tolerance<V>, v: &V) -> impl Fn(usize) -> f64 {
    let Tolerance { relative, absolute } = tolerance;
    move |i| FADING * (absolute.as_slice()[i] + relative * v.as_slice()[i].abs())
}
