//! The derivative of a start on the constraints by a number on which it depends.
//!
//! A run projects its start onto the constraints with the smallest displacement in the metric of inertia, with some numbers kept.
//! There is no formula for the derivative of that projection, so it is computed by differences of fourth order of such starts. The
//! result is then projected onto the derivative of the constraints, which is exact (dual numbers): with y = ∂q/∂s and ẏ,
//!
//! ```text
//! ∂g/∂q y + ∂g/∂s = 0,   ∂φ/∂q y + ∂φ/∂v ẏ + ∂φ/∂s = 0                              (E65)
//! ```
//!
//! The variational equations preserve both from there on.

use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{Machine, State, System};
use lagrangian_program::{Arguments, Interpreter, Role};
use lagrangian_scalar::Dual;
use nalgebra::{DMatrix, DVector};

use crate::reduced::Reduced;

/// The differences use this fraction of a number as step. Their truncation error is of fourth order, about 1e-12, and the residual
/// 1e-13 of a projection divided by the step is 1e-10.
const SHARE: f64 = 1e-3;

/// If the start has a derivative, two differences agree to this fraction of it.
const AGREES: f64 = 1e-5;

/// About ten times the residual of a projection, relative to the largest number beside it.
const LEFT: f64 = 1e-12;

/// Singular values of the rows below this fraction of the largest belong to rows that follow from others.
const INDEPENDENT: f64 = 1e-9;

/// The derivative of a state: of its coordinates, then of its rates.
pub type Change = [Vec<f64>; 2];

/// What a start depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The parameter with this index.
    Parameter(usize),
    /// An input: no constraint reads one, so no start depends on it.
    Input,
    /// The coordinate with this index, before the constraints move it.
    Start(usize),
    /// Its rate.
    Rate(usize),
}

/// How far integration may move a motion and its derivatives off the constraints, relative to the size of their terms.
pub const DRIFT: f64 = 1e-5;

/// The derivative of a start on the constraints by its cause. `from` returns the start of a machine before the projection onto the
/// constraints, in which a cause changes a number, and `brought` the projected one.
///
/// # Errors
/// The errors of `brought`, or that the start has no derivative.
pub fn change(
    machine: &InterpretedMachine,
    cause: Cause,
    from: impl Fn(&InterpretedMachine) -> State<Named>,
    brought: impl Fn(&InterpretedMachine, State<Named>) -> Result<State<Named>, String>,
) -> Result<Change, String> {
    // The scale of a number that is 0 is that of the largest one beside it, or 1.
    let size = |own: f64, others: &[f64]| {
        let largest = others.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let mut sizes = [own.abs(), largest].into_iter();
        sizes.find(|size| *size > 0.0).unwrap_or(1.0)
    };
    let start = from(machine);
    let (q, v) = (&start.q.values, &start.v.values);
    let (size, parameter) = match cause {
        Cause::Parameter(index) => {
            let own = machine.parameter_values().get(index).copied();
            (size(own.unwrap_or(0.0), &[]), Some(index))
        }
        Cause::Input => return Ok([vec![0.0; q.len()], vec![0.0; v.len()]]),
        Cause::Start(k) => (size(q[k], q), None),
        Cause::Rate(k) => (size(v[k], v), None),
    };
    let at = |by: f64| -> Result<State<Named>, String> {
        let mut machine = machine.clone();
        if let Cause::Parameter(index) = cause
            && let Some(own) = machine.parameter_mut(index)
        {
            *own += by;
        }
        let mut there = from(&machine);
        match cause {
            Cause::Start(k) => there.q.values[k] += by,
            Cause::Rate(k) => there.v.values[k] += by,
            Cause::Parameter(_) | Cause::Input => {}
        }
        brought(&machine, there)
    };
    derivative(machine, at, size, parameter)
}

/// Checks how far the motion and its derivatives by some causes are off the constraints at the end of a run, relative to the size
/// of their terms. Returns the first cause for which this exceeds [`DRIFT`], with the value.
pub fn drifted(
    machine: &InterpretedMachine,
    at: &State<Named>,
    changes: impl IntoIterator<Item = (Cause, Change)>,
) -> Option<(usize, f64)> {
    let changes = changes.into_iter().enumerate();
    let mut shares = changes.map(|(k, (cause, [q, v]))| {
        let parameter = match cause {
            Cause::Parameter(index) => Some((index, 1.0)),
            _ => None,
        };
        (k, off_constraints(machine, at, [&q, &v], parameter))
    });
    shares.find(|(_, off)| off.is_nan() || *off > DRIFT)
}

