//! Bilateral constraints, for whoever keeps them.

use super::Emitter;
use crate::layout::Layout;
use lagrangian_program::Role;

impl Emitter<'_> {
    /// What the constraints are called.
    pub(super) fn table_of_constraints(&mut self) {
        let constraints = &self.program.constraints;
        if constraints.is_empty() {
            return;
        }
        let rows = constraints.iter().map(|constraint| {
            let texts = [
                &constraint.name,
                &constraint.unit,
                &constraint.multiplier_unit,
            ];
            let texts = texts.map(|text| Layout::Atom(format!("{text:?}")));
            let holonomic = Layout::Atom(constraint.holonomic.to_string());
            Layout::List(
                "(".into(),
                texts.into_iter().chain([holonomic]).collect(),
                ")",
            )
        });
        let rows = Layout::nested(rows);
        let str = self.types.known("str");
        let bool = self.types.known("bool");
        self.writer.gap();
        self.writer
            .line("/// Names, units, units of multipliers, whether positions are constrained.");
        let head = format!(
            "const CONSTRAINTS: [(&{str}, &{str}, &{str}, {bool}); {}] = ",
            constraints.len()
        );
        self.writer.expression(&head, &rows, ";");
    }

    /// The methods of `System` that machines without constraints do not have.
    pub(super) fn constraints(&mut self) {
        if self.program.constraints.is_empty() {
            return;
        }
        let runtime = self.options.runtime.clone();
        let result = format!(
            "impl {}<Item = {runtime}::Constraint<'_>>",
            self.types.known("ExactSizeIterator")
        );
        self.method("constraints", &[], Some(&result), |body| {
            body.line("CONSTRAINTS.iter().map(constraint)");
        });
        let call = self.call(Role::Multipliers);
        let has_contacts = !self.program.contacts.is_empty();
        let result = format!("{}<(), {runtime}::Singular>", self.types.known("Result"));
        self.method(
            "multipliers",
            &["t", "q", "v", "u", "to"],
            Some(&result),
            |body| {
                if has_contacts {
                    let own = format!("{runtime}::multipliers_with_friction");
                    body.line(format!("{own}(self, t, q, v, u, to)"));
                    return;
                }
                if let Some(call) = call {
                    body.line(format!("fill(to, &{call}?);"));
                }
                body.line("Ok(())");
            },
        );
    }

    /// The method of `System` for what a description keeps of its start.
    pub(super) fn kept_at_start(&mut self) {
        let kept = &self.program.kept;
        if kept.is_empty() {
            return;
        }
        let [str, iterator] = ["str", "ExactSizeIterator"].map(|name| self.types.known(name));
        let result = format!("impl {iterator}<Item = &{str}>");
        let names = kept.iter().map(|name| format!("{name:?}"));
        let names = Layout::array(names);
        self.method("kept_at_start", &[], Some(&result), |body| {
            body.expression("", &names, ".into_iter()");
        });
    }

    /// Small functions that the code above calls.
    pub(super) fn helpers_of_constraints(&mut self) {
        if self.program.constraints.is_empty() {
            return;
        }
        let runtime = self.options.runtime.clone();
        let [str, bool] = ["str", "bool"].map(|name| self.types.known(name));
        self.writer.gap();
        self.writer.line("/// A constraint, as it is called.");
        let text = format!("&'a {str}");
        let row = format!("({text}, {text}, {text}, {bool})");
        self.writer.signature(
            "fn constraint<'a>",
            &[format!(
                "&(name, unit, multiplier_unit, holonomic): &'a {row}"
            )],
            Some(&format!("{runtime}::Constraint<'a>")),
        );
        let fields = ["name", "unit", "multiplier_unit", "holonomic"]
            .map(|name| (name.to_owned(), Layout::Atom(name.to_owned())));
        let literal = Layout::Struct(format!("{runtime}::Constraint"), fields.to_vec());
        self.writer.expression("", &literal, "");
        self.writer.close("}");
    }
}
