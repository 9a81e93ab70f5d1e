//! Programs compute what they were lowered from, they are short, and the proof finds wrong ones.
#![allow(clippy::too_many_lines, reason = "a test reads from top to bottom")]

mod accuracy;
mod candidates;
mod charts;
mod constraints;
mod contact_series;
mod derivatives;
mod disguised;
mod friction;
mod harness;
mod held;
mod lowering;
mod machines;
mod proved;
mod quaternions;
mod running;
mod series;
mod stages;
mod steps;
mod tangents;
