//! C: one file for one machine, plain C99 over `double`, with the same operations in the same order as the Rust code.

mod reserved;
pub mod uniform;

use std::collections::BTreeMap;
use std::fmt::Write as _;

use lagrangian_symbolic::{self as symbolic, Rational};

use lagrangian_emit::body::{self, Expression, Language, Precedence, Rounded};
use lagrangian_emit::cut::{self, Cut, CutResult, Piece};
use lagrangian_emit::formula_names;
use lagrangian_emit::layout::{Writer, width};
use lagrangian_emit::names::{
    self, Field, Scope, ascii, fields, flat, output_functions, snake_case,
};
use lagrangian_mechanics::Proved;
use lagrangian_program::{
    EliminationStep, Function, Guard, Op, Program, Reads, Role, Shape, Slot, Source,
};
use lagrangian_units::{rate_unit, state_of};
use reserved::RESERVED;

/// The text of the file. `origin` holds lines for its head, `formulas` those that comments show.
pub fn file(program: &Proved, origin: &[String], formulas: &BTreeMap<Role, Vec<String>>) -> String {
    let emitter = Emitter::new(program);
    let mut writer = Writer::default();
    emitter.head(&mut writer, origin);
    sum_error(&mut writer, &[emitter.program]);
    emitter.types(&mut writer);
    sign(&mut writer, &[emitter.program]);
    emitter.prepare(&mut writer);
    for function in [&program.start].into_iter().chain(&program.functions) {
        emitter.function(&mut writer, function, formulas.get(&function.role));
    }
    writer.finish()
}

/// Whether any of the programs contains such an operation.
fn contain(programs: &[&Program], is_such: fn(&Op) -> bool) -> bool {
    let functions = programs.iter().flat_map(|program| program.all_functions());
    functions.flat_map(|function| &function.code).any(is_such)
}

/// The helper for the rounding error of a sum, where programs need it.
fn sum_error(writer: &mut Writer, programs: &[&Program]) {
    if !contain(programs, |op| matches!(op, Op::SumError(..))) {
        return;
    }
    writer.gap();
    writer.line("/* What rounding took from a + b. */");
    writer.open("static double sum_error(double a, double b) {");
    writer.line("const double sum = a + b, b_kept = sum - a;");
    writer.line("return (a - (sum - b_kept)) + (b - b_kept);");
    writer.close("}");
}

/// The helper for the sign of a number, where programs need it.
fn sign(writer: &mut Writer, programs: &[&Program]) {
    if !contain(programs, |op| {
        matches!(op, Op::Unary(symbolic::Function::Sign, _))
    }) {
        return;
    }
    writer.gap();
    writer.line("/* -1, 0 or 1. */");
    writer.open("static inline double sign(double x) {");
    writer.line("return (x > 0.0) - (x < 0.0);");
    writer.close("}");
}

struct Emitter<'a> {
    program: &'a Program,
    /// The prefix of every global name.
    prefix: String,
    /// For each slot the path to its number in its struct.
    parameters: Vec<String>,
    inputs: Vec<String>,
    prepared: Vec<String>,
    /// The name of the function of each output, without the prefix.
    output_functions: Vec<String>,
}

