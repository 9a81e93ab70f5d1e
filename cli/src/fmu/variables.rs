//! The variables of a unit, in the order of their references; `fmu/c/runtime.c` counts them in the same way.

use std::collections::BTreeSet;

use lagrangian_program::Program;
use lagrangian_units::state_of;

use super::run::OF_CONTACTS;
use crate::call::Assignment;
use crate::failure::Failure;

/// The kind of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VariableKind {
    Time,
    Coordinate(usize),
    Rate(usize),
    Acceleration(usize),
    Parameter(usize),
    Input(usize),
    Output(usize),
    Multiplier(usize),
    KineticEnergy,
    PotentialEnergy,
    Fact(usize),
    /// The formula of an event.
    Event(usize),
    /// The number of occurrences of an event.
    Count(usize),
    /// A quantity of a contact: the indices of the contact and of the quantity.
    OfContact(usize, usize),
}

/// A variable; its reference is its index.
#[derive(Clone, Debug)]
pub struct Variable {
    pub kind: VariableKind,
    /// The name by the naming convention.
    pub name: String,
    /// Whether it is an output of the unit.
    pub is_output: bool,
}

/// All variables of a unit.
pub struct Variables {
    pub all: Vec<Variable>,
    /// Whether every name follows the structured naming convention.
    pub is_structured: bool,
}

impl Variables {
    /// The variables of a machine. The outputs are those of its spec or, if there are none, its coordinates. The last outputs of
    /// the program are the formulas of events; `contacts` are those of a run.
    pub fn new(program: &Program, events: &[Assignment], contacts: &[String]) -> Variables {
        let names = |slots: &[lagrangian_program::Slot]| -> Vec<String> {
            let names = slots.iter().map(|slot| slot.name.to_string());
            names.map(|name| structured(&name)).collect()
        };
        let coordinates = names(&program.coordinates);
        let shown = &program.outputs[..program.outputs.len() - events.len()];
        let has_outputs = !shown.is_empty();
        let mut all = vec![(VariableKind::Time, "time".to_owned())];
        let each = |names: &[String], kind: fn(usize) -> VariableKind, form: fn(&str) -> String| {
            let names = names.iter().enumerate();
            names
                .map(|(i, name)| (kind(i), form(name)))
                .collect::<Vec<_>>()
        };
        all.extend(each(&coordinates, VariableKind::Coordinate, str::to_owned));
        // A state of first order is the rate of its integral.
        let states = program.coordinates.iter();
        let states = states.map(|slot| Some(structured(&state_of(&slot.name.to_string())?)));
        let states: Vec<Option<String>> = states.collect();
        let rates = coordinates.iter().zip(&states).enumerate();
        all.extend(rates.clone().map(|(i, (name, state))| {
            let rate = state.clone().unwrap_or_else(|| format!("der({name})"));
            (VariableKind::Rate(i), rate)
        }));
        all.extend(rates.map(|(i, (name, state))| {
            let rate = match state {
                Some(state) => format!("der({state})"),
                None => format!("der({name},2)"),
            };
            (VariableKind::Acceleration(i), rate)
        }));
        all.extend(each(
            &names(&program.parameters),
            VariableKind::Parameter,
            str::to_owned,
        ));
        all.extend(each(
            &names(&program.inputs),
            VariableKind::Input,
            str::to_owned,
        ));
        all.extend(each(&names(shown), VariableKind::Output, str::to_owned));
        let constraints = program.constraints.iter().enumerate();
        all.extend(constraints.map(|(i, constraint)| {
            let name = constraint.name.replace(['\'', '\\', '"'], "");
            (VariableKind::Multiplier(i), format!("'multiplier({name})'"))
        }));
        all.push((VariableKind::KineticEnergy, "energy.kinetic".to_owned()));
        all.push((VariableKind::PotentialEnergy, "energy.potential".to_owned()));
        let facts = program.assumptions.iter().enumerate();
        all.extend(facts.map(|(i, fact)| {
            let text = fact.text.replace(['\'', '\\', '"'], "");
            (VariableKind::Fact(i), format!("'assume({text})'"))
        }));
        let events: Vec<String> = events.iter().map(|event| event.name.clone()).collect();
        all.extend(each(&events, VariableKind::Event, |name| {
            format!("'indicator({name})'")
        }));
        all.extend(each(&events, VariableKind::Count, |name| {
            format!("event.{name}")
        }));
        all.extend(contacts.iter().enumerate().flat_map(of_contact));
        let mut taken = BTreeSet::new();
        let all: Vec<Variable> = all
            .into_iter()
            .map(|(kind, name)| Variable {
                kind,
                name: free(name, &mut taken),
                is_output: match kind {
                    VariableKind::Output(_) | VariableKind::Count(_) => true,
                    VariableKind::Coordinate(i) => !has_outputs && states[i].is_none(),
                    VariableKind::Rate(i) => !has_outputs && states[i].is_some(),
                    _ => false,
                },
            })
            .collect();
        let is_structured = all.iter().all(|variable| variable.name.is_ascii());
        Variables { all, is_structured }
    }

