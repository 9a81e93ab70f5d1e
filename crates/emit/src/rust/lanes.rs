//! Several systems at once: what the runtime's `Batch` asks of emitted code.

use super::Emitter;
use super::structs::with_field;
use super::types::Types;
use crate::layout::{self, Layout};
use lagrangian_program::Role;

impl Emitter<'_> {
    /// `Batched`: fields put side by side, and the function that runs them.
    pub(super) fn impl_batched(&mut self) {
        let runtime = self.options.runtime.clone();
        let Types {
            prepared,
            inputs,
            register: lanes,
            ..
        } = self.types.clone();
        let [f64, usize, bool, result] =
            ["f64", "usize", "bool", "Result"].map(|name| self.types.known(name));
        let number = format!("{runtime}::Lanes<{lanes}>");
        let has_inputs = !self.inputs.is_empty();
        let batch_inputs = match has_inputs {
            true => format!("{inputs}<{number}>"),
            false => inputs.clone(),
        };
        let n = self.program.dimension();
        self.writer.gap();
        self.writer.line(format!(
            "impl<const {lanes}: {usize}> {runtime}::Batched<{lanes}> for {prepared}"
        ));
        self.writer.line("where");
        self.writer
            .line(format!("    {number}: {runtime}::Number,"));
        self.writer.open("{");
        self.writer
            .line(format!("type Batch = {prepared}<{number}>;"));
        self.writer.line(format!("type Vectors = [{number}; {n}];"));
        self.writer
            .line(format!("type BatchInputs = {batch_inputs};"));

        // A number of every system as lanes.
        let gather = format!("let lanes = |number: fn(&Self) -> {f64}|");
        self.writer.gap();
        let is_empty = self.prepared.is_empty();
        let has_series = self.number_of_constants_of_series().is_some();
        let argument = if is_empty && !has_series {
            "_"
        } else {
            "systems"
        };
        self.writer.signature(
            "fn batch",
            &[format!("{argument}: [&Self; {lanes}]")],
            Some("Self::Batch"),
        );
        if !is_empty {
            self.writer
                .line(format!("{gather} {runtime}::Lanes(systems.map(number));"));
        }
        let has_guards = !self.program.prepare.guards.is_empty();
        let mut value =
            self.prepared_literal(|slot| format!("lanes(|p| p.{})", self.prepared[slot]), &[]);
        if let (Layout::Struct(_, fields), true) = (&mut value, has_guards) {
            fields.push(("singular".into(), Layout::Atom("None".into())));
        }
        if has_series {
            self.writer.line(format!(
                "let member = |i: {usize}| {runtime}::Lanes(systems.map(|p| p.series[i]));"
            ));
        }
        let series = self.number_of_constants_of_series().map(|_| {
            let value = "::core::array::from_fn(member)".to_owned();
            ("series".to_owned(), Layout::Atom(value))
        });
        let value = with_field(value, series);
        self.writer.expression("", &value, "");
        self.writer.close("}");

        self.writer.gap();
        let argument = if has_inputs { "inputs" } else { "_" };
        self.writer.signature(
            "fn batch_inputs",
            &[format!("{argument}: [&{inputs}; {lanes}]")],
            Some("Self::BatchInputs"),
        );
        let value = match has_inputs {
            true => {
                self.writer.line(format!(
                    "let lanes = |number: fn(&{inputs}) -> {f64}| {runtime}::Lanes(inputs.map(number));"
                ));
                let paths = &self.inputs.paths;
                self.inputs
                    .literal(&inputs, |slot| format!("lanes(|u| u.{})", paths[slot]))
            }
            false => Layout::Struct(inputs.clone(), Vec::new()),
        };
        self.writer.expression("", &value, "");
        self.writer.close("}");

        self.writer.gap();
        let [several, lane] = match has_inputs {
            true => ["inputs", "lane"],
            false => ["_", "_"],
        };
        self.writer.signature(
            "fn inputs_of_lane",
            &[
                format!("{several}: &Self::BatchInputs"),
                format!("{lane}: {usize}"),
            ],
            Some(&inputs),
        );
        let value = match has_inputs {
            true => {
                let paths = &self.inputs.paths;
                self.inputs
                    .literal(&inputs, |slot| format!("inputs.{}[lane]", paths[slot]))
            }
            false => Layout::Struct(inputs.clone(), Vec::new()),
        };
        self.writer.expression("", &value, "");
        self.writer.close("}");

        self.writer.gap();
        self.writer
            .signature("fn is_singular", &["&self".into()], Some(&bool));
        self.writer.line(match has_guards {
            true => "self.singular.is_some()",
            false => "false",
        });
        self.writer.close("}");

        self.batch_accelerations(&number, &format!("{result}<(), {runtime}::Singular>"));
        self.writer.close("}");
    }

    fn batch_accelerations(&mut self, number: &str, result: &str) {
        let n = self.program.dimension();
        let call = self.accelerations_in_place(number, "p");
        let used = match self.emitted(Role::Accelerations) {
            Some(function) => self.arguments(self.needs(function)),
            None => Vec::new(),
        };
        let arguments = [
            ("p", "&Self::Batch"),
            ("t", number),
            ("q", "&Self::Vectors"),
            ("v", "&Self::Vectors"),
            ("u", "&Self::BatchInputs"),
        ]
        .map(|(name, kind)| {
            let is_used = used.iter().any(|(used, _)| *used == name);
            let shown = if is_used { name } else { "_" };
            format!("{shown}: {kind}")
        })
        .into_iter()
        .chain(["result: &mut Self::Vectors".to_owned()])
        .collect::<Vec<_>>();
        self.writer.gap();
        self.writer
            .signature("fn batch_accelerations", &arguments, Some(result));
        match call {
            Some(call) => call.into_iter().for_each(|line| self.writer.line(line)),
            None => {
                let runtime = self.options.runtime.clone();
                self.writer
                    .line(format!("*result = [{runtime}::Lanes::splat(0.0); {n}];"));
                self.writer.line("Ok(())");
            }
        }
        self.writer.close("}");
    }

    /// The accelerations of `equations` on numbers of this type, computed where `result` points to; `None` if there is no
    /// function for them.
    pub(super) fn accelerations_in_place(
        &self,
        number: &str,
        equations: &str,
    ) -> Option<Vec<String>> {
        let function = self.emitted(Role::Accelerations)?;
        let runtime = &self.options.runtime;
        let [call, _] = self.names(Role::Accelerations);
        let arguments = self.arguments(self.needs(function));
        let fields: Vec<String> = arguments
            .iter()
            .map(|(name, _)| match *name {
                "p" if equations != "p" => format!("p: {equations}"),
                name => name.to_owned(),
            })
            .collect();
        let kernel = match fields.is_empty() {
            true => format!("{call}(::core::marker::PhantomData::<{number}>)"),
            false => format!("{call} {{ {} }}", fields.join(", ")),
        };
        let head = format!("<{number} as {runtime}::Number>::run_in_place(");
        let whole = format!("{head}{kernel}, result)");
        // As rustfmt has it: this is the whole of a method.
        Some(match whole.chars().count() <= layout::WIDTH - 8 {
            true => vec![whole],
            false => vec![
                head,
                format!("    {kernel},"),
                "    result,".to_owned(),
                ")".to_owned(),
            ],
        })
    }
}
