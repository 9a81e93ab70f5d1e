//! A document independent of the output format: sections, words, formulas, tables.
//!
//! [`markdown`](super::markdown), [`latex`](super::latex) and [`html`](super::html) print the same [`Document`]. Its
//! formulas are values, not texts in one of these formats.

use lagrangian_symbolic::Math;
use lagrangian_symbolic::print::{Mark, Sign};

/// The width of a line of a formula in em: less than the 47 em of A4 paper with margins of 2 cm, since
/// [`Math::width`] is an estimate.
pub(super) const LINE: f32 = 43.0;

/// The width of a step of indentation, in em.
pub(super) const INDENT: f32 = 1.0;

/// By how much a line that cannot be broken may exceed the width: less than the margin of the page.
const TOLERANCE: f32 = 2.0;

/// The width of a note at the right margin, in em.
const NOTE: f32 = 8.0;

/// A derivation to read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Document {
    /// The title: the machine's name.
    pub title: String,
    /// The chapters.
    pub sections: Vec<Section>,
}

/// A chapter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Section {
    /// Its title.
    pub title: String,
    /// Its contents.
    pub blocks: Vec<Block>,
}

/// A block of a chapter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Block {
    /// A heading below that of the section.
    Heading(Words),
    /// A paragraph.
    Paragraph(Words),
    /// A list, one item below the other.
    List(Vec<Words>),
    /// A formula, line by line.
    Formula(Vec<Row>),
    /// A table: its head, its rows.
    Table(Vec<Words>, Vec<Vec<Words>>),
}

/// Text with formulas and code in it.
pub type Words = Vec<Inline>;

/// A piece of a line of text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Inline {
    /// Plain text, not escaped.
    Text(String),
    /// Mathematics.
    Math(Math),
    /// Code of a program or a spec.
    Code(String),
    /// Emphasized text.
    Emphasis(String),
}

/// Parses a paragraph of a doc comment: code is between backticks, emphasized text between asterisks.
///
/// As in CommonMark, an opening asterisk must precede a word and a closing one must follow one, so the asterisks of `2*m*l`
/// are literal. An asterisk without a partner is literal too.
pub fn of_docs(paragraph: &str) -> Words {
    let mut words = Vec::new();
    let mut plain = String::new();
    let mut rest = paragraph.trim();
    let mut before = None;
    while let Some(letter) = rest.chars().next() {
        let marked = match letter {
            '`' => between(rest, "`").map(|(code, after)| (Inline::Code(code.to_owned()), after)),
            '*' if !before.is_some_and(char::is_alphanumeric) => {
                emphasized(rest).map(|(words, after)| (Inline::Emphasis(words.to_owned()), after))
            }
            _ => None,
        };
        let Some((run, after)) = marked else {
            plain.push(letter);
            before = Some(letter);
            rest = &rest[letter.len_utf8()..];
            continue;
        };
        if !plain.is_empty() {
            words.push(Inline::Text(std::mem::take(&mut plain)));
        }
        words.push(run);
        before = Some(letter);
        rest = after;
    }
    if !plain.is_empty() {
        words.push(Inline::Text(plain));
    }
    words
}

/// Splits a text that begins with a mark into the part up to the next mark and the rest.
fn between<'t>(text: &'t str, mark: &str) -> Option<(&'t str, &'t str)> {
    text.strip_prefix(mark)?.split_once(mark)
}

/// Splits a text that begins with asterisks into the words up to the closing ones and the rest.
fn emphasized(text: &str) -> Option<(&str, &str)> {
    let mark = if text.starts_with("**") { "**" } else { "*" };
    let inside = text.strip_prefix(mark)?;
    if inside.starts_with(|letter: char| letter.is_whitespace() || letter == '*') {
        return None;
    }
    let closes = |(at, _): &(usize, &str)| {
        let (words, after) = (&inside[..*at], &inside[at + mark.len()..]);
        let ends_a_word = |letter: char| !letter.is_whitespace() && letter != '*';
        words.ends_with(ends_a_word)
            && !after.starts_with(|letter: char| letter.is_alphanumeric() || letter == '*')
    };
    let (at, _) = inside.match_indices(mark).find(closes)?;
    Some((&inside[..at], &inside[at + mark.len()..]))
}

/// A line of a formula.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Row {
    /// The formula on this line.
    pub math: Math,
    /// The steps of indentation; continuation lines are indented.
    pub indent: usize,
    /// The note at the right margin, if it is not empty.
    pub note: String,
}

impl From<&str> for Inline {
    fn from(text: &str) -> Inline {
        Inline::Text(text.to_owned())
    }
}

impl From<String> for Inline {
    fn from(text: String) -> Inline {
        Inline::Text(text)
    }
}

impl From<Math> for Inline {
    fn from(math: Math) -> Inline {
        Inline::Math(math)
    }
}

/// How a column of a table is set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Column {
    /// Aligned numbers, with this width in em.
    Numbers(f32),
    /// Each cell on one line, with this width in em.
    Line(f32),
    /// Cells broken into lines of this width in em.
    Wrapped(f32),
}

