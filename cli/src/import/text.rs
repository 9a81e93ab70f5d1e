//! The text of a spec, section by section, with lines broken as a person would.

use std::fmt::Write as _;

/// Lines are broken before this column.
const WIDTH: usize = 108;

/// A machine under construction.
#[derive(Default)]
pub struct Text {
    sections: Vec<(&'static str, Vec<Item>)>,
}

/// Entries below a common comment.
struct Item {
    comment: Option<String>,
    entries: Vec<String>,
}

impl Text {
    /// Sections in the order in which they are written. Empty ones are left out.
    pub fn new(sections: &[&'static str]) -> Text {
        Text {
            sections: sections.iter().map(|name| (*name, Vec::new())).collect(),
        }
    }

    /// Adds entries to a section, with a comment above the first.
    pub fn add(&mut self, section: &str, comment: Option<String>, entries: Vec<String>) {
        let place = self.sections.iter_mut().find(|(name, _)| *name == section);
        if let (Some((_, items)), false) = (place, entries.is_empty()) {
            items.push(Item { comment, entries });
        }
    }

    /// The number of entries of a section.
    pub fn count(&self, section: &str) -> usize {
        let place = self.sections.iter().find(|(name, _)| *name == section);
        place.map_or(0, |(_, items)| {
            items.iter().map(|item| item.entries.len()).sum()
        })
    }

    /// The whole machine. `gravity` is written after the bodies.
    pub fn to_text(&self, name: &str, comment: &[String], gravity: &str) -> String {
        let mut text = String::new();
        for paragraph in comment {
            wrap(&mut text, "", paragraph);
        }
        let _ = writeln!(text, "machine {name} in space {{");
        for (section, items) in &self.sections {
            if !items.is_empty() {
                let _ = writeln!(text, "    {section} {{");
                items.iter().for_each(|item| item.write(&mut text));
                text.push_str("    }\n");
            }
            if *section == "bodies" {
                let _ = writeln!(text, "    gravity {gravity};");
            }
        }
        text.push_str("}\n");
        text
    }
}

impl Item {
    fn write(&self, text: &mut String) {
        const INDENT: &str = "        ";
        if let Some(comment) = &self.comment {
            wrap(text, INDENT, comment);
        }
        let mut line = INDENT.to_owned();
        for entry in &self.entries {
            let is_full = line.chars().count() + entry.chars().count() + 2 > WIDTH;
            if is_full && line != INDENT {
                text.push_str(line.trim_end());
                text.push('\n');
                INDENT.clone_into(&mut line);
            }
            let _ = write!(line, "{entry}, ");
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
}

/// A doc comment, wrapped to as many lines as needed.
fn wrap(text: &mut String, indent: &str, comment: &str) {
    let mut line = format!("{indent}///");
    for word in comment.split(' ').filter(|word| !word.is_empty()) {
        if line.chars().count() + 1 + word.chars().count() > WIDTH && line.len() > indent.len() + 3
        {
            let _ = writeln!(text, "{line}");
            line = format!("{indent}///");
        }
        let _ = write!(line, " {word}");
    }
    let _ = writeln!(text, "{line}");
}

/// The definition of a frame relative to another, with its steps on further lines if they do not fit on one.
pub fn frame(name: &str, base: &str, steps: &[String]) -> String {
    let line = format!("{name} = {base}{}", steps.concat());
    if line.chars().count() + 9 <= WIDTH {
        return line;
    }
    let mut text = format!("{name} = {base}");
    for step in steps {
        let _ = write!(text, "\n            {step}");
    }
    text
}

/// A body with its fields, on separate lines if they do not fit on one.
pub fn body(name: &str, fields: &[String]) -> String {
    let line = format!("{name} {{ {} }}", fields.join(", "));
    if line.chars().count() + 9 <= WIDTH {
        return line;
    }
    let mut text = format!("{name} {{");
    for field in fields {
        let _ = write!(text, "\n            {field},");
    }
    text.push_str("\n        }");
    text
}
