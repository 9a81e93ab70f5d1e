//! The derivation as LaTeX: a complete document that requires only `amsmath`, `longtable` and `geometry`.

use std::collections::BTreeSet;

use lagrangian_symbolic::latex_words;

use super::document::{Block, Column, Document, Inline, Row, Words, columns};

/// The document as LaTeX.
pub fn text(document: &Document) -> String {
    let mut body = format!("\\section*{{{}}}\n", latex_words(&document.title));
    for section in &document.sections {
        body.push_str(&format!(
            "\n\\subsection*{{{}}}\n",
            latex_words(&section.title)
        ));
        let mut before: Option<&Block> = None;
        for block in &section.blocks {
            // A formula belongs to the paragraph before it. Directly below a heading there is none, and the empty
            // line of one must be removed.
            match (block, before) {
                (Block::Formula(_), Some(Block::Heading(_))) => {
                    body.push_str("\\leavevmode\\vspace{-2\\baselineskip}\n");
                }
                (Block::Formula(_), _) => {}
                _ => body.push('\n'),
            }
            before = Some(block);
            match block {
                Block::Heading(heading) => {
                    body.push_str(&format!("\\subsubsection*{{{}}}\n", words(heading)));
                }
                Block::Paragraph(paragraph) => body.push_str(&format!("{}\n", words(paragraph))),
                Block::List(items) => {
                    body.push_str("\\begin{itemize}\n");
                    for item in items {
                        body.push_str(&format!("\\item {}\n", words(item)));
                    }
                    body.push_str("\\end{itemize}\n");
                }
                Block::Formula(rows) => body.push_str(&formula(rows)),
                Block::Table(head, rows) => body.push_str(&table(head, rows)),
            }
        }
    }
    format!("{}{body}\\end{{document}}\n", preamble(&body))
}

fn preamble(body: &str) -> String {
    let mut text = String::from(concat!(
        "\\documentclass[a4paper,fleqn]{article}\n",
        "\\usepackage[utf8]{inputenc}\n",
        "\\usepackage[T1]{fontenc}\n",
        "\\usepackage{textcomp}\n",
        "\\usepackage{amsmath}\n",
        "\\usepackage{longtable}\n",
        "\\usepackage[margin=2cm]{geometry}\n",
        "\\allowdisplaybreaks\n",
        "\\setlength{\\mathindent}{1em}\n",
        "\\setlength{\\parindent}{0pt}\n",
        "\\setlength{\\parskip}{4pt}\n",
        "\\setlength{\\LTleft}{0pt}\n",
        "\\raggedright\n",
    ));
    // Letters that the available fonts may lack appear as their code number instead of ending the run; engines that
    // read Unicode print them as they are.
    let foreign: BTreeSet<char> = body.chars().filter(|&c| c > '\u{17f}').collect();
    for letter in foreign {
        let number = letter as u32;
        text.push_str(&format!(
            "\\ifdefined\\DeclareUnicodeCharacter\\DeclareUnicodeCharacter{{{number:04X}}}{{[U+{number:04X}]}}\\fi\n"
        ));
    }
    text.push_str("\\begin{document}\n");
    text
}

/// The lines of a formula, left-aligned, with notes at the right margin. A page break is allowed between lines.
fn formula(rows: &[Row]) -> String {
    let line = |row: &Row| {
        let indent = indent(row.indent);
        let note = match row.note.as_str() {
            "" => String::new(),
            note => format!(r" \tag*{{\footnotesize {}}}", latex_words(note)),
        };
        format!("&{indent} {}{note}", row.math.latex())
    };
    let lines: Vec<String> = rows.iter().map(line).collect();
    format!(
        "\\begin{{align*}}\n{}\n\\end{{align*}}\n",
        lines.join(" \\\\\n")
    )
}

/// The space before a line, followed by an empty atom, so that a sign after it is typeset as a binary operator.
pub(super) fn indent(steps: usize) -> String {
    match steps {
        0 => String::new(),
        _ => format!("{} {{}}", r"\quad".repeat(steps)),
    }
}

fn table(head: &[Words], rows: &[Vec<Words>]) -> String {
    // A 10 point font has 28.45 points in a centimetre.
    let columns = columns(head, rows).into_iter().map(|column| match column {
        Column::Numbers(_) => "r".to_owned(),
        Column::Line(_) => "l".to_owned(),
        Column::Wrapped(width) => format!("p{{{:.1}cm}}", 10.0 * width / 28.45),
    });
    let columns: String = columns.collect();
    let row = |cells: &[Words]| {
        let cells: Vec<String> = cells.iter().map(words).collect();
        format!("{} \\\\\n", cells.join(" & "))
    };
    let body: String = rows.iter().map(|cells| row(cells)).collect();
    format!(
        "\\begin{{longtable}}{{{columns}}}\n{}\\hline\n\\endhead\n{body}\\end{{longtable}}\n",
        row(head)
    )
}

fn words(words: &Words) -> String {
    let run = |run: &Inline| match run {
        Inline::Text(text) => latex_words(text),
        Inline::Math(math) => format!("${}$", math.latex()),
        Inline::Code(code) => format!(r"\texttt{{{}}}", latex_words(code)),
        Inline::Emphasis(words) => format!(r"\emph{{{}}}", latex_words(words)),
    };
    words.iter().map(run).collect()
}
