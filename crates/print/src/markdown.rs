//! The derivation as Markdown, with formulas between `$` and `$$`.

use super::document::{Block, Document, Inline, Row, Words};
use super::latex::indent;

/// The document as Markdown.
pub fn text(document: &Document) -> String {
    let mut text = format!("# {}\n", escaped(&document.title));
    for section in &document.sections {
        text.push_str(&format!("\n## {}\n", escaped(&section.title)));
        for block in &section.blocks {
            text.push('\n');
            match block {
                Block::Heading(heading) => text.push_str(&format!("### {}\n", words(heading))),
                Block::Paragraph(paragraph) => text.push_str(&format!("{}\n", words(paragraph))),
                Block::List(items) => {
                    for item in items {
                        text.push_str(&format!("- {}\n", words(item).replace('\n', " ")));
                    }
                }
                Block::Formula(rows) => text.push_str(&format!("$$\n{}\n$$\n", aligned(rows))),
                Block::Table(head, rows) => {
                    let rule = (0..head.len()).map(|k| {
                        if super::document::is_numeric(rows, k) {
                            "---:"
                        } else {
                            "---"
                        }
                    });
                    let rule: Vec<&str> = rule.collect();
                    text.push_str(&row(head));
                    text.push_str(&format!("| {} |\n", rule.join(" | ")));
                    rows.iter().for_each(|cells| text.push_str(&row(cells)));
                }
            }
        }
    }
    text
}

/// The lines of a formula, left-aligned, with notes in a separate column.
fn aligned(rows: &[Row]) -> String {
    match rows {
        [only] if only.note.is_empty() => only.math.latex(),
        rows => {
            let lines: Vec<String> = rows.iter().map(line).collect();
            format!(
                "\\begin{{aligned}}\n{}\n\\end{{aligned}}",
                lines.join(" \\\\\n")
            )
        }
    }
}

fn line(row: &Row) -> String {
    let indent = indent(row.indent);
    let note = match row.note.as_str() {
        "" => String::new(),
        note => format!(
            r" && \quad \text{{{}}}",
            lagrangian_symbolic::latex_words(note)
        ),
    };
    format!("&{indent} {}{note}", row.math.latex())
}

fn row(cells: &[Words]) -> String {
    let cells: Vec<String> = cells
        .iter()
        .map(|cell| words(cell).replace('\n', " "))
        .collect();
    format!("| {} |\n", cells.join(" | "))
}

fn words(words: &Words) -> String {
    let run = |run: &Inline| match run {
        Inline::Text(text) => escaped(text),
        Inline::Emphasis(words) => format!("*{}*", escaped(words)),
        Inline::Math(math) => format!("${}$", math.latex()),
        // The delimiter needs more backticks than the code contains; characters that end a table cell are
        // escaped in code too.
        Inline::Code(code) => {
            let longest = code.split(|c| c != '`').map(str::len).max().unwrap_or(0);
            let fence = "`".repeat(longest + 1);
            let space = if longest > 0 { " " } else { "" };
            format!("{fence}{space}{}{space}{fence}", code.replace('|', r"\|"))
        }
    };
    words.iter().map(run).collect()
}

/// Text with all characters escaped that have a meaning in Markdown.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    // Whether only digits have been written on this line: `1.` would begin a list.
    let mut number = true;
    let mut start = true;
    for letter in text.chars() {
        let special = match letter {
            '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '|' | '~' | '$' | '&' => true,
            '#' | '+' | '-' | '=' => start,
            '.' | ')' => number && !start,
            _ => false,
        };
        if special {
            escaped.push('\\');
        }
        escaped.push(letter);
        number = letter == '\n' || (number && letter.is_ascii_digit());
        start = letter == '\n' || (start && letter.is_whitespace());
    }
    escaped
}
