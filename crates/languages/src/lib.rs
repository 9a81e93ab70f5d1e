//! Emitters of programs in other languages than Rust: [`c`] writes C, and [`script`] languages for computation and symbolic formulas.
//!
//! No macro needs them, so that they are apart from `lagrangian-emit`, which every build of a machine compiles first.

pub mod c;
pub mod script;
