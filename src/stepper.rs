//! The stepper: takes one step after another, with constraints and contacts. Every run is built on it. It allocates nothing and needs no
//! standard library, except for implicit methods, whose memory comes from an allocator.

#[cfg(feature = "std")]
mod along_dense_output;
#[cfg(feature = "std")]
mod beyond_jump;
#[cfg(feature = "std")]
mod changing;
#[cfg(feature = "std")]
mod contact_changes;
#[cfg(feature = "std")]
mod handing_over;
#[cfg(feature = "std")]
mod implicitly;
#[cfg(feature = "std")]
mod in_impulses;
#[cfg(feature = "std")]
pub(crate) mod in_lanes;
#[cfg(feature = "std")]
mod in_series;
mod kernels;
mod of_fixed_length;

mod owned;
#[cfg(feature = "std")]
pub(crate) use contact_changes::{Cause, ContactChanges};

pub(crate) use owned::BorrowedOrOwned;
pub use owned::{ControlledStepper, StepperBuilder};

use crate::at::At;
use crate::attempt::{self, not_finite};
use crate::balance::{NoBalance, Quadratures};
#[cfg(feature = "std")]
use crate::compensated::Sum;
use crate::constraints::Constraints;
#[cfg(feature = "std")]
use crate::contact::{ContactMemory, UnilateralState};
use crate::control::{self, Control, MAX_STEPS, Work};
#[cfg(feature = "std")]
use crate::friction::Change;
use crate::friction::Contacts;
#[cfg(feature = "std")]
use crate::implicit::Implicit;
use crate::inputs::{DefaultInputs, InputLaw};
use crate::interpolant::{Ends, Interpolant, hermite};
use crate::math::sqrt;
#[cfg(doc)]
use crate::methods::Tableau;
use crate::methods::{MAX_STAGES, Method, MethodKind};
use crate::scalar::Scalar;
use crate::stages::{Point, in_blocks, weigh};
use crate::step_error::StepError;
#[cfg(feature = "std")]
use crate::taylor::Taylor;
use crate::tolerance::{LEAST_RELATIVE_TOLERANCE, Tolerance};
use crate::{ContactTrouble, Number, System, Vector};
#[cfg(feature = "std")]
use in_impulses::InImpulses;
use kernels::Attempt;
#[cfg(feature = "std")]
use kernels::Finish;
#[cfg(feature = "std")]
use of_fixed_length::Fixed;
#[cfg(feature = "std")]
use std::boxed::Box;

/// A stiffness test is made every so many steps, as in DOP853.
const STEPS_BETWEEN_STIFFNESS_TESTS: usize = 1000;

/// When constraints become dependent, errors across them up to this, relative and absolute, are round-off: 10⁻¹⁶ in a constraint becomes
/// 10⁻⁵ in the accelerations of a stage if the weakest row has 3·10⁻⁴ of its length left, and a hundredth of that in the result of a step.
const ROUNDOFF_ACROSS: f64 = 1e-7;

/// Advances the state of a system, step by step, with steps as long as the tolerance allows.
///
/// State and time are compensated sums, so adding up steps contributes no round-off.
#[derive(Clone, Debug)]
pub struct Stepper<'s, S: System, L = DefaultInputs, A = NoBalance> {
    method: &'static Method,
    tolerance: Tolerance<S::Vector>,
    model: Model<'s, S, L>,
    quadratures: A,
    end: f64,
    longest: f64,

    /// The present state.
    now: Point<S::Vector>,
    /// The beginning of the last step; equal to `now` before the first.
    before: Point<S::Vector>,
    /// Accelerations at the stages of the last step; the first one belongs to `before`.
    k: [S::Vector; MAX_STAGES],
    /// The index of the present acceleration in `k`.
    newest: usize,
    /// The state at a stage.
    stage: (S::Vector, S::Vector),

    /// Step size control.
    control: Control,
    /// The largest number of steps of one [`advance_to`](Self::advance_to).
    max_steps: usize,
    stiffness: Stiffness,
    /// Number of steps between two stiffness tests.
    between_tests: usize,
    /// Whether the present acceleration must be evaluated again, since something that it depends on has changed.
    changed: bool,
    /// `None` for explicit methods.
    #[cfg(feature = "std")]
    implicit: Option<Box<Implicit>>,
    /// `None` unless the method is by Taylor series.
    #[cfg(feature = "std")]
    taylor: Option<Box<Taylor<S::Vector>>>,
    /// `None` unless the method is time stepping.
    #[cfg(feature = "std")]
    impulses: Option<Box<InImpulses<S::Vector>>>,
    /// `None` for methods with steps of variable length, and for those that need no memory of their own.
    #[cfg(feature = "std")]
    fixed: Option<Box<Fixed<S::Vector, S::Matrix>>>,
}

/// Limits on the length of a step at its beginning, in s.
#[derive(Clone, Copy, Debug)]
struct StepLimits {
    /// Below this length a step is too small.
    shortest: f64,
    /// The signed distance to the end.
    distance_to_end: f64,
}

/// The equations of motion with their inputs.
#[derive(Clone, Debug)]
struct Model<'s, S: System, L> {
    system: BorrowedOrOwned<'s, S>,
    law: L,
    inputs: S::Inputs,
    /// `None` if the machine has no constraints.
    constraints: Option<Constraints<S::Vector>>,
    /// `None` if it has no guided contacts.
    contacts: Option<Contacts>,
    /// `None` if it has no unilateral contacts. The closed ones are among `constraints`.
    #[cfg(feature = "std")]
    touching: Option<UnilateralState>,
    /// Memory for evaluations of these; `None` before the first one.
    #[cfg(feature = "std")]
    contact_memory: Option<Box<ContactMemory<S::Vector, S::Matrix>>>,
}

/// State of the stiffness test of DOP853 (section IV.2 of the second volume).
#[derive(Clone, Copy, Debug, Default)]
struct Stiffness {
    signs: u32,
    none_since: u32,
    /// The length of the longest step among those with positive tests, in s.
    longest: f64,
    since: Option<f64>,
}

