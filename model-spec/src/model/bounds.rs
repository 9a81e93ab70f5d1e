//! Bounds on the numbers of a machine: masses are positive, friction does not drive.
//!
//! A spec is checked against them when it is read, with the defaults of its parameters; a command
//! checks the values that it is given. Both give the same messages.

use lagrangian_symbolic::{Dag, Expr, Symbol, evaluate};

use super::{Assumption, Model, stage, tensor};
use crate::diagnostic::{Code, Diagnostic};
use crate::identity;
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
    /// The moment Ixx of a tensor of inertia, whose entries Iyy, Izz, Ixy, Ixz and Iyz follow: none of its principal moments exceeds
    /// the sum of the other two, unless the spec allows it.
    Tensor([Expr<'d>; 5]),
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
    /// The range between the bounds of a stop, which is not negative.
    StopRange,
    /// A stiffness, which may be negative if the spec allows it.
    Stiffness,
    /// A damping coefficient, which may be negative if the spec allows it.
    Damping,
    /// A factor of a drag, which is not negative.
    Drag,
    /// A parameter that follows from others, which is finite if these are known.
    Derived,
}

impl<'d> BoundKind<'d> {
    /// Whether a machine may violate it, if its spec says so.
    pub(crate) fn may_be_intentional(self) -> bool {
        matches!(
            self,
            BoundKind::Stiffness | BoundKind::Damping | BoundKind::Tensor(_)
        )
    }

    /// The help text for a violation that may be intended.
    pub(crate) fn intentional_help(self) -> &'static str {
        match self {
            BoundKind::Tensor(_) => {
                "if this is intended, name the moments and declare it: `assume { C > A + B }`"
            }
            _ => "if this is intended, name the coefficient and declare it: `assume { c < 0 }`",
        }
    }

    /// Other numbers on which the bound depends.
    fn others(&self) -> &[Expr<'d>] {
        match self {
            BoundKind::StaticFriction(other) | BoundKind::Unloading(other) => {
                std::slice::from_ref(other)
            }
            BoundKind::Tensor(others) => others,
            _ => &[],
        }
    }

    /// The error in a value, which the other numbers follow; none if they are unknown, which is NaN.
    fn violation(self, numbers: &[f64]) -> Option<(Code, String)> {
        let value = *numbers.first()?;
        if let BoundKind::Tensor(_) = self {
            let message = tensor::flaw(numbers.try_into().ok()?)?;
            return Some((Code::ImpossibleInertia, message));
        }
        let (demand, code) = self.rule();
        let words = self.words();
        let below = match demand {
            Demand::NotBelowOther => format!(" below {}", numbers.get(1)?),
            _ => String::new(),
        };
        let is_wrong = demand.is_violated(value, numbers.get(1).copied());
        is_wrong.then(|| match self {
            BoundKind::Convex => (code, words.to_owned()),
            _ => (code, format!("{words}, found {value}{below}")),
        })
    }

    /// What the number must be, and the error if it is not.
    fn rule(self) -> (Demand, Code) {
        use Code::{ImpossibleInertia, NegativeCoefficient, NotPositive, OutsideDomain};
        use Demand::{Finite, NotBelowOther, NotNegative, Positive, UpToOne};
        match self {
            BoundKind::Tensor(_) => (Finite, ImpossibleInertia),
            BoundKind::Convex => (Positive, OutsideDomain),
            BoundKind::Mass => (Positive, NotPositive),
            BoundKind::Moment => (NotNegative, NotPositive),
            BoundKind::Radius => (Positive, NotPositive),
            BoundKind::Friction => (NotNegative, NotPositive),
            BoundKind::RollingResistance => (NotNegative, NotPositive),
            BoundKind::StaticFriction(_) => (NotBelowOther, OutsideDomain),
            BoundKind::Restitution => (UpToOne, OutsideDomain),
            BoundKind::ContactStiffness => (Positive, NotPositive),
            BoundKind::ContactDamping => (NotNegative, NotPositive),
            BoundKind::Unloading(_) => (NotBelowOther, OutsideDomain),
            BoundKind::StopRange => (NotNegative, OutsideDomain),
            BoundKind::Stiffness => (NotNegative, NegativeCoefficient),
            BoundKind::Drag => (NotNegative, NotPositive),
            BoundKind::Derived => (Finite, OutsideDomain),
            BoundKind::Damping => (NotNegative, NegativeCoefficient),
        }
    }

    /// The rule as a sentence.
    fn words(self) -> &'static str {
        match self {
            BoundKind::Tensor(_) => "a moment of inertia must be a finite number",
            BoundKind::Convex => {
                "these are not the corners of a convex polygon, listed counterclockwise, so that it lies to the left of every face"
            }
            BoundKind::Mass => "a mass must be positive",
            BoundKind::Moment => "a moment of inertia must not be negative",
            BoundKind::Radius => "a radius must be positive",
            BoundKind::Friction => "a coefficient of friction must not be negative",
            BoundKind::RollingResistance => {
                "a coefficient of rolling resistance must not be negative"
            }
            BoundKind::StaticFriction(_) => {
                "the coefficient of static friction must not be less than that of sliding friction"
            }
            BoundKind::Restitution => "a coefficient of restitution must lie between 0 and 1",
            BoundKind::ContactStiffness => "the stiffness of a contact must be positive",
            BoundKind::ContactDamping => "the damping of a contact must not be negative",
            BoundKind::Unloading(_) => {
                "the unloading stiffness of a layer must not be less than its loading stiffness"
            }
            BoundKind::StopRange => {
                "a stop acts below `below` and above `above`, so that `above` less `below` must not be negative"
            }
            BoundKind::Stiffness => {
                "a spring with negative stiffness pushes away from its rest position"
            }
            BoundKind::Drag => {
                "drag opposes motion: its coefficient, area and density must not be negative"
            }
            BoundKind::Derived => "a derived parameter must be a finite number",
            BoundKind::Damping => "a damper with negative damping adds energy",
        }
    }
}

