//! Resolves definitions in any order, without recursion from one to the next.
//!
//! An attempt to resolve something records what it still needs and continues with an unknown value
//! in its place. What it needs is then resolved first, and the attempt is repeated. So a chain of
//! definitions of any length takes memory but no stack, and a circular definition is detected.

use super::Resolver;
use super::text::show;
use super::value::{MemberId, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;

/// The progress of resolving something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    Pending,
    /// Attempted, and waiting for what it needs.
    InProgress,
    Done,
}

/// Something to resolve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Need {
    /// The members of a family.
    Group(usize),
    /// The value of a definition, a frame, the mass centre of a body.
    Member(MemberId),
    /// The frame of a body.
    Frame(MemberId),
}

/// The largest number of names of a circular definition that a message lists.
const LISTED: usize = 6;

impl<'a, 'd> Resolver<'a, 'd, '_> {
    /// Records that something is needed, at `span`.
    pub(super) fn need(&mut self, need: Need, span: Span) {
        self.needs.push((need, span));
    }

    /// Repeats an attempt until it needs nothing more.
    pub fn repeat_until_resolved<T>(&mut self, mut attempt: impl FnMut(&mut Self) -> T) -> T {
        loop {
            self.needs.clear();
            let result = attempt(self);
            if self.needs.is_empty() {
                return result;
            }
            self.resolve_needs();
        }
    }

    /// Resolves what is recorded as needed, and what that needs in turn.
    fn resolve_needs(&mut self) {
        let mut stack: Vec<Need> = Vec::new();
        // The definitions in progress, each needing the next.
        let mut path: Vec<Need> = Vec::new();
        stack.extend(self.needs.drain(..).rev().map(|(need, _)| need));
        while let Some(&top) = stack.last() {
            if *self.state(top) == State::Done {
                stack.pop();
                continue;
            }
            if *self.state(top) == State::Pending {
                *self.state(top) = State::InProgress;
                path.push(top);
            }
            self.attempt(top);
            if self.needs.is_empty() {
                *self.state(top) = State::Done;
                path.pop();
                stack.pop();
                continue;
            }
            for (need, span) in std::mem::take(&mut self.needs).into_iter().rev() {
                if *self.state(need) == State::InProgress {
                    self.report_cycle(&path, need, span);
                    // It stays unknown, so that the definitions waiting for it can proceed.
                    *self.state(need) = State::Done;
                    path.retain(|&other| other != need);
                } else {
                    stack.push(need);
                }
            }
        }
    }

    fn state(&mut self, need: Need) -> &mut State {
        match need {
            Need::Group(group) => &mut self.groups[group].state,
            Need::Member(member) => &mut self.members[member].state,
            Need::Frame(member) => &mut self.members[member].frame_state,
        }
    }

    fn attempt(&mut self, need: Need) {
        match need {
            Need::Group(group) => self.expand(group),
            Need::Member(member) => {
                let value = self.member_value(member);
                if self.needs.is_empty() {
                    self.members[member].value = value;
                }
            }
            Need::Frame(member) => {
                let frame = self.body_frame(member);
                if self.needs.is_empty() {
                    self.members[member].frame = frame;
                }
            }
        }
    }

    /// Reports a circular definition.
    fn report_cycle(&mut self, path: &[Need], need: Need, span: Span) {
        let begin = path.iter().position(|&other| other == need).unwrap_or(0);
        let names: Vec<String> = path[begin..]
            .iter()
            .map(|&need| self.need_name(need))
            .collect();
        let first = self.need_name(need);
        let message = match names.as_slice() {
            [] | [_] => format!("`{first}` is defined in terms of itself"),
            names => {
                let shown = names.iter().take(LISTED).cloned().collect::<Vec<_>>();
                let more = if names.len() > LISTED {
                    "` needs … needs `"
                } else {
                    "` needs `"
                };
                let circle = shown.join("` needs `");
                format!("a circular definition: `{circle}{more}{first}`")
            }
        };
        if let Need::Group(group) = need {
            self.groups[group].incomplete = true;
        }
        self.push(Diagnostic::new(Code::CircularDefinition, span, message));
    }

    fn need_name(&self, need: Need) -> String {
        match need {
            Need::Group(group) => self.groups[group].base.to_owned(),
            Need::Member(member) | Need::Frame(member) => {
                let member = &self.members[member];
                show(self.groups[member.group].base, member.index)
            }
        }
    }

    /// The value of a member, if it is resolved.
    pub fn value_of(&mut self, member: MemberId, span: Span) -> Value<'d> {
        if self.members[member].state == State::Done {
            return self.members[member].value.clone();
        }
        self.need(Need::Member(member), span);
        Value::Unknown
    }
}
