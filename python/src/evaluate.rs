//! Evaluates batches of states, with the same bits as each state alone.

use std::num::NonZero;
use std::sync::Mutex;
use std::sync::PoisonError;
use std::sync::atomic::{AtomicUsize, Ordering};

use lagrangian::interpreted::{InterpretedSystem, Named};
use lagrangian::{At, Evaluation, Linearize, Machine as _, Pivot, Singular, StepError, System};
use numpy::{PyArray1, PyReadonlyArray1, PyReadonlyArray2, PyReadwriteArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use lagrangian_jit::{Several, SeveralArguments};
use lagrangian_native::Lanes;
use lagrangian_program::{Interpreter, Role};

use crate::errors;
use crate::machine::Machine;

/// The number of states that justifies a thread: at some tenths of a microsecond each, fewer take less time
/// than starting one.
const ROWS_A_THREAD: usize = 4096;

/// The number of states evaluated side by side.
const LANES: usize = 8;

/// The number of states that justifies compiling code for several at once, which takes a fifth of a
/// microsecond per operation.
const WORTH_LANES: usize = 1024;

/// The number of threads that evaluate a batch; 0, the default, for as many as there are cores.
static THREADS: AtomicUsize = AtomicUsize::new(0);

/// Sets the number of threads that evaluate a batch; 0 for all cores.
#[pyfunction]
pub fn set_threads(count: usize) {
    THREADS.store(count, Ordering::Relaxed);
}

fn threads() -> usize {
    match THREADS.load(Ordering::Relaxed) {
        0 => std::thread::available_parallelism().map_or(1, NonZero::get),
        count => count,
    }
}

/// The arguments of K states: a row each of coordinates, rates and inputs, and the values of parameters that vary.
pub struct Batch<'a> {
    pub t: &'a [f64],
    pub q: &'a [f64],
    pub v: &'a [f64],
    pub u: &'a [f64],
    /// The names of parameters, with K values each.
    pub varied: &'a [(String, Vec<f64>)],
}

/// Buffers for one state.
struct Scratch {
    q: Vec<f64>,
    v: Vec<f64>,
    u: Named,
    a: Vec<f64>,
}

impl Batch<'_> {
    /// Calls a function with the system and the state of each row, in order.
    fn each(
        &self,
        machine: &Machine,
        rows: impl Iterator<Item = usize>,
        mut work: impl FnMut(usize, &InterpretedSystem, &mut Scratch),
    ) {
        let (n, m) = (machine.dimension(), machine.inputs.values.len());
        let mut scratch = Scratch {
            q: vec![0.0; n],
            v: vec![0.0; n],
            u: machine.inputs.clone(),
            a: vec![0.0; n],
        };
        let own = machine.system();
        let mut other = machine.machine.clone();
        for k in rows {
            scratch.q.copy_from_slice(&self.q[k * n..][..n]);
            scratch.v.copy_from_slice(&self.v[k * n..][..n]);
            scratch.u.values.copy_from_slice(&self.u[k * m..][..m]);
            if self.varied.is_empty() {
                work(k, &own, &mut scratch);
                continue;
            }
            for (name, values) in self.varied {
                let _ = other.set(name, values[k]); // the name was checked
            }
            work(k, &other.prepare(), &mut scratch);
        }
    }

    /// Evaluates accelerations of rows in lanes, with the bits of a single state; returns the rows that have none.
    fn side_by_side(
        &self,
        lanes: &mut Several<LANES>,
        rows: std::ops::Range<usize>,
        out: &mut [f64],
    ) -> Vec<usize> {
        let [n, m] = [self.q.len(), self.u.len()].map(|of| of / self.t.len().max(1));
        let zero = || Lanes::<LANES>::splat(0.0);
        let [mut q, mut v, mut a] = [(); 3].map(|()| vec![zero(); n]);
        let mut u = vec![zero(); m];
        let mut alone = Vec::new();
        let mut blocks = out.chunks_exact_mut(LANES * n.max(1));
        let mut first = rows.start;
        for block in blocks.by_ref() {
            let gather = |to: &mut [Lanes<LANES>], from: &[f64], width: usize| {
                for (i, lanes) in to.iter_mut().enumerate() {
                    for (lane, value) in lanes.0.iter_mut().enumerate() {
                        *value = from[(first + lane) * width + i];
                    }
                }
            };
            gather(&mut q, self.q, n);
            gather(&mut v, self.v, n);
            gather(&mut u, self.u, m);
            let mut t = zero();
            t.0.copy_from_slice(&self.t[first..][..LANES]);
            let arguments = SeveralArguments {
                t,
                q: &q,
                v: &v,
                u: &u,
                a: &[],
            };
            let held = lanes.call(Role::Accelerations, arguments, &mut a);
            let held = held.unwrap_or(0);
            for lane in 0..LANES {
                if held >> lane & 1 == 0 {
                    alone.push(first + lane);
                    continue;
                }
                for (i, lanes) in a.iter().enumerate() {
                    block[lane * n + i] = lanes.0[lane];
                }
            }
            first += LANES;
        }
        alone.extend(first..rows.end);
        alone
    }

    /// Raises `ValueError` if a row has parameters that the spec refuses.
    fn check(&self, py: Python<'_>, machine: &Machine) -> PyResult<()> {
        if self.varied.is_empty() {
            return machine.check_parameters(py);
        }
        let mut other = machine.machine.clone();
        let mut all = Vec::with_capacity(self.t.len());
        for k in 0..self.t.len() {
            for (name, values) in self.varied {
                let set = other.set(name, values[k]);
                set.map_err(|unknown| {
                    errors::raise(
                        py,
                        "UnknownName",
                        ("parameter", unknown.name, unknown.known, unknown.near),
                    )
                })?;
            }
            all.push(other.parameter_values().to_vec());
        }
        let refused = py.detach(|| machine.derived.first_refused(&all));
        match refused.map_err(|trouble| trouble.raise(py))? {
            None => Ok(()),
            Some((place, message)) => {
                let message = format!("parameters at {place}: {message}");
                Err(PyValueError::new_err(message))
            }
        }
    }
}

