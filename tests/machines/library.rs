//! The machines of the library move as the literature says, tested against closed forms, invariants and limiting cases.
//!
//! Their equations are compared with textbooks in `crates/mechanics/tests/mechanics/`.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::support::limits::{conserves, follows, holds, numbers_at};
use crate::support::random::SplitMix;
use crate::support::references::Row;
use crate::support::sampling::Random;
use crate::support::special::{agm, amplitude, elliptic_k, jacobi, kepler, mathieu_edges, mean};
use crate::support::states::{accelerations, energy, numbers, state, vector};
use lagrangian::methods::Method;
use lagrangian::{Crossing, Inputs, METHODS, Machine, Outputs, Simulation, Solution, System};
use lagrangian_machines::*;

/// The tolerance of runs that are compared with closed forms.
const FINE: f64 = 1e-11;

/// The greatest error limit that such a comparison may use: a hundred times the tolerance for a thousand steps and more.
const BOUND: f64 = 1e-5;

/// Runs a machine from a state and compares it with values at some times. All scales are 1.
fn held<M: Machine>(
    machine: &M,
    (q, v): (&[f64], &[f64]),
    rows: &[Row],
    view: impl Fn(&[f64]) -> Vec<f64>,
) {
    let scales = vec![1.0; rows[0].values.len()];
    let start = state(machine, 0.0, q, v);
    follows(machine, &start, FINE, (rows, &scales, BOUND), view);
}

/// Checks a motion with constant accelerations, for which every method is exact but for rounding.
///
/// Accelerations in which terms of size up to `size` cancel have an error of 16 rounding units of that. The limit is the motion's
/// error that follows, plus the rounding of each step.
fn steady<M: Machine, const N: usize>(
    machine: &M,
    (q, v): (&[f64], &[f64]),
    (until, size): (f64, f64),
    exact: impl Fn(f64) -> [f64; N],
) {
    let run = run(machine, (q, v), until);
    let steps = run.statistics().steps as f64;
    for t in [until / 3.0, until] {
        let found = numbers_at(&run, t);
        for (found, exact) in found.iter().zip(exact(t)) {
            let limit = 16.0 * f64::EPSILON * size * (t + t * t / 2.0)
                + 4.0 * steps * f64::EPSILON * (1.0 + exact.abs());
            let error = (found - exact).abs();
            assert!(
                error <= limit && limit < 1e-9,
                "{} at {t} s: error {error:e}, limit {limit:e}",
                machine.name()
            );
        }
    }
}

/// Rows of a closed form.
fn rows<const N: usize>(times: &[f64], exact: impl Fn(f64) -> [f64; N]) -> Vec<Row> {
    times.iter().map(|&t| Row::of(t, &exact(t))).collect()
}

/// The outputs of a machine, from coordinates and rates.
fn outputs<S: System>(system: &S, t: f64, y: &[f64]) -> S::Outputs {
    let (q, v) = y.split_at(y.len() / 2);
    let a = accelerations(system, t, q, v).expect("not singular");
    let [q, v, a] = [q, v, &a].map(|row| vector::<S>(row));
    system.outputs(t, &q, &v, &a, &system.default_inputs())
}

/// Runs a machine from a state and checks that a quantity of its outputs is conserved.
fn keeps<M: Machine>(
    machine: &M,
    (q, v): (&[f64], &[f64]),
    until: f64,
    quantity: impl Fn(&Outputs<M>) -> f64,
) {
    let start = state(machine, 0.0, q, v);
    conserves(machine, start, (until, 1e-12), |system, t, y| {
        quantity(&outputs(system, t, y))
    });
}

/// Checks that a motion keeps its energy.
fn keeps_energy<M: Machine>(machine: &M, (q, v): (&[f64], &[f64]), until: f64) {
    let start = state(machine, 0.0, q, v);
    conserves(machine, start, (until, 1e-12), energy);
}

/// Checks how the distance of a motion from its linearized form shrinks when the amplitude is halved, twice.
///
/// `distance` gives the distance relative to the amplitude. Its leading term is a power of the amplitude and the next one at most a
/// hundredth of that, so halving the amplitude divides the distance by 2 to that power, to within a tenth.
fn shrinks(power: i32, amplitude: f64, distance: impl Fn(f64) -> f64) {
    let distances = [amplitude, amplitude / 2.0, amplitude / 4.0].map(distance);
    for pair in distances.windows(2) {
        let ratio = pair[0] / pair[1];
        let expected = 2f64.powi(power);
        assert!(
            (ratio / expected - 1.0).abs() < 0.1,
            "{distances:?}: {ratio} instead of {expected}"
        );
    }
}

/// A run with a fine tolerance.
fn run<M: Machine>(machine: &M, (q, v): (&[f64], &[f64]), until: f64) -> Solution<M> {
    Simulation::new(machine)
        .tolerance(1e-13)
        .until(until)
        .run(state(machine, 0.0, q, v))
        .unwrap_or_else(|error| panic!("{}: {error}", machine.name()))
}

// The table of the library.

/// `machines/README.md` lists every machine once, and the tests that it names exist.
#[test]
fn the_table_of_the_library_is_complete_and_true() {
    let root = crate::support::root();
    let read = |path: &str| std::fs::read_to_string(root.join(path)).expect("it is text");
    let entries = std::fs::read_dir(root.join("machines")).expect("the library");
    let files = entries.map(|entry| entry.expect("an entry").file_name());
    let mut machines: Vec<String> = files
        .filter_map(|file| Some(file.to_str()?.strip_suffix(".machine")?.to_owned()))
        .collect();
    machines.sort();
    let mut known = [
        &crate::support::library::MACHINES[..],
        &crate::support::library::CONSTRAINED,
        &crate::support::library::SLIDING,
    ]
    .concat();
    known.sort_unstable();
    assert_eq!(machines, known);

    let table = read("machines/README.md");
    let lines: Vec<&str> = table
        .lines()
        .filter(|line| line.starts_with("| ["))
        .collect();
    let mut named: Vec<&str> = lines
        .iter()
        .filter_map(|line| line.strip_prefix("| [")?.split_once(']'))
        .map(|(name, _)| name)
        .collect();
    named.sort_unstable();
    assert_eq!(named, machines);

    let tests = read("tests/machines/library.rs");
    for line in lines {
        let shown = line.split('|').nth(3).expect("what is known");
        let mut evidence = shown.split('`').skip(1).step_by(2).peekable();
        assert!(evidence.peek().is_some(), "no test: {line}");
        for test in evidence {
            let is_there = match test.strip_suffix('…') {
                _ if test.ends_with(".rs") => root.join(test).exists(),
                Some(start) => tests.contains(&format!("\nfn {start}")),
                None => tests.contains(&format!("\nfn {test}()")),
            };
            assert!(is_there, "{test}: {line}");
        }
    }
}

