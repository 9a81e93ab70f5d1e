//! A run to be made: its settings (method, tolerances, samples, energy balance), and the call that makes it.

mod compiled_in_lanes;
mod in_pieces;
mod watched;

use std::vec::Vec;

use crate::inputs::{AnyInputs, DefaultInputs, InputFunction, InputLaw, Law};
use crate::methods::Method;
use crate::run;
use crate::settings::{Callbacks, Resumed, Settings, Subject, Task, TaskWithStart};
use crate::solution::{Ending, RunResult, Solution};
use crate::table::{Table, TableInputs};
use crate::{Coordinates, Error, Inputs, Machine, State};

/// A run to be made: the machine, the end, the tolerance, and what to watch for.
///
/// A simulation can be cloned and sent to another thread. Events, conditions and a sampled controller, which act on the run, are cloned
/// with it; observers, which only watch, are shared by the clones.
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
#[must_use = "a simulation does nothing until `run(start)`"]
pub struct Simulation<'a, M: Machine, L = DefaultInputs> {
    pub(crate) subject: Subject<'a, M>,
    pub(crate) law: L,
    pub(crate) settings: Settings,
    pub(crate) callbacks: Callbacks<'a, M>,
    /// The end of the run that this one resumes, if any.
    pub(crate) resumed: Option<Resumed>,
}

impl<'a, M: Machine> Simulation<'a, M> {
    /// A run of `machine`, with a tolerance of 10⁻⁹ and the inputs at their defaults.
    pub fn new(machine: &'a M) -> Self {
        Self {
            subject: Subject::Machine(machine),
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
                observed_every: Vec::new(),
                keep_steps: true,
                energy_balance: false,
                keep_energies: true,
                keep_contact_phases: true,
                keep_contact_events: true,
                one_tolerance: true,
                hands_over: false,
                automatic: false,
                one_of: 1,
            },
            callbacks: Callbacks::default(),
        }
    }
}

impl<'a, M: Machine, L> Simulation<'a, M, L> {
    /// Sets the inputs while the machine runs: `|t, q, v, u| u.torque = -5.0 * v.theta`.
    ///
    /// The function must depend on its arguments alone, because it is called more than once and not in the order of time. It should be
    /// smooth; where it jumps, steps become short. If another function is to take over after some event, end the run there and
    /// [resume](Solution::resume) it.
    pub fn inputs<F>(self, function: F) -> Simulation<'a, M, InputFunction<F>>
    where
        F: Fn(f64, &Coordinates<M>, &Coordinates<M>, &mut Inputs<M>),
    {
        self.law(InputFunction(function))
    }

    /// Sets the inputs by a law: like [`inputs`](Self::inputs), for laws that are not functions of named values.
    pub fn law<N: InputLaw<M::System>>(self, law: N) -> Simulation<'a, M, N> {
        let Self {
            subject,
            settings,
            callbacks,
            resumed,
            ..
        } = self;
        Simulation {
            subject,
            law,
            settings,
            callbacks,
            resumed,
        }
    }

    /// Drives the machine by a table, beside any other law of the inputs: at each instant `set` is called with the value of the table and
    /// writes it to the inputs. Steps end wherever the table is not smooth enough for the method.
    ///
    /// ```
    /// # mod by_hand { include!("../tests/by_hand/toy.rs"); }
    /// # use by_hand::Toy;
    /// use lagrangian::{Simulation, Table};
    ///
    /// // A mass of 1 kg, pushed by a force that grows to 2 N in a second and then stays.
    /// let mass = Toy::new(([0.0], [0.0]), |_, _, _, u, _| [u]);
    /// let push = Table::linear([0.0, 1.0], [0.0, 2.0])?;
    /// let run = Simulation::new(&mass)
    ///     .until(2.0)
    ///     .table(push, |force, value| *force = value)
    ///     .run(mass.start())?;
    /// assert!((run.at(1.0)?.v[0] - 1.0).abs() < 1e-15);
    /// assert!((run.end().v[0] - 3.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn table<F>(self, table: Table, set: F) -> Simulation<'a, M, TableInputs<L, F>>
    where
        F: Fn(&mut Inputs<M>, f64),
    {
        let Self {
            subject,
            law,
            settings,
            callbacks,
            resumed,
        } = self;
        Simulation {
            subject,
            law: TableInputs::new(law, table, set),
            settings,
            callbacks,
            resumed,
        }
    }
}

