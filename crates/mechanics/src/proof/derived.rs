//! Proves programs of derivatives by comparison with the original program, run over dual numbers.
//!
//! The original program is proved against Lagrange's equations, and dual numbers do not depend on how a derivative was
//! written: they apply the chain rule to every operation. A [tangent](Program::tangent) is compared number by number, and an
//! [adjoint](Program::adjoint) by the sum of its derivatives along a random direction, which proves all of them at once. The
//! dual numbers are first over the prime field, and over double-doubles that carry a bound of their error if values do not
//! exist in the field, as for the program itself.

use lagrangian_program::{Arguments, Interpreter, Op, Program, Role, is_differentiated};
use lagrangian_scalar::{Ball, Dual, Residue, Scalar};
use lagrangian_spec::model::Model;

use super::number::Number;
use super::{
    ComparisonResult, Disagreement, MOST_POINTS, MOST_STATES, MOST_VALUES, Proved, STATES, Sum,
    Unproved, Verdict, Witness, decide, equal, subject_text,
};
use crate::POINTS;
use crate::equations::literal::{Lagrange, State};

impl Proved {
    /// The changes of accelerations and outputs under changes of their arguments, as [`Program::tangent`].
    ///
    /// # Errors
    /// If the comparison fails, or if there are no values at any point.
    pub fn tangent(&self, model: &Model<'_>) -> Result<Proved, Unproved> {
        self.derived(self.0.tangent(), model)
    }

    /// The derivatives of accelerations and outputs in reverse mode, as [`Program::adjoint`].
    ///
    /// # Errors
    /// If the comparison fails, or if there are no values at any point.
    pub fn adjoint(&self, model: &Model<'_>) -> Result<Proved, Unproved> {
        self.derived(self.0.adjoint(), model)
    }

    /// Proves a program of derivatives of this one, a tangent or an adjoint.
    ///
    /// # Errors
    /// If it is not one, or if there are no values at any point.
    pub fn derived(&self, part: Program, model: &Model<'_>) -> Result<Proved, Unproved> {
        match validate(&self.0, &part, model) {
            Ok(()) => Ok(Proved(part)),
            Err((disagreement, witness)) => Err(Unproved {
                description: subject_text(&disagreement, &part),
                disagreement,
                witness,
            }),
        }
    }
}

/// Compares the program `part` of derivatives with the original.
fn validate(
    whole: &Program,
    part: &Program,
    model: &Model<'_>,
) -> Result<(), (Disagreement, Witness)> {
    let is_known = |role: Role| match role {
        Role::Adjoint => whole.function(Role::Accelerations).is_some(),
        Role::Gradient(i) => whole.function(Role::Output(i)).is_some(),
        role => is_differentiated(role) && whole.function(role).is_some(),
    };
    let mut roles = part.functions.iter().map(|function| function.role);
    if let Some(role) = roles.find(|role| !is_known(*role)) {
        return Err((Disagreement::NotCompared { role }, Witness::Field));
    }
    let holonomic = |k: usize| whole.constraints.get(k).is_some_and(|c| c.holonomic);
    let machine = Lagrange::of(model, holonomic);
    let code = || whole.all_functions().flat_map(|f| &f.code);
    let most = MOST_VALUES / (code().count() as u64).max(1);
    let most = most.clamp(MOST_STATES, MOST_POINTS);
    // As for the program itself, the field alone decides only about sines and cosines.
    let is_smooth = !code().any(|op| matches!(op, Op::Unary(..) | Op::Binary(..)));
    let in_field = Comparison::<Residue>::new(whole, part).run(&machine, POINTS, most);
    if in_field == ComparisonResult::Equal && is_smooth {
        return Ok(());
    }
    let at_states = Comparison::<Ball>::new(whole, part).run(&machine, STATES, MOST_STATES);
    decide(in_field, at_states)
}

