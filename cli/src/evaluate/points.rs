//! Parses the points at which quantities are evaluated from JSON, and reports line and column of errors.
//!
//! The text is parsed level by level, with each value kept as a slice of the text, so that its position is known.

use std::borrow::Cow;
use std::fmt;

use lagrangian_spec::token::normalized;
use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;

/// A state at which quantities are evaluated; fields that are left out take their defaults.
#[derive(Debug, Default, PartialEq)]
pub struct Point {
    /// The time, in s.
    pub t: Option<f64>,
    /// Coordinates.
    pub q: Option<Numbers>,
    /// Their rates.
    pub v: Option<Numbers>,
    /// States of first order.
    pub states: Option<Numbers>,
    /// Parameters by name.
    pub parameters: Vec<(String, Entry)>,
    /// Inputs by name.
    pub inputs: Vec<(String, Entry)>,
}

/// Coordinates in order, or by name.
#[derive(Debug, PartialEq)]
pub enum Numbers {
    /// All coordinates, in order.
    List(Vec<f64>),
    /// Some coordinates, in the order of the text.
    ByName(Vec<(String, Entry)>),
}

/// A number, or the numbers of a family.
#[derive(Debug, PartialEq)]
pub enum Entry {
    /// One number; under the name of a family it applies to all its members.
    One(f64),
    /// A number for each member.
    Family(Vec<f64>),
}

/// The fields that a point may have.
const FIELDS: [&str; 6] = ["t", "q", "v", "states", "parameters", "inputs"];

/// Reads a list of points from a text; `name` is the name of the text in messages. Invalid points do not affect the others.
///
/// # Errors
/// If the text is not a list of values.
pub fn read(name: &str, text: &str) -> Result<Vec<Result<Point, String>>, String> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let reader = Reader { name, text };
    let list: Vec<&RawValue> = match serde_json::from_str(text) {
        Ok(list) => list,
        Err(error) if error.is_data() => {
            let at = text.len() - text.trim_start().len();
            return Err(reader.message_at(at, "expected a list of points, `[{\"q\": …}, …]`"));
        }
        Err(error) => return Err(reader.no_json(&error)),
    };
    let numbered = list.into_iter().enumerate();
    let points = numbered.map(|(index, value)| {
        let point = reader.point(value);
        point.map_err(|(at, what)| {
            let message = format!("point {}: {what}", index + 1);
            reader.message_at(at, &message)
        })
    });
    Ok(points.collect())
}

/// The byte offset of an error, and its message.
type ReadError = (usize, String);

struct Reader<'a> {
    name: &'a str,
    text: &'a str,
}

impl<'a> Reader<'a> {
    /// A message with the line and column of a byte offset.
    fn message_at(&self, at: usize, message: &str) -> String {
        let before = self.text.get(..at).unwrap_or(self.text);
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().unwrap_or("").chars().count() + 1;
        self.message_at_line(line, column, message)
    }

    fn message_at_line(&self, line: usize, column: usize, message: &str) -> String {
        format!("{}: line {line}, column {column}: {message}", self.name)
    }

    /// The message for invalid JSON, in words for its author.
    fn no_json(&self, error: &serde_json::Error) -> String {
        // This column counts bytes, and is 0 before the first.
        let line = self.text.split('\n').nth(error.line().saturating_sub(1));
        let line = line.unwrap_or("");
        let at = error.column().saturating_sub(1).min(line.len());
        let at = (0..=at).rev().find(|at| line.is_char_boundary(*at));
        let (before, after) = line.split_at(at.unwrap_or(0));
        let text = error.to_string();
        let reason = text.split(" at line ").next().unwrap_or(&text);
        let message = match reason {
            _ if error.is_eof() && self.text.trim().is_empty() => "it is empty",
            _ if error.is_eof() => "the text ends before a bracket or a quotation mark is closed",
            "expected value" | "expected ident" => {
                "expected a number, a name in quotation marks, `[` or `{`; JSON has no NaN and no infinity"
            }
            "invalid number" => "this is not a JSON number, which is written like 0.5, -2 or 1e-3",
            "number out of range" => "this number is beyond the range of floating-point numbers",
            "key must be a string" if !after.starts_with('}') => {
                "expected a name in quotation marks"
            }
            "key must be a string" | "trailing comma" => {
                "there is a comma before the closing bracket"
            }
            "trailing characters" => "the list ends before this",
            "control character (\\u0000-\\u001F) found while parsing a string" => {
                "a name in quotation marks must end on the line on which it begins"
            }
            "recursion limit exceeded" => "brackets are nested too deeply",
            said => said, // such as `expected `:``
        };
        self.message_at_line(error.line().max(1), before.chars().count() + 1, message)
    }

