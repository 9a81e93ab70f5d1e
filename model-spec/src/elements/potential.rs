//! Potentials: energies given by the spec as functions of positions and time.

use crate::model::element::{Contribution, Energy};
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
    word: "potentials",
    item: "a potential",
    noun: "potential",
    form: Form::Expressions,
    help: "a potential is `name: energy`",
};

static POTENTIAL: Limit = limit(
    stage::POSITION,
    "a potential",
    "only coordinates, parameters and `t` are allowed here; what depends on velocities is a force or a \
     dissipation",
);

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let value = resolver.expression(member)?;
    let scope = resolver.scope(member, &POTENTIAL);
    let energy = resolver.scalar_in(value, Unit::JOULE, "an energy is in J", scope)?;
    Some(Resolved::of([Contribution::Stored(Energy::Given(
        energy.expr,
    ))]))
}
