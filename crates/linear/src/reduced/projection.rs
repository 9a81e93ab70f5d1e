//! The projection of coordinates onto the constraints.

use lagrangian_scalar::DoubleDouble;
use nalgebra::{DMatrix, DVector, Dyn, SVD};

use super::choice::INDEPENDENT;
use super::{Fault, Reduced};

/// The most iterations of the projection onto the constraints.
const MOST_STEPS: usize = 200;

/// Where the full step is no longer than this, in rad, m, or relative to its coordinate, the residuals are round-off
/// and need not decrease.
const NEARLY_MET: f64 = 1e-14;

/// The smallest nonzero damping, for constraint rows of length 1.
const LEAST_DAMPING: f64 = 1e-3;

/// With this much damping a step is too short to change the residuals: the search is at a minimum that is not 0.
const MOST_DAMPING: f64 = 1e8;

impl Reduced<'_> {
    /// Projects coordinates onto the constraints on positions with the smallest change in the metric of inertia, moving only
    /// coordinates that `may` move. Where full Newton steps fail far from the constraints, damped steps are tried.
    ///
    /// # Errors
    /// If no position is found that meets them.
    pub fn project(
        &mut self,
        q: &mut [DoubleDouble],
        may: &dyn Fn(usize) -> bool,
    ) -> Result<(), Fault> {
        let start = q.to_vec();
        self.project_near(q, may).or_else(|_| {
            q.copy_from_slice(&start);
            self.project_in_steps(q, may, true)
        })
    }

    /// [`project`](Self::project) for a position near the constraints: it takes full steps only and fails rather than
    /// reach another branch.
    ///
    /// # Errors
    /// If no position near it meets the constraints.
    pub fn project_near(
        &mut self,
        q: &mut [DoubleDouble],
        may: &dyn Fn(usize) -> bool,
    ) -> Result<(), Fault> {
        self.project_in_steps(q, may, false)
    }

    fn project_in_steps(
        &mut self,
        q: &mut [DoubleDouble],
        may: &dyn Fn(usize) -> bool,
        is_damped: bool,
    ) -> Result<(), Fault> {
        let n = q.len();
        let m = self.holonomic.len();
        let held: Vec<usize> = (0..m).filter(|k| self.holonomic[*k]).collect();
        if held.is_empty() {
            return Ok(());
        }
        let mut before = f64::INFINITY;
        // Damping as in the method of Levenberg and Marquardt; none as long as full steps lower the residuals.
        let mut damping = 0.0;
        for _ in 0..MOST_STEPS {
            let near: Vec<f64> = q.iter().map(|x| x.hi()).collect();
            let (rows, lower) = (self.rows(&near), self.metric(&near));
            let off = self.positions(q);
            let (matrix, scale) = measured(&rows, &lower, &held, may)?;
            let scaled = |off: &[f64]| DVector::from_fn(held.len(), |i, _| off[held[i]] / scale[i]);
            let residuals = scaled(&off);
            if !residuals.iter().chain(matrix.iter()).all(|x| x.is_finite()) {
                return Err(Fault::Unmet(held[0]));
            }
            let worst = held[residuals.icamax()];
            let svd = matrix
                .try_svd(true, true, f64::EPSILON, 10_000)
                .ok_or(Fault::Unmet(worst))?;
            // Far from the constraints, as where links are nearly stretched, a full step may increase the
            // residuals: the damping grows until they decrease.
            let (step, longest) = loop {
                let step = damped(&svd, &residuals, damping).ok_or(Fault::Unmet(worst))?;
                let step = lower.transpose().solve_upper_triangular(&step);
                let mut step = step.ok_or(Fault::Singular(0))?;
                (0..n).filter(|j| !may(*j)).for_each(|j| step[j] = 0.0);
                let longest = largest_relative_change(&step, &near);
                if !longest.is_finite() {
                    return Err(Fault::Unmet(worst));
                }
                step *= (1.0 / longest).min(1.0);
                if !is_damped || longest <= NEARLY_MET {
                    break (step, longest);
                }
                let tried: Vec<DoubleDouble> = after_step(q, &step);
                if scaled(&self.positions(&tried)).norm() < residuals.norm() {
                    damping = if damping < LEAST_DAMPING {
                        0.0
                    } else {
                        damping / 8.0
                    };
                    break (step, longest);
                }
                damping = (4.0 * damping).max(LEAST_DAMPING);
                if damping > MOST_DAMPING {
                    return Err(Fault::Unmet(worst));
                }
            };
            // The corrections are round-off and no longer decrease.
            if longest == 0.0 || (longest <= NEARLY_MET && longest >= 0.25 * before) {
                break;
            }
            q.copy_from_slice(&after_step(q, &step));
            if longest <= 1e-26 {
                break;
            }
            before = longest;
        }
        self.check_met(q, &held)
    }

    /// Checks each of these constraints against its round-off.
    fn check_met(&mut self, q: &[DoubleDouble], held: &[usize]) -> Result<(), Fault> {
        let off = self.positions(q);
        let near: Vec<f64> = q.iter().map(|x| x.hi()).collect();
        let rows = self.rows(&near);
        let unmet = held.iter().copied().find(|&k| {
            let size: f64 = (0..q.len())
                .map(|j| (rows[(k, j)] * near[j].abs().max(1.0)).abs())
                .sum();
            off[k].is_nan() || off[k].abs() > 1e-12 * size
        });
        unmet.map_or(Ok(()), |k| Err(Fault::Unmet(k)))
    }
}

