//! Contacts that jam: with their present slips, their friction admits no accelerations of all of them together.
//!
//! If a disc is pushed in between two others, or between one and a wall, friction may increase the normal forces, and these the friction, without bound. Then no finite
//! forces obey the laws, and the slips that prevent a solution stop at once, by impulses, although no gap closes. These are the limit of a step of time stepping as its length goes to 0,
//!
//! ```text
//! M (v⁺ − v) = h f + W Λ,    0 ≤ Λₙ ⊥ γₙ⁺ ≥ 0,    −Λₜ ∈ μ Λₙ Sgn γₜ⁺,    h → 0
//! ```
//!
//! in which Λ does not go to 0 with h. There is always a solution, since the problem of a step has one, and it dissipates energy: `ΔT = Λₜ·γₜ⁺ − ½ Λ·G Λ`.
//! (D. E. Stewart, Arch. Ration. Mech. Anal. 145 (1998) 215–260.)

use std::vec;
use std::vec::Vec;

use super::impact::Meeting;
use super::kinematics::ContactKinematics;
use super::problem::{self, ContactUnknowns};
use super::undetermined;
use super::{Impact, UnilateralState};
use crate::at::At;
use crate::{StepError, System};

/// How large the residual of impulses may be.
const MOST_RESIDUAL: f64 = 1e-8;

/// A slip of which impulses leave no more than this share has stopped.
const STOPPED: f64 = 1e-6;

/// The first step is so short that forces change no rate by more than the least slip in it. Each further one is so many times as long, up to one in which they
/// change rates by so many times the greatest slip.
const LONGER: f64 = 16.0;

/// What an impact without a collision does to contacts that jam.
#[derive(Clone, Debug)]
pub(crate) struct Jam {
    pub impacts: Vec<Impact>,
    /// By how much the rates of coordinates change.
    pub change: Vec<f64>,
    /// The contacts that do not slip any more, and those that open.
    pub stop: Vec<usize>,
    pub open: Vec<usize>,
}

/// The rates along the directions of contacts that meet, and how fast they change without the forces of these.
struct Rates {
    now: Vec<f64>,
    accelerations: Vec<f64>,
    greatest_acceleration: f64,
}