fn slice<'a>(array: &'a PyReadonlyArray2<'_, f64>) -> PyResult<&'a [f64]> {
    array
        .as_slice()
        .map_err(|error| PyValueError::new_err(error.to_string()))
}

/// Accelerations of K states into `out`, (K, n), with whether each has any; rows without are NaN.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they are arrays")]
pub fn accelerations<'py>(
    machine: &Machine,
    py: Python<'py>,
    t: PyReadonlyArray1<'py, f64>,
    q: PyReadonlyArray2<'py, f64>,
    v: PyReadonlyArray2<'py, f64>,
    u: PyReadonlyArray2<'py, f64>,
    varied: Vec<(String, Vec<f64>)>,
    mut out: PyReadwriteArray2<'py, f64>,
    raises: bool,
) -> PyResult<()> {
    let batch = Batch {
        t: t.as_slice()?,
        q: slice(&q)?,
        v: slice(&v)?,
        u: slice(&u)?,
        varied: &varied,
    };
    batch.check(py, machine)?;
    let n = machine.dimension();
    let out = out.as_slice_mut()?;
    let rows = batch.t.len();
    let failed: Mutex<Option<(usize, Singular)>> = Mutex::new(None);
    py.detach(|| {
        let parts = threads().min(rows.div_ceil(ROWS_A_THREAD)).max(1);
        let length = rows.div_ceil(parts).max(1);
        let lanes = if batch.varied.is_empty() && rows >= WORTH_LANES {
            machine.in_lanes()
        } else {
            None
        };
        let part = |first: usize, out: &mut [f64]| {
            let count = out.len().checked_div(n).unwrap_or(0);
            // Rows without accelerations are evaluated alone, to obtain the reason.
            let alone: Vec<usize> = match lanes.clone() {
                Some(mut lanes) => batch.side_by_side(&mut lanes, first..first + count, out),
                None => (first..first + count).collect(),
            };
            batch.each(machine, alone.into_iter(), |k, system, scratch| {
                let Scratch { q, v, u, a } = scratch;
                let to = &mut out[(k - first) * n..][..n];
                match system.accelerations(batch.t[k], q, v, u, a) {
                    Ok(()) => to.copy_from_slice(a),
                    Err(singular) => {
                        to.fill(f64::NAN);
                        let is_number = q.iter().chain(&*v).all(|x| x.is_finite());
                        let mut failed = failed.lock().unwrap_or_else(PoisonError::into_inner);
                        if is_number && failed.is_none_or(|(known, _)| k < known) {
                            *failed = Some((k, singular));
                        }
                    }
                }
            });
        };
        if parts == 1 {
            part(0, out);
            return;
        }
        std::thread::scope(|scope| {
            for (number, out) in out.chunks_mut(length * n.max(1)).enumerate() {
                let part = &part;
                scope.spawn(move || part(number * length, out));
            }
        });
    });
    match failed.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some((place, singular)) if raises => Err(errors::of_singular(
            py,
            &*machine.system(),
            singular,
            Some(place),
        )),
        _ => Ok(()),
    }
}