impl<M: Machine<System: Clone>, L: Clone> Clone for Simulation<'_, M, L> {
    fn clone(&self) -> Self {
        Self {
            subject: self.subject.clone(),
            law: self.law.clone(),
            settings: self.settings.clone(),
            callbacks: self.callbacks.clone(),
            resumed: self.resumed.clone(),
        }
    }
}

impl<'a, M: Machine, L: InputLaw<M::System>> Simulation<'a, M, L> {
    /// Erases the type of the law of the inputs, for laws that are chosen at run time.
    ///
    /// ```
    /// # mod by_hand { include!("../tests/by_hand/toy.rs"); }
    /// # use by_hand::Toy;
    /// use lagrangian::Simulation;
    ///
    /// // A mass of 1 kg, pushed or not.
    /// let mass = Toy::new(([0.0], [0.0]), |_, _, _, u, _| [u]);
    /// let run = |is_pushed: bool| {
    ///     let simulation = Simulation::new(&mass).until(2.0);
    ///     let simulation = if is_pushed {
    ///         simulation.inputs(|_, _, _, force| *force = 1.0).any_inputs()
    ///     } else {
    ///         simulation.any_inputs()
    ///     };
    ///     simulation.run(mass.start())
    /// };
    /// assert!((run(true)?.end().q[0] - 2.0).abs() < 1e-12);
    /// assert_eq!(run(false)?.end().q[0], 0.0);
    /// # Ok::<(), lagrangian::Error>(())
    /// ```
    pub fn any_inputs(self) -> Simulation<'a, M, AnyInputs<'a, M::System>>
    where
        L: Send + Sync + 'a,
    {
        let Self {
            subject,
            law,
            settings,
            callbacks,
            resumed,
        } = self;
        Simulation {
            subject,
            law: AnyInputs::new(law),
            settings,
            callbacks,
            resumed,
        }
    }

    /// The end of the run, in s; a time before the start runs backward.
    pub fn until(mut self, t: f64) -> Self {
        self.settings.until = Some(t);
        self
    }

    /// The tolerance, relative and absolute: each step keeps its error in a number `y` below `tolerance · (1 + |y|)`.
    pub fn tolerance(self, tolerance: f64) -> Self {
        let mut simulation = self.relative(tolerance).absolute(tolerance);
        simulation.settings.one_tolerance = true;
        simulation
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
        self.settings.automatic = false;
        self
    }

    /// Chooses the method by machine, tolerance and motion, and may change it during the run; [`Solution::choices`] lists the choices with
    /// times and reasons.
    ///
    /// It begins with [`TAYLOR`](crate::TAYLOR) if the machine has a series whose steps cost less than steps of [`Method::DOP853`] over the
    /// same time that are as accurate ([`System::series_cost`](crate::System::series_cost)), otherwise with `dop853`. A machine that is read from a spec at run
    /// time begins with `dop853` in any case, since its series must be derived first: once the run has proved long enough, this is done, and the run goes on by series if their steps cost less. When stability and not
    /// accuracy limits the steps, it changes to a Radau method, of order 5, 9 or 13 depending on the tolerance, and back once its steps,
    /// linear equations included, have cost more than explicit ones would. A machine with unilateral contacts [hands over](Self::hand_over) to
    /// time stepping and back, and is not tested for stiffness; it begins with `dop853`, and goes by series while all contacts are open if the flights so far show that it pays. All decisions follow from counts, never from a clock: the same call gives
    /// the same bits.
    ///
    /// ```
    /// # mod by_hand { include!("../tests/by_hand/toy.rs"); }
    /// # use by_hand::Toy;
    /// use lagrangian::{Method, MethodReason, Simulation};
    ///
    /// // A mass of 1 kg that a stiff damped spring of 1e8 N/m holds to a slow motion: x'' = -1e8 (x - sin t) - 1e6 (v - cos t).
    /// let held = Toy::new(([0.0], [1.0]), |t, q, v, _, _| {
    ///     [-1e8 * (q[0] - t.sin()) - 1e6 * (v[0] - t.cos())]
    /// });
    /// let run = Simulation::new(&held).automatic().until(10.0).run(held.start())?;
    /// let choices = run.choices();
    /// assert_eq!(choices[0].method.tableau.name, "dop853");
    /// assert!(matches!(choices[1].reason, MethodReason::Stiff { .. }) && choices[1].t < 0.01);
    /// assert!((run.end().q[0] - 10_f64.sin()).abs() < 1e-6 && run.statistics().steps < 1000);
    /// # Ok::<(), lagrangian::Error>(())
    /// ```
    pub fn automatic(mut self) -> Self {
        self.settings.automatic = true;
        self.hand_over()
    }

