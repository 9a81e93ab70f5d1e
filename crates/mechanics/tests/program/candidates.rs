//! Every candidate program, whether the compiler chose it or not.

use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::Equations;
use lagrangian_mechanics::Proved;
use lagrangian_program::{Candidate, Choice, MOST_ROUNDING, Role};
use lagrangian_spec::diagnostic::Report;

use crate::harness::{all_machines, machine, program, program_of_output};
use crate::machines::{assert_mistakes_are_found, assert_proved, mistakes_found};

/// The programs of a machine: the first has all functions in their first candidate, the second in their
/// second one, or the last where there are fewer, and so on.
fn every_program(machine: &Compiled<'_>) -> Vec<Proved> {
    let model = &machine.model;
    // The equations in `machine` may have been multiplied out already.
    let equations = Equations::derive(model, &mut Report::new()).expect("derived before");
    let expanded = equations.expanded();
    let lower = |choose: &dyn Fn(&[Candidate]) -> usize| {
        let program = lagrangian_mechanics::lower_by(model, &equations, expanded.as_ref(), choose);
        Proved::new(program, model, &equations).expect("a proof")
    };
    let taken = &machine.program;
    let ways = taken.choices.iter().map(|choice| choice.candidates.len());
    let ways = ways.max().unwrap_or(1);
    (0..ways).map(|index| lower(&|_| index)).collect()
}

/// Runs a check with each of these programs in place of the chosen one.
fn for_every_program(machine: &Compiled<'_>, mut check: impl FnMut(&Compiled<'_>)) {
    for program in every_program(machine) {
        check(&Compiled {
            program,
            ..machine.clone()
        });
    }
}

#[test]
fn every_candidate_obeys_lagranges_equations() {
    for name in all_machines() {
        machine(&name, &[], |machine| {
            for_every_program(machine, assert_proved);
        });
    }
}

#[test]
fn every_candidate_for_a_chain_obeys_lagranges_equations() {
    for n in 1..=5 {
        for name in ["chain", "chain_relative"] {
            machine(name, &[("N", n)], |machine| {
                for_every_program(machine, assert_proved);
            });
        }
    }
}

#[test]
fn no_mistake_in_any_candidate_survives() {
    for (name, stride) in [("double_pendulum", 1), ("heavy_top", 2), ("crusher9", 13)] {
        machine(name, &[], |machine| {
            for_every_program(machine, |machine| {
                assert_mistakes_are_found(machine, stride);
            });
        });
    }
}

/// Tests a sample of about thirty mistakes in every candidate of every machine.
#[test]
fn no_mistake_in_a_sample_from_any_machine_survives() {
    let (mut tried, mut idle) = (0, 0);
    for name in all_machines() {
        machine(&name, &[], |machine| {
            for_every_program(machine, |machine| {
                let functions = machine.program.all_functions();
                let statements: usize = functions.map(|f| f.code.len()).sum();
                // Most statements may be wrong in two ways; an odd stride samples both.
                let stride = (2 * statements / 30) | 1;
                let (made, without_effect) = mistakes_found(machine, stride);
                assert!(made >= 10, "{name}: {made}");
                tried += made;
                idle += without_effect;
            });
        });
    }
    // After loops are cut and closed again, accelerations do not depend on forces across the
    // constraints, so mistakes in these are only found in the multipliers.
    assert!(40 * idle <= tried, "{idle} of {tried}");
}

#[test]
fn there_is_a_machine_for_every_way() {
    let mut ways: Vec<String> = Vec::new();
    for name in ["crusher9", "double_pendulum"] {
        machine(name, &[], |machine| {
            let choice = machine.program.choice(Role::Accelerations);
            let candidates = &choice.expect("several ways").candidates;
            ways.extend(
                candidates
                    .iter()
                    .map(|candidate| candidate.form.to_string()),
            );
        });
    }
    ways.sort();
    ways.dedup();
    let all = [
        "eliminated along the machine",
        "eliminated along the machine, factored",
        "eliminated along the machine, pivots ahead",
        "eliminated along the machine, pivots ahead, factored",
        "from the mass matrix",
        "from the mass matrix multiplied out",
        "from the mass matrix multiplied out, factored",
        "from the mass matrix, factored",
    ];
    assert_eq!(ways, all);
}

