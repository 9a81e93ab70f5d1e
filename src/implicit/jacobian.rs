//! Derivatives of the accelerations with respect to the state, by finite differences.

use super::lu::add_multiple;
use crate::math::{rough_exp2, rough_log2, sqrt};
use crate::{StepError, System, Vector};
use std::vec::Vec;

/// The size assumed for coordinates whose unit only has zero values in the machine, and for such rates. If it is far too small,
/// derivatives lose digits; if far too large, they lose accuracy. Both only slow down the convergence.
const SIZE_OF_NOTHING: f64 = 1e-3;

/// A rate counts as at most this many times the largest of its unit, however short the step is.
const LARGEST_RATE: f64 = 1e4;

/// Number of power iterations after which only the dominant eigenvalues remain; as many more are then measured.
const ROUNDS: usize = 32;

/// Numbers from 1/2 to 3/2 without a pattern: multiples of the golden ratio.
fn irregular(i: usize) -> f64 {
    let turns = i as f64 * 0.618_033_988_749_894_9;
    0.5 + turns.fract()
}

/// Adds `factor` times the product of a matrix, column after column, with a vector.
pub(crate) fn add_product(to: &mut [f64], factor: f64, matrix: &[f64], x: &[f64]) {
    for (column, x) in matrix.chunks_exact(to.len().max(1)).zip(x) {
        add_multiple(to, factor * x, column);
    }
}

/// The derivatives `∂a/∂q` and `∂a/∂v`.
#[derive(Clone, Debug)]
pub(crate) struct Jacobian {
    n: usize,
    /// For each coordinate, the first of the same unit.
    alike: Vec<usize>,
    is_angle: Vec<bool>,
    /// Column after column.
    pub by_coordinates: Vec<f64>,
    pub by_rates: Vec<f64>,
    /// Typical sizes of the coordinates, then of the rates.
    pub sizes: [Vec<f64>; 2],
    /// Roundoff of each acceleration, in units of the roundoff of 1: `|aᵢ| + Σⱼ |∂aᵢ/∂qⱼ| |qⱼ| + …`.
    pub noise: Vec<f64>,
    state: [Vec<f64>; 2],
}

impl Jacobian {
    pub fn new<S: System>(system: &S) -> Self {
        let n = system.coordinates().len();
        let first = |unit: &str| system.coordinates().position(|other| other.unit == unit);
        let alike = system.coordinates().enumerate();
        let zeros = || std::vec![0.0; n];
        Self {
            n,
            alike: alike.map(|(j, one)| first(one.unit).unwrap_or(j)).collect(),
            is_angle: system.coordinates().map(|one| one.unit == "rad").collect(),
            by_coordinates: std::vec![0.0; n * n],
            by_rates: std::vec![0.0; n * n],
            sizes: [zeros(), zeros()],
            noise: zeros(),
            state: [zeros(), zeros()],
        }
    }

    /// Computes the derivatives at a state in a step of length `h`, by `1 + 2 n` evaluations, and leaves the accelerations in `here`.
    /// `there` is scratch memory.
    ///
    /// An increment of `√ε` times the size of a number halves its digits: the errors of rounding and of the second derivative are then
    /// alike. Rates are changed at least so much that coordinates move as far within a step; otherwise the round-off of a stiff spring
    /// would hide the effect of a damper.
    pub fn find<V: Vector>(
        &mut self,
        (t, h): (f64, f64),
        [q, v, here, there]: [&mut V; 4],
        accelerations: &mut impl FnMut(f64, &V, &V, &mut V) -> Result<(), StepError>,
    ) -> Result<(), StepError> {
        accelerations(t, q, v, here)?;
        self.measure(h, [&*q, &*v, &*here]);
        let n = self.n;
        for (noise, a) in self.noise.iter_mut().zip(here.as_slice()) {
            *noise = a.abs();
        }
        for level in 0..2 {
            for j in 0..n {
                let size = self.sizes[level][j];
                let ahead = match level {
                    0 => h * v.as_slice()[j],
                    _ => h * here.as_slice()[j],
                };
                let by = (sqrt(f64::EPSILON) * size).copysign(ahead);
                let mut difference = 0.0;
                // If the machine cannot be on one side, it can be on the other.
                let mut tried = Ok(());
                for by in [by, -by] {
                    let y = match level {
                        0 => &mut q.as_mut_slice()[j],
                        _ => &mut v.as_mut_slice()[j],
                    };
                    let before = *y;
                    *y += by;
                    // The increment that rounding leaves.
                    difference = *y - before;
                    tried = accelerations(t, q, v, there);
                    let y = match level {
                        0 => &mut q.as_mut_slice()[j],
                        _ => &mut v.as_mut_slice()[j],
                    };
                    *y = before;
                    if tried.is_ok() {
                        break;
                    }
                }
                tried?;
                let derivatives = match level {
                    0 => &mut self.by_coordinates,
                    _ => &mut self.by_rates,
                };
                let pairs = there.as_slice().iter().zip(here.as_slice());
                let column = derivatives[j * n..][..n].iter_mut();
                for ((derivative, noise), (there, here)) in column.zip(&mut self.noise).zip(pairs) {
                    *derivative = (there - here) / difference;
                    *noise += derivative.abs() * size;
                }
            }
        }
        Ok(())
    }

