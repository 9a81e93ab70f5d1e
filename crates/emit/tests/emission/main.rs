//! Tests of emitted code: C compared with the interpreter, loops, and features
//! that leave no code when absent.
#![allow(clippy::too_many_lines, reason = "a test reads from top to bottom")]

mod c;
mod charts;
mod loops;
mod series;
mod skipping;
mod steps;