impl<'a> Emitter<'a> {
    fn new(program: &'a Program) -> Emitter<'a> {
        let mut scope = Scope::with(&[RESERVED, &["singular"]].concat());
        let prepared = formula_names::of_prepared(program, ascii).into_iter();
        let prepared = prepared.map(|name| scope.take_plain(&name));
        Emitter {
            prepared: prepared.collect(),
            prefix: ascii(&snake_case(&program.name)),
            output_functions: output_functions(
                program.outputs.iter().map(|output| &output.name),
                ascii,
            ),
            parameters: paths(&program.parameters),
            inputs: paths(&program.inputs),
            program,
        }
    }

    fn head(&self, writer: &mut Writer, origin: &[String]) {
        let program = self.program;
        writer.line("/*");
        for line in origin {
            writer.comment(" *", &comment_text(line));
        }
        if !origin.is_empty() && !program.docs.is_empty() {
            writer.line(" *");
        }
        for line in program.docs.lines() {
            match line.trim() {
                "" => writer.line(" *"),
                line => writer.comment(" *", &comment_text(line)),
            }
        }
        writer.line(" *");
        writer.comment(
            " *",
            &format!(
                "Machine {}: q, v and a hold {} numbers, in the order of the coordinates:",
                program.name,
                program.dimension()
            ),
        );
        for (i, slot) in program.coordinates.iter().enumerate() {
            let docs = slot.docs.split_whitespace().collect::<Vec<_>>().join(" ");
            let name = slot.name.to_string();
            let meaning = match state_of(&name) {
                Some(state) => format!(
                    "the state {state}, {}, in v, its integral over time in q",
                    rate_unit(&name, &slot.unit_text)
                ),
                None => format!("{name}, {}", slot.unit_text),
            };
            writer.comment(
                " *",
                comment_text(&format!("    [{i}] {meaning}  {docs}")).trim_end(),
            );
        }
        writer.line(" *");
        writer.comment(
            " *",
            "Whatever is computed from parameters alone is prepared once. A function takes the arguments that it uses; one that \
             is not here gives zeros. Numbers are in the units that are given for them, all others in SI units; angles in \
             radians.",
        );
        writer.line(" */");
        writer.line("#include <math.h>");
        writer.gap();
        writer.line("/*");
        writer.line(
            " * Every operation rounds by itself, so that every compiler makes the same numbers of it.",
        );
        writer.line(" * GCC does not know the pragma, and needs -std=c99 or -ffp-contract=off.");
        writer.line(" */");
        writer.line("#if !defined(__GNUC__) || defined(__clang__)");
        writer.line("#pragma STDC FP_CONTRACT OFF");
        writer.line("#endif");
    }

    fn types(&self, writer: &mut Writer) {
        let program = self.program;
        self.structure(writer, "parameters", "Parameters.", &program.parameters);
        if !program.inputs.is_empty() {
            self.structure(
                writer,
                "inputs",
                "What can be set while the machine runs.",
                &program.inputs,
            );
        }
        writer.gap();
        writer.line("/* What depends on parameters alone. */");
        writer.open("typedef struct {");
        for (name, formula) in self.prepared.iter().zip(&program.prepared) {
            writer.line(format!("/* {} */", comment_text(formula)));
            writer.line(format!("double {name};"));
        }
        if !program.prepare.guards.is_empty() || self.prepared.is_empty() {
            writer.line("/* 1 + the number of the coordinate that these parameters leave without inertia, or 0. */");
            writer.line("int singular;");
        }
        writer.close(&format!("}} {}_prepared;", self.prefix));
    }

    fn structure(&self, writer: &mut Writer, name: &str, docs: &str, slots: &[Slot]) {
        writer.gap();
        writer.line(format!("/* {docs} */"));
        writer.open("typedef struct {");
        let groups = fields(slots.iter().map(|slot| &slot.name));
        for (field, ident) in groups.iter().zip(field_names(&groups, slots)) {
            let slot = &slots[field.slots[0]];
            let mut docs = slot.docs.split_whitespace().collect::<Vec<_>>().join(" ");
            if !docs.is_empty() {
                docs.push(' ');
            }
            docs.push_str(&format!("Unit: {}.", slot.unit_text));
            if let Some(default) = &slot.default {
                docs.push_str(&format!(" Default: {}.", default.text));
            }
            comment(writer, &docs, &[]);
            let size = if field.is_family {
                format!("[{}]", field.slots.len())
            } else {
                String::new()
            };
            writer.line(format!("double {ident}{size};"));
        }
        if slots.is_empty() {
            writer.line("int none;");
        }
        writer.close(&format!("}} {}_{name};", self.prefix));
    }

    fn prepare(&self, writer: &mut Writer) {
        let function = &self.program.prepare;
        let prefix = &self.prefix;
        writer.gap();
        writer.line("/* Computes what depends on the parameters alone, once. */");
        let arguments = [
            format!("const {prefix}_parameters *self"),
            format!("{prefix}_prepared *p"),
        ];
        self.signature(writer, &format!("void {prefix}_prepare"), &arguments);
        if function.code.is_empty() {
            writer.line("(void)self;");
        }
        let mut with_guards = Function {
            guards: Vec::new(),
            ..function.clone()
        };
        with_guards.results.extend(
            function
                .guards
                .iter()
                .flat_map(|guard| [guard.pivot, guard.scale]),
        );
        let texts = self.statements(writer, &with_guards);
        for (name, text) in self.prepared.iter().zip(&texts) {
            writer.line(format!("p->{name} = {};", text.text));
        }
        if !function.guards.is_empty() || self.prepared.is_empty() {
            writer.line("p->singular = 0;");
        }
        // The first guard that fails is reported, so it is written last.
        let pairs = texts[self.prepared.len()..].chunks(2);
        for (guard, pair) in function
            .guards
            .iter()
            .zip(pairs)
            .collect::<Vec<_>>()
            .into_iter()
            .rev()
        {
            let condition = condition(guard, &pair[0].text, &pair[1].text);
            writer.open(format!("if ({condition}) {{"));
            writer.line(format!("p->singular = {};", guard.coordinate + 1));
            writer.close("}");
        }
        writer.close("}");
    }

    /// Whether the text contains a function: most functions whose results are all zero are left out.
    fn is_written(&self, function: &Function) -> bool {
        let is_zero =
            |value: &_| matches!(function.op(*value), Op::Constant(rational) if rational.is_zero());
        let keeps = function.role == Role::Start || function.role.is_kept();
        keeps || !function.results.iter().all(is_zero)
    }

    fn function(&self, writer: &mut Writer, function: &Function, formulas: Option<&Vec<String>>) {
        if !self.is_written(function) {
            return;
        }
        let name = format!("{}_{}", self.prefix, self.function_name(function.role));
        let cut = cut::cut(function, self.prepared.len(), cut::LONGEST_WHOLE);
        for (i, piece) in cut.iter().flat_map(|cut| &cut.pieces).enumerate() {
            self.piece(writer, &format!("{name}_{i}"), piece);
        }
        let mut reads = function.reads();
        reads.parameters |= function.role == Role::Start;
        let inverts = function.role.inverts();
        let checks_prepared = inverts && !self.program.prepare.guards.is_empty();
        reads.prepared |= checks_prepared;
        let mut arguments = self.declared(reads);
        let result = match function.shape {
            Shape::Scalar => "double",
            Shape::Vector(n) => {
                // C has no empty arrays, so a stage of time that leaves nothing has one element.
                arguments.push(format!("double to[{}]", n.max(1)));
                if inverts { "int" } else { "void" }
            }
            Shape::Symmetric(n) => {
                arguments.push(format!("double to[{n}][{n}]"));
                "void"
            }
            Shape::Matrix(rows, columns) => {
                arguments.push(format!("double to[{rows}][{columns}]"));
                if inverts { "int" } else { "void" }
            }
        };
        if arguments.is_empty() {
            arguments.push("void".into());
        }
        writer.gap();
        comment(
            writer,
            &self.docs(function.role),
            formulas.map_or(&[], Vec::as_slice),
        );
        self.signature(writer, &format!("{result} {name}"), &arguments);
        if function.role == Role::Start && !function.reads().parameters {
            writer.line("(void)self;");
        }
        if function.shape == Shape::Vector(0) {
            writer.line("(void)to;");
        }
        if checks_prepared {
            writer.open("if (p->singular) {");
            writer.line("return p->singular;");
            writer.close("}");
        }
        let texts = match &cut {
            Some(cut) => self.calls_of_pieces(writer, &name, cut),
            None => self
                .statements(writer, function)
                .into_iter()
                .map(|text| text.text)
                .collect(),
        };
        write_results(writer, function.shape, &texts, inverts);
        writer.close("}");
    }

    fn function_name(&self, role: Role) -> String {
        match role {
            Role::Output(i) => self.output_functions[i].clone(),
            role => role.name(),
        }
    }

    fn docs(&self, role: Role) -> String {
        let mut docs = self.program.docs(role).replace('`', "");
        match role {
            Role::Output(i) => {
                let unit = &self.program.outputs[i].unit_text;
                return format!("{docs} Unit: {unit}.").trim().to_owned();
            }
            Role::Derivatives => {
                let variables = self.program.derivatives.iter();
                let names: Vec<String> = variables
                    .map(|variable| self.program.variable_name(*variable))
                    .collect();
                let _ = write!(
                    docs,
                    " Column 0: the accelerations; the others: their derivatives by {}.",
                    names.join(", ")
                ); // writing to a String cannot fail
            }
            _ => {}
        }
        if role.inverts() {
            docs.push_str(if self.program.constraints.is_empty() {
" Returns 0, or 1 + the number of the coordinate whose pivot vanishes."
} else {
                    " Returns 0, or 1 + the number of the coordinate whose pivot vanishes; constraints are counted behind all \
                     coordinates."
                });
        }
        docs
    }

    /// The arguments that a function needs, and how they are passed on.
    fn arguments(&self, reads: Reads) -> Vec<(&'static str, String)> {
        let (prefix, n) = (&self.prefix, self.program.dimension());
        let all = [
            (
                reads.parameters,
                "self",
                format!("const {prefix}_parameters *self"),
            ),
            (reads.prepared, "p", format!("const {prefix}_prepared *p")),
            (
                reads.at_time || reads.at_position,
                "at",
                "const double *at".into(),
            ),
            (reads.time, "t", "double t".into()),
            (reads.coordinates, "q", format!("const double q[{n}]")),
            (reads.velocities, "v", format!("const double v[{n}]")),
            (reads.accelerations, "a", format!("const double a[{n}]")),
            (reads.inputs, "u", format!("const {prefix}_inputs *u")),
        ];
        let read = all.into_iter().filter(|(is_read, ..)| *is_read);
        read.map(|(_, name, declaration)| (name, declaration))
            .collect()
    }

    fn declared(&self, reads: Reads) -> Vec<String> {
        self.arguments(reads)
            .into_iter()
            .map(|(_, declaration)| declaration)
            .collect()
    }

    /// The arguments that a piece reads; values that it takes from `w` do not count as prepared values.
    fn reads_of_piece(&self, piece: &Piece) -> Reads {
        let mut reads = piece.function.reads();
        reads.prepared = piece.function.code.iter().any(
            |op| matches!(op, Op::Read(Source::Prepared(i)) if (*i as usize) < self.prepared.len()),
        );
        reads
    }

    /// Writes one piece of a function that is too long to be written whole.
    fn piece(&self, writer: &mut Writer, name: &str, piece: &Piece) {
        let fails = !piece.function.guards.is_empty();
        let mut arguments = self.declared(self.reads_of_piece(piece));
        arguments.push("double *w".into());
        writer.gap();
        let result = if fails { "int" } else { "void" };
        self.signature(writer, &format!("static {result} {name}"), &arguments);
        let texts = self.statements(writer, &piece.function);
        for (slot, text) in piece.result_slots.iter().zip(texts) {
            writer.line(format!("w[{slot}] = {};", text.text));
        }
        if fails {
            writer.line("return 0;");
        }
        writer.close("}");
    }

    /// Writes the body of a function in pieces; returns the texts of its results.
    fn calls_of_pieces(&self, writer: &mut Writer, name: &str, cut: &Cut) -> Vec<String> {
        writer.line(
            "/* Too long for one function: each piece leaves in w what those after it need. */",
        );
        writer.line(format!("double w[{}];", cut.slots));
        if cut
            .pieces
            .iter()
            .any(|piece| !piece.function.guards.is_empty())
        {
            writer.line("int singular;");
        }
        for (i, piece) in cut.pieces.iter().enumerate() {
            let arguments = self.arguments(self.reads_of_piece(piece));
            let mut passed: Vec<&str> = arguments.iter().map(|(name, _)| *name).collect();
            passed.push("w");
            let call = format!("{name}_{i}({})", passed.join(", "));
            if piece.function.guards.is_empty() {
                writer.line(format!("{call};"));
            } else {
                writer.line(format!("singular = {call};"));
                writer.open("if (singular) {");
                writer.line("return singular;");
                writer.close("}");
            }
        }
        let result = |place: &CutResult| match place {
            CutResult::Slot(slot) => format!("w[{slot}]"),
            CutResult::Leaf(Op::Constant(value)) => self.constant(value).text,
            CutResult::Leaf(Op::Read(source)) => match self.argument(*source) {
                Some(argument) => argument.text,
                None => self.variable(*source).1,
            },
            CutResult::Leaf(_) => self.pi().text,
        };
        cut.results.iter().map(result).collect()
    }

    fn signature(&self, writer: &mut Writer, head: &str, arguments: &[String]) {
        let line = format!("{head}({}) {{", arguments.join(", "));
        if width(&line) <= writer.columns() {
            return writer.open(line);
        }
        writer.line(format!("{head}("));
        for (i, argument) in arguments.iter().enumerate() {
            writer.line(format!(
                "    {argument}{}",
                if i + 1 < arguments.len() { "," } else { "" }
            ));
        }
        writer.open(") {");
    }

    fn statements(&self, writer: &mut Writer, function: &Function) -> Vec<Expression> {
        let scope = Scope::with(RESERVED);
        // Entries of a matrix are written twice, so they must be names. Those of vectors are written once.
        let names: Vec<String> = match function.shape {
            Shape::Symmetric(n) => (0..n)
                .flat_map(|i| (0..=i).map(move |j| format!("m{}_{}", i + 1, j + 1)))
                .collect(),
            _ => Vec::new(),
        };
        body::statements(writer, self, function, scope, &names)
    }
}

impl Language for Emitter<'_> {
    fn steps(&self, writer: &mut Writer, steps: &[EliminationStep]) {
        let text = self.program.text_of_steps(steps);
        writer.line(format!("/* {} */", comment_text(&text)));
    }

