//! Numbers with infinitesimals, which differentiate the truth without any algebra on expressions.
//!
//! A jet is a polynomial in ε₀, ε₁, … with εₖ² = 0, over any arithmetic: coefficient `c[m]` belongs to the product of those εₖ
//! whose bit k is set in m. Hence the coefficient of ε₀ε₁ in f(x + ε₀ y + ε₁ z) is the second derivative of f along y and z (W.
//! K. Clifford 1873; J. A. Fike, J. J. Alonso, *The development of hyper-dual numbers*, AIAA 2011-886).

use lagrangian_scalar::Scalar;

#[derive(Clone, Debug)]
pub struct Jet<S>(Vec<S>);

impl<S: Scalar> Jet<S> {
    pub fn of(x: S) -> Jet<S> {
        Jet(vec![x])
    }

    pub fn number(x: f64) -> Jet<S> {
        Jet::of(S::from_f64(x))
    }

    /// The infinitesimal εₖ.
    pub fn infinitesimal(k: usize) -> Jet<S> {
        let mut parts = vec![S::ZERO; 2 << k];
        parts[1 << k] = S::ONE;
        Jet(parts)
    }

    /// The part that does not depend on any infinitesimal.
    pub fn value(&self) -> S {
        self.0[0]
    }

    /// The coefficient of εₖ, which must be the last infinitesimal.
    pub fn part(&self, k: usize) -> Jet<S> {
        match self.0.get(1 << k..) {
            Some(part) if !part.is_empty() => Jet(part.to_vec()),
            _ => Jet::of(S::ZERO),
        }
    }

    /// The part without εₖ, which must be the last infinitesimal.
    pub fn without(&self, k: usize) -> Jet<S> {
        Jet(self.0[..self.0.len().min(1 << k)].to_vec())
    }

    pub fn add(&self, other: &Jet<S>) -> Jet<S> {
        let (long, short) = if self.0.len() >= other.0.len() {
            (self, other)
        } else {
            (other, self)
        };
        let mut sum = long.clone();
        for (x, y) in sum.0.iter_mut().zip(&short.0) {
            *x = *x + *y;
        }
        sum
    }

    pub fn neg(&self) -> Jet<S> {
        Jet(self.0.iter().map(|x| -*x).collect())
    }

    pub fn sub(&self, other: &Jet<S>) -> Jet<S> {
        self.add(&other.neg())
    }

    pub fn mul(&self, other: &Jet<S>) -> Jet<S> {
        let mut product = vec![S::ZERO; self.0.len().max(other.0.len())];
        for (i, x) in self.0.iter().enumerate().filter(|(_, x)| **x != S::ZERO) {
            for (j, y) in other.0.iter().enumerate() {
                if i & j == 0 && *y != S::ZERO {
                    product[i | j] = product[i | j] + *x * *y;
                }
            }
        }
        Jet(product)
    }

    pub fn times(&self, factor: f64) -> Jet<S> {
        let factor = S::from_f64(factor);
        Jet(self.0.iter().map(|x| *x * factor).collect())
    }

    /// f(x) by Taylor's formula, which ends with the product of all infinitesimals: `derivative(j)` is the j-th derivative of f
    /// at the value of x.
    fn compose(&self, derivative: impl Fn(usize) -> S) -> Jet<S> {
        let order = self.0.len().trailing_zeros() as usize;
        let mut small = self.clone();
        small.0[0] = S::ZERO;
        // Horner: f + n (f' + n/2 (f'' + n/3 (…))).
        let mut sum = Jet::of(derivative(order));
        for j in (0..order).rev() {
            let over = Jet::of(S::from_ratio(1, j as i64 + 1));
            sum = sum.mul(&small).mul(&over).add(&Jet::of(derivative(j)));
        }
        sum
    }

    pub fn sin_cos(&self) -> (Jet<S>, Jet<S>) {
        let (sin, cos) = self.value().sin_cos();
        let cycle = [sin, cos, -sin, -cos];
        (
            self.compose(|j| cycle[j % 4]),
            self.compose(|j| cycle[(j + 1) % 4]),
        )
    }

