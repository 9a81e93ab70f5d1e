//! Runs by Taylor series are as accurate as closed forms and high-precision references show, with dense output and events as accurate as the steps.
#![expect(
    clippy::excessive_precision,
    reason = "references with all their digits"
)]

use std::f64::consts::PI;

use crate::support::known_ends::{
    CRUSHER_AT_5, CRUSHER_RANGES, CRUSHER_RATES, REGULAR_AT_100, REGULAR_START,
};
use crate::support::library;
use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{
    Crossing, Ending, Error, Machine, Method, Simulation, Solution, State, System, TAYLOR,
};
use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::series::ProvedSeries;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Sources};
use lagrangian_symbolic::Dag;

/// Compiles a text to a machine with series.
fn machine(text: &str) -> InterpretedMachine {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let path = library::path("test");
    let (sources, files) = (&mut sources, &mut Disk);
    let model = lagrangian_spec::model(&dag, &path, text, &[], files, sources, &mut report);
    match model.and_then(|model| Compiled::new(model, &mut report)) {
        Some(compiled) => InterpretedMachine::new(compiled.program.clone())
            .with_series(ProvedSeries::derive(&compiled.model)),
        None => panic!("{}", report.render_short(sources)),
    }
}

fn of_library(name: &str) -> InterpretedMachine {
    machine(&library::text(name))
}

/// The start of a machine with the given coordinates and rates.
fn start(
    machine: &InterpretedMachine,
    q: &[f64],
    v: &[f64],
) -> State<lagrangian::interpreted::Named> {
    let mut start = machine.start();
    start.q.values.copy_from_slice(q);
    start.v.values.copy_from_slice(v);
    start
}

/// The largest error of the end state, relative to a scale plus the size of each number.
fn error(run: &Solution<InterpretedMachine>, exact: &[f64], scales: &[f64]) -> f64 {
    let end = run.end();
    let found = end.q.values.iter().chain(&end.v.values);
    let errors = found.zip(exact).zip(scales);
    errors
        .map(|((y, exact), scale)| (y - exact).abs() / (scale + exact.abs()))
        .fold(0.0, f64::max)
}

/// An oscillator with ω = 3 rad/s: x = cos 3t.
fn oscillator(more: &str) -> InterpretedMachine {
    machine(&format!(
        "machine Oscillator in plane {{
            parameters {{ m: kg = 1, k: N/m = 9, half: m = 0.5 }}
            coordinates {{ x: m = 1 }}
            bodies {{ block {{ mass: m, at: (x, 0) }} }}
            springs {{ spring {{ stiffness: k, stretch: x }} }}
            {more}
        }}"
    ))
}

/// References in binary128, by extrapolation (`benches/time_against_error.rs`). The error of such a run is meant to be at most ten tolerances; at the finest
/// one the rounding of the state decides.
#[test]
fn a_double_pendulum_ends_where_binary128_says() {
    let machine = of_library("double_pendulum");
    for (tolerance, most) in [
        (1e-4, 1e-3),
        (1e-6, 1e-5),
        (1e-7, 1e-6),
        (1e-8, 1e-7),
        (1e-10, 1e-9),
        (1e-12, 1e-11),
        (1e-14, 1e-13),
        (1e-15, 2e-14),
    ] {
        let run = Simulation::new(&machine)
            .method(&TAYLOR)
            .tolerance(tolerance)
            .until(100.0)
            .run(start(&machine, &REGULAR_START, &[0.0; 2]))
            .unwrap();
        let error = error(&run, &REGULAR_AT_100, &[1.0; 4]);
        println!("{tolerance:e}: {error:e}, {:?}", run.statistics());
        assert!(error < most, "{tolerance:e}: {error:e}");
        assert!(run.statistics().steps < 2000 && run.statistics().rejected == 0);
    }
}

