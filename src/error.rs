//! Errors and warnings of runs, with the numbers that explain them.

#[cfg(feature = "interpreter")]
mod of_specs;

#[cfg(feature = "interpreter")]
pub use of_specs::{Diagnostic, MissingParameters, NoMachineCode, NoNumbers, Note};

use core::fmt::{self, Display};
use std::string::{String, ToString};

use crate::{ContactTrouble, Pivot, Quantity, StepError, System};

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
        /// The pivot relative to the element on the diagonal of the mass matrix.
        ratio: f64,
        /// Time, in s.
        t: f64,
    },
    /// A constraint depends on others at a pose where it did not before, and shorter steps do not avoid it.
    DependentConstraint {
        /// The constraint.
        constraint: String,
        /// The pivot relative to the element on the diagonal of `G M⁻¹ Gᵀ`.
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

/// ``with `x` and `y` kept, `rod` is 0.21 m^2 off``
impl Display for KeptContradiction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.kept.is_empty() {
            write!(f, "with {} kept, ", quoted(&self.kept))?;
        }
        let of = if self.of_rates { "the rate of " } else { "" };
        write!(f, "{of}`{}` is {:.4e}", self.constraint, self.residual)?;
        match self.unit.as_str() {
            "1" => write!(f, " off"),
            unit => write!(f, " {unit} off"),
        }
    }
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
            StepError::Singular { singular, t } => {
                let name = singular.name(system).into();
                // 0/0: nothing is left of an element that was 0.
                let ratio = if singular.ratio.is_nan() {
                    0.0
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
                    Pivot::NotDifferentiated(_) => {
                        Self::ContactsNotDifferentiated { contact: name, t }
                    }
                }
            }
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
}

/// A number in a message, with as few digits as necessary: `0.25`, `1e300`.
struct ShortNumber(f64);

impl Display for ShortNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if size == 0.0 || !size.is_finite() || (1e-4..1e9).contains(&size) {
            write!(f, "{}", self.0)
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}

/// The name of a constraint.
pub(crate) fn constraint_name<S: System>(system: &S, index: usize) -> String {
    let constraint = system.constraints().nth(index);
    constraint.map_or("?", |constraint| constraint.name).into()
}

/// Names in a sentence: `` `a`, `b` and `c` ``.
fn quoted(names: &[String]) -> String {
    let quoted = |name: &String| std::format!("`{name}`");
    match names {
        [] => String::new(),
        [one] => quoted(one),
        [first @ .., last] => {
            let first: std::vec::Vec<String> = first.iter().map(quoted).collect();
            std::format!("{} and {}", first.join(", "), quoted(last))
        }
    }
}

fn name_of(quantity: Option<Quantity<'_>>) -> String {
    quantity.map_or("?", |quantity| quantity.name).into()
}

