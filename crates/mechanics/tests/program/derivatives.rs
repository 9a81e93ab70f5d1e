//! Derivatives of the accelerations are exactly those of the accelerations' program, for a few operations more.

use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::Oracle;
use lagrangian_mechanics::{Disagreement, prove};
use lagrangian_program::{Arguments, Function, Interpreter, Mutant, Op, Role, mutants};
use lagrangian_scalar::{DoubleDouble, Scalar};
use lagrangian_spec::model::Variable;

use crate::harness::{
    compiled, differentiated, differentiated_machine, machine, program, smooth_machines,
};

fn assert_proved(machine: &Compiled<'_>) {
    let Compiled { model, program, .. } = machine;
    let variables = 2 * model.coordinates.len() + model.inputs.len() + model.parameters.len();
    assert_eq!(program.derivatives.len(), variables, "{}", program.name);
    assert_eq!(program.verify(), Ok(()), "{}", program.name);
    let proof = prove(program, model, &Oracle::derive(model));
    assert_eq!(proof, Ok(()), "{}", program.name);
}

#[test]
fn the_derivatives_of_every_machine_are_those_of_its_accelerations() {
    for name in smooth_machines() {
        differentiated_machine(&name, &[], assert_proved);
    }
}

#[test]
fn the_derivatives_of_chains_are_those_of_their_accelerations() {
    for n in 1..=6 {
        differentiated_machine("chain", &[("N", n)], assert_proved);
        differentiated_machine("chain_relative", &[("N", n)], assert_proved);
    }
}

fn derivatives<'p>(machine: &'p Compiled<'_>) -> &'p Function {
    let function = machine.program.function(Role::Derivatives);
    function.expect("derivatives are asked for")
}

/// A machine that is nonlinear in coordinates, rates, inputs, parameters and time.
const NONLINEAR: &str = "machine Nonlinear in plane {
    parameters { m: kg = 2, l: m = 0.4, J: kg*m^2 = 0.1, k: N/m = 30, b: N*s^3/m^3 = 2, A: m = 0.1, w: rad/s = 7, g: m/s^2 = 9.8 }
    coordinates { x: m, phi: rad = 0.3 }
    inputs { u: N = 1 }
    frames { driven = ground.shift(A*sin(w*t), 0), arm = driven.turn(phi) }
    bodies {
        cart { mass: m, at: (x, 0) },
        arm { mass: m, inertia: J, frame: arm, at: arm.point(l/2, x/7) },
    }
    gravity (0, -g);
    springs { between { stiffness: k, from: (x, 0.3*l), to: arm.point(l, 0), length: l } }
    dissipations { drag: b*der(x)^4/4 }
    forces { push { on: x, value: u*cos(phi) + u^2*sin(phi)/(m*g) } }
}";

#[test]
fn whatever_a_machine_depends_on_is_differentiated() {
    differentiated(NONLINEAR, &[], |machine| {
        assert_proved(machine);
        let zero =
            |value: &_| matches!(derivatives(machine).op(*value), Op::Constant(c) if c.is_zero());
        // Two rows with columns for x, phi, their rates, u and eight parameters. None is zero: m does not cancel
        // in any, and w appears in both.
        let zeros = derivatives(machine)
            .results
            .iter()
            .filter(|v| zero(v))
            .count();
        assert_eq!(zeros, 0);
    });
}

#[test]
fn no_mistake_in_derivatives_survives() {
    for (name, n, stride) in [("cart_pole", 1, 1), ("heavy_top", 1, 3), ("chain", 3, 5)] {
        let constants: &[(&str, i64)] = if name == "chain" { &[("N", n)] } else { &[] };
        differentiated_machine(name, constants, |machine| {
            let Compiled { model, program, .. } = machine;
            let oracle = Oracle::derive(model);
            let role = Role::Derivatives.name();
            let (mut tried, mut idle) = (0, 0);
            let of_derivatives = |mutant: &Mutant| mutant.change.starts_with(&role);
            for mutant in mutants(program, stride).filter(of_derivatives) {
                tried += 1;
                match prove(&mutant.program, model, &oracle) {
                    Err(Disagreement::Result { role, .. }) => assert_eq!(role, Role::Derivatives),
                    Err(_) => {}
                    Ok(()) => idle += 1,
                }
            }
            println!("{name}: {tried} mistakes, {idle} of them without effect");
            // Mistakes in terms that cancel may have no effect.
            assert!(
                tried >= 50 && 50 * idle <= tried,
                "{name}: {idle} of {tried}"
            );
        });
    }
}

