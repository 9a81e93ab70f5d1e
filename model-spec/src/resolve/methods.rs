//! The integration methods for which emitted code needs more than accelerations.

use super::Resolver;
use super::names::{suggestion, with_help};
use super::value::MemberId;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::Index;

/// Methods that need more than accelerations.
const WORDS: [&str; 1] = ["taylor"];

impl Resolver<'_, '_, '_> {
    /// The place where an item of `methods` requests the Taylor series of the motion.
    pub fn method(&mut self, member: MemberId) -> Option<Span> {
        let name = self.declaration(member).name;
        let word = name.base.text.as_str();
        if !WORDS.contains(&word) {
            if !self.incomplete && !word.is_empty() {
                let message = format!("no method that needs additional code is named `{word}`");
                let unknown = Diagnostic::new(Code::UnknownName, name.base.span, message);
                let help = suggestion(word, WORDS);
                self.push(with_help(unknown, help));
            }
            return None;
        }
        if name.index != Index::None {
            let message = format!("`{word}` is one method and has no index");
            self.error(Code::NotAFamily, name.span, message);
        }
        Some(name.span)
    }
}
