//! Proves every program before it is emitted or run.
//!
//! A [`Program`] becomes [`Proved`] by comparison with Lagrange's equations of its own machine,
//! evaluated literally ([`literal`](crate::equations::literal)); emitters and interpreted machines
//! accept only proved programs. The comparison covers:
//!
//! * energies, `M`, `h`, `Q`, `f`, the power of drives and dampers, outputs, assumptions and
//!   the start;
//! * residual, rate, row and bias of each constraint; slip, row and bias of each guide;
//! * accelerations, multipliers, and their dependence on friction forces, by substitution into
//!   `M a = f + Gᵀλ + Σ τᵀF`, `G a = γ` and the equations of the displacements that would open
//!   the guides;
//! * derivatives, by running the accelerations over dual numbers;
//! * accelerations in stages, and the guarded pivots.
//!
//! # Number types
//!
//! The comparison is made first in a prime field ([`Residue`]), at [`POINTS`] random points. There
//! nothing is rounded: equal values are identical, and different ones agree with a probability of
//! about the degree of their difference over 2⁶¹, or over 2⁴⁸ if it is a difference in angles (J. T.
//! Schwartz, J. ACM 27 (1980) 701–717; R. Zippel, EUROSAM 1979). Rows of matrices and vectors are
//! compared all at once, multiplied by a random vector, which leaves the same probability; if that
//! fails they are compared one by one, to say which is wrong.
//!
//! A field has no order, and no real powers and logarithms. A second comparison is therefore made if
//! a machine has any function but sine and cosine, or guides, whose reactions have a side; if the
//! field has no point at which all roots exist; or if the field reports a difference. It is made in
//! double-doubles that carry a bound of their own error ([`Ball`]), at [`STATES`] random states of
//! the machine. It detects differences with certainty, and it decides: values that are equal in 32
//! digits, up to the bound, at all of these states count as equal, since the field may not obey a
//! law of powers or of roots that was used.
//!
//! Points and states are the same in every run, so the same text has the same verdict. A failure
//! reports the number of the point, which is its seed.

pub(crate) mod derived;
pub(crate) mod number;
pub mod symbolic;

use std::collections::BTreeSet;
use std::fmt;
use std::ops::Deref;

use lagrangian_scalar::{Ball, Dual, Residue, Scalar};
use lagrangian_symbolic::{Expr, Function as Call, Node, reachable};

use crate::equations::guide::{guides_of, occurs_in_equation};
use crate::equations::literal::{Lagrange, Literal, LiteralSliding, State};
use crate::proof::symbolic::{determinant, guarded_coordinates, with_guarded_values};
use crate::{Dependent, Equations};
use crate::{Disagreement, POINTS};
use lagrangian_program::quantity::{Entry, Kind, Use};
use lagrangian_program::{
    Arguments, FrictionLayout, FrictionResponse, Interpreter, Program, Role, Shape,
};
use lagrangian_spec::diagnostic::{Code, Diagnostic};
use lagrangian_spec::model::{Model, Space, Variable};
use number::{Number, ZeroTest};

/// The number of states at which programs are compared in double-doubles.
pub const STATES: usize = 4;

/// The largest number of states to try.
const MOST_STATES: u64 = 96;

/// The largest number of points of the field to try. A root needs a point where its argument is a
/// square, which holds with probability ½; a machine with more than ten roots is compared at states.
const MOST_POINTS: u64 = 4096;

/// The largest number of expression values that the search for a point may compute.
const MOST_VALUES: u64 = 4_000_000;

/// The number of comparisons allowed for each one that must be conclusive. A comparison may be inconclusive if
/// a pivot or a value is undefined that the search for a point did not examine.
const COMPARISONS: u64 = 8;

/// Further comparisons are allowed until they have computed this many values. So a proof costs at most
/// [`COMPARISONS`] times one that succeeds at once, or a second.
const MOST_COMPARED: u64 = 40_000_000;

/// A program that was proved to compute what Lagrange's equations of its machine say; see the [module](self).
#[derive(Clone, Debug, PartialEq)]
pub struct Proved(Program);

impl Proved {
    /// Proves a program.
    ///
    /// # Errors
    /// The first disagreement, or that the comparison is inconclusive.
    pub fn new<'d>(
        program: Program,
        model: &Model<'d>,
        equations: &Equations<'d>,
    ) -> Result<Proved, Unproved> {
        match validate(&program, model, equations) {
            Ok(()) => Ok(Proved(program)),
            Err((disagreement, witness)) => Err(Unproved {
                description: subject_text(&disagreement, &program),
                disagreement,
                witness,
            }),
        }
    }

    /// This program with some of its functions, as [`Program::restricted`]; proved to give the same values as here.
    ///
    /// # Errors
    /// If it gives other values.
    pub fn restricted(&self, roles: &[Role]) -> Result<Proved, Unproved> {
        let part = self.0.restricted(roles);
        for &role in roles {
            if let Err(disagreement) = same_results(&self.0, &part, role) {
                return Err(Unproved {
                    description: subject_text(&disagreement, &self.0),
                    disagreement,
                    witness: Witness::Field,
                });
            }
        }
        Ok(Proved(part))
    }

    /// The program itself.
    pub fn into_program(self) -> Program {
        self.0
    }
}

impl Deref for Proved {
    type Target = Program;
    fn deref(&self) -> &Program {
        &self.0
    }
}

/// The program's listing.
impl fmt::Display for Proved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// Why a program is not emitted.
#[derive(Clone, Debug, PartialEq)]
pub struct Unproved {
    /// What is wrong.
    pub disagreement: Disagreement,
    /// Where it was seen.
    pub witness: Witness,
    /// What is wrong, in the names of the spec.
    description: String,
}

/// The numbers in which a program was found wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Witness {
    /// The numbers of the prime field.
    Field,
    /// Double-doubles with a bound of their error.
    States,
}

impl Unproved {
    /// The message for the user, at the name of the machine.
    pub fn diagnostic(&self, model: &Model<'_>) -> Diagnostic {
        match self.disagreement {
            Disagreement::Undefined => Diagnostic::new(
                Code::Undefined,
                model.span,
                "no state was found at which the equations of motion have a value",
            )
            .help("something divides by zero, or takes a root or a logarithm that does not exist; if there are such states, give the coordinates start values near one of them"),
            Disagreement::Exhausted { comparisons } => Diagnostic::new(
                Code::TooLarge,
                model.span,
                format!("this machine could not be proved: {comparisons} states were compared, and too few of them have accelerations"),
            )
            .help("the size of its equations limits the number of states that are compared; if it is singular at most states, state what holds it, or make it smaller"),
            _ => Diagnostic::new(Code::Internal, model.span, self.to_string()).help(
                "this is a defect of lagrangian, not of the spec: nothing was emitted; please report it together with the spec",
            ),
        }
    }
}

impl fmt::Display for Unproved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let witness = match self.witness {
            Witness::Field => "point",
            Witness::States => "state",
        };
        let seed = match self.disagreement {
            Disagreement::Result { point, .. }
            | Disagreement::Motion { point, .. }
            | Disagreement::Constraint { point, .. }
            | Disagreement::Reaction { point, .. }
            | Disagreement::Eliminated { point, .. }
            | Disagreement::Pivots { point } => format!(" (random {witness} {point})"),
            Disagreement::Singular(_)
            | Disagreement::Undefined
            | Disagreement::NotCompared { .. }
            | Disagreement::Exhausted { .. } => String::new(),
        };
        write!(
            f,
            "the program generated for this machine is wrong: {} what Lagrange's equations say{seed}",
            self.description
        )
    }
}

impl std::error::Error for Unproved {}

