//! Special functions for closed forms of motions, in `f64`, accurate to a few units in the last
//! place for moderate arguments.

use std::f64::consts::{FRAC_PI_2, TAU};

/// The arithmetic-geometric mean of two positive numbers (C. F. Gauss, 1799).
pub fn agm(mut a: f64, mut b: f64) -> f64 {
    // Each step squares the relative difference: it reaches 2⁻⁵³ after six steps from values near
    // 1, after ten from 10⁻³⁰⁰.
    for _ in 0..12 {
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
    }
    a
}

/// The complete elliptic integral of the first kind, K, of parameter `m = k²` below 1.
pub fn elliptic_k(m: f64) -> f64 {
    FRAC_PI_2 / agm(1.0, (1.0 - m).sqrt())
}

/// Jacobi's amplitude am(u, m), continued beyond π, of parameter `m = k²` in [0, 1).
///
/// M. Abramowitz, I. A. Stegun, *Handbook of Mathematical Functions*, 1964, 16.4.
pub fn amplitude(u: f64, m: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - m).sqrt());
    let mut ratios = Vec::new();
    while ratios.last().is_none_or(|ratio| *ratio > f64::EPSILON) {
        let c = (a - b) / 2.0;
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
        ratios.push(c / a);
    }
    let last = 2f64.powi(ratios.len() as i32) * a * u;
    let halve = |phi: f64, ratio: &f64| (phi + (ratio * phi.sin()).asin()) / 2.0;
    ratios.iter().rev().fold(last, halve)
}

/// Jacobi's sn, cn and dn of `u`, of parameter `m = k²` in [0, 1).
pub fn jacobi(u: f64, m: f64) -> [f64; 3] {
    let (sn, cn) = amplitude(u, m).sin_cos();
    [sn, cn, (1.0 - m * sn * sn).sqrt()]
}

/// The eccentric anomaly u that solves Kepler's equation `u − e sin u = M`, for
/// an eccentricity `e` in [0, 1).
pub fn kepler(e: f64, mean: f64) -> f64 {
    // The left side is convex from π on and concave before it, so Newton's method
    // started at π does not overshoot.
    let turns = (mean / TAU).floor() * TAU;
    let rest = mean - turns;
    let mut u = std::f64::consts::PI;
    for _ in 0..60 {
        u -= (u - e * u.sin() - rest) / (1.0 - e * u.cos());
    }
    turns + u
}

/// The characteristic values a₀(Q) and b₁(Q) of Mathieu's equation
/// `y″ + (A − 2 Q cos 2x) y = 0`: the least A with an even solution of period π, and the least A
/// with an odd solution of period 2π.
///
/// They are the least eigenvalues of the tridiagonal matrices of the Fourier series (N. W.
/// McLachlan, *Theory and Application of Mathieu Functions*, 1947, section 3.10), made symmetric,
/// and are found by bisection on the number of negative pivots.
pub fn mathieu_edges(q: f64) -> [f64; 2] {
    // Row j has (2j)² or (2j + 1)² on its diagonal, against Q beside it: rows beyond the 24th
    // change nothing for Q up to 10.
    const ROWS: usize = 24;
    let even = |j: usize| {
        (
            (2 * j * 2 * j) as f64,
            if j == 1 { 2.0 * q * q } else { q * q },
        )
    };
    let odd = |j: usize| {
        let square = ((2 * j + 1) * (2 * j + 1)) as f64;
        (if j == 0 { square - q } else { square }, q * q)
    };
    [
        least_eigenvalue(ROWS, even, -2.0 * q.abs() - 1.0),
        least_eigenvalue(ROWS, odd, -2.0 * q.abs() - 1.0),
    ]
}

/// The least eigenvalue of a symmetric tridiagonal matrix. `row` gives a diagonal entry and the
/// square of the off-diagonal entry in the row before; `low` is a lower bound.
fn least_eigenvalue(rows: usize, row: impl Fn(usize) -> (f64, f64), low: f64) -> f64 {
    let is_below_all = |x: f64| {
        let mut pivot = f64::INFINITY;
        (0..rows).all(|j| {
            let (diagonal, square) = row(j);
            pivot = diagonal - x - square / pivot;
            pivot > 0.0
        })
    };
    let (mut low, mut high) = (low, row(0).0);
    while low < (low + high) / 2.0 && (low + high) / 2.0 < high {
        let middle = (low + high) / 2.0;
        if is_below_all(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// The mean of a smooth periodic function over its period by the trapezoidal rule, whose error is
/// the function's Fourier coefficient of order `points`.
pub fn mean(period: f64, points: usize, f: impl Fn(f64) -> f64) -> f64 {
    let sum: f64 = (0..points)
        .map(|i| f(period * i as f64 / points as f64))
        .sum();
    sum / points as f64
}
