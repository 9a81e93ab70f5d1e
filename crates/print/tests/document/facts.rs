//! The facts that a chapter states (conserved or absent quantities) compared with the literal Lagrange equations: a fact
//! is stated exactly if it holds.

use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::Oracle;
use lagrangian_mechanics::equations::integrals::{EnergyBalance, EquationProperties};
use lagrangian_scalar::{Residue, Scalar};
use lagrangian_spec::model::stage;
use lagrangian_symbolic::{Expr, Symbol, Tangent, evaluate};

use crate::every_machine;
use crate::harness::{residues, total};

/// For each expression, whether it is zero at all points, with the accelerations of the motion if `moving`.
fn vanish(compiled: &Compiled<'_>, expressions: &[Expr<'_>], moving: bool) -> Vec<bool> {
    let points = residues(&compiled.model, &compiled.equations, expressions, moving);
    let zero = |k: usize| points.iter().all(|values| values[k] == Residue::ZERO);
    (0..expressions.len()).map(zero).collect()
}

fn symbol(expression: Expr<'_>) -> Symbol {
    expression.as_symbol().expect("a symbol")
}

#[test]
fn cyclic_coordinates_are_those_that_no_energy_depends_on() {
    let mut found = 0;
    every_machine(|name, compiled| {
        let model = &compiled.model;
        let oracle = Oracle::derive(model);
        let facts = EquationProperties::of(model, &compiled.equations);
        let slopes = model.coordinates.iter().flat_map(|c| {
            [oracle.kinetic_energy, oracle.potential_energy].map(|energy| energy.diff(symbol(c.q)))
        });
        let zero = vanish(compiled, &slopes.collect::<Vec<_>>(), false);
        // The integral of a state is absent from the energies, too, but it is not a coordinate of the machine.
        let is_integral = |i: usize| {
            model.coordinates[i]
                .name
                .to_string()
                .starts_with("integral(")
        };
        let expected = (0..model.coordinates.len())
            .filter(|&i| !is_integral(i) && zero[2 * i] && zero[2 * i + 1]);
        let said = facts.cyclic.iter().map(|cyclic| cyclic.coordinate);
        assert_eq!(
            said.collect::<Vec<_>>(),
            expected.collect::<Vec<_>>(),
            "{name}"
        );
        found += facts.cyclic.len();
    });
    assert!(found >= 6, "{found}");
}

#[test]
fn momenta_are_conserved_exactly_where_it_is_said() {
    let (mut conserved, mut changed) = (0, 0);
    every_machine(|name, compiled| {
        let model = &compiled.model;
        // If a machine moves with as many constraints as coordinates, these are dependent. At random points they are
        // not, so nothing moves there that could show a change.
        if compiled.equations.constraints.len() >= model.coordinates.len() {
            return;
        }
        let facts = EquationProperties::of(model, &compiled.equations);
        let rate = &mut total(model);
        let rates = facts
            .cyclic
            .iter()
            .map(|cyclic| rate.of(cyclic.momentum))
            .collect::<Vec<_>>();
        let zero = vanish(compiled, &rates, true);
        for (cyclic, zero) in facts.cyclic.iter().zip(zero) {
            assert_eq!(
                cyclic.force.is_zero(),
                zero,
                "{name}: coordinate {}",
                cyclic.coordinate
            );
            conserved += usize::from(zero);
            changed += usize::from(!zero);
        }
        // The force is the rate of the momentum.
        let pairs = facts.cyclic.iter().zip(&rates);
        let differences: Vec<_> = pairs.map(|(cyclic, &rate)| rate - cyclic.force).collect();
        assert!(
            vanish(compiled, &differences, true)
                .into_iter()
                .all(|zero| zero),
            "{name}"
        );
    });
    assert!(
        conserved >= 3 && changed >= 1,
        "{conserved} conserved, {changed} changed"
    );
}

