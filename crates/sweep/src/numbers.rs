//! Numbers formatted for output.

/// The shortest text that reads back to the same number.
pub fn shortest(x: f64) -> String {
    match x.abs() {
        size if size == 0.0 || (1e-4..1e9).contains(&size) => x.to_string(),
        _ => format!("{x:e}"),
    }
}
