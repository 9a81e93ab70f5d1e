//! From a [`Model`](lagrangian_spec::model::Model) to its [`Equations`], from these to a [`Program`], and its proof.
//!
//! ```text
//! Model ─▶ Equations ─▶ Program ─▶ Proved
//!          equations    lower      proof
//! ```
//!
//! [`equations`] derives, symbolically; [`mod@lower`] finds the shortest exact way to compute what was derived, eliminates, and
//! writes it down as straight-line arithmetic; [`proof`] holds the program against Lagrange's equations of this very machine,
//! and nothing that prints or runs programs takes one that it has not let pass.

pub mod compile;
pub mod equations;
pub mod formulas;
pub mod lower;
pub mod proof;
pub mod series;

pub use compile::Compiled;
pub use equations::{
    BodyEquations, Brachistochronic, Carrying, ConstraintEquation, Dependent, Equations, Freedom,
    Guided, Independent, InertialPair, MOST_CONTACTS, MOST_COORDINATES, Oracle, OracleConstraint,
    OracleReaction, OracleSliding, Reaction, ReducedModel, Reduction, Route, SlidingEquation,
    Symmetric, Unmet, Unprojected, angular_velocities, constraints, contradictions, dependents,
    freedom, groups, integrals,
};
#[cfg(doc)]
use lagrangian_program::Program;
pub use lower::states::around_start;
pub use lower::{Quantity, lower, lower_by, of_quantities, quantities};
pub use proof::symbolic::{Disagreement, POINTS, prove, prove_quantities};
pub use proof::{Proved, STATES, Unproved, Witness};
