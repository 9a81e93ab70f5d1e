//! LU factorization of real and complex matrices, `P A = L U`.
//!
//! Matrices are stored column after column, real and imaginary parts apart: elimination and substitution then subtract multiples of columns,
//! whose entries are independent of each other, so that the processor computes several at once. A sum over a row would wait for each term.

use std::vec::Vec;

/// A number: its real part, and its imaginary part if it is complex, `P = 2`.
pub(crate) type Parts<const P: usize> = [f64; P];

/// The size by which pivots are compared: `|re| + |im|`.
fn size<const P: usize>(number: Parts<P>) -> f64 {
    number.iter().map(|part| part.abs()).sum()
}

/// The product of two numbers.
fn times<const P: usize>(x: Parts<P>, y: Parts<P>) -> Parts<P> {
    let mut product = x;
    match (&mut product[..], &x[..], &y[..]) {
        ([re, im], [x_re, x_im], [y_re, y_im]) => {
            (*re, *im) = (x_re * y_re - x_im * y_im, x_re * y_im + x_im * y_re);
        }
        (product, _, y) => product[0] *= y[0],
    }
    product
}

/// The inverse of a number.
fn inverse<const P: usize>(x: Parts<P>) -> Parts<P> {
    let mut inverse = x;
    match &mut inverse[..] {
        [re, im] => {
            let square = *re * *re + *im * *im;
            (*re, *im) = (*re / square, -*im / square);
        }
        parts => parts[0] = 1.0 / parts[0],
    }
    inverse
}

/// `x − factor · y` for each number.
#[inline(always)]
fn subtract<const P: usize>(x: [&mut [f64]; P], factor: Parts<P>, y: [&[f64]; P]) {
    let mut x = x;
    match (&mut x[..], &factor[..], &y[..]) {
        ([re, im], [of_re, of_im], [y_re, y_im]) => {
            let n = re.len();
            let (im, y_re, y_im) = (&mut im[..n], &y_re[..n], &y_im[..n]);
            for i in 0..n {
                re[i] -= of_re * y_re[i] - of_im * y_im[i];
                im[i] -= of_re * y_im[i] + of_im * y_re[i];
            }
        }
        (x, factor, y) => add_multiple(x[0], -factor[0], y[0]),
    }
}

/// `x + factor · y` for real numbers.
#[inline(always)]
pub(crate) fn add_multiple(x: &mut [f64], factor: f64, y: &[f64]) {
    for (x, y) in x.iter_mut().zip(y) {
        *x += factor * y;
    }
}

/// What a loop over a column takes besides its multiplications, as a number of multiplications. Measured solutions for 4 to 64 unknowns take
/// 0.2 ns · (n² + 2 · 25 n) to within a sixth, with 4 n² if they are complex, and factorizations for 9 to 64 unknowns take
/// 0.2 ns · (n³/3 + 25 n²) to within a fourth.
const LOOP: f64 = 25.0;

/// The time of so many sums of multiples of columns of `n` numbers, as a number of multiplications. Their loops are simpler: 15 multiplications each, by
/// the times of `radau5` and `radau9` for two coordinates.
pub(crate) fn sums(count: usize, n: usize) -> f64 {
    count as f64 * (n as f64 + 15.0)
}

/// A matrix of real (`P = 1`) or complex (`P = 2`) numbers and its factorization, in memory that is reused.
#[derive(Clone, Debug)]
pub(crate) struct Lu<const P: usize> {
    n: usize,
    /// `L` without its diagonal of ones, and `U`, column after column.
    parts: [Vec<f64>; P],
    /// The inverses of the diagonal of `U`.
    inverses: Vec<Parts<P>>,
    /// The row that each row was exchanged with.
    pivots: Vec<usize>,
}

impl<const P: usize> Default for Lu<P> {
    fn default() -> Self {
        Self::new(0)
    }
}

impl<const P: usize> Lu<P> {
    /// Memory for `n` unknowns.
    pub fn new(n: usize) -> Self {
        Self {
            n,
            parts: core::array::from_fn(|_| std::vec![0.0; n * n]),
            inverses: std::vec![[0.0; P]; n],
            pivots: std::vec![0; n],
        }
    }

    /// Makes room for another number of unknowns.
    pub fn resize(&mut self, n: usize) {
        self.n = n;
        for part in &mut self.parts {
            part.resize(n * n, 0.0);
        }
        self.inverses.resize(n, [0.0; P]);
        self.pivots.resize(n, 0);
    }

    /// Factorizes the matrix whose columns this writes, each given its index and its parts, by elimination with partial pivoting; returns
    /// whether it is invertible.
    pub fn factor(&mut self, mut write: impl FnMut(usize, [&mut [f64]; P])) -> bool {
        let n = self.n;
        for j in 0..n {
            let columns = self.parts.each_mut();
            write(j, columns.map(|part| &mut part[j * n..][..n]));
        }
        self.eliminate()
    }

