//! Tests of the language: syntax and name resolution.

mod resolve;
mod syntax;
