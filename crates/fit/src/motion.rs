//! The residuals of a machine's motion against measured ones, and their derivatives.

use std::fmt::Debug;
use std::sync::Arc;

use lagrangian::interpreted::{InterpretedMachine, Named, Signal, Signals};
use lagrangian::methods::Method;
use lagrangian::{Machine, Simulation, State, System};
use lagrangian_linear::across::{self, NoDerivatives};
use lagrangian_linear::starts;
use lagrangian_linear::varied::{Direction, Varied, VariedInputs, VariedLaw, VariedSystem};
use nalgebra::DMatrix;

use crate::combinations::{Combination, combinations};
use crate::least_squares::{Minimum, Options, Problem, Trouble, minimize};
use crate::statistics::{Standing, Statistics};

/// What is fitted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Subject {
    /// The parameter of this number.
    Parameter(usize),
    /// The start of the coordinate of this number, in the experiment of that number.
    Start(usize, usize),
    /// The start of its rate.
    Rate(usize, usize),
}

/// Something that is fitted.
#[derive(Clone, Debug)]
pub struct Sought {
    /// What it is.
    pub subject: Subject,
    /// Its name, for messages.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// Where the search begins.
    pub from: f64,
    /// The least and the greatest value that it may have.
    pub bounds: [f64; 2],
}

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The coordinate of this number.
    Coordinate(usize),
    /// Its rate.
    Rate(usize),
    /// The output of this number.
    Output(usize),
}

/// A quantity in the rows of an experiment.
#[derive(Clone, Debug)]
pub struct Column {
    /// What is measured.
    pub quantity: Quantity,
    /// Which of [`Fit::sigmas`] is its standard deviation.
    pub sigma: usize,
    /// What was measured at each time, where something was.
    pub values: Vec<Option<f64>>,
}

/// One measured motion.
#[derive(Clone, Debug)]
pub struct Experiment {
    /// What messages call it.
    pub name: String,
    /// The machine with the parameters of this experiment.
    pub machine: InterpretedMachine,
    /// The coordinates and the rates that start otherwise than the spec says.
    pub start: [Vec<Option<f64>>; 2],
    /// What drives its inputs.
    pub signals: Signals,
    /// The times, in s: not before the start of the machine, increasing, and the last one later than that.
    pub times: Vec<f64>,
    /// What was measured at these times.
    pub columns: Vec<Column>,
}

/// How derivatives are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Derivatives {
    /// Exact ones are integrated with the motion.
    Integrated,
    /// Differences of whole runs.
    Differences,
}

/// How machines are run.
#[derive(Clone)]
pub struct Running {
    /// The method of integration.
    pub method: &'static Method,
    /// The tolerance of each step.
    pub tolerance: f64,
    /// The most steps of a run.
    pub most_steps: usize,
    /// Which numbers of a start stay where constraints move it; what the spec says where there is none.
    pub kept: Option<Vec<String>>,
    /// Asked between steps whether to stop.
    pub stop: Arc<dyn Fn() -> bool + Send + Sync>,
}

impl Debug for Running {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Running")
            .field("method", &self.method.tableau.name)
            .field("tolerance", &self.tolerance)
            .finish_non_exhaustive()
    }
}

/// Why a machine cannot have parameters, as a sentence; none if it can.
pub type Refusal<'a> = &'a dyn Fn(&[f64]) -> Option<String>;

/// Measured motions, and what is to be fitted to them.
pub struct Fit<'a> {
    /// The motions.
    pub experiments: Vec<Experiment>,
    /// What is fitted.
    pub sought: Vec<Sought>,
    /// Standard deviations of what is measured, by which columns refer to them.
    pub sigmas: Vec<f64>,
    /// How the machines are run.
    pub running: Running,
    /// Which parameters machines cannot have.
    pub refusal: Refusal<'a>,
    /// How often motions were run, and how often with their derivatives.
    pub runs: [usize; 2],
    /// What is known of the derivatives of machines with constraints; nothing at the beginning.
    pub held: Held,
}