impl Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            #[cfg(feature = "interpreter")]
            Self::Spec {
                diagnostics,
                omitted,
            } => {
                for (i, diagnostic) in diagnostics.iter().enumerate() {
                    write!(f, "{}{diagnostic}", if i == 0 { "" } else { "\n" })?;
                }
                match omitted {
                    0 => Ok(()),
                    _ => write!(f, "\n{omitted} more errors are not shown"),
                }
            }
            Self::UnknownName(unknown) => write!(f, "{unknown}"),
            #[cfg(feature = "interpreter")]
            Self::MissingParameters(missing) => write!(f, "{missing}"),
            #[cfg(feature = "interpreter")]
            Self::NoMachineCode(none) => write!(f, "{none}"),
            #[cfg(feature = "interpreter")]
            Self::NoNumbers(none) => write!(f, "{none}"),
            Self::HasFriction(error) => write!(f, "{error}"),
            Self::EnergiesUnknown { t } => write!(
                f,
                "no energy balance can be computed: the system does not give its kinetic and potential energies at t = {t} s; leave \
                 out `energy_balance(true)`, or provide both energies",
                t = ShortNumber(*t)
            ),
            Self::NoEnd => {
                write!(
                    f,
                    "the simulation has no end time: set it with `until(…)`, in seconds"
                )
            }
            Self::InvalidSetting {
                setting,
                value,
                needed,
            } => {
                write!(
                    f,
                    "`{setting}({value})`: must be {needed}",
                    value = ShortNumber(*value)
                )
            }
            Self::UnknownCoordinate { name } => write!(f, "no coordinate is named `{name}`"),
            Self::UnknownVariable { name, known } => {
                let known = if known.is_empty() {
                    "only the state".into()
                } else {
                    known.join(", ")
                };
                write!(
                    f,
                    "accelerations are not differentiated with respect to `{name}`, which must be in the description's \
                     `derivatives`; available: {known}"
                )
            }
            Self::ConstrainedSensitivity { constraint } => write!(
                f,
                "the motion is subject to the constraint `{constraint}`, and derivatives of a start that satisfies the constraints \
                 are not known: use differences of runs, or coordinates that need no constraint"
            ),
            Self::CollidingSensitivity { contact } => write!(
                f,
                "the motion reaches the contact `{contact}`, where derivatives jump: use `lagrangian sensitivities`, or \
                 `lagrangian_linear::across` in programs, to carry them across"
            ),
            Self::UnknownMethod { name } => {
                write!(f, "no method of integration is named `{name}`; there are")?;
                for (i, method) in crate::Method::all().enumerate() {
                    write!(
                        f,
                        "{} `{}`",
                        if i == 0 { "" } else { "," },
                        method.tableau.name
                    )?;
                }
                Ok(())
            }
            Self::NoSeries { reason } => write!(
                f,
                "the motion has no Taylor series here: {reason}; use another method, such as `dop853`"
            ),
            Self::Contact {
                contact,
                trouble,
                t,
                q,
                v,
            } => {
                let words = trouble.words();
                write!(
                    f,
                    "the contact `{contact}` at t = {t} s: {words}",
                    t = ShortNumber(*t)
                )?;
                if !q.is_empty() {
                    write!(f, "; the coordinates are {q:?} and their rates {v:?}")?;
                }
                Ok(())
            }
            Self::ParameterNotFinite { parameter, value } => {
                write!(
                    f,
                    "parameter `{parameter}` is {value}; it must be a finite number",
                    value = ShortNumber(*value)
                )
            }
            Self::StartNotFinite { name, value } => {
                write!(
                    f,
                    "the start value of `{name}` is {value}; it must be a finite number",
                    value = ShortNumber(*value)
                )
            }
            Self::InputNotFinite { input, value, t } => {
                write!(
                    f,
                    "input `{input}` is {value} at t = {t} s; it must be a finite number",
                    t = ShortNumber(*t),
                    value = ShortNumber(*value)
                )
            }
            Self::InputEnded { input, why, t } => {
                write!(f, "{input} {why} t = {t} s", t = ShortNumber(*t))
            }
            Self::NotFinite { coordinate, t } => write!(
                f,
                "`{coordinate}`, its rate or its acceleration has no finite value at t = {t} s, and shorter steps do not help",
                t = ShortNumber(*t)
            ),
            Self::SingularMassMatrix {
                coordinate,
                ratio,
                t,
            } => no_inertia(f, coordinate, *ratio, *t),
            Self::FrictionParadox {
                contact,
                several,
                t,
                q,
                v,
            } => {
                let count = if *several {
                    "several motions may satisfy"
                } else {
                    "no motion satisfies"
                };
                write!(
                    f,
                    "{count} the friction law of `{contact}` at t = {t} s",
                    t = ShortNumber(*t)
                )?;
                if !q.is_empty() {
                    write!(f, ", q = {q:?}, v = {v:?}")?;
                }
                write!(
                    f,
                    ": Coulomb's law with rigid bodies does not determine what happens (Painlevé's paradox)"
                )
            }
            Self::DependentConstraint {
                constraint,
                ratio,
                t,
            } => write!(
                f,
                "the constraint `{constraint}` becomes dependent on others at t = {t} s, and shorter steps do not help (elimination \
                 leaves {ratio:.1e} of its element on the diagonal of G M⁻¹ Gᵀ): the reactions are not unique there. Leave out a constraint \
                 that follows from others, or avoid the pose with other start values or other parameters",
                t = ShortNumber(*t)
            ),
            Self::InconsistentConstraints {
                constraint,
                with,
                residual,
                t,
            } if with.is_empty() => write!(
                f,
                "the constraint `{constraint}` cannot be met near the state at t = {t} s: its residual is \
                 {residual:.1e} of the size of its terms",
                t = ShortNumber(*t)
            ),
            Self::InconsistentConstraints {
                constraint,
                with,
                residual,
                t,
            } => write!(
                f,
                "the constraint `{constraint}` contradicts {} at t = {t} s: its residual is {residual:.1e} of the size of its terms",
                quoted(with),
                t = ShortNumber(*t)
            ),
            Self::Fork {
                constraint,
                left,
                t,
            } => write!(
                f,
                "branches of the motion meet near t = {t} s: the constraint `{constraint}` becomes dependent on the others (the \
                 part of its gradient that is independent of them has {left:.1e} of its length at the start), and neither the motion nor \
                 inertia determines on which branch the machine continues. Start it slightly away from that pose, or with rates along one of the branches",
                t = ShortNumber(*t)
            ),
            Self::KeptStart { contradictions, t } => {
                let are = if contradictions.len() == 1 { "" } else { "s" };
                write!(
                    f,
                    "the start values that are kept contradict the constraint{are} at t = {} s. However the other values are changed, ",
                    ShortNumber(*t)
                )?;
                for (i, contradiction) in contradictions.iter().enumerate() {
                    write!(f, "{}{contradiction}", if i == 0 { "" } else { "; " })?;
                }
                write!(f, ". Keep fewer values, or give values that are consistent")
            }
            Self::NoWorkspaceForConstraints { t } => write!(
                f,
                "the machine provides no workspace for its constraints at t = {t} s",
                t = ShortNumber(*t)
            ),
            Self::NoWorkspaceForContacts { t } => write!(
                f,
                "the machine provides no workspace for its contacts at t = {t} s",
                t = ShortNumber(*t)
            ),
            Self::ContactsNotDifferentiated { contact, t } => write!(
                f,
                "the accelerations cannot be differentiated at t = {t} s: `{contact}` may stick or slide, and a sticking contact \
                 has no linearization",
                t = ShortNumber(*t)
            ),
            Self::InputsChanged { t } => write!(
                f,
                "the motion before t = {t} s must be read before the inputs are changed there",
                t = ShortNumber(*t)
            ),
            Self::StepTooSmall {
                coordinate,
                step,
                t,
            } => write!(
                f,
                "the step shrank to {step:e} s at t = {t} s, and the error of `{coordinate}` is still too large: the \
                 motion has a jump, a kink or a pole there, or the tolerance is too small",
                t = ShortNumber(*t)
            ),
            Self::TooManySteps { steps, t, until } => write!(
                f,
                "{steps} steps reach only t = {t} s of {until} s: allow more with `max_steps`, or raise the tolerance",
                t = ShortNumber(*t),
                until = ShortNumber(*until)
            ),
            Self::AssumptionEnded { assumption, t } => {
                write!(
                    f,
                    "the machine assumes `{assumption}`, which no longer holds at t = {t} s",
                    t = ShortNumber(*t)
                )
            }
            Self::EquationsViolated {
                row,
                is_constraint,
                residual,
                terms,
                t,
            } => {
                let (of, equation) = if *is_constraint {
                    ("the constraint", "G a - γ")
                } else {
                    ("the coordinate", "M a - f - Gᵀ λ")
                };
                write!(
                    f,
                    "the accelerations do not satisfy the equations of motion to within rounding at t = {t} s: in the row of {of} \
                     `{row}`, {equation} is {residual:e} compared with terms of {terms:e}; this is an error of the program \
                     and not of the machine, and nothing that follows from it can be trusted: please report it",
                    t = ShortNumber(*t)
                )
            }
            Self::EventNotFinite { event, t } => {
                write!(
                    f,
                    "the function of event `{event}` is not a number at t = {t} s",
                    t = ShortNumber(*t)
                )
            }
            Self::OutsideRun { t, from, to } => {
                write!(
                    f,
                    "t = {t} s is outside of the run, which goes from {from} s to {to} s",
                    t = ShortNumber(*t),
                    from = ShortNumber(*from),
                    to = ShortNumber(*to)
                )
            }
            Self::NoEnergyBalance => {
                write!(
                    f,
                    "no energy balance was computed; set `energy_balance(true)`"
                )
            }
            Self::ContactsForgotten { t } => {
                write!(
                    f,
                    "the states of the contacts at t = {t} s were not kept; leave out `forget_contact_phases()`"
                )
            }
            Self::StepsForgotten => {
                write!(
                    f,
                    "the steps of this run were not kept; leave out `forget_steps()`"
                )
            }
            Self::Stepper { message } => write!(f, "{message}"),
        }
    }
}

