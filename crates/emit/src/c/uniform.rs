//! The same file of C, and behind it one set of functions whose names and arguments are those of every machine, for code that
//! is written once and knows no machine; and the derivatives of accelerations and outputs in one direction.
//!
//! Their names begin with `unit` and have no underscore, so none is a name of the file before them, which all have one.

use std::collections::BTreeMap;

use lagrangian_mechanics::Proved;
use lagrangian_program::{Function, Op, Program, Reads, Role, Slot, Source};
use lagrangian_symbolic::Function as Named;

use super::{Emitter, function_name, number};
use crate::body::{Expression, Language};
use crate::layout::Writer;

/// Beyond so many operations there are no derivatives: the compiler of C would need minutes for them.
pub const MOST_OPERATIONS: usize = 20_000;

/// Whether the file has derivatives in a direction.
pub fn has_derivatives(program: &Program) -> bool {
    let differentiated = differentiated(program);
    let operations: usize = differentiated.map(|function| function.code.len()).sum();
    operations <= MOST_OPERATIONS
}

/// What is differentiated.
fn differentiated(program: &Program) -> impl Iterator<Item = &Function> {
    let is_wanted =
        |role: Role| matches!(role, Role::Prepare | Role::Accelerations | Role::Output(_));
    let functions = program.all_functions();
    functions.filter(move |function| is_wanted(function.role))
}

/// The text of the file. `origin` are lines for its head, `formulas` those that the comments show.
pub fn file(program: &Proved, origin: &[String], formulas: &BTreeMap<Role, Vec<String>>) -> String {
    let emitter = Emitter::new(program);
    let mut writer = Writer::default();
    emitter.head(&mut writer, origin);
    emitter.types(&mut writer);
    emitter.prepare(&mut writer);
    for function in [&program.start].into_iter().chain(&program.functions) {
        emitter.function(&mut writer, function, formulas.get(&function.role));
    }
    emitter.sizes(&mut writer);
    emitter.uniform(&mut writer);
    let has_derivatives = has_derivatives(program);
    if has_derivatives {
        emitter.derivatives(&mut writer);
    }
    writer.gap();
    writer.line("/* What prepared values, accelerations and outputs change by along parameters, coordinates, rates, inputs. */");
    writer.open(format!(
        "static void unitAlong(const double *x, {ARGUMENTS}, const double *a, const double *dx, const double *dq, \
         const double *dv, const double *du, double *dp, double *da, double *dy) {{"
    ));
    writer.line("(void)x, (void)p, (void)t, (void)q, (void)v, (void)u, (void)a, (void)dx, (void)dq, (void)dv, (void)du;");
    writer.line("(void)dp, (void)da, (void)dy;");
    if has_derivatives {
        writer.line("unitPrepareAlong(x, dx, dp);");
        if program.function(Role::Accelerations).is_some() {
            writer.line("unitAccelerationsAlong(p, t, q, v, u, a, dp, dq, dv, du, da, da);");
        }
        writer.line("unitOutputsAlong(p, t, q, v, u, a, dp, dq, dv, du, da, dy);");
    }
    writer.close("}");
    writer.finish()
}

/// The arguments of every function but those of parameters alone.
const ARGUMENTS: &str =
    "const UnitPrepared *p, double t, const double *q, const double *v, const double *u";