    /// This run is one of so many of its machine, such as those of a sweep, which share the derivation of a series: a run that [chooses its
    /// method](Self::automatic) then counts its part of the derivation, and goes on by series after fewer steps; with enough runs it decides at its start. By
    /// default 1. Nothing else of a run depends on it, and 0 counts as 1.
    ///
    /// ```
    /// use lagrangian::interpreted::InterpretedMachine;
    /// use lagrangian::{Machine, Simulation};
    ///
    /// let swing = InterpretedMachine::from_text("machine Swing in plane {
    ///     parameters { m: kg = 1, l: m = 1, g: m/s^2 = 9.81 }
    ///     coordinates { theta: rad = 0.5 }
    ///     bodies { bob { mass: m, at: l*(sin(theta), -cos(theta)) } }
    ///     gravity (0, -g);
    /// }");
    /// let swing = swing.build()?;
    /// let method = |runs| {
    ///     let run = Simulation::new(&swing).automatic().one_of(runs).tolerance(1e-12).until(10.0);
    ///     let run = run.run(swing.start()).expect("a pendulum swings");
    ///     run.choices()[0].method.tableau.name
    /// };
    /// // Ten seconds are not worth a derivation of 2 ms; a hundred thousand times ten seconds are.
    /// assert_eq!([method(1), method(100_000)], ["dop853", "taylor"]);
    /// # Ok::<(), lagrangian::Error>(())
    /// ```
    pub fn one_of(mut self, runs: u64) -> Self {
        self.settings.one_of = runs;
        self
    }

    /// Changes to [time stepping](Method::MOREAU) when unilateral contacts change too often for each instant to be located, and back to
    /// locating every event once they are quiet. [`Solution::handovers`] and a [`Warning`](crate::Warning) give the times.
    ///
    /// It hands over if at least three contacts changed at the last 128 instants of events and these instants were, on average, less than a
    /// step of time stepping apart, or if contacts do not settle at one instant. A step is a 256th of the time in which the forces of that
    /// instant would stop the fastest closing gap, and at most the longest step. Nothing bounds the error of time stepping, whose order is
    /// 1; a smaller [`longest_step`](Self::longest_step) makes it smaller. When everything is at rest, steps become longer. Events are
    /// located again after 64 steps in which no contact changed, and after twice as many each time that this did not last, provided that
    /// fewer than 16 contacts are closed in space, or their forces are unique: in piles, which can share loads in several ways, events cost more.
    ///
    /// For explicit and Radau methods, and [`TAYLOR`](crate::TAYLOR). Contacts whose law time stepping does not support are followed as before.
    pub fn hand_over(mut self) -> Self {
        self.settings.hands_over = true;
        self
    }

    /// The length of the first step, in s. By default it is chosen from the motion at the start.
    pub fn first_step(mut self, step: f64) -> Self {
        self.settings.first_step = Some(step);
        self
    }

