//! The programs of whole machines.

use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::{Disagreement, Proved, prove, prove_quantities, quantities};
use lagrangian_mechanics::{Oracle, dependents, equations::constraints};
use lagrangian_program::{Arguments, Interpreter, Mutant, Program, Role, mutants};
use lagrangian_spec::model::Model;
use lagrangian_symbolic::{Expr, evaluate};

use crate::harness::{all_machines, compiled, machine};

pub fn assert_proved(machine: &Compiled<'_>) {
    let Compiled {
        model,
        equations,
        program,
        ..
    } = machine;
    assert_eq!(program.verify(), Ok(()), "{}", program.name);
    assert_eq!(
        prove_quantities(program, model, &quantities(model, equations)),
        Ok(()),
        "{}",
        program.name
    );
    assert_eq!(
        prove(program, model, &Oracle::derive(model)),
        Ok(()),
        "{}",
        program.name
    );
}

#[test]
fn every_machine_obeys_lagranges_equations() {
    for name in all_machines() {
        machine(&name, &[], assert_proved);
    }
}

#[test]
fn chains_of_every_length_obey_lagranges_equations() {
    for n in 1..=6 {
        machine("chain", &[("N", n)], assert_proved);
        machine("chain_relative", &[("N", n)], assert_proved);
    }
}

/// Two carts on a rail, one driven by time, with a pendulum between them and a dissipation that is not a quadratic form.
const DRIVEN: &str = "machine Driven in plane {
    parameters { m: kg = 2, l: m = 0.4, J: kg*m^2 = 0.1, k: N/m = 30, b: N*s^3/m^3 = 2, A: m = 0.1, w: rad/s = 7, g: m/s^2 = 9.8 }
    coordinates { x: m, phi: rad = 0.3, psi: rad = 0.1 }
    frames { driven = ground.shift(A*sin(w*t), 0), arm = driven.turn(phi), tip = arm.shift(l, 0).turn(psi) }
    bodies {
        cart { mass: m, at: (x, 0) },
        arm { mass: m, inertia: J, frame: arm, at: arm.point(l/2, 0) },
        tip { mass: m, inertia: J, frame: tip, at: tip.point(l/3, x/5) },
    }
    gravity (0, -g);
    springs { between { stiffness: k, from: (x, 0), to: tip.origin, length: l } }
    dissipations { drag: b*der(x)^4/4 }
}";

#[test]
fn a_machine_driven_by_time_with_coupled_bodies_obeys_lagranges_equations() {
    compiled(DRIVEN, &[], assert_proved);
}

/// A body in space rotated by time about one axis, with an inertia that couples all axes.
const SPUN: &str = "machine Spun in space {
    parameters { m: kg = 2, w: rad/s = 7, c: N*m = 3, g: m/s^2 = 9.8 }
    coordinates { alpha: rad = 0.3, beta: rad = 0.2 }
    inputs { tau: N*m = 0 }
    frames { drum = ground.turn(z, w*t), yoke = drum.shift(0.2, 0, 0.1).turn(x, alpha), disc = yoke.turn(y, beta) }
    bodies { disc { mass: m, inertia: (0.3, 0.4, 0.5, 0.01, 0.02, 0.03), frame: disc, at: disc.point(0.1, 0.2, 0.3) } }
    gravity (0, 0, -g);
    potentials { twist: c*cos(alpha - beta) }
    torques { motor { on: disc, torque: (0, 0, tau) } }
}";

#[test]
fn a_spun_body_in_space_obeys_lagranges_equations() {
    compiled(SPUN, &[], assert_proved);
}

/// Asserts that the proofs find the mistakes in a program, and that few mistakes have no effect.
pub fn assert_mistakes_are_found(machine: &Compiled<'_>, stride: usize) {
    let (tried, idle) = mistakes_found(machine, stride);
    assert!(
        tried >= 100 && 50 * idle <= tried,
        "{}: {idle} of {tried}",
        machine.program.name
    );
}

/// Asserts that the proofs find every mistake in a program that has an effect; mistakes in terms that cancel may have none.
/// Returns the number of mistakes, and of those without effect.
pub fn mistakes_found(machine: &Compiled<'_>, stride: usize) -> (usize, usize) {
    let Compiled {
        model,
        equations,
        program,
        ..
    } = machine;
    let (oracle, quantities) = (Oracle::derive(model), quantities(model, equations));
    let mut tried = 0;
    let mut idle = 0;
    for Mutant {
        change,
        program: mutant,
    } in mutants(program, stride)
    {
        tried += 1;
        let proof = prove_quantities(&mutant, model, &quantities)
            .and_then(|()| prove(&mutant, model, &oracle));
        // The gate also rejects everything that the expanded equations reject.
        let gate = Proved::new(mutant.clone(), model, equations);
        assert!(
            gate.is_err() || proof.is_ok() || same_values(model, program, &mutant),
            "{}: let through: {change}: {proof:?}",
            program.name
        );
        // The random points of the expanded equations may all be on one side of 0; the gate checks both sides.
        if proof.is_ok() && gate.is_ok() {
            idle += 1;
            assert!(
                same_values(model, program, &mutant),
                "{}: not found: {change}",
                program.name
            );
        }
    }
    println!(
        "{}: {tried} mistakes, {idle} of them without effect",
        program.name
    );
    (tried, idle)
}

