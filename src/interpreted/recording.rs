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
        let recorded = Recorded::of(run);
        let mut columns = recorded.columns(run.system(), states.len());
        for state in states {
            for (column, value) in columns.iter_mut().zip(recorded.row(run, state)) {
                column.values.push(value);
            }
        }
        Recording {
            times: states.iter().map(|state| state.t).collect(),
            columns,
        }
    }
}

/// Which quantities of a run are recorded.
struct Recorded {
    /// Whether each coordinate is the integral of a state of first order, which is recorded by its value alone.
    is_integral: Vec<bool>,
    /// The outputs, and which of them are shown: formulas that were added have names that no spec can contain.
    outputs: Named,
    is_shown: Vec<bool>,
    /// The inputs; they are recorded if they are driven.
    inputs: Named,
    is_driven: bool,
    /// Whether each unilateral contact is a layer that is crushed.
    is_layer: Vec<bool>,
    /// Whether the energies of contacts are kept.
    has_books: bool,
    /// The number of multipliers and quantities of contacts.
    reactions: usize,
}

impl Recorded {
    fn of<L: InputLaw<InterpretedSystem>>(run: &Solution<InterpretedMachine, L>) -> Recorded {
        let system = run.system();
        let start = run.start();
        let (q, v) = (&start.q.values, &start.v.values);
        let inputs = system.default_inputs();
        let outputs = system.outputs(start.t, q, v, &vec![0.0; q.len()], &inputs);
        let is_shown = system.output_values(&outputs);
        let is_shown = is_shown.map(|(quantity, _)| !quantity.name.contains(' '));
        let is_layer: Vec<bool> = (system.unilateral_contacts())
            .map(|contact| contact.compliance == Some(Compliance::Layer))
            .collect();
        let has_books = !run.contact_energies().is_empty();
        let reactions = system.constraints().len()
            + 3 * system.contacts().len()
            + 4 * is_layer.len()
            + is_layer.iter().filter(|is_layer| **is_layer).count()
            + if has_books { is_layer.len() } else { 0 };
        let is_integral = system.coordinates();
        Recorded {
            is_integral: (is_integral.map(|of| state_of(of.name).is_some())).collect(),
            is_shown: is_shown.collect(),
            outputs,
            inputs,
            is_driven: run.is_driven(),
            is_layer,
            has_books,
            reactions,
        }
    }

    /// The columns, with room for so many values.
    fn columns(&self, system: &InterpretedSystem, rows: usize) -> Vec<Column> {
        let mut columns = Vec::new();
        let mut column = |name: String, unit: &str, kind| {
            columns.push(Column {
                name,
                unit: unit.into(),
                kind,
                values: Vec::with_capacity(rows),
            });
        };
        for of in system.coordinates() {
            if state_of(of.name).is_none() {
                column(of.name.into(), of.unit, ColumnKind::Coordinate);
            }
        }
        for of in system.coordinates() {
            let kind = match state_of(of.name) {
                Some(_) => ColumnKind::Output,
                None => ColumnKind::Rate,
            };
            column(rate_name(of.name, ""), &rate_unit(of.name, of.unit), kind);
        }
        for ((of, _), is_shown) in system.output_values(&self.outputs).zip(&self.is_shown) {
            if *is_shown {
                column(of.name.into(), of.unit, ColumnKind::Output);
            }
        }
        let inputs = system.input_values(&self.inputs);
        for (of, _) in inputs.filter(|_| self.is_driven) {
            let mut outputs = system.output_values(&self.outputs);
            let is_taken = outputs.any(|(other, _)| other.name == of.name);
            let name = if is_taken {
                format!("input({})", of.name)
            } else {
                of.name.into()
            };
            column(name, of.unit, ColumnKind::Input);
        }
        for constraint in system.constraints() {
            let name = format!("multiplier({})", constraint.name);
            column(name, constraint.multiplier_unit, ColumnKind::Multiplier);
        }
        for name in system.contacts() {
            for (what, unit) in [("normal", "N"), ("friction", "N"), ("slip", "m/s")] {
                column(format!("{what}({name})"), unit, ColumnKind::Contact);
            }
        }
        for contact in system.unilateral_contacts() {
            let [friction, slip] = if contact.is_rolling_resistance {
                ["N*m", "rad/s"]
            } else {
                ["N", "m/s"]
            };
            let is_layer = contact.compliance == Some(Compliance::Layer);
            let always = [
                ("gap", "m"),
                ("normal", "N"),
                ("friction", friction),
                ("slip", slip),
            ];
            let crushing = is_layer.then_some(("crushing", "J"));
            let lost = self.has_books.then_some(("lost", "J"));
            for (what, unit) in always.into_iter().chain(crushing).chain(lost) {
                let name = format!("{what}({})", contact.name);
                column(name, unit, ColumnKind::Contact);
            }
        }
        for name in ["kinetic energy", "potential energy", "total energy"] {
            column(name.into(), "J", ColumnKind::Energy);
        }
        column("energy residual".into(), "J", ColumnKind::Residual);
        columns
    }

    /// The values at a state, in the order of the columns.
    fn row<L: InputLaw<InterpretedSystem>>(
        &self,
        run: &Solution<InterpretedMachine, L>,
        state: &State<Named>,
    ) -> Vec<f64> {
        let coordinates = state.q.values.iter().zip(&self.is_integral);
        let coordinates = coordinates.filter(|(_, is_integral)| !**is_integral);
        let mut row: Vec<f64> = coordinates.map(|(value, _)| *value).collect();
        row.extend(&state.v.values);
        let seen = run.observe_state(state);
        let shown = self.is_shown.iter().filter(|is_shown| **is_shown).count();
        let inputs = if self.is_driven {
            self.inputs.values.len()
        } else {
            0
        };
        match &seen {
            Ok(seen) => {
                let outputs = seen.outputs.values.iter().zip(&self.is_shown);
                row.extend(outputs.filter(|(_, is_shown)| **is_shown).map(|(x, _)| *x));
                row.extend(&seen.inputs.values[..inputs]);
                row.extend(&seen.multipliers);
                let contacts = seen.contacts.iter();
                row.extend(contacts.flat_map(|c| [c.normal, c.friction, c.slip]));
                let books = run.contact_energies_at(state.t);
                for (k, (c, is_layer)) in seen.unilateral.iter().zip(&self.is_layer).enumerate() {
                    row.extend([c.gap, c.normal, c.friction, c.slip]);
                    row.extend(is_layer.then_some(c.crushing_work));
                    let lost = (books.as_ref()).map_or(f64::NAN, |of_each| of_each[k].lost());
                    row.extend(self.has_books.then_some(lost));
                }
                let (kinetic, potential) = (seen.kinetic_energy, seen.potential_energy);
                row.extend([kinetic, potential, kinetic + potential]);
            }
            // If a run ends early there may be no accelerations, and then nothing that is computed from them.
            Err(_) => {
                let energies = 3;
                let unknown = shown + inputs + self.reactions + energies;
                row.extend(std::iter::repeat_n(f64::NAN, unknown));
            }
        }
        row.push(residual_at(run.energies(), state.t));
        row
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
