//! What a library that is called from C holds of a machine: its parameters, what is prepared of them, and the
//! accelerations, with the numbers in a row as C passes them.

use std::fmt::Write as _;

use super::Emitter;
use super::language::number;
use super::types::{Group, Types, literal};
use crate::emit::layout::Layout;
use crate::emit::names::Field;
use crate::program::{Role, Slot};

impl Emitter<'_> {
    /// The content of the module: of the runtime it needs `Scalar`, `Number`, `Singular` and `scalar::Kernel` only.
    pub(super) fn library(mut self) -> String {
        for line in &self.options.origin {
            self.writer.comment("//", line);
        }
        self.writer
            .line("#![allow(dead_code, unused_variables, non_snake_case, non_camel_case_types)]");
        self.name_tables();
        let parameters = Group::new(&self.program.parameters);
        let Types {
            machine, scalar, ..
        } = self.types.clone();
        self.structure(&machine, "The parameters.", &parameters, false);
        self.writer.gap();
        let bound = format!("{scalar}: {}::Scalar", self.options.runtime);
        self.writer
            .open(format!("impl<{bound}> {machine}<{scalar}> {{"));
        self.prepare();
        self.writer.close("}");
        self.prepared();
        self.map_of_prepared();
        self.prepared_of_a_row(&parameters);
        let inputs = Group::new(&self.program.inputs);
        self.structure(&self.types.inputs.clone(), "The inputs.", &inputs, false);
        if let Some(function) = self.program.function(Role::Accelerations) {
            self.function(function);
            self.evaluate(&inputs);
        }
        self.helpers_of_guards();
        self.writer.finish()
    }

    /// Names, units and values of everything that has them.
    fn name_tables(&mut self) {
        let program = self.program;
        let tables = [
            ("COORDINATES", &program.coordinates),
            ("PARAMETERS", &program.parameters),
            ("INPUTS", &program.inputs),
        ];
        let f64 = self.types.known("f64");
        for (table, slots) in tables {
            let row = |slot: &Slot| {
                let default = slot.default.as_ref().map(|default| number(default.value));
                let default = default.unwrap_or_else(|| format!("{f64}::NAN"));
                Layout::Atom(format!(
                    "(c{:?}, c{:?}, {default})",
                    slot.name.to_string(),
                    slot.unit_text
                ))
            };
            self.writer.gap();
            self.docs("Names, units, and values where the description has them.");
            let head = format!(
                "pub const {table}: [(&::core::ffi::CStr, &::core::ffi::CStr, {f64}); {}] = ",
                slots.len()
            );
            self.writer
                .expression(&head, &Layout::nested(slots.iter().map(row)), ";");
        }
    }

    /// `map`: what is prepared, over other numbers.
    fn map_of_prepared(&mut self) {
        let Types {
            prepared, scalar, ..
        } = self.types.clone();
        let (copy, fn_trait) = (self.types.known("Copy"), self.types.known("Fn"));
        self.writer.gap();
        self.writer
            .open(format!("impl<{scalar}: {copy}> {prepared}<{scalar}> {{"));
        self.docs("The same over other numbers.");
        self.writer.signature(
            "pub fn map<R>",
            &["&self".into(), format!("f: impl {fn_trait}({scalar}) -> R")],
            Some(&format!("{prepared}<R>")),
        );
        let field = |field: Field| {
            let value = match field.is_family {
                true => format!("self.{}.map(&f)", field.ident),
                false => format!("f(self.{})", field.ident),
            };
            (field.ident, Layout::Atom(value))
        };
        let fields = self.prepared_fields().into_iter().map(field);
        let mut value = literal(&prepared, fields.collect());
        if let Layout::Struct(_, fields) = &mut value
            && !self.program.prepare.guards.is_empty()
        {
            fields.push(("singular".into(), Layout::Atom("self.singular".into())));
        }
        self.writer.expression("", &value, "");
        self.writer.close("}");
        self.writer.close("}");
    }

    /// `prepared`: of parameters in the order of the description.
    fn prepared_of_a_row(&mut self, parameters: &Group<'_>) {
        let f64 = self.types.known("f64");
        let Types {
            prepared, machine, ..
        } = self.types.clone();
        self.writer.gap();
        self.docs("What is prepared of parameters in the order of the description.");
        let row = format!("row: &[{f64}; {}]", self.program.parameters.len());
        self.writer.signature(
            "pub fn prepared",
            &[row],
            Some(&format!("{prepared}<{f64}>")),
        );
        let value = parameters.literal(&machine, |slot| format!("row[{slot}]"));
        self.writer.expression("let machine = ", &value, ";");
        self.writer.line("machine.prepare()");
        self.writer.close("}");
    }

    /// `evaluate`: the accelerations, whatever they need of all that a library is given; none at singular poses.
    fn evaluate(&mut self, inputs: &Group<'_>) {
        let Some(function) = self.program.function(Role::Accelerations) else {
            return;
        };
        let runtime = self.options.runtime.clone();
        let Types {
            prepared, scalar, ..
        } = self.types.clone();
        let (option, n) = (self.types.known("Option"), self.program.dimension());
        self.writer.gap();
        self.docs("The accelerations; none where the mass matrix is singular.");
        self.writer.line("#[inline(always)]");
        self.writer.signature(
            &format!("pub fn evaluate<{scalar}: {runtime}::Number>"),
            &[
                format!("p: &{prepared}<{scalar}>"),
                format!("t: {scalar}"),
                format!("q: &[{scalar}; {n}]"),
                format!("v: &[{scalar}; {n}]"),
                format!("row: &[{scalar}; {}]", self.program.inputs.len()),
            ],
            Some(&format!("{option}<[{scalar}; {n}]>")),
        );
        let needs = self.needs(function);
        if needs.inputs {
            let name = self.types.inputs.clone();
            let value = inputs.literal(&name, |slot| format!("row[{slot}]"));
            self.writer.expression("let u = ", &value, ";");
        }
        let mut arguments = String::new();
        for (i, (name, _)) in self.arguments(needs).iter().enumerate() {
            let separator = if i == 0 { "" } else { ", " };
            let reference = if *name == "u" { "&" } else { "" };
            let _ = write!(arguments, "{separator}{reference}{name}"); // writing to a String cannot fail
        }
        self.writer.line(format!("accelerations({arguments}).ok()"));
        self.writer.close("}");
    }
}
