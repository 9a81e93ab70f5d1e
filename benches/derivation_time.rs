//! From the text of a machine to its Rust: the processor time of each stage, and how it grows with
//! the size of the machine.
//!
//! ```text
//! cargo bench --bench derivation_time
//! ```

#[path = "../tests/support/mod.rs"]
mod support;
mod timing;

use lagrangian_emit::rust;
use lagrangian_mechanics::Equations;
use lagrangian_mechanics::Proved;
use lagrangian_program::Role;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Sources};
use lagrangian_symbolic::{Dag, Rational};
use support::library;
use timing::{median, seconds};

/// Each machine is compiled at least this many times, and more often
/// until `ENOUGH` seconds are spent.
const LEAST: usize = 3;
const ENOUGH: f64 = 1.0;

/// Seconds of each stage.
#[derive(Clone, Copy)]
struct Times {
    /// Text to model: names found, units checked.
    resolve: f64,
    /// Model to equations of motion.
    derive: f64,
    /// Equations to a program.
    lower: f64,
    /// Proof of the program against Lagrange's equations.
    prove: f64,
    /// Program to Rust.
    emit: f64,
}

impl Times {
    fn total(&self) -> f64 {
        self.resolve + self.derive + self.lower + self.prove + self.emit
    }
}

/// The sizes of the results.
struct Outcome {
    coordinates: usize,
    nodes: usize,
    /// Multiplications and additions of the accelerations.
    operations: usize,
    /// Size of the Rust code.
    bytes: usize,
}

fn main() {
    println!(
        "| machine | n | read, ms | derive, ms | program, ms | proof, ms | proof, share | Rust, ms | all, ms | nodes | operations | Rust, kB |"
    );
    println!("| --- | --: | --: | --: | --: | --: | --: | --: | --: | --: | --: | --: |");
    for machine in [
        "vibrating_crusher",
        "crusher9",
        "cushioned_crusher",
        "heavy_top",
        "six_joint_arm",
    ] {
        row(machine, &[]);
    }
    for machine in ["chain", "chain_relative"] {
        for n in [8, 16, 32, 64] {
            row(machine, &[("N", n)]);
        }
    }
}

fn row(machine: &str, constants: &[(&str, i64)]) {
    let (first, mut outcome) = compile(machine, constants);
    let mut all = vec![first];
    while all.len() < LEAST || all.iter().map(Times::total).sum::<f64>() < ENOUGH {
        let (times, last) = compile(machine, constants);
        all.push(times);
        outcome = last;
    }
    let of = |stage: fn(&Times) -> f64| 1e3 * median(all.iter().map(stage).collect());
    println!(
        "| {machine} | {} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} | {} | {} | {} |",
        outcome.coordinates,
        of(|times| times.resolve),
        of(|times| times.derive),
        of(|times| times.lower),
        of(|times| times.prove),
        // Relative to the whole derivation, from the text to a program.
        of(|times| times.prove) / of(|times| times.resolve + times.derive + times.lower),
        of(|times| times.emit),
        of(Times::total),
        outcome.nodes,
        outcome.operations,
        outcome.bytes / 1000,
    );
}

fn compile(machine: &str, constants: &[(&str, i64)]) -> (Times, Outcome) {
    let (path, text) = (library::path(machine), library::text(machine));
    let constants: Vec<(String, Rational)> = constants
        .iter()
        .map(|&(name, value)| (name.to_owned(), value.into()))
        .collect();
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let (resolve, model) = seconds(|| {
        let files = &mut Disk;
        lagrangian_spec::model(
            &dag,
            &path,
            &text,
            &constants,
            files,
            &mut sources,
            &mut report,
        )
    });
    let model = model.expect("a machine of the library has no mistakes");
    let (derive, equations) = seconds(|| Equations::derive(&model, &mut report));
    let equations = equations.expect("a machine of the library can be derived");
    let (lower, program) = seconds(|| lagrangian_mechanics::lower(&model, &equations));
    let (prove, program) = seconds(|| Proved::new(program, &model, &equations));
    let program = program.expect("a machine of the library is proved");
    let (emit, rust) = seconds(|| rust::module(&program, &rust::Options::default()));
    let accelerations = program
        .function(Role::Accelerations)
        .expect("a machine accelerates");
    let outcome = Outcome {
        coordinates: program.dimension(),
        nodes: dag.len(),
        operations: accelerations.counts().ops(),
        bytes: rust.len(),
    };
    (
        Times {
            resolve,
            derive,
            lower,
            prove,
            emit,
        },
        outcome,
    )
}
