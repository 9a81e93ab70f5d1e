//! Converts tokens of the Rust compiler to the flat tokens of a spec, and maps them back to spans of the user's source.

use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{SourceId, Span};
use lagrangian_spec::token::{self, Delimiter, Token, TokenKind};
use proc_macro2::{Group, Literal, Spacing, TokenStream, TokenTree};

/// The tokens of a macro body; token k has the span `places[k]`.
#[derive(Default)]
pub struct Flat {
    /// The tokens.
    pub tokens: Vec<Token>,
    /// The span of each token.
    pub places: Vec<proc_macro2::Span>,
}

impl Flat {
    /// The spans of the first and the last token of a range.
    pub fn ends(&self, span: Span) -> (proc_macro2::Span, proc_macro2::Span) {
        let place = |index: u32| {
            let last = self.places.len().saturating_sub(1);
            let place = self.places.get((index as usize).min(last));
            place.copied().unwrap_or_else(proc_macro2::Span::call_site)
        };
        // Something missing is reported at the token before it.
        let start = if span.start < span.end {
            span.start
        } else {
            span.start.saturating_sub(1)
        };
        (place(start), place(span.end.max(1) - 1))
    }

    fn push(
        &mut self,
        source: SourceId,
        kind: TokenKind,
        text: &str,
        joint: bool,
        place: proc_macro2::Span,
    ) {
        let span = self.next_span(source);
        self.places.push(place);
        self.tokens.push(Token {
            kind,
            text: text.into(),
            span,
            joint,
        });
    }

    /// Opens a bracket; returns how it closes. Invisible brackets made by a `macro_rules!` group an expression like visible ones, unless they
    /// hold a single token.
    fn open(&mut self, group: &Group, source: SourceId) -> Option<(Delimiter, proc_macro2::Span)> {
        let delimiter = match group.delimiter() {
            proc_macro2::Delimiter::Brace => Delimiter::Brace,
            proc_macro2::Delimiter::Bracket => Delimiter::Bracket,
            proc_macro2::Delimiter::Parenthesis | proc_macro2::Delimiter::None => {
                Delimiter::Parenthesis
            }
        };
        if group.delimiter() == proc_macro2::Delimiter::None && is_single(group) {
            return None;
        }
        let (kind, text) = (TokenKind::Open(delimiter), open_text(delimiter));
        self.push(source, kind, text, false, group.span_open());
        Some((delimiter, group.span_close()))
    }

    fn literal(&mut self, literal: &Literal, source: SourceId, report: &mut Report) {
        let mut text = literal.to_string();
        // Another macro may produce `-1` as one token.
        if let Some(positive) = text.strip_prefix('-') {
            self.push(source, TokenKind::Punct('-'), "-", false, literal.span());
            text = positive.to_owned();
        }
        let span = self.next_span(source);
        self.tokens.push(token::literal(&text, span, report));
        self.places.push(literal.span());
    }

    fn next_span(&self, source: SourceId) -> Span {
        let at = self.tokens.len() as u32;
        Span::new(source, at, at + 1)
    }
}

/// Flattens a macro body without recursion, whatever its nesting depth.
pub fn flatten(stream: TokenStream, source: SourceId, report: &mut Report) -> Flat {
    let mut flat = Flat::default();
    let mut open: Vec<(
        proc_macro2::token_stream::IntoIter,
        Option<(Delimiter, proc_macro2::Span)>,
    )> = Vec::new();
    let mut tokens = stream.into_iter();
    let mut closing = None;
    loop {
        let Some(tree) = tokens.next() else {
            if let Some((delimiter, place)) = closing {
                let text = close_text(delimiter);
                flat.push(source, TokenKind::Close(delimiter), text, false, place);
            }
            match open.pop() {
                Some((outer, outer_closing)) => (tokens, closing) = (outer, outer_closing),
                None => return flat,
            }
            continue;
        };
        match tree {
            TokenTree::Group(group) => {
                let inner = group.stream().into_iter();
                open.push((std::mem::replace(&mut tokens, inner), closing));
                closing = flat.open(&group, source);
            }
            TokenTree::Ident(ident) => {
                let text = ident.to_string();
                let text = text.strip_prefix("r#").unwrap_or(&text);
                flat.push(source, TokenKind::Ident, text, false, ident.span());
            }
            TokenTree::Punct(punct) => {
                let c = punct.as_char();
                if c == '#'
                    && let Some((text, place)) = documentation(&mut tokens)
                {
                    flat.push(
                        source,
                        TokenKind::Doc,
                        &text,
                        false,
                        place.unwrap_or(punct.span()),
                    );
                    continue;
                }
                let joint = punct.spacing() == Spacing::Joint;
                flat.push(
                    source,
                    TokenKind::Punct(c),
                    &c.to_string(),
                    joint,
                    punct.span(),
                );
            }
            TokenTree::Literal(literal) => flat.literal(&literal, source, report),
        }
    }
}

/// Whether invisible brackets hold a single token, which needs no brackets.
fn is_single(group: &Group) -> bool {
    let mut tokens = group.stream().into_iter();
    tokens.next().is_some() && tokens.next().is_none()
}

/// The text of `#[doc = "…"]`, the form in which a macro receives `/// …`; the `#` has been read. Consumes nothing
/// if the tokens are something else.
fn documentation(
    tokens: &mut proc_macro2::token_stream::IntoIter,
) -> Option<(String, Option<proc_macro2::Span>)> {
    let mut ahead = tokens.clone();
    let Some(TokenTree::Group(group)) = ahead.next() else {
        return None;
    };
    let mut inside = group.stream().into_iter();
    match (inside.next(), inside.next(), inside.next(), inside.next()) {
        (
            Some(TokenTree::Ident(doc)),
            Some(TokenTree::Punct(equals)),
            Some(TokenTree::Literal(text)),
            None,
        ) if doc == "doc" && equals.as_char() == '=' => {
            let text = syn::parse_str::<syn::LitStr>(&text.to_string())
                .ok()?
                .value();
            *tokens = ahead;
            Some((text, Some(group.span())))
        }
        _ => None,
    }
}

fn open_text(delimiter: Delimiter) -> &'static str {
    match delimiter {
        Delimiter::Parenthesis => "(",
        Delimiter::Brace => "{",
        Delimiter::Bracket => "[",
    }
}

fn close_text(delimiter: Delimiter) -> &'static str {
    match delimiter {
        Delimiter::Parenthesis => ")",
        Delimiter::Brace => "}",
        Delimiter::Bracket => "]",
    }
}
