//! Settings of a simulation, as its run takes them.

use std::boxed::Box;
use std::string::String;
use std::vec::Vec;

use crate::callbacks::{Condition, Controller, Shared};
use crate::event::{Triple, Watch, state};
use crate::inputs::Law;
use crate::methods::Method;
use crate::{Coordinates, Error, Machine, State, StepMotion, System};

/// Everything that a run needs besides its start.
pub(crate) struct Task<'a, M: Machine, L> {
    pub subject: Subject<'a, M>,
    pub law: L,
    pub settings: Settings,
    pub callbacks: Callbacks<'a, M>,
    /// The end of the run that this one resumes, if any.
    pub resumed: Option<Resumed>,
}

/// A run with its start.
pub(crate) type TaskWithStart<'a, 'l, M> = (
    Task<'a, M, Law<'l, <M as Machine>::System>>,
    State<Coordinates<M>>,
);

/// The machine or system to be run.
pub(crate) enum Subject<'a, M: Machine> {
    /// A machine that is not yet prepared.
    Machine(&'a M),
    /// The equations of motion of an earlier run.
    System(M::System),
}

impl<M: Machine<System: Clone>> Clone for Subject<'_, M> {
    fn clone(&self) -> Self {
        match self {
            Self::Machine(machine) => Self::Machine(machine),
            Self::System(system) => Self::System(system.clone()),
        }
    }
}

/// The end of the run that a simulation resumes.
#[derive(Clone, Debug)]
pub(crate) struct Resumed {
    /// Time, in s.
    pub t: f64,
    /// The event that ended it.
    pub event: Option<String>,
}

/// Settings of a simulation that are not functions.
#[derive(Clone, Debug)]
pub(crate) struct Settings {
    pub method: &'static Method,
    pub until: Option<f64>,
    pub relative: f64,
    pub absolute: f64,
    pub absolute_of: Vec<(String, f64)>,
    pub first_step: Option<f64>,
    pub longest_step: f64,
    pub max_steps: usize,
    /// `None` keeps what the description keeps.
    pub kept: Option<Vec<String>>,
    pub every: Option<f64>,
    /// The intervals of the observers.
    pub observed_every: Vec<f64>,
    pub keep_steps: bool,
    pub energy_balance: bool,
    /// Whether the energies after every step are kept, or only the first and the last.
    pub keep_energies: bool,
    /// Whether the states of contacts are kept at all times, or only those of samples, events and the end.
    pub keep_contact_phases: bool,
    /// Whether the events of unilateral contacts are kept, or only counted.
    pub keep_contact_events: bool,
    /// Whether both tolerances were given as one number.
    pub one_tolerance: bool,
    /// Whether the run changes to time stepping when contacts change too often.
    pub hands_over: bool,
    /// Whether the run chooses its method.
    pub automatic: bool,
    /// The number of runs of the machine, this one among them, that share the derivation of its series.
    pub one_of: u64,
}

/// Settings of a simulation that are functions.
pub(crate) struct Callbacks<'a, M: Machine> {
    pub watches: Vec<Watch<'a, M>>,
    pub progress: Option<Shared<dyn FnMut(Progress) + Send + 'a>>,
    pub stop: Option<Box<dyn Condition<'a, M> + 'a>>,
    pub sampled: Option<Sampled<'a, M>>,
    pub streams: Vec<StateStream<'a, M>>,
    pub observer: Option<Observer<'a, M>>,
}

/// Whether a run with this condition to stop shall do so at a state.
pub(crate) fn asked_to_stop<'c, M: Machine>(
    condition: &'c mut Option<Box<dyn Condition<'_, M> + '_>>,
    system: &'c M::System,
) -> impl FnMut(Triple<<M::System as System>::Vector>) -> bool {
    move |at| {
        condition
            .as_mut()
            .is_some_and(|stops| stops(&state(system, at)))
    }
}

/// An observer of the states of a run, and its progress.
pub(crate) struct StateStream<'a, M: Machine> {
    /// Time between two states that it is shown, in s.
    pub interval: f64,
    /// Number of states shown so far.
    pub count: usize,
    /// Time of the last state shown.
    pub last: f64,
    pub observer: StateObserver<'a, M>,
}

