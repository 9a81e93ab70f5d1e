//! The tokens of a spec: those of Rust, as a flat list, each with its place.
//!
//! [`lex`] splits a file into tokens. In a macro the compiler has done that already: the macro
//! converts each of its tokens, literals by [`literal`], and invisible brackets of a `macro_rules!`
//! to parentheses. After that the two sources of a spec cannot be distinguished.

use std::borrow::Cow;

use unicode_normalization::{UnicodeNormalization, is_nfc};

use crate::diagnostic::{Code, Diagnostic, Report};
use crate::source::{SOURCE_LIMIT, SourceId, Span};

/// The longest number, in characters: the digits of the largest floating-point number, and some more.
const NUMBER_LIMIT: usize = 400;

/// The three kinds of brackets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Delimiter {
    /// `( … )`
    Parenthesis,
    /// `{ … }`
    Brace,
    /// `[ … ]`
    Bracket,
}

/// The kind of a token.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TokenKind {
    /// A word; the token's text is without the `r#` of a raw identifier.
    Ident,
    /// A decimal number; the token's text is without `_`.
    Number,
    /// A string; the token's text is the content of the quotes, with escapes replaced.
    Text,
    /// Documentation of the next item; the token's text is the comment without its marks.
    Doc,
    /// One character of punctuation.
    Punct(char),
    /// An opening bracket.
    Open(Delimiter),
    /// A closing bracket.
    Close(Delimiter),
    /// A token without meaning in a spec, which was reported: `'a'`, `b"…"`, `§`.
    Unknown,
}

/// One token.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Token {
    /// Its kind.
    pub kind: TokenKind,
    /// Its text.
    pub text: Box<str>,
    /// Its place.
    pub span: Span,
    /// Whether it is punctuation directly followed by more punctuation, with which it may form an operator.
    pub joint: bool,
}

/// Splits a text into its tokens. Anything that is not a token of a spec is reported and
/// becomes [`TokenKind::Unknown`].
pub fn lex(source: SourceId, text: &str, report: &mut Report) -> Vec<Token> {
    if text.len() > SOURCE_LIMIT {
        let message = format!(
            "this text has {} bytes; a spec has at most {} MiB",
            text.len(),
            SOURCE_LIMIT >> 20
        );
        report.push(Diagnostic::new(
            Code::SourceTooLarge,
            Span::new(source, 0, 0),
            message,
        ));
        return Vec::new();
    }
    let mut lexer = Lexer {
        source,
        text,
        at: 0,
        resumed: false,
        tokens: Vec::new(),
        report,
    };
    // Some editors begin a UTF-8 file with an invisible byte order mark.
    lexer.eat("\u{feff}");
    while let Some(c) = lexer.peek() {
        lexer.token(c);
    }
    lexer.tokens
}

/// The token of a literal: a number, or a string with its quotes.
///
/// What Rust allows and a spec does not (`0x1F`, `1.5f32`, `'a'`, `b"…"`) is reported.
pub fn literal(text: &str, span: Span, report: &mut Report) -> Token {
    let (kind, text) = match text.chars().next() {
        Some('0'..='9') => (TokenKind::Number, number(text, span, report)),
        Some('"') => (TokenKind::Text, quoted(text, span, report)),
        Some('r') => (TokenKind::Text, raw(text, span, report)),
        _ => {
            let message = format!("{} has no meaning in a spec", shown(text));
            report.push(Diagnostic::new(Code::UnexpectedToken, span, message));
            (TokenKind::Unknown, text.to_owned())
        }
    };
    Token {
        kind,
        text: text.into(),
        span,
        joint: false,
    }
}

/// A name as the Rust compiler reads it, in normalization form C: `é` is one name, whether it is
/// written as one character or as `e` and an accent.
pub fn normalized(name: &str) -> Cow<'_, str> {
    if is_nfc(name) {
        Cow::Borrowed(name)
    } else {
        Cow::Owned(name.nfc().collect())
    }
}

/// Whether Rust counts a character as punctuation.
fn is_punctuation(c: char) -> bool {
    "~!@#$%^&*-=+|;:,<.>/?'".contains(c)
}

/// Whether a character can begin a word.
///
/// Rust uses XID_Start; the letters of Unicode differ from it in a few dozen circled and half-width
/// forms that are hardly ever used as names.
fn begins_word(c: char) -> bool {
    c == '_' || c.is_alphabetic()
}

