//! Circles that touch another circle, or a line, and roll on it.

use crate::model::element::{Contribution, Rolling};
use crate::model::stage;
use crate::resolve::Resolver;
use crate::resolve::element::{Meaning, Resolved, Row};
use crate::resolve::value::{Limit, MemberId, limit};
use crate::syntax::{Form, Section};

pub(super) const ROW: Row = Row {
    section: &SECTION,
    meaning: Meaning::Items(resolve),
};

const SECTION: Section = Section {
    word: "rolling",
    item: "a rolling contact",
    noun: "rolling contact",
    form: Form::Records(&["circle", "inside", "outside", "along", "friction"]),
    help: "it is `name { circle: …, inside: … }` or with `outside` or `along`",
};

static FRICTION: Limit = limit(
    stage::PARAMETER,
    "the friction of a rolling contact",
    "only parameters are allowed here",
);

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let record = resolver.record(member)?;
    let friction = record
        .get("friction")
        .map(|friction| resolver.coefficient_of_friction(member, friction, &FRICTION));
    Some(Resolved::of([Contribution::Rolling(Rolling {
        circles: resolver.touching(member, record)?,
        friction: match friction {
            Some(friction) => Some(friction?),
            None => None,
        },
        name: resolver.name(member),
        span: resolver.span(member),
    })]))
}
