//! The arithmetic of a step: weighted sums over its stages, for a few coordinates at a time.
//!
//! These loops are the whole overhead of an integrator beside the evaluations of a machine, so they are written for speed: sums of
//! 4, 2 or 1 coordinates stay in registers, and the compiler vectorizes them.

use crate::Vector;
use crate::compensated::{Sum, two_sum};
use crate::constraints::Unprojected;
use crate::methods::{MAX_STAGES, Row};
use crate::scalar::Scalar;
use crate::step_number::StepNumber;

/// A state, with the low parts of its compensated sums.
#[derive(Clone, Debug)]
pub(crate) struct Point<V, N = f64> {
    pub t: N,
    pub t_low: N,
    pub q: V,
    pub q_low: V,
    pub v: V,
    pub v_low: V,
}

impl<N: StepNumber, V: Vector<N>> Point<V, N> {
    pub fn new(t: N, q: V, v: V) -> Self {
        Self {
            t,
            t_low: N::NOTHING,
            q_low: q.zeros_like(),
            v_low: v.zeros_like(),
            q,
            v,
        }
    }

    /// Copies without allocation.
    #[inline(always)]
    pub fn copy_from(&mut self, other: &Self) {
        (self.t, self.t_low) = (other.t, other.t_low);
        self.q.clone_from(&other.q);
        self.q_low.clone_from(&other.q_low);
        self.v.clone_from(&other.v);
        self.v_low.clone_from(&other.v_low);
    }

    /// Sets the time to the end of a step of length `h` from `before`, and exactly to `end` where `is_last` holds.
    #[inline(always)]
    pub fn set_time(&mut self, before: &Self, h: N, (end, is_last): (N, &N::Each<bool>)) {
        let (t, t_low) = two_sum(before.t, before.t_low + h);
        self.t = end.where_true(is_last, t);
        self.t_low = N::NOTHING.where_true(is_last, t_low);
    }

    /// The time as a compensated sum.
    pub fn time(&self) -> Sum<N> {
        Sum {
            high: self.t,
            low: self.t_low,
        }
    }
}

impl<V: Vector> Point<V> {
    /// The state a time `ahead` later, with the acceleration `a`.
    #[cfg(feature = "std")]
    pub fn state_ahead(&self, ahead: f64, a: &V, [q, v]: [&mut V; 2]) {
        for (i, a) in a.as_slice().iter().enumerate() {
            let rate = self.v.as_slice()[i];
            q.as_mut_slice()[i] = self.q.as_slice()[i] + ahead * (rate + 0.5 * ahead * a);
            v.as_mut_slice()[i] = rate + ahead * a;
        }
    }

    /// The state as one that can be projected.
    pub fn place(&mut self) -> Unprojected<'_, V> {
        Unprojected {
            t: self.t,
            q: [&mut self.q, &mut self.q_low],
            v: [&mut self.v, &mut self.v_low],
        }
    }
}

/// Evaluates `$body` for blocks of `B` = 4, 2 and 1 coordinates from `start` that together cover `$n` coordinates.
macro_rules! in_blocks {
    ($n:expr, |$start:ident, $B:ident| $body:expr) => {{
        let n = $n;
        let mut $start = 0;
        while $start + 4 <= n {
            const $B: usize = 4;
            $body;
            $start += 4;
        }
        if $start + 2 <= n {
            const $B: usize = 2;
            $body;
            $start += 2;
        }
        if $start < n {
            const $B: usize = 1;
            $body;
        }
    }};
}
pub(crate) use in_blocks;

