//! Converts names of a file to names of a spec: letters, digits and underscores, without duplicates.

use std::collections::HashSet;

use lagrangian_emit::names::word;
use lagrangian_spec::token::normalized;
use lagrangian_spec::unit::Measure;

/// Words with another meaning in a spec or in Rust.
const TAKEN: [&str; 35] = [
    "_",
    "self",
    "Self",
    "super",
    "crate",
    "t",
    "pi",
    "ground",
    "der",
    "sin",
    "cos",
    "tan",
    "asin",
    "acos",
    "atan",
    "atan2",
    "sinh",
    "cosh",
    "tanh",
    "exp",
    "ln",
    "sqrt",
    "abs",
    "sign",
    "min",
    "max",
    "dot",
    "cross",
    "norm",
    "direction",
    "polar",
    "for",
    "in",
    "remove",
    "origin",
];

/// The names of one kind that are in use.
#[derive(Default)]
pub struct Names {
    given: HashSet<String>,
}

impl Names {
    /// Registers a name that is used as it is.
    pub fn keep(&mut self, name: &str) -> String {
        self.given.insert(name.to_owned());
        name.to_owned()
    }

    /// A unique name, as close as possible to that of the file. `kind` is a word for the named thing; it precedes names that
    /// cannot stand alone.
    pub fn take(&mut self, name: &str, kind: &str) -> String {
        let name = identifier(name, kind);
        if self.given.insert(name.clone()) {
            return name;
        }
        let mut number = 2_usize;
        loop {
            let numbered = format!("{name}_{number}");
            if self.given.insert(numbered.clone()) {
                return numbered;
            }
            number += 1;
        }
    }
}

/// A valid name for a spec.
fn identifier(name: &str, kind: &str) -> String {
    let name = word(&normalized(name), char::is_alphanumeric);
    let is_taken = TAKEN.contains(&name.as_str()) || Measure::named(&name).is_some();
    match name.chars().next() {
        _ if name.chars().all(|c| c == '_') => kind.to_owned(),
        Some(first) if !first.is_alphabetic() && first != '_' => format!("{kind}_{name}"),
        _ if is_taken => format!("{name}_{kind}"),
        _ => name,
    }
}

/// A name for a machine, such as `VibratingCrusher`.
pub fn machine(name: &str) -> String {
    let name = normalized(name);
    let words = name.split(|c: char| !c.is_alphanumeric());
    let mut machine = String::new();
    for word in words {
        let mut letters = word.chars();
        machine.extend(letters.next().into_iter().flat_map(char::to_uppercase));
        machine.extend(letters);
    }
    match machine.chars().next() {
        Some(first) if first.is_uppercase() && machine != "Self" => machine,
        _ => format!("Robot{machine}"),
    }
}

/// A text of the file, quoted for a comment on one line.
pub fn quoted(text: &str) -> String {
    let visible = |c: char| {
        if c.is_control() || "\u{2028}\u{2029}".contains(c) {
            ' '
        } else {
            c
        }
    };
    format!("\"{}\"", text.chars().map(visible).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_kept_or_near() {
        let mut names = Names::default();
        for (name, given) in [
            ("elbow", "elbow"),
            ("left-hip", "left_hip"),
            ("left hip", "left_hip_2"),
            ("left_hip_2", "left_hip_2_2"),
            ("1st", "joint_1st"),
            ("--", "joint"),
            ("t", "t_joint"),
            ("rad", "rad_joint"),
            ("sin", "sin_joint"),
            ("_hidden", "_hidden"),
            ("дверь", "дверь"),
            ("e\u{301}", "é"),
        ] {
            assert_eq!(names.take(name, "joint"), given);
        }
        for (name, given) in [
            ("six-joint arm", "SixJointArm"),
            ("self", "RobotSelf"),
            ("7dof", "Robot7dof"),
            ("", "Robot"),
            ("ur5e", "Ur5e"),
        ] {
            assert_eq!(machine(name), given);
        }
    }
}
