//! Contact of spheres and points with planes and spheres in space.
//!
//! The touching point of a body is carried along by the body's axes `aₖ`; with `ρ` from a centre `c` to that point,
//!
//! ```text
//! velocity = ċ + Σ ȧₖ (aₖ·ρ)
//! ```
//!
//! The angular velocity is not needed.

use lagrangian_scalar::Scalar;
use lagrangian_spec::model::{Circle, FrameOrBody, Model, PoseId, Rotation, Surface};

use super::vector::{difference, dot, ground, point, quotient, rate, scaled, value};
use super::{Moving, Values, Varied, touching_point};

type Point<R> = [Moving<R>; 3];

/// The gap between a sphere and a surface, and the slip velocity of the touching points along both tangents; if they yield, of the
/// points of both that are at one place.
pub(super) fn gap_and_slip<R: Scalar>(
    model: &Model<'_>,
    sphere: &Circle<'_>,
    surface: Surface,
    yields: bool,
    x: &Values<'_, Varied<R>>,
) -> (Moving<R>, [Varied<R>; 2]) {
    match surface {
        Surface::Inside(other) => {
            on_sphere(model, [sphere, &model.circles[other]], (true, yields), x)
        }
        Surface::Outside(other) => {
            on_sphere(model, [sphere, &model.circles[other]], (false, yields), x)
        }
        Surface::Along(pose) => on_plane(model, sphere, pose, x),
    }
}

/// Origin and axes of a frame or a body.
fn origin_and_axes<R: Scalar>(
    model: &Model<'_>,
    place: FrameOrBody,
    x: &Values<'_, Varied<R>>,
) -> (Point<R>, [Point<R>; 3]) {
    let of_pose = |pose: PoseId| {
        let axes = &model.poses[pose.index()].axes;
        [x.vector(&axes[0]), x.vector(&axes[1]), x.vector(&axes[2])]
    };
    match place {
        FrameOrBody::Frame(pose) => (x.vector(&model.poses[pose.index()].origin), of_pose(pose)),
        FrameOrBody::Body(body) => {
            let body = &model.bodies[body];
            let axes = match body.rotation {
                Rotation::Frame(pose) => of_pose(pose),
                Rotation::Unspecified | Rotation::Angle(_) => ground(),
            };
            (x.vector(&body.at), axes)
        }
    }
}

/// The centre of a sphere, and the axes of what it is fixed to.
fn centre<R: Scalar>(
    model: &Model<'_>,
    sphere: &Circle<'_>,
    x: &Values<'_, Varied<R>>,
) -> (Point<R>, [Point<R>; 3]) {
    let (origin, axes) = origin_and_axes(model, sphere.on, x);
    (point(origin, axes, x.vector(&sphere.center)), axes)
}

/// The velocity of a point that is carried along at `lever` from `origin` by these axes.
fn point_velocity<R: Scalar>(
    origin: Point<R>,
    axes: [Point<R>; 3],
    lever: [Varied<R>; 3],
) -> [Varied<R>; 3] {
    let [a, b, c] = axes;
    let along = [
        dot(value(a), lever),
        dot(value(b), lever),
        dot(value(c), lever),
    ];
    point(rate(origin), [rate(a), rate(b), rate(c)], along)
}

fn on_plane<R: Scalar>(
    model: &Model<'_>,
    sphere: &Circle<'_>,
    pose: PoseId,
    x: &Values<'_, Varied<R>>,
) -> (Moving<R>, [Varied<R>; 2]) {
    let (origin, frame) = origin_and_axes(model, FrameOrBody::Frame(pose), x);
    let (centre, axes) = centre(model, sphere, x);
    let radius = x.at(sphere.radius);
    let line = difference(centre, origin);
    let gap = dot(frame[2], line) - radius;
    let to_foot = scaled(radius.value, value(frame[2]));
    let foot = difference(value(line), to_foot);
    let own = point_velocity(centre, axes, scaled(-Varied::<R>::ONE, to_foot));
    let slip = difference(own, point_velocity(origin, frame, foot));
    (
        gap,
        [dot(value(frame[0]), slip), dot(value(frame[1]), slip)],
    )
}

fn on_sphere<R: Scalar>(
    model: &Model<'_>,
    [first, other]: [&Circle<'_>; 2],
    (is_inside, yields): (bool, bool),
    x: &Values<'_, Varied<R>>,
) -> (Moving<R>, [Varied<R>; 2]) {
    let (own, axes) = centre(model, first, x);
    let (theirs, other_axes) = centre(model, other, x);
    let line = difference(own, theirs);
    let distance = dot(line, line).sqrt();
    let (small, large) = (x.at(first.radius), x.at(other.radius));
    let gap = if is_inside {
        large - small - distance
    } else {
        distance - small - large
    };
    let e = quotient(value(line), distance.value);
    let radii = [small, large].map(|r| r.value);
    // Two points have no place between them.
    let yields = yields && !(first.radius.is_zero() && other.radius.is_zero());
    let [arm, past] = touching_point(radii, distance.value, (is_inside, yields));
    let at = point_velocity(own, axes, scaled(arm, e));
    let past = point_velocity(theirs, other_axes, scaled(past, e));
    let slip = difference(at, past);
    let one = Varied::<R>::ONE;
    let n = if is_inside { scaled(-one, e) } else { e };
    // Selects one of the two fields of tangents: see `lagrangian_spec::model::spheres`.
    let side = (n[2] + Varied::<R>::from_ratio(5, 16)).sign();
    let s = side + one - side.abs();
    let a = -(one / (s + n[2]));
    let first = [one + s * a * n[0] * n[0], s * a * n[0] * n[1], -(s * n[0])];
    let second = [a * n[0] * n[1], s + a * n[1] * n[1], -n[1]];
    (gap, [dot(first, slip), dot(second, slip)])
}
