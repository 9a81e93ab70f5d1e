//! Writes expressions as in a spec, for quotations after families are unrolled.
//!
//! The text of a macro's body is not available; its syntax tree is.

use std::fmt::Write as _;

use crate::syntax::{Expression, ExpressionKind, Reference, coordinate_of_rate, rate_name};

/// `q[3]`, or `x` for a name that is not a family; `der(q[3])` for a rate.
pub(super) fn show(base: &str, index: Option<i64>) -> String {
    match (index, coordinate_of_rate(base)) {
        (Some(index), Some(base)) => rate_name(base, format_args!("[{index}]")),
        (Some(index), None) => format!("{base}[{index}]"),
        (None, _) => base.to_owned(),
    }
}

/// The text of an expression, with the index of the family replaced by its value.
pub(super) fn shown(expression: &Expression, index: Option<(&str, i64)>) -> String {
    let mut text = String::new();
    Writer {
        text: &mut text,
        index,
    }
    .expression(expression, Precedence::Sum);
    text
}

/// The text of a factor of a product, with brackets around a sum.
pub(super) fn shown_factor(expression: &Expression, index: Option<(&str, i64)>) -> String {
    let mut text = String::new();
    Writer {
        text: &mut text,
        index,
    }
    .expression(expression, Precedence::Power);
    text
}

/// The binding strength of a position: an expression that binds more weakly is put in brackets.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Precedence {
    Sum,
    Product,
    Sign,
    Power,
    Operand,
}

struct Writer<'t, 'i> {
    text: &'t mut String,
    index: Option<(&'i str, i64)>,
}

impl Writer<'_, '_> {
    fn expression(&mut self, expression: &Expression, place: Precedence) {
        let strength = match &expression.kind {
            ExpressionKind::Sum(_) => Precedence::Sum,
            ExpressionKind::Product(_) => Precedence::Product,
            ExpressionKind::Negative(_) => Precedence::Sign,
            ExpressionKind::Power(..) => Precedence::Power,
            _ => Precedence::Operand,
        };
        if strength < place {
            self.text.push('(');
            self.without_brackets(expression);
            self.text.push(')');
        } else {
            self.without_brackets(expression);
        }
    }

    fn without_brackets(&mut self, expression: &Expression) {
        match &expression.kind {
            ExpressionKind::Number(number) => self.text.push_str(number),
            ExpressionKind::Name(reference) => self.reference(reference),
            ExpressionKind::Sum(terms) => {
                for (i, term) in terms.iter().enumerate() {
                    match (i, term.negative) {
                        (0, false) => {}
                        (0, true) => self.text.push('-'),
                        (_, false) => self.text.push_str(" + "),
                        (_, true) => self.text.push_str(" - "),
                    }
                    self.expression(&term.value, Precedence::Product);
                }
            }
            ExpressionKind::Product(factors) => {
                for (i, factor) in factors.iter().enumerate() {
                    if i > 0 {
                        self.text.push(if factor.divides { '/' } else { '*' });
                    }
                    self.expression(&factor.value, Precedence::Sign);
                }
            }
            ExpressionKind::Negative(inner) => {
                self.text.push('-');
                self.expression(inner, Precedence::Sign);
            }
            ExpressionKind::Power(base, exponent) => {
                self.expression(base, Precedence::Operand);
                self.text.push('^');
                self.expression(exponent, Precedence::Sign);
            }
            ExpressionKind::Call(call) => {
                self.text.push_str(&call.function.text);
                self.list(&call.arguments);
            }
            ExpressionKind::Chain(chain) => {
                self.expression(&chain.root, Precedence::Operand);
                for link in &chain.links {
                    self.text.push('.');
                    self.text.push_str(&link.name.text);
                    if let Some(arguments) = &link.arguments {
                        self.list(arguments);
                    }
                }
            }
            ExpressionKind::Tuple(components) => self.list(components),
            ExpressionKind::Text(text) => {
                // Writing to a String cannot fail.
                let _ = write!(self.text, "\"{text}\"");
            }
            ExpressionKind::Error => self.text.push('…'),
        }
    }

    fn reference(&mut self, reference: &Reference) {
        match self.index {
            Some((variable, value)) if variable == reference.base.text => {
                // Writing to a String cannot fail.
                let _ = write!(self.text, "{value}");
            }
            _ => self.text.push_str(&reference.base.text),
        }
        if let Some(index) = &reference.index {
            self.text.push('[');
            match self.integer(index) {
                // Writing to a String cannot fail.
                Some(index) => {
                    let _ = write!(self.text, "{index}");
                }
                None => self.expression(index, Precedence::Sum),
            }
            self.text.push(']');
        }
    }

    /// The value of an index such as `i + 1`, which is shown as the member that it refers to.
    fn integer(&self, index: &Expression) -> Option<i64> {
        match &index.kind {
            ExpressionKind::Number(number) => number.parse().ok(),
            ExpressionKind::Name(name) => {
                let (variable, value) = self.index?;
                (variable == name.base.text && name.index.is_none()).then_some(value)
            }
            ExpressionKind::Sum(terms) => terms.iter().try_fold(0_i64, |sum, term| {
                let value = self.integer(&term.value)?;
                if term.negative {
                    sum.checked_sub(value)
                } else {
                    sum.checked_add(value)
                }
            }),
            _ => None,
        }
    }

    fn list(&mut self, list: &[Expression]) {
        self.text.push('(');
        for (i, item) in list.iter().enumerate() {
            if i > 0 {
                self.text.push_str(", ");
            }
            self.expression(item, Precedence::Sum);
        }
        self.text.push(')');
    }
}
