//! LU factorization of real and complex matrices, `P A = L U`.

use core::ops::{Div, Mul, Sub};
use std::vec::Vec;

/// An element of a field.
pub(crate) trait Coefficient:
    Copy + Default + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// The size by which pivots are compared: `|re| + |im|`.
    fn size(self) -> f64;
}

impl Coefficient for f64 {
    fn size(self) -> f64 {
        self.abs()
    }
}

/// A complex number.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Complex {
    pub re: f64,
    pub im: f64,
}

impl Sub for Complex {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self {
            re: self.re - other.re,
            im: self.im - other.im,
        }
    }
}

impl Mul for Complex {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

impl Div for Complex {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let square = other.re * other.re + other.im * other.im;
        Self {
            re: (self.re * other.re + self.im * other.im) / square,
            im: (self.im * other.re - self.re * other.im) / square,
        }
    }
}

impl Coefficient for Complex {
    fn size(self) -> f64 {
        self.re.abs() + self.im.abs()
    }
}

/// The number of multiplications that [`Lu::factor`] takes for `n` unknowns.
pub(crate) fn factorization(n: usize) -> f64 {
    let n = n as f64;
    n * n * n / 3.0
}

/// The number of multiplications that [`Lu::solve`] takes for `n` unknowns.
pub(crate) fn solution(n: usize) -> f64 {
    let n = n as f64;
    n * n
}

/// A matrix and its factorization, in memory that is reused.
#[derive(Clone, Debug)]
pub(crate) struct Lu<T> {
    n: usize,
    /// `L` without its diagonal of ones, and `U`, row after row.
    entries: Vec<T>,
    /// The row that each row was exchanged with.
    pivots: Vec<usize>,
}

impl<T: Coefficient> Lu<T> {
    /// Memory for `n` unknowns.
    pub fn new(n: usize) -> Self {
        Self {
            n,
            entries: std::vec![T::default(); n * n],
            pivots: std::vec![0; n],
        }
    }

    /// Factorizes the matrix of these entries by elimination with partial pivoting; returns whether it is invertible.
    pub fn factor(&mut self, entry: impl Fn(usize, usize) -> T) -> bool {
        let n = self.n;
        for i in 0..n {
            for j in 0..n {
                self.entries[i * n + j] = entry(i, j);
            }
        }
        self.factor_entries()
    }

    /// [`factor`](Self::factor) for a matrix whose rows this writes, each given its index and its entries.
    pub fn factor_rows(&mut self, mut write: impl FnMut(usize, &mut [T])) -> bool {
        let rows = self.entries.chunks_exact_mut(self.n.max(1));
        rows.enumerate().for_each(|(i, row)| write(i, row));
        self.factor_entries()
    }

    fn factor_entries(&mut self) -> bool {
        let n = self.n;
        for k in 0..n {
            let mut pivot = k;
            for i in k + 1..n {
                if self.entries[i * n + k].size() > self.entries[pivot * n + k].size() {
                    pivot = i;
                }
            }
            self.pivots[k] = pivot;
            let size = self.entries[pivot * n + k].size();
            // NaN is no pivot either.
            if !(size > 0.0 && size.is_finite()) {
                return false;
            }
            if pivot != k {
                for j in 0..n {
                    self.entries.swap(k * n + j, pivot * n + j);
                }
            }
            let (above, below) = self.entries.split_at_mut((k + 1) * n);
            let above = &above[k * n..];
            for row in below.chunks_exact_mut(n) {
                let factor = row[k] / above[k];
                row[k] = factor;
                for (x, of_pivot) in row[k + 1..].iter_mut().zip(&above[k + 1..]) {
                    *x = *x - factor * *of_pivot;
                }
            }
        }
        true
    }

    /// Solves for a right-hand side in place.
    pub fn solve(&self, x: &mut [T]) {
        let n = self.n;
        // All exchanges come first: the later ones also moved the earlier rows of `L`.
        for (k, pivot) in self.pivots.iter().enumerate() {
            x.swap(k, *pivot);
        }
        for k in 1..n {
            let (known, rest) = x.split_at_mut(k);
            rest[0] = take(rest[0], &self.entries[k * n..][..k], known);
        }
        for k in (0..n).rev() {
            let (rest, known) = x.split_at_mut(k + 1);
            let row = &self.entries[k * n..][..n];
            rest[k] = take(rest[k], &row[k + 1..], known) / row[k];
        }
    }
}

/// `x − Σ rowⱼ knownⱼ`.
fn take<T: Coefficient>(x: T, row: &[T], known: &[T]) -> T {
    let pairs = row.iter().zip(known);
    pairs.fold(x, |x, (entry, known)| x - *entry * *known)
}

#[cfg(test)]
mod tests {
    use super::{Complex, Lu};

    /// Exchanges are needed in every column, and later ones move rows of `L`.
    #[test]
    fn systems_whose_rows_have_to_be_exchanged_are_solved() {
        let a = [[0.0, 2.0, 1.0], [1.0, 1.0, 3.0], [4.0, -1.0, 0.5]];
        let exact = [1.0, -2.0, 3.0];
        let mut lu = Lu::new(3);
        assert!(lu.factor(|i, j| a[i][j]));
        let mut x = a.map(|row| row.iter().zip(exact).map(|(a, x)| a * x).sum::<f64>());
        lu.solve(&mut x);
        for (x, exact) in x.iter().zip(exact) {
            assert!((x - exact).abs() < 1e-14, "{x}");
        }

        // Solved with every number multiplied by i: (i A)(i x) = −A x.
        let turned = |re: f64| Complex { re: 0.0, im: re };
        let mut lu = Lu::new(3);
        assert!(lu.factor(|i, j| turned(a[i][j])));
        let mut x = a.map(|row| Complex {
            re: -row.iter().zip(exact).map(|(a, x)| a * x).sum::<f64>(),
            im: 0.0,
        });
        lu.solve(&mut x);
        for (x, exact) in x.iter().zip(exact) {
            assert!(x.re.abs() < 1e-14 && (x.im - exact).abs() < 1e-14);
        }
    }

    #[test]
    fn what_cannot_be_inverted_is_told() {
        let mut lu = Lu::new(2);
        assert!(!lu.factor(|i, j| [[1.0, 2.0], [2.0, 4.0]][i][j]));
        assert!(!lu.factor(|_, _| f64::NAN));
    }
}
