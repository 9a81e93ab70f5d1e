//! A finished run.

use lagrangian::interpreted::{InterpretedMachine, Named, Recording};
use lagrangian::methods::Method;
use lagrangian::{Ending, Solution, State, System};
use lagrangian_cli::report::{CallSettings, Report, recording_refinement};
use lagrangian_mechanics::Compiled;
use lagrangian_sweep::charts::{self, Charts};
use lagrangian_sweep::verdict;
use numpy::PyArray1;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::inputs::SharedLaw;
use crate::machine::Machine;

/// A run with the requested states.
#[pyclass(frozen, module = "lagrangian._native")]
pub struct Run {
    solution: Solution<InterpretedMachine, SharedLaw>,
    states: Vec<State<Named>>,
    /// How the run is shown in the coordinates of the spec, if it is in others.
    charts: Option<Charts>,
}

/// Time, coordinates and rates of k states, flat.
type States<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
);

/// Name, unit and values.
type Column<'py> = (String, String, Bound<'py, PyArray1<f64>>);

fn arrays<'py>(py: Python<'py>, states: &[State<Named>]) -> States<'py> {
    let t = states.iter().map(|state| state.t).collect();
    let q = states
        .iter()
        .flat_map(|state| state.q.values.iter().copied());
    let v = states
        .iter()
        .flat_map(|state| state.v.values.iter().copied());
    let [t, q, v] = [t, q.collect(), v.collect()].map(|of| PyArray1::from_vec(py, of));
    (t, q, v)
}

impl Run {
    pub fn new(
        solution: Solution<InterpretedMachine, SharedLaw>,
        states: Vec<State<Named>>,
        charts: Option<Charts>,
    ) -> Run {
        Run {
            solution,
            states,
            charts,
        }
    }

    /// States of the run in the coordinates of the spec.
    fn shown<'py>(&self, py: Python<'py>, states: &[State<Named>]) -> States<'py> {
        let Some(charts) = &self.charts else {
            return arrays(py, states);
        };
        let shown: Vec<State<Named>> = states.iter().map(|state| charts.shown(state)).collect();
        arrays(py, &shown)
    }

    fn states_at(&self, py: Python<'_>, times: Vec<f64>) -> PyResult<Vec<State<Named>>> {
        let states = py.detach(|| self.solution.at_each(times));
        states.map_err(|error| PyValueError::new_err(error.to_string()))
    }
}

