//! Machine code compared with rustc's code for the same program and with the interpreter, in one run: one state, 4 and 8
//! lanes, and the compile time.
//!
//! ```text
//! cargo bench -p lagrangian-jit --bench engines
//! ```

#[path = "../../benches/timing/mod.rs"]
mod timing;

mod machines;

use std::hint::black_box;
use std::sync::Arc;

use lagrangian::interpreted::{Engine, InterpretedMachine};
use lagrangian::{Batch, Batched, Lanes, Machine, Number, System, Vector};
use lagrangian_jit::{Code, Level, Library, Running, Several, SeveralArguments, When};
use lagrangian_program::{Arguments, Interpreter, Program, Role};
use lagrangian_symbolic::{Dag, Rational};
use timing::{median_of, per_call};

lagrangian::machine!(file = "../machines/double_pendulum.machine");
lagrangian::machine!(file = "../machines/vibrating_crusher.machine");
lagrangian::machine!(file = "../machines/six_joint_arm.machine");
lagrangian::machine!(file = "../machines/chain.machine", N = 64);

/// Successive calls get different states, so that nothing can be computed once for all.
const STATES: usize = 256;

fn main() {
    let Some(level) = Level::here() else {
        println!("no machine code on this processor, or not in this build");
        return;
    };
    println!("{level:?}. Nanoseconds a state; in brackets the time of rustc's code.\n");
    println!(
        "| machine | operations | interpreter | machine code: one state | as a system | 4 lanes | 8 lanes | derived in | compiled in | bytes |"
    );
    println!("| --- | --: | --: | --: | --: | --: | --: | --: | --: | --: |");
    row(&DoublePendulum::default(), "double_pendulum", &[]);
    row(&VibratingCrusher::default(), "vibrating_crusher", &[]);
    row(&SixJointArm::default(), "six_joint_arm", &[]);
    row(
        &Chain::default(),
        "chain",
        &[("N".into(), Rational::from(64))],
    );
}

struct State {
    t: f64,
    q: Vec<f64>,
    v: Vec<f64>,
}

