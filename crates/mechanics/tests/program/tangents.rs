//! Forward and backward derivatives of programs: proved for every machine, and equal to those that elimination in the
//! equations of motion gives.

use lagrangian_mechanics::Compiled;
use lagrangian_program::{Arguments, Interpreter, Mutant, Program, Role, mutants};
use lagrangian_spec::diagnostic::Code;

use crate::harness::{compiled, differentiated_machine, machine, smooth_machines};

fn ops(program: &Program, role: Role) -> usize {
    program.function(role).map_or(0, |f| f.counts().ops())
}

#[test]
fn the_tangents_and_adjoints_of_every_machine_are_proved() {
    for name in smooth_machines() {
        machine(&name, &[], |machine| {
            let Compiled { model, program, .. } = machine;
            let tangent = program.tangent(model).expect("a proved tangent");
            let adjoint = program.adjoint(model).expect("a proved adjoint");
            for derived in [&tangent, &adjoint] {
                assert_eq!(derived.verify(), Ok(()), "{name}");
            }
            let [of, along, back] = [
                ops(program, Role::Accelerations),
                ops(&tangent, Role::Accelerations),
                ops(&adjoint, Role::Adjoint),
            ];
            println!("{name}: {of} operations, {along} along a direction, {back} backwards");
            // For a product, a direction takes two more products and a sum, for a sum one more sum; backwards it takes as
            // many. Derivatives of roots and quotients take a few operations each, and machines have few of these.
            assert!(
                along <= 5 * of + 50 && back <= 6 * of + 50,
                "{name}: {of}, {along}, {back}"
            );
        });
    }
}

/// Every function of the language, by parameters too, in accelerations and in an output that depends on accelerations.
const FUNCTIONS: &str = "machine Functions in plane {
    parameters { m: kg = 2, l: m = 0.4, k: N/m = 30, e: 1 = 2.5, g: m/s^2 = 9.8, w: rad/s = 3 }
    coordinates { x: m = 0.3, phi: rad = 0.4 }
    inputs { u: N = 1 }
    bodies { cart { mass: m, at: (x, 0) }, bob { mass: m, at: (x + l*sin(phi), -l*cos(phi)) } }
    gravity (0, -g);
    forces {
        push { on: x, value: u*tanh(x/l) + k*l*(atan(phi) + asin(sin(phi)/2) + acos(x/(4*l)) + sinh(x/l) + cosh(phi) + tan(phi/3)) },
        turn { on: phi, value: k*l^2*(exp(-phi) + ln(2 + sin(phi)) + sqrt(2 + phi^2) + abs(x/l - 2)^e + atan2(x, l)
            + min(phi, x/l) + max(phi, 2*x/l) + cos(w*t)) },
    }
    outputs { pull: N = m*der(der(x)) + k*abs(x), share: 1 = (1 + phi^2)^e }
}";

#[test]
fn the_derivatives_of_every_function_are_proved() {
    compiled(FUNCTIONS, &[], |machine| {
        let Compiled { model, program, .. } = machine;
        let tangent = program.tangent(model).expect("a proved tangent");
        let adjoint = program.adjoint(model).expect("a proved adjoint");
        assert_eq!(tangent.verify(), Ok(()));
        assert_eq!(adjoint.verify(), Ok(()));
    });
}

/// A pendulum whose output is a force: δa = −g/l cos θ δθ − sin θ (δg/l − g/l² δl), and y = m·a changes by m δa + a δm.
#[test]
fn the_tangent_of_a_pendulum_is_that_of_the_book() {
    let text = "machine Pendulum in plane {
        parameters { m: kg = 2, l: m = 0.5, g: m/s^2 = 9.81 }
        coordinates { theta: rad = 0.3 }
        bodies { bob { mass: m, at: l*(sin(theta), -cos(theta)) } }
        gravity (0, -g);
        outputs { y: kg/s^2 = m*der(der(theta)) }
    }";
    compiled(text, &[], |machine| {
        let program = &machine.program;
        let tangent = program.tangent(&machine.model).expect("a tangent");
        let (m, l, g, theta) = (2.0, 0.5, 9.81, 0.3f64);
        let (dm, dl, dg, dtheta) = (0.25, -0.125, 0.5, 0.75);
        let a = -g / l * theta.sin();
        let da = -g / l * theta.cos() * dtheta - theta.sin() * (dg / l - g / (l * l) * dl);
        let mut found = [0.0; 2];
        let mut run = Interpreter::new(&tangent, &[m, l, g, dm, dl, dg]);
        let at = Arguments {
            t: 0.0,
            q: &[theta, dtheta],
            v: &[0.0, 0.0],
            u: &[],
            a: &[a, da],
        };
        run.call(Role::Accelerations, at, &mut found)
            .expect("it moves");
        // A dozen rounding units of numbers up to 30.
        let bound = 12.0 * 30.0 * f64::EPSILON;
        assert!(
            (found[0] - a).abs() < bound && (found[1] - da).abs() < bound,
            "{found:?}"
        );
        let mut dy = [0.0];
        run.call(Role::Output(0), at, &mut dy)
            .expect("it has a value");
        assert!((dy[0] - (m * da + a * dm)).abs() < 2.0 * bound, "{dy:?}");
    });
}

