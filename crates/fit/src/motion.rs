//! The residuals of a machine's motion against measured ones, and their derivatives.

mod running;

use std::fmt::Debug;
use std::sync::Arc;

use lagrangian::interpreted::{InterpretedMachine, Named, Signal, Signals};
use lagrangian::methods::Method;
use lagrangian::{Machine, State, System};
use nalgebra::DMatrix;

use crate::combinations::{Combination, combinations};
use crate::least_squares::{Minimum, Options, Problem, Trouble, minimize};
use crate::statistics::{Standing, Statistics};
use running::RunFailure;

/// A quantity that can be fitted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Subject {
    /// The parameter with this index.
    Parameter(usize),
    /// The start of a coordinate: the index of the coordinate, then that of the experiment.
    Start(usize, usize),
    /// The start of a rate: the index of the coordinate, then that of the experiment.
    Rate(usize, usize),
}

/// A fitted number.
#[derive(Clone, Debug)]
pub struct Sought {
    /// Which quantity it is.
    pub subject: Subject,
    /// Its name, for messages.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// The initial guess.
    pub from: f64,
    /// The least and the greatest value allowed.
    pub bounds: [f64; 2],
}

/// A quantity that can be measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The coordinate with this index.
    Coordinate(usize),
    /// Its rate.
    Rate(usize),
    /// The output with this index.
    Output(usize),
}

/// The measurements of one quantity in an experiment.
#[derive(Clone, Debug)]
pub struct Column {
    /// The measured quantity.
    pub quantity: Quantity,
    /// The index of its standard deviation in [`Fit::sigmas`].
    pub sigma: usize,
    /// The measured value at each time, if there is one.
    pub values: Vec<Option<f64>>,
}

/// A machine in the Cartesian coordinates that its spec names for polar ones.
#[derive(Clone, Debug)]
pub struct Chart {
    /// The machine, with the inputs of the experiment.
    pub machine: InterpretedMachine,
    /// For each point the indices of its distance and its angle.
    pub points: Vec<[usize; 2]>,
}

/// One measured motion.
#[derive(Clone, Debug)]
pub struct Experiment {
    /// Its name in messages.
    pub name: String,
    /// The machine, with the parameters of this experiment.
    pub machine: InterpretedMachine,
    /// The starts of coordinates and of rates that differ from those of the spec.
    pub start: [Vec<Option<f64>>; 2],
    /// The same machine in Cartesian coordinates, in which its runs are made, if the spec names any.
    pub chart: Option<Chart>,
    /// The signals that drive its inputs.
    pub signals: Signals,
    /// The times, in s: increasing, the first not before the start of the machine, and the last one after it.
    pub times: Vec<f64>,
    /// The measurements at these times.
    pub columns: Vec<Column>,
}

/// How derivatives are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Derivatives {
    /// Exact derivatives, integrated together with the motion.
    Integrated,
    /// Differences between whole runs.
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
    /// Which numbers of a start the projection onto the constraints keeps; those that the spec keeps where this is `None`.
    pub kept: Option<Vec<String>>,
    /// Polled between steps: whether to stop.
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

/// Why a machine cannot have these parameters, as a sentence; `None` if it can.
pub type Refusal<'a> = &'a dyn Fn(&[f64]) -> Option<String>;

/// Measured motions, and the numbers to be fitted to them.
pub struct Fit<'a> {
    /// The measured motions.
    pub experiments: Vec<Experiment>,
    /// The numbers to be fitted.
    pub sought: Vec<Sought>,
    /// Standard deviations of the measurements; columns refer to them by index.
    pub sigmas: Vec<f64>,
    /// How the machines are run.
    pub running: Running,
    /// Checks which parameters machines cannot have.
    pub refusal: Refusal<'a>,
    /// The number of runs without and with derivatives.
    pub runs: [usize; 2],
    /// Findings about the derivatives of machines with constraints; empty at first.
    pub held: ConstraintFindings,
}

/// Findings about the derivatives of constrained motions.
///
/// Their integration starts from derivatives that obey the constraints. Nothing is projected on the way, because the
/// accelerations keep the second derivatives of the constraints 0. So integration errors let them drift, and the drift is
/// measured at the end.
#[derive(Clone, Debug, Default)]
pub struct ConstraintFindings {
    /// Why differences of runs are used instead, if they are.
    pub why: Option<String>,
    /// The largest drift off the constraints of motions or derivatives, relative to the size of their terms.
    pub off: f64,
}

