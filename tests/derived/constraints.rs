//! Machines with constraints, tested against closed forms and against the same machine in minimal coordinates.

use std::cell::Cell;

use crate::by_hand::constrained::{
    Constrained, bead, circle, double_pendulum, parallelogram, rope, sleigh, winch,
};
use crate::by_hand::double_pendulum::{DoublePendulum, DoublePendulumCoordinates};
use crate::by_hand::toy::{Toy, pendulum};
use lagrangian::{
    Crossing, DefaultInputs, Error, KeptContradiction, METHODS, Method, NoBalance, Simulation,
    Solution, State, StepError, Stepper, System, Tolerance, Warning, least_multipliers,
};

lagrangian::machine! {
    /// A pendulum in Cartesian coordinates.
    machine Bob in plane {
        parameters { m: kg = 1, l: m = 1, g: m/s^2 = 9.81 }
        coordinates { x: m = -1, y: m = 0 }
        bodies { bob { mass: m, at: (x, y) } }
        gravity (0, -g);
        constraints { rod: (x^2 + y^2)/2 = l^2/2 }
    }
}

#[test]
fn a_described_machine_lends_its_own_room() {
    let machine = Bob::default();
    let system = machine.prepare();
    let most = lagrangian::constraint_workspace(2, 1);
    assert_eq!(
        system.with_workspace(most, |workspace| workspace.map(|values| values.len())),
        Some(most)
    );
    assert!(system.with_workspace(most + 1, |workspace| workspace.is_none()));

    let run = Simulation::new(&machine)
        .tolerance(1e-12)
        .until(10.0)
        .run(machine.start())
        .expect("it runs");
    assert!(run.statistics().constraint_residual <= RESIDUAL);
    let end = [run.end().q.x, run.end().q.y];
    let known = [-0.275_087_462_576_116_9, -0.961_419_205_099_125];
    assert_near(&end, &known, 2e-11);
    let tension = run.observe(10.0).expect("in the run").multipliers;
    assert_near(&tension, &[-28.294_567_206_067_25], 1e-9);
}

/// The bound that the runtime promises for every constraint residual.
const RESIDUAL: f64 = 1e-13;

fn run<const N: usize, const M: usize, const NN: usize>(
    machine: &Constrained<N, M, NN>,
    tolerance: f64,
    until: f64,
) -> Solution<Constrained<N, M, NN>> {
    let run = Simulation::new(machine)
        .tolerance(tolerance)
        .until(until)
        .energy_balance(true)
        .run(machine.start())
        .expect("it runs");
    assert!(run.statistics().constraint_residual <= RESIDUAL);
    assert!(run.statistics().constraint_residual > 0.0);
    run
}

fn assert_near(found: &[f64], known: &[f64], tolerance: f64) {
    for (found, known) in found.iter().zip(known) {
        assert!((found - known).abs() <= tolerance, "{found} {known}");
    }
}

thread_local! {
    /// How often the positions and the matrix of a constraint were evaluated.
    static EVALUATED: Cell<[usize; 2]> = const { Cell::new([0; 2]) };
}

/// The end of a step is projected onto the constraints by the matrices of two poses, however many corrections that takes: those of the end, by which
/// residuals are measured, and those where the projection arrives.
#[test]
fn a_projection_evaluates_the_constraint_matrix_twice() {
    let machine = Constrained {
        positions: |_, [x, y], _| {
            let [positions, matrices] = EVALUATED.get();
            EVALUATED.set([positions + 1, matrices]);
            [0.5 * (x * x + y * y - 1.0)]
        },
        matrix: |_, [x, y], _| {
            let [positions, matrices] = EVALUATED.get();
            EVALUATED.set([positions, matrices + 1]);
            [[*x, *y]]
        },
        ..circle::<1>()
    };
    let evaluated = |tolerance: f64, until: f64| {
        EVALUATED.set([0; 2]);
        let run = Simulation::new(&machine).method(Method::DOP853);
        let run = run.tolerance(tolerance).until(until).run(machine.start());
        let statistics = run.expect("it runs").statistics();
        assert!(statistics.constraint_residual <= RESIDUAL);
        (EVALUATED.get(), statistics)
    };
    for tolerance in [1e-4, 1e-6, 1e-10] {
        let (before, one) = evaluated(tolerance, 1.0);
        let (after, other) = evaluated(tolerance, 11.0);
        let [positions, matrices] = [0, 1].map(|of: usize| after[of] - before[of]);
        let tries = (other.steps + other.rejected) - (one.steps + one.rejected);
        // The machine evaluates the matrix for its accelerations and, in `G v`, for the rates of its constraint: before the corrections, at the pose
        // where those of positions arrive, and after each correction of rates, of which there is one, and two where the rows have turned little.
        let of_machine = other.evaluations - one.evaluations;
        assert!(positions > tries, "{tolerance}: {positions} {tries}");
        assert!(
            matrices <= of_machine + (2 + 4) * tries,
            "{tolerance}: {matrices} {of_machine} {tries}"
        );
    }
}

