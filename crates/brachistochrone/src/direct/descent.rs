//! Polygons of least time, which serve as starts of Newton's method.
//!
//! Along a piece from q to q + Δ the velocity is `Δ σ̇`. With the kinetic energy `K = ½ Δ·A Δ σ̇²` the balance (8) is
//!
//! ```text
//! dK/dσ = −ρ        ρ = Δ·R(q, Δ σ̇) − ½ σ̇² Δ·∂A[Δ] Δ                                          (11)
//! ```
//!
//! At a corner W of (9) is continuous, so a turn by y in the metric S multiplies K by `exp(−2 κ y)`. The time of a
//! piece is `2/(σ̇₀ + σ̇₁)`, exact for constant coefficients, otherwise of second order in its length.
//!
//! The corners are moved to minimize N times the sum of the squares of the N times. This is at least the square of the total time,
//! with equality where all times are equal: so pieces become equal in time, and the minimum is the fastest polygon of N pieces. The
//! minimization uses the method of Broyden, Fletcher, Goldfarb and Shanno, J. Nocedal and S. J. Wright, *Numerical Optimization*
//! (2006), alg. 7.4, starting from the Hessian for masses and speeds that do not depend on position.
//!
//! A polygon that the machine cannot traverse from rest is given an initial speed, which is reduced while the polygon improves.

use lagrangian_scalar::{Dual, Scalar};

use super::Terrain;
use super::budget::Counted;
use crate::linear::{Cholesky, Matrix, dot};

/// Armijo's condition: the decrease must be at least this fraction of the decrease that the slope predicts.
const ENOUGH: f64 = 1e-4;

/// A step moves no corner by more than this fraction of the length of the polygon, so that it does not skip over obstacles.
const REACH: f64 = 0.2;

/// How many times a step may be halved.
const HALVINGS: usize = 25;

/// How many times the added energy may be reduced.
const ROUNDS: usize = 40;

/// Fractions of the added energy to try next, the smallest first.
const LESS: [f64; 6] = [0.0, 0.25, 0.5, 0.75, 0.9, 0.97];

/// A reduction of the added energy may increase the squared time by at most this factor.
const WORSE: f64 = 4.0;

/// How many times the pieces are halved to compute the lacking energy.
const FINE: usize = 4;

/// A polygon in configuration space.
#[derive(Clone, Debug)]
pub struct Polygon {
    /// The corners, including both ends.
    pub places: Vec<Vec<f64>>,
}

/// The motion along a polygon.
#[derive(Clone, Debug)]
pub struct Traversal {
    /// The time of each piece, in s.
    pub times: Vec<f64>,
    /// The kinetic energy at the end of each piece, in J, including the added energy.
    energies: Vec<f64>,
}

impl Traversal {
    /// The objective, in s².
    fn objective(&self) -> f64 {
        self.times.len() as f64 * self.times.iter().map(|t| t * t).sum::<f64>()
    }

    /// The total time, in s.
    pub fn time(&self) -> f64 {
        self.times.iter().sum()
    }
}

/// Why a polygon was not traversed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop {
    /// This energy, in J, is lacking at the start; infinite if no initial speed suffices.
    Lacks(f64),
    /// The budget is exhausted.
    Spent,
}

impl Polygon {
    /// The same polygon with each piece halved.
    pub fn halved(&self) -> Polygon {
        let mut places = std::vec![self.places[0].clone()];
        for pair in self.places.windows(2) {
            let middle = pair[0].iter().zip(&pair[1]).map(|(a, b)| 0.5 * (a + b));
            places.push(middle.collect());
            places.push(pair[1].clone());
        }
        Polygon { places }
    }

    fn displaced(&self, step: &[f64], part: f64) -> Polygon {
        let n = self.places[0].len();
        let mut places = self.places.clone();
        let last = places.len() - 1;
        for (place, step) in places[1..last].iter_mut().zip(step.chunks(n)) {
            place.iter_mut().zip(step).for_each(|(x, d)| *x += part * d);
        }
        Polygon { places }
    }
}

