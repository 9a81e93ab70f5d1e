//! The eigenvalues and shapes of `ẍ = K x + C ẋ`.
//!
//! What costs digits is taken out first: coordinates that have nothing to do with one another go separate ways; time and
//! coordinates are scaled; directions in which nothing pulls back, `K z = 0`, are eigenvectors of 0 and leave the matrix, in
//! which they would stand as Jordan blocks whose eigenvalues come out as ±√ε. The eigenvalues of what is left are found in
//! twice the digits, so that a slow decay is as good as a fast one. Each gets a bound on what the digits of K and C leave of
//! it, by its left and right vectors (G. H. Golub and C. F. Van Loan, *Matrix Computations*, 4th ed. 2013, section 7.2.2).

use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{Complex, DMatrix, DVector};

use super::precise::{self, Pair};
use super::rank;

type Vector = DVector<Complex<f64>>;

/// One motion `x(t) = Re(shape e^{λt})`; of a pair of conjugate ones, that with the positive imaginary part.
pub struct Mode {
    /// λ, in 1/s: exactly real, imaginary or zero where it is so but for rounding.
    pub lambda: Complex<f64>,
    /// λ is known up to this, in 1/s. Of a free motion: what is slower could not be told from it.
    pub error: f64,
    /// The amplitudes of the coordinates, the largest of them 1.
    pub shape: Vec<Complex<f64>>,
}

/// All motions near an equilibrium.
#[derive(Default)]
pub struct Modes {
    /// Slow ones first.
    pub modes: Vec<Mode>,
    /// How many more there are whose λ is 0 but for rounding, in ways that are not free.
    pub lost: usize,
    /// They are slower than this, in 1/s.
    pub lost_below: f64,
}

/// The modes; `None` where the iterations do not end.
pub fn modes(k: &DMatrix<f64>, c: &DMatrix<f64>) -> Option<Modes> {
    let n = k.nrows();
    let mut all = Modes::default();
    for part in rank::parts(&(k.abs() + c.abs())) {
        let size = part.len();
        let own = |m: &DMatrix<f64>| DMatrix::from_fn(size, size, |i, j| m[(part[i], part[j])]);
        let Modes {
            modes,
            lost,
            lost_below,
        } = connected(&own(k), &own(c))?;
        all.lost += lost;
        all.lost_below = all.lost_below.max(lost_below);
        all.modes.extend(modes.into_iter().map(|mode| {
            let mut shape = vec![Complex::new(0.0, 0.0); n];
            for (place, x) in part.iter().zip(&mode.shape) {
                shape[*place] = *x;
            }
            Mode { shape, ..mode }
        }));
    }
    all.modes.sort_by(|a, b| {
        let key = |mode: &Mode| (mode.lambda.im, mode.lambda.norm(), mode.lambda.re);
        let ((a1, a2, a3), (b1, b2, b3)) = (key(a), key(b));
        a1.total_cmp(&b1)
            .then(a2.total_cmp(&b2))
            .then(a3.total_cmp(&b3))
    });
    Some(all)
}

/// The modes of coordinates that are all connected, in any order.
fn connected(k: &DMatrix<f64>, c: &DMatrix<f64>) -> Option<Modes> {
    let n = k.nrows();
    let Scaled { k, c, scales, rate } = Scaled::of(k, c);
    let Split {
        free,
        bound,
        drifts,
    } = Split::of(&k, &c)?;
    // y = (b, v) with x = Σ z a + W b, v = ẋ: b' = Wᵀ v, v' = K W b + C v.
    let m = bound.ncols();
    let mut a = DMatrix::zeros(m + n, m + n);
    a.view_mut((0, m), (m, n)).copy_from(&bound.transpose());
    a.view_mut((m, 0), (n, m)).copy_from(&(&k * &bound));
    a.view_mut((m, m), (n, n)).copy_from(&c);

    let mut found = Modes::default();
    for Free { direction, slowest } in free {
        found.modes.push(Mode {
            lambda: Complex::new(0.0, 0.0),
            error: slowest * rate,
            shape: shape(&direction.map(|x| Complex::new(x, 0.0)), &scales),
        });
    }
    let mut zeros = 0;
    for pair in precise::pairs(&a)? {
        let Pair {
            lambda: raw, right, ..
        } = &pair;
        // The entries of K and C are sums of some terms, as many as there are coordinates, as a rule.
        let error = 8.0 * a.nrows() as f64 * pair.error;
        let settle = |x: f64| if x.abs() <= error { 0.0 } else { x };
        let lambda = Complex::new(settle(raw.re), settle(raw.im));
        // Two that rounding has made conjugate are one, twice.
        let times = if raw.im > 0.0 && lambda.im == 0.0 {
            2
        } else {
            1
        };
        if lambda == Complex::new(0.0, 0.0) {
            zeros += times;
            // Drifts, along a direction that is there already.
            if zeros > drifts {
                found.lost = zeros - drifts;
                found.lost_below = found.lost_below.max(error * rate);
            }
            continue;
        }
        for _ in 0..times {
            found.modes.push(Mode {
                lambda: lambda * rate,
                error: error * rate,
                shape: shape(&right.rows(m, n).into_owned(), &scales),
            });
        }
    }
    Some(found)
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
        k /= rate;
        k /= rate;
        c /= rate;
        Scaled { k, c, scales, rate }
    }
}

