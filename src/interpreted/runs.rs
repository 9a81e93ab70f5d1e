//! Runs of interpreted machines, compiled in this crate.
//!
//! A run is generic over its machine, so each crate that calls [`Simulation::run`] compiles it again, with optimization. Crates
//! that run specs all run machines of the same type; these runs are compiled once, here.

use crate::inputs::{InputLaw, Law};
use crate::run::run;
use crate::sensitivities::{Sensitive, SensitiveSystem};
use crate::settings::Task;
use crate::simulation::run_many_by;
use crate::solution::{RunResult, Solution};
use crate::{Coordinates, Error, Simulation, State};

use super::{InterpretedMachine, InterpretedSystem, RunTask};
use std::vec::Vec;

type Start<M> = State<Coordinates<M>>;
/// A run as far as it went, or an error if it could not begin.
type RunAsFar<L> = Result<(Solution<InterpretedMachine, L>, Option<Error>), Error>;
type SensitiveMachine<'m> = Sensitive<'m, InterpretedMachine>;

impl<L: InputLaw<InterpretedSystem>> Simulation<'_, InterpretedMachine, L> {
    /// [`run`](Self::run), compiled once for all crates that call it.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_interpreted(
        self,
        start: Start<InterpretedMachine>,
    ) -> Result<Solution<InterpretedMachine, L>, Error> {
        complete(self.run_interpreted_as_far_as_possible(start)?)
    }

    /// [`run_as_far_as_possible`](Self::run_as_far_as_possible), compiled once for all crates that call it.
    ///
    /// # Errors
    /// As [`run_as_far_as_possible`](Self::run_as_far_as_possible).
    pub fn run_interpreted_as_far_as_possible(
        self,
        start: Start<InterpretedMachine>,
    ) -> Result<(Solution<InterpretedMachine, L>, Option<Error>), Error> {
        self.run_by(start, run_task)
    }
}

impl<L: InputLaw<InterpretedSystem>> Simulation<'_, InterpretedMachine, L> {
    /// Makes many runs like [`run_interpreted_as_far_as_possible`](Self::run_interpreted_as_far_as_possible), several at a time in
    /// vector lanes if [the machine has code for that](InterpretedMachine::may_run_in_lanes). A lane whose run is over takes the
    /// next one, and each has its own steps, events and end. Returns the results in the order of the runs.
    ///
    /// All of them must be runs of one machine with any parameters, by one method with one relative tolerance; other runs are made
    /// alone, and so are runs by methods that are neither explicit nor by series, with guides, or with inputs that change. Runs that [change their
    /// method](Self::automatic) go on with others that have changed to the same one. While constraints depend
    /// on each other or a unilateral contact is closed, the steps of a run are tried alone. Every run has the bits that it has alone. Callbacks are called by all
    /// runs alternately, and [`Statistics::seconds`](crate::Statistics::seconds) of each is the time of all.
    ///
    /// ```
    /// # use lagrangian_mechanics::Compiled;
    /// # use lagrangian_spec::{diagnostic::Report, source::{InMemory, Sources}};
    /// use lagrangian::interpreted::{Engine, InterpretedMachine};
    /// use lagrangian::{Machine, Simulation};
    ///
    /// # let text = "machine Swing in plane {
    /// #     parameters { m: kg = 1, l: m = 1, g: m/s^2 = 9.81 }
    /// #     coordinates { theta: rad = 0.5 }
    /// #     bodies { bob { mass: m, at: l*(sin(theta), -cos(theta)) } }
    /// #     gravity (0, -g);
    /// # }";
    /// # let (dag, mut sources, mut report) = (Default::default(), Sources::new(), Report::new());
    /// # let files = &mut InMemory::new();
    /// # let model = lagrangian_spec::model(&dag, "swing", text, &[], files, &mut sources, &mut report);
    /// # let swing = model.and_then(|model| Compiled::new(model, &mut report)).expect("a pendulum");
    /// let mut machine = InterpretedMachine::new(swing.program);
    /// machine.set_engine(Engine::Auto)?;
    /// let lengths = [0.5, 1.0, 1.5, 2.0];
    /// let machines = lengths.map(|l| {
    ///     let mut machine = machine.clone();
    ///     machine.set("l", l).map(|()| machine)
    /// });
    /// let machines = machines.into_iter().collect::<Result<Vec<_>, _>>()?;
    /// let run = |machine| (Simulation::new(machine).until(1.0), Machine::start(machine));
    /// let made = Simulation::run_interpreted_in_lanes(machines.iter().map(run).collect());
    /// for (machine, made) in machines.iter().zip(made) {
    ///     let (solution, error) = made?;
    ///     let alone = Simulation::new(machine).until(1.0).run(machine.start())?;
    ///     assert!(error.is_none() && solution.end() == alone.end());
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn run_interpreted_in_lanes(
        simulations: Vec<(Self, Start<InterpretedMachine>)>,
    ) -> Vec<RunAsFar<L>> {
        run_many_by(simulations, run_in_lanes)
    }
}

impl<'m, L> Simulation<'_, SensitiveMachine<'m>, L>
where
    L: InputLaw<SensitiveSystem<InterpretedSystem>>,
{
    /// [`run`](Self::run), compiled once for all crates that call it.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_interpreted(
        self,
        start: Start<SensitiveMachine<'m>>,
    ) -> Result<Solution<SensitiveMachine<'m>, L>, Error> {
        complete(self.run_by(start, run_with_derivatives)?)
    }
}

fn complete<S>((solution, error): (S, Option<Error>)) -> Result<S, Error> {
    match error {
        Some(error) => Err(error),
        None => Ok(solution),
    }
}

fn run_task(
    task: Task<'_, InterpretedMachine, Law<'_, InterpretedSystem>>,
    start: Start<InterpretedMachine>,
) -> RunResult<InterpretedMachine> {
    run(task, start)
}

#[cfg(feature = "jit")]
fn run_in_lanes(tasks: Vec<RunTask<'_, '_>>) -> Vec<RunResult<InterpretedMachine>> {
    super::in_lanes::run_tasks(tasks)
}

#[cfg(not(feature = "jit"))]
fn run_in_lanes(tasks: Vec<RunTask<'_, '_>>) -> Vec<RunResult<InterpretedMachine>> {
    let tasks = tasks.into_iter();
    tasks.map(|(task, start)| run_task(task, start)).collect()
}

fn run_with_derivatives<'m>(
    task: Task<'_, SensitiveMachine<'m>, Law<'_, SensitiveSystem<InterpretedSystem>>>,
    start: Start<SensitiveMachine<'m>>,
) -> RunResult<SensitiveMachine<'m>> {
    run(task, start)
}
