//! Emitted code: C against the interpreter, loops, and what is skipped.

mod c;
mod loops;
mod series;
mod skipping;
