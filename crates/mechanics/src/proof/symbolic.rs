//! Compares a program with the equations it came from, and with Lagrange's equations in symbolic form.
//!
//! Both sides are evaluated at random points of a prime field ([`Residue`]), where nothing is
//! rounded: a program with a wrong sign, factor or operand gives another value, except with a
//! probability of about the degree of the difference over 2⁶¹ at each point. The accelerations are
//! not compared with other accelerations; they are substituted into the residual of Lagrange's
//! equations, which must vanish. So it does not matter how they were computed.

use lagrangian_scalar::{Dual, Residue, Scalar};
use lagrangian_symbolic::{Expr, Symbol, evaluate, substitute};
use rustc_hash::FxHashMap;

use crate::Quantity;
use crate::{Dependent, Oracle, OracleReaction, OracleSliding, dependents};
use lagrangian_program::{
    Arguments, FrictionLayout, FrictionPart, FrictionResponse, Function, Interpreter, Op, Program,
    Role, Shape, Source, Value,
};
use lagrangian_spec::model::{Model, Variable};

use super::disagreement::Disagreement;

/// The number of points at which everything must agree.
pub const POINTS: usize = 3;

/// The largest number of points to try. A root needs a point where its argument is a square, which
/// holds with probability ½; a machine with twenty roots would need a million.
const MOST_TRIES: u64 = 4096;

/// Proves that the program computes what Lagrange's equations say: energies, M, h, Q, f = Q − h,
/// accelerations that obey them, the derivatives of these, and the same accelerations in stages.
///
/// Derivatives are not compared with other formulas. The accelerations, once proved, are run over dual
/// numbers of the prime field, where `ε² = 0` holds exactly: the coefficient of ε is the derivative.
pub fn prove(
    program: &Program,
    model: &Model<'_>,
    oracle: &Oracle<'_>,
) -> Result<(), Disagreement> {
    let n = model.coordinates.len();
    let scalar = |role, value| Quantity {
        role,
        shape: Shape::Scalar,
        values: vec![value],
    };
    let vector = |role, values| Quantity {
        role,
        shape: Shape::Vector(n),
        values,
    };
    let forces = oracle
        .applied
        .iter()
        .zip(&oracle.bias)
        .map(|(&applied, &bias)| applied - bias)
        .collect();
    let mut quantities = vec![
        Quantity {
            role: Role::MassMatrix,
            shape: Shape::Symmetric(n),
            values: oracle.mass_matrix.lower().to_vec(),
        },
        vector(Role::Bias, oracle.bias.clone()),
        vector(Role::Applied, oracle.applied.clone()),
        vector(Role::Forces, forces),
        scalar(Role::KineticEnergy, oracle.kinetic_energy),
        scalar(Role::PotentialEnergy, oracle.potential_energy),
        scalar(Role::Dissipation, oracle.dissipation),
    ];
    let constraints = &oracle.constraints;
    if !constraints.is_empty() {
        let each = |role, values: Vec<_>| Quantity {
            role,
            shape: Shape::Vector(values.len()),
            values,
        };
        let rows = constraints.iter().flat_map(|c| c.row.clone()).collect();
        quantities.extend([
            each(
                Role::ConstraintPositions,
                constraints.iter().map(|c| c.position).collect(),
            ),
            each(
                Role::ConstraintRates,
                constraints.iter().map(|c| c.rate).collect(),
            ),
            each(Role::ConstraintMatrix, rows),
        ]);
    }
    let contacts = &oracle.sliding;
    if !contacts.is_empty() {
        let vector = |role, values: Vec<_>| Quantity {
            role,
            shape: Shape::Vector(values.len()),
            values,
        };
        let rows = contacts.iter().flat_map(|c| c.row.clone()).collect();
        quantities.extend([
            vector(Role::Slips, contacts.iter().map(|c| c.slip).collect()),
            vector(Role::SlipMatrix, rows),
            vector(Role::SlipBias, contacts.iter().map(|c| c.bias).collect()),
        ]);
    }
    let dependents = dependents(model, &crate::equations::constraints(model));
    at_points(program, model, |point| {
        point.check_values(&quantities)?;
        point.satisfy_constraints(&dependents);
        point.check_pivots()?;
        point.check_motion(oracle)?;
        point.check_derivatives()?;
        point.check_stages()
    })
}

