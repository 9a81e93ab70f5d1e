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
mod length;
mod motion;

use std::vec::Vec;

use crate::series_memory::SeriesMemory;
use crate::stages::Point;
use crate::tolerance::Tolerance;
use crate::{ContactMode, StepError, System, Vector};
pub(crate) use bounds::MotionBounds;
use length::usual_ratios;
pub(crate) use length::{
    bound, is_slow, larger_ratio, length, length_in_slow_motion, part_for_all_sizes, size_of_rate,
    usual_lengths,
};
use motion::{Advance, in_registers};
pub(crate) use motion::{Coefficients, accelerations, motion, state, state_with_accelerations};

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

/// From this sum of both tolerances down the higher order costs less time: the cost of products of series grows with the square of the order, the
/// rest of a step with the order itself, but at fine tolerances the gain in step length is larger. At a sum of 2e-5 it takes 0.59 to 0.99 of the time on all
/// machines of the bench but the six-joint arm; at 2e-4 it takes more on a third of them, and most errors are larger (`docs/benchmarks.md`).
pub(crate) const FINE: f64 = 3e-5;

/// The number of coefficients of a coordinate for the sum of the relative and the smallest absolute tolerance.
pub(crate) fn rows(tolerance: f64) -> usize {
    ORDERS[usize::from(tolerance <= FINE)] + 2
}

/// What contacts do of which at least one is closed, and the [directions](System::closed_series) in which they hold only because others do.
pub(crate) type ClosedContacts<'c> = (&'c [ContactMode], Vec<usize>);

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

    /// Expands the motion through a state: the start, or with `ahead` the end of the step that is being tried. The contacts are given if one of them is closed, with
    /// [the directions that depend on others](System::closed_series).
    ///
    /// # Errors
    /// If the motion has no series, or its equations are singular at this state.
    pub fn expand<S: System<Vector = V>>(
        &mut self,
        (system, closed): (&S, Option<ClosedContacts<'_>>),
        at: &Point<V>,
        u: &S::Inputs,
        ahead: bool,
    ) -> Result<(), StepError> {
        let which = if ahead {
            1 - self.beginning
        } else {
            self.of_now()
        };
        self.length = None;
        let t = [at.t, at.t_low];
        let (state, memory) = ((&at.q, &at.v), &mut self.memory);
        let coefficients = &mut self.coefficients[which];
        let expanded = match closed {
            Some((contacts, dependent)) if S::MAY_COLLIDE => {
                system.closed_series((contacts, &dependent), t, state, u, coefficients)
            }
            _ => Some(system.series_with(memory, t, state, u, coefficients)),
        };
        let expanded = expanded.ok_or(StepError::NoSeries {
            inputs: false,
            t: at.t,
        })?;
        expanded.map_err(|singular| StepError::Singular { singular, t: at.t })
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

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use lagrangian_scalar::{DoubleDouble, Scalar};

    use super::{Taylor, state_with_accelerations};
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