/// The subject of the sentence that a message completes with what Lagrange's equations say.
fn subject_text(disagreement: &Disagreement, program: &Program) -> String {
    let member = |(kind, index): (Kind, usize)| {
        let name = program.member((kind, index));
        match kind {
            Kind::Coordinate => format!("`{name}`"),
            Kind::Constraint => format!("the constraint `{name}`"),
            Kind::Contact => format!("the guide `{name}`"),
            Kind::Unilateral | Kind::Face | Kind::Direction | Kind::Coefficient => {
                format!("the contact `{name}`")
            }
        }
    };
    let coordinate = |i: usize| member((Kind::Coordinate, i));
    let constraint = |k: usize| member((Kind::Constraint, k));
    let contact = |k: usize| member((Kind::Contact, k));
    match *disagreement {
        Disagreement::Result { role, index, .. } => {
            let of = match program.entry(role, index) {
                Entry::Whole => match role {
                    Role::Output(_) | Role::Assumption(_) => {
                        format!(" (`{}`)", program.title(role))
                    }
                    _ => String::new(),
                },
                Entry::Of(Kind::Coordinate, i) => format!(", in {},", coordinate(i)),
                Entry::Of(kind, i) => format!(", of {},", member((kind, i))),
                Entry::At(row @ (Kind::Coordinate, _), column) => {
                    format!(", in {} and {},", member(row), member(column))
                }
                Entry::At(row, column) => {
                    format!(", of {} by {},", member(row), member(column))
                }
                Entry::Rate(i) => format!(", the rate of {},", coordinate(i)),
                Entry::Derivative(i, variable) => {
                    let by = program.variable_name(variable);
                    format!(", in {}, by `{by}`,", coordinate(i))
                }
                Entry::Index(index) => format!(", result {index},"),
            };
            format!("`{}`{of} is not", role.name())
        }
        Disagreement::Motion { coordinate: i, .. } => format!(
            "`{}` violates the equation of motion of {}, contrary to",
            program.solving().name(),
            coordinate(i)
        ),
        Disagreement::Constraint { constraint: k, .. } => format!(
            "`{}` violates {}, contrary to",
            program.solving().name(),
            constraint(k)
        ),
        Disagreement::Reaction { contact: k, .. } => {
            format!("the normal reaction of {} is not", contact(k))
        }
        Disagreement::Eliminated {
            coordinate: i,
            constraint: k,
            ..
        } => format!(
            "{} was taken to settle {}, which is not",
            constraint(k),
            coordinate(i)
        ),
        Disagreement::Pivots { .. } => "the guard of the elimination is not".into(),
        Disagreement::Singular(singular) => format!(
            "the elimination stops at {}, contrary to",
            coordinate(singular.coordinate)
        ),
        Disagreement::NotCompared { role } => format!("nothing compares `{}` with", role.name()),
        Disagreement::Undefined | Disagreement::Exhausted { .. } => {
            "no state was found to compare it with".into()
        }
    }
}

/// Compares a program with the equations of its machine.
fn validate<'d>(
    program: &Program,
    model: &Model<'d>,
    equations: &Equations<'d>,
) -> Result<(), (Disagreement, Witness)> {
    let holonomic = |k: usize| program.constraints.get(k).is_some_and(|c| c.holonomic);
    let machine = Lagrange::of(model, holonomic);
    let nodes = reachable(model.dag, &machine.roots);
    let most = MOST_VALUES / (nodes.len() as u64).max(1);
    let most = most.clamp(MOST_STATES, MOST_POINTS);
    let smooth = nodes.iter().all(|&id| match model.dag.node(id) {
        Node::Function(call, _) => matches!(call, Call::Sin | Call::Cos),
        _ => true,
    });
    let settled = eliminated_coordinates(program, equations);
    let relaxed = model.relaxed.as_deref();
    let relaxed = relaxed.map(|relaxed| Lagrange::of(relaxed, holonomic));
    let parts = ProofInput {
        program,
        machine: &machine,
        relaxed: relaxed.as_ref(),
        eliminated: settled,
    };
    let work = work(program, nodes.len());
    let in_field = Prover::<Residue>::new(parts).run(POINTS, most, work);
    if in_field == ComparisonResult::Equal && smooth && model.sliding().is_empty() {
        return Ok(());
    }
    let at_states = Prover::<Ball>::new(parts).run(STATES, MOST_STATES, work);
    decide(in_field, at_states)
}

/// What both comparisons tell, in the prime field and at states in numbers with error bounds, where the field does not decide alone.
fn decide(
    in_field: ComparisonResult,
    at_states: ComparisonResult,
) -> Result<(), (Disagreement, Witness)> {
    match (in_field, at_states) {
        (
            ComparisonResult::Equal
            | ComparisonResult::Inconclusive
            | ComparisonResult::Exhausted(_),
            ComparisonResult::Wrong(wrong),
        ) => Err((wrong, Witness::States)),
        (_, ComparisonResult::Equal) | (ComparisonResult::Equal, _) => Ok(()),
        (ComparisonResult::Wrong(wrong), _) => Err((wrong, Witness::Field)),
        (ComparisonResult::Exhausted(comparisons), _)
        | (_, ComparisonResult::Exhausted(comparisons)) => {
            Err((Disagreement::Exhausted { comparisons }, Witness::States))
        }
        (_, _) => Err((Disagreement::Undefined, Witness::States)),
    }
}

/// The arguments whose side of 0 is asked for by functions in the equations.
fn branch_arguments<'d>(machine: &Lagrange<'_, 'd>) -> Vec<(Expr<'d>, [bool; 2])> {
    let dag = machine.model.dag;
    let nodes = reachable(dag, &machine.roots).into_iter();
    let arguments = nodes.filter_map(|id| match dag.node(id) {
        Node::Function(Call::Abs | Call::Sign, arguments) => {
            arguments.first().map(|&id| dag.expr(id))
        }
        Node::Function(Call::Min | Call::Max, arguments) => match arguments[..] {
            [a, b] => Some(dag.expr(a) - dag.expr(b)),
            _ => None,
        },
        _ => None,
    });
    arguments.map(|argument| (argument, [false; 2])).collect()
}

/// The approximate number of values that one comparison computes, for a machine of `nodes` nodes:
/// each has three infinitesimals, so it is eight numbers.
fn work(program: &Program, nodes: usize) -> u64 {
    let code = |function: &lagrangian_program::Function| function.code.len() as u64;
    let functions: u64 = program.functions.iter().map(code).sum();
    let slopes = if program.derivatives.is_empty() {
        0
    } else {
        program.function(Role::Accelerations).map_or(0, code)
    };
    8 * nodes as u64 + functions + 2 * slopes
}

/// The coordinates that the accelerations do not read, since constraints determine them.
fn eliminated_coordinates<'a, 'd>(
    program: &Program,
    equations: &'a Equations<'d>,
) -> &'a [Dependent<'d>] {
    let choice = program.choice(program.solving());
    let is_reduced = choice.is_none_or(|choice| choice.chosen().form.reduced);
    match &equations.reduction {
        Some(reduction) if is_reduced => &reduction.dependents,
        _ => &[],
    }
}

/// The inputs of a prover.
#[derive(Clone, Copy)]
struct ProofInput<'a, 'd> {
    program: &'a Program,
    machine: &'a Lagrange<'a, 'd>,
    relaxed: Option<&'a Lagrange<'a, 'd>>,
    eliminated: &'a [Dependent<'d>],
}

/// The result of a comparison.
#[derive(Clone, Debug, PartialEq)]
enum ComparisonResult {
    Equal,
    Wrong(Disagreement),
    /// There are too few points at which everything has a value.
    Inconclusive,
    /// As [`ComparisonResult::Inconclusive`], after this number of comparisons, the most that are allowed.
    Exhausted(u64),
}

/// Why a comparison is inconclusive or has failed.
enum Verdict {
    Undefined,
    Wrong(Disagreement),
}

impl From<Disagreement> for Verdict {
    fn from(disagreement: Disagreement) -> Verdict {
        Verdict::Wrong(disagreement)
    }
}

/// A sum, with the magnitude of its terms.
#[derive(Clone, Copy)]
struct Sum<R> {
    value: R,
    size: f64,
}

impl<R: Number> Sum<R> {
    fn new() -> Sum<R> {
        Sum {
            value: R::ZERO,
            size: 0.0,
        }
    }

    fn of(terms: impl IntoIterator<Item = R>) -> Sum<R> {
        terms.into_iter().fold(Sum::new(), Sum::plus)
    }

    fn products(a: &[R], b: &[R]) -> Sum<R> {
        Sum::of(a.iter().zip(b).map(|(&a, &b)| a * b))
    }

