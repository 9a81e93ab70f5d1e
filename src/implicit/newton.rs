//! Newton's method for the stages of a step.

use super::jacobian::Jacobian;
use super::lu::{self, Lu, add_multiple};
use super::{Implicit, Solved, StepProblem};
use crate::math::{rough_power, sqrt};
use crate::methods::MAX_STAGES;
use crate::stages::stage_state;
use crate::{StepError, Vector};
use std::boxed::Box;
use std::vec::Vec;

/// The number of iterations within which Newton's method converges; otherwise the step is too long.
pub(super) const ROUNDS: usize = 8;

/// Additional iterations for each pair of stages beyond three stages, as in the program RADAU.
pub(super) const ROUNDS_OF_PAIR: usize = 5;

/// Error left by Newton's method, relative to the tolerance, at coarse tolerances.
const LEFT: f64 = 0.03;

/// Error left by Newton's method if it stagnates, because rounding hides the solution.
const LEFT_BY_ROUNDING: f64 = 0.1;

/// The Jacobians of the stages are not evaluated again while an iteration leaves at most this fraction
/// of the error.
const CONTRACTS: f64 = 0.05;

/// An iteration that leaves more than this fraction of the error stagnates, provided that the earlier ones converged.
const STAGNATES: f64 = 0.3;

/// They converged if the last change is at most this fraction of the first.
const FAR: f64 = 0.01;

/// The Jacobians at each stage, and the matrix of all of them together.
#[derive(Clone, Debug)]
pub(super) struct StageJacobians {
    jacobians: Vec<Jacobian>,
    /// Its rows and columns are the accelerations of the first stage, then of the second, and so on.
    matrix: Lu<1>,
    x: Vec<f64>,
}

impl StageJacobians {
    fn new(like: &Jacobian, stages: usize) -> Self {
        let n = like.noise.len();
        Self {
            jacobians: std::vec![like.clone(); stages],
            matrix: Lu::new(stages * n),
            x: std::vec![0.0; stages * n],
        }
    }

    /// The Jacobian at the last stage.
    pub fn last(&self) -> &Jacobian {
        &self.jacobians[self.jacobians.len() - 1]
    }

    /// Factorizes the matrix of blocks `δᵢⱼ I − h aᵢⱼ a_v(i) − h² āᵢⱼ a_q(i)`.
    fn factor<V>(&mut self, task: &StepProblem<'_, V>) -> bool {
        let stages = self.jacobians.len();
        let n = self.x.len() / stages;
        let mut weights = [[[0.0; 2]; MAX_STAGES]; MAX_STAGES];
        for (weights, row) in weights.iter_mut().zip(&task.method.scheme.rows[1..=stages]) {
            for term in row.terms() {
                weights[term.stage - 1] = [task.h * term.velocity, task.h * task.h * term.position];
            }
        }
        let Self {
            jacobians, matrix, ..
        } = self;
        // By blocks, so that the stage of an entry is not found by a division.
        matrix.factor(|column, [entries]| {
            let (other, j) = (column / n, column % n);
            for (stage, block) in entries.chunks_exact_mut(n).enumerate() {
                let [velocity, position] = weights[stage][other];
                let of_rate = &jacobians[stage].by_rates[j * n..][..n];
                let of_coordinate = &jacobians[stage].by_coordinates[j * n..][..n];
                let derivatives = of_rate.iter().zip(of_coordinate);
                for (entry, (by_rate, by_coordinate)) in block.iter_mut().zip(derivatives) {
                    *entry = -velocity * by_rate - position * by_coordinate;
                }
            }
            entries[column] += 1.0;
        })
    }

    /// Solves for the changes from the residuals, in place.
    fn solve(&mut self, change: &mut [Vec<f64>]) {
        let n = self.x.len() / self.jacobians.len();
        for (x, change) in self.x.chunks_exact_mut(n.max(1)).zip(&*change) {
            x.copy_from_slice(change);
        }
        self.matrix.solve([&mut self.x]);
        for (x, change) in self.x.chunks_exact(n.max(1)).zip(change) {
            change.copy_from_slice(x);
        }
    }
}

