//! Extreme machines and settings either give correct results, or an error that names the
//! coordinate, the time and the cause.

use std::f64::consts::{PI, SQRT_2};

use crate::support::library::{self, machine};
use crate::support::limits::{conserves, follows_with};
use crate::support::references::{Row, greatest, table};
use crate::support::sampling::accurate;
use crate::support::special::agm;
use crate::support::states::{accelerations, energy, numbers, state};
use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{
    Coordinates, Error, LEAST_RELATIVE_TOLERANCE, Machine, Simulation, Solution, State, Warning,
};
use lagrangian_machines::*;

/// Runs with the default settings.
fn run<M: Machine>(
    machine: &M,
    until: f64,
    start: State<Coordinates<M>>,
) -> Result<Solution<M>, Error> {
    Simulation::new(machine)
        .until(until)
        .max_steps(100_000)
        .run(start)
}

/// Takes the error that a run must have. Its text must contain the given names and the time.
fn error<T>(outcome: Result<T, Error>, names: &str) -> Error {
    let Err(error) = outcome else {
        panic!("no error, where `{names}` should be named")
    };
    let text = error.to_string();
    assert!(
        text.contains(&format!("`{names}`")),
        "{text}: does not name `{names}`"
    );
    error
}

// Masses that differ by nine orders of magnitude.

#[test]
fn pendulums_of_very_unequal_masses_accelerate_exactly() {
    let program = library::program("double_pendulum", &[]);
    for ratio in [1e-9, 1e9] {
        accurate(
            &DoublePendulum {
                m1: ratio,
                ..Default::default()
            },
            &program,
            100,
            |_| (),
        );
        accurate(
            &DoublePendulum {
                m2: ratio,
                ..Default::default()
            },
            &program,
            100,
            |_| (),
        );
    }
}

#[test]
fn crushers_of_very_unequal_masses_accelerate_exactly() {
    let program = library::program("crusher9", &[]);
    let usual = Crusher9::default();
    for ratio in [1e-9, 1e9] {
        let crushers = [
            Crusher9 {
                m: ratio * usual.m,
                J: ratio * usual.J,
                ..usual
            },
            Crusher9 {
                m0: ratio * usual.m0,
                ..usual
            },
            Crusher9 {
                m1: ratio * usual.m1,
                J1: ratio * usual.J1,
                ..usual
            },
            Crusher9 {
                m2: ratio * usual.m2,
                J2: ratio * usual.J2,
                ..usual
            },
        ];
        for crusher in crushers {
            accurate(&crusher, &program, 100, |_| ());
        }
    }
}

#[test]
fn a_chain_with_a_very_heavy_or_a_very_light_end_accelerates_exactly() {
    let text = "machine LoadedChain extends \"chain.machine\" {
        parameters { load: kg = 1 }
        bodies { load { mass: load, at: joint[N].origin } }
    }";
    let mut chain = machine(text);
    let program = chain.program().clone();
    for mass in [0.5e-9, 0.5e9] {
        chain.set("load", mass).expect("the chain has a load");
        accurate(&chain, &program, 100, |_| ());
    }
}

#[test]
fn pendulums_of_very_unequal_masses_keep_their_energy() {
    // A light bob under a heavy one swings as usual.
    let light = DoublePendulum {
        m2: 1e-9,
        ..Default::default()
    };
    conserves(&light, light.start(), (2.0, 1e-12), energy);
    let heavy = DoublePendulum {
        m1: 1e9,
        ..Default::default()
    };
    conserves(&heavy, heavy.start(), (2.0, 1e-12), energy);
    // A light bob above a heavy one is like the middle of a string, with 10⁵ oscillations a second.
    let string = DoublePendulum {
        m1: 1e-9,
        ..Default::default()
    };
    let start = state(&string, 0.0, &[0.3, 0.31], &[0.0; 2]);
    conserves(&string, start, (0.002, 1e-12), energy);
}

