//! The machines of the library end where results in higher precision say, and
//! their energy balances close.
#![expect(
    clippy::excessive_precision,
    reason = "references with all their digits"
)]

use crate::support::known_ends::{CRUSHER_AT_5, CRUSHER_RANGES, CRUSHER_RATES};
use lagrangian::{Coordinates, Error, Machine, Simulation, Solution, State};
use lagrangian_machines::{
    CartPole, Chain, ChainRelative, Crusher9, CushionedCrusher, DoublePendulum, HeavyTop,
    SixJointArm, VibratingCrusher, crusher9,
};

/// Runs a machine from a start and keeps the energy balance.
fn run<M: Machine>(machine: &M, start: State<Coordinates<M>>, until: f64) -> Solution<M> {
    let simulation = Simulation::new(machine)
        .tolerance(1e-10)
        .energy_balance(true);
    simulation.until(until).run(start).unwrap()
}

#[test]
fn the_crusher_is_right_after_5_seconds() {
    let crusher = Crusher9::default();
    let start = State {
        v: crusher9::Coordinates::from_array(CRUSHER_RATES),
        ..crusher.start()
    };
    for tolerance in [1e-6, 1e-8, 1e-10, 1e-12, 1e-13] {
        let run = Simulation::new(&crusher)
            .tolerance(tolerance)
            .until(5.0)
            .run(start)
            .unwrap();
        let (q, v) = (run.end().q.to_array(), run.end().v.to_array());
        let found = q.iter().chain(&v);
        let errors = found.zip(CRUSHER_AT_5).zip(CRUSHER_RANGES);
        let errors = errors.map(|((y, exact), range)| (y - exact).abs() / (range + exact.abs()));
        let error = errors.fold(0.0, f64::max);
        // A step errs by at most the tolerance, which is fifty times as much
        // relative to the smallest range.
        let limit = 50.0 * run.statistics().steps as f64 * tolerance;
        assert!(error <= limit, "{tolerance}: {error:e}");
    }
}

#[test]
fn the_energy_of_crushers_is_accounted_for() {
    fn check<M: Machine>(machine: &M) {
        let balance = run(machine, machine.start(), 5.0).energy_balance().unwrap();
        assert!(
            balance.relative().abs() <= 1e-8,
            "{}: {balance:?}",
            machine.name()
        );
        // Drive and dampers turn over far more energy than the residual.
        assert!(balance.work > 1.0 && balance.dissipated > 1.0);
    }
    check(&Crusher9::default());
    check(&CushionedCrusher::default());
    check(&VibratingCrusher::default());
}

#[test]
fn dampers_take_what_machines_without_a_drive_lose() {
    fn check<M: Machine>(machine: &M) {
        let balance = run(machine, machine.start(), 5.0).energy_balance().unwrap();
        assert!(
            balance.relative().abs() <= 1e-8,
            "{}: {balance:?}",
            machine.name()
        );
        assert_eq!(balance.work, 0.0);
        assert!(balance.dissipated > 0.0);
    }
    check(&CartPole::default());
    check(&SixJointArm::default());
}

#[test]
fn conservative_machines_conserve() {
    fn check<M: Machine>(machine: &M) {
        let run = run(machine, machine.start(), 5.0);
        let balance = run.energy_balance().unwrap();
        assert_eq!((balance.work, balance.dissipated), (0.0, 0.0));
        assert!(
            balance.relative().abs() <= 1e-8,
            "{}: {balance:?}",
            machine.name()
        );
    }
    check(&DoublePendulum::default());
    check(&Chain::default());
    check(&ChainRelative::default());
}

/// A top that starts horizontally, as in its spec, with the given rates of precession and spin.
fn top(precession: f64, spin: f64, until: f64, tolerance: f64) -> Solution<HeavyTop> {
    let top = HeavyTop::default();
    let mut start = top.start();
    (start.v.psi, start.v.phi) = (precession, spin);
    Simulation::new(&top)
        .tolerance(tolerance)
        .until(until)
        .run(start)
        .unwrap()
}

