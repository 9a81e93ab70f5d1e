//! Linear algebra in a few lines, in place.
#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "what is not a number passes no test here"
)]

use crate::Singular;
use crate::math::sqrt;

/// Cholesky's factorization `L Lᵀ`, to the lower triangle; and to `shares` the remainder of each
/// diagonal element, `Lᵢᵢ / √aᵢᵢ`.
pub(crate) fn cholesky(a: &mut [f64], shares: &mut [f64]) -> Result<(), Singular> {
    let n = root(a.len());
    let roundoff = 4.0 * n as f64 * f64::EPSILON;
    for j in 0..n {
        let diagonal = a[j * n + j];
        for i in j..n {
            let mut sum = a[i * n + j];
            for k in 0..j {
                sum -= a[i * n + k] * a[j * n + k];
            }
            if i > j {
                a[i * n + j] = sum / a[j * n + j];
                continue;
            }
            if !(sum > roundoff * diagonal) {
                return Err(Singular::new(j, sum, diagonal));
            }
            a[j * n + j] = sqrt(sum);
            shares[j] = sqrt(sum / diagonal);
        }
    }
    Ok(())
}

/// `L⁻¹ x` in place.
pub(crate) fn forward(l: &[f64], x: &mut [f64]) {
    let n = x.len();
    for i in 0..n {
        let known = dot(&l[i * n..][..i], &x[..i]);
        x[i] = (x[i] - known) / l[i * n + i];
    }
}

/// `L⁻ᵀ x` in place.
pub(crate) fn backward(l: &[f64], x: &mut [f64]) {
    let n = x.len();
    for i in (0..n).rev() {
        let mut sum = x[i];
        for k in i + 1..n {
            sum -= l[k * n + i] * x[k];
        }
        x[i] = sum / l[i * n + i];
    }
}

/// `R⁻¹ x` in place, for the upper triangle `R` of `rank` rows.
pub(super) fn solve_triangle(r: &[f64], rank: usize, x: &mut [f64]) {
    for i in (0..rank).rev() {
        let known = dot(&r[i * rank..][i + 1..rank], &x[i + 1..rank]);
        x[i] = (x[i] - known) / r[i * rank + i];
    }
}

/// Takes out of `x` what it has along a unit vector, and says how much that was.
pub(crate) fn remove(unit: &[f64], x: &mut [f64]) -> f64 {
    let along = dot(unit, x);
    for (x, unit) in x.iter_mut().zip(unit) {
        *x -= along * unit;
    }
    along
}

pub(crate) fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

pub(crate) fn length(x: &[f64]) -> f64 {
    sqrt(dot(x, x))
}

/// Numbers that are smaller than this have fewer digits than others: what becomes of them is no matter of rounding alone. Rates of
/// what comes to rest fall that low.
const UNDERFLOW: f64 = f64::MIN_POSITIVE / f64::EPSILON;

/// `x` relative to a scale that may be 0.
pub(super) fn share(x: f64, scale: f64) -> f64 {
    if x == 0.0 {
        0.0
    } else {
        x.abs() / (scale + UNDERFLOW)
    }
}

/// The number of rows of a square matrix of so many numbers.
pub(super) fn root(numbers: usize) -> usize {
    numbers.isqrt()
}
