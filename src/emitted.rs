//! The names that emitted code uses, under one path. This is not a public interface: it changes with the compiler, whose code
//! requires the runtime of the same version.

mod contacts;
mod implement;
mod pivots;
pub mod series;
mod values;

pub use crate::constraints::constraint_workspace;
pub use crate::friction::{
    accelerations_with_friction, contact_workspace, contact_workspace_in_space,
    multipliers_with_friction,
};
pub use crate::implement_charted as charted;
pub use crate::implement_machine as implement;
pub use crate::native::fast_function;
pub use crate::{
    Assumption, Batched, Charted, Compliance, Constraint, ContactQuantity, Differentiate,
    ImpactLaw, ImpactOrder, Lanes, Linearize, Machine, MachineIn, Number, Painleve, Quantity, Real,
    Scalar, Singular, Staged, State, System, SystemIn, UnilateralContact, scalar,
};
pub use contacts::{ContactPart, ContactParts, put};
pub use pivots::Pivots;
pub use values::{
    ConstraintRow, PreparedField, assumptions, constraint, fill, fill_ranges, hold, intervals,
    rounded, run_into, side_by_side, values,
};
