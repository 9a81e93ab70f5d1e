//! The moving parts of a machine with guides: bodies, and the frames that guides are on.

use lagrangian_spec::model::circles::rotation_angle;
use lagrangian_spec::model::{FrameOrBody, Inertia, Model, PoseId, Rotation, Space};
use lagrangian_symbolic::Expr;

/// A moving part: a body, or the frame that a guide is on, with its rows.
pub(super) struct Part {
    pub(super) kind: PartKind,
    pub(super) rows: std::ops::Range<usize>,
}

#[derive(Clone, Copy)]
pub(super) enum PartKind {
    Body(usize),
    /// The base on which the body of this guide slides.
    Base(usize),
}

/// Whether a guide is on a body, or on a frame that is built on the frame of the body.
pub(super) fn is_a_base(model: &Model<'_>, body: usize) -> bool {
    let own = match model.bodies[body].rotation {
        Rotation::Frame(pose) if pose != PoseId::GROUND => Some(pose),
        _ => None,
    };
    model.sliding().iter().any(|sliding| match sliding.on {
        FrameOrBody::Body(on) => on == body,
        FrameOrBody::Frame(mut pose) => loop {
            if Some(pose) == own {
                return true;
            }
            if pose == PoseId::GROUND {
                return false;
            }
            pose = model.poses[pose.index()].parent;
        },
    })
}

/// The bodies and the bases of guides, with their places: the components of the position and, if a rotation has
/// inertia or turns a guide, the orientation, an angle in the plane and the axes in space.
pub(super) fn parts<'d>(model: &Model<'d>) -> (Vec<Part>, Vec<Expr<'d>>) {
    let (mut parts, mut places) = (Vec::new(), Vec::new());
    let mut add = |what, place: &[Expr<'d>], turned: Vec<Expr<'d>>| {
        let first = places.len();
        places.extend(place.iter().copied().chain(turned));
        let rows = first..places.len();
        parts.push(Part { kind: what, rows });
    };
    for (index, body) in model.bodies.iter().enumerate() {
        let turned = match body.inertia {
            Inertia::Particle => Vec::new(),
            Inertia::Planar(_) | Inertia::Tensor(_) => orientation_components(model, body.rotation),
        };
        add(PartKind::Body(index), &body.at, turned);
    }
    for (index, sliding) in model.sliding().into_iter().enumerate() {
        if let FrameOrBody::Frame(pose) = sliding.on {
            let turned = orientation_components(model, Rotation::Frame(pose));
            add(
                PartKind::Base(index),
                &model.poses[pose.index()].origin,
                turned,
            );
        }
    }
    (parts, places)
}

/// The orientation: an angle in the plane; in space the axes.
fn orientation_components<'d>(model: &Model<'d>, rotation: Rotation<'d>) -> Vec<Expr<'d>> {
    match (model.space, rotation) {
        (Space::Plane, rotation) => rotation_angle(model, rotation).into_iter().collect(),
        (Space::Space, Rotation::Frame(pose)) => model.poses[pose.index()].axes.concat(),
        (Space::Space, Rotation::Angle(angle)) => vec![angle],
        (Space::Space, Rotation::Unspecified) => Vec::new(),
    }
}
