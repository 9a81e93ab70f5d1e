//! Tests of expressions: construction, normal forms, derivatives, printing.

mod calculus;
mod construction;
mod normal;
mod printing;
#[path = "../support/mod.rs"]
mod support;
