//! Machines of many links give the same bits and the same errors as the interpreted program.

use crate::support::library;
use crate::support::sampling::Random;
use crate::support::states::vector;
use lagrangian::scalar::{DoubleDouble, Kernel, Scalar};
use lagrangian::{Batch, Batched, Lanes, Machine, Number, Pivot, Singular, System, Vector};
use lagrangian_program::{Arguments, Interpreter, Program, Role};

/// A chain in which every link has parameters of its own.
mod chain {
    lagrangian::machine!(file = "../benches/peers/chain.machine", N = 16);
}

/// A chain in relative coordinates, in which each absolute angle is a sum.
mod relative {
    lagrangian::machine!(file = "../machines/chain_relative.machine", N = 24);
}

/// The number of states that are compared.
const STATES: usize = 30;

/// The accelerations by the interpreter, in the arithmetic that this processor selects for `f64`.
struct Interpreted<'a> {
    interpreter: &'a mut Interpreter<f64>,
    arguments: Arguments<'a, f64>,
}

impl Kernel<f64> for Interpreted<'_> {
    type Output = Result<Vec<f64>, lagrangian_program::Singular>;

    fn run<N: Scalar<Stored = f64>>(self) -> Self::Output {
        let mut results = vec![0.0; self.arguments.q.len()];
        self.interpreter
            .call_in::<N>(Role::Accelerations, self.arguments, &mut results)?;
        Ok(results)
    }
}

fn interpreted(
    program: &Program,
    parameters: &[f64],
    q: &[f64],
    v: &[f64],
) -> Result<Vec<f64>, lagrangian_program::Singular> {
    let arguments = Arguments {
        t: 0.0,
        q,
        v,
        u: &[],
        a: &[],
    };
    f64::run(Interpreted {
        interpreter: &mut Interpreter::new(program, parameters),
        arguments,
    })
}

fn compiled<M: Machine>(system: &M::System, q: &[f64], v: &[f64]) -> Result<Vec<f64>, Singular> {
    let (q, v) = (vector::<M::System>(q), vector::<M::System>(v));
    let mut a = q.zeros_like();
    let u = system.default_inputs();
    system.accelerations(0.0, &q, &v, &u, &mut a)?;
    Ok(a.as_slice().to_vec())
}

fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

/// Compares systems alone and in lanes, with other parameters in every lane.
fn agrees<M: Machine>(machine: impl Fn(f64) -> M, program: &Program)
where
    M::System: Batched<4>,
{
    let mut random = Random::new(&machine(1.0), 20_261_121);
    let machines: [M; 4] = std::array::from_fn(|lane| machine(1.0 + lane as f64 / 64.0));
    let systems = machines.each_ref().map(Machine::prepare);
    let several = Batch::new(systems.each_ref());
    let u = several.default_inputs(&systems[0]);
    for _ in 0..STATES {
        let states: [_; 4] = std::array::from_fn(|_| random.sample());
        let q = states.each_ref().map(|at| vector::<M::System>(&at.q));
        let v = states.each_ref().map(|at| vector::<M::System>(&at.v));
        let t = Lanes::splat(0.0);
        let (q, v) = (several.vectors(q.each_ref()), several.vectors(v.each_ref()));
        let mut batch = q;
        let computed = several.accelerations(t, &q, &v, &u, &mut batch);
        computed.expect("every link has inertia");
        for (lane, state) in states.iter().enumerate() {
            let parameters: Vec<f64> = machines[lane].parameters().map(|(_, x)| x).collect();
            let expected = interpreted(program, &parameters, &state.q, &state.v)
                .expect("every link has inertia");
            let alone =
                compiled::<M>(&systems[lane], &state.q, &state.v).expect("every link has inertia");
            assert_eq!(bits(&alone), bits(&expected), "{state:?}");
            let lane: Vec<f64> = batch.as_ref().iter().map(|number| number[lane]).collect();
            assert_eq!(bits(&lane), bits(&expected), "in lanes: {state:?}");
        }
    }
}

