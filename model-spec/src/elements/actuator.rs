//! Actuators: a force between two points along the line through them, or a torque between two frames.
//!
//! A positive force pushes the ends apart; a positive torque turns the second frame forward relative to
//! the first. The opposite load acts on the other end. So the work is `F δℓ` of the distance ℓ, or in
//! the plane `M δ(φ′ − φ)`; in space, about an axis `n`, the power is `M n·(ω′ − ω)`.

use lagrangian_symbolic::Expr;

use super::force::FORCE;
use crate::diagnostic::{Code, Diagnostic};
use crate::identity;
use crate::model::element::{Contribution, Drawing, Load, Shape, Site};
use crate::model::{FrameOrBody, PoseId, Space, stage};
use crate::resolve::Resolver;
use crate::resolve::element::{Meaning, Resolved, Row};
use crate::resolve::motion::vector_between;
use crate::resolve::value::{Limit, MemberId, limit};
use crate::source::Span;
use crate::syntax::{Expression, Form, Record, Section};
use crate::unit::Unit;

pub(super) const ROW: Row = Row {
    section: &SECTION,
    meaning: Meaning::Items(resolve),
};

const SECTION: Section = Section {
    word: "actuators",
    item: "an actuator",
    noun: "actuator",
    form: Form::Records(&["from", "to", "force", "torque", "axis"]),
    help: "an actuator is `name { from: point, to: point, force: … }` or \
           `name { from: frame, to: frame, torque: … }`, in space with an `axis`",
};

static AXIS: Limit = limit(
    stage::POSITION,
    "an axis",
    "only coordinates, parameters and `t` are allowed here",
);

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let record = resolver.record(member)?;
    match (record.get("force"), record.get("torque")) {
        (Some(force), _) => {
            resolver.conflict(record, "torque", "force");
            resolver.conflict(record, "axis", "force");
            between_points(resolver, member, record, force)
        }
        (None, Some(torque)) => between_frames(resolver, member, record, torque),
        (None, None) => {
            let base = resolver.base_name(member);
            let message =
                format!("an actuator needs `force` or `torque`, and `{base}` has neither");
            resolver.missing_field(member, message);
            None
        }
    }
}

fn between_points<'a, 'd>(
    resolver: &mut Resolver<'a, 'd, '_>,
    member: MemberId,
    record: &'a Record,
    force: &'a Expression,
) -> Option<Resolved<'d>> {
    let scope = resolver.scope(member, &FORCE);
    let force = resolver.scalar_in(force, Unit::NEWTON, "a force is in N", scope);
    let ends = ["from", "to"].map(|end| resolver.field(member, record, end));
    let [from, to] = ends.map(|end| {
        let end = end?;
        Some((resolver.point(member, end)?, end.span))
    });
    let ((from, _), (to, span)) = (from?, to?);
    let line = vector_between(&from, &to);
    let square = resolver.dag.sum(line.iter().map(|c| c.square()));
    if identity::is_zero(square) == Some(true) {
        same_ends(resolver, span);
        return None;
    }
    let load = Load::Along {
        measure: resolver.distance(&line),
        force: force?.expr,
        torsional: false,
    };
    Some(Resolved::of([Contribution::Load(load)]).drawn(Drawing {
        shape: Shape::Dashpot,
        site: Site::Between([from, to]),
    }))
}

/// Reports an actuator that can do no work.
fn same_ends(resolver: &mut Resolver<'_, '_, '_>, span: Span) {
    let message = "both ends of this actuator are the same";
    let diagnostic = Diagnostic::new(Code::ConflictingFields, span, message);
    resolver
        .push(diagnostic.help(
            "an actuator acts between two points or frames that move relative to each other",
        ));
}

fn between_frames<'a, 'd>(
    resolver: &mut Resolver<'a, 'd, '_>,
    member: MemberId,
    record: &'a Record,
    torque: &'a Expression,
) -> Option<Resolved<'d>> {
    let scope = resolver.scope(member, &FORCE);
    let torque = resolver.scalar_in(torque, Unit::JOULE, "a torque is in N*m", scope);
    let ends = ["from", "to"].map(|end| {
        let end = resolver.field(member, record, end)?;
        Some((resolver.oriented_place(member, end)?, end.span))
    });
    let axis = axis(resolver, member, record);
    let [Some((from, _)), Some((to, span))] = ends else {
        return None;
    };
    if from == to {
        same_ends(resolver, span);
        return None;
    }
    let (torque, axis) = (torque?.expr, axis?);
    let Some(axis) = axis else {
        let load = Load::Along {
            measure: resolver.angle_between(from, to)?,
            force: torque,
            torsional: true,
        };
        return Some(Resolved::of([Contribution::Load(load)]));
    };
    let torque: Vec<Expr<'d>> = axis.into_iter().map(|n| torque * n).collect();
    let back = torque.iter().map(|&m| -m).collect();
    let ends = [(from, back), (to, torque)].into_iter();
    // The ground does not turn.
    let ends = ends.filter(|(on, _)| *on != FrameOrBody::Frame(PoseId::GROUND));
    let loads = ends.map(|(on, torque)| Contribution::Load(Load::Torque { on, torque }));
    Some(Resolved::of(loads))
}

/// The axis of a torque in space, of length 1; none in the plane, which has only one axis. The outer
/// option is nothing if an error was reported.
fn axis<'a, 'd>(
    resolver: &mut Resolver<'a, 'd, '_>,
    member: MemberId,
    record: &'a Record,
) -> Option<Option<Vec<Expr<'d>>>> {
    let Some(written) = record.field("axis") else {
        if resolver.space == Space::Plane {
            return Some(None);
        }
        let base = resolver.base_name(member);
        let message = format!("in space a torque acts about an axis, and `{base}` has none");
        resolver.missing_field(member, message);
        return None;
    };
    if resolver.space == Space::Plane {
        let message = "in the plane a torque acts only about the normal";
        let diagnostic = Diagnostic::new(Code::WrongSpace, written.name.span, message);
        resolver.push(diagnostic.help("leave the axis out"));
        return None;
    }
    let scope = resolver.scope(member, &AXIS);
    let axis = resolver.vector(&written.value, "a vector", scope)?;
    Some(Some(
        resolver.direction(&axis.components, written.value.span)?,
    ))
}
