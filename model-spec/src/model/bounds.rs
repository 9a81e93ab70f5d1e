//! Bounds on the numbers of a machine: masses are positive, friction does not drive.
//!
//! A spec is checked against them when it is read, with the defaults of its parameters; a command
//! checks the values that it is given. Both give the same messages.

use lagrangian_symbolic::{Dag, Expr, Symbol, evaluate};

use super::{Model, stage};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;

/// A number of the machine with the bound that it must obey.
#[derive(Clone, Debug)]
pub struct Bound<'d> {
    /// The kind of the number.
    pub kind: BoundKind<'d>,
    /// Its value, of parameters alone.
    pub value: Expr<'d>,
    /// Its place in the spec.
    pub span: Span,
}

/// The kind of a bounded number.
#[derive(Clone, Copy, Debug)]
pub enum BoundKind<'d> {
    /// A mass, which is positive; one that depends on parameters may vanish, for a part that a variant lacks.
    Mass,
    /// A moment of inertia, which is not negative.
    Moment,
    /// A radius, which is positive.
    Radius,
    /// The distance of a corner of a polygon to the left of a face that it is not on, times the length of that face: positive
    /// if the polygon is convex and its corners are in counterclockwise order.
    Convex,
    /// A coefficient of friction, which is not negative.
    Friction,
    /// A coefficient of rolling resistance, which is not negative.
    RollingResistance,
    /// A coefficient of static friction, which is not below that of friction.
    StaticFriction(Expr<'d>),
    /// A coefficient of restitution, which is between 0 and 1.
    Restitution,
    /// The stiffness of a compliant contact, which is positive.
    ContactStiffness,
    /// The damping of a compliant contact, which is not negative.
    ContactDamping,
    /// The unloading stiffness of a layer, which is not below its loading stiffness.
    Unloading(Expr<'d>),
    /// A stiffness, which may be negative if the spec allows it.
    Stiffness,
    /// A damping coefficient, which may be negative if the spec allows it.
    Damping,
    /// A factor of a drag, which is not negative.
    Drag,
    /// A parameter that follows from others, which is finite if these are known.
    Derived,
}

impl BoundKind<'_> {
    /// Whether a machine may violate it, if its spec says so.
    pub(crate) fn may_be_intentional(self) -> bool {
        matches!(self, BoundKind::Stiffness | BoundKind::Damping)
    }

    /// The error in a value; none if the value is unknown, which is NaN.
    fn violation(self, value: f64, other: f64) -> Option<(Code, String)> {
        let (is_wrong, code, words) = match self {
            BoundKind::Mass => (value <= 0.0, Code::NotPositive, "a mass must be positive"),
            BoundKind::Moment => (
                value < 0.0,
                Code::NotPositive,
                "a moment of inertia must not be negative",
            ),
            BoundKind::Radius => (value <= 0.0, Code::NotPositive, "a radius must be positive"),
            BoundKind::Convex => {
                let message = "these are not the corners of a convex polygon, listed counterclockwise, so that it lies to the left of every face";
                return (value <= 0.0).then(|| (Code::OutsideDomain, message.to_owned()));
            }
            BoundKind::Friction => (
                value < 0.0,
                Code::NotPositive,
                "a coefficient of friction must not be negative",
            ),
            BoundKind::RollingResistance => (
                value < 0.0,
                Code::NotPositive,
                "a coefficient of rolling resistance must not be negative",
            ),
            BoundKind::StaticFriction(_) => {
                let words = "the coefficient of static friction must not be less than that of sliding friction";
                let message = format!("{words}, found {value} below {other}");
                return (value < other).then_some((Code::OutsideDomain, message));
            }
            BoundKind::Restitution => (
                !(0.0..=1.0).contains(&value),
                Code::OutsideDomain,
                "a coefficient of restitution must lie between 0 and 1",
            ),
            BoundKind::ContactStiffness => (
                value <= 0.0,
                Code::NotPositive,
                "the stiffness of a contact must be positive",
            ),
            BoundKind::ContactDamping => (
                value < 0.0,
                Code::NotPositive,
                "the damping of a contact must not be negative",
            ),
            BoundKind::Unloading(_) => {
                let words = "the unloading stiffness of a layer must not be less than its loading stiffness";
                let message = format!("{words}, found {value} below {other}");
                return (value < other).then_some((Code::OutsideDomain, message));
            }
            BoundKind::Stiffness => (
                value < 0.0,
                Code::NegativeCoefficient,
                "a spring with negative stiffness pushes away from its rest position",
            ),
            BoundKind::Drag => (
                value < 0.0,
                Code::NotPositive,
                "drag opposes motion: its coefficient, area and density must not be negative",
            ),
            BoundKind::Derived => (
                !value.is_finite(),
                Code::OutsideDomain,
                "a derived parameter must be a finite number",
            ),
            BoundKind::Damping => (
                value < 0.0,
                Code::NegativeCoefficient,
                "a damper with negative damping adds energy",
            ),
        };
        is_wrong.then(|| (code, format!("{words}, found {value}")))
    }
}

