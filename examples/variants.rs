//! How do I run a spec without a compiler? One file, read while the program runs, with many sets of parameters.
//!
//! ```sh
//! cargo run --release --example variants
//! ```

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{Error, Machine, Simulation};

/// The largest crushing force in the first second, in N.
pub fn greatest_force(crusher: &InterpretedMachine) -> Result<f64, Error> {
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

/// Prints the largest force for four speeds.
pub fn main() -> Result<(), Error> {
    // The library's file, whatever the folder in which this program runs.
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../machines/cushioned_crusher.machine"
    );
    let mut crusher = InterpretedMachine::from_file(file)?;
    println!("omega [rad/s]  greatest crushing force [kN]");
    for omega in [100.0, 120.0, 140.0, 160.0] {
        crusher.set("omega", omega)?;
        println!("{omega:13} {:29.1}", greatest_force(&crusher)? / 1e3);
    }
    Ok(())
}
