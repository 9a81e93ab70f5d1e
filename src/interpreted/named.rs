//! Numbers with names and units, and how a call finds them by name.

use core::fmt;
use std::string::{String, ToString};
use std::sync::Arc;
use std::vec::Vec;

use lagrangian_program::{Program, Slot};
use lagrangian_spec::token::normalized;

use crate::Quantity;
use crate::names::UnknownName;

/// Numbers under the names of coordinates, inputs or outputs; a member of a family is called `q[3]`.
#[derive(Clone, PartialEq)]
pub struct Named {
    pub(super) labels: Arc<[Label]>,
    /// The numbers, in the order of the description.
    pub values: Vec<f64>,
}

/// Name and unit of a number.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Label {
    pub(super) name: String,
    pub(super) unit: String,
}

/// The names of the numbers of a machine, with their units.
#[derive(Debug)]
pub(super) struct Names {
    pub(super) parameters: Arc<[Label]>,
    pub(super) coordinates: Arc<[Label]>,
    pub(super) inputs: Arc<[Label]>,
    pub(super) outputs: Arc<[Label]>,
}

impl Names {
    /// Those of a program.
    pub(super) fn of(program: &Program) -> Names {
        Names {
            parameters: labels(&program.parameters),
            coordinates: labels(&program.coordinates),
            inputs: labels(&program.inputs),
            outputs: labels(&program.outputs),
        }
    }
}

impl Named {
    pub(super) fn new(labels: &Arc<[Label]>, values: Vec<f64>) -> Named {
        let labels = labels.clone();
        Named { labels, values }
    }

    /// The number of this name.
    pub fn get(&self, name: &str) -> Option<f64> {
        let name = &*normalized(name);
        let place = self.labels.iter().position(|label| label.name == name)?;
        self.values.get(place).copied()
    }

    /// Sets the number of this name; the name of a family sets all its members.
    ///
    /// # Errors
    /// If there is no such name.
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), UnknownName> {
        assign(self.labels.iter().zip(&mut self.values), name, value)
    }

    /// The unit of the number with this name, or of the members of the family; `None` if there is none.
    pub fn unit(&self, name: &str) -> Option<&str> {
        unit(self.labels.iter(), name)
    }

    /// The names with their numbers, in the order of the description.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&str, f64)> {
        let names = self.labels.iter().map(|label| label.name.as_str());
        names.zip(self.values.iter().copied())
    }
}

/// Serializes as a map from names to numbers.
#[cfg(feature = "serde")]
impl serde::Serialize for Named {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.iter())
    }
}

impl fmt::Debug for Named {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_map().entries(self.iter()).finish()
    }
}

/// Sets the number called `name`, or the members of the family called `name`.
pub(super) fn assign<'a>(
    numbers: impl Iterator<Item = (&'a Label, &'a mut f64)>,
    name: &str,
    value: f64,
) -> Result<(), UnknownName> {
    let mut known = Vec::new();
    let mut found = false;
    let name = &*normalized(name);
    for (label, number) in numbers {
        if label.is_meant_by(name) {
            *number = value;
            found = true;
        } else {
            known.push(label.name.clone());
        }
    }
    if found {
        Ok(())
    } else {
        Err(UnknownName::new(name, known.iter().map(String::as_str)))
    }
}

/// The unit of the first number that a name refers to.
pub(super) fn unit<'a>(mut labels: impl Iterator<Item = &'a Label>, name: &str) -> Option<&'a str> {
    let name = &*normalized(name);
    let label = labels.find(|label| label.is_meant_by(name));
    label.map(|label| label.unit.as_str())
}

impl Label {
    /// Whether a name, in the normal form of specs, is this label or the family that it belongs to.
    fn is_meant_by(&self, name: &str) -> bool {
        let family = self.name.split_once('[').map(|(base, _)| base);
        self.name == name || family == Some(name)
    }
}

fn labels(slots: &[Slot]) -> Arc<[Label]> {
    slots
        .iter()
        .map(|slot| Label {
            name: slot.name.to_string(),
            unit: slot.label(),
        })
        .collect()
}

pub(super) fn quantities(labels: &[Label]) -> impl ExactSizeIterator<Item = Quantity<'_>> {
    labels.iter().map(|label| Quantity {
        name: &label.name,
        unit: &label.unit,
    })
}
