//! Steps by explicit methods, in numbers of any kind and for several trajectories at once.
//!
//! What a [`Stepper`](crate::Stepper) does for machines without constraints and contacts, with the same sums, so `f64` have the same
//! bits. Everything here is done for all trajectories of a number at once, except what is decided: whether a step was good, and
//! how long the next one is. A trajectory whose step was not good tries again while others go on.

mod ensemble;
mod stepper;

pub use ensemble::{Arrival, Ensemble, Trajectory};
pub use stepper::{ExplicitStepper, ExplicitStepperBuilder};

use crate::compensated::two_sum;
use crate::control;
use crate::methods::{MAX_STAGES, Method};
use crate::stages::{Point, advance_state, squared_errors, stage_state, weigh};
use crate::step_error::StepError;
use crate::step_number::StepNumber;
use crate::stepper::Work;
use crate::tolerance::Tolerance;
use crate::{Singular, Vector};

/// What steps ask of a machine: accelerations, with its inputs.
pub(crate) trait Accelerate<N: StepNumber, V> {
    /// Accelerations of all trajectories. An error says which of them have none; the others have theirs.
    fn accelerate(&self, t: N, q: &V, v: &V, a: &mut V) -> Result<(), N::Each<Option<Singular>>>;
}

/// What became of one try of a trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Outcome {
    /// Nothing was tried: it is at its end.
    Idle,
    /// A step was taken.
    Taken,
    /// The step was given up; the next try is a shorter one.
    GivenUp,
    /// No step can be taken.
    Failed(StepError),
}

/// The state of the control of one trajectory.
#[derive(Clone, Copy, Debug)]
struct Control {
    /// Whether it is to go on.
    is_running: bool,
    /// The step to try next, with its sign.
    step: f64,
    /// The step being tried or taken last.
    last_step: f64,
    /// The error of the step before, for smoothing.
    error_before: f64,
    /// Whether the step that is to be tried was tried before, and was too long.
    is_retry: bool,
    /// Whether the acceleration now is that at the end of a step.
    is_after_step: bool,
    work: Work,
}

/// Trajectories side by side, with what a method needs of each.
#[derive(Clone, Debug)]
pub(crate) struct Track<N: StepNumber, V> {
    method: &'static Method,
    tolerance: Tolerance<V>,
    longest: f64,
    end: N,
    now: Point<V, N>,
    before: Point<V, N>,
    /// Accelerations at the stages of the last step; the first is that at its beginning.
    k: [V; MAX_STAGES],
    stage: (V, V),
    control: N::Each<Control>,
}

/// Whether a method can be used in these numbers.
fn check<N: StepNumber>(method: &Method, t: f64) -> Result<(), StepError> {
    if method.tableau.spectrum.is_some() || method.by_series {
        return Err(StepError::NotExplicit { t });
    }
    if N::IS_WIDE && !method.scheme.is_wide {
        return Err(StepError::FewDigits { t });
    }
    Ok(())
}

impl<N: StepNumber, V: Vector<N>> Track<N, V> {
    /// One trajectory at a state, in numbers that hold one: with its accelerations.
    ///
    /// # Errors
    /// Where it has none, or for a method that is not for these numbers.
    pub fn begin(
        method: &'static Method,
        tolerance: Tolerance<V>,
        (t, q, v): (N, V, V),
        machine: &impl Accelerate<N, V>,
    ) -> Result<Self, StepError> {
        let mut track = Self::resting(method, tolerance, (t, q, v))?;
        track.look(machine)?;
        Ok(track)
    }

    /// Trajectories that stand still.
    ///
    /// # Errors
    /// For a method that is not for these numbers.
    pub fn resting(
        method: &'static Method,
        tolerance: Tolerance<V>,
        (t, q, v): (N, V, V),
    ) -> Result<Self, StepError> {
        check::<N>(method, t.rounded().as_ref()[0])?;
        let zeros = q.zeros_like();
        let now = Point::new(t, q, v);
        Ok(Self {
            method,
            tolerance: Tolerance {
                relative: tolerance.relative.max(10.0 * N::EPSILON),
                ..tolerance
            },
            longest: f64::INFINITY,
            end: t,
            before: now.clone(),
            now,
            k: core::array::from_fn(|_| zeros.clone()),
            stage: (zeros.clone(), zeros),
            control: N::each(|_| Control {
                is_running: false,
                step: 0.0,
                last_step: 0.0,
                error_before: 1e-4,
                is_retry: false,
                is_after_step: false,
                work: Work::default(),
            }),
        })
    }