#[test]
fn a_chain_is_the_program_to_the_last_bit() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../benches/peers/chain.machine"
    );
    let text = std::fs::read_to_string(path).expect("it is there");
    let program = library::compile(path, &text, &[("N", 16)]);
    // No two links are alike.
    let machine = |factor: f64| {
        let mut machine = chain::Chain::default();
        for i in 0..16 {
            let share = factor * (1.0 + i as f64 / 32.0);
            machine.l[i] *= share;
            machine.m[i] /= share;
            // The spec assumes that no mass centre lies beyond the end of its bar.
            machine.c[i] /= share;
            machine.I[i] *= 2.0 - share;
        }
        machine
    };
    agrees(machine, &program);
}

#[test]
fn a_chain_of_relative_angles_as_loops_is_the_program_to_the_last_bit() {
    let program = library::program("chain_relative", &[("N", 24)]);
    let machine = |factor: f64| relative::ChainRelative::default().map(|x| x * factor);
    agrees(machine, &program);
}

/// Double-doubles are an arithmetic in which no instruction contracts operations.
#[test]
fn loops_over_double_doubles_are_the_program_too() {
    let program = library::program("chain_relative", &[("N", 24)]);
    let machine = relative::ChainRelative::default();
    let mut random = Random::new(&machine, 20_261_122);
    let parameters: Vec<DoubleDouble> = machine
        .parameters()
        .map(|(_, x)| DoubleDouble::from_f64(x))
        .collect();
    let mut interpreter = Interpreter::new(&program, &parameters);
    let prepared = machine.map(DoubleDouble::from_f64).prepare();
    for _ in 0..STATES {
        let state = random.sample();
        let exact = |i: usize, of: &[f64]| DoubleDouble::from_f64(of[i]);
        let q: [DoubleDouble; 24] = std::array::from_fn(|i| exact(i, &state.q));
        let v: [DoubleDouble; 24] = std::array::from_fn(|i| exact(i, &state.v));
        let mut expected = [DoubleDouble::ZERO; 24];
        let arguments = Arguments {
            t: DoubleDouble::ZERO,
            q: &q,
            v: &v,
            u: &[],
            a: &[],
        };
        interpreter
            .call(Role::Accelerations, arguments, &mut expected)
            .expect("every link has inertia");
        let found = relative::chain_relative::accelerations(&prepared, &q, &v);
        assert_eq!(
            format!("{:?}", found.expect("every link has inertia")),
            format!("{expected:?}")
        );
    }
}

/// A link without length, radius and inertia has no determined angular acceleration. The error
/// names its pivot as the interpreter does, and the other lanes go on.
#[test]
fn a_pivot_that_vanishes_is_the_error_of_its_coordinate() {
    let whole = chain::Chain::default();
    let mut broken = whole;
    (broken.l[7], broken.c[7], broken.I[7]) = (0.0, 0.0, 0.0);
    let mut random = Random::new(&whole, 20_261_123);
    let state = random.sample();
    let error = compiled::<chain::Chain>(&broken.prepare(), &state.q, &state.v);
    assert_eq!(
        error.expect_err("nothing holds link 8").at,
        Pivot::Coordinate(7)
    );

    let systems = [whole, broken, whole, whole].map(|machine| machine.prepare());
    let several = Batch::new(systems.each_ref());
    let (q, v) = (state.q.as_slice(), state.v.as_slice());
    let lanes = |of: &[f64]| std::array::from_fn(|i| Lanes::splat(of[i]));
    let u = several.default_inputs(&systems[0]);
    let mut a = lanes(q);
    let computed = several.accelerations(Lanes::splat(0.0), &lanes(q), &lanes(v), &u, &mut a);
    let singular = computed
        .expect_err("nothing holds link 8 in one lane")
        .lanes;
    let pivots = singular.map(|error| error.map(|error| error.at));
    assert_eq!(pivots, [None, Some(Pivot::Coordinate(7)), None, None]);
    let alone = compiled::<chain::Chain>(&systems[0], q, v).expect("it has inertia");
    for (row, alone) in a.iter().zip(&alone) {
        assert_eq!(row[0].to_bits(), alone.to_bits());
    }
    assert!(a[7][1].is_nan());
}
