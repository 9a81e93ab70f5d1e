//! The energy balance closes and accounts for every loss and gain.

use crate::by_hand::double_pendulum::DoublePendulum;
use crate::by_hand::toy::{Toy, oscillator, pendulum};
use lagrangian::{Error, METHODS, Machine, Simulation, Warning};

/// `x'' = −4 x − 0.3 v + 2 cos(p t) + u`: a spring, a damper, a drive and an input.
fn driven() -> Toy<1> {
    Toy {
        p: 1.7,
        potential_energy: |q, _| 2.0 * q[0] * q[0],
        work_rate: |t, _, v, u, p| (2.0 * (p * t).cos() + u) * v[0],
        dissipation_rate: |v, _| 0.3 * v[0] * v[0],
        ..Toy::new(([0.5], [0.0]), |t, q, v, u, p| {
            [-4.0 * q[0] - 0.3 * v[0] + 2.0 * (p * t).cos() + u]
        })
    }
}

#[test]
fn energy_is_accounted_for_in_a_driven_damped_oscillator() {
    for method in &METHODS {
        for tolerance in [1e-5, 1e-8, 1e-11] {
            let driven = driven();
            let run = Simulation::new(&driven)
                .method(method)
                .tolerance(tolerance)
                .inputs(|t, _, v, u| *u = 0.1 * (3.0 * t).sin() - 0.05 * v[0])
                .until(20.0)
                .energy_balance(true)
                .run(driven.start())
                .unwrap();
            let balance = run.energy_balance().unwrap();
            // At speeds up to 4 m/s, an error of the state causes at most ten times that error in energy, and
            // each step adds one.
            let limit = 10.0 * run.statistics().steps as f64 * tolerance;
            assert!(
                balance.residual().abs() <= limit,
                "{} {balance:?}",
                method.tableau.name
            );
            assert!(balance.relative().abs() <= limit / balance.exchanged);
            // Dampers only take energy, and they take a large part of the drive's work.
            assert!(balance.dissipated > 1.0 && balance.work > 1.0);
            assert!(balance.exchanged > balance.work + balance.dissipated);
        }
    }
}

#[test]
fn the_balance_is_kept_up_to_an_event_within_a_step() {
    let driven = driven();
    let run = Simulation::new(&driven)
        .tolerance(1e-10)
        .until(20.0)
        .until_event("slow", lagrangian::Crossing::Falling, |state| 3.3 - state.t)
        .energy_balance(true)
        .run(driven.start())
        .unwrap();
    let same = Simulation::new(&driven)
        .tolerance(1e-10)
        .until(3.3)
        .energy_balance(true)
        .run(driven.start())
        .unwrap();
    let [one, other] = [&run, &same].map(|run| run.energy_balance().unwrap());
    assert!((run.end().t - 3.3).abs() <= 4.0 * f64::EPSILON);
    let limit = 100.0 * 1e-10;
    assert!((one.work - other.work).abs() <= limit && (one.end - other.end).abs() <= limit);
    assert!((one.dissipated - other.dissipated).abs() <= limit);
    assert!(one.residual().abs() <= limit);
    assert_eq!(run.energies().last().unwrap().t, run.end().t);
}

#[test]
fn work_and_dissipation_are_those_of_the_closed_form() {
    // Free motion against a damper, v = e^(−d t): dissipated ½ (1 − e^(−2 d t)); no force does work.
    let damped = Toy {
        p: 0.7,
        dissipation_rate: |v, p| p * v[0] * v[0],
        ..Toy::new(([0.0], [1.0]), |_, _, v, _, p| [-p * v[0]])
    };
    let run = Simulation::new(&damped)
        .tolerance(1e-12)
        .until(2.0)
        .energy_balance(true)
        .run(damped.start())
        .unwrap();
    for energies in run.energies() {
        let exact = 0.5 * (1.0 - (-1.4 * energies.t).exp());
        assert!((energies.dissipated - exact).abs() <= 1e-12 * 20.0);
        assert!((energies.kinetic - (0.5 - exact)).abs() <= 1e-12 * 20.0);
        assert_eq!(energies.work, 0.0);
    }
    assert_eq!(run.energies().len(), run.statistics().steps + 1);
}

#[test]
fn energies_between_steps_balance_as_well() {
    for method in &METHODS {
        let driven = driven();
        let run = Simulation::new(&driven)
            .method(method)
            .tolerance(1e-9)
            .inputs(|t, _, v, u| *u = 0.1 * (3.0 * t).sin() - 0.05 * v[0])
            .until(20.0)
            .energy_balance(true)
            .run(driven.start())
            .unwrap();
        let times = (0..=200).map(|i| 0.1 * f64::from(i));
        let energies = run.energies_at_each(times).unwrap();
        let limit = 10.0 * run.statistics().steps as f64 * 1e-9;
        for now in &energies {
            let residual = now.residual_since(&energies[0]);
            assert!(
                residual.abs() <= limit,
                "{} {}: {residual:e}",
                method.tableau.name,
                now.t
            );
        }
        let balance = run.energy_balance().unwrap();
        assert_eq!(
            energies[200].residual_since(&energies[0]),
            balance.residual()
        );
    }
}