#[pymethods]
impl Run {
    /// The requested states.
    fn samples<'py>(&self, py: Python<'py>) -> States<'py> {
        self.shown(py, &self.states)
    }

    /// The states at times.
    fn at<'py>(&self, py: Python<'py>, times: Vec<f64>) -> PyResult<States<'py>> {
        Ok(self.shown(py, &self.states_at(py, times)?))
    }

    /// Names, units and values of all observable quantities, at the requested states or at these times.
    #[pyo3(signature = (times=None))]
    fn columns<'py>(&self, py: Python<'py>, times: Option<Vec<f64>>) -> PyResult<Vec<Column<'py>>> {
        let made;
        let states = match times {
            None => &self.states,
            Some(times) => {
                made = self.states_at(py, times)?;
                &made
            }
        };
        let charts = self.charts.as_ref();
        let recording = py.detach(|| charts::record(&self.solution, states, charts));
        let columns = recording.columns.into_iter();
        Ok(columns
            .map(|column| {
                (
                    column.name,
                    column.unit,
                    PyArray1::from_vec(py, column.values),
                )
            })
            .collect())
    }

    /// The page that shows the run of a machine; the arguments give the name of the file, the tolerance, and
    /// the laws of inputs.
    fn page(
        &self,
        py: Python<'_>,
        machine: &Machine,
        asked: (String, String, Vec<(String, String)>),
        method: &str,
        error: Option<String>,
    ) -> PyResult<String> {
        let (start, end) = (self.solution.start(), self.solution.end());
        let duration = end.t - start.t;
        let dimension = start.q.values.len();
        let parts = if duration == 0.0 {
            0
        } else {
            1000 * u64::from(recording_refinement(
                dimension,
                duration,
                duration / 1000.0,
                false,
            ))
        };
        let time = |k: u64| {
            if k == parts {
                end.t
            } else {
                start.t + duration * (k as f64 / parts as f64)
            }
        };
        let states = self.states_at(py, (0..=parts).map(time).collect())?;
        let method = Method::named(method).unwrap_or_default();
        let (file, tolerance, inputs) = asked;
        let constants = machine.derived.text.constants.iter();
        let asked = CallSettings {
            file,
            tolerance,
            constants: constants.map(|(name, _)| name.clone()).collect(),
            inputs,
        };
        let cartesian = match self.charts {
            Some(_) => machine.in_cartesian().map(|(machine, _)| machine),
            None => None,
        };
        let made = py.detach(|| {
            let mut recording = Recording::of(&self.solution, &states);
            if let Some(charts) = &self.charts {
                recording = charts.with_polar(&recording, &states);
            }
            machine.derived.with_model(|mut model, report| {
                if self.charts.is_some() {
                    model = *model.cartesian.take()?;
                }
                let compiled = Compiled::new(model, report)?;
                let report = Report {
                    asked: &asked,
                    compiled: &compiled,
                    machine: cartesian.as_ref().unwrap_or(&machine.machine),
                    method,
                    run: (&self.solution).into(),
                    recording: &recording,
                    contacts: &[],
                    error,
                    is_interrupted: false,
                };
                Some(report.page())
            })
        });
        let page = made.map_err(|trouble| trouble.raise(py))?;
        page.ok_or_else(|| {
            PyRuntimeError::new_err("the machine was derived before, but cannot be derived again")
        })
    }

    /// The inputs at times and states.
    fn inputs<'py>(
        &self,
        py: Python<'py>,
        t: Vec<f64>,
        q: Vec<f64>,
        v: Vec<f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let system = self.solution.system();
        let n = system.coordinates().len();
        let mut all = Vec::new();
        for (k, t) in t.into_iter().enumerate() {
            let part = |of: &[f64]| of[k * n..][..n].to_vec();
            let (q, v) = (part(&q), part(&v));
            let state = match &self.charts {
                Some(charts) => charts.in_run(t, &q, &v),
                None => {
                    let mut state = self.solution.start().clone();
                    (state.t, state.q.values, state.v.values) = (t, q, v);
                    state
                }
            };
            let seen = self.solution.observe_state(&state);
            let seen = seen.map_err(|error| PyValueError::new_err(error.to_string()))?;
            all.extend(seen.inputs.values);
        }
        Ok(PyArray1::from_vec(py, all))
    }

    #[getter]
    fn start<'py>(&self, py: Python<'py>) -> States<'py> {
        self.shown(py, std::slice::from_ref(self.solution.start()))
    }

    #[getter]
    fn end<'py>(&self, py: Python<'py>) -> States<'py> {
        self.shown(py, std::slice::from_ref(self.solution.end()))
    }

    #[getter]
    fn ending(&self) -> String {
        match self.solution.ending() {
            Ending::End => "time".into(),
            Ending::Event(name) => format!("event {name}"),
            Ending::Stopped => "stop".into(),
            _ => "error".into(),
        }
    }

    /// Names, directions and states of events.
    fn events<'py>(&self, py: Python<'py>) -> (Vec<String>, Vec<i32>, States<'py>) {
        let events = self.solution.events();
        let names = events.iter().map(|event| event.name.clone()).collect();
        let directions = events.iter().map(|event| match event.crossing {
            lagrangian::Crossing::Rising => 1,
            lagrangian::Crossing::Falling => -1,
            lagrangian::Crossing::Any => 0,
        });
        let states: Vec<_> = events.iter().map(|event| event.state.clone()).collect();
        (names, directions.collect(), self.shown(py, &states))
    }

    /// The energy balance, if it was recorded.
    fn energy<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(balance) = self.solution.energy_balance() else {
            return Ok(None);
        };
        let all = PyDict::new(py);
        for (name, value) in [
            ("start", balance.start),
            ("end", balance.end),
            ("work", balance.work),
            ("dissipated", balance.dissipated),
            ("exchanged", balance.exchanged),
            ("residual", balance.residual()),
            ("relative", balance.relative()),
        ] {
            all.set_item(name, value)?;
        }
        Ok(Some(all))
    }

    #[getter]
    fn statistics<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let statistics = self.solution.statistics();
        let all = PyDict::new(py);
        all.set_item("steps", statistics.steps)?;
        all.set_item("rejected", statistics.rejected)?;
        all.set_item("evaluations", statistics.evaluations)?;
        all.set_item("constraint_residual", statistics.constraint_residual)?;
        all.set_item("stiff_since", statistics.stiff_since)?;
        all.set_item("seconds", statistics.seconds)?;
        Ok(all)
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        let warnings = self.solution.warnings().iter();
        warnings.map(ToString::to_string).collect()
    }

    /// The methods that an automatic run chose: start time, name, reason.
    #[getter]
    fn choices(&self) -> Vec<(f64, &'static str, String)> {
        let choices = self.solution.choices().iter();
        choices
            .map(|of| (of.t, of.method.tableau.name, of.reason.to_string()))
            .collect()
    }

    /// What is wrong with a run that reached its end: too much energy is missing.
    fn objection(&self) -> Option<String> {
        verdict::energy_error(&self.solution)
    }
}
