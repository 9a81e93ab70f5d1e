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
mod equations;
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
mod trying;

mod owned;
#[cfg(feature = "std")]
pub(crate) use contact_changes::{Cause, ContactChanges};

#[cfg(feature = "std")]
pub(crate) use equations::accelerations;
pub(crate) use equations::project;
pub(crate) use owned::BorrowedOrOwned;
pub use owned::{ControlledStepper, StepperBuilder};

use crate::at::At;
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
#[cfg(doc)]
use crate::methods::Tableau;
use crate::methods::{MAX_STAGES, Method, MethodKind};
use crate::stages::Point;
use crate::step_error::StepError;
#[cfg(feature = "std")]
use crate::taylor::Taylor;
use crate::tolerance::{LEAST_RELATIVE_TOLERANCE, Tolerance};
use crate::{ContactTrouble, System, Vector};
#[cfg(feature = "std")]
use equations::move_by_rounding;
#[cfg(feature = "std")]
use in_impulses::InImpulses;
#[cfg(feature = "std")]
use of_fixed_length::Fixed;
#[cfg(feature = "std")]
use std::boxed::Box;

/// A stiffness test is made every so many steps, as in DOP853.
const STEPS_BETWEEN_STIFFNESS_TESTS: usize = 1000;

/// Time, coordinates and velocities at the start of a run, and the constraints there, if they are known.
type KnownStart<V> = ((f64, V, V), Option<Constraints<V>>);

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
    /// Whether contacts change where the step ends that ends at `end`.
    #[cfg(feature = "std")]
    ends_at_change: bool,
    /// The longest first step by series after contacts have changed, so that it does not miss a short flight.
    #[cfg(feature = "std")]
    longest_first: f64,
    /// The length of the last step by series that its tolerance allows, in s.
    #[cfg(feature = "std")]
    tolerable: f64,
    /// `None` unless the method is time stepping.
    #[cfg(feature = "std")]
    impulses: Option<Box<InImpulses<S::Vector, S::Matrix>>>,
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
    is_tested: bool,
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
        let start = (start, None);
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

    /// [`new`](Self::new) for a run, which locates the events of unilateral contacts, and may know the constraints at the start.
    pub(crate) fn begun(
        system: BorrowedOrOwned<'s, S>,
        law: L,
        quadratures: A,
        method: &'static Method,
        tolerance: Tolerance<S::Vector>,
        ((t, q, v), known): KnownStart<S::Vector>,
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
            Self::check_series(system.get(), &law, t)?;
        }
        let zeros = q.zeros_like();
        let mut start = Point::new(t, q, v);
        let mut constraints = known;
        if S::MAY_BE_CONSTRAINED && constraints.is_none() && system.constraints().len() != 0 {
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
            ends_at_change: false,
            #[cfg(feature = "std")]
            longest_first: f64::INFINITY,
            #[cfg(feature = "std")]
            tolerable: f64::INFINITY,
            #[cfg(feature = "std")]
            impulses: None,
            #[cfg(feature = "std")]
            fixed: None,
        };
        #[cfg(feature = "std")]
        stepper.begin_method()?;
        stepper.begin_motion()?;
        Ok(stepper)
    }

    /// Checks that a motion has a series.
    #[cfg(feature = "std")]
    pub(crate) fn check_series(system: &S, law: &L, t: f64) -> Result<(), StepError> {
        let inputs = !law.is_constant();
        if inputs || system.check_series().is_err() {
            return Err(StepError::NoSeries { inputs, t });
        }
        Ok(())
    }

    /// Makes what the method needs beside the stages of a step.
    #[cfg(feature = "std")]
    fn begin_method(&mut self) -> Result<(), StepError> {
        if let MethodKind::Fixed(rule) = self.method.kind {
            self.begin_fixed(rule)?;
        }
        if self.method.kind == MethodKind::Impulses {
            let Point { q, v, .. } = &self.now;
            self.impulses = Some(Box::new(InImpulses::new(q, v)));
        }
        if self.method.kind == MethodKind::Series {
            self.taylor = Some(Box::new(Taylor::new(&self.tolerance)));
            self.expand()?;
        }
        Ok(())
    }

    /// Evaluates contacts and accelerations at the start.
    fn begin_motion(&mut self) -> Result<(), StepError> {
        let Self {
            model,
            now,
            k,
            quadratures,
            control: Control { work, .. },
            ..
        } = self;
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
        Ok(())
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
        #[cfg(feature = "std")]
        {
            self.ends_at_change = false;
        }
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
        let limits = self.begin_attempts()?;
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

    /// The dense output of the last step: the motion between its ends.
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
}
