//! Python with SymPy. Constants are exact, so formulas are exact; given numbers, the functions compute numbers.

use lagrangian_symbolic::{Function, Rational};

use super::{Dialect, Entries, Syntax, Table, quoted};
use crate::body::{Expression, Precedence, Rounded};
use crate::layout::Writer;

pub(super) const SYMPY: Dialect = Dialect {
    name: "sympy",
    summary: "The operations as Python for SymPy, for numbers and symbols",
    extension: "py",
    syntax: &Sympy,
};

struct Sympy;

impl Syntax for Sympy {
    fn comment(&self) -> &'static str {
        "#"
    }

    fn reserved(&self) -> &'static [&'static str] {
        &[
            "and", "as", "assert", "async", "await", "break", "case", "class", "continue", "def",
            "del", "elif", "else", "except", "finally", "for", "from", "global", "if", "import",
            "in", "is", "lambda", "match", "nonlocal", "not", "or", "pass", "raise", "return",
            "try", "while", "with", "yield", "True", "False", "None", "sp",
        ]
    }

    fn begin(&self, writer: &mut Writer, _: &str, tables: &[Table], _: &[String]) {
        writer.line("#");
        writer.line("# Arguments may be numbers or symbols of SymPy. Where symbols go in, nothing says that the mass matrix is regular.");
        writer.line("import sympy as sp");
        writer.gap();
        for table in tables {
            let entries: Vec<String> = match &table.entries {
                Entries::Texts(texts) => texts.iter().map(|text| quoted(text)).collect(),
                Entries::Numbers(numbers) => {
                    let one = |x: &f64| {
                        if x.is_nan() {
                            "sp.nan".to_owned()
                        } else {
                            format!("{x:?}")
                        }
                    };
                    numbers.iter().map(one).collect()
                }
            };
            writer.line(format!(
                "{} = [{}]",
                table.name.to_uppercase(),
                entries.join(", ")
            ));
        }
    }

    fn end(&self, _: &mut Writer, _: &[Table], _: &[String]) {}

    fn function(&self, name: &str, arguments: &[&str]) -> String {
        format!("def {name}({}):", arguments.join(", "))
    }

    fn function_end(&self) -> &'static str {
        ""
    }

    fn result(&self, value: &str) -> String {
        format!("return {value}")
    }

    fn assign(&self, name: &str, value: &str) -> String {
        format!("{name} = {value}")
    }

    fn element(&self, list: &str, index: usize) -> String {
        format!("{list}[{index}]")
    }

    fn list(&self, entries: &[String]) -> String {
        format!("[{}]", entries.join(", "))
    }

    fn matrix(&self, rows: &[Vec<String>]) -> String {
        let rows: Vec<String> = rows.iter().map(|row| self.list(row)).collect();
        format!("sp.Matrix([{}])", rows.join(", "))
    }

    fn constant(&self, value: &Rational) -> Expression {
        let text = value.to_string();
        match text.strip_prefix('-') {
            _ if text.contains('/') => Expression::leaf(format!("sp.Rational({})", quoted(&text))),
            Some(_) => Expression {
                text,
                precedence: Precedence::Sign,
                is_leaf: false,
            },
            None => Expression::leaf(format!("sp.Integer({text})")),
        }
    }

    fn pi(&self) -> &'static str {
        "sp.pi"
    }

    fn call(&self, function: Function) -> &'static str {
        use Function::*;
        match function {
            Sin => "sp.sin",
            Cos => "sp.cos",
            Tan => "sp.tan",
            Asin => "sp.asin",
            Acos => "sp.acos",
            Atan => "sp.atan",
            Atan2 => "sp.atan2",
            Sinh => "sp.sinh",
            Cosh => "sp.cosh",
            Tanh => "sp.tanh",
            Exp => "sp.exp",
            Ln => "sp.log",
            Sqrt => "sp.sqrt",
            Abs => "sp.Abs",
            Sign => "sp.sign",
            Min => "sp.Min",
            Max => "sp.Max",
            Pow => "sp.Pow",
        }
    }

    /// Exact numbers have no rounding errors.
    fn error(&self, _: Rounded, _: &Expression, _: &Expression) -> Expression {
        Expression::leaf("sp.Integer(0)")
    }

    /// A symbolic pivot cannot be tested; with numbers, a division by zero gives a result that is not finite.
    fn guard(&self, _: &mut Writer, _: &str, _: &str, _: &str) {}
}