/// What a number must be. NaN, which is unknown, violates nothing but the demand of a finite number or of one up to 1.
enum Demand {
    Positive,
    NotNegative,
    UpToOne,
    Finite,
    NotBelowOther,
}

impl Demand {
    fn is_violated(&self, value: f64, other: Option<f64>) -> bool {
        match self {
            Demand::Positive => value <= 0.0,
            Demand::NotNegative => value < 0.0,
            Demand::UpToOne => !(0.0..=1.0).contains(&value),
            Demand::Finite => !value.is_finite(),
            Demand::NotBelowOther => other.is_some_and(|other| value < other),
        }
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
    let of_each = |bound: &Bound<'_>| 1 + bound.kind.others().len();
    let ids = bounds.iter().flat_map(|bound| {
        let others = bound.kind.others().iter();
        std::iter::once(bound.value.id()).chain(others.map(|other| other.id()))
    });
    let values: Vec<Expr<'_>> = ids.map(|id| dag.expr(id)).collect();
    let numbers = evaluate(dag, &values, value);
    let mut rest = &numbers[..];
    let mut found = Vec::new();
    for (place, bound) in bounds.iter().enumerate() {
        let (numbers, further) = rest.split_at(of_each(bound));
        rest = further;
        let vanishes = matches!(bound.kind, BoundKind::Mass) && numbers[0] == 0.0;
        if unknown[place] || (vanishes && bound.value.stage() > stage::CONSTANT) {
            continue;
        }
        let violation = bound.kind.violation(numbers);
        found.extend(violation.map(|(code, message)| (place, code, message)));
    }
    found
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
                let Bound { kind, span, .. } = self.bounds[place];
                let diagnostic = Diagnostic::new(code, span, message);
                if kind.may_be_intentional() {
                    diagnostic.help(kind.intentional_help())
                } else {
                    diagnostic
                }
            })
            .collect()
    }
}

impl<'d> Bound<'d> {
    /// Whether the spec assumes that it is violated.
    pub(crate) fn is_intentional(&self, assumptions: &[Assumption<'d>]) -> bool {
        let mut facts = assumptions.iter().map(|fact| fact.excess);
        let a = self.value;
        match self.kind {
            BoundKind::Tensor([b, c, ..]) => facts.any(|fact| {
                let mut excesses = [a - (b + c), b - (a + c), c - (a + b)].into_iter();
                fact.stage() <= stage::PARAMETER
                    && excesses.any(|excess| identity::equal(fact, excess) == Some(true))
            }),
            kind => kind.may_be_intentional() && facts.any(|fact| fact == -a),
        }
    }

    /// Whether it depends on parameters alone.
    pub(crate) fn is_of_parameters(&self) -> bool {
        let others = self.kind.others().iter();
        let stages = others.map(|other| other.stage());
        stages.fold(self.value.stage(), Ord::max) <= stage::PARAMETER
    }
}
