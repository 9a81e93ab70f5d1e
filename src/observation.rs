//! Observations: everything about a machine at an instant of a run.

use std::vec;
use std::vec::Vec;

use crate::at::At;
use crate::constraints::Constraints;
use crate::contact::{ContactMemory, UnilateralState};
use crate::friction::{ContactForce, Contacts};
use crate::inputs::{InputLaw, LawInPiece};
use crate::step_error::StepError;
use crate::stepper::{Stepper, accelerations};
use crate::{
    Coordinates, Error, Inputs, Machine, Outputs, Quadratures, State, System, UnilateralForce,
    Vector,
};

/// Everything about a machine at an instant.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Observation<M: Machine> {
    /// Time, in s.
    pub t: f64,
    /// Coordinates.
    pub q: Coordinates<M>,
    /// Rates, each in the unit of its coordinate per s.
    pub v: Coordinates<M>,
    /// Accelerations, each in the unit of its coordinate per s².
    pub a: Coordinates<M>,
    /// Inputs.
    pub inputs: Inputs<M>,
    /// Outputs.
    pub outputs: Outputs<M>,
    /// Multipliers of the constraints, in their order, each in J divided by the unit of its constraint; the ones of least norm if
    /// constraints are dependent.
    pub multipliers: Vec<f64>,
    /// The guided contacts, in their order.
    pub contacts: Vec<ContactForce>,
    /// The unilateral contacts, in their order.
    pub unilateral: Vec<UnilateralForce>,
    /// Kinetic energy, in J.
    pub kinetic_energy: f64,
    /// Potential energy, in J, including the energy stored by compliant contacts.
    pub potential_energy: f64,
}

/// The state of constraints and contacts at an instant of a run: the chosen rows, the states of guided contacts,
/// and the closed unilateral ones.
pub(crate) struct ConstraintState<'x, V> {
    pub constraints: &'x Option<Constraints<V>>,
    pub contacts: Option<&'x Contacts>,
    pub touching: Option<&'x UnilateralState>,
}

/// A system with the law of its inputs, for observation during a run.
pub(crate) struct ObservedSystem<'r, S: System, L> {
    pub system: &'r S,
    pub law: LawInPiece<'r, L, S::Inputs>,
}

impl<S: System, L: InputLaw<S>> ObservedSystem<'_, S, L> {
    pub fn inputs(&self, t: f64, q: &S::Vector, v: &S::Vector) -> S::Inputs {
        let mut inputs = self.system.default_inputs();
        self.law.set(self.system, t, q, v, &mut inputs);
        inputs
    }

    /// Observes the machine in a state within the last step.
    pub fn observe<M: Machine<System = S>, A: Quadratures<S>>(
        &self,
        stepper: &Stepper<'_, S, LawInPiece<'_, L, S::Inputs>, A>,
        state: &State<S::Coordinates>,
    ) -> Result<Observation<M>, Error> {
        let known = ConstraintState::of(stepper);
        let (q, v) = (
            self.system.to_vector(&state.q),
            self.system.to_vector(&state.v),
        );
        known.observe::<M>(self.system, state, self.inputs(state.t, &q, &v))
    }
}

impl<'x, V: Vector> ConstraintState<'x, V> {
    /// The constraints and contacts of a stepper during its last step.
    pub fn of<S: System<Vector = V>, L: InputLaw<S>, A: Quadratures<S>>(
        stepper: &'x Stepper<'_, S, L, A>,
    ) -> Self {
        ConstraintState {
            constraints: stepper.constraints(),
            contacts: stepper.contacts().as_ref(),
            touching: stepper.touching().as_ref(),
        }
    }

    /// The accelerations at a state, computed as in the run.
    pub fn accelerations<S: System<Vector = V>>(
        &self,
        system: &S,
        at: At<'_, S>,
        a: &mut V,
    ) -> Result<(), StepError> {
        let At { t, q, v, u } = at;
        if S::MAY_COLLIDE
            && let Some(touching) = self.touching
        {
            let mut memory = ContactMemory::new(touching, at.q);
            return touching.accelerations(system, at, &mut memory, a);
        }
        if S::MAY_BE_CONSTRAINED
            && let Some(known) = self.constraints
            && known.redundant
        {
            let mut known = known.clone();
            known.choose_as_many(system, t, q)?;
            return known.accelerations(system, t, q, v, u, a);
        }
        accelerations(system, (self.constraints, &self.contacts.cloned()), at, a)
    }

    fn multipliers<S: System<Vector = V>>(
        &self,
        system: &S,
        at: At<'_, S>,
    ) -> Result<Vec<f64>, StepError> {
        let At { t, q, v, u } = at;
        if S::MAY_COLLIDE
            && let Some(touching) = self.touching
        {
            return touching.multipliers(system, at);
        }
        if !S::MAY_BE_CONSTRAINED {
            return Ok(Vec::new());
        }
        let mut multipliers = vec![0.0; system.constraints().len()];
        match self.constraints {
            None => {}
            Some(known) if known.redundant => {
                let mut known = known.clone();
                known.choose_as_many(system, t, q)?;
                known.multipliers(system, t, q, v, u, &mut multipliers)?;
            }
            Some(_) => system
                .multipliers(t, q, v, u, &mut multipliers)
                .map_err(|singular| StepError::Singular { singular, t })?,
        }
        Ok(multipliers)
    }

    /// Observes the machine in a state.
    pub fn observe<M: Machine<System: System<Vector = V>>>(
        &self,
        system: &M::System,
        state: &State<Coordinates<M>>,
        inputs: Inputs<M>,
    ) -> Result<Observation<M>, Error> {
        self.outputs_and_multipliers::<M>(system, state, inputs)
            .map_err(|error| Error::of_step(error, system))
    }

    fn outputs_and_multipliers<M: Machine<System: System<Vector = V>>>(
        &self,
        system: &M::System,
        state: &State<Coordinates<M>>,
        u: Inputs<M>,
    ) -> Result<Observation<M>, StepError> {
        let t = state.t;
        let (q, v) = (system.to_vector(&state.q), system.to_vector(&state.v));
        let mut a = q.zeros_like();
        let at = At {
            t,
            q: &q,
            v: &v,
            u: &u,
        };
        self.accelerations(system, at, &mut a)?;
        let (mut multipliers, mut contacts);
        if M::System::MAY_SLIDE
            && let Some(known) = self.contacts
        {
            multipliers = vec![0.0; system.constraints().len()];
            contacts = vec![ContactForce::default(); system.contacts().len()];
            known
                .forces(system, at, &mut multipliers, &mut contacts)
                .map_err(|singular| StepError::Singular { singular, t })?;
        } else {
            (multipliers, contacts) = (self.multipliers(system, at)?, Vec::new());
        }
        let (mut unilateral, mut stored) = (Vec::new(), 0.0);
        if M::System::MAY_COLLIDE
            && let Some(touching) = self.touching
        {
            unilateral = touching.forces(system, at, &mut a)?;
            stored = touching.stored(system, t, &q, &v);
        }
        Ok(Observation {
            t,
            multipliers,
            contacts,
            unilateral,
            q: state.q.clone(),
            v: state.v.clone(),
            a: system.to_coordinates(&a),
            outputs: system.outputs(t, &q, &v, &a, &u),
            kinetic_energy: system.kinetic_energy(t, &q, &v),
            potential_energy: system.potential_energy(t, &q, &u)
                + system.state_energy(t, &q, &v)
                + stored,
            inputs: u,
        })
    }
}