/// Whether two programs give the same numbers up to rounding at a state where the coordinates that constraints settle have
/// their values, as accelerations need not read them.
pub fn same_values(model: &Model<'_>, a: &Program, b: &Program) -> bool {
    let settled = dependents(model, &constraints(model));
    let values = |program: &Program| {
        let number = |seed: usize| 0.3 + ((seed * 7919) % 101) as f64 / 97.0;
        let parameters: Vec<f64> = (0..program.parameters.len())
            .map(|i| number(i + 1))
            .collect();
        let list = |seed: usize, len: usize| {
            (0..len)
                .map(|i| number(seed + 13 * i))
                .collect::<Vec<f64>>()
        };
        let n = program.dimension();
        let (mut q, mut v, u, acc) = (
            list(3, n),
            list(5, n),
            list(7, program.inputs.len()),
            list(11, n),
        );
        for dependent in &settled {
            let parts = [dependent.position, dependent.rate];
            let put = evaluate(model.dag, &parts, |symbol| {
                let is = |e: Expr<'_>| e.as_symbol() == Some(symbol);
                let parameter = model.parameters.iter().position(|p| is(p.symbol));
                let coordinate = model.coordinates.iter().position(|c| is(c.q));
                let rate = model.coordinates.iter().position(|c| is(c.v));
                match (parameter, coordinate, rate) {
                    (Some(i), ..) => parameters[i],
                    (_, Some(i), _) => q[i],
                    (.., Some(i)) => v[i],
                    _ if is(model.time) => 0.7,
                    // Values that the start decides may be arbitrary.
                    _ => 0.3,
                }
            });
            (q[dependent.coordinate], v[dependent.coordinate]) = (put[0], put[1]);
        }
        let mut interpreter = Interpreter::new(program, &parameters);
        let mut all = Vec::new();
        for function in &program.functions {
            let mut results = vec![0.0; function.results.len()];
            let arguments = Arguments {
                t: 0.7,
                q: &q,
                v: &v,
                u: &u,
                a: &acc,
            };
            let _ = interpreter.call(function.role, arguments, &mut results);
            all.extend(results);
        }
        all
    };
    let close = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-9 * a.abs().max(1.0);
    values(a).iter().zip(&values(b)).all(close)
}

#[test]
fn no_mistake_in_a_small_machine_survives() {
    for name in ["double_pendulum", "cart_pole", "heavy_top"] {
        machine(name, &[], |machine| assert_mistakes_are_found(machine, 1));
    }
}

#[test]
fn no_mistake_in_a_large_machine_survives() {
    machine("crusher9", &[], |machine| {
        assert_mistakes_are_found(machine, 5)
    });
    machine("cushioned_crusher", &[], |machine| {
        assert_mistakes_are_found(machine, 11)
    });
    machine("chain", &[("N", 5)], |machine| {
        assert_mistakes_are_found(machine, 11)
    });
}

#[test]
fn a_wrong_program_is_told_where_it_is_wrong() {
    machine("double_pendulum", &[], |machine| {
        let Compiled { model, program, .. } = machine;
        let oracle = Oracle::derive(model);
        let of = |role: Role| {
            let wrong = |mutant: &Mutant| mutant.change.starts_with(&role.name());
            let mutant = mutants(program, 1)
                .find(wrong)
                .expect("there is something to get wrong");
            prove(&mutant.program, model, &oracle)
        };
        assert!(matches!(
            of(Role::Forces),
            Err(Disagreement::Result {
                role: Role::Forces,
                ..
            })
        ));
        assert!(matches!(
            of(Role::Accelerations),
            Err(Disagreement::Motion { .. } | Disagreement::Pivots { .. })
        ));
    });
}

#[test]
fn the_same_text_gives_the_same_program() {
    for name in ["crusher9", "six_joint_arm", "chain"] {
        let listing = || machine(name, &[], |machine| machine.program.to_string());
        assert_eq!(listing(), listing());
    }
}

/// The number of operations of the accelerations.
fn ops(name: &str, n: i64) -> usize {
    let constants = [("N", n)];
    let constants = if n > 0 { &constants[..] } else { &[] };
    machine(name, constants, |machine| {
        machine
            .program
            .function(Role::Accelerations)
            .expect("accelerations")
            .counts()
            .ops()
    })
}

#[test]
fn long_chains_grow_no_faster_than_their_length() {
    for name in ["chain", "chain_relative"] {
        let (short, long) = (ops(name, 24), ops(name, 48));
        assert!(
            10 * long < 21 * short,
            "{name}: {short} operations for 24 links, {long} for 48"
        );
    }
}

#[test]
fn free_bodies_fall_apart() {
    // Accelerations from the mass matrix take twice as many, with five divisions.
    machine("crusher9", &[], |machine| {
        let counts = machine
            .program
            .function(Role::Accelerations)
            .expect("accelerations")
            .counts();
        assert!(counts.ops() < 150 && counts.divisions <= 2, "{counts}");
        assert_eq!(counts.sincos, 4);
    });
}

#[test]
fn guards_hold_a_pivot_for_every_coordinate() {
    machine("crusher9", &[], |machine| {
        let program = &machine.program;
        let solve = program
            .function(Role::Accelerations)
            .expect("accelerations");
        let mut guarded: Vec<usize> = program
            .prepare
            .guards
            .iter()
            .chain(&solve.guards)
            .map(|guard| guard.coordinate)
            .collect();
        guarded.sort_unstable();
        assert_eq!(guarded, (0..9).collect::<Vec<_>>());
    });
}
