//! Guided contacts: a body slides along a direction, and the normal reaction of the guide makes Coulomb
//! friction.

use crate::model::bounds::BoundKind;
use crate::model::element::{Contribution, Sliding};
use crate::model::stage;
use crate::resolve::Resolver;
use crate::resolve::element::{Meaning, Resolved, Row};
use crate::resolve::value::{Limit, MemberId, POSITIONS, limit};
use crate::syntax::{Form, Section};

pub(super) const ROW: Row = Row {
    section: &SECTION,
    meaning: Meaning::Items(resolve),
};

const SECTION: Section = Section {
    word: "sliding",
    item: "a sliding contact",
    noun: "sliding contact",
    form: Form::Records(&[
        "body",
        "on",
        "direction",
        "normal",
        "friction",
        "static_friction",
    ]),
    help: "a sliding contact is `name { body: …, on: …, direction: …, friction: … }`",
};

static DIRECTION: Limit = limit(stage::POSITION, "a direction", POSITIONS);

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let record = resolver.record(member)?;
    let body = resolver.field(member, record, "body");
    let on = resolver.field(member, record, "on");
    let direction = resolver.field(member, record, "direction");
    let friction = resolver.field(member, record, "friction");
    let body = body.and_then(|body| resolver.body_at(member, body));
    let on = on.and_then(|on| resolver.place(member, on));
    let scope = resolver.scope(member, &DIRECTION);
    let direction = direction.and_then(|direction| resolver.vector(direction, "a vector", scope));
    let normal = record.get("normal");
    let normal = normal.map(|normal| resolver.vector(normal, "a vector", scope));
    let friction = friction.and_then(|friction| resolver.friction(member, friction));
    let sticking = record.get("static_friction");
    let sticking = sticking.map(|said| {
        let sticking = resolver.friction(member, said);
        if let (Some(sticking), Some(friction)) = (sticking, friction) {
            resolver.bound(BoundKind::StaticFriction(friction), sticking, said.span);
        }
        sticking
    });
    Some(Resolved::of([Contribution::Sliding(Sliding {
        name: resolver.name(member),
        body: resolver.ordinal(body?)?,
        on: on?,
        direction: direction?.components,
        // What is said and wrong has been reported.
        normal: match normal {
            Some(normal) => Some(normal?.components),
            None => None,
        },
        friction: friction?,
        static_friction: match sticking {
            Some(friction) => Some(friction?),
            None => None,
        },
        span: resolver.span(member),
    })]))
}
