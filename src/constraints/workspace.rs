//! The workspace for constraints and computations in it for one state: the metric, and the multipliers of least norm.

use super::algebra::{backward, cholesky, dot, forward, length, solve_triangle};
use super::constraint_workspace;
use crate::math::sqrt;
use crate::{StepError, System, Vector};

/// The workspace, divided into parts.
pub(super) struct Workspace<'r, M> {
    pub n: usize,
    pub m: usize,
    /// `L`, lower triangle, row after row.
    pub metric: M,
    /// Whether it is the factor of `M + Gᵀ W G`, because `M` is singular.
    pub is_augmented: bool,
    /// `G`, row after row; while rows are chosen, `yₖ` relative to their lengths.
    pub matrix: &'r mut [f64],
    /// Orthonormal vectors that span the chosen `yₖ`.
    pub basis: &'r mut [f64],
    /// `R` of `yⱼ = Σᵢ Rᵢⱼ basisᵢ`, row after row.
    pub triangle: &'r mut [f64],
    pub positions: &'r mut [f64],
    pub rates: &'r mut [f64],
    /// One number for each row.
    pub row: &'r mut [f64],
    /// One number for each coordinate.
    pub column: &'r mut [f64],
    pub before: &'r mut [f64],
    pub lengths: &'r mut [f64],
}

impl<M: Vector> Workspace<'_, M> {
    /// Factorizes the metric at a state. The matrix of the constraints must already be there, with zeros in the columns
    /// of fixed coordinates.
    pub fn factor<S: System<Matrix = M>>(
        &mut self,
        system: &S,
        t: f64,
        q: &S::Vector,
        fixed: Option<&S::Vector>,
    ) -> Result<(), StepError> {
        let n = self.n;
        system.mass_matrix(t, q, &mut self.metric);
        self.fix(fixed);
        self.is_augmented = false;
        if cholesky(self.metric.as_mut_slice(), self.lengths).is_ok() {
            return Ok(());
        }
        // Some coordinate has no inertia of its own; the constraints may hold it.
        self.is_augmented = true;
        system.mass_matrix(t, q, &mut self.metric);
        self.fix(fixed);
        let metric = self.metric.as_mut_slice();
        let is_weighed = &mut *self.row;
        is_weighed.fill(0.0);
        loop {
            // Only the inertias before this pass count, so that the order of rows has no effect.
            let inertias = &mut *self.lengths;
            for (inertia, entry) in inertias.iter_mut().zip(metric.iter().step_by(n + 1)) {
                *inertia = *entry;
            }
            let greatest = inertias.iter().fold(0.0, |a: f64, b| a.max(*b));
            let mut has_added_rows = false;
            for substitute in [Substitute::AlongConstraint, Substitute::Uniform(greatest)] {
                // Rows that move nothing with inertia come last.
                if has_added_rows {
                    break;
                }
                for (is_weighed, row) in is_weighed.iter_mut().zip(self.matrix.chunks_exact(n)) {
                    if *is_weighed == 0.0
                        && add_square(metric, row, substitute.weight(row, inertias))
                    {
                        *is_weighed = 1.0;
                        has_added_rows = true;
                    }
                }
            }
            if !has_added_rows {
                break;
            }
        }
        cholesky(metric, self.lengths).map_err(|singular| StepError::Singular { singular, t })
    }

    /// The largest round-off of a vector `L⁻¹ x`, relative to its length: the round-off of `n` operations, divided by
    /// what elimination left of the diagonal.
    pub fn roundoff(&self) -> f64 {
        let least = self.lengths.iter().fold(1.0, |least: f64, x| least.min(*x));
        8.0 * (self.n + self.m) as f64 * f64::EPSILON / sqrt(least)
    }

    /// Removes the coordinates that are nonzero in `fixed` from the metric.
    fn fix<V: Vector>(&mut self, fixed: Option<&V>) {
        let Some(fixed) = fixed else {
            return;
        };
        let (n, metric) = (self.n, self.metric.as_mut_slice());
        for j in (0..n).filter(|&j| fixed.as_slice()[j] != 0.0) {
            for i in 0..n {
                metric[i * n + j] = 0.0;
                metric[j * n + i] = 0.0;
            }
            metric[j * n + j] = 1.0;
        }
    }

    /// Removes the coordinates that are nonzero in `fixed` from the rows.
    pub fn fix_rows<V: Vector>(&mut self, fixed: Option<&V>) {
        let Some(fixed) = fixed else {
            return;
        };
        for row in self.matrix.chunks_exact_mut(self.n.max(1)) {
            for (g, _) in row
                .iter_mut()
                .zip(fixed.as_slice())
                .filter(|(_, fixed)| **fixed != 0.0)
            {
                *g = 0.0;
            }
        }
    }

    /// Computes the multipliers `λ` of least norm with `Σ λₖ yₖ = Σ cⱼ basisⱼ` from the reactions `c` along the
    /// basis, in `row`.
    ///
    /// With rows of length 1, `μₖ = λₖ |yₖ|`. If `X` expresses the rows that were not chosen by the chosen ones,
    /// `μ = [I X]ᵀ (I + X Xᵀ)⁻¹ b` is the shortest `μ` with `[I X] μ = b`.
    pub fn least_norm(
        &mut self,
        multipliers: &mut [f64],
        chosen: impl Fn(usize) -> usize,
        rank: usize,
    ) {
        self.combine(&chosen, rank);
        let (n, lengths) = (self.n, &*self.positions);
        // The multipliers if only the chosen rows carried load.
        self.column[..rank].copy_from_slice(&self.row[..rank]);
        solve_triangle(self.triangle, rank, self.column);
        for j in 0..rank {
            self.column[j] *= lengths[chosen(j)];
        }
        for i in 0..rank {
            for j in 0..rank {
                let shared = self.matrix.chunks_exact(n).map(|x| x[i] * x[j]);
                let own = if i == j { 1.0 } else { 0.0 };
                self.triangle[i * rank + j] = own + shared.sum::<f64>();
            }
        }
        // The matrix is at least the unit matrix, so the factorization cannot fail.
        let _ = cholesky(&mut self.triangle[..rank * rank], self.lengths);
        forward(&self.triangle[..rank * rank], &mut self.column[..rank]);
        backward(&self.triangle[..rank * rank], &mut self.column[..rank]);
        let rows = self.matrix.chunks_exact(n).zip(lengths);
        for (multiplier, (x, length)) in multipliers.iter_mut().zip(rows) {
            let shared = dot(&x[..rank], &self.column[..rank]);
            *multiplier = if *length > 0.0 { shared / length } else { 0.0 };
        }
        for j in 0..rank {
            let k = chosen(j);
            multipliers[k] = self.column[j] / lengths[k];
        }
    }

    /// Writes the lengths of all rows to `positions`, and for each row `k` that was not chosen the coefficients of
    /// `yₖ/|yₖ| = Σⱼ Xⱼₖ yⱼ/|yⱼ|` in the chosen ones to the beginning of its row of `matrix`. The rows of the chosen
    /// ones become 0.
    pub fn combine(&mut self, chosen: impl Fn(usize) -> usize, rank: usize) {
        let n = self.n;
        for (row, length_of) in self.matrix.chunks_exact_mut(n).zip(&mut *self.positions) {
            forward(self.metric.as_slice(), row);
            *length_of = length(row);
        }
        for (k, row) in self.matrix.chunks_exact_mut(n).enumerate() {
            let length = self.positions[k];
            if length > 0.0 && !(0..rank).any(|j| chosen(j) == k) {
                for (along, basis) in self
                    .column
                    .iter_mut()
                    .zip(self.basis.chunks_exact(n))
                    .take(rank)
                {
                    *along = dot(basis, row);
                }
                solve_triangle(self.triangle, rank, self.column);
                row.fill(0.0);
                for (j, (x, along)) in row.iter_mut().zip(&*self.column).take(rank).enumerate() {
                    *x = along * self.positions[chosen(j)] / length;
                }
            } else {
                row.fill(0.0);
            }
        }
    }
}

