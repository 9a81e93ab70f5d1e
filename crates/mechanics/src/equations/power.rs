//! Powers of forces and drives, from which a run computes its energy balance.
//!
//! Along every motion `d(T + V + E)/dt = P − R` (E20): `P` is the power of forces, torques, inputs, of drives by
//! explicit time, and of the supply of first-order states; `R` is the power that dampers and losses take; `E` is the
//! energy stored in states. Both are derived so that the balance is an identity, not an approximation. A kind of force
//! that a machine does not have gives exactly zero, and no instruction.

use lagrangian_symbolic::Expr;

use super::kinematics::Variables;
use super::projected::{Loads, Projection};
use lagrangian_spec::model::Model;

/// Power taken by dissipation, eq. (E18): `R = Σ vᵢ ∂D/∂vᵢ`, which is `2D` if `D` is quadratic; and
/// the power of other losses.
pub(super) fn dissipation_rate<'d>(
    model: &Model<'d>,
    x: &Variables<'d>,
    dissipation: Expr<'d>,
) -> Expr<'d> {
    let dampers = x.virtual_rates(model).of(dissipation);
    model.dag.sum([dampers].into_iter().chain(model.losses()))
}

/// The power that first-order states need, eq. (E60): the rate of their stored energy along the motion, with their
/// given rates, plus the power of other losses.
fn state_power<'d>(model: &Model<'d>, x: &Variables<'d>) -> Expr<'d> {
    let mut rate = x.along_states(model);
    let stored = model.energies_of_states().map(|energy| rate.of(energy));
    let stored: Vec<Expr<'d>> = stored.collect();
    model.dag.sum(stored.into_iter().chain(model.losses()))
}

/// Power of applied forces and torques along the virtual motion: `Σ Fᵢ vᵢ`, without dampers and potentials.
pub(super) fn force_power<'d>(projection: &Projection<'_, 'd>) -> Expr<'d> {
    let mut loads = Loads::default();
    projection.add_forces(&mut loads);
    projection.power(&loads)
}

/// Power of drives, eq. (E19), on the projected route: `P = Σ Fᵢ vᵢ + ∂V/∂t + Σ w (D²p) ∂p/∂t`.
///
/// `dT/dt = Σ w u Du` with `u = Σ vᵢ ∂p/∂qᵢ + ∂p/∂t`; by (E13) the first part gives `Σ vᵢ Qᵢ`, and
/// `dV/dt = Σ vᵢ ∂V/∂qᵢ + ∂V/∂t`.
pub(super) fn work_rate<'d>(
    model: &Model<'d>,
    x: &Variables<'d>,
    projection: &Projection<'_, 'd>,
    potential_energy: Expr<'d>,
) -> Expr<'d> {
    let explicit = x.explicit_time(model).of(potential_energy);
    model.dag.sum([
        force_power(projection),
        explicit,
        projection.drive_power(),
        state_power(model, x),
    ])
}

/// The power of forces and drives from energies, for any `T`: `P = Σ Fᵢ vᵢ + ∂V/∂t − ∂T/∂t + D(T₁ + 2 T₀)`.
///
/// By Lagrange's equations `d/dt (Σ vᵢ ∂T/∂vᵢ − T) = Σ vᵢ Qᵢ − ∂T/∂t`. With `T = T₂ + T₁ + T₀` by powers of
/// `v` the bracket is `T₂ − T₀`, so `T₁ + 2 T₀ = Σ m u·∂x/∂t` has to be added to give `T`. It is passed in
/// as `driven`, because in that form it vanishes without simplification if nothing is driven.
pub(super) fn work_rate_of_energies<'d>(
    model: &Model<'d>,
    x: &Variables<'d>,
    projection: &Projection<'_, 'd>,
    [kinetic_energy, potential_energy, driven]: [Expr<'d>; 3],
) -> Expr<'d> {
    let mut explicit = x.explicit_time(model);
    let change = explicit.of(potential_energy) - explicit.of(kinetic_energy);
    model.dag.sum([
        force_power(projection),
        change,
        x.total(model).of(driven),
        state_power(model, x),
    ])
}
