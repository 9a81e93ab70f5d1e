//! Straight-line arithmetic: what every way of running a machine starts from.
//!
//! A [`Program`] knows named values with shapes, not mechanics: it says which operations, in which
//! order, turn the arguments of a function into its results. The emitters print it, the
//! [interpreter](Interpreter) runs it over any number, the proof holds it against Lagrange's
//! equations.
//!
//! ```text
//! parameters ─▶ prepare ─▶ prepared values ─┐
//!                          t, q, v, u, a ───┴▶ function ─▶ results
//! ```
//!
//! What holds of every program, and what [`Program::verify`] checks after every pass in debug
//! builds:
//!
//! * code is in static single assignment form: the value of the operation at index k is [`Value`]
//!   k, and the operands of an operation have smaller indices than it;
//! * a function reads no arguments but those in its row of the [table of quantities](quantity);
//! * every operation is used, directly or not, by a result or a guard of its function;
//! * only [`Program::prepare`] and [`Program::start`] read parameters, and they read nothing else;
//!   all other functions read prepared values instead, and contain no operation whose operands are
//!   all known once parameters are;
//! * no two operations of a function do the same thing;
//! * the order of operations is the order of rounding: whoever runs a program reorders nothing, and
//!   joins a multiplication and an addition into one rounding only where [`fused`] says so;
//! * the same description gives the same program.

use lagrangian_symbolic::{self as symbolic, Rational};

use lagrangian_units::{
    Compliance, ImpactLaw, ImpactOrder, Name, Painleve, Stages, Unit, Variable, state_of,
};

pub mod accuracy;
pub mod choose;
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
mod restrict;
pub mod rounding;
pub mod schedule;
pub mod series;
pub mod solve;
pub mod stages;
mod tangent;
mod verify;

pub use choose::{Basis, Candidate, Choice, Form, MOST_ROUNDING, best};
pub use cost::{Cost, cycles};
pub use count::Counts;
pub use fusion::{Contracted, Contraction, Contractions, Side, fused, ready, uses};
pub use interpret::{Arguments, Interpreter};
pub use mutate::{Mutant, mutants};
pub use packs::{Pack, Statement, What, packs};
pub use quantity::Role;
pub use repeats::{Kind, Operand, Repeat, Step, Steps, early_angles};
pub use rounding::Rounding;
pub use schedule::LONGEST_SCHEDULED;
pub use tangent::is_differentiated;

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
    /// The fours of coordinates by which frames are turned, by their indices: only their ratios mean anything, and their length comes
    /// back to 1 by itself.
    pub quaternions: Vec<[usize; 4]>,
    /// Values that the user sets while the machine runs; [`Source::Input`] counts them.
    pub inputs: Vec<Slot>,
    /// Quantities to observe; [`Role::Output`] counts them.
    pub outputs: Vec<Slot>,
    /// Facts that a run checks; [`Role::Assumption`] counts them.
    pub assumptions: Vec<Fact>,
    /// The bilateral constraints; the functions about them are there if these are.
    pub constraints: Vec<Constraint>,
    /// The names of the guided contacts with friction; the functions about them are there if these
    /// are.
    pub contacts: Vec<String>,
    /// How many components their normal reactions have: one in the plane, along the normal; three in space, along the
    /// axes of the ground.
    pub reaction_axes: usize,
    /// Which of the guided contacts are the second tangents of surfaces: bit `k` says that contact `k` is at right angles to contact
    /// `k − 1`, on the same surface.
    pub second_tangents: usize,
    /// The unilateral contacts; the functions about them are there if these are.
    pub unilateral: Vec<Unilateral>,
    /// Which start values stay as they are where the start does not obey the constraints: `theta`,
    /// `der(phi)`.
    pub kept: Vec<String>,
    /// What [`Role::Derivatives`] differentiates by, in the order of its columns; empty where it is
    /// not there.
    pub derivatives: Vec<Variable>,
    /// Which of [`Role::AtTime`] and [`Role::AtPosition`] are there; with either of them there is
    /// [`Role::AccelerationsAt`].
    pub stages: Stages,
    /// Whatever is known once the parameters are: reads parameters, and its results are the
    /// prepared values.
    ///
    /// Its guards are the pivots of the mass matrix that no coordinate changes. Where one fails,
    /// the accelerations do not exist at any state; the other functions do not care.
    pub prepare: Function,
    /// For each prepared value its formula in terms of parameters, as a spec would write it; cut
    /// short (`…`) where long.
    pub prepared: Vec<String>,
    /// Where the coordinates start, and behind them their rates if any of these is not 0: reads
    /// parameters only.
    pub start: Function,
    /// Everything else, in the order of [`Role`].
    pub functions: Vec<Function>,
    /// For each of these that could be made in several ways, which there were, in the order of
    /// [`Role`].
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
    /// Its value where nobody sets it. Coordinates and outputs have none: see [`Program::start`].
    pub default: Option<Default>,
}