    fn plus(self, term: R) -> Sum<R> {
        Sum {
            value: self.value + term,
            size: self.size + term.size(),
        }
    }

    /// Whether it is 0.
    fn vanishes(self) -> Result<bool, Verdict> {
        match self.value.test_zero(self.size) {
            ZeroTest::Zero => Ok(true),
            ZeroTest::NotZero => Ok(false),
            ZeroTest::Undecided => Err(Verdict::Undefined),
        }
    }
}

fn equal<R: Number>(a: R, b: R) -> Result<bool, Verdict> {
    Sum::of([a, -b]).vanishes()
}

/// Row `i` of a symmetric matrix that is given by its lower triangle.
fn row<R: Copy>(lower: &[R], n: usize, i: usize) -> impl Iterator<Item = R> {
    (0..n).map(move |j| lower[Shape::index(i, j)])
}

/// The results of the functions of a program at a state.
struct Computed<R> {
    mass_matrix: Vec<R>,
    bias: Vec<R>,
    applied: Vec<R>,
    forces: Vec<R>,
    rows: Vec<R>,
    constraint_bias: Vec<R>,
}

/// Runs a program in one kind of numbers and compares it.
struct Prover<'a, 'd, R> {
    parts: ProofInput<'a, 'd>,
    interpreter: Interpreter<R>,
    /// Runs the accelerations for the values of their guards.
    guards: Interpreter<R>,
    /// The accelerations over dual numbers, where derivatives are to be compared.
    derivatives: Option<Interpreter<Dual<R>>>,
    number: u64,
    /// The number of comparisons that were begun.
    comparisons: u64,
    /// For each output whether it has had a value.
    has_had_value: Vec<bool>,
    /// Whether each output has lacked a value where the equations give it one.
    has_lacked_value: Vec<bool>,
    /// The functions that were compared.
    compared: BTreeSet<Role>,
    /// Whether accelerations existed at any point.
    has_had_accelerations: bool,
    /// Arguments whose side of 0 the equations ask for, and whether each has been below and above it at a point where all was
    /// equal. A program that is right only on one side agrees at any number of states on that side.
    sides: Vec<(Expr<'d>, [bool; 2])>,
}

impl<'a, 'd, R: Number> Prover<'a, 'd, R> {
    fn new(parts: ProofInput<'a, 'd>) -> Prover<'a, 'd, R> {
        let program = parts.program;
        let parameters = vec![R::ONE; program.parameters.len()];
        let slopes = (!program.derivatives.is_empty()).then(|| {
            let parameters = vec![Dual::<R>::ONE; program.parameters.len()];
            Interpreter::new(&program.restricted(&[Role::Accelerations]), &parameters)
        });
        Prover {
            interpreter: Interpreter::new(program, &parameters),
            guards: Interpreter::new(&with_guarded_values(program), &parameters),
            derivatives: slopes,
            number: 0,
            comparisons: 0,
            has_had_value: vec![false; program.outputs.len()],
            has_lacked_value: vec![false; program.outputs.len()],
            compared: BTreeSet::new(),
            has_had_accelerations: false,
            sides: if R::IS_ORDERED {
                branch_arguments(parts.machine)
            } else {
                Vec::new()
            },
            parts,
        }
    }

    /// Compares at `points` points out of at most `most`; each comparison costs about `work`.
    fn run(mut self, points: usize, most: u64, work: u64) -> ComparisonResult {
        let allowed = COMPARISONS * points as u64 + MOST_COMPARED / work.max(1);
        let mut good = 0;
        for number in 0..most {
            if self.comparisons >= allowed && good < points {
                return ComparisonResult::Exhausted(self.comparisons);
            }
            self.number = number;
            match self.check() {
                Ok(()) => good += 1,
                Err(Verdict::Undefined) => {}
                Err(Verdict::Wrong(disagreement)) => return ComparisonResult::Wrong(disagreement),
            }
            // An output or a side that hardly ever occurs is not waited for indefinitely.
            let has_seen = self.has_had_value.iter().all(|seen| *seen)
                && self.sides.iter().all(|(_, sides)| *sides == [true; 2]);
            let has_seen = has_seen || good >= 4 * points;
            if good >= points && has_seen {
                return self.covered();
            }
        }
        if good >= points {
            self.covered()
        } else {
            ComparisonResult::Inconclusive
        }
    }

    /// Whether every function of the program was compared: a quantity that the proof does not know is not
    /// proved. If there are no accelerations, functions that are compared with them are exempt.
    ///
    /// An output that has no value at any point, although the equations give it one, was not compared either: √(y² − x²) in place
    /// of √(y² + x²) has none at half of all points.
    fn covered(&self) -> ComparisonResult {
        let mut values = self.has_had_value.iter().zip(&self.has_lacked_value);
        if let Some(output) = values.position(|(had, lacked)| *lacked && !had) {
            let role = Role::Output(output);
            return ComparisonResult::Wrong(Disagreement::NotCompared { role });
        }
        let is_covered = |role: Role| {
            self.compared.contains(&role)
                || (role.row().called != Use::Seldom && !self.has_had_accelerations)
        };
        let functions = self.parts.program.functions.iter();
        match functions.map(|f| f.role).find(|role| !is_covered(*role)) {
            Some(role) => ComparisonResult::Wrong(Disagreement::NotCompared { role }),
            None => ComparisonResult::Equal,
        }
    }

    fn check(&mut self) -> Result<(), Verdict> {
        let machine = self.parts.machine;
        let model = machine.model;
        let state = R::state(self.number, machine);
        // Most points without roots are rejected here, at little cost.
        let facts: Vec<Expr<'d>> = model.assumptions.iter().map(|fact| fact.excess).collect();
        let facts = machine.values(&facts, &state);
        let here = machine.values(&machine.roots, &state);
        if !here.iter().all(|x| x.is_finite()) {
            return Err(Verdict::Undefined);
        }
        self.comparisons += 1;
        self.interpreter.prepare(&state.parameters);
        self.guards.prepare(&state.parameters);
        let are_facts = facts.iter().all(|x| x.is_positive());
        let arguments: Vec<Expr<'d>> = self.sides.iter().map(|(argument, _)| *argument).collect();
        let values = machine.values(&arguments, &state);
        let compared = self.compare_at(state, &facts);
        if compared.is_ok() {
            for ((_, sides), argument) in self.sides.iter_mut().zip(values) {
                sides[0] |= (-argument).is_positive();
                sides[1] |= argument.is_positive();
            }
        }
        match compared {
            // Where the assumptions of the spec do not hold, agreement counts and a difference does not.
            Err(Verdict::Wrong(_)) if !are_facts => Err(Verdict::Undefined),
            result => result,
        }
    }

    fn compare_at(&mut self, state: State<R>, facts: &[R]) -> Result<(), Verdict> {
        let machine = self.parts.machine;
        let n = machine.model.coordinates.len();
        let w = self.random_numbers(1, n);
        let literal = machine.at(&state, &w);
        let computed = self.computed(&state)?;
        self.check_dynamics(&state, &w, &literal, &computed)?;
        self.check_constraints(&state, &w, &literal, &computed)?;
        self.check_power(&state, &literal, &computed)?;
        let signs = self.check_slips(&state, &w, &literal)?;
        self.check_unilateral(&state, &w, &literal)?;
        self.check_outputs_and_start(&state, facts)?;

        let (state, computed) = if self.parts.eliminated.is_empty() {
            (state, computed)
        } else {
            let state = self.satisfy_constraints(state)?;
            let computed = self.computed(&state)?;
            (state, computed)
        };
        if self.has_no_accelerations(&state, &computed)? {
            return Ok(());
        }
        self.has_had_accelerations = true;
        self.check_pivots(&state, &computed)?;
        if literal.sliding.is_empty() {
            self.check_motion(&state, &computed)?
        } else {
            self.check_friction(&state, &computed, &signs)?
        }
        self.check_derivatives(&state)?;
        self.check_stages(&state, &computed)
    }

    /// Random numbers for this point; those of different kinds are independent.
    fn random_numbers(&self, kind: u64, len: usize) -> Vec<R> {
        let one = |i: usize| R::random(self.number, (kind << 32) + 1 + i as u64);
        (0..len).map(one).collect()
    }

