//! Straight-line arithmetic, the form from which a machine is emitted, compiled or interpreted.
//!
//! A [`Program`] knows named values with shapes, not mechanics: it lists the operations, in order, that
//! turn the arguments of a function into its results. The emitters print it, the [interpreter](Interpreter)
//! runs it over any type of number, and the proof compares it with Lagrange's equations.
//!
//! ```text
//! parameters ─▶ prepare ─▶ prepared values ─┐
//!                          t, q, v, u, a ───┴▶ function ─▶ results
//! ```
//!
//! Invariants of every program, which [`Program::verify`] checks after every pass in debug builds:
//!
//! * code is in static single assignment form: the value of the operation at index k is [`Value`]
//!   k, and the operands of an operation have smaller indices than it;
//! * a function reads no arguments but those in its row of the [table of quantities](quantity);
//! * every operation is used, directly or indirectly, by a result or a guard of its function;
//! * only [`Program::prepare`] and [`Program::start`] read parameters, and they read nothing else;
//!   all other functions read prepared values instead, and contain no operation whose operands all
//!   depend on parameters alone;
//! * no two operations of a function are equal;
//! * the order of operations is the order of rounding: running a program must not reorder
//!   operations, and may contract a multiplication and an addition into one rounding only where
//!   [`fused`] says so;
//! * the same description gives the same program.

use lagrangian_symbolic::{self as symbolic, Rational};

use lagrangian_units::{
    Compliance, ImpactLaw, ImpactOrder, Name, Painleve, Stages, Unit, Variable, state_of,
};

pub mod accuracy;
pub mod choose;
pub mod contact_parts;
mod cost;
mod count;
mod factor;
pub mod formula;
mod fusion;
pub mod graph;
mod interpret;
mod latency;
mod listing;
mod mutate;
pub mod net;
mod packs;
mod pairs;
pub mod quantity;
mod repeats;
pub mod rounding;
pub mod schedule;
mod selection;
pub mod series;
mod signs;
pub mod solve;
pub mod stages;
pub mod steps;
mod tangent;
mod verify;

pub use choose::{Basis, Candidate, Choice, Form, MOST_ROUNDING, best};
pub use cost::{Cost, cycles};
pub use count::Counts;
pub use fusion::{Contracted, Contraction, Contractions, Side, fused, ready_times, uses};
pub use interpret::{Arguments, Interpreter};
pub use mutate::{Mutant, mutants};
pub use packs::{Pack, PackedOperation, PackedStatement, packs};
pub use quantity::Role;
pub use repeats::{Operand, Repeat, Statement, StatementKind, Statements, early_angles};
pub use rounding::Rounding;
pub use schedule::LONGEST_SCHEDULED;
pub use steps::EliminationStep;
pub use tangent::is_differentiated;
// The results of `Role::Friction`.
#[doc(inline)]
pub use lagrangian_scalar::friction::{FrictionLayout, FrictionPart, FrictionResponse};
pub use lagrangian_scalar::projection::ProjectionLayout;

