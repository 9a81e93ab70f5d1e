//! The machines of the library run and are compared with closed forms, publications and
//! results in higher precision.
#![allow(clippy::too_many_lines, reason = "a test reads from top to bottom")]

mod closed_series;
mod collisions;
mod crushers;
mod emitted_series;
mod flights;
mod formulations;
mod friction;
mod guides_and_contacts;
mod guides_in_time_steps;
mod guides_on_paths;
mod in_pieces;
mod known_runs;
mod library;
mod long_runs;
mod mechanisms;
mod motions;
mod peers;
mod piles;
mod projections;
mod series_on_demand;
mod stress;
#[path = "../support/mod.rs"]
mod support;
mod taylor;
