//! Transmissions: gears and belts, which make one angle a multiple of another.
//!
//! ```text
//! φ₁ − φ_c = i (φ₂ − φ_c) + φ₀
//! ```
//!
//! where φ_c is the angle of the carrier of the wheels, if that moves. For gears with z₁ and z₂ teeth `i` is
//! −z₂/z₁, and an internal gear has a negative number of teeth (DIN 3960); for a belt over pulleys of radii r₁
//! and r₂ it is r₂/r₁, negative if the belt is crossed. The multiplier is the torque on the first wheel.

use lagrangian_symbolic::Expr;

use crate::diagnostic::{Code, Diagnostic};
use crate::model::element::{Constraint, Contribution};
use crate::model::{Space, stage};
use crate::resolve::Resolver;
use crate::resolve::element::{Meaning, Resolved, Row};
use crate::resolve::value::{Limit, MemberId, Scalar, Scope, Value, is_linear, limit};
use crate::source::Span;
use crate::syntax::{Expression, ExpressionKind, Form, Record, Section};
use crate::unit::Unit;

pub(super) const ROW: Row = Row {
    section: &SECTION,
    meaning: Meaning::Items(resolve),
};

const SECTION: Section = Section {
    word: "transmissions",
    item: "a transmission",
    noun: "transmission",
    form: Form::Records(&["turns", "ratio", "teeth", "belt", "carrier", "offset"]),
    help: "a transmission is `name { turns: (first, second), teeth: (z1, z2) }`, or with `belt: (r1, r2)` or \
           `ratio: …`, and where needed `carrier` and `offset`",
};

static TURN: Limit = limit(
    stage::VELOCITY,
    "a turn",
    "only coordinates, velocities, parameters and `t` are allowed here",
);

static RATIO: Limit = limit(
    stage::PARAMETER,
    "a ratio",
    "a ratio that changes is an equation between rates under `constraints`",
);

/// The sizes of the wheels: numbers of teeth, or radii.
const SIZES: [(&str, Unit, &str); 2] = [
    ("teeth", Unit::ONE, "a number of teeth has no unit"),
    ("belt", Unit::METRE, "the radius of a pulley is in m"),
];

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let record = resolver.record(member)?;
    let turns = resolver.field(member, record, "turns");
    let pair = turns.and_then(|turns| pair(resolver, turns, "two turns"));
    let pair = pair.and_then(|pair| {
        let [first, second] = pair.map(|turn| turn_of(resolver, member, turn, &TURN));
        Some([first?, second?])
    });
    let carrier = match record.get("carrier") {
        None => Some(None),
        Some(carrier) => turn_of(resolver, member, carrier, &TURN).map(Some),
    };
    let ([first, second], carrier) = (pair?, carrier?);
    let unit = first.unit.unwrap_or(Unit::ONE);
    let of_second = second.unit.unwrap_or(Unit::ONE);
    let span = turns?.span;
    let ratio = ratio(resolver, member, record, [unit, of_second])?;
    let (mut first, mut second) = (first.expr, second.expr);
    if let Some(carrier) = carrier {
        let field = record.get("carrier")?;
        let reason = "wheels and their carrier turn in the same unit";
        resolver.require_unit(
            Some(unit),
            carrier.unit.unwrap_or(Unit::ONE),
            field.span,
            reason,
        );
        resolver.require_unit(
            Some(of_second),
            carrier.unit.unwrap_or(Unit::ONE),
            field.span,
            reason,
        );
        (first, second) = (first - carrier.expr, second - carrier.expr);
    }
    let mut expression = first - ratio * second;
    let is_of_rates = expression.stage() == stage::VELOCITY;
    if let Some(offset) = record.field("offset") {
        if is_of_rates {
            let message = "rates have no offset";
            let diagnostic = Diagnostic::new(Code::ConflictingFields, offset.name.span, message);
            resolver.push(diagnostic.help("leave it out, or give angles"));
            return None;
        }
        let scope = resolver.scope(member, &RATIO);
        let reason = "an offset is in the unit of the first turn";
        let offset = resolver.scalar_in(&offset.value, unit, reason, scope)?;
        expression = expression - offset.expr;
    }
    check(resolver, expression, span)?;
    Some(Resolved::of([Contribution::Constraint(Constraint {
        name: resolver.name(member),
        expression,
        unit,
        span: resolver.span(member),
    })]))
}

