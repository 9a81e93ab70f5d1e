//! The basic operations of the parser: reading words, reporting errors, and recovering from them.
//!
//! Parsing never stops at an error. The error is reported, the rest of the smallest enclosing list
//! element is skipped, and parsing continues after the next comma; so errors in one item hide none
//! in another, and the tree is as complete as the text allows.

use crate::diagnostic::{Code, Diagnostic, Report};
use crate::source::{SourceId, Span};
use crate::syntax::NO_BRANCHES;
use crate::syntax::ast::*;
use crate::syntax::brackets::{Word, balance, opening};
use crate::token::{Delimiter, Token, TokenKind, shown};

impl Spec {
    /// Parses the tokens of `source` in a language with these `sections`. All errors are reported at once.
    pub(crate) fn read(
        tokens: &[Token],
        source: SourceId,
        sections: &[SectionKind],
        report: &mut Report,
    ) -> Spec {
        let mut parser = Parser::new(tokens, source, sections, report);
        let mut spec = parser.source();
        spec.incomplete |= parser.skipped_names;
        spec.tables = std::mem::take(&mut parser.texts);
        spec
    }
}

impl Quantity {
    /// Parses the value of a quantity, and its unit, from two texts that contain nothing else. Errors are reported.
    pub(crate) fn parse([unit, value]: [(SourceId, &[Token]); 2], report: &mut Report) -> Quantity {
        let mut parser = Parser::new(unit.1, unit.0, &[], report);
        let unit = parser.unit();
        parser.expect_end();
        let mut parser = Parser::new(value.1, value.0, &[], report);
        let value = parser.expression();
        parser.expect_end();
        let value = Some(value);
        Quantity { unit, value }
    }
}

pub(super) struct Parser<'t> {
    pub(super) words: Vec<Word<'t>>,
    /// The sections of the language.
    pub(super) sections: &'t [SectionKind],
    /// The next word.
    pub(super) at: usize,
    /// The empty span after the last word.
    pub(super) end: Span,
    /// The nesting depth of the current expression.
    pub(super) depth: usize,
    /// Whether an error occurred and the rest of its list element is not yet skipped: nothing is reported.
    pub(super) failed: bool,
    /// The number of brackets without partners around the next word: nothing inside is reported.
    pub(super) quiet: usize,
    /// Whether something was skipped that may have declared a name.
    pub(super) skipped_names: bool,
    /// The files of tables.
    pub(super) texts: Vec<Spanned<String>>,
    pub(super) report: &'t mut Report,
}

/// A bracketed group that is being parsed.
pub(super) struct Group {
    pub(super) close: usize,
    quiet: bool,
    /// From bracket to bracket.
    pub(super) span: Span,
}

