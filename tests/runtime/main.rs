//! Tests of the runtime on systems typed in by hand: motions, events, energy, methods, user errors.
#![allow(clippy::too_many_lines, reason = "a test reads from top to bottom")]

mod accuracy;
mod adapted;
mod allocations;
#[path = "../by_hand/mod.rs"]
mod by_hand;
mod control;
mod energy;
mod events;
mod fixed_steps;
mod matrices;
mod methods;
mod mistakes;
mod simulation;
mod specs;
mod stiff;
#[path = "../support/mod.rs"]
mod support;
mod tables;
mod touches;
mod travel;
