//! Implicit methods: solves the coupled nonlinear equations of the stages in each step.
//!
//! The unknowns are the accelerations `kᵢ` of the stages alone, since positions and velocities follow from them
//! ([`Scheme`](crate::methods::Scheme)): `rᵢ = a(tᵢ, qᵢ, vᵢ) − kᵢ = 0`. With `a_q = ∂a/∂q` and `a_v = ∂a/∂v` at the beginning of this step
//! or of an earlier one, Newton's method is
//!
//! ```text
//! (I − h A ⊗ a_v − h² A² ⊗ a_q) Δk = r
//! ```
//!
//! `A` and `A²` have the same eigenvectors, `w A = μ w`, so this decouples into one system for each eigenvalue with only as many unknowns
//! as coordinates, `(I − h μ a_v − h² μ² a_q) (w Δk) = w r`: a real one, and a complex one for each conjugate pair, of which methods of
//! higher orders have several. (They are never combined into one of twice the size, for `q` and `v`.) E. Hairer, G. Wanner, *Solving
//! Ordinary Differential Equations II*, 2nd ed., 1996, section IV.8, which also gives the rules for convergence, errors and steps.
//!
//! One case needs a separate treatment. If the direction `n` of a stiff spring turns within a step by an angle δ, the derivatives at the
//! beginning leave `h² k/m δ` of the spring's force across `n`, which is arbitrarily large for a stiff spring: the iteration does not
//! contract unless h ~ k^(−1/3) (C. Lubich, *Integration of stiff mechanical systems by Runge–Kutta methods*, ZAMP 44 (1993) 1022–1053,
//! section 5). Then the derivatives are evaluated at each stage, and all stages are solved for simultaneously.

pub(crate) mod jacobian;
pub(crate) mod lu;
mod newton;

use crate::compensated::Sum;
use crate::math::{rough_power, sqrt};
use crate::methods::{Conjugates, MAX_STAGES, Method, Row, Spectrum};
use crate::stages::{Point, weigh_one};
use crate::step_error::StepError;
use crate::tolerance::{SAFETY, Tolerance};
use crate::{System, Vector};
use jacobian::{Jacobian, add_product};
use lu::Lu;
use newton::{ROUNDS, ROUNDS_OF_PAIR, StageJacobians};
use std::boxed::Box;
use std::vec::Vec;

/// The Jacobian is kept for the next step unless the contraction is slower than this factor.
const FAST: f64 = 1e-2;

/// Number of steps that are solved with the Jacobians of each stage before the one of the beginning is tried again.
const STEPS_APART: usize = 50;

/// A step that could be longer by at most this factor keeps its length, and so its matrices.
const HARDLY_LONGER: f64 = 1.2;

/// The solver of an implicit method, and what it keeps from step to step.
#[derive(Clone, Debug)]
pub(crate) struct Implicit {
    spectrum: Spectrum,
    n: usize,
    jacobian: Jacobian,
    age: JacobianAge,
    /// Its fastest rate, in 1/s, once it was asked for.
    rate: Option<f64>,
    /// The derivatives at the beginning of the step are those this time later, in s, because the accelerations jump there; otherwise 0.
    ahead: f64,
    /// `I − h μ a_v − h² μ² a_q` for all eigenvalues, factorized, and their `h`; 0 for none.
    real: Lu<1>,
    complex: Vec<Lu<2>>,
    factored: f64,
    in_real: Vec<f64>,
    in_complex: Vec<[Vec<f64>; 2]>,
    /// The time that linear equations and sums over stages have taken so far, as a number of multiplications.
    multiplications: f64,
    /// The residuals of the stages, later their changes.
    change: Vec<Vec<f64>>,
    /// The changes of positions and of velocities at a stage.
    moved: [Vec<f64>; 2],
    /// The factors that make changes of positions and of velocities relative to what Newton's method may leave of them.
    scales: [Vec<f64>; 2],
    /// Memory for Jacobians at each stage, once they were needed, and the number of steps for which they remain in use.
    apart: Option<Box<StageJacobians>>,
    steps_apart: usize,

