//! The derivation as HTML: formulas are MathML, nothing is fetched, and no scripts run.

use lagrangian_symbolic::markup_words;

use super::document::{self, Block, Document, Inline, Row, Words};

/// The style sheet of the article: light and dark, for screen and print. All rules are within `.derivation`.
pub const STYLE: &str = r#".derivation { --ink: #1b1f24; --faint: #5c6672; --line: #d4dae1; color: var(--ink); line-height: 1.5; }
.derivation h2 { font-size: 1.25em; margin: 2em 0 .6em; padding-bottom: .2em; border-bottom: 1px solid var(--line); }
.derivation h3 { font-size: 1.05em; margin: 1.6em 0 .4em; }
.derivation p, .derivation ul { margin: .7em 0; max-width: 46em; }
.derivation ul { padding-left: 1.4em; }
.derivation li { margin: .3em 0; }
.derivation code { font-size: .92em; }
.derivation math { font-family: "Latin Modern Math", "STIX Two Math", "Cambria Math", math; }
.derivation .formula { margin: .8em 0; padding: .1em 0; overflow-x: auto; overflow-y: hidden; }
.derivation .formula math { display: block math; width: fit-content; margin: 0 0 0 1.5em; font-size: 1.1em; }
.derivation .formula mtd { text-align: left; padding: .28em 0; }
.derivation .formula mtable mtable mtd { text-align: center; padding: .3em .6em; }
.derivation .formula mtd.in1 { padding-left: 1em; }
.derivation .formula mtd.in2 { padding-left: 2em; }
.derivation .formula mtd.in3 { padding-left: 3em; }
.derivation .formula mtd.note { padding-left: 2.5em; color: var(--faint); font-size: .85em; font-style: italic; font-family: inherit; }
.derivation .table { overflow-x: auto; margin: .8em 0; }
.derivation table { border-collapse: collapse; }
.derivation th, .derivation td { text-align: left; vertical-align: top; padding: .25em .9em .25em 0; border-bottom: 1px solid var(--line); }
.derivation th { font-weight: 600; color: var(--faint); }
.derivation td.number, .derivation th.number { text-align: right; font-variant-numeric: tabular-nums; }
@media (prefers-color-scheme: dark) { .derivation { --ink: #e3e8ee; --faint: #9aa6b3; --line: #39424d; } }
@media print { .derivation { --ink: #000; --faint: #444; --line: #bbb; font-size: 10pt; } .derivation .formula { overflow: visible; } .derivation h2, .derivation h3 { break-after: avoid; } .derivation tr { break-inside: avoid; } }
"#;

/// The style sheet of a page that contains only the article.
const PAGE: &str = r"html { color-scheme: light dark; background: Canvas; }
body { margin: 0 auto; padding: 2.5em 1.5em 5em; max-width: 62em; font-family: Georgia, 'Times New Roman', serif; }
h1 { font-size: 1.7em; }
";

/// The document as a whole page.
pub fn text(document: &Document) -> String {
    let title = markup_words(&document.title);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <title>{title}</title>\n<style>\n{PAGE}{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n{}</body>\n</html>\n",
        article(document)
    )
}

/// The document as an element `article` without its title, for inclusion in another page with [`STYLE`]. Well-formed XML.
pub fn article(document: &Document) -> String {
    let mut html = String::from("<article class=\"derivation\">\n");
    for section in &document.sections {
        html.push_str("<section>\n");
        html.push_str(&format!("<h2>{}</h2>\n", markup_words(&section.title)));
        section
            .blocks
            .iter()
            .for_each(|block| html.push_str(&self::block(block)));
        html.push_str("</section>\n");
    }
    html.push_str("</article>\n");
    html
}

fn block(block: &Block) -> String {
    match block {
        Block::Heading(heading) => format!("<h3>{}</h3>\n", words(heading)),
        Block::Paragraph(paragraph) => format!("<p>{}</p>\n", words(paragraph)),
        Block::List(items) => {
            let items: String = items
                .iter()
                .map(|item| format!("<li>{}</li>\n", words(item)))
                .collect();
            format!("<ul>\n{items}</ul>\n")
        }
        Block::Formula(rows) => formula(rows),
        Block::Table(head, rows) => {
            // Columns of numbers are aligned as such.
            let numbers: Vec<bool> = (0..head.len())
                .map(|k| document::is_numeric(rows, k))
                .collect();
            let row = |cells: &[Words], tag: &str| {
                let cell = |(k, cell): (usize, &Words)| {
                    let class = match numbers.get(k) {
                        Some(true) => " class=\"number\"",
                        _ => "",
                    };
                    format!("<{tag}{class}>{}</{tag}>", words(cell))
                };
                let cells: String = cells.iter().enumerate().map(cell).collect();
                format!("<tr>{cells}</tr>\n")
            };
            let body: String = rows.iter().map(|cells| row(cells, "td")).collect();
            format!(
                "<div class=\"table\"><table>\n<thead>{}</thead>\n<tbody>\n{body}</tbody>\n</table></div>\n",
                row(head, "th").trim_end()
            )
        }
    }
}

/// The lines of a formula, as the rows of a table.
fn formula(rows: &[Row]) -> String {
    let has_notes = rows.iter().any(|row| !row.note.is_empty());
    let inner = match rows {
        [only] if !has_notes => only.math.mathml_row(),
        rows => {
            let row = |row: &Row| {
                let class = match row.indent {
                    0 => String::new(),
                    steps => format!(" class=\"in{}\"", steps.min(3)),
                };
                let note = match (has_notes, row.note.is_empty()) {
                    (false, _) => String::new(),
                    (true, true) => "<mtd></mtd>".to_owned(),
                    (true, false) => format!(
                        "<mtd class=\"note\"><mtext>{}</mtext></mtd>",
                        markup_words(&row.note)
                    ),
                };
                let math = row.math.mathml_row();
                format!("<mtr><mtd{class}><mrow>{math}</mrow></mtd>{note}</mtr>\n")
            };
            let rows: String = rows.iter().map(row).collect();
            format!("<mtable displaystyle=\"true\">\n{rows}</mtable>")
        }
    };
    format!("<div class=\"formula\"><math display=\"block\">{inner}</math></div>\n")
}

fn words(words: &Words) -> String {
    let run = |run: &Inline| match run {
        Inline::Text(text) => markup_words(text),
        Inline::Math(math) => math.mathml(),
        Inline::Code(code) => format!("<code>{}</code>", markup_words(code)),
        Inline::Emphasis(words) => format!("<em>{}</em>", markup_words(words)),
    };
    words.iter().map(run).collect()
}
