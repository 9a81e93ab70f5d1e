//! A stepper that owns its system, for control loops in which inputs are set from outside.

use core::ops::Deref;

use super::Stepper;
use crate::balance::{NoBalance, Quadratures};
use crate::control::{self, MAX_STEPS};
use crate::inputs::{HeldInputs, InputLaw};
use crate::methods::Method;
use crate::step_error::StepError;
use crate::tolerance::Tolerance;
use crate::{State, System, Vector};

/// A borrowed or an owned system.
#[derive(Clone, Debug)]
pub(crate) enum BorrowedOrOwned<'s, S> {
    Borrowed(&'s S),
    Own(S),
}

impl<S> BorrowedOrOwned<'_, S> {
    #[inline(always)]
    pub fn get(&self) -> &S {
        match self {
            Self::Borrowed(system) => system,
            Self::Own(system) => system,
        }
    }
}

impl<S> Deref for BorrowedOrOwned<'_, S> {
    type Target = S;

    #[inline(always)]
    fn deref(&self) -> &S {
        self.get()
    }
}

/// A stepper that owns its system and whose inputs are set from outside.
pub type ControlledStepper<S> = Stepper<'static, S, HeldInputs<<S as System>::Inputs>>;

/// Builds a stepper: [`Stepper::builder`] creates it and [`start`](Self::start) returns the stepper.
#[derive(Clone, Debug)]
#[must_use = "call `start(state)` to obtain a stepper"]
pub struct StepperBuilder<S: System> {
    system: S,
    inputs: S::Inputs,
    method: &'static Method,
    tolerance: Tolerance<S::Vector>,
    first_step: Option<f64>,
    longest_step: f64,
    max_steps: usize,
}

impl<S: System> Stepper<'static, S, HeldInputs<S::Inputs>> {
    /// A builder of a stepper that owns `system`. Defaults: the default method, a tolerance of 10⁻⁹ and the inputs of the description.
    ///
    /// The stepper allocates nothing while it steps. [`advance_to`](Stepper::advance_to) takes it from one sample of a
    /// controller to the next:
    ///
    /// ```
    /// # mod by_hand { include!("../../tests/by_hand/toy.rs"); }
    /// use lagrangian::{Method, Stepper};
    ///
    /// // A mass of 1 kg that a force pushes, x″ = u: from rest, for one second each way.
    /// let mass = by_hand::Toy::new(([0.0], [0.0]), |_, _, _, u, _| [u]);
    /// let mut stepper = Stepper::builder(mass).method(Method::DOPRI5).tolerance(1e-10).start(mass.start())?;
    /// for (tick, force) in (1..).zip([1.0, -1.0]) {
    ///     stepper.set_inputs(force);
    ///     stepper.advance_to(f64::from(tick))?;
    /// }
    /// let state = stepper.state();
    /// assert!((state.q[0] - 1.0).abs() < 1e-14 && state.v[0].abs() < 1e-14);
    /// // Within the last step the motion is known as well: x = 1/2 + (t − 1) − (t − 1)²/2.
    /// assert!((stepper.state_at(1.5)?.q[0] - 0.875).abs() < 1e-14);
    /// # Ok::<(), lagrangian::StepError>(())
    /// ```
    pub fn builder(system: S) -> StepperBuilder<S> {
        let mut absolute = S::Vector::zeros(system.coordinates().len());
        absolute.as_mut_slice().fill(1e-9);
        StepperBuilder {
            inputs: system.default_inputs(),
            method: Default::default(),
            tolerance: Tolerance {
                relative: 1e-9,
                absolute,
            },
            first_step: None,
            longest_step: f64::INFINITY,
            max_steps: MAX_STEPS,
            system,
        }
    }
}

impl<S: System> StepperBuilder<S> {
    /// The method of integration, by default [`Method::DOP853`].
    pub fn method(mut self, method: &'static Method) -> Self {
        self.method = method;
        self
    }

