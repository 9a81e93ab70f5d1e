//! The equations of a machine as lines of text, for the comments of code.

use std::collections::BTreeMap;

use lagrangian_symbolic::normal::{READABLE_BUDGET, readable};
use lagrangian_symbolic::{Expr, text};

use crate::Equations;
use crate::{Quantity, quantities};
use lagrangian_program::quantity::Entry;
use lagrangian_program::{Program, Role};
use lagrangian_spec::model::Model;

/// The largest number of numbers, symbols and operations of a formula that is shown. Longer ones can be read in the printed derivation.
const LONGEST_LINE: u64 = 250;

/// The largest number of these in the comment of one function.
const LONGEST_COMMENT: u64 = 2500;

/// For each function the lines of its formulas, `M[theta, x] = m*l*cos(theta)`, in the spec language; zeros are left out,
/// and long formulas are `…`.
pub fn formulas<'d>(
    program: &Program,
    model: &Model<'d>,
    equations: &Equations<'d>,
) -> BTreeMap<Role, Vec<String>> {
    let shown = quantities(model, equations)
        .into_iter()
        // `f = Q - h` and the margin of an assumption are described in words.
        .filter(|quantity| !matches!(quantity.role, Role::Forces | Role::Assumption(_)));
    shown
        .map(|Quantity { role, values, .. }| {
            let symbol = match role {
                Role::Output(i) => model.outputs[i].name.to_string(),
                role => role.row().symbol.to_owned(),
            };
            let name = |index: usize| match program.entry(role, index) {
                Entry::Of(kind, i) => format!("{symbol}[{}]", program.member((kind, i))),
                Entry::At(row, column) => {
                    format!(
                        "{symbol}[{}, {}]",
                        program.member(row),
                        program.member(column)
                    )
                }
                _ => symbol.clone(),
            };
            let named = values.into_iter().enumerate();
            (
                role,
                lines(named.map(|(index, value)| (name(index), value))),
            )
        })
        .collect()
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
        lines.push(if size > LONGEST_LINE {
            format!("{name} = …")
        } else {
            let value = readable(value, READABLE_BUDGET);
            format!("{name} = {}", text(value, value.dag()))
        });
    }
    lines
}