/// What is known of the derivatives of motions that constraints hold.
///
/// They are integrated from derivatives of the start that obey the constraints, and nothing is projected on the way, as
/// accelerations keep the second derivatives of constraints 0. So what steps err by grows with time, and is measured at the end.
#[derive(Clone, Debug, Default)]
pub struct Held {
    /// Why they are differences of runs after all.
    pub why: Option<String>,
    /// How far motions or derivatives were off the constraints, at most, as a share of their numbers.
    pub off: f64,
}

/// Why there are no integrated derivatives.
enum Lost {
    /// There is no motion, or somebody asked to stop.
    Trouble(Trouble),
    /// There is a motion, and its derivatives have to be found by differences; why.
    Held(String),
}

impl From<Trouble> for Lost {
    fn from(trouble: Trouble) -> Lost {
        Lost::Trouble(trouble)
    }
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Found {
    /// The end of the search.
    pub minimum: Minimum,
    /// What it says.
    pub statistics: Statistics,
    /// What can be told of the numbers that cannot be told apart.
    pub combinations: Vec<Combination>,
    /// How derivatives were found.
    pub derivatives: Derivatives,
    /// How exact these are, as a share of each column.
    pub exact: f64,
}

/// Integrated derivatives are as exact as this many tolerances, and differences as this many roots of the tolerance's square.
const SHARE: f64 = 100.0;

/// Derivatives on the way of a search may be this many times as far off constraints as those that were looked at.
const ELSEWHERE: f64 = 10.0;

/// Derivatives of one kind are no more exact than that.
const MOST_EXACT: f64 = 1e-11;

/// Numbers far along a direction that changes nothing give the same residuals up to this share of the motion, beside tolerances.
const SAME: f64 = 1e-6;

/// What one row of a run has: the values of all columns, and their derivatives in all directions where these are run.
struct Row {
    values: Vec<f64>,
    by: Vec<Vec<f64>>,
}

impl Fit<'_> {
    /// How derivatives of these machines are found, and why not as exact ones where they are differences.
    pub fn derivatives(&self) -> (Derivatives, Option<String>) {
        let why = self.experiments.iter().find_map(|experiment| {
            let program = experiment.machine.program();
            if experiment.signals.is_sampled() {
                return Some("an input is sampled");
            }
            let mut driven = experiment.signals.driven();
            if driven.any(|(_, signal)| matches!(signal, Signal::Function(_))) {
                return Some("an input is a function that says nothing of its derivatives");
            }
            (!program.contacts.is_empty()).then_some("the machine has sliding friction")
        });
        match why.map(str::to_owned).or_else(|| self.held.why.clone()) {
            None => (Derivatives::Integrated, None),
            Some(why) => (Derivatives::Differences, Some(why)),
        }
    }

    /// How exact derivatives are, as a share of each.
    fn exact(&self) -> f64 {
        let exact = match self.derivatives().0 {
            Derivatives::Integrated => {
                (SHARE * self.running.tolerance).max(ELSEWHERE * self.held.off)
            }
            Derivatives::Differences => self.exact_differences(),
        };
        exact.max(MOST_EXACT)
    }

    /// How exact differences of runs are: an error of the third order against one of the tolerance over the distance.
    fn exact_differences(&self) -> f64 {
        SHARE * self.running.tolerance.powf(2.0 / 3.0)
    }

    /// Whether constraints hold the machine of an experiment.
    fn is_held(&self, experiment: usize) -> bool {
        let system = self.experiments[experiment].machine.prepare();
        system.constraints().len() > 0
    }

    /// Numbers of the size of each that is fitted: what it starts from, or what its bounds allow where that is 0.
    pub fn sizes(&self) -> Vec<f64> {
        let size = |sought: &Sought| {
            let finite = sought.bounds.iter().filter(|bound| bound.is_finite());
            let most = finite.fold(0.0, |most: f64, bound| most.max(bound.abs()));
            match (sought.from != 0.0, most > 0.0) {
                (true, _) => sought.from.abs(),
                (_, true) => most,
                _ => 1.0,
            }
        };
        self.sought.iter().map(size).collect()
    }

