//! Very long runs, lengths and masses that differ by many orders of magnitude, folded chains, and runs back to their start.
//!
//! What takes minutes is ignored by default; `cargo test --workspace --test machines long_runs -- --include-ignored --nocapture` runs it and prints what
//! `docs/benchmarks.md` states.

use std::f64::consts::{PI, TAU};

use crate::support::limits::conserves;
use crate::support::sampling::accurate;
use crate::support::states::{energy, numbers, state};
use crate::support::{library, library::machine};
use lagrangian::{METHODS, Machine, Method, RADAU_OF_HIGH_ORDER, Simulation, Stepper, TAYLOR};
use lagrangian_machines::*;

// A million revolutions.

/// Cosine and sine of `ω t`, whose rounding error is added afterwards: 1e6 turns are 6e6 rad, which `f64` rounds to 1e-9.
fn phase(omega: f64, t: f64) -> [f64; 2] {
    let angle = omega * t;
    let low = omega.mul_add(t, -angle);
    let (sin, cos) = angle.sin_cos();
    [cos - low * sin, sin + low * cos]
}

/// Runs the crusher with two debalances for so many of their revolutions and compares it with its closed form, once its free oscillation has died down:
/// `M x″ + B x′ + K x = F cos ωt`. Mortar and pestle stay where they are in space, which no spring enforces.
fn revolve(turns: f64, tolerance: f64) {
    let crusher = TwoDebalanceCrusher::default();
    let TwoDebalanceCrusher {
        m,
        m0,
        e,
        bx,
        cx,
        omega,
        ..
    } = crusher;
    let (mass, damping, stiffness) = (m + 2.0 * m0, 2.0 * bx, 2.0 * cx);
    let force = 2.0 * m0 * e * omega * omega;
    let until = turns * TAU / omega;
    let run = Simulation::new(&crusher)
        .method(Method::DOP853)
        .tolerance(tolerance)
        .max_steps(1_000_000_000)
        .forget_steps()
        .until(until)
        .run(crusher.start())
        .expect("it shakes");
    let [cos, sin] = phase(omega, run.end().t);
    let (detuned, lossy) = (stiffness - mass * omega * omega, damping * omega);
    let amplitude = force / (detuned * detuned + lossy * lossy);
    let exact = amplitude * (detuned * cos + lossy * sin);
    let exact_rate = amplitude * omega * (lossy * cos - detuned * sin);
    let error = f64::max(
        (run.end().q.x - exact).abs(),
        (run.end().v.x - exact_rate).abs() / omega,
    );
    let steps = run.statistics().steps as f64;
    // Each step errs by the tolerance of a rate, relative to 1 + |x′|, and errors decay as e^(−δ t): those of the last 1/δ seconds remain.
    let decay = damping / (2.0 * mass);
    let limit = tolerance * (steps / until / decay) * (1.0 + exact_rate.abs()) / omega
        + tolerance * (steps / until / decay);
    let start = crusher.start().q.s1;
    let drift = (run.end().q.s1 + run.end().q.x - start).abs();
    println!(
        "{turns:e} revolutions, {until:.0} s at {tolerance:e}: {steps} steps, {} evaluations, {:.1} s, error {error:.1e} m, limit {limit:.1e} m; mortar moved by {drift:.1e} m",
        run.statistics().evaluations,
        run.statistics().seconds
    );
    assert!(error <= limit, "{error:e} {limit:e}");
    assert!(
        limit < 1e-3 * amplitude * detuned.abs(),
        "{limit:e} says nothing"
    );
    // The accelerations of mortar and platform cancel to rounding, and a step rounds each rate once: a random walk of the rate relative to the ground, which
    // moves the mortar for the rest of the run.
    let walk = f64::EPSILON
        * (1.0 + exact_rate.abs().max(amplitude * detuned.abs() * omega))
        * steps.sqrt()
        * until;
    assert!(drift <= walk, "{drift:e} {walk:e}");
    assert_eq!(run.end().q.theta1, 0.0);
}

