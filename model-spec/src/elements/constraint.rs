//! Bilateral constraints: equations between coordinates, or between velocities.

use crate::diagnostic::{Code, Diagnostic};
use crate::model::element::{Constraint, Contribution};
use crate::model::stage;
use crate::resolve::Resolver;
use crate::resolve::element::{Meaning, Resolved, Row};
use crate::resolve::value::{Limit, MemberId, is_linear, limit};
use crate::syntax::{Form, Section};

pub(super) const ROW: Row = Row {
    section: &SECTION,
    meaning: Meaning::Items(resolve),
};

const SECTION: Section = Section {
    word: "constraints",
    item: "a constraint",
    noun: "constraint",
    form: Form::Equations,
    help: "a constraint is `name: left = right`",
};

static CONSTRAINT: Limit = limit(
    stage::VELOCITY,
    "a constraint",
    "only coordinates, velocities, parameters and `t` are allowed here",
);

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let equation = resolver.equation(member)?;
    let scope = resolver.scope(member, &CONSTRAINT);
    let ([left, right], unit) = resolver.sides(&equation.left, &equation.right, scope)?;
    let expression = left - right;
    let span = equation.left.span.to(equation.right.span);
    let states =
        "constraints restrict coordinates and velocities; the rate of a state is given by `der(…)`";
    if resolver.refuse_states(expression, span, "a constraint", states) {
        return None;
    }
    if expression.stage() < stage::POSITION {
        let message = "this constrains no coordinate";
        resolver.error(Code::NoCoordinates, span, message);
    } else if expression.stage() == stage::VELOCITY && !is_linear(expression) {
        let message = "this constraint is not linear in the velocities";
        let diagnostic = Diagnostic::new(Code::NotLinear, span, message);
        let help = "a nonholonomic constraint is a sum of terms a(q, t)*der(q)";
        resolver.push(diagnostic.help(help));
    }
    Some(Resolved::of([Contribution::Constraint(Constraint {
        name: resolver.name(member),
        expression,
        unit,
        span: resolver.span(member),
    })]))
}
