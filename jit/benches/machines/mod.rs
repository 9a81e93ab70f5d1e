//! Machines of the library, derived while a bench runs.

use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Files, Sources};
use lagrangian_symbolic::{Dag, Rational};

/// A machine of `machines/`, with these values for its constants.
pub fn compiled<'d>(dag: &'d Dag, name: &str, constants: &[(String, Rational)]) -> Compiled<'d> {
    let (mut sources, mut report) = (Sources::new(), Report::new());
    let path = format!("{}/../machines/{name}.machine", env!("CARGO_MANIFEST_DIR"));
    let (name, text) = Disk.read(&path, None).expect("the library is there");
    lagrangian_spec::model(
        dag,
        &name,
        &text,
        constants,
        &mut Disk,
        &mut sources,
        &mut report,
    )
    .and_then(|model| Compiled::new(model, &mut report))
    .expect("the library compiles")
}
