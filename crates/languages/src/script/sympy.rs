//! Python with SymPy. Constants are exact, so formulas are exact; given numbers, the functions compute numbers.
//!
//! SymPy does not evaluate the sine of an exact number, nor its product with a float. Each function has therefore a second form, in
//! which all constants are floats, for arguments that are numbers.

use lagrangian_symbolic::{Function, Rational};

use super::{Dialect, Syntax, Table, quoted};
use lagrangian_emit::body::{Expression, Precedence, Rounded};
use lagrangian_emit::layout::Writer;

/// What the functions use of SymPy, with constants as floats, and the decorator that chooses between the two forms of a function.
const PRELUDE: &str = r#"import functools
import inspect
import types

import sympy as sp

_FLOATS = {**vars(sp), "Integer": sp.Float, "Rational": lambda text: sp.Float(sp.Rational(text)), "pi": sp.pi.evalf()}

def _evaluated(function):
    """Evaluates constants where all arguments are numbers and one is a float: exact ones would remain, in a long formula."""
    with_floats = types.FunctionType(function.__code__, {"sp": types.SimpleNamespace(**_FLOATS)})

    @functools.wraps(function)
    def called(*arguments, **named):
        arguments = inspect.signature(function).bind(*arguments, **named).args
        lists = [[sp.sympify(x) for x in one] if hasattr(one, "__iter__") else sp.sympify(one) for one in arguments]
        flat = [x for one in lists for x in (one if isinstance(one, list) else [one])]
        if all(x.is_number for x in flat) and any(x.has(sp.Float) for x in flat):
            return with_floats(*([x.evalf() for x in one] if isinstance(one, list) else one.evalf() for one in lists))
        return function(*arguments)

    return called"#;

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
        PRELUDE.lines().for_each(|line| writer.line(line));
        writer.gap();
        for table in tables {
            let entries = table.entries(quoted, "sp.nan");
            writer.line(format!(
                "{} = [{}]",
                table.name.to_uppercase(),
                entries.join(", ")
            ));
        }
    }

    fn end(&self, _: &mut Writer, _: &[Table], _: &[String]) {}

    fn function(&self, name: &str, arguments: &[&str]) -> String {
        format!("@_evaluated\ndef {name}({}):", arguments.join(", "))
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
