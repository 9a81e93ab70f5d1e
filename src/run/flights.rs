//! Flights of a machine with unilateral contacts, in which all of them are open: its motion is then that of the machine without contacts, which may have a
//! Taylor series. Such a run goes by series in flights, and by `dop853` while a contact is closed.
//!
//! A run by [`TAYLOR`](crate::TAYLOR) does so throughout; and while contacts are closed it goes by the series of the machine with their forces, where there is one. One that
//! chooses its method begins with `dop853` and decides once, from the flights so far, by
//! counts: if flights are short, most of the work is done where contacts change.
//!
//! * `dop853` takes a step in which it finds the change, makes its dense output, and takes the step up to the change, on average with one correction.
//! * A motion by series is expanded at the end of the step in which the change is found, and once more after the change. The step up to the change is the value of a
//!   polynomial that is known.

use super::Run;
use super::choosing::{
    Ahead, Beginning, EVALUATIONS, INVESTED, MEASURED, STEPS_BETWEEN_LOOKS, WORTH, by_costs,
};
use crate::balance::Quadratures;
use crate::contact::UnilateralState;
use crate::inputs::InputLaw;
use crate::methods::{Method, MethodKind};
use crate::solution::MethodReason;
use crate::{Error, Machine};

/// The evaluations that a change in a flight takes by `dop853` beyond those of the step up to it: a step, dense output, and a correction.
const FINDING: f64 = 2.0 * EVALUATIONS + 3.0;

/// The expansions that a change takes by series beyond those of whole steps before it: on average half a step is left, whose end is beyond the
/// change, and the flight begins with one.
const EXPANSIONS: f64 = 1.5;

/// The evaluations that it takes to change to `dop853` and back where contacts close: a step that is rejected.
const LANDING: f64 = EVALUATIONS;

/// How the flights of a run are integrated.
#[derive(Debug, Default)]
pub(super) struct Flights {
    /// Whether they go by series.
    pub by_series: bool,
    /// Whether the motion goes by series while contacts are closed, where it has one.
    closes_by_series: bool,
    /// The evaluations that take as long as the derivation of the series, as long as the run has not decided about series; `None` once it has.
    derivation: Option<f64>,
    /// The number of steps in flights without a change, of changes at the ends of flights, and of those after which a contact is closed.
    steps: usize,
    changes: usize,
    landings: usize,
    /// Whether the present motion is a flight.
    flies: bool,
}

impl Flights {
    /// For a run with these settings of a machine with unilateral contacts: by series from its start on, or as it may decide later.
    pub fn new(by_series: bool, chosen: Option<Beginning>) -> Self {
        Self {
            by_series,
            closes_by_series: by_series,
            derivation: chosen.and_then(|beginning| beginning.derivation),
            ..Self::default()
        }
    }
}

impl<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> Run<'_, '_, M, L, A> {
    /// Goes on by the method for what contacts do now, after they have changed.
    pub(super) fn follow_flights(&mut self) -> Result<(), Error> {
        let touching = self.stepper.touching().as_ref();
        let flies = touching.is_some_and(UnilateralState::leaves_accelerations);
        let flights = &mut self.flights;
        if flights.flies {
            flights.changes += 1;
            flights.landings += usize::from(!flies);
        }
        flights.flies = flies;
        if !flights.by_series {
            return Ok(());
        }
        let closes_by_series = flights.closes_by_series;
        let (method, reason) = if flies {
            (Method::TAYLOR, MethodReason::Open)
        } else if closes_by_series && self.stepper.has_closed_series() {
            (Method::TAYLOR, MethodReason::ClosedInSeries)
        } else {
            (Method::DOP853, MethodReason::Closed)
        };
        if self.stepper.change_where_contacts_did(method).is_ok() {
            self.note_method(method, reason);
            return Ok(());
        }
        self.change_method(Method::DOP853, MethodReason::NoSeries)
    }

    /// Decides after a step whether flights go by series from now on, and whether they go on so.
    pub(super) fn choose_in_flight(&mut self) -> Result<(), Error> {
        if !self.flights.flies || self.stepper.is_time_stepping() {
            return Ok(());
        }
        if self.flights.by_series {
            let is_due = self.choosing.is_automatic()
                && self.stepper.coefficients().is_some()
                && self.stepper.work().steps >= self.choosing.next_look;
            return if is_due {
                self.leave_unstable_series()
            } else {
                Ok(())
            };
        }
        let Some(derivation) = self.flights.derivation else {
            return Ok(());
        };
        self.flights.steps += 1;
        let Flights {
            steps,
            changes,
            landings,
            ..
        } = self.flights;
        let [whole, changes, landings] = [steps, changes, landings].map(|count| count as f64);
        let explicit = EVALUATIONS * (whole + changes) + FINDING * changes;
        let t = self.stepper.t();
        let left = self.until - t;
        let to_come = explicit * (left / (t - self.start)).abs();
        if steps < MEASURED || explicit < INVESTED * derivation || to_come < WORTH * derivation {
            return Ok(());
        }
        self.flights.derivation = None;
        let at = (t, self.stepper.q(), self.stepper.v());
        let ahead = Ahead {
            left,
            keeps_balance: self.settings.energy_balance,
        };
        let known = by_costs(self.model.system, at, self.stepper.tolerance(), ahead);
        let Some(known) = known else {
            return Ok(());
        };
        self.stepper.count_evaluations(known.evaluations);
        let (cost, saved) = match known.reason {
            MethodReason::SeriesPays { cost, saved }
            | MethodReason::SeriesCosts { cost, saved } => (cost, saved),
            _ => return Ok(()),
        };
        // Each evaluation of `dop853` also takes that of the powers of the energy balance.
        let [powers, ..] = ahead.powers(self.model.system);
        let of_evaluation = 1.0 + powers;
        let explicit = of_evaluation * explicit;
        // As many steps of `dop853` take the time of one by series.
        let ratio = saved / (of_evaluation * EVALUATIONS);
        let in_series = (whole + 0.5 * changes) / ratio;
        let landing = of_evaluation * LANDING;
        let by_series = cost * (in_series + EXPANSIONS * changes) + landing * landings;
        let pays = by_series < explicit;
        if !pays {
            return Ok(());
        }
        let of_each = in_series + 0.5 * changes;
        let reason = MethodReason::SeriesPays {
            cost: by_series / of_each,
            saved: explicit / of_each,
        };
        self.flights.by_series = true;
        self.choosing.next_look = self.stepper.work().steps + STEPS_BETWEEN_LOOKS[0];
        if self.change_method(Method::TAYLOR, reason).is_err() {
            self.flights.by_series = false;
            return self.change_method(Method::DOP853, MethodReason::NoSeries);
        }
        self.leave_unstable_series()
    }

    /// Goes on without series if stability limits them.
    fn leave_unstable_series(&mut self) -> Result<(), Error> {
        match self.rate_beyond_series() {
            Some(rate) => {
                self.flights.by_series = false;
                self.change_method(Method::DOP853, MethodReason::Stiff { rate })
            }
            None => Ok(()),
        }
    }

    /// The method that locates every event of contacts, where one of them is closed.
    pub(super) fn method_with_contacts(&self) -> &'static Method {
        explicit_for(self.settings.method)
    }
}

/// The method of a run that is by this one while a contact is closed and the motion has no series.
pub(super) fn explicit_for(method: &'static Method) -> &'static Method {
    if method.kind == MethodKind::Series {
        Method::DOP853
    } else {
        method
    }
}