    fn constant(&self, value: &Rational) -> Expression {
        number(value.to_f64())
    }

    fn pi(&self) -> Expression {
        number(std::f64::consts::PI)
    }

    fn argument(&self, source: Source) -> Option<Expression> {
        Some(Expression::leaf(match source {
            Source::Parameter(i) => format!("self->{}", self.parameters[i as usize]),
            Source::Prepared(i) => match self.prepared.get(i as usize) {
                Some(name) => format!("p->{name}"),
                None => format!("w[{}]", i as usize - self.prepared.len()),
            },
            Source::Time => "t".to_owned(),
            Source::Input(i) => format!("u->{}", self.inputs[i as usize]),
            Source::AtTime(i) | Source::AtPosition(i) => format!("at[{i}]"),
            Source::Coordinate(_) | Source::Velocity(_) | Source::Acceleration(_) => return None,
        }))
    }

    fn variable(&self, source: Source) -> (String, String) {
        let name = |i: u32| ascii(&flat(&self.program.coordinates[i as usize].name));
        match source {
            Source::Coordinate(i) => (name(i), format!("q[{i}]")),
            Source::Velocity(i) => (format!("{}_dot", name(i)), format!("v[{i}]")),
            Source::Acceleration(i) => (format!("{}_ddot", name(i)), format!("a[{i}]")),
            // Other arguments are not variables.
            _ => ("argument".into(), "argument".into()),
        }
    }

