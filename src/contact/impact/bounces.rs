//! Bounces that become ever lower, and their end.

use std::vec::Vec;

use super::super::kinematics::ROUNDING;
use super::super::touching::UnilateralState;
use super::KNOWN_HEIGHT;
use crate::System;

/// Contacts that bounce ever lower are closed where they open at less than this of the greatest rate at which any
/// closed so far.
const LEAST_BOUNCE: f64 = 1e-9;

/// A bounce is no higher than so many roundings of its gap.
const LEAST_HEIGHT: f64 = 64.0;

/// How a contact bounces after an impact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounce {
    /// How fast it opens, and how fast it did after its impact before that, in m/s; 0 if there was none.
    pub opening: f64,
    before: f64,
    /// The round-off of its gap, in m.
    roundoff: f64,
    restitution: f64,
}

impl UnilateralState {
    /// The bounce of a contact that touches and opens with the rates that impacts have left. If it `is_hit`, its next bounce is compared with this one; if not,
    /// it may be left from an impact before, when other bodies flew with it.
    pub fn bounce<S: System>(
        &mut self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        (contact, is_hit): (usize, bool),
    ) -> Bounce {
        let here = self.kinematics(system, (t, q, v));
        let opening = here.rates[2 * contact];
        let before = if is_hit {
            core::mem::replace(&mut self.openings[contact], opening)
        } else {
            0.0
        };
        Bounce {
            opening,
            before,
            roundoff: here.gap_roundoff(contact),
            restitution: here.restitution(contact)[0],
        }
    }

    /// Whether bounces of a contact have become so low that they are at their end: how long the rest of them takes, in s. `gap_acceleration` is what its
    /// rate changes by while it is open.
    pub fn remaining_bounce_time(&self, bounce: &Bounce, gap_acceleration: f64) -> Option<f64> {
        let &Bounce {
            opening,
            before,
            roundoff,
            restitution,
        } = bounce;
        if opening <= 0.0 || gap_acceleration >= 0.0 {
            return None;
        }
        let rate_to = |height: f64| (2.0 * -gap_acceleration * height * roundoff).sqrt();
        // A bounce in which the gap stays unknown cannot be followed, whether or not other bodies have made it higher than the one before.
        let known_share = if before > 0.0 {
            opening / before
        } else {
            f64::INFINITY
        };
        let share = if opening <= rate_to(KNOWN_HEIGHT) {
            known_share.min(restitution)
        } else {
            known_share
        };
        if share >= 1.0 {
            return None;
        }
        let limit = rate_to(LEAST_HEIGHT).max(LEAST_BOUNCE * self.speed);
        (opening <= limit).then(|| 2.0 * opening / -gap_acceleration / (1.0 - share))
    }

    /// How fast the rates of all gaps change while the machine has these accelerations; 0 where that is rounding beside the greatest one, as between bodies that
    /// fall together.
    pub fn gap_accelerations<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        a: &[f64],
    ) -> Vec<f64> {
        let here = self.kinematics(system, (t, q, v));
        let all: Vec<[f64; 2]> = (0..here.gaps.len())
            .map(|contact| here.acceleration(2 * contact, a))
            .collect();
        let greatest = all
            .iter()
            .fold(0.0, |most, [_, terms]| f64::max(most, *terms));
        let is_rounding = |value: f64| value.abs() <= ROUNDING * greatest;
        let values = all.into_iter().map(|[value, _]| value);
        values
            .map(|value| if is_rounding(value) { 0.0 } else { value })
            .collect()
    }
}
