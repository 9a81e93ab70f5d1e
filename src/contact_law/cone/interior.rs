//! Contacts with friction cones by a sequence of convex problems.
//!
//! With the rates `w = γ + μ |γₜ| n`, whose normal parts are larger by the slip, forces and rates of a contact are in dual cones of revolution,
//!
//! ```text
//! Λ ∈ K,   γ + s n ∈ K*,   Λ·(γ + s n) = 0,   s = μ |γₜ|,      K = {Λₙ ≥ 0, |Λₜ| ≤ μ Λₙ}
//! ```
//!
//! For given numbers `s ≥ 0` that is a convex problem, the least of `½ Λ·GΛ + (b + s n)·Λ` on K: solvable whenever some motion opens all contacts, and with
//! unique rates even if contacts depend on each other. The numbers s are then those of these rates, until they change no more (V. Acary, F. Cadoux, C. Lemaréchal,
//! J. Malick, Z. Angew. Math. Mech. 91 (2011) 155–175). Newton's method on the whole problem begins at each of the solutions and ends most searches early.
//!
//! A convex problem is solved by a primal-dual interior-point method, whose scaling and steps are those of [`revolution`](super::super::revolution). Its matrix is that of the
//! contacts and a positive definite one, so that it is regular, however the contacts depend on each other.

use std::vec::Vec;

use super::super::revolution::{SHARE_OF_WAY, Scaling, Triple, corrected_right_side, way_to_edge};
use super::{Disc, Part, Problem};
use crate::implicit::lu::Lu;

/// The most steps of the interior-point method; some 12 are usual.
const STEPS: usize = 40;

/// The mean product of forces and rates with which a convex problem is solved, relative to the product of those of the start. Where a contact neither presses nor
/// opens, or sticks with all of its friction, forces and rates are no better known than the square root of it.
const SOLVED: f64 = 1e-22;

/// The error of the rates with which it is solved, relative to the greatest one.
const EXACT: f64 = 1e-13;

/// Slips below this, relative to the greatest rate, are rounding.
const LEAST_SLIP: f64 = 1e-14;

/// The cosine of the angle between two changes of slips that are alike, and how many times as far as the last one the next one may be taken.
const ALIKE: f64 = 0.9;
const FARTHEST_AHEAD: f64 = 1024.0;

/// A cone: the places of a normal force and of up to two tangential ones, its dimension.
#[derive(Clone, Copy, Debug)]
struct Cone {
    places: [usize; 3],
    dimension: usize,
}

/// Memory for the convex problems.
#[derive(Clone, Debug, Default)]
pub(super) struct Interior {
    cones: Vec<Cone>,
    /// What the unknowns of the problem are multiples of, and what the rates are multiplied by: in these units friction cones are right circular ones, and the
    /// matrix is symmetric.
    force_units: Vec<f64>,
    rate_units: Vec<f64>,
    matrix: Vec<f64>,
    b: Vec<f64>,
    /// By how much the slip enlarges the normal rates.
    enlarged: Vec<f64>,
    /// By how much that has changed last, and how many times as much is added to it.
    changed: Vec<f64>,
    ahead: f64,
    x: Vec<f64>,
    w: Vec<f64>,
    rates: Vec<f64>,
    missing: Vec<f64>,
    newton: Vec<f64>,
    lu: Lu<1>,
    change: Vec<f64>,
    change_of_rates: Vec<f64>,
    scaled: Vec<ScaledCone>,
}

/// A cone as it is scaled.
#[derive(Clone, Copy, Debug, Default)]
struct ScaledCone {
    scaling: Scaling,
    /// What forces and rates are scaled to.
    lambda: Triple,
    /// The scaled changes of rates and forces in a step.
    changes: [Triple; 2],
    /// The direction of the slip where that enlarges the normal rate as it changes.
    along: Triple,
}