fn states(start: &[f64]) -> Vec<State> {
    let mut bits = 1u64;
    let mut any = || {
        // xorshift64*, S. Vigna, An experimental exploration of Marsaglia's xorshift generators, 2016.
        bits ^= bits >> 12;
        bits ^= bits << 25;
        bits ^= bits >> 27;
        (bits.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    (0..STATES)
        .map(|_| State {
            t: any(),
            q: start
                .iter()
                .map(|q| q * (1.0 + 0.3 * any()) + 0.02 * any())
                .collect(),
            v: start.iter().map(|_| 3.0 * any()).collect(),
        })
        .collect()
}

fn row<M: Machine>(machine: &M, name: &str, constants: &[(String, Rational)])
where
    M::System: Batched<4> + Batched<8>,
{
    let (derived_in, proved) = median_of(3, || {
        machines::compiled(&Dag::new(), name, constants).program
    });
    let interpreted = InterpretedMachine::new(proved.clone());
    let mut jitted = interpreted.clone();
    jitted
        .set_engine(Engine::Jit)
        .expect("there is machine code");
    let program: Arc<Program> = Arc::new(proved.into_program());
    let system = machine.prepare();
    let start = machine.start();
    let start = system.to_vector(&start.q).as_slice().to_vec();
    let states = states(&start);

    let by_interpreter = one(&interpreted.prepare(), &states);
    let by_rustc = one(&system, &states);
    let as_system = one(&jitted.prepare(), &states);
    let interpreter = Interpreter::new(&program, interpreted.parameter_values());
    let library = Arc::new(Library::new(program.clone()).expect("there is machine code"));
    let inputs = vec![0.0; program.inputs.len()];
    let alone = direct(
        Running::new(library.clone(), When::Always, &interpreter),
        &states,
        &inputs,
    );
    let lanes = [
        (
            in_lanes::<4>(&program, &interpreter, &states),
            rustc_in_lanes::<_, 4>(&system, &states),
        ),
        (
            in_lanes::<8>(&program, &interpreter, &states),
            rustc_in_lanes::<_, 8>(&system, &states),
        ),
    ];
    let function = program
        .function(Role::Accelerations)
        .expect("a machine accelerates");
    let layout = library.layout();
    let (compiled_in, code) = median_of(5, || {
        Code::new(function, true, layout).expect("it compiles")
    });
    let beside = |ours: f64, rustc: f64| format!("{ours:.1} ({rustc:.1}: {:.2})", ours / rustc);
    println!(
        "| {} | {} | {by_interpreter:.0} | {} | {} | {} | {} | {:.1} ms | {:.2} ms | {} |",
        program.name,
        function.code.len(),
        beside(alone, by_rustc),
        beside(as_system, by_rustc),
        beside(lanes[0].0, lanes[0].1),
        beside(lanes[1].0, lanes[1].1),
        1e3 * derived_in,
        1e3 * compiled_in,
        code.length(),
    );
}

/// Times calls through `System`.
fn one<S: System>(system: &S, states: &[State]) -> f64 {
    let u = system.default_inputs();
    let vector = |values: &[f64]| {
        let mut vector = S::Vector::zeros(values.len());
        vector.as_mut_slice().copy_from_slice(values);
        vector
    };
    let states: Vec<(f64, S::Vector, S::Vector)> = states
        .iter()
        .map(|state| (state.t, vector(&state.q), vector(&state.v)))
        .collect();
    let mut a = S::Vector::zeros(states[0].1.as_slice().len());
    1e9 * per_call(|calls| {
        for (t, q, v) in states.iter().cycle().take(calls) {
            let _ = black_box(system.accelerations(*t, q, v, &u, &mut a));
            black_box(&a);
        }
    })
}

/// Times calls of the machine code alone.
fn direct(mut running: Running, states: &[State], inputs: &[f64]) -> f64 {
    let mut a = vec![0.0; states[0].q.len()];
    1e9 * per_call(|calls| {
        for state in states.iter().cycle().take(calls) {
            let arguments = Arguments {
                t: state.t,
                q: &state.q,
                v: &state.v,
                u: inputs,
                a: &[],
            };
            assert!(running.call(Role::Accelerations, arguments, &mut a));
            black_box(&a);
        }
    })
}

fn rustc_in_lanes<S: Batched<N>, const N: usize>(system: &S, states: &[State]) -> f64
where
    Lanes<N>: Number,
{
    let several = Batch::of(system);
    let u = several.default_inputs(system);
    let vector = |values: &[f64]| {
        let mut vector = S::Vector::zeros(values.len());
        vector.as_mut_slice().copy_from_slice(values);
        vector
    };
    let states: Vec<(Lanes<N>, S::Vectors, S::Vectors)> = states
        .as_chunks()
        .0
        .iter()
        .map(|states: &[State; N]| {
            let q = states.each_ref().map(|state| vector(&state.q));
            let v = states.each_ref().map(|state| vector(&state.v));
            (
                Lanes(states.each_ref().map(|state| state.t)),
                several.vectors(q.each_ref()),
                several.vectors(v.each_ref()),
            )
        })
        .collect();
    let mut a = states[0].1;
    1e9 / N as f64
        * per_call(|calls| {
            for (t, q, v) in states.iter().cycle().take(calls) {
                let _ = black_box(several.accelerations(*t, q, v, &u, &mut a));
                black_box(&a);
            }
        })
}

fn in_lanes<const N: usize>(
    program: &Arc<Program>,
    interpreter: &Interpreter<f64>,
    states: &[State],
) -> f64 {
    let library = Library::for_lanes(program.clone(), N, true).expect("there is machine code");
    let mut several = Several::<N>::shared(Arc::new(library), interpreter).expect("it is shared");
    let states: Vec<(Lanes<N>, Vec<Lanes<N>>, Vec<Lanes<N>>)> = states
        .as_chunks()
        .0
        .iter()
        .map(|states: &[State; N]| {
            let n = states[0].q.len();
            let rows = |of: fn(&State) -> &[f64]| -> Vec<Lanes<N>> {
                let row = |index| Lanes(states.each_ref().map(|state| of(state)[index]));
                (0..n).map(row).collect()
            };
            (
                Lanes(states.each_ref().map(|state| state.t)),
                rows(|state| &state.q),
                rows(|state| &state.v),
            )
        })
        .collect();
    let mut a = states[0].1.clone();
    let inputs = vec![Lanes::splat(0.0); program.inputs.len()];
    1e9 / N as f64
        * per_call(|calls| {
            for (t, q, v) in states.iter().cycle().take(calls) {
                let arguments = SeveralArguments {
                    t: *t,
                    q,
                    v,
                    u: &inputs,
                    a: &[],
                };
                assert!(
                    several
                        .call(Role::Accelerations, arguments, &mut a)
                        .is_some()
                );
                black_box(&a);
            }
        })
}