#[test]
fn a_crusher_ends_where_binary128_says() {
    let machine = of_library("crusher9");
    for (tolerance, most) in [
        (1e-6, 1e-5),
        (1e-8, 1e-7),
        (1e-9, 1e-8),
        (1e-12, 1e-11),
        (1e-15, 1e-13),
    ] {
        let from = start(&machine, &machine.start().q.values, &CRUSHER_RATES);
        let run = Simulation::new(&machine)
            .method(&TAYLOR)
            .tolerance(tolerance)
            .until(5.0)
            .run(from)
            .unwrap();
        let error = error(&run, &CRUSHER_AT_5, &CRUSHER_RANGES);
        println!("{tolerance:e}: {error:e}, {:?}", run.statistics());
        assert!(error < most, "{tolerance:e}: {error:e}");
    }
}

/// The series of every machine that has one gives the accelerations of the proved program, within a step too: half a step from the start, the second
/// derivative of the polynomial is the acceleration there.
#[test]
fn within_a_step_the_polynomial_obeys_the_equations() {
    let mut count = 0;
    for name in [
        "chain",
        "crusher9",
        "dc_motor",
        "elastic_pendulum",
        "gyroscope_in_gimbals",
        "heavy_top",
        "kapitza_pendulum",
        "motor_crusher",
        "six_joint_arm",
        "spherical_pendulum",
        "two_body_orbit",
    ] {
        let machine = of_library(name);
        let system = machine.prepare();
        assert_eq!(system.check_series(), Ok(()), "{name}");
        let State { q, mut v, .. } = machine.start();
        let n = q.values.len();
        for (i, v) in v.values.iter_mut().enumerate() {
            *v += 0.1 + 0.05 * i as f64;
        }
        let inputs = system.default_inputs();
        let mut coefficients = vec![vec![0.0; n]; 26];
        let t = 0.25;
        system
            .series([t, 0.0], &q.values, &v.values, &inputs, &mut coefficients)
            .unwrap();
        // A step so short that the last coefficient is negligible.
        let last = coefficients[25]
            .iter()
            .fold(1e-300, |most: f64, c| most.max(c.abs()));
        let tau = 0.5 * (1e-13 / last).powf(1.0 / 25.0).min(0.1);
        let sum = |derivative: usize| -> Vec<f64> {
            let of = |i: usize| {
                (derivative..26).rev().fold(0.0, |sum, j| {
                    let factor: f64 = (0..derivative).map(|d| (j - d) as f64).product();
                    sum * tau + factor * coefficients[j][i]
                })
            };
            (0..n).map(of).collect()
        };
        let mut a = vec![0.0; n];
        system
            .accelerations(t + tau, &sum(0), &sum(1), &inputs, &mut a)
            .unwrap();
        let size = a.iter().fold(1.0, |most: f64, a| most.max(a.abs()));
        for (found, a) in sum(2).iter().zip(&a) {
            assert!((found - a).abs() < 1e-9 * size, "{name}: {found:e} {a:e}");
            count += 1;
        }
    }
    assert!(count > 40);
}

/// x = cos 3t at instants where no step ends. The end is the same to the last bit however often the motion is sampled.
#[test]
fn dense_output_is_as_exact_as_the_steps() {
    let machine = oscillator("");
    let simulation = || {
        Simulation::new(&machine)
            .method(&TAYLOR)
            .tolerance(1e-13)
            .until(10.0)
    };
    let run = simulation().run(machine.start()).unwrap();
    assert!(run.statistics().steps < 40, "{:?}", run.statistics());
    for i in 0..=1000 {
        let t = f64::from(i) / 100.0;
        let state = run.at(t).unwrap();
        assert!((state.q.values[0] - (3.0 * t).cos()).abs() < 1e-12, "{t}");
        assert!(
            (state.v.values[0] + 3.0 * (3.0 * t).sin()).abs() < 3e-12,
            "{t}"
        );
    }
    let sampled = simulation().every(0.001).run(machine.start()).unwrap();
    assert_eq!(sampled.end(), run.end());
    assert_eq!(sampled.statistics().steps, run.statistics().steps);
    assert_eq!(sampled.samples().len(), 10_001);
}