/// Proves that the program computes the quantities that it was made from.
pub fn prove_quantities(
    program: &Program,
    model: &Model<'_>,
    quantities: &[Quantity<'_>],
) -> Result<(), Disagreement> {
    at_points(program, model, |point| point.check_values(quantities))
}

/// Why a check is inconclusive or has failed.
enum Verdict {
    /// Something has no value at this point.
    Undefined,
    Wrong(Disagreement),
}

impl From<Disagreement> for Verdict {
    fn from(disagreement: Disagreement) -> Verdict {
        Verdict::Wrong(disagreement)
    }
}

/// Runs a check at [`POINTS`] points where everything has a value.
fn at_points<'d>(
    program: &Program,
    model: &Model<'d>,
    mut check: impl FnMut(&mut Point<'_, 'd>) -> Result<(), Verdict>,
) -> Result<(), Disagreement> {
    let mut good = 0;
    for number in 0..MOST_TRIES {
        match check(&mut Point::new(number, program, model)) {
            Ok(()) => good += 1,
            Err(Verdict::Undefined) => {}
            Err(Verdict::Wrong(disagreement)) => return Err(disagreement),
        }
        if good == POINTS {
            return Ok(());
        }
    }
    Err(Disagreement::Undefined)
}

/// Random values of all symbols, and the program with them as arguments.
struct Point<'a, 'd> {
    number: u64,
    program: &'a Program,
    model: &'a Model<'d>,
    interpreter: Interpreter<Residue>,
    /// Runs the accelerations for the values of their guards.
    guards: Interpreter<Residue>,
    /// The coordinates that constraints determine.
    eliminated: Vec<usize>,
    t: Residue,
    q: Vec<Residue>,
    v: Vec<Residue>,
    u: Vec<Residue>,
    a: Vec<Residue>,
}

impl<'a, 'd> Point<'a, 'd> {
    fn new(number: u64, program: &'a Program, model: &'a Model<'d>) -> Point<'a, 'd> {
        let mut index = 0;
        let mut next = || {
            index += 1;
            Residue::random(number, index)
        };
        let mut many = |len: usize| (0..len).map(|_| next()).collect::<Vec<Residue>>();
        let n = model.coordinates.len();
        let parameters = many(model.parameters.len());
        Point {
            number,
            program,
            model,
            interpreter: Interpreter::new(program, &parameters),
            guards: Interpreter::new(&with_guarded_values(program), &parameters),
            eliminated: Vec::new(),
            t: many(1)[0],
            q: many(n),
            v: many(n),
            u: many(model.inputs.len()),
            a: many(n),
        }
    }

