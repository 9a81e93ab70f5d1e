//! Runs end where the closed form, or a computation in higher precision, predicts.
#![expect(
    clippy::excessive_precision,
    reason = "references with all their digits"
)]

use crate::by_hand::double_pendulum::{DoublePendulum, DoublePendulumCoordinates};
use crate::by_hand::toy::{Toy, oscillator, pendulum};
use crate::support::known_ends::{CHAOTIC_AT_10, REGULAR_AT_100};
use crate::support::special::agm;
use lagrangian::{Crossing, METHODS, Machine, Simulation, Solution, State};
use std::f64::consts::{FRAC_PI_2, PI};

const TOLERANCES: [f64; 5] = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];

/// Each step may err by `tolerance`, plus one ulp of round-off. The motion amplifies a small change
/// by at most `growth`, which bounds what the errors sum up to at the end.
fn limit<M: Machine>(run: &Solution<M>, tolerance: f64, growth: f64) -> f64 {
    run.statistics().steps as f64 * (tolerance + f64::EPSILON) * growth
}

/// The error of a state, relative to 1 + |y|.
fn error(found: &[f64], exact: &[f64]) -> f64 {
    found
        .iter()
        .zip(exact)
        .map(|(y, exact)| (y - exact).abs() / (1.0 + exact.abs()))
        .fold(0.0, f64::max)
}

#[test]
fn an_oscillator_follows_its_cosine() {
    for method in &METHODS {
        for tolerance in [1e-4, 1e-7, 1e-10] {
            let oscillator = Toy {
                p: 3.0,
                ..oscillator()
            };
            let run = Simulation::new(&oscillator)
                .method(method)
                .tolerance(tolerance)
                .until(10.0)
                .run(oscillator.start())
                .unwrap();
            // The rate is up to three times the position, and its error up to
            // three times that of the position.
            for i in 0..=100 {
                let t = f64::from(i) / 10.0;
                let state = run.at(t).unwrap();
                let exact = [(3.0 * t).cos(), -3.0 * (3.0 * t).sin()];
                let error = error(&[state.q[0], state.v[0]], &exact);
                let limit = limit(&run, tolerance, 3.0);
                assert!(
                    error <= limit,
                    "{} {tolerance} {t}: {error:e}",
                    method.tableau.name
                );
            }
        }
    }
}

#[test]
fn a_damped_oscillator_follows_its_exponential() {
    // x'' = −2 δ x' − (δ² + ω²) x with δ = 0.3, ω = p = 2: x = e^(−δ t) (cos ω t + (δ/ω) sin ω t).
    let damped = Toy {
        p: 2.0,
        ..Toy::new(([1.0], [0.0]), |_, q, v, _, p| {
            [-0.6 * v[0] - (0.09 + p * p) * q[0]]
        })
    };
    for tolerance in TOLERANCES {
        let run = Simulation::new(&damped)
            .tolerance(tolerance)
            .until(10.0)
            .run(damped.start())
            .unwrap();
        let (sin, cos) = 20.0_f64.sin_cos();
        let decay = (-3.0_f64).exp();
        let exact = [decay * (cos + 0.15 * sin), -decay * (0.045 + 2.0) * sin];
        let error = error(&[run.end().q[0], run.end().v[0]], &exact);
        assert!(
            error <= limit(&run, tolerance, 2.0),
            "{tolerance}: {error:e}"
        );
    }
}

#[test]
fn a_driven_oscillator_beats() {
    // x'' = −x + u with u = cos(p t): x = (cos p t − cos t) / (1 − p²).
    let driven = Toy {
        p: 0.9,
        ..Toy::new(([0.0], [0.0]), |_, q, _, u, _| [u - q[0]])
    };
    let run = Simulation::new(&driven)
        .tolerance(1e-11)
        .inputs(|t, _, _, u| *u = (0.9 * t).cos())
        .until(30.0)
        .run(driven.start())
        .unwrap();
    for state in run.steps().chain(run.every(0.7).unwrap()) {
        let exact = ((0.9 * state.t).cos() - state.t.cos()) / (1.0 - 0.81);
        let limit = run.statistics().steps as f64 * 1e-11;
        assert!(
            (state.q[0] - exact).abs() <= limit * (1.0 + exact.abs()),
            "{}",
            state.t
        );
    }
}

