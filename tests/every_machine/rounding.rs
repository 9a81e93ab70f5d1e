//! Accelerations are as accurate as the condition of the mass matrix permits, at random states of
//! every machine of the library.

use crate::support::library;
use crate::support::sampling::{Random, accurate};
use crate::support::states::accelerations;
use lagrangian::Machine;
use lagrangian::interpreted::InterpretedMachine;

const STATES: usize = 200;

#[test]
fn accelerations_are_as_exact_as_the_mass_matrix_allows() {
    macro_rules! check {
        ($machine:ident, $name:literal) => {
            let machine = lagrangian_machines::$machine::default();
            accurate(&machine, &library::program($name, &[]), STATES, |_| ());
        };
    }
    crate::for_each_machine!(check);
}

/// Both perform the same operations in the same order, so they round alike.
#[test]
fn interpreted_and_compiled_machines_accelerate_the_same_to_the_last_bit() {
    macro_rules! check {
        ($machine:ident, $name:literal) => {
            let compiled = lagrangian_machines::$machine::default();
            let interpreted = InterpretedMachine::new(library::program($name, &[])).prepare();
            let mut random = Random::new(&compiled, 1);
            for _ in 0..STATES {
                let at = random.sample();
                let compiled = accelerations(&random.system, at.t, &at.q, &at.v);
                let interpreted = accelerations(&interpreted, at.t, &at.q, &at.v);
                assert_eq!(compiled, interpreted, "{}: {:?}", $name, at.q);
            }
        };
    }
    crate::for_each_machine!(check);
    crate::for_each_constrained_machine!(check);
}
