//! Derivatives in emitted code that a spec requests, tested against closed
//! forms and against dual numbers through the emitted accelerations.

use crate::support::library;
use lagrangian::scalar::{DoubleDouble, Dual, Scalar};
use lagrangian::{Error, Linearize, Machine, Pivot, StepError, System};

lagrangian::machine! {
    /// A damped pendulum with a motor.
    machine Pendulum in plane {
        parameters { m: kg = 2, l: m = 0.5, b: N*m*s = 0.25, g: m/s^2 = 9.75 }
        coordinates { theta: rad }
        inputs { tau: N*m = 0 }
        bodies { bob { mass: m, at: l*(sin(theta), -cos(theta)) } }
        gravity (0, -g);
        dissipations { hinge: b*der(theta)^2/2 }
        forces { motor { on: theta, value: tau } }
        derivatives { coordinates, rates, inputs, l, b }
    }
}

lagrangian::machine! {
    /// A chain that hangs from a moving point, long enough that its code is split into several functions.
    machine Chain in plane {
        constants { N = 9 }
        parameters { l: m = 0.3, m[1..N]: kg = 0.5, A: m = 0.1, w: rad/s = 7, k: N*m = 2, g: m/s^2 = 9.81 }
        coordinates { q[1..N]: rad = 0.3 }
        frames { joint[0] = ground.shift(A*sin(w*t), 0), joint[i in 1..N] = joint[i-1].turn(q[i]).shift(0, -l) }
        bodies { bob[i in 1..N] { mass: m[i], at: joint[i].origin } }
        gravity (0, -g);
        torsion_springs { last { stiffness: k, twist: q[N] } }
        derivatives { rates, coordinates, m[2], w }
    }
}

/// `a = (τ − b v)/(m l²) − g/l sin θ`, differentiated by hand. Every term is a product of few factors, so the error is at
/// most a few rounding units of the sum of the terms' sizes.
#[test]
fn a_pendulums_derivatives_are_those_of_its_closed_form() {
    let pendulum = Pendulum::default();
    let Pendulum { m, l, b, g, .. } = pendulum;
    let (theta, v, tau) = (0.7_f64, 1.25, 0.5);
    let p = pendulum.prepare();
    let found = pendulum::derivatives(&p, &[theta], &[v], &pendulum::Inputs { tau }).unwrap();
    let inertia = m * l * l;
    let check = |found: f64, terms: &[f64]| {
        let (exact, size): (f64, f64) = terms
            .iter()
            .fold((0.0, 0.0), |(sum, size), x| (sum + x, size + x.abs()));
        assert!(
            (found - exact).abs() <= 16.0 * f64::EPSILON * size,
            "{found}, {exact}"
        );
    };
    check(
        found.accelerations[0],
        &[tau / inertia, -b * v / inertia, -g / l * theta.sin()],
    );
    check(found.by_coordinates[0][0], &[-g / l * theta.cos()]);
    check(found.by_rates[0][0], &[-b / inertia]);
    check(found.by_inputs[0][0], &[1.0 / inertia]);
    let by_length = [
        -2.0 * tau / (inertia * l),
        2.0 * b * v / (inertia * l),
        g / (l * l) * theta.sin(),
    ];
    check(found.by_parameters[0][0], &by_length);
    check(found.by_parameters[0][1], &[-v / inertia]);
}

