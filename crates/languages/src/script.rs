//! Languages for computation and symbolic formulas: one file for one machine, with functions of lists of numbers and the
//! same operations in the same order as elsewhere.
//!
//! This module contains what the languages share; each has a file of its own with its [`Dialect`], and a row of [`DIALECTS`].

mod javascript;
mod julia;
mod matlab;
mod sympy;

use std::collections::BTreeMap;
use std::fmt;

use lagrangian_mechanics::Proved;
use lagrangian_program::quantity::{Argument, Extent};
use lagrangian_program::{EliminationStep, Function, Guard, Program, Role, Shape, Slot, Source};
use lagrangian_symbolic::{self as symbolic, Rational};

use lagrangian_emit::body::{self, Expression, Language, Precedence, Rounded};
use lagrangian_emit::layout::Writer;
use lagrangian_emit::names::{Scope, ascii, flat, output_functions, snake_case};

pub use javascript::JAVASCRIPT;

/// A language.
pub struct Dialect {
    /// Its name, in lower case.
    pub name: &'static str,
    /// What is written, in a phrase.
    pub summary: &'static str,
    /// The extension of its files.
    pub extension: &'static str,
    syntax: &'static dyn Syntax,
}

/// All languages.
pub static DIALECTS: [Dialect; 4] = [
    sympy::SYMPY,
    matlab::MATLAB,
    julia::JULIA,
    javascript::JAVASCRIPT,
];

impl PartialEq for Dialect {
    fn eq(&self, other: &Dialect) -> bool {
        self.name == other.name
    }
}

impl Eq for Dialect {}

impl fmt::Debug for Dialect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// The syntax in which a language differs from others.
trait Syntax: Sync {
    /// The beginning of a comment line.
    fn comment(&self) -> &'static str;
    /// Words that cannot be names of variables.
    fn reserved(&self) -> &'static [&'static str];
    /// Writes the text before the functions: imports, and helper functions. `name` is that of the machine, `functions`
    /// lists the names of all functions.
    fn begin(&self, writer: &mut Writer, name: &str, tables: &[Table], functions: &[String]);
    /// Writes the end of the file.
    fn end(&self, writer: &mut Writer, tables: &[Table], functions: &[String]);
    /// The line that begins a function.
    fn function(&self, name: &str, arguments: &[&str]) -> String;
    /// The line that ends a function; empty if there is none.
    fn function_end(&self) -> &'static str;
    /// The line that returns a value.
    fn result(&self, value: &str) -> String;
    /// The assignment of a variable.
    fn assign(&self, name: &str, value: &str) -> String;
    /// An element of a list, with the index counted from 0.
    fn element(&self, list: &str, index: usize) -> String;
    /// A list of numbers.
    fn list(&self, entries: &[String]) -> String {
        format!("[{}]", entries.join(", "))
    }
    /// A matrix, given row by row.
    fn matrix(&self, rows: &[Vec<String>]) -> String;
    /// A number.
    fn constant(&self, value: &Rational) -> Expression {
        number(value.to_f64())
    }
    /// π.
    fn pi(&self) -> &'static str;
    /// The name of a function.
    fn call(&self, function: symbolic::Function) -> &'static str;
    /// The rounding error of a product or a sum; by default a call of one of the helpers that the file defines.
    fn error(&self, of: Rounded, a: &Expression, b: &Expression) -> Expression {
        let name = match of {
            Rounded::Product => "product_error",
            Rounded::Sum => "sum_error",
        };
        Expression::call(format!("{name}({}, {})", a.text, b.text))
    }
    /// Writes an early return for a vanishing pivot: where `pivot > limit` does not hold.
    fn guard(&self, writer: &mut Writer, pivot: &str, limit: &str, message: &str);
}

/// Names or numbers of the machine that a file lists.
struct Table {
    name: &'static str,
    entries: Entries,
}

impl Table {
    /// The entries, texts as `text` quotes them.
    fn entries(&self, text: impl Fn(&str) -> String, nan: &str) -> Vec<String> {
        let number = |x: &f64| {
            if x.is_nan() {
                nan.to_owned()
            } else {
                format!("{x:?}")
            }
        };
        match &self.entries {
            Entries::Texts(texts) => texts.iter().map(|entry| text(entry)).collect(),
            Entries::Numbers(numbers) => numbers.iter().map(number).collect(),
        }
    }
}

enum Entries {
    Texts(Vec<String>),
    /// NaN where no value is given.
    Numbers(Vec<f64>),
}

