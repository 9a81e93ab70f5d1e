//! Pairs brackets before anything else is parsed.
//!
//! A missing bracket would mislead a parser for the rest of the file. Here it is reported once, where it
//! opens, and inserted where it most likely belongs; the parser receives only balanced text.

use crate::diagnostic::{Code, Diagnostic, Report};
use crate::source::Span;
use crate::syntax::ast::SectionKind;
use crate::syntax::section::{Form, Section};
use crate::token::{Delimiter, Token, TokenKind};

/// A token among balanced brackets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Word<'t> {
    pub kind: TokenKind,
    pub text: &'t str,
    pub span: Span,
    pub joint: bool,
    /// The index of the closing bracket; meaningless for other tokens.
    pub partner: usize,
    /// Whether this bracket is missing in the text, or is the partner of one that is.
    pub repaired: bool,
}

/// The number of brackets that one message shows.
const SHOWN: usize = 4;

/// The tokens with every bracket paired; repairs are reported.
///
/// `sections` are those of the language, which do not nest.
pub(crate) fn balance<'t>(
    tokens: &'t [Token],
    sections: &'t [SectionKind],
    report: &mut Report,
) -> Vec<Word<'t>> {
    // An unterminated comment or raw string swallows closing brackets, which are then not reported.
    let swallowed = tokens
        .first()
        .is_some_and(|token| report.has(token.span.source, Code::Unterminated));
    let mut balance = Balance {
        tokens,
        sections,
        words: Vec::with_capacity(tokens.len()),
        open: Vec::new(),
        count: [0; 3],
        repairing: !is_balanced(tokens),
    };
    let mut ignored = Report::new();
    balance.run(if swallowed { &mut ignored } else { report });
    balance.words
}

fn is_balanced(tokens: &[Token]) -> bool {
    let mut open = Vec::new();
    for token in tokens {
        match token.kind {
            TokenKind::Open(delimiter) => open.push(delimiter),
            TokenKind::Close(delimiter) if open.pop() != Some(delimiter) => return false,
            _ => {}
        }
    }
    open.is_empty()
}

struct Balance<'t> {
    tokens: &'t [Token],
    sections: &'t [SectionKind],
    words: Vec<Word<'t>>,
    /// The indices in `words` of the brackets that are open.
    open: Vec<(usize, Delimiter)>,
    /// The number of open brackets of each kind, so that a bracket that closes nothing need not
    /// search them all.
    count: [usize; 3],
    /// Whether the text is unbalanced, so that the language has to show what was meant.
    repairing: bool,
}

impl<'t> Balance<'t> {
    fn run(&mut self, report: &mut Report) {
        for (at, token) in self.tokens.iter().enumerate() {
            if self.repairing && self.open.len() > 1 && self.is_heading(at) {
                // Sections do not nest: brackets still open in the preceding one were never closed.
                self.close_down_to(1, token.span, report);
            }
            match token.kind {
                TokenKind::Open(delimiter) => {
                    self.open.push((self.words.len(), delimiter));
                    self.count[delimiter as usize] += 1;
                    self.push(token);
                }
                TokenKind::Close(delimiter) => self.close(at, delimiter, report),
                _ => self.push(token),
            }
        }
        let end = self.tokens.last().map(|token| token.span.after());
        self.close_down_to(0, end.unwrap_or_default(), report);
    }

    fn push(&mut self, token: &'t Token) {
        self.words.push(Word {
            kind: token.kind,
            text: &token.text,
            span: token.span,
            joint: token.joint,
            partner: 0,
            repaired: false,
        });
    }

    /// The bracket at `at` closes the last one of its kind; brackets opened inside that were never closed.
    fn close(&mut self, at: usize, delimiter: Delimiter, report: &mut Report) {
        let token = &self.tokens[at];
        let ends_machine_early = self.repairing
            && delimiter == Delimiter::Brace
            && self.open.len() == 1
            && self.is_heading_after_docs(at + 1);
        let level = match self.count[delimiter as usize] {
            0 => None,
            _ => self.open.iter().rposition(|&(_, kind)| kind == delimiter),
        };
        match (level, self.open.last()) {
            (Some(level), _) if !ends_machine_early => {
                self.close_down_to(level + 1, token.span, report);
                self.close_last(token, token.span, false);
            }
            // `(a, b]`: a single slip, not one bracket too many and another too few.
            (None, Some(&(open, kind)))
                if kind != Delimiter::Brace
                    && delimiter != Delimiter::Brace
                    && !self.next_bracket_closes(at + 1, kind) =>
            {
                let message = format!("`{}` cannot close `{}`", closing(delimiter), opening(kind));
                let opened = self.words[open].span;
                report.push(
                    Diagnostic::new(Code::UnbalancedBracket, token.span, message)
                        .help(format!("write `{}`", closing(kind)))
                        .note(opened, "this bracket is open"),
                );
                self.close_last(token, token.span, true);
            }
            _ => {
                let message = format!("this `{}` closes nothing", closing(delimiter));
                let help = format!(
                    "remove it, or add the `{}` that it belongs to",
                    opening(delimiter)
                );
                report
                    .push(Diagnostic::new(Code::UnbalancedBracket, token.span, message).help(help));
            }
        }
    }

