//! Steps by Taylor series.
//!
//! The motion through the beginning of a step is a polynomial `q(τ) = Σ cⱼ τʲ`, whose coefficients a machine computes
//! ([`System::series`]). A step evaluates it at its end, and dense output and events evaluate it between its ends without
//! further evaluations of the machine. The length of a step follows from the last two coefficients before the step is taken. A step is
//! rejected only if the motion is not its series at the end ([`defect`]).
//!
//! State and time are compensated sums: an increment of the state is rounded once, and the rounding error is kept (N. J. Higham,
//! *Accuracy and Stability of Numerical Algorithms*, 2nd ed., 2002, section 4.3).

mod bounds;

use std::vec::Vec;

use crate::compensated::two_sum;
use crate::math::{larger, rough_exp2, rough_log2};
use crate::scalar::Kernel;
use crate::series_memory::SeriesMemory;
use crate::stages::{Point, in_blocks};
use crate::tolerance::Tolerance;
use crate::{Lanes, Number, Real, Scalar, Singular, System, Vector};
pub(crate) use bounds::MotionBounds;

/// How large the [`defect`] of a step is at most if the motion is its series. Both last terms of a rate are at most their bound. Those that follow
/// fall by the ratio r of the step to the radius of convergence, and the derivative of the term of power j, times the step, is j times
/// as large: all together are `j r/(1 − r)²` of the bound, which is 20 if r is 0.4 and j is 22, and 230 at the coarsest tolerance, where r is 0.8 and j is
/// 14.
pub(crate) const GREATEST_DEFECT: f64 = 1e3;

/// The rounding errors of accelerations that do not count as a [`defect`], in units of round-off: a step at the finest tolerances is not examined
/// further for what round-off makes of them.
pub(crate) const ROUNDING_UNITS: f64 = 1e4;

/// The defect of a step must be this many times what a change of the state by its rounding makes of it.
pub(crate) const ROUNDINGS: f64 = 1e3;

/// A step is not rejected for its defect if it is shorter than this many of the shortest steps.
pub(crate) const SHORTEST_STEPS: f64 = 100.0;

/// Number of coefficients of the accelerations for tolerances above [`FINE`], and for finer ones.
const ORDERS: [usize; 2] = [12, 20];

/// Below this tolerance the higher order costs less time: the cost of products of series grows with the square of the order, the
/// rest of a step with the order itself, but at fine tolerances the gain in step length is larger.
pub(crate) const FINE: f64 = 1e-5;

/// The number of coefficients of a coordinate for the sum of the relative and the smallest absolute tolerance.
pub(crate) fn rows(tolerance: f64) -> usize {
    ORDERS[usize::from(tolerance <= FINE)] + 2
}

/// Runs a kernel for `n` coordinates, from `start` to `end` each time: in blocks of four, then of two and of one. Returns whether all of them return `true`.
macro_rules! in_registers {
    ($n:expr, |$start:ident, $end:ident| $kernel:expr) => {{
        let n = $n;
        let (fours, twos) = (n / 4 * 4, n / 2 * 2);
        let mut are_fine = true;
        if fours > 0 {
            let ($start, $end) = (0, fours);
            are_fine &= Lanes::<4>::run($kernel);
        }
        if twos > fours {
            let ($start, $end) = (fours, twos);
            are_fine &= Lanes::<2>::run($kernel);
        }
        if n > twos {
            let ($start, $end) = (twos, n);
            are_fine &= f64::run($kernel);
        }
        are_fine
    }};
}
use in_registers;

/// The coefficients of the motion through the beginning of the last step and through its end.
#[derive(Clone, Debug)]
pub(crate) struct Taylor<V> {
    coefficients: [Vec<V>; 2],
    /// The index of those of the beginning.
    beginning: usize,
    /// Whether a step was taken from there.
    is_taken: bool,
    /// The length of the next step, once computed.
    length: Option<f64>,
    /// The [part](part_for_all_sizes) of a tolerable error that is the bound on the last terms of a step, if it is the same for all coordinates.
    part: Option<f64>,
    memory: SeriesMemory,
}

impl<V: Vector> Taylor<V> {
    /// Memory for a series of the order that a tolerance requires.
    pub fn new(tolerance: &Tolerance<V>) -> Self {
        let zeros = tolerance.absolute.zeros_like();
        let absolute = tolerance.absolute.as_slice().iter();
        let least = absolute.fold(f64::INFINITY, |least, &x| least.min(x));
        let rows = rows(least + tolerance.relative);
        let parts = tolerance.absolute.as_slice().iter();
        let mut parts = parts.map(|absolute| part_for_all_sizes(*absolute, tolerance.relative));
        let first = parts.next().flatten();
        Self {
            coefficients: [(); 2].map(|()| std::vec![zeros.clone(); rows]),
            beginning: 0,
            is_taken: false,
            length: None,
            part: first.filter(|_| parts.all(|part| part == first)),
            memory: SeriesMemory::default(),
        }
    }

