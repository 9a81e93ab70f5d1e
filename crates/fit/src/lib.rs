//! Parameters and starts of a machine from measured motions.
//!
//! [`least_squares`] looks for the numbers that make residuals least, within bounds; [`statistics`] says how exact they are and
//! [`combinations`] what can be told where single numbers cannot. [`motion`] has the residuals of a machine against measured
//! tables, with their derivatives: the motion is integrated together with its derivatives by everything that is fitted;
//! [`searches`] begins at several places. The first three modules know nothing of machines, and serve any problem of least
//! squares.

pub mod combinations;
pub mod least_squares;
pub mod motion;
pub mod searches;
pub mod statistics;

pub use nalgebra::{DMatrix, DVector};
