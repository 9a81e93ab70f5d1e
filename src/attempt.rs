//! One attempt at an explicit step in numbers of any kind, which all steppers share.

use crate::control;
use crate::methods::{MAX_STAGES, Method};
use crate::scalar::Scalar;
use crate::stages::{Point, advance_state, squared_errors, stage_state, weigh_one};
use crate::step_number::StepNumber;
use crate::tolerance::Tolerance;
use crate::{Vector, math};

/// Computes the state at a stage of a step of length `h` from `before` in `q` and `v`; returns its time.
///
/// The caller loops over the stages itself: a closure that evaluates them would not be compiled into its caller for wide registers.
#[inline(always)]
pub(crate) fn go_to_stage<R: Scalar<Stored = N>, N: StepNumber, V: Vector<N>>(
    (method, stage): (&Method, usize),
    (before, h): (&Point<V, N>, N),
    k: &[V; MAX_STAGES],
    to: [&mut V; 2],
) -> N {
    let (tableau, scheme) = (&method.tableau, &method.scheme);
    let ch = h.weighted(tableau.c[stage], scheme.c_beyond[stage]);
    let from = [&before.q, &before.v];
    stage_state::<R, V>((&scheme.rows[stage], ch, h), from, k, to);
    before.t + (before.t_low + ch)
}

/// Computes the new point of a step of length `h` from `before`, which is at `end` where `is_last` holds.
#[inline(always)]
pub(crate) fn arrive<R: Scalar<Stored = N>, N: StepNumber, V: Vector<N>>(
    method: &Method,
    (before, h): (&Point<V, N>, N),
    k: &[V; MAX_STAGES],
    now: &mut Point<V, N>,
    to: (N, &N::Each<bool>),
) {
    let new_point = &method.scheme.rows[method.tableau.stages];
    advance_state::<R, V>((new_point, h), before, k, now);
    now.set_time(before, h, to);
}

/// The errors of a step of length `h` relative to the tolerance, as root mean square over coordinates and rates: see
/// [`control::error_norm`].
#[inline(always)]
pub(crate) fn errors<R: Scalar<Stored = N>, N: StepNumber, V: Vector<N>>(
    method: &Method,
    h: N,
    ends: [&Point<V, N>; 2],
    k: &[V; MAX_STAGES],
    (tolerance, is_first): (&Tolerance<V>, &N::Each<bool>),
) -> N::Each<f64> {
    let scheme = &method.scheme;
    let of = (tolerance.relative, &tolerance.absolute);
    let [fine, coarse] = match method.tableau.coarse_error {
        Some(_) => {
            let rows = [&scheme.error, &scheme.coarse_error];
            squared_errors::<2, R, N, V>((rows, h), ends, k, of)
        }
        None => {
            let [fine] = squared_errors::<1, R, N, V>(([&scheme.error], h), ends, k, of);
            [fine, N::each(|_| 0.0)]
        }
    };
    let numbers = 2 * N::PARTS * ends[0].q.as_slice().len();
    // A loop and not a closure for each trajectory: a closure would not be compiled into its caller for wide registers.
    let mut errors = fine;
    let with = coarse.as_ref().iter().zip(is_first.as_ref());
    for (error, (coarse, is_first)) in errors.as_mut().iter_mut().zip(with) {
        *error = control::error_norm(*error, *coarse, *is_first, numbers);
    }
    errors
}

/// The coordinate with the largest error in a step of one trajectory.
pub(crate) fn worst<N: StepNumber, V: Vector<N>>(
    method: &Method,
    h: N,
    [before, now]: [&Point<V, N>; 2],
    k: &[V; MAX_STAGES],
    (tolerance, lane): (&Tolerance<V>, usize),
) -> usize {
    let Tolerance { relative, absolute } = tolerance;
    let mut worst = (0, 0.0);
    for (i, absolute) in absolute.as_slice().iter().enumerate() {
        let [position, velocity] = weigh_one(&method.scheme.error, k, i);
        let sizes = |[before, now]: [&V; 2]| [before.as_slice()[i], now.as_slice()[i]];
        let errors = [
            (h * h * position, sizes([&before.q, &now.q])),
            (h * velocity, sizes([&before.v, &now.v])),
        ];
        for (error, sizes) in errors {
            let [square] = N::squared_errors([error], sizes, *absolute, *relative);
            if square.as_ref()[lane] > worst.1 {
                worst = (i, square.as_ref()[lane]);
            }
        }
    }
    worst.0
}