    /// The offset of a slice within the text.
    fn place(&self, piece: &str) -> usize {
        (piece.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize)
    }

    fn expected(&self, value: &RawValue, noun: &str) -> ReadError {
        let text = value.get();
        let kind = match text.as_bytes().first() {
            Some(b'"') => "a string",
            Some(b'{') => "an object",
            Some(b'[') => "a list",
            Some(b't' | b'f') => "true or false",
            Some(b'n') => "null",
            _ => "a number",
        };
        (self.place(text), format!("expected {noun}, found {kind}"))
    }

    fn point(&self, value: &'a RawValue) -> Result<Point, ReadError> {
        let mut point = Point::default();
        for (name, value) in self.pairs(value, "a point, `{\"q\": …}`")? {
            let in_field = |(at, what)| (at, format!("\"{name}\": {what}"));
            match name.as_str() {
                "t" => point.t = Some(self.number(value).map_err(in_field)?),
                "q" => point.q = Some(self.numbers(value).map_err(in_field)?),
                "v" => point.v = Some(self.numbers(value).map_err(in_field)?),
                "states" => point.states = Some(self.numbers(value).map_err(in_field)?),
                "parameters" => point.parameters = self.entries(value).map_err(in_field)?,
                "inputs" => point.inputs = self.entries(value).map_err(in_field)?,
                _ => {
                    let near = lagrangian_spec::diagnostic::most_similar(&name, FIELDS);
                    let help = match near {
                        Some(near) => format!("did you mean \"{near}\"?"),
                        None => format!("there are: {}", FIELDS.join(", ")),
                    };
                    let message = format!("a point has no \"{name}\"; {help}");
                    return Err((self.place(value.get()), message));
                }
            }
        }
        Ok(point)
    }

    /// The entries of an object in their order, with unique names.
    fn pairs(
        &self,
        value: &'a RawValue,
        noun: &str,
    ) -> Result<Vec<(String, &'a RawValue)>, ReadError> {
        let pairs: Result<Pairs, _> = serde_json::from_str(value.get());
        let Pairs(mut pairs) = pairs.map_err(|_| self.expected(value, noun))?;
        // Names are normalized like those of a spec: two encodings of é are the same name.
        for (name, _) in &mut pairs {
            if let Cow::Owned(composed) = normalized(name) {
                *name = composed;
            }
        }
        for (index, (name, value)) in pairs.iter().enumerate() {
            if pairs[..index].iter().any(|(other, _)| other == name) {
                let message = format!("\"{name}\" is given more than once");
                return Err((self.place(value.get()), message));
            }
        }
        Ok(pairs)
    }

    fn number(&self, value: &RawValue) -> Result<f64, ReadError> {
        let number: Result<f64, _> = serde_json::from_str(value.get());
        let is_number = value
            .get()
            .starts_with(|c: char| c == '-' || c.is_ascii_digit());
        match number {
            Ok(number) if number.is_finite() => Ok(number),
            _ if is_number => {
                let message = "this number is beyond the range of floating-point numbers";
                Err((self.place(value.get()), message.to_owned()))
            }
            _ => Err(self.expected(value, "a number")),
        }
    }

    fn list(&self, value: &'a RawValue) -> Result<Vec<f64>, ReadError> {
        let list: Result<Vec<&RawValue>, _> = serde_json::from_str(value.get());
        let list = list.map_err(|_| self.expected(value, "a list of numbers"))?;
        list.into_iter().map(|value| self.number(value)).collect()
    }

    fn numbers(&self, value: &'a RawValue) -> Result<Numbers, ReadError> {
        match value.get().as_bytes().first() {
            Some(b'[') => self.list(value).map(Numbers::List),
            Some(b'{') => self.entries(value).map(Numbers::ByName),
            _ => Err(self.expected(value, "a list of numbers, or an object of numbers")),
        }
    }

    fn entries(&self, value: &'a RawValue) -> Result<Vec<(String, Entry)>, ReadError> {
        let pairs = self.pairs(value, "an object of numbers, `{\"name\": 1}`")?;
        let entry = |(name, value): (String, &'a RawValue)| {
            let entry = match value.get().as_bytes().first() {
                Some(b'[') => self.list(value).map(Entry::Family),
                _ => self.number(value).map(Entry::One),
            };
            match entry {
                Ok(entry) => Ok((name, entry)),
                Err((at, what)) => Err((at, format!("\"{name}\": {what}"))),
            }
        };
        pairs.into_iter().map(entry).collect()
    }
}

