//! Derivatives of the accelerations, by the implicit function theorem.
//!
//! The accelerations are the root of `r(a, x) = f − M a`, where `x` is any other variable of the
//! equations: a coordinate, a rate, an input, a parameter. Differentiating `r(a(x), x) = 0` gives
//!
//! ```text
//! M ∂a/∂x = ∂r/∂x        (E26), on the right with a held at its value
//! ```
//!
//! With constraints the multipliers are unknowns too, and `r` continues with `γ − G a`. So no
//! acceleration is ever differentiated: each column takes one forward sweep over `r`, which is
//! linear in the number of links, and one more right-hand side in the elimination that the
//! accelerations take anyway.

use lagrangian_symbolic::{Expr, Symbol, Tangent};

use super::constraints::ConstraintEquation;
use super::symmetric::Symmetric;
use lagrangian_spec::model::{Model, Variable};

/// The residual of the equations of a machine with constraints: `f − M a + Gᵀ λ`, followed by
/// `γ − G a`.
pub(super) fn constrained_residual<'d>(
    model: &Model<'d>,
    unbalanced: &[Expr<'d>],
    constraints: &[ConstraintEquation<'d>],
) -> Vec<Expr<'d>> {
    let dag = model.dag;
    let held = unbalanced.iter().enumerate().map(|(i, &left)| {
        let reactions = constraints.iter().map(|c| c.row[i] * c.multiplier);
        dag.sum([left].into_iter().chain(reactions))
    });
    let kept = constraints.iter().map(|c| {
        let along = model.coordinates.iter().zip(&c.row);
        let along = along.map(|(coordinate, &g)| -(g * coordinate.a));
        dag.sum([c.bias].into_iter().chain(along))
    });
    held.chain(kept).collect()
}

/// `f − M a`, eq. (E25), if there is no projection that gives it directly.
pub(super) fn residual<'d>(
    model: &Model<'d>,
    mass_matrix: &Symmetric<Expr<'d>>,
    forces: &[Expr<'d>],
) -> Vec<Expr<'d>> {
    let row = |(i, &force): (usize, &Expr<'d>)| {
        let a = model.coordinates.iter().map(|coordinate| coordinate.a);
        let inertia = a
            .enumerate()
            .map(|(j, a_j)| -(*mass_matrix.get(i, j) * a_j));
        model.dag.sum(std::iter::once(force).chain(inertia))
    };
    forces.iter().enumerate().map(row).collect()
}

/// The right-hand sides of (E26), one column for each of [`Model::derivatives`]; nothing if they
/// become too large.
pub(super) fn residual_derivatives<'d>(
    model: &Model<'d>,
    unbalanced: &[Expr<'d>],
) -> Option<Vec<Vec<Expr<'d>>>> {
    let mut columns = Vec::with_capacity(model.derivatives.len());
    for &variable in &model.derivatives {
        if model.dag.is_exhausted() {
            return None;
        }
        let direction = symbol(model, variable).map(|symbol| (symbol, model.dag.one()));
        let mut slope = Tangent::new(model.dag, direction.as_slice());
        columns.push(unbalanced.iter().map(|&r_i| slope.of(r_i)).collect());
    }
    Some(columns)
}

/// The symbol of a variable.
fn symbol(model: &Model<'_>, variable: Variable) -> Option<Symbol> {
    let expression = match variable {
        Variable::Coordinate(i) => model.coordinates.get(i)?.q,
        Variable::Rate(i) => model.coordinates.get(i)?.v,
        Variable::Input(i) => model.inputs.get(i)?.symbol,
        Variable::Parameter(i) => model.parameters.get(i)?.symbol,
    };
    expression.as_symbol()
}
