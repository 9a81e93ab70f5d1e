//! Integrals of analytic functions to full accuracy.

use std::f64::consts::PI;

/// The number of nodes of the rule: exact for polynomials of degree 31.
const NODES: usize = 16;

/// A stretch is halved until both halves add up to it within this fraction of the whole, a few roundings.
const TOLERANCE: f64 = 4.0 * f64::EPSILON;

/// The most stretches. Near a pole at the relative distance d about 2 log₂ 1/d are needed; more would be used only where
/// round-off keeps the halves from adding up, and would not help.
const MOST: usize = 256;

/// Gauss–Legendre quadrature, with nodes on [0, 1].
#[derive(Clone, Debug)]
pub(super) struct Gauss {
    nodes: [(f64, f64); NODES],
}

impl Gauss {
    /// Zeros of the Legendre polynomial `P` by Newton's method from Tricomi's estimate `cos π (k + ¾)/(n + ½)`, weights
    /// `2/((1 − z²) P′(z)²)`. F. Tricomi, *Sugli zeri dei polinomi sferici ed ultrasferici* (1950).
    pub(super) fn new() -> Gauss {
        let n = NODES as f64;
        let nodes = core::array::from_fn(|k| {
            let mut z = (PI * (k as f64 + 0.75) / (n + 0.5)).cos();
            let mut slope = 1.0;
            // Newton's method doubles the number of correct digits; the estimate has three.
            for _ in 0..6 {
                let (mut value, mut before) = (z, 1.0);
                for degree in 2..=NODES {
                    let m = degree as f64;
                    (value, before) = (
                        ((2.0 * m - 1.0) * z * value - (m - 1.0) * before) / m,
                        value,
                    );
                }
                slope = n * (z * value - before) / (z * z - 1.0);
                z -= value / slope;
            }
            ((1.0 - z) / 2.0, 1.0 / ((1.0 - z * z) * slope * slope))
        });
        Gauss { nodes }
    }

    /// Integrates over one stretch.
    pub(super) fn stretch<const N: usize>(
        &self,
        f: &impl Fn(f64) -> [f64; N],
        from: f64,
        to: f64,
    ) -> [f64; N] {
        let mut sum = [0.0; N];
        for (node, weight) in self.nodes {
            let values = f(from + node * (to - from));
            for (sum, value) in sum.iter_mut().zip(values) {
                *sum += weight * value;
            }
        }
        sum.map(|sum| sum * (to - from))
    }

    /// Ends of stretches on each of which the rule is fully accurate, from `from` to `to`, and the
    /// integrals up to each end.
    pub(super) fn stretches<const N: usize>(
        &self,
        f: &impl Fn(f64) -> [f64; N],
        from: f64,
        to: f64,
    ) -> std::vec::Vec<(f64, [f64; N])> {
        let estimate = self.stretch(f, from, to);
        let scale = estimate.map(f64::abs);
        let mut done = std::vec![(from, [0.0; N])];
        let mut open = std::vec![(from, to, estimate)];
        while let Some((from, to, whole)) = open.pop() {
            let middle = from + (to - from) / 2.0;
            let halves = [self.stretch(f, from, middle), self.stretch(f, middle, to)];
            let good = (0..N).all(|k| {
                let refined = halves[0][k] + halves[1][k];
                // Halving does not make an infinite integral finite; callers check the value.
                (refined - whole[k]).abs() <= TOLERANCE * scale[k].max(refined.abs())
                    || !refined.is_finite()
            });
            if good || done.len() + open.len() >= MOST {
                for (end, half) in [(middle, halves[0]), (to, halves[1])] {
                    let (_, before) = done[done.len() - 1];
                    done.push((end, core::array::from_fn(|k| before[k] + half[k])));
                }
            } else {
                open.push((middle, to, halves[1]));
                open.push((from, middle, halves[0]));
            }
        }
        done
    }

    /// The integrals from `from` to `to`.
    pub(super) fn integrate<const N: usize>(
        &self,
        f: &impl Fn(f64) -> [f64; N],
        from: f64,
        to: f64,
    ) -> [f64; N] {
        let stretches = self.stretches(f, from, to);
        stretches[stretches.len() - 1].1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_of_the_rules_degree_are_integrated_exactly() {
        let [whole] = Gauss::new().stretch(&|x: f64| [32.0 * x.powi(31)], 0.0, 1.0);
        // A sum of 16 terms, each with a few roundings from the power.
        assert!((whole - 1.0).abs() < 64.0 * f64::EPSILON, "{whole}");
    }

    #[test]
    fn a_near_pole_is_walked_up_to() {
        let near = 1e-6;
        let [whole] = Gauss::new().integrate(&|x: f64| [1.0 / (x * x + near * near)], -1.0, 1.0);
        let exact = 2.0 * (1.0 / near).atan() / near;
        assert!((whole / exact - 1.0).abs() < 1e-13, "{whole} {exact}");
    }
}
