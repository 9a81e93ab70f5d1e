//! Errors and warnings of runs, with the numbers that explain them.

mod message;
#[cfg(feature = "interpreter")]
mod of_specs;
mod warning;

#[cfg(feature = "interpreter")]
pub use of_specs::{Diagnostic, MissingParameters, NoMachineCode, NoNumbers, Note};
pub use warning::Warning;

use std::string::{String, ToString};

use crate::{ContactTrouble, Pivot, Quantity, Singular, StepError, System};

/// Why a run could not begin or continue.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum Error {
    /// A spec has mistakes, or cannot be read.
    #[cfg(feature = "interpreter")]
    Spec {
        /// The errors in the order of their positions, up to a limit.
        diagnostics: std::vec::Vec<of_specs::Diagnostic>,
        /// The number of errors beyond the limit.
        omitted: usize,
    },
    /// There is no parameter, coordinate or input with this name.
    UnknownName(crate::UnknownName),
    /// Parameters have no value: the spec gives no default, and none was set.
    #[cfg(feature = "interpreter")]
    MissingParameters(of_specs::MissingParameters),
    /// Machine code was requested and is not available.
    #[cfg(feature = "interpreter")]
    NoMachineCode(of_specs::NoMachineCode),
    /// A run in other numbers than `f64` was requested and is not possible.
    #[cfg(feature = "interpreter")]
    NoNumbers(of_specs::NoNumbers),
    /// An additional force was requested for a machine with guided contacts ([`Adapted`](crate::Adapted)).
    HasFriction(crate::HasFriction),
    /// The energy balance was requested for a system that does not define its energies
    /// ([`System::kinetic_energy`], [`System::potential_energy`]).
    EnergiesUnknown {
        /// Time, in s.
        t: f64,
    },
    /// A simulation has no end: `until` was not called.
    NoEnd,
    /// A setting of the simulation has an invalid value.
    InvalidSetting {
        /// The method of [`Simulation`](crate::Simulation) that took it.
        setting: &'static str,
        /// The value.
        value: f64,
        /// What it must be.
        needed: &'static str,
    },
    /// A setting names a coordinate that the machine does not have.
    UnknownCoordinate {
        /// The name.
        name: String,
    },
    /// A motion is to be differentiated with respect to a variable for which the accelerations have no derivatives.
    UnknownVariable {
        /// The name.
        name: String,
        /// The parameters and inputs in the description's `derivatives`.
        known: std::vec::Vec<String>,
    },
    /// The motion of a machine with constraints is to be differentiated.
    ConstrainedSensitivity {
        /// The first of its constraints.
        constraint: String,
    },
    /// The motion of a machine with unilateral contacts is to be differentiated.
    CollidingSensitivity {
        /// The first of its unilateral contacts.
        contact: String,
    },
    /// There is no method of integration with this name.
    UnknownMethod {
        /// The name.
        name: String,
    },
    /// A parameter is infinite or not a number.
    ParameterNotFinite {
        /// The parameter.
        parameter: String,
        /// Its value.
        value: f64,
    },
    /// A start value is infinite or not a number.
    StartNotFinite {
        /// The coordinate, `s1`, or its rate, `der(s1)`; `t` for the time.
        name: String,
        /// Its value.
        value: f64,
    },
    /// A distance of polar coordinates is negative at the start of a run in Cartesian ones, in which it is not: see
    /// [`Charted`](crate::Charted).
    NegativeDistance {
        /// The distance.
        distance: String,
        /// Its value, in the unit of the coordinate.
        value: f64,
        /// The angle of its direction.
        angle: String,
    },
    /// A machine in Cartesian coordinates is run for another one whose parameters are not the same.
    OtherParameters {
        /// A parameter.
        parameter: String,
        /// Its value in the machine that is run.
        value: f64,
        /// Its value in the other one.
        other: f64,
    },
    /// The function that sets the inputs returned a value that is infinite or not a number.
    InputNotFinite {
        /// The input.
        input: String,
        /// Its value.
        value: f64,
        /// Time, in s.
        t: f64,
    },
    /// An input is not known from some instant on: its table ends, or changes more often than the resolution of time.
    InputEnded {
        /// The name of the input or of its table.
        input: String,
        /// Why, as the end of a sentence.
        why: &'static str,
        /// Time, in s.
        t: f64,
    },
    /// A coordinate, its rate or its acceleration is infinite or not a number, and shorter steps do not avoid it.
    NotFinite {
        /// The coordinate.
        coordinate: String,
        /// Time, in s.
        t: f64,
    },
    /// The mass matrix cannot be inverted, and shorter steps do not avoid it.
    SingularMassMatrix {
        /// The coordinate at which the elimination stopped.
        coordinate: String,
        /// The pivot relative to the element on the diagonal of the mass matrix; infinite if an element of the matrix is infinite or not a number.
        ratio: f64,
        /// Time, in s.
        t: f64,
    },
    /// A constraint depends on others at a pose where it did not before, and shorter steps do not avoid it.
    DependentConstraint {
        /// The constraint.
        constraint: String,
        /// The pivot relative to the element on the diagonal of `G M⁻¹ Gᵀ`; infinite if an element of this matrix is infinite or not a number.
        ratio: f64,
        /// Time, in s.
        t: f64,
    },
    /// Constraints contradict each other, or no state nearby satisfies them.
    InconsistentConstraints {
        /// The constraint that is violated most.
        constraint: String,
        /// Other constraints that it depends on at this state and contradicts; empty if there is just no solution nearby.
        with: std::vec::Vec<String>,
        /// Its residual, relative to the size of its terms.
        residual: f64,
        /// Time, in s.
        t: f64,
    },
    /// The constraints cannot be satisfied at the start by moving only the numbers that are not [kept](crate::Simulation::keep).
    KeptStart {
        /// The constraints that are violated at the state that satisfies all of them best.
        contradictions: std::vec::Vec<KeptContradiction>,
        /// Time, in s.
        t: f64,
    },
    /// The law of friction permits no motion, or several: Painlevé's paradox of rods that slide on rough ground.
    FrictionParadox {
        /// The contact.
        contact: String,
        /// Whether several motions are possible; if not, none is.
        several: bool,
        /// Time, in s.
        t: f64,
        /// The coordinates then, in their order.
        q: std::vec::Vec<f64>,
        /// Their rates.
        v: std::vec::Vec<f64>,
    },
    /// The run cannot continue because of a unilateral contact.
    Contact {
        /// The contact.
        contact: String,
        /// The reason.
        trouble: ContactTrouble,
        /// Time, in s.
        t: f64,
        /// The coordinates then, in their order.
        q: std::vec::Vec<f64>,
        /// Their rates.
        v: std::vec::Vec<f64>,
    },
    /// Constraints become dependent that were independent before. From there the machine may continue in more than one way, like a
    /// parallelogram whose bars come into line. Neither the motion before nor inertia determines which: the machine is at rest there, or
    /// rounding hides it.
    Fork {
        /// The constraint that becomes dependent on the others.
        constraint: String,
        /// The length of its row orthogonal to those of the others, in the metric of inertia, relative to that at the start.
        left: f64,
        /// Time, in s.
        t: f64,
    },
    /// The method is [`TAYLOR`](crate::TAYLOR), and the motion has no series.
    NoSeries {
        /// The reason.
        reason: String,
    },
    /// The machine provides no workspace for its constraints ([`System::with_workspace`]).
    NoWorkspaceForConstraints {
        /// Time, in s.
        t: f64,
    },
    /// The machine provides no workspace for its contacts ([`System::with_workspace`]).
    NoWorkspaceForContacts {
        /// Time, in s.
        t: f64,
    },
    /// The derivatives of the accelerations were requested for a machine with contacts that stick or slide.
    ContactsNotDifferentiated {
        /// The first of them.
        contact: String,
        /// Time, in s.
        t: f64,
    },
    /// The motion within a step was requested after the inputs were changed at its
    /// end ([`Stepper::inputs_changed`](crate::Stepper::inputs_changed)).
    InputsChanged {
        /// Time, in s.
        t: f64,
    },
    /// The step has shrunk to the round-off of time and its error is still too large: the motion has a jump, a kink or a pole there, or
    /// the tolerance is too small.
    StepTooSmall {
        /// The coordinate with the largest error.
        coordinate: String,
        /// The step, in s.
        step: f64,
        /// Time, in s.
        t: f64,
    },
    /// The run needs more steps than allowed.
    TooManySteps {
        /// The number of steps taken.
        steps: usize,
        /// Time reached, in s.
        t: f64,
        /// Time to be reached, in s.
        until: f64,
    },
    /// An assumption of the description does not hold any more, on which the equations of motion may rest.
    AssumptionEnded {
        /// The assumption, as the description states it.
        assumption: String,
        /// When it ended, in s.
        t: f64,
    },
    /// Accelerations, multipliers and friction forces do not satisfy the equations of motion at a state: the functions of the machine
    /// contradict each other, so none of them can be trusted.
    EquationsViolated {
        /// The coordinate, or the constraint, whose equation is violated most.
        row: String,
        /// Whether it is a constraint: `G a = γ`, and not `M a = f + Gᵀ λ`.
        is_constraint: bool,
        /// The left side minus the right side.
        residual: f64,
        /// The size of the terms from which round-off in this row may come.
        terms: f64,
        /// Time, in s.
        t: f64,
    },
    /// The function of an event is not a number.
    EventNotFinite {
        /// The event.
        event: String,
        /// Time, in s.
        t: f64,
    },
    /// The zeros of a function that is watched could not be told from each other within one step: it is noise, as the difference of numbers that are far larger than
    /// it, or oscillates too often, or has too many kinks.
    ZerosNotIsolated {
        /// The name of the event, or the text of the assumption.
        watched: String,
        /// The beginning of the step, in s.
        t: f64,
        /// The number of values after which the search was given up.
        values: usize,
    },
    /// A time outside of the run was requested.
    OutsideRun {
        /// The requested time, in s.
        t: f64,
        /// When the run began, in s.
        from: f64,
        /// When it ended, in s.
        to: f64,
    },
    /// Energies were requested, but their balance was not kept (`energy_balance(true)`).
    NoEnergyBalance,
    /// A time within the run was requested, but its steps were not kept (`forget_steps`).
    StepsForgotten,
    /// The states of the unilateral contacts at this time were not kept, see
    /// [`forget_contact_phases`](crate::Simulation::forget_contact_phases).
    ContactsForgotten {
        /// Time, in s.
        t: f64,
    },
    /// An [`ExplicitStepper`](crate::ExplicitStepper) or an [`Ensemble`](crate::Ensemble) cannot do what was requested.
    Stepper {
        /// The reason, as in the message of its [`StepError`].
        message: String,
    },
}

