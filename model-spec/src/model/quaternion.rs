//! Rotations by four coordinates, a quaternion of any length.
//!
//! Three angles cannot describe all rotations without a singularity, where two of them turn about the same axis and the mass
//! matrix is singular. Four numbers `e = (e₀, e₁, e₂, e₃)` can. With `s = e·e` they turn a frame by
//!
//! ```text
//! R = 1 + 2/s (e₀ [ε]× + [ε]×²),   ε = (e₁, e₂, e₃)
//! ```
//!
//! which is the rotation by φ about the axis n for `e = √s (cos φ/2, n sin φ/2)`: a proper rotation for every e except 0, and the
//! same for every multiple of e. (J. B. Kuipers, *Quaternions and Rotation Sequences*, 1999, ch. 5.)
//!
//! The length of e therefore has no meaning, no body moves with it, and it would have no equation of motion. It is given one of its
//! own, which contains nothing else: with `u = ½ ln s`, `u̇ = e·ė/s` and two constants, an inertia κ and a rate ρ,
//!
//! ```text
//! κ ü = −κ (2 ρ u̇ + (ρ² + ė·ė/s) (s − 1)/(s + 1))
//! ```
//!
//! so that the length returns to 1 from any start and after any integration error: critically damped with the rate ρ at rest, and by
//! a spring as fast as e itself while the frame turns, so that it adds no stiffness to the system. Every κ gives the same motion.

use lagrangian_symbolic::Expr;

use super::{Inertia, Model, PoseChange, PoseId, Rotation, stage};
use crate::source::Span;

/// The rate at which the length of a quaternion returns to 1 if nothing turns, in 1/s.
pub const RATE: i64 = 1;

/// A quaternion of coordinates that turns a frame.
#[derive(Clone, Copy)]
pub struct Quaternion<'d> {
    /// Their symbols, `e₀` first.
    pub e: [Expr<'d>; 4],
    /// κ, the inertia of its length, in kg·m²; a function of parameters.
    pub inertia: Expr<'d>,
    /// Where the spec turns a frame by it.
    pub span: Span,
}

impl<'d> Quaternion<'d> {
    /// The indices of its coordinates in a model that has them.
    pub fn coordinates(&self, model: &Model<'d>) -> [usize; 4] {
        self.e.map(|e| {
            let place = model.coordinates.iter().position(|c| c.q == e);
            place.expect("a frame is turned by coordinates of its model")
        })
    }

    /// `u`, half the logarithm of `s`.
    pub fn log_length(&self) -> Expr<'d> {
        square(&self.e).ln() / 2
    }

    /// The load on `u` for the given rates of the components.
    pub fn load(&self, rates: &[Expr<'d>; 4]) -> Expr<'d> {
        let dag = self.inertia.dag();
        let s = square(&self.e);
        let growing = radial_rate(&self.e, rates) / s;
        let fast = dag.int(RATE * RATE) + square(rates) / s;
        let off = (s - 1) / (s + 1);
        -(self.inertia * (2 * RATE * growing + fast * off))
    }
}

/// `s = e·e`.
pub fn square<'d>(e: &[Expr<'d>; 4]) -> Expr<'d> {
    e[0].dag().sum(e.map(|e| e.square()))
}

/// `e·ė`, which is `s u̇`.
pub fn radial_rate<'d>(e: &[Expr<'d>; 4], rates: &[Expr<'d>; 4]) -> Expr<'d> {
    e[0].dag().sum((0..4).map(|k| e[k] * rates[k]))
}

/// The vector of `ē∘ė`, which is half of `s ω`.
pub fn vector_part<'d>(e: &[Expr<'d>; 4], rates: &[Expr<'d>; 4]) -> [Expr<'d>; 3] {
    let [w, x, y, z] = *e;
    let [dw, dx, dy, dz] = *rates;
    let dag = w.dag();
    [
        dag.sum([w * dx, -(x * dw), z * dy, -(y * dz)]),
        dag.sum([w * dy, -(y * dw), x * dz, -(z * dx)]),
        dag.sum([w * dz, -(z * dw), y * dx, -(x * dy)]),
    ]
}