    /// The spectral radius of the matrix `[0 I; ∂a/∂q ∂a/∂v]`, in 1/s: the rate of the fastest part of the motion.
    ///
    /// By power iteration: after [`ROUNDS`] iterations all slower parts have decayed, and the mean growth over as many more is that of the
    /// dominant eigenvalues. Since their number is even, this holds for a complex pair as well.
    pub fn fastest_rate(&self) -> f64 {
        let n = self.n;
        // An irregular start is orthogonal to no eigenvector.
        let mut state: Vec<f64> = (0..2 * n).map(|i| irregular(i + 1)).collect();
        let mut next = state.clone();
        let mut logarithm = 0.0;
        for round in 0..2 * ROUNDS {
            let (by_q, by_v) = state.split_at(n);
            let (of_q, of_v) = next.split_at_mut(n);
            of_q.copy_from_slice(by_v);
            of_v.fill(0.0);
            add_product(of_v, 1.0, &self.by_coordinates, by_q);
            add_product(of_v, 1.0, &self.by_rates, by_v);
            let size = next.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            if size == 0.0 {
                return 0.0;
            }
            if !size.is_finite() {
                return f64::INFINITY;
            }
            for (state, next) in state.iter_mut().zip(&next) {
                *state = next / size;
            }
            if round >= ROUNDS {
                logarithm += rough_log2(size);
            }
        }
        rough_exp2(logarithm / ROUNDS as f64)
    }

    /// Copies the derivatives of another.
    pub fn take(&mut self, other: &Self) {
        self.by_coordinates.copy_from_slice(&other.by_coordinates);
        self.by_rates.copy_from_slice(&other.by_rates);
        self.noise.copy_from_slice(&other.noise);
        for (sizes, other) in self.sizes.iter_mut().zip(&other.sizes) {
            sizes.copy_from_slice(other);
        }
    }

    /// Determines the sizes of coordinates and rates: the largest value of their unit at this state, or the change within a step. An angle
    /// counts as at least 1 rad.
    fn measure<V: Vector>(&mut self, h: f64, state: [&V; 3]) {
        let [q, v, a] = state.map(V::as_slice);
        let [greatest_q, greatest_v] = &mut self.state;
        greatest_q.fill(0.0);
        greatest_v.fill(0.0);
        for j in 0..self.n {
            let (q, dq, dv) = (q[j].abs(), (h * v[j]).abs(), (h * a[j]).abs());
            let alike = self.alike[j];
            greatest_q[alike] = greatest_q[alike].max(q).max(dq);
            greatest_v[alike] = greatest_v[alike].max(v[j].abs()).max(dv);
        }
        let or_nothing = |size: f64| if size > 0.0 { size } else { SIZE_OF_NOTHING };
        for j in 0..self.n {
            let least = if self.is_angle[j] { 1.0 } else { 0.0 };
            let size = or_nothing(greatest_q[self.alike[j]].max(least));
            let rate = or_nothing(greatest_v[self.alike[j]]);
            self.sizes[0][j] = size;
            self.sizes[1][j] = rate.max((size / h.abs()).min(LARGEST_RATE * rate));
        }
    }
}
