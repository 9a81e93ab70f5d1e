//! The functions that integrators call: computed in registers, with the best instructions of the processor.
//!
//! ```text
//! accelerations(p, t, q, v, u)        picks the arithmetic for numbers kept as S
//!   Accelerations { p, t, q, v, u }   the call as a value: a Kernel
//!     accelerations_in::<S, N>(call)  the code, on numbers N in registers, always inlined
//! ```
//!
//! The first two are written by a macro of the runtime, `fast_function!`, whose call states the arguments and the result.
//!
//! A function that is too long for this is cut into pieces, each a value of its own.

use super::Emitter;
use super::language::Rust;
use super::types::Types;
use crate::body::{self, Plan, Precedence, Unchecked};
use crate::cut::{self, Cut, Piece};
use crate::layout::{Layout, width};
use lagrangian_program::{Function, Guard, Op, Reads, Role, Shape, Source};

/// A fast function: the arguments of the macro of the runtime that writes it.
pub(super) struct FastFunction {
    /// The documentation of the public function, or of the call.
    pub(super) docs: String,
    /// The public function, if there is one.
    pub(super) name: Option<String>,
    /// The type of its call.
    pub(super) call: String,
    /// The arguments with their types.
    pub(super) fields: Vec<(String, String)>,
    /// The type of the result.
    pub(super) result: String,
    /// The function that holds its code.
    pub(super) code: String,
}

