//! Normal forms that are too large to keep: expanded polynomials, and the operations based on them.
//!
//! [`expand`] multiplies everything out into `Σ coefficient·monomial` over atoms: symbols, π, sines
//! and cosines of base angles, other functions, and denominators of several terms. Compound angles
//! are expanded by the addition theorem, multiple angles by the same; `sin²` is reduced to `1 −
//! cos²`; `sqrt(x)²` to `x`. So two expressions that are polynomials in symbols, sines and cosines
//! (and reciprocals of monomials) are equal exactly if their expansions are.
//!
//! Angles: if `q₁` occurs in angles as `q₁`, `2q₁` and `q₁/2`, its base angle is the greatest
//! common divisor `q₁/2`.
//!
//! In the other direction, [`Expanded::fold`] joins matching terms:
//! `cos a cos b + sin a sin b = cos(b − a)`, `1 − cos² a = sin² a`. [`readable`] returns the
//! shorter of the original and the result of expanding and folding. [`difference`] finds the terms
//! that must be added to one expression and dropped from it to get another.
//!
//! Expansion grows fast: every function here takes a budget, the largest number of terms of an
//! intermediate polynomial, and returns `None` beyond it.

mod angles;
mod expand;
mod fold;
mod polynomial;

use crate::arena::Arena;
use crate::dag::{Dag, Expr};
use crate::measure::{measure, total};
use crate::node::{Id, Node, Symbol};
use crate::rational::Rational;
use expand::Expander;
use polynomial::{Monomial, Polynomial};

/// The budget of [`readable`] in [`latex`](crate::latex()): nobody reads more terms than this.
pub const READABLE_BUDGET: usize = 500;

/// Expressions of a larger [`size`](Expr::size) are not made [`readable`], since nobody reads them either.
const READABLE_SIZE: u64 = 5000;

/// An expanded expression.
pub struct Expanded<'d> {
    dag: &'d Dag,
    polynomial: Polynomial,
}

/// Expands an expression.
///
/// `None` if it takes more terms than the budget, or has no value.
///
/// ```
/// use lagrangian_symbolic::{Dag, Stage, normal};
///
/// let dag = Dag::new();
/// let (x, y) = (dag.symbol("x", Stage(3)), dag.symbol("y", Stage(3)));
/// let e = (x + y).sin().square() + (x + y).cos() * (x.cos() * y.cos() - x.sin() * y.sin()) - 1;
/// assert!(normal::expand(e, 100).is_some_and(|e| e.is_zero()));
/// ```
pub fn expand(expression: Expr<'_>, budget: usize) -> Option<Expanded<'_>> {
    let [expanded] = expand_all([expression], budget)?;
    Some(expanded)
}

/// Expands several expressions over the same set of atoms.
fn expand_all<const N: usize>(
    expressions: [Expr<'_>; N],
    budget: usize,
) -> Option<[Expanded<'_>; N]> {
    let dag = expressions.first()?.dag();
    let arena = &mut *dag.arena.borrow_mut();
    let mut expander = Expander::new(arena, budget);
    let polynomials = expander.expand(&expressions.map(Expr::id))?;
    let expanded = polynomials
        .into_iter()
        .map(|polynomial| Expanded { dag, polynomial });
    expanded.collect::<Vec<_>>().try_into().ok()
}

impl<'d> Expanded<'d> {
    /// Coefficients and monomials, in a fixed order.
    pub fn terms(&self) -> Vec<(Rational, Expr<'d>)> {
        let arena = &mut *self.dag.arena.borrow_mut();
        let term = |(monomial, coefficient): (&Monomial, &Rational)| {
            let (scale, id) = arena.product_parts(monomial);
            (&scale * coefficient, self.dag.expr(id))
        };
        self.polynomial.iter().map(term).collect()
    }

    /// The number of terms.
    pub fn len(&self) -> usize {
        self.polynomial.len()
    }

    /// Whether it has no terms, that is, whether it is 0.
    pub fn is_empty(&self) -> bool {
        self.is_zero()
    }

    /// Whether it is 0.
    pub fn is_zero(&self) -> bool {
        self.polynomial.len() == 0
    }

    /// The sum of all terms.
    pub fn to_expr(&self) -> Expr<'d> {
        let arena = &mut *self.dag.arena.borrow_mut();
        self.dag.expr(self.polynomial.rebuild(arena))
    }

    /// The sum of all terms, with angles joined and terms of parameters collected.
    pub fn fold(&self) -> Expr<'d> {
        let arena = &mut *self.dag.arena.borrow_mut();
        self.dag
            .expr(fold::fold(arena, self.polynomial.clone()).rebuild(arena))
    }

    /// The terms grouped by the powers of some symbols: the monomials in these symbols, with the
    /// coefficient of each.
    ///
    /// They are in the order of the symbols, higher powers first; the terms free of them come last,
    /// with the monomial 1. A symbol inside a function does not count.
    pub fn collect(&self, by: &[Symbol]) -> Vec<(Expr<'d>, Expr<'d>)> {
        let arena = &mut *self.dag.arena.borrow_mut();
        // Negated powers in the order of the symbols sort higher powers of earlier symbols first.
        let mut groups: std::collections::BTreeMap<Vec<i32>, Polynomial> = Default::default();
        for (monomial, coefficient) in self.polynomial.iter() {
            let mut key = vec![0; by.len()];
            let mut rest = monomial.clone();
            rest.retain(|&(id, power)| match arena.node(id) {
                Node::Symbol(symbol) => match by.iter().position(|other| other == symbol) {
                    Some(place) => {
                        key[place] = -power;
                        false
                    }
                    None => true,
                },
                _ => true,
            });
            groups.entry(key).or_default().add(rest, coefficient);
        }
        let mut collected = Vec::new();
        for (key, polynomial) in groups {
            let symbols = by.iter().zip(&key).filter(|(_, power)| **power != 0);
            let factors: Vec<_> = symbols
                .map(|(symbol, power)| (arena.symbols[symbol.index()].id, -power))
                .collect();
            let monomial = arena.product(&factors);
            let coefficient = fold::fold(arena, polynomial).rebuild(arena);
            collected.push((self.dag.expr(monomial), self.dag.expr(coefficient)));
        }
        collected
    }
}