/// `Σⱼ w̄ⱼ kⱼ` and `Σⱼ wⱼ kⱼ` for `B` coordinates from `start`, the contributions of the stages to positions and velocities, in
/// registers `R`. Products and sums are rounded individually, so that the bits are the same in all registers.
#[inline(always)]
pub(crate) fn weigh<const B: usize, R, V>(
    row: &Row,
    k: &[V; MAX_STAGES],
    start: usize,
) -> [[R; B]; 2]
where
    R: Scalar<Stored: StepNumber>,
    V: Vector<R::Stored>,
{
    let (mut position, mut velocity) = ([R::ZERO; B], [R::ZERO; B]);
    if R::Stored::IS_WIDE {
        for (term, beyond) in row.wide_terms() {
            let k = load::<B, R, V>(&k[term.stage], start);
            let of_position = R::from_f64(term.position) + R::from_f64(beyond.position);
            let of_velocity = R::from_f64(term.velocity) + R::from_f64(beyond.velocity);
            for i in 0..B {
                position[i] = position[i] + of_position * k[i];
                velocity[i] = velocity[i] + of_velocity * k[i];
            }
        }
        return [position, velocity];
    }
    for term in row.terms() {
        let k = load::<B, R, V>(&k[term.stage], start);
        let [of_position, of_velocity] = [R::from_f64(term.position), R::from_f64(term.velocity)];
        for i in 0..B {
            position[i] = position[i] + of_position * k[i];
            velocity[i] = velocity[i] + of_velocity * k[i];
        }
    }
    [position, velocity]
}

/// [`weigh`] for one coordinate, outside of kernels.
#[inline(always)]
pub(crate) fn weigh_one<N: StepNumber, V: Vector<N>>(
    row: &Row,
    k: &[V; MAX_STAGES],
    i: usize,
) -> [N; 2] {
    let (mut position, mut velocity) = (N::NOTHING, N::NOTHING);
    for (term, beyond) in row.wide_terms() {
        let k = k[term.stage].as_slice()[i];
        position = position + k.weighted(term.position, beyond.position);
        velocity = velocity + k.weighted(term.velocity, beyond.velocity);
    }
    [position, velocity]
}

/// Loads `B` numbers from `start` into registers.
#[inline(always)]
fn load<const B: usize, R: Scalar, V: Vector<R::Stored>>(vector: &V, start: usize) -> [R; B] {
    // No closure, since functions that are called for each number are not inlined into code for wide registers.
    let slice = &vector.as_slice()[start..start + B];
    let mut block = [R::ZERO; B];
    for (number, stored) in block.iter_mut().zip(slice) {
        *number = R::load(*stored);
    }
    block
}

/// Stores `B` numbers from `start`.
#[inline(always)]
fn store<const B: usize, R: Scalar, V: Vector<R::Stored>>(
    vector: &mut V,
    start: usize,
    numbers: [R; B],
) {
    let slice = &mut vector.as_mut_slice()[start..start + B];
    for (stored, number) in slice.iter_mut().zip(numbers) {
        *stored = number.store();
    }
}

/// Copies `B` numbers from `start`.
#[inline(always)]
pub(crate) fn block<const B: usize, N: Copy, V: Vector<N>>(vector: &V, start: usize) -> [N; B] {
    // No closure, since functions that are called for each number are not inlined into code for wide registers.
    let slice = &vector.as_slice()[start..start + B];
    let mut block = [slice[0]; B];
    block.copy_from_slice(slice);
    block
}

/// The state at a stage, after the fraction `cᵢ` of the step, `ch = cᵢ h`: `qᵢ = q + cᵢ h v + h² Σ āᵢⱼ kⱼ`, `vᵢ = v + h Σ aᵢⱼ kⱼ`.
#[inline(always)]
pub(crate) fn stage_state<R, V>(
    (row, ch, h): (&Row, R::Stored, R::Stored),
    [q0, v0]: [&V; 2],
    k: &[V; MAX_STAGES],
    [q, v]: [&mut V; 2],
) where
    R: Scalar<Stored: StepNumber>,
    V: Vector<R::Stored>,
{
    let (ch, h) = (R::load(ch), R::load(h));
    in_blocks!(q0.as_slice().len(), |start, B| {
        let [position, velocity] = weigh::<B, R, V>(row, k, start);
        let (q0, v0) = (load::<B, R, V>(q0, start), load::<B, R, V>(v0, start));
        let (mut q_stage, mut v_stage) = (q0, v0);
        for i in 0..B {
            q_stage[i] = q0[i] + (ch * v0[i] + h * h * position[i]);
            v_stage[i] = v0[i] + h * velocity[i];
        }
        store::<B, R, V>(q, start, q_stage);
        store::<B, R, V>(v, start, v_stage);
    });
}