#[test]
fn a_top_precesses_as_it_should() {
    // The top from the literature on Lie-group integrators (M. Géradin, A. Cardona; O. Brüls). The
    // position of its mass centre is computed by extrapolation in binary128. The top passes the
    // singularity of its angles at 7·10⁻⁷ rad, where they turn at 10⁶ rad/s.
    let references = [
        (
            0.5,
            [
                -0.7024682970565855893378,
                -0.02116518470192332658080,
                -0.7114002576517344055470,
            ],
        ),
        (
            1.0,
            [
                0.1733439640983860425920,
                0.6400885920705687828606,
                -0.7484907911335813094836,
            ],
        ),
        (
            2.0,
            [
                -0.1504168227456417598100,
                -0.7241655916368956507486,
                -0.6730222695604440960502,
            ],
        ),
    ];
    for tolerance in [1e-4, 1e-5, 1e-6] {
        let run = top(-4.61538, 150.0, 2.0, tolerance);
        for (t, exact) in references {
            let State { q, .. } = run.at(t).unwrap();
            let (sin, cos) = q.theta.sin_cos();
            let found = [sin * q.psi.sin(), -sin * q.psi.cos(), cos];
            let error = found
                .iter()
                .zip(exact)
                .map(|(x, exact)| (x - exact).abs())
                .fold(0.0, f64::max);
            let limit = run.statistics().steps as f64 * tolerance;
            assert!(error <= limit, "{tolerance} {t}: {error:e}");
        }
    }
}

#[test]
fn a_top_keeps_its_angular_momenta() {
    let run = top(2.0, 60.0, 2.0, 1e-11);
    let before = run.observe(0.0).unwrap();
    for i in 1..=20 {
        let now = run.observe(0.1 * f64::from(i)).unwrap();
        // The spin is 60 rad/s, so the tolerance for its error is sixty times that for the others.
        let limit = 60.0 * run.statistics().steps as f64 * 1e-11;
        let apart = |one: f64, other: f64| (one - other).abs() <= limit * (1.0 + one.abs());
        assert!(apart(
            before.outputs.vertical_momentum,
            now.outputs.vertical_momentum
        ));
        assert!(apart(
            before.outputs.axial_momentum,
            now.outputs.axial_momentum
        ));
        let energy = |o: &lagrangian::Observation<HeavyTop>| o.kinetic_energy + o.potential_energy;
        assert!(apart(energy(&before), energy(&now)));
    }
}

/// The position of the mortar's centre in ground axes.
fn mortar(state: &State<Coordinates<VibratingCrusher>>) -> [f64; 2] {
    let q = &state.q;
    [q.x + q.s1 * q.phi1.cos(), q.y + q.s1 * q.phi1.sin()]
}

#[test]
fn a_free_mortar_flies_straight_past_the_pole_of_its_coordinates() {
    // No force acts on the mortar, so its centre stays in place while the platform shakes about it.
    // At a radius of 10⁻⁹ m the angle turns a million times as fast as anything else.
    let crusher = VibratingCrusher::default();
    for radius in [0.02, 1e-3, 1e-6, 1e-9] {
        let mut start = crusher.start();
        start.q.s1 = radius;
        start.q.phi1 = 0.3;
        let run = run(&crusher, start, 1.0);
        let ([x, y], [x0, y0]) = (mortar(run.end()), mortar(&start));
        let moved = (x - x0).hypot(y - y0);
        // The mortar is at rest at the start; an error of its speed, 10⁻¹⁰ per step,
        // moves it for the rest of the run. The error of its angle is multiplied by the
        // radius, which is 10 mm or less.
        let limit = run.statistics().steps as f64 * 1e-10;
        assert!(moved <= limit, "{radius}: {moved:e}");
        // No torque acts on it either.
        assert_eq!(run.end().q.theta1, 0.0);
    }
}

