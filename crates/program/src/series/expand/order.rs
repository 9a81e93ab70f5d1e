//! The recurrences of a series at one order, in numbers.

use std::marker::PhantomData;

use lagrangian_scalar::Scalar;
use lagrangian_symbolic::{Function as Call, Rational};

use super::super::{Arithmetic, RowId, TermOrder};
use super::Expander;
use crate::interpret::{binary, unary};

/// The recurrences at one order, in numbers `N`.
pub(super) struct OrderArithmetic<'e, T, N> {
    pub(super) expander: &'e mut Expander<T>,
    /// 0 for rows of positions.
    pub(super) level: usize,
    pub(super) m: usize,
    pub(super) t: N,
    pub(super) numbers: PhantomData<N>,
}

impl<T: Copy, N: Scalar<Stored = T>> OrderArithmetic<'_, T, N> {
    #[inline(always)]
    fn read(&self, row: RowId, m: usize) -> N {
        N::load(self.expander.coefficients[row.index() * self.expander.width + m])
    }

    /// How many orders the level of the computed row is ahead of the accelerations.
    #[inline(always)]
    fn lead(&self) -> usize {
        match self.level {
            0 => 2,
            1 => usize::from(self.expander.series.rates_are_ahead),
            _ => 0,
        }
    }
}

impl<T: Copy, N: Scalar<Stored = T>> Arithmetic for OrderArithmetic<'_, T, N> {
    type X = N;

    #[inline(always)]
    fn zero(&mut self) -> N {
        N::ZERO
    }
    #[inline(always)]
    fn one(&mut self) -> N {
        N::ONE
    }
    #[inline(always)]
    fn rational(&mut self, value: &Rational) -> N {
        value.evaluate()
    }
    #[inline(always)]
    fn pi(&mut self) -> N {
        N::pi()
    }
    #[inline(always)]
    fn parameter(&mut self, index: u32) -> N {
        N::load(self.expander.parameters[index as usize])
    }
    #[inline(always)]
    fn input(&mut self, index: u32) -> N {
        N::load(self.expander.inputs[index as usize])
    }
    #[inline(always)]
    fn time(&mut self) -> N {
        self.t
    }
    #[inline(always)]
    fn motion(&mut self, coordinate: u32, is_rate: bool) -> N {
        let place = coordinate as usize * self.expander.width + self.m;
        N::load(if is_rate {
            self.expander.rates[place]
        } else {
            self.expander.motion[place]
        })
    }
    #[inline(always)]
    fn first(&mut self, row: RowId) -> N {
        self.read(row, 0)
    }
    #[inline(always)]
    fn newest(&mut self, row: RowId) -> N {
        self.read(row, self.m)
    }
    #[inline(always)]
    fn before(&mut self, row: RowId) -> N {
        self.read(row, self.m - 1)
    }
    #[inline(always)]
    fn weighted(&mut self, row: RowId) -> N {
        match self.expander.weighted_places[row.index()] {
            // For rows whose own order is higher, this coefficient is final.
            Some(place) if self.expander.series.lead(row) > self.lead() => {
                N::load(self.expander.weighted[place + self.m])
            }
            _ => N::load(self.expander.newest[row.index()]),
        }
    }
    #[inline(always)]
    fn derivative(&mut self, row: RowId) -> N {
        let m = self.m + 1;
        self.expander.number::<N>(m) * self.read(row, m)
    }
    #[inline(always)]
    fn derivative_factors(&mut self, row: RowId) -> [N; 2] {
        let m = self.m + 1;
        [self.expander.number::<N>(m), self.read(row, m)]
    }
    #[inline(always)]
    fn second_derivative(&mut self, row: RowId) -> N {
        let m = self.m + 1;
        self.expander.number::<N>(m) * N::load(self.expander.newest[row.index()])
    }
    #[inline(always)]
    fn second_factors(&mut self, row: RowId) -> [N; 2] {
        let m = self.m + 1;
        let order = self.expander.number::<N>(m);
        if self.expander.series.is_integral(row) {
            [order, N::load(self.expander.newest[row.index()])]
        } else {
            [
                order * self.expander.number::<N>(m + 1),
                self.read(row, m + 1),
            ]
        }
    }
    #[inline(always)]
    fn convolution(&mut self, _row: RowId, number: usize) -> N {
        N::load(self.expander.sums_of_row[number])
    }
    #[inline(always)]
    fn sin_cos(&mut self, row: RowId) -> [N; 2] {
        let (sin, cos) = self.first(row).sin_cos();
        if !self.expander.series.exact[row.index()] {
            return [sin, cos];
        }
        let low = N::load(self.expander.low[row.index()]);
        [low.mul_add(cos, sin), low.neg_mul_add(sin, cos)]
    }
    #[inline(always)]
    fn call(&mut self, call: Call, a: N, b: N) -> N {
        match call {
            Call::Sqrt => a.sqrt(),
            Call::Sin => a.sin(),
            Call::Cos => a.cos(),
            Call::Atan2 | Call::Min | Call::Max | Call::Pow => binary(call, a, b),
            _ => unary(call, a),
        }
    }
    #[inline(always)]
    fn exact_sum(&mut self, row: RowId, terms: &[(Option<RowId>, RowId)]) -> N {
        let (mut sum, mut low) = (N::ZERO, N::ZERO);
        for (coefficient, of) in terms {
            let x = self.first(*of);
            let x_low = if self.expander.series.exact[of.index()] {
                N::load(self.expander.low[of.index()])
            } else {
                N::ZERO
            };
            let (term, term_low) = match coefficient {
                None => (x, x_low),
                Some(c) => {
                    let c = self.first(*c);
                    (c * x, c.mul_add(x_low, c.product_error(x)))
                }
            };
            low = low + (term_low + sum.sum_error(term));
            sum = sum + term;
        }
        self.expander.low[row.index()] = low.store();
        sum
    }
    #[inline(always)]
    fn over_order(&mut self) -> N {
        self.expander.reciprocal(self.m)
    }

    #[inline(always)]
    fn add(&mut self, a: N, b: N) -> N {
        a + b
    }
    #[inline(always)]
    fn subtract(&mut self, a: N, b: N) -> N {
        a - b
    }
    #[inline(always)]
    fn multiply(&mut self, a: N, b: N) -> N {
        a * b
    }
    #[inline(always)]
    fn divide(&mut self, a: N, b: N) -> N {
        a / b
    }
    #[inline(always)]
    fn negate(&mut self, a: N) -> N {
        -a
    }
    #[inline(always)]
    fn multiply_add(&mut self, a: N, b: N, c: N) -> N {
        a.mul_add(b, c)
    }
}