    /// The series with these coefficients, before a step.
    pub fn of(coefficients: &[V]) -> Self {
        Self {
            coefficients: [(); 2].map(|()| coefficients.to_vec()),
            beginning: 0,
            is_taken: false,
            length: None,
            part: None,
            memory: SeriesMemory::default(),
        }
    }

    /// The coefficients of the last step; before the first step, those of the start.
    pub fn of_step(&self) -> &[V] {
        &self.coefficients[self.beginning]
    }

    /// The coefficients of the motion through the present state.
    pub fn present_coefficients(&self) -> &[V] {
        &self.coefficients[self.of_now()]
    }

    fn of_now(&self) -> usize {
        if self.is_taken {
            1 - self.beginning
        } else {
            self.beginning
        }
    }

    /// Makes the present state the beginning of a step.
    pub fn begin(&mut self) {
        self.beginning = self.of_now();
        self.is_taken = false;
    }

    /// Accepts the step just tried.
    pub fn accept(&mut self) {
        self.is_taken = true;
        self.length = None;
    }

    /// Undoes the last step.
    pub fn retreat(&mut self) {
        self.is_taken = false;
        self.length = None;
    }

    /// Expands the motion through a state: the start, or with `ahead` the end of the step that is being tried.
    pub fn expand<S: System<Vector = V>>(
        &mut self,
        system: &S,
        at: &Point<V>,
        u: &S::Inputs,
        ahead: bool,
    ) -> Result<(), Singular> {
        let which = if ahead {
            1 - self.beginning
        } else {
            self.of_now()
        };
        self.length = None;
        let t = [at.t, at.t_low];
        let (state, memory) = ((&at.q, &at.v), &mut self.memory);
        system.series_with(memory, t, state, u, &mut self.coefficients[which])
    }

    /// The coefficients of the motion through the end of the step that is being tried, to be set.
    pub fn coefficients_ahead(&mut self) -> &mut [V] {
        self.length = None;
        &mut self.coefficients[1 - self.beginning]
    }

    /// The accelerations at the last expanded state: the present one, or with `ahead` the end of the step that is being tried.
    pub fn accelerations(&self, ahead: bool, a: &mut V) {
        let which = if ahead {
            1 - self.beginning
        } else {
            self.of_now()
        };
        let second = &self.coefficients[which][2];
        for (a, c) in a.as_mut_slice().iter_mut().zip(second.as_slice()) {
            *a = 2.0 * c;
        }
    }

    /// The length of a step whose last two terms are tolerable; infinite if the machine does not move.
    ///
    /// Two terms are needed because every second coefficient vanishes after a start at rest and at turning points. The truncation
    /// error is about `tolerable/(1 − h/R)`, with the radius of convergence `R`, which steps at coarse tolerances approach: there
    /// the bound is a tenth of the tolerance. At tolerances near the round-off of `f64` it is a hundredth, so that the truncation
    /// error stays below rounding and errors of steps do not add up with the same sign.
    pub fn length(&mut self, tolerance: &Tolerance<V>) -> f64 {
        let length = match self.length {
            Some(known) => known,
            None => self.tolerable_length(tolerance),
        };
        self.length = Some(length);
        length
    }

    fn tolerable_length(&self, tolerance: &Tolerance<V>) -> f64 {
        let coefficients = &self.coefficients[self.of_now()];
        let last = coefficients.len() - 1;
        let powers = [last - 1, last];
        let (q, v) = (coefficients[0].as_slice(), coefficients[1].as_slice());
        let rows = [
            coefficients[last - 1].as_slice(),
            coefficients[last].as_slice(),
        ];
        let usual = self
            .part
            .and_then(|part| usual_ratios([q, v], rows, powers, (tolerance, part)));
        let by_rates = match usual {
            Some([one, other]) => usual_lengths([[one], [other]], powers)[0],
            None => {
                let [mut one, mut other] = [0.0_f64; 2];
                for (i, absolute) in tolerance.absolute.as_slice().iter().enumerate() {
                    let over = 1.0 / bound(size_of_rate(q[i], v[i]), *absolute, tolerance.relative);
                    one = larger_ratio(one, rows[0][i], (last - 1) as f64, over);
                    other = larger_ratio(other, rows[1][i], last as f64, over);
                }
                length([one, other], powers)
            }
        };
        if !is_slow(by_rates, last) {
            return by_rates;
        }
        let absolute = tolerance.absolute.as_slice();
        let of = |i: usize| [q[i], v[i], rows[0][i], rows[1][i], absolute[i]];
        length_in_slow_motion(by_rates, last, (0..q.len()).map(of), tolerance.relative)
    }