/// A program over dual numbers, and its derivatives over the numbers in these.
struct Comparison<'p, R> {
    whole: &'p Program,
    part: &'p Program,
    dual: Interpreter<Dual<R>>,
    interpreter: Interpreter<R>,
    /// The number of the point.
    number: u64,
}

impl<'p, R: Number> Comparison<'p, R> {
    fn new(whole: &'p Program, part: &'p Program) -> Comparison<'p, R> {
        let program = whole.with_functions(is_differentiated);
        let parameters = vec![Dual::<R>::ONE; whole.parameters.len()];
        Comparison {
            dual: Interpreter::new(&program, &parameters),
            interpreter: Interpreter::new(part, &vec![R::ONE; part.parameters.len()]),
            whole,
            part,
            number: 0,
        }
    }

    /// Compares every function at `points` points out of at most `most`. An output that rarely has a value is compared
    /// wherever it has one, as in the proof of the program itself.
    fn run(mut self, machine: &Lagrange<'_, '_>, points: usize, most: u64) -> ComparisonResult {
        let start = (self.part.start != self.whole.start).then_some(Role::Start);
        let functions = self.part.functions.iter().map(|function| function.role);
        let roles: Vec<Role> = start.into_iter().chain(functions).collect();
        let mut good = vec![0; roles.len()];
        for number in 0..most {
            self.number = number;
            let state = R::state(number, machine);
            for (role, good) in roles.iter().zip(&mut good) {
                match self.check(*role, &state) {
                    Ok(()) => *good += 1,
                    Err(Verdict::Undefined) => {}
                    Err(Verdict::Wrong(disagreement)) => {
                        return ComparisonResult::Wrong(disagreement);
                    }
                }
            }
            if good.iter().all(|&good| good >= points) {
                return ComparisonResult::Equal;
            }
        }
        let is_needed = |role: &Role| !matches!(role, Role::Output(_) | Role::Gradient(_));
        let mut needed = roles.iter().zip(&good).filter(|(role, _)| is_needed(role));
        if needed.all(|(_, &good)| good >= points) {
            ComparisonResult::Equal
        } else {
            ComparisonResult::Inconclusive
        }
    }

    /// Random numbers for this point; those of different kinds are independent.
    fn random_numbers(&self, kind: u64, len: usize) -> Vec<R> {
        let one = |i: usize| R::random(self.number, (kind << 32) + 1 + i as u64);
        (0..len).map(one).collect()
    }

    fn check(&mut self, role: Role, at: &State<R>) -> Result<(), Verdict> {
        let changes = State {
            parameters: self.random_numbers(11, at.parameters.len()),
            t: R::ZERO,
            q: self.random_numbers(12, at.q.len()),
            v: self.random_numbers(13, at.v.len()),
            u: self.random_numbers(14, at.u.len()),
            a: self.random_numbers(15, at.a.len()),
        };
        match role {
            Role::Adjoint => self.check_adjoint(at, &changes),
            Role::Gradient(i) => self.check_gradient(i, at, &changes),
            role => self.check_tangent(role, at, &changes),
        }
    }

    /// The program over dual numbers.
    fn duals(&mut self, role: Role, at: &State<R>, by: &State<R>) -> Result<Vec<Dual<R>>, Verdict> {
        let pairs = |values: &[R], changes: &[R]| -> Vec<Dual<R>> {
            let pairs = values.iter().zip(changes);
            let dual = |(&value, &derivative)| Dual { value, derivative };
            pairs.map(dual).collect()
        };
        let (q, v) = (pairs(&at.q, &by.q), pairs(&at.v, &by.v));
        let (u, a) = (pairs(&at.u, &by.u), pairs(&at.a, &by.a));
        let arguments = Arguments {
            t: Dual::constant(at.t),
            q: &q,
            v: &v,
            u: &u,
            a: &a,
        };
        self.dual.prepare(&pairs(&at.parameters, &by.parameters));
        let len = self.whole.function(role).map_or(0, |f| f.results.len());
        let mut results = vec![Dual::ZERO; len];
        match self.dual.call(role, arguments, &mut results) {
            Ok(()) if results.iter().all(|x| x.is_finite()) => Ok(results),
            _ => Err(Verdict::Undefined),
        }
    }

    /// The derivatives.
    fn derivatives(&mut self, role: Role, at: &State<R>) -> Result<Vec<R>, Verdict> {
        let arguments = Arguments {
            t: at.t,
            q: &at.q,
            v: &at.v,
            u: &at.u,
            a: &at.a,
        };
        self.interpreter.prepare(&at.parameters);
        let len = self.part.function(role).map_or(0, |f| f.results.len());
        let mut results = vec![R::ZERO; len];
        match self.interpreter.call(role, arguments, &mut results) {
            Ok(()) if results.iter().all(|x| x.is_finite()) => Ok(results),
            _ => Err(Verdict::Undefined),
        }
    }

    fn disagreement_at(&self, role: Role, index: usize) -> Verdict {
        let point = self.number;
        Disagreement::Result { role, index, point }.into()
    }

    fn check_tangent(&mut self, role: Role, at: &State<R>, by: &State<R>) -> Result<(), Verdict> {
        let duals = self.duals(role, at, by)?;
        let behind = |values: &[R], changes: &[R]| [values, changes].concat();
        let both = State {
            parameters: behind(&at.parameters, &by.parameters),
            t: at.t,
            q: behind(&at.q, &by.q),
            v: behind(&at.v, &by.v),
            u: behind(&at.u, &by.u),
            a: behind(&at.a, &by.a),
        };
        let found = self.derivatives(role, &both)?;
        let mut expected = Vec::with_capacity(found.len());
        for block in duals.chunks(at.q.len().max(1)) {
            if !matches!(role, Role::Output(_)) {
                expected.extend(block.iter().map(|x| x.value));
            }
            expected.extend(block.iter().map(|x| x.derivative));
        }
        for (index, (&found, &expected)) in found.iter().zip(&expected).enumerate() {
            if !equal(found, expected)? {
                return Err(self.disagreement_at(role, index));
            }
        }
        if found.len() == expected.len() {
            Ok(())
        } else {
            Err(self.disagreement_at(role, 0))
        }
    }

    fn check_adjoint(&mut self, at: &State<R>, by: &State<R>) -> Result<(), Verdict> {
        let weights = self.random_numbers(16, at.q.len());
        let duals = self.duals(Role::Accelerations, at, by)?;
        let rates: Vec<R> = duals.iter().map(|x| x.derivative).collect();
        let weighted = State {
            u: [&at.u[..], &weights].concat(),
            ..at.clone()
        };
        let found = self.derivatives(Role::Adjoint, &weighted)?;
        let direction = [&by.q[..], &by.v, &by.parameters, &by.u].concat();
        let expected = rates
            .iter()
            .zip(&weights)
            .map(|(&rate, &weight)| -(rate * weight));
        let sum = expected.fold(Sum::products(&found, &direction), Sum::plus);
        if sum.vanishes()? && found.len() == direction.len() {
            Ok(())
        } else {
            Err(self.disagreement_at(Role::Adjoint, 0))
        }
    }

    fn check_gradient(
        &mut self,
        output: usize,
        at: &State<R>,
        by: &State<R>,
    ) -> Result<(), Verdict> {
        let role = Role::Gradient(output);
        let duals = self.duals(Role::Output(output), at, by)?;
        // A value that this program does not read may be arbitrary.
        let weighted = State {
            u: [&at.u[..], &vec![R::ONE; at.q.len()]].concat(),
            ..at.clone()
        };
        let found = self.derivatives(role, &weighted)?;
        let direction = [&by.q[..], &by.v, &by.parameters, &by.u, &by.a].concat();
        let expected = duals.first().map_or(R::ZERO, |x| x.derivative);
        let sum = Sum::products(&found, &direction).plus(-expected);
        if sum.vanishes()? && found.len() == direction.len() {
            Ok(())
        } else {
            Err(self.disagreement_at(role, 0))
        }
    }
}
