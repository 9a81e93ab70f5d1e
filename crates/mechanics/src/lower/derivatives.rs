//! The accelerations with their derivatives: `M ∂a/∂x = ∂r/∂x`, eq. (E26), a column for each variable.
//!
//! The elimination that gives the accelerations is one list of [`EliminatedUnknown`]s, whether it runs along the
//! machine or over the mass matrix. A right-hand side passes through it forwards, and its solution
//! comes back; nothing is factored again. The accelerations in the right-hand sides are the values
//! that the same function computes.

use lagrangian_symbolic::Expr;

use crate::Unprojected;
use crate::lower::articulated::Order;
use crate::lower::choosing::{Draft, PlannedFunction};
use crate::lower::labelled;
use crate::lower::{Lowering, turned};
use lagrangian_program::graph::{Graph, Scaled};
use lagrangian_program::solve::{self, Elimination, Pivot, System};
use lagrangian_program::{Basis, EliminationStep, Role, Shape};
use lagrangian_spec::model::Model;

/// The elimination of one unknown: `x_of = r_of/pivot + Σ c x_part`, and its load is passed on:
/// `r_part += c r_of`. A step without a pivot only replaces the unknown by its parts.
struct EliminatedUnknown {
    of: usize,
    pivot: Option<Scaled>,
    parts: Vec<(usize, Scaled)>,
}

/// The coordinates of a quaternion that turns a frame, whose rates ė = ½ e∘ω + e u̇ were replaced by ω and u̇
/// in the equations.
struct QuaternionTurn {
    coordinates: [usize; 4],
    e: [Scaled; 4],
    /// ½ e.
    halves: [Scaled; 4],
}

/// The accelerations, and the elimination that gave them.
pub(super) struct Solved {
    pub accelerations: Vec<Scaled>,
    pub multipliers: Vec<Scaled>,
    steps: Vec<EliminatedUnknown>,
    /// The turns whose velocities the steps refer to.
    turns: Vec<QuaternionTurn>,
    pub pivots: Vec<Pivot>,
    /// The values of the elimination, for comments.
    pub labels: Vec<(Scaled, EliminationStep)>,
    /// The number of unknowns; the first are the accelerations.
    unknowns: usize,
}

/// The inputs of the function.
pub(super) struct DerivativeInput<'a, 'd> {
    pub system: &'a System,
    /// The symbols of the multipliers.
    pub multipliers: &'a [Expr<'d>],
    pub unprojected: Option<&'a Unprojected<'d>>,
    /// The right-hand sides, column by column, which may contain the symbols of the accelerations; in
    /// one form or several.
    pub residual_derivatives: &'a [Vec<Vec<Expr<'d>>>],
    /// Pivots that are checked once parameters are known.
    pub known_pivots: &'a [Pivot],
}

/// The function of the accelerations and their derivatives, in the form that is cheapest to run.
pub(super) fn derivatives<'d>(
    lowering: &mut Lowering<'_, 'd>,
    asked: &DerivativeInput<'_, 'd>,
) -> Draft {
    let elimination = Elimination::of(&lowering.graph, asked.system);
    let along = asked
        .unprojected
        .and_then(|machine| along_the_machine(lowering, lowering.model, asked.system, machine));
    let mut candidates = functions(lowering, asked, along.as_ref());
    // A certainly longer function is not even written down: each column passes through the matrix too.
    let is_shorter = |draft: &Draft| {
        elimination.multiplications * asked.columns() <= draft.function.counts().ops()
    };
    if candidates.iter().all(is_shorter) {
        let by_matrix = by_matrix(&mut lowering.graph, asked, elimination);
        candidates.extend(functions(lowering, asked, Some(&by_matrix)));
    }
    candidates
        .into_iter()
        .min_by(|a, b| a.function.cost().compare(b.function.cost()))
        .expect("the mass matrix always leads to one")
}

/// The functions that give the same numbers by one elimination, one for each form of the right-hand sides.
fn functions<'d>(
    lowering: &mut Lowering<'_, 'd>,
    asked: &DerivativeInput<'_, 'd>,
    solved: Option<&Solved>,
) -> Vec<Draft> {
    let forms = solved.into_iter().flat_map(|solved| {
        asked
            .residual_derivatives
            .iter()
            .map(move |slopes| (solved, slopes.as_slice()))
    });
    forms
        .map(|(solved, slopes)| function(lowering, asked, solved, slopes))
        .collect()
}

impl DerivativeInput<'_, '_> {
    /// The number of columns, including the accelerations.
    fn columns(&self) -> usize {
        1 + self.residual_derivatives.first().map_or(0, Vec::len)
    }
}

fn by_matrix(
    graph: &mut Graph,
    asked: &DerivativeInput<'_, '_>,
    elimination: Elimination,
) -> Solved {
    of_elimination(solve::solve(graph, asked.system, elimination), asked.system)
}

