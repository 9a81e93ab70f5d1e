//! The slips of contacts: which are rest, which have stopped, and which fade.

use std::vec;
use std::vec::Vec;

use super::super::Mode;
use super::super::touching::UnilateralState;
use crate::at::At;
use crate::{StepError, System};

/// A slip in space that is no more than so many of its roundings has stopped.
const STOPPED: f64 = 10.0;

impl UnilateralState {
    /// Which of the contacts that are closed are at rest along their tangents.
    pub fn resting<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        closed: &[bool],
    ) -> Vec<bool> {
        let here = self.kinematics(system, (t, q, v));
        let rest = self.rest(&here, self.greatest_rate(), |k| closed[k]);
        let rest_of_turning = self.rest_of_turning(&here, |k| closed[k]);
        let rests = |k: usize| {
            if !closed[k] {
                return false;
            }
            let rest = if self.is_turning(k) {
                rest_of_turning
            } else {
                rest
            };
            if self.has_two_tangents(k) {
                let [slip, rounding] = self.slip(&here, k);
                return slip[0].hypot(slip[1]) <= rounding[0].hypot(rounding[1]).max(rest);
            }
            here.rates[2 * k + 1].abs() <= here.rate_rounding(2 * k + 1).max(rest)
        };
        (0..here.gaps.len()).map(rests).collect()
    }

    /// Which contacts slip no faster than one that has `stopped`. What that one still slips is the error with which the instant of its stop is known, so they stop
    /// there as well. They are contacts with one tangent.
    pub fn stopping_with<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        stopped: &[bool],
    ) -> Vec<bool> {
        let here = self.kinematics(system, (t, q, v));
        let slips = |k: &usize| {
            let slides = matches!(self.modes()[*k], Mode::Slides(sign) if sign != 0.0);
            slides && !self.has_two_tangents(*k)
        };
        let speed = |k: usize| here.rates[2 * k + 1].abs();
        let stops = |k: usize| {
            let rounding = here.rate_rounding(2 * k + 1);
            let mut others = (0..stopped.len()).filter(|other| stopped[*other]);
            others.any(|other| {
                let is_like = self.is_turning(other) == self.is_turning(k);
                is_like && !self.has_two_tangents(other) && speed(k) <= speed(other) + rounding
            })
        };
        (0..stopped.len()).map(|k| slips(&k) && stops(k)).collect()
    }

    /// Takes note of how fast what is closed slips: slips that are rounding of it are rest, and several that stop at one instant stop
    /// together.
    pub fn record_slips<S: System>(&mut self, system: &S, t: f64, q: &S::Vector, v: &S::Vector) {
        let slides = |mode: &Mode| match mode {
            Mode::Slides(sign) => *sign != 0.0,
            Mode::SlidesAlong(_) => true,
            _ => false,
        };
        if !self.modes().iter().any(slides) {
            return;
        }
        let here = self.kinematics(system, (t, q, v));
        let turns = |k: &usize| slides(&self.modes()[*k]) && self.is_turning(*k);
        let turning = (0..self.modes().len()).filter(turns);
        let turning = turning.map(|k| here.rates[2 * k + 1].abs());
        let turning = turning.fold(self.turning, f64::max);
        let own = self.modes().iter().enumerate();
        let own = own.filter(|(k, mode)| slides(mode) && self.carrier(*k).is_none());
        let slips = own.map(|(k, mode)| match mode {
            Mode::SlidesAlong(_) => {
                let [slip, _] = self.slip(&here, k);
                slip[0].hypot(slip[1])
            }
            _ => here.rates[2 * k + 1].abs(),
        });
        self.slip = slips.fold(self.slip, f64::max);
        self.turning = turning;
    }

    /// Whether the slip of a contact is rounding, if that has two directions.
    pub fn is_slow<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        contact: usize,
    ) -> bool {
        if !self.has_two_tangents(contact) {
            return true;
        }
        let here = self.kinematics(system, (t, q, v));
        let [slip, rounding] = self.slip(&here, contact);
        let least = rounding[0]
            .hypot(rounding[1])
            .max(1e-12 * self.greatest_rate());
        slip[0].hypot(slip[1]) <= STOPPED * least
    }

    /// Which contacts slip in two directions so slowly that `errors` of the rates of coordinates decide where to, and are braked. Such a slip misses 0 by these
    /// errors and would be followed around it in ever shorter steps.
    pub fn fading_slips<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        errors: &[f64],
    ) -> Result<Vec<bool>, StepError> {
        let mut fading = vec![false; self.modes().len()];
        let slides = |k: usize| matches!(self.modes()[k], Mode::SlidesAlong(_));
        if !(0..fading.len()).any(slides) {
            return Ok(fading);
        }
        let here = self.kinematics(system, (at.t, at.q, at.v));
        let slip = |k: usize| self.slip(&here, k)[0];
        let is_slow = |k: &usize| {
            if self.first(*k) != *k {
                return false;
            }
            let [along, across] = slip(*k);
            let [own, other] = [1, 3].map(|part| here.rate_error(2 * k + part, errors));
            slides(*k) && along.hypot(across) <= own.hypot(other)
        };
        let slow: Vec<usize> = (0..fading.len()).filter(is_slow).collect();
        if slow.is_empty() {
            return Ok(fading);
        }
        let a = self.reaction(system, at)?.a;
        for k in slow {
            let change = [1, 3].map(|part| here.acceleration(2 * k + part, &a)[0]);
            let [along, across] = slip(k);
            fading[k] = along * change[0] + across * change[1] < 0.0;
        }
        Ok(fading)
    }

    /// Whether a contact that slides has come to rest where its slip is at right angles to what it was when the step began: then it
    /// is what the step has left of it, and not a turn.
    pub fn has_stopped<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        contact: usize,
    ) -> Result<bool, StepError> {
        let Mode::SlidesAlong(_) = self.modes()[contact] else {
            return Ok(true);
        };
        let At { t, q, v, .. } = at;
        let here = self.kinematics(system, (t, q, v));
        if self.is_slow(system, (t, q, v), contact) {
            return Ok(true);
        }
        let [slip, _] = self.slip(&here, contact);
        let speed = slip[0].hypot(slip[1]);
        // The contact has stopped if it does so before time goes on.
        let a = self.reaction(system, at)?.a;
        let braked = [1, 3].map(|part| here.acceleration(2 * self.first(contact) + part, &a)[0]);
        let left = speed / braked[0].hypot(braked[1]);
        Ok(left <= 64.0 * f64::EPSILON * t.abs())
    }
}