impl Column {
    /// Its total width in em, with the space around it.
    pub fn width(self) -> f32 {
        // Two times 6 points.
        const SPACE: f32 = 1.2;
        let (Column::Numbers(width) | Column::Line(width) | Column::Wrapped(width)) = self;
        width + SPACE
    }
}

/// The columns of a table such that it fits on a page: the last column of text is wrapped, and if the rest is too
/// wide the widest other one is wrapped too.
pub fn columns(head: &[Words], rows: &[Vec<Words>]) -> Vec<Column> {
    let natural = |k: usize| {
        let rows = rows.iter().map(Vec::as_slice).chain([head]);
        let cells = rows.filter_map(|row| row.get(k));
        cells.map(width_of_words).fold(0.0, f32::max)
    };
    let column = |k: usize| {
        if is_numeric(rows, k) {
            Column::Numbers(natural(k))
        } else if k + 1 == head.len() {
            Column::Wrapped(DESCRIPTION)
        } else {
            Column::Line(natural(k))
        }
    };
    let mut columns: Vec<Column> = (0..head.len()).map(column).collect();
    let total: f32 = columns.iter().map(|column| column.width()).sum();
    let line_width = |column: &Column| match column {
        Column::Line(width) => *width,
        _ => 0.0,
    };
    let by_width = |a: &&mut Column, b: &&mut Column| line_width(a).total_cmp(&line_width(b));
    if total > PAGE
        && let Some(widest) = columns.iter_mut().max_by(by_width)
    {
        let left = line_width(widest) - (total - PAGE);
        *widest = Column::Wrapped(left.max(LEAST_WRAPPED));
    }
    columns
}

/// The width of a table, in em: 17 cm in a 10 point font, minus the error of the estimate.
const PAGE: f32 = 47.0;

/// The width of a column that describes the entries of the others, in em: 7 cm.
const DESCRIPTION: f32 = 19.9;

/// The smallest width of wrapped text, in em: a long word.
const LEAST_WRAPPED: f32 = 8.0;

/// The approximate width of text on one line, in em.
fn width_of_words(words: &Words) -> f32 {
    // In typewriter type all letters have the same width.
    let run = |run: &Inline| match run {
        Inline::Text(text) => Math::text(text.clone()).width(),
        Inline::Math(math) => math.width(),
        Inline::Code(code) => 0.525 * code.chars().count() as f32,
        Inline::Emphasis(words) => Math::text(words.clone()).width(),
    };
    words.iter().map(run).sum()
}

impl Row {
    /// A formula broken into lines: the first is indented by this number of steps, the others by two more; the note
    /// is on the first.
    ///
    /// A part that does not fit on the page even so, such as a very long fraction, is left out, and the line says so.
    pub fn lines(math: &Math, indent: usize, note: &str) -> Vec<Row> {
        let width = LINE - if note.is_empty() { 0.0 } else { NOTE };
        let width = |steps: usize| width - INDENT * steps as f32;
        let mut lines = math.lines(width(indent), width(indent + 2));
        let margin = LINE + TOLERANCE - INDENT * (indent + 2) as f32;
        if lines.iter().any(|line| line.width() > margin) {
            lines = vec![left_out(math, margin)];
        }
        let lines = lines.into_iter();
        let row = |(index, math)| Row {
            math,
            indent: if index == 0 { indent } else { indent + 2 },
            note: if index == 0 {
                note.to_owned()
            } else {
                String::new()
            },
        };
        lines.enumerate().map(row).collect()
    }
}

/// A formula without its right-hand side, or without its left-hand side if that alone is too wide, or reduced to its sign.
fn left_out(math: &Math, width: f32) -> Math {
    let marks = math.marks();
    let row = |marks: &[Mark]| Math::row(marks.iter().cloned().map(Math::mark));
    let note = || Math::text("(too wide for a page, not shown)");
    let sign = match marks.first() {
        Some(Mark::Sign(Sign::Plus | Sign::Minus)) => Math::mark(Mark::Sign(Sign::Plus)),
        _ => Math::default(),
    };
    let equals = marks
        .iter()
        .position(|mark| *mark == Mark::Sign(Sign::Equals));
    let Some(equals) = equals else {
        return Math::row([sign, note()]);
    };
    let without_right = Math::row([row(&marks[..=equals]), note()]);
    let without_left = Math::row([sign.clone(), note(), row(&marks[equals..])]);
    let shortened = [without_right, without_left];
    let fits = |formula: &Math| formula.width() <= width;
    shortened
        .into_iter()
        .find(fits)
        .unwrap_or_else(|| Math::row([sign, note()]))
}

impl Block {
    /// A block with a formula on as many lines as it needs.
    pub fn formula(math: &Math) -> Block {
        Block::Formula(Row::lines(math, 0, ""))
    }
}

/// Whether a column contains only decimal numbers, or dashes in their place.
pub(super) fn is_numeric(rows: &[Vec<Words>], column: usize) -> bool {
    let is_number = |cells: &Vec<Words>| match cells.get(column).map(Vec::as_slice) {
        Some([Inline::Text(text)]) => text
            .chars()
            .all(|c| c.is_ascii_digit() || matches!(c, '.' | '–')),
        _ => false,
    };
    !rows.is_empty() && rows.iter().all(is_number)
}
