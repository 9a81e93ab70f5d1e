//! Composite inertia of frames in space, eq. (E27): everything fixed to a frame, as one body.
//!
//! Three steps make one composite body of the parts of a link, with few parameters. The inertia of all bodies fixed to
//! frames that are a constant shift apart is added up. The part of it that is symmetric about the axis of the link's
//! hinge moves as if it were fixed to the carrier of the hinge, whatever the angle: the mass as if it were on the axis,
//! the first moment along the axis, and as much inertia as the two directions across it have in common are handed on to
//! the carrier. So every link but the last loses its mass, and of its ten inertia parameters at most seven remain (W.
//! Khalil and J.-F. Bennis, *Symbolic calculation of the base inertial parameters of closed-loop robots*, Int. J.
//! Robotics Res. 14 (1995) 112–128). What reaches the ground has no effect and is dropped.
//!
//! The kinetic energy is the same for every motion, and so is every equation; all of this is
//! computed in the parameter stage.

use lagrangian_symbolic::{Dag, Expr, Stage};

use super::kinematics::{
    AccelerationMatrix, Twist, Vector, add, apply_tensor, cross, others, vector,
};
use lagrangian_spec::model::{Model, PoseChange, PoseId};

/// A part's inertia about the origin of a frame, along its axes:
/// `T = ½ m u² + u·(ω×s) + ½ ω·J ω`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Composite<'d> {
    /// `m`.
    pub mass: Expr<'d>,
    /// First moment `s`: the mass times its centre.
    pub moment: Vector<'d>,
    /// `J` about the origin: `xx, yy, zz, xy, xz, yz`.
    pub tensor: [Expr<'d>; 6],
}

