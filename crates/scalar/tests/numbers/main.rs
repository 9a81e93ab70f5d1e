//! Numbers: double-double, dual numbers, intervals.

#[path = "../common/mod.rs"]
mod common;
mod double_double;
mod dual;
mod interval;