impl<'s, S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'s, S, L, A> {
    /// Prepares a motion from time `t`, with `q` and `v`, to time `end`, later or earlier. A machine with constraints starts at the
    /// nearest state that satisfies them, in the metric of its inertia.
    ///
    /// # Errors
    /// If the accelerations at the start have no value, or no state nearby satisfies the constraints.
    pub fn new(
        system: &'s S,
        law: L,
        quadratures: A,
        method: &'static Method,
        tolerance: Tolerance<S::Vector>,
        start: (f64, S::Vector, S::Vector),
        end: f64,
    ) -> Result<Self, StepError> {
        Self::check(system, &start)?;
        let system = BorrowedOrOwned::Borrowed(system);
        Self::begun(system, law, quadratures, method, tolerance, start, end)
    }

    /// Checks that a stepper alone can follow a machine.
    fn check(system: &S, start: &(f64, S::Vector, S::Vector)) -> Result<(), StepError> {
        // Impacts and changes of unilateral contacts are events, which only a run locates.
        if system.unilateral_contacts().len() != 0 {
            return Err(StepError::Contact {
                contact: 0,
                trouble: ContactTrouble::NotFollowed,
                t: start.0,
            });
        }
        Ok(())
    }

    /// [`new`](Self::new) for a run, which locates the events of unilateral contacts.
    pub(crate) fn begun(
        system: BorrowedOrOwned<'s, S>,
        law: L,
        quadratures: A,
        method: &'static Method,
        tolerance: Tolerance<S::Vector>,
        (t, q, v): (f64, S::Vector, S::Vector),
        end: f64,
    ) -> Result<Self, StepError> {
        #[cfg(feature = "std")]
        let implicit = {
            let spectrum = method.tableau.spectrum;
            spectrum.map(|spectrum| Box::new(Implicit::new(system.get(), spectrum)))
        };
        #[cfg(not(feature = "std"))]
        if method.tableau.spectrum.is_some() || !method.needs_no_allocator() {
            return Err(StepError::NoWorkspace { t });
        }
        #[cfg(feature = "std")]
        if method.kind == MethodKind::Series {
            let inputs = !law.is_constant();
            if inputs || system.check_series().is_err() {
                return Err(StepError::NoSeries { inputs, t });
            }
        }
        let zeros = q.zeros_like();
        let mut start = Point::new(t, q, v);
        let mut constraints = None;
        if S::MAY_BE_CONSTRAINED && system.constraints().len() != 0 {
            let known = constraints.insert(Constraints::new(system.get(), &start.q, &start.v));
            known.begin(system.get(), &mut start.place(), None)?;
        }
        let mut stepper = Self {
            method,
            tolerance: Tolerance {
                relative: tolerance.relative.max(LEAST_RELATIVE_TOLERANCE),
                ..tolerance
            },
            model: Model {
                inputs: system.default_inputs(),
                system,
                law,
                constraints,
                contacts: None,
                #[cfg(feature = "std")]
                touching: None,
                #[cfg(feature = "std")]
                contact_memory: None,
            },
            quadratures,
            end,
            longest: f64::INFINITY,
            k: zeros.several_zeros_like(),
            newest: 0,
            stage: (zeros.clone(), zeros),
            before: start.clone(),
            now: start,
            control: Control::new(),
            max_steps: MAX_STEPS,
            stiffness: Stiffness::default(),
            between_tests: STEPS_BETWEEN_STIFFNESS_TESTS,
            changed: false,
            #[cfg(feature = "std")]
            implicit,
            #[cfg(feature = "std")]
            taylor: None,
            #[cfg(feature = "std")]
            impulses: None,
            #[cfg(feature = "std")]
            fixed: None,
        };
        #[cfg(feature = "std")]
        if let MethodKind::Fixed(rule) = method.kind {
            stepper.begin_fixed(rule)?;
        }
        #[cfg(feature = "std")]
        if method.kind == MethodKind::Impulses {
            let Point { q, v, .. } = &stepper.now;
            stepper.impulses = Some(Box::new(InImpulses::new(q, v)));
        }
        #[cfg(feature = "std")]
        if method.kind == MethodKind::Series {
            stepper.taylor = Some(Box::new(Taylor::new(&stepper.tolerance)));
            stepper.expand()?;
        }
        let Self {
            model,
            now,
            k,
            quadratures,
            control: Control { work, .. },
            ..
        } = &mut stepper;
        if S::MAY_SLIDE && model.system.contacts().len() != 0 {
            let Model { law, inputs, .. } = model;
            let system = model.system.get();
            law.set(system, now.t, &now.q, &now.v, inputs);
            let contacts = Contacts::begin(system, now.t, &now.q, &now.v, inputs)?;
            model.contacts = Some(contacts);
        }
        #[cfg(feature = "std")]
        if S::MAY_COLLIDE && model.system.unilateral_contacts().len() != 0 {
            model.touching = Some(UnilateralState::new(model.system.get()));
        }
        let result = model.accelerations(now.t, &now.q, &now.v, &mut k[0], work);
        if S::MAY_BE_CONSTRAINED
            && let Some(constraints) = &mut model.constraints
            && result.is_err()
            && constraints.notice_fork(
                [constraints.strength(model.system.get(), now.t, &now.q); 3],
                false,
            )
        {
            model.accelerations(now.t, &now.q, &now.v, &mut k[0], work)?;
        } else {
            result?;
        }
        if S::MAY_BE_CONSTRAINED
            && let Some(constraints) = &model.constraints
            && constraints.redundant
        {
            let at = At {
                t: now.t,
                q: &now.q,
                v: &now.v,
                u: &model.inputs,
            };
            constraints.check_accelerations(model.system.get(), at, &k[0])?;
        }
        model.take_rates(quadratures, 0, (now.t, &now.q, &now.v, &k[0]));
        Ok(stepper)
    }

    /// Time, in s.
    pub fn t(&self) -> f64 {
        self.now.t
    }

    /// Coordinates.
    pub fn q(&self) -> &S::Vector {
        &self.now.q
    }

    /// Rates of the coordinates.
    pub fn v(&self) -> &S::Vector {
        &self.now.v
    }

    /// Accelerations.
    pub fn a(&self) -> &S::Vector {
        &self.k[self.newest]
    }

    /// Time at the beginning of the last step, in s.
    pub fn t_before(&self) -> f64 {
        self.before.t
    }

    /// Coordinates at the beginning of the last step.
    pub fn q_before(&self) -> &S::Vector {
        &self.before.q
    }

    /// Rates at the beginning of the last step.
    pub fn v_before(&self) -> &S::Vector {
        &self.before.v
    }

    /// Accelerations at the beginning of the last step.
    pub fn a_before(&self) -> &S::Vector {
        &self.k[0]
    }

