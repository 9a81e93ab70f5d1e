//! Stages that depend on each other: the nonlinear equations of an implicit method, solved in each
//! step.
//!
//! Unknown are the accelerations `kᵢ` of the stages alone, since positions and velocities follow from
//! them ([`Scheme`](crate::methods::Scheme)): `rᵢ = a(tᵢ, qᵢ, vᵢ) − kᵢ = 0`. With `a_q = ∂a/∂q` and `a_v =
//! ∂a/∂v` at the beginning of the step (or of one before), Newton's method is
//!
//! ```text
//! (I − h A ⊗ a_v − h² A² ⊗ a_q) Δk = r
//! ```
//!
//! `A` and `A²` have the same eigenvectors, `w A = μ w`, so this is for each eigenvalue a system of only
//! as many unknowns as coordinates, `(I − h μ a_v − h² μ² a_q) (w Δk) = w r`: a real one, and a complex
//! one that stands for two, in methods of higher orders several. (They are never put together to one of twice as many, for `q` and `v`.) E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, 2nd ed.,
//! 1996, section IV.8, of which the rules for convergence, errors and steps are, too.
//!
//! One case has to be treated apart. Where the direction `n` of a stiff spring turns within a step, by an
//! angle δ, what the derivatives at the beginning leave of the spring's force, `h² k/m δ` across `n`, is
//! beyond all measure for a stiff spring: the rounds do not contract, unless h ~ k^(−1/3) (C. Lubich,
//! *Integration of stiff mechanical systems by Runge–Kutta methods*, ZAMP 44 (1993) 1022–1053, section 5).
//! Then the derivatives are taken at each stage, and all stages are solved for together.

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
use jacobian::Jacobian;
use lu::{Complex, Lu};
use newton::{Apart, ROUNDS, ROUNDS_OF_PAIR};
use std::boxed::Box;
use std::vec::Vec;

/// Derivatives serve another step if each round took this much of the error, or more.
const FAST: f64 = 1e-2;

/// So many steps are solved with the derivatives of each stage before those of the beginning are tried
/// again.
const STEPS_APART: usize = 50;

/// A step that would be longer by no more than this stays as it is, and so do its matrices.
const HARDLY_LONGER: f64 = 1.2;

/// The work of an implicit method, and what it remembers from step to step.
#[derive(Clone, Debug)]
pub(crate) struct Implicit {
    spectrum: Spectrum,
    n: usize,
    jacobian: Jacobian,
    age: Age,
    /// `I − h μ a_v − h² μ² a_q` of all eigenvalues, and the `h` for which they are; 0 for none.
    real: Lu<f64>,
    complex: Vec<Lu<Complex>>,
    factored: f64,
    in_real: Vec<f64>,
    in_complex: Vec<Vec<Complex>>,
    /// The residuals of the stages, then their changes.
    change: Vec<Vec<f64>>,
    /// What it takes to treat stages apart, once that was needed; and for how many steps more.
    apart: Option<Box<Apart>>,
    steps_apart: usize,

    /// Accelerations at the stages of the last step that was solved, its beginning and its length; 0 for
    /// none.
    known: Vec<Vec<f64>>,
    known_from: Sum,
    known_length: f64,

    /// By which factor the last round left more error than its change was.
    left: f64,
    /// By which factor rounds contracted.
    contraction: f64,
    rounds: usize,
    /// By which factor a step has to be shorter that could not be solved.
    shorter: f64,
    /// The estimate of the error, of positions and of velocities.
    error: [Vec<f64>; 2],
    /// Length and error of the last good step; length 0 for none.
    step_before: f64,
    error_before: f64,
}

/// Of derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Age {
    None,
    /// Those of a step before.
    Old,
    /// Those of this step's beginning.
    Fresh,
}