    fn bounds(&self) -> Vec<[f64; 2]> {
        self.sought.iter().map(|sought| sought.bounds).collect()
    }

    /// Looks for the minimum from the numbers where the search begins.
    ///
    /// # Errors
    /// If there is no motion there, or no derivatives of one on the way.
    pub fn search(&mut self, from: &[f64]) -> Result<Minimum, Trouble> {
        let is_held = (0..self.experiments.len()).any(|experiment| self.is_held(experiment));
        if is_held && self.derivatives().0 == Derivatives::Integrated {
            // How exact derivatives are is to be known before they are relied on. What is wrong here is said where the search begins.
            if let Err(Trouble::Stopped) = self.jacobian(from) {
                return Err(Trouble::Stopped);
            }
        }
        let options = Options {
            derivatives: self.exact(),
            ..Options::default()
        };
        let bounds = self.bounds();
        minimize(self, from, &bounds, &options)
    }

    /// What a minimum says. `is_scaled`: standard deviations are known up to a factor only.
    ///
    /// # Errors
    /// If somebody asked to stop.
    pub fn found(&mut self, minimum: Minimum, is_scaled: bool) -> Result<Found, Trouble> {
        let exact = self.exact();
        let sizes: Vec<f64> = self
            .sizes()
            .iter()
            .zip(&minimum.x)
            .map(|(size, x)| if *x == 0.0 { *size } else { x.abs() })
            .collect();
        let statistics = Statistics::of(&minimum, &self.bounds(), &sizes, exact, is_scaled);
        let mut is_stopped = false;
        let entangled = statistics.standing.contains(&Standing::Entangled);
        let combinations = if entangled {
            let most = (SAME + exact) * self.size(&minimum.residuals);
            let mut is_same = |from: &[f64], to: &[f64]| {
                let pair = [self.residuals(from), self.residuals(to)];
                is_stopped |= pair.contains(&Err(Trouble::Stopped));
                let [Ok(from), Ok(to)] = pair else {
                    return false;
                };
                let pairs = from.iter().zip(&to);
                pairs.map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt() <= most
            };
            combinations(&minimum.x, &sizes, &statistics.null, exact, &mut is_same)
        } else {
            Vec::new()
        };
        if is_stopped {
            Err(Trouble::Stopped)
        } else {
            Ok(Found {
                minimum,
                statistics,
                combinations,
                derivatives: self.derivatives().0,
                exact,
            })
        }
    }

    /// The machine of an experiment with what is fitted.
    fn machine(&self, experiment: usize, x: &[f64]) -> Result<InterpretedMachine, Trouble> {
        let mut machine = self.experiments[experiment].machine.clone();
        for (sought, x) in self.sought.iter().zip(x) {
            if let Subject::Parameter(index) = sought.subject
                && let Some(parameter) = machine.parameter_mut(index)
            {
                *parameter = *x;
            }
        }
        match (self.refusal)(machine.parameter_values()) {
            None => Ok(machine),
            Some(why) => Err(Trouble::NoValue(why)),
        }
    }

    /// Puts into a start what the experiment says of it, and what is fitted.
    fn put_start(&self, experiment: usize, x: &[f64], q: &mut [f64], v: &mut [f64]) {
        let given = &self.experiments[experiment].start;
        for (numbers, given) in [(&mut *q, &given[0]), (&mut *v, &given[1])] {
            for (number, given) in numbers.iter_mut().zip(given) {
                *number = given.unwrap_or(*number);
            }
        }
        for (sought, x) in self.sought.iter().zip(x) {
            match sought.subject {
                Subject::Start(of, coordinate) if of == experiment => q[coordinate] = *x,
                Subject::Rate(of, coordinate) if of == experiment => v[coordinate] = *x,
                _ => {}
            }
        }
    }

    /// Where an experiment starts with what is fitted, as it is before constraints move it.
    ///
    /// # Errors
    /// If there is no machine with these numbers.
    pub fn start(&self, experiment: usize, x: &[f64]) -> Result<State<Named>, Trouble> {
        let mut start = self.machine(experiment, x)?.start();
        self.put_start(experiment, x, &mut start.q.values, &mut start.v.values);
        Ok(start)
    }

