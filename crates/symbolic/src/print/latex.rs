//! Prints formulas in LaTeX, for math mode.

use crate::print::math::{Form, Mark, Math, Sign};

impl Math {
    /// In LaTeX, for math mode; `amsmath` knows every command.
    pub fn latex(&self) -> String {
        write(self.marks())
    }
}

/// The marks, written front to back.
fn write(marks: &[Mark]) -> String {
    let mut out = String::new();
    // The open forms, with the number of their completed arguments.
    let mut open: Vec<(Form, usize)> = Vec::new();
    for (index, mark) in marks.iter().enumerate() {
        match mark {
            Mark::Letter(letter) => push(&mut out, &symbol(*letter)),
            Mark::Bold(letter) if letter.is_ascii() => {
                push(&mut out, &format!(r"\mathbf{{{letter}}}"));
            }
            Mark::Bold(letter) => push(&mut out, &format!(r"\boldsymbol{{{}}}", symbol(*letter))),
            Mark::Word(word) if word.chars().all(|c| c.is_ascii_alphanumeric()) => {
                push(&mut out, &format!(r"\mathrm{{{word}}}"));
            }
            Mark::Word(words) => push(&mut out, &format!(r"\text{{{}}}", latex_words(words))),
            Mark::Text(words) => push(&mut out, &format!(r"\text{{{}}}", latex_words(words))),
            Mark::Number(digits) => push(&mut out, digits),
            Mark::Function(name) => push(&mut out, &function(name)),
            Mark::Sign(Sign::Apply) => {
                // An argument in parentheses needs no space.
                if marks.get(index + 1) != Some(&Mark::Open(Form::Parentheses)) {
                    out.push(' ');
                }
            }
            Mark::Sign(sign) => push(&mut out, self::sign(*sign)),
            Mark::Open(form) => {
                open.push((*form, 0));
                push(&mut out, opening(*form));
            }
            Mark::Next => {
                if let Some((form, done)) = open.last_mut() {
                    *done += 1;
                    push(&mut out, between(*form, *done));
                }
            }
            Mark::Close => {
                if let Some((form, _)) = open.pop() {
                    push(&mut out, closing(form));
                }
            }
        }
    }
    out.trim().to_owned()
}

/// Appends text; a command and a following letter are separated.
fn push(out: &mut String, text: &str) {
    let letters = |c: char| c.is_ascii_alphabetic();
    if text.starts_with(letters) {
        let before = out.trim_end_matches(letters);
        if before.len() < out.len() && before.ends_with('\\') {
            out.push(' ');
        }
    }
    out.push_str(text);
}

fn opening(form: Form) -> &'static str {
    match form {
        Form::Fraction => r"\frac{",
        Form::Power | Form::Index | Form::IndexAndPower | Form::Under => "",
        Form::Root => r"\sqrt{",
        Form::Dots(0 | 1) => r"\dot{",
        Form::Dots(2) => r"\ddot{",
        Form::Dots(_) => r"\dddot{",
        Form::Parentheses => r"\left(",
        Form::Bars => r"\left\vert",
        Form::Matrix(_) => r"\begin{pmatrix} ",
    }
}

/// The separator after an argument, given the number of completed ones.
fn between(form: Form, done: usize) -> &'static str {
    match form {
        Form::Fraction => "}{",
        Form::Power => "^{",
        Form::Index | Form::Under => "_{",
        Form::IndexAndPower if done == 1 => "_{",
        Form::IndexAndPower => "}^{",
        Form::Matrix(columns) if done.is_multiple_of(columns) => r" \\ ",
        Form::Matrix(_) => " & ",
        Form::Root | Form::Dots(_) | Form::Parentheses | Form::Bars => "",
    }
}

fn closing(form: Form) -> &'static str {
    match form {
        Form::Parentheses => r"\right)",
        Form::Bars => r"\right\vert",
        Form::Matrix(_) => r" \end{pmatrix}",
        _ => "}",
    }
}

fn sign(sign: Sign) -> &'static str {
    match sign {
        Sign::Plus => " + ",
        Sign::Minus => " - ",
        Sign::Negative => "-",
        Sign::Equals => " = ",
        Sign::Times | Sign::Apply => " ",
        Sign::Dot => r" \cdot ",
        Sign::To => r" \to ",
        Sign::Comma => ", ",
        Sign::Sum => r"\sum",
        Sign::Dots => r"\dots",
        Sign::Quad => r" \quad ",
        Sign::LeftParenthesis => r"\bigl(",
        Sign::RightParenthesis => r"\bigr)",
    }
}

fn function(name: &'static str) -> String {
    match name {
        "asin" => r"\arcsin".into(),
        "acos" => r"\arccos".into(),
        "atan" => r"\arctan".into(),
        "sin" | "cos" | "tan" | "sinh" | "cosh" | "tanh" | "ln" | "min" | "max" => {
            format!(r"\{name}")
        }
        _ => format!(r"\operatorname{{{name}}}"),
    }
}

