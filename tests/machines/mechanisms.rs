//! Machines of the library with constraints. Accelerations and multipliers are compared with equations typed by hand, other
//! coordinates and published numbers; motions are compared with closed forms and results in quadruple precision.
#![expect(
    clippy::excessive_precision,
    reason = "references with all their digits"
)]

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::support::limits::follows;
use crate::support::random::SplitMix;
use crate::support::references::Row;
use crate::support::special::jacobi;
use crate::support::states::{numbers, state, vector};
use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{Error, Machine, Simulation, System, Vector, Warning};
use lagrangian_machines::*;

/// The tolerance of runs that are compared with references.
const FINE: f64 = 1e-11;

/// The greatest error limit that such a comparison may use.
const BOUND: f64 = 1e-5;

/// Accelerations, then multipliers, at a time and a state of coordinates, then rates.
fn solved<S: System>(system: &S, t: f64, y: &[f64]) -> Vec<f64> {
    let (q, v) = y.split_at(y.len() / 2);
    let (q, v) = (vector::<S>(q), vector::<S>(v));
    let u = system.default_inputs();
    let mut a = q.zeros_like();
    system
        .accelerations(t, &q, &v, &u, &mut a)
        .expect("regular");
    let mut lambda = vec![0.0; system.constraints().len()];
    system
        .multipliers(t, &q, &v, &u, &mut lambda)
        .expect("regular");
    [a.as_slice(), &lambda].concat()
}

/// Compares a machine's first accelerations and multipliers with expected ones.
///
/// The limit for a number has two parts: four times its change when each coordinate and rate changes by half a unit in the last
/// place, as the rounding of intermediate results has the same size; and 64 rounding units of the largest number of its kind.
fn accelerates<M: Machine>(machine: &M, t: f64, y: &[f64], expected: [&[f64]; 2]) {
    let system = machine.prepare();
    let found = solved(&system, t, y);
    let n = y.len() / 2;
    let mut limits = vec![0.0; found.len()];
    for i in 0..y.len() {
        let h = 1e-6 * (1.0 + y[i].abs());
        let at = |by: f64| {
            let mut y = y.to_vec();
            y[i] += by;
            solved(&system, t, &y)
        };
        for (limit, (a, b)) in limits.iter_mut().zip(at(h).iter().zip(at(-h))) {
            *limit += 4.0 * (a - b).abs() / (2.0 * h) * f64::EPSILON / 2.0 * (1.0 + y[i].abs());
        }
    }
    let kinds = [(0, expected[0]), (n, expected[1])];
    for (first, expected) in kinds {
        let greatest = expected.iter().fold(0.0, |m, e| f64::max(m, e.abs()));
        for (k, expected) in expected.iter().enumerate() {
            let limit = limits[first + k] + 64.0 * f64::EPSILON * greatest;
            let error = (found[first + k] - expected).abs();
            assert!(
                error <= limit && limit < 1e-8 * (1.0 + greatest),
                "{}, number {}: {} instead of {expected}, limit {limit:e}",
                machine.name(),
                first + k,
                found[first + k],
            );
        }
    }
}

/// The start from the spec, coordinates and then rates.
fn start<M: Machine>(machine: &M) -> Vec<f64> {
    numbers(&machine.prepare(), &machine.start())
}

/// Runs a machine from its start and compares it with references.
fn runs<M: Machine>(machine: &M, rows: &[Row], scales: &[f64], view: impl Fn(&[f64]) -> Vec<f64>) {
    follows(machine, &machine.start(), FINE, (rows, scales, BOUND), view);
}

/// Solves `A x = b` by Gaussian elimination with partial pivoting.
fn solve(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()));
        let pivot = pivot.expect("a row");
        a.swap(k, pivot);
        b.swap(k, pivot);
        let row = a[k].clone();
        for i in k + 1..n {
            let factor = a[i][k] / row[k];
            for (entry, above) in a[i].iter_mut().zip(&row) {
                *entry -= factor * above;
            }
            b[i] -= factor * b[k];
        }
    }
    for k in (0..n).rev() {
        let rest: f64 = (k + 1..n).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - rest) / a[k][k];
    }
    b
}

// Linkages.

/// A bar that moves in the plane: mass, inertia, the index of its angle, and its mass centre as a sum of lengths along bars.
struct Bar {
    mass: f64,
    inertia: f64,
    angle: usize,
    centre: Vec<(usize, f64)>,
}

/// Accelerations and multipliers of bars in loops, by hand. With `e(q) = (cos q, sin q)` a mass centre is `Σ cⱼ e(qⱼ)` and a
/// loop is `Σ lⱼ e(qⱼ) = const`, so
///
/// ```text
/// M_jk = Σ m c_j c_k cos(q_j − q_k) + J δ_jk,   f_j = −Σ m c_j (Σ c_k sin(q_j − q_k) q̇_k² + g cos q_j)
/// G = (−l sin q; l cos q),   γ = Σ (l cos q q̇²; l sin q q̇²)
/// ```
fn bars_in_loops(bars: &[Bar], loops: &[Vec<(usize, f64)>], g: f64, y: &[f64]) -> [Vec<f64>; 2] {
    let n = y.len() / 2;
    let (q, v) = y.split_at(n);
    let size = n + 2 * loops.len();
    let (mut a, mut b) = (vec![vec![0.0; size]; size], vec![0.0; size]);
    for bar in bars {
        a[bar.angle][bar.angle] += bar.inertia;
        for &(j, c_j) in &bar.centre {
            b[j] -= bar.mass * c_j * g * q[j].cos();
            for &(k, c_k) in &bar.centre {
                let weight = bar.mass * c_j * c_k;
                a[j][k] += weight * (q[j] - q[k]).cos();
                b[j] -= weight * (q[j] - q[k]).sin() * v[k] * v[k];
            }
        }
    }
    for (k, bars) in loops.iter().enumerate() {
        let row = n + 2 * k;
        for &(j, l) in bars {
            for (row, entry, drift) in [
                (row, -l * q[j].sin(), l * q[j].cos()),
                (row + 1, l * q[j].cos(), l * q[j].sin()),
            ] {
                a[row][j] = entry;
                // M a − Gᵀ λ = f
                a[j][row] = -entry;
                b[row] += drift * v[j] * v[j];
            }
        }
    }
    let mut solution = solve(a, b);
    let multipliers = solution.split_off(n);
    [solution, multipliers]
}

/// A random state without any symmetry.
fn anything(seed: u64, n: usize) -> Vec<f64> {
    let mut random = SplitMix::new(seed);
    (0..2 * n).map(|_| random.uniform(-1.5, 1.5)).collect()
}

#[test]
fn a_four_bar_linkage_obeys_equations_by_hand() {
    let linkage = FourBar::default();
    let FourBar {
        a,
        b,
        c,
        m1,
        m2,
        m3,
        g,
        ..
    } = linkage;
    let bar = |mass: f64, l: f64, angle: usize, before: Option<(usize, f64)>| Bar {
        mass,
        inertia: mass * l * l / 12.0,
        angle,
        centre: before.into_iter().chain([(angle, l / 2.0)]).collect(),
    };
    let bars = [
        bar(m1, a, 0, None),
        bar(m2, b, 1, Some((0, a))),
        bar(m3, c, 2, None),
    ];
    let loops = [vec![(0, a), (1, b), (2, -c)]];
    // The equations also hold off the constraints.
    for y in [start(&linkage), anything(1, 3), anything(2, 3)] {
        let [accelerations, multipliers] = bars_in_loops(&bars, &loops, g, &y);
        accelerates(&linkage, 0.0, &y, [&accelerations, &multipliers]);
    }
}

