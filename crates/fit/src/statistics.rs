//! Statistics of a minimum: estimates, their uncertainties, and which of them the data determine.
//!
//! With residuals weighted by their standard deviations, the covariance of the estimates is `(Jᵀ J)⁻¹`, times the variance of unit
//! weight `|r|² / (m − p)` where these deviations are known only up to a factor (G. A. F. Seber, C. J. Wild, *Nonlinear
//! Regression*, 1989, section 2.1). Where columns of J are dependent, this inverse exists only in the directions on which the
//! residuals depend. These are found by the singular values of J, with columns scaled to equal length so that units play no part.

use nalgebra::{DMatrix, DVector};

use crate::least_squares::{Minimum, active_bounds};

/// How far the data determine a fitted number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It has an estimate and a standard error.
    Estimated,
    /// It is at a bound.
    Bound,
    /// The residuals do not depend on it.
    Ineffective,
    /// The residuals depend on it, but other numbers can have the same effect.
    Entangled,
}

/// The statistics of a minimum.
#[derive(Clone, Debug)]
pub struct Statistics {
    /// How many measurements there are.
    pub measurements: usize,
    /// The number of directions that the residuals determine.
    pub determined: usize,
    /// The number of measurements minus the number of these directions.
    pub freedom: usize,
    /// The sum of squares of the weighted residuals.
    pub chi_squared: f64,
    /// The variance of unit weight estimated from the residuals; NaN without degrees of freedom.
    pub variance: f64,
    /// How far each number is determined.
    pub standing: Vec<Standing>,
    /// The covariance matrix; for numbers that are not determined, within the directions that are.
    pub covariance: DMatrix<f64>,
    /// The singular values of J with its columns scaled to one length, relative to the greatest.
    pub singular_values: Vec<f64>,
    /// Null directions among the entangled numbers: a column for each, with a row for each number.
    pub null: DMatrix<f64>,
}

impl Statistics {
    /// The statistics of a minimum. `sizes` are the scales of the fitted numbers, `exact` is the relative error of
    /// the derivatives, and `is_scaled` says that the weights are known only up to a factor. The residuals depend on a number if its
    /// effect on all of them exceeds the error of the greatest effect, or if `has_effect` says so: that they do in one of several
    /// quantities whose weights differ by more than derivatives are exact.
    pub fn of(
        at: &Minimum,
        bounds: &[[f64; 2]],
        sizes: &[f64],
        (exact, is_scaled): (f64, bool),
        has_effect: impl Fn(usize) -> bool,
    ) -> Statistics {
        let count = at.x.len();
        let norms: Vec<f64> = at.jacobian.column_iter().map(|c| c.norm()).collect();
        let effect = |j: usize| norms[j] * sizes[j].abs();
        let greatest = (0..count).map(effect).fold(0.0, f64::max);
        let held = active_bounds(at, bounds);
        let mut standing: Vec<Standing> = (0..count)
            .map(|j| {
                if held[j] {
                    Standing::Bound
                } else if effect(j) > exact * greatest || has_effect(j) {
                    Standing::Estimated
                } else {
                    Standing::Ineffective
                }
            })
            .collect();
        let open: Vec<usize> = (0..count)
            .filter(|j| standing[*j] == Standing::Estimated)
            .collect();
        let scaled = DMatrix::from_fn(at.residuals.len(), open.len(), |i, j| {
            at.jacobian[(i, open[j])] / norms[open[j]]
        });
        let (values, right) = singular(scaled);
        let largest = values.iter().copied().fold(0.0, f64::max);
        let (significant, lost): (Vec<usize>, Vec<usize>) =
            (0..open.len()).partition(|i| values[*i] > exact * largest);
        let part = |which: &[usize], weigh: &dyn Fn(f64) -> f64| {
            DMatrix::from_fn(open.len(), which.len(), |j, i| {
                right[(which[i], j)] * weigh(values[which[i]]) / norms[open[j]]
            })
        };
        let root = part(&significant, &|value| 1.0 / value);
        let freedom = at.residuals.len().saturating_sub(significant.len());
        let chi_squared: f64 = at.residuals.iter().map(|r| r * r).sum();
        let variance = match freedom {
            0 => f64::NAN,
            _ => chi_squared / freedom as f64,
        };
        let factor = if is_scaled { variance } else { 1.0 };
        let inner = &root * root.transpose() * factor;
        let mut covariance = DMatrix::zeros(count, count);
        for (a, j) in open.iter().enumerate() {
            for (b, k) in open.iter().enumerate() {
                covariance[(*j, *k)] = inner[(a, b)];
            }
        }
        let outside = part(&lost, &|_| 1.0);
        let mut null = DMatrix::zeros(count, lost.len());
        // A null direction is known to about the square root of the relative error of the derivatives.
        let threshold = exact.sqrt();
        for (a, j) in open.iter().enumerate() {
            let share = outside.row(a).norm() * norms[*j];
            if share > threshold {
                standing[*j] = Standing::Entangled;
                for i in 0..lost.len() {
                    null[(*j, i)] = outside[(a, i)];
                }
            }
        }
        Statistics {
            measurements: at.residuals.len(),
            determined: significant.len(),
            freedom,
            chi_squared,
            variance,
            standing,
            covariance,
            singular_values: values.iter().map(|value| value / largest).collect(),
            null,
        }
    }

    /// The standard error of a number; `None` where the data do not determine it.
    pub fn standard_error(&self, j: usize) -> Option<f64> {
        let is_estimated = self.standing[j] == Standing::Estimated;
        is_estimated.then(|| self.covariance[(j, j)].sqrt())
    }

    /// The correlation of two numbers; `None` where the data do not determine one of them.
    pub fn correlation(&self, j: usize, k: usize) -> Option<f64> {
        let errors = self.standard_error(j)? * self.standard_error(k)?;
        Some(if j == k {
            1.0
        } else {
            (self.covariance[(j, k)] / errors).clamp(-1.0, 1.0)
        })
    }

    /// The standard error of a function of the numbers with this gradient; the data must determine the function.
    pub fn standard_error_of(&self, gradient: &[f64]) -> f64 {
        let gradient = DVector::from_column_slice(gradient);
        (gradient.transpose() * &self.covariance * &gradient)[(0, 0)]
            .max(0.0)
            .sqrt()
    }
}

/// Singular values and right singular vectors, with a row for each column of the matrix.
fn singular(matrix: DMatrix<f64>) -> (Vec<f64>, DMatrix<f64>) {
    let columns = matrix.ncols();
    if columns == 0 {
        return (Vec::new(), DMatrix::zeros(0, 0));
    }
    // With at least as many rows as columns there is a right vector for each column.
    let square = if matrix.nrows() >= columns {
        matrix.qr().r()
    } else {
        let mut square = DMatrix::zeros(columns, columns);
        square.rows_mut(0, matrix.nrows()).copy_from(&matrix);
        square
    };
    let svd = square.svd(false, true);
    let right = svd
        .v_t
        .unwrap_or_else(|| DMatrix::identity(columns, columns));
    (svd.singular_values.iter().copied().collect(), right)
}
