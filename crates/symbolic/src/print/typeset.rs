//! Typesets expressions of the graph for a page.

use crate::arena::Arena;
use crate::node::{Function, Id, Node};
use crate::print::layout::{self, Order, Term};
use crate::print::math::{Form, Mark, Math, Sign};
use crate::print::number::{Shape, shape};
use crate::rational::Rational;

/// The largest number of terms of a sum that is written in a numerator.
const LONGEST_SUM_ABOVE: usize = 3;

/// The position of an expression.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Position {
    /// On its own, in braces or parentheses.
    Whole,
    /// Among other factors.
    Factor,
    /// Under an exponent.
    Base,
    /// After the name of a function.
    Argument,
}

/// A piece that is still to be written.
enum Piece {
    Mark(Mark),
    Node(Id, Position),
    /// A positive multiple.
    Multiple(Rational, Id),
    Power(Id, u32),
}

/// Typesets a graph from front to back, with a stack of pieces still to be written.
pub(super) struct Writer<'a> {
    arena: &'a Arena,
    symbols: &'a [Math],
    out: Vec<Mark>,
    left: Vec<Piece>,
}

impl<'a> Writer<'a> {
    pub(super) fn new(arena: &'a Arena, symbols: &'a [Math]) -> Writer<'a> {
        Writer {
            arena,
            symbols,
            out: Vec::new(),
            left: Vec::new(),
        }
    }

    pub(super) fn write(mut self, id: Id) -> Math {
        self.left.push(Piece::Node(id, Position::Whole));
        while let Some(piece) = self.left.pop() {
            let mut next = Vec::new();
            match piece {
                Piece::Mark(mark) => self.out.push(mark),
                Piece::Node(id, place) if self.needs_parentheses(id, place) => {
                    form(
                        Form::Parentheses,
                        [vec![Piece::Node(id, Position::Whole)]],
                        &mut next,
                    );
                }
                Piece::Node(id, _) => self.node(id, &mut next),
                Piece::Multiple(scale, id) => self.multiple(&scale, id, &mut next),
                Piece::Power(id, n) => self.power(id, n, &mut next),
            }
            self.left.extend(next.into_iter().rev());
        }
        Math { marks: self.out }
    }

    fn needs_parentheses(&self, id: Id, place: Position) -> bool {
        match (place, self.arena.node(id)) {
            (Position::Whole, _) => false,
            (_, Node::Symbol(_) | Node::Pi) => false,
            (Position::Factor, Node::Sum(_)) => true,
            (Position::Factor, Node::Constant(value)) => value.is_negative(),
            (Position::Factor, _) => false,
            (_, Node::Constant(value)) => value.is_negative() || !value.is_integer(),
            (Position::Base, Node::Function(Function::Abs, _)) => false,
            _ => true,
        }
    }

    fn node(&self, id: Id, next: &mut Vec<Piece>) {
        match self.arena.node(id) {
            Node::Constant(value) => {
                if value.is_negative() {
                    next.push(sign(Sign::Negative));
                }
                next.extend(marks(number(&value.abs())));
            }
            Node::Pi => next.push(Piece::Mark(Mark::Letter('π'))),
            Node::Symbol(symbol) => {
                next.extend(marks(self.symbols[symbol.index()].clone()));
            }
            Node::Sum(terms) => {
                let terms = layout::terms(self.arena, terms, true);
                if terms.is_empty() {
                    next.extend(marks(Math::number(0)));
                }
                for (
                    index,
                    Term {
                        negative,
                        scale,
                        id,
                    },
                ) in terms.into_iter().enumerate()
                {
                    match (index, negative) {
                        (0, false) => {}
                        (0, true) => next.push(sign(Sign::Negative)),
                        (_, false) => next.push(sign(Sign::Plus)),
                        (_, true) => next.push(sign(Sign::Minus)),
                    }
                    next.push(Piece::Multiple(scale, id));
                }
            }
            Node::Product(_) => next.push(Piece::Multiple(Rational::ONE, id)),
            Node::Function(function, arguments) => self.function(*function, arguments, None, next),
        }
    }

    /// `½ m x²`, `a/(2 b)` as fractions.
    fn multiple(&self, scale: &Rational, id: Id, next: &mut Vec<Piece>) {
        let fraction = layout::fraction(self.arena, id, Order::FunctionsLast);
        let factors = |factors: &[(Id, u32)]| -> Vec<Vec<Piece>> {
            let power = |&(id, n): &(Id, u32)| vec![Piece::Power(id, n)];
            factors.iter().map(power).collect()
        };
        let is_fraction = !fraction.below.is_empty();
        // A long sum is written after the fraction, where it may be broken into lines.
        let is_long = |&(id, _): &(Id, u32)| match self.arena.node(id) {
            Node::Sum(terms) => is_fraction && terms.len() > LONGEST_SUM_ABOVE,
            _ => false,
        };
        let (long, short): (Vec<_>, Vec<_>) = fraction.above.iter().copied().partition(is_long);
        let mut above = factors(&short);
        let mut below = factors(&fraction.below);
        if !scale.is_one() || above.is_empty() {
            match shape(scale) {
                Shape::Fraction(p, q) if is_fraction => {
                    if p != "1" || above.is_empty() {
                        above.insert(0, marks(digits(p)).collect());
                    }
                    below.insert(0, marks(digits(q)).collect());
                }
                _ => above.insert(0, marks(number(scale)).collect()),
            }
        }
        if is_fraction {
            form(Form::Fraction, [product(above), product(below)], next);
            for factor in factors(&long) {
                next.push(sign(Sign::Times));
                next.extend(factor);
            }
        } else {
            next.extend(product(above));
        }
    }

    /// `θ²`, `sin² θ`.
    fn power(&self, id: Id, n: u32, next: &mut Vec<Piece>) {
        let exponent = || Math::number(i64::from(n));
        match self.arena.node(id) {
            _ if n == 1 => next.push(Piece::Node(id, Position::Factor)),
            Node::Function(function, arguments) if has_name(*function) && arguments.len() == 1 => {
                self.function(*function, arguments, Some(n), next);
            }
            Node::Symbol(symbol) => {
                let symbol = self.symbols[symbol.index()].clone();
                next.extend(marks(symbol.power(exponent())));
            }
            _ => form(
                Form::Power,
                [
                    vec![Piece::Node(id, Position::Base)],
                    marks(exponent()).collect(),
                ],
                next,
            ),
        }
    }

    fn function(
        &self,
        function: Function,
        arguments: &[Id],
        power: Option<u32>,
        next: &mut Vec<Piece>,
    ) {
        let unbracketed = |id: Id| vec![Piece::Node(id, Position::Whole)];
        let x = arguments[0];
        match function {
            Function::Sqrt => form(Form::Root, [unbracketed(x)], next),
            Function::Abs => form(Form::Bars, [unbracketed(x)], next),
            Function::Exp => {
                let base = vec![Piece::Mark(Mark::Letter('e'))];
                form(Form::Power, [base, unbracketed(x)], next);
            }
            Function::Pow => {
                let base = vec![Piece::Node(x, Position::Base)];
                form(Form::Power, [base, unbracketed(arguments[1])], next);
            }
            _ => {
                let name = vec![Piece::Mark(Mark::Function(function.name()))];
                match power {
                    Some(n) => {
                        let exponent = marks(Math::number(i64::from(n))).collect();
                        form(Form::Power, [name, exponent], next);
                    }
                    None => next.extend(name),
                }
                next.push(sign(Sign::Apply));
                if let [x] = arguments {
                    next.push(Piece::Node(*x, Position::Argument));
                } else {
                    let mut list = Vec::new();
                    for (index, &argument) in arguments.iter().enumerate() {
                        if index > 0 {
                            list.push(sign(Sign::Comma));
                        }
                        list.extend(unbracketed(argument));
                    }
                    form(Form::Parentheses, [list], next);
                }
            }
        }
    }
}

