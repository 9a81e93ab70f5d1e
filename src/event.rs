//! Events: instants at which a function of the state changes its sign.
//!
//! The function is evaluated at eight points of each step, along the quintic through the ends of the step, which costs no evaluation of the machine.
//! These values and the decay of their Chebyshev coefficients bound the function in between ([`roots::sign_changes`]), which
//! shows for most steps that there is no root. Roots are located on the dense output of the step, to the rounding of time. If there may be more than
//! one, all of them are isolated first ([`roots::isolating_fractions`]), so a function that changes its sign twice within a step has two events. A function that only
//! touches zero has none. For an event that ends the run, the step is repeated up to the root and its length corrected until the function
//! is 0 to rounding at the *end of the step*. So the final state is as accurate as any other.
//!
//! A step by Taylor series is long and its polynomial as accurate as the step, so all roots are isolated at once.
//!
//! A function that is 0 to rounding at the start of a run has no sign there: a run that continues from an event starts at the root or
//! within rounding of it. Its sign is the one just after the start, sought at fractions of the first step that grow by factors of four
//! from the rounding of time. So the root at the start is not found again, and a bounce is found even if it is much shorter than the step.
//!
//! Where contacts change, rates and forces jump, and a function may be 0 exactly there: a height that an impact turns around. Whether it is 0 is decided
//! within the rounding that the contacts themselves allow for gaps and rates at rest. If it is, its sign just after that instant decides: a function
//! with the same sign on both sides touches zero and has no event, one with the other sign, or that stays at zero, has one event at that instant. A
//! function that jumps over zero has one, too. A step of time stepping in which contacts close counts like such an instant: only the values at its ends are compared,
//! since impacts are not located within it.

mod followed;
mod last_step;
mod root;

use std::boxed::Box;
use std::string::String;
use std::vec::Vec;

use crate::callbacks::{Observe, Watched};
use crate::inputs::{InputLaw, LawInPiece};
use crate::interpolant::Interpolant;
use crate::observation::ObservedSystem;
use crate::roots;
use crate::stepper::Stepper;
use crate::{Coordinates, Error, Machine, Quadratures, State, System, Vector};
use followed::{Change, FollowedSign, sign};

pub(crate) use last_step::{
    Triple, at_fractions, interpolated_at, is_long, state, state_at, state_into, step_motion,
    theta_roundoff, turn,
};
pub(crate) use root::{last_positive, root};

/// Fractions of a step at which the sign is evaluated if it changes at most once.
pub(crate) const SAMPLE_FRACTIONS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// Rounding allowance at the start of a run: for the time of the event from which it continues, for the step that ended there, and for a function
/// of some ten operations.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Where contacts change, coordinates and rates are known to this share of themselves: what contacts allow for a gap that is closed and for rest.
pub(crate) const ROUNDING_AT_CHANGE: f64 = crate::contact::ROUNDING;

/// A value at the end of a step may be zero to rounding if it is at most this share of the greatest values in the step, or of how it changes in the
/// last hundredth of the step; only then is its rounding estimated.
const SUSPECT: f64 = 1e-6;

/// Which changes of sign count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Crossing {
    /// From below zero to above.
    Rising,
    /// From above zero to below.
    Falling,
    /// Either way.
    Any,
}

impl Crossing {
    /// The direction of a crossing, forward in time, of a function that had this sign before it in the order of the run.
    fn from(side_before: f64, forward: bool) -> Self {
        if (side_before < 0.0) == forward {
            Self::Rising
        } else {
            Self::Falling
        }
    }

    /// Whether a crossing in this direction counts.
    pub(crate) fn counts(self, way: Self) -> bool {
        self == Self::Any || self == way
    }
}

/// An event that happened.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Event<C> {
    /// Which.
    pub name: String,
    /// Which way its function went through zero, forward in time: `Rising` or `Falling`.
    pub crossing: Crossing,
    /// Time and state. The function is 0 here to the rounding of time and state. If the event ended the
    /// run, this is the run's end, and as exact as the end of any step; else it is on the dense output of
    /// its step, and its time is as exact as that.
    pub state: State<C>,
}

