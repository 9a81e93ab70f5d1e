//! The fastest motion, tested against published numbers, closed forms, the paper's own formulas, and
//! the conditions of a minimum.
mod paper;
#[path = "../../../../tests/support/random.rs"]
#[allow(dead_code, reason = "each test uses some of it")]
mod random;
mod transcription;

use lagrangian_brachistochrone::{Brachistochrone, Guide, Problem, Unsolved};
use paper::{Machine, Paper, Print, Solved};
use random::SplitMix;
use transcription::least_times;

/// The paper's example: prisms of 32/13 and 20/13 kg, an incline of 45°, μ₁ = 0.1, μ₂ = 0.02. With g = 9.81 m/s²
/// it gives the printed digits.
const M1: f64 = 32.0 / 13.0;
const M2: f64 = 20.0 / 13.0;
const MU: [f64; 2] = [0.1, 0.02];
const G: f64 = 9.81;

/// The end, which is (12, 6) in normal coordinates.
const END: [f64; 2] = [8.0, 4.75];

/// The machine of Figure 1, from (57): reactions `N₂ = (m + M) g − m q̈₂ tan α`, `N₁/cos α = m (g − q̈₁ tan α)`.
fn prisms(friction: [f64; 2]) -> Problem {
    let floor = Guide {
        name: "floor".into(),
        along: vec![1.0, 0.0],
        load: (M1 + M2) * G,
        weights: vec![0.0, -M1],
        friction: friction[1],
    };
    // The slip is q̇₂/cos α and the reaction N₁; only their product matters, so both are taken along q₂.
    let incline = Guide {
        name: "incline".into(),
        along: vec![0.0, 1.0],
        load: M1 * G,
        weights: vec![-M1, 0.0],
        friction: friction[0],
    };
    let mass = [vec![M1 + M2, -M1], vec![-M1, 2.0 * M1]];
    let problem = Problem::new(&mass, &[0.0, -M1 * G]).unwrap();
    problem
        .with_guide(floor)
        .unwrap()
        .with_guide(incline)
        .unwrap()
}

fn prisms_by_hand() -> Machine {
    Machine {
        a: [[M1 + M2, -M1], [-M1, 2.0 * M1]],
        b: [G * MU[1] * (M1 + M2), G * M1 * MU[0]],
        c: [0.0, -M1 * G],
        d: [[0.0, -M1 * MU[1]], [-M1 * MU[0], 0.0]],
    }
}

/// ε in normal coordinates, from −π to π.
fn epsilon(motion: &Brachistochrone, part: f64) -> f64 {
    let e = motion
        .problem()
        .to_normal(&motion.after_part(part).direction);
    e[1].atan2(e[0])
}

fn constants(motion: &Brachistochrone) -> Vec<f64> {
    let c = motion.constants();
    let columns = motion.problem().normal_coordinates();
    columns
        .iter()
        .map(|k| k.iter().zip(&c).map(|(k, c)| k * c).sum())
        .collect()
}

#[track_caller]
fn close(name: &str, value: f64, expected: f64, relative: f64) {
    let error = (value - expected).abs() / expected.abs();
    assert!(
        error <= relative,
        "{name} is {value}, not {expected}: {error:.1e} off"
    );
}

// Published results and closed forms.

#[test]
fn the_papers_example_to_thirteen_digits() {
    let motion = prisms(MU).solve(&[0.0, 0.0], &END).unwrap();
    let digits = 1e-13;
    close(
        "ε₀",
        epsilon(&motion, 0.0),
        -0.413_771_376_224_754_8,
        digits,
    );
    close("ε₁", epsilon(&motion, 1.0), 0.951_221_090_127_751_6, digits);
    close("t₁", motion.time(), 1.637369712040567, digits);
    let c = constants(&motion);
    close("C₁", c[0], 0.0393521181000199, digits);
    close("C₂/C₁", c[1] / c[0], 1.467347695404256, digits);
    let end = motion.after_part(1.0);
    let twice_kinetic: f64 = motion
        .problem()
        .to_normal(&end.v)
        .iter()
        .map(|v| v * v)
        .sum();
    close("V(t₁)", twice_kinetic.sqrt(), 14.31401846415505, digits);
    // The least reactions along the motion, computed outside of this project from differences of (42) with (31) and (57);
    // nested differences have seven digits.
    let reactions = |guide: usize| {
        let moments = (0..=2000).map(|k| motion.after_part(f64::from(k) / 2000.0));
        let least = moments.map(|moment| moment.contacts[guide].reaction);
        least.fold(f64::INFINITY, f64::min)
    };
    close("N₂", reactions(0), 22.9868432, 1e-6);
    close("N₁/cos α", reactions(1), 5.5393470, 1e-6);
    assert_eq!(motion.violations(), vec![]);
}

