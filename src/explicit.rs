//! Steps by explicit methods, in numbers of any kind and for several trajectories at once.
//!
//! These are the steps of a [`Stepper`](crate::Stepper) for machines without constraints and contacts, with the same sums, so in `f64`
//! they have the same bits. Everything is computed for all trajectories of a number at once, except decisions: whether a step was good,
//! and how long the next one is. A trajectory whose step was rejected attempts a shorter one while others go on.

mod ensemble;
#[cfg(feature = "std")]
mod in_series;
mod stepper;

pub use ensemble::{Arrival, Ensemble, Trajectory};
pub use stepper::{ExplicitStepper, ExplicitStepperBuilder};

use crate::attempt::{self, not_finite};
use crate::control::{self, Control, Work};
use crate::interpolant::{Ends, Interpolant, hermite};
use crate::methods::{MAX_STAGES, Method, MethodKind};
use crate::scalar::{Kernel, Scalar};
use crate::stages::{Point, are_all_finite};
use crate::step_error::StepError;
use crate::step_number::{Real, StepNumber};
use crate::tolerance::Tolerance;
use crate::{Singular, Vector};

/// The machine as steps see it: accelerations, with the inputs already set.
pub(crate) trait Accelerate<N: StepNumber, V> {
    /// Evaluates the accelerations of all trajectories. An error holds the trajectories that have none; those of the others are valid.
    fn accelerate(&self, t: N, q: &V, v: &V, a: &mut V) -> Result<(), N::Each<Option<Singular>>>;
}

/// The outcome of one attempt of a trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Outcome {
    /// No step was attempted, because the trajectory is at its end.
    Idle,
    /// A step was taken.
    Taken,
    /// The step was rejected; the next attempt is shorter.
    GivenUp,
    /// No step can be taken.
    Failed(StepError),
}

/// State of one trajectory.
#[derive(Clone, Copy, Debug)]
struct Lane {
    /// Whether it continues.
    is_running: bool,
    /// Whether the present acceleration is the one at the end of a step.
    is_after_step: bool,
    control: Control,
}

/// Trajectories in parallel, with everything that a method needs for each.
#[derive(Clone, Debug)]
pub(crate) struct Track<N: StepNumber, V> {
    method: &'static Method,
    tolerance: Tolerance<V>,
    longest: f64,
    end: N,
    now: Point<V, N>,
    before: Point<V, N>,
    /// Accelerations at the stages of the last step; the first one is at its beginning.
    k: [V; MAX_STAGES],
    stage: (V, V),
    /// The lengths of the last steps attempted.
    h: N,
    lanes: N::Each<Lane>,
}

/// Checks that a method can be used in these numbers.
fn check<N: StepNumber>(method: &Method, t: f64) -> Result<(), StepError> {
    if method.tableau.spectrum.is_some() || method.kind != MethodKind::RungeKutta {
        return Err(StepError::NotExplicit { t });
    }
    if N::IS_WIDE && !method.scheme.is_wide {
        return Err(StepError::FewDigits { t });
    }
    Ok(())
}

/// One attempt of every trajectory, in the fastest arithmetic available for such numbers.
struct Attempt<'a, N: StepNumber, V, M>(&'a mut Track<N, V>, &'a M);

impl<N: StepNumber, V: Vector<N>, M: Accelerate<N, V>> Kernel<N> for Attempt<'_, N, V, M> {
    type Output = N::Each<Outcome>;

    #[inline(always)]
    fn run<R: Scalar<Stored = N>>(self) -> N::Each<Outcome> {
        let Self(track, machine) = self;
        track.attempt::<R>(machine)
    }
}

impl<N: StepNumber, V: Vector<N>> Track<N, V> {
    /// Begins one trajectory at a state, in numbers that hold one, and evaluates its accelerations.
    ///
    /// # Errors
    /// If it has none.
    pub fn begin(
        method: &'static Method,
        tolerance: Tolerance<V>,
        (t, q, v): (N, V, V),
        machine: &impl Accelerate<N, V>,
    ) -> Result<Self, StepError> {
        let mut track = Self::resting(method, tolerance, (t, q, v));
        track.evaluate_now(machine)?;
        Ok(track)
    }

    /// Trajectories that do not move yet.
    pub fn resting(method: &'static Method, tolerance: Tolerance<V>, (t, q, v): (N, V, V)) -> Self {
        let zeros = q.zeros_like();
        let now = Point::new(t, q, v);
        Self {
            method,
            tolerance: Tolerance {
                relative: tolerance.relative.max(10.0 * N::EPSILON),
                ..tolerance
            },
            longest: f64::INFINITY,
            end: t,
            before: now.clone(),
            now,
            k: zeros.several_zeros_like(),
            stage: (zeros.clone(), zeros),
            h: N::NOTHING,
            lanes: N::each(|_| Lane {
                is_running: false,
                is_after_step: false,
                control: Control::new(),
            }),
        }
    }

