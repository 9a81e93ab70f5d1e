//! Ropes: of a given length, from point to point over pulleys whose size does not matter.
//!
//! ```text
//! |p₂ − p₁| + |p₃ − p₂| + … = length
//! ```
//!
//! The length may change, as on a winch. The rope pulls with the multiplier, reversed; it is taken to be
//! tight throughout.

use lagrangian_symbolic::Expr;

use crate::diagnostic::{Code, Diagnostic};
use crate::model::element::{Constraint, Contribution};
use crate::model::stage;
use crate::resolve::Resolver;
use crate::resolve::element::{Meaning, Resolved, Row};
use crate::resolve::motion::to_point;
use crate::resolve::value::{Limit, MemberId, limit};
use crate::syntax::{ExpressionKind, Form, Section};
use crate::unit::Unit;

pub(super) const ROW: Row = Row {
    section: &SECTION,
    meaning: Meaning::Items(resolve),
};

const SECTION: Section = Section {
    word: "ropes",
    item: "a rope",
    noun: "rope",
    form: Form::Records(&["path", "length"]),
    help: "a rope is `name { path: (point, point, …), length: … }`",
};

static LENGTH: Limit = limit(
    stage::POSITION,
    "the length of a rope",
    "only coordinates, parameters and `t` can stand here",
);

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let record = resolver.record(member)?;
    let path = resolver.field(member, record, "path");
    let length = resolver.field(member, record, "length");
    let scope = resolver.scope(member, &LENGTH);
    let length =
        length.and_then(|said| resolver.scalar_in(said, Unit::METRE, "a length is in m", scope));
    let path = path?;
    let points = match &path.kind {
        ExpressionKind::Error => return None,
        ExpressionKind::Tuple(points) if points.len() > 1 => points,
        _ => {
            let message = "a rope goes from point to point, `(a.at, pulley, b.at)`";
            resolver.error(Code::WrongDimension, path.span, message);
            return None;
        }
    };
    let points: Vec<_> = points
        .iter()
        .map(|point| resolver.point(member, point))
        .collect();
    let points: Vec<Vec<Expr<'d>>> = points.into_iter().collect::<Option<_>>()?;
    let parts = points.windows(2).map(|ends| {
        let line = to_point(&ends[0], &ends[1]);
        resolver.distance(&line)
    });
    let parts: Vec<Expr<'d>> = parts.collect();
    let taken = resolver.dag.sum(parts);
    let expression = taken - length?.expr;
    if expression.stage() < stage::POSITION {
        let message = "this rope holds nothing: no point of its path moves";
        let diagnostic = Diagnostic::new(Code::NoCoordinates, path.span, message);
        resolver.push(diagnostic.help("an end of it is a point of a body, as `load.at`"));
        return None;
    }
    Some(Resolved::of([Contribution::Constraint(Constraint {
        name: resolver.name(member),
        expression,
        unit: Unit::METRE,
        span: resolver.span(member),
    })]))
}
