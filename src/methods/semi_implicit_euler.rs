//! The semi-implicit method of Euler, in steps of a fixed length: one evaluation each, for loops of a fixed rate.

use super::Tableau;

/// `v₁ = v₀ + h a(t₀, q₀, v₀)`, `q₁ = q₀ + h v₁`.
///
/// E. Hairer, C. Lubich, G. Wanner, *Geometric Numerical Integration*, 2nd ed., 2006, section I.1.2, eq. (1.9). It is symplectic where the
/// mass matrix is constant and no force depends on rates. It is no method of Runge and Kutta: what stands here are the node and the weight by
/// which work and dissipation are integrated along the motion.
pub(super) const TABLEAU: Tableau = Tableau {
    name: "semi-implicit-euler",
    title: "semi-implicit Euler",
    order: 1,
    dense_order: 1,
    ..super::AT_MIDDLE
};
