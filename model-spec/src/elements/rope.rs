//! Ropes of a given length, from point to point and over pulleys.
//!
//! ```text
//! |p₂ − p₁| + |p₃ − p₂| + … = length
//! ```
//!
//! The length may vary, as on a winch. The rope pulls with the negative multiplier; it is assumed to be
//! tight at all times.
//!
//! Pulleys in the plane may have radii: s, positive where the rope turns left around the pulley and negative where it
//! turns right. The part from one pulley to the next, with D from centre to centre and h = s' − s, is straight along e,
//!
//! ```text
//! ℓ = √(D² − h²),    e = (ℓ D − h D⊥)/D²,    D⊥ = (−D_y, D_x),
//! ```
//!
//! since the centres are at distances s n and s' n from the rope, where n is e turned left: D = ℓ e + h n. The arc on
//! a pulley is |s| w, where w is the turn from the preceding part to the following one,
//!
//! ```text
//! w = 3π/4 + atan2(−(s e × e' + |s| e · e'), s e × e' − |s| e · e'),    −π/4 < w < 7π/4.
//! ```
//!
//! The rope is assumed to wrap around the pulley, 0 < w < 3π/2. The arc has its jump as far as possible from both bounds, so
//! that a run which leaves them finds where, instead of a jump.
//!
//! As D·n = h is constant, n·Ḋ = ℓ ψ̇ with ψ the direction of e, and the rate of ℓ is e·Ḋ + h ψ̇. In the sum with the rates of
//! the arcs, s (ψ̇' − ψ̇), all ψ̇ cancel: the rope grows by Σ e·Ḋ. If it does not slip on a pulley that is turned by θ, the rope
//! that arrives goes around with the pulley:
//!
//! ```text
//! Σ e·Ḋ of the parts before + s θ̇ = 0,
//! ```
//!
//! and an end that is wound on a drum adds −s θ̇ at the first point, +s θ̇ at the last to both sums. So the condition of no slip
//! is an equation between rates, and so is the rope if an end is wound up: the length on the drum is determined by the start.

use lagrangian_symbolic::Expr;

use crate::diagnostic::{Code, Diagnostic};
use crate::model::element::{Constraint, Contribution};
use crate::model::{Assumption, Name, Space, stage};
use crate::resolve::Resolver;
use crate::resolve::element::{Meaning, Resolved, Row};
use crate::resolve::motion::vector_between;
use crate::resolve::value::{Limit, MemberId, POSITIONS, limit};
use crate::source::Span;
use crate::syntax::{Expression, ExpressionKind, Form, Record, Section};
use crate::unit::Unit;

use super::transmission::turn_of;

pub(super) const ROW: Row = Row {
    section: &SECTION,
    meaning: Meaning::Items(resolve),
};

const SECTION: Section = Section {
    word: "ropes",
    item: "a rope",
    noun: "rope",
    form: Form::Records(&["path", "length", "radii", "turns"]),
    help: "a rope is `name { path: (point, point, …), length: … }`, and where needed `radii: (0, r, …)` and `turns: (0, angle, …)`",
};

static LENGTH: Limit = limit(
    stage::POSITION,
    "the length of a rope",
    "only coordinates, parameters and `t` are allowed here",
);

static RADIUS: Limit = limit(
    stage::PARAMETER,
    "the radius of a pulley",
    "only parameters are allowed here",
);

static TURN: Limit = limit(stage::POSITION, "the turn of a pulley", POSITIONS);

/// A point of the path: its position and, for a pulley, its radius and its angle.
struct PathPoint<'d> {
    position: Vec<Expr<'d>>,
    /// Signed; 0 for a point.
    radius: Expr<'d>,
    turn: Option<Expr<'d>>,
}

/// A straight part of the rope.
struct Segment<'d> {
    length: Expr<'d>,
    /// Its direction, times `norm`.
    along: Vec<Expr<'d>>,
    norm: Expr<'d>,
    /// The vector from centre to centre.
    centre_line: Vec<Expr<'d>>,
}