/// An object with its entries in the order of the text.
struct Pairs<'a>(Vec<(String, &'a RawValue)>);

impl<'de> Deserialize<'de> for Pairs<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Collect;

        impl<'de> Visitor<'de> for Collect {
            type Value = Pairs<'de>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Pairs<'de>, A::Error> {
                let mut pairs = Vec::new();
                while let Some(pair) = map.next_entry()? {
                    pairs.push(pair);
                }
                Ok(Pairs(pairs))
            }
        }

        deserializer.deserialize_map(Collect)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(text: &str) -> Result<Point, String> {
        let mut points = read("points.json", text)?;
        assert_eq!(points.len(), 1, "{text}");
        points.remove(0)
    }

    #[test]
    fn a_point_is_what_it_says() {
        let text = r#"[{"t": 0.5, "q": [1, -2e-3], "v": {"a": 3, "b": [4, 5]}, "parameters": {"m\u0031": 6}}]"#;
        let point = Point {
            t: Some(0.5),
            q: Some(Numbers::List(vec![1.0, -2e-3])),
            v: Some(Numbers::ByName(vec![
                ("a".into(), Entry::One(3.0)),
                ("b".into(), Entry::Family(vec![4.0, 5.0])),
            ])),
            states: None,
            parameters: vec![("m1".into(), Entry::One(6.0))],
            inputs: Vec::new(),
        };
        assert_eq!(one(text), Ok(point));
        assert_eq!(one("[{}]"), Ok(Point::default()));
        assert_eq!(read("points.json", " [ ] "), Ok(Vec::new()));
    }

    /// Line and column of errors, counted by hand, and words that the message must contain.
    #[test]
    fn what_is_wrong_is_told_where_it_is() {
        for (text, place, words) in [
            (
                "[{\"q\": [0, \"x\"]}]",
                (1, 12),
                "point 1: \"q\": expected a number, found a string",
            ),
            (
                "[\n {\"v\": {\"ü\": null}}]",
                (2, 14),
                "\"v\": \"ü\": expected a number, found null",
            ),
            (
                "[{\"t\": [1]}]",
                (1, 8),
                "\"t\": expected a number, found a list",
            ),
            (
                "[{\"q\": 3}]",
                (1, 8),
                "expected a list of numbers, or an object of numbers, found a number",
            ),
            ("[{\"nonsense\": 1}]", (1, 15), "no \"nonsense\""),
            (
                "[{\"paramters\": {}}]",
                (1, 16),
                "did you mean \"parameters\"?",
            ),
            (
                "[{\"q\": {\"a\": 1, \"a\": 2}}]",
                (1, 22),
                "\"a\" is given more than once",
            ),
            // é as one character, and as e with a combining accent.
            (
                "[{\"q\": {\"\u{e9}\": 1, \"e\u{301}\": 2}}]",
                (1, 23),
                "\"\u{e9}\" is given more than once",
            ),
            (
                "[{\"t\": 1, \"t\": 2}]",
                (1, 16),
                "\"t\" is given more than once",
            ),
            ("[7]", (1, 2), "point 1: expected a point"),
            ("\n {}", (2, 2), "expected a list of points"),
            ("", (1, 1), "it is empty"),
            ("[{\"q\": [0, 1}]", (1, 13), "expected `,` or `]`"),
            ("[{\"q\": [0,\n", (2, 1), "ends before"),
            ("[{\"q\": [NaN]}]", (1, 9), "JSON has no NaN"),
            ("[{\"ü\": 1,}]", (1, 10), "comma"),
            ("[{q: 1}]", (1, 3), "in quotation marks"),
            ("[{}] x", (1, 6), "ends before this"),
            ("[{\"t\": 1e999}]", (1, 8), "beyond the range"),
        ] {
            let wrong = match read("points.json", text) {
                Err(wrong) => wrong,
                Ok(mut points) => points.remove(0).expect_err(text),
            };
            let (line, column) = place;
            let place = format!("points.json: line {line}, column {column}: ");
            assert!(wrong.starts_with(&place), "{text}: {wrong}");
            assert!(wrong.contains(words), "{text}: {wrong}");
        }
    }
}