    /// Length of the last step, in s; negative backward in time.
    pub fn last_step(&self) -> f64 {
        self.control.last_step
    }

    /// The motion within the last step at the fraction `theta` of it, as the Hermite polynomial of order 5, which is accurate enough for
    /// the search for events. Unlike [`interpolant`](Self::interpolant) it never costs an evaluation.
    ///
    /// For a step by Taylor series it is the polynomial of the step, of the order of the method.
    pub fn hermite(&self, theta: f64) -> (S::Vector, S::Vector) {
        #[cfg(feature = "std")]
        if let Some(coefficients) = self.coefficients() {
            return crate::taylor::state(coefficients, theta * self.control.last_step);
        }
        hermite(
            self.control.last_step,
            [&self.before.q, &self.now.q],
            [&self.before.v, &self.now.v],
            [self.a_before(), self.a()],
            theta,
        )
    }

    /// Time at the beginning of the last step, with the compensation of its rounding.
    #[cfg(feature = "std")]
    pub(crate) fn beginning(&self) -> Sum {
        self.before.time()
    }

    /// Accelerations at the stages of the last step; the first one is at its beginning.
    #[cfg(feature = "std")]
    pub(crate) fn stages(&self) -> &[S::Vector; MAX_STAGES] {
        &self.k
    }

    /// The inputs of the last evaluation, which after a step are those of the present state.
    pub fn inputs(&self) -> &S::Inputs {
        &self.model.inputs
    }

    /// The largest residual of the constraints after any step, relative to the size of their terms; 0 for a machine without constraints.
    ///
    /// For positions it is `gₖ` relative to `Σⱼ |∂gₖ/∂qⱼ| |qⱼ|`; for rates, relative to
    /// `Σⱼ |Gₖⱼ| |vⱼ| + |∂gₖ/∂t|`. `|qⱼ|` and `|vⱼ|` are the largest values so far; an angle counts as
    /// at least 1 rad.
    pub fn constraint_residual(&self) -> f64 {
        let constraints = self.model.constraints.as_ref();
        constraints.map_or(0.0, |constraints| constraints.greatest_residual)
    }

    /// The tolerable error of a step in a coordinate, or its rate, of this size.
    pub(crate) fn tolerable(&self, coordinate: usize, size: f64) -> f64 {
        let Tolerance { relative, absolute } = &self.tolerance;
        absolute.as_slice()[coordinate] + relative * size.abs()
    }

    /// The relative tolerance.
    #[cfg(feature = "std")]
    pub(crate) fn relative_tolerance(&self) -> f64 {
        self.tolerance.relative
    }

    /// Whether the stages of the method are coupled.
    #[cfg(feature = "std")]
    pub(crate) fn is_implicit(&self) -> bool {
        self.implicit.is_some()
    }

    /// The state of the constraints.
    #[cfg(feature = "std")]
    pub(crate) fn constraints(&self) -> &Option<Constraints<S::Vector>> {
        &self.model.constraints
    }

    /// The state of the guided contacts.
    #[cfg(feature = "std")]
    pub(crate) fn contacts(&self) -> &Option<Contacts> {
        &self.model.contacts
    }

    /// Continues to `end` with contacts in other states: the motion is continuous and the accelerations jump. `is_at_once` says that the
    /// state that ended had only just begun.
    #[cfg(feature = "std")]
    pub(crate) fn change(
        &mut self,
        change: Change,
        is_at_once: bool,
        end: f64,
        step: f64,
    ) -> Result<(), StepError> {
        let Self { model, now, k, .. } = self;
        model
            .law
            .set(model.system.get(), now.t, &now.q, &now.v, &mut model.inputs);
        if S::MAY_SLIDE
            && let Some(contacts) = &mut model.contacts
        {
            let place = now.place();
            let at = (place.t, &*place.q[0], &model.inputs);
            let system = model.system.get();
            let has_veered = contacts.change(system, at, place.v, change, is_at_once)?;
            if has_veered && is_at_once {
                // The slip cannot turn instantaneously. It is the field of tangents that is discontinuous here, as every such field is
                // somewhere on a sphere. The next step has to begin beyond the discontinuity.
                move_by_rounding(&mut now.q, &now.v);
                contacts.record_headings(system, now.t, &now.q, &now.v);
            }
        }
        let newest = self.newest;
        let work = &mut self.control.work;
        model.accelerations(now.t, &now.q, &now.v, &mut k[newest], work)?;
        model.take_rates(
            &mut self.quadratures,
            0,
            (now.t, &now.q, &now.v, &k[newest]),
        );
        self.end = end;
        self.control.step = step;
        self.control.begin_anew();
        if let Some(implicit) = &mut self.implicit {
            implicit.forget();
        }
        #[cfg(feature = "std")]
        if let Some(fixed) = &mut self.fixed {
            fixed.forget();
        }
        Ok(())
    }

    /// The work done so far.
    pub fn work(&self) -> Work {
        self.control.work
    }

    /// The quadratures so far, which are integrated along the motion.
    pub fn quadratures(&self) -> &A {
        &self.quadratures
    }

    /// The length of the next step to be tried, in s.
    pub fn next_step(&self) -> f64 {
        self.control.step
    }

    /// The time at which the motion was first detected to be stiff, in s: from then on the stability of the method and not its accuracy limits the steps.
    pub fn stiff_since(&self) -> Option<f64> {
        self.stiffness.since
    }

    /// Whether the end is reached.
    pub fn is_done(&self) -> bool {
        self.now.t == self.end
    }

    /// Sets the length of the first step, which is otherwise chosen from the motion at the start.
    pub fn set_first_step(&mut self, step: f64) {
        self.control.step = step.copysign(self.end - self.now.t);
    }

    /// Sets the longest step, in s; a value that is not greater than 0 removes the limit.
    pub fn set_longest_step(&mut self, step: f64) {
        self.longest = control::longest_step_or_infinity(step);
    }

    /// Sets the largest number of steps of one [`advance_to`](Self::advance_to), ten million by default; if more are needed, it returns an
    /// error. In a loop of a fixed rate this bounds the execution time.
    pub fn set_max_steps(&mut self, steps: usize) {
        self.max_steps = steps;
    }