    /// These variables with other outputs.
    ///
    /// # Errors
    /// For an unknown name, the failure that `unknown` makes of it and the known names.
    pub fn with_outputs(
        mut self,
        names: &[String],
        unknown: fn(&str, &[&str]) -> Failure,
    ) -> Result<Variables, Failure> {
        let may_be = |variable: &Variable| {
            !matches!(
                variable.kind,
                VariableKind::Time | VariableKind::Parameter(_) | VariableKind::Input(_)
            )
        };
        for name in names {
            let mut known = self.all.iter().filter(|variable| may_be(variable));
            if !known.any(|variable| variable.name == *name) {
                let known = self.all.iter().filter(|variable| may_be(variable));
                let known: Vec<&str> = known.map(|variable| variable.name.as_str()).collect();
                return Err(unknown(name, &known));
            }
        }
        for variable in &mut self.all {
            // The count of an event is always an output.
            let is_count = matches!(variable.kind, VariableKind::Count(_));
            variable.is_output = is_count || may_be(variable) && names.contains(&variable.name);
        }
        Ok(self)
    }

    /// The outputs, with their references.
    pub fn outputs(&self) -> impl Iterator<Item = (usize, &Variable)> {
        let all = self.all.iter().enumerate();
        all.filter(|(_, variable)| variable.is_output)
    }

    /// The variables of a kind, with their references.
    pub fn of(
        &self,
        is_wanted: fn(&VariableKind) -> bool,
    ) -> impl Iterator<Item = (usize, &Variable)> {
        let all = self.all.iter().enumerate();
        all.filter(move |(_, variable)| is_wanted(&variable.kind))
    }
}

/// The kinds and names of the variables of a contact.
fn of_contact((contact, name): (usize, &String)) -> Vec<(VariableKind, String)> {
    let name = name.replace(['\'', '\\', '"'], "");
    let of = OF_CONTACTS.iter().enumerate();
    of.map(|(quantity, what)| {
        let kind = VariableKind::OfContact(contact, quantity);
        (kind, format!("'{what}({name})'"))
    })
    .collect()
}

/// A name by the structured naming convention: an identifier with an index, or a quoted name.
fn structured(name: &str) -> String {
    let (base, index) = match name.split_once('[') {
        Some((base, rest)) => (base, rest.strip_suffix(']')),
        None => (name, Some("1")),
    };
    let is_count =
        index.is_some_and(|index| !index.is_empty() && index.chars().all(|c| c.is_ascii_digit()));
    if is_word(base) && is_count || !name.is_ascii() {
        name.to_owned()
    } else {
        format!("'{name}'")
    }
}

/// Whether a name consists of the letters a to z, digits and `_`, and begins with no digit.
pub fn is_word(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// A name that is not taken yet.
fn free(name: String, taken: &mut BTreeSet<String>) -> String {
    let mut unique = name.clone();
    let mut count = 2;
    while !taken.insert(unique.clone()) {
        unique = format!("'{} ({count})'", name.trim_matches('\''));
        count += 1;
    }
    unique
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_structured_or_quoted() {
        for (name, known) in [
            ("theta1", "theta1"),
            ("q[3]", "q[3]"),
            ("q[-1]", "'q[-1]'"),
            ("rod.gap", "'rod.gap'"),
            ("θ", "θ"),
        ] {
            assert_eq!(structured(name), known);
        }
        let mut taken = BTreeSet::new();
        let names = ["a", "a", "'b c'", "'b c'", "a"].map(|name| free(name.into(), &mut taken));
        assert_eq!(names, ["a", "'a (2)'", "'b c'", "'b c (2)'", "'a (3)'"]);
    }
}
