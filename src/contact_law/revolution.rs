//! Cones of revolution `K = {(x₀, x₁) : x₀ ≥ |x₁|}` in three dimensions, which friction makes, and what interior-point methods do with them.
//!
//! Slacks s and multipliers z in K are scaled with the point of Yu. E. Nesterov and M. J. Todd (SIAM J. Optim. 8 (1998) 324–364): with `W` both become the same,
//! `λ = W z = W⁻¹ s`. A step goes first towards the solution itself and is then corrected with the products of its changes (S. Mehrotra, SIAM J. Optim. 2 (1992)
//! 575–601). The formulas are those of L. Vandenberghe (*The CVXOPT linear and quadratic cone program solvers*, 2010). Of a half line, `x₁` is 0.
//!
//! Two methods are made of these: `cone::interior` for impulses, whose unknowns are the forces of all contacts, and `shares::cones` for the shared margin, whose
//! unknowns are a few forces that keep each other in equilibrium.

use crate::math::sqrt;

/// Numbers of a cone: along its axis, and along both tangents.
pub(super) type Triple = [f64; 3];

/// A step goes this share of the way to the edge of the cones.
pub(super) const SHARE_OF_WAY: f64 = 0.99;

/// The scaling of slacks and multipliers: `W` is a hyperbolic rotation, which takes the axis of the cone to `axis`, times a factor.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Scaling {
    pub factor: f64,
    pub axis: Triple,
}

impl Scaling {
    /// That with which `W z = W⁻¹ s`; none if one of both is not inside its cone, beyond rounding.
    pub fn new(slack: Triple, multiplier: Triple) -> Option<Self> {
        let sizes = [determinant(slack), determinant(multiplier)];
        if !(sizes[0] > 0.0 && sizes[1] > 0.0) || slack[0] <= 0.0 || multiplier[0] <= 0.0 {
            return None;
        }
        let [of_slack, of_multiplier] = sizes.map(sqrt);
        let s = slack.map(|x| x / of_slack);
        let z = multiplier.map(|x| x / of_multiplier);
        let both = sqrt(0.5 * (1.0 + s[0] * z[0] + s[1] * z[1] + s[2] * z[2]));
        Some(Self {
            factor: sqrt(of_slack / of_multiplier),
            axis: [
                0.5 * (s[0] + z[0]) / both,
                0.5 * (s[1] - z[1]) / both,
                0.5 * (s[2] - z[2]) / both,
            ],
        })
    }

    /// `W z`.
    pub fn times(&self, z: Triple) -> Triple {
        turned(self.axis, z).map(|x| self.factor * x)
    }

    /// `W⁻¹ s`.
    pub fn inverse_times(&self, s: Triple) -> Triple {
        let [along, first, second] = self.axis;
        turned([along, -first, -second], s).map(|x| x / self.factor)
    }
}

/// The length of a vector along both tangents.
pub(super) fn length_of([x, y]: [f64; 2]) -> f64 {
    sqrt(x * x + y * y)
}

/// `x₀² − |x₁|²`, of which rounding takes no digits near the edge of the cone.
pub(super) fn determinant(x: Triple) -> f64 {
    let length = length_of([x[1], x[2]]);
    (x[0] - length) * (x[0] + length)
}

/// The right side `λ \ (aim e − λ∘λ − ds∘dz)` of a step after which all products are `aim`; `changes` are the scaled ones `W⁻¹ ds` and `W dz` of the step before
/// the correction.
pub(super) fn corrected_right_side(lambda: Triple, aim: f64, changes: [Triple; 2]) -> Triple {
    let square = product(lambda, lambda);
    let changed = product(changes[0], changes[1]);
    let mut wanted = [0, 1, 2].map(|i| -square[i] - changed[i]);
    wanted[0] += aim;
    quotient(lambda, wanted)
}