/// Problem A01 of the IFToMM library of benchmarks; the solution was computed to 18 digits with
/// Jacobi's elliptic functions.
#[test]
fn a_particle_on_a_circle_is_the_pendulum_of_closed_form() {
    let machine = circle::<1>();
    let run = run(&machine, 1e-12, 10.0);
    for (t, at) in [
        (1.0, [0.986_291_751_131_875_3, -0.165_010_853_125_541_17]),
        (5.0, [-0.942_305_435_043_757_3, -0.334_754_338_414_000_6]),
        (10.0, [-0.275_087_462_576_116_9, -0.961_419_205_099_125]),
    ] {
        assert_near(&run.at(t).expect("in the run").q, &at, 2e-11);
    }
    let end = run.observe(10.0).expect("in the run");
    // The rod's tension is the vector -λ r.
    assert_near(&end.multipliers, &[-28.294_567_206_067_25], 1e-9);
    let balance = run.energy_balance().expect("kept");
    assert!(balance.relative().abs() < 1e-11, "{}", balance.relative());
    assert!(run.warnings().is_empty());
}

#[test]
fn every_method_keeps_the_constraint_and_its_order() {
    let machine = circle::<1>();
    let known = [-0.275_087_462_576_116_9, -0.961_419_205_099_125];
    for method in &METHODS {
        let error = |tolerance: f64| {
            let run = Simulation::new(&machine)
                .method(method)
                .tolerance(tolerance)
                .until(10.0)
                .run(machine.start())
                .expect("it runs");
            assert!(run.statistics().constraint_residual <= RESIDUAL);
            let [x, y] = run.end().q;
            (x - known[0]).hypot(y - known[1])
        };
        // As accurate as the same machine described by its angle, up to a small factor.
        let alone = |tolerance: f64| {
            let mut angle = pendulum(-core::f64::consts::FRAC_PI_2);
            angle.p = 9.81_f64.sqrt();
            let run = Simulation::new(&angle)
                .method(method)
                .tolerance(tolerance)
                .until(10.0)
                .run(angle.start())
                .expect("it runs");
            let [theta] = run.end().q;
            (theta.sin() - known[0]).hypot(-theta.cos() - known[1])
        };
        for tolerance in [1e-6, 1e-8] {
            let (error, alone) = (error(tolerance), alone(tolerance));
            println!("{} {tolerance:e}: {error:e} {alone:e}", method.tableau.name);
            assert!(error < 1e3 * tolerance, "{}", method.tableau.name);
        }
    }
}