/// The mass matrix has a condition of 1e9 here, so accelerations have a relative noise of ε κ =
/// 1e-7. The tolerances are above the effect of that noise in a step.
#[test]
fn crushers_of_very_unequal_masses_keep_their_energy() {
    // Without dampers and debalance.
    let usual = Crusher9 {
        e: 0.0,
        bx: 0.0,
        by: 0.0,
        d1: 0.0,
        d2: 0.0,
        ..Default::default()
    };
    let heavy = Crusher9 {
        m2: 1e9 * usual.m2,
        ..usual
    };
    conserves(&heavy, heavy.start(), (0.1, 1e-9), energy);
    let heavy = Crusher9 {
        m: 1e9 * usual.m,
        ..usual
    };
    conserves(&heavy, heavy.start(), (0.1, 1e-12), energy);
    // The light mortar between platform and pestle vibrates at 650 000 rad/s, the
    // light pestle at 18 000 rad/s.
    let light = Crusher9 {
        m1: 1e-9 * usual.m1,
        ..usual
    };
    conserves(&light, light.start(), (1e-4, 1e-8), energy);
    let light = Crusher9 {
        m2: 1e-9 * usual.m2,
        ..usual
    };
    conserves(&light, light.start(), (1e-3, 1e-10), energy);
}

// The centre of polar coordinates.

#[test]
fn crushers_near_the_polar_singularity_accelerate_exactly() {
    let program = library::program("crusher9", &[]);
    let crusher = Crusher9::default();
    for s in [1e-2, 1e-4, 1e-6, 1e-8, 1e-100] {
        accurate(&crusher, &program, 30, |at| at.q[3] = s);
        accurate(&crusher, &program, 30, |at| at.q[6] = s);
        accurate(&crusher, &program, 30, |at| (at.q[3], at.q[6]) = (s, s));
    }
}

/// Mortar and platform of a crusher that is not shaken: the mortar passes the platform's centre in
/// a straight line at 1 m/s, at a distance ε: s = √(ε² + t²), φ = π/2 − atan(t/ε). Meanwhile φ
/// turns by half a revolution, at up to 1/ε rad/s.
#[test]
fn a_mortar_that_grazes_the_centre_goes_on_straight() {
    let crusher = VibratingCrusher {
        e: 0.0,
        ..Default::default()
    };
    for distance in [1e-2, 1e-4, 1e-6, 1e-8] {
        let at = |t: f64| {
            let s = f64::hypot(distance, t);
            let phi = f64::atan2(distance, t);
            (
                [0.0, 0.0, 0.0, s, phi, 0.0, 0.03, 0.5, 0.0],
                [
                    0.0,
                    0.0,
                    0.0,
                    t / s,
                    -distance / (s * s),
                    0.0,
                    0.0,
                    0.0,
                    0.0,
                ],
            )
        };
        let (q, v) = at(-1.0);
        let start = state(&crusher, -1.0, &q, &v);
        let place = |y: &[f64]| vec![y[3] * y[4].cos(), y[3] * y[4].sin(), y[4]];
        let rows: Vec<Row> = [-0.5, distance, 0.5, 1.0]
            .map(|t| Row::of(t, &[t, distance, at(t).0[4]]))
            .into();
        follows_with(
            &crusher,
            &start,
            (1e-13, exact_beside(distance)),
            (&rows, &[1.0; 3], 1e-5),
            place,
        );
    }
}