/// A constraint that a start cannot satisfy while some of its numbers are kept.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct KeptContradiction {
    /// The constraint.
    pub constraint: String,
    /// Whether its rate cannot be satisfied, while its positions can.
    pub of_rates: bool,
    /// The kept numbers that occur in it; empty if it contradicts them through other constraints.
    pub kept: std::vec::Vec<String>,
    /// Its residual at the state that satisfies all constraints best, in `unit`.
    pub residual: f64,
    /// The SI unit of the residual.
    pub unit: String,
}

impl Error {
    /// Converts the error of a step, with the names of its machine.
    pub fn of_step<S: System>(error: StepError, system: &S) -> Self {
        let name = |index| name_of(system.coordinates().nth(index));
        match error {
            StepError::NotFinite { coordinate, t } => Self::NotFinite {
                coordinate: name(coordinate),
                t,
            },
            StepError::Singular { singular, t } => Self::of_singular(singular, system, t),
            StepError::Inconsistent {
                constraint,
                residual,
                t,
            } => Self::InconsistentConstraints {
                constraint: constraint_name(system, constraint),
                with: std::vec::Vec::new(),
                residual,
                t,
            },
            StepError::NoSeries { inputs: true, .. } => Self::NoSeries {
                reason: "its inputs are functions, which a series cannot represent".into(),
            },
            StepError::NoSeries { inputs: false, .. } => Self::NoSeries {
                reason: match system.check_series() {
                    Ok(()) => String::new(),
                    Err(reason) => reason.into(),
                },
            },
            StepError::Contact {
                contact,
                trouble,
                t,
            } => Self::Contact {
                contact: (system.unilateral_contacts().nth(contact))
                    .map_or("?", |contact| contact.name)
                    .into(),
                trouble,
                t,
                q: std::vec::Vec::new(),
                v: std::vec::Vec::new(),
            },
            StepError::NoTime { t } => Self::StartNotFinite {
                name: "t".into(),
                value: t,
            },
            StepError::OutsideStep { t, from, to } => Self::OutsideRun { t, from, to },
            StepError::NoWorkspace { t } => Self::NoWorkspaceForConstraints { t },
            StepError::Changed { t } => Self::InputsChanged { t },
            StepError::NoLength { .. } => Self::InvalidSetting {
                setting: "longest_step",
                value: f64::INFINITY,
                needed: "the length of the steps, in s: the method takes steps of a fixed length",
            },
            StepError::NotExplicit { .. }
            | StepError::Unsuited { .. }
            | StepError::NotSolved { .. }
            | StepError::Jump { .. }
            | StepError::FewDigits { .. }
            | StepError::NotFree { .. }
            | StepError::TooManySteps { .. } => Self::Stepper {
                message: error.to_string(),
            },
            StepError::StepTooSmall {
                coordinate,
                t,
                step,
            } => Self::StepTooSmall {
                coordinate: name(coordinate),
                step,
                t,
            },
        }
    }

