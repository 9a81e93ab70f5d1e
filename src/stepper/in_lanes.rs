//! One attempt at the steps of several steppers at once, in vector lanes.
//!
//! Each stepper chooses the length of its step and decides about the attempt: only the stages in between are computed for all of them
//! together, by the same sums as in a single stepper. So each has the bits that it has alone. A lane in which something is exceptional
//! (accelerations without a value or an infinite error) is attempted again alone, which then gives the error.
//!
//! With constraints, each new point is projected alone, and its error is estimated there. While a unilateral contact is closed, which
//! other equations describe, a stepper attempts its steps alone.
//!
//! In steps by Taylor series, the expansions at their ends and the powers along them are computed together (`in_lanes/series.rs`).

mod series;

use std::vec::Vec;

use super::{StepLimits, Stepper};
use crate::attempt;
use crate::balance::Quadratures;
use crate::contact::UnilateralState;
use crate::inputs::InputLaw;
use crate::methods::{MAX_STAGES, Method, MethodKind};
use crate::scalar::{Kernel, Scalar};
use crate::stages::{Point, are_all_finite};
use crate::step_error::StepError;
use crate::step_number::StepNumber;
use crate::tolerance::Tolerance;
use crate::{System, Vector};
use lagrangian_native::{Lanes, Number};
use series::Expansions;

/// The number of lanes: as many as the widest registers have.
pub(crate) const WIDTH: usize = 8;

/// One number for each lane.
pub(crate) type Wide = Lanes<WIDTH>;

/// A bit for each lane, the lowest bit for the first.
pub(crate) type LaneMask = u32;

/// Evaluates the machines of all lanes.
pub(crate) trait Evaluate {
    /// Evaluates the accelerations; returns the lanes in which they have values.
    fn accelerations(&mut self, at: (Wide, &[Wide], &[Wide]), a: &mut [Wide]) -> LaneMask;

    /// Evaluates the power of the work on the machines and their losses, in W; returns the lanes in which these have values.
    fn powers(&mut self, at: (Wide, &[Wide], &[Wide]), a: &[Wide]) -> ([Wide; 2], LaneMask);

    /// Expands the motions through states, whose times are sums of two numbers, as [`System::series`] does; returns the lanes in which they have
    /// coefficients. By default none: each motion is expanded alone.
    fn series(
        &mut self,
        at: ([Wide; 2], &[Wide], &[Wide]),
        coefficients: &mut [Vec<Wide>],
    ) -> LaneMask {
        let _ = (at, coefficients);
        0
    }
}

/// A step that is being attempted: the length of the attempt, whether it would be the last step, and the limits on its length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepAttempt {
    h: f64,
    last: bool,
    limits: StepLimits,
}

