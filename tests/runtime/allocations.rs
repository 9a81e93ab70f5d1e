//! Steps allocate nothing, and runs allocate only what they keep.

use crate::by_hand::constrained::{Constrained, circle, parallelogram};
use crate::by_hand::double_pendulum::DoublePendulum;
use crate::by_hand::toy::oscillator;
use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{
    DefaultInputs, EnergyIntegrals, InputFunction, METHODS, Machine, Method, NoBalance, Simulation,
    Stepper, System, TAYLOR, Tolerance,
};

fn allocations(of: impl FnOnce()) -> u64 {
    allocation_counter::measure(of).count_total
}

#[test]
fn a_whole_run_of_the_core_allocates_nothing() {
    let machine = DoublePendulum::default();
    let start = machine.start();
    for method in &METHODS {
        let count = allocations(|| {
            let system = machine.prepare();
            let tolerance = Tolerance {
                relative: 1e-8,
                absolute: [1e-8; 2],
            };
            let start = (0.0, system.to_vector(&start.q), system.to_vector(&start.v));
            let mut stepper = Stepper::new(
                &system,
                DefaultInputs,
                NoBalance,
                method,
                tolerance,
                start,
                5.0,
            )
            .unwrap();
            while !stepper.is_done() {
                stepper.step().unwrap();
                let piece = stepper.interpolant().unwrap();
                assert!(piece.state_at(0.5).0[0].is_finite());
            }
            assert!(stepper.work().steps > 20);
        });
        // An implicit method allocates its matrices once, so the number of allocations does not depend on the length of the run.
        let most = if method.tableau.spectrum.is_some() {
            ROOM_OF_IMPLICIT
        } else {
            0
        };
        assert!(count <= most, "{}: {count}", method.tableau.name);
    }
}

/// Vectors and matrices of an implicit method with three stages: those of its derivatives (9), of the real factorization (matrix, inverse
/// diagonal, exchanges) and of the complex one (two matrices), of their right-hand sides (3), of its stages (two each), of changes, their
/// scales and errors (two each), in one box, and the lists that hold one item per stage or per pair of eigenvalues (4).
const ROOM_OF_IMPLICIT: u64 = 9 + (3 + 4) + 3 + 2 * 3 + 3 * 2 + 1 + 4;

#[test]
fn inputs_and_a_balance_of_energy_allocate_nothing() {
    let machine = DoublePendulum::default();
    let system = machine.prepare();
    let count = allocations(|| {
        let law = InputFunction(
            |t: f64,
             _: &crate::by_hand::double_pendulum::DoublePendulumCoordinates,
             v: &crate::by_hand::double_pendulum::DoublePendulumCoordinates,
             u: &mut crate::by_hand::double_pendulum::DoublePendulumInputs| {
                u.torque = t.sin() - v.theta1;
            },
        );
        let tolerance = Tolerance {
            relative: 1e-8,
            absolute: [1e-8; 2],
        };
        let start = (0.0, [0.1, 0.2], [0.0, 0.0]);
        let balance = EnergyIntegrals::default();
        let mut stepper =
            Stepper::new(&system, law, balance, &METHODS[0], tolerance, start, 5.0).unwrap();
        while !stepper.is_done() {
            stepper.step().unwrap();
        }
        assert!(stepper.quadratures().work() != 0.0);
    });
    assert_eq!(count, 0);
}

#[test]
fn a_longer_run_that_keeps_nothing_allocates_no_more() {
    let oscillator = oscillator();
    for method in &METHODS {
        let [short, long] = [10.0, 1000.0].map(|until| {
            allocations(|| {
                let run = Simulation::new(&oscillator)
                    .method(method)
                    .tolerance(1e-7)
                    .forget_steps()
                    .until(until)
                    .run(oscillator.start())
                    .unwrap();
                assert!(run.statistics().steps > 10);
            })
        });
        assert_eq!(short, long, "{}", method.tableau.name);
    }
}