    /// Goes to the end of a step of length `h`, as compensated sums; `to` is the end of the run, and whether the step ends there. Puts the
    /// accelerations by the series there into `a`. Returns whether the state is finite.
    pub fn advance(
        &self,
        h: f64,
        before: &Point<V>,
        now: &mut Point<V>,
        to: (f64, bool),
        a: &mut V,
    ) -> bool {
        now.set_time(before, h, (to.0, &[to.1]));
        let n = before.q.as_slice().len();
        let coefficients = self.of_step();
        in_registers!(n, |start, end| Advance {
            coefficients,
            h,
            before,
            now: &mut *now,
            a: &mut *a,
            start,
            end,
        })
    }
}

/// The largest ratios of both last terms of rates to their bounds, which are this part of the tolerable errors; `None` unless both are positive and finite.
/// The same arithmetic as with [`larger_ratio`], without branches.
#[inline(always)]
fn usual_ratios<V: Vector>(
    [q, v]: [&[f64]; 2],
    rows: [&[f64]; 2],
    powers: [usize; 2],
    (tolerance, part): (&Tolerance<V>, f64),
) -> Option<[f64; 2]> {
    let powers = powers.map(|power| power as f64);
    // The sum is not finite if a ratio is not; a maximum may lose it.
    let (mut worst, mut sum) = ([0.0_f64; 2], 0.0);
    for (i, absolute) in tolerance.absolute.as_slice().iter().enumerate() {
        let size = size_of_rate(q[i], v[i]);
        let over = 1.0 / (part * (absolute + tolerance.relative * size));
        for k in 0..2 {
            let ratio = (powers[k] * rows[k][i].abs()) * over;
            sum += ratio;
            worst[k] = larger(worst[k], ratio);
        }
    }
    (worst[0] > 0.0 && worst[1] > 0.0 && sum.is_finite()).then_some(worst)
}