/// The data of the steps of all lanes.
pub(crate) struct Attempts {
    method: &'static Method,
    tolerance: Tolerance<Vec<Wide>>,
    before: Point<Vec<Wide>, Wide>,
    now: Point<Vec<Wide>, Wide>,
    k: [Vec<Wide>; MAX_STAGES],
    stage: (Vec<Wide>, Vec<Wide>),
    /// Work and losses at each stage.
    powers: Option<[[Wide; 2]; MAX_STAGES]>,
    h: Wide,
    end: Wide,
    is_last: [bool; WIDTH],
    are_first: [bool; WIDTH],
    errors: [f64; WIDTH],
    /// Whether the machines have constraints: then an attempt in lanes ends at the new point, which each stepper projects.
    have_constraints: bool,
    /// The lanes in which nothing exceptional happened in the last attempt.
    succeeded: LaneMask,
    /// The ends of steps by series, if the method is that.
    series: Option<Expansions>,
}

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// Whether its steps consist of explicit stages only, or are by series, with constant inputs.
    pub(crate) fn may_run_in_lanes(&self) -> bool {
        let is_explicit = match self.method.kind {
            MethodKind::RungeKutta => self.implicit.is_none() && self.taylor.is_none(),
            MethodKind::Series => self.taylor.is_some(),
            _ => false,
        };
        is_explicit && self.model.system.get().contacts().len() == 0 && self.model.law.is_constant()
    }

    /// Whether its next attempt may be made in lanes: not while constraints are dependent or a unilateral contact is closed, which requires
    /// other equations, and not up to where contacts change, where a motion by series is not expanded.
    pub(crate) fn may_try_in_lanes(&self) -> bool {
        let constraints = self.model.constraints.as_ref();
        let touching = self.model.touching.as_ref();
        touching.is_none_or(UnilateralState::leaves_accelerations)
            && constraints.is_none_or(|constraints| !constraints.redundant && !constraints.at_fork)
            && !(self.ends_at_change && self.taylor.is_some())
    }

    /// Begins a step and its first attempt.
    pub(crate) fn begin_in_lanes(&mut self) -> Result<StepAttempt, StepError> {
        if self.changed {
            self.refresh_acceleration()?;
        }
        if self.taylor.is_some() {
            self.choose_length()?;
        }
        let limits = self.begin_attempts()?;
        Ok(self.next_attempt(limits))
    }

    fn next_attempt(&mut self, limits: StepLimits) -> StepAttempt {
        let (h, last) = self.choose(limits);
        StepAttempt { h, last, limits }
    }

    /// Ends an attempt; returns the next one, or `None` if the step was taken.
    pub(crate) fn end_in_lanes(
        &mut self,
        lane: usize,
        of: StepAttempt,
        attempts: &mut Attempts,
    ) -> Result<Option<StepAttempt>, StepError> {
        if let Some(series) = &mut attempts.series {
            let has_coefficients = attempts.succeeded >> lane & 1 == 1;
            let attempted = series.end(lane, self, (of.h, has_coefficients));
            return self.decide_on(of, attempted);
        }
        let attempted = match attempts.take(lane, self) {
            Some(_) if attempts.have_constraints => self.finish(of.h),
            Some(error) => Ok(error),
            None => self.attempt(of.h, of.last),
        };
        self.decide_on(of, attempted)
    }

    /// Makes an attempt alone and ends it like [`end_in_lanes`](Self::end_in_lanes).
    pub(crate) fn end_alone(&mut self, of: StepAttempt) -> Result<Option<StepAttempt>, StepError> {
        let attempted = if self.taylor.is_some() {
            self.attempt_in_series(of.h, of.last)
        } else {
            self.attempt(of.h, of.last)
        };
        self.decide_on(of, attempted)
    }

    fn decide_on(
        &mut self,
        of: StepAttempt,
        attempted: Result<f64, StepError>,
    ) -> Result<Option<StepAttempt>, StepError> {
        let is_taken = self.decide((of.h, of.limits), attempted)?;
        Ok((!is_taken).then(|| self.next_attempt(of.limits)))
    }

    /// Takes the powers of a stage that were evaluated in lanes. Contacts, which are open then, have none.
    fn take_powers(&mut self, stage: usize, [work, lost]: [f64; 2]) {
        self.quadratures.take(stage, work, lost);
        if self.model.touching.is_some() {
            // As alone: -0 becomes 0, and earlier shares of the contacts end.
            self.quadratures.add(stage, 0.0, 0.0);
            self.quadratures.set_contact_shares(stage, &[]);
        }
    }
}

impl Attempts {
    /// For steppers that are compatible with this one.
    pub fn new<S: System, L: InputLaw<S>, A: Quadratures<S>>(of: &Stepper<'_, S, L, A>) -> Self {
        let spread = |numbers: &S::Vector| -> Vec<Wide> {
            let numbers = numbers.as_slice().iter();
            numbers.map(|number| Lanes::splat(*number)).collect()
        };
        let (q, v) = (spread(&of.now.q), spread(&of.now.v));
        let now = Point::new(Lanes::splat(of.now.t), q, v);
        let zeros = now.q.zeros_like();
        let has_powers = of.quadratures.integrals().is_some();
        Self {
            method: of.method,
            tolerance: Tolerance {
                relative: of.tolerance.relative,
                absolute: spread(&of.tolerance.absolute),
            },
            before: now.clone(),
            now,
            k: zeros.several_zeros_like(),
            stage: (zeros.clone(), zeros),
            powers: has_powers.then_some([[Lanes::splat(0.0); 2]; MAX_STAGES]),
            h: Lanes::splat(0.0),
            end: Lanes::splat(of.now.t),
            is_last: [false; WIDTH],
            are_first: [true; WIDTH],
            errors: [0.0; WIDTH],
            have_constraints: has_constraints(of),
            succeeded: 0,
            series: Expansions::new(of),
        }
    }

