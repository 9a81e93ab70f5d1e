//! Contact of spheres in space with other spheres and with planes.
//!
//! A point is a sphere of radius 0. The slip has two components, along two directions perpendicular to the normal.

use lagrangian_symbolic::{Expr, Tangent};

use super::circles::{Meeting, centre_and_axes, difference, distance};
use super::{Circle, FrameOrBody, Model, PoseId, Rotation, Surface};

/// The position and motion of a sphere relative to what it touches.
pub struct RelativeMotion<'d> {
    /// The distance between them, in m: 0 if they touch.
    pub gap: Expr<'d>,
    /// The velocity of the nearest point of the sphere relative to the nearest point of the other body, along both tangents; of
    /// spheres that yield, at their [`Meeting`].
    pub slip: [Expr<'d>; 2],
}

/// The contact of a sphere, which need not be one of the machine's, with a surface.
pub fn relative_motion<'d>(
    model: &Model<'d>,
    sphere: &Circle<'d>,
    surface: Surface,
    meeting: Meeting,
    rate: &mut Tangent<'d>,
) -> RelativeMotion<'d> {
    match surface {
        Surface::Inside(other) => {
            let pair = [sphere, &model.circles[other]];
            relative_to_sphere(model, pair, (true, meeting), rate)
        }
        Surface::Outside(other) => {
            let pair = [sphere, &model.circles[other]];
            relative_to_sphere(model, pair, (false, meeting), rate)
        }
        Surface::Along(pose) => relative_to_plane(model, sphere, pose, rate),
    }
}

/// The angular velocity of what a sphere is fixed to, in ground axes: each turn of a frame about one of its own axes,
/// which it leaves unchanged, adds its rate along that axis.
fn angular_velocity<'d>(
    model: &Model<'d>,
    place: FrameOrBody,
    rate: &mut Tangent<'d>,
) -> Vec<Expr<'d>> {
    let mut terms = vec![Vec::new(); 3];
    let mut at = match place {
        FrameOrBody::Frame(pose) => pose,
        FrameOrBody::Body(body) => match model.bodies[body].rotation {
            Rotation::Frame(pose) => pose,
            // The orientation is unknown; machines for which it matters are refused.
            Rotation::Unspecified | Rotation::Angle(_) => PoseId::GROUND,
        },
    };
    while at != PoseId::GROUND {
        let pose = &model.poses[at.index()];
        for (axis, speed) in pose
            .step
            .angular_velocity_parts(|x| Some(rate.of(x)))
            .unwrap_or_default()
        {
            for (terms, &along) in terms.iter_mut().zip(&pose.axes[axis]) {
                terms.push(speed * along);
            }
        }
        at = pose.parent;
    }
    terms
        .into_iter()
        .map(|terms| model.dag.sum(terms))
        .collect()
}

/// The contact of a sphere with the plane of the first two axes `e₁`, `e₂` of a frame, from the side of the third, `n`. With
/// `c` from the frame's origin to the centre, radius `r`, and angular velocities `ω` of the sphere and `Ω` of the frame:
///
/// ```text
/// gap = c·n − r,    slip = ċ − r ω × n − Ω × (c − r n),  along e₁ and e₂
/// ```
///
/// Both velocities are those at one place, whatever the [`Meeting`].
fn relative_to_plane<'d>(
    model: &Model<'d>,
    sphere: &Circle<'d>,
    pose: PoseId,
    rate: &mut Tangent<'d>,
) -> RelativeMotion<'d> {
    let frame = &model.poses[pose.index()];
    let (centre, _) = centre_and_axes(model, sphere);
    let pairs = centre.iter().zip(&frame.origin);
    let line: Vec<Expr<'d>> = pairs.map(|(&a, &b)| difference(a, b)).collect();
    let velocity: Vec<Expr<'d>> = line.iter().map(|&c| rate.of(c)).collect();
    let [spin, of_plane] =
        [sphere.on, FrameOrBody::Frame(pose)].map(|place| angular_velocity(model, place, rate));
    let normal = &frame.axes[2];
    let arm: Vec<Expr<'d>> = normal.iter().map(|&n| sphere.radius * n).collect();
    let foot: Vec<Expr<'d>> = line.iter().zip(&arm).map(|(&c, &a)| c - a).collect();
    let (turned, carried) = (cross(&spin, &arm), cross(&of_plane, &foot));
    let slip: Vec<Expr<'d>> = (0..3)
        .map(|k| model.dag.sum([velocity[k], -turned[k], -carried[k]]))
        .collect();
    RelativeMotion {
        gap: dot(normal, &line) - sphere.radius,
        slip: [0, 1].map(|axis| dot(&frame.axes[axis], &slip)),
    }
}

