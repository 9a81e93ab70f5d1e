//! Products of lists of numbers that lie side by side, in whole registers. As in the parent module, the processor has been checked.

use core::arch::x86_64::*;

use super::One;
#[cfg(doc)]
use crate::circular::Sines;
use crate::vector::{Register, Vector};

/// Several numbers that lie side by side in memory.
pub(super) trait SideBySide: Copy {
    /// How many numbers.
    const COUNT: usize;
    /// Zeros.
    fn zero() -> Self;
    /// Reads them from an address.
    ///
    /// # Safety
    /// The address must have this many numbers.
    unsafe fn read(from: *const f64) -> Self;
    /// Writes them to an address.
    ///
    /// # Safety
    /// The address must have room for this many numbers.
    unsafe fn write(self, to: *mut f64);
    /// `self·b + c`, rounded once.
    fn mul_add(self, b: Self, c: Self) -> Self;
    /// `self + b`.
    fn add(self, b: Self) -> Self;
}

macro_rules! side_by_side {
    ($($raw:ty: $count:literal $zero:ident $read:ident $write:ident $mul_add:ident $add:ident;)*) => {$(
        impl SideBySide for $raw {
            const COUNT: usize = $count;
            #[inline(always)]
            fn zero() -> Self {
                // SAFETY: the processor has been checked (see the parent module).
                unsafe { $zero() }
            }
            #[inline(always)]
            unsafe fn read(from: *const f64) -> Self {
                // SAFETY: guaranteed by the caller; the processor has been checked.
                unsafe { $read(from) }
            }
            #[inline(always)]
            unsafe fn write(self, to: *mut f64) {
                // SAFETY: guaranteed by the caller; the processor has been checked.
                unsafe { $write(to, self) }
            }
            #[inline(always)]
            fn mul_add(self, b: Self, c: Self) -> Self {
                // SAFETY: the processor has been checked (see the parent module).
                unsafe { $mul_add(self, b, c) }
            }
            #[inline(always)]
            fn add(self, b: Self) -> Self {
                // SAFETY: the processor has been checked (see the parent module).
                unsafe { $add(self, b) }
            }
        }
    )*};
}

side_by_side! {
    __m128d: 2 _mm_setzero_pd _mm_loadu_pd _mm_storeu_pd _mm_fmadd_pd _mm_add_pd;
    __m256d: 4 _mm256_setzero_pd _mm256_loadu_pd _mm256_storeu_pd _mm256_fmadd_pd _mm256_add_pd;
}

impl SideBySide for f64 {
    const COUNT: usize = 1;
    #[inline(always)]
    fn zero() -> f64 {
        0.0
    }
    #[inline(always)]
    unsafe fn read(from: *const f64) -> f64 {
        // SAFETY: guaranteed by the caller.
        unsafe { *from }
    }
    #[inline(always)]
    unsafe fn write(self, to: *mut f64) {
        // SAFETY: guaranteed by the caller.
        unsafe { *to = self }
    }
    #[inline(always)]
    fn mul_add(self, b: f64, c: f64) -> f64 {
        Vector::mul_add(self, b, c)
    }
    #[inline(always)]
    fn add(self, b: f64) -> f64 {
        self + b
    }
}

/// Adds products of numbers that lie side by side from `start` on, to as many sums as `G` registers hold.
#[inline(always)]
fn add_products<V: SideBySide, const G: usize, const P: usize>(
    a: &[f64; P],
    b: &[f64; P],
    start: usize,
    sums: &mut [V; G],
) {
    assert!(start + G * V::COUNT <= P, "lists are wide enough");
    let mut g = 0;
    while g < G {
        let place = start + g * V::COUNT;
        // SAFETY: both are `P` numbers long, and the registers end within.
        let (a, b) = unsafe {
            (
                V::read(a.as_ptr().add(place)),
                V::read(b.as_ptr().add(place)),
            )
        };
        sums[g] = a.mul_add(b, sums[g]);
        g += 1;
    }
}

/// [`Sines::convolve_all`] of the lists from `start` on, in `G` registers.
#[inline(always)]
pub(super) fn convolve<V: SideBySide, const G: usize, const P: usize>(
    a: &[[f64; P]],
    b: &[[f64; P]],
    start: usize,
    sums: &mut [Register<One>; P],
) {
    assert!(start + G * V::COUNT <= P, "lists are wide enough");
    let count = a.len().min(b.len());
    let half = count / 2;
    let (a, b) = (&a[..count], &b[..count]);
    let (mut down, mut up) = ([V::zero(); G], [V::zero(); G]);
    if count % 2 == 1 {
        add_products(&a[half], &b[half], start, &mut down);
    }
    for step in 0..half {
        let (low, high) = (half - 1 - step, count - half + step);
        // SAFETY: `low` is below half of the rows and `high` below all of them, which both lists have.
        let (rows_a, rows_b) = unsafe {
            (
                (a.get_unchecked(low), a.get_unchecked(high)),
                (b.get_unchecked(low), b.get_unchecked(high)),
            )
        };
        add_products(rows_a.0, rows_b.1, start, &mut down);
        add_products(rows_a.1, rows_b.0, start, &mut up);
    }
    let to = sums.as_mut_ptr().cast::<f64>();
    let mut g = 0;
    while g < G {
        // SAFETY: as above; a register of one number is laid out as that number.
        unsafe { down[g].add(up[g]).write(to.add(start + g * V::COUNT)) };
        g += 1;
    }
}

/// Stores four of the numbers of a row from an index on.
#[inline(always)]
pub(super) fn store_four<const P: usize>(row: &mut [f64; P], numbers: &[f64; P], start: usize) {
    assert!(start + 4 <= P, "the row is long enough");
    let (a, b) = (numbers[start], numbers[start + 1]);
    let (c, d) = (numbers[start + 2], numbers[start + 3]);
    // SAFETY: the processor has been checked (see the parent module), and the row has four numbers there.
    unsafe { _mm256_storeu_pd(row.as_mut_ptr().add(start), _mm256_set_pd(d, c, b, a)) };
}