/// Sets an absolute tolerance of s1 that is small compared with the least s1.
fn exact_beside<'a, M: Machine>(
    distance: f64,
) -> impl Fn(Simulation<'a, M>, f64) -> Simulation<'a, M> {
    move |run, tolerance| {
        run.tolerance(tolerance)
            .absolute_of("s1", tolerance * distance)
    }
}

#[test]
fn a_mortar_that_meets_the_centre_ends_what_its_machine_assumes() {
    let crusher = VibratingCrusher {
        e: 0.0,
        ..Default::default()
    };
    let start = state(
        &crusher,
        -1.0,
        &[0.0, 0.0, 0.0, 1.0, 0.3, 0.0, 0.03, 0.5, 0.0],
        &[0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    );
    let Error::AssumptionEnded { t, .. } = error(run(&crusher, 1.0, start), "s1 > 0") else {
        panic!("another error")
    };
    // A motion without acceleration, for which every step and its dense output are exact.
    assert!(t.abs() <= 16.0 * f64::EPSILON, "at {t} s");
}

#[test]
fn a_crusher_at_the_centre_names_the_angle_that_has_no_meaning() {
    let crusher = VibratingCrusher::default();
    let system = crusher.prepare();
    for (radius, angle) in [(3, "phi1"), (6, "phi2")] {
        let mut q = [0.0, 0.0, 0.0, 0.02, 0.0, 0.0, 0.03, 0.5, 0.0];
        q[radius] = 0.0;
        let singular =
            accelerations(&system, 0.3, &q, &[1.0; 9]).expect_err("the mass matrix is singular");
        assert_eq!(singular.name(&system), angle);
        assert_eq!(singular.ratio, 0.0, "the pivot of the inertia is 0");
        // A run refuses to begin there, because an assumption of the machine does not hold.
        let refused = error(
            run(&crusher, 1.0, state(&crusher, 0.0, &q, &[0.0; 9])),
            &format!("s{} > 0", radius / 3),
        );
        assert!(
            matches!(refused, Error::AssumptionEnded { t: 0.0, .. }),
            "{refused}"
        );
    }
}

/// A point in polar coordinates without assumptions.
const POINT: &str = "machine Point in plane {
    parameters { m: kg = 2 }
    coordinates { s: m = 1, phi: rad = 0.3 }
    bodies { point { mass: m, at: polar(s, phi) } }
}";

#[test]
fn a_point_at_the_centre_is_a_singular_mass_matrix() {
    let point = machine(POINT);
    let start = State {
        t: 0.25,
        ..state(&point, 0.0, &[0.0, 1.0], &[1.0, 2.0])
    };
    let error = error(run(&point, 1.0, start), "phi");
    let Error::SingularMassMatrix { t, ratio, .. } = error else {
        panic!("{error}")
    };
    assert_eq!((t, ratio), (0.25, 0.0));
}

/// The point passes through the centre to negative s on the other side; these are the same points
/// in space, and the equations hold there too.
#[test]
fn a_point_that_crosses_the_centre_straight_goes_on() {
    let point = machine(POINT);
    let end = run(&point, 2.0, state(&point, 0.0, &[1.0, 0.3], &[-1.0, 0.0])).expect("it goes on");
    let q = &end.end().q.values;
    assert!(
        (q[0] + 1.0).abs() <= 16.0 * f64::EPSILON && q[1] == 0.3,
        "{q:?}"
    );
}

/// The axis of the top from the literature falls through the lower vertical at a distance of
/// δ = 7e-7 rad, where its angles become singular. There sin θ has a relative rounding error of ε
/// π/δ = 1e-9, and the rates of ψ and φ, which rise to 5e6 rad/s, cancel to a spin of 150 rad/s, so
/// rounding may cause an error of 1e-9 · 5e6/150 = 3e-5.
#[test]
fn a_top_that_grazes_the_pole_of_its_angles_falls_on() {
    let top = HeavyTop::default();
    let start = state(&top, 0.0, &[PI, PI / 2.0, 0.0], &[-4.61538, 0.0, 150.0]);
    let run = Simulation::new(&top)
        .tolerance(1e-8)
        .until(0.5)
        .run(start)
        .expect("it falls");
    let nearest = run
        .steps()
        .map(|state| state.q.theta.sin())
        .fold(1.0, f64::min);
    assert!(nearest < 1e-6, "{nearest:e}");
    let (psi, theta) = (run.end().q.psi, run.end().q.theta);
    let axis = [
        theta.sin() * psi.sin(),
        -theta.sin() * psi.cos(),
        theta.cos(),
    ];
    let known = &table(include_str!("../data/heavy_top.txt"))[0].values[..3];
    let limit = f64::EPSILON * PI / nearest * (4.61538 / nearest / 150.0);
    let error = greatest(
        axis.iter()
            .zip(known)
            .map(|(axis, known)| (axis - known).abs()),
    );
    assert!(error <= limit, "error {error:e}, limit {limit:e}");
}

// Bodies without inertia.

#[test]
fn bodies_without_mass_are_named() {
    let cart = CartPole {
        pole: 0.0,
        J: 0.0,
        ..Default::default()
    };
    let singular = error(run(&cart, 1.0, cart.start()), "theta");
    assert!(
        matches!(singular, Error::SingularMassMatrix { t: 0.0, .. }),
        "{singular}"
    );
    let crusher = VibratingCrusher {
        J2: 0.0,
        ..Default::default()
    };
    error(run(&crusher, 1.0, crusher.start()), "theta2");
    let crusher = VibratingCrusher {
        J1: -9.0,
        ..Default::default()
    };
    error(run(&crusher, 1.0, crusher.start()), "theta1");
    let pendulum = DoublePendulum {
        m2: 0.0,
        ..Default::default()
    };
    error(run(&pendulum, 1.0, pendulum.start()), "theta2");
    let pendulum = DoublePendulum {
        l2: 0.0,
        ..Default::default()
    };
    error(run(&pendulum, 1.0, pendulum.start()), "theta2");
}

/// A massless bob is determined if the other bob moves it: when the rods are at right angles, but
/// not when they are in line.
#[test]
fn a_bob_without_mass_is_singular_only_where_nothing_moves_with_it() {
    let pendulum = DoublePendulum {
        m1: 0.0,
        ..Default::default()
    };
    let system = pendulum.prepare();
    assert!(accelerations(&system, 0.0, &[0.2, 1.2], &[0.0; 2]).is_ok());
    // In line: M = m₂ [1 1; 1 1].
    let singular = accelerations(&system, 0.0, &[0.2, 0.2], &[0.0; 2]).expect_err("singular");
    assert!(singular.ratio.abs() <= 1e-14, "{singular:?}");
}

// Values that are not numbers.

#[test]
fn parameters_that_are_not_finite_are_named() {
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let crusher = VibratingCrusher {
            m0: value,
            ..Default::default()
        };
        let refused = error(run(&crusher, 1.0, crusher.start()), "m0");
        assert!(
            matches!(refused, Error::ParameterNotFinite { .. }),
            "{refused}"
        );
    }
    let mut arm = library::interpreted("six_joint_arm");
    arm.set("friction", f64::NAN).expect("it has friction");
    error(run(&arm, 1.0, arm.start()), "friction");
}