/// cos 3t = 0.9999 twice near each maximum, 0.0094 s apart in steps of half a second: each crossing is found once, at the right time.
#[test]
fn no_event_within_a_long_step_is_missed() {
    let machine = oscillator("");
    let level = 0.9999;
    let run = Simulation::new(&machine)
        .method(&TAYLOR)
        .tolerance(1e-13)
        .until(20.0)
        .event("near the top", Crossing::Any, move |state| {
            state.q.values[0] - level
        })
        .event("touch", Crossing::Any, |state| state.q.values[0] - 1.1)
        .run(machine.start())
        .unwrap();
    assert!(run.statistics().steps < 80);
    let near = level.acos() / 3.0;
    let mut exact = vec![near];
    for turn in 1..=9 {
        let top = 2.0 * PI * f64::from(turn) / 3.0;
        exact.extend([top - near, top + near]);
    }
    exact.retain(|t| *t < 20.0);
    let found: Vec<f64> = run.events().iter().map(|event| event.state.t).collect();
    assert_eq!(found.len(), exact.len(), "{found:?}");
    for (found, exact) in found.iter().zip(&exact) {
        // The slope there is 3 sin 3t = 0.042/s.
        assert!(
            (found - exact).abs() < 1e-13 * 20.0 / 0.042,
            "{found} {exact}"
        );
    }
}

/// A run ends at an event, and the next run continues without finding it again.
#[test]
fn a_run_ends_at_an_event_and_goes_on() {
    let machine = oscillator("");
    let simulation = |until: f64| {
        Simulation::new(&machine)
            .method(&TAYLOR)
            .tolerance(1e-13)
            .until(until)
            .until_event("zero", Crossing::Any, |state| state.q.values[0])
    };
    let mut from = machine.start();
    for quarter in 0..5 {
        let run = simulation(100.0).run(from.clone()).unwrap();
        assert_eq!(*run.ending(), Ending::Event("zero".into()));
        let exact = (f64::from(quarter) + 0.5) * PI / 3.0;
        let found = run.end().t;
        assert!((found - exact).abs() < 1e-12, "{found} {exact}");
        assert!(run.end().q.values[0].abs() < 1e-15);
        from = run.end().clone();
    }
}

/// x = cos 3t is beyond −1 + ε for a small part of a step at each turning point, and never beyond −1 − ε. Tested with Taylor series, whose steps
/// contain several turning points, and with the quintic interpolants of Gauss methods, whose error is (3h)⁶/46 080.
#[test]
fn turning_points_that_hardly_pass_a_level_are_all_seen() {
    let gauss = |name| Method::named(name).unwrap();
    for (method, excess) in [
        (&TAYLOR, 1e-9),
        (gauss("gauss6"), 1e-5),
        (gauss("gauss8"), 1e-5),
    ] {
        for until in [10.0, -10.0] {
            let machine = oscillator("");
            let run = Simulation::new(&machine)
                .method(method)
                .tolerance(1e-13)
                .longest_step(if method.has_fixed_steps() { 0.1 } else { 10.0 })
                .until(until)
                .event("below", Crossing::Any, move |state| {
                    state.q.values[0] + 1.0 - excess
                })
                .event("above", Crossing::Any, move |state| {
                    state.q.values[0] + 1.0 + excess
                })
                .run(machine.start())
                .unwrap();
            let name = method.tableau.name;
            let beside = (1.0 - excess).acos();
            assert_eq!(run.events().len(), 10, "{name}");
            for (k, event) in run.events().iter().enumerate() {
                let turn = PI * (2 * (k / 2) + 1) as f64;
                let at = [turn - beside, turn + beside][k % 2] / 3.0 * until.signum();
                let late = event.state.t - at;
                assert!(late.abs() < 0.1 * beside / 3.0, "{name}: {late:e}");
                let crossings = [Crossing::Falling, Crossing::Rising];
                let crossing = crossings[(k + usize::from(until < 0.0)) % 2];
                assert_eq!((&*event.name, event.crossing), ("below", crossing));
            }
        }
    }
}