impl Emitter<'_> {
    /// The names of the type of a call, and of its pieces.
    pub(super) fn names(&self, role: Role) -> [String; 2] {
        self.types.calls.get(&role).cloned().unwrap_or_default()
    }

    /// Writes a function that is called often.
    pub(super) fn kernel(&mut self, function: &Function) {
        let (plan, cut) = self.parts(function);
        let name = self.function_name(function.role);
        let [call, _] = self.names(function.role);
        let fields: Vec<(String, String)> = self
            .arguments(self.needs(function))
            .into_iter()
            .map(|(name, kind)| (name.to_owned(), kind))
            .collect();
        let fast = FastFunction {
            docs: self.function_docs(function),
            name: Some(name.clone()),
            code: format!("{name}_in"),
            result: self.returned(function),
            call,
            fields,
        };
        self.fast_function(&fast);
        self.open_fast_function(&fast, self.loads(function));
        self.run(function, plan.as_ref(), cut.as_ref());
        if let Some(cut) = &cut {
            self.pieces(function.role, cut);
        }
    }

    /// Writes the call of the macro that makes a function for speed from its code.
    pub(super) fn fast_function(&mut self, fast: &FastFunction) {
        let scalar = self.types.scalar.clone();
        let FastFunction {
            docs,
            name,
            call,
            fields,
            result,
            code,
        } = fast;
        self.writer.gap();
        self.writer
            .open(format!("{}::fast_function! {{", self.options.runtime));
        self.docs(docs);
        let lifetime = lifetime(fields);
        let (head, end) = match name {
            Some(name) => (format!("pub fn {name}<{lifetime}{scalar}>({call}"), ")"),
            None => (format!("pub struct {call}<{lifetime}{scalar}>"), ""),
        };
        let fields = fields
            .iter()
            .map(|(field, kind)| format!("{field}: {}", with_lifetime(kind)));
        let fields: Vec<String> = fields.collect();
        let result = format!("-> {result} = {code};");
        if fields.is_empty() {
            self.writer.statement(&format!("{head}{end}"), &result);
            return self.writer.close("}");
        }
        let given = format!("{head} {{ {} }}{end}", fields.join(", "));
        if width(&given) <= self.writer.columns() {
            self.writer.statement(&given, &result);
        } else {
            self.writer.open(format!("{head} {{"));
            for field in fields {
                self.writer.line(format!("{field},"));
            }
            self.writer.close(&format!("}}{end} {result}"));
        }
        self.writer.close("}");
    }

    /// Begins the code of a function for speed: writes names for its arguments and, if it reads stored numbers, `n`, which loads
    /// one.
    pub(super) fn open_fast_function(&mut self, fast: &FastFunction, loads: bool) {
        let runtime = self.options.runtime.clone();
        let Types {
            scalar, register, ..
        } = self.types.clone();
        let copy = self.types.known("Copy");
        let FastFunction {
            call,
            fields,
            result,
            code,
            ..
        } = fast;
        let anonymous = match lifetime(fields) {
            "" => "",
            _ => "'_, ",
        };
        let name = if fields.is_empty() { "_" } else { "call" };
        self.writer.gap();
        self.writer.line("#[inline(always)]");
        self.writer.signature(
            &format!(
                "fn {code}<{scalar}: {copy}, {register}: {runtime}::Scalar<Stored = {scalar}>>"
            ),
            &[format!("{name}: {call}<{anonymous}{scalar}>")],
            Some(result),
        );
        if !fields.is_empty() {
            let names = fields
                .iter()
                .map(|(name, _)| (name.clone(), Layout::Atom(name.clone())));
            let names = Layout::Struct(call.clone(), names.collect());
            self.writer.expression("let ", &names, " = call;");
        }
        if loads {
            self.writer.line(format!("let n = {register}::load;"));
        }
    }

    /// How a function is written: with loops, in pieces, or neither.
    fn parts(&self, function: &Function) -> (Option<Plan>, Option<Cut>) {
        let longest = self.options.longest_whole;
        let plan = self
            .plans
            .get(&function.role)
            .filter(|plan| plan.len() <= longest);
        match plan {
            Some(plan) => (Some(plan.clone()), None),
            None => (None, cut::cut(function, self.prepared.len(), longest)),
        }
    }

    /// Whether a function is written with loops or in pieces.
    pub(super) fn is_in_parts(&self, function: &Function) -> bool {
        !matches!(self.parts(function), (None, None))
    }

    /// Writes the code after the names of the arguments.
    fn run(&mut self, function: &Function, plan: Option<&Plan>, cut: Option<&Cut>) {
        if self.may_be_singular_from_the_start(function) {
            self.writer.open("if let Some(singular) = p.singular {");
            self.writer.line("return Err(singular);");
            self.writer.close("}");
        }
        if let Some(plan) = plan {
            self.run_loops(function, plan);
            return self.writer.close("}");
        }
        let texts: Vec<String> = match cut {
            Some(cut) => {
                self.run_pieces(function.role, cut);
                self.results_of_pieces(cut, true)
            }
            None => {
                let wanted = self.result_names(function);
                let body = self.unchecked(function, &wanted, None);
                let texts = body.results.iter();
                let texts: Vec<String> =
                    texts.map(|text| text.at_least(Precedence::Atom)).collect();
                self.checks(function, &body, &texts);
                texts
            }
        };
        let name = self.stored_results(function, &texts);
        self.writer.line(if self.fails(function) {
            format!("Ok({name})")
        } else {
            name
        });
        self.writer.close("}");
    }

    /// Writes the code with repeated parts as loops.
    fn run_loops(&mut self, function: &Function, plan: &Plan) {
        let mut writer = std::mem::take(&mut self.writer);
        let rust = Rust {
            emitter: self,
            in_registers: true,
        };
        let mut scope = self.scope();
        let name = self.function_name(function.role);
        let name = scope.take(&name);
        let results =
            body::statements_with_loops(&mut writer, &rust, function, scope.clone(), plan);
        let (texts, places): (Vec<_>, Vec<_>) = results.into_iter().unzip();
        let texts: Vec<String> = texts.into_iter().map(|text| text.text).collect();
        match function.shape {
            Shape::Vector(_) => {
                let runs = body::runs(&places);
                let stored = |text: &str| format!("{text}.store()");
                body::fill(
                    &mut writer,
                    &rust,
                    &name,
                    &runs,
                    &texts,
                    &stored,
                    &mut scope,
                );
                writer.line(format!("Ok({name})"));
            }
            _ => {
                let stored: Vec<String> =
                    texts.iter().map(|text| format!("{text}.store()")).collect();
                let value = self.arranged(function, &stored);
                writer.expression(&format!("let {name} = "), &value, ";");
                writer.line(format!("Ok({name})"));
            }
        }
        self.writer = writer;
    }

    /// Checks all pivots after everything has been computed.
    ///
    /// A compiler moves code that is not needed where a check fails to after the check. With a check inside the
    /// code, one recursion along a chain would therefore wait until the one before it, with the pivots, has
    /// finished. So there is a single check, which also waits for the result that is computed last.
    fn checks(&mut self, function: &Function, body: &Unchecked, results: &[String]) {
        if body.guards.is_empty() {
            return;
        }
        let mut conditions = self.exceeding(function, body);
        conditions.push(format!("{}.is_finite()", results[body.latest]));
        // The layout of rustfmt, which generated code must have: on one line, on the next line, or on one line each.
        let value = format!("{};", conditions.join(" & "));
        let fits = |line: &str| width(line) <= self.writer.columns();
        let [whole, next] = [format!("let sound = {value}"), format!("    {value}")];
        if fits(&whole) {
            self.writer.line(whole);
        } else if fits(&next) {
            self.writer.line("let sound =");
            self.writer.line(next);
        } else {
            for (place, condition) in conditions.iter().enumerate() {
                let before = if place == 0 { "let sound = " } else { "    & " };
                let after = if place + 1 == conditions.len() {
                    ";"
                } else {
                    ""
                };
                self.writer.line(format!("{before}{condition}{after}"));
            }
        }
        self.writer.open("if !sound {");
        for (constant, pivots) in self.lists_of_pivots(function, &body.guards) {
            self.writer.expression("let pivots = ", &pivots, ";");
            self.writer.line(format!("{constant}.check(pivots)?;"));
        }
        self.writer.close("}");
    }

    /// The conditions that pivots must meet.
    pub(super) fn exceeding(&self, function: &Function, body: &Unchecked) -> Vec<String> {
        let exceeds = |(guard, [pivot, scale]): (&Guard, &[String; 2])| {
            format!("{}.hold({pivot}, {scale})", self.pivots_of(guard))
        };
        let guards = function.guards.iter().zip(&body.guards);
        guards.map(exceeds).collect()
    }

    /// Converts the results to their stored form; returns the name of the variable.
    fn stored_results(&mut self, function: &Function, results: &[String]) -> String {
        let name = self.function_name(function.role);
        let stored: Vec<String> = results
            .iter()
            .map(|text| format!("{text}.store()"))
            .collect();
        let value = self.arranged(function, &stored);
        self.writer
            .expression(&format!("let {name} = "), &value, ";");
        name
    }

    /// Whether the code of a function reads stored numbers.
    fn loads(&self, function: &Function) -> bool {
        let slots = self.prepared.len();
        function.code.iter().any(|op| match op {
            Op::Read(Source::Prepared(i)) => (*i as usize) < slots,
            Op::Read(_) => true,
            _ => false,
        })
    }

    /// The type of the returned value.
    fn returned(&self, function: &Function) -> String {
        let result = self.result_type(function);
        if self.fails(function) {
            self.fallible(&result)
        } else {
            result
        }
    }

    /// The type of a result that does not exist where the mass matrix is singular.
    fn fallible(&self, result: &str) -> String {
        let runtime = &self.options.runtime;
        format!(
            "{}<{result}, {runtime}::Singular>",
            self.types.known("Result")
        )
    }

    /// Writes the calls of the pieces, one after the other.
    fn run_pieces(&mut self, role: Role, cut: &Cut) {
        let register = self.types.register.clone();
        let [_, name] = self.names(role);
        self.writer.comment(
            "//",
            "Too long for one function: each piece leaves in `w` what those after it need.",
        );
        self.writer
            .line(format!("let mut w = [{register}::ZERO; {}];", cut.slots));
        for (i, piece) in cut.pieces.iter().enumerate() {
            let mut fields: Vec<&str> = self
                .fields_of_pieces(cut)
                .iter()
                .map(|(name, _)| *name)
                .collect();
            fields.push("w: &mut w");
            let fails = if piece.function.guards.is_empty() {
                ""
            } else {
                "?"
            };
            self.writer.line(format!(
                "{register}::call({name}::<{register}, {i}> {{ {} }}){fails};",
                fields.join(", ")
            ));
        }
    }

    /// The arguments of all pieces except `w`: what at least one of them reads.
    fn fields_of_pieces(&self, cut: &Cut) -> Vec<(&'static str, String)> {
        let reads = cut.pieces.iter().map(|piece| self.needs_of_piece(piece));
        let all = reads.fold(Reads::default(), super::functions::union);
        self.arguments(all)
    }

    fn pieces(&mut self, role: Role, cut: &Cut) {
        let runtime = self.options.runtime.clone();
        let Types {
            scalar, register, ..
        } = self.types.clone();
        let [_, name] = self.names(role);
        let usize = self.types.known("usize");
        let stored = |kind: &str| {
            with_lifetime(kind)
                .replace(&format!("<{scalar}>"), &format!("<{register}::Stored>"))
                .replace(&format!("[{scalar};"), &format!("[{register}::Stored;"))
        };
        self.writer.gap();
        self.docs(&format!(
            "What the pieces of [`{}`] are given.",
            self.function_name(role)
        ));
        self.writer.open(format!(
            "struct {name}<'a, {register}: {runtime}::Scalar, const PIECE: {usize}> {{"
        ));
        for (field, kind) in self.fields_of_pieces(cut) {
            let kind = if kind == scalar {
                format!("{register}::Stored")
            } else {
                stored(&kind)
            };
            self.writer.line(format!("{field}: {kind},"));
        }
        self.writer
            .line(format!("w: &'a mut [{register}; {}],", cut.slots));
        self.writer.close("}");
        for (i, piece) in cut.pieces.iter().enumerate() {
            self.kernel_piece(role, i, piece, cut);
        }
    }

    fn kernel_piece(&mut self, role: Role, i: usize, piece: &Piece, cut: &Cut) {
        let runtime = self.options.runtime.clone();
        let register = self.types.register.clone();
        let [_, name] = self.names(role);
        let fails = !piece.function.guards.is_empty();
        let output = if fails {
            self.fallible("()")
        } else {
            "()".to_owned()
        };
        self.writer.gap();
        self.writer.open(format!(
            "impl<{register}: {runtime}::Scalar> {runtime}::scalar::Piece for {name}<'_, {register}, {i}> {{"
        ));
        self.writer.line(format!("type Output = {output};"));
        self.writer.gap();
        self.writer.line("#[inline(always)]");
        let result = fails.then_some("Self::Output");
        self.writer
            .signature("fn run", &["self".to_owned()], result);
        let needed: Vec<&str> = self
            .arguments(self.needs_of_piece(piece))
            .iter()
            .map(|(name, _)| *name)
            .collect();
        let all = self.fields_of_pieces(cut).len();
        let rest = if needed.len() < all { ", .." } else { "" };
        let names: Vec<&str> = needed.into_iter().chain(["w"]).collect();
        self.writer
            .line(format!("let Self {{ {}{rest} }} = self;", names.join(", ")));
        if self.loads(&piece.function) {
            self.writer.line(format!("let n = {register}::load;"));
        }
        let texts = self.statements(&piece.function, &[], true);
        for (slot, text) in piece.result_slots.iter().zip(texts) {
            self.writer.line(format!("w[{slot}] = {};", text.text));
        }
        if fails {
            self.writer.line("Ok(())");
        }
        self.writer.close("}");
        self.writer.close("}");
    }
}

/// `'a, ` if any argument is a reference.
fn lifetime(arguments: &[(String, String)]) -> &'static str {
    if arguments.iter().any(|(_, kind)| kind.starts_with('&')) {
        "'a, "
    } else {
        ""
    }
}

/// `&'a [S; 2]` for `&[S; 2]`.
fn with_lifetime(kind: &str) -> String {
    match kind.strip_prefix('&') {
        Some(kind) => format!("&'a {kind}"),
        None => kind.to_owned(),
    }
}