/// A machine as straight-line arithmetic.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// The machine's name, a Rust type name.
    pub name: String,
    /// What the spec says about the machine.
    pub docs: String,
    /// Run-time parameters; [`Source::Parameter`] counts them.
    pub parameters: Vec<Slot>,
    /// Generalized coordinates; [`Source::Coordinate`], `Velocity` and `Acceleration` count them.
    pub coordinates: Vec<Slot>,
    /// The quaternions that turn frames, by the indices of their coordinates: only the ratios of these matter, and their length
    /// returns to 1 by itself.
    pub quaternions: Vec<[usize; 4]>,
    /// Values that the user sets while the machine runs; [`Source::Input`] counts them.
    pub inputs: Vec<Slot>,
    /// Outputs; [`Role::Output`] counts them.
    pub outputs: Vec<Slot>,
    /// Assumptions that a run checks; [`Role::Assumption`] counts them.
    pub assumptions: Vec<Fact>,
    /// The bilateral constraints; functions about constraints exist only if there are any.
    pub constraints: Vec<Constraint>,
    /// The names of the guided contacts with friction; functions about them exist only if there are any.
    pub contacts: Vec<String>,
    /// The number of components of their normal reactions: one in the plane, along the normal; three in space, along
    /// the ground axes.
    pub reaction_axes: usize,
    /// The guided contacts that are second tangents of surfaces, as a bit set: if bit `k` is set, contact `k` is perpendicular to
    /// contact `k − 1` on the same surface.
    pub second_tangents: u64,
    /// The unilateral contacts; functions about them exist only if there are any.
    pub unilateral: Vec<Unilateral>,
    /// The start values, such as `theta` or `der(phi)`, that are kept when a start that violates
    /// the constraints is corrected.
    pub kept: Vec<String>,
    /// The variables by which [`Role::Derivatives`] differentiates, in the order of its columns;
    /// empty if there is no such function.
    pub derivatives: Vec<Variable>,
    /// Whether [`Role::AtTime`] and [`Role::AtPosition`] exist; with either of them
    /// [`Role::AccelerationsAt`] exists too.
    pub stages: Stages,
    /// Computes the prepared values, which depend on parameters alone: reads parameters, and its
    /// results are the prepared values.
    ///
    /// Its guards are the pivots of the mass matrix that depend on parameters alone. If one fails,
    /// the accelerations exist at no state; the other functions are not affected.
    pub prepare: Function,
    /// For each prepared value its formula in terms of parameters, as a spec would write it;
    /// truncated (`…`) if it is long.
    pub prepared: Vec<String>,
    /// The coordinates at the start, followed by their rates if any of these is not 0; reads parameters only.
    pub start: Function,
    /// All other functions, in the order of [`Role`].
    pub functions: Vec<Function>,
    /// For each function with several possible forms, the alternatives, in the order of [`Role`].
    pub choices: Vec<Choice>,
}

/// An argument: a parameter, a coordinate, an input; or an output.
#[derive(Clone, Debug, PartialEq)]
pub struct Slot {
    /// Its name.
    pub name: Name,
    /// What the spec says about it.
    pub docs: String,
    /// Its unit.
    pub unit: Unit,
    /// Its unit as the spec writes it.
    pub unit_text: String,
    /// Its value if the user does not set it. Coordinates and outputs have none:
    /// see [`Program::start`].
    pub default: Option<Default>,
}

impl Slot {
    /// The unit as a label beside its number: as the spec writes it if that is not an SI unit.
    pub fn label(&self) -> String {
        if self.unit.is_scaled() || state_of(&self.name.base).is_some() {
            self.unit_text.clone()
        } else {
            self.unit.to_string()
        }
    }
}

/// The default of a parameter or an input.
#[derive(Clone, Debug, PartialEq)]
pub struct Default {
    /// The number, rounded once.
    pub value: f64,
    /// As the spec may write it: `50*pi`.
    pub text: String,
}

/// A fact that a run checks: the value of its function is positive, or at least nonnegative.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fact {
    /// As the spec writes it: `s1 > 0`.
    pub text: String,
    /// Whether the value 0 violates it.
    pub strict: bool,
}

/// A bilateral constraint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Constraint {
    /// Its name; the two constraints of rolling circles are `wheel.gap` and `wheel.slip`.
    pub name: String,
    /// The unit of its residual; of the rate of the residual for a constraint of velocities alone.
    pub unit: String,
    /// The unit of its multiplier.
    pub multiplier_unit: String,
    /// Whether it constrains positions, not only velocities.
    pub holonomic: bool,
}

/// A unilateral contact.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unilateral {
    /// Its name.
    pub name: String,
    /// The impact law, if the contact is rigid.
    pub law: ImpactLaw,
    /// Whether simultaneous impacts are solved together or one after the other.
    pub order: ImpactOrder,
    /// What happens if friction leaves no consistent motion (Painlevé's paradox).
    pub painleve: Painleve,
    /// The force law, if the contact is compliant.
    pub compliance: Option<Compliance>,
    /// Whether there is friction.
    pub has_friction: bool,
    /// Whether it is the rolling resistance of the preceding contact. It then has the gap and the normal force of that
    /// contact; its slip is the relative angular velocity of the two bodies, in rad/s, its friction the torque that
    /// resists this, in N m, and its coefficient of friction a length, in m.
    pub is_rolling_resistance: bool,
    /// Whether it is the second tangent of the preceding contact, in space. It then has the gap, the normal and the coefficients
    /// of that contact, but its own slip and friction. The resultant of both friction forces is at most `μ` times the normal force.
    pub is_second_tangent: bool,
    /// Whether it is a corner on a face of a polygon, which has ends: see [`Role::ContactFaces`].
    pub has_face: bool,
    /// Whether it is a guide, which is never open and presses to either side: see [`Role::GuideMatrix`]. Guides stand behind all other contacts. The gap and the
    /// row of the normal are 0.
    pub is_guide: bool,
}

