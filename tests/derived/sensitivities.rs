//! Derivatives of motions, tested against closed forms, differences of motions, and the symplectic invariant of conservative machines.

use crate::support::library;
use lagrangian::{
    Coordinates, Differentiate, Error, METHODS, Machine, Sensitive, Simulation, State, System,
    Varied, Vector,
};

lagrangian::machine! {
    /// A mass on a spring, pushed with a constant force.
    machine Oscillator in plane {
        parameters { m: kg = 2, k: N/m = 18 }
        coordinates { x: m }
        inputs { push: N = 3 }
        bodies { block { mass: m, at: (x, 0) } }
        springs { spring { stiffness: k, stretch: x } }
        forces { hand { on: x, value: push } }
        derivatives { coordinates, rates, inputs, k, m }
    }
}

lagrangian::machine! {
    /// Two swinging rods: conservative, and chaotic at large amplitudes.
    machine Rods in plane {
        parameters { m1: kg = 1, m2: kg = 0.7, l1: m = 0.5, l2: m = 0.8, g: m/s^2 = 9.81 }
        coordinates { theta1: rad = 1.2, theta2: rad = -0.4 }
        bodies {
            upper { mass: m1, at: l1*(sin(theta1), -cos(theta1)) },
            lower { mass: m2, at: upper.at + l2*(sin(theta2), -cos(theta2)) },
        }
        gravity (0, -g);
        derivatives { coordinates, rates, l1, m2 }
    }
}

/// The text of the machine above for the interpreter.
const RODS: &str = "machine Rods in plane {
    parameters { m1: kg = 1, m2: kg = 0.7, l1: m = 0.5, l2: m = 0.8, g: m/s^2 = 9.81 }
    coordinates { theta1: rad = 1.2, theta2: rad = -0.4 }
    bodies {
        upper { mass: m1, at: l1*(sin(theta1), -cos(theta1)) },
        lower { mass: m2, at: upper.at + l2*(sin(theta2), -cos(theta2)) },
    }
    gravity (0, -g);
    derivatives { coordinates, rates, l1, m2 }
}";

/// `x = x₀ cos ωt + v₀/ω sin ωt + F/k (1 − cos ωt)`, ω² = k/m, and its derivatives, found by hand; tested with every method.
#[test]
fn an_oscillators_derivatives_are_those_of_its_closed_form() {
    let oscillator = Oscillator::default();
    let Oscillator { m, k } = oscillator;
    let (x0, v0, push) = (0.4, -0.9, 3.0);
    let omega = (k / m).sqrt();
    let exact = |t: f64| {
        let (sin, cos) = (omega * t).sin_cos();
        let x = x0 * cos + v0 / omega * sin + push / k * (1.0 - cos);
        let by_omega =
            -x0 * t * sin + v0 * (t * cos / omega - sin / (omega * omega)) + push / k * t * sin;
        let by_k = by_omega / (2.0 * m * omega) - push / (k * k) * (1.0 - cos);
        let by_m = -by_omega * omega / (2.0 * m);
        [x, cos, sin / omega, (1.0 - cos) / k, by_k, by_m]
    };
    let sensitive = Sensitive::new(&oscillator)
        .by_state()
        .and_then(|all| all.by("push"))
        .and_then(|all| all.by("k"))
        .and_then(|all| all.by("m"))
        .expect("known variables");
    let start = State {
        t: 0.0,
        q: oscillator::Coordinates { x: x0 },
        v: oscillator::Coordinates { x: v0 },
    };
    let (end, tolerance) = (6.0, 1e-10);
    for (number, method) in METHODS.iter().enumerate() {
        let run = Simulation::new(&sensitive)
            .method(method)
            .tolerance(tolerance)
            .until(end)
            .run(sensitive.start_from(start))
            .expect("a run");
        // The error norm of a step is the root mean square over 12 numbers, each relative to its size, so one number errs by
        // at most √12 times the tolerance and all by 12 √12. Through the coupling of the equations an error grows no faster
        // than 1 + t, so 12 √12 (1 + t) for each step is an upper bound.
        let limit = 42.0 * (1.0 + end) * tolerance * run.statistics().steps as f64;
        for t in [0.3, 2.7, 4.1, end] {
            let Varied { value, by } = run.at(t).expect("within the run").q;
            let found: Vec<f64> = [value].iter().chain(&by).map(|q| q.x).collect();
            for (found, exact) in found.iter().zip(exact(t)) {
                assert!(
                    (found - exact).abs() <= limit,
                    "method {number}: {found}, not {exact}"
                );
            }
        }
    }
}

