//! Which contacts are near: all others stay open while the motion stays within a box around the present state.
//!
//! The gap of each contact has a lower bound in the box ([`System::least_gaps`](crate::System::least_gaps)). If it is positive, the contact cannot close there, and
//! a run does not evaluate it until the motion leaves the box. Contacts that are far away cost nothing in most steps, and one bound for each new box. (The neighbour
//! lists of molecular dynamics do the same with balls: L. Verlet, Phys. Rev. 159 (1967) 98–103.)
//!
//! A run evaluates gaps along a polynomial: the Taylor polynomial in a step by series, the quintic through the ends in other steps. A polynomial lies between
//! the least and the greatest of its Bézier coefficients, and the box of a step contains these.

use std::sync::Arc;
use std::vec;
use std::vec::Vec;

use crate::{System, Vector};

/// A box reaches at least this share of the greatest coordinate of the same unit in each direction. The rounding of a gap is a thousandth of that, so that a gap that
/// is 0 to rounding is never taken to be open throughout a box.
const LEAST_REACH: f64 = 1e-9;

/// The fraction of its width by which a box is wider than the polynomial in it: the coefficients of the polynomial are rounded, and the dense output of a step differs
/// a little from its quintic.
const MARGIN: f64 = 0.1;

/// A box that the motion leaves after fewer steps is followed by a wider one, and one that it leaves after more by a narrower one, with fewer
/// near contacts.
const FEWEST_STEPS: usize = 8;
const MOST_STEPS: usize = 64;

/// If more than this share of the contacts is near, all of them are evaluated together for some steps, and the next box is narrower.
const MOST_NEAR: f64 = 0.25;

/// The number of these steps at first; it is doubled each time, up to the second number.
const PAUSES: [usize; 2] = [32, 1024];

/// The least and the greatest length of the motion for which a box is made, in steps.
const REACHES: [f64; 2] = [1.0 / 16.0, 4096.0];

/// A range of times and of states.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct StateBox {
    pub t: [f64; 2],
    pub low: Vec<f64>,
    pub high: Vec<f64>,
}

