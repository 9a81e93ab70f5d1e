//! The operations that sines, cosines and lanes need from a processor: one trait, implemented by plain numbers, by
//! arrays of them, and by the registers of x86-64.

use core::fmt::Debug;

use crate::{Lanes, Piece, Scalar};

/// One number or several in a register, with fused multiply-add.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct Register<V>(pub(crate) V);

/// Numbers that a processor works on at once: 1, 2, 4 or 8 of them.
///
/// Every operation is that of IEEE 754 on each number separately, so the same sequence of operations gives the same
/// bits in every implementation, whatever the other lanes hold.
pub trait Vector: Copy {
    /// The form in which the numbers are stored in memory.
    type Stored: Copy + Debug + PartialEq;
    /// A truth value for each number.
    type Mask: Copy;

    /// Zeros.
    const ZERO: Self;
    /// Ones.
    const ONE: Self;
    /// [`Scalar::PAIRS_AT_ONCE`] for the available number of registers, which hold two sums and the factors of each pair.
    const PAIRS_AT_ONCE: usize;

    /// Loads the numbers from memory.
    fn load(stored: Self::Stored) -> Self;
    /// Stores the numbers to memory.
    fn store(self) -> Self::Stored;
    /// One number in every lane.
    fn splat(x: f64) -> Self;

    /// `self + other`.
    fn add(self, other: Self) -> Self;
    /// `self − other`.
    fn sub(self, other: Self) -> Self;
    /// `self · other`.
    fn mul(self, other: Self) -> Self;
    /// `self / other`.
    fn div(self, other: Self) -> Self;
    /// `self·b + c`, rounded once.
    fn mul_add(self, b: Self, c: Self) -> Self;
    /// `self·b − c`, rounded once.
    fn mul_sub(self, b: Self, c: Self) -> Self;
    /// `c − self·b`, rounded once.
    fn neg_mul_add(self, b: Self, c: Self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;

    /// Two sums; like the operations below, in one instruction where two numbers fit into a register.
    #[inline(always)]
    fn add_each(a: [Self; 2], b: [Self; 2]) -> [Self; 2] {
        [a[0].add(b[0]), a[1].add(b[1])]
    }

    /// Two differences.
    #[inline(always)]
    fn sub_each(a: [Self; 2], b: [Self; 2]) -> [Self; 2] {
        [a[0].sub(b[0]), a[1].sub(b[1])]
    }

    /// Two products.
    #[inline(always)]
    fn mul_each(a: [Self; 2], b: [Self; 2]) -> [Self; 2] {
        [a[0].mul(b[0]), a[1].mul(b[1])]
    }

    /// Two quotients.
    #[inline(always)]
    fn div_each(a: [Self; 2], b: [Self; 2]) -> [Self; 2] {
        [a[0].div(b[0]), a[1].div(b[1])]
    }

    /// Two `mul_add`.
    #[inline(always)]
    fn mul_add_each(a: [Self; 2], b: [Self; 2], c: [Self; 2]) -> [Self; 2] {
        [a[0].mul_add(b[0], c[0]), a[1].mul_add(b[1], c[1])]
    }

    /// Two `mul_sub`.
    #[inline(always)]
    fn mul_sub_each(a: [Self; 2], b: [Self; 2], c: [Self; 2]) -> [Self; 2] {
        [a[0].mul_sub(b[0], c[0]), a[1].mul_sub(b[1], c[1])]
    }

    /// Two `neg_mul_add`.
    #[inline(always)]
    fn neg_mul_add_each(a: [Self; 2], b: [Self; 2], c: [Self; 2]) -> [Self; 2] {
        [a[0].neg_mul_add(b[0], c[0]), a[1].neg_mul_add(b[1], c[1])]
    }

    /// Absolute value.
    #[inline(always)]
    fn abs(self) -> Self {
        self.and(Self::splat(f64::from_bits(!(1 << 63))))
    }
    /// Bitwise and.
    fn and(self, other: Self) -> Self;
    /// Bitwise exclusive or.
    fn xor(self, other: Self) -> Self;
    /// All bits shifted left by `PLACES`, as those of an integer.
    fn shift_left<const PLACES: u32>(self) -> Self;

    /// Whether the lowest bit is 1.
    fn is_odd(self) -> Self::Mask;
    /// `self < other`; false for NaN.
    fn less(self, other: Self) -> Self::Mask;
    /// `self ≤ other`; false for NaN.
    fn at_most(self, other: Self) -> Self::Mask;
    /// `yes` where the mask is true, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// The masks' logical and.
    fn mask_and(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Whether the mask is true everywhere.
    fn all(mask: Self::Mask) -> bool;

    /// Applies a function to every number.
    fn map(self, f: impl Fn(f64) -> f64) -> Self;
    /// Applies a function to every pair of corresponding numbers.
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self;
    /// The first number.
    fn first(self) -> f64;

    /// Calls a part of a long function as a function that may use this type's instructions.
    fn call<P: Piece>(piece: P) -> P::Output;
}

/// `a·b + c`, rounded once.
#[inline(always)]
fn fused(a: f64, b: f64, c: f64) -> f64 {
    #[cfg(feature = "std")]
    return a.mul_add(b, c);
    #[cfg(not(feature = "std"))]
    {
        use core::arch::x86_64::*;
        // SAFETY: without the standard library this is compiled only where the target features include the instruction.
        unsafe { _mm_cvtsd_f64(_mm_fmadd_sd(_mm_set_sd(a), _mm_set_sd(b), _mm_set_sd(c))) }
    }
}

/// One number, with the fused multiply-add of the standard library: an instruction where the target has it, correct
/// but slow elsewhere.
impl Vector for f64 {
    type Stored = f64;
    type Mask = bool;

    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const PAIRS_AT_ONCE: usize = 0;

    #[inline(always)]
    fn load(stored: f64) -> Self {
        stored
    }
    #[inline(always)]
    fn store(self) -> f64 {
        self
    }
    #[inline(always)]
    fn splat(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self + other
    }
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self - other
    }
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self * other
    }
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self / other
    }
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        fused(self, b, c)
    }
    #[inline(always)]
    fn mul_sub(self, b: Self, c: Self) -> Self {
        fused(self, b, -c)
    }
    #[inline(always)]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        fused(-self, b, c)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Scalar::sqrt(self)
    }
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        f64::from_bits(self.to_bits() & other.to_bits())
    }
    #[inline(always)]
    fn xor(self, other: Self) -> Self {
        f64::from_bits(self.to_bits() ^ other.to_bits())
    }
    #[inline(always)]
    fn shift_left<const PLACES: u32>(self) -> Self {
        f64::from_bits(self.to_bits() << PLACES)
    }
    #[inline(always)]
    fn is_odd(self) -> bool {
        self.to_bits() & 1 == 1
    }
    #[inline(always)]
    fn less(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> bool {
        self <= other
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn mask_and(a: bool, b: bool) -> bool {
        a & b
    }
    #[inline(always)]
    fn all(mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        f(self)
    }
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        f(self, other)
    }
    #[inline(always)]
    fn first(self) -> f64 {
        self
    }
    #[inline(never)]
    fn call<P: Piece>(piece: P) -> P::Output {
        piece.run()
    }
}