#[test]
fn five_bars_between_two_pins_obey_equations_by_hand() {
    let chain = ClosedPendulum::default();
    let ClosedPendulum { l, m, g, .. } = chain;
    let bars: Vec<Bar> = (0..5)
        .map(|i| Bar {
            mass: m,
            inertia: m * l * l / 12.0,
            angle: i,
            centre: (0..i).map(|j| (j, l)).chain([(i, l / 2.0)]).collect(),
        })
        .collect();
    let loops = [(0..5).map(|i| (i, l)).collect()];
    for y in [start(&chain), anything(3, 5), anything(4, 5)] {
        let [accelerations, multipliers] = bars_in_loops(&bars, &loops, g, &y);
        accelerates(&chain, 0.0, &y, [&accelerations, &multipliers]);
    }
}

#[test]
fn four_bars_in_a_row_obey_equations_by_hand() {
    let row = FourBars::default();
    let FourBars { l, m, g, .. } = row;
    let bar = |angle: usize, before: Option<(usize, f64)>| Bar {
        mass: m,
        inertia: m * l * l / 12.0,
        angle,
        centre: before.into_iter().chain([(angle, l / 2.0)]).collect(),
    };
    // Cranks 0 to 2, couplers 3 and 4.
    let cranks = (0..3).map(|i| bar(i, None));
    let couplers = (0..2).map(|i| bar(3 + i, Some((i, l))));
    let bars: Vec<Bar> = cranks.chain(couplers).collect();
    let windows = [0, 1].map(|i| vec![(i, l), (3 + i, l), (i + 1, -l)]);
    for y in [start(&row), anything(5, 5), anything(6, 5)] {
        let [accelerations, by_window] = bars_in_loops(&bars, &windows, g, &y);
        // The machine lists all `along` constraints first, then all `across`.
        let multipliers = [0, 2, 1, 3].map(|k| by_window[k]);
        accelerates(&row, 0.0, &y, [&accelerations, &multipliers]);
    }
}

/// While the cranks do not reach the horizontal, N windows are one pendulum with N + 1 cranks, each of inertia m l²/3, and N
/// couplers, whose mass is at the cranks' ends: `((N + 1)/3 + N) l ψ″ = −((N + 1)/2 + N) g sin ψ`.
#[test]
fn windows_that_stay_below_their_pins_swing_as_one_pendulum() {
    let row = FourBars::default();
    let windows = 2.0;
    let moment = (windows + 1.0) / 2.0 + windows;
    let inertia = (windows + 1.0) / 3.0 + windows;
    let w = (row.g * moment / (inertia * row.l)).sqrt();
    // From the bottom up to 1.2 rad: sin(ψ/2) = k sn(w t).
    let k = 0.6_f64.sin();
    let rate = 2.0 * k * w;
    let bottom = -FRAC_PI_2;
    let q = [bottom, bottom, bottom, 0.0, 0.0];
    let v = [rate, rate, rate, 0.0, 0.0];
    let rows: Vec<Row> = [0.7, 2.0, 3.1]
        .iter()
        .map(|&t| {
            let [sn, cn, _] = jacobi(w * t, k * k);
            let crank = bottom + 2.0 * (k * sn).asin();
            Row::of(t, &[crank, crank, crank, 0.0, 0.0, rate * cn])
        })
        .collect();
    let start = state(&row, 0.0, &q, &v);
    let scales = [1.0; 6];
    follows(&row, &start, FINE, (&rows, &scales, BOUND), |y| {
        y[..6].to_vec()
    });
}

/// The tolerance of runs through forks. Near horizontal cranks, rows of G vanish as sin ψ, and rounding in the loops grows as
/// 1/sin² ψ in the rates; the long steps of this tolerance pass over that.
const THROUGH_FORKS: f64 = 5e-8;

/// N-four-bar mechanism, IFToMM library of benchmarks A02, started so fast that the cranks turn over: position and velocity of
/// the first crank's end, by Jacobi's functions in 40 digits.
fn turns_over<M: Machine>(row: &M, cranks: usize, known: [[f64; 4]; 3]) {
    let rows: Vec<Row> = [1.0, 4.0, 10.0]
        .iter()
        .zip(&known)
        .map(|(t, end)| Row::of(*t, &end.repeat(cranks)))
        .collect();
    let view = |y: &[f64]| {
        let ends = (0..cranks).flat_map(|crank| {
            let (sin, cos) = y[crank].sin_cos();
            let rate = y[y.len() / 2 + crank];
            [cos, sin, -rate * sin, rate * cos]
        });
        ends.collect()
    };
    // A coarse run through ten forks is accurate to one part in a hundred.
    let scales = vec![1.0; 4 * cranks];
    let known = (&rows[..], &scales[..], 1e-2);
    follows(row, &row.start(), THROUGH_FORKS, known, view);
}

#[test]
fn one_window_turns_over_and_stays_a_parallelogram() {
    let row = InterpretedMachine::new(crate::support::library::program("four_bars", &[("N", 1)]));
    turns_over(
        &row,
        2,
        [
            [
                -0.2607126751836503563452,
                -0.9654164391590731679089,
                -6.637809496121751439211,
                1.792553970388930557664,
            ],
            [
                0.1589555042571177732168,
                0.9872857477277616476855,
                1.125395047766196994902,
                -0.181191451125319240673,
            ],
            [
                0.4783850577609705590054,
                0.8781501787912093011639,
                1.727264075547153635754,
                -0.940952179371515644193,
            ],
        ],
    );
}

#[test]
fn two_windows_turn_over_and_stay_parallelograms() {
    turns_over(
        &FourBars::default(),
        3,
        [
            [
                -0.1950203019494350936441,
                -0.9807992056621738326018,
                -6.676678036881158066163,
                1.327578325160487213913,
            ],
            [
                0.1176161023768086117149,
                0.9930591384513251009601,
                1.069039265028968636683,
                -0.1266150491667202800595,
            ],
            [
                0.3284581115408153786522,
                0.9445185381786009621613,
                1.423051470206944123281,
                -0.4948688454870429589909,
            ],
        ],
    );
}

/// Runs with every tolerance pass the fork at a crank angle of 0 on the branch on which they arrive. The reference is the end
/// of the first crank after 1 s, as in [`one_window_turns_over_and_stays_a_parallelogram`].
#[test]
fn every_tolerance_passes_a_fork() {
    let row = InterpretedMachine::new(crate::support::library::program("four_bars", &[("N", 1)]));
    let (x, y) = (-0.2607126751836503563452, -0.9654164391590731679089);
    for tolerance in [
        1e-4, 1e-5, 1e-6, 1e-7, 5e-8, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13,
    ] {
        let run = Simulation::new(&row)
            .tolerance(tolerance)
            .until(1.0)
            .run(row.start())
            .unwrap_or_else(|error| panic!("{tolerance:e}: {error}"));
        let [first, second, coupler] = run.end().q.values[..] else {
            panic!("three bars");
        };
        // Each of about ten steps errs by its tolerance, at 7 rad/s. In addition, rounding across the branch is taken for a
        // velocity of 10⁻⁷ m/s during the 0.2 s in which the fork is passed.
        let bound = 70.0 * tolerance + 2e-8;
        let (sin, cos) = first.sin_cos();
        let error = (cos - x).hypot(sin - y);
        assert!(error <= bound, "{tolerance:e}: {error:e}");
        assert!((first - second).abs() <= 1e-12 && coupler.abs() <= 1e-12);
    }
}

/// At rest where two branches cross, the branch is undetermined.
#[test]
fn a_start_at_rest_in_a_fork_is_refused() {
    let row = FourBars::default();
    let q = [0.0; 5];
    let run = Simulation::new(&row)
        .until(1.0)
        .run(state(&row, 0.0, &q, &[0.0; 5]));
    let Err(Error::Fork { constraint, t, .. }) = run else {
        panic!("no fork: {:?}", run.map(|run| *run.end()));
    };
    assert!(constraint.starts_with("along["), "{constraint}");
    assert_eq!(t, 0.0);
    // With nonzero rates, the motion takes the branch to which they are tangent.
    let rates = [-3.0, -3.0, -3.0, 0.0, 0.0];
    let run = Simulation::new(&row)
        .until(0.5)
        .energy_balance(true)
        .run(state(&row, 0.0, &q, &rates))
        .expect("it goes on");
    let end = run.end().q;
    assert!((end.crank[0] - end.crank[2]).abs() <= 1e-12);
    let balance = run.energy_balance().expect("it was asked for");
    assert!(balance.relative().abs() <= 1e-6, "{balance:?}");
}

