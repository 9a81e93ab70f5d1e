//! The motion in a step by series: sums of its terms at any time, in registers.

use crate::compensated::two_sum;
use crate::scalar::Kernel;
use crate::stages::{Point, in_blocks};
use crate::{Lanes, Real, Scalar, Vector};

/// Runs a kernel for `n` coordinates, from `start` to `end` each time: in blocks of four, then of two and of one. Returns whether all of them return `true`.
macro_rules! in_registers {
    ($n:expr, |$start:ident, $end:ident| $kernel:expr) => {{
        let n = $n;
        let (fours, twos) = (n / 4 * 4, n / 2 * 2);
        let mut are_fine = true;
        if fours > 0 {
            let ($start, $end) = (0, fours);
            are_fine &= <$crate::Lanes<4> as $crate::Number>::run($kernel);
        }
        if twos > fours {
            let ($start, $end) = (fours, twos);
            are_fine &= <$crate::Lanes<2> as $crate::Number>::run($kernel);
        }
        if n > twos {
            let ($start, $end) = (twos, n);
            are_fine &= <f64 as $crate::Number>::run($kernel);
        }
        are_fine
    }};
}
pub(super) use in_registers;

/// Numbers that lie side by side in memory and fill a register.
pub(super) trait Block: Copy {
    /// How many.
    const COUNT: usize;
    /// Those from an index on; NaN if there are fewer.
    fn read(from: &[f64], start: usize) -> Self;
    /// Writes them from an index on, if there is room for them.
    fn write(self, to: &mut [f64], start: usize);
    /// The same number several times.
    fn each(x: f64) -> Self;
    /// Whether all of them are finite.
    fn are_finite(self) -> bool;
    /// Whether all of them are numbers that are not negative.
    fn are_not_negative(self) -> bool;
}

impl Block for f64 {
    const COUNT: usize = 1;
    #[inline(always)]
    fn read(from: &[f64], start: usize) -> Self {
        from.get(start).copied().unwrap_or(f64::NAN)
    }
    #[inline(always)]
    fn write(self, to: &mut [f64], start: usize) {
        if let Some(to) = to.get_mut(start) {
            *to = self;
        }
    }
    #[inline(always)]
    fn each(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn are_finite(self) -> bool {
        self.is_finite()
    }
    #[inline(always)]
    fn are_not_negative(self) -> bool {
        self >= 0.0
    }
}

impl<const W: usize> Block for Lanes<W> {
    const COUNT: usize = W;
    #[inline(always)]
    fn read(from: &[f64], start: usize) -> Self {
        let block = from.get(start..).and_then(|from| from.first_chunk::<W>());
        Lanes(block.copied().unwrap_or([f64::NAN; W]))
    }
    #[inline(always)]
    fn write(self, to: &mut [f64], start: usize) {
        if let Some(to) = to.get_mut(start..).and_then(|to| to.first_chunk_mut::<W>()) {
            *to = self.0;
        }
    }
    #[inline(always)]
    fn each(x: f64) -> Self {
        Lanes([x; W])
    }
    #[inline(always)]
    fn are_finite(self) -> bool {
        let mut fine = true;
        for x in self.0 {
            fine &= x.is_finite();
        }
        fine
    }
    #[inline(always)]
    fn are_not_negative(self) -> bool {
        let mut fine = true;
        for x in self.0 {
            fine &= x >= 0.0;
        }
        fine
    }
}

/// [`Taylor::advance`] for the coordinates from `start` to `end`, whose number is a multiple of that of a block, as a kernel. The
/// coordinates of one trajectory fill registers as several trajectories do elsewhere: with the same bits, and a compiler does not
/// put them into registers by itself.
pub(super) struct Advance<'a, V> {
    pub coefficients: &'a [V],
    pub h: f64,
    pub before: &'a Point<V>,
    pub now: &'a mut Point<V>,
    pub a: &'a mut V,
    pub start: usize,
    pub end: usize,
}

/// Coefficients of one trajectory, of as many coordinates at once as a register holds.
struct Blocks<'a, V>(&'a [V]);

impl<N: Scalar<Stored: Block>, V: Vector> Coefficients<N> for Blocks<'_, V> {
    #[inline(always)]
    fn count(&self) -> usize {
        self.0.len()
    }

    #[inline(always)]
    fn block<const B: usize>(&self, j: usize, start: usize) -> [N; B] {
        let mut block = [N::ZERO; B];
        for (i, number) in block.iter_mut().enumerate() {
            *number = N::load(N::Stored::read(
                self.0[j].as_slice(),
                start + i * N::Stored::COUNT,
            ));
        }
        block
    }
}