/// A machine that traverses polygons.
#[derive(Debug)]
pub struct Descent<'a, T> {
    terrain: Counted<'a, T>,
    /// Whether turns change the speed, because friction depends on them.
    rough: bool,
    /// Whether polygons end at rest, because there are no losses and the end is level with the start.
    level: bool,
}

impl<'a, T: Terrain> Descent<'a, T> {
    pub fn new(terrain: Counted<'a, T>, rough: bool, level: bool) -> Self {
        let rough = rough && terrain.coordinates() == 2;
        Descent {
            terrain,
            rough,
            level,
        }
    }

    /// The time of a piece, and the energy at its end. `kinetic` is `None` at rest, `before` is `None` where the
    /// piece has no corner at its start.
    fn piece<N: Scalar>(
        &self,
        kinetic: Option<N>,
        before: Option<&[N]>,
        start: &[N],
        end: &[N],
    ) -> [N; 2] {
        let number = N::from_f64;
        let (half, two) = (number(0.5), number(2.0));
        let along: Vec<N> = start.iter().zip(end).map(|(a, b)| *b - *a).collect();
        let kinetic = match (kinetic, before) {
            (Some(kinetic), Some(before)) if self.rough => {
                kinetic * self.energy_factor_of_corner(before, start, &along)
            }
            _ => kinetic.unwrap_or(N::ZERO),
        };
        let rests = kinetic.to_f64() == 0.0;
        let middle: Vec<Dual<N>> = start
            .iter()
            .zip(end)
            .zip(&along)
            .map(|((a, b), d)| Dual {
                value: half * (*a + *b),
                derivative: *d,
            })
            .collect();
        let n = along.len();
        let mut mass = Dual::ZERO;
        for (k, entry) in self.terrain.inertia(&middle).iter().enumerate() {
            mass = mass + *entry * Dual::constant(along[k / n] * along[k % n]);
        }
        let place: Vec<N> = middle.iter().map(|x| x.value).collect();
        let against = |square: N, rate: N| {
            let v: Vec<N> = along.iter().map(|d| *d * rate).collect();
            let resistance = self.terrain.resistance(&place, &v);
            let work = along.iter().zip(&resistance);
            let work = work.fold(N::ZERO, |sum, (d, r)| sum + *d * *r);
            work - half * square * mass.derivative
        };
        // The rate follows from the energy by a square root, whose slope is infinite at rest.
        let square = |energy: N| two * energy / mass.value;
        let first = if rests {
            N::ZERO
        } else {
            square(kinetic).sqrt()
        };
        let half_way = kinetic - half * against(first * first, first);
        let between = square(half_way);
        let after = kinetic - against(between, between.sqrt());
        let last = square(after).sqrt();
        [two / (first + last), after]
    }

    /// The time of a piece that ends at rest.
    fn stopping<N: Scalar>(&self, kinetic: N, start: &[N], end: &[N]) -> N {
        let n = start.len();
        let half = N::from_f64(0.5);
        let middle: Vec<N> = start
            .iter()
            .zip(end)
            .map(|(a, b)| half * (*a + *b))
            .collect();
        let along: Vec<N> = start.iter().zip(end).map(|(a, b)| *b - *a).collect();
        let inertia = self.terrain.inertia(&middle);
        let mass = (0..n * n).fold(N::ZERO, |sum, k| {
            sum + inertia[k] * along[k / n] * along[k % n]
        });
        let two = N::from_f64(2.0);
        two / (two * kinetic / mass).sqrt()
    }

    /// The factor by which a corner changes the energy.
    fn energy_factor_of_corner<N: Scalar>(&self, before: &[N], corner: &[N], along: &[N]) -> N {
        let inertia = self.terrain.inertia(corner);
        let came = [corner[0] - before[0], corner[1] - before[1]];
        let half = N::from_f64(0.5);
        let even = half * (inertia[1] + inertia[2]);
        let skew = half * (inertia[1] - inertia[2]);
        let root = (inertia[0] * inertia[3] - even * even).sqrt();
        let ahead = came[0] * (inertia[0] * along[0] + even * along[1])
            + came[1] * (even * along[0] + inertia[3] * along[1]);
        let aside = root * (came[0] * along[1] - came[1] * along[0]);
        let turn = aside.atan2(ahead);
        (-(turn + turn) * skew / root).exp()
    }

