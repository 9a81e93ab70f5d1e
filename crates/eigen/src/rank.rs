//! The numerical null space of a matrix: directions that it maps to round-off only.

use std::rc::Rc;

use nalgebra::{DMatrix, DVector};

/// A singular value of a matrix with its vectors: `K right = value · left`, vectors of length 1.
pub struct Direction {
    /// The singular value.
    pub value: f64,
    /// Bound on its error; a value below it counts as 0.
    pub rounding: f64,
    /// The largest singular value of the independent block that this one belongs to.
    pub largest: f64,
    /// The indices of that block.
    pub part: Rc<[usize]>,
    /// The left singular vector.
    pub left: DVector<f64>,
    /// The right singular vector.
    pub right: DVector<f64>,
}

impl Direction {
    /// Whether the matrix maps this direction to zero within round-off.
    pub fn is_free(&self) -> bool {
        self.value <= self.rounding
    }
}

/// The fraction of the largest singular value of a matrix with n rows below which others are round-off.
pub fn tolerance(n: usize) -> f64 {
    64.0 * n as f64 * f64::EPSILON
}

/// The singular values of a square matrix whose entries are known up to `bounds`, computed separately for each of its independent blocks.
///
/// Separate blocks matter because a spring is not soft just because another one, not connected to it, is stiff. `None` where
/// the iterations do not converge.
///
/// The uncertainty B of the entries changes a singular value σ = uᵀ K v by at most |u|ᵀ B |v| to first order (G. W. Stewart
/// and J. Sun, *Matrix Perturbation Theory*, 1990, section V.4).
pub fn directions_beyond(matrix: &DMatrix<f64>, bounds: &DMatrix<f64>) -> Option<Vec<Direction>> {
    let n = matrix.nrows();
    let mut directions = Vec::new();
    for part in parts(matrix) {
        let part: Rc<[usize]> = part.into();
        let size = part.len();
        let own = DMatrix::from_fn(size, size, |i, j| matrix[(part[i], part[j])]);
        // The iteration uses an absolute tolerance, for values relative to 1.
        let scale = Some(own.amax()).filter(|x| *x > 0.0).unwrap_or(1.0);
        let svd = (own / scale).try_svd(true, true, f64::EPSILON, 10_000)?;
        let (u, v_t) = (svd.u?, svd.v_t?);
        let embed = |entries: &mut dyn Iterator<Item = f64>| {
            let mut vector = DVector::zeros(n);
            for (place, entry) in part.iter().zip(entries) {
                vector[*place] = entry;
            }
            vector
        };
        let largest = svd.singular_values.max();
        for (i, value) in svd.singular_values.iter().enumerate() {
            let left = embed(&mut u.column(i).iter().copied());
            let right = embed(&mut v_t.row(i).iter().copied());
            let known = left.abs().dot(&(bounds * right.abs()));
            directions.push(Direction {
                value: value * scale,
                rounding: known.max(tolerance(size) * largest * scale),
                largest: largest * scale,
                part: part.clone(),
                left,
                right,
            });
        }
    }
    Some(directions)
}

/// The sets of indices that no entry of the matrix couples, each in ascending order.
pub fn parts(matrix: &DMatrix<f64>) -> Vec<Vec<usize>> {
    let n = matrix.nrows();
    let mut is_seen = vec![false; n];
    let mut parts = Vec::new();
    for first in 0..n {
        if is_seen[first] {
            continue;
        }
        is_seen[first] = true;
        let (mut part, mut next) = (vec![first], 0);
        while let Some(&i) = part.get(next) {
            next += 1;
            for j in 0..n {
                if !is_seen[j] && (matrix[(i, j)] != 0.0 || matrix[(j, i)] != 0.0) {
                    is_seen[j] = true;
                    part.push(j);
                }
            }
        }
        part.sort_unstable();
        parts.push(part);
    }
    parts
}
