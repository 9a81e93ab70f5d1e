//! Compares the projection onto the constraints.

use super::number::Number;
use super::symbolic::determinant;
use super::{Computed, Prover, Sum, Verdict, row};
use crate::equations::literal::State;
use lagrangian_program::{ProjectionLayout, Role, Shape};

impl<R: Number> Prover<'_, '_, R> {
    /// Checks the residuals, the rows and the inertias against the functions that were compared with the equations, and the moves by
    /// substitution: `M d = Gᵀ μ` and `G d = −g`, and the same of rates. The product of the pivots must be the determinant of `G M⁻¹ Gᵀ`, and
    /// each compliance its diagonal element, both by determinants of the bordered matrix.
    pub(super) fn check_projection(
        &mut self,
        at: &State<R>,
        computed: &Computed<R>,
    ) -> Result<(), Verdict> {
        let (role, n) = (Role::Projection, at.q.len());
        let m = self.parts.program.constraints.len();
        if self.parts.program.function(role).is_none() {
            return Ok(());
        }
        let layout = ProjectionLayout {
            coordinates: n,
            constraints: m,
        };
        let found = self.call(role, at, layout.len())?;
        let positions = self.call(Role::ConstraintPositions, at, m)?;
        let rates = self.call(Role::ConstraintRates, at, m)?;
        let inertias = (0..n).map(|i| computed.mass_matrix[Shape::index(i, i)]);
        let inertias: Vec<R> = inertias.collect();
        let known = [
            (layout.positions(), &positions),
            (layout.rates(), &rates),
            (layout.matrix(), &computed.rows),
            (layout.inertias(), &inertias),
        ];
        for (places, expected) in known {
            for (index, expected) in places.zip(expected) {
                self.compare(role, index, found[index], *expected)?;
            }
        }
        let moves = [
            (
                layout.moves_of_coordinates(),
                layout.multipliers_of_coordinates(),
                &positions,
            ),
            (
                layout.moves_of_rates(),
                layout.multipliers_of_rates(),
                &rates,
            ),
        ];
        for (places, multipliers, residuals) in moves {
            let (moves, multipliers) = (&found[places.clone()], &found[multipliers]);
            for (row, residual) in computed.rows.chunks(n.max(1)).zip(residuals) {
                let left = Sum::products(row, moves).plus(*residual);
                self.compare_difference(role, places.start, left)?;
            }
            for i in 0..n {
                let inertial: Vec<R> = row(&computed.mass_matrix, n, i).collect();
                let mut left = Sum::products(&inertial, moves);
                for (row, multiplier) in computed.rows.chunks(n).zip(multipliers) {
                    left = left.plus(-(row[i] * *multiplier));
                }
                self.compare_difference(role, places.start + i, left)?;
            }
        }
        // The determinant of M bordered by some rows is that of M times that of −G M⁻¹ Gᵀ for these rows.
        let own = determinant(&computed.mass_matrix, n);
        let bordered = |rows: &[R]| {
            let mut lower = computed.mass_matrix.clone();
            for (k, row) in rows.chunks(n.max(1)).enumerate() {
                lower.extend(row);
                lower.extend(vec![R::ZERO; k + 1]);
            }
            determinant(&lower, n + rows.len() / n.max(1))
        };
        let pivots = found[layout.pivots()].iter();
        let product = pivots.fold(own, |product, pivot| product * -*pivot);
        let all = Sum::of([product, -bordered(&computed.rows)]);
        self.compare_difference(role, layout.pivots().start, all)?;
        for (index, row) in layout.compliances().zip(computed.rows.chunks(n.max(1))) {
            let one = Sum::of([own * found[index], bordered(row)]);
            self.compare_difference(role, index, one)?;
        }
        Ok(())
    }
}