/// Whether a character can continue a word: letters, digits and combining accents (`q̇`), but not `²`.
fn continues_word(c: char) -> bool {
    begins_word(c) || c.is_ascii_digit() || ('\u{300}'..='\u{36f}').contains(&c)
}

/// Whether Rust skips a character between tokens.
fn is_space(c: char) -> bool {
    matches!(
        c,
        '\t'..='\r' | ' ' | '\u{85}' | '\u{200e}' | '\u{200f}' | '\u{2028}' | '\u{2029}'
    )
}

struct Lexer<'a> {
    source: SourceId,
    text: &'a str,
    at: usize,
    /// Whether the rest of the text was already read once more after an unterminated string.
    resumed: bool,
    tokens: Vec<Token>,
    report: &'a mut Report,
}

impl<'a> Lexer<'a> {
    fn rest(&self) -> &'a str {
        self.text.get(self.at..).unwrap_or("")
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn eat(&mut self, prefix: &str) -> bool {
        let found = self.rest().starts_with(prefix);
        if found {
            self.at += prefix.len();
        }
        found
    }

    fn eat_while(&mut self, belongs: impl Fn(char) -> bool) {
        let rest = self.rest();
        self.at += rest.find(|c| !belongs(c)).unwrap_or(rest.len());
    }

    /// The span from `start` to the current position.
    fn span(&self, start: usize) -> Span {
        Span::new(self.source, start as u32, self.at as u32)
    }

    fn push(&mut self, kind: TokenKind, text: &str, start: usize) {
        let span = self.span(start);
        let text = text.into();
        self.tokens.push(Token {
            kind,
            text,
            span,
            joint: false,
        });
    }

    /// Reads the token that begins with `c`, or the space or comment before it.
    fn token(&mut self, c: char) {
        let rest = self.rest();
        if is_space(c) {
            self.eat_while(is_space);
        } else if rest.starts_with("//") {
            self.line_comment();
        } else if rest.starts_with("/*") {
            self.block_comment();
        } else if let Some(quote) = opening_quote(rest) {
            self.string(quote);
        } else if c == '\'' {
            self.quoted_character();
        } else if begins_word(c) {
            self.word();
        } else if c.is_ascii_digit() {
            self.number();
        } else {
            self.mark(c);
        }
    }

    /// `// …`, or documentation `/// …`; four slashes are an ordinary comment.
    fn line_comment(&mut self) {
        let start = self.at;
        self.eat_while(|c| c != '\n');
        let line = self.text.get(start..self.at).unwrap_or("");
        if line.starts_with("///") && !line.starts_with("////") {
            let text = line[3..].strip_suffix('\r').unwrap_or(&line[3..]);
            self.push(TokenKind::Doc, text, start);
        }
    }

    /// `/* … */`, nested or not, or documentation `/** … */`.
    fn block_comment(&mut self) {
        let start = self.at;
        let mut depth = 0;
        loop {
            if self.eat("/*") {
                depth += 1;
            } else if self.eat("*/") {
                depth -= 1;
                if depth == 0 {
                    break;
                }
            } else if let Some(c) = self.peek() {
                self.at += c.len_utf8();
            } else {
                let opening = Span::new(self.source, start as u32, start as u32 + 2);
                self.report.push(
                    Diagnostic::new(Code::Unterminated, opening, "this comment does not end")
                        .help("end it with `*/`; comments inside comments need their own"),
                );
                return;
            }
        }
        let comment = self.text.get(start..self.at).unwrap_or("");
        if comment.starts_with("/**") && !comment.starts_with("/***") && comment != "/**/" {
            let inner = &comment[3..comment.len() - 2];
            self.push(TokenKind::Doc, &inner.replace("\r\n", "\n"), start);
        }
    }

    /// A string of any kind, from its prefix to its suffix.
    fn string(&mut self, quote: Quote) {
        let start = self.at;
        self.at += quote.opening;
        let inside = self.rest();
        let length = if quote.raw {
            inside
                .find(&quote.closing)
                .map(|at| at + quote.closing.len())
        } else {
            length_to_quote(inside, '"')
        };
        match length {
            Some(length) => {
                self.at += length;
                self.eat_while(continues_word); // a suffix belongs to the token
                self.push_literal(start);
            }
            None => self.unterminated(start, quote.opening),
        }
    }