/// The central difference quotients with increments d and d/2 have errors of order d² and d²/4, so the error of the second is
/// about a third of the difference of the two, plus terms of higher order and the error of the two runs divided by d.
fn assert_quotients<M: Machine>(
    machine: &M,
    sensitive: &Sensitive<'_, M>,
    vary: impl Fn(usize, f64) -> (M, State<Coordinates<M>>),
) where
    M::System: Differentiate,
{
    let (end, tolerance) = (1.5, 1e-12);
    let run = Simulation::new(sensitive)
        .tolerance(tolerance)
        .until(end)
        .run(sensitive.start_from(machine.start()))
        .expect("a run");
    let system = machine.prepare();
    let flat = |state: &Coordinates<M>| system.to_vector(state).as_slice().to_vec();
    let at_end = |k: usize, shift: f64| {
        let (machine, start) = vary(k, shift);
        let run = Simulation::new(&machine)
            .tolerance(tolerance)
            .until(end)
            .run(start)
            .expect("a run");
        (flat(&run.end().q), run.statistics().steps as f64)
    };
    for (k, by) in run.end().q.by.iter().enumerate() {
        let quotient = |d: f64| {
            let ((up, steps), (down, _)) = (at_end(k, d), at_end(k, -d));
            let quotients = up
                .iter()
                .zip(&down)
                .map(|(up, down)| (up - down) / (2.0 * d));
            (quotients.collect::<Vec<f64>>(), steps)
        };
        let d = 1e-3;
        let ((coarse, _), (fine, steps)) = (quotient(d), quotient(d / 2.0));
        let found = flat(by);
        let largest = found.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
        for ((coarse, fine), found) in coarse.iter().zip(&fine).zip(found) {
            // Errors of earlier steps grow like the derivatives by the state.
            let noise = steps * tolerance * (1.0 + largest) * 10.0 / d;
            let limit = (coarse - fine).abs() + noise;
            assert!(
                (found - fine).abs() <= limit,
                "{k}: {found}, not {fine} ± {limit}"
            );
            assert!(
                limit <= 1e-2 * largest,
                "the quotients say nothing: {limit}"
            );
        }
    }
}

#[test]
fn derivatives_are_the_limits_of_differences() {
    let rods = Rods::default();
    let sensitive = Sensitive::new(&rods)
        .by_state()
        .and_then(|all| all.by("l1"))
        .and_then(|all| all.by("m2"))
        .expect("known variables");
    assert_quotients(&rods, &sensitive, |k, shift| {
        let (mut rods, mut start) = (rods, rods.start());
        match k {
            0 => start.q.theta1 += shift,
            1 => start.q.theta2 += shift,
            2 => start.v.theta1 += shift,
            3 => start.v.theta2 += shift,
            4 => rods.l1 += shift,
            _ => rods.m2 += shift,
        }
        (rods, start)
    });
}

/// `Φᵀ Ω₁ Φ = Ω₀` with `Ω = ∂(q, p)/∂(q, v)ᵀ J ∂(q, p)/∂(q, v)`, p = M v: the flow of a conservative machine is symplectic.
#[test]
fn a_conservative_motion_keeps_areas_in_phase_space() {
    let rods = Rods::default();
    let Rods { m1, m2, l1, l2, .. } = rods;
    let omega = |q: [f64; 2], v: [f64; 2]| -> [[f64; 4]; 4] {
        let coupling = m2 * l1 * l2;
        let (sin, cos) = (q[0] - q[1]).sin_cos();
        let mass = [
            [(m1 + m2) * l1 * l1, coupling * cos],
            [coupling * cos, m2 * l2 * l2],
        ];
        // ∂(M v)/∂q
        let by_q = [
            [-coupling * sin * v[1], coupling * sin * v[1]],
            [-coupling * sin * v[0], coupling * sin * v[0]],
        ];
        std::array::from_fn(|i| {
            std::array::from_fn(|j| match (i < 2, j < 2) {
                (true, true) => by_q[i][j] - by_q[j][i],
                (true, false) => mass[i][j - 2],
                (false, true) => -mass[i - 2][j],
                (false, false) => 0.0,
            })
        })
    };
    let sensitive = Sensitive::new(&rods).by_state().expect("no constraints");
    let (end, tolerance) = (4.0, 1e-12);
    let run = Simulation::new(&sensitive)
        .tolerance(tolerance)
        .until(end)
        .run(sensitive.start())
        .expect("a run");
    let before = omega(rods.start().q.to_array(), rods.start().v.to_array());
    for t in [0.5, 1.7, end] {
        let state = run.at(t).expect("within the run");
        let after = omega(state.q.value.to_array(), state.v.value.to_array());
        let column = |j: usize| -> [f64; 4] {
            let (q, v) = (state.q.by[j].to_array(), state.v.by[j].to_array());
            [q[0], q[1], v[0], v[1]]
        };
        let phi: [[f64; 4]; 4] = std::array::from_fn(column);
        let size = phi
            .as_flattened()
            .iter()
            .fold(1.0_f64, |size, x| size.max(x.abs()));
        let masses = after.as_flattened().iter().chain(before.as_flattened());
        let masses = masses.fold(0.0_f64, |size, x| size.max(x.abs()));
        // Each step contributes an error in each of the 16 products of two columns, each as large as the columns; the errors
        // then grow as the columns do.
        let steps = run.statistics().steps as f64;
        let limit = 32.0 * steps * tolerance * masses * size * size * size;
        for i in 0..4 {
            for j in 0..4 {
                let mut product = 0.0;
                for a in 0..4 {
                    for b in 0..4 {
                        product += phi[i][a] * after[a][b] * phi[j][b];
                    }
                }
                let off = (product - before[i][j]).abs();
                assert!(
                    off <= limit,
                    "t = {t}, ({i}, {j}): off by {off}, more than {limit}"
                );
            }
        }
        assert!(limit < 1e-3 * masses, "the limit says nothing: {limit}");
    }
}