    /// Accelerations at the stages of the last step solved, its beginning and its length; 0 for none.
    known: Vec<Vec<f64>>,
    known_from: Sum,
    known_length: f64,

    /// The error after the last iteration, relative to its change.
    left: f64,
    /// The contraction factor of the iterations.
    contraction: f64,
    rounds: usize,
    /// The factor by which a step that could not be solved has to be shorter.
    shorter: f64,
    /// The error estimate of positions and of velocities.
    error: [Vec<f64>; 2],
    /// The size of the estimate of velocities before it is filtered, relative to the tolerance.
    unfiltered: f64,
    /// Length and error of the last good step; length 0 if there is none.
    step_before: f64,
    error_before: f64,
}

/// Age of the Jacobian.
#[derive(Clone, Copy, Debug, PartialEq)]
enum JacobianAge {
    None,
    /// That of an earlier step.
    Old,
    /// That of the beginning of this step.
    Fresh,
}

/// A step to be solved: its beginning, its length, and its tolerance.
pub(crate) struct StepProblem<'t, V> {
    pub method: &'static Method,
    pub before: &'t Point<V>,
    pub h: f64,
    pub tolerance: &'t Tolerance<V>,
}

/// How Newton's method ended.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Solved {
    /// The stages are found.
    Yes,
    /// The step has to be shorter, by this factor.
    Shorter(f64),
}

impl Implicit {
    /// Allocates all memory that a run needs.
    pub fn new<S: System>(system: &S, spectrum: Spectrum) -> Self {
        let n = system.coordinates().len();
        let zeros = || std::vec![0.0; n];
        let stages = spectrum.left_of_real.len();
        let pairs = spectrum.pairs.len();
        Self {
            spectrum,
            n,
            jacobian: Jacobian::new(system),
            age: JacobianAge::None,
            rate: None,
            ahead: 0.0,
            real: Lu::new(n),
            complex: std::vec![Lu::new(n); pairs],
            factored: 0.0,
            in_real: zeros(),
            in_complex: std::vec![[zeros(), zeros()]; pairs],
            multiplications: 0.0,
            change: std::vec![zeros(); stages],
            moved: [zeros(), zeros()],
            scales: [zeros(), zeros()],
            apart: None,
            steps_apart: 0,
            known: std::vec![zeros(); stages],
            known_from: Sum::default(),
            known_length: 0.0,
            left: 1.0,
            contraction: 0.0,
            rounds: 0,
            shorter: 0.5,
            error: [zeros(), zeros()],
            unfiltered: 0.0,
            step_before: 0.0,
            error_before: 0.0,
        }
    }

    /// The fastest rate of the motion, in 1/s, according to the Jacobian that is kept.
    pub fn fastest_rate(&mut self) -> f64 {
        *self
            .rate
            .get_or_insert_with(|| self.jacobian.fastest_rate())
    }

    /// The time that linear equations and sums over stages have taken so far, as a number of multiplications of real numbers.
    pub fn multiplications(&self) -> f64 {
        self.multiplications
    }

    /// Forgets the previous steps, since the accelerations have jumped.
    pub fn forget(&mut self) {
        self.age = JacobianAge::None;
        self.known_length = 0.0;
        self.step_before = 0.0;
        self.left = 1.0;
        self.ahead = 0.0;
    }

    /// Whether no step was solved since the accelerations have jumped.
    pub fn begins_anew(&self) -> bool {
        self.known_length == 0.0 && self.ahead == 0.0
    }

    /// Takes the derivatives at the beginning of the step from a time `ahead` later, since the accelerations jump there.
    pub fn begin_beyond_jump(&mut self, ahead: f64) {
        self.ahead = ahead;
        self.age = JacobianAge::None;
    }

