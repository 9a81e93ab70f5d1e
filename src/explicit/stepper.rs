//! Steps of one machine in numbers of any kind.

use super::{Accelerate, Attempt, Outcome, Track, check};
use crate::control::{self, MAX_STEPS, Work};
use crate::inputs::{HeldInputs, InputLawIn};
use crate::interpolant::Interpolant;
use crate::methods::Method;
use crate::step_error::StepError;
use crate::step_number::Real;
use crate::tolerance::Tolerance;
use crate::{Singular, State, SystemIn, Vector};

/// Advances the state of a system by an explicit method, in numbers of any kind: in `f32`, in 32 digits, or with the derivative of
/// the whole run.
///
/// In `f64` its steps have the bits of a [`Stepper`](crate::Stepper). It supports machines without constraints and contacts, owns its
/// system and allocates nothing. Inputs are constant, or a [law](ExplicitStepperBuilder::input_law) sets them by time and state. It
/// evaluates the motion within its last step to the precision of its numbers.
///
/// ```
/// use lagrangian::ExplicitStepper;
/// use lagrangian::scalar::Dual;
///
/// lagrangian::machine! {
///     machine Oscillator in plane {
///         parameters { m: kg = 2, k: N/m = 8 }
///         coordinates { x: m = 1 }
///         bodies { block { mass: m, at: (x, 0) } }
///         springs { spring { stiffness: k, stretch: x } }
///     }
/// }
///
/// // How the place after one second depends on the spring: x = cos ωt, ω = √(k/m), so ∂x/∂k = −t sin ωt /(2 m ω).
/// let mut machine = Oscillator::default().map(Dual::constant);
/// machine.k = Dual::variable(8.0);
/// let mut stepper = ExplicitStepper::builder(machine.prepare()).start(machine.start())?;
/// stepper.advance_to(Dual::constant(1.0))?;
/// let x = stepper.state().q.x;
/// assert!((x.value - 2.0_f64.cos()).abs() < 1e-8);
/// assert!((x.derivative + 2.0_f64.sin() / 8.0).abs() < 1e-8);
/// # Ok::<(), lagrangian::StepError>(())
/// ```
#[derive(Clone, Debug)]
pub struct ExplicitStepper<S: SystemIn<N>, N: Real, L = HeldInputs<<S as SystemIn<N>>::Inputs>> {
    system: S,
    law: L,
    track: Track<N, S::Vector>,
    max_steps: usize,
    /// Whether the present acceleration must be evaluated again.
    changed: bool,
}

/// Builds a stepper: [`ExplicitStepper::builder`] creates it and [`start`](Self::start) returns the stepper.
#[derive(Clone, Debug)]
#[must_use = "call `start(state)` to obtain a stepper"]
pub struct ExplicitStepperBuilder<
    S: SystemIn<N>,
    N: Real,
    L = HeldInputs<<S as SystemIn<N>>::Inputs>,
> {
    system: S,
    law: L,
    method: &'static Method,
    tolerance: Tolerance<S::Vector>,
    first_step: f64,
    longest_step: f64,
    max_steps: usize,
}

/// A system with the law of its inputs.
struct SystemWithLaw<'s, S, L>(&'s S, &'s L);

impl<N: Real, S: SystemIn<N>, L: InputLawIn<S, N>> Accelerate<N, S::Vector>
    for SystemWithLaw<'_, S, L>
{
    #[inline(always)]
    fn accelerate(
        &self,
        t: N,
        q: &S::Vector,
        v: &S::Vector,
        a: &mut S::Vector,
    ) -> Result<(), N::Each<Option<Singular>>> {
        let Self(system, law) = self;
        let mut inputs = system.default_inputs();
        law.set(system, t, q, v, &mut inputs);
        let result = system.accelerations(t, q, v, &inputs, a);
        result.map_err(|singular| N::each(|_| Some(singular)))
    }
}

