//! The derivation of a machine as a chapter of a book on mechanics.
//!
//! Everything in it is computed from the model and its equations; claims that something is absent have been decided in the
//! prime field ([`EquationProperties`]). Long formulas are left out, and so are the middle members of a long family; the text says so, and
//! where to find them.

mod conserved;
mod constraints;
mod contacts;
mod energies;
mod kinematics;
mod machine;
mod motion;
mod program;
mod published;
mod unilateral;

use lagrangian_symbolic::{Expr, Math, Names, math};

use super::document::{Block, Document, Inline, Row, Section, Words, of_docs};
use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::equations::groups::{self, Share};
use lagrangian_mechanics::equations::integrals::EquationProperties;
use lagrangian_spec::model::{Model, Name};

/// Expressions of a greater [`size`](Expr::size) are not printed: they would fill pages that nobody reads.
const READABLE: u64 = 3000;

/// Of families with more members than this only the first few and the last are shown.
const LONG_FAMILY: usize = 6;

/// The number of members of a long family that are shown before the last.
const FIRST_MEMBERS: usize = 2;

/// The data from which the sections are written.
struct Chapter<'a, 'd> {
    compiled: &'a Compiled<'d>,
    model: &'a Model<'d>,
    shares: Vec<Share<'d>>,
    properties: EquationProperties<'d>,
}

impl Document {
    /// The derivation of a machine, as a document.
    pub fn new(compiled: &Compiled<'_>) -> Document {
        Document {
            title: compiled.model.name.clone(),
            sections: sections(compiled),
        }
    }
}

/// The sections of a machine's chapter.
fn sections(compiled: &Compiled<'_>) -> Vec<Section> {
    let chapter = Chapter {
        compiled,
        model: &compiled.model,
        shares: groups::force_shares(&compiled.model),
        properties: EquationProperties::of(&compiled.model, &compiled.equations),
    };
    let sections = [
        ("The machine", chapter.machine()),
        ("Kinematics", chapter.kinematics()),
        ("Energies and forces", chapter.energies()),
        ("Equations of motion", chapter.motion()),
        ("Constraints", chapter.constraints()),
        ("Friction", chapter.contacts()),
        ("Contacts", chapter.unilateral()),
        ("Mass matrix", chapter.mass_matrix()),
        ("Conserved quantities and absent terms", chapter.conserved()),
        ("Published equations", chapter.published()),
        ("The code", chapter.program()),
    ];
    let sections = sections
        .into_iter()
        .filter(|(_, blocks)| !blocks.is_empty());
    sections
        .map(|(title, blocks)| Section {
            title: title.into(),
            blocks,
        })
        .collect()
}

/// Joins pieces to a line of words.
macro_rules! words {
    ($($run:expr),* $(,)?) => { vec![$($crate::document::Inline::from($run)),*] };
}
use words;

impl<'d> Chapter<'_, 'd> {
    /// An expression as a formula, arranged to be short.
    fn math(&self, expression: Expr<'d>) -> Math {
        math(expression, self.model.dag)
    }

    /// The name of a symbol, or the formula of another expression.
    fn name(&self, symbol: Expr<'d>) -> Math {
        match symbol.as_symbol() {
            Some(symbol) => self.model.dag.math(symbol),
            None => self.math(symbol),
        }
    }

    /// `left = right`, or a statement of its length if it is too long.
    fn equality(&self, left: Math, right: Expr<'d>, note: &str) -> Vec<Row> {
        if right.size() > READABLE {
            let long = Math::text(format!("{} symbols, not shown", right.size()));
            return Row::lines(&left.equals(long), 0, note);
        }
        Row::lines(&left.equals(self.math(right)), 0, note)
    }
}

/// An item of a list that is shown, or members of a family that are left out.
enum Shown {
    /// The item with this index.
    Item(usize),
    /// The first index and the number of items that are left out, members of one family.
    Omitted(usize, usize),
}

/// Which items of a list are shown: the first two and the last of a long family.
fn shown<'n>(names: impl Iterator<Item = &'n Name>) -> Vec<Shown> {
    let names: Vec<&Name> = names.collect();
    let mut shown = Vec::new();
    let mut begin = 0;
    while begin < names.len() {
        let family = |name: &&&Name| name.index.is_some() && name.base == names[begin].base;
        let length = names[begin..].iter().take_while(family).count().max(1);
        if length > LONG_FAMILY {
            shown.extend((begin..begin + FIRST_MEMBERS).map(Shown::Item));
            shown.push(Shown::Omitted(
                begin + FIRST_MEMBERS,
                length - FIRST_MEMBERS - 1,
            ));
            shown.push(Shown::Item(begin + length - 1));
        } else {
            shown.extend((begin..begin + length).map(Shown::Item));
        }
        begin += length;
    }
    shown
}

/// A name such as `bob[3]` or `x_left` as a subscript.
fn label(name: &Name) -> Math {
    let base = name.base.replace('_', " ");
    match name.index {
        Some(index) => Math::text(format!("{base} {index}")),
        None => Math::text(base),
    }
}

fn code(text: impl ToString) -> Inline {
    Inline::Code(text.to_string())
}

/// The text of a doc comment, in paragraphs.
fn prose(docs: &str) -> Vec<Block> {
    let paragraphs = docs.split("\n\n").filter(|text| !text.trim().is_empty());
    paragraphs
        .map(|text| Block::Paragraph(of_docs(text)))
        .collect()
}

/// `a`, `a and b`, `a, b and c`.
fn listed(items: impl IntoIterator<Item = Words>) -> Words {
    let items: Vec<Words> = items.into_iter().collect();
    let last = items.len().saturating_sub(1);
    let mut words = Vec::new();
    for (index, item) in items.into_iter().enumerate() {
        match index {
            0 => {}
            _ if index == last => words.extend(words![" and "]),
            _ => words.extend(words![", "]),
        }
        words.extend(item);
    }
    words
}

/// Joins pieces of lines to a paragraph.
fn paragraph(parts: impl IntoIterator<Item = Words>) -> Block {
    Block::Paragraph(parts.into_iter().flatten().collect())
}

fn head(titles: &[&str]) -> Vec<Words> {
    titles.iter().map(|title| words![*title]).collect()
}

/// A unit such as `N*s/m^2`, typeset.
fn unit(text: &str) -> Words {
    let mut pretty = String::with_capacity(text.len());
    let mut raised = false;
    for letter in text.chars() {
        raised = letter == '^' || (raised && (letter == '-' || letter.is_ascii_digit()));
        pretty.push(match letter {
            '^' => continue,
            '*' => '·',
            '-' if raised => '⁻',
            '0'..='9' if raised => {
                ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][letter as usize - '0' as usize]
            }
            letter => letter,
        });
    }
    words![pretty]
}

/// `one thing`, `two things`, `12 things`.
fn counted(n: usize, thing: &str) -> String {
    const SMALL: [&str; 13] = [
        "no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten",
        "eleven", "twelve",
    ];
    let number = SMALL
        .get(n)
        .map_or_else(|| n.to_string(), |word| (*word).to_owned());
    let plural = match (n, thing.strip_suffix('y')) {
        (1, _) => thing.to_owned(),
        (_, Some(stem)) => format!("{stem}ies"),
        (_, None) => format!("{thing}s"),
    };
    format!("{number} {plural}")
}

/// The text with an initial capital.
fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters
        .next()
        .map(|letter| letter.to_uppercase().to_string());
    first.into_iter().chain([letters.collect()]).collect()
}
