//! A run from start to end: settings, events, samples, balance.

use std::boxed::Box;
use std::string::String;
use std::vec::Vec;

use crate::balance::{EnergyIntegrals, NoBalance};
use crate::event::{Crossing, OfState, Watch};
use crate::inputs::{DefaultInputs, InputFunction, InputLaw};
use crate::methods::Method;
use crate::run;
use crate::solution::Solution;
use crate::{Coordinates, Error, Inputs, Machine, State};

/// A run to be made: machine, end, tolerance, and what to watch for.
///
/// ```
/// # mod by_hand { include!("../tests/by_hand/double_pendulum.rs"); }
/// # use by_hand::DoublePendulum;
/// use lagrangian::{Crossing, Machine, Simulation};
///
/// let pendulum = DoublePendulum { l2: 0.5, ..Default::default() };
/// let run = Simulation::new(&pendulum)
///     .tolerance(1e-10)
///     .until(10.0)
///     .event("upper rod vertical", Crossing::Any, |state| state.q.theta1)
///     .run(pendulum.start())?;
///
/// println!("at the end: {:?}", run.end());
/// println!("in between: {:?}", run.at(2.5)?.q.theta1);
/// for event in run.events() {
///     println!("{} at {} s", event.name, event.state.t);
/// }
/// # Ok::<(), lagrangian::Error>(())
/// ```
pub struct Simulation<'a, M: Machine, L = DefaultInputs> {
    pub(crate) of: Of<'a, M>,
    pub(crate) law: L,
    pub(crate) settings: Settings,
    pub(crate) callbacks: Callbacks<'a, M>,
    /// Where it goes on from, if it does.
    pub(crate) resumed: Option<Resumed>,
}

/// What is to be run.
pub(crate) enum Of<'a, M: Machine> {
    /// A machine, to be prepared.
    Machine(&'a M),
    /// The equations of motion of a run that was made.
    System(M::System),
}

/// The end of the run that a simulation goes on with.
#[derive(Clone, Debug)]
pub(crate) struct Resumed {
    /// Time, in s.
    pub t: f64,
    /// The event that ended it.
    pub event: Option<String>,
}

/// What a simulation was told, in numbers.
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
    /// What the description says where nobody says anything.
    pub kept: Option<Vec<String>>,
    pub every: Option<f64>,
    pub keep_steps: bool,
    pub energy_balance: bool,
    /// Whether both tolerances were given as one.
    pub one_tolerance: bool,
}

/// What a simulation was told, in functions.
pub(crate) struct Callbacks<'a, M: Machine> {
    pub watches: Vec<Watch<'a, M>>,
    pub progress: Option<Box<dyn FnMut(Progress) + 'a>>,
    pub stop: Option<OfState<'a, M, bool>>,
}

impl<M: Machine> Default for Callbacks<'_, M> {
    fn default() -> Self {
        Self {
            watches: Vec::new(),
            progress: None,
            stop: None,
        }
    }
}

/// How far a run has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Time reached, in s.
    pub t: f64,
    /// The part of the run that is done, from 0 to 1.
    pub fraction: f64,
    /// Steps taken.
    pub steps: usize,
    /// Length of the last of them, in s.
    pub step: f64,
    /// When the motion was first seen to be stiff, in s: from there on steps are held short by the
    /// stability of the method, and `radau5` takes longer ones. Seen as soon as an explicit method knows:
    /// after fifteen signs, by a test that follows every thousandth step.
    pub stiff_since: Option<f64>,
}

impl<'a, M: Machine> Simulation<'a, M> {
    /// A run of `machine`, with a tolerance of 10⁻⁹ and the inputs at their defaults.
    pub fn new(machine: &'a M) -> Self {
        Self {
            of: Of::Machine(machine),
            law: DefaultInputs,
            resumed: None,
            settings: Settings {
                method: Default::default(),
                until: None,
                relative: 1e-9,
                absolute: 1e-9,
                absolute_of: Vec::new(),
                first_step: None,
                longest_step: f64::INFINITY,
                max_steps: 10_000_000,
                kept: None,
                every: None,
                keep_steps: true,
                energy_balance: false,
                one_tolerance: true,
            },
            callbacks: Callbacks::default(),
        }
    }
}

impl<'a, M: Machine, L> Simulation<'a, M, L> {
    /// Sets the inputs while the machine runs: `|t, q, v, u| u.torque = -5.0 * v.theta`.
    ///
    /// The function must depend on its arguments alone, for it is called out of order in time and
    /// more than once. It should be smooth; where it jumps, the steps get short. Where it is to be
    /// another one from some event on, end the run there and [resume](Solution::resume) it.
    pub fn inputs<F>(self, function: F) -> Simulation<'a, M, InputFunction<F>>
    where
        F: Fn(f64, &Coordinates<M>, &Coordinates<M>, &mut Inputs<M>),
    {
        let Self {
            of,
            settings,
            callbacks,
            resumed,
            ..
        } = self;
        Simulation {
            of,
            law: InputFunction(function),
            settings,
            callbacks,
            resumed,
        }
    }
}

impl<'a, M: Machine, L: InputLaw<M::System>> Simulation<'a, M, L> {
    /// When to end, in s; before the start to run backward in time.
    pub fn until(mut self, t: f64) -> Self {
        self.settings.until = Some(t);
        self
    }

    /// How exact the run shall be, relative and absolute: each step keeps its error in a number `y`
    /// below `tolerance · (1 + |y|)`.
    pub fn tolerance(self, tolerance: f64) -> Self {
        let mut both = self.relative(tolerance).absolute(tolerance);
        both.settings.one_tolerance = true;
        both
    }