/// An event to watch for.
pub(crate) struct Watch<'a, M: Machine> {
    pub name: String,
    pub crossing: Crossing,
    /// How many more times it may happen: the last of them ends the run. Any number, if there is none.
    pub left: Option<usize>,
    pub function: Box<dyn Watched<'a, M> + 'a>,
    /// The sign that the function has had last, 0 from where it was zero.
    pub side: f64,
    /// The sign that it had before it was zero where contacts changed, as long as the sign that it has after that is not known; else 0.
    pub touched: f64,
    /// What the function must exceed before its sign counts, after it was zero to rounding.
    pub leave: f64,
    /// Its value at the end of the last step, if nothing has jumped there.
    pub latest: Option<f64>,
    /// Its value at the end of the last step, before anything jumped there; not a number if it is not known.
    pub at_end: f64,
    /// Whether its sign at the start is known.
    pub begun: bool,
    /// Whether the run starts from this very event.
    pub at_zero: bool,
}

impl<M: Machine> Clone for Watch<'_, M> {
    fn clone(&self) -> Self {
        Self {
            name: self.name.clone(),
            function: self.function.clone(),
            ..*self
        }
    }
}

/// How the last step ends, for the functions that are watched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum EndOfStep {
    /// The motion continues smoothly.
    Smooth,
    /// Contacts change there, or impulses may have been given.
    Change,
    /// Contacts have closed somewhere in the step, by time stepping.
    Impacts,
}

/// What rounding may make of a function that is zero: by changes that grow with it, and by jumps of the function.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RoundingOfValue {
    smooth: f64,
    jumps: f64,
}

impl RoundingOfValue {
    fn is_zero(&self, value: f64) -> bool {
        value.abs() <= self.smooth + self.jumps
    }

    /// What a function with this value must exceed before its sign counts.
    fn to_leave(self, value: f64) -> f64 {
        if self.jumps > 0.0 {
            0.0
        } else {
            2.0 * self.smooth.max(value.abs())
        }
    }
}

/// A state with its accelerations, and how well its numbers are known: a share of each of them, where rates count with a given size at least, and
/// the rounding of time.
pub(crate) struct KnownState<'x, V> {
    pub t: f64,
    pub q: &'x V,
    pub v: &'x V,
    pub a: &'x V,
    pub share: f64,
    /// Rates that these numbers had before a jump.
    pub v_before: &'x V,
    /// Rounding of time, in s.
    pub tick: f64,
}

/// A change of sign within the last step.
struct SignChange {
    watch: usize,
    theta: f64,
    side_before: f64,
}

/// An event that ends a run, as it is seen on the dense output.
pub(crate) struct Terminal {
    /// Which watch.
    pub watch: usize,
    pub crossing: Crossing,
    /// Time, in s.
    pub t: f64,
    /// The rate of the function there, if it is as good as linear near its zero.
    pub slope: Option<f64>,
}