/// The same derivatives in two ways: of the program, and of the equations of motion with accelerations held (E26); forward in
/// a direction of all variables, and backward with weights.
#[test]
fn tangents_and_adjoints_agree_with_elimination() {
    for name in [
        "cart_pole",
        "heavy_top",
        "double_pendulum",
        "four_bar",
        "crusher9",
        "six_joint_arm",
    ] {
        differentiated_machine(name, &[], |machine| {
            let Compiled { model, program, .. } = machine;
            let tangent = program.tangent(model).expect("a tangent");
            let adjoint = program.adjoint(model).expect("an adjoint");
            let n = program.dimension();
            let (parameters, inputs) = (program.parameters.len(), program.inputs.len());
            let number = |seed: usize| 0.3 + ((seed * 7919) % 101) as f64 / 97.0;
            let list = |seed: usize, len: usize| -> Vec<f64> {
                (0..len).map(|i| number(seed + 13 * i)).collect()
            };
            let defaults = program.parameters.iter();
            let defaults = defaults.map(|slot| slot.default.as_ref().map_or(1.0, |d| d.value));
            let p: Vec<f64> = defaults
                .zip(list(1, parameters))
                .map(|(x, y)| x * (1.0 + 0.1 * y))
                .collect();
            let (q, v, u) = (list(3, n), list(5, n), list(7, inputs));
            let [dq, dv, dp, du] = [(11, n), (17, n), (19, parameters), (23, inputs)]
                .map(|(seed, len)| list(seed, len));
            let weights = list(29, n);
            let width = 1 + 2 * n + inputs + parameters;
            let mut rows = vec![0.0; n * width];
            let at = Arguments {
                t: 0.7,
                q: &q,
                v: &v,
                u: &u,
                a: &[],
            };
            Interpreter::new(program, &p)
                .call(Role::Derivatives, at, &mut rows)
                .expect("it has derivatives");
            // The columns are coordinates, rates, inputs and parameters.
            let direction = [&dq[..], &dv, &du, &dp].concat();
            let along = |row: &[f64]| -> (f64, f64) {
                let terms = row[1..].iter().zip(&direction).map(|(x, y)| x * y);
                terms.fold((0.0, 0.0), |(sum, size), x| (sum + x, size + x.abs()))
            };
            let mut found = vec![0.0; 2 * n];
            let both = |x: &[f64], dx: &[f64]| [x, dx].concat();
            let at = Arguments {
                t: 0.7,
                q: &both(&q, &dq),
                v: &both(&v, &dv),
                u: &both(&u, &du),
                a: &[],
            };
            Interpreter::new(&tangent, &both(&p, &dp))
                .call(Role::Accelerations, at, &mut found)
                .expect("a tangent");
            let mut gradient = vec![0.0; 2 * n + parameters + inputs];
            let weighted = both(&u, &weights);
            let at = Arguments {
                t: 0.7,
                q: &q,
                v: &v,
                u: &weighted,
                a: &[],
            };
            Interpreter::new(&adjoint, &p)
                .call(Role::Adjoint, at, &mut gradient)
                .expect("an adjoint");
            // A few thousand rounding units of numbers that may be a thousand times the result.
            let (mut weighed, mut size) = (0.0, 0.0);
            for (i, row) in rows.chunks(width).enumerate() {
                let (expected, of_row) = along(row);
                let error = (found[n + i] - expected).abs();
                assert!(
                    error <= 1e-9 * of_row,
                    "{name} {i}: {} {expected}",
                    found[n + i]
                );
                weighed += weights[i] * expected;
                size += (weights[i] * of_row).abs();
            }
            let order = [&dq[..], &dv, &dp, &du].concat();
            let back: f64 = gradient.iter().zip(&order).map(|(x, y)| x * y).sum();
            assert!(
                (back - weighed).abs() <= 1e-9 * size,
                "{name}: {back} {weighed}"
            );
        });
    }
}

/// The gate stops a derivative with a wrong sign, factor, operand or function.
#[test]
fn no_mistake_in_a_tangent_or_an_adjoint_survives() {
    for (name, stride) in [("cart_pole", 2), ("heavy_top", 5), ("double_pendulum", 3)] {
        machine(name, &[], |machine| {
            let Compiled { model, program, .. } = machine;
            let derivatives = [
                program.tangent(model).expect("a tangent"),
                program.adjoint(model).expect("an adjoint"),
            ];
            for derived in derivatives {
                let (mut tried, mut idle) = (0, 0);
                for Mutant {
                    program: mutant, ..
                } in mutants(&derived, stride)
                {
                    tried += 1;
                    match program.derived(mutant, model) {
                        Ok(_) => idle += 1,
                        Err(unproved) => {
                            let code = unproved.diagnostic(model).code;
                            assert!(
                                matches!(code, Code::Internal | Code::Undefined),
                                "{unproved}"
                            );
                        }
                    }
                }
                println!(
                    "{}: {tried} mistakes, {idle} of them without effect",
                    derived.name
                );
                // The guards of pivots are those of the program, and mistakes in terms that cancel may have no effect.
                assert!(
                    tried >= 40 && 12 * idle <= tried,
                    "{name}: {idle} of {tried}"
                );
            }
        });
    }
}
