//! For every valid machine either its equations and its program are derived, or a report explains
//! why not. The numbers of the program are unrestricted; nothing may panic.
#![no_main]

use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{InMemory, Sources};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let (dag, mut sources, mut report) = (Default::default(), Sources::new(), Report::new());
    let model = lagrangian_spec::model(
        &dag,
        "fuzz.machine",
        text,
        &[],
        &mut InMemory::new(),
        &mut sources,
        &mut report,
    );
    // Large machines are slow to derive, and reveal nothing that small ones do not.
    let small = model.filter(|model| model.coordinates.len() <= 8 && dag.len() <= 3000);
    if let Some(model) = small {
        let compiled = Compiled::new(model, &mut report);
        assert_eq!(compiled.is_none(), report.has_errors());
    }
    report.render(&sources);
});
