//! Random machines compared with a reference that shares nothing with the compiler: differences of energies in 120 digits.

mod machine;
mod number;
mod random;
mod truth;

use lagrangian_mechanics::Equations;
use lagrangian_program::{Arguments, Function, Interpreter, Op, Program, Role, Shape};
use lagrangian_scalar::{Residue, Scalar};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::Model;
use lagrangian_spec::source::{InMemory, Sources};
use lagrangian_spec::syntax::Spec;
use lagrangian_spec::token::lex;
use lagrangian_symbolic::Dag;

use machine::Machine;
use number::Number;
use random::Random;
use truth::Truth;

fn compile(machine: &Machine) -> Program {
    let text = machine.spec();
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let source = sources.add("random.machine", text.clone());
    let tokens = lex(source, &text, &mut report);
    let spec = Spec::parse(&tokens, source, &mut report);
    let model = Model::resolve(
        spec,
        &dag,
        &[],
        &mut InMemory::default(),
        &mut sources,
        &mut report,
    );
    let equations = model
        .as_ref()
        .and_then(|model| Equations::derive(model, &mut report));
    match (model, equations) {
        (Some(model), Some(equations)) => lagrangian_mechanics::lower(&model, &equations),
        _ => panic!("{text}\n{}", report.render_short(&sources)),
    }
}

/// The results of a program at a state.
struct Numbers {
    mass_matrix: Vec<f64>,
    bias: Vec<f64>,
    applied: Vec<f64>,
    accelerations: Vec<f64>,
    energies: [f64; 3],
}

fn interpret(program: &Program, q: &[f64], v: &[f64], t: f64) -> Numbers {
    let parameters: Vec<f64> = program
        .parameters
        .iter()
        .map(|slot| slot.default.as_ref().expect("a default").value)
        .collect();
    let mut interpreter = Interpreter::new(program, &parameters);
    let n = q.len();
    let mut call = |role, length| {
        let mut results = vec![0.0; length];
        let arguments = Arguments {
            t,
            q,
            v,
            u: &[],
            a: &[],
        };
        // If the matrix is singular, the numbers show it.
        let _ = interpreter.call(role, arguments, &mut results);
        results
    };
    Numbers {
        mass_matrix: call(Role::MassMatrix, Shape::Symmetric(n).len()),
        bias: call(Role::Bias, n),
        applied: call(Role::Applied, n),
        accelerations: call(Role::Accelerations, n),
        energies: [
            Role::KineticEnergy,
            Role::PotentialEnergy,
            Role::Dissipation,
        ]
        .map(|role| call(role, 1)[0]),
    }
}

fn largest<'a>(numbers: impl IntoIterator<Item = &'a Number>) -> f64 {
    numbers
        .into_iter()
        .map(|number| number.abs().to_f64())
        .fold(0.0, f64::max)
}

/// max |x − truth|.
fn distance(x: &[f64], truth: &[Number]) -> f64 {
    let differences: Vec<Number> = x
        .iter()
        .zip(truth)
        .map(|(x, truth)| Number::of(*x) - truth)
        .collect();
    largest(&differences)
}

/// ‖M‖ ‖M⁻¹‖ in the maximum norm, from the truth in binary64.
fn condition(matrix: &[Vec<Number>]) -> f64 {
    let n = matrix.len();
    let rows: Vec<Vec<f64>> = matrix
        .iter()
        .map(|row| row.iter().map(Number::to_f64).collect())
        .collect();
    let norm = |rows: &[Vec<f64>]| {
        rows.iter()
            .map(|row| row.iter().map(|x| x.abs()).sum::<f64>())
            .fold(0.0, f64::max)
    };
    // Gauss–Jordan with row pivoting.
    let mut work: Vec<Vec<f64>> = rows
        .iter()
        .enumerate()
        .map(|(i, row)| {
            row.iter()
                .copied()
                .chain((0..n).map(|j| f64::from(u8::from(i == j))))
                .collect()
        })
        .collect();
    for k in 0..n {
        let pivot = (k..n)
            .max_by(|&a, &b| work[a][k].abs().total_cmp(&work[b][k].abs()))
            .unwrap_or(k);
        work.swap(k, pivot);
        let scale = work[k][k];
        work[k].iter_mut().for_each(|x| *x /= scale);
        let row = work[k].clone();
        for (i, other) in work.iter_mut().enumerate() {
            let factor = other[k];
            if i != k {
                other
                    .iter_mut()
                    .zip(&row)
                    .for_each(|(x, y)| *x -= factor * y);
            }
        }
    }
    let inverse: Vec<Vec<f64>> = work.iter().map(|row| row[n..].to_vec()).collect();
    norm(&rows) * norm(&inverse)
}

