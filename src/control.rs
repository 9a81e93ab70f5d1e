//! Step size control of one trajectory, which all steppers share.

#[cfg(doc)]
use crate::Stepper;
use crate::math::{power, rough_exp2, rough_log2, rough_power, sqrt};
use crate::methods::Method;
use crate::step_error::StepError;
use crate::step_number::StepNumber;
use crate::tolerance::SAFETY;

/// Counts of the work done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Work {
    /// Steps taken.
    pub steps: usize,
    /// Steps that were rejected because their error was too large.
    pub rejected: usize,
    /// Evaluations of the accelerations, or of their series.
    pub evaluations: usize,
}

/// The largest number of steps to an end, by default.
pub(crate) const MAX_STEPS: usize = 10_000_000;

/// Replaces the error of the previous step if there is none.
const NO_ERROR_BEFORE: f64 = 1e-4;

/// Step size control of one trajectory, in numbers of any kind: a [`Stepper`] has one, and so does each lane of an ensemble.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Control {
    /// The step to try next, with its sign; 0 until one is chosen.
    pub step: f64,
    /// The step being tried, or the last one tried.
    pub last_step: f64,
    /// The error of the previous step, for smoothing.
    pub error_before: f64,
    /// Whether no step has been taken since the start, or since the accelerations jumped: see [`error_norm`].
    pub is_first: bool,
    /// Whether the next attempt repeats a rejected step with another length.
    pub is_retry: bool,
    pub work: Work,
}

impl Control {
    pub fn new() -> Self {
        Self {
            step: 0.0,
            last_step: 0.0,
            error_before: NO_ERROR_BEFORE,
            is_first: true,
            is_retry: false,
            work: Work::default(),
        }
    }

    /// Forgets the error of the previous step, when the motion is continued by another method.
    pub fn forget_error(&mut self) {
        self.error_before = NO_ERROR_BEFORE;
    }

    /// Begins anew, when the accelerations have jumped.
    pub fn begin_anew(&mut self) {
        self.forget_error();
        self.is_first = true;
    }

    /// Turns the step towards an end at the signed distance `left`.
    pub fn set_direction(&mut self, left: f64) {
        self.step = self.step.abs().copysign(left);
    }

    /// Whether the next step is too small: it has shrunk to `least`, and not because the end is that near.
    #[inline(always)]
    pub fn is_too_small(&self, least: f64, left: f64) -> bool {
        self.step.abs() <= least.min(0.9 * left.abs())
    }

    /// Limits the next step to the longest one, and returns whether it is the last: the last step may be longer by a hundredth, so
    /// that no tiny step remains.
    #[inline(always)]
    pub fn is_last(&mut self, left: f64, longest: f64) -> bool {
        self.step = self.step.clamp(-longest, longest);
        1.01 * self.step.abs() >= left.abs()
    }

    /// Accepts a step of length `h`; the next may be longer by `factor`.
    #[inline(always)]
    pub fn accept(&mut self, h: f64, error: f64, factor: f64) {
        // Not longer right after a rejection, since its cause is still near.
        self.step = h * if self.is_retry {
            factor.min(1.0)
        } else {
            factor
        };
        self.error_before = error.max(NO_ERROR_BEFORE);
        self.is_first = false;
        self.is_retry = false;
        self.work.steps += 1;
    }

    /// Rejects a step and sets the length of the next attempt. Returns whether that is long enough.
    pub fn reject(&mut self, next: f64, least: f64) -> bool {
        self.step = next;
        self.work.rejected += 1;
        self.is_retry = self.step.abs() > least;
        self.is_retry
    }
}

/// Checks that one more step may be taken after `taken` ones, at time `t`.
pub(crate) fn check_count(taken: usize, steps: usize, t: f64) -> Result<(), StepError> {
    if taken < steps {
        Ok(())
    } else {
        Err(StepError::TooManySteps { steps, t })
    }
}

/// The requested longest step; a value that is not a length sets no limit.
pub(crate) fn longest_step_or_infinity(step: f64) -> f64 {
    if step > 0.0 { step } else { f64::INFINITY }
}