impl Slot {
    /// The unit as a label beside its number: as the spec writes it where that is no SI unit.
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

/// A fact that a run checks: the value of its function is positive, or at least not negative.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fact {
    /// As the spec writes it: `s1 > 0`.
    pub text: String,
    /// Whether 0 breaks it.
    pub strict: bool,
}

/// A bilateral constraint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Constraint {
    /// Its name; the two of circles that roll are `wheel.gap` and `wheel.slip`.
    pub name: String,
    /// The unit of what is to be zero; of its rate, where that is all there is.
    pub unit: String,
    /// The unit of its multiplier.
    pub multiplier_unit: String,
    /// Whether it constrains positions, not velocities alone.
    pub holonomic: bool,
}

/// A unilateral contact.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unilateral {
    /// Its name.
    pub name: String,
    /// How it bounces, if it does.
    pub law: ImpactLaw,
    /// Whether with the others or one after the other.
    pub order: ImpactOrder,
    /// What becomes of it where its friction leaves no motion.
    pub painleve: Painleve,
    /// By which law it presses, if it yields.
    pub compliance: Option<Compliance>,
    /// Whether there is friction.
    pub rubs: bool,
    /// Whether it is the rolling of the contact before it, on which it leans: it has the gap and the normal force of that
    /// contact, its slip is how fast one body turns relative to the other, in rad/s, its friction the torque that resists
    /// this, in N m, and its coefficient of friction a length, in m.
    pub rolls: bool,
    /// Whether it is the second tangent of the contact before it, in space: it has the gap, the normal and the coefficients of
    /// that contact, and a slip and a friction of its own. Of both together friction is no more than `μ` times the normal force.
    pub across: bool,
    /// Whether it is a corner on a face of a polygon, which has ends: [`Role::ContactFaces`] says where.
    pub faced: bool,
}

/// How the results of [`Role::Friction`] are arranged.
///
/// Everything is linear in the friction forces `F`: `x = x₀ + Σ Fₖ xₖ`. First comes what there is without
/// friction, then what one unit of each does. A part holds the accelerations, the multipliers of
/// constraints, `dw/dt` of each contact and the components of the normal reaction `N` of each; behind all parts stand `μ`
/// of each contact and `μ₀` of each. In space there follows for each contact the direction by which the part of `N` is told that
/// presses: the tangent of a curve, along which nothing presses, or the normal of a surface, along which all does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrictionLayout {
    /// How many coordinates there are.
    pub coordinates: usize,
    /// How many constraints.
    pub constraints: usize,
    /// How many contacts.
    pub contacts: usize,
    /// How many components a normal reaction has.
    pub axes: usize,
}

impl FrictionLayout {
    /// The length of a part.
    pub fn part(self) -> usize {
        self.coordinates + self.constraints + (1 + self.axes) * self.contacts
    }