    /// What the machine of an experiment does at the measured times: for each time the values of all columns.
    ///
    /// # Errors
    /// If there is no such motion.
    pub fn computed(&mut self, experiment: usize, x: &[f64]) -> Result<Vec<Vec<f64>>, Trouble> {
        self.runs[0] += 1;
        let rows = self.run(experiment, x)?;
        Ok(rows.into_iter().map(|row| row.values).collect())
    }

    fn run(&self, experiment: usize, x: &[f64]) -> Result<Vec<Row>, Trouble> {
        let machine = self.machine(experiment, x)?;
        let start = self.start(experiment, x)?;
        let own = &self.experiments[experiment];
        let system = machine.prepare();
        let simulation = own.signals.drive(Simulation::new(&machine), &machine);
        let simulation = self.keep(self.set(simulation, own));
        let mut rows: Vec<Row> = Vec::with_capacity(own.times.len());
        let seen = &mut rows;
        let run = simulation
            .each_step(move |step| {
                while let Some(t) = due(&own.times, seen.len(), step.span()) {
                    let State { q, v, .. } = step.state(t)?;
                    let (q, v) = (q.values, v.values);
                    let mut a = vec![0.0; q.len()];
                    let mut u = system.default_inputs();
                    if own.reads_more() {
                        u = step.inputs(t, &q, &v);
                        step.accelerations((t, &q, &v), &u, &mut a)?;
                    }
                    let value = |column: &Column| match column.quantity {
                        Quantity::Coordinate(i) => q[i],
                        Quantity::Rate(i) => v[i],
                        Quantity::Output(i) => system.output(i, t, &q, &v, &a, &u.values),
                    };
                    seen.push(Row {
                        values: own.columns.iter().map(value).collect(),
                        by: Vec::new(),
                    });
                }
                Ok(())
            })
            .run_interpreted(start);
        run.map_err(|error| self.trouble(own, error))?;
        self.whole(own, rows)
    }

    /// The settings of a run.
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

    /// A run that keeps of its start what is to be kept.
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

    /// Where an experiment starts with what is fitted, on the constraints.
    fn start_on_constraints(&self, experiment: usize, x: &[f64]) -> Result<State<Named>, Trouble> {
        let machine = self.machine(experiment, x)?;
        let start = self.start(experiment, x)?;
        let simulation = self.keep(Simulation::new(&machine).until(start.t));
        let run = simulation.run_interpreted(start);
        let run = run.map_err(|error| self.trouble(&self.experiments[experiment], error))?;
        Ok(run.start().clone())
    }

