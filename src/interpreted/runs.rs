//! Runs of interpreted machines, compiled in this crate.
//!
//! A run is generic over its machine, and so compiled in each crate that calls [`Simulation::run`], with optimization for the same
//! machine again in each. Crates that run what a spec says all run machines of one type: these are made here, once.

use crate::inputs::{InputLaw, Law};
use crate::run::run;
use crate::sensitivities::{Sensitive, SensitiveSystem};
use crate::settings::Task;
use crate::solution::{Made, Solution};
use crate::{Coordinates, Error, Simulation, State};

use super::{InterpretedMachine, InterpretedSystem};

type Start<M> = State<Coordinates<M>>;
type SensitiveMachine<'m> = Sensitive<'m, InterpretedMachine>;

impl<L: InputLaw<InterpretedSystem>> Simulation<'_, InterpretedMachine, L> {
    /// [`run`](Self::run), compiled once for all crates that call it.
    ///
    /// # Errors
    /// As of [`run`](Self::run).
    pub fn run_interpreted(
        self,
        start: Start<InterpretedMachine>,
    ) -> Result<Solution<InterpretedMachine, L>, Error> {
        complete(self.run_interpreted_as_far_as_possible(start)?)
    }

    /// [`run_as_far_as_possible`](Self::run_as_far_as_possible), compiled once for all crates that call it.
    ///
    /// # Errors
    /// As of [`run_as_far_as_possible`](Self::run_as_far_as_possible).
    pub fn run_interpreted_as_far_as_possible(
        self,
        start: Start<InterpretedMachine>,
    ) -> Result<(Solution<InterpretedMachine, L>, Option<Error>), Error> {
        self.run_by(start, made)
    }
}

impl<'m, L> Simulation<'_, SensitiveMachine<'m>, L>
where
    L: InputLaw<SensitiveSystem<InterpretedSystem>>,
{
    /// [`run`](Self::run), compiled once for all crates that call it.
    ///
    /// # Errors
    /// As of [`run`](Self::run).
    pub fn run_interpreted(
        self,
        start: Start<SensitiveMachine<'m>>,
    ) -> Result<Solution<SensitiveMachine<'m>, L>, Error> {
        complete(self.run_by(start, made_with_derivatives)?)
    }
}

fn complete<S>((solution, error): (S, Option<Error>)) -> Result<S, Error> {
    match error {
        Some(error) => Err(error),
        None => Ok(solution),
    }
}

fn made(
    task: Task<'_, InterpretedMachine, Law<'_, InterpretedSystem>>,
    start: Start<InterpretedMachine>,
) -> Made<InterpretedMachine> {
    run(task, start)
}

fn made_with_derivatives<'m>(
    task: Task<'_, SensitiveMachine<'m>, Law<'_, SensitiveSystem<InterpretedSystem>>>,
    start: Start<SensitiveMachine<'m>>,
) -> Made<SensitiveMachine<'m>> {
    run(task, start)
}