/// A run forward and back again follows the same motion.
#[test]
fn a_run_goes_backward() {
    let machine = of_library("double_pendulum");
    let from = start(&machine, &[0.3, 0.5], &[0.1, -0.2]);
    let simulation = |until: f64| {
        let simulation = Simulation::new(&machine).method(&TAYLOR).tolerance(1e-14);
        simulation.until(until)
    };
    let there = simulation(20.0).run(from.clone()).unwrap();
    let back = simulation(0.0).run(there.end().clone()).unwrap();
    let exact: Vec<f64> = from
        .q
        .values
        .iter()
        .chain(&from.v.values)
        .copied()
        .collect();
    let error = error(&back, &exact, &[1.0; 4]);
    assert!(error < 1e-12, "{error:e}");
    let (half, again) = (there.at(10.0).unwrap(), back.at(10.0).unwrap());
    for (a, b) in half.q.values.iter().zip(&again.q.values) {
        assert!((a - b).abs() < 1e-12);
    }
}

/// A motion of 2e-6 rad/s takes steps of days: an error of the rates that is small beside the coordinates grows with them. Coordinates are 10⁶ times
/// their rates, and at the second start both are smaller than what the tolerance allows of a rate in such a step.
#[test]
fn a_slow_motion_is_as_exact_as_a_fast_one() {
    let machine = machine(
        "machine Slow in plane {
            parameters { m: kg = 1e9, k: N/m = 4e-3 }
            coordinates { x: m }
            bodies { block { mass: m, at: (x, 0) } }
            springs { spring { stiffness: k, stretch: x } }
        }",
    );
    let (omega, until, tolerance) = (2e-6_f64, 3e6, 1e-9);
    for size in [1e6, 1e-3] {
        let from = start(&machine, &[size], &[0.5 * omega * size]);
        let simulation = Simulation::new(&machine).method(&TAYLOR).until(until);
        let run = simulation.tolerance(tolerance).run(from).unwrap();
        let angle = omega * until;
        let exact = size * (angle.cos() + 0.5 * angle.sin());
        // Two terms in each step, of a coordinate whose size within the step is counted as up to three times the greatest.
        let limit = run.statistics().steps as f64 * 2.0 * tolerance * (1.0 + 3.0 * size);
        let error = (run.end().q.values[0] - exact).abs();
        assert!(error < limit, "{size:e}: {error:e} > {limit:e}");
    }
}

/// After a hundred thousand turns a pendulum that whirls conserves its energy as well as at the start: its angle is large, but its rate is not.
#[test]
fn a_pendulum_whirls_as_exactly_after_many_turns() {
    let machine = machine(
        "machine Whirling in plane {
            parameters { m: kg = 1, l: m = 1, g: m/s^2 = 9.81 }
            coordinates { phi: rad }
            bodies { bob { mass: m, at: polar(l, phi - pi/2) } }
            gravity (0, -g);
        }",
    );
    let tolerance = 1e-9;
    for turns in [0.0, 1e5] {
        let from = start(&machine, &[2.0 * PI * turns + 0.5], &[7.0]);
        let simulation = Simulation::new(&machine).method(&TAYLOR).until(20.0);
        let run = simulation.tolerance(tolerance).run(from).unwrap();
        let energy = |phi: f64, rate: f64| 0.5 * rate * rate - 9.81 * phi.cos();
        let (end, steps) = (run.end(), run.statistics().steps as f64);
        let error = (energy(end.q.values[0], end.v.values[0]) - energy(0.5, 7.0)).abs();
        // The rate is at most 7.4 rad/s. Two terms in each step.
        let limit = steps * 2.0 * tolerance * (1.0 + 7.4) * (7.4 + 9.81);
        assert!(error < limit, "{turns}: {error:e} > {limit:e}");
    }
}

