//! The energies, eqs. (E1), (E2) and (E59), and the dissipation function, eq. (E3).

use lagrangian_program::Role;
use lagrangian_scalar::Scalar;
use lagrangian_spec::model::Model;
use lagrangian_symbolic::Expr;

use super::{Definition, LiterallyAt};
use crate::Equations;

/// `T`, from the velocities of the bodies; literally from the rates of their positions.
pub(super) struct KineticEnergy;

impl Definition for KineticEnergy {
    const ROLE: Role = Role::KineticEnergy;

    fn expressions<'d>(_: &Model<'d>, equations: &Equations<'d>) -> Vec<Expr<'d>> {
        vec![equations.kinetic_energy]
    }

    fn literal<R: Scalar>(at: &LiterallyAt<'_, '_, R>) -> Vec<R> {
        vec![at.literal.kinetic_energy]
    }
}

/// `V`.
pub(super) struct PotentialEnergy;

impl Definition for PotentialEnergy {
    const ROLE: Role = Role::PotentialEnergy;

    fn expressions<'d>(_: &Model<'d>, equations: &Equations<'d>) -> Vec<Expr<'d>> {
        vec![equations.potential_energy]
    }

    fn literal<R: Scalar>(at: &LiterallyAt<'_, '_, R>) -> Vec<R> {
        vec![at.literal.potential_energy]
    }
}

/// `E`, of first-order states.
pub(super) struct StateEnergy;

impl Definition for StateEnergy {
    const ROLE: Role = Role::StateEnergy;

    fn expressions<'d>(_: &Model<'d>, equations: &Equations<'d>) -> Vec<Expr<'d>> {
        vec![equations.state_energy]
    }

    fn literal<R: Scalar>(at: &LiterallyAt<'_, '_, R>) -> Vec<R> {
        match at.machine.model.energies_of_states().next() {
            Some(_) => vec![at.literal.state_energy],
            None => Vec::new(),
        }
    }
}

/// `D`.
pub(super) struct Dissipation;

impl Definition for Dissipation {
    const ROLE: Role = Role::Dissipation;

    fn expressions<'d>(_: &Model<'d>, equations: &Equations<'d>) -> Vec<Expr<'d>> {
        vec![equations.dissipation]
    }

    fn literal<R: Scalar>(at: &LiterallyAt<'_, '_, R>) -> Vec<R> {
        vec![at.literal.dissipation]
    }
}
