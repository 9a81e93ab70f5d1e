//! Chooses the method of a run, and decides when to change it.
//!
//! All decisions follow from counts of operations, steps and evaluations and from the state, never from a clock. So the same call gives
//! the same bits.
//!
//! * At the start the costs decide: of a step by Taylor series, and of the steps of `dop853` that cover it. Their number is known within a factor
//!   of [`SPREAD`]; if that does not decide, it is measured at the start.
//! * If the series is derived on demand, a run begins with `dop853`. Once its steps so far and those to come are worth the derivation
//!   ([`INVESTED`], [`WORTH`]), the series is derived and the same is decided at the state that the run has reached. Of a derivation that many runs
//!   share, each counts its part. If a single step is worth that, the run decides at its start.
//! * If stability limits explicit steps, the run changes to a Radau method. The test of DOP853 detects this, and in series the fastest
//!   rate of the machine does.
//! * It changes from a Radau method back to `dop853` if its steps have cost more than explicit ones would: evaluations, and the solution of
//!   linear equations, in evaluations. Explicit ones would cost what those before the change have cost, more where the machine is faster
//!   than there, or else what stable ones cost that are no longer than the implicit ones.

use super::Run;
use super::comparing::compare;
use crate::balance::Quadratures;
use crate::control::Work;
use crate::inputs::InputLaw;
use crate::methods::{Method, MethodKind, RADAU_OF_HIGH_ORDER};
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
pub(super) const EVALUATIONS: f64 = 12.0;

/// The search for the end of assumptions that are not linear, in a step by series, takes about as long as this many evaluations, with 12 coefficients as
/// well as with 20: half of a step of the spherical pendulum, measured where no bounds of the coordinates decided (`docs/benchmarks.md`).
const SEARCH: f64 = 5.0;

/// The number of steps of `dop853` that do as one step by series, measured in runs of many machines, is at most so many times larger or smaller
/// than what is [assumed](steps_for_one) for all (`docs/benchmarks.md`).
const SPREAD: f64 = 1.5;

/// The number of steps of `dop853` that end a run with the error of one step by series, as a multiple of that with the same error in a single step, with
/// 12 and with 20 coefficients, for machines without and with dampers: geometric means over those of `docs/benchmarks.md`. Errors of the energy
/// of a conservative machine stay. Those of `dop853` have the same sign in many consecutive steps; those of series, which contain high
/// derivatives of the motion, change theirs often.
const ACCUMULATION: [[f64; 2]; 2] = [[1.57, 1.3], [1.13, 0.92]];

/// Series of 12 coefficients are taken where they cost less than this part of the steps of `dop853` with the same error: the root of 0.7, which is the ratio of
/// their numbers at the same tolerance over that at the same error. Where both cost about the same, the one whose error is nearer to the
/// tolerance serves better: that of series is smaller by up to 400 times.
const AT_COARSE_TOLERANCES: f64 = 0.84;

/// Number of explicit steps between stiffness tests: so small that the work until a stiff machine is detected is a small part of the work
/// of an implicit method for the whole motion.
const STEPS_BETWEEN_TESTS: usize = 100;

/// Number of steps by series between evaluations of the fastest rate, each of which takes some two evaluations for each coordinate: at first, and at most.
/// It doubles with each look that finds steps shorter than [`COMFORTABLE`] of what is stable.
pub(super) const STEPS_BETWEEN_LOOKS: [usize; 2] = [64, 1024];

/// Of steps by series, limited by accuracy, those of a harmonic motion are 0.55 of the longest that are stable.
const COMFORTABLE: f64 = 0.75;

/// A run that takes no more steps by series than this if all are as long as the first has no look at its start, which would take as long as some of
/// them. If its steps turn out to be shorter, the first look comes after so many, as between two looks.
const SHORT_RUN: usize = STEPS_BETWEEN_LOOKS[0];

/// A series is derived on demand when the evaluations by `dop853` so far take at least this share of the time that the derivation takes. A run that then ends
/// earlier than it is given, by an event, has lost at most so many times what it took before.
pub(super) const INVESTED: f64 = 0.25;

/// And when those to come, if steps stay as long as they have been, take so many times as long: steps by series then cost less than half of them.
pub(super) const WORTH: f64 = 2.0;

