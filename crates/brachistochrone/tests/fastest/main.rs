//! Fastest motions: the closed form, and the search without one.

mod closed_form;
mod direct;
mod level;
