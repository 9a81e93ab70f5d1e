//! Runs of a sweep per second on one core, in lanes and one after the other.
//!
//! The bench checks that both give the same rows; rounds alternate, and the best of each counts. Names of machines as arguments choose
//! among them.

use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use lagrangian::interpreted::Engine;
use lagrangian_sweep::design::Factor;
use lagrangian_sweep::plan::{Function, Reduction, SpecText};
use lagrangian_sweep::{Plan, Sweep};

const RUNS: u64 = 512;
const ROUNDS: usize = 7;

fn plan(machine: &str, until: f64, varied: [(&str, f64, f64); 1], tolerance: f64) -> Plan {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    let path = path.join(machine).with_extension("machine");
    let factor = |(name, from, to): (&str, f64, f64)| Factor::Grid {
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
        tolerance,
        design: varied.map(factor).into(),
        chunk: RUNS,
        ..Plan::new(spec, until)
    }
}

/// Runs per second, in pieces of `piece` runs, and the rows.
fn measure(sweep: &Sweep, piece: u64) -> (f64, String) {
    let (stop, mut all) = (AtomicBool::new(false), sweep.empty_rows());
    let began = Instant::now();
    for from in (0..RUNS).step_by(piece as usize) {
        let chunk = sweep.run(from..RUNS.min(from + piece), &stop, &|_| ());
        all.extend(chunk.expect("nobody stops it").rows);
    }
    (
        RUNS as f64 / began.elapsed().as_secs_f64(),
        format!("{all:?}"),
    )
}

fn main() {
    println!("| machine | tolerance | kept | alone, runs/s | in lanes | ratio |");
    println!("| --- | --- | --- | --- | --- | --- |");
    let chosen: Vec<String> = std::env::args().skip(1).collect();
    let chosen: Vec<&String> = chosen
        .iter()
        .filter(|name| !name.starts_with('-'))
        .collect();
    let machines = [
        (
            "double_pendulum",
            10.0,
            ("start(theta1)", 0.1, 3.0),
            "theta2",
        ),
        ("vibrating_crusher", 1.0, ("start(x)", 0.0, 0.01), "x"),
        ("four_bar", 2.0, ("omega", 4.0, 8.0), "rocker"),
        ("contacts/bouncing_ball", 3.0, ("e", 0.5, 0.9), "y"),
        ("contacts/impact_oscillator", 30.0, ("w", 2.0, 4.0), "x"),
        ("contacts/woodpecker", 0.5, ("mu", 0.25, 0.35), "phiS"),
        ("contacts/colliding_crusher", 0.2, ("w", 100.0, 170.0), "x"),
    ];
    for (machine, until, varied, of) in machines {
        if !chosen.is_empty() && !chosen.iter().any(|name| machine.ends_with(name.as_str())) {
            continue;
        }
        for (tolerance, reduces) in [(1e-6, false), (1e-9, false), (1e-9, true)] {
            let mut plan = plan(machine, until, [varied], tolerance);
            if reduces {
                plan.reduce.push(Reduction {
                    name: "peak".into(),
                    function: Function::Max,
                    of: format!("abs({of})"),
                });
            }
            let sweep = match Sweep::new(plan, Engine::Jit) {
                Ok(sweep) => sweep,
                Err(error) => {
                    println!("no machine code here: {error:?}");
                    return;
                }
            };
            let (mut alone, mut in_lanes) = (Vec::new(), Vec::new());
            for _ in 0..ROUNDS {
                // A piece of one run uses no lanes.
                let (one, rows) = measure(&sweep, 1);
                let (many, same) = measure(&sweep, RUNS);
                assert!(rows == same, "{machine}: other rows in lanes");
                alone.push(one);
                in_lanes.push(many);
            }
            let best = |speeds: Vec<f64>| speeds.into_iter().fold(0.0, f64::max);
            let (alone, in_lanes) = (best(alone), best(in_lanes));
            let kept = if reduces { "end, a maximum" } else { "end" };
            println!(
                "| `{machine}` | {tolerance:e} | {kept} | {alone:.0} | {in_lanes:.0} | {:.2} |",
                in_lanes / alone
            );
        }
    }
}
