//! Guided contacts: their slip, their normal reactions, and their friction.

use lagrangian_symbolic::print::{Form, Mark, Sign};
use lagrangian_symbolic::{Expr, Math};

use super::{Chapter, words};
use crate::document::{Block, Row};
use lagrangian_mechanics::{Reaction, SlidingEquation};

impl<'d> Chapter<'_, 'd> {
    pub(super) fn contacts(&self) -> Vec<Block> {
        let contacts = &self.compiled.equations.sliding;
        if contacts.is_empty() {
            return Vec::new();
        }
        let letter = Math::letter;
        let size = |x: Math| Math::form(Form::Bars, [x]);
        let sign = Math::mark(Mark::Function("sgn"));
        let sign = sign.then(Sign::Apply, letter('w'));
        let slides = Math::sign(Sign::Negative);
        let slides = Math::row([slides, letter('μ') * size(letter('N')) * sign]);
        let slides = letter('F').equals(slides);
        let mut blocks = vec![
            Block::Paragraph(words![
                "The friction ",
                letter('F'),
                " of a contact that slides with the velocity ",
                letter('w'),
                " is",
            ]),
            Block::Formula(Row::lines(&slides, 0, "")),
            Block::Paragraph(words![
                "and that of a contact that sticks is whatever holds it, up to ",
                letter('μ').with_index(Math::number(0)) * size(letter('N')),
                ". The normal reaction ",
                letter('N'),
                " is the force that keeps the guide closed: it follows from the equation of a displacement along its normal. It \
                 depends on the accelerations, and so friction changes the matrix that multiplies them.",
            ]),
        ];
        if contacts.iter().any(|contact| contact.is_second()) {
            let on_surface = Math::row([
                Math::sign(Sign::Negative),
                letter('μ') * size(letter('N')) * Math::fraction(letter('w'), size(letter('w'))),
            ]);
            blocks.push(Block::Paragraph(words![
                "On a surface ",
                letter('w'),
                " and ",
                letter('F'),
                " have a component along each of two tangents, ",
                letter('F').equals(on_surface),
                ", and a contact that sticks is held by both together.",
            ]));
        }
        for (number, contact) in contacts.iter().enumerate() {
            blocks.extend(self.contact(number, contact));
        }
        blocks
    }

    fn contact(&self, number: usize, contact: &SlidingEquation<'d>) -> Vec<Block> {
        let heading = Block::Heading(words!["Contact ", contact.name.clone()]);
        let letter = Math::letter;
        let mut rows = self.equality(letter('w'), contact.slip, "slip");
        let constraints = &self.compiled.equations.constraints;
        let multipliers: Vec<Expr<'d>> = constraints.iter().map(|one| one.multiplier).collect();
        let normals = if contact.is_second() {
            // The second tangent is described with the first.
            Vec::new()
        } else {
            contact.normal(self.model, &multipliers)
        };
        let components = normals.len();
        for (normal, axis) in normals.into_iter().zip(['x', 'y', 'z']) {
            let name = match components {
                1 => letter('N'),
                _ => letter('N').with_index(letter(axis)),
            };
            rows.extend(self.equality(name, normal, "normal reaction"));
        }
        rows.extend(self.equality(letter('μ'), contact.friction, ""));
        if contact.static_friction != contact.friction {
            let name = letter('μ').with_index(Math::number(0));
            rows.extend(self.equality(name, contact.static_friction, ""));
        }
        for (coordinate, &entry) in self.model.coordinates.iter().zip(&contact.row) {
            if !entry.is_zero() {
                let on = self.name(coordinate.q);
                let force = letter('Q').with_index(on);
                let entry = if entry.is_one() {
                    letter('F')
                } else {
                    self.math(entry) * letter('F')
                };
                rows.extend(Row::lines(&force.equals(entry), 0, "its generalized force"));
            }
        }
        let mut blocks = vec![heading, Block::Formula(rows)];
        let by_others = |reaction: &Reaction<'d>| {
            let mut by = reaction.by_friction_forces.iter().enumerate();
            by.any(|(other, by)| other != number && !by.is_zero())
        };
        if contact.reactions.iter().any(by_others) {
            blocks.push(Block::Paragraph(words![
                "The friction forces of other contacts also press on this guide; their effect is left out of ",
                letter('N'),
                " here.",
            ]));
        }
        blocks
    }
}
