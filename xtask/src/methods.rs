//! The methods that quantities have, written into sources from the rows of the table: in the trait `System` with their documentation, in
//! interpreted machines, and in wrappers; and calls of them, in the test that compares emitted machines with interpreted ones.
//!
//! A source marks where these stand by a line that names them, `// <quantities: constraints>`, and a line that ends them, `// </quantities>`.

use std::fs;
use std::path::Path;

use lagrangian_program::quantity::{
    Argument, DefaultMethod, Extent, ItemKind, Method, Needs, QuantityRow, Role,
};

use crate::Generated;

/// The sources that contain methods of quantities.
const SOURCES: [&str; 4] = [
    "generated/tests/interpreter.rs",
    "src/forward.rs",
    "src/interpreted/system.rs",
    "src/system.rs",
];

/// The columns of code and of comments.
const COLUMNS: usize = 100;
const COMMENT_COLUMNS: usize = 140;

/// How a method gives its numbers.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Number,
    Vector,
    Matrix,
    Numbers,
}

/// A quantity that is a method.
struct MethodRow {
    role: Role,
    row: &'static QuantityRow,
    method: Method,
}

/// The sources with the methods of all quantities.
pub fn sources(root: &Path) -> Result<Vec<Generated>, String> {
    let source = |path: &str| {
        let text =
            fs::read_to_string(root.join(path)).map_err(|error| format!("{path}: {error}"))?;
        Ok(Generated {
            path: path.into(),
            text: with_methods(&text).map_err(|error| format!("{path}: {error}"))?,
        })
    };
    SOURCES.into_iter().map(source).collect()
}

/// A source with the methods between its marks.
fn with_methods(text: &str) -> Result<String, String> {
    let mut lines = text.lines();
    let mut written = String::new();
    while let Some(line) = lines.next() {
        written += line;
        written.push('\n');
        let mark = line.trim().strip_prefix("// <quantities: ");
        if let Some(which) = mark.and_then(|mark| mark.strip_suffix('>')) {
            written += &methods(which)?;
            let end = lines.find(|line| line.trim() == "// </quantities>");
            written += end.ok_or_else(|| format!("nothing ends the quantities `{which}`"))?;
            written.push('\n');
        }
    }
    Ok(written)
}

/// The methods that a mark names.
fn methods(which: &str) -> Result<String, String> {
    let group = |belongs: &dyn Fn(&MethodRow) -> bool| {
        let own = rows().filter(|of| of.method.default != DefaultMethod::Written && belongs(of));
        own.map(|of| of.in_trait()).collect::<Vec<_>>().join("\n")
    };
    Ok(match which {
        "forces" => group(&|of| of.row.needs == Needs::Nothing && !of.role.is_observed()),
        "observed" => group(&|of| of.role.is_observed()),
        "constraints" => group(&|of| of.row.needs == Needs::Constraints),
        "guided contacts" => group(&|of| of.row.needs == Needs::Contacts),
        "unilateral contacts" => {
            group(&|of| matches!(of.row.needs, Needs::Unilateral | Needs::Faces))
        }
        "guides" => group(&|of| of.row.needs == Needs::Guides),
        "interpreted" => {
            let all: Vec<String> = rows().map(|of| of.interpreted()).collect();
            all.join("\n")
        }
        "compared" => {
            let all: Vec<String> = rows().map(|of| of.compared()).collect();
            all.concat()
        }
        "forwarded" => {
            let mut arms: Vec<String> = rows().map(|of| of.forwarded()).collect();
            arms.push(observed());
            arms.concat()
        }
        _ => return Err(format!("no quantities are called `{which}`")),
    })
}

/// The quantities that are methods.
fn rows() -> impl Iterator<Item = MethodRow> {
    Role::all().filter_map(|role| {
        let row = role.row();
        let method = row.method?;
        Some(MethodRow { role, row, method })
    })
}

/// The arm of `forward!` for all quantities that a wrapper does not change: those that only observe a state. Those of accelerations are not
/// among them, since a wrapper may have others.
fn observed() -> String {
    let observed = rows().filter(|of| of.role.is_observed() && !of.reads(Argument::Accelerations));
    let arms: Vec<String> = observed
        .map(|of| format!("        crate::forward::forward!(@ {});\n", of.row.name))
        .collect();
    format!("    (@ observed) => {{\n{}    }};\n", arms.concat())
}

impl MethodRow {
    fn reads(&self, argument: Argument) -> bool {
        self.row.of.contains(&argument)
    }