/// The row of linkages in a single coordinate, `a`: it has no constraints and hence no forks.
fn in_one_coordinate(windows: usize) -> InterpretedMachine {
    crate::support::library::machine(&format!(
        "machine Row in plane {{
            constants {{ N = {windows} }}
            parameters {{ l: m = 1, m: kg = 1, g: m/s^2 = 9.81 }}
            coordinates {{ a: rad }}
            bodies {{
                crank[i in 0..N] {{ mass: m, inertia: m*l^2/12, at: (i*l, 0) + polar(l/2, a), angle: a }},
                coupler[i in 1..N] {{ mass: m, at: ((i - 1)*l, 0) + polar(l, a) + (l/2, 0) }},
            }}
            gravity (0, -g);
        }}"
    ))
}

/// Coarse steps pass a fork without resolving it. The equations are smooth along the branch, so the errors of such runs equal
/// those of the method on the same motion in one coordinate, where there is no fork.
#[test]
fn coarse_steps_over_forks_are_as_exact_as_in_one_coordinate() {
    let (row, pendulum) = (FourBars::default(), in_one_coordinate(2));
    let seed = 6;
    let mut random = SplitMix::new(seed);
    let runs = 60;
    // The mean logarithm of the ratio of the two errors, for energies and for positions.
    let mut ratios = [0.0, 0.0];
    for _ in 0..runs {
        let rate = -random.uniform(0.2, 3.0);
        let tolerance = 10f64.powf(random.uniform(-7.0, -4.0));
        let turned = [FRAC_PI_2, FRAC_PI_2, FRAC_PI_2, 0.0, 0.0];
        let of_row = Simulation::new(&row)
            .tolerance(tolerance)
            .until(4.0)
            .energy_balance(true)
            .run(state(&row, 0.0, &turned, &[rate, rate, rate, 0.0, 0.0]))
            .unwrap_or_else(|error| panic!("seed {seed}, {tolerance:e}, {rate}: {error}"));
        let alone = |tolerance: f64| {
            Simulation::new(&pendulum)
                .tolerance(tolerance)
                .until(4.0)
                .energy_balance(true)
                .run(state(&pendulum, 0.0, &[FRAC_PI_2], &[rate]))
                .expect("a pendulum swings")
        };
        let (exact, coarse) = (alone(1e-13), alone(tolerance));
        let place = exact.end().q.values[0];
        // The error of the reference integration is far below this.
        let floor = 1e-11;
        let energy = |balance: Option<lagrangian::EnergyBalance>| {
            balance.expect("it was asked for").relative().abs() + floor
        };
        let ratio = energy(of_row.energy_balance()) / energy(coarse.energy_balance());
        ratios[0] += ratio.ln() / f64::from(runs);
        let off = |place_found: f64| (place_found - place).abs() + floor;
        let ratio = off(of_row.end().q.crank[0]) / off(coarse.end().q.values[0]);
        ratios[1] += ratio.ln() / f64::from(runs);
    }
    // Errors scatter by about a factor of ten between runs, so their mean logarithm over 60 runs scatters by ln(10)/√60 = 0.3.
    // If a run lost its branch, or if a step were affected by the fork, most runs would be off by powers of ten.
    for ratio in ratios {
        assert!(ratio < 4.0_f64.ln(), "seed {seed}: {ratios:?}");
    }
}

/// Steps that end close to a fork begin and end with accelerations and corrections that are barely determined. Their rounding
/// must not change the motion: each fork adds at most 1e-9 to the rates, which becomes an error of position over time.
#[test]
fn steps_that_end_next_to_a_fork_lose_nothing() {
    let mut random = SplitMix::new(11);
    // Runs through three windows that contain such steps, some after many turns, and random ones.
    let machines = [2, 3].map(|windows| {
        let program = crate::support::library::program("four_bars", &[("N", windows)]);
        let cranks = usize::try_from(windows).expect("two or three") + 1;
        (
            InterpretedMachine::new(program),
            in_one_coordinate(cranks - 1),
            cranks,
        )
    });
    let known = [
        (3, -4.703, 15.22),
        (3, 3.566, 3.637),
        (3, -5.800873570712619, 12.29993076728659),
        (3, -0.15277886223440262, 10.856591556454209),
        (3, 5.751705232343893, 9.33572748812788),
    ];
    let others = (0..40).map(|_| (2, random.uniform(-6.0, 6.0), random.uniform(1.0, 15.0)));
    for (windows, rate, until) in known.into_iter().chain(others) {
        let (row, pendulum, cranks) = &machines[windows - 2];
        let cranks = *cranks;
        let list = |of_crank: f64| {
            let of = |i| if i < cranks { of_crank } else { 0.0 };
            (0..cranks + windows).map(of).collect::<Vec<f64>>()
        };
        let run = Simulation::new(row)
            .tolerance(1e-11)
            .until(until)
            .run(state(row, 0.0, &list(FRAC_PI_2), &list(-rate)))
            .unwrap_or_else(|error| panic!("{windows}, {rate}, {until}: {error}"));
        let alone = |tolerance: f64| {
            let run = Simulation::new(pendulum).tolerance(tolerance).until(until);
            let run = run.run(state(pendulum, 0.0, &[FRAC_PI_2], &[-rate]));
            run.expect("a pendulum swings").end().q.values[0]
        };
        let place = alone(1e-14);
        // The cranks are horizontal twice in each turn.
        let forks = ((place - FRAC_PI_2).abs() / std::f64::consts::PI).ceil();
        let limit = 10.0 * (alone(1e-11) - place).abs() + 1e-9 * forks * (1.0 + until);
        let off = list(place)
            .iter()
            .zip(&run.end().q.values)
            .fold(0.0, |off: f64, (known, found)| {
                off.max((known - found).abs())
            });
        assert!(
            off <= limit,
            "{windows}, {rate}, {until}: {off:e} > {limit:e}"
        );
    }
}

/// A motion that comes to rest where two branches cross turns back on its own branch, as inertia does not push it across. It
/// has just enough energy to reach the horizontal pose from below.
#[test]
fn a_motion_that_comes_to_rest_in_a_fork_turns_back() {
    let (row, pendulum) = (FourBars::default(), in_one_coordinate(2));
    // ½ I ω² = V(0) − V(−π/2); I = 3·m l²/3 + 2 m l² and V = m g l (3/2 + 2) sin a.
    let rate = (2.0 * 9.81 * 3.5 / 3.0_f64).sqrt();
    let below = [-FRAC_PI_2; 3];
    let start = [&below[..], &[0.0; 2]].concat();
    let rates = [rate, rate, rate, 0.0, 0.0];
    let known = Simulation::new(&pendulum)
        .tolerance(1e-13)
        .until(3.0)
        .run(state(&pendulum, 0.0, &[-FRAC_PI_2], &[rate]))
        .expect("a pendulum swings");
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13] {
        let run = Simulation::new(&row)
            .tolerance(tolerance)
            .until(3.0)
            .run(state(&row, 0.0, &start, &rates))
            .unwrap_or_else(|error| panic!("{tolerance:e}: {error}"));
        let end = run.end().q;
        // About twenty steps of this tolerance at 5 rad/s. In addition, rounding across the branch is taken for 10⁻⁷ m/s while
        // the fork is near: at 11 rad/s² it takes 0.3 s to stop from 0.5 rad, and 0.3 s to return.
        let bound = 100.0 * tolerance + 6e-8;
        for crank in end.crank {
            let error = (crank - known.end().q.values[0]).abs();
            assert!(error <= bound, "{tolerance:e}: {error:e}");
        }
        assert!(end.coupler.iter().all(|angle| angle.abs() <= 1e-11));
    }
}

