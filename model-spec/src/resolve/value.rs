//! The values that expressions of a spec can have, and the requirements of the places where they stand.

use lagrangian_symbolic::{Expr, Stage};

use crate::diagnostic::Code;
use crate::model::{PoseId, Space, stage};
use crate::unit::Unit;

/// The value of an expression.
#[derive(Clone, Debug)]
pub(crate) enum Value<'d> {
    /// Unknown: an error was reported, or something that it needs is not yet resolved.
    Unknown,
    /// A number.
    Scalar(Scalar<'d>),
    /// A vector, or a point: the vector from the ground's origin.
    Vector(Vector<'d>),
    /// A frame of reference.
    Frame(PoseId),
    /// A body, by its member.
    Body(MemberId),
}

/// The index of a member in the resolver's list.
pub(crate) type MemberId = usize;

/// A number with its unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scalar<'d> {
    pub expr: Expr<'d>,
    /// `None` for an expression of bare numbers: it takes any unit in a sum, and is dimensionless
    /// as a factor.
    pub unit: Option<Unit>,
    /// Its approximate value, if known already; only for checks.
    pub number: Option<f64>,
}

/// A vector in ground axes with its unit.
#[derive(Clone, Debug)]
pub(crate) struct Vector<'d> {
    pub components: Vec<Expr<'d>>,
    /// `None` for an expression of bare numbers.
    pub unit: Option<Unit>,
    /// For a point that is given in a frame: the frame, and the point in its axes.
    pub local: Option<(PoseId, Vec<Expr<'d>>)>,
}

impl<'d> Value<'d> {
    pub fn is_unknown(&self) -> bool {
        matches!(self, Value::Unknown)
    }

    /// The word for it in messages.
    pub fn kind(&self) -> &'static str {
        match self {
            Value::Unknown => "nothing", // never shown: unknown values have been reported
            Value::Scalar(_) => "a number",
            Value::Vector(_) => "a vector",
            Value::Frame(_) => "a frame",
            Value::Body(_) => "a body",
        }
    }

    /// Its stage.
    pub fn stage(&self) -> Stage {
        match self {
            Value::Scalar(scalar) => scalar.expr.stage(),
            Value::Vector(vector) => vector.stage(),
            Value::Unknown | Value::Frame(_) | Value::Body(_) => stage::CONSTANT,
        }
    }
}

impl<'d> Vector<'d> {
    /// A vector that is given in ground axes only.
    pub fn new(components: Vec<Expr<'d>>, unit: Option<Unit>) -> Vector<'d> {
        Vector {
            components,
            unit,
            local: None,
        }
    }

    /// Its stage.
    pub fn stage(&self) -> Stage {
        let stages = self.components.iter().map(|component| component.stage());
        stages.max().unwrap_or(stage::CONSTANT)
    }
}

/// The context of an expression.
#[derive(Clone, Copy)]
pub(crate) struct Scope<'a> {
    /// The index of the family that is being unrolled.
    pub index: Option<(&'a str, i64)>,
    /// The limit of dependencies.
    pub limit: &'static Limit,
    /// The unit that the place requires, to decide which of two terms is wrong.
    pub expected_unit: Option<Unit>,
}

impl Scope<'_> {
    /// This scope with another limit.
    pub fn with_limit(self, limit: &'static Limit) -> Self {
        Scope {
            limit,
            expected_unit: None,
            ..self
        }
    }

    /// This scope with a required unit.
    pub fn with_expected_unit(self, hint: impl Into<Option<Unit>>) -> Self {
        let hint = hint.into();
        Scope {
            expected_unit: hint,
            ..self
        }
    }
}

/// The dependencies that are allowed in a place.
pub(crate) struct Limit {
    /// The latest stage.
    pub stage: Stage,
    /// The subject of the place, at the beginning of a sentence.
    pub subject: &'static str,
    /// The code of a violation.
    pub code: Code,
    /// Why it is forbidden, or what to do instead.
    pub help: &'static str,
}

/// A limit that allows nothing later than a stage.
pub(crate) const fn limit(stage: Stage, noun: &'static str, help: &'static str) -> Limit {
    let code = Code::ForbiddenDependence;
    Limit {
        stage,
        subject: noun,
        code,
        help,
    }
}

const fn constant_mass(noun: &'static str) -> Limit {
    Limit {
        stage: stage::PARAMETER,
        subject: noun,
        code: Code::VariableMass,
        help: "the equations hold for bodies of constant mass and inertia; what flows in or out \
               would carry momentum that they do not include",
    }
}