#[test]
fn particles_on_rods_are_the_double_pendulum() {
    let machine = double_pendulum([120.0_f64.to_radians(), 90.0_f64.to_radians()]);
    let run = run(&machine, 1e-12, 10.0);
    // Angles computed in quadruple precision. The motion is chaotic: within 10 s an error of 10⁻¹²
    // grows to about 10⁻⁹.
    for (t, [upper, lower]) in [
        (5.0, [-2.090_829_080_630_254_8, -1.567_325_676_426_099_8]),
        (10.0, [2.081_062_187_742_029, 1.555_966_281_095_514_3]),
    ] {
        let ((s1, c1), (s2, c2)) = (f64::sin_cos(upper), f64::sin_cos(lower));
        let known = [s1, -c1, s1 + s2, -c1 - c2];
        assert_near(&run.at(t).expect("in the run").q, &known, 1e-8);
    }

    // Multipliers are forces: they must satisfy Newton's law for the lower bob, with accelerations
    // computed from the angles.
    let angles = DoublePendulum::default();
    let run_of_angles = Simulation::new(&angles)
        .tolerance(1e-12)
        .until(2.0)
        .run(State {
            t: 0.0,
            q: DoublePendulumCoordinates {
                theta1: 120.0_f64.to_radians(),
                theta2: 90.0_f64.to_radians(),
            },
            v: DoublePendulumCoordinates {
                theta1: 0.0,
                theta2: 0.0,
            },
        })
        .expect("it runs");
    let seen = run_of_angles.observe(2.0).expect("in the run");
    let (s1, c1) = seen.q.theta1.sin_cos();
    let (s2, c2) = seen.q.theta2.sin_cos();
    let bend = |s: f64, c: f64, v: f64, a: f64| [c * a - s * v * v, s * a + c * v * v];
    let [ax1, ay1] = bend(s1, c1, seen.v.theta1, seen.a.theta1);
    let [ax2, ay2] = bend(s2, c2, seen.v.theta2, seen.a.theta2);
    // m a = -m g e_y + 2 λ d, where d is the lower rod.
    let pull = (ax1 + ax2) * s2 - (ay1 + ay2 + 9.81) * c2;
    let lower = run.observe(2.0).expect("in the run").multipliers[1];
    assert!((2.0 * lower - pull).abs() < 1e-8, "{lower} {pull}");
}

/// `v = V tanh(kt + c)`, `ω = √(E/I) sech(kt + c)`, recomputed to 40 digits.
#[test]
fn a_sleigh_follows_its_edge() {
    let machine = sleigh();
    let run = run(&machine, 1e-12, 30.0);
    let speed = |t: f64| {
        let State { q, v, .. } = run.at(t).expect("in the run");
        let (s, c) = q[2].sin_cos();
        // The edge never moves across itself, at the ends of steps or between them.
        let across = -s * v[0] + c * v[1] - 0.3 * v[2];
        assert!(across.abs() <= 1e-13 * (v[0].abs() + v[1].abs() + 2.0));
        (c * v[0] + s * v[1], v[2], q[2])
    };
    let (v, omega, phi) = speed(0.5);
    assert!((v - 1.102_841_915_509_945_5).abs() < 1e-10);
    assert!((omega - 1.206_351_374_405_940_5).abs() < 1e-10);
    assert!((phi - 1.047_655_657_379_487).abs() < 1e-10);
    let (v, _, phi) = speed(30.0);
    assert!((v - 1.191_637_528_781_298_5).abs() < 1e-9);
    assert!((phi - 1.532_180_286_675_054_5).abs() < 1e-9);
    // The reaction of a no-slip constraint does no work.
    let balance = run.energy_balance().expect("kept");
    assert!(balance.relative().abs() < 1e-11 && balance.work.abs() < 1e-10);
}

#[test]
fn a_rope_that_is_wound_does_work() {
    let run = run(&winch(), 1e-12, 10.0);
    // l θ'' = -2 l' θ' - g sin θ
    let angle = Toy::<1>::new(([1.0], [0.0]), |t, [theta], [omega], _, _| {
        let [l, dl, _] = rope(t);
        [-(2.0 * dl * omega + 9.81 * theta.sin()) / l]
    });
    let fewest = Simulation::new(&angle)
        .tolerance(1e-12)
        .until(10.0)
        .run(angle.start())
        .expect("it runs");
    for i in 0..=100 {
        let t = f64::from(i) / 10.0;
        let ([theta], [l, ..]) = (fewest.at(t).expect("in the run").q, rope(t));
        let known = [l * theta.sin(), -l * theta.cos()];
        assert_near(&run.at(t).expect("in the run").q, &known, 1e-9);
    }
    let balance = run.energy_balance().expect("kept");
    assert!(balance.work.abs() > 0.1, "{}", balance.work);
    assert!(balance.relative().abs() < 1e-11, "{}", balance.relative());
}