/// Windows whose couplers are also held horizontal, so that one row of each is redundant everywhere, at forks or not.
#[test]
fn windows_held_level_as_well_move_as_one_pendulum() {
    for windows in [1, 2, 5] {
        let machine = crate::support::library::machine(&format!(
            "machine Level extends \"four_bars.machine\" {{
                constants {{ N = {windows} }}
                constraints {{ level[i in 1..N]: coupler[i] = 0 }}
            }}"
        ));
        let pendulum = in_one_coordinate(windows);
        let known = Simulation::new(&pendulum)
            .tolerance(1e-13)
            .until(2.0)
            .run(state(&pendulum, 0.0, &[FRAC_PI_2], &[-1.0]))
            .expect("a pendulum swings");
        let place = known.end().q.values[0];
        for tolerance in [1e-4, 1e-7, 1e-10, 1e-13] {
            let run = Simulation::new(&machine)
                .tolerance(tolerance)
                .until(2.0)
                .run(machine.start())
                .unwrap_or_else(|error| panic!("{windows}, {tolerance:e}: {error}"));
            let residual = run.statistics().constraint_residual;
            assert!(residual <= 1e-13, "{windows}, {tolerance:e}: {residual:e}");
            // They turn over at up to 9 rad/s, so neighbouring motions diverge by a factor of about 10 in 2 s.
            let bound = 1e3 * tolerance + 1e-11;
            let error = (run.end().q.values[0] - place).abs();
            assert!(error <= bound, "{windows}, {tolerance:e}: {error:e}");
        }
    }
}

/// The text of a parallelogram with the given constraints and start.
fn window(constraints: &[String], a: f64, rate: f64) -> String {
    let constraints = constraints.join(", ");
    format!(
        "machine Window in plane {{
            parameters {{ l: m = 1, m: kg = 1, g: m/s^2 = 9.81 }}
            coordinates {{
                a: rad = {a:?}, b: rad = {a:?}, c: rad,
                der(a): rad/s = {rate:?}, der(b): rad/s = {rate:?},
            }}
            bodies {{
                one {{ mass: m, inertia: m*l^2/12, at: polar(l/2, a), angle: a }},
                two {{ mass: 2*m, inertia: m*l^2/12, at: (l, 0) + polar(l/2, b), angle: b }},
                bar {{ mass: m, inertia: m*l^2/12, at: polar(l, a) + polar(l/2, c), angle: c }},
            }}
            gravity (0, -g);
            constraints {{ {constraints} }}
        }}"
    )
}

/// Rows that are dependent everywhere, in any order, scaled and stated twice, from any start and at every tolerance: the motion
/// is that of the single pendulum which the parallelogram is, and the total force on each bar is the same.
#[test]
fn redundant_rows_in_any_order_give_one_motion() {
    let pendulum = crate::support::library::machine(
        "machine Pendulum in plane {
            parameters { l: m = 1, m: kg = 1, g: m/s^2 = 9.81 }
            coordinates { a: rad }
            bodies {
                one { mass: m, inertia: m*l^2/12, at: polar(l/2, a), angle: a },
                two { mass: 2*m, inertia: m*l^2/12, at: (l, 0) + polar(l/2, a), angle: a },
                bar { mass: m, at: polar(l, a) + (l/2, 0) },
            }
            gravity (0, -g);
        }",
    );
    let seed = 14;
    let mut random = SplitMix::new(seed);
    for round in 0..4 {
        let (a, rate) = (random.uniform(-3.0, 3.0), random.uniform(-7.0, 7.0));
        // A parallelogram may also start with its bars in line.
        let a = if round == 0 { 0.0 } else { a };
        let mut start = pendulum.start();
        (start.q.values[0], start.v.values[0]) = (a, rate);
        let known = Simulation::new(&pendulum)
            .tolerance(1e-13)
            .until(2.0)
            .run(start)
            .expect("it runs");
        let known = known.end();
        let mut reactions: Option<Vec<f64>> = None;
        for order in 0..3 {
            let mut rows = vec![
                "along: l*(cos(a) + cos(c) - 1 - cos(b)) = 0".to_owned(),
                "across: l*(sin(a) + sin(c) - sin(b)) = 0".to_owned(),
                "level: c = 0".to_owned(),
            ];
            if order > 0 {
                let factor = random.uniform(0.1, 10.0);
                rows.push(format!(
                    "again: {factor:?}*l*(sin(a) + sin(c)) = {factor:?}*l*sin(b)"
                ));
            }
            for i in (1..rows.len()).rev() {
                rows.swap(i, (random.next() % (i as u64 + 1)) as usize);
            }
            let machine = crate::support::library::machine(&window(&rows, a, rate));
            for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13] {
                let run = Simulation::new(&machine)
                    .tolerance(tolerance)
                    .until(2.0)
                    .run(machine.start())
                    .unwrap_or_else(|error| {
                        panic!("seed {seed}, {rows:?}, {tolerance:e}: {error}")
                    });
                let residual = run.statistics().constraint_residual;
                assert!(
                    residual <= 1e-13,
                    "seed {seed}, {rows:?}, {tolerance:e}: {residual:e}"
                );
                let end = run.end();
                // Steps err by their tolerances, at rates of up to 12 rad/s, and neighbouring motions diverge in the phase
                // plane by at most exp(ω t), ω² = 1.3 g/l.
                let bound = 12.0 * 20.0 * 1.3e3 * tolerance + 1e-10;
                for (found, known) in [
                    (end.q.values[0], known.q.values[0]),
                    (end.q.values[1], known.q.values[0]),
                    (end.v.values[0], known.v.values[0]),
                ] {
                    let error = (found - known).abs();
                    assert!(
                        error <= bound,
                        "seed {seed}, {rows:?}, {tolerance:e}: {error:e}"
                    );
                }
                if tolerance > 1e-13 {
                    continue;
                }
                let seen = run.observe(2.0).expect("in the run");
                let system = machine.prepare();
                let mut matrix = vec![0.0; 3 * rows.len()];
                system.constraint_matrix(2.0, &end.q.values, &mut matrix);
                let now: Vec<f64> = (0..3)
                    .map(|j| {
                        let column = matrix.iter().skip(j).step_by(3);
                        column.zip(&seen.multipliers).map(|(g, l)| g * l).sum()
                    })
                    .collect();
                let before = reactions.get_or_insert_with(|| now.clone());
                for (now, before) in now.iter().zip(&*before) {
                    assert!(
                        (now - before).abs() <= 1e-7,
                        "seed {seed}, {rows:?}: {now} {before}"
                    );
                }
                // Rows stated twice share the load in proportion to the squares of their factors.
                let names: Vec<&str> = system.constraints().map(|row| row.name).collect();
                let of = |name: &str| names.iter().position(|known| *known == name);
                if let (Some(one), Some(two)) = (of("across"), of("again")) {
                    let g = |k: usize| matrix[3 * k + 2];
                    let (one, two) = (
                        seen.multipliers[one] * g(one),
                        seen.multipliers[two] * g(two),
                    );
                    assert!((one - two).abs() <= 1e-9 * (1.0 + one.abs()), "{one} {two}");
                }
            }
        }
    }
}

/// The crusher rolls with all three models of the material, exact and approximated, with two pairs of springs and
/// with one, at every tolerance. The distance of a mortar from the cylinder is constant, so its rate is 0 and
/// sets no scale for its residual.
#[test]
fn crushers_roll_at_every_tolerance() {
    for reading in ["crushing", "caked", "grain"] {
        for platform in [
            "approximations { theta: frozen }",
            "approximations { theta: small }",
            "remove springs.x_right; remove springs.y_right; remove dampers.x_right; remove dampers.y_right;",
        ] {
            let machine = crate::support::library::machine(&format!(
                "machine Crusher extends \"{reading}_crusher.machine\" {{ {platform} }}"
            ));
            let ends = [1e-13, 1e-10, 1e-7, 1e-4].map(|tolerance| {
                let run = Simulation::new(&machine)
                    .tolerance(tolerance)
                    .until(0.05)
                    .run(machine.start())
                    .unwrap_or_else(|error| panic!("{reading} {platform} {tolerance:e}: {error}"));
                assert!(run.statistics().constraint_residual <= 1e-13);
                // These are s1 and s2.
                let q = &run.end().q.values;
                assert!((q[3] - 0.02).abs() <= 1e-13 && (q[6] - 0.03).abs() <= 1e-13);
                (tolerance, run.end().clone())
            });
            let (_, finest) = &ends[0];
            for (tolerance, end) in &ends[1..] {
                // Coordinates that turn at 100 rad/s, over 5 to 60 steps.
                for (found, known) in end.q.values.iter().zip(&finest.q.values) {
                    let error = (found - known).abs();
                    assert!(
                        error <= 1e3 * tolerance,
                        "{reading} {platform} {tolerance:e}: {error:e}"
                    );
                }
            }
        }
    }
}

