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
use lagrangian_spec::model::{Circle, Model, Place, PoseId, Rotation, Surface};
use lagrangian_symbolic::Expr;

use super::{Moving, Varied};

type Point<R> = [Moving<R>; 3];

/// The gap between a sphere and a surface, and the slip velocity of the touching points along both tangents.
pub(super) fn gap_and_slip<'d, R: Scalar>(
    model: &Model<'d>,
    sphere: &Circle<'d>,
    surface: Surface,
    x: &impl Fn(Expr<'d>) -> Moving<R>,
) -> (Moving<R>, [Varied<R>; 2]) {
    match surface {
        Surface::Inside(other) => on_sphere(model, sphere, &model.circles[other], true, x),
        Surface::Outside(other) => on_sphere(model, sphere, &model.circles[other], false, x),
        Surface::Along(pose) => on_plane(model, sphere, pose, x),
    }
}

/// Origin and axes of a frame or a body.
fn origin_and_axes<'d, R: Scalar>(
    model: &Model<'d>,
    place: Place,
    x: &impl Fn(Expr<'d>) -> Moving<R>,
) -> (Point<R>, [Point<R>; 3]) {
    let of_pose = |pose: PoseId| {
        let axes = &model.poses[pose.index()].axes;
        [0, 1, 2].map(|k| [0, 1, 2].map(|l| x(axes[k][l])))
    };
    let point = |of: &[Expr<'d>]| [0, 1, 2].map(|k| x(of[k]));
    match place {
        Place::Frame(pose) => (point(&model.poses[pose.index()].origin), of_pose(pose)),
        Place::Body(body) => {
            let body = &model.bodies[body];
            let axes = match body.rotation {
                Rotation::Frame(pose) => of_pose(pose),
                Rotation::Unspecified | Rotation::Angle(_) => [0, 1, 2].map(|k| {
                    [0, 1, 2].map(|l| {
                        if k == l {
                            Moving::<R>::ONE
                        } else {
                            Moving::<R>::ZERO
                        }
                    })
                }),
            };
            (point(&body.at), axes)
        }
    }
}

/// The centre of a sphere, and the axes of what it is fixed to.
fn centre<'d, R: Scalar>(
    model: &Model<'d>,
    sphere: &Circle<'d>,
    x: &impl Fn(Expr<'d>) -> Moving<R>,
) -> (Point<R>, [Point<R>; 3]) {
    let (origin, axes) = origin_and_axes(model, sphere.on, x);
    let along = [0, 1, 2].map(|k| x(sphere.center[k]));
    let centre = [0, 1, 2]
        .map(|l| origin[l] + along[0] * axes[0][l] + along[1] * axes[1][l] + along[2] * axes[2][l]);
    (centre, axes)
}

/// The velocity of a point that is carried along at `lever` from `origin` by these axes.
fn point_velocity<R: Scalar>(
    origin: &Point<R>,
    axes: &[Point<R>; 3],
    lever: [Varied<R>; 3],
) -> [Varied<R>; 3] {
    let mut velocity = origin.map(|c| c.derivative);
    for axis in axes {
        let along = dot(axis.map(|a| a.value), lever);
        for (velocity, a) in velocity.iter_mut().zip(axis) {
            *velocity = *velocity + a.derivative * along;
        }
    }
    velocity
}

fn dot<P: Scalar>(u: [P; 3], v: [P; 3]) -> P {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

fn on_plane<'d, R: Scalar>(
    model: &Model<'d>,
    sphere: &Circle<'d>,
    pose: PoseId,
    x: &impl Fn(Expr<'d>) -> Moving<R>,
) -> (Moving<R>, [Varied<R>; 2]) {
    let (origin, frame) = origin_and_axes(model, Place::Frame(pose), x);
    let (centre, axes) = centre(model, sphere, x);
    let radius = x(sphere.radius);
    let line = [0, 1, 2].map(|k| centre[k] - origin[k]);
    let gap = dot(frame[2], line) - radius;
    let normal = frame[2].map(|n| n.value);
    let lever = normal.map(|n| -(radius.value * n));
    let foot = [0, 1, 2].map(|k| line[k].value + lever[k]);
    let (own, of_plane) = (
        point_velocity(&centre, &axes, lever),
        point_velocity(&origin, &frame, foot),
    );
    let slip = [0, 1, 2].map(|k| own[k] - of_plane[k]);
    let along = [0, 1].map(|axis| dot(frame[axis].map(|e| e.value), slip));
    (gap, along)
}

fn on_sphere<'d, R: Scalar>(
    model: &Model<'d>,
    first: &Circle<'d>,
    other: &Circle<'d>,
    is_inside: bool,
    x: &impl Fn(Expr<'d>) -> Moving<R>,
) -> (Moving<R>, [Varied<R>; 2]) {
    let (own, axes) = centre(model, first, x);
    let (theirs, other_axes) = centre(model, other, x);
    let line = [0, 1, 2].map(|k| own[k] - theirs[k]);
    let distance = dot(line, line).sqrt();
    let (small, large) = (x(first.radius), x(other.radius));
    let gap = if is_inside {
        large - small - distance
    } else {
        distance - small - large
    };
    let e = line.map(|c| c.value / distance.value);
    let arm = if is_inside { small.value } else { -small.value };
    let at = point_velocity(&own, &axes, e.map(|e| arm * e));
    let past = point_velocity(&theirs, &other_axes, e.map(|e| large.value * e));
    let slip = [0, 1, 2].map(|k| at[k] - past[k]);
    let n = if is_inside { e.map(|e| -e) } else { e };
    // Selects one of the two fields of tangents: see `lagrangian_spec::model::spheres`.
    let one = Varied::<R>::ONE;
    let side = (n[2] + Varied::<R>::from_ratio(5, 16)).sign();
    let s = side + one - side.abs();
    let a = -(one / (s + n[2]));
    let first = [one + s * a * n[0] * n[0], s * a * n[0] * n[1], -(s * n[0])];
    let second = [a * n[0] * n[1], s + a * n[1] * n[1], -n[1]];
    (gap, [dot(first, slip), dot(second, slip)])
}