#[test]
fn a_bead_is_flung_out_along_a_turning_wire() {
    let run = run(&bead(), 1e-12, 2.0);
    // r = cosh 2t; the wire's work supplies all the energy.
    for t in [0.3, 1.0, 2.0] {
        let (r, (s, c)) = ((2.0_f64 * t).cosh(), (2.0_f64 * t).sin_cos());
        assert_near(&run.at(t).expect("in the run").q, &[r * c, r * s], 1e-9);
    }
    let energy = |t: f64| 2.0 * ((2.0 * t).sinh().powi(2) + (2.0 * t).cosh().powi(2));
    let balance = run.energy_balance().expect("kept");
    let work = energy(2.0) - energy(0.0);
    assert!((balance.work / work - 1.0).abs() < 1e-10);
    // λ (-s, c): the force across the wire balances the Coriolis term 2 m ω r'.
    let multipliers = run.observe(1.0).expect("in the run").multipliers;
    assert_near(&multipliers, &[2.0 * 2.0 * 2.0 * 2.0_f64.sinh()], 1e-8);
}

#[test]
fn what_is_stated_again_is_named_and_shares_the_load() {
    fn with<const M: usize>(names: &[&str], known: [f64; M]) {
        let machine = circle::<M>();
        let run = run(&machine, 1e-12, 10.0);
        let end = [-0.275_087_462_576_116_9, -0.961_419_205_099_125];
        assert_near(&run.end().q, &end, 2e-11);
        let named: Vec<_> = names
            .iter()
            .map(|&name| Warning::RedundantConstraint {
                constraint: name.into(),
                with: vec!["rod".into()],
            })
            .collect();
        assert_eq!(run.warnings(), named);
        // The reactions k λₖ r are equal and add up to the tension.
        let multipliers = run.observe(10.0).expect("in the run").multipliers;
        assert_near(&multipliers, &known, 1e-9);
    }
    let tension = -28.294_567_206_067_25;
    with(&["again"], [tension / 2.0, tension / 4.0]);
    // Here there are more constraints than coordinates.
    with(
        &["again", "more"],
        [tension / 3.0, tension / 6.0, tension / 9.0],
    );
}

#[test]
fn redundant_by_geometry_the_motion_is_that_of_one_pendulum() {
    let machine = parallelogram(1.0);
    let run = run(&machine, 1e-11, 10.0);
    let [Warning::RedundantConstraint { constraint, with }] = run.warnings() else {
        panic!("{:?}", run.warnings());
    };
    let mut all = with.clone();
    all.push(constraint.clone());
    all.sort();
    assert_eq!(all, ["left", "level", "right", "rod"]);

    let mut angle = pendulum(1.0);
    angle.p = 9.81_f64.sqrt();
    let fewest = Simulation::new(&angle)
        .tolerance(1e-12)
        .until(10.0)
        .run(angle.start())
        .expect("it runs");
    for i in 0..=100 {
        let t = f64::from(i) / 10.0;
        let [theta] = fewest.at(t).expect("in the run").q;
        let (s, c) = theta.sin_cos();
        assert_near(
            &run.at(t).expect("in the run").q,
            &[s, -c, 1.0 + s, -c],
            1e-8,
        );
    }
    // Neither bob needs the connecting rod: each is held by its own rod, with 2 λ = -(g cos θ + θ'²).
    let ([theta], [omega]) = (fewest.end().q, fewest.end().v);
    let held = -0.5 * (9.81 * theta.cos() + omega * omega);
    let multipliers = run.observe(10.0).expect("in the run").multipliers;
    assert_near(&multipliers, &[held, held, 0.0, 0.0], 1e-6);
}