impl Interior {
    /// Takes a problem, if its forces and rates are in dual cones: if each friction force is bounded by one unknown normal force.
    pub fn begin(&mut self, problem: &Problem) -> bool {
        let n = problem.n();
        self.cones.clear();
        for part in &problem.parts {
            match *part {
                Part::Normal(i) => self.cones.push(Cone {
                    places: [i; 3],
                    dimension: 1,
                }),
                Part::Disc(Disc {
                    places,
                    count,
                    on: Some(on),
                    friction,
                    known_normal: 0.0,
                }) if friction > 0.0 => {
                    let Some(cone) = self.cones.iter_mut().find(|cone| cone.places[0] == on) else {
                        return false;
                    };
                    if cone.dimension > 1 {
                        return false;
                    }
                    cone.places[1..].copy_from_slice(&places);
                    cone.dimension = 1 + count;
                }
                Part::Disc(_) => return false,
            }
        }
        if self.cones.iter().map(|cone| cone.dimension).sum::<usize>() != n {
            return false;
        }
        self.force_units.clear();
        self.force_units
            .extend(problem.units.iter().map(|unit| 1.0 / unit.sqrt()));
        for part in &problem.parts {
            if let Part::Disc(Disc {
                places,
                on: Some(on),
                friction,
                ..
            }) = *part
            {
                self.force_units[on] = self.force_units[places[0]] / friction;
            }
        }
        self.rate_units.clear();
        let pairs = self.force_units.iter().zip(&problem.units);
        self.rate_units.extend(pairs.map(|(own, unit)| own * unit));
        self.matrix.clear();
        for (i, row) in problem.matrix.chunks_exact(n).enumerate() {
            let pairs = row.iter().zip(&self.force_units);
            let scale = self.rate_units[i];
            self.matrix.extend(pairs.map(|(a, own)| scale * a * own));
        }
        self.b.clear();
        let pairs = self.rate_units.iter().zip(&problem.b);
        self.b.extend(pairs.map(|(own, b)| own * b));
        self.enlarged.clear();
        self.enlarged.resize(self.cones.len(), 0.0);
        self.changed.clear();
        self.changed.resize(self.cones.len(), 0.0);
        self.ahead = 1.0;
        // Loads that sum shares of other forces have no symmetric matrix.
        let symmetric = |i: usize, j: usize| {
            let (a, b) = (self.matrix[i * n + j], self.matrix[j * n + i]);
            let size = (self.matrix[i * n + i] * self.matrix[j * n + j]).sqrt();
            (a - b).abs() <= 1e-12 * size
        };
        (0..n).all(|i| (0..i).all(|j| symmetric(i, j)))
    }

    /// Solves the next convex problem and writes its forces, in the units of the problem: as well as rounding permits.
    pub fn next(&mut self, z: &mut [f64], is_coupled: bool) {
        let size = self.b.iter().fold(0.0_f64, |size, b| size.max(b.abs()));
        self.solve(size, is_coupled);
        self.enlarge(size, is_coupled);
        for ((z, x), unit) in z.iter_mut().zip(&self.x).zip(&self.force_units) {
            *z = x * unit;
        }
    }

    /// Makes the slips of the last problem the numbers s of the next one. As long as they change by about the same from one problem to the next, they are taken
    /// ever farther ahead: where a slip hardly changes the forces the sequence would converge slowly.
    fn enlarge(&mut self, size: f64, is_coupled: bool) {
        let n = self.b.len();
        let (mut product, mut squares) = (0.0, [0.0; 2]);
        for k in 0..self.cones.len() {
            let cone = self.cones[k];
            let rate = |i: usize| self.b[i] + super::dot(&self.matrix[i * n..][..n], &self.x);
            let tangents = cone.places[1..cone.dimension].iter();
            let slip = tangents.fold(0.0_f64, |slip, i| slip.hypot(rate(*i)));
            let slip = if slip > LEAST_SLIP * size { slip } else { 0.0 };
            let change = slip - self.enlarged[k];
            product += change * self.changed[k];
            squares[0] += change * change;
            squares[1] += self.changed[k] * self.changed[k];
            self.changed[k] = change;
        }
        let is_alike = product > ALIKE * (squares[0] * squares[1]).sqrt();
        self.ahead = if is_alike && !is_coupled {
            (4.0 * self.ahead).min(FARTHEST_AHEAD)
        } else {
            (0.25 * self.ahead).max(1.0)
        };
        for (enlarged, change) in self.enlarged.iter_mut().zip(&self.changed) {
            *enlarged = (*enlarged + self.ahead * change).max(0.0);
        }
    }

    fn solve(&mut self, size: f64, is_coupled: bool) {
        let n = self.b.len();
        for vector in [
            &mut self.x,
            &mut self.w,
            &mut self.rates,
            &mut self.missing,
            &mut self.change,
            &mut self.change_of_rates,
        ] {
            vector.clear();
            vector.resize(n, 0.0);
        }
        self.scaled.clear();
        self.scaled.resize(self.cones.len(), ScaledCone::default());
        // Forces that give rates about as large as those that are known.
        let diagonal = (0..n).fold(0.0_f64, |most, i| most.max(self.matrix[i * n + i]));
        if size <= 0.0 || diagonal <= 0.0 {
            return;
        }
        for cone in &self.cones {
            self.x[cone.places[0]] = size / diagonal;
            self.w[cone.places[0]] = size;
        }
        let count = self.cones.len() as f64;
        for _ in 0..STEPS {
            // What is missing of `w = M x + b + s n`.
            for i in 0..n {
                let row = &self.matrix[i * n..][..n];
                self.rates[i] = self.b[i] + super::dot(row, &self.x);
            }
            for (k, cone) in self.cones.iter().enumerate() {
                let mut along = [0.0; 3];
                if is_coupled {
                    let w = cone.read(&self.w);
                    let slip = w[1].hypot(w[2]);
                    self.enlarged[k] = slip;
                    if slip > 0.0 {
                        along = [0.0, w[1] / slip, w[2] / slip];
                    }
                }
                self.scaled[k].along = along;
                self.rates[cone.places[0]] += self.enlarged[k];
            }
            let mut product = 0.0;
            let mut error = 0.0_f64;
            for i in 0..n {
                self.missing[i] = self.rates[i] - self.w[i];
                error = error.max(self.missing[i].abs());
                product += self.x[i] * self.w[i];
            }
            let mean = product / count;
            let is_solved = mean * diagonal <= SOLVED * size * size && error <= EXACT * size;
            if is_solved || !mean.is_finite() || !self.scale() || !self.factor() {
                return;
            }
            // First towards the solution itself, which tells how far the step can go; then towards the centre of the part that remains.
            self.solve_for_change(0.0, false);
            let far = self.length_of_step().min(1.0);
            let share = (1.0 - far).powi(3);
            self.solve_for_change(share * mean, true);
            let length = (SHARE_OF_WAY * self.length_of_step()).min(1.0);
            for i in 0..n {
                self.x[i] += length * self.change[i];
                self.w[i] += length * self.change_of_rates[i];
            }
        }
    }

