//! Eigenvalues and eigenvectors of a real matrix in twice the digits of an `f64`.
//!
//! In a heavily damped machine the slowest motion is slower than the fastest by c²/k, and in `f64` an eigenvalue has an error
//! of some units in the last place of the largest one. With 32 digits c²/k may be 1e20 and every eigenvalue is still as
//! accurate as the matrix. [`Pair::error`] bounds how far the matrix itself determines an eigenvalue.

use core::ops::{Add, Mul, Sub};

use lagrangian_scalar::{DoubleDouble, Scalar};
use nalgebra::{Complex, DMatrix, DVector};

/// A complex number of 32 digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    re: DoubleDouble,
    im: DoubleDouble,
}

/// The most steps for one eigenvalue; it takes two or three.
const MOST_STEPS: usize = 60;

/// 2⁻¹⁰⁴: entries below this fraction of their neighbours are negligible.
const NOTHING: f64 = 1.0 / (1_u128 << 104) as f64;

const ZERO: Number = Number {
    re: DoubleDouble::ZERO,
    im: DoubleDouble::ZERO,
};

impl Number {
    fn new(re: f64, im: f64) -> Number {
        Number {
            re: re.into(),
            im: im.into(),
        }
    }

    /// The nearest complex number of `f64`.
    pub fn nearest(self) -> Complex<f64> {
        Complex::new(self.re.hi(), self.im.hi())
    }

    fn conj(self) -> Number {
        Number {
            im: -self.im,
            ..self
        }
    }

    /// The modulus, accurate to 16 digits.
    fn size(self) -> f64 {
        self.re.hi().hypot(self.im.hi())
    }

    fn scaled(self, factor: DoubleDouble) -> Number {
        Number {
            re: self.re * factor,
            im: self.im * factor,
        }
    }

    /// 1/z, computed relative to a power of 2 near |z|, so that nothing overflows.
    fn reciprocal(self) -> Number {
        let unit = Some(self.size())
            .filter(|x| *x > 0.0 && x.is_finite())
            .map_or(1.0, |x| x.log2().floor().exp2());
        let shrink = DoubleDouble::from(1.0 / unit);
        let z = self.scaled(shrink);
        let square = z.re * z.re + z.im * z.im;
        z.conj().scaled(shrink / square)
    }

    fn sqrt(self) -> Number {
        let two = DoubleDouble::from(2.0);
        let modulus = (self.re * self.re + self.im * self.im).sqrt();
        if modulus.hi() == 0.0 {
            return ZERO;
        }
        // Without cancellation: the larger of the two parts comes from a root, the other from a quotient.
        let large = ((modulus + self.re.abs()) / two).sqrt();
        let small = self.im.abs() / (two * large);
        let is_right = self.re >= DoubleDouble::ZERO;
        let (re, im) = if is_right {
            (large, small)
        } else {
            (small, large)
        };
        let is_below = self.im < DoubleDouble::ZERO;
        Number {
            re,
            im: if is_below { -im } else { im },
        }
    }
}

impl Add for Number {
    type Output = Number;
    fn add(self, other: Number) -> Number {
        Number {
            re: self.re + other.re,
            im: self.im + other.im,
        }
    }
}

impl Sub for Number {
    type Output = Number;
    fn sub(self, other: Number) -> Number {
        Number {
            re: self.re - other.re,
            im: self.im - other.im,
        }
    }
}