    fn unary(&self, function: symbolic::Function, argument: &Expression) -> Expression {
        Expression::call(format!("{}({})", function_name(function), argument.text))
    }

    fn binary(&self, function: symbolic::Function, a: &Expression, b: &Expression) -> Expression {
        Expression::call(format!(
            "{}({}, {})",
            function_name(function),
            a.text,
            b.text
        ))
    }

    fn error(&self, of: Rounded, a: &Expression, b: &Expression) -> Expression {
        Expression::call(match of {
            Rounded::Product => {
                let product = [a, b]
                    .map(|factor| factor.at_least(Precedence::Sign))
                    .join(" * ");
                format!("fma({}, {}, -({product}))", a.text, b.text)
            }
            Rounded::Sum => format!("sum_error({}, {})", a.text, b.text),
        })
    }

    fn bind(&self, writer: &mut Writer, name: &str, value: &str) {
        writer.statement(&format!("const double {name} ="), &format!("{value};"));
    }

    fn sin_cos(
        &self,
        writer: &mut Writer,
        sin: Option<&str>,
        cos: Option<&str>,
        angle: &Expression,
    ) {
        for (name, function) in [(sin, "sin"), (cos, "cos")] {
            if let Some(name) = name {
                writer.line(format!("const double {name} = {function}({});", angle.text));
            }
        }
    }

