//! The runtime on systems by hand: motions, events, energy, methods, mistakes.

mod accuracy;
mod allocations;
#[path = "../by_hand/mod.rs"]
mod by_hand;
mod energy;
mod events;
mod matrices;
mod methods;
mod mistakes;
mod simulation;
mod stiff;
#[path = "../support/mod.rs"]
mod support;
