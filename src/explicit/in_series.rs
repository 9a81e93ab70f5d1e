//! Steps by Taylor series of several trajectories at once, with the bits of a [`Stepper`](crate::Stepper).
//!
//! All lanes are expanded together at the ends of the steps that they attempt. A lane keeps the coefficients at the beginning of
//! its step until an attempt is good. A lane that has just received a trajectory has no coefficients yet: its first attempt is a step
//! of length zero.

use std::boxed::Box;
use std::vec::Vec;

use lagrangian_native::Lanes;

use super::{Outcome, choose, choose_point};
use crate::attempt::{are_finite, not_finite};
use crate::compensated::two_sum;
use crate::control::{self, Control, Work};
use crate::scalar::Kernel;
use crate::stages::{Point, in_blocks};
use crate::step_error::StepError;
use crate::taylor::{self, Coefficients};
use crate::tolerance::Tolerance;
use crate::{Batch, Batched, LaneVector, Method, Scalar, Vector};

/// State of one trajectory.
#[derive(Clone, Copy, Debug)]
struct Lane {
    /// Whether it continues.
    is_running: bool,
    /// Whether it has the coefficients of its motion through the present state.
    is_expanded: bool,
    /// The length of a step from here whose error is tolerable.
    length: f64,
    control: Control,
}

/// Trajectories in parallel. `L` is the working memory of the machine for their expansion, which is cleared once.
pub(super) struct InSeries<V, L, const W: usize> {
    tolerance: Tolerance<V>,
    /// The [part](taylor::part_for_all_sizes) of a tolerable error that is the bound on the last terms of a step.
    part: Option<f64>,
    longest: f64,
    end: Lanes<W>,
    now: Point<V, Lanes<W>>,
    ahead: Point<V, Lanes<W>>,
    /// The coefficients of the motion through the present states, and through the ends of the steps that are attempted.
    coefficients: [Vec<V>; 2],
    lists: Box<L>,
    lanes: [Lane; W],
}

impl<V: LaneVector<W>, L: Default, const W: usize> InSeries<V, L, W> {
    /// Trajectories that do not move. `tolerance` is relative, and absolute in every coordinate.
    pub fn resting(tolerance: f64, longest: f64, now: Point<V, Lanes<W>>) -> Self {
        let relative = tolerance.max(10.0 * f64::EPSILON);
        let mut absolute = V::ZEROS;
        absolute.as_mut().fill(Lanes::splat(tolerance));
        let rows = taylor::rows(relative + tolerance);
        Self {
            tolerance: Tolerance { relative, absolute },
            part: taylor::part_for_all_sizes(tolerance, relative),
            longest: control::longest_step_or_infinity(longest),
            end: now.t,
            ahead: now.clone(),
            now,
            coefficients: [(); 2].map(|()| std::vec![V::ZEROS; rows]),
            lists: Box::default(),
            lanes: [Lane {
                is_running: false,
                is_expanded: false,
                length: 0.0,
                control: Control::new(),
            }; W],
        }
    }

    /// Starts the trajectory of a lane at its present state towards `end`. `work` was already done for it.
    pub fn begin(&mut self, lane: usize, end: f64, work: Work) {
        self.end[lane] = end;
        self.lanes[lane] = Lane {
            is_running: true,
            is_expanded: false,
            length: 0.0,
            control: Control {
                work,
                ..Control::new()
            },
        };
    }

    pub fn now(&self) -> &Point<V, Lanes<W>> {
        &self.now
    }

    pub fn now_mut(&mut self) -> &mut Point<V, Lanes<W>> {
        &mut self.now
    }

    pub fn is_done(&self, lane: usize) -> bool {
        self.now.t[lane] == self.end[lane]
    }

    pub fn work(&self, lane: usize) -> Work {
        self.lanes[lane].control.work
    }

    pub fn stop(&mut self, lane: usize) {
        self.lanes[lane].is_running = false;
    }

    /// The number of trajectories under way.
    pub fn count(&self) -> usize {
        self.lanes.iter().filter(|lane| lane.is_running).count()
    }