/// Stability limits a step by series if it is longer than this, in units of the inverse of the fastest rate: 0.86 of where the stability
/// regions of the series of orders 12 and 20 end on the negative real axis, 5.82 and 8.82. A harmonic motion of size 1 takes, at the same
/// tolerances, steps of at most 2.5 and 4.2.
const REACH_OF_SERIES: [f64; 2] = [5.0, 7.6];

/// Where the stability region of `dop853` ends, in the same units.
const REACH: f64 = 6.1;

/// An evaluation takes about as long as this many multiplications of linear equations for each coordinate: 17 to 24 ns, measured with the crusher
/// and chains of 8 and 16 links, where a multiplication takes 0.2 ns.
const MULTIPLICATIONS: f64 = 100.0;

/// Number of implicit steps that are evaluated together.
const WINDOW: usize = 8;

/// Number of consecutive windows in which explicit steps must cost less, and the largest: it doubles with each return to an explicit method
/// from one that had cost less in between.
const WINDOWS: [usize; 2] = [2, 16];

/// Least number of explicit steps by which the cost before a change to an implicit method is measured: of those that stability limits, the test
/// has seen 15.
pub(super) const MEASURED: usize = 16;

/// After a change to an implicit method that never cost less, so many times as many explicit steps are taken until the next test.
const PATIENCE: usize = 4;

/// Largest number of explicit steps between tests, as of an explicit method. An attempt of 16 implicit steps is then one part in 40 of the work.
const MOST_STEPS_BETWEEN_TESTS: usize = 1000;

/// State of the choice of methods in a run.
#[derive(Debug)]
pub(super) struct Choosing {
    /// Whether the run chooses its method, and whether it may change it at any instant: not with unilateral contacts.
    is_automatic: bool,
    is_free: bool,
    pub choices: Vec<MethodChoice>,
    /// Time, work and multiplications at the beginning of the window.
    since: (f64, Work, f64),
    /// The number of consecutive windows in which explicit steps would have cost less, and the number required.
    paying: usize,
    needed: usize,
    /// Two instants in the explicit steps so far, at least [`MEASURED`] steps apart, and the number of steps tried until then. The earlier one is
    /// where the measurement of their cost begins.
    marks: [(f64, usize); 2],
    /// Where the present method began.
    begun: (f64, usize),
    /// What explicit steps have cost before the change to the implicit method.
    before: Option<Explicit>,
    /// Whether the implicit method has cost less in any window since that change.
    has_paid: bool,
    between_tests: usize,
    /// The number of steps, of the whole run, after which the fastest rate is found next while it goes by series, and the number until the one after that.
    pub next_look: usize,
    between_looks: usize,
    /// The evaluations that take as long as the derivation of the series, or as this run's part of it, until it is derived; `None` if it never is.
    derivation: Option<f64>,
    /// Whether other runs share the derivation.
    is_shared: bool,
}

/// The cost of explicit steps before a change to an implicit method.
#[derive(Clone, Copy, Debug)]
struct Explicit {
    /// Evaluations per second of the motion.
    evaluations: f64,
    /// The fastest rate there, in 1/s.
    rate: f64,
}

impl Choosing {
    /// For a run whose method is given.
    pub fn none() -> Self {
        Self {
            is_automatic: false,
            is_free: false,
            choices: Vec::new(),
            since: (0.0, Work::default(), 0.0),
            paying: 0,
            needed: WINDOWS[0],
            marks: [(0.0, 0); 2],
            begun: (0.0, 0),
            before: None,
            has_paid: false,
            between_tests: STEPS_BETWEEN_TESTS,
            next_look: STEPS_BETWEEN_LOOKS[0],
            between_looks: STEPS_BETWEEN_LOOKS[0],
            derivation: None,
            is_shared: false,
        }
    }

    /// Whether the run may change its method.
    pub fn is_free(&self) -> bool {
        self.is_free
    }

    /// Whether the run chooses its method.
    pub fn is_automatic(&self) -> bool {
        self.is_automatic
    }

