//! The content of doc comments as runs of words.

use lagrangian_print::document::{Inline, of_docs};

#[test]
fn stressed_words_and_code_are_found_in_doc_comments() {
    let text = |text: &str| Inline::Text(text.into());
    let stress = |text: &str| Inline::Emphasis(text.into());
    let code = |text: &str| Inline::Code(text.into());
    let all = [
        (
            "see *On Motion*, and `a*b*c`",
            vec![
                text("see "),
                stress("On Motion"),
                text(", and "),
                code("a*b*c"),
            ],
        ),
        (
            "(*two\nlines*)",
            vec![text("("), stress("two\nlines"), text(")")],
        ),
        ("**so** it is", vec![stress("so"), text(" it is")]),
        // Products, a list, and marks without a partner.
        ("2*m*l and m * l * g", vec![text("2*m*l and m * l * g")]),
        ("*a* b*", vec![stress("a"), text(" b*")]),
        ("*a b", vec![text("*a b")]),
        ("****", vec![text("****")]),
        ("a ` b", vec![text("a ` b")]),
        ("*", vec![text("*")]),
        ("", vec![]),
    ];
    for (docs, expected) in all {
        assert_eq!(of_docs(docs), expected, "{docs}");
    }
}
