//! Terms with brackets, `½ c (y − x θ)²`, told as such where that takes no more terms than telling
//! what comes out of them.
//!
//! Formulas are compared multiplied out: a bracket that is only written otherwise is no mistake.
//! But who has to mend `½ c (y − x θ)²` looks for that in the print, and not for the `−c x y θ`
//! that is in it.

use std::collections::{BTreeMap, BTreeSet};

use lagrangian_symbolic::normal::{self, Difference};
use lagrangian_symbolic::{Expr, Id, Node, Rational};

use super::changes;
use lagrangian_spec::model::stage;

/// The most terms in a bracket that is told as such: nobody reads more.
const BRACKET: usize = 3;

/// The most brackets that are considered: each costs multiplying out once more.
const BRACKETS: usize = 32;

/// What to add to `printed`, and what to drop from it, to get `right`, in as few terms as possible.
///
/// Brackets that stand on both sides are struck out first. Then printed brackets are kept together
/// with right ones from which they differ by a slip ([`changes`]), then single printed ones, then
/// single right ones; each if that makes the list no longer, and of the last, which nobody can look
/// for in the print, if it also takes no more symbols. `None` if multiplying out takes more terms
/// than the budget.
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
        let more: BTreeSet<Place> = kept.iter().copied().chain(candidates).collect();
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

/// A bracket: which side it stands on, and where among the brackets of that side.
type Place = (usize, usize);

const PRINTED: usize = 0;
const RIGHT: usize = 1;

/// The printed formula and the right one, term by term.
struct Sides<'d> {
    /// The terms with brackets of either.
    brackets: [Vec<Expr<'d>>; 2],
    /// The other terms of either.
    rest: [Vec<Expr<'d>>; 2],
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
            rest: [printed_rest, right_rest],
        }
    }

    /// What may be kept: pairs that differ by a slip, then each bracket alone.
    fn candidates(&self) -> Vec<Vec<Place>> {
        let [printed, right] = &self.brackets;
        if printed.len() + right.len() > BRACKETS {
            return Vec::new();
        }
        let pairs = changes::pairs(printed, right).into_iter();
        let pairs = pairs.map(|(drop, add)| vec![(PRINTED, drop), (RIGHT, add)]);
        let alone = |side: usize| (0..self.brackets[side].len()).map(move |k| vec![(side, k)]);
        pairs.chain(alone(PRINTED)).chain(alone(RIGHT)).collect()
    }

    /// The difference with some of the brackets kept, and all others multiplied out.
    fn difference(&self, kept: &BTreeSet<Place>, budget: usize) -> Option<Difference<'d>> {
        let part = |side: usize, is_kept: bool| {
            let numbered = self.brackets[side].iter().copied().enumerate();
            numbered
                .filter_map(move |(k, term)| (kept.contains(&(side, k)) == is_kept).then_some(term))
        };
        let dag = self
            .rest
            .iter()
            .chain(&self.brackets)
            .flatten()
            .next()?
            .dag();
        let open = [PRINTED, RIGHT]
            .map(|side| dag.sum(part(side, false).chain(self.rest[side].iter().copied())));
        let rest = normal::difference(open[PRINTED], open[RIGHT], budget)?;
        Some(Difference {
            add: part(RIGHT, true).chain(rest.add).collect(),
            drop: part(PRINTED, true).chain(rest.drop).collect(),
        })
    }
}

/// The terms of a list that are not in another one as well; a term that is twice in one is struck
/// out as often as it is in the other.
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

/// The terms of a formula as it is built, sums that are added or subtracted as a whole opened.
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

/// Whether a term has a factor that is a short sum of what moves, and none that is a long one.
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
