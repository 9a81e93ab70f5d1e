//! The settings of a simulation have their stated effects.

use crate::by_hand::as_list::AsList;
use crate::by_hand::double_pendulum::DoublePendulum;
use crate::by_hand::toy::{Toy, oscillator};
use lagrangian::{
    DefaultInputs, Ending, EnergyIntegrals, InputFunction, METHODS, Machine, Method, NoBalance,
    Simulation, Singular, Solution, StepError, Stepper, System, Tolerance,
};
use std::cell::Cell;
use std::error::Error;

#[test]
fn a_run_reads_like_what_it_does() -> Result<(), Box<dyn Error>> {
    let pendulum = DoublePendulum {
        l2: 0.5,
        ..Default::default()
    };
    let start = pendulum.start();
    let run = Simulation::new(&pendulum)
        .tolerance(1e-10)
        .until(5.0)
        .run(start)?;
    println!("{:?}", run.at(2.5)?.q.theta1);
    assert_eq!(*run.ending(), Ending::End);
    assert_eq!((run.start().t, run.end().t), (0.0, 5.0));
    assert_eq!(*run.start(), start);
    Ok(())
}

/// A solution can be returned, kept and copied.
fn run_of(length: f64) -> Solution<DoublePendulum> {
    let pendulum = DoublePendulum {
        l1: length,
        ..Default::default()
    };
    Simulation::new(&pendulum)
        .until(1.0)
        .run(pendulum.start())
        .unwrap()
}

#[test]
fn a_run_outlives_its_machine() {
    let runs: Vec<_> = [0.5, 1.0].map(run_of).to_vec();
    assert_ne!(runs[0].end(), runs[1].end());
    fn is_send_and_sync<T: Send + Sync>(_: &T) {}
    is_send_and_sync(&runs);
}

#[test]
fn the_motion_is_continuous_from_step_to_step() {
    for name in ["dop853", "dopri5", "bs32"] {
        let pendulum = DoublePendulum::default();
        let run = Simulation::new(&pendulum)
            .method(Method::named(name).unwrap())
            .until(3.0)
            .run(pendulum.start())
            .unwrap();
        for state in run.steps() {
            for t in [state.t.next_down(), state.t.next_up()] {
                let Ok(beside) = run.at(t) else { continue };
                // The motion within one unit in the last place of time is less than this bound, which
                // includes the round-off of polynomials.
                let moved = (beside.q.theta1 - state.q.theta1).abs();
                let changed = (beside.v.theta2 - state.v.theta2).abs();
                assert!(
                    moved <= 1e-14 && changed <= 1e-13,
                    "{name} {t}: {moved:e} {changed:e}"
                );
            }
        }
    }
}

#[test]
fn samples_are_the_same_during_a_run_and_after_it() {
    let pendulum = DoublePendulum::default();
    let run = Simulation::new(&pendulum)
        .until(1.0)
        .every(0.03)
        .run(pendulum.start())
        .unwrap();
    // 0, 0.03, …, 0.99, and the end of the run.
    assert_eq!(run.samples().len(), 35);
    assert_eq!(run.samples(), run.every(0.03).unwrap());
    let times: Vec<f64> = run.samples().iter().map(|state| state.t).collect();
    assert_eq!(run.samples(), run.at_each(times).unwrap());
    // The times may be in any order.
    let backward: Vec<f64> = run.samples().iter().rev().map(|state| state.t).collect();
    assert_eq!(run.samples().last(), run.at_each(backward).unwrap().first());
}

#[test]
fn a_sample_at_the_end_is_taken_once() {
    let toy = oscillator();
    // In `f64`, 0.1 · 3 is not 0.3, and 10 · 0.1 is 1.
    for (until, count) in [(0.3, 4), (1.0, 11), (0.35, 5)] {
        let run = Simulation::new(&toy)
            .until(until)
            .every(0.1)
            .run(toy.start())
            .unwrap();
        assert_eq!(run.samples().len(), count, "{until}");
        assert_eq!(run.samples().last().unwrap(), run.end());
    }
}