#[test]
fn a_crusher_is_right_after_ten_thousand_revolutions() {
    revolve(1e4, 1e-10);
}

#[test]
#[ignore = "a million revolutions take a quarter of an hour"]
fn a_crusher_is_right_after_a_million_revolutions() {
    revolve(1e6, 1e-8);
}

// The energy of conservative machines.

/// Ten double pendulums near 0.5 rad, in which both modes swing.
fn pendulums() -> [[f64; 2]; 10] {
    std::array::from_fn(|i| [0.5 - 0.01 * i as f64, 0.5 + 0.013 * i as f64])
}

/// The root mean square, over ten starts, of the relative errors of the energy at some times.
fn errors_of_energy(method: &'static Method, setting: f64, times: &[f64]) -> Vec<f64> {
    let machine = DoublePendulum::default();
    let system = machine.prepare();
    let mut squares = vec![0.0; times.len()];
    for start in pendulums() {
        let start = state(&machine, 0.0, &start, &[0.0; 2]);
        let builder = Stepper::builder(machine.prepare()).method(method);
        let builder = if method.has_fixed_steps() {
            builder.longest_step(setting)
        } else {
            builder.tolerance(setting)
        };
        let mut stepper = builder
            .max_steps(1_000_000_000)
            .start(start)
            .expect("it has accelerations");
        let at_start = energy(&system, 0.0, &[*stepper.q(), *stepper.v()].concat());
        for (square, t) in squares.iter_mut().zip(times) {
            stepper.advance_to(*t).expect("it swings");
            let now = energy(&system, *t, &[*stepper.q(), *stepper.v()].concat());
            *square += ((now - at_start) / at_start).powi(2) / 10.0;
        }
    }
    squares.into_iter().map(f64::sqrt).collect()
}

/// Truncation errors of series at the limit of rounding are below rounding, and rounding errors have no preferred sign: the energy takes a random walk,
/// of less than one unit in the last place for each step on average over ten pendulums.
#[test]
fn the_energy_of_series_takes_a_random_walk() {
    let times = [250.0, 4000.0];
    let errors = errors_of_energy(&TAYLOR, 1e-15, &times);
    for (error, t) in errors.iter().zip(times) {
        println!("energy error of taylor at 1e-15: {error:.1e} at {t} s");
        // Steps of 70 ms.
        let walk = f64::EPSILON * f64::sqrt(t / 0.07);
        assert!(*error <= walk, "{error:e}, {walk:e} at {t} s");
    }
    // It grows with the square root of the time, 4 times, and not with the time, 16 times. The root mean square of ten has a standard error of
    // 1/√20, and the quotient of two one of √2 times that: three of these are allowed.
    let growth = errors[1] / errors[0];
    let limit = 4.0 * (1.0 + 3.0 * f64::sqrt(2.0 / 20.0));
    assert!(growth < limit, "{growth}");
}

/// The energy of symplectic methods oscillates and does not drift, however long the run.
#[test]
fn the_energy_of_symplectic_methods_stays_bounded() {
    for (name, h) in [("gauss8", 0.2), ("rattle", 0.05)] {
        let method = Method::named(name).expect("a method");
        let times: Vec<f64> = (1..=20).map(|i| 50.0 * f64::from(i)).collect();
        let errors = errors_of_energy(method, h, &times);
        let greatest = |part: &[f64]| part.iter().copied().fold(0.0, f64::max);
        let (early, late) = (greatest(&errors[..10]), greatest(&errors[10..]));
        println!("energy error of {name}: {early:.1e}, then {late:.1e}");
        // Instants of an oscillation: the greatest of ten root mean squares scatters by less than that of one.
        assert!(late <= 1.25 * early, "{name}: {early:e} {late:e}");
    }
}

// Lengths over twelve orders of magnitude.

