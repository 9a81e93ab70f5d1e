//! The trials of a search and their outcomes.

use core::fmt::{self, Display};

/// The start of a trial.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Start {
    /// A path given by the caller.
    Guess,
    /// The straight path in coordinates.
    Straight,
    /// The straight path, bent to one side.
    Bowed {
        /// The displacement in the middle, in each coordinate.
        by: Vec<f64>,
    },
    /// The closed form of the machine with constant coefficients, continued to the machine itself.
    Frozen,
    /// The motion of the machine without friction, continued while friction grows to that of the machine.
    Frictionless {
        /// Its duration without friction, in s; `None` where no motion without friction was found.
        time: Option<f64>,
    },
}

/// The outcome of a trial.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Outcome {
    /// A motion that is a local minimum.
    Found {
        /// Its duration, in s.
        time: f64,
    },
    /// A motion, or a polygon, to which another start led as well.
    Same {
        /// The index of that trial.
        trial: usize,
    },
    /// An extremal that is not a minimum: a change of its directions would be faster. Legendre's condition
    /// fails, or Jacobi's.
    NotLeast {
        /// Its duration, in s.
        time: f64,
        /// The time from which faster motions exist beside it, in s after the start.
        since: f64,
    },
    /// A polygon near which Newton's method finds no extremal.
    NotSmooth {
        /// Its duration, in s.
        time: f64,
    },
    /// The machine cannot traverse any path near this one from rest.
    Lacks {
        /// The energy lacking at the start, in J, on the path that needs least among those examined; infinite if no energy suffices.
        energy: f64,
    },
    /// The continuation, from constant coefficients or from no friction to the machine itself, lost the motion.
    Lost {
        /// The parameter of the continuation at which it failed.
        part: f64,
    },
    /// No motion of the machine without friction was found, so there was none to continue.
    Nothing,
    /// The trial was not finished because the budget of the search was exhausted.
    Unfinished,
}

/// A trial: its start and its outcome.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// Its start.
    pub start: Start,
    /// Its outcome.
    pub outcome: Outcome,
}

impl Trial {
    /// Its duration, in s, if it is less than `known` and was not continued to a local minimum.
    pub(crate) fn shorter_duration_of_unfinished(&self, known: f64) -> Option<f64> {
        let time = match self.outcome {
            Outcome::NotSmooth { time } | Outcome::NotLeast { time, .. } => time,
            _ => return None,
        };
        // The accuracy of polygons.
        (time < (1.0 - 1e-3) * known).then_some(time)
    }
}

impl Display for Start {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Guess => write!(f, "the guess"),
            Self::Straight => write!(f, "the straight path"),
            Self::Bowed { by } => {
                write!(f, "a path displaced by (")?;
                for (i, x) in by.iter().enumerate() {
                    let comma = if i == 0 { "" } else { ", " };
                    write!(f, "{comma}{}", short(*x))?;
                }
                write!(f, ") in the middle")
            }
            Self::Frozen => write!(f, "the machine with constant coefficients"),
            Self::Frictionless { time: Some(time) } => {
                write!(
                    f,
                    "the motion without friction, of {time:.6} s, with friction added in steps"
                )
            }
            Self::Frictionless { time: None } => write!(f, "the machine without friction"),
        }
    }
}

impl Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Found { time } => write!(f, "{time:.9} s"),
            Self::Same { trial } => write!(f, "the same as number {}", trial + 1),
            Self::NotLeast { time, since } => write!(
                f,
                "{time:.9} s, but from t = {since:.6} s on other directions would save time"
            ),
            Self::NotSmooth { time } => write!(
                f,
                "about {time:.6} s along straight pieces, near which no smooth motion was found"
            ),
            Self::Lacks { energy } if energy.is_finite() => write!(
                f,
                "cannot be travelled from rest, and neither can paths near it: {} J are lacking",
                short(*energy)
            ),
            Self::Lacks { .. } => write!(f, "cannot be travelled at any speed"),
            Self::Lost { part } => write!(
                f,
                "lost at {:.1} % of the way to the machine itself",
                100.0 * part
            ),
            Self::Nothing => write!(f, "no motion was found from any of these starts"),
            Self::Unfinished => write!(f, "not finished: the budget of the search was used up"),
        }
    }
}

impl Display for Trial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.start, self.outcome)
    }
}

/// Rounds to three digits.
fn short(x: f64) -> f64 {
    std::format!("{x:.2e}").parse().unwrap_or(x) + 0.0
}
