//! Which stages of the accelerations are to be computed by themselves.

use super::Resolver;
use super::names::{suggestion, with_help};
use super::value::MemberId;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::Stages;
use crate::syntax::Index;

/// What may stay while the rest changes.
const WORDS: [&str; 2] = ["time", "coordinates"];

impl Resolver<'_, '_, '_> {
    /// What an item of `stages` asks for.
    pub fn stage(&mut self, member: MemberId) -> Stages {
        let name = self.declaration(member).name;
        let word = name.base.text.as_str();
        if !WORDS.contains(&word) {
            if !self.incomplete && !word.is_empty() {
                let message = format!("no stage is named `{word}`");
                let unknown = Diagnostic::new(Code::UnknownName, name.base.span, message);
                let help = suggestion(word, WORDS);
                self.push(with_help(unknown, help));
            }
            return Stages::default();
        }
        if name.index != Index::None {
            let message = format!("`{word}` is one stage and has no index");
            self.error(Code::NotAFamily, name.span, message);
        }
        Stages {
            time: word == "time",
            coordinates: word == "coordinates",
        }
    }
}