#[test]
fn everything_can_be_observed_at_any_time() {
    let pendulum = DoublePendulum::default();
    let run = Simulation::new(&pendulum)
        .inputs(|t, q, v, u| u.torque = 2.0 * t - q.theta1 - 0.1 * v.theta1)
        .until(2.0)
        .run(pendulum.start())
        .unwrap();
    let observed = run.observe(1.5).unwrap();
    let state = run.at(1.5).unwrap();
    assert_eq!((observed.q, observed.v), (state.q, state.v));
    let torque = 3.0 - state.q.theta1 - 0.1 * state.v.theta1;
    assert_eq!(observed.inputs.torque, torque);
    let height = -state.q.theta1.cos() - state.q.theta2.cos();
    assert_eq!(observed.outputs.height, height);
    let system = run.system();
    let (q, v) = (system.to_vector(&state.q), system.to_vector(&state.v));
    assert_eq!(observed.kinetic_energy, system.kinetic_energy(1.5, &q, &v));
    let mut a = [0.0; 2];
    system
        .accelerations(1.5, &q, &v, &observed.inputs, &mut a)
        .unwrap();
    assert_eq!(system.to_vector(&observed.a), a);
}

#[test]
fn inputs_start_from_their_defaults_each_time() {
    // A law that sets its input only sometimes must not depend on earlier evaluations.
    let toy = Toy::new(([0.0], [0.0]), |_, _, _, u, _| [u]);
    let run = Simulation::new(&toy)
        .inputs(|t, _, _, u| {
            if t < 1.0 {
                *u = 1.0;
            }
        })
        .tolerance(1e-8)
        .until(3.0)
        .run(toy.start())
        .unwrap();
    assert!((run.end().v[0] - 1.0).abs() < 1e-6);
}

#[test]
fn progress_goes_from_start_to_end() {
    let pendulum = DoublePendulum::default();
    let mut fractions = Vec::new();
    let run = Simulation::new(&pendulum)
        .until(2.0)
        .progress(|progress| {
            assert!(progress.step > 0.0);
            assert_eq!(progress.fraction, progress.t / 2.0);
            fractions.push(progress.fraction);
        })
        .run(pendulum.start())
        .unwrap();
    assert_eq!(fractions.len(), run.statistics().steps);
    assert!(fractions.is_sorted());
    assert_eq!(fractions.last(), Some(&1.0));
}

#[test]
fn a_tighter_tolerance_for_one_coordinate_costs_steps() {
    let pendulum = DoublePendulum::default();
    let simulation = || {
        Simulation::new(&pendulum)
            .relative(1e-6)
            .absolute(1e-4)
            .until(10.0)
    };
    let loose = simulation().run(pendulum.start()).unwrap();
    let tight = simulation()
        .absolute_of("theta2", 1e-10)
        .run(pendulum.start())
        .unwrap();
    assert!(tight.statistics().steps > loose.statistics().steps);
}

#[test]
fn steps_obey_their_limits() {
    let toy = oscillator();
    let run = Simulation::new(&toy)
        .first_step(1e-3)
        .longest_step(0.25)
        .until(10.0)
        .run(toy.start())
        .unwrap();
    let times: Vec<f64> = run.steps().map(|state| state.t).collect();
    assert_eq!(times[1], 1e-3);
    // The last step may be longer by a hundredth.
    assert!(
        times
            .windows(2)
            .all(|pair| pair[1] - pair[0] <= 0.25 * 1.01)
    );
}

#[test]
fn interpreted_vectors_run_like_arrays() {
    // The same machine over Vec<f64> gives the same numbers to the last bit.
    let toy = oscillator();
    let run = Simulation::new(&toy).until(7.0).run(toy.start()).unwrap();
    let list = AsList(toy);
    let tolerance = Tolerance {
        relative: 1e-9,
        absolute: vec![1e-9],
    };
    let start = (0.0, vec![1.0], vec![0.0]);
    let method = Default::default();
    let mut stepper = Stepper::new(
        &list,
        DefaultInputs,
        NoBalance,
        method,
        tolerance,
        start,
        7.0,
    )
    .unwrap();
    while !stepper.is_done() {
        stepper.step().unwrap();
    }
    assert_eq!(
        (stepper.q()[0], stepper.v()[0]),
        (run.end().q[0], run.end().v[0])
    );
}

