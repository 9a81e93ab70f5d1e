//! `Machine` and `System` for `f64`, on top of the functions.

use super::Emitter;
use super::types::Types;
use crate::layout::{Layout, Writer};
use lagrangian_program::quantity::{Extent, Kind, Needs};
use lagrangian_program::{Fact, Function, Reads, Role, Slot};

impl Emitter<'_> {
    /// Names and units.
    pub(super) fn tables(&mut self) {
        let str = self.types.known("str");
        for (table, slots) in [
            ("PARAMETERS", &self.program.parameters),
            ("COORDINATES", &self.program.coordinates),
            ("INPUTS", &self.program.inputs),
            ("OUTPUTS", &self.program.outputs),
        ] {
            let row = |slot: &Slot| {
                let items = [slot.name.to_string(), slot.unit_text.clone()];
                Layout::List(
                    "(".into(),
                    items
                        .iter()
                        .map(|item| Layout::Atom(format!("{item:?}")))
                        .collect(),
                    ")",
                )
            };
            self.writer.gap();
            self.writer.line("/// Names and units.");
            let head = format!("const {table}: [(&{str}, &{str}); {}] = ", slots.len());
            self.writer
                .expression(&head, &Layout::nested(slots.iter().map(row)), ";");
        }
    }

    /// A method of a trait. Arguments that its body does not name are `_`.
    pub(super) fn method(
        &mut self,
        method: &str,
        arguments: &[&str],
        result: Option<&str>,
        body: impl FnOnce(&mut Writer),
    ) {
        let mut inner = Writer::indented(8);
        body(&mut inner);
        let inner = inner.finish();
        // What stands between quotes, the text of a fact, uses nothing; no quote stands in it.
        let words: Vec<&str> = inner
            .split('"')
            .step_by(2)
            .flat_map(|code| code.split(|c: char| !c.is_alphanumeric() && c != '_'))
            .collect();
        let is_used = |name: &str| words.contains(&name);
        let mut list = vec!["&self".to_owned()];
        list.extend(arguments.iter().map(|&name| {
            let shown = if is_used(name) { name } else { "_" };
            format!("{shown}: {}", self.kind(method, name))
        }));
        self.writer.gap();
        self.writer
            .signature(&format!("fn {method}"), &list, result);
        self.writer.raw(&inner);
        self.writer.close("}");
    }

    /// The type of an argument of a method.
    fn kind(&self, name: &str, argument: &str) -> String {
        let Types {
            coordinates,
            inputs,
            outputs,
            ..
        } = &self.types;
        let f64 = self.types.known("f64");
        let n = self.program.dimension();
        match argument {
            "t" if name == "series" => format!("[{f64}; 2]"),
            "t" => f64,
            "coefficients" => format!("&mut [[{f64}; {n}]]"),
            "u" | "inputs" => format!("&{inputs}"),
            "outputs" => format!("&{outputs}"),
            "coordinates" => format!("&{coordinates}"),
            "matrix" => format!("&mut [{f64}; {}]", n * n),
            "result" => format!("&mut [{f64}; {n}]"),
            "ranges" => format!("&mut [[{f64}; 2]]"),
            "to" => format!("&mut [{f64}]"),
            _ => format!("&[{f64}; {n}]"),
        }
    }

    /// The call of a function from a method of `System`, where it does anything.
    pub(super) fn call(&self, role: Role) -> Option<String> {
        let function = self.emitted(role)?;
        Some(self.call_with(&self.function_name(role), self.needs(function)))
    }

    pub(super) fn call_with(&self, name: &str, needs: Reads) -> String {
        let arguments = self.arguments(needs);
        let passed: Vec<&str> = arguments
            .iter()
            .map(|(name, _)| if *name == "p" { "self" } else { name })
            .collect();
        format!("{name}({})", passed.join(", "))
    }

    pub(super) fn impl_machine(&mut self) {
        let runtime = self.options.runtime.clone();
        let Types {
            machine,
            prepared,
            coordinates,
            ..
        } = self.types.clone();
        let str = format!("&{}", self.types.known("str"));
        let name = format!("{:?}", self.program.name);
        let values = Layout::array(
            self.parameters
                .paths
                .iter()
                .map(|path| format!("self.{path}")),
        );
        let quantities = self.quantities_type();
        self.writer.gap();
        self.writer
            .open(format!("impl {runtime}::Machine for {machine} {{"));
        self.writer.line(format!("type System = {prepared};"));
        self.method("name", &[], Some(&str), |body| body.line(name));
        self.method("parameters", &[], Some(&quantities), |body| {
            body.expression("let values = ", &values, ";");
            body.line("quantities(&PARAMETERS, values)");
        });
        self.parameter_mut();
        self.method("prepare", &[], Some(&prepared), |body| {
            body.line("Self::prepare(self)")
        });
        let state = format!("{runtime}::State<{coordinates}>");
        self.method("start", &[], Some(&state), |body| {
            body.line("Self::start(self)")
        });
        self.writer.close("}");
    }

    /// The parameters by number, where there are any.
    fn parameter_mut(&mut self) {
        if self.parameters.is_empty() {
            return;
        }
        let [usize, f64, option] = ["usize", "f64", "Option"].map(|name| self.types.known(name));
        let mut arms = Vec::new();
        for field in &self.parameters.fields {
            let in_a_row = field.slots.windows(2).all(|pair| pair[1] == pair[0] + 1);
            match (field.is_family, field.slots.as_slice()) {
                (true, [first, .., last]) if in_a_row => arms.push((
                    *first,
                    format!(
                        "{first}..={last} => self.{}.get_mut(index - {first}),",
                        field.ident
                    ),
                )),
                (is_family, slots) => {
                    arms.extend(slots.iter().enumerate().map(|(member, slot)| {
                        let member = match is_family {
                            true => format!("[{member}]"),
                            false => String::new(),
                        };
                        (
                            *slot,
                            format!("{slot} => Some(&mut self.{}{member}),", field.ident),
                        )
                    }))
                }
            }
        }
        arms.sort();
        self.writer.gap();
        self.writer.open(format!(
            "fn parameter_mut(&mut self, index: {usize}) -> {option}<&mut {f64}> {{"
        ));
        self.writer.open("match index {");
        for (_, arm) in arms {
            self.writer.line(arm);
        }
        self.writer.line("_ => None,");
        self.writer.close("}");
        self.writer.close("}");
    }

    fn quantities_type(&self) -> String {
        let iterator = self.types.known("ExactSizeIterator");
        let f64 = self.types.known("f64");
        format!(
            "impl {iterator}<Item = ({}::Quantity<'_>, {f64})>",
            self.options.runtime
        )
    }

    pub(super) fn impl_system(&mut self) {
        let runtime = self.options.runtime.clone();
        let Types {
            prepared,
            coordinates,
            inputs,
            outputs,
            ..
        } = self.types.clone();
        let f64 = self.types.known("f64");
        let n = self.program.dimension();
        let vector = format!("[{f64}; {n}]");
        self.writer.gap();
        self.writer
            .open(format!("impl {runtime}::System for {prepared} {{"));
        self.writer.line(format!("type Vector = {vector};"));
        self.writer
            .line(format!("type Matrix = [{f64}; {}];", n * n));
        self.writer
            .line(format!("type Coordinates = {coordinates};"));
        self.writer.line(format!("type Inputs = {inputs};"));
        self.writer.line(format!("type Outputs = {outputs};"));
        let absent = [
            ("MAY_BE_CONSTRAINED", self.program.constraints.is_empty()),
            ("MAY_SLIDE", self.program.contacts.is_empty()),
            ("MAY_COLLIDE", self.program.unilateral.is_empty()),
        ];
        for (what, _) in absent.iter().filter(|(_, is_absent)| *is_absent) {
            self.writer.line(format!(
                "const {what}: {} = false;",
                self.types.known("bool")
            ));
        }

        let quantities = format!(
            "impl {}<Item = {runtime}::Quantity<'_>>",
            self.types.known("ExactSizeIterator")
        );
        self.method("coordinates", &[], Some(&quantities), |body| {
            body.line("COORDINATES.iter().map(quantity)");
        });
        self.method("to_coordinates", &["vector"], Some(&coordinates), |body| {
            body.line(format!("{coordinates}::from_array(*vector)"));
        });
        self.method("to_vector", &["coordinates"], Some(&vector), |body| {
            body.line("coordinates.to_array()");
        });
        self.accelerations();
        self.methods_of_series();
        self.quantities();
        self.inputs_and_outputs();
        self.assumptions();
        self.constraints();
        self.contacts();
        self.unilateral_contacts();
        self.kept_at_start();
        self.workspace();
        self.writer.close("}");
    }

    fn accelerations(&mut self) {
        let n = self.program.dimension();
        let result = format!(
            "{}<(), {}::Singular>",
            self.types.known("Result"),
            self.options.runtime
        );
        let f64 = self.types.known("f64");
        let call = match self.program.contacts.is_empty() {
            true => self.accelerations_in_place(&f64, "self"),
            false => {
                let own = format!("{}::accelerations_with_friction", self.options.runtime);
                Some(vec![format!("{own}(self, t, q, v, u, result)")])
            }
        };
        self.method(
            "accelerations",
            &["t", "q", "v", "u", "result"],
            Some(&result),
            |body| match call {
                Some(call) => call.into_iter().for_each(|line| body.line(line)),
                None => {
                    body.line(format!("*result = [0.0; {n}];"));
                    body.line("Ok(())");
                }
            },
        );
    }

    /// A method for each row of the table that this machine has, and that solves for nothing.
    fn quantities(&mut self) {
        let sizes = self.program.sizes();
        let is_method = |role: &Role| {
            let needs = role.row().needs;
            needs != Needs::Request && needs.are_met(sizes) && !role.inverts()
        };
        let f64 = self.types.known("f64");
        for role in Role::all().filter(is_method) {
            let (row, call) = (role.row(), self.call(role));
            let Some(shape) = row.extent.shape(sizes) else {
                continue;
            };
            let mut arguments: Vec<&str> = row.of.iter().map(|of| of.letter()).collect();
            let lines = match (row.extent, call) {
                (Extent::Number, call) => vec![call.unwrap_or_else(|| "0.0".into())],
                (Extent::Symmetric(_), Some(call)) => vec![
                    format!("let rows = {call};"),
                    "for (to, from) in matrix.iter_mut().zip(rows.as_flattened()) {".into(),
                    "    *to = *from;".into(),
                    "}".into(),
                ],
                (Extent::Symmetric(_), None) => {
                    vec![format!("*matrix = [0.0; {}];", shape.order().pow(2))]
                }
                (Extent::Each(Kind::Coordinate), call) => {
                    let value = call.unwrap_or_else(|| format!("[0.0; {}]", shape.len()));
                    vec![format!("*result = {value};")]
                }
                (_, Some(call)) => vec![format!("fill(to, &{call});")],
                (_, None) => vec!["to.fill(0.0);".into()],
            };
            let result = match row.extent {
                Extent::Number => Some(f64.as_str()),
                Extent::Symmetric(_) => {
                    arguments.push("matrix");
                    None
                }
                Extent::Each(Kind::Coordinate) => {
                    arguments.push("result");
                    None
                }
                _ => {
                    arguments.push("to");
                    None
                }
            };
            self.method(row.name, &arguments, result, |body| {
                lines.into_iter().for_each(|line| body.line(line));
            });
        }
    }

    fn inputs_and_outputs(&mut self) {
        let Types {
            inputs, outputs, ..
        } = self.types.clone();
        self.method("default_inputs", &[], Some(&inputs), |body| {
            body.line(format!("{inputs}::default()"));
        });
        let quantities = self.quantities_type();
        for (argument, method, table, paths) in [
            (
                "inputs",
                "input_values",
                "INPUTS",
                self.inputs.paths.clone(),
            ),
            (
                "outputs",
                "output_values",
                "OUTPUTS",
                self.outputs.paths.clone(),
            ),
        ] {
            let values = Layout::array(paths.iter().map(|path| format!("{argument}.{path}")));
            self.method(method, &[argument], Some(&quantities), |body| {
                body.expression("let values = ", &values, ";");
                body.line(format!("quantities(&{table}, values)"));
            });
        }
        let value = match self.outputs.is_empty() {
            true => format!("{outputs} {{}}"),
            false => self.call_with("outputs", self.needs_of_outputs()),
        };
        self.method(
            "outputs",
            &["t", "q", "v", "a", "u"],
            Some(&outputs),
            |body| body.line(value),
        );
    }

    fn assumptions(&mut self) {
        let iterator = self.types.known("ExactSizeIterator");
        let result = format!(
            "impl {iterator}<Item = {}::Assumption<'_>>",
            self.options.runtime
        );
        let row = |(i, fact): (usize, &Fact)| {
            let margin = self
                .call(Role::Assumption(i))
                .unwrap_or_else(|| "0.0".to_owned());
            let items = [format!("{:?}", fact.text), fact.strict.to_string(), margin];
            Layout::List("assumption(".into(), items.map(Layout::Atom).to_vec(), ")")
        };
        let facts: Vec<Layout> = self
            .program
            .assumptions
            .iter()
            .enumerate()
            .map(row)
            .collect();
        self.method(
            "assumptions",
            &["t", "q", "v", "u"],
            Some(&result),
            |body| {
                if facts.is_empty() {
                    body.line("::core::iter::empty()");
                } else {
                    body.expression("let facts = ", &Layout::nested(facts), ";");
                    body.line("facts.into_iter()");
                }
            },
        );
    }

    /// Small functions that the code above calls.
    pub(super) fn helpers(&mut self) {
        let runtime = self.options.runtime.clone();
        let str = self.types.known("str");
        let f64 = self.types.known("f64");
        let usize = self.types.known("usize");
        let bool = self.types.known("bool");
        let iterator = self.types.known("ExactSizeIterator");
        let quantity = format!("{runtime}::Quantity<'a>");
        self.writer.gap();
        self.writer.line("/// A name with its unit.");
        self.writer.signature(
            "fn quantity<'a>",
            &[format!("&(name, unit): &'a (&'a {str}, &'a {str})")],
            Some(&quantity),
        );
        self.writer
            .line(format!("{runtime}::Quantity {{ name, unit }}"));
        self.writer.close("}");
        self.writer.gap();
        self.writer.line("/// Names and units beside values.");
        self.writer.signature(
            &format!("fn quantities<'a, const N: {usize}>"),
            &[
                format!("names: &'a [(&'a {str}, &'a {str}); N]"),
                format!("values: [{f64}; N]"),
            ],
            Some(&format!("impl {iterator}<Item = ({quantity}, {f64})>")),
        );
        self.writer.line("names.iter().map(quantity).zip(values)");
        self.writer.close("}");
        if !self.program.assumptions.is_empty() {
            self.writer.gap();
            self.writer.line("/// A fact and by how much it holds.");
            self.writer.signature(
                "fn assumption",
                &[
                    format!("text: &{str}"),
                    format!("strict: {bool}"),
                    format!("margin: {f64}"),
                ],
                Some(&format!("{runtime}::Assumption<'_>")),
            );
            let fields = ["text", "margin", "strict"]
                .map(|name| (name.to_owned(), Layout::Atom(name.to_owned())));
            let literal = Layout::Struct(format!("{runtime}::Assumption"), fields.to_vec());
            self.writer.expression("", &literal, "");
            self.writer.close("}");
        }
        self.helpers_of_constraints();
        self.helper_of_filling();
        self.helpers_of_guards();
    }

    /// The checks of pivots, as far as there are any.
    pub(super) fn helpers_of_guards(&mut self) {
        let is_guarded = |function: &Function| !function.guards.is_empty();
        let is_for_speed = |function: &&Function| function.role.is_fast();
        let (fast, others): (Vec<_>, Vec<_>) = self
            .program
            .all_functions()
            .filter(|function| is_guarded(function))
            .partition(is_for_speed);
        if !fast.is_empty() {
            self.helper_of_checks();
        }
        if !others.is_empty() {
            self.helper_of_vanishing();
        }
        if !fast.is_empty() || !others.is_empty() {
            self.helper_of_singular();
        }
    }

    /// The check of a pivot in registers.
    fn helper_of_checks(&mut self) {
        let runtime = self.options.runtime.clone();
        let register = self.types.register.clone();
        let result = self.types.known("Result");
        self.writer.gap();
        self.docs(
            "Refuses a pivot of which elimination has left nothing but rounding errors of a diagonal element, in any of \
             several lanes.",
        );
        self.writer.line("#[inline(always)]");
        self.writer.signature(
            &format!("fn check<{register}: {runtime}::Scalar>"),
            &[
                format!("pivot: {register}"),
                format!("diagonal: {register}"),
                format!("share: {}", self.types.known("f64")),
                format!("coordinate: {}", self.types.known("usize")),
            ],
            Some(&format!("{result}<(), {runtime}::Singular>")),
        );
        self.writer.line(format!(
            "let bound = {register}::from_f64(share) * diagonal;"
        ));
        self.writer.open("match pivot.exceeds(bound) {");
        self.writer.line("true => Ok(()),");
        self.writer
            .line("false => Err(singular(coordinate, pivot, diagonal)),");
        self.writer.close("}");
        self.writer.close("}");
    }

    /// The check of a pivot of the parameters.
    fn helper_of_vanishing(&mut self) {
        let runtime = self.options.runtime.clone();
        let scalar = self.types.scalar.clone();
        let f64 = self.types.known("f64");
        let bool = self.types.known("bool");
        self.writer.gap();
        self.docs(
            "Whether elimination has left nothing but rounding errors of a diagonal element; so too if it is no number.",
        );
        self.writer.signature(
            &format!("fn vanishes<{scalar}: {runtime}::Scalar>"),
            &[
                format!("pivot: {scalar}"),
                format!("diagonal: {scalar}"),
                format!("share: {f64}"),
            ],
            Some(&bool),
        );
        self.writer
            .line(format!("let bound = {scalar}::from_f64(share) * diagonal;"));
        self.writer.line("!pivot.exceeds(bound)");
        self.writer.close("}");
    }

    /// What an error says of a pivot.
    fn helper_of_singular(&mut self) {
        let runtime = self.options.runtime.clone();
        let scalar = self.types.scalar.clone();
        let usize = self.types.known("usize");
        self.writer.gap();
        self.writer
            .line("/// The share of a pivot that is no rounding, for the message.");
        self.writer.line("#[cold]");
        self.writer.signature(
            &format!("fn singular<{scalar}: {runtime}::Scalar>"),
            &[
                format!("coordinate: {usize}"),
                format!("pivot: {scalar}"),
                format!("diagonal: {scalar}"),
            ],
            Some(&format!("{runtime}::Singular")),
        );
        let coordinates = self.program.dimension();
        self.writer
            .line("let [pivot, diagonal] = [pivot, diagonal].map(|x| x.to_f64());");
        if !self.program.constraints.is_empty() {
            self.writer.open(format!(
                "if let Some(constraint) = coordinate.checked_sub({coordinates}) {{"
            ));
            self.writer.line(format!(
                "return {runtime}::Singular::constraint(constraint, pivot, diagonal);"
            ));
            self.writer.close("}");
        }
        self.writer.line(format!(
            "{runtime}::Singular::new(coordinate, pivot, diagonal)"
        ));
        self.writer.close("}");
    }
}