    pub fn set_longest_step(&mut self, step: f64) {
        self.longest = step;
    }

    pub fn set_first_step(&mut self, step: f64) {
        self.control.as_mut()[0].step = step;
    }

    pub fn t(&self) -> N {
        self.now.t
    }

    pub fn q(&self) -> &V {
        &self.now.q
    }

    pub fn v(&self) -> &V {
        &self.now.v
    }

    /// The accelerations of one trajectory now, where its last try was good.
    pub fn a(&self) -> &V {
        match self.control.as_ref()[0].is_after_step {
            true => &self.k[self.method.tableau.stages],
            false => &self.k[0],
        }
    }

    pub fn work(&self, lane: usize) -> Work {
        self.control.as_ref()[lane].work
    }

    pub fn last_step(&self) -> f64 {
        self.control.as_ref()[0].last_step
    }

    pub fn next_step(&self) -> f64 {
        self.control.as_ref()[0].step
    }

    /// Whether a trajectory is at its end.
    pub fn is_done(&self, lane: usize) -> bool {
        self.now.t.are_same(self.end).as_ref()[lane]
    }

    /// Lets a trajectory stand.
    pub fn stop(&mut self, lane: usize) {
        self.control.as_mut()[lane].is_running = false;
    }

    /// Sends one trajectory to another end.
    pub fn set_end(&mut self, end: N) {
        self.end = end;
        let [to, from] = [end, self.now.t].map(|t| t.rounded().as_ref()[0]);
        let is_done = self.is_done(0);
        let control = &mut self.control.as_mut()[0];
        control.step = control.step.abs().copysign(to - from);
        control.is_running = !is_done;
    }

    /// Finds the accelerations of one trajectory now, as at its start or where the inputs have changed.
    pub fn look(&mut self, machine: &impl Accelerate<N, V>) -> Result<(), StepError> {
        let newest = match self.control.as_ref()[0].is_after_step {
            true => self.method.tableau.stages,
            false => 0,
        };
        let Self {
            now, k, control, ..
        } = self;
        let (mut failed, mut trying) = (N::each(|_| None), N::each(|_| true));
        let at = (now.t, &now.q, &now.v);
        evaluate(machine, at, &mut k[newest], &mut trying, &mut failed);
        let control = &mut control.as_mut()[0];
        control.work.evaluations += 1;
        control.error_before = 1e-4;
        failed.as_ref()[0].map_or(Ok(()), Err)
    }

    /// Chooses the length of the first step of one trajectory, where nobody has.
    pub fn choose_first_step(&mut self, machine: &impl Accelerate<N, V>) {
        if self.control.as_ref()[0].step == 0.0 && !self.is_done(0) {
            let step = self.first_step(machine);
            self.control.as_mut()[0].step = step;
        }
    }

    /// A length for the first step of one trajectory.
    fn first_step(&mut self, machine: &impl Accelerate<N, V>) -> f64 {
        let left = (self.end - self.now.t).rounded().as_ref()[0];
        let Self {
            method,
            tolerance,
            now,
            k,
            stage,
            control,
            ..
        } = self;
        let (relative, absolute) = (tolerance.relative, tolerance.absolute.as_slice());
        let norm = |of: &dyn Fn(usize) -> [N; 2]| {
            let mut sum = 0.0;
            for (i, absolute) in absolute.iter().enumerate() {
                let sizes = [now.q.as_slice()[i], now.v.as_slice()[i]];
                let squares = [0, 1].map(|level| {
                    let size = [sizes[level]; 2];
                    let square = of(i)[level].squared_error(size, *absolute, relative);
                    square.as_ref()[0]
                });
                sum += squares[0] + squares[1];
            }
            crate::math::sqrt(sum)
        };

        let a = k[0].as_slice();
        let size = norm(&|i| [now.q.as_slice()[i], now.v.as_slice()[i]]);
        let rate = norm(&|i| [now.v.as_slice()[i], a[i]]);
        let guess = control::first_guess([size, rate], left, self.longest);
        let ahead_by = N::gather(N::each(|_| guess));
        let (q, v) = (&mut stage.0, &mut stage.1);
        for (i, a) in a.iter().enumerate() {
            q.as_mut_slice()[i] = now.q.as_slice()[i] + ahead_by * now.v.as_slice()[i];
            v.as_mut_slice()[i] = now.v.as_slice()[i] + ahead_by * *a;
        }
        // Where the machine has no acceleration that far off, the guess is tried and will be shortened.
        let (first, rest) = k.split_at_mut(1);
        let (a, ahead) = (first[0].as_slice(), &mut rest[0]);
        let (mut failed, mut trying) = (N::each(|_| None), N::each(|_| true));
        let at = (now.t + ahead_by, &*q, &*v);
        evaluate(machine, at, ahead, &mut trying, &mut failed);
        control.as_mut()[0].work.evaluations += 1;
        if failed.as_ref()[0].is_some() {
            return guess;
        }
        let ahead = ahead.as_slice();
        let change = norm(&|i| [ahead_by * a[i], ahead[i] - a[i]]) / guess.abs();
        control::first_step(method, guess, [rate, change], left, self.longest)
    }

