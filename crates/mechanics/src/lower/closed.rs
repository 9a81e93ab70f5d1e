//! The accelerations of a closed-loop mechanism along its structure: the loops are cut open, the machine
//! is eliminated from its tips like a tree, and the constraint forces pass through the same steps.
//!
//! ```text
//! a = a₀ + Y λ,   Y = M⁻¹ Gᵀ,   G Y λ = γ − G a₀
//! ```
//!
//! On a chain of links, a₀ and each column of Y take work linear in the number of links; with the mass
//! matrix it grows with the cube. (D. Baraff, *Linear-time dynamics using Lagrange multipliers*,
//! SIGGRAPH 1996; R. Featherstone, *Rigid Body Dynamics Algorithms*, 2008, section 8.)

use crate::Unprojected;
use crate::lower::MOST_MULTIPLICATIONS;
use crate::lower::{Lowering, derivatives};
use lagrangian_program::graph::{Graph, Scaled};
use lagrangian_program::solve::{self, Elimination, Pivot, Solution, System};
use lagrangian_program::{EliminationStep, Shape};
use lagrangian_spec::model::Model;

/// Solves `M a = f + Gᵀ λ`, `G a = γ`; `None` if that is certainly longer than with the mass matrix,
/// or if the machine cannot be eliminated without its constraints.
pub(super) fn solve<'d>(
    lowering: &mut Lowering<'_, 'd>,
    model: &Model<'d>,
    system: &System,
    machine: &Unprojected<'d>,
) -> Option<Solution> {
    let n = system.coordinates;
    let count = system.forces.len() - n;
    // Each column has at least an entry for each coordinate, and the multipliers take an elimination
    // of their own.
    let least = count * n + count * count * count / 6;
    if least > Elimination::of(&lowering.graph, system).multiplications
        || least > MOST_MULTIPLICATIONS
    {
        return None;
    }
    let start = Shape::index(n, 0);
    let (matrix, below) = system.matrix.split_at(start);
    let (forces, biases) = system.forces.split_at(n);
    let open = System {
        matrix: matrix.to_vec(),
        forces: forces.to_vec(),
        coordinates: n,
        held_constraints: Vec::new(),
    };
    let solved = derivatives::along_the_machine(lowering, model, &open, machine)?;
    let rows: Vec<&[Scaled]> = (n..n + count)
        .map(|row| &below[Shape::index(row, 0) - start..][..n])
        .collect();

    let graph = &mut lowering.graph;
    let inverses = derivatives::inverses(graph, &solved);
    let respond =
        |row: &&[Scaled]| derivatives::solve_by_steps(graph, &solved, &inverses, row.to_vec());
    let columns: Vec<Vec<Scaled>> = rows.iter().map(respond).collect();
    let mut closing = System {
        matrix: Vec::new(),
        forces: Vec::new(),
        coordinates: count,
        held_constraints: Vec::new(),
    };
    for ((k, row), bias) in rows.iter().enumerate().zip(biases) {
        for column in &columns[..=k] {
            let entry = with_products(graph, Scaled::ZERO, row, column);
            closing.matrix.push(entry);
        }
        let free = with_products(graph, bias.negated(), row, &solved.accelerations);
        closing.forces.push(free.negated());
    }
    let elimination = Elimination::of(graph, &closing);
    let held = solve::solve(graph, &closing, elimination);
    let accelerations = (0..n).map(|i| {
        let by: Vec<Scaled> = columns.iter().map(|column| column[i]).collect();
        with_products(graph, solved.accelerations[i], &by, &held.accelerations)
    });
    let accelerations: Vec<Scaled> = accelerations.collect();
    let of_constraints = held.steps.into_iter();
    let steps = of_constraints.map(|(value, step)| (value, step.with_rows(|row| n + row)));
    // Without constraint forces, the solutions of the open machine are not the accelerations.
    let open = solved.labels.into_iter();
    let open = open.filter(|(_, step)| !matches!(step, EliminationStep::Solution(_)));
    let steps = open.chain(steps).collect();
    let of_constraints = held.pivots.into_iter().map(|pivot| Pivot {
        coordinate: n + pivot.coordinate,
        ..pivot
    });
    Some(Solution {
        accelerations,
        multipliers: held.accelerations,
        pivots: solved.pivots.into_iter().chain(of_constraints).collect(),
        columns: Vec::new(),
        steps,
    })
}

/// `x + Σ yᵢ zᵢ`, as one value that is computed once.
fn with_products(graph: &mut Graph, x: Scaled, y: &[Scaled], z: &[Scaled]) -> Scaled {
    let mut terms = vec![x];
    for (y, z) in y.iter().zip(z) {
        terms.push(graph.product(&[(*y, 1), (*z, 1)]));
    }
    let sum = graph.sum(&terms);
    graph.opaque(sum)
}