    /// The greatest length of a step, in s.
    pub fn longest_step(mut self, step: f64) -> Self {
        self.settings.longest_step = step;
        self
    }

    /// Keeps a number of the start as given when the start violates the constraints and is moved onto them: a coordinate,
    /// `"theta"`, or a rate, `"der(theta)"`; in a family, `"q[3]"`, or the whole family, `"q"`. The other numbers move as little
    /// as possible in the metric of inertia. Call it once for each number; the calls replace everything that the description
    /// keeps ([`System::kept_at_start`](crate::System::kept_at_start)).
    ///
    /// The run returns an error if the constraints cannot be satisfied in this way.
    pub fn keep(mut self, name: &str) -> Self {
        self.settings.kept.get_or_insert_default().push(name.into());
        self
    }

    /// Keeps no number of the start, whatever the description says: all of them move as little as possible in the metric of inertia.
    pub fn keep_none(mut self) -> Self {
        self.settings.kept = Some(Vec::new());
        self
    }

    /// The largest number of steps; ten million by default.
    pub fn max_steps(mut self, steps: usize) -> Self {
        self.settings.max_steps = steps;
        self
    }

    /// Keeps the states at the start, every `interval` seconds after it, and at the end as [`Solution::samples`]. Combined with
    /// [`forget_steps`](Self::forget_steps), nothing else of a long run is kept.
    pub fn every(mut self, interval: f64) -> Self {
        self.settings.every = Some(interval);
        self
    }

    /// Keeps only the end of the run, its samples and its events, and not the steps
    /// that [`Solution::at`] needs (10 vectors a step with the default method).
    pub fn forget_steps(mut self) -> Self {
        self.settings.keep_steps = false;
        self
    }

    /// Whether to integrate work and dissipation alongside the motion for an energy balance.
    pub fn energy_balance(mut self, keep: bool) -> Self {
        self.settings.energy_balance = keep;
        self
    }

    /// Keeps only the first and the last energies, and the first that are not finite, so that the energy balance needs constant memory.
    pub fn forget_energies(mut self) -> Self {
        self.settings.keep_energies = false;
        self
    }

    /// Keeps the states of unilateral contacts only where samples, events of watched functions, and the end of the run need them, so that their memory
    /// does not grow with the number of impacts. No effect if steps are kept.
    pub fn forget_contact_phases(mut self) -> Self {
        self.settings.keep_contact_phases = false;
        self
    }

    /// Counts the events of unilateral contacts and keeps none of them: neither in [`Solution::contact_events`] nor among the
    /// [`events`](Solution::events), but in [`Solution::contact_tallies`].
    pub fn forget_contact_events(mut self) -> Self {
        self.settings.keep_contact_events = false;
        self
    }

    /// Runs the machine from `start`.
    pub fn run(self, start: State<Coordinates<M>>) -> Result<Solution<M, L>, Error> {
        match self.run_as_far_as_possible(start)? {
            (_, Some(error)) => Err(error),
            (solution, None) => Ok(solution),
        }
    }

    /// Runs the machine from `start`, and returns the run so far even if an error ends it early.
    ///
    /// # Errors
    /// Only if the run could not begin.
    pub fn run_as_far_as_possible(
        self,
        start: State<Coordinates<M>>,
    ) -> Result<(Solution<M, L>, Option<Error>), Error> {
        self.run_by(start, run::run)
    }

    /// Runs the simulation with `make`.
    pub(crate) fn run_by(
        self,
        start: State<Coordinates<M>>,
        make: impl FnOnce(Task<'a, M, Law<'_, M::System>>, State<Coordinates<M>>) -> RunResult<M>,
    ) -> Result<(Solution<M, L>, Option<Error>), Error> {
        let task = Task {
            subject: self.subject,
            law: Law::of(&self.law),
            settings: self.settings,
            callbacks: self.callbacks,
            resumed: self.resumed,
        };
        let (results, error) = make(task, start)?;
        Ok((results.with_law(self.law), error))
    }
}