impl UnilateralState {
    /// The impact without a collision of closed contacts that jam, if there is one. Of what is `resting` no slip stops.
    ///
    /// # Errors
    /// Where there are no accelerations without contacts, or the mass matrix is singular.
    pub fn resolve_jam<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        (closed, resting): (&[bool], &[bool]),
    ) -> Result<Option<Jam>, StepError> {
        let At { t, q, v, .. } = at;
        let closed: Vec<usize> = self.in_order().filter(|k| closed[*k]).collect();
        let several = closed
            .iter()
            .filter(|k| self.carrier(**k).is_none())
            .count()
            > 1;
        if !several || closed.iter().any(|k| self.is_compliant(*k)) {
            return Ok(None);
        }
        let here = self.kinematics(system, (t, q, v));
        let free = Self::free(system, at)?;
        let meeting = Meeting::new(system, (t, q), &here, closed)?;
        let places = || 0..meeting.contacts.len();
        let rates = Rates::new(&meeting, &here, &free, resting);
        let slips: Vec<f64> = places()
            .map(|p| self.speed_at(&meeting, &rates.now, p))
            .collect();
        let moving = slips.iter().copied().filter(|slip| *slip > 0.0);
        let least = moving.clone().fold(f64::INFINITY, f64::min);
        let greatest = moving.fold(0.0, f64::max);
        let none = vec![0.0; meeting.contacts.len()];
        let unknowns: Vec<ContactUnknowns> = places()
            .map(|p| self.unknowns_of_impact(&here, (p, meeting.contacts[p]), &none))
            .collect();
        let most = rates.greatest_acceleration;
        let mut h = least / most;
        while h.is_finite() && h > 0.0 && h * most <= LONGER * greatest {
            for impulses in impulses_of_step(&unknowns, &meeting, &rates, h) {
                let jam = self.jam_of(&meeting, &rates, &slips, (&impulses.0, impulses.1));
                let Some((stop, open)) = jam else {
                    continue;
                };
                let place = (t, q, v);
                let (impacts, change) = meeting.impacts(system, place, &here, &impulses.0);
                return Ok(Some(Jam {
                    impacts,
                    change,
                    stop,
                    open,
                }));
            }
            h *= LONGER;
        }
        Ok(None)
    }

    /// How fast a contact slips at this place among those that meet, along both tangents if it has two; 0 for second tangents.
    fn speed_at(&self, meeting: &Meeting, rates: &[f64], place: usize) -> f64 {
        let k = meeting.contacts[place];
        if self.first(k) != k {
            return 0.0;
        }
        let along = rates[2 * place + 1];
        match self.second(k) {
            Some(_) => along.hypot(rates[2 * place + 3]),
            None => along.abs(),
        }
    }

    /// Which contacts stop and which open by impulses in a step of this length; none if they only do what forces do.
    fn jam_of(
        &self,
        meeting: &Meeting,
        rates: &Rates,
        slips: &[f64],
        (impulses, h): (&[[f64; 2]], f64),
    ) -> Option<(Vec<usize>, Vec<usize>)> {
        let after: Vec<f64> = (0..meeting.directions.len())
            .map(|row| {
                rates.now[row] + h * rates.accelerations[row] + meeting.change(row, impulses)
            })
            .collect();
        let size = rates
            .now
            .iter()
            .fold(0.0_f64, |most, rate| most.max(rate.abs()));
        let rounding = 64.0 * f64::EPSILON * (size + h * rates.greatest_acceleration);
        let (mut stop, mut open, mut turns) = (Vec::new(), Vec::new(), false);
        for (place, &k) in meeting.contacts.iter().enumerate() {
            let (slip, left) = (slips[place], self.speed_at(meeting, &after, place));
            if slip > 0.0 && left <= (STOPPED * slip).max(rounding) {
                stop.push(k);
            } else if slip > 0.0 && self.second(k).is_none() {
                turns |= rates.now[2 * place + 1] * after[2 * place + 1] < 0.0;
            }
            let opens = impulses[place][0] == 0.0 && after[2 * place] > STOPPED * size;
            if opens && self.carrier(k).is_none() {
                open.push(k);
            }
        }
        let changes = turns || !stop.is_empty() || !open.is_empty();
        changes.then_some((stop, open))
    }
}

impl Rates {
    fn new(meeting: &Meeting, here: &ContactKinematics, free: &[f64], resting: &[bool]) -> Self {
        let is_still = |direction: usize| direction.is_multiple_of(2) || resting[direction / 2];
        let now = meeting.directions.iter().zip(&meeting.before);
        let now = now.map(|(direction, rate)| if is_still(*direction) { 0.0 } else { *rate });
        let accelerations = meeting.directions.iter();
        let accelerations: Vec<f64> = accelerations
            .map(|direction| here.acceleration(*direction, free)[0])
            .collect();
        Self {
            now: now.collect(),
            greatest_acceleration: accelerations.iter().fold(0.0, |most, a| most.max(a.abs())),
            accelerations,
        }
    }
}

/// The impulses of a step of this length, and before them those without the time that it takes and with the same states, if there are any; each with its
/// length.
fn impulses_of_step(
    unknowns: &[ContactUnknowns],
    meeting: &Meeting,
    rates: &Rates,
    h: f64,
) -> Vec<(Vec<[f64; 2]>, f64)> {
    let later: Vec<f64> = (rates.now.iter().zip(&rates.accelerations))
        .map(|(rate, acceleration)| rate + h * acceleration)
        .collect();
    let is_good = |answer: &problem::Answer| answer.residual <= MOST_RESIDUAL;
    let Some(step) = undetermined::solve(unknowns, &meeting.g, &later)
        .ok()
        .filter(is_good)
    else {
        return Vec::new();
    };
    let at_once = problem::solve(unknowns, &meeting.g, &rates.now, Some(&step.forces)).ok();
    let at_once = at_once.filter(is_good).map(|answer| (answer.forces, 0.0));
    at_once.into_iter().chain([(step.forces, h)]).collect()
}
