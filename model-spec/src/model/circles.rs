//! Circles in the plane: their positions, and the contact of two of them.

use std::collections::BTreeSet;

use lagrangian_symbolic::{Expr, Id, Node, Rational, Symbol, Tangent};

use crate::identity;
use crate::model::{Body, Circle, FrameOrBody, Model, PoseId, Rotation, Surface, Touching};

/// The relative position and motion of two circles.
pub struct RelativeMotion<'d> {
    /// The distance between them, in m: 0 if they touch.
    pub gap: Expr<'d>,
    /// The velocity of the point of the first circle that is nearest to the other, relative to the
    /// nearest point of the other, along the tangent; of circles that yield, at their [`Meeting`].
    pub slip: Expr<'d>,
}

/// Where both bodies of a contact have the velocities whose difference is its slip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meeting {
    /// Each at its own point that is nearest to the other. For bodies that touch without penetration this is one place.
    Nearest,
    /// Both at one place, also if they penetrate each other: friction at two places would be a couple as well, and would change the
    /// angular momentum of both together. The place is the nearest point of the first circle or sphere; outside of another it divides
    /// the line of centres in the ratio of the radii, so that it does not depend on which of them is the first. As a radius grows, or
    /// vanishes, this becomes the nearest point of the other.
    Common,
}

/// The centre of a circle and the axes of what it is fixed to, in ground axes.
pub fn centre_and_axes<'d>(
    model: &Model<'d>,
    circle: &Circle<'d>,
) -> (Vec<Expr<'d>>, Vec<Vec<Expr<'d>>>) {
    point_and_axes(model, circle.on, &circle.center)
}

/// The corners of a body's outline, in ground axes.
pub fn outline<'d>(model: &Model<'d>, body: usize) -> Vec<Vec<Expr<'d>>> {
    let place = match model.bodies[body].rotation {
        Rotation::Frame(pose) => FrameOrBody::Frame(pose),
        _ => FrameOrBody::Body(body),
    };
    let corners = model.bodies[body].outline.iter();
    corners
        .map(|corner| point_and_axes(model, place, corner).0)
        .collect()
}

/// A point that is fixed to a frame or a body, given in its axes, and these axes; both in ground axes.
pub(super) fn point_and_axes<'d>(
    model: &Model<'d>,
    on: FrameOrBody,
    point: &[Expr<'d>],
) -> (Vec<Expr<'d>>, Vec<Vec<Expr<'d>>>) {
    let pose_of = |pose: PoseId| &model.poses[pose.index()];
    let (origin, axes) = match on {
        FrameOrBody::Frame(pose) => (&pose_of(pose).origin, pose_of(pose).axes.clone()),
        FrameOrBody::Body(body) => {
            let body = &model.bodies[body];
            let ground = || pose_of(PoseId::GROUND).axes.clone();
            (&body.at, body_axes(model, body).unwrap_or_else(ground))
        }
    };
    let along = |k: usize| {
        let along = point.iter().zip(&axes);
        let along = along.map(|(&c, axis)| c * axis[k]);
        model.dag.sum([origin[k]].into_iter().chain(along))
    };
    ((0..origin.len()).map(along).collect(), axes)
}

/// The axes of a body, in ground axes; none if the spec gives no orientation.
pub fn body_axes<'d>(model: &Model<'d>, body: &Body<'d>) -> Option<Vec<Vec<Expr<'d>>>> {
    match body.rotation {
        Rotation::Frame(pose) => Some(model.poses[pose.index()].axes.clone()),
        Rotation::Unspecified => None,
        // A rotor in space has no axes.
        Rotation::Angle(_) if body.at.len() == 3 => None,
        Rotation::Angle(angle) => {
            let (sin, cos) = (angle.sin(), angle.cos());
            Some(vec![vec![cos, sin], vec![-sin, cos]])
        }
    }
}

/// The angle of a body in the plane.
pub fn planar_angle<'d>(model: &Model<'d>, body: &Body<'d>) -> Option<Expr<'d>> {
    rotation_angle(model, body.rotation)
}

