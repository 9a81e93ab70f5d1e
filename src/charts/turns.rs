//! How far points have turned about their centres in a run.

use std::vec;
use std::vec::Vec;

use super::maps::{distance_and_rates, length};
use crate::scalar::Scalar;
use crate::{Error, Machine, StepMotion, System, Vector};

/// The parts of a step between which the angle is looked at, at least; a step by series is longer.
const PARTS: u32 = 8;
const PARTS_OF_SERIES: u32 = 64;

/// The largest turn from one look to the next, in rad.
const LARGEST_TURN: f64 = 0.5;

/// The shortest part of a step. A body that turns by more within it goes through the centre, to rounding.
const SHORTEST: f64 = 1e-15;

/// The largest turn from a mark to an instant that is referred to it, in rad.
const BETWEEN_MARKS: f64 = 1.0;

/// Follows the angles of points through a run in Cartesian coordinates, with all their turns.
#[derive(Clone, Debug)]
pub struct Turns {
    /// For each point the indices of its two components.
    points: Vec<[usize; 2]>,
    /// The number of coordinates of the machine.
    dimension: usize,
    /// The time at the start, in s.
    begin: f64,
    turned: Vec<Turned>,
}

/// How far a point has turned about its centre.
#[derive(Clone, Debug)]
struct Turned {
    /// The direction in which it was seen last; the centre itself is in none.
    direction: [f64; 2],
    /// The angle of this direction, with all its turns.
    angle: f64,
    /// Angles with the times from which they may be referred to: from one to the next the point turns by less than half a turn.
    marks: Vec<(f64, f64)>,
}

impl Turns {
    /// The angles at the start of a run, at time `t` in s: for each point the indices of its distance and its angle among the polar
    /// coordinates `q`.
    pub fn begin(points: &[[usize; 2]], t: f64, q: &[f64]) -> Turns {
        let turned = points.iter().map(|&[_, angle]| {
            let angle = q[angle];
            let (sin, cos) = Scalar::sin_cos(angle);
            Turned {
                direction: [cos, sin],
                angle,
                marks: vec![(t, angle)],
            }
        });
        Turns {
            points: points.to_vec(),
            dimension: q.len(),
            begin: t,
            turned: turned.collect(),
        }
    }

    /// Follows the angles through a step of a run in Cartesian coordinates that is recorded every `interval` seconds; 0 if the instants
    /// are not known before, and infinity if only its end is.
    ///
    /// # Errors
    /// If the motion within the step cannot be evaluated.
    pub fn follow<M: Machine>(
        &mut self,
        step: &mut dyn StepMotion<M>,
        interval: f64,
    ) -> Result<(), Error> {
        let zeros = <M::System as System>::Vector::zeros(self.dimension);
        let (mut q, mut v) = (zeros.clone(), zeros);
        let parts = if step.is_series() {
            PARTS_OF_SERIES
        } else {
            PARTS
        };
        let mut at = 0.0;
        // The next one is last.
        let ends = (1..=parts).rev();
        let mut ends: Vec<f64> = ends
            .map(|part| f64::from(part) / f64::from(parts))
            .collect();
        while let Some(theta) = ends.pop() {
            let t = step.state_at(theta, &mut q, &mut v)?;
            let places = self
                .points
                .iter()
                .map(|point| point.map(|k| q.as_slice()[k]));
            let turns = places.clone().zip(&self.turned);
            let turns: Vec<f64> = turns.map(|(place, of)| of.turn_to(place)).collect();
            let middle = 0.5 * (at + theta);
            let is_far = turns.iter().any(|turn| turn.abs() > LARGEST_TURN);
            if is_far && theta - at > SHORTEST && at < middle && middle < theta {
                ends.extend([theta, middle]);
                continue;
            }
            for ((place, turned), turn) in places.zip(&mut self.turned).zip(turns) {
                turned.advance(place, turn, t, (self.begin, interval));
            }
            at = theta;
        }
        Ok(())
    }

    /// Replaces the Cartesian coordinates and rates of a state of the run, at time `t` in s, by polar ones. The distance is not negative,
    /// and the angle has all its turns. At the centre itself, where polar coordinates have no other value, the angle is that of the last
    /// direction, the rate of the distance is the speed, and that of the angle is 0.
    pub fn to_polar(&self, t: f64, q: &mut [f64], v: &mut [f64]) {
        for (&[i, j], turned) in self.points.iter().zip(&self.turned) {
            let place = [q[i], q[j]];
            let (s, rates) = distance_and_rates(place, [v[i], v[j]]);
            let angle = if s > 0.0 {
                turned.angle_of(place, t)
            } else {
                turned.last_mark(t)
            };
            (q[i], q[j]) = (s, angle);
            [v[i], v[j]] = rates;
        }
    }
}

impl Turned {
    /// The angle from the last direction to that of a point, within half a turn; 0 for the centre.
    fn turn_to(&self, [x, y]: [f64; 2]) -> f64 {
        let [a, b] = self.direction;
        // Scaled, so that products of small numbers do not vanish.
        let size = x.abs().max(y.abs());
        if size == 0.0 {
            return 0.0;
        }
        let (x, y) = (x / size, y / size);
        Scalar::atan2(a * y - b * x, a * x + b * y)
    }

    /// Goes on to the direction of a point, after a turn.
    fn advance(&mut self, [x, y]: [f64; 2], turn: f64, t: f64, (begin, interval): (f64, f64)) {
        let size = length([x, y]);
        if size == 0.0 {
            return;
        }
        self.direction = [x / size, y / size];
        // The whole turns are counted, and the rest is exact, so that no error is summed.
        let angle = Scalar::atan2(y, x);
        let sum = self.angle + turn;
        self.angle = nearest(angle, sum);
        let (since, marked) = self.marks.last().copied().unwrap_or((t, self.angle));
        if (self.angle - marked).abs() < BETWEEN_MARKS {
            return;
        }
        // A mark after which nothing is recorded before the next one is not needed.
        let periods = |t: f64| ((t - begin) / interval).abs();
        let is_used = (periods(t) + 1e-6).floor() >= (periods(since) - 1e-6).ceil();
        let is_kept = self.marks.len() < 2 || (interval.is_finite() && is_used);
        if !is_kept {
            self.marks.pop();
        }
        self.marks.push((t, self.angle));
    }

    /// The mark that a time of the run is referred to.
    fn last_mark(&self, t: f64) -> f64 {
        let (first, last) = (self.marks[0], self.marks[self.marks.len() - 1]);
        let direction = (last.0 - first.0).signum();
        let is_before = |(since, _): &(f64, f64)| (since - t) * direction <= 0.0;
        let after = self.marks.partition_point(is_before);
        self.marks[after.saturating_sub(1)].1
    }

    /// The angle of a point at a time of the run.
    fn angle_of(&self, [x, y]: [f64; 2], t: f64) -> f64 {
        nearest(Scalar::atan2(y, x), self.last_mark(t))
    }
}

/// The angle that differs from `angle` by whole turns and is nearest to another.
fn nearest(angle: f64, other: f64) -> f64 {
    use core::f64::consts::TAU;
    angle + TAU * ((other - angle) / TAU).round()
}