// Special functions.

/// M. Abramowitz, I. A. Stegun, *Handbook of Mathematical Functions*, 1964: tables 17.1 and 20.1; and identities of the functions.
#[test]
fn special_functions_are_those_of_the_tables() {
    let near = |found: f64, table: f64, digit: f64| {
        assert!((found - table).abs() <= digit, "{found} instead of {table}");
    };
    near(elliptic_k(0.5), 1.854_074_677_301_372, 1e-15);
    near(elliptic_k(0.99), 3.695_637_362_989_875, 1e-13);
    near(agm(1.0, 2f64.sqrt()), 1.198_140_234_735_592_2, 1e-15);
    for (q, a0, b1) in [
        (1.0, -0.455_138_60, -0.110_248_82),
        (5.0, -5.800_046_02, -5.790_080_60),
    ] {
        let edges = mathieu_edges(q);
        near(edges[0], a0, 1e-8);
        near(edges[1], b1, 1e-8);
    }
    for m in [0.0, 0.3, 0.9, 0.999_999] {
        let k = elliptic_k(m);
        // At a quarter of the period, and at an eighth: sn² = 1/(1 + k').
        near(amplitude(k, m), FRAC_PI_2, 1e-13);
        let [sn, ..] = jacobi(k / 2.0, m);
        near(sn * sn, 1.0 / (1.0 + (1.0 - m).sqrt()), 1e-13);
        // d am/du = dn, by a fourth-order difference.
        let (u, h) = (0.7, 1e-3);
        let am = |i: f64| amplitude(u + i * h, m);
        let slope = (8.0 * (am(1.0) - am(-1.0)) - (am(2.0) - am(-2.0))) / (12.0 * h);
        near(slope, jacobi(u, m)[2], 1e-11);
    }
    for (e, mean) in [(0.0, 2.0), (0.6, 1.0), (0.99, 0.01), (0.9, 20.0)] {
        let u = kepler(e, mean);
        near(u - e * u.sin(), mean, 1e-14);
    }
}

// A simple pendulum.

/// Released at rest: `sin(θ/2) = k cd(w t)`. Through the lowest point fast enough to turn over: `θ = 2 am(Ω t/2)` of modulus 2 w/Ω.
/// At exactly the limiting speed: `θ = 4 atan e^(w t) − π`.
#[test]
fn a_pendulum_moves_as_jacobi_said() {
    let pendulum = SimplePendulum {
        l: 0.7,
        ..Default::default()
    };
    let w = (pendulum.g / pendulum.l).sqrt();
    for greatest in [0.1_f64, FRAC_PI_2, 3.0] {
        let k = (greatest / 2.0).sin();
        let exact = |t: f64| {
            let [sn, cn, dn] = jacobi(w * t, k * k);
            let complement = (greatest / 2.0).cos();
            [
                2.0 * (k * cn / dn).asin(),
                -2.0 * k * w * complement * sn / dn,
            ]
        };
        // One period by Gauss's formula, and ten periods.
        let period = 4.0 * elliptic_k(k * k) / w;
        let mut rows = rows(&[0.3, 1.0, 2.0, 5.0], exact);
        rows.extend([1.0, 10.0].map(|n| Row::of(n * period, &[greatest, 0.0])));
        held(&pendulum, (&[greatest], &[0.0]), &rows, <[f64]>::to_vec);
    }
    for fast in [2.001 * w, 3.0 * w] {
        let m = (2.0 * w / fast).powi(2);
        let exact = |t: f64| {
            let angle = amplitude(fast * t / 2.0, m);
            [2.0 * angle, fast * (1.0 - m * angle.sin().powi(2)).sqrt()]
        };
        held(
            &pendulum,
            (&[0.0], &[fast]),
            &rows(&[0.3, 1.0, 4.0], exact),
            <[f64]>::to_vec,
        );
    }
    let still = |t: f64| {
        let rise = (w * t).exp();
        [4.0 * rise.atan() - PI, 2.0 * w / (w * t).cosh()]
    };
    held(
        &pendulum,
        (&[0.0], &[2.0 * w]),
        &rows(&[0.3, 1.0, 1.5], still),
        <[f64]>::to_vec,
    );
}

#[test]
fn a_pendulum_from_the_horizontal_pulls_with_three_times_its_weight() {
    let pendulum = SimplePendulum::default();
    let w = pendulum.g.sqrt();
    let quarter = elliptic_k(0.5) / w;
    let run = run(&pendulum, (&[FRAC_PI_2], &[0.0]), quarter);
    let tension = outputs(run.system(), quarter, &numbers(run.system(), run.end())).tension;
    // The rate, 4.4 rad/s, errs by at most the tolerance of each step.
    let limit = 10.0 * run.statistics().steps as f64 * 1e-13 * 10.0;
    assert!((tension - 3.0 * pendulum.g).abs() <= limit, "{tension}");
}

// An elastic pendulum.

#[test]
fn an_elastic_pendulum_bounces_harmonically_however_far() {
    let pendulum = ElasticPendulum::default();
    let w = (pendulum.k / pendulum.m).sqrt();
    let rest = pendulum.l0 + pendulum.m * pendulum.g / pendulum.k;
    let exact = |t: f64| {
        [
            rest + 0.6 * (w * t).cos(),
            0.0,
            -0.6 * w * (w * t).sin(),
            0.0,
        ]
    };
    let rows = rows(&[0.2, 1.0, 3.0], exact);
    held(
        &pendulum,
        (&[rest + 0.6, 0.0], &[0.0; 2]),
        &rows,
        <[f64]>::to_vec,
    );
}

