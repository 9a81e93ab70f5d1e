//! Writes values as formulas in the spec language, for comments and listings.

use std::fmt::Write as _;

use lagrangian_symbolic::sorting::sort_by_key;
use lagrangian_symbolic::{Function, Rational};

use super::Source;
use super::graph::{Graph, Id, Node, Scaled};

/// Formulas longer than this are truncated.
const LONGEST: usize = 100;

/// The text of a value; `name` gives the name of an argument.
pub fn formula(graph: &mut Graph, value: Scaled, name: &dyn Fn(Source) -> String) -> String {
    let id = graph.unsigned(value);
    let mut writer = Writer {
        graph,
        name,
        text: String::new(),
    };
    if value.negative {
        writer.text.push('-');
    }
    writer.write(
        id,
        if value.negative {
            Precedence::Product
        } else {
            Precedence::Sum
        },
    );
    let mut text = writer.text;
    if text.len() > LONGEST {
        let end = text
            .char_indices()
            .map(|(position, _)| position)
            .take_while(|&p| p <= LONGEST)
            .last();
        text.truncate(end.unwrap_or(0));
        text.push('…');
    }
    text
}

/// A number as a spec would write it: `9.81`, `3/7`.
pub fn number(value: &Rational) -> String {
    decimal(value).unwrap_or_else(|| value.to_string())
}

/// The decimal form, if it is finite and short.
fn decimal(value: &Rational) -> Option<String> {
    const MOST_PLACES: u32 = 12;
    let (numerator, denominator) = (value.numerator()?, value.denominator()?);
    let places = (0..=MOST_PLACES).find(|&places| 10i64.pow(places) % denominator == 0)?;
    if places == 0 {
        return Some(numerator.to_string());
    }
    let power = 10u64.pow(places);
    let scaled = numerator
        .unsigned_abs()
        .checked_mul(power / denominator.unsigned_abs())?;
    let sign = if numerator < 0 { "-" } else { "" };
    Some(format!(
        "{sign}{}.{:0width$}",
        scaled / power,
        scaled % power,
        width = places as usize
    ))
}

/// The binding strength of a position, which decides whether an expression there needs brackets.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Precedence {
    Sum,
    Product,
    Power,
}

struct Writer<'a> {
    graph: &'a Graph,
    name: &'a dyn Fn(Source) -> String,
    text: String,
}

impl Writer<'_> {
    /// Writes a node. Every level of nesting writes something before it goes deeper, so the limit
    /// on the length also limits the depth.
    fn write(&mut self, id: Id, place: Precedence) {
        if self.text.len() > LONGEST {
            return;
        }
        match self.graph.node(id) {
            Node::Constant(value) => {
                let text = number(value);
                let needed = if text.contains('/') {
                    Precedence::Product
                } else {
                    Precedence::Power
                };
                self.bracketed(
                    place > needed || (text.starts_with('-') && place > Precedence::Sum),
                    |writer| {
                        writer.text.push_str(&text);
                    },
                );
            }
            Node::Pi => self.text.push_str("pi"),
            Node::Read(source) => {
                let text = (self.name)(*source);
                self.text.push_str(&text);
            }
            Node::Opaque(inner) => self.write(*inner, place),
            Node::Sum(terms) => self.bracketed(place > Precedence::Sum, |writer| {
                for (position, term) in terms.iter().enumerate() {
                    writer.text.push_str(match (position, term.negative) {
                        (0, false) => "",
                        (0, true) => "-",
                        (_, false) => " + ",
                        (_, true) => " - ",
                    });
                    writer.write(
                        term.id,
                        if term.negative {
                            Precedence::Product
                        } else {
                            Precedence::Sum
                        },
                    );
                }
            }),
            Node::Product(factors) => self.bracketed(place > Precedence::Product, |writer| {
                writer.product(factors)
            }),
            Node::Function(Function::Pow, arguments) => {
                self.bracketed(place > Precedence::Product, |writer| {
                    writer.write(arguments[0], Precedence::Power);
                    writer.text.push('^');
                    writer.write(arguments[1], Precedence::Power);
                })
            }
            Node::Function(function, arguments) => {
                let _ = write!(self.text, "{}(", function.name()); // writing to a String cannot fail
                for (position, argument) in arguments.iter().enumerate() {
                    self.text.push_str(if position > 0 { ", " } else { "" });
                    self.write(*argument, Precedence::Sum);
                }
                self.text.push(')');
            }
        }
    }

    fn bracketed(&mut self, brackets: bool, write: impl FnOnce(&mut Self)) {
        self.text.push_str(if brackets { "(" } else { "" });
        write(self);
        self.text.push_str(if brackets { ")" } else { "" });
    }

    /// Numbers first, then factors, then divisors.
    fn product(&mut self, factors: &[(Id, i32)]) {
        let is_number = |id: Id| matches!(self.graph.node(id), Node::Constant(_));
        let mut up: Vec<(Id, i32)> = factors
            .iter()
            .copied()
            .filter(|(_, power)| *power > 0)
            .collect();
        sort_by_key(&mut up, |(id, _)| !is_number(*id));
        let down = factors.iter().filter(|(_, power)| *power < 0);
        if up.is_empty() {
            self.text.push('1');
        }
        for (position, (id, power)) in up.into_iter().enumerate() {
            self.text.push_str(if position > 0 { "*" } else { "" });
            self.power(id, power.unsigned_abs());
        }
        for (id, power) in down {
            self.text.push('/');
            self.power(*id, power.unsigned_abs());
        }
    }

    fn power(&mut self, id: Id, power: u32) {
        self.write(id, Precedence::Power);
        if power != 1 {
            let _ = write!(self.text, "^{power}"); // writing to a String cannot fail
        }
    }
}
