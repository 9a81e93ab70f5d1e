//! Springs: potential energy ½ k s² of a stretch s.

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
    word: "springs",
    item: "a spring",
    noun: "spring",
    form: Form::Records(&["stiffness", "stretch", "from", "to", "length"]),
    help: "a spring is `name { stiffness: …, stretch: … }` or \
           `name { stiffness: …, from: …, to: …, length: … }`",
};

/// The limit of a stiffness.
pub(super) static STIFFNESS: Limit = limit(
    stage::TIME,
    "a stiffness",
    "write a nonlinear spring as an energy under `potentials`",
);

const SPRING: Elastic = Elastic {
    coefficient: "stiffness",
    translational_unit: Unit::base(1, 0, -2),
    energy_unit: Unit::JOULE,
    limit: &STIFFNESS,
    bound: BoundKind::Stiffness,
    shape: Shape::Coil,
};

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let (deformation, drawing) = SPRING.resolve(resolver, member)?;
    let stored = Contribution::Stored(Energy::Quadratic(deformation));
    Some(Resolved::of([stored]).drawn(drawing))
}
