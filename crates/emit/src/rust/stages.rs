//! The accelerations in stages: the values that a stage passes to the next, and their interface to the runtime.

use super::Emitter;
use super::types::Types;
use crate::layout::Layout;
use lagrangian_program::{Function, Role};
use lagrangian_spec::model::Stages;

impl Emitter<'_> {
    /// The type that a stage returns, if others follow it.
    pub(super) fn stage_type(&self, role: Role) -> Option<&str> {
        match role {
            Role::AtTime => Some(&self.types.at_time),
            Role::AtPosition => Some(&self.types.at_position),
            _ => None,
        }
    }

    /// Whether a function may report that there are no accelerations.
    ///
    /// If there is a stage of coordinates, that stage reports it, and the stage of rates does not repeat it.
    pub(super) fn fails(&self, function: &Function) -> bool {
        let is_settled = function.role == Role::AccelerationsAt
            && self.program.stages.coordinates
            && function.guards.is_empty();
        function.role.inverts() && !is_settled
    }

    /// Writes the structs that stages pass on.
    pub(super) fn stages(&mut self) {
        let Types {
            scalar,
            at_time,
            at_position,
            ..
        } = self.types.clone();
        let structs = [
            (Role::AtTime, at_time, "what time alone decides"),
            (
                Role::AtPosition,
                at_position,
                "what time and coordinates decide",
            ),
        ];
        let (fn_trait, f64) = (self.types.known("Fn"), self.types.known("f64"));
        for (role, name, what) in structs {
            let Some(function) = self.program.function(role) else {
                continue;
            };
            let len = function.results.len();
            self.writer.gap();
            self.docs(&format!(
                "Of the accelerations {what}, as far as it is needed later; made by [`{}`].",
                role.name()
            ));
            self.writer.line("#[derive(Clone, Copy, Debug, PartialEq)]");
            self.writer
                .open(format!("pub struct {name}<{scalar} = {f64}> {{"));
            self.writer.line(format!("values: [{scalar}; {len}],"));
            self.writer.close("}");
            self.writer.gap();
            self.writer
                .open(format!("impl<{scalar}> {name}<{scalar}> {{"));
            self.docs("These values as other numbers: for lanes that share them, splat.");
            self.writer.signature(
                "pub fn map<R>",
                &["self".into(), format!("f: impl {fn_trait}({scalar}) -> R")],
                Some(&format!("{name}<R>")),
            );
            let values = Layout::Atom("self.values.map(f)".into());
            let fields = vec![("values".to_owned(), values)];
            self.writer
                .expression("", &Layout::Struct(name, fields), "");
            self.writer.close("}");
            self.writer.close("}");
        }
    }

    /// Writes `Staged`, if any stage is requested.
    pub(super) fn impl_staged(&mut self) {
        let Stages { time, coordinates } = self.program.stages;
        let Some(last) = self.program.function(Role::AccelerationsAt) else {
            return;
        };
        let runtime = self.options.runtime.clone();
        let n = self.program.dimension();
        let f64 = self.types.known("f64");
        let vector = format!("[{f64}; {n}]");
        let result_type = |ok_type: &str| {
            format!(
                "{}<{ok_type}, {runtime}::Singular>",
                self.types.known("Result")
            )
        };
        let (position_result, last_result) = (result_type("Self::AtPosition"), result_type("()"));
        let after_time = if time {
            self.types.at_time.clone()
        } else {
            f64.clone()
        };
        let after_position = if coordinates {
            self.types.at_position.clone()
        } else {
            format!("({after_time}, {vector})")
        };
        let call = |role: Role| {
            let function = self.program.function(role)?;
            let call = self.call_with(&role.name(), self.needs(function));
            Some((call, self.needs(function), self.fails(function)))
        };
        let calls = [Role::AtTime, Role::AtPosition].map(call);
        let [of_time, of_position] = calls;
        let last_call = self.call_with(&Role::AccelerationsAt.name(), self.needs(last));
        let (needs, fails) = (self.needs(last), self.fails(last));
        let shown = |name: &str, is_read: bool, kind: &str| {
            format!("{}: {kind}", if is_read { name } else { "_" })
        };

        self.writer.gap();
        self.writer.open(format!(
            "impl {runtime}::Staged for {} {{",
            self.types.prepared
        ));
        self.writer.line(format!("type AtTime = {after_time};"));
        self.writer
            .line(format!("type AtPosition = {after_position};"));

        self.writer.gap();
        let reads_time = of_time.as_ref().is_none_or(|(_, needs, _)| needs.time);
        self.writer.signature(
            "fn at_time",
            &["&self".into(), shown("t", reads_time, &f64)],
            Some("Self::AtTime"),
        );
        match of_time {
            Some((call, ..)) => self.writer.line(call),
            None => self.writer.line("t"),
        }
        self.writer.close("}");

        self.writer.gap();
        let reads = of_position.as_ref().map(|(_, needs, _)| *needs);
        let reads_before = reads.is_none_or(|reads| reads.at_time || reads.time);
        self.writer.signature(
            "fn at_position",
            &[
                "&self".into(),
                shown("at", reads_before, "&Self::AtTime"),
                shown(
                    "q",
                    reads.is_none_or(|reads| reads.coordinates),
                    &format!("&{vector}"),
                ),
            ],
            Some(&position_result),
        );
        match of_position {
            Some((call, reads, _)) => {
                if reads.time {
                    self.writer.line("let t = *at;");
                }
                self.writer.line(call);
            }
            None => self.writer.line("Ok((*at, *q))"),
        }
        self.writer.close("}");

        self.writer.gap();
        let reads_before =
            needs.at_position || (!coordinates && (needs.at_time || needs.coordinates));
        self.writer.signature(
            "fn accelerations_at",
            &[
                "&self".into(),
                shown("at", reads_before, "&Self::AtPosition"),
                shown("v", needs.velocities, &format!("&{vector}")),
                shown("u", needs.inputs, "&Self::Inputs"),
                format!("a: &mut {vector}"),
            ],
            Some(&last_result),
        );
        if !coordinates && reads_before {
            let at = if needs.at_time { "at" } else { "_" };
            let q = if needs.coordinates { "q" } else { "_" };
            self.writer.line(format!("let ({at}, {q}) = at;"));
        }
        let question = if fails { "?" } else { "" };
        self.writer.line(format!("*a = {last_call}{question};"));
        self.writer.line("Ok(())");
        self.writer.close("}");
        self.writer.close("}");
    }
}
