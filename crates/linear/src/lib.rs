//! Equilibria and steady motions of a machine, the modes about them, linear models, and periodic orbits.
//!
//! [`steady::motion`] finds an equilibrium or a steady motion and the modes about it. [`model`] makes the matrices A, B, C, D of a
//! linear model there or at any other state; [`poles`], [`zeros`] and [`response`] evaluate such a model. Derivatives are exact:
//! everything is evaluated over dual numbers of 32 digits, never by finite differences. [`orbit`] finds periodic motions and their
//! multipliers by integrating the variational equations. [`varied`] sets these equations up for derivatives by anything that a
//! motion depends on, [`across`] continues them across impacts and other changes of unilateral contacts, and [`charts`] maps them between
//! polar and Cartesian coordinates.

pub mod across;
mod chart;
pub mod charts;
pub mod model;
pub mod motion;
pub mod orbit;
pub mod reduced;
pub mod response;
pub mod search;
pub mod starts;
pub mod steady;
pub mod varied;
pub mod zeros;

pub use lagrangian_eigen::{poles, spectrum};
pub use nalgebra::{Complex, DMatrix, DVector};
