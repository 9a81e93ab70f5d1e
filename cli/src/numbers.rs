//! Numbers as they are printed and written down.

use lagrangian::interpreted::Named;
use serde_json::{Map, Value};

/// The shortest text that reads back to the same number.
pub fn shortest(x: f64) -> String {
    match x.abs() {
        size if size == 0.0 || (1e-4..1e9).contains(&size) => x.to_string(),
        _ => format!("{x:e}"),
    }
}

/// Numbers that have names, as an object of JSON.
pub fn by_name(numbers: &Named) -> Value {
    Value::Object(
        numbers
            .iter()
            .map(|(name, value)| (name.to_owned(), value.into()))
            .collect::<Map<_, _>>(),
    )
}
