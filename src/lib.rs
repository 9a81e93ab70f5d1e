//! The runtime of [`lagrangian`](https://docs.rs/lagrangian), which re-exports everything here beside the macro `machine!`; depend on that
//! crate instead.
//!
//! A [`System`] is the equations of motion of a machine, a [`Machine`] its parameters. [`Simulation`] integrates them and returns a
//! [`Solution`]: the state at every instant, events, and the energy balance. A [`Stepper`] takes single steps and needs no allocator.
//!
//! The runtime does not depend on the macro. Cargo compiles a crate after the macros that it re-exports and after all crates that these are
//! made of, so the runtime could otherwise not be compiled at the same time as the compiler of specs.
#![no_std]

#[cfg(feature = "std")]
extern crate std;

mod adapted;
mod at;
mod attempt;
mod balance;
#[cfg(feature = "std")]
mod callbacks;
mod charts;
mod compensated;
mod constraints;
#[cfg(feature = "std")]
mod contact;
mod contact_law;
mod control;
#[doc(hidden)]
pub mod emitted;
mod explicit;
mod forward;
mod friction;
#[cfg(feature = "std")]
mod implicit;
mod inputs;
mod interpolant;
mod lanes;
mod linearize;
mod machine;
mod math;
pub mod methods;
mod quantity;
mod sentences;
mod series_memory;
mod singular;
mod stages;
mod step_error;
mod step_number;
mod stepper;
mod system;
mod system_in;
#[cfg(feature = "std")]
mod taylor;
mod tolerance;
mod unilateral;
mod vector;

#[cfg(feature = "interpreter")]
pub mod interpreted;

#[cfg(feature = "nalgebra")]
pub mod matrices;

#[cfg(feature = "text")]
#[doc(hidden)]
pub mod files;

#[cfg(feature = "std")]
mod equations;
#[cfg(feature = "std")]
mod error;
#[cfg(feature = "std")]
mod evaluation;
#[cfg(feature = "std")]
mod event;
#[cfg(feature = "std")]
mod motion;
#[cfg(feature = "std")]
mod names;
#[cfg(feature = "std")]
mod observation;
#[cfg(feature = "std")]
mod phases;
mod piece;
#[cfg(feature = "std")]
mod roots;
#[cfg(feature = "std")]
mod run;
#[cfg(feature = "std")]
mod sensitivities;
#[cfg(feature = "std")]
mod settings;
#[cfg(feature = "std")]
mod shared_workspace;
#[cfg(feature = "std")]
mod simulation;
#[cfg(feature = "std")]
mod solution;
#[cfg(feature = "std")]
mod table;

pub use adapted::{Adapted, AdaptedSystem, HasFriction};
pub use at::At;
pub use balance::{
    ContactEnergies, Energies, EnergyBalance, EnergyIntegrals, NoBalance, Quadratures,
};
pub use charts::{Charted, to_cartesian, to_polar};
#[cfg(feature = "std")]
pub use charts::{ChartedSolution, Turns};
pub use constraints::{constraint_workspace, least_multipliers};
pub use control::Work;
pub use explicit::{Arrival, Ensemble, ExplicitStepper, ExplicitStepperBuilder, Trajectory};
pub use friction::{
    ContactForce, accelerations_with_friction, contact_forces, contact_workspace,
    contact_workspace_in_space, multipliers_with_friction,
};
#[cfg(feature = "std")]
pub use inputs::AnyInputs;
pub use inputs::{DefaultInputs, HeldInputs, InputFunction, InputLaw, InputLawIn};
pub use interpolant::Interpolant;
pub use lanes::{Batch, Batched, LaneVector, SomeSingular};
pub use linearize::{Differentiate, Linearize};
pub use machine::{Coordinates, Inputs, Machine, Outputs};
pub use methods::{FIXED_STEP_METHODS, METHODS, MOREAU, Method, RADAU_OF_HIGH_ORDER, TAYLOR};
pub use piece::{NoPiece, Piece};
pub use quantity::{Assumption, Constraint, Quantity, State};
pub use singular::{Pivot, Singular};
pub use step_error::StepError;
pub use step_number::{Real, StepNumber};
pub use stepper::{ControlledStepper, Stepper, StepperBuilder};
pub use system::{MOST_CONTACTS, Staged, System};
pub use system_in::{MachineIn, SystemIn};
pub use tolerance::{LEAST_RELATIVE_TOLERANCE, Tolerance};
pub use unilateral::{
    Compliance, ContactMode, ContactQuantity, ContactTrouble, ImpactLaw, ImpactOrder, Painleve,
    UnilateralContact,
};
pub use vector::Vector;

#[cfg(feature = "std")]
pub use contact::{
    ContactEvent, ContactEventKind, ContactImpact, ContactTally, ImpactAcross, UnilateralForce,
    loads_shared_otherwise, penetrations, unilateral_forces,
};
#[cfg(feature = "std")]
pub use equations::check_equations;
#[cfg(feature = "std")]
pub use error::{Error, KeptContradiction, Warning};
#[cfg(feature = "std")]
pub use evaluation::Evaluation;
#[cfg(feature = "std")]
pub use event::{Crossing, Event};
#[cfg(feature = "std")]
pub use motion::StepMotion;
#[cfg(feature = "std")]
pub use names::UnknownName;
#[cfg(feature = "std")]
pub use observation::Observation;
#[cfg(feature = "std")]
pub use phases::{ContactPhase, PhaseCause};
#[cfg(feature = "std")]
pub use roots::extremes;
#[cfg(feature = "std")]
pub use run::in_pieces::{PreparedRun, RunInPieces};
#[cfg(feature = "std")]
pub use sensitivities::{Sensitive, SensitiveSystem, Varied};
#[cfg(feature = "std")]
pub use settings::Progress;
#[cfg(feature = "std")]
pub use simulation::Simulation;
#[cfg(feature = "std")]
pub use solution::{Ending, Handover, MethodChoice, MethodReason, Solution, Statistics};
#[cfg(feature = "std")]
pub use table::{Extrapolation, Interpolation, Table, TableError, TableInputs};

pub use lagrangian_native::{self as native, Lanes, Number};
/// The numbers that emitted code is generic over.
pub use lagrangian_scalar as scalar;
pub use lagrangian_scalar::Scalar;

/// Compiles and runs the programs in the Markdown documents, in one compilation with the examples in this crate's own docs.
#[cfg(doctest)]
mod documentation {
    #[doc = include_str!("../README.md")]
    struct Readme;

    #[doc = include_str!("../docs/tutorial.md")]
    struct Tutorial;
}
