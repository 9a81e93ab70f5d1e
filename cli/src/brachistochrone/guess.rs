//! A starting path for the search, from a table of the user.

use std::path::Path;

use lagrangian_program::Slot;

use crate::failure::Failure;
use crate::text_table::TextTable;
use crate::{heading, runs, table};

/// The positions in a table, one for each row, from the columns named after coordinates, in the units that the spec declares for them.
/// A column whose header has another unit is converted.
///
/// # Errors
/// If the table cannot be read, lacks a coordinate, has one in a unit that does not fit, or contains an entry that is not a number.
pub fn read(path: &Path, coordinates: &[Slot]) -> Result<Vec<Vec<f64>>, Failure> {
    let wrong = |why: String| Failure::Call(format!("--guess {}: {why}", path.display()));
    let text = std::fs::read_to_string(path).map_err(|error| wrong(error.to_string()))?;
    let names: Vec<String> = coordinates
        .iter()
        .map(|slot| slot.name.to_string())
        .collect();
    let mut places = table::rows(&text, &names).map_err(wrong)?;
    let headers = TextTable::new(&text).headers.into_iter();
    let headings: Vec<_> = headers.map(heading::name_and_unit).collect();
    for (column, (name, slot)) in names.iter().zip(coordinates).enumerate() {
        let found = headings.iter().find(|(heading, _)| heading == name);
        let Some((_, Some(written))) = found else {
            continue;
        };
        let unit = &slot.unit_text;
        let factor = runs::factor(written, unit).ok_or_else(|| {
            wrong(format!(
                "column `{name}`: expected a unit like {unit}, found {written}"
            ))
        })?;
        for place in &mut places {
            place[column] *= factor;
        }
    }
    if places.len() < 2 {
        return Err(wrong(format!(
            "a path needs at least two rows of positions, and the table has {}",
            places.len()
        )));
    }
    Ok(places)
}
