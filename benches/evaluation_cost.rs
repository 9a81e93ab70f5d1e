//! The cost of one evaluation of the accelerations: time and operations for every machine of the
//! library, compiled, in lanes and interpreted, and the accuracy of the result.
//!
//! ```text
//! cargo bench --bench evaluation_cost
//! ```

#[path = "../tests/support/mod.rs"]
mod support;
mod timing;

use std::hint::black_box;

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{Batch, Batched, LaneVector, Lanes, Machine, Number, System, Vector};
use lagrangian_mechanics::Proved;
use lagrangian_program::{Program, Role};
use support::accuracy::Judge;
use support::library;
use support::sampling::{Random, Sample};
use support::states::{accelerations, vector};
use timing::{median, per_call};

/// Successive calls get different states, so that nothing can be computed once for all.
const STATES: usize = 1024;
/// The number of states at which the error is measured.
const JUDGED: usize = 256;

/// Nanoseconds per call.
struct Cost {
    /// For calls that do not depend on one another, so that the processor can overlap them.
    throughput: f64,
    /// For calls of which each needs the result of the one before, as in an integrator.
    latency: f64,
}

fn main() {
    println!(
        "| machine | n | mul | add | div | sin cos | compiled: ns, in a row | independent | 2 lanes: ns a state | 4 | 8 | interpreted: ns, in a row | ratio | median error | worst |"
    );
    println!(
        "| --- | --: | --: | --: | --: | --: | --: | --: | --: | --: | --: | --: | --: | --: | --: |"
    );
    macro_rules! measure {
        ($machine:ident, $name:literal) => {
            row(
                &lagrangian_machines::$machine::default(),
                &library::program($name, &[]),
            );
        };
    }
    for_each_machine!(measure);
    for_each_constrained_machine!(measure);
}

fn row<M: Machine>(machine: &M, program: &Proved)
where
    M::System: Batched<2> + Batched<4> + Batched<8>,
{
    let mut random = Random::new(machine, 20_260_001);
    let samples: Vec<Sample> = (0..STATES).map(|_| random.sample()).collect();
    let interpreted = InterpretedMachine::new(program.clone());
    let compiled = cost(&machine.prepare(), &samples);
    let system = machine.prepare();
    let [two, four, eight] = [
        cost_in_lanes::<_, 2>(&system, &samples),
        cost_in_lanes::<_, 4>(&system, &samples),
        cost_in_lanes::<_, 8>(&system, &samples),
    ];
    let by_interpreter = cost(&interpreted.prepare(), &samples);
    let errors = errors(machine, program, &samples[..JUDGED]);
    let counts = program
        .function(Role::Accelerations)
        .expect("a machine accelerates")
        .counts();
    println!(
        "| {} | {} | {} | {} | {} | {} | {:.1} | {:.1} | {two:.1} | {four:.1} | {eight:.1} | {:.0} | {:.1} | {:.1e} | {:.1e} |",
        program.name,
        program.dimension(),
        counts.multiplications,
        counts.additions,
        counts.divisions,
        counts.sincos,
        compiled.latency,
        compiled.throughput,
        by_interpreter.latency,
        by_interpreter.latency / compiled.latency,
        median(errors.clone()),
        errors
            .iter()
            .fold(0.0, |worst, error| f64::max(worst, *error)),
    );
}

fn cost<S: System>(system: &S, samples: &[Sample]) -> Cost {
    let u = system.default_inputs();
    let states: Vec<(f64, S::Vector, S::Vector)> = samples
        .iter()
        .map(|at| (at.t, vector::<S>(&at.q), vector::<S>(&at.v)))
        .collect();
    let n = samples[0].q.len();

    let mut a = S::Vector::zeros(n);
    let throughput = per_call(|calls| {
        for (t, q, v) in states.iter().cycle().take(calls) {
            // A singular state would be an error of the machine, which tests look for.
            let _ = black_box(system.accelerations(*t, q, v, &u, &mut a));
            black_box(&a);
        }
    });

    // Adding a number far below their round-off leaves the states unchanged, but makes
    // them depend on the last result.
    const NOTHING: f64 = 1e-200;
    let (mut q, mut v) = (S::Vector::zeros(n), S::Vector::zeros(n));
    let latency = per_call(|calls| {
        for (t, q_next, v_next) in states.iter().cycle().take(calls) {
            let rows = [(&mut q, q_next), (&mut v, v_next)];
            for (row, next) in rows {
                let (row, next) = (row.as_mut_slice(), next.as_slice());
                for ((x, next), a) in row.iter_mut().zip(next).zip(a.as_slice()) {
                    *x = next + NOTHING * a;
                }
            }
            let _ = black_box(system.accelerations(*t, &q, &v, &u, &mut a));
        }
        black_box(&a);
    });
    Cost {
        throughput: 1e9 * throughput,
        latency: 1e9 * latency,
    }
}

/// Nanoseconds for each of several states in lanes, for calls that do not depend on one another.
fn cost_in_lanes<S: Batched<N>, const N: usize>(system: &S, samples: &[Sample]) -> f64
where
    Lanes<N>: Number,
{
    let several = Batch::of(system);
    let u = several.default_inputs(system);
    let states: Vec<(Lanes<N>, S::Vectors, S::Vectors)> = samples
        .as_chunks()
        .0
        .iter()
        .map(|states: &[Sample; N]| {
            let q = states.each_ref().map(|at| vector::<S>(&at.q));
            let v = states.each_ref().map(|at| vector::<S>(&at.v));
            (
                Lanes(states.each_ref().map(|at| at.t)),
                several.vectors(q.each_ref()),
                several.vectors(v.each_ref()),
            )
        })
        .collect();
    let mut a = S::Vectors::ZEROS;
    let seconds = per_call(|calls| {
        for (t, q, v) in states.iter().cycle().take(calls) {
            let _ = black_box(several.accelerations(*t, q, v, &u, &mut a));
            black_box(&a);
        }
    });
    1e9 * seconds / N as f64
}

/// The largest error of an acceleration divided by the largest acceleration, at
/// each state, against 30 digits.
fn errors<M: Machine>(machine: &M, program: &Program, samples: &[Sample]) -> Vec<f64> {
    let parameters: Vec<f64> = machine.parameters().map(|(_, value)| value).collect();
    let mut judge = Judge::new(program, &parameters);
    let system = machine.prepare();
    let inputs = system.default_inputs(); // `accelerations` is given these, too
    let u: Vec<f64> = system.input_values(&inputs).map(|(_, u)| u).collect();
    let error = |at: &Sample| {
        let a = accelerations(&system, at.t, &at.q, &at.v).expect("not singular");
        judge
            .relative_error((at.t, &at.q, &at.v, &u), &a)
            .expect("not singular")
    };
    samples.iter().map(error).collect()
}
