//! Code that tests and benches of machines share: the library, references to many digits, random
//! numbers, error limits.
#![allow(dead_code, reason = "each test and each bench uses some of it")]

pub mod accuracy;
pub mod known_ends;
pub mod known_runs;
pub mod library;
pub mod limits;
pub mod random;
pub mod references;
pub mod sampling;
pub mod special;
pub mod states;
