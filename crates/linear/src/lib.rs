//! Where a machine stays or moves steadily, how it moves about that place, and its linear model there.
//!
//! [`steady::motion`] finds an equilibrium or a steady motion and the modes about it; [`model`] makes matrices A, B, C, D of it, or of
//! any other state; [`poles`], [`zeros`] and [`response`] are what is asked of these. Derivatives are exact: everything is
//! evaluated over dual numbers of 32 digits, never over differences of finite steps. [`orbit`] finds periodic motions and their
//! multipliers, by integration of the variational equations; [`varied`] has these for whatever a motion depends on, and [`across`] takes them across
//! impacts and other changes of unilateral contacts.

pub mod across;
mod chart;
pub mod model;
pub mod motion;
pub mod orbit;
pub mod poles;
mod precise;
mod rank;
pub mod reduced;
pub mod response;
pub mod search;
pub mod spectrum;
pub mod starts;
pub mod steady;
pub mod varied;
pub mod zeros;

#[cfg(test)]
mod tests;

pub use nalgebra::{Complex, DMatrix, DVector};