/// A step to be solved: its beginning, its length, and how exact it shall be.
pub(crate) struct Task<'t, V> {
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
    /// All memory that a run needs.
    pub fn new<S: System>(system: &S, spectrum: Spectrum) -> Self {
        let n = system.coordinates().len();
        let zeros = || std::vec![0.0; n];
        let stages = spectrum.left_of_real.len();
        let pairs = spectrum.pairs.len();
        Self {
            spectrum,
            n,
            jacobian: Jacobian::new(system),
            age: Age::None,
            real: Lu::new(n),
            complex: std::vec![Lu::new(n); pairs],
            factored: 0.0,
            in_real: zeros(),
            in_complex: std::vec![std::vec![Complex::default(); n]; pairs],
            change: std::vec![zeros(); stages],
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
            step_before: 0.0,
            error_before: 0.0,
        }
    }

    /// The fastest rate of the motion, in 1/s, as the derivatives have it that are kept.
    pub fn fastest_rate(&self) -> f64 {
        self.jacobian.fastest_rate()
    }

    /// Forgets what was: the accelerations have jumped.
    pub fn forget(&mut self) {
        self.age = Age::None;
        self.known_length = 0.0;
        self.step_before = 0.0;
        self.left = 1.0;
    }

    /// Solves for the accelerations `k` of the stages of a step. `scratch` holds a state;
    /// `accelerations(t, q, v, a)` are those of the machine. Says whether they are found; if not, the
    /// step is too long.
    ///
    /// An error is what stands in the way of an evaluation.
    pub fn solve<V: Vector>(
        &mut self,
        task: &Task<'_, V>,
        k: &mut [V; MAX_STAGES],
        [q, v]: [&mut V; 2],
        mut accelerations: impl FnMut(f64, &V, &V, &mut V) -> Result<(), StepError>,
    ) -> Result<bool, StepError> {
        loop {
            if self.age == Age::None {
                let [.., here, there] = k;
                q.clone_from(&task.before.q);
                v.clone_from(&task.before.v);
                let scratch = [&mut *q, &mut *v, here, there];
                let at = (task.before.t, task.h);
                self.jacobian.find(at, scratch, &mut accelerations)?;
                self.age = Age::Fresh;
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
            if self.age == Age::Fresh && self.steps_apart == 0 && solved.is_ok() {
                self.steps_apart = STEPS_APART;
                continue;
            }
            if self.age == Age::Fresh || self.steps_apart > 0 {
                if let Solved::Shorter(factor) = solved? {
                    self.shorter = factor;
                }
                return Ok(false);
            }
            self.age = Age::None;
        }
    }

    /// Newton's method has converged by so many rounds, or the step is too long for it.
    fn most_rounds(&self) -> usize {
        ROUNDS + ROUNDS_OF_PAIR * (self.spectrum.pairs.len() - 1)
    }

    /// Makes all matrices for a step of length `h`.
    fn factor(&mut self, h: f64) -> bool {
        if self.factored == h {
            return true;
        }
        self.factored = 0.0;
        let n = self.n;
        let Jacobian {
            by_coordinates,
            by_rates,
            ..
        } = &self.jacobian;
        let one = |i, j| if i == j { 1.0 } else { 0.0 };
        let step = h * self.spectrum.real;
        let real = self.real.factor(|i, j| {
            let at = i * n + j;
            one(i, j) - step * (by_rates[at] + step * by_coordinates[at])
        });
        let factor = |(matrix, pair): (&mut Lu<Complex>, &Conjugates)| {
            let [re, im] = pair.value.map(|part| h * part);
            matrix.factor(|i, j| {
                let (by_q, by_v) = (by_coordinates[i * n + j], by_rates[i * n + j]);
                Complex {
                    re: one(i, j) - re * by_v - (re * re - im * im) * by_q,
                    im: -im * by_v - 2.0 * re * im * by_q,
                }
            })
        };
        let complex = self.complex.iter_mut().zip(self.spectrum.pairs).all(factor);
        if real && complex {
            self.factored = h;
        }
        real && complex
    }

    /// The error of the step just solved, in the root mean square over coordinates and rates, 1 being
    /// just tolerable: the estimate of the method, through the matrix of the real eigenvalue.
    ///
    /// If that is too much and `again`, once more with the acceleration at the beginning less the error
    /// found: a transient that the method damps is no error of it (eq. (IV.8.20)).
    pub fn error_of_step<V: Vector>(
        &mut self,
        task: &Task<'_, V>,
        (k, now): (&mut [V; MAX_STAGES], &Point<V>),
        [q, v]: [&mut V; 2],
        again: bool,
        mut accelerations: impl FnMut(f64, &V, &V, &mut V) -> Result<(), StepError>,
    ) -> f64 {
        let row = &task.method.scheme.error;
        self.estimate(row, task.h, k);
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

    /// The estimate of the error to `error`.
    fn estimate<V: Vector>(&mut self, row: &Row, h: f64, k: &[V; MAX_STAGES]) {
        for change in &mut self.change {
            change.fill(0.0);
        }
        self.estimate_again(row, h, k);
    }

    /// The estimate of the error with `change[0]` and `change[1]` added to the estimate before it is filtered:
    /// `(I − h μ J)⁻¹ e` for `J` of the system of first order, `x_v = (I − h μ a_v − h² μ² a_q)⁻¹ (e_v + h
    /// μ a_q e_q)`, `x_q = e_q + h μ x_v`.
    fn estimate_again<V: Vector>(&mut self, row: &Row, h: f64, k: &[V; MAX_STAGES]) {
        let [positions, rates] = &mut self.error;
        for i in 0..self.n {
            let [position, velocity] = weigh_one(row, k, i);
            positions[i] = h * h * position + self.change[0][i];
            rates[i] = h * velocity + self.change[1][i];
        }
        let step = h * self.spectrum.real;
        let rows = self.jacobian.by_coordinates.chunks_exact(self.n.max(1));
        for (rate, row) in rates.iter_mut().zip(rows) {
            let by: f64 = row.iter().zip(&*positions).map(|(a, e)| a * e).sum();
            *rate += step * by;
        }
        self.real.solve(rates);
        for (position, rate) in positions.iter_mut().zip(rates) {
            *position += step * *rate;
        }
    }

    fn size_of_error<V: Vector>(&self, task: &Task<'_, V>, now: &Point<V>) -> f64 {
        let Task {
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

    /// By how much the step is to be shorter after one with that error; infinite if it could not be
    /// solved.
    pub fn reject(&self, error: f64, exponent: f64, shrink: f64) -> f64 {
        if error.is_finite() {
            self.step_factor(error, exponent).max(shrink)
        } else {
            self.shorter
        }
    }

    /// By how much a step may be longer or shorter than the last one, with that error.
    ///
    /// The more rounds it took, the more careful.
    fn step_factor(&self, error: f64, exponent: f64) -> f64 {
        let most = 2 * self.most_rounds();
        let care = (1 + most) as f64 / (self.rounds + most) as f64;
        SAFETY * care * rough_power(error, -exponent)
    }

    /// Takes note of a good step; says by how much the next one may be longer.
    ///
    /// K. Gustafsson's predictive controller (eq. (IV.8.25)): errors that grew from step to step will
    /// go on to.
    pub fn accept(&mut self, h: f64, error: f64, exponent: f64, (shrink, grow): (f64, f64)) -> f64 {
        let mut factor = self.step_factor(error, exponent);
        if self.step_before != 0.0 {
            let growth = rough_power(self.error_before / (error * error), exponent);
            factor = factor.min(SAFETY * (h / self.step_before).abs() * growth);
        }
        self.step_before = h;
        self.error_before = error.max(1e-2);
        let mut stays = self.contraction <= FAST;
        if self.steps_apart > 0 {
            // The errors of the next step are filtered with the derivatives at its beginning, which is the
            // last stage of this one.
            self.steps_apart -= 1;
            stays = self.steps_apart > 0;
            if let Some(apart) = &self.apart {
                self.jacobian.take(apart.last());
                self.factored = 0.0;
            }
        }
        self.age = if stays { Age::Old } else { Age::None };
        let factor = factor.clamp(shrink, grow);
        if stays && (1.0..=HARDLY_LONGER).contains(&factor) {
            1.0
        } else {
            factor
        }
    }
}