/// Batch numbers, one after another.
impl<const N: usize> Vector for [f64; N] {
    type Stored = Lanes<N>;
    type Mask = [bool; N];

    const ZERO: Self = [0.0; N];
    const ONE: Self = [1.0; N];
    const PAIRS_AT_ONCE: usize = 4;

    #[inline(always)]
    fn load(stored: Lanes<N>) -> Self {
        stored.0
    }
    #[inline(always)]
    fn store(self) -> Lanes<N> {
        Lanes(self)
    }
    #[inline(always)]
    fn splat(x: f64) -> Self {
        [x; N]
    }
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        each(|i| self[i] + other[i])
    }
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        each(|i| self[i] - other[i])
    }
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        each(|i| self[i] * other[i])
    }
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        each(|i| self[i] / other[i])
    }
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        each(|i| Vector::mul_add(self[i], b[i], c[i]))
    }
    #[inline(always)]
    fn mul_sub(self, b: Self, c: Self) -> Self {
        each(|i| Vector::mul_sub(self[i], b[i], c[i]))
    }
    #[inline(always)]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        each(|i| Vector::neg_mul_add(self[i], b[i], c[i]))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        each(|i| Vector::sqrt(self[i]))
    }
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        each(|i| self[i].and(other[i]))
    }
    #[inline(always)]
    fn xor(self, other: Self) -> Self {
        each(|i| self[i].xor(other[i]))
    }
    #[inline(always)]
    fn shift_left<const PLACES: u32>(self) -> Self {
        each(|i| self[i].shift_left::<PLACES>())
    }
    #[inline(always)]
    fn is_odd(self) -> [bool; N] {
        each(|i| self[i].is_odd())
    }
    #[inline(always)]
    fn less(self, other: Self) -> [bool; N] {
        each(|i| self[i] < other[i])
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> [bool; N] {
        each(|i| self[i] <= other[i])
    }
    #[inline(always)]
    fn select(mask: [bool; N], yes: Self, no: Self) -> Self {
        each(|i| if mask[i] { yes[i] } else { no[i] })
    }
    #[inline(always)]
    fn mask_and(a: [bool; N], b: [bool; N]) -> [bool; N] {
        each(|i| a[i] & b[i])
    }
    #[inline(always)]
    fn all(mask: [bool; N]) -> bool {
        mask == [true; N]
    }
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        each(|i| f(self[i]))
    }
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        each(|i| f(self[i], other[i]))
    }
    #[inline(always)]
    fn first(self) -> f64 {
        self[0]
    }
    #[inline(never)]
    fn call<P: Piece>(piece: P) -> P::Output {
        piece.run()
    }
}

/// A value for every lane.
#[inline(always)]
fn each<T, const N: usize>(f: impl FnMut(usize) -> T) -> [T; N] {
    core::array::from_fn(f)
}