    /// Whether a stepper is compatible with the one that this was made for: the same method and the same relative tolerance.
    pub fn is_compatible_with<S: System, L: InputLaw<S>, A: Quadratures<S>>(
        &self,
        of: &Stepper<'_, S, L, A>,
    ) -> bool {
        std::ptr::eq(self.method, of.method)
            && self.tolerance.relative.to_bits() == of.tolerance.relative.to_bits()
            && self.before.q.len() == of.now.q.as_slice().len()
            && self.powers.is_some() == of.quadratures.integrals().is_some()
            && self.have_constraints == has_constraints(of)
            && match &self.series {
                Some(series) => series.are_compatible_with(of),
                None => true,
            }
    }

    /// Puts the beginning of a step and the length of its attempt into a lane; a step by series goes to its end.
    pub fn put<S: System, L: InputLaw<S>, A: Quadratures<S>>(
        &mut self,
        lane: usize,
        of: &mut Stepper<'_, S, L, A>,
        next: StepAttempt,
    ) {
        if let Some(series) = &mut self.series {
            return series.put(lane, of, (next.h, next.last));
        }
        let to = &mut self.before;
        (to.t[lane], to.t_low[lane]) = (of.before.t, of.before.t_low);
        put(&mut to.q, lane, &of.before.q);
        put(&mut to.q_low, lane, &of.before.q_low);
        put(&mut to.v, lane, &of.before.v);
        put(&mut to.v_low, lane, &of.before.v_low);
        put(&mut self.k[0], lane, &of.k[0]);
        put(&mut self.tolerance.absolute, lane, &of.tolerance.absolute);
        (self.h[lane], self.end[lane]) = (next.h, of.end);
        self.is_last[lane] = next.last;
        self.are_first[lane] = of.control.is_first;
    }

    /// Leaves the next attempt of every step to its own stepper.
    pub fn skip(&mut self) {
        self.succeeded = 0;
    }

    /// Attempts the steps of these lanes. The contents of the others have no effect.
    pub fn attempt(&mut self, which: LaneMask, machines: &mut impl Evaluate) {
        if let Some(series) = &mut self.series {
            self.succeeded = series.expand(which, machines);
            return;
        }
        self.succeeded = which;
        <Wide as Number>::run(Attempt(self, machines));
    }

    /// Passes the result of an attempt to its stepper, and returns the error of the step relative to the tolerance, which is meaningless with
    /// constraints. `None` if the step has to be attempted alone.
    fn take<S: System, L: InputLaw<S>, A: Quadratures<S>>(
        &self,
        lane: usize,
        to: &mut Stepper<'_, S, L, A>,
    ) -> Option<f64> {
        if self.succeeded >> lane & 1 == 0 {
            return None;
        }
        let stages = self.method.tableau.stages;
        let error = self.errors[lane];
        let at_end = !self.have_constraints && (self.method.scheme.error_needs_end || error <= 1.0);
        let known = if at_end { stages + 1 } else { stages };
        for (to, from) in to.k.iter_mut().zip(&self.k).take(known).skip(1) {
            take(to, lane, from);
        }
        let now = &mut to.now;
        (now.t, now.t_low) = (self.now.t[lane], self.now.t_low[lane]);
        take(&mut now.q, lane, &self.now.q);
        take(&mut now.q_low, lane, &self.now.q_low);
        take(&mut now.v, lane, &self.now.v);
        take(&mut now.v_low, lane, &self.now.v_low);
        take(&mut to.stage.0, lane, &self.stage.0);
        take(&mut to.stage.1, lane, &self.stage.1);
        if let Some(powers) = &self.powers {
            for (stage, [work, lost]) in powers.iter().enumerate().take(known).skip(1) {
                to.take_powers(stage, [work[lane], lost[lane]]);
            }
        }
        to.control.work.evaluations += known - 1;
        Some(error)
    }

