//! The matrices of a system agree with its equations of motion.

use crate::by_hand::double_pendulum::{
    DoublePendulum, DoublePendulumCoordinates, DoublePendulumInputs,
};
use lagrangian::matrices::Matrices;
use lagrangian::{Machine, Simulation, State};

#[test]
fn forces_are_mass_times_acceleration() {
    let system = DoublePendulum {
        m1: 2.0,
        l2: 0.7,
        ..Default::default()
    }
    .prepare();
    let state = State {
        t: 0.0,
        q: DoublePendulumCoordinates {
            theta1: 0.3,
            theta2: -1.1,
        },
        v: DoublePendulumCoordinates {
            theta1: 2.0,
            theta2: 0.4,
        },
    };
    let inputs = DoublePendulumInputs { torque: 1.5 };
    let inertia = system.mass_matrix_of(&state);
    assert_eq!(inertia, inertia.transpose());
    let forces = system.forces_of(&state, &inputs);
    assert_eq!(
        forces,
        system.applied_of(&state, &inputs) - system.bias_of(&state)
    );
    let accelerations = system.accelerations_of(&state, &inputs).unwrap();
    let missing = &inertia * accelerations - &forces;
    // A 2 × 2 solve: a few rounding units times the condition of M.
    assert!(missing.norm() <= 64.0 * f64::EPSILON * forces.norm());
}

#[test]
fn states_become_vectors_and_come_back() {
    let machine = DoublePendulum::default();
    let system = machine.prepare();
    let run = Simulation::new(&machine)
        .until(1.0)
        .run(machine.start())
        .unwrap();
    let vector = system.state_vector(run.end());
    assert_eq!(system.state_from_vector(1.0, &vector).unwrap(), *run.end());
    assert!(
        system
            .state_from_vector(1.0, &vector.remove_row(0))
            .is_none()
    );
    let states = run.every(0.25).unwrap();
    let table = system.state_table(&states);
    assert_eq!(table.shape(), (5, 5));
    assert_eq!((table[(2, 0)], table[(2, 3)]), (0.5, states[2].v.theta1));
}
