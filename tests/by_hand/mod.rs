//! Machines typed in by hand.

#![allow(dead_code, reason = "each test uses some of them")]

pub mod as_list;
pub mod constrained;
pub mod double_pendulum;
pub mod tampered;
pub mod toy;
pub mod train;