#[test]
fn a_pendulum_has_the_period_that_gauss_gave() {
    // T = 2π / (ω agm(1, cos(θ₀/2))) is the time from one rest on a side
    // to the next on the same side.
    for amplitude in [0.1_f64, 1.0, 3.0] {
        let period = 2.0 * PI / (3.0 * agm(1.0, (amplitude / 2.0).cos()));
        let pendulum = Toy {
            p: 3.0,
            ..pendulum(amplitude)
        };
        for tolerance in TOLERANCES {
            let run = Simulation::new(&pendulum)
                .tolerance(tolerance)
                .until(10.0 * period)
                .event("turn", Crossing::Falling, |state| state.v[0])
                .event("bottom", Crossing::Any, |state| state.q[0])
                .run(pendulum.start())
                .unwrap();
            let turns = run.events().iter().filter(|event| event.name == "turn");
            let bottoms = run.events().iter().filter(|event| event.name == "bottom");
            // At the end the rate is 0 again, and rounding decides its sign:
            // there are nine or ten events.
            assert!([9, 10].contains(&turns.clone().count()));
            assert_eq!(bottoms.clone().count(), 20);
            // An error of the state becomes an error of time when divided by the acceleration or
            // the rate. At 3 rad, near the upper position, the acceleration is a seventh of the
            // greatest and the period depends on the energy as strongly.
            let growth = if amplitude > 2.0 { 100.0 } else { 10.0 };
            let limit = limit(&run, tolerance, growth);
            for (i, turn) in turns.enumerate() {
                let exact = (i + 1) as f64 * period;
                assert!(
                    (turn.state.t - exact).abs() <= limit,
                    "{amplitude} {tolerance}"
                );
            }
            for (i, bottom) in bottoms.enumerate() {
                let exact = (0.25 + 0.5 * i as f64) * period;
                assert!(
                    (bottom.state.t - exact).abs() <= limit,
                    "{amplitude} {tolerance}"
                );
            }
        }
    }
}

#[test]
fn a_planet_moves_as_kepler_said() {
    // Semi-major axis and gravitational parameter 1, eccentricity 0.6, started at the perihelion.
    // The state at t = 1 is from Kepler's equation in 40 digits.
    let planet = Toy::new(([0.4, 0.0], [0.0, 2.0]), |_, q, _, _, _| {
        let r = q[0].hypot(q[1]);
        [-q[0] / r.powi(3), -q[1] / r.powi(3)]
    });
    let exact = [
        -0.6289481768266242305829,
        0.7996647309700392665995,
        -0.9825156909388113276878,
        -0.02276317009743041991973,
    ];
    for method in &METHODS {
        for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
            let run = Simulation::new(&planet)
                .method(method)
                .tolerance(tolerance)
                .until(1.0)
                .run(planet.start())
                .unwrap();
            let State { q, v, .. } = *run.end();
            let error = error(&[q[0], q[1], v[0], v[1]], &exact);
            // The speed at the perihelion relative to that at the end is the
            // largest amplification of a change.
            assert!(
                error <= limit(&run, tolerance, 10.0),
                "{} {error:e}",
                method.tableau.name
            );
        }
    }
}

/// The classic double pendulum: unit masses and lengths, g = 9.81, released at rest.
fn double_pendulum(
    theta: [f64; 2],
    until: f64,
    tolerance: f64,
) -> (Solution<DoublePendulum>, [f64; 4]) {
    let machine = DoublePendulum::default();
    let [theta1, theta2] = theta;
    let start = State {
        t: 0.0,
        q: DoublePendulumCoordinates { theta1, theta2 },
        v: DoublePendulumCoordinates {
            theta1: 0.0,
            theta2: 0.0,
        },
    };
    let run = Simulation::new(&machine)
        .tolerance(tolerance)
        .until(until)
        .run(start)
        .unwrap();
    let State { q, v, .. } = *run.end();
    (run, [q.theta1, q.theta2, v.theta1, v.theta2])
}

