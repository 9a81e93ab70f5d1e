//! Tries of explicit steps as kernels: several coordinates at a time in the registers of the processor.

use super::Stepper;
use crate::System;
use crate::balance::Quadratures;
use crate::inputs::InputLaw;
use crate::scalar::{Kernel, Scalar};
use crate::step_error::StepError;

/// A whole try: [`Stepper::attempt`].
pub(super) struct Attempt<'a, 's, S: System, L, A> {
    pub stepper: &'a mut Stepper<'s, S, L, A>,
    pub h: f64,
    pub last: bool,
}

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Kernel<f64> for Attempt<'_, '_, S, L, A> {
    type Output = Result<f64, StepError>;

    #[inline(always)]
    fn run<R: Scalar<Stored = f64>>(self) -> Result<f64, StepError> {
        self.stepper.attempt_within::<R>(self.h, self.last)
    }
}

/// The end of an attempt: [`Stepper::finish`].
#[cfg(feature = "std")]
pub(super) struct Finish<'a, 's, S: System, L, A> {
    pub stepper: &'a mut Stepper<'s, S, L, A>,
    pub h: f64,
}

#[cfg(feature = "std")]
impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Kernel<f64> for Finish<'_, '_, S, L, A> {
    type Output = Result<f64, StepError>;

    #[inline(always)]
    fn run<R: Scalar<Stored = f64>>(self) -> Result<f64, StepError> {
        self.stepper.finish_within::<R>(self.h)
    }
}