/// Checks that the joined parts move, and that rates occur linearly.
fn check<'d>(resolver: &mut Resolver<'_, 'd, '_>, joined: Expr<'d>, span: Span) -> Option<()> {
    if joined.stage() < stage::POSITION {
        resolver.error(Code::NoCoordinates, span, "this constrains no coordinate");
        return None;
    }
    let help = "a transmission relates coordinates or their rates";
    if resolver.refuse_states(joined, span, "a transmission", help) {
        return None;
    }
    if joined.stage() == stage::VELOCITY && !is_linear(joined) {
        let message = "this is not linear in the velocities";
        let diagnostic = Diagnostic::new(Code::NotLinear, span, message);
        resolver.push(
            diagnostic.help("an angular velocity is `dot(frame.spin, axis)`, or `der(angle)`"),
        );
        return None;
    }
    Some(())
}

/// A pair of expressions in brackets.
fn pair<'a>(
    resolver: &mut Resolver<'a, '_, '_>,
    written: &'a Expression,
    noun: &str,
) -> Option<[&'a Expression; 2]> {
    match &written.kind {
        ExpressionKind::Error => None,
        ExpressionKind::Tuple(parts) if parts.len() == 2 => Some([&parts[0], &parts[1]]),
        _ => {
            let message = format!("{noun} are expected here, `(first, second)`");
            resolver.error(Code::WrongDimension, written.span, message);
            None
        }
    }
}

/// The angle of a wheel: that of a frame or a body in the plane, or any expression.
pub(super) fn turn_of<'a, 'd>(
    resolver: &mut Resolver<'a, 'd, '_>,
    member: MemberId,
    written: &'a Expression,
    limit: &'static Limit,
) -> Option<Scalar<'d>> {
    let scope: Scope<'a> = resolver.scope(member, limit);
    let value = match &written.kind {
        ExpressionKind::Name(_) | ExpressionKind::Chain(_) => resolver.value(written, scope),
        _ => return resolver.scalar(written, scope),
    };
    match value {
        Value::Unknown => None,
        Value::Scalar(scalar) => Some(scalar),
        Value::Frame(_) | Value::Body(_) if resolver.space == Space::Plane => {
            let place = resolver.oriented_place(member, written)?;
            Some(Scalar {
                expr: resolver.angle_of_place(place)?,
                unit: Some(Unit::RADIAN),
                number: None,
            })
        }
        Value::Frame(_) | Value::Body(_) => {
            let message = "in space one angle does not determine the orientation of a frame";
            let diagnostic = Diagnostic::new(Code::WrongSpace, written.span, message);
            let help = "give the angle itself, or the rate about an axis: `dot(wheel.spin, axis)`";
            resolver.push(diagnostic.help(help));
            None
        }
        other => {
            resolver.wrong_kind("a number", &other, written);
            None
        }
    }
}

/// The ratio, given directly, by teeth or by radii.
fn ratio<'a, 'd>(
    resolver: &mut Resolver<'a, 'd, '_>,
    member: MemberId,
    record: &'a Record,
    [first, second]: [Unit; 2],
) -> Option<Expr<'d>> {
    let scope = resolver.scope(member, &RATIO);
    if let Some(ratio) = record.get("ratio") {
        resolver.conflict(record, "teeth", "ratio");
        resolver.conflict(record, "belt", "ratio");
        let reason = "a ratio has the unit of the first turn over that of the second";
        let scalar = resolver.scalar_in(ratio, first.over(second), reason, scope)?;
        if scalar.expr.is_zero() {
            let message = "a ratio of 0 transmits nothing";
            resolver.error(Code::OutsideDomain, ratio.span, message);
            return None;
        }
        return Some(scalar.expr);
    }
    if record.get("teeth").is_some() {
        resolver.conflict(record, "belt", "teeth");
    }
    let found = SIZES
        .iter()
        .find_map(|size| Some((size, record.get(size.0)?)));
    let Some((&(field, unit, reason), written)) = found else {
        let base = resolver.base_name(member);
        let message =
            format!("a transmission needs `teeth`, `belt` or `ratio`, and `{base}` has none");
        resolver.missing_field(member, message);
        return None;
    };
    let why_angles = "both wheels turn by angles, in the same unit";
    resolver.require_unit(Some(second), first, record.get("turns")?.span, why_angles);
    let [z1, z2] = pair(resolver, written, "two of them")?.map(|part| {
        let scalar = resolver.scalar_in(part, unit, reason, scope)?;
        if scalar.expr.is_zero() {
            resolver.error(Code::DivisionByZero, part.span, "no wheel has a size of 0");
            return None;
        }
        Some(scalar.expr)
    });
    let ratio = z2? / z1?;
    Some(match field {
        "teeth" => -ratio,
        _ => ratio,
    })
}
