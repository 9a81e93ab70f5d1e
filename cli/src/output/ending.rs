//! File extensions, which determine the format of the output.

use std::path::Path;

use crate::failure::Failure;

/// The extensions that an option accepts; the first is the format of outputs that are not files.
pub type Endings = &'static [&'static str];

/// A table.
#[cfg(feature = "parquet")]
pub const TABLE: Endings = &["csv", "parquet"];
/// A table, in a build without Parquet.
#[cfg(not(feature = "parquet"))]
pub const TABLE: Endings = &["csv"];

/// A linear model.
pub const MODEL: Endings = &["json", "npz", "mat", "csv"];

/// A periodic orbit: its numbers, or its motion as a table.
#[cfg(feature = "parquet")]
pub const ORBIT: Endings = &["json", "npz", "mat", "csv", "parquet"];
/// A periodic orbit, in a build without Parquet.
#[cfg(not(feature = "parquet"))]
pub const ORBIT: Endings = &["json", "npz", "mat", "csv"];

/// A spec.
pub const MACHINE: Endings = &["machine"];

/// A drawing.
pub const SVG: Endings = &["svg"];

/// A page for a browser.
pub const PAGE: Endings = &["html", "htm"];

/// A file of Rust.
pub const RUST: Endings = &["rs"];

/// A shared library, as systems call it.
pub const LIBRARY: Endings = &["so", "dylib", "dll"];

/// A functional mock-up unit.
pub const UNIT: Endings = &["fmu"];

/// The extension of a path as it is written in the list, ignoring case.
pub fn known(path: &Path, endings: Endings) -> Option<&'static str> {
    let ending = path.extension()?.to_str()?.to_ascii_lowercase();
    endings.iter().copied().find(|known| *known == ending)
}

/// Whether a path has one of these extensions.
pub fn ending_is_one_of(path: &Path, endings: Endings) -> bool {
    known(path, endings).is_some()
}

/// The failure for a path whose extension is not in the list.
pub fn unknown(option: &str, path: &Path, endings: Endings) -> Failure {
    let list: Vec<String> = endings
        .iter()
        .map(|ending| format!("`.{ending}`"))
        .collect();
    let found = match path.extension() {
        Some(ending) => format!("ends with `.{}`", ending.to_string_lossy()),
        None => "has no ending".to_owned(),
    };
    Failure::Call(format!(
        "{option} {}: the name {found}, but {option} writes {}",
        path.display(),
        list.join(" or ")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_ending_counts_and_its_case_does_not() {
        const TWO: Endings = &["csv", "parquet"];
        for (path, ending) in [
            ("run.csv", Some("csv")),
            ("a.b/RUN.PARQUET", Some("parquet")),
            ("run.Csv", Some("csv")),
            ("run.csv.gz", None),
            ("run.json", None),
            ("csv", None),
            (".csv", None),
            ("run.", None),
            ("a.csv/run", None),
        ] {
            assert_eq!(known(Path::new(path), TWO), ending, "{path}");
        }
    }
}
