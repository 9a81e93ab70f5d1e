//! What is recorded while a run is made, and its outcome.

use lagrangian::State;
use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named};

use crate::charts::{self, Charts};
use crate::plan::Plan;
use crate::reduce::{StateCache, StepStates, Tracker};
use crate::rows::{Cell, Rows};

/// What is recorded while a run is made.
pub(super) struct Recorder {
    pub(super) trackers: Vec<Option<Tracker>>,
    /// The states at recorded instants.
    pub(super) at: Vec<Option<State<Named>>>,
    pub(super) samples: Option<Rows>,
    /// The index of the next sample.
    pub(super) due: u64,
    /// The states that the trackers evaluated within the step.
    pub(super) cache: StateCache,
}

impl Recorder {
    /// Records a step.
    pub(super) fn record_step(
        &mut self,
        plan: &Plan,
        run: u64,
        (system, charts): (&InterpretedSystem, Option<&Charts>),
        step: &mut dyn lagrangian::StepMotion<InterpretedMachine>,
    ) -> Result<(), lagrangian::Error> {
        let [from, to] = step.span();
        for (t, state) in plan.at.iter().zip(&mut self.at) {
            if (t - from) * (to - t) >= 0.0 && *t != from {
                *state = Some(charts::shown(charts, &step.state(*t)?));
            }
        }
        if let (Some(every), Some(samples)) = (plan.every, &mut self.samples) {
            loop {
                let t = self.due as f64 * every.copysign(plan.until);
                if (t - to) * plan.until.signum() > 0.0 || is_end(t, plan.until) {
                    break;
                }
                let state = charts::shown(charts, &step.state(t)?);
                samples.push(sample(run, &state));
                self.due += 1;
            }
        }
        let theta = match plan.after {
            None => 0.0,
            Some(after) if (after - to) * plan.until.signum() >= 0.0 => return Ok(()),
            Some(after) => ((after - from) / (to - from)).max(0.0),
        };
        if self.trackers.iter().all(Option::is_none) {
            return Ok(());
        }
        let states = StepStates::new(system, step, &mut self.cache);
        for tracker in self.trackers.iter_mut().flatten() {
            tracker.add_step(&states, theta)?;
        }
        Ok(())
    }

    /// Adds the recorded instants and samples at the ends of a run, which may have taken no step.
    pub(super) fn record_ends(
        &mut self,
        plan: &Plan,
        (run, start, end): (u64, &State<Named>, &State<Named>),
    ) {
        for (t, state) in plan.at.iter().zip(&mut self.at) {
            if *t == start.t {
                *state = Some(start.clone());
            }
        }
        if let (Some(_), Some(samples)) = (plan.every, &mut self.samples) {
            samples.push(sample(run, end));
        }
    }
}

/// Whether a time is the end of a run, or before it only by round-off.
pub(super) fn is_end(t: f64, until: f64) -> bool {
    (until - t) * until.signum() <= 4.0 * f64::EPSILON * until.abs()
}

pub(super) fn sample(run: u64, state: &State<Named>) -> Vec<Cell> {
    let numbers = std::iter::once(state.t)
        .chain(state.q.values.iter().copied())
        .chain(state.v.values.iter().copied());
    let numbers = numbers.map(|number| Cell::Number(Some(number)));
    std::iter::once(Cell::Count(run)).chain(numbers).collect()
}

/// The outcome of a run.
pub(super) struct Outcome {
    pub(super) status: String,
    pub(super) error: Option<String>,
    pub(super) end: State<Named>,
    pub(super) at: Vec<Option<State<Named>>>,
    pub(super) reductions: Vec<Option<f64>>,
    pub(super) steps: u64,
    /// The methods of the run, if it chose them.
    pub(super) methods: Option<String>,
    pub(super) residual: Option<f64>,
    pub(super) samples: Option<Rows>,
}

impl Outcome {
    /// The outcome of a run that could not start.
    pub(super) fn failed(start: State<Named>, instants: usize, reductions: usize) -> Outcome {
        Outcome {
            status: "failed".into(),
            error: None,
            end: start,
            at: vec![None; instants],
            reductions: vec![None; reductions],
            steps: 0,
            methods: None,
            residual: None,
            samples: None,
        }
    }

    /// The cells of a row behind those of the design. `with_methods` says that the rows tell which methods runs chose.
    pub(super) fn into_cells(self, with_methods: bool) -> Vec<Cell> {
        let dimension = self.end.q.values.len();
        let State { t, q, v } = self.end;
        let mut cells = vec![Cell::Text(Some(self.status)), Cell::Text(self.error)];
        let known = std::iter::once(t).chain(q.values).chain(v.values);
        cells.extend(known.map(|value| Cell::Number(Some(value))));
        for state in self.at {
            match state {
                Some(State { q, v, .. }) => {
                    let values = q.values.into_iter().chain(v.values);
                    cells.extend(values.map(|value| Cell::Number(Some(value))));
                }
                None => cells.extend(std::iter::repeat_n(Cell::Number(None), 2 * dimension)),
            }
        }
        cells.extend(self.reductions.into_iter().map(Cell::Number));
        cells.push(Cell::Count(self.steps));
        cells.push(Cell::Number(self.residual));
        if with_methods {
            cells.push(Cell::Text(self.methods));
        }
        cells
    }
}