    /// One attempt at a step of every trajectory that is not at its end.
    pub fn attempt<S: Batched<W, Vectors = V, SeriesLists = L>>(
        &mut self,
        batch: &Batch<S, W>,
        inputs: &S::BatchInputs,
    ) -> [Outcome; W] {
        let mut outcomes = [Outcome::Idle; W];
        let (h, is_last) = self.choose_lengths(&mut outcomes);
        let stays = self.lanes.map(|lane| !lane.is_running || !lane.is_expanded);
        let fine = V::run(Advance {
            coefficients: &self.coefficients[0],
            now: &self.now,
            h,
            to: (self.end, &is_last),
            stays: &stays,
            ahead: &mut self.ahead,
        });

        let mut failed = [None; W];
        if fine.contains(&false) {
            for (lane, failed) in failed.iter_mut().enumerate() {
                *failed = not_finite(&self.ahead.q, &self.ahead.v, lane)
                    .map(|coordinate| self.not_finite(coordinate, lane));
            }
            // NaN must not disturb the other lanes.
            choose_point(&fine.map(|fine| !fine), &mut self.ahead, &self.now);
        }
        self.expand(batch, inputs, &mut failed);
        let mut is_off = [false; W];
        if batch.system(0).series_may_branch() {
            for (lane, is_off) in is_off.iter_mut().enumerate() {
                let is_step = self.lanes[lane].is_running && self.lanes[lane].is_expanded;
                if is_step && failed[lane].is_none() {
                    *is_off = self.is_off(batch, inputs, (lane, h[lane]));
                }
            }
        }

        let mut stays = [false; W];
        for lane in 0..W {
            if self.lanes[lane].is_running {
                outcomes[lane] = if is_off[lane] {
                    self.retry(lane, h[lane])
                } else {
                    self.decide(lane, h[lane], failed[lane])
                };
                stays[lane] = failed[lane].is_some() || is_off[lane];
            }
        }
        let [now, next] = &mut self.coefficients;
        if stays.contains(&true) {
            choose_point(&stays, &mut self.ahead, &self.now);
            for (next, now) in next.iter_mut().zip(now.iter()) {
                choose(&stays, next, now);
            }
        }
        core::mem::swap(now, next);
        core::mem::swap(&mut self.now, &mut self.ahead);
        let lengths = V::run(Lengths {
            coefficients: &self.coefficients[0],
            tolerance: &self.tolerance,
            part: self.part,
        });
        for (lane, length) in self.lanes.iter_mut().zip(lengths) {
            lane.length = length;
        }
        outcomes
    }

    fn not_finite(&self, coordinate: usize, lane: usize) -> StepError {
        StepError::NotFinite {
            coordinate,
            t: self.ahead.t[lane],
        }
    }

    /// The lengths of the next steps, 0 for trajectories that take none, and whether they would be the last ones.
    fn choose_lengths(&mut self, outcomes: &mut [Outcome; W]) -> (Lanes<W>, [bool; W]) {
        let mut lengths = Lanes::splat(0.0);
        let mut is_last = [false; W];
        for (i, outcome) in outcomes.iter_mut().enumerate() {
            let lane = &mut self.lanes[i];
            if !lane.is_running || !lane.is_expanded {
                continue;
            }
            let (t, end) = (self.now.t[i], self.end[i]);
            let left = (end - t) - self.now.t_low[i];
            let control = &mut lane.control;
            if !control.is_retry {
                let length = lane.length.min(self.longest);
                if lane.length.is_nan() {
                    lane.is_running = false;
                    let rows = self.coefficients[0].iter();
                    let coordinate = rows.filter_map(|row| not_finite(row, row, i)).next();
                    let coordinate = coordinate.unwrap_or(0);
                    *outcome = Outcome::Failed(StepError::NotFinite { coordinate, t });
                    continue;
                }
                // If the machine does not move, a step is as long as the run.
                control.step = length.min((end - t).abs()).copysign(end - t);
                if control.is_too_small(control::shortest_step::<f64>(t), left) {
                    lane.is_running = false;
                    *outcome = Outcome::Failed(StepError::StepTooSmall {
                        coordinate: 0,
                        t,
                        step: control.last_step,
                    });
                    continue;
                }
            }
            is_last[i] = control.is_last(left, self.longest);
            lengths[i] = if is_last[i] { left } else { control.step };
            control.last_step = lengths[i];
        }
        (lengths, is_last)
    }