/// The state at the end of a step: the sums of [`stage_state`], compensated.
#[inline(always)]
pub(crate) fn advance_state<R, V>(
    (row, h): (&Row, R::Stored),
    before: &Point<V, R::Stored>,
    k: &[V; MAX_STAGES],
    now: &mut Point<V, R::Stored>,
) where
    R: Scalar<Stored: StepNumber>,
    V: Vector<R::Stored>,
{
    let h = R::load(h);
    in_blocks!(before.q.as_slice().len(), |start, B| {
        let [position, velocity] = weigh::<B, R, V>(row, k, start);
        let (q, q_low) = (
            load::<B, R, V>(&before.q, start),
            load::<B, R, V>(&before.q_low, start),
        );
        let (v, v_low) = (
            load::<B, R, V>(&before.v, start),
            load::<B, R, V>(&before.v_low, start),
        );
        let zeros = [R::ZERO; B];
        let (mut q1, mut q1_low, mut v1, mut v1_low) = (zeros, zeros, zeros, zeros);
        for i in 0..B {
            let rise = h * v[i] + (h * v_low[i] + h * h * position[i]);
            (q1[i], q1_low[i]) = two_sum(q[i], q_low[i] + rise);
            (v1[i], v1_low[i]) = two_sum(v[i], v_low[i] + h * velocity[i]);
        }
        store::<B, R, V>(&mut now.q, start, q1);
        store::<B, R, V>(&mut now.q_low, start, q1_low);
        store::<B, R, V>(&mut now.v, start, v1);
        store::<B, R, V>(&mut now.v_low, start, v1_low);
    });
}

/// The sum over all coordinates and rates of the squares of the errors estimated by each of these rows, relative to the tolerance,
/// for each trajectory; see [`StepNumber::squared_errors`].
#[inline(always)]
pub(crate) fn squared_errors<const K: usize, R, N, V>(
    (rows, h): ([&Row; K], N),
    [before, now]: [&Point<V, N>; 2],
    k: &[V; MAX_STAGES],
    (relative, absolute): (f64, &V),
) -> [N::Each<f64>; K]
where
    R: Scalar<Stored = N>,
    N: StepNumber,
    V: Vector<N>,
{
    let h = R::load(h);
    let mut sums = [N::each(|_| 0.0); K];
    in_blocks!(now.q.as_slice().len(), |start, B| {
        let mut positions = [[N::NOTHING; B]; K];
        let mut velocities = [[N::NOTHING; B]; K];
        for (of_row, row) in rows.into_iter().enumerate() {
            let [position, velocity] = weigh::<B, R, V>(row, k, start);
            for i in 0..B {
                positions[of_row][i] = (h * h * position[i]).store();
                velocities[of_row][i] = (h * velocity[i]).store();
            }
        }
        let absolute = block::<B, N, V>(absolute, start);
        let mut of_block = [N::each(|_| 0.0); K];
        let errors = [
            (positions, [&before.q, &now.q]),
            (velocities, [&before.v, &now.v]),
        ];
        for (errors, [before, now]) in errors {
            let (before, now) = (
                block::<B, N, V>(before, start),
                block::<B, N, V>(now, start),
            );
            for i in 0..B {
                let mut of_number = [N::NOTHING; K];
                for (of_number, errors) in of_number.iter_mut().zip(&errors) {
                    *of_number = errors[i];
                }
                let sizes = [before[i], now[i]];
                let squares = N::squared_errors(of_number, sizes, absolute[i], relative);
                for (of_block, square) in of_block.iter_mut().zip(&squares) {
                    add(of_block, square);
                }
            }
        }
        for (sum, of_block) in sums.iter_mut().zip(&of_block) {
            add(sum, of_block);
        }
    });
    sums
}

/// Adds terms to sums.
#[inline(always)]
pub(crate) fn add(sums: &mut impl AsMut<[f64]>, terms: &impl AsRef<[f64]>) {
    for (sum, term) in sums.as_mut().iter_mut().zip(terms.as_ref()) {
        *sum += term;
    }
}

/// Whether all numbers are finite, in all trajectories.
#[inline(always)]
pub(crate) fn are_all_finite<R: Scalar>(numbers: &[R::Stored]) -> bool {
    // If any number is not finite, the sum is not, and one test is cheaper than many. The sum stays in registers: a loop over the
    // lanes of each number would be slower than the evaluation of a small machine.
    let mut sum = R::ZERO;
    for number in numbers {
        sum = sum + R::load(*number);
    }
    sum.is_finite()
}
