//! The functions of a module: one for each role, or several if it is long.

use std::fmt::Write as _;

use super::Emitter;
use super::docs::slot_docs;
use super::language::Rust;
use super::types::Types;
use crate::body::{self, Expression as Text, Language, Unchecked};
use crate::cut::{self, Cut, CutResult, Piece};
use crate::layout::{Layout, Writer};
use crate::names::{Scope, flat};
use lagrangian_program::quantity::{Entry, Extent, ItemKind};
use lagrangian_program::{Function, Op, PackedStatement, Reads, Role, Shape, Source};

impl<'a> Emitter<'a> {
    /// Whether a function computes anything: one whose results are zero has no code; nor has one that [parts](Self::is_by_parts) replace.
    pub(super) fn is_emitted(&self, function: &Function) -> bool {
        if self.is_by_parts(function.role) {
            return false;
        }
        let is_zero =
            |value: &_| matches!(function.op(*value), Op::Constant(rational) if rational.is_zero());
        function.role.is_kept() || !function.results.iter().all(is_zero)
    }

    /// The function of a role, if it computes anything.
    pub(super) fn emitted(&self, role: Role) -> Option<&'a Function> {
        self.program
            .function(role)
            .filter(|function| self.is_emitted(function))
    }

    pub(super) fn function_name(&self, role: Role) -> String {
        match role {
            Role::Output(i) => self.output_functions[i].clone(),
            role => role.name(),
        }
    }

    /// The arguments that a function must be given.
    pub(super) fn needs(&self, function: &Function) -> Reads {
        let mut reads = function.reads();
        reads.prepared |= self.may_be_singular_from_the_start(function);
        reads
    }

    /// Whether a function must check if the parameters alone leave the machine without accelerations.
    pub(super) fn may_be_singular_from_the_start(&self, function: &Function) -> bool {
        self.fails(function) && !self.program.prepare.guards.is_empty()
    }

    /// These arguments with their types.
    pub(super) fn arguments(&self, needs: Reads) -> Vec<(&'static str, String)> {
        let Types {
            prepared,
            scalar,
            inputs,
            at_time,
            at_position,
            ..
        } = &self.types;
        let vector = format!("&[{scalar}; {}]", self.program.dimension());
        let all = [
            (needs.prepared, "p", format!("&{prepared}<{scalar}>")),
            (needs.at_time, "at", format!("&{at_time}<{scalar}>")),
            (needs.at_position, "at", format!("&{at_position}<{scalar}>")),
            (needs.time, "t", scalar.clone()),
            (needs.coordinates, "q", vector.clone()),
            (needs.velocities, "v", vector.clone()),
            (needs.accelerations, "a", vector),
            (needs.inputs, "u", format!("&{inputs}<{scalar}>")),
        ];
        let needed = all.into_iter().filter(|(is_needed, ..)| *is_needed);
        needed.map(|(_, name, kind)| (name, kind)).collect()
    }

    /// The arguments as a function declares them.
    fn declared(&self, needs: Reads) -> Vec<String> {
        self.arguments(needs)
            .iter()
            .map(|(name, kind)| format!("{name}: {kind}"))
            .collect()
    }

    /// Writes a function of the state.
    pub(super) fn function(&mut self, function: &Function) {
        if function.role.is_fast() {
            return self.kernel(function);
        }
        let runtime = self.options.runtime.clone();
        let scalar = self.types.scalar.clone();
        let name = self.function_name(function.role);
        self.writer.gap();
        self.docs(&self.function_docs(function));
        let head = format!("pub fn {name}<{scalar}: {runtime}::Scalar>");
        let arguments = self.declared(self.needs(function));
        let result = self.result_type(function);
        self.writer.signature(&head, &arguments, Some(&result));
        let cut = cut::cut(function, self.prepared.len(), self.options.longest_whole);
        let texts: Vec<String> = match &cut {
            Some(cut) => self.calls_of_pieces(function, cut),
            None => {
                let wanted = self.result_names(function);
                let texts = self.statements(function, &wanted, false);
                texts.into_iter().map(|text| text.text).collect()
            }
        };
        let value = self.arranged(function, &texts);
        self.writer.expression("", &value, "");
        self.writer.close("}");
        for (i, piece) in cut.iter().flat_map(|cut| &cut.pieces).enumerate() {
            let slots = cut.as_ref().map_or(0, |cut| cut.slots);
            self.piece(&format!("{name}_{i}"), piece, slots);
        }
    }

    /// The type of a function's result.
    pub(super) fn result_type(&self, function: &Function) -> String {
        let scalar = &self.types.scalar;
        if let Some(name) = self.stage_type(function.role) {
            return format!("{name}<{scalar}>");
        }
        match function.shape {
            Shape::Scalar => scalar.clone(),
            Shape::Vector(n) => format!("[{scalar}; {n}]"),
            Shape::Symmetric(n) => format!("[[{scalar}; {n}]; {n}]"),
            Shape::Matrix(..) => format!("{}<{scalar}>", self.types.derivatives),
        }
    }

    /// The results of a function in the arrangement of its type.
    pub(super) fn arranged(&self, function: &Function, texts: &[String]) -> Layout {
        let text = |i: usize| Layout::Atom(texts[i].clone());
        let shape = function.shape;
        if let Some(name) = self.stage_type(function.role) {
            let values = Layout::nested((0..shape.len()).map(text));
            return Layout::Struct(name.to_owned(), vec![("values".into(), values)]);
        }
        match shape {
            Shape::Scalar => text(0),
            Shape::Vector(n) => Layout::nested((0..n).map(text)),
            Shape::Symmetric(n) => {
                let row = |i: usize| Layout::nested((0..n).map(|j| text(Shape::index(i, j))));
                Layout::nested((0..n).map(row))
            }
            Shape::Matrix(..) => self.derivatives_literal(shape, texts),
        }
    }

    /// Writes the body of a function that is cut into pieces; returns the texts of its results.
    fn calls_of_pieces(&mut self, function: &Function, cut: &Cut) -> Vec<String> {
        let scalar = self.types.scalar.clone();
        let name = self.function_name(function.role);
        self.writer.comment(
            "//",
            "Too long for one function: each piece leaves in `w` what those after it need.",
        );
        self.writer
            .line(format!("let mut w = [{scalar}::ZERO; {}];", cut.slots));
        for (i, piece) in cut.pieces.iter().enumerate() {
            let arguments = self.arguments(self.needs_of_piece(piece));
            let mut passed: Vec<&str> = arguments.iter().map(|(name, _)| *name).collect();
            passed.push("&mut w");
            let fails = if piece.function.guards.is_empty() {
                ""
            } else {
                "?"
            };
            self.writer
                .line(format!("{name}_{i}({}){fails};", passed.join(", ")));
        }
        self.results_of_pieces(cut, false)
    }

    /// The texts of a function's results after its pieces have run.
    pub(super) fn results_of_pieces(&mut self, cut: &Cut, in_registers: bool) -> Vec<String> {
        let is_zero = |place: &CutResult| matches!(place, CutResult::Leaf(Op::Constant(value)) if value.is_zero());
        let rust = Rust {
            emitter: self,
            in_registers,
        };
        let result = |place: &CutResult| match place {
            place if is_zero(place) => "zero".to_owned(),
            CutResult::Slot(slot) => format!("w[{slot}]"),
            CutResult::Leaf(Op::Constant(value)) => rust.constant(value).text,
            CutResult::Leaf(Op::Read(source)) => match rust.argument(*source) {
                Some(argument) => argument.text,
                None => rust.variable(*source).1,
            },
            CutResult::Leaf(_) => rust.pi().text,
        };
        let results = cut.results.iter().map(result).collect();
        if cut.results.iter().any(is_zero) {
            let number = rust.number().to_owned();
            self.writer.line(format!("let zero = {number}::ZERO;"));
        }
        results
    }

    /// The arguments that a piece must be given; values that it reads from `w` do not count as prepared values.
    pub(super) fn needs_of_piece(&self, piece: &Piece) -> Reads {
        let is_prepared = |op: &Op| matches!(op, Op::Read(Source::Prepared(i)) if (*i as usize) < self.prepared.len());
        let mut reads = piece.function.reads();
        reads.prepared = piece.function.code.iter().any(is_prepared);
        reads
    }

    fn piece(&mut self, name: &str, piece: &Piece, slots: usize) {
        let scalar = self.types.scalar.clone();
        let runtime = &self.options.runtime;
        let result = format!("{}<(), {runtime}::Singular>", self.types.known("Result"));
        let fails = !piece.function.guards.is_empty();
        let head = format!("fn {name}<{scalar}: {runtime}::Scalar>");
        let mut arguments = self.declared(self.needs_of_piece(piece));
        arguments.push(format!("w: &mut [{scalar}; {slots}]"));
        self.writer.gap();
        self.writer.line("#[inline(never)]");
        self.writer
            .signature(&head, &arguments, fails.then_some(result.as_str()));
        let texts = self.statements(&piece.function, &[], false);
        for (slot, text) in piece.result_slots.iter().zip(texts) {
            self.writer.line(format!("w[{slot}] = {};", text.text));
        }
        if fails {
            self.writer.line("Ok(())");
        }
        self.writer.close("}");
    }

    /// The wanted names of a function's results; empty for a scalar.
    pub(super) fn result_names(&self, function: &Function) -> Vec<String> {
        let extent = function.role.row().extent;
        if extent == Extent::Number {
            return Vec::new();
        }
        // Entries of a matrix are named by their indices, from 1.
        let joined = |i: usize, j: usize, separator: &str| format!("{}{separator}{}", i + 1, j + 1);
        let separator = match extent {
            Extent::Symmetric(_) if function.shape.order() < 10 => "",
            _ => "_",
        };
        let name = |index: usize| {
            let entry = match self.program.entry(function.role, index) {
                Entry::Of(ItemKind::Coordinate, i) if extent != Extent::Differentials => {
                    flat(&self.program.coordinates[i].name)
                }
                Entry::Of(_, i) if extent != Extent::Differentials => (i + 1).to_string(),
                Entry::At((_, i), (_, j)) => joined(i, j, separator),
                _ => match function.shape {
                    Shape::Matrix(_, columns) => {
                        format!("{}_{}", index / columns + 1, index % columns)
                    }
                    _ => index.to_string(),
                },
            };
            function.role.row().code.replace('*', &entry)
        };
        (0..function.shape.len()).map(name).collect()
    }

    pub(super) fn function_docs(&self, function: &Function) -> String {
        let mut docs = match function.role {
            Role::Output(i) => {
                let slot = &self.program.outputs[i];
                slot_docs(&slot.name, slot, false).trim().to_owned()
            }
            role => self.program.docs(role),
        };
        if self.fails(function) {
            docs.push_str("\n\nA pivot that vanishes is an error.");
        }
        if let Some(formulas) = self.program.formulas_of_steps(&function.steps) {
            let _ = write!(docs, "\n\n{formulas}"); // writing to a String cannot fail
        }
        if let Some(formulas) = self
            .options
            .formulas
            .get(&function.role)
            .filter(|formulas| !formulas.is_empty())
        {
            let _ = write!(docs, "\n\n```text\n{}\n```", formulas.join("\n")); // writing to a String cannot fail
        }
        docs
    }

    /// Writes the statements of a function, computed in registers or on numbers as stored.
    pub(super) fn statements(
        &mut self,
        function: &Function,
        wanted: &[String],
        in_registers: bool,
    ) -> Vec<Text> {
        self.in_scope(in_registers, |writer, language, scope| {
            body::statements(writer, language, function, scope, wanted)
        })
    }

    /// Writes the statements of a function in registers, without its checks of pivots.
    pub(super) fn unchecked(
        &mut self,
        function: &Function,
        wanted: &[String],
        packs: Option<&[PackedStatement]>,
    ) -> Unchecked {
        self.in_scope(true, |writer, language, scope| {
            body::unchecked(writer, language, function, scope, wanted, packs)
        })
    }

    /// Writes statements in a scope in which the fixed names of a function are taken.
    fn in_scope<T>(
        &mut self,
        in_registers: bool,
        write: impl FnOnce(&mut Writer, &Rust<'_>, Scope) -> T,
    ) -> T {
        let mut writer = std::mem::take(&mut self.writer);
        let language = Rust {
            emitter: self,
            in_registers,
        };
        let results = write(&mut writer, &language, self.scope());
        self.writer = writer;
        results
    }

    /// The fixed names of a function.
    pub(super) fn scope(&self) -> Scope {
        Scope::with(&[
            "p", "t", "q", "v", "a", "at", "u", "f", "w", "n", "angles", "circular", "singular",
            "sound", "are_near", "result", "pivots", "PIVOTS", "None", "Some", "Ok", "Err",
        ])
    }

    /// The call of a function from a method of the prepared values.
    pub(super) fn call_with(&self, name: &str, needs: Reads) -> String {
        let arguments = self.arguments(needs);
        let passed: Vec<&str> = arguments
            .iter()
            .map(|(name, _)| if *name == "p" { "self" } else { name })
            .collect();
        format!("{name}({})", passed.join(", "))
    }

    /// The arguments that the outputs together need.
    pub(super) fn needs_of_outputs(&self) -> Reads {
        let functions =
            (0..self.program.outputs.len()).filter_map(|i| self.program.function(Role::Output(i)));
        functions
            .map(|function| self.needs(function))
            .fold(Reads::default(), union)
    }

    /// Writes the function for all outputs.
    pub(super) fn all_outputs(&mut self) {
        let Types {
            outputs, scalar, ..
        } = self.types.clone();
        let call = |slot: usize| {
            let role = Role::Output(slot);
            let needs = self
                .program
                .function(role)
                .map(|function| self.needs(function));
            let arguments = self.arguments(needs.unwrap_or_default());
            let passed: Vec<&str> = arguments.iter().map(|(name, _)| *name).collect();
            format!("{}({})", self.function_name(role), passed.join(", "))
        };
        let literal = self.outputs.literal(&outputs, call);
        let arguments = self.declared(self.needs_of_outputs());
        let head = format!("pub fn outputs<{scalar}: {}::Scalar>", self.options.runtime);
        self.writer.gap();
        self.docs("Everything that the description asks to observe.");
        self.writer
            .signature(&head, &arguments, Some(&format!("{outputs}<{scalar}>")));
        self.writer.expression("", &literal, "");
        self.writer.close("}");
    }
}

/// What at least one of two functions reads.
pub(super) fn union(a: Reads, b: Reads) -> Reads {
    Reads {
        parameters: a.parameters || b.parameters,
        prepared: a.prepared || b.prepared,
        time: a.time || b.time,
        coordinates: a.coordinates || b.coordinates,
        velocities: a.velocities || b.velocities,
        inputs: a.inputs || b.inputs,
        accelerations: a.accelerations || b.accelerations,
        at_time: a.at_time || b.at_time,
        at_position: a.at_position || b.at_position,
    }
}