#[test]
fn an_elastic_pendulum_runs_in_a_circle_where_nothing_weighs() {
    let free = ElasticPendulum {
        g: 0.0,
        ..Default::default()
    };
    let r = 1.1;
    let rate = (free.k * (r - free.l0) / (free.m * r)).sqrt();
    // k (r − l₀)/m balances r rate².
    steady(
        &free,
        (&[r, 0.0], &[0.0, rate]),
        (2.0, r * rate * rate),
        |t| [r, rate * t, 0.0, rate],
    );
    keeps(&free, (&[0.9, 0.2], &[0.4, 3.0]), 3.0, |o| o.momentum);
}

#[test]
fn small_motion_of_an_elastic_pendulum_is_two_oscillators() {
    let pendulum = ElasticPendulum {
        k: 50.0,
        ..Default::default()
    };
    let length = pendulum.l0 + pendulum.m * pendulum.g / pendulum.k;
    let stretching = (pendulum.k / pendulum.m).sqrt();
    let swinging = (pendulum.g / length).sqrt();
    shrinks(2, 0.01, |a| {
        let end = run(&pendulum, (&[length + a, a], &[0.0; 2]), 1.3);
        let q = end.end().q;
        let linear = [
            length + a * (stretching * 1.3).cos(),
            a * (swinging * 1.3).cos(),
        ];
        (q.r - linear[0]).hypot(q.theta - linear[1])
    });
}

#[test]
fn an_elastic_pendulum_keeps_its_energy() {
    keeps_energy(&ElasticPendulum::default(), (&[1.2, 0.8], &[0.0; 2]), 5.0);
}

/// At k/m = 4 g/l the stretching mode drives the swing and takes the energy back; an octave away it does not.
#[test]
fn an_elastic_pendulum_in_resonance_hands_its_energy_over() {
    let swing = |k: f64| {
        let pendulum = ElasticPendulum {
            k,
            l0: 1.0 - 9.81 / k,
            ..Default::default()
        };
        let run = run(&pendulum, (&[1.1, 0.01], &[0.0; 2]), 60.0);
        let angles: Vec<f64> = run
            .every(0.01)
            .expect("it swings")
            .iter()
            .map(|state| state.q.theta.abs())
            .collect();
        let most = |part: &[f64]| part.iter().copied().fold(0.0, f64::max);
        // The greatest swing, and the greatest in the quietest two seconds after it, which is the length of a full swing.
        let greatest = most(&angles);
        let at = angles
            .iter()
            .position(|&a| a == greatest)
            .expect("it is there");
        let quiet = angles[at..].chunks_exact(200).map(most);
        (greatest, quiet.fold(f64::INFINITY, f64::min))
    };
    // All the energy: ½ k a² = ½ m g l θ² with a = 0.1 m and k/m = 4 g/l.
    let (greatest, quiet) = swing(4.0 * 9.81);
    assert!((greatest / 0.2 - 1.0).abs() < 0.05, "{greatest}");
    assert!(quiet < 0.1 * greatest, "{quiet}");
    let (greatest, _) = swing(8.0 * 9.81);
    assert!(greatest < 0.015, "{greatest}");
}

// A spherical pendulum.

#[test]
fn a_conical_pendulum_runs_at_its_steady_rate_and_nods_beside_it() {
    let pendulum = SphericalPendulum {
        l: 0.8,
        ..Default::default()
    };
    let cone: f64 = 0.9;
    let rate = (pendulum.g / (pendulum.l * cone.cos())).sqrt();
    steady(
        &pendulum,
        (&[0.0, cone], &[rate, 0.0]),
        (5.0, rate * rate),
        |t| [rate * t, cone, rate, 0.0],
    );
    let nod = rate * (1.0 + 3.0 * cone.cos().powi(2)).sqrt();
    shrinks(2, 0.01, |a| {
        // With the angular momentum of the conical motion.
        let other = rate * (cone.sin() / (cone + a).sin()).powi(2);
        let end = run(&pendulum, (&[0.0, cone + a], &[other, 0.0]), 1.1);
        (end.end().q.theta - cone - a * (nod * 1.1).cos()).abs()
    });
}

/// With z the height, `l² ż² = 2 (E − g z)(l² − z²) − p² = 2 g (z − z₁)(z − z₂)(z − z₃)` for unit
/// mass, so `z = z₁ + (z₂ − z₁) sn²(√(g (z₃ − z₁)/2) t/l)`; and `φ̇ = p/(l² − z²)`.
#[test]
fn the_height_of_a_spherical_pendulum_is_an_elliptic_function() {
    let pendulum = SphericalPendulum::default();
    let SphericalPendulum { l, g, .. } = pendulum;
    for (lowest, rate) in [(0.5_f64, 5.0), (0.2, 20.0), (1.0, 6.0), (0.05, 60.0)] {
        let z1 = -l * lowest.cos();
        let e = 0.5 * (l * lowest.sin() * rate).powi(2) + g * z1;
        let p = (l * lowest.sin()).powi(2) * rate;
        // Sum and product of the other roots, by Vieta's formulas.
        let (sum, product) = (e / g - z1, -l * l - z1 * (e / g - z1));
        let root = (sum * sum / 4.0 - product).sqrt();
        let (z2, z3) = (sum / 2.0 - root, sum / 2.0 + root);
        let (m, scale) = ((z2 - z1) / (z3 - z1), (g * (z3 - z1) / 2.0).sqrt() / l);
        let height = |t: f64| z1 + (z2 - z1) * jacobi(scale * t, m)[0].powi(2);
        assert!(z1 < z2 && z2 < l, "it starts at its lowest point");
        // From one lowest point to the next.
        let period = 2.0 * elliptic_k(m) / scale;
        let turn = period * mean(period, 2000, |t| p / (l * l - height(t).powi(2)));
        // V. Puiseux, 1842; G.-H. Halphen, 1888.
        assert!(PI < turn && turn < TAU, "{turn}");
        let (q, v) = ([0.0, lowest], [rate, 0.0]);
        let heights = rows(&[0.1, 0.5, 1.3], |t| [height(t)]);
        held(&pendulum, (&q, &v), &heights, |y| vec![-l * y[1].cos()]);
        // After whole periods the azimuth is also known.
        let lowest_again = [1.0, 3.0].map(|n| Row::of(n * period, &[z1, n * turn]));
        held(&pendulum, (&q, &v), &lowest_again, |y| {
            vec![-l * y[1].cos(), y[0]]
        });
    }
}