/// A polyline of N pieces is slower than the fastest motion; for large N the relative difference is proportional to N⁻².
#[test]
fn polylines_whose_time_is_made_least_converge_to_the_fastest_motion() {
    for friction in [MU, [0.0, 0.0], [0.3, 0.2]] {
        let [incline, floor] = friction;
        let machine = Machine {
            b: [G * floor * (M1 + M2), G * M1 * incline],
            d: [[0.0, -M1 * floor], [-M1 * incline, 0.0]],
            ..prisms_by_hand()
        };
        let motion = prisms(friction).solve(&[0.0, 0.0], &END).unwrap();
        let slower = least_times(&machine, END, 3).into_iter();
        let slower: Vec<f64> = slower.map(|time| time - motion.time()).collect();
        assert!(
            slower.iter().all(|by| *by > 0.0),
            "{friction:?}: {slower:?}"
        );
        let ratio = slower[2] / slower[3];
        assert!((3.9..4.1).contains(&ratio), "{friction:?}: {slower:?}");
    }
}

#[test]
fn normal_coordinates_of_the_example_are_the_papers() {
    let problem = prisms(MU);
    let expected = [[0.5, 0.5], [1.0 / 3.0, -5.0 / 24.0]];
    for (column, expected) in problem.normal_coordinates().iter().zip(expected) {
        close("k¹", column[0], expected[0], 4.0 * f64::EPSILON);
        close("k²", column[1], expected[1], 4.0 * f64::EPSILON);
    }
    let there = problem.from_normal(&[12.0, 6.0]);
    close("q¹", there[0], END[0], 4.0 * f64::EPSILON);
    close("q²", there[1], END[1], 4.0 * f64::EPSILON);
}

/// x points to the right, y down. On a wire, a turn at the rate ε̇ adds the centripetal force to the normal force: ρ = −μ.
fn ashby(mu: f64) -> Problem {
    let problem = Problem::new(&[vec![1.0, 0.0], vec![0.0, 1.0]], &[0.0, -G]).unwrap();
    problem
        .with_friction(&[mu * G, 0.0], &[vec![0.0, -mu], vec![mu, 0.0]])
        .unwrap()
}

#[test]
fn a_particle_on_a_rough_wire_is_ashbys() {
    let motion = ashby(0.1).solve(&[0.0, 0.0], &[1.0, 1.0]).unwrap();
    close("t₁", motion.time(), 0.610344506565018, 1e-13);
    let end = motion.after_part(1.0).v;
    close("ε₁", end[1].atan2(end[0]), 0.340360557240134, 1e-13);
    let c = motion.constants();
    close("k", c[1] / c[0], 0.245450167362057, 1e-13);
    // Ashby's closed form of the speed during the motion.
    let (mu, k) = (0.1_f64, c[1] / c[0]);
    for part in [0.2, 0.5, 0.9] {
        let moment = motion.after_part(part);
        let e = moment.v[1].atan2(moment.v[0]);
        let (sin2, cos2) = (2.0 * e).sin_cos();
        let below = 1.0 + mu * mu + mu * mu * cos2 - mu * sin2 + k * (mu * cos2 + mu * mu * sin2);
        let speed = (1.0 + mu * mu) * e.cos() / (c[0] * below);
        close("V", moment.v[0].hypot(moment.v[1]), speed, 1e-13);
    }
}

/// The parameter `θ` with `(θ − sin θ)/(1 − cos θ) = x/y`, and the time `θ √(R/g)`.
fn cycloid(x: f64, y: f64, g: f64) -> f64 {
    let (mut low, mut high) = (0.0_f64, std::f64::consts::TAU);
    for _ in 0..200 {
        let theta = (low + high) / 2.0;
        if (theta - theta.sin()) / (1.0 - theta.cos()) < x / y {
            low = theta
        } else {
            high = theta
        }
    }
    low * (y / (1.0 - low.cos()) / g).sqrt()
}

#[test]
fn without_friction_the_plane_cycloid() {
    for (x, y) in [(1.0, 1.0), (3.0, 1.0), (0.2, 1.0), (-5.0, 0.3)] {
        let motion = ashby(0.0)
            .solve(&[0.5, -2.0], &[0.5 + x, -2.0 + y])
            .unwrap();
        close("time", motion.time(), cycloid(x.abs(), y, G), 1e-13);
        assert_eq!(
            motion.best_among_turns(),
            [-std::f64::consts::PI, std::f64::consts::PI]
        );
    }
}

