//! The ways to the accelerations: elimination of the mass matrix, along the machine, and with multipliers.

use super::articulated::Order;
use super::{EquationSet, Lowering, LoweringInput, MOST_GUARD_COST, all_values};
use crate::lower::choosing::{Draft, PlannedFunction};
use crate::lower::{
    MOST_MULTIPLICATIONS, articulated, closed, derivatives, friction, labelled, turned,
};
use crate::{Reduction, Unprojected};
use lagrangian_program::choose::Basis;
use lagrangian_program::graph::Scaled;
use lagrangian_program::schedule::LARGEST_FACTORED;
use lagrangian_program::solve::{Elimination, Pivot, Solution};
use lagrangian_program::{Role, Shape, solve};
use lagrangian_spec::model::{Model, stage};
use lagrangian_symbolic::{self as symbolic, Expr, reachable};

/// The drafts of the accelerations, or of the response to friction, from which these follow.
pub(super) fn ways_to_accelerations<'d>(
    lowering: &mut Lowering<'_, 'd>,
    source: LoweringInput<'_, 'd>,
) -> Vec<Draft> {
    let mut ways = if source.sliding.is_empty() {
        accelerations(lowering, source.all_coordinates(lowering.model))
    } else {
        friction::friction(lowering, source)
    };
    if let Some(reduced) = source.reduced {
        let offsets = reduced.reduction.into_iter().flat_map(|r| &r.dependents);
        let offsets = offsets.filter_map(|d| d.offset.map(|[name, meaning]| (name, meaning)));
        lowering.name(&offsets.collect::<Vec<_>>());
        lowering.lower(&all_values(reduced.quantities));
        lowering.lower(&all_values(reduced.expanded));
        ways.extend(accelerations(lowering, reduced));
    }
    ways
}

/// The drafts of the accelerations, from the mass matrix and along the machine.
pub(super) fn accelerations<'d>(
    lowering: &mut Lowering<'_, 'd>,
    source: EquationSet<'_, 'd>,
) -> Vec<Draft> {
    let Some(derived) = lowering.system(source.quantities, source.quantities) else {
        return Vec::new();
    };
    let mut systems = vec![(Basis::Derived, derived)];
    let expanded = lowering
        .system(source.expanded, source.quantities)
        .filter(|expanded| *expanded != systems[0].1);
    systems.extend(expanded.map(|system| (Basis::Expanded, system)));
    let elimination = Elimination::of(&lowering.graph, &systems[0].1);
    let has_other = elimination.multiplications <= MOST_MULTIPLICATIONS;
    let mut drafts = Vec::new();
    for basis in [Basis::Along, Basis::Ahead] {
        // At least one draft is needed; if formulas are nearly all of the work, a second one is not tried.
        let machine = source
            .unprojected
            .filter(|machine| !has_other || !is_mostly_formulas(source.model, machine));
        let Some(machine) = machine else {
            break;
        };
        let matrix = &systems[0].1.matrix;
        match along_the_machine(lowering, source, matrix, machine, (basis, has_other)) {
            Some(along) => drafts.extend(along),
            // The other order is no shorter.
            None => break,
        }
    }
    if let Some(machine) = source.cut_open
        && let Some(solution) = closed::solve(lowering, source.model, &systems[0].1, machine)
    {
        drafts.extend(solved(lowering, source, solution, Basis::Along));
    }
    let shortest = drafts
        .iter()
        .map(|draft| draft.function.counts().ops())
        .min();
    for (basis, system) in systems {
        let elimination = Elimination::of(&lowering.graph, &system);
        // A certainly longer elimination is not even written down, since it grows with the cube of
        // the number of coordinates.
        let most = shortest.map_or(MOST_MULTIPLICATIONS, |ops| ops.min(MOST_MULTIPLICATIONS));
        if elimination.multiplications > most {
            continue;
        }
        let solution = solve::solve(&mut lowering.graph, &system, elimination);
        drafts.extend(solved(lowering, source, solution, basis));
    }
    drafts
}

