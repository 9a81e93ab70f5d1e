//! The runtime on systems by hand and on machines of macros: motions, events, energy, methods, mistakes.

mod accuracy;
mod allocations;
#[path = "../by_hand/mod.rs"]
mod by_hand;
mod constraints;
mod derivatives;
mod energy;
mod events;
mod examples;
mod matrices;
mod methods;
mod mistakes;
mod rounding;
mod sensitivities;
mod simulation;
mod stages;
mod stiff;
mod stiff_friction;
#[path = "../support/mod.rs"]
mod support;