    pub fn exp(&self) -> Jet<S> {
        let exp = self.value().exp();
        self.compose(|_| exp)
    }

    /// A power with a constant exponent that is a multiple of ½.
    pub fn power(&self, halves: i64) -> Jet<S> {
        let x = self.value();
        let root = match halves % 2 {
            0 => S::ONE,
            _ => x.sqrt(),
        };
        self.compose(|j| {
            // (x^p)^(j) = p (p − 1) … x^(p − j).
            let factors = (0..j as i64).map(|i| S::from_ratio(halves - 2 * i, 2));
            let factor = factors.fold(S::ONE, |product, factor| product * factor);
            if factor == S::ZERO {
                return S::ZERO;
            }
            factor * x.powi((halves.div_euclid(2) - j as i64) as i32) * root
        })
    }

    pub fn div(&self, other: &Jet<S>) -> Jet<S> {
        self.mul(&other.power(-2))
    }

    /// The angle of the point (x, y): the angle of its value, plus the small angle that remains after the point is rotated
    /// back by it.
    pub fn angle(y: &Jet<S>, x: &Jet<S>) -> Jet<S> {
        let (x0, y0) = (Jet::of(x.value()), Jet::of(y.value()));
        let along = x.mul(&x0).add(&y.mul(&y0));
        let across = y.mul(&x0).sub(&x.mul(&y0));
        // atan w = w − w³/3 + w⁵/5, because w⁶ = 0 with up to five infinitesimals.
        let w = across.div(&along);
        let square = w.mul(&w);
        let third = Jet::of(S::from_ratio(1, 3));
        let fifth = Jet::of(S::from_ratio(1, 5));
        let series = Jet::of(S::ONE).sub(&square.mul(&third.sub(&square.mul(&fifth))));
        Jet::of(y.value().atan2(x.value())).add(&w.mul(&series))
    }

    pub fn sqrt(&self) -> Jet<S> {
        self.power(1)
    }
}

/// The solution of a linear system by elimination with full pivoting, and the ratio of the smallest pivot to the largest; `None`
/// if a pivot is 0.
pub fn solve<S: Scalar>(
    mut matrix: Vec<Vec<S>>,
    mut right: Vec<Vec<S>>,
) -> Option<(Vec<Vec<S>>, f64)> {
    let n = matrix.len();
    let mut columns: Vec<usize> = (0..n).collect();
    let (mut largest, mut smallest) = (0.0f64, f64::INFINITY);
    for k in 0..n {
        let places = (k..n).flat_map(|i| (k..n).map(move |j| (i, j)));
        let size = |&(i, j): &(usize, usize)| matrix[i][j].abs().to_f64();
        let (row, column) = places.max_by(|a, b| size(a).total_cmp(&size(b)))?;
        let pivot = size(&(row, column));
        (largest, smallest) = (largest.max(pivot), smallest.min(pivot));
        if pivot == 0.0 || !pivot.is_finite() {
            return None;
        }
        matrix.swap(k, row);
        right.swap(k, row);
        columns.swap(k, column);
        matrix.iter_mut().for_each(|row| row.swap(k, column));
        for i in k + 1..n {
            let factor = matrix[i][k] / matrix[k][k];
            for j in k..n {
                matrix[i][j] = matrix[i][j] - factor * matrix[k][j];
            }
            for j in 0..right[i].len() {
                right[i][j] = right[i][j] - factor * right[k][j];
            }
        }
    }
    let mut solution = vec![Vec::new(); n];
    for k in (0..n).rev() {
        let mut row = right[k].clone();
        for (j, x) in row.iter_mut().enumerate() {
            for l in k + 1..n {
                let known: &Vec<S> = &solution[columns[l]];
                *x = *x - matrix[k][l] * known[j];
            }
            *x = *x / matrix[k][k];
        }
        solution[columns[k]] = row;
    }
    Some((solution, if n == 0 { 1.0 } else { smallest / largest }))
}
