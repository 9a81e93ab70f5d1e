//! The library of machines: evaluated, run, and held against closed forms, publications and more digits.

mod choice;
mod crushers;
mod friction;
mod lanes;
mod library;
mod loops;
mod mechanisms;
mod motions;
mod peers;
mod stress;
#[path = "../support/mod.rs"]
mod support;
mod taylor;