    pub fn set_longest_step(&mut self, step: f64) {
        self.longest = control::longest_step_or_infinity(step);
    }

    pub fn set_first_step(&mut self, step: f64) {
        self.control_mut().step = step;
    }

    /// The step size control of the only trajectory.
    fn control(&self) -> &Control {
        &self.lanes.as_ref()[0].control
    }

    fn control_mut(&mut self) -> &mut Control {
        &mut self.lanes.as_mut()[0].control
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

    /// The present accelerations of the only trajectory, if its last attempt was good.
    pub fn a(&self) -> &V {
        &self.k[self.newest_stage()]
    }

    /// The stage of the only trajectory that holds its present acceleration.
    fn newest_stage(&self) -> usize {
        if self.is_after_step() {
            self.method.tableau.stages
        } else {
            0
        }
    }

    /// Whether the only trajectory is at the end of a good step.
    pub fn is_after_step(&self) -> bool {
        self.lanes.as_ref()[0].is_after_step
    }

    /// Whether dense output needs evaluations beyond those of a step.
    pub fn dense_needs_evaluations(&self) -> bool {
        self.method.dense_needs_evaluations()
    }

    /// The beginning of the last step of the only trajectory; its present state if it has taken none.
    pub fn before(&self) -> &Point<V, N> {
        if self.is_after_step() {
            &self.before
        } else {
            &self.now
        }
    }

    /// The accelerations of the only trajectory at the beginning of its last step.
    pub fn a_before(&self) -> &V {
        &self.k[0]
    }

    pub fn work(&self, lane: usize) -> Work {
        self.lanes.as_ref()[lane].control.work
    }

    pub fn last_step(&self) -> f64 {
        self.control().last_step
    }

    pub fn next_step(&self) -> f64 {
        self.control().step
    }

    /// Whether a trajectory is at its end.
    #[inline(always)]
    pub fn is_done(&self, lane: usize) -> bool {
        self.now.t.are_same(self.end).as_ref()[lane]
    }

    /// Stops a trajectory.
    pub fn stop(&mut self, lane: usize) {
        self.lanes.as_mut()[lane].is_running = false;
    }

    /// Sets another end for the only trajectory.
    pub fn set_end(&mut self, end: N) {
        self.end = end;
        let [to, from] = [end, self.now.t].map(|t| t.rounded().as_ref()[0]);
        let is_done = self.is_done(0);
        let lane = &mut self.lanes.as_mut()[0];
        lane.control.set_direction(to - from);
        lane.is_running = !is_done;
    }

    /// Evaluates the present accelerations of the only trajectory, at its start or after the inputs have changed.
    pub fn evaluate_now(&mut self, machine: &impl Accelerate<N, V>) -> Result<(), StepError> {
        let newest = self.newest_stage();
        let Self { now, k, .. } = self;
        let (mut failed, mut attempting) = (N::each(|_| None), N::each(|_| true));
        let at = (now.t, &now.q, &now.v);
        evaluate(machine, at, &mut k[newest], &mut attempting, &mut failed);
        let control = self.control_mut();
        control.work.evaluations += 1;
        control.begin_anew();
        failed.as_ref()[0].map_or(Ok(()), Err)
    }

    /// Chooses the length of the first step of the only trajectory, unless it was given.
    pub fn choose_first_step(&mut self, machine: &impl Accelerate<N, V>) {
        if self.control().step == 0.0 && !self.is_done(0) {
            let step = self.first_step(machine);
            self.control_mut().step = step;
        }
    }

    /// A length for the first step of the only trajectory.
    fn first_step(&mut self, machine: &impl Accelerate<N, V>) -> f64 {
        let left = (self.end - self.now.t).rounded().as_ref()[0];
        let Self {
            method,
            tolerance,
            longest,
            now,
            k,
            stage: (q, v),
            lanes,
            ..
        } = self;
        let bounds = [left, *longest];
        attempt::first_step((method, tolerance), now, k, [q, v], bounds, |at, a| {
            let (mut failed, mut attempting) = (N::each(|_| None), N::each(|_| true));
            evaluate(machine, at, a, &mut attempting, &mut failed);
            lanes.as_mut()[0].control.work.evaluations += 1;
            failed.as_ref()[0].is_none()
        })
    }

    /// One attempt of every trajectory that is not at its end. Everything that is done per trajectory is inlined too, since the caller may
    /// be compiled for wide registers.
    #[inline(always)]
    pub fn attempt<R: Scalar<Stored = N>>(
        &mut self,
        machine: &impl Accelerate<N, V>,
    ) -> N::Each<Outcome> {
        let mut outcomes = N::each(|_| Outcome::Idle);
        self.begin_steps();
        let (h, is_last) = self.choose_lengths(&mut outcomes);
        let mut failed = N::each(|_| None);
        let errors = self.try_steps::<R>((h, &is_last), machine, &mut failed);
        let h = h.rounded();
        // For all at once, whatever their outcome, and in a loop instead of a closure: in wide registers all cost as much as one.
        let mut growth = N::each(|lane| self.lanes.as_ref()[lane].control.error_before);
        let are_first = N::each(|lane| self.lanes.as_ref()[lane].control.is_first);
        let of_steps = errors.as_ref().iter().zip(are_first.as_ref());
        for (growth, (error, is_first)) in growth.as_mut().iter_mut().zip(of_steps) {
            *growth = control::growth(self.method, *error, *growth, *is_first);
        }
        for (lane, outcome) in outcomes.as_mut().iter_mut().enumerate() {
            if self.lanes.as_ref()[lane].is_running {
                let [h, error, growth] = [h, errors, growth].map(|each| each.as_ref()[lane]);
                *outcome = self.decide(lane, h, (error, growth), failed.as_ref()[lane]);
            }
        }
        outcomes
    }

    /// Makes the present states the beginnings of steps, except where the last step is attempted again.
    #[inline(always)]
    fn begin_steps(&mut self) {
        let lanes = self.lanes.as_mut();
        let begins = N::each(|lane| !lanes[lane].control.is_retry);
        let moves = N::each(|lane| begins.as_ref()[lane] && lanes[lane].is_after_step);
        for (lane, begins) in lanes.iter_mut().zip(begins.as_ref()) {
            lane.is_after_step &= !begins;
        }
        choose_point(&begins, &mut self.before, &self.now);
        let (first, rest) = self.k.split_at_mut(1);
        let newest = &rest[self.method.tableau.stages - 1];
        choose(&moves, &mut first[0], newest);
    }

    /// The lengths of the next steps, 0 for trajectories that take none, and whether they would be the last ones.
    #[inline(always)]
    fn choose_lengths(&mut self, outcomes: &mut N::Each<Outcome>) -> (N, N::Each<bool>) {
        let left = (self.end - self.before.t) - self.before.t_low;
        let mut lengths = N::each(|_| 0.0);
        let mut is_last = N::each(|_| false);
        let (t, lefts) = (self.before.t.rounded(), left.rounded());
        for (i, lane) in self.lanes.as_mut().iter_mut().enumerate() {
            if !lane.is_running {
                continue;
            }
            let (t, left) = (t.as_ref()[i], lefts.as_ref()[i]);
            let control = &mut lane.control;
            if !control.is_retry && control.is_too_small(control::shortest_step::<N>(t), left) {
                lane.is_running = false;
                outcomes.as_mut()[i] = Outcome::Failed(StepError::StepTooSmall {
                    coordinate: 0,
                    t,
                    step: control.last_step,
                });
                continue;
            }
            is_last.as_mut()[i] = control.is_last(left, self.longest);
            lengths.as_mut()[i] = control.step;
        }
        let h = left.where_true(&is_last, N::gather(lengths));
        for (lane, h) in self.lanes.as_mut().iter_mut().zip(h.rounded().as_ref()) {
            if lane.is_running {
                lane.control.last_step = *h;
            }
        }
        self.h = h;
        (h, is_last)
    }

    /// Attempts steps of lengths `h` from `before` to `now`; `now` stays at `before`
    /// where a step fails. Returns their errors relative to the tolerance.
    #[inline(always)]
    fn try_steps<R: Scalar<Stored = N>>(
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
            stage: (q, v),
            lanes,
            ..
        } = self;
        let lanes = lanes.as_mut();
        let (scheme, stages) = (&method.scheme, method.tableau.stages);
        let mut attempting = N::each(|lane| lanes[lane].is_running);
        let are_first = N::each(|lane| lanes[lane].control.is_first);
        let mut evaluations = N::each(|_| 0);
        let mut count = |evaluations: N::Each<usize>| {
            for (lane, evaluations) in lanes.iter_mut().zip(evaluations.as_ref()) {
                lane.control.work.evaluations += evaluations;
            }
        };

        let mut attempts = attempting.as_ref().contains(&true);
        for i in 1..stages {
            if attempts {
                let from = (&*before, h);
                let to = [&mut *q, &mut *v];
                let t = attempt::go_to_stage::<R, N, V>((method, i), from, k, to);
                evaluate_counted::<R, V>(
                    (machine, &mut evaluations),
                    (t, &*q, &*v),
                    &mut k[i],
                    &mut attempting,
                    failed,
                );
                attempts = attempting.as_ref().contains(&true);
            }
        }
        if !attempts {
            choose_point(&N::each(|_| true), now, before);
            count(evaluations);
            return N::each(|_| f64::INFINITY);
        }

        attempt::arrive::<R, N, V>(method, (before, h), k, now, (*end, is_last));
        if scheme.error_needs_end && attempting.as_ref().contains(&true) {
            select(&attempting, now, before);
            let at = (now.t, &now.q, &now.v);
            evaluate_counted::<R, V>(
                (machine, &mut evaluations),
                at,
                &mut k[stages],
                &mut attempting,
                failed,
            );
        }
        let ends = [&*before, &*now];
        let estimates = attempt::errors::<R, N, V>(method, h, ends, k, (tolerance, &are_first));
        let errors = judged(&estimates, now, &attempting, failed);
        let mut good = N::each(|lane| attempting.as_ref()[lane] && errors.as_ref()[lane] <= 1.0);
        if !scheme.error_needs_end && good.as_ref().contains(&true) {
            select(&good, now, before);
            let at = (now.t, &now.q, &now.v);
            evaluate_counted::<R, V>(
                (machine, &mut evaluations),
                at,
                &mut k[stages],
                &mut good,
                failed,
            );
        }
        select(&good, now, before);
        count(evaluations);
        errors
    }

