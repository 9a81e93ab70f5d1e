//! The equations show which quantities are zero, constant or independent of a coordinate.

use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::Equations;
use lagrangian_program::{Basis, Candidate, Role};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::{Model, stage};

use crate::harness::{derived, resolved, text_of};

/// The number of entries of the lower triangle of M that are 0, and of those
/// that depend on parameters only.
fn pattern(equations: &Equations) -> (usize, usize) {
    let entries = equations.mass_matrix.lower();
    let zeros = entries.iter().filter(|entry| entry.is_zero()).count();
    let fixed = entries
        .iter()
        .filter(|entry| entry.stage() <= stage::PARAMETER)
        .count();
    (zeros, fixed - zeros)
}

#[test]
fn half_of_the_crushers_mass_matrix_is_zero() {
    derived(&text_of("vibrating_crusher"), |_, equations| {
        // The constant entries are the diagonal ones of x, y, theta, s1, theta1, s2 and theta2.
        assert_eq!(pattern(equations), (22, 7));
    });
}

#[test]
fn a_bar_that_turns_has_constant_inertia_in_absolute_angles() {
    derived(&text_of("chain"), |model, equations| {
        for i in 0..model.coordinates.len() {
            assert!(equations.mass_matrix.get(i, i).stage() <= stage::PARAMETER);
        }
    });
}

#[test]
fn a_tops_equations_do_not_know_how_far_it_has_turned() {
    derived(&text_of("heavy_top"), |model, equations| {
        assert_free_of(model, equations, &["psi", "phi"]);
    });
}

#[test]
fn a_spinning_chain_does_not_know_which_way_it_looks() {
    derived(&text_of("spinning_chain"), |model, equations| {
        assert_free_of(model, equations, &["q[1]"]);
    });
}

#[test]
fn an_arm_does_not_know_which_way_its_column_has_turned() {
    derived(&text_of("six_joint_arm"), |model, equations| {
        assert_free_of(model, equations, &["q[1]"]);
    });
}

fn assert_free_of(model: &Model, equations: &Equations, names: &[&str]) {
    for name in names {
        let found = model
            .coordinates
            .iter()
            .find(|c| c.name.to_string() == *name);
        let symbol = found.and_then(|c| c.q.as_symbol()).expect("a coordinate");
        let all = equations
            .mass_matrix
            .lower()
            .iter()
            .chain(&equations.forces);
        assert!(all.clone().all(|entry| !entry.depends_on(symbol)), "{name}");
    }
}

#[test]
fn the_same_machine_gives_the_same_equations() {
    let listing = || {
        derived(&text_of("six_joint_arm"), |model, equations| {
            let forces: Vec<_> = equations.forces.iter().map(|f| f.id()).collect();
            (model.dag.len(), forces)
        })
    };
    assert_eq!(listing(), listing());
}

#[test]
fn a_small_machine_takes_fewer_operations_multiplied_out() {
    // Multiplications and additions of the accelerations; projection alone takes 40, 25 and 46. The
    // choice depends on more than these: the top is not multiplied out, since its two divisions
    // would depend on each other.
    for (name, ops) in [
        ("double_pendulum", 29),
        ("cart_pole", 19),
        ("heavy_top", 31),
    ] {
        resolved(&text_of(name), |model| {
            let compiled = Compiled::new(model.clone(), &mut Report::new()).expect("it derives");
            let choice = compiled.program.choice(Role::Accelerations);
            let candidates = &choice.expect("several forms").candidates;
            let fewest = |is_expanded: bool| {
                let basis = |c: &&Candidate| (c.form.basis == Basis::Expanded) == is_expanded;
                let counts = candidates.iter().filter(basis).map(|c| c.counts.ops());
                counts.min().expect("both forms were made")
            };
            assert!(
                fewest(true) <= ops && fewest(true) < fewest(false),
                "{candidates:?}"
            );
        });
    }
}
