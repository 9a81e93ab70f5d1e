//! The power that dampers take, eq. (E18).

use lagrangian_program::Role;
use lagrangian_scalar::Scalar;
use lagrangian_spec::model::Model;
use lagrangian_symbolic::Expr;

use super::{Definition, LiterallyAt};
use crate::Equations;

/// `R = v·∂D/∂v`, and the losses that the spec names; literally the derivative of `D` along the rates.
pub(super) struct DissipationRate;

impl Definition for DissipationRate {
    const ROLE: Role = Role::DissipationRate;

    fn expressions<'d>(_: &Model<'d>, equations: &Equations<'d>) -> Vec<Expr<'d>> {
        vec![equations.dissipation_rate]
    }

    fn literal<R: Scalar>(at: &LiterallyAt<'_, '_, R>) -> Vec<R> {
        let damped = match at.machine.model.dissipated().next() {
            Some(_) => at.machine.damping(at.state, &at.state.v),
            None => R::ZERO,
        };
        vec![damped + at.literal.power_loss]
    }
}
