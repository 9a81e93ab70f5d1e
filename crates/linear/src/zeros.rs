//! Invariant zeros: values of λ for which some nonzero state and input leave every output 0.
//!
//! They are the values at which the rank of
//!
//! ```text
//! ⎡ A − λ  B ⎤
//! ⎣   C    D ⎦
//! ```
//!
//! falls below its normal value. Orthogonal transformations deflate outputs and inputs until D is regular (A. Emami-Naeini and P.
//! Van Dooren, *Computation of zeros of linear multivariable systems*, Automatica 18 (1982) 415–430); the zeros are the eigenvalues
//! of `A − B D⁻¹ C` of the reduced model. If the model is controllable and observable they are its transmission zeros.

use lagrangian_eigen::poles::poles;
use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{Complex, DMatrix};

use crate::model::LinearModel;

/// A singular value counts as nonzero if it exceeds this fraction of the size of its scaled matrix, times the dimension.
const RANK: f64 = 256.0 * f64::EPSILON;

/// A, B, C and D of a system.
#[derive(Clone)]
struct System {
    a: DMatrix<f64>,
    b: DMatrix<f64>,
    c: DMatrix<f64>,
    d: DMatrix<f64>,
}

/// The zeros in 1/s, both of each conjugate pair; none without inputs or outputs. `None` where the iterations
/// do not converge.
pub fn zeros(model: &LinearModel) -> Option<Vec<Complex<f64>>> {
    if model.b.ncols() == 0 || model.c.nrows() == 0 {
        return Some(Vec::new());
    }
    let (system, rate) = System::scaled(model);
    let tolerance = RANK * (system.a.nrows() + system.b.ncols() + system.c.nrows()) as f64;
    let wide = system.with_independent_outputs(tolerance)?;
    let square = wide.dual().with_independent_outputs(tolerance)?.dual();
    let System { a, b, c, d } = square;
    let left = if d.is_empty() {
        a
    } else {
        a - b * d.lu().solve(&c)?
    };
    let n = left.nrows();
    // The transformations leave round-off of the largest entries everywhere.
    let bounds = DMatrix::from_element(n, n, 16.0 * f64::EPSILON * left.amax_or_zero());
    let zeros = poles(&left, &bounds)?;
    Some(zeros.into_iter().map(|zero| zero.lambda * rate).collect())
}

/// The largest entry of a matrix that may be empty.
trait Largest {
    fn amax_or_zero(&self) -> f64;
}

impl Largest for DMatrix<f64> {
    fn amax_or_zero(&self) -> f64 {
        self.iter().fold(0.0, |largest, x| largest.max(x.abs()))
    }
}

impl System {
    /// The system with time, states, inputs and outputs scaled such that no number is large or small because of its unit;
    /// and the value in 1/s of a scaled rate of 1.
    fn scaled(model: &LinearModel) -> (System, f64) {
        let mut a = model.a.clone();
        let n = a.nrows();
        let scales = match n {
            0 => Vec::new(),
            _ => balance_parlett_reinsch(&mut a).iter().copied().collect(),
        };
        let rate = Some(a.amax_or_zero()).filter(|x| *x > 0.0).unwrap_or(1.0);
        a /= rate;
        let mut b = DMatrix::from_fn(n, model.b.ncols(), |i, j| {
            model.b[(i, j)] / scales[i] / rate
        });
        let mut c = DMatrix::from_fn(model.c.nrows(), n, |i, j| model.c[(i, j)] * scales[j]);
        let mut d = model.d.clone();
        let power = |x: f64| {
            if x > 0.0 {
                x.log2().round().exp2()
            } else {
                1.0
            }
        };
        for j in 0..b.ncols() {
            let size = power(b.column(j).norm().max(d.column(j).norm()));
            b.column_mut(j).apply(|x| *x /= size);
            d.column_mut(j).apply(|x| *x /= size);
        }
        for i in 0..c.nrows() {
            let size = power(c.row(i).norm().max(d.row(i).norm()));
            c.row_mut(i).apply(|x| *x /= size);
            d.row_mut(i).apply(|x| *x /= size);
        }
        (System { a, b, c, d }, rate)
    }

    fn dual(&self) -> System {
        System {
            a: self.a.transpose(),
            b: self.c.transpose(),
            c: self.b.transpose(),
            d: self.d.transpose(),
        }
    }

