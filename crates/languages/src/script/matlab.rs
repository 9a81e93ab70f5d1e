//! MATLAB and Octave: one function that returns a struct of handles, followed by the functions.

use lagrangian_symbolic::Function;

use super::{Dialect, Entries, Syntax, Table};
use lagrangian_emit::layout::Writer;

pub(super) const MATLAB: Dialect = Dialect {
    name: "matlab",
    summary: "The operations as MATLAB, for Octave too",
    extension: "m",
    syntax: &Matlab,
};

struct Matlab;

impl Syntax for Matlab {
    fn comment(&self) -> &'static str {
        "%"
    }

    fn reserved(&self) -> &'static [&'static str] {
        &[
            "break",
            "case",
            "catch",
            "classdef",
            "continue",
            "else",
            "elseif",
            "end",
            "for",
            "function",
            "global",
            "if",
            "otherwise",
            "parfor",
            "persistent",
            "return",
            "spmd",
            "switch",
            "try",
            "while",
            "pi",
            "e",
            "i",
            "j",
            "sin",
            "cos",
            "tan",
            "asin",
            "acos",
            "atan",
            "atan2",
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
            "power",
            "error",
            "machine",
            "until",
            "do",
            "unwind_protect",
        ]
    }

    fn begin(&self, writer: &mut Writer, name: &str, tables: &[Table], functions: &[String]) {
        writer.gap();
        writer.open(format!("function machine = {name}()"));
        for table in tables {
            let entries = table.entries(text_of, "NaN");
            let value = match &table.entries {
                Entries::Texts(_) => format!("{{{}}}", entries.join(", ")),
                Entries::Numbers(_) => self.list(&entries),
            };
            writer.line(format!("machine.{} = {value};", table.name));
        }
        for function in functions {
            writer.line(format!("machine.{function} = @{function};"));
        }
        writer.close("end");
    }

    fn end(&self, writer: &mut Writer, _: &[Table], _: &[String]) {
        writer.gap();
        writer.line("% What rounding took from a*b: T. J. Dekker, Numer. Math. 18 (1971) 224-242.");
        writer.open("function result = product_error(a, b)");
        writer.line("s = 134217729 * a; a_high = s - (s - a); a_low = a - a_high;");
        writer.line("s = 134217729 * b; b_high = s - (s - b); b_low = b - b_high;");
        writer.line("result = ((a_high * b_high - a * b) + a_high * b_low + a_low * b_high) + a_low * b_low;");
        writer.close("end");
        writer.gap();
        writer.line("% What rounding took from a + b.");
        writer.open("function result = sum_error(a, b)");
        writer.line("s = a + b; b_kept = s - a;");
        writer.line("result = (a - (s - b_kept)) + (b - b_kept);");
        writer.close("end");
    }

    fn function(&self, name: &str, arguments: &[&str]) -> String {
        format!("function result = {name}({})", arguments.join(", "))
    }

    fn function_end(&self) -> &'static str {
        "end"
    }

    fn result(&self, value: &str) -> String {
        format!("result = {value};")
    }

    fn assign(&self, name: &str, value: &str) -> String {
        format!("{name} = {value};")
    }

    fn element(&self, list: &str, index: usize) -> String {
        format!("{list}({})", index + 1)
    }

    fn list(&self, entries: &[String]) -> String {
        format!("[{}]", entries.join("; "))
    }

    fn matrix(&self, rows: &[Vec<String>]) -> String {
        let rows: Vec<String> = rows.iter().map(|row| row.join(", ")).collect();
        format!("[{}]", rows.join("; "))
    }

    fn pi(&self) -> &'static str {
        "pi"
    }

    fn call(&self, function: Function) -> &'static str {
        use Function::*;
        match function {
            Ln => "log",
            Pow => "power",
            other => other.name(),
        }
    }

    fn guard(&self, writer: &mut Writer, pivot: &str, limit: &str, message: &str) {
        writer.open(format!("if ~({pivot} > {limit})"));
        writer.line(format!("error({});", text_of(message)));
        writer.close("end");
    }
}

/// A text in single quotes.
fn text_of(text: &str) -> String {
    format!("'{}'", text.replace('\'', "''"))
}
