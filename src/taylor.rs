//! Steps by Taylor series.
//!
//! The motion through the beginning of a step is a polynomial `q(τ) = Σ cⱼ τʲ`, whose coefficients a machine computes
//! ([`System::series`]). A step evaluates it at its end, and dense output and events evaluate it between its ends without
//! further evaluations of the machine. The length of a step follows from the last two coefficients before the step is taken. A step is
//! rejected only if the motion is not its series at the end ([`defect`]).
//!
//! State and time are compensated sums: an increment of the state is rounded once, and the rounding error is kept (N. J. Higham,
//! *Accuracy and Stability of Numerical Algorithms*, 2nd ed., 2002, section 4.3).

use std::vec::Vec;

use crate::compensated::two_sum;
use crate::math::{rough_exp2, rough_log2};
use crate::stages::{Point, in_blocks};
use crate::tolerance::Tolerance;
use crate::{Real, Scalar, Singular, System, Vector};

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
}

impl<V: Vector> Taylor<V> {
    /// Memory for a series of the order that a tolerance requires.
    pub fn new(tolerance: &Tolerance<V>) -> Self {
        let zeros = tolerance.absolute.zeros_like();
        let absolute = tolerance.absolute.as_slice().iter();
        let least = absolute.fold(f64::INFINITY, |least, &x| least.min(x));
        let rows = rows(least + tolerance.relative);
        Self {
            coefficients: [(); 2].map(|()| std::vec![zeros.clone(); rows]),
            beginning: 0,
            is_taken: false,
            length: None,
        }
    }

    /// The series with these coefficients, before a step.
    pub fn of(coefficients: &[V]) -> Self {
        Self {
            coefficients: [(); 2].map(|()| coefficients.to_vec()),
            beginning: 0,
            is_taken: false,
            length: None,
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
        system.series(t, &at.q, &at.v, u, &mut self.coefficients[which])
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
        let mut worst = [0.0_f64; 2];
        let (q, v) = (coefficients[0].as_slice(), coefficients[1].as_slice());
        let rows = powers.map(|j| coefficients[j].as_slice());
        for (i, absolute) in tolerance.absolute.as_slice().iter().enumerate() {
            let over = 1.0 / bound(size_of_rate(q[i], v[i]), *absolute, tolerance.relative);
            for (worst, (row, j)) in worst.iter_mut().zip(rows.iter().zip(powers)) {
                *worst = larger_ratio(*worst, row[i], j as f64, over);
            }
        }
        let by_rates = length(worst, powers);
        if !is_slow(by_rates, last) {
            return by_rates;
        }
        let absolute = tolerance.absolute.as_slice();
        let of = |i: usize| [q[i], v[i], rows[0][i], rows[1][i], absolute[i]];
        length_in_slow_motion(by_rates, last, (0..q.len()).map(of), tolerance.relative)
    }

    /// The state at the end of a step of length `h`, as compensated sums.
    pub fn advance(&self, h: f64, before: &Point<V>, now: &mut Point<V>) {
        let coefficients = self.of_step();
        in_blocks!(before.q.as_slice().len(), |start, B| {
            let [q, v] = increments::<B, f64>(&Rows(coefficients), start, h);
            for k in 0..B {
                let i = start + k;
                let low = before.v_low.as_slice()[i];
                let q_low = before.q_low.as_slice()[i] + h * low;
                (now.q.as_mut_slice()[i], now.q_low.as_mut_slice()[i]) =
                    two_sum(before.q.as_slice()[i], q_low + q[k]);
                (now.v.as_mut_slice()[i], now.v_low.as_mut_slice()[i]) =
                    two_sum(before.v.as_slice()[i], low + v[k]);
            }
        });
    }
}

/// The size of a rate in the bound on its last terms: that of a coordinate counts up to 1, so that a rate that is just 0 does not shorten the
/// step. A coordinate may be far larger than its rate, such as an angle after many turns or the radius of a planet's orbit.
#[inline(always)]
pub(crate) fn size_of_rate(q: f64, v: f64) -> f64 {
    v.abs().max(q.abs().min(1.0))
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

/// The bound on the last terms of a step, for a coordinate or a rate of this size.
#[inline(always)]
pub(crate) fn bound(size: f64, absolute: f64, relative: f64) -> f64 {
    let tolerable = absolute + relative * size;
    match 1.0 + size {
        whole if tolerable > 1e-8 * whole => 0.1 * tolerable,
        whole if tolerable < 1e-14 * whole => 0.01 * tolerable,
        _ => tolerable,
    }
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
            length = length.min(rough_log2(worst) / (1.0 - j as f64));
        } else if worst.is_nan() {
            return f64::NAN;
        }
    }
    match length {
        f64::INFINITY => length,
        _ => rough_exp2(length),
    }
}