/// The ends of a step: its length, and at each end coordinates, rates and accelerations.
pub(crate) struct StepEnds<'a> {
    pub t: [f64; 2],
    pub step: f64,
    pub before: [&'a [f64]; 3],
    pub after: [&'a [f64]; 3],
}

/// The contacts that may close within a box.
#[derive(Clone, Debug)]
pub(crate) struct Nearby {
    within: Arc<StateBox>,
    /// These contacts, in their order.
    near: Arc<[usize]>,
    /// How many steps have stayed in the box.
    steps: usize,
    /// The number of steps like the last one for which the box was made.
    reach: f64,
    /// The number of further steps in which all contacts are evaluated because too many are near; and that number when it was last set.
    pause: usize,
    last_pause: usize,
}

impl StateBox {
    /// The box that a step stays in.
    pub fn of_step(ends: &StepEnds<'_>) -> StateBox {
        let h = ends.step;
        let [q, v, a] = ends.before;
        let [q_after, v_after, a_after] = ends.after;
        let range = |i: usize| {
            let begin = [
                q[i],
                q[i] + 0.2 * h * v[i],
                q[i] + 0.4 * h * v[i] + 0.05 * h * h * a[i],
            ];
            let end = [
                q_after[i],
                q_after[i] - 0.2 * h * v_after[i],
                q_after[i] - 0.4 * h * v_after[i] + 0.05 * h * h * a_after[i],
            ];
            let all = begin.into_iter().chain(end);
            let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                (low.min(x), high.max(x))
            });
            let margin = MARGIN * (high - low);
            (low - margin, high + margin)
        };
        let (low, high) = (0..q.len()).map(range).unzip();
        let [from, to] = ends.t;
        StateBox {
            t: [from.min(to), from.max(to)],
            low,
            high,
        }
    }

    /// The box that a step stays in whose coordinates are polynomials in the time since its beginning: these are their coefficients, of all coordinates for each
    /// power. A box that contains the Bézier coefficients contains the polynomial.
    pub fn of_series<V: Vector>(ends: &StepEnds<'_>, coefficients: &[V]) -> StateBox {
        let degree = coefficients.len().saturating_sub(1);
        let mut bezier = vec![0.0; degree + 1];
        let mut range = |i: usize| {
            // The coefficients of powers of the part of the step are each divided by a binomial coefficient.
            let (mut power, mut binomial) = (1.0, 1.0);
            for (k, (to, from)) in bezier.iter_mut().zip(coefficients).enumerate() {
                *to = power * from.as_slice()[i] / binomial;
                power *= ends.step;
                binomial *= (degree - k) as f64 / (k + 1) as f64;
            }
            for first in 1..=degree {
                for j in (first..=degree).rev() {
                    bezier[j] += bezier[j - 1];
                }
            }
            // The end of the step is rounded in another way.
            let all = bezier.iter().copied().chain([ends.after[0][i]]);
            let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                (low.min(x), high.max(x))
            });
            let margin = MARGIN * (high - low);
            (low - margin, high + margin)
        };
        let (low, high) = (0..ends.before[0].len()).map(&mut range).unzip();
        let [from, to] = ends.t;
        StateBox {
            t: [from.min(to), from.max(to)],
            low,
            high,
        }
    }

    /// Becomes the box of a line from a state through another one in the middle of it.
    pub fn set_to_line(&mut self, t: [f64; 2], q: &[f64], middle: &[f64]) {
        self.low.clear();
        self.high.clear();
        for (q, middle) in q.iter().zip(middle) {
            let end = 2.0 * middle - q;
            let margin = MARGIN * (q - end).abs();
            self.low.push(q.min(end) - margin);
            self.high.push(q.max(end) + margin);
        }
        let [from, to] = t;
        self.t = [from.min(to), from.max(to)];
    }

    /// Whether a state is in it. A number that is not one is not.
    fn contains(&self, t: f64, q: &[f64]) -> bool {
        let mut all = q.iter().zip(self.low.iter().zip(&self.high));
        self.t[0] <= t && t <= self.t[1] && all.all(|(q, (low, high))| low <= q && q <= high)
    }

    fn covers(&self, other: &StateBox) -> bool {
        self.contains(other.t[0], &other.low) && self.contains(other.t[1], &other.high)
    }

    /// Makes room for this many steps like the one that stays in it. Coordinates and times that no gap depends on have any value.
    pub fn widen<S: System>(&mut self, system: &S, gap_arguments: &[bool], steps: f64) {
        // Of each unit the longest path and the greatest number count: what is at rest may be hit by what moves.
        let mut of_units = Units::default();
        for (i, coordinate) in system.coordinates().enumerate() {
            let own = of_units.get(coordinate.unit);
            if gap_arguments[i] {
                let size = self.low[i].abs().max(self.high[i].abs());
                let path = self.high[i] - self.low[i];
                *own = (own.0.max(path), own.1.max(size));
            }
        }
        for (i, coordinate) in system.coordinates().enumerate() {
            if !gap_arguments[i] {
                (self.low[i], self.high[i]) = (f64::NEG_INFINITY, f64::INFINITY);
                continue;
            }
            let unit = coordinate.unit;
            let (path, size) = *of_units.get(unit);
            let least = LEAST_REACH * if unit == "rad" { size.max(1.0) } else { size };
            let reach = (steps * path).max(least);
            self.low[i] -= reach;
            self.high[i] += reach;
        }
        let length = self.t[1] - self.t[0];
        self.t = if gap_arguments.last() == Some(&true) {
            let size = self.t[0].abs().max(self.t[1].abs());
            let reach = (steps * length).max(LEAST_REACH * size);
            [self.t[0] - reach, self.t[1] + reach]
        } else {
            [f64::NEG_INFINITY, f64::INFINITY]
        };
    }
}

