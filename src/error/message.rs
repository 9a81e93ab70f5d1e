//! The messages of errors of runs.

use core::fmt::{self, Display};

use super::{Error, KeptContradiction};
use crate::sentences::{Quoted, ShortNumber, said_as_it_is, sentences};

/// ``with `x` and `y` kept, `rod` is 0.21 m^2 off``
impl Display for KeptContradiction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.kept.is_empty() {
            write!(f, "with {} kept, ", Quoted(&self.kept))?;
        }
        let of = if self.of_rates { "the rate of " } else { "" };
        write!(f, "{of}`{}` is {:.4e}", self.constraint, self.residual)?;
        match self.unit.as_str() {
            "1" => write!(f, " off"),
            unit => write!(f, " {unit} off"),
        }
    }
}

said_as_it_is! { std::vec::Vec<KeptContradiction> }
#[cfg(feature = "interpreter")]
said_as_it_is! { std::vec::Vec<super::Diagnostic> }

impl Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write_sentence(f)
    }
}

sentences! { Error, written to f:
    #[cfg(feature = "interpreter")]
    Spec { diagnostics, omitted } => {
        for (i, diagnostic) in diagnostics.iter().enumerate() {
            write!(f, "{}{diagnostic}", if i == 0 { "" } else { "\n" })?;
        }
        match omitted {
            0 => Ok(()),
            _ => write!(f, "\n{omitted} more errors are not shown"),
        }
    }
    UnknownName(unknown) => "{unknown}"
    #[cfg(feature = "interpreter")]
    MissingParameters(missing) => "{missing}"
    #[cfg(feature = "interpreter")]
    NoMachineCode(none) => "{none}"
    #[cfg(feature = "interpreter")]
    NoNumbers(none) => "{none}"
    HasFriction(error) => "{error}"
    EnergiesUnknown { t } =>
        "no energy balance can be computed: the system does not give its kinetic and potential energies at t = {t} s; leave \
         out `energy_balance(true)`, or provide both energies"
    NoEnd => "the simulation has no end time: set it with `until(…)`, in seconds"
    InvalidSetting { setting, value, needed } => "`{setting}({value})`: must be {needed}"
    UnknownCoordinate { name } => "no coordinate is named `{name}`"
    UnknownVariable { name, known } => {
        let known = match known.0 {
            [] => "only the state".into(),
            names => names.join(", "),
        };
        write!(
            f,
            "accelerations are not differentiated with respect to `{name}`, which must be in the description's \
             `derivatives`; available: {known}"
        )
    }
    ConstrainedSensitivity { constraint } =>
        "the motion is subject to the constraint `{constraint}`, and derivatives of a start that satisfies the constraints \
         are not known: use differences of runs, or coordinates that need no constraint"
    CollidingSensitivity { contact } =>
        "the motion reaches the contact `{contact}`, where derivatives jump: use `lagrangian sensitivities`, or \
         `lagrangian_linear::across` in programs, to carry them across"
    UnknownMethod { name } => {
        write!(f, "no method of integration is named `{name}`; there are")?;
        for (i, method) in crate::Method::all().enumerate() {
            write!(f, "{} `{}`", if i == 0 { "" } else { "," }, method.tableau.name)?;
        }
        Ok(())
    }
    NoSeries { reason } =>
        "the motion has no Taylor series here: {reason}; use another method, such as `dop853`"
    Contact { contact, trouble, t, q, v } => {
        write!(f, "the contact `{contact}` at t = {t} s: {}", trouble.words())?;
        if !q.is_empty() {
            write!(f, "; the coordinates are {q:?} and their rates {v:?}")?;
        }
        Ok(())
    }
    ParameterNotFinite { parameter, value } =>
        "parameter `{parameter}` is {value}; it must be a finite number"
    StartNotFinite { name, value } =>
        "the start value of `{name}` is {value}; it must be a finite number"
    NegativeDistance { distance, value, angle } =>
        "the distance `{distance}` is {value} at the start, and in Cartesian coordinates it is not negative; start from the \
         positive distance with `{angle}` changed by pi, or run the machine in the coordinates of its description"
    OtherParameters { parameter, value, other } =>
        "the parameter `{parameter}` is {value} in the machine in Cartesian coordinates and {other} in that of the description; \
         set the parameters first, and then make the one from the other by `in_cartesian`"
    InputNotFinite { input, value, t } =>
        "input `{input}` is {value} at t = {t} s; it must be a finite number"
    InputEnded { input, why, t } => "{input} {why} t = {t} s"
    NotFinite { coordinate, t } =>
        "`{coordinate}`, its rate or its acceleration has no finite value at t = {t} s, and shorter steps do not help"
    SingularMassMatrix { coordinate, ratio, t } => { no_inertia(f, coordinate, ratio.0, t) }
    FrictionParadox { contact, several, t, q, v } => {
        let count = if *several {
            "several motions may satisfy"
        } else {
            "no motion satisfies"
        };
        write!(f, "{count} the friction law of `{contact}` at t = {t} s")?;
        if !q.is_empty() {
            write!(f, ", q = {q:?}, v = {v:?}")?;
        }
        write!(
            f,
            ": Coulomb's law with rigid bodies does not determine what happens (Painlevé's paradox)"
        )
    }
    DependentConstraint { constraint, ratio, t } => {
        if ratio.0 == f64::INFINITY {
            return write!(
                f,
                "the row of the constraint `{constraint}` in G M⁻¹ Gᵀ has no finite value at t = {t} s, {WITHOUT_VALUE}"
            );
        }
        write!(
            f,
            "the constraint `{constraint}` becomes dependent on others at t = {t} s, and shorter steps do not help (elimination \
             leaves {ratio:.1e} of its element on the diagonal of G M⁻¹ Gᵀ): the reactions are not unique there. Leave out a constraint \
             that follows from others, or avoid the pose with other start values or other parameters"
        )
    }
    InconsistentConstraints { constraint, with, residual, t } => {
        if with.is_empty() {
            write!(f, "the constraint `{constraint}` cannot be met near the state at t = {t} s")?;
        } else {
            write!(f, "the constraint `{constraint}` contradicts {with} at t = {t} s")?;
        }
        if residual.0 > 10.0 {
            // Terms that vanish are no scale.
            return write!(f, ": where the search ended, its residual is far from 0");
        }
        write!(f, ": its residual is {residual:.1e} of the size of its terms")
    }
    Fork { constraint, left, t } =>
        "branches of the motion meet near t = {t} s: the constraint `{constraint}` becomes dependent on the others (the \
         part of its gradient that is independent of them has {left:.1e} of its length at the start), and neither the motion nor \
         inertia determines on which branch the machine continues. Start it slightly away from that pose, or with rates along one of the branches"
    KeptStart { contradictions, t } => {
        let are = if contradictions.len() == 1 { "" } else { "s" };
        write!(
            f,
            "the start values that are kept contradict the constraint{are} at t = {t} s. However the other values are changed, "
        )?;
        for (i, contradiction) in contradictions.iter().enumerate() {
            write!(f, "{}{contradiction}", if i == 0 { "" } else { "; " })?;
        }
        write!(f, ". Keep fewer values, or give values that are consistent")
    }
    NoWorkspaceForConstraints { t } =>
        "the machine provides no workspace for its constraints at t = {t} s"
    NoWorkspaceForContacts { t } =>
        "the machine provides no workspace for its contacts at t = {t} s"
    ContactsNotDifferentiated { contact, t } =>
        "the accelerations cannot be differentiated at t = {t} s: `{contact}` may stick or slide, and a sticking contact \
         has no linearization"
    InputsChanged { t } =>
        "the motion before t = {t} s must be read before the inputs are changed there"
    StepTooSmall { coordinate, step, t } =>
        "the step shrank to {step:e} s at t = {t} s, and the error of `{coordinate}` is still too large: the \
         motion has a jump, a kink or a pole there, or the tolerance is too small"
    TooManySteps { steps, t, until } =>
        "{steps} steps reach only t = {t} s of {until} s: allow more with `max_steps`, or raise the tolerance"
    AssumptionEnded { assumption, t } =>
        "the machine assumes `{assumption}`, which does not hold at t = {t} s"
    EquationsViolated { row, is_constraint, residual, terms, t } => {
        let (of, equation) = if *is_constraint {
            ("the constraint", "G a - γ")
        } else {
            ("the coordinate", "M a - f - Gᵀ λ")
        };
        write!(
            f,
            "the accelerations do not satisfy the equations of motion to within rounding at t = {t} s: in the row of {of} \
             `{row}`, {equation} is {residual:e} compared with terms of {terms:e}; this is an error of the program \
             and not of the machine, and nothing that follows from it can be trusted: please report it"
        )
    }
    EventNotFinite { event, t } =>
        "the function of event `{event}` is not a number at t = {t} s"
    ZerosNotIsolated { watched, t, values } =>
        "the zeros of `{watched}` could not be told from each other with {values} values in the step from t = {t} s: it is the round-off of \
         numbers that are far larger than it, or oscillates too often in one step"
    OutsideRun { t, from, to } =>
        "t = {t} s is outside of the run, which goes from {from} s to {to} s"
    NoEnergyBalance => "no energy balance was computed; set `energy_balance(true)`"
    ContactsForgotten { t } =>
        "the states of the contacts at t = {t} s were not kept; leave out `forget_contact_phases()`"
    StepsForgotten => "the steps of this run were not kept; leave out `forget_steps()`"
    Stepper { message } => "{message}"
}

/// Why an element of a matrix has no finite value, and what to do.
const WITHOUT_VALUE: &str = "since numbers overflow (they exceed 1.8e308) or a formula is undefined there. Check the sizes of parameters and of start values";

/// Writes why the mass matrix cannot be inverted, and what to do.
fn no_inertia(
    f: &mut fmt::Formatter<'_>,
    coordinate: &str,
    ratio: f64,
    t: ShortNumber,
) -> fmt::Result {
    /// Elimination that leaves more than this has not been stopped by rounding.
    const MORE_THAN_ROUNDING: f64 = 1e-9;
    if ratio == f64::INFINITY {
        return write!(
            f,
            "the mass matrix has no finite value in the row of the coordinate `{coordinate}` at t = {t} s, {WITHOUT_VALUE}"
        );
    }
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
        ". Give a mass or a moment of inertia to what it moves; if the coordinate has no meaning at that pose, start elsewhere or choose \
         other coordinates: for the angle of polar coordinates at a radius of 0 in `charts` of the spec, and for one of three angles of a \
         frame in space, of which two turn about one axis there, turn the frame by a quaternion"
    )
}
