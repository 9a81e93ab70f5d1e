//! The Delassus matrix `G = Wᵀ M⁻¹ W`, the effect of contact forces on contact rates, with the constraints of the machine satisfied.
//!
//! With the Cholesky factor `M = L Lᵀ`, a row `w` becomes `y = L⁻¹ wᵀ`, without its component along the rows of the
//! constraints; `Gᵢⱼ = yᵢ·yⱼ`, and a force along `w` adds `L⁻ᵀ y` to the accelerations.

use std::vec::Vec;

use crate::constraints::algebra::{Profile, dot, length, remove};
use crate::{Singular, System, Vector};

/// A row of the constraints that depends on others beyond this, relative to its length, adds nothing.
const INDEPENDENT: f64 = 1e-10;

/// The number of coordinates from which on it saves time to skip zeros of images: a contact of a pile moves only a few bodies.
const MANY: usize = 16;

/// Inertia at a state.
#[derive(Clone, Debug, Default)]
pub(super) struct Inertia {
    factor: Vec<f64>,
    /// Where the rows of the factor begin: bodies that move by themselves have few entries.
    profile: Profile,
    /// Orthonormal vectors along the constraints of the machine, so many of these.
    held: Vec<Vec<f64>>,
    independent: usize,
    /// The rows of the constraints, and an image of one.
    rows: Vec<f64>,
    whole: Vec<f64>,
}

impl Inertia {
    pub fn new<S: System>(system: &S, t: f64, q: &S::Vector) -> Result<Inertia, Singular> {
        let n = q.as_slice().len();
        let mut inertia = Inertia::default();
        inertia.evaluate(system, (t, q), &mut S::Matrix::zeros(n * n))?;
        Ok(inertia)
    }

    /// Evaluates it at another state. `matrix` is memory for the mass matrix.
    pub fn evaluate<S: System>(
        &mut self,
        system: &S,
        (t, q): (f64, &S::Vector),
        matrix: &mut S::Matrix,
    ) -> Result<(), Singular> {
        let n = q.as_slice().len();
        system.mass_matrix(t, q, matrix);
        self.factor.clear();
        self.factor.extend_from_slice(matrix.as_slice());
        self.profile.read(&self.factor);
        self.profile.cholesky(&mut self.factor)?;
        self.independent = 0;
        let m = system.constraints().len();
        if m == 0 {
            return Ok(());
        }
        self.rows.resize(m * n, 0.0);
        system.constraint_matrix(t, q, &mut self.rows);
        for k in 0..m {
            let row = &self.rows[k * n..][..n];
            self.whole.clear();
            self.whole.extend_from_slice(row);
            self.profile.forward(&self.factor, &mut self.whole);
            if self.held.len() == self.independent {
                self.held.push(Vec::with_capacity(n));
            }
            let (known, rest) = self.held.split_at_mut(self.independent);
            let y = &mut rest[0];
            y.clone_from(&self.whole);
            without(known, y);
            let left = length(y);
            if left > INDEPENDENT * length(&self.whole) {
                y.iter_mut().for_each(|y| *y /= left);
                self.independent += 1;
            }
        }
        Ok(())
    }

    /// Writes `y` of a row.
    pub fn write_image(&self, row: &[f64], y: &mut Vec<f64>) {
        y.clear();
        y.extend_from_slice(row);
        self.profile.forward(&self.factor, y);
        without(&self.held[..self.independent], y);
    }

    /// `y` of a row.
    pub fn image(&self, row: &[f64]) -> Vec<f64> {
        let mut y = Vec::new();
        self.write_image(row, &mut y);
        y
    }

    /// What forces along images add to accelerations, or impulses to rates.
    pub fn response(&self, images: &[Vec<f64>], forces: impl IntoIterator<Item = f64>) -> Vec<f64> {
        let mut sum = Vec::new();
        self.write_response(images, forces, &mut sum);
        sum
    }

    /// Writes what [`response`](Self::response) says.
    pub fn write_response(
        &self,
        images: &[Vec<f64>],
        forces: impl IntoIterator<Item = f64>,
        sum: &mut Vec<f64>,
    ) {
        sum.clear();
        sum.resize(self.factor.len().isqrt(), 0.0);
        for (image, force) in images.iter().zip(forces) {
            for (sum, y) in sum.iter_mut().zip(image) {
                *sum += force * y;
            }
        }
        self.profile.backward(&self.factor, sum);
    }
}

/// Removes what lies along unit vectors. Twice is enough: W. Kahan, in B. N. Parlett, The Symmetric Eigenvalue Problem, 1998, section 6.9.
fn without(units: &[Vec<f64>], y: &mut [f64]) {
    for _ in 0..2 {
        for unit in units {
            remove(unit, y);
        }
    }
}

/// `G`, row after row.
pub(super) fn matrix(images: &[Vec<f64>]) -> Vec<f64> {
    let mut g = Vec::new();
    write_matrix(images, &mut g, &mut Vec::new());
    g
}

/// Writes `G`, row after row. `entries` is memory for this.
pub(super) fn write_matrix(images: &[Vec<f64>], g: &mut Vec<f64>, entries: &mut Vec<usize>) {
    let width = images.len();
    g.clear();
    g.resize(width * width, 0.0);
    let is_long = images.first().is_some_and(|image| image.len() >= MANY);
    for (i, a) in images.iter().enumerate() {
        entries.clear();
        if is_long {
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