    /// Solves for the accelerations `k` of the stages of a step. `scratch` holds a state; `accelerations(t, q, v, a)` evaluates those of
    /// the machine. Returns whether a solution was found; if not, the step is too long.
    ///
    /// # Errors
    /// Those of `accelerations`.
    pub fn solve<V: Vector>(
        &mut self,
        task: &StepProblem<'_, V>,
        k: &mut [V; MAX_STAGES],
        [q, v]: [&mut V; 2],
        mut accelerations: impl FnMut(f64, &V, &V, &mut V) -> Result<(), StepError>,
    ) -> Result<bool, StepError> {
        loop {
            if self.age == JacobianAge::None {
                let [start, .., here, there] = k;
                task.before
                    .state_ahead(self.ahead, start, [&mut *q, &mut *v]);
                let scratch = [&mut *q, &mut *v, here, there];
                let at = (task.before.t + self.ahead, task.h);
                self.jacobian.find(at, scratch, &mut accelerations)?;
                self.age = JacobianAge::Fresh;
                self.rate = None;
                self.factored = 0.0;
            }
            let solved = if self.factor(task.h) {
                self.newton(task, k, [q, v], &mut accelerations)
            } else {
                Ok(Solved::Shorter(0.5))
            };
            if solved == Ok(Solved::Yes) {
                for (known, k) in self.known.iter_mut().zip(&k[1..]) {
                    known.copy_from_slice(k.as_slice());
                }
                self.known_from = Sum {
                    high: task.before.t,
                    low: task.before.t_low,
                };
                self.known_length = task.h;
                return Ok(true);
            }
            self.left = 1.0;
            if self.age == JacobianAge::Fresh && self.steps_apart == 0 && solved.is_ok() {
                self.steps_apart = STEPS_APART;
                continue;
            }
            if self.age == JacobianAge::Fresh || self.steps_apart > 0 {
                if let Solved::Shorter(factor) = solved? {
                    self.shorter = factor;
                }
                return Ok(false);
            }
            self.age = JacobianAge::None;
        }
    }

    /// The number of iterations within which Newton's method converges; otherwise the step is too long.
    fn most_rounds(&self) -> usize {
        ROUNDS + ROUNDS_OF_PAIR * (self.spectrum.pairs.len() - 1)
    }

    /// Factorizes all matrices for a step of length `h`.
    fn factor(&mut self, h: f64) -> bool {
        if self.factored == h {
            return true;
        }
        self.factored = 0.0;
        let n = self.n;
        let factorizations = self.complex.iter().map(Lu::factorization);
        self.multiplications += self.real.factorization() + factorizations.sum::<f64>();
        let Jacobian {
            by_coordinates,
            by_rates,
            ..
        } = &self.jacobian;
        let column = |j: usize| {
            let of_rate = &by_rates[j * n..][..n];
            of_rate.iter().zip(&by_coordinates[j * n..][..n])
        };
        let step = h * self.spectrum.real;
        let real = self.real.factor(|j, [to]| {
            for (entry, (by_v, by_q)) in to.iter_mut().zip(column(j)) {
                *entry = -step * (by_v + step * by_q);
            }
            to[j] += 1.0;
        });
        let factor = |(matrix, pair): (&mut Lu<2>, &Conjugates)| {
            let [re, im] = pair.value.map(|part| h * part);
            let square = [re * re - im * im, 2.0 * re * im];
            matrix.factor(|j, [to_re, to_im]| {
                let entries = to_re.iter_mut().zip(to_im);
                for ((to_re, to_im), (by_v, by_q)) in entries.zip(column(j)) {
                    *to_re = -re * by_v - square[0] * by_q;
                    *to_im = -im * by_v - square[1] * by_q;
                }
                to_re[j] += 1.0;
            })
        };
        let complex = self.complex.iter_mut().zip(self.spectrum.pairs).all(factor);
        if real && complex {
            self.factored = h;
        }
        real && complex
    }