impl<S: SystemIn<N>, N: Real> ExplicitStepper<S, N> {
    /// A builder of a stepper that owns `system`. Defaults: [`Method::DOP853`], the inputs of the description, and a tolerance that
    /// depends on the numbers: 10⁻⁵ in `f32`, 10⁻⁹ in `f64`, 10⁻²⁴ in double-doubles.
    pub fn builder(system: S) -> ExplicitStepperBuilder<S, N> {
        let zeros = S::Vector::zeros(system.coordinates().len());
        ExplicitStepperBuilder {
            law: HeldInputs(system.default_inputs()),
            method: Default::default(),
            tolerance: Tolerance {
                relative: 0.0,
                absolute: zeros,
            },
            first_step: 0.0,
            longest_step: f64::INFINITY,
            max_steps: MAX_STEPS,
            system,
        }
        .tolerance(N::TOLERANCE)
    }

    /// Sets the inputs from now on. The last step is unaffected.
    pub fn set_inputs(&mut self, inputs: S::Inputs) {
        self.set_law(HeldInputs(inputs));
    }
}

impl<S: SystemIn<N>, N: Real, L: InputLawIn<S, N>> ExplicitStepper<S, N, L> {
    /// Takes one step, which ends at the end that was set or before it.
    ///
    /// # Errors
    /// If a step cannot be taken; the present state is then the end of the last good one.
    pub fn step(&mut self) -> Result<(), StepError> {
        if self.is_done() {
            return Ok(());
        }
        let machine = SystemWithLaw(&self.system, &self.law);
        if self.changed {
            self.track.evaluate_now(&machine)?;
            self.changed = false;
        }
        self.track.choose_first_step(&machine);
        loop {
            match N::run(Attempt(&mut self.track, &machine)).as_ref()[0] {
                Outcome::Idle | Outcome::Taken => return Ok(()),
                Outcome::GivenUp => {}
                Outcome::Failed(error) => return Err(error),
            }
        }
    }

    /// Steps to time `t`, in s, later or earlier than now, and stops there: a step ends at `t`. The derivative of a dual number `t` is
    /// that of the end time of the run.
    ///
    /// # Errors
    /// If a step cannot be taken, or more steps are needed than [allowed](ExplicitStepperBuilder::max_steps); the present state is then
    /// the end of the last good step. If `t` is not a finite number; then nothing happens.
    pub fn advance_to(&mut self, t: N) -> Result<(), StepError> {
        if !t.are_finite().as_ref()[0] {
            return Err(StepError::NoTime { t: t.to_f64() });
        }
        self.set_end(t);
        let mut taken = 0;
        while !self.is_done() {
            control::check_count(taken, self.max_steps, self.t().to_f64())?;
            self.step()?;
            taken += 1;
        }
        Ok(())
    }

    /// Sets another end, later or earlier than now.
    pub fn set_end(&mut self, t: N) {
        self.track.set_end(t);
    }

    /// Whether the end is reached.
    pub fn is_done(&self) -> bool {
        self.track.is_done(0)
    }

    /// Replaces the law of the inputs by another of the same type from now on. The last step is unaffected. If the method needs
    /// evaluations for an [`interpolant`](Self::interpolant) of it, request it before.
    pub fn set_law(&mut self, law: L) {
        self.law = law;
        self.changed = true;
    }

    /// The inputs at the present state.
    pub fn inputs(&self) -> S::Inputs {
        let mut inputs = self.system.default_inputs();
        let (t, q, v) = (self.t(), self.q(), self.v());
        self.law.set(&self.system, t, q, v, &mut inputs);
        inputs
    }

    /// The system.
    pub fn system(&self) -> &S {
        &self.system
    }

    /// Time and state under the names of the machine; the time in `f64`.
    pub fn state(&self) -> State<S::Coordinates> {
        State {
            t: self.track.t().to_f64(),
            q: self.system.to_coordinates(self.track.q()),
            v: self.system.to_coordinates(self.track.v()),
        }
    }

    /// Time, in s.
    pub fn t(&self) -> N {
        self.track.t()
    }

