//! The stages of the accelerations that are to be computed separately.

use super::Resolver;
use super::names::{suggestion, with_help};
use super::value::MemberId;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::Stages;
use crate::syntax::Index;

/// The arguments that may stay constant while others change.
const WORDS: [&str; 2] = ["time", "coordinates"];

impl Resolver<'_, '_, '_> {
    /// The stages that an item of `stages` requests.
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
