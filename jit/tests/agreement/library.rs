//! Every machine of the library.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use lagrangian_jit::Level;
use lagrangian_mechanics::Compiled;
use lagrangian_program::{Program, Role};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Files, Sources};
use lagrangian_symbolic::Dag;

use super::check::agrees;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../machines");

/// The number of states for each machine; half of them have NaN, infinite or huge neighbours in other lanes.
const STATES: usize = 48;

pub fn program(path: &str) -> Program {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let (name, text) = Disk.read(path, None).expect("the library is there");
    let model = lagrangian_spec::model(
        &dag,
        &name,
        &text,
        &[],
        &mut Disk,
        &mut sources,
        &mut report,
    );
    let compiled = model.and_then(|model| Compiled::new(model, &mut report));
    let compiled = compiled.unwrap_or_else(|| panic!("{}", report.render_short(&sources)));
    compiled.program.into_program()
}

pub fn defaults(program: &Program) -> Vec<f64> {
    let slots = program.parameters.iter();
    let defaults = slots.map(|slot| slot.default.as_ref().map_or(1.0, |default| default.value));
    defaults.collect()
}

#[test]
fn every_machine_of_the_library_has_the_bits_of_the_interpreter() {
    if Level::here().is_none() {
        println!("no machine code on this processor, or not in this build");
        return;
    }
    let files = std::fs::read_dir(FOLDER).expect("the library is there");
    let mut files: Vec<String> = files
        .map(|file| file.expect("it can be read").path().display().to_string())
        .filter(|file| file.ends_with(".machine"))
        .collect();
    files.sort();
    assert!(files.len() > 40, "most of the library is missing");
    let (next, has_friction) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let work = || {
        while let Some(file) = files.get(next.fetch_add(1, Ordering::Relaxed)) {
            let program = Arc::new(program(file));
            let parameters = defaults(&program);
            let compared = agrees(&program, &parameters, 1, STATES);
            let compared = compared.unwrap_or_else(|difference| panic!("{file}: {difference}"));
            assert!(compared > 0, "{file}: nothing was compared");
            let friction = program.function(Role::Friction);
            has_friction.fetch_add(friction.iter().len(), Ordering::Relaxed);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(work);
        }
    });
    assert!(has_friction.into_inner() > 0, "no machine has contacts");
}
