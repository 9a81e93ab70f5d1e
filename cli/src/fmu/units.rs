//! Units in the form of FMI: a name, the powers of the base units, and the factor to SI units.

use std::collections::BTreeMap;

use lagrangian_program::Slot;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::resolve::value_in;
use lagrangian_spec::source::Sources;
use lagrangian_units::Unit;

use super::xml::Document;

/// Units by name, in alphabetical order; pure numbers have none.
#[derive(Default)]
pub struct Units(BTreeMap<String, (Unit, f64)>);

impl Units {
    /// Registers the unit of a slot, and returns its name.
    pub fn of_slot(&mut self, slot: &Slot) -> String {
        let unit = slot.unit;
        if !unit.is_scaled() {
            return self.of(unit);
        }
        // The factor to SI units, as the spec's language defines it.
        let (mut sources, mut report) = (Sources::new(), Report::new());
        let one = format!("1*{}", slot.unit_text);
        let factor = value_in(&one, &unit.to_string(), &mut sources, &mut report);
        let name = slot.unit_text.clone();
        self.0
            .insert(name.clone(), (unit, factor.unwrap_or(f64::NAN)));
        name
    }

    /// Registers an SI unit, and returns its name.
    pub fn of(&mut self, unit: Unit) -> String {
        let name = unit.to_string();
        if name == "1" {
            return String::new();
        }
        self.0.insert(name.clone(), (unit, 1.0));
        name
    }

    /// The section of a description.
    pub fn write(&self, document: &mut Document) {
        if self.0.is_empty() {
            return;
        }
        document.open("UnitDefinitions", &[]);
        for (name, (unit, factor)) in &self.0 {
            document.open("Unit", &[("name", name)]);
            // An angle in degrees has the dimension of one in radians.
            let is_angle = unit.to_string().starts_with("rad");
            base(document, *unit, *factor, is_angle);
            let display = match name.as_str() {
                "rad" => Some(("deg", 180.0 / std::f64::consts::PI)),
                "rad/s" => Some(("rpm", 30.0 / std::f64::consts::PI)),
                "m" => Some(("mm", 1000.0)),
                _ => None,
            };
            if let Some((name, factor)) = display {
                let factor = format!("{factor:?}");
                document.leaf("DisplayUnit", &[("name", name), ("factor", &factor)]);
            }
            document.close();
        }
        document.close();
    }
}

/// The powers of base units, if all of them are integers.
fn base(document: &mut Document, unit: Unit, factor: f64, is_angle: bool) {
    let powers = unit.twice_the_powers();
    if powers.iter().any(|(_, twice)| twice % 2 != 0) || !factor.is_finite() {
        return;
    }
    let radian = is_angle.then_some(("rad", "1".to_owned()));
    // FMI has no unit for cycles.
    let powers = powers
        .into_iter()
        .filter(|(name, twice)| *twice != 0 && *name != "cycle");
    let powers = powers.map(|(name, twice)| (name, (twice / 2).to_string()));
    let factor = (factor != 1.0).then(|| ("factor", format!("{factor:?}")));
    let all: Vec<(&str, String)> = powers.chain(radian).chain(factor).collect();
    let all: Vec<(&str, &str)> = all
        .iter()
        .map(|(name, value)| (*name, value.as_str()))
        .collect();
    document.leaf("BaseUnit", &all);
}
