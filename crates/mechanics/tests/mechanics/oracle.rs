//! The projected route gives Lagrange's equations for every machine.

use lagrangian_mechanics::{Equations, Oracle};
use lagrangian_scalar::{DoubleDouble, Residue, Scalar};
use lagrangian_spec::model::Model;
use lagrangian_symbolic::{Expr, Symbol, evaluate};

use crate::harness::{all_machines, derived, residues};

#[test]
fn every_machine_obeys_lagranges_equations() {
    for (name, text) in all_machines() {
        derived(&text, |model, equations| {
            let oracle = Oracle::derive(model);
            let (ours, lagranges) = quantities(equations, &oracle);
            let all: Vec<Expr> = ours.iter().chain(&lagranges).map(|(_, e)| *e).collect();
            for values in residues(model, equations, &all, false) {
                let (left, right) = values.split_at(ours.len());
                for (((what, _), left), right) in ours.iter().zip(left).zip(right) {
                    assert_eq!(left, right, "{name}: {what}");
                }
            }
        });
    }
}

#[test]
fn accelerations_make_lagranges_residual_vanish() {
    for (name, text) in all_machines() {
        derived(&text, |model, equations| {
            // With constraints, the equations contain multipliers; the proof of the
            // programs covers these machines.
            if !equations.constraints.is_empty() {
                return;
            }
            let residual = Oracle::derive(model).residual;
            for values in residues(model, equations, &residual, true) {
                assert!(values.iter().all(|&value| value == Residue::ZERO), "{name}");
            }
        });
    }
}

#[test]
fn the_two_routes_agree_in_rounded_numbers() {
    for (name, text) in all_machines() {
        derived(&text, |model, equations| {
            let oracle = Oracle::derive(model);
            let (ours, lagranges) = quantities(equations, &oracle);
            let all: Vec<Expr> = ours.iter().chain(&lagranges).map(|(_, e)| *e).collect();
            for point in 0..4 {
                let exact = evaluate(model.dag, &all, |s| {
                    DoubleDouble::from_f64(number(point, s))
                });
                let rounded = evaluate(model.dag, &all, |s| number(point, s));
                let size = exact.iter().map(|x| x.to_f64().abs()).fold(0.0, f64::max);
                let (left, right) = exact.split_at(ours.len());
                for ((left, right), (what, _)) in left.iter().zip(right).zip(&ours) {
                    let error = (*left - *right).to_f64().abs();
                    assert!(
                        error <= 1e-24 * size,
                        "{name}: {what} differs by {error:e} of {size:e}"
                    );
                }
                for ((exact, rounded), (what, _)) in left.iter().zip(&rounded).zip(&ours) {
                    let error = (exact.to_f64() - rounded).abs();
                    assert!(
                        error <= 1e-12 * size,
                        "{name}: {what} rounds by {error:e} of {size:e}"
                    );
                }
            }
        });
    }
}

/// A number between ½ and 1½ for a symbol.
fn number(point: u32, symbol: Symbol) -> f64 {
    0.5 + (f64::from(point + 1) * (symbol.index() as f64 + 2.0).sqrt()).fract()
}

type Quantities<'d> = Vec<(String, Expr<'d>)>;

/// The quantities derived on both routes, in the same order.
fn quantities<'d>(ours: &Equations<'d>, oracle: &Oracle<'d>) -> (Quantities<'d>, Quantities<'d>) {
    let energies = ["kinetic energy", "potential energy", "dissipation"].map(str::to_owned);
    let mut left: Quantities<'d> = energies
        .iter()
        .cloned()
        .zip([ours.kinetic_energy, ours.potential_energy, ours.dissipation])
        .collect();
    let mut right: Quantities<'d> = energies
        .into_iter()
        .zip([
            oracle.kinetic_energy,
            oracle.potential_energy,
            oracle.dissipation,
        ])
        .collect();
    for (i, j, &entry) in ours.mass_matrix.entries() {
        left.push((format!("M[{i}][{j}]"), entry));
        right.push((String::new(), *oracle.mass_matrix.get(i, j)));
    }
    for i in 0..ours.bias.len() {
        let forces = oracle.applied[i] - oracle.bias[i];
        for (what, ours, lagranges) in [
            ("h", ours.bias[i], oracle.bias[i]),
            ("Q", ours.applied[i], oracle.applied[i]),
            ("f", ours.forces[i], forces),
        ] {
            left.push((format!("{what}[{i}]"), ours));
            right.push((String::new(), lagranges));
        }
    }
    (left, right)
}

#[test]
fn outputs_pass_through() {
    derived(
        &crate::harness::text_of("cart_pole"),
        |model: &Model, equations| {
            let values: Vec<Expr> = model.outputs.iter().map(|output| output.value).collect();
            assert_eq!(equations.outputs, values);
        },
    );
}

#[test]
fn multiplied_out_equations_are_the_same_equations() {
    let mut expanded = Vec::new();
    for (name, text) in all_machines() {
        derived(&text, |model, equations| {
            let Some(other) = equations.expanded() else {
                return;
            };
            let oracle = Oracle::derive(model);
            let (ours, lagranges) = quantities(&other, &oracle);
            let all: Vec<Expr> = ours.iter().chain(&lagranges).map(|(_, e)| *e).collect();
            for values in residues(model, equations, &all, false) {
                let (left, right) = values.split_at(ours.len());
                assert_eq!(left, right, "{name}");
            }
            expanded.push(name);
        });
    }
    assert!(expanded.len() >= 6, "{expanded:?}");
}
