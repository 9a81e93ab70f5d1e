//! What a program is printed as: [`rust`] is what the macro expands to and what `generated/` holds, [`c`] the same in C,
//! [`script`] the same in languages that people compute and write formulas in.

pub mod c;
pub mod layout;
pub mod rust;
pub mod script;

mod body;
mod cut;
mod names;

pub use names::{identifier, snake_case};
