//! Emitters of programs: [`rust`] writes what the macro expands to and what `generated/` contains. The other modules are what it shares
//! with the emitters of other languages.

pub mod body;
pub mod cut;
pub mod formula_names;
pub mod layout;
pub mod names;
pub mod rust;

pub use names::{identifier, snake_case};
