//! The fastest motion that was found, with all quantities along it.

use std::f64::consts::PI;

use super::Terrain;
use super::collocation::{Level, Path, Stage, advanced};
use super::hamiltonian::Driven;
use super::pontryagin::Pontryagin;
use super::rule::{Rule, through};
use crate::linear::{Cholesky, Lu, dot};
use crate::solution::{Lapse, Moment, violations};
use crate::trial::{Outcome, Trial};

/// The number of moments at which guides and sudden turns are checked.
const CHECK_POINTS: u32 = 64;

/// The speed that stands for rest where H has no derivatives at rest: its square is a number, and nothing else of size 1 is changed by it.
const NEXT_TO_REST: f64 = 1e-100;

/// The fastest motion of a [`Terrain`] from rest at one position to another.
#[derive(Clone, Debug)]
pub struct Sought<T> {
    pub(super) system: Driven<T>,
    pub(super) path: Path,
    pub(super) change: f64,
    pub(super) ends: [Vec<f64>; 2],
    pub(super) tried: Vec<Trial>,
    pub(super) evaluations: u64,
}

impl<T: Terrain> Sought<T> {
    /// The time from which other directions would be faster, in s after the start: Legendre's condition fails
    /// there, or Jacobi's.
    pub(super) fn refused(&self) -> Option<f64> {
        self.saddle().or_else(|| self.conjugate())
    }

    /// The duration, in s.
    pub fn time(&self) -> f64 {
        self.path.time
    }

    /// How much the duration changed at the last halving of the stretches, in s: an upper bound of the error.
    pub fn change(&self) -> f64 {
        self.change
    }

    /// The number of stretches, each of order 8.
    pub fn stretches(&self) -> usize {
        self.path.stretches()
    }

    /// All trials and their outcomes; this motion is the fastest of those that were found.
    pub fn trials(&self) -> &[Trial] {
        &self.tried
    }

    /// The durations of other local minima, in s, the fastest first; none is less than that of this motion.
    pub fn others(&self) -> Vec<f64> {
        let durations = self.tried.iter().filter_map(|trial| match trial.outcome {
            Outcome::Found { time } => Some(time),
            _ => None,
        });
        let mut times: Vec<f64> = durations.collect();
        times.sort_by(f64::total_cmp);
        times.drain(..times.len().min(1));
        times
    }

    /// The durations of polygons or extremals, in s, that are less than that of this motion but could not be continued to a motion
    /// that is a local minimum. While there are any, this motion may not be the fastest.
    pub fn doubts(&self) -> Vec<f64> {
        let time = self.time();
        let doubts = self
            .tried
            .iter()
            .filter_map(|trial| trial.shorter_duration_of_unfinished(time));
        doubts.collect()
    }

    /// The work of the search, in evaluations as counted by [`Search::budget`](super::Search::budget).
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// The machine.
    pub fn terrain(&self) -> &T {
        &self.system.terrain
    }

    /// The start and the end.
    pub fn ends(&self) -> [&[f64]; 2] {
        [&self.ends[0], &self.ends[1]]
    }

    /// The multipliers `p` of the coordinates at the start, in s per unit of each: the decrease of the duration per
    /// displacement of the start along that coordinate.
    pub fn costs(&self) -> &[f64] {
        let n = self.system.n();
        &self.path.nodes[0][n + 1..2 * n + 1]
    }

    /// The largest deviation of Pontryagin's function from 1 at the ends of stretches and half-way.
    pub fn residual(&self) -> f64 {
        let looks = 2 * self.stretches();
        let moments = (1..=looks).map(|k| {
            let stage = self.stage(self.time() * k as f64 / looks as f64);
            (self.system.value(&stage.y, &stage.z) - 1.0).abs()
        });
        moments.fold(0.0, f64::max)
    }