impl<'d> Composite<'d> {
    fn zero(dag: &'d Dag) -> Composite<'d> {
        let zero = dag.zero();
        Composite {
            mass: zero,
            moment: [zero; 3],
            tensor: [zero; 6],
        }
    }

    /// The composite of a body, from its mass, its centre, and its inertia about the centre.
    pub fn of_body(mass: Expr<'d>, centre: &Vector<'d>, tensor: &[Expr<'d>; 6]) -> Composite<'d> {
        let at_centre = Composite {
            mass,
            moment: Composite::zero(mass.dag()).moment,
            tensor: *tensor,
        };
        at_centre.shifted(centre)
    }

    /// Whether it depends on parameters alone.
    pub fn is_constant(&self) -> bool {
        self.components().all(|x| x.stage() <= Stage::PARAMETER)
    }

    fn components(&self) -> impl Iterator<Item = Expr<'d>> {
        [self.mass]
            .into_iter()
            .chain(self.moment)
            .chain(self.tensor)
    }

    /// Whether its inertia depends on the motion of the origin.
    pub fn depends_on_origin_motion(&self) -> bool {
        [self.mass]
            .into_iter()
            .chain(self.moment)
            .any(|x| !x.is_zero())
    }

    pub fn is_zero(&self) -> bool {
        self.components().all(|x| x.is_zero())
    }

    fn plus(&self, other: &Composite<'d>) -> Composite<'d> {
        Composite {
            mass: self.mass + other.mass,
            moment: add(&[&self.moment, &other.moment]),
            tensor: std::array::from_fn(|k| self.tensor[k] + other.tensor[k]),
        }
    }

    /// This body about the origin of a frame in which the origin of this one is at `r`: `s + m r`,
    /// and `J` plus `(2 r·s + m r²) 1 − (r sᵀ + s rᵀ + m r rᵀ)`.
    fn shifted(&self, r: &Vector<'d>) -> Composite<'d> {
        let Composite {
            mass: m,
            moment: s,
            tensor,
        } = *self;
        let product = |i: usize, j: usize| r[i] * s[j] + s[i] * r[j] + m * r[i] * r[j];
        let [xx, yy, zz] = [0, 1, 2].map(|k| product(k, k));
        let more = [
            yy + zz,
            xx + zz,
            xx + yy,
            -product(0, 1),
            -product(0, 2),
            -product(1, 2),
        ];
        Composite {
            mass: m,
            moment: [0, 1, 2].map(|k| s[k] + m * r[k]),
            tensor: std::array::from_fn(|k| tensor[k] + more[k]),
        }
    }

    /// The part that is symmetric about an axis, and the rest.
    fn split(&self, axis: usize) -> [Composite<'d>; 2] {
        let (next, last) = others(axis);
        let zero = self.mass.dag().zero();
        let mut symmetric = Composite::zero(zero.dag());
        let mut rest = *self;
        (symmetric.mass, rest.mass) = (self.mass, zero);
        (symmetric.moment[axis], rest.moment[axis]) = (self.moment[axis], zero);
        let across = self.tensor[last];
        (symmetric.tensor[next], rest.tensor[next]) = (across, self.tensor[next] - across);
        (symmetric.tensor[last], rest.tensor[last]) = (across, zero);
        [symmetric, rest]
    }

    /// Momentum and angular momentum about the origin: `m u + ω×s`, `J ω + s×u`.
    pub fn momentum(&self, motion: &Twist<'d>) -> [Vector<'d>; 2] {
        let Twist { linear, angular } = motion;
        [
            add(&[
                &linear.map(|u| self.mass * u),
                &cross(angular, &self.moment),
            ]),
            add(&[
                &apply_tensor(&self.tensor, angular),
                &cross(&self.moment, linear),
            ]),
        ]
    }

    /// Force and moment required by inertia, about the origin: `m a + W s` with
    /// `W s = α×s + ω×(ω×s)`, and `J α + ω×J ω + s×a`, eq. (E15).
    pub fn inertia_wrench(
        &self,
        turning: &AccelerationMatrix<'d>,
        a: &Vector<'d>,
    ) -> [Vector<'d>; 2] {
        let carried = turning.apply(&self.moment);
        let moment = cross(&self.moment, a);
        let spun = turning.inertia_moment(&self.tensor);
        [
            [0, 1, 2].map(|k| self.mass * a[k] + carried[k]),
            add(&[&spun, &moment]),
        ]
    }

    /// Triples of `u`, `ω` and their weight: `T = ½ Σ weight u w`.
    pub fn pairs(&self, motion: &Twist<'d>) -> Vec<[Expr<'d>; 3]> {
        let [x, y, z] = motion.angular;
        let [xx, yy, zz, xy, xz, yz] = self.tensor;
        let mut pairs = vec![[x, x, xx], [y, y, yy], [z, z, zz]];
        pairs.extend([[x, y, 2 * xy], [x, z, 2 * xz], [y, z, 2 * yz]]);
        for (k, &u) in motion.linear.iter().enumerate() {
            pairs.push([u, u, self.mass]);
            // u·(ω×s), along one axis.
            let (next, last) = others(k);
            pairs.push([u, motion.angular[next], 2 * self.moment[last]]);
            pairs.push([u, motion.angular[last], -2 * self.moment[next]]);
        }
        pairs
    }
}

/// The composites by pose: adds up bodies that are fixed together, and hands the part that is
/// symmetric about a hinge on to its carrier, if that carries something else or is the ground, where
/// the part is dropped.
pub(super) fn composites_by_pose<'d>(
    model: &Model<'d>,
    bodies: impl Iterator<Item = (PoseId, Composite<'d>)>,
) -> Vec<Composite<'d>> {
    let mut composites = vec![Composite::zero(model.dag); model.poses.len()];
    for (pose, composite) in bodies {
        composites[pose.index()] = composites[pose.index()].plus(&composite);
    }
    let fixed = |r: &[Expr<'d>]| r.iter().all(|x| x.stage() <= Stage::PARAMETER);
    // Children come after their parents.
    for index in (1..composites.len()).rev() {
        let pose = &model.poses[index];
        if let PoseChange::Shift(r) = &pose.step
            && fixed(r)
        {
            let parent = pose.parent.index();
            composites[parent] = composites[parent].plus(&composites[index].shifted(&vector(r)));
            composites[index] = Composite::zero(model.dag);
        }
    }
    for index in (1..composites.len()).rev() {
        let PoseChange::Turn { axis, .. } = &model.poses[index].step else {
            continue;
        };
        // Follow constant shifts up to the next turn, or to the ground.
        let mut carrier = model.poses[index].parent;
        let mut shifts: Vec<&[Expr<'d>]> = Vec::new();
        while let PoseChange::Shift(r) = &model.poses[carrier.index()].step
            && fixed(r)
        {
            shifts.push(r);
            carrier = model.poses[carrier.index()].parent;
        }
        let takes = carrier == PoseId::GROUND || !composites[carrier.index()].is_zero();
        if takes && !composites[index].is_zero() {
            let [symmetric, rest] = composites[index].split(*axis);
            let handed = shifts
                .iter()
                .fold(symmetric, |composite, r| composite.shifted(&vector(r)));
            composites[index] = rest;
            composites[carrier.index()] = composites[carrier.index()].plus(&handed);
        }
    }
    composites[PoseId::GROUND.index()] = Composite::zero(model.dag);
    composites
}
