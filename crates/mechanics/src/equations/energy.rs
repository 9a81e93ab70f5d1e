//! Energies and dissipation, each as the sum in textbooks.

use lagrangian_symbolic::{Expr, Tangent};

use super::kinematics::{Motion, apply_tensor, vector};
use lagrangian_spec::model::element::Energy;
use lagrangian_spec::model::{Body, Inertia, Model};

/// Kinetic energy of one body, eq. (E1): `T = ½ m ẋ·ẋ + ½ ωᵀI ω`, where `m` and `I` are constant
/// along the motion.
pub(super) fn kinetic_energy<'d>(body: &Body<'d>, motion: &Motion<'d>) -> Expr<'d> {
    kinetic_form(body, motion, motion) / 2
}

/// The symmetric bilinear form whose quadratic form is `2 T`: `m u·w + ω_uᵀ I ω_w`.
pub(super) fn kinetic_form<'d>(body: &Body<'d>, u: &Motion<'d>, w: &Motion<'d>) -> Expr<'d> {
    let rotation = match &body.inertia {
        Inertia::Particle => None,
        Inertia::Planar(inertia) => Some(*inertia * dot(&u.angular, &w.angular, body)),
        Inertia::Tensor(tensor) => (u.angular.len() == 3)
            .then(|| dot(&u.angular, &apply_tensor(tensor, &vector(&w.angular)), body)),
    };
    let translation = body.mass * dot(&u.linear, &w.linear, body);
    body.mass
        .dag()
        .sum([translation].into_iter().chain(rotation))
}

fn dot<'d>(u: &[Expr<'d>], w: &[Expr<'d>], body: &Body<'d>) -> Expr<'d> {
    body.mass
        .dag()
        .sum(u.iter().zip(w).map(|(&u_k, &w_k)| u_k * w_k))
}

/// Potential energy, eq. (E2): `V = Σ ½ c s² + Σ U − Σ m g·x`, over deformations `s` (a stretch or a
/// twist), given potentials, and bodies under gravity.
pub(super) fn potential_energy<'d>(model: &Model<'d>) -> Expr<'d> {
    let stored = model.stored().map(stored);
    model.dag.sum(stored.chain(weights(model)))
}

/// A term of the potential energy.
pub(super) fn stored<'d>(energy: &Energy<'d>) -> Expr<'d> {
    match energy {
        Energy::Quadratic(deformation) => deformation.energy(),
        Energy::Given(value) => *value,
    }
}

/// `−m g·x` of each body; none without gravity.
pub(super) fn weights<'d>(model: &Model<'d>) -> impl Iterator<Item = Expr<'d>> {
    model.gravity().into_iter().flat_map(|g| {
        let weight = |body: &Body<'d>| -body.mass * dot(g, &body.at, body);
        model.bodies.iter().map(weight)
    })
}

/// Rayleigh's dissipation function, eq. (E3): `D = Σ ½ b ṡ² + Σ R`, over damped deformations and given functions.
///
/// `rate` is the total derivative.
pub(super) fn dissipation<'d>(model: &Model<'d>, rate: &mut Tangent<'d>) -> Expr<'d> {
    model
        .dag
        .sum(model.dissipated().map(|energy| dissipated(energy, rate)))
}

/// A term of the dissipation function.
pub(super) fn dissipated<'d>(energy: &Energy<'d>, rate: &mut Tangent<'d>) -> Expr<'d> {
    match energy {
        Energy::Quadratic(damped) => damped.coefficient * rate.of(damped.measure).square() / 2,
        Energy::Given(value) => *value,
    }
}