#[test]
fn a_spherical_pendulum_keeps_its_energy_and_its_angular_momentum() {
    let pendulum = SphericalPendulum::default();
    let (q, v) = ([0.3, 1.4], [2.0, -1.0]);
    keeps_energy(&pendulum, (&q, &v), 5.0);
    keeps(&pendulum, (&q, &v), 5.0, |o| o.vertical_momentum);
}

// Kapitza's pendulum.

/// The trace of the monodromy matrix, over one period of the pivot, of small motions about the upright position. Where these are
/// stable it is 2 cos of the slow phase per period.
fn shake(pendulum: &KapitzaPendulum, tolerance: f64) -> f64 {
    // So small that sin θ equals θ to the last digit.
    let size = 1e-9;
    let columns = [[size, 0.0], [0.0, size * pendulum.omega]].map(|[angle, rate]| {
        let run = Simulation::new(pendulum)
            .relative(tolerance)
            .absolute(tolerance * size)
            .until(TAU / pendulum.omega)
            .run(state(pendulum, 0.0, &[angle], &[rate]))
            .expect("it moves");
        numbers(run.system(), run.end())
    });
    columns[0][0] / size + columns[1][1] / (size * pendulum.omega)
}

/// On the boundaries of stability a solution of Mathieu's equation is periodic after one period of the pivot or
/// after two: the trace is 2 or −2.
#[test]
fn a_shaken_pendulum_stands_between_two_characteristic_values() {
    for ratio in [0.05, 0.2, 0.5, 0.6] {
        let pendulum = |a: f64| KapitzaPendulum {
            l: 0.5,
            a: 0.5 * ratio,
            omega: (-4.0 * 9.81 / (0.5 * a)).sqrt(),
            ..Default::default()
        };
        let [low, high] = mathieu_edges(2.0 * ratio);
        for (edge, exact) in [(low, 2.0), (high, -2.0)] {
            if edge >= 0.0 {
                // Only A < 0, where the pendulum stands against gravity, can be tested.
                continue;
            }
            let [fine, coarse] = [1e-13, 1e-11].map(|tolerance| shake(&pendulum(edge), tolerance));
            let (error, limit) = ((fine - exact).abs(), (fine - coarse).abs().max(1e-12));
            assert!(limit < 1e-8 && error <= limit, "{error:e}, limit {limit:e}");
        }
        // A tenth to either side.
        let at = |a: f64| shake(&pendulum(a), 1e-12);
        assert!(at(1.1 * low) > 2.0 && at(0.9 * low).abs() < 2.0);
        if high < 0.0 {
            assert!(at(1.1 * high).abs() < 2.0 && at(0.9 * high) < -2.0);
        }
    }
}

/// With the same speed a ω of the pivot, the difference of the squared frequency from the averaged one is
/// proportional to the square of a/l.
#[test]
fn a_shaken_pendulum_sways_with_kapitzas_frequency() {
    let speed: f64 = 6.0;
    shrinks(2, 0.08, |a| {
        let pendulum = KapitzaPendulum {
            l: 1.0,
            a,
            omega: speed / a,
            ..Default::default()
        };
        let slow = (shake(&pendulum, 1e-13) / 2.0).acos() * pendulum.omega / TAU;
        (slow.powi(2) - (speed.powi(2) / 2.0 - pendulum.g)).abs()
    });
}

#[test]
fn a_pendulum_shaken_enough_stands_upside_down() {
    let most = |omega: f64| {
        let pendulum = KapitzaPendulum {
            omega,
            ..Default::default()
        };
        let run = Simulation::new(&pendulum)
            .until(60.0)
            .every(0.01)
            .run(pendulum.start())
            .expect("it moves");
        let angles = run.samples().iter().map(|state| state.q.theta.abs());
        angles.fold(0.0, f64::max)
    };
    let enough = (2.0 * 9.81_f64).sqrt() / 0.1;
    // It starts at 0.3 rad and oscillates about the upright position; the ripple adds a/l of that.
    assert!(most(2.0 * enough) < 0.3 * 1.2);
    assert!(most(0.9 * enough) > FRAC_PI_2);
}

/// Upright and at rest, nothing in the motion limits a step, so the run is one step in which the pivot oscillates many times. The
/// drive's work is that of a mass moving up and down with the pivot.
#[test]
fn the_work_of_a_drive_is_known_while_the_machine_rests() {
    let pendulum = KapitzaPendulum::default();
    let KapitzaPendulum { m, a, omega, g, .. } = pendulum;
    let explicit =
        |method: &&Method| !method.has_fixed_steps() && method.tableau.spectrum.is_none();
    for method in METHODS.iter().filter(explicit) {
        for (until, tolerance) in [(2.0, 1e-9), (20.0, 1e-6)] {
            let run = Simulation::new(&pendulum)
                .method(method)
                .tolerance(tolerance)
                .until(until)
                .energy_balance(true)
                .run(state(&pendulum, 0.0, &[0.0], &[0.0]))
                .expect("it rests");
            let balance = run.energy_balance().expect("it was kept");
            let (sin, cos) = (omega * until).sin_cos();
            let exact = 0.5 * m * (a * omega * sin).powi(2) + m * g * a * (cos - 1.0);
            let name = method.tableau.name;
            assert!(balance.explained < 1e-2 * exact.abs(), "{name} {balance:?}");
            assert!(
                (balance.work - exact).abs() <= balance.explained,
                "{name} {balance:?}"
            );
            assert!(
                balance.residual().abs() <= balance.explained,
                "{name} {balance:?}"
            );
            // In each period the drive supplies m (a ω)²/2 twice and takes it back twice.
            let shakes = omega * until / TAU;
            let to_and_fro = 2.0 * m * (a * omega).powi(2) * shakes;
            assert!(
                (balance.exchanged / to_and_fro - 1.0).abs() < 0.1,
                "{name} {balance:?}"
            );
        }
    }
}