    fn disagreement_at(&self, role: Role, index: usize) -> Verdict {
        let point = self.number;
        Disagreement::Result { role, index, point }.into()
    }

    /// Compares a result.
    fn compare(&self, role: Role, index: usize, found: R, expected: R) -> Result<(), Verdict> {
        self.compare_difference(role, index, Sum::of([found, -expected]))
    }

    /// Compares a result, given its difference from the expected value.
    fn compare_difference(
        &self,
        role: Role,
        index: usize,
        difference: Sum<R>,
    ) -> Result<(), Verdict> {
        if !difference.value.is_finite() {
            return Err(Verdict::Undefined);
        }
        if difference.vanishes()? {
            Ok(())
        } else {
            Err(self.disagreement_at(role, index))
        }
    }

    /// The results of a function, which may be undefined.
    fn try_call(interpreter: &mut Interpreter<R>, role: Role, at: &State<R>, len: usize) -> Vec<R> {
        let arguments = Arguments {
            t: at.t,
            q: &at.q,
            v: &at.v,
            u: &at.u,
            a: &at.a,
        };
        let mut results = vec![R::ZERO; len];
        match interpreter.call(role, arguments, &mut results) {
            Ok(()) => results,
            Err(_) => vec![R::ONE / R::ZERO; len],
        }
    }

    /// The results of a function; an error if they are undefined.
    fn call(&mut self, role: Role, at: &State<R>, len: usize) -> Result<Vec<R>, Verdict> {
        let results = Self::try_call(&mut self.interpreter, role, at, len);
        self.compared.insert(role);
        if results.iter().all(|x| x.is_finite()) {
            Ok(results)
        } else {
            Err(Verdict::Undefined)
        }
    }

    fn computed(&mut self, at: &State<R>) -> Result<Computed<R>, Verdict> {
        let n = at.q.len();
        let m = self.parts.program.constraints.len();
        Ok(Computed {
            mass_matrix: self.call(Role::MassMatrix, at, Shape::Symmetric(n).len())?,
            bias: self.call(Role::Bias, at, n)?,
            applied: self.call(Role::Applied, at, n)?,
            forces: self.call(Role::Forces, at, n)?,
            rows: self.call(Role::ConstraintMatrix, at, n * m)?,
            constraint_bias: self.call(Role::ConstraintBias, at, m)?,
        })
    }

    /// Compares energies, `M`, `h`, `Q` and `f`.
    fn check_dynamics(
        &mut self,
        at: &State<R>,
        w: &[R],
        literal: &Literal<R>,
        computed: &Computed<R>,
    ) -> Result<(), Verdict> {
        let n = w.len();
        for (role, expected) in [
            (Role::KineticEnergy, literal.kinetic_energy),
            (Role::PotentialEnergy, literal.potential_energy),
            (Role::Dissipation, literal.dissipation),
        ] {
            let found = self.call(role, at, 1)?[0];
            self.compare(role, 0, found, expected)?;
        }
        if self
            .parts
            .machine
            .model
            .energies_of_states()
            .next()
            .is_some()
        {
            let found = self.call(Role::StateEnergy, at, 1)?[0];
            self.compare(Role::StateEnergy, 0, found, literal.state_energy)?;
        }
        let mut inertia = Sum::products(w, &computed.bias);
        for (i, &w) in w.iter().enumerate() {
            let along = row(&computed.mass_matrix, n, i).zip(&at.a);
            for (m, &a) in along {
                inertia = inertia.plus(w * m * a);
            }
        }
        if !literal.inertia.is_finite() || !literal.applied.is_finite() {
            return Err(Verdict::Undefined);
        }
        if !inertia.plus(-literal.inertia).vanishes()? {
            return Err(self.wrong_inertia(at, computed));
        }
        let applied = Sum::products(w, &computed.applied);
        if !applied.plus(-literal.applied).vanishes()? {
            let at_row = |i: usize| (computed.applied[i], self.literal(at, i).applied);
            return Err(self.disagreement_at(Role::Applied, first_difference(n, at_row)));
        }
        for i in 0..n {
            let sum = Sum::of([computed.forces[i], -computed.applied[i], computed.bias[i]]);
            self.compare_difference(Role::Forces, i, sum)?;
        }
        Ok(())
    }

    /// The literal equations for one coordinate.
    fn literal(&self, at: &State<R>, i: usize) -> Literal<R> {
        let mut w = vec![R::ZERO; at.q.len()];
        w[i] = R::ONE;
        self.parts.machine.at(at, &w)
    }

    /// Finds the wrong entry of `M` or `h`.
    fn wrong_inertia(&self, at: &State<R>, computed: &Computed<R>) -> Verdict {
        let n = at.q.len();
        let coasting = State {
            a: vec![R::ZERO; n],
            ..at.clone()
        };
        let biases: Vec<R> = (0..n).map(|i| self.literal(&coasting, i).inertia).collect();
        let differs = |(a, b): (&R, &R)| matches!(equal(*a, *b), Ok(false));
        if let Some(i) = biases.iter().zip(&computed.bias).position(differs) {
            return self.disagreement_at(Role::Bias, i);
        }
        for (i, &bias) in biases.iter().enumerate() {
            let found = Sum::of(
                row(&computed.mass_matrix, n, i)
                    .zip(&at.a)
                    .map(|(m, &a)| m * a),
            );
            let expected = self.literal(at, i).inertia - bias;
            if matches!(found.plus(-expected).vanishes(), Ok(false)) {
                let entry = |j: usize| {
                    let mut one = coasting.clone();
                    one.a[j] = R::ONE;
                    let found = computed.mass_matrix[Shape::index(i, j)];
                    (found, self.literal(&one, i).inertia - bias)
                };
                let j = first_difference(n, entry);
                return self.disagreement_at(Role::MassMatrix, Shape::index(i, j));
            }
        }
        self.disagreement_at(Role::MassMatrix, 0)
    }

    /// Compares the power of drives and dampers by the balance of energy, which holds for any
    /// accelerations: `d(T + V + E)/dt = P − R + v·(M a − f)`. If constraints are rheonomic, their
    /// power is in `P` and the last term is absent.
    fn check_power(
        &mut self,
        at: &State<R>,
        literal: &Literal<R>,
        computed: &Computed<R>,
    ) -> Result<(), Verdict> {
        let model = self.parts.machine.model;
        let n = at.q.len();
        let damped = model.dissipated().next().is_some();
        let lost = if damped {
            self.parts.machine.damping(at, &at.v)
        } else {
            R::ZERO
        };
        let lost = lost + literal.power_loss;
        let found = self.call(Role::DissipationRate, at, 1)?[0];
        self.compare(Role::DissipationRate, 0, found, lost)?;
        let power = self.call(Role::WorkRate, at, 1)?[0];
        let with_constraints = Sum::of([power, -literal.energy_rate, -lost]);
        // The lengths of quaternions are excluded from the balance.
        let mut without = with_constraints.plus(-literal.length_power);
        // The row of a state is not a balance of forces.
        for i in (0..n).filter(|&i| model.coordinates[i].rate.is_none()) {
            without = without.plus(-(at.v[i] * computed.forces[i]));
            for (m, &a) in row(&computed.mass_matrix, n, i).zip(&at.a) {
                without = without.plus(at.v[i] * m * a);
            }
        }
        let mut moves = false;
        for (constraint, row) in literal
            .constraints
            .iter()
            .zip(computed.rows.chunks(n.max(1)))
        {
            let at_rest = Sum::products(row, &at.v).plus(-constraint.rate);
            moves |= !at_rest.vanishes()?;
        }
        let is_balanced = (!moves && without.vanishes()?) || with_constraints.vanishes()?;
        if is_balanced {
            Ok(())
        } else {
            Err(self.disagreement_at(Role::WorkRate, 0))
        }
    }