impl<T: Block, V: Vector> Kernel<T> for Advance<'_, V> {
    type Output = bool;

    #[inline(always)]
    fn run<N: Scalar<Stored = T>>(self) -> bool {
        let Self {
            coefficients,
            before,
            now,
            a,
            mut start,
            end,
            ..
        } = self;
        let h = N::load(T::each(self.h));
        let mut is_fine = true;
        while start < end {
            let [[q], [v], [accelerations]] = motion::<1, 3, N>(&Blocks(coefficients), start, h);
            let low = N::load(T::read(before.v_low.as_slice(), start));
            let q_low = N::load(T::read(before.q_low.as_slice(), start)) + h * low;
            let (high, rest) = two_sum(N::load(T::read(before.q.as_slice(), start)), q_low + q);
            high.store().write(now.q.as_mut_slice(), start);
            rest.store().write(now.q_low.as_mut_slice(), start);
            is_fine &= high.store().are_finite();
            let (high, rest) = two_sum(N::load(T::read(before.v.as_slice(), start)), low + v);
            high.store().write(now.v.as_mut_slice(), start);
            rest.store().write(now.v_low.as_mut_slice(), start);
            is_fine &= high.store().are_finite();
            accelerations.store().write(a.as_mut_slice(), start);
            start += T::COUNT;
        }
        is_fine
    }
}

/// Access to the coefficients of coordinates for [`motion`].
pub(crate) trait Coefficients<N> {
    /// The number of coefficients of each coordinate.
    fn count(&self) -> usize;
    /// The coefficients of order `j`, of `B` coordinates from `start` on. Always inlined, which a closure may not be into code for registers
    /// that only some processors have.
    fn block<const B: usize>(&self, j: usize, start: usize) -> [N; B];
}

/// The coefficients of one trajectory.
struct Rows<'a, V>(&'a [V]);

impl<N: Real, V: Vector<N>> Coefficients<N> for Rows<'_, V> {
    #[inline(always)]
    fn count(&self) -> usize {
        self.0.len()
    }

    #[inline(always)]
    fn block<const B: usize>(&self, j: usize, start: usize) -> [N; B] {
        let row = self.0[j].as_slice().get(start..start + B);
        row.and_then(|row| row.first_chunk::<B>())
            .copied()
            .unwrap_or([N::from_f64(f64::NAN); B])
    }
}

/// `a·factor + c` for each number.
#[inline(always)]
fn horner<const B: usize, N: Scalar>(mut a: [N; B], factor: N, c: [N; B]) -> [N; B] {
    for i in 0..B {
        a[i] = a[i].mul_add(factor, c[i]);
    }
    a
}

/// A number times each of several.
#[inline(always)]
fn times<const B: usize, N: Scalar>(factor: N, mut a: [N; B]) -> [N; B] {
    for a in &mut a {
        *a = factor * *a;
    }
    a
}

/// A step of Horner's rule for polynomials, in `sums[0]`, and their first derivatives over the factorials of their orders.
#[inline(always)]
fn take_term<const B: usize, const D: usize, N: Scalar>(
    sums: &mut [[N; B]; D],
    x: N,
    next: [N; B],
) {
    for d in (1..D).rev() {
        sums[d] = horner(sums[d], x, sums[d - 1]);
    }
    sums[0] = horner(sums[0], x, next);
}