/// The angle of a rotation in the plane.
pub fn rotation_angle<'d>(model: &Model<'d>, rotation: Rotation<'d>) -> Option<Expr<'d>> {
    match rotation {
        Rotation::Unspecified => None,
        Rotation::Angle(angle) => Some(angle),
        Rotation::Frame(pose) => Some(model.poses[pose.index()].angle),
    }
}

/// The angular velocity of what a circle is fixed to.
fn angular_velocity<'d>(
    model: &Model<'d>,
    circle: &Circle<'d>,
    rate: &mut Tangent<'d>,
) -> Expr<'d> {
    let angle = match circle.on {
        FrameOrBody::Frame(pose) => Some(model.poses[pose.index()].angle),
        FrameOrBody::Body(body) => planar_angle(model, &model.bodies[body]),
    };
    angle.map_or(model.dag.zero(), |angle| rate.of(angle))
}

/// The contact of a circle with the surface that it touches.
pub fn contact_motion<'d>(
    model: &Model<'d>,
    touching: &Touching,
    rate: &mut Tangent<'d>,
) -> RelativeMotion<'d> {
    relative_motion(
        model,
        &model.circles[touching.circle],
        touching.surface,
        Meeting::Nearest,
        rate,
    )
}

/// The angular velocity of a circle relative to what it touches, in rad/s.
pub fn rolling_rate<'d>(
    model: &Model<'d>,
    touching: &Touching,
    rate: &mut Tangent<'d>,
) -> Expr<'d> {
    let first = angular_velocity(model, &model.circles[touching.circle], rate);
    let other = match touching.surface {
        Surface::Inside(other) | Surface::Outside(other) => {
            angular_velocity(model, &model.circles[other], rate)
        }
        Surface::Along(pose) => rate.of(model.poses[pose.index()].angle),
    };
    difference(first, other)
}

/// The contact of a circle, which need not be one of the machine's, with a surface.
pub fn relative_motion<'d>(
    model: &Model<'d>,
    circle: &Circle<'d>,
    surface: Surface,
    meeting: Meeting,
    rate: &mut Tangent<'d>,
) -> RelativeMotion<'d> {
    let nearest = match surface {
        Surface::Inside(other) => {
            relative_to_circle(model, [circle, &model.circles[other]], true, rate)
        }
        Surface::Outside(other) => {
            relative_to_circle(model, [circle, &model.circles[other]], false, rate)
        }
        Surface::Along(pose) => relative_to_line(model, circle, pose, rate),
    };
    match meeting {
        Meeting::Nearest => nearest,
        Meeting::Common => {
            let RelativeMotion { gap, slip } = nearest;
            let slip = slip + gap * slip_by_gap(model, circle, surface, rate);
            RelativeMotion { gap, slip }
        }
    }
}

/// What a gap adds to the slip if both bodies have their velocities at one place ([`Meeting::Common`]), for each metre of the gap.
/// With angular velocities `ω` of the circle and `Ω` of what it touches, and radii `r` and `R`:
///
/// ```text
/// along, inside    Ω
/// outside          −(r ω + R Ω)/(r + R)
/// ```
fn slip_by_gap<'d>(
    model: &Model<'d>,
    circle: &Circle<'d>,
    surface: Surface,
    rate: &mut Tangent<'d>,
) -> Expr<'d> {
    match surface {
        Surface::Along(pose) => rate.of(model.poses[pose.index()].angle),
        Surface::Inside(other) => angular_velocity(model, &model.circles[other], rate),
        Surface::Outside(other) => {
            let other = &model.circles[other];
            let [omega, omega_of_other] =
                [circle, other].map(|circle| angular_velocity(model, circle, rate));
            let both = circle.radius + other.radius;
            if both.is_zero() {
                return both;
            }
            -(circle.radius * omega + other.radius * omega_of_other) / both
        }
    }
}

