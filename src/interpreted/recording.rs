//! Recordings of runs: one row for each instant, one column for each quantity.

use std::format;
use std::string::String;
use std::vec;
use std::vec::Vec;

use lagrangian_spec::unit::{rate_name, rate_unit, state_of};

use super::{InterpretedMachine, InterpretedSystem, Named};
use crate::{Compliance, Energies, InputLaw, Solution, State, System};

/// The kind of a column, which selects the panel of the plot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColumnKind {
    /// A generalized coordinate.
    Coordinate,
    /// The rate of a coordinate.
    Rate,
    /// An energy: kinetic, potential, their sum.
    Energy,
    /// The residual of the energy balance.
    Residual,
    /// An output of the spec.
    Output,
    /// An input that is driven.
    Input,
    /// The normal reaction, the friction or the slip of a contact.
    Contact,
    /// The multiplier of a constraint.
    Multiplier,
}

/// One quantity along the run.
#[derive(Clone, Debug)]
pub struct Column {
    /// Its name, as the header of a table shows it.
    pub name: String,
    /// Its unit, as a spec writes it.
    pub unit: String,
    /// Its kind.
    pub kind: ColumnKind,
    /// Its values, one for each instant.
    pub values: Vec<f64>,
}

/// A whole run, column by column.
#[derive(Clone, Debug, Default)]
pub struct Recording {
    /// The instants, in s.
    pub times: Vec<f64>,
    /// The quantities; all as long as `times`.
    pub columns: Vec<Column>,
}

impl Recording {
    /// The columns of one kind.
    pub fn of_kind(&self, kind: ColumnKind) -> impl Iterator<Item = &Column> {
        self.columns
            .iter()
            .filter(move |column| column.kind == kind)
    }

    /// Every `stride`th instant, and the last.
    pub fn each(&self, stride: usize) -> Recording {
        let last = self.times.len().saturating_sub(1);
        let kept = |values: &[f64]| {
            let numbered = values.iter().enumerate();
            let kept = numbered.filter(|(row, _)| row % stride.max(1) == 0 || *row == last);
            kept.map(|(_, value)| *value).collect()
        };
        Recording {
            times: kept(&self.times),
            columns: self
                .columns
                .iter()
                .map(|column| Column {
                    values: kept(&column.values),
                    ..column.clone()
                })
                .collect(),
        }
    }

