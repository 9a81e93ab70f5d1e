//! Runs whose end and inputs are not known when they begin: the caller takes them from one instant to the next.
//!
//! Such a run is that of a simulation whose end moves. A sampled controller does the same from within a run; here the caller does it from outside.

use std::vec::Vec;

use super::ending::warnings_so_far;
use super::{Prepared, Run, RunOf};
use crate::event::state;
use crate::inputs::Law;
use crate::settings::Task;
use crate::solution::Ending;
use crate::{ContactEvent, Coordinates, Error, Inputs, Machine, Observation, State, Warning};

/// A run that has been prepared and not yet begun: [`Simulation::prepare`](crate::Simulation::prepare) makes it, and [`begin`](Self::begin)
/// begins the run, which borrows from it.
pub struct PreparedRun<'a, M: Machine> {
    prepared: Prepared<'a, 'a, M>,
}

impl<'a, M: Machine> PreparedRun<'a, M> {
    /// Checks settings and start.
    pub(crate) fn new(
        task: Task<'a, M, Law<'a, M::System>>,
        start: State<Coordinates<M>>,
    ) -> Result<Self, Error> {
        let prepared = Prepared::new(task, start)?;
        Ok(Self { prepared })
    }

    /// What the run warns of before it begins, such as a start that was moved onto the constraints.
    pub fn warnings(&self) -> &[Warning] {
        &self.prepared.start_warnings
    }

    /// Begins the run: what touches at the start is closed, or bounces.
    ///
    /// # Errors
    /// As [`Simulation::run`](crate::Simulation::run) at the start.
    pub fn begin(&mut self) -> Result<RunInPieces<'_, 'a, M>, Error> {
        let most_steps = self.prepared.settings.max_steps;
        let run = self.prepared.begin()?;
        Ok(RunInPieces {
            run,
            most_steps,
            is_over: None,
        })
    }
}

/// A run that the caller takes from one instant to the next, and whose inputs it sets in between: see
/// [`Simulation::prepare`](crate::Simulation::prepare).
pub struct RunInPieces<'r, 'a, M: Machine> {
    run: RunOf<'r, 'a, 'a, M>,
    /// The largest number of steps to one instant.
    most_steps: usize,
    /// How it ended, if it did not end at the instant that it was taken to.
    is_over: Option<Result<Ending, Error>>,
}

impl<M: Machine> RunInPieces<'_, '_, M> {
    /// Takes the run to time `t`, in s, where a step ends; the step after it is as long as it would have been otherwise. At most
    /// [`max_steps`](crate::Simulation::max_steps) steps are taken.
    ///
    /// Returns [`Ending::End`] at `t`, or why the run has ended before: then it is over, and every further call returns the same.
    ///
    /// # Errors
    /// If the run cannot go on; [`state`](Self::state) is then the last that is known, and every further call returns the same error. If `t` is
    /// not finite, or before the present time; then nothing happens.
    pub fn advance_to(&mut self, t: f64) -> Result<Ending, Error> {
        if let Some(over) = &self.is_over {
            return over.clone();
        }
        let now = self.run.stepper.t();
        if !(t.is_finite() && t >= now) {
            return Err(Error::InvalidSetting {
                setting: "advance_to",
                value: t,
                needed: "a finite time, not before the present one",
            });
        }
        if t == now {
            return Ok(Ending::End);
        }
        let run = &mut *self.run;
        (run.until, run.stop) = (t, t);
        run.stepper.set_end(t);
        run.most_steps = run.stepper.work().steps.saturating_add(self.most_steps);
        let ending = run.go_to_end();
        if !matches!(ending, Ok(Ending::End)) {
            self.is_over = Some(ending.clone());
        }
        self.forget_past();
        ending
    }

    /// Sets the inputs from now on. Where forces of closed contacts jump with them, it is decided anew what sticks, slips and presses.
    ///
    /// # Errors
    /// If the machine cannot move with these inputs; every further call then returns the same error.
    pub fn set_inputs(&mut self, inputs: Inputs<M>) -> Result<(), Error> {
        if let Some(over) = &self.is_over {
            return over.clone().map(|_| ());
        }
        let changed = self.run.jump_inputs(Some(inputs), None);
        self.forget_past();
        match changed {
            Ok(None) => Ok(()),
            Ok(Some(ending)) => {
                self.is_over = Some(Ok(ending));
                Ok(())
            }
            Err(error) => {
                self.is_over = Some(Err(error.clone()));
                Err(error)
            }
        }
    }

    /// Time and state now, after the changes of contacts at this instant.
    pub fn state(&self) -> State<Coordinates<M>> {
        let stepper = &self.run.stepper;
        let now = (stepper.t(), stepper.q().clone(), stepper.v().clone());
        state(self.run.model.system, now)
    }

    /// Everything about the machine now: accelerations, outputs, multipliers, and the forces of its contacts.
    ///
    /// # Errors
    /// If the machine has no accelerations here.
    pub fn observe(&self) -> Result<Observation<M>, Error> {
        let model = &self.run.model;
        (model.observed_system).observe::<M, _>(&self.run.stepper, &self.state())
    }

    /// What has happened to the unilateral contacts since the last call, in order of time.
    pub fn take_contact_events(&mut self) -> Vec<ContactEvent<Coordinates<M>>> {
        std::mem::take(&mut self.run.record.unilateral.events)
    }

    /// The warnings of the run so far, without those [about its start](PreparedRun::warnings).
    pub fn warnings(&self) -> Vec<Warning> {
        let Run {
            model,
            settings,
            stepper,
            record,
            ..
        } = &*self.run;
        warnings_so_far::<M, _, _>(model.system, settings, stepper, record)
    }

    /// Forgets what only a record of the whole run needs, since this one may be of any length.
    fn forget_past(&mut self) {
        let record = &mut self.run.record;
        let older = record.sampled_inputs.len().saturating_sub(1);
        record.sampled_inputs.drain(..older);
        let older = record.contacts.len().saturating_sub(1);
        record.contacts.drain(..older);
    }
}
