//! Bilateral constraints: their equations, the conditions on accelerations that follow, and their reactions.

use lagrangian_symbolic::{Expr, Math};

use super::{Chapter, words};
use crate::document::{Block, Row};
use lagrangian_mechanics::ConstraintEquation;

/// The largest number of constraints that are written out; of more, only the first ones are.
const MOST: usize = 12;

impl<'d> Chapter<'_, 'd> {
    pub(super) fn constraints(&self) -> Vec<Block> {
        let constraints = &self.compiled.equations.constraints;
        if constraints.is_empty() {
            return Vec::new();
        }
        let bold = Math::bold;
        let matrix = || Math::bold('G');
        let lambda = || bold('λ');
        let transposed = || matrix().power(Math::letter('T'));
        let first = (bold('M') * bold('a')).equals(bold('f') + transposed() * lambda());
        let second = (matrix() * bold('a')).equals(bold('γ'));
        let mut formulas = Row::lines(&first, 0, "");
        formulas.extend(Row::lines(&second, 0, ""));
        let mut blocks = vec![
            Block::Paragraph(words![
                "The reactions of the constraints are on the right-hand side of the equations above, and are as large as the \
                 conditions on the accelerations require (Lagrange's equations of the first kind):",
            ]),
            Block::Formula(formulas),
            Block::Paragraph(words![
                "where a row of ",
                matrix(),
                " is the derivative of a constraint with respect to the coordinates, or to the rates for a constraint on rates, \
                 and ",
                bold('γ'),
                " keeps the rate of the constraint unchanged.",
            ]),
        ];
        for constraint in constraints.iter().take(MOST) {
            blocks.extend(self.constraint(constraint));
        }
        if constraints.len() > MOST {
            let text = format!(
                "{} more constraints are left out here.",
                constraints.len() - MOST
            );
            blocks.push(Block::Paragraph(words![text]));
        }
        blocks.push(Block::Paragraph(words!["The generalized reactions:"]));
        let reactions = self.reactions().into_iter();
        let reactions = reactions.filter(|(_, reaction)| !reaction.is_zero());
        let reactions = reactions.flat_map(|(index, reaction)| {
            let q = self.name(self.model.coordinates[index].q);
            self.equality(Math::letter('R').with_index(q), reaction, "")
        });
        blocks.push(Block::Formula(reactions.collect()));
        blocks
    }

    /// The constraint function, its row of G and its γ.
    fn constraint(&self, constraint: &ConstraintEquation<'d>) -> Vec<Block> {
        let heading = Block::Heading(words!["Constraint ", constraint.name.clone()]);
        let mut rows = match constraint.position {
            Some(position) => self.equality(Math::letter('g'), position, "0 throughout"),
            None => self.equality(Math::letter('φ'), constraint.rate, "0 throughout, on rates"),
        };
        for (coordinate, &entry) in self.model.coordinates.iter().zip(&constraint.row) {
            if !entry.is_zero() {
                let name = Math::letter('G').with_index(self.name(coordinate.q));
                rows.extend(self.equality(name, entry, ""));
            }
        }
        rows.extend(self.equality(Math::letter('γ'), constraint.bias, ""));
        vec![heading, Block::Formula(rows)]
    }

    /// `Gᵀ λ` by coordinate.
    fn reactions(&self) -> Vec<(usize, Expr<'d>)> {
        let constraints = &self.compiled.equations.constraints;
        let on = |index: usize| {
            let forces = constraints.iter().map(|c| c.row[index] * c.multiplier);
            self.model.dag.sum(forces)
        };
        (0..self.model.coordinates.len())
            .map(|index| (index, on(index)))
            .collect()
    }
}