/// Reading words, and handling those that do not fit.
impl<'t> Parser<'t> {
    fn new(
        tokens: &'t [Token],
        source: SourceId,
        sections: &'t [SectionKind],
        report: &'t mut Report,
    ) -> Parser<'t> {
        let words = balance(tokens, sections, report);
        let end = words
            .last()
            .map_or(Span::new(source, 0, 0), |word| word.span.after());
        Parser {
            words,
            sections,
            at: 0,
            end,
            depth: 0,
            failed: false,
            quiet: 0,
            skipped_names: false,
            texts: Vec::new(),
            report,
        }
    }

    /// Checks that the input has ended.
    fn expect_end(&mut self) {
        if self.peek().is_some() && !self.failed {
            let help = self.help_between();
            self.unexpected_because("the end or an operator", help);
        }
    }

    pub(super) fn peek(&self) -> Option<Word<'t>> {
        self.words.get(self.at).copied()
    }

    pub(super) fn peek_second(&self) -> Option<Word<'t>> {
        self.words.get(self.at + 1).copied()
    }

    /// The place of the next word.
    pub(super) fn next_span(&self) -> Span {
        self.peek().map_or(self.end, |word| word.span)
    }

    /// The place of the preceding word.
    pub(super) fn previous_span(&self) -> Span {
        let before = self.at.checked_sub(1).and_then(|at| self.words.get(at));
        before.map_or(self.end, |word| word.span)
    }

    pub(super) fn is(&self, kind: TokenKind) -> bool {
        self.peek().is_some_and(|word| word.kind == kind)
    }

    pub(super) fn is_open(&self, delimiter: Delimiter) -> bool {
        self.is(TokenKind::Open(delimiter))
    }

    pub(super) fn is_mark(&self, mark: char) -> bool {
        self.is(TokenKind::Punct(mark))
    }

    /// Whether two marks follow without a space between them: `..`, `>=`.
    pub(super) fn is_pair(&self, first: char, second: char) -> bool {
        self.peek()
            .is_some_and(|word| word.kind == TokenKind::Punct(first) && word.joint)
            && self
                .peek_second()
                .is_some_and(|word| word.kind == TokenKind::Punct(second))
    }

    pub(super) fn is_word(&self, text: &str) -> bool {
        self.peek()
            .is_some_and(|word| word.kind == TokenKind::Ident && word.text == text)
    }

    pub(super) fn eat_mark(&mut self, mark: char) -> bool {
        let found = self.is_mark(mark);
        self.at += usize::from(found);
        found
    }

    pub(super) fn eat_word(&mut self, text: &str) -> bool {
        let found = self.is_word(text);
        self.at += usize::from(found);
        found
    }

    /// Reports an error after which parsing continues normally.
    pub(super) fn report_error(&mut self, diagnostic: Diagnostic) {
        if !self.failed && self.quiet == 0 {
            self.report.push(diagnostic);
        }
    }

    /// Reports an error even if another one has already occurred.
    pub(super) fn report_always(&mut self, diagnostic: Diagnostic) {
        if self.quiet == 0 {
            self.report.push(diagnostic);
        }
    }

    /// Reports a duplicate where only one is allowed.
    pub(super) fn report_duplicate(&mut self, span: Span, noun: &str, first: Span) {
        let again = Diagnostic::new(Code::SaidTwice, span, format!("{noun} is given twice"));
        self.report_error(again.help("keep one of them").note(first, "the first"));
    }

    /// Reports an error that makes the rest of the list element meaningless.
    pub(super) fn fail(&mut self, diagnostic: Diagnostic) {
        self.report_error(diagnostic);
        self.failed = true;
    }

    /// Reports that the next word is not the expected one.
    pub(super) fn unexpected(&mut self, expected: &str) {
        self.unexpected_because(expected, None);
    }

    /// Reports that the next word is not the expected one, with help.
    pub(super) fn unexpected_because(&mut self, expected: &str, help: Option<String>) {
        let known = self
            .peek()
            .is_some_and(|word| word.repaired || word.kind == TokenKind::Unknown);
        if !known {
            let message = format!("expected {expected}, found {}", self.found());
            let mut diagnostic =
                Diagnostic::new(Code::UnexpectedToken, self.next_operator_span(), message);
            diagnostic.help = help;
            self.report_error(diagnostic);
        }
        // A word that was already reported needs no second message.
        self.failed = true;
    }

    /// The next word, as shown in messages.
    pub(super) fn found(&self) -> String {
        match self.peek() {
            None => "the end".to_owned(),
            Some(word) => match word.kind {
                TokenKind::Doc => "documentation".to_owned(),
                TokenKind::Text => format!("the text {}", shown(&format!("\"{}\"", word.text))),
                TokenKind::Punct(_) => match self.operator() {
                    Some(both) => format!("`{both}`"),
                    None => format!("`{}`", word.text),
                },
                _ => shown(word.text),
            },
        }
    }

    /// The two-character operator that the next words form, if it is one of Rust's.
    fn operator(&self) -> Option<&'static str> {
        let operators = ["..", ">=", "<=", "==", "**", "->", "=>", "::", "||", "&&"];
        let (first, second) = (self.peek()?, self.peek_second()?);
        let makes =
            |operator: &&str| first.joint && operator.strip_prefix(first.text) == Some(second.text);
        operators.into_iter().find(makes)
    }

    /// The place of the next word, or of the operator that it begins.
    pub(super) fn next_operator_span(&self) -> Span {
        match (self.operator(), self.peek_second()) {
            (Some(_), Some(second)) => self.next_span().to(second.span),
            _ => self.next_span(),
        }
    }

    pub(super) fn expect_mark(&mut self, mark: char) {
        if !self.eat_mark(mark) {
            self.unexpected(&format!("`{mark}`"));
        }
    }

    /// Expects a mark for which another one is often written; in that case reports it and continues.
    pub(super) fn expect_mark_not(&mut self, mark: char, other: char, help: &str) {
        if self.is_mark(other) && !self.is_pair(other, other) {
            let message = format!("expected `{mark}`, found `{other}`");
            let wrong = Diagnostic::new(Code::UnexpectedToken, self.next_span(), message);
            self.report_error(wrong.help(help));
            self.at += 1;
        } else if !self.eat_mark(mark) {
            self.unexpected_because(&format!("`{mark}`"), Some(help.to_owned()));
        }
    }

    /// `=`; `==` is reported, and parsing continues.
    pub(super) fn expect_equals(&mut self) {
        if self.is_pair('=', '=') {
            let first = self.next_span();
            self.at += 1;
            let wrong = first.to(self.next_span());
            let message = "expected `=`, found `==`";
            self.report_error(Diagnostic::new(Code::UnexpectedToken, wrong, message));
        }
        self.expect_mark('=');
    }

    pub(super) fn ident(&mut self, noun: &str) -> Option<Ident> {
        let word = self.peek().filter(|word| word.kind == TokenKind::Ident);
        match word {
            Some(word) => {
                self.at += 1;
                Some(Ident {
                    text: word.text.to_owned(),
                    span: word.span,
                })
            }
            None => {
                self.unexpected(noun);
                None
            }
        }
    }

    /// Enters an opening bracket, which must be present.
    pub(super) fn enter(&mut self, delimiter: Delimiter) -> Option<Group> {
        let word = self
            .peek()
            .filter(|word| word.kind == TokenKind::Open(delimiter));
        let Some(word) = word else {
            self.unexpected(&format!("`{}`", opening(delimiter)));
            return None;
        };
        // An unclosed brace was closed where a section or the text ends, so its content is
        // reliable; other brackets may have been closed anywhere.
        let quiet = word.repaired && delimiter != Delimiter::Brace;
        self.quiet += usize::from(quiet);
        self.at += 1;
        let close = self.words.get(word.partner);
        let span = word.span.to(close.map_or(self.end, |close| close.span));
        Some(Group {
            close: word.partner,
            quiet,
            span,
        })
    }

    /// Leaves a group at its closing bracket; everything inside must have been read.
    pub(super) fn leave(&mut self, group: Group, expected: &str) {
        if self.at < group.close && !self.failed {
            self.unexpected(expected);
        }
        self.note_skipped(self.at, group.close);
        self.at = group.close + 1;
        self.failed = false;
        self.quiet -= usize::from(group.quiet);
    }

    /// Parses the elements of a list up to the end of the group, separated by commas.
    ///
    /// `begins` tells where another element begins, so that a missing comma causes no further errors.
    pub(super) fn list(
        &mut self,
        group: Group,
        begins: impl Fn(&Self) -> bool,
        mut element: impl FnMut(&mut Self),
    ) -> Span {
        let span = group.span;
        while self.at < group.close {
            let start = self.at;
            element(self);
            if !self.failed && self.at < group.close && !self.is_mark(',') {
                if self.at > start && begins(self) {
                    let message = format!("expected `,`, found {}", self.found());
                    let help = format!("put a comma before {}", self.found());
                    let missing = Diagnostic::new(Code::UnexpectedToken, self.next_span(), message);
                    self.report_error(missing.help(help));
                    continue;
                }
                if self.is_mark(';') {
                    let message = "expected `,`, found `;`";
                    let wrong = Diagnostic::new(Code::UnexpectedToken, self.next_span(), message);
                    self.report_error(wrong.help("the elements of a list are separated by commas"));
                } else {
                    self.unexpected_between();
                }
            }
            self.skip_to_comma(group.close);
        }
        self.leave(group, "");
        span
    }

    /// Reports that an element is followed neither by a comma nor by the end.
    fn unexpected_between(&mut self) {
        let help = self.help_between();
        self.unexpected_because("`,` or an operator", help);
    }

    /// The help for an expression that ends unexpectedly.
    fn help_between(&self) -> Option<String> {
        let behind_operand = self.at.checked_sub(1).and_then(|at| self.words.get(at));
        let operand = |kind| {
            matches!(
                kind,
                TokenKind::Ident
                    | TokenKind::Number
                    | TokenKind::Close(Delimiter::Parenthesis | Delimiter::Bracket)
            )
        };
        let starts_operand = self.peek().is_some_and(|word| {
            operand(word.kind) || word.kind == TokenKind::Open(Delimiter::Parenthesis)
        });
        match (self.peek(), behind_operand) {
            (Some(word), Some(before)) if starts_operand && operand(before.kind) => {
                let shown = |word: Word<'t>| match word.kind {
                    TokenKind::Open(_) | TokenKind::Close(_) => "(…)",
                    _ => word.text,
                };
                let (left, right) = (shown(*before), shown(word));
                Some(format!("a product needs its `*`: `{left}*{right}`"))
            }
            _ if self.is_mark('?') || self.is_mark('<') || self.is_mark('>') => {
                Some(NO_BRANCHES.to_owned())
            }
            (Some(_), _) if self.is_pair('.', '.') => {
                Some("a range is allowed only in the index of a declaration: `q[1..N]`".to_owned())
            }
            _ => None,
        }
    }

    /// Continues after the next comma of this list.
    fn skip_to_comma(&mut self, close: usize) {
        let start = self.at;
        while self.at < close && !self.is_mark(',') && !self.is_mark(';') {
            self.skip_word();
        }
        self.note_skipped(start, self.at);
        self.failed = false;
        self.at += usize::from(self.at < close);
    }

    /// Skips one word, or a whole group.
    pub(super) fn skip_word(&mut self) {
        self.at = match self.peek() {
            Some(word) if matches!(word.kind, TokenKind::Open(_)) => word.partner + 1,
            _ => self.at + 1,
        };
    }

    /// Records whether the skipped words `start..end` may declare something.
    pub(super) fn note_skipped(&mut self, start: usize, end: usize) {
        let skipped = self.words.get(start..end).unwrap_or_default();
        self.skipped_names |= skipped.windows(2).any(|pair| {
            pair[0].kind == TokenKind::Ident
                && matches!(
                    pair[1].kind,
                    TokenKind::Punct(':' | '=') | TokenKind::Open(Delimiter::Brace)
                )
        });
    }

    /// Documentation: `/// …`, or `#[doc = "…"]` as the compiler passes it to a macro.
    pub(super) fn docs(&mut self) -> String {
        let mut lines = Vec::new();
        loop {
            if let Some(word) = self.peek().filter(|word| word.kind == TokenKind::Doc) {
                lines.extend(doc_lines(word.text));
                self.at += 1;
            } else if let Some((text, inner, length)) = self.doc_attribute() {
                // Inner documentation, `//! …`, is treated as an ordinary comment.
                if !inner {
                    lines.extend(doc_lines(text));
                }
                self.at += length;
            } else {
                break;
            }
        }
        lines.join("\n").trim().to_owned()
    }

    /// The text of `#[doc = "…"]`, whether it is `#![doc = "…"]`, and the number of its words.
    pub(super) fn doc_attribute(&self) -> Option<(&'t str, bool, usize)> {
        let words = self.words.get(self.at..)?;
        let is = |at: usize, kind| words.get(at).is_some_and(|word| word.kind == kind);
        let inner = is(1, TokenKind::Punct('!'));
        let bracket = 1 + usize::from(inner);
        let is_doc = is(0, TokenKind::Punct('#'))
            && is(bracket, TokenKind::Open(Delimiter::Bracket))
            && words
                .get(bracket + 1)
                .is_some_and(|word| word.text == "doc")
            && is(bracket + 2, TokenKind::Punct('='))
            && is(bracket + 3, TokenKind::Text)
            && is(bracket + 4, TokenKind::Close(Delimiter::Bracket));
        is_doc.then(|| (words[bracket + 3].text, inner, bracket + 5))
    }

    /// Reports documentation that precedes nothing.
    pub(super) fn report_misplaced_docs(&mut self) {
        let message = "this documents nothing";
        let lost = Diagnostic::new(Code::UnexpectedToken, self.previous_span(), message);
        self.report_error(
            lost.help("documentation goes before an item; a comment begins with `//`"),
        );
    }
}

/// The lines of a documentation comment, without the space or asterisk at the beginning of each.
fn doc_lines(text: &str) -> Vec<String> {
    // `///` alone separates two paragraphs.
    if text.is_empty() {
        return vec![String::new()];
    }
    let stars = text
        .lines()
        .skip(1)
        .filter(|line| !line.trim().is_empty())
        .all(|line| line.trim_start().starts_with('*'));
    let lines = text.lines().enumerate().map(|(number, line)| {
        let line = if number > 0 && stars {
            line.trim_start().trim_start_matches('*')
        } else {
            line
        };
        line.strip_prefix(' ').unwrap_or(line).trim_end().to_owned()
    });
    lines.collect()
}