#[test]
fn an_input_that_is_changed_between_steps_is_seen_by_the_next() {
    // x'' = u with u = 1, −2, 3, …, each for a tenth of a second: parabolas, for which every method is
    // exact. The law reads a cell.
    let mass = Toy::new(([0.0], [0.0]), |_, _, _, u, _| [u]);
    let mass = Toy {
        work_rate: |_, _, v, u, _| u * v[0],
        ..mass
    };
    for method in &METHODS {
        let force = Cell::new(1.0);
        let law = InputFunction(|_, _: &[f64; 1], _: &[f64; 1], u: &mut f64| *u = force.get());
        let tolerance = Tolerance {
            relative: 1e-9,
            absolute: [1e-9],
        };
        let (start, balance) = ((0.0, [0.0], [0.0]), EnergyIntegrals::default());
        let mut stepper = Stepper::new(&mass, law, balance, method, tolerance, start, 0.0).unwrap();
        let (mut x, mut v) = (0.0_f64, 0.0_f64);
        for tenth in 1..=20_i32 {
            let u = f64::from(tenth) * if tenth % 2 == 0 { -1.0 } else { 1.0 };
            force.set(u);
            stepper.inputs_changed();
            // The last step was made with the previous input. A method whose interpolant needs more
            // evaluations reports an error.
            let piece = stepper.interpolant();
            if method.tableau.a.len() > method.tableau.stages + 1 {
                assert!(matches!(piece, Err(StepError::Changed { .. })))
            } else {
                assert!(piece.is_ok())
            }
            stepper.set_end(0.1 * f64::from(tenth));
            let mut t = stepper.t();
            while !stepper.is_done() {
                stepper.step().unwrap();
                let h = stepper.t() - t;
                (x, v, t) = (x + h * (v + 0.5 * h * u), v + h * u, stepper.t());
                let name = method.tableau.name;
                // 20 pieces with up to 20 m/s².
                let limit = 20.0 * 20.0 * 8.0 * f64::EPSILON;
                assert!((stepper.q()[0] - x).abs() <= limit, "{name} {t}");
                assert!((stepper.v()[0] - v).abs() <= limit, "{name} {t}");
                assert_eq!(stepper.a_before(), &[u], "{name} {t}");
            }
        }
        // The work becomes kinetic energy.
        let work = stepper.quadratures().work();
        assert!(
            (work - 0.5 * v * v).abs() <= 1e-11,
            "{}",
            method.tableau.name
        );
    }
}

#[test]
fn a_step_that_is_taken_back_before_a_change_is_taken_with_it() {
    let mass = Toy::new(([0.0], [0.0]), |_, _, _, u, _| [u]);
    let law =
        |force: f64| InputFunction(move |_, _: &[f64; 1], _: &[f64; 1], u: &mut f64| *u = force);
    for method in &METHODS {
        let tolerance = Tolerance {
            relative: 1e-9,
            absolute: [1e-9],
        };
        let start = (0.0, [0.0], [0.0]);
        let mut stepper =
            Stepper::new(&mass, law(1.0), NoBalance, method, tolerance, start, 1.0).unwrap();
        stepper.set_first_step(1.0);
        stepper.step().unwrap();
        stepper.set_law(law(-4.0));
        stepper.retreat(1.0);
        while !stepper.is_done() {
            stepper.step().unwrap();
        }
        let x = stepper.q()[0];
        let name = method.tableau.name;
        assert!((x + 2.0).abs() <= 64.0 * f64::EPSILON, "{name} {x}");
    }
}

#[test]
fn errors_are_told_by_the_names_of_what_was_called() {
    let toy = oscillator();
    for bad in [0.0, -1.0, f64::NAN, 1.0] {
        let refused = Simulation::new(&toy)
            .tolerance(bad)
            .until(1.0)
            .run(toy.start());
        let error = refused.unwrap_err().to_string();
        assert!(error.starts_with("`tolerance("), "{error}");
    }
    let refused = Simulation::new(&toy)
        .tolerance(-1.0)
        .relative(1e-6)
        .until(1.0)
        .run(toy.start());
    assert!(
        refused
            .unwrap_err()
            .to_string()
            .starts_with("`absolute(-1)`")
    );
    // The message prints as many digits as the number needs.
    let error = Simulation::new(&toy)
        .until(1e300)
        .max_steps(10)
        .run(toy.start())
        .unwrap_err()
        .to_string();
    assert!(error.contains("of 1e300 s") && error.len() < 200, "{error}");
}

#[test]
fn an_error_of_a_step_is_an_error() {
    fn fails() -> Result<(), Box<dyn Error>> {
        Err(StepError::Singular {
            singular: Singular::new(1, 0.0, 2.0),
            t: 0.5,
        })?
    }
    let error = fails().unwrap_err().to_string();
    assert!(
        error.contains("coordinate number 2") && error.contains("5e-1 s"),
        "{error}"
    );
}
