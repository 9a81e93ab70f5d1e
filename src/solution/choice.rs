//! The methods of a run that chooses its method.

use core::fmt::{self, Display};

use crate::methods::Method;

/// A choice in a run that [chooses its method](crate::Simulation::automatic), or a change between [`TAYLOR`](crate::TAYLOR) and `dop853` where contacts open and close.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct MethodChoice {
    /// The time from which it holds, in s.
    pub t: f64,
    /// The method.
    pub method: &'static Method,
    /// The reason.
    pub reason: MethodReason,
}

/// Why a run chose a method.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MethodReason {
    /// A step by Taylor series, which costs `cost` evaluations of the accelerations, replaces steps of `dop853` with at least as
    /// many evaluations, `saved`, that would be as accurate.
    SeriesPays {
        /// The cost of a step by series, in evaluations of the accelerations.
        cost: f64,
        /// The cost of the same time in steps of the explicit method.
        saved: f64,
    },
    /// The opposite: steps of the explicit method cost less.
    SeriesCosts {
        /// The cost of a step by series, in evaluations of the accelerations.
        cost: f64,
        /// The cost of the same time in steps of the explicit method.
        saved: f64,
    },
    /// There is no series to choose, and no stiffness was detected.
    Explicit,
    /// Stability and not accuracy limited the steps: the fastest part of the machine, whose motion has decayed, has this rate,
    /// if it is known.
    Stiff {
        /// The rate, in 1/s; 0 if only the lengths of steps revealed it.
        rate: f64,
    },
    /// Explicit steps cost less than those of the implicit method: the fastest part of the machine has become slow, or accuracy limits both.
    NotStiff {
        /// Its rate, in 1/s.
        rate: f64,
    },
    /// The series has no value at the state that the machine reached.
    NoSeries,
    /// All unilateral contacts have opened: the motion has a Taylor series, by which this run goes on then.
    Open,
    /// A unilateral contact has closed, in a way in which a run by Taylor series goes on by an explicit method.
    Closed,
    /// A unilateral contact is closed, and the motion has a Taylor series, by which this run goes on then.
    ClosedInSeries,
}

impl Display for MethodReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SeriesPays { cost, saved } => write!(
                f,
                "a step by series costs {cost:.0} evaluations, and the same time interval {saved:.0} in steps of dop853 that are as accurate"
            ),
            Self::SeriesCosts { cost, saved } => write!(
                f,
                "a step by series would cost {cost:.0} evaluations, where the same time interval takes {saved:.0} in steps of dop853 that are as accurate"
            ),
            Self::Explicit => f.write_str("nothing is known to be stiff"),
            Self::Stiff { rate } if *rate > 0.0 => write!(
                f,
                "the step size was limited by stability and not by accuracy; the fastest rate is {rate:.1e}/s"
            ),
            Self::Stiff { .. } => {
                f.write_str("the step size was limited by stability and not by accuracy")
            }
            Self::NotStiff { rate } => write!(
                f,
                "the fastest rate is {rate:.1e}/s, and explicit steps are cheaper again"
            ),
            Self::NoSeries => f.write_str("the series has no value there"),
            Self::Open => f.write_str("all contacts are open"),
            Self::Closed => f.write_str("a contact is closed"),
            Self::ClosedInSeries => f.write_str("a contact is closed, and the motion has a series"),
        }
    }
}