// A train.

/// The motion as a sum of the modes `cos(π j (i − ½)/n)`, each of which obeys `u″ = −w² u + F` by itself.
fn train(
    SpringMassTrain { m, k, .. }: SpringMassTrain,
    pull: f64,
    (u, v): (&[f64], &[f64]),
    t: f64,
) -> Vec<f64> {
    let n = u.len();
    let shape = |i: usize, j: usize| (PI * j as f64 * (i as f64 + 0.5) / n as f64).cos();
    let amplitude = |j: usize| {
        let project = |row: &[f64]| {
            let sums = (0..n).fold((0.0, 0.0), |(of, norm), i| {
                (of + row[i] * shape(i, j), norm + shape(i, j).powi(2))
            });
            sums.0 / sums.1
        };
        let norm: f64 = (0..n).map(|i| shape(i, j).powi(2)).sum();
        let (u, v, force) = (project(u), project(v), pull * shape(n - 1, j) / norm / m);
        let w = 2.0 * (k / m).sqrt() * (PI * j as f64 / (2 * n) as f64).sin();
        if j == 0 {
            return u + v * t + force * t * t / 2.0;
        }
        let rest = force / (w * w);
        rest + (u - rest) * (w * t).cos() + v / w * (w * t).sin()
    };
    (0..n)
        .map(|i| (0..n).map(|j| amplitude(j) * shape(i, j)).sum())
        .collect()
}

#[test]
fn a_train_is_the_sum_of_its_modes() {
    let machine = SpringMassTrain::default();
    let mut random = SplitMix::new(3);
    let mut row = |size: f64| -> Vec<f64> { (0..8).map(|_| random.uniform(-size, size)).collect() };
    let (u, v) = (row(0.02), row(0.5));
    let rows: Vec<Row> = [0.1, 1.0, 4.0]
        .map(|t| Row::of(t, &train(machine, 200.0, (&u, &v), t)))
        .into();
    held(&machine, (&u, &v), &rows, |y| y[..8].to_vec());
}

#[test]
fn trains_of_every_length_are_the_sums_of_their_modes() {
    for n in 2..=5 {
        let program = crate::support::library::program("spring_mass_train", &[("N", n)]);
        let machine = lagrangian::interpreted::InterpretedMachine::new(program);
        let n = n as usize;
        let u: Vec<f64> = (0..n).map(|i| 0.01 * (i * i) as f64).collect();
        let v = vec![0.2; n];
        let exact = train(SpringMassTrain::default(), 200.0, (&u, &v), 1.0);
        held(&machine, (&u, &v), &[Row::of(1.0, &exact)], |y| {
            y[..n].to_vec()
        });
    }
}

/// The stretch of each coupling from `k s = (i/N) F`; all cars accelerate alike with `F/(N m)`.
#[test]
fn a_coupling_is_stretched_by_the_cars_that_hang_on_it() {
    let machine = SpringMassTrain::default();
    let (pull, n) = (200.0, 8);
    let place = |i: usize| {
        let stretches = (1..=i).map(|i| pull * i as f64 / n as f64 / machine.k);
        stretches.sum::<f64>()
    };
    let ride = |t: f64| pull / (n as f64 * machine.m) * t * t / 2.0;
    let exact = |t: f64| -> [f64; 8] { std::array::from_fn(|i| place(i) + ride(t)) };
    let (u, v) = (exact(0.0), [0.0; 8]);
    // The force on a car is the difference of terms of the size k u, where u is 9 m at the end.
    steady(
        &machine,
        (&u, &v),
        (3.0, 4.0 * machine.k / machine.m * 9.0),
        exact,
    );
    let end = run(&machine, (&u, &v), 3.0);
    let drawbar = outputs(end.system(), 3.0, &numbers(end.system(), end.end())).drawbar;
    assert!((drawbar - pull * 7.0 / 8.0).abs() < 1e-8, "{drawbar}");
}

// Chains.

/// Angles from the vertical are sums of the angles between neighbouring bars, and so are their accelerations.
#[test]
fn a_chain_is_the_same_in_relative_angles() {
    let relative = ChainRelative::default();
    let chain = Chain::default().prepare();
    let sums = |row: &[f64]| {
        let sums = row.iter().scan(0.0, |sum, x| {
            *sum += x;
            Some(*sum)
        });
        sums.collect::<Vec<f64>>()
    };
    let mut random = Random::new(&relative, 7);
    for _ in 0..100 {
        let at = random.sample();
        let found = accelerations(&random.system, at.t, &at.q, &at.v).expect("not singular");
        let exact = accelerations(&chain, at.t, &sums(&at.q), &sums(&at.v)).expect("not singular");
        let size = exact.iter().fold(1.0, |size, a| f64::max(size, a.abs()));
        // A thousand rounding units, times the condition of M, about 10³ for 8 bars.
        for (found, exact) in sums(&found).iter().zip(&exact) {
            assert!((found - exact).abs() <= 1e6 * f64::EPSILON * size);
        }
    }
}

// Two bodies.

/// Started at the pericentre: distance and direction follow from the eccentric anomaly u of Kepler's equation.
#[test]
fn two_bodies_move_as_kepler_said() {
    let bodies = TwoBodyOrbit::default();
    let attraction = bodies.G * (bodies.m1 + bodies.m2);
    for (a, e) in [(1.0_f64, 0.0_f64), (1.0, 0.6), (2.5, 0.3), (1.0, 0.95)] {
        let n = (attraction / a.powi(3)).sqrt();
        let exact = |t: f64| {
            let u = kepler(e, n * t);
            let beta = e / (1.0 + (1.0 - e * e).sqrt());
            let ahead = (beta * u.sin()).atan2(1.0 - beta * u.cos());
            [a * (1.0 - e * u.cos()), u + 2.0 * ahead]
        };
        let nearest = a * (1.0 - e);
        let rate = (attraction * (1.0 + e) / nearest).sqrt() / nearest;
        let period = TAU / n;
        let mut rows = rows(&[0.01, 0.4, 1.0, 2.3], exact);
        rows.push(Row::of(3.0 * period, &[nearest, 3.0 * TAU]));
        held(&bodies, (&[nearest, 0.0], &[0.0, rate]), &rows, |y| {
            y[..2].to_vec()
        });
    }
}