/// Central differences of the accelerations in double-double. With steps `h` near the cube root of the round-off 2⁻¹⁰⁴ the
/// errors are `h²` of the third derivatives, here 1e-20, far below the round-off of `f64`.
#[test]
fn derivatives_are_slopes_of_the_accelerations() {
    const H: f64 = 1e-10;
    for name in smooth_machines() {
        differentiated_machine(&name, &[], |machine| {
            let program = &machine.program;
            let n = program.dimension();
            let number = |seed: usize| 0.3 + ((seed * 7919) % 101) as f64 / 97.0;
            let list = |seed: usize, len: usize| -> Vec<f64> {
                (0..len).map(|i| number(seed + 13 * i)).collect()
            };
            let lists = [
                list(3, n),
                list(5, n),
                list(7, program.inputs.len()),
                list(1, program.parameters.len()),
            ];
            let [q, v, u, p] = &lists;
            let width = 1 + program.derivatives.len();
            let mut found = vec![0.0; n * width];
            let at = Arguments {
                t: 0.7,
                q,
                v,
                u,
                a: &[],
            };
            let mut fast = Interpreter::new(program, p);
            if fast.call(Role::Derivatives, at, &mut found).is_err() {
                return; // random parameters may not give a valid machine
            }
            let exact = |h: f64, list: usize, index: usize| -> Vec<DoubleDouble> {
                let mut lists = lists.clone().map(|list| -> Vec<DoubleDouble> {
                    list.into_iter().map(DoubleDouble::from).collect()
                });
                lists[list][index] = lists[list][index] + DoubleDouble::from(h);
                let [q, v, u, p] = &lists;
                let mut a = vec![DoubleDouble::ZERO; n];
                let at = Arguments {
                    t: DoubleDouble::from(0.7),
                    q,
                    v,
                    u,
                    a: &[],
                };
                let called = Interpreter::new(program, p).call(Role::Accelerations, at, &mut a);
                assert_eq!(called, Ok(()), "{name}");
                a
            };
            for (column, variable) in (1..).zip(&program.derivatives) {
                let (list, index) = match *variable {
                    Variable::Coordinate(i) => (0, i),
                    Variable::Rate(i) => (1, i),
                    Variable::Input(i) => (2, i),
                    Variable::Parameter(i) => (3, i),
                };
                let (above, below) = (exact(H, list, index), exact(-H, list, index));
                let slopes: Vec<f64> = above
                    .into_iter()
                    .zip(below)
                    .map(|(above, below)| ((above - below) / DoubleDouble::from(2.0 * H)).to_f64())
                    .collect();
                let scale = slopes
                    .iter()
                    .fold(1.0_f64, |scale, slope| scale.max(slope.abs()));
                for (i, slope) in slopes.into_iter().enumerate() {
                    let error = (found[i * width + column] - slope).abs();
                    // A few thousand rounding units of terms up to a thousand times the result.
                    assert!(
                        error <= 1e-9 * scale,
                        "{name}: {} is {}, not {slope}",
                        program.result_name(Role::Derivatives, i * width + column),
                        found[i * width + column],
                    );
                }
            }
        });
    }
}

/// Derivatives that are not requested leave no trace, and requested ones share what the accelerations compute.
#[test]
fn only_what_is_asked_for_is_there() {
    machine("double_pendulum", &[], |machine| {
        assert!(machine.program.function(Role::Derivatives).is_none());
        assert!(machine.equations.residual.is_empty());
    });
    let of = |asked: &str| {
        let text = format!(
            "machine Pendulum extends \"double_pendulum.machine\" {{ derivatives {{ {asked} }} }}"
        );
        program(&text)
    };
    let ops = |asked: &str| {
        let program = of(asked);
        let function = program
            .function(Role::Derivatives)
            .expect("it is asked for");
        function.counts().ops()
    };
    let names = |asked: &str| -> Vec<String> {
        let program = of(asked);
        let variables = program.derivatives.iter();
        variables
            .map(|variable| program.variable_name(*variable))
            .collect()
    };
    assert_eq!(
        names("g, l1, rates"),
        ["der(theta1)", "der(theta2)", "l1", "g"]
    );
    assert_eq!(names("parameters, g"), ["m1", "m2", "l1", "l2", "g"]);
    assert!(ops("g") < ops("g, l1"));
    assert!(ops("coordinates") < ops("coordinates, rates"));
    let alone = of("rates");
    let alone = alone
        .function(Role::Accelerations)
        .expect("always")
        .counts()
        .ops();
    // Both matrices cost more than the accelerations, and less than four times these and one of the matrices.
    assert!(ops("coordinates, rates") < 5 * alone + alone);
}

/// The figures of a prototype for a plain chain of six point masses: 1502 operations for the accelerations with the full
/// Jacobian, where differentiating the accelerations themselves takes 2321. The compiler stays within 2 % of the former.
#[test]
fn the_jacobian_of_a_chain_of_six_is_short() {
    let text = "machine Links in plane {
        constants { N = 6 }
        parameters { m[1..N]: kg = 1, l[1..N]: m = 1, g: m/s^2 = 9.81 }
        coordinates { q[1..N]: rad = 0.3 }
        frames { joint[0] = ground, joint[i in 1..N] = joint[i-1].shift(l[i]*sin(q[i]), -l[i]*cos(q[i])) }
        bodies { bob[i in 1..N] { mass: m[i], at: joint[i].origin } }
        gravity (0, -g);
        derivatives { coordinates, rates }
    }";
    let ops = |n: i64| {
        compiled(text, &[("N", n)], |machine| {
            derivatives(machine).counts().ops()
        })
    };
    let [six, twelve, many] = [6, 12, 24].map(ops);
    println!("operations of a with its derivatives: N = 6: {six}, 12: {twelve}, 24: {many}");
    assert!(six <= 1502 + 30, "{six}");
    // With elimination along the machine a column costs in proportion to the number of links, so twice the links take four
    // times the operations. With the mass matrix a column costs the square of that, so they would take eight times.
    assert!(10 * many <= 42 * twelve, "{many} against {twelve}");
}