/// All derivatives against dual numbers: entry (i, j) is the coefficient of ε in acceleration i when variable j carries ε.
#[test]
fn a_chains_derivatives_are_what_dual_numbers_carry() {
    let chain = Chain::default();
    let state = |i: usize| 0.2 + 0.1 * ((i * 7) % 11) as f64;
    let q: [f64; 9] = std::array::from_fn(state);
    let v: [f64; 9] = std::array::from_fn(|i| 1.0 - state(i + 4));
    let found = chain::derivatives(&chain.prepare(), 0.3, &q, &v).unwrap();
    let close = |found: f64, exact: f64, size: f64| {
        // The bound allows a few hundred operations on numbers of the size of the largest.
        assert!(
            (found - exact).abs() <= 1e3 * f64::EPSILON * size,
            "{found}, {exact}"
        );
    };
    // The dual numbers use double-doubles; in `f64` they would be less accurate than the code under test.
    let wide = |x: f64| Dual::constant(DoubleDouble::from_f64(x));
    let dual = |j: usize| -> [f64; 9] {
        let mut machine = chain.map(wide);
        let (mut q, mut v) = (q.map(wide), v.map(wide));
        match j {
            0..9 => q[j].derivative = DoubleDouble::ONE,
            9..18 => v[j - 9].derivative = DoubleDouble::ONE,
            18 => machine.m[1].derivative = DoubleDouble::ONE,
            _ => machine.w.derivative = DoubleDouble::ONE,
        }
        let prepared = machine.prepare();
        let found = chain::accelerations(&prepared, wide(0.3), &q, &v).unwrap();
        found.map(|a| a.derivative.to_f64())
    };
    for j in 0..20 {
        let exact = dual(j);
        let size = exact.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        for (i, exact) in exact.into_iter().enumerate() {
            let entry = match j {
                0..9 => found.by_coordinates[i][j],
                9..18 => found.by_rates[i][j - 9],
                _ => found.by_parameters[i][j - 18],
            };
            close(entry, exact, size);
        }
    }
}

#[test]
fn what_is_linearized_is_what_was_derived() {
    let chain = Chain::default();
    let system = chain.prepare();
    let (q, v) = ([0.4; 9], [0.1; 9]);
    let found = chain::derivatives(&system, 1.5, &q, &v).unwrap();
    let (mut a, mut by_q, mut by_v) = ([0.0; 9], [0.0; 81], [0.0; 81]);
    let u = system.default_inputs();
    system
        .linearize(1.5, &q, &v, &u, &mut a, &mut by_q, &mut by_v)
        .unwrap();
    assert_eq!(a, found.accelerations);
    assert_eq!(by_q.as_slice(), found.by_coordinates.as_flattened());
    assert_eq!(by_v.as_slice(), found.by_rates.as_flattened());
}

/// A machine whose spec requests no derivatives still has them in the interpreter, by dual numbers. The test compares the
/// same chain with and without that section: one differentiates the forces and solves, the other carries the derivative
/// through the whole program.
#[test]
fn what_nobody_asked_for_is_linearized_by_dual_numbers() {
    let text = |derivatives: &str| {
        format!(
            "machine Chain in plane {{
                parameters {{ l: m = 0.3, m: kg = 0.5, A: m = 0.1, w: rad/s = 7, k: N*m = 2, b: N*m*s = 0.1, g: m/s^2 = 9.81 }}
                constants {{ N = 4 }}
                coordinates {{ q[1..N]: rad = 0.3 }}
                inputs {{ tau: N*m = 0.7 }}
                frames {{
                    joint[0] = ground.shift(A*sin(w*t), 0),
                    joint[i in 1..N] = joint[i-1].turn(q[i]).shift(0, -l)
                }}
                bodies {{ bob[i in 1..N] {{ mass: m, at: joint[i].origin }} }}
                gravity (0, -g);
                torsion_springs {{ last {{ stiffness: k, twist: q[N] }} }}
                dissipations {{ hinge: b*der(q[1])^2/2 }}
                forces {{ motor {{ on: q[2], value: tau }} }}
                {derivatives}
            }}"
        )
    };
    let asked = library::machine(&text("derivatives { coordinates, rates }")).prepare();
    let unasked = library::machine(&text("")).prepare();
    let (q, v) = (vec![0.7, -0.4, 1.1, 0.2], vec![1.3, -2.1, 0.4, 3.0]);
    let mut u = unasked.default_inputs();
    assert_eq!(u.set("tau", 1.9), Ok(()));
    let linearized = |system: &lagrangian::interpreted::InterpretedSystem| {
        let (mut a, mut by_q, mut by_v) = (vec![0.0; 4], vec![0.0; 16], vec![0.0; 16]);
        system
            .linearize(0.3, &q, &v, &u, &mut a, &mut by_q, &mut by_v)
            .expect("not singular");
        [a, by_q, by_v]
    };
    let mut alone = vec![0.0; 4];
    unasked
        .accelerations(0.3, &q, &v, &u, &mut alone)
        .expect("not singular");
    for (found, exact) in linearized(&unasked).iter().zip(linearized(&asked)) {
        let size = exact.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        assert!(size > 0.0);
        for (found, exact) in found.iter().zip(exact) {
            // The bound allows a few hundred operations on numbers of the size of the largest; no entry of this chain is 0.
            let limit = 1e3 * f64::EPSILON * size;
            assert!((found - exact).abs() <= limit, "{found}, not {exact}");
        }
    }
    let [a, ..] = linearized(&unasked);
    let size = alone.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    for (a, alone) in a.iter().zip(&alone) {
        assert!(
            (a - alone).abs() <= 1e3 * f64::EPSILON * size,
            "{a}, not {alone}"
        );
    }
}

