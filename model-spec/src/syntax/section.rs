//! Sections of elements, as far as the parser needs to know them.
//!
//! Each element is defined in a file of its own, and the parser receives the list of these files:
//! nothing here names any of them.

use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};

/// The syntax of a section of elements, and the words for its items.
///
/// Two sections are equal if they have the same heading word.
#[derive(Clone, Copy)]
pub struct Section {
    /// The heading word: `springs`.
    pub word: &'static str,
    /// The phrase for one of its items in messages: `a spring`.
    pub item: &'static str,
    /// The noun before the name of an element, in the chapter and in messages: `spring`. Empty if the
    /// name alone is clear.
    pub noun: &'static str,
    /// The form of its items.
    pub form: Form,
    /// An example of an item, for messages.
    pub help: &'static str,
}

/// The form of an item of a section of elements.
#[derive(Clone, Copy, Debug)]
pub enum Form {
    /// `name { field: value, … }`, with the fields that it can have.
    ///
    /// The parser accepts no other field, and none twice. Conflicts between fields are detected when
    /// they are used.
    Records(&'static [&'static str]),
    /// `name: expression`
    Expressions,
    /// `name: left = right`
    Equations,
    /// The section is a single statement, `word expression;` or `word none;`.
    Statement,
}

impl Section {
    /// The fields that an item can have; none if its items are not records.
    pub fn fields(&self) -> &'static [&'static str] {
        match self.form {
            Form::Records(fields) => fields,
            Form::Expressions | Form::Equations | Form::Statement => &[],
        }
    }
}

impl PartialEq for Section {
    fn eq(&self, other: &Section) -> bool {
        self.word == other.word
    }
}

impl Eq for Section {}

impl PartialOrd for Section {
    fn partial_cmp(&self, other: &Section) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Section {
    fn cmp(&self, other: &Section) -> Ordering {
        self.word.cmp(other.word)
    }
}

impl Hash for Section {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.word.hash(state);
    }
}

impl fmt::Debug for Section {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word)
    }
}
