//! Stops: soft limits of the travel of a joint.
//!
//! Beyond a bound, at the depth δ, a stop is a spring. Its damping, if any, grows with the depth, so that
//! the force begins at zero at any impact velocity:
//!
//! ```text
//! V = ½ k δ²,    D = ½ c δ δ̇²,    δ = max(0, x − above)  or  max(0, below − x)
//! ```
//!
//! The law is that of K. H. Hunt and F. R. E. Crossley, *Coefficient of restitution interpreted as damping
//! in vibroimpact*, J. Appl. Mech. 42 (1975) 440–445, with exponent 1.

use lagrangian_symbolic::Expr;

use super::elastic::STRETCH;
use super::spring::STIFFNESS;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::bounds::BoundKind;
use crate::model::element::{Contribution, Deformation, Energy};
use crate::model::stage;
use crate::resolve::Resolver;
use crate::resolve::element::{Meaning, Resolved, Row};
use crate::resolve::value::{Limit, MemberId, limit};
use crate::syntax::{Form, Section};
use crate::unit::Unit;

pub(super) const ROW: Row = Row {
    section: &SECTION,
    meaning: Meaning::Items(resolve),
};

const SECTION: Section = Section {
    word: "stops",
    item: "a stop",
    noun: "stop",
    form: Form::Records(&["on", "above", "below", "stiffness", "damping"]),
    help: "a stop is `name { on: …, above: …, below: …, stiffness: … }`, with one of the bounds or both, and where \
           needed `damping`",
};

static DAMPING: Limit = limit(
    stage::TIME,
    "the damping of a stop",
    "write any other law as a function under `dissipations`",
);

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let record = resolver.record(member)?;
    let on = resolver.field(member, record, "on");
    let scope = resolver.scope(member, &STRETCH);
    let travel = on.and_then(|on| Some((resolver.scalar(on, scope)?, on.span)));
    if record.get("above").is_none() && record.get("below").is_none() {
        let base = resolver.base_name(member);
        let message = format!("a stop needs `above` or `below`, and `{base}` has neither");
        resolver.missing_field(member, message);
        return None;
    }
    let stiffness = resolver.field(member, record, "stiffness");
    let (travel, span) = travel?;
    let unit = travel.unit.unwrap_or(Unit::METRE);
    if travel.expr.stage() < stage::POSITION {
        let message = "this never moves, so the stop has no effect";
        let diagnostic = Diagnostic::new(Code::NoCoordinates, span, message);
        resolver.push(
            diagnostic.help("give a coordinate, or an expression that depends on coordinates"),
        );
        return None;
    }
    let bounds = ["above", "below"].map(|field| {
        let Some(written) = record.get(field) else {
            return Some(None);
        };
        let bound = resolver.scalar_in(
            written,
            unit,
            "a bound is in the unit of what it bounds",
            scope,
        )?;
        Some(Some(bound.expr))
    });
    let square = unit.times(unit);
    let stiffness = stiffness.and_then(|k| {
        let scope = resolver.scope(member, &STIFFNESS);
        let reason = "half the stiffness times the depth squared is an energy";
        let scalar = resolver.scalar_in(k, Unit::JOULE.over(square), reason, scope)?;
        resolver.bound(BoundKind::Stiffness, scalar.expr, k.span);
        Some(scalar.expr)
    });
    let damping = match record.get("damping") {
        None => Some(None),
        Some(written) => {
            let scope = resolver.scope(member, &DAMPING);
            let unit = Unit::WATT.over(unit.times(unit.rate()).times(unit.rate()));
            let reason = "the damping of a stop is a damping coefficient for each unit of depth";
            resolver
                .scalar_in(written, unit, reason, scope)
                .map(|scalar| {
                    resolver.bound(BoundKind::Damping, scalar.expr, written.span);
                    Some(scalar.expr)
                })
        }
    };
    let [above, below] = bounds;
    let (above, below, stiffness, damping) = (above?, below?, stiffness?, damping?);
    if let (Some(above), Some(below)) = (above, below) {
        let place = record.get("above").map_or(span, |written| written.span);
        resolver.bound(BoundKind::StopRange, above - below, place);
    }
    let x = travel.expr;
    let beyond = [above.map(|bound| x - bound), below.map(|bound| bound - x)];
    let mut contributions = Vec::new();
    for beyond in beyond.into_iter().flatten() {
        let depth: Expr<'d> = resolver.dag.zero().max(beyond);
        contributions.push(Contribution::Stored(Energy::Quadratic(Deformation {
            coefficient: stiffness,
            measure: depth,
            torsional: unit.is_one(),
        })));
        if let Some(damping) = damping {
            let rate = resolver.rate(beyond, span)?;
            let power = damping * depth * rate.square() / 2;
            contributions.push(Contribution::Dissipated(Energy::Given(power)));
        }
    }
    Some(Resolved::of(contributions))
}
