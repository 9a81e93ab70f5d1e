//! Typesets names as a person would.

use crate::print::math::{Form, Mark, Math, Sign};

/// A name as a person would typeset it.
///
/// Greek letters by their names; digits, anything after an underscore or in brackets, and the
/// second of two letters as subscripts; longer words upright; `der(…)` as a dot; `lambda(…)`, the multiplier
/// of a constraint, as λ with the parts of the constraint's name as subscripts.
///
/// ```
/// use lagrangian_symbolic::math_name;
///
/// assert_eq!(math_name("cx").latex(), "c_{x}");
/// assert_eq!(math_name("cx").mathml(), "<math><msub><mi>c</mi><mi>x</mi></msub></math>");
/// ```
pub fn math_name(name: &str) -> Math {
    let (mut inner, mut dots) = (name, 0);
    while let Some(below) = inner
        .strip_prefix("der(")
        .and_then(|rest| rest.strip_suffix(')'))
    {
        (inner, dots) = (below, dots + 1);
    }
    let constraint = name
        .strip_prefix("lambda(")
        .and_then(|rest| rest.strip_suffix(')'));
    let mut parts = constraint
        .unwrap_or(inner)
        .split(['_', '[', ']', ',', '.', ' '])
        .filter(|part| !part.is_empty());
    if constraint.is_some() {
        let index = Math::joined(parts.map(subscript), Sign::Comma);
        return Math::letter('λ').with_index(index);
    }
    let first = parts.next().unwrap_or("");
    let letters = first.trim_end_matches(|c: char| c.is_ascii_digit());
    let digits = &first[letters.len()..];

    let mut subscripts = Vec::new();
    let base = match (
        greek(letters),
        letters.chars().collect::<Vec<_>>().as_slice(),
    ) {
        (Some(letter), _) => Math::letter(letter),
        (None, []) => Math::letter('_'),
        (None, &[letter]) => Math::letter(letter),
        // cx, yb: a quantity and its direction.
        (None, &[letter, index]) => {
            subscripts.push(Math::letter(index));
            Math::letter(letter)
        }
        (None, _) => Math::mark(Mark::Word(letters.to_owned())),
    };
    subscripts.extend(Some(digits).filter(|digits| !digits.is_empty()).map(number));
    subscripts.extend(parts.map(subscript));

    let accented = match dots {
        0 => base,
        1..=3 => Math::form(Form::Dots(dots), [base]),
        _ => {
            let d = || Math::letter('d');
            let order = || Math::number(i64::from(dots));
            let below = d() * Math::letter('t').power(order());
            Math::fraction(d().power(order()), below) * base
        }
    };
    if subscripts.is_empty() {
        accented
    } else {
        accented.with_index(Math::joined(subscripts, Sign::Comma))
    }
}

/// [`math_name`] in LaTeX.
///
/// ```
/// use lagrangian_symbolic::latex_name;
///
/// assert_eq!(latex_name("theta1"), r"\theta_{1}");
/// assert_eq!(latex_name("x_left"), r"x_{\mathrm{left}}");
/// assert_eq!(latex_name("q[3]"), "q_{3}");
/// assert_eq!(latex_name("der(der(phi2))"), r"\ddot{\varphi}_{2}");
/// ```
pub fn latex_name(name: &str) -> String {
    math_name(name).latex()
}

/// [`math_name`] in MathML: an element `math` for a line of text.
///
/// ```
/// use lagrangian_symbolic::mathml_name;
///
/// assert_eq!(mathml_name("theta1"), "<math><msub><mi>θ</mi><mn>1</mn></msub></math>");
/// ```
pub fn mathml_name(name: &str) -> String {
    math_name(name).mathml()
}

fn subscript(part: &str) -> Math {
    let letters = part.trim_end_matches(|c: char| c.is_ascii_digit());
    let digits = &part[letters.len()..];
    match (greek(part), letters.chars().collect::<Vec<_>>().as_slice()) {
        (Some(letter), _) => Math::letter(letter),
        (None, []) => number(digits),
        // A member of a family: q[-1].
        (None, ['-']) if !digits.is_empty() => -number(digits),
        (None, &[letter]) if digits.is_empty() => Math::letter(letter),
        (None, &[letter]) => Math::row([Math::letter(letter), number(digits)]),
        (None, _) => Math::mark(Mark::Word(part.to_owned())),
    }
}

fn number(digits: &str) -> Math {
    Math::mark(Mark::Number(digits.to_owned()))
}

fn greek(name: &str) -> Option<char> {
    Some(match name {
        "alpha" => 'α',
        "beta" => 'β',
        "gamma" => 'γ',
        "delta" => 'δ',
        "epsilon" => 'ε',
        "zeta" => 'ζ',
        "eta" => 'η',
        "theta" => 'θ',
        "iota" => 'ι',
        "kappa" => 'κ',
        "lambda" => 'λ',
        "mu" => 'μ',
        "nu" => 'ν',
        "xi" => 'ξ',
        "rho" => 'ρ',
        "sigma" => 'σ',
        "tau" => 'τ',
        "upsilon" => 'υ',
        "phi" => 'φ',
        "chi" => 'χ',
        "psi" => 'ψ',
        "omega" => 'ω',
        "Gamma" => 'Γ',
        "Delta" => 'Δ',
        "Theta" => 'Θ',
        "Lambda" => 'Λ',
        "Xi" => 'Ξ',
        "Pi" => 'Π',
        "Sigma" => 'Σ',
        "Upsilon" => 'Υ',
        "Phi" => 'Φ',
        "Psi" => 'Ψ',
        "Omega" => 'Ω',
        _ => return None,
    })
}
