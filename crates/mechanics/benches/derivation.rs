//! The time that it takes to derive machines: `cargo bench -p lagrangian-mechanics --bench derivation`.
//!
//! The limits are those of the project: the crusher within 10 ms, a chain of 16 links within 50 ms, one of 64 within 1 s, and
//! growth no worse than n². Resolving the spec is timed separately. The figures are means of several runs, in processor time
//! where the system provides it (Linux), so that other programs have little influence.

use std::path::Path;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use lagrangian_mechanics::Equations;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Sources};
use lagrangian_symbolic::{Dag, Rational};

const RUNS: usize = 9;
const LEAST: Duration = Duration::from_millis(500);

fn main() {
    println!(
        "{:<28}{:>12}{:>12}{:>10}{:>10}",
        "machine", "resolve", "derive", "nodes", "growth"
    );
    for name in [
        "vibrating_crusher",
        "cushioned_crusher",
        "heavy_top",
        "six_joint_arm",
    ] {
        show(name, &mean(name, None), None);
    }
    for name in ["chain", "chain_relative"] {
        let mut before: Option<Measured> = None;
        for n in [8, 16, 32, 64, 128] {
            let measured = mean(name, Some(n));
            show(&format!("{name} N={n}"), &measured, before.as_ref());
            before = Some(measured);
        }
    }
}

/// The time for which this thread has run, or else the time that has passed.
fn now() -> Duration {
    static START: OnceLock<Instant> = OnceLock::new();
    let spent = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = spent.and_then(|text| text.split_whitespace().next()?.parse().ok());
    nanoseconds.map_or_else(
        || START.get_or_init(Instant::now).elapsed(),
        Duration::from_nanos,
    )
}

struct Measured {
    resolve: Duration,
    derive: Duration,
    nodes: usize,
}

/// The mean over several runs, since the system counts in steps of some milliseconds.
fn mean(name: &str, size: Option<i64>) -> Measured {
    let start = now();
    let mut runs: Vec<Measured> = Vec::new();
    while runs.len() < RUNS || now() - start < LEAST {
        runs.push(measure(name, size));
    }
    let count = runs.len() as u32;
    Measured {
        resolve: runs.iter().map(|run| run.resolve).sum::<Duration>() / count,
        derive: runs.iter().map(|run| run.derive).sum::<Duration>() / count,
        nodes: runs[0].nodes,
    }
}

fn measure(name: &str, size: Option<i64>) -> Measured {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../machines")
        .join(name)
        .with_extension("machine");
    let text = std::fs::read_to_string(&path).expect("a machine of the library");
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let constants: Vec<_> = size
        .map(|n| ("N".to_owned(), Rational::from(n)))
        .into_iter()
        .collect();
    let name = path.to_string_lossy();
    let files = &mut Disk;
    let start = now();
    let model = lagrangian_spec::model(
        &dag,
        &name,
        &text,
        &constants,
        files,
        &mut sources,
        &mut report,
    )
    .expect("the library has no errors");
    let resolve = now() - start;
    let start = now();
    let equations = Equations::derive(&model, &mut report);
    let derive = now() - start;
    assert!(equations.is_some(), "the library can be derived");
    Measured {
        resolve,
        derive,
        nodes: dag.len(),
    }
}

/// Prints a line; the growth is the exponent e in `time ∝ nᵉ`, relative to half the size.
fn show(label: &str, now: &Measured, before: Option<&Measured>) {
    let growth =
        before.map(|before| (now.derive.as_secs_f64() / before.derive.as_secs_f64()).log2());
    let growth = growth.map_or(String::new(), |exponent| format!("n^{exponent:.2}"));
    println!(
        "{label:<28}{:>9.2} ms{:>9.2} ms{:>10}{growth:>10}",
        1e3 * now.resolve.as_secs_f64(),
        1e3 * now.derive.as_secs_f64(),
        now.nodes,
    );
}
