//! Replaces the rates of quaternions by angular velocities.
//!
//! Everything built on a frame moves with the angular velocity ω of its turn, `2/s vec(ē∘ė)`, and the length of the quaternion changes
//! with `u̇ = e·ė/s` alone. So three columns of velocities depend on the quaternion instead of four, and one is separate. The unknowns
//! are ω and u̇,
//!
//! ```text
//! ė = ½ e∘ω + e u̇,      and beside the motion without accelerations ë = ½ e∘α + e ü
//! ```
//!
//! since in space the accelerations of a motion without ë are among the loads. With `det ∂(ω, u̇)/∂ė = 8/s²` and orthogonal rows the
//! pivots of M are those of ω times `4/s`, and that of u̇ times `1/s`.

use lagrangian_symbolic::{Dag, Expr, Id, Node, Symbol, Tangent, reachable, substitute};
use rustc_hash::FxHashMap;

use crate::lower::articulated::{self, ArticulatedSolution, Order};
use crate::{InertialPair, Unprojected};
use lagrangian_spec::model::quaternion;
use lagrangian_spec::model::{Model, stage};

/// A machine whose velocities are those of turns.
struct TurnVelocities<'d> {
    /// The machine, with the velocities of turns as those of its coordinates.
    model: Model<'d>,
    machine: Unprojected<'d>,
    /// The meanings of the velocities of turns.
    meanings: Vec<(Symbol, Expr<'d>)>,
}

/// The accelerations along a machine, solved in the velocities of its turns if it has any.
pub(super) struct TurnSolution<'d> {
    pub accelerations: Vec<Expr<'d>>,
    /// The pivots of the mass matrix, each with its coordinate.
    pub pivots: Vec<(usize, Expr<'d>)>,
    /// The steps, in those velocities.
    pub solution: ArticulatedSolution<'d>,
    /// The quaternions whose rates were replaced: their coordinates, and their components.
    pub quaternions: Vec<([usize; 4], [Expr<'d>; 4])>,
}

/// [`articulated::solve`], extended to machines with quaternions.
pub(super) fn solve<'d>(
    model: &Model<'d>,
    machine: &Unprojected<'d>,
    order: Order,
) -> Option<TurnSolution<'d>> {
    let Some(turned) = in_turn_velocities(model, machine) else {
        let solution = articulated::solve(model, machine, order)?;
        return Some(TurnSolution {
            accelerations: solution.accelerations.clone(),
            pivots: solution.pivots.clone(),
            solution,
            quaternions: Vec::new(),
        });
    };
    let mut solution = articulated::solve(&turned.model, &turned.machine, order)?;
    // Its steps are those of angular velocities, which have no names.
    solution.labels.clear();
    let fours = model.quaternions.iter();
    Some(TurnSolution {
        accelerations: turned.accelerations(model, solution.accelerations.clone()),
        pivots: turned.pivots(model, solution.pivots.clone()),
        solution,
        quaternions: fours
            .map(|four| (four.coordinates(model), four.e))
            .collect(),
    })
}