/// The violated bounds, by index, with a message for each.
pub(crate) fn violations(
    dag: &Dag,
    bounds: &[Bound<'_>],
    mut value: impl FnMut(Symbol) -> f64,
) -> Vec<(usize, Code, String)> {
    let is_unknown = |bound: &Bound<'_>, value: &mut dyn FnMut(Symbol) -> f64| {
        let mut symbols = bound.value.symbols().into_iter();
        matches!(bound.kind, BoundKind::Derived) && symbols.any(|symbol| value(symbol).is_nan())
    };
    let unknown: Vec<bool> = bounds
        .iter()
        .map(|bound| is_unknown(bound, &mut value))
        .collect();
    let other = |bound: &Bound<'_>| match bound.kind {
        BoundKind::StaticFriction(other) | BoundKind::Unloading(other) => other.id(),
        _ => bound.value.id(),
    };
    let pairs = bounds
        .iter()
        .flat_map(|bound| [bound.value.id(), other(bound)]);
    let values: Vec<Expr<'_>> = pairs.map(|id| dag.expr(id)).collect();
    let numbers = evaluate(dag, &values, value);
    let all = bounds.iter().zip(numbers.chunks(2)).enumerate();
    all.filter_map(|(place, (bound, pair))| {
        let vanishes = matches!(bound.kind, BoundKind::Mass) && pair[0] == 0.0;
        if unknown[place] || (vanishes && bound.value.stage() > stage::CONSTANT) {
            return None;
        }
        let (code, message) = bound.kind.violation(pair[0], pair[1])?;
        Some((place, code, message))
    })
    .collect()
}

impl<'d> Model<'d> {
    /// The errors and warnings for given parameters: errors as for a spec with these values as
    /// defaults. The values are in the order of [`Model::parameters`], in the units declared there;
    /// NaN if unknown.
    pub fn parameter_diagnostics(&self, parameters: &[f64]) -> Vec<Diagnostic> {
        let value = |symbol| {
            let mut known = self.parameters.iter().zip(parameters);
            let found = known.find(|(parameter, _)| parameter.symbol.as_symbol() == Some(symbol));
            found.map_or(f64::NAN, |(_, value)| *value)
        };
        let found = violations(self.dag, &self.bounds, value).into_iter();
        found
            .map(|(place, code, message)| {
                let diagnostic = Diagnostic::new(code, self.bounds[place].span, message);
                if self.bounds[place].kind.may_be_intentional() {
                    diagnostic.help(INTENTIONAL_HELP)
                } else {
                    diagnostic
                }
            })
            .collect()
    }
}

/// The help text for a negative coefficient that is intended.
pub(crate) const INTENTIONAL_HELP: &str =
    "if this is intended, name the coefficient and declare it: `assume { c < 0 }`";

impl Bound<'_> {
    /// Whether it depends on parameters alone.
    pub(crate) fn is_of_parameters(&self) -> bool {
        let other = match self.kind {
            BoundKind::StaticFriction(friction) => friction.stage(),
            _ => stage::CONSTANT,
        };
        self.value.stage().max(other) <= stage::PARAMETER
    }
}