/// The derivative of a start on the constraints. `start` returns the start where the number is changed by its argument, and `size`
/// is the scale of the number; `parameter` is its index if it is a parameter.
///
/// # Errors
/// The errors of `start`, or that the start has no derivative.
pub fn derivative(
    machine: &InterpretedMachine,
    start: impl Fn(f64) -> Result<State<Named>, String>,
    size: f64,
    parameter: Option<usize>,
) -> Result<Change, String> {
    let here = start(0.0)?;
    let n = here.q.values.len();
    let vector = |state: &State<Named>| {
        let all = state.q.values.iter().chain(&state.v.values);
        DVector::from_iterator(2 * n, all.copied())
    };
    let step = SHARE * size;
    let odd = |by: f64| -> Result<DVector<f64>, String> {
        Ok((vector(&start(by)?) - vector(&start(-by)?)) / (2.0 * by))
    };
    let [wide, middle, close] = [2.0 * step, step, 0.5 * step].map(odd);
    let (wide, middle, close) = (wide?, middle?, close?);
    let coarse = (&middle * 4.0 - wide) / 3.0;
    let fine = (close * 4.0 - middle) / 3.0;
    // Each entry is compared relative to its change for a change of s by its size, plus the residual of projections.
    let at = vector(&here);
    let agrees = (0..2 * n).all(|k| {
        let level = if k < n { 0..n } else { n..2 * n };
        let left = LEFT * level.fold(0.0_f64, |most, j| most.max(at[j].abs())) / step;
        let own = fine[k].abs().max(at[k].abs() / size);
        (coarse[k] - fine[k]).abs() <= AGREES * own + left
    });
    if !agrees {
        return Err(
            "the start on the constraints does not change smoothly with it: keep numbers of the start that are independent"
                .to_owned(),
        );
    }
    let change = [fine.as_slice()[..n].to_vec(), fine.as_slice()[n..].to_vec()];
    Ok(on_constraints(machine, &here, change, parameter))
}

/// The name of a constraint that follows from others at a state: there accelerations have no derivatives.
pub fn dependent_constraint(machine: &InterpretedMachine, at: &State<Named>) -> Option<String> {
    let system = machine.prepare();
    let inputs = system.default_inputs().values;
    let reduced = Reduced::new(machine, &system, &inputs, &[]);
    let none_given = vec![false; at.q.values.len()];
    let choice = reduced.choose(&at.q.values, &none_given).ok()?;
    let mut constraints = system.constraints().enumerate();
    let dependent = constraints.find(|(k, _)| !choice.rows.contains(k));
    dependent.map(|(_, constraint)| constraint.name.to_owned())
}

/// A derivative of a state, changed by the least amount that makes it obey (E65).
fn on_constraints(
    machine: &InterpretedMachine,
    at: &State<Named>,
    [mut q, mut v]: Change,
    parameter: Option<usize>,
) -> Change {
    let rows = Rows::at(machine, at, parameter.map(|index| (index, 1.0)));
    let step = rows.least(&rows.residuals([&q, &v])[0], true);
    q.iter_mut()
        .zip(step.iter())
        .for_each(|(q, step)| *q -= step);
    let step = rows.least(&rows.residuals([&q, &v])[1], false);
    v.iter_mut()
        .zip(step.iter())
        .for_each(|(v, step)| *v -= step);
    [q, v]
}

/// How far a state and a derivative of it are off the constraints at the end of a run; the larger of the two, relative to the size
/// of the terms of the constraint. For a derivative by a parameter, the parameter is given with its change: 1, or the factor by
/// which the derivative was scaled.
pub fn off_constraints(
    machine: &InterpretedMachine,
    at: &State<Named>,
    [q, v]: [&[f64]; 2],
    parameter: Option<(usize, f64)>,
) -> f64 {
    let rows = Rows::at(machine, at, parameter);
    let changed = rows.residuals([q, v]);
    let own = rows.values.clone();
    let n = q.len();
    let size = |k: usize, list: &[f64], least: f64| -> f64 {
        (0..n)
            .map(|j| (rows.matrix[(k, j)] * list[j].abs().max(least)).abs())
            .sum::<f64>()
    };
    let mut most = 0.0_f64;
    for k in 0..rows.matrix.nrows() {
        for (off, own_size) in [
            (own[0][k], size(k, &at.q.values, 1e-3)),
            (changed[0][k], size(k, q, 1e-3)),
        ] {
            if off != 0.0 {
                most = most.max(off.abs() / own_size);
            }
        }
    }
    most
}