    /// The motion along a polygon with this energy at the start; `None` where it stops on the way.
    fn traversal(&self, polygon: &Polygon, added: f64) -> Option<Traversal> {
        let mut traversal = Traversal {
            times: Vec::new(),
            energies: Vec::new(),
        };
        let mut kinetic = Some(added).filter(|added| *added > 0.0);
        for (k, pair) in polygon.places.windows(2).enumerate() {
            let before = k.checked_sub(1).map(|k| polygon.places[k].as_slice());
            let [mut time, mut after] = self.piece(kinetic, before, &pair[0], &pair[1]);
            // At the end the kinetic energy is 0 by conservation, whatever the approximate sum over the pieces is.
            if self.level
                && added == 0.0
                && k + 2 == polygon.places.len()
                && let Some(kinetic) = kinetic
            {
                time = self.stopping(kinetic, &pair[0], &pair[1]);
                after = f64::MIN_POSITIVE;
            }
            if !(time > 0.0 && time.is_finite() && after > 0.0 && after.is_finite()) {
                return None;
            }
            traversal.times.push(time);
            traversal.energies.push(after);
            kinetic = Some(after);
        }
        traversal.objective().is_finite().then_some(traversal)
    }

    /// Derivatives of the objective by the inner corners.
    fn slopes(&self, polygon: &Polygon, added: f64, traversal: &Traversal) -> Vec<f64> {
        let n = polygon.places[0].len();
        let count = traversal.times.len();
        let mut slopes = std::vec![0.0; (count + 1) * n];
        // The derivative of the objective by the energy at the end of a piece.
        let mut by_energy = 0.0;
        for k in (0..count).rev() {
            let mut numbers: Vec<Dual<f64>> = Vec::new();
            let first = if self.rough { k.saturating_sub(1) } else { k };
            for place in &polygon.places[first..=k + 1] {
                numbers.extend(place.iter().map(|x| Dual::constant(*x)));
            }
            let (energy, moves) = match k {
                0 => (added, false),
                _ => (traversal.energies[k - 1], true),
            };
            let weight = 2.0 * count as f64 * traversal.times[k];
            let slope = |numbers: &[Dual<f64>], by: f64| {
                let kinetic = (energy > 0.0).then_some(Dual {
                    value: energy,
                    derivative: by,
                });
                let (before, rest) = numbers.split_at((k - first) * n);
                let (start, end) = rest.split_at(n);
                let before = (!before.is_empty()).then_some(before);
                if self.level
                    && added == 0.0
                    && k + 1 == count
                    && let Some(kinetic) = kinetic
                {
                    return weight * self.stopping(kinetic, start, end).derivative;
                }
                let [time, after] = self.piece(kinetic, before, start, end);
                weight * time.derivative + by_energy * after.derivative
            };
            for i in 0..numbers.len() {
                let place = first + i / n;
                if place > 0 && place < count {
                    numbers[i].derivative = 1.0;
                    slopes[first * n + i] += slope(&numbers, 0.0);
                    numbers[i].derivative = 0.0;
                }
            }
            by_energy = if moves { slope(&numbers, 1.0) } else { 0.0 };
        }
        slopes[n..count * n].to_vec()
    }