/// The axes after a rotation by a quaternion, in the axes before it: the columns of R.
pub fn axes<'d>(e: &[Expr<'d>; 4]) -> [[Expr<'d>; 3]; 3] {
    let [w, x, y, z] = *e;
    let p = 2 / square(e);
    let one = w.dag().one();
    [
        [
            one - p * (y.square() + z.square()),
            p * (x * y + w * z),
            p * (x * z - w * y),
        ],
        [
            p * (x * y - w * z),
            one - p * (x.square() + z.square()),
            p * (y * z + w * x),
        ],
        [
            p * (x * z + w * y),
            p * (y * z - w * x),
            one - p * (x.square() + y.square()),
        ],
    ]
}

/// The angular velocity of such a rotation, in the rotated axes: `2/s` times the vector of `ē∘ė`. If second derivatives are passed
/// instead of rates, it is their part of the angular acceleration.
pub fn angular_velocity<'d>(e: &[Expr<'d>; 4], rates: &[Expr<'d>; 4]) -> [Expr<'d>; 3] {
    let p = 2 / square(e);
    vector_part(e, rates).map(|part| p * part)
}

/// The derivative of [`angular_velocity`] along a motion with these second derivatives.
pub fn angular_acceleration<'d>(
    e: &[Expr<'d>; 4],
    rates: &[Expr<'d>; 4],
    second: &[Expr<'d>; 4],
) -> [Expr<'d>; 3] {
    // The derivative of ē∘ė has the vector of ē∘ë, and 1/s changes at the rate −2 u̇/s.
    let growing = radial_rate(e, rates) / square(e);
    let (faster, now) = (angular_velocity(e, second), angular_velocity(e, rates));
    [0, 1, 2].map(|k| faster[k] - 2 * growing * now[k])
}

impl<'d> PoseChange<'d> {
    /// The parts of the angular velocity that this step adds, each about an axis of the resulting frame; `rate` differentiates
    /// the quantities of the step. `None` if the rate of one is unknown.
    pub fn angular_velocity_parts(
        &self,
        mut rate: impl FnMut(Expr<'d>) -> Option<Expr<'d>>,
    ) -> Option<Vec<(usize, Expr<'d>)>> {
        match self {
            PoseChange::Ground | PoseChange::Shift(_) => Some(Vec::new()),
            PoseChange::Turn { axis, angle } => Some(vec![(*axis, rate(*angle)?)]),
            PoseChange::Quaternion(e) => {
                let [a, b, c, d] = e.map(&mut rate);
                let spin = angular_velocity(e, &[a?, b?, c?, d?]);
                Some(spin.into_iter().enumerate().collect())
            }
        }
    }
}

/// An inertia for the length of a quaternion that is about as large as those of the rotation itself, so that the mass matrix is
/// as well conditioned as the machine: four thirds of the traces of the inertias of all bodies carried by the frames that the
/// quaternion turns, including the offsets of their mass centres as far as parameters determine them.
pub(crate) fn inertia<'d>(model: &Model<'d>, e: &[Expr<'d>; 4]) -> Expr<'d> {
    let dag = model.dag;
    // For each pose that is built on a frame turned by this quaternion, the sum of the squares of the
    // constant shifts from there.
    let mut carried: Vec<Option<Expr<'d>>> = Vec::with_capacity(model.poses.len());
    let length = |shift: &[Expr<'d>]| {
        let known = shift.iter().filter(|x| x.stage() <= stage::PARAMETER);
        dag.sum(known.map(|x| x.square()))
    };
    for pose in &model.poses {
        let parent = carried.get(pose.parent.index()).copied().flatten();
        carried.push(match &pose.step {
            PoseChange::Quaternion(quaternion) if quaternion == e => Some(dag.zero()),
            PoseChange::Shift(by) => parent.map(|far| far + length(by)),
            _ => parent,
        });
    }
    let of = |pose: PoseId| carried[pose.index()];
    let mut terms = Vec::new();
    for body in &model.bodies {
        if let (Inertia::Tensor([xx, yy, zz, ..]), Rotation::Frame(pose)) =
            (&body.inertia, body.rotation)
            && of(pose).is_some()
        {
            terms.push(dag.sum([*xx, *yy, *zz]));
        }
        if let Some(local) = &body.local
            && let Some(far) = of(local.pose)
        {
            terms.push(2 * body.mass * (far + length(&local.point)));
        }
    }
    let known = dag.sum(terms) * 4 / 3;
    if known.is_zero() {
        // Particles whose positions are not given in frames: the inertia that they would have at a
        // distance of a metre.
        dag.sum(model.bodies.iter().map(|body| body.mass)) * dag.int(1)
    } else {
        known
    }
}