/// A ring on a circle, `s = R`, whose angle is coupled to another mass: `R φ̇ = R w + ẋ` can be integrated.
#[test]
fn a_constraint_whose_rate_is_always_0_holds() {
    let ring = crate::support::library::machine(
        "machine Ring in plane {
            parameters { R: m = 0.5, w: rad/s = 1 }
            coordinates {
                s: m = 0.5, phi: rad = 0.3, x: m = 0, der(phi): rad/s = 2, der(x): m/s = 0.5,
            }
            bodies { a { mass: 1, at: polar(s, phi) }, b { mass: 2, at: (x, 0) } }
            gravity (0, -9.81);
            constraints { ring: s^2 = R^2, drive: s*der(phi) = R*w + der(x) }
        }",
    );
    // The length has two expressions, both 1.03 whatever q1 is, so the constraint compares rounding with rounding.
    let turned = crate::support::library::machine(
        "machine Turned in plane {
            coordinates { q1: rad = 0.31, q2: m = 1.03 }
            frames { f1 = ground.turn(q1 + 1).shift(-q2, -q2), f2 = f1.shift(q2, 0) }
            bodies { a { mass: 1, inertia: 0.1, frame: f1 }, b { mass: 2, inertia: 0.2, frame: f2 } }
            gravity (0, -9.81);
            constraints { rod: norm(f2.origin - f1.origin) = 1.03 }
        }",
    );
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13] {
        let run = |machine: &InterpretedMachine| {
            let run = Simulation::new(machine)
                .tolerance(tolerance)
                .until(2.0)
                .run(machine.start())
                .unwrap_or_else(|error| panic!("{tolerance:e}: {error}"));
            assert!(run.statistics().constraint_residual <= 1e-13);
            run.end().clone()
        };
        let end = run(&ring);
        let [s, phi, x] = end.q.values[..] else {
            panic!("three coordinates");
        };
        assert!((s - 0.5).abs() <= 1e-13);
        let drive = 0.5 * (phi - 0.3) - 0.5 * end.t - x;
        assert!(
            drive.abs() <= 1e3 * tolerance + 1e-12,
            "{tolerance:e}: {drive:e}"
        );

        // A single rigid body about the origin; its energy is computed by hand.
        let end = run(&turned);
        let l2 = 1.03_f64 * 1.03;
        let energy = |q1: f64, rate: f64| {
            let (sin, cos) = (q1 + 1.0).sin_cos();
            let heights = 1.03 * (-sin - cos) + 2.0 * 1.03 * (-cos);
            0.5 * (0.3 + 2.0 * l2 + 2.0 * l2) * rate * rate + 9.81 * heights
        };
        let lost = energy(end.q.values[0], end.v.values[0]) - energy(0.31, 0.0);
        assert!(lost.abs() <= 1e4 * tolerance, "{tolerance:e}: {lost:e}");
        assert!((end.q.values[1] - 1.03).abs() <= 1e-12);
    }
}

/// Bricard mechanism, IFToMM library of benchmarks A04: the joint opposite to the origin. The published values are the 12
/// digits that DOP853 gave in a null space of G.
#[test]
fn a_bricard_mechanism_moves_although_one_constraint_is_redundant() {
    let machine = Bricard::default();
    let run = Simulation::new(&machine)
        .tolerance(FINE)
        .until(10.0)
        .run(machine.start())
        .expect("it runs");
    let redundant = |warning: &&Warning| matches!(warning, Warning::RedundantConstraint { .. });
    assert_eq!(run.warnings().iter().filter(redundant).count(), 1);
    assert_eq!(run.warnings().len(), 1);

    // Turns about y, z and x, each in the axes of the previous bar.
    let turn = |axis: usize, angle: f64, v: [f64; 3]| {
        let (sin, cos) = angle.sin_cos();
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut turned = v;
        turned[j] = cos * v[j] - sin * v[k];
        turned[k] = sin * v[j] + cos * v[k];
        turned
    };
    let opposite = |y: &[f64]| {
        let [x, yy, z] = turn(0, y[2], [0.0, 0.0, 1.0]);
        let [x, yy, z] = turn(2, y[1], [x, yy - 1.0, z]);
        turn(1, y[0], [x + 1.0, yy, z]).to_vec()
    };
    let published = [
        (
            1.0,
            [0.5105014611872216, -1.649167599394731, 0.14012311455334087],
        ),
        (
            2.0,
            [-0.9693403447777307, -1.221246894956177, 0.7542780107797571],
        ),
        (
            10.0,
            [0.9999999637980451, -1.0002690126868803, 0.9997309511299383],
        ),
    ];
    let rows = published.map(|(t, place)| Row::of(t, &place));
    runs(&machine, &rows, &[1.0; 3], opposite);
}

/// In one coordinate: `Σ w p′ (p′ θ″ + p″ θ̇² − force) = 0` summed over everything that moves, where a
/// prime is the derivative by θ.
#[test]
fn a_slider_crank_moves_as_by_its_crank_angle_alone() {
    let machine = SliderCrank::default();
    let SliderCrank {
        a,
        b,
        m1,
        m2,
        m3,
        J1,
        J2,
        g,
        ..
    } = machine;
    for (theta, rate) in [(0.4_f64, 15.0), (2.5, -7.0), (4.0, 30.0), (FRAC_PI_2, 20.0)] {
        let (sin, cos) = theta.sin_cos();
        let phi = -(a / b * sin).asin();
        let (sin_phi, cos_phi) = phi.sin_cos();
        let d_phi = -a * cos / (b * cos_phi);
        let dd_phi = (a * sin + b * sin_phi * d_phi * d_phi) / (b * cos_phi);
        let rod = [
            (
                -a * sin - b / 2.0 * sin_phi * d_phi,
                a * cos + b / 2.0 * cos_phi * d_phi,
            ),
            (
                -a * cos - b / 2.0 * (cos_phi * d_phi * d_phi + sin_phi * dd_phi),
                -a * sin - b / 2.0 * (sin_phi * d_phi * d_phi - cos_phi * dd_phi),
            ),
        ];
        let d_s = -a * sin - b * sin_phi * d_phi;
        let dd_s = -a * cos - b * cos_phi * d_phi * d_phi - b * sin_phi * dd_phi;
        // Weight, p′, p″, force per unit of weight.
        let moves = [
            (m1, -a / 2.0 * sin, -a / 2.0 * cos, 0.0),
            (m1, a / 2.0 * cos, -a / 2.0 * sin, -g),
            (J1, 1.0, 0.0, 0.0),
            (m2, rod[0].0, rod[1].0, 0.0),
            (m2, rod[0].1, rod[1].1, -g),
            (J2, d_phi, dd_phi, 0.0),
            (m3, d_s, dd_s, 0.0),
        ];
        let inertia: f64 = moves.iter().map(|(w, d, ..)| w * d * d).sum();
        let force = moves
            .iter()
            .map(|(w, d, dd, f)| w * d * (f - dd * rate * rate));
        let turning = force.sum::<f64>() / inertia;
        let expected = [
            turning,
            d_phi * turning + dd_phi * rate * rate,
            d_s * turning + dd_s * rate * rate,
        ];
        // Only the pin drives the slider: m₃ s″ = −λ of `along`.
        let along = -m3 * expected[2];
        let y = [
            theta,
            phi,
            a * cos + b * cos_phi,
            rate,
            d_phi * rate,
            d_s * rate,
        ];
        accelerates(&machine, 0.0, &y, [&expected, &[along]]);
    }
}

