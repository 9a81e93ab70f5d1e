//! What forces in contacts do to their rates: `G = Wᵀ M⁻¹ W`, with the constraints of the machine obeyed.
//!
//! With the Cholesky factor `M = L Lᵀ`, a row `w` becomes `y = L⁻¹ wᵀ`, without what of it lies along the rows of the
//! constraints; `Gᵢⱼ = yᵢ·yⱼ`, and a force along `w` adds `L⁻ᵀ y` to the accelerations.

use std::vec;
use std::vec::Vec;

use crate::constraints::algebra::{Profile, dot, length, remove};
use crate::{Singular, System, Vector};

/// A row of the constraints that depends on others beyond this, relative to its length, adds nothing.
const INDEPENDENT: f64 = 1e-10;

/// From so many coordinates on it is worth while to leave out zeros of images: contacts of a pile move a few bodies each.
const MANY: usize = 16;

/// Inertia at a state.
pub(super) struct Inertia {
    factor: Vec<f64>,
    /// Where the rows of the factor begin: bodies that move by themselves have few entries.
    profile: Profile,
    /// Orthonormal vectors along the constraints of the machine.
    held: Vec<Vec<f64>>,
}

impl Inertia {
    pub fn new<S: System>(system: &S, t: f64, q: &S::Vector) -> Result<Inertia, Singular> {
        let n = q.as_slice().len();
        let mut matrix = S::Matrix::zeros(n * n);
        system.mass_matrix(t, q, &mut matrix);
        let mut factor = matrix.as_slice().to_vec();
        let profile = Profile::of(&factor);
        profile.cholesky(&mut factor)?;
        let mut inertia = Inertia {
            factor,
            profile,
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
                inertia.profile.forward(&inertia.factor, &mut y);
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
        self.profile.forward(&self.factor, &mut y);
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
        self.profile.backward(&self.factor, &mut sum);
        sum
    }
}

/// `G`, row after row.
pub(super) fn matrix(images: &[Vec<f64>]) -> Vec<f64> {
    let width = images.len();
    let mut g = vec![0.0; width * width];
    let is_long = images.first().is_some_and(|image| image.len() >= MANY);
    let mut entries: Vec<usize> = Vec::new();
    for (i, a) in images.iter().enumerate() {
        if is_long {
            entries.clear();
            entries.extend((0..a.len()).filter(|k| a[*k] != 0.0));
        }
        let is_sparse = is_long && 2 * entries.len() < a.len();
        for (j, b) in images[..=i].iter().enumerate() {
            let entry = if is_sparse {
                entries.iter().fold(0.0, |sum, k| sum + a[*k] * b[*k])
            } else {
                dot(a, b)
            };
            (g[i * width + j], g[j * width + i]) = (entry, entry);
        }
    }
    g
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Products of all pairs, zeros and all, in the order of the entries.
    #[test]
    fn zeros_that_are_left_out_change_no_bit() {
        let mut state = 7_u64;
        let mut random = move || {
            state = (state.wrapping_mul(6_364_136_223_846_793_005)).wrapping_add(1);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        for n in [3, MANY - 1, MANY, 40] {
            for full in [0.1, 0.4, 0.6, 1.0] {
                let mut image = || -> Vec<f64> {
                    let entry = |_| if random() < full { random() - 0.5 } else { 0.0 };
                    (0..n).map(entry).collect()
                };
                let images: Vec<Vec<f64>> = (0..9).map(|_| image()).collect();
                let found = matrix(&images);
                for (i, a) in images.iter().enumerate() {
                    for (j, b) in images.iter().enumerate() {
                        let expected = (0..n).fold(0.0, |sum, k| sum + a[k] * b[k]);
                        assert_eq!(found[9 * i + j], expected, "{n} {full} {i} {j}");
                    }
                }
            }
        }
    }
}