impl<M: Machine> StateStream<'_, M> {
    /// Shows the start of a run.
    pub fn begin(&mut self, start: &State<Coordinates<M>>) {
        self.count = 0;
        self.show(start);
    }

    /// Shows a state.
    pub fn show(&mut self, state: &State<Coordinates<M>>) {
        self.count += 1;
        self.last = state.t;
        (self.observer.lock())(state);
    }

    /// Shows the end of a run, if that was not shown.
    pub fn end(&mut self, end: &State<Coordinates<M>>) {
        if end.t != self.last {
            self.show(end);
        }
    }
}

/// A function that observes states.
type StateObserver<'a, M> = Shared<dyn FnMut(&State<Coordinates<M>>) + Send + 'a>;

/// A function that observes steps.
pub(crate) type Observer<'a, M> =
    Shared<dyn FnMut(&mut dyn StepMotion<M>) -> Result<(), Error> + Send + 'a>;

impl<M: Machine> Clone for Callbacks<'_, M> {
    fn clone(&self) -> Self {
        Self {
            watches: self.watches.clone(),
            progress: self.progress.clone(),
            stop: self.stop.clone(),
            sampled: self.sampled.clone(),
            streams: self.streams.clone(),
            observer: self.observer.clone(),
        }
    }
}

impl<M: Machine> Clone for StateStream<'_, M> {
    fn clone(&self) -> Self {
        Self {
            observer: self.observer.clone(),
            ..*self
        }
    }
}

impl<M: Machine> Clone for Sampled<'_, M> {
    fn clone(&self) -> Self {
        Self {
            controller: self.controller.clone(),
            ..*self
        }
    }
}

impl<M: Machine> Default for Callbacks<'_, M> {
    fn default() -> Self {
        Self {
            watches: Vec::new(),
            progress: None,
            stop: None,
            sampled: None,
            streams: Vec::new(),
            observer: None,
        }
    }
}

/// The progress of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Progress {
    /// Time reached, in s.
    pub t: f64,
    /// The fraction of the run that is done, from 0 to 1.
    pub fraction: f64,
    /// Steps taken.
    pub steps: usize,
    /// Length of the last step, in s.
    pub step: f64,
    /// When the motion was first detected to be stiff, in s: from then on the stability of the method
    /// limits the steps, and `radau5` takes longer ones. An explicit method tests every thousandth step,
    /// and after a positive result every step; it reports stiffness after fifteen positive results.
    pub stiff_since: Option<f64>,
}

/// A sampled controller and its timing.
pub(crate) struct Sampled<'a, M: Machine> {
    /// Time between two samples, in s.
    pub period: f64,
    /// Delay from a sample until the inputs that it set take effect, in s.
    pub delay: f64,
    /// Whether it also reads the state at a sample that is due exactly at the end of the run, where its inputs move nothing. Only a
    /// controller without a state of its own may: a run that continues from there begins with the same sample.
    pub reads_end: bool,
    pub controller: Box<dyn Controller<'a, M> + 'a>,
}

impl<M: Machine> Sampled<'_, M> {
    /// Whether a run from `start` to `until` can follow it.
    pub fn check(&self, start: f64, until: f64, is_alone: bool) -> Result<(), Error> {
        let wrong = |setting, value, needed| {
            Err(Error::InvalidSetting {
                setting,
                value,
                needed,
            })
        };
        let tick = 16.0 * f64::EPSILON * start.abs().max(until.abs());
        if !(self.period > tick && self.period.is_finite()) {
            let needed = "greater than 0, and than the smallest difference between times that the run can resolve";
            return wrong("sampled", self.period, needed);
        }
        if !(self.delay >= 0.0 && self.delay.is_finite()) {
            return wrong("delay", self.delay, "at least 0, and finite");
        }
        if until < start {
            return wrong(
                "until",
                until,
                "after the start: samples are taken forward in time",
            );
        }
        if is_alone {
            Ok(())
        } else {
            wrong(
                "sampled",
                self.period,
                "used without `inputs`, which would set the same inputs",
            )
        }
    }
}
