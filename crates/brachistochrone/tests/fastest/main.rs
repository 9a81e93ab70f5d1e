//! Tests of fastest motions: the closed form, and the direct search.

mod closed_form;
mod direct;
mod level;
mod terrains;
