//! Tests of the interpreter.

use lagrangian_program::{Arguments, Interpreter, Role, Singular};
use lagrangian_scalar::{DoubleDouble, Scalar};
use lagrangian_symbolic::{Symbol, evaluate};

use crate::harness::{machine, program, program_of_output};

const PENDULUM: &str = "machine Pendulum in plane {
    parameters { m: kg = 2, l: m = 0.5, g: m/s^2 = 9.81 }
    coordinates { phi: rad = pi/3 }
    bodies { bob { mass: m, at: l*(sin(phi), -cos(phi)) } }
    gravity (0, -g);
}";

fn at<'a>(q: &'a [f64], v: &'a [f64]) -> Arguments<'a, f64> {
    Arguments {
        t: 0.0,
        q,
        v,
        u: &[],
        a: &[],
    }
}

#[test]
fn a_pendulum_falls_as_galilei_says() {
    let mut pendulum = Interpreter::new(&program(PENDULUM), &[2.0, 0.5, 9.81]);
    let mut a = [0.0];
    assert_eq!(
        pendulum.call(Role::Accelerations, at(&[0.3], &[1.0]), &mut a),
        Ok(())
    );
    assert!((a[0] + 9.81 / 0.5 * 0.3_f64.sin()).abs() < 1e-14);
    pendulum.prepare(&[2.0, 1.0, 1.62]);
    assert_eq!(
        pendulum.call(Role::Accelerations, at(&[0.3], &[1.0]), &mut a),
        Ok(())
    );
    assert!((a[0] + 1.62 * 0.3_f64.sin()).abs() < 1e-15);
}

#[test]
fn a_machine_starts_where_its_spec_says() {
    let mut pendulum = Interpreter::new(&program(PENDULUM), &[2.0, 0.5, 9.81]);
    let (mut q, mut v) = ([0.0], [1.0]);
    pendulum.start(&mut q, &mut v);
    assert_eq!(v, [0.0]);
    assert!((q[0] - std::f64::consts::FRAC_PI_3).abs() < 4e-16);
    let mut pendulum = Interpreter::new(
        &program(PENDULUM),
        &[2.0, 0.5, 9.81].map(DoubleDouble::from_f64),
    );
    let (mut q, mut v) = ([DoubleDouble::ZERO], [DoubleDouble::ZERO]);
    pendulum.start(&mut q, &mut v);
    let error = q[0] - DoubleDouble::pi() / DoubleDouble::from_f64(3.0);
    assert!(error.to_f64().abs() < 1e-30);
}

#[test]
fn rates_at_the_start_follow_the_coordinates() {
    const ORBIT: &str = "machine Orbit in plane {
        parameters { m: kg = 1, speed: m/s = 3, d: m = 2 }
        coordinates { r: m = d, der(r): m/s = -1, phi: rad, der(phi): rad/s = speed/d }
        bodies { planet { mass: m, at: polar(r, phi) } }
    }";
    let orbit = program(ORBIT);
    let (mut q, mut v) = ([0.0; 2], [0.0; 2]);
    Interpreter::new(&orbit, &[1.0, 3.0, 2.0]).start(&mut q, &mut v);
    assert_eq!((q, v), ([2.0, 0.0], [-1.0, 1.5]));
    Interpreter::new(&orbit, &[1.0, 8.0, 4.0]).start(&mut q, &mut v);
    assert_eq!((q, v), ([4.0, 0.0], [-1.0, 2.0]));
    // A machine that starts at rest has no code for initial rates.
    assert_eq!(orbit.start.results.len(), 4);
    assert_eq!(program(PENDULUM).start.results.len(), 1);
}

#[test]
fn without_mass_there_are_no_accelerations_but_everything_else() {
    let mut pendulum = Interpreter::new(&program(PENDULUM), &[0.0, 0.5, 9.81]);
    let mut a = [7.0];
    let singular = pendulum.call(Role::Accelerations, at(&[0.3], &[1.0]), &mut a);
    assert!(matches!(singular, Err(Singular { coordinate: 0, .. })));
    assert_eq!(
        pendulum.call(Role::KineticEnergy, at(&[0.3], &[1.0]), &mut a),
        Ok(())
    );
    assert_eq!(a, [0.0]);
    pendulum.prepare(&[1.0, 0.5, 9.81]);
    assert_eq!(
        pendulum.call(Role::Accelerations, at(&[0.3], &[1.0]), &mut a),
        Ok(())
    );
}