#[test]
fn double_pendulums_of_very_unequal_lengths_accelerate_exactly() {
    let program = library::program("double_pendulum", &[]);
    for (l1, l2) in [(1e-6, 1e6), (1e6, 1e-6), (1e-12, 1.0), (1.0, 1e-12)] {
        let pendulum = DoublePendulum {
            l1,
            l2,
            ..Default::default()
        };
        accurate(&pendulum, &program, 100, |_| ());
    }
}

/// A rod of 1e-6 m that carries one of 1e6 m: meanwhile the lower bob moves only up and down, so that
/// `½ l₁ θ₁′² (m₁ + m₂ sin² θ₁) − (m₁ + m₂) g cos θ₁` is constant to 1e-12, the ratio of the lengths. The energy itself, of 1e7 J, would show nothing of it.
#[test]
fn a_short_rod_above_a_long_one_swings_as_if_the_long_one_stood() {
    let pendulum = DoublePendulum {
        l1: 1e-6,
        l2: 1e6,
        ..Default::default()
    };
    let DoublePendulum { m1, m2, l1, g, .. } = pendulum;
    let start = state(&pendulum, 0.0, &[0.7, 0.0], &[0.0; 2]);
    // Twenty oscillations of about √(g (m₁ + m₂)/(m₁ l₁)) = 4400 rad/s.
    conserves(&pendulum, start, (0.03, 1e-11), |_, _, y| {
        let (sin, cos) = y[0].sin_cos();
        0.5 * l1 * y[2] * y[2] * (m1 + m2 * sin * sin) - (m1 + m2) * g * cos
    });
}

/// A rod of 1e-6 m below one of 1e6 m: the upper bob moves only sideways, without a force along its path, so that
/// `½ l₂ θ₂′² (m₂ sin² θ₂ + μ cos² θ₂) − m₂ g cos θ₂` is constant to 1e-12, with `μ = m₁ m₂/(m₁ + m₂)`.
#[test]
fn a_short_rod_below_a_long_one_swings_as_on_a_rail() {
    let pendulum = DoublePendulum {
        l1: 1e6,
        l2: 1e-6,
        ..Default::default()
    };
    let DoublePendulum { m1, m2, l2, g, .. } = pendulum;
    let start = state(&pendulum, 0.0, &[0.0, 0.7], &[0.0; 2]);
    let reduced = m1 * m2 / (m1 + m2);
    conserves(&pendulum, start, (0.03, 1e-11), |_, _, y| {
        let (sin, cos) = y[1].sin_cos();
        0.5 * l2 * y[3] * y[3] * (m2 * sin * sin + reduced * cos * cos) - m2 * g * cos
    });
}

// Folded chains.

/// A chain whose links lie upon each other, exactly or nearly so. Their masses are far from the hinge, but the links are free to turn, so M is regular.
#[test]
fn folded_chains_accelerate_exactly_and_keep_their_energy() {
    let program = library::program("chain", &[]);
    let chain = Chain::default();
    let fold = |i: usize, by: f64| by + if i.is_multiple_of(2) { 0.0 } else { PI };
    for near in [0.0, 1e-12, 1e-6] {
        accurate(&chain, &program, 50, |at| {
            for (i, q) in at.q.iter_mut().enumerate() {
                *q = fold(i, near * i as f64);
            }
        });
        let q: [f64; 8] = std::array::from_fn(|i| fold(i, 1e-3 + near * i as f64));
        let start = state(&chain, 0.0, &q, &[0.0; 8]);
        conserves(&chain, start, (1.0, 1e-11), energy);
    }
}

/// Relative angles of half a turn: the same folds in other coordinates.
#[test]
fn folded_chains_in_relative_angles_keep_their_energy() {
    let text = "machine Folded extends \"chain_relative.machine\" { constants { N = 4 } }";
    let chain = machine(text);
    let q = [1e-3, PI, -PI, PI + 1e-9];
    let start = state(&chain, 0.0, &q, &[0.0; 4]);
    conserves(&chain, start, (1.0, 1e-11), energy);
}

// Forward and back.

