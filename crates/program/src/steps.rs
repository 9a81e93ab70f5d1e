//! The steps of an elimination: the values of a function that solve `M a = f`, by their names in the formulas.
//!
//! By rows of the mass matrix this is `M = L D Lᵀ`, `L z = f`, `D Lᵀ a = z`. Along a machine the same is done with the inertia
//! `G` and the loads `g` that remain on the velocities of bodies.
//!
//! Steps are only labels: they change no operation. A value is labelled where the elimination makes it, and keeps its label in
//! every later pass; a value that a pass takes apart loses it.

use super::{Op, Program, Value};

/// What a value of an elimination is, up to its sign and a factor that depends on parameters alone. Rows are coordinates; those
/// beyond them are constraints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Step {
    /// `d[i]`, the pivot of row i.
    Pivot(usize),
    /// `l[i, j]`, the multiple of row j that is subtracted from row i.
    Factor(usize, usize),
    /// `z[i]`, the right-hand side of row i when the rows before it are eliminated.
    Load(usize),
    /// `d[i]`, the inertia that remains along coordinate i when what it carries is eliminated.
    Inertia(usize),
    /// `l[i]`, what the acceleration of coordinate i takes from another acceleration.
    Coupling(usize),
    /// `z[i]`, the acceleration of coordinate i without the others.
    Free(usize),
    /// `a[i]`, or the multiplier of a constraint, from the solutions of later rows.
    Solution(usize),
}

impl Step {
    /// Whether it belongs to an elimination along the machine.
    fn is_along(self) -> bool {
        matches!(self, Step::Inertia(_) | Step::Coupling(_) | Step::Free(_))
    }

    /// The same step with other rows.
    #[must_use]
    pub fn with_rows(self, row: impl Fn(usize) -> usize) -> Step {
        match self {
            Step::Pivot(i) => Step::Pivot(row(i)),
            Step::Factor(i, j) => Step::Factor(row(i), row(j)),
            Step::Load(i) => Step::Load(row(i)),
            Step::Inertia(i) => Step::Inertia(row(i)),
            Step::Coupling(i) => Step::Coupling(row(i)),
            Step::Free(i) => Step::Free(row(i)),
            Step::Solution(i) => Step::Solution(row(i)),
        }
    }
}

/// Whether an operation may be labelled: reads, constants, sines and cosines speak for themselves.
pub(super) fn is_labelled(op: &Op) -> bool {
    !matches!(
        op,
        Op::Constant(_) | Op::Pi | Op::Read(_) | Op::Sin(_) | Op::Cos(_)
    )
}

/// The formulas of an elimination by rows.
const BY_ROWS: &str = "\
Row after row is eliminated. Comments name the results, up to signs and factors that depend on parameters alone; sums are over \
the rows `k` eliminated before, in the last line after row `i`:

```text
l[i, j] = (M[i, j] - sum l[i, k]*l[j, k]*d[k])/d[j]
d[i] = M[i, i] - sum l[i, k]^2*d[k]
z[i] = f[i] - sum l[i, k]*z[k]
a[i] = z[i]/d[i] - sum l[k, i]*a[k]
```";

/// The formulas of an elimination along the machine.
const ALONG: &str = "\
The velocities are eliminated from the tips of the machine to the ground, with the inertia `G` and the loads `g` that remain on \
them. Comments name the results for coordinate `i`, or for a velocity in its place, up to signs and factors that depend on \
parameters alone; `k` are the velocities that remain:

```text
d[i] = G[i, i], l[i] = G[i, k]/d[i], z[i] = g[i]/d[i]
a[i] = z[i] - sum l[i]*a[k]
```";

impl Program {
    /// The formulas of the steps of a function, as documentation; `None` if it has no elimination.
    pub fn formulas_of_steps(&self, steps: &[(Value, Step)]) -> Option<&'static str> {
        let is_own = |(_, step): &&(Value, Step)| !matches!(step, Step::Solution(_));
        let (_, first) = steps.iter().find(is_own)?;
        Some(if first.is_along() { ALONG } else { BY_ROWS })
    }

    /// What a statement computes, as a comment: `Row theta2: pivot d[theta2].`
    pub fn text_of_steps(&self, steps: &[Step]) -> String {
        let texts = steps.iter().map(|step| {
            let name = self.name_of_step(*step);
            match *step {
                Step::Pivot(i) => format!("Row {}: pivot {name}", self.row_name(i)),
                Step::Factor(i, j) => {
                    let (row, from) = (self.row_name(j), self.row_name(i));
                    format!("Row {row} leaves row {from}: {name}")
                }
                Step::Load(i) => format!("Row {}: right-hand side {name}", self.row_name(i)),
                Step::Inertia(i) => format!("Eliminates {}: inertia {name}", self.row_name(i)),
                Step::Coupling(i) => format!("Eliminates {}: coupling {name}", self.row_name(i)),
                Step::Free(i) => format!("Eliminates {}: by itself {name}", self.row_name(i)),
                Step::Solution(_) => format!("Back substitution: {name}"),
            }
        });
        texts.collect::<Vec<_>>().join("; ") + "."
    }

    /// The name of a value in the formulas: `l[theta2, theta1]`.
    pub fn name_of_step(&self, step: Step) -> String {
        let name = |i: usize| self.row_name(i);
        match step {
            Step::Pivot(i) | Step::Inertia(i) => format!("d[{}]", name(i)),
            Step::Factor(i, j) => format!("l[{}, {}]", name(i), name(j)),
            Step::Coupling(i) => format!("l[{}]", name(i)),
            Step::Load(i) | Step::Free(i) => format!("z[{}]", name(i)),
            Step::Solution(i) if i < self.dimension() => format!("a[{}]", name(i)),
            Step::Solution(i) => format!("lambda[{}]", name(i)),
        }
    }

    /// The name of a coordinate or, beyond the coordinates, of a constraint.
    fn row_name(&self, row: usize) -> String {
        match row.checked_sub(self.dimension()) {
            None => self.coordinates[row].name.to_string(),
            Some(constraint) => self.constraints[constraint].name.clone(),
        }
    }
}