#[test]
fn states_that_are_not_finite_are_named() {
    let crusher = VibratingCrusher::default();
    let cushioned = CushionedCrusher::default();
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut start = crusher.start();
        start.q.phi2 = value;
        let refused = error(run(&crusher, 1.0, start), "phi2");
        assert!(matches!(refused, Error::StartNotFinite { .. }), "{refused}");
        let mut start = cushioned.start();
        start.v.s1 = value;
        error(run(&cushioned, 1.0, start), "der(s1)");
        let start = State {
            t: value,
            ..crusher.start()
        };
        error(run(&crusher, 1.0, start), "t");
        let refused = run(&crusher, value, crusher.start()).expect_err("no such end");
        assert!(
            matches!(
                refused,
                Error::InvalidSetting {
                    setting: "until",
                    ..
                }
            ),
            "{refused}"
        );
    }
}

#[test]
fn inputs_that_are_not_finite_are_named() {
    let cart = CartPole::default();
    for value in [f64::NAN, f64::INFINITY] {
        let simulation = Simulation::new(&cart).until(1.0);
        let push = move |t: f64| if t > 0.3 { value } else { 1.0 };
        let error = error(
            simulation
                .inputs(move |t, _, _, u| u.push = push(t))
                .run(cart.start()),
            "push",
        );
        let Error::InputNotFinite { t, .. } = error else {
            panic!("{error}")
        };
        // Steps shrink until they can approach the point no further.
        assert!((0.3 - 1e-12..0.3 + 1e-9).contains(&t), "at {t} s");
    }
}

#[test]
fn forces_beyond_all_numbers_name_the_coordinate() {
    let cart = CartPole::default();
    let start = state(&cart, 0.5, &[0.0, 0.1], &[0.0, 1e200]);
    let error = run(&cart, 1.0, start).expect_err("v² overflows");
    let Error::NotFinite { ref coordinate, t } = error else {
        panic!("{error}")
    };
    assert!(
        ["x", "theta"].contains(&coordinate.as_str()) && t == 0.5,
        "{error}"
    );
}

// Steps that collapse.