/// The scale in the guard of a squared coefficient that depends on parameters alone: `n Σ t²` over its
/// terms `t`, times the tolerance of guards, so that the guard fails if the coefficient may be nothing
/// but round-off of its terms. `None` if its round-off is negligible: a product, or a sum or difference
/// of two given numbers.
pub(super) fn rounding_of(coefficient: Expr<'_>, rows: usize) -> Option<Expr<'_>> {
    let dag = coefficient.dag();
    let symbolic::Node::Sum(terms) = coefficient.node() else {
        return None;
    };
    let is_given = |(id, c): &(symbolic::Id, lagrangian_symbolic::Rational)| {
        let is_symbol = dag.expr(*id).as_symbol().is_some();
        is_symbol && c.abs().is_one()
    };
    if terms.len() < 2 || (terms.len() == 2 && terms.iter().all(is_given)) {
        return None;
    }
    let squares = terms
        .iter()
        .map(|(id, c)| (dag.expr(*id) * c.clone()).square());
    let tolerance = solve::pivot_tolerance(rows) * terms.len() as f64;
    // Rounded up to a power of 2, so that the tolerance is not a number in the equations.
    let halvings = -tolerance.log2().ceil() as i32;
    Some(dag.sum(squares) / dag.int(2).powi(halvings))
}

/// The largest number of nodes of velocities and loads, and how many more for every pair of coordinates, for
/// which an elimination order is searched. A chain of 64 links takes some 20 for each pair.
const FORMULAS: [usize; 2] = [20_000, 1_000];

/// Whether velocities and loads are so long, relative to the number of coordinates, that the elimination order
/// cannot matter: it changes the products for pairs of coordinates, not the formulas.
pub(super) fn is_mostly_formulas(model: &Model<'_>, machine: &Unprojected<'_>) -> bool {
    let carriers = machine.inertia.iter().flat_map(|pair| [pair.u, pair.w]);
    let loads = machine.loads.iter().flat_map(|&(u, load)| [u, load]);
    let roots: Vec<Expr<'_>> = carriers.chain(loads).collect();
    let coordinates = model.coordinates.len();
    let pairs = coordinates * (coordinates + 1) / 2;
    reachable(model.dag, &roots).len() > FORMULAS[0] + FORMULAS[1] * pairs
}

/// Extends a solution for the independent coordinates to all coordinates.
fn embedded<'d>(
    lowering: &mut Lowering<'_, 'd>,
    reduction: &Reduction<'d>,
    solution: Solution,
) -> Solution {
    let all = lowering.model.coordinates.len();
    let left = &reduction.coordinates;
    let mut accelerations = vec![Scaled::ZERO; all];
    for (&i, &value) in left.iter().zip(&solution.accelerations) {
        accelerations[i] = value;
    }
    // Values that were lowered earlier, such as outputs, may contain the accelerations as arguments.
    let before = lowering.values.clone();
    for (i, value) in accelerations.iter().enumerate() {
        let symbol = lowering.model.coordinates[i].a;
        lowering.values.insert(symbol.id(), *value);
    }
    let dag = lowering.model.dag;
    let is_later = |id: &symbolic::Id| dag.expr(*id).stage() >= stage::ACCELERATION;
    let is_symbol = |id: &symbolic::Id| dag.expr(*id).as_symbol().is_some();
    lowering
        .values
        .retain(|id, _| !is_later(id) || is_symbol(id));
    let following: Vec<Expr<'d>> = reduction
        .dependents
        .iter()
        .map(|d| d.acceleration)
        .collect();
    lowering.lower(&following);
    for (dependent, value) in reduction.dependents.iter().zip(lowering.values(&following)) {
        accelerations[dependent.coordinate] = value;
    }
    lowering.values = before;

    let row = |row: usize| match row.checked_sub(left.len()) {
        None => left[row],
        Some(constraint) => all + reduction.constraints[constraint],
    };
    let pivots = solution.pivots.into_iter().map(|pivot| Pivot {
        coordinate: row(pivot.coordinate),
        ..pivot
    });
    let mut pivots: Vec<Pivot> = pivots.collect();
    // The coefficient was divided by; the determinant contains its square.
    let rows = all + lowering.constraints;
    for dependent in &reduction.dependents {
        lowering.lower(&[dependent.coefficient]);
        let coefficient = lowering.values(&[dependent.coefficient])[0];
        let pivot = lowering.graph.product(&[(coefficient, 2)]);
        let pivot = lowering.graph.opaque(pivot);
        pivots.push(Pivot {
            coordinate: all + dependent.constraint,
            pivot,
            scale: match rounding_of(dependent.coefficient, rows) {
                None => pivot,
                Some(rounding) => {
                    lowering.lower(&[rounding]);
                    lowering.values(&[rounding])[0]
                }
            },
        });
    }
    let steps = solution.steps.into_iter();
    Solution {
        accelerations,
        multipliers: Vec::new(),
        pivots,
        columns: Vec::new(),
        steps: steps
            .map(|(value, step)| (value, step.with_rows(row)))
            .collect(),
    }
}