    /// One try of every trajectory that is not at its end.
    pub fn attempt(&mut self, machine: &impl Accelerate<N, V>) -> N::Each<Outcome> {
        let mut outcomes = N::each(|_| Outcome::Idle);
        self.begin_steps();
        let (h, is_last) = self.choose_lengths(&mut outcomes);
        let mut failed = N::each(|_| None);
        let errors = self.try_steps((h, &is_last), machine, &mut failed);
        let h = h.rounded();
        for (lane, outcome) in outcomes.as_mut().iter_mut().enumerate() {
            if self.control.as_ref()[lane].is_running {
                let (error, cause) = (errors.as_ref()[lane], failed.as_ref()[lane]);
                *outcome = self.decide(lane, h.as_ref()[lane], error, cause);
            }
        }
        outcomes
    }

    /// Makes now the beginning of a step, but where the last one is tried again.
    fn begin_steps(&mut self) {
        let control = self.control.as_mut();
        let begins = N::each(|lane| !control[lane].is_retry);
        let moves = N::each(|lane| !control[lane].is_retry && control[lane].is_after_step);
        for (lane, control) in control.iter_mut().enumerate() {
            control.is_after_step &= !begins.as_ref()[lane];
        }
        choose_point(&begins, &mut self.before, &self.now);
        let (first, rest) = self.k.split_at_mut(1);
        let newest = &rest[self.method.tableau.stages - 1];
        choose(&moves, &mut first[0], newest);
    }

    /// The lengths of the next steps, 0 where there is none, and whether they are the last ones.
    fn choose_lengths(&mut self, outcomes: &mut N::Each<Outcome>) -> (N, N::Each<bool>) {
        let left = (self.end - self.before.t) - self.before.t_low;
        let mut lengths = N::each(|_| 0.0);
        let mut is_last = N::each(|_| false);
        let (t, lefts) = (self.before.t.rounded(), left.rounded());
        for (lane, control) in self.control.as_mut().iter_mut().enumerate() {
            if !control.is_running {
                continue;
            }
            let (t, left) = (t.as_ref()[lane], lefts.as_ref()[lane]);
            let least = least::<N>(t).min(0.9 * left.abs());
            if !control.is_retry && control.step.abs() <= least {
                control.is_running = false;
                outcomes.as_mut()[lane] = Outcome::Failed(StepError::StepTooSmall {
                    coordinate: 0,
                    t,
                    step: control.last_step,
                });
                continue;
            }
            control.step = control.step.clamp(-self.longest, self.longest);
            // The last step may stretch by a hundredth, so that no sliver is left over.
            is_last.as_mut()[lane] = 1.01 * control.step.abs() >= left.abs();
            lengths.as_mut()[lane] = control.step;
        }
        let h = left.where_true(&is_last, N::gather(lengths));
        for (control, h) in self.control.as_mut().iter_mut().zip(h.rounded().as_ref()) {
            if control.is_running {
                control.last_step = *h;
            }
        }
        (h, is_last)
    }