    /// How that start changes with what is fitted, by numbers of size 1.
    fn change_on_constraints(
        &self,
        experiment: usize,
        x: &[f64],
        sought: usize,
    ) -> Result<starts::Change, Lost> {
        let machine = self.machine(experiment, x)?;
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
                Lost::Trouble(Trouble::Stopped)
            } else {
                Lost::Held(format!("{}: {why}", self.sought[sought].name))
            }
        })?;
        Ok(change.map(|list| list.into_iter().map(|by| by * size).collect()))
    }

    fn trouble(&self, experiment: &Experiment, error: lagrangian::Error) -> Trouble {
        if (self.running.stop)() {
            Trouble::Stopped
        } else {
            Trouble::NoValue(format!("{}: {error}", experiment.name))
        }
    }

    /// The rows of a run that came to its end.
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

    /// The motion with its derivatives, which are exact but for the tolerance; and how far it is off constraints at its end, as a
    /// share of its numbers.
    fn run_with_derivatives(&self, experiment: usize, x: &[f64]) -> Result<(Vec<Row>, f64), Lost> {
        let machine = self.machine(experiment, x)?;
        let own = &self.experiments[experiment];
        let sizes = self.sizes();
        // Starts of other experiments do not matter here.
        let here: Vec<usize> = (0..self.sought.len())
            .filter(|j| match self.sought[*j].subject {
                Subject::Parameter(_) => true,
                Subject::Start(of, _) | Subject::Rate(of, _) => of == experiment,
            })
            .collect();
        // Derivatives by numbers of size 1, so that one tolerance is as good for all of them.
        let directions = here.iter().map(|j| {
            let mut direction = Direction::of_start(&machine);
            if let Subject::Parameter(index) = self.sought[*j].subject {
                direction.parameters[index] = sizes[*j];
            }
            direction
        });
        let varied = Varied {
            machine: &machine,
            directions: directions.collect(),
            signals: &own.signals,
            phase: None,
        };
        let mut start = varied.start();
        let n = machine.program().dimension();
        self.put_start(experiment, x, &mut start.q[..n], &mut start.v[..n]);
        for (k, j) in here.iter().enumerate() {
            let (sought, size) = (&self.sought[*j], sizes[*j]);
            let part = (k + 1) * n..(k + 2) * n;
            for (numbers, given, level) in [
                (&mut start.q[part.clone()], &own.start[0], 0),
                (&mut start.v[part.clone()], &own.start[1], 1),
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
        let is_held = self.is_held(experiment);
        if is_held {
            let on = self.start_on_constraints(experiment, x)?;
            if let Some(constraint) = starts::dependent_constraint(&machine, &on) {
                return Err(Lost::Held(format!(
                    "the constraint `{constraint}` follows from others"
                )));
            }
            for (k, j) in here.iter().enumerate() {
                let [q, v] = self.change_on_constraints(experiment, x, *j)?;
                start.q[(k + 1) * n..(k + 2) * n].copy_from_slice(&q);
                start.v[(k + 1) * n..(k + 2) * n].copy_from_slice(&v);
            }
            start.q[..n].copy_from_slice(&on.q.values);
            start.v[..n].copy_from_slice(&on.v.values);
        }
        let at = |system: &VariedSystem,
                  (t, q, v): (f64, &Vec<f64>, &Vec<f64>),
                  (a, u): (&Vec<f64>, &VariedInputs)| {
            let by = |column: &Column| -> Vec<f64> {
                let scaled: Vec<f64> = match column.quantity {
                    Quantity::Coordinate(i) => (1..=here.len()).map(|k| q[k * n + i]).collect(),
                    Quantity::Rate(i) => (1..=here.len()).map(|k| v[k * n + i]).collect(),
                    Quantity::Output(i) => system.output(i, t, [q, v, a], u),
                };
                let mut all = vec![0.0; sizes.len()];
                for (j, by) in here.iter().zip(scaled) {
                    all[*j] = by / sizes[*j];
                }
                all
            };
            Row {
                values: Vec::new(),
                by: own.columns.iter().map(by).collect(),
            }
        };
        if !machine.program().unilateral.is_empty() {
            let wanted = across::Wanted {
                machine: &machine,
                signals: &own.signals,
                directions: varied.directions.clone(),
                method: self.running.method,
                tolerance: self.running.tolerance,
                until: own.times.last().copied().unwrap_or(0.0),
                most_steps: self.running.most_steps,
            };
            let run = across::run(&wanted, &start).map_err(|why| match why {
                NoDerivatives::Run(error) => Lost::Trouble(self.trouble(own, error)),
                broken => Lost::Held(broken.to_string()),
            })?;
            let row = |t: &f64| -> Result<Row, lagrangian::Error> {
                let State { q, v, .. } = run.at(*t)?;
                let observed = run.observe(*t, (&q, &v))?;
                Ok(at(
                    observed.system,
                    (*t, &q, &v),
                    (&observed.a, &observed.inputs),
                ))
            };
            let rows: Result<Vec<Row>, _> = own.times.iter().map(row).collect();
            let rows = rows.map_err(|error| self.trouble(own, error))?;
            let off = if is_held {
                self.off_constraints(experiment, x, run.end(), &here)
            } else {
                0.0
            };
            return self.checked(experiment, rows, off);
        }
        let system = varied.prepare();
        let simulation = Simulation::new(&varied).law(VariedLaw(&own.signals));
        let simulation = self.set(simulation, own);
        let mut rows: Vec<Row> = Vec::with_capacity(own.times.len());
        let seen = &mut rows;
        let (system, at) = (&system, &at);
        let simulation = simulation.each_step(move |step| {
            while let Some(t) = due(&own.times, seen.len(), step.span()) {
                let State { q, v, .. } = step.state(t)?;
                let mut a = vec![0.0; q.len()];
                let mut u = system.default_inputs();
                if own.reads_more() {
                    u = step.inputs(t, &q, &v);
                    step.accelerations((t, &q, &v), &u, &mut a)?;
                }
                seen.push(at(system, (t, &q, &v), (&a, &u)));
            }
            Ok(())
        });
        let run = VariedLaw::run(simulation, start);
        let run = run.map_err(|error| self.trouble(own, error))?;
        let off = if is_held {
            self.off_constraints(experiment, x, run.end(), &here)
        } else {
            0.0
        };
        self.checked(experiment, rows, off)
    }

    /// Rows with derivatives that are so far off constraints, if that is near enough.
    fn checked(
        &self,
        experiment: usize,
        rows: Vec<Row>,
        off: f64,
    ) -> Result<(Vec<Row>, f64), Lost> {
        // Where differences of runs, which are held on the constraints, are as exact, they are taken.
        if off.is_nan() || ELSEWHERE * off > self.exact_differences() {
            return Err(Lost::Held(format!(
                "errors of steps move derivatives by {off:.1e} of their numbers off the constraints"
            )));
        }
        Ok((self.whole(&self.experiments[experiment], rows)?, off))
    }

    /// How far a motion and its derivatives by numbers of size 1 are off the constraints, as a share of their numbers.
    fn off_constraints(
        &self,
        experiment: usize,
        x: &[f64],
        end: &State<Vec<f64>>,
        sought: &[usize],
    ) -> f64 {
        let Ok(machine) = self.machine(experiment, x) else {
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
        // A number that is none is none of the greatest, and is to be seen.
        shares.fold(0.0, |most: f64, off| match off.is_nan() {
            true => off,
            false if most.is_nan() => most,
            false => most.max(off),
        })
    }

    /// The derivatives of all residuals by central differences of runs.
    fn differences(&mut self, x: &[f64]) -> Result<DMatrix<f64>, Trouble> {
        let sizes = self.sizes();
        let share = self.running.tolerance.cbrt();
        let mut columns = Vec::new();
        for (j, own) in x.iter().copied().enumerate() {
            let step = share * own.abs().max(1e-3 * sizes[j]);
            let [low, high] = self.sought[j].bounds;
            let ends = [(own - step).max(low), (own + step).min(high)];
            let mut tried = Vec::new();
            for end in ends {
                let mut to = x.to_vec();
                to[j] = end;
                tried.push(self.residuals(&to));
            }
            let here = |this: &mut Self| this.residuals(x).map(|residuals| (own, residuals));
            let mut sides = Vec::new();
            for (end, tried) in ends.into_iter().zip(tried) {
                // Where there is no machine on one side the derivative is that of the other.
                match tried {
                    Ok(residuals) => sides.push((end, residuals)),
                    Err(Trouble::NoValue(_)) => sides.push(here(self)?),
                    Err(Trouble::Stopped) => return Err(Trouble::Stopped),
                }
            }
            let [(from, before), (to, after)] = &sides[..] else {
                continue;
            };
            let length = to - from;
            let column: Vec<f64> = if length > 0.0 {
                let pairs = after.iter().zip(before);
                pairs
                    .map(|(after, before)| (after - before) / length)
                    .collect()
            } else {
                vec![0.0; before.len()]
            };
            columns.push(nalgebra::DVector::from_vec(column));
        }
        Ok(DMatrix::from_columns(&columns))
    }

    /// Each measurement: its experiment, column and row, its value and its standard deviation.
    fn measurements(&self) -> impl Iterator<Item = (usize, usize, usize, f64, f64)> + '_ {
        let experiments = self.experiments.iter().enumerate();
        experiments.flat_map(move |(e, experiment)| {
            let columns = experiment.columns.iter().enumerate();
            columns.flat_map(move |(c, column)| {
                let sigma = self.sigmas[column.sigma];
                let rows = column.values.iter().enumerate();
                rows.filter_map(move |(r, value)| value.map(|value| (e, c, r, value, sigma)))
            })
        })
    }

    /// Standard deviations by the residuals of a minimum: of each class of columns the root of its mean square, where the
    /// numbers that were fitted take away from each class the share of their degrees of freedom that its derivatives have
    /// in all (the trace of its part of the projection).
    pub fn estimated_sigmas(&self, minimum: &Minimum) -> Vec<f64> {
        let mut sums = vec![0.0; self.sigmas.len()];
        let mut counts = vec![0.0; self.sigmas.len()];
        let class = |e: usize, c: usize| self.experiments[e].columns[c].sigma;
        let svd = minimum.jacobian.clone().svd(true, false);
        let leverage = |i: usize| {
            let kept = svd.singular_values.iter().enumerate();
            let kept = kept.filter(|(_, value)| **value > 1e-8 * svd.singular_values.max());
            svd.u.as_ref().map_or(0.0, |u| {
                kept.map(|(k, _)| u[(i, k)] * u[(i, k)]).sum::<f64>()
            })
        };
        for (i, (e, c, _, _, sigma)) in self.measurements().enumerate() {
            let residual = minimum.residuals[i] * sigma;
            sums[class(e, c)] += residual * residual;
            counts[class(e, c)] += 1.0 - leverage(i);
        }
        let pairs = sums.iter().zip(&counts).zip(&self.sigmas);
        pairs
            .map(|((sum, count), sigma)| {
                if *count > 0.5 && *sum > 0.0 {
                    (sum / count).sqrt()
                } else {
                    *sigma
                }
            })
            .collect()
    }
}

impl Experiment {
    /// Whether what is measured depends on more than coordinates and rates.
    fn reads_more(&self) -> bool {
        let mut columns = self.columns.iter();
        columns.any(|column| matches!(column.quantity, Quantity::Output(_)))
    }
}

/// The next of the times, if it is in a step: at its end only where nothing follows, as what changes there has changed.
fn due(times: &[f64], seen: usize, [_, to]: [f64; 2]) -> Option<f64> {
    let t = *times.get(seen)?;
    let is_last = times.last().is_some_and(|last| to >= *last);
    (t < to || (is_last && t <= to)).then_some(t)
}

impl Problem for Fit<'_> {
    fn residuals(&mut self, x: &[f64]) -> Result<Vec<f64>, Trouble> {
        let mut computed = Vec::new();
        for experiment in 0..self.experiments.len() {
            computed.push(self.computed(experiment, x)?);
        }
        let all = self.measurements();
        Ok(all
            .map(|(e, c, r, value, sigma)| (computed[e][r][c] - value) / sigma)
            .collect())
    }

    fn jacobian(&mut self, x: &[f64]) -> Result<DMatrix<f64>, Trouble> {
        if self.derivatives().0 == Derivatives::Differences {
            return self.differences(x);
        }
        let mut rows = Vec::new();
        for experiment in 0..self.experiments.len() {
            self.runs[1] += 1;
            match self.run_with_derivatives(experiment, x) {
                Ok((own, off)) => {
                    self.held.off = self.held.off.max(off);
                    rows.push(own);
                }
                Err(Lost::Trouble(trouble)) => return Err(trouble),
                Err(Lost::Held(why)) => {
                    self.held.why = Some(why);
                    return self.differences(x);
                }
            }
        }
        let all: Vec<_> = self.measurements().collect();
        Ok(DMatrix::from_fn(all.len(), x.len(), |i, j| {
            let (e, c, r, _, sigma) = all[i];
            rows[e][r].by[c][j] / sigma
        }))
    }

    fn size(&self, residuals: &[f64]) -> f64 {
        // Of what was measured, by the numbers that residuals are differences of.
        let measured = self.measurements();
        let measured: f64 = measured
            .map(|(.., value, sigma)| (value / sigma).powi(2))
            .sum();
        let own: f64 = residuals.iter().map(|r| r * r).sum();
        measured.sqrt().max(own.sqrt())
    }
}
