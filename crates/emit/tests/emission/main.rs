//! Tests of emitted code: C compared with the interpreter, loops, and features
//! that leave no code when absent.

mod c;
mod charts;
mod loops;
mod series;
mod skipping;
mod steps;
