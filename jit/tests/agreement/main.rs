//! Machine code gives the bits of the interpreter: for the machines of the library, and for functions that are random rows
//! of operations.
#![cfg(target_arch = "x86_64")]

mod check;
mod library;
mod pages;
mod random;
