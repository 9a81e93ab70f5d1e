//! Machines with contacts by Taylor series, in flights and while contacts are closed, and by `dop853`: times and errors of both, run alternately.
//!
//! ```text
//! cargo bench --workspace --bench flights
//! ```
//!
//! The machines run as machine code. A time is the least of fifteen runs; an error is the greatest difference of a coordinate or rate at the end from a run by the
//! other method at a tolerance of 1e-14.

use std::path::Path;
use std::time::Instant;

use lagrangian::interpreted::{Engine, InterpretedMachine, Named};
use lagrangian::{Machine, Method, Simulation, Solution, State, TAYLOR};

const ROUNDS: usize = 15;

/// A machine, the end of the runs whose errors are measured, and that of the runs whose times are.
type Case = (&'static str, InterpretedMachine, f64, f64);

fn main() {
    println!(
        "| machine | tolerance | error of `dop853` | of `taylor` | `dop853` | `taylor` | ratio |"
    );
    println!("| --- | --: | --: | --: | --: | --: | --: |");
    let wall = include_str!("../tests/data/flights/wall.machine");
    let yielding = include_str!("../tests/data/flights/yielding.machine");
    let mut oscillator = of_library("impact_oscillator");
    for (name, value) in [("F", 1.0), ("stop", -0.2)] {
        oscillator.set(name, value).expect("a parameter");
    }
    let rolling = include_str!("../tests/data/flights/rolling.machine");
    let rubbing = include_str!("../tests/data/flights/rubbing.machine");
    let cases: [Case; 9] = [
        ("bouncing ball", of_library("bouncing_ball"), 4.0, 4.0),
        ("impact oscillator", oscillator, 40.0, 400.0),
        ("double pendulum before a wall", machine(wall), 3.0, 50.0),
        ("ball and ceiling that yields", machine(yielding), 3.0, 50.0),
        ("woodpecker", of_library("woodpecker"), 0.6, 1.0),
        (
            "colliding crusher",
            of_library("colliding_crusher"),
            0.4,
            0.4,
        ),
        ("rocking block", of_library("rocking_block"), 2.0, 3.0),
        ("disc that rolls", machine(rolling), 5.0, 50.0),
        ("point that slides", machine(rubbing), 5.0, 50.0),
    ];
    for case in cases {
        rows(case);
    }
}

fn rows((name, mut machine, until, long): Case) {
    machine.set_engine(Engine::Jit).expect("machine code");
    let methods = [Method::DOP853, &TAYLOR];
    let references = [&TAYLOR, Method::DOP853].map(|method| made(&machine, method, (1e-14, until)));
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let mut least = [f64::INFINITY; 2];
        for _ in 0..ROUNDS {
            for (least, method) in least.iter_mut().zip(methods) {
                let clock = Instant::now();
                made(&machine, method, (tolerance, long));
                *least = least.min(clock.elapsed().as_secs_f64());
            }
        }
        let [one, other] = [0, 1].map(|which| {
            let run = made(&machine, methods[which], (tolerance, until));
            distance(run.end(), references[which].end())
        });
        println!(
            "| {name} | {tolerance:.0e} | {one:.1e} | {other:.1e} | {:.0} µs | {:.0} µs | {:.2} |",
            1e6 * least[0],
            1e6 * least[1],
            least[1] / least[0]
        );
    }
}

/// The text of a machine with its series.
fn machine(text: &str) -> InterpretedMachine {
    let machine = InterpretedMachine::from_text(text).with_series().build();
    machine.unwrap_or_else(|error| panic!("{error}"))
}

fn of_library(name: &str) -> InterpretedMachine {
    let machines = Path::new(env!("CARGO_MANIFEST_DIR")).join("machines/contacts");
    let text = std::fs::read_to_string(machines.join(format!("{name}.machine")));
    machine(&text.expect("a machine of the library"))
}

fn made(
    machine: &InterpretedMachine,
    method: &'static Method,
    (tolerance, until): (f64, f64),
) -> Solution<InterpretedMachine> {
    let run = Simulation::new(machine)
        .method(method)
        .tolerance(tolerance)
        .until(until)
        .forget_steps();
    run.run(machine.start()).expect("it runs")
}

/// The greatest difference of two states.
fn distance(one: &State<Named>, other: &State<Named>) -> f64 {
    let numbers = |of: &State<Named>| [of.q.values.clone(), of.v.values.clone()].concat();
    let pairs = numbers(one).into_iter().zip(numbers(other));
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