/// The sum of a [`Convolution`](super::super::Convolution) at order `m`, in the order given by [`TermOrder`].
#[inline(always)]
pub(super) fn convolve<T: Copy, N: Scalar<Stored = T>>(
    a: &[T],
    b: &[T],
    m: usize,
    along: TermOrder,
) -> N {
    let x = |list: &[T], j: usize| N::load(list[j]);
    match along {
        TermOrder::Position if m < 2 => N::ZERO,
        TermOrder::Position if m == 2 => x(a, 1) * x(b, 1),
        TermOrder::Position => {
            let sum = dot::<T, N>(&a[2..m - 1], &b[2..m - 1]);
            let sum = x(a, m - 1).mul_add(x(b, 1), sum);
            x(a, 1).mul_add(x(b, m - 1), sum)
        }
        TermOrder::Force => {
            let sum = dot::<T, N>(&a[..m - 1], &b[2..m + 1]);
            x(a, m - 1).mul_add(x(b, 1), sum)
        }
        TermOrder::Other => dot(&a[1..m], &b[1..m]),
    }
}

/// `Σ aⱼ b₍n−1−j₎`, in the order of [`convolve_all`](lagrangian_scalar::series::convolve_all).
#[inline(always)]
fn dot<T: Copy, N: Scalar<Stored = T>>(a: &[T], b: &[T]) -> N {
    let count = a.len().min(b.len());
    let half = count / 2;
    let (mut down, mut up) = (N::ZERO, N::ZERO);
    if count % 2 == 1 {
        down = N::load(a[half]).mul_add(N::load(b[half]), down);
    }
    let below = a[..half].iter().zip(&b[..half]).rev();
    let above = a[count - half..count].iter().zip(&b[count - half..count]);
    for ((&low_a, &low_b), (&high_a, &high_b)) in below.zip(above) {
        down = N::load(low_a).mul_add(N::load(high_b), down);
        up = N::load(high_a).mul_add(N::load(low_b), up);
    }
    down + up
}
