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
//! * the projection onto the constraints, by substitution into `M d = Gᵀμ`, `G d = −g`, and the same of rates;
//! * derivatives, by running the accelerations over dual numbers;
//! * accelerations in stages, and the guarded pivots.
//!
//! # Number types
//!
//! The comparison is made first in a prime field ([`Residue`]), at [`POINTS`] random points. There
//! nothing is rounded: equal values are identical, and different ones agree with a probability of
//! about the degree of their difference over 2⁶¹, or over 2⁴⁰ if it is a difference in angles (J. T.
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

mod accelerations;
mod charts;
mod contacts;
pub(crate) mod derived;
pub mod disagreement;
mod dynamics;
pub(crate) mod number;
mod projection;
pub mod symbolic;
mod unproved;

use std::collections::BTreeSet;
use std::fmt;
use std::ops::Deref;

use lagrangian_scalar::{Ball, Dual, Residue, Scalar};
use lagrangian_symbolic::{Expr, Function as Call, Node, reachable};

use crate::equations::literal::{Lagrange, State};
use crate::proof::symbolic::with_guarded_values;
use crate::{Dependent, Equations};
use crate::{Disagreement, POINTS};
pub use charts::{Uncharted, prove_charts};
use lagrangian_program::{
    Arguments, Function as PlannedFunction, Interpreter, Op, Program, Role, Shape,
};
use lagrangian_spec::model::Model;
use number::{Number, ZeroTest};
use unproved::subject_text;
pub use unproved::{Unproved, Witness};

/// The number of states at which programs are compared in double-doubles.
pub const STATES: usize = 4;

/// The largest number of states to try.
const MOST_STATES: u64 = 96;

/// The largest number of points of the field to try. A root needs a point where its argument is a
/// square, which holds with probability ½; a machine with more than ten roots is compared at states.
const MOST_POINTS: u64 = 4096;

/// The largest number of expression values that the search for a point may compute.
const MOST_VALUES: u64 = 4_000_000;

/// Half of the elements of a prime field have a square root. With as many roots as this in one function, all of them exist at one point in 2³²,
/// far more than [`MOST_POINTS`], and only states can tell.
const HOPELESS_ROOTS: usize = 32;

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

    /// This program with some of its functions, as [`Program::with_only`]; proved to give the same values as here.
    ///
    /// # Errors
    /// If it gives other values.
    pub fn with_only(&self, roles: &[Role]) -> Result<Proved, Unproved> {
        let part = self.0.with_only(roles);
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
    let roots = most_roots(program);
    let most = if roots > MOST_POINTS.ilog2() as usize {
        MOST_STATES
    } else {
        most.clamp(MOST_STATES, MOST_POINTS)
    };
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
    let in_field = if roots >= HOPELESS_ROOTS {
        ComparisonResult::Inconclusive
    } else {
        Prover::<Residue>::new(parts).run(POINTS, most, work)
    };
    if in_field == ComparisonResult::Equal && smooth && model.sliding().is_empty() {
        return Ok(());
    }
    let at_states = Prover::<Ball>::new(parts).run(STATES, MOST_STATES, work);
    decide(in_field, at_states)
}

/// The greatest number of square roots in one function of a program: the lengths in the gaps of a heap, for example.
fn most_roots(program: &Program) -> usize {
    let is_root = |op: &&Op| matches!(op, Op::Unary(Call::Sqrt, _));
    let roots = |function: &PlannedFunction| function.code.iter().filter(is_root).count();
    program.functions.iter().map(roots).max().unwrap_or(0)
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
        (ComparisonResult::Wrong(wrong), _) => Err((wrong, Witness::FieldAlone)),
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
    let code = |function: &PlannedFunction| function.code.len() as u64;
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
            Interpreter::new(&program.with_only(&[Role::Accelerations]), &parameters)
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
            self.compared.contains(&role) || (role.is_fast() && !self.has_had_accelerations)
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
        self.interpreter.prepare(&state.parameters);
        if !self.has_gaps(&state) {
            return Err(Verdict::Undefined);
        }
        self.comparisons += 1;
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

    /// Whether all gaps exist. The distances of corners and centres have roots that do not occur in the equations of the model; where
    /// one is missing, nothing else needs to be evaluated.
    fn has_gaps(&mut self, at: &State<R>) -> bool {
        let count = self.parts.program.unilateral.len();
        count == 0
            || Self::try_call(&mut self.interpreter, Role::Gaps, at, count)
                .iter()
                .all(|gap| gap.is_finite())
    }

    fn compare_at(&mut self, state: State<R>, facts: &[R]) -> Result<(), Verdict> {
        let machine = self.parts.machine;
        let n = machine.model.coordinates.len();
        let w = self.random_numbers(1, n);
        let literal = machine.at(&state, &w);
        self.check_values(&state, &literal)?;
        let computed = self.computed(&state)?;
        self.check_dynamics(&state, &w, &literal, &computed)?;
        self.check_constraints(&state, &w, &literal, &computed)?;
        self.check_power(&state, &literal, &computed)?;
        let signs = self.check_slips(&state, &w, &literal)?;
        let has_friction = !signs.is_empty();
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
        if !has_friction {
            self.check_motion(&state, &computed)?;
            self.check_projection(&state, &computed)?
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