#[test]
fn backward_in_time_the_balance_closes_too() {
    let driven = driven();
    let run = Simulation::new(&driven)
        .tolerance(1e-10)
        .until(-5.0)
        .energy_balance(true)
        .run(driven.start())
        .unwrap();
    let balance = run.energy_balance().unwrap();
    // Backward in time, dampers supply energy.
    assert!(balance.dissipated < 0.0);
    // Backward, the motion grows by e^(0.15 · 5) = 2, its energy by four.
    let limit = 40.0 * run.statistics().steps as f64 * 1e-10;
    assert!(balance.residual().abs() <= limit, "{balance:?}");
}

#[test]
fn conservative_machines_conserve() {
    let machine = DoublePendulum::default();
    let run = Simulation::new(&machine)
        .tolerance(1e-12)
        .until(20.0)
        .energy_balance(true)
        .run(machine.start())
        .unwrap();
    let balance = run.energy_balance().unwrap();
    let steps = run.statistics().steps as f64;
    // The derivatives of the energy by the state: m g l, and m l² θ'.
    assert!(
        balance.residual().abs() <= 30.0 * steps * 1e-12,
        "{balance:?}"
    );
    assert_eq!((balance.work, balance.dissipated), (0.0, 0.0));

    let pendulum = pendulum(2.0);
    let run = Simulation::new(&pendulum)
        .tolerance(1e-12)
        .until(100.0)
        .energy_balance(true)
        .run(pendulum.start())
        .unwrap();
    let steps = run.statistics().steps as f64;
    assert!(run.energy_balance().unwrap().residual().abs() <= 2.0 * steps * 1e-12);
}

#[test]
fn a_balance_that_nobody_asked_for_is_not_kept() {
    let oscillator = oscillator();
    let run = Simulation::new(&oscillator)
        .until(1.0)
        .run(oscillator.start())
        .unwrap();
    assert_eq!(run.energy_balance(), None);
    assert!(run.energies().is_empty());
    assert_eq!(
        run.energies_at_each([0.5]).unwrap_err(),
        Error::NoEnergyBalance
    );
}

#[test]
fn a_balance_has_no_part_in_the_steps() {
    let driven = driven();
    let [with, without] = [true, false].map(|keep| {
        Simulation::new(&driven)
            .until(9.0)
            .energy_balance(keep)
            .run(driven.start())
            .unwrap()
    });
    assert_eq!(with.end(), without.end());
    assert_eq!(
        with.statistics().evaluations,
        without.statistics().evaluations
    );
}

#[test]
fn a_machine_at_rest_has_nothing_to_balance() {
    let rest = Toy::new(([1.0], [0.0]), |_, _, _, _, _| [0.0]);
    let run = Simulation::new(&rest)
        .until(1.0)
        .energy_balance(true)
        .run(rest.start())
        .unwrap();
    let balance = run.energy_balance().unwrap();
    assert_eq!((balance.residual(), balance.relative()), (0.0, 0.0));
}

#[test]
fn what_the_tolerance_explains_is_no_warning() {
    // Every method, at tolerances from barely one correct digit to the level of rounding; machines that are
    // driven and damped, free, at rest, or stiff compared with their motion.
    let stiff = Toy {
        p: 1e3,
        ..oscillator()
    };
    let resting = Toy {
        start: ([0.0], [0.0]),
        ..oscillator()
    };
    let machines = [
        driven(),
        oscillator(),
        pendulum(3.0),
        pendulum(0.1),
        stiff,
        resting,
    ];
    for method in &METHODS {
        for (i, machine) in machines.iter().enumerate() {
            for exponent in 1..=12 {
                let tolerance = 0.1_f64.powi(exponent);
                if method.tableau.order == 3 && exponent > 8 {
                    continue;
                }
                let until = if i == 4 { 0.3 } else { 30.0 };
                let run = Simulation::new(machine)
                    .method(method)
                    .tolerance(tolerance)
                    .until(until)
                    .energy_balance(true)
                    .run(machine.start())
                    .unwrap();
                let unexplained = |w: &Warning| matches!(w, Warning::EnergyUnexplained { .. });
                let name = method.tableau.name;
                assert!(
                    !run.warnings().iter().any(unexplained),
                    "{name} machine {i} at {tolerance:e}: {:?}",
                    run.energy_balance()
                );
            }
        }
    }
}

#[test]
fn a_force_of_the_wrong_sign_is_a_warning() {
    // The spring, the damper and the drive: each has the wrong sign in the acceleration only.
    let wrong: [Toy<1>; 3] = [
        Toy {
            accelerations: |t, q, v, _, p| [4.0 * q[0] - 0.3 * v[0] + 2.0 * (p * t).cos()],
            ..driven()
        },
        Toy {
            accelerations: |t, q, v, _, p| [-4.0 * q[0] + 0.3 * v[0] + 2.0 * (p * t).cos()],
            ..driven()
        },
        Toy {
            accelerations: |t, q, v, _, p| [-4.0 * q[0] - 0.3 * v[0] - 2.0 * (p * t).cos()],
            ..driven()
        },
    ];
    for machine in &wrong {
        for tolerance in [1e-5, 1e-9] {
            let run = Simulation::new(machine)
                .tolerance(tolerance)
                .until(2.0)
                .energy_balance(true)
                .run(machine.start())
                .unwrap();
            let [
                Warning::EnergyUnexplained {
                    residual,
                    explained,
                    relative,
                },
            ] = run.warnings()
            else {
                panic!("{:?}", run.energy_balance())
            };
            assert!(relative.abs() > 1e-3 && residual.abs() > 10.0 * explained);
        }
    }
}