    /// For a run that begins with a method of its own choice, one of so many that share the derivation of the series.
    pub fn begun(t: f64, beginning: Beginning, may_change: bool, one_of: u64) -> Self {
        let Beginning { method, reason, .. } = beginning;
        Self {
            is_automatic: true,
            is_free: may_change,
            choices: [MethodChoice { t, method, reason }].into(),
            derivation: beginning.derivation,
            is_shared: one_of > 1,
            ..Self::none()
        }
    }
}

/// The finest tolerance of any coordinate, at size 1.
fn finest_tolerance<V: Vector>(tolerance: &Tolerance<V>) -> f64 {
    let absolute = tolerance.absolute.as_slice().iter();
    tolerance.relative + absolute.fold(f64::INFINITY, |least, x| least.min(*x))
}

/// The number of steps of `dop853` that cover one step by series at this tolerance with the same error at the end.
///
/// Steps of order p are proportional to τ^(1/(p + 1)), so the ratio is a power of the tolerance; its size at one tolerance is fitted to
/// the motions of `benches/time_against_error.rs` (`docs/benchmarks.md`). At the same tolerance the ratio is 0.7 of this, 0.9 at fine ones, but
/// the errors of series are then smaller: by up to 400 times at coarse tolerances, to a tenth of which series are computed.
fn steps_for_one(tolerance: f64) -> f64 {
    let (size, at, power) = match tolerance {
        coarse if coarse > taylor::FINE => (1.07, 2e-4, 1.0 / 9.0 - 1.0 / 13.0),
        middle if middle > 1e-8 => (1.95, 2e-6, 1.0 / 9.0 - 1.0 / 21.0),
        _ => (2.3, 2e-8, 1.0 / 9.0 - 1.0 / 21.0),
    };
    size * crate::math::power(at / tolerance, power)
}

/// The method that a run begins with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beginning {
    pub method: &'static Method,
    pub reason: MethodReason,
    /// The evaluations that the choice took.
    pub evaluations: usize,
    /// The evaluations that take as long as the derivation of the series, or as this run's part of it, if that is done on demand.
    pub derivation: Option<f64>,
}

impl Beginning {
    /// With `dop853`, as runs do where nothing speaks for another method.
    pub fn explicit() -> Self {
        Self::with(Method::DOP853, MethodReason::Explicit)
    }

    /// A choice without measurements.
    pub fn with(method: &'static Method, reason: MethodReason) -> Self {
        Self {
            method,
            reason,
            evaluations: 0,
            derivation: None,
        }
    }
}

/// The rest of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ahead {
    /// The signed distance from the end, in s.
    pub left: f64,
    /// Whether the energy balance is kept.
    pub keeps_balance: bool,
}

impl Ahead {
    /// What the energy balance adds, as [`System::powers_cost`] gives it; nothing if it is not kept.
    pub fn powers<S: System>(&self, system: &S) -> [f64; 3] {
        if self.keeps_balance {
            system.powers_cost()
        } else {
            [0.0; 3]
        }
    }
}

/// The evaluations that take as long as the part of each of so many runs in the derivation of the series, if that is done on demand.
pub(super) fn derivation_of_each<S: System>(system: &S, one_of: u64) -> Option<f64> {
    let derivation = system.series_derivation()?;
    Some(derivation / one_of.max(1) as f64)
}

/// The method to begin with at this state, for one of so many runs that share the derivation of the series. With unilateral contacts it is
/// explicit, and the run chooses between it and series after some flights.
pub(super) fn first<S: System>(
    system: &S,
    at: (f64, &S::Vector, &S::Vector),
    tolerance: &Tolerance<S::Vector>,
    (ahead, one_of): (Ahead, u64),
) -> Beginning {
    let derivation = derivation_of_each(system, one_of);
    if system.unilateral_contacts().len() != 0 {
        return Beginning {
            derivation: Some(derivation.unwrap_or(0.0)),
            ..Beginning::explicit()
        };
    }
    match derivation {
        Some(derivation) if WORTH * derivation > EVALUATIONS => Beginning {
            derivation: Some(derivation),
            ..Beginning::explicit()
        },
        _ => by_costs(system, at, tolerance, ahead).unwrap_or(Beginning::explicit()),
    }
}

