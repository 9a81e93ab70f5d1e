//! Equilibria, steady motions, modes and linear models.

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{Machine as _, Simulation, System};
use lagrangian_linear::model::{self, Label, LinearModel, NoModel, Observed, Request};
use lagrangian_linear::motion::SteadyMotion;
use lagrangian_linear::poles::poles;
use lagrangian_linear::search::{MOST_STEPS, Wanted};
use lagrangian_linear::spectrum::damping;
use lagrangian_linear::steady::{self, Options};
use lagrangian_linear::zeros::zeros;
use lagrangian_linear::{Complex, DMatrix};
use lagrangian_sweep::charts::Charts;
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::machine::Machine;

/// The names of the arguments, for messages.
const OPTIONS: Options = Options {
    start: "start",
    steady: "steady",
};

/// A start, and which coordinates move steadily, and which of these have rates to be found; `None` for a model about
/// the start itself.
type Start = (f64, Vec<f64>, Vec<f64>);
type Steady = (Vec<bool>, Vec<bool>);

/// Names with their units.
type Labels = Vec<(String, String)>;

impl Machine {
    /// The machine with these values of its inputs. Machines with guided contacts are refused, because sticking friction has no
    /// linearization.
    fn linear(&self, py: Python<'_>, inputs: &[f64]) -> PyResult<InterpretedMachine> {
        self.check_parameters(py)?;
        let system = self.system();
        if system.contacts().len() + system.guides() > 0 {
            return Err(PyValueError::new_err(
                "sticking friction cannot be linearized: a machine with `sliding` has no modes and no linear model",
            ));
        }
        let mut machine = self.machine.clone();
        for (slot, value) in self.machine.program().inputs.iter().zip(inputs) {
            let set = machine.set(&slot.name.to_string(), *value);
            set.map_err(|unknown| PyValueError::new_err(unknown.to_string()))?;
        }
        Ok(machine)
    }
}

/// A machine in the Cartesian coordinates that its spec names, with a start in these and the names of its coordinates.
type InCartesian = (InterpretedMachine, Start, Vec<String>);

impl Machine {
    /// This machine with these values of its inputs and a start in the other chart; `None` if the spec names none, if a distance is negative,
    /// or if a polar coordinate moves steadily.
    fn linear_in_cartesian(
        &self,
        inputs: &[f64],
        (t, q, v): &Start,
        steady: Option<&Steady>,
    ) -> Option<InCartesian> {
        let (mut machine, points) = self.in_cartesian()?;
        for (slot, value) in self.machine.program().inputs.iter().zip(inputs) {
            machine.set(&slot.name.to_string(), *value).ok()?;
        }
        let is_steady = |place: &usize| steady.is_some_and(|(moves, _)| moves[*place]);
        if points.places().iter().flatten().any(is_steady) {
            return None;
        }
        let mut stated = self.machine.start();
        stated.t = *t;
        stated.q.values.clone_from(q);
        stated.v.values.clone_from(v);
        let (_, start) = Charts::begin(points, machine.start(), &stated).ok()?;
        let names = machine.program().coordinates.iter();
        let names = names.map(|slot| slot.name.to_string()).collect();
        Some((machine, (start.t, start.q.values, start.v.values), names))
    }
}

/// The start projected onto the constraints, as a run would do.
fn on_constraints(
    machine: &InterpretedMachine,
    (t, q, v): Start,
) -> Result<(Vec<f64>, Vec<f64>), String> {
    if machine.prepare().constraints().len() == 0 {
        return Ok((q, v));
    }
    let mut start = machine.start();
    start.t = t;
    start.q.values = q;
    start.v.values = v;
    let run = Simulation::new(machine).until(t).run_interpreted(start);
    let run = run.map_err(|error| error.to_string())?;
    let start = run.start();
    Ok((start.q.values.clone(), start.v.values.clone()))
}

