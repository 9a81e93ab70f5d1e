//! Comparison of accelerations, multipliers, derivatives, stages and pivots, by substitution into the equations of motion.

use super::number::{Number, ZeroTest};
use super::{Computed, Prover, Sum, Verdict, equal, has_dependent, is_dependent, row};
use crate::equations::literal::State;
use crate::proof::symbolic::{determinant, guarded_coordinates};
use crate::{Dependent, Disagreement};
use lagrangian_program::{Arguments, Role, Shape};
use lagrangian_scalar::{Dual, Scalar};
use lagrangian_spec::model::Variable;
use lagrangian_symbolic::Expr;

impl<'d, R: Number> Prover<'_, 'd, R> {
    /// Moves the coordinates that constraints determine to where these are satisfied; the
    /// constraints themselves show whether they are.
    pub(super) fn satisfy_constraints(&self, mut at: State<R>) -> Result<State<R>, Verdict> {
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
    pub(super) fn lower(&self, computed: &Computed<R>) -> Vec<R> {
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
    pub(super) fn has_no_accelerations(
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
    pub(super) fn check_motion(
        &mut self,
        at: &State<R>,
        computed: &Computed<R>,
    ) -> Result<(), Verdict> {
        let (n, m) = (at.q.len(), self.parts.program.constraints.len());
        let a = self.call(Role::Accelerations, at, n)?;
        let multipliers = self.call(Role::Multipliers, at, m)?;
        self.check_balance(computed, &a, &multipliers, &computed.forces)
    }

    /// Checks `M a = f + Gᵀλ` and `G a = γ` for given accelerations, multipliers and forces.
    pub(super) fn check_balance(
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

    /// Checks that the product of the pivots, one for each coordinate, is the determinant of `M`,
    /// and that each pivot is compared with its `Mᵢᵢ` or itself; with constraints the product is
    /// that of their matrix too, up to the signs of theirs.
    pub(super) fn check_pivots(
        &mut self,
        at: &State<R>,
        computed: &Computed<R>,
    ) -> Result<(), Verdict> {
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
    pub(super) fn check_derivatives(&mut self, at: &State<R>) -> Result<(), Verdict> {
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
    pub(super) fn check_stages(
        &mut self,
        at: &State<R>,
        computed: &Computed<R>,
    ) -> Result<(), Verdict> {
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