/// The method that costs less from this state on: by series or `dop853`. `None` if there is no series.
///
/// Where the energy balance is kept, steps of both methods also integrate powers. `dop853` evaluates them at its stages, and they count in the cost of an
/// evaluation; a step by series, which has no stages, computes states within it for that.
pub(super) fn by_costs<S: System>(
    system: &S,
    (t, q, v): (f64, &S::Vector, &S::Vector),
    tolerance: &Tolerance<S::Vector>,
    ahead: Ahead,
) -> Option<Beginning> {
    system.check_series().ok()?;
    let costs = system.series_cost()?;
    let finest = finest_tolerance(tolerance);
    let order = usize::from(finest <= taylor::FINE);
    let inputs = system.default_inputs();
    let is_searched = !system.has_linear_assumptions()
        && system.assumptions(t, q, v, &inputs).len() != 0
        && !system.assumptions_hold_within([t; 2], [q; 2], [v; 2]);
    let search = if is_searched { SEARCH } else { 0.0 };
    let [more, of_powers @ ..] = ahead.powers(system);
    let cost = costs[order] + search + of_powers[order];
    let assumed = steps_for_one(finest);
    let of_step = EVALUATIONS * (1.0 + more);
    let mut saved = of_step * assumed;
    let mut evaluations = 0;
    if (saved / SPREAD..saved * SPREAD).contains(&cost) {
        let at = (t, q, v);
        if let Some(found) = compare(system, at, tolerance, (finest, ahead.left, assumed)) {
            let is_damped = usize::from(is_damped(system, (t, q)));
            saved = of_step * ACCUMULATION[is_damped][order] * found.steps;
            evaluations = found.evaluations;
        }
    }
    if order == 0 {
        saved *= AT_COARSE_TOLERANCES;
    }
    let (method, reason) = if cost < saved {
        (Method::TAYLOR, MethodReason::SeriesPays { cost, saved })
    } else {
        (Method::DOP853, MethodReason::SeriesCosts { cost, saved })
    };
    Some(Beginning {
        evaluations,
        ..Beginning::with(method, reason)
    })
}

