//! The coefficients of a step by Taylor series: as machine code, compared with rustc's code for the same series and with the interpreter of series.
//!
//! ```text
//! cargo bench -p lagrangian-jit --bench series
//! ```

#[path = "../../benches/timing/mod.rs"]
mod timing;

mod machines;

use std::hint::black_box;

use lagrangian::interpreted::{Engine, InterpretedMachine};
use lagrangian::{Machine, System, Vector};
use lagrangian_jit::{Level, SeriesCode};
use lagrangian_mechanics::series::ProvedSeries;
use lagrangian_symbolic::{Dag, Rational};
use timing::{median_of, per_call};

lagrangian::machine!(file = "../machines/double_pendulum.machine");
lagrangian::machine!(file = "../machines/crusher9.machine");
lagrangian::machine! {
    machine HeavyTop extends "../../machines/heavy_top.machine" { methods { taylor } }
}
lagrangian::machine! {
    machine ChainOf16 extends "../../machines/chain.machine" { constants { N = 16 } methods { taylor } }
}

/// The number of coefficients of a coordinate in a step at fine tolerances.
const ROWS: usize = 22;

fn main() {
    let Some(level) = Level::here() else {
        println!("no machine code on this processor, or not in this build");
        return;
    };
    println!("{level:?}. Microseconds a step; in brackets the time of rustc's code.\n");
    println!(
        "| machine | products | interpreter | machine code | derived in | compiled in | bytes |"
    );
    println!("| --- | --: | --: | --: | --: | --: | --: |");
    row(&DoublePendulum::default(), "double_pendulum", &[]);
    row(&Crusher9::default(), "crusher9", &[]);
    row(&HeavyTop::default(), "heavy_top", &[]);
    row(
        &ChainOf16::default(),
        "chain",
        &[("N".into(), Rational::from(16))],
    );
}

fn row<M: Machine>(machine: &M, name: &str, constants: &[(String, Rational)]) {
    let dag = Dag::new();
    let compiled = machines::compiled(&dag, name, constants);
    let (derived_in, proved) = median_of(3, || ProvedSeries::derive(&compiled.model));
    let proved = proved.expect("it has a series");
    let series = proved.series().clone();
    let interpreted = InterpretedMachine::new(compiled.program.clone()).with_series(Ok(proved));
    let mut jitted = interpreted.clone();
    jitted
        .set_engine(Engine::Jit)
        .expect("there is machine code");
    let (compiled_in, code) = median_of(5, || SeriesCode::new(&series).expect("it compiles"));
    let by_rustc = expansion(machine);
    let by_code = expansion(&jitted);
    println!(
        "| {} | {} | {:.2} | {by_code:.3} ({by_rustc:.3}: {:.2}) | {:.1} ms | {:.2} ms | {} |",
        machine.name(),
        series.products(),
        expansion(&interpreted),
        by_code / by_rustc,
        1e3 * derived_in,
        1e3 * compiled_in,
        code.length(),
    );
}

/// The time of the coefficients of a step from the start of a machine, in µs.
fn expansion<M: Machine>(machine: &M) -> f64 {
    let (system, start) = (machine.prepare(), machine.start());
    let (q, u) = (system.to_vector(&start.q), system.default_inputs());
    let mut v = system.to_vector(&start.v);
    v.as_mut_slice().fill(0.5);
    let mut coefficients = vec![q.zeros_like(); ROWS];
    1e6 * per_call(|calls| {
        for _ in 0..calls {
            let t = black_box([0.0; 2]);
            let _ = black_box(system.series(t, &q, &v, &u, &mut coefficients));
            black_box(&coefficients);
        }
    })
}