/// The shortest step, in `f64` a few parts in 10¹⁵ of the time: the ends of shorter steps cannot be distinguished. Near t = 0 the
/// limit is the smallest number.
#[inline(always)]
pub(crate) fn shortest_step<N: StepNumber>(t: f64) -> f64 {
    (10.0 * N::EPSILON * t.abs()).max(N::LEAST_STEP)
}

/// The error of a step relative to the tolerance, as root mean square of `numbers`, from the sums of squares of the estimate and of
/// the coarser estimate, which is 0 in methods that have none.
///
/// For the combination with a coarser estimate see *Solving Ordinary Differential Equations I*, eq. (II.10.17). It extrapolates: the error
/// is to the finer estimate as that is to the coarser one, and the power of the step in which this falls, 2·6 − 4 = 8, is one less than the
/// 9 of the error itself, so that it is a bound in short steps. After a start at rest it is neither. There rates are odd in time, so the
/// coarser estimate of a rate is of power 5 and the finer one of power 7, and the combination of power 9 like the error. In a conservative
/// motion near the start, v' = −K q with K symmetric in the metric of inertia, powers 5, 7 and 9 contain K²a, K³a and K⁴a of the
/// acceleration `a` there, whose lengths are moments of the squares of the frequencies. Moments are logarithmically convex: if `a` contains
/// many frequencies, each length exceeds what the two before it extrapolate to, on a chain of 16 links by two orders of magnitude. In later steps
/// the motion contains all its frequencies already. The first step (`is_first`) is therefore judged by the finer estimate alone, which
/// bounds the error as long as the method of higher order is the more accurate one.
#[inline(always)]
pub(crate) fn error_norm(fine: f64, coarse: f64, is_first: bool, numbers: usize) -> f64 {
    let denominator = fine + if is_first { 0.0 } else { 0.01 * coarse };
    // Without a coarser estimate this is the mean of `fine`.
    let error = sqrt(fine * (fine / denominator) / numbers as f64);
    // The error is zero whatever the estimate, or the machine has no coordinates. Selected after the division, as in lanes.
    if denominator == 0.0 { 0.0 } else { error }
}

/// `1/k` for an error estimate of order `h^k`. In a [first step](error_norm) of a method with two estimates it is the finer one, whose power
/// is two less than that of the combination, if it is two more than that of the coarser one.
#[inline(always)]
pub(crate) fn error_exponent(method: &Method, is_first: bool) -> f64 {
    let power = f64::from(method.tableau.error_power);
    let is_alone = is_first && method.tableau.coarse_error.is_some();
    let less = if is_alone { 2.0 } else { 0.0 };
    1.0 / (power - less).max(1.0)
}

/// The factor by which the next step may be longer after a good one with the error `error`;
/// see [`Tableau::smoothing`](crate::methods::Tableau::smoothing).
#[inline(always)]
pub(crate) fn growth(method: &Method, error: f64, error_before: f64, is_first: bool) -> f64 {
    let (shrink, grow) = method.tableau.step_change;
    let smoothing = method.tableau.smoothing;
    let exponent = 0.75 * smoothing - error_exponent(method, is_first);
    let logarithm = exponent * rough_log2(error) + smoothing * rough_log2(error_before);
    (SAFETY * rough_exp2(logarithm)).clamp(shrink, grow)
}

/// The factor for the length of the next attempt after one that was rejected.
pub(crate) fn reduction(method: &Method, error: f64, is_first: bool) -> f64 {
    let (shrink, _) = method.tableau.step_change;
    (SAFETY * rough_power(error, -error_exponent(method, is_first))).max(shrink)
}

/// The length, with its sign, of an Euler step that changes a state of this size by a hundredth: the first guess of *Solving
/// Ordinary Differential Equations I*, section II.4, "Starting Step Size".
pub(crate) fn first_guess([size, rate]: [f64; 2], left: f64, longest: f64) -> f64 {
    let guess = if size <= 1e-5 || rate <= 1e-5 {
        1e-6
    } else {
        0.01 * size / rate
    };
    guess.min(left.abs()).min(longest).copysign(left)
}

/// The length of the first step, with its sign, from the first guess and the sizes of the first two
/// derivatives: `h^order · max(|y'|, |y''|) = 0.01`.
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
    // Extreme tolerances may give no number.
    let is_good = step > 0.0 && step.is_finite();
    (if is_good { step } else { 1e-6 * left.abs() }).copysign(left)
}
