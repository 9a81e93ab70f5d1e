//! Pontryagin's function of a machine, for any type of number.
//!
//! *Two coordinates.* Directions are `ê = F (cos x, sin x)` with a fixed frame `F`, and `v = U ê`. With `φ = ê·A ê`
//! and `ρ = ê·A ê_x`, (8) is `φ U̇ + ρ U ẋ + ê·R = 0`. A turn at a fixed position leaves invariant
//!
//! ```text
//! W = U E(q, x)        ln E = ∫ ρ/φ dx = ½ ln φ + κ y        κ = Ω(f₁, f₂)/√det S              (9)
//! ```
//!
//! where S and Ω are the symmetric and the skew part of `A`, and y is the angle of ê in the metric S. So
//!
//! ```text
//! q̇ = U ê        Ẇ = E (U² ê·∂ln E/∂q − ê·R/φ)                                                (10)
//! ```
//!
//! in which x has no rate: it is a control. A full turn multiplies `E` by `exp(2π κ)`.
//!
//! *Any number of coordinates*, where Ω = 0: `v = V e`, `e·S e = 1`, and `V̇ = ½ V² ∂S[e](e, e) − e·R`. The control is e, with
//! a multiplier η for its length.
//!
//! The function to be maximized is `H = p·q̇ + λ Ẇ`, which is 1 on the fastest motion. L. S. Pontryagin et al., *The
//! Mathematical Theory of Optimal Processes* (1962), ch. 1.

use lagrangian_scalar::{Dual, Scalar};

use super::Terrain;
use super::pontryagin::Pontryagin;
use crate::linear::{Lu, Matrix, dot};

/// A machine whose direction of motion is the control.
#[derive(Clone, Debug)]
pub struct Driven<T> {
    pub(super) terrain: T,
    /// The columns of the frame in which directions are expressed.
    frame: Matrix,
    /// Whether the control is an angle and includes friction.
    plane: bool,
}

impl<T: Terrain> Driven<T> {
    pub(super) fn new(terrain: T, frame: Matrix) -> Driven<T> {
        let plane = terrain.coordinates() == 2;
        Driven {
            terrain,
            frame,
            plane,
        }
    }

    /// Another machine with the same frame.
    pub(super) fn of<U: Terrain>(&self, terrain: U) -> Driven<U> {
        Driven::new(terrain, self.frame.clone())
    }

    /// The number of coordinates.
    pub(super) fn n(&self) -> usize {
        self.terrain.coordinates()
    }

    /// Whether the control is an angle.
    pub(super) fn is_plane(&self) -> bool {
        self.plane
    }

    /// The direction of a control, in coordinates; where the control is an angle its length is not 1.
    pub(super) fn direction<N: Scalar>(&self, control: &[N]) -> Vec<N> {
        if self.plane {
            let (sin, cos) = control[0].sin_cos();
            self.in_coordinates(&[cos, sin])
        } else {
            self.in_coordinates(&control[..self.n()])
        }
    }

    fn in_coordinates<N: Scalar>(&self, parts: &[N]) -> Vec<N> {
        (0..self.n())
            .map(|i| {
                let terms = self.frame.iter().zip(parts);
                terms.fold(N::ZERO, |sum, (column, part)| {
                    sum + N::from_f64(column[i]) * *part
                })
            })
            .collect()
    }

    /// The control of a velocity; an angle is chosen nearest to `before`.
    pub(super) fn control(&self, q: &[f64], v: &[f64], before: f64) -> Vec<f64> {
        // F is the inverse of Lᵀ, and the metric of the start is F⁻ᵀ F⁻¹: components follow by back substitution.
        let parts = solve_columns(&self.frame, v);
        if self.plane {
            let angle = parts[1].atan2(parts[0]);
            let turn = std::f64::consts::TAU;
            return std::vec![angle + ((before - angle) / turn).round() * turn];
        }
        let inertia = self.terrain.inertia(q);
        let n = self.n();
        let length = (0..n * n).map(|k| inertia[k] * v[k / n] * v[k % n]);
        let length = length.sum::<f64>().sqrt();
        let unit = parts.iter().map(|part| part / length);
        unit.chain([1.0]).collect()
    }

    /// The factor from the component of a velocity along this direction to `W`: `E`, or the length.
    pub(super) fn measure(&self, q: &[f64], v: &[f64], control: &[f64]) -> f64 {
        if self.plane {
            let direction = self.direction(control);
            let speed = dot(v, &direction) / dot(&direction, &direction);
            let q: Vec<Dual<f64>> = q.iter().map(|x| Dual::constant(*x)).collect();
            return speed * self.growth(&q, control[0]).0.value.exp();
        }
        let inertia = self.terrain.inertia(q);
        let n = self.n();
        let square = (0..n * n).map(|k| inertia[k] * v[k / n] * v[k % n]);
        square.sum::<f64>().sqrt()
    }

