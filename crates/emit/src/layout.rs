//! Text laid out as rustfmt formats it.
//!
//! The macro cannot call rustfmt, and committed code must not change when it is formatted. Emitted code therefore uses
//! only a few constructs, and this module reproduces how default rustfmt breaks each of them; a test verifies this.

/// The widest line.
pub const WIDTH: usize = 100;
/// The widest content on one line of an array, or of the arguments of a call.
const LIST_WIDTH: usize = 60;
/// The widest content of a struct literal on one line.
const STRUCT_WIDTH: usize = 18;
/// The longest item of a list whose items share lines.
const SHORT_ITEM: usize = 10;

/// An expression whose line breaks depend on its position.
#[derive(Clone, Debug)]
pub enum Layout {
    /// A text that is never broken.
    Atom(String),
    /// `[a, b]`, `f(a, b)`: the text before the items, the items, and the text after them.
    List(String, Vec<Layout>, &'static str),
    /// `Name { field: value }`.
    Struct(String, Vec<(String, Layout)>),
}

impl Layout {
    /// An array of atoms.
    pub fn array(items: impl IntoIterator<Item = String>) -> Layout {
        Layout::List(
            "[".into(),
            items.into_iter().map(Layout::Atom).collect(),
            "]",
        )
    }

    /// An array of anything.
    pub fn nested(items: impl IntoIterator<Item = Layout>) -> Layout {
        Layout::List("[".into(), items.into_iter().collect(), "]")
    }

    /// The text on one line, if that is within its width limits.
    fn flat(&self) -> Option<String> {
        match self {
            Layout::Atom(text) => Some(text.clone()),
            Layout::List(open, items, close) => {
                let flat: Option<Vec<String>> = items.iter().map(Layout::flat).collect();
                let content = flat?.join(", ");
                (width(&content) <= LIST_WIDTH).then(|| format!("{open}{content}{close}"))
            }
            Layout::Struct(name, fields) if fields.is_empty() => Some(format!("{name} {{}}")),
            Layout::Struct(name, fields) => {
                let flat: Option<Vec<String>> = fields.iter().map(flat_field).collect();
                let content = flat?.join(", ");
                (width(&content) <= STRUCT_WIDTH).then(|| format!("{name} {{ {content} }}"))
            }
        }
    }

