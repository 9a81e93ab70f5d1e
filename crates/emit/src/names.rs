//! Names of the emitted code: those of the spec, converted to Rust identifiers without collisions.

use std::collections::BTreeSet;

use lagrangian_spec::model::Name;

/// Keywords and reserved words of Rust, in any edition.
const KEYWORDS: &[&str] = &[
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "do", "dyn",
    "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let",
    "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return",
    "static", "struct", "trait", "true", "try", "type", "typeof", "unsafe", "unsized", "use",
    "virtual", "where", "while", "yield",
];

/// Keywords that cannot be identifiers even with `r#`.
const NEVER_NAMES: &[&str] = &["crate", "self", "super", "Self", "_"];

/// Converts a name of the spec to a Rust identifier.
pub fn identifier(name: &str) -> String {
    if NEVER_NAMES.contains(&name) {
        format!("{name}_")
    } else if KEYWORDS.contains(&name) {
        format!("r#{name}")
    } else {
        name.to_owned()
    }
}

/// Converts a name such as `VibratingCrusher` to that of a module: `vibrating_crusher`.
pub fn snake_case(name: &str) -> String {
    let letters: Vec<char> = name.chars().collect();
    let mut snake = String::new();
    for (i, &letter) in letters.iter().enumerate() {
        let after_small = i > 0 && (letters[i - 1].is_lowercase() || letters[i - 1].is_numeric());
        let before_small = i > 0
            && letters[i - 1].is_uppercase()
            && letters.get(i + 1).is_some_and(|next| next.is_lowercase());
        if letter.is_uppercase() && (after_small || before_small) {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    snake
}

/// A name that can be part of another name: `q[3]` becomes `q_3`, `q[-1]` becomes `q_m1`.
pub fn flat(name: &Name) -> String {
    match name.index {
        Some(index) if index < 0 => format!("{}_m{}", name.word(), index.unsigned_abs()),
        Some(index) => format!("{}_{index}", name.word()),
        None => name.word().to_owned(),
    }
}

/// A text with `_` in place of what names may not contain.
pub fn word(text: &str, may_contain: impl Fn(char) -> bool) -> String {
    let letters = text.chars();
    letters
        .map(|c| if may_contain(c) { c } else { '_' })
        .collect()
}

/// A name in ASCII letters, which every compiler accepts.
pub fn ascii(name: &str) -> String {
    name.chars()
        .map(|c| match c {
            c if c.is_ascii_alphanumeric() || c == '_' => c.to_string(),
            c => greek(c).map_or_else(|| format!("u{:x}", c as u32), str::to_owned),
        })
        .collect()
}

/// The name of a Greek letter.
fn greek(letter: char) -> Option<&'static str> {
    const NAMES: [&str; 25] = [
        "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa",
        "lambda", "mu", "nu", "xi", "omicron", "pi", "rho", "sigma", "sigma", "tau", "upsilon",
        "phi", "chi", "psi", "omega",
    ];
    const CAPITALS: [&str; 25] = [
        "Alpha", "Beta", "Gamma", "Delta", "Epsilon", "Zeta", "Eta", "Theta", "Iota", "Kappa",
        "Lambda", "Mu", "Nu", "Xi", "Omicron", "Pi", "Rho", "Sigma", "Sigma", "Tau", "Upsilon",
        "Phi", "Chi", "Psi", "Omega",
    ];
    let index = |first: char| (letter as usize).checked_sub(first as usize);
    index('α')
        .and_then(|i| NAMES.get(i))
        .or_else(|| index('Α').and_then(|i| CAPITALS.get(i)))
        .copied()
}

/// Allocates unique names.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    taken: BTreeSet<String>,
}

impl Scope {
    /// A scope in which these names are taken.
    pub fn with(taken: &[&str]) -> Scope {
        Scope {
            taken: taken.iter().map(|&name| name.to_owned()).collect(),
        }
    }

    /// Takes `name`, or a similar name that is free, as a Rust identifier.
    pub fn take(&mut self, name: &str) -> String {
        identifier(&self.take_plain(name))
    }

