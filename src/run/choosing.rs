//! Chooses the method of a run, and decides when to change it.
//!
//! All decisions follow from counts of operations, steps and evaluations and from the state, never from a clock. So the same call gives
//! the same bits.
//!
//! * At the start the costs decide: of a step by Taylor series, and of the steps of `dop853` that cover it.
//! * If stability limits explicit steps, the run changes to a Radau method. The test of DOP853 detects this, and in series the fastest
//!   rate of the machine does.
//! * It changes from a Radau method back to `dop853` if its steps have cost more than explicit ones would: evaluations, and the solution of
//!   linear equations, in evaluations. Explicit ones would cost what those before the change have cost, as long as the machine is no
//!   faster than it was there, or what stable ones cost that are no longer than the implicit ones.

use super::Run;
use crate::balance::Quadratures;
use crate::control::Work;
use crate::inputs::InputLaw;
use crate::methods::{Method, RADAU_OF_HIGH_ORDER};
use crate::solution::{MethodChoice, MethodReason};
use crate::taylor;
use crate::tolerance::Tolerance;
use crate::{Error, Machine, StepError, System, Vector};
use std::vec::Vec;

/// All methods that a run may change to, besides that by series.
pub(super) const CANDIDATES: [&Method; 4] = [
    Method::DOP853,
    Method::RADAU5,
    &RADAU_OF_HIGH_ORDER[0],
    &RADAU_OF_HIGH_ORDER[1],
];

/// Number of evaluations in a step of `dop853`.
const EVALUATIONS: f64 = 12.0;

/// Number of explicit steps between stiffness tests: so small that the work until a stiff machine is detected is a small part of the work
/// of an implicit method for the whole motion.
const STEPS_BETWEEN_TESTS: usize = 100;

/// Number of steps by series between evaluations of the fastest rate, each of which takes some two evaluations for each coordinate.
const STEPS_BETWEEN_LOOKS: usize = 64;

/// Stability limits a step by series if it is longer than this, in units of the inverse of the fastest rate: 0.86 of where the stability
/// regions of the series of orders 12 and 20 end on the negative real axis, 5.82 and 8.82. A harmonic motion of size 1 takes, at the same
/// tolerances, steps of at most 2.5 and 4.2.
const REACH_OF_SERIES: [f64; 2] = [5.0, 7.6];

/// Where the stability region of `dop853` ends, in the same units.
const REACH: f64 = 6.1;

/// An evaluation takes about as long as this many multiplications of linear equations for each coordinate: the crusher's 200 cycles, for
/// nine coordinates, and half a cycle for a multiplication.
const MULTIPLICATIONS: f64 = 50.0;

/// Number of implicit steps that are evaluated together.
const WINDOW: usize = 8;

/// Number of consecutive windows in which explicit steps must cost less; it doubles with each return to an explicit method from one that had
/// cost less.
const WINDOWS: usize = 2;

/// Least number of explicit steps whose evaluations are counted before a change to an implicit method.
const MEASURED: usize = 16;

/// After a change to an implicit method that never cost less, so many times as many explicit steps are taken until the next test.
const PATIENCE: usize = 4;

/// State of the choice of methods in a run.
#[derive(Debug)]
pub(super) struct Choosing {
    is_free: bool,
    pub choices: Vec<MethodChoice>,
    /// Time, work and multiplications at the beginning of the window.
    since: (f64, Work, f64),
    /// The number of consecutive windows in which explicit steps would have cost less, and the number required.
    paying: usize,
    needed: usize,
    /// Time and work at two instants in the explicit steps so far, at least [`MEASURED`] steps apart.
    marks: [(f64, Work); 2],
    /// Evaluations by explicit steps before the change to the implicit method, per second of the motion, and the fastest rate there.
    measured: Option<(f64, f64)>,
    /// Whether the implicit method has cost less in any window since that change.
    has_paid: bool,
    between_tests: usize,
}

impl Choosing {
    /// For a run whose method is given.
    pub fn none() -> Self {
        Self {
            is_free: false,
            choices: Vec::new(),
            since: (0.0, Work::default(), 0.0),
            paying: 0,
            needed: WINDOWS,
            marks: [(0.0, Work::default()); 2],
            measured: None,
            has_paid: false,
            between_tests: STEPS_BETWEEN_TESTS,
        }
    }

    /// Whether the run may change its method.
    pub fn is_free(&self) -> bool {
        self.is_free
    }