/// A written length, if it could be resolved, and where it is written.
type Length<'d> = (Option<Expr<'d>>, Span);

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let record = resolver.record(member)?;
    let path = resolver.field(member, record, "path");
    let length = match (record.get("length"), is_wound(record)) {
        (None, true) => None,
        _ => resolver.field(member, record, "length"),
    };
    let scope = resolver.scope(member, &LENGTH);
    let length = length.map(|written| {
        let length = resolver.scalar_in(written, Unit::METRE, "a length is in m", scope);
        (length.map(|length| length.expr), written.span)
    });
    let path = path?;
    let points = written_points(resolver, member, path)?;
    let stops = path_points(resolver, member, record, points)?;
    let parts: Vec<Segment<'d>> = stops
        .windows(2)
        .map(|ends| segment(resolver, &ends[0], &ends[1]))
        .collect();
    let rope = (&stops[..], &parts[..]);
    let has_drum = stops.first().is_some_and(PathPoint::is_pulley)
        || stops.last().is_some_and(PathPoint::is_pulley);
    let of_rope = if has_drum {
        (
            kept_length(resolver, rope, length, path.span)?,
            Unit::METRE.rate(),
        )
    } else {
        (
            given_length(resolver, member, rope, (length, path.span))?,
            Unit::METRE,
        )
    };
    let mut constraints = vec![(None, of_rope)];
    let last = stops.len() - 1;
    for (k, stop) in stops.iter().enumerate().take(last).skip(1) {
        if stop.turn.is_some() {
            let expression = length_rate(resolver, rope, k, path.span)?;
            constraints.push((Some(k), (expression, Unit::METRE.rate())));
        }
        if has_drum {
            let _ = arc(resolver, member, rope, (k, path.span));
        }
    }
    let mut all = constraints.iter();
    if all.any(|(_, (expression, _))| expression.stage() < stage::POSITION) {
        let message = "this rope constrains nothing: no point of its path moves";
        let diagnostic = Diagnostic::new(Code::NoCoordinates, path.span, message);
        resolver.push(diagnostic.help("one end must be a point of a body, such as `load.at`"));
        return None;
    }
    let (name, span) = (resolver.name(member), resolver.span(member));
    let constraints = constraints.into_iter().map(|(pulley, (expression, unit))| {
        Contribution::Constraint(Constraint {
            name: match pulley {
                None => name.clone(),
                Some(k) => Name {
                    base: format!("{name}.pulley{k}"),
                    index: None,
                },
            },
            expression,
            unit,
            span,
        })
    });
    Some(Resolved::of(constraints))
}

/// The points of a path, which are two or more.
fn written_points<'a, 'd>(
    resolver: &mut Resolver<'a, 'd, '_>,
    member: MemberId,
    path: &'a Expression,
) -> Option<Vec<Vec<Expr<'d>>>> {
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
    points.into_iter().collect()
}

/// The rate of the length of a rope on a drum, which keeps the length that it has at the start.
fn kept_length<'d>(
    resolver: &mut Resolver<'_, 'd, '_>,
    rope: (&[PathPoint<'d>], &[Segment<'d>]),
    length: Option<Length<'d>>,
    span: Span,
) -> Option<Expr<'d>> {
    if let Some((_, span)) = length {
        let message = "a rope on a drum keeps the length that it has at the start";
        let diagnostic = Diagnostic::new(Code::ConflictingFields, span, message);
        resolver.push(diagnostic.help("leave `length` out"));
        return None;
    }
    length_rate(resolver, rope, rope.0.len() - 1, span)
}