impl Emitter<'_> {
    fn sizes(&self, writer: &mut Writer) {
        let program = self.program;
        writer.gap();
        writer.line("/* How many there are of each. */");
        writer.open("enum {");
        for (name, count) in [
            ("COORDINATES", program.coordinates.len()),
            ("PARAMETERS", program.parameters.len()),
            ("INPUTS", program.inputs.len()),
            ("OUTPUTS", program.outputs.len()),
            ("FACTS", program.assumptions.len()),
            ("PREPARED", program.prepare.results.len()),
            ("HAS_DERIVATIVES", usize::from(has_derivatives(program))),
        ] {
            writer.line(format!("{name} = {count},"));
        }
        writer.close("};");
        writer.gap();
        writer.line(format!("typedef {}_prepared UnitPrepared;", self.prefix));
    }

    /// A struct of the machine from an array, where a function reads it.
    fn filled(
        &self,
        writer: &mut Writer,
        what: &str,
        slots: &[Slot],
        paths: &[String],
        from: &str,
    ) {
        writer.line(format!("{}_{what} of_{what};", self.prefix));
        for (i, path) in paths.iter().enumerate() {
            writer.line(format!("of_{what}.{path} = {from}[{i}];"));
        }
        if slots.is_empty() {
            writer.line(format!("of_{what}.none = 0;"));
        }
    }

    /// The call of a function by the arguments that all machines have; `result` are those behind what it reads.
    fn call(&self, reads: Reads, role: Role, result: &[&str]) -> String {
        let passed = self
            .arguments(reads)
            .into_iter()
            .map(|(name, _)| match name {
                "self" => "&of_parameters",
                "u" => "&of_inputs",
                name => name,
            });
        let passed: Vec<&str> = passed.chain(result.iter().copied()).collect();
        let name = self.function_name(role);
        format!("{}_{name}({})", self.prefix, passed.join(", "))
    }

    /// What a function reads, as its signature has it.
    fn read_by(&self, function: &Function) -> Reads {
        let mut reads = function.reads();
        reads.parameters |= function.role == Role::Start;
        let checks = function.role.inverts() && !self.program.prepare.guards.is_empty();
        reads.prepared |= checks;
        reads
    }

    fn uniform(&self, writer: &mut Writer) {
        let program = self.program;
        writer.gap();
        writer.line("/* What depends on the parameters x alone. */");
        writer.open("static void unitPrepare(const double *x, UnitPrepared *p) {");
        self.filled(
            writer,
            "parameters",
            &program.parameters,
            &self.parameters,
            "x",
        );
        writer.line("(void)x;");
        writer.line(format!("{}_prepare(&of_parameters, p);", self.prefix));
        writer.close("}");
        writer.gap();
        writer.line("/* Coordinates and their rates at the start. */");
        writer.open("static void unitStart(const double *x, double *to) {");
        let given = program.start.results.len();
        for i in given..2 * program.dimension() {
            writer.line(format!("to[{i}] = 0.0;"));
        }
        self.filled(
            writer,
            "parameters",
            &program.parameters,
            &self.parameters,
            "x",
        );
        writer.line("(void)x;");
        writer.line(format!("{}_start(&of_parameters, to);", self.prefix));
        writer.close("}");
        writer.gap();
        writer.line("/* 0, or 1 + the number of the coordinate whose pivot vanishes. */");
        writer.open(format!(
            "static int unitAccelerations({ARGUMENTS}, double *to) {{"
        ));
        match program.function(Role::Accelerations) {
            Some(function) => {
                let reads = self.read_by(function);
                self.unread(writer, reads, &[]);
                if reads.inputs {
                    self.filled(writer, "inputs", &program.inputs, &self.inputs, "u");
                }
                let call = self.call(reads, Role::Accelerations, &["to"]);
                writer.line(format!("return {call};"));
            }
            None => {
                self.unread(writer, Reads::default(), &["to"]);
                writer.line("return 0;");
            }
        }
        writer.close("}");
        for (name, role) in [
            ("unitKineticEnergy", Role::KineticEnergy),
            ("unitPotentialEnergy", Role::PotentialEnergy),
        ] {
            writer.gap();
            writer.line("/* In J. */");
            writer.open(format!("static double {name}({ARGUMENTS}) {{"));
            let function = program.function(role).filter(|f| self.is_written(f));
            match function {
                Some(function) => {
                    let reads = self.read_by(function);
                    self.unread(writer, reads, &[]);
                    if reads.inputs {
                        self.filled(writer, "inputs", &program.inputs, &self.inputs, "u");
                    }
                    writer.line(format!("return {};", self.call(reads, role, &[])));
                }
                None => {
                    self.unread(writer, Reads::default(), &[]);
                    writer.line("return 0.0;");
                }
            }
            writer.close("}");
        }
        self.numbered(
            writer,
            ("unitOutputs", ", const double *a, double *to"),
            program.outputs.len(),
            Role::Output,
        );
        self.numbered(
            writer,
            ("unitFacts", ", const double *a, double *to"),
            program.assumptions.len(),
            Role::Assumption,
        );
    }

    /// One function for all of a list of numbers.
    fn numbered(
        &self,
        writer: &mut Writer,
        (name, further): (&str, &str),
        count: usize,
        role: fn(usize) -> Role,
    ) {
        let program = self.program;
        writer.gap();
        writer.open(format!("static void {name}({ARGUMENTS}{further}) {{"));
        let functions =
            (0..count).map(|i| program.function(role(i)).filter(|f| self.is_written(f)));
        let functions: Vec<Option<&Function>> = functions.collect();
        let reads_inputs = functions
            .iter()
            .flatten()
            .any(|function| function.reads().inputs);
        self.unread(writer, Reads::default(), &["a", "to"]);
        if reads_inputs {
            self.filled(writer, "inputs", &program.inputs, &self.inputs, "u");
        }
        for (i, function) in functions.into_iter().enumerate() {
            let value = match function {
                Some(function) => self.call(self.read_by(function), role(i), &[]),
                None => "0.0".to_owned(),
            };
            writer.line(format!("to[{i}] = {value};"));
        }
        writer.close("}");
    }

    /// Arguments that nobody reads are no mistake.
    fn unread(&self, writer: &mut Writer, reads: Reads, further: &[&str]) {
        let all = [
            ("p", reads.prepared),
            ("t", reads.time),
            ("q", reads.coordinates),
            ("v", reads.velocities),
            ("u", reads.inputs),
        ];
        let unread = all.into_iter().filter(|(_, is_read)| !is_read);
        let names = unread.map(|(name, _)| name).chain(further.iter().copied());
        for name in names {
            writer.line(format!("(void){name};"));
        }
    }

    /// Derivatives in the direction (dx, dq, dv, du) of parameters, coordinates, rates and inputs.
    fn derivatives(&self, writer: &mut Writer) {
        let program = self.program;
        writer.gap();
        writer
            .line("/* What the prepared values change by where the parameters x change by dx. */");
        writer
            .open("static void unitPrepareAlong(const double *x, const double *dx, double *to) {");
        self.filled(
            writer,
            "parameters",
            &program.parameters,
            &self.parameters,
            "x",
        );
        writer.line(format!(
            "const {}_parameters *const self = &of_parameters;",
            self.prefix
        ));
        writer.line("(void)self, (void)dx, (void)to, (void)x;");
        self.along(writer, &program.prepare);
        writer.close("}");
        for function in differentiated(program).filter(|f| f.role != Role::Prepare) {
            let name = match function.role {
                Role::Output(i) => format!("unitOutput{i}Along"),
                _ => "unitAccelerationsAlong".to_owned(),
            };
            writer.gap();
            writer.open(format!(
                "static void {name}({ARGUMENTS}, const double *a, const double *dp, const double *dq, const double *dv, \
                 const double *du, const double *da, double *to) {{"
            ));
            if !program.inputs.is_empty() {
                self.filled(writer, "inputs", &program.inputs, &self.inputs, "u");
            }
            writer.line("(void)p, (void)t, (void)q, (void)v, (void)u, (void)a, (void)dp, (void)dq, (void)dv, (void)du;");
            writer.line("(void)da, (void)to;");
            self.along(writer, function);
            writer.close("}");
        }
        writer.gap();
        writer.open(format!(
            "static void unitOutputsAlong({ARGUMENTS}, const double *a, const double *dp, const double *dq, const double *dv, \
             const double *du, const double *da, double *to) {{"
        ));
        writer.line("(void)p, (void)t, (void)q, (void)v, (void)u, (void)a, (void)dp, (void)dq, (void)dv, (void)du;");
        writer.line("(void)da, (void)to;");
        for i in 0..program.outputs.len() {
            writer.line(match program.function(Role::Output(i)) {
                Some(_) => {
                    format!("unitOutput{i}Along(p, t, q, v, u, a, dp, dq, dv, du, da, to + {i});")
                }
                None => format!("to[{i}] = 0.0;"),
            });
        }
        writer.close("}");
    }

    /// The values `x…` of a function, beside those that change their derivatives `d…`, and those of its results in `to`.
    fn along(&self, writer: &mut Writer, function: &Function) {
        // What of each operation changes.
        let mut changes: Vec<bool> = Vec::with_capacity(function.code.len());
        for (k, op) in function.code.iter().enumerate() {
            let (value, derivative) = self.operation(op, &changes);
            // All are written: the compiler leaves out what nobody needs.
            writer.line(format!("const double x{k} = {value}; (void)x{k};"));
            changes.push(derivative.is_some());
            if let Some(derivative) = derivative {
                let derivative = derivative.replace("$", &format!("x{k}"));
                writer.line(format!("const double d{k} = {derivative}; (void)d{k};"));
            }
        }
        for (i, result) in function.results.iter().enumerate() {
            let k = result.index();
            writer.line(match changes[k] {
                true => format!("to[{i}] = d{k};"),
                false => format!("to[{i}] = 0.0;"),
            });
        }
    }

    /// The value of an operation, and its derivative if it changes; in the latter, `$` is the value.
    fn operation(&self, op: &Op, changes: &[bool]) -> (String, Option<String>) {
        let x = |value: &lagrangian_program::Value| format!("x{}", value.index());
        let d = |value: &lagrangian_program::Value| {
            changes[value.index()].then(|| format!("d{}", value.index()))
        };
        // factor·d, where the operand changes.
        let times = |factor: String, value| d(value).map(|d| format!("({factor}) * {d}"));
        let sum = |a: Option<String>, b: Option<String>| match (a, b) {
            (Some(a), Some(b)) => Some(format!("{a} + {b}")),
            (a, b) => a.or(b),
        };
        match op {
            Op::Constant(value) => (self.constant(value).text, None),
            Op::Pi => (self.pi().text, None),
            Op::Read(source) => self.read(*source),
            Op::Add(a, b) => (format!("{} + {}", x(a), x(b)), sum(d(a), d(b))),
            Op::Sub(a, b) => {
                let minus = d(b).map(|d| format!("-{d}"));
                (format!("{} - {}", x(a), x(b)), sum(d(a), minus))
            }
            Op::Mul(a, b) => (
                format!("{} * {}", x(a), x(b)),
                sum(times(x(b), a), times(x(a), b)),
            ),
            Op::Div(a, b) => (
                format!("{} / {}", x(a), x(b)),
                sum(
                    times(format!("1.0 / {}", x(b)), a),
                    times(format!("-$ / {}", x(b)), b),
                ),
            ),
            Op::Neg(a) => (format!("-{}", x(a)), d(a).map(|d| format!("-{d}"))),
            // What rounding took is no function of anything.
            Op::ProductError(a, b) => (format!("fma({0}, {1}, -({0} * {1}))", x(a), x(b)), None),
            Op::SumError(a, b) => (format!("sum_error({}, {})", x(a), x(b)), None),
            Op::Sin(a) => (format!("sin({})", x(a)), times(format!("cos({})", x(a)), a)),
            Op::Cos(a) => (
                format!("cos({})", x(a)),
                times(format!("-sin({})", x(a)), a),
            ),
            Op::Unary(function, a) => {
                let value = format!("{}({})", function_name(*function), x(a));
                (value, times(slope(*function, &x(a)), a))
            }
            Op::Binary(function, a, b) => {
                let (xa, xb) = (x(a), x(b));
                let value = format!("{}({xa}, {xb})", function_name(*function));
                let (by_a, by_b) = slopes(*function, &xa, &xb);
                (value, sum(times(by_a, a), times(by_b, b)))
            }
        }
    }

    fn read(&self, source: Source) -> (String, Option<String>) {
        let text = |expression: Option<Expression>| expression.map_or_else(String::new, |e| e.text);
        match source {
            Source::Parameter(i) => (text(self.argument(source)), Some(format!("dx[{i}]"))),
            Source::Prepared(i) => (text(self.argument(source)), Some(format!("dp[{i}]"))),
            Source::Input(i) => (
                format!("of_inputs.{}", self.inputs[i as usize]),
                Some(format!("du[{i}]")),
            ),
            Source::Coordinate(i) => (format!("q[{i}]"), Some(format!("dq[{i}]"))),
            Source::Velocity(i) => (format!("v[{i}]"), Some(format!("dv[{i}]"))),
            Source::Acceleration(i) => (format!("a[{i}]"), Some(format!("da[{i}]"))),
            Source::Time => ("t".to_owned(), None),
            // Functions in parts are not differentiated.
            Source::AtTime(i) | Source::AtPosition(i) => (format!("at[{i}]"), None),
        }
    }
}

