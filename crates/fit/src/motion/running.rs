//! The runs of a fit: motions at the measured times, and their derivatives.

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named, Signals};
use lagrangian::{InputLaw, Machine, Piece, Simulation, State, System, Turns, to_cartesian};
use lagrangian_linear::across::{self, NoDerivatives};
use lagrangian_linear::varied::{Direction, Varied, VariedInputs, VariedLaw, VariedSystem};
use lagrangian_linear::{charts, starts};

use super::{Chart, Column, ELSEWHERE, Experiment, Fit, Quantity, Subject};
use crate::least_squares::Trouble;

/// A run before its first step.
struct Begun<'f> {
    /// The machine in the coordinates of the run.
    machine: InterpretedMachine,
    /// The start in the coordinates of the spec, before the projection onto the constraints.
    stated: State<Named>,
    /// That start in the coordinates of the run.
    start: State<Named>,
    /// For each point that the run has in Cartesian coordinates the indices of its distance and its angle.
    points: &'f [[usize; 2]],
}

/// Why there are no integrated derivatives.
pub(super) enum RunFailure {
    /// There is no motion, or the search was interrupted.
    Trouble(Trouble),
    /// There is a motion, but its derivatives must come from differences; the text says why.
    WithoutDerivatives(String),
}

impl From<Trouble> for RunFailure {
    fn from(trouble: Trouble) -> RunFailure {
        RunFailure::Trouble(trouble)
    }
}

/// One row of a run: the values of all columns and, if these are integrated, their derivatives in all directions.
pub(super) struct Row {
    pub values: Vec<f64>,
    pub by: Vec<Vec<f64>>,
}

/// What makes the derivatives of the measured quantities of those of the motion.
struct RowOfDerivatives<'r> {
    columns: &'r [Column],
    /// The points whose polar coordinates the spec states, in a run in Cartesian ones.
    points: &'r [[usize; 2]],
    /// The number of coordinates.
    n: usize,
    /// The places of the numbers that affect the experiment.
    affecting: &'r [usize],
    /// The sizes by which all numbers are scaled.
    sizes: &'r [f64],
}

impl RowOfDerivatives<'_> {
    /// The derivatives at an instant, by the numbers themselves.
    fn row(
        &self,
        system: &VariedSystem,
        (t, q, v): (f64, &Vec<f64>, &Vec<f64>),
        (a, u): (&Vec<f64>, &VariedInputs),
    ) -> Row {
        let n = self.n;
        let (mut shown_q, mut shown_v) = (q.clone(), v.clone());
        charts::to_polar(self.points, n, [&mut shown_q, &mut shown_v]);
        let of_each = |list: &[f64], i: usize| -> Vec<f64> {
            (1..=self.affecting.len())
                .map(|k| list[k * n + i])
                .collect()
        };
        let by = |column: &Column| -> Vec<f64> {
            let scaled = match column.quantity {
                Quantity::Coordinate(i) => of_each(&shown_q, i),
                Quantity::Rate(i) => of_each(&shown_v, i),
                Quantity::Output(i) => system.output(i, t, [q, v, a], u),
            };
            let mut all = vec![0.0; self.sizes.len()];
            for (j, by) in self.affecting.iter().zip(scaled) {
                all[*j] = by / self.sizes[*j];
            }
            all
        };
        Row {
            values: Vec::new(),
            by: self.columns.iter().map(by).collect(),
        }
    }
}

