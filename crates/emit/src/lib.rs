//! Emitters of programs: [`rust`] writes what the macro expands to and what `generated/` contains, [`c`] writes the same
//! in C, and [`script`] writes it in languages for computation and symbolic formulas.

pub mod c;
pub mod layout;
pub mod rust;
pub mod script;

mod body;
mod cut;
mod formula_names;
mod names;

pub use names::{identifier, snake_case};