    /// Declares that from now on the accelerations differ at the same state, for instance because the law of the inputs reads a cell that
    /// was written, or a system written by hand has cells of its own. The next step begins with a new evaluation and discards the
    /// derivatives that an implicit method has kept.
    ///
    /// The last step is unaffected: [`hermite`](Self::hermite), [`a`](Self::a) and [`inputs`](Self::inputs) refer to the time before the
    /// change until the next step is taken. If the method needs evaluations for an [`interpolant`](Self::interpolant) of the last step,
    /// request it before; afterwards it is an error.
    ///
    /// ```
    /// # mod by_hand { include!("../tests/by_hand/toy.rs"); }
    /// # use by_hand::Toy;
    /// use lagrangian::{InputFunction, METHODS, NoBalance, Stepper, Tolerance};
    /// use std::cell::Cell;
    ///
    /// // A mass of 1 kg that a force pushes: x'' = u.
    /// let mass = Toy::new(([0.0], [0.0]), |_, _, _, u, _| [u]);
    /// let force = Cell::new(1.0);
    /// let law = InputFunction(|_, _: &[f64; 1], _: &[f64; 1], u: &mut f64| *u = force.get());
    /// let tolerance = Tolerance { relative: 1e-9, absolute: [1e-9] };
    /// let start = (0.0, [0.0], [0.0]);
    /// let mut stepper = Stepper::new(&mass, law, NoBalance, &METHODS[0], tolerance, start, 1.0)?;
    /// while !stepper.is_done() {
    ///     stepper.step()?;
    /// }
    /// // From 1 s on it is braked; at 2 s it is at rest, 1 m from where it was.
    /// force.set(-1.0);
    /// stepper.inputs_changed();
    /// stepper.set_end(2.0);
    /// while !stepper.is_done() {
    ///     stepper.step()?;
    /// }
    /// assert!((stepper.q()[0] - 1.0).abs() < 1e-14 && stepper.v()[0].abs() < 1e-14);
    /// # Ok::<(), lagrangian::StepError>(())
    /// ```
    pub fn inputs_changed(&mut self) {
        self.changed = true;
    }

    /// Replaces the law of the inputs by another of the same type from now on; see [`inputs_changed`](Self::inputs_changed).
    pub fn set_law(&mut self, law: L) {
        self.model.law = law;
        self.changed = true;
    }

    /// Replaces the law of the inputs by one with the same values at the present state, so the accelerations stay as they are.
    #[cfg(feature = "std")]
    pub(crate) fn replace_law_without_jump(&mut self, law: L) {
        self.model.law = law;
    }