    fn guard(&self, writer: &mut Writer, guard: &Guard, [pivot, scale]: [&str; 2]) {
        writer.open(format!("if ({}) {{", condition(guard, pivot, scale)));
        writer.line(format!("return {};", guard.coordinate + 1));
        writer.close("}");
    }

    fn constant_name(&self, _value: &Rational) -> Option<&'static str> {
        None
    }

    fn identifier(&self, scope: &mut Scope, name: &str) -> String {
        scope.take_plain(name)
    }
}

/// True where a pivot vanishes or is NaN.
fn condition(guard: &Guard, pivot: &str, scale: &str) -> String {
    let tolerance = number(guard.tolerance).text;
    // A scale that is a sum needs parentheses.
    if scale.contains(' ') {
        format!("!({pivot} > ({scale}) * {tolerance})")
    } else {
        format!("!({pivot} > {scale} * {tolerance})")
    }
}

fn number(x: f64) -> Expression {
    if x.is_nan() {
        return Expression::leaf("NAN");
    }
    let magnitude = if x.is_infinite() {
        "INFINITY".to_owned()
    } else {
        format!("{:?}", x.abs())
    };
    if x < 0.0 {
        Expression {
            text: format!("-{magnitude}"),
            precedence: Precedence::Sign,
            is_leaf: false,
        }
    } else {
        Expression::leaf(magnitude)
    }
}