/// The result of a fit.
#[derive(Clone, Debug)]
pub struct FitResult {
    /// The end of the search.
    pub minimum: Minimum,
    /// The statistics there.
    pub statistics: Statistics,
    /// Combinations that can be estimated of numbers that cannot.
    pub combinations: Vec<Combination>,
    /// How derivatives were computed.
    pub derivatives: Derivatives,
    /// The relative error of the derivatives, per column.
    pub exact: f64,
}

/// The relative error of integrated derivatives is this times the tolerance; that of differences is this times tolerance^(2/3).
const SHARE: f64 = 100.0;

/// During a search, derivatives may be this many times as far off the constraints as at the states that were measured.
const ELSEWHERE: f64 = 10.0;

/// The smallest relative error assumed for derivatives of either kind.
const MOST_EXACT: f64 = 1e-11;

/// The distance of runs whose differences are compared with integrated derivatives, relative to the sizes of the fitted numbers.
const DISTANCE: f64 = 1e-4;

/// Differences of runs differ from integrated derivatives if they do by this fraction of the greatest of them.
const SIGNIFICANT: f64 = 1e-3;

/// Points far along a null direction have the same residuals if these agree to this fraction of the motion, plus tolerances.
const SAME: f64 = 1e-6;

impl Fit<'_> {
    /// How derivatives of these machines are computed, and why they are differences if they are.
    pub fn derivatives(&self) -> (Derivatives, Option<String>) {
        let why = self.experiments.iter().find_map(|experiment| {
            let program = experiment.machine.program();
            if experiment.signals.is_sampled() {
                return Some("an input is sampled");
            }
            let mut driven = experiment.signals.driven();
            if driven.any(|(_, signal)| matches!(signal, Signal::Function(_))) {
                return Some("an input is a function that does not give its derivatives");
            }
            (!program.contacts.is_empty()).then_some("the machine has sliding friction")
        });
        match why.map(str::to_owned).or_else(|| self.held.why.clone()) {
            None => (Derivatives::Integrated, None),
            Some(why) => (Derivatives::Differences, Some(why)),
        }
    }

    /// The relative error of the derivatives.
    fn exact(&self) -> f64 {
        let exact = match self.derivatives().0 {
            Derivatives::Integrated => {
                (SHARE * self.running.tolerance).max(ELSEWHERE * self.held.off)
            }
            Derivatives::Differences => self.exact_differences(),
        };
        exact.max(MOST_EXACT)
    }

    /// The relative error of differences of runs, at the distance that balances the truncation error, with the third
    /// derivative, against the tolerance divided by the distance.
    fn exact_differences(&self) -> f64 {
        SHARE * self.running.tolerance.powf(2.0 / 3.0)
    }

    /// Whether the machine of an experiment has constraints.
    fn is_held(&self, experiment: usize) -> bool {
        let system = self.experiments[experiment].machine.prepare();
        system.constraints().len() > 0
    }

    /// The scale of each fitted number: its initial guess or, where that is 0, what its bounds allow.
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

    /// Searches for the minimum from these numbers.
    ///
    /// # Errors
    /// If there is no motion there, or no derivatives on the way.
    pub fn search(&mut self, from: &[f64]) -> Result<Minimum, Trouble> {
        let is_held = (0..self.experiments.len()).any(|experiment| self.is_held(experiment));
        if is_held && self.derivatives().0 == Derivatives::Integrated {
            // The error of the derivatives must be known before the search relies on them. Other failures are
            // reported where the search starts.
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

    /// The statistics of a minimum. If `is_scaled`, standard deviations are known only up to a common factor.
    ///
    /// # Errors
    /// If the search was interrupted.
    pub fn result(&mut self, minimum: Minimum, is_scaled: bool) -> Result<FitResult, Trouble> {
        let exact = self.exact();
        let sizes: Vec<f64> = self
            .sizes()
            .iter()
            .zip(&minimum.x)
            .map(|(size, x)| if *x == 0.0 { *size } else { x.abs() })
            .collect();
        // Whether the residuals depend on a number is asked of changes of the size with which the search began, even if its value is
        // nearly 0.
        let scales = self.sizes().into_iter().zip(&minimum.x);
        let changes: Vec<f64> = scales.map(|(size, x)| size.max(x.abs())).collect();
        let in_a_class = self.effective_in_a_class(&minimum, &changes, exact);
        let statistics = Statistics::of(
            &minimum,
            &self.bounds(),
            &changes,
            (exact, is_scaled),
            |j| in_a_class[j],
        );
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
            Ok(FitResult {
                minimum,
                statistics,
                combinations,
                derivatives: self.derivatives().0,
                exact,
            })
        }
    }

    /// The machine of an experiment with the fitted numbers set.
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

    /// Sets in a start the values of the experiment and the fitted numbers.
    fn set_start(&self, experiment: usize, x: &[f64], q: &mut [f64], v: &mut [f64]) {
        let start = &self.experiments[experiment].start;
        for (numbers, given) in [(&mut *q, &start[0]), (&mut *v, &start[1])] {
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

    /// The start of an experiment with the fitted numbers, before the projection onto the constraints.
    ///
    /// # Errors
    /// If no machine exists with these numbers.
    pub fn start(&self, experiment: usize, x: &[f64]) -> Result<State<Named>, Trouble> {
        let mut start = self.machine(experiment, x)?.start();
        self.set_start(experiment, x, &mut start.q.values, &mut start.v.values);
        Ok(start)
    }

    /// The motion of an experiment at the measured times: for each time the values of all columns.
    ///
    /// # Errors
    /// If there is no such motion.
    pub fn computed(&mut self, experiment: usize, x: &[f64]) -> Result<Vec<Vec<f64>>, Trouble> {
        self.runs[0] += 1;
        let rows = self.run(experiment, x)?;
        Ok(rows.into_iter().map(|row| row.values).collect())
    }

    /// Whether residuals differ as integrated derivatives predict, along a generic direction. Variational equations do not hold where a force jumps, so
    /// this is examined for machines with a sign in their equations.
    fn are_differences(&mut self, x: &[f64], integrated: &DMatrix<f64>) -> Result<bool, Trouble> {
        let may_jump = |experiment: &Experiment| experiment.machine.program().may_jump();
        if !self.experiments.iter().any(may_jump) {
            return Ok(true);
        }
        let sizes = self.sizes();
        let share = |j: usize| ((3 + 7 * j) * 29 % 97) as f64 / 97.0 - 0.4;
        let direction: Vec<f64> = (0..x.len()).map(|j| share(j) * sizes[j]).collect();
        let mut differences = Vec::new();
        for h in [2.0 * DISTANCE, DISTANCE] {
            let mut ends = Vec::new();
            for h in [h, -h] {
                let moved = x.iter().zip(&direction).map(|(x, by)| x + h * by);
                let moved: Vec<f64> = moved.collect();
                match self.residuals(&moved) {
                    Ok(residuals) => ends.push(residuals),
                    // There is nothing to compare with.
                    Err(Trouble::NoValue(_)) => return Ok(true),
                    Err(Trouble::Stopped) => return Err(Trouble::Stopped),
                }
            }
            let pairs = ends[0].iter().zip(&ends[1]);
            let quotients = pairs.map(|(after, before)| (after - before) / (2.0 * h));
            differences.push(quotients.collect::<Vec<f64>>());
        }
        let predicted = integrated * nalgebra::DVector::from_vec(direction);
        let (coarse, fine) = (&differences[0], &differences[1]);
        let greatest = fine
            .iter()
            .fold(predicted.amax(), |most, x| most.max(x.abs()));
        let rounding = 10.0 * self.running.tolerance * self.size(&[]) / DISTANCE;
        // The error of the finer difference is a third of the difference between the two.
        let agrees = |i: usize| {
            let known = (4.0 * (coarse[i] - fine[i]).abs()).max(rounding);
            (predicted[i] - fine[i]).abs() <= known.max(SIGNIFICANT * greatest)
        };
        Ok((0..fine.len()).all(agrees))
    }

    /// The derivatives of all residuals, by central differences of runs.
    fn differences(&mut self, x: &[f64]) -> Result<DMatrix<f64>, Trouble> {
        let sizes = self.sizes();
        let share = self.running.tolerance.cbrt();
        let mut columns = Vec::new();
        for (j, value) in x.iter().copied().enumerate() {
            let step = share * value.abs().max(1e-3 * sizes[j]);
            let [low, high] = self.sought[j].bounds;
            let ends = [(value - step).max(low), (value + step).min(high)];
            let mut tried = Vec::new();
            for end in ends {
                let mut to = x.to_vec();
                to[j] = end;
                tried.push(self.residuals(&to));
            }
            let unchanged = |this: &mut Self| this.residuals(x).map(|residuals| (value, residuals));
            let mut sides = Vec::new();
            for (end, tried) in ends.into_iter().zip(tried) {
                // If there is no machine on one side, a one-sided difference is used.
                match tried {
                    Ok(residuals) => sides.push((end, residuals)),
                    Err(Trouble::NoValue(_)) => sides.push(unchanged(self)?),
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

    /// Each measurement: the indices of its experiment, column and row, its value and its standard deviation.
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

    /// Whether each fitted number has an effect on the quantities with one standard deviation that is greater than the error of
    /// derivatives, relative to the greatest effect on these quantities and to their values. The weights of different quantities can
    /// differ by any factor: where one is known to round-off, the effects on all others are small in comparison.
    fn effective_in_a_class(&self, minimum: &Minimum, changes: &[f64], exact: f64) -> Vec<bool> {
        let mut is_effective = vec![false; changes.len()];
        for class in 0..self.sigmas.len() {
            let rows = self.measurements().enumerate();
            let rows =
                rows.filter(|(_, (e, c, ..))| self.experiments[*e].columns[*c].sigma == class);
            let (mut effects, mut size) = (vec![0.0; changes.len()], 0.0);
            for (i, (_, _, _, value, sigma)) in rows {
                size += (value / sigma).powi(2);
                for (j, effect) in effects.iter_mut().enumerate() {
                    *effect += (minimum.jacobian[(i, j)] * changes[j]).powi(2);
                }
            }
            let greatest = effects.iter().copied().fold(size, f64::max).sqrt();
            for (is_effective, effect) in is_effective.iter_mut().zip(&effects) {
                *is_effective |= effect.sqrt() > exact * greatest;
            }
        }
        is_effective
    }

    /// Estimates standard deviations from the residuals of a minimum, as the root mean square of each class of columns.
    /// The fitted numbers reduce the degrees of freedom of each class by its share of the projection, the trace of its
    /// part of the hat matrix.
    pub fn estimated_sigmas(&self, minimum: &Minimum) -> Vec<f64> {
        let mut sums = vec![0.0; self.sigmas.len()];
        let mut counts = vec![0.0; self.sigmas.len()];
        let class = |e: usize, c: usize| self.experiments[e].columns[c].sigma;
        let svd = minimum.jacobian.clone().svd(true, false);
        let leverage = |i: usize| {
            let significant = svd.singular_values.iter().enumerate();
            let significant =
                significant.filter(|(_, value)| **value > 1e-8 * svd.singular_values.max());
            svd.u.as_ref().map_or(0.0, |u| {
                significant.map(|(k, _)| u[(i, k)] * u[(i, k)]).sum::<f64>()
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
                Ok((derived, off)) => {
                    self.held.off = self.held.off.max(off);
                    rows.push(derived);
                }
                Err(RunFailure::Trouble(trouble)) => return Err(trouble),
                Err(RunFailure::WithoutDerivatives(why)) => {
                    self.held.why = Some(why);
                    return self.differences(x);
                }
            }
        }
        let all: Vec<_> = self.measurements().collect();
        let integrated = DMatrix::from_fn(all.len(), x.len(), |i, j| {
            let (e, c, r, _, sigma) = all[i];
            rows[e][r].by[c][j] / sigma
        });
        if self.are_differences(x, &integrated)? {
            Ok(integrated)
        } else {
            self.held.why = Some("a force jumps".to_owned());
            self.differences(x)
        }
    }

    fn size(&self, residuals: &[f64]) -> f64 {
        // The norm of the measured values, of which residuals are differences.
        let measured = self.measurements();
        let measured: f64 = measured
            .map(|(.., value, sigma)| (value / sigma).powi(2))
            .sum();
        let computed: f64 = residuals.iter().map(|r| r * r).sum();
        measured.sqrt().max(computed.sqrt())
    }
}
