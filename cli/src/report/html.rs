//! HTML: escaping of text, and tables.

use std::fmt::Write;

use lagrangian_print::document::{Inline, of_docs};
use serde_json::Value;

/// Escapes text for content and for quoted attributes.
pub fn text(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            // Control characters are invisible, and not allowed in documents.
            '\0'..='\x08' | '\x0b' | '\x0c' | '\x0e'..='\x1f' | '\x7f' => {}
            letter => safe.push(letter),
        }
    }
    safe
}

/// A paragraph of a doc comment as HTML, with its code and its emphasized words.
pub fn docs(paragraph: &str) -> String {
    let run = |run: &Inline| match run {
        Inline::Text(words) => text(words),
        Inline::Code(code) => format!("<code>{}</code>", text(code)),
        Inline::Emphasis(words) => format!("<em>{}</em>", text(words)),
        Inline::Math(math) => math.mathml(),
    };
    of_docs(paragraph).iter().map(run).collect()
}

/// JSON for a `<script>` element, which cannot contain a tag or a comment.
pub fn json(value: &Value) -> String {
    let text = value.to_string();
    text.replace('<', "\\u003c")
        .replace('\u{2028}', "\\u2028")
        .replace('\u{2029}', "\\u2029")
}

/// Replaces every `{{name}}` in a text by the result of `part`; replacements are not scanned again.
pub fn fill(template: &str, part: impl Fn(&str) -> String) -> String {
    let mut filled = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        filled.push_str(before);
        match after.split_once("}}") {
            Some((name, after)) => {
                filled.push_str(&part(name));
                rest = after;
            }
            None => rest = after,
        }
    }
    filled.push_str(rest);
    filled
}

/// A cell of a table.
pub enum Cell {
    /// Text.
    Words(String),
    /// A number or a name: right-aligned and in a monospaced font.
    Figure(String),
    /// HTML.
    Raw(String),
}

/// A table with a caption for screen readers. If the last column is empty in all rows, it is left out.
pub fn table(caption: &str, head: &[&str], rows: &[Vec<Cell>]) -> String {
    let known =
        |row: &Vec<Cell>| !matches!(row.last(), Some(Cell::Words(words)) if words.is_empty());
    let columns = head
        .len()
        .saturating_sub(usize::from(!rows.iter().any(known)));
    let (head, has_head) = (&head[..columns], head.iter().any(|title| !title.is_empty()));
    let mut html = format!(
        "<div class=\"scroll\"><table><caption>{}</caption>",
        text(caption)
    );
    if has_head {
        html.push_str("<thead><tr>");
        for title in head {
            let _ = write!(html, "<th scope=\"col\">{}</th>", text(title));
        }
        html.push_str("</tr></thead>");
    }
    html.push_str("<tbody>\n");
    for row in rows {
        html.push_str("<tr>");
        // A table without a header has as many columns as each row.
        let columns = if has_head { columns } else { row.len() };
        for (index, cell) in row.iter().take(columns).enumerate() {
            let (class, body) = match cell {
                Cell::Words(words) => ("", text(words)),
                Cell::Figure(figure) => (" class=\"figure\"", text(figure)),
                Cell::Raw(html) => ("", html.clone()),
            };
            let _ = match index {
                0 => write!(html, "<th scope=\"row\">{body}</th>"),
                _ => write!(html, "<td{class}>{body}</td>"),
            };
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</tbody></table></div>\n");
    html
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_leaves_its_place() {
        assert_eq!(
            text("</script>\"'&\u{1}"),
            "&lt;/script&gt;&quot;&#39;&amp;"
        );
        let value = serde_json::json!({ "</script><!--": "\u{2028}" });
        let safe = json(&value);
        assert!(!safe.contains('<') && !safe.contains('\u{2028}'), "{safe}");
        assert_eq!(serde_json::from_str::<Value>(&safe).unwrap(), value);
    }

    #[test]
    fn docs_have_their_code_and_their_stressed_words() {
        assert_eq!(
            docs("see *On <b>*, `a*b` & 2*m*l"),
            "see <em>On &lt;b&gt;</em>, <code>a*b</code> &amp; 2*m*l"
        );
    }

    #[test]
    fn what_is_put_in_is_not_looked_at_again() {
        let part = |name: &str| match name {
            "a" => "{{b}}".to_owned(),
            _ => "!".to_owned(),
        };
        assert_eq!(fill("x{{a}}y{{b}}z{{", part), "x{{b}}y!z");
    }
}