    /// The tolerance relative to the size of each coordinate and rate.
    pub fn relative(mut self, tolerance: f64) -> Self {
        self.settings.relative = tolerance;
        self.settings.one_tolerance = false;
        self
    }

    /// The tolerance for every coordinate in its own unit, and for its rate.
    pub fn absolute(mut self, tolerance: f64) -> Self {
        self.settings.absolute = tolerance;
        self.settings.one_tolerance = false;
        self
    }

    /// The absolute tolerance for one coordinate, `"s1"`, or `"q[3]"` in a family.
    pub fn absolute_of(mut self, coordinate: &str, tolerance: f64) -> Self {
        self.settings
            .absolute_of
            .push((coordinate.into(), tolerance));
        self
    }

    /// The method of integration, one of [`METHODS`](crate::METHODS).
    pub fn method(mut self, method: &'static Method) -> Self {
        self.settings.method = method;
        self
    }

    /// The length of the first step, in s. Chosen by the motion at the start if it is not given.
    pub fn first_step(mut self, step: f64) -> Self {
        self.settings.first_step = Some(step);
        self
    }

    /// The greatest length of a step, in s.
    pub fn longest_step(mut self, step: f64) -> Self {
        self.settings.longest_step = step;
        self
    }

    /// Keeps a number of the start as it was given, where the start does not obey the constraints and is
    /// moved onto them: a coordinate, `"theta"`, or a rate, `"der(theta)"`; of a family, `"q[3]"`, or all
    /// of it, `"q"`. The others move by the least that inertia allows. Called once for each, in place of
    /// all that the description keeps ([`System::kept_at_start`](crate::System::kept_at_start)).
    ///
    /// The run has an error where the constraints cannot be met so.
    pub fn keep(mut self, name: &str) -> Self {
        self.settings.kept.get_or_insert_default().push(name.into());
        self
    }

    /// Keeps no number of the start, whatever the description says: all of them move by the least that
    /// inertia allows.
    pub fn keep_none(mut self) -> Self {
        self.settings.kept = Some(Vec::new());
        self
    }

    /// How many steps the run may take; ten million if not given.
    pub fn max_steps(mut self, steps: usize) -> Self {
        self.settings.max_steps = steps;
        self
    }

    /// Keeps the states at the start, every `interval` seconds after it, and at the end:
    /// [`Solution::samples`]. With [`forget_steps`](Self::forget_steps) nothing else is kept of a
    /// long run.
    pub fn every(mut self, interval: f64) -> Self {
        self.settings.every = Some(interval);
        self
    }

    /// Keeps only the end of the run, its samples and events, not what would make [`Solution::at`]
    /// possible (10 vectors a step with the default method).
    pub fn forget_steps(mut self) -> Self {
        self.settings.keep_steps = false;
        self
    }

    /// Whether to integrate work and dissipation alongside and make a balance of the energy.
    pub fn energy_balance(mut self, keep: bool) -> Self {
        self.settings.energy_balance = keep;
        self
    }

    /// Finds the instants at which `function` changes its sign. A function that is 0 at the start, to
    /// rounding, counts only after it has left 0, with the sign that it has then.
    pub fn event(
        self,
        name: &str,
        crossing: Crossing,
        function: impl FnMut(&State<Coordinates<M>>) -> f64 + 'a,
    ) -> Self {
        self.watch(name, crossing, false, Box::new(function))
    }

    /// Ends the run when `function` changes its sign: at the state where it is 0, to the rounding of time
    /// and state. [`Solution::resume`] goes on from there.
    pub fn until_event(
        self,
        name: &str,
        crossing: Crossing,
        function: impl FnMut(&State<Coordinates<M>>) -> f64 + 'a,
    ) -> Self {
        self.watch(name, crossing, true, Box::new(function))
    }

    fn watch(
        mut self,
        name: &str,
        crossing: Crossing,
        ends_run: bool,
        function: OfState<'a, M, f64>,
    ) -> Self {
        self.callbacks.watches.push(Watch {
            name: name.into(),
            crossing,
            ends_run,
            function,
            side: 0.0,
            leave: 0.0,
            begun: false,
        });
        self
    }

    /// Calls `callback` after every step.
    pub fn progress(mut self, callback: impl FnMut(Progress) + 'a) -> Self {
        self.callbacks.progress = Some(Box::new(callback));
        self
    }

    /// Ends the run after the first step at whose end `condition` holds. To end at the very
    /// instant, use [`until_event`](Self::until_event).
    pub fn stop_if(mut self, condition: impl FnMut(&State<Coordinates<M>>) -> bool + 'a) -> Self {
        self.callbacks.stop = Some(Box::new(condition));
        self
    }

    /// Runs the machine from `start`.
    pub fn run(self, start: State<Coordinates<M>>) -> Result<Solution<M, L>, Error> {
        match self.run_as_far_as_possible(start)? {
            (_, Some(error)) => Err(error),
            (solution, None) => Ok(solution),
        }
    }

    /// Runs the machine from `start`, and returns what there is of the run even if an error ends it
    /// early.
    ///
    /// An error instead of a solution means that the run could not begin.
    pub fn run_as_far_as_possible(
        self,
        start: State<Coordinates<M>>,
    ) -> Result<(Solution<M, L>, Option<Error>), Error> {
        if self.settings.energy_balance {
            run::run(self, start, EnergyIntegrals::default())
        } else {
            run::run(self, start, NoBalance)
        }
    }
}