/// The relative error that is permitted: 10⁻¹² of the largest number, as the project promises.
///
/// The programs have a few hundred operations, each with an error of 2⁻⁵³ ≈ 10⁻¹⁶ of values that cancellation reduces by up
/// to a few hundred; 10⁻¹² is certain to hold. `scale` is the largest term of the intermediate sums. The velocities and
/// forces here are of order 1 to 100, so it is taken to be at least 1.
const LIMIT: f64 = 1e-12;

fn check(seed: u64, spatial: bool, coordinates: usize) -> Option<f64> {
    let mut random = Random(seed);
    let machine = Machine::random(&mut random, spatial, coordinates);
    compare(seed, random, &machine)
}

/// Compares the program of a machine with the reference at two random states, and returns the largest error.
fn compare(seed: u64, mut random: Random, machine: &Machine) -> Option<f64> {
    let (coordinates, program) = (machine.coordinates, compile(machine));
    let mut worst: f64 = 0.0;
    for _ in 0..2 {
        let mut draw = |size: f64| {
            (0..coordinates)
                .map(|_| random.number(-size, size))
                .collect::<Vec<_>>()
        };
        let (q, v) = (draw(2.0), draw(2.0));
        let t = random.number(-2.0, 2.0);
        let truth = Truth::at(machine, &q, &v, t);
        let condition = condition(&truth.mass_matrix);
        // A machine whose matrix is singular here has no accelerations to compare.
        if condition.is_nan() || condition > 1e8 {
            return None;
        }
        let found = interpret(&program, &q, &v, t);
        let lower: Vec<Number> = (0..coordinates)
            .flat_map(|i| truth.mass_matrix[i][..=i].to_vec())
            .collect();
        let energies = [
            truth.kinetic_energy,
            truth.potential_energy,
            truth.dissipation,
        ];
        let comparisons = [
            (
                "mass matrix",
                distance(&found.mass_matrix, &lower) / largest(&lower),
            ),
            (
                "bias",
                distance(&found.bias, &truth.bias) / largest(&truth.bias).max(1.0),
            ),
            (
                "applied",
                distance(&found.applied, &truth.applied) / largest(&truth.applied).max(1.0),
            ),
            (
                "energies",
                distance(&found.energies, &energies) / largest(&energies).max(1.0),
            ),
            (
                "accelerations",
                distance(&found.accelerations, &truth.accelerations)
                    / (condition * largest(&truth.accelerations).max(1.0)),
            ),
        ];
        for (what, error) in comparisons {
            assert!(
                error <= LIMIT,
                "seed {seed}, {what} is off by {error:e}\nq = {q:?}\nv = {v:?}\nt = {t}\n{}",
                machine.spec()
            );
            worst = worst.max(error);
        }
    }
    Some(worst)
}

fn check_many(seeds: std::ops::Range<u64>, spatial: bool) {
    let results: Vec<Option<f64>> = seeds
        .clone()
        .map(|seed| check(seed, spatial, 1 + seed as usize % 4))
        .collect();
    let compared = results.iter().flatten().count();
    let worst = results.iter().flatten().copied().fold(0.0, f64::max);
    println!(
        "{compared} of {} machines compared, worst error {worst:e}",
        results.len()
    );
    // Singular machines are rare; this asserts that most machines were compared.
    assert!(compared * 10 >= results.len() * 8);
}

#[test]
fn random_planar_machines_obey_differences_of_their_energies() {
    check_many(0..24, false);
}

#[test]
fn random_spatial_machines_obey_differences_of_their_energies() {
    check_many(1000..1016, true);
}

