//! Every machine of the library: its functions, and the series of its motion.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use lagrangian_jit::Level;
use lagrangian_mechanics::{Compiled, series::ProvedSeries};
use lagrangian_program::{Program, Role, series::Series};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Files, Sources};
use lagrangian_symbolic::Dag;

use super::check::agrees;
use super::{random, series};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../machines");

/// The number of states for each machine; half of them have NaN, infinite or huge neighbours in other lanes.
const STATES: usize = 48;

/// The program of a machine, and the series of its motion if it has one.
pub fn program_and_series(path: &str) -> (Program, Option<Arc<Series>>) {
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
    let series = ProvedSeries::derive(&compiled.model);
    let series = series.map(|series| series.series().clone());
    (compiled.program.into_program(), series.ok())
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
    let (next, has_friction, has_series) = (
        AtomicUsize::new(0),
        AtomicUsize::new(0),
        AtomicUsize::new(0),
    );
    let seed = random::seed();
    println!("JIT_SEED={seed}");
    let work = || {
        while let Some(file) = files.get(next.fetch_add(1, Ordering::Relaxed)) {
            let (program, of_motion) = program_and_series(file);
            let program = Arc::new(program);
            let parameters = defaults(&program);
            let compared = agrees(&program, &parameters, 1, STATES);
            let compared = compared.unwrap_or_else(|difference| panic!("{file}: {difference}"));
            assert!(compared > 0, "{file}: nothing was compared");
            let friction = program.function(Role::Friction);
            has_friction.fetch_add(friction.iter().len(), Ordering::Relaxed);
            for (level, of_motion) in of_motion
                .iter()
                .flat_map(|of| Level::all().map(move |level| (level, of)))
            {
                for compared in [
                    series::agrees(of_motion, &parameters, level, seed),
                    series::agrees_in_lanes::<4>(of_motion, &parameters, level, seed),
                    series::agrees_in_lanes::<8>(of_motion, &parameters, level, seed),
                ] {
                    let compared =
                        compared.unwrap_or_else(|difference| panic!("{file}: {difference}"));
                    assert!(compared > 0, "{file}: nothing was compared");
                }
            }
            has_series.fetch_add(usize::from(of_motion.is_some()), Ordering::Relaxed);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(work);
        }
    });
    assert!(has_friction.into_inner() > 0, "no machine has contacts");
    let has_series = has_series.into_inner();
    println!("{has_series} machines with series");
    assert!(has_series > 20, "most series are missing");
}