/// In the metric of the mass matrix, a problem in any number of coordinates is the plane of the steepest descent and one direction across it.
#[test]
fn without_friction_the_cycloid_in_any_number_of_coordinates() {
    let mut random = SplitMix::new(6);
    for n in [2, 3, 5, 8] {
        let root: Vec<Vec<f64>> = (0..n)
            .map(|_| (0..n).map(|_| random.uniform(-1.0, 1.0)).collect())
            .collect();
        let mass: Vec<Vec<f64>> = (0..n)
            .map(|i| {
                let entry = |j: usize| (0..n).map(|k| root[i][k] * root[j][k]).sum::<f64>();
                (0..n)
                    .map(|j| entry(j) + f64::from(u8::from(i == j)))
                    .collect()
            })
            .collect();
        // The slope a e₀ makes e₀ the direction of steepest descent.
        let slope: Vec<f64> = mass.iter().map(|row| -G * row[0]).collect();
        let problem = Problem::new(&mass, &slope).unwrap();
        let mut way: Vec<f64> = (0..n).map(|_| random.uniform(0.0, 1.0)).collect();
        way[0] += 1.0
            + mass[0]
                .iter()
                .zip(&way)
                .map(|(a, x)| (a * x).abs())
                .sum::<f64>();
        let length = |x: &[f64]| {
            x.iter()
                .zip(&mass)
                .map(|(x_i, row)| x_i * row.iter().zip(x).map(|(a, x)| a * x).sum::<f64>())
                .sum::<f64>()
        };
        let down = mass[0].iter().zip(&way).map(|(a, x)| a * x).sum::<f64>() / mass[0][0].sqrt();
        let across = (length(&way) - down * down).sqrt();
        let motion = problem.solve(&vec![0.0; n], &way).unwrap();
        // If the component across is small, the square root loses digits.
        close(
            "time",
            motion.time(),
            cycloid(across, down, G * mass[0][0].sqrt()),
            1e-12,
        );
        let end = motion.after_part(1.0).q;
        let off = end
            .iter()
            .zip(&way)
            .map(|(q, x)| (q - x).abs())
            .fold(0.0, f64::max);
        assert!(off < 1e-13 * down, "{off}");
    }
}

/// The paper's formulas, corrected, for machines with every kind of friction.
#[test]
fn the_papers_formulas_give_the_same_for_any_machine() {
    let mut random = SplitMix::new(1975);
    let mut compared = 0;
    for case in 0..60 {
        let mut number = |size: f64| random.uniform(-size, size);
        let (x, y) = (2.0 + number(1.0), 2.0 + number(1.0));
        let a12 = number(1.0);
        let machine = Machine {
            a: [[x, a12], [a12, y]],
            b: [number(2.0), number(2.0)],
            c: [number(9.0), number(9.0)],
            d: [[number(0.4), number(0.4)], [number(0.4), number(0.4)]],
        };
        let to = [number(5.0), number(5.0)];
        let rows = |m: [[f64; 2]; 2]| [m[0].to_vec(), m[1].to_vec()];
        let problem = Problem::new(&rows(machine.a), &machine.c).unwrap();
        let problem = problem.with_friction(&machine.b, &rows(machine.d)).unwrap();
        let Ok(motion) = problem.solve(&[0.0, 0.0], &to) else {
            continue;
        };
        let paper = Paper::new(&machine, Print::Mended);
        let goal: [f64; 2] = problem.to_normal(&to).try_into().unwrap();
        let Some(Solved {
            start,
            end,
            time,
            c,
        }) = paper.solve(goal)
        else {
            panic!("case {case}: the paper's formulas find nothing, {machine:?} {to:?}");
        };
        compared += 1;
        // The paper's quadrature has 217 terms with factors that cancel near the start, and ε₁ comes from 60 bisections.
        let digits = 1e-9;
        close("time", motion.time(), time, digits);
        let turn = |x: f64| (x + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU);
        close("ε₀", turn(epsilon(&motion, 0.0)), turn(start), digits);
        close("ε₁", turn(epsilon(&motion, 1.0)), turn(end), digits);
        let ours = constants(&motion);
        close("C₁", ours[0], c[0], 1e-8);
        close("C₂", ours[1], c[1], 1e-8);
        for part in [0.25, 0.75] {
            let moment = motion.after_part(part);
            let mut e = epsilon(&motion, part);
            e += ((start - e) / std::f64::consts::TAU).round() * std::f64::consts::TAU;
            let v = problem.to_normal(&moment.v);
            close("V", v[0].hypot(v[1]), paper.speed(e, end)[0] / c[0], 1e-7);
            close("λ", moment.multiplier, paper.multiplier(e, end), 1e-7);
        }
    }
    assert!(
        compared >= 20,
        "only {compared} of the machines have a fastest motion"
    );
}

