//! Tries of a step: how long it may be, the new point with its error, and whether the step is taken.

use super::kernels::Attempt;
#[cfg(feature = "std")]
use super::kernels::Finish;
use super::{StepLimits, Stepper, Stiffness};
use crate::attempt::{self, not_finite};
use crate::balance::Quadratures;
use crate::constraints::Constraints;
use crate::control::{self, Control};
use crate::inputs::InputLaw;
use crate::math::sqrt;
use crate::scalar::Scalar;
use crate::stages::{in_blocks, weigh};
use crate::step_error::StepError;
use crate::{Number, System, Vector};

/// When constraints become dependent, errors across them up to this, relative and absolute, are round-off: 10⁻¹⁶ in a constraint becomes
/// 10⁻⁵ in the accelerations of a stage if the weakest row has 3·10⁻⁴ of its length left, and a hundredth of that in the result of a step.
const ROUNDOFF_ACROSS: f64 = 1e-7;

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// Prepares the attempts at a step.
    #[inline(always)]
    pub(super) fn begin_attempts(&mut self) -> Result<StepLimits, StepError> {
        if self.control.work.steps == 0 && self.control.step == 0.0 {
            self.control.step = self.first_step();
        }
        let shortest = control::shortest_step::<f64>(self.now.t);
        let distance_to_end = (self.end - self.now.t) - self.now.t_low;
        if self.control.is_too_small(shortest, distance_to_end) {
            return Err(self.too_small());
        }
        self.begin();
        self.control.is_retry = false;
        Ok(StepLimits {
            shortest,
            distance_to_end,
        })
    }

    /// The length of the next attempt, and whether it would be the last step.
    #[inline(always)]
    pub(super) fn choose(&mut self, limits: StepLimits) -> (f64, bool) {
        let last = self.control.is_last(limits.distance_to_end, self.longest);
        let h = if last {
            limits.distance_to_end
        } else {
            self.control.step
        };
        self.control.last_step = h;
        (h, last)
    }

    /// Decides about an attempt of length `h`: returns whether the step is taken; otherwise another attempt follows.
    #[inline(always)]
    pub(super) fn decide(
        &mut self,
        (h, limits): (f64, StepLimits),
        tried: Result<f64, StepError>,
    ) -> Result<bool, StepError> {
        let (next, cause) = match tried {
            Ok(error) if error <= 1.0 => {
                let factor = self.growth(h, error);
                self.control.accept(h, error, factor);
                self.accept(h);
                return Ok(true);
            }
            _ if self.may_have_met_fork(h, false) => {
                // Try once more, with the dependence of the constraints taken into account.
                self.control.work.rejected += 1;
                return Ok(false);
            }
            Ok(error) => (h * self.reduction(error), None),
            // A stage may have left the set of states in which the machine can be.
            Err(cause) => (0.1 * h, Some(cause)),
        };
        if self.control.reject(next, limits.shortest) {
            return Ok(false);
        }
        if self.may_have_met_fork(h, true) {
            self.control.step = h;
            return Ok(false);
        }
        let error = cause.unwrap_or_else(|| self.too_small());
        // The present state is the end of the last good step, not the end of this attempt.
        self.now.copy_from(&self.before);
        Err(error)
    }

    /// Makes the present state the beginning of a step.
    pub(super) fn begin(&mut self) {
        self.k.swap(0, self.newest);
        self.newest = 0;
        self.before.copy_from(&self.now);
        if S::MAY_SLIDE
            && let Some(contacts) = &mut self.model.contacts
        {
            let (system, now) = (self.model.system.get(), &self.before);
            contacts.record_headings(system, now.t, &now.q, &now.v);
        }
        #[cfg(feature = "std")]
        if S::MAY_COLLIDE {
            self.model.begin_contacts(&self.before);
        }
        #[cfg(feature = "std")]
        if let Some(taylor) = &mut self.taylor {
            taylor.begin();
        }
    }

    /// Tries a step of length `h` from `before` to `now`. Returns its error relative to the tolerance.
    pub(super) fn attempt(&mut self, h: f64, last: bool) -> Result<f64, StepError> {
        let stepper = self;
        f64::run(Attempt { stepper, h, last })
    }

    /// Completes an attempt whose stages are done and whose new point is in `now`: projects it onto the constraints and returns the error
    /// relative to the tolerance.
    #[cfg(feature = "std")]
    pub(super) fn finish(&mut self, h: f64) -> Result<f64, StepError> {
        let stepper = self;
        f64::run(Finish { stepper, h })
    }

    /// [`attempt`](Self::attempt) within a kernel.
    #[inline(always)]
    pub(super) fn attempt_within<R: Scalar<Stored = f64>>(
        &mut self,
        h: f64,
        last: bool,
    ) -> Result<f64, StepError> {
        let Self {
            method,
            model,
            quadratures,
            before,
            now,
            k,
            stage,
            control: Control { work, .. },
            ..
        } = self;
        let stages = method.tableau.stages;
        let (q, v) = (&mut stage.0, &mut stage.1);
        for i in 1..stages {
            let from = (&*before, h);
            let to = [&mut *q, &mut *v];
            let t = attempt::go_to_stage::<R, _, _>((method, i), from, k, to);
            model.accelerations(t, q, v, &mut k[i], work)?;
            model.take_rates(quadratures, i, (t, q, v, &k[i]));
        }
        attempt::arrive::<R, _, _>(method, (before, h), k, now, (self.end, &[last]));
        self.finish_within::<R>(h)
    }

    /// The part of an attempt after its stages, within a kernel: projects the new point onto the constraints and estimates the error.
    #[inline(always)]
    pub(super) fn finish_within<R: Scalar<Stored = f64>>(
        &mut self,
        h: f64,
    ) -> Result<f64, StepError> {
        let Self {
            method,
            model,
            quadratures,
            now,
            k,
            control: Control { work, .. },
            ..
        } = self;
        let stages = method.tableau.stages;
        let mut moved = false;
        if method.scheme.error_needs_end {
            moved = model.project(now)?;
            model.end(now, quadratures, stages, k, work)?;
        }
        let mut error = self.error_within::<R>(h);
        // If accelerations do not reflect it, a state that overflowed may have an error estimate of zero.
        let [is_finite] = attempt::are_finite(&self.now.q, &self.now.v);
        if !is_finite {
            error = f64::INFINITY;
        }
        if moved {
            error = error.max(self.error_of_move());
        }
        let Self {
            method,
            model,
            quadratures,
            now,
            k,
            control: Control { work, .. },
            ..
        } = self;
        if !error.is_finite() {
            // Either the error is infinite, or the state itself has overflowed.
            return match not_finite(&now.q, &now.v, 0) {
                Some(coordinate) => Err(StepError::NotFinite {
                    coordinate,
                    t: now.t,
                }),
                None => Ok(f64::INFINITY),
            };
        }
        if error <= 1.0 && !method.scheme.error_needs_end {
            moved = model.project(now)?;
            model.end(now, quadratures, stages, k, work)?;
            if moved {
                error = error.max(self.error_of_move());
            }
        }
        Ok(error)
    }

    /// Whether the step just tried may have failed because constraints become dependent on the way, which was not known before.
    /// `at_last` says that no shorter step is possible.
    fn may_have_met_fork(&mut self, h: f64, at_last: bool) -> bool {
        let Self {
            model,
            before,
            stage,
            ..
        } = self;
        #[cfg(feature = "std")]
        if model.touching.is_some() {
            return false;
        }
        if !S::MAY_BE_CONSTRAINED {
            return false;
        }
        let Some(constraints) = &mut model.constraints else {
            return false;
        };
        if constraints.at_fork {
            return false;
        }
        let ahead = &mut stage.0;
        let holds = [0.0, 0.5, 1.0].map(|theta| {
            ahead.clone_from(&before.q);
            for (q, v) in ahead.as_mut_slice().iter_mut().zip(before.v.as_slice()) {
                *q += theta * h * v;
            }
            constraints.strength(model.system.get(), before.t + theta * h, ahead)
        });
        constraints.notice_fork(holds, at_last)
    }

    /// Accepts the step just tried.
    pub(super) fn accept(&mut self, h: f64) {
        let stages = self.method.tableau.stages;
        self.newest = stages;
        #[cfg(feature = "std")]
        if let Some(taylor) = &mut self.taylor {
            taylor.accept();
            // If the machine does not move, or the coefficients are not finite, the series gives no length.
            let length = taylor.length(&self.tolerance);
            self.control.step = if length.is_finite() { length } else { h.abs() }.copysign(h);
        }
        self.model.accept(&self.now);
        self.quadratures.advance(h, self.method.tableau.a[stages]);
        if let Some(stability) = self.method.tableau.stability {
            let steps = self.control.work.steps;
            let due = steps.is_multiple_of(self.between_tests);
            if due || self.stiffness.signs > 0 {
                let stiff = self.stiffness_of_step(h) > stability;
                self.stiffness.take(stiff, h.abs(), self.before.t);
            }
        }
    }

    /// The error of the step just tried relative to the tolerance, as root mean square over coordinates and rates.
    #[inline(always)]
    fn error_within<R: Scalar<Stored = f64>>(&self, h: f64) -> f64 {
        if (S::MAY_BE_CONSTRAINED || S::MAY_COLLIDE)
            && let Some(constraints) = &self.model.constraints
            && constraints.at_fork
        {
            return self.error_along(constraints, h);
        }
        let ends = [&self.before, &self.now];
        let of = (&self.tolerance, &[self.control.is_first]);
        let [error] = attempt::errors::<R, _, _>(self.method, h, ends, &self.k, of);
        error
    }

    /// The error of the step just tried when constraints are about to become dependent. The projection removes the part across the
    /// constraints, so of that part only the excess over round-off counts.
    fn error_along(&self, constraints: &Constraints<S::Vector>, h: f64) -> f64 {
        let scheme = &self.method.scheme;
        let mut sums = [0.0, 0.0];
        let coarse = self.method.tableau.coarse_error.is_some();
        let rows = [Some(&scheme.error), coarse.then_some(&scheme.coarse_error)];
        for (sum, row) in sums.iter_mut().zip(rows) {
            let Some(row) = row else {
                continue;
            };
            let mut errors = [self.now.q.zeros_like(), self.now.q.zeros_like()];
            in_blocks!(self.now.q.as_slice().len(), |start, B| {
                let [position, velocity] = weigh::<B, f64, _>(row, &self.k, start);
                for i in 0..B {
                    errors[0].as_mut_slice()[start + i] = h * h * position[i];
                    errors[1].as_mut_slice()[start + i] = h * velocity[i];
                }
            });
            let states = [[&self.before.q, &self.now.q], [&self.before.v, &self.now.v]];
            for (error, [before, now]) in errors.iter().zip(states) {
                let (t, q) = (self.now.t, &self.now.q);
                let mut along = error.clone();
                if constraints
                    .keep_along(self.model.system.get(), t, q, &mut along)
                    .is_err()
                {
                    along.clone_from(error);
                }
                for (i, along) in along.as_slice().iter().enumerate() {
                    let size = before.as_slice()[i].abs().max(now.as_slice()[i].abs());
                    let tolerable = self.tolerable(i, size);
                    let across = error.as_slice()[i] - along;
                    let loose = tolerable.max(ROUNDOFF_ACROSS * (1.0 + size));
                    *sum += (along / tolerable) * (along / tolerable);
                    *sum += (across / loose) * (across / loose);
                }
            }
        }
        let ([fine, coarse], is_first) = (sums, self.control.is_first);
        control::error_norm(fine, coarse, is_first, 2 * self.now.q.as_slice().len())
    }

    /// The distance by which the step just tried was moved onto the constraints, in the norm of its [`error`](Self::error), without the
    /// share that its beginning contributed.
    pub(super) fn error_of_move(&self) -> f64 {
        let Some(constraints) = &self.model.constraints else {
            return 0.0;
        };
        let mut sum = 0.0;
        let levels = constraints.moved.iter().zip(constraints.own_share);
        for ((moved, share), y) in levels.zip([&self.now.q, &self.now.v]) {
            let by = moved.as_slice().iter().zip(y.as_slice());
            for (i, (moved, y)) in by.enumerate() {
                let mut tolerable = self.tolerable(i, y.abs());
                if constraints.at_fork {
                    tolerable = tolerable.max(ROUNDOFF_ACROSS * (1.0 + y.abs()));
                }
                let error = share * moved / tolerable;
                sum += error * error;
            }
        }
        sqrt(sum / (2 * self.now.q.as_slice().len()) as f64)
    }

    /// The factor by which the next step may be longer after this good one of length `h`.
    #[inline(always)]
    fn growth(&mut self, _h: f64, error: f64) -> f64 {
        let is_first = self.control.is_first;
        #[cfg(feature = "std")]
        {
            if self.taylor.is_some() {
                // The series at the end of the step gives the length of the next one.
                return 1.0;
            }
            if let Some(implicit) = &mut self.implicit {
                let exponent = control::error_exponent(self.method, is_first);
                return implicit.accept(_h, error, exponent, self.method.tableau.step_change);
            }
        }
        control::growth(self.method, error, self.control.error_before, is_first)
    }

    /// The factor for the length of the next attempt after this one was rejected.
    fn reduction(&mut self, error: f64) -> f64 {
        let is_first = self.control.is_first;
        #[cfg(feature = "std")]
        if let Some(implicit) = &mut self.implicit {
            let (shrink, _) = self.method.tableau.step_change;
            let exponent = control::error_exponent(self.method, is_first);
            return implicit.reject(error, exponent, shrink);
        }
        control::reduction(self.method, error, is_first)
    }

    /// Chooses the length of the first step.
    pub(super) fn first_step(&mut self) -> f64 {
        let Self {
            method,
            tolerance,
            model,
            now,
            k,
            stage: (q, v),
            control: Control { work, .. },
            ..
        } = self;
        let bounds = [self.end - now.t, self.longest];
        attempt::first_step(
            (method, tolerance),
            now,
            k,
            [q, v],
            bounds,
            |(t, q, v), a| model.accelerations(t, q, v, a, work).is_ok(),
        )
    }

    /// Estimates `h |λ|` of the largest eigenvalue from the two evaluations at the end of the step.
    fn stiffness_of_step(&self, h: f64) -> f64 {
        let stages = self.method.tableau.stages;
        let (a, a_stage) = (self.k[stages].as_slice(), self.k[stages - 1].as_slice());
        let (q, v) = (self.now.q.as_slice(), self.now.v.as_slice());
        let (q_stage, v_stage) = (self.stage.0.as_slice(), self.stage.1.as_slice());
        let (mut rates, mut states) = (0.0, 0.0);
        for i in 0..a.len() {
            let (dq, dv, da) = (q[i] - q_stage[i], v[i] - v_stage[i], a[i] - a_stage[i]);
            rates += dv * dv + da * da;
            states += dq * dq + dv * dv;
        }
        // Two equal states give no estimate.
        if states == 0.0 {
            0.0
        } else {
            h.abs() * sqrt(rates / states)
        }
    }

    /// The error for a step that was still too long and cannot be shorter.
    pub(super) fn too_small(&self) -> StepError {
        let ends = [&self.before, &self.now];
        let h = self.control.last_step;
        StepError::StepTooSmall {
            coordinate: attempt::worst(self.method, h, ends, &self.k, (&self.tolerance, 0)),
            t: self.before.t,
            step: h,
        }
    }
}

impl Stiffness {
    /// Stiffness is reported after fifteen positive tests without six negative ones in a row among them, as in DOP853, if steps are
    /// not halved meanwhile. Towards an instant where accelerations are singular, such as that at which friction in two directions
    /// brings a body to rest, the step shrinks as fast as the accelerations change, and `h |λ|` stays as it is; but such steps are few,
    /// however close they come, and an implicit method needs as many.
    fn take(&mut self, stiff: bool, h: f64, t: f64) {
        self.is_tested = true;
        if stiff {
            self.none_since = 0;
            if h < 0.5 * self.longest {
                (self.signs, self.longest) = (0, 0.0);
            }
            self.longest = self.longest.max(h);
            self.signs += 1;
            if self.signs == 15 && self.since.is_none() {
                self.since = Some(t);
            }
        } else {
            self.none_since += 1;
            if self.none_since == 6 {
                (self.signs, self.longest) = (0, 0.0);
            }
        }
    }
}