/// A direction in which nothing pulls back.
struct Free {
    direction: DVector<f64>,
    /// What pulls back may be hidden by rounding; then the motion is slower than this.
    slowest: f64,
}

/// Directions with `K z = 0`, and the others.
struct Split {
    /// Each with as few coordinates in it as can be.
    free: Vec<Free>,
    /// An orthonormal basis of what is across.
    bound: DMatrix<f64>,
    /// Along how many of them nothing brakes: it may drift there with any speed.
    drifts: usize,
}

impl Split {
    fn of(k: &DMatrix<f64>, c: &DMatrix<f64>) -> Option<Split> {
        let n = k.nrows();
        let (free, bound): (Vec<_>, Vec<_>) = rank::directions(k)?
            .into_iter()
            .partition(rank::Direction::is_free);
        let bound: Vec<DVector<f64>> = match free.is_empty() {
            // Without any rounding.
            true => (0..n)
                .map(|i| DVector::from_fn(n, |j, _| f64::from(u8::from(i == j))))
                .collect(),
            false => bound.into_iter().map(|direction| direction.right).collect(),
        };
        let columns = |vectors: &[DVector<f64>]| match vectors.is_empty() {
            true => DMatrix::zeros(n, 0),
            false => DMatrix::from_columns(vectors),
        };
        let rights: Vec<DVector<f64>> = free.iter().map(|d| d.right.clone()).collect();
        let lefts: Vec<DVector<f64>> = free.iter().map(|d| d.left.clone()).collect();
        let (z, y) = (columns(&rights), columns(&lefts));
        // What brakes along free directions, and the size of its terms.
        let brakes = y.tr_mul(&(c * &z));
        let terms = y.abs().tr_mul(&(c.abs() * z.abs()));
        let limit = rank::tolerance(n) * terms.norm();
        let braked = match free.is_empty() {
            true => 0,
            false => brakes
                .try_svd(false, false, f64::EPSILON, 10_000)?
                .rank(limit),
        };
        let drifts = free.len() - braked;
        let slowest = |z: &DVector<f64>| {
            if (k.abs() * z.abs()).amax() == 0.0 {
                return 0.0;
            }
            let overlaps = |d: &&rank::Direction| d.part.iter().any(|&i| z[i] != 0.0);
            let hidden = free.iter().filter(overlaps).map(|d| d.rounding);
            hidden.fold(0.0, f64::max).sqrt()
        };
        let free = sparse(rights).into_iter().map(|direction| Free {
            slowest: slowest(&direction),
            direction,
        });
        Some(Split {
            free: free.collect(),
            bound: columns(&bound),
            drifts,
        })
    }
}

/// A basis of the same space with many zeros: by Gauss and Jordan, each vector alone in one coordinate.
fn sparse(mut rows: Vec<DVector<f64>>) -> Vec<DVector<f64>> {
    let n = rows.first().map_or(0, DVector::len);
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
        let limit = rank::tolerance(n) * row.amax();
        row.iter_mut()
            .filter(|x| x.abs() <= limit)
            .for_each(|x| *x = 0.0);
    }
    rows.sort_by_key(|row| row.iter().position(|x| *x != 0.0));
    rows
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
            let modes = modes(&k, &c).expect("an end").modes;
            let mut trace = 0.0;
            for Mode { lambda, shape, .. } in &modes {
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
                    let bound = rank::tolerance(2 * n) + 1e-12;
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
        let modes = modes(&k, &DMatrix::zeros(3, 3)).expect("an end").modes;
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
        let modes = modes(&k, &DMatrix::zeros(3, 3)).expect("an end").modes;
        assert_eq!(modes.len(), 3);
        let shapes = DMatrix::from_fn(3, 3, |i, j| modes[j].shape[i]);
        assert!(shapes.determinant().norm() > 0.1, "{shapes}");
    }

    /// A double eigenvalue with one vector comes out as two that are √ε apart, and the vector twice.
    #[test]
    fn critical_damping_is_no_trouble() {
        let k = DMatrix::from_element(1, 1, -9.0);
        let c = DMatrix::from_element(1, 1, -6.0);
        let modes = modes(&k, &c).expect("an end").modes;
        for mode in &modes {
            assert!(
                (mode.lambda - Complex::new(-3.0, 0.0)).norm() <= 1e-6,
                "{}",
                mode.lambda
            );
        }
        assert_eq!(modes.len(), 2);
    }
}