/// The multipliers of the constraints, from the equations in all coordinates.
pub(super) fn multipliers<'d>(
    lowering: &mut Lowering<'_, 'd>,
    source: LoweringInput<'_, 'd>,
    accelerations: &Draft,
) -> Vec<Draft> {
    let (basis, quantities) = source.in_all_coordinates(accelerations);
    let Some(system) = lowering.system(quantities, source.quantities) else {
        return Vec::new();
    };
    let elimination = Elimination::of(&lowering.graph, &system);
    let work = elimination.multiplications;
    let along = source.cut_open.and_then(|machine| {
        let solution = closed::solve(lowering, lowering.model, &system, machine)?;
        Some((Basis::Along, solution))
    });
    let mut drafts = Vec::new();
    let mut draft = |lowering: &mut Lowering<'_, 'd>, basis, solution: Solution| {
        let known = &accelerations.known_pivots;
        let pivots = solution.pivots.into_iter();
        let planned = PlannedFunction {
            role: Role::Multipliers,
            shape: Shape::Vector(solution.multipliers.len()),
            results: solution.multipliers,
            pivots: pivots.filter(|pivot| !known.contains(pivot)).collect(),
            rows: system.forces.len(),
            steps: solution.steps,
        };
        let ways = planned.drafts(&mut lowering.graph, basis);
        let shortest = ways.iter().map(|draft| draft.function.counts().ops()).min();
        drafts.extend(ways);
        shortest
    };
    let shortest = along.and_then(|(basis, solution)| draft(lowering, basis, solution));
    if work <= shortest.unwrap_or(MOST_MULTIPLICATIONS) {
        let solution = solve::solve(&mut lowering.graph, &system, elimination);
        draft(lowering, basis, solution);
    }
    drafts
}

/// The accelerations with their derivatives, if any are requested, from the same equations as the accelerations.
pub(super) fn derivatives<'d>(
    lowering: &mut Lowering<'_, 'd>,
    source: LoweringInput<'_, 'd>,
    accelerations: &Draft,
) -> Option<Draft> {
    let (quantities, unprojected) = match accelerations.form.basis {
        Basis::Expanded => (source.expanded, None),
        Basis::Derived | Basis::Along | Basis::Ahead => (source.quantities, source.unprojected),
    };
    let slopes = (source.slopes)(accelerations.form.basis);
    let system = lowering.system(quantities, source.quantities)?;
    let input = derivatives::DerivativeInput {
        system: &system,
        multipliers: source.multipliers,
        unprojected,
        residual_derivatives: &slopes,
        known_pivots: &accelerations.known_pivots,
    };
    (!slopes.is_empty()).then(|| derivatives::derivatives(lowering, &input))
}