/// The text of the file. `origin` holds lines for its head, `formulas` those that comments show.
pub fn file(
    program: &Proved,
    dialect: &Dialect,
    origin: &[String],
    formulas: &BTreeMap<Role, Vec<String>>,
) -> String {
    let syntax = dialect.syntax;
    let outputs = program.outputs.iter().map(|output| &output.name);
    let speaker = ScriptEmitter {
        program,
        syntax,
        output_functions: output_functions(outputs, ascii),
    };
    let mut writer = Writer::default();
    let comment = syntax.comment();
    for line in origin
        .iter()
        .map(String::as_str)
        .chain(program.docs.lines())
    {
        writer.line(format!("{comment} {}", plain(line)).trim_end());
    }
    for line in [
        "",
        "prepare(x) computes from the parameters x what depends on them alone; the other functions take that as p, and the time t,",
        "coordinates q, rates v, inputs u and accelerations a, in the order of the tables. Numbers are in the units of the tables,",
        "of other quantities in SI units; angles in radians.",
    ] {
        writer.line(format!("{comment} {line}").trim_end());
    }
    let functions: Vec<&Function> = program.all_functions().collect();
    let names: Vec<String> = functions.iter().map(|f| speaker.name(f.role)).collect();
    let tables = tables(program);
    let mut name = ascii(&snake_case(&program.name));
    if names.contains(&name) {
        name.push_str("_machine");
    }
    syntax.begin(&mut writer, &name, &tables, &names);
    for (function, name) in functions.into_iter().zip(&names) {
        let formulas = formulas.get(&function.role);
        speaker.function(
            &mut writer,
            function,
            name,
            formulas.map_or(&[], Vec::as_slice),
        );
    }
    syntax.end(&mut writer, &tables, &names);
    writer.finish()
}

fn tables(program: &Program) -> Vec<Table> {
    let texts = |name, slots: &[Slot], of: fn(&Slot) -> String| Table {
        name,
        entries: Entries::Texts(slots.iter().map(of).collect()),
    };
    let name: fn(&Slot) -> String = |slot| slot.name.to_string();
    let unit: fn(&Slot) -> String = |slot| slot.unit_text.clone();
    let defaults = |name, slots: &[Slot]| Table {
        name,
        entries: Entries::Numbers(
            slots
                .iter()
                .map(|slot| slot.default.as_ref().map_or(f64::NAN, |d| d.value))
                .collect(),
        ),
    };
    vec![
        texts("parameters", &program.parameters, name),
        texts("parameter_units", &program.parameters, unit),
        defaults("parameter_defaults", &program.parameters),
        texts("coordinates", &program.coordinates, name),
        texts("coordinate_units", &program.coordinates, unit),
        texts("inputs", &program.inputs, name),
        texts("input_units", &program.inputs, unit),
        defaults("input_defaults", &program.inputs),
        texts("outputs", &program.outputs, name),
        texts("units_of_outputs", &program.outputs, unit),
    ]
}

/// The emitter of a program in a language.
struct ScriptEmitter<'a> {
    program: &'a Program,
    syntax: &'static dyn Syntax,
    /// The name of the function of each output.
    output_functions: Vec<String>,
}

impl ScriptEmitter<'_> {
    fn name(&self, role: Role) -> String {
        match role {
            Role::Output(i) => self.output_functions[i].clone(),
            role => role.name(),
        }
    }

    fn function(&self, writer: &mut Writer, function: &Function, name: &str, formulas: &[String]) {
        let (syntax, role) = (self.syntax, function.role);
        let comment = syntax.comment();
        writer.gap();
        for line in self.program.docs(role).replace('`', "").lines() {
            writer.line(format!("{comment} {}", plain(line)).trim_end());
        }
        for formula in formulas.iter().flat_map(|formula| formula.lines()) {
            writer.line(format!("{comment}    {}", plain(formula)).trim_end());
        }
        let arguments: Vec<&str> = match role {
            Role::Prepare | Role::Start => vec!["x"],
            _ => {
                let of = role.row().of;
                let all = [
                    (Argument::Time, "t"),
                    (Argument::Coordinates, "q"),
                    (Argument::Velocities, "v"),
                    (Argument::Inputs, "u"),
                    (Argument::Accelerations, "a"),
                ];
                let read = all
                    .into_iter()
                    .filter(|(argument, _)| of.contains(argument));
                ["p"]
                    .into_iter()
                    .chain(read.map(|(_, name)| name))
                    .collect()
            }
        };
        writer.open(syntax.function(name, &arguments));
        let mut scope = Scope::with(syntax.reserved());
        for taken in [
            "p",
            "t",
            "q",
            "v",
            "u",
            "a",
            "x",
            "result",
            "product_error",
            "sum_error",
        ] {
            scope.take_plain(taken);
        }
        // The preparation has guards too.
        let results = body::statements(writer, self, function, scope, &[]);
        let texts: Vec<String> = results.into_iter().map(|result| result.text).collect();
        let columns = match (role.row().extent, function.shape) {
            (Extent::Rows(_, other), _) => Some(self.program.sizes().of(other)),
            (_, Shape::Matrix(_, columns)) => Some(columns),
            _ => None,
        };
        let value = match (function.shape, columns) {
            (Shape::Scalar, _) => texts.into_iter().next().unwrap_or_default(),
            (Shape::Symmetric(n), _) => {
                let row = |i: usize| (0..n).map(|j| texts[Shape::index(i, j)].clone()).collect();
                syntax.matrix(&(0..n).map(row).collect::<Vec<_>>())
            }
            (_, Some(columns)) if columns > 0 => {
                let rows = texts.chunks(columns).map(<[String]>::to_vec);
                syntax.matrix(&rows.collect::<Vec<_>>())
            }
            _ => syntax.list(&texts),
        };
        writer.line(syntax.result(&value));
        writer.close(syntax.function_end());
    }

    fn coordinate(&self, index: u32) -> String {
        ascii(&flat(&self.program.coordinates[index as usize].name))
    }
}

