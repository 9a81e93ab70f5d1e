//! Renders messages as text: in a short form for other programs, and in a form with underlined source text.

use std::fmt::Write as _; // writing to a String cannot fail

use super::{Diagnostic, Report};
use crate::source::{Sources, Span};

/// The largest number of characters of a line that are shown, since a spec may be written on one line.
const WIDTH: usize = 140;

/// The width of a tab.
const TAB: &str = "    ";

impl Diagnostic {
    /// On one line, for other programs: `file:line:column: error: message [code]`; then the help
    /// and other places, indented.
    pub fn render_short(&self, sources: &Sources) -> String {
        let place = location(sources, self.span);
        let severity = self.code.severity().as_str();
        let mut text = format!("{place}: {severity}: {} [{}]", self.message, self.code);
        if let Some(help) = &self.help {
            let _ = write!(text, "\n    help: {help}");
        }
        for (span, note) in &self.notes {
            let place = self::location(sources, *span);
            let _ = write!(text, "\n    note: {place}: {note}");
        }
        text
    }

    /// With underlined source text:
    ///
    /// ```text
    /// error: a spring has no field `stifness` [unknown-field]
    ///        help: did you mean `stiffness`?
    ///  --> cart.machine:4:22
    ///   |
    /// 4 |     springs { rope { stifness: c, from: rail.end, to: cart.at } }
    ///   |                      ^^^^^^^^
    /// ```
    pub fn render(&self, sources: &Sources) -> String {
        let places = || {
            [self.span]
                .into_iter()
                .chain(self.notes.iter().map(|note| note.0))
        };
        let lines = places().map(|span| sources.line_column(span).0);
        let margin = lines.max().unwrap_or(1).to_string().len();
        let severity = self.code.severity().as_str();
        let mut text = format!("{severity}: {} [{}]", self.message, self.code);
        if let Some(help) = &self.help {
            let indent = severity.len() + 2;
            let _ = write!(text, "\n{:indent$}help: {help}", "");
        }
        text.push_str(&snippet(sources, self.span, margin, '^'));
        for (span, note) in &self.notes {
            let _ = write!(text, "\nnote: {note}");
            text.push_str(&snippet(sources, *span, margin, '-'));
        }
        text
    }
}

impl Report {
    /// The short form of every error and warning, by position.
    pub fn render_short(&self, sources: &Sources) -> String {
        self.lines(|diagnostic| diagnostic.render_short(sources))
    }

    /// Every error and warning with underlined source text, by position, each followed by an empty line.
    pub fn render(&self, sources: &Sources) -> String {
        self.lines(|diagnostic| diagnostic.render(sources) + "\n")
    }

    fn lines(&self, render: impl Fn(&Diagnostic) -> String) -> String {
        let mut text = String::new();
        for diagnostic in self.messages() {
            text.push_str(&render(diagnostic));
            text.push('\n');
        }
        if self.omitted() > 0 {
            let _ = writeln!(text, "({} more errors are not shown)", self.omitted());
        }
        text
    }
}

/// `file:line:column`.
fn location(sources: &Sources, span: Span) -> String {
    let (line, column) = sources.line_column(span);
    format!("{}:{line}:{column}", sources.name(span.source))
}

/// The place and, for a file, its line with the words underlined by `mark`.
fn snippet(sources: &Sources, span: Span, margin: usize, mark: char) -> String {
    let mut text = format!("\n{:margin$}--> {}", "", location(sources, span));
    if sources.is_tokens(span.source) {
        return text;
    }
    let (number, column) = sources.line_column(span);
    let line = sources.line(span.source, number);
    // A span over several lines is underlined to the end of its first.
    let length = sources
        .words(span)
        .lines()
        .next()
        .unwrap_or("")
        .chars()
        .count();
    let (line, before, length) = window(line, column - 1, length);
    let _ = write!(
        text,
        "\n{:margin$} |\n{number:margin$} | {line}\n{:margin$} | {:before$}{}",
        "",
        "",
        "",
        mark.to_string().repeat(length.max(1)),
    );
    text
}

/// The part of a line that is shown, the offset of the underlined words in it, and their length.
fn window(line: &str, column: usize, length: usize) -> (String, usize, usize) {
    let long = line.chars().nth(WIDTH).is_some();
    // A little of the text before the words helps to find them.
    let skipped = if long {
        column.saturating_sub(WIDTH / 3)
    } else {
        0
    };
    let shown: String = line.chars().skip(skipped).take(WIDTH).collect();
    let expand = |text: &str| text.replace('\t', TAB);
    let split = |at: usize| {
        shown
            .char_indices()
            .nth(at)
            .map_or(shown.len(), |(byte, _)| byte)
    };
    let (start, end) = (split(column - skipped), split(column - skipped + length));
    let before = expand(&shown[..start]).chars().count();
    let words = expand(&shown[start..end]).chars().count();
    (expand(&shown).trim_end().to_owned(), before, words)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::Code;

    /// The message `wrong` at these words of `text`.
    fn rendered(text: &str, words: &str, note: Option<&str>) -> String {
        let mut sources = Sources::new();
        let id = sources.add("cart.machine", text);
        let span = |words: &str| {
            let start = text.find(words).unwrap_or(text.len());
            Span::new(id, start as u32, (start + words.len()) as u32)
        };
        let mut diagnostic =
            Diagnostic::new(Code::UnknownField, span(words), "wrong").help("right");
        if let Some(note) = note {
            diagnostic = diagnostic.note(span(note), "here");
        }
        diagnostic.render(&sources)
    }

    #[test]
    fn the_words_are_underlined() {
        let text = "a\n\tspring { stifness: θ }\n".to_owned() + &"\n".repeat(8) + "  other";
        assert_eq!(
            rendered(&text, "stifness", Some("other")),
            "error: wrong [unknown-field]\n       help: right\n  --> cart.machine:2:11\n   |\n \
             2 |     spring { stifness: θ }\n   |              ^^^^^^^^\nnote: here\n  \
             --> cart.machine:11:3\n   |\n11 |   other\n   |   -----"
        );
    }

    #[test]
    fn what_is_missing_at_the_end_is_pointed_at() {
        let text = "machine";
        assert!(rendered(text, "?", None).ends_with("1 | machine\n  |        ^"));
    }

    #[test]
    fn words_over_several_lines_are_underlined_to_the_end_of_the_first() {
        let text = "a {\n b }";
        assert!(rendered(text, "{\n b }", None).ends_with("1 | a {\n  |   ^"));
    }

    #[test]
    fn a_long_line_is_cut() {
        let text = "x ".repeat(1000) + "wrong" + &" y".repeat(1000);
        let shown = rendered(&text, "wrong", None);
        let line = shown
            .lines()
            .find(|line| line.starts_with("1 |"))
            .unwrap_or("");
        let marks = shown.lines().last().unwrap_or("");
        assert_eq!(line.find("wrong"), marks.find("^^^^^"));
        assert!(line.len() < 150, "{shown}");
    }

    #[test]
    fn a_macro_has_places_without_text() {
        let mut sources = Sources::new();
        let id = sources.add_tokens("src/main.rs", vec![(3, 5)]);
        let diagnostic = Diagnostic::new(Code::UnknownField, Span::new(id, 0, 1), "wrong");
        assert_eq!(
            diagnostic.render(&sources),
            "error: wrong [unknown-field]\n --> src/main.rs:3:5"
        );
    }
}
