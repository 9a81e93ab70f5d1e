//! Bilateral constraints, as conditions on the accelerations.
//!
//! ```text
//! holonomic      g(q, t) = 0,   φ = Dg = G v + ∂g/∂t,   G = ∂g/∂q       (E29)
//! nonholonomic   φ = G(q, t) v + b(q, t) = 0,           G = ∂φ/∂v
//! both           G a = γ,   γ = −Dφ at a = 0                            (E30)
//!                M a = f + Gᵀ λ                                         (E31)
//! ```
//!
//! `D` is the total time derivative (E8), so explicit time is in `φ` and in `γ`. Circles that roll on each
//! other give one constraint of each kind: they touch, and the touching points have the same velocity.

use lagrangian_symbolic::{Expr, substitute};

use super::kinematics::{Variables, gradient};
use super::shorter::shorter;
use lagrangian_spec::identity;
use lagrangian_spec::model::circles::{self, RelativeMotion};
use lagrangian_spec::model::element::Rolling;
use lagrangian_spec::model::{Model, stage};
use lagrangian_spec::source::Span;
use lagrangian_spec::unit::Unit;

/// A bilateral constraint.
#[derive(Clone, Debug)]
pub struct ConstraintEquation<'d> {
    /// Its name; the two constraints of rolling circles are `wheel.gap` and `wheel.slip`.
    pub name: String,
    /// `g(q, t)`, of a holonomic one.
    pub position: Option<Expr<'d>>,
    /// `φ(q, v, t)`, which is `dg/dt` if it is holonomic; linear in `v`.
    pub rate: Expr<'d>,
    /// The row of `G(q, t)`.
    pub row: Vec<Expr<'d>>,
    /// `γ(q, v, t)`.
    pub bias: Expr<'d>,
    /// The symbol of its multiplier `λ`.
    pub multiplier: Expr<'d>,
    /// The unit of `g`, or of `φ` if there is no `g`.
    pub unit: Unit,
}

impl<'d> ConstraintEquation<'d> {
    /// This constraint in the coordinates of another model.
    pub(super) fn restated(
        &self,
        model: &Model<'d>,
        position: Option<Expr<'d>>,
        rate: Expr<'d>,
    ) -> ConstraintEquation<'d> {
        let statement = match position {
            Some(position) => Statement::Position(position),
            None => Statement::Rate(rate),
        };
        let x = Variables::of(model);
        equation(model, &x, self.name.clone(), statement, self.unit)
    }

    /// The unit of `φ`.
    pub fn rate_unit(&self) -> Unit {
        match self.position {
            Some(_) => self.unit.rate(),
            None => self.unit,
        }
    }

    /// The unit of its multiplier: that of a force along `g`.
    pub fn multiplier_unit(&self) -> Unit {
        let power = match self.position {
            Some(_) => Unit::JOULE,
            None => Unit::WATT,
        };
        power.over(self.unit)
    }
}

/// The constraints of a machine, beginning with those of the section `constraints`.
pub fn constraints<'d>(model: &Model<'d>) -> Vec<ConstraintEquation<'d>> {
    let x = Variables::of(model);
    let rates_of_constraints = model.constraints().into_iter().map(|constraint| {
        let mut expression = constraint.expression;
        let rates_in = |expression: Expr<'d>| {
            let rates = x.v.iter().copied().filter(|&v| expression.depends_on(v));
            rates.collect::<Vec<_>>()
        };
        let rates = rates_in(expression);
        if !rates.is_empty() {
            // Rates that cancel do not count, whatever the form of the expression.
            let gone = identity::irrelevant(model.dag, &[expression], rates);
            expression = identity::with_zeros_for(model.dag, vec![expression], &gone)[0];
        }
        let statement = if rates_in(expression).is_empty() {
            Statement::Position(expression)
        } else {
            Statement::Rate(expression)
        };
        let name = constraint.name.to_string();
        equation(model, &x, name, statement, constraint.unit)
    });
    let mut all: Vec<_> = rates_of_constraints.collect();
    for rolling in model.rolling() {
        all.extend(of_rolling(model, &x, rolling));
    }
    all
}

/// The span of each of the [`constraints`] in the spec.
pub(super) fn spans(model: &Model<'_>) -> Vec<Span> {
    let rolling = model.rolling();
    let rolling = rolling.iter().flat_map(|r| [r.span, r.span]);
    let constraints = model.constraints();
    constraints.iter().map(|c| c.span).chain(rolling).collect()
}

/// The rates `φ` of constraints at zero velocities: 0 except for rheonomic ones.
pub(super) fn rates_at_rest<'d>(
    model: &Model<'d>,
    constraints: &[ConstraintEquation<'d>],
) -> Vec<Expr<'d>> {
    let x = Variables::of(model);
    let at_rest: Vec<_> = x.v.iter().map(|&v| (v, model.dag.zero())).collect();
    let rates: Vec<_> = constraints.iter().map(|c| c.rate).collect();
    substitute(model.dag, &rates, &at_rest)
}

/// The residual of a constraint.
enum Statement<'d> {
    Position(Expr<'d>),
    Rate(Expr<'d>),
}

fn equation<'d>(
    model: &Model<'d>,
    x: &Variables<'d>,
    name: String,
    statement: Statement<'d>,
    unit: Unit,
) -> ConstraintEquation<'d> {
    let mut coasting = x.without_acceleration(model);
    let (position, rate) = match statement {
        Statement::Position(g) => (Some(g), coasting.of(g)),
        Statement::Rate(rate) => (None, rate),
    };
    let mut row = match position {
        Some(g) => gradient(model.dag, g, &x.q),
        None => gradient(model.dag, rate, &x.v),
    };
    identity::write_zeros(model.dag, &mut row);
    ConstraintEquation {
        position,
        rate,
        row,
        bias: -coasting.of(rate),
        multiplier: model
            .dag
            .symbol(&format!("lambda({name})"), stage::ACCELERATION),
        name,
        unit,
    }
}

/// Circles that touch and do not slip. A positive multiplier of `gap` opens it and is the force that
/// presses one circle on the other; the multiplier of `slip` is the friction on the first circle,
/// along the tangent that is the direction from the other's centre to it, turned left.
fn of_rolling<'d>(
    model: &Model<'d>,
    x: &Variables<'d>,
    rolling: &Rolling<'d>,
) -> [ConstraintEquation<'d>; 2] {
    let RelativeMotion { gap, slip } =
        circles::contact_motion(model, &rolling.circles, &mut x.without_acceleration(model));
    let part = |part: &str| format!("{}.{part}", rolling.name);
    let [gap, slip] = [gap, slip].map(|e| shorter(model, (e, gap)));
    let gap = Statement::Position(gap);
    let slip = Statement::Rate(slip);
    [
        equation(model, x, part("gap"), gap, Unit::METRE),
        equation(model, x, part("slip"), slip, Unit::METRE.rate()),
    ]
}
