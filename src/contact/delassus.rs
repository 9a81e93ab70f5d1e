//! What forces in contacts do to their rates: `G = Wᵀ M⁻¹ W`, with the constraints of the machine obeyed.
//!
//! With the Cholesky factor `M = L Lᵀ`, a row `w` becomes `y = L⁻¹ wᵀ`, without what of it lies along the rows of the
//! constraints; `Gᵢⱼ = yᵢ·yⱼ`, and a force along `w` adds `L⁻ᵀ y` to the accelerations.

use std::vec;
use std::vec::Vec;

use crate::constraints::algebra::{backward, cholesky, dot, forward, length, remove};
use crate::{Singular, System, Vector};

/// A row of the constraints that depends on others beyond this, relative to its length, adds nothing.
const INDEPENDENT: f64 = 1e-10;

/// Inertia at a state.
pub(super) struct Inertia {
    factor: Vec<f64>,
    /// Orthonormal vectors along the constraints of the machine.
    held: Vec<Vec<f64>>,
}

impl Inertia {
    pub fn new<S: System>(system: &S, t: f64, q: &S::Vector) -> Result<Inertia, Singular> {
        let n = q.as_slice().len();
        let mut matrix = S::Matrix::zeros(n * n);
        system.mass_matrix(t, q, &mut matrix);
        let mut factor = matrix.as_slice().to_vec();
        cholesky(&mut factor, &mut vec![0.0; n])?;
        let mut inertia = Inertia {
            factor,
            held: Vec::new(),
        };
        let m = system.constraints().len();
        let mut rows = vec![0.0; m * n];
        if m > 0 {
            system.constraint_matrix(t, q, &mut rows);
        }
        for row in rows.chunks_exact(n.max(1)) {
            let whole = {
                let mut y = row.to_vec();
                forward(&inertia.factor, &mut y);
                length(&y)
            };
            let mut y = inertia.image(row);
            let left = length(&y);
            if left > INDEPENDENT * whole {
                y.iter_mut().for_each(|y| *y /= left);
                inertia.held.push(y);
            }
        }
        Ok(inertia)
    }

    /// `y` of a row.
    pub fn image(&self, row: &[f64]) -> Vec<f64> {
        let mut y = row.to_vec();
        forward(&self.factor, &mut y);
        // Twice is enough: W. Kahan, in B. N. Parlett, The Symmetric Eigenvalue Problem, 1998, section 6.9.
        for _ in 0..2 {
            for unit in &self.held {
                remove(unit, &mut y);
            }
        }
        y
    }

    /// What forces along images add to accelerations, or impulses to rates.
    pub fn response(&self, images: &[Vec<f64>], forces: impl IntoIterator<Item = f64>) -> Vec<f64> {
        let n = self.factor.len().isqrt();
        let mut sum = vec![0.0; n];
        for (image, force) in images.iter().zip(forces) {
            for (sum, y) in sum.iter_mut().zip(image) {
                *sum += force * y;
            }
        }
        backward(&self.factor, &mut sum);
        sum
    }
}

/// `G`, row after row.
pub(super) fn matrix(images: &[Vec<f64>]) -> Vec<f64> {
    let rows = images.iter();
    rows.flat_map(|a| images.iter().map(|b| dot(a, b)))
        .collect()
}
