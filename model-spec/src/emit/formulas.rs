//! The equations of a machine as lines of text, for the comments of code.

use std::collections::BTreeMap;

use lagrangian_symbolic::normal::{READABLE_BUDGET, readable};
use lagrangian_symbolic::{Expr, text};

use crate::mechanics::Equations;
use crate::model::Model;
use crate::program::Role;

/// The most numbers, symbols and operations of a formula that is shown. Whoever wants to read more derives it as a page.
const LONGEST_LINE: u64 = 250;

/// The most that the comment of one function shows.
const LONGEST_COMMENT: u64 = 2500;

/// For each function the lines that say what it computes, `M[theta, x] = m*l*cos(theta)`, in the spec language; zeros are
/// left out, and what is long is `…`.
pub fn formulas<'d>(model: &Model<'d>, equations: &Equations<'d>) -> BTreeMap<Role, Vec<String>> {
    let names: Vec<String> = model
        .coordinates
        .iter()
        .map(|coordinate| coordinate.name.to_string())
        .collect();
    let vector = |letter: &str, values: &[Expr<'_>]| {
        let named = names.iter().map(|name| format!("{letter}[{name}]"));
        lines(named.zip(values.iter().copied()))
    };
    let scalar = |letter: &str, value| lines([(letter.to_owned(), value)].into_iter());
    let matrix = equations.mass_matrix.entries();
    let matrix = matrix.map(|(i, j, &value)| (format!("M[{}, {}]", names[i], names[j]), value));
    let mut all = BTreeMap::from([
        (Role::MassMatrix, lines(matrix)),
        (Role::Bias, vector("h", &equations.bias)),
        (Role::Applied, vector("Q", &equations.applied)),
        (Role::KineticEnergy, scalar("T", equations.kinetic_energy)),
        (
            Role::PotentialEnergy,
            scalar("V", equations.potential_energy),
        ),
        (Role::Dissipation, scalar("D", equations.dissipation)),
        (Role::WorkRate, scalar("P", equations.work_rate)),
        (
            Role::DissipationRate,
            scalar("P", equations.dissipation_rate),
        ),
    ]);
    let constraints = &equations.constraints;
    let of = |letter: &str, value: &dyn Fn(usize) -> Option<Expr<'d>>| {
        let named = constraints.iter().enumerate();
        let named = named.filter_map(|(k, c)| Some((format!("{letter}[{}]", c.name), value(k)?)));
        lines(named)
    };
    let rows = constraints.iter().flat_map(|c| {
        let entries = names.iter().zip(&c.row);
        entries.map(|(name, &entry)| (format!("G[{}, {name}]", c.name), entry))
    });
    all.extend([
        (
            Role::ConstraintPositions,
            of("g", &|k| constraints[k].position),
        ),
        (
            Role::ConstraintRates,
            of("phi", &|k| Some(constraints[k].rate)),
        ),
        (Role::ConstraintMatrix, lines(rows)),
        (
            Role::ConstraintDrift,
            of("gamma", &|k| Some(constraints[k].drift)),
        ),
    ]);
    for (i, (output, &value)) in model.outputs.iter().zip(&equations.outputs).enumerate() {
        all.insert(Role::Output(i), scalar(&output.name.to_string(), value));
    }
    all
}

fn lines<'d>(values: impl Iterator<Item = (String, Expr<'d>)>) -> Vec<String> {
    let mut shown = 0;
    let mut lines = Vec::new();
    for (name, value) in values.filter(|(_, value)| !value.is_zero()) {
        let size = value.size();
        shown += size.min(LONGEST_LINE);
        if shown > LONGEST_COMMENT {
            lines.push("…".to_owned());
            break;
        }
        lines.push(match size > LONGEST_LINE {
            true => format!("{name} = …"),
            false => {
                let value = readable(value, READABLE_BUDGET);
                format!("{name} = {}", text(value, value.dag()))
            }
        });
    }
    lines
}
