//! Diagnostics in the style of the Rust compiler, with the source underlined; and as JSON.

use std::fmt;
use std::io::IsTerminal;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use lagrangian_spec::diagnostic::{Diagnostic, Report, Severity};
use lagrangian_spec::source::{Sources, Span};
use serde::Serialize;

use crate::output;
use crate::placed::Placed;

/// One diagnostic in `check --json`.
#[derive(Debug, Serialize)]
pub struct Entry {
    severity: &'static str,
    code: &'static str,
    message: String,
    help: Option<String>,
    file: String,
    line: usize,
    column: usize,
}

/// The errors and warnings of a report, in the order of their positions.
pub fn entries(report: &Report, sources: &Sources) -> Vec<Entry> {
    let diagnostics = report.messages().into_iter();
    diagnostics
        .map(|diagnostic| entry(diagnostic, sources))
        .collect()
}

/// One diagnostic.
pub fn entry(diagnostic: &Diagnostic, sources: &Sources) -> Entry {
    let (line, column) = sources.line_column(diagnostic.span);
    Entry {
        severity: diagnostic.code.severity().as_str(),
        code: diagnostic.code.as_str(),
        message: diagnostic.message.clone(),
        help: diagnostic.help.clone(),
        file: sources.name(diagnostic.span.source).to_owned(),
        line,
        column,
    }
}

/// One line: the position and the message.
impl fmt::Display for Entry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Entry {
            file,
            line,
            column,
            message,
            ..
        } = self;
        write!(f, "{file}:{line}:{column}: {message}")
    }
}

/// Prints the error of a run to standard error, with its place in the spec underlined.
pub fn print_placed(error: &Placed) {
    let kind = match error.note {
        None => AnnotationKind::Primary,
        Some(_) => AnnotationKind::Context,
    };
    let place = snippet(&error.sources, error.span, kind, error.note.as_ref());
    let group = Group::with_title(Level::ERROR.primary_title(&error.message)).element(place);
    output::print_error(renderer().render(&[group]));
}

/// Renders in colour on a terminal.
fn renderer() -> Renderer {
    if std::io::stderr().is_terminal() {
        Renderer::styled()
    } else {
        Renderer::plain()
    }
}

/// Prints a report to standard error, in colour on a terminal.
pub fn print(report: &Report, sources: &Sources) {
    let renderer = renderer();
    for diagnostic in report.messages() {
        output::print_error(format_args!("{}\n", render(diagnostic, sources, &renderer)));
    }
    let errors = report.diagnostics().len() + report.omitted();
    if errors > 0 {
        output::print_error(counted(errors, "error", "errors"));
    }
}

/// Checks what the spec says about parameters given by a call. Prints warnings.
///
/// # Errors
/// The first error, in the words of the spec: values that a machine cannot have, such as a negative mass.
pub fn check(diagnostics: &[Diagnostic]) -> Result<(), String> {
    for diagnostic in diagnostics {
        match diagnostic.code.severity() {
            Severity::Error => return Err(format!("{} [{}]", diagnostic.message, diagnostic.code)),
            Severity::Warning => {
                output::print_error(format_args!("warning: {}", diagnostic.message));
            }
        }
    }
    Ok(())
}

/// `1 error`, `2 errors`.
pub fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

fn render(diagnostic: &Diagnostic, sources: &Sources, renderer: &Renderer) -> String {
    let title = format!("{} [{}]", diagnostic.message, diagnostic.code);
    let level = match diagnostic.code.severity() {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let mut group = Group::with_title(level.primary_title(&title)).element(snippet(
        sources,
        diagnostic.span,
        AnnotationKind::Primary,
        None,
    ));
    for (span, note) in &diagnostic.notes {
        group = group.element(snippet(sources, *span, AnnotationKind::Context, Some(note)));
    }
    if let Some(help) = &diagnostic.help {
        group = group.element(Level::HELP.message(help));
    }
    renderer.render(&[group])
}

fn snippet<'a>(
    sources: &'a Sources,
    span: Span,
    kind: AnnotationKind,
    label: Option<&'a String>,
) -> Snippet<'a, annotate_snippets::Annotation<'a>> {
    let text = sources.text(span.source);
    // A span always lies within its text; clamping ensures that an invalid one does not hide the message.
    let start = char_boundary_before(text, span.start as usize);
    let end = char_boundary_before(text, span.end as usize).max(start);
    let annotation = kind.span(start..end);
    let annotation = match label {
        Some(label) => annotation.label(label.as_str()),
        None => annotation,
    };
    Snippet::source(text)
        .path(sources.name(span.source))
        .annotation(annotation)
}

/// The last character boundary at or before `at`.
fn char_boundary_before(text: &str, at: usize) -> usize {
    let at = at.min(text.len());
    (0..=at)
        .rev()
        .find(|&at| text.is_char_boundary(at))
        .unwrap_or(0)
}
