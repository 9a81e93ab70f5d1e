//! Controllers that look at a machine at certain instants, and what they set in between.

use std::collections::VecDeque;

use super::Run;
use crate::balance::Quadratures;
use crate::event::state;
use crate::inputs::InputLaw;
use crate::settings::Sampled;
use crate::solution::{Ending, is_beyond};
use crate::stepper::Cause;
use crate::{Error, Inputs, Machine, System};

/// What it has set in a run.
pub(super) struct Sampling<I> {
    /// How many looks were taken.
    taken: u64,
    /// What the last one set.
    latest: I,
    /// What was set and does not act yet, and when it will.
    pending: VecDeque<(f64, I)>,
}

impl<M: Machine> Sampled<'_, M> {
    /// What is known of it at the start of a run.
    pub(super) fn begin(&self, system: &M::System) -> Sampling<Inputs<M>> {
        Sampling {
            taken: 0,
            latest: system.default_inputs(),
            pending: VecDeque::new(),
        }
    }
}

impl<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> Run<'_, '_, M, L, A> {
    /// Lets a sampled controller look at the machine and set its inputs, if it is time for either; then goes on to where it
    /// will be time again. The answer is the event that ends the run.
    pub(super) fn sample(&mut self) -> Result<Option<Ending>, Error> {
        let Some(sampled) = &mut self.callbacks.sampled else {
            return Ok(None);
        };
        let Some(sampling) = &mut self.sampling else {
            return Ok(None);
        };
        let t = self.stepper.t();
        let next = |taken: u64| self.start + taken as f64 * sampled.period;
        while is_beyond(t, next(sampling.taken), 1.0) {
            let now = (t, self.stepper.q().clone(), self.stepper.v().clone());
            let now = state(self.model.system, now);
            (sampled.controller)(&now, &mut sampling.latest);
            let acts = next(sampling.taken) + sampled.delay;
            sampling.pending.push_back((acts, sampling.latest.clone()));
            sampling.taken += 1;
        }
        let mut acting = None;
        while let Some((_, inputs)) = sampling
            .pending
            .pop_front_if(|(acts, _)| is_beyond(t, *acts, 1.0))
        {
            acting = Some(inputs);
        }
        let later = sampling.pending.front().map(|(acts, _)| *acts);
        let stop = later.unwrap_or(f64::INFINITY).min(next(sampling.taken));
        self.stop = match is_beyond(stop, self.until, 1.0) {
            true => self.until,
            false => stop,
        };
        self.stepper.set_end(self.stop);
        match acting {
            Some(inputs) => self.set_inputs(inputs),
            None => Ok(None),
        }
    }

    /// The inputs jump to other values.
    fn set_inputs(&mut self, inputs: Inputs<M>) -> Result<Option<Ending>, Error> {
        let t = self.stepper.t();
        let before = self.stepper.contacts().clone();
        self.model.sight.law.held = Some(inputs.clone());
        let law = self.model.sight.law.clone();
        if let Err(error) = self.stepper.jump_inputs(law) {
            let (q, v) = (self.stepper.q(), self.stepper.v());
            return Err(self.model.explain(error, q, v));
        }
        self.record.held.push((t, inputs));
        let at_start = self.stepper.work().steps == 0;
        if <M::System as System>::MAY_COLLIDE && self.stepper.touching().is_some() {
            let step = self.stepper.next_step();
            self.meet_now(Cause::Asked, step, at_start)?;
        } else if !at_start {
            if let Some(steps) = &mut self.record.steps {
                steps.jump(&self.stepper);
            }
            self.enter_energies();
        }
        if <M::System as System>::MAY_SLIDE && before.is_some() {
            self.note_contacts(before);
        }
        if !at_start {
            return self.watch_jumps();
        }
        // The start is as the first look leaves it.
        let now = (t, self.stepper.q().clone(), self.stepper.v().clone());
        let now = state(self.model.system, now);
        let observe = || self.model.sight.observe::<M, A>(&self.stepper, &now);
        for watch in &mut self.callbacks.watches {
            watch.begin(&now, watch.at_zero, &observe)?;
        }
        Ok(None)
    }
}
