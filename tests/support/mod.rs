//! Code that tests and benches of machines share: the library, references to many digits, random
//! numbers, error limits.
#![allow(dead_code, reason = "each test and each bench uses some of it")]

pub mod accuracy;
pub mod known_ends;
pub mod known_runs;
pub mod library;
pub mod limits;
pub mod random;
pub mod references;
pub mod sampling;
pub mod special;
pub mod states;

use std::path::Path;

/// The folder of the project: the one above the tests' package, and that of the package whose benches share this code.
pub fn root() -> &'static Path {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package
        .parent()
        .filter(|_| package.ends_with("tests"))
        .unwrap_or(package)
}
