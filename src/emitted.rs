//! What emitted code names, under one path. It is no interface for others: it changes with the compiler, whose code is made for
//! the runtime of the same version.

pub mod series;

pub use crate::constraints::constraint_workspace;
pub use crate::friction::{
    accelerations_with_friction, contact_workspace, multipliers_with_friction,
};
pub use crate::{
    Assumption, Batched, Compliance, Constraint, Differentiate, ImpactLaw, ImpactOrder, Lanes,
    Linearize, Machine, MachineIn, Number, Painleve, Quantity, Real, Scalar, Singular, Staged,
    State, System, SystemIn, UnilateralContact, scalar,
};
