//! Drag: the force of a fluid on a body that moves fast through it.
//!
//! With `w` the velocity of a point relative to the wind, the force on it is
//!
//! ```text
//! F = −½ ρ c A |w| w
//! ```
//!
//! L. D. Landau and E. M. Lifshitz, *Fluid Mechanics*, 2nd ed. 1987, § 45.

use std::collections::BTreeSet;

use lagrangian_symbolic::{Expr, Symbol};

use super::force::FORCE;
use crate::identity;
use crate::model::bounds::BoundKind;
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
    word: "drag",
    item: "a drag",
    noun: "drag",
    form: Form::Records(&["at", "coefficient", "area", "density", "wind"]),
    help: "a drag is `name { at: point, coefficient: …, area: …, density: … }`, and where needed \
           `wind: vector`",
};

/// The limit of coefficient, area and density.
static FACTOR: Limit = limit(
    stage::INPUT,
    "a drag",
    "only velocities, coordinates, inputs, parameters and `t` are allowed here",
);

/// A factor of the force: its field, its unit, and the reason for messages.
type Factor = (&'static str, Unit, &'static str);

const FACTORS: [Factor; 3] = [
    ("coefficient", Unit::ONE, "a drag coefficient has no unit"),
    ("area", Unit::base(0, 2, 0), "an area is in m^2"),
    ("density", Unit::base(1, -3, 0), "a density is in kg/m^3"),
];

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let record = resolver.record(member)?;
    let at = resolver.field(member, record, "at");
    let point = at.and_then(|at| Some((resolver.point(member, at)?, at.span)));
    let factors = FACTORS.map(|factor| force_factor(resolver, member, record, factor));
    let scope = resolver.scope(member, &FORCE);
    let wind = match record.get("wind") {
        None => Some(None),
        Some(wind) => {
            let (unit, reason) = (Unit::METRE.rate(), "a wind is in m/s");
            let wind = resolver.vector_in(wind, "a vector", unit, reason, scope);
            wind.map(|wind| Some(wind.components))
        }
    };
    let ((at, span), wind) = (point?, wind?);
    let mut product = Vec::with_capacity(FACTORS.len() + 1);
    for factor in factors {
        product.push(factor?);
    }
    let mut velocity = Vec::with_capacity(at.len());
    for (k, &x) in at.iter().enumerate() {
        let rate = resolver.rate(x, span)?;
        velocity.push(wind.as_ref().map_or(rate, |wind| rate - wind[k]));
    }
    product.push(speed(resolver, &velocity));
    let factor = -resolver.dag.product(product) / 2;
    let force = velocity.into_iter().map(|w| factor * w).collect();
    Some(Resolved::of([Contribution::Load(Load::Point {
        at,
        force,
    })]))
}

/// The magnitude of a velocity. If a single rate produces it, it is written as the magnitude of that rate
/// times a length that does not vanish with it, so that the force is differentiable at rest too.
fn speed<'d>(resolver: &Resolver<'_, 'd, '_>, velocity: &[Expr<'d>]) -> Expr<'d> {
    let speed = || resolver.length(velocity);
    let is_rate = |&symbol: &Symbol| resolver.dag.stage_of(symbol) == stage::VELOCITY;
    let rates: BTreeSet<Symbol> = velocity
        .iter()
        .flat_map(|w| w.symbols())
        .filter(is_rate)
        .collect();
    let [rate] = rates.iter().copied().collect::<Vec<_>>()[..] else {
        return speed();
    };
    let slopes: Vec<Expr<'d>> = velocity.iter().map(|w| w.diff(rate)).collect();
    let rate = resolver.dag.expr_of(rate);
    let is_all = velocity.iter().zip(&slopes).all(|(&w, &slope)| {
        slope.stage() < stage::VELOCITY && identity::equal(w, slope * rate) == Some(true)
    });
    if is_all {
        rate.abs() * resolver.distance(&slopes)
    } else {
        speed()
    }
}

fn force_factor<'a, 'd>(
    resolver: &mut Resolver<'a, 'd, '_>,
    member: MemberId,
    record: &'a Record,
    (field, unit, reason): Factor,
) -> Option<Expr<'d>> {
    let written = resolver.field(member, record, field)?;
    let scope = resolver.scope(member, &FACTOR);
    let value = resolver.scalar_in(written, unit, reason, scope)?;
    resolver.bound(BoundKind::Drag, value.expr, written.span);
    Some(value.expr)
}
