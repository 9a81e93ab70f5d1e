//! Solvers for small dense systems.

/// A square matrix by rows.
pub(super) type Matrix = Vec<Vec<f64>>;

/// A pivot smaller than this, relative to the diagonal entry it comes from, may be round-off.
const SMALLEST_PIVOT: f64 = 1e-14;

/// `x·y`.
pub(super) fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// `M x`.
pub(super) fn times(matrix: &Matrix, x: &[f64]) -> Vec<f64> {
    matrix.iter().map(|row| dot(row, x)).collect()
}

/// The Cholesky factorization `M = L Lᵀ`.
#[derive(Clone, Debug)]
pub(super) struct Cholesky {
    lower: Matrix,
}

impl Cholesky {
    /// Factors a symmetric matrix.
    ///
    /// # Errors
    /// If it is not positive definite: the row, and its pivot relative to the diagonal entry.
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
        self.solve_upper(&y)
    }

    /// `L⁻ᵀ x`.
    pub(super) fn solve_upper(&self, x: &[f64]) -> Vec<f64> {
        let n = self.lower.len();
        let mut y = x.to_vec();
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

/// The factorization `P M = L U` with partial pivoting.
#[derive(Clone, Debug)]
pub(super) struct Lu {
    factors: Matrix,
    order: Vec<usize>,
}

impl Lu {
    /// Factors a square matrix; `None` where a pivot vanishes or is NaN.
    pub(super) fn new(mut rows: Matrix) -> Option<Lu> {
        let n = rows.len();
        // Rows are scaled because each has its own unit.
        let largest = |row: &Vec<f64>| row.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let mut scales: Vec<f64> = rows.iter().map(largest).collect();
        let mut order: Vec<usize> = (0..n).collect();
        for k in 0..n {
            let size = |i: &usize| rows[*i][k].abs() / scales[*i];
            let pivot = (k..n).max_by(|a, b| size(a).total_cmp(&size(b)))?;
            rows.swap(k, pivot);
            order.swap(k, pivot);
            scales.swap(k, pivot);
            if !(rows[k][k].abs() > 0.0 && rows[k][k].is_finite()) {
                return None;
            }
            let (above, below) = rows.split_at_mut(k + 1);
            let above = &above[k];
            for row in below {
                let factor = row[k] / above[k];
                row[k] = factor;
                if factor != 0.0 {
                    for (x, y) in row[k + 1..].iter_mut().zip(&above[k + 1..]) {
                        *x -= factor * y;
                    }
                }
            }
        }
        Some(Lu {
            factors: rows,
            order,
        })
    }

    /// Whether the determinant is positive.
    pub(super) fn is_positive(&self) -> bool {
        let mut order = self.order.clone();
        let negative = (0..order.len()).filter(|&i| self.factors[i][i] < 0.0);
        let mut odd = negative.count() % 2 == 1;
        for i in 0..order.len() {
            while order[i] != i {
                let target = order[i];
                order.swap(i, target);
                odd = !odd;
            }
        }
        !odd
    }

    /// `M⁻¹ x`.
    pub(super) fn solve(&self, x: &[f64]) -> Vec<f64> {
        let n = self.factors.len();
        let mut y: Vec<f64> = self.order.iter().map(|&i| x[i]).collect();
        for i in 0..n {
            y[i] -= dot(&self.factors[i][..i], &y[..i]);
        }
        for i in (0..n).rev() {
            y[i] = (y[i] - dot(&self.factors[i][i + 1..], &y[i + 1..])) / self.factors[i][i];
        }
        y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_determinant_has_its_sign() {
        let rows = |rows: [[f64; 3]; 3]| rows.map(|row| row.to_vec()).to_vec();
        for (matrix, positive) in [
            ([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]], false),
            ([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]], true),
            ([[2.0, 1.0, 0.0], [4.0, 1.0, 0.0], [0.0, 5.0, -3.0]], true),
        ] {
            let factors = Lu::new(rows(matrix)).unwrap();
            assert_eq!(factors.is_positive(), positive, "{matrix:?}");
            let x = factors.solve(&[1.0, 2.0, 3.0]);
            for (row, right) in matrix.iter().zip([1.0, 2.0, 3.0]) {
                assert!((dot(row, &x) - right).abs() < 1e-14);
            }
        }
        assert!(Lu::new(rows([[1.0; 3]; 3])).is_none());
    }
}
