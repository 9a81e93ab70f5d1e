//! Vectors of numbers along a motion.
//!
//! The formulas of contacts are compiled for each type of number, and adapters of arrays would be compiled again for each formula;
//! therefore these few loops.

#![expect(
    clippy::needless_range_loop,
    reason = "iterators over arrays of each type of number are what is avoided here"
)]

use lagrangian_scalar::{Dual, Scalar};

/// `u·v`.
pub(super) fn dot<S: Scalar, const N: usize>(u: [S; N], v: [S; N]) -> S {
    let mut sum = u[0] * v[0];
    for k in 1..N {
        sum = sum + u[k] * v[k];
    }
    sum
}

/// `u − v`.
pub(super) fn difference<S: Scalar, const N: usize>(mut u: [S; N], v: [S; N]) -> [S; N] {
    for k in 0..N {
        u[k] = u[k] - v[k];
    }
    u
}

/// `s u`.
pub(super) fn scaled<S: Scalar, const N: usize>(s: S, mut u: [S; N]) -> [S; N] {
    for k in 0..N {
        u[k] = s * u[k];
    }
    u
}

/// `u / s`.
pub(super) fn quotient<S: Scalar, const N: usize>(mut u: [S; N], s: S) -> [S; N] {
    for k in 0..N {
        u[k] = u[k] / s;
    }
    u
}

/// A vector without its rate.
pub(super) fn value<S: Scalar, const N: usize>(u: [Dual<S>; N]) -> [S; N] {
    let mut value = [S::ZERO; N];
    for k in 0..N {
        value[k] = u[k].value;
    }
    value
}

/// The rate of a vector.
pub(super) fn rate<S: Scalar, const N: usize>(u: [Dual<S>; N]) -> [S; N] {
    let mut rate = [S::ZERO; N];
    for k in 0..N {
        rate[k] = u[k].derivative;
    }
    rate
}

/// `o + Σ cₖ eₖ`: the point with these coordinates in the frame with the origin `o` and the axes `eₖ`.
pub(super) fn point<S: Scalar, const N: usize>(
    origin: [S; N],
    axes: [[S; N]; N],
    coordinates: [S; N],
) -> [S; N] {
    let mut point = origin;
    for k in 0..N {
        for l in 0..N {
            point[l] = point[l] + coordinates[k] * axes[k][l];
        }
    }
    point
}

/// The ground axes.
pub(super) fn ground<S: Scalar, const N: usize>() -> [[S; N]; N] {
    let mut axes = [[S::ZERO; N]; N];
    for k in 0..N {
        axes[k][k] = S::ONE;
    }
    axes
}