    /// Reports an unterminated string.
    fn unterminated(&mut self, start: usize, opening: usize) {
        self.report.push(
            Diagnostic::new(
                Code::Unterminated,
                Span::new(self.source, start as u32, (start + opening) as u32),
                "this string does not end",
            )
            .help("end it with `\"`"),
        );
        // It was most likely meant to end on its line, so the lines below are worth reading. This
        // is done only once, since repeating it would take quadratic time.
        self.eat_while(|c| c != '\n');
        if self.resumed {
            self.at = self.text.len();
        }
        self.resumed = true;
        self.push(TokenKind::Unknown, "", start);
    }

    /// `'a'`, or `'life`.
    fn quoted_character(&mut self) {
        let start = self.at;
        self.at += 1;
        let inside = self.rest();
        let mut letters = inside.chars();
        let length = match (letters.next(), letters.next()) {
            (Some('\\'), _) => length_to_quote(inside.lines().next().unwrap_or(""), '\''),
            (Some(c), Some('\'')) => Some(c.len_utf8() + 1),
            _ => None,
        };
        let before = self.tokens.last();
        let is_behind_name = before.is_some_and(|token| {
            token.kind == TokenKind::Ident && token.span.end as usize == start
        });
        let is_word = inside.starts_with(continues_word);
        if is_behind_name && length.is_none() && !is_word {
            return self.prime(start);
        }
        self.at += length.unwrap_or(0);
        self.eat_while(continues_word);
        self.push_literal(start);
    }

    /// `x'`, which does not denote a derivative here.
    fn prime(&mut self, start: usize) {
        let name = self.tokens.last().map_or("x", |token| &token.text);
        let message = "a prime has no meaning in a spec";
        let help = format!("the time derivative is `der({name})`");
        let span = self.span(start);
        self.report
            .push(Diagnostic::new(Code::UnexpectedToken, span, message).help(help));
        self.push(TokenKind::Unknown, "'", start);
    }

    /// A name, or a raw name `r#type`.
    fn word(&mut self) {
        let start = self.at;
        let raw = self.rest().strip_prefix("r#").unwrap_or("");
        if raw.starts_with(begins_word) {
            self.at += 2;
        }
        let name = self.at;
        self.eat_while(continues_word);
        let text = self.text.get(name..self.at).unwrap_or("");
        self.push(TokenKind::Ident, &normalized(text), start);
    }

    /// A number as Rust splits it: `1..N` is `1`, `.`, `.`, `N`, and a suffix belongs to it.
    fn number(&mut self) {
        let start = self.at;
        let is_digit = |c: char| c.is_ascii_digit() || c == '_';
        self.eat_while(is_digit);
        let mut next = self.rest().chars();
        let is_fraction =
            next.next() == Some('.') && next.next().is_none_or(|c| c != '.' && !begins_word(c));
        if is_fraction {
            self.at += 1;
            self.eat_while(is_digit);
        }
        let exponent = self.rest();
        let signed = exponent.strip_prefix(['e', 'E']).unwrap_or("");
        let digits = signed.strip_prefix(['+', '-']).unwrap_or(signed);
        if digits
            .trim_start_matches('_')
            .starts_with(|c: char| c.is_ascii_digit())
        {
            self.at += exponent.len() - digits.len();
            self.eat_while(is_digit);
        }
        self.eat_while(continues_word);
        self.push_literal(start);
    }

    fn push_literal(&mut self, start: usize) {
        let span = self.span(start);
        let text = self.text.get(start..self.at).unwrap_or("");
        self.tokens.push(literal(text, span, self.report));
    }

    /// A bracket, punctuation, or a character that is not in the language.
    fn mark(&mut self, c: char) {
        let start = self.at;
        self.at += c.len_utf8();
        let kind = match c {
            '(' => TokenKind::Open(Delimiter::Parenthesis),
            '{' => TokenKind::Open(Delimiter::Brace),
            '[' => TokenKind::Open(Delimiter::Bracket),
            ')' => TokenKind::Close(Delimiter::Parenthesis),
            '}' => TokenKind::Close(Delimiter::Brace),
            ']' => TokenKind::Close(Delimiter::Bracket),
            c if is_punctuation(c) => TokenKind::Punct(c),
            _ => {
                let message = format!("the character {} has no meaning in a spec", shown_char(c));
                let mut diagnostic =
                    Diagnostic::new(Code::UnknownCharacter, self.span(start), message);
                diagnostic.help = ascii_equivalent(c).map(|meant| format!("write `{meant}`"));
                self.report.push(diagnostic);
                TokenKind::Unknown
            }
        };
        let text = self.text.get(start..self.at).unwrap_or("");
        self.push(kind, text, start);
        let rest = self.rest();
        let joint = matches!(kind, TokenKind::Punct(_))
            && rest.starts_with(is_punctuation)
            && !rest.starts_with("//")
            && !rest.starts_with("/*");
        if let Some(token) = self.tokens.last_mut() {
            token.joint = joint;
        }
    }
}

