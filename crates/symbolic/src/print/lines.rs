//! Measures the width of formulas, and breaks them into lines.

use crate::print::math::{Form, Mark, Math, Sign};

/// A possible line break, before a sign.
struct Break {
    /// The mark that begins the next line.
    mark: usize,
    /// The width of everything before it.
    at: f32,
    /// The number of open parentheses there.
    depth: usize,
}

impl Math {
    /// The approximate width in a display, in the size of its font (em).
    pub fn width(&self) -> f32 {
        measure(&self.marks).0
    }

    /// Breaks the formula into lines, the first at most `first` wide and the others `others`, in em. A line ends before
    /// `+`, `−` or `=`, preferably outside parentheses, and never in a fraction, under a root or in an exponent; an
    /// unbreakable line may be wider.
    ///
    /// Parentheses that are closed on another line have a fixed size ([`Sign::LeftParenthesis`]).
    pub fn lines(&self, first: f32, others: f32) -> Vec<Math> {
        let (width, breaks) = measure(&self.marks);
        let mut cuts: Vec<usize> = Vec::new();
        let (mut start, mut limit) = (0.0, first);
        while width - start > limit {
            let mut best: Option<(f32, &Break)> = None;
            for place in breaks.iter().filter(|place| place.at > start) {
                let filled = (place.at - start) / limit;
                if filled > 1.0 && best.is_some() {
                    break;
                }
                let is_equals = self.marks[place.mark] == Mark::Sign(Sign::Equals);
                let score = match place.depth {
                    _ if filled > 1.0 => -filled,
                    // Not right after the name of the quantity that is defined.
                    0 if is_equals && filled < 0.25 => filled - 1.0,
                    0 => filled,
                    depth => filled - 0.5 * depth as f32,
                };
                if best.is_none_or(|(other, _)| score >= other) {
                    best = Some((score, place));
                }
            }
            let Some((_, place)) = best else { break };
            cuts.push(place.mark);
            (start, limit) = (place.at, others);
        }
        split(&self.marks, &cuts)
    }
}

/// Splits the marks into lines that begin at `cuts`.
fn split(marks: &[Mark], cuts: &[usize]) -> Vec<Math> {
    let torn = torn(marks, cuts);
    let mut lines = vec![Math::default()];
    for (index, mark) in marks.iter().enumerate() {
        if cuts.contains(&index) {
            lines.push(Math::default());
        }
        let Some(line) = lines.last_mut() else { break };
        match (mark, torn.contains(&index)) {
            // The exponent belongs to the closing parenthesis.
            (Mark::Open(Form::Power), true) => {}
            (Mark::Open(_), true) => line.marks.push(Mark::Sign(Sign::LeftParenthesis)),
            (Mark::Close, true) => {
                if marks.get(index + 1) == Some(&Mark::Next) {
                    line.marks.push(Mark::Open(Form::Power));
                }
                line.marks.push(Mark::Sign(Sign::RightParenthesis));
            }
            _ => line.marks.push(mark.clone()),
        }
    }
    lines.retain(|line| !line.is_empty());
    lines
}

/// The marks of parentheses around a cut, and the opening marks of powers of such parentheses.
fn torn(marks: &[Mark], cuts: &[usize]) -> std::collections::BTreeSet<usize> {
    let mut torn = std::collections::BTreeSet::new();
    let mut open: Vec<usize> = Vec::new();
    for (index, mark) in marks.iter().enumerate() {
        if cuts.binary_search(&index).is_ok() {
            torn.extend(&open);
        }
        match mark {
            Mark::Open(_) => open.push(index),
            Mark::Close => {
                let opened = open.pop();
                let is_power = opened.is_some_and(|o| marks[o] == Mark::Open(Form::Power));
                if opened.is_some_and(|opened| torn.contains(&opened)) && !is_power {
                    torn.insert(index);
                }
            }
            _ => {}
        }
    }
    torn
}

