//! The projection of a state onto the constraints, eqs. (E29)–(E31): the residuals, and the smallest moves that remove them to first order.
//!
//! A run projects the end of each step. In one function the residuals, the rows of the constraints and the mass matrix share their terms,
//! and the elimination skips whatever is zero.

use super::derivatives::{inverses, of_elimination, solve_by_steps};
use super::{Lowering, LoweringInput};
use crate::lower::choosing::{Draft, PlannedFunction};
use lagrangian_program::graph::Scaled;
use lagrangian_program::solve::{self, Elimination, System};
use lagrangian_program::{ProjectionLayout, Role, Shape};

/// The largest number of multiplications of an elimination for which there is such a function; it takes two right-hand sides. Beyond this
/// number a loop over the matrix is as fast, and the code is long.
const MOST_MULTIPLICATIONS: usize = 2_000;

/// The drafts of [`Role::Projection`]; none if constraints depend on others or hold parts without inertia, or if only some of them are
/// constraints of positions: then the moves are not those of one elimination.
pub(super) fn projection<'d>(
    lowering: &mut Lowering<'_, 'd>,
    source: LoweringInput<'_, 'd>,
    accelerations: &Draft,
) -> Vec<Draft> {
    let (basis, quantities) = source.in_all_coordinates(accelerations);
    let planned = lowering
        .system(quantities, source.quantities)
        .and_then(|system| function(lowering, source, &system, accelerations));
    planned.map_or_else(Vec::new, |planned| {
        planned.drafts(&mut lowering.graph, basis)
    })
}

fn function<'d>(
    lowering: &mut Lowering<'_, 'd>,
    source: LoweringInput<'_, 'd>,
    system: &System,
    accelerations: &Draft,
) -> Option<PlannedFunction> {
    let n = system.coordinates;
    let m = system.forces.len() - n;
    let layout = ProjectionLayout {
        coordinates: n,
        constraints: m,
    };
    let values = |role| {
        let of_role = |quantity: &&super::Quantity<'d>| quantity.role == role;
        let quantity = source.quantities.iter().find(of_role)?;
        Some(lowering.values(&quantity.values))
    };
    let positions = values(Role::ConstraintPositions)?;
    let rates = values(Role::ConstraintRates)?;
    let matrix = values(Role::ConstraintMatrix)?;
    let without_position = positions.iter().filter(|x| x.is_zero()).count();
    if !system.held_constraints.is_empty() || (without_position != 0 && without_position != m) {
        return None;
    }
    let graph = &mut lowering.graph;
    let elimination = Elimination::of_coordinates_first(graph, system);
    if elimination.multiplications > MOST_MULTIPLICATIONS {
        return None;
    }
    let removing = |residuals: &[Scaled]| -> Vec<Scaled> {
        let opposite = residuals.iter().map(|residual| residual.negated());
        std::iter::repeat_n(Scaled::ZERO, n)
            .chain(opposite)
            .collect()
    };
    let of_rates = System {
        forces: removing(&rates),
        ..system.clone()
    };
    let solution = solve::solve(graph, &of_rates, elimination);
    if solution.pivots.iter().any(|pivot| pivot.pivot.is_zero()) {
        return None;
    }
    let solved = of_elimination(solution, &of_rates);
    let inverses = inverses(graph, &solved);
    let mut of_coordinates = solve_by_steps(graph, &solved, &inverses, removing(&positions));
    // The system is symmetric in moves and the opposites of multipliers.
    let multipliers = of_coordinates.split_off(n);
    let multipliers = multipliers.into_iter().map(Scaled::negated);
    let of_row = |k: usize| solved.pivots.iter().find(|pivot| pivot.coordinate == n + k);
    let pivots: Option<Vec<_>> = (0..m).map(of_row).collect();
    let pivots = pivots?;
    let mut results = positions;
    results.extend(rates);
    results.extend(matrix);
    results.extend((0..n).map(|i| system.matrix[Shape::index(i, i)]));
    results.extend(of_coordinates);
    results.extend(&solved.accelerations);
    results.extend(multipliers);
    results.extend(&solved.multipliers);
    results.extend(pivots.iter().map(|pivot| pivot.pivot));
    results.extend(pivots.iter().map(|pivot| pivot.scale));
    debug_assert_eq!(results.len(), layout.len());
    let known = &accelerations.known_pivots;
    let guarded = solved.pivots.iter().filter(|pivot| !known.contains(pivot));
    Some(PlannedFunction {
        role: Role::Projection,
        shape: Shape::Vector(layout.len()),
        results,
        pivots: guarded.copied().collect(),
        rows: n + m,
        steps: Vec::new(),
    })
}
