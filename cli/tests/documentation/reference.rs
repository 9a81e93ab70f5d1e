//! The reference is complete: it has an entry for every section of the language and a row
//! for every error.

use std::collections::BTreeMap;

use lagrangian_spec::diagnostic::Code;
use lagrangian_spec::syntax::SectionKind;
use lagrangian_spec::unit::Measure;

use crate::page::Page;

const REFERENCE: &str = "docs/reference.md";

/// The parts of a section's entry, in this order.
const PARTS: [&str; 5] = [
    "**Form.**",
    "**Meaning.**",
    "**May depend on.**",
    "**Example.**",
    "**Errors.**",
];

#[test]
fn every_section_has_an_entry_with_an_example() {
    let page = Page::open(REFERENCE);
    for section in SectionKind::ALL {
        let heading = format!("### `{section}`");
        let entry = page.entry(&heading);
        let entry = entry.unwrap_or_else(|| panic!("{REFERENCE} has no `{heading}`"));
        let places: Vec<usize> = PARTS
            .iter()
            .map(|part| {
                entry
                    .find(part)
                    .unwrap_or_else(|| panic!("{section}: no {part}"))
            })
            .collect();
        assert!(places.is_sorted(), "{section}: parts out of order");
        let example = entry.split("```machine").nth(1);
        let example = example.unwrap_or_else(|| panic!("{section}: the example is no machine"));
        let shown = example.split("```").next().unwrap_or_default();
        assert!(
            shown.contains(section.as_str()),
            "{section}: its example has none"
        );
        for field in section.fields() {
            assert!(
                entry.contains(&format!("`{field}`")) || entry.contains(&format!("{field}:")),
                "{section}: nothing is said of the field {field}"
            );
        }
    }
    let sections = page.headings().into_iter().filter(|(depth, text)| {
        let word = text.trim_matches('`');
        *depth == 3 && text.starts_with('`') && SectionKind::named(word).is_none()
    });
    assert_eq!(sections.count(), 0, "an entry for what is no section");
}

/// The file that demonstrates an error, as linked from the page.
fn shown_at(code: &str) -> String {
    match code {
        // A file of four megabytes would be too large for the repository.
        "source-too-large" => "../crates/mechanics/tests/mechanics/ui.rs".to_owned(),
        "internal-error" => "../crates/mechanics/tests/program/proved.rs".to_owned(),
        code => format!("../tests/ui/{code}.machine"),
    }
}

/// The rows of the index of errors: meaning and help by code.
fn index(page: &Page) -> BTreeMap<String, [String; 2]> {
    let entry = page.entry("## Index of errors").expect("an index");
    let rows = entry.lines().filter_map(|line| {
        let cells: Vec<&str> = line.strip_prefix("| [`")?.split(" | ").collect();
        let [code, meaning, help] = cells[..] else {
            panic!("a row has three cells: {line}");
        };
        let (code, link) = code.split_once("`](")?;
        assert_eq!(link.trim_end_matches(')'), shown_at(code));
        let help = help.trim_end_matches('|').trim();
        Some((code.to_owned(), [meaning.to_owned(), help.to_owned()]))
    });
    rows.collect()
}

#[test]
fn every_error_has_a_row_and_every_row_is_an_error() {
    let page = Page::open(REFERENCE);
    let index = index(&page);
    let found: Vec<&str> = index.keys().map(String::as_str).collect();
    let mut codes: Vec<&str> = Code::ALL.iter().map(|code| code.as_str()).collect();
    codes.sort_unstable();
    assert_eq!(found, codes);
    for (code, [_, help]) in &index {
        // The help text is the one that the linked spec gets.
        if help != "–" && !["source-too-large", "internal-error"].contains(&code.as_str()) {
            let told = Page::open(&format!("tests/ui/{code}.txt")).text;
            // Help texts with backslashes are formatted as code.
            let code_only =
                |help: &str| Some(help.strip_prefix("`` ")?.strip_suffix(" ``")?.to_owned());
            let help = code_only(help).unwrap_or_else(|| help.clone());
            assert!(
                told.contains(&format!("help: {help}\n")),
                "{code}: not told: {help}\n{told}"
            );
        }
    }
}

#[test]
fn every_error_is_in_the_entry_of_a_section_or_of_the_rules() {
    let page = Page::open(REFERENCE);
    let (entries, _) = page
        .text
        .split_once("\n## Index of errors\n")
        .expect("an index");
    for code in Code::ALL {
        let named = entries.contains(&format!("[`{code}`]({})", shown_at(code.as_str())));
        assert!(named, "no entry tells when {code} is raised");
    }
    // Only existing errors are named as errors: the page writes one as `[`code`](`.
    let words = entries
        .match_indices("`](../tests/ui/")
        .map(|(at, _)| entries[..at].rsplit('`').next().unwrap_or_default());
    for word in words {
        let known = Code::ALL.iter().any(|code| code.as_str() == word);
        assert!(known, "there is no error {word}");
    }
}

#[test]
fn every_unit_is_in_the_reference() {
    let page = Page::open(REFERENCE);
    let entry = page.entry("### Units").expect("an entry of units");
    let code = entry.split('`').skip(1).step_by(2);
    let words: Vec<&str> = code.flat_map(str::split_whitespace).collect();
    for unit in Measure::names() {
        assert!(words.contains(&unit), "{REFERENCE} has no unit {unit}");
    }
}

#[test]
fn every_section_is_in_the_grammar() {
    let grammar = Page::open("model-spec/src/syntax.rs").text;
    let lines = grammar.lines().filter(|line| line.starts_with("//!"));
    let grammar: String = lines.collect();
    for section in SectionKind::ALL {
        let word = format!("\"{section}\"");
        assert!(grammar.contains(&word), "the grammar has no section {word}");
    }
}
