//! The motion within one step, as an observer sees it during a run.

use crate::{Coordinates, Error, Inputs, Machine, State, System};

type VectorOf<M> = <<M as Machine>::System as System>::Vector;

/// The motion within one step of a run, which [`Simulation::each_step`](crate::Simulation::each_step) passes to its observer: the
/// dense output of the method, projected onto the constraints.
pub trait StepMotion<M: Machine> {
    /// Time at its beginning and at its end, in s.
    fn span(&self) -> [f64; 2];

    /// Whether it is a step by Taylor series, whose polynomials are of a much higher degree than those of other methods.
    fn is_series(&self) -> bool;

    /// Evaluates the state at a fraction of the step, from 0 to 1, and returns its time in s. Of `q` and `v` only the lengths matter
    /// before the call.
    ///
    /// # Errors
    /// If the method needs accelerations that do not exist, or the constraints cannot be satisfied.
    fn state_at(
        &mut self,
        theta: f64,
        q: &mut VectorOf<M>,
        v: &mut VectorOf<M>,
    ) -> Result<f64, Error>;

    /// The state at a time within the step, with the bits of a sample of the run at this time.
    ///
    /// # Errors
    /// As [`state_at`](Self::state_at).
    fn state(&mut self, t: f64) -> Result<State<Coordinates<M>>, Error>;

    /// The inputs at a state.
    fn inputs(&self, t: f64, q: &VectorOf<M>, v: &VectorOf<M>) -> Inputs<M>;

    /// Accelerations at a time, state and inputs, with the contacts in their states of this step.
    ///
    /// # Errors
    /// If there are none.
    fn accelerations(
        &self,
        at: (f64, &VectorOf<M>, &VectorOf<M>),
        u: &Inputs<M>,
        a: &mut VectorOf<M>,
    ) -> Result<(), Error>;
}