/// The help for places where only positions are allowed.
pub(crate) const POSITIONS: &str = "only coordinates, parameters and `t` are allowed here";

/// The limits of places in several sections, and of everything that is not an element.
pub(crate) mod limits {
    use super::{Limit, POSITIONS, constant_mass, limit, stage};

    const FOLDED: &str = "it is a number that is known when the machine is derived";

    pub static INDEX: Limit = limit(stage::CONSTANT, "an index", FOLDED);
    pub static CONSTANT: Limit = limit(stage::CONSTANT, "a constant", FOLDED);
    pub static DEFAULT: Limit = limit(stage::CONSTANT, "a default", FOLDED);
    pub static DERIVED: Limit = limit(
        stage::PARAMETER,
        "a derived parameter",
        "it is computed once, from parameters and constants",
    );
    pub static START: Limit = limit(
        stage::PARAMETER,
        "a start value",
        "it is computed once, from parameters and constants",
    );
    pub static START_RATE: Limit = limit(
        stage::PARAMETER,
        "a rate at the start",
        "it is computed once, from parameters and constants",
    );
    pub static DESTINATION: Limit = limit(
        stage::PARAMETER,
        "the end of the fastest motion",
        "it is computed once, from parameters and constants",
    );
    pub static DEFINITION: Limit = limit(stage::ACCELERATION, "a definition", "");
    pub static ASSUMPTION: Limit = limit(
        stage::VELOCITY,
        "an assumption",
        "it concerns the state of the machine: coordinates, velocities, parameters and `t`",
    );
    pub static FRAME: Limit = limit(stage::POSITION, "the pose of a frame", POSITIONS);
    pub static POSITION: Limit = limit(stage::POSITION, "the position of a body", POSITIONS);
    pub static ROTATION: Limit = limit(stage::POSITION, "the angle of a body", POSITIONS);
    pub static POINT: Limit = limit(stage::POSITION, "a point", POSITIONS);
    pub static MASS: Limit = constant_mass("a mass");
    pub static INERTIA: Limit = constant_mass("an inertia");
    pub static FRICTION: Limit = limit(
        stage::VELOCITY,
        "a coefficient of friction",
        "only velocities, coordinates, parameters and `t` are allowed here",
    );
    pub static RESTITUTION: Limit = limit(
        stage::PARAMETER,
        "a coefficient of restitution",
        "only parameters are allowed here",
    );
    pub static COMPLIANCE: Limit = limit(
        stage::PARAMETER,
        "a force law",
        "only parameters are allowed here",
    );
    pub static RADIUS: Limit = limit(
        stage::TIME,
        "a circle",
        "its shape on its body must not change",
    );
    pub static OUTLINE: Limit = limit(
        stage::PARAMETER,
        "an outline",
        "its shape on its body must not change",
    );
    pub static GAP: Limit = limit(stage::POSITION, "a gap", POSITIONS);
    pub static SLIP: Limit = limit(
        stage::VELOCITY,
        "a slip",
        "only velocities, coordinates, parameters and `t` are allowed here",
    );
    pub static OUTPUT: Limit = limit(stage::ACCELERATION, "an output", "");
    pub static PUBLISHED: Limit = limit(stage::ACCELERATION, "a published formula", "");
}

/// The dependency that gives a value its stage.
pub(crate) fn dependence(stage: Stage) -> &'static str {
    match stage {
        stage::CONSTANT => "constants",
        stage::PARAMETER => "parameters",
        stage::TIME => "time",
        stage::POSITION => "coordinates",
        stage::VELOCITY => "velocities",
        stage::INPUT => "inputs",
        _ => "accelerations",
    }
}

/// The number of components in the words of a message.
pub(crate) fn dimension_text(space: Space) -> &'static str {
    match space {
        Space::Plane => "two components in the plane",
        Space::Space => "three components in space",
    }
}

/// Whether an expression is linear in the velocities: no derivative with respect to a velocity
/// depends on a velocity.
pub(crate) fn is_linear(expression: Expr<'_>) -> bool {
    let dag = expression.dag();
    let symbols = expression.symbols().into_iter();
    let mut rates = symbols.filter(|&symbol| dag.stage_of(symbol) == stage::VELOCITY);
    rates.all(|symbol| expression.diff(symbol).stage() < stage::VELOCITY)
}