/// By how much the segments and arcs of a rope are longer than its length.
fn given_length<'d>(
    resolver: &mut Resolver<'_, 'd, '_>,
    member: MemberId,
    rope: (&[PathPoint<'d>], &[Segment<'d>]),
    (length, span): (Option<Length<'d>>, Span),
) -> Option<Expr<'d>> {
    let Some((length, _)) = length else {
        let base = resolver.base_name(member);
        let message = format!("a rope needs `length`, and `{base}` has none");
        resolver.missing_field(member, message);
        return None;
    };
    let mut lengths: Vec<Expr<'d>> = rope.1.iter().map(|part| part.length).collect();
    for k in 1..rope.0.len() - 1 {
        lengths.extend(arc(resolver, member, rope, (k, span)));
    }
    Some(resolver.dag.sum(lengths) - length?)
}

impl PathPoint<'_> {
    fn is_pulley(&self) -> bool {
        !self.radius.is_zero()
    }
}

/// Whether an end of the path has a radius, as far as the syntax shows.
fn is_wound(record: &Record) -> bool {
    let Some(ExpressionKind::Tuple(radii)) = record.get("radii").map(|radii| &radii.kind) else {
        return false;
    };
    let is_zero = |end: &Expression| matches!(&end.kind, ExpressionKind::Number(number) if number.parse() == Ok(0.0));
    [radii.first(), radii.last()]
        .into_iter()
        .flatten()
        .any(|end| !is_zero(end))
}

/// The points of the path with their radii and angles.
fn path_points<'a, 'd>(
    resolver: &mut Resolver<'a, 'd, '_>,
    member: MemberId,
    record: &'a Record,
    points: Vec<Vec<Expr<'d>>>,
) -> Option<Vec<PathPoint<'d>>> {
    let zero = resolver.dag.zero();
    let radii = match record.get("radii") {
        None => vec![(zero, None); points.len()],
        Some(written) if resolver.space == Space::Space => {
            let message = "ropes around pulleys with radii exist only in the plane";
            let diagnostic = Diagnostic::new(Code::WrongSpace, written.span, message);
            resolver.push(
                diagnostic.help("in space a rope goes from point to point: leave `radii` out"),
            );
            return None;
        }
        Some(written) => {
            let scope = resolver.scope(member, &RADIUS);
            let radii = list(resolver, written, points.len(), "radii")?.iter();
            let radii: Vec<_> = radii
                .map(|radius| {
                    let scalar =
                        resolver.scalar_in(radius, Unit::METRE, "a radius is in m", scope)?;
                    Some((scalar.expr, Some(radius.span)))
                })
                .collect();
            radii.into_iter().collect::<Option<Vec<_>>>()?
        }
    };
    let turns = match record.get("turns") {
        None => vec![None; points.len()],
        Some(written) => {
            let turns = list(resolver, written, points.len(), "turns")?.iter();
            let turns: Vec<_> = turns
                .map(|turn| {
                    let scalar = turn_of(resolver, member, turn, &TURN)?;
                    if scalar.expr.is_zero() {
                        return Some(None);
                    }
                    let unit = scalar.unit.unwrap_or(Unit::RADIAN);
                    let reason = "a pulley turns by an angle";
                    resolver.require_unit(Some(Unit::RADIAN), unit, turn.span, reason);
                    Some(Some((scalar.expr, turn.span)))
                })
                .collect();
            turns.into_iter().collect::<Option<Vec<_>>>()?
        }
    };
    let last = points.len() - 1;
    let mut stops = Vec::with_capacity(points.len());
    for (k, ((at, (radius, span)), turn)) in points.into_iter().zip(radii).zip(turns).enumerate() {
        match (turn, span) {
            (Some((_, span)), _) if radius.is_zero() => {
                let message = "a point without a radius does not turn with the rope";
                let diagnostic = Diagnostic::new(Code::ConflictingFields, span, message);
                resolver.push(diagnostic.help("give its radius in `radii`, or 0 here"));
                return None;
            }
            (None, Some(span)) if (k == 0 || k == last) && !radius.is_zero() => {
                let message = "a rope that ends on a drum needs the angle of the drum";
                let diagnostic = Diagnostic::new(Code::MissingField, span, message);
                resolver.push(
                    diagnostic.help(
                        "give the angle in `turns`, or 0 here where the rope ends at a point",
                    ),
                );
                return None;
            }
            _ => {}
        }
        stops.push(PathPoint {
            position: at,
            radius,
            turn: turn.map(|(turn, _)| turn),
        });
    }
    Some(stops)
}

