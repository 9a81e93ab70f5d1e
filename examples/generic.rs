//! How do I write code for every machine? How fast two motions part that start side by side, whatever the coordinates are.
//!
//! ```sh
//! cargo run --release --example generic
//! ```

use lagrangian::{Error, Machine, Simulation, State, System, Vector};

/// The factor by which the distance of two runs of `machine` grows in `t` seconds, where the second starts close to the
/// first; coordinates and rates count alike.
pub fn parting<M: Machine>(machine: &M, t: f64) -> Result<f64, Error> {
    const BESIDE: f64 = 1e-7;
    let system = machine.prepare();
    let start = machine.start();
    let mut beside = system.to_vector(&start.q);
    for q in beside.as_mut_slice() {
        *q += BESIDE;
    }
    let count = beside.as_slice().len() as f64;
    let beside = State {
        q: system.to_coordinates(&beside),
        ..start.clone()
    };
    let end = |start: State<_>| -> Result<Vec<f64>, Error> {
        let run = Simulation::new(machine)
            .tolerance(1e-12)
            .until(t)
            .forget_steps()
            .run(start)?;
        let State { q, v, .. } = run.end();
        let (q, v) = (system.to_vector(q), system.to_vector(v));
        Ok([q.as_slice(), v.as_slice()].concat())
    };
    let (one, other) = (end(start)?, end(beside)?);
    let squares = one
        .iter()
        .zip(other)
        .map(|(one, other)| (one - other) * (one - other));
    Ok(squares.sum::<f64>().sqrt() / (BESIDE * count.sqrt()))
}

/// Prints the factor for machines of the library, by name, with their first parameter.
pub fn main() -> Result<(), Error> {
    fn print<M: Machine>(machine: &M) -> Result<(), Error> {
        let first = machine.parameters().next();
        let first = first.map_or_else(String::new, |(of, value)| {
            format!("{} = {value} {}", of.name, of.unit)
        });
        println!(
            "{:16} {first:14} {:8.2}",
            machine.name(),
            parting(machine, 2.0)?
        );
        Ok(())
    }
    print(&lagrangian_machines::SimplePendulum::default())?;
    print(&lagrangian_machines::DoublePendulum::default())?;
    print(&lagrangian_machines::SpringMassTrain::default())
}
