//! The documentation of a spec as Rust documentation.

use std::fmt::Write as _;

use crate::names::Field;
use lagrangian_program::Slot;
use lagrangian_spec::model::Name;
use lagrangian_units::{rate_unit, state_of};

/// Converts documentation of the spec to Rust documentation, such that nothing in it becomes a doc test.
pub(super) fn prose(docs: &str) -> String {
    let mut is_open = false;
    let lines = docs.lines().map(|line| {
        let line = line.trim(); // four blanks would begin a code block
        if line.starts_with("```") || line.starts_with("~~~") {
            is_open = !is_open;
            let mark = &line[..3];
            return if is_open {
                format!("{mark}text")
            } else {
                mark.to_owned()
            };
        }
        line.to_owned()
    });
    let mut text = lines.collect::<Vec<_>>().join("\n").trim().to_owned();
    if is_open {
        text.push_str("\n```");
    }
    text
}

/// The documentation of a field: the spec's text, its unit, its default.
pub(super) fn field_docs(field: &Field, slots: &[Slot], with_default: bool) -> String {
    let slot = &slots[field.slots[0]];
    if !field.is_family {
        return slot_docs(&slot.name, slot, with_default);
    }
    let name = Name {
        base: slot.name.base.clone(),
        index: None,
    };
    let members: Vec<String> = match field.slots.as_slice() {
        [first, .., last] => vec![
            slots[*first].name.to_string(),
            slots[*last].name.to_string(),
        ],
        [one] => vec![slots[*one].name.to_string()],
        [] => Vec::new(),
    };
    let docs = slot_docs(&name, slot, false);
    format!("{docs} Members: `{}`.", members.join("` to `"))
}

pub(super) fn slot_docs(name: &Name, slot: &Slot, with_default: bool) -> String {
    let mut docs = prose(&slot.docs);
    if docs.is_empty() {
        docs = format!(
            "`{}`.",
            state_of(&name.to_string()).unwrap_or_else(|| name.to_string())
        );
    } else if !docs.ends_with(['.', '!', '?', ':', '`']) {
        docs.push('.');
    }
    // After a list or a code block a sentence must be a paragraph of its own.
    let is_plain = !docs.contains("```")
        && !docs
            .lines()
            .any(|line| line.starts_with(['-', '*', '|', '#', '>']));
    docs.push_str(if is_plain { " " } else { "\n\n" });
    // Writing to a String cannot fail.
    let _ = match state_of(&name.to_string()) {
        Some(state) => write!(
            docs,
            "Among rates the state `{state}`, in `{}`; among coordinates its integral over time, on which nothing depends.",
            rate_unit(&name.to_string(), &slot.unit_text)
        ),
        None => write!(docs, "Unit: `{}`.", slot.unit_text),
    };
    if let Some(default) = slot.default.as_ref().filter(|_| with_default) {
        let _ = write!(docs, " Default: {}.", default.text);
    }
    docs
}