    /// A system with the same zeros whose D has independent rows.
    fn with_independent_outputs(mut self, tolerance: f64) -> Option<System> {
        loop {
            let (n, outputs) = (self.a.nrows(), self.c.nrows());
            if outputs == 0 {
                return Some(self);
            }
            // Outputs with direct feedthrough first, then the others.
            let (left, rank) = rows(&self.d, tolerance)?;
            let (c, d) = (left.tr_mul(&self.c), left.tr_mul(&self.d));
            let first = |m: &DMatrix<f64>| m.rows(0, rank).into_owned();
            let (c1, d1) = (first(&c), first(&d));
            if rank == outputs {
                return Some(System { c, d, ..self });
            }
            // The other outputs determine the states that they show.
            let rest = c.rows(rank, outputs - rank).into_owned();
            let (right, shown) = rows(&rest.transpose(), tolerance)?;
            if shown == 0 {
                return Some(System {
                    c: c1,
                    d: d1,
                    ..self
                });
            }
            // The states that are shown come last.
            let order = |j: usize| (j + shown) % n;
            let right = DMatrix::from_fn(n, n, |i, j| right[(i, order(j))]);
            let a = right.tr_mul(&self.a) * &right;
            let b = right.tr_mul(&self.b);
            let c1 = c1 * &right;
            let (free, m) = (n - shown, b.ncols());
            let mut next = System {
                a: a.view((0, 0), (free, free)).into_owned(),
                b: b.rows(0, free).into_owned(),
                c: DMatrix::zeros(rank + shown, free),
                d: DMatrix::zeros(rank + shown, m),
            };
            next.c
                .rows_mut(0, rank)
                .copy_from(&c1.columns(0, free).into_owned());
            next.c
                .rows_mut(rank, shown)
                .copy_from(&a.view((free, 0), (shown, free)));
            next.d.rows_mut(0, rank).copy_from(&d1);
            next.d.rows_mut(rank, shown).copy_from(&b.rows(free, shown));
            self = next;
        }
    }
}

/// An orthogonal matrix whose first columns are a basis of the range of a matrix, and its rank.
fn rows(matrix: &DMatrix<f64>, tolerance: f64) -> Option<(DMatrix<f64>, usize)> {
    let (rows, columns) = matrix.shape();
    if rows == 0 {
        return Some((DMatrix::zeros(0, 0), 0));
    }
    // Padded with zero columns, so that the decomposition returns all left vectors.
    let mut square = DMatrix::zeros(rows, columns.max(rows));
    square.columns_mut(0, columns).copy_from(matrix);
    let svd = square.try_svd(true, false, f64::EPSILON, 10_000)?;
    let rank = svd.singular_values.iter().filter(|x| **x > tolerance);
    Some((svd.u?, rank.count()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(a: &[f64], b: &[f64], c: &[f64], d: &[f64]) -> Vec<Complex<f64>> {
        let n = a.len().isqrt();
        let (m, p) = (b.len() / n, c.len() / n);
        let model = LinearModel {
            q: Vec::new(),
            v: Vec::new(),
            u: Vec::new(),
            y: Vec::new(),
            states: Vec::new(),
            inputs: Vec::new(),
            outputs: Vec::new(),
            a: DMatrix::from_row_slice(n, n, a),
            b: DMatrix::from_row_slice(n, m, b),
            c: DMatrix::from_row_slice(p, n, c),
            d: DMatrix::from_row_slice(p, m, d),
            drift: Vec::new(),
            basis: DMatrix::zeros(0, 0),
            is_reduced: false,
            records: Vec::new(),
            a_bounds: DMatrix::zeros(n, n),
        };
        zeros(&model).expect("an end")
    }

    fn same(found: &[Complex<f64>], exact: &[(f64, f64)]) {
        assert_eq!(found.len(), exact.len(), "{found:?}");
        for (x, (re, im)) in found.iter().zip(exact) {
            let off = (x - Complex::new(*re, *im)).norm();
            assert!(off <= 1e-12 * re.hypot(*im).max(1.0), "{found:?}");
        }
    }

    /// Numerators of transfer functions typed by hand: companion form of s³ + 6 s² + 11 s + 6.
    #[test]
    fn zeros_of_one_output_are_those_of_the_numerator() {
        let a = [0.0, 1.0, 0.0, 0.0, 0.0, 1.0, -6.0, -11.0, -6.0];
        let b = [0.0, 0.0, 1.0];
        // s² + 2 s + 5.
        same(
            &of(&a, &b, &[5.0, 2.0, 1.0], &[0.0]),
            &[(-1.0, 2.0), (-1.0, -2.0)],
        );
        // s − 4, of higher relative degree.
        same(&of(&a, &b, &[-4.0, 1.0, 0.0], &[0.0]), &[(4.0, 0.0)]);
        // 1: no zeros.
        same(&of(&a, &b, &[1.0, 0.0, 0.0], &[0.0]), &[]);
        // 1 + 1/(s³ + 6 s² + 11 s + 6): the roots of s³ + 6 s² + 11 s + 7, which is x³ − x + 1 with x = s + 2.
        let found = of(&a, &b, &[1.0, 0.0, 0.0], &[1.0]);
        assert_eq!(found.len(), 3);
        for s in found {
            let x = s + 2.0;
            assert!((x * x * x - x + 1.0).norm() <= 1e-12, "{s}");
        }
    }

    /// Two uncoupled inputs and outputs, diag((s + 1)/(s + 2)/(s + 3), 1/(s + 4)): only the zero of the first. A system with
    /// more outputs than inputs usually has none.
    #[test]
    fn zeros_of_several_outputs_are_where_the_rank_falls() {
        let a = [0.0, 1.0, 0.0, -6.0, -5.0, 0.0, 0.0, 0.0, -4.0];
        let b = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0];
        let c = [1.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        same(&of(&a, &b, &c, &[0.0; 4]), &[(-1.0, 0.0)]);
        let a = [0.0, 1.0, -6.0, -5.0];
        same(&of(&a, &[0.0, 1.0], &[1.0, 1.0, 1.0, 0.0], &[0.0; 2]), &[]);
    }
}