/// How many times a scaled change leads from `λ` to the edge of the cone.
pub(super) fn way_to_edge(lambda: Triple, change: Triple) -> f64 {
    let size = sqrt(determinant(lambda));
    let unit = lambda.map(|x| x / size);
    let ahead = unit[0] * change[0] - unit[1] * change[1] - unit[2] * change[2];
    let share = (ahead + change[0]) / (unit[0] + 1.0);
    let aside = [1, 2].map(|i| change[i] - share * unit[i]);
    let loss = (length_of(aside) - ahead) / size;
    if loss > 0.0 {
        1.0 / loss
    } else {
        f64::INFINITY
    }
}

fn dot(x: Triple, y: Triple) -> f64 {
    x[0] * y[0] + x[1] * y[1] + x[2] * y[2]
}

/// The product of the algebra of the cone, `(x·y, x₀ y₁ + y₀ x₁)`.
fn product(x: Triple, y: Triple) -> Triple {
    [
        dot(x, y),
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

/// A vector in the hyperbolic rotation that takes the axis of the cone to `axis`.
fn turned(axis: Triple, x: Triple) -> Triple {
    let along = axis[1] * x[1] + axis[2] * x[2];
    let share = x[0] + along / (1.0 + axis[0]);
    [
        axis[0] * x[0] + along,
        x[1] + share * axis[1],
        x[2] + share * axis[2],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLACK: Triple = [2.0, 0.7, -1.1];
    const MULTIPLIER: Triple = [0.4, -0.3, 0.2];

    /// W scales both to the same, which has the product of both, and `W⁻¹` takes it back.
    #[test]
    fn slacks_and_multipliers_are_scaled_to_the_same() {
        let scaling = Scaling::new(SLACK, MULTIPLIER).expect("both are inside");
        let lambda = scaling.times(MULTIPLIER);
        let same = scaling.inverse_times(SLACK);
        for (x, y) in lambda.iter().zip(same) {
            assert!((x - y).abs() < 4e-16, "{lambda:?}, {same:?}");
        }
        assert!((dot(lambda, lambda) - dot(SLACK, MULTIPLIER)).abs() < 1e-15);
        for (x, y) in scaling
            .times(scaling.inverse_times(SLACK))
            .iter()
            .zip(SLACK)
        {
            assert!((x - y).abs() < 4e-15);
        }
        assert!(Scaling::new(SLACK, [0.3, 0.3, 0.2]).is_none());
        assert!(Scaling::new([-2.0, 0.7, -1.1], MULTIPLIER).is_none());
    }

    /// Whichever way a change goes, with as much of it the edge is met, and with a little less not.
    #[test]
    fn a_step_ends_on_the_edge() {
        for k in 0..64 {
            let (sin, cos) = (0.1 * f64::from(k)).sin_cos();
            let change = [0.3 - 0.02 * f64::from(k), sin, 1.5 * cos];
            let way = way_to_edge(SLACK, change);
            let at = |part: f64| [0, 1, 2].map(|i| SLACK[i] + part * way * change[i]);
            if way == f64::INFINITY {
                assert!(change[0] >= length_of([change[1], change[2]]), "{change:?}");
                continue;
            }
            let [inside, edge] = [0.999, 1.0].map(at);
            assert!(inside[0] > length_of([inside[1], inside[2]]));
            assert!(
                (edge[0] - length_of([edge[1], edge[2]])).abs() < 1e-13 * (1.0 + edge[0].abs())
            );
        }
    }

    /// The right side is that with which the products become what is wanted: `λ ∘ right = aim e − λ∘λ − ds∘dz`.
    #[test]
    fn a_right_side_undoes_the_product() {
        let changes = [[0.1, -0.2, 0.3], [-0.4, 0.5, 0.1]];
        let right = corrected_right_side(SLACK, 0.7, changes);
        let left = product(SLACK, right);
        let (square, changed) = (product(SLACK, SLACK), product(changes[0], changes[1]));
        for i in 0..3 {
            let aim = if i == 0 { 0.7 } else { 0.0 };
            assert!((left[i] + square[i] + changed[i] - aim).abs() < 1e-14);
        }
    }
}