#[test]
fn formulas_as_printed_give_another_end_or_none() {
    let mended = Paper::new(&prisms_by_hand(), Print::Mended)
        .solve([12.0, 6.0])
        .unwrap();
    close("ε₁", mended.end, 0.951_221_090_127_751_6, 1e-12);
    close("t₁", mended.time, 1.637369712040567, 1e-12);
    for print in [
        Print::Eq45,
        Print::Eq48,
        Print::Eq49,
        Print::Eq50,
        Print::Eq53,
    ] {
        let printed = Paper::new(&prisms_by_hand(), print).solve([12.0, 6.0]);
        let same = printed.is_some_and(|printed| (printed.end - mended.end).abs() < 1e-5);
        assert!(
            !same,
            "{print:?} as printed gives the printed ε₁: {printed:?}"
        );
    }
    // Only the numerator of (44) enters the end condition, and that is right; λ as printed violates the first integral
    // (39), 1 − ϑ₂ V + λ ψ = 0, as soon as the motion turns.
    let motion = prisms(MU).solve(&[0.0, 0.0], &END).unwrap();
    let e = epsilon(&motion, 0.5);
    let printed = Paper::new(&prisms_by_hand(), Print::Eq44).multiplier(e, mended.end);
    assert!((printed / motion.after_part(0.5).multiplier - 1.0).abs() > 1e-3);
}

/// (57), (59) and (60) as printed describe another machine.
#[test]
fn the_example_as_printed_is_another_machine() {
    let solve = |machine: &Machine| Paper::new(machine, Print::Mended).solve([12.0, 6.0]);
    let far = |printed: Option<Solved>| {
        printed.is_none_or(|printed| (printed.end - 0.951221).abs() > 1e-5)
    };
    // (57): Q₁ = −μ₂ (m + M) g − m q̈₂ tan α, without the bracket.
    let mut machine = prisms_by_hand();
    machine.d[0][1] = M1;
    assert!(far(solve(&machine)));
    // (59): φ₂ = d₁₂ q̇₁ has the opposite sign.
    let mut machine = prisms_by_hand();
    machine.d[0][1] = -machine.d[0][1];
    assert!(far(solve(&machine)));
}

// Necessary conditions of a minimum.

fn examples() -> Vec<Brachistochrone> {
    let oblique = Problem::new(&[vec![2.0, 0.7], vec![0.7, 1.5]], &[-4.0, -7.0])
        .unwrap()
        .with_friction(&[0.5, 0.8], &[vec![0.1, -0.3], vec![0.2, 0.15]])
        .unwrap();
    vec![
        prisms(MU).solve(&[0.0, 0.0], &END).unwrap(),
        ashby(0.1).solve(&[0.0, 0.0], &[1.0, 1.0]).unwrap(),
        ashby(0.3).solve(&[0.0, 0.0], &[-0.2, 1.0]).unwrap(),
        oblique.solve(&[1.0, 2.0], &[2.0, 2.5]).unwrap(),
        oblique.solve(&[0.0, 0.0], &[-0.4, 3.0]).unwrap(),
    ]
}

/// `a`, `b + c` and `d` of the examples, typed in again.
type Numbers = ([[f64; 2]; 2], [f64; 2], [[f64; 2]; 2]);

fn numbers() -> Vec<Numbers> {
    let wire = |mu: f64| -> Numbers {
        (
            [[1.0, 0.0], [0.0, 1.0]],
            [mu * G, -G],
            [[0.0, -mu], [mu, 0.0]],
        )
    };
    let prisms = prisms_by_hand();
    let r = [prisms.b[0] + prisms.c[0], prisms.b[1] + prisms.c[1]];
    let oblique: Numbers = (
        [[2.0, 0.7], [0.7, 1.5]],
        [-3.5, -6.2],
        [[0.1, -0.3], [0.2, 0.15]],
    );
    vec![
        (prisms.a, r, prisms.d),
        wire(0.1),
        wire(0.3),
        oblique,
        oblique,
    ]
}

fn times(m: [[f64; 2]; 2], x: &[f64]) -> [f64; 2] {
    m.map(|row| row[0] * x[0] + row[1] * x[1])
}

#[test]
fn energy_goes_by_its_principle_and_control_forces_do_no_work() {
    for (motion, (a, r, d)) in examples().iter().zip(numbers()) {
        for step in 0..=50 {
            let m = motion.after_part(f64::from(step) / 50.0);
            let (inertia, friction) = (times(a, &m.a), times(d, &m.a));
            let u = [0, 1].map(|i| inertia[i] + friction[i] + r[i]);
            let size = (0..2)
                .map(|i| (inertia[i] * m.v[i]).abs() + (r[i] * m.v[i]).abs())
                .sum::<f64>();
            let work = u[0] * m.v[0] + u[1] * m.v[1];
            // About ten products and sums of this size.
            assert!(
                work.abs() <= 64.0 * f64::EPSILON * size,
                "{work} W of {size} W"
            );
            for (ours, u) in m.control.iter().zip(u) {
                assert!(
                    (ours - u).abs() <= 64.0 * f64::EPSILON * (1.0 + u.abs() + size),
                    "{ours} {u}"
                );
            }
        }
    }
}