/// The assumption x > −0.5 fails at cos 3t = −0.5, within a step.
#[test]
fn a_run_ends_where_an_assumption_ends() {
    let machine = oscillator("assume { x + half > 0 }");
    let run = Simulation::new(&machine)
        .method(&TAYLOR)
        .tolerance(1e-13)
        .until(10.0)
        .run_as_far_as_possible(machine.start())
        .unwrap();
    let (run, error) = run;
    assert!(
        matches!(error, Some(Error::AssumptionEnded { .. })),
        "{error:?}"
    );
    let exact = 2.0 * PI / 9.0;
    assert!((run.end().t - exact).abs() < 1e-12, "{}", run.end().t);
}

/// Assumptions that fail for only a small part of a step, at cos 3t = −cos 0.01: linear ones, which are checked on partial sums, and a nonlinear one.
/// Another assumption nearly fails at each turning point.
#[test]
fn an_assumption_that_ends_for_a_moment_ends_the_run() {
    let edge = 0.01_f64.cos();
    let facts = [
        (format!("x/half + {} > 0", 2.0 * edge), true, true),
        (format!("{edge} > -x/(2*half)"), true, true),
        (
            format!("(x/half)^3 + {} > 0", 8.0 * edge.powi(3)),
            false,
            true,
        ),
        ("x/half + 2.000000002 > 0".to_owned(), true, false),
    ];
    for (fact, is_linear, ends) in facts {
        let machine = oscillator(&format!("assume {{ {fact} }}"));
        let is_known = machine.prepare().has_linear_assumptions();
        assert_eq!(is_known, is_linear, "{fact}");
        let (run, error) = Simulation::new(&machine)
            .method(&TAYLOR)
            .tolerance(1e-13)
            .until(10.0)
            .run_as_far_as_possible(machine.start())
            .unwrap();
        assert_eq!(error.is_some(), ends, "{fact}: {error:?}");
        // The slope there is 0.03 m/s, so an error of 1e-13 m is one of 3e-12 s.
        let expected = if ends { (PI - 0.01) / 3.0 } else { 10.0 };
        assert!(
            (run.end().t - expected).abs() < 1e-10,
            "{fact}: {}",
            run.end().t
        );
    }
}

/// A closed-loop mechanism compared with the end of the benchmark's run, which others computed by Taylor's method with 64-bit mantissas; the
/// constraints hold to rounding throughout.
#[test]
fn a_four_bar_linkage_ends_where_64_bit_mantissas_say() {
    let machine = of_library("four_bar");
    let exact = &[
        127.706727238734034,
        0.264982342180569,
        2.223460105630880,
        8.956708571057673,
        -0.651087510065570,
        4.733833590786719,
    ];
    let run = Simulation::new(&machine)
        .method(&TAYLOR)
        .tolerance(1e-13)
        .until(10.0)
        .run(machine.start())
        .unwrap();
    let error = error(&run, exact, &[1.0; 6]);
    println!("{error:e} {:?}", run.statistics());
    assert!(error < 1e-10, "{error:e}");
    assert!(run.statistics().constraint_residual < 1e-13);
}