impl<V: Vector> StepProblem<'_, V> {
    /// Sets `q` and `v` to the state at a stage; returns its time.
    fn go_to(&self, stage: usize, k: &[V; MAX_STAGES], [q, v]: [&mut V; 2]) -> f64 {
        let StepProblem {
            method, before, h, ..
        } = self;
        let c = method.tableau.c[stage];
        let row = &method.scheme.rows[stage];
        stage_state::<f64, _>((row, c * *h, *h), [&before.q, &before.v], k, [q, v]);
        before.t + (before.t_low + c * h)
    }
}

/// `a − k`.
fn subtract<V: Vector>(a: &V, k: &V, difference: &mut [f64]) {
    let pairs = a.as_slice().iter().zip(k.as_slice());
    for (difference, (a, k)) in difference.iter_mut().zip(pairs) {
        *difference = a - k;
    }
}

impl Implicit {
    /// The initial guess of Newton's method: the extrapolated polynomial through the stages of the last
    /// step, or at the beginning of a run the acceleration there.
    fn predict<V: Vector>(&self, task: &StepProblem<'_, V>, k: &mut [V; MAX_STAGES]) {
        let (start, stages) = k.split_at_mut(1);
        let count = self.known.len();
        let (c, stages) = (&task.method.tableau.c[1..=count], &mut stages[..count]);
        if self.known_length == 0.0 {
            for stage in stages {
                stage.clone_from(&start[0]);
            }
            return;
        }
        let StepProblem { before, h, .. } = task;
        let since = (before.t - self.known_from.high) + (before.t_low - self.known_from.low);
        for (stage, c_stage) in stages.iter_mut().zip(c) {
            let x = (since + c_stage * h) / self.known_length;
            let mut weights = [0.0; MAX_STAGES];
            for (own, weight) in weights.iter_mut().enumerate().take(count) {
                let (mut above, mut below) = (1.0, 1.0);
                for (_, other) in c.iter().enumerate().filter(|(other, _)| *other != own) {
                    above *= x - other;
                    below *= c[own] - other;
                }
                *weight = above / below;
            }
            let stage = stage.as_mut_slice();
            stage.fill(0.0);
            for (weight, known) in weights.iter().zip(&self.known) {
                add_multiple(stage, *weight, known);
            }
        }
    }

    /// Newton's method with the matrices as they are, or with those of the stages, which are evaluated
    /// again until it contracts.
    pub(super) fn newton<V: Vector>(
        &mut self,
        task: &StepProblem<'_, V>,
        k: &mut [V; MAX_STAGES],
        scratch: [&mut V; 2],
        accelerations: &mut impl FnMut(f64, &V, &V, &mut V) -> Result<(), StepError>,
    ) -> Result<Solved, StepError> {
        self.predict(task, k);
        self.measure(task);
        let [q, v] = scratch;
        let mut anew = self.steps_apart > 0;
        let is_measured = self.left < 1.0;
        // The known contraction is forgotten gradually.
        self.left = rough_power(self.left.max(f64::EPSILON), 0.8);
        self.contraction = 0.0;
        let (mut first, mut size_before) = (0.0, 0.0);
        let most = self.most_rounds();
        for round in 1..=most {
            self.rounds = round;
            // Two for the states of the stages, two for the eigenvectors, and two for the size of the change.
            self.multiplications += lu::sums(6 * self.change.len() * self.change.len(), self.n);
            let mut is_confirmed = is_measured || round > 1;
            let solved = match self.steps_apart {
                0 => {
                    self.residuals(task, k, [q, v], accelerations)?;
                    is_confirmed = is_confirmed || self.residuals_are_small(task);
                    self.solve_by_eigenvectors();
                    let solutions = self.complex.iter().map(Lu::solution);
                    self.multiplications += self.real.solution() + solutions.sum::<f64>();
                    true
                }
                _ => {
                    is_confirmed = true;
                    self.solve_apart(task, k, [q, v], anew, accelerations)?
                }
            };
            let size = self.size_of_change(task);
            if !solved || !size.is_finite() {
                return Ok(Solved::Shorter(0.5));
            }
            if round > 1 {
                let now = size / size_before;
                let far = size > FAR * first;
                if now > STAGNATES && !far && size <= self.standing(task) {
                    return Ok(Solved::Yes);
                }
                self.contraction = match round {
                    2 => now,
                    _ => sqrt(now * self.contraction),
                };
                if self.contraction >= 0.99 {
                    return Ok(Solved::Shorter(0.5));
                }
                self.left = self.contraction / (1.0 - self.contraction);
                // Estimates the error after the last permitted iteration.
                let rest = i32::try_from(most - round).unwrap_or(0);
                let at_last = (0..rest).fold(self.left * size, |left, _| left * self.contraction);
                let helpless = self.steps_apart == 0 || self.contraction <= CONTRACTS;
                if at_last >= self.standing(task) && helpless {
                    let exponent = -1.0 / (4.0 + f64::from(rest));
                    let factor = 0.8 * rough_power(at_last.clamp(1e-4, 20.0), exponent);
                    return Ok(Solved::Shorter(factor));
                }
            }
            for (k, change) in k[1..].iter_mut().zip(&self.change) {
                for (k, change) in k.as_mut_slice().iter_mut().zip(change) {
                    *k += change;
                }
            }
            if is_confirmed && self.left * size <= 1.0 {
                return Ok(Solved::Yes);
            }
            anew = self.steps_apart > 0 && self.left > CONTRACTS;
            if round == 1 {
                first = size;
            }
            size_before = size;
        }
        Ok(Solved::Shorter(0.5))
    }