impl<M: Machine> Watch<'_, M> {
    /// Counts one more of these events; says whether it ends the run.
    pub fn counts(&mut self) -> bool {
        match &mut self.left {
            None => false,
            Some(left) => {
                *left = left.saturating_sub(1);
                *left == 0
            }
        }
    }

    /// The function's value, which must be a number.
    pub fn value(
        &mut self,
        state: &State<Coordinates<M>>,
        observe: Observe<'_, M>,
    ) -> Result<f64, Error> {
        let value = (self.function)(state, observe)?;
        if value.is_nan() {
            return Err(Error::EventNotFinite {
                event: self.name.clone(),
                t: state.t,
            });
        }
        Ok(value)
    }

    /// Looks at the function at the start of a run. `at_zero` says that it starts from this very event.
    pub fn begin(
        &mut self,
        state: &State<Coordinates<M>>,
        at_zero: bool,
        observe: Observe<'_, M>,
    ) -> Result<(), Error> {
        let value = self.value(state, observe)?;
        self.at_zero = at_zero;
        self.side = if at_zero { 0.0 } else { sign(value) };
        self.touched = 0.0;
        self.latest = Some(value);
        self.at_end = value;
        self.begun = false;
        Ok(())
    }

    /// Whether the function starts from zero to rounding, once the length of the first step is known.
    fn settle<L: InputLaw<M::System>, A: Quadratures<M::System>>(
        &mut self,
        observed_system: &ObservedSystem<'_, M::System, L>,
        stepper: &StepperOf<'_, M, L, A>,
    ) -> Result<(), Error> {
        self.begun = true;
        let known = KnownState {
            t: stepper.t_before(),
            q: stepper.q_before(),
            v: stepper.v_before(),
            a: stepper.a_before(),
            share: ROUNDING,
            v_before: stepper.v_before(),
            tick: ROUNDING * stepper.t_before().abs().max(stepper.last_step().abs()),
        };
        let (value, rounding) = self.value_and_rounding(observed_system, stepper, &known)?;
        if self.side == 0.0 || rounding.is_zero(value) {
            self.side = 0.0;
            self.leave = rounding.to_leave(value);
        }
        Ok(())
    }

    /// The value at a state, and what rounding may have made of it if it is zero.
    ///
    /// Each number of the state is moved by its own rounding, and by as much as it moves in the rounding
    /// of time; what that changes is what rounding may have made of a zero. A change that does not grow
    /// with the move is a jump of the function, which has the right sign on either side.
    pub fn value_and_rounding<L: InputLaw<M::System>, A: Quadratures<M::System>>(
        &mut self,
        observed_system: &ObservedSystem<'_, M::System, L>,
        stepper: &StepperOf<'_, M, L, A>,
        known: &KnownState<'_, VectorOf<M>>,
    ) -> Result<(f64, RoundingOfValue), Error> {
        let system = observed_system.system;
        let mut value_of = |state: &State<Coordinates<M>>| {
            let observe = || observed_system.observe::<M, A>(stepper, state);
            (self.function)(state, &observe)
        };
        let &KnownState { t, share, tick, .. } = known;
        let (q, v) = (known.q, known.v);
        let value = value_of(&state(system, (t, q.clone(), v.clone())))?;
        if value.is_nan() {
            return Err(Error::EventNotFinite {
                event: self.name.clone(),
                t,
            });
        }
        let n = q.as_slice().len();
        let (mut smooth, mut jumps) = (0.0, 0.0);
        for number in 0..=2 * n {
            let mut moved = |times: f64| {
                let (mut t, mut q, mut v) = (t, q.clone(), v.clone());
                match number {
                    0 => t += times * ROUNDING * t.abs(),
                    i if i <= n => {
                        let rate = v.as_slice()[i - 1].abs();
                        let q = &mut q.as_mut_slice()[i - 1];
                        *q += times * (share * q.abs() + rate * tick);
                    }
                    i => {
                        let rate = known.a.as_slice()[i - n - 1].abs();
                        let size = known.v_before.as_slice()[i - n - 1].abs();
                        let v = &mut v.as_mut_slice()[i - n - 1];
                        *v += times * (share * v.abs().max(size) + rate * tick);
                    }
                }
                (value_of(&state(system, (t, q, v))).unwrap_or(f64::NAN) - value).abs()
            };
            let mut by = [0.0; 2];
            for (by, times) in by.iter_mut().zip([1.0, 16.0]) {
                let most = moved(times).max(moved(-times));
                // What is not a number there says nothing.
                *by = if most.is_finite() { most } else { 0.0 };
            }
            if by[1] < 4.0 * by[0] {
                jumps += by[0]
            } else {
                smooth += by[0]
            }
        }
        Ok((value, RoundingOfValue { smooth, jumps }))
    }

    /// If the function is zero to rounding at the end of the last step, what it must exceed before its sign counts again.
    fn zero_at_end<L: InputLaw<M::System>, A: Quadratures<M::System>>(
        &mut self,
        observed_system: &ObservedSystem<'_, M::System, L>,
        stepper: &StepperOf<'_, M, L, A>,
    ) -> Result<Option<f64>, Error> {
        let at_end = at_end(stepper, stepper.v());
        let (value, rounding) = self.value_and_rounding(observed_system, stepper, &at_end)?;
        Ok((rounding.is_zero(value)).then(|| rounding.to_leave(value)))
    }

    /// Records the value after a change of contacts, with its round-off if it may be zero. Returns the direction, forward in time, in which the
    /// function has crossed zero there, if it has.
    pub fn jump(
        &mut self,
        value: f64,
        rounding: Option<RoundingOfValue>,
        forward: bool,
    ) -> Option<Crossing> {
        let before = if self.side == 0.0 {
            self.touched
        } else {
            self.side
        };
        let rounding = rounding.filter(|rounding| rounding.is_zero(value));
        if rounding.is_some() || value == 0.0 {
            self.touched = before;
            self.side = 0.0;
            self.leave = rounding.map_or(0.0, |rounding| rounding.to_leave(value));
            return None;
        }
        (self.side, self.touched, self.leave) = (sign(value), 0.0, 0.0);
        let crosses = before != 0.0 && before != self.side;
        crosses.then(|| Crossing::from(before, forward))
    }

    /// Records the value after an impact at the start, if the function has changed there.
    pub fn jump_at_start(&mut self, value: f64, rounding: RoundingOfValue) {
        let before = self.at_end;
        if self.at_zero || value == before {
            return;
        }
        // A value before the impact that is small beside the one after it may have been a zero.
        let had_sign = before.abs() > SUSPECT * value.abs() && !rounding.is_zero(before);
        self.begun = true;
        self.touched = if had_sign { sign(before) } else { 0.0 };
        self.side = 0.0;
        self.leave = if rounding.is_zero(value) {
            rounding.to_leave(value)
        } else {
            0.0
        };
    }

    /// Changes of sign between looks at the function, which `value_at` gives at fractions of the
    /// step. `ending` is what the function must exceed before its sign counts again, where the step ends
    /// with a change of contacts and the function is zero to rounding there. A step that `is_known_at_end` only is not looked at within.
    fn changes(
        &mut self,
        (looks, is_known_at_end): (&[f64], bool),
        roundoff: f64,
        ending: Option<f64>,
        mut value_at: impl FnMut(&mut Self, f64) -> Result<f64, Error>,
        mut found: impl FnMut(&mut Self, Change) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let mut sign = FollowedSign::new(self.side, self.touched, self.leave);
        // Where it starts from zero, it may leave it and be back long before a quarter of the step.
        let least = if sign.side == 0.0 && !is_known_at_end {
            16.0 * roundoff
        } else {
            looks[0]
        };
        let small = core::iter::successors(Some(least), |theta| Some(4.0 * theta));
        let small = small.take_while(|theta| *theta < looks[0]);
        for theta in small.chain(looks.iter().copied()) {
            let value = value_at(self, theta)?;
            sign.look(theta, value, |change| found(self, change))?;
        }
        sign.end(ending, is_known_at_end, |change| found(self, change))?;
        (self.side, self.touched, self.leave) = (sign.side, sign.touched, sign.leave);
        Ok(())
    }

    /// Whether and where to look for events in the last step, and what the function must exceed before its sign counts again if it is zero to
    /// rounding at the end of the step; `None` if there is no event. `sampled` are the states at the [fractions](roots::FRACTIONS) of the step,
    /// once a function has needed them.
    fn suspect<L: InputLaw<M::System>, A: Quadratures<M::System>>(
        &mut self,
        (end, is_long): (EndOfStep, bool),
        observed_system: &ObservedSystem<'_, M::System, L>,
        stepper: &mut StepperOf<'_, M, L, A>,
        interpolant: &mut Option<Interpolant<VectorOf<M>>>,
        sampled: &mut Option<[State<Coordinates<M>>; roots::FRACTIONS.len()]>,
    ) -> Result<Option<(Places, Option<f64>)>, Error> {
        if !self.begun {
            self.settle(observed_system, stepper)?;
        }
        let known = self.latest.take();
        self.at_end = f64::NAN;
        if is_long {
            let may_end_at_zero = end != EndOfStep::Smooth;
            let ending = may_end_at_zero.then(|| self.zero_at_end(observed_system, stepper));
            return Ok(Some((Places::All, ending.transpose()?.flatten())));
        }
        let system = observed_system.system;
        let states = match sampled {
            Some(states) => states,
            None => {
                let all = at_fractions(system, stepper, interpolant)?;
                sampled.insert(all.map(|at| state(system, at)))
            }
        };
        self.look_at_fractions((states, known), end, observed_system, stepper)
    }

    /// Evaluates the motion where there may be events of the last step, and calls `found` with the fraction of each event and the sign before it.
    fn locate<L: InputLaw<M::System>, A: Quadratures<M::System>>(
        &mut self,
        (places, ending): (Places, Option<f64>),
        end: EndOfStep,
        observed_system: &ObservedSystem<'_, M::System, L>,
        stepper: &StepperOf<'_, M, L, A>,
        interpolant: &Interpolant<VectorOf<M>>,
        (shall_stop, mut found): (ShallStop<'_, '_, VectorOf<M>>, impl FnMut(f64, f64)),
    ) -> Result<(), Unsearched> {
        let system = observed_system.system;
        let roundoff = theta_roundoff(stepper);
        let exact = |watch: &mut Self, theta: f64| {
            if theta == 1.0 && ending.is_some() {
                return Ok(0.0);
            }
            let at = state_at(system, stepper, interpolant, theta)?;
            let value = watch.value_in_step(&state(system, at), observed_system, stepper)?;
            if theta == 1.0 {
                watch.at_end = value;
            }
            Ok(value)
        };
        let is_known_at_end = end == EndOfStep::Impacts;
        let looks: &[f64] = match places {
            _ if is_known_at_end => &[1.0],
            Places::All => {
                let found = roots::isolating_fractions(
                    |theta| Ok(exact(self, theta)?),
                    || go_on_unless(shall_stop(beginning(stepper))),
                );
                &found.map_err(|why| why.explain(&self.name, stepper.t_before()))?
            }
            Places::Few => &SAMPLE_FRACTIONS,
        };
        let looks = (looks, is_known_at_end);
        Ok(
            self.changes(looks, roundoff, ending, exact, |watch, change| {
                let [from, to] = change.between;
                let theta = if from == to {
                    from
                } else {
                    root([from, to], roundoff, &mut |theta| exact(watch, theta))?
                };
                found(theta, change.side_before);
                Ok(())
            })?,
        )
    }

    /// The function's value at a state of the last step.
    fn value_in_step<L: InputLaw<M::System>, A: Quadratures<M::System>>(
        &mut self,
        at: &State<Coordinates<M>>,
        observed_system: &ObservedSystem<'_, M::System, L>,
        stepper: &StepperOf<'_, M, L, A>,
    ) -> Result<f64, Error> {
        self.value(at, &|| observed_system.observe::<M, A>(stepper, at))
    }

    /// Decides from the states at the [fractions](roots::FRACTIONS) of the last step, and from the function's value at the first of them if it
    /// is known, where to look for events; `None` if there is none. If the function is zero to rounding at the end of the step, the second
    /// part is what it must exceed before its sign counts again.
    fn look_at_fractions<L: InputLaw<M::System>, A: Quadratures<M::System>>(
        &mut self,
        (states, known): (
            &[State<Coordinates<M>>; roots::FRACTIONS.len()],
            Option<f64>,
        ),
        end: EndOfStep,
        observed_system: &ObservedSystem<'_, M::System, L>,
        stepper: &StepperOf<'_, M, L, A>,
    ) -> Result<Option<(Places, Option<f64>)>, Error> {
        let mut values = [0.0; roots::FRACTIONS.len()];
        for (node, (of_node, at)) in values.iter_mut().zip(states).enumerate() {
            *of_node = match known {
                Some(known) if node == 0 => known,
                _ => self.value_in_step(at, observed_system, stepper)?,
            };
        }
        self.latest = Some(values[4]);
        self.at_end = values[4];
        let has_sign = self.side != 0.0 || self.touched != 0.0;
        let stays = !has_sign && values.iter().all(|value| value.abs() <= self.leave);
        let mut ending = None;
        if end != EndOfStep::Smooth && !stays && may_be_zero_at_end(&values) {
            ending = self.zero_at_end(observed_system, stepper)?;
        }
        if ending.is_some() {
            values[4] = 0.0;
        }
        let touches = ending.is_some() || self.touched != 0.0;
        let places = match self.places(&values) {
            None if touches => Places::Few,
            None => return Ok(None),
            Some(places) => places,
        };
        if self.side == 0.0 && !touches {
            let (side, leave) = (self.side, self.leave);
            let mut suspected = false;
            let look = |watch: &mut Self, theta: f64| {
                let at = state(observed_system.system, interpolated_at(stepper, theta));
                watch.value_in_step(&at, observed_system, stepper)
            };
            let looks = (&SAMPLE_FRACTIONS[..], false);
            self.changes(looks, theta_roundoff(stepper), None, look, |_, _| {
                suspected = true;
                Ok(())
            })?;
            if !suspected && matches!(places, Places::Few) {
                return Ok(None);
            }
            (self.side, self.leave) = (side, leave);
        }
        Ok(Some((places, ending)))
    }

    /// Decides from the values at the eight [fractions](roots::FRACTIONS) where in the last step to look for events; `None` if there is none.
    fn places(&self, values: &[f64; roots::FRACTIONS.len()]) -> Option<Places> {
        let changes = roots::sign_changes(values);
        if self.side == 0.0 {
            let is_zero = |value: &f64| value.abs() <= self.leave;
            return match changes {
                _ if values.iter().all(is_zero) => None,
                // Rounding may have taken the first value to the other side.
                Some(0 | 1) => Some(Places::Few),
                _ => Some(Places::All),
            };
        }
        // It may have jumped between two steps.
        let has_side = |value: f64| sign(value) == self.side;
        match changes {
            Some(0) if has_side(values[0]) && has_side(values[4]) => None,
            Some(0) => Some(Places::Few),
            Some(1) if has_side(values[0]) => Some(Places::Few),
            _ => Some(Places::All),
        }
    }
}

