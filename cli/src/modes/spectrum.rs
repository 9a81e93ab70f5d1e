//! The eigenvalues and shapes of `ẍ = K x + C ẋ`.
//!
//! What costs digits is taken out first: time and coordinates are scaled; directions in which nothing pulls back, `K z = 0`,
//! are eigenvectors of 0 and leave the matrix, in which they would stand as Jordan blocks whose eigenvalues come out as
//! ±√ε. What is left is the real Schur form of nalgebra; each eigenvalue then gets its vectors from the singular values of
//! `A − λ`, is corrected by Rayleigh's quotient over left and right vector, and gets a bound on its error, their inner
//! product being the reciprocal of its condition (G. H. Golub and C. F. Van Loan, *Matrix Computations*, 4th ed. 2013,
//! section 7.2.2).

use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{Complex, DMatrix, DVector, Schur};

type Vector = DVector<Complex<f64>>;

/// One motion `x(t) = Re(shape e^{λt})`; of a pair of conjugate ones, that with the positive imaginary part.
pub struct Mode {
    /// λ, in 1/s: exactly real, imaginary or zero where it is so but for rounding.
    pub lambda: Complex<f64>,
    /// The amplitudes of the coordinates, the largest of them 1.
    pub shape: Vec<Complex<f64>>,
}

/// The share of the largest singular value of a matrix of n rows below which others are nothing but rounding.
pub fn rank_tolerance(n: usize) -> f64 {
    64.0 * n as f64 * f64::EPSILON
}

/// The modes, slow ones first; `None` where the iterations do not end.
pub fn modes(k: &DMatrix<f64>, c: &DMatrix<f64>) -> Option<Vec<Mode>> {
    let n = k.nrows();
    let Scaled { k, c, scales, rate } = Scaled::of(k, c);

    let (free, bound) = split(&k);
    // y = (b, v) with x = Σ z a + W b, v = ẋ: b' = Wᵀ v, v' = K W b + C v.
    let m = bound.ncols();
    let mut a = DMatrix::zeros(m + n, m + n);
    a.view_mut((0, m), (m, n)).copy_from(&bound.transpose());
    a.view_mut((m, 0), (n, m)).copy_from(&(&k * &bound));
    a.view_mut((m, m), (n, n)).copy_from(&c);

    let mut modes: Vec<Mode> = free
        .into_iter()
        .map(|z| Mode {
            lambda: Complex::new(0.0, 0.0),
            shape: shape(&z.map(|x| Complex::new(x, 0.0)), &scales),
        })
        .collect();
    let eigenvalues = Schur::try_new(a.clone(), f64::EPSILON, 10_000)?.complex_eigenvalues();
    let mut found: Vec<Complex<f64>> = Vec::new();
    for lambda in eigenvalues
        .iter()
        .copied()
        .filter(|lambda| lambda.im >= 0.0)
    {
        let close = |other: &&Complex<f64>| (**other - lambda).norm() <= 1e-8;
        let nth = found.iter().filter(close).count();
        found.push(lambda);
        let pair = Eigenpair::of(&a, lambda, nth);
        let lambda = pair.settled(&a);
        if lambda == Complex::new(0.0, 0.0) {
            continue; // drifts along a direction that is there already
        }
        let velocity = pair.right.rows(m, n).into_owned();
        modes.push(Mode {
            lambda: lambda * rate,
            shape: shape(&velocity, &scales),
        });
    }
    modes.sort_by(|a, b| {
        let key = |mode: &Mode| (mode.lambda.im, mode.lambda.norm(), mode.lambda.re);
        let ((a1, a2, a3), (b1, b2, b3)) = (key(a), key(b));
        a1.total_cmp(&b1)
            .then(a2.total_cmp(&b2))
            .then(a3.total_cmp(&b3))
    });
    Some(modes)
}

/// The equations in coordinates and time of such a scale that no entry is large because of its unit.
struct Scaled {
    k: DMatrix<f64>,
    c: DMatrix<f64>,
    /// x = scales · scaled x, powers of 2.
    scales: DVector<f64>,
    /// About one radian of the fastest oscillation takes one unit of the scaled time, in 1/s.
    rate: f64,
}

impl Scaled {
    fn of(k: &DMatrix<f64>, c: &DMatrix<f64>) -> Scaled {
        let mut scales = DVector::from_element(k.nrows(), 1.0);
        let (mut k, mut c) = (k.clone(), c.clone());
        // Before balancing the largest entry says nothing of how fast the machine is: a force on an angle in a large unit of
        // length is as large as one likes. So both are balanced as if they were equally large, then by what they are.
        let (mut from_k, mut from_c) = (k.amax(), c.amax());
        for _ in 0..2 {
            let share = |m: &DMatrix<f64>, size: f64| m.abs() / if size > 0.0 { size } else { 1.0 };
            let step = balance_parlett_reinsch(&mut (share(&k, from_k) + share(&c, from_c)));
            let balance = |m: &DMatrix<f64>| m.map_with_location(|i, j, x| x * step[j] / step[i]);
            (k, c) = (balance(&k), balance(&c));
            scales.component_mul_assign(&step);
            let rate = k.amax().sqrt().max(c.amax());
            (from_k, from_c) = (rate * rate, rate);
        }
        let rate = if from_c > 0.0 { from_c } else { 1.0 };
        k /= rate * rate;
        c /= rate;
        Scaled { k, c, scales, rate }
    }
}