    /// The fraction of the tolerance that Newton's method may leave as its error, which is smaller at finer tolerances.
    fn share<V>(&self, task: &StepProblem<'_, V>) -> f64 {
        let relative = task.tolerance.relative;
        LEFT.min(sqrt(relative)).max(10.0 * f64::EPSILON / relative)
    }

    /// The largest change with which an iteration that stagnates is accepted.
    fn standing<V>(&self, task: &StepProblem<'_, V>) -> f64 {
        (LEFT_BY_ROUNDING / self.share(task)).max(1.0)
    }

    /// Computes the residuals `a(tᵢ, qᵢ, vᵢ) − kᵢ` of the stages in `change`.
    fn residuals<V: Vector>(
        &mut self,
        task: &StepProblem<'_, V>,
        k: &mut [V; MAX_STAGES],
        [q, v]: [&mut V; 2],
        accelerations: &mut impl FnMut(f64, &V, &V, &mut V) -> Result<(), StepError>,
    ) -> Result<(), StepError> {
        for stage in 1..=self.change.len() {
            let t = task.go_to(stage, k, [q, v]);
            let (k, scratch) = k.split_at_mut(MAX_STAGES - 1);
            accelerations(t, q, v, &mut scratch[0])?;
            subtract(&scratch[0], &k[stage], &mut self.change[stage - 1]);
        }
        Ok(())
    }

    /// Whether the residuals in `change` are small by themselves, before Newton's matrix reduces them.
    ///
    /// A small change alone does not show that the stages are found: where a force jumps, as `sign(der(x))` does at rest, its difference quotient
    /// is as large as that of a very stiff part, and any residual causes hardly a change. So the first change counts only if the contraction is
    /// known from earlier steps, or if the residuals are below the tolerance or round-off.
    fn residuals_are_small<V: Vector>(&self, task: &StepProblem<'_, V>) -> bool {
        let (before, tolerance) = (task.before, task.tolerance);
        let share = self.share(task);
        let is_small = |(i, residual): (usize, &f64)| {
            let absolute = tolerance.absolute.as_slice()[i];
            let v = before.v.as_slice()[i].abs();
            let tolerable = share * (absolute + tolerance.relative * v);
            let roundoff = 4.0 * f64::EPSILON * self.jacobian.noise[i];
            residual.abs() <= (tolerable / task.h.abs()).max(roundoff)
        };
        let mut stages = self.change.iter();
        stages.all(|residuals| residuals.iter().enumerate().all(is_small))
    }

