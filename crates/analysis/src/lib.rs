//! Analysis of runs given as columns of numbers: the difference of two runs, the frequencies in one, its extremes, and the
//! times at which it crosses a value.
//!
//! This crate does not depend on machines. Times are in s and increase strictly; a missing value is NaN.

pub mod curve;
pub mod difference;
pub mod extremes;
pub mod spectrum;
mod transform;

pub use curve::Curve;
pub use difference::{Difference, difference};
pub use spectrum::{Line, Spectrum, Window};