/// A tuple of as many expressions as the path has points.
fn list<'a>(
    resolver: &mut Resolver<'a, '_, '_>,
    written: &'a Expression,
    count: usize,
    field: &str,
) -> Option<&'a [Expression]> {
    match &written.kind {
        ExpressionKind::Error => None,
        ExpressionKind::Tuple(parts) if parts.len() == count => Some(parts),
        _ => {
            let message = format!(
                "`{field}` needs one value for each of the {count} points of `path`, 0 where there is none"
            );
            resolver.error(Code::WrongDimension, written.span, message);
            None
        }
    }
}

/// The straight part between two points or pulleys.
fn segment<'d>(
    resolver: &Resolver<'_, 'd, '_>,
    from: &PathPoint<'d>,
    to: &PathPoint<'d>,
) -> Segment<'d> {
    let line = vector_between(&from.position, &to.position);
    let h = to.radius - from.radius;
    if h.is_zero() {
        let length = resolver.distance(&line);
        return Segment {
            length,
            along: line.clone(),
            norm: length,
            centre_line: line,
        };
    }
    let square = resolver.dag.sum(line.iter().map(|x| x.square()));
    let length = (square - h.square()).sqrt();
    Segment {
        length,
        along: vec![
            length * line[0] + h * line[1],
            length * line[1] - h * line[0],
        ],
        norm: square,
        centre_line: line,
    }
}

/// The arc on the pulley at a point of the path, and the fact that the rope lies on it; nothing if there is no pulley.
fn arc<'d>(
    resolver: &mut Resolver<'_, 'd, '_>,
    member: MemberId,
    (stops, parts): (&[PathPoint<'d>], &[Segment<'d>]),
    (k, span): (usize, Span),
) -> Option<Expr<'d>> {
    let radius = stops[k].radius;
    if radius.is_zero() {
        return None;
    }
    let (before, behind) = (&parts[k - 1], &parts[k]);
    let [u, v] = [&before.along, &behind.along];
    let (across, along) = (u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]);
    // 1 − cos w ± sin w, times a positive factor: 0 at w = 0 and at three quarters of a turn, positive in between.
    let excess = radius.abs() * (before.norm * behind.norm - along) + radius * across;
    let text = format!(
        "the rope `{}` wraps around pulley {k}, by less than 3/4 of a turn",
        resolver.name(member)
    );
    resolver.add_fact(Assumption {
        text,
        excess,
        strict: true,
        span,
    });
    // The angle of (s e × e', |s| e · e') from the direction opposite to the cut of the arctangent, at three quarters of π.
    let (sine, cosine) = (radius * across, radius.abs() * along);
    let middle = resolver.dag.int(3) * resolver.dag.pi() / resolver.dag.int(4);
    Some(radius.abs() * (middle + (-(sine + cosine)).atan2(sine - cosine)))
}

/// The rate at which the rope up to a pulley or the last point grows, including wound parts.
fn length_rate<'d>(
    resolver: &mut Resolver<'_, 'd, '_>,
    (stops, parts): (&[PathPoint<'d>], &[Segment<'d>]),
    to: usize,
    span: Span,
) -> Option<Expr<'d>> {
    let mut terms = Vec::new();
    for part in &parts[..to] {
        let mut along = Vec::new();
        for (&e, &line) in part.along.iter().zip(&part.centre_line) {
            along.push(e * resolver.rate(line, span)?);
        }
        terms.push(resolver.dag.sum(along) / part.norm);
    }
    for (stop, sign) in [(&stops[0], -1), (&stops[to], 1)] {
        if let Some(turn) = stop.turn {
            terms.push(resolver.dag.int(sign) * stop.radius * resolver.rate(turn, span)?);
        }
    }
    Some(resolver.dag.sum(terms))
}