/// The changes of `B` coordinates from `start` on, and of their rates, in a time `tau`, and with `D` = 3 their accelerations then.
///
/// With `q(τ) = q + τ (v + τ M(τ))` they are `τ (v + τ M)`, `τ (2 M + τ M')` and `2 M + 4 τ M' + τ² M''`. The polynomial is `M(τ) = E(τ²) + τ O(τ²)`, and both
/// parts are computed with their derivatives by Horner's rule (D. E. Knuth, *The Art of Computer Programming*, vol. 2, 3rd ed. 1998, section 4.6.4): two
/// dependency chains half as long, and for each term three multiplications that are fused with additions.
#[inline(always)]
pub(crate) fn motion<const B: usize, const D: usize, N: Scalar>(
    coefficients: &impl Coefficients<N>,
    start: usize,
    tau: N,
) -> [[N; B]; D] {
    const {
        assert!(
            D == 2 || D == 3,
            "coordinates and rates, or accelerations too"
        )
    };
    let square = tau * tau;
    let terms = coefficients.count().saturating_sub(2);
    // Two variables and not an array, so that a compiler keeps them in registers.
    let (mut even, mut odd) = ([[N::ZERO; B]; D], [[N::ZERO; B]; D]);
    let mut i = terms / 2 * 2;
    if terms % 2 == 1 {
        even[0] = coefficients.block::<B>(2 + i, start);
    }
    while i > 0 {
        i -= 2;
        take_term(&mut odd, square, coefficients.block::<B>(3 + i, start));
        take_term(&mut even, square, coefficients.block::<B>(2 + i, start));
    }
    let [two, three, four] = [N::from_f64(2.0), N::from_f64(3.0), N::from_f64(4.0)];
    let (twice, four_times) = (two * square, four * square);
    let m = horner(odd[0], tau, even[0]);
    // τ M' = 2 τ² E' + τ (O + 2 τ² O')
    let first = horner(horner(odd[1], twice, odd[0]), tau, times(twice, even[1]));
    let by_v = times(tau, horner(m, two, first));
    let by_q = times(tau, horner(m, tau, coefficients.block::<B>(1, start)));
    let mut motion = [by_q; D];
    motion[1] = by_v;
    if D == 3 {
        // τ² M'' = 2 τ² (E' + 2 τ² E'' + τ (3 O' + 2 τ² O'')), with half of the second derivatives at hand
        let of_even = horner(even[D - 1], four_times, even[1]);
        let of_odd = horner(odd[D - 1], four_times, times(three, odd[1]));
        let second = times(twice, horner(of_odd, tau, of_even));
        motion[D - 1] = horner(m, two, horner(first, four, second));
    }
    motion
}

/// Coordinates and rates at a time `tau` after the state that was expanded.
pub(crate) fn state<N: Real, V: Vector<N>>(coefficients: &[V], tau: N) -> (V, V) {
    let (mut q, mut v) = (coefficients[0].clone(), coefficients[1].clone());
    in_blocks!(q.as_slice().len(), |start, B| {
        let [by_q, by_v] = motion::<B, 2, N>(&Rows(coefficients), start, tau);
        for k in 0..B {
            let i = start + k;
            q.as_mut_slice()[i] = q.as_slice()[i] + by_q[k];
            v.as_mut_slice()[i] = v.as_slice()[i] + by_v[k];
        }
    });
    (q, v)
}

/// [`state`] with the accelerations then, into memory of a machine's dimension.
pub(crate) fn state_with_accelerations<V: Vector>(
    coefficients: &[V],
    tau: f64,
    [q, v, a]: [&mut V; 3],
) {
    let n = a.as_slice().len();
    in_registers!(n, |start, end| Along {
        coefficients,
        tau,
        at: [&mut *q, &mut *v, &mut *a],
        start,
        end,
    });
}

/// [`state_with_accelerations`] for the coordinates from `start` to `end`, whose number is a multiple of that of a block, as a kernel.
struct Along<'a, V> {
    coefficients: &'a [V],
    tau: f64,
    at: [&'a mut V; 3],
    start: usize,
    end: usize,
}

impl<T: Block, V: Vector> Kernel<T> for Along<'_, V> {
    type Output = bool;

    #[inline(always)]
    fn run<N: Scalar<Stored = T>>(self) -> bool {
        let Self {
            coefficients,
            at: [q, v, a],
            mut start,
            end,
            ..
        } = self;
        let tau = N::load(T::each(self.tau));
        let rows = Blocks(coefficients);
        while start < end {
            let [[by_q], [by_v], [there]] = motion::<1, 3, N>(&rows, start, tau);
            let [q_then, v_then]: [[N; 1]; 2] = [rows.block(0, start), rows.block(1, start)];
            (q_then[0] + by_q).store().write(q.as_mut_slice(), start);
            (v_then[0] + by_v).store().write(v.as_mut_slice(), start);
            there.store().write(a.as_mut_slice(), start);
            start += T::COUNT;
        }
        true
    }
}

/// The accelerations at a time `tau` after the state that was expanded.
pub(crate) fn accelerations<V: Vector>(coefficients: &[V], tau: f64, a: &mut V) {
    in_blocks!(a.as_slice().len(), |start, B| {
        let mut sums = [0.0; B];
        for j in (2..coefficients.len()).rev() {
            let factor = (j * (j - 1)) as f64;
            let terms: [f64; B] = Rows(coefficients).block::<B>(j, start);
            for k in 0..B {
                sums[k] = sums[k] * tau + factor * terms[k];
            }
        }
        a.as_mut_slice()[start..start + B].copy_from_slice(&sums);
    });
}