#[test]
fn constraints_that_contradict_each_other_are_named() {
    let error = |machine: &Constrained<2, 2, 4>| {
        let run = Simulation::new(machine).until(1.0).run(machine.start());
        run.expect_err("they contradict each other")
    };
    let named = |error: &Error| match error {
        Error::InconsistentConstraints {
            constraint, with, ..
        } => (constraint.clone(), with.clone()),
        other => panic!("{other}"),
    };

    let two_radii = Constrained {
        positions: |_, [x, y], _| [0.5 * (x * x + y * y - 1.0), x * x + y * y - 4.0],
        ..circle::<2>()
    };
    let refused = error(&two_radii);
    assert_eq!(named(&refused), ("again".into(), vec!["rod".into()]));
    assert!(refused.to_string().contains("`again` contradicts `rod`"));

    // The two constraints agree at the start in position and rate, but not in acceleration.
    let parting = Constrained {
        positions: |t, [x, _], _| [x + 1.0, x + 1.0 - t * t],
        matrix: |_, _, _| [[1.0, 0.0], [1.0, 0.0]],
        by_time: |t, _, _| [0.0, -2.0 * t],
        constraint_bias: |_, _, _, _| [0.0, 2.0],
        ..circle::<2>()
    };
    assert_eq!(named(&error(&parting)).0, "again");
    // Constraints that contradict each other only at a later time are also refused.
    let later = Constrained {
        positions: |t, [x, _], _| [x + 1.0, x + 1.0 - t.powi(4)],
        by_time: |t, _, _| [0.0, -4.0 * t.powi(3)],
        constraint_bias: |t, _, _, _| [0.0, 12.0 * t * t],
        ..parting
    };
    assert_eq!(named(&error(&later)), ("again".into(), vec!["rod".into()]));

    let nowhere = Constrained {
        positions: |_, [x, y], _| [0.5 * (x * x + y * y + 1.0)],
        ..circle::<1>()
    };
    let refused = Simulation::new(&nowhere).until(1.0).run(nowhere.start());
    let refused = refused.expect_err("no circle has that radius");
    assert_eq!(named(&refused), ("rod".into(), vec![]));
}

#[test]
fn a_start_is_brought_onto_the_constraints_and_says_how_far() {
    let machine = circle::<1>();
    let given = State {
        t: 0.0,
        q: [-0.6 * 1.1, 0.8 * 1.1],
        v: [1.0, 0.0],
    };
    let run = Simulation::new(&machine)
        .until(1.0)
        .run(given)
        .expect("it runs");
    // The nearest point of the circle, and the component of the velocity along the circle.
    assert_near(&run.start().q, &[-0.6, 0.8], 1e-13);
    assert_near(&run.start().v, &[0.64, 0.48], 1e-13);
    let moved: Vec<_> = run
        .warnings()
        .iter()
        .map(|warning| match warning {
            Warning::StartMoved { name, from, to } => (name.as_str(), *from, *to),
            other => panic!("{other}"),
        })
        .collect();
    let names: Vec<_> = moved.iter().map(|moved| moved.0).collect();
    assert_eq!(names, ["x1", "y1", "der(x1)", "der(y1)"]);
    assert_eq!(moved[0], ("x1", given.q[0], run.start().q[0]));
    assert_eq!(moved[3], ("der(y1)", given.v[1], run.start().v[1]));

    // The correction is weighted by inertia: with masses of 1 kg and 4 kg, the lighter
    // particle moves four times as far.
    let heavy = Constrained {
        mass: [1.0, 4.0, 1.0, 1.0],
        ..double_pendulum([0.0, 0.0])
    };
    let level = Constrained {
        constraints: [("sum", true), ("rest", true)],
        positions: |_, q, _| [q[0] + q[1] - 5.0, q[2]],
        matrix: |_, _, _| [[1.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]],
        constraint_bias: |_, _, _, _| [0.0; 2],
        ..heavy
    };
    let start = State {
        t: 0.0,
        q: [0.0; 4],
        v: [0.0; 4],
    };
    let run = Simulation::new(&level)
        .until(0.1)
        .run(start)
        .expect("it runs");
    assert_near(&run.start().q, &[4.0, 1.0, 0.0, 0.0], 1e-14);

    // The rates move by the smallest amount at the pose to which the positions have moved: v − W Gᵀ (G W Gᵀ)⁻¹ G v with G = (x, y) there.
    let uneven = Constrained {
        mass: [1.0, 4.0],
        ..circle::<1>()
    };
    let given = State {
        t: 0.0,
        q: [0.9, 1.1],
        v: [1.0, -3.0],
    };
    let v = given.v;
    let run = Simulation::new(&uneven)
        .until(0.1)
        .run(given)
        .expect("it runs");
    let [x, y] = run.start().q;
    let share = (x * v[0] + y * v[1]) / (x * x + y * y / 4.0);
    let least = [v[0] - share * x, v[1] - share * y / 4.0];
    assert_near(&run.start().v, &least, 1e-12);

    // Newton's method finds the circle from far away, too.
    let afar = State {
        t: 0.0,
        q: [-3e-3, 4e-3],
        v: [0.0, 0.0],
    };
    let run = Simulation::new(&machine)
        .until(0.1)
        .run(afar)
        .expect("it runs");
    assert_near(&run.start().q, &[-0.6, 0.8], 1e-12);
}

