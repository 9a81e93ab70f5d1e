//! Tests of the runtime on machines from the macro, and of the examples.

#[path = "../by_hand/mod.rs"]
mod by_hand;
mod charts;
mod constraints;
mod contacts;
mod derivatives;
mod ensembles;
mod examples;
mod lanes;
mod many_contacts;
mod sensitivities;
mod stages;
mod steps_in_numbers;
mod stiff_friction;
#[path = "../support/mod.rs"]
mod support;
