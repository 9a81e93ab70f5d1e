//! Rotors: inertia that turns with an angle at any position, such as a motor behind its gear, or a flywheel.
//!
//! ```text
//! T = ½ J φ̇²
//! ```
//!
//! A rotor is a body without mass that turns by an angle; its position does not matter.

use crate::diagnostic::{Code, Diagnostic};
use crate::model::bounds::BoundKind;
use crate::model::{Body, Inertia, Rotation, stage};
use crate::resolve::Resolver;
use crate::resolve::element::{Meaning, Resolved, Row};
use crate::resolve::value::{MemberId, limits};
use crate::syntax::{Form, Section};
use crate::unit::Unit;

pub(super) const ROW: Row = Row {
    section: &SECTION,
    meaning: Meaning::Items(resolve),
};

const SECTION: Section = Section {
    word: "rotors",
    item: "a rotor",
    noun: "rotor",
    form: Form::Records(&["inertia", "angle"]),
    help: "a rotor is `name { inertia: …, angle: … }`",
};

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let record = resolver.record(member)?;
    let angle = resolver.field(member, record, "angle");
    let scope = resolver.scope(member, &limits::ROTATION);
    let angle = angle.and_then(|angle| Some((resolver.scalar(angle, scope)?, angle.span)));
    let inertia = resolver.field(member, record, "inertia");
    let (angle, span) = angle?;
    // ½ J q̇² is an energy, whatever the unit of the coordinate.
    let rate = angle.unit.unwrap_or(Unit::RADIAN).rate();
    let unit = Unit::JOULE.over(rate.times(rate));
    let inertia = inertia.and_then(|written| {
        let scope = resolver.scope(member, &limits::INERTIA);
        let reason = "half the inertia times the rate squared is an energy";
        let inertia = resolver.scalar_in(written, unit, reason, scope)?;
        resolver.bound(BoundKind::Moment, inertia.expr, written.span);
        Some(inertia.expr)
    })?;
    if angle.expr.stage() < stage::TIME {
        let message = "this never turns, so its inertia has no effect";
        let diagnostic = Diagnostic::new(Code::NoCoordinates, span, message);
        resolver.push(
            diagnostic.help("give a coordinate, or an expression that depends on coordinates"),
        );
        return None;
    }
    let zero = resolver.dag.zero();
    let span = resolver.span(member);
    resolver.add_rotor(Body {
        name: resolver.name(member),
        docs: resolver.docs(member),
        mass: zero,
        inertia: Inertia::Planar(inertia),
        at: vec![zero; resolver.space.dimension()],
        local: None,
        rotation: Rotation::Angle(angle.expr),
        outline: Vec::new(),
        span,
        position_span: span,
    });
    Some(Resolved::of([]))
}