#[test]
fn parameters_that_are_no_numbers_are_singular_not_silent() {
    let mut pendulum = Interpreter::new(&program(PENDULUM), &[f64::NAN, 0.5, 9.81]);
    let singular = pendulum.call(Role::Accelerations, at(&[0.3], &[1.0]), &mut [0.0]);
    assert!(singular.is_err_and(|singular| singular.ratio.is_nan()));
}

#[test]
fn a_singular_state_names_the_coordinate() {
    machine("crusher9", &[], |machine| {
        let program = &machine.program;
        let parameters: Vec<f64> = program
            .parameters
            .iter()
            .map(|p| p.default.as_ref().expect("a default").value)
            .collect();
        let mut crusher = Interpreter::new(program, &parameters);
        let mut q = [0.0; 9];
        crusher.start(&mut q, &mut [0.0; 9]);
        let mut a = [0.0; 9];
        assert_eq!(
            crusher.call(Role::Accelerations, at(&q, &[0.0; 9]), &mut a),
            Ok(())
        );
        q[6] = 0.0; // s2, the radius of the pestle's polar coordinates
        let singular = crusher
            .call(Role::Accelerations, at(&q, &[0.0; 9]), &mut a)
            .expect_err("a pole");
        assert_eq!(
            program.coordinates[singular.coordinate].name.to_string(),
            "phi2"
        );
    });
}

#[test]
fn a_folded_double_pendulum_of_extreme_masses_is_no_singular_one() {
    let text = PENDULUM.replace("Pendulum", "Double").replace(
        "coordinates { phi: rad = pi/3 }",
        "coordinates { phi: rad, psi: rad }",
    );
    let text = text.replace(
        "bob { mass: m, at: l*(sin(phi), -cos(phi)) }",
        "bob { mass: m, at: l*(sin(phi), -cos(phi)) }, tip { mass: m2, at: bob.at + l*(sin(psi), -cos(psi)) }",
    );
    let program = program(&text.replace("m: kg = 2", "m: kg = 2, m2: kg = 1"));
    for (m, m2) in [(1.0, 1e9), (1e9, 1.0), (1e-9, 1.0)] {
        let mut machine = Interpreter::new(&program, &[m, m2, 0.5, 9.81]);
        let mut a = [0.0; 2];
        assert_eq!(
            machine.call(Role::Accelerations, at(&[0.0, 0.1], &[0.0; 2]), &mut a),
            Ok(()),
            "{m} {m2}"
        );
    }
    // A moving mass of 2^-53 of the other is below the resolution of the matrix.
    let mut machine = Interpreter::new(&program, &[1e-17, 1.0, 0.5, 9.81]);
    let singular = machine.call(
        Role::Accelerations,
        at(&[0.1, 0.1], &[0.0; 2]),
        &mut [0.0; 2],
    );
    assert!(singular.is_err());
}