/// The rows of these constraints among the coordinates that `may` move, measured by the metric `L Lᵀ` with the `lower` factor L and scaled to
/// length 1; and their lengths.
fn measured(
    rows: &DMatrix<f64>,
    lower: &DMatrix<f64>,
    held: &[usize],
    may: &dyn Fn(usize) -> bool,
) -> Result<(DMatrix<f64>, DVector<f64>), Fault> {
    let n = lower.nrows();
    let mut matrix = DMatrix::zeros(held.len(), n);
    let mut scale = DVector::zeros(held.len());
    for (i, &k) in held.iter().enumerate() {
        let row = DVector::from_fn(n, |j, _| if may(j) { rows[(k, j)] } else { 0.0 });
        let measured = lower
            .solve_lower_triangular(&row)
            .ok_or(Fault::Singular(0))?;
        let size = measured.norm();
        scale[i] = if size > 0.0 { size } else { 1.0 };
        matrix.set_row(i, &(measured / scale[i]).transpose());
    }
    Ok((matrix, scale))
}

/// The damped least-squares solution of `A x = r` from the singular value decomposition of A. Components whose
/// singular value is not large beside the damping d are reduced: `x = V (S² + d²)⁻¹ S Uᵀ r` (Marquardt, An algorithm
/// for least-squares estimation of nonlinear parameters, 1963). `None` where there are no singular vectors.
fn damped(
    svd: &SVD<f64, Dyn, Dyn>,
    residuals: &DVector<f64>,
    damping: f64,
) -> Option<DVector<f64>> {
    if damping == 0.0 {
        return svd.solve(residuals, INDEPENDENT).ok();
    }
    let mut parts = svd.u.as_ref()?.transpose() * residuals;
    for (part, s) in parts.iter_mut().zip(svd.singular_values.iter()) {
        *part *= s / (s * s + damping * damping);
    }
    Some(svd.v_t.as_ref()?.transpose() * parts)
}

/// Coordinates after a step.
fn after_step(q: &[DoubleDouble], step: &DVector<f64>) -> Vec<DoubleDouble> {
    let pairs = q.iter().zip(step.iter());
    pairs
        .map(|(q, step)| *q - DoubleDouble::from(*step))
        .collect()
}

/// The largest change, each in rad, m, or relative to its coordinate.
pub fn largest_relative_change(step: &DVector<f64>, q: &[f64]) -> f64 {
    let shares = step.iter().zip(q).map(|(x, q)| x.abs() / q.abs().max(1.0));
    shares.fold(0.0, f64::max)
}