/// The steps of an elimination of the system's matrix.
pub(super) fn of_elimination(solution: solve::Solution, system: &System) -> Solved {
    let step = |(pivot, column): (&Pivot, &solve::Column)| EliminatedUnknown {
        of: pivot.coordinate,
        // Pivots of constraints are guarded as positive numbers; a row without a pivot depends on others.
        pivot: (!pivot.pivot.is_zero()).then(|| {
            if pivot.coordinate < system.coordinates {
                pivot.pivot
            } else {
                pivot.pivot.negated()
            }
        }),
        parts: column
            .below
            .iter()
            .map(|(i, l)| (*i, l.negated()))
            .collect(),
    };
    let steps = solution.pivots.iter().zip(&solution.columns);
    Solved {
        accelerations: solution.accelerations,
        multipliers: solution.multipliers,
        steps: steps.map(step).collect(),
        turns: Vec::new(),
        pivots: solution.pivots,
        labels: solution.steps,
        unknowns: system.forces.len(),
    }
}

/// The steps of the elimination along an open machine.
pub(super) fn along_the_machine<'d>(
    lowering: &mut Lowering<'_, 'd>,
    model: &Model<'d>,
    system: &System,
    machine: &Unprojected<'d>,
) -> Option<Solved> {
    let turned::TurnSolution {
        accelerations,
        pivots: own_pivots,
        solution,
        quaternions: fours,
    } = turned::solve(model, machine, Order::Short)?;
    lowering.name(&solution.names);
    lowering.lower(&accelerations);
    let mut unknowns = system.forces.len();
    let mut numbers = solution.coordinates;
    let mut number = |id| {
        *numbers.entry(id).or_insert_with(|| {
            unknowns += 1;
            unknowns - 1
        })
    };
    let mut steps = Vec::with_capacity(solution.steps.len());
    for step in &solution.steps {
        let coefficients: Vec<Expr<'d>> = step.parts.iter().map(|(_, c)| *c).collect();
        lowering.lower(&coefficients);
        lowering.lower(step.pivot.as_slice());
        let coefficients = lowering.values(&coefficients);
        let parts = step.parts.iter().map(|(part, _)| number(*part));
        steps.push(EliminatedUnknown {
            parts: parts.zip(coefficients).collect(),
            of: number(step.of),
            pivot: step.pivot.map(|pivot| lowering.values(&[pivot])[0]),
        });
    }
    // If the diagonal entry of M is not available, the pivot need only be positive.
    let scale = |coordinate: usize, pivot: Scaled| {
        let diagonal = system.matrix[Shape::index(coordinate, coordinate)];
        if diagonal.is_known() { diagonal } else { pivot }
    };
    let values: Vec<Expr<'d>> = own_pivots.iter().map(|(_, pivot)| *pivot).collect();
    lowering.lower(&values);
    let pivots = own_pivots.iter().zip(lowering.values(&values));
    let pivots = pivots.map(|(&(coordinate, _), pivot)| Pivot {
        coordinate,
        pivot,
        scale: scale(coordinate, pivot),
    });
    let pivots = pivots.collect();
    let mut turns = Vec::with_capacity(fours.len());
    for (places, e) in fours {
        let all: Vec<Expr<'d>> = e.into_iter().chain(e.map(|e| e / 2)).collect();
        lowering.lower(&all);
        let values = lowering.values(&all);
        turns.push(QuaternionTurn {
            coordinates: places,
            e: std::array::from_fn(|i| values[i]),
            halves: std::array::from_fn(|i| values[4 + i]),
        });
    }
    Some(Solved {
        labels: labelled(lowering, &solution.labels),
        accelerations: lowering.values(&accelerations),
        multipliers: Vec::new(),
        pivots,
        steps,
        turns,
        unknowns,
    })
}

/// The function: the accelerations first, then one column for each variable, row by row.
fn function<'d>(
    lowering: &mut Lowering<'_, 'd>,
    asked: &DerivativeInput<'_, 'd>,
    solved: &Solved,
    slopes: &[Vec<Expr<'d>>],
) -> Draft {
    let n = asked.system.coordinates;
    let rights = right_hand_sides(lowering, slopes, asked, solved);
    let graph = &mut lowering.graph;
    let inverses = inverses(graph, solved);
    let mut columns = vec![solved.accelerations.clone()];
    for right in rights {
        columns.push(solve_by_steps(graph, solved, &inverses, right));
    }
    let rows = (0..n).flat_map(|i| columns.iter().map(move |column| column[i]));
    let planned = PlannedFunction {
        role: Role::Derivatives,
        rows: asked.system.forces.len(),
        shape: Shape::Matrix(n, columns.len()),
        results: rows.collect(),
        pivots: solved
            .pivots
            .iter()
            .copied()
            .filter(|pivot| !asked.known_pivots.contains(pivot))
            .collect(),
        steps: solved.labels.clone(),
    };
    let net = planned.net(graph, true);
    planned.draft(Some(graph), net, Basis::Derived, false)
}

