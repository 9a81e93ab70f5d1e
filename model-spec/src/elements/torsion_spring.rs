//! Torsion springs: potential energy ½ c φ² of a twist φ.

use super::elastic::STRETCH;
use super::spring::STIFFNESS;
use crate::model::bounds::BoundKind;
use crate::model::element::{Contribution, Deformation, Drawing, Energy, Shape, Site};
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
    word: "torsion_springs",
    item: "a torsion spring",
    noun: "spring",
    form: Form::Records(&["stiffness", "twist"]),
    help: "a torsion spring is `name { stiffness: …, twist: … }`",
};

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let record = resolver.record(member)?;
    let stiffness = resolver.field(member, record, "stiffness");
    let twist = resolver.field(member, record, "twist");
    let scope = resolver.scope(member, &STIFFNESS);
    let reason = "a torsional stiffness is in N*m, per radian";
    let stiffness = stiffness.and_then(|k| {
        let scalar = resolver.scalar_in(k, Unit::JOULE, reason, scope)?;
        resolver.bound(BoundKind::Stiffness, scalar.expr, k.span);
        Some(scalar)
    });
    let scope = resolver.scope(member, &STRETCH);
    let reason = "a twist is an angle in rad";
    let twist = twist.and_then(|angle| resolver.scalar_in(angle, Unit::RADIAN, reason, scope));
    let deformation = Deformation {
        coefficient: stiffness?.expr,
        measure: twist?.expr,
        torsional: true,
    };
    let stored = Contribution::Stored(Energy::Quadratic(deformation));
    Some(Resolved::of([stored]).drawn(Drawing {
        shape: Shape::Coil,
        site: Site::Twist(deformation.measure),
    }))
}
