//! Prints formulas in presentation MathML, restricted to MathML Core, which browsers draw.
//!
//! *MathML Core*, W3C: <https://www.w3.org/TR/mathml-core/>.

use crate::print::math::{Form, Mark, Math, Sign};

impl Math {
    /// In presentation MathML, restricted to the part that browsers draw: an element `math` for a line of text.
    pub fn mathml(&self) -> String {
        format!("<math>{}</math>", self.mathml_row())
    }

    /// The elements inside `math`, `mrow` or `mtd`.
    pub fn mathml_row(&self) -> String {
        write(self.marks())
    }
}

/// The elements, written front to back.
fn write(marks: &[Mark]) -> String {
    let counts = elements_of_arguments(marks);
    let tall = tall(marks);
    let mut out = String::new();
    let mut open: Vec<Level> = Vec::new();
    let mut argument = 0;
    // Whether the next element is the first of its row, where a sign would be taken for a prefix.
    let mut first = true;
    for (index, mark) in marks.iter().enumerate() {
        match mark {
            Mark::Letter(letter) => {
                let upright = ('Α'..='Ω').contains(letter) || *letter == '∂';
                element(&mut out, if upright { UPRIGHT } else { "mi" }, letter);
            }
            Mark::Bold(letter) => element(&mut out, UPRIGHT, &bold(*letter)),
            Mark::Word(word) if word.chars().count() == 1 => element(&mut out, UPRIGHT, word),
            Mark::Word(word) => element(&mut out, "mi", word),
            Mark::Text(words) => element(&mut out, "mtext", words),
            Mark::Number(digits) => element(&mut out, "mn", digits),
            Mark::Function(name) => element(&mut out, "mi", function(name)),
            Mark::Sign(Sign::Apply) => {
                out.push_str("<mo>&#x2061;</mo>");
                if marks.get(index + 1) != Some(&Mark::Open(Form::Parentheses)) {
                    out.push_str(THIN);
                }
            }
            Mark::Sign(Sign::Times) => {
                out.push_str("<mo>&#x2062;</mo>");
                // Spaced like words: 2 sin φ.
                if starts_with_function(&marks[index + 1..]) {
                    out.push_str(THIN);
                }
            }
            Mark::Sign(sign) => out.push_str(self::sign(*sign, first)),
            Mark::Open(form) => {
                let single = counts.get(argument) == Some(&1);
                argument += 1;
                let level = Level {
                    form: *form,
                    done: 0,
                    row: !single,
                };
                out.push_str(match (form, tall[index]) {
                    (Form::Parentheses, true) => "<mrow><mo>(</mo>",
                    _ => opening(*form),
                });
                level.start(&mut out);
                open.push(level);
            }
            Mark::Next => {
                let single = counts.get(argument) == Some(&1);
                argument += 1;
                if let Some(level) = open.last_mut() {
                    level.end(&mut out);
                    level.done += 1;
                    level.row = !single;
                    if let Form::Matrix(columns) = level.form {
                        out.push_str(if level.done.is_multiple_of(columns) {
                            "</mtd></mtr><mtr><mtd>"
                        } else {
                            "</mtd><mtd>"
                        });
                    }
                    level.start(&mut out);
                }
            }
            Mark::Close => {
                if let Some(level) = open.pop() {
                    level.end(&mut out);
                    out.push_str(match (level.form, tall[index]) {
                        (Form::Parentheses, true) => "<mo>)</mo></mrow>",
                        _ => closing(level.form),
                    });
                }
            }
        }
        first = matches!(mark, Mark::Open(_) | Mark::Next);
    }
    out
}

const UPRIGHT: &str = "mi mathvariant=\"normal\"";
const THIN: &str = "<mspace width=\"0.17em\"></mspace>";

/// An open form.
struct Level {
    form: Form,
    /// The number of completed arguments.
    done: usize,
    /// Whether the current argument needs a row of its own, because it is not a single element.
    row: bool,
}

impl Level {
    /// Whether arguments are positional, one element each.
    fn has_places(&self) -> bool {
        use Form::{Dots, Fraction, Index, IndexAndPower, Power, Under};
        matches!(
            self.form,
            Fraction | Power | Index | IndexAndPower | Under | Dots(_)
        )
    }

    fn start(&self, out: &mut String) {
        if self.row && self.has_places() {
            out.push_str("<mrow>");
        }
    }

    fn end(&self, out: &mut String) {
        if self.row && self.has_places() {
            out.push_str("</mrow>");
        }
    }
}

/// The number of elements of each argument, in the order in which the arguments begin.
fn elements_of_arguments(marks: &[Mark]) -> Vec<usize> {
    let mut counts = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    for mark in marks {
        match mark {
            Mark::Close => {
                open.pop();
            }
            Mark::Next => {
                counts.push(0);
                if let Some(argument) = open.last_mut() {
                    *argument = counts.len() - 1;
                }
            }
            _ => {
                if let Some(&argument) = open.last() {
                    counts[argument] += 1;
                }
                if let Mark::Open(_) = mark {
                    counts.push(0);
                    open.push(counts.len() - 1);
                }
            }
        }
    }
    counts
}

