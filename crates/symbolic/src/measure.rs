//! Measures of expressions in written-out form: shared parts count every time they occur.

use crate::arena::Arena;
use crate::dag::Expr;
use crate::node::{Id, Node};

impl Expr<'_> {
    /// The number of symbols, numbers and operations of the expression in written-out form.
    pub fn size(self) -> u64 {
        measure(self, |node, size| match node {
            Node::Constant(_) | Node::Pi | Node::Symbol(_) => 1,
            // A sign before every term; a coefficient is a number and an operation.
            Node::Sum(terms) => total(terms.iter().map(|(x, c)| {
                let plain = c.abs().is_one() || *x == Arena::ONE;
                size(*x).saturating_add(if plain { 1 } else { 3 })
            })),
            Node::Product(factors) => total(
                factors
                    .iter()
                    .map(|&(x, n)| size(x).saturating_add(if n == 1 { 1 } else { 2 })),
            ),
            Node::Function(_, arguments) => {
                total(arguments.iter().map(|&x| size(x))).saturating_add(1)
            }
        })
    }
}

/// A measure of a node by the measures of its children, from the leaves to the root.
pub(crate) fn measure(
    expression: Expr<'_>,
    of_node: impl Fn(&Node, &dyn Fn(Id) -> u64) -> u64,
) -> u64 {
    let arena = expression.dag().arena.borrow();
    let needed = arena.reachable([expression.id()].into_iter(), |_| true);
    let mut measures: Vec<u64> = Vec::with_capacity(needed.len());
    for &id in &needed {
        let of = |child| {
            needed
                .binary_search(&child)
                .map_or(0, |place| measures[place])
        };
        let measure = of_node(arena.node(id), &of);
        measures.push(measure);
    }
    measures.last().copied().unwrap_or(0)
}

/// The sum of measures, saturating.
pub(crate) fn total(measures: impl Iterator<Item = u64>) -> u64 {
    measures.fold(0, u64::saturating_add)
}
