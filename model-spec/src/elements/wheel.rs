//! Wheels, discs and balls that roll on a plane in space.
//!
//! With `c` the centre, `o` and `n` origin and normal of the plane, `a` the axis of a thin disc of radius
//! `r`, the touching point is `c + ρ`:
//!
//! ```text
//! ball    h = n·(c − o) = r,      ρ = −r n
//! disc    h = r |s|,  ρ = −r s/|s|,   s = n − (n·a) a
//! ```
//!
//! and it does not slip: `ċ + ω × ρ` is the velocity of the plane at that point, along both axes of the
//! plane. E. J. Routh, *Advanced Rigid Dynamics*, 1905, ch. V.
//!
//! If the coordinates ensure that the wheel touches, the first equation is an identity and is left out.

use lagrangian_symbolic::Expr;

use crate::diagnostic::{Code, Diagnostic};
use crate::identity;
use crate::model::bounds::BoundKind;
use crate::model::element::{Constraint, Contribution};
use crate::model::{FrameOrBody, Name, PoseId, Space, stage};
use crate::resolve::Resolver;
use crate::resolve::element::{Meaning, Resolved, Row};
use crate::resolve::motion::{rotational_velocity, vector_between};
use crate::resolve::value::{Limit, MemberId, limit, limits};
use crate::syntax::{Form, Section};
use crate::unit::Unit;

pub(super) const ROW: Row = Row {
    section: &SECTION,
    meaning: Meaning::Items(resolve),
};

const SECTION: Section = Section {
    word: "wheels",
    item: "a wheel",
    noun: "wheel",
    form: Form::Records(&["wheel", "radius", "axis", "on"]),
    help: "a wheel is `name { wheel: frame, radius: …, axis: y, on: frame }`, a ball the same without `axis`",
};

static RADIUS: Limit = limit(
    stage::PARAMETER,
    "the radius of a wheel",
    "only parameters are allowed here",
);

fn resolve<'d>(resolver: &mut Resolver<'_, 'd, '_>, member: MemberId) -> Option<Resolved<'d>> {
    let record = resolver.record(member)?;
    if resolver.space == Space::Plane {
        let message = "wheels roll on planes only in space";
        let diagnostic = Diagnostic::new(Code::WrongSpace, resolver.span(member), message);
        resolver.push(diagnostic.help("in the plane use circles, under `rolling`"));
        return None;
    }
    let written = resolver.field(member, record, "wheel");
    let wheel = written.and_then(|written| resolver.oriented_place(member, written));
    let on = resolver.field(member, record, "on");
    let scope = resolver.scope(member, &limits::POINT);
    let on = on.and_then(|on| Some((resolver.frame(on, scope)?, on.span)));
    let radius = resolver
        .field(member, record, "radius")
        .and_then(|written| {
            let scope = resolver.scope(member, &RADIUS);
            let radius = resolver.scalar_in(written, Unit::METRE, "a radius is in m", scope)?;
            resolver.bound(BoundKind::Radius, radius.expr, written.span);
            Some(radius.expr)
        });
    let axis = match record.get("axis") {
        None => Some(None),
        Some(written) => resolver.axis(written).map(Some),
    };
    let (FrameOrBody::Frame(wheel), (on, span)) = (wheel?, on?) else {
        return None; // in space whatever turns has a frame
    };
    let (radius, axis) = (radius?, axis?);
    if wheel == on {
        let message = "a wheel does not roll on itself";
        resolver.error(Code::ConflictingFields, span, message);
        return None;
    }
    let (gap, lever) = distance_and_lever(resolver, wheel, on, radius, axis);
    let mut constraints = Vec::new();
    let name = resolver.name(member);
    let part = |part: &str| Name {
        base: format!("{name}.{part}"),
        index: None,
    };
    let span = resolver.span(member);
    if let Some(gap) = gap {
        if gap.stage() < stage::POSITION {
            let message =
                "this wheel does not touch what it rolls on, and no coordinate changes that";
            let diagnostic = Diagnostic::new(Code::NoCoordinates, span, message);
            let help = "the origin of its frame must be one radius above the plane of the first two axes of `on`";
            resolver.push(diagnostic.help(help));
            return None;
        }
        constraints.push(Constraint {
            name: part("gap"),
            expression: gap,
            unit: Unit::METRE,
            span,
        });
    }
    let slip = slip(resolver, [wheel, on], &lever, span)?;
    for (axis, letter) in ["x", "y"].into_iter().enumerate() {
        let along = dot(&resolver.pose(on).axes[axis], &slip);
        if along.is_zero() {
            continue;
        }
        constraints.push(Constraint {
            name: part(letter),
            expression: along,
            unit: Unit::METRE.rate(),
            span,
        });
    }
    Some(Resolved::of(
        constraints.into_iter().map(Contribution::Constraint),
    ))
}

fn dot<'d>(u: &[Expr<'d>], v: &[Expr<'d>]) -> Expr<'d> {
    let products = u.iter().zip(v).map(|(&u, &v)| u * v);
    u[0].dag().sum(products)
}

/// The distance of the wheel from the plane, unless it always touches, and the touching point relative
/// to its centre.
fn distance_and_lever<'d>(
    resolver: &Resolver<'_, 'd, '_>,
    wheel: PoseId,
    on: PoseId,
    radius: Expr<'d>,
    axis: Option<usize>,
) -> (Option<Expr<'d>>, Vec<Expr<'d>>) {
    let (wheel, on) = (resolver.pose(wheel), resolver.pose(on));
    let normal = &on.axes[2];
    let height = dot(normal, &vector_between(&on.origin, &wheel.origin));
    let Some(axis) = axis else {
        let lever = normal.iter().map(|&n| -radius * n).collect();
        let touches = identity::equal(height, radius) == Some(true);
        return ((!touches).then(|| height - radius), lever);
    };
    let axis = &wheel.axes[axis];
    let along = dot(normal, axis);
    let across: Vec<Expr<'d>> = normal
        .iter()
        .zip(axis)
        .map(|(&n, &a)| n - along * a)
        .collect();
    let square = resolver.dag.sum(across.iter().map(|c| c.square()));
    // If it always touches, |s| is h/r, without a root and a question of its sign.
    let touches = identity::equal(height.square(), radius.square() * square) == Some(true);
    let (gap, length) = if touches {
        (None, height / radius)
    } else {
        let length = resolver.distance(&across);
        (Some(height - radius * length), length)
    };
    let lever = across.iter().map(|&s| -radius * s / length).collect();
    (gap, lever)
}

/// The velocity of the touching point of the wheel relative to the plane there.
fn slip<'d>(
    resolver: &mut Resolver<'_, 'd, '_>,
    [wheel, on]: [PoseId; 2],
    lever: &[Expr<'d>],
    span: crate::source::Span,
) -> Option<Vec<Expr<'d>>> {
    let [centre, origin] = [wheel, on].map(|pose| resolver.pose(pose).origin.clone());
    let [spin, of_plane] = [wheel, on].map(|pose| resolver.spin(pose, span));
    let (spin, of_plane) = (spin?, of_plane?);
    let line = vector_between(&origin, &centre);
    let from_origin: Vec<Expr<'d>> = line.iter().zip(lever).map(|(&a, &b)| a + b).collect();
    let (turned, carried) = (
        rotational_velocity(&spin, lever),
        rotational_velocity(&of_plane, &from_origin),
    );
    let mut slip = Vec::with_capacity(3);
    for k in 0..3 {
        let rate = resolver.rate(line[k], span)?;
        slip.push(resolver.dag.sum([rate, turned[k], -carried[k]]));
    }
    Some(slip)
}
