//! Tests of fastest motions: the closed form, and the direct search.
#![allow(clippy::too_many_lines, reason = "a test reads from top to bottom")]

mod closed_form;
mod direct;
mod level;
mod terrains;