/// Writes why the mass matrix cannot be inverted, and what to do.
fn no_inertia(f: &mut fmt::Formatter<'_>, coordinate: &str, ratio: f64, t: f64) -> fmt::Result {
    /// Elimination that leaves more than this has not been stopped by rounding.
    const MORE_THAN_ROUNDING: f64 = 1e-9;
    let t = ShortNumber(t);
    if ratio.is_finite() && ratio.abs() > MORE_THAN_ROUNDING {
        return write!(
            f,
            "the mass matrix is not positive definite at t = {t} s: a motion that changes the coordinate `{coordinate}` has negative \
             kinetic energy. Check the masses and the moments of inertia of what it moves"
        );
    }
    write!(
        f,
        "the mass matrix is singular at t = {t} s: a motion that changes the coordinate `{coordinate}` has no kinetic energy "
    )?;
    if ratio == 0.0 || !ratio.is_finite() {
        write!(
            f,
            "(nothing of its diagonal element remains after elimination)"
        )?;
    } else {
        write!(
            f,
            "({ratio:.1e} of its diagonal element remains after elimination, which is rounding error)"
        )?;
    }
    write!(
        f,
        ". Give a mass or a moment of inertia to what it moves; if the coordinate has no meaning at that pose, like the angle of polar \
         coordinates at a radius of 0, start elsewhere or choose other coordinates, for polar ones in `charts` of the spec"
    )
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

/// Warnings of a run that ended without an error.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Warning {
    /// The relative tolerance is finer than the numbers allow, and was raised.
    ToleranceRaised {
        /// The requested tolerance.
        asked: f64,
        /// The tolerance used.
        used: f64,
    },
    /// Stability and not accuracy limits the steps: something in the machine
    /// is far stiffer, or far more strongly damped, than its motion shows.
    Stiff {
        /// When it was detected, in s.
        t: f64,
    },
    /// The residual of the energy balance is larger than tolerance and rounding explain.
    EnergyUnexplained {
        /// The residual, in J.
        residual: f64,
        /// The part that tolerance and rounding explain, in J: see [`EnergyBalance::explained`](crate::EnergyBalance::explained).
        explained: f64,
        /// The residual relative to the energy exchanged.
        relative: f64,
    },
    /// Impacts created energy, as Newton's law with friction may.
    ImpactGains {
        /// The contact with the largest gain.
        contact: String,
        /// The time of that impact, in s.
        t: f64,
        /// The energy that it created, in J.
        gain: f64,
        /// The number of impacts that created energy.
        impacts: usize,
    },
    /// The friction of several contacts that were closed together, as those of a disc that is wedged in between two others, permitted no motion with their slips or
    /// with their restitution. The slips that were in the way stopped at once, by impulses, or the impact was one without restitution.
    ContactsJammed {
        /// When this was so first, in s.
        t: f64,
        /// The contacts that jammed then.
        contacts: std::vec::Vec<String>,
        /// The number of instants at which contacts jammed.
        instants: usize,
    },
    /// The motion depends on how contacts share their load, which rigid bodies leave undetermined. The distribution of contacts that all yield alike could not
    /// be computed, and another possible one was taken.
    LoadShared {
        /// When this was so first, in s.
        t: f64,
        /// The contacts that shared their load then.
        contacts: std::vec::Vec<String>,
        /// The number of instants, or of steps of time stepping, at which it was so.
        instants: usize,
    },
    /// Unilateral contacts changed too often for each instant to be located,
    /// and the run changed to time stepping, whose error nothing bounds.
    HandedOver {
        /// When it first did so, in s.
        t: f64,
        /// The length of the steps then, in s.
        step: f64,
        /// The number of instants at which contacts had changed last, and the time in which they did, in s; `None` if contacts did not
        /// settle at one instant.
        crowd: Option<(usize, f64)>,
        /// The number of times that it did so.
        times: usize,
        /// When it returned for good to locating every event, in s, if it did.
        back_at: Option<f64>,
    },
    /// A constraint follows from others at the start, so multipliers are not unique: those of least norm are returned, and the motion
    /// does not depend on this choice.
    RedundantConstraint {
        /// The constraint.
        constraint: String,
        /// The others.
        with: std::vec::Vec<String>,
    },
    /// The start violated the constraints, and was moved onto them.
    StartMoved {
        /// The coordinate, `s1`, or its rate, `der(s1)`.
        name: String,
        /// The given value.
        from: f64,
        /// The value at the start of the run.
        to: f64,
    },
}

