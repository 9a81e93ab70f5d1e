//! Fits parameters and starts of a machine to measured motions.
//!
//! [`least_squares`] searches for the numbers that minimize residuals within bounds. [`statistics`] computes their
//! uncertainties, and [`combinations`] finds combinations that can be estimated where single numbers cannot. [`motion`]
//! provides the residuals of a machine against measured tables with their derivatives: the motion is integrated together with
//! its derivatives by everything that is fitted. [`searches`] starts from several points. The first three modules do not depend
//! on machines and serve any least-squares problem.

pub mod combinations;
pub mod least_squares;
pub mod motion;
pub mod searches;
pub mod statistics;

pub use nalgebra::{DMatrix, DVector};
