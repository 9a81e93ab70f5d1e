//! What a program is printed as: [`rust`] is what the macro expands to and what `generated/` holds, [`c`] the same in C.

pub mod c;
pub mod layout;
pub mod rust;

mod body;
mod cut;
mod names;

pub use names::{identifier, snake_case};