/// The drafts of a solution; pivots that depend on parameters alone are kept apart.
pub(super) fn solved<'d>(
    lowering: &mut Lowering<'_, 'd>,
    source: EquationSet<'_, 'd>,
    solution: Solution,
    basis: Basis,
) -> Vec<Draft> {
    let solution = match source.reduction {
        Some(reduction) => embedded(lowering, reduction, solution),
        None => solution,
    };
    let known = |p: &Pivot| p.pivot.is_known() && p.scale.is_known();
    let (known_pivots, pivots): (Vec<Pivot>, Vec<Pivot>) =
        solution.pivots.into_iter().partition(known);
    let planned = PlannedFunction {
        role: Role::Accelerations,
        rows: solution.accelerations.len() + solution.multipliers.len(),
        shape: Shape::Vector(solution.accelerations.len()),
        results: solution.accelerations,
        pivots,
        steps: solution.steps,
    };
    let mut drafts = planned.drafts(&mut lowering.graph, basis);
    for draft in &mut drafts {
        draft.form.reduced = source.reduction.is_some();
        draft.known_pivots.clone_from(&known_pivots);
    }
    drafts
}

/// The accelerations by [`articulated::solve`]; `None` if these are too long and the mass matrix already gives another draft.
fn along_the_machine<'d>(
    lowering: &mut Lowering<'_, 'd>,
    source: EquationSet<'_, 'd>,
    matrix: &[Scaled],
    machine: &Unprojected<'d>,
    (basis, has_other): (Basis, bool),
) -> Option<Vec<Draft>> {
    let order = match basis {
        Basis::Ahead => Order::Ahead,
        _ => Order::Short,
    };
    // A frame that is turned by a quaternion moves with three velocities.
    let Some(turned::TurnSolution {
        accelerations,
        pivots,
        solution: articulated::ArticulatedSolution { names, labels, .. },
        ..
    }) = turned::solve(source.model, machine, order)
    else {
        return Some(Vec::new());
    };
    let values: Vec<Expr<'d>> = pivots.iter().map(|(_, pivot)| *pivot).collect();
    if has_other {
        let named = names.iter().map(|(_, value)| *value);
        let all: Vec<Expr<'d>> = named
            .chain(accelerations.iter().chain(&values).copied())
            .collect();
        if symbolic::evaluation_work(source.model.dag, &all) > LARGEST_FACTORED {
            return None;
        }
    }
    lowering.name(&names);
    lowering.lower(&accelerations);
    lowering.lower(&values);
    let labels = labelled(lowering, &labels);
    let results = lowering.values(&accelerations);
    let pivots: Vec<(usize, Scaled)> = pivots
        .iter()
        .map(|(coordinate, _)| *coordinate)
        .zip(lowering.values(&values))
        .collect();
    let mut with_scales = |scale: &dyn Fn(usize, Scaled) -> Scaled| {
        let pivots = pivots.iter().map(|&(coordinate, pivot)| Pivot {
            coordinate,
            pivot,
            scale: scale(coordinate, pivot),
        });
        let solution = Solution {
            pivots: pivots.collect(),
            accelerations: results.clone(),
            multipliers: Vec::new(),
            columns: Vec::new(),
            steps: labels.clone(),
        };
        solved(lowering, source, solution, basis)
    };
    let diagonal = |i: usize| matrix[Shape::index(i, i)];
    let full = with_scales(&|i, _| diagonal(i));
    let lean = with_scales(&|i, pivot| {
        if diagonal(i).is_known() {
            diagonal(i)
        } else {
            pivot
        }
    });
    let ops = |drafts: &[Draft]| {
        let counts = drafts.iter().map(|draft| draft.function.counts().ops());
        counts.min().unwrap_or(0)
    };
    let is_cheap = 100 * ops(&full) <= (100 + MOST_GUARD_COST) * ops(&lean);
    Some(if is_cheap { full } else { lean })
}