/// For each mark that opens or closes a form, whether its content is taller than a line: browsers add too much space around
/// stretchy parentheses with lower content.
fn tall(marks: &[Mark]) -> Vec<bool> {
    let mut tall = vec![false; marks.len()];
    let mut open: Vec<usize> = Vec::new();
    for (index, mark) in marks.iter().enumerate() {
        match mark {
            Mark::Open(form) => {
                open.push(index);
                tall[index] = matches!(
                    form,
                    Form::Fraction | Form::Root | Form::Matrix(_) | Form::Under
                );
            }
            Mark::Close => {
                if let Some(opened) = open.pop() {
                    tall[index] = tall[opened];
                    if let Some(&around) = open.last() {
                        tall[around] |= tall[opened];
                    }
                }
            }
            _ => {}
        }
    }
    tall
}

fn starts_with_function(marks: &[Mark]) -> bool {
    matches!(
        marks,
        [Mark::Function(_), ..] | [Mark::Open(Form::Power), Mark::Function(_), ..]
    )
}

fn opening(form: Form) -> &'static str {
    match form {
        Form::Fraction => "<mfrac>",
        Form::Power => "<msup>",
        Form::Index => "<msub>",
        Form::IndexAndPower => "<msubsup>",
        Form::Under => "<munder>",
        Form::Root => "<msqrt>",
        // Not marked as an accent: browsers would set the dots large, and overlapping the letter.
        Form::Dots(_) => "<mover>",
        Form::Parentheses => "<mrow><mo stretchy=\"false\">(</mo>",
        Form::Bars => "<mrow><mo fence=\"true\" form=\"prefix\">|</mo>",
        Form::Matrix(_) => "<mrow><mo>(</mo><mtable><mtr><mtd>",
    }
}

fn closing(form: Form) -> &'static str {
    match form {
        Form::Fraction => "</mfrac>",
        Form::Power => "</msup>",
        Form::Index => "</msub>",
        Form::IndexAndPower => "</msubsup>",
        Form::Under => "</munder>",
        Form::Root => "</msqrt>",
        Form::Dots(0 | 1) => "<mo>\u{2d9}</mo></mover>",
        Form::Dots(2) => "<mo>\u{a8}</mo></mover>",
        Form::Dots(_) => "<mo>\u{20db}</mo></mover>",
        Form::Parentheses => "<mo stretchy=\"false\">)</mo></mrow>",
        Form::Bars => "<mo fence=\"true\" form=\"postfix\">|</mo></mrow>",
        Form::Matrix(_) => "</mtd></mtr></mtable><mo>)</mo></mrow>",
    }
}

fn sign(sign: Sign, first: bool) -> &'static str {
    match (sign, first) {
        (Sign::Plus, false) => "<mo>+</mo>",
        (Sign::Plus, true) => "<mo form=\"infix\">+</mo>",
        (Sign::Minus, false) => "<mo>\u{2212}</mo>",
        (Sign::Minus, true) => "<mo form=\"infix\">\u{2212}</mo>",
        (Sign::Negative, true) => "<mo>\u{2212}</mo>",
        (Sign::Negative, false) => "<mo form=\"prefix\">\u{2212}</mo>",
        (Sign::Equals, _) => "<mo>=</mo>",
        (Sign::Times, _) => "<mo>&#x2062;</mo>",
        (Sign::Dot, _) => "<mo>\u{22c5}</mo>",
        (Sign::Apply, _) => "<mo>&#x2061;</mo>",
        (Sign::To, _) => "<mo>\u{2192}</mo>",
        (Sign::Comma, _) => "<mo>,</mo>",
        (Sign::Sum, _) => "<mo>\u{2211}</mo>",
        (Sign::Dots, _) => "<mo>\u{2026}</mo>",
        (Sign::Quad, _) => "<mspace width=\"1em\"></mspace>",
        (Sign::LeftParenthesis, _) => "<mo stretchy=\"false\">(</mo>",
        (Sign::RightParenthesis, _) => "<mo stretchy=\"false\">)</mo>",
    }
}

fn function(name: &'static str) -> &'static str {
    match name {
        "asin" => "arcsin",
        "acos" => "arccos",
        "atan" => "arctan",
        name => name,
    }
}

/// The bold letter from Unicode's mathematical alphabets, slanted for Greek: the attribute is not part of MathML Core.
fn bold(letter: char) -> char {
    let shifted = |from: char, to: u32| char::from_u32(to + (letter as u32 - from as u32));
    match letter {
        'A'..='Z' => shifted('A', 0x1d400),
        'a'..='z' => shifted('a', 0x1d41a),
        'Α'..='Ω' => shifted('Α', 0x1d71c),
        'α'..='ω' => shifted('α', 0x1d736),
        _ => None,
    }
    .unwrap_or(letter)
}

/// `<name …>content</name>`, with the content escaped.
fn element(out: &mut String, tag: &str, content: &(impl ToString + ?Sized)) {
    let name = tag.split(' ').next().unwrap_or(tag);
    out.push_str(&format!(
        "<{tag}>{}</{name}>",
        markup_words(&content.to_string())
    ));
}

/// Words in XML or HTML, with all special characters escaped.
///
/// ```
/// use lagrangian_symbolic::markup_words;
///
/// assert_eq!(markup_words("a < b & \"c\""), "a &lt; b &amp; &quot;c&quot;");
/// ```
pub fn markup_words(words: &str) -> String {
    let mut escaped = String::with_capacity(words.len());
    for letter in words.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            // XML does not allow them.
            '\n' | '\t' => escaped.push(letter),
            letter if letter.is_control() || matches!(letter, '\u{fffe}' | '\u{ffff}') => {
                escaped.push(' ');
            }
            letter => escaped.push(letter),
        }
    }
    escaped
}
