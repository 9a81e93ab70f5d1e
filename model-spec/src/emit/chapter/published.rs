//! Equations that somebody printed, held against the derived ones.

use lagrangian_symbolic::print::Sign;
use lagrangian_symbolic::{Expr, Math, math_as_built};

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

    /// Terms to change, to add and to drop.
    fn changes(&self, comparison: &Comparison<'d>) -> Vec<Row> {
        // Terms with the axis that they belong to, in the order in which the comparison counts them.
        let (mut drop, mut add) = (Vec::new(), Vec::new());
        for (k, mend) in comparison.mend.iter().enumerate() {
            let axis = match comparison.mend.len() {
                1 => "",
                _ => [", x", ", y", ", z"][k % 3],
            };
            drop.extend(mend.drop.iter().map(|&term| (term, axis)));
            add.extend(mend.add.iter().map(|&term| (term, axis)));
        }
        let changes = comparison.changes();
        let mut rows = Vec::new();
        for &(from, to) in &changes {
            let change = self
                .shown(drop[from].0)
                .then(Sign::To, self.shown(add[to].0));
            rows.extend(Row::lines(&change, 0, &format!("change{}", drop[from].1)));
        }
        let mut alone = |note: &str, terms: &[(Expr<'d>, &str)], changed: &[usize]| {
            let left = (0..terms.len()).filter(|k| !changed.contains(k));
            for (term, axis) in left.map(|k| terms[k]) {
                rows.extend(Row::lines(&self.shown(term), 0, &format!("{note}{axis}")));
            }
        };
        let (from, to): (Vec<usize>, Vec<usize>) = changes.iter().copied().unzip();
        alone("add", &add, &to);
        alone("drop", &drop, &from);
        rows
    }

    fn shown(&self, term: Expr<'d>) -> Math {
        match term.size() {
            0..=READABLE => math_as_built(term, self.model.dag),
            size => Math::text(format!("{size} symbols, not shown")),
        }
    }
}
