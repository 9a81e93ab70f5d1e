//! For every text the parser ends without a panic, and every message has a position in the text.
#![no_main]

use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::Sources;
use lagrangian_spec::syntax::Spec;
use lagrangian_spec::token::lex;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let mut report = Report::new();
    let mut sources = Sources::new();
    let id = sources.add("fuzz.machine", text);
    let tokens = lex(id, text, &mut report);
    for pair in tokens.windows(2) {
        assert!(pair[0].span.end <= pair[1].span.start, "tokens overlap");
    }
    let spec = Spec::parse(&tokens, id, &mut report);
    assert!(report.has_errors() || !spec.name.text.is_empty());
    for diagnostic in report.diagnostics() {
        let span = diagnostic.span;
        let words = text.get(span.start as usize..span.end as usize);
        assert!(words.is_some(), "no place: {diagnostic:?}");
    }
    report.render(&sources);
});
