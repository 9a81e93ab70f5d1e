//! Everything that a machine computes at one state, independent of a run.

use std::vec;
use std::vec::Vec;

use crate::at::At;
use crate::{
    ContactForce, Pivot, StepError, System, UnilateralForce, Vector, contact_forces,
    least_multipliers, unilateral_forces,
};

/// Everything that a machine of n coordinates and m constraints computes at a state: what `lagrangian evaluate` prints.
///
/// Numbers are in SI units. The unit of a generalized force is J divided by that of its coordinate: N for one in m, N m for one in rad.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Evaluation<O> {
    /// Mass matrix `M`, n rows of n, in J s² divided by the units of both coordinates: kg, kg m or kg m².
    pub mass_matrix: Vec<f64>,
    /// Bias `h`, n generalized forces.
    pub bias: Vec<f64>,
    /// Applied generalized forces `Q`, n of them.
    pub applied: Vec<f64>,
    /// Right-hand side `f = Q − h`, n generalized forces.
    pub forces: Vec<f64>,
    /// Accelerations, n of them, each in the unit of its coordinate per s².
    pub accelerations: Vec<f64>,
    /// Multipliers of the m constraints, each in J divided by the unit of its constraint, in N for one in m; for dependent
    /// constraints the ones of least norm. The forces of closed unilateral contacts are not taken into account.
    pub multipliers: Vec<f64>,
    /// Generalized reactions of the constraints on each coordinate, `Gᵀ λ`, n generalized forces; empty without constraints.
    pub reactions: Vec<f64>,
    /// The guided contacts, in their order.
    pub contacts: Vec<ContactForce>,
    /// The unilateral contacts, in their order.
    pub unilateral: Vec<UnilateralForce>,
    /// The kinetic energy, in J.
    pub kinetic_energy: f64,
    /// The potential energy, in J.
    pub potential_energy: f64,
    /// The dissipation function, in W.
    pub dissipation: f64,
    /// Outputs.
    pub outputs: O,
}

impl<O> Evaluation<O> {
    /// Evaluates a system at time, coordinates, rates and inputs.
    ///
    /// # Errors
    /// If the machine has no accelerations.
    pub fn of<S: System<Outputs = O>>(
        system: &S,
        At { t, q, v, u }: At<'_, S>,
    ) -> Result<Self, StepError> {
        let n = q.as_slice().len();
        let (mut bias, mut applied) = (q.zeros_like(), q.zeros_like());
        let (mut forces, mut a) = (q.zeros_like(), q.zeros_like());
        let mut matrix = S::Matrix::zeros(n * n);
        let mut multipliers = vec![0.0; system.constraints().len()];
        let result = system
            .accelerations(t, q, v, u, &mut a)
            .and_then(|()| system.multipliers(t, q, v, u, &mut multipliers));
        if let Err(singular) = result {
            // Dependent constraints have many possible multipliers, all with the same motion.
            match singular.at {
                // Not with guided contacts, whose states would be unknown here.
                Pivot::Constraint(_) if system.contacts().len() == 0 => {
                    least_multipliers(system, t, q, v, u, &mut a, &mut multipliers)?;
                }
                _ => return Err(StepError::Singular { singular, t }),
            }
        }
        let unilateral = match system.unilateral_contacts().len() {
            0 => Vec::new(),
            _ => unilateral_forces(system, At { t, q, v, u }, &mut a)?,
        };
        let mut rows = vec![0.0; multipliers.len() * n];
        system.constraint_matrix(t, q, &mut rows);
        let reaction = |i: usize| {
            let column = rows.iter().skip(i).step_by(n).zip(&multipliers);
            column.map(|(g, multiplier)| g * multiplier).sum()
        };
        let reactions = if multipliers.is_empty() {
            Vec::new()
        } else {
            (0..n).map(reaction).collect()
        };
        let mut contacts = vec![ContactForce::default(); system.contacts().len()];
        if !contacts.is_empty() {
            // If they have no value, the accelerations have none either.
            let _ = contact_forces(system, At { t, q, v, u }, &mut [], &mut [], &mut contacts);
        }
        system.mass_matrix(t, q, &mut matrix);
        system.bias(t, q, v, &mut bias);
        system.applied(t, q, v, u, &mut applied);
        system.forces(t, q, v, u, &mut forces);
        let list = |vector: &S::Vector| vector.as_slice().to_vec();
        Ok(Self {
            mass_matrix: matrix.as_slice().to_vec(),
            bias: list(&bias),
            applied: list(&applied),
            forces: list(&forces),
            multipliers,
            reactions,
            contacts,
            unilateral,
            kinetic_energy: system.kinetic_energy(t, q, v),
            potential_energy: system.potential_energy(t, q, u),
            dissipation: system.dissipation(t, q, v, u),
            outputs: system.outputs(t, q, v, &a, u),
            accelerations: list(&a),
        })
    }
}