    fn eliminate(&mut self) -> bool {
        let n = self.n;
        for k in 0..n {
            let at = |i: usize| self.parts.each_ref().map(|part| part[k * n + i]);
            let (mut pivot, mut greatest) = (k, 0.0);
            for i in k..n {
                let size = size(at(i));
                // NaN below the pivot would spread only to solutions.
                if !size.is_finite() {
                    return false;
                }
                if size > greatest {
                    (pivot, greatest) = (i, size);
                }
            }
            let inverse = inverse(at(pivot));
            // Not even of a pivot whose inverse, or whose square, is beyond the range of numbers.
            let of_inverse = size(inverse);
            if !(of_inverse > 0.0 && of_inverse.is_finite()) {
                return false;
            }
            self.pivots[k] = pivot;
            self.inverses[k] = inverse;
            if pivot != k {
                for part in &mut self.parts {
                    for column in part.chunks_exact_mut(n) {
                        column.swap(k, pivot);
                    }
                }
            }
            for i in k + 1..n {
                let at = k * n + i;
                let factor = times(self.parts.each_ref().map(|part| part[at]), inverse);
                for (part, factor) in self.parts.iter_mut().zip(factor) {
                    part[at] = factor;
                }
            }
            for j in k + 1..n {
                let split = self.parts.each_mut().map(|part| {
                    let (known, rest) = part.split_at_mut(j * n);
                    (&known[k * n..][..n], &mut rest[..n])
                });
                let of_pivot = split.each_ref().map(|(known, _)| &known[k + 1..]);
                let mut of_row = [0.0; P];
                let columns = split.map(|(_, column)| column);
                for (of_row, column) in of_row.iter_mut().zip(&columns) {
                    *of_row = column[k];
                }
                // Machines whose parts act on few others have many zeros.
                if of_row != [0.0; P] {
                    subtract(columns.map(|column| &mut column[k + 1..]), of_row, of_pivot);
                }
            }
        }
        true
    }

    /// The time that [`factor`](Self::factor) takes, as a number of multiplications of real numbers.
    pub fn factorization(&self) -> f64 {
        let n = self.n as f64;
        n * n * ((P * P) as f64 * n / 3.0 + LOOP)
    }

    /// The time that [`solve`](Self::solve) takes, as a number of multiplications of real numbers.
    pub fn solution(&self) -> f64 {
        let n = self.n as f64;
        n * ((P * P) as f64 * n + 2.0 * LOOP)
    }

    /// Solves for a right-hand side in place.
    pub fn solve(&self, x: [&mut [f64]; P]) {
        let (n, mut x) = (self.n, x);
        // All exchanges come first: the later ones also moved the earlier rows of `L`.
        for part in &mut x {
            for (k, pivot) in self.pivots.iter().enumerate() {
                part.swap(k, *pivot);
            }
        }
        let column = |k: usize| self.parts.each_ref().map(|part| &part[k * n..][..n]);
        for k in 0..n {
            let known = x.each_ref().map(|part| part[k]);
            let rest = x.each_mut().map(|part| &mut part[k + 1..]);
            subtract(rest, known, column(k).map(|part| &part[k + 1..]));
        }
        for k in (0..n).rev() {
            let known = times(x.each_ref().map(|part| part[k]), self.inverses[k]);
            for (part, known) in x.iter_mut().zip(known) {
                part[k] = known;
            }
            let rest = x.each_mut().map(|part| &mut part[..k]);
            subtract(rest, known, column(k).map(|part| &part[..k]));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Lu;

    /// Exchanges are needed in every column, and later ones move rows of `L`.
    #[test]
    fn systems_whose_rows_have_to_be_exchanged_are_solved() {
        let a = [[0.0, 2.0, 1.0], [1.0, 1.0, 3.0], [4.0, -1.0, 0.5]];
        let exact = [1.0, -2.0, 3.0];
        let mut lu = Lu::new(3);
        assert!(lu.factor(|j, [column]| (0..3).for_each(|i| column[i] = a[i][j])));
        let mut x = a.map(|row| row.iter().zip(exact).map(|(a, x)| a * x).sum::<f64>());
        lu.solve([&mut x]);
        for (x, exact) in x.iter().zip(exact) {
            assert!((x - exact).abs() < 1e-14, "{x}");
        }

        // Solved with every number multiplied by 3 + 4 i, of which the right-hand side has a factor less: x = exact (3 + 4 i).
        let mut lu = Lu::new(3);
        assert!(lu.factor(|j, [re, im]| {
            for i in 0..3 {
                (re[i], im[i]) = (3.0 * a[i][j], 4.0 * a[i][j]);
            }
        }));
        // (3 + 4 i)² = −7 + 24 i
        let sums = a.map(|row| row.iter().zip(exact).map(|(a, x)| a * x).sum::<f64>());
        let [mut re, mut im] = [sums.map(|b| -7.0 * b), sums.map(|b| 24.0 * b)];
        lu.solve([&mut re, &mut im]);
        for (i, exact) in exact.iter().enumerate() {
            assert!((re[i] - 3.0 * exact).abs() < 1e-13 && (im[i] - 4.0 * exact).abs() < 1e-13);
        }
    }

    #[test]
    fn what_cannot_be_inverted_is_told() {
        let a = [[1.0, 2.0], [2.0, 4.0]];
        let mut lu = Lu::new(2);
        assert!(!lu.factor(|j, [column]| (0..2).for_each(|i| column[i] = a[i][j])));
        assert!(!lu.factor(|_, [column]| column.fill(f64::NAN)));
        // NaN beside a pivot that it does not become.
        let a = [[1.0, 0.0], [f64::NAN, 1.0]];
        assert!(!lu.factor(|j, [column]| (0..2).for_each(|i| column[i] = a[i][j])));
        // Their inverses are not numbers, or 0.
        let mut lu = Lu::new(1);
        assert!(!lu.factor(|_, [column]| column[0] = 1e-310));
        let mut lu = Lu::new(1);
        for huge in [1e-200, 1e200] {
            assert!(!lu.factor(|_, [re, im]| (re[0], im[0]) = (huge, huge)));
        }
    }
}