    /// Tries steps of lengths `h` from `before`, to `now`, which stays at `before` where a step is not good. Returns their errors,
    /// 1 being just tolerable.
    fn try_steps(
        &mut self,
        (h, is_last): (N, &N::Each<bool>),
        machine: &impl Accelerate<N, V>,
        failed: &mut N::Each<Option<StepError>>,
    ) -> N::Each<f64> {
        let Self {
            method,
            tolerance,
            end,
            now,
            before,
            k,
            stage,
            control,
            ..
        } = self;
        let control = control.as_mut();
        let (tableau, scheme) = (&method.tableau, &method.scheme);
        let stages = tableau.stages;
        let mut trying = N::each(|lane| control[lane].is_running);
        let mut ask = |at: (N, &V, &V),
                       a: &mut V,
                       trying: &mut N::Each<bool>,
                       failed: &mut N::Each<Option<StepError>>| {
            for (control, trying) in control.iter_mut().zip(trying.as_ref()) {
                control.work.evaluations += usize::from(*trying);
            }
            evaluate(machine, at, a, trying, failed);
        };

        let (q, v) = (&mut stage.0, &mut stage.1);
        for i in 1..stages {
            if !trying.as_ref().contains(&true) {
                break;
            }
            let ch = h.weighted(tableau.c[i], scheme.c_beyond[i]);
            let t = before.t + (before.t_low + ch);
            stage_state((&scheme.rows[i], ch, h), [&before.q, &before.v], k, [q, v]);
            ask((t, q, v), &mut k[i], &mut trying, failed);
        }

        advance_state((&scheme.rows[stages], h), before, k, now);
        let (t, t_low) = two_sum(before.t, before.t_low + h);
        now.t = end.where_true(is_last, t);
        now.t_low = N::NOTHING.where_true(is_last, t_low);
        if scheme.error_needs_end && trying.as_ref().contains(&true) {
            keep_where(&trying, now, before);
            let at = (now.t, &now.q, &now.v);
            ask(at, &mut k[stages], &mut trying, failed);
        }
        let of = (tolerance.relative, &tolerance.absolute);
        let fine = squared_errors((&scheme.error, h), [before, now], k, of);
        let coarse = match tableau.coarse_error {
            Some(_) => squared_errors((&scheme.coarse_error, h), [before, now], k, of),
            None => N::each(|_| 0.0),
        };
        let numbers = 2 * N::PARTS * now.q.as_slice().len();
        let errors = N::each(|lane| {
            let [fine, coarse] = [fine, coarse].map(|sums| sums.as_ref()[lane]);
            let error = control::combined(fine, coarse, numbers);
            match error.is_finite() {
                true => error,
                // An error beyond all measure.
                false => f64::INFINITY,
            }
        });
        // Where the state itself has left the range of numbers, the error has as well.
        for (lane, failed) in failed.as_mut().iter_mut().enumerate() {
            let is_beyond = trying.as_ref()[lane] && errors.as_ref()[lane] == f64::INFINITY;
            if is_beyond && let Some(coordinate) = not_finite(&now.q, &now.v, lane) {
                let t = now.t.rounded().as_ref()[lane];
                *failed = Some(StepError::NotFinite { coordinate, t });
            }
        }
        let mut good = N::each(|lane| trying.as_ref()[lane] && errors.as_ref()[lane] <= 1.0);
        if !scheme.error_needs_end && good.as_ref().contains(&true) {
            keep_where(&good, now, before);
            let at = (now.t, &now.q, &now.v);
            ask(at, &mut k[stages], &mut good, failed);
        }
        keep_where(&good, now, before);
        errors
    }

    /// What becomes of a trajectory after a try of a step.
    fn decide(&mut self, lane: usize, h: f64, error: f64, cause: Option<StepError>) -> Outcome {
        let is_done = self.is_done(lane);
        let control = &mut self.control.as_mut()[lane];
        match cause {
            None if error <= 1.0 => {
                let factor = control::growth(self.method, error, control.error_before);
                // Not longer right after a rejection: what stood in the way is still near.
                let is_held = control.is_retry;
                control.step = h * if is_held { factor.min(1.0) } else { factor };
                control.error_before = error.max(1e-4);
                control.is_retry = false;
                control.is_after_step = true;
                control.is_running = !is_done;
                control.work.steps += 1;
                return Outcome::Taken;
            }
            None => control.step = h * control::reduction(self.method, error),
            // Perhaps a stage reached beyond where the machine can be.
            Some(_) => control.step = 0.1 * h,
        }
        control.is_retry = true;
        control.work.rejected += 1;
        let t = self.before.t.rounded().as_ref()[lane];
        if control.step.abs() > least::<N>(t) {
            return Outcome::GivenUp;
        }
        control.is_running = false;
        control.is_retry = false;
        Outcome::Failed(cause.unwrap_or(StepError::StepTooSmall {
            coordinate: self.worst(lane),
            t,
            step: h,
        }))
    }

