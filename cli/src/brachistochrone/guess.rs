//! A way to start from, as a table that the user gives.

use std::path::Path;

use crate::failure::Failure;
use crate::table;

/// The places of a table, one for each row: the columns that are named after coordinates.
///
/// # Errors
/// If it cannot be read, lacks a coordinate, or holds what is no number.
pub fn read(path: &Path, names: &[String]) -> Result<Vec<Vec<f64>>, Failure> {
    let wrong = |why: String| Failure::Call(format!("--guess {}: {why}", path.display()));
    let text = std::fs::read_to_string(path).map_err(|error| wrong(error.to_string()))?;
    let places = table::rows(&text, names).map_err(wrong)?;
    if places.len() < 2 {
        return Err(wrong(format!(
            "a way needs two rows of places at least, and here are {}",
            places.len()
        )));
    }
    Ok(places)
}
