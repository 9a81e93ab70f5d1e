//! Simulations that are taken from one instant to the next by their caller.

use crate::inputs::{DefaultInputs, Law};
use crate::run::in_pieces::PreparedRun;
use crate::settings::Task;
use crate::{Coordinates, Error, Machine, Simulation, State};

impl<'a, M: Machine<System: 'a>> Simulation<'a, M, DefaultInputs> {
    /// Prepares a run whose end and inputs are not known in advance, such as one that goes on beside another program: it is taken from one instant
    /// to the next by [`advance_to`](crate::RunInPieces::advance_to), and its inputs are set in between. Events, contacts, friction and
    /// constraints are those of any run, which a [`Stepper`](crate::Stepper) has only in part. Nothing is recorded, so that the run may be of
    /// any length, and the end of this simulation does not matter.
    ///
    /// ```
    /// use lagrangian::Simulation;
    ///
    /// lagrangian::machine! {
    ///     machine Lift in plane {
    ///         parameters { m: kg = 0.1, e: 1 = 0.5, g: m/s^2 = 10 }
    ///         coordinates { y: m = 0.2 }
    ///         inputs { push: N = 0 }
    ///         bodies { ball { mass: m, at: (0, y) } }
    ///         gravity (0, -g);
    ///         forces { thrust { on: y, value: push } }
    ///         contacts { floor { gap: y, restitution: e } }
    ///     }
    /// }
    ///
    /// // It falls for 0.2 s, bounces with half its speed of 2 m/s, and is lifted from t = 0.3 s on with 10 m/s² upwards.
    /// let lift = Lift::default();
    /// let mut prepared = Simulation::new(&lift).prepare(lift.start())?;
    /// let mut run = prepared.begin()?;
    /// run.advance_to(0.3)?;
    /// assert!(run.state().v.y.abs() < 1e-8);
    /// let mut inputs = run.observe()?.inputs;
    /// inputs.push = 2.0;
    /// run.set_inputs(inputs)?;
    /// run.advance_to(0.5)?;
    /// assert!((run.state().v.y - 2.0).abs() < 1e-8 && (run.state().q.y - 0.25).abs() < 1e-8);
    /// assert_eq!(run.take_contact_events().len(), 1);
    /// # Ok::<(), lagrangian::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`run`](Simulation::run) before its first step.
    pub fn prepare(mut self, start: State<Coordinates<M>>) -> Result<PreparedRun<'a, M>, Error> {
        let settings = &mut self.settings;
        settings.until = Some(start.t);
        settings.keep_steps = false;
        settings.keep_energies = false;
        settings.keep_contact_phases = false;
        let task = Task {
            subject: self.subject,
            law: Law::of(&DefaultInputs),
            settings: self.settings,
            callbacks: self.callbacks,
            resumed: self.resumed,
        };
        PreparedRun::new(task, start)
    }
}