/// What a run of a machine that is read does at each step besides: energies, what explains their residual, and the question whether to stop.
#[test]
fn a_longer_run_of_a_machine_that_is_read_allocates_hardly_more() {
    let text = "machine Swing in plane {
        parameters { m: kg = 1, l: m = 1, g: m/s^2 = 9.81 }
        coordinates { theta: rad = 2, phi: rad = 1 }
        bodies { bob { mass: m, at: l*(sin(theta), -cos(theta)) }, other { mass: m, at: l*(sin(phi), -cos(phi)) } }
        gravity (0, -g);
    }";
    let machine = InterpretedMachine::from_text(text).build().unwrap();
    for method in [Method::DOP853, &TAYLOR] {
        let run = |until: f64| {
            let simulation = Simulation::new(&machine).method(method).tolerance(1e-10);
            let simulation = simulation
                .energy_balance(true)
                .forget_steps()
                .forget_energies();
            let simulation = simulation.stop_if(|_| false).until(until);
            simulation.run(machine.start()).unwrap().statistics().steps
        };
        let mut steps = [run(1.0); 2];
        let of_short = allocations(|| steps[0] = run(50.0));
        let of_long = allocations(|| steps[1] = run(100.0));
        let [fewer, more] = steps;
        // Costly bounds are computed anew when the number of steps is a power of two: once more, with two vectors of their own, two for each of the
        // two coordinates, and four of moved coordinates.
        assert!(
            of_long - of_short <= 2 + 2 * 2 + 4 && more > fewer + 100,
            "{}: {of_short} for {fewer} steps, {of_long} for {more}",
            method.tableau.name
        );
    }
}

#[test]
fn what_is_kept_of_a_run_grows_by_doubling() {
    let oscillator = oscillator();
    let count = allocations(|| {
        let run = Simulation::new(&oscillator)
            .until(1000.0)
            .run(oscillator.start())
            .unwrap();
        assert!(run.statistics().steps > 1000);
    });
    assert!(count < 64, "{count}");
}

#[test]
fn constraints_are_kept_without_allocating() {
    fn count<const N: usize, const M: usize, const NN: usize>(
        machine: Constrained<N, M, NN>,
    ) -> u64 {
        allocations(|| {
            let tolerance = Tolerance {
                relative: 1e-8,
                absolute: [1e-8; N],
            };
            let (q, v) = machine.start;
            let mut stepper = Stepper::new(
                &machine,
                DefaultInputs,
                NoBalance,
                &METHODS[0],
                tolerance,
                (0.0, q, v),
                5.0,
            )
            .unwrap();
            while !stepper.is_done() {
                stepper.step().unwrap();
                let (mut q, mut v) = stepper.interpolant().unwrap().state_at(0.5);
                let t = 0.5 * (stepper.t_before() + stepper.t());
                stepper.project(t, &mut q, &mut v).unwrap();
            }
            assert!(stepper.work().steps > 20);
        })
    }
    assert_eq!(count(circle::<1>()), 0);
    assert_eq!(count(circle::<3>()), 0);
    assert_eq!(count(parallelogram(1.0)), 0);
}

#[test]
fn a_loop_around_a_stepper_of_its_own_allocates_nothing() {
    let machine = DoublePendulum::default();
    for method in [Method::DOP853, Method::DOPRI5, Method::BS32] {
        let count = allocations(|| {
            let stepper = Stepper::builder(machine.prepare())
                .method(method)
                .tolerance(1e-8);
            let mut stepper = stepper.start(machine.start()).unwrap();
            for tick in 1..=1000 {
                let mut inputs = *stepper.inputs();
                inputs.torque = -stepper.state().v.theta1;
                stepper.set_inputs(inputs);
                stepper.advance_to(f64::from(tick) * 1e-3).unwrap();
                let middle = 0.5 * (stepper.t_before() + stepper.t());
                assert!(stepper.state_at(middle).unwrap().q.theta1.is_finite());
            }
        });
        assert_eq!(count, 0, "{}", method.tableau.name);
    }
}