#[test]
fn two_bodies_keep_energy_angular_momentum_and_their_line_of_apsides() {
    let bodies = TwoBodyOrbit::default();
    let (q, v) = ([0.4, 0.3], [0.5, 9.0]);
    keeps_energy(&bodies, (&q, &v), 5.0);
    keeps(&bodies, (&q, &v), 5.0, |o| o.momentum);
    keeps(&bodies, (&q, &v), 5.0, |o| o.eccentricity_x);
    keeps(&bodies, (&q, &v), 5.0, |o| o.eccentricity_y);
    // The vector has the length of the eccentricity and points towards the pericentre.
    let system = bodies.prepare();
    let at_pericentre = outputs(&system, 0.0, &[0.4, 0.3, 0.0, 10.0]);
    let [x, y] = [at_pericentre.eccentricity_x, at_pericentre.eccentricity_y];
    assert!((x.hypot(y) - 0.6).abs() < 1e-14 && (y.atan2(x) - 0.3).abs() < 1e-14);
}

// A top without torque.

/// A body that rotates about its middle axis z, tilted by `roll`, with the angular momentum vertical. Euler's equations are solved by
/// Jacobi's functions (L. D. Landau, E. M. Lifshitz, *Mechanics*, section 37, whose axes 1, 2, 3 are the body's x, −z, y).
struct Tumbling {
    moments: [f64; 3],
    /// Angular momentum.
    l: f64,
    /// The greatest angular velocities about x and z, and about y.
    greatest: [f64; 3],
    /// The factor of t in the argument of the functions, and their parameter.
    rate: f64,
    m: f64,
}

impl Tumbling {
    fn new(top: &AsymmetricTop, l: f64, roll: f64) -> Self {
        let [i1, i3, i2] = [top.A, top.B, top.C];
        // Twice the energy.
        let e = l * l * (roll.sin().powi(2) / i3 + roll.cos().powi(2) / i2);
        let (high, low) = (e * i3 - l * l, l * l - e * i1);
        Self {
            moments: [top.A, top.B, top.C],
            l,
            greatest: [
                (high / (i1 * (i3 - i1))).sqrt(),
                (low / (i3 * (i3 - i1))).sqrt(),
                (high / (i2 * (i3 - i2))).sqrt(),
            ],
            rate: ((i3 - i2) * low / (i1 * i2 * i3)).sqrt(),
            m: (i2 - i1) * high / ((i3 - i2) * low),
        }
    }

    /// The time between upright and upside down.
    fn flip(&self) -> f64 {
        2.0 * elliptic_k(self.m) / self.rate
    }

    /// Angular velocity in body axes; the body is upright at t = 0.
    fn velocity(&self, t: f64) -> [f64; 3] {
        let [sn, cn, dn] = jacobi(self.rate * t - elliptic_k(self.m), self.m);
        let [x, y, z] = self.greatest;
        [x * cn, y * dn, -z * sn]
    }

    /// The upward vertical in body axes, which is the direction of the angular momentum.
    fn vertical(&self, t: f64) -> [f64; 3] {
        let velocity = self.velocity(t);
        std::array::from_fn(|i| self.moments[i] * velocity[i] / self.l)
    }

    /// The rate of the yaw angle.
    fn yawing(&self, t: f64) -> f64 {
        let ([_, wy, wz], [_, y, z]) = (self.velocity(t), self.vertical(t));
        (wy * y + wz * z) / (y * y + z * z)
    }

    /// Angles and rates at the start.
    fn start(&self, roll: f64) -> ([f64; 3], [f64; 3]) {
        let [_, wy, wz] = self.velocity(0.0);
        let (sin, cos) = roll.sin_cos();
        (
            [0.0, 0.0, roll],
            [sin * wy + cos * wz, cos * wy - sin * wz, 0.0],
        )
    }
}

#[test]
fn a_free_top_turns_as_euler_and_jacobi_said() {
    let top = AsymmetricTop::default();
    for roll in [0.05, 0.5, 1.2] {
        let motion = Tumbling::new(&top, 0.3, roll);
        let (q, v) = motion.start(roll);
        let direction = |y: &[f64]| {
            let (pitch, roll) = (y[1], y[2]);
            let level = pitch.cos();
            vec![-pitch.sin(), level * roll.sin(), level * roll.cos()]
        };
        let rows = rows(&[0.1, 0.4, 1.0, 2.0], |t| motion.vertical(t));
        held(&top, (&q, &v), &rows, direction);
        // After two flips, the yaw is the integral of its rate.
        let period = 2.0 * motion.flip();
        let sum = |points| period * mean(period, points, |t| motion.yawing(t));
        let yaw = sum(2000);
        assert!((yaw - sum(1000)).abs() < 1e-12 * yaw);
        let row = Row::of(period, &[yaw]);
        held(&top, (&q, &v), &[row], |y| y[..1].to_vec());
    }
}

/// V. Dzhanibekov's wing nut flips at equal intervals, which are longer the less it wobbles.
#[test]
fn a_top_spun_about_its_middle_axis_tumbles_in_time() {
    let top = AsymmetricTop::default();
    let mut last = 0.0;
    for roll in [0.1, 0.01, 0.001] {
        let motion = Tumbling::new(&top, 0.3, roll);
        let (q, v) = motion.start(roll);
        let flips = |tolerance: f64| {
            let run = Simulation::new(&top)
                .tolerance(tolerance)
                .until(6.2 * motion.flip())
                .event("level", Crossing::Any, |state| {
                    state.q.pitch.cos() * state.q.roll.cos()
                })
                .run(state(&top, 0.0, &q, &v))
                .expect("it turns");
            let times = run.events().iter().map(|event| event.state.t);
            times.collect::<Vec<f64>>()
        };
        let (fine, coarse) = (flips(1e-13), flips(1e-11));
        assert_eq!(fine.len(), 6);
        let exact = (0..6).map(|i| (f64::from(i) + 0.5) * motion.flip());
        let limit = fine
            .iter()
            .zip(&coarse)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        assert!(limit < 1e-4, "{limit:e}");
        for (found, exact) in fine.iter().zip(exact) {
            assert!((found - exact).abs() <= limit, "{found} {exact} {limit:e}");
        }
        // Later by ln 10 divided by the growth rate of a wobble.
        let later = motion.flip() - last;
        if last > 0.0 {
            assert!((later * motion.rate / (2.0 * 10f64.ln()) - 1.0).abs() < 0.02);
        }
        last = motion.flip();
    }
}

