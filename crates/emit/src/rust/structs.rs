//! The structs of a module: parameters, coordinates, inputs, outputs, prepared values.

use super::docs::{field_docs, prose};
use super::language::number;
use super::types::{Group, Types};
use super::{Emitter, MARK};
use crate::layout::Layout;
use crate::names::{Field, flat};
use lagrangian_program::Function;

impl Emitter<'_> {
    /// Writes a struct whose fields are named numbers.
    pub(super) fn structure(
        &mut self,
        name: &str,
        docs: &str,
        group: &Group<'_>,
        with_default: bool,
    ) {
        let scalar = self.types.scalar.clone();
        let f64 = self.types.known("f64");
        self.writer.gap();
        self.docs(docs);
        if self.options.marks {
            self.writer.line(format!("#[{MARK}]"));
        }
        if group.is_empty() && (name == self.types.inputs || name == self.types.outputs) {
            self.writer
                .line("#[derive(Clone, Copy, Debug, Default, PartialEq)]");
            return self.writer.line(format!("pub struct {name} {{}}"));
        }
        self.writer.line("#[derive(Clone, Copy, Debug, PartialEq)]");
        self.writer
            .open(format!("pub struct {name}<{scalar} = {f64}> {{"));
        for field in &group.fields {
            let docs = field_docs(field, group.slots, with_default);
            self.docs(&docs);
            let kind = if field.is_family {
                format!("[{scalar}; {}]", field.slots.len())
            } else {
                scalar.clone()
            };
            self.writer.line(format!("pub {}: {kind},", field.ident));
        }
        if group.is_empty() {
            self.docs("There is nothing to hold; this says which numbers the machine runs over.");
            self.writer.line(format!(
                "pub scalar: ::core::marker::PhantomData<{scalar}>,"
            ));
        }
        self.writer.close("}");
    }

    /// Writes the struct of the parameters with its methods.
    pub(super) fn machine(&mut self) {
        let name = self.types.machine.clone();
        let scalar = self.types.scalar.clone();
        let bound = format!("{scalar}: {}::Scalar", self.options.runtime);
        let docs = if self.program.docs.is_empty() {
            format!("The machine `{}`: its parameters.", self.program.name)
        } else {
            prose(&self.program.docs)
        };
        let group = Group::new(&self.program.parameters);
        self.structure(&name, &docs, &group, true);
        self.writer.gap();
        self.writer
            .open(format!("impl<{bound}> {name}<{scalar}> {{"));
        self.required(&name, &group);
        self.prepare();
        self.writer.gap();
        self.start();
        self.writer.close("}");
    }

    /// The families without a default for some member, as fields.
    pub(super) fn required_fields(group: &Group<'_>) -> Vec<Field> {
        let lacks = |field: &&Field| {
            field
                .slots
                .iter()
                .any(|&slot| group.slots[slot].default.is_none())
        };
        group.fields.iter().filter(lacks).cloned().collect()
    }

    /// Writes `new`, if some parameters have no default.
    pub(super) fn required(&mut self, name: &str, group: &Group<'_>) {
        let required = Self::required_fields(group);
        if required.is_empty() {
            return;
        }
        let scalar = self.types.scalar.clone();
        let arguments: Vec<String> = required
            .iter()
            .map(|field| {
                if field.is_family {
                    format!("{}: [{scalar}; {}]", field.ident, field.slots.len())
                } else {
                    format!("{}: {scalar}", field.ident)
                }
            })
            .collect();
        self.docs(
            "A machine with these parameters; the others have the defaults of the description.",
        );
        self.writer
            .signature("pub fn new", &arguments, Some("Self"));
        let default = |slot: usize| match &group.slots[slot].default {
            Some(default) => format!("{scalar}::from_f64({})", number(default.value)),
            None => String::new(),
        };
        let mut machine = group.literal(name, default);
        if let Layout::Struct(_, fields) = &mut machine {
            for (field, value) in fields {
                if required.iter().any(|required| required.ident == *field) {
                    *value = Layout::Atom(field.clone());
                }
            }
        }
        self.writer.expression("", &machine, "");
        self.writer.close("}");
        self.writer.gap();
    }

    /// Writes `prepare`, which computes what depends on parameters alone.
    pub(super) fn prepare(&mut self) {
        let Types {
            prepared, scalar, ..
        } = &self.types;
        let result = format!("{prepared}<{scalar}>");
        let function = &self.program.prepare;
        self.docs("Computes what depends on the parameters alone, once.");
        self.writer
            .signature("pub fn prepare", &["&self".into()], Some(&result));
        // A guard here means that no state has accelerations: its result is kept until accelerations are evaluated.
        let guards = &function.guards;
        let mut with_guards = Function {
            guards: Vec::new(),
            ..function.clone()
        };
        with_guards
            .results
            .extend(guards.iter().flat_map(|guard| [guard.pivot, guard.scale]));
        let name = |path: &String| path.replace('[', "_").replace(']', "");
        let mut wanted: Vec<String> = self.prepared.iter().map(name).collect();
        for guard in guards {
            wanted.extend(["pivot", "scale"].map(|what| format!("{what}_{}", guard.coordinate)));
        }
        let mut families = Vec::new();
        let texts: Vec<String> = match self.plan_of_prepare(&with_guards) {
            Some(plan) => {
                let (texts, filled) = self.prepare_with_loops(&with_guards, &plan);
                families = filled;
                texts
            }
            None => {
                let texts = self.statements(&with_guards, &wanted, false);
                texts.into_iter().map(|text| text.text).collect()
            }
        };
        let series = self.constants_of_series();
        let (values, pivots) = texts.split_at(self.prepared.len());
        let pivots: Vec<[String; 2]> = pivots
            .chunks(2)
            .map(|pair| [pair[0].clone(), pair[1].clone()])
            .collect();
        let mut rows = Vec::new();
        for (i, (constant, list)) in self.lists_of_pivots(function, &pivots).iter().enumerate() {
            let name = match i {
                0 => "pivots".to_owned(),
                i => format!("pivots_{i}"),
            };
            self.writer.expression(&format!("let {name} = "), list, ";");
            rows.push(match i {
                0 => format!("{constant}.vanished({name})"),
                _ => format!(".or({constant}.vanished({name}))"),
            });
        }
        let prepared = match self.prepared_literal(|slot| values[slot].clone(), &families) {
            Layout::Struct(name, mut fields) if !function.guards.is_empty() => {
                fields.push(("singular".into(), Layout::Atom(rows.concat())));
                Layout::Struct(name, fields)
            }
            prepared => prepared,
        };
        let prepared = with_field(prepared, series);
        self.writer.expression("", &prepared, "");
        self.writer.close("}");
    }

    /// Writes `start`, the initial state of the spec.
    pub(super) fn start(&mut self) {
        let runtime = &self.options.runtime;
        let Types {
            coordinates,
            scalar,
            ..
        } = &self.types;
        let result = format!("{runtime}::State<{coordinates}<{scalar}>>");
        let values = format!("{coordinates}::from_array");
        let n = self.program.dimension();
        let rest = format!("let v = [{scalar}::ZERO; {n}];");
        let head = format!("{runtime}::State");
        let is_at_rest = self.program.start.results.len() == n;
        self.docs(if is_at_rest {
            "The start values of the description, at rest and `t = 0`."
        } else {
            "The start values of the description, at `t = 0`."
        });
        self.writer
            .signature("pub fn start", &["&self".into()], Some(&result));
        let names = self.program.coordinates.iter().map(|slot| flat(&slot.name));
        let mut wanted: Vec<String> = names.clone().collect();
        if !is_at_rest {
            wanted.extend(names.map(|name| format!("{name}_rate")));
        }
        let mut texts = self
            .statements(&self.program.start, &wanted, false)
            .into_iter();
        let q = Layout::array(texts.by_ref().take(n).map(|text| text.text));
        self.writer.expression("let q = ", &q, ";");
        if is_at_rest {
            self.writer.line(rest);
        } else {
            let v = Layout::array(texts.map(|text| text.text));
            self.writer.expression("let v = ", &v, ";");
        }
        let fields = vec![
            ("t".to_owned(), Layout::Atom("0.0".into())),
            ("q".to_owned(), Layout::Atom(format!("{values}(q)"))),
            ("v".to_owned(), Layout::Atom(format!("{values}(v)"))),
        ];
        self.writer
            .expression("", &Layout::Struct(head, fields), "");
        self.writer.close("}");
    }

    /// Writes the struct of the coordinates by name, and its conversion to an array.
    pub(super) fn coordinates(&mut self) {
        let name = self.types.coordinates.clone();
        let group = Group::new(&self.program.coordinates);
        let docs = format!(
            "The coordinates of [`{}`], or their rates, by name.",
            self.program.name
        );
        self.structure(&name, &docs, &group, false);
    }

    /// Whether the macro of the runtime defines the type of a group: an empty struct, unless the attributes of a user go on it.
    pub(super) fn is_defined_by_macro(&self, group: &Group<'_>) -> bool {
        group.is_empty() && !self.options.marks
    }

    /// Writes the struct of the inputs.
    pub(super) fn inputs(&mut self) {
        if self.is_defined_by_macro(&self.inputs) {
            return;
        }
        let name = self.types.inputs.clone();
        let group = Group::new(&self.program.inputs);
        let docs = format!("What can be set while a [`{}`] runs.", self.program.name);
        self.structure(&name, &docs, &group, true);
    }

    /// Writes the struct of the outputs.
    pub(super) fn outputs(&mut self) {
        if self.is_defined_by_macro(&self.outputs) {
            return;
        }
        let name = self.types.outputs.clone();
        let group = Group::new(&self.program.outputs);
        let docs = format!("What can be observed of a [`{}`].", self.program.name);
        self.structure(&name, &docs, &group, false);
    }

    pub(super) fn prepared(&mut self) {
        let Types {
            prepared,
            scalar,
            machine,
            ..
        } = self.types.clone();
        let f64 = self.types.known("f64");
        let head = format!("pub struct {prepared}<{scalar} = {f64}> {{");
        let marker = format!("scalar: ::core::marker::PhantomData<{scalar}>,");
        let docs = format!(
            "The parameters of a [`{machine}`], with the work done that depends on them alone."
        );
        let option = self.types.known("Option");
        self.writer.gap();
        self.docs(&docs);
        self.writer.line("#[derive(Clone, Copy, Debug, PartialEq)]");
        self.writer.open(head);
        for field in self.prepared_fields() {
            let formula = |slot: usize| self.program.prepared.get(slot).map_or("", String::as_str);
            let (docs, kind) = match field.slots.as_slice() {
                [first, .., last] if field.is_family => (
                    format!("`{}` to `{}`", formula(*first), formula(*last)),
                    format!("[{scalar}; {}]", field.slots.len()),
                ),
                slots => {
                    let formula = slots.first().map_or("", |slot| formula(*slot));
                    (format!("`{formula}`"), scalar.clone())
                }
            };
            self.docs(&docs);
            self.writer.line(format!("{}: {kind},", field.ident));
        }
        if self.prepared.is_empty() {
            self.writer.line(marker);
        }
        if let Some(count) = self.number_of_constants_of_series() {
            self.docs("What the Taylor series takes from the parameters.");
            self.writer.line(format!("series: [{scalar}; {count}],"));
        }
        if !self.program.prepare.guards.is_empty() {
            self.docs("Why these parameters leave the machine without accelerations, if they do.");
            self.writer.line(format!(
                "singular: {option}<{}::Singular>,",
                self.options.runtime
            ));
        }
        self.writer.close("}");
    }
}

/// A struct literal with one more field.
pub(super) fn with_field(literal: Layout, field: Option<(String, Layout)>) -> Layout {
    match (literal, field) {
        (Layout::Struct(name, mut fields), Some(field)) => {
            fields.push(field);
            Layout::Struct(name, fields)
        }
        (literal, _) => literal,
    }
}