    /// Finds the scaling of each cone; whether forces and rates are inside.
    fn scale(&mut self) -> bool {
        for (cone, own) in self.cones.iter().zip(&mut self.scaled) {
            let (x, w) = (cone.read(&self.x), cone.read(&self.w));
            let Some(scaling) = Scaling::new(w, x) else {
                return false;
            };
            own.scaling = scaling;
            own.lambda = scaling.times(x);
        }
        true
    }

    /// Factors `T M + W²`, where T adds to each normal rate what its slip changes; whether it is regular.
    fn factor(&mut self) -> bool {
        let n = self.b.len();
        self.newton.clear();
        self.newton.extend_from_slice(&self.matrix);
        for (cone, own) in self.cones.iter().zip(&self.scaled) {
            for (&i, along) in cone.places[..cone.dimension].iter().zip(own.along) {
                if along == 0.0 {
                    continue;
                }
                let to = &mut self.newton[cone.places[0] * n..][..n];
                for (to, from) in to.iter_mut().zip(&self.matrix[i * n..][..n]) {
                    *to += along * from;
                }
            }
            for (k, &j) in cone.places[..cone.dimension].iter().enumerate() {
                let mut unit = [0.0; 3];
                unit[k] = 1.0;
                let column = own.scaling.times(own.scaling.times(unit));
                for (&i, entry) in cone.places[..cone.dimension].iter().zip(column) {
                    self.newton[i * n + j] += entry;
                }
            }
        }
        super::factor_rows(&self.newton, n, &mut self.lu)
    }

    /// The step to products of forces and rates of this size, corrected by the products of the last step if `is_corrected`.
    fn solve_for_change(&mut self, target: f64, is_corrected: bool) {
        let n = self.b.len();
        // `W dx + W⁻¹ dw = λ \ d` and `dw = T (M dx + missing)`.
        for (cone, own) in self.cones.iter().zip(&self.scaled) {
            let changes = if is_corrected {
                own.changes
            } else {
                [[0.0; 3]; 2]
            };
            let right = corrected_right_side(own.lambda, target, changes);
            let wanted = own.scaling.times(right);
            for (&i, wanted) in cone.places[..cone.dimension].iter().zip(wanted) {
                self.change_of_rates[i] = wanted;
            }
        }
        for i in 0..n {
            self.change[i] = self.change_of_rates[i] - self.missing[i];
        }
        for (cone, own) in self.cones.iter().zip(&self.scaled) {
            let more = super::dot(&own.along, &cone.read(&self.missing));
            self.change[cone.places[0]] -= more;
        }
        self.lu.solve([&mut self.change]);
        for (cone, own) in self.cones.iter().zip(&mut self.scaled) {
            let change = own.scaling.times(cone.read(&self.change));
            let squared = own.scaling.times(change);
            for (&i, squared) in cone.places[..cone.dimension].iter().zip(squared) {
                self.change_of_rates[i] -= squared;
            }
            let of_rates = own.scaling.inverse_times(cone.read(&self.change_of_rates));
            own.changes = [of_rates, change];
        }
    }

    /// How many times the step leads to the edge of a cone.
    fn length_of_step(&self) -> f64 {
        self.scaled.iter().fold(f64::INFINITY, |length, own| {
            let ways = own.changes.map(|change| way_to_edge(own.lambda, change));
            length.min(ways[0]).min(ways[1])
        })
    }
}

impl Cone {
    fn read(&self, x: &[f64]) -> Triple {
        let mut own = [0.0; 3];
        for (own, &i) in own.iter_mut().zip(&self.places[..self.dimension]) {
            *own = x[i];
        }
        own
    }
}