/// The expression expanded and grouped by the powers of some symbols; see [`Expanded::collect`].
pub fn collect<'d>(
    expression: Expr<'d>,
    by: &[Symbol],
    budget: usize,
) -> Option<Vec<(Expr<'d>, Expr<'d>)>> {
    Some(expand(expression, budget)?.collect(by))
}

/// The terms that turn one expression into another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference<'d> {
    /// Terms to add.
    pub add: Vec<Expr<'d>>,
    /// Terms to drop.
    pub drop: Vec<Expr<'d>>,
}

impl Difference<'_> {
    /// Whether the expressions are equal.
    pub fn is_empty(&self) -> bool {
        self.add.is_empty() && self.drop.is_empty()
    }
}

/// The terms to add to `printed`, and those to drop from it, to get `derived`:
/// `printed + Σ add − Σ drop = derived`.
///
/// A term with another coefficient is dropped as printed and added as derived. `None` if expanding
/// takes more terms than the budget, or if one of the expressions has no value. Empty means equal;
/// equal quotients by sums may not be recognized.
///
/// ```
/// use lagrangian_symbolic::{Dag, Stage, normal};
///
/// let dag = Dag::new();
/// let m = dag.symbol("m", Stage::PARAMETER);
/// let (q, v) = (dag.symbol("q", Stage(3)), dag.symbol("v", Stage(4)));
/// let printed = m * v + m * q.sin().square();
/// let derived = m * v + m * q.sin();
/// let difference = normal::difference(printed, derived, 100).expect("a few terms");
/// assert_eq!(difference.add, [m * q.sin()]);
/// assert_eq!(difference.drop, [m * q.sin().square()]);
/// ```
pub fn difference<'d>(
    printed: Expr<'d>,
    derived: Expr<'d>,
    budget: usize,
) -> Option<Difference<'d>> {
    let dag = printed.dag();
    let [printed, derived] = expand_all([printed, derived], budget)?;
    let arena = &mut *dag.arena.borrow_mut();
    let mut add = Vec::new();
    let mut drop = Vec::new();
    // Terms that differ only in sines and cosines are compared together: cos(a − b) printed instead
    // of cos(a + b) shares half of its products, but nobody would call it half right.
    let printed = printed.polynomial.grouped(|id| !is_circular(arena, id));
    let mut derived = derived.polynomial.grouped(|id| !is_circular(arena, id));
    let mut compare = |printed: &Polynomial, derived: &Polynomial| {
        let (mut more, mut less) = (Polynomial::default(), Polynomial::default());
        for (monomial, coefficient) in derived.iter() {
            if printed.coefficient(monomial) != Some(coefficient) {
                more.add(monomial.clone(), coefficient);
            }
        }
        for (monomial, coefficient) in printed.iter() {
            if derived.coefficient(monomial) != Some(coefficient) {
                less.add(monomial.clone(), coefficient);
            }
        }
        let mut folded = |polynomial: &Polynomial| fold::fold(arena, polynomial.clone());
        let termwise = [folded(&more), folded(&less)];
        let undivided = [folded(derived), folded(printed)];
        let changed = more.len() + less.len() > 0;
        let weight = |pair: &[Polynomial; 2]| pair[0].weight() + pair[1].weight();
        let [more, less] = if changed && weight(&undivided) < weight(&termwise) {
            undivided
        } else {
            termwise
        };
        add.push(more);
        drop.push(less);
    };
    for (rest, printed) in &printed {
        compare(printed, &derived.remove(rest).unwrap_or_default());
    }
    for derived in derived.values() {
        compare(&Polynomial::default(), derived);
    }
    let mut terms = |parts: Vec<Polynomial>| {
        let mut all = Polynomial::default();
        for part in &parts {
            all.add_multiple(part, &Rational::ONE);
        }
        let sum = all.rebuild(arena);
        split_terms(arena, sum)
            .into_iter()
            .map(|id| dag.expr(id))
            .collect()
    };
    Some(Difference {
        add: terms(add),
        drop: terms(drop),
    })
}

