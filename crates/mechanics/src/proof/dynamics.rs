//! Comparison of energies, forces, constraints and outputs with the literal equations.

use super::number::Number;
use super::{Computed, Prover, Sum, Verdict, equal, first_difference, row};
use crate::equations::literal::{Literal, State};
use crate::quantities::{LiterallyAt, literal_values};
use lagrangian_program::quantity::Needs;
use lagrangian_program::{Role, Shape};
use lagrangian_symbolic::Expr;

impl<'d, R: Number> Prover<'_, 'd, R> {
    /// Compares the quantities whose numbers the literal equations give one by one.
    pub(super) fn check_values(
        &mut self,
        state: &State<R>,
        literal: &Literal<R>,
    ) -> Result<(), Verdict> {
        let machine = self.parts.machine;
        let values = literal_values(&LiterallyAt {
            machine,
            state,
            literal,
        });
        for (role, expected) in values {
            let function = self.parts.program.function(role);
            if function.is_some_and(|function| function.results.len() != expected.len()) {
                return Err(self.disagreement_at(role, 0));
            }
            if function.is_none() && role.row().needs == Needs::Request {
                continue;
            }
            let found = self.call(role, state, expected.len())?;
            for (index, (found, expected)) in found.into_iter().zip(expected).enumerate() {
                self.compare(role, index, found, expected)?;
            }
        }
        Ok(())
    }

    /// Compares `M`, `h`, `Q` and `f`.
    pub(super) fn check_dynamics(
        &mut self,
        at: &State<R>,
        w: &[R],
        literal: &Literal<R>,
        computed: &Computed<R>,
    ) -> Result<(), Verdict> {
        let n = w.len();
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
    pub(super) fn literal(&self, at: &State<R>, i: usize) -> Literal<R> {
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

    /// Compares the power of drives by the balance of energy, which holds for any
    /// accelerations: `d(T + V + E)/dt = P − R + v·(M a − f)`. If constraints are rheonomic, their
    /// power is in `P` and the last term is absent.
    pub(super) fn check_power(
        &mut self,
        at: &State<R>,
        literal: &Literal<R>,
        computed: &Computed<R>,
    ) -> Result<(), Verdict> {
        let model = self.parts.machine.model;
        let n = at.q.len();
        // This is compared with the literal equations before.
        let lost = self.call(Role::DissipationRate, at, 1)?[0];
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

    pub(super) fn check_constraints(
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
        for (k, constraint) in literal.constraints.iter().enumerate() {
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

    /// Compares outputs, assumptions and the start. An output may have no value here.
    pub(super) fn check_outputs_and_start(
        &mut self,
        at: &State<R>,
        facts: &[R],
    ) -> Result<(), Verdict> {
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
}
