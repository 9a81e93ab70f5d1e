//! Headers of tables: names of columns, and their units.

use std::path::Path;

use crate::text_table::TextTable;

/// The name in a header, and its unit if there is one: `theta [rad]`.
pub fn name_and_unit(header: &str) -> (&str, Option<&str>) {
    let header = header.trim();
    let unit = header.rsplit_once(" [");
    match unit.and_then(|(name, unit)| Some((name, unit.strip_suffix(']')?))) {
        Some((name, unit)) => (name.trim_end(), Some(unit)),
        None => (header, None),
    }
}

/// The names in the header of a table of numbers; none if it cannot be read, which is reported where its numbers are used.
pub fn names_in(path: &Path) -> Vec<String> {
    let name = |header: &str| name_and_unit(header).0.to_owned();
    if path.extension().is_some_and(|ending| ending == "parquet") {
        let numbers = lagrangian_sweep::table::numbers(path);
        let headers = numbers.map_or_else(|_| Vec::new(), |(headers, _)| headers);
        return headers.iter().map(|header| name(header)).collect();
    }
    let text = std::fs::read_to_string(path).unwrap_or_default();
    let headers = TextTable::new(&text).headers;
    headers.iter().map(|header| name(header)).collect()
}
