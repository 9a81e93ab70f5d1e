//! The workspace for the work on constraints, and what is made in it of one state: the metric, and the
//! multipliers of least norm.

use super::algebra::{backward, cholesky, dot, forward, length, solve_triangle};
use super::constraint_workspace;
use crate::{StepError, System, Vector};

/// The workspace, in parts.
pub(super) struct Workspace<'r, M> {
    pub n: usize,
    pub m: usize,
    /// `L`, lower triangle, row after row.
    pub metric: M,
    /// Whether that is the factor of `M + Gᵀ W G`, since `M` alone has none.
    pub is_lent: bool,
    /// `G`, row after row; while rows are chosen, `yₖ` relative to their lengths.
    pub matrix: &'r mut [f64],
    /// Orthonormal vectors that span the chosen `yₖ`.
    pub basis: &'r mut [f64],
    /// `R` of `yⱼ = Σᵢ Rᵢⱼ basisᵢ`, row after row.
    pub triangle: &'r mut [f64],
    pub positions: &'r mut [f64],
    pub rates: &'r mut [f64],
    /// A number for each row.
    pub row: &'r mut [f64],
    /// A number for each coordinate.
    pub column: &'r mut [f64],
    pub before: &'r mut [f64],
    pub lengths: &'r mut [f64],
}

impl<M: Vector> Workspace<'_, M> {
    /// Makes `L` at a state; the matrix of the constraints is there already, with zeros in the columns
    /// of coordinates that are fixed.
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
        self.is_lent = false;
        if cholesky(self.metric.as_mut_slice(), self.lengths).is_ok() {
            return Ok(());
        }
        // Something has no inertia of its own; perhaps the constraints hold it.
        self.is_lent = true;
        system.mass_matrix(t, q, &mut self.metric);
        self.fix(fixed);
        let metric = self.metric.as_mut_slice();
        let is_weighed = &mut *self.row;
        is_weighed.fill(0.0);
        loop {
            // What was there before this round counts, so that the order of rows makes no difference.
            let inertias = &mut *self.lengths;
            for (inertia, entry) in inertias.iter_mut().zip(metric.iter().step_by(n + 1)) {
                *inertia = *entry;
            }
            let greatest = inertias.iter().fold(0.0, |a: f64, b| a.max(*b));
            let mut found = false;
            for substitute in [Substitute::AlongConstraint, Substitute::Uniform(greatest)] {
                // Rows that move nothing that has inertia come last.
                if found {
                    break;
                }
                for (is_weighed, row) in is_weighed.iter_mut().zip(self.matrix.chunks_exact(n)) {
                    if *is_weighed == 0.0
                        && add_square(metric, row, substitute.weight(row, inertias))
                    {
                        *is_weighed = 1.0;
                        found = true;
                    }
                }
            }
            if !found {
                break;
            }
        }
        cholesky(metric, self.lengths).map_err(|singular| StepError::Singular { singular, t })
    }

    /// The greatest error of a vector `L⁻¹ x` by rounding, relative to its length: the roundoff of
    /// `n` operations, times what elimination took from the diagonal.
    pub fn roundoff(&self) -> f64 {
        let least = self.lengths.iter().fold(1.0, |least: f64, x| least.min(*x));
        8.0 * (self.n + self.m) as f64 * f64::EPSILON / least
    }

    /// Takes the coordinates that are not 0 in `fixed` out of the metric.
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

    /// Takes them out of the rows.
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

    /// From `c`, the reactions along the basis, in `row`: the multipliers `λ` of least norm with
    /// `Σ λₖ yₖ = Σ cⱼ basisⱼ`.
    ///
    /// With rows of length 1, `μₖ = λₖ |yₖ|`, and with those that were not chosen as `X` makes them
    /// of those that were, `μ = [I X]ᵀ (I + X Xᵀ)⁻¹ b` is the least `μ` with `[I X] μ = b`.
    pub fn least_norm(
        &mut self,
        multipliers: &mut [f64],
        chosen: impl Fn(usize) -> usize,
        rank: usize,
    ) {
        self.combine(&chosen, rank);
        let (n, lengths) = (self.n, &*self.positions);
        // What the chosen rows alone would carry.
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
        // At least the unit matrix: nothing stops it.
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

    /// Lengths of all rows to `positions`; and for each row `k` that was not chosen, how the chosen
    /// ones make it, `yₖ/|yₖ| = Σⱼ Xⱼₖ yⱼ/|yⱼ|`, to the front of its row of `matrix`. Those of the
    /// chosen are 0.
    pub fn combine(&mut self, chosen: impl Fn(usize) -> usize, rank: usize) {
        let n = self.n;
        for (row, length_of) in self.matrix.chunks_exact_mut(n).zip(&mut *self.positions) {
            forward(self.metric.as_slice(), row);
            *length_of = length(row);
        }
        for (k, row) in self.matrix.chunks_exact_mut(n).enumerate() {
            let whole = self.positions[k];
            if whole > 0.0 && !(0..rank).any(|j| chosen(j) == k) {
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
                    *x = along * self.positions[chosen(j)] / whole;
                }
            } else {
                row.fill(0.0);
            }
        }
    }
}

/// The inertia that stands in for that of coordinates that have none, in the metric of a constraint.
#[derive(Clone, Copy)]
enum Substitute {
    /// As much as a push along the constraint meets: so no coordinate that has inertia is given more than it has, however
    /// little of the row it is.
    AlongConstraint,
    /// This much, or any.
    Uniform(f64),
}

impl Substitute {
    /// The weight of `g gᵀ`; not finite if nothing of the row has inertia.
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

/// Adds `weight g gᵀ` to a matrix; says whether it could.
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

/// Hands out the workspace of the constraints, in parts.
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
            is_lent: false,
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

/// The first parts of `all`, which have these lengths; `None` if it is too short. No copy of this for every machine and
/// every piece of work is compiled.
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