    /// [`set_law`](Self::set_law) at a jump of the inputs: evaluates the accelerations, decides anew which contacts stick and slide, and
    /// adds the work that the jump does on the potential energy.
    #[cfg(feature = "std")]
    pub(crate) fn jump_inputs(&mut self, law: L) -> Result<(), StepError> {
        let (t, q, v) = (self.now.t, &self.now.q, &self.now.v);
        let Self {
            model, quadratures, ..
        } = self;
        let energy = |model: &mut Model<'s, S, L>| {
            model.set_inputs(t, q, v);
            model.system.potential_energy(t, q, &model.inputs)
        };
        let before = quadratures.integrals().map(|_| energy(model));
        model.law = law;
        if let Some(before) = before {
            let work = energy(model) - before;
            quadratures.add_instantaneous(work, 0.0);
        }
        self.refresh_acceleration()
    }

    /// Sets another end, later or earlier than now.
    pub fn set_end(&mut self, end: f64) {
        self.end = end;
        self.control.set_direction(end - self.now.t);
    }

    /// Undoes the last step and makes `end` the end of the run, to end a run at an event within that step.
    ///
    /// Only one step can be undone.
    pub fn retreat(&mut self, end: f64) {
        let stages = self.method.tableau.stages;
        if self.newest == stages {
            self.newest = 0;
            self.now.copy_from(&self.before);
            #[cfg(feature = "std")]
            if let Some(taylor) = &mut self.taylor {
                taylor.retreat();
            }
            #[cfg(feature = "std")]
            if let Some(impulses) = &mut self.impulses
                && let Some(before) = impulses.retreat()
            {
                self.model.touching = Some(before);
            }
            #[cfg(feature = "std")]
            if let Some(fixed) = &mut self.fixed {
                fixed.retreat();
            }
            self.quadratures.retreat(self.method.tableau.a[stages]);
            self.control.work.steps -= 1;
            // This length was short enough.
            self.control.step = self.control.last_step;
        }
        self.end = end;
    }

    /// Evaluates the present acceleration again if something that it depends on has changed.
    #[cold]
    fn refresh_acceleration(&mut self) -> Result<(), StepError> {
        let Self {
            model,
            quadratures,
            now,
            k,
            newest,
            control,
            ..
        } = self;
        let at = (now.t, &now.q, &now.v);
        if S::MAY_SLIDE && model.system.contacts().len() != 0 {
            let Model { law, inputs, .. } = model;
            law.set(model.system.get(), now.t, &now.q, &now.v, inputs);
            let contacts = Contacts::begin(model.system.get(), now.t, &now.q, &now.v, inputs)?;
            model.contacts = Some(contacts);
        }
        model.accelerations(at.0, at.1, at.2, &mut k[*newest], &mut control.work)?;
        model.take_rates(quadratures, 0, (at.0, at.1, at.2, &k[*newest]));
        control.begin_anew();
        #[cfg(feature = "std")]
        if let Some(implicit) = &mut self.implicit {
            implicit.forget();
        }
        #[cfg(feature = "std")]
        if let Some(fixed) = &mut self.fixed {
            fixed.forget();
        }
        self.changed = false;
        #[cfg(feature = "std")]
        if self.taylor.is_some() {
            return self.expand();
        }
        Ok(())
    }

    /// Takes one step, which ends at the end of the run or before it.
    pub fn step(&mut self) -> Result<(), StepError> {
        if self.is_done() {
            return Ok(());
        }
        if self.changed {
            self.refresh_acceleration()?;
        }
        #[cfg(feature = "std")]
        if self.impulses.is_some() {
            return self.step_in_impulses();
        }
        if let MethodKind::Fixed(rule) = self.method.kind {
            return self.step_of_fixed_length(rule);
        }
        #[cfg(feature = "std")]
        if self.taylor.is_some() {
            self.choose_length()?;
        }
        let limits = self.begin_tries()?;
        loop {
            let (h, last) = self.choose(limits);
            #[cfg(feature = "std")]
            let tried = match (&self.implicit, &self.taylor) {
                (None, None) => self.attempt(h, last),
                (Some(_), _) => self.attempt_implicitly(h, last),
                (None, Some(_)) => self.attempt_in_series(h, last),
            };
            #[cfg(not(feature = "std"))]
            let tried = self.attempt(h, last);
            if self.decide((h, limits), tried)? {
                return Ok(());
            }
        }
    }

    /// Prepares the tries of a step.
    #[inline(always)]
    fn begin_tries(&mut self) -> Result<StepLimits, StepError> {
        if self.control.work.steps == 0 && self.control.step == 0.0 {
            self.control.step = self.first_step();
        }
        let shortest = control::shortest_step::<f64>(self.now.t);
        let distance_to_end = (self.end - self.now.t) - self.now.t_low;
        if self.control.is_too_small(shortest, distance_to_end) {
            return Err(self.too_small());
        }
        self.begin();
        self.control.is_retry = false;
        Ok(StepLimits {
            shortest,
            distance_to_end,
        })
    }

    /// The length of the next try, and whether it would be the last step.
    #[inline(always)]
    fn choose(&mut self, limits: StepLimits) -> (f64, bool) {
        let last = self.control.is_last(limits.distance_to_end, self.longest);
        let h = if last {
            limits.distance_to_end
        } else {
            self.control.step
        };
        self.control.last_step = h;
        (h, last)
    }

    /// Decides about a try of length `h`: returns whether the step is taken; otherwise another try follows.
    #[inline(always)]
    fn decide(
        &mut self,
        (h, limits): (f64, StepLimits),
        tried: Result<f64, StepError>,
    ) -> Result<bool, StepError> {
        let (next, cause) = match tried {
            Ok(error) if error <= 1.0 => {
                let factor = self.growth(h, error);
                self.control.accept(h, error, factor);
                self.accept(h);
                return Ok(true);
            }
            _ if self.may_have_met_fork(h, false) => {
                // Try once more, with the dependence of the constraints taken into account.
                self.control.work.rejected += 1;
                return Ok(false);
            }
            Ok(error) => (h * self.reduction(error), None),
            // A stage may have left the set of states in which the machine can be.
            Err(cause) => (0.1 * h, Some(cause)),
        };
        if self.control.reject(next, limits.shortest) {
            return Ok(false);
        }
        if self.may_have_met_fork(h, true) {
            self.control.step = h;
            return Ok(false);
        }
        let error = cause.unwrap_or_else(|| self.too_small());
        // The present state is the end of the last good step, not the end of this try.
        self.now.copy_from(&self.before);
        Err(error)
    }

    /// The continuous extension of the last step: the motion between its ends.
    ///
    /// It costs the evaluations that the method needs beyond its step: 3 for `dop853`, none for the others. The polynomials satisfy the
    /// constraints at the ends of the step, and between them to the accuracy of the method; [`project`](Self::project) removes the rest.
    pub fn interpolant(&mut self) -> Result<Interpolant<S::Vector>, StepError> {
        #[cfg(feature = "std")]
        if let Some(of_step) = self.coefficients() {
            return Ok(Interpolant::of_series(
                self.beginning(),
                self.control.last_step,
                of_step,
            ));
        }
        if self.changed && self.method.dense_needs_evaluations() {
            return Err(StepError::Changed { t: self.now.t });
        }
        let ends = Ends {
            start: self.before.time(),
            h: self.control.last_step,
            q: [&self.before.q, &self.now.q],
            v: [&self.before.v, &self.now.v],
        };
        if self.method.is_quintic() {
            return Ok(Interpolant::quintic(&ends, [self.a_before(), self.a()]));
        }
        Interpolant::new(self.method, &ends, &mut self.k, |t, q, v, a| {
            let work = &mut self.control.work;
            self.model.accelerations(t, q, v, a, work)
        })
    }

    /// Projects a state within the last step onto the constraints of the machine, by the smallest move in the metric of its inertia.
    pub fn project(&self, t: f64, q: &mut S::Vector, v: &mut S::Vector) -> Result<(), StepError> {
        #[cfg(feature = "std")]
        if S::MAY_COLLIDE
            && let Some(touching) = &self.model.touching
        {
            let constrained = touching.machine(self.model.system.get());
            let projected = project(&constrained, &self.model.constraints, t, q, v);
            return projected.map_err(|error| touching.explain(self.model.system.get(), error));
        }
        project(self.model.system.get(), &self.model.constraints, t, q, v)
    }

    /// Makes the present state the beginning of a step.
    fn begin(&mut self) {
        self.k.swap(0, self.newest);
        self.newest = 0;
        self.before.copy_from(&self.now);
        if S::MAY_SLIDE
            && let Some(contacts) = &mut self.model.contacts
        {
            let (system, now) = (self.model.system.get(), &self.before);
            contacts.record_headings(system, now.t, &now.q, &now.v);
        }
        #[cfg(feature = "std")]
        if S::MAY_COLLIDE {
            self.model.begin_contacts(&self.before);
        }
        #[cfg(feature = "std")]
        if let Some(taylor) = &mut self.taylor {
            taylor.begin();
        }
    }

    /// Tries a step of length `h` from `before` to `now`. Returns its error relative to the tolerance.
    fn attempt(&mut self, h: f64, last: bool) -> Result<f64, StepError> {
        let stepper = self;
        f64::run(Attempt { stepper, h, last })
    }

    /// Completes a try whose stages are done and whose new point is in `now`: projects it onto the constraints and returns the error
    /// relative to the tolerance.
    #[cfg(feature = "std")]
    fn finish(&mut self, h: f64) -> Result<f64, StepError> {
        let stepper = self;
        f64::run(Finish { stepper, h })
    }

    /// [`attempt`](Self::attempt) within a kernel.
    #[inline(always)]
    fn attempt_within<R: Scalar<Stored = f64>>(
        &mut self,
        h: f64,
        last: bool,
    ) -> Result<f64, StepError> {
        let Self {
            method,
            model,
            quadratures,
            before,
            now,
            k,
            stage,
            control: Control { work, .. },
            ..
        } = self;
        let stages = method.tableau.stages;
        let (q, v) = (&mut stage.0, &mut stage.1);
        for i in 1..stages {
            let from = (&*before, h);
            let to = [&mut *q, &mut *v];
            let t = attempt::go_to_stage::<R, _, _>((method, i), from, k, to);
            model.accelerations(t, q, v, &mut k[i], work)?;
            model.take_rates(quadratures, i, (t, q, v, &k[i]));
        }
        attempt::arrive::<R, _, _>(method, (before, h), k, now, (self.end, &[last]));
        self.finish_within::<R>(h)
    }

    /// The part of a try after its stages, within a kernel: projects the new point onto the constraints and estimates the error.
    #[inline(always)]
    fn finish_within<R: Scalar<Stored = f64>>(&mut self, h: f64) -> Result<f64, StepError> {
        let Self {
            method,
            model,
            quadratures,
            now,
            k,
            control: Control { work, .. },
            ..
        } = self;
        let stages = method.tableau.stages;
        let mut moved = false;
        if method.scheme.error_needs_end {
            moved = model.project(now)?;
            model.end(now, quadratures, stages, k, work)?;
        }
        let mut error = self.error_within::<R>(h);
        // If accelerations do not reflect it, a state that overflowed may have an error estimate of zero.
        let [is_finite] = attempt::are_finite(&self.now.q, &self.now.v);
        if !is_finite {
            error = f64::INFINITY;
        }
        if moved {
            error = error.max(self.error_of_move());
        }
        let Self {
            method,
            model,
            quadratures,
            now,
            k,
            control: Control { work, .. },
            ..
        } = self;
        if !error.is_finite() {
            // Either the error is infinite, or the state itself has overflowed.
            return match not_finite(&now.q, &now.v, 0) {
                Some(coordinate) => Err(StepError::NotFinite {
                    coordinate,
                    t: now.t,
                }),
                None => Ok(f64::INFINITY),
            };
        }
        if error <= 1.0 && !method.scheme.error_needs_end {
            moved = model.project(now)?;
            model.end(now, quadratures, stages, k, work)?;
            if moved {
                error = error.max(self.error_of_move());
            }
        }
        Ok(error)
    }

    /// Whether the step just tried may have failed because constraints become dependent on the way, which was not known before.
    /// `at_last` says that no shorter step is possible.
    fn may_have_met_fork(&mut self, h: f64, at_last: bool) -> bool {
        let Self {
            model,
            before,
            stage,
            ..
        } = self;
        #[cfg(feature = "std")]
        if model.touching.is_some() {
            return false;
        }
        if !S::MAY_BE_CONSTRAINED {
            return false;
        }
        let Some(constraints) = &mut model.constraints else {
            return false;
        };
        if constraints.at_fork {
            return false;
        }
        let ahead = &mut stage.0;
        let holds = [0.0, 0.5, 1.0].map(|theta| {
            ahead.clone_from(&before.q);
            for (q, v) in ahead.as_mut_slice().iter_mut().zip(before.v.as_slice()) {
                *q += theta * h * v;
            }
            constraints.strength(model.system.get(), before.t + theta * h, ahead)
        });
        constraints.notice_fork(holds, at_last)
    }

    /// Accepts the step just tried.
    fn accept(&mut self, h: f64) {
        let stages = self.method.tableau.stages;
        self.newest = stages;
        #[cfg(feature = "std")]
        if let Some(taylor) = &mut self.taylor {
            taylor.accept();
            // If the machine does not move, or the coefficients are not finite, the series gives no length.
            let length = taylor.length(&self.tolerance);
            self.control.step = if length.is_finite() { length } else { h.abs() }.copysign(h);
        }
        self.model.accept(&self.now);
        self.quadratures.advance(h, self.method.tableau.a[stages]);
        if let Some(stability) = self.method.tableau.stability {
            let steps = self.control.work.steps;
            let due = steps.is_multiple_of(self.between_tests);
            if due || self.stiffness.signs > 0 {
                let stiff = self.stiffness_of_step(h) > stability;
                self.stiffness.take(stiff, h.abs(), self.before.t);
            }
        }
    }

    /// The error of the step just tried relative to the tolerance, as root mean square over coordinates and rates.
    #[inline(always)]
    fn error_within<R: Scalar<Stored = f64>>(&self, h: f64) -> f64 {
        if (S::MAY_BE_CONSTRAINED || S::MAY_COLLIDE)
            && let Some(constraints) = &self.model.constraints
            && constraints.at_fork
        {
            return self.error_along(constraints, h);
        }
        let ends = [&self.before, &self.now];
        let of = (&self.tolerance, &[self.control.is_first]);
        let [error] = attempt::errors::<R, _, _>(self.method, h, ends, &self.k, of);
        error
    }

    /// The error of the step just tried when constraints are about to become dependent. The projection removes the part across the
    /// constraints, so of that part only the excess over round-off counts.
    fn error_along(&self, constraints: &Constraints<S::Vector>, h: f64) -> f64 {
        let scheme = &self.method.scheme;
        let mut sums = [0.0, 0.0];
        let coarse = self.method.tableau.coarse_error.is_some();
        let rows = [Some(&scheme.error), coarse.then_some(&scheme.coarse_error)];
        for (sum, row) in sums.iter_mut().zip(rows) {
            let Some(row) = row else {
                continue;
            };
            let mut errors = [self.now.q.zeros_like(), self.now.q.zeros_like()];
            in_blocks!(self.now.q.as_slice().len(), |start, B| {
                let [position, velocity] = weigh::<B, f64, _>(row, &self.k, start);
                for i in 0..B {
                    errors[0].as_mut_slice()[start + i] = h * h * position[i];
                    errors[1].as_mut_slice()[start + i] = h * velocity[i];
                }
            });
            let states = [[&self.before.q, &self.now.q], [&self.before.v, &self.now.v]];
            for (error, [before, now]) in errors.iter().zip(states) {
                let (t, q) = (self.now.t, &self.now.q);
                let mut along = error.clone();
                if constraints
                    .keep_along(self.model.system.get(), t, q, &mut along)
                    .is_err()
                {
                    along.clone_from(error);
                }
                for (i, along) in along.as_slice().iter().enumerate() {
                    let size = before.as_slice()[i].abs().max(now.as_slice()[i].abs());
                    let tolerable = self.tolerable(i, size);
                    let across = error.as_slice()[i] - along;
                    let loose = tolerable.max(ROUNDOFF_ACROSS * (1.0 + size));
                    *sum += (along / tolerable) * (along / tolerable);
                    *sum += (across / loose) * (across / loose);
                }
            }
        }
        let ([fine, coarse], is_first) = (sums, self.control.is_first);
        control::error_norm(fine, coarse, is_first, 2 * self.now.q.as_slice().len())
    }

    /// The distance by which the step just tried was moved onto the constraints, in the norm of its [`error`](Self::error), without the
    /// share that its beginning contributed.
    fn error_of_move(&self) -> f64 {
        let Some(constraints) = &self.model.constraints else {
            return 0.0;
        };
        let mut sum = 0.0;
        let levels = constraints.moved.iter().zip(constraints.own_share);
        for ((moved, share), y) in levels.zip([&self.now.q, &self.now.v]) {
            let by = moved.as_slice().iter().zip(y.as_slice());
            for (i, (moved, y)) in by.enumerate() {
                let mut tolerable = self.tolerable(i, y.abs());
                if constraints.at_fork {
                    tolerable = tolerable.max(ROUNDOFF_ACROSS * (1.0 + y.abs()));
                }
                let error = share * moved / tolerable;
                sum += error * error;
            }
        }
        sqrt(sum / (2 * self.now.q.as_slice().len()) as f64)
    }

    /// The factor by which the next step may be longer after this good one of length `h`.
    #[inline(always)]
    fn growth(&mut self, _h: f64, error: f64) -> f64 {
        let is_first = self.control.is_first;
        #[cfg(feature = "std")]
        {
            if self.taylor.is_some() {
                // The series at the end of the step gives the length of the next one.
                return 1.0;
            }
            if let Some(implicit) = &mut self.implicit {
                let exponent = control::error_exponent(self.method, is_first);
                return implicit.accept(_h, error, exponent, self.method.tableau.step_change);
            }
        }
        control::growth(self.method, error, self.control.error_before, is_first)
    }

    /// The factor for the length of the next try after this one was rejected.
    fn reduction(&mut self, error: f64) -> f64 {
        let is_first = self.control.is_first;
        #[cfg(feature = "std")]
        if let Some(implicit) = &mut self.implicit {
            let (shrink, _) = self.method.tableau.step_change;
            let exponent = control::error_exponent(self.method, is_first);
            return implicit.reject(error, exponent, shrink);
        }
        control::reduction(self.method, error, is_first)
    }

    /// Chooses the length of the first step.
    fn first_step(&mut self) -> f64 {
        let Self {
            method,
            tolerance,
            model,
            now,
            k,
            stage: (q, v),
            control: Control { work, .. },
            ..
        } = self;
        let bounds = [self.end - now.t, self.longest];
        attempt::first_step(
            (method, tolerance),
            now,
            k,
            [q, v],
            bounds,
            |(t, q, v), a| model.accelerations(t, q, v, a, work).is_ok(),
        )
    }

    /// Estimates `h |λ|` of the largest eigenvalue from the two evaluations at the end of the step.
    fn stiffness_of_step(&self, h: f64) -> f64 {
        let stages = self.method.tableau.stages;
        let (a, a_stage) = (self.k[stages].as_slice(), self.k[stages - 1].as_slice());
        let (q, v) = (self.now.q.as_slice(), self.now.v.as_slice());
        let (q_stage, v_stage) = (self.stage.0.as_slice(), self.stage.1.as_slice());
        let (mut rates, mut states) = (0.0, 0.0);
        for i in 0..a.len() {
            let (dq, dv, da) = (q[i] - q_stage[i], v[i] - v_stage[i], a[i] - a_stage[i]);
            rates += dv * dv + da * da;
            states += dq * dq + dv * dv;
        }
        // Two equal states give no estimate.
        if states == 0.0 {
            0.0
        } else {
            h.abs() * sqrt(rates / states)
        }
    }

    /// The error for a step that was still too long and cannot be shorter.
    fn too_small(&self) -> StepError {
        let ends = [&self.before, &self.now];
        let h = self.control.last_step;
        StepError::StepTooSmall {
            coordinate: attempt::worst(self.method, h, ends, &self.k, (&self.tolerance, 0)),
            t: self.before.t,
            step: h,
        }
    }
}