    /// Decides about an attempt of a step with this error; after a good one the next may be longer by the factor `growth`.
    #[inline(always)]
    fn decide(
        &mut self,
        lane: usize,
        h: f64,
        (error, growth): (f64, f64),
        cause: Option<StepError>,
    ) -> Outcome {
        let is_done = self.is_done(lane);
        let Lane {
            is_running,
            is_after_step,
            control,
        } = &mut self.lanes.as_mut()[lane];
        let next = match cause {
            None if error <= 1.0 => {
                control.accept(h, error, growth);
                *is_after_step = true;
                *is_running = !is_done;
                return Outcome::Taken;
            }
            None => h * control::reduction(self.method, error, control.is_first),
            // A stage may have left the set of states in which the machine can be.
            Some(_) => 0.1 * h,
        };
        let t = self.before.t.rounded().as_ref()[lane];
        if control.reject(next, control::shortest_step::<N>(t)) {
            return Outcome::GivenUp;
        }
        *is_running = false;
        Outcome::Failed(cause.unwrap_or_else(|| {
            let (ends, of) = ([&self.before; 2], (&self.tolerance, lane));
            StepError::StepTooSmall {
                coordinate: attempt::worst(self.method, self.h, ends, &self.k, of),
                t,
                step: h,
            }
        }))
    }
}