/// The delimiters of a string.
struct Quote {
    /// Length of the prefix and the opening quote.
    opening: usize,
    /// Whether a backslash stands for itself.
    raw: bool,
    /// The closing quote.
    closing: String,
}

/// The opening quote of a string, if the text begins with one: `"`, `b"`, `c"`, `r#"`, `br"`, ….
fn opening_quote(text: &str) -> Option<Quote> {
    let after_kind = text.strip_prefix(['b', 'c']).unwrap_or(text);
    let after_raw = after_kind.strip_prefix('r');
    let marks = after_raw.unwrap_or(after_kind);
    let inside = marks.trim_start_matches('#');
    let hashes = marks.len() - inside.len();
    if !inside.starts_with('"') || (after_raw.is_none() && hashes > 0) {
        return None;
    }
    Some(Quote {
        opening: text.len() - inside.len() + 1,
        raw: after_raw.is_some(),
        closing: format!("\"{}", "#".repeat(hashes)),
    })
}

/// The length up to and including the closing quote; a backslash escapes the next character.
fn length_to_quote(inside: &str, quote: char) -> Option<usize> {
    let mut hidden = false;
    for (at, c) in inside.char_indices() {
        if hidden {
            hidden = false;
        } else if c == '\\' {
            hidden = true;
        } else if c == quote {
            return Some(at + 1);
        }
    }
    None
}

/// A decimal number without `_`; `1` if it is malformed.
fn number(text: &str, span: Span, report: &mut Report) -> String {
    let one = || "1".to_owned();
    let digits: String = text.chars().filter(|&c| c != '_').collect();
    let after_zero = text.strip_prefix('0').and_then(|rest| rest.chars().next());
    let radix = match after_zero {
        Some('x') => Some(16),
        Some('o') => Some(8),
        Some('b') => Some(2),
        _ => None,
    };
    if let Some(radix) = radix {
        let message = "numbers are decimal";
        let mut other = Diagnostic::new(Code::MalformedNumber, span, message);
        let value = digits
            .get(2..)
            .and_then(|digits| u64::from_str_radix(digits, radix).ok());
        other.help = value.map(|value| format!("write `{value}`"));
        report.push(other);
        return one();
    }
    let Ok(value) = digits.parse::<f64>() else {
        let length = digits
            .find(|c: char| !c.is_ascii_digit() && c != '.')
            .unwrap_or(digits.len());
        let (number, suffix) = digits.split_at(length);
        let message = format!("a number does not end in `{suffix}`");
        let help = match suffix {
            "e" | "E" => "an exponent needs digits: `1e-3`".to_owned(),
            "f64" | "f32" | "i32" | "u32" | "i64" | "u64" | "usize" => {
                format!("numbers have no type here: write `{number}`")
            }
            _ => format!("a product needs its `*`: `{number}*{suffix}`"),
        };
        report.push(Diagnostic::new(Code::MalformedNumber, span, message).help(help));
        return one();
    };
    let mantissa = digits.split(['e', 'E']).next().unwrap_or("");
    let exponent = digits.split(['e', 'E']).nth(1).unwrap_or("0");
    // The exponent of a zero is checked too: 0e999999999 must not become a power of ten.
    let moderate = exponent
        .parse::<i32>()
        .is_ok_and(|exponent| exponent.unsigned_abs() as usize <= NUMBER_LIMIT);
    let vanishes = value == 0.0 && mantissa.contains(|c| ('1'..='9').contains(&c));
    if digits.len() > NUMBER_LIMIT || !moderate || !value.is_finite() || vanishes {
        let message = "this number is too large, too small or too long";
        report.push(
            Diagnostic::new(Code::NumberOutOfRange, span, message).help(format!(
                "numbers lie between {:.1e} and {:.1e}, in at most {NUMBER_LIMIT} characters",
                f64::MIN_POSITIVE,
                f64::MAX
            )),
        );
        return one();
    }
    // Rust writes `1.` where others write `1.0`.
    match digits.strip_suffix('.') {
        Some(integer) => integer.to_owned(),
        None => digits,
    }
}