#[test]
fn the_record_tells_what_was_taken() {
    for name in all_machines() {
        machine(&name, &[], |machine| {
            let program = &machine.program;
            for choice in &program.choices {
                let function = program
                    .function(choice.role())
                    .expect("what was chosen for");
                let chosen = choice.chosen();
                assert_eq!(chosen.counts, function.counts(), "{name}: {}", chosen.form);
                assert_eq!(chosen.cost, function.cost(), "{name}: {}", chosen.form);
                let most_exact = choice.candidates.iter().filter_map(|c| c.rounding).min();
                let Some(most_exact) = most_exact else {
                    // A result that is 0 at all states, such as the bias of a drive that is at rest by
                    // default, has no rounding error.
                    assert!(
                        choice
                            .others()
                            .iter()
                            .all(|other| chosen.compare(other).is_le())
                    );
                    continue;
                };
                let is_exact = |candidate: &Candidate| {
                    let rounding = candidate.rounding.expect("known for all or none");
                    rounding.units() <= MOST_ROUNDING as f64 * most_exact.units()
                };
                assert!(is_exact(chosen), "{name}: {chosen}");
                for other in choice.others() {
                    assert!(
                        chosen.compare(other).is_le() || !is_exact(other),
                        "{name}: {chosen}, but {other}"
                    );
                    assert_ne!(chosen.form, other.form);
                }
            }
        });
    }
}

/// The choice for a double pendulum with these parameters and this assumption.
fn choice_of_double_pendulum(parameters: &str, assumption: &str) -> Choice {
    let program = program(&format!(
        "machine Test in plane {{
            parameters {{ {parameters} }}
            coordinates {{ a: rad = 0.5, b: rad = 0.3 }}
            assume {{ {assumption} }}
            frames {{ upper = ground.turn(a).shift(0, -l), lower = upper.turn(b).shift(0, -l) }}
            bodies {{ upper {{ mass: m, at: upper.origin }}, lower {{ mass: m, at: lower.origin }} }}
            gravity (0, -g);
        }}"
    ));
    let choice = program.choice(Role::Accelerations);
    choice.expect("several ways").clone()
}

#[test]
fn parameters_without_defaults_are_no_obstacle() {
    let known = "l: m = 1.2, m: kg = 0.7, g: m/s^2 = 9.81";
    let with = choice_of_double_pendulum(known, "");
    let without = choice_of_double_pendulum("l: m, m: kg, g: m/s^2", "");
    for (with, without) in with.candidates.iter().zip(&without.candidates) {
        // The states differ in some respects, but they are states of the same machine.
        let ratio = |a: &Candidate, b: &Candidate| {
            let units = |c: &Candidate| c.rounding.expect("regular states").units();
            units(a) / units(b)
        };
        assert_eq!(with.form, without.form);
        assert!(
            ratio(with, without).ln().abs() < 3.0_f64.ln(),
            "{with}, {without}"
        );
    }
}

#[test]
fn where_no_state_is_regular_cost_decides() {
    let parameters = [
        // Links without length: no acceleration exists.
        ("l: m = 0, m: kg = 0.7, g: m/s^2 = 9.81", ""),
        // The assumption never holds.
        ("l: m = 1.2, m: kg = 1, g: m/s^2 = 9.81", "l*sin(a) > 2*l"),
        // The assumption holds too rarely for sampling to find a state.
        (
            "l: m = 1.2, m: kg = 1, g: m/s^2 = 9.81",
            "sin(a) > 0.999999999999",
        ),
        // Numbers overflow.
        ("l: m = 1e200, m: kg = 1e200, g: m/s^2 = 9.81", ""),
    ];
    for (parameters, assumption) in parameters {
        let choice = choice_of_double_pendulum(parameters, assumption);
        let unknown = |candidate: &Candidate| candidate.rounding.is_none();
        assert!(choice.candidates.iter().all(unknown), "{parameters}");
        let others = choice.others();
        assert!(
            others
                .iter()
                .all(|other| choice.chosen().compare(other).is_le())
        );
    }
}

#[test]
fn common_factors_are_taken_out() {
    // x (y cos y + x (sin y + x y)), compared with x² y x + x² sin y + x y cos y,
    // where x y and x² are shared.
    let program = program_of_output("", "x^3*y + x^2*sin(y) + x*y*cos(y)");
    let choice = program.choice(Role::Output(0)).expect("two ways");
    let counts = choice.candidates.iter().map(|candidate| {
        let multiplications = candidate.counts.multiplications;
        (
            candidate.form.factored,
            multiplications,
            candidate.counts.additions,
        )
    });
    assert_eq!(counts.collect::<Vec<_>>(), [(false, 5, 2), (true, 4, 2)]);
}

#[test]
fn a_common_reciprocal_is_taken_out() {
    let program = program_of_output("", "sin(x)/(1 + y) + cos(x)/(1 + y)");
    let function = program.function(Role::Output(0)).expect("the output");
    let counts = function.counts().to_string();
    assert_eq!(counts, "1 mul, 2 add, 1 div, 1 sincos");
}
