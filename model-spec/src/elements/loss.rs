//! Losses: power that leaves the machine by other means than dampers, such as the heat of a resistor.
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
    word: "losses",
    item: "a loss",
    noun: "loss",
    form: Form::Expressions,
    help: "a loss is `name: power`",
};

static LOSS: Limit = limit(
    stage::INPUT,
    "a loss",
    "only states, velocities, coordinates, inputs, parameters and `t` are allowed here",
);

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let value = resolver.expression(member)?;
    let scope = resolver.scope(member, &LOSS);
    let power = resolver.scalar_in(value, Unit::WATT, "a loss is a power, in W", scope)?;
    Some(Resolved::of([Contribution::PowerLoss(power.expr)]))
}