    fn check_constraints(
        &mut self,
        at: &State<R>,
        w: &[R],
        literal: &Literal<R>,
        computed: &Computed<R>,
    ) -> Result<(), Verdict> {
        let (n, m) = (w.len(), literal.constraints.len());
        if m != self.parts.program.constraints.len() {
            return Err(self.disagreement_at(Role::ConstraintRates, 0));
        }
        let positions = self.call(Role::ConstraintPositions, at, m)?;
        let rates = self.call(Role::ConstraintRates, at, m)?;
        for (k, constraint) in literal.constraints.iter().enumerate() {
            self.compare(
                Role::ConstraintPositions,
                k,
                positions[k],
                constraint.position,
            )?;
            self.compare(Role::ConstraintRates, k, rates[k], constraint.rate)?;
            // Positions must not depend on rates.
            self.compare(Role::ConstraintPositions, k, constraint.by_rates, R::ZERO)?;
            let row = &computed.rows[k * n..][..n];
            let along = Sum::products(row, w).plus(-constraint.along);
            if !constraint.along.is_finite() || !constraint.acceleration.is_finite() {
                return Err(Verdict::Undefined);
            }
            if !along.vanishes()? {
                let entry = |j: usize| (row[j], self.literal(at, j).constraints[k].along);
                let j = first_difference(n, entry);
                return Err(self.disagreement_at(Role::ConstraintMatrix, k * n + j));
            }
            let residual = Sum::products(row, &at.a).plus(-computed.constraint_bias[k]);
            self.compare_difference(
                Role::ConstraintBias,
                k,
                residual.plus(-constraint.acceleration),
            )?;
        }
        Ok(())
    }

    /// Compares the slips, and finds for each whether the program has the same sign as the literal
    /// equations; in a field it may be opposite, since a length there has no sign.
    fn check_slips(
        &mut self,
        at: &State<R>,
        w: &[R],
        literal: &Literal<R>,
    ) -> Result<Vec<R>, Verdict> {
        let (n, count) = (w.len(), literal.sliding.len());
        if count != self.parts.program.contacts.len() {
            return Err(self.disagreement_at(Role::Slips, 0));
        }
        if count == 0 {
            return Ok(Vec::new());
        }
        let slips = self.call(Role::Slips, at, count)?;
        let rows = self.call(Role::SlipMatrix, at, count * n)?;
        let biases = self.call(Role::SlipBias, at, count)?;
        let mut signs = Vec::with_capacity(count);
        for (k, contact) in literal.sliding.iter().enumerate() {
            let sign = if equal(slips[k], contact.slip)? {
                R::ONE
            } else if !R::IS_ORDERED {
                -R::ONE
            } else {
                return Err(self.disagreement_at(Role::Slips, k));
            };
            self.compare(Role::Slips, k, slips[k], sign * contact.slip)?;
            let row = &rows[k * n..][..n];
            let along = Sum::products(row, w).plus(-(sign * contact.slip_along));
            if !along.vanishes()? {
                let entry = |j: usize| (row[j], sign * self.literal(at, j).sliding[k].slip_along);
                let j = first_difference(n, entry);
                return Err(self.disagreement_at(Role::SlipMatrix, k * n + j));
            }
            let rate = Sum::products(row, &at.a).plus(biases[k]);
            self.compare_difference(Role::SlipBias, k, rate.plus(-(sign * contact.slip_rate)))?;
            signs.push(sign);
        }
        Ok(signs)
    }

    /// Compares the unilateral contacts: gaps; the rates, rows and biases of both directions, each
    /// like those of a constraint that would hold the contact; and the coefficients.
    fn check_unilateral(
        &mut self,
        at: &State<R>,
        w: &[R],
        literal: &Literal<R>,
    ) -> Result<(), Verdict> {
        let (n, count) = (w.len(), literal.unilateral.len());
        if count != self.parts.program.unilateral.len() {
            return Err(self.disagreement_at(Role::Gaps, 0));
        }
        if count == 0 {
            return Ok(());
        }
        let gaps = self.call(Role::Gaps, at, count)?;
        let rates = self.call(Role::ContactRates, at, 2 * count)?;
        let rows = self.call(Role::ContactMatrix, at, 2 * count * n)?;
        let biases = self.call(Role::ContactBias, at, 2 * count)?;
        let coefficients = self.call(Role::ContactCoefficients, at, 4 * count)?;
        let of_faces: Vec<R> = (literal.unilateral.iter())
            .filter_map(|contact| contact.face)
            .flatten()
            .collect();
        if self.parts.program.sizes().faces * 3 != of_faces.len() {
            return Err(self.disagreement_at(Role::ContactFaces, 0));
        }
        if !of_faces.is_empty() {
            let faces = self.call(Role::ContactFaces, at, of_faces.len())?;
            for (i, (&found, &expected)) in faces.iter().zip(&of_faces).enumerate() {
                self.compare(Role::ContactFaces, i, found, expected)?;
            }
        }
        for (k, contact) in literal.unilateral.iter().enumerate() {
            self.compare(Role::Gaps, k, gaps[k], contact.opening.position)?;
            // Positions must not depend on rates.
            self.compare(Role::Gaps, k, contact.opening.by_rates, R::ZERO)?;
            self.compare(Role::Gaps, k, contact.gap.by_rates, R::ZERO)?;
            for (i, direction) in [contact.gap, contact.slip].into_iter().enumerate() {
                let i = 2 * k + i;
                self.compare(Role::ContactRates, i, rates[i], direction.rate)?;
                let row = &rows[i * n..][..n];
                let along = Sum::products(row, w).plus(-direction.along);
                self.compare_difference(Role::ContactMatrix, i * n, along)?;
                let rate = Sum::products(row, &at.a).plus(biases[i]);
                self.compare_difference(Role::ContactBias, i, rate.plus(-direction.acceleration))?;
            }
            for (i, &expected) in contact.coefficients.iter().enumerate() {
                let i = 4 * k + i;
                self.compare(Role::ContactCoefficients, i, coefficients[i], expected)?;
            }
        }
        Ok(())
    }

    /// Compares outputs, assumptions and the start. An output may have no value here.
    fn check_outputs_and_start(&mut self, at: &State<R>, facts: &[R]) -> Result<(), Verdict> {
        let machine = self.parts.machine;
        let model = machine.model;
        let outputs: Vec<Expr<'d>> = model.outputs.iter().map(|output| output.value).collect();
        for (i, expected) in machine.values(&outputs, at).into_iter().enumerate() {
            let role = Role::Output(i);
            let found = Self::try_call(&mut self.interpreter, role, at, 1)[0];
            self.compared.insert(role);
            if !found.is_finite() || !expected.is_finite() {
                self.has_lacked_value[i] |= expected.is_finite();
                continue;
            }
            match Sum::of([found, -expected]).vanishes() {
                Ok(true) => self.has_had_value[i] = true,
                Ok(false) => return Err(self.disagreement_at(role, 0)),
                Err(_) => {}
            }
        }
        for (i, &expected) in facts.iter().enumerate() {
            let role = Role::Assumption(i);
            let found = self.call(role, at, 1)?[0];
            self.compare(role, 0, found, expected)?;
        }
        let starts = model.coordinates.iter().map(|c| c.start);
        let starts: Vec<Expr<'d>> = starts
            .chain(model.coordinates.iter().map(|c| c.start_rate))
            .collect();
        let n = at.q.len();
        let (mut q, mut v) = (vec![R::ZERO; n], vec![R::ZERO; n]);
        self.interpreter.start(&mut q, &mut v);
        let found = q.into_iter().chain(v);
        for (i, (found, expected)) in found.zip(machine.values(&starts, at)).enumerate() {
            // A start that does not exist, such as √(−1) of a parameter, is left to the run to report.
            if found.is_finite() && expected.is_finite() {
                self.compare(Role::Start, i, found, expected)?;
            }
        }
        Ok(())
    }