    /// The headers of a table: the name with its unit, `s1 [m]`, time first.
    pub fn headers(&self) -> impl Iterator<Item = String> + '_ {
        let columns = self
            .columns
            .iter()
            .map(|column| match column.unit.as_str() {
                "1" => column.name.clone(),
                unit => format!("{} [{unit}]", column.name),
            });
        std::iter::once(String::from("t [s]")).chain(columns)
    }

    /// Records states of a run with everything that can be observed at each: coordinates and rates, outputs,
    /// multipliers, contacts, energies, and the residual of the energy balance if it is kept. Quantities without a value
    /// at a state are NaN.
    pub fn of<L: InputLaw<InterpretedSystem>>(
        run: &Solution<InterpretedMachine, L>,
        states: &[State<Named>],
    ) -> Recording {
        let system = run.system();
        let mut columns: Vec<Column> = Vec::new();
        let mut column = |name: String, unit: String, kind| {
            columns.push(Column {
                name,
                unit,
                kind,
                values: Vec::with_capacity(states.len()),
            })
        };
        // A first-order state is recorded by its value and not by the integral of it.
        let is_integral: Vec<bool> = system
            .coordinates()
            .map(|quantity| state_of(quantity.name).is_some())
            .collect();
        for quantity in system
            .coordinates()
            .filter(|of| state_of(of.name).is_none())
        {
            column(
                quantity.name.into(),
                quantity.unit.into(),
                ColumnKind::Coordinate,
            );
        }
        for quantity in system.coordinates() {
            let unit = rate_unit(quantity.name, quantity.unit);
            let kind = match state_of(quantity.name) {
                Some(_) => ColumnKind::Output,
                None => ColumnKind::Rate,
            };
            column(rate_name(quantity.name, ""), unit, kind);
        }
        let start = run.start();
        let (q, v) = (&start.q.values, &start.v.values);
        let outputs = system.outputs(start.t, q, v, &vec![0.0; q.len()], &system.default_inputs());
        // Added formulas have names that no spec can contain.
        let is_shown = |name: &str| !name.contains(' ');
        let shown: Vec<bool> = system
            .output_values(&outputs)
            .map(|(quantity, _)| is_shown(quantity.name))
            .collect();
        for (quantity, _) in system.output_values(&outputs) {
            if is_shown(quantity.name) {
                column(
                    quantity.name.into(),
                    quantity.unit.into(),
                    ColumnKind::Output,
                );
            }
        }
        let is_driven = run.is_driven();
        let inputs = system.default_inputs();
        for (quantity, _) in system.input_values(&inputs).filter(|_| is_driven) {
            let name = quantity.name;
            let mut others = system.output_values(&outputs);
            let is_taken = others.any(|(other, _)| other.name == name);
            let name = if is_taken {
                format!("input({name})")
            } else {
                name.into()
            };
            column(name, quantity.unit.into(), ColumnKind::Input);
        }
        for constraint in system.constraints() {
            let name = format!("multiplier({})", constraint.name);
            column(
                name,
                constraint.multiplier_unit.into(),
                ColumnKind::Multiplier,
            );
        }
        for name in system.contacts() {
            for (what, unit) in [("normal", "N"), ("friction", "N"), ("slip", "m/s")] {
                column(format!("{what}({name})"), unit.into(), ColumnKind::Contact);
            }
        }
        let has_books = !run.contact_energies().is_empty();
        for contact in system.unilateral_contacts() {
            let name = contact.name;
            let [friction, slip] = if contact.is_rolling_resistance {
                ["N*m", "rad/s"]
            } else {
                ["N", "m/s"]
            };
            for (what, unit) in [
                ("gap", "m"),
                ("normal", "N"),
                ("friction", friction),
                ("slip", slip),
            ] {
                column(format!("{what}({name})"), unit.into(), ColumnKind::Contact);
            }
            if contact.compliance == Some(Compliance::Layer) {
                column(format!("crushing({name})"), "J".into(), ColumnKind::Contact);
            }
            if has_books {
                column(format!("lost({name})"), "J".into(), ColumnKind::Contact);
            }
        }
        for name in ["kinetic energy", "potential energy", "total energy"] {
            column(name.into(), "J".into(), ColumnKind::Energy);
        }
        column("energy residual".into(), "J".into(), ColumnKind::Residual);

        let is_layer: Vec<bool> = (system.unilateral_contacts())
            .map(|contact| contact.compliance == Some(Compliance::Layer))
            .collect();
        let unknown = |count: usize| vec![f64::NAN; count];
        let reactions = system.constraints().len()
            + 3 * system.contacts().len()
            + 4 * system.unilateral_contacts().len()
            + is_layer.iter().filter(|is_layer| **is_layer).count()
            + if has_books { is_layer.len() } else { 0 };
        for state in states {
            let books = run.contact_energies_at(state.t);
            let lost = |k: usize| (books.as_ref()).map_or(f64::NAN, |of_each| of_each[k].lost());
            // If a run ends early there may be no accelerations, and then nothing that is computed from them.
            let (observation, inputs, reactions, energies) = match run.observe_state(state) {
                Ok(seen) => {
                    let (kinetic, potential) = (seen.kinetic_energy, seen.potential_energy);
                    let energies = [kinetic, potential, kinetic + potential];
                    let contacts = seen.contacts.iter();
                    let contacts = contacts.flat_map(|c| [c.normal, c.friction, c.slip]);
                    let unilateral = seen.unilateral.iter();
                    let unilateral = unilateral.zip(&is_layer).enumerate();
                    let unilateral = unilateral.flat_map(|(k, (c, is_layer))| {
                        let crushing = is_layer.then_some(c.crushing_work);
                        [c.gap, c.normal, c.friction, c.slip]
                            .into_iter()
                            .chain(crushing)
                            .chain(has_books.then(|| lost(k)))
                    });
                    let reactions = seen.multipliers.iter().copied().chain(contacts);
                    let reactions = reactions.chain(unilateral);
                    let inputs = seen.inputs.values;
                    (seen.outputs.values, inputs, reactions.collect(), energies)
                }
                Err(_) => {
                    let outputs = unknown(outputs.values.len());
                    let inputs = unknown(inputs.values.len());
                    (outputs, inputs, unknown(reactions), [f64::NAN; 3])
                }
            };
            let places = state.q.values.iter().zip(&is_integral);
            let places = places.filter(|(_, is_integral)| !**is_integral);
            let places = places.map(|(place, _)| place);
            let moving = places.chain(&state.v.values).copied();
            let residual = residual_at(run.energies(), state.t);
            let outputs = observation.into_iter().zip(&shown);
            let outputs = outputs.filter(|(_, is_shown)| **is_shown);
            let outputs = outputs.map(|(value, _)| value);
            let inputs = inputs.into_iter().filter(|_| is_driven);
            let observed = outputs.chain(inputs).chain(reactions);
            let row = moving.chain(observed).chain(energies).chain([residual]);
            for (column, value) in columns.iter_mut().zip(row) {
                column.values.push(value);
            }
        }
        Recording {
            times: states.iter().map(|state| state.t).collect(),
            columns,
        }
    }
}

/// The residual of the energy balance at a time, interpolated between the ends of steps.
fn residual_at(energies: &[Energies], t: f64) -> f64 {
    let Some(first) = energies.first() else {
        return 0.0;
    };
    let residual = |e: &Energies| {
        (e.kinetic + e.potential) - (first.kinetic + first.potential) - e.work + e.dissipated
    };
    let forward = energies.last().is_none_or(|last| last.t >= first.t);
    let next = energies.partition_point(|e| if forward { e.t < t } else { e.t > t });
    match (
        next.checked_sub(1).and_then(|before| energies.get(before)),
        energies.get(next),
    ) {
        (Some(a), Some(b)) => {
            let share = (t - a.t) / (b.t - a.t);
            residual(a) + share * (residual(b) - residual(a))
        }
        (Some(only), None) | (None, Some(only)) => residual(only),
        (None, None) => 0.0,
    }
}
