//! A writer of XML elements with attributes, which is all that a description needs.

use std::fmt::Write as _;

/// A document under construction.
pub struct Document {
    text: String,
    open: Vec<&'static str>,
}

/// Names and values, in order.
pub type Attributes<'a> = &'a [(&'a str, &'a str)];

impl Document {
    /// An empty document.
    pub fn new() -> Document {
        Document {
            text: "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned(),
            open: Vec::new(),
        }
    }

    /// Opens an element, which contains what follows.
    pub fn open(&mut self, name: &'static str, attributes: Attributes<'_>) {
        self.element(name, attributes, ">");
        self.open.push(name);
    }

    /// An element without content.
    pub fn leaf(&mut self, name: &str, attributes: Attributes<'_>) {
        self.element(name, attributes, "/>");
    }

    /// An element without content, whose empty attributes are written too.
    pub fn element_with_empty(&mut self, name: &str, attributes: Attributes<'_>) {
        self.write(name, attributes.iter(), "/>");
    }

    /// Closes the innermost open element.
    pub fn close(&mut self) {
        if let Some(name) = self.open.pop() {
            self.text.push_str(&"  ".repeat(self.open.len()));
            let _ = writeln!(self.text, "</{name}>"); // writing to a String cannot fail
        }
    }

    /// The text, with all elements closed.
    pub fn finish(mut self) -> String {
        while !self.open.is_empty() {
            self.close();
        }
        self.text
    }

    fn element(&mut self, name: &str, attributes: Attributes<'_>, end: &str) {
        let nonempty = attributes.iter().filter(|(_, value)| !value.is_empty());
        self.write(name, nonempty, end);
    }

    fn write<'a>(
        &mut self,
        name: &str,
        attributes: impl Iterator<Item = &'a (&'a str, &'a str)>,
        end: &str,
    ) {
        self.text.push_str(&"  ".repeat(self.open.len()));
        let _ = write!(self.text, "<{name}"); // writing to a String cannot fail
        for (key, value) in attributes {
            let _ = write!(self.text, " {key}=\"{}\"", escaped(value));
        }
        self.text.push_str(end);
        self.text.push('\n');
    }
}

/// The escaped value of an attribute.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\n' => escaped.push_str("&#10;"),
            '\t' => escaped.push_str("&#9;"),
            // Characters that XML does not allow.
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_means_something_is_escaped() {
        let mut document = Document::new();
        document.open("a", &[("b", "1 < 2 & \"x\""), ("none", "")]);
        document.leaf("c", &[("d", "\u{1}ü\n")]);
        let known = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<a b=\"1 &lt; 2 &amp; &quot;x&quot;\">\n  <c d=\"\u{fffd}ü&#10;\"/>\n</a>\n";
        assert_eq!(document.finish(), known);
    }
}