    /// Expands the motions through `ahead` in the lanes that have not `failed`.
    fn expand<S: Batched<W, Vectors = V, SeriesLists = L>>(
        &mut self,
        batch: &Batch<S, W>,
        inputs: &S::BatchInputs,
        failed: &mut [Option<StepError>; W],
    ) {
        for (lane, failed) in self.lanes.iter_mut().zip(&*failed) {
            let is_step = lane.is_running && lane.is_expanded && failed.is_none();
            lane.control.work.evaluations += usize::from(is_step);
        }
        let at = &self.ahead;
        let t = [at.t, at.t_low];
        let [_, coefficients] = &mut self.coefficients;
        let result = batch.series(t, &at.q, &at.v, inputs, &mut self.lists, coefficients);
        if let Err(some) = result {
            for (lane, failed) in failed.iter_mut().enumerate() {
                let t = self.ahead.t[lane];
                let singular = some.lanes[lane];
                *failed = failed.or(singular.map(|singular| StepError::Singular { singular, t }));
            }
        }
        let mut accelerations = self.coefficients[1][2];
        for a in accelerations.as_mut() {
            *a = Lanes::splat(2.0) * *a;
        }
        if are_finite(&accelerations, &accelerations).contains(&false) {
            for (lane, failed) in failed.iter_mut().enumerate() {
                let coordinate = not_finite(&accelerations, &accelerations, lane);
                let error = coordinate.map(|coordinate| self.not_finite(coordinate, lane));
                *failed = failed.or(error);
            }
        }
    }

    /// Whether the motion of a lane is not its series at the end of a step of length `h`, which was expanded there: as for a single run.
    fn is_off<S: Batched<W, Vectors = V, SeriesLists = L>>(
        &mut self,
        batch: &Batch<S, W>,
        inputs: &S::BatchInputs,
        (lane, h): (usize, f64),
    ) -> bool {
        let [now, next] = &self.coefficients;
        let size = |i: usize| {
            let of = |row: &[V]| {
                taylor::size_of_rate(row[0].as_ref()[i][lane], row[1].as_ref()[i][lane])
            };
            of(now).max(of(next))
        };
        let absolute = |i: usize| self.tolerance.absolute.as_ref()[i][lane];
        let at_end = |i: usize| 2.0 * next[2].as_ref()[i][lane];
        let by_series = |i: usize| {
            let powers = (2..now.len()).rev();
            powers.fold(0.0, |sum, j| {
                sum * h + (j * (j - 1)) as f64 * now[j].as_ref()[i][lane]
            })
        };
        let defect_to = |other: &dyn Fn(usize) -> f64, rounding: f64| {
            let coordinates = 0..next[2].as_ref().len();
            let coordinates =
                coordinates.map(|i| [size(i), at_end(i), at_end(i) - other(i), absolute(i)]);
            taylor::defect(h, coordinates, [self.tolerance.relative, rounding])
        };
        let t = self.ahead.t[lane];
        let found = defect_to(&by_series, taylor::ROUNDING_UNITS * f64::EPSILON);
        let shortest = taylor::SHORTEST_STEPS * control::shortest_step::<f64>(t);
        if !(found > taylor::GREATEST_DEFECT && h.abs() > shortest) {
            return false;
        }
        // Round-off may change the accelerations as much, where large forces cancel.
        let [mut q, mut v] = [&self.ahead.q, &self.ahead.v].map(|of| {
            let mut own = S::Vector::zeros(of.as_ref().len());
            let numbers = own.as_mut_slice().iter_mut().zip(of.as_ref());
            numbers.for_each(|(own, lanes)| *own = lanes[lane]);
            own
        });
        taylor::move_to_neighbours(&mut q, &mut v);
        let own = S::inputs_of_lane(inputs, lane);
        let mut rows = std::vec![q.zeros_like(); 3];
        let t = [t, self.ahead.t_low[lane]];
        let expanded = batch.system(lane).series(t, &q, &v, &own, &mut rows);
        let changed = defect_to(&|i| 2.0 * rows[2].as_slice()[i], 0.0);
        self.lanes[lane].control.work.evaluations += 1;
        if expanded.is_ok() && found > taylor::ROUNDINGS * changed {
            return true;
        }
        // The end itself is not expanded again, as a single run has to: its counts are the same.
        self.lanes[lane].control.work.evaluations += 1;
        false
    }