/// The machine in the velocities of its turns; `None` if it has no quaternion, or if something depends on the rates of one in another way.
fn in_turn_velocities<'d>(
    model: &Model<'d>,
    machine: &Unprojected<'d>,
) -> Option<TurnVelocities<'d>> {
    if model.quaternions.is_empty() || machine.has_bias_accelerations {
        return None;
    }
    let dag = model.dag;
    let mut other = model.clone();
    let mut known: FxHashMap<Id, Expr<'d>> = FxHashMap::default();
    let mut meanings = Vec::new();
    for four in &model.quaternions {
        let places = four.coordinates(model);
        let rates = places.map(|i| model.coordinates[i].v);
        let name = &model.coordinates[places[0]].name;
        // Names in a spec contain no spaces.
        let symbol = |of: &str| dag.symbol(&format!("{of} of {name}"), stage::VELOCITY);
        let velocities = ["turn x", "turn y", "turn z", "growth"].map(symbol);
        let s = quaternion::square(&four.e);
        for (sum, velocity) in quaternion::vector_part(&four.e, &rates)
            .into_iter()
            .zip(velocities)
        {
            known.insert(sum.id(), s * velocity / 2);
        }
        let pairs = four.e.iter().zip(rates);
        let pairs = pairs.filter_map(|(e, rate)| Some((e.as_symbol()?, rate)));
        let growing = Tangent::new(dag, &pairs.collect::<Vec<_>>()).of(s);
        known.insert(growing.id(), 2 * s * velocities[3]);
        known.insert(
            quaternion::radial_rate(&four.e, &rates).id(),
            s * velocities[3],
        );
        for (i, velocity) in places.into_iter().zip(velocities) {
            other.coordinates[i].v = velocity;
        }
        let turn = quaternion::angular_velocity(&four.e, &rates);
        let growth = quaternion::radial_rate(&four.e, &rates) / s;
        let values = turn.into_iter().chain([growth]);
        let pairs = velocities.into_iter().zip(values);
        meanings.extend(pairs.filter_map(|(velocity, value)| Some((velocity.as_symbol()?, value))));
    }
    let pairs = machine.inertia.iter().flat_map(|pair| [pair.u, pair.w]);
    let loaded = machine.loads.iter().map(|(u, _)| *u);
    let roots: Vec<Expr<'d>> = pairs.chain(loaded).collect();
    let mut written = rewritten(dag, &roots, known)?.into_iter();
    let rates = model
        .quaternions
        .iter()
        .flat_map(|four| four.coordinates(model));
    let rates: Vec<_> = rates
        .filter_map(|i| model.coordinates[i].v.as_symbol())
        .collect();
    if written
        .clone()
        .any(|u| u.symbols().iter().any(|symbol| rates.contains(symbol)))
    {
        return None;
    }
    let mut next = || written.next();
    let mut inertia = Vec::with_capacity(machine.inertia.len());
    for pair in &machine.inertia {
        let (u, w) = (next()?, next()?);
        inertia.push(InertialPair { u, w, ..*pair });
    }
    let mut loads = Vec::with_capacity(machine.loads.len());
    for (_, load) in &machine.loads {
        loads.push((next()?, *load));
    }
    let machine = Unprojected {
        inertia,
        loads,
        has_bias_accelerations: false,
    };
    Some(TurnVelocities {
        model: other,
        machine,
        meanings,
    })
}

/// Rewrites velocities, sums and products of others, with some nodes replaced; `None` if one of these is inside a function.
fn rewritten<'d>(
    dag: &'d Dag,
    roots: &[Expr<'d>],
    mut known: FxHashMap<Id, Expr<'d>>,
) -> Option<Vec<Expr<'d>>> {
    for id in reachable(dag, roots) {
        if known.contains_key(&id) {
            continue;
        }
        let node = dag.node(id);
        let mut changes = false;
        node.for_each_child(|child| changes |= known.contains_key(&child));
        if !changes {
            continue;
        }
        let new = |child: &Id| known.get(child).copied().unwrap_or(dag.expr(*child));
        let other = match &node {
            Node::Sum(terms) => dag.sum(terms.iter().map(|(x, c)| new(x) * c.clone())),
            Node::Product(factors) => dag.product(factors.iter().map(|(x, n)| new(x).powi(*n))),
            _ => return None,
        };
        known.insert(id, other);
    }
    let all = roots
        .iter()
        .map(|root| known.get(&root.id()).copied().unwrap_or(*root));
    Some(all.collect())
}

impl<'d> TurnVelocities<'d> {
    /// The accelerations of the coordinates of the machine from those of its turns, without the part that remains if neither accelerates.
    fn accelerations(&self, model: &Model<'d>, mut of: Vec<Expr<'d>>) -> Vec<Expr<'d>> {
        let dag = model.dag;
        for four in &model.quaternions {
            let places = four.coordinates(model);
            let [a, b, c, growth] = places.map(|i| of[i]);
            let [a, b, c] = [a, b, c].map(|turn| turn / 2);
            let [w, x, y, z] = four.e;
            let turned = [
                dag.sum([w * growth, -(x * a), -(y * b), -(z * c)]),
                dag.sum([x * growth, w * a, y * c, -(z * b)]),
                dag.sum([y * growth, w * b, z * a, -(x * c)]),
                dag.sum([z * growth, w * c, x * b, -(y * a)]),
            ];
            for (i, value) in places.into_iter().zip(turned) {
                of[i] = value;
            }
        }
        // Loads on nodes that are not linear in velocities may contain them.
        substitute(dag, &of, &self.meanings)
    }

    /// The pivots of the mass matrix from those of the turns, each with its coordinate.
    fn pivots(&self, model: &Model<'d>, mut of: Vec<(usize, Expr<'d>)>) -> Vec<(usize, Expr<'d>)> {
        for four in &model.quaternions {
            let s = quaternion::square(&four.e);
            let places = four.coordinates(model);
            for (i, pivot) in of.iter_mut().filter(|(i, _)| places.contains(i)) {
                *pivot = if *i == places[3] {
                    *pivot / s
                } else {
                    4 * *pivot / s
                };
            }
        }
        of
    }
}