/// The content of `"…"`.
fn quoted(text: &str, span: Span, report: &mut Report) -> String {
    let mut content = String::new();
    let mut rest = text.get(1..).unwrap_or("").chars();
    while let Some(c) = rest.next() {
        match c {
            '"' => break,
            '\\' => match escape(&mut rest) {
                Some(Some(c)) => content.push(c),
                Some(None) => {}
                None => {
                    let message = "this string contains an escape that does not exist";
                    let help = r#"escapes are \n \r \t \\ \" \' \0 \x41 \u{3b8}"#;
                    report.push(Diagnostic::new(Code::MalformedText, span, message).help(help));
                    return content;
                }
            },
            // Like Rust, treat Windows line breaks as plain line breaks.
            '\r' if rest.as_str().starts_with('\n') => {}
            c => content.push(c),
        }
    }
    no_suffix(rest.as_str(), span, report);
    content
}

/// The character of an escape; `Some(None)` for a line break that the string skips.
fn escape(rest: &mut std::str::Chars<'_>) -> Option<Option<char>> {
    let c = match rest.next()? {
        'n' => '\n',
        'r' => '\r',
        't' => '\t',
        '0' => '\0',
        c @ ('\\' | '"' | '\'') => c,
        'x' => {
            let digits: String = rest.by_ref().take(2).collect();
            let code = u8::from_str_radix(&digits, 16).ok()?;
            char::from_u32(code.into()).filter(char::is_ascii)?
        }
        'u' => {
            let digits = rest.as_str().strip_prefix('{')?.split_once('}')?.0;
            let code = u32::from_str_radix(&digits.replace('_', ""), 16).ok()?;
            rest.nth(digits.chars().count() + 1)?;
            char::from_u32(code)?
        }
        '\n' | '\r' => {
            *rest = rest.as_str().trim_start_matches(is_space).chars();
            return Some(None);
        }
        _ => return None,
    };
    Some(Some(c))
}

/// The content of `r"…"`, `r#"…"#`, ….
fn raw(text: &str, span: Span, report: &mut Report) -> String {
    let inside = text.trim_start_matches('r').trim_start_matches('#');
    let hashes = text.len() - 1 - inside.len();
    let closing = format!("\"{}", "#".repeat(hashes));
    let inside = inside.strip_prefix('"').unwrap_or(inside);
    let (content, suffix) = inside.split_once(&closing).unwrap_or((inside, ""));
    no_suffix(suffix, span, report);
    content.replace("\r\n", "\n")
}

fn no_suffix(suffix: &str, span: Span, report: &mut Report) {
    if !suffix.is_empty() {
        let message = format!("a string does not end in `{suffix}`");
        report.push(Diagnostic::new(Code::MalformedText, span, message));
    }
}

/// The ASCII equivalent of a character from a book or a word processor.
fn ascii_equivalent(c: char) -> Option<&'static str> {
    Some(match c {
        '−' | '–' | '—' => "-",
        '·' | '×' | '∙' | '⋅' => "*",
        '÷' | '∕' => "/",
        '²' => "^2",
        '³' => "^3",
        '½' => "1/2",
        '≥' => ">=",
        '≤' => "<=",
        '√' => "sqrt(…)",
        '…' => "..",
        '“' | '”' | '„' | '«' | '»' => "\"",
        '₀'..='₉' => "0 … 9 on the line",
        '°' => "pi/180",
        _ => return None,
    })
}

/// A piece of text in a message, truncated if it is long.
pub(crate) fn shown(text: &str) -> String {
    const LONGEST: usize = 40;
    match text.char_indices().nth(LONGEST) {
        Some((cut, _)) => format!("`{}…`", &text[..cut]),
        None => format!("`{text}`"),
    }
}

