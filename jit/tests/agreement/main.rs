//! Machine code gives the bits of the interpreter, for the machines of the library, their series, and functions of random operations.
#![cfg(target_arch = "x86_64")]

mod check;
mod library;
mod pages;
mod random;
mod series;