/// All quantities at K states: flat arrays by name, with a row for each state, and which rows are valid.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they are arrays")]
pub fn evaluate<'py>(
    machine: &Machine,
    py: Python<'py>,
    t: PyReadonlyArray1<'py, f64>,
    q: PyReadonlyArray2<'py, f64>,
    v: PyReadonlyArray2<'py, f64>,
    u: PyReadonlyArray2<'py, f64>,
    varied: Vec<(String, Vec<f64>)>,
    raises: bool,
) -> PyResult<(Bound<'py, PyDict>, Vec<bool>)> {
    let batch = Batch {
        t: t.as_slice()?,
        q: slice(&q)?,
        v: slice(&v)?,
        u: slice(&u)?,
        varied: &varied,
    };
    batch.check(py, machine)?;
    let mut results = Vec::with_capacity(batch.t.len());
    py.detach(|| {
        batch.each(machine, 0..batch.t.len(), |k, system, scratch| {
            let Scratch { q, v, u, .. } = scratch;
            results.push(Evaluation::of(
                system,
                At {
                    t: batch.t[k],
                    q,
                    v,
                    u,
                },
            ));
        });
    });
    let (n, system) = (machine.dimension(), machine.system());
    let outputs = machine.derived.outputs.len();
    let widths = [
        ("mass_matrix", n * n),
        ("bias", n),
        ("applied", n),
        ("forces", n),
        ("accelerations", n),
        ("reactions", n),
        ("multipliers", system.constraints().len()),
        ("outputs", outputs),
        ("contacts", 4 * system.contacts().len()),
        ("unilateral", 6 * system.unilateral_contacts().len()),
        ("kinetic_energy", 1),
        ("potential_energy", 1),
        ("dissipation", 1),
    ];
    let mut columns: Vec<Vec<f64>> = widths
        .iter()
        .map(|(_, width)| Vec::with_capacity(width * results.len()))
        .collect();
    let mut is_valid = Vec::with_capacity(results.len());
    for (place, result) in results.into_iter().enumerate() {
        is_valid.push(result.is_ok());
        match result {
            Ok(evaluation) => {
                for (column, values) in columns.iter_mut().zip(flat(evaluation, outputs)) {
                    column.extend(values);
                }
            }
            Err(error) if raises => return Err(machine.raised(py, error, place)),
            Err(_) => {
                for (column, (_, width)) in columns.iter_mut().zip(widths) {
                    column.resize(column.len() + width, f64::NAN);
                }
            }
        }
    }
    let by_name = PyDict::new(py);
    for ((name, _), column) in widths.iter().zip(columns) {
        by_name.set_item(name, PyArray1::from_vec(py, column))?;
    }
    Ok((by_name, is_valid))
}

/// The quantities at one state, flat, with the first `outputs` outputs.
fn flat(evaluation: Evaluation<Named>, outputs: usize) -> [Vec<f64>; 13] {
    let flag = |is: bool| f64::from(u8::from(is));
    let contacts = evaluation.contacts.iter();
    let contacts = contacts.flat_map(|c| [c.normal, c.friction, c.slip, flag(c.sticks)]);
    let unilateral = evaluation.unilateral.iter().flat_map(|c| {
        let [closed, sticks] = [c.closed, c.sticks].map(flag);
        [c.gap, c.normal, c.friction, c.slip, closed, sticks]
    });
    let reactions = if evaluation.reactions.is_empty() {
        vec![0.0; evaluation.bias.len()]
    } else {
        evaluation.reactions
    };
    [
        evaluation.mass_matrix,
        evaluation.bias,
        evaluation.applied,
        evaluation.forces,
        evaluation.accelerations,
        reactions,
        evaluation.multipliers,
        evaluation.outputs.values[..outputs].to_vec(),
        contacts.collect(),
        unilateral.collect(),
        vec![evaluation.kinetic_energy],
        vec![evaluation.potential_energy],
        vec![evaluation.dissipation],
    ]
}

/// Derivatives by coordinates, and by rates.
type Derivatives<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

/// Derivatives of the accelerations at a state: by coordinates and by rates, (n, n), flat.
#[pyfunction]
pub fn linearize<'py>(
    machine: &Machine,
    py: Python<'py>,
    t: f64,
    q: Vec<f64>,
    v: Vec<f64>,
    u: Vec<f64>,
) -> PyResult<Derivatives<'py>> {
    machine.check_parameters(py)?;
    let n = machine.dimension();
    let mut inputs = machine.inputs.clone();
    inputs.values.copy_from_slice(&u);
    let (mut a, mut by_q, mut by_v) = (vec![0.0; n], vec![0.0; n * n], vec![0.0; n * n]);
    let system = machine.system();
    match system.linearize(t, &q, &v, &inputs, &mut a, &mut by_q, &mut by_v) {
        Ok(()) => Ok((PyArray1::from_vec(py, by_q), PyArray1::from_vec(py, by_v))),
        Err(singular) if matches!(singular.at, Pivot::NotDifferentiated(_)) => {
            Err(PyValueError::new_err(format!(
                "the accelerations of a machine with contacts that stick or slide have no derivatives: `{}`",
                singular.name(&*system)
            )))
        }
        Err(singular) => Err(errors::of_singular(py, &*system, singular, None)),
    }
}

impl Machine {
    /// Code for several states of this machine, if available. Machines with friction have none, because their accelerations also
    /// depend on the contact state.
    fn in_lanes(&self) -> Option<Several<LANES>> {
        let program = self.machine.program();
        if self.is_interpreted || !program.contacts.is_empty() || self.dimension() == 0 {
            return None;
        }
        let library = self.derived.library(LANES)?;
        Several::shared(
            library,
            &Interpreter::new(program, self.machine.parameter_values()),
        )
    }

    fn raised(&self, py: Python<'_>, error: StepError, place: usize) -> PyErr {
        match error {
            StepError::Singular { singular, .. } => {
                errors::of_singular(py, &*self.system(), singular, Some(place))
            }
            error => {
                let error = lagrangian::Error::of_step(error, &*self.system());
                PyValueError::new_err(error.to_string())
            }
        }
    }
}
