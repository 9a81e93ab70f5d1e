//! The generalized-α method, in steps of a fixed length: for those who come from structural dynamics.

use super::Tableau;

/// How much of the amplitude of infinitely fast oscillations a step leaves, `ρ∞`: the others are damped less.
#[cfg(feature = "std")]
pub(crate) const LEFT_AT_INFINITY: f64 = 0.8;

/// J. Chung, G. M. Hulbert, *A time integration algorithm for structural dynamics with improved numerical dissipation: the
/// generalized-α method*, J. Appl. Mech. 60 (1993) 371–375, eqs. (14), (15), (17), (25), in the form of M. Arnold, O. Brüls, *Convergence of the generalized-α scheme for
/// constrained mechanical systems*, Multibody Syst. Dyn. 18 (2007) 185–202, eqs. (4), (5). Constraints are kept as by all methods here:
/// accelerations obey them, and each step ends on them. What stands here are the node and the weight by which work and dissipation are
/// integrated along the motion.
pub(super) const TABLEAU: Tableau = Tableau {
    name: "generalized-alpha",
    title: "generalized-α, ρ∞ = 0.8",
    order: 2,
    dense_order: 2,
    ..super::AT_MIDDLE
};