/// Numbers that lie side by side in memory and fill a register.
trait Block: Copy {
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
struct Advance<'a, V> {
    coefficients: &'a [V],
    h: f64,
    before: &'a Point<V>,
    now: &'a mut Point<V>,
    a: &'a mut V,
    start: usize,
    end: usize,
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

/// The size of a rate in the bound on its last terms: that of a coordinate counts up to 1, so that a rate that is just 0 does not shorten the
/// step. A coordinate may be far larger than its rate, such as an angle after many turns or the radius of a planet's orbit.
#[inline(always)]
pub(crate) fn size_of_rate(q: f64, v: f64) -> f64 {
    let of_coordinate = if q.abs() < 1.0 { q.abs() } else { 1.0 };
    // Its own where the rate is not a number.
    larger(of_coordinate, v.abs())
}

/// Whether the coordinates limit a step, too, whose length follows from the rates and whose last power of time is `last`. The last terms of a
/// coordinate are those of its rate times `h/j`, so in shorter steps they are smaller.
#[inline(always)]
pub(crate) fn is_slow(by_rates: f64, last: usize) -> bool {
    by_rates > (last - 1) as f64 && by_rates.is_finite()
}

/// The length of a step in which the last terms of coordinates are tolerable as well, for a step [that is slow](is_slow). Of each coordinate it
/// takes `[q, v, c₍last−1₎, c₍last₎, absolute tolerance]`. Its size is that within the step.
#[cold]
pub(crate) fn length_in_slow_motion(
    by_rates: f64,
    last: usize,
    coordinates: impl Iterator<Item = [f64; 5]>,
    relative: f64,
) -> f64 {
    let mut worst = [0.0_f64; 2];
    for [q, v, one, other, absolute] in coordinates {
        let size = q.abs() + v.abs() * by_rates;
        let over = 1.0 / bound(size, absolute, relative);
        worst = [
            larger_ratio(worst[0], one, 1.0, over),
            larger_ratio(worst[1], other, 1.0, over),
        ];
    }
    // The terms of rates have one power less, and so have those that `length` expects.
    length(worst, [last, last + 1]).min(by_rates)
}

/// How far the accelerations at the end of a step of length `h` are from others there, times `h`, relative to the bound on the last terms
/// of the step. Of each coordinate it takes the size of its rate, its acceleration, the difference of the other one, and the absolute tolerance. The
/// fraction `rounding` of the acceleration does not count, nor does what is not a number.
///
/// A root of squares, such as a distance or a speed, may pass zero along the motion: its series continues with the other sign, and no
/// coefficient tells. The accelerations at the end of the step do.
pub(crate) fn defect(
    h: f64,
    coordinates: impl Iterator<Item = [f64; 4]>,
    [relative, rounding]: [f64; 2],
) -> f64 {
    let defects = coordinates.map(|[size, acceleration, difference, absolute]| {
        let counted = difference.abs() - rounding * acceleration.abs();
        counted * h.abs() / bound(size, absolute, relative)
    });
    defects.fold(0.0, f64::max)
}

/// Moves each number of a state to the next one, up and down in turns: by how much a quantity changes shows its round-off.
pub(crate) fn move_to_neighbours<V: Vector>(q: &mut V, v: &mut V) {
    let numbers = q.as_mut_slice().iter_mut().chain(v.as_mut_slice());
    for (i, x) in numbers.enumerate() {
        *x = if i % 2 == 0 {
            x.next_up()
        } else {
            x.next_down()
        };
    }
}

/// The bound on the last terms of a step, for a coordinate or a rate of this size: a tenth of the tolerance from 1e-8 on, and a hundredth
/// below 1e-14.
#[inline(always)]
pub(crate) fn bound(size: f64, absolute: f64, relative: f64) -> f64 {
    let tolerable = absolute + relative * size;
    match 1.0 + size {
        // Not at round numbers, which tolerances are: there the rounding of these sums would decide.
        whole if tolerable > 0.5e-8 * whole => 0.1 * tolerable,
        whole if tolerable < 0.5e-14 * whole => 0.01 * tolerable,
        _ => tolerable,
    }
}

/// The part of the tolerable error that is the [`bound`], if it is the same for numbers of every size: neither tolerance is at one of the limits, where
/// rounding decides.
pub(crate) fn part_for_all_sizes(absolute: f64, relative: f64) -> Option<f64> {
    let part = |tolerance: f64| {
        let is_within = |low: f64, high: f64| low < tolerance && tolerance < high;
        if is_within(0.500_001e-8, f64::INFINITY) {
            Some(0.1)
        } else if is_within(0.500_001e-14, 0.499_999e-8) {
            Some(1.0)
        } else if is_within(1e-200, 0.499_999e-14) {
            Some(0.01)
        } else {
            None
        }
    };
    let found = part(absolute);
    found.filter(|_| part(relative) == found)
}

/// The larger of `worst` and a term's size over its bound; the term is that of the rate, v = Σ (j + 1) cⱼ₊₁ τʲ, in a step of 1 s.
#[inline(always)]
pub(crate) fn larger_ratio(worst: f64, c: f64, j: f64, over_bound: f64) -> f64 {
    let ratio = if c == 0.0 {
        0.0
    } else {
        (j * c.abs()) * over_bound
    };
    // NaN must not count as zero.
    if ratio > worst || ratio.is_nan() {
        ratio
    } else {
        worst
    }
}

/// The power of the size of a rate's term, in a step of 1 s, that the tolerable length of a step is, for this power of the time in the coordinate's
/// term. Known before the series is, so that its division delays nothing.
#[inline(always)]
fn exponent(j: usize) -> f64 {
    1.0 / (1.0 - j as f64)
}

/// The length of a step in which the terms of these two powers are at most their bounds, from their values in a step of 1 s;
/// infinite if both are 0.
#[inline(always)]
pub(crate) fn length(worst: [f64; 2], powers: [usize; 2]) -> f64 {
    // The logarithm of the length.
    let mut length = f64::INFINITY;
    for (worst, j) in worst.into_iter().zip(powers) {
        if worst == f64::INFINITY {
            return 0.0;
        } else if worst > 0.0 {
            length = length.min(rough_log2(worst) * exponent(j));
        } else if worst.is_nan() {
            return f64::NAN;
        }
    }
    match length {
        f64::INFINITY => length,
        _ => rough_exp2(length),
    }
}

/// [`length`] of several steps whose terms are positive and finite: the same arithmetic without branches. In a loop for each function, the compiler puts
/// all of them into one register.
#[inline(always)]
pub(crate) fn usual_lengths<const W: usize>(
    [mut one, mut other]: [[f64; W]; 2],
    powers: [usize; 2],
) -> [f64; W] {
    for one in &mut one {
        *one = rough_log2(*one) * exponent(powers[0]);
    }
    for other in &mut other {
        *other = rough_log2(*other) * exponent(powers[1]);
    }
    for (one, other) in one.iter_mut().zip(other) {
        *one = if *one < other { *one } else { other };
    }
    for one in &mut one {
        *one = rough_exp2(*one);
    }
    one
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

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use lagrangian_scalar::{DoubleDouble, Scalar};

    use super::{Taylor, bound, part_for_all_sizes, state_with_accelerations};
    use crate::stages::Point;

    /// The sum of terms in double-double, and the sum of their sizes.
    fn sum(terms: impl Iterator<Item = DoubleDouble>) -> [f64; 2] {
        let (mut sum, mut size) = (DoubleDouble::ZERO, 0.0);
        for term in terms {
            sum = sum + term;
            size += term.to_f64().abs();
        }
        [sum.to_f64(), size]
    }

    #[test]
    fn the_bound_does_not_depend_on_the_rounding_of_sizes() {
        for (tolerance, part) in [
            (1e-7, 0.1),
            (1e-8, 0.1),
            (1e-9, 1.0),
            (1e-14, 1.0),
            (3e-15, 0.01),
        ] {
            for k in 0..1000 {
                let size = 0.01 * f64::from(k);
                let expected = part * (tolerance + tolerance * size);
                assert_eq!(bound(size, tolerance, tolerance), expected);
            }
            assert_eq!(part_for_all_sizes(tolerance, tolerance), Some(part));
        }
        let at_limits = [[0.5e-8; 2], [0.5e-14; 2], [1e-15, 1e-14], [1e-7, 1e-9]];
        for [absolute, relative] in at_limits {
            assert_eq!(part_for_all_sizes(absolute, relative), None);
        }
    }

    #[test]
    fn steps_of_every_order_end_where_their_polynomials_do() {
        // Blocks of four, of two and of one coordinate.
        steps_end_where_their_polynomials_do::<3>();
        steps_end_where_their_polynomials_do::<5>();
        steps_end_where_their_polynomials_do::<6>();
        steps_end_where_their_polynomials_do::<7>();
    }

    /// With each remainder of the order divided by four.
    fn steps_end_where_their_polynomials_do<const N: usize>() {
        let h = 0.7;
        for rows in 3..=24 {
            let number = |j: usize, i: usize| (1.0 + (j * N + i) as f64 * 0.618).sin();
            let coefficients: Vec<[f64; N]> = (0..rows)
                .map(|j| std::array::from_fn(|i| number(j, i)))
                .collect();
            let taylor = Taylor::of(&coefficients);
            let before = Point::new(0.0, coefficients[0], coefficients[1]);
            let (mut now, mut a) = (before.clone(), [0.0; N]);
            assert!(taylor.advance(h, &before, &mut now, (1.0, false), &mut a));
            let mut there = [[0.0; N]; 3];
            let [q_there, v_there, a_there] = &mut there;
            state_with_accelerations(&coefficients, h, [q_there, v_there, a_there]);
            for (i, a) in a.into_iter().enumerate() {
                let term = |j: usize, derivative: usize| {
                    let factor: f64 = (0..derivative).map(|d| j as f64 - d as f64).product();
                    let c = DoubleDouble::from_f64(coefficients[j][i]);
                    let power = DoubleDouble::from_f64(h).powi(j as i32 - derivative as i32);
                    c * power * DoubleDouble::from_f64(factor)
                };
                let found = [[now.q[i], now.q_low[i]], [now.v[i], now.v_low[i]], [a, 0.0]];
                let others = there.map(|of| [of[i], 0.0]);
                let all = found
                    .into_iter()
                    .enumerate()
                    .chain(others.into_iter().enumerate());
                for (derivative, [high, low]) in all {
                    let [exact, size] = sum((derivative..rows).map(|j| term(j, derivative)));
                    // A term is rounded up to 20 times, with its weight, its powers of `h` and the sums that contain it, by half an epsilon each.
                    let error = (high + low - exact).abs();
                    assert!(
                        error <= 10.0 * f64::EPSILON * size,
                        "{rows} {i} {derivative}: {error:e}"
                    );
                }
            }
            // Not finite in one block alone.
            for i in 0..N {
                let mut broken = coefficients.clone();
                broken[rows - 1][i] = f64::INFINITY;
                let taylor = Taylor::of(&broken);
                assert!(!taylor.advance(h, &before, &mut now, (1.0, false), &mut a));
            }
        }
    }
}
