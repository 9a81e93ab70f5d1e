//! What work is done, so that a run can balance its energy.
//!
//! Along every motion `d(T + V + E)/dt = P − R` (E20): `P` is the power of forces, torques, inputs and
//! of whatever moves the machine by explicit time, and what supplies states of first order; `R` the power that dampers
//! and losses take; E what states store. Both are
//! derived so that the balance is an identity, not an approximation; what a machine does not have
//! gives exactly zero, and no instruction.

use lagrangian_symbolic::Expr;

use super::kinematics::Variables;
use super::projected::{Loads, Projection};
use lagrangian_spec::model::Model;

/// Power that dissipation takes, eq. (E18): `R = Σ vᵢ ∂D/∂vᵢ`, which is `2D` where `D` is
/// quadratic; and what is lost beside.
pub(super) fn dissipation_rate<'d>(
    model: &Model<'d>,
    x: &Variables<'d>,
    dissipation: Expr<'d>,
) -> Expr<'d> {
    let dampers = x.virtual_rates(model).of(dissipation);
    model.dag.sum([dampers].into_iter().chain(model.losses()))
}

/// The power that states of first order need, eq. (E60): how what they store changes along the motion, with their rates
/// as they are given, and what is lost beside.
fn state_power<'d>(model: &Model<'d>, x: &Variables<'d>) -> Expr<'d> {
    let mut rate = x.along_states(model);
    let stored = model.energies_of_states().map(|energy| rate.of(energy));
    let stored: Vec<Expr<'d>> = stored.collect();
    model.dag.sum(stored.into_iter().chain(model.losses()))
}

/// Power of applied forces and torques along the virtual motion: `Σ Fᵢ vᵢ`, dampers and potentials
/// not among them.
pub(super) fn force_power<'d>(projection: &Projection<'_, 'd>) -> Expr<'d> {
    let mut loads = Loads::default();
    projection.add_forces(&mut loads);
    projection.power(&loads)
}

/// Power of what drives, eq. (E19), on the projected route: `P = Σ Fᵢ vᵢ + ∂V/∂t + Σ w (D²p)
/// ∂p/∂t`.
///
/// `dT/dt = Σ w u Du` with `u = Σ vᵢ ∂p/∂qᵢ + ∂p/∂t`; by (E13) the first part gives `Σ vᵢ Qᵢ`, and
/// `dV/dt = Σ vᵢ ∂V/∂qᵢ + ∂V/∂t`.
pub(super) fn work_rate<'d>(
    model: &Model<'d>,
    x: &Variables<'d>,
    projection: &Projection<'_, 'd>,
    potential_energy: Expr<'d>,
) -> Expr<'d> {
    let explicit = x.explicit(model).of(potential_energy);
    model.dag.sum([
        force_power(projection),
        explicit,
        projection.drive_power(),
        state_power(model, x),
    ])
}

/// The power of forces and drives from energies, for any `T`: `P = Σ Fᵢ vᵢ + ∂V/∂t − ∂T/∂t + D(T₁ + 2 T₀)`.
///
/// By Lagrange's equations `d/dt (Σ vᵢ ∂T/∂vᵢ − T) = Σ vᵢ Qᵢ − ∂T/∂t`. With `T = T₂ + T₁ + T₀` by
/// powers of `v` the bracket is `T₂ − T₀`, and `T₁ + 2 T₀ = Σ m u·∂x/∂t` is what is missing to `T`;
/// it is given, `driven`, because so it vanishes without being simplified where nothing is driven.
pub(super) fn work_rate_of_energies<'d>(
    model: &Model<'d>,
    x: &Variables<'d>,
    projection: &Projection<'_, 'd>,
    [kinetic_energy, potential_energy, driven]: [Expr<'d>; 3],
) -> Expr<'d> {
    let mut explicit = x.explicit(model);
    let change = explicit.of(potential_energy) - explicit.of(kinetic_energy);
    model.dag.sum([
        force_power(projection),
        change,
        x.total(model).of(driven),
        state_power(model, x),
    ])
}
