//! How long the next step is: what all steppers do by themselves, for one trajectory.

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
    /// Steps tried and given up, since their error was too great.
    pub rejected: usize,
    /// Evaluations of the accelerations, or of their series.
    pub evaluations: usize,
}

/// How many steps may be taken to an end, if nobody says.
pub(crate) const MAX_STEPS: usize = 10_000_000;

/// What stands for the error of the step before where there is none.
const NO_ERROR_BEFORE: f64 = 1e-4;

/// The state of the control of one trajectory, whatever its numbers: a [`Stepper`] has one, and each lane of an ensemble.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Control {
    /// The step to try next, with its sign; 0 until one is chosen.
    pub step: f64,
    /// The step being tried, or tried last.
    pub last_step: f64,
    /// The error of the step before, for smoothing.
    pub error_before: f64,
    /// Whether the step to be tried was tried before, and was not good.
    pub is_retry: bool,
    pub work: Work,
}

impl Control {
    pub fn new() -> Self {
        Self {
            step: 0.0,
            last_step: 0.0,
            error_before: NO_ERROR_BEFORE,
            is_retry: false,
            work: Work::default(),
        }
    }

    /// Forgets the error of the step before, where the motion goes on in another way.
    pub fn forget_error(&mut self) {
        self.error_before = NO_ERROR_BEFORE;
    }

    /// Turns towards an end that is `left` away.
    pub fn turn(&mut self, left: f64) {
        self.step = self.step.abs().copysign(left);
    }

    /// Whether a step as it is to be tried is none: it has shrunk to `least`, and not because its end is that near.
    #[inline(always)]
    pub fn is_too_small(&self, least: f64, left: f64) -> bool {
        self.step.abs() <= least.min(0.9 * left.abs())
    }

    /// Keeps the next step below the longest one, and says whether it is the last: that may stretch by a hundredth, so that no
    /// sliver is left over.
    #[inline(always)]
    pub fn is_last(&mut self, left: f64, longest: f64) -> bool {
        self.step = self.step.clamp(-longest, longest);
        1.01 * self.step.abs() >= left.abs()
    }

    /// A good step of length `h` was taken; the next may be longer by `factor`.
    #[inline(always)]
    pub fn take(&mut self, h: f64, error: f64, factor: f64) {
        // Not longer right after a rejection: what stood in the way is still near.
        self.step = h * if self.is_retry {
            factor.min(1.0)
        } else {
            factor
        };
        self.error_before = error.max(NO_ERROR_BEFORE);
        self.is_retry = false;
        self.work.steps += 1;
    }

    /// A step was not good, and one of length `next` is to be tried. Says whether that is a step.
    pub fn give_up(&mut self, next: f64, least: f64) -> bool {
        self.step = next;
        self.work.rejected += 1;
        self.is_retry = self.step.abs() > least;
        self.is_retry
    }
}

/// Whether one more step may be taken after `taken` ones, at time `t`.
pub(crate) fn check_count(taken: usize, steps: usize, t: f64) -> Result<(), StepError> {
    if taken < steps {
        Ok(())
    } else {
        Err(StepError::TooManySteps { steps, t })
    }
}

/// The longest step that somebody asks for: what is no length sets no bound.
pub(crate) fn longest(step: f64) -> f64 {
    if step > 0.0 { step } else { f64::INFINITY }
}

/// A few parts in 10¹⁵ of the time, in `f64`: shorter steps have no beginning and no end. Near t = 0 that is no limit; there the
/// smallest numbers are.
#[inline(always)]
pub(crate) fn least<N: StepNumber>(t: f64) -> f64 {
    (10.0 * N::EPSILON * t.abs()).max(N::LEAST_STEP)
}

/// The error of a step in the root mean square of `numbers`, 1 being just tolerable, from the sums of squares of the estimate and of
/// the coarser one, which is 0 in methods that have none.
///
/// With a coarser estimate: *Solving Ordinary Differential Equations I*, eq. (II.10.17).
#[inline(always)]
pub(crate) fn combined(fine: f64, coarse: f64, numbers: usize) -> f64 {
    let denominator = fine + 0.01 * coarse;
    // Without a coarser estimate, this is the mean of `fine`.
    let error = sqrt(fine * (fine / denominator) / numbers as f64);
    // No error at all, whatever the estimate; or a machine without coordinates. Chosen after it was worked out, as in lanes.
    if denominator == 0.0 { 0.0 } else { error }
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
    let logarithm = exponent * rough_log2(error) + smoothing * rough_log2(error_before);
    (SAFETY * rough_exp2(logarithm)).clamp(shrink, grow)
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
