//! What a machine consists of, by name: states, numbers, assumptions and constraints.

/// Time, coordinates and rates of a machine.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct State<C> {
    /// Time, in s.
    pub t: f64,
    /// Coordinates.
    pub q: C,
    /// Their rates `dq/dt`.
    pub v: C,
}

/// Name and unit of a number: `s1` in `m`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity<'a> {
    /// The name in the description; a member of a family with its index, `q[3]`.
    pub name: &'a str,
    /// The SI unit; `1` for a bare number.
    pub unit: &'a str,
}

impl<'a> Quantity<'a> {
    /// A number of this name, in this unit.
    pub const fn new(name: &'a str, unit: &'a str) -> Self {
        Self { name, unit }
    }
}

/// A fact that a description assumes (`assume { s1 > 0 }`), and the margin by which it holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assumption<'a> {
    /// The fact as the description states it, `s1 > 0`.
    pub text: &'a str,
    /// The larger side minus the smaller one.
    pub margin: f64,
    /// Whether a margin of exactly 0 violates the fact (`>` and `<`, not `>=` and `<=`).
    pub strict: bool,
}

impl Assumption<'_> {
    /// Whether the fact holds; it does not if the margin is NaN.
    pub fn holds(&self) -> bool {
        self.margin > 0.0 || (!self.strict && self.margin >= 0.0)
    }
}

/// A bilateral constraint on positions, `g(q, t) = 0`, or on rates alone, `G(q, t) v + … = 0`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Constraint<'a> {
    /// The name in the description.
    pub name: &'a str,
    /// The SI unit of `g`; of the rate, if the constraint is not holonomic.
    pub unit: &'a str,
    /// The SI unit of its multiplier: a force for a length, a torque for an angle.
    pub multiplier_unit: &'a str,
    /// Whether it is a constraint on positions.
    pub holonomic: bool,
}