/// Where the accelerations do not exist, their derivatives do not either.
#[test]
fn dual_numbers_refuse_what_accelerations_refuse() {
    let text = "machine Polar in plane {
        coordinates { r: m = 1, phi: rad }
        bodies { bead { mass: 1, at: r*(cos(phi), sin(phi)) } }
    }";
    let system = library::machine(text).prepare();
    let (q, v, u) = (vec![0.0, 0.3], vec![0.1, 0.2], system.default_inputs());
    let (mut a, mut by_q, mut by_v) = (vec![0.0; 2], vec![0.0; 4], vec![0.0; 4]);
    let alone = system.accelerations(0.0, &q, &v, &u, &mut a);
    let refused = system.linearize(0.0, &q, &v, &u, &mut a, &mut by_q, &mut by_v);
    assert_eq!(refused.map_err(|e| e.at), Err(Pivot::Coordinate(1)));
    assert_eq!(refused, alone);
}

#[test]
fn what_may_stick_is_not_linearized_and_named() {
    let text = "machine Block in plane {
        coordinates { x: m }
        frames { block = ground.shift(x, 0) }
        bodies { block { mass: 1, frame: block } }
        gravity (0, -9.81);
        sliding { floor { body: block, on: ground, direction: (1, 0), friction: 0.2 } }
    }";
    let system = library::machine(text).prepare();
    let (q, v, u) = (vec![0.0], vec![1.0], system.default_inputs());
    let (mut a, mut by_q, mut by_v) = (vec![0.0], vec![0.0], vec![0.0]);
    let refused = system.linearize(0.0, &q, &v, &u, &mut a, &mut by_q, &mut by_v);
    let singular = refused.unwrap_err();
    assert_eq!(singular.at, Pivot::NotDifferentiated(0));
    assert_eq!(singular.name(&system), "floor");
    let error = Error::of_step(StepError::Singular { singular, t: 0.5 }, &system).to_string();
    let expected =
        "the accelerations cannot be differentiated at t = 0.5 s: `floor` may stick or slide";
    assert!(error.starts_with(expected), "{error}");
}

/// The code for derivatives can itself be differentiated: the matrix of derivatives by coordinates is
/// generic over its numbers, too.
#[test]
fn derivatives_run_over_any_number() {
    let wide = Pendulum::default().map(lagrangian::scalar::DoubleDouble::from_f64);
    let zero = lagrangian::scalar::DoubleDouble::ZERO;
    let found = pendulum::derivatives(
        &wide.prepare(),
        &[zero],
        &[zero],
        &pendulum::Inputs { tau: zero },
    )
    .unwrap();
    let exact = -lagrangian::scalar::DoubleDouble::from_f64(9.75)
        / lagrangian::scalar::DoubleDouble::from_f64(0.5);
    assert_eq!(found.by_coordinates[0][0], exact);
}