/// The steady motion that the search finds from a start.
fn find_motion(
    machine: &InterpretedMachine,
    (_, q, v): Start,
    (steady, solved): Steady,
) -> Result<SteadyMotion, String> {
    let wanted = Wanted {
        steady,
        solved,
        rates: v,
        steps: MOST_STEPS,
    };
    if let Err(names) = steady::drives(machine, &q, &wanted) {
        let help = if names.is_empty() {
            String::new()
        } else {
            format!("; it stands still with {} = 0", names.join(" = 0, or "))
        };
        return Err(format!(
            "the machine is driven: its equations change with time, so that it is at rest nowhere{help}"
        ));
    }
    let motion = steady::motion(machine, &q, &wanted);
    let motion = motion.map_err(|none| none.in_words(&machine.prepare(), &wanted, OPTIONS))?;
    let smooth = model::check_smooth(machine, &motion);
    smooth.map_err(|none| none.in_words(&machine.prepare(), OPTIONS))?;
    Ok(motion)
}

fn array<'py>(py: Python<'py>, values: &[f64]) -> Bound<'py, PyArray1<f64>> {
    PyArray1::from_slice(py, values)
}

/// The entries row by row.
fn flat(matrix: &DMatrix<f64>) -> Vec<f64> {
    matrix.transpose().iter().copied().collect()
}

fn parts(values: &[Complex<f64>]) -> [Vec<f64>; 2] {
    [
        values.iter().map(|x| x.re).collect(),
        values.iter().map(|x| x.im).collect(),
    ]
}

/// The modes about the equilibrium or the steady motion near a start, as a dictionary.
#[pyfunction]
pub fn modes<'py>(
    machine: &Machine,
    py: Python<'py>,
    start: Start,
    inputs: Vec<f64>,
    steady: Steady,
) -> PyResult<Bound<'py, PyDict>> {
    let of = machine;
    let machine = of.linear(py, &inputs)?;
    let found = py.detach(|| {
        let found = find_motion(&machine, start.clone(), steady.clone());
        found.map(|motion| (motion, None)).or_else(|why| {
            // As about the centre of polar coordinates.
            let other = of.linear_in_cartesian(&inputs, &start, Some(&steady));
            let Some((machine, start, names)) = other else {
                return Err(why);
            };
            let found = find_motion(&machine, start, steady);
            found.map(|motion| (motion, Some(names))).map_err(|_| why)
        })
    });
    let (motion, names) = found.map_err(PyValueError::new_err)?;
    let all = PyDict::new(py);
    all.set_item("coordinates", names)?;
    let modes = &motion.modes.modes;
    let lambdas: Vec<Complex<f64>> = modes.iter().map(|mode| mode.lambda).collect();
    let shapes: Vec<Complex<f64>> = modes.iter().flat_map(|mode| mode.shape.clone()).collect();
    let ratios = lambdas.iter().map(|x| damping(*x).unwrap_or(f64::NAN));
    let errors: Vec<f64> = modes.iter().map(|mode| mode.error).collect();
    let kinds: Vec<&str> = modes.iter().map(|mode| mode.kind()).collect();
    let [re, im] = parts(&lambdas);
    all.set_item("re", array(py, &re))?;
    all.set_item("im", array(py, &im))?;
    let [re, im] = parts(&shapes);
    all.set_item("shapes_re", array(py, &re))?;
    all.set_item("shapes_im", array(py, &im))?;
    all.set_item("damping", array(py, &ratios.collect::<Vec<f64>>()))?;
    all.set_item("error", array(py, &errors))?;
    all.set_item("kinds", kinds)?;
    all.set_item("q", array(py, &motion.found.place.q()))?;
    all.set_item("v", array(py, &motion.v))?;
    all.set_item("free", motion.modes.free)?;
    Ok(all)
}