/// Test set for initial value problem solvers, problem II-17. The state after 0.03 s is computed in quadruple precision; the
/// published one is right to 7 to 10 digits.
#[test]
fn andrews_squeezer_is_where_a_higher_precision_says() {
    let squeezer = AndrewsSqueezer::default();
    let zero = [0.0; 5];
    let first = [&[14222.443919954114, -10666.832939965585], &zero[..]].concat();
    let pulls = [98.566870396241086, -6.1226883442556623, 0.0, 0.0, 0.0, 0.0];
    accelerates(&squeezer, 0.0, &start(&squeezer), [&first, &pulls]);
    let then = [
        15.810771195153707,
        -15.756371058411839,
        0.040822240119645803,
        -0.53473011634207956,
        0.52440996587995403,
        0.53473011634207956,
        1.0480807410419379,
        1139.9203022591062,
        -1424.3792951775401,
        11.032911910618594,
        19.29337410503204,
        0.57356991482950248,
        -19.29337410503204,
        0.32317914924913088,
    ];
    let accelerations = [
        -24631.763122874636,
        51850.319636464228,
        324102.60070757859,
        566749.42200099537,
        16743.635418345446,
        -566749.42200099537,
        9826.5078015441632,
    ];
    let multipliers = [
        199.17534810453864,
        -29.755309974971762,
        23.066543611622151,
        31.452725275771137,
        22.64249478639438,
        11.617392352611256,
    ];
    accelerates(&squeezer, 0.03, &then, [&accelerations, &multipliers]);
    let scales = [[1.0; 7], [1000.0; 7]].concat();
    runs(&squeezer, &[Row::of(0.03, &then)], &scales, <[f64]>::to_vec);
}

// Pendulums.

#[test]
fn two_particles_on_rods_move_as_the_double_pendulum() {
    let machine = ParticlePendulum::default();
    let ParticlePendulum {
        m1, m2, l1, l2, g, ..
    } = machine;
    let angles = DoublePendulum { m1, m2, l1, l2, g }.prepare();
    let places = |y: &[f64]| {
        let mut at = [0.0; 8];
        for (bar, l) in [l1, l2].into_iter().enumerate() {
            let (sin, cos) = y[bar].sin_cos();
            let rate = y[2 + bar];
            let here = [l * sin, -l * cos, l * cos * rate, l * sin * rate];
            for (k, here) in here.into_iter().enumerate() {
                let index = k / 2 * 4 + k % 2;
                at[index + 2] += here;
                if bar == 0 {
                    at[index] += here;
                }
            }
        }
        at
    };
    for y in [[0.7, -0.4, 1.5, 2.5], [2.0, 1.0, -3.0, 0.5]] {
        let a = solved(&angles, 0.0, &y);
        let mut expected = [0.0; 4];
        for (bar, l) in [l1, l2].into_iter().enumerate() {
            let (sin, cos) = y[bar].sin_cos();
            let square = y[2 + bar] * y[2 + bar];
            let here = [
                l * (a[bar] * cos - square * sin),
                l * (a[bar] * sin + square * cos),
            ];
            for (k, here) in here.into_iter().enumerate() {
                expected[2 + k] += here;
                if bar == 0 {
                    expected[k] += here;
                }
            }
        }
        // Newton's law along a rod, for the lower particle and for both together.
        let along = |k: usize, bar: usize| {
            let (sin, cos) = y[bar].sin_cos();
            expected[2 * k] * sin - (expected[2 * k + 1] + g) * cos
        };
        let upper = m1 * along(0, 0) + m2 * along(1, 0);
        let lower = m2 * along(1, 1);
        accelerates(&machine, 0.0, &places(&y), [&expected, &[upper, lower]]);
    }
    // Computed in quadruple precision, from 120° and 90° at rest.
    let references = [
        (
            1.0,
            [
                -0.41915799685328908307,
                -1.0240232284367755344,
                -3.6474612962471747954,
                -3.9320753245385417579,
            ],
        ),
        (
            5.0,
            [
                -2.0908290806302547932,
                -1.5673256764260997782,
                0.26185586226530939415,
                0.095234024159766075074,
            ],
        ),
    ];
    let rows = references.map(|(t, y)| Row::of(t, &places(&y)));
    runs(&machine, &rows, &[1.0; 8], <[f64]>::to_vec);
}

/// With arms and links of equal length the sleeve is at 2 l cos α, and Lagrange's equations for the shaft and the arms are
/// those below. In steady rotation φ̇² = (m + M) g/(m l cos α), and the links carry the sleeve.
#[test]
fn a_governor_holds_its_balls_where_watt_said() {
    let governor = FlyballGovernor::default();
    let FlyballGovernor { l, m, M, J, g, .. } = governor;
    let start = start(&governor);
    let carried = -M * g / start[1].cos();
    accelerates(&governor, 0.0, &start, [&[0.0; 3], &[carried]]);
    for (alpha, turning, swing) in [(0.8_f64, 9.0, -2.0), (0.3, 20.0, 5.0)] {
        let (sin, cos) = alpha.sin_cos();
        let shaft =
            -4.0 * m * l * l * sin * cos * swing * turning / (J + 2.0 * m * l * l * sin * sin);
        let arms = 2.0 * m * l * l * sin * cos * turning * turning
            - 4.0 * M * l * l * sin * cos * swing * swing
            - 2.0 * (m + M) * g * l * sin;
        let arms = arms / (2.0 * m * l * l + 4.0 * M * l * l * sin * sin);
        let sleeve = -2.0 * l * (sin * arms + cos * swing * swing);
        let y = [
            0.4,
            alpha,
            2.0 * l * cos,
            turning,
            swing,
            -2.0 * l * sin * swing,
        ];
        // M s″ = M g + λ cos α.
        let force = M * (sleeve - g) / cos;
        accelerates(&governor, 0.0, &y, [&[shaft, arms, sleeve], &[force]]);
    }
}

// Rolling bodies, and a body with a blade.

/// S. A. Chaplygin's closed form: v = V tanh(k t + c), ω = ω₀ sech(k t + c)/sech(c) about the blade.
#[test]
fn a_sleigh_runs_as_chaplygin_said() {
    let sleigh = ChaplyginSleigh::default();
    let ChaplyginSleigh { m, J, a, .. } = sleigh;
    let (v, w) = (0.4, 3.0);
    let turning = -m * a * v * w / (J + m * a * a);
    // The blade's point accelerates by a ω² along the blade and by v ω across it.
    let across = m * (v * w + a * turning);
    accelerates(
        &sleigh,
        0.0,
        &start(&sleigh),
        [&[a * w * w, v * w, turning], &[across]],
    );
    let row = [
        1.10284191550994550185,
        1.206351374405940494324,
        1.047655657379486969323,
    ];
    runs(&sleigh, &[Row::of(0.5, &row)], &[1.0; 3], |y| {
        vec![y[3] * y[2].cos() + y[4] * y[2].sin(), y[5], y[2]]
    });
}

/// `4 g tan θ = Ω² (6 ρ + r sin θ)`: the centre moves on a circle of radius ρ.
#[test]
fn a_coin_rolls_steadily_about_a_circle() {
    let coin = RollingCoin::default();
    let RollingCoin { m, r, g, .. } = coin;
    let (lean, radius) = (0.2_f64, 0.5);
    let omega = (4.0 * g * lean.tan() / (6.0 * radius + r * lean.sin())).sqrt();
    let track = radius + r * lean.sin();
    let y = start(&coin);
    let speed = y[5];
    assert!((speed - omega * track).abs() < 64.0 * f64::EPSILON * speed);
    // Friction provides the centripetal force on the mass centre.
    let pulls = [0.0, m * omega * omega * radius];
    let expected = [0.0, omega * speed, 0.0, 0.0, 0.0];
    accelerates(&coin, 0.0, &y, [&expected, &pulls]);
    let rows = [0.5, 2.0, TAU / omega].map(|t| {
        let angle = omega * t;
        let at = [
            track * angle.sin(),
            track * (1.0 - angle.cos()),
            angle,
            -lean,
        ];
        Row::of(t, &at)
    });
    runs(&coin, &rows, &[1.0; 4], |y| y[..4].to_vec());
}

