//! `MachineIn` and `SystemIn`: the machine in numbers of any kind, where it has no constraints and no contacts.

use super::Emitter;
use super::types::Types;
use crate::layout::WIDTH;
use lagrangian_program::Role;

impl Emitter<'_> {
    /// Whether accelerations of coordinates and rates are all that there is to a step.
    fn is_free(&self) -> bool {
        let program = self.program;
        program.constraints.is_empty()
            && program.contacts.is_empty()
            && program.unilateral.is_empty()
    }

    pub(super) fn impl_in_numbers(&mut self) {
        if !self.is_free() {
            return;
        }
        let runtime = self.options.runtime.clone();
        let Types {
            machine,
            prepared,
            coordinates,
            inputs,
            scalar,
            ..
        } = self.types.clone();
        let over = |name: &str| format!("{name}<{scalar}>");
        let state = format!("{runtime}::State<{}>", over(&coordinates));
        self.writer.gap();
        let head = format!("impl<{scalar}: {runtime}::Real> {runtime}::MachineIn<{scalar}>");
        let whose = format!("for {}", over(&machine));
        match head.chars().count() + whose.chars().count() + 3 <= WIDTH {
            true => self.writer.open(format!("{head} {whose} {{")),
            false => {
                self.writer.line(head);
                self.writer.line(format!("    {whose}"));
                self.writer.open("{");
            }
        }
        self.writer
            .line(format!("type System = {};", over(&prepared)));
        for (method, result) in [("prepare", &over(&prepared)), ("start", &state)] {
            self.writer.gap();
            let head = format!("fn {method}");
            self.writer
                .signature(&head, &["&self".into()], Some(result));
            self.writer.line(format!("Self::{method}(self)"));
            self.writer.close("}");
        }
        self.writer.close("}");

        let n = self.program.dimension();
        let vector = format!("[{scalar}; {n}]");
        let has_inputs = !self.inputs.is_empty();
        let inputs_in = match has_inputs {
            true => over(&inputs),
            false => inputs.clone(),
        };
        self.writer.gap();
        self.writer.open(format!(
            "impl<{scalar}: {runtime}::Real> {runtime}::SystemIn<{scalar}> for {} {{",
            over(&prepared)
        ));
        self.writer.line(format!("type Vector = {vector};"));
        self.writer
            .line(format!("type Coordinates = {};", over(&coordinates)));
        self.writer.line(format!("type Inputs = {inputs_in};"));

        let iterator = self.types.known("ExactSizeIterator");
        let default_inputs = match has_inputs {
            true => format!("<{inputs}>::default().map({scalar}::from_f64)"),
            false => format!("{inputs} {{}}"),
        };
        let names = format!("impl {iterator}<Item = {runtime}::Quantity<'_>>");
        let methods = [
            (
                "coordinates",
                "",
                names,
                "COORDINATES.iter().map(quantity)".to_owned(),
            ),
            (
                "to_coordinates",
                &format!("vector: &{vector}"),
                over(&coordinates),
                format!("{coordinates}::from_array(*vector)"),
            ),
            (
                "to_vector",
                &format!("coordinates: &{}", over(&coordinates)),
                vector.clone(),
                "coordinates.to_array()".to_owned(),
            ),
            ("default_inputs", "", inputs_in.clone(), default_inputs),
        ];
        for (method, argument, result, body) in methods {
            let mut arguments = vec!["&self".to_owned()];
            arguments.extend((!argument.is_empty()).then(|| argument.to_owned()));
            self.writer.gap();
            self.writer
                .signature(&format!("fn {method}"), &arguments, Some(&result));
            self.writer.line(body);
            self.writer.close("}");
        }

        let call = self.accelerations_in_place(&scalar, "self");
        let used = match self.emitted(Role::Accelerations) {
            Some(function) => self.arguments(self.needs(function)),
            None => Vec::new(),
        };
        let kinds = [
            ("t", scalar.clone()),
            ("q", format!("&{vector}")),
            ("v", format!("&{vector}")),
            ("u", format!("&{inputs_in}")),
        ];
        let arguments = kinds.map(|(name, kind)| {
            let is_used = used.iter().any(|(used, _)| *used == name);
            format!("{}: {kind}", if is_used { name } else { "_" })
        });
        let arguments: Vec<String> = ["&self".to_owned()]
            .into_iter()
            .chain(arguments)
            .chain([format!("result: &mut {vector}")])
            .collect();
        let result = format!("{}<(), {runtime}::Singular>", self.types.known("Result"));
        self.writer.gap();
        self.writer
            .signature("fn accelerations", &arguments, Some(&result));
        match call {
            Some(call) => call.into_iter().for_each(|line| self.writer.line(line)),
            None => {
                self.writer
                    .line(format!("*result = [{scalar}::ZERO; {n}];"));
                self.writer.line("Ok(())");
            }
        }
        self.writer.close("}");
        self.writer.close("}");
    }
}
