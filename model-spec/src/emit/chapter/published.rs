//! Equations that somebody printed, held against the derived ones.

use lagrangian_symbolic::Math;

use super::{Chapter, READABLE, capital, code, counted, listed, paragraph, words};
use crate::compare::{Comparison, compare};
use crate::emit::document::{Block, Row};

impl<'d> Chapter<'_, 'd> {
    pub(super) fn published(&self) -> Vec<Block> {
        let mut blocks = Vec::new();
        let comparisons = compare(self.model, &self.compiled.equations);
        for block in &self.model.published {
            let of_block = comparisons.iter().filter(|c| c.block == block.title);
            let (right, wrong): (Vec<_>, Vec<_>) = of_block.partition(|c| c.agrees);
            blocks.push(Block::Heading(words![block.title.clone()]));
            let text = format!(
                "{} held against the derivation, of which {} to be changed.",
                capital(&counted(block.items.len(), "formula")),
                match wrong.len() {
                    1 => "one has".to_owned(),
                    n => format!("{} have", counted(n, "").trim_end_matches(['s', ' '])),
                }
            );
            blocks.push(Block::Paragraph(words![text]));
            if !right.is_empty() {
                let names = right.iter().map(|c| words![code(&c.item)]);
                let verb = if right.len() == 1 {
                    " agrees."
                } else {
                    " agree."
                };
                blocks.push(paragraph([listed(names), words![verb]]));
            }
            for comparison in wrong {
                blocks.push(paragraph([words![
                    code(&comparison.item),
                    " should be changed:"
                ]]));
                blocks.push(Block::Formula(self.changes(comparison)));
            }
        }
        blocks
    }

    /// Terms to add and to drop, component by component.
    fn changes(&self, comparison: &Comparison<'d>) -> Vec<Row> {
        let axes = ['x', 'y', 'z'];
        let mut rows = Vec::new();
        for (k, mend) in comparison.mend.iter().enumerate() {
            for (terms, note) in [(&mend.add, "add"), (&mend.drop, "drop")] {
                let size = terms
                    .iter()
                    .fold(0, |size: u64, term| size.saturating_add(term.size()));
                let sum = match size {
                    _ if terms.is_empty() => continue,
                    0..=READABLE => self.math(self.model.dag.sum(terms.iter().copied())),
                    _ => Math::text(format!("{size} symbols, not shown")),
                };
                let note = match comparison.mend.len() {
                    1 => note.to_owned(),
                    _ => format!("{note}, {}", axes[k % 3]),
                };
                rows.extend(Row::lines(&sum, 0, &note));
            }
        }
        rows
    }
}
