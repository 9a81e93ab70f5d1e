//! Guides: along what a body slides, and how fast.

use lagrangian_spec::identity;
use lagrangian_spec::model::circles::planar_turn;
use lagrangian_spec::model::element::Sliding;
use lagrangian_spec::model::{Model, Place, PoseId, Rotation, Space};
use lagrangian_symbolic::{Expr, Tangent};

use super::kinematics::cross;

/// The directions of a guide, unit vectors in ground axes.
pub(super) struct Guide<'d> {
    /// Along what the body slides.
    pub along: Vec<Expr<'d>>,
    /// The directions in which its reaction is counted: the normal in the plane. In space a guide presses in any direction
    /// across, and its reaction is counted along the axes of the ground.
    pub axes: Vec<Vec<Expr<'d>>>,
}

/// The guides of a machine among its contacts: which of them a contact is of. A surface is one guide, and two contacts.
pub(crate) fn guides_of(model: &Model<'_>) -> Vec<usize> {
    let mut guides = 0;
    let number = |sliding: &Sliding<'_>| {
        guides += usize::from(!sliding.is_second());
        guides - 1
    };
    model.sliding().into_iter().map(number).collect()
}

/// Whether in the equation that says what the reaction of one contact is, that of another takes part: each guide once, said by its
/// first contact, and the own one by the contact itself.
pub(crate) fn counts(guides: &[usize], own: usize, other: usize) -> bool {
    if guides[own] == guides[other] {
        own == other
    } else {
        other == 0 || guides[other] != guides[other - 1]
    }
}

/// How a guided body moves on what it slides on, at some rate.
pub(super) struct Relative<'d> {
    /// Along the guide.
    pub slip: Expr<'d>,
    /// Along each of the directions in which the reaction of the guide is counted.
    pub off: Vec<Expr<'d>>,
}

/// How a guided body moves on what it slides on, at some rate.
pub(super) fn relative<'d>(
    model: &Model<'d>,
    sliding: &Sliding<'d>,
    guide: &Guide<'d>,
    rate: &mut Tangent<'d>,
) -> Relative<'d> {
    let velocity = velocity(model, sliding, rate);
    Relative {
        slip: dot(&guide.along, &velocity),
        off: guide.axes.iter().map(|axis| dot(axis, &velocity)).collect(),
    }
}

/// The velocity of a guided body seen from what it slides on, in ground axes: `ẋ_body − ẋ_on − ω_on×r`.
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

/// A point of what a body slides on, and the angular velocity of that: one number in the plane, three in ground axes in
/// space; none where nothing says how it turns.
pub(super) fn base<'m, 'd>(
    model: &'m Model<'d>,
    sliding: &Sliding<'d>,
    rate: &mut Tangent<'d>,
) -> (&'m [Expr<'d>], Vec<Expr<'d>>) {
    let origin = match sliding.on {
        Place::Frame(pose) => &model.poses[pose.index()].origin,
        Place::Body(on) => &model.bodies[on].at,
    };
    let rotation = model.rotation(sliding.on);
    let turning = match (model.space, rotation) {
        (Space::Plane, rotation) => {
            let angle = planar_turn(model, rotation).into_iter();
            angle.map(|angle| rate.of(angle)).collect()
        }
        (Space::Space, Rotation::Frame(pose)) => turning(model, pose, rate),
        (Space::Space, Rotation::Angle(_) | Rotation::Unspecified) => Vec::new(),
    };
    (origin, turning)
}

/// The angular velocity of a frame in space, in ground axes: the rates of all turns that lead to it, each about its own axis.
fn turning<'d>(model: &Model<'d>, mut pose: PoseId, rate: &mut Tangent<'d>) -> Vec<Expr<'d>> {
    let mut terms = vec![Vec::new(); 3];
    while pose != PoseId::GROUND {
        let here = &model.poses[pose.index()];
        // A turn leaves its own axis where it is.
        for (axis, rate) in here.step.turning(|x| Some(rate.of(x))).unwrap_or_default() {
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
            // The given one is so many times the direction turned left, and the roots of their lengths
            // need not be compared.
            let times = dot(given, &[-y, x]) / model.dag.sum([x.square(), y.square()]);
            // Said by its components the direction turned is as good as the given one, and shorter.
            match identity::steady_sign(times) {
                Some(true) => left,
                Some(false) => left.into_iter().map(|x| -x).collect(),
                // The sides change with parameters or coordinates.
                None => unit(given),
            }
        }
    };
    let axes = vec![normal];
    Guide { along, axes }
}

/// A vector as long as 1.
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
