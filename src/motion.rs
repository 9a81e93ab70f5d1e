//! The motion within one step, shown while the run is made.

use crate::{Coordinates, Error, Inputs, Machine, State, System};

type VectorOf<M> = <<M as Machine>::System as System>::Vector;

/// The motion within one step of a run, as [`Simulation::each_step`](crate::Simulation::each_step) shows it: the continuous
/// extension of the method, on the constraints.
pub trait StepMotion<M: Machine> {
    /// Time at its beginning and at its end, in s.
    fn span(&self) -> [f64; 2];

    /// Whether it is one by Taylor series, whose motion is of a much higher degree than that of other methods.
    fn is_series(&self) -> bool;

    /// Goes to a fraction of the step, from 0 to 1: makes `q` and `v` the state there, of which nothing but their lengths was known, and
    /// returns its time in s.
    ///
    /// # Errors
    /// Where the method needs accelerations for it that do not exist, or the constraints cannot be met.
    fn state_at(
        &mut self,
        theta: f64,
        q: &mut VectorOf<M>,
        v: &mut VectorOf<M>,
    ) -> Result<f64, Error>;

    /// The state at a time within the step: the one that a sample of the run has there, bit for bit.
    ///
    /// # Errors
    /// As [`state_at`](Self::state_at).
    fn state(&mut self, t: f64) -> Result<State<Coordinates<M>>, Error>;

    /// The inputs at a state.
    fn inputs(&self, t: f64, q: &VectorOf<M>, v: &VectorOf<M>) -> Inputs<M>;

    /// Accelerations at time, state and inputs, with the contacts as they are in this step.
    ///
    /// # Errors
    /// Where there are none.
    fn accelerations(
        &self,
        at: (f64, &VectorOf<M>, &VectorOf<M>),
        u: &Inputs<M>,
        a: &mut VectorOf<M>,
    ) -> Result<(), Error>;
}