#[test]
fn the_pole_itself_is_named() {
    let crusher = VibratingCrusher {
        omega: 0.0,
        e: 0.0,
        ..Default::default()
    };
    let mut start = crusher.start();
    start.q.s1 = 0.0;
    let simulation = || Simulation::new(&crusher).tolerance(1e-10).until(1.0);
    let error = simulation().run(start).unwrap_err();
    let Error::AssumptionEnded { assumption, t: 0.0 } = &error else {
        panic!("{error}")
    };
    assert!(assumption.contains("s1"));
    // The mortar moves straight to the centre at 1 m/s from 20 mm, with the platform at rest.
    let mut start = crusher.start();
    start.v.s1 = -1.0;
    let (run, error) = simulation().run_as_far_as_possible(start).unwrap();
    let at = match error {
        Some(Error::AssumptionEnded { assumption, t }) if assumption.contains("s1") => t,
        Some(Error::SingularMassMatrix { coordinate, t, .. }) if coordinate == "phi1" => t,
        other => panic!("{other:?}"),
    };
    assert!((at - 0.02).abs() < 1e-12, "{at}");
    assert!(run.end().q.s1.abs() < 1e-12);
    // A top that falls through the singularity of its angles.
    let top = HeavyTop::default();
    let mut start = top.start();
    start.v.phi = 0.0;
    let error = Simulation::new(&top).until(10.0).run(start).unwrap_err();
    let (Error::SingularMassMatrix { t, .. }
    | Error::StepTooSmall { t, .. }
    | Error::NotFinite { t, .. }
    | Error::AssumptionEnded { t, .. }) = error
    else {
        panic!("{error}")
    };
    // A quarter turn from the horizontal, as a pendulum of length l + A/(m l):
    // the time for 90°, in mid-fall.
    assert!(t > 0.5 && t < 0.7, "{t}");
}

#[test]
fn masses_may_differ_a_thousand_million_times() {
    // A light lower bob leaves the upper one a simple pendulum; a heavy upper bob is
    // not affected by the lower one.
    let runs = [
        DoublePendulum {
            m2: 1e-9,
            ..Default::default()
        },
        DoublePendulum {
            m1: 1e9,
            ..Default::default()
        },
    ]
    .map(|machine| run(&machine, machine.start(), 1.5));
    // At 90°, level with the hinge, its speed corresponds to the height fallen,
    // by the energy of a pendulum.
    for run in &runs {
        let (q, v) = (run.end().q, run.end().v);
        let speed =
            (2.0 * 9.81 * (q.theta1.cos() - (2.0 * std::f64::consts::FRAC_PI_3).cos())).sqrt();
        assert!((v.theta1.abs() - speed).abs() < 1e-7, "{v:?} {speed}");
    }
    let apart = (runs[0].end().q.theta2 - runs[1].end().q.theta2).abs();
    assert!(apart < 1e-6, "{apart:e}");

    // A light bob between two rods that carry a heavy bob vibrates at 10⁵ rad/s,
    // and the energy is conserved.
    for (m1, m2) in [(1e-9, 1.0), (1.0, 1e9)] {
        let machine = DoublePendulum {
            m1,
            m2,
            ..Default::default()
        };
        let run = run(&machine, machine.start(), 0.5);
        let balance = run.energy_balance().unwrap();
        // A step can add the round-off of the accelerations, which is 10⁹ times that of the forces.
        let limit = run.statistics().steps as f64 * 1e-7;
        assert!(balance.relative().abs() < limit.min(1e-5), "{balance:?}");
    }
}

#[test]
fn numbers_that_are_none_are_named() {
    for bad in [f64::NAN, f64::INFINITY] {
        let crusher = CushionedCrusher {
            k1: bad,
            ..Default::default()
        };
        let error = Simulation::new(&crusher)
            .until(1.0)
            .run(crusher.start())
            .unwrap_err();
        assert!(matches!(&error, Error::ParameterNotFinite { parameter, .. } if parameter == "k1"));
        let chain = Chain::default();
        let mut start = chain.start();
        start.v.q[2] = bad;
        let error = Simulation::new(&chain).until(1.0).run(start).unwrap_err();
        assert!(
            matches!(&error, Error::StartNotFinite { name, .. } if name == "der(q[3])"),
            "{error}"
        );
    }
    // The values are finite, but too large all the same.
    let heavy = VibratingCrusher {
        m: 1e300,
        omega: 1e200,
        ..Default::default()
    };
    let error = Simulation::new(&heavy)
        .until(1.0)
        .run(heavy.start())
        .unwrap_err();
    assert!(
        matches!(
            &error,
            Error::NotFinite { t: 0.0, .. } | Error::SingularMassMatrix { t: 0.0, .. }
        ),
        "{error}"
    );
}