impl Language for ScriptEmitter<'_> {
    fn steps(&self, writer: &mut Writer, steps: &[EliminationStep]) {
        let text = self.program.text_of_steps(steps);
        writer.line(format!("{} {}", self.syntax.comment(), plain(&text)));
    }

    fn constant(&self, value: &Rational) -> Expression {
        self.syntax.constant(value)
    }

    fn pi(&self) -> Expression {
        Expression::leaf(self.syntax.pi())
    }

    fn argument(&self, _: Source) -> Option<Expression> {
        None
    }

    fn variable(&self, source: Source) -> (String, String) {
        let element = |list, i: u32| self.syntax.element(list, i as usize);
        let slot = |slots: &[Slot], i: u32| ascii(&flat(&slots[i as usize].name));
        match source {
            Source::Parameter(i) => (slot(&self.program.parameters, i), element("x", i)),
            Source::Prepared(i) => (format!("k{i}"), element("p", i)),
            Source::Time => ("time".into(), "t".into()),
            Source::Coordinate(i) => (self.coordinate(i), element("q", i)),
            Source::Velocity(i) => (format!("{}_dot", self.coordinate(i)), element("v", i)),
            Source::Acceleration(i) => (format!("{}_ddot", self.coordinate(i)), element("a", i)),
            Source::Input(i) => (slot(&self.program.inputs, i), element("u", i)),
            Source::AtTime(i) => (format!("r{i}"), element("r", i)),
            Source::AtPosition(i) => (format!("r{i}"), element("r", i)),
        }
    }

    fn unary(&self, function: symbolic::Function, argument: &Expression) -> Expression {
        Expression::call(format!("{}({})", self.syntax.call(function), argument.text))
    }

    fn binary(&self, function: symbolic::Function, a: &Expression, b: &Expression) -> Expression {
        Expression::call(format!(
            "{}({}, {})",
            self.syntax.call(function),
            a.text,
            b.text
        ))
    }

    fn error(&self, of: Rounded, a: &Expression, b: &Expression) -> Expression {
        self.syntax.error(of, a, b)
    }

    fn bind(&self, writer: &mut Writer, name: &str, value: &str) {
        writer.line(self.syntax.assign(name, value));
    }

    fn sin_cos(
        &self,
        writer: &mut Writer,
        sin: Option<&str>,
        cos: Option<&str>,
        angle: &Expression,
    ) {
        use symbolic::Function::{Cos, Sin};
        for (name, function) in [(sin, Sin), (cos, Cos)] {
            if let Some(name) = name {
                let value = format!("{}({})", self.syntax.call(function), angle.text);
                writer.line(self.syntax.assign(name, &value));
            }
        }
    }

    fn guard(&self, writer: &mut Writer, guard: &Guard, [pivot, scale]: [&str; 2]) {
        let n = self.program.dimension();
        let of = match guard.coordinate.checked_sub(n) {
            None => self.program.coordinates[guard.coordinate].name.to_string(),
            Some(k) => self
                .program
                .constraints
                .get(k)
                .map_or_else(String::new, |c| c.name.clone()),
        };
        let limit = format!("{scale} * {}", number(guard.tolerance).text);
        let message = format!("there is no acceleration of {of} here: its inertia vanishes");
        self.syntax.guard(writer, pivot, &limit, &message);
    }

    fn identifier(&self, scope: &mut Scope, name: &str) -> String {
        scope.take_plain(name)
    }

    fn constant_name(&self, _value: &Rational) -> Option<&'static str> {
        None
    }
}

/// A double-precision number, in the notation that all these languages share.
fn number(x: f64) -> Expression {
    let text = format!("{x:?}");
    if x < 0.0 {
        Expression {
            text,
            precedence: Precedence::Sign,
            is_leaf: false,
        }
    } else {
        Expression::leaf(text)
    }
}

/// A line without characters that any of these languages takes for a line end.
fn plain(line: &str) -> String {
    let harmless = |c: char| match c {
        '\u{2028}' | '\u{2029}' => ' ',
        c if c.is_control() => ' ',
        c => c,
    };
    line.trim().chars().map(harmless).collect()
}

/// A text in double quotes; all these languages escape like C.
fn quoted(text: &str) -> String {
    let escaped = text.replace('\\', "\\\\").replace('"', "\\\"");
    format!("\"{}\"", plain(&escaped))
}