    #[inline(always)]
    fn attempt_in_lanes<R: Scalar<Stored = Wide>>(&mut self, machines: &mut impl Evaluate) {
        let Self {
            method,
            tolerance,
            before,
            now,
            k,
            stage: (q, v),
            powers,
            h,
            end,
            is_last,
            are_first,
            errors,
            have_constraints,
            succeeded,
            series: _,
        } = self;
        let stages = method.tableau.stages;
        let mut powers = powers.as_mut();
        for i in 1..stages {
            let from = (&*before, *h);
            let to = [&mut *q, &mut *v];
            let t = attempt::go_to_stage::<R, _, _>((method, i), from, k, to);
            *succeeded &=
                evaluate_stage::<R>((machines, powers.as_deref_mut()), i, (t, q, v), &mut k[i]);
            if *succeeded == 0 {
                return;
            }
        }
        attempt::arrive::<R, _, _>(method, (before, *h), k, now, (*end, is_last));
        if *have_constraints {
            return;
        }
        if method.scheme.error_needs_end {
            let at = (now.t, &*now.q, &*now.v);
            *succeeded &= evaluate_stage::<R>(
                (machines, powers.as_deref_mut()),
                stages,
                at,
                &mut k[stages],
            );
        }
        let of = (&*tolerance, &*are_first);
        *errors = attempt::errors::<R, _, _>(method, *h, [before, now], k, of);
        *succeeded &= bits(&attempt::are_finite(&now.q, &now.v));
        let mut good = 0;
        for (lane, error) in errors.iter().enumerate() {
            if !error.is_finite() {
                *succeeded &= !(1 << lane);
            }
            good |= LaneMask::from(*error <= 1.0) << lane;
        }
        good &= *succeeded;
        if !method.scheme.error_needs_end && good != 0 {
            let at = (now.t, &*now.q, &*now.v);
            let fine = evaluate_stage::<R>((machines, powers), stages, at, &mut k[stages]);
            *succeeded &= fine | !good;
        }
    }
}

/// Whether a machine has constraints.
fn has_constraints<S: System, L, A>(stepper: &Stepper<'_, S, L, A>) -> bool {
    stepper.model.system.get().constraints().len() != 0
}

/// Evaluates the accelerations of a stage, and the powers if they are kept; returns the lanes in which they have values.
///
/// A function and not a closure, since a closure would not be compiled into its caller for wide registers.
#[inline(always)]
fn evaluate_stage<R: Scalar<Stored = Wide>>(
    (machines, powers): (&mut impl Evaluate, Option<&mut [[Wide; 2]; MAX_STAGES]>),
    stage: usize,
    at: (Wide, &[Wide], &[Wide]),
    a: &mut [Wide],
) -> LaneMask {
    let mut fine = machines.accelerations(at, a);
    fine &= finite_lanes::<R>(a);
    if let Some(powers) = powers {
        let (of_stage, known) = machines.powers(at, a);
        powers[stage] = of_stage;
        fine &= known;
    }
    fine
}

/// The lanes in which all of these numbers, or at least their sums, are finite.
#[inline(always)]
fn finite_lanes<R: Scalar<Stored = Wide>>(a: &[Wide]) -> LaneMask {
    if are_all_finite::<R>(a) {
        return LaneMask::MAX;
    }
    let mut sum = Wide::NOTHING;
    for a in a {
        sum = sum + *a;
    }
    bits(&sum.are_finite())
}

/// One attempt of every lane, in the widest registers available.
struct Attempt<'a, E>(&'a mut Attempts, &'a mut E);

impl<E: Evaluate> Kernel<Wide> for Attempt<'_, E> {
    type Output = ();

    #[inline(always)]
    fn run<N: Scalar<Stored = Wide>>(self) {
        self.0.attempt_in_lanes::<N>(self.1);
    }
}

#[inline(always)]
fn bits(of: &[bool; WIDTH]) -> LaneMask {
    let mut bits = 0;
    for (lane, is) in of.iter().enumerate() {
        bits |= LaneMask::from(*is) << lane;
    }
    bits
}

#[inline(always)]
fn put(rows: &mut [Wide], lane: usize, vector: &impl Vector) {
    for (row, number) in rows.iter_mut().zip(vector.as_slice()) {
        row[lane] = *number;
    }
}

#[inline(always)]
fn take(vector: &mut impl Vector, lane: usize, rows: &[Wide]) {
    for (number, row) in vector.as_mut_slice().iter_mut().zip(rows) {
        *number = row[lane];
    }
}