    /// States and multipliers at a time, by integrating one stretch from the last node before it.
    fn stage(&self, time: f64) -> Stage {
        let count = self.stretches();
        let position = (time / self.time()).clamp(0.0, 1.0) * count as f64;
        let k = (position as usize).min(count - 1);
        let part = position - k as f64;
        let (start, old) = (&self.path.nodes[k], &self.path.stages[k]);
        let points = Rule::new().points;
        let mut states = std::vec![(0.0, start.as_slice())];
        states.extend(points.iter().zip(old).map(|(c, s)| (*c, s.y.as_slice())));
        let controls = points.iter().zip(old);
        let controls: Vec<(f64, &[f64])> = controls.map(|(c, s)| (*c, s.z.as_slice())).collect();
        let guess = |x: f64| Stage {
            y: through(&states, x),
            z: through(&controls, x),
        };
        let y = match part {
            0.0 => start.clone(),
            1.0 => self.path.nodes[k + 1].clone(),
            _ => {
                let stages = points.map(|c| guess(c * part)).to_vec();
                let length = part * self.time() / count as f64;
                advanced(&self.system, start, stages, length)
            }
        };
        let z = self.steered(&y, guess(part).z);
        Stage { y, z }
    }

    /// The state, or, if it is one of rest at which H has no derivatives, the one next to it into which the motion goes from there: drag is
    /// `|v| v`, and a speed, the root of a square, has no derivative at rest.
    fn differentiable(&self, y: &[f64], z: &[f64]) -> Vec<f64> {
        let n = self.system.n();
        let mut y = y.to_vec();
        if y[n] == 0.0 {
            let (slopes, second) = self.system.curvatures(&y, z);
            let mut derivatives = slopes.iter().chain(second.iter().flatten());
            if !derivatives.all(|x| x.is_finite()) {
                y[n] = NEXT_TO_REST;
            }
        }
        y
    }

    /// The control that makes H stationary, from a guess with a few digits.
    fn steered(&self, y: &[f64], mut z: Vec<f64>) -> Vec<f64> {
        let first = y.len();
        let y = self.differentiable(y, &z);
        for _ in 0..4 {
            let (slopes, second) = self.system.curvatures(&y, &z);
            let block: Vec<Vec<f64>> = second[first..]
                .iter()
                .map(|r| r[first..].to_vec())
                .collect();
            let Some(factors) = Lu::new(block) else {
                break;
            };
            let change = factors.solve(&slopes[first..]);
            z.iter_mut().zip(change).for_each(|(z, d)| *z -= d);
        }
        z
    }

    /// The motion at a time, in s; times before the start or after the end are clamped.
    pub fn at(&self, time: f64) -> Moment {
        let n = self.system.n();
        let (m, wide) = (n + 1, 2 * (n + 1));
        let Stage { y, z } = self.stage(time);
        let is_at_rest = y[n] == 0.0;
        let y = self.differentiable(&y, &z);
        let (slopes, second) = self.system.curvatures(&y, &z);
        // ẏ and ż give the rate of v = ∂H/∂p.
        let mut rate: Vec<f64> = slopes[m..wide].to_vec();
        rate.extend(slopes[..m].iter().map(|x| -x));
        let right: Vec<f64> = second[wide..]
            .iter()
            .map(|row| -dot(&row[..wide], &rate))
            .collect();
        let block: Vec<Vec<f64>> = second[wide..].iter().map(|r| r[wide..].to_vec()).collect();
        let turning = Lu::new(block).map_or_else(|| right.clone(), |factors| factors.solve(&right));
        rate.extend(turning);
        let q = y[..n].to_vec();
        let v = if is_at_rest {
            std::vec![0.0; n]
        } else {
            slopes[m..m + n].to_vec()
        };
        let a: Vec<f64> = second[m..m + n].iter().map(|row| dot(row, &rate)).collect();
        let terrain = &self.system.terrain;
        let inertia = terrain.inertia(&q);
        let resistance = terrain.resistance(&q, &v);
        let control = (0..n).map(|i| dot(&inertia[i * n..(i + 1) * n], &a) + resistance[i]);
        let control = control.collect();
        let (contacts, friction_power) = terrain.contacts(&q, &v, &a);
        let mass = terrain.mass(&q);
        let length = |matrix: &[f64], x: &[f64], y: &[f64]| -> f64 {
            (0..n * n).map(|k| matrix[k] * x[k / n] * y[k % n]).sum()
        };
        let unit = self.system.direction(&z);
        let kinetic = length(&mass, &unit, &unit).sqrt();
        let first = self.system.direction(&self.path.stages[0][0].z);
        let along = length(&inertia, &first, &unit);
        let turned = if self.system.is_plane() {
            z[0] - self.path.stages[0][0].z[0]
        } else {
            let sizes = length(&inertia, &first, &first) * length(&inertia, &unit, &unit);
            (along / sizes.sqrt()).clamp(-1.0, 1.0).acos()
        };
        // ∂H/∂(speed in the metric of a): E dλ, as W = E U and U √(ê·a ê) is that speed.
        let measure = self.system.measure(&q, &unit, &z);
        let multiplier = y[wide - 1] * measure / kinetic;
        Moment {
            time: time.clamp(0.0, self.time()),
            turned,
            q,
            v,
            a,
            direction: unit.iter().map(|x| x / kinetic).collect(),
            control,
            friction_power,
            multiplier,
            contacts,
        }
    }

