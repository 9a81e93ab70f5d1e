//! Differences of terms with brackets, `½ c (y − x θ)²`, reported as such where that takes no more terms than
//! the expanded form.
//!
//! Formulas are compared in expanded form, so a bracket that is only written differently is no mistake. But to
//! correct `½ c (y − x θ)²`, a reader looks for this term in print, not for the `−c x y θ` that it contains.

use std::collections::{BTreeMap, BTreeSet};

use lagrangian_symbolic::normal::{self, Difference};
use lagrangian_symbolic::{Expr, Id, Node, Rational};

use super::changes;
use lagrangian_spec::model::stage;

/// The most terms of a bracket that is reported as such; longer ones are unreadable.
const BRACKET: usize = 3;

/// The most brackets that are considered: each requires another expansion.
const BRACKETS: usize = 32;

/// The terms to add to `printed` and to drop from it to obtain `right`, as few as possible.
///
/// Brackets that occur on both sides are cancelled first. Then these are kept unexpanded, each if the list does not
/// become longer: printed brackets together with right ones from which they differ by a misprint ([`changes`]),
/// then single printed ones, then single right ones. The last must also need no more symbols, because a reader
/// cannot find them in print. `None` if expansion exceeds the budget of terms.
pub(super) fn difference<'d>(
    printed: Expr<'d>,
    right: Expr<'d>,
    budget: usize,
) -> Option<Difference<'d>> {
    let sides = Sides::of(printed, right);
    let mut kept = BTreeSet::new();
    let mut best = sides.difference(&kept, budget)?;
    for candidates in sides.candidates() {
        if candidates.iter().any(|bracket| kept.contains(bracket)) {
            continue;
        }
        let is_printed = candidates[0].0 == PRINTED;
        let more: BTreeSet<BracketId> = kept.iter().copied().chain(candidates).collect();
        if let Some(found) = sides.difference(&more, budget)
            && (terms_in(&found) < terms_in(&best)
                || terms_in(&found) == terms_in(&best)
                    && (is_printed || symbols_in(&found) <= symbols_in(&best)))
        {
            (best, kept) = (found, more);
        }
    }
    Some(best)
}

fn terms_in(difference: &Difference<'_>) -> usize {
    difference.add.len() + difference.drop.len()
}

fn symbols_in(difference: &Difference<'_>) -> u64 {
    let terms = difference.add.iter().chain(&difference.drop);
    terms.map(|term| term.size()).sum()
}

/// A bracket: its side, and its index among the brackets of that side.
type BracketId = (usize, usize);

const PRINTED: usize = 0;
const RIGHT: usize = 1;

/// The terms of the printed formula and of the right one.
struct Sides<'d> {
    /// The terms with brackets, of both.
    brackets: [Vec<Expr<'d>>; 2],
    /// The other terms, of both.
    other_terms: [Vec<Expr<'d>>; 2],
}

impl<'d> Sides<'d> {
    fn of(printed: Expr<'d>, right: Expr<'d>) -> Sides<'d> {
        let split = |formula| {
            terms(formula)
                .into_iter()
                .partition(|&term| has_bracket(term))
        };
        let (printed, printed_rest): (Vec<_>, Vec<_>) = split(printed);
        let (right, right_rest): (Vec<_>, Vec<_>) = split(right);
        Sides {
            brackets: [without(&printed, &right), without(&right, &printed)],
            other_terms: [printed_rest, right_rest],
        }
    }

    /// Candidates for keeping: pairs that differ by a misprint, then each bracket alone.
    fn candidates(&self) -> Vec<Vec<BracketId>> {
        let [printed, right] = &self.brackets;
        if printed.len() + right.len() > BRACKETS {
            return Vec::new();
        }
        let pairs = changes::pairs(printed, right).into_iter();
        let pairs = pairs.map(|(drop, add)| vec![(PRINTED, drop), (RIGHT, add)]);
        let alone = |side: usize| (0..self.brackets[side].len()).map(move |k| vec![(side, k)]);
        pairs.chain(alone(PRINTED)).chain(alone(RIGHT)).collect()
    }

    /// The difference with these brackets kept, and all others expanded.
    fn difference(&self, kept: &BTreeSet<BracketId>, budget: usize) -> Option<Difference<'d>> {
        let part = |side: usize, is_kept: bool| {
            let numbered = self.brackets[side].iter().copied().enumerate();
            numbered
                .filter_map(move |(k, term)| (kept.contains(&(side, k)) == is_kept).then_some(term))
        };
        let dag = self
            .other_terms
            .iter()
            .chain(&self.brackets)
            .flatten()
            .next()?
            .dag();
        let open = [PRINTED, RIGHT]
            .map(|side| dag.sum(part(side, false).chain(self.other_terms[side].iter().copied())));
        let rest = normal::difference(open[PRINTED], open[RIGHT], budget)?;
        Some(Difference {
            add: part(RIGHT, true).chain(rest.add).collect(),
            drop: part(PRINTED, true).chain(rest.drop).collect(),
        })
    }
}

/// The terms of a list that are not in the other; repeated terms cancel as often as they occur in both.
fn without<'d>(list: &[Expr<'d>], other: &[Expr<'d>]) -> Vec<Expr<'d>> {
    let mut common: BTreeMap<Id, usize> = BTreeMap::new();
    for term in other {
        *common.entry(term.id()).or_default() += 1;
    }
    let mut is_common = |term: &Expr<'d>| match common.get_mut(&term.id()) {
        Some(count) if *count > 0 => {
            *count -= 1;
            true
        }
        _ => false,
    };
    let left = list.iter().copied().filter(|term| !is_common(term));
    left.collect()
}

/// The terms of a formula as built, with nested sums that are added or subtracted as a whole flattened.
fn terms(formula: Expr<'_>) -> Vec<Expr<'_>> {
    let dag = formula.dag();
    let mut open = vec![formula];
    let mut terms = Vec::new();
    while let Some(term) = open.pop() {
        match term.node() {
            Node::Sum(inner) if inner.len() > 1 => {
                open.extend(inner.iter().rev().map(|(id, c)| dag.expr(*id) * c.clone()));
            }
            // −(a + b)
            Node::Sum(inner) if inner.len() == 1 && inner[0].1 == Rational::MINUS_ONE => {
                match dag.node(inner[0].0) {
                    Node::Sum(inside) => {
                        open.extend(
                            inside
                                .iter()
                                .rev()
                                .map(|(id, c)| -(dag.expr(*id) * c.clone())),
                        );
                    }
                    _ => terms.push(term),
                }
            }
            _ => terms.push(term),
        }
    }
    terms
}

/// Whether a term has a short sum that depends on the motion as a factor, and no long one.
fn has_bracket(term: Expr<'_>) -> bool {
    let dag = term.dag();
    let product = match term.node() {
        Node::Sum(inner) if inner.len() == 1 => dag.expr(inner[0].0),
        _ => term,
    };
    let lengths = |factor: Expr<'_>| match factor.node() {
        Node::Sum(terms) if factor.stage() > stage::PARAMETER => terms.len(),
        _ => 0,
    };
    let longest = match product.node() {
        Node::Product(factors) => {
            let factors = factors.iter().map(|&(id, _)| lengths(dag.expr(id)));
            factors.max().unwrap_or(0)
        }
        _ => lengths(product),
    };
    (2..=BRACKET).contains(&longest)
}