impl<N: Real, V: Vector<N>> Track<N, V> {
    /// The motion of the only trajectory within its last step, from the ends of the step alone.
    pub fn hermite(&self, theta: N) -> (V, V) {
        let before = self.before();
        hermite(
            self.h,
            [&before.q, &self.now.q],
            [&before.v, &self.now.v],
            [self.a_before(), self.a()],
            theta,
        )
    }

    /// The dense output of the last step of the only trajectory.
    ///
    /// # Errors
    /// If a stage of it has no accelerations.
    pub fn interpolant(
        &mut self,
        machine: &impl Accelerate<N, V>,
    ) -> Result<Interpolant<V, N>, StepError> {
        let Self {
            method,
            now,
            before,
            k,
            h,
            lanes,
            ..
        } = self;
        let ends = Ends {
            start: before.time(),
            h: *h,
            q: [&before.q, &now.q],
            v: [&before.v, &now.v],
        };
        Interpolant::new(method, &ends, k, |t, q, v, a| {
            let (mut failed, mut attempting) = (N::each(|_| None), N::each(|_| true));
            evaluate(machine, (t, q, v), a, &mut attempting, &mut failed);
            lanes.as_mut()[0].control.work.evaluations += 1;
            failed.as_ref()[0].map_or(Ok(()), Err)
        })
    }
}

/// Evaluates the accelerations of the only trajectory, outside of kernels.
fn evaluate<N: StepNumber, V: Vector<N>>(
    machine: &impl Accelerate<N, V>,
    (t, q, v): (N, &V, &V),
    a: &mut V,
    attempting: &mut N::Each<bool>,
    failed: &mut N::Each<Option<StepError>>,
) {
    let none = machine.accelerate(t, q, v, a).err();
    reject(none, t, a, attempting, failed);
}

