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
//! A convex problem is solved by a primal-dual interior-point method with the scaling of Yu. E. Nesterov and M. J. Todd (SIAM J. Optim. 8 (1998) 324–364) and the
//! steps of S. Mehrotra (SIAM J. Optim. 2 (1992) 575–601); the formulas for cones of revolution are those of L. Vandenberghe (*The CVXOPT linear and quadratic cone
//! program solvers*, 2010). Its matrix is that of the contacts and a positive definite one, so that it is regular, however the contacts depend on each other.

use std::vec::Vec;

use super::{Part, Problem};

/// The most steps of the interior-point method; some 12 are usual.
const STEPS: usize = 40;

/// A step goes this share of the way to the edge of the cones.
const SHARE_OF_WAY: f64 = 0.99;

/// The mean product of forces and rates with which a convex problem is solved, relative to the product of those of the start. Where a contact neither presses nor
/// opens, or sticks with all of its friction, forces and rates are no better known than the square root of it.
const SOLVED: f64 = 1e-17;

/// The error of the rates with which it is solved, relative to the greatest one.
const EXACT: f64 = 1e-13;

/// Slips below this, relative to the greatest rate, are not known.
const LEAST_SLIP: f64 = 1e-7;

/// The cosine of the angle between two changes of slips that are alike, and how many times as far as the last one the next one may be taken.
const ALIKE: f64 = 0.9;
const FARTHEST_AHEAD: f64 = 1024.0;

/// A cone: the places of a normal force and of up to two tangential ones, its dimension.
#[derive(Clone, Copy, Debug)]
struct Cone {
    places: [usize; 3],
    dimension: usize,
}

/// Numbers of a cone, of which those beyond its dimension are 0.
type Triple = [f64; 3];

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
    factor: Vec<f64>,
    exchanges: Vec<usize>,
    change: Vec<f64>,
    change_of_rates: Vec<f64>,
    scalings: Vec<Scaling>,
}

/// The scaling of a cone: `W = β (2 v vᵀ − J)` with `W x = W⁻¹ w = λ`.
#[derive(Clone, Copy, Debug, Default)]
struct Scaling {
    beta: f64,
    v: Triple,
    lambda: Triple,
    /// The direction of the slip where that enlarges the normal rate as it changes.
    along: Triple,
}