    /// For a run that begins with a method of its own choice.
    pub fn begun(
        t: f64,
        (method, reason): (&'static Method, MethodReason),
        may_change: bool,
    ) -> Self {
        Self {
            is_free: may_change,
            choices: [MethodChoice { t, method, reason }].into(),
            ..Self::none()
        }
    }
}

/// The finest tolerance of any coordinate, at size 1.
fn sharpest<V: Vector>(tolerance: &Tolerance<V>) -> f64 {
    let absolute = tolerance.absolute.as_slice().iter();
    tolerance.relative + absolute.fold(f64::INFINITY, |least, x| least.min(*x))
}

/// The number of steps of `dop853` that cover one step by series, both as long as this tolerance allows.
///
/// Steps of order p are proportional to τ^(1/(p + 1)), so the ratio is a power of the tolerance; its size at one tolerance is that of the
/// double pendulum, and the crusher has 0.9 to 1.1 times that (`docs/benchmarks.md`). At coarse tolerances series are computed to a tenth
/// of the tolerance.
fn steps_for_one(tolerance: f64) -> f64 {
    let (size, at, power) = match tolerance {
        coarse if coarse > taylor::FINE => (0.63, 2e-4, 1.0 / 9.0 - 1.0 / 13.0),
        middle if middle > 1e-8 => (1.39, 2e-6, 1.0 / 9.0 - 1.0 / 21.0),
        _ => (2.09, 2e-8, 1.0 / 9.0 - 1.0 / 21.0),
    };
    size * crate::math::power(at / tolerance, power)
}

/// The method to begin with, and the reason.
pub(super) fn first<S: System>(
    system: &S,
    tolerance: &Tolerance<S::Vector>,
    inputs_stay: bool,
) -> (&'static Method, MethodReason) {
    let explicit = (Method::DOP853, MethodReason::Explicit);
    let is_possible = inputs_stay && system.check_series().is_ok();
    let costs = is_possible.then(|| system.series_cost()).flatten();
    let Some(costs) = costs else {
        return explicit;
    };
    let tolerance = sharpest(tolerance);
    let cost = costs[usize::from(tolerance <= taylor::FINE)];
    let saved = EVALUATIONS * steps_for_one(tolerance);
    if cost < saved {
        (Method::TAYLOR, MethodReason::SeriesPays { cost, saved })
    } else {
        (Method::DOP853, MethodReason::SeriesCosts { cost, saved })
    }
}

/// The Radau method for a tolerance.
fn implicit(tolerance: f64) -> &'static Method {
    match tolerance {
        coarse if coarse > 2e-7 => Method::RADAU5,
        middle if middle > 2e-10 => &RADAU_OF_HIGH_ORDER[0],
        _ => &RADAU_OF_HIGH_ORDER[1],
    }
}

impl<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> Run<'_, '_, M, L, A> {
    /// Begins to test whether another method costs less. If stability limits a series from the start on, it is left at once.
    pub(super) fn begin_choosing(&mut self) -> Result<(), Error> {
        if !self.choosing.is_free {
            return Ok(());
        }
        self.stepper.test_stiffness_every(STEPS_BETWEEN_TESTS);
        match self.rate_beyond_series() {
            Some(rate) => self.go_on_by(Method::DOP853, MethodReason::Stiff { rate }),
            None => Ok(()),
        }
    }

    /// Changes to another method if that costs less. Call it after an accepted step, when no instant within the next one has to be met.
    pub(super) fn choose_again(&mut self) -> Result<(), Error> {
        if !self.choosing.is_free || self.stepper.is_done() {
            return Ok(());
        }
        if self.stepper.is_implicit() {
            return self.leave_implicit();
        }
        if self.stepper.coefficients().is_some() {
            let steps = self.stepper.work().steps;
            let is_due = steps.is_multiple_of(STEPS_BETWEEN_LOOKS);
            let rate = is_due.then(|| self.rate_beyond_series()).flatten();
            return match rate {
                Some(rate) => self.go_on_implicitly(rate),
                None => Ok(()),
            };
        }
        self.mark();
        match self.stepper.stiff_since() {
            Some(_) => {
                let rate = self.stepper.fastest_rate().unwrap_or(0.0);
                self.go_on_implicitly(rate)
            }
            None => Ok(()),
        }
    }

    /// Changes to an explicit method if a step by series has no value, or none that is long enough; returns whether it does.
    pub(super) fn leave_series(&mut self, error: &StepError) -> bool {
        let is_of_series = matches!(
            error,
            StepError::Singular { .. }
                | StepError::NotFinite { .. }
                | StepError::StepTooSmall { .. }
        );
        self.choosing.is_free
            && is_of_series
            && self.stepper.coefficients().is_some()
            && self
                .go_on_by(Method::DOP853, MethodReason::NoSeries)
                .is_ok()
    }

