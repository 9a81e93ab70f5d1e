//! Steps by the Taylor series of the motion.

use super::{Model, Stepper};
use crate::attempt::{are_finite, not_finite};
use crate::balance::Quadratures;
use crate::constraints::Constraints;
use crate::contact::UnilateralState;
use crate::control::{Control, shortest_step};
use crate::math::larger;
use crate::stages::Point;
use crate::taylor::{
    ClosedContacts, GREATEST_DEFECT, ROUNDING_UNITS, ROUNDINGS, SHORTEST_STEPS, bound, defect,
    size_of_rate,
};
use crate::tolerance::Tolerance;
use crate::{InputLaw, StepError, System, Vector};

/// A step by series of a machine with unilateral contacts is at most so many times as long as the one before it.
pub(super) const GROWTH_IN_FLIGHT: f64 = 2.0;

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// Expands the motion through the present state, for the first step or after something that it depends on has changed.
    pub(super) fn expand(&mut self) -> Result<(), StepError> {
        let Self {
            model, now, taylor, ..
        } = self;
        let Some(taylor) = taylor else { return Ok(()) };
        model.set_inputs(now.t, &now.q, &now.v);
        taylor.expand(model.in_series(), now, &model.inputs, false)
    }

    /// The coefficients of the motion in the last step, of coordinates, in powers of the time since its beginning. `None` if
    /// the motion in a step is not such a polynomial.
    pub(crate) fn coefficients(&self) -> Option<&[S::Vector]> {
        match &self.impulses {
            Some(impulses) => Some(impulses.of_step()),
            None => self.taylor.as_ref().map(|taylor| taylor.of_step()),
        }
    }

    /// The longest next step of a machine with unilateral contacts. Where few forces act, the error of a series allows any length, but gaps are looked at only so often in a
    /// step; so steps grow no faster than by a factor, more slowly than those of other methods may.
    fn longest_in_flight(&mut self) -> f64 {
        if self.model.touching.is_none() {
            return f64::INFINITY;
        }
        let Control {
            is_first,
            step,
            last_step,
            ..
        } = self.control;
        if !is_first {
            GROWTH_IN_FLIGHT * last_step.abs()
        } else if self.longest_first.is_infinite() && step == 0.0 {
            GROWTH_IN_FLIGHT * self.first_step().abs()
        } else {
            self.longest_first
        }
    }

    /// The length of the last step as a part of that which its tolerance allowed.
    pub(crate) fn part_of_tolerable(&self) -> f64 {
        (self.control.last_step / self.tolerable).abs().min(1.0)
    }

    /// Chooses the length of the next step. The first step does not exceed a length that was set.
    pub(super) fn choose_length(&mut self) -> Result<(), StepError> {
        let longest_in_flight = self.longest_in_flight();
        let Self {
            now,
            taylor,
            tolerance,
            control: Control { step, work, .. },
            end,
            longest,
            tolerable,
            ..
        } = self;
        let Some(taylor) = taylor else { return Ok(()) };
        let left = *end - now.t;
        *tolerable = taylor.length(tolerance);
        let mut length = tolerable.min(*longest);
        if length.is_nan() {
            let worst = not_finite_among(taylor.present_coefficients());
            return Err(StepError::NotFinite {
                coordinate: worst,
                t: now.t,
            });
        }
        if work.steps == 0 && *step != 0.0 {
            length = length.min(step.abs());
        }
        length = length.min(longest_in_flight);
        // If the machine does not move, a step is as long as the run.
        *step = length.min(left.abs()).copysign(left);
        Ok(())
    }

    /// Takes a step of length `h` from `before` to `now`. It needs no error estimate, since its length was chosen so that the
    /// error is tolerable. Its error is infinite if the motion is not the series at the end.
    pub(super) fn attempt_in_series(&mut self, h: f64, last: bool) -> Result<f64, StepError> {
        self.advance_in_series(h, last)?;
        self.take_powers_along_series(h);
        if last && self.ends_at_change {
            self.end_at_change(h);
            return Ok(0.0);
        }
        self.expand_ahead()?;
        let error = self.compare_in_series(h)?;
        if error == 0.0 {
            self.take_powers_at_end();
        }
        Ok(error)
    }

    /// Ends a step of length `h` where contacts change. The motion does not go on along its series, so it is not expanded there; and that the series is the motion
    /// was seen at the end of the longer step in which the change was found.
    fn end_at_change(&mut self, h: f64) {
        let Self {
            method, k, taylor, ..
        } = self;
        if let Some(taylor) = taylor {
            let accelerations = &mut k[method.tableau.stages];
            crate::taylor::accelerations(taylor.of_step(), h, accelerations);
        }
        self.take_powers_at_end();
    }

    /// Goes to the end of a step, and leaves the accelerations by its series there in `stage`.
    pub(super) fn advance_in_series(&mut self, h: f64, last: bool) -> Result<(), StepError> {
        let Self {
            model,
            before,
            now,
            stage,
            taylor,
            end,
            ..
        } = self;
        let Some(taylor) = taylor else { return Ok(()) };
        let is_fine = taylor.advance(h, before, now, (*end, last), &mut stage.0);
        if !is_fine && let Some(coordinate) = not_finite(&now.q, &now.v, 0) {
            return Err(StepError::NotFinite {
                coordinate,
                t: now.t,
            });
        }
        // The projection only removes truncation error and rounding.
        model.project(now).map(|_| ())
    }

    /// Whether powers are integrated along its steps while all contacts are open.
    pub(super) fn takes_powers(&self) -> bool {
        self.quadratures.integrals().is_some() && self.model.system.get().has_powers()
    }

    /// Whether powers are integrated along its steps now. Closed contacts have some, that of their friction for one.
    pub(super) fn takes_powers_now(&self) -> bool {
        let is_closed = || self.model.closed().is_some();
        self.takes_powers() || is_closed() && self.quadratures.integrals().is_some()
    }

    /// Evaluates the powers within a step of length `h`. The accelerations in `stage` stay there.
    pub(super) fn take_powers_along_series(&mut self, h: f64) {
        if !self.takes_powers_now() {
            return;
        }
        let Self {
            method,
            model,
            quadratures,
            before,
            k,
            stage,
            taylor,
            ..
        } = self;
        let Some(taylor) = taylor else { return };
        let stages = method.tableau.stages;
        // Those of the last stage are not known yet.
        k[stages].clone_from(&stage.0);
        for (i, k) in k.iter_mut().enumerate().take(stages).skip(1) {
            let tau = method.tableau.c[i] * h;
            let at_stage = [&mut stage.0, &mut stage.1, &mut *k];
            crate::taylor::state_with_accelerations(taylor.of_step(), tau, at_stage);
            let t = before.t + (before.t_low + tau);
            model.take_rates(quadratures, i, (t, &stage.0, &stage.1, k));
        }
        core::mem::swap(&mut stage.0, &mut k[stages]);
    }

    /// Evaluates the powers at the end of a step.
    pub(super) fn take_powers_at_end(&mut self) {
        let Self {
            method,
            model,
            quadratures,
            now,
            k,
            ..
        } = self;
        let stages = method.tableau.stages;
        model.take_rates(quadratures, stages, (now.t, &now.q, &now.v, &k[stages]));
    }

    /// Expands the motion through the end of a step.
    pub(super) fn expand_ahead(&mut self) -> Result<(), StepError> {
        let Self {
            model,
            now,
            control: Control { work, .. },
            taylor,
            ..
        } = self;
        let Some(taylor) = taylor else { return Ok(()) };
        work.evaluations += 1;
        taylor.expand(model.in_series(), now, &model.inputs, true)
    }

    /// Compares the accelerations of both series at the end of a step, of which that of the step left its own in `stage`. Returns the error of the step: 0, or
    /// infinite if the motion is not the series.
    pub(super) fn compare_in_series(&mut self, h: f64) -> Result<f64, StepError> {
        if S::MAY_COLLIDE
            && self.model.has_dependent_contacts()
            && !self.keeps_dependent_contacts(h)?
        {
            return Ok(f64::INFINITY);
        }
        let Self {
            method,
            before,
            now,
            k,
            stage,
            taylor,
            tolerance,
            ..
        } = self;
        let Some(taylor) = taylor else {
            return Ok(f64::INFINITY);
        };
        let stages = method.tableau.stages;
        let accelerations = &mut k[stages];
        taylor.accelerations(true, accelerations);
        if are_finite(accelerations, accelerations) == [false]
            && let Some(coordinate) = not_finite(accelerations, accelerations, 0)
        {
            return Err(StepError::NotFinite {
                coordinate,
                t: now.t,
            });
        }
        let rounding = ROUNDING_UNITS * f64::EPSILON;
        let ends = [&*before, &*now];
        let mut may_be_off = false;
        let (by_series, absolute) = (stage.0.as_slice(), tolerance.absolute.as_slice());
        for (i, acceleration) in accelerations.as_slice().iter().enumerate() {
            let counted = (acceleration - by_series[i]).abs() - rounding * acceleration.abs();
            let bound = bound(size_of_rates(ends, i), absolute[i], tolerance.relative);
            may_be_off |= counted * h.abs() > 0.5 * GREATEST_DEFECT * bound;
        }
        let is_off = may_be_off && self.is_off(h)?;
        Ok(if is_off { f64::INFINITY } else { 0.0 })
    }

    /// Whether the series at the end of a step of length `h` has the accelerations under all closed contacts. It was derived without the conditions that follow from others
    /// at the beginning of the step, and these may have become independent since then.
    fn keeps_dependent_contacts(&mut self, h: f64) -> Result<bool, StepError> {
        let Self {
            model,
            before,
            now,
            stage,
            control: Control { work, .. },
            taylor,
            tolerance,
            ..
        } = self;
        let Some(taylor) = taylor else {
            return Ok(true);
        };
        let (mut by_series, known) = (now.v.zeros_like(), &mut stage.1);
        taylor.accelerations(true, &mut by_series);
        model.accelerations(now.t, &now.q, &now.v, known, work)?;
        let rounding = ROUNDING_UNITS * f64::EPSILON;
        let found = defect_between(
            [before, now],
            h,
            (&*tolerance, rounding),
            [known, &by_series],
        );
        Ok(found <= GREATEST_DEFECT)
    }

    /// Whether the motion is not its series at the end of a step of length `h`, which was expanded there.
    #[cold]
    fn is_off(&mut self, h: f64) -> Result<bool, StepError> {
        let Self {
            method,
            model,
            before,
            now,
            k,
            stage,
            control: Control { work, .. },
            taylor,
            tolerance,
            ..
        } = self;
        let Some(taylor) = taylor else {
            return Ok(false);
        };
        let accelerations = &k[method.tableau.stages];
        let defect_to = |other: &S::Vector, rounding: f64| {
            let pair = [accelerations, other];
            defect_between([before, now], h, (&*tolerance, rounding), pair)
        };
        crate::taylor::accelerations(taylor.of_step(), h, &mut stage.0);
        let found = defect_to(&stage.0, ROUNDING_UNITS * f64::EPSILON);
        if !(found > GREATEST_DEFECT && h.abs() > SHORTEST_STEPS * shortest_step::<f64>(now.t)) {
            return Ok(false);
        }
        // Round-off may change the accelerations as much, where large forces cancel.
        let mut beside = now.clone();
        crate::taylor::move_to_neighbours(&mut beside.q, &mut beside.v);
        work.evaluations += 1;
        let expanded = taylor.expand(model.in_series(), &beside, &model.inputs, true);
        taylor.accelerations(true, &mut stage.0);
        if expanded.is_ok() && found > ROUNDINGS * defect_to(&stage.0, 0.0) {
            return Ok(true);
        }
        work.evaluations += 1;
        taylor.expand(model.in_series(), now, &model.inputs, true)?;
        Ok(false)
    }
}