    /// How many results there are.
    pub fn len(self) -> usize {
        self.directions()
            + if self.axes == 1 {
                0
            } else {
                self.axes * self.contacts
            }
    }

    /// Where the directions stand, in space.
    pub fn directions(self) -> usize {
        (1 + self.contacts) * self.part() + 2 * self.contacts
    }

    /// Whether there are none.
    pub fn is_empty(self) -> bool {
        self.len() == 0
    }
}

/// How the results of a function are arranged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One number.
    Scalar,
    /// So many numbers.
    Vector(usize),
    /// A symmetric matrix of that order, its lower triangle row by row: entry (i, j), j ≤ i, is
    /// result i (i + 1)/2 + j.
    Symmetric(usize),
    /// A matrix of so many rows and columns, row by row.
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
    /// The results, [`Shape::len`] many.
    pub results: Vec<Value>,
    /// What must hold for the results to mean anything, in the order in which it is to be reported.
    pub guards: Vec<Guard>,
}

impl Function {
    /// Whether the results are linear in time, coordinates and velocities, and depend on nothing else that changes.
    fn is_linear(&self) -> bool {
        // Of each operation the degree; 2 and above, or none, are 2.
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
    /// What rounding took from a·b: 0 but for rounding.
    ProductError(Value, Value),
    /// What rounding took from a + b: 0 but for rounding.
    SumError(Value, Value),
    /// sin a. Where `Cos` of the same value occurs too, both are to be computed together.
    Sin(Value),
    /// cos a.
    Cos(Value),
    /// A function of one argument, other than sine and cosine.
    Unary(symbolic::Function, Value),
    /// A function of two arguments.
    Binary(symbolic::Function, Value, Value),
}

impl Op {
    /// The operands, none to two.
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

    /// This operation on other operands: each is what `moved` makes of it.
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

/// Where an argument comes from.
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
/// It is one of the mass matrix, or of G M⁻¹ Gᵀ where there are constraints.
///
/// Written so that a pivot that is no number fails too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guard {
    /// The pivot dᵢ of M = L D Lᵀ.
    pub pivot: Value,
    /// The diagonal entry Mᵢᵢ that it was left over from; the pivot itself where nothing was taken
    /// off, or where Mᵢᵢ is not at hand: then it must be positive, no more.
    pub scale: Value,
    /// The share of the entry that may be rounding error.
    pub tolerance: f64,
    /// The index i of the coordinate; behind all coordinates that of a constraint.
    pub coordinate: usize,
}

/// The machine has no accelerations here: its mass matrix is singular to working precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Singular {
    /// The index of the coordinate whose effective inertia vanishes; behind all coordinates that of
    /// a constraint which says nothing that those before it do not say.
    pub coordinate: usize,
    /// The share of its inertia that remains: pivot over diagonal entry; not
    /// finite where either is not.
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
    /// The function of a role. There is one for every role but outputs and assumptions that the
    /// machine does not have.
    pub fn function(&self, role: Role) -> Option<&Function> {
        match role {
            Role::Prepare => Some(&self.prepare),
            Role::Start => Some(&self.start),
            _ => self.functions.iter().find(|function| function.role == role),
        }
    }

    /// Whether the margins of all [`assumptions`](Self::assumptions) are linear in time, coordinates and velocities, and depend on
    /// nothing else that changes.
    pub fn has_linear_assumptions(&self) -> bool {
        let margins =
            (0..self.assumptions.len()).map(|index| self.function(Role::Assumption(index)));
        margins.flatten().all(Function::is_linear)
    }

    /// The role of the function that solves the equations of motion: the accelerations, or what they
    /// are made of where contacts stick and slide.
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
    /// nobody asks for it.
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

    /// Whether the derivatives by all coordinates and all rates are there, in this order and first.
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

    /// How much work a call is.
    pub fn counts(&self) -> Counts {
        Counts::of(self)
    }

    /// How long a call takes.
    pub fn cost(&self) -> Cost {
        Cost::of(self)
    }
}
