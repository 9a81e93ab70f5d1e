//! The derivation, tested against Lagrange's equations, textbooks, and itself.
#![allow(clippy::too_many_lines, reason = "a test reads from top to bottom")]

mod approximations;
mod bushing;
mod by_hand;
mod energy;
mod freedom;
mod friction;
mod growth;
mod harness;
mod oracle;
mod paper;
mod parts;
mod published;
mod random_machines;
mod refusals;
mod shape;
mod textbooks;
mod ui;