/// The error when the kept coordinates leave no position at which the rod's constraint holds.
fn contradiction(kept: &[&str], residual: f64) -> Error {
    Error::KeptStart {
        contradictions: vec![KeptContradiction {
            constraint: "rod".into(),
            of_rates: false,
            kept: kept.iter().map(|name| name.to_string()).collect(),
            residual,
            unit: "1".into(),
        }],
        t: 0.0,
    }
}

lagrangian::machine! {
    machine Kept in plane {
        parameters { l: m = 1, g: m/s^2 = 9.81 }
        coordinates { x: m = 0.6, y: m = -0.9, der(x): m/s = 0.5, der(y): m/s = 1 }
        bodies { bob { mass: 2, at: (x, y) } }
        gravity (0, -g);
        constraints { rod: norm((x, y)) = l }
        keep { x, der(x) }
    }
}

#[test]
fn what_a_description_keeps_of_its_start_stays() {
    // The bound on the rod's residual, divided by the least derivative of
    // the constraint by a coordinate.
    const OFF: f64 = RESIDUAL / 0.4;
    let machine = Kept::default();
    assert!(machine.prepare().kept_at_start().eq(["x", "der(x)"]));
    let simulation = || Simulation::new(&machine).until(0.1);
    let run = simulation().run(machine.start()).expect("it runs");
    let start = run.start();
    // 0.6 and 0.8 are the legs of a right triangle of hypotenuse 1; x ẋ + y ẏ = 0.
    assert_near(&[start.q.x, start.q.y], &[0.6, -0.8], OFF);
    assert_near(&[start.v.x, start.v.y], &[0.5, 0.375], OFF);

    // Another coordinate and rate are kept.
    let run = simulation()
        .keep("y")
        .run(machine.start())
        .expect("it runs");
    let x = (1.0_f64 - 0.81).sqrt();
    assert_near(&[run.start().q.x, run.start().q.y], &[x, -0.9], OFF);
    // Nothing is kept: the start becomes the nearest point of the circle, with the
    // component of the rate along it.
    let run = simulation()
        .keep_none()
        .run(machine.start())
        .expect("it runs");
    let r = 0.6_f64.hypot(0.9);
    let (c, s) = (0.6 / r, -0.9 / r);
    assert_near(&[run.start().q.x, run.start().q.y], &[c, s], OFF);
    let along = -0.5 * s + c;
    assert_near(
        &[run.start().v.x, run.start().v.y],
        &[-s * along, c * along],
        OFF,
    );

    // A run that continues from an event does not apply `keep`: the state after an impact is projected
    // onto the constraints by the smallest move.
    let mut after = *run.end();
    (after.v.x, after.v.y) = (1.0, 1.0);
    let (x, y) = (after.q.x, after.q.y);
    let along = x - y;
    let gone_on = run.resume().until(0.2).run(after).expect("it goes on");
    let v = &gone_on.start().v;
    assert_near(&[v.x, v.y], &[-y * along, x * along], OFF);
}