/// A pendulum in Cartesian coordinates moves as one in an angle.
#[test]
fn a_constraint_makes_a_pendulum() {
    let text = |coordinates: &str, at: &str, more: &str| {
        machine(&format!(
            "machine Pendulum in plane {{
                parameters {{ m: kg = 1, l: m = 1, g: m/s^2 = 9.81 }}
                coordinates {{ {coordinates} }}
                bodies {{ bob {{ mass: m, at: {at} }} }}
                gravity (0, -g);
                {more}
            }}"
        ))
    };
    let angle = text("theta: rad = 0.5", "l*(sin(theta), -cos(theta))", "");
    let (x, y) = (0.5_f64.sin(), -0.5_f64.cos());
    let free = text(
        &format!("x: m = {x}, y: m = {y}"),
        "(x, y)",
        "constraints { rod: x^2 + y^2 = l^2 }",
    );
    let end = |machine: &InterpretedMachine| {
        let run = Simulation::new(machine)
            .method(&TAYLOR)
            .tolerance(1e-13)
            .until(10.0);
        run.run(machine.start()).unwrap()
    };
    let (angle, free) = (end(&angle), end(&free));
    let theta = angle.end().q.values[0];
    let found = &free.end().q.values;
    assert!((found[0] - theta.sin()).abs() < 1e-11, "{found:?} {theta}");
    assert!((found[1] + theta.cos()).abs() < 1e-11, "{found:?} {theta}");
    assert!(free.statistics().constraint_residual < 1e-13);
    // Between the ends of steps as well.
    for i in 1..100 {
        let t = f64::from(i) / 10.0;
        let q = free.at(t).unwrap().q.values;
        assert!((q[0] * q[0] + q[1] * q[1] - 1.0).abs() < 1e-13, "{t}");
    }
}

/// Drives and dampers supply and remove energy; the balance closes to what tolerance and rounding explain.
#[test]
fn the_balance_of_energy_closes() {
    for name in [
        "crusher9",
        "motor_crusher",
        "kapitza_pendulum",
        "vibrating_crusher",
    ] {
        let machine = of_library(name);
        let run = Simulation::new(&machine)
            .method(&TAYLOR)
            .tolerance(1e-12)
            .until(2.0)
            .energy_balance(true)
            .run(machine.start())
            .unwrap();
        let balance = run.energy_balance().unwrap();
        assert!(run.warnings().is_empty(), "{name}: {:?}", run.warnings());
        assert!(balance.relative().abs() < 1e-10, "{name}: {balance:?}");
    }
}

/// A ball is thrown up in air, and its speed, the root of a square, passes zero where its series continues with the other sign. The closed form is that of
/// `cli/tests/command/precise.rs`, in mpmath with 50 digits.
#[test]
fn a_speed_passes_zero() {
    let machine = machine(
        "machine Ball in plane {
            parameters { m: kg = 0.125, g: m/s^2 = 9.75, area: m^2 = 0.015625, rho: kg/m^3 = 1 }
            coordinates { x: m, y: m, der(y): m/s = 20 }
            bodies { ball { mass: m, at: (x, y) } }
            gravity (0, -g);
            drag { air { at: ball.at, coefficient: 0.5, area: area, density: rho } }
        }",
    );
    let exact = [0.0, 3.713662147284138, 0.0, -11.81367562226057];
    for tolerance in [1e-4, 1e-6, 1e-9, 1e-12, 1e-14] {
        let run = Simulation::new(&machine)
            .method(&TAYLOR)
            .tolerance(tolerance)
            .until(3.0)
            .run(machine.start())
            .unwrap();
        // The step over the zero may have a defect of a thousand tolerances, for a rate of up to 20 m/s; the fall of 1.5 s follows.
        let error = error(&run, &exact, &[1.0; 4]);
        assert!(
            error < 1e3 * tolerance * 21.0 + 1e-13,
            "{tolerance:e}: {error:e}"
        );
        assert!(run.statistics().rejected > 0 && run.statistics().steps < 200);
    }
}

#[test]
fn what_has_no_series_is_told() {
    let machine = of_library("rolling_coin");
    let run = Simulation::new(&machine).method(&TAYLOR).until(1.0);
    let error = run.run(machine.start()).map(|_| ()).unwrap_err();
    let reason = "it has constraints of velocities".into();
    assert_eq!(error, Error::NoSeries { reason });
    assert!(error.to_string().contains("`dop853`"), "{error}");

    let machine = oscillator("inputs { push: N } forces { push { at: (x, 0), force: (push, 0) } }");
    let run = Simulation::new(&machine)
        .method(&TAYLOR)
        .until(1.0)
        .inputs(|t, _, _, u| u.values[0] = t);
    let error = run.run(machine.start()).map(|_| ()).unwrap_err();
    assert!(error.to_string().contains("inputs"), "{error}");
}