    /// The tolerance of each step, relative and absolute: the error in a number `y` is kept below `tolerance · (1 + |y|)`.
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance.relative = tolerance;
        self.tolerance.absolute.as_mut_slice().fill(tolerance);
        self
    }

    /// The tolerances of a step: a relative one, and absolute ones for each coordinate and rate in their units.
    pub fn tolerances(mut self, tolerance: Tolerance<S::Vector>) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The length of the first step, in s, which is otherwise chosen from the motion at the start.
    pub fn first_step(mut self, step: f64) -> Self {
        self.first_step = Some(step);
        self
    }

    /// The length of the longest step, in s.
    pub fn longest_step(mut self, step: f64) -> Self {
        self.longest_step = step;
        self
    }

    /// The largest number of steps of one [`advance_to`](Stepper::advance_to): see [`set_max_steps`](Stepper::set_max_steps).
    pub fn max_steps(mut self, steps: usize) -> Self {
        self.max_steps = steps;
        self
    }

    /// The inputs at the start.
    pub fn inputs(mut self, inputs: S::Inputs) -> Self {
        self.inputs = inputs;
        self
    }

    /// Starts the stepper at a state. A machine with constraints starts at the nearest state that satisfies them.
    ///
    /// # Errors
    /// If the accelerations at the start have no value, if no state nearby satisfies the constraints, or if the machine has
    /// unilateral contacts, which only a [`Simulation`](crate::Simulation) follows.
    pub fn start(self, state: State<S::Coordinates>) -> Result<ControlledStepper<S>, StepError> {
        let Self {
            system,
            inputs,
            method,
            tolerance,
            first_step,
            longest_step,
            max_steps,
        } = self;
        let start = (
            state.t,
            system.to_vector(&state.q),
            system.to_vector(&state.v),
        );
        ControlledStepper::check(&system, &start)?;
        let law = HeldInputs(inputs);
        let own = BorrowedOrOwned::Own(system);
        let mut stepper = ControlledStepper::begun(
            own,
            law,
            NoBalance,
            method,
            tolerance,
            (start, None),
            state.t,
        )?;
        stepper.set_longest_step(longest_step);
        stepper.set_max_steps(max_steps);
        let is_length = |step: &f64| step.is_finite();
        stepper.control.step = first_step.filter(is_length).map_or(0.0, f64::abs);
        Ok(stepper)
    }
}

impl<S: System, A: Quadratures<S>> Stepper<'_, S, HeldInputs<S::Inputs>, A> {
    /// Sets the inputs from now on. Allocates nothing for compiled machines.
    ///
    /// The last step is unaffected; see [`inputs_changed`](Self::inputs_changed).
    pub fn set_inputs(&mut self, inputs: S::Inputs) {
        self.set_law(HeldInputs(inputs));
    }
}

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// Steps to time `t`, later or earlier than now, and stops there: a step ends at `t`.
    ///
    /// # Errors
    /// If a step cannot be taken, or more steps are needed than [allowed](Self::set_max_steps); the present state is then the end of
    /// the last good step. If `t` is not a finite number; then nothing happens.
    pub fn advance_to(&mut self, t: f64) -> Result<(), StepError> {
        if !t.is_finite() {
            return Err(StepError::NoTime { t });
        }
        self.set_end(t);
        let mut taken = 0;
        while !self.is_done() {
            control::check_count(taken, self.max_steps, self.now.t)?;
            self.step()?;
            taken += 1;
        }
        Ok(())
    }

    /// Time and state, under the names of the machine.
    pub fn state(&self) -> State<S::Coordinates> {
        let system = self.model.system.get();
        State {
            t: self.now.t,
            q: system.to_coordinates(&self.now.q),
            v: system.to_coordinates(&self.now.v),
        }
    }

    /// The state at a time within the last step, from [`t_before`](Self::t_before) to now: by the dense output of the
    /// method, projected onto the constraints.
    ///
    /// It costs as much as [`interpolant`](Self::interpolant), which is better for many times.
    ///
    /// # Errors
    /// If `t` is outside of the last step, or [as for `interpolant`](Self::interpolant) after the inputs were changed.
    pub fn state_at(&mut self, t: f64) -> Result<State<S::Coordinates>, StepError> {
        let (from, to) = (self.before.t, self.now.t);
        if !(from.min(to) <= t && t <= from.max(to)) {
            return Err(StepError::OutsideStep { t, from, to });
        }
        if t == to {
            return Ok(self.state());
        }
        let (q, v) = if t == from {
            (self.before.q.clone(), self.before.v.clone())
        } else {
            let (mut q, mut v) = self.interpolant()?.state(t);
            self.project(t, &mut q, &mut v)?;
            (q, v)
        };
        let system = self.model.system.get();
        Ok(State {
            t,
            q: system.to_coordinates(&q),
            v: system.to_coordinates(&v),
        })
    }
}