/// Accelerations are derivatives of velocities, and velocities of positions, also in the times: differences with step h
/// have errors of order h².
#[test]
fn places_velocities_accelerations_and_times_belong_together() {
    for motion in examples() {
        let h = 1e-5 * motion.time();
        for step in 1..10 {
            let time = motion.time() * f64::from(step) / 10.0;
            let [before, now, after] = [time - h, time, time + h].map(|t| motion.at(t));
            close("t", now.time, time, 1e-14);
            let scale = now
                .a
                .iter()
                .chain(&now.v)
                .map(|x| x.abs())
                .fold(1.0, f64::max);
            for i in 0..2 {
                let rate = |x: fn(&lagrangian_brachistochrone::Moment) -> &Vec<f64>| {
                    (x(&after)[i] - x(&before)[i]) / (2.0 * h)
                };
                assert!((rate(|m| &m.q) - now.v[i]).abs() < 1e-8 * scale);
                assert!((rate(|m| &m.v) - now.a[i]).abs() < 1e-8 * scale);
            }
        }
        let off = motion
            .at(motion.time())
            .q
            .iter()
            .zip(motion.ends()[1])
            .map(|(q, end)| (q - end).abs())
            .sum::<f64>();
        assert!(off < 1e-13, "{off}");
    }
}

/// The first integral (39) is 0, and Euler's equations (22) hold, which in any coordinates are
/// `λ [(d − dᵀ) v̇ + r] − C − λ̇ (a + d)ᵀ v = 0`, with λ for the energy equation. One of the equations determines λ̇, and
/// the other must be satisfied by it.
#[test]
fn first_integral_and_eulers_equations_hold() {
    for (motion, (a, r, d)) in examples().iter().zip(numbers()) {
        let c = motion.constants();
        let energy_multiplier = |m: &lagrangian_brachistochrone::Moment| {
            let momentum = times(a, &m.v);
            m.multiplier / (momentum[0] * m.v[0] + momentum[1] * m.v[1]).sqrt()
        };
        for step in 1..=50 {
            let m = motion.after_part(f64::from(step) / 50.0);
            let lambda = energy_multiplier(&m);
            let ahead = c[0] * m.v[0] + c[1] * m.v[1];
            let first = 1.0 - ahead + lambda * (r[0] * m.v[0] + r[1] * m.v[1]);
            assert!(first.abs() < 1e-10, "first integral {first}");
            let skew = [(d[0][1] - d[1][0]) * m.a[1], (d[1][0] - d[0][1]) * m.a[0]];
            let left = [0, 1].map(|i| lambda * (skew[i] + r[i]) - c[i]);
            let p = [0, 1].map(|i| (0..2).map(|j| (a[j][i] + d[j][i]) * m.v[j]).sum::<f64>());
            let across = (left[0] * p[1] - left[1] * p[0]) / (c[0].hypot(c[1]) * p[0].hypot(p[1]));
            assert!(across.abs() < 1e-10, "Euler's equations {across}");
            if step < 50 {
                let rate = (left[0] * p[0] + left[1] * p[1]) / (p[0] * p[0] + p[1] * p[1]);
                let h = 1e-5 * m.time.min(motion.time() - m.time);
                let [before, after] =
                    [m.time - h, m.time + h].map(|t| energy_multiplier(&motion.at(t)));
                let error = (after - before) / (2.0 * h) / rate - 1.0;
                assert!(error.abs() < 1e-6, "λ̇ {error}");
            }
        }
        assert!(
            motion.after_part(1.0).multiplier.abs() < 1e-14,
            "λ(t₁) is not 0"
        );
    }
}

/// Driven by the control forces alone, the machine arrives at the end at the predicted time. `(a + d) q̈ = u(t) − r` is
/// integrated by the classical Runge–Kutta method, whose error falls by 16 when steps are halved.
#[test]
fn forward_simulation_under_the_control_forces_arrives() {
    for (motion, (a, r, d)) in examples().iter().zip(numbers()) {
        let m = [0, 1].map(|i| [0, 1].map(|j| a[i][j] + d[i][j]));
        let det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
        let acceleration = |t: f64| {
            let u = motion.at(t).control;
            let f = [u[0] - r[0], u[1] - r[1]];
            [
                (m[1][1] * f[0] - m[0][1] * f[1]) / det,
                (m[0][0] * f[1] - m[1][0] * f[0]) / det,
            ]
        };
        let arrive = |steps: u32| {
            let h = motion.time() / f64::from(steps);
            let mut q = [motion.ends()[0][0], motion.ends()[0][1]];
            let mut v = [0.0; 2];
            for step in 0..steps {
                let t = h * f64::from(step);
                let [a0, a1, a2] = [t, t + h / 2.0, t + h].map(acceleration);
                for i in 0..2 {
                    q[i] += h * v[i] + h * h / 6.0 * (a0[i] + 2.0 * a1[i]);
                    v[i] += h / 6.0 * (a0[i] + 4.0 * a1[i] + a2[i]);
                }
            }
            let end = motion.ends()[1];
            (q[0] - end[0]).hypot(q[1] - end[1])
        };
        let (coarse, fine) = (arrive(100), arrive(200));
        assert!(fine < 1e-6 && fine < coarse / 8.0, "{coarse} {fine}");
    }
}