#[test]
fn an_interpreter_gives_what_its_expressions_give() {
    machine("six_joint_arm", &[], |machine| {
        let (model, program) = (&machine.model, &machine.program);
        let parameters: Vec<f64> = program
            .parameters
            .iter()
            .map(|p| p.default.as_ref().expect("a default").value)
            .collect();
        let list = |seed: f64| {
            (0..6)
                .map(|i| (seed + f64::from(i)).sin())
                .collect::<Vec<f64>>()
        };
        let (q, v, u) = (list(1.0), list(2.0), list(3.0));
        let mut value: std::collections::BTreeMap<Symbol, f64> = Default::default();
        let mut set = |symbol: lagrangian_symbolic::Expr<'_>, x: f64| {
            value.insert(symbol.as_symbol().expect("a symbol"), x);
        };
        set(model.time, 0.5);
        model
            .parameters
            .iter()
            .zip(&parameters)
            .for_each(|(p, x)| set(p.symbol, *x));
        for (i, coordinate) in model.coordinates.iter().enumerate() {
            set(coordinate.q, q[i]);
            set(coordinate.v, v[i]);
        }
        model
            .inputs
            .iter()
            .zip(&u)
            .for_each(|(input, x)| set(input.symbol, *x));
        let expected = evaluate(model.dag, &machine.equations.forces, |symbol| {
            value[&symbol]
        });
        let mut results = [0.0; 6];
        let arguments = Arguments {
            t: 0.5,
            q: &q,
            v: &v,
            u: &u,
            a: &[],
        };
        let mut arm = Interpreter::new(program, &parameters);
        assert_eq!(arm.call(Role::Forces, arguments, &mut results), Ok(()));
        let scale = expected.iter().fold(0.0_f64, |scale, x| scale.max(x.abs()));
        for (result, expected) in results.iter().zip(&expected) {
            assert!(
                (result - expected).abs() < 1e-13 * scale,
                "{result} {expected}"
            );
        }
    });
}

#[test]
fn deep_programs_run() {
    // A chain of 20 000 operations, each of which needs the previous one.
    let steps = "1/2 + 1/3*sin(".repeat(60);
    let output = format!("{steps}x{}", ")".repeat(60));
    let program = program_of_output("", &output);
    let mut machine = Interpreter::new(&program, &[2.0, 1.0]);
    let mut out = [0.0];
    assert_eq!(
        machine.call(Role::Output(0), at(&[0.5, 0.3], &[0.0; 2]), &mut out),
        Ok(())
    );
    let expected = (0..60).fold(0.5_f64, |x, _| 0.5 + x.sin() / 3.0);
    assert!((out[0] - expected).abs() < 1e-15);
}

/// The accelerations of a machine at its default parameters.
fn accelerations_at(text: &str, q: &[f64], v: &[f64]) -> Vec<f64> {
    let program = program(text);
    let parameters = program.parameters.iter();
    let parameters: Vec<f64> = parameters
        .map(|p| p.default.as_ref().expect("a default").value)
        .collect();
    let arguments = Arguments {
        t: 0.0,
        q,
        v,
        u: &[],
        a: &[],
    };
    let mut a = vec![0.0; q.len()];
    let called =
        Interpreter::new(&program, &parameters).call(Role::Accelerations, arguments, &mut a);
    assert_eq!(called, Ok(()));
    a
}

#[test]
fn drag_by_the_square_of_the_speed_is_nothing_at_rest() {
    let text = "machine Falling in plane {
        parameters { m: kg = 0.1, c: N*s^2/m^2 = 0.003, g: m/s^2 = 9.81 }
        coordinates { x: m, y: m = 100 }
        bodies { ball { mass: m, at: (x, y) } }
        gravity (0, -g);
        dissipations { drag: 1/3*c*dot(der(ball.at), der(ball.at))^(3/2) }
    }";
    let a = accelerations_at(text, &[0.0, 100.0], &[0.0; 2]);
    assert!(a[0] == 0.0 && (a[1] + 9.81).abs() < 1e-14, "{a:?}");
    // c |v| v is 0.003·5·(3, −4) N, on 0.1 kg.
    let a = accelerations_at(text, &[0.0, 100.0], &[3.0, -4.0]);
    assert!(
        (a[0] + 0.45).abs() < 1e-15 && (a[1] - 0.6 + 9.81).abs() < 1e-14,
        "{a:?}"
    );
}

#[test]
fn one_coordinate_may_be_the_abscissa_of_one_body_and_the_ordinate_of_another() {
    let bodies = [
        "block { mass: 1, at: (x, 0) }",
        "weight { mass: 2, at: (0, x) }",
    ];
    for [first, second] in [bodies, [bodies[1], bodies[0]]] {
        let text = format!(
            "machine T in plane {{ coordinates {{ x: m }} bodies {{ {first}, {second} }} gravity (0, -10); }}"
        );
        let a = accelerations_at(&text, &[0.0], &[0.0]);
        assert!((a[0] + 20.0 / 3.0).abs() < 1e-14, "{a:?}");
    }
}
