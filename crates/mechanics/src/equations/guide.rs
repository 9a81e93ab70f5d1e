//! Guides: along what a body slides, and how fast.

use lagrangian_spec::identity;
use lagrangian_spec::model::circles::planar_angle;
use lagrangian_spec::model::element::Sliding;
use lagrangian_spec::model::{Model, Place, Rotation};
use lagrangian_symbolic::{Expr, Tangent};

/// The directions of a guide, unit vectors in ground axes.
pub(super) struct Guide<'d> {
    pub along: Vec<Expr<'d>>,
    pub normal: Vec<Expr<'d>>,
}

/// How a guided body moves on what it slides on, at some rate: along the guide, and off it.
pub(super) fn relative<'d>(
    model: &Model<'d>,
    sliding: &Sliding<'d>,
    guide: &Guide<'d>,
    rate: &mut Tangent<'d>,
) -> [Expr<'d>; 2] {
    let dag = model.dag;
    let body = &model.bodies[sliding.body];
    let at = match body.rotation {
        Rotation::Frame(pose) => &model.poses[pose.index()].origin,
        Rotation::Angle(_) | Rotation::Unspecified => &body.at,
    };
    let (origin, angle) = base(model, sliding);
    let turning = angle.map_or(dag.zero(), |angle| rate.of(angle));
    let arm: Vec<Expr<'d>> = at.iter().zip(origin).map(|(&x, &o)| x - o).collect();
    // ω × r in the plane.
    let carried = [-(turning * arm[1]), turning * arm[0]];
    let velocity: Vec<Expr<'d>> = (0..2)
        .map(|k| rate.of(at[k]) - rate.of(origin[k]) - carried[k])
        .collect();
    [&guide.along, &guide.normal].map(|axis| dot(axis, &velocity))
}

/// A point of what a body slides on, and how far that is turned.
pub(super) fn base<'m, 'd>(
    model: &'m Model<'d>,
    sliding: &Sliding<'d>,
) -> (&'m [Expr<'d>], Option<Expr<'d>>) {
    match sliding.on {
        Place::Frame(pose) => {
            let pose = &model.poses[pose.index()];
            (&pose.origin, Some(pose.angle))
        }
        Place::Body(on) => {
            let on = &model.bodies[on];
            (&on.at, planar_angle(model, on))
        }
    }
}

/// The directions of a contact.
pub(super) fn guide<'d>(model: &Model<'d>, sliding: &Sliding<'d>) -> Guide<'d> {
    let along = unit(&sliding.direction);
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
    Guide { along, normal }
}

/// A vector as long as 1.
fn unit<'d>(vector: &[Expr<'d>]) -> Vec<Expr<'d>> {
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