    /// The error of the step just solved relative to the tolerance, as root mean square over coordinates and rates. It is the estimate of
    /// the method, filtered by the matrix of the real eigenvalue.
    ///
    /// If it is too large and `again` is set, the estimate is repeated with the acceleration at the beginning reduced by the error found,
    /// so that a transient that the method damps does not count as an error (eq. (IV.8.20)).
    pub fn error_of_step<V: Vector>(
        &mut self,
        task: &StepProblem<'_, V>,
        (k, now): (&mut [V; MAX_STAGES], &Point<V>),
        [q, v]: [&mut V; 2],
        again: bool,
        mut accelerations: impl FnMut(f64, &V, &V, &mut V) -> Result<(), StepError>,
    ) -> f64 {
        let row = &task.method.scheme.error;
        self.estimate(task, row, k);
        let error = self.size_of_error(task, now);
        if !(again && error >= 1.0 && error.is_finite()) {
            return error;
        }
        let before = task.before;
        for i in 0..self.n {
            q.as_mut_slice()[i] = before.q.as_slice()[i] + self.error[0][i];
            v.as_mut_slice()[i] = before.v.as_slice()[i] + self.error[1][i];
        }
        let start = self.spectrum.real * task.h;
        let (k_known, scratch) = k.split_at_mut(MAX_STAGES - 1);
        if accelerations(before.t, q, v, &mut scratch[0]).is_err() {
            return error;
        }
        let [moved_q, moved_v, ..] = &mut self.change[..] else {
            return error;
        };
        let pairs = scratch[0].as_slice().iter().zip(k_known[0].as_slice());
        for (moved, (there, here)) in moved_v.iter_mut().zip(pairs) {
            *moved = start * (there - here);
        }
        for (moved, rate) in moved_q.iter_mut().zip(&self.error[1]) {
            *moved = start * rate;
        }
        self.estimate_again(row, task.h, k);
        self.size_of_error(task, now)
    }

    /// Replaces the acceleration at the beginning of the step just accepted by that of the polynomial through its stages, if the difference
    /// is an error that only the filter has removed: a transient that the step has damped, or round-off of a stiff part. Otherwise the
    /// motion within the step, of which it is a slope, would follow it.
    pub fn smooth_start<V: Vector>(&self, task: &StepProblem<'_, V>, k: &mut [V; MAX_STAGES]) {
        if self.unfiltered <= 1.0 {
            return;
        }
        // The estimate is `h γ₀ (k₀ − p(0))`.
        let [start, stages @ ..] = k;
        let [of_start, of_stages @ ..] = task.method.scheme.error.terms() else {
            return;
        };
        for (i, start) in start.as_mut_slice().iter_mut().enumerate() {
            let weighted = of_stages.iter();
            let sum: f64 = weighted
                .map(|term| term.velocity * stages[term.stage - 1].as_slice()[i])
                .sum();
            *start = -sum / of_start.velocity;
        }
    }

    /// Writes the error estimate to `error`.
    fn estimate<V: Vector>(&mut self, task: &StepProblem<'_, V>, row: &Row, k: &[V; MAX_STAGES]) {
        for change in &mut self.change {
            change.fill(0.0);
        }
        let mut sum = 0.0;
        for (i, v) in task.before.v.as_slice().iter().enumerate() {
            let [_, velocity] = weigh_one(row, k, i);
            let tolerance = task.tolerance;
            let tolerable = tolerance.absolute.as_slice()[i] + tolerance.relative * v.abs();
            sum += (task.h * velocity / tolerable) * (task.h * velocity / tolerable);
        }
        self.unfiltered = sqrt(sum / (2 * self.n.max(1)) as f64);
        self.estimate_again(row, task.h, k);
    }

