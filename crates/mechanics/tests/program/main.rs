//! Programs: that they compute what they were made from, that they are short, and that a wrong one is found out.

mod accuracy;
mod candidates;
mod constraints;
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
mod tangents;
