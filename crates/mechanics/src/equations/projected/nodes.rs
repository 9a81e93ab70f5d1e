//! The nodes that carry a machine's inertia.

use lagrangian_symbolic::Expr;

use super::super::composite::{self, Composite};
use super::super::kinematics::{self, Motion, Vector, apply_tensor, vector};
use lagrangian_spec::model::circles::planar_angle;
use lagrangian_spec::model::quaternion::Quaternion;
use lagrangian_spec::model::{Body, Inertia, Model, PoseId, Rotation, Space};

/// The nodes that carry the inertia of one body.
pub(super) struct InertiaNodes<'d> {
    /// Scalar positions with their weights: `T = ½ Σ w (Dp)²`.
    pub(super) points: Vec<Weighted<'d>>,
    /// Mass, and the mass centre in the axes of a frame in space; such a centre is not among the points.
    pub(super) centre: Option<(Expr<'d>, PoseId, Vector<'d>)>,
    /// Inertia in the axes of a frame in space.
    pub(super) tensor: Option<([Expr<'d>; 6], PoseId)>,
}

/// A scalar position with its weight.
#[derive(Clone, Copy)]
pub(super) struct Weighted<'d> {
    pub(super) position: Expr<'d>,
    pub(super) weight: Expr<'d>,
    /// The component of gravity along it.
    pub(super) gravity: Option<Expr<'d>>,
}

/// The motion of a body at some rate, or the loads on it, in the order of its [`InertiaNodes`].
pub(super) struct NodeValues<'d> {
    pub(super) points: Vec<Expr<'d>>,
    pub(super) linear: Option<Vector<'d>>,
    pub(super) angular: Option<Vector<'d>>,
}

impl<'d> InertiaNodes<'d> {
    /// The axis of a body of revolution whose mass centre, if it is given in the axes of the body's frame, lies on that axis; and this frame.
    pub(super) fn revolution(&self) -> Option<(usize, PoseId)> {
        let ([xx, yy, zz, xy, xz, yz], pose) = self.tensor?;
        let (diagonal, products) = ([xx, yy, zz], [xy, xz, yz]);
        let axis = (0..3).find(|axis| {
            let (next, last) = kinematics::others(*axis);
            let is_off = |r: &Vector<'d>| !r[next].is_zero() || !r[last].is_zero();
            let centre = self.centre.filter(|(_, at, _)| *at == pose);
            diagonal[next] == diagonal[last] && !centre.is_some_and(|(_, _, r)| is_off(&r))
        });
        let is_principal = products.iter().all(|product| product.is_zero());
        axis.filter(|_| is_principal).map(|axis| (axis, pose))
    }

    /// `w u`, `m u` and `I ω`.
    pub(super) fn momentum(&self, motion: &NodeValues<'d>) -> NodeValues<'d> {
        let points = self.points.iter().zip(&motion.points);
        NodeValues {
            points: points.map(|(point, &rate)| point.weight * rate).collect(),
            linear: self
                .centre
                .zip(motion.linear)
                .map(|((m, ..), u)| u.map(|u_k| m * u_k)),
            angular: self
                .tensor
                .zip(motion.angular)
                .map(|((i, _), w)| apply_tensor(&i, &w)),
        }
    }

    /// The motion in the form that [`energy`] expects: linear, then angular.
    pub(super) fn motion(&self, model: &Model<'d>, carried: &NodeValues<'d>) -> Motion<'d> {
        let dimension = model.space.dimension();
        let in_points = if carried.linear.is_some() {
            0
        } else {
            dimension
        };
        let (linear, angular) = carried.points.split_at(in_points);
        Motion {
            linear: carried.linear.map_or(linear.to_vec(), |u| u.to_vec()),
            angular: carried.angular.map_or(angular.to_vec(), |w| w.to_vec()),
        }
    }
}

