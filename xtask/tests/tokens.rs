//! Whether the lexer of specs cuts a text as the lexer of Rust's own macros does.
//!
//! It stands here and not beside the lexer, whose crate the macro needs: a dependency of tests there would ask for another
//! `proc-macro2` in tests than in builds, and everything above it would be compiled twice.

use std::fs;
use std::path::Path;

use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::SourceId;
use lagrangian_spec::token::lex;

#[test]
fn our_tokens_are_those_that_a_macro_sees() {
    // The examples of the language's reference, as printed there.
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../model-spec/tests/language/syntax");
    let mut examples = 0;
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let text = fs::read_to_string(&path).expect("a spec");
        examples += 1;
        let stream: proc_macro2::TokenStream = text.parse().expect("the examples are Rust tokens");
        let mut theirs = Vec::new();
        flatten(stream, &mut theirs);
        let mut report = Report::new();
        let ours: Vec<(usize, usize, bool)> = lex(SourceId(0), &text, &mut report)
            .iter()
            .map(|token| {
                (
                    token.span.start as usize,
                    token.span.end as usize,
                    token.joint,
                )
            })
            .collect();
        // Documentation is one token here, and `#[doc = "…"]` in its place there.
        let within = |a: (usize, usize, bool), b: (usize, usize, bool)| a.0 <= b.0 && b.1 <= a.1;
        let mut apart: Vec<(usize, usize, bool)> = Vec::new();
        for token in theirs {
            match apart.last_mut() {
                Some(last) if within(*last, token) => {}
                Some(last) if within(token, *last) => *last = (token.0, token.1, false),
                _ => apart.push(token),
            }
        }
        assert_eq!(ours, apart, "{}", path.display());
    }
    assert!(examples >= 5, "{examples}");
}

/// Place in bytes, and whether punctuation follows at once.
fn flatten(stream: proc_macro2::TokenStream, to: &mut Vec<(usize, usize, bool)>) {
    use proc_macro2::{Spacing, TokenTree};
    for tree in stream {
        let place = |span: proc_macro2::Span| (span.byte_range().start, span.byte_range().end);
        let (start, end) = place(tree.span());
        match tree {
            TokenTree::Group(group) => {
                let (open, close) = (place(group.span_open()), place(group.span_close()));
                to.push((open.0, open.1, false));
                flatten(group.stream(), to);
                to.push((close.0, close.1, false));
            }
            TokenTree::Punct(mark) => {
                let joint = mark.spacing() == Spacing::Joint;
                to.push((start, end, joint));
            }
            _ => to.push((start, end, false)),
        }
    }
}
