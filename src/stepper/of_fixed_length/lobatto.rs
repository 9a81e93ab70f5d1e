//! The coefficients by which constraints enter Gauss methods.
//!
//! Constraints hold at the nodes `c̃₁ … c̃ₛ` of Lobatto's quadrature with `s + 1` nodes, of which `c̃₀ = 0` and `c̃ₛ = 1`, and reactions act at
//! all of them. A place at a node is that of the collocation polynomial, and the coefficients of reactions in the stages follow from those
//! of places such that the step is symplectic:
//!
//! ```text
//! ā(k, j) = ∫₀^c̃ₖ ℓⱼ(τ) dτ,      b(i) ã(i, j) + b̃(j) ā(j, i) = b(i) b̃(j)
//! ```
//!
//! L. O. Jay, *Specialized partitioned additive Runge–Kutta methods for systems of overdetermined DAEs with holonomic constraints*, SIAM J.
//! Numer. Anal. 45 (2007) 1814–1842: the Gauss–Lobatto methods with `s` stages, which are of order `2 s` for positions and rates.

use std::vec::Vec;

use crate::implicit::lu::Lu;
use crate::methods::Tableau;

/// The nodes of Lobatto's quadrature from 0 to 1 and its weights, with 3, 4 and 5 nodes. M. Abramowitz, I. A. Stegun, *Handbook of
/// Mathematical Functions*, 1964, 25.4.32.
const QUADRATURES: [(&[f64], &[f64]); 3] = [
    (&[0.0, 0.5, 1.0], &[1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0]),
    (
        &[0.0, 0.276_393_202_250_021, 0.723_606_797_749_979, 1.0],
        &[1.0 / 12.0, 5.0 / 12.0, 5.0 / 12.0, 1.0 / 12.0],
    ),
    (
        &[
            0.0,
            0.172_673_164_646_011_44,
            0.5,
            0.827_326_835_353_988_6,
            1.0,
        ],
        &[0.05, 49.0 / 180.0, 16.0 / 45.0, 49.0 / 180.0, 0.05],
    ),
];

/// The coefficients for one Gauss method.
#[derive(Clone, Debug)]
pub(super) struct Lobatto {
    /// `c̃`, from 0 to 1.
    pub nodes: &'static [f64],
    /// `b̃`.
    pub weights: &'static [f64],
    /// `ā`: the weights of the rates at the stages in the place at a node; the first row, of the beginning, is zero.
    pub places: Vec<Vec<f64>>,
    /// `ã`: the weights of the reactions in the momenta at a stage; those of the last node are zero and left out.
    pub reactions: Vec<Vec<f64>>,
    /// The effect `Σᵢ ā(k, i) ã(i, j)` of reactions at the nodes 0 to s − 1 on the places at the nodes 1 to s, factorized.
    pub effect: Lu<1>,
    /// The square of the norm of the matrix by which residuals of the constraints, in units of length over `h`, change the rates at the stages.
    pub amplification: f64,
}

impl Lobatto {
    /// The coefficients for a Gauss method with 2, 3 or 4 stages; `None` for others.
    pub fn of(tableau: &Tableau) -> Option<Self> {
        let s = tableau.stages - 1;
        let &(nodes, weights) = QUADRATURES.get(s.checked_sub(2)?)?;
        let c = &tableau.c[1..=s];
        let b = &tableau.a[s + 1][1..];
        // The quadrature of the method itself is exact for the polynomials ℓⱼ.
        let basis = |j: usize, x: f64| -> f64 {
            let others = c.iter().enumerate().filter(|(i, _)| *i != j);
            others
                .map(|(_, other)| (x - other) / (c[j] - other))
                .product()
        };
        let integral = |j: usize, x: f64| -> f64 {
            let sum = b.iter().zip(c).map(|(b, c)| b * basis(j, x * c));
            x * sum.sum::<f64>()
        };
        let place = |x: &f64| (0..s).map(|j| integral(j, *x)).collect::<Vec<_>>();
        let places: Vec<Vec<f64>> = nodes.iter().map(place).collect();
        let reaction = |i: usize, j: usize| weights[j] * (1.0 - places[j][i] / b[i]);
        let reactions: Vec<Vec<f64>> = (0..s)
            .map(|i| (0..s).map(|j| reaction(i, j)).collect())
            .collect();
        let mut effect = Lu::new(s);
        let is_regular = effect.factor(|j, [column]| {
            for (entry, place) in column.iter_mut().zip(&places[1..]) {
                let products = place
                    .iter()
                    .zip(&reactions)
                    .map(|(a, of_stage)| a * of_stage[j]);
                *entry = products.sum();
            }
        });
        let mut amplification = 0.0;
        for node in 0..s {
            let mut reaction = std::vec![0.0; s];
            reaction[node] = 1.0;
            effect.solve([&mut reaction]);
            for of_stage in &reactions {
                let products = of_stage.iter().zip(&reaction).map(|(a, x)| a * x);
                amplification += products.sum::<f64>().powi(2);
            }
        }
        is_regular.then_some(Self {
            amplification,
            nodes,
            weights,
            places,
            reactions,
            effect,
        })
    }
}