impl Mul for Number {
    type Output = Number;
    fn mul(self, other: Number) -> Number {
        Number {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

/// A square matrix, row after row.
#[derive(Clone)]
struct Matrix {
    rows: Vec<Vec<Number>>,
}

impl Matrix {
    fn of(a: &DMatrix<f64>) -> Matrix {
        let row = |i: usize| a.row(i).iter().map(|x| Number::new(*x, 0.0)).collect();
        Matrix {
            rows: (0..a.nrows()).map(row).collect(),
        }
    }

    /// Makes a similar matrix with nothing below the first subdiagonal, by elimination with pivoting
    /// (J. H. Wilkinson, *The Algebraic Eigenvalue Problem*, 1965, section 6.8).
    fn reduce_to_hessenberg(&mut self) {
        let n = self.rows.len();
        for k in 1..n.saturating_sub(1) {
            let size = |i: &usize| self.rows[*i][k - 1].size();
            let pivot = (k..n).max_by(|i, j| size(i).total_cmp(&size(j)));
            let Some(pivot) = pivot.filter(|i| size(i) > 0.0) else {
                continue;
            };
            self.rows.swap(k, pivot);
            for row in &mut self.rows {
                row.swap(k, pivot);
            }
            let reciprocal = self.rows[k][k - 1].reciprocal();
            for i in k + 1..n {
                let factor = self.rows[i][k - 1] * reciprocal;
                if factor == ZERO {
                    continue;
                }
                for j in k - 1..n {
                    self.rows[i][j] = self.rows[i][j] - factor * self.rows[k][j];
                }
                self.rows[i][k - 1] = ZERO;
                for row in &mut self.rows {
                    row[k] = row[k] + factor * row[i];
                }
            }
        }
    }

    /// The eigenvalue of the 2 × 2 block ending at `end` that is nearer to its last entry.
    fn shift(&self, end: usize) -> Number {
        let (a, b) = (self.rows[end - 1][end - 1], self.rows[end - 1][end]);
        let (c, d) = (self.rows[end][end - 1], self.rows[end][end]);
        let half = DoubleDouble::from(0.5);
        let mean = (a - d).scaled(half);
        let root = (mean * mean + b * c).sqrt();
        // d − bc/(mean ± root) with the sign that makes the divisor large.
        let [plus, minus] = [mean + root, mean - root];
        let divisor = if plus.size() >= minus.size() {
            plus
        } else {
            minus
        };
        if divisor.size() == 0.0 {
            return d;
        }
        d - b * c * divisor.reciprocal()
    }

    /// One step of the QR iteration on rows and columns `start..=end`.
    fn step(&mut self, start: usize, end: usize, shift: Number) {
        let mut rotations = Vec::with_capacity(end - start);
        for i in start..=end {
            self.rows[i][i] = self.rows[i][i] - shift;
        }
        for k in start..end {
            let (x, y) = (self.rows[k][k], self.rows[k + 1][k]);
            let unit = x.size().max(y.size());
            let (c, s) = if unit > 0.0 {
                let shrink = DoubleDouble::from(unit.log2().floor().exp2().recip());
                let [x, y] = [x, y].map(|z| z.scaled(shrink));
                let square = x.re * x.re + x.im * x.im + y.re * y.re + y.im * y.im;
                let factor = DoubleDouble::ONE / square.sqrt();
                (x.scaled(factor), y.scaled(factor))
            } else {
                (Number::new(1.0, 0.0), ZERO)
            };
            // [c* s*; −s c] maps (x, y) to (√(|x|² + |y|²), 0).
            for j in k..=end {
                let (x, y) = (self.rows[k][j], self.rows[k + 1][j]);
                self.rows[k][j] = c.conj() * x + s.conj() * y;
                self.rows[k + 1][j] = c * y - s * x;
            }
            rotations.push((c, s));
        }
        for (k, (c, s)) in (start..end).zip(rotations) {
            for row in &mut self.rows[start..=(k + 1).min(end)] {
                let (x, y) = (row[k], row[k + 1]);
                row[k] = x * c + y * s;
                row[k + 1] = y * c.conj() - x * s.conj();
            }
        }
        for i in start..=end {
            self.rows[i][i] = self.rows[i][i] + shift;
        }
    }

    /// All eigenvalues, by the QR iteration (G. H. Golub and C. F. Van Loan, *Matrix Computations*, 4th ed. 2013,
    /// section 7.5); `None` if it does not end.
    fn eigenvalues(mut self) -> Option<Vec<Number>> {
        self.reduce_to_hessenberg();
        let n = self.rows.len();
        let mut eigenvalues = vec![ZERO; n];
        let mut left = n;
        let mut steps = 0;
        while left > 0 {
            let end = left - 1;
            let mut start = end;
            while start > 0 {
                let around =
                    self.rows[start - 1][start - 1].size() + self.rows[start][start].size();
                let below = self.rows[start][start - 1].size();
                if below == 0.0 || below <= NOTHING * around {
                    self.rows[start][start - 1] = ZERO;
                    break;
                }
                start -= 1;
            }
            if start == end {
                eigenvalues[end] = self.rows[end][end];
                (left, steps) = (end, 0);
                continue;
            }
            steps += 1;
            if steps > MOST_STEPS || !self.rows[end][end].size().is_finite() {
                return None;
            }
            let shift = match steps % 10 {
                // An occasional exceptional shift breaks cycles.
                0 => self.rows[end][end] + Number::new(self.rows[end][end - 1].size(), 0.0),
                _ => self.shift(end),
            };
            self.step(start, end, shift);
        }
        Some(eigenvalues)
    }

    fn transposed(&self) -> Matrix {
        let n = self.rows.len();
        let row = |i: usize| (0..n).map(|j| self.rows[j][i]).collect();
        Matrix {
            rows: (0..n).map(row).collect(),
        }
    }

    fn shifted(&self, lambda: Number) -> Matrix {
        let mut shifted = self.clone();
        for (i, row) in shifted.rows.iter_mut().enumerate() {
            row[i] = row[i] - lambda;
        }
        shifted
    }

    /// The eigenvector of a nearly singular shifted matrix for the eigenvalue near 0.
    fn inverse_iteration(&self, start: Vec<Number>, tiny: f64) -> Option<Vec<Number>> {
        (0..3).try_fold(start, |x, _| normalized(&self.solve(&x, tiny)))
    }

    /// Rayleigh's quotient `yᴴ A x / yᴴ x`.
    fn quotient(&self, y: &[Number], x: &[Number]) -> Number {
        let product = |row: &[Number]| row.iter().zip(x).fold(ZERO, |sum, (a, x)| sum + *a * *x);
        let (mut above, mut below) = (ZERO, ZERO);
        for ((row, x), y) in self.rows.iter().zip(x).zip(y) {
            above = above + y.conj() * product(row);
            below = below + y.conj() * *x;
        }
        above * below.reciprocal()
    }

    /// Solves `self x = b` by elimination with pivoting; a zero pivot is replaced by `tiny`.
    fn solve(&self, b: &[Number], tiny: f64) -> Vec<Number> {
        let n = self.rows.len();
        let mut rows = self.rows.clone();
        let mut x = b.to_vec();
        for k in 0..n {
            let pivot = (k..n).max_by(|&i, &j| rows[i][k].size().total_cmp(&rows[j][k].size()));
            let pivot = pivot.unwrap_or(k);
            rows.swap(k, pivot);
            x.swap(k, pivot);
            if rows[k][k].size() < tiny {
                rows[k][k] = Number::new(tiny, 0.0);
            }
            let reciprocal = rows[k][k].reciprocal();
            let (above, below) = rows.split_at_mut(k + 1);
            for (i, row) in below.iter_mut().enumerate() {
                let factor = row[k] * reciprocal;
                if factor != ZERO {
                    for j in k..n {
                        row[j] = row[j] - factor * above[k][j];
                    }
                    x[k + 1 + i] = x[k + 1 + i] - factor * x[k];
                }
            }
        }
        for k in (0..n).rev() {
            let known = (k + 1..n).fold(x[k], |sum, j| sum - rows[k][j] * x[j]);
            x[k] = known * rows[k][k].reciprocal();
        }
        x
    }
}

/// The vector scaled to a largest entry of 1.
fn normalized(x: &[Number]) -> Option<Vec<Number>> {
    let largest = x.iter().map(|x| x.size()).fold(0.0, f64::max);
    let unit = x.iter().find(|x| x.size() == largest)?;
    let factor = unit.reciprocal();
    let x: Vec<Number> = x.iter().map(|x| *x * factor).collect();
    x.iter().all(|x| x.size().is_finite()).then_some(x)
}

/// `M⁻¹ B`, with each entry as accurate as the entries of M and B. `None` where M is singular.
pub fn solve(m: &DMatrix<f64>, b: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let matrix = Matrix::of(m);
    let mut solved = b.clone();
    for (j, column) in b.column_iter().enumerate() {
        let column: Vec<Number> = column.iter().map(|x| Number::new(*x, 0.0)).collect();
        for (i, x) in matrix.solve(&column, 0.0).into_iter().enumerate() {
            solved[(i, j)] = x.re.hi();
        }
    }
    solved.iter().all(|x| x.is_finite()).then_some(solved)
}

/// An eigenvalue of a real matrix and its eigenvector.
pub struct Pair {
    /// The eigenvalue; of a conjugate pair the one with positive imaginary part.
    pub lambda: Complex<f64>,
    /// The eigenvector, `A right = λ right`, scaled to a largest entry of 1.
    pub right: DVector<Complex<f64>>,
    /// How far λ moves if each entry of A changes by one unit in its last place, or by its known uncertainty; larger where the
    /// iteration has found λ less accurately.
    pub error: f64,
}

/// All eigenvalues of a matrix whose entries are known up to `bounds`, one of each conjugate pair; a multiple eigenvalue is
/// listed as often as it occurs. `None` where the iterations do not converge.
pub fn pairs(a: &DMatrix<f64>, bounds: &DMatrix<f64>) -> Option<Vec<Pair>> {
    let n = a.nrows();
    let matrix = Matrix::of(a);
    // A perturbation of the size that the iterations may have made.
    let norm = Some(a.norm()).filter(|x| *x > 0.0).unwrap_or(1.0);
    let tiny = NOTHING * norm;
    let eigenvalues = matrix.clone().eigenvalues()?;
    let mut pairs: Vec<Pair> = Vec::new();
    for (index, lambda) in without_conjugates(&eigenvalues) {
        // A repeated eigenvalue should get another eigenvector, if there is one.
        let size = lambda.nearest().norm();
        let is_same = |other: &&Pair| (other.lambda - lambda.nearest()).norm() <= 1e-8 * size;
        let before: Vec<&Pair> = pairs.iter().filter(is_same).collect();
        let shifted = matrix.shifted(lambda);
        let mut right = Vec::new();
        for attempt in 0..=before.len() {
            // A generic start vector.
            let start = (0..n).map(|i| {
                let seed = (i + 1) * (7 * attempt + 3) * 29 + 11 * attempt;
                Number::new(0.5 + (seed % 97) as f64 / 97.0, (seed % 89) as f64 / 89.0)
            });
            right = shifted.inverse_iteration(start.collect(), tiny)?;
            let x = nearest(&right);
            let is_new = before.iter().all(|other| {
                let share = other.right.dotc(&x).norm() / (other.right.norm() * x.norm());
                share < 1.0 - 1e-6
            });
            if is_new {
                break;
            }
        }
        // Of several left eigenvectors this takes the one closest to the right one.
        let transposed = matrix.transposed().shifted(lambda.conj());
        let left = transposed.inverse_iteration(right.clone(), tiny)?;
        let (x, y) = (nearest(&right), nearest(&left));
        let lengths = x.norm() * y.norm();
        let product = y.dotc(&x).norm();
        let moved: f64 = (0..n)
            .flat_map(|i| (0..n).map(move |j| (i, j)))
            .map(|(i, j)| {
                let off = (f64::EPSILON * a[(i, j)].abs()).max(bounds[(i, j)]);
                y[i].norm() * off * x[j].norm()
            })
            .sum();
        // A defective eigenvalue moves with the square root of a perturbation of the matrix.
        let condition = lengths / product.max(f64::EPSILON.sqrt() * lengths);
        let mut error = moved / lengths * condition;
        // The errors of the two vectors enter the quotient as their product.
        error = error.max((64.0 * n as f64 * NOTHING).powi(2) * norm * condition);
        // Rayleigh's quotient resolves eigenvalues far below the largest one, unless several of them are that small.
        let blurred = 64.0 * n as f64 * tiny * lengths / product;
        let neighbours = eigenvalues.iter().enumerate();
        let mut distances = neighbours
            .filter(|(other, _)| *other != index)
            .map(|(_, other)| (*other - lambda).size());
        let is_defective = product <= f64::EPSILON.sqrt() * lengths;
        let is_real = lambda.im.hi() == 0.0;
        let lambda = if is_defective || distances.any(|distance| distance <= blurred) {
            error = error.max(blurred.min(tiny.sqrt() * norm.sqrt()));
            lambda
        } else {
            matrix.quotient(&left, &right)
        };
        let mut lambda = lambda.nearest();
        if is_real {
            lambda.im = 0.0;
        }
        pairs.push(Pair {
            lambda,
            right: x,
            error,
        });
    }
    Some(pairs)
}

/// The real eigenvalues and, of each conjugate pair, the one above the real axis, with their indices in the list.
///
/// Complex arithmetic does not know that the matrix is real. A real eigenvalue gets a small imaginary part, and no
/// eigenvalue on the other side is nearer to its conjugate than it is itself.
fn without_conjugates(eigenvalues: &[Number]) -> Vec<(usize, Number)> {
    let mut is_taken = vec![false; eigenvalues.len()];
    let mut kept = Vec::new();
    for (i, &lambda) in eigenvalues.iter().enumerate() {
        if is_taken[i] {
            continue;
        }
        is_taken[i] = true;
        let distance = |j: &usize| (eigenvalues[*j] - lambda.conj()).size();
        let others = (i + 1..eigenvalues.len()).filter(|j| !is_taken[*j]);
        let partner = others.min_by(|j, k| distance(j).total_cmp(&distance(k)));
        let (re, im) = (lambda.re, lambda.im.abs());
        match partner.filter(|j| distance(j) < im.hi()) {
            Some(j) => {
                is_taken[j] = true;
                kept.push((i, Number { re, im }));
            }
            None => {
                let im = DoubleDouble::ZERO;
                kept.push((i, Number { re, im }));
            }
        }
    }
    kept
}

fn nearest(x: &[Number]) -> DVector<Complex<f64>> {
    DVector::from_iterator(x.len(), x.iter().map(|x| x.nearest()))
}