/// The shorter of the original and the result of expanding and folding, as a whole or for some of its terms.
///
/// The value is the same. Beyond the budget the expression stays as it is.
pub fn readable(expression: Expr<'_>, budget: usize) -> Expr<'_> {
    if expression.size() > READABLE_SIZE {
        return expression;
    }
    let dag = expression.dag();
    let mut best = expression;
    let mut offer = |candidate: Expr<'_>| {
        // In a tie prefer the expanded form, which is the usual one.
        if length(candidate) <= length(best) {
            best = dag.expr(candidate.id());
        }
    };
    // Terms that are shorter in their original form, such as ½ k (x − y)², are separated from the others.
    let terms = flat_terms(&dag.arena.borrow(), expression.id(), budget);
    let Some(terms) = terms else {
        return expression;
    };
    let terms: Vec<Expr<'_>> = terms
        .into_iter()
        .map(|(id, coefficient)| coefficient * dag.expr(id))
        .collect();
    let expanded = |e: Expr<'_>| Some(dag.expr(expand(e, budget)?.fold().id()));
    let gains = |&e: &Expr<'_>| expanded(e).is_some_and(|folded| length(folded) <= length(e));
    let (opened, kept): (Vec<_>, Vec<_>) = terms.into_iter().partition(gains);
    if !kept.is_empty() {
        let opened = dag.sum(opened);
        if let Some(folded) = expanded(opened) {
            let parts = split_terms(&mut dag.arena.borrow_mut(), folded.id());
            offer(dag.sum(parts.into_iter().map(|id| dag.expr(id)).chain(kept)));
        }
    }
    if let Some(folded) = expanded(expression) {
        offer(folded);
    }
    best
}