    /// Has a lane attempt a shorter step, since the motion is not its series at the end of this one.
    fn retry(&mut self, i: usize, h: f64) -> Outcome {
        let (lane, t) = (&mut self.lanes[i], self.now.t[i]);
        let is_first = lane.control.is_first;
        let shorter = h * control::reduction(Method::TAYLOR, f64::INFINITY, is_first);
        let least = control::shortest_step::<f64>(t);
        if lane.control.reject(shorter, least) {
            return Outcome::GivenUp;
        }
        lane.is_running = false;
        Outcome::Failed(StepError::StepTooSmall {
            coordinate: 0,
            t,
            step: h,
        })
    }

    /// Decides about an attempt at a step.
    fn decide(&mut self, i: usize, h: f64, cause: Option<StepError>) -> Outcome {
        let lane = &mut self.lanes[i];
        let Some(cause) = cause else {
            if !lane.is_expanded {
                lane.is_expanded = true;
                return Outcome::Idle;
            }
            lane.control.accept(h, 0.0, 1.0);
            lane.is_running = self.ahead.t[i] != self.end[i];
            return Outcome::Taken;
        };
        // The step may have left the set of states in which the machine can be.
        let least = control::shortest_step::<f64>(self.now.t[i]);
        if lane.is_expanded && lane.control.reject(0.1 * h, least) {
            return Outcome::GivenUp;
        }
        lane.is_running = false;
        Outcome::Failed(cause)
    }
}

/// The coefficients of all lanes.
struct Rows<'a, V>(&'a [V]);

impl<N: Scalar<Stored = Lanes<W>>, V: LaneVector<W>, const W: usize> Coefficients<N>
    for Rows<'_, V>
{
    #[inline(always)]
    fn count(&self) -> usize {
        self.0.len()
    }

    #[inline(always)]
    fn block<const B: usize>(&self, j: usize, start: usize) -> [N; B] {
        let row = &self.0[j].as_ref()[start..start + B];
        let mut block = [N::ZERO; B];
        for (number, lanes) in block.iter_mut().zip(row) {
            *number = N::load(*lanes);
        }
        block
    }
}

/// Computes the states at the ends of steps of length `h` as compensated sums, except in lanes that stay. Returns whether each of
/// them is finite.
struct Advance<'a, V, const W: usize> {
    coefficients: &'a [V],
    now: &'a Point<V, Lanes<W>>,
    h: Lanes<W>,
    /// The ends of the trajectories, and which of them are reached by this step.
    to: (Lanes<W>, &'a [bool; W]),
    stays: &'a [bool; W],
    ahead: &'a mut Point<V, Lanes<W>>,
}

impl<V: LaneVector<W>, const W: usize> Kernel<Lanes<W>> for Advance<'_, V, W> {
    type Output = [bool; W];

    #[inline(always)]
    fn run<N: Scalar<Stored = Lanes<W>>>(self) -> [bool; W] {
        let Self {
            coefficients,
            now,
            h,
            to,
            stays,
            ahead,
        } = self;
        ahead.set_time(now, h, to);
        let h = N::load(h);
        in_blocks!(now.q.as_ref().len(), |start, B| {
            let [q, v] = taylor::motion::<B, 2, N>(&Rows(coefficients), start, h);
            for k in 0..B {
                let i = start + k;
                let low = N::load(now.v_low.as_ref()[i]);
                let q_low = N::load(now.q_low.as_ref()[i]) + h * low;
                let (high, rest) = two_sum(N::load(now.q.as_ref()[i]), q_low + q[k]);
                ahead.q.as_mut()[i] = high.store();
                ahead.q_low.as_mut()[i] = rest.store();
                let (high, rest) = two_sum(N::load(now.v.as_ref()[i]), low + v[k]);
                ahead.v.as_mut()[i] = high.store();
                ahead.v_low.as_mut()[i] = rest.store();
            }
        });
        let mut some_stay = false;
        for stays in stays {
            some_stay |= *stays;
        }
        if some_stay {
            choose_point(stays, ahead, now);
        }
        are_finite(&ahead.q, &ahead.v)
    }
}

/// For each trajectory the length of a step whose error is tolerable.
struct Lengths<'a, V, const W: usize> {
    coefficients: &'a [V],
    tolerance: &'a Tolerance<V>,
    /// The [part](taylor::part_for_all_sizes) of a tolerable error that is the bound.
    part: Option<f64>,
}