    /// Inserts the brackets that close all but the outermost `level`, and reports them together.
    fn close_down_to(&mut self, level: usize, place: Span, report: &mut Report) {
        let Some(unclosed) = self
            .open
            .get(level..)
            .filter(|unclosed| !unclosed.is_empty())
        else {
            return;
        };
        let mut spans = unclosed
            .iter()
            .rev()
            .map(|&(open, kind)| (self.words[open].span, kind));
        let Some((innermost, kind)) = spans.next() else {
            return;
        };
        let message = format!("this `{}` is never closed", opening(kind));
        let mut diagnostic = Diagnostic::new(Code::UnbalancedBracket, innermost, message)
            .help(format!("add the `{}` that belongs to it", closing(kind)));
        for (span, kind) in spans.take(SHOWN) {
            let note = format!("nor is this `{}`", opening(kind));
            diagnostic = diagnostic.note(span, note);
        }
        report.push(diagnostic);
        // Inserted brackets stand where they are missing, with an empty span.
        let place = Span {
            end: place.start,
            ..place
        };
        while self.open.len() > level {
            let delimiter = self.open[self.open.len() - 1].1;
            let made_up = Word {
                kind: TokenKind::Close(delimiter),
                text: closing(delimiter),
                span: place,
                joint: false,
                partner: 0,
                repaired: true,
            };
            self.pair_last(made_up);
        }
    }

    fn close_last(&mut self, token: &'t Token, span: Span, mended: bool) {
        let Some(&(_, delimiter)) = self.open.last() else {
            return;
        };
        self.pair_last(Word {
            kind: TokenKind::Close(delimiter),
            text: &token.text,
            span,
            joint: false,
            partner: 0,
            repaired: mended,
        });
    }

    /// Closes the innermost bracket with `word`.
    fn pair_last(&mut self, word: Word<'t>) {
        if let Some((open, kind)) = self.open.pop() {
            self.count[kind as usize] -= 1;
            self.words[open].partner = self.words.len();
            self.words[open].repaired = word.repaired;
            self.words.push(word);
        }
    }

    /// Whether a section begins here: `springs {`, `gravity (`, `published "…"`.
    fn is_heading(&self, at: usize) -> bool {
        let [word, next, ..] = &self.tokens[at..] else {
            return false;
        };
        let begins_item = at == 0
            || matches!(
                self.tokens[at - 1].kind,
                TokenKind::Open(Delimiter::Brace)
                    | TokenKind::Close(_)
                    | TokenKind::Punct(',' | ';')
                    | TokenKind::Doc
            );
        let kind = match word.kind {
            TokenKind::Ident if begins_item => SectionKind::named_among(self.sections, &word.text),
            _ => None,
        };
        let opens = |delimiter| next.kind == TokenKind::Open(delimiter);
        match kind {
            None => false,
            Some(SectionKind::Element(Section {
                form: Form::Statement,
                ..
            })) => opens(Delimiter::Parenthesis),
            Some(SectionKind::Published) => next.kind == TokenKind::Text,
            Some(_) => opens(Delimiter::Brace),
        }
    }

    fn is_heading_after_docs(&self, at: usize) -> bool {
        let docs = self.tokens[at..]
            .iter()
            .take_while(|token| token.kind == TokenKind::Doc);
        let heading = at + docs.count();
        heading < self.tokens.len() && self.is_heading(heading)
    }

    /// Whether the next bracket is one that closes `kind`.
    fn next_bracket_closes(&self, at: usize, kind: Delimiter) -> bool {
        let next = self.tokens[at..]
            .iter()
            .find(|token| matches!(token.kind, TokenKind::Open(_) | TokenKind::Close(_)));
        next.is_some_and(|token| token.kind == TokenKind::Close(kind))
    }
}

pub(crate) fn opening(delimiter: Delimiter) -> &'static str {
    match delimiter {
        Delimiter::Parenthesis => "(",
        Delimiter::Brace => "{",
        Delimiter::Bracket => "[",
    }
}

pub(crate) fn closing(delimiter: Delimiter) -> &'static str {
    match delimiter {
        Delimiter::Parenthesis => ")",
        Delimiter::Brace => "}",
        Delimiter::Bracket => "]",
    }
}
