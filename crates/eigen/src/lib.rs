//! Eigenvalues, singular values and modes of real matrices to the last digit that their entries determine.
//!
//! [`precise`] finds eigenvalues with 32 digits, and bounds on what the entries determine of them; [`poles`] those of a matrix whose
//! entries have very different sizes. [`spectrum`] finds the modes of `ẍ = K x + C ẋ`, with free directions and constraints on
//! rates, and [`rank`] the directions that a matrix maps to round-off only. Nothing here knows of machines.

pub mod poles;
pub mod precise;
pub mod rank;
pub mod spectrum;

pub use nalgebra::{Complex, DMatrix, DVector};