fn function_name(function: symbolic::Function) -> &'static str {
    use symbolic::Function::*;
    match function {
        Ln => "log",
        Abs => "fabs",
        Min => "fmin",
        Max => "fmax",
        other => other.name(),
    }
}

fn comment(writer: &mut Writer, text: &str, formulas: &[String]) {
    let text = comment_text(text);
    if text.lines().count() == 1 && formulas.is_empty() && width(&text) + 6 <= writer.columns() {
        return writer.line(format!("/* {text} */"));
    }
    if text.is_empty() && formulas.is_empty() {
        return;
    }
    writer.line("/*");
    writer.comment(" *", &text);
    for formula in formulas {
        writer.formula(" *    ", &comment_text(formula));
    }
    writer.line(" */");
}

/// A text that cannot end the comment in which it is written.
fn comment_text(text: &str) -> String {
    text.replace("*/", "* /").replace("/*", "/ *")
}

/// The names of the fields of a struct, without duplicates.
fn field_names(groups: &[Field], slots: &[Slot]) -> Vec<String> {
    let mut scope = Scope::with(RESERVED);
    groups
        .iter()
        .map(|field| scope.take_plain(&ascii(slots[field.slots[0]].name.word())))
        .collect()
}

/// For each slot the path to its number in its struct.
fn paths(slots: &[Slot]) -> Vec<String> {
    let mut groups = fields(slots.iter().map(|slot| &slot.name));
    let names = field_names(&groups, slots);
    for (field, name) in groups.iter_mut().zip(names) {
        field.ident = name;
    }
    names::paths(&groups)
}

/// Writes where the results of a function go, and that it succeeds, if it may fail.
fn write_results(writer: &mut Writer, shape: Shape, texts: &[String], may_fail: bool) {
    match shape {
        Shape::Scalar => writer.line(format!("return {};", texts[0])),
        Shape::Vector(_) => {
            for (i, text) in texts.iter().enumerate() {
                writer.line(format!("to[{i}] = {text};"));
            }
            if may_fail {
                writer.line("return 0;");
            }
        }
        Shape::Symmetric(n) => {
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                writer.line(format!("to[{i}][{j}] = {};", texts[Shape::index(i, j)]));
            }
        }
        Shape::Matrix(_, columns) => {
            for (index, text) in texts.iter().enumerate() {
                let (i, j) = (index / columns, index % columns);
                writer.line(format!("to[{i}][{j}] = {text};"));
            }
            if may_fail {
                writer.line("return 0;");
            }
        }
    }
}