/// The right-hand sides with the values of accelerations and multipliers substituted.
fn right_hand_sides<'d>(
    lowering: &mut Lowering<'_, 'd>,
    slopes: &[Vec<Expr<'d>>],
    asked: &DerivativeInput<'_, 'd>,
    solved: &Solved,
) -> Vec<Vec<Scaled>> {
    // Values that were lowered earlier, such as outputs, may contain the accelerations as arguments.
    let before = std::mem::take(&mut lowering.values);
    for (coordinate, value) in lowering.model.coordinates.iter().zip(&solved.accelerations) {
        lowering.values.insert(coordinate.a.id(), *value);
    }
    for (symbol, value) in asked.multipliers.iter().zip(&solved.multipliers) {
        lowering.values.insert(symbol.id(), *value);
    }
    let mut rights = Vec::with_capacity(slopes.len());
    for column in slopes {
        lowering.lower(column);
        let mut right = lowering.values(column);
        for &(k, weight) in &asked.system.held_constraints {
            let closing = right[asked.system.coordinates + k];
            for (to, g) in right.iter_mut().zip(asked.system.row(k)) {
                let graph = &mut lowering.graph;
                let product = graph.product(&[(weight, 1), (*g, 1), (closing, 1)]);
                *to = graph.sum(&[*to, product]);
            }
        }
        rights.push(right);
    }
    lowering.values = before;
    rights
}

/// The reciprocals of the pivots, step by step.
pub(super) fn inverses(graph: &mut Graph, solved: &Solved) -> Vec<Scaled> {
    let inverse = |step: &EliminatedUnknown| match step.pivot {
        Some(pivot) => {
            let inverse = graph.product(&[(pivot, -1)]);
            graph.opaque(inverse)
        }
        None => Scaled::ZERO,
    };
    solved.steps.iter().map(inverse).collect()
}

/// Solves `M x = r` by the steps that gave the accelerations; for rows of constraints the solution is `−λ`.
pub(super) fn solve_by_steps(
    graph: &mut Graph,
    solved: &Solved,
    inverses: &[Scaled],
    right: Vec<Scaled>,
) -> Vec<Scaled> {
    let n = right.len();
    let right = loads_on_turns(graph, solved, right);
    let mut loads: Vec<Vec<Scaled>> = right.into_iter().map(|load| vec![load]).collect();
    loads.resize(solved.unknowns, Vec::new());
    let mut totals = Vec::with_capacity(solved.steps.len());
    for step in &solved.steps {
        let load = total(graph, &loads[step.of]);
        for &(part, c) in &step.parts {
            loads[part].push(graph.product(&[(c, 1), (load, 1)]));
        }
        totals.push(load);
    }
    let mut answers = vec![Scaled::ZERO; solved.unknowns];
    for ((step, load), inverse) in solved.steps.iter().zip(totals).zip(inverses).rev() {
        let mut terms = vec![graph.product(&[(load, 1), (*inverse, 1)])];
        for &(part, c) in &step.parts {
            terms.push(graph.product(&[(c, 1), (answers[part], 1)]));
        }
        answers[step.of] = total(graph, &terms);
    }
    answers.truncate(n);
    rates_of_quaternions(graph, solved, answers)
}

/// The rates of a quaternion in terms of the velocities of its turn, one row for each rate: the component of ½ e or e that multiplies
/// each velocity, and whether it is subtracted. The last velocity is the growth.
const QUATERNION_RATES: [[(usize, bool); 4]; 4] = [
    [(1, true), (2, true), (3, true), (0, false)],
    [(0, false), (3, true), (2, false), (1, false)],
    [(3, false), (0, false), (1, true), (2, false)],
    [(2, true), (1, false), (0, false), (3, false)],
];

impl QuaternionTurn {
    /// The entry of a row and a column of [`QUATERNION_RATES`].
    fn entry(&self, row: usize, column: usize) -> Scaled {
        let (which, is_negative) = QUATERNION_RATES[row][column];
        let value = match column {
            3 => self.e[which],
            _ => self.halves[which],
        };
        if is_negative { value.negated() } else { value }
    }
}

/// Converts loads on the rates of quaternions to loads on the velocities of their turns.
fn loads_on_turns(graph: &mut Graph, solved: &Solved, mut loads: Vec<Scaled>) -> Vec<Scaled> {
    for turn in &solved.turns {
        let own = turn.coordinates.map(|i| loads[i]);
        for (column, place) in turn.coordinates.into_iter().enumerate() {
            let terms: Vec<Scaled> = (0..4)
                .map(|row| graph.product(&[(turn.entry(row, column), 1), (own[row], 1)]))
                .collect();
            loads[place] = total(graph, &terms);
        }
    }
    loads
}

/// Converts solutions from the velocities of turns to the rates of quaternions.
fn rates_of_quaternions(
    graph: &mut Graph,
    solved: &Solved,
    mut answers: Vec<Scaled>,
) -> Vec<Scaled> {
    for turn in &solved.turns {
        let own = turn.coordinates.map(|i| answers[i]);
        for (row, place) in turn.coordinates.into_iter().enumerate() {
            let terms: Vec<Scaled> = (0..4)
                .map(|column| graph.product(&[(turn.entry(row, column), 1), (own[column], 1)]))
                .collect();
            answers[place] = total(graph, &terms);
        }
    }
    answers
}

/// The sum, as one value that is computed once.
fn total(graph: &mut Graph, terms: &[Scaled]) -> Scaled {
    let sum = graph.sum(terms);
    graph.opaque(sum)
}