/// A point that starts at rest at 1 and falls into the centre of an attraction 1/x² arrives after
/// π/(2√2) with infinite speed.
#[test]
fn a_fall_into_a_pole_ends_when_and_where_it_must() {
    let fall = machine(
        "machine Fall in plane {
            parameters { m: kg = 1, k: N*m^2 = 1 }
            coordinates { height: m = 1 }
            bodies { point { mass: m, at: (0, height) } }
            potentials { well: -k/height }
        }",
    );
    for method in &lagrangian::METHODS {
        let simulation = Simulation::new(&fall)
            .method(method)
            .tolerance(1e-10)
            .until(2.0);
        let error = error(simulation.run(fall.start()), "height");
        let (Error::StepTooSmall { t, .. } | Error::NotFinite { t, .. }) = error else {
            panic!("{}: {error}", method.tableau.name)
        };
        // The error accumulated on the way: the tolerance times the number of steps.
        assert!(
            (t - PI / (2.0 * SQRT_2)).abs() < 1e-6,
            "{}: at {t} s",
            method.tableau.name
        );
    }
}

/// Dry friction written with a sign function defines no motion once the block comes to rest, so the steps collapse.
#[test]
fn dry_friction_ends_the_run_when_the_block_comes_to_rest() {
    let block = machine(
        "machine Block in plane {
            parameters { m: kg = 1, k: N/m = 4, friction: N = 0.3 }
            coordinates { x: m = 1 }
            bodies { block { mass: m, at: (x, 0) } }
            springs { spring { stiffness: k, stretch: x } }
            forces { friction { on: x, value: -friction*sign(der(x)) } }
        }",
    );
    // Half a cycle lasts π/2 and reduces the amplitude by 2 friction/k = 0.15; after seven the
    // block stands within ±0.075.
    let moving = Simulation::new(&block)
        .tolerance(1e-9)
        .until(7.0 * PI / 2.0 - 0.01)
        .run(block.start());
    let end = moving.expect("it slides").end().q.values[0];
    assert!((end.abs() - 0.05).abs() < 1e-3, "{end}");
    let standing = Simulation::new(&block)
        .tolerance(1e-9)
        .until(12.0)
        .max_steps(20_000)
        .run(block.start());
    match standing.expect_err("nothing to go on with") {
        Error::StepTooSmall { coordinate, t, .. } => {
            assert!(
                coordinate == "x" && (t - 7.0 * PI / 2.0).abs() < 1e-3,
                "{coordinate} at {t} s"
            );
        }
        Error::TooManySteps { t, .. } => assert!((t - 7.0 * PI / 2.0).abs() < 1.0, "{t} s"),
        error => panic!("{error}"),
    }
}

#[test]
fn an_angle_that_may_not_reach_zero_ends_the_run() {
    // A top without spin falls over; its axis passes the lower vertical.
    let top = HeavyTop::default();
    let start = state(&top, 0.0, &[0.0, 1.0, 0.0], &[0.0; 3]);
    let ended = error(run(&top, 10.0, start), "sin(theta) > 0");
    let Error::AssumptionEnded { t, .. } = ended else {
        panic!("{ended}")
    };
    // From the energy of a physical pendulum: t = ∫ dθ / √(2 m g l (cos 1 − cos
    // θ) / (A + m l²)) from 1 to π.
    let HeavyTop { m, l, g, A: a, .. } = top;
    let swing = pendulum_fall(1.0, m * g * l / (a + m * l * l));
    assert!((t - swing).abs() < 1e-7, "{t} against {swing}");
}

/// The time that a pendulum with θ'' = w² sin θ takes from rest at `angle` from the upward vertical
/// to the lowest point. It is a quarter of its period, `π / (2 w M(1, cos(α/2)))` with the
/// amplitude α and the arithmetic-geometric mean M.
fn pendulum_fall(angle: f64, square: f64) -> f64 {
    let amplitude = PI - angle;
    PI / (2.0 * square.sqrt() * agm(1.0, (amplitude / 2.0).cos()))
}

// Settings that ask for the impossible.

#[test]
fn tolerances_below_roundoff_are_raised_and_told() {
    let pendulum = DoublePendulum::default();
    let asked = Simulation::new(&pendulum)
        .tolerance(1e-300)
        .until(0.1)
        .run(pendulum.start());
    // The absolute tolerance is used as given, so no step is short enough where a rate passes zero.
    if let Ok(run) = &asked {
        assert!(run.warnings().contains(&Warning::ToleranceRaised {
            asked: 1e-300,
            used: LEAST_RELATIVE_TOLERANCE
        }));
    } else {
        error(asked, "theta1");
    }
    let relative = Simulation::new(&pendulum)
        .relative(1e-30)
        .absolute(1e-15)
        .until(0.1)
        .run(pendulum.start());
    let run = relative.expect("it swings");
    assert_eq!(
        run.warnings(),
        [Warning::ToleranceRaised {
            asked: 1e-30,
            used: LEAST_RELATIVE_TOLERANCE
        }]
    );
}

