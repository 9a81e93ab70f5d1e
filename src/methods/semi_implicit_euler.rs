//! The semi-implicit Euler method, in steps of a fixed length with one evaluation each, for loops of a fixed rate.

use super::Tableau;

/// `v₁ = v₀ + h a(t₀, q₀, v₀)`, `q₁ = q₀ + h v₁`.
///
/// E. Hairer, C. Lubich, G. Wanner, *Geometric Numerical Integration*, 2nd ed., 2006, section I.1.2, eq. (1.9). It is symplectic if the
/// mass matrix is constant and no force depends on rates. It is not a Runge–Kutta method: the tableau holds the node and the weight by
/// which work and dissipation are integrated along the motion.
pub(super) const TABLEAU: Tableau = Tableau {
    name: "semi-implicit-euler",
    title: "semi-implicit Euler",
    order: 1,
    dense_order: 1,
    ..super::AT_MIDDLE
};