#[test]
fn what_is_kept_of_a_start_stays_and_the_rest_moves() {
    let machine = circle::<1>();
    let given = State {
        t: 0.0,
        q: [-0.66, 0.88],
        v: [1.0, 0.0],
    };
    let simulation = || Simulation::new(&machine).until(0.1);
    let run = simulation()
        .keep("x1")
        .keep("der(y1)")
        .run(given)
        .expect("it runs");
    let y = (1.0_f64 - 0.66 * 0.66).sqrt();
    assert_near(&run.start().q, &[-0.66, y], 1e-13);
    // x ẋ + y ẏ = 0
    assert_near(&run.start().v, &[0.0, 0.0], 1e-13);

    // No coordinate is left that may be moved.
    let refused = simulation().keep("x1").keep("y1").run(given);
    assert_eq!(
        refused.err(),
        Some(contradiction(
            &["x1", "y1"],
            0.5 * (0.66 * 0.66 + 0.88 * 0.88 - 1.0)
        ))
    );
    // The kept value lies outside the circle, so it cannot be met.
    let far = State {
        q: [-1.5, 0.1],
        ..given
    };
    let refused = simulation().keep("x1").run(far);
    let Err(Error::KeptStart { contradictions, .. }) = refused else {
        panic!("{:?}", refused.map(|run| *run.end()));
    };
    assert_eq!(contradictions[0].kept, ["x1"]);
    // The residual is least at y = 0.
    let miss = contradictions[0].residual - 0.5 * (1.5 * 1.5 - 1.0);
    assert!(miss.abs() < 1e-9, "{miss:e}");
    // Kept rates that are not tangent to the circle: x ẋ + y ẏ = 0.48 + 0.16.
    let across = State {
        q: [0.6, 0.8],
        v: [0.8, 0.2],
        ..given
    };
    let refused = simulation().keep("der(x1)").keep("der(y1)").run(across);
    let Err(error) = refused else {
        panic!("{:?}", refused.map(|run| *run.end()));
    };
    let words = "with `der(x1)` and `der(y1)` kept, the rate of `rod` is 6.4000e-1 1/s off";
    assert!(error.to_string().contains(words), "{error}");
    let refused = simulation().keep("z").run(given);
    let name = "z".into();
    assert_eq!(refused.err(), Some(Error::UnknownCoordinate { name }));
}

#[test]
fn between_the_steps_the_motion_is_on_the_constraints_too() {
    // With steps as long as this tolerance allows, the interpolant leaves the
    // circle by 10⁻⁶ between their ends.
    let machine = circle::<1>();
    for method in &METHODS {
        let simulation = Simulation::new(&machine).method(method).tolerance(1e-6);
        let run = simulation
            .every(0.01)
            .event("lowest", Crossing::Any, |state| state.q[0])
            .until(10.0)
            .run(machine.start())
            .expect("it runs");
        let states = (0..1000).map(|i| run.at(f64::from(i) / 100.0).expect("in the run"));
        let samples = run.samples().iter().cloned();
        let events = run.events().iter().map(|event| event.state);
        let mut seen = 0;
        for State { q, v, .. } in states.chain(samples).chain(events) {
            // Residuals of positions are scaled by 1 m, those of rates by the greatest speed, √(2 g l).
            assert!((0.5 * (q[0].hypot(q[1]).powi(2) - 1.0)).abs() <= 2.0 * RESIDUAL);
            assert!((q[0] * v[0] + q[1] * v[1]).abs() <= 2.0 * 4.43 * RESIDUAL);
            seen += 1;
        }
        assert!(seen > 2000);
        // One event each half period, the first after a quarter period.
        let period = 2.367_841_947_576_237_4;
        assert_eq!(run.events().len(), 8);
        for (k, event) in (0..).zip(run.events()) {
            let known = (0.25 + 0.5 * f64::from(k)) * period;
            assert!(
                (event.state.t - known).abs() < 1e-3,
                "{}",
                method.tableau.name
            );
        }
    }
}

