//! How a start on the constraints changes with a number that it depends on.
//!
//! A run projects its start onto the constraints by rules of its own: the least move that inertia allows, with some numbers kept. What
//! that makes of a changed number has no formula, so it is found by differences of such starts, of fourth order. They are then put
//! onto what the constraints themselves say, which is exact (dual numbers): with y = ∂q/∂s and ẏ,
//!
//! ```text
//! ∂g/∂q y + ∂g/∂s = 0,   ∂φ/∂q y + ∂φ/∂v ẏ + ∂φ/∂s = 0                              (E65)
//! ```
//!
//! Both are kept by the variational equations from there on.

use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{Machine, State, System};
use lagrangian_program::{Arguments, Interpreter, Role};
use lagrangian_scalar::Dual;
use nalgebra::{DMatrix, DVector};

use crate::reduced::Reduced;

/// Differences are taken over this share of a number. The error of fourth order is of the size of its fourth power, 1e-12, and what
/// a projection leaves, 1e-13, over it 1e-10.
const SHARE: f64 = 1e-3;

/// Two differences of a start that has a derivative agree to this share of it.
const AGREES: f64 = 1e-5;

/// What a projection leaves in a number, as a share of the largest beside it, some ten times.
const LEFT: f64 = 1e-12;

/// Singular values of the rows below this share of the largest are those of rows that follow from others.
const INDEPENDENT: f64 = 1e-9;

/// The derivative of a state: of its coordinates, and of its rates.
pub type Change = [Vec<f64>; 2];

/// What a start depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The parameter of this number.
    Parameter(usize),
    /// An input: no constraint reads one, so no start changes with it.
    Input,
    /// The coordinate of this number, before constraints move it.
    Start(usize),
    /// Its rate.
    Rate(usize),
}

/// What steps may move a motion and its derivatives off the constraints by, as a share of their numbers.
pub const DRIFT: f64 = 1e-5;

/// How a start on the constraints changes with what it depends on. `from` gives the start of a machine before constraints move it,
/// and `brought` that on the constraints; `start` is where the machine itself starts on them.
///
/// # Errors
/// What `brought` says, or that the start has no derivative.
pub fn change(
    machine: &InterpretedMachine,
    start: &State<Named>,
    cause: Cause,
    from: impl Fn(&InterpretedMachine) -> State<Named>,
    brought: impl Fn(&InterpretedMachine, State<Named>) -> Result<State<Named>, String>,
) -> Result<Change, String> {
    // A number that is 0 has the size of the largest beside it, or 1.
    let size = |own: f64, others: &[f64]| {
        let largest = others.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let mut sizes = [own.abs(), largest].into_iter();
        sizes.find(|size| *size > 0.0).unwrap_or(1.0)
    };
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
        let mut there = match cause {
            Cause::Parameter(index) => {
                if let Some(own) = machine.parameter_mut(index) {
                    *own += by;
                }
                from(&machine)
            }
            _ => start.clone(),
        };
        match cause {
            Cause::Start(k) => there.q.values[k] += by,
            Cause::Rate(k) => there.v.values[k] += by,
            Cause::Parameter(_) | Cause::Input => {}
        }
        brought(&machine, there)
    };
    derivative(machine, at, size, parameter)
}

/// How far the motion and its derivatives by some causes are off the constraints at the end of a run, as a share of their numbers:
/// the first cause for which that is more than [`DRIFT`], and how far.
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

/// The derivative of a start on the constraints. `start` gives the start where the number is another one by so much, and `size` is
/// the size of the number; `parameter` is the parameter that it is, if it is one.
///
/// # Errors
/// What `start` says, or that the start has no derivative.
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
    // Each number as a share of what it is in a change by the size of s, but for what projections leave.
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

/// The name of a constraint that follows from others at a state: accelerations have no derivatives there.
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

/// A derivative of a state, moved by the least that makes it obey (E65).
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

/// How far a state and a derivative of it are off the constraints at the end of a run, each as a share of the numbers that the
/// constraint is made of; the larger one. Of a derivative by a parameter, the parameter and by how much it changes: 1, or what the
/// derivative was multiplied by.
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
    /// Which constraints are of positions.
    holonomic: Vec<bool>,
    /// g, and φ.
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
            // Neither inverts anything.
            let _ = interpreter.call(role, arguments, &mut results);
            results.iter().map(|one| one.derivative).collect()
        })
    }

    /// The least step that the rows, or those of positions, multiply to this.
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