/// Whether a run shall stop, which a long search within a step asks from time to time, at the state at the beginning of the step.
pub(crate) type ShallStop<'x, 'y, V> = &'x mut (dyn FnMut(Triple<V>) -> bool + 'y);

/// Time and state at the beginning of the last step.
pub(crate) fn beginning<S: System, L: InputLaw<S>, A: Quadratures<S>>(
    stepper: &Stepper<'_, S, L, A>,
) -> Triple<S::Vector> {
    let (q, v) = (stepper.q_before().clone(), stepper.v_before().clone());
    (stepper.t_before(), q, v)
}

/// Why the events of a step are not known.
#[derive(Debug)]
pub(crate) enum Unsearched {
    /// A function cannot be followed.
    Failed(Error),
    /// The run was stopped during the search.
    Stopped,
}

impl From<Error> for Unsearched {
    fn from(error: Error) -> Self {
        Self::Failed(error)
    }
}

/// The error where a long search within a step was told to stop.
pub(crate) fn go_on_unless(stops: bool) -> Result<(), Unsearched> {
    if stops {
        Err(Unsearched::Stopped)
    } else {
        Ok(())
    }
}

/// Where in a step a function is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Places {
    /// It has one zero at the most.
    Few,
    /// All its zeros are isolated.
    All,
}

