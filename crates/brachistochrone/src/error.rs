//! Errors of the search for a fastest motion.

use core::fmt::{self, Display};

use super::trial::Trial;

/// Why there is no fastest motion, or none that the formulas yield.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Unsolved {
    /// A list or a matrix does not have as many entries as there are coordinates.
    Size {
        /// The list or matrix.
        list: &'static str,
        /// The expected number.
        expected: usize,
        /// The number found.
        found: usize,
    },
    /// A number is infinite or not a number.
    NotFinite {
        /// The list or matrix.
        list: &'static str,
    },
    /// The mass matrix is not symmetric.
    NotSymmetric {
        /// Row of the entry.
        row: usize,
        /// Column of the entry.
        column: usize,
    },
    /// The mass matrix is not positive definite.
    NoInertia {
        /// The coordinate at which the elimination stopped, counted from 0.
        coordinate: usize,
        /// The remaining pivot, relative to the diagonal entry.
        ratio: f64,
    },
    /// Friction that grows with accelerations exceeds inertia: `a + sym d` is not positive definite, and a forward push
    /// would slow the machine down.
    FrictionOutweighsInertia {
        /// The coordinate at which the elimination stopped, counted from 0.
        coordinate: usize,
        /// The remaining pivot, relative to the diagonal entry.
        ratio: f64,
    },
    /// Start and end are the same.
    SameEnds,
    /// Neither the potential nor friction has a slope, so the machine stays at rest.
    NothingDrives,
    /// The end cannot be reached from rest: it is not below the start.
    NotBelow {
        /// How much the potential energy rises on the way, in J.
        rise: f64,
    },
    /// The end is below the start, but friction takes more than the descent gives.
    Held {
        /// The potential energy released by the descent, in J.
        descent: f64,
        /// The friction work on the straight path at constant velocity, in J, which is the least possible.
        friction: f64,
    },
    /// The direction would have to turn so far that the friction saved in turning outweighs inertia: a jump of the
    /// direction is faster than any smooth turn.
    TurnsTooFar {
        /// Angle between the first direction and the end, in rad, in the metric of the motion.
        angle: f64,
        /// The greatest angle at which there is a smooth motion, in rad.
        reach: f64,
    },
    /// With three coordinates or more, a loop of directions traversed in no time would multiply the speed: more
    /// loops are always faster, so there is no fastest motion. Along such loops reactions become negative, and the
    /// laws of sliding fail.
    LoopsFeed {
        /// The two coordinates of the loop with the largest gain, counted from 0.
        coordinates: [usize; 2],
        /// `½ (d_αβ − d_βα)`, relative to the inertia of the two.
        skew: f64,
    },
    /// No start led to a motion that is a local minimum.
    NotFound {
        /// All trials and their outcomes.
        tried: Vec<Trial>,
    },
}

impl Display for Unsolved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size {
                list: what,
                expected,
                found,
            } => write!(f, "{what} has {found} entries where {expected} are needed"),
            Self::NotFinite { list: what } => {
                write!(f, "{what} has an entry that is not a finite number")
            }
            Self::NotSymmetric { row, column } => write!(
                f,
                "the mass matrix is not symmetric: entry ({row}, {column}) differs from ({column}, {row}), counted from 0"
            ),
            Self::NoInertia { coordinate, ratio } => write!(
                f,
                "the mass matrix is not positive definite: coordinate {coordinate}, counted from 0, has {ratio:.1e} of its \
                 inertia left after elimination of the others"
            ),
            Self::FrictionOutweighsInertia { coordinate, ratio } => write!(
                f,
                "friction that grows with the accelerations outweighs inertia: coordinate {coordinate}, counted from 0, has \
                 {ratio:.1e} of its inertia left; the machine jams"
            ),
            Self::SameEnds => write!(f, "start and end are the same: there is nothing to move"),
            Self::NothingDrives => write!(
                f,
                "nothing drives the machine: neither potential energy nor friction has a slope, and from rest it stays at rest"
            ),
            Self::NotBelow { rise } => write!(
                f,
                "the end cannot be reached from rest: the potential energy there is not below that of the start (it rises by \
                 {rise:.6} J)"
            ),
            Self::Held { descent, friction } => write!(
                f,
                "friction is too strong: the descent gives {descent:.6} J, and friction takes at least {friction:.6} J on the \
                 way to the end"
            ),
            Self::TurnsTooFar { angle, reach } => write!(
                f,
                "no smooth motion is the fastest: the end lies {angle:.6} rad from the first direction, and beyond {reach:.6} \
                 rad what friction saves in a turn outweighs inertia"
            ),
            Self::LoopsFeed {
                coordinates: [one, other],
                skew,
            } => write!(
                f,
                "no motion is the fastest: a small loop of directions in coordinates {one} and {other}, counted from 0, \
                 multiplies the speed in no time (the friction matrix is not symmetric, by {skew:.3e} of the inertia); with \
                 constraints that leave two coordinates there may be one"
            ),
            Self::NotFound { tried } => {
                write!(f, "no fastest motion was found; tried:")?;
                for (number, trial) in tried.iter().enumerate() {
                    write!(f, "\n  {}. {trial}", number + 1)?;
                }
                Ok(())
            }
        }
    }
}

impl core::error::Error for Unsolved {}
