//! The part of a machine for a library that is called from C: its parameters, the values prepared from them, and
//! the accelerations, with numbers in arrays as C passes them.

use super::kernel::FastFunction;
use super::language::number;
use super::types::{Group, Types, literal};
use super::{CONTACT_ROLES, Emitter, in_pairs};
use crate::body::Precedence;
use crate::layout::Layout;
use crate::names::Field;
use lagrangian_program::{Function, Role, Shape, Slot, Unilateral, early_angles};

impl Emitter<'_> {
    /// The content of the module. It uses only `Scalar`, `Number`, `Singular`, `Pivots`, `fast_function!` and
    /// `scalar::Piece` of the runtime.
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
            self.evaluate(function, &inputs);
        }
        if !self.program.unilateral.is_empty() {
            self.table_of_contacts();
            for role in CONTACT_ROLES {
                self.of_contacts(role);
            }
        }
        self.pivots();
        self.writer.finish()
    }

    /// Writes for each contact its name, its law, and how it depends on the contact before it.
    fn table_of_contacts(&mut self) {
        let contacts = &self.program.unilateral;
        let row = |contact: &Unilateral| {
            let law = match contact.compliance {
                Some(law) => law.name(),
                None => contact.law.name(),
            };
            let leans = match (contact.is_rolling_resistance, contact.is_second_tangent) {
                (true, _) => 1,
                (_, true) => 2,
                _ => 0,
            };
            Layout::Atom(format!("(c{:?}, c{law:?}, {leans})", contact.name))
        };
        self.writer.gap();
        self.docs("Names, laws, and how each leans on the one before it: 0 not at all, 1 as its rolling, 2 as its second tangent.");
        let head = format!(
            "pub const CONTACTS: [(&::core::ffi::CStr, &::core::ffi::CStr, ::core::ffi::c_int); {}] = ",
            contacts.len()
        );
        self.writer
            .expression(&head, &Layout::nested(contacts.iter().map(row)), ";");
    }

    /// Writes a function of the spec, and a wrapper that takes all arguments of a library and stores the
    /// results in an array.
    fn of_contacts(&mut self, role: Role) {
        let function = self.emitted(role);
        if let Some(function) = function {
            self.function(function);
        }
        let prepared = self.types.prepared.clone();
        let (f64, n) = (self.types.known("f64"), self.program.dimension());
        self.writer.gap();
        self.docs("The same, with its numbers where they go; 0 where the description has none.");
        self.writer.line("#[allow(unused_variables)]");
        self.writer.signature(
            &format!("pub fn {}_of", self.function_name(role)),
            &[
                format!("p: &{prepared}<{f64}>"),
                format!("t: {f64}"),
                format!("q: &[{f64}; {n}]"),
                format!("v: &[{f64}; {n}]"),
                format!("result: &mut [{f64}]"),
            ],
            None,
        );
        match function {
            None => self.writer.line("result.fill(0.0);"),
            Some(function) => {
                let arguments = self.arguments(self.needs(function));
                let passed: Vec<&str> = arguments.iter().map(|(name, _)| *name).collect();
                let call = format!("{}({})", self.function_name(role), passed.join(", "));
                let numbers = match function.shape {
                    Shape::Symmetric(_) => format!("{call}.as_flattened()"),
                    _ => format!("&{call}"),
                };
                self.writer
                    .line(format!("result.copy_from_slice({numbers});"));
            }
        }
        self.writer.close("}");
    }

    /// Writes names, units and values of everything that has them.
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

    /// Writes `map`: the prepared values for another type of number.
    fn map_of_prepared(&mut self) {
        let Types {
            prepared, scalar, ..
        } = self.types.clone();
        let (copy, fn_trait) = (self.types.known("Copy"), self.types.known("Fn"));
        self.writer.gap();
        self.writer
            .open(format!("impl<{scalar}: {copy}> {prepared}<{scalar}> {{"));
        self.docs("These values as other numbers.");
        self.writer.signature(
            "pub fn map<R>",
            &["&self".into(), format!("f: impl {fn_trait}({scalar}) -> R")],
            Some(&format!("{prepared}<R>")),
        );
        let field = |field: Field| {
            let value = if field.is_family {
                format!("self.{}.map(&f)", field.ident)
            } else {
                format!("f(self.{})", field.ident)
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

    /// Writes `prepared`: the prepared values from parameters in the order of the spec.
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

    /// Writes `evaluate`: the accelerations from all arguments of a library, used or not; false at singular poses.
    fn evaluate(&mut self, function: &Function, inputs: &Group<'_>) {
        let in_parts = self.is_in_parts(function);
        if in_parts {
            self.function(function);
        }
        let runtime = self.options.runtime.clone();
        let Types {
            prepared, scalar, ..
        } = self.types.clone();
        let (bool, n) = (self.types.known("bool"), self.program.dimension());
        self.writer.gap();
        self.docs("Puts the accelerations where they go, and says whether they hold.");
        self.docs("");
        self.docs(
            "They don't where the mass matrix is singular; nor may they where an angle of one of several lanes is so \
             large that it has to be evaluated alone. PackedOperation is in `result` then is of no use.",
        );
        self.writer.line("#[inline(always)]");
        self.writer.signature(
            &format!("pub fn evaluate<{scalar}: {runtime}::Number>"),
            &[
                format!("p: &{prepared}<{scalar}>"),
                format!("t: {scalar}"),
                format!("q: &[{scalar}; {n}]"),
                format!("v: &[{scalar}; {n}]"),
                format!("row: &[{scalar}; {}]", self.program.inputs.len()),
                format!("result: &mut [{scalar}; {n}]"),
            ],
            Some(&bool),
        );
        let needs = self.needs(function);
        if needs.inputs {
            let name = self.types.inputs.clone();
            let value = inputs.literal(&name, |slot| format!("row[{slot}]"));
            self.writer.expression("let u = ", &value, ";");
        }
        let mut arguments = Vec::new();
        for (name, _) in self.arguments(needs) {
            arguments.push(match name {
                "u" if in_parts => "&u",
                "u" => "u: &u",
                name => name,
            });
        }
        if in_parts {
            self.writer
                .open(format!("match accelerations({}) {{", arguments.join(", ")));
            self.writer.open("Ok(accelerations) => {");
            self.writer.line("*result = accelerations;");
            self.writer.line("true");
            self.writer.close("}");
            self.writer.line("Err(_) => false,");
            self.writer.close("}");
            return self.writer.close("}");
        }
        arguments.push("result");
        let fields = arguments.join(", ");
        self.writer
            .line(format!("{scalar}::run(InPlace {{ {fields} }})"));
        self.writer.close("}");
        self.in_place(function);
    }

    /// Writes the code of the accelerations as a single kernel that stores them in place.
    ///
    /// Nothing waits for a check: results are stored whether valid or not, then all conditions are tested at once, the
    /// size of the angles together with the pivots. So for compiler and processor this is straight-line code, and the
    /// failure path is in the caller, out of the way.
    fn in_place(&mut self, function: &Function) {
        let scalar = self.types.scalar.clone();
        let n = self.program.dimension();
        let arguments = self.arguments(self.needs(function)).into_iter();
        let result = ("result", format!("&mut [{scalar}; {n}]"));
        let fields = arguments.chain([result]);
        let fast = FastFunction {
            docs: "The accelerations, and where they go.".to_owned(),
            name: None,
            call: "InPlace".to_owned(),
            fields: fields.map(|(name, kind)| (name.to_owned(), kind)).collect(),
            result: self.types.known("bool"),
            code: "in_place".to_owned(),
        };
        self.fast_function(&fast);
        self.open_fast_function(&fast, true);
        let has_far = !early_angles(function).is_empty();
        self.defers_angle_check = true;
        let wanted = self.result_names(function);
        let packs = in_pairs(function, self.options);
        let body = self.unchecked(function, &wanted, packs.as_deref());
        self.defers_angle_check = false;
        for (i, text) in body.results.iter().enumerate() {
            let text = text.at_least(Precedence::Atom);
            self.writer.line(format!("result[{i}] = {text}.store();"));
        }
        let mut conditions = self.exceeding(function, &body);
        if has_far {
            conditions.insert(0, "are_near".into());
        }
        if self.may_be_singular_from_the_start(function) {
            conditions.insert(0, "p.singular.is_none()".into());
        }
        self.writer.line(if conditions.is_empty() {
            "true".into()
        } else {
            conditions.join(" & ")
        });
        self.writer.close("}");
    }
}
