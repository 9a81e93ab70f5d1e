//! Which methods a run took that was free to choose.

use core::fmt::{self, Display};

use crate::methods::Method;

/// A run that [chooses its method](crate::Simulation::automatic) went on by one.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct MethodChoice {
    /// Since when, in s.
    pub t: f64,
    /// The method.
    pub method: &'static Method,
    /// Why.
    pub reason: MethodReason,
}

/// Why a run went on by a method.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MethodReason {
    /// A step by Taylor series, which takes `cost` evaluations of the accelerations, is that of so many evaluations of `dop853`,
    /// `saved`, or more.
    SeriesPays {
        /// What a step costs, in evaluations of the accelerations.
        cost: f64,
        /// What as much time costs in steps of the explicit method.
        saved: f64,
    },
    /// As before, but steps of the explicit method take less.
    SeriesCosts {
        /// What a step by series costs, in evaluations of the accelerations.
        cost: f64,
        /// What as much time costs in steps of the explicit method.
        saved: f64,
    },
    /// There is no series to choose, and nothing was known of stiffness.
    Explicit,
    /// Steps were held short by stability and not by accuracy: the fastest part of the machine, whose motion has died away, has this
    /// rate, in 1/s, where that is known.
    Stiff {
        /// The rate, in 1/s; 0 where only the length of steps has shown it.
        rate: f64,
    },
    /// The fastest part of the machine has become as slow that explicit steps take less.
    NotStiff {
        /// Its rate, in 1/s.
        rate: f64,
    },
    /// The series has no value where the machine came to.
    NoSeries,
}

impl Display for MethodReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SeriesPays { cost, saved } => write!(
                f,
                "a step by series costs {cost:.0} evaluations, and as much time {saved:.0} in steps of dop853"
            ),
            Self::SeriesCosts { cost, saved } => write!(
                f,
                "a step by series would cost {cost:.0} evaluations, where as much time takes {saved:.0}"
            ),
            Self::Explicit => f.write_str("nothing is known to be stiff"),
            Self::Stiff { rate } if *rate > 0.0 => write!(
                f,
                "steps were held short by stability and not by accuracy; the fastest rate is {rate:.1e}/s"
            ),
            Self::Stiff { .. } => {
                f.write_str("steps were held short by stability and not by accuracy")
            }
            Self::NotStiff { rate } => write!(
                f,
                "the fastest rate is {rate:.1e}/s, and explicit steps take less work again"
            ),
            Self::NoSeries => f.write_str("the series has no value there"),
        }
    }
}
