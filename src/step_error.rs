//! Errors of steps.

use core::fmt::{self, Display};

use crate::sentences::{said_as_it_is, sentences};
use crate::{ContactTrouble, Singular};
#[cfg(doc)]
use crate::{Stepper, System};

/// Why a step could not be taken. Coordinates are given by their index.
///
/// A [`Simulation`](crate::Simulation) reports the same with the names of the machine
#[cfg_attr(feature = "std", doc = "([`Error::of_step`](crate::Error::of_step)).")]
#[cfg_attr(not(feature = "std"), doc = "(with the feature `std`).")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum StepError {
    /// A stepper was sent to a time that is infinite or not a number.
    NoTime {
        /// That time.
        t: f64,
    },
    /// The motion within the last step was requested at a time outside of it, or before there was a step.
    OutsideStep {
        /// That time, in s.
        t: f64,
        /// When the step began, in s.
        from: f64,
        /// When it ended, in s.
        to: f64,
    },
    /// A coordinate, its rate or its acceleration is infinite or undefined at time `t`, and shorter steps do
    /// not avoid it.
    NotFinite {
        /// The coordinate.
        coordinate: usize,
        /// Time, in s.
        t: f64,
    },
    /// The mass matrix cannot be inverted at time `t`, and shorter steps do not avoid it.
    Singular {
        /// Where the elimination stopped.
        singular: Singular,
        /// Time, in s.
        t: f64,
    },
    /// Constraints contradict each other, or have no solution near the state.
    Inconsistent {
        /// The constraint that is violated most.
        constraint: usize,
        /// Its residual, relative to the size of its terms.
        residual: f64,
        /// Time, in s.
        t: f64,
    },
    /// The method is [`TAYLOR`](crate::TAYLOR), and the machine does not have the series of its motion
    /// ([`System::check_series`]), or it has inputs that change while it runs.
    NoSeries {
        /// Whether the inputs are the reason.
        inputs: bool,
        /// Time, in s.
        t: f64,
    },
    /// [`System::with_workspace`] provides no workspace for constraints; or the method is implicit or by series, and
    /// there is no allocator (feature `std`).
    NoWorkspace {
        /// Time, in s.
        t: f64,
    },
    /// The motion within the last step was requested after [`Stepper::inputs_changed`], and the method needs
    /// evaluations for it, which would no longer be those of that step. Request it before.
    Changed {
        /// Time, in s.
        t: f64,
    },
    /// The run cannot continue because of unilateral contacts, or there are some where only a
    /// [`Simulation`](crate::Simulation) can follow them.
    Contact {
        /// One of these contacts.
        contact: usize,
        /// The reason.
        trouble: ContactTrouble,
        /// Time, in s.
        t: f64,
    },
    /// The method takes steps of a fixed length, and none was set ([`Stepper::set_longest_step`]).
    NoLength {
        /// Time, in s.
        t: f64,
    },
    /// The method cannot follow this machine.
    Unsuited {
        /// The reason, as the end of a sentence whose subject is the machine: `it has contacts`.
        reason: &'static str,
        /// Time, in s.
        t: f64,
    },
    /// No solution of the equations of a step of fixed length was found: the step is too long for the machine.
    NotSolved {
        /// Time at the beginning of the step, in s.
        t: f64,
        /// Its length, in s.
        step: f64,
    },
    /// The accelerations jump where a step of fixed length ends, and its equations have no solution on either side, however short it is.
    Jump {
        /// Time at the beginning of the step, in s.
        t: f64,
        /// Its length, in s.
        step: f64,
    },
    /// The method is implicit or by series, and the stepper takes explicit methods only.
    NotExplicit {
        /// Time, in s.
        t: f64,
    },
    /// The numbers have more digits than `f64`, but the coefficients of the method are known only to those of `f64`.
    FewDigits {
        /// Time, in s.
        t: f64,
    },
    /// The machine has constraints or contacts, which only a [`Stepper`] or a
    /// [`Simulation`](crate::Simulation) supports.
    NotFree {
        /// Time, in s.
        t: f64,
    },
    /// A trajectory, or the motion to a requested time, takes more steps than allowed.
    TooManySteps {
        /// The number of steps allowed.
        steps: usize,
        /// Time, in s.
        t: f64,
    },
    /// The step has shrunk to the round-off of time, and its error is still too large.
    StepTooSmall {
        /// The coordinate with the largest error.
        coordinate: usize,
        /// Time, in s.
        t: f64,
        /// The length of the step that was rejected, in s.
        step: f64,
    },
}

said_as_it_is! { Singular, ContactTrouble }

impl Display for StepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write_sentence(f)
    }
}

sentences! { StepError, written to f:
    NoLength { t } =>
        "the method takes steps of a fixed length, and none is set at t = {t:e} s: call `set_longest_step`"
    NoTime { t } => "{t} is not a valid end time"
    OutsideStep { t, from, to } =>
        "t = {t:e} s is outside of the last step, which goes from {from:e} s to {to:e} s"
    NotFinite { coordinate, t } => {
        let number = coordinate + 1;
        write!(
            f,
            "coordinate number {number}, its rate or its acceleration has no finite value at t = {t:e} s"
        )
    }
    Singular { singular, t } => "{singular}, at t = {t:e} s"
    Inconsistent { constraint, residual, t } => {
        let number = constraint + 1;
        write!(
            f,
            "constraint number {number} cannot be met near the state at t = {t:e} s: its residual is {residual:.1e} of \
             the size of its terms"
        )
    }
    NoSeries { inputs, t } => {
        if *inputs {
            write!(f, "inputs that change while the machine runs have no Taylor series, at t = {t:e} s")
        } else {
            write!(f, "the machine has no Taylor series, at t = {t:e} s")
        }
    }
    NoWorkspace { t } =>
        "there is no workspace for the constraints, or for a method that needs some, at t = {t:e} s"
    Changed { t } => "the motion before t = {t:e} s must be read before the inputs are changed there"
    Contact { contact, trouble, t } => {
        write!(f, "at t = {t:e} s, unilateral contact number {}: {}", contact + 1, trouble.words())
    }
    Unsuited { reason, t } =>
        "the method does not support this machine at t = {t:e} s: {reason}"
    NotSolved { t, step } =>
        "the equations of a step of {step:e} s cannot be solved at t = {t:e} s: take shorter steps, or `radau5` where the \
         machine is stiff"
    Jump { t, step } =>
        "an acceleration jumps within the step of {step:e} s from t = {t:e} s, as it does with `sign` of a rate, and no value on either \
         side satisfies the equations of the step, which shorter steps do not change: describe dry friction by `sliding`, take a \
         smooth function such as `tanh` in place of the jump, or take a method that chooses its steps"
    NotExplicit { t } =>
        "the method is not explicit, as this stepper requires, at t = {t:e} s"
    FewDigits { t } =>
        "the coefficients of the method are known only to the precision of f64, and the numbers have more digits, at \
         t = {t:e} s"
    NotFree { t } =>
        "the machine has constraints or contacts, which this stepper does not support, at t = {t:e} s"
    TooManySteps { steps, t } => "{steps} steps reach only t = {t:e} s"
    StepTooSmall { coordinate, t, step } => {
        let number = coordinate + 1;
        write!(
            f,
            "the step shrank to {step:e} s at t = {t:e} s, and the error of coordinate number {number} is still too \
             large"
        )
    }
}

impl core::error::Error for StepError {}
