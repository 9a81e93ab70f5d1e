//! Energy balances as an identity, equation (E20).

use lagrangian_mechanics::Oracle;

use crate::harness::{all_machines, derived, residues, total};

#[test]
fn energy_changes_by_work_less_dissipation() {
    for (name, text) in all_machines() {
        derived(&text, |model, equations| {
            let oracle = Oracle::derive(model);
            let energy = oracle.kinetic_energy + oracle.potential_energy + equations.state_energy;
            let change = total(model).of(energy);
            let balance = equations.work_rate - equations.dissipation_rate;
            for values in residues(model, equations, &[change, balance], true) {
                assert_eq!(values[0], values[1], "{name}");
            }
        });
    }
}

#[test]
fn bodies_share_the_kinetic_energy() {
    for (name, text) in all_machines() {
        derived(&text, |model, equations| {
            let parts = equations.bodies.iter().map(|body| body.kinetic_energy);
            let sum = model.dag.sum(parts);
            for values in residues(model, equations, &[sum, equations.kinetic_energy], false) {
                assert_eq!(values[0], values[1], "{name}");
            }
        });
    }
}

#[test]
fn what_nothing_drives_has_no_work_rate() {
    for name in [
        "double_pendulum",
        "chain",
        "chain_relative",
        "heavy_top",
        "spinning_chain",
    ] {
        derived(&crate::harness::text_of(name), |_, equations| {
            assert!(equations.work_rate.is_zero(), "{name}");
            assert!(equations.dissipation_rate.is_zero(), "{name}");
        });
    }
}

#[test]
fn quadratic_dissipation_takes_twice_itself() {
    for name in ["vibrating_crusher", "cart_pole", "six_joint_arm"] {
        derived(&crate::harness::text_of(name), |model, equations| {
            let both = [equations.dissipation_rate, 2 * equations.dissipation];
            for values in residues(model, equations, &both, false) {
                assert_eq!(values[0], values[1], "{name}");
            }
        });
    }
}