/// A character in a message; by its number if it is invisible.
fn shown_char(c: char) -> String {
    if c.is_control() || c.is_whitespace() || c == '\u{feff}' || c == '\u{200b}' {
        format!("U+{:04X}", c as u32)
    } else {
        format!("`{c}`")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The kinds and texts of the tokens, and the codes that were reported.
    fn lexed(text: &str) -> (Vec<(TokenKind, String)>, Vec<Code>) {
        let mut report = Report::new();
        let tokens = lex(SourceId(0), text, &mut report);
        let tokens = tokens
            .into_iter()
            .map(|token| (token.kind, token.text.into_string()))
            .collect();
        let codes = report.diagnostics().iter().map(|d| d.code).collect();
        (tokens, codes)
    }

    fn texts(text: &str) -> Vec<String> {
        let (tokens, codes) = lexed(text);
        assert_eq!(codes, [], "{text}");
        tokens.into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn numbers_are_cut_as_rust_cuts_them() {
        assert_eq!(texts("1..N"), ["1", ".", ".", "N"]);
        assert_eq!(
            texts("1.5e-3 1_000 2. 3.e4"),
            ["1.5e-3", "1000", "2", "3", ".", "e4"]
        );
        assert_eq!(texts("1e3 1E+3 1e_3 .5"), ["1e3", "1E+3", "1e3", ".", "5"]);
        assert_eq!(texts("2.origin"), ["2", ".", "origin"]);
    }

    #[test]
    fn numbers_of_other_kinds_are_refused() {
        for text in ["0x1F", "0b1", "0o7", "1.5f32", "1u8", "1e", "2x", "1e+"] {
            assert_eq!(lexed(text).1, [Code::MalformedNumber], "{text}");
        }
        let long = "9".repeat(500);
        for text in ["1e400", "1e-400", "0e999999999", &long] {
            assert_eq!(lexed(text).1, [Code::NumberOutOfRange], "{text}");
        }
    }

    #[test]
    fn strings_say_what_they_mean() {
        assert_eq!(
            texts(r###""a\n\u{3b8}\x41\"" r"\n" r##"a"#b"##"###),
            ["a\nθA\"", r"\n", "a\"#b"]
        );
        assert_eq!(texts("\"a\\\n   b\""), ["ab"]);
        for text in [
            r#""\q""#,
            r#""\x9""#,
            r#""\u{110000}""#,
            r#""a"b"#,
            "\"\\u{}\"",
        ] {
            assert_eq!(lexed(text).1, [Code::MalformedText], "{text}");
        }
        for text in [
            "'a'",
            "'\\n'",
            "'life",
            "b\"x\"",
            "br#\"x\"#",
            "c\"x\"",
            "'",
        ] {
            let (tokens, codes) = lexed(text);
            assert_eq!(
                (tokens.len(), codes),
                (1, vec![Code::UnexpectedToken]),
                "{text}"
            );
        }
    }

    #[test]
    fn what_does_not_end_is_reported_where_it_begins() {
        let (tokens, codes) = lexed("a \"b c\n d");
        assert_eq!(codes, [Code::Unterminated]);
        assert_eq!(tokens.last().map(|(_, text)| text.as_str()), Some("d"));
        assert_eq!(lexed("a /* b /* c */").1, [Code::Unterminated]);
        assert_eq!(lexed("r#\"a\"").1, [Code::Unterminated]);
    }

    #[test]
    fn comments_nest_and_three_slashes_document() {
        let (tokens, codes) =
            lexed("/// a\r\n//// b\n// c\n/** d */ /*** e */ /**/ /* f /* g */ */ //! h\n/*! i */");
        assert_eq!(codes, []);
        let docs = [" a", " d "].map(|text| (TokenKind::Doc, text.to_owned()));
        assert_eq!(tokens, docs);
    }

    #[test]
    fn names_are_those_of_rust() {
        assert_eq!(texts("θ_1 r#type r q̇ _x"), ["θ_1", "type", "r", "q̇", "_x"]);
    }

    #[test]
    fn a_character_of_a_book_is_explained() {
        let mut report = Report::new();
        lex(SourceId(0), "x² − y", &mut report);
        let help: Vec<_> = report
            .diagnostics()
            .iter()
            .map(|d| d.help.clone())
            .collect();
        assert_eq!(
            help,
            [Some("write `^2`".to_owned()), Some("write `-`".to_owned())]
        );
    }

    #[test]
    fn punctuation_knows_its_neighbour() {
        let mut report = Report::new();
        let tokens = lex(SourceId(0), ">= > = ./**/.", &mut report);
        let joint: Vec<bool> = tokens.iter().map(|token| token.joint).collect();
        assert_eq!(joint, [true, false, false, false, false, false]);
    }

    #[test]
    fn a_text_of_many_megabytes_is_refused() {
        let text = " ".repeat(SOURCE_LIMIT + 1);
        assert_eq!(lexed(&text).1, [Code::SourceTooLarge]);
    }
}
