//! The generalized-α method of structural dynamics, in steps of a fixed length.

use super::Tableau;

/// The fraction `ρ∞` of the amplitude of infinitely fast oscillations that a step leaves; slower ones are damped less.
#[cfg(feature = "std")]
pub(crate) const LEFT_AT_INFINITY: f64 = 0.8;

/// J. Chung, G. M. Hulbert, *A time integration algorithm for structural dynamics with improved numerical dissipation: the generalized-α
/// method*, J. Appl. Mech. 60 (1993) 371–375, eqs. (14), (15), (17), (25), in the form of M. Arnold, O. Brüls, *Convergence of the
/// generalized-α scheme for constrained mechanical systems*, Multibody Syst. Dyn. 18 (2007) 185–202, eqs. (4), (5). Constraints are treated
/// as by all methods here: accelerations satisfy them, and each step ends on them. The tableau holds the node and the weight by which work
/// and dissipation are integrated along the motion.
pub(super) const TABLEAU: Tableau = Tableau {
    name: "generalized-alpha",
    title: "generalized-α, ρ∞ = 0.8",
    order: 2,
    dense_order: 2,
    ..super::AT_MIDDLE
};
