//! Derives the [`Equations`] of a [`Model`](lagrangian_spec::model::Model), lowers them to a [`Program`], and proves it.
//!
//! ```text
//! Model ─▶ Equations ─▶ Program ─▶ Proved
//!          equations    lower      proof
//! ```
//!
//! [`equations`] derives symbolically. [`mod@lower`] looks for the shortest exact way to compute the result, eliminates, and
//! writes straight-line arithmetic. [`proof`] compares the program with Lagrange's equations of the same machine; code that
//! prints or runs programs accepts only proved ones.

pub mod compile;
pub mod equations;
pub mod formulas;
pub mod lower;
pub mod proof;
mod quantities;
pub mod series;
mod states;

pub use compile::Compiled;
pub use equations::{
    BodyEquations, Brachistochronic, Carrying, ConstraintEquation, Dependent, Equations, Freedom,
    Independent, InertialPair, MOST_CONTACTS, MOST_COORDINATES, Oracle, OracleConstraint,
    OracleReaction, OracleSliding, Reaction, ReducedModel, Reduction, Route, SlidingEquation,
    SlidingGuide, Symmetric, UnmetCondition, Unprojected, angular_velocities, constraints,
    contradictions, dependents, freedom, groups, integrals,
};
#[cfg(doc)]
use lagrangian_program::Program;
pub use lower::{lower, lower_by, of_quantities};
pub use proof::disagreement::Disagreement;
pub use proof::symbolic::{POINTS, prove, prove_quantities};
pub use proof::{Proved, STATES, Uncharted, Unproved, Witness, prove_charts};
pub use quantities::{Quantity, quantities};
pub use states::around_start;