/// Every other path takes longer, by the square of its deviation. The directions `x(σ)` of (30) are changed by two bumps
/// that keep the end in place; the speed follows from the energy equation `V̇ = −ψ/φ − ρ/φ V ε̇`.
#[test]
fn every_neighbouring_way_takes_longer() {
    let mu = 0.1;
    let motion = ashby(mu).solve(&[0.0, 0.0], &[1.0, 1.0]).unwrap();
    // With W = V e^{ρ ε}, dW²/ds = −2 ψ e^{2 ρ ε}; s = L σ² removes the square root at the start.
    let steps = 2000;
    let angles: Vec<(f64, f64)> = {
        // Directions as a function of arc length, interpolated linearly between 20000 instants.
        let mut way = vec![(0.0, std::f64::consts::FRAC_PI_2)];
        let mut last = vec![0.0, 0.0];
        for k in 1..=20000 {
            let m = motion.after_part(f64::from(k) / 20000.0);
            let length = way[way.len() - 1].0 + (m.q[0] - last[0]).hypot(m.q[1] - last[1]);
            way.push((length, m.v[1].atan2(m.v[0])));
            last = m.q;
        }
        way
    };
    let whole = angles[angles.len() - 1].0;
    let direction = |sigma: f64| {
        let s = whole * sigma * sigma;
        let after = angles
            .partition_point(|(length, _)| *length < s)
            .clamp(1, angles.len() - 1);
        let ((s0, e0), (s1, e1)) = (angles[after - 1], angles[after]);
        e0 + (e1 - e0) * (s - s0) / (s1 - s0)
    };
    let base: Vec<f64> = (0..=2 * steps)
        .map(|k| direction(f64::from(k) / f64::from(2 * steps)))
        .collect();
    // The end and the time of a path of the given length: Simpson's rule in σ, and the trapezoidal rule for W².
    let travel = |e: &[f64], length: f64| {
        let h = 1.0 / f64::from(2 * steps);
        let push = |k: usize| {
            let sigma = h * k as f64;
            2.0 * G
                * (e[k].sin() - mu * e[k].cos())
                * (-2.0 * mu * e[k]).exp()
                * 2.0
                * sigma
                * length
        };
        let (mut w2, mut x, mut y, mut t) = (0.0, 0.0, 0.0, 0.0);
        let mut before = 0.0;
        for k in 0..e.len() {
            let sigma = h * k as f64;
            if k > 0 {
                w2 += h / 2.0 * (push(k - 1) + push(k));
            }
            let v = (w2 * (2.0 * mu * e[k]).exp()).sqrt();
            let slow = match k {
                0 => 2.0 * length / (2.0 * G * length * (e[0].sin() - mu * e[0].cos())).sqrt(),
                _ => 2.0 * sigma * length / v,
            };
            let weight = if k == 0 || k + 1 == e.len() {
                0.5 * h
            } else {
                h
            };
            x += weight * 2.0 * sigma * length * e[k].cos();
            y += weight * 2.0 * sigma * length * e[k].sin();
            t += weight * slow;
            before = slow;
        }
        let _ = before;
        [x, y, t]
    };
    let bump =
        |k: usize, n: f64| (std::f64::consts::PI * n * k as f64 / f64::from(2 * steps)).sin();
    let time = |eta: f64, n: f64| {
        // Two unknowns, the length and a second bump, bring the end back to (1, 1) by Newton's method with differences.
        let (mut length, mut mend) = (whole, 0.0);
        let changed = |mend: f64| -> Vec<f64> {
            let e = base.iter().enumerate();
            e.map(|(k, e)| e + eta * bump(k, n) + mend * bump(k, 1.0))
                .collect()
        };
        for _ in 0..6 {
            let [x, y, _] = travel(&changed(mend), length);
            let h = 1e-6;
            let by_mend = travel(&changed(mend + h), length);
            let (xm, ym) = ((by_mend[0] - x) / h, (by_mend[1] - y) / h);
            let (xl, yl) = (x / length, y / length);
            let det = xl * ym - xm * yl;
            let (fx, fy) = (1.0 - x, 1.0 - y);
            length += (fx * ym - xm * fy) / det;
            mend += (xl * fy - fx * yl) / det;
        }
        travel(&changed(mend), length)[2]
    };
    for n in [2.0, 3.0, 5.0] {
        let [less, none, more] = [-0.05, 0.0, 0.05].map(|eta| time(eta, n));
        // 4000 steps of the trapezoidal rule have an error of 1e-7.
        assert!(
            (none / motion.time() - 1.0).abs() < 1e-6,
            "{none} {}",
            motion.time()
        );
        assert!(less > none && more > none, "bump {n}: {less} {none} {more}");
        // The time is stationary: its odd part in η is of third order.
        assert!(
            (more - less).abs() < 0.2 * (more + less - 2.0 * none),
            "bump {n}: {less} {none} {more}"
        );
    }
}