/// Two numbers for each unit of coordinates: of the first few without an allocation.
#[derive(Default)]
struct Units<'a> {
    first: [(&'a str, (f64, f64)); 4],
    count: usize,
    others: Vec<(&'a str, (f64, f64))>,
}

impl<'a> Units<'a> {
    fn get(&mut self, unit: &'a str) -> &mut (f64, f64) {
        let known = self.first[..self.count].iter();
        if let Some(place) = known.clone().position(|(own, _)| *own == unit) {
            return &mut self.first[place].1;
        }
        if self.count < self.first.len() {
            let place = self.count;
            self.count += 1;
            self.first[place].0 = unit;
            return &mut self.first[place].1;
        }
        let known = self.others.iter().position(|(own, _)| *own == unit);
        let place = known.unwrap_or(self.others.len());
        if known.is_none() {
            self.others.push((unit, (0.0, 0.0)));
        }
        &mut self.others[place].1
    }
}

impl Nearby {
    /// The near contacts of a machine in and after a step; `known` are those of the step before.
    pub fn of_step<S: System>(
        (system, gap_arguments): (&S, &[bool]),
        known: Option<Nearby>,
        step: &StateBox,
    ) -> Nearby {
        let (mut reach, mut last_pause) = (1.0, 0);
        if let Some(mut known) = known {
            if known.last_pause == 0 && known.within.covers(step) {
                known.steps += 1;
                return known;
            }
            let factor = match known.steps {
                _ if known.last_pause > 0 => 0.5,
                steps if steps < FEWEST_STEPS => 2.0,
                steps if steps > MOST_STEPS => 0.5,
                _ => 1.0,
            };
            let [least, most] = REACHES;
            reach = (factor * known.reach).clamp(least, most);
            last_pause = known.last_pause;
        }
        let mut within = step.clone();
        within.widen(system, gap_arguments, reach);
        let mut ends = [(); 2].map(|()| S::Vector::zeros(within.low.len()));
        ends[0].as_mut_slice().copy_from_slice(&within.low);
        ends[1].as_mut_slice().copy_from_slice(&within.high);
        let mut least = vec![f64::NEG_INFINITY; system.unilateral_contacts().len()];
        system.least_gaps(within.t, [&ends[0], &ends[1]], &mut least);
        // A value that is not a number is no bound.
        let is_far = |least: &f64| *least > 0.0;
        let near = least.iter().enumerate();
        let near = near.filter(|(_, least)| !is_far(least)).map(|(k, _)| k);
        let near: Arc<[usize]> = near.collect();
        let are_many = near.len() as f64 > MOST_NEAR * least.len() as f64;
        let [shortest, longest] = PAUSES;
        let pause = if are_many {
            (2 * last_pause).clamp(shortest, longest)
        } else {
            0
        };
        Nearby {
            near,
            within: Arc::new(within),
            steps: 1,
            reach,
            pause,
            last_pause: pause,
        }
    }

    /// Whether all contacts are evaluated in one more step, because too many are near.
    pub fn pauses(&mut self) -> bool {
        let pauses = self.pause > 0;
        self.pause = self.pause.saturating_sub(1);
        pauses
    }

    /// The contacts that are near at a state; `None` if it is not in the box, or too many are.
    pub fn at(&self, t: f64, q: &[f64]) -> Option<&[usize]> {
        (self.last_pause == 0 && self.within.contains(t, q)).then_some(&*self.near)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A step by Taylor series along `sin t` that is 8 rad long stays in its box, and leaves the quintic through its ends by more than any margin of that: what is
    /// there would be missed.
    #[test]
    fn a_long_step_stays_in_its_own_box() {
        let (h, from) = (8.0_f64, 0.3_f64);
        let mut factorial = 1.0;
        let coefficients: Vec<Vec<f64>> = (0..40)
            .map(|k| {
                factorial *= if k == 0 { 1.0 } else { f64::from(k) };
                vec![(from + f64::from(k) * core::f64::consts::FRAC_PI_2).sin() / factorial]
            })
            .collect();
        let state = |t: f64| [[t.sin()], [t.cos()], [-t.sin()]];
        let (before, after) = (state(from), state(from + h));
        let ends = StepEnds {
            t: [0.0, h],
            step: h,
            before: [&before[0], &before[1], &before[2]],
            after: [&after[0], &after[1], &after[2]],
        };
        let (own, quintic) = (
            StateBox::of_series(&ends, &coefficients),
            StateBox::of_step(&ends),
        );
        let (mut most, mut least) = (f64::NEG_INFINITY, f64::INFINITY);
        for part in 0..=1000 {
            let theta = f64::from(part) / 1000.0;
            let q = (from + theta * h).sin();
            assert!(own.contains(theta * h, &[q]), "{theta}: {q} {own:?}");
            (most, least) = (most.max(q), least.min(q));
        }
        assert!(
            most > quintic.high[0] || least < quintic.low[0],
            "{quintic:?}"
        );
    }
}
