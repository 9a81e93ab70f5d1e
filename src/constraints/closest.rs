//! Finds how close a start can come to the constraints while some of its numbers are kept.

use std::vec;
use std::vec::Vec;

use super::algebra::{backward, cholesky, dot, forward};
use super::{Level, Unprojected};
use crate::{System, Vector};

/// The number of iterations after which the method has converged or stagnates.
const ROUNDS: usize = 200;

/// Residuals below this, relative to the residual at the start, count as zero: their square is the
/// round-off in a sum of squares.
const NO_VIOLATION: f64 = 1e-7;

/// Residuals below this, relative to the terms of a row, count as zero as well: runs demand less, and
/// rounding is far below.
const ROUNDING: f64 = 1e-11;

/// Residuals below this fraction of the largest belong to rows that could be satisfied.
const SATISFIABLE: f64 = 1e-4;

/// A row that cannot be satisfied: its index, its level (0 for positions, 1 for rates), and its residual.
pub(crate) type Violation = (usize, usize, f64);

/// The rows that cannot be satisfied by moving the free numbers; those with nonzero `kept` are fixed.
/// These are the rows with a remainder where the sum of squares of all residuals is smallest. Rates are
/// tried only if all rows of positions can be satisfied. `place` is moved there.
///
/// Each residual is scaled to a distance in the metric of the inertias at the start. The method is K.
/// Levenberg's (*A method for the solution of certain non-linear problems in least squares*, 1944), with
/// steps `−W Gᵀ (G W Gᵀ + μ)⁻¹ g`.
pub(crate) fn closest<S: System>(
    system: &S,
    place: &mut Unprojected<'_, S::Vector>,
    kept: &[S::Vector; 2],
) -> Vec<Violation> {
    for level in [Level::Positions, Level::Rates] {
        let mut search = Search::new(system, place, &kept[level as usize], level);
        search.minimize(system, place);
        let violations = search.violations();
        if !violations.is_empty() {
            return violations;
        }
    }
    Vec::new()
}

struct Search {
    level: Level,
    n: usize,
    /// The rows of this level.
    rows: Vec<usize>,
    /// The divisor of the residual of each.
    sizes: Vec<f64>,
    /// The inverse inertia of each coordinate, 0 for kept ones.
    free: Vec<f64>,
    /// Residuals and rows at the present state, each divided by its size.
    residuals: Vec<f64>,
    matrix: Vec<f64>,
    /// Residuals up to this count as zero.
    zero_residual: f64,
}

impl Search {
    fn new<S: System>(
        system: &S,
        place: &Unprojected<'_, S::Vector>,
        kept: &S::Vector,
        level: Level,
    ) -> Self {
        let n = place.q[0].as_slice().len();
        let rows = system.constraints().enumerate();
        let rows = rows.filter(|(_, row)| row.holonomic || matches!(level, Level::Rates));
        let rows: Vec<usize> = rows.map(|(k, _)| k).collect();
        let mut inertia = <S::Matrix as Vector>::zeros(n * n);
        system.mass_matrix(place.t, place.q[0], &mut inertia);
        let inverse = |j: usize| match inertia.as_slice()[j * n + j] {
            m if m > 0.0 && m.is_finite() => 1.0 / m,
            _ => 1.0,
        };
        let inverse: Vec<f64> = (0..n).map(inverse).collect();
        let mut search = Self {
            level,
            n,
            sizes: vec![1.0; rows.len()],
            residuals: vec![0.0; rows.len()],
            matrix: vec![0.0; rows.len() * n],
            rows,
            free: inverse.clone(),
            zero_residual: 0.0,
        };
        search.evaluate(system, place);
        for (row, size) in search.matrix.chunks_exact(n).zip(&mut search.sizes) {
            let squares = row.iter().zip(&inverse).map(|(g, w)| g * g * w);
            let length = squares.sum::<f64>().sqrt();
            if length > 0.0 && length.is_finite() {
                *size = length;
            }
        }
        search.evaluate(system, place);
        let y = match level {
            Level::Positions => &*place.q[0],
            Level::Rates => &*place.v[0],
        };
        let reach = |(y, of): (&f64, crate::Quantity<'_>)| match (level, of.unit) {
            (Level::Positions, "rad") => y.abs().max(1.0),
            _ => y.abs(),
        };
        let reach: Vec<f64> = y
            .as_slice()
            .iter()
            .zip(system.coordinates())
            .map(reach)
            .collect();
        for (row, left) in search.matrix.chunks_exact(n).zip(&search.residuals) {
            let terms = row
                .iter()
                .zip(&reach)
                .map(|(g, y)| g.abs() * y)
                .sum::<f64>();
            let nothing = (ROUNDING * (terms + left.abs())).max(NO_VIOLATION * left.abs());
            search.zero_residual = search.zero_residual.max(nothing);
        }
        for (free, kept) in search.free.iter_mut().zip(kept.as_slice()) {
            if *kept != 0.0 {
                *free = 0.0;
            }
        }
        search
    }