// Problems without a solution, and problems at the limit of having one.

#[test]
fn a_way_straight_down_takes_the_time_of_a_fall() {
    for mu in [0.0, 0.1] {
        let motion = ashby(mu).solve(&[0.0, 0.0], &[0.0, 2.0]).unwrap();
        close("time", motion.time(), (4.0 / G).sqrt(), 4.0 * f64::EPSILON);
        let middle = motion.at(motion.time() / 2.0);
        close("half the time", middle.q[1], 0.5, 1e-14);
        close("C", motion.constants()[1], 1.0 / (4.0 * G).sqrt(), 1e-14);
        // Almost straight: friction takes μ g x of the energy g y, and all else is of second order.
        let beside = ashby(mu).solve(&[0.0, 0.0], &[1e-9, 2.0]).unwrap();
        let longer = 1.0 + mu * 1e-9 / 4.0;
        close("time", beside.time(), motion.time() * longer, 1e-14);
        let end = beside.after_part(1.0).q;
        assert!((end[0] - 1e-9).abs() < 8.0 * f64::EPSILON, "{}", end[0]); // on a path of 2 m
    }
}

#[test]
fn one_coordinate_slides_straight() {
    let guide = |friction| Guide {
        name: "plane".into(),
        along: vec![1.0],
        load: 8.0,
        weights: vec![0.0],
        friction,
    };
    let slide = |friction: f64, to: f64| {
        let problem = Problem::new(&[vec![1.0]], &[-5.0]).unwrap();
        problem
            .with_guide(guide(friction))
            .unwrap()
            .solve(&[0.0], &[to])
    };
    close(
        "time",
        slide(0.5, 3.0).unwrap().time(),
        6.0_f64.sqrt(),
        4.0 * f64::EPSILON,
    );
    assert_eq!(
        slide(0.7, 3.0).unwrap_err(),
        Unsolved::Held {
            descent: 15.0,
            friction: 0.7 * 8.0 * 3.0
        }
    );
    assert_eq!(
        slide(0.5, -3.0).unwrap_err(),
        Unsolved::NotBelow { rise: 15.0 }
    );
}

#[test]
fn a_level_end_is_reached_without_friction_only() {
    let arch = ashby(0.0).solve(&[0.0, 0.0], &[1.0, 0.0]).unwrap();
    close(
        "time",
        arch.time(),
        std::f64::consts::TAU * (1.0 / std::f64::consts::TAU / G).sqrt(),
        1e-14,
    );
    assert!(arch.constants().iter().all(|c| !c.is_finite() || *c == 0.0));
    assert!(matches!(
        ashby(0.1).solve(&[0.0, 0.0], &[1.0, 0.0]),
        Err(Unsolved::NotBelow { .. })
    ));
    assert!(matches!(
        ashby(0.1).solve(&[0.0, 0.0], &[1.0, 0.05]),
        Err(Unsolved::Held { .. })
    ));
    assert!(matches!(
        ashby(0.1).solve(&[0.0, 0.0], &[0.0, -1.0]),
        Err(Unsolved::NotBelow { .. })
    ));
}