    /// Adds `change[0]` and `change[1]` to the error estimate and filters it: `(I − h μ J)⁻¹ e` with `J` of the first-order system,
    /// `x_v = (I − h μ a_v − h² μ² a_q)⁻¹ (e_v + h μ a_q e_q)`, `x_q = e_q + h μ x_v`.
    fn estimate_again<V: Vector>(&mut self, row: &Row, h: f64, k: &[V; MAX_STAGES]) {
        let [positions, rates] = &mut self.error;
        for i in 0..self.n {
            let [position, velocity] = weigh_one(row, k, i);
            positions[i] = h * h * position + self.change[0][i];
            rates[i] = h * velocity + self.change[1][i];
        }
        let step = h * self.spectrum.real;
        add_product(rates, step, &self.jacobian.by_coordinates, positions);
        self.real.solve([rates]);
        self.multiplications += 2.0 * self.real.solution();
        for (position, rate) in positions.iter_mut().zip(rates) {
            *position += step * *rate;
        }
    }

    fn size_of_error<V: Vector>(&self, task: &StepProblem<'_, V>, now: &Point<V>) -> f64 {
        let StepProblem {
            before, tolerance, ..
        } = task;
        let mut sum = 0.0;
        for (error, (before, now)) in self
            .error
            .iter()
            .zip([(&before.q, &now.q), (&before.v, &now.v)])
        {
            for (i, error) in error.iter().enumerate() {
                let greatest = before.as_slice()[i].abs().max(now.as_slice()[i].abs());
                let tolerable = tolerance.absolute.as_slice()[i] + tolerance.relative * greatest;
                sum += (error / tolerable) * (error / tolerable);
            }
        }
        sqrt(sum / (2 * self.n.max(1)) as f64)
    }

    /// The factor for the step length after a step that was rejected with that error. The error is infinite if the step could
    /// not be solved.
    ///
    /// The step is repeated with the derivatives at its beginning, as in the program RADAU5. Those of an earlier step may belong to a far stiffer
    /// part of the motion: then one iteration changes hardly anything and counts as converged, the estimate is filtered away or does not shrink
    /// with the step, and no contraction is measured that would tell.
    pub fn reject(&mut self, error: f64, exponent: f64, shrink: f64) -> f64 {
        if self.age == JacobianAge::Old && self.steps_apart == 0 {
            self.age = JacobianAge::None;
        }
        if error.is_finite() {
            self.step_factor(error, exponent).max(shrink)
        } else {
            self.shorter
        }
    }

    /// The factor by which a step may be longer or shorter than the last one, given its error.
    ///
    /// It is smaller after more iterations.
    fn step_factor(&self, error: f64, exponent: f64) -> f64 {
        let most = 2 * self.most_rounds();
        let care = (1 + most) as f64 / (self.rounds + most) as f64;
        SAFETY * care * rough_power(error, -exponent)
    }

    /// Accepts a good step; returns the factor by which the next one may be longer.
    ///
    /// K. Gustafsson's predictive controller (eq. (IV.8.25)) extrapolates the growth of errors from step to step.
    pub fn accept(&mut self, h: f64, error: f64, exponent: f64, (shrink, grow): (f64, f64)) -> f64 {
        let mut factor = self.step_factor(error, exponent);
        if self.step_before != 0.0 {
            let growth = rough_power(self.error_before / (error * error), exponent);
            factor = factor.min(SAFETY * (h / self.step_before).abs() * growth);
        }
        self.ahead = 0.0;
        self.step_before = h;
        self.error_before = error.max(1e-2);
        let mut stays = self.contraction <= FAST;
        if self.steps_apart > 0 {
            // The error of the next step is filtered with the Jacobian at its beginning, which is the last stage of this one.
            self.steps_apart -= 1;
            stays = self.steps_apart > 0;
            if let Some(apart) = &self.apart {
                self.jacobian.take(apart.last());
                self.rate = None;
                self.factored = 0.0;
            }
        }
        self.age = if stays {
            JacobianAge::Old
        } else {
            JacobianAge::None
        };
        let factor = factor.clamp(shrink, grow);
        if stays && (1.0..=HARDLY_LONGER).contains(&factor) {
            1.0
        } else {
            factor
        }
    }
}
