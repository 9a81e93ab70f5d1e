//! The accelerations in stages, from the elimination that leaves the least work to the repeated stage.

use crate::lower::choosing::{Draft, PlannedFunction, roundings};
use crate::lower::labelled;
use crate::lower::{Candidate, Choice, Lowering, LoweringInput};
use crate::lower::{articulated, turned};
use lagrangian_program::rounding::States;
use lagrangian_program::solve::{self, Elimination, Pivot, Solution};
use lagrangian_program::{Basis, Form, Function, Role, Shape, stages};
use lagrangian_spec::model::Stages;
use lagrangian_symbolic::sorting::sort_by_key;

/// The functions of one form of the accelerations, in their order.
struct Staged {
    drafts: Vec<Draft>,
    /// The function that was divided into these.
    whole: Draft,
}

impl Staged {
    /// The function that is called repeatedly.
    fn repeated(&self) -> &Draft {
        self.drafts.last().expect("there is always a last stage")
    }

    /// The cost of calling every stage.
    fn throughput(&self) -> u64 {
        let costs = self.drafts.iter().map(|draft| draft.function.cost());
        costs.map(|cost| cost.throughput).sum()
    }
}

/// The requested stages. The form with the lowest cost of the last stage, the one that is repeated, is chosen.
pub(super) fn staged<'d>(
    lowering: &mut Lowering<'_, 'd>,
    source: LoweringInput<'_, 'd>,
    at_once: &Draft,
    states: &States,
    choose: &dyn Fn(&[Candidate]) -> usize,
) -> (Vec<Draft>, Option<Choice>) {
    let apart = lowering.model.stages;
    let mut ways = Vec::new();
    for (basis, solution) in solutions(lowering, source, at_once) {
        for factored in [false, true] {
            let known = &at_once.known_pivots;
            let functions = staged_functions(lowering, &solution, known, (basis, factored), apart);
            ways.extend(functions);
        }
    }
    // Among those with equal repeated cost, the one with the lowest total cost.
    sort_by_key(&mut ways, Staged::throughput);
    let mut different: Vec<Staged> = Vec::with_capacity(ways.len());
    for way in ways {
        let is_same = |other: &Staged| {
            let pairs = way.drafts.iter().zip(&other.drafts);
            pairs.clone().all(|(a, b)| a.is_same(b))
        };
        if !different.iter().any(is_same) {
            different.push(way);
        }
    }
    let wholes: Vec<&Draft> = different.iter().map(|way| &way.whole).collect();
    let roundings = match wholes.len() {
        0 | 1 => None,
        _ => roundings(&wholes, &lowering.graph, states),
    };
    let candidate = |(index, way): (usize, &Staged)| {
        let Draft { form, function, .. } = way.repeated();
        Candidate {
            form: *form,
            counts: function.counts(),
            cost: function.cost(),
            rounding: roundings.as_ref().map(|roundings| roundings[index]),
        }
    };
    let candidates: Vec<Candidate> = different.iter().enumerate().map(candidate).collect();
    let (chosen, choice) = match candidates.len() {
        0 => return (Vec::new(), None),
        1 => (0, None),
        _ => {
            let chosen = choose(&candidates).min(candidates.len() - 1);
            (chosen, Some(Choice { candidates, chosen }))
        }
    };
    (different.swap_remove(chosen).drafts, choice)
}

/// The accelerations by every elimination that may be the shortest.
fn solutions<'d>(
    lowering: &mut Lowering<'_, 'd>,
    source: LoweringInput<'_, 'd>,
    at_once: &Draft,
) -> Vec<(Basis, Solution)> {
    let mut solutions = Vec::new();
    let mut systems = Vec::new();
    let derived = lowering.system(source.quantities, source.quantities);
    let expanded = lowering.system(source.expanded, source.quantities);
    for (basis, system) in [(Basis::Derived, derived), (Basis::Expanded, expanded)] {
        systems.extend(system.map(|system| (basis, system)));
    }
    let along = match (source.unprojected, systems.first()) {
        (Some(machine), Some(_)) => {
            turned::solve(lowering.model, machine, articulated::Order::Short)
        }
        _ => None,
    };
    let has_along = along.is_some();
    if let Some(along) = along {
        lowering.name(&along.solution.names);
        let values: Vec<_> = along.pivots.iter().map(|(_, pivot)| *pivot).collect();
        lowering.lower(&along.accelerations);
        lowering.lower(&values);
        let matrix = &systems[0].1.matrix;
        let pivots = along.pivots.iter().zip(lowering.values(&values));
        let pivots = pivots.map(|(&(coordinate, _), pivot)| {
            // If the diagonal entry of M is not available, the pivot need only be positive.
            let diagonal = matrix[Shape::index(coordinate, coordinate)];
            let scale = if diagonal.is_known() { diagonal } else { pivot };
            Pivot {
                coordinate,
                pivot,
                scale,
            }
        });
        let solution = Solution {
            pivots: pivots.collect(),
            accelerations: lowering.values(&along.accelerations),
            multipliers: Vec::new(),
            columns: Vec::new(),
            steps: labelled(lowering, &along.solution.labels),
        };
        solutions.push((Basis::Along, solution));
    }
    for (basis, system) in systems {
        let elimination = Elimination::of(&lowering.graph, &system);
        // An elimination longer than the accelerations in one function is not even written down: it
        // grows with the cube of the number of coordinates.
        if has_along && elimination.multiplications > at_once.function.counts().ops() {
            continue;
        }
        let solution = solve::solve(&mut lowering.graph, &system, elimination);
        solutions.push((basis, solution));
    }
    solutions
}

/// The functions of one solution; none if there are no factors to take out.
fn staged_functions(
    lowering: &mut Lowering<'_, '_>,
    solution: &Solution,
    known_pivots: &[Pivot],
    (basis, factored): (Basis, bool),
    apart: Stages,
) -> Option<Staged> {
    let pivots = solution.pivots.iter().copied();
    let planned = PlannedFunction {
        role: Role::AccelerationsAt,
        rows: solution.accelerations.len() + solution.multipliers.len(),
        shape: Shape::Vector(solution.accelerations.len()),
        results: solution.accelerations.clone(),
        pivots: pivots
            .filter(|pivot| !known_pivots.contains(pivot))
            .collect(),
        steps: solution.steps.clone(),
    };
    let mut net = planned.net(&mut lowering.graph, true);
    if factored && !net.factor() {
        return None;
    }
    net.separate_stages(apart);
    let complete = planned.draft(Some(&mut lowering.graph), net, basis, factored);
    let draft = |function: Function| Draft {
        form: Form {
            role: function.role,
            ..complete.form
        },
        function,
        prepared: complete.prepared.clone(),
        known_pivots: Vec::new(),
    };
    let functions = stages::split(&complete.function, apart);
    Some(Staged {
        drafts: functions.into_iter().map(draft).collect(),
        whole: complete,
    })
}
