//! The ways in which a program can differ from the equations it came from.

use std::fmt;

use lagrangian_program::{Role, Singular};

/// The ways in which a program can be wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum Disagreement {
    /// A result has another value.
    Result {
        /// The function.
        role: Role,
        /// The index of the result.
        index: usize,
        /// The number of the point.
        point: u64,
    },
    /// The accelerations do not obey the equation of this coordinate.
    Motion {
        /// The index of the coordinate.
        coordinate: usize,
        /// The number of the point.
        point: u64,
    },
    /// The accelerations do not obey this constraint.
    Constraint {
        /// The index of the constraint.
        constraint: usize,
        /// The number of the point.
        point: u64,
    },
    /// The normal reaction of this guide does not balance the forces that would open it.
    Reaction {
        /// The index of the contact.
        contact: usize,
        /// The number of the point.
        point: u64,
    },
    /// A coordinate was eliminated by a constraint that does not determine it.
    Eliminated {
        /// The index of the coordinate.
        coordinate: usize,
        /// The index of the constraint.
        constraint: usize,
        /// The number of the point.
        point: u64,
    },
    /// The guarded pivots are not those of the mass matrix.
    Pivots {
        /// The number of the point.
        point: u64,
    },
    /// The program reports a machine as singular that is not.
    Singular(Singular),
    /// No point was found at which everything has a value.
    Undefined,
    /// The proof does not compare this function.
    NotCompared {
        /// The function.
        role: Role,
    },
    /// No point was found within the number of comparisons that the size of the machine allows.
    Exhausted {
        /// The number of comparisons.
        comparisons: u64,
    },
}

impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Disagreement::Result { role, index, point } => {
                write!(
                    f,
                    "result {index} of {} differs at point {point}",
                    role.name()
                )
            }
            Disagreement::Motion { coordinate, point } => {
                write!(
                    f,
                    "the accelerations break equation {coordinate} at point {point}"
                )
            }
            Disagreement::Constraint { constraint, point } => {
                write!(
                    f,
                    "the accelerations break constraint {constraint} at point {point}"
                )
            }
            Disagreement::Reaction { contact, point } => {
                write!(f, "the normal reaction {contact} differs at point {point}")
            }
            Disagreement::Eliminated {
                coordinate,
                constraint,
                point,
            } => {
                write!(
                    f,
                    "constraint {constraint} does not settle coordinate {coordinate} at point {point}"
                )
            }
            Disagreement::Pivots { point } => {
                write!(
                    f,
                    "the guards do not hold the pivots of the elimination at point {point}"
                )
            }
            Disagreement::Singular(singular) => {
                write!(f, "called singular in coordinate {}", singular.coordinate)
            }
            Disagreement::NotCompared { role } => {
                write!(f, "nothing is compared with {}", role.name())
            }
            Disagreement::Undefined => {
                f.write_str("no point where everything has a value was found")
            }
            Disagreement::Exhausted { comparisons } => write!(
                f,
                "no point where everything has a value was found in {comparisons} comparisons"
            ),
        }
    }
}

impl std::error::Error for Disagreement {}