/// A length for the first step of one trajectory from `now`, at the distance `left` from its end, from the sizes of the first two
/// derivatives: *Solving Ordinary Differential Equations I*, section II.4, "Starting Step Size".
///
/// `k[0]` is the present acceleration. `evaluate((t, q, v), a)` evaluates the acceleration a little ahead, and returns whether it exists;
/// if not, the guess is returned, and a rejected step will shorten it.
pub(crate) fn first_step<N: StepNumber, V: Vector<N>>(
    (method, tolerance): (&Method, &Tolerance<V>),
    now: &Point<V, N>,
    k: &mut [V; MAX_STAGES],
    [q, v]: [&mut V; 2],
    [left, longest]: [f64; 2],
    evaluate: impl FnOnce((N, &V, &V), &mut V) -> bool,
) -> f64 {
    let (relative, absolute) = (tolerance.relative, tolerance.absolute.as_slice());
    let norm = |of: &dyn Fn(usize) -> [N; 2]| {
        let mut sum = 0.0;
        for (i, absolute) in absolute.iter().enumerate() {
            let sizes = [now.q.as_slice()[i], now.v.as_slice()[i]];
            let square = |level: usize| {
                let size = [sizes[level]; 2];
                let [square] = N::squared_errors([of(i)[level]], size, *absolute, relative);
                square.as_ref()[0]
            };
            sum += square(0) + square(1);
        }
        math::sqrt(sum)
    };

    let (first, rest) = k.split_at_mut(1);
    let (a, ahead) = (first[0].as_slice(), &mut rest[0]);
    let size = norm(&|i| [now.q.as_slice()[i], now.v.as_slice()[i]]);
    let rate = norm(&|i| [now.v.as_slice()[i], a[i]]);
    let guess = control::first_guess([size, rate], left, longest);
    let ahead_by = N::gather(N::each(|_| guess));
    for (i, a) in a.iter().enumerate() {
        q.as_mut_slice()[i] = now.q.as_slice()[i] + ahead_by * now.v.as_slice()[i];
        v.as_mut_slice()[i] = now.v.as_slice()[i] + ahead_by * *a;
    }
    if !evaluate((now.t + ahead_by, &*q, &*v), ahead) {
        return guess;
    }
    let ahead = ahead.as_slice();
    let change = norm(&|i| [ahead_by * a[i], ahead[i] - a[i]]) / guess.abs();
    control::first_step(method, guess, [rate, change], left, longest)
}

/// The first coordinate for which one of two vectors is not finite in a trajectory.
pub(crate) fn not_finite<N: StepNumber, V: Vector<N>>(
    one: &V,
    other: &V,
    lane: usize,
) -> Option<usize> {
    let pairs = one.as_slice().iter().zip(other.as_slice());
    pairs
        .map(|pair| <[&N; 2]>::from(pair).map(|number| number.are_finite().as_ref()[lane]))
        .position(|finite| finite != [true; 2])
}

/// For each trajectory, whether all numbers of two vectors are finite.
#[inline(always)]
pub(crate) fn are_finite<N: StepNumber, V: Vector<N>>(one: &V, other: &V) -> N::Each<bool> {
    // If any number is not finite, the sum is not, and one test is cheaper than many.
    let mut sum = N::NOTHING;
    for (one, other) in one.as_slice().iter().zip(other.as_slice()) {
        sum = sum + *one + *other;
    }
    let fine = sum.are_finite();
    if !fine.as_ref().contains(&false) {
        return fine;
    }
    N::each(|lane| fine.as_ref()[lane] || not_finite(one, other, lane).is_none())
}