    /// Moves the coordinates that constraints determine to where these are satisfied; the
    /// constraints themselves show whether they are.
    fn satisfy_constraints(&self, mut at: State<R>) -> Result<State<R>, Verdict> {
        let (machine, settled) = (self.parts.machine, self.parts.eliminated);
        let point = self.number;
        let wrong = |dependent: &Dependent<'_>| {
            let (coordinate, constraint) = (dependent.coordinate, dependent.constraint);
            Verdict::from(Disagreement::Eliminated {
                coordinate,
                constraint,
                point,
            })
        };
        let expressions: Vec<Expr<'d>> = settled
            .iter()
            .flat_map(|d| {
                let meaning = d.offset.map_or(d.coefficient, |[_, meaning]| meaning);
                [d.coefficient, meaning]
            })
            .collect();
        let values = machine.values(&expressions, &at);
        for (dependent, values) in settled.iter().zip(values.chunks_exact(2)) {
            if values[0].test_zero(1.0) == ZeroTest::Zero {
                return Err(wrong(dependent));
            }
        }
        let offsets: Vec<(Expr<'d>, R)> = settled
            .iter()
            .zip(values.chunks_exact(2))
            .filter_map(|(d, values)| d.offset.map(|[offset, _]| (offset, values[1])))
            .collect();
        let places: Vec<Expr<'d>> = settled.iter().flat_map(|d| [d.position, d.rate]).collect();
        let values = machine.values_with(&places, &at, &offsets);
        for (dependent, values) in settled.iter().zip(values.chunks_exact(2)) {
            let i = dependent.coordinate;
            [at.q[i], at.v[i]] = [values[0], values[1]];
        }
        let literal = machine.at(&at, &vec![R::ZERO; at.q.len()]);
        for dependent in settled {
            let constraint = literal.constraints[dependent.constraint];
            let mut open = vec![constraint.rate];
            if dependent.offset.is_none() {
                open.push(constraint.position);
            }
            for value in open {
                let i = dependent.coordinate;
                let size = 1.0 + at.q[i].size() + at.v[i].size();
                match value.test_zero(size) {
                    _ if !value.is_finite() => return Err(Verdict::Undefined),
                    ZeroTest::Zero => {}
                    ZeroTest::NotZero => return Err(wrong(dependent)),
                    ZeroTest::Undecided => return Err(Verdict::Undefined),
                }
            }
        }
        Ok(at)
    }

    /// The lower triangle of the matrix that is eliminated: `M`, followed by the rows of `G`.
    fn lower(&self, computed: &Computed<R>) -> Vec<R> {
        let n = computed.bias.len();
        let mut lower = computed.mass_matrix.clone();
        for (k, row) in computed.rows.chunks(n.max(1)).enumerate() {
            lower.extend(row);
            lower.extend(vec![R::ZERO; k + 1]);
        }
        lower
    }

    /// Whether the accelerations are undefined because the equations do not determine them; the
    /// guards of the program then report this at run time.
    fn has_no_accelerations(
        &mut self,
        at: &State<R>,
        computed: &Computed<R>,
    ) -> Result<bool, Verdict> {
        let role = self.parts.program.solving();
        let len = self
            .parts
            .program
            .function(role)
            .map_or(0, |f| f.results.len());
        let results = Self::try_call(&mut self.interpreter, role, at, len);
        if results.iter().all(|x| x.is_finite()) {
            return Ok(false);
        }
        let lower = self.lower(computed);
        let n = at.q.len() + self.parts.program.constraints.len();
        let determinant = determinant(&lower, n);
        let is_singular = if R::IS_ORDERED {
            // A determinant of rounded numbers cannot be known to be 0, but a constraint may be
            // seen to depend on the others.
            has_dependent(&computed.rows, at.q.len())
        } else {
            !determinant.is_finite() || determinant.test_zero(0.0) == ZeroTest::Zero
        };
        if is_singular {
            Ok(true)
        } else {
            Err(Verdict::Undefined)
        }
    }

    /// Checks `M a = f + Gᵀλ` and `G a = γ`.
    fn check_motion(&mut self, at: &State<R>, computed: &Computed<R>) -> Result<(), Verdict> {
        let (n, m) = (at.q.len(), self.parts.program.constraints.len());
        let a = self.call(Role::Accelerations, at, n)?;
        let multipliers = self.call(Role::Multipliers, at, m)?;
        self.check_balance(computed, &a, &multipliers, &computed.forces)
    }

    /// Checks `M a = f + Gᵀλ` and `G a = γ` for given accelerations, multipliers and forces.
    fn check_balance(
        &self,
        computed: &Computed<R>,
        a: &[R],
        multipliers: &[R],
        forces: &[R],
    ) -> Result<(), Verdict> {
        let (n, point) = (a.len(), self.number);
        for (constraint, row) in computed.rows.chunks(n.max(1)).enumerate() {
            let open = Sum::products(row, a).plus(-computed.constraint_bias[constraint]);
            if !open.vanishes()? {
                // A dependent constraint may contradict the others. Then no accelerations exist, and
                // the run reports it if it gets there.
                return if is_dependent(&computed.rows, n, constraint) {
                    Ok(())
                } else {
                    Err(Disagreement::Constraint { constraint, point }.into())
                };
            }
        }
        for coordinate in 0..n {
            let mut left = Sum::of([-forces[coordinate]]);
            for (m, &a) in row(&computed.mass_matrix, n, coordinate).zip(a) {
                left = left.plus(m * a);
            }
            for (row, &multiplier) in computed.rows.chunks(n).zip(multipliers) {
                left = left.plus(-(row[coordinate] * multiplier));
            }
            if !left.vanishes()? {
                return Err(Disagreement::Motion { coordinate, point }.into());
            }
        }
        Ok(())
    }

    /// Checks that for any friction forces the accelerations, multipliers and normal reactions obey the
    /// equations of motion, of the constraints, and of the displacements that would open the guides.
    fn check_friction(
        &mut self,
        at: &State<R>,
        computed: &Computed<R>,
        signs: &[R],
    ) -> Result<(), Verdict> {
        let (n, count) = (at.q.len(), signs.len());
        let layout = FrictionLayout {
            coordinates: n,
            constraints: self.parts.program.constraints.len(),
            contacts: count,
            axes: self.parts.program.reaction_axes,
        };
        let values = self.call(Role::Friction, at, layout.len())?;
        let response = FrictionResponse {
            layout,
            values: &values,
        };
        let friction_forces = self.random_numbers(2, count);
        let total = |place: usize| response.with(place, &friction_forces);
        let total: Vec<R> = (0..layout.part()).map(total).collect();
        let total = layout.split(&total);
        let rows = self.call(Role::SlipMatrix, at, count * n)?;
        let biases = self.call(Role::SlipBias, at, count)?;
        let mut forces = computed.forces.clone();
        for (row, &friction) in rows.chunks(n).zip(&friction_forces) {
            for (force, &tau) in forces.iter_mut().zip(row) {
                *force = *force + tau * friction;
            }
        }
        let (a, multipliers) = (total.accelerations, total.multipliers);
        self.check_balance(computed, a, multipliers, &forces)?;
        for (k, row) in rows.chunks(n).enumerate() {
            let rate = Sum::products(row, a).plus(biases[k]);
            let rate = rate.plus(-total.slip_rates[k]);
            self.compare_difference(Role::Friction, layout.slip_rate(k), rate)?;
        }

        let moving = State {
            a: a.to_vec(),
            ..at.clone()
        };
        let contacts = self.parts.machine.at(&moving, &vec![R::ZERO; n]).sliding;
        self.check_guides(response, &contacts)?;
        let pressed = GuideForces {
            multipliers,
            friction_forces: &friction_forces,
            normals: total.normals,
            axes: layout.axes,
            signs,
        };
        self.check_reactions(&moving, &contacts, &pressed)
    }

