//! Dissipations: Rayleigh functions given by the spec, of velocities, positions and time.

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
    word: "dissipations",
    item: "a dissipation",
    noun: "dissipation",
    form: Form::Expressions,
    help: "a dissipation is `name: function`",
};

static DISSIPATION: Limit = limit(
    stage::VELOCITY,
    "a dissipation",
    "only velocities, coordinates, parameters and `t` are allowed here",
);

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let value = resolver.expression(member)?;
    let scope = resolver.scope(member, &DISSIPATION);
    let reason = "a dissipation function is in W: 1/2*b*der(x)^2";
    let function = resolver.scalar_in(value, Unit::WATT, reason, scope)?;
    let help = "its derivative with respect to a velocity is a force: write that under `forces` or `torques`";
    if resolver.refuse_states(function.expr, value.span, "a dissipation function", help) {
        return None;
    }
    let dissipated = Contribution::Dissipated(Energy::Given(function.expr));
    Some(Resolved::of([dissipated]))
}
