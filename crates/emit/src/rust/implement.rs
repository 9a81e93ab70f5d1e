//! A machine's interface to the runtime, as the rows of one macro call: names, conversions, and the function for each method
//! of `System`. The macro is `src/emitted/implement.rs` of the runtime; its text documents the rows.

use super::Emitter;
use super::types::{Group, Types};
use crate::layout::{Layout, width};
use crate::names::{Scope, flat};
use lagrangian_program::quantity::{Extent, ItemKind};
use lagrangian_program::{Fact, FrictionLayout, Reads, Role};
use lagrangian_units::{Compliance, ImpactLaw, ImpactOrder, Painleve};

/// The approximate limit for a workspace on the stack, in numbers: a quarter of a megabyte.
const LARGEST_WORKSPACE: usize = 1 << 15;

/// The numbers of a group as variables.
struct Variables {
    /// The fields of the struct as a pattern without its braces, split at commas.
    fields: Vec<String>,
    /// A variable for each number.
    names: Vec<String>,
}

impl Variables {
    fn of(group: &Group<'_>) -> Variables {
        // Names that a pattern would take for a variant or a constant.
        let mut scope = Scope::with(&["None", "Some", "Ok", "Err", "PIVOTS"]);
        let names = group.slots.iter();
        let names: Vec<String> = names.map(|slot| scope.take(&flat(&slot.name))).collect();
        let fields = group.fields.iter().flat_map(|field| {
            let texts = field.slots.iter().map(|&slot| names[slot].clone());
            let mut texts: Vec<String> = texts.collect();
            if field.is_family || texts[..] != [field.ident.clone()] {
                let bracket = if field.is_family { "[" } else { "" };
                texts[0] = format!("{}: {bracket}{}", field.ident, texts[0]);
            }
            if let (true, Some(last)) = (field.is_family, texts.last_mut()) {
                last.push(']');
            }
            texts
        });
        Variables {
            fields: fields.collect(),
            names,
        }
    }
}

