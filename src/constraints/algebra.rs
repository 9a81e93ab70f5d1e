//! Small dense linear algebra, in place.
#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "what is not a number passes no test here"
)]

use crate::Singular;
use crate::math::sqrt;

/// Computes the Cholesky factorization `L Lᵀ` in the lower triangle, and in `shares` what elimination leaves of each diagonal element,
/// `Lᵢᵢ² / aᵢᵢ`.
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
            shares[j] = sum / diagonal;
        }
    }
    Ok(())
}

/// Computes `L⁻¹ x` in place.
pub(crate) fn forward(l: &[f64], x: &mut [f64]) {
    let n = x.len();
    for i in 0..n {
        let known = dot(&l[i * n..][..i], &x[..i]);
        x[i] = (x[i] - known) / l[i * n + i];
    }
}

/// Computes `L⁻ᵀ x` in place.
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

/// The first nonzero column of each row of a symmetric matrix, and so of its Cholesky factor. (A. George, J. W. Liu, *Computer Solution
/// of Large Sparse Positive Definite Systems*, 1981, chapter 4.) Results have the same bits with and without a profile.
#[cfg(feature = "std")]
#[derive(Clone, Debug, Default)]
pub(crate) struct Profile {
    first: std::vec::Vec<usize>,
}

#[cfg(feature = "std")]
impl Profile {
    /// The profile of a matrix, row after row.
    /// Takes the profile of a matrix, row after row.
    pub fn read(&mut self, a: &[f64]) {
        let n = root(a.len());
        let row = |i: usize| &a[i * n..][..i];
        let first = |i: usize| row(i).iter().position(|a| *a != 0.0).unwrap_or(i);
        self.first.clear();
        self.first.extend((0..n).map(first));
    }

    /// Like [`cholesky`], without the remainders of the diagonal.
    pub fn cholesky(&self, a: &mut [f64]) -> Result<(), Singular> {
        let n = self.first.len();
        let roundoff = 4.0 * n as f64 * f64::EPSILON;
        for j in 0..n {
            let diagonal = a[j * n + j];
            let mut sum = diagonal;
            for k in self.first[j]..j {
                sum -= a[j * n + k] * a[j * n + k];
            }
            if !(sum > roundoff * diagonal) {
                return Err(Singular::new(j, sum, diagonal));
            }
            let pivot = sqrt(sum);
            a[j * n + j] = pivot;
            for i in (j + 1..n).filter(|i| self.first[*i] <= j) {
                let mut sum = a[i * n + j];
                for k in self.first[i].max(self.first[j])..j {
                    sum -= a[i * n + k] * a[j * n + k];
                }
                a[i * n + j] = sum / pivot;
            }
        }
        Ok(())
    }

    /// Computes `L⁻¹ x` in place.
    pub fn forward(&self, l: &[f64], x: &mut [f64]) {
        let n = x.len();
        let begin = x.iter().position(|x| *x != 0.0).unwrap_or(n);
        for i in begin..n {
            let from = self.first[i].max(begin);
            let known = dot(&l[i * n..][from..i.max(from)], &x[from..i.max(from)]);
            x[i] = (x[i] - known) / l[i * n + i];
        }
    }

    /// Computes `L⁻ᵀ x` in place.
    pub fn backward(&self, l: &[f64], x: &mut [f64]) {
        let n = x.len();
        for i in (0..n).rev() {
            let mut sum = x[i];
            for k in (i + 1..n).filter(|k| self.first[*k] <= i) {
                sum -= l[k * n + i] * x[k];
            }
            x[i] = sum / l[i * n + i];
        }
    }
}

/// Computes `R⁻¹ x` in place, for the upper triangle `R` of `rank` rows.
pub(super) fn solve_triangle(r: &[f64], rank: usize, x: &mut [f64]) {
    for i in (0..rank).rev() {
        let known = dot(&r[i * rank..][i + 1..rank], &x[i + 1..rank]);
        x[i] = (x[i] - known) / r[i * rank + i];
    }
}

/// Removes the component along a unit vector from `x`, and returns it.
#[inline]
pub(crate) fn remove(unit: &[f64], x: &mut [f64]) -> f64 {
    let along = dot(unit, x);
    for (x, unit) in x.iter_mut().zip(unit) {
        *x -= along * unit;
    }
    along
}

#[inline]
pub(crate) fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

#[inline]
pub(crate) fn length(x: &[f64]) -> f64 {
    sqrt(dot(x, x))
}

/// Numbers below this may have fewer digits than others when they are processed, so their errors are not rounding alone. Rates of parts
/// that come to rest fall that low.
const UNDERFLOW: f64 = f64::MIN_POSITIVE / f64::EPSILON;

/// `x` relative to a scale that may be 0.
pub(super) fn share(x: f64, scale: f64) -> f64 {
    if x == 0.0 {
        0.0
    } else {
        x.abs() / (scale + UNDERFLOW)
    }
}

/// The number of rows of a square matrix with this number of entries.
pub(super) fn root(numbers: usize) -> usize {
    numbers.isqrt()
}

#[cfg(all(test, feature = "std"))]
mod tests {
    use super::*;

    /// Results within a profile have the same bits as without one: for single bodies, groups of bodies, bands, full matrices.
    #[test]
    fn a_profile_changes_no_bit() {
        let mut state = 11_u64;
        let mut random = move || {
            state = (state.wrapping_mul(6_364_136_223_846_793_005)).wrapping_add(1);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let kinds: [fn(usize, usize) -> bool; 4] = [
            |_, _| false,
            |i, j| i / 3 == j / 3,
            |i, j| i - j < 4 && (i + j) % 3 != 0,
            |_, _| true,
        ];
        for n in [1, 2, 7, 30] {
            for meets in kinds {
                let mut a = std::vec![0.0; n * n];
                for i in 0..n {
                    a[i * n + i] = 2.0 * n as f64 + random();
                    for j in (0..i).filter(|j| meets(i, *j)) {
                        a[i * n + j] = random() - 0.5;
                        a[j * n + i] = a[i * n + j];
                    }
                }
                let (mut whole, mut within) = (a.clone(), a.clone());
                cholesky(&mut whole, &mut std::vec![0.0; n]).expect("positive definite");
                let mut profile = Profile::default();
                profile.read(&a);
                profile.cholesky(&mut within).expect("positive definite");
                for i in 0..n {
                    assert_eq!(
                        whole[i * n..][..=i],
                        within[i * n..][..=i],
                        "row {i} of {n}"
                    );
                }
                for begin in [0, n / 2, n] {
                    let x = |i: usize| {
                        if i < begin {
                            0.0
                        } else {
                            1.0 / (1.0 + i as f64)
                        }
                    };
                    let x: std::vec::Vec<f64> = (0..n).map(x).collect();
                    let (mut one, mut other) = (x.clone(), x);
                    forward(&whole, &mut one);
                    profile.forward(&within, &mut other);
                    assert_eq!(one, other);
                    backward(&whole, &mut one);
                    profile.backward(&within, &mut other);
                    assert_eq!(one, other);
                }
            }
        }
        // A matrix that is not positive definite stops at the same place.
        let flat = [1.0, 1.0, 1.0, 1.0];
        let stops = cholesky(&mut flat.clone(), &mut [0.0; 2]);
        let mut profile = Profile::default();
        profile.read(&flat);
        assert_eq!(profile.cholesky(&mut flat.clone()), stops);
    }
}
