//! How long the next step is: what all steppers do by themselves, for one trajectory.

use crate::math::{power, rough_power, sqrt};
use crate::methods::Method;
use crate::tolerance::SAFETY;

/// The error of a step in the root mean square of `numbers`, 1 being just tolerable, from the sums of squares of the estimate and of
/// the coarser one, which is 0 in methods that have none.
///
/// With a coarser estimate: *Solving Ordinary Differential Equations I*, eq. (II.10.17).
#[inline(always)]
pub(crate) fn combined(fine: f64, coarse: f64, numbers: usize) -> f64 {
    let denominator = fine + 0.01 * coarse;
    // No error at all, whatever the estimate; or a machine without coordinates.
    if denominator == 0.0 {
        return 0.0;
    }
    // Without a coarser estimate, this is the mean of `fine`.
    sqrt(fine * (fine / denominator) / numbers as f64)
}

/// `1/k` for an estimate of the error that falls as `h^k`.
#[inline(always)]
pub(crate) fn error_exponent(method: &Method) -> f64 {
    1.0 / f64::from(method.tableau.error_power)
}

/// By how much the next step may be longer than this good one, whose error is `error`; see
/// [`Tableau::smoothing`](crate::methods::Tableau::smoothing).
#[inline(always)]
pub(crate) fn growth(method: &Method, error: f64, error_before: f64) -> f64 {
    let (shrink, grow) = method.tableau.step_change;
    let smoothing = method.tableau.smoothing;
    let exponent = 0.75 * smoothing - error_exponent(method);
    let factor = SAFETY * rough_power(error, exponent) * rough_power(error_before, smoothing);
    factor.clamp(shrink, grow)
}

/// By how much the next try is to be shorter than this one, which was not good.
pub(crate) fn reduction(method: &Method, error: f64) -> f64 {
    let (shrink, _) = method.tableau.step_change;
    (SAFETY * rough_power(error, -error_exponent(method))).max(shrink)
}

/// A step of Euler's method by which a state of this size changes by a hundredth, with its sign: the first guess of
/// *Solving Ordinary Differential Equations I*, section II.4, "Starting Step Size".
pub(crate) fn first_guess([size, rate]: [f64; 2], left: f64, longest: f64) -> f64 {
    let guess = if size <= 1e-5 || rate <= 1e-5 {
        1e-6
    } else {
        0.01 * size / rate
    };
    guess.min(left.abs()).min(longest).copysign(left)
}

/// The length of the first step, with its sign, from the first guess and from the size of the first two derivatives:
/// `h^order · max(|y'|, |y''|) = 0.01`.
pub(crate) fn first_step(
    method: &Method,
    guess: f64,
    [rate, change]: [f64; 2],
    left: f64,
    longest: f64,
) -> f64 {
    let greatest = change.max(rate);
    let step = if greatest <= 1e-15 {
        (1e-3 * guess.abs()).max(1e-6)
    } else {
        power(0.01 / greatest, 1.0 / f64::from(method.tableau.order))
    };
    let step = step.min(100.0 * guess.abs()).min(left.abs()).min(longest);
    // Tolerances beyond all measure leave no number.
    let is_good = step > 0.0 && step.is_finite();
    (if is_good { step } else { 1e-6 * left.abs() }).copysign(left)
}