#[test]
fn an_interpreted_machine_has_the_same_derivatives() {
    let rods = Rods::default();
    let interpreted = library::machine(RODS);
    let compiled = Sensitive::new(&rods)
        .by_state()
        .and_then(|all| all.by("m2"));
    let compiled = compiled.expect("known");
    let other = Sensitive::new(&interpreted)
        .by_state()
        .and_then(|all| all.by("m2"))
        .expect("known");
    let names = |quantities: Vec<lagrangian::Quantity<'_>>| -> Vec<String> {
        quantities
            .iter()
            .map(|q| format!("{} [{}]", q.name, q.unit))
            .collect()
    };
    let (one, two) = (compiled.prepare(), other.prepare());
    let one = names(one.coordinates().collect());
    assert_eq!(one, names(two.coordinates().collect()));
    assert_eq!(one[11], "theta2 by m2 [rad/kg]");
    let run = Simulation::new(&compiled)
        .until(1.0)
        .run(compiled.start())
        .expect("a run");
    let again = Simulation::new(&other)
        .until(1.0)
        .run(other.start())
        .expect("a run");
    // Both perform the same operations in the same order.
    assert_eq!(run.statistics().steps, again.statistics().steps);
    for (by, other) in run.end().q.by.iter().zip(&again.end().q.by) {
        assert_eq!(by.to_array().as_slice(), other.values.as_slice());
    }
}

#[test]
fn what_is_not_known_is_refused_by_name() {
    let rods = Rods::default();
    let refused = Sensitive::new(&rods)
        .by("l2")
        .map(|_| ())
        .expect_err("not asked for");
    // In the order of declaration.
    let known = vec!["m2".to_owned(), "l1".to_owned()];
    assert_eq!(
        refused,
        Error::UnknownVariable {
            name: "l2".into(),
            known
        }
    );
    assert!(
        refused.to_string().ends_with("available: m2, l1"),
        "{refused}"
    );
    let refused = Sensitive::new(&rods).by_start("theta3").map(|_| ());
    assert_eq!(
        refused,
        Err(Error::UnknownCoordinate {
            name: "theta3".into()
        })
    );
}

/// The start of a pendulum in Cartesian coordinates depends on the rod's length, which its accelerations do not reflect. An
/// error is better than derivatives of (0, 0).
#[test]
fn motions_that_constraints_hold_are_not_differentiated() {
    let pendulum = library::machine(
        "machine Pendulum in plane {
            parameters { m: kg = 1, l: m = 1, g: m/s^2 = 9.81 }
            coordinates { x: m = 0.6, y: m = -0.8 }
            bodies { bob { mass: m, at: (x, y) } }
            gravity (0, -g);
            constraints { rod: x^2 + y^2 = l^2 }
            derivatives { coordinates, rates, l, g }
        }",
    );
    let refused = Error::ConstrainedSensitivity {
        constraint: "rod".into(),
    };
    assert!(refused.to_string().contains("`rod`"));
    let sensitive = || Sensitive::new(&pendulum);
    for found in [
        sensitive().by("l"),
        sensitive().by("g"),
        sensitive().by_start("x"),
        sensitive().by_start_rate("y"),
        sensitive().by_state(),
    ] {
        assert_eq!(found.err(), Some(refused.clone()));
    }
}
