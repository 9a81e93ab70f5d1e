//! Expressions: made, normalized, differentiated, printed.

mod calculus;
mod construction;
mod normal;
mod printing;
#[path = "../support/mod.rs"]
mod support;