    /// The fastest rate, if it makes steps by series unstable.
    fn rate_beyond_series(&mut self) -> Option<f64> {
        let length = self.stepper.length_in_series()?;
        let is_fine = sharpest(self.stepper.tolerance()) <= taylor::FINE;
        let rate = self.stepper.fastest_rate()?;
        let is_beyond = length * rate > REACH_OF_SERIES[usize::from(is_fine)];
        (is_beyond && length.is_finite()).then_some(rate)
    }

    /// Remembers time and work of explicit steps from time to time.
    fn mark(&mut self) {
        let now = (self.stepper.t(), self.stepper.work());
        let [_, last] = self.choosing.marks;
        if now.1.steps >= last.1.steps + MEASURED {
            self.choosing.marks = [last, now];
        }
    }

    fn go_on_implicitly(&mut self, rate: f64) -> Result<(), Error> {
        let method = implicit(sharpest(self.stepper.tolerance()));
        let (since, before) = self.choosing.marks[0];
        let evaluations = self.stepper.work().evaluations - before.evaluations;
        let is_explicit = self.stepper.coefficients().is_none();
        let measured = evaluations as f64 / (self.stepper.t() - since).abs();
        let is_measured = is_explicit && before.steps > 0 && measured.is_finite();
        self.choosing.measured = is_measured.then_some((measured, rate));
        self.choosing.has_paid = false;
        self.begin_window();
        self.choosing.paying = 0;
        self.go_on_by(method, MethodReason::Stiff { rate })
    }

    fn begin_window(&mut self) {
        let stepper = &self.stepper;
        self.choosing.since = (stepper.t(), stepper.work(), stepper.multiplications());
    }

    /// Returns to an explicit method if that would have cost less, in steps that are stable and no longer than those of the implicit one.
    fn leave_implicit(&mut self) -> Result<(), Error> {
        let (since, before, multiplications) = self.choosing.since;
        let work = self.stepper.work();
        let steps = work.steps - before.steps;
        if steps < WINDOW {
            return Ok(());
        }
        let span = (self.stepper.t() - since).abs();
        let multiplications = self.stepper.multiplications() - multiplications;
        let coordinates = self.stepper.q().as_slice().len().max(1);
        let implicit = (work.evaluations - before.evaluations) as f64
            + multiplications / (MULTIPLICATIONS * coordinates as f64);
        let as_long = EVALUATIONS * steps as f64;
        let (as_before, rate_before) = match self.choosing.measured {
            Some((measured, rate)) => (measured * span, rate),
            None => (f64::INFINITY, 0.0),
        };
        self.begin_window();
        if as_long.min(as_before) >= implicit {
            self.choosing.paying = 0;
            self.choosing.has_paid = true;
            return Ok(());
        }
        let Some(rate) = self.stepper.fastest_rate() else {
            return Ok(());
        };
        let stable = EVALUATIONS * rate * span / REACH;
        let faster = if rate_before > 0.0 {
            (rate / rate_before).max(1.0)
        } else {
            1.0
        };
        let explicit = stable.max(as_long).min(as_before * faster);
        if explicit >= implicit {
            self.choosing.paying = 0;
            self.choosing.has_paid = true;
            return Ok(());
        }
        self.choosing.paying += 1;
        if self.choosing.paying < self.choosing.needed {
            return Ok(());
        }
        if self.choosing.has_paid {
            self.choosing.needed *= 2;
        } else {
            let between = self.choosing.between_tests.saturating_mul(PATIENCE);
            self.choosing.between_tests = between;
            self.stepper.test_stiffness_every(between);
        }
        let now = (self.stepper.t(), self.stepper.work());
        self.choosing.marks = [now; 2];
        self.go_on_by(Method::DOP853, MethodReason::NotStiff { rate })
    }

    fn go_on_by(&mut self, method: &'static Method, reason: MethodReason) -> Result<(), Error> {
        if let Err(error) = self.stepper.go_on_with_method(method) {
            let (q, v) = (self.stepper.q(), self.stepper.v());
            return Err(self.model.explain(error, q, v));
        }
        if let Some(steps) = &mut self.record.steps {
            steps.go_on_by(method);
        }
        let t = self.stepper.t();
        // A method that was chosen at the start and left before the first step was never used.
        if (self.choosing.choices.last()).is_some_and(|last| last.t == t) {
            self.choosing.choices.pop();
        }
        self.choosing
            .choices
            .push(MethodChoice { t, method, reason });
        Ok(())
    }
}
