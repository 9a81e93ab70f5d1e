//! RATTLE, in steps of a fixed length, for long runs of conservative machines, with or without constraints.

use super::Tableau;

/// The Störmer–Verlet method in momenta, with constraints: of order 2, symplectic and symmetric.
///
/// E. Hairer, C. Lubich, G. Wanner, *Geometric Numerical Integration*, 2nd ed., 2006, section VII.1.4, eq. (1.26). It is the
/// variational integrator of the discrete Lagrangian `h/2 (L(q₀, v) + L(q₁, v))`, section VI.6.2, so momenta of symmetries are
/// conserved to rounding. The tableau holds the node and the weight by which work and dissipation are integrated along the motion.
pub(super) const TABLEAU: Tableau = Tableau {
    name: "rattle",
    title: "Rattle (Störmer–Verlet with constraints)",
    order: 2,
    dense_order: 2,
    ..super::AT_MIDDLE
};