    /// The Hessian for masses and speeds that do not depend on position.
    fn stiffness(&self, polygon: &Polygon, traversal: &Traversal) -> Option<Cholesky> {
        let n = polygon.places[0].len();
        let count = traversal.times.len();
        let size = (count - 1) * n;
        let mut matrix: Matrix = std::vec![std::vec![0.0; size]; size];
        for (k, pair) in polygon.places.windows(2).enumerate() {
            let middle: Vec<f64> = pair[0]
                .iter()
                .zip(&pair[1])
                .map(|(a, b)| 0.5 * (a + b))
                .collect();
            let along: Vec<f64> = pair[0].iter().zip(&pair[1]).map(|(a, b)| b - a).collect();
            let inertia = self.terrain.inertia(&middle);
            let mass: f64 = (0..n * n)
                .map(|e| inertia[e] * along[e / n] * along[e % n])
                .sum();
            let weight = 2.0 * count as f64 * traversal.times[k] * traversal.times[k] / mass;
            for i in 0..n {
                for j in 0..n {
                    let entry = 0.5 * weight * (inertia[i * n + j] + inertia[j * n + i]);
                    let mut add = |a: usize, b: usize, sign: f64| {
                        let inner = 1..count;
                        if inner.contains(&a) && inner.contains(&b) {
                            matrix[(a - 1) * n + i][(b - 1) * n + j] += sign * entry;
                        }
                    };
                    add(k, k, 1.0);
                    add(k + 1, k + 1, 1.0);
                    add(k, k + 1, -1.0);
                    add(k + 1, k, -1.0);
                }
            }
        }
        Cholesky::new(&matrix).ok()
    }

    /// The longest displacement of a corner, relative to the length of the polygon.
    fn longest_displacement(&self, polygon: &Polygon, step: &[f64]) -> f64 {
        let n = polygon.places[0].len();
        let inertia = self
            .terrain
            .inertia(&polygon.places[polygon.places.len() / 2]);
        let length = |d: &[f64]| -> f64 {
            let square: f64 = (0..n * n).map(|k| inertia[k] * d[k / n] * d[k % n]).sum();
            square.max(0.0).sqrt()
        };
        let pieces = polygon.places.windows(2).map(|pair| {
            let along: Vec<f64> = pair[0].iter().zip(&pair[1]).map(|(a, b)| b - a).collect();
            length(&along)
        });
        let total: f64 = pieces.sum();
        step.chunks(n).map(length).fold(0.0, f64::max) / total
    }

    /// Improves a polygon with this energy at the start until its objective is within this fraction of the local minimum,
    /// or for this many steps.
    fn improve(
        &self,
        polygon: &mut Polygon,
        traversal: &mut Traversal,
        added: f64,
        part: f64,
        steps: usize,
    ) -> Result<(), Stop> {
        let mut history: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
        if polygon.places.len() < 3 {
            return Ok(());
        }
        let mut slopes = self.slopes(polygon, added, traversal);
        for _ in 0..steps {
            if self.terrain.budget.is_spent() {
                return Err(Stop::Spent);
            }
            let Some(stiffness) = self.stiffness(polygon, traversal) else {
                return Ok(());
            };
            let step = direction(&stiffness, &history, &slopes);
            let gain = -dot(&slopes, &step);
            if gain.is_nan() || gain <= part * traversal.objective() {
                return Ok(());
            }
            let mut share = (REACH / self.longest_displacement(polygon, &step)).min(1.0);
            let mut accepted = None;
            for _ in 0..HALVINGS {
                let next = polygon.displaced(&step, share);
                let walk_there = self.traversal(&next, added);
                let least = traversal.objective() - ENOUGH * share * gain;
                if let Some(there) = walk_there.filter(|there| there.objective() <= least) {
                    accepted = Some((next, there));
                    break;
                }
                share *= 0.5;
            }
            let Some((next, there)) = accepted else {
                if history.is_empty() {
                    return Ok(()); // Round-off is reached.
                }
                history.clear();
                continue;
            };
            (*polygon, *traversal) = (next, there);
            let after = self.slopes(polygon, added, traversal);
            let moved: Vec<f64> = step.iter().map(|d| share * d).collect();
            let change: Vec<f64> = after.iter().zip(&slopes).map(|(a, b)| a - b).collect();
            if dot(&moved, &change) > 1e-8 * share * gain {
                history.push((moved, change));
            }
            slopes = after;
        }
        Ok(())
    }

