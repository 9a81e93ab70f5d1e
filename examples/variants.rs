//! How do I run a spec without a compiler? One file, read while the program runs, with many sets of parameters.
//!
//! ```sh
//! cargo run --release --features interpreter --example variants
//! ```

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{Machine, Simulation};
use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Files, Sources};

type Failure = Box<dyn std::error::Error>;

/// The machine of a spec, or everything that is wrong with it.
pub fn read(path: &str) -> Result<InterpretedMachine, Failure> {
    let (name, text) = Disk.read(path, None)?;
    let (dag, mut sources, mut report) = (Default::default(), Sources::new(), Report::new());
    let model = lagrangian_spec::model(
        &dag,
        &name,
        &text,
        &[],
        &mut Disk,
        &mut sources,
        &mut report,
    );
    match model.and_then(|model| Compiled::new(model, &mut report)) {
        Some(compiled) => Ok(InterpretedMachine::new(compiled.program)),
        None => Err(report.render(&sources).into()),
    }
}

/// The greatest crushing force of the first second, in N.
pub fn greatest_force(crusher: &InterpretedMachine) -> Result<f64, Failure> {
    let run = Simulation::new(crusher)
        .until(1.0)
        .every(1e-3)
        .run(crusher.start())?;
    let mut greatest: f64 = 0.0;
    for state in run.samples() {
        let seen = run.observe_state(state)?;
        greatest = greatest.max(seen.outputs.get("crushing_force").unwrap_or(0.0));
    }
    Ok(greatest)
}

/// Prints the greatest force for four speeds.
pub fn main() -> Result<(), Failure> {
    let mut crusher = read("machines/cushioned_crusher.machine")?;
    println!("omega [rad/s]  greatest crushing force [kN]");
    for omega in [100.0, 120.0, 140.0, 160.0] {
        crusher.set("omega", omega)?;
        println!("{omega:13} {:29.1}", greatest_force(&crusher)? / 1e3);
    }
    Ok(())
}
