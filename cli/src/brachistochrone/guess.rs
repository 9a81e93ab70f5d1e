//! A starting path for the search, from a table of the user.

use std::path::Path;

use crate::failure::Failure;
use crate::table;

/// The positions in a table, one for each row, from the columns named after coordinates.
///
/// # Errors
/// If the table cannot be read, lacks a coordinate, or contains an entry that is not a number.
pub fn read(path: &Path, names: &[String]) -> Result<Vec<Vec<f64>>, Failure> {
    let wrong = |why: String| Failure::Call(format!("--guess {}: {why}", path.display()));
    let text = std::fs::read_to_string(path).map_err(|error| wrong(error.to_string()))?;
    let places = table::rows(&text, names).map_err(wrong)?;
    if places.len() < 2 {
        return Err(wrong(format!(
            "a path needs at least two rows of positions, and the table has {}",
            places.len()
        )));
    }
    Ok(places)
}