impl<S: System, L: InputLaw<S>> Model<'_, S, L> {
    /// The state of the contacts, if one of them is closed.
    fn closed(&self) -> Option<&UnilateralState> {
        let touching = self.touching.as_ref();
        touching.filter(|touching| !touching.leaves_accelerations())
    }

    /// Whether closed contacts hold along more directions than are independent.
    fn has_dependent_contacts(&self) -> bool {
        let is_redundant = || self.constraints.as_ref().is_some_and(|of| of.redundant);
        self.closed().is_some() && is_redundant()
    }

    /// The machine, with what its contacts do if one of them is closed, and the directions along which they are held only because others are.
    pub(super) fn in_series(&self) -> (&S, Option<ClosedContacts<'_>>) {
        let system = self.system.get();
        let closed = self.closed().map(|touching| {
            let dependent = self.constraints.as_ref().map(Constraints::dependent);
            let held = |row: usize| touching.held_by(row.checked_sub(system.constraints().len())?);
            let dependent = dependent.into_iter().flatten().filter_map(held);
            (touching.modes(), dependent.collect())
        });
        (system, closed)
    }
}

/// The [`defect`] of the first accelerations against the second ones, both at the end of a step of length `h` with these ends.
fn defect_between<V: Vector>(
    ends: [&Point<V>; 2],
    h: f64,
    (tolerance, rounding): (&Tolerance<V>, f64),
    [one, other]: [&V; 2],
) -> f64 {
    let absolute = tolerance.absolute.as_slice();
    let pairs = one.as_slice().iter().zip(other.as_slice());
    let coordinates = pairs
        .enumerate()
        .map(|(i, (one, other))| [size_of_rates(ends, i), *one, one - other, absolute[i]]);
    defect(h, coordinates, [tolerance.relative, rounding])
}

/// The size of the rate of a coordinate in a step with these ends.
#[inline(always)]
fn size_of_rates<V: Vector>([before, now]: [&Point<V>; 2], i: usize) -> f64 {
    let size = |at: &Point<V>| size_of_rate(at.q.as_slice()[i], at.v.as_slice()[i]);
    larger(size(before), size(now))
}

/// The first coordinate with a coefficient that is not finite.
fn not_finite_among<V: Vector>(rows: &[V]) -> usize {
    let coordinate = rows.iter().find_map(|row| not_finite(row, row, 0));
    coordinate.unwrap_or(0)
}