impl<'d> NodeValues<'d> {
    pub(super) fn scaled(self, factor: i64) -> NodeValues<'d> {
        NodeValues {
            points: self.points.into_iter().map(|x| factor * x).collect(),
            linear: self.linear.map(|vector| vector.map(|x| factor * x)),
            angular: self.angular.map(|vector| vector.map(|x| factor * x)),
        }
    }

    pub(super) fn components(&self) -> impl Iterator<Item = Expr<'d>> {
        let vectors = self.linear.into_iter().chain(self.angular).flatten();
        self.points.iter().copied().chain(vectors)
    }

    pub(super) fn is_at_rest(&self) -> bool {
        self.components().all(|component| component.is_zero())
    }
}

/// The carrier of a body. In the plane everything is a scalar position; in space whatever moves
/// with frames is described in their axes.
pub(super) fn inertia_nodes<'d>(model: &Model<'d>, body: &Body<'d>) -> InertiaNodes<'d> {
    let centre = match model.space {
        Space::Plane => None,
        Space::Space => body.local.as_ref(),
    };
    let coordinates = body.at.iter().enumerate().filter(|_| centre.is_none());
    let mut points: Vec<Weighted<'d>> = coordinates
        .map(|(k, &position)| Weighted {
            position,
            weight: body.mass,
            gravity: model.gravity().map(|g| g[k]),
        })
        .collect();
    let tensor = match body.inertia {
        Inertia::Particle => None,
        Inertia::Planar(weight) => {
            let angle = planar_angle(model, body);
            points.extend(angle.map(|position| Weighted {
                position,
                weight,
                gravity: None,
            }));
            None
        }
        Inertia::Tensor(tensor) => frame_of(body.rotation).map(|pose| (tensor, pose)),
    };
    let centre = centre.map(|local| (body.mass, local.pose, vector(&local.point)));
    InertiaNodes {
        points,
        centre,
        tensor,
    }
}

/// The lengths of quaternions, eq. (E74), which have an inertia of their own that belongs to no body.
pub(super) fn lengths<'d>(model: &Model<'d>) -> impl Iterator<Item = InertiaNodes<'d>> {
    let length = |four: &Quaternion<'d>| InertiaNodes {
        points: vec![Weighted {
            position: four.log_length(),
            weight: four.inertia,
            gravity: None,
        }],
        centre: None,
        tensor: None,
    };
    model.quaternions.iter().map(length)
}

/// The inertia that is fixed to frames, gathered, and the rest.
pub(super) fn group_by_frame<'d>(
    model: &Model<'d>,
    bodies: &[InertiaNodes<'d>],
) -> (Vec<InertiaNodes<'d>>, Vec<(PoseId, Composite<'d>)>) {
    let zero = model.dag.zero();
    let mut others = Vec::new();
    let mut fixed = Vec::new();
    for body in bodies {
        let centre = body
            .centre
            .map(|(mass, pose, r)| (pose, Composite::of_body(mass, &r, &[zero; 6])));
        let tensor = body
            .tensor
            .map(|(tensor, pose)| (pose, Composite::of_body(zero, &[zero; 3], &tensor)));
        let constant = |part: &Option<(PoseId, Composite<'d>)>| {
            part.as_ref()
                .is_some_and(|(_, composite)| composite.is_constant())
        };
        let is_constant = [constant(&centre), constant(&tensor)];
        others.push(InertiaNodes {
            points: body.points.to_vec(),
            centre: body.centre.filter(|_| !is_constant[0]),
            tensor: body.tensor.filter(|_| !is_constant[1]),
        });
        fixed.extend(centre.filter(|_| is_constant[0]));
        fixed.extend(tensor.filter(|_| is_constant[1]));
    }
    if fixed.is_empty() {
        return (others, Vec::new());
    }
    let composites = composite::composites_by_pose(model, fixed.into_iter());
    let composites = (0..).map(PoseId).zip(composites);
    (
        others,
        composites
            .filter(|(_, composite)| !composite.is_zero())
            .collect(),
    )
}

pub(super) fn frame_of(rotation: Rotation<'_>) -> Option<PoseId> {
    match rotation {
        Rotation::Frame(pose) => Some(pose),
        Rotation::Angle(_) | Rotation::Unspecified => None,
    }
}
