//! The end of a run in double-double arithmetic.

use std::vec::Vec;

use lagrangian_scalar::{DoubleDouble, Scalar};

use super::{InterpretedMachine, Named, SeriesStepper};
use crate::control::check_count;
use crate::methods::{Method, TAYLOR};
use crate::step_error::StepError;
use crate::{Error, ExplicitStepper, Machine, State, Work};

/// Settings of a run in double-double arithmetic, of which only the end is kept: a reference for runs in `f64`.
///
/// An [`ExplicitStepper`] or a [`SeriesStepper`] in double-doubles takes the same steps. Those are generic, so that each crate that
/// uses them compiles a copy of its own; this one is compiled with the runtime.
#[derive(Clone, Copy, Debug)]
pub struct PreciseRun {
    /// `taylor`, or an explicit method.
    pub method: &'static Method,
    /// The absolute and the relative tolerance of a step.
    pub tolerance: f64,
    /// The largest number of steps.
    pub max_steps: usize,
}

/// The end of a [`PreciseRun`].
#[derive(Clone, Debug)]
pub struct PreciseEnd {
    /// Coordinates, in the order of the spec.
    pub q: Vec<DoubleDouble>,
    /// Their rates.
    pub v: Vec<DoubleDouble>,
    /// Steps and evaluations.
    pub work: Work,
}

impl PreciseRun {
    /// Runs a machine from a start to the time `until`, in s, later or earlier than the start.
    ///
    /// # Errors
    /// If the machine has constraints or contacts, or no Taylor series where the method is `taylor`, or if a step cannot be taken.
    pub fn end(
        &self,
        machine: &InterpretedMachine,
        start: &State<Named>,
        until: f64,
    ) -> Result<PreciseEnd, Error> {
        self.polled_end(machine, start, until, &|| Ok(()))
    }

    /// The state at the end of a run, as [`end`](Self::end); `poll` is called before each step, and the run ends with the error that it returns.
    ///
    /// # Errors
    /// As for [`end`](Self::end), and those of `poll`.
    pub fn polled_end(
        &self,
        machine: &InterpretedMachine,
        start: &State<Named>,
        until: f64,
        poll: &dyn Fn() -> Result<(), Error>,
    ) -> Result<PreciseEnd, Error> {
        let of_step = |error| Error::of_step(error, &machine.prepare());
        if !until.is_finite() {
            return Err(of_step(StepError::NoTime { t: until }));
        }
        let until = DoubleDouble::from_f64(until);
        let (q, v) = (&start.q.values, &start.v.values);
        let check = |taken: usize, t: DoubleDouble| {
            check_count(taken, self.max_steps, t.to_f64()).map_err(of_step)?;
            poll()
        };
        if core::ptr::eq(self.method, &TAYLOR) {
            let from = (start.t, q.as_slice(), v.as_slice());
            let mut stepper = SeriesStepper::from_state(machine, self.tolerance, from)?;
            let mut taken = 0;
            while stepper.t() != until {
                check(taken, stepper.t())?;
                stepper.step(until)?;
                taken += 1;
            }
            return Ok(PreciseEnd {
                q: stepper.q().to_vec(),
                v: stepper.v().to_vec(),
                work: stepper.work(),
            });
        }
        let builder = ExplicitStepper::builder(machine.prepare_in::<DoubleDouble>()?)
            .method(self.method)
            .tolerance(self.tolerance);
        let numbers = |values: &[f64]| -> Vec<_> {
            values.iter().map(|x| DoubleDouble::from_f64(*x)).collect()
        };
        let start = State {
            t: start.t,
            q: numbers(q),
            v: numbers(v),
        };
        let mut stepper = builder.start(start).map_err(of_step)?;
        stepper.set_end(until);
        let mut taken = 0;
        while !stepper.is_done() {
            check(taken, stepper.t())?;
            stepper.step().map_err(of_step)?;
            taken += 1;
        }
        Ok(PreciseEnd {
            q: stepper.q().clone(),
            v: stepper.v().clone(),
            work: stepper.work(),
        })
    }
}