    /// Whether nothing has this name.
    pub fn is_free(&self, name: &str) -> bool {
        !self.taken.contains(name)
    }

    /// Takes `name`, or a similar name that is free.
    pub fn take_plain(&mut self, name: &str) -> String {
        let mut name = name.to_owned();
        while self.taken.contains(&name) {
            name.push('_');
        }
        self.taken.insert(name.clone());
        name
    }
}

/// The names of the functions of outputs, `output_tip`, in a language whose names are written in the given form. Outputs whose names
/// are the same in this form, such as `o[1]` and `o_1`, have different functions.
pub fn output_functions<'a>(
    outputs: impl IntoIterator<Item = &'a Name>,
    form: impl Fn(&str) -> String,
) -> Vec<String> {
    let mut scope = Scope::default();
    let names = outputs.into_iter().map(|name| form(&flat(name)));
    names
        .map(|name| scope.take_plain(&format!("output_{name}")))
        .collect()
}

/// A field of a struct: one slot, or a family of them as an array.
#[derive(Clone, Debug)]
pub struct Field {
    /// The name of the field.
    pub ident: String,
    /// The slots, in the order of the array.
    pub slots: Vec<usize>,
    /// Whether it is a family.
    pub is_family: bool,
}

/// Fields for slots of these names, in the order in which they first occur.
pub fn fields<'a>(names: impl IntoIterator<Item = &'a Name>) -> Vec<Field> {
    let mut fields: Vec<(&str, Field)> = Vec::new();
    for (slot, name) in names.into_iter().enumerate() {
        match fields
            .iter_mut()
            .find(|(base, field)| *base == name.base && field.is_family)
        {
            Some((_, field)) => field.slots.push(slot),
            None => {
                let ident = identifier(name.word());
                let field = Field {
                    ident,
                    slots: vec![slot],
                    is_family: name.index.is_some(),
                };
                fields.push((&name.base, field));
            }
        }
    }
    fields.into_iter().map(|(_, field)| field).collect()
}

/// For each slot the path to its number in a struct: `m1`, `mass[2]`.
pub fn paths(fields: &[Field]) -> Vec<String> {
    let mut paths = vec![String::new(); fields.iter().map(|field| field.slots.len()).sum()];
    for field in fields {
        for (index, &slot) in field.slots.iter().enumerate() {
            paths[slot] = if field.is_family {
                format!("{}[{index}]", field.ident)
            } else {
                field.ident.clone()
            };
        }
    }
    paths
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keywords_become_raw_identifiers() {
        assert_eq!(identifier("type"), "r#type");
        assert_eq!(identifier("gen"), "r#gen");
        assert_eq!(identifier("self"), "self_");
        assert_eq!(identifier("theta"), "theta");
    }

    #[test]
    fn modules_are_in_snake_case() {
        assert_eq!(snake_case("VibratingCrusher"), "vibrating_crusher");
        assert_eq!(snake_case("Crusher9"), "crusher9");
        assert_eq!(snake_case("Arm6R"), "arm6_r");
        assert_eq!(snake_case("RRArm"), "rr_arm");
        assert_eq!(snake_case("chain"), "chain");
    }

    #[test]
    fn outputs_with_similar_names_have_different_functions() {
        let name = |base: &str, index| Name {
            base: base.into(),
            index,
        };
        let names = [
            name("o", Some(1)),
            name("o_1", None),
            name("ξ", None),
            name("xi", None),
        ];
        let functions = output_functions(&names, ascii);
        assert_eq!(
            functions,
            ["output_o_1", "output_o_1_", "output_xi", "output_xi_"]
        );
    }

    #[test]
    fn families_are_arrays_whose_members_may_stand_apart() {
        let name = |base: &str, index| Name {
            base: base.into(),
            index,
        };
        let names = [name("q", Some(1)), name("x", None), name("q", Some(2))];
        assert_eq!(paths(&fields(&names)), ["q[0]", "x", "q[1]"]);
    }
}