    /// The multipliers of the coordinates, and the control with its own multiplier, such that H is 1 and stationary, at a
    /// position with `W`, a control, and λ. `None` at rest, where every multiplier would do.
    pub(super) fn multipliers(
        &self,
        q: &[f64],
        w: f64,
        control: &[f64],
        lambda: f64,
    ) -> Option<(Vec<f64>, Vec<f64>)> {
        let n = self.n();
        let free = if self.plane { 1 } else { n };
        // H is linear in p, λ and η: its coefficients follow by setting one of them to 1 and the others to 0.
        let alone = |which: usize| {
            let mut y = std::vec![0.0; 2 * (n + 1)];
            y[..n].copy_from_slice(q);
            y[n] = w;
            let mut z = control.to_vec();
            z.truncate(free);
            if !self.plane {
                z.push(if which > n { 1.0 } else { 0.0 });
            }
            if which <= n {
                y[n + 1 + which] = 1.0;
            }
            let (value, slopes) = self.slopes(&y, &z);
            let first = 2 * (n + 1);
            let mut column = slopes[first..first + free].to_vec();
            column.push(value);
            column
        };
        let unknown: Vec<usize> = if self.plane {
            (0..n).collect()
        } else {
            (0..n).chain([n + 1]).collect()
        };
        let columns: Vec<Vec<f64>> = unknown.into_iter().map(alone).collect();
        let known = alone(n);
        let rows = (0..=free).map(|i| columns.iter().map(|column| column[i]).collect());
        let mut right: Vec<f64> = known.iter().map(|x| -lambda * x).collect();
        right[free] += 1.0;
        let mut solution = Lu::new(rows.collect())?.solve(&right);
        let remaining = solution.split_off(n);
        let mut z = control[..free].to_vec();
        z.extend(remaining);
        Some((solution, z))
    }

    /// `ln E` and `ln √φ` of (9), differentiated along the direction in which the position is dual.
    fn growth<N: Scalar>(&self, q: &[Dual<N>], x: N) -> (Dual<N>, Dual<N>) {
        let (sin, cos) = x.sin_cos();
        let (sin, cos) = (Dual::constant(sin), Dual::constant(cos));
        let inertia = self.terrain.inertia(q);
        let number = |x: f64| Dual::<N>::from_f64(x);
        let entry = |i: usize, j: usize| {
            let mut sum = Dual::ZERO;
            for k in 0..2 {
                for l in 0..2 {
                    let weight = self.frame[i][k] * self.frame[j][l];
                    sum = sum + number(weight) * inertia[2 * k + l];
                }
            }
            sum
        };
        let (even, skew) = (
            number(0.5) * (entry(0, 1) + entry(1, 0)),
            number(0.5) * (entry(0, 1) - entry(1, 0)),
        );
        let first = entry(0, 0).sqrt();
        let below = even / first;
        let second = (entry(1, 1) - below * below).sqrt();
        let (ahead, aside) = (first * cos + below * sin, second * sin);
        // The angle y in the metric differs from x by less than half a turn.
        let more = (aside * cos - ahead * sin).atan2(ahead * cos + aside * sin);
        let length = number(0.5) * (ahead * ahead + aside * aside).ln();
        let kappa = skew / (first * second);
        (length + kappa * (Dual::constant(x) + more), length)
    }

    fn plane_value<N: Scalar>(&self, y: &[N], z: &[N]) -> N {
        let ([q1, q2, w], [p1, p2, lambda]) = ([y[0], y[1], y[2]], [y[3], y[4], y[5]]);
        let unit = self.direction(z);
        let along = |value: N, derivative: N| Dual { value, derivative };
        let place = [along(q1, unit[0]), along(q2, unit[1])];
        let (growth, length) = self.growth(&place, z[0]);
        let factor = growth.value.exp();
        let speed = w / factor;
        let v = [speed * unit[0], speed * unit[1]];
        let resistance = self.terrain.resistance(&[q1, q2], &v);
        let against = unit[0] * resistance[0] + unit[1] * resistance[1];
        // 1/φ
        let lightness = (-(length.value + length.value)).exp();
        let gain = speed * speed * growth.derivative - against * lightness;
        p1 * v[0] + p2 * v[1] + lambda * factor * gain
    }

    fn any_value<N: Scalar>(&self, y: &[N], z: &[N]) -> N {
        let n = self.n();
        let (q, speed, p, lambda) = (&y[..n], y[n], &y[n + 1..2 * n + 1], y[2 * n + 1]);
        let unit = self.direction(z);
        let eta = z[n];
        let place = q.iter().zip(&unit);
        let place: Vec<Dual<N>> = place
            .map(|(value, derivative)| Dual {
                value: *value,
                derivative: *derivative,
            })
            .collect();
        let inertia = self.terrain.inertia(&place);
        let mut square = Dual::ZERO;
        for (k, entry) in inertia.iter().enumerate() {
            square = square + *entry * Dual::constant(unit[k / n] * unit[k % n]);
        }
        let v: Vec<N> = unit.iter().map(|e| speed * *e).collect();
        let resistance = self.terrain.resistance(q, &v);
        let sum = |a: &[N], b: &[N]| a.iter().zip(b).fold(N::ZERO, |sum, (a, b)| sum + *a * *b);
        let half = N::from_f64(0.5);
        let gain = half * speed * speed * square.derivative - sum(&unit, &resistance);
        sum(p, &v) + lambda * gain + half * eta * (N::ONE - square.value)
    }
}

/// `x` with `Σ columns_k x_k = v`, for an upper triangular matrix of columns.
fn solve_columns(columns: &Matrix, v: &[f64]) -> Vec<f64> {
    let n = v.len();
    let mut x = v.to_vec();
    for k in (0..n).rev() {
        x[k] /= columns[k][k];
        for i in 0..k {
            x[i] -= columns[k][i] * x[k];
        }
    }
    x
}

impl<T: Terrain> Pontryagin for Driven<T> {
    fn states(&self) -> usize {
        self.n() + 1
    }

    fn controls(&self) -> usize {
        if self.plane { 1 } else { self.n() + 1 }
    }

    fn value<N: Scalar>(&self, y: &[N], z: &[N]) -> N {
        if self.plane {
            self.plane_value(y, z)
        } else {
            self.any_value(y, z)
        }
    }
}