/// The substitute, in the metric of a constraint, for the inertia of coordinates that have none.
#[derive(Clone, Copy)]
enum Substitute {
    /// The inertia that a push along the constraint meets. So a coordinate that has inertia is not given more than it
    /// has, however small its part in the row is.
    AlongConstraint,
    /// This inertia, or any if it is 0.
    Uniform(f64),
}

impl Substitute {
    /// The weight of `g gᵀ`; not finite if the row moves nothing with inertia.
    fn weight(self, g: &[f64], inertias: &[f64]) -> f64 {
        match self {
            Substitute::AlongConstraint => {
                let pushed = g
                    .iter()
                    .zip(inertias)
                    .filter(|(_, inertia)| **inertia > 0.0);
                let yields: f64 = pushed.map(|(g, inertia)| g * g / inertia).sum();
                1.0 / yields
            }
            Substitute::Uniform(inertia) => {
                let any = if inertia > 0.0 { inertia } else { 1.0 };
                any / dot(g, g)
            }
        }
    }
}

/// Adds `weight g gᵀ` to a matrix; returns whether the weight allows it.
fn add_square(matrix: &mut [f64], g: &[f64], weight: f64) -> bool {
    let n = g.len();
    if !(weight > 0.0 && weight.is_finite()) {
        return false;
    }
    for i in 0..n {
        for j in 0..n {
            matrix[i * n + j] += weight * g[i] * g[j];
        }
    }
    true
}

/// Hands out the workspace of the constraints, divided into parts.
pub(super) fn in_workspace<S: System, R>(
    system: &S,
    t: f64,
    coordinates: usize,
    work: impl FnOnce(&mut Workspace<'_, S::Matrix>) -> Result<R, StepError>,
) -> Result<R, StepError> {
    let (n, m) = (coordinates, system.constraints().len());
    let rank = m.min(n);
    system.with_workspace(constraint_workspace(n, m), |workspace| {
        let [
            matrix,
            basis,
            triangle,
            positions,
            rates,
            row,
            column,
            before,
            lengths,
        ] = workspace
            .and_then(|all| divided(all, [m * n, rank * n, rank * rank, m, m, m, n, n, n]))
            .ok_or(StepError::NoWorkspace { t })?;
        work(&mut Workspace {
            n,
            m,
            metric: S::Matrix::zeros(n * n),
            is_augmented: false,
            matrix,
            basis,
            triangle,
            positions,
            rates,
            row,
            column,
            before,
            lengths,
        })
    })
}

/// The first parts of `all`, with these lengths; `None` if it is too short. As a separate function it is not compiled
/// again for every machine and every use.
fn divided<const PARTS: usize>(
    mut all: &mut [f64],
    lengths: [usize; PARTS],
) -> Option<[&mut [f64]; PARTS]> {
    let mut parts = core::array::from_fn(|_| <&mut [f64]>::default());
    for (part, length) in parts.iter_mut().zip(lengths) {
        (*part, all) = all.split_at_mut_checked(length)?;
    }
    Some(parts)
}