// Started at 120° and 90°; computed by Gragg–Bulirsch–Stoer extrapolation in
// binary128, checked to 1e-22.
const WILD_AT_1: [f64; 4] = [
    -4.191579968532890830682e-01,
    -1.024023228436775534500e+00,
    -3.647461296247174795428e+00,
    -3.932075324538541757873e+00,
];
const WILD_AT_5: [f64; 4] = [
    -2.090829080630254793237e+00,
    -1.567325676426099778229e+00,
    2.618558622653093941465e-01,
    9.523402415976607507389e-02,
];

#[test]
fn a_regular_double_pendulum_is_right_after_100_seconds() {
    for tolerance in [
        1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14,
    ] {
        let (run, end) = double_pendulum([0.3, 0.5], 100.0, tolerance);
        let error = error(&end, &REGULAR_AT_100);
        // The motion is quasiperiodic, so a change of its frequencies grows linearly with time:
        // over 100 s at 4.4 rad/s by 440 at most, and by that only for the first steps.
        assert!(
            error <= limit(&run, tolerance, 10.0),
            "{tolerance}: {error:e}"
        );
    }
}

#[test]
fn a_double_pendulum_gives_up_digits_at_roundoff_only() {
    // At the finest tolerance that is allowed, 12 digits are left after 100 s.
    let (_, end) = double_pendulum([0.3, 0.5], 100.0, 2.3e-15);
    assert!(error(&end, &REGULAR_AT_100) < 1e-12);
}

#[test]
fn a_chaotic_double_pendulum_is_right_after_10_seconds() {
    for tolerance in [1e-11, 1e-12, 1e-13, 1e-14] {
        let (run, end) = double_pendulum([2.0, 2.5], 10.0, tolerance);
        // Over the whole run the motion amplifies changes by 10⁹; on average, a step has half of the time left.
        let error = error(&end, &CHAOTIC_AT_10);
        assert!(
            error <= limit(&run, tolerance, 1e9).min(1e-2),
            "{tolerance}: {error:e}"
        );
    }
}

#[test]
fn a_wild_double_pendulum_is_right_on_its_way() {
    for (until, exact, growth) in [(1.0, WILD_AT_1, 1e2), (5.0, WILD_AT_5, 1e5)] {
        let (run, end) = double_pendulum([2.0 * PI / 3.0, FRAC_PI_2], until, 1e-13);
        let error = error(&end, &exact);
        assert!(error <= limit(&run, 1e-13, growth), "{until}: {error:e}");
    }
}

#[test]
fn a_run_backward_returns_to_its_start() {
    for method in &METHODS {
        let machine = DoublePendulum::default();
        let there = Simulation::new(&machine)
            .method(method)
            .tolerance(1e-9)
            .until(3.0)
            .run(machine.start())
            .unwrap();
        let back = Simulation::new(&machine)
            .method(method)
            .tolerance(1e-9)
            .until(0.0)
            .run(*there.end())
            .unwrap();
        assert_eq!(back.end().t, 0.0);
        let (start, end) = (machine.start(), back.end());
        let error = (end.q.theta1 - start.q.theta1).abs() + (end.q.theta2 - start.q.theta2).abs();
        assert!(
            error <= 2.0 * limit(&back, 1e-9, 10.0),
            "{}: {error:e}",
            method.tableau.name
        );
        // At the same instant, both runs show the same motion.
        let (one, other) = (there.at(1.7).unwrap(), back.at(1.7).unwrap());
        let apart = (one.q.theta2 - other.q.theta2).abs();
        assert!(
            apart <= 2.0 * limit(&back, 1e-9, 10.0),
            "{}: {apart:e}",
            method.tableau.name
        );
        // Samples and steps are in the order of the run.
        assert!(
            back.steps()
                .zip(back.steps().skip(1))
                .all(|(one, next)| next.t < one.t)
        );
        assert_eq!(back.every(0.5).unwrap().len(), 7);
    }
}

#[test]
fn time_and_state_lose_nothing_to_many_small_steps() {
    // A hundred thousand steps at constant speed: plain summation of the steps would err by 1e-12.
    let free = Toy::new(([0.0], [1.0]), |_, _, _, _, _| [0.0]);
    let run = Simulation::new(&free)
        .first_step(1e-5)
        .longest_step(1e-5)
        .forget_steps()
        .until(1.0)
        .run(free.start())
        .unwrap();
    assert!(run.statistics().steps >= 99_000);
    assert!((run.end().q[0] - 1.0).abs() <= f64::EPSILON);
}