    /// The coordinate with the greatest error in the last try of a trajectory.
    fn worst(&self, lane: usize) -> usize {
        let h = N::gather(N::each(|lane| self.control.as_ref()[lane].last_step));
        let Tolerance { relative, absolute } = &self.tolerance;
        let mut worst = (0, 0.0);
        for (i, absolute) in absolute.as_slice().iter().enumerate() {
            let [[position], [velocity]] = weigh::<1, N, V>(&self.method.scheme.error, &self.k, i);
            let at = |vector: &V| [vector.as_slice()[i]; 2];
            let squares = [
                (h * h * position).squared_error(at(&self.before.q), *absolute, *relative),
                (h * velocity).squared_error(at(&self.before.v), *absolute, *relative),
            ];
            for square in squares {
                if square.as_ref()[lane] > worst.1 {
                    worst = (i, square.as_ref()[lane]);
                }
            }
        }
        worst.0
    }
}

/// A few parts in 10¹⁵ of the time, in `f64`: shorter steps have no beginning and no end. Near t = 0 that is no limit; there the
/// smallest numbers are.
fn least<N: StepNumber>(t: f64) -> f64 {
    (10.0 * N::EPSILON * t.abs()).max(N::LEAST_STEP)
}

/// Accelerations of the trajectories that are trying. One that has none tries no more; its accelerations are 0, so that those of
/// others are not disturbed by what is no number.
fn evaluate<N: StepNumber, V: Vector<N>>(
    machine: &impl Accelerate<N, V>,
    (t, q, v): (N, &V, &V),
    a: &mut V,
    trying: &mut N::Each<bool>,
    failed: &mut N::Each<Option<StepError>>,
) {
    let none = machine.accelerate(t, q, v, a).err();
    // The sum of what is not finite is not finite, and one test is cheaper than many.
    let sum = a.as_slice().iter().fold(N::NOTHING, |sum, a| sum + *a);
    let mut fine = sum.are_finite();
    if none.is_none() && !fine.as_ref().contains(&false) {
        return;
    }
    for (lane, fine) in fine.as_mut().iter_mut().enumerate() {
        let t = t.rounded().as_ref()[lane];
        let singular = none.and_then(|none| none.as_ref()[lane]);
        let error = match singular {
            Some(singular) => Some(StepError::Singular { singular, t }),
            None if *fine => None,
            None => not_finite(a, a, lane).map(|coordinate| StepError::NotFinite { coordinate, t }),
        };
        *fine = error.is_none();
        if error.is_some() && trying.as_ref()[lane] {
            trying.as_mut()[lane] = false;
            failed.as_mut()[lane] = error;
        }
    }
    for a in a.as_mut_slice() {
        *a = a.where_true(&fine, N::NOTHING);
    }
}

/// The first coordinate for which one of two vectors is not finite in a trajectory.
fn not_finite<N: StepNumber, V: Vector<N>>(one: &V, other: &V, lane: usize) -> Option<usize> {
    let pairs = one.as_slice().iter().zip(other.as_slice());
    pairs
        .map(|pair| <[&N; 2]>::from(pair).map(|number| number.are_finite().as_ref()[lane]))
        .position(|finite| finite != [true; 2])
}

/// Copies a vector, in the trajectories for which `condition` holds.
fn choose<N: StepNumber, V: Vector<N>>(condition: &N::Each<bool>, to: &mut V, from: &V) {
    for (to, from) in to.as_mut_slice().iter_mut().zip(from.as_slice()) {
        *to = from.where_true(condition, *to);
    }
}

/// Copies a state, in the trajectories for which `condition` holds.
fn choose_point<N: StepNumber, V: Vector<N>>(
    condition: &N::Each<bool>,
    to: &mut Point<V, N>,
    from: &Point<V, N>,
) {
    to.t = from.t.where_true(condition, to.t);
    to.t_low = from.t_low.where_true(condition, to.t_low);
    choose(condition, &mut to.q, &from.q);
    choose(condition, &mut to.q_low, &from.q_low);
    choose(condition, &mut to.v, &from.v);
    choose(condition, &mut to.v_low, &from.v_low);
}

/// Keeps a state in the trajectories for which `condition` holds, and puts `otherwise` in its place in all others.
fn keep_where<N: StepNumber, V: Vector<N>>(
    condition: &N::Each<bool>,
    state: &mut Point<V, N>,
    otherwise: &Point<V, N>,
) {
    let others = N::each(|lane| !condition.as_ref()[lane]);
    if others.as_ref().contains(&true) {
        choose_point(&others, state, otherwise);
    }
}
