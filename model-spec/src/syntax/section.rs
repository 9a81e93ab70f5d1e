//! Sections of elements, as the parser has to know them.
//!
//! What an element is stands in one file of its own, and the list of these files is handed to the
//! parser: nothing here names any of them.

use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};

/// How a section of elements is written, and what its items are called.
///
/// Two of them are the same if the same word heads them.
#[derive(Clone, Copy)]
pub struct Section {
    /// The word that heads it: `springs`.
    pub word: &'static str,
    /// One of its items, as a message calls it: `a spring`.
    pub item: &'static str,
    /// What stands before the name of an element, in the chapter and in messages: `spring`. Empty where
    /// the name says it.
    pub noun: &'static str,
    /// What an item says.
    pub form: Form,
    /// How one is written, for messages.
    pub help: &'static str,
}

/// What an item of a section of elements says.
#[derive(Clone, Copy, Debug)]
pub enum Form {
    /// `name { field: value, … }`: the fields that it can have.
    ///
    /// The parser accepts no other field and none twice. Which of them go together is checked when they
    /// are used.
    Records(&'static [&'static str]),
    /// `name: expression`
    Expressions,
    /// `name: left = right`
    Equations,
    /// The section is a single statement, `word expression;` or `word none;`.
    Statement,
}

impl Section {
    /// The fields that an item can have; none where its items are no records.
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
