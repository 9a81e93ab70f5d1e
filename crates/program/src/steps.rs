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
pub enum EliminationStep {
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

impl EliminationStep {
    /// Whether it belongs to an elimination along the machine.
    fn is_along(self) -> bool {
        matches!(
            self,
            EliminationStep::Inertia(_) | EliminationStep::Coupling(_) | EliminationStep::Free(_)
        )
    }

    /// This step with the rows renumbered.
    #[must_use]
    pub fn with_rows(self, row: impl Fn(usize) -> usize) -> EliminationStep {
        match self {
            EliminationStep::Pivot(i) => EliminationStep::Pivot(row(i)),
            EliminationStep::Factor(i, j) => EliminationStep::Factor(row(i), row(j)),
            EliminationStep::Load(i) => EliminationStep::Load(row(i)),
            EliminationStep::Inertia(i) => EliminationStep::Inertia(row(i)),
            EliminationStep::Coupling(i) => EliminationStep::Coupling(row(i)),
            EliminationStep::Free(i) => EliminationStep::Free(row(i)),
            EliminationStep::Solution(i) => EliminationStep::Solution(row(i)),
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
Row after row, an unknown is eliminated from the rows that follow. Comments name these numbers where they are computed, up to signs \
and factors that depend on parameters alone; sums are over the rows `k` before, in the last line over those after:

```text
l[i, j] = (M[i, j] - sum l[i, k]*l[j, k]*d[k])/d[j]
d[i] = M[i, i] - sum l[i, k]^2*d[k]
z[i] = f[i] - sum l[i, k]*z[k]
a[i] = z[i]/d[i] - sum l[k, i]*a[k]
```";

/// The formulas of an elimination along the machine.
const ALONG: &str = "\
Velocities are eliminated from the tips of the machine to the ground, with the inertia `G` and the loads `g` that remain on them. \
Comments name these numbers where they are computed, up to signs and factors that depend on parameters alone, for coordinate `i` or \
the velocity in its place; `k` are the velocities that follow:

```text
d[i] = G[i, i], l[i] = G[i, k]/d[i], z[i] = g[i]/d[i]
a[i] = z[i] - sum l[i]*a[k]
```";

/// What the rows of constraints are.
const CONSTRAINTS: &str = "\
The rows of constraints are those of `G a = gamma`: there `M` stands for `G`, with zeros for two constraints, and `f` for `gamma`. \
Their unknowns are the multipliers.";

/// What follows an elimination along a machine whose loops are cut open.
const CLOSING: &str = "\
So far these are the accelerations `a0` without constraint forces. The multipliers follow from `C lambda = gamma - G a0`, where now \
`G` are the rows of the constraints and `C = G M^-1 G^T`, row after row: `d`, `l` and `z` of constraints are those of `C = L D L^T`.";

impl Program {
    /// The formulas of the steps of a function, as documentation; `None` if it has no elimination.
    pub fn formulas_of_steps(&self, steps: &[(Value, EliminationStep)]) -> Option<String> {
        let is_by_rows = |step: EliminationStep| {
            matches!(
                step,
                EliminationStep::Pivot(_) | EliminationStep::Factor(..) | EliminationStep::Load(_)
            )
        };
        let along = steps.iter().any(|(_, step)| step.is_along());
        let by_rows = steps.iter().any(|(_, step)| is_by_rows(*step));
        match (along, by_rows) {
            (false, false) => None,
            (false, true) if steps.iter().any(|(_, step)| self.is_of_constraint(*step)) => {
                Some(format!("{BY_ROWS}\n\n{CONSTRAINTS}"))
            }
            (false, true) => Some(BY_ROWS.to_owned()),
            (true, false) => Some(ALONG.to_owned()),
            (true, true) => Some(format!("{ALONG}\n\n{CLOSING}")),
        }
    }

    /// Whether a step eliminates the multiplier of a constraint.
    fn is_of_constraint(&self, step: EliminationStep) -> bool {
        matches!(step, EliminationStep::Pivot(row) if row >= self.dimension())
    }

    /// What a statement computes, as a comment: `Row theta2: pivot d[theta2].`
    pub fn text_of_steps(&self, steps: &[EliminationStep]) -> String {
        let texts = steps.iter().map(|step| {
            let name = self.name_of_step(*step);
            match *step {
                EliminationStep::Pivot(i) => format!("Row {}: pivot {name}", self.row_name(i)),
                EliminationStep::Factor(i, j) => {
                    let (row, from) = (self.row_name(j), self.row_name(i));
                    format!("Eliminates {row} from row {from}: {name}")
                }
                EliminationStep::Load(i) => {
                    format!("Row {}: right-hand side {name}", self.row_name(i))
                }
                EliminationStep::Inertia(i) => {
                    format!("Eliminates {}: inertia {name}", self.row_name(i))
                }
                EliminationStep::Coupling(i) => {
                    format!("Eliminates {}: coupling {name}", self.row_name(i))
                }
                EliminationStep::Free(i) => {
                    format!("Eliminates {}: alone {name}", self.row_name(i))
                }
                EliminationStep::Solution(_) => format!("Back substitution: {name}"),
            }
        });
        texts.collect::<Vec<_>>().join("; ") + "."
    }

    /// The name of a value in the formulas: `l[theta2, theta1]`.
    pub fn name_of_step(&self, step: EliminationStep) -> String {
        let name = |i: usize| self.row_name(i);
        match step {
            EliminationStep::Pivot(i) | EliminationStep::Inertia(i) => format!("d[{}]", name(i)),
            EliminationStep::Factor(i, j) => format!("l[{}, {}]", name(i), name(j)),
            EliminationStep::Coupling(i) => format!("l[{}]", name(i)),
            EliminationStep::Load(i) | EliminationStep::Free(i) => format!("z[{}]", name(i)),
            EliminationStep::Solution(i) if i < self.dimension() => format!("a[{}]", name(i)),
            EliminationStep::Solution(i) => format!("lambda[{}]", name(i)),
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
