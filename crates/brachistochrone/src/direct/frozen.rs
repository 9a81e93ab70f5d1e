//! Machines with constant coefficients, whose fastest motion has a closed form, and the homotopy from them to a machine.

use lagrangian_scalar::Scalar;

use super::Terrain;
use super::{between, rows, symmetric};
use crate::linear::{dot, times};
use crate::problem::Problem;

/// The machine at parameter θ of the homotopy from constant coefficients to those of a machine.
pub struct Homotopy<'a, T> {
    terrain: &'a T,
    frozen: &'a Frozen,
    part: f64,
}

impl<T: Terrain> Terrain for Homotopy<'_, T> {
    fn coordinates(&self) -> usize {
        self.terrain.coordinates()
    }

    fn inertia<N: Scalar>(&self, q: &[N]) -> Vec<N> {
        let real = if self.part == 0.0 {
            std::vec![N::ZERO; self.frozen.inertia.len()]
        } else {
            self.terrain.inertia(q)
        };
        self.between(&self.frozen.inertia, real)
    }

    fn resistance<N: Scalar>(&self, q: &[N], v: &[N]) -> Vec<N> {
        let real = if self.part == 0.0 {
            std::vec![N::ZERO; self.frozen.resistance.len()]
        } else {
            self.terrain.resistance(q, v)
        };
        self.between(&self.frozen.resistance, real)
    }
}

impl<T> Homotopy<'_, T> {
    fn between<N: Scalar>(&self, frozen: &[f64], real: Vec<N>) -> Vec<N> {
        if self.part == 1.0 {
            return real;
        }
        let (part, rest) = (N::from_f64(self.part), 1.0 - self.part);
        let pairs = frozen.iter().zip(real);
        pairs
            .map(|(frozen, real)| part * real + N::from_f64(rest * frozen))
            .collect()
    }
}

/// A machine with constant coefficients, where the homotopy starts.
pub struct Frozen {
    inertia: Vec<f64>,
    resistance: Vec<f64>,
    pub problem: Problem,
}

impl Frozen {
    /// The machine at this parameter of the homotopy to the machine itself.
    pub fn towards<'a, T>(&'a self, terrain: &'a T, part: f64) -> Homotopy<'a, T> {
        Homotopy {
            terrain,
            frozen: self,
            part,
        }
    }
}

/// Machines to start from, the most promising first: coefficients frozen half-way, at the start, and half-way with the mean
/// force of the straight path, then one that falls straight to the end.
pub fn frozen(terrain: &impl Terrain, from: &[f64], to: &[f64]) -> Vec<Frozen> {
    let n = from.len();
    let half = between(from, to, 0.5);
    let rest = std::vec![0.0; n];
    let at_rest = |part: f64| terrain.resistance(&between(from, to, part), &rest);
    let middle = terrain.inertia(&half);
    let even = symmetric(middle.clone(), n);
    let [one, two, three] = [0.0, 0.5, 1.0].map(at_rest);
    let mean = (0..n).map(|i| (one[i] + 4.0 * two[i] + three[i]) / 6.0);
    let mean: Vec<f64> = mean.collect();
    let polygon: Vec<f64> = to.iter().zip(from).map(|(to, from)| to - from).collect();
    let momentum = times(&rows(&even, n), &polygon);
    // The acceleration follows from the work on the straight path, or else is that of gravity.
    let length = dot(&momentum, &polygon).max(f64::MIN_POSITIVE);
    let push = (dot(&mean, &polygon).abs() / length).max(f64::EPSILON);
    let falling = momentum.iter().map(|p| -push * p).collect();
    let candidates = [
        (middle.clone(), two),
        (terrain.inertia(from), one),
        (middle, mean.clone()),
        (even.clone(), mean),
        (even, falling),
    ];
    let known = candidates.into_iter().filter_map(|(inertia, resistance)| {
        let even = symmetric(inertia.clone(), n);
        let skew: Vec<f64> = inertia.iter().zip(&even).map(|(a, s)| a - s).collect();
        let problem = Problem::new(&rows(&even, n), &resistance)
            .and_then(|problem| problem.with_friction(&std::vec![0.0; n], &rows(&skew, n)));
        let problem = problem.ok()?;
        Some(Frozen {
            inertia,
            resistance,
            problem,
        })
    });
    known.collect()
}
