//! Unilateral contacts: their gaps and rates, and what this chapter does not cover about them.

use lagrangian_symbolic::Math;

use super::{Chapter, words};
use crate::document::Block;

/// The largest number of contacts that are written out; of more, only the first ones are.
const MOST: usize = 12;

impl Chapter<'_, '_> {
    pub(super) fn unilateral(&self) -> Vec<Block> {
        let contacts = &self.compiled.equations.unilateral;
        if contacts.is_empty() {
            return Vec::new();
        }
        let mut blocks = vec![Block::Paragraph(words![
            "Everything above and below holds for the machine while these contacts are open. Gaps are never negative; where \
             one closes there is an impact, and while it stays closed the contact has a normal force and friction. \
             Statements on conserved energy and momentum exclude what impacts and friction take.",
        ])];
        for (k, contact) in contacts.iter().enumerate().take(MOST) {
            // The second tangent of a contact is described with the first.
            if contact.is_second_tangent {
                continue;
            }
            if contact.face.is_some() {
                blocks.push(Block::Heading(words!["Contact ", contact.name.clone()]));
                blocks.push(Block::Paragraph(words![
                    "A corner of a polygon against another polygon: which face it touches depends on the positions of both, (E77).",
                ]));
                continue;
            }
            let [normal, tangent] = &contact.directions;
            let rate = |index: &'static str| Math::letter('γ').with_index(Math::text(index));
            let mut rows = self.equality(Math::letter('g'), contact.gap, "gap");
            rows.extend(self.equality(rate("n"), normal.rate, "rate of opening"));
            if contact.has_friction {
                rows.extend(self.equality(rate("t"), tangent.rate, "rate of slip"));
            }
            if let Some(second) = contacts.get(k + 1).filter(|next| next.is_second_tangent) {
                let [_, tangent] = &second.directions;
                rows.extend(self.equality(rate("s"), tangent.rate, "slip along a second tangent"));
            }
            blocks.push(Block::Heading(words!["Contact ", contact.name.clone()]));
            blocks.push(Block::Formula(rows));
        }
        if contacts.len() > MOST {
            let text = format!("{} more contacts are left out here.", contacts.len() - MOST);
            blocks.push(Block::Paragraph(words![text]));
        }
        blocks
    }
}