/// A letter; those without a LaTeX command are left to the fonts of the text.
fn symbol(letter: char) -> String {
    let command = match letter {
        '_' => r"\_",
        '∂' => r"\partial",
        'α' => r"\alpha",
        'β' => r"\beta",
        'γ' => r"\gamma",
        'δ' => r"\delta",
        'ε' => r"\varepsilon",
        'ζ' => r"\zeta",
        'η' => r"\eta",
        'θ' => r"\theta",
        'ι' => r"\iota",
        'κ' => r"\kappa",
        'λ' => r"\lambda",
        'μ' => r"\mu",
        'ν' => r"\nu",
        'ξ' => r"\xi",
        'π' => r"\pi",
        'ρ' => r"\rho",
        'σ' => r"\sigma",
        'τ' => r"\tau",
        'υ' => r"\upsilon",
        'φ' => r"\varphi",
        'χ' => r"\chi",
        'ψ' => r"\psi",
        'ω' => r"\omega",
        'Γ' => r"\Gamma",
        'Δ' => r"\Delta",
        'Θ' => r"\Theta",
        'Λ' => r"\Lambda",
        'Ξ' => r"\Xi",
        'Π' => r"\Pi",
        'Σ' => r"\Sigma",
        'Υ' => r"\Upsilon",
        'Φ' => r"\Phi",
        'Ψ' => r"\Psi",
        'Ω' => r"\Omega",
        letter if letter.is_ascii_alphanumeric() => return letter.to_string(),
        letter => return format!(r"\text{{{}}}", latex_words(&letter.to_string())),
    };
    command.to_owned()
}

/// Words in LaTeX, for text mode or inside `\text`, with all special characters escaped.
///
/// ```
/// use lagrangian_symbolic::latex_words;
///
/// assert_eq!(latex_words("50 % of $x_1$"), r"50 \% of \$x\_1\$");
/// assert_eq!(latex_words("ψ′, s₁"), r"\ensuremath{\psi}\ensuremath{'}, s\ensuremath{{}_{1}}");
/// ```
pub fn latex_words(words: &str) -> String {
    let mut escaped = String::with_capacity(words.len());
    for letter in words.chars() {
        match letter {
            '&' | '%' | '#' | '_' | '{' | '}' | '$' => escaped.extend(['\\', letter]),
            '\\' => escaped.push_str(r"\textbackslash{}"),
            '~' => escaped.push_str(r"\textasciitilde{}"),
            '^' => escaped.push_str(r"\textasciicircum{}"),
            '<' => escaped.push_str(r"\textless{}"),
            '>' => escaped.push_str(r"\textgreater{}"),
            '|' => escaped.push_str(r"\textbar{}"),
            '"' => escaped.push_str(r"\textquotedbl{}"),
            '\'' => escaped.push_str(r"\textquotesingle{}"),
            '`' => escaped.push_str(r"\textasciigrave{}"),
            // Two of them would become a dash.
            '-' => escaped.push_str("-{}"),
            '–' => escaped.push_str("--"),
            '—' => escaped.push_str("---"),
            '…' => escaped.push_str(r"\dots{}"),
            '·' => escaped.push_str(r"\textperiodcentered{}"),
            '²' => escaped.push_str(r"\textsuperscript{2}"),
            '³' => escaped.push_str(r"\textsuperscript{3}"),
            '°' => escaped.push_str(r"\textdegree{}"),
            letter if letter.is_control() => escaped.push(if letter == '\n' { '\n' } else { ' ' }),
            letter => match mathematical(letter) {
                Some(command) => escaped.push_str(&format!(r"\ensuremath{{{command}}}")),
                None => escaped.push(letter),
            },
        }
    }
    escaped
}

/// Letters and signs that text fonts lack.
fn mathematical(letter: char) -> Option<String> {
    let command = match letter {
        '−' => "-",
        '±' => r"\pm",
        '×' => r"\times",
        '≤' => r"\le",
        '≥' => r"\ge",
        '≠' => r"\ne",
        '≈' => r"\approx",
        '→' => r"\to",
        '√' => r"\surd",
        '∞' => r"\infty",
        '∂' => r"\partial",
        '∫' => r"\int",
        '∑' => r"\sum",
        '∝' => r"\propto",
        '≪' => r"\ll",
        '≫' => r"\gg",
        '⇔' => r"\Leftrightarrow",
        '↔' => r"\leftrightarrow",
        '½' => r"\frac{1}{2}",
        '¼' => r"\frac{1}{4}",
        '¾' => r"\frac{3}{4}",
        '′' => "'",
        '″' => "''",
        '⁻' => "{}^{-}",
        '¹' => "{}^{1}",
        '₀'..='₉' => return Some(format!("{{}}_{{{}}}", letter as u32 - '₀' as u32)),
        '⁰' | '⁴'..='⁹' => return Some(format!("{{}}^{{{}}}", letter as u32 - '⁰' as u32)),
        'α'..='ω' | 'Α'..='Ω' => {
            let symbol = symbol(letter);
            return symbol
                .starts_with('\\')
                .then_some(symbol)
                .filter(|command| !command.starts_with(r"\text"));
        }
        _ => return None,
    };
    Some(command.to_owned())
}