    /// Guides that slip backwards, or whose reaction becomes negative.
    pub fn violations(&self) -> Vec<Lapse> {
        let looks = (0..=CHECK_POINTS)
            .map(|k| self.at(self.time() * f64::from(k) / f64::from(CHECK_POINTS)));
        let moments: Vec<Moment> = looks.collect();
        let slip = |guide: usize, moment: &Moment| {
            let terrain = &self.system.terrain;
            terrain.contacts(&moment.q, &moment.direction, &moment.a).0[guide].slip
        };
        violations(&self.system.terrain.guides(), &moments, slip)
    }

    /// The range of sudden turns of the direction, in rad, among which none would be faster at any moment (Weierstrass);
    /// for two coordinates, in steps of a degree. A full turn multiplies the speed by `exp(∓2π κ)`: with friction that
    /// depends on turns no range reaches that far.
    pub fn best_among_turns(&self) -> [f64; 2] {
        const STEPS: u32 = 180;
        if !self.system.is_plane() {
            return [-PI, PI];
        }
        let states = self.path.nodes.iter().zip(&self.path.stages);
        let states: Vec<(&[f64], Vec<f64>)> = states
            .map(|(y, stages)| (y.as_slice(), self.steered(y, stages[0].z.clone())))
            .collect();
        let gains = |turn: f64| {
            states.iter().any(|(y, z)| {
                let now = self.system.value(y, z);
                let turned = self.system.value(y, &[z[0] + turn]);
                turned > now + 64.0 * f64::EPSILON * now.abs().max(1.0)
            })
        };
        [-1.0, 1.0].map(|side| {
            let angle = |step: u32| side * PI * f64::from(step) / f64::from(STEPS);
            let good = (1..=STEPS).take_while(|step| !gains(angle(*step)));
            angle(u32::try_from(good.count()).unwrap_or(STEPS))
        })
    }

    /// Legendre's condition: H has a maximum, not a minimum, at the directions of the motion.
    fn saddle(&self) -> Option<f64> {
        let n = self.system.n();
        let first = 2 * (n + 1);
        let free = if self.system.is_plane() { 1 } else { n };
        for (k, stages) in self.path.stages.iter().enumerate() {
            for stage in stages {
                let (_, second) = self.system.curvatures(&stage.y, &stage.z);
                let bent = (0..free).map(|i| {
                    let row = &second[first + i][first..first + free];
                    row.iter().map(|x| -x).collect()
                });
                if Cholesky::new(&bent.collect()).is_err() {
                    return Some(self.time() * k as f64 / self.stretches() as f64);
                }
            }
        }
        None
    }

