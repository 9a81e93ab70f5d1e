//! Every text either resolves to a model, or a report explains why not.
#![no_main]

use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{InMemory, Sources};
use libfuzzer_sys::fuzz_target;

const CRUSHER: &str = include_str!("../../machines/vibrating_crusher.machine");

/// The machines that a variant may extend: a valid one, and one that extends itself.
const BASES: [(&str, &str); 3] = [
    ("base.machine", CRUSHER),
    ("vibrating_crusher.machine", CRUSHER),
    (
        "circle.machine",
        "machine Circle extends \"circle.machine\" { bodies {} }",
    ),
];

fuzz_target!(|text: &str| {
    let mut files = InMemory::new();
    for (name, base) in BASES {
        files = files.with(name, base);
    }
    let (dag, mut sources, mut report) = (Default::default(), Sources::new(), Report::new());
    let model = lagrangian_spec::model(
        &dag,
        "fuzz.machine",
        text,
        &[],
        &mut files,
        &mut sources,
        &mut report,
    );
    assert_eq!(model.is_none(), report.has_errors());
    report.render(&sources);
});