/// Directions with `K z = 0`, each with as few coordinates in it as can be, and an orthonormal basis of what is across.
fn split(k: &DMatrix<f64>) -> (Vec<DVector<f64>>, DMatrix<f64>) {
    let n = k.nrows();
    let svd = k.clone().svd(false, true);
    let v_t = svd.v_t.unwrap_or_else(|| DMatrix::identity(n, n));
    let limit = rank_tolerance(n) * svd.singular_values.max();
    let is_free = |i: &usize| svd.singular_values[*i] <= limit;
    let (free, bound): (Vec<usize>, Vec<usize>) = (0..n).partition(is_free);
    let bound: Vec<DVector<f64>> = bound.iter().map(|&i| v_t.row(i).transpose()).collect();
    let bound = match bound.is_empty() {
        true => DMatrix::zeros(n, 0),
        false => DMatrix::from_columns(&bound),
    };
    let mut rows: Vec<DVector<f64>> = free.iter().map(|&i| v_t.row(i).transpose()).collect();
    // Gauss and Jordan: each row alone in one coordinate.
    for i in 0..rows.len() {
        let (row, column) = (i..rows.len())
            .map(|r| (r, rows[r].icamax()))
            .max_by(|a, b| rows[a.0][a.1].abs().total_cmp(&rows[b.0][b.1].abs()))
            .unwrap_or((i, 0));
        rows.swap(i, row);
        let pivot = rows[i].clone() / rows[i][column];
        for (r, other) in rows.iter_mut().enumerate() {
            if r == i {
                *other = pivot.clone();
            } else {
                let factor = other[column];
                *other -= &pivot * factor;
            }
        }
    }
    for row in &mut rows {
        let limit = rank_tolerance(n) * row.amax();
        row.iter_mut()
            .filter(|x| x.abs() <= limit)
            .for_each(|x| *x = 0.0);
    }
    rows.sort_by_key(|row| row.iter().position(|x| *x != 0.0));
    (rows, bound)
}

/// An eigenvalue with its vectors.
struct Eigenpair {
    lambda: Complex<f64>,
    left: Vector,
    right: Vector,
}

impl Eigenpair {
    /// The `nth` of several that belong to one eigenvalue: the vectors of that one among the smallest singular values.
    fn of(a: &DMatrix<f64>, lambda: Complex<f64>, nth: usize) -> Eigenpair {
        let size = a.nrows();
        let complex = a.map(|x| Complex::new(x, 0.0));
        let mut pair = Eigenpair {
            lambda,
            left: Vector::zeros(size),
            right: Vector::zeros(size),
        };
        // The second time round with the corrected eigenvalue.
        for _ in 0..2 {
            let mut shifted = complex.clone();
            for i in 0..size {
                shifted[(i, i)] -= pair.lambda;
            }
            let svd = shifted.svd(true, true);
            let (Some(u), Some(v_t)) = (svd.u, svd.v_t) else {
                return pair;
            };
            // Of a defective eigenvalue there is one vector only.
            let is_there = |&i: &usize| svd.singular_values[i] <= 1e-6 * svd.singular_values[0];
            let last = Some(size - 1 - nth.min(size - 1)).filter(is_there);
            let last = last.unwrap_or(size - 1);
            pair.left = u.column(last).into_owned();
            pair.right = v_t.row(last).adjoint();
            let product = pair.left.dotc(&pair.right);
            let image = &complex * &pair.right - &pair.right * pair.lambda;
            let correction = pair.left.dotc(&image) / product;
            // Of a nearly defective eigenvalue the quotient says nothing; it may be 0/0.
            if correction.norm() <= 1e-6 {
                pair.lambda += correction;
            } else {
                break;
            }
        }
        pair
    }

    /// The eigenvalue, its real or imaginary part exactly zero where its condition leaves no more of it than rounding.
    fn settled(&self, a: &DMatrix<f64>) -> Complex<f64> {
        let product = self.left.dotc(&self.right).norm();
        let error =
            8.0 * a.nrows() as f64 * f64::EPSILON * a.norm() / product.max(f64::EPSILON.sqrt());
        let settle = |x: f64| if x.abs() <= error { 0.0 } else { x };
        Complex::new(settle(self.lambda.re), settle(self.lambda.im))
    }
}