    fn kind(&self) -> Kind {
        match self.row.extent {
            Extent::Number => Kind::Number,
            Extent::Symmetric(_) => Kind::Matrix,
            Extent::Each(ItemKind::Coordinate) => Kind::Vector,
            _ => Kind::Numbers,
        }
    }

    /// The name of the numbers that it writes: the last word of its own.
    fn numbers(&self) -> &'static str {
        self.row.name.rsplit('_').next().unwrap_or(self.row.name)
    }

    /// The head of the method up to its brace. Names of arguments that are not used begin with `_`.
    fn head(&self, vector: &str, inputs: &str, matrix: &str, uses: [&str; 2]) -> String {
        let [before, before_numbers] = uses;
        let mut arguments = vec!["&self".to_owned()];
        for of in self.row.of {
            let of_type = match of {
                Argument::Time => "f64".to_owned(),
                Argument::Inputs => format!("&{inputs}"),
                _ => format!("&{vector}"),
            };
            arguments.push(format!("{before}{}: {of_type}", of.letter()));
        }
        let numbers = match self.kind() {
            Kind::Number => None,
            Kind::Vector => Some(vector),
            Kind::Matrix => Some(matrix),
            Kind::Numbers => Some("[f64]"),
        };
        let written = numbers.map(|of| format!("{before_numbers}{}: &mut {of}", self.numbers()));
        arguments.extend(written);
        let result = if self.kind() == Kind::Number {
            " -> f64"
        } else {
            ""
        };
        let name = self.row.name;
        let line = format!("    fn {name}({}){result} {{", arguments.join(", "));
        // The end of an empty body stands on the same line, if that fits.
        let is_empty = uses == ["_", "_"];
        if line.chars().count() + usize::from(is_empty) <= COLUMNS {
            return line;
        }
        let lines: Vec<String> = arguments
            .iter()
            .map(|of| format!("        {of},\n"))
            .collect();
        format!("    fn {name}(\n{}    ){result} {{", lines.concat())
    }

    /// The method in the trait, with its documentation.
    fn in_trait(&self) -> String {
        let numbers = self.numbers();
        let is_number = self.kind() == Kind::Number;
        let (body, uses) = match self.method.default {
            DefaultMethod::Unknown if is_number => ("f64::NAN".to_owned(), ["_", ""]),
            DefaultMethod::Unknown => {
                let fill = match self.kind() {
                    Kind::Numbers => format!("{numbers}.fill(f64::NAN);"),
                    _ => format!("{numbers}.as_mut_slice().fill(f64::NAN);"),
                };
                (fill, ["_", ""])
            }
            DefaultMethod::Zero if is_number => ("0.0".to_owned(), ["_", ""]),
            DefaultMethod::Zero => (format!("{numbers}.fill(0.0);"), ["_", ""]),
            DefaultMethod::OfContacts(quantity) => {
                let v = if self.reads(Argument::Velocities) {
                    "v"
                } else {
                    "q"
                };
                let of = format!("ContactQuantity::{quantity}");
                (
                    format!("write_each(self, {of}, (t, q, {v}), {numbers});"),
                    ["", ""],
                )
            }
            DefaultMethod::Nothing | DefaultMethod::Written => (String::new(), ["_", "_"]),
        };
        let head = self.head("Self::Vector", "Self::Inputs", "Self::Matrix", uses);
        let is_for_items = matches!(
            self.method.default,
            DefaultMethod::Nothing | DefaultMethod::OfContacts(_)
        );
        let attribute = if is_for_items {
            "    #[inline(always)]\n"
        } else {
            ""
        };
        let end = match body.as_str() {
            "" if head.contains('\n') => "\n    }\n".to_owned(),
            "" => "}\n".to_owned(),
            body => format!("\n        {body}\n    }}\n"),
        };
        format!("{}{attribute}{head}{end}", self.docs())
    }

    /// The documentation: the sentences of the row, and its remarks.
    fn docs(&self) -> String {
        let sentences = [in_letters(self.row.docs.trim())].into_iter();
        let remarks = self
            .method
            .remarks
            .iter()
            .map(|line| line.trim().to_owned());
        let lines: Vec<String> = sentences.chain(remarks).collect();
        let paragraphs = lines.split(String::is_empty);
        let comments: Vec<String> = paragraphs.map(|lines| comment(&lines.join(" "))).collect();
        comments.join("    ///\n")
    }

    /// The method of interpreted machines.
    fn interpreted(&self) -> String {
        let given = |argument, name| if self.reads(argument) { name } else { "&[]" };
        let q = given(Argument::Coordinates, "q");
        let v = given(Argument::Velocities, "v");
        let u = given(Argument::Inputs, "&u.values");
        let mut lines = String::new();
        let arguments = if self.reads(Argument::Accelerations) {
            let rest = format!("..at(t, {q}, {v}, {u})");
            lines += "        let arguments = Arguments {\n            a,\n";
            lines += &format!("            {rest}\n        }};\n");
            "arguments".to_owned()
        } else {
            format!("at(t, {q}, {v}, {u})")
        };
        let (role, numbers) = (format!("Role::{:?}", self.role), self.numbers());
        lines += &match self.kind() {
            Kind::Number => format!("        self.number({role}, {arguments})\n"),
            Kind::Matrix => format!("        self.fill_square({role}, {arguments}, {numbers});\n"),
            _ => format!("        self.fill({role}, {arguments}, {numbers});\n"),
        };
        let head = self.head("Vec<f64>", "Named", "Vec<f64>", ["", ""]);
        format!("{head}\n{lines}    }}\n")
    }

    /// The comparison of the method of an emitted machine with the interpreter.
    fn compared(&self) -> String {
        let given = self.row.of.iter().map(|of| match of {
            Argument::Time => "t".to_owned(),
            of => format!("&{}", of.letter()),
        });
        let given = given.collect::<Vec<_>>().join(", ");
        let name = self.row.name;
        let (own, numbers) = match self.kind() {
            Kind::Vector => ("vector(numbers)", "own.as_slice()"),
            _ => (
                "<M::System as System>::Matrix::zeros(n * n)",
                "&lower(own.as_slice(), n)",
            ),
        };
        let lines = match self.kind() {
            Kind::Number => vec![format!("numbers[0] = system.{name}({given});")],
            Kind::Numbers => vec![format!("system.{name}({given}, numbers);")],
            Kind::Vector | Kind::Matrix => vec![
                format!("let mut own = {own};"),
                format!("system.{name}({given}, &mut own);"),
                format!("numbers.copy_from_slice({numbers});"),
            ],
        };
        let lines: Vec<String> = lines
            .iter()
            .map(|line| format!("            {line}\n"))
            .collect();
        let role = self.role;
        format!(
            "        compare(Role::{role:?}, &|numbers| {{\n{}        }});\n",
            lines.concat()
        )
    }

    /// The arm of `forward!`.
    fn forwarded(&self) -> String {
        let kind = match self.kind() {
            Kind::Number => "number",
            Kind::Vector => "vector",
            Kind::Matrix => "matrix",
            Kind::Numbers => "numbers",
        };
        let letters: Vec<&str> = self.row.of.iter().map(|of| of.letter()).collect();
        let (name, letters) = (self.row.name, letters.join(" "));
        format!("    (@ {name}) => {{ crate::forward::forward!(@ {kind} {name} {letters}); }};\n")
    }
}