/// Moves the common factors of all terms of a sum out of it: `−m a − m b` becomes `−m (a + b)`.
///
/// The value is the same. An expression that is not a sum, has no common factors, or has more terms than the
/// budget stays as it is.
///
/// ```
/// use lagrangian_symbolic::{Dag, Stage, normal, text};
///
/// let dag = Dag::new();
/// let [m, n, l] = ["m", "n", "l"].map(|name| dag.symbol(name, Stage::PARAMETER));
/// let q = dag.symbol("q", Stage(3));
/// let e = dag.sum([-m * l.square() * q.sin(), -n * l * q.cos()]);
/// assert_eq!(text(normal::factored(e, 10), &dag), "-l*(m*l*sin(q) + n*cos(q))");
/// ```
pub fn factored(expression: Expr<'_>, budget: usize) -> Expr<'_> {
    let dag = expression.dag();
    let terms = flat_terms(&dag.arena.borrow(), expression.id(), budget);
    let Some(terms) = terms.filter(|terms| terms.len() > 1) else {
        return expression;
    };
    let factors = |id: Id| match dag.node(id) {
        Node::Product(factors) => factors.to_vec(),
        _ if id == Arena::ONE => Vec::new(),
        _ => vec![(id, 1)],
    };
    let mut common = factors(terms[0].0);
    common.retain(|&(_, power)| power > 0);
    for &(id, _) in &terms[1..] {
        let other = factors(id);
        common.retain_mut(|(factor, power)| {
            let found = other.iter().find(|(id, _)| id == factor);
            *power = found.map_or(0, |&(_, n)| n.min(*power));
            *power > 0
        });
    }
    let negative = terms
        .iter()
        .all(|(_, coefficient)| coefficient.is_negative());
    if common.is_empty() && !negative {
        return expression;
    }
    let common = dag.product(common.iter().map(|&(id, power)| dag.expr(id).powi(power)));
    let sign = if negative {
        Rational::MINUS_ONE
    } else {
        Rational::ONE
    };
    let rest = terms
        .iter()
        .map(|(id, coefficient)| dag.expr(*id) / common * (coefficient * &sign));
    dag.sum(rest) * common * sign.clone()
}

/// The length of an expression in print: symbols, functions and signs, and parentheses around sums.
/// Numbers count nothing: ½ a + ½ b is as good as ½ (a + b).
fn length(expression: Expr<'_>) -> u64 {
    let arena = expression.dag().arena.borrow();
    let parentheses = |id: Id| matches!(arena.node(id), Node::Sum(terms) if terms.len() > 1) as u64;
    measure(expression, |node, length| match node {
        Node::Constant(_) | Node::Pi | Node::Symbol(_) => 1,
        Node::Sum(terms) => total(terms.iter().map(|(x, c)| {
            let around = if c.abs().is_one() { 0 } else { parentheses(*x) };
            length(*x).saturating_add(1 + around)
        })),
        Node::Product(factors) => total(factors.iter().map(|&(x, n)| {
            let power = u64::from(n != 1);
            length(x).saturating_add(1 + power + parentheses(x))
        })),
        Node::Function(_, arguments) => {
            total(arguments.iter().map(|&x| length(x))).saturating_add(1)
        }
    })
}

/// The terms of a sum and of the sums in it that are added or subtracted as a whole; `None` beyond
/// the budget.
fn flat_terms(arena: &Arena, id: Id, budget: usize) -> Option<Vec<(Id, Rational)>> {
    let mut open = vec![(id, Rational::ONE)];
    let mut terms = Vec::new();
    while let Some((id, coefficient)) = open.pop() {
        match arena.node(id) {
            Node::Sum(inner) if inner.len() > 1 || coefficient.is_one() => {
                open.extend(inner.iter().rev().map(|(id, c)| (*id, c * &coefficient)));
            }
            _ => terms.push((id, coefficient)),
        }
        if open.len() + terms.len() > budget {
            return None;
        }
    }
    Some(terms)
}

/// The terms of a sum as expressions of their own; none for 0.
fn split_terms(arena: &mut Arena, id: Id) -> Vec<Id> {
    match arena.node(id).clone() {
        _ if id == Arena::ZERO => Vec::new(),
        Node::Sum(terms) if terms.len() > 1 => terms
            .iter()
            .map(|(id, coefficient)| arena.scaled(coefficient.clone(), *id))
            .collect(),
        _ => vec![id],
    }
}

fn is_circular(arena: &Arena, id: Id) -> bool {
    use crate::node::Function::{Cos, Sin};
    matches!(arena.node(id), Node::Function(Sin | Cos, _))
}