impl Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ToleranceRaised { asked, used } => write!(
                f,
                "a relative tolerance of {asked:e} asks for more digits than the numbers have; {used:e} was used"
            ),
            Self::EnergyUnexplained {
                residual,
                explained,
                relative,
            } => write!(
                f,
                "the energies do not balance: the residual is {residual:.1e} J, {relative:.1e} of the energy exchanged, \
                 while tolerance and rounding explain {explained:.1e} J; the motion is less accurate than requested, or \
                 its equations and its energies are inconsistent"
            ),
            Self::ImpactGains {
                contact,
                t,
                gain,
                impacts,
            } => write!(
                f,
                "impacts created energy, {impacts} of them, the most {gain:.2e} J at t = {t} s when `{contact}` closed: \
                 Newton's law with friction can do so; `law: stronge` never does",
                t = ShortNumber(*t)
            ),
            Self::ContactsJammed {
                t,
                contacts,
                instants,
            } => {
                write!(
                    f,
                    "the friction of {} admitted no motion with their slips or their restitution at t = {t} s: they stopped, or met without restitution",
                    quoted(contacts),
                    t = ShortNumber(*t)
                )?;
                match instants {
                    0 | 1 => Ok(()),
                    more => write!(f, "; there were {more} such instants"),
                }
            }
            Self::LoadShared {
                t,
                contacts,
                instants,
            } => {
                write!(
                    f,
                    "the motion depends on how {} share their load at t = {t} s: the distribution of contacts that all yield alike \
                     could not be computed, and another possible one was taken",
                    quoted(contacts),
                    t = ShortNumber(*t)
                )?;
                match instants {
                    0 | 1 => Ok(()),
                    more => write!(f, "; there were {more} such instants"),
                }
            }
            Self::HandedOver {
                t,
                step,
                crowd,
                times,
                back_at,
            } => {
                match crowd {
                    Some((count, within)) => write!(
                        f,
                        "contacts changed at {count} instants within {within:.1e} s"
                    )?,
                    None => write!(f, "contacts did not settle at one instant")?,
                }
                write!(
                    f,
                    " up to t = {t} s: from there the run continued with time stepping in steps of {step:.1e} s, whose error is not \
                     controlled; a shorter longest step shows how large it is",
                    t = ShortNumber(*t)
                )?;
                if *times > 1 {
                    write!(f, "; it did so {times} times")?;
                }
                match back_at {
                    Some(t) => write!(
                        f,
                        "; from t = {t} s it located every event again",
                        t = ShortNumber(*t)
                    ),
                    None => Ok(()),
                }
            }
            Self::RedundantConstraint { constraint, with } if with.is_empty() => write!(
                f,
                "the constraint `{constraint}` restricts nothing at the start"
            ),
            Self::RedundantConstraint { constraint, with } => write!(
                f,
                "the constraint `{constraint}` is redundant given {}: the motion is unique, and the multipliers are those \
                 of least norm",
                quoted(with)
            ),
            Self::StartMoved { name, from, to } => write!(
                f,
                "the start was moved onto the constraints: `{name}` from {from} to {to}",
                from = ShortNumber(*from),
                to = ShortNumber(*to)
            ),
            Self::Stiff { t } => write!(
                f,
                "the machine is stiff from t = {t} s: the step size is limited by stability, not by accuracy; the method `radau5` \
                 takes longer steps",
                t = ShortNumber(*t)
            ),
        }
    }
}
