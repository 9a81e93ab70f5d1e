//! Julia: one module. Numbers may have any type that supports the functions.

use lagrangian_symbolic::Function;

use super::{Dialect, Entries, Syntax, Table, quoted};
use lagrangian_emit::layout::Writer;

pub(super) const JULIA: Dialect = Dialect {
    name: "julia",
    summary: "The operations as Julia",
    extension: "jl",
    syntax: &Julia,
};

struct Julia;

impl Syntax for Julia {
    fn comment(&self) -> &'static str {
        "#"
    }

    fn reserved(&self) -> &'static [&'static str] {
        &[
            "baremodule",
            "begin",
            "break",
            "catch",
            "const",
            "continue",
            "do",
            "else",
            "elseif",
            "end",
            "export",
            "false",
            "finally",
            "for",
            "function",
            "global",
            "if",
            "import",
            "let",
            "local",
            "macro",
            "module",
            "quote",
            "return",
            "struct",
            "true",
            "try",
            "using",
            "while",
            "in",
            "isa",
            "where",
            "pi",
            "sin",
            "cos",
            "tan",
            "asin",
            "acos",
            "atan",
            "sinh",
            "cosh",
            "tanh",
            "exp",
            "log",
            "sqrt",
            "abs",
            "sign",
            "min",
            "max",
            "fma",
            "error",
        ]
    }

    fn begin(&self, writer: &mut Writer, name: &str, tables: &[Table], _: &[String]) {
        writer.line(format!("module {}", camel(name)));
        writer.gap();
        for table in tables {
            let element = match &table.entries {
                Entries::Texts(_) => "String",
                Entries::Numbers(_) => "Float64",
            };
            let entries = table.entries(literal, "NaN").join(", ");
            writer.line(format!("const {} = {element}[{entries}]", table.name));
        }
        writer.gap();
        writer.line("# What rounding took from a*b and from a + b.");
        writer.line("product_error(a, b) = fma(a, b, -(a * b))");
        writer.open("function sum_error(a, b)");
        writer.line("s = a + b");
        writer.line("b_kept = s - a");
        writer.line("return (a - (s - b_kept)) + (b - b_kept)");
        writer.close("end");
    }

    fn end(&self, writer: &mut Writer, _: &[Table], _: &[String]) {
        writer.gap();
        writer.line("end");
    }

    fn function(&self, name: &str, arguments: &[&str]) -> String {
        format!("function {name}({})", arguments.join(", "))
    }

    fn function_end(&self) -> &'static str {
        "end"
    }

    fn result(&self, value: &str) -> String {
        format!("return {value}")
    }

    fn assign(&self, name: &str, value: &str) -> String {
        format!("{name} = {value}")
    }

    fn element(&self, list: &str, index: usize) -> String {
        format!("{list}[{}]", index + 1)
    }

    fn matrix(&self, rows: &[Vec<String>]) -> String {
        let rows: Vec<String> = rows.iter().map(|row| row.join(" ")).collect();
        format!("[{}]", rows.join("; "))
    }

    fn pi(&self) -> &'static str {
        "pi"
    }

    fn call(&self, function: Function) -> &'static str {
        use Function::*;
        match function {
            Ln => "log",
            Atan2 => "atan",
            Pow => "^",
            other => other.name(),
        }
    }

    fn guard(&self, writer: &mut Writer, pivot: &str, limit: &str, message: &str) {
        writer.line(format!("{pivot} > {limit} || error({})", literal(message)));
    }
}

/// A string literal without interpolation: `$` is escaped.
fn literal(text: &str) -> String {
    quoted(text).replace('$', "\\$")
}

/// `double_pendulum` as the name of a module.
fn camel(name: &str) -> String {
    let words = name.split('_').map(|word| {
        let mut letters = word.chars();
        let first = letters.next().map(|c| c.to_ascii_uppercase());
        first.into_iter().chain(letters).collect::<String>()
    });
    words.collect()
}