/// The contact of two spheres. With `c` from the centre of the other sphere to that of the first, `d` its length, `e = c/d`,
/// radii `r` and `R`, and angular velocities `ω` and `Ω`:
///
/// ```text
/// inside    gap = R − r − d,    slip = ċ + (r ω − R Ω) × e
/// outside   gap = d − r − R,    slip = ċ − (r ω + R Ω) × e
/// ```
///
/// along both [`tangents`] of the direction in which the gap opens. Where both velocities are those at one place ([`Meeting::Common`]),
///
/// ```text
/// inside    slip = ċ + (r ω − (R − gap) Ω) × e
/// outside   slip = ċ − (r ω + R Ω) × e (1 + gap/(r + R))
/// ```
fn relative_to_sphere<'d>(
    model: &Model<'d>,
    [first, other]: [&Circle<'d>; 2],
    (is_inside, meeting): (bool, Meeting),
    rate: &mut Tangent<'d>,
) -> RelativeMotion<'d> {
    let centres = [first, other].map(|sphere| centre_and_axes(model, sphere).0);
    let [a, b] = &centres;
    let line: Vec<Expr<'d>> = a.iter().zip(b).map(|(&a, &b)| difference(a, b)).collect();
    let facts = model.assumptions.iter().map(|fact| fact.excess);
    let facts: Vec<_> = facts.map(|fact| (fact, fact.symbols())).collect();
    let distance = distance(&line, &facts);
    let direction: Vec<Expr<'d>> = line.iter().map(|&c| c / distance).collect();
    let velocity: Vec<Expr<'d>> = line.iter().map(|&c| rate.of(c)).collect();
    let [spin, of_other] = [first, other].map(|sphere| angular_velocity(model, sphere.on, rate));
    let gap = if is_inside {
        other.radius - first.radius - distance
    } else {
        distance - first.radius - other.radius
    };
    let [r, big] = arms([first.radius, other.radius], gap, is_inside, meeting);
    let sign = if is_inside { 1 } else { -1 };
    let relative: Vec<Expr<'d>> = spin
        .iter()
        .zip(&of_other)
        .map(|(&first, &other)| r * first * sign - big * other)
        .collect();
    let turned = cross(&relative, &direction);
    let slip: Vec<Expr<'d>> = velocity.iter().zip(&turned).map(|(&v, &t)| v + t).collect();
    let normal: Vec<Expr<'d>> = direction.iter().map(|&e| -e * sign).collect();
    RelativeMotion {
        gap,
        slip: tangents(&normal).map(|tangent| dot(&tangent, &slip)),
    }
}

/// The distances from both centres of the places at which the velocities of two spheres are compared.
fn arms<'d>(
    [r, big]: [Expr<'d>; 2],
    gap: Expr<'d>,
    is_inside: bool,
    meeting: Meeting,
) -> [Expr<'d>; 2] {
    let both = r + big;
    match meeting {
        Meeting::Nearest => [r, big],
        Meeting::Common if is_inside => [r, big - gap],
        Meeting::Common if both.is_zero() => [r, big],
        Meeting::Common => [r, big].map(|radius| radius + gap * radius / both),
    }
}

/// Two unit vectors perpendicular to a unit vector `n` and to each other, right-handed with `n`. With `s = 1` if
/// `n₃ ≥ −0.3125`, and −1 below, and `a = −1/(s + n₃)`:
///
/// ```text
/// t₁ = (1 + s a n₁², s a n₁ n₂, −s n₁),    t₂ = (a n₁ n₂, s + a n₂², −n₂)
/// ```
///
/// No field of tangents is continuous on the whole sphere. This one jumps far from the typical directions of contact: from
/// below, from above and from the side. (T. Duff et al., *Building an orthonormal basis, revisited*, J. Comput. Graph. Tech. 6
/// (2017) 1–8, with another place for the jump.)
pub fn tangents<'d>(n: &[Expr<'d>]) -> [[Expr<'d>; 3]; 2] {
    let dag = n[0].dag();
    let side = (n[2] + dag.int(5) / 16).sign();
    // The sign of 0 is 0, but a side is needed even there.
    let s = side + 1 - side.abs();
    let a = -dag.one() / (s + n[2]);
    let product = a * n[0] * n[1];
    [
        [s * a * n[0].square() + 1, s * product, -s * n[0]],
        [product, s + a * n[1].square(), -n[1]],
    ]
}

fn dot<'d>(u: &[Expr<'d>], v: &[Expr<'d>]) -> Expr<'d> {
    let products = u.iter().zip(v).map(|(&u, &v)| u * v);
    u[0].dag().sum(products)
}

fn cross<'d>(u: &[Expr<'d>], v: &[Expr<'d>]) -> Vec<Expr<'d>> {
    let pairs = [(1, 2), (2, 0), (0, 1)];
    pairs.map(|(i, j)| u[i] * v[j] - u[j] * v[i]).to_vec()
}
