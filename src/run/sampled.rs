//! Changes of inputs: at the ends of the pieces in which they are smooth, and where sampled controllers read the state
//! and set them.

use std::collections::VecDeque;

use super::Run;
use crate::balance::Quadratures;
use crate::event::state;
use crate::inputs::InputLaw;
use crate::piece::{NoPiece, Piece};
use crate::settings::Sampled;
use crate::solution::{Ending, is_beyond};
use crate::stepper::Cause;
use crate::{Error, Inputs, Machine, System};

/// The inputs that a sampled controller has set in a run.
pub(super) struct Sampling<I> {
    /// The number of samples taken.
    taken: u64,
    /// The inputs set at the last sample.
    latest: I,
    /// Inputs that were set and have not taken effect yet, each with the time at which they will.
    pending: VecDeque<(f64, I)>,
}

impl<I> Sampling<I> {
    /// The time of the next sample of a run from `start`.
    fn next(&self, start: f64, period: f64) -> f64 {
        start + self.taken as f64 * period
    }
}

impl<M: Machine> Sampled<'_, M> {
    /// Its state at the start of a run.
    pub(super) fn begin(&self, system: &M::System) -> Sampling<Inputs<M>> {
        Sampling {
            taken: 0,
            latest: system.default_inputs(),
            pending: VecDeque::new(),
        }
    }
}

impl<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> Run<'_, '_, M, L, A> {
    /// Changes the inputs if this is due: enters the piece of time that begins here, and lets a sampled controller read the state
    /// and set its inputs. Then sets the next time at which a change is due as the end of the stepper. Returns the event that
    /// ends the run, if any.
    pub(super) fn change_inputs(&mut self) -> Result<Option<Ending>, Error> {
        let forward = self.until >= self.start;
        let mut stop = self.model.observed_system.law.piece.end(forward);
        if stop.is_infinite() && self.sampling.is_none() {
            return Ok(None);
        }
        let entered = self.enter_piece(forward)?;
        if let Some(piece) = entered {
            stop = piece.end(forward);
        }
        self.read_samples();
        let acting = self.acting_inputs();
        if let (Some(sampled), Some(sampling)) = (&self.callbacks.sampled, &self.sampling) {
            let later = sampling.pending.front().map(|(acts, _)| *acts);
            stop = stop
                .min(later.unwrap_or(f64::INFINITY))
                .min(sampling.next(self.start, sampled.period));
        }
        let direction = if forward { 1.0 } else { -1.0 };
        self.stop = if stop.is_infinite() || is_beyond(stop, self.until, direction) {
            self.until
        } else {
            stop
        };
        self.stepper.set_end(self.stop);
        match (acting, entered) {
            (None, None) => Ok(None),
            (None, Some(piece)) if !piece.jumps => {
                self.model.observed_system.law.piece = piece;
                self.stepper
                    .replace_law_without_jump(self.model.observed_system.law.clone());
                Ok(None)
            }
            (acting, entered) => self.jump_inputs(acting, entered),
        }
    }

    /// Lets a sampled controller read the state if a sample is due.
    fn read_samples(&mut self) {
        let (Some(sampled), Some(sampling)) = (&mut self.callbacks.sampled, &mut self.sampling)
        else {
            return;
        };
        let t = self.stepper.t();
        loop {
            let due = sampling.next(self.start, sampled.period);
            if !is_beyond(t, due, 1.0) {
                return;
            }
            let now = (t, self.stepper.q().clone(), self.stepper.v().clone());
            let now = state(self.model.system, now);
            (sampled.controller)(&now, &mut sampling.latest);
            let acts = due + sampled.delay;
            sampling.pending.push_back((acts, sampling.latest.clone()));
            sampling.taken += 1;
        }
    }

    /// The inputs of a sampled controller that take effect now, if there are any.
    fn acting_inputs(&mut self) -> Option<Inputs<M>> {
        let t = self.stepper.t();
        let sampling = self.sampling.as_mut()?;
        let mut acting = None;
        while let Some((_, inputs)) = sampling
            .pending
            .pop_front_if(|(acts, _)| is_beyond(t, *acts, 1.0))
        {
            acting = Some(inputs);
        }
        acting
    }

    /// Records the inputs that take effect exactly at the end of the run, so that the values after a jump hold there as at every
    /// other instant. Forces of contacts are those of the state in which the run leaves them, with the inputs before the jump.
    pub(super) fn change_inputs_at_end(&mut self) {
        if self.stepper.contacts().is_some() || self.stepper.touching().is_some() {
            return;
        }
        if let Some(sampled) = &self.callbacks.sampled
            && sampled.reads_end
        {
            self.read_samples();
        }
        if let Some(inputs) = self.acting_inputs() {
            self.record.sampled_inputs.push((self.stepper.t(), inputs));
        }
    }

    /// The piece of time that the run enters now, if it has reached the end of the one before.
    fn enter_piece(&mut self, forward: bool) -> Result<Option<Piece>, Error> {
        let t = self.stepper.t();
        let order = self.settings.method.tableau.order;
        let direction = if forward { 1.0 } else { -1.0 };
        let law = &self.model.observed_system.law;
        let mut end = law.piece.end(forward);
        let mut entered: Option<Piece> = None;
        // Pieces that end within the round-off of time are passed at once.
        while end.is_finite() && is_beyond(t, end, direction) {
            let piece = law.law.piece(end, forward, order);
            let piece = piece.map_err(|none| none.error(t))?;
            if (piece.end(forward) - end) * direction <= 0.0 {
                // A law written by hand returned a piece that does not advance.
                return Err(NoPiece::TooFine("an input").error(t));
            }
            let jumps = piece.jumps || entered.is_some_and(|before| before.jumps);
            entered = Some(Piece { jumps, ..piece });
            end = piece.end(forward);
        }
        self.record.pieces.extend(entered);
        Ok(entered)
    }

    /// Lets the inputs jump to other values.
    pub(super) fn jump_inputs(
        &mut self,
        held: Option<Inputs<M>>,
        piece: Option<Piece>,
    ) -> Result<Option<Ending>, Error> {
        let t = self.stepper.t();
        let before = self.stepper.contacts().clone();
        let v_before = self.stepper.v().clone();
        let law = &mut self.model.observed_system.law;
        if let Some(piece) = piece {
            law.piece = piece;
        }
        if let Some(held) = held {
            law.sampled = Some(held.clone());
            self.record.sampled_inputs.push((t, held));
        }
        let law = law.clone();
        if let Err(error) = self.stepper.jump_inputs(law) {
            let (q, v) = (self.stepper.q(), self.stepper.v());
            return Err(self.model.explain(error, q, v));
        }
        let at_start = self.stepper.work().steps == 0;
        if <M::System as System>::MAY_COLLIDE
            && self.stepper.touching().is_some()
            && !self.stepper.is_time_stepping()
        {
            let step = self.stepper.next_step();
            self.resolve_contacts_now(Cause::Unspecified, step, at_start)?;
        } else if !at_start {
            if let Some(steps) = &mut self.record.steps {
                steps.jump(&self.stepper);
            }
            self.record_energies();
        }
        if <M::System as System>::MAY_SLIDE && before.is_some() {
            self.record_contacts(before);
        }
        if !at_start {
            return self.watch_jumps(&v_before);
        }
        // The state at the start is the one after the first sample.
        self.begin_watches_again()?;
        Ok(None)
    }
}
