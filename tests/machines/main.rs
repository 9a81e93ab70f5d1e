//! The machines of the library run, and are held against closed forms, publications and more digits.

mod collisions;
mod crushers;
mod emitted_series;
mod friction;
mod known_runs;
mod library;
mod mechanisms;
mod motions;
mod peers;
mod stress;
#[path = "../support/mod.rs"]
mod support;
mod taylor;
