//! Steps of one machine in numbers of any kind.

use super::{Accelerate, Outcome, Track};
use crate::methods::Method;
use crate::step_error::StepError;
use crate::step_number::Real;
use crate::stepper::Work;
use crate::tolerance::Tolerance;
use crate::{Singular, State, SystemIn, Vector};

/// Advances the state of a system by an explicit method, in numbers of any kind: in `f32`, in 32 digits, or with the derivative of
/// the whole run.
///
/// In `f64` it takes the steps of a [`Stepper`](crate::Stepper), bit for bit. It is for machines without constraints and contacts; it
/// owns its system, holds its inputs, and allocates nothing.
///
#[cfg_attr(feature = "macros", doc = "```")]
#[cfg_attr(not(feature = "macros"), doc = "```ignore")]
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
pub struct ExplicitStepper<S: SystemIn<N>, N: Real> {
    system: S,
    inputs: S::Inputs,
    track: Track<N, S::Vector>,
    /// Whether the acceleration now has to be found again.
    changed: bool,
}

/// A stepper in the making: what [`ExplicitStepper::builder`] begins and [`start`](Self::start) ends.
#[derive(Clone, Debug)]
#[must_use = "a stepper comes of it by `start(state)`"]
pub struct ExplicitStepperBuilder<S: SystemIn<N>, N: Real> {
    system: S,
    inputs: S::Inputs,
    method: &'static Method,
    tolerance: Tolerance<S::Vector>,
    first_step: f64,
    longest_step: f64,
}

/// A system with its inputs.
struct With<'s, S: SystemIn<N>, N: Real>(&'s S, &'s S::Inputs);

impl<S: SystemIn<N>, N: Real> Accelerate<N, S::Vector> for With<'_, S, N> {
    #[inline(always)]
    fn accelerate(
        &self,
        t: N,
        q: &S::Vector,
        v: &S::Vector,
        a: &mut S::Vector,
    ) -> Result<(), N::Each<Option<Singular>>> {
        let Self(system, inputs) = self;
        let found = system.accelerations(t, q, v, inputs, a);
        found.map_err(|singular| N::each(|_| Some(singular)))
    }
}

impl<S: SystemIn<N>, N: Real> ExplicitStepper<S, N> {
    /// A stepper that owns `system`, in the making: by [`Method::DOP853`], with the inputs of the description and the tolerance of the
    /// numbers: 10⁻⁵ in `f32`, 10⁻⁹ in `f64`, 10⁻²⁴ in double-doubles.
    pub fn builder(system: S) -> ExplicitStepperBuilder<S, N> {
        let zeros = S::Vector::zeros(system.coordinates().len());
        ExplicitStepperBuilder {
            inputs: system.default_inputs(),
            method: Default::default(),
            tolerance: Tolerance {
                relative: 0.0,
                absolute: zeros,
            },
            first_step: 0.0,
            longest_step: f64::INFINITY,
            system,
        }
        .tolerance(N::TOLERANCE)
    }

    /// Takes one step. It ends at the end that was set, or short of it.
    ///
    /// # Errors
    /// If a step cannot be taken; now is then where the last good one ended.
    pub fn step(&mut self) -> Result<(), StepError> {
        if self.is_done() {
            return Ok(());
        }
        let machine = With(&self.system, &self.inputs);
        if self.changed {
            self.track.look(&machine)?;
            self.changed = false;
        }
        self.track.choose_first_step(&machine);
        loop {
            match self.track.attempt(&machine).as_ref()[0] {
                Outcome::Idle | Outcome::Taken => return Ok(()),
                Outcome::GivenUp => {}
                Outcome::Failed(error) => return Err(error),
            }
        }
    }

    /// Steps to time `t`, in s, later or earlier than now, and stands there: a step ends at `t`. Of a dual number, the derivative is
    /// that of the time at which the run ends.
    ///
    /// # Errors
    /// If a step cannot be taken; now is then where the last good one ended. If `t` is not a finite number; then nothing happens.
    pub fn advance_to(&mut self, t: N) -> Result<(), StepError> {
        if !t.are_finite().as_ref()[0] {
            return Err(StepError::NoTime { t: t.to_f64() });
        }
        self.set_end(t);
        while !self.is_done() {
            self.step()?;
        }
        Ok(())
    }

    /// Goes on to another end, later or earlier than now.
    pub fn set_end(&mut self, t: N) {
        self.track.set_end(t);
    }

    /// Whether the end is reached.
    pub fn is_done(&self) -> bool {
        self.track.is_done(0)
    }

    /// Sets the inputs from now on.
    pub fn set_inputs(&mut self, inputs: S::Inputs) {
        self.inputs = inputs;
        self.changed = true;
    }

    /// The inputs that act from now on.
    pub fn inputs(&self) -> &S::Inputs {
        &self.inputs
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

    /// Length of the last step, in s; negative backward in time.
    pub fn last_step(&self) -> f64 {
        self.track.last_step()
    }

    /// The step to be tried next, in s.
    pub fn next_step(&self) -> f64 {
        self.track.next_step()
    }

    /// The work done so far.
    pub fn work(&self) -> Work {
        self.track.work(0)
    }
}

impl<S: SystemIn<N>, N: Real> ExplicitStepperBuilder<S, N> {
    /// The method of integration, an explicit one. In double-doubles it is of its order beyond the digits of `f64` if it is one of
    /// [`METHODS`](crate::METHODS); another one is an error there.
    pub fn method(mut self, method: &'static Method) -> Self {
        self.method = method;
        self
    }

    /// How exact each step shall be, relative and absolute: the error in a number `y` is kept below `tolerance · (1 + |y|)`. So it is
    /// with derivatives of dual numbers.
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance.relative = tolerance;
        let absolute = self.tolerance.absolute.as_mut_slice();
        absolute.fill(N::from_f64(tolerance));
        self
    }

    /// The same, relative and for each coordinate.
    pub fn tolerances(mut self, tolerance: Tolerance<S::Vector>) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The length of the first step, in s, which otherwise is chosen by the motion at the start.
    pub fn first_step(mut self, step: f64) -> Self {
        self.first_step = step.abs();
        self
    }

    /// The greatest length of a step, in s.
    pub fn longest_step(mut self, step: f64) -> Self {
        self.longest_step = step;
        self
    }

    /// The inputs at the start.
    pub fn inputs(mut self, inputs: S::Inputs) -> Self {
        self.inputs = inputs;
        self
    }

    /// The stepper, at a state.
    ///
    /// # Errors
    /// Where the accelerations at the start have no value; for a method that is not explicit, or whose coefficients are known to fewer
    /// digits than the numbers have.
    pub fn start(self, state: State<S::Coordinates>) -> Result<ExplicitStepper<S, N>, StepError> {
        let Self {
            system,
            inputs,
            method,
            tolerance,
            first_step,
            longest_step,
        } = self;
        let start = (
            N::from_f64(state.t),
            system.to_vector(&state.q),
            system.to_vector(&state.v),
        );
        let mut track = Track::begin(method, tolerance, start, &With(&system, &inputs))?;
        let is_length = |step: f64| step.is_finite() && step > 0.0;
        if is_length(longest_step) {
            track.set_longest_step(longest_step);
        }
        if is_length(first_step) {
            track.set_first_step(first_step);
        }
        Ok(ExplicitStepper {
            system,
            inputs,
            track,
            changed: false,
        })
    }
}