/// Whether a function is written by its name; an exponent is then attached to the name: sin²x.
fn has_name(function: Function) -> bool {
    use Function::{Abs, Exp, Pow, Sqrt};
    !matches!(function, Sqrt | Abs | Exp | Pow)
}

/// Factors next to each other.
fn product(factors: Vec<Vec<Piece>>) -> Vec<Piece> {
    let mut product = Vec::new();
    for (index, factor) in factors.into_iter().enumerate() {
        if index > 0 {
            product.push(sign(Sign::Times));
        }
        product.extend(factor);
    }
    product
}

fn form(form: Form, arguments: impl IntoIterator<Item = Vec<Piece>>, next: &mut Vec<Piece>) {
    next.push(Piece::Mark(Mark::Open(form)));
    for (index, argument) in arguments.into_iter().enumerate() {
        if index > 0 {
            next.push(Piece::Mark(Mark::Next));
        }
        next.extend(argument);
    }
    next.push(Piece::Mark(Mark::Close));
}

fn number(value: &Rational) -> Math {
    let ten = |exponent: i64| Math::number(10).power(Math::number(exponent));
    match shape(value) {
        Shape::Decimal(text) => digits(text),
        Shape::Scientific(mantissa, exponent) if mantissa == "1" => ten(exponent),
        Shape::Scientific(mantissa, exponent) => digits(mantissa).then(Sign::Dot, ten(exponent)),
        Shape::Fraction(above, below) => Math::fraction(digits(above), digits(below)),
    }
}

fn digits(text: String) -> Math {
    Math::mark(Mark::Number(text))
}

fn marks(math: Math) -> impl Iterator<Item = Piece> {
    math.marks.into_iter().map(Piece::Mark)
}

fn sign(sign: Sign) -> Piece {
    Piece::Mark(Mark::Sign(sign))
}
