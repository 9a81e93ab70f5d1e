//! Functions that the methods of every emitted machine call.

use core::array;
use core::marker::PhantomData;

use crate::scalar::{Interval, Kernel};
use crate::{Assumption, Constraint, Lanes, Number, Quantity, Singular};

/// Values with their names and units.
pub fn values<'a, const K: usize>(
    names: &'a [Quantity<'a>],
    values: [f64; K],
) -> impl ExactSizeIterator<Item = (Quantity<'a>, f64)> {
    names.iter().copied().zip(values)
}

/// Writes as many numbers as fit.
pub fn fill(to: &mut [f64], from: &[f64]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}

/// Runs a function that gives an array and writes it to a slice; `false` if the slice is too short.
#[inline(always)]
pub fn run_into<const N: usize, E, K>(kernel: K, to: &mut [f64]) -> Result<bool, E>
where
    K: Kernel<f64, Output = Result<[f64; N], E>>,
{
    match to.first_chunk_mut::<N>() {
        Some(to) => f64::run_in_place(kernel, to).map(|()| true),
        None => Ok(false),
    }
}

/// Writes the bounds of intervals.
pub fn fill_ranges(to: &mut [[f64; 2]], from: &[Interval]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = [from.lo(), from.hi()];
    }
}

/// Assumptions from their texts, whether they are strict, and their margins.
pub fn assumptions<'a, const K: usize>(
    facts: [(&'a str, bool, f64); K],
) -> impl ExactSizeIterator<Item = Assumption<'a>> {
    let fact = |(text, strict, margin)| Assumption {
        text,
        margin,
        strict,
    };
    facts.into_iter().map(fact)
}

/// Intervals from lowest to highest numbers.
#[inline]
pub fn intervals<const K: usize>([low, high]: [&[f64; K]; 2]) -> [Interval; K] {
    array::from_fn(|i| Interval::new(low[i], high[i]))
}

/// Whether assumptions hold that are strict or not, with margins in these intervals.
#[inline]
pub fn hold<const K: usize>(facts: [(bool, Interval); K]) -> bool {
    let holds =
        |(strict, margin): (bool, Interval)| margin.lo() > 0.0 || (!strict && margin.lo() >= 0.0);
    facts.into_iter().all(holds)
}

/// A constraint: its name, its unit, the unit of its multiplier, and whether positions are constrained.
pub type ConstraintRow = (&'static str, &'static str, &'static str, bool);

/// The constraint of such a row.
pub fn constraint(&(name, unit, multiplier_unit, holonomic): &ConstraintRow) -> Constraint<'_> {
    Constraint {
        name,
        unit,
        multiplier_unit,
        holonomic,
    }
}

/// The values of N machines side by side: for each value one number per machine.
pub fn side_by_side<const K: usize, const N: usize>(rows: [[f64; K]; N]) -> [Lanes<N>; K] {
    array::from_fn(|value| Lanes(rows.map(|row| row[value])))
}

/// The number with all numbers that round to it.
#[inline]
pub fn rounded(x: f64) -> Interval {
    Interval::new(x.next_down(), x.next_up())
}

/// A field of the prepared values: a number, an array of numbers, or a field without numbers, which
/// stays as it is.
pub trait PreparedField: Copy {
    /// The field with numbers of another type.
    type In<R>;

    /// The fields of several systems side by side.
    fn side_by_side<const N: usize>(fields: [Self; N]) -> Self::In<Lanes<N>>;

    /// The field as intervals of its rounding.
    fn rounded(self) -> Self::In<Interval>;
}

impl PreparedField for f64 {
    type In<R> = R;

    fn side_by_side<const N: usize>(fields: [Self; N]) -> Lanes<N> {
        Lanes(fields)
    }

    fn rounded(self) -> Interval {
        rounded(self)
    }
}

impl<const K: usize> PreparedField for [f64; K] {
    type In<R> = [R; K];

    fn side_by_side<const N: usize>(fields: [Self; N]) -> [Lanes<N>; K] {
        side_by_side(fields)
    }

    fn rounded(self) -> [Interval; K] {
        self.map(rounded)
    }
}

/// Systems that are evaluated side by side are not singular by their parameters.
impl PreparedField for Option<Singular> {
    type In<R> = Self;

    fn side_by_side<const N: usize>(_: [Self; N]) -> Self {
        None
    }

    fn rounded(self) -> Self {
        self
    }
}

impl PreparedField for PhantomData<f64> {
    type In<R> = PhantomData<R>;

    fn side_by_side<const N: usize>(_: [Self; N]) -> PhantomData<Lanes<N>> {
        PhantomData
    }

    fn rounded(self) -> PhantomData<Interval> {
        PhantomData
    }
}