#[test]
fn a_free_top_turns_steadily_about_its_own_axes() {
    let top = AsymmetricTop::default();
    // Only rounding accelerates it, of terms of about 10 times the rate squared, by the ratios of the moments.
    let (w, size) = (5.0, 10.0 * 25.0);
    steady(&top, (&[0.0; 3], &[0.0, 0.0, w]), (0.2, size), |t| {
        [0.0, 0.0, w * t]
    });
    steady(&top, (&[0.0; 3], &[0.0, w, 0.0]), (0.2, size), |t| {
        [0.0, w * t, 0.0]
    });
    steady(&top, (&[0.0; 3], &[w, 0.0, 0.0]), (0.2, size), |t| {
        [w * t, 0.0, 0.0]
    });
}

#[test]
fn a_free_top_keeps_its_energy_and_its_angular_momentum() {
    let top = AsymmetricTop::default();
    let (q, v) = ([0.1, -0.2, 0.4], [6.0, 1.0, -2.0]);
    keeps_energy(&top, (&q, &v), 3.0);
    keeps(&top, (&q, &v), 3.0, |o| o.momentum_x);
    keeps(&top, (&q, &v), 3.0, |o| o.momentum_y);
    keeps(&top, (&q, &v), 3.0, |o| o.momentum_z);
}

// An arm of two joints.

/// With masses at the ends of massless links the arm is a double pendulum, whose angles are measured from the vertical.
#[test]
fn an_arm_with_point_masses_is_a_double_pendulum() {
    let arm = TwoJointArm {
        c1: 0.4,
        c2: 0.35,
        J1: 0.0,
        J2: 0.0,
        ..Default::default()
    };
    let pendulum = DoublePendulum {
        m1: arm.m1,
        m2: arm.m2,
        l1: arm.l1,
        l2: arm.l2,
        g: arm.g,
    };
    let mut random = Random::new(&pendulum, 5);
    let system = arm.prepare();
    for _ in 0..100 {
        let at = random.sample();
        let pendulums = accelerations(&random.system, at.t, &at.q, &at.v).expect("not singular");
        let q = [at.q[0] - FRAC_PI_2, at.q[1] - at.q[0]];
        let arms = accelerations(&system, at.t, &q, &[at.v[0], at.v[1] - at.v[0]]);
        let arms = arms.expect("not singular");
        let apart = (arms[0] - pendulums[0]).hypot(arms[0] + arms[1] - pendulums[1]);
        // Rounding times the condition of M, which is below a hundred for these masses. The angles themselves are rounded, too.
        let size = 1.0 + pendulums[0].hypot(pendulums[1]);
        assert!(apart <= 1000.0 * 100.0 * f64::EPSILON * size, "{apart:e}");
    }
}

/// Motor torques `M(q) a + C(q, v) v + g(q)` from the textbook, typed in by hand, make each joint an independent
/// oscillator: `e″ + 2 δ e′ + (δ² + ω²) e = 0`.
#[test]
fn an_arm_under_computed_torque_moves_joint_by_joint() {
    let arm = TwoJointArm::default();
    let (goal, decay, w) = ([1.2, -0.4], [1.5, 3.0], [4.0, 2.5]);
    let torque = |q: [f64; 2], v: [f64; 2]| {
        let TwoJointArm {
            l1,
            c1,
            c2,
            m1,
            m2,
            J1,
            J2,
            g,
            ..
        } = arm;
        let wanted = |i: usize| {
            -2.0 * decay[i] * v[i] - (decay[i] * decay[i] + w[i] * w[i]) * (q[i] - goal[i])
        };
        let a = [wanted(0), wanted(1)];
        let coupling = m2 * (c2 * c2 + l1 * c2 * q[1].cos()) + J2;
        let both = m1 * c1 * c1 + m2 * (l1 * l1 + c2 * c2 + 2.0 * l1 * c2 * q[1].cos()) + J1 + J2;
        let h = -m2 * l1 * c2 * q[1].sin();
        let forearm = m2 * c2 * g * (q[0] + q[1]).cos();
        [
            both * a[0]
                + coupling * a[1]
                + h * (2.0 * v[0] * v[1] + v[1] * v[1])
                + (m1 * c1 + m2 * l1) * g * q[0].cos()
                + forearm,
            coupling * a[0] + (m2 * c2 * c2 + J2) * a[1] - h * v[0] * v[0] + forearm,
        ]
    };
    let run = |tolerance: f64| {
        Simulation::new(&arm)
            .tolerance(tolerance)
            .inputs(|_, q, v, u: &mut Inputs<TwoJointArm>| {
                [u.tau1, u.tau2] = torque([q.q1, q.q2], [v.q1, v.q2]);
            })
            .until(2.0)
            .run(arm.start())
            .expect("it moves")
    };
    let start = [arm.start().q.q1, arm.start().q.q2];
    let exact = |t: f64| {
        [0, 1].map(|i| {
            let (sin, cos) = (w[i] * t).sin_cos();
            let e = (-decay[i] * t).exp() * (cos + decay[i] / w[i] * sin);
            goal[i] + (start[i] - goal[i]) * e
        })
    };
    let rows = rows(&[0.2, 0.7, 2.0], exact);
    let view = |y: &[f64]| y[..2].to_vec();
    holds(
        "TwoJointArm",
        &[run(FINE), run(100.0 * FINE)],
        (&rows, &[1.0; 2], BOUND),
        view,
    );
}