/// The contact of a circle with the first axis `e` of a frame, from the side of the second axis, `n`. With
/// `c` from the frame's origin to the centre, radius `r`, and the angular velocity `ω` of the circle:
///
/// ```text
/// gap = c·n − r,    slip = ċ·e + r ω
/// ```
///
/// A point of the line moves perpendicular to it, whatever the angular velocity of the frame; `c·n`
/// is taken as `r` for this.
fn relative_to_line<'d>(
    model: &Model<'d>,
    circle: &Circle<'d>,
    pose: PoseId,
    rate: &mut Tangent<'d>,
) -> RelativeMotion<'d> {
    let frame = &model.poses[pose.index()];
    let (centre, _) = centre_and_axes(model, circle);
    let line: Vec<Expr<'d>> = centre
        .iter()
        .zip(&frame.origin)
        .map(|(&a, &b)| difference(a, b))
        .collect();
    let along =
        |axis: &[Expr<'d>], u: &[Expr<'d>]| model.dag.sum(axis.iter().zip(u).map(|(&e, &u)| e * u));
    let velocity: Vec<Expr<'d>> = line.iter().map(|&c| rate.of(c)).collect();
    let omega = angular_velocity(model, circle, rate);
    RelativeMotion {
        gap: along(&frame.axes[1], &line) - circle.radius,
        slip: along(&frame.axes[0], &velocity) + circle.radius * omega,
    }
}

/// The contact of two circles. With `c` from the centre of the other circle to that of the first,
/// `d` its length, `e = c/d`, `τ` that vector turned left, radii `r` and `R`, angular velocities
/// `ω` and `Ω`:
///
/// ```text
/// inside    gap = R − r − d,    slip = ċ·τ + r ω − R Ω
/// outside   gap = d − r − R,    slip = ċ·τ − r ω − R Ω
/// ```
fn relative_to_circle<'d>(
    model: &Model<'d>,
    [first, other]: [&Circle<'d>; 2],
    is_inside: bool,
    rate: &mut Tangent<'d>,
) -> RelativeMotion<'d> {
    let centres = [first, other].map(|circle| centre_and_axes(model, circle).0);
    let [a, b] = &centres;
    let line: Vec<Expr<'d>> = a.iter().zip(b).map(|(&a, &b)| difference(a, b)).collect();
    let facts = model.assumptions.iter().map(|fact| fact.excess);
    let facts: Vec<_> = facts.map(|fact| (fact, fact.symbols())).collect();
    let distance = distance(&line, &facts);
    // ċ·τ = (c × ċ)/d.
    let velocity = [rate.of(line[0]), rate.of(line[1])];
    let sweep = line[0] * velocity[1] - line[1] * velocity[0];
    let [omega, omega_of_other] =
        [first, other].map(|circle| angular_velocity(model, circle, rate));
    let (r, big) = (first.radius, other.radius);
    let sign = if is_inside { 1 } else { -1 };
    RelativeMotion {
        gap: if is_inside {
            big - r - distance
        } else {
            distance - r - big
        },
        slip: sweep / distance + r * omega * sign - big * omega_of_other,
    }
}

/// `a − b` with common terms cancelled.
pub(super) fn difference<'d>(a: Expr<'d>, b: Expr<'d>) -> Expr<'d> {
    let dag = a.dag();
    let (a, b) = (terms(a), terms(b));
    dag.sum(a.into_iter().chain(b.into_iter().map(|term| -term)))
}

/// The terms of a sum; an expression that is not a sum is its only term. Added up again as one sum,
/// common terms cancel.
pub fn terms<'d>(sum: Expr<'d>) -> Vec<Expr<'d>> {
    match sum.node() {
        Node::Sum(terms) => {
            let term = |(id, factor): &(Id, Rational)| sum.dag().expr(*id) * factor.clone();
            terms.iter().map(term).collect()
        }
        _ => vec![sum],
    }
}

/// The length of a line, √(u·u), or an expression with that square that `facts` assume to be
/// nonnegative; facts come with their symbols.
pub fn distance<'d>(line: &[Expr<'d>], facts: &[(Expr<'d>, BTreeSet<Symbol>)]) -> Expr<'d> {
    let squares = line.iter().map(|c| c.square());
    let square = line[0].dag().sum(squares);
    let symbols = square.symbols();
    let known = facts.iter().find(|(fact, of)| {
        of.is_subset(&symbols) && identity::equal(fact.square(), square) == Some(true)
    });
    known.map_or_else(|| square.sqrt(), |&(fact, _)| fact)
}
