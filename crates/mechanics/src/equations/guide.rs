//! Directions of guides, and velocities along and across them.

use lagrangian_spec::identity;
use lagrangian_spec::model::circles::rotation_angle;
use lagrangian_spec::model::element::Sliding;
use lagrangian_spec::model::{FrameOrBody, Model, PoseId, Rotation, Space};
use lagrangian_symbolic::{Expr, Tangent};

use super::kinematics::cross;

/// The directions of a guide, unit vectors in ground axes.
pub(super) struct Guide<'d> {
    /// The direction in which the body slides.
    pub along: Vec<Expr<'d>>,
    /// The directions of the components of its reaction: the normal in the plane. In space a guide presses in any
    /// direction across itself, and its reaction is given in ground axes.
    pub axes: Vec<Vec<Expr<'d>>>,
}

/// The guide of each contact of a machine. A surface is one guide with two contacts.
pub(crate) fn guides_of(model: &Model<'_>) -> Vec<usize> {
    let mut guides = 0;
    let number = |sliding: &Sliding<'_>| {
        guides += usize::from(!sliding.is_second());
        guides - 1
    };
    model.sliding().into_iter().map(number).collect()
}

/// Whether the reaction of contact `other` occurs in the equation for the reaction of contact `own`: each guide occurs once, by
/// its first contact, and the guide of `own` by that contact itself.
pub(crate) fn occurs_in_equation(guides: &[usize], own: usize, other: usize) -> bool {
    if guides[own] == guides[other] {
        own == other
    } else {
        other == 0 || guides[other] != guides[other - 1]
    }
}

/// The velocity of a guided body relative to its base.
pub(super) struct Relative<'d> {
    /// Along the guide.
    pub slip: Expr<'d>,
    /// Along each of the directions of the reaction's components.
    pub normal_velocity: Vec<Expr<'d>>,
}

/// The velocity of a guided body relative to its base; `rate` differentiates.
pub(super) fn relative<'d>(
    model: &Model<'d>,
    sliding: &Sliding<'d>,
    guide: &Guide<'d>,
    rate: &mut Tangent<'d>,
) -> Relative<'d> {
    let velocity = velocity(model, sliding, rate);
    Relative {
        slip: dot(&guide.along, &velocity),
        normal_velocity: guide.axes.iter().map(|axis| dot(axis, &velocity)).collect(),
    }
}

/// The velocity of a guided body relative to its base, in ground axes: `ẋ_body − ẋ_on − ω_on×r`.
pub(super) fn velocity<'d>(
    model: &Model<'d>,
    sliding: &Sliding<'d>,
    rate: &mut Tangent<'d>,
) -> Vec<Expr<'d>> {
    let body = &model.bodies[sliding.body];
    let at = match body.rotation {
        Rotation::Frame(pose) => &model.poses[pose.index()].origin,
        Rotation::Angle(_) | Rotation::Unspecified => &body.at,
    };
    let (origin, turning) = base(model, sliding, rate);
    let arm: Vec<Expr<'d>> = at.iter().zip(origin).map(|(&x, &o)| x - o).collect();
    let carried = match (&turning[..], &arm[..]) {
        (&[turning], arm) => vec![-(turning * arm[1]), turning * arm[0]],
        (&[x, y, z], &[r, s, t]) => cross(&[x, y, z], &[r, s, t]).to_vec(),
        _ => vec![model.dag.zero(); arm.len()],
    };
    let component = |k: usize| rate.of(at[k]) - rate.of(origin[k]) - carried[k];
    (0..at.len()).map(component).collect()
}

/// A point of the base on which a body slides, and the base's angular velocity: one number in the plane, three in
/// ground axes in space; none if its orientation is not given.
pub(super) fn base<'m, 'd>(
    model: &'m Model<'d>,
    sliding: &Sliding<'d>,
    rate: &mut Tangent<'d>,
) -> (&'m [Expr<'d>], Vec<Expr<'d>>) {
    let origin = match sliding.on {
        FrameOrBody::Frame(pose) => &model.poses[pose.index()].origin,
        FrameOrBody::Body(on) => &model.bodies[on].at,
    };
    let rotation = model.rotation(sliding.on);
    let turning = match (model.space, rotation) {
        (Space::Plane, rotation) => {
            let angle = rotation_angle(model, rotation).into_iter();
            angle.map(|angle| rate.of(angle)).collect()
        }
        (Space::Space, Rotation::Frame(pose)) => angular_velocity(model, pose, rate),
        (Space::Space, Rotation::Angle(_) | Rotation::Unspecified) => Vec::new(),
    };
    (origin, turning)
}

/// The angular velocity of a frame in space, in ground axes: the sum over all turns that lead to it, each rate about its own axis.
fn angular_velocity<'d>(
    model: &Model<'d>,
    mut pose: PoseId,
    rate: &mut Tangent<'d>,
) -> Vec<Expr<'d>> {
    let mut terms = vec![Vec::new(); 3];
    while pose != PoseId::GROUND {
        let here = &model.poses[pose.index()];
        // A turn leaves its own axis unchanged.
        for (axis, rate) in here
            .step
            .angular_velocity_parts(|x| Some(rate.of(x)))
            .unwrap_or_default()
        {
            for (terms, &along) in terms.iter_mut().zip(&here.axes[axis]) {
                terms.push(rate * along);
            }
        }
        pose = here.parent;
    }
    terms
        .into_iter()
        .map(|terms| model.dag.sum(terms))
        .collect()
}

/// The directions of a contact.
pub(super) fn guide<'d>(model: &Model<'d>, sliding: &Sliding<'d>) -> Guide<'d> {
    let along = unit(&sliding.direction);
    if model.space == Space::Space {
        let axes = model.poses[PoseId::GROUND.index()].axes.clone();
        return Guide { along, axes };
    }
    let left = vec![-along[1], along[0]];
    let normal = match &sliding.normal {
        None => left,
        Some(given) => {
            let [x, y] = [sliding.direction[0], sliding.direction[1]];
            // The given normal is this multiple of the direction turned left, so the roots of their
            // lengths need not be compared.
            let times = dot(given, &[-y, x]) / model.dag.sum([x.square(), y.square()]);
            // The direction turned left has the same components and is shorter to write than the given normal.
            match identity::constant_sign(times) {
                Some(true) => left,
                Some(false) => left.into_iter().map(|x| -x).collect(),
                // The sign changes with parameters or coordinates.
                None => unit(given),
            }
        }
    };
    let axes = vec![normal];
    Guide { along, axes }
}

/// A vector normalized to length 1.
pub(super) fn unit<'d>(vector: &[Expr<'d>]) -> Vec<Expr<'d>> {
    let dag = vector[0].dag();
    let square = dag.sum(vector.iter().map(|x| x.square()));
    match identity::equal(square, dag.one()) {
        Some(true) => vector.to_vec(),
        _ => vector.iter().map(|&x| x / square.sqrt()).collect(),
    }
}

pub(super) fn dot<'d>(u: &[Expr<'d>], v: &[Expr<'d>]) -> Expr<'d> {
    u[0].dag().sum(u.iter().zip(v).map(|(&a, &b)| a * b))
}

pub(super) fn is_zero(e: Expr<'_>) -> bool {
    identity::is_zero(e) == Some(true)
}
