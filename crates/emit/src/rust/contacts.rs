//! Guided contacts with friction, for whoever decides what sticks and what slides; and the room in
//! which that and the work on constraints is done.

use super::Emitter;
use crate::layout::Layout;
use lagrangian_program::{FrictionLayout, Program, Role};
use lagrangian_units::{Compliance, ImpactLaw, ImpactOrder, Painleve};

/// About how many numbers a workspace may have on the stack: a quarter of a megabyte.
const MOST_LENT: usize = 1 << 15;

impl Emitter<'_> {
    /// What the contacts are called.
    pub(super) fn table_of_contacts(&mut self) {
        let contacts = &self.program.contacts;
        if contacts.is_empty() {
            return;
        }
        let names = contacts.iter().map(|name| format!("{name:?}"));
        let str = self.types.known("str");
        self.writer.gap();
        self.writer
            .line("/// The names of the contacts that stick and slide.");
        let head = format!("const CONTACTS: [&{str}; {}] = ", contacts.len());
        self.writer.expression(&head, &Layout::array(names), ";");
    }

    /// What the unilateral contacts are called, and how they bounce.
    pub(super) fn table_of_unilateral_contacts(&mut self) {
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
            let fields = vec![
                ("name".into(), Layout::Atom(format!("{:?}", contact.name))),
                (
                    "law".into(),
                    Layout::Atom(format!("{runtime}::ImpactLaw::{law}")),
                ),
                (
                    "order".into(),
                    Layout::Atom(format!("{runtime}::ImpactOrder::{order}")),
                ),
                (
                    "painleve".into(),
                    Layout::Atom(format!("{runtime}::Painleve::{painleve}")),
                ),
                ("compliance".into(), Layout::Atom(compliance)),
                ("rubs".into(), Layout::Atom(contact.rubs.to_string())),
            ];
            Layout::Struct(format!("{runtime}::UnilateralContact"), fields)
        });
        let head = format!(
            "const UNILATERAL: [{runtime}::UnilateralContact<'_>; {}] = ",
            contacts.len()
        );
        let rows = Layout::nested(rows);
        self.writer.gap();
        self.writer.line("/// The unilateral contacts.");
        self.writer.expression(&head, &rows, ";");
    }

    /// The method of `System` that says which unilateral contacts there are.
    pub(super) fn unilateral_contacts(&mut self) {
        if self.program.unilateral.is_empty() {
            return;
        }
        let result = format!(
            "impl {}<Item = {}::UnilateralContact<'_>>",
            self.types.known("ExactSizeIterator"),
            self.options.runtime
        );
        self.method("unilateral_contacts", &[], Some(&result), |body| {
            body.line("UNILATERAL.iter().copied()");
        });
    }

    /// The methods of `System` that machines without contacts do not have.
    pub(super) fn contacts(&mut self) {
        if self.program.contacts.is_empty() {
            return;
        }
        let runtime = self.options.runtime.clone();
        let str = self.types.known("str");
        let result = format!(
            "impl {}<Item = &{str}>",
            self.types.known("ExactSizeIterator")
        );
        self.method("contacts", &[], Some(&result), |body| {
            body.line("CONTACTS.iter().copied()");
        });
        self.slip_ranges();
        let call = self.call(Role::Friction);
        let result = format!("{}<(), {runtime}::Singular>", self.types.known("Result"));
        self.method(
            "friction",
            &["t", "q", "v", "u", "to"],
            Some(&result),
            |body| {
                if let Some(call) = call {
                    body.line(format!("fill(to, &{call}?);"));
                }
                body.line("Ok(())");
            },
        );
    }

    /// The slips over intervals, of a state and of prepared parameters that are rounded.
    fn slip_ranges(&mut self) {
        let runtime = self.options.runtime.clone();
        let (function, f64) = (self.emitted(Role::Slips), self.types.known("f64"));
        let Some(needs) = function.map(|function| self.needs(function)) else {
            let arguments = ["t", "q", "v", "ranges"];
            self.method("slip_ranges", &arguments, None, |body| {
                body.line("ranges.fill([0.0; 2]);");
            });
            return;
        };
        let names: Vec<&str> = self
            .arguments(needs)
            .iter()
            .map(|(name, _)| *name)
            .collect();
        let prepared = names.contains(&"p").then(|| {
            let near = |slot: usize| format!("near(self.{})", self.prepared[slot]);
            let mut value = self.prepared_literal(near, &[]);
            if let Layout::Struct(_, fields) = &mut value
                && !self.program.prepare.guards.is_empty()
            {
                fields.push(("singular".into(), Layout::Atom("self.singular".into())));
            }
            value
        });
        let passed = names.iter().map(|&name| match name {
            "t" => "near(t)".to_owned(),
            "p" => "&p".to_owned(),
            name => format!("&{name}.map(near)"),
        });
        let passed: Vec<String> = passed.collect();
        let call = format!("{}({})", self.function_name(Role::Slips), passed.join(", "));
        let interval = format!("{runtime}::scalar::Interval");
        self.method("slip_ranges", &["t", "q", "v", "ranges"], None, |body| {
            if !names.is_empty() {
                body.line(format!("let between = {interval}::new;"));
                body.line(format!(
                    "let near = |x: {f64}| between(x.next_down(), x.next_up());"
                ));
            }
            if let Some(value) = prepared {
                body.expression("let p = ", &value, ";");
            }
            body.line(format!("let slips: [{interval}; _] = {call};"));
            body.open("for (range, w) in ranges.iter_mut().zip(slips) {");
            body.line("*range = [w.lo(), w.hi()];");
            body.close("}");
        });
    }

    /// Room for the work on constraints and contacts: an array, where that is no burden to a stack.
    pub(super) fn workspace(&mut self) {
        let (n, m, contacts) = (
            self.program.coordinates.len(),
            self.program.constraints.len(),
            self.program.contacts.len(),
        );
        let layout = FrictionLayout {
            coordinates: n,
            constraints: m,
            contacts,
        };
        let most = 2 * n * m + n.min(m) * n.min(m) + layout.len();
        if m + contacts == 0 || most > MOST_LENT {
            return;
        }
        let [option, once, f64, usize] =
            ["Option", "FnOnce", "f64", "usize"].map(|name| self.types.known(name));
        let runtime = &self.options.runtime;
        let length = match contacts {
            0 => format!("{runtime}::constraint_workspace({n}, {m})"),
            _ => format!("{runtime}::contact_workspace({n}, {m}, {contacts})"),
        };
        let room = format!("let mut room = [0.0; {length}];");
        self.writer.gap();
        self.writer.signature(
            "fn with_workspace<R>",
            &[
                "&self".to_owned(),
                format!("length: {usize}"),
                format!("work: impl {once}({option}<&mut [{f64}]>) -> R"),
            ],
            Some("R"),
        );
        self.writer.line(room);
        self.writer.line("work(room.get_mut(..length))");
        self.writer.close("}");
    }

    /// A small function that the methods about constraints and contacts call.
    pub(super) fn helper_of_filling(&mut self) {
        let Program {
            constraints,
            contacts,
            unilateral,
            ..
        } = self.program;
        if constraints.is_empty() && contacts.is_empty() && unilateral.is_empty() {
            return;
        }
        let f64 = self.types.known("f64");
        self.writer.gap();
        self.writer
            .line("/// Writes numbers where there is room for them.");
        self.writer.signature(
            "fn fill",
            &[format!("to: &mut [{f64}]"), format!("from: &[{f64}]")],
            None,
        );
        self.writer
            .open("for (to, from) in to.iter_mut().zip(from) {");
        self.writer.line("*to = *from;");
        self.writer.close("}");
        self.writer.close("}");
    }
}