/// A form that is open during measurement.
struct Level {
    form: Form,
    /// Whether a line may end inside: then its marks are added to the line directly.
    transparent: bool,
    /// The widths of its arguments so far.
    arguments: Vec<f32>,
    /// The size of the font.
    size: f32,
    /// The number of enclosing fractions.
    fractions: usize,
    /// The width of a parenthesis or bar, if it has any.
    fence: f32,
}

/// The width of a row, and its possible line breaks.
fn measure(marks: &[Mark]) -> (f32, Vec<Break>) {
    let mut x = 0.0;
    let mut breaks = Vec::new();
    let mut open: Vec<Level> = Vec::new();
    let fences = fences(marks);
    for (index, mark) in marks.iter().enumerate() {
        let clear = open.last().is_none_or(|level| level.transparent);
        let (size, fractions) = match open.last() {
            Some(level) => (level.size_of_argument(), level.fractions),
            None => (1.0, 0),
        };
        let width = match mark {
            Mark::Open(form) => {
                let transparent = clear
                    && match form {
                        Form::Parentheses => true,
                        Form::Power => marks.get(index + 1) == Some(&Mark::Open(Form::Parentheses)),
                        _ => false,
                    };
                open.push(Level {
                    form: *form,
                    transparent,
                    arguments: vec![0.0],
                    size,
                    fractions: fractions + usize::from(*form == Form::Fraction),
                    fence: fences[index],
                });
                if transparent { fences[index] } else { 0.0 }
            }
            Mark::Next => {
                if let Some(level) = open.last_mut() {
                    // No line ends in an exponent.
                    level.transparent = false;
                    level.arguments.push(0.0);
                }
                continue;
            }
            Mark::Close => match open.pop() {
                Some(level) if level.transparent => level.fence,
                Some(level) => level.width(),
                None => 0.0,
            },
            Mark::Sign(Sign::Plus | Sign::Minus | Sign::Equals | Sign::To) if clear && x > 0.0 => {
                let depth = open.iter().filter(|l| l.form == Form::Parentheses).count();
                breaks.push(Break {
                    mark: index,
                    at: x,
                    depth,
                });
                1.25
            }
            mark => size * width_of(mark),
        };
        match open.last_mut() {
            Some(level) if !level.transparent => {
                if let Some(argument) = level.arguments.last_mut() {
                    *argument += width;
                }
            }
            _ => x += width,
        }
    }
    (x, breaks)
}

impl Level {
    fn size_of_argument(&self) -> f32 {
        let is_script = matches!(self.form, Form::Power | Form::Index | Form::IndexAndPower)
            && self.arguments.len() > 1;
        let is_small = self.form == Form::Fraction && self.fractions > 1;
        if is_script || is_small {
            // Letters at 7 points are wider than seven tenths of those at 10 points.
            self.size * 0.8
        } else {
            self.size
        }
    }

    fn width(&self) -> f32 {
        let widest = |arguments: &[f32]| arguments.iter().copied().fold(0.0, f32::max);
        let all = &self.arguments[..];
        match self.form {
            Form::Fraction => widest(all) + 0.24,
            Form::Under => widest(all),
            Form::Power | Form::Index => all.iter().sum::<f32>() + SCRIPT,
            Form::IndexAndPower => all[0] + widest(&all[1..]) + SCRIPT,
            Form::Root => widest(all) + 1.0,
            Form::Dots(_) => widest(all),
            Form::Parentheses | Form::Bars => widest(all) + 2.0 * self.fence,
            Form::Matrix(columns) => {
                let columns = columns.max(1);
                let column = |k: usize| all.iter().skip(k).step_by(columns).copied();
                let widths = (0..columns).map(|k| column(k).fold(0.0, f32::max) + 1.0);
                widths.sum::<f32>() + 1.4
            }
        }
    }
}

/// The space after an index or an exponent, in em: TeX's `\scriptspace`.
const SCRIPT: f32 = 0.05;