#[test]
fn tolerances_that_make_no_sense_are_refused() {
    let pendulum = DoublePendulum::default();
    for tolerance in [0.0, -1e-9, f64::NAN, f64::INFINITY] {
        let refused = Simulation::new(&pendulum)
            .tolerance(tolerance)
            .until(1.0)
            .run(pendulum.start());
        assert!(
            matches!(refused, Err(Error::InvalidSetting { .. })),
            "{tolerance}"
        );
    }
    let unknown = Simulation::new(&pendulum)
        .absolute_of("theta3", 1e-9)
        .until(1.0)
        .run(pendulum.start());
    error(unknown, "theta3");
}

/// Even a tolerance that every step meets gives finite results.
#[test]
fn tolerances_that_allow_everything_give_numbers() {
    let crusher = Crusher9::default();
    for tolerance in [1.0, 1e10, 1e300] {
        if let Ok(run) = Simulation::new(&crusher)
            .tolerance(tolerance)
            .until(5.0)
            .max_steps(100_000)
            .run(crusher.start())
        {
            let end = numbers(run.system(), run.end());
            assert!(
                end.iter().all(|number| number.is_finite()),
                "{tolerance}: {end:?}"
            );
        }
    }
}

#[test]
fn runs_may_be_of_any_length() {
    let pendulum = DoublePendulum::default();
    // So short that nothing moves.
    for until in [0.0, 1e-310, 1e-20] {
        let run = run(&pendulum, until, pendulum.start()).expect("a short run");
        assert_eq!((run.end().t, run.end().q), (until, run.start().q));
    }
    // So long that the run cannot finish.
    let Err(Error::TooManySteps { steps, t, until }) = Simulation::new(&pendulum)
        .until(1e300)
        .max_steps(1000)
        .run(pendulum.start())
    else {
        panic!("a run for ever")
    };
    assert!((steps, until) == (1000, 1e300) && t > 1.0);
    // At this time, no step is long enough to change the time.
    let late = State {
        t: 1e17,
        ..pendulum.start()
    };
    let refused = run(&pendulum, 2e17, late).expect_err("no step is between two times");
    assert!(matches!(refused, Error::StepTooSmall { .. }), "{refused}");
}

#[test]
fn a_run_back_in_time_returns_to_its_start() {
    let pendulum = DoublePendulum::default();
    let there = Simulation::new(&pendulum)
        .tolerance(1e-13)
        .until(3.0)
        .run(pendulum.start())
        .expect("it swings");
    let back = Simulation::new(&pendulum)
        .tolerance(1e-13)
        .until(0.0)
        .run(*there.end())
        .expect("it swings");
    let coarse = Simulation::new(&pendulum)
        .tolerance(1e-11)
        .until(3.0)
        .run(pendulum.start())
        .expect("it swings");
    let system = pendulum.prepare();
    let distance = |a: &State<_>, b: &State<_>| {
        let pairs = numbers(&system, a).into_iter().zip(numbers(&system, b));
        pairs.fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs()))
    };
    // The run and the way back are each 100 times as accurate as the
    // coarse run, whose error this is.
    let limit = distance(there.end(), coarse.end());
    assert!(
        limit < 1e-7 && distance(back.end(), there.start()) <= limit,
        "limit {limit:e}"
    );
}

/// An interpreted machine behaves in every respect like the compiled one, also in its errors.
#[test]
fn interpreted_machines_fail_as_compiled_ones_do() {
    let mut interpreted = InterpretedMachine::new(library::program("vibrating_crusher", &[]));
    interpreted.set("J2", 0.0).expect("it has J2");
    let compiled = VibratingCrusher {
        J2: 0.0,
        ..Default::default()
    };
    let first = run(&interpreted, 1.0, interpreted.start()).map(|_| ());
    let second = run(&compiled, 1.0, compiled.start()).map(|_| ());
    assert_eq!(first, second);
    assert!(first.is_err());
}
