//! The common parts of both printers: terms with their signs, fractions, and the order of both.

use core::cmp::Reverse;

use crate::arena::Arena;
use crate::node::{Function, Id, Node, Stage};
use crate::rational::Rational;
use crate::sorting::sort_by_key;

/// A term `±scale·node` of a sum.
pub(super) struct Term {
    pub(super) negative: bool,
    /// The magnitude of the coefficient.
    pub(super) scale: Rational,
    /// The node; 1 for the constant term.
    pub(super) id: Id,
}

/// A product, as a quotient of positive powers.
pub(super) struct Fraction {
    pub(super) above: Vec<(Id, u32)>,
    pub(super) below: Vec<(Id, u32)>,
}

/// The terms of a sum, in printing order. If `flat`, sums in it that are added or subtracted as a
/// whole are opened.
pub(super) fn terms(arena: &Arena, terms: &[(Id, Rational)], flat: bool) -> Vec<Term> {
    let mut open: Vec<(Id, Rational)> = terms.iter().rev().cloned().collect();
    let mut shown = Vec::new();
    while let Some((id, coefficient)) = open.pop() {
        match arena.node(id) {
            Node::Sum(inner) if flat && coefficient.abs().is_one() => {
                open.extend(inner.iter().rev().map(|(id, c)| (*id, c * &coefficient)));
            }
            _ => shown.push((id, coefficient)),
        }
    }
    if flat {
        // Terms from different opened sums may be alike.
        sort_by_key(&mut shown, |(id, _)| *id);
        shown.dedup_by(|(id, coefficient), (kept, sum)| {
            let same = id == kept;
            if same {
                *sum = &*sum + &*coefficient;
            }
            same
        });
        shown.retain(|(_, coefficient)| !coefficient.is_zero());
    }
    shown.sort_by_cached_key(|(id, _)| (term_key(arena, *id), *id));
    // 1 − cos x rather than −cos x + 1.
    if let Some(first) = shown
        .iter()
        .position(|(_, coefficient)| !coefficient.is_negative())
    {
        shown[..=first].rotate_right(1);
    }
    let term = |(id, coefficient): (Id, Rational)| Term {
        negative: coefficient.is_negative(),
        scale: coefficient.abs(),
        id,
    };
    shown.into_iter().map(term).collect()
}

/// The order of factors.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Order {
    /// (m₁ + m₂)*l*s*cos(φ)*ṡ: by stage; sums of parameters first, other sums last.
    Stages,
    /// (m₁ + m₂) l s ṡ cos φ: factors with parentheses come before functions, which would take the next factor as a
    /// part of their argument.
    FunctionsLast,
}

/// The node as a fraction, with factors in printing order; 1 has no factors.
pub(super) fn fraction(arena: &Arena, id: Id, order: Order) -> Fraction {
    let alone = [(id, 1)];
    let factors = match arena.node(id) {
        Node::Product(factors) => factors,
        _ if id == Arena::ONE => &[][..],
        _ => &alone,
    };
    let side = |wanted: bool| {
        let mut side: Vec<(Id, u32)> = factors
            .iter()
            .filter(|(_, n)| (*n > 0) == wanted)
            .map(|&(id, n)| (id, n.unsigned_abs()))
            .collect();
        sort_by_key(&mut side, |&(id, _)| match order {
            Order::Stages => factor_key(arena, id),
            Order::FunctionsLast => typeset_key(arena, id),
        });
        side
    };
    Fraction {
        above: side(true),
        below: side(false),
    }
}

/// [`Order::Stages`].
fn factor_key(arena: &Arena, id: Id) -> (Stage, u8, u32) {
    let stage = arena.stage(id);
    match arena.node(id) {
        Node::Constant(_) | Node::Pi => (stage, 0, id.0),
        Node::Sum(_) if stage <= Stage::PARAMETER => (Stage::PARAMETER, 0, id.0),
        Node::Symbol(symbol) => (stage, 1, symbol.0),
        Node::Function(..) | Node::Product(_) => (stage, 2, id.0),
        Node::Sum(_) => (stage, 3, id.0),
    }
}

/// [`Order::FunctionsLast`]: numbers, parameters, coordinates, rates; then sums; then functions by their names.
fn typeset_key(arena: &Arena, id: Id) -> (Stage, u8, u32) {
    use Function::{Abs, Exp, Pow, Sqrt};
    const LAST: Stage = Stage(u8::MAX);
    let stage = arena.stage(id);
    match arena.node(id) {
        Node::Sum(_) if stage > Stage::PARAMETER => (LAST, 0, id.0),
        Node::Function(function, _) if !matches!(function, Abs | Exp | Pow | Sqrt) => {
            (LAST, 1 + stage.0.min(8), id.0)
        }
        _ => factor_key(arena, id),
    }
}

/// The symbols among the factors, latest stage first, in order of declaration, higher powers first;
/// then the functions.
type TermKey = Vec<(Reverse<Stage>, bool, u32, Reverse<i32>)>;

fn term_key(arena: &Arena, id: Id) -> TermKey {
    let alone = [(id, 1)];
    let factors = match arena.node(id) {
        Node::Product(factors) => factors,
        _ => &alone[..],
    };
    let mut key: TermKey = factors
        .iter()
        .map(|&(factor, power)| match arena.node(factor) {
            Node::Symbol(symbol) => (
                Reverse(arena.stage(factor)),
                false,
                symbol.0,
                Reverse(power),
            ),
            _ => (Reverse(arena.stage(factor)), true, factor.0, Reverse(power)),
        })
        .collect();
    key.sort_unstable();
    key
}