/// How the results of a function are arranged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One number.
    Scalar,
    /// This many numbers.
    Vector(usize),
    /// A symmetric matrix of this order, its lower triangle row by row: entry (i, j), j ≤ i, is
    /// result i (i + 1)/2 + j.
    Symmetric(usize),
    /// A matrix with this many rows and columns, row by row.
    Matrix(usize, usize),
}

impl Shape {
    /// The number of results.
    pub fn len(self) -> usize {
        match self {
            Shape::Scalar => 1,
            Shape::Vector(n) => n,
            Shape::Symmetric(n) => n * (n + 1) / 2,
            Shape::Matrix(rows, columns) => rows * columns,
        }
    }

    /// The number of rows.
    pub fn order(self) -> usize {
        match self {
            Shape::Scalar => 1,
            Shape::Vector(n) | Shape::Symmetric(n) | Shape::Matrix(n, _) => n,
        }
    }

    /// The index of entry (i, j) of a symmetric matrix, which is entry (j, i) too.
    pub fn index(i: usize, j: usize) -> usize {
        let (i, j) = (i.max(j), i.min(j));
        i * (i + 1) / 2 + j
    }

    /// Row and column of an entry in a lower triangle, by its index.
    pub fn place(index: usize) -> (usize, usize) {
        // The largest i with i (i + 1)/2 ≤ index.
        let i = ((8 * index + 1).isqrt() - 1) / 2;
        (i, index - i * (i + 1) / 2)
    }

    /// Whether there are no results.
    pub fn is_empty(self) -> bool {
        self.len() == 0
    }
}

/// A self-contained piece of straight-line code.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// What it computes.
    pub role: Role,
    /// The operations.
    pub code: Vec<Op>,
    /// How the results are arranged.
    pub shape: Shape,
    /// The results, [`Shape::len`] of them.
    pub results: Vec<Value>,
    /// The conditions under which the results are meaningful, in the order in which they are to be reported.
    pub guards: Vec<Guard>,
    /// Which values are steps of an elimination, in the order of the values.
    pub steps: Vec<(Value, EliminationStep)>,
}

impl Function {
    /// Whether the results are linear in time, coordinates and velocities, and depend on nothing else that changes.
    fn is_linear(&self) -> bool {
        // The degree of each operation; 2 stands for higher degrees and for functions that are no polynomials.
        let mut degrees: Vec<u8> = Vec::with_capacity(self.code.len());
        for op in &self.code {
            let most = op.operands().map(|x| degrees[x.index()]).max().unwrap_or(0);
            degrees.push(match op {
                Op::Constant(_) | Op::Pi => 0,
                Op::Read(Source::Parameter(_) | Source::Prepared(_)) => 0,
                Op::Read(Source::Time | Source::Coordinate(_) | Source::Velocity(_)) => 1,
                Op::Read(_) => 2,
                Op::Add(..) | Op::Sub(..) | Op::Neg(_) => most,
                Op::Mul(a, b) => (degrees[a.index()] + degrees[b.index()]).min(2),
                Op::Div(a, b) if degrees[b.index()] == 0 => degrees[a.index()],
                _ if most == 0 => 0,
                _ => 2,
            });
        }
        self.results.iter().all(|x| degrees[x.index()] < 2)
    }
}

/// The value of an operation: the index of the operation in [`Function::code`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Value(pub u32);

impl Value {
    /// The index of the operation.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// An operation.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// A rational number, to be rounded once.
    Constant(Rational),
    /// π.
    Pi,
    /// An argument.
    Read(Source),
    /// a + b.
    Add(Value, Value),
    /// a − b.
    Sub(Value, Value),
    /// a·b.
    Mul(Value, Value),
    /// a/b.
    Div(Value, Value),
    /// −a.
    Neg(Value),
    /// The rounding error of a·b; 0 in exact arithmetic.
    ProductError(Value, Value),
    /// The rounding error of a + b; 0 in exact arithmetic.
    SumError(Value, Value),
    /// sin a. If `Cos` of the same value occurs too, both are to be computed together.
    Sin(Value),
    /// cos a.
    Cos(Value),
    /// A function of one argument, other than sine and cosine.
    Unary(symbolic::Function, Value),
    /// A function of two arguments.
    Binary(symbolic::Function, Value, Value),
}