    /// Checks the coefficients of friction of the guides, and in space their directions.
    fn check_guides(
        &mut self,
        response: FrictionResponse<'_, R>,
        contacts: &[LiteralSliding<R>],
    ) -> Result<(), Verdict> {
        let layout = response.layout;
        for (k, contact) in contacts.iter().enumerate() {
            let places = [layout.friction(k), layout.static_friction(k)];
            for (place, expected) in places.into_iter().zip(contact.coefficients) {
                self.compare(Role::Friction, place, response.values[place], expected)?;
            }
        }
        if layout.axes == 1 {
            return Ok(());
        }
        for (k, contact) in contacts.iter().enumerate() {
            let (first, direction) = (layout.direction(k).start, response.direction(k));
            // Compared up to sign, because square roots in a field have none.
            for (i, j) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)] {
                let expected = contact.reference_direction[i] * contact.reference_direction[j];
                let found = direction[i] * direction[j];
                self.compare(Role::Friction, first + j, found, expected)?;
            }
        }
        Ok(())
    }

    /// Checks that the normal reactions balance the forces that would open the guides: the
    /// equations of the relaxed machine along their normals.
    fn check_reactions(
        &self,
        at: &State<R>,
        contacts: &[LiteralSliding<R>],
        pressed: &GuideForces<'_, R>,
    ) -> Result<(), Verdict> {
        let Some(relaxed) = self.parts.relaxed else {
            return Err(Verdict::Undefined);
        };
        let guides = guides_of(relaxed.model);
        // The side of each guide on which the body is.
        let mut sides = Vec::with_capacity(contacts.len());
        for contact in contacts {
            let side = contact.side.sign();
            sides.push(if R::IS_ORDERED { side } else { R::ONE });
        }
        if !sides.iter().all(|side| side.is_finite()) {
            return Err(Verdict::Undefined);
        }
        let openings = openings(relaxed, at, contacts, (&guides, &sides));
        // The side is unknown in a field, where any combination is accepted. In space there are no sides.
        let patterns = if R::IS_ORDERED || relaxed.model.space == Space::Space {
            1
        } else {
            1u32 << contacts.len()
        };
        let mut wrong = 0;
        for pattern in 0..patterns {
            let normal = |(i, &normal): (usize, &R)| match pattern >> (i / pressed.axes) & 1 {
                0 => normal,
                _ => -normal,
            };
            let normals: Vec<R> = pressed.normals.iter().enumerate().map(normal).collect();
            let pressed = GuideForces {
                normals: &normals,
                ..*pressed
            };
            match pressed.first_unbalanced(&openings, &guides, &sides)? {
                None => return Ok(()),
                Some(contact) => wrong = wrong.max(contact),
            }
        }
        let (contact, point) = (wrong, self.number);
        Err(Disagreement::Reaction { contact, point }.into())
    }

    /// Checks that the product of the pivots, one for each coordinate, is the determinant of `M`,
    /// and that each pivot is compared with its `Mᵢᵢ` or itself; with constraints the product is
    /// that of their matrix too, up to the signs of theirs.
    fn check_pivots(&mut self, at: &State<R>, computed: &Computed<R>) -> Result<(), Verdict> {
        let program = self.parts.program;
        let n = at.q.len() + program.constraints.len();
        let coordinates = guarded_coordinates(program);
        let mut sorted = coordinates.clone();
        sorted.sort_unstable();
        // A coordinate that a constraint determines may have no pivot; then the pivot of the
        // constraint is divided by.
        let missing: Vec<usize> = (0..n).filter(|i| !sorted.contains(i)).collect();
        let settled = self.parts.eliminated;
        let is_settled = |i: &usize| settled.iter().any(|d| d.coordinate == *i);
        if sorted.len() + missing.len() != n || !missing.iter().all(is_settled) {
            let point = self.number;
            return Err(Disagreement::Pivots { point }.into());
        }
        let len = 2 * sorted.len();
        let values = Self::try_call(&mut self.guards, program.solving(), at, len);
        let mut pairs = vec![[R::ONE; 2]; n];
        for (&i, pair) in coordinates.iter().zip(values.chunks_exact(2)) {
            pairs[i] = [pair[0], pair[1]];
        }
        self.check_pairs(&pairs, &self.lower(computed), missing.is_empty())
    }

    /// Checks that the product of pivots is the determinant of the matrix with that lower triangle
    /// and, for the pivots of `M`, that the scales are its diagonal.
    fn check_pairs(
        &self,
        pairs: &[[R; 2]],
        lower: &[R],
        are_of_matrix: bool,
    ) -> Result<(), Verdict> {
        let coordinates = self.parts.program.dimension();
        let n = coordinates + self.parts.program.constraints.len();
        let wrong = || Err(Disagreement::Pivots { point: self.number }.into());
        if pairs.len() != n {
            return wrong();
        }
        let pivots = pairs.iter().enumerate().map(
            |(i, [pivot, _])| {
                if i < coordinates { *pivot } else { -*pivot }
            },
        );
        let product = pivots.fold(R::ONE, |product, pivot| product * pivot);
        let expected = determinant(lower, n);
        if !expected.is_finite() || !product.is_finite() {
            return Err(Verdict::Undefined);
        }
        if !equal(product, expected)? {
            return wrong();
        }
        // Coordinates that constraints hold because they have no inertia have another scale.
        let own = &lower[..Shape::Symmetric(coordinates).len()];
        let has_inertia = determinant(own, coordinates).test_zero(0.0) == ZeroTest::NotZero;
        if are_of_matrix && has_inertia {
            for (i, &[pivot, scale]) in pairs.iter().take(coordinates).enumerate() {
                if !equal(scale, pivot)? && !equal(scale, lower[Shape::index(i, i)])? {
                    return wrong();
                }
            }
        }
        Ok(())
    }

    /// Checks that the accelerations over dual numbers have the derivatives that the program gives,
    /// along one random direction, and one variable at a time only if that fails.
    fn check_derivatives(&mut self, at: &State<R>) -> Result<(), Verdict> {
        let (role, n) = (Role::Derivatives, at.q.len());
        let variables = &self.parts.program.derivatives;
        if variables.is_empty() {
            return Ok(());
        }
        let width = 1 + variables.len();
        let found = self.call(role, at, n * width)?;
        let accelerations = self.call(Role::Accelerations, at, n)?;
        for i in 0..n {
            self.compare(role, i * width, found[i * width], accelerations[i])?;
        }
        let direction = self.random_numbers(3, variables.len());
        let slopes = self.derivatives_along(at, &direction)?;
        for (i, &slope) in slopes.iter().enumerate() {
            let row = &found[i * width + 1..][..variables.len()];
            if Sum::products(row, &direction).plus(-slope).vanishes()? {
                continue;
            }
            for column in 0..variables.len() {
                let mut one = vec![R::ZERO; variables.len()];
                one[column] = R::ONE;
                let slope = self.derivatives_along(at, &one)?[i];
                self.compare(role, i * width + 1 + column, row[column], slope)?;
            }
            return Err(self.disagreement_at(role, i * width + 1));
        }
        Ok(())
    }

    /// The directional derivatives of the accelerations.
    fn derivatives_along(&mut self, at: &State<R>, direction: &[R]) -> Result<Vec<R>, Verdict> {
        let Some(interpreter) = &mut self.derivatives else {
            return Err(Verdict::Undefined);
        };
        let constants =
            |values: &[R]| -> Vec<Dual<R>> { values.iter().map(|&x| Dual::constant(x)).collect() };
        let mut lists = [
            constants(&at.q),
            constants(&at.v),
            constants(&at.u),
            constants(&at.parameters),
        ];
        for (variable, &derivative) in self.parts.program.derivatives.iter().zip(direction) {
            let (list, i) = match *variable {
                Variable::Coordinate(i) => (0, i),
                Variable::Rate(i) => (1, i),
                Variable::Input(i) => (2, i),
                Variable::Parameter(i) => (3, i),
            };
            lists[list][i].derivative = derivative;
        }
        let [q, v, u, parameters] = &lists;
        interpreter.prepare(parameters);
        let t = Dual::constant(at.t);
        let mut a = vec![Dual::constant(R::ZERO); at.q.len()];
        let arguments = Arguments { t, q, v, u, a: &[] };
        let called = interpreter.call(Role::Accelerations, arguments, &mut a);
        if called.is_err() || !a.iter().all(|a| a.is_finite()) {
            return Err(Verdict::Undefined);
        }
        Ok(a.iter().map(|a| a.derivative).collect())
    }

    /// Checks that the accelerations in stages equal those computed at once, and that the pivots
    /// guarded on the way are those of `M`.
    fn check_stages(&mut self, at: &State<R>, computed: &Computed<R>) -> Result<(), Verdict> {
        let program = self.parts.program;
        let roles = program.staged_roles();
        let Some(&last) = roles.last() else {
            return Ok(());
        };
        let n = program.dimension();
        let expected = self.call(Role::Accelerations, at, n)?;
        // These pivots depend on parameters alone; those of the stages replace the others.
        let mut pivots: Vec<Option<[R; 2]>> = vec![None; n + program.constraints.len()];
        let known = &program.prepare.guards;
        let varying = program
            .function(Role::Accelerations)
            .map_or(0, |f| f.guards.len());
        let len = 2 * (known.len() + varying);
        let values = Self::try_call(&mut self.guards, Role::Accelerations, at, len);
        for (guard, pair) in known.iter().zip(values.chunks_exact(2)) {
            pivots[guard.coordinate] = Some([pair[0], pair[1]]);
        }
        let mut found = Vec::new();
        for role in roles {
            let Some(function) = program.function(role) else {
                continue;
            };
            let len = function.results.len();
            self.compared.insert(role);
            found = Self::try_call(&mut self.guards, role, at, len + 2 * function.guards.len());
            for (guard, pair) in function.guards.iter().zip(found[len..].chunks_exact(2)) {
                pivots[guard.coordinate] = Some([pair[0], pair[1]]);
            }
            if role == last {
                found.truncate(len);
            } else {
                self.guards.set_stage_results(role, &found);
            }
        }
        if !found.iter().all(|x| x.is_finite()) {
            return Err(Verdict::Undefined);
        }
        for (i, (&found, &expected)) in found.iter().zip(&expected).enumerate() {
            self.compare(last, i, found, expected)?;
        }
        let pairs: Option<Vec<[R; 2]>> = pivots.into_iter().collect();
        let pairs = pairs.unwrap_or_default();
        self.check_pairs(&pairs, &self.lower(computed), true)
    }
}

