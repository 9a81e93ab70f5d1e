//! Dampers: dissipation ½ b ṡ² of the rate of a stretch s.

use super::elastic::Elastic;
use crate::model::bounds::BoundKind;
use crate::model::element::{Contribution, Energy, Shape};
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
    word: "dampers",
    item: "a damper",
    noun: "damper",
    form: Form::Records(&["damping", "stretch", "from", "to"]),
    help: "a damper is `name { damping: …, stretch: … }` or \
           `name { damping: …, from: …, to: … }`",
};

/// The limit of a damping coefficient.
pub(super) static DAMPING: Limit = limit(
    stage::TIME,
    "a damping coefficient",
    "write a nonlinear damper as a function under `dissipations`",
);

const DAMPER: Elastic = Elastic {
    coefficient: "damping",
    translational_unit: Unit::base(1, 0, -1),
    energy_unit: Unit::base(1, 2, -1),
    limit: &DAMPING,
    bound: BoundKind::Damping,
    shape: Shape::Dashpot,
};

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let (deformation, drawing) = DAMPER.resolve(resolver, member)?;
    let dissipated = Contribution::Dissipated(Energy::Quadratic(deformation));
    Some(Resolved::of([dissipated]).drawn(drawing))
}