    /// Jacobi's condition: extremals that lead to the end, from whatever state, do not intersect before it. In the states
    /// (q, W) their family has n parameters besides time, and its Jacobian vanishes where they intersect.
    fn conjugate(&self) -> Option<f64> {
        let (system, path) = (&self.system, &self.path);
        let n = system.n();
        let (m, last) = (n + 1, self.stretches());
        let moment = |k: usize| self.time() * k as f64 / last as f64;
        let Some(transitions) = path.transitions(system) else {
            return Some(moment(last));
        };
        if let Some(level) = &path.level {
            return self.conjugate_to_start(&transitions, level).map(moment);
        }
        // At the end q is fixed and λ is 0; p and W vary such that H stays 1.
        let (_, slopes) = system.slopes(&path.nodes[last], &path.last);
        let free: Vec<usize> = (n..m + n).collect();
        let greatest = |k: &usize| (slopes[*k] * path.nodes[last][*k]).abs();
        let by_size = |a: &usize, b: &usize| greatest(a).total_cmp(&greatest(b));
        let tied = free.iter().copied().max_by(by_size)?;
        let mut family: Vec<Vec<f64>> = Vec::new();
        for k in free.into_iter().filter(|k| *k != tied) {
            let mut change = std::vec![0.0; 2 * m];
            (change[k], change[tied]) = (1.0, -slopes[k] / slopes[tied]);
            family.push(change);
        }
        let mut sign = None;
        for k in (1..last).rev() {
            let Some(factors) = Lu::new(transitions[k].clone()) else {
                return Some(moment(k));
            };
            family = family.iter().map(|change| factors.solve(change)).collect();
            let (_, slopes) = system.slopes(&path.nodes[k], &path.stages[k][0].z);
            let mut columns: Vec<Vec<f64>> = family.iter().map(|y| y[..m].to_vec()).collect();
            columns.push(slopes[m..2 * m].to_vec());
            let Some(positive) = Lu::new(columns).map(|factors| factors.is_positive()) else {
                return Some(moment(k));
            };
            if *sign.get_or_insert(positive) != positive {
                return Some(moment(k));
            }
        }
        None
    }

    /// Jacobi's condition for a conservative motion that ends at rest: it can be reversed, so extremals from the start are
    /// examined, which all have its energy. They differ by their multipliers p, except for the multiple of `∂V` that has no
    /// effect, and n vectors in configuration space, q̇ among them, must stay independent.
    fn conjugate_to_start(&self, transitions: &[Vec<Vec<f64>>], level: &Level) -> Option<usize> {
        let (system, path) = (&self.system, &self.path);
        let n = system.n();
        let m = n + 1;
        let by_size = |i: &usize, j: &usize| level.from[*i].abs().total_cmp(&level.from[*j].abs());
        let steepest = (0..n).max_by(by_size)?;
        let unit = |i: usize| -> Vec<f64> {
            (0..2 * m)
                .map(|k| if k == m + i { 1.0 } else { 0.0 })
                .collect()
        };
        let mut family: Vec<Vec<f64>> = (0..n).filter(|i| *i != steepest).map(unit).collect();
        let mut sign = None;
        for (k, transition) in transitions[..transitions.len() - 1].iter().enumerate() {
            let forward = |change: &Vec<f64>| -> Vec<f64> {
                transition.iter().map(|row| dot(row, change)).collect()
            };
            family = family.iter().map(forward).collect();
            let (_, slopes) = system.slopes(&path.nodes[k + 1], &path.stages[k + 1][0].z);
            let mut columns: Vec<Vec<f64>> = family.iter().map(|y| y[..n].to_vec()).collect();
            columns.push(slopes[m..m + n].to_vec());
            let Some(positive) = Lu::new(columns).map(|factors| factors.is_positive()) else {
                return Some(k + 1);
            };
            if *sign.get_or_insert(positive) != positive {
                return Some(k + 1);
            }
        }
        None
    }
}
