//! The Gauss rule of a stretch, and polynomials through its points.

use lagrangian_scalar::{Dual, Scalar};

/// The number of Gauss points of a stretch.
pub const POINTS: usize = 4;

/// The Gauss rule on [0, 1].
pub struct Rule {
    /// The points.
    pub points: [f64; POINTS],
    /// Weights of the integrals from 0 up to each point.
    pub upto: [[f64; POINTS]; POINTS],
    /// Weights of the integral over the whole interval.
    pub whole: [f64; POINTS],
}

impl Rule {
    /// Computes the zeros of the Legendre polynomial of degree 4, and weights that integrate polynomials of
    /// degree 3 exactly.
    pub fn new() -> Rule {
        let root = 2.0 / 7.0 * 1.2_f64.sqrt();
        let [far, near] = [(3.0 / 7.0 + root).sqrt(), (3.0 / 7.0 - root).sqrt()];
        let points = [-far, -near, near, far].map(|z| (1.0 + z) / 2.0);
        let integrals = |end: f64| -> [f64; POINTS] {
            core::array::from_fn(|l| {
                // The Lagrange polynomial of a point; two Gauss points integrate it exactly.
                let basis = |x: f64| {
                    let others = (0..POINTS).filter(|k| *k != l);
                    others
                        .map(|k| (x - points[k]) / (points[l] - points[k]))
                        .product::<f64>()
                };
                let third = 1.0 / 3.0_f64.sqrt();
                [-third, third]
                    .map(|z| end / 2.0 * basis(end / 2.0 * (1.0 + z)))
                    .iter()
                    .sum()
            })
        };
        Rule {
            points,
            upto: points.map(integrals),
            whole: integrals(1.0),
        }
    }
}

/// The value at x of the polynomial through points, for each component.
pub fn through(points: &[(f64, &[f64])], x: f64) -> Vec<f64> {
    polynomial(points, x)
}

/// The value at x of the polynomial through points and its derivative by x, for each component.
pub fn sloping(points: &[(f64, &[f64])], x: f64) -> Vec<Dual<f64>> {
    polynomial(
        points,
        Dual {
            value: x,
            derivative: 1.0,
        },
    )
}

fn polynomial<N: Scalar>(points: &[(f64, &[f64])], x: N) -> Vec<N> {
    let number = N::from_f64;
    let weight = |k: usize| {
        let others = (0..points.len()).filter(|l| *l != k);
        others
            .map(|l| (x - number(points[l].0)) / number(points[k].0 - points[l].0))
            .fold(N::ONE, |product, factor| product * factor)
    };
    let weights: Vec<N> = (0..points.len()).map(weight).collect();
    (0..points[0].1.len())
        .map(|i| {
            let terms = weights.iter().zip(points);
            terms.fold(N::ZERO, |sum, (w, (_, y))| sum + *w * number(y[i]))
        })
        .collect()
}
