//! Numbers formatted for printing and for JSON.

use lagrangian::interpreted::Named;
pub use lagrangian_sweep::shortest;
use lagrangian_units::state_of;
use serde_json::{Map, Value};

/// A number with six digits, or fewer if exact.
pub fn number(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    match rounded.abs() {
        0.0 => "0".into(),
        1e-3..1e6 => format!("{rounded}"),
        _ => format!("{rounded:e}"),
    }
}

/// A unit as it stands after a number: ` m`; nothing for a bare number.
pub fn after_number(unit: &str) -> String {
    match unit {
        "1" => String::new(),
        unit => format!(" {unit}"),
    }
}

/// The name under which a coordinate is shown: that of the state whose integral it is, or its own.
pub fn shown_name(coordinate: &str) -> String {
    state_of(coordinate).unwrap_or_else(|| coordinate.to_owned())
}

/// The greatest length of the names under which coordinates are shown.
pub fn width_of_names<'n>(coordinates: impl Iterator<Item = &'n str>) -> usize {
    let lengths = coordinates.map(|name| shown_name(name).chars().count());
    lengths.max().unwrap_or(0)
}

/// The states of first order by name, from the rates of a machine; `None` if it has no states.
pub fn states(rates: &Named) -> Option<Value> {
    let states = rates.iter();
    let states = states.filter_map(|(name, value)| Some((state_of(name)?, value.into())));
    let states: Map<String, Value> = states.collect();
    (!states.is_empty()).then_some(Value::Object(states))
}

/// Named numbers as a JSON object, without integrals of states, which are in [`states`].
pub fn by_name(numbers: &Named) -> Value {
    Value::Object(
        numbers
            .iter()
            .filter(|(name, _)| state_of(name).is_none())
            .map(|(name, value)| (name.to_owned(), value.into()))
            .collect::<Map<_, _>>(),
    )
}
