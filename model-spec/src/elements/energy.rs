//! Energies stored in first-order states: of a winding, a reservoir or a warm body.
//!
//! They enter only the energy balance, and no force follows from them.

use crate::model::element::Contribution;
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
    word: "energies",
    item: "an energy",
    noun: "energy",
    form: Form::Expressions,
    help: "an energy of states is `name: energy`",
};

static ENERGY: Limit = limit(
    stage::VELOCITY,
    "an energy of states",
    "only states, coordinates, parameters and `t` are allowed here",
);

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let value = resolver.expression(member)?;
    let scope = resolver.scope(member, &ENERGY);
    let energy = resolver.scalar_in(value, Unit::JOULE, "an energy is in J", scope)?;
    let help = "the kinetic energy of bodies is already included";
    if resolver.refuse_rates(energy.expr, value.span, "an energy of states", help) {
        return None;
    }
    Some(Resolved::of([Contribution::StateEnergy(energy.expr)]))
}