#[test]
fn what_has_no_answer_says_why() {
    let flat = Problem::new(&[vec![1.0]], &[0.0]).unwrap();
    assert_eq!(flat.solve(&[1.0], &[1.0]).unwrap_err(), Unsolved::SameEnds);
    assert_eq!(
        flat.solve(&[1.0], &[2.0]).unwrap_err(),
        Unsolved::NothingDrives
    );
    assert!(matches!(
        flat.solve(&[1.0, 2.0], &[2.0]),
        Err(Unsolved::Size { .. })
    ));
    assert!(matches!(
        flat.solve(&[f64::NAN], &[2.0]),
        Err(Unsolved::NotFinite { .. })
    ));
    assert!(matches!(
        Problem::new(&[vec![-1.0]], &[0.0]),
        Err(Unsolved::NoInertia { .. })
    ));
    assert!(matches!(Problem::new(&[], &[]), Err(Unsolved::Size { .. })));
    let lopsided = [vec![1.0, 0.5], vec![0.4, 1.0]];
    assert!(matches!(
        Problem::new(&lopsided, &[0.0, 1.0]),
        Err(Unsolved::NotSymmetric { .. })
    ));
    let jammed = ashby(0.0)
        .with_friction(&[0.0, 0.0], &[vec![-2.0, 0.0], vec![0.0, 0.0]])
        .unwrap();
    assert!(matches!(
        jammed.solve(&[0.0, 0.0], &[1.0, 1.0]),
        Err(Unsolved::FrictionOutweighsInertia { .. })
    ));
    // Friction so strong that the path avoids it by turning too far.
    let sharp = ashby(1.2).solve(&[0.0, 0.0], &[-1.0, 0.05]);
    assert!(
        matches!(sharp, Err(Unsolved::TurnsTooFar { .. })),
        "{sharp:?}"
    );
}

/// With three coordinates and a skew `d` there is no fastest motion: going round a cone of directions, in no time,
/// multiplies the speed by the energy equation `V̇ = −V Ω(e, ė)`.
#[test]
fn loops_of_directions_feed_where_friction_is_skew() {
    let d = [vec![0.0, 0.1, 0.0], vec![-0.1, 0.0, 0.0], vec![0.0; 3]];
    let one = [
        vec![1.0, 0.0, 0.0],
        vec![0.0, 1.0, 0.0],
        vec![0.0, 0.0, 1.0],
    ];
    let problem = Problem::new(&one, &[0.0, 0.0, -G])
        .unwrap()
        .with_friction(&[0.0; 3], &d)
        .unwrap();
    let found = problem.solve(&[0.0; 3], &[1.0, 0.0, 1.0]).unwrap_err();
    assert_eq!(
        found,
        Unsolved::LoopsFeed {
            coordinates: [0, 1],
            skew: 0.1
        }
    );
    let tilt = 0.3_f64.sin();
    let steps = 10_000;
    let loops = |sense: f64| {
        let mut log_speed = 0.0;
        for k in 0..steps {
            let (sin, cos) =
                (sense * std::f64::consts::TAU * f64::from(k) / f64::from(steps)).sin_cos();
            let (e, by) = (
                [tilt * cos, tilt * sin],
                [-tilt * sin * sense, tilt * cos * sense],
            );
            let power = e[0] * d[0][1] * by[1] + e[1] * d[1][0] * by[0];
            log_speed -= power * std::f64::consts::TAU / f64::from(steps);
        }
        log_speed
    };
    // ± 2π Ω sin² of the tilt: in one sense speed is lost, in the other it is gained.
    let expected = std::f64::consts::TAU * 0.1 * tilt * tilt;
    close("one way", loops(-1.0), expected, 1e-12);
    close("the other way", loops(1.0), -expected, 1e-12);
    // Symmetric friction only adds to the inertia.
    let even = [vec![0.5, 0.1, 0.0], vec![0.1, 0.0, 0.0], vec![0.0; 3]];
    let problem = Problem::new(&one, &[0.0, 0.0, -G])
        .unwrap()
        .with_friction(&[0.0; 3], &even)
        .unwrap();
    assert!(problem.solve(&[0.0; 3], &[1.0, 0.0, 1.0]).unwrap().time() > 0.582895463154743);
}

/// A guide that would have to pull is reported: a wire that turns fast away from the particle's weight.
#[test]
fn a_reaction_that_becomes_negative_is_told() {
    let mu = 0.1;
    let wire = Guide {
        name: "wire".into(),
        along: vec![1.0, 0.0],
        load: G,
        weights: vec![0.0, -2.0],
        friction: mu,
    };
    let problem = Problem::new(&[vec![1.0, 0.0], vec![0.0, 1.0]], &[0.0, -G]).unwrap();
    let problem = problem.with_guide(wire).unwrap();
    // At the start it falls at nearly g, so the reaction g − 2 q̈ is negative.
    let motion = problem.solve(&[0.0, 0.0], &[1.0, 1.0]).unwrap();
    let lapses = motion.violations();
    assert_eq!(lapses.len(), 1, "{lapses:?}");
    assert!(
        !lapses[0].backwards && lapses[0].least < 0.0 && lapses[0].time == 0.0,
        "{lapses:?}"
    );
    let back = problem.solve(&[0.0, 0.0], &[-1.0, 1.0]).unwrap();
    assert!(back.violations().iter().any(|lapse| lapse.backwards));
}