/// The derivative of a function at `x`; `$` is its value there.
fn slope(function: Named, x: &str) -> String {
    use Named::*;
    match function {
        Sin => format!("cos({x})"),
        Cos => format!("-sin({x})"),
        Tan => "1.0 + $ * $".to_owned(),
        Asin => format!("1.0 / sqrt((1.0 - {x}) * (1.0 + {x}))"),
        Acos => format!("-1.0 / sqrt((1.0 - {x}) * (1.0 + {x}))"),
        Atan => format!("1.0 / (1.0 + {x} * {x})"),
        Sinh => format!("cosh({x})"),
        Cosh => format!("sinh({x})"),
        Tanh => "1.0 - $ * $".to_owned(),
        Exp => "$".to_owned(),
        Ln => format!("1.0 / {x}"),
        Sqrt => "0.5 / $".to_owned(),
        Abs => format!("({x} > 0.0) - ({x} < 0.0)"),
        // Constant on either side.
        Sign => number(0.0).text,
        // Of two arguments.
        Atan2 | Min | Max | Pow => "NAN".to_owned(),
    }
}

/// The derivatives of a function of two arguments; `$` is its value there.
fn slopes(function: Named, a: &str, b: &str) -> (String, String) {
    use Named::*;
    match function {
        Atan2 => (
            format!("{b} / ({a} * {a} + {b} * {b})"),
            format!("-{a} / ({a} * {a} + {b} * {b})"),
        ),
        Min => (
            format!("{a} <= {b} ? 1.0 : 0.0"),
            format!("{a} <= {b} ? 0.0 : 1.0"),
        ),
        Max => (
            format!("{a} >= {b} ? 1.0 : 0.0"),
            format!("{a} >= {b} ? 0.0 : 1.0"),
        ),
        Pow => (
            format!("{b} * pow({a}, {b} - 1.0)"),
            format!("$ * log({a})"),
        ),
        _ => ("NAN".to_owned(), "NAN".to_owned()),
    }
}
