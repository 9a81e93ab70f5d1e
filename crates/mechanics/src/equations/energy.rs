//! Energies and dissipation, each the sum that a textbook writes.

use lagrangian_symbolic::{Expr, Tangent};

use super::kinematics::{Motion, apply_tensor, vector};
use lagrangian_spec::model::{Body, Inertia, Model};

/// Kinetic energy of one body, eq. (E1): `T = ½ m ẋ·ẋ + ½ ωᵀI ω`, where `m` and `I` are constant
/// along the motion.
pub(super) fn kinetic_energy<'d>(body: &Body<'d>, motion: &Motion<'d>) -> Expr<'d> {
    kinetic_form(body, motion, motion) / 2
}

/// The symmetric bilinear form of which `T` is half the square: `m u·w + ω_uᵀ I ω_w`.
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

/// Potential energy, eq. (E2): `V = Σ ½ c s² + Σ U − Σ m g·x`, over springs of stretch (or twist)
/// `s`, given potentials, and bodies under gravity.
pub(super) fn potential_energy<'d>(model: &Model<'d>) -> Expr<'d> {
    let springs = model
        .springs
        .iter()
        .map(|spring| spring.coefficient * spring.stretch.square() / 2);
    let potentials = model.potentials.iter().map(|potential| potential.value);
    let gravity = model.gravity.iter().flat_map(|g| {
        let weight = |body: &Body<'d>| -body.mass * dot(g, &body.at, body);
        model.bodies.iter().map(weight)
    });
    model.dag.sum(springs.chain(potentials).chain(gravity))
}

/// Rayleigh's dissipation function, eq. (E3): `D = Σ ½ b ṡ² + Σ R`, over dampers and given
/// functions.
///
/// `rate` is the total derivative.
pub(super) fn dissipation<'d>(model: &Model<'d>, rate: &mut Tangent<'d>) -> Expr<'d> {
    let dampers: Vec<Expr<'d>> = model
        .dampers
        .iter()
        .map(|damper| damper.coefficient * rate.of(damper.stretch).square() / 2)
        .collect();
    let given = model
        .dissipations
        .iter()
        .map(|dissipation| dissipation.value);
    model.dag.sum(dampers.into_iter().chain(given))
}
