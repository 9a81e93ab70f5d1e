//! Sums of terms, in the form that has the fewest operations.

use std::collections::BTreeMap;

use super::work;
use lagrangian_symbolic::{Dag, Expr, Id, Node, Rational, Stage};
use rustc_hash::FxHashSet;

/// Sums are multiplied out up to this many terms; cancellations occur in short sums.
const LONGEST_EXPANSION: usize = 24;

/// The sums that are multiplied out.
#[derive(Clone, Copy)]
enum Expansion {
    /// Earlier totals that are factors of products.
    TotalsInProducts,
    /// Earlier totals that are factors of products, and those in the resulting products.
    Deep,
    /// Earlier totals.
    Totals,
    /// All sums.
    Sums,
}

impl Expansion {
    const ALL: [Expansion; 4] = [
        Expansion::TotalsInProducts,
        Expansion::Deep,
        Expansion::Totals,
        Expansion::Sums,
    ];
}

/// Adds up the remaining entries and loads.
pub(super) struct Totals<'d> {
    pub(super) dag: &'d Dag,
    /// The sums made here.
    pub(super) own_sums: FxHashSet<Id>,
    /// Whether any are multiplied out.
    pub(super) expands: bool,
}

impl<'d> Totals<'d> {
    /// The sum, with sums among its factors multiplied out if that makes it shorter: terms of
    /// several eliminations may cancel, but not while some of them are inside a product.
    pub(super) fn total(&mut self, terms: Vec<Expr<'d>>) -> Expr<'d> {
        let mut shortest = self.dag.sum(terms.iter().copied());
        if !self.expands {
            return shortest;
        }
        if terms.len() > 1 {
            for reach in Expansion::ALL {
                if let Some(candidate) = self.partly_expanded(&terms, reach)
                    && work(candidate) < work(shortest)
                {
                    shortest = candidate;
                }
            }
        }
        self.without_content(shortest)
    }

    /// The sum with those terms multiplied out that can cancel something; `None` if there are none,
    /// or if it is long.
    fn partly_expanded(&self, terms: &[Expr<'d>], reach: Expansion) -> Option<Expr<'d>> {
        let mut parts: Vec<Vec<Expr<'d>>> = Vec::with_capacity(terms.len());
        let mut len = 0;
        for &term in terms {
            parts.push(self.expanded(term, reach)?);
            len += parts.last().map_or(0, Vec::len);
        }
        let sum = |parts: &[Vec<Expr<'d>>]| self.dag.sum(parts.iter().flatten().copied());
        let mut shortest = sum(&parts);
        if len > LONGEST_EXPANSION || len == terms.len() || terms_of(shortest).len() == len {
            return None;
        }
        for (position, &term) in terms.iter().enumerate() {
            let expanded = std::mem::replace(&mut parts[position], vec![term]);
            let candidate = sum(&parts);
            if work(candidate) <= work(shortest) {
                shortest = candidate;
            } else {
                parts[position] = expanded;
            }
        }
        Some(shortest)
    }

    /// The term with sums among its factors multiplied out, unless the result is long.
    fn expanded(&self, term: Expr<'d>, reach: Expansion) -> Option<Vec<Expr<'d>>> {
        let mut done = Vec::new();
        let mut open = vec![term];
        while let Some(term) = open.pop() {
            let (coefficient, factors) = factors_of(term);
            let alone = factors.len() == 1;
            let may_expand = |&(factor, power): &(Id, i32)| {
                let total = power == 1 && self.own_sums.contains(&factor);
                match reach {
                    Expansion::TotalsInProducts | Expansion::Deep => total && !alone,
                    Expansion::Totals => total,
                    Expansion::Sums => {
                        let is_sum = matches!(self.dag.node(factor), Node::Sum(_));
                        let varies = self.dag.expr(factor).stage() > Stage::PARAMETER;
                        (1..=2).contains(&power) && is_sum && varies
                    }
                }
            };
            let (sums, rest): (Vec<_>, Vec<_>) = factors.into_iter().partition(may_expand);
            let rest = rest
                .into_iter()
                .map(|(factor, power)| self.dag.expr(factor).powi(power));
            let mut products = vec![self.dag.product(rest) * coefficient];
            for (sum, power) in &sums {
                let right = terms_of(self.dag.expr(*sum));
                for _ in 0..*power {
                    let all = products
                        .iter()
                        .flat_map(|&x| right.iter().map(move |&y| x * y));
                    products = all.collect();
                    if done.len() + open.len() + products.len() > LONGEST_EXPANSION {
                        return None;
                    }
                }
            }
            let again = matches!(reach, Expansion::Deep) && !sums.is_empty();
            if again {
                open.append(&mut products)
            } else {
                done.append(&mut products)
            }
        }
        Some(done)
    }

    /// Takes the common factors of the terms out of a sum.
    fn without_content(&mut self, total: Expr<'d>) -> Expr<'d> {
        let terms = terms_of(total);
        let mut common: BTreeMap<Id, i32> = factors_of(terms[0]).1.into_iter().collect();
        for &term in &terms[1..] {
            let powers: BTreeMap<Id, i32> = factors_of(term).1.into_iter().collect();
            common.retain(|id, power| {
                let other = powers.get(id).copied().unwrap_or(0);
                *power = if *power > 0 {
                    other.clamp(0, *power)
                } else {
                    other.clamp(*power, 0)
                };
                *power != 0
            });
        }
        if terms.len() < 2 || common.is_empty() {
            self.record_sum(total);
            return total;
        }
        let common = self.dag.product(
            common
                .into_iter()
                .map(|(id, power)| self.dag.expr(id).powi(power)),
        );
        let rest = self.dag.sum(terms.into_iter().map(|term| term / common));
        self.record_sum(rest);
        common * rest
    }

    /// Records that a sum may be multiplied out again.
    pub(super) fn record_sum(&mut self, sum: Expr<'d>) {
        if matches!(sum.node(), Node::Sum(terms) if terms.len() > 1) {
            self.own_sums.insert(sum.id());
        }
    }
}

/// The numerical coefficient and the factors of an expression.
pub(super) fn factors_of(e: Expr<'_>) -> (Rational, Vec<(Id, i32)>) {
    match e.node() {
        Node::Constant(value) => (value, Vec::new()),
        Node::Product(factors) => (Rational::ONE, factors.to_vec()),
        Node::Sum(terms) if terms.len() == 1 => {
            let (_, factors) = factors_of(e.dag().expr(terms[0].0));
            (terms[0].1.clone(), factors)
        }
        _ => (Rational::ONE, vec![(e.id(), 1)]),
    }
}

/// The terms of a sum or of a multiple of a sum; any other expression is its only term.
pub(super) fn terms_of(e: Expr<'_>) -> Vec<Expr<'_>> {
    let dag = e.dag();
    match e.node() {
        Node::Sum(terms) if terms.len() == 1 => {
            let inner = terms_of(dag.expr(terms[0].0));
            inner
                .into_iter()
                .map(|term| term * terms[0].1.clone())
                .collect()
        }
        Node::Sum(terms) => terms
            .iter()
            .map(|(id, c)| dag.expr(*id) * c.clone())
            .collect(),
        _ => vec![e],
    }
}
