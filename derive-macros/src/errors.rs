//! Diagnostics as errors of the Rust compiler, located at the user's tokens.

use lagrangian_spec::diagnostic::{Diagnostic, Report};
use lagrangian_spec::source::Sources;
use proc_macro2::{Delimiter, Group, Ident, Literal, Punct, Spacing, Span, TokenStream, TokenTree};

/// All errors at once. `place` maps a span of a source to its first and last place for the Rust compiler.
pub fn all(
    report: &Report,
    sources: &Sources,
    place: impl Fn(lagrangian_spec::source::Span) -> (Span, Span),
) -> TokenStream {
    let mut errors = TokenStream::new();
    for diagnostic in report.diagnostics() {
        let (start, end) = place(diagnostic.span);
        errors.extend(compile_error(start, end, &message(diagnostic, sources)));
    }
    if report.omitted() > 0 {
        let message = format!("{} more errors are not shown", report.omitted());
        errors.extend(compile_error(
            Span::call_site(),
            Span::call_site(),
            &message,
        ));
    }
    errors
}

/// The message; for a file it includes the position, because the Rust compiler cannot point into that file.
fn message(diagnostic: &Diagnostic, sources: &Sources) -> String {
    let Diagnostic {
        code,
        message,
        help,
        span,
        notes,
    } = diagnostic;
    let mut text = format!("{message} [{code}]");
    if !sources.is_tokens(span.source) {
        let (line, column) = sources.line_column(*span);
        let name = sources.name(span.source);
        let source = sources.line(span.source, line);
        let length = sources
            .words(*span)
            .lines()
            .next()
            .map_or(1, |words| words.chars().count().max(1));
        text = format!(
            "{name}:{line}:{column}: {text}\n\n    {source}\n    {}{}\n",
            " ".repeat(column - 1),
            "^".repeat(length)
        );
    }
    for (span, note) in notes {
        let (line, column) = sources.line_column(*span);
        text.push_str(&format!(
            "\nnote: {}:{line}:{column}: {note}",
            sources.name(span.source)
        ));
    }
    if let Some(help) = help {
        text.push_str(&format!("\nhelp: {help}"));
    }
    text
}

/// `::core::compile_error! { "message" }`, which the compiler underlines from `start` to `end`.
pub fn compile_error(start: Span, end: Span, message: &str) -> TokenStream {
    let punct = |c, spacing, span| {
        let mut punct = Punct::new(c, spacing);
        punct.set_span(span);
        TokenTree::Punct(punct)
    };
    let mut literal = Literal::string(message);
    literal.set_span(end);
    let mut group = Group::new(Delimiter::Brace, TokenTree::Literal(literal).into());
    group.set_span(end);
    [
        punct(':', Spacing::Joint, start),
        punct(':', Spacing::Alone, start),
        TokenTree::Ident(Ident::new("core", start)),
        punct(':', Spacing::Joint, start),
        punct(':', Spacing::Alone, start),
        TokenTree::Ident(Ident::new("compile_error", start)),
        punct('!', Spacing::Alone, start),
        TokenTree::Group(group),
    ]
    .into_iter()
    .collect()
}