/// The rows of all constraints at a state.
struct Rows {
    machine: InterpretedMachine,
    at: State<Named>,
    parameter: Option<(usize, f64)>,
    /// G.
    matrix: DMatrix<f64>,
    /// Which constraints are on positions.
    holonomic: Vec<bool>,
    /// g and φ.
    values: [Vec<f64>; 2],
}

impl Rows {
    fn at(
        machine: &InterpretedMachine,
        at: &State<Named>,
        parameter: Option<(usize, f64)>,
    ) -> Rows {
        let system = machine.prepare();
        let (n, m) = (at.q.values.len(), system.constraints().len());
        let mut matrix = vec![0.0; m * n];
        system.constraint_matrix(at.t, &at.q.values, &mut matrix);
        let mut values = [vec![0.0; m], vec![0.0; m]];
        let [positions, rates] = &mut values;
        system.constraint_positions(at.t, &at.q.values, positions);
        system.constraint_rates(at.t, &at.q.values, &at.v.values, rates);
        Rows {
            holonomic: system.constraints().map(|one| one.holonomic).collect(),
            machine: machine.clone(),
            at: at.clone(),
            parameter,
            matrix: DMatrix::from_row_slice(m, n, &matrix),
            values,
        }
    }

    /// The left sides of (E65).
    fn residuals(&self, [q, v]: [&[f64]; 2]) -> [Vec<f64>; 2] {
        let dual = |values: &[f64], by: &[f64]| -> Vec<Dual<f64>> {
            let pairs = values.iter().zip(by);
            pairs
                .map(|(value, derivative)| Dual {
                    value: *value,
                    derivative: *derivative,
                })
                .collect()
        };
        let values = self.machine.parameter_values();
        let mut by = vec![0.0; values.len()];
        if let Some((parameter, change)) = self.parameter {
            by[parameter] = change;
        }
        let mut interpreter = Interpreter::new(self.machine.program(), &dual(values, &by));
        let (q, v) = (dual(&self.at.q.values, q), dual(&self.at.v.values, v));
        let inputs = self.machine.prepare().default_inputs().values;
        let u = dual(&inputs, &vec![0.0; inputs.len()]);
        [Role::ConstraintPositions, Role::ConstraintRates].map(|role| {
            let mut results = vec![Dual::constant(0.0); self.holonomic.len()];
            let arguments = Arguments {
                t: Dual::constant(self.at.t),
                q: &q,
                v: &v,
                u: &u,
                a: &[],
            };
            // Neither function has pivots, so the call cannot fail.
            let _ = interpreter.call(role, arguments, &mut results);
            results.iter().map(|one| one.derivative).collect()
        })
    }

    /// The least-norm step whose product with the rows, or with those on positions, is this vector.
    fn least(&self, right: &[f64], of_positions: bool) -> DVector<f64> {
        let rows: Vec<usize> = (0..right.len())
            .filter(|k| self.holonomic[*k] || !of_positions)
            .collect();
        let n = self.matrix.ncols();
        if rows.is_empty() {
            return DVector::zeros(n);
        }
        let size = |k: usize| {
            Some(self.matrix.row(k).norm())
                .filter(|x| *x > 0.0)
                .unwrap_or(1.0)
        };
        let matrix = DMatrix::from_fn(rows.len(), n, |i, j| {
            self.matrix[(rows[i], j)] / size(rows[i])
        });
        let right = DVector::from_fn(rows.len(), |i, _| right[rows[i]] / size(rows[i]));
        let svd = matrix.svd(true, true);
        let least = INDEPENDENT * svd.singular_values.max();
        svd.solve(&right, least)
            .unwrap_or_else(|_| DVector::zeros(n))
    }
}
