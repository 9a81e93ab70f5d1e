//! Guided contacts: a body slides along a direction, or in space on a surface, with Coulomb friction from the normal
//! reaction of the guide.
//!
//! A surface is given by its normal alone. Sliding on it contributes two contacts, along two tangents.

use lagrangian_symbolic::Expr;

use crate::identity;
use crate::model::bounds::BoundKind;
use crate::model::element::{ACROSS, Contribution, Sliding, SurfaceTangent};
use crate::model::spheres::tangents;
use crate::model::{Name, Space, stage};
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
    help: "a sliding contact is `name { body: …, on: …, direction: …, friction: … }`; on a surface in space with `normal: …` in place of \
           `direction`",
};

static DIRECTION: Limit = limit(stage::POSITION, "a direction", POSITIONS);

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let record = resolver.record(member)?;
    let body = resolver.field(member, record, "body");
    let on = resolver.field(member, record, "on");
    // On a surface its tangents take the place of the direction along a curve.
    let is_surface = resolver.space == Space::Space
        && record.get("direction").is_none()
        && record.get("normal").is_some();
    let direction = if is_surface {
        None
    } else {
        resolver.field(member, record, "direction")
    };
    let friction = resolver.field(member, record, "friction");
    let body = body.and_then(|body| resolver.body_at(member, body));
    let on = on.and_then(|on| resolver.place(member, on));
    let scope = resolver.scope(member, &DIRECTION);
    let direction = direction.and_then(|direction| resolver.vector(direction, "a vector", scope));
    let normal = record.get("normal");
    let normal = normal.map(|normal| resolver.vector(normal, "a vector", scope));
    let friction = friction.and_then(|friction| resolver.friction(member, friction));
    let sticking = record.get("static_friction");
    let sticking = sticking.map(|written| {
        let sticking = resolver.friction(member, written);
        if let (Some(sticking), Some(friction)) = (sticking, friction) {
            resolver.bound(BoundKind::StaticFriction(friction), sticking, written.span);
        }
        sticking
    });
    // A normal that is present but wrong has been reported.
    let normal = match normal {
        Some(normal) => Some(normal?.components),
        None => None,
    };
    let directions = match &normal {
        Some(normal) if is_surface => {
            let [first, second] = tangents(&unit(normal));
            vec![
                (Some(SurfaceTangent::First), first.to_vec()),
                (Some(SurfaceTangent::Second), second.to_vec()),
            ]
        }
        _ => vec![(None, direction?.components)],
    };
    let sliding = Sliding {
        name: resolver.name(member),
        body: resolver.ordinal(body?)?,
        on: on?,
        direction: Vec::new(),
        normal,
        tangent: None,
        friction: friction?,
        static_friction: match sticking {
            Some(friction) => Some(friction?),
            None => None,
        },
        span: resolver.span(member),
    };
    let contact = |(tangent, direction)| {
        let name = match tangent {
            Some(SurfaceTangent::Second) => Name {
                base: format!("{}{ACROSS}", sliding.name),
                index: None,
            },
            _ => sliding.name.clone(),
        };
        Contribution::Sliding(Sliding {
            name,
            direction,
            tangent,
            ..sliding.clone()
        })
    };
    Some(Resolved::of(directions.into_iter().map(contact)))
}

/// A vector normalized to length 1.
fn unit<'d>(vector: &[Expr<'d>]) -> Vec<Expr<'d>> {
    let dag = vector[0].dag();
    let square = dag.sum(vector.iter().map(|x| x.square()));
    match identity::equal(square, dag.one()) {
        Some(true) => vector.to_vec(),
        _ => vector.iter().map(|&x| x / square.sqrt()).collect(),
    }
}