/// The equations of the relaxed machine along the displacements that open its guides, one for each component of a reaction,
/// with the contact that it belongs to.
fn openings<R: Number>(
    relaxed: &Lagrange<'_, '_>,
    at: &State<R>,
    contacts: &[LiteralSliding<R>],
    (guides, sides): (&[usize], &[R]),
) -> Vec<(usize, Literal<R>)> {
    let n = at.q.len();
    let all = relaxed.model.coordinates.len();
    let mut at = at.clone();
    for list in [&mut at.q, &mut at.v, &mut at.a] {
        list.resize(all, R::ZERO);
    }
    let dimension = relaxed.model.space.dimension();
    let along = |k: usize, axis: &Vec<R>| {
        let mut w = vec![R::ZERO; all];
        for (i, &component) in axis.iter().enumerate() {
            w[n + dimension * guides[k] + i] = sides[k] * component;
        }
        (k, relaxed.at(&at, &w))
    };
    let mut openings = Vec::new();
    for (k, contact) in contacts.iter().enumerate() {
        openings.extend(contact.axes.iter().map(|axis| along(k, axis)));
    }
    openings
}

/// The forces in the guides.
#[derive(Clone, Copy)]
struct GuideForces<'a, R> {
    multipliers: &'a [R],
    friction_forces: &'a [R],
    /// The components of the normal reactions, contact after contact.
    normals: &'a [R],
    /// The number of components of a reaction.
    axes: usize,
    /// Whether the signs of the program's slips agree with the spec.
    signs: &'a [R],
}

impl<R: Number> GuideForces<'_, R> {
    /// The first contact with an opening displacement along which these forces are not balanced.
    fn first_unbalanced(
        &self,
        openings: &[(usize, Literal<R>)],
        guides: &[usize],
        sides: &[R],
    ) -> Result<Option<usize>, Verdict> {
        for (k, literal) in openings {
            let mut open = Sum::of([literal.inertia, -literal.applied]);
            for (constraint, &multiplier) in literal.constraints.iter().zip(self.multipliers) {
                open = open.plus(-(constraint.along * multiplier));
            }
            let normals = self.normals.chunks_exact(self.axes);
            for ((j, contact), normals) in literal.sliding.iter().enumerate().zip(normals) {
                let friction = self.signs[j] * self.friction_forces[j];
                open = open.plus(-(contact.slip_along * friction));
                if !occurs_in_equation(guides, *k, j) {
                    continue;
                }
                for (&off, &normal) in contact.off_along.iter().zip(normals) {
                    open = open.plus(-(sides[j] * off * normal));
                }
            }
            if !open.value.is_finite() {
                return Err(Verdict::Undefined);
            }
            if !open.vanishes()? {
                return Ok(Some(*k));
            }
        }
        Ok(None)
    }
}

/// The first index at which the found and the expected value differ.
fn first_difference<R: Number>(len: usize, at: impl Fn(usize) -> (R, R)) -> usize {
    let differs = |i: &usize| {
        let (found, expected) = at(*i);
        matches!(equal(found, expected), Ok(false))
    };
    (0..len).find(differs).unwrap_or(0)
}

/// Checks that a function gives the same results in two programs of one machine.
fn same_results(whole: &Program, part: &Program, role: Role) -> Result<(), Disagreement> {
    let len = whole.function(role).map_or(0, |f| f.results.len());
    let list = |kind: u64, len: usize| -> Vec<Residue> {
        (0..len as u64).map(|i| Residue::random(kind, i)).collect()
    };
    let (n, mut good) = (whole.dimension(), 0);
    let parameters = vec![Residue::ONE; whole.parameters.len()];
    let mut programs = [whole, part].map(|program| Interpreter::new(program, &parameters));
    for point in 0..MOST_STATES {
        let number = |kind: u64| 8 * point + kind;
        let lists = [1, 2, 3].map(|kind| list(number(kind), n));
        let u = list(number(4), whole.inputs.len());
        let arguments = Arguments {
            t: list(number(5), 1)[0],
            q: &lists[0],
            v: &lists[1],
            u: &u,
            a: &lists[2],
        };
        let parameters = list(number(6), whole.parameters.len());
        let mut results = [vec![Residue::ZERO; len], vec![Residue::ZERO; len]];
        let mut has_values = [true; 2];
        for ((program, results), has_values) in
            programs.iter_mut().zip(&mut results).zip(&mut has_values)
        {
            program.prepare(&parameters);
            *has_values = program.call(role, arguments, results).is_ok();
        }
        let [a, b] = &results;
        let differs = |(a, b): (&Residue, &Residue)| a != b && (a.is_finite() || b.is_finite());
        match a.iter().zip(b).position(differs) {
            _ if has_values != [true; 2] => continue,
            Some(index) => return Err(Disagreement::Result { role, index, point }),
            None => good += 1,
        }
        if good == POINTS {
            break;
        }
    }
    Ok(())
}

/// Whether one of some rows of length `n` is a linear combination of the others.
fn is_dependent<R: Number>(rows: &[R], n: usize, one: usize) -> bool {
    let mut ordered: Vec<&[R]> = rows.chunks(n.max(1)).collect();
    let one = ordered.remove(one);
    ordered.push(one);
    dependent_rows(&ordered).last() == Some(&true)
}

/// Whether some of the rows are linear combinations of others.
fn has_dependent<R: Number>(rows: &[R], n: usize) -> bool {
    let rows: Vec<&[R]> = rows.chunks(n.max(1)).collect();
    dependent_rows(&rows).contains(&true)
}

/// For each row whether it is a linear combination of those before it, by elimination; a rounded
/// number that may be 0 counts as 0.
fn dependent_rows<R: Number>(rows: &[&[R]]) -> Vec<bool> {
    let is_zero = |x: &R| !matches!(x.test_zero(0.0), ZeroTest::NotZero);
    let mut pivots: Vec<(usize, Vec<R>)> = Vec::new();
    let mut vanishing = Vec::with_capacity(rows.len());
    for row in rows {
        let mut row = row.to_vec();
        for (pivot, before) in &pivots {
            let factor = row[*pivot] / before[*pivot];
            for (to, &from) in row.iter_mut().zip(before) {
                *to = *to + -(factor * from);
            }
            row[*pivot] = R::ZERO;
        }
        let pivot = row.iter().position(|x| !is_zero(x));
        vanishing.push(pivot.is_none());
        pivots.extend(pivot.map(|pivot| (pivot, row)));
    }
    vanishing
}
