//! What a search tried, and what came of it.

use core::fmt::{self, Display};

/// From what a search starts.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Start {
    /// A way that the caller gave.
    Guess,
    /// The straight way in coordinates.
    Straight,
    /// The straight way, moved aside.
    Bowed {
        /// By so much in the middle, in each coordinate.
        by: Vec<f64>,
    },
    /// The closed form of the machine with constant coefficients, followed to the machine itself.
    Frozen,
    /// The motion of the machine without friction, followed while friction grows to that of the machine.
    Frictionless {
        /// The time that it takes without friction, in s; `None` where no motion without friction was found.
        time: Option<f64>,
    },
}

/// What came of a start.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Outcome {
    /// A motion that is faster than its neighbours.
    Found {
        /// The time that it takes, in s.
        time: f64,
    },
    /// A motion, or a path of straight pieces, that another start led to as well.
    Same {
        /// Which, in the order of the trials.
        trial: usize,
    },
    /// An extremal, but a change of its directions would save time: Legendre's condition fails, or Jacobi's.
    NotLeast {
        /// The time that it takes, in s.
        time: f64,
        /// From when on there are faster ones beside it, in s after the start.
        since: f64,
    },
    /// A way of straight pieces that could not be made smooth: Newton's method finds no extremal at it.
    NotSmooth {
        /// The time that it takes, in s.
        time: f64,
    },
    /// No way near this one is gone from rest.
    Lacks {
        /// The energy that is lacking at the start on the way that needs least of those that were looked at, in J; infinite where
        /// none would do.
        energy: f64,
    },
    /// Followed from constant coefficients, or from no friction, to those of the machine, the motion was lost.
    Lost {
        /// Which part of the way was gone.
        part: f64,
    },
    /// The machine without friction has no motion that was found, so there was none to follow.
    Nothing,
    /// It was not looked at to its end, as the search had done what it may.
    Unfinished,
}

/// A start, and what came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// From what.
    pub start: Start,
    /// What came of it.
    pub outcome: Outcome,
}

impl Trial {
    /// Its time, in s, where it was not followed to a motion that is faster than its neighbours and is less than this one.
    pub(crate) fn doubt(&self, known: f64) -> Option<f64> {
        let time = match self.outcome {
            Outcome::NotSmooth { time } | Outcome::NotLeast { time, .. } => time,
            _ => return None,
        };
        // Straight pieces are good to so much.
        (time < (1.0 - 1e-3) * known).then_some(time)
    }
}

impl Display for Start {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Guess => write!(f, "the guess"),
            Self::Straight => write!(f, "the straight way"),
            Self::Bowed { by } => {
                write!(f, "a way that is aside by (")?;
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
                "about {time:.6} s by straight pieces, at which no smooth motion was found"
            ),
            Self::Lacks { energy } if energy.is_finite() => write!(
                f,
                "cannot be gone from rest, nor can what is near: {} J are lacking",
                short(*energy)
            ),
            Self::Lacks { .. } => write!(f, "cannot be gone at any speed"),
            Self::Lost { part } => write!(
                f,
                "lost at {:.1} % of the way to the machine itself",
                100.0 * part
            ),
            Self::Nothing => write!(f, "no motion was found from any of these starts"),
            Self::Unfinished => write!(f, "not finished: the search had done what it may"),
        }
    }
}

impl Display for Trial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.start, self.outcome)
    }
}

/// Three digits.
fn short(x: f64) -> f64 {
    std::format!("{x:.2e}").parse().unwrap_or(x) + 0.0
}