/// Whether any damper takes power where all rates are 1.
fn is_damped<S: System>(system: &S, (t, q): (f64, &S::Vector)) -> bool {
    let mut v = q.zeros_like();
    v.as_mut_slice().fill(1.0);
    system.dissipation_rate(t, q, &v, &system.default_inputs()) != 0.0
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
        self.choosing.begun = self.tried();
        self.choosing.marks = [self.choosing.begun; 2];
        self.begin_series()
    }

    /// Leaves a series at once if stability limits it from here on. Does nothing where the run does not go by series.
    fn begin_series(&mut self) -> Result<(), Error> {
        let left = (self.until - self.stepper.t()).abs();
        let seems_short = |length: f64| SHORT_RUN as f64 * length >= left;
        if self.stepper.length_in_series().is_some_and(seems_short) {
            self.choosing.next_look = self.stepper.work().steps + SHORT_RUN;
            return Ok(());
        }
        match self.rate_beyond_series() {
            Some(rate) => self.change_method(Method::DOP853, MethodReason::Stiff { rate }),
            None => Ok(()),
        }
    }

    /// Changes to another method if that costs less. Call it after an accepted step, when no instant within the next one has to be met.
    pub(super) fn choose_again(&mut self) -> Result<(), Error> {
        if self.stepper.is_done() {
            return Ok(());
        }
        if <M::System as System>::MAY_COLLIDE && self.stepper.touching().is_some() {
            return self.choose_in_flight();
        }
        if !self.choosing.is_free {
            return Ok(());
        }
        if self.stepper.is_implicit() {
            return self.leave_implicit();
        }
        if self.stepper.coefficients().is_some() {
            let is_due = self.stepper.work().steps >= self.choosing.next_look;
            let rate = is_due.then(|| self.rate_beyond_series()).flatten();
            return match rate {
                Some(rate) => self.change_to_implicit(rate),
                None => Ok(()),
            };
        }
        self.mark();
        match self.stepper.stiff_since() {
            Some(_) => {
                let rate = self.stepper.fastest_rate().unwrap_or(0.0);
                self.change_to_implicit(rate)
            }
            None => self.consider_series(),
        }
    }

    /// Changes to series that are derived on demand, if deriving them is worth it and their steps cost less. Both are decided once.
    fn consider_series(&mut self) -> Result<(), Error> {
        let Some(derivation) = self.choosing.derivation else {
            return Ok(());
        };
        let ((since, before), (t, tried)) = (self.choosing.begun, self.tried());
        let left = self.until - t;
        // Steps that stability limits say nothing of accuracy. Where runs share the derivation, it may be worth fewer steps than a test for stiffness takes.
        let is_limited_by_accuracy = if self.choosing.is_shared {
            self.stepper.shows_no_stiffness()
        } else {
            self.stepper.is_not_stiff()
        };
        let so_far = EVALUATIONS * (tried - before) as f64;
        let to_come = so_far * (left / (t - since)).abs();
        if !is_limited_by_accuracy || so_far < INVESTED * derivation || to_come < WORTH * derivation
        {
            return Ok(());
        }
        self.choosing.derivation = None;
        let at = (t, self.stepper.q(), self.stepper.v());
        let keeps_balance = self.stepper.quadratures().integrals().is_some();
        let ahead = Ahead {
            left,
            keeps_balance,
        };
        let beginning = by_costs(self.model.system, at, self.stepper.tolerance(), ahead);
        let Some(beginning) = beginning else {
            return Ok(());
        };
        self.stepper.count_evaluations(beginning.evaluations);
        if beginning.method.kind != MethodKind::Series {
            return Ok(());
        }
        if (self.change_method(beginning.method, beginning.reason)).is_err() {
            return self.change_method(Method::DOP853, MethodReason::NoSeries);
        }
        self.begin_series()
    }

    /// Changes to an explicit method if a step by series has no value, or none that is long enough; returns whether it does.
    pub(super) fn leave_series(&mut self, error: &StepError) -> bool {
        let is_of_series = matches!(
            error,
            StepError::Singular { .. }
                | StepError::NoSeries { .. }
                | StepError::NotFinite { .. }
                | StepError::StepTooSmall { .. }
        );
        let leaves = (self.choosing.is_free || self.flights.by_series)
            && is_of_series
            && self.stepper.coefficients().is_some()
            && self
                .change_method(Method::DOP853, MethodReason::NoSeries)
                .is_ok();
        if leaves {
            self.stepper.lengthen_step_that_is_too_small();
        }
        leaves
    }

    /// The fastest rate, if it makes steps by series unstable.
    pub(super) fn rate_beyond_series(&mut self) -> Option<f64> {
        let length = self.stepper.length_in_series()?;
        let is_fine = finest_tolerance(self.stepper.tolerance()) <= taylor::FINE;
        let reach = REACH_OF_SERIES[usize::from(is_fine)];
        let rate = self.stepper.fastest_rate().unwrap_or(0.0);
        let choosing = &mut self.choosing;
        choosing.next_look = self.stepper.work().steps + choosing.between_looks;
        let [fewest, most] = STEPS_BETWEEN_LOOKS;
        choosing.between_looks = match length * rate {
            product if product < COMFORTABLE * reach => most.min(2 * choosing.between_looks),
            _ => fewest,
        };
        (length * rate > reach && length.is_finite()).then_some(rate)
    }

    /// The present instant and the number of steps tried so far. Evaluations would not do, since a record of the run takes some as well.
    fn tried(&self) -> (f64, usize) {
        let Work {
            steps, rejected, ..
        } = self.stepper.work();
        (self.stepper.t(), steps + rejected)
    }

    /// Remembers where the explicit steps are, from time to time.
    fn mark(&mut self) {
        let now = self.tried();
        let [_, last] = self.choosing.marks;
        if now.1 >= last.1 + MEASURED {
            self.choosing.marks = [last, now];
        }
    }

    /// What the latest explicit steps have cost, if there were enough of them.
    fn cost_of_explicit(&self, rate: f64) -> Option<Explicit> {
        let ((since, before), (t, tried)) = (self.choosing.marks[0], self.tried());
        let evaluations = EVALUATIONS * (tried - before) as f64 / (t - since).abs();
        let is_measured = self.stepper.coefficients().is_none() && tried >= before + MEASURED;
        (is_measured && evaluations.is_finite()).then_some(Explicit { evaluations, rate })
    }

    fn change_to_implicit(&mut self, rate: f64) -> Result<(), Error> {
        let method = implicit(finest_tolerance(self.stepper.tolerance()));
        self.choosing.before = self.cost_of_explicit(rate);
        self.choosing.has_paid = false;
        self.choosing.paying = 0;
        self.begin_window();
        self.change_method(method, MethodReason::Stiff { rate })
    }

    fn begin_window(&mut self) {
        let stepper = &self.stepper;
        self.choosing.since = (stepper.t(), stepper.work(), stepper.multiplications());
    }

    /// Returns to an explicit method if that would have cost less.
    fn leave_implicit(&mut self) -> Result<(), Error> {
        let (since, before, multiplications) = self.choosing.since;
        let work = self.stepper.work();
        let steps = work.steps - before.steps;
        if steps < WINDOW {
            return Ok(());
        }
        let multiplications = self.stepper.multiplications() - multiplications;
        let coordinates = self.stepper.q().as_slice().len().max(1);
        let implicit = (work.evaluations - before.evaluations) as f64
            + multiplications / (MULTIPLICATIONS * coordinates as f64);
        let span = (self.stepper.t() - since).abs();
        self.begin_window();

        // Explicit steps are no longer than the implicit ones, since they are not known to be more accurate, and they are stable; but they cost no
        // more than before the change where the machine is no faster.
        let as_long = EVALUATIONS * steps as f64;
        let known = self.choosing.before;
        let as_before = known.map_or(f64::INFINITY, |of| span * of.evaluations);
        let rate_before = known.map_or(0.0, |of| of.rate);
        let explicit = |rate: f64| {
            let stable = EVALUATIONS * rate * span / REACH;
            let faster = if rate > rate_before {
                rate / rate_before
            } else {
                1.0
            };
            stable.max(as_long).min(as_before * faster)
        };
        // The rate costs as much as some evaluations. It is found only where explicit steps cost less at the lowest.
        let may_pay = as_long.min(as_before) < implicit;
        let rate = may_pay.then(|| self.stepper.fastest_rate()).flatten();
        let Some(rate) = rate.filter(|rate| explicit(*rate) < implicit) else {
            self.choosing.paying = 0;
            self.choosing.has_paid = true;
            return Ok(());
        };
        self.choosing.paying += 1;
        if self.choosing.paying < self.choosing.needed {
            return Ok(());
        }
        if self.choosing.has_paid {
            self.choosing.needed = (2 * self.choosing.needed).min(WINDOWS[1]);
            self.choosing.between_tests = STEPS_BETWEEN_TESTS;
        } else {
            let more = PATIENCE * self.choosing.between_tests;
            self.choosing.between_tests = more.min(MOST_STEPS_BETWEEN_TESTS);
        }
        self.stepper
            .test_stiffness_every(self.choosing.between_tests);
        self.change_method(Method::DOP853, MethodReason::NotStiff { rate })
    }

    pub(super) fn change_method(
        &mut self,
        method: &'static Method,
        reason: MethodReason,
    ) -> Result<(), Error> {
        if let Err(error) = self.stepper.change_method(method) {
            let (q, v) = (self.stepper.q(), self.stepper.v());
            return Err(self.model.explain(error, q, v));
        }
        self.choosing.begun = self.tried();
        self.choosing.marks = [self.choosing.begun; 2];
        self.note_method(method, reason);
        Ok(())
    }

    /// Takes note of the method by which the run goes on.
    pub(super) fn note_method(&mut self, method: &'static Method, reason: MethodReason) {
        if let Some(steps) = &mut self.record.steps {
            steps.begin_method(method);
        }
        let t = self.stepper.t();
        // A method that was chosen at the start and left before the first step was never used.
        let choices = &mut self.choosing.choices;
        choices.pop_if(|last| last.t == t);
        // One that was left and resumed at one instant goes on for its first reason.
        if !(choices.last()).is_some_and(|last| std::ptr::eq(last.method, method)) {
            choices.push(MethodChoice { t, method, reason });
        }
    }
}
