//! Numbers as they are printed and written down.

use lagrangian::interpreted::Named;
pub use lagrangian_sweep::shortest;
use serde_json::{Map, Value};

/// Numbers that have names, as an object of JSON.
pub fn by_name(numbers: &Named) -> Value {
    Value::Object(
        numbers
            .iter()
            .map(|(name, value)| (name.to_owned(), value.into()))
            .collect::<Map<_, _>>(),
    )
}