/// A sentence of the table with its symbols in the letters of the equations.
fn in_letters(text: &str) -> String {
    let mut parts: Vec<String> = text.split('`').map(str::to_owned).collect();
    for symbol in parts.iter_mut().skip(1).step_by(2) {
        let mut written = String::new();
        let mut word = String::new();
        for letter in symbol.chars().chain(['\0']) {
            if letter.is_ascii_alphanumeric() {
                word.push(letter);
                continue;
            }
            written += match word.as_str() {
                "gamma" => "γ",
                "dgamma" => "dγ",
                "lambda" => "λ",
                "phi" => "φ",
                "sigma" => "σ",
                "tau" => "τ",
                word => word,
            };
            word.clear();
            written.push(letter);
        }
        *symbol = written
            .trim_end_matches('\0')
            .replace(" - ", " − ")
            .replace("dg/dt", "∂g/∂t");
    }
    parts.join("`")
}

/// A paragraph as lines of a doc comment.
fn comment(text: &str) -> String {
    let mut lines = String::new();
    let mut line = String::from("    ///");
    for word in text.split_whitespace() {
        if line.chars().count() + 1 + word.chars().count() > COMMENT_COLUMNS {
            lines += &line;
            lines.push('\n');
            line = String::from("    ///");
        }
        line.push(' ');
        line += word;
    }
    lines += &line;
    lines.push('\n');
    lines
}
