//! What a program is printed as.
//!
//! [`rust`] is what the macro expands to and what `generated/` holds; [`c`] the same in C; [`markdown`], [`latex`] and [`html`]
//! are the derivation for reading.

pub mod c;
pub mod document;
pub mod formulas;
pub mod html;
pub mod latex;
pub mod layout;
pub mod markdown;
pub mod rust;

mod body;
mod chapter;
mod cut;
mod names;

pub use names::{identifier, snake_case};