/// Adds the events of the last step to `events`, in the order in which they happened, up to the first
/// that ends the run, which is the answer. A long search asks from time to time whether it `shall_stop`.
pub(crate) fn find<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>>(
    watches: &mut [Watch<'_, M>],
    (end, shall_stop): (EndOfStep, ShallStop<'_, '_, VectorOf<M>>),
    observed_system: &ObservedSystem<'_, M::System, L>,
    stepper: &mut StepperOf<'_, M, L, A>,
    interpolant: &mut Option<Interpolant<<M::System as System>::Vector>>,
    events: &mut Vec<Event<Coordinates<M>>>,
) -> Result<Option<Terminal>, Unsearched> {
    let system = observed_system.system;
    let mut found = Vec::new();
    let is_long =
        stepper.coefficients().is_some() || !watches.is_empty() && is_long(system, stepper);
    let mut sampled = None;
    for (index, watch) in watches.iter_mut().enumerate() {
        let step = (end, is_long);
        let seen = watch.suspect(step, observed_system, stepper, interpolant, &mut sampled)?;
        let Some(seen) = seen else {
            continue;
        };
        let motion = step_motion(interpolant, stepper, system)?;
        let keep = |theta, side_before| {
            found.push(SignChange {
                watch: index,
                theta,
                side_before,
            });
        };
        let search = (&mut *shall_stop, keep);
        watch.locate(seen, end, observed_system, stepper, motion, search)?;
    }
    found.sort_by(|one, other| one.theta.total_cmp(&other.theta));
    Ok(report(
        found,
        watches,
        observed_system,
        stepper,
        interpolant,
        events,
    )?)
}

/// Adds the changes of sign of the last step to `events`, in their order, up to the first that ends the run, which is the answer.
fn report<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>>(
    found: Vec<SignChange>,
    watches: &mut [Watch<'_, M>],
    observed_system: &ObservedSystem<'_, M::System, L>,
    stepper: &mut StepperOf<'_, M, L, A>,
    interpolant: &Option<Interpolant<VectorOf<M>>>,
    events: &mut Vec<Event<Coordinates<M>>>,
) -> Result<Option<Terminal>, Error> {
    let system = observed_system.system;
    let roundoff = theta_roundoff(stepper);
    let forward = stepper.t() > stepper.t_before();
    for SignChange {
        watch: index,
        theta,
        side_before,
    } in found
    {
        let watch = &mut watches[index];
        let crossing = Crossing::from(side_before, forward);
        if !watch.crossing.counts(crossing) {
            continue;
        }
        let Some(interpolant) = interpolant else {
            continue;
        };
        let at = |theta: f64| -> Result<_, Error> {
            if theta == 0.0 {
                let (q, v) = (stepper.q_before().clone(), stepper.v_before().clone());
                return Ok(state(system, (stepper.t_before(), q, v)));
            }
            Ok(state(
                system,
                state_at(system, stepper, interpolant, theta)?,
            ))
        };
        if !watch.counts() {
            events.push(Event {
                name: watch.name.clone(),
                crossing,
                state: at(theta)?,
            });
            continue;
        }
        let slope = slope(theta, roundoff, |theta| {
            let at = at(theta)?;
            (watch.function)(&at, &|| observed_system.observe::<M, A>(stepper, &at))
        })?;
        return Ok(Some(Terminal {
            watch: index,
            crossing,
            t: at(theta)?.t,
            slope: slope.map(|slope| slope / stepper.last_step()),
        }));
    }
    Ok(None)
}

/// The slope of a function near its zero at `theta`, if it is as good as linear there.
fn slope(
    theta: f64,
    roundoff: f64,
    mut f: impl FnMut(f64) -> Result<f64, Error>,
) -> Result<Option<f64>, Error> {
    // Wide enough that rounding leaves some digits, and as near as it takes for bends to leave some.
    let widest = (1e5 * roundoff).clamp(1e-4, 0.1);
    let reaches = core::iter::successors(Some(widest), |reach| Some(1e-2 * reach));
    for reach in reaches.take_while(|reach| *reach == widest || *reach > 1e3 * roundoff) {
        let (from, to) = ((theta - reach).max(0.0), (theta + reach).min(1.0));
        let half = [0.5 * (from + theta), 0.5 * (theta + to)];
        let whole = f(to)? - f(from)?;
        let part = f(half[1])? - f(half[0])?;
        let is_linear = (part - 0.5 * whole).abs() <= 0.1 * whole.abs();
        let slope = whole / (to - from);
        if is_linear && slope.is_finite() && slope != 0.0 {
            return Ok(Some(slope));
        }
    }
    Ok(None)
}

type VectorOf<M> = <<M as Machine>::System as System>::Vector;

/// The state at the end of the last step, known as well as contacts know it where they change; `v_before` are the rates before they jumped.
pub(crate) fn at_end<'x, S: System, L: InputLaw<S>, A: Quadratures<S>>(
    stepper: &'x Stepper<'_, S, L, A>,
    v_before: &'x S::Vector,
) -> KnownState<'x, S::Vector> {
    let t = stepper.t();
    KnownState {
        t,
        q: stepper.q(),
        v: stepper.v(),
        a: stepper.a(),
        share: ROUNDING_AT_CHANGE,
        v_before,
        tick: ROUNDING * t.abs().max(stepper.last_step().abs()),
    }
}

/// Whether a function with these values at the eight [fractions](roots::FRACTIONS) of a step may be zero to rounding at its end: it does not come
/// near zero there if its last change is small beside its value.
fn may_be_zero_at_end(values: &[f64; roots::FRACTIONS.len()]) -> bool {
    let greatest = values
        .iter()
        .fold(0.0_f64, |most, value| most.max(value.abs()));
    let last_change = (values[4] - values[7]).abs();
    let bound = last_change + SUSPECT * greatest;
    values[4].abs() <= bound || values[4].is_nan() || bound.is_nan()
}

/// Whether a function with this value after a change of contacts may be zero to rounding there, if it was `before` just before it, or not a number.
pub(crate) fn may_be_zero_after(value: f64, before: f64, is_at_zero: bool) -> bool {
    is_at_zero || value.abs() <= SUSPECT * before.abs() || value.is_nan() || before.is_nan()
}

/// The stepper of a run.
type StepperOf<'s, M, L, A> =
    Stepper<'s, <M as Machine>::System, LawInPiece<'s, L, crate::Inputs<M>>, A>;