/// It moves as a pendulum, `φ″ = −ω² sin φ` with `ω² = g/((R − r)(1 + J/(m r²)))`, and the cylinder presses on it
/// with `m (g cos φ + (R − r) φ̇²)`.
#[test]
fn a_cylinder_rolls_in_another_as_a_pendulum() {
    let machine = RollingCylinder::default();
    let RollingCylinder { m, J, R, r, g } = machine;
    let square = g / ((R - r) * (1.0 + J / (m * r * r)));
    let rolled = |phi: f64, rate: f64| {
        [
            R - r,
            phi,
            -(R - r) / r * phi,
            0.0,
            rate,
            -(R - r) / r * rate,
        ]
    };
    for (phi, rate) in [(1.0_f64, 0.0), (0.3, 11.0), (-2.0, -30.0)] {
        let swing = -square * phi.sin();
        let roll = -(R - r) / r * swing;
        let presses = m * (g * phi.cos() + (R - r) * rate * rate);
        let expected = [0.0, swing, roll];
        // No other force turns it: J θ″ = r T.
        let pulls = [presses, J * roll / r];
        accelerates(&machine, 0.0, &rolled(phi, rate), [&expected, &pulls]);
    }
    // From 1 rad at rest: the published force at the bottom, and the period.
    let rate = (2.0 * square * (1.0 - 1.0_f64.cos())).sqrt();
    let bottom = solved(&machine.prepare(), 0.0, &rolled(0.0, rate));
    assert!((bottom[3] - 2657.815591536306469246).abs() < 64.0 * f64::EPSILON * 2657.8);
    let period = 0.4081214428795833811411;
    let rows = [
        Row::of(period / 2.0, &[-1.0, 0.0]),
        Row::of(period, &[1.0, 0.0]),
    ];
    runs(&machine, &rows, &[1.0, 10.0], |y| vec![y[1], y[4]]);
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

/// Newton's and Euler's equations for the ball: with n from its centre to the point of contact and `r n × f = J ω̇`,
/// `f = m (c″ + g e_z)` the force of the bowl, the derivative of the slip `c″ + ω̇ × r n + ω × r ṅ − Ω e_z × R ṅ = 0`
/// determines the part of c″ along the bowl; the other part is that of a point on a sphere.
#[test]
fn a_ball_rolls_in_a_turning_bowl_as_newton_and_euler_say() {
    let machine = BallInBowl::default();
    let BallInBowl {
        r,
        J,
        m,
        R,
        Omega,
        g,
    } = machine;
    for (polar, along, down, spin) in [(0.7_f64, 0.9, -0.4, 3.0), (1.2, -0.5, 0.8, -7.0)] {
        let azimuth = 0.6_f64;
        let n = [
            polar.sin() * azimuth.cos(),
            polar.sin() * azimuth.sin(),
            -polar.cos(),
        ];
        let around = [-azimuth.sin(), azimuth.cos(), 0.0];
        let meridian = cross(around, n);
        let far = R - r;
        let velocity = [0, 1, 2].map(|k| along * around[k] + down * meridian[k]);
        let turned = velocity.map(|v| v / far);
        // ω × r n = Ω e_z × R n − ċ, with an arbitrary spin about n.
        let rolls = cross([0.0, 0.0, Omega], n);
        let rolls = [0, 1, 2].map(|k| (R * rolls[k] - velocity[k]) / r);
        let across = cross(n, rolls);
        let omega = [0, 1, 2].map(|k| across[k] + spin * n[k]);
        let driven = cross([0.0, 0.0, Omega], turned);
        let slipping = cross(omega, turned);
        let ratio = m * r * r / J;
        let whole = [0, 1, 2].map(|k| {
            let weight = if k == 2 { ratio * g } else { 0.0 };
            (R * driven[k] - r * slipping[k] - weight) / (1.0 + ratio)
        });
        let normal = dot(whole, n);
        let inwards = dot(velocity, velocity) / far;
        let expected = [0, 1, 2].map(|k| whole[k] - (normal + inwards) * n[k]);
        // The rates of three angles that give the ball this angular velocity.
        let (a, b, c) = (0.3_f64, -0.5_f64, 1.1);
        let ahead = omega[1] * a.sin() - omega[2] * a.cos();
        let c_rate = -ahead / b.cos();
        let rates = [
            omega[0] - c_rate * b.sin(),
            omega[1] * a.cos() + omega[2] * a.sin(),
            c_rate,
        ];
        let place = n.map(|n| far * n);
        let y = [place, [a, b, c], velocity, rates].concat();
        // The bowl exerts m (c″ + g e_z) on the ball and presses against n.
        let presses = m * (dot(expected, n) + g * n[2]);
        accelerates(&machine, 0.0, &y, [&expected, &[presses]]);
    }
}

/// Newton's and Euler's equations for the stone, about its mass centre: with r from there to the point of contact,
/// `J ω̇ = −ω × J ω + r × m (c″ + g e_z)` and `c″ = −ω̇ × r − ω × ṙ` are three equations for ω̇.
#[test]
fn a_rattleback_rolls_as_newton_and_euler_say() {
    let machine = Rattleback::default();
    let Rattleback {
        m,
        a,
        b,
        c,
        h,
        A,
        B,
        C,
        D,
        g,
    } = machine;
    for [psi, roll, pitch, w1, w2, w3] in [
        [0.4_f64, 0.2_f64, -0.05_f64, 0.7, -0.3, 4.0],
        [-1.0, -0.3, 0.1, -2.0, 1.0, -6.0],
    ] {
        // Transforms between ground axes and axes of the stone, by three turns.
        let turn = |axis: usize, angle: f64, v: [f64; 3]| {
            let (sin, cos) = angle.sin_cos();
            let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
            let mut turned = v;
            turned[j] = cos * v[j] - sin * v[k];
            turned[k] = sin * v[j] + cos * v[k];
            turned
        };
        let to_ground = |v| turn(2, psi, turn(0, roll, turn(1, pitch, v)));
        let to_stone = |v| turn(1, -pitch, turn(0, -roll, turn(2, -psi, v)));
        // All in axes of the stone: the vertical u, its rate −ω × u, r and its rate.
        let omega = [w1, w2, w3];
        let u = to_stone([0.0, 0.0, 1.0]);
        let u_rate = cross(omega, u).map(|x| -x);
        let axes = [a * a, b * b, c * c];
        let depth = (0..3).map(|k| axes[k] * u[k] * u[k]).sum::<f64>().sqrt();
        let sinks = (0..3).map(|k| axes[k] * u[k] * u_rate[k]).sum::<f64>() / depth;
        let centre = [0.0, 0.0, h];
        let arm = [0, 1, 2].map(|k| centre[k] - axes[k] * u[k] / depth);
        let arm_rate = [0, 1, 2].map(|k| -axes[k] * (u_rate[k] - u[k] * sinks / depth) / depth);
        // In rotating axes, ṙ lacks the term ω × r.
        let moved = [0, 1, 2].map(|k| arm_rate[k] + cross(omega, arm)[k]);
        let inertia = [[A, D, 0.0], [D, B, 0.0], [0.0, 0.0, C]];
        let times = |v: [f64; 3]| [0, 1, 2].map(|k| dot(inertia[k], v));
        let known = cross(omega, moved).map(|x| -x);
        let known_force = [0, 1, 2].map(|k| m * (known[k] + g * u[k]));
        let right = cross(arm, known_force);
        let gyro = cross(omega, times(omega));
        let right: Vec<f64> = (0..3).map(|k| right[k] - gyro[k]).collect();
        let column = |j: usize| {
            let mut unit = [0.0; 3];
            unit[j] = 1.0;
            let swings = cross(arm, cross(unit, arm));
            [0, 1, 2].map(|k| times(unit)[k] + m * swings[k])
        };
        let columns = [0, 1, 2].map(column);
        let matrix = (0..3)
            .map(|i| columns.iter().map(|c| c[i]).collect())
            .collect();
        let spun = solve(matrix, right);
        let spun = [spun[0], spun[1], spun[2]];
        let centre = [0, 1, 2].map(|k| known[k] - cross(spun, arm)[k]);
        let expected = to_ground(centre);
        // The rates of the angles from the components of ω in axes of the stone.
        let yaw_rate = (w3 * pitch.cos() - w1 * pitch.sin()) / roll.cos();
        let rates = [
            yaw_rate,
            w1 * pitch.cos() + w3 * pitch.sin(),
            w2 - yaw_rate * roll.sin(),
        ];
        let velocity = to_ground(cross(omega, arm).map(|x| -x));
        let height = depth - h * u[2];
        let y = [[0.1, -0.2, height], [psi, roll, pitch], velocity, rates].concat();
        let presses = m * (expected[2] + g);
        let pulls = [presses, m * expected[0], m * expected[1]];
        accelerates(&machine, 0.0, &y, [&expected, &pulls]);
    }
}

// The crushing process.

/// Accelerations at the start of the run, published in quadruple precision with section 1.4 of the reference problems; the
/// multipliers give N and T.
#[test]
fn the_crush_process_is_where_a_higher_precision_says() {
    let crusher = CrushingCrusher::default();
    let accelerations = [
        122.47388207475333,
        -2.1014679862395949,
        -25.802209047413736,
        0.0,
        1505.2346292398229,
        -148.28515611039268,
        0.0,
        -1532.8606988423476,
        111.32275815184889,
    ];
    let pulls = [
        -19788.647529422462,
        -4659.5114169975996,
        -5501.7649593015731,
        1068.6984782577492,
    ];
    accelerates(&crusher, 0.0, &start(&crusher), [&accelerations, &pulls]);
    let rows = [
        (
            0.1,
            [
                0.0098835760621522641,
                0.025502888510217456,
                0.0062979767469368069,
                0.02,
                2.5246907459559016,
                -0.17117344478978039,
                0.03,
                2.3513044157197385,
                -0.73788804363531524,
                -0.04635302437317794,
                0.45162023774516796,
                0.68942328637724182,
                0.0,
                57.637887902982456,
                -3.8664538829511752,
                0.0,
                15.873612323590791,
                -7.5677162966777942,
            ],
        ),
        (
            1.0,
            [
                -0.01122795371074941,
                0.0059928141017184123,
                0.0063906273131584144,
                0.02,
                19.479433304913943,
                -1.5274527868949044,
                0.03,
                20.644581844278193,
                -5.7784592802398596,
                0.02209628902115213,
                -1.1263786403901734,
                -0.16833675784643598,
                0.0,
                46.839068828801416,
                -3.9289292047782642,
                0.0,
                7.4620156899453391,
                -6.0647313725389402,
            ],
        ),
    ];
    let rows = rows.map(|(t, y)| Row::of(t, &y));
    runs(&crusher, &rows, &[1.0; 18], <[f64]>::to_vec);
}

/// Mortar and pestle circulate with the debalance without friction: exact relative equilibria.
#[test]
fn a_crusher_that_whirls_with_its_debalance_is_in_balance() {
    let crusher = CrushingCrusher {
        x0: 0.0,
        y0: 0.0,
        ..Default::default()
    };
    let w = 50.0 * PI;
    let branches = [
        (
            -0.01484132143656087462708,
            0.07092152937541966921706,
            [127012.0270999473189702, 104100.6746058614641298],
        ),
        (
            -0.006117517972275973630021,
            3.112379501900833201746,
            [191587.3938989559581404, 129930.8213254649197979],
        ),
    ];
    for (c, beta, [outer, inner]) in branches {
        let (sin, cos) = f64::sin_cos(beta);
        let y = [
            c * cos,
            c * sin,
            0.0,
            0.02,
            beta,
            0.0,
            0.03,
            beta,
            0.0,
            -c * w * sin,
            c * w * cos,
            0.0,
            0.0,
            w,
            -12.56637061435917295385,
            0.0,
            w,
            -44.37499623195582949328,
        ];
        let mut expected = [0.0; 9];
        expected[0] = -c * w * w * cos;
        expected[1] = -c * w * w * sin;
        accelerates(&crusher, 0.0, &y, [&expected, &[outer, 0.0, inner, 0.0]]);
    }
}

/// Material caked on the pestle makes it thicker.
#[test]
fn a_caked_pestle_is_a_thicker_one() {
    let caked = CakedCrusher::default();
    let thicker = CrushingCrusher {
        r2: caked.r2 + caked.delta,
        delta: 0.0,
        ..Default::default()
    };
    let y = start(&caked);
    let found = solved(&thicker.prepare(), 0.0, &y);
    accelerates(&caked, 0.0, &y, [&found[..9], &found[9..]]);
}

/// R. Willis's relation for a grain between pestle and mortar, and Euler's equations for these two; the grain is massless, so
/// it exerts the same friction force on both.
#[test]
fn grains_turn_pestle_and_mortar_as_willis_said() {
    let crusher = GrainCrusher::default();
    let GrainCrusher {
        R,
        r1,
        r2,
        rho,
        J1,
        J2,
        ..
    } = crusher;
    let system = crusher.prepare();
    let names: Vec<String> = system.constraints().map(|c| c.name.to_owned()).collect();
    let at = |name: &str| 9 + names.iter().position(|n| n == name).expect("a constraint");
    for seed in [7, 8] {
        let mut y = anything(seed, 9);
        // The rolling state: constant distances, and angular velocities that follow from the circulation.
        let [platform, mortar, pestle] = [y[11], y[13], y[16]];
        let turning = (R * platform - 0.02 * mortar) / r1;
        (y[3], y[12], y[14]) = (0.02, 0.0, turning);
        (y[6], y[15], y[17]) = (0.03, 0.0, ((r2 + rho) * pestle - rho * turning) / r2);
        let found = solved(&system, 0.0, &y);
        let [mortar, around, pestle] = [found[5], found[7], found[8]];
        let close = |found: f64, expected: f64, scale: f64| {
            let error = (found - expected).abs();
            assert!(
                error < 64.0 * f64::EPSILON * scale,
                "{found} instead of {expected}"
            );
        };
        let scale = rho * (mortar.abs() + 2.0 * around.abs()) + pestle.abs();
        close(r2 * (pestle - around), -rho * (mortar - around), scale);
        let grain = found[at("grain")];
        let cylinder = found[at("mortar_in_cylinder.slip")];
        close(J2 * pestle, r2 * grain, grain.abs());
        close(
            J1 * mortar,
            r1 * cylinder + rho * grain,
            cylinder.abs() + grain.abs(),
        );
    }
}

/// A change of the state by rounding is no error of a step. Cranks that had turned often, and rates near 0 beside large ones,
/// once stopped such runs.
#[test]
fn the_finest_tolerance_ends_no_run() {
    fn runs<M: Machine>(machine: &M, until: f64) {
        let run = Simulation::new(machine)
            .tolerance(1e-14)
            .energy_balance(true)
            .forget_steps()
            .until(until)
            .run(machine.start())
            .expect("it runs");
        let done = run.statistics();
        assert!(
            done.constraint_residual <= 1e-13,
            "{:e}",
            done.constraint_residual
        );
        // Each step errs by its tolerance and by the correction that the residual permits.
        let balance = run.energy_balance().expect("it was asked for");
        let limit = done.steps as f64 * 1.1e-13 * balance.exchanged;
        assert!(balance.residual().abs() <= limit, "{balance:?}");
    }
    runs(&SliderCrank::default(), 20.0);
    runs(&FourBar::default(), 60.0);
    runs(&ClosedPendulum::default(), 20.0);
    runs(&FlyballGovernor::default(), 10.0);
    runs(&ParticlePendulum::default(), 20.0);
}