    /// Changes a polygon until the machine can traverse it from rest.
    ///
    /// # Errors
    /// If that is not possible, or the budget is exhausted.
    pub fn made_traversable(&self, polygon: &mut Polygon) -> Result<Traversal, Stop> {
        let rest = std::vec![0.0; polygon.places[0].len()];
        let works = polygon.places.windows(2).map(|pair| {
            let middle: Vec<f64> = pair[0]
                .iter()
                .zip(&pair[1])
                .map(|(a, b)| 0.5 * (a + b))
                .collect();
            let force = self.terrain.resistance(&middle, &rest);
            let parts = pair[1].iter().zip(&pair[0]).zip(&force);
            parts.map(|((b, a), f)| (b - a) * f).sum::<f64>().abs()
        });
        let scale: f64 = works.sum();
        if !(scale > 0.0 && scale.is_finite()) {
            return Err(Stop::Lacks(f64::INFINITY));
        }
        let mut added = 0.0;
        let mut traversal = self.traversal(polygon, added);
        while traversal.is_none() {
            added = if added == 0.0 {
                scale / 16.0
            } else {
                2.0 * added
            };
            if added > 1e6 * scale {
                return Err(Stop::Lacks(f64::INFINITY));
            }
            traversal = self.traversal(polygon, added);
        }
        let Some(mut traversal) = traversal else {
            return Err(Stop::Lacks(added));
        };
        for round in 0..=ROUNDS {
            if added == 0.0 {
                return Ok(traversal);
            }
            if round == ROUNDS {
                break;
            }
            self.improve(polygon, &mut traversal, added, 1e-3, 15)?;
            let bound = WORSE * traversal.objective();
            let borne = |part: &f64| {
                let there = self.traversal(polygon, part * added)?;
                (there.objective() < bound).then_some((part * added, there))
            };
            match LESS.iter().find_map(borne) {
                Some(less) => (added, traversal) = less,
                None => break,
            }
        }
        Err(Stop::Lacks(self.missing_energy(polygon, added)))
    }

    /// An estimate of the energy without which a polygon cannot be traversed. Long pieces skip over obstacles, so it is
    /// computed with short ones.
    fn missing_energy(&self, polygon: &Polygon, added: f64) -> f64 {
        let fine = (0..FINE).fold(polygon.clone(), |polygon, _| polygon.halved());
        let energies = (0..10).map(|k| added * f64::from(1 << k));
        let walks = energies.map(|added| (added, self.traversal(&fine, added)));
        for (added, traversal) in walks {
            if let Some(traversal) = traversal {
                return added
                    - traversal
                        .energies
                        .iter()
                        .fold(f64::INFINITY, |least, k| least.min(*k));
            }
        }
        f64::INFINITY
    }

    /// Improves a polygon that can be traversed from rest to the fastest one nearby, as far as its number of pieces allows.
    ///
    /// # Errors
    /// If it cannot be traversed, or the budget is exhausted.
    pub fn fastest(&self, polygon: &mut Polygon) -> Result<Traversal, Stop> {
        let mut traversal = self.traversal(polygon, 0.0).ok_or(Stop::Lacks(0.0))?;
        self.improve(polygon, &mut traversal, 0.0, 1e-7, 150)?;
        Ok(traversal)
    }
}

/// The quasi-Newton direction, by the two-loop recursion over stored updates.
fn direction(stiffness: &Cholesky, history: &[(Vec<f64>, Vec<f64>)], slopes: &[f64]) -> Vec<f64> {
    let mut step: Vec<f64> = slopes.iter().map(|g| -g).collect();
    let mut parts = Vec::new();
    for (moved, change) in history.iter().rev() {
        let part = dot(moved, &step) / dot(moved, change);
        step.iter_mut()
            .zip(change)
            .for_each(|(x, y)| *x -= part * y);
        parts.push(part);
    }
    step = stiffness.solve(&step);
    for ((moved, change), part) in history.iter().zip(parts.iter().rev()) {
        let back = dot(change, &step) / dot(moved, change);
        step.iter_mut()
            .zip(moved)
            .for_each(|(x, s)| *x += (part - back) * s);
    }
    step
}