/// [`length`] for two terms that are positive and finite: the same arithmetic without branches, for several at once.
#[inline(always)]
pub(crate) fn usual_length(worst: [f64; 2], powers: [usize; 2]) -> f64 {
    let one = rough_log2(worst[0]) / (1.0 - powers[0] as f64);
    let other = rough_log2(worst[1]) / (1.0 - powers[1] as f64);
    rough_exp2(if one < other { one } else { other })
}

/// Access to the coefficients of coordinates for [`increments`].
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

/// Adds one term by Horner's rule.
#[inline(always)]
fn add_term<const B: usize, N: Scalar>(
    coefficients: &impl Coefficients<N>,
    [j, start]: [usize; 2],
    square: N,
    q: &mut [N; B],
    v: &mut [N; B],
) {
    let (row, power) = (coefficients.block::<B>(j, start), N::from_f64(j as f64));
    for k in 0..B {
        q[k] = q[k] * square + row[k];
        v[k] = v[k] * square + power * row[k];
    }
}

/// The changes of `B` coordinates from `start` on, and of their rates, in a time `tau`. They are computed side by side so that the
/// processor can work on several sums at once.
#[inline(always)]
pub(crate) fn increments<const B: usize, N: Scalar>(
    coefficients: &impl Coefficients<N>,
    start: usize,
    tau: N,
) -> [[N; B]; 2] {
    // Terms of even and of odd powers, each by Horner's rule, so that the two sums are independent of each other.
    let zeros = [N::ZERO; B];
    let (mut q, mut v) = ([zeros; 2], [zeros; 2]);
    let square = tau * tau;
    let mut end = coefficients.count();
    if end % 2 == 1 {
        end -= 1;
        add_term(coefficients, [end, start], square, &mut q[0], &mut v[0]);
    }
    let ([q_even, q_odd], [v_even, v_odd]) = (&mut q, &mut v);
    while end > 2 {
        end -= 2;
        add_term(coefficients, [end + 1, start], square, q_odd, v_odd);
        add_term(coefficients, [end, start], square, q_even, v_even);
    }
    let first = coefficients.block::<B>(1, start);
    let (mut by_q, mut by_v) = (zeros, zeros);
    for k in 0..B {
        by_q[k] = (first[k] + (q[0][k] + q[1][k] * tau) * tau) * tau;
        by_v[k] = (v[0][k] + v[1][k] * tau) * tau;
    }
    [by_q, by_v]
}

/// Coordinates and rates at a time `tau` after the state that was expanded.
pub(crate) fn state<N: Real, V: Vector<N>>(coefficients: &[V], tau: N) -> (V, V) {
    let (mut q, mut v) = (coefficients[0].clone(), coefficients[1].clone());
    in_blocks!(q.as_slice().len(), |start, B| {
        let [by_q, by_v] = increments::<B, N>(&Rows(coefficients), start, tau);
        for k in 0..B {
            let i = start + k;
            q.as_mut_slice()[i] = q.as_slice()[i] + by_q[k];
            v.as_mut_slice()[i] = v.as_slice()[i] + by_v[k];
        }
    });
    (q, v)
}

/// The accelerations at a time `tau` after the state that was expanded.
pub(crate) fn accelerations<V: Vector>(coefficients: &[V], tau: f64, a: &mut V) {
    for (i, a) in a.as_mut_slice().iter_mut().enumerate() {
        *a = 0.0;
        for j in (2..coefficients.len()).rev() {
            *a = *a * tau + (j * (j - 1)) as f64 * coefficients[j].as_slice()[i];
        }
    }
}