    /// Evaluates residuals and rows at a state.
    fn evaluate<S: System>(&mut self, system: &S, place: &Unprojected<'_, S::Vector>) {
        let m = system.constraints().len();
        let (mut left, mut matrix) = (vec![0.0; m], vec![0.0; m * self.n]);
        let (q, v) = (&*place.q[0], &*place.v[0]);
        match self.level {
            Level::Positions => system.constraint_positions(place.t, q, &mut left),
            Level::Rates => system.constraint_rates(place.t, q, v, &mut left),
        }
        system.constraint_matrix(place.t, q, &mut matrix);
        for (at, (&k, size)) in self.rows.iter().zip(&self.sizes).enumerate() {
            self.residuals[at] = left[k] / size;
            let row = &matrix[k * self.n..][..self.n];
            for (to, g) in self.matrix[at * self.n..].iter_mut().zip(row) {
                *to = g / size;
            }
        }
    }

    fn minimize<S: System>(&mut self, system: &S, place: &mut Unprojected<'_, S::Vector>) {
        let (n, m) = (self.n, self.rows.len());
        self.evaluate(system, place);
        let mut damping = 1e-3;
        let mut squares = dot(&self.residuals, &self.residuals);
        for _ in 0..ROUNDS {
            if !(squares > 0.0 && squares.is_finite() && damping < 1e12) {
                return;
            }
            let mut normal = vec![0.0; m * m];
            for (i, a) in self.matrix.chunks_exact(n).enumerate() {
                for (j, b) in self.matrix.chunks_exact(n).enumerate().take(i + 1) {
                    let terms = a.iter().zip(b).zip(&self.free);
                    normal[i * m + j] = terms.map(|((a, b), w)| a * b * w).sum();
                }
                normal[i * m + i] += damping;
            }
            let mut shares = vec![0.0; m];
            if cholesky(&mut normal, &mut shares).is_err() {
                damping *= 10.0;
                continue;
            }
            let mut weights = self.residuals.clone();
            forward(&normal, &mut weights);
            backward(&normal, &mut weights);
            let previous = place.level(self.level)[0].clone();
            let y = place.level(self.level)[0].as_mut_slice();
            for (row, weight) in self.matrix.chunks_exact(n).zip(&weights) {
                for ((y, g), w) in y.iter_mut().zip(row).zip(&self.free) {
                    *y -= w * g * weight;
                }
            }
            self.evaluate(system, place);
            let now = dot(&self.residuals, &self.residuals);
            if now < squares {
                let gain = 1.0 - now / squares;
                squares = now;
                damping = (0.1 * damping).max(1e-12);
                if gain < 1e-12 {
                    return;
                }
            } else {
                *place.level(self.level)[0] = previous;
                self.evaluate(system, place);
                damping *= 10.0;
            }
        }
    }

    /// The constraints that are violated at the present state, with their residuals.
    fn violations(&self) -> Vec<Violation> {
        let most = self
            .residuals
            .iter()
            .fold(0.0, |most: f64, x| most.max(x.abs()));
        let rows = self.rows.iter().zip(&self.residuals).zip(&self.sizes);
        let missed = rows.filter(|((_, left), _)| left.abs() > SATISFIABLE * most);
        let level = self.level as usize;
        let violations = missed.map(|((k, left), size)| (*k, level, left * size));
        if most <= self.zero_residual {
            Vec::new()
        } else {
            violations.collect()
        }
    }
}
