//! Simulations in lanes: each equals the simulation alone, bit for bit, with its events, contacts and energies.

use crate::support::random::SplitMix;
use lagrangian::{Batched, Coordinates, Crossing, Machine, Method, Simulation, State};
use lagrangian_machines::{CollidingCrusher, FourBar, VibratingCrusher};

lagrangian::machine! {
    /// A ball between a floor from which it bounces and a compliant ceiling.
    machine Bouncer in plane {
        parameters { m: kg = 0.1, e: 1 = 0.7, k: N/m = 900, d: N*s/m = 0.1, g: m/s^2 = 9.81 }
        coordinates { y: m = 0.5, der(y): m/s = 4 }
        bodies { ball { mass: m, at: (0, y) } }
        gravity (0, -g);
        contacts {
            floor { gap: y, restitution: e },
            ceiling { gap: 1 - y, compliance: linear(k, d) },
        }
    }
}

lagrangian::machine! {
    /// A pendulum on a cart that is driven and damped.
    machine Driven in plane {
        parameters { m: kg = 1, l: m = 0.8, k: N/m = 40, d: N*s/m = 0.5, A: m = 0.1, w: rad/s = 6, g: m/s^2 = 9.81 }
        coordinates { x: m = 0.1, theta: rad = 1 }
        bodies { cart { mass: m, at: (x, 0) }, bob { mass: m, at: (x + l*sin(theta), -l*cos(theta)) } }
        gravity (0, -g);
        springs { spring { stiffness: k, stretch: x - A*sin(w*t) } }
        dampers { damper { damping: d, stretch: x } }
        methods { taylor }
    }
}

lagrangian::machine! {
    /// A ball on a damped spring between a floor from which it bounces and a compliant ceiling, with the series of its flights.
    machine Sprung in plane {
        parameters { m: kg = 0.1, e: 1 = 0.7, k: N/m = 900, c: N/m = 3, d: N*s/m = 0.02, F: N = 1.5, w: rad/s = 7, g: m/s^2 = 9.81 }
        coordinates { y: m = 0.5, der(y): m/s = 4 }
        bodies { ball { mass: m, at: (0, y) } }
        gravity (0, -g);
        springs { spring { stiffness: c, stretch: y - 0.3 } }
        dampers { damper { damping: d, stretch: y } }
        forces { drive { on: y, value: F*cos(w*t) } }
        contacts {
            floor { gap: y, restitution: e },
            ceiling { gap: 1 - y, compliance: linear(k, d) },
        }
        methods { taylor }
    }
}

/// A simulation of one of many machines.
fn simulation<'m, M: Machine>(
    machine: &'m M,
    (method, until): (&'static Method, f64),
) -> Simulation<'m, M> {
    let first = |state: &State<Coordinates<M>>| {
        let numbers = format!("{:?}", state.q);
        let number = numbers.split([':', ',', '}', ']', ')']).nth(1);
        number
            .and_then(|text| text.trim().parse().ok())
            .unwrap_or(1.0)
    };
    Simulation::new(machine)
        .method(method)
        .tolerance(1e-8)
        .until(until)
        .every(0.1 * until)
        .energy_balance(true)
        .event("the first coordinate is 0", Crossing::Any, first)
}