    /// Coordinates.
    pub fn q(&self) -> &S::Vector {
        self.track.q()
    }

    /// Rates of the coordinates.
    pub fn v(&self) -> &S::Vector {
        self.track.v()
    }

    /// Accelerations, with the inputs of the last step.
    pub fn a(&self) -> &S::Vector {
        self.track.a()
    }

    /// Time at the beginning of the last step, in s; the present time before the first step.
    pub fn t_before(&self) -> N {
        self.track.before().t
    }

    /// Coordinates at the beginning of the last step.
    pub fn q_before(&self) -> &S::Vector {
        &self.track.before().q
    }

    /// Rates at the beginning of the last step.
    pub fn v_before(&self) -> &S::Vector {
        &self.track.before().v
    }

    /// Accelerations at the beginning of the last step.
    pub fn a_before(&self) -> &S::Vector {
        self.track.a_before()
    }

    /// The motion within the last step at the fraction `theta` of it, as the Hermite polynomial of order 5, which is accurate
    /// enough for the search for events. Unlike [`interpolant`](Self::interpolant) it never costs an evaluation. Before the first
    /// step it is NaN.
    pub fn hermite(&self, theta: N) -> (S::Vector, S::Vector) {
        self.track.hermite(theta)
    }

    /// The dense output of the last step: the motion between its ends, in the numbers of the run.
    ///
    /// It costs the evaluations that the method needs beyond its step: 3 for `dop853`, none for the others.
    ///
    /// # Errors
    /// If there is no step yet; if the inputs were changed after it and the method needs evaluations; if a stage has no accelerations.
    pub fn interpolant(&mut self) -> Result<Interpolant<S::Vector, N>, StepError> {
        let t = self.t().to_f64();
        if !self.track.is_after_step() {
            return Err(StepError::OutsideStep { t, from: t, to: t });
        }
        if self.changed && self.track.dense_needs_evaluations() {
            return Err(StepError::Changed { t });
        }
        self.track
            .interpolant(&SystemWithLaw(&self.system, &self.law))
    }

    /// The state at a time within the last step, from [`t_before`](Self::t_before) to now, by the dense output of the method.
    /// The derivative of a dual number `t` is that of this time.
    ///
    /// It costs as much as [`interpolant`](Self::interpolant), which is better for many times.
    ///
    /// # Errors
    /// If `t` is outside of the last step, or [as for `interpolant`](Self::interpolant).
    pub fn state_at(&mut self, t: N) -> Result<State<S::Coordinates>, StepError> {
        let before = self.t_before();
        let [at, from, to] = [t, before, self.t()].map(N::to_f64);
        if !(from.min(to) <= at && at <= from.max(to)) {
            return Err(StepError::OutsideStep { t: at, from, to });
        }
        if t == self.t() {
            return Ok(self.state());
        }
        let (q, v) = self.interpolant()?.state(t);
        Ok(State {
            t: at,
            q: self.system.to_coordinates(&q),
            v: self.system.to_coordinates(&v),
        })
    }

    /// Length of the last step, in s; negative backward in time.
    pub fn last_step(&self) -> f64 {
        self.track.last_step()
    }

    /// The length of the next step to be tried, in s.
    pub fn next_step(&self) -> f64 {
        self.track.next_step()
    }

    /// The work done so far.
    pub fn work(&self) -> Work {
        self.track.work(0)
    }
}

impl<S: SystemIn<N>, N: Real, L> ExplicitStepperBuilder<S, N, L> {
    /// The method of integration, an explicit one. In double-doubles the [`METHODS`](crate::METHODS) keep their order beyond the digits
    /// of `f64`; any other method is an error there.
    pub fn method(mut self, method: &'static Method) -> Self {
        self.method = method;
        self
    }

