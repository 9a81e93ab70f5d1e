//! Prints expressions in the spec language.

use std::borrow::Cow;

use crate::arena::Arena;
use crate::node::{Function, Id, Node};
use crate::print::layout::{self, Order, Term};
use crate::print::number::{Shape, shape};
use crate::rational::Rational;

/// The binding strength of an expression, or the one that its position requires.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    /// `a + b`, `-a`
    Sum,
    /// `a*b`, `1/2`
    Product,
    /// `a^b`
    Power,
    /// `a`, `f(a)`
    Atom,
}

/// A piece that is still to be written.
enum Piece {
    Text(Cow<'static, str>),
    Node(Id, Level),
    /// A positive multiple.
    Multiple(Rational, Id),
    Power(Id, u32),
}

/// Writes a graph from front to back, with a stack of pieces still to be written.
pub(super) struct Writer<'a> {
    arena: &'a Arena,
    symbols: &'a [String],
    out: String,
    left: Vec<Piece>,
}

impl<'a> Writer<'a> {
    pub(super) fn new(arena: &'a Arena, symbols: &'a [String]) -> Writer<'a> {
        Writer {
            arena,
            symbols,
            out: String::new(),
            left: Vec::new(),
        }
    }

    pub(super) fn write(mut self, id: Id) -> String {
        self.left.push(Piece::Node(id, Level::Sum));
        while let Some(piece) = self.left.pop() {
            let mut next = Vec::new();
            match piece {
                Piece::Text(text) => self.out.push_str(&text),
                Piece::Node(id, wanted) if self.level(id) < wanted => {
                    next.extend([literal("("), Piece::Node(id, Level::Sum), literal(")")]);
                }
                Piece::Node(id, _) => self.node(id, &mut next),
                Piece::Multiple(scale, id) => self.multiple(&scale, id, &mut next),
                Piece::Power(id, 1) => next.push(Piece::Node(id, Level::Power)),
                Piece::Power(id, n) => {
                    next.extend([Piece::Node(id, Level::Atom), owned(format!("^{n}"))]);
                }
            }
            self.left.extend(next.into_iter().rev());
        }
        self.out
    }

    fn level(&self, id: Id) -> Level {
        match self.arena.node(id) {
            Node::Constant(value) if value.is_negative() => Level::Sum,
            Node::Constant(value) => match shape(value) {
                Shape::Fraction(..) => Level::Product,
                _ => Level::Atom,
            },
            Node::Sum(terms) if terms.len() == 1 && !terms[0].1.is_negative() => Level::Product,
            Node::Sum(_) => Level::Sum,
            Node::Product(factors) if factors.len() == 1 && factors[0].1 > 0 => Level::Power,
            Node::Product(_) => Level::Product,
            Node::Function(Function::Pow, _) => Level::Power,
            Node::Pi | Node::Symbol(_) | Node::Function(..) => Level::Atom,
        }
    }

    fn node(&self, id: Id, next: &mut Vec<Piece>) {
        match self.arena.node(id) {
            Node::Constant(value) => {
                next.push(literal(if value.is_negative() { "-" } else { "" }));
                next.push(owned(number(&value.abs())));
            }
            Node::Pi => next.push(literal("pi")),
            Node::Symbol(symbol) => next.push(owned(self.symbols[symbol.index()].clone())),
            Node::Sum(terms) => {
                let terms = layout::terms(self.arena, terms, false);
                for (
                    index,
                    Term {
                        negative,
                        scale,
                        id,
                    },
                ) in terms.into_iter().enumerate()
                {
                    next.push(literal(match (index, negative) {
                        (0, false) => "",
                        (0, true) => "-",
                        (_, false) => " + ",
                        (_, true) => " - ",
                    }));
                    next.push(Piece::Multiple(scale, id));
                }
            }
            Node::Product(_) => next.push(Piece::Multiple(Rational::ONE, id)),
            Node::Function(Function::Pow, arguments) => next.extend([
                Piece::Node(arguments[0], Level::Atom),
                literal("^"),
                Piece::Node(arguments[1], Level::Atom),
            ]),
            Node::Function(function, arguments) => {
                next.push(literal(function.name()));
                for (index, &argument) in arguments.iter().enumerate() {
                    next.push(literal(if index == 0 { "(" } else { ", " }));
                    next.push(Piece::Node(argument, Level::Sum));
                }
                next.push(literal(")"));
            }
        }
    }

    /// `1/2*m*x^2/(a*b)`.
    fn multiple(&self, scale: &Rational, id: Id, next: &mut Vec<Piece>) {
        let fraction = layout::fraction(self.arena, id, Order::Stages);
        let mut below: Vec<Piece> = fraction
            .below
            .iter()
            .map(|&(id, n)| Piece::Power(id, n))
            .collect();
        let mut above: Vec<Piece> = fraction
            .above
            .iter()
            .map(|&(id, n)| Piece::Power(id, n))
            .collect();
        if !scale.is_one() || above.is_empty() {
            match shape(scale) {
                // 3/(4*a) rather than 3/4/a.
                Shape::Fraction(p, q) if above.is_empty() && !below.is_empty() => {
                    above.push(owned(p));
                    below.insert(0, owned(q));
                }
                _ => above.insert(0, owned(number(scale))),
            }
        }
        separated(above, "*", next);
        if !below.is_empty() {
            let several = below.len() > 1;
            next.push(literal(if several { "/(" } else { "/" }));
            separated(below, "*", next);
            next.push(literal(if several { ")" } else { "" }));
        }
    }
}

fn separated(pieces: Vec<Piece>, separator: &'static str, next: &mut Vec<Piece>) {
    for (index, piece) in pieces.into_iter().enumerate() {
        if index > 0 {
            next.push(literal(separator));
        }
        next.push(piece);
    }
}

fn number(value: &Rational) -> String {
    match shape(value) {
        Shape::Decimal(text) => text,
        Shape::Scientific(mantissa, exponent) => format!("{mantissa}e{exponent}"),
        Shape::Fraction(above, below) => format!("{above}/{below}"),
    }
}

fn literal(text: &'static str) -> Piece {
    Piece::Text(Cow::Borrowed(text))
}

fn owned(text: String) -> Piece {
    Piece::Text(Cow::Owned(text))
}