/// The largest ratios of both last terms of rates to their bounds, in all trajectories at once, and whether all of them are positive and finite. The
/// bounds are this part of the tolerable errors.
#[inline(always)]
fn usual_ratios<N: Scalar<Stored = Lanes<W>>, V: LaneVector<W>, const W: usize>(
    coefficients: &[V],
    tolerance: &Tolerance<V>,
    part: f64,
) -> ([[f64; W]; 2], bool) {
    let last = coefficients.len() - 1;
    let [part, relative] = [N::from_f64(part), N::from_f64(tolerance.relative)];
    let powers = [N::from_f64((last - 1) as f64), N::from_f64(last as f64)];
    // The sum is not finite if a ratio is not; a maximum may lose it.
    let (mut worst, mut sum) = ([N::ZERO; 2], N::ZERO);
    for (i, absolute) in tolerance.absolute.as_ref().iter().enumerate() {
        let q = N::load(coefficients[0].as_ref()[i]);
        let v = N::load(coefficients[1].as_ref()[i]);
        let size = v.abs().max(q.abs().min(N::ONE));
        let over = N::ONE / (part * (N::load(*absolute) + relative * size));
        for k in 0..2 {
            let term = N::load(coefficients[last - 1 + k].as_ref()[i]);
            let ratio = (powers[k] * term.abs()) * over;
            sum = sum + ratio;
            worst[k] = worst[k].max(ratio);
        }
    }
    let are_usual = sum.is_finite() && worst[0].exceeds(N::ZERO) && worst[1].exceeds(N::ZERO);
    ([worst[0].store().0, worst[1].store().0], are_usual)
}

impl<V: LaneVector<W>, const W: usize> Kernel<Lanes<W>> for Lengths<'_, V, W> {
    type Output = [f64; W];

    #[inline(always)]
    fn run<N: Scalar<Stored = Lanes<W>>>(self) -> [f64; W] {
        let Self {
            coefficients,
            tolerance,
            part,
        } = self;
        let last = coefficients.len() - 1;
        let powers = [last - 1, last];
        if let Some(part) = part {
            let (worst, are_usual) = usual_ratios::<N, V, W>(coefficients, tolerance, part);
            if are_usual {
                let lengths = taylor::usual_lengths(worst, powers);
                return not_in_slow_motion(coefficients, tolerance, lengths);
            }
        }
        let mut worst = [[0.0; W]; 2];
        for (i, absolute) in tolerance.absolute.as_ref().iter().enumerate() {
            let (q, v) = (coefficients[0].as_ref()[i].0, coefficients[1].as_ref()[i].0);
            let one = coefficients[last - 1].as_ref()[i].0;
            let other = coefficients[last].as_ref()[i].0;
            for lane in 0..W {
                let size = taylor::size_of_rate(q[lane], v[lane]);
                let over = 1.0 / taylor::bound(size, absolute[lane], tolerance.relative);
                worst[0][lane] =
                    taylor::larger_ratio(worst[0][lane], one[lane], (last - 1) as f64, over);
                worst[1][lane] =
                    taylor::larger_ratio(worst[1][lane], other[lane], last as f64, over);
            }
        }
        let [one, other] = worst;
        // A loop and not a closure for each lane: a closure would not be compiled into its caller for wide registers.
        let mut lengths = one;
        for (one, other) in lengths.iter_mut().zip(other) {
            *one = taylor::length([*one, other], powers);
        }
        not_in_slow_motion(coefficients, tolerance, lengths)
    }
}

/// These lengths of steps, except of trajectories in slow motion, in which the terms of coordinates must be tolerable as well.
#[inline(always)]
fn not_in_slow_motion<V: LaneVector<W>, const W: usize>(
    coefficients: &[V],
    tolerance: &Tolerance<V>,
    mut lengths: [f64; W],
) -> [f64; W] {
    let last = coefficients.len() - 1;
    for (lane, length) in lengths.iter_mut().enumerate() {
        if taylor::is_slow(*length, last) {
            let coordinates = tolerance.absolute.as_ref().iter().enumerate();
            let all = coordinates.map(|(i, absolute)| {
                let of_power = |j: usize| coefficients[j].as_ref()[i].0[lane];
                let [q, v] = [of_power(0), of_power(1)];
                [q, v, of_power(last - 1), of_power(last), absolute[lane]]
            });
            *length = taylor::length_in_slow_motion(*length, last, all, tolerance.relative);
        }
    }
    lengths
}
