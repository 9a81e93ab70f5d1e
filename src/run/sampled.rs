//! Where inputs change: at the ends of the pieces in which they are smooth, and where controllers look at a machine and set them.

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
    /// Where inputs change: enters the piece of time that begins here, lets a sampled controller look at the machine and set its
    /// inputs, if it is time for any of that; then goes on to where it will be time again. The answer is the event that ends the
    /// run.
    pub(super) fn change_inputs(&mut self) -> Result<Option<Ending>, Error> {
        let forward = self.until >= self.start;
        let mut stop = self.model.sight.law.piece.end(forward);
        if stop.is_infinite() && self.sampling.is_none() {
            return Ok(None);
        }
        let t = self.stepper.t();
        let entered = self.enter_piece(forward)?;
        if let Some(piece) = entered {
            stop = piece.end(forward);
        }
        let mut acting = None;
        if let (Some(sampled), Some(sampling)) = (&mut self.callbacks.sampled, &mut self.sampling) {
            let next = |taken: u64| self.start + taken as f64 * sampled.period;
            while is_beyond(t, next(sampling.taken), 1.0) {
                let now = (t, self.stepper.q().clone(), self.stepper.v().clone());
                let now = state(self.model.system, now);
                (sampled.controller)(&now, &mut sampling.latest);
                let acts = next(sampling.taken) + sampled.delay;
                sampling.pending.push_back((acts, sampling.latest.clone()));
                sampling.taken += 1;
            }
            while let Some((_, inputs)) = sampling
                .pending
                .pop_front_if(|(acts, _)| is_beyond(t, *acts, 1.0))
            {
                acting = Some(inputs);
            }
            let later = sampling.pending.front().map(|(acts, _)| *acts);
            stop = stop
                .min(later.unwrap_or(f64::INFINITY))
                .min(next(sampling.taken));
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
                self.model.sight.law.piece = piece;
                self.stepper.go_on_with(self.model.sight.law.clone());
                Ok(None)
            }
            (acting, entered) => self.jump_inputs(acting, entered),
        }
    }

    /// The piece of time that the run enters now, if it comes to the end of the one before.
    fn enter_piece(&mut self, forward: bool) -> Result<Option<Piece>, Error> {
        let t = self.stepper.t();
        let order = self.settings.method.tableau.order;
        let direction = if forward { 1.0 } else { -1.0 };
        let law = &self.model.sight.law;
        let mut end = law.piece.end(forward);
        let mut entered: Option<Piece> = None;
        // What follows within the roundoff of time is entered at once.
        while end.is_finite() && is_beyond(t, end, direction) {
            let piece = law.law.piece(end, forward, order);
            let piece = piece.map_err(|none| none.error(t))?;
            if (piece.end(forward) - end) * direction <= 0.0 {
                // A law by hand that does not get on.
                return Err(NoPiece::TooFine("an input").error(t));
            }
            let jumps = piece.jumps || entered.is_some_and(|before| before.jumps);
            entered = Some(Piece { jumps, ..piece });
            end = piece.end(forward);
        }
        self.record.pieces.extend(entered);
        Ok(entered)
    }

    /// The inputs jump to other values.
    fn jump_inputs(
        &mut self,
        held: Option<Inputs<M>>,
        piece: Option<Piece>,
    ) -> Result<Option<Ending>, Error> {
        let t = self.stepper.t();
        let before = self.stepper.contacts().clone();
        let law = &mut self.model.sight.law;
        if let Some(piece) = piece {
            law.piece = piece;
        }
        if let Some(held) = held {
            law.held = Some(held.clone());
            self.record.held.push((t, held));
        }
        let law = law.clone();
        if let Err(error) = self.stepper.jump_inputs(law) {
            let (q, v) = (self.stepper.q(), self.stepper.v());
            return Err(self.model.explain(error, q, v));
        }
        let at_start = self.stepper.work().steps == 0;
        if <M::System as System>::MAY_COLLIDE
            && self.stepper.touching().is_some()
            && !self.stepper.is_by_impulses()
        {
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
