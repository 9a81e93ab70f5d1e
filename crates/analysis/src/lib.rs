//! What is asked of runs that are there as columns of numbers: how far two are apart, which frequencies are in one, where its
//! extremes are, and where it passes a value.
//!
//! Nothing here knows of machines. Times are in s and increase strictly; values may be NaN where there is none.

pub mod curve;
pub mod difference;
pub mod extremes;
pub mod spectrum;
mod transform;

pub use curve::Curve;
pub use difference::{Difference, difference};
pub use spectrum::{Line, Spectrum, Window};
