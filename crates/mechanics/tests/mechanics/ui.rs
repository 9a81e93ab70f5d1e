//! The messages that users see: for every code `tests/ui/` has a spec that makes the mistake, and beside it the
//! printed output. `CODE.SUBJECT.machine` is a further spec for a code, about a subject.
//!
//! After a change of the messages, `UPDATE_UI=1 cargo test -p lagrangian-mechanics --test mechanics ui` writes the
//! current output. Read the difference as a user would.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use lagrangian_mechanics::{Compiled, contradictions};
use lagrangian_spec::diagnostic::{Code, Report};
use lagrangian_spec::source::{InMemory, SOURCE_LIMIT, SourceId, Sources};
use lagrangian_spec::token::lex;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/ui")
}

/// The specs by file name.
fn specs() -> BTreeMap<String, String> {
    let mut specs = BTreeMap::new();
    for entry in std::fs::read_dir(folder()).expect("the folder is part of the repository") {
        let path = entry.expect("the folder can be read").path();
        if path
            .extension()
            .is_some_and(|extension| extension == "machine")
        {
            let name = path
                .file_name()
                .expect("a file has a name")
                .to_string_lossy();
            specs.insert(name.into_owned(), read(&path));
        }
    }
    specs
}

fn read(path: &Path) -> String {
    let text = std::fs::read_to_string(path).unwrap_or_default();
    text.replace("\r\n", "\n")
}

/// All errors of a spec, from the lexer to the equations.
fn printed(specs: &BTreeMap<String, String>, name: &str) -> (String, Vec<Code>) {
    let mut files = InMemory::new();
    for (name, text) in specs {
        files = files.with(name, text);
    }
    // A chain of variants that is too long.
    for number in 0..100 {
        let base = format!("variant{}.machine", number + 1);
        let text = format!("machine Variant extends \"{base}\" {{ gravity (0, 0); }}");
        files = files.with(format!("variant{number}.machine"), text);
    }
    let (dag, mut sources, mut report) = (Default::default(), Sources::new(), Report::new());
    let text = &specs[name];
    let model =
        lagrangian_spec::model(&dag, name, text, &[], &mut files, &mut sources, &mut report);
    let compiled = model.and_then(|model| Compiled::new(model, &mut report));
    assert_eq!(compiled.is_none(), report.has_errors(), "{name}");
    if let Some(compiled) = &compiled {
        contradictions(&compiled.model, &compiled.equations, &mut report);
    }
    let codes = report
        .messages()
        .iter()
        .map(|diagnostic| diagnostic.code)
        .collect();
    (report.render(&sources), codes)
}

#[test]
fn every_mistake_is_told_as_printed_here() {
    let specs = specs();
    let update = std::env::var_os("UPDATE_UI").is_some();
    let mut wrong = Vec::new();
    for name in specs.keys() {
        let (found, codes) = printed(&specs, name);
        let stem = name.trim_end_matches(".machine");
        let code = stem.split('.').next().unwrap_or(stem);
        // `cart.machine` is the correct machine that the others extend.
        let belongs = codes.iter().any(|found| found.as_str() == code);
        assert_eq!(
            belongs,
            code != "cart",
            "{name} makes another mistake:\n{found}"
        );
        let path = folder().join(format!("{stem}.txt"));
        if update && belongs {
            std::fs::write(&path, &found).expect("the folder can be written");
        }
        if read(&path) != found {
            wrong.push(format!("{name} prints now:\n{found}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_code_has_a_spec_that_shows_it() {
    let specs = specs();
    let shown = |code: &Code| specs.contains_key(&format!("{code}.machine"));
    // Four megabytes would be a burden to the repository, and no spec is known that the compiler
    // translates wrongly.
    let without = [Code::SourceTooLarge, Code::Internal];
    let missing: Vec<&Code> = Code::ALL
        .iter()
        .filter(|code| !shown(code) && !without.contains(code))
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn a_text_that_is_too_large_is_refused() {
    let text = " ".repeat(SOURCE_LIMIT + 1);
    let (mut sources, mut report) = (Sources::new(), Report::new());
    sources.add("large.machine", text.as_str());
    lex(SourceId(0), &text, &mut report);
    assert_eq!(
        report.render_short(&sources),
        "large.machine:1:1: error: this text has 4194305 bytes; a spec has at most 4 MiB \
         [source-too-large]\n"
    );
}
