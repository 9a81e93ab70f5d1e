//! JavaScript: one object with the tables and the functions. Sines may differ by one unit in the last place from those
//! of other libraries; everything else has the same bits.

use lagrangian_symbolic::Function;

use super::{Dialect, Syntax, Table, quoted};
use lagrangian_emit::layout::Writer;

/// JavaScript.
pub const JAVASCRIPT: Dialect = Dialect {
    name: "javascript",
    summary: "The operations as JavaScript",
    extension: "js",
    syntax: &JavaScript,
};

struct JavaScript;

impl Syntax for JavaScript {
    fn comment(&self) -> &'static str {
        "//"
    }

    fn reserved(&self) -> &'static [&'static str] {
        &[
            "arguments",
            "await",
            "break",
            "case",
            "catch",
            "class",
            "const",
            "continue",
            "debugger",
            "default",
            "delete",
            "do",
            "else",
            "enum",
            "eval",
            "export",
            "extends",
            "false",
            "finally",
            "for",
            "function",
            "if",
            "implements",
            "import",
            "in",
            "instanceof",
            "interface",
            "let",
            "new",
            "null",
            "package",
            "private",
            "protected",
            "public",
            "return",
            "static",
            "super",
            "switch",
            "this",
            "throw",
            "true",
            "try",
            "typeof",
            "undefined",
            "var",
            "void",
            "while",
            "with",
            "yield",
            "Math",
            "NaN",
            "Infinity",
        ]
    }

    fn begin(&self, writer: &mut Writer, _: &str, _: &[Table], _: &[String]) {
        writer.line("const machine = (() => {");
        writer.line("\"use strict\";");
        writer.gap();
        writer
            .line("// What rounding took from a*b: T. J. Dekker, Numer. Math. 18 (1971) 224-242.");
        writer.open("function product_error(a, b) {");
        writer.line("const s = 134217729 * a, a_high = s - (s - a), a_low = a - a_high;");
        writer.line("const r = 134217729 * b, b_high = r - (r - b), b_low = b - b_high;");
        writer.line(
            "return ((a_high * b_high - a * b) + a_high * b_low + a_low * b_high) + a_low * b_low;",
        );
        writer.close("}");
        writer.gap();
        writer.line("// What rounding took from a + b.");
        writer.open("function sum_error(a, b) {");
        writer.line("const s = a + b, b_kept = s - a;");
        writer.line("return (a - (s - b_kept)) + (b - b_kept);");
        writer.close("}");
    }

    fn end(&self, writer: &mut Writer, tables: &[Table], functions: &[String]) {
        writer.gap();
        writer.open("return {");
        for table in tables {
            let entries = table.entries(quoted, "NaN");
            writer.line(format!("{}: [{}],", table.name, entries.join(", ")));
        }
        let is_output = |name: &&String| name.starts_with("output_");
        let outputs: Vec<&str> = functions
            .iter()
            .filter(is_output)
            .map(String::as_str)
            .collect();
        for function in functions {
            writer.line(format!("{function},"));
        }
        writer.line(format!("functions_of_outputs: [{}],", outputs.join(", ")));
        writer.close("};");
        writer.line("})();");
    }

    fn function(&self, name: &str, arguments: &[&str]) -> String {
        format!("function {name}({}) {{", arguments.join(", "))
    }

    fn function_end(&self) -> &'static str {
        "}"
    }

    fn result(&self, value: &str) -> String {
        format!("return {value};")
    }

    fn assign(&self, name: &str, value: &str) -> String {
        format!("const {name} = {value};")
    }

    fn element(&self, list: &str, index: usize) -> String {
        format!("{list}[{index}]")
    }

    fn matrix(&self, rows: &[Vec<String>]) -> String {
        let rows: Vec<String> = rows.iter().map(|row| self.list(row)).collect();
        format!("[{}]", rows.join(", "))
    }

    fn pi(&self) -> &'static str {
        "Math.PI"
    }

    fn call(&self, function: Function) -> &'static str {
        use Function::*;
        match function {
            Sin => "Math.sin",
            Cos => "Math.cos",
            Tan => "Math.tan",
            Asin => "Math.asin",
            Acos => "Math.acos",
            Atan => "Math.atan",
            Atan2 => "Math.atan2",
            Sinh => "Math.sinh",
            Cosh => "Math.cosh",
            Tanh => "Math.tanh",
            Exp => "Math.exp",
            Ln => "Math.log",
            Sqrt => "Math.sqrt",
            Abs => "Math.abs",
            Sign => "Math.sign",
            Min => "Math.min",
            Max => "Math.max",
            Pow => "Math.pow",
        }
    }

    fn guard(&self, writer: &mut Writer, pivot: &str, limit: &str, message: &str) {
        writer.line(format!(
            "if (!({pivot} > {limit})) throw new Error({});",
            quoted(message)
        ));
    }
}