impl<S: System, L: InputLaw<S>> Model<'_, S, L> {
    /// Evaluates the accelerations and checks that they are finite.
    #[inline]
    fn accelerations(
        &mut self,
        t: f64,
        q: &S::Vector,
        v: &S::Vector,
        a: &mut S::Vector,
        work: &mut Work,
    ) -> Result<(), StepError> {
        work.evaluations += 1;
        self.law.set(self.system.get(), t, q, v, &mut self.inputs);
        let known = (&self.constraints, &self.contacts);
        let at = At {
            t,
            q,
            v,
            u: &self.inputs,
        };
        #[cfg(feature = "std")]
        if S::MAY_COLLIDE
            && let Some(touching) = &self.touching
        {
            let memory = self.contact_memory.get_or_insert_with(|| {
                let memory = ContactMemory::new(touching, q);
                Box::new(memory)
            });
            touching.accelerations(self.system.get(), at, memory, a)?;
        } else {
            accelerations(self.system.get(), known, at, a)?;
        }
        #[cfg(not(feature = "std"))]
        accelerations(self.system.get(), known, at, a)?;
        // If any number is not finite, the sum is not, and one test is cheaper than many.
        let sum: f64 = a.as_slice().iter().sum();
        if sum.is_finite() {
            return Ok(());
        }
        match not_finite(a, a, 0) {
            Some(coordinate) => Err(StepError::NotFinite { coordinate, t }),
            None => Ok(()),
        }
    }

    /// Sets the inputs for a state.
    #[cfg(feature = "std")]
    fn set_inputs(&mut self, t: f64, q: &S::Vector, v: &S::Vector) {
        self.law.set(self.system.get(), t, q, v, &mut self.inputs);
    }

    /// Evaluates the acceleration at the new point.
    #[inline]
    fn end<A: Quadratures<S>>(
        &mut self,
        now: &Point<S::Vector>,
        quadratures: &mut A,
        stages: usize,
        k: &mut [S::Vector; MAX_STAGES],
        work: &mut Work,
    ) -> Result<(), StepError> {
        self.accelerations(now.t, &now.q, &now.v, &mut k[stages], work)?;
        self.take_rates(quadratures, stages, (now.t, &now.q, &now.v, &k[stages]));
        Ok(())
    }

    /// Projects the end of a step onto the constraints; returns whether that moved it.
    #[inline(always)]
    fn project(&mut self, now: &mut Point<S::Vector>) -> Result<bool, StepError> {
        #[cfg(feature = "std")]
        if S::MAY_COLLIDE
            && self.system.unilateral_contacts().len() != 0
            && let Some(touching) = &self.touching
        {
            let constrained = touching.machine(self.system.get());
            return match &mut self.constraints {
                Some(constraints) if constrained.constraints().len() != 0 => {
                    let projected = constraints.project(&constrained, &mut now.place());
                    projected.map_err(|error| touching.explain(self.system.get(), error))
                }
                _ => Ok(false),
            };
        }
        let mut moved = false;
        if S::MAY_BE_CONSTRAINED
            && self.system.constraints().len() != 0
            && let Some(constraints) = &mut self.constraints
        {
            moved = constraints.project(self.system.get(), &mut now.place())?;
        }
        if S::MAY_SLIDE
            && self.system.contacts().len() != 0
            && let Some(contacts) = &self.contacts
        {
            let place = now.place();
            let at = (place.t, &*place.q[0], &self.inputs);
            contacts.hold(self.system.get(), at, place.v)?;
        }
        Ok(moved)
    }

    /// Updates contacts and constraints at the end of a step.
    #[inline(always)]
    fn accept(&mut self, now: &Point<S::Vector>) {
        if S::MAY_SLIDE
            && self.system.contacts().len() != 0
            && let Some(contacts) = &mut self.contacts
        {
            contacts.accept(self.system.get(), now.t, &now.q, &now.v);
        }
        #[cfg(feature = "std")]
        if S::MAY_COLLIDE && self.system.unilateral_contacts().len() != 0 {
            self.accept_contacts(now);
            return;
        }
        if !S::MAY_BE_CONSTRAINED || self.system.constraints().len() == 0 {
            return;
        }
        if let Some(constraints) = &mut self.constraints {
            constraints.accept(&now.q, &now.v);
            if constraints.at_fork {
                constraints.update_fork(self.system.get(), now.t, &now.q);
            }
            if constraints.redundant {
                // If that fails, the previous rows will do, or the next step returns the error.
                let _ = constraints.choose_again(self.system.get(), now.t, &now.q);
            }
        }
    }

    #[inline(always)]
    fn take_rates<A: Quadratures<S>>(
        &mut self,
        quadratures: &mut A,
        stage: usize,
        at: (f64, &S::Vector, &S::Vector, &S::Vector),
    ) {
        quadratures.stage(stage, self.system.get(), at, &self.inputs);
        let (t, q, v, _) = at;
        let here = At {
            t,
            q,
            v,
            u: &self.inputs,
        };
        if S::MAY_SLIDE
            && self.system.contacts().len() != 0
            && let Some(contacts) = &self.contacts
            && quadratures.integrals().is_some()
        {
            let [work, lost] = contacts.power(self.system.get(), here);
            quadratures.add(stage, work, lost);
        }
        #[cfg(feature = "std")]
        if S::MAY_COLLIDE
            && self.system.unilateral_contacts().len() != 0
            && let Some(touching) = &self.touching
            && quadratures.integrals().is_some()
        {
            let memory = self.contact_memory.get_or_insert_with(|| {
                let memory = ContactMemory::new(touching, q);
                Box::new(memory)
            });
            let powers = touching.powers(self.system.get(), here, memory);
            quadratures.add(stage, powers.work, powers.lost);
            quadratures.set_contact_shares(stage, powers.of_each);
        }
    }
}