impl Interior {
    /// Takes a problem, if its forces and rates are in dual cones: if each friction force leans on one unknown normal force.
    pub fn begin(&mut self, problem: &Problem) -> bool {
        let n = problem.n();
        self.cones.clear();
        for part in &problem.parts {
            match *part {
                Part::Normal(i) => self.cones.push(Cone {
                    places: [i; 3],
                    dimension: 1,
                }),
                Part::Disc {
                    places,
                    count,
                    on: Some(on),
                    friction,
                    known_normal,
                } if known_normal == 0.0 && friction > 0.0 => {
                    let Some(cone) = self.cones.iter_mut().find(|cone| cone.places[0] == on) else {
                        return false;
                    };
                    if cone.dimension > 1 {
                        return false;
                    }
                    cone.places[1..].copy_from_slice(&places);
                    cone.dimension = 1 + count;
                }
                Part::Disc { .. } => return false,
            }
        }
        if self.cones.iter().map(|cone| cone.dimension).sum::<usize>() != n {
            return false;
        }
        self.force_units.clear();
        self.force_units
            .extend(problem.units.iter().map(|unit| 1.0 / unit.sqrt()));
        for part in &problem.parts {
            if let Part::Disc {
                places,
                on: Some(on),
                friction,
                ..
            } = *part
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
        self.scalings.clear();
        self.scalings.resize(self.cones.len(), Scaling::default());
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
                self.scalings[k].along = along;
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
        for (cone, scaling) in self.cones.iter().zip(&mut self.scalings) {
            let (x, w) = (cone.read(&self.x), cone.read(&self.w));
            let [of_x, of_w] = [x, w].map(determinant);
            if !(of_x > 0.0 && of_w > 0.0 && x[0] > 0.0 && w[0] > 0.0) {
                return false;
            }
            let [root_x, root_w] = [of_x.sqrt(), of_w.sqrt()];
            let [unit_x, unit_w] = [x.map(|x| x / root_x), w.map(|w| w / root_w)];
            let gamma = (0.5 * (1.0 + super::dot(&unit_x, &unit_w))).sqrt();
            // The unit vector of `W²`, which maps x to w, and that of `W`.
            let mut v = [0, 1, 2].map(|i| {
                let sign = if i == 0 { 1.0 } else { -1.0 };
                (unit_w[i] + sign * unit_x[i]) / (2.0 * gamma)
            });
            let length = (2.0 * (v[0] + 1.0)).sqrt();
            v[0] += 1.0;
            v = v.map(|v| v / length);
            scaling.beta = (root_w / root_x).sqrt();
            scaling.v = v;
            scaling.lambda = scaling.times(x);
        }
        true
    }

    /// Factors `T M + W²`, where T adds to each normal rate what its slip changes; whether it is regular.
    fn factor(&mut self) -> bool {
        let n = self.b.len();
        self.factor.clear();
        self.factor.extend_from_slice(&self.matrix);
        for (cone, scaling) in self.cones.iter().zip(&self.scalings) {
            for (&i, along) in cone.places[..cone.dimension].iter().zip(scaling.along) {
                if along == 0.0 {
                    continue;
                }
                let to = &mut self.factor[cone.places[0] * n..][..n];
                for (to, from) in to.iter_mut().zip(&self.matrix[i * n..][..n]) {
                    *to += along * from;
                }
            }
            for (k, &j) in cone.places[..cone.dimension].iter().enumerate() {
                let mut unit = [0.0; 3];
                unit[k] = 1.0;
                let column = scaling.times(scaling.times(unit));
                for (&i, entry) in cone.places[..cone.dimension].iter().zip(column) {
                    self.factor[i * n + j] += entry;
                }
            }
        }
        super::factor(&mut self.factor, &mut self.exchanges)
    }

    /// The step to products of forces and rates of this size, corrected by the products of the last step if `is_corrected`.
    fn solve_for_change(&mut self, target: f64, is_corrected: bool) {
        let n = self.b.len();
        // `W dx + W⁻¹ dw = λ \ d` and `dw = T (M dx + missing)`.
        for (cone, scaling) in self.cones.iter().zip(&self.scalings) {
            let lambda = scaling.lambda;
            let mut right = product(lambda, lambda).map(|x| -x);
            if is_corrected {
                let own = scaling.times(cone.read(&self.change));
                let of_rates = scaling.inverse_times(cone.read(&self.change_of_rates));
                let second = product(own, of_rates);
                for (right, second) in right.iter_mut().zip(second) {
                    *right -= second;
                }
            }
            right[0] += target;
            let wanted = scaling.times(quotient(lambda, right));
            for (&i, wanted) in cone.places[..cone.dimension].iter().zip(wanted) {
                self.change_of_rates[i] = wanted;
            }
        }
        for i in 0..n {
            self.change[i] = self.change_of_rates[i] - self.missing[i];
        }
        for (cone, scaling) in self.cones.iter().zip(&self.scalings) {
            let more = super::dot(&scaling.along, &cone.read(&self.missing));
            self.change[cone.places[0]] -= more;
        }
        super::solve_factored(&self.factor, &self.exchanges, &mut self.change);
        for (cone, scaling) in self.cones.iter().zip(&self.scalings) {
            let squared = scaling.times(scaling.times(cone.read(&self.change)));
            for (&i, squared) in cone.places[..cone.dimension].iter().zip(squared) {
                self.change_of_rates[i] -= squared;
            }
        }
    }

    /// How many times the step leads to the edge of a cone.
    fn length_of_step(&self) -> f64 {
        let mut length = f64::INFINITY;
        for cone in &self.cones {
            for (x, by) in [(&self.x, &self.change), (&self.w, &self.change_of_rates)] {
                length = length.min(way_to_edge(cone.read(x), cone.read(by)));
            }
        }
        length
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

impl Scaling {
    /// `W x`.
    fn times(&self, x: Triple) -> Triple {
        let along = 2.0 * super::dot(&self.v, &x);
        [
            self.beta * (along * self.v[0] - x[0]),
            self.beta * (along * self.v[1] + x[1]),
            self.beta * (along * self.v[2] + x[2]),
        ]
    }

    /// `W⁻¹ x`.
    fn inverse_times(&self, x: Triple) -> Triple {
        let v = [self.v[0], -self.v[1], -self.v[2]];
        let along = 2.0 * super::dot(&v, &x);
        [
            (along * v[0] - x[0]) / self.beta,
            (along * v[1] + x[1]) / self.beta,
            (along * v[2] + x[2]) / self.beta,
        ]
    }
}

/// `x₀² − |x₁|²`, of which rounding takes no digits near the edge of the cone.
fn determinant(x: Triple) -> f64 {
    let length = x[1].hypot(x[2]);
    (x[0] - length) * (x[0] + length)
}

/// The product of the algebra of cones: `(x·y, x₀ y₁ + y₀ x₁)`.
fn product(x: Triple, y: Triple) -> Triple {
    [
        super::dot(&x, &y),
        x[0] * y[1] + y[0] * x[1],
        x[0] * y[2] + y[0] * x[2],
    ]
}

/// The y of which `product(x, y)` is this.
fn quotient(x: Triple, of: Triple) -> Triple {
    let first = (x[0] * of[0] - x[1] * of[1] - x[2] * of[2]) / determinant(x);
    [
        first,
        (of[1] - first * x[1]) / x[0],
        (of[2] - first * x[2]) / x[0],
    ]
}

/// The greatest `a` with which `x + a d` is in the cone.
fn way_to_edge(x: Triple, d: Triple) -> f64 {
    // (x₀ + a d₀)² = |x₁ + a d₁|²: a quadratic equation, of which the least positive root counts.
    let c = determinant(x);
    let a = d[0] * d[0] - d[1] * d[1] - d[2] * d[2];
    let b = x[0] * d[0] - x[1] * d[1] - x[2] * d[2];
    let root = b * b - a * c;
    let mut way = f64::INFINITY;
    if root >= 0.0 {
        let root = root.sqrt();
        let q = if b > 0.0 { -(b + root) } else { root - b };
        for candidate in [q / a, c / q] {
            if candidate > 0.0 && candidate < way {
                way = candidate;
            }
        }
    }
    // Without a crossing of the edge the axis is left only backwards.
    if d[0] < 0.0 {
        way = way.min(-x[0] / d[0]);
    }
    way
}
