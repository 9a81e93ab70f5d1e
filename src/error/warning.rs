//! Warnings of runs, with their messages.

use core::fmt::{self, Display};
use std::string::String;

use crate::sentences::{ShortNumber, sentences};

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
    /// An angle became so large that numbers as large as it are far apart, so forces that depend on it are inaccurate.
    LargeAngle {
        /// The coordinate.
        name: String,
        /// Its value at the end, in rad.
        angle: f64,
        /// The distance from it to the next number, in rad.
        spacing: f64,
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
    /// The motion depends on how contacts share their load, which rigid bodies leave undetermined. The distribution of equally stiff contacts could not
    /// be computed, and another possible one was taken.
    LoadShared {
        /// When this was so first, in s.
        t: f64,
        /// The contacts that shared their load then.
        contacts: std::vec::Vec<String>,
        /// The number of instants, or of steps of time stepping, at which it was so.
        instants: usize,
    },
    /// In a step of time stepping no impulses of all contacts that touched were found that obey the laws of contact: only contacts that were closed in the middle of the
    /// step gave impulses, and what others penetrated was left by a displacement.
    ContactsLeftOut {
        /// The end of the first such step, in s.
        t: f64,
        /// The contacts that gave no impulses in it, although they were closed before it or closed within it.
        contacts: std::vec::Vec<String>,
        /// The number of such steps.
        steps: usize,
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
        self.write_sentence(f)
    }
}

sentences! { Warning, written to f:
    ToleranceRaised { asked, used } =>
        "a relative tolerance of {asked:e} asks for more digits than the numbers have; {used:e} was used"
    LargeAngle { name, angle, spacing } =>
        "`{name}` reached {angle:.3e} rad, where numbers are {spacing:.1e} rad apart: forces that depend on it are no more \
         accurate; start it within a few turns of 0"
    EnergyUnexplained { residual, explained, relative } =>
        "the energies do not balance: the residual is {residual:.1e} J, {relative:.1e} of the energy exchanged, \
         while tolerance and rounding explain {explained:.1e} J; the motion is less accurate than requested, or \
         its equations and its energies are inconsistent"
    ImpactGains { contact, t, gain, impacts } =>
        "impacts created energy, {impacts} of them, the most {gain:.2e} J at t = {t} s when `{contact}` closed: \
         Newton's law with friction can do so; `law: stronge` never does"
    ContactsJammed { t, contacts, instants } => {
        let more = InstantsOfMany(*instants);
        write!(
            f,
            "the friction of {contacts} admitted no motion with their slips or their restitution at t = {t} s: they stopped, or met without \
             restitution{more}"
        )
    }
    LoadShared { t, contacts, instants } => {
        let more = InstantsOfMany(*instants);
        write!(
            f,
            "the motion depends on how {contacts} share their load at t = {t} s: the distribution of equally stiff contacts \
             could not be computed, and another possible one was taken{more}"
        )
    }
    ContactsLeftOut { t, contacts, steps } => {
        write!(
            f,
            "no impulses of all contacts were found in the step of time stepping that ended at t = {t} s: only contacts that were closed in its middle \
             gave impulses, and not {contacts}"
        )?;
        match *steps {
            0 | 1 => Ok(()),
            steps => write!(f, "; there were {steps} such steps"),
        }
    }
    HandedOver { t, step, crowd, times, back_at } => {
        match crowd {
            Some((count, within)) => write!(f, "contacts changed at {count} instants within {within:.1e} s")?,
            None => write!(f, "contacts did not settle at one instant")?,
        }
        write!(
            f,
            " up to t = {t} s: from there the run continued with time stepping in steps of {step:.1e} s, whose error is not \
             controlled; a shorter longest step shows how large it is"
        )?;
        if *times > 1 {
            write!(f, "; it did so {times} times")?;
        }
        match back_at.map(ShortNumber) {
            Some(t) => write!(f, "; from t = {t} s it located every event again"),
            None => Ok(()),
        }
    }
    RedundantConstraint { constraint, with } => {
        if with.is_empty() {
            return write!(f, "the constraint `{constraint}` restricts nothing at the start");
        }
        write!(
            f,
            "the constraint `{constraint}` is redundant given {with}: the motion is unique, and the multipliers are those \
             of least norm"
        )
    }
    StartMoved { name, from, to } =>
        "the start was moved onto the constraints: `{name}` from {from} to {to}"
    Stiff { t } =>
        "the machine is stiff from t = {t} s: the step size is limited by stability, not by accuracy; the method `radau5` \
         takes longer steps"
}

/// The number of instants to which a warning applies, as the end of its sentence; nothing for a single one, which the sentence names.
struct InstantsOfMany(usize);

impl Display for InstantsOfMany {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            0 | 1 => Ok(()),
            instants => write!(f, "; there were {instants} such instants"),
        }
    }
}