/// Runs forward and back. The way back begins at the end of the way there, so that its distance from the start is the sum of both errors, the second as the
/// motion back carries it; each is a hundredth of the error of a run at a hundred times the tolerance, which is the distance of its end from the accurate one.
fn returns<M: Machine>(machine: &M, method: &'static Method, tolerance: f64, until: f64) {
    let simulation = |tolerance: f64| {
        Simulation::new(machine)
            .method(method)
            .tolerance(tolerance)
            .forget_steps()
    };
    let run = |tolerance: f64, until: f64, start| {
        let run = simulation(tolerance).until(until).run(start);
        run.unwrap_or_else(|error| panic!("{}: {error}", method.tableau.name))
    };
    let there = run(tolerance, until, machine.start());
    let coarse = run(100.0 * tolerance, until, machine.start());
    let back = run(tolerance, 0.0, there.end().clone());
    let system = machine.prepare();
    let distance = |a: Vec<f64>, b: Vec<f64>| {
        let pairs = a.into_iter().zip(b);
        pairs.fold(0.0, |most, (a, b)| {
            f64::max(most, (a - b).abs() / (1.0 + b.abs()))
        })
    };
    let limit = distance(
        numbers(&system, there.end()),
        numbers(&system, coarse.end()),
    );
    let away = distance(
        numbers(&system, back.end()),
        numbers(&system, there.start()),
    );
    let (name, method) = (machine.name(), method.tableau.name);
    println!("{name}, {method}: {away:.1e} from the start, limit {limit:.1e}");
    assert!(away <= limit, "{name}, {method}: {away:e}, {limit:e}");
    assert!(limit < 1e-3, "{name}, {method}: {limit:e} says nothing");
}

#[test]
fn runs_of_every_method_come_back_to_their_start() {
    let high = RADAU_OF_HIGH_ORDER.iter().map(|method| (method, 1e-11));
    let methods = METHODS.iter().map(|method| match method.tableau.order {
        3 => (method, 1e-8),
        _ => (method, 1e-10),
    });
    for (method, tolerance) in methods.chain(high) {
        returns(&DoublePendulum::default(), method, tolerance, 2.0);
        returns(&FourBar::default(), method, tolerance, 1.0);
        returns(&SphericalPendulum::default(), method, tolerance, 2.0);
    }
    // Both tolerances are below 5e-9: from there on a step by series errs by a tenth of its tolerance.
    returns(&DoublePendulum::default(), &TAYLOR, 1e-12, 2.0);
    returns(&Crusher9::default(), &TAYLOR, 1e-11, 0.5);
    returns(&Crusher9::default(), Method::DOP853, 1e-10, 0.5);
}

// The same bits, however a run is watched.

/// Samples, stored steps and the energy balance read the motion and have no part in it.
#[test]
fn a_run_has_the_same_bits_however_it_is_watched() {
    fn check<M: Machine>(machine: &M, method: &'static Method) {
        let simulation = || {
            let simulation = Simulation::new(machine).method(method);
            simulation.tolerance(1e-9).until(2.0)
        };
        let bits = |simulation: Simulation<'_, M>| {
            let run = simulation.run(machine.start()).expect("it runs");
            let end = numbers(run.system(), run.end());
            end.into_iter().map(f64::to_bits).collect::<Vec<_>>()
        };
        let plain = bits(simulation());
        let watched = [
            simulation().every(0.013),
            simulation().energy_balance(true),
            simulation().forget_steps(),
            simulation().every(0.25).energy_balance(true).forget_steps(),
        ];
        for watched in watched {
            assert_eq!(bits(watched), plain, "{}", method.tableau.name);
        }
    }
    for method in [Method::DOP853, Method::RADAU5] {
        check(&DoublePendulum::default(), method);
        check(&FourBar::default(), method);
        check(&Crusher9::default(), method);
    }
    check(&DoublePendulum::default(), &TAYLOR);
    check(&Crusher9::default(), &TAYLOR);
}
