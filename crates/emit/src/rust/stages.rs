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
        let f64 = self.types.known("f64");
        let vector = format!("[{f64}; {}]", self.program.dimension());
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
        self.writer.gap();
        self.writer.open(format!(
            "impl {}::Staged for {} {{",
            self.options.runtime, self.types.prepared
        ));
        self.writer.line(format!("type AtTime = {after_time};"));
        self.writer
            .line(format!("type AtPosition = {after_position};"));
        self.at_time(&f64);
        self.at_position(&vector);
        self.accelerations_at(last, &vector);
        self.writer.close("}");
    }

    /// A `Result` with the error that there are no accelerations.
    fn or_singular(&self, ok_type: &str) -> String {
        let result = self.types.known("Result");
        format!("{result}<{ok_type}, {}::Singular>", self.options.runtime)
    }

    /// Writes `at_time`: without a stage of time, time itself.
    fn at_time(&mut self, f64: &str) {
        let function = self.program.function(Role::AtTime);
        let reads_time = function.is_none_or(|function| self.needs(function).time);
        self.writer.gap();
        self.writer.signature(
            "fn at_time",
            &["&self".into(), argument("t", reads_time, f64)],
            Some("Self::AtTime"),
        );
        match function {
            Some(function) => {
                let call = self.call_with(&Role::AtTime.name(), self.needs(function));
                self.writer.line(call);
            }
            None => self.writer.line("t"),
        }
        self.writer.close("}");
    }

    /// Writes `at_position`: without a stage of coordinates, what was known before and the coordinates.
    fn at_position(&mut self, vector: &str) {
        let function = self.program.function(Role::AtPosition);
        let reads = function.map(|function| self.needs(function));
        let reads_before = reads.is_none_or(|reads| reads.at_time || reads.time);
        let reads_coordinates = reads.is_none_or(|reads| reads.coordinates);
        let result = self.or_singular("Self::AtPosition");
        self.writer.gap();
        self.writer.signature(
            "fn at_position",
            &[
                "&self".into(),
                argument("at", reads_before, "&Self::AtTime"),
                argument("q", reads_coordinates, &format!("&{vector}")),
            ],
            Some(&result),
        );
        match reads {
            Some(reads) => {
                if reads.time {
                    self.writer.line("let t = *at;");
                }
                let call = self.call_with(&Role::AtPosition.name(), reads);
                self.writer.line(call);
            }
            None => self.writer.line("Ok((*at, *q))"),
        }
        self.writer.close("}");
    }

    /// Writes `accelerations_at`, the last stage.
    fn accelerations_at(&mut self, last: &Function, vector: &str) {
        let coordinates = self.program.stages.coordinates;
        let needs = self.needs(last);
        let call = self.call_with(&Role::AccelerationsAt.name(), needs);
        let result = self.or_singular("()");
        let reads_before =
            needs.at_position || (!coordinates && (needs.at_time || needs.coordinates));
        self.writer.gap();
        self.writer.signature(
            "fn accelerations_at",
            &[
                "&self".into(),
                argument("at", reads_before, "&Self::AtPosition"),
                argument("v", needs.velocities, &format!("&{vector}")),
                argument("u", needs.inputs, "&Self::Inputs"),
                format!("a: &mut {vector}"),
            ],
            Some(&result),
        );
        if !coordinates && reads_before {
            let at = if needs.at_time { "at" } else { "_" };
            let q = if needs.coordinates { "q" } else { "_" };
            self.writer.line(format!("let ({at}, {q}) = at;"));
        }
        let question = if self.fails(last) { "?" } else { "" };
        self.writer.line(format!("*a = {call}{question};"));
        self.writer.line("Ok(())");
        self.writer.close("}");
    }
}

/// An argument of a function, which may not read it.
fn argument(name: &str, is_read: bool, kind: &str) -> String {
    format!("{}: {kind}", if is_read { name } else { "_" })
}