    /// The tolerance of each step, relative and absolute: the error in a number `y` is kept below `tolerance · (1 + |y|)`. The
    /// derivatives of dual numbers are controlled in the same way.
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance.relative = tolerance;
        let absolute = self.tolerance.absolute.as_mut_slice();
        absolute.fill(N::from_f64(tolerance));
        self
    }

    /// The tolerances of a step: a relative one, and absolute ones for each coordinate and rate in their units.
    pub fn tolerances(mut self, tolerance: Tolerance<S::Vector>) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The length of the first step, in s, which is otherwise chosen from the motion at the start.
    pub fn first_step(mut self, step: f64) -> Self {
        self.first_step = step.abs();
        self
    }

    /// The length of the longest step, in s.
    pub fn longest_step(mut self, step: f64) -> Self {
        self.longest_step = step;
        self
    }

    /// The largest number of steps of one [`advance_to`](ExplicitStepper::advance_to), ten million by default; if more are needed, it
    /// returns an error.
    pub fn max_steps(mut self, steps: usize) -> Self {
        self.max_steps = steps;
        self
    }

    /// The inputs, which stay constant until others are [set](ExplicitStepper::set_inputs).
    pub fn inputs(self, inputs: S::Inputs) -> ExplicitStepperBuilder<S, N> {
        self.input_law(HeldInputs(inputs))
    }

    /// The law by which time and state set the inputs, in the numbers of the run, so that the derivative of a controlled run is that of
    /// machine and controller together.
    ///
    /// ```
    /// use lagrangian::scalar::Dual;
    /// use lagrangian::{ExplicitStepper, InputFunction};
    ///
    /// lagrangian::machine! {
    ///     machine Cart in plane {
    ///         coordinates { x: m = 1 }
    ///         inputs { push: N }
    ///         bodies { cart { mass: 1, at: (x, 0) } }
    ///         forces { drive { on: x, value: push } }
    ///     }
    /// }
    ///
    /// // x″ = −k x: the derivative of cos √k t by the gain, at k = 4 and t = 1, is −(sin 2)/4.
    /// let gain = Dual::variable(4.0);
    /// let law = InputFunction(move |_t, q: &cart::Coordinates<_>, _v: &cart::Coordinates<_>, u: &mut cart::Inputs<_>| {
    ///     u.push = -(gain * q.x);
    /// });
    /// let machine = Cart::default().map(Dual::constant);
    /// let mut stepper = ExplicitStepper::builder(machine.prepare()).input_law(law).start(machine.start())?;
    /// stepper.advance_to(Dual::constant(1.0))?;
    /// assert!((stepper.state().q.x.derivative + 2.0_f64.sin() / 4.0).abs() < 1e-8);
    /// # Ok::<(), lagrangian::StepError>(())
    /// ```
    pub fn input_law<M: InputLawIn<S, N>>(self, law: M) -> ExplicitStepperBuilder<S, N, M> {
        let Self {
            system,
            law: _,
            method,
            tolerance,
            first_step,
            longest_step,
            max_steps,
        } = self;
        ExplicitStepperBuilder {
            system,
            law,
            method,
            tolerance,
            first_step,
            longest_step,
            max_steps,
        }
    }

    /// Starts the stepper at a state.
    ///
    /// # Errors
    /// If the accelerations at the start have no value; if the method is not explicit, or its coefficients are known to fewer digits
    /// than the numbers have.
    pub fn start(self, state: State<S::Coordinates>) -> Result<ExplicitStepper<S, N, L>, StepError>
    where
        L: InputLawIn<S, N>,
    {
        let Self {
            system,
            law,
            method,
            tolerance,
            first_step,
            longest_step,
            max_steps,
        } = self;
        let start = (
            N::from_f64(state.t),
            system.to_vector(&state.q),
            system.to_vector(&state.v),
        );
        check::<N>(method, state.t)?;
        let mut track = Track::begin(method, tolerance, start, &SystemWithLaw(&system, &law))?;
        track.set_longest_step(longest_step);
        if first_step.is_finite() {
            track.set_first_step(first_step);
        }
        Ok(ExplicitStepper {
            system,
            law,
            track,
            max_steps,
            changed: false,
        })
    }
}