#[test]
fn energy_is_conserved_exactly_where_it_is_said() {
    let mut kinds = [0; 3];
    every_machine(|name, compiled| {
        let model = &compiled.model;
        let oracle = Oracle::derive(model);
        let facts = EquationProperties::of(model, &compiled.equations);
        let mut rate = total(model);
        let stored = compiled.equations.state_energy;
        let sum = rate.of(oracle.kinetic_energy + oracle.potential_energy + stored);
        let conserved = vanish(compiled, &[sum], true)[0];
        match &facts.energy {
            EnergyBalance::Conserved => {
                kinds[0] += 1;
                assert!(conserved, "{name}");
            }
            EnergyBalance::Jacobi(integral) => {
                kinds[1] += 1;
                assert!(!conserved, "{name}");
                assert!(vanish(compiled, &[rate.of(*integral)], true)[0], "{name}");
            }
            EnergyBalance::Balance => {
                kinds[2] += 1;
                assert!(!conserved, "{name}");
                let balance = compiled.equations.work_rate - compiled.equations.dissipation_rate;
                assert!(vanish(compiled, &[sum - balance], true)[0], "{name}");
            }
        }
    });
    assert!(kinds[0] >= 3 && kinds[2] >= 3, "{kinds:?}");
}

#[test]
fn what_is_driven_without_showing_it_has_an_integral_of_jacobi() {
    // A bead on a wire that rotates steadily: T + V is not conserved, ½ m (ṙ² − ω² r²) is. Goldstein, §2.7.
    let text = "machine Bead in plane {
        parameters { m: kg = 1, w: rad/s = 2 }
        coordinates { r: m = 0.1 }
        bodies { bead { mass: m, at: polar(r, w*t) } }
    }";
    crate::compiled(text, |compiled| {
        let model = &compiled.model;
        let EnergyBalance::Jacobi(integral) =
            EquationProperties::of(model, &compiled.equations).energy
        else {
            panic!("no integral");
        };
        let [m, w] = [0, 1].map(|k| model.parameters[k].symbol);
        let (r, v) = (model.coordinates[0].q, model.coordinates[0].v);
        let expected = m * (v.square() - w.square() * r.square()) / 2;
        assert!(vanish(compiled, &[integral - expected], false)[0]);
    });
}

#[test]
fn time_and_the_mass_matrix_are_free_of_what_is_said() {
    every_machine(|name, compiled| {
        let model = &compiled.model;
        let dag = model.dag;
        let oracle = Oracle::derive(model);
        let facts = EquationProperties::of(model, &compiled.equations);
        let mut explicit = Tangent::new(dag, &[(symbol(model.time), dag.one())]);
        let energies = [
            oracle.kinetic_energy,
            oracle.potential_energy,
            oracle.dissipation,
        ];
        let sources = energies.into_iter().chain(oracle.applied.iter().copied());
        let rates: Vec<Expr<'_>> = sources.map(|source| explicit.of(source)).collect();
        let free = vanish(compiled, &rates, false).into_iter().all(|zero| zero);
        assert_eq!(facts.autonomous, free, "{name}");

        // The same parameters twice, with new values for everything else.
        let at = |seed: u64| {
            evaluate(dag, oracle.mass_matrix.lower(), |symbol| {
                let varies = dag.stage_of(symbol) > stage::PARAMETER;
                Residue::random(if varies { seed } else { 0 }, symbol.index() as u64)
            })
        };
        let seeds = (1..100).filter(|&seed| at(seed).iter().all(|value| value.is_finite()));
        let points: Vec<Vec<Residue>> = seeds.take(3).map(at).collect();
        assert_eq!(points.len(), 3, "{name}");
        let constant = points.windows(2).all(|pair| pair[0] == pair[1]);
        assert_eq!(facts.constant_mass_matrix, constant, "{name}");

        // The coordinates of a block are connected by nonzero entries, and all entries between two blocks are zero.
        let n = model.coordinates.len();
        let is_zero = |i: usize, j: usize| {
            let (i, j) = (i.max(j), i.min(j));
            points
                .iter()
                .all(|values| values[i * (i + 1) / 2 + j] == Residue::ZERO)
        };
        let block_of = |i: usize| facts.blocks.iter().position(|block| block.contains(&i));
        for i in 0..n {
            for j in 0..i {
                assert!(
                    is_zero(i, j) || block_of(i) == block_of(j),
                    "{name}: {i}, {j}"
                );
            }
        }
        for block in &facts.blocks {
            let mut reached = vec![block[0]];
            let mut next = 0;
            while next < reached.len() {
                let here = reached[next];
                next += 1;
                let more = block
                    .iter()
                    .filter(|&&j| !reached.contains(&j) && !is_zero(here, j));
                let more: Vec<usize> = more.copied().collect();
                reached.extend(more);
            }
            assert_eq!(reached.len(), block.len(), "{name}: {block:?}");
        }
    });
}