/// One coordinate is the abscissa of one body and the ordinate of another, so both have the same speed, but gravity acts
/// along it on only one of them.
#[test]
fn bodies_that_share_velocities_along_different_axes_have_their_own_weights() {
    let worst = (2000..2060).map(|seed| {
        let mut random = Random(seed);
        let machine = Machine::sharing(&mut random, 1 + seed as usize % 3);
        let worst = compare(seed, random, &machine);
        worst.unwrap_or_else(|| panic!("seed {seed} has a singular mass matrix"))
    });
    println!("worst error {:e}", worst.fold(0.0, f64::max));
}

/// Marks the operations that the results of a function need; the others serve its guards.
fn needed_by_results(function: &Function) -> Vec<bool> {
    let mut needed = vec![false; function.code.len()];
    function
        .results
        .iter()
        .for_each(|result| needed[result.index()] = true);
    for index in (0..needed.len()).rev() {
        if needed[index] {
            function.code[index]
                .operands()
                .for_each(|operand| needed[operand.index()] = true);
        }
    }
    needed
}

/// Whether two programs of one machine have the same accelerations at all states, checked at a random point of a prime
/// field. In some machines terms cancel, and their signs do not matter.
fn same_everywhere(program: &Program, other: &Program) -> bool {
    let accelerations = |program: &Program| {
        let mut index = 0;
        let mut random = |length: usize| -> Vec<Residue> {
            let values = (0..length as u64)
                .map(|k| Residue::random(1, index + k))
                .collect();
            index += length as u64;
            values
        };
        let n = program.dimension();
        let mut interpreter = Interpreter::new(program, &random(program.parameters.len()));
        let (q, v, t) = (random(n), random(n), random(1)[0]);
        let mut results = vec![Residue::ZERO; n];
        let arguments = Arguments {
            t,
            q: &q,
            v: &v,
            u: &[],
            a: &[],
        };
        interpreter
            .call(Role::Accelerations, arguments, &mut results)
            .map(|()| results)
    };
    accelerations(program) == accelerations(other)
}

/// Flips single signs in the program of the accelerations; the comparison above must notice each at one of two states.
#[test]
fn a_wrong_sign_in_a_program_is_noticed() {
    let states = [
        (vec![0.5, -0.75, 1.25], vec![1.5, -0.5, 0.875], 0.625),
        (vec![-1.125, 0.375, 0.25], vec![-0.25, 1.75, 1.0], -0.375),
    ];
    let mut survivors = Vec::new();
    let mut flipped = 0;
    for seed in [3, 7, 11, 1003] {
        let machine = Machine::random(&mut Random(seed), seed >= 1000, 3);
        let program = compile(&machine);
        let truths: Vec<Truth> = states
            .iter()
            .map(|(q, v, t)| Truth::at(&machine, q, v, *t))
            .collect();
        let place = program
            .functions
            .iter()
            .position(|function| function.role == Role::Accelerations);
        let place = place.expect("every machine has accelerations");
        let needed = needed_by_results(&program.functions[place]);
        for index in (0..needed.len()).filter(|&index| needed[index]) {
            let op = program.functions[place].code[index].clone();
            let mutated = match op {
                Op::Add(a, b) => Op::Sub(a, b),
                Op::Sub(a, b) => Op::Add(a, b),
                Op::Neg(a) => Op::Add(a, a),
                _ => continue,
            };
            let mut wrong = program.clone();
            wrong.functions[place].code[index] = mutated;
            flipped += 1;
            let noticed = states.iter().zip(&truths).any(|((q, v, t), truth)| {
                let found = interpret(&wrong, q, v, *t);
                let error = distance(&found.accelerations, &truth.accelerations);
                let limit = LIMIT * condition(&truth.mass_matrix) * largest(&truth.accelerations);
                error.is_nan() || error > limit
            });
            if !noticed && !same_everywhere(&program, &wrong) {
                survivors.push((seed, index, op));
            }
        }
    }
    assert!(flipped > 100);
    assert!(
        survivors.is_empty(),
        "of {flipped} flipped signs, these are not noticed: {survivors:?}"
    );
}
