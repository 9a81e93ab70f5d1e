//! Published equations, compared with the derived ones.

use lagrangian_symbolic::print::Sign;
use lagrangian_symbolic::{Expr, Math, math_as_built};

use super::{Chapter, READABLE, capitalized, code, counted, listed, paragraph, words};
use crate::compare::{Comparison, Quoted, SuperfluousDot, compare};
use crate::document::{Block, Row};

impl<'d> Chapter<'_, 'd> {
    pub(super) fn published(&self) -> Vec<Block> {
        let mut blocks = Vec::new();
        let comparisons = compare(self.model, &self.compiled.equations);
        for block in &self.model.published {
            let of_block = comparisons.iter().filter(|c| c.block == block.title);
            let (right, wrong): (Vec<_>, Vec<_>) = of_block.partition(|c| c.agrees);
            blocks.push(Block::Heading(words![block.title.clone()]));
            let text = format!(
                "{} compared with the derivation, of which {} to be changed.",
                capitalized(&counted(block.items.len(), "formula")),
                match wrong.len() {
                    0 => "none has".to_owned(),
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
        // Terms with the component to which they belong, in the order of the comparison.
        let (mut drop, mut add) = (Vec::new(), Vec::new());
        for (k, mend) in comparison.corrections.iter().enumerate() {
            let axis = match comparison.corrections.len() {
                1 => "",
                _ => [", x", ", y", ", z"][k % 3],
            };
            drop.extend(mend.drop.iter().map(|&term| (term, axis)));
            add.extend(mend.add.iter().map(|&term| (term, axis)));
        }
        let changes = comparison.changes();
        let [added, dropped] = comparison.terms();
        let side = |term: &Quoted| match (comparison.has_two_sides(), term.on_the_right) {
            (false, _) => "",
            (true, true) => ", on the right",
            (true, false) => ", on the left",
        };
        let mut rows = Vec::new();
        for SuperfluousDot { from, to, .. } in &comparison.superfluous_dots {
            let change = Math::text(from.clone()).then(Sign::To, Math::text(to.clone()));
            rows.extend(Row::lines(&change, 0, "change"));
        }
        for &(from, to) in &changes {
            let [left, right] = [
                self.quoted(drop[from].0, &dropped[from]),
                self.quoted(add[to].0, &added[to]),
            ];
            let note = format!("change{}{}", drop[from].1, side(&dropped[from]));
            rows.extend(Row::lines(&left.then(Sign::To, right), 0, &note));
        }
        let mut alone =
            |note: &str, terms: &[(Expr<'d>, &str)], quoted_terms: &[Quoted], changed: &[usize]| {
                for k in (0..terms.len()).filter(|k| !changed.contains(k)) {
                    let term = self.quoted(terms[k].0, &quoted_terms[k]);
                    let note = format!("{note}{}{}", terms[k].1, side(&quoted_terms[k]));
                    rows.extend(Row::lines(&term, 0, &note));
                }
            };
        let (from, to): (Vec<usize>, Vec<usize>) = changes.iter().copied().unzip();
        alone("add", &add, &added, &to);
        alone("drop", &drop, &dropped, &from);
        rows
    }

    /// A term on its side of the equation. Where algebra has simplified it, as ṫ to 1, it is shown as printed.
    fn quoted(&self, term: Expr<'d>, quoted_term: &Quoted) -> Math {
        let dots = |text: &str| text.matches("der(").count();
        let term = if quoted_term.on_the_right {
            -term
        } else {
            term
        };
        let is_lost = term.size() <= READABLE
            && dots(&quoted_term.text) != dots(&lagrangian_symbolic::text(term, self.model.dag));
        if is_lost {
            Math::text(quoted_term.text.clone())
        } else {
            self.shown(term)
        }
    }

    fn shown(&self, term: Expr<'d>) -> Math {
        match term.size() {
            0..=READABLE => math_as_built(term, self.model.dag),
            size => Math::text(format!("{size} symbols, not shown")),
        }
    }
}