impl Op {
    /// The operands: none, one or two.
    pub fn operands(&self) -> impl Iterator<Item = Value> + use<> {
        let (a, b) = match *self {
            Op::Constant(_) | Op::Pi | Op::Read(_) => (None, None),
            Op::Neg(a) | Op::Sin(a) | Op::Cos(a) | Op::Unary(_, a) => (Some(a), None),
            Op::Add(a, b)
            | Op::Sub(a, b)
            | Op::Mul(a, b)
            | Op::Div(a, b)
            | Op::ProductError(a, b)
            | Op::SumError(a, b)
            | Op::Binary(_, a, b) => (Some(a), Some(b)),
        };
        a.into_iter().chain(b)
    }

    /// This operation with each operand replaced by `moved` of it.
    #[must_use]
    pub fn with_operands(&self, mut moved: impl FnMut(Value) -> Value) -> Op {
        match *self {
            Op::Constant(_) | Op::Pi | Op::Read(_) => self.clone(),
            Op::Add(a, b) => Op::Add(moved(a), moved(b)),
            Op::Sub(a, b) => Op::Sub(moved(a), moved(b)),
            Op::Mul(a, b) => Op::Mul(moved(a), moved(b)),
            Op::Div(a, b) => Op::Div(moved(a), moved(b)),
            Op::Neg(a) => Op::Neg(moved(a)),
            Op::ProductError(a, b) => Op::ProductError(moved(a), moved(b)),
            Op::SumError(a, b) => Op::SumError(moved(a), moved(b)),
            Op::Sin(a) => Op::Sin(moved(a)),
            Op::Cos(a) => Op::Cos(moved(a)),
            Op::Unary(function, a) => Op::Unary(function, moved(a)),
            Op::Binary(function, a, b) => Op::Binary(function, moved(a), moved(b)),
        }
    }
}

/// The source of an argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Source {
    /// A parameter.
    Parameter(u32),
    /// A prepared value.
    Prepared(u32),
    /// The time t.
    Time,
    /// A coordinate q.
    Coordinate(u32),
    /// A velocity v.
    Velocity(u32),
    /// An input u.
    Input(u32),
    /// An acceleration a.
    Acceleration(u32),
    /// A result of [`Role::AtTime`].
    AtTime(u32),
    /// A result of [`Role::AtPosition`].
    AtPosition(u32),
}

/// A pivot that must not vanish: the results are meaningless unless `pivot > tolerance·scale`.
///
/// It is a pivot of the mass matrix or, with constraints, of G M⁻¹ Gᵀ.
///
/// The condition is written so that a NaN pivot fails too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guard {
    /// The pivot dᵢ of M = L D Lᵀ.
    pub pivot: Value,
    /// The diagonal entry Mᵢᵢ from which it was reduced. It is the pivot itself if nothing was
    /// subtracted, or if Mᵢᵢ is not available; then the pivot need only be positive.
    pub scale: Value,
    /// The fraction of the scale that may be round-off.
    pub tolerance: f64,
    /// The index i of the coordinate; indices beyond the coordinates are those of constraints.
    pub coordinate: usize,
}

/// The machine has no accelerations here: its mass matrix is singular to working precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Singular {
    /// The index of the coordinate whose effective inertia vanishes; indices beyond the coordinates
    /// are those of constraints that depend on the ones before them.
    pub coordinate: usize,
    /// The fraction of its inertia that remains, the pivot over the diagonal entry; not finite if
    /// either is not.
    pub ratio: f64,
}

/// Which arguments a function reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reads {
    /// Parameters.
    pub parameters: bool,
    /// Prepared values.
    pub prepared: bool,
    /// The time.
    pub time: bool,
    /// Coordinates.
    pub coordinates: bool,
    /// Velocities.
    pub velocities: bool,
    /// Inputs.
    pub inputs: bool,
    /// Accelerations.
    pub accelerations: bool,
    /// Results of [`Role::AtTime`].
    pub at_time: bool,
    /// Results of [`Role::AtPosition`].
    pub at_position: bool,
}

impl Program {
    /// The function of a role. It exists for every role, except for outputs and assumptions that
    /// the machine does not have.
    pub fn function(&self, role: Role) -> Option<&Function> {
        match role {
            Role::Prepare => Some(&self.prepare),
            Role::Start => Some(&self.start),
            _ => self.functions.iter().find(|function| function.role == role),
        }
    }

