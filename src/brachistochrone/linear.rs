//! Small symmetric systems.

use std::vec::Vec;

/// A square matrix by rows.
pub(super) type Matrix = Vec<Vec<f64>>;

/// What is left of a diagonal entry in an elimination, relative to the entry, may be roundoff below this.
const SMALLEST_PIVOT: f64 = 1e-14;

/// `x·y`.
pub(super) fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// `M x`.
pub(super) fn times(matrix: &Matrix, x: &[f64]) -> Vec<f64> {
    matrix.iter().map(|row| dot(row, x)).collect()
}

/// `M = L Lᵀ`, Cholesky.
#[derive(Clone, Debug)]
pub(super) struct Cholesky {
    lower: Matrix,
}

impl Cholesky {
    /// Factors a symmetric matrix.
    ///
    /// # Errors
    /// The row at which it is not positive definite, and what is left there of the diagonal, relative to it.
    pub(super) fn new(matrix: &Matrix) -> Result<Cholesky, (usize, f64)> {
        let n = matrix.len();
        let mut lower = std::vec![std::vec![0.0; n]; n];
        for i in 0..n {
            for j in 0..i {
                let left = matrix[i][j] - dot(&lower[i][..j], &lower[j][..j]);
                lower[i][j] = left / lower[j][j];
            }
            let left = matrix[i][i] - dot(&lower[i][..i], &lower[i][..i]);
            let ratio = left / matrix[i][i].abs();
            if ratio.is_nan() || ratio <= SMALLEST_PIVOT {
                return Err((i, if ratio.is_nan() { 0.0 } else { ratio }));
            }
            lower[i][i] = left.sqrt();
        }
        Ok(Cholesky { lower })
    }

    /// `M⁻¹ x`.
    pub(super) fn solve(&self, x: &[f64]) -> Vec<f64> {
        let n = x.len();
        let mut y = x.to_vec();
        for i in 0..n {
            y[i] = (y[i] - dot(&self.lower[i][..i], &y[..i])) / self.lower[i][i];
        }
        for i in (0..n).rev() {
            let above: f64 = (i + 1..n).map(|k| self.lower[k][i] * y[k]).sum();
            y[i] = (y[i] - above) / self.lower[i][i];
        }
        y
    }

    /// `√det M`.
    pub(super) fn root_of_determinant(&self) -> f64 {
        (0..self.lower.len()).map(|i| self.lower[i][i]).product()
    }
}
