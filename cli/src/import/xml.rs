//! Reads whole XML files, and records the positions of errors.

use roxmltree::{Document, ParsingOptions};

use super::faults::Faults;

/// The most attributes of an element: the XML reader compares each with every other.
const MOST_ATTRIBUTES: usize = 1000;

/// The position of an element with more attributes than can be read quickly.
fn overlong_element(text: &str) -> Option<usize> {
    let mut at = 0;
    for element in text.split('<') {
        let is_element = !element.starts_with(['!', '?']);
        let mut quoted = 0;
        let mut before = b' ';
        for byte in element.bytes().filter(|byte| !byte.is_ascii_whitespace()) {
            quoted += usize::from(before == b'=' && matches!(byte, b'"' | b'\''));
            before = byte;
        }
        if is_element && quoted > MOST_ATTRIBUTES {
            return Some(at.max(1) - 1);
        }
        at += element.len() + 1;
    }
    None
}

/// Reads a text whose positions begin at `start`.
pub fn open<'t>(text: &'t str, start: usize, faults: &mut Faults) -> Option<Document<'t>> {
    if let Some(at) = overlong_element(text) {
        let message = format!("an element has more than {MOST_ATTRIBUTES} attributes");
        faults.add(start + at, message);
        return None;
    }
    let options = ParsingOptions {
        allow_dtd: false,
        ..ParsingOptions::default()
    };
    match Document::parse_with_options(text, options) {
        Ok(document) => Some(document),
        Err(error) => {
            let place = error.pos();
            let line = place.row as usize;
            let before = text.split_inclusive('\n').take(line.saturating_sub(1));
            let begins: usize = before.map(str::len).sum();
            let rest = text[begins..].char_indices();
            let column = rest
                .map(|(at, _)| at)
                .nth(place.col.saturating_sub(1) as usize);
            let at = begins + column.unwrap_or(0);
            let message = error.to_string();
            let message = match message.rsplit_once(" at ") {
                Some((what, _)) => what,
                None => &message,
            };
            faults.add(start + at, format!("invalid XML: {message}"));
            None
        }
    }
}