/// The amplitudes in the coordinates themselves, the largest of them 1.
///
/// What is nothing but rounding is told from the balanced amplitudes: in a large unit a length may be 1e-13 beside an angle
/// of 1 and count as much.
fn shape(balanced: &Vector, scales: &DVector<f64>) -> Vec<Complex<f64>> {
    let largest = |amplitudes: &mut dyn Iterator<Item = Complex<f64>>| {
        amplitudes.map(|x| x.norm()).fold(0.0, f64::max)
    };
    let own = |(x, d): (&Complex<f64>, &f64)| x * *d;
    // Of several that are equally large but for rounding, the first.
    let limit = (1.0 - 1e-9) * largest(&mut balanced.iter().zip(scales).map(own));
    let first = balanced.iter().zip(scales).map(own);
    let unit = first.filter(|x| x.norm() > 0.0).find(|x| x.norm() >= limit);
    let unit = unit.unwrap_or(Complex::new(1.0, 0.0));
    let rounding = 1e-12 * largest(&mut balanced.iter().copied()) / unit.norm();
    let settle = |x: f64| if x.abs() <= rounding { 0.0 } else { x };
    balanced
        .iter()
        .map(|x| x / unit)
        .zip(scales)
        .map(|(x, d)| Complex::new(settle(x.re) * *d, settle(x.im) * *d))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers between −1 and 1, always the same.
    fn random(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        }
    }

    /// Every mode obeys the equation of motion, and all eigenvalues together have the trace of C: matrices without any
    /// structure, in units that differ by many powers of ten.
    #[test]
    fn modes_obey_the_equations_that_they_come_from() {
        for seed in 0..40 {
            let mut next = random(seed);
            let n = 1 + seed as usize % 7;
            let units: Vec<f64> = (0..n)
                .map(|i| 10.0_f64.powi(6 * (i as i32 % 3) - 6))
                .collect();
            let mut matrix =
                |size: f64| DMatrix::from_fn(n, n, |i, j| size * next() * units[i] / units[j]);
            let (k, c) = (matrix(1e4), matrix(30.0));
            let modes = modes(&k, &c).expect("an end");
            let mut trace = 0.0;
            for Mode { lambda, shape } in &modes {
                trace += if lambda.im > 0.0 {
                    2.0 * lambda.re
                } else {
                    lambda.re
                };
                for i in 0..n {
                    let mut left = lambda * lambda * shape[i];
                    let mut size = left.norm();
                    for j in 0..n {
                        let term = (Complex::new(k[(i, j)], 0.0) + lambda * c[(i, j)]) * shape[j];
                        left -= term;
                        size += term.norm();
                    }
                    // Backward error of a 2n × 2n problem, and what may be settled to 0 in a shape. Row by row, since
                    // each is its own unit: the rows of a balanced matrix are of one size.
                    let bound = rank_tolerance(2 * n) + 1e-12;
                    assert!(left.norm() <= bound * size, "seed {seed}: {left} of {size}");
                }
            }
            assert!(
                (trace - c.trace()).abs() <= 1e-10 * (30.0 * n as f64 + 100.0),
                "seed {seed}: {trace}"
            );
        }
    }

    #[test]
    fn what_nothing_pulls_back_is_free_exactly() {
        // Two masses and a spring, and a third on its own: 0, 0 and √2.
        let k = DMatrix::from_row_slice(3, 3, &[-1.0, 1.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, 0.0]);
        let modes = modes(&k, &DMatrix::zeros(3, 3)).expect("an end");
        let lambdas: Vec<Complex<f64>> = modes.iter().map(|mode| mode.lambda).collect();
        assert_eq!(lambdas[..2], [Complex::new(0.0, 0.0); 2]);
        assert_eq!(lambdas[2].re, 0.0);
        assert!((lambdas[2].im - 2.0_f64.sqrt()).abs() <= 1e-14);
        let real = |mode: &Mode| -> Vec<f64> { mode.shape.iter().map(|x| x.re).collect() };
        assert_eq!(real(&modes[1]), [0.0, 0.0, 1.0]);
        assert!(
            real(&modes[0])
                .iter()
                .zip([1.0, 1.0, 0.0])
                .all(|(x, y)| (x - y).abs() <= 1e-14)
        );
    }

    #[test]
    fn equal_frequencies_have_shapes_of_their_own() {
        let k = DMatrix::from_diagonal_element(3, 3, -4.0);
        let modes = modes(&k, &DMatrix::zeros(3, 3)).expect("an end");
        assert_eq!(modes.len(), 3);
        let shapes = DMatrix::from_fn(3, 3, |i, j| modes[j].shape[i]);
        assert!(shapes.determinant().norm() > 0.1, "{shapes}");
    }

    /// A double eigenvalue with one vector comes out as two that are √ε apart, and the vector twice.
    #[test]
    fn critical_damping_is_no_trouble() {
        let k = DMatrix::from_element(1, 1, -9.0);
        let c = DMatrix::from_element(1, 1, -6.0);
        let modes = modes(&k, &c).expect("an end");
        for mode in &modes {
            assert!(
                (mode.lambda - Complex::new(-3.0, 0.0)).norm() <= 1e-6,
                "{}",
                mode.lambda
            );
        }
        assert!(!modes.is_empty());
    }
}
