//! Properties of every machine of the library, in several kinds of numbers: rounding, lanes,
//! loops, the choice among programs.

mod choice;
mod lanes;
mod loops;
mod rounding;
#[path = "../support/mod.rs"]
mod support;