impl Emitter<'_> {
    /// Writes the call of the macro.
    pub(super) fn implementations(&mut self) {
        let runtime = self.options.runtime.clone();
        let Types {
            machine,
            coordinates,
            inputs,
            outputs,
            prepared,
            scalar,
            register,
            other,
            ..
        } = self.types.clone();
        self.writer.gap();
        self.writer.open(format!("{runtime}::implement! {{"));
        let name = &self.program.name;
        self.writer.line(format!(
            "machine {machine} {name:?} over {scalar}, {other};"
        ));
        let empty = "scalar: ::core::marker::PhantomData";
        let program = self.program;
        self.group("parameters", &program.parameters, Some(empty), "");
        let n = self.program.dimension();
        let head = format!("coordinates {n} {coordinates}");
        self.group(&head, &program.coordinates, Some(empty), "");
        let over = format!(" over {scalar}");
        let defined = |is_defined: bool| if is_defined { ", defined here" } else { "" };
        let after = if self.inputs.is_empty() {
            defined(self.is_defined_by_macro(&self.inputs))
        } else {
            &over
        };
        let head = format!("inputs {inputs}");
        self.group(&head, &program.inputs, None, after);
        let head = format!("outputs {outputs}");
        let after = defined(self.is_defined_by_macro(&self.outputs));
        self.group(&head, &program.outputs, None, after);
        self.rows_of_prepared(&prepared);
        self.row_of_accelerations();
        self.writer.open("system {");
        self.rows_of_system();
        self.writer.close("}");
        let is_free = program.constraints.is_empty();
        let has_lanes = program.contacts.is_empty();
        let never_collides = program.unilateral.is_empty();
        let absent = [
            ("MAY_BE_CONSTRAINED", is_free),
            ("MAY_SLIDE", program.contacts.is_empty()),
            ("MAY_COLLIDE", never_collides),
        ];
        let absent = absent.iter().filter(|(_, is_absent)| *is_absent);
        let absent: Vec<&str> = absent.map(|(name, _)| *name).collect();
        let flag = |name: &str, is_there: bool, word: &str| {
            format!("{name} [{}]", if is_there { word } else { "" })
        };
        let slips = self.emitted(Role::Slips);
        let rounds_prepared = slips.is_some_and(|function| self.needs(function).prepared)
            || self.parts_of_gaps_read_prepared();
        self.writer.line(format!("absent [{}]", absent.join(" ")));
        self.writer.line(flag("intervals", rounds_prepared, "yes"));
        if let Some(call) = self.call_of_series().filter(|_| has_lanes) {
            let runtime = &self.options.runtime;
            let lists = self.lists_of_series(&format!("{runtime}::Lanes<{register}>"));
            self.writer.open("batch_series {");
            self.writer.line(format!("{lists};"));
            let before = "(p, t, q, v, u, lists, coefficients) ";
            self.writer.expression(before, &call, "");
            self.writer.close("}");
        }
        self.writer.line(flag("lanes", has_lanes, &register));
        self.writer.line(flag(
            "numbers",
            has_lanes && never_collides && is_free,
            "yes",
        ));
        self.writer.close("}");
    }

    /// The fields of the struct of parameters, as a pattern without its braces and as an expression.
    pub(super) fn fields_of_parameters(&self) -> Vec<String> {
        let group = Group::new(&self.program.parameters);
        let mut fields = Variables::of(&group).fields;
        if group.is_empty() {
            fields.push("scalar: ::core::marker::PhantomData".to_owned());
        }
        fields
    }

    /// Writes words between two texts, on one line or on as many as needed; optionally a block begins after them.
    pub(super) fn filled(&mut self, before: &str, words: &[String], after: &str, opens: bool) {
        let all = words.join(", ");
        let one = if all.is_empty() {
            format!("{before}{after}")
        } else {
            format!("{before} {all} {after}")
        };
        if width(&one) <= self.writer.columns() {
            return if opens {
                self.writer.open(one)
            } else {
                self.writer.line(one)
            };
        }
        self.writer.open(before);
        let mut line = String::new();
        for word in words {
            if !line.is_empty() && width(&line) + width(word) + 1 > self.writer.columns() {
                self.writer.line(line.trim_end());
                line.clear();
            }
            line += word;
            line += ", ";
        }
        self.writer.line(line.trim_end());
        if opens {
            self.writer.middle(after)
        } else {
            self.writer.close(after)
        }
    }

    /// Writes a struct of named numbers: its fields, and a row for each number. `empty` is the field of a struct without numbers.
    fn group(
        &mut self,
        head: &str,
        slots: &[lagrangian_program::Slot],
        empty: Option<&str>,
        after: &str,
    ) {
        let group = Group::new(slots);
        let mut variables = Variables::of(&group);
        if let (true, Some(empty)) = (group.is_empty(), empty) {
            variables.fields.push(empty.to_owned());
        }
        let has_defaults = !head.starts_with("coordinates") && !head.starts_with("outputs");
        if group.is_empty() {
            let end = format!("}} []{after}");
            return self.filled(&format!("{head} {{"), &variables.fields, &end, false);
        }
        self.filled(&format!("{head} {{"), &variables.fields, "} [", true);
        let mut rows = Vec::new();
        for (slot, name) in slots.iter().zip(&variables.names) {
            let default = slot.default.as_ref().filter(|_| has_defaults);
            let default = match default {
                Some(default) => format!(" = {}", super::language::number(default.value)),
                None if head.starts_with("inputs") => " = 0.0".to_owned(),
                None => String::new(),
            };
            let row = format!("{:?} {:?}{default};", slot.name.to_string(), slot.unit_text);
            rows.push((format!("{name}:"), row));
        }
        for (name, row) in rows {
            self.writer.statement(&name, &row);
        }
        self.writer.close(&format!("]{after}"));
    }

    /// Writes the fields of the prepared values.
    fn rows_of_prepared(&mut self, prepared: &str) {
        let mut fields: Vec<String> = self
            .prepared_fields()
            .into_iter()
            .map(|field| field.ident)
            .collect();
        if self.prepared.is_empty() {
            fields.push("scalar".to_owned());
        }
        self.filled(&format!("prepared {prepared} {{"), &fields, "}", false);
        if self.number_of_constants_of_series().is_some() {
            self.writer.line("series series");
        }
        if !self.program.prepare.guards.is_empty() {
            self.writer.line("singular singular");
        }
    }

    /// Writes the row of the accelerations, which integrators evaluate with several types of number.
    fn row_of_accelerations(&mut self) {
        let function = self.emitted(Role::Accelerations);
        let row = match function {
            _ if !self.program.contacts.is_empty() => "accelerations friction".to_owned(),
            None => "accelerations none".to_owned(),
            Some(function) => {
                let [call, _] = self.names(Role::Accelerations);
                let arguments = self.arguments(self.needs(function));
                let fields: Vec<&str> = arguments.iter().map(|(name, _)| *name).collect();
                let call = if fields.is_empty() {
                    format!("{call}(::core::marker::PhantomData)")
                } else {
                    format!("{call} {{ {} }}", fields.join(", "))
                };
                format!("accelerations {{ (p, t, q, v, u) {call} }}")
            }
        };
        self.writer.line(row);
    }

    /// Writes a method of `System`: the kind of its result, its arguments, and the call.
    pub(super) fn row(
        &mut self,
        kind: &str,
        method: &str,
        arguments: &[&str],
        value: Option<Layout>,
    ) {
        let head = format!("{kind} {method}({})", arguments.join(", "));
        match value {
            Some(value) => self.writer.expression(&format!("{head} = "), &value, ";"),
            None => self.writer.line(format!("{head};")),
        }
    }

    /// The call of a function with the arguments that it needs.
    fn called(&self, name: &str, needs: Reads) -> Layout {
        let arguments = self.arguments(needs);
        let names = arguments.iter().map(|(name, _)| *name);
        let names = names.collect::<Vec<_>>().join(", ");
        Layout::Atom(format!("{name}({names})"))
    }

    /// The call of the function of a role, if it computes anything.
    pub(super) fn called_role(&self, role: Role) -> Option<Layout> {
        let function = self.emitted(role)?;
        Some(self.called(&self.function_name(role), self.needs(function)))
    }

    fn rows_of_system(&mut self) {
        if let Some(call) = self.call_of_series() {
            if self.has_lists_of_series() {
                let arguments = ["p", "t", "q", "v", "u", "lists", "coefficients"];
                self.row("series_in_lists", "series", &arguments, Some(call));
            } else {
                let arguments = ["p", "t", "q", "v", "u", "coefficients"];
                self.row("series", "series", &arguments, Some(call));
            }
            self.row_of_costs();
            if !self.program.assumptions.is_empty() && self.program.has_linear_assumptions() {
                let yes = Layout::Atom("true".into());
                self.row("boolean", "has_linear_assumptions", &["p"], Some(yes));
            }
            let series = self.options.series.as_ref();
            if series.is_some_and(|series| !series.has_roots()) {
                let no = Layout::Atom("false".into());
                self.row("boolean", "series_may_branch", &["p"], Some(no));
            }
            if self.program.has_powers() == [false; 2] {
                let no = Layout::Atom("false".into());
                self.row("boolean", "has_powers", &["p"], Some(no));
            }
        }
        self.rows_of_quantities();
        let value = if self.outputs.is_empty() {
            Layout::Atom(format!("{} {{}}", self.types.outputs))
        } else {
            self.called("outputs", self.needs_of_outputs())
        };
        let arguments = ["p", "t", "q", "v", "a", "u"];
        self.row("outputs", "outputs", &arguments, Some(value));
        self.row_of_assumptions();
        self.rows_of_constraints();
        self.rows_of_contacts();
        self.row_of_unilateral_contacts();
        self.rows_of_contact_parts();
        self.row_of_workspace();
    }

    /// Writes the costs of a step by the series, by which a run chooses its method. They are estimates, for which one decimal suffices.
    fn row_of_costs(&mut self) {
        let Some(series) = self.options.series.as_ref() else {
            return;
        };
        let Some([coarse, fine]) = series.series().cost(self.program) else {
            return;
        };
        let costs = Layout::Atom(format!("[{coarse:.1}, {fine:.1}]"));
        self.row("costs", "series_cost", &["p"], Some(costs));
        if self.program.has_powers() != [false; 2]
            && let Some(costs) = series.series().cost_of_powers(self.program)
        {
            let [of_evaluation, coarse, fine] = costs;
            let costs = format!("[{of_evaluation:.1}, {coarse:.1}, {fine:.1}]");
            self.row("more", "powers_cost", &["p"], Some(Layout::Atom(costs)));
        }
    }

    /// Writes the method of each quantity of this machine that is one.
    fn rows_of_quantities(&mut self) {
        let sizes = self.program.sizes();
        let is_method = |role: &Role| {
            let row = role.row();
            row.method.is_some() && row.needs.are_met(sizes)
        };
        for role in Role::all().filter(is_method) {
            let row = role.row();
            if self.is_by_parts(role) {
                continue;
            }
            let kind = match row.extent {
                Extent::Number => "number",
                Extent::Symmetric(_) => "matrix",
                Extent::Each(ItemKind::Coordinate) => "vector",
                _ => "numbers",
            };
            let letters = row.of.iter().map(|of| of.letter());
            let arguments: Vec<&str> = ["p"].into_iter().chain(letters).collect();
            self.row(kind, row.name, &arguments, self.called_role(role));
        }
    }

    fn row_of_assumptions(&mut self) {
        if self.program.assumptions.is_empty() {
            return;
        }
        let row = |(i, fact): (usize, &Fact)| {
            let margin = self.called_role(Role::Assumption(i));
            let text = Layout::Atom(format!("{:?}", fact.text));
            let strict = Layout::Atom(fact.strict.to_string());
            let margin = margin.unwrap_or(Layout::Atom("0.0".into()));
            Layout::List("(".into(), vec![text, strict, margin], ")")
        };
        let facts = self.program.assumptions.iter().enumerate().map(row);
        let facts = Layout::nested(facts);
        let arguments = ["p", "t", "q", "v", "u"];
        self.row("facts", "assumptions", &arguments, Some(facts));
        self.row_of_bounded_assumptions();
    }

    /// Writes whether assumptions hold within bounds, for series, where they are not linear and depend on no parameters: prepared values as intervals
    /// would cost more than they save.
    fn row_of_bounded_assumptions(&mut self) {
        let program = self.program;
        if self.options.series.is_none() || program.has_linear_assumptions() {
            return;
        }
        let (mut facts, mut needed) = (Vec::new(), Vec::new());
        for (i, fact) in program.assumptions.iter().enumerate() {
            let role = Role::Assumption(i);
            let (Some(function), Some(margin)) = (self.emitted(role), self.called_role(role))
            else {
                return;
            };
            needed.extend(self.arguments(self.needs(function)));
            let strict = Layout::Atom(fact.strict.to_string());
            facts.push(Layout::List("(".into(), vec![strict, margin], ")"));
        }
        let are_needed = |name: &&str| needed.iter().any(|(other, _)| other == name);
        let bounded = ["t", "q", "v"];
        if needed.iter().all(|(name, _)| bounded.contains(name)) {
            let arguments: Vec<&str> = bounded
                .into_iter()
                .filter(|name| are_needed(name))
                .collect();
            let facts = Layout::nested(facts);
            self.row("bounds", "assumptions_hold_within", &arguments, Some(facts));
        }
    }

    /// Writes bilateral constraints, and the numbers of the start that the spec keeps.
    fn rows_of_constraints(&mut self) {
        let program = self.program;
        if !program.constraints.is_empty() {
            let rows = program.constraints.iter().map(|constraint| {
                let texts = [
                    &constraint.name,
                    &constraint.unit,
                    &constraint.multiplier_unit,
                ];
                let texts = texts.map(|text| Layout::Atom(format!("{text:?}")));
                let holonomic = Layout::Atom(constraint.holonomic.to_string());
                let items = texts.into_iter().chain([holonomic]).collect();
                Layout::List("(".into(), items, ")")
            });
            let rows = Layout::nested(rows);
            self.row("constraints", "constraints", &["p"], Some(rows));
            if let Some(function) = self.emitted(Role::Projection) {
                let [call, _] = self.names(Role::Projection);
                let arguments = self.arguments(self.needs(function));
                let fields: Vec<&str> = arguments.iter().map(|(name, _)| *name).collect();
                let call = Layout::Atom(format!("{call} {{ {} }}", fields.join(", ")));
                let arguments = ["p", "t", "q", "v"];
                self.row("solved_in_place", "projection", &arguments, Some(call));
            }
            let arguments = ["p", "t", "q", "v", "u"];
            if program.contacts.is_empty() {
                let call = self.called_role(Role::Multipliers);
                self.row("solved", "multipliers", &arguments, call);
            } else {
                self.row("with_friction", "multipliers", &arguments, None)
            }
        }
        if !program.kept.is_empty() {
            let names = program.kept.iter().map(|name| format!("{name:?}"));
            let names = Layout::array(names);
            self.row("names", "kept_at_start", &["p"], Some(names));
        }
    }

    /// Writes guided contacts with friction.
    fn rows_of_contacts(&mut self) {
        let contacts = &self.program.contacts;
        if contacts.is_empty() {
            return;
        }
        let names = Layout::array(contacts.iter().map(|name| format!("{name:?}")));
        self.row("names", "contacts", &["p"], Some(names));
        if self.program.reaction_axes != 1 {
            let axes = Layout::Atom(self.program.reaction_axes.to_string());
            self.row("count", "reaction_axes", &["p"], Some(axes));
        }
        if self.program.second_tangents != 0 {
            let seconds = Layout::Atom(self.program.second_tangents.to_string());
            self.row("bits", "second_tangents", &["p"], Some(seconds));
        }
        let slips = self.emitted(Role::Slips);
        let needs = slips.map(|function| self.needs(function));
        let arguments = needs.map(|needs| self.arguments(needs)).unwrap_or_default();
        let arguments: Vec<&str> = arguments.iter().map(|(name, _)| *name).collect();
        let zeros = format!(
            "[{}::scalar::Interval::from(0.0); {}]",
            self.options.runtime,
            contacts.len()
        );
        let call = self.called_role(Role::Slips).unwrap_or(Layout::Atom(zeros));
        self.row("ranges", "slip_ranges", &arguments, Some(call));
        let arguments = ["p", "t", "q", "v", "u"];
        let call = self.called_role(Role::Friction);
        self.row("solved", "friction", &arguments, call);
    }

    /// Writes unilateral contacts: their names and their restitution.
    fn row_of_unilateral_contacts(&mut self) {
        let contacts = &self.program.unilateral;
        if contacts.is_empty() {
            return;
        }
        let runtime = &self.options.runtime;
        let rows = contacts.iter().map(|contact| {
            let law = match contact.law {
                ImpactLaw::Newton => "Newton",
                ImpactLaw::Poisson => "Poisson",
                ImpactLaw::PoissonGlocker => "PoissonGlocker",
                ImpactLaw::Stronge => "Stronge",
            };
            let order = match contact.order {
                ImpactOrder::AtOnce => "AtOnce",
                ImpactOrder::Sequence => "Sequence",
            };
            let painleve = match contact.painleve {
                Painleve::Error => "Error",
                Painleve::Impact => "Impact",
            };
            let compliance = contact.compliance.map(|law| match law {
                Compliance::Linear => "Linear",
                Compliance::Hertz => "Hertz",
                Compliance::HuntCrossley => "HuntCrossley",
                Compliance::Layer => "Layer",
            });
            let option = self.types.known("Option");
            let compliance = match compliance {
                None => format!("{option}::None"),
                Some(law) => format!("{option}::Some({runtime}::Compliance::{law})"),
            };
            let fields = [
                ("name", format!("{:?}", contact.name)),
                ("law", format!("{runtime}::ImpactLaw::{law}")),
                ("order", format!("{runtime}::ImpactOrder::{order}")),
                ("painleve", format!("{runtime}::Painleve::{painleve}")),
                ("compliance", compliance),
                ("has_friction", contact.has_friction.to_string()),
                (
                    "is_rolling_resistance",
                    contact.is_rolling_resistance.to_string(),
                ),
                ("is_second_tangent", contact.is_second_tangent.to_string()),
                ("has_face", contact.has_face.to_string()),
            ];
            let fields = fields.map(|(name, value)| (name.to_owned(), Layout::Atom(value)));
            Layout::Struct(format!("{runtime}::UnilateralContact"), fields.to_vec())
        });
        let rows = Layout::nested(rows);
        let guides = contacts.iter().filter(|contact| contact.is_guide).count();
        self.row("contacts", "unilateral_contacts", &["p"], Some(rows));
        if guides > 0 {
            let guides = Layout::Atom(guides.to_string());
            self.row("count", "guides", &["p"], Some(guides));
        }
    }

    /// Writes a workspace for constraints and contacts: an array, if it is small enough for the stack.
    fn row_of_workspace(&mut self) {
        let (n, m, contacts) = (
            self.program.coordinates.len(),
            self.program.constraints.len(),
            self.program.contacts.len(),
        );
        let layout = FrictionLayout {
            coordinates: n,
            constraints: m,
            contacts,
            axes: self.program.reaction_axes,
        };
        let most = 2 * n * m + n.min(m) * n.min(m) + layout.len();
        if m + contacts == 0 || most > LARGEST_WORKSPACE {
            return;
        }
        let runtime = &self.options.runtime;
        let length = Layout::Atom(match contacts {
            0 => format!("{runtime}::constraint_workspace({n}, {m})"),
            _ if self.program.reaction_axes == 1 => {
                format!("{runtime}::contact_workspace({n}, {m}, {contacts})")
            }
            _ => format!("{runtime}::contact_workspace_in_space({n}, {m}, {contacts})"),
        });
        self.row("workspace", "with_workspace", &["p"], Some(length));
    }
}
