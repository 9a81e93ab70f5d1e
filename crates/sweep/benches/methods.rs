//! Sweeps by `dop853`, by Taylor series, and by the methods that `auto` chooses, in lanes and one run after the other.
//!
//! Rounds alternate between all of them, and the best of each counts. Names of machines as arguments choose among them.
//!
//! ```text
//! cargo bench -p lagrangian-sweep --features jit --bench methods
//! ```

use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use lagrangian::interpreted::Engine;
use lagrangian_sweep::design::Factor;
use lagrangian_sweep::plan::SpecText;
use lagrangian_sweep::{Plan, Sweep};

const RUNS: u64 = 128;
const ROUNDS: usize = 7;

fn plan(machine: &str, until: f64, varied: (&str, f64, f64)) -> Plan {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    let path = path.join(machine).with_extension("machine");
    let (name, from, to) = varied;
    let factor = Factor::Grid {
        name: name.into(),
        from,
        to,
        count: RUNS,
        log: false,
    };
    let spec = SpecText {
        name: machine.into(),
        text: std::fs::read_to_string(path).expect("a machine of the library"),
        ..SpecText::default()
    };
    Plan {
        design: vec![factor],
        chunk: RUNS,
        ..Plan::new(spec, until)
    }
}

/// The time of all runs in pieces of `piece` runs, in ms, and the rows.
fn measure(sweep: &Sweep, piece: u64) -> (f64, String) {
    let (stop, mut all) = (AtomicBool::new(false), sweep.empty_rows());
    let began = Instant::now();
    for from in (0..RUNS).step_by(piece as usize) {
        let chunk = sweep.run(from..RUNS.min(from + piece), &stop, &|_| ());
        all.extend(chunk.expect("nobody stops it").rows);
    }
    (1e3 * began.elapsed().as_secs_f64(), format!("{all:?}"))
}

fn main() {
    println!(
        "| machine | tolerance | `dop853` alone: ms | in lanes | `taylor` alone | in lanes | `auto` alone | in lanes | `dop853` over `taylor`, in lanes | over `auto` |"
    );
    println!("| --- | --- | --: | --: | --: | --: | --: | --: | --: | --: |");
    let chosen: Vec<String> = std::env::args().skip(1).collect();
    let chosen: Vec<&String> = chosen
        .iter()
        .filter(|name| !name.starts_with('-'))
        .collect();
    let machines = [
        ("double_pendulum", 100.0, ("start(theta1)", 0.1, 3.0)),
        ("crusher9", 5.0, ("start(x)", 0.0, 0.01)),
        ("vibrating_crusher", 5.0, ("start(x)", 0.0, 0.01)),
        ("elastic_pendulum", 100.0, ("rate(theta)", 0.0, 1.0)),
        ("heavy_top", 50.0, ("rate(psi)", 0.0, 1.0)),
        ("chain", 10.0, ("g", 5.0, 15.0)),
        ("four_bar", 10.0, ("omega", 4.0, 8.0)),
    ];
    for (machine, until, varied) in machines {
        if !chosen.is_empty() && !chosen.iter().any(|name| machine == name.as_str()) {
            continue;
        }
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let sweeps = ["dop853", "taylor", "auto"].map(|method| {
                let mut plan = plan(machine, until, varied);
                (plan.tolerance, plan.method) = (tolerance, method.into());
                let sweep = Sweep::new(plan, Engine::Jit);
                sweep.unwrap_or_else(|error| panic!("{machine}: {error:?}"))
            });
            let mut best = [[f64::INFINITY; 2]; 3];
            for _ in 0..ROUNDS {
                for (sweep, best) in sweeps.iter().zip(&mut best) {
                    // A piece of one run uses no lanes.
                    let (alone, rows) = measure(sweep, 1);
                    let (in_lanes, same) = measure(sweep, RUNS);
                    assert!(rows == same, "{machine}: other rows in lanes");
                    *best = [best[0].min(alone), best[1].min(in_lanes)];
                }
            }
            let times = best.iter().flatten().map(|time| format!("{time:.1} | "));
            let [dop853, taylor, auto] = best.map(|[_, in_lanes]| in_lanes);
            println!(
                "| `{machine}` | {tolerance:e} | {}{:.2} | {:.2} |",
                times.collect::<String>(),
                dop853 / taylor,
                dop853 / auto,
            );
        }
    }
}