/// Ends the attempts of trajectories that have no accelerations, and sets these to 0, so that NaN does not disturb the other trajectories.
fn reject<N: StepNumber, V: Vector<N>>(
    none: Option<N::Each<Option<Singular>>>,
    t: N,
    a: &mut V,
    attempting: &mut N::Each<bool>,
    failed: &mut N::Each<Option<StepError>>,
) {
    let mut sum = N::NOTHING;
    for a in a.as_slice() {
        sum = sum + *a;
    }
    let mut fine = sum.are_finite();
    for (lane, fine) in fine.as_mut().iter_mut().enumerate() {
        let t = t.rounded().as_ref()[lane];
        let singular = none.and_then(|none| none.as_ref()[lane]);
        let error = match singular {
            Some(singular) => Some(StepError::Singular { singular, t }),
            None if *fine => None,
            None => not_finite(a, a, lane).map(|coordinate| StepError::NotFinite { coordinate, t }),
        };
        *fine = error.is_none();
        if error.is_some() && attempting.as_ref()[lane] {
            attempting.as_mut()[lane] = false;
            failed.as_mut()[lane] = error;
        }
    }
    for a in a.as_mut_slice() {
        *a = a.where_true(&fine, N::NOTHING);
    }
}

/// Evaluates the accelerations and counts the evaluations.
///
/// A function and not a closure, since a closure would not be compiled into its caller for wide registers.
#[inline(always)]
fn evaluate_counted<R, V>(
    (machine, evaluations): (&impl Accelerate<R::Stored, V>, &mut Each<R, usize>),
    at: (R::Stored, &V, &V),
    a: &mut V,
    attempting: &mut Each<R, bool>,
    failed: &mut Each<R, Option<StepError>>,
) where
    R: Scalar<Stored: StepNumber>,
    V: Vector<R::Stored>,
{
    for (evaluations, attempting) in evaluations.as_mut().iter_mut().zip(attempting.as_ref()) {
        *evaluations += usize::from(*attempting);
    }
    let none = machine.accelerate(at.0, at.1, at.2, a).err();
    if none.is_some() || !are_all_finite::<R>(a.as_slice()) {
        reject(none, at.0, a, attempting, failed);
    }
}

/// The errors of attempts with these estimates: infinite where the state has overflowed, so that the estimate means nothing and the step is rejected.
#[inline(always)]
fn judged<N: StepNumber, V: Vector<N>>(
    estimates: &N::Each<f64>,
    now: &Point<V, N>,
    attempting: &N::Each<bool>,
    failed: &mut N::Each<Option<StepError>>,
) -> N::Each<f64> {
    let are_numbers = attempt::are_finite(&now.q, &now.v);
    let errors = N::each(|lane| {
        let error = estimates.as_ref()[lane];
        if error.is_finite() && are_numbers.as_ref()[lane] {
            error
        } else {
            f64::INFINITY
        }
    });
    for (lane, failed) in failed.as_mut().iter_mut().enumerate() {
        let is_beyond = attempting.as_ref()[lane] && errors.as_ref()[lane] == f64::INFINITY;
        if is_beyond && let Some(coordinate) = not_finite(&now.q, &now.v, lane) {
            let t = now.t.rounded().as_ref()[lane];
            *failed = Some(StepError::NotFinite { coordinate, t });
        }
    }
    errors
}

/// One value for each trajectory in a register.
type Each<R, T> = <<R as Scalar>::Stored as StepNumber>::Each<T>;

/// Copies a vector in the trajectories for which `condition` holds.
#[inline(always)]
fn choose<N: StepNumber, V: Vector<N>>(condition: &N::Each<bool>, to: &mut V, from: &V) {
    for (to, from) in to.as_mut_slice().iter_mut().zip(from.as_slice()) {
        *to = from.where_true(condition, *to);
    }
}

/// Copies a state in the trajectories for which `condition` holds.
#[inline(always)]
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

/// Keeps a state in the trajectories for which `condition` holds, and replaces it by `otherwise` in all others.
#[inline(always)]
fn select<N: StepNumber, V: Vector<N>>(
    condition: &N::Each<bool>,
    state: &mut Point<V, N>,
    otherwise: &Point<V, N>,
) {
    let others = N::each(|lane| !condition.as_ref()[lane]);
    if others.as_ref().contains(&true) {
        choose_point(&others, state, otherwise);
    }
}