    /// Writes lines that begin at column `indent`, the first after `before`, the last followed by `after`.
    fn write(&self, out: &mut String, indent: usize, before: &str, after: &str) {
        let pad = " ".repeat(indent);
        if let Some(flat) = self.flat() {
            if indent + width(before) + width(&flat) + width(after) <= WIDTH {
                out.push_str(&format!("{pad}{before}{flat}{after}\n"));
                return;
            }
            // An assigned expression moves to the next line rather than being broken.
            if let Some(name) = before.strip_suffix("= ")
                && indent + 4 + width(&flat) + width(after) <= WIDTH
            {
                out.push_str(&format!("{pad}{name}=\n{pad}    {flat}{after}\n"));
                return;
            }
        }
        match self {
            // rustfmt leaves an atom that is too long for its line.
            Layout::Atom(text) => out.push_str(&format!("{pad}{before}{text}{after}\n")),
            Layout::List(open, items, close) => {
                out.push_str(&format!("{pad}{before}{open}\n"));
                match items.iter().map(short).collect::<Option<Vec<&str>>>() {
                    Some(items) => fill(out, indent + 4, &items),
                    None => items
                        .iter()
                        .for_each(|item| item.write(out, indent + 4, "", ",")),
                }
                out.push_str(&format!("{pad}{close}{after}\n"));
            }
            Layout::Struct(name, fields) => {
                out.push_str(&format!("{pad}{before}{name} {{\n"));
                for (field, value) in fields {
                    let shorthand = matches!(value, Layout::Atom(text) if text == field);
                    let before = if shorthand {
                        String::new()
                    } else {
                        format!("{field}: ")
                    };
                    value.write(out, indent + 4, &before, ",");
                }
                out.push_str(&format!("{pad}}}{after}\n"));
            }
        }
    }
}

fn flat_field((field, value): &(String, Layout)) -> Option<String> {
    let value = value.flat()?;
    Some(if value == *field {
        value
    } else {
        format!("{field}: {value}")
    })
}

/// The text of an item that may share a line with others: a name, a field, an element, a literal.
fn short(item: &Layout) -> Option<&str> {
    match item {
        Layout::Atom(text) if width(text) <= SHORT_ITEM && is_simple(text) => Some(text),
        _ => None,
    }
}

fn is_simple(text: &str) -> bool {
    let text = text.strip_prefix('-').unwrap_or(text);
    text.chars()
        .all(|c| c.is_alphanumeric() || "_.[]#".contains(c))
}

/// Puts as many items on a line as fit; rustfmt leaves the last column free.
fn fill(out: &mut String, indent: usize, items: &[&str]) {
    let pad = " ".repeat(indent);
    let mut line = String::new();
    for item in items {
        if !line.is_empty() && indent + width(&line) + 1 + width(item) + 1 >= WIDTH {
            out.push_str(&format!("{pad}{line}\n"));
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(item);
        line.push(',');
    }
    out.push_str(&format!("{pad}{line}\n"));
}

/// The number of columns of a text.
pub fn width(text: &str) -> usize {
    text.chars().count()
}

/// A text that grows line by line.
#[derive(Clone, Debug, Default)]
pub struct Writer {
    out: String,
    indent: usize,
}

impl Writer {
    /// A writer for text that is inserted into a block later.
    pub fn indented(indent: usize) -> Writer {
        Writer {
            out: String::new(),
            indent,
        }
    }

    /// Appends text that is already laid out.
    pub fn raw(&mut self, text: &str) {
        self.out.push_str(text);
    }

    /// The text written so far.
    pub fn finish(self) -> String {
        self.out
    }

    /// The number of columns of a line after indentation.
    pub fn columns(&self) -> usize {
        WIDTH - self.indent
    }

    /// Writes one line; an empty line gets no indentation.
    pub fn line(&mut self, line: impl AsRef<str>) {
        let line = line.as_ref();
        if !line.is_empty() {
            self.out.extend(std::iter::repeat_n(' ', self.indent));
            self.out.push_str(line);
        }
        self.out.push('\n');
    }

    /// Writes `head tail`, on two lines if it does not fit on one.
    pub fn statement(&mut self, head: &str, tail: &str) {
        if width(head) + 1 + width(tail) <= self.columns() {
            return self.line(format!("{head} {tail}"));
        }
        self.open(head);
        self.line(tail);
        self.indent -= 4;
    }

    /// Writes an empty line, unless a block has just begun or an empty line precedes.
    pub fn gap(&mut self) {
        if !self.out.is_empty() && !self.out.ends_with("{\n") && !self.out.ends_with("\n\n") {
            self.out.push('\n');
        }
    }

    /// Writes a line that begins a block; [`close`](Writer::close) ends it.
    pub fn open(&mut self, line: impl AsRef<str>) {
        self.line(line);
        self.indent += 4;
    }

    /// Writes a line between two halves of a block: `} else {`.
    pub fn middle(&mut self, line: &str) {
        self.close(line);
        self.indent += 4;
    }

    /// Writes the line that ends a block.
    pub fn close(&mut self, line: &str) {
        self.indent = self.indent.saturating_sub(4);
        self.line(line);
    }

    /// Writes `before`, the expression, `after`.
    pub fn expression(&mut self, before: &str, layout: &Layout, after: &str) {
        layout.write(&mut self.out, self.indent, before, after);
    }

    /// Writes `head(arguments) -> result {`; [`close`](Writer::close) ends the block.
    pub fn signature(&mut self, head: &str, arguments: &[String], result: Option<&str>) {
        let end = match result {
            Some(result) => format!(") -> {result} {{"),
            None => ") {".to_owned(),
        };
        let line = format!("{head}({}{end}", arguments.join(", "));
        if width(&line) <= self.columns() {
            return self.open(line);
        }
        self.open(format!("{head}("));
        arguments
            .iter()
            .for_each(|argument| self.line(format!("{argument},")));
        self.indent -= 4;
        self.open(end);
    }

    /// Writes a comment, each line after `mark`. Lines wider than the page are wrapped: prose between words, formulas
    /// (between lines of three backquotes) before the signs of terms.
    pub fn comment(&mut self, mark: &str, text: &str) {
        let columns = self.columns() - width(mark) - 1;
        let mut is_formula = false;
        for line in text.lines() {
            is_formula ^= line.starts_with("```");
            if is_formula {
                self.formula(mark, line);
                continue;
            }
            for piece in without_widow(wrap(&words(line), columns, 0)) {
                self.line(format!("{mark} {piece}").trim_end());
            }
        }
    }

    /// Writes a formula as a comment, wrapped before the signs of terms.
    pub fn formula(&mut self, mark: &str, line: &str) {
        let columns = self.columns() - width(mark) - 1;
        for piece in wrap(&terms(line), columns, 4) {
            self.line(format!("{mark} {piece}").trim_end());
        }
    }
}

/// The words of a line of prose, the first with its indentation.
fn words(line: &str) -> Vec<String> {
    let indent = &line[..line.len() - line.trim_start().len()];
    let words = line.split_whitespace().enumerate();
    words
        .map(|(i, word)| {
            if i == 0 {
                format!("{indent}{word}")
            } else {
                word.to_owned()
            }
        })
        .collect()
}

/// The terms of a formula, each with its sign; terms inside brackets are not separated.
fn terms(line: &str) -> Vec<String> {
    let mut terms: Vec<String> = Vec::new();
    let mut depth = 0i32;
    for word in line.split(' ') {
        let is_sign = depth == 0 && (word == "+" || word == "-");
        match terms.last_mut() {
            Some(term) if !is_sign => {
                term.push(' ');
                term.push_str(word);
            }
            _ => terms.push(word.to_owned()),
        }
        let change = |c| match c {
            '(' | '[' => 1,
            ')' | ']' => -1,
            _ => 0,
        };
        depth += word.chars().map(change).sum::<i32>();
    }
    terms
}

/// These lines of prose, of which the last is not a single word: the word before it comes down to it.
fn without_widow(mut lines: Vec<String>) -> Vec<String> {
    if let [.., before, last] = lines.as_mut_slice()
        && !last.contains(' ')
        && let Some((rest, word)) = before.rsplit_once(' ')
        && !rest.trim().is_empty()
    {
        *last = format!("{word} {last}");
        *before = rest.to_owned();
    }
    lines
}

/// Fills lines of at most `columns` columns; all but the first are indented by `hang`. A part that is too long for a line is
/// broken between its words.
fn wrap(parts: &[String], columns: usize, hang: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    let mut put = |part: &str| {
        let indent = if lines.len() > 1 { hang } else { 0 };
        let line = lines.last_mut().expect("there is one from the start");
        if line.is_empty() {
            line.push_str(part);
        } else if indent + width(line) + 1 + width(part) <= columns {
            line.push(' ');
            line.push_str(part);
        } else {
            lines.push(part.to_owned());
        }
    };
    for part in parts {
        if width(part) + hang <= columns {
            put(part);
        } else {
            part.split(' ').for_each(&mut put);
        }
    }
    lines
        .iter_mut()
        .skip(1)
        .for_each(|line| line.insert_str(0, &" ".repeat(hang)));
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(layout: &Layout) -> String {
        let mut writer = Writer::default();
        writer.open("fn f() {");
        writer.expression("let x = ", layout, ";");
        writer.close("}");
        writer.finish()
    }

    /// The tests of `emit::rust` compare whole files with rustfmt itself; these are the rules that rustfmt was
    /// observed to follow.
    #[test]
    fn lists_break_as_rustfmt_breaks_them() {
        let short = |n: usize| Layout::array((0..n).map(|i| format!("t{:04}", 1000 + i)));
        assert_eq!(
            written(&short(8)).lines().count(),
            3,
            "54 columns stay on one line"
        );
        assert_eq!(
            written(&short(14)),
            "fn f() {\n    let x = [\n        t1000, t1001, t1002, t1003, t1004, t1005, t1006, t1007, t1008, \
             t1009, t1010, t1011, t1012,\n        t1013,\n    ];\n}\n"
        );
        let long = Layout::array((0..6).map(|i| format!("longer_than_ten_{i}")));
        assert_eq!(written(&long).lines().count(), 10, "one to a line");
    }

    #[test]
    fn struct_literals_of_more_than_eighteen_columns_are_broken() {
        let fields = |value: &str| {
            let field = |name: &str| (name.to_owned(), Layout::Atom(value.to_owned()));
            Layout::Struct("P".into(), vec![field("a"), field("b")])
        };
        assert_eq!(
            written(&fields("12345")),
            "fn f() {\n    let x = P { a: 12345, b: 12345 };\n}\n"
        );
        assert_eq!(written(&fields("123456")).lines().count(), 6);
    }

    #[test]
    fn no_word_is_left_alone_on_a_line() {
        let mut writer = Writer::default();
        writer.comment(
            "///",
            &format!("{} end", "w".repeat(46) + " " + &"x".repeat(46)),
        );
        let lines = [
            format!("/// {}", "w".repeat(46)),
            format!("/// {} end", "x".repeat(46)),
        ];
        assert_eq!(writer.finish(), lines.join("\n") + "\n");
    }

    #[test]
    fn prose_is_wrapped_between_words() {
        let mut writer = Writer::default();
        writer.comment("///", &format!("{} end", "word ".repeat(25).trim()));
        assert!(
            writer
                .finish()
                .lines()
                .all(|line| width(line) <= WIDTH && line.starts_with("/// "))
        );
    }
}
