//! Changes a run with unilateral contacts from locating every event to time stepping, and back.

use super::contact_changes::{Cause, ContactChanges, project_onto_closed_contacts};
use super::{InImpulses, Stepper};
use crate::at::At;
use crate::balance::Quadratures;
use crate::constraints::Constraints;
use crate::contact::UnilateralState;
use crate::inputs::InputLaw;
use crate::methods::Method;
use crate::stages::Point;
use crate::{StepError, System};
use std::boxed::Box;

/// A copy of the parts of a stepper that change when contacts meet.
pub(crate) struct Snapshot<S: System, A> {
    now: Point<S::Vector>,
    touching: Option<UnilateralState>,
    constraints: Option<Constraints<S::Vector>>,
    quadratures: A,
}

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// Copies the present state, for [`restore`](Self::restore).
    pub(crate) fn snapshot(&self) -> Snapshot<S, A> {
        Snapshot {
            now: self.now.clone(),
            touching: self.model.touching.clone(),
            constraints: self.model.constraints.clone(),
            quadratures: self.quadratures.clone(),
        }
    }

    /// Restores a state at the same instant. This also removes the losses of impacts that did not settle.
    pub(crate) fn restore(&mut self, snapshot: Snapshot<S, A>) {
        self.now = snapshot.now;
        self.model.touching = snapshot.touching;
        self.model.constraints = snapshot.constraints;
        self.quadratures = snapshot.quadratures;
    }

    /// Whether the method is time stepping.
    pub(crate) fn is_time_stepping(&self) -> bool {
        self.impulses.is_some()
    }

    /// The fastest rate at which any gap closed so far, in m/s, and the acceleration that forces add to such a rate now, in m/s²:
    /// see [`UnilateralState`].
    pub(crate) fn closing_rate_and_acceleration(&mut self) -> [f64; 2] {
        let Self { model, now, .. } = self;
        model.set_inputs(now.t, &now.q, &now.v);
        let Some(touching) = &model.touching else {
            return [0.0; 2];
        };
        let at = At {
            t: now.t,
            q: &now.q,
            v: &now.v,
            u: &model.inputs,
        };
        [touching.speed(), touching.pull(model.system.get(), at)]
    }

    /// Whether the forces in the contacts that were closed in the last step
    /// of time stepping would be unique if all of these were constraints.
    pub(crate) fn contact_forces_are_unique(&mut self) -> bool {
        let Self { model, now, .. } = self;
        model.set_inputs(now.t, &now.q, &now.v);
        let Some(mut touching) = model.touching.clone() else {
            return true;
        };
        touching.end_stepping();
        let at = At {
            t: now.t,
            q: &now.q,
            v: &now.v,
            u: &model.inputs,
        };
        let reaction = touching.reaction(model.system.get(), at);
        reaction.is_ok_and(|reaction| reaction.is_only)
    }

    /// Closes the guides of a run that begins with time stepping.
    pub(crate) fn close_guides(&mut self) {
        let Self { model, now, .. } = self;
        if let Some(touching) = &mut model.touching {
            touching.close_guides(model.system.get(), (now.t, &now.q, &now.v));
        }
    }

    /// Continues to `end` by time stepping, in steps of length `h`, with the contacts that are closed now.
    pub(crate) fn begin_stepping(&mut self, h: f64, end: f64) -> Result<(), StepError> {
        self.end = end;
        let Self { model, now, .. } = self;
        if let Some(touching) = &mut model.touching {
            touching.begin_stepping();
            // Only the constraints of the machine remain.
            model.constraints = project_onto_closed_contacts(model.system.get(), touching, now)?;
        }
        self.taylor = None;
        let impulses = InImpulses::new(&self.now.q, &self.now.v);
        self.impulses = Some(Box::new(impulses));
        self.switch_method(Method::MOREAU, h)
    }

    /// Continues to `end` by `method`, which locates every event, in steps of at most `longest`, with the contacts that were closed in the
    /// last step of time stepping as constraints. The energy that the projection onto these takes is a loss. If the contacts do not settle,
    /// everything is restored.
    pub(crate) fn end_stepping(
        &mut self,
        method: &'static Method,
        (longest, step): (f64, f64),
        end: f64,
    ) -> Result<ContactChanges, StepError> {
        let before = (
            self.model.touching.clone(),
            self.model.constraints.clone(),
            self.now.clone(),
            self.quadratures.clone(),
            self.impulses.take(),
            (self.longest, self.end, self.control.step),
        );
        let energy = |stepper: &mut Self| {
            let Self { model, now, .. } = stepper;
            model.set_inputs(now.t, &now.q, &now.v);
            let system = model.system.get();
            system.kinetic_energy(now.t, &now.q, &now.v)
                + system.potential_energy(now.t, &now.q, &model.inputs)
        };
        let energy_before = energy(self);
        if let Some(touching) = &mut self.model.touching {
            touching.end_stepping();
        }
        let met = self.switch_method(method, longest);
        match met.and_then(|()| self.resolve_contacts(Cause::Unspecified, false, end, step)) {
            Ok(mut changes_at_instant) => {
                if changes_at_instant.impacts.is_empty() {
                    let taken = energy_before - energy(self);
                    self.quadratures
                        .add_instantaneous(0.0, taken - changes_at_instant.lost_at_end);
                    changes_at_instant.lost_at_end = taken;
                }
                Ok(changes_at_instant)
            }
            Err(error) => {
                let (touching, constraints, now, quadratures, impulses, settings) = before;
                self.model.touching = touching;
                self.model.constraints = constraints;
                self.now = now;
                self.quadratures = quadratures;
                self.impulses = impulses;
                self.switch_method(Method::MOREAU, settings.0)?;
                (_, self.end, self.control.step) = settings;
                Err(error)
            }
        }
    }

    /// Continues with another method.
    pub(super) fn switch_method(
        &mut self,
        method: &'static Method,
        longest: f64,
    ) -> Result<(), StepError> {
        self.method = method;
        self.longest = longest;
        // There is no step of the new method yet that could be undone.
        self.k.swap(0, self.newest);
        self.newest = 0;
        let Self {
            model,
            now,
            k,
            control,
            ..
        } = self;
        model.accelerations(now.t, &now.q, &now.v, &mut k[0], &mut control.work)?;
        model.take_rates(&mut self.quadratures, 0, (now.t, &now.q, &now.v, &k[0]));
        control.forget_error();
        if let Some(implicit) = &mut self.implicit {
            implicit.forget();
        }
        Ok(())
    }
}
