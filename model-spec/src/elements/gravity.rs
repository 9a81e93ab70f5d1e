//! Gravity: a uniform acceleration, potential energy −m g·x of each body.

use crate::model::element::Contribution;
use crate::model::stage;
use crate::resolve::Resolver;
use crate::resolve::element::{Meaning, Resolved, Row};
use crate::resolve::value::{Limit, Scope, limit};
use crate::syntax::{Expression, Form, Section};
use crate::unit::Unit;

pub(super) const ROW: Row = Row {
    section: &SECTION,
    meaning: Meaning::Statement(resolve),
};

const SECTION: Section = Section {
    word: "gravity",
    item: "gravity",
    noun: "",
    form: Form::Statement,
    help: "write `gravity (0, -g);`",
};

static GRAVITY: Limit = limit(
    stage::TIME,
    "gravity",
    "it is uniform; write a field that depends on position as a potential",
);

fn resolve<'a, 'd>(
    resolver: &mut Resolver<'a, 'd, '_>,
    written: &'a Expression,
) -> Option<Resolved<'d>> {
    let scope = Scope {
        index: None,
        limit: &GRAVITY,
        expected_unit: None,
    };
    let unit = Unit::METRE.rate().rate();
    let reason = "gravity is an acceleration, in m/s^2";
    let gravity = resolver.vector_in(written, "a vector", unit, reason, scope)?;
    Some(Resolved::of([Contribution::Gravity(gravity.components)]))
}
