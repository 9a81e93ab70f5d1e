//! Tests of the docs: every spec in them is checked, every command is run and must print the text below it, every link must have a
//! target, and the reference must have an entry for every section and every error.
//!
//! The language of a block determines how it is tested.
//!
//! | language | |
//! | --- | --- |
//! | `machine` | a whole spec: saved under the name in its first line, `// NAME.machine`, or else under the name of its machine in snake case; it can be derived, unless the next block shows its errors, or the text after it says that it is `not-supported` |
//! | `console` | commands after `$ `, each followed by its complete output; `…` stands for text that changes from run to run, and alone on a line for any number of lines |
//! | `c`, `python`, `csv`, `xml` | a program, a table or a robot, saved under the name in its first line |
//! | `sh` | commands that must succeed, whatever their output |
//! | `rust` | compiled and run as documentation tests of the library, see the end of `src/lib.rs` |
//! | `text`, `json`, `toml` | forms and excerpts, which are not tested |
//!
//! Pages are independent: each starts with an empty folder and the library of machines.

mod errors;
mod json;
mod links;
mod options;
mod page;
mod reader;
mod reference;

use page::Page;
use reader::{Reader, Verdict};

/// The pages whose blocks are run.
const PAGES: [&str; 10] = [
    "README.md",
    "docs/tutorial.md",
    "docs/reference.md",
    "docs/spec-language.md",
    "docs/command-line.md",
    "docs/contacts.md",
    "docs/errata.md",
    "docs/skipping.md",
    "docs/sweeps.md",
    "machines/README.md",
];

/// Whether the text after a spec says so; a list of errors that links to this one does not.
fn is_said_to_be_unsupported(words: &str) -> bool {
    words
        .replace("[`not-supported`]", "")
        .contains("`not-supported`")
}

/// Reads a page from top to bottom and executes its blocks.
fn follow(path: &str) {
    let page = Page::open(path);
    let reader = Reader::new(path);
    let blocks = page.blocks();
    for (index, block) in blocks.iter().enumerate() {
        let at = format!("{path}:{}", block.line);
        match block.language.as_str() {
            "machine" => {
                let next = blocks.get(index + 1);
                let shown = next.filter(|next| next.language == "console");
                let verdict = if shown.is_some_and(|next| next.text.contains("\nerror")) {
                    Verdict::Wrong
                } else if is_said_to_be_unsupported(&block.after) {
                    Verdict::NotSupported
                } else {
                    Verdict::Sound
                };
                reader.save(block, verdict, &at);
            }
            "console" => reader.compare(block, &at),
            "sh" => reader.run(block, &at),
            "c" | "python" | "csv" | "xml" => reader.save_program(block, &at),
            "rust" | "json" | "toml" => {}
            "text" => {
                let spec = |line: &str| line.starts_with("machine ") && line.ends_with('{');
                let hidden = block.text.lines().any(spec);
                assert!(!hidden, "{at}: a spec is a block of the language `machine`");
            }
            other => panic!("{at}: nothing is known to be done with a block of {other:?}"),
        }
    }
}

#[test]
fn the_readme_does_what_it_says() {
    follow("README.md");
}

#[test]
fn the_tutorial_does_what_it_says() {
    follow("docs/tutorial.md");
}

#[test]
fn the_reference_does_what_it_says() {
    follow("docs/reference.md");
}

#[test]
fn the_page_of_the_language_does_what_it_says() {
    follow("docs/spec-language.md");
}

#[test]
fn the_page_of_the_command_line_does_what_it_says() {
    follow("docs/command-line.md");
}

#[test]
fn the_page_of_contacts_does_what_it_says() {
    follow("docs/contacts.md");
}

#[test]
fn the_page_of_errata_does_what_it_says() {
    follow("docs/errata.md");
}

#[test]
fn the_page_of_the_library_does_what_it_says() {
    follow("machines/README.md");
}

#[test]
fn the_page_of_what_is_skipped_does_what_it_says() {
    follow("docs/skipping.md");
}

#[test]
fn the_page_of_sweeps_does_what_it_says() {
    follow("docs/sweeps.md");
}

#[test]
fn every_rust_block_is_a_documentation_test() {
    let library = Page::open("src/lib.rs");
    for path in PAGES {
        let page = Page::open(path);
        if page.blocks().iter().any(|block| block.language == "rust") {
            let included = format!("include_str!(\"../{path}\")");
            assert!(
                library.text.contains(&included),
                "src/lib.rs does not include {path}, so nobody runs its programs"
            );
        }
    }
}