impl Stiffness {
    /// Stiffness is reported after fifteen positive tests without six negative ones in a row among them, as in DOP853, if steps are
    /// not halved meanwhile. Towards an instant where accelerations are singular, such as that at which friction in two directions
    /// brings a body to rest, the step shrinks as fast as the accelerations change, and `h |λ|` stays as it is; but such steps are few,
    /// however close they come, and an implicit method needs as many.
    fn take(&mut self, stiff: bool, h: f64, t: f64) {
        if stiff {
            self.none_since = 0;
            if h < 0.5 * self.longest {
                (self.signs, self.longest) = (0, 0.0);
            }
            self.longest = self.longest.max(h);
            self.signs += 1;
            if self.signs == 15 && self.since.is_none() {
                self.since = Some(t);
            }
        } else {
            self.none_since += 1;
            if self.none_since == 6 {
                (self.signs, self.longest) = (0, 0.0);
            }
        }
    }
}

/// Evaluates the accelerations; where constraints are dependent, those that satisfy the chosen ones.
#[inline(always)]
pub(crate) fn accelerations<S: System>(
    system: &S,
    (constraints, contacts): (&Option<Constraints<S::Vector>>, &Option<Contacts>),
    At { t, q, v, u }: At<'_, S>,
    a: &mut S::Vector,
) -> Result<(), StepError> {
    if S::MAY_SLIDE
        && system.contacts().len() != 0
        && let Some(contacts) = contacts
    {
        return contacts
            .accelerations(system, At { t, q, v, u }, a)
            .map_err(|singular| StepError::Singular { singular, t });
    }
    if S::MAY_BE_CONSTRAINED
        && system.constraints().len() != 0
        && let Some(constraints) = constraints
        && (constraints.redundant || constraints.at_fork)
    {
        return constraints.accelerations(system, t, q, v, u, a);
    }
    system
        .accelerations(t, q, v, u, a)
        .map_err(|singular| StepError::Singular { singular, t })
}

/// Moves coordinates along their rates by some roundings of the largest coordinate.
#[cfg(feature = "std")]
fn move_by_rounding<V: Vector>(q: &mut V, v: &V) {
    const ROUNDINGS: f64 = 64.0;
    let greatest = |of: &V| {
        of.as_slice()
            .iter()
            .fold(0.0_f64, |most, x| most.max(x.abs()))
    };
    let time = ROUNDINGS * f64::EPSILON * greatest(q) / greatest(v);
    if time.is_finite() {
        for (q, v) in q.as_mut_slice().iter_mut().zip(v.as_slice()) {
            *q += time * v;
        }
    }
}

/// Projects a state within a run onto the constraints.
#[inline(always)]
pub(crate) fn project<S: System>(
    system: &S,
    constraints: &Option<Constraints<S::Vector>>,
    t: f64,
    q: &mut S::Vector,
    v: &mut S::Vector,
) -> Result<(), StepError> {
    if S::MAY_BE_CONSTRAINED
        && system.constraints().len() != 0
        && let Some(constraints) = constraints
    {
        return constraints.project_between(system, t, q, v);
    }
    Ok(())
}