/// Steps a pendulum through `count` of its periods and checks the residual of the
/// constraint after every step.
fn periods(count: f64, method: &'static Method, tolerance: f64) -> (usize, f64) {
    let machine = circle::<1>();
    let period = 2.367_841_947_576_237_4;
    let tolerance = Tolerance {
        relative: tolerance,
        absolute: [tolerance; 2],
    };
    let (q, v) = machine.start;
    let mut stepper = Stepper::new(
        &machine,
        DefaultInputs,
        NoBalance,
        method,
        tolerance,
        (0.0, q, v),
        count * period,
    )
    .expect("it has accelerations");
    let mut greatest: f64 = 0.0;
    while !stepper.is_done() {
        stepper.step().expect("it goes on");
        let (q, v) = (stepper.q(), stepper.v());
        let position = 0.5 * (q[0] * q[0] + q[1] * q[1] - 1.0);
        let rate = (q[0] * v[0] + q[1] * v[1]) / 4.43;
        greatest = greatest.max(position.abs()).max(rate.abs());
    }
    assert!(stepper.constraint_residual() <= RESIDUAL);
    // The potential energy is 0 at the start.
    let energy = machine.kinetic_energy(0.0, stepper.q(), stepper.v())
        + machine.potential_energy(0.0, stepper.q(), &());
    let drift = tolerance_of_energy(stepper.work().steps);
    assert!(energy.abs() <= drift, "{energy:e} {drift:e}");
    (stepper.work().steps, greatest)
}

/// The bound on the energy error, in J, at a tolerance of 10⁻⁹: each step may err by the tolerance in
/// `q` and `v`, which changes the energy by that times `g` and the greatest speed.
fn tolerance_of_energy(steps: usize) -> f64 {
    steps as f64 * 1e-9 * (9.81 + 4.43 * (1.0 + 4.43))
}

#[test]
fn ten_thousand_periods_leave_nothing_of_the_constraint() {
    let (steps, residual) = periods(1e4, &METHODS[0], 1e-9);
    println!("{steps} steps, residual {residual:e}");
    assert!(steps > 100_000);
    // The residual is a sum of two terms of size 1, and the scale is at least that.
    assert!(residual <= 2.0 * RESIDUAL, "{residual:e}");
}

#[test]
#[ignore = "a million periods take minutes"]
fn a_million_periods_leave_nothing_of_the_constraint() {
    let (steps, residual) = periods(1e6, &METHODS[0], 1e-9);
    println!("{steps} steps, residual {residual:e}");
    assert!(residual <= 2.0 * RESIDUAL, "{residual:e}");
}

#[test]
fn a_machine_that_lends_no_room_is_told_so() {
    let machine = Constrained {
        on_stack: false,
        ..circle::<1>()
    };
    let refused = Simulation::new(&machine).until(1.0).run(machine.start());
    assert_eq!(
        refused.err(),
        Some(Error::NoWorkspaceForConstraints { t: 0.0 })
    );
}

#[test]
fn what_has_no_inertia_may_be_held_by_a_constraint() {
    // A spring of 8 N/m pulls a massless point that a rod ties to a mass of 2 kg.
    let tied = Constrained {
        constraints: [("rod", true)],
        mass: [0.0, 2.0],
        forces: |_, [x, _], _, _| [-8.0 * x, 0.0],
        positions: |_, [x, y], _| [x - y],
        matrix: |_, _, _| [[1.0, -1.0]],
        constraint_bias: |_, _, _, _| [0.0],
        ..circle::<1>()
    };
    let (mut a, mut multipliers) = ([0.0; 2], [0.0]);
    least_multipliers(
        &tied,
        0.0,
        &[0.5; 2],
        &[0.0; 2],
        &(),
        &mut a,
        &mut multipliers,
    )
    .expect("the rod holds it");
    assert_near(&a, &[-2.0, -2.0], 1e-15);
    assert_near(&multipliers, &[4.0], 1e-15);

    // If the rod does not hold the massless point, the equations are singular.
    let loose = Constrained {
        matrix: |_, _, _| [[0.0, 1.0]],
        ..tied
    };
    let refused = least_multipliers(
        &loose,
        0.0,
        &[0.5; 2],
        &[0.0; 2],
        &(),
        &mut a,
        &mut multipliers,
    );
    let Err(StepError::Singular { singular, .. }) = refused else {
        panic!("{refused:?}");
    };
    assert_eq!(singular.name(&loose), "x1");
}
