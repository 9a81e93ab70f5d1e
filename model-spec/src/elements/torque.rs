//! Torques on bodies.

use super::force::FORCE;
use crate::model::element::{Contribution, Load};
use crate::model::{FrameOrBody, Space};
use crate::resolve::Resolver;
use crate::resolve::element::{Meaning, Resolved, Row};
use crate::resolve::value::MemberId;
use crate::syntax::{Form, Section};
use crate::unit::Unit;

pub(super) const ROW: Row = Row {
    section: &SECTION,
    meaning: Meaning::Items(resolve),
};

const SECTION: Section = Section {
    word: "torques",
    item: "a torque",
    noun: "torque",
    form: Form::Records(&["on", "torque"]),
    help: "a torque is `name { on: body, torque: … }`",
};

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let record = resolver.record(member)?;
    let on = resolver.field(member, record, "on");
    let torque = resolver.field(member, record, "torque");
    let body = on.and_then(|on| resolver.oriented_body(member, on));
    let scope = resolver.scope(member, &FORCE);
    let reason = "a torque is in N*m";
    let torque = torque.and_then(|torque| match resolver.space {
        Space::Plane => {
            let scalar = resolver.scalar_in(torque, Unit::JOULE, reason, scope)?;
            Some(vec![scalar.expr])
        }
        Space::Space => {
            let vector = resolver.vector_in(torque, "a vector", Unit::JOULE, reason, scope)?;
            Some(vector.components)
        }
    });
    Some(Resolved::of([Contribution::Load(Load::Torque {
        on: FrameOrBody::Body(resolver.ordinal(body?)?),
        torque: torque?,
    })]))
}