/// Compares runs in lanes with runs alone, in groups of several sizes. Returns how many events of contacts there were.
fn compare<M>(machines: &[M], method: &'static Method, until: f64) -> usize
where
    M: Machine<System: Batched<8>>,
{
    let run = |machine| (simulation::<M>(machine, (method, until)), M::start(machine));
    let alone: Vec<String> = machines
        .iter()
        .map(|machine| {
            let (simulation, start) = run(machine);
            seen(simulation.run_as_far_as_possible(start))
        })
        .collect();
    for group in [1, 3, 8, machines.len()] {
        let mut found = Vec::new();
        for machines in machines.chunks(group) {
            found.extend(
                Simulation::run_in_lanes(machines.iter().map(run).collect())
                    .into_iter()
                    .map(seen),
            );
        }
        assert!(found.len() == alone.len());
        for (found, alone) in found.iter().zip(&alone) {
            assert!(
                found == alone,
                "groups of {group}: {found}\ninstead of\n{alone}"
            );
        }
    }
    alone
        .iter()
        .map(|run| run.matches("ContactEvent {").count())
        .sum()
}

/// All that a run has found, in enough digits to tell any two numbers apart.
fn seen<M: Machine>(
    made: Result<(lagrangian::Solution<M>, Option<lagrangian::Error>), lagrangian::Error>,
) -> String {
    match made {
        Err(error) => format!("{error:?}"),
        Ok((run, error)) => {
            let mut statistics = run.statistics();
            statistics.seconds = 0.0;
            let phases = run.contact_phases().len();
            let steps: Vec<_> = run.steps().collect();
            format!(
                "{error:?} {statistics:?} {:?} {:?} {:?} {:?} {:?} {:?} {phases} {steps:?}",
                run.end(),
                run.samples(),
                run.events(),
                run.contact_events(),
                run.energies(),
                run.contact_energies(),
            )
        }
    }
}

#[test]
fn steps_by_series_are_the_same_in_lanes() {
    let mut random = SplitMix::new(17);
    let machines: Vec<Driven> = (0..19)
        .map(|_| Driven {
            l: random.uniform(0.5, 1.5),
            w: random.uniform(1.0, 9.0),
            ..Default::default()
        })
        .collect();
    assert_eq!(compare(&machines, Method::TAYLOR, 4.0), 0);
}

/// Flights go by series, in lanes as well, and while a contact is closed each run goes by `dop853`, alone.
#[test]
fn flights_by_series_are_the_same_in_lanes() {
    let mut random = SplitMix::new(18);
    let balls: Vec<Sprung> = (0..19)
        .map(|_| Sprung {
            e: random.uniform(0.6, 0.9),
            w: random.uniform(5.0, 9.0),
            ..Default::default()
        })
        .collect();
    assert!(compare(&balls, Method::TAYLOR, 3.0) > 100);
    for ball in &balls {
        let run = |method| {
            let run = simulation(ball, (method, 1.5)).tolerance(1e-12);
            run.run(ball.start()).unwrap()
        };
        let (explicit, by_series) = (run(Method::DOP853), run(Method::TAYLOR));
        let pairs = explicit
            .contact_events()
            .iter()
            .zip(by_series.contact_events());
        for (one, other) in pairs {
            assert_eq!((&one.contact, one.kind), (&other.contact, other.kind));
            assert!((one.state.t - other.state.t).abs() < 1e-10);
        }
        let balance = by_series.energy_balance().unwrap();
        assert!(balance.residual().abs() < 1e-10, "{balance:?}");
        assert!((explicit.end().q.y - by_series.end().q.y).abs() < 1e-9);
        assert!(by_series.choices().len() > 2);
        assert!(by_series.statistics().evaluations < explicit.statistics().evaluations);
    }
}

#[test]
fn contacts_constraints_and_free_motion_are_the_same_in_lanes() {
    let mut random = SplitMix::new(16);
    let mut near = |value: f64| value * random.uniform(0.8, 1.2);
    for method in [Method::DOP853, Method::DOPRI5] {
        let balls: Vec<Bouncer> = (0..19)
            .map(|_| Bouncer {
                e: near(0.7),
                k: near(900.0),
                ..Default::default()
            })
            .collect();
        assert!(compare(&balls, method, 3.0) > 200);
        let crushers: Vec<CollidingCrusher> = (0..11)
            .map(|_| CollidingCrusher {
                w: near(150.0),
                mu: near(0.3),
                ..Default::default()
            })
            .collect();
        assert!(compare(&crushers, method, 0.1) > 40);
        let bars: Vec<FourBar> = (0..9)
            .map(|_| FourBar {
                omega: near(4.0),
                ..Default::default()
            })
            .collect();
        assert_eq!(compare(&bars, method, 0.5), 0);
        let crushers: Vec<VibratingCrusher> = (0..17)
            .map(|_| VibratingCrusher {
                omega: near(150.0),
                ..Default::default()
            })
            .collect();
        assert_eq!(compare(&crushers, method, 0.1), 0);
    }
}

/// A run whose mass is not a number cannot begin; it and the others keep their places in the results.
#[test]
fn runs_that_cannot_begin_keep_their_places() {
    let masses = [0.1, f64::NAN, 0.2, f64::NAN, 0.3];
    let balls = masses.map(|m| Bouncer {
        m,
        ..Default::default()
    });
    compare(&balls, Method::DOP853, 1.0);
    let run = |ball| (Simulation::new(ball).until(1.0), Bouncer::start(ball));
    let made = Simulation::run_in_lanes(balls.iter().map(run).collect());
    let begun: Vec<bool> = made.iter().map(|made| made.is_ok()).collect();
    assert_eq!(begun, [true, false, true, false, true]);
}

/// Implicit methods, and inputs that change, are run alone.
#[test]
fn what_lanes_cannot_do_is_run_alone() {
    let balls: Vec<Bouncer> = (0..5)
        .map(|i| Bouncer {
            e: 0.5 + 0.1 * f64::from(i),
            ..Default::default()
        })
        .collect();
    assert!(compare(&balls, Method::RADAU5, 1.0) > 10);
}