    /// Sets the coordinates that constraints determine, and their rates, to the values that they determine,
    /// since a program may not read them. Constants of the start keep their values at this point.
    fn satisfy_constraints(&mut self, dependents: &[Dependent<'d>]) {
        self.eliminated = dependents.iter().map(|d| d.coordinate).collect();
        let offsets = dependents.iter().filter_map(|d| d.offset);
        let meant = offsets.filter_map(|[offset, meaning]| Some((offset.as_symbol()?, meaning)));
        let meant: Vec<_> = meant.collect();
        let states: Vec<Expr<'d>> = dependents
            .iter()
            .flat_map(|d| [d.rate, d.position])
            .collect();
        let states = substitute(self.model.dag, &states, &meant);
        let values = self.evaluate_all(&states, &self.a);
        for (dependent, state) in dependents.iter().zip(values.chunks_exact(2)) {
            let i = dependent.coordinate;
            [self.v[i], self.q[i]] = [state[0], state[1]];
        }
    }

    /// The results of a function of the program; undefined if the function reads undefined values.
    fn call(&mut self, role: Role, len: usize) -> Result<Vec<Residue>, Verdict> {
        let arguments = Arguments {
            t: self.t,
            q: &self.q,
            v: &self.v,
            u: &self.u,
            a: &self.a,
        };
        let mut results = vec![Residue::ZERO; len];
        let called = self.interpreter.call(role, arguments, &mut results);
        if !results.iter().all(|result| result.is_finite())
            || called.is_err_and(|singular| singular.ratio.is_nan())
        {
            return Err(Verdict::Undefined);
        }
        called.map_err(Disagreement::Singular)?;
        Ok(results)
    }

    /// The values of expressions, given the accelerations.
    fn evaluate(&self, expressions: &[Expr<'d>], a: &[Residue]) -> Result<Vec<Residue>, Verdict> {
        let results = self.evaluate_all(expressions, a);
        if results.iter().all(|result| result.is_finite()) {
            Ok(results)
        } else {
            Err(Verdict::Undefined)
        }
    }

    /// The values of expressions, given the accelerations; they may be undefined.
    fn evaluate_all(&self, expressions: &[Expr<'d>], a: &[Residue]) -> Vec<Residue> {
        let model = self.model;
        let mut values: FxHashMap<Symbol, Residue> = FxHashMap::default();
        let mut set = |symbol: Expr<'_>, value: Residue| {
            if let Some(symbol) = symbol.as_symbol() {
                values.insert(symbol, value);
            }
        };
        set(model.time, self.t);
        let parameters = model.parameters.iter().zip(self.interpreter.parameters());
        parameters.for_each(|(parameter, value)| set(parameter.symbol, *value));
        for (i, coordinate) in model.coordinates.iter().enumerate() {
            set(coordinate.q, self.q[i]);
            set(coordinate.v, self.v[i]);
            set(coordinate.a, a[i]);
        }
        model
            .inputs
            .iter()
            .zip(&self.u)
            .for_each(|(input, value)| set(input.symbol, *value));
        evaluate(model.dag, expressions, |symbol| values[&symbol])
    }

    fn check_values(&mut self, quantities: &[Quantity<'d>]) -> Result<(), Verdict> {
        let expressions: Vec<Expr<'d>> = quantities
            .iter()
            .flat_map(|q| q.values.iter().copied())
            .collect();
        let expected = self.evaluate(&expressions, &self.a)?;
        let mut expected = expected.into_iter();
        for quantity in quantities {
            let results = self.call(quantity.role, quantity.values.len())?;
            for (index, (result, expected)) in results.into_iter().zip(&mut expected).enumerate() {
                if result != expected {
                    let (role, point) = (quantity.role, self.number);
                    return Err(Disagreement::Result { role, index, point }.into());
                }
            }
        }
        Ok(())
    }

    /// Checks that the accelerations and multipliers satisfy the equations of motion and of the constraints.
    fn check_motion(&mut self, oracle: &Oracle<'d>) -> Result<(), Verdict> {
        if !oracle.sliding.is_empty() {
            return self.check_friction(oracle);
        }
        let (n, point) = (oracle.residual.len(), self.number);
        let accelerations = self.call(Role::Accelerations, n)?;
        let mut left = self.evaluate(&oracle.residual, &accelerations)?;
        if !oracle.constraints.is_empty() {
            let multipliers = self.call(Role::Multipliers, oracle.constraints.len())?;
            for (constraint, multiplier) in oracle.constraints.iter().zip(multipliers) {
                let row = self.evaluate(&constraint.row, &accelerations)?;
                for (left, g) in left.iter_mut().zip(row) {
                    *left = *left - g * multiplier;
                }
            }
            let residuals: Vec<Expr<'d>> = oracle.constraints.iter().map(|c| c.residual).collect();
            let open = self.evaluate(&residuals, &accelerations)?;
            if let Some(constraint) = open.iter().position(|left| *left != Residue::ZERO) {
                return Err(Disagreement::Constraint { constraint, point }.into());
            }
            let bias = self.call(Role::ConstraintBias, residuals.len())?;
            let coasting = self.evaluate(&residuals, &vec![Residue::ZERO; n])?;
            let differs =
                |(drift, coasting): (&Residue, &Residue)| *drift + *coasting != Residue::ZERO;
            if let Some(index) = bias.iter().zip(&coasting).position(differs) {
                let role = Role::ConstraintBias;
                return Err(Disagreement::Result { role, index, point }.into());
            }
        }
        match left.iter().position(|left| *left != Residue::ZERO) {
            Some(coordinate) => Err(Disagreement::Motion { coordinate, point }.into()),
            None => Ok(()),
        }
    }

    /// Checks that for any friction forces the accelerations, multipliers and normal reactions obey the
    /// equations of motion, of the constraints, and of the displacements that would open the guides.
    fn check_friction(&mut self, oracle: &Oracle<'d>) -> Result<(), Verdict> {
        let layout = FrictionLayout {
            coordinates: oracle.residual.len(),
            constraints: oracle.constraints.len(),
            contacts: oracle.sliding.len(),
            axes: self.program.reaction_axes,
        };
        let values = self.call(Role::Friction, layout.len())?;
        let response = FrictionResponse {
            layout,
            values: &values,
        };
        let random = |k: u64| Residue::random(self.number, 1_000_000 + k);
        let friction_forces: Vec<Residue> = (0..layout.contacts as u64).map(random).collect();
        let total = |place: usize| response.with(place, &friction_forces);
        let total: Vec<Residue> = (0..layout.part()).map(total).collect();
        let total = layout.split(&total);
        self.check_balance(oracle, total, &friction_forces)?;
        for (k, contact) in oracle.sliding.iter().enumerate() {
            let rate = self.evaluate(&[contact.slip_rate], total.accelerations)?[0];
            if rate != total.slip_rates[k] {
                return Err(self.wrong_response(layout.slip_rate(k)));
            }
            for (place, reaction) in layout.normal(k).zip(&contact.reactions) {
                if !self.is_balanced(reaction, total, &friction_forces)? {
                    return Err(self.wrong_response(place));
                }
            }
            self.check_guide(contact, total.accelerations, response, k)?;
        }
        Ok(())
    }

    /// Checks the equations of motion and of the constraints with these friction forces.
    fn check_balance(
        &self,
        oracle: &Oracle<'d>,
        total: FrictionPart<&[Residue]>,
        friction_forces: &[Residue],
    ) -> Result<(), Verdict> {
        let (a, point) = (total.accelerations, self.number);
        let mut left = self.evaluate(&oracle.residual, a)?;
        let mut subtract = |row: &[Expr<'d>], force: Residue| {
            let row = self.evaluate(row, a)?;
            for (left, slope) in left.iter_mut().zip(row) {
                *left = *left - slope * force;
            }
            Ok::<(), Verdict>(())
        };
        for (constraint, &multiplier) in oracle.constraints.iter().zip(total.multipliers) {
            subtract(&constraint.row, multiplier)?;
        }
        for (contact, &friction) in oracle.sliding.iter().zip(friction_forces) {
            subtract(&contact.row, friction)?;
        }
        let residuals: Vec<Expr<'d>> = oracle.constraints.iter().map(|c| c.residual).collect();
        let open = self.evaluate(&residuals, a)?;
        if let Some(constraint) = open.iter().position(|left| *left != Residue::ZERO) {
            return Err(Disagreement::Constraint { constraint, point }.into());
        }
        match left.iter().position(|left| *left != Residue::ZERO) {
            Some(coordinate) => Err(Disagreement::Motion { coordinate, point }.into()),
            None => Ok(()),
        }
    }

    /// Whether a component of the reactions balances the forces that would open its guide.
    fn is_balanced(
        &self,
        reaction: &OracleReaction<'d>,
        total: FrictionPart<&[Residue]>,
        friction_forces: &[Residue],
    ) -> Result<bool, Verdict> {
        let a = total.accelerations;
        let terms = [
            (&reaction.by_multipliers, total.multipliers),
            (&reaction.by_friction_forces, friction_forces),
            (&reaction.by_normals, total.normals),
        ];
        let mut open = self.evaluate(&[reaction.residual], a)?[0];
        for (coefficients, values) in terms {
            for (c, x) in self.evaluate(coefficients, a)?.into_iter().zip(values) {
                open = open - c * *x;
            }
        }
        Ok(open == Residue::ZERO)
    }

    /// Checks the coefficients of friction of a guide, and in space its direction.
    fn check_guide(
        &self,
        contact: &OracleSliding<'d>,
        a: &[Residue],
        response: FrictionResponse<'_, Residue>,
        k: usize,
    ) -> Result<(), Verdict> {
        let layout = response.layout;
        if layout.axes != 1 {
            let expected = self.evaluate(&contact.reference_direction, a)?;
            let (first, found) = (layout.direction(k).start, response.direction(k));
            for (i, j) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)] {
                if found[i] * found[j] != expected[i] * expected[j] {
                    return Err(self.wrong_response(first + j));
                }
            }
        }
        let expected = self.evaluate(&contact.coefficients, a)?;
        let places = [layout.friction(k), layout.static_friction(k)];
        for (place, expected) in places.into_iter().zip(expected) {
            if response.values[place] != expected {
                return Err(self.wrong_response(place));
            }
        }
        Ok(())
    }

    /// A number of the response to friction forces is wrong.
    fn wrong_response(&self, index: usize) -> Verdict {
        let (role, point) = (Role::Friction, self.number);
        Disagreement::Result { role, index, point }.into()
    }

    /// The lower triangle of the matrix that is eliminated: M, followed by the rows of G.
    fn lower(&mut self) -> Result<Vec<Residue>, Verdict> {
        let (n, m) = (self.program.dimension(), self.program.constraints.len());
        let mut lower = self.call(Role::MassMatrix, Shape::Symmetric(n).len())?;
        if m > 0 {
            let rows = self.call(Role::ConstraintMatrix, n * m)?;
            for (k, row) in rows.chunks(n).enumerate() {
                lower.extend(row);
                lower.extend(vec![Residue::ZERO; k + 1]);
            }
        }
        Ok(lower)
    }

    /// Checks that the accelerations over dual numbers have the derivatives that the program gives.
    fn check_derivatives(&mut self) -> Result<(), Verdict> {
        let (role, n) = (Role::Derivatives, self.program.dimension());
        let variables = &self.program.derivatives;
        if variables.is_empty() {
            return Ok(());
        }
        let width = 1 + variables.len();
        let found = self.call(role, n * width)?;
        let accelerations = self.call(Role::Accelerations, n)?;
        let check = |column: usize, expected: &[Residue]| {
            let differs = |i: &usize| found[i * width + column] != expected[*i];
            match (0..n).find(differs) {
                Some(i) => Err(Verdict::from(Disagreement::Result {
                    role,
                    index: i * width + column,
                    point: self.number,
                })),
                None => Ok(()),
            }
        };
        check(0, &accelerations)?;
        let constants = |values: &[Residue]| -> Vec<Dual<Residue>> {
            values.iter().map(|x| Dual::constant(*x)).collect()
        };
        let mut arguments = [
            constants(&self.q),
            constants(&self.v),
            constants(&self.u),
            constants(self.interpreter.parameters()),
        ];
        let mut interpreter = Interpreter::new(self.program, &arguments[3]);
        let mut a = vec![Dual::constant(Residue::ZERO); n];
        for (column, variable) in (1..).zip(variables) {
            let (list, i) = match *variable {
                Variable::Coordinate(i) => (0, i),
                Variable::Rate(i) => (1, i),
                Variable::Input(i) => (2, i),
                Variable::Parameter(i) => (3, i),
            };
            let before = arguments[list][i];
            arguments[list][i] = Dual::variable(before.value);
            if list == 3 {
                interpreter.prepare(&arguments[3]);
            }
            let [q, v, u, _] = &arguments;
            let t = Dual::constant(self.t);
            let called = interpreter.call(
                Role::Accelerations,
                Arguments { t, q, v, u, a: &[] },
                &mut a,
            );
            arguments[list][i] = before;
            if list == 3 {
                interpreter.prepare(&arguments[3]);
            }
            if called.is_err() || !a.iter().all(|a| a.is_finite()) {
                return Err(Verdict::Undefined);
            }
            let slopes: Vec<Residue> = a.iter().map(|a| a.derivative).collect();
            check(column, &slopes)?;
        }
        Ok(())
    }

    /// Checks that the accelerations in stages equal those computed at once, and that the pivots
    /// guarded on the way are those of M.
    fn check_stages(&mut self) -> Result<(), Verdict> {
        let n = self.program.dimension();
        let roles = self.program.staged_roles();
        let Some(&last) = roles.last() else {
            return Ok(());
        };
        let expected = self.call(Role::Accelerations, n)?;
        let lower = self.lower()?;
        // These pivots depend on parameters alone; those of the stages replace the others.
        let rows = n + self.program.constraints.len();
        let mut pivots: Vec<Option<[Residue; 2]>> = vec![None; rows];
        let probe = with_guarded_values(self.program);
        std::mem::swap(&mut self.interpreter, &mut self.guards);
        let values = self.in_stages(&probe, &mut pivots);
        std::mem::swap(&mut self.interpreter, &mut self.guards);
        let found = values?;
        if let Some(index) = found.iter().zip(&expected).position(|(a, b)| a != b) {
            let (role, point) = (last, self.number);
            return Err(Disagreement::Result { role, index, point }.into());
        }
        let pairs: Option<Vec<[Residue; 2]>> = pivots.into_iter().collect();
        self.check_pairs(pairs.as_deref().unwrap_or_default(), &lower, true)
    }

    /// The accelerations in stages, and by coordinate the pivots with their scales, from a program
    /// [with the values of guards](with_guarded_values).
    fn in_stages(
        &mut self,
        probe: &Program,
        pivots: &mut [Option<[Residue; 2]>],
    ) -> Result<Vec<Residue>, Verdict> {
        let known = &self.program.prepare.guards;
        let varying = probe.function(Role::Accelerations);
        let len = varying.map_or(0, |function| function.results.len());
        let values = self.call(Role::Accelerations, len)?;
        for (guard, pair) in known.iter().zip(values.chunks_exact(2)) {
            pivots[guard.coordinate] = Some([pair[0], pair[1]]);
        }
        let mut results = Vec::new();
        for role in self.program.staged_roles() {
            let Some(function) = self.program.function(role) else {
                continue;
            };
            let len = function.results.len();
            results = self.call(role, len + 2 * function.guards.len())?;
            let pairs = results[len..].chunks_exact(2);
            for (guard, pair) in function.guards.iter().zip(pairs) {
                pivots[guard.coordinate] = Some([pair[0], pair[1]]);
            }
            if role == Role::AccelerationsAt {
                results.truncate(len);
            } else {
                self.interpreter.set_stage_results(role, &results);
            }
        }
        Ok(results)
    }

    /// Checks that the product of the pivots, one for each coordinate, is the determinant of M, and
    /// that each pivot is compared with its Mᵢᵢ or itself; with constraints the product is that of
    /// their matrix too, up to the signs of theirs.
    fn check_pivots(&mut self) -> Result<(), Verdict> {
        let n = self.program.dimension() + self.program.constraints.len();
        let wrong = Disagreement::Pivots { point: self.number };
        let lower = self.lower()?;
        let coordinates = guarded_coordinates(self.program);
        let mut sorted = coordinates.clone();
        sorted.sort_unstable();
        // A coordinate that a constraint determines may have no pivot; then the pivot of the
        // constraint is divided by.
        let missing: Vec<usize> = (0..n).filter(|i| !sorted.contains(i)).collect();
        let is_settled = |i: &usize| self.eliminated.contains(i);
        if sorted.len() + missing.len() != n || !missing.iter().all(is_settled) {
            return Err(wrong.into());
        }
        std::mem::swap(&mut self.interpreter, &mut self.guards);
        let values = self.call(self.program.solving(), 2 * sorted.len());
        std::mem::swap(&mut self.interpreter, &mut self.guards);
        let values = values?;
        let mut pairs = vec![[Residue::ONE; 2]; n];
        for (&i, pair) in coordinates.iter().zip(values.chunks_exact(2)) {
            pairs[i] = [pair[0], pair[1]];
        }
        self.check_pairs(&pairs, &lower, missing.is_empty())
    }

    /// Checks that the product of pivots is the determinant of the matrix with that lower triangle
    /// and, for the pivots of M, that the scales are its diagonal.
    fn check_pairs(
        &self,
        pairs: &[[Residue; 2]],
        lower: &[Residue],
        are_of_matrix: bool,
    ) -> Result<(), Verdict> {
        let coordinates = self.program.dimension();
        let n = coordinates + self.program.constraints.len();
        let product = (0..n)
            .zip(pairs)
            .fold(Residue::ONE, |product, (i, [pivot, _])| {
                let sign = if i < coordinates {
                    Residue::ONE
                } else {
                    -Residue::ONE
                };
                product * sign * *pivot
            });
        let diagonal = |i: usize| lower[Shape::index(i, i)];
        let mut by_coordinates = pairs.iter().take(coordinates).enumerate();
        // Coordinates have another inertia if others were substituted by them, or if constraints
        // hold them because they have no inertia.
        let own = &lower[..Shape::Symmetric(coordinates).len()];
        let has_inertia = determinant(own, coordinates) != Residue::ZERO;
        let scales = !are_of_matrix
            || !has_inertia
            || by_coordinates.all(|(i, [pivot, scale])| *scale == diagonal(i) || scale == pivot);
        let determinant = determinant(lower, n);
        if !determinant.is_finite() {
            return Err(Verdict::Undefined);
        }
        if pairs.len() == n && product == determinant && scales {
            Ok(())
        } else {
            Err(Disagreement::Pivots { point: self.number }.into())
        }
    }
}

/// A copy of a program in which the accelerations return the pivots and their scales instead, in the
/// order of the guards, beginning with those of `prepare`; stages return theirs after their results.
pub(super) fn with_guarded_values(program: &Program) -> Program {
    let mut probe = program
        .with_functions(|role| role == program.solving() || program.staged_roles().contains(&role));
    let values = |function: &Function| {
        function
            .guards
            .iter()
            .flat_map(|guard| [guard.pivot, guard.scale])
            .collect()
    };
    let known: Vec<Value> = values(&probe.prepare);
    let first = probe.prepare.results.len();
    probe.prepare.results.extend(&known);
    probe.prepare.guards.clear();
    for function in probe
        .functions
        .iter_mut()
        .filter(|function| function.role == program.solving())
    {
        let varying: Vec<Value> = values(function);
        function.results.clear();
        for index in first..first + known.len() {
            function.results.push(Value(function.code.len() as u32));
            function.code.push(Op::Read(Source::Prepared(index as u32)));
        }
        function.results.extend(varying);
        function.shape = Shape::Vector(function.results.len());
        function.guards.clear();
    }
    let staged = program.staged_roles();
    let stages = probe.functions.iter_mut();
    for function in stages.filter(|function| staged.contains(&function.role)) {
        let varying: Vec<Value> = values(function);
        function.results.extend(varying);
        function.shape = Shape::Vector(function.results.len());
        function.guards.clear();
    }
    probe
}

/// The coordinates of the guards, in the order of [`with_guarded_values`].
pub(super) fn guarded_coordinates(program: &Program) -> Vec<usize> {
    let functions = [Some(&program.prepare), program.function(program.solving())];
    let guards = functions
        .into_iter()
        .flatten()
        .flat_map(|function| &function.guards);
    guards.map(|guard| guard.coordinate).collect()
}

/// The determinant of a symmetric matrix given by its lower triangle.
pub(super) fn determinant<R: Scalar>(lower: &[R], n: usize) -> R {
    let entry = |i: usize, j: usize| lower[Shape::index(i.max(j), i.min(j))];
    let row = |i: usize| (0..n).map(|j| entry(i, j)).collect();
    let mut left: Vec<Vec<R>> = (0..n).map(row).collect();
    let mut determinant = R::ONE;
    for k in 0..n {
        // Rows are exchanged, because a coordinate without inertia has no pivot on the diagonal.
        let Some(found) = (k..n).find(|&i| left[i][k] != R::ZERO) else {
            return R::ZERO;
        };
        if found != k {
            left.swap(found, k);
            determinant = -determinant;
        }
        let pivot = left[k].clone();
        determinant = determinant * pivot[k];
        for row in &mut left[k + 1..] {
            if row[k] != R::ZERO {
                let l = row[k] / pivot[k];
                for (x, y) in row.iter_mut().zip(&pivot).skip(k) {
                    *x = *x - l * *y;
                }
            }
        }
    }
    determinant
}