/// For every mark that opens parentheses or bars, the width of one of them; 0 for all others.
///
/// They grow with their content (`\left`, `\right`), and a thin space separates each from what is
/// outside: 1/6 em beside 0.389 em of a parenthesis, 0.458 with scripts inside, 0.597 with dots, 0.736
/// with a fraction, 0.875 with a larger fraction (D. E. Knuth, *The TeXbook*, 1984, appendices F and G).
fn fences(marks: &[Mark]) -> Vec<f32> {
    const WIDTHS: [f32; 5] = [0.556, 0.625, 0.764, 0.903, 1.042];
    let mut fences = vec![0.0; marks.len()];
    // The open marks, with the height of their content as an index into the widths.
    let mut open: Vec<(usize, Form, usize)> = Vec::new();
    for (index, mark) in marks.iter().enumerate() {
        match mark {
            Mark::Open(form) => open.push((index, *form, 0)),
            Mark::Sign(Sign::Sum) => {
                if let Some((.., inside)) = open.last_mut() {
                    *inside = (*inside).max(3);
                }
            }
            Mark::Close => {
                let Some((opened, form, inside)) = open.pop() else {
                    continue;
                };
                if matches!(form, Form::Parentheses | Form::Bars) {
                    fences[opened] = WIDTHS[inside];
                }
                let height = match form {
                    Form::Parentheses | Form::Bars => inside,
                    Form::Power | Form::Index | Form::IndexAndPower => inside.max(1),
                    Form::Dots(_) => inside.max(2),
                    Form::Root => (inside + 1).min(4),
                    Form::Fraction if inside < 2 => 3,
                    Form::Fraction | Form::Under | Form::Matrix(_) => 4,
                };
                if let Some((.., around)) = open.last_mut() {
                    *around = (*around).max(height);
                }
            }
            _ => {}
        }
    }
    fences
}

/// The widths of Computer Modern at 10 points (D. E. Knuth, *Computer Modern Typefaces*, 1986), in em,
/// rounded up; those of words are approximate.
fn width_of(mark: &Mark) -> f32 {
    let letter = |c: char| match c {
        'i' | 'l' | 't' | 'ι' => 0.36,
        'j' => 0.47,
        'm' | 'w' => 0.88,
        'M' | 'W' => 1.09,
        'H' | 'K' | 'N' | 'X' => 0.93,
        'D' | 'Δ' => 0.86,
        'A'..='Z' | 'Α'..='Ω' => 0.81,
        'α' | 'π' | 'σ' | 'φ' | 'χ' | 'ψ' | 'ω' => 0.69,
        'β' | 'μ' => 0.62,
        'b' | 'c' | 'e' | 'o' | 'q' | 'r' | 's' => 0.49,
        'f' | 'n' | 'ε'..='ρ' | 'ς'..='υ' => 0.61,
        _ => 0.59,
    };
    let word = |word: &str| word.chars().map(letter).sum::<f32>() * 0.95;
    match mark {
        Mark::Letter(c) => letter(*c),
        Mark::Bold(c) => 1.1 * letter(*c),
        Mark::Word(text) => word(text),
        Mark::Text(text) => word(text),
        Mark::Number(digits) => 0.5 * digits.len() as f32,
        Mark::Function(name) => word(name) + 0.17,
        Mark::Sign(sign) => match sign {
            Sign::Plus | Sign::Minus => 1.22,
            Sign::Equals => 1.33,
            Sign::To => 1.56,
            Sign::Negative => 0.78,
            Sign::Times => 0.0,
            Sign::Dot => 0.72,
            Sign::Apply => 0.17,
            Sign::Comma => 0.45,
            Sign::Sum => 1.44,
            Sign::Dots => 1.2,
            Sign::Quad => 1.0,
            Sign::LeftParenthesis | Sign::RightParenthesis => 0.46,
        },
        Mark::Open(_) | Mark::Next | Mark::Close => 0.0,
    }
}
