//! Forces at points of the machine, and generalized forces on coordinates.

use crate::model::element::{Contribution, Load};
use crate::model::stage;
use crate::resolve::Resolver;
use crate::resolve::element::{Meaning, Resolved, Row};
use crate::resolve::value::{Limit, MemberId, limit};
use crate::syntax::{Form, Record, Section};
use crate::unit::Unit;

pub(super) const ROW: Row = Row {
    section: &SECTION,
    meaning: Meaning::Items(resolve),
};

const SECTION: Section = Section {
    word: "forces",
    item: "a force",
    noun: "force",
    form: Form::Records(&["at", "force", "on", "value"]),
    help: "a force is `name { at: point, force: vector }` or \
           `name { on: coordinate, value: … }`",
};

/// The limit of a force and a torque.
pub(super) static FORCE: Limit = limit(
    stage::INPUT,
    "a force",
    "a force proportional to accelerations acts as a mass: declare it as a body",
);

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let record = resolver.record(member)?;
    let has = |field: &str| record.field(field).is_some();
    let load = if has("at") || has("force") {
        let with = if has("at") { "at" } else { "force" };
        resolver.conflict(record, "on", with);
        resolver.conflict(record, "value", with);
        at_point(resolver, member, record)?
    } else if has("on") || has("value") {
        on_coordinate(resolver, member, record)?
    } else {
        let base = resolver.base_name(member);
        let message =
            format!("a force needs `at` and `force`, or `on` and `value`; `{base}` has neither");
        resolver.missing_field(member, message);
        return None;
    };
    Some(Resolved::of([Contribution::Load(load)]))
}

fn at_point<'a, 'd>(
    resolver: &mut Resolver<'a, 'd, '_>,
    member: MemberId,
    record: &'a Record,
) -> Option<Load<'d>> {
    let at = resolver.field(member, record, "at");
    let force = resolver.field(member, record, "force");
    let at = at.and_then(|at| resolver.point(member, at));
    let scope = resolver.scope(member, &FORCE);
    let reason = "a force is in N";
    let force =
        force.and_then(|force| resolver.vector_in(force, "a vector", Unit::NEWTON, reason, scope));
    Some(Load::Point {
        at: at?,
        force: force?.components,
    })
}

fn on_coordinate<'a, 'd>(
    resolver: &mut Resolver<'a, 'd, '_>,
    member: MemberId,
    record: &'a Record,
) -> Option<Load<'d>> {
    let on = resolver.field(member, record, "on");
    let value = resolver.field(member, record, "value");
    let coordinate = on.and_then(|on| resolver.coordinate_at(member, on));
    let scope = resolver.scope(member, &FORCE);
    let unit = coordinate.and_then(|coordinate| resolver.unit_of(coordinate));
    let value = value.and_then(|value| match unit {
        Some(unit) => {
            let reason = "a generalized force does work along its coordinate";
            resolver.scalar_in(value, Unit::JOULE.over(unit), reason, scope)
        }
        None => resolver.scalar(value, scope),
    });
    Some(Load::Coordinate {
        coordinate: resolver.ordinal(coordinate?)?,
        value: value?.expr,
    })
}