/// The linear model about the start itself, or about the equilibrium or the steady motion near it, as a dictionary. Outputs are
/// given by kind and index.
#[pyfunction]
pub fn linear_model<'py>(
    machine: &Machine,
    py: Python<'py>,
    start: Start,
    inputs: Vec<f64>,
    steady: Option<Steady>,
    wanted: (Vec<usize>, Vec<(String, usize)>),
) -> PyResult<Bound<'py, PyDict>> {
    let of = machine;
    let machine = of.linear(py, &inputs)?;
    let outputs = wanted.1.iter().map(observed);
    let request = Request {
        outputs: outputs.collect::<PyResult<_>>()?,
        inputs: wanted.0,
    };
    let model_of = |machine: &InterpretedMachine, start: Start| -> Result<LinearModel, String> {
        let why = |none: NoModel| none.in_words(&machine.prepare(), OPTIONS);
        match steady.clone() {
            Some(steady) => {
                let motion = find_motion(machine, start, steady)?;
                model::along(machine, &motion, &request).map_err(why)
            }
            None => {
                let t = start.0;
                let (q, v) = on_constraints(machine, start)?;
                model::about(machine, (t, &q, &v), &request).map_err(why)
            }
        }
    };
    // Outputs of the spec are the same in both charts; all coordinates are those of the chart.
    let all_coordinates = (0..of.dimension()).map(Observed::Coordinate);
    let is_of_spec = |of: &Observed| matches!(of, Observed::Output(_) | Observed::Multiplier(_));
    let may_change = request.outputs.iter().all(is_of_spec)
        || request.outputs.iter().copied().eq(all_coordinates);
    let made = py.detach(|| -> Result<_, String> {
        let found = model_of(&machine, start.clone()).map(|model| (model, None));
        let found = found.or_else(|why| {
            let other = of.linear_in_cartesian(&inputs, &start, steady.as_ref());
            let Some((machine, start, names)) = other.filter(|_| may_change) else {
                return Err(why);
            };
            let found = model_of(&machine, start);
            found.map(|model| (model, Some(names))).map_err(|_| why)
        });
        let (model, names) = found?;
        let none = || "the eigenvalues cannot be found".to_owned();
        let poles = poles(&model.a, &model.a_bounds).ok_or_else(none)?;
        let zeros = zeros(&model).ok_or_else(none)?;
        Ok((model, poles, zeros, names))
    });
    let (model, poles, zeros, names) = made.map_err(PyValueError::new_err)?;
    let poles: Vec<Complex<f64>> = poles.iter().map(|pole| pole.lambda).collect();
    let all = dictionary(py, &model)?;
    all.set_item("coordinates", names)?;
    for (name, values) in [("poles", &poles), ("zeros", &zeros)] {
        let [re, im] = parts(values);
        all.set_item(format!("{name}_re"), array(py, &re))?;
        all.set_item(format!("{name}_im"), array(py, &im))?;
    }
    Ok(all)
}

/// An output of a linear model, by kind and index.
fn observed((kind, k): &(String, usize)) -> PyResult<Observed> {
    match kind.as_str() {
        "coordinate" => Ok(Observed::Coordinate(*k)),
        "rate" => Ok(Observed::Rate(*k)),
        "acceleration" => Ok(Observed::Acceleration(*k)),
        "multiplier" => Ok(Observed::Multiplier(*k)),
        "output" => Ok(Observed::Output(*k)),
        kind => Err(PyValueError::new_err(format!("no kind of output {kind:?}"))),
    }
}

/// A linear model as a dictionary.
fn dictionary<'py>(py: Python<'py>, model: &LinearModel) -> PyResult<Bound<'py, PyDict>> {
    let LinearModel {
        a,
        b,
        c,
        d,
        basis,
        drift,
        q,
        v,
        u,
        y,
        states,
        inputs,
        outputs,
        records,
        ..
    } = model;
    let all = PyDict::new(py);
    for (name, matrix) in [("A", a), ("B", b), ("C", c), ("D", d), ("basis", basis)] {
        all.set_item(name, array(py, &flat(matrix)))?;
    }
    for (name, values) in [("drift", drift), ("q", q), ("v", v), ("u", u), ("y", y)] {
        all.set_item(name, array(py, values))?;
    }
    let labels = |labels: &[Label]| -> Labels {
        let labels = labels.iter().cloned();
        labels.map(|label| (label.name, label.unit)).collect()
    };
    all.set_item("states", labels(states))?;
    all.set_item("inputs", labels(inputs))?;
    all.set_item("outputs", labels(outputs))?;
    all.set_item("left_out", records)?;
    all.set_item("is_reduced", model.is_reduced)?;
    Ok(all)
}