    /// Converts equations of motion that cannot be solved.
    fn of_singular<S: System>(singular: Singular, system: &S, t: f64) -> Self {
        let name = singular.name(system).into();
        // An element that is infinite or not a number has no pivot to compare with.
        let ratio = if singular.ratio.is_nan() {
            f64::INFINITY
        } else {
            singular.ratio
        };
        match singular.at {
            Pivot::Coordinate(_) => Self::SingularMassMatrix {
                coordinate: name,
                ratio,
                t,
            },
            Pivot::Constraint(_) => Self::DependentConstraint {
                constraint: name,
                ratio,
                t,
            },
            Pivot::Contact(_) => Self::FrictionParadox {
                contact: name,
                several: ratio > 0.0,
                t,
                q: std::vec::Vec::new(),
                v: std::vec::Vec::new(),
            },
            Pivot::NoWorkspace => Self::NoWorkspaceForContacts { t },
            Pivot::NotDifferentiated(_) => Self::ContactsNotDifferentiated { contact: name, t },
        }
    }
}

/// The name of a constraint.
pub(crate) fn constraint_name<S: System>(system: &S, index: usize) -> String {
    let constraint = system.constraints().nth(index);
    constraint.map_or("?", |constraint| constraint.name).into()
}

fn name_of(quantity: Option<Quantity<'_>>) -> String {
    quantity.map_or("?", |quantity| quantity.name).into()
}

impl core::error::Error for Error {}

impl From<crate::UnknownName> for Error {
    fn from(error: crate::UnknownName) -> Self {
        Self::UnknownName(error)
    }
}

impl From<crate::HasFriction> for Error {
    fn from(error: crate::HasFriction) -> Self {
        Self::HasFriction(error)
    }
}