/// A run as far as it went, with the error that ended it early, if any; or an error if it could not begin.
pub(crate) type RunAsFar<M, L> = Result<(Solution<M, L>, Option<Error>), Error>;

/// A simulation and its start.
pub(crate) type WithStart<'a, M, L> = (Simulation<'a, M, L>, State<Coordinates<M>>);

/// Runs many simulations with `make`.
pub(crate) fn run_many_by<'a, M: Machine, L: InputLaw<M::System>>(
    simulations: Vec<WithStart<'a, M, L>>,
    make: impl FnOnce(Vec<TaskWithStart<'a, '_, M>>) -> Vec<RunResult<M>>,
) -> Vec<RunAsFar<M, L>> {
    let (mut laws, mut rest) = (Vec::new(), Vec::new());
    for (simulation, start) in simulations {
        let (subject, settings) = (simulation.subject, simulation.settings);
        laws.push(simulation.law);
        rest.push((
            subject,
            settings,
            simulation.callbacks,
            simulation.resumed,
            start,
        ));
    }
    let tasks = rest.into_iter().zip(&laws).map(|(rest, law)| {
        let (subject, settings, callbacks, resumed, start) = rest;
        let law = Law::of(law);
        let task = Task {
            subject,
            law,
            settings,
            callbacks,
            resumed,
        };
        (task, start)
    });
    let results = make(tasks.collect());
    let with_law = |(made, law): (RunResult<M>, L)| {
        made.map(|(results, error)| (results.with_law(law), error))
    };
    results.into_iter().zip(laws).map(with_law).collect()
}

impl<M: Machine, L> Solution<M, L> {
    /// A simulation that continues this run: the same machine, inputs, method, tolerances and end, and the next step length. Pass its start
    /// to [`run`](Simulation::run): [`end`](Self::end), or the state after an impact. A solution cannot keep events, which are functions,
    /// so they must be stated again; the event that ended this run is recognized by its name, and is not found again before its function
    /// has left 0. Other inputs may be set before the run, for instance after a relay has switched.
    ///
    /// Steps between events cannot be shorter than the resolution of time: a bounce that would take less than about 16 roundings of time is
    /// missed, and the ball goes through the floor. A loop over impacts that come to rest has to detect that by itself.
    ///
    /// ```
    /// # mod by_hand { include!("../tests/by_hand/toy.rs"); }
    /// use lagrangian::{Crossing, Ending, Simulation, State};
    ///
    /// // A ball falls from 2 m, and each bounce leaves it four fifths of its speed.
    /// let ball = by_hand::ball();
    /// let floor = |state: &State<[f64; 1]>| state.q[0];
    /// let mut run = Simulation::new(&ball)
    ///     .until(4.0)
    ///     .until_event("the floor", Crossing::Falling, floor)
    ///     .run(ball.start())?;
    /// let mut bounces = 0;
    /// while *run.ending() != Ending::End {
    ///     bounces += 1;
    ///     let mut start = *run.end();
    ///     start.v[0] *= -0.8;
    ///     run = run
    ///         .resume()
    ///         .until_event("the floor", Crossing::Falling, floor)
    ///         .run(start)?;
    /// }
    /// // It falls for √(2h/g) = 0.6386 s, and each flight takes four fifths of the one before it.
    /// assert_eq!((bounces, run.end().t), (5, 4.0));
    /// # Ok::<(), lagrangian::Error>(())
    /// ```
    pub fn resume<'a>(&self) -> Simulation<'a, M, L>
    where
        M::System: Clone,
        L: Clone,
    {
        let mut settings = self.results.settings.clone();
        if self.results.next_step > 0.0 && self.results.next_step.is_finite() {
            settings.first_step = Some(self.results.next_step);
        }
        let event = match &self.results.ending {
            Ending::Event(name) => Some(name.clone()),
            _ => None,
        };
        Simulation {
            subject: Subject::System(self.results.system.clone()),
            law: self.law.clone(),
            settings,
            callbacks: Callbacks::default(),
            resumed: Some(Resumed {
                t: self.results.end.t,
                event,
            }),
        }
    }
}
