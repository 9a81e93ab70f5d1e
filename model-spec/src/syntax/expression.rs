//! Parses expressions.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::NO_BRANCHES;
use crate::syntax::ast::*;
use crate::syntax::parse::{Group, Parser};
use crate::token::{Delimiter, TokenKind};

/// The largest nesting depth of brackets, powers and signs.
///
/// Formulas written by people nest ten deep. Parsing and every later traversal of the tree recurse,
/// and a hundred levels fit into the smallest stack of a thread.
pub const NESTING_LIMIT: usize = 128;

impl Parser<'_> {
    /// A sum: `a - b + c`.
    pub(super) fn expression(&mut self) -> Expression {
        let first = self.product();
        let mut terms = vec![Term {
            negative: false,
            value: first,
        }];
        while !self.failed && (self.is_mark('+') || self.is_mark('-')) {
            let negative = self.is_mark('-');
            self.at += 1;
            let value = self.product();
            terms.push(Term { negative, value });
        }
        if terms.len() == 1 {
            return terms.swap_remove(0).value;
        }
        let span = terms[0].value.span.to(terms[terms.len() - 1].value.span);
        Expression {
            kind: ExpressionKind::Sum(terms),
            span,
        }
    }

    /// A product: `a*b/c`.
    fn product(&mut self) -> Expression {
        let first = self.signed();
        let mut factors = vec![Factor {
            divides: false,
            value: first,
        }];
        while !self.failed && (self.is_mark('*') || self.is_mark('/')) {
            if self.is_pair('*', '*') {
                let help = "a power is written `x^2`".to_owned();
                self.unexpected_because("an operator", Some(help));
                break;
            }
            let divides = self.is_mark('/');
            self.at += 1;
            let value = self.signed();
            factors.push(Factor { divides, value });
        }
        if factors.len() == 1 {
            return factors.swap_remove(0).value;
        }
        let span = factors[0]
            .value
            .span
            .to(factors[factors.len() - 1].value.span);
        Expression {
            kind: ExpressionKind::Product(factors),
            span,
        }
    }

    /// `-a`, or a power.
    fn signed(&mut self) -> Expression {
        let start = self.next_span();
        if !self.is_mark('-') {
            return self.power();
        }
        if !self.increase_depth(start) {
            return self.error(start);
        }
        self.at += 1;
        let value = self.signed();
        self.depth -= 1;
        let span = start.to(value.span);
        Expression {
            kind: ExpressionKind::Negative(Box::new(value)),
            span,
        }
    }

    /// `a^b`: the power binds tighter than a preceding sign, and to the right: `-x^2 = -(x^2)`,
    /// `a^b^c = a^(b^c)`.
    fn power(&mut self) -> Expression {
        let base = self.chain();
        let sign = self.next_span();
        if self.failed || !self.is_mark('^') {
            return base;
        }
        if !self.increase_depth(sign) {
            return base;
        }
        self.at += 1;
        let exponent = self.signed();
        self.depth -= 1;
        let span = base.span.to(exponent.span);
        Expression {
            kind: ExpressionKind::Power(Box::new(base), Box::new(exponent)),
            span,
        }
    }

    /// `ground.shift(x, y).turn(theta)`, `mortar.at`
    fn chain(&mut self) -> Expression {
        let root = self.operand();
        let mut links = Vec::new();
        while !self.failed && self.is_mark('.') && !self.is_pair('.', '.') {
            self.at += 1;
            let Some(name) = self.ident("a name") else {
                break;
            };
            let arguments = if self.is_open(Delimiter::Parenthesis) {
                self.arguments()
            } else {
                None
            };
            let span = name.span.to(self.previous_span());
            links.push(Link {
                name,
                arguments,
                span,
            });
        }
        let Some(last) = links.last() else {
            return root;
        };
        let span = root.span.to(last.span);
        let root = Box::new(root);
        Expression {
            kind: ExpressionKind::Chain(Chain { root, links }),
            span,
        }
    }

    /// A number, a name, a call, or something in brackets.
    fn operand(&mut self) -> Expression {
        let start = self.next_span();
        match self.peek().map(|word| word.kind) {
            Some(TokenKind::Number) => {
                let number = self.peek().map_or("", |word| word.text).to_owned();
                self.at += 1;
                Expression {
                    kind: ExpressionKind::Number(number),
                    span: start,
                }
            }
            Some(TokenKind::Text) if self.is_file_of_table() => {
                let text = self.peek().map_or("", |word| word.text).to_owned();
                self.at += 1;
                self.texts.push(Spanned {
                    value: text.clone(),
                    span: start,
                });
                Expression {
                    kind: ExpressionKind::Text(text),
                    span: start,
                }
            }
            Some(TokenKind::Ident) => self.name_or_call(start),
            Some(TokenKind::Open(Delimiter::Parenthesis)) => self.in_brackets(start),
            other => {
                self.unexpected_because("an expression", operand_help(other));
                self.error(start)
            }
        }
    }

    /// Whether the next word is the first argument of a `table`.
    fn is_file_of_table(&self) -> bool {
        let before = |back: usize| {
            let at = self.at.checked_sub(back)?;
            self.words.get(at)
        };
        before(1).is_some_and(|word| word.kind == TokenKind::Open(Delimiter::Parenthesis))
            && before(2).is_some_and(|word| word.kind == TokenKind::Ident && word.text == "table")
    }

    /// `theta`, `q[i-1]`, `polar(s1, phi1)`
    fn name_or_call(&mut self, start: Span) -> Expression {
        let Some(base) = self.ident("a name") else {
            return self.error(start);
        };
        let mut index = None;
        let follows = self.peek().map(|word| word.kind);
        let is_operand = matches!(
            follows,
            Some(TokenKind::Ident | TokenKind::Number | TokenKind::Open(Delimiter::Parenthesis))
        );
        if base.text == "if" && is_operand {
            let message = "expected an expression, found `if`";
            let branch = Diagnostic::new(Code::UnexpectedToken, base.span, message);
            self.fail(branch.help(NO_BRANCHES));
            return self.error(start);
        }
        if self.is_open(Delimiter::Parenthesis) {
            let Some(arguments) = self.arguments() else {
                return self.error(start);
            };
            let call = Call {
                function: base,
                arguments,
            };
            return Expression {
                kind: ExpressionKind::Call(call),
                span: start.to(self.previous_span()),
            };
        }
        if self.is_open(Delimiter::Bracket) {
            let Some(group) = self.enter_nested(Delimiter::Bracket) else {
                return self.error(start);
            };
            index = Some(Box::new(self.expression()));
            if !self.failed && self.is_pair('.', '.') {
                let message = "a range is allowed only where a family is declared";
                let range =
                    Diagnostic::new(Code::MisplacedIndex, self.next_operator_span(), message);
                self.fail(range.help("name one member: `q[1]`, or `q[i]` in a family"));
            }
            self.leave_nested(group, "`]`");
            self.refuse_second_index();
        }
        Expression {
            kind: ExpressionKind::Name(Reference { base, index }),
            span: start.to(self.previous_span()),
        }
    }

    /// `(a)`, or a vector `(a, b)`.
    fn in_brackets(&mut self, start: Span) -> Expression {
        let Some(mut list) = self.arguments() else {
            return self.error(start);
        };
        let span = start.to(self.previous_span());
        let kind = match list.len() {
            0 => {
                let message = "expected an expression, found `)`";
                self.fail(Diagnostic::new(
                    Code::UnexpectedToken,
                    self.previous_span(),
                    message,
                ));
                ExpressionKind::Error
            }
            1 => list.swap_remove(0).kind,
            _ => ExpressionKind::Tuple(list),
        };
        Expression { kind, span }
    }

    /// `(a, b, …)`, the arguments of a function; none if they are nested too deeply.
    fn arguments(&mut self) -> Option<Vec<Expression>> {
        let group = self.enter_nested(Delimiter::Parenthesis)?;
        let mut list = Vec::new();
        self.list(group, |_| false, |parser| list.push(parser.expression()));
        self.depth -= 1;
        Some(list)
    }

    /// Enters a bracket, one level deeper.
    pub(super) fn enter_nested(&mut self, delimiter: Delimiter) -> Option<Group> {
        let start = self.next_span();
        if !self.increase_depth(start) {
            return None;
        }
        let group = self.enter(delimiter);
        if group.is_none() {
            self.depth -= 1;
        }
        group
    }

    /// Leaves the group that [`Parser::enter_nested`] entered.
    pub(super) fn leave_nested(&mut self, group: Group, expected: &str) {
        self.leave(group, expected);
        self.depth -= 1;
    }

    /// Increases the depth by one level, or reports an error.
    fn increase_depth(&mut self, place: Span) -> bool {
        if self.depth >= NESTING_LIMIT {
            let message = format!("this expression is nested more than {NESTING_LIMIT} deep");
            let deep = Diagnostic::new(Code::NestedTooDeeply, place, message);
            self.fail(deep.help("name a part of it in `define { … }`"));
            return false;
        }
        self.depth += 1;
        true
    }

    fn error(&self, span: Span) -> Expression {
        Expression {
            kind: ExpressionKind::Error,
            span,
        }
    }
}

/// The help for something with which no expression begins.
fn operand_help(found: Option<TokenKind>) -> Option<String> {
    let help = match found? {
        TokenKind::Punct('+') => "a sum begins without a sign, or with `-`",
        TokenKind::Punct('.') => "a number begins with a digit: `0.5`",
        TokenKind::Punct('|') => "the absolute value is `abs(x)`",
        TokenKind::Punct(',') | TokenKind::Close(_) => "something is missing before it",
        TokenKind::Open(Delimiter::Bracket) => "a vector is written `(a, b)`",
        _ => return None,
    };
    Some(help.to_owned())
}
