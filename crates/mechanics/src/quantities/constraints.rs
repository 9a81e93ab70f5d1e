//! The residuals of constraints, eq. (E29).

use lagrangian_program::Role;
use lagrangian_scalar::Scalar;
use lagrangian_spec::model::Model;
use lagrangian_symbolic::Expr;

use super::{Definition, LiterallyAt};
use crate::Equations;

/// `g`, which is 0 for a constraint of velocities alone.
pub(super) struct ConstraintPositions;

impl Definition for ConstraintPositions {
    const ROLE: Role = Role::ConstraintPositions;

    fn expressions<'d>(model: &Model<'d>, equations: &Equations<'d>) -> Vec<Expr<'d>> {
        let positions = equations.constraints.iter().map(|c| c.position);
        positions
            .map(|position| position.unwrap_or(model.dag.zero()))
            .collect()
    }

    fn literal<R: Scalar>(at: &LiterallyAt<'_, '_, R>) -> Vec<R> {
        at.literal.constraints.iter().map(|c| c.position).collect()
    }
}

/// `φ = G v + ∂g/∂t`; literally the rate of `g` along the motion.
pub(super) struct ConstraintRates;

impl Definition for ConstraintRates {
    const ROLE: Role = Role::ConstraintRates;

    fn expressions<'d>(_: &Model<'d>, equations: &Equations<'d>) -> Vec<Expr<'d>> {
        equations.constraints.iter().map(|c| c.rate).collect()
    }

    fn literal<R: Scalar>(at: &LiterallyAt<'_, '_, R>) -> Vec<R> {
        at.literal.constraints.iter().map(|c| c.rate).collect()
    }
}