    /// Whether a function of the machine contains a sign, so that a force may jump. Derivatives of a motion across such a jump obey no variational
    /// equations.
    pub fn may_jump(&self) -> bool {
        let mut code = self.functions.iter().flat_map(|function| &function.code);
        code.any(|op| matches!(op, Op::Unary(symbolic::Function::Sign, _)))
    }

    /// Whether the margins of all [`assumptions`](Self::assumptions) are linear in time, coordinates and velocities, and depend on
    /// no other variables.
    pub fn has_linear_assumptions(&self) -> bool {
        let margins =
            (0..self.assumptions.len()).map(|index| self.function(Role::Assumption(index)));
        margins.flatten().all(Function::is_linear)
    }

    /// Whether the machine has work of drives, forces and inputs, and losses in dampers, at any state: a function of them that is not identically 0.
    pub fn has_powers(&self) -> [bool; 2] {
        [Role::WorkRate, Role::DissipationRate].map(|role| {
            let function = self.function(role);
            function.is_some_and(|function| !function.is_zero())
        })
    }

    /// The costs of the functions of [work and losses](Program::has_powers), without those that are 0.
    pub fn costs_of_powers(&self) -> impl Iterator<Item = Cost> {
        let functions = [Role::WorkRate, Role::DissipationRate].into_iter();
        let functions = functions.filter_map(|role| self.function(role));
        functions
            .filter(|function| !function.is_zero())
            .map(Function::cost)
    }

    /// The role of the function that solves the equations of motion: the accelerations or, for a
    /// machine with guided contacts, their dependence on the friction forces.
    pub fn solving(&self) -> Role {
        if self.contacts.is_empty() {
            Role::Accelerations
        } else {
            Role::Friction
        }
    }

    /// Every function: [`prepare`](Program::prepare), [`start`](Program::start), and the rest.
    pub fn all_functions(&self) -> impl Iterator<Item = &Function> {
        [&self.prepare, &self.start]
            .into_iter()
            .chain(&self.functions)
    }

    /// The roles of the functions that compute the accelerations in stages, in their order; none if
    /// the spec does not ask for stages.
    pub fn staged_roles(&self) -> Vec<Role> {
        let Stages { time, coordinates } = self.stages;
        let roles = [
            (time, Role::AtTime),
            (coordinates, Role::AtPosition),
            (time || coordinates, Role::AccelerationsAt),
        ];
        let there = roles.into_iter().filter(|(is_there, _)| *is_there);
        there.map(|(_, role)| role).collect()
    }

    /// Whether the derivatives by all coordinates and all rates exist, in this order and before others.
    pub fn has_linearization(&self) -> bool {
        self.derivatives
            .starts_with(&Variable::of_state(self.dimension()))
    }

    /// The number of coordinates.
    pub fn dimension(&self) -> usize {
        self.coordinates.len()
    }
}

impl Function {
    /// Which arguments it reads.
    pub fn reads(&self) -> Reads {
        let mut reads = Reads::default();
        for op in &self.code {
            let Op::Read(source) = op else { continue };
            *match source {
                Source::Parameter(_) => &mut reads.parameters,
                Source::Prepared(_) => &mut reads.prepared,
                Source::Time => &mut reads.time,
                Source::Coordinate(_) => &mut reads.coordinates,
                Source::Velocity(_) => &mut reads.velocities,
                Source::Input(_) => &mut reads.inputs,
                Source::Acceleration(_) => &mut reads.accelerations,
                Source::AtTime(_) => &mut reads.at_time,
                Source::AtPosition(_) => &mut reads.at_position,
            } = true;
        }
        reads
    }

    /// The operation whose value it is.
    pub fn op(&self, value: Value) -> &Op {
        &self.code[value.index()]
    }

    /// The operation counts of a call.
    pub fn counts(&self) -> Counts {
        Counts::of(self)
    }

    /// Whether all its results are 0, and it always has them.
    pub fn is_zero(&self) -> bool {
        let zero =
            |value: &Value| matches!(self.op(*value), Op::Constant(constant) if constant.is_zero());
        self.guards.is_empty() && self.results.iter().all(zero)
    }

    /// The estimated time of a call.
    pub fn cost(&self) -> Cost {
        Cost::of(self)
    }
}
