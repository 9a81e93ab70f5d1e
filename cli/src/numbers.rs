//! Numbers as they are printed and written down.

use lagrangian::interpreted::Named;
pub use lagrangian_sweep::shortest;
use lagrangian_units::state_of;
use serde_json::{Map, Value};

/// States of first order by their names, of the rates of a machine; none where it has no states.
pub fn states(rates: &Named) -> Option<Value> {
    let states = rates.iter();
    let states = states.filter_map(|(name, value)| Some((state_of(name)?, value.into())));
    let states: Map<String, Value> = states.collect();
    (!states.is_empty()).then_some(Value::Object(states))
}

/// Numbers that have names, as an object of JSON; without those of integrals of states, which [`states`] has.
pub fn by_name(numbers: &Named) -> Value {
    Value::Object(
        numbers
            .iter()
            .filter(|(name, _)| state_of(name).is_none())
            .map(|(name, value)| (name.to_owned(), value.into()))
            .collect::<Map<_, _>>(),
    )
}