    /// One iteration with the Jacobians of each stage, evaluated `anew` or kept from the iteration
    /// before: residuals and changes. Returns whether the matrix is invertible.
    fn solve_apart<V: Vector>(
        &mut self,
        task: &StepProblem<'_, V>,
        k: &mut [V; MAX_STAGES],
        [q, v]: [&mut V; 2],
        anew: bool,
        accelerations: &mut impl FnMut(f64, &V, &V, &mut V) -> Result<(), StepError>,
    ) -> Result<bool, StepError> {
        let mut apart = match self.apart.take() {
            Some(apart) => apart,
            None => Box::new(StageJacobians::new(&self.jacobian, self.change.len())),
        };
        let solved = if anew {
            let found = (1..=self.change.len()).try_for_each(|stage| {
                let t = task.go_to(stage, k, [q, v]);
                let (k, scratch) = k.split_at_mut(MAX_STAGES - 2);
                let (here, there) = scratch.split_at_mut(1);
                let (here, there) = (&mut here[0], &mut there[0]);
                let scratch = [&mut *q, &mut *v, &mut *here, there];
                apart.jacobians[stage - 1].find((t, task.h), scratch, accelerations)?;
                subtract(here, &k[stage], &mut self.change[stage - 1]);
                Ok(())
            });
            self.multiplications += apart.matrix.factorization();
            found.map(|()| apart.factor(task))
        } else {
            self.residuals(task, k, [q, v], accelerations)
                .map(|()| true)
        };
        if solved == Ok(true) {
            self.multiplications += apart.matrix.solution();
            apart.solve(&mut self.change);
        }
        self.apart = Some(apart);
        solved
    }

    /// Solves for the changes from the residuals by means of the eigenvectors.
    fn solve_by_eigenvectors(&mut self) {
        let Self {
            spectrum,
            in_real,
            in_complex,
            change,
            ..
        } = self;
        in_real.fill(0.0);
        for (left, change) in spectrum.left_of_real.iter().zip(&*change) {
            add_multiple(in_real, *left, change);
        }
        self.real.solve([in_real]);
        let pairs = spectrum.pairs.iter().zip(&self.complex);
        for ([re, im], (pair, matrix)) in in_complex.iter_mut().zip(pairs) {
            re.fill(0.0);
            im.fill(0.0);
            for ([left_re, left_im], change) in pair.left.iter().zip(&*change) {
                add_multiple(re, *left_re, change);
                add_multiple(im, *left_im, change);
            }
            matrix.solve([re, im]);
        }
        for (stage, change) in change.iter_mut().enumerate() {
            let real = spectrum.right_of_real[stage];
            for (change, x) in change.iter_mut().zip(&*in_real) {
                *change = real * x;
            }
            for ([z_re, z_im], pair) in in_complex.iter().zip(spectrum.pairs) {
                // Together with the conjugate, twice the real part.
                let [re, im] = pair.right[stage];
                add_multiple(change, 2.0 * re, z_re);
                add_multiple(change, -2.0 * im, z_im);
            }
        }
    }

    /// Computes `scales`: a change of size 1 is the error that Newton's method may leave, or round-off.
    fn measure<V: Vector>(&mut self, task: &StepProblem<'_, V>) {
        let StepProblem {
            before, tolerance, ..
        } = task;
        let share = self.share(task);
        let h = task.h.abs();
        let Jacobian { sizes, noise, .. } = &self.jacobian;
        for i in 0..self.n {
            let (q, v) = (before.q.as_slice()[i].abs(), before.v.as_slice()[i].abs());
            // In a stiff machine the forces determine positions only to within their round-off.
            let of_forces = (sizes[0][i] / h).min(h * noise[i]);
            let roundoff = 4.0 * f64::EPSILON * of_forces;
            let absolute = tolerance.absolute.as_slice()[i];
            let least = |y: f64, roundoff: f64| {
                let tolerable = share * (absolute + tolerance.relative * y);
                tolerable.max(4.0 * f64::EPSILON * y + roundoff)
            };
            self.scales[0][i] = h * h / least(q, h * roundoff);
            self.scales[1][i] = h / least(v, roundoff);
        }
    }

    /// The change of positions and velocities of the stages, as root mean square over all of them, in units of what may be left.
    fn size_of_change<V>(&mut self, task: &StepProblem<'_, V>) -> f64 {
        let stages = self.change.len();
        let [position, velocity] = &mut self.moved;
        let [of_position, of_velocity] = &self.scales;
        let mut sum = 0.0;
        for row in &task.method.scheme.rows[1..=stages] {
            position.fill(0.0);
            velocity.fill(0.0);
            for term in row.terms() {
                let change = &self.change[term.stage - 1];
                add_multiple(position, term.position, change);
                add_multiple(velocity, term.velocity, change);
            }
            let scales = of_position.iter().zip(of_velocity);
            for ((position, velocity), (of_position, of_velocity)) in
                position.iter().zip(&*velocity).zip(scales)
            {
                let (q, v) = (position * of_position, velocity * of_velocity);
                sum += q * q + v * v;
            }
        }
        sqrt(sum / (2 * stages * self.n.max(1)) as f64)
    }
}
