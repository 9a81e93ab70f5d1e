//! Tests of double-double numbers, dual numbers and intervals.

#[path = "../common/mod.rs"]
mod common;
mod double_double;
mod dual;
mod interval;