impl Fit<'_> {
    /// The machine in whose coordinates a run is made, with its start there; and for each point in polar coordinates that this run has in
    /// Cartesian ones the indices of its coordinates. A negative distance exists only in polar coordinates.
    fn begun(&self, experiment: usize, x: &[f64]) -> Result<Begun<'_>, Trouble> {
        let machine = self.machine(experiment, x)?;
        let stated = self.start(experiment, x)?;
        let chart = self.experiments[experiment].chart.as_ref();
        let is_there = |chart: &&Chart| {
            let mut points = chart.points.iter();
            points.all(|[s, _]| stated.q.values[*s] >= 0.0)
        };
        let Some(chart) = chart.filter(is_there) else {
            return Ok(Begun {
                start: stated.clone(),
                stated,
                machine,
                points: &[],
            });
        };
        let mut other = chart.machine.clone();
        for (index, value) in machine.parameter_values().iter().enumerate() {
            if let Some(parameter) = other.parameter_mut(index) {
                *parameter = *value;
            }
        }
        let mut start = other.start();
        start.t = stated.t;
        start.q.values.clone_from(&stated.q.values);
        start.v.values.clone_from(&stated.v.values);
        to_cartesian(&chart.points, &mut start.q.values, &mut start.v.values);
        Ok(Begun {
            machine: other,
            stated,
            start,
            points: &chart.points,
        })
    }

    pub(super) fn run(&self, experiment: usize, x: &[f64]) -> Result<Vec<Row>, Trouble> {
        let Begun {
            machine,
            stated,
            start,
            points,
        } = self.begun(experiment, x)?;
        let measured = &self.experiments[experiment];
        let system = machine.prepare();
        let mut turns = Turns::begin(points, stated.t, &stated.q.values);
        let simulation = measured.signals.drive(Simulation::new(&machine), &machine);
        let simulation = self.keep(self.set(simulation, measured));
        let order = self.running.method.tableau.order;
        let mut rows: Vec<Row> = Vec::with_capacity(measured.times.len());
        let recorded = &mut rows;
        let run = simulation
            .each_step(move |step| {
                if !points.is_empty() {
                    turns.follow(step, 0.0)?;
                }
                while let Some(t) = next_due_time(&measured.times, recorded.len(), step.span()) {
                    let State { q, v, .. } = step.state(t)?;
                    let (q, v) = (q.values, v.values);
                    let (mut shown_q, mut shown_v) = (q.clone(), v.clone());
                    turns.to_polar(t, &mut shown_q, &mut shown_v);
                    let mut a = vec![0.0; q.len()];
                    let mut u = system.default_inputs();
                    if measured.reads_more() {
                        u = step.inputs(t, &q, &v);
                        if let Some(piece) = following(&measured.signals, order, t, step.span()) {
                            measured.signals.set_in(piece, &system, t, &q, &v, &mut u);
                        }
                        step.accelerations((t, &q, &v), &u, &mut a)?;
                    }
                    let value = |column: &Column| match column.quantity {
                        Quantity::Coordinate(i) => shown_q[i],
                        Quantity::Rate(i) => shown_v[i],
                        Quantity::Output(i) => system.output(i, t, &q, &v, &a, &u.values),
                    };
                    recorded.push(Row {
                        values: measured.columns.iter().map(value).collect(),
                        by: Vec::new(),
                    });
                }
                Ok(())
            })
            .run_interpreted(start);
        run.map_err(|error| self.failure(measured, error))?;
        self.whole(measured, rows)
    }

    /// Applies the settings of a run.
    fn set<'s, M: Machine, L: lagrangian::InputLaw<M::System>>(
        &self,
        simulation: Simulation<'s, M, L>,
        experiment: &Experiment,
    ) -> Simulation<'s, M, L> {
        let stop = self.running.stop.clone();
        simulation
            .tolerance(self.running.tolerance)
            .method(self.running.method)
            .until(experiment.times.last().copied().unwrap_or(0.0))
            .max_steps(self.running.most_steps)
            .forget_steps()
            .stop_if(move |_| stop())
    }

    /// Tells a run which numbers of its start to keep.
    fn keep<'s, M: Machine, L: lagrangian::InputLaw<M::System>>(
        &self,
        simulation: Simulation<'s, M, L>,
    ) -> Simulation<'s, M, L> {
        match &self.running.kept {
            None => simulation,
            Some(kept) => {
                let keep = |simulation: Simulation<'s, M, L>, name: &String| simulation.keep(name);
                kept.iter().fold(simulation.keep_none(), keep)
            }
        }
    }

    /// The start of an experiment with the fitted numbers, projected onto the constraints, in the coordinates of its run.
    fn start_on_constraints(&self, experiment: usize, x: &[f64]) -> Result<State<Named>, Trouble> {
        let Begun { machine, start, .. } = self.begun(experiment, x)?;
        let simulation = self.keep(Simulation::new(&machine).until(start.t));
        let run = simulation.run_interpreted(start);
        let run = run.map_err(|error| self.failure(&self.experiments[experiment], error))?;
        Ok(run.start().clone())
    }

    /// The derivative of that start by the fitted numbers, scaled to size 1.
    fn change_on_constraints(
        &self,
        experiment: usize,
        x: &[f64],
        sought: usize,
    ) -> Result<starts::Change, RunFailure> {
        let machine = self.begun(experiment, x)?.machine;
        let size = self.sizes()[sought];
        let parameter = match self.sought[sought].subject {
            Subject::Parameter(index) => Some(index),
            _ => None,
        };
        let at = |by: f64| -> Result<State<Named>, String> {
            let mut there = x.to_vec();
            there[sought] += by;
            let start = self.start_on_constraints(experiment, &there);
            start.map_err(|trouble| match trouble {
                Trouble::NoValue(why) => why,
                Trouble::Stopped => "stopped".to_owned(),
            })
        };
        let width = if x[sought] == 0.0 {
            size
        } else {
            x[sought].abs()
        };
        let change = starts::derivative(&machine, at, width, parameter);
        let change = change.map_err(|why| {
            if (self.running.stop)() {
                RunFailure::Trouble(Trouble::Stopped)
            } else {
                RunFailure::WithoutDerivatives(format!("{}: {why}", self.sought[sought].name))
            }
        })?;
        Ok(change.map(|list| list.into_iter().map(|by| by * size).collect()))
    }

    fn failure(&self, experiment: &Experiment, error: lagrangian::Error) -> Trouble {
        if (self.running.stop)() {
            Trouble::Stopped
        } else {
            Trouble::NoValue(format!("{}: {error}", experiment.name))
        }
    }

    /// The rows of a run, or an error if it did not reach its end.
    fn whole(&self, experiment: &Experiment, rows: Vec<Row>) -> Result<Vec<Row>, Trouble> {
        match (rows.len() == experiment.times.len(), (self.running.stop)()) {
            (true, _) => Ok(rows),
            (_, true) => Err(Trouble::Stopped),
            _ => Err(Trouble::NoValue(format!(
                "{}: the run ends before its last measurement",
                experiment.name
            ))),
        }
    }

    /// The motion with its derivatives, which are exact up to the tolerance; and how far it is off the constraints at its end,
    /// relative to the size of its terms.
    pub(super) fn run_with_derivatives(
        &self,
        experiment: usize,
        x: &[f64],
    ) -> Result<(Vec<Row>, f64), RunFailure> {
        let Begun {
            machine, points, ..
        } = self.begun(experiment, x)?;
        let measured = &self.experiments[experiment];
        let sizes = self.sizes();
        let (affecting, directions) = self.directions(experiment, &machine, &sizes);
        let varied = Varied {
            machine: &machine,
            directions,
            signals: &measured.signals,
            phase: None,
        };
        let of_spec = self.machine(experiment, x)?;
        let mut start = Varied {
            machine: &of_spec,
            ..varied.clone()
        }
        .start();
        let n = machine.program().dimension();
        self.set_varied_start(experiment, x, &machine, &affecting, &mut start)?;
        charts::to_cartesian(points, n, [&mut start.q, &mut start.v]);
        self.set_start_on_constraints(experiment, x, (&machine, &affecting), &mut start)?;
        let derivatives = RowOfDerivatives {
            columns: &measured.columns,
            points,
            n,
            affecting: &affecting,
            sizes: &sizes,
        };
        let (rows, end) = if machine.program().unilateral.is_empty() {
            self.rows_along(&varied, measured, start, &derivatives)?
        } else {
            self.rows_across(&varied, measured, &start, &derivatives)?
        };
        let off_constraints = if self.is_held(experiment) {
            self.off_constraints(experiment, x, &end, &affecting)
        } else {
            0.0
        };
        self.checked(experiment, rows, off_constraints)
    }

    /// The rows of a run whose derivatives are continued across impacts and changes of contacts, and its end.
    fn rows_across(
        &self,
        varied: &Varied<'_>,
        measured: &Experiment,
        start: &State<Vec<f64>>,
        derivatives: &RowOfDerivatives<'_>,
    ) -> Result<(Vec<Row>, State<Vec<f64>>), RunFailure> {
        let wanted = across::Wanted {
            machine: varied.machine,
            signals: &measured.signals,
            directions: varied.directions.clone(),
            method: self.running.method,
            tolerance: self.running.tolerance,
            until: measured.times.last().copied().unwrap_or(0.0),
            most_steps: self.running.most_steps,
        };
        let run = across::run(&wanted, start).map_err(|why| match why {
            NoDerivatives::Run(error) => RunFailure::Trouble(self.failure(measured, error)),
            broken => RunFailure::WithoutDerivatives(broken.to_string()),
        })?;
        let row = |t: &f64| -> Result<Row, lagrangian::Error> {
            let State { q, v, .. } = run.at(*t)?;
            let observed = run.observe(*t, (&q, &v))?;
            let (a, u) = (&observed.a, &observed.inputs);
            Ok(derivatives.row(observed.system, (*t, &q, &v), (a, u)))
        };
        let rows: Result<Vec<Row>, _> = measured.times.iter().map(row).collect();
        let rows = rows.map_err(|error| self.failure(measured, error))?;
        Ok((rows, run.end().clone()))
    }

    /// The rows of a run of the variational equations, and its end.
    fn rows_along(
        &self,
        varied: &Varied<'_>,
        measured: &Experiment,
        start: State<Vec<f64>>,
        derivatives: &RowOfDerivatives<'_>,
    ) -> Result<(Vec<Row>, State<Vec<f64>>), RunFailure> {
        let system = &varied.prepare();
        let simulation = Simulation::new(varied).law(VariedLaw(&measured.signals));
        let simulation = self.set(simulation, measured);
        let order = self.running.method.tableau.order;
        let mut rows: Vec<Row> = Vec::with_capacity(measured.times.len());
        let recorded = &mut rows;
        let simulation = simulation.each_step(move |step| {
            while let Some(t) = next_due_time(&measured.times, recorded.len(), step.span()) {
                let State { q, v, .. } = step.state(t)?;
                let mut a = vec![0.0; q.len()];
                let mut u = system.default_inputs();
                if measured.reads_more() {
                    u = step.inputs(t, &q, &v);
                    if let Some(piece) = following(&measured.signals, order, t, step.span()) {
                        VariedLaw(&measured.signals).set_in(piece, system, t, &q, &v, &mut u);
                    }
                    step.accelerations((t, &q, &v), &u, &mut a)?;
                }
                recorded.push(derivatives.row(system, (t, &q, &v), (&a, &u)));
            }
            Ok(())
        });
        let run = VariedLaw::run(simulation, start);
        let run = run.map_err(|error| self.failure(measured, error))?;
        let end = run.end().clone();
        Ok((rows, end))
    }

    /// The places of the numbers that affect an experiment, and the directions of differentiation by these numbers, scaled by their sizes so
    /// that one tolerance suits all of them.
    fn directions(
        &self,
        experiment: usize,
        machine: &InterpretedMachine,
        sizes: &[f64],
    ) -> (Vec<usize>, Vec<Direction>) {
        // Starts of other experiments do not affect this one.
        let affecting: Vec<usize> = (0..self.sought.len())
            .filter(|j| match self.sought[*j].subject {
                Subject::Parameter(_) => true,
                Subject::Start(of, _) | Subject::Rate(of, _) => of == experiment,
            })
            .collect();
        let directions = affecting.iter().map(|j| {
            let mut direction = Direction::of_start(machine);
            if let Subject::Parameter(index) = self.sought[*j].subject {
                direction.parameters[index] = sizes[*j];
            }
            direction
        });
        let directions = directions.collect();
        (affecting, directions)
    }

    /// Sets a start and its derivatives by the scaled numbers that affect it; `start` holds those that follow from the spec.
    fn set_varied_start(
        &self,
        experiment: usize,
        x: &[f64],
        machine: &InterpretedMachine,
        affecting: &[usize],
        start: &mut State<Vec<f64>>,
    ) -> Result<(), RunFailure> {
        let measured = &self.experiments[experiment];
        let (n, sizes) = (machine.program().dimension(), self.sizes());
        self.set_start(experiment, x, &mut start.q[..n], &mut start.v[..n]);
        for (k, j) in affecting.iter().enumerate() {
            let (sought, size) = (&self.sought[*j], sizes[*j]);
            let part = (k + 1) * n..(k + 2) * n;
            for (numbers, given, level) in [
                (&mut start.q[part.clone()], &measured.start[0], 0),
                (&mut start.v[part.clone()], &measured.start[1], 1),
            ] {
                for (i, number) in numbers.iter_mut().enumerate() {
                    let is_sought = self.sought.iter().any(|other| match other.subject {
                        Subject::Start(of, at) => (of, at, level) == (experiment, i, 0),
                        Subject::Rate(of, at) => (of, at, level) == (experiment, i, 1),
                        Subject::Parameter(_) => false,
                    });
                    if is_sought || given[i].is_some() {
                        *number = 0.0;
                    }
                }
                match sought.subject {
                    Subject::Start(of, at) if of == experiment && level == 0 => numbers[at] = size,
                    Subject::Rate(of, at) if of == experiment && level == 1 => numbers[at] = size,
                    _ => {}
                }
            }
        }
        Ok(())
    }

    /// Projects a start and its derivatives onto the constraints, if there are any, in the coordinates of the run.
    fn set_start_on_constraints(
        &self,
        experiment: usize,
        x: &[f64],
        (machine, affecting): (&InterpretedMachine, &[usize]),
        start: &mut State<Vec<f64>>,
    ) -> Result<(), RunFailure> {
        let n = machine.program().dimension();
        if self.is_held(experiment) {
            let on = self.start_on_constraints(experiment, x)?;
            if let Some(constraint) = starts::dependent_constraint(machine, &on) {
                return Err(RunFailure::WithoutDerivatives(format!(
                    "the constraint `{constraint}` follows from others"
                )));
            }
            for (k, j) in affecting.iter().enumerate() {
                let [q, v] = self.change_on_constraints(experiment, x, *j)?;
                start.q[(k + 1) * n..(k + 2) * n].copy_from_slice(&q);
                start.v[(k + 1) * n..(k + 2) * n].copy_from_slice(&v);
            }
            start.q[..n].copy_from_slice(&on.q.values);
            start.v[..n].copy_from_slice(&on.v.values);
        }
        Ok(())
    }

    /// Accepts rows with derivatives that are off the constraints by this much, if that is near enough.
    fn checked(
        &self,
        experiment: usize,
        rows: Vec<Row>,
        off: f64,
    ) -> Result<(Vec<Row>, f64), RunFailure> {
        // Differences of runs obey the constraints; they are used where they are about as accurate.
        if off.is_nan() || ELSEWHERE * off > self.exact_differences() {
            return Err(RunFailure::WithoutDerivatives(format!(
                "errors of steps move derivatives off the constraints by {off:.1e} of their values"
            )));
        }
        let mut all = rows.iter().flat_map(|row| row.by.iter().flatten());
        if self.experiments[experiment].chart.is_some() && all.any(|by| !by.is_finite()) {
            return Err(RunFailure::WithoutDerivatives(
                "a point is at its centre at a measured time, where polar coordinates have no derivatives".to_owned(),
            ));
        }
        Ok((self.whole(&self.experiments[experiment], rows)?, off))
    }

    /// How far a motion and its derivatives by scaled numbers are off the constraints, relative to the size of their terms.
    fn off_constraints(
        &self,
        experiment: usize,
        x: &[f64],
        end: &State<Vec<f64>>,
        sought: &[usize],
    ) -> f64 {
        let Ok(Begun { machine, .. }) = self.begun(experiment, x) else {
            return f64::NAN;
        };
        let n = machine.program().dimension();
        let mut at = machine.start();
        at.t = end.t;
        at.q.values.copy_from_slice(&end.q[..n]);
        at.v.values.copy_from_slice(&end.v[..n]);
        let sizes = self.sizes();
        let shares = sought.iter().enumerate().map(|(k, j)| {
            let part = (k + 1) * n..(k + 2) * n;
            let parameter = match self.sought[*j].subject {
                Subject::Parameter(index) => Some((index, sizes[*j])),
                _ => None,
            };
            let change = [&end.q[part.clone()], &end.v[part]];
            starts::off_constraints(&machine, &at, change, parameter)
        });
        // `f64::max` would ignore NaN, which must be reported.
        shares.fold(0.0, |most: f64, off| {
            if off.is_nan() || most.is_nan() {
                f64::NAN
            } else {
                most.max(off)
            }
        })
    }
}

impl Experiment {
    /// Whether a measured quantity depends on more than coordinates and rates.
    fn reads_more(&self) -> bool {
        let mut columns = self.columns.iter();
        columns.any(|column| matches!(column.quantity, Quantity::Output(_)))
    }
}

/// The piece of the inputs that follows on a time at the end of a step: inputs that jump at the last measurement have the values after the jump,
/// as at every other one. `None` within a step, and where the inputs are not known.
fn following(signals: &Signals, order: u32, t: f64, [_, to]: [f64; 2]) -> Option<Piece> {
    let piece = |forward| InputLaw::<InterpretedSystem>::piece(signals, t, forward, order).ok();
    // What is not known after the last row of a table is known at this row.
    let following = piece(true).or_else(|| piece(false).map(|_| Piece::ALL));
    following.filter(|_| t == to)
}

/// The next of the times if it is within a step. At the end of a step it is taken only if no step follows: in the next step a change of inputs there
/// has taken effect.
fn next_due_time(times: &[f64], seen: usize, [_, to]: [f64; 2]) -> Option<f64> {
    let t = *times.get(seen)?;
    let is_last = times.last().is_some_and(|last| to >= *last);
    (t < to || (is_last && t <= to)).then_some(t)
}
