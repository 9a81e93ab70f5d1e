//! The language: its syntax, and what is resolved.

mod resolve;
mod syntax;