#[test]
fn an_arm_keeps_its_energy_while_no_motor_runs() {
    keeps_energy(&TwoJointArm::default(), (&[0.5, 1.0], &[0.0; 2]), 5.0);
    let system = TwoJointArm::default().prepare();
    let tip = outputs(&system, 0.0, &[FRAC_PI_2, -FRAC_PI_2, 0.0, 0.0]);
    assert!((tip.x - 0.35).abs() < 1e-15 && (tip.y - 0.4).abs() < 1e-15);
    assert!((tip.manipulability - 0.4 * 0.35).abs() < 1e-15);
}

// A gyroscope in gimbals.

/// The moment of inertia about the vertical at an inclination, without the rotor's spin, and that about the inner axis.
fn gimbals(gyroscope: &GyroscopeInGimbals, beta: f64) -> [f64; 2] {
    let GyroscopeInGimbals {
        A1,
        A2,
        B2,
        C2,
        A3,
        w,
        d,
        ..
    } = *gyroscope;
    let across = C2 + A3 + w * d * d;
    [
        A1 + B2 * beta.sin().powi(2) + across * beta.cos().powi(2),
        A2 + A3 + w * d * d,
    ]
}

/// Level, it precesses at w g d/H. Inclined, the rates are the roots of `(C₂ + A₃ + w d² − B₂) sin β x² − H x + w g d = 0`.
#[test]
fn a_gyroscope_precesses_steadily() {
    let gyroscope = GyroscopeInGimbals::default();
    let GyroscopeInGimbals {
        B2,
        C2,
        A3,
        C3,
        w,
        d,
        g,
        ..
    } = gyroscope;
    let spin = 300.0;
    let (momentum, weight) = (C3 * spin, w * g * d);
    let level = weight / momentum;
    let excess = |beta: f64| (C2 + A3 + w * d * d - B2) * beta.sin();
    let roots = |beta: f64, momentum: f64| {
        let square = excess(beta);
        let root = (momentum * momentum - 4.0 * square * weight).sqrt();
        // The slow root in a form without cancellation.
        [
            2.0 * weight / (momentum + root),
            (momentum + root) / (2.0 * square),
        ]
    };
    let [slow, fast] = roots(0.4, momentum);
    for (beta, rate) in [(0.0, level), (0.4, slow), (0.4, fast)] {
        let relative = spin - f64::sin(beta) * rate;
        // H times the rate, divided by the inertia about the inner axis, is the size of the terms that the weight and the gimbals balance.
        let size = momentum * rate / gimbals(&gyroscope, beta)[1];
        steady(
            &gyroscope,
            (&[0.0, beta, 0.0], &[rate, 0.0, relative]),
            (0.1, size),
            |t| [rate * t, beta, relative * t],
        );
    }
    // As the rotor gets faster, the slow root tends to the simple formula with a difference of order 1/H³.
    shrinks(3, 2.0 / momentum, |inverse| {
        (roots(0.4, 1.0 / inverse)[0] - weight * inverse).abs()
    });
}

/// It nutates with the frequency H cos β/√(I J), and the outer gimbal drifts at −½ b² H sin β (A₁ + B₂)/I². This follows from U = (p
/// − H sin β)²/2I and the rate (p − H sin β)/I to second order in the amplitude b.
#[test]
fn a_gyroscope_nods_and_drifts_by_the_inertia_of_its_gimbals() {
    let gyroscope = GyroscopeInGimbals {
        g: 0.0,
        ..Default::default()
    };
    let (beta, spin) = (0.5_f64, 200.0);
    let [about_outer, about_inner] = gimbals(&gyroscope, beta);
    let momentum = gyroscope.C3 * spin;
    let nod = momentum * beta.cos() / (about_outer * about_inner).sqrt();
    shrinks(2, 0.01, |b| {
        let (q, v) = ([0.0, beta, 0.0], [0.0, b * nod, spin]);
        let end = run(&gyroscope, (&q, &v), 0.02);
        (end.end().q.beta - beta - b * (nod * 0.02).sin()).abs()
    });
    // The mean rate of the outer gimbal from one highest point to the third after it.
    let drift = |gyroscope: &GyroscopeInGimbals, nod: f64, b: f64| {
        let run = Simulation::new(gyroscope)
            .tolerance(1e-13)
            .until(3.5 * TAU / nod)
            .event("highest", Crossing::Falling, |state| state.v.beta)
            .run(state(
                gyroscope,
                0.0,
                &[0.0, beta, 0.0],
                &[0.0, b * nod, spin],
            ))
            .expect("it nods");
        let [first, .., last] = run.events() else {
            panic!("it nods three times")
        };
        (last.state.q.alpha - first.state.q.alpha) / (last.state.t - first.state.t)
    };
    let GyroscopeInGimbals { A1, B2, .. } = gyroscope;
    let formula = |b: f64| -momentum * b * b * beta.sin() * (A1 + B2) / (2.0 * about_outer.powi(2));
    shrinks(4, 0.08, |b| (drift(&gyroscope, nod, b) - formula(b)).abs());
    let relative = drift(&gyroscope, nod, 0.02) / formula(0.02);
    assert!((relative - 1.0).abs() < 0.01, "{relative}");
    // Without the gimbals' inertia it is a free symmetric top, whose axis returns to its initial direction.
    let light = GyroscopeInGimbals {
        A1: 0.0,
        A2: 0.0,
        B2: 0.0,
        C2: 0.0,
        w: 0.0,
        ..gyroscope
    };
    let nod = momentum * beta.cos() / gimbals(&light, beta).iter().product::<f64>().sqrt();
    let rest = drift(&light, nod, 0.02);
    assert!(rest.abs() < 1e-6 * formula(0.02).abs(), "{rest:e}");
}

#[test]
fn a_gyroscope_keeps_its_energy_and_two_angular_momenta() {
    let gyroscope = GyroscopeInGimbals::default();
    let (q, v) = ([0.2, 0.3, 0.0], [1.0, -2.0, 100.0]);
    keeps_energy(&gyroscope, (&q, &v), 1.0);
    keeps(&gyroscope, (&q, &v), 1.0, |o| o.rotor_momentum);
    keeps(&gyroscope, (&q, &v), 1.0, |o| o.vertical_momentum);
}
