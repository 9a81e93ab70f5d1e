//! Solves for the accelerations without a mass matrix, by eliminating inertia from the tips of the
//! machine to the ground.
//!
//! Inertia belongs to velocities `u` of bodies, `T = ½ Σ w u²`, and the velocity of a body is built
//! from that of the body it hangs on: `u = u' + l cos φ·φ̇`. Written for all accelerations at once
//! the equations of motion are sparse, and this elimination keeps them so. By Gauss's principle the
//! accelerations minimize `½ Σ G_xy ẋ ẏ − Σ g_x ẋ`. This quadratic form is kept over a *front* of
//! velocities, initially those with inertia or loads. Until the front is empty:
//!
//! ```text
//! a velocity v of a coordinate on which nothing else in the front depends is eliminated:
//!     G_xy −= G_xv G_yv / G_vv     g_x −= G_xv g_v / G_vv
//! if there is none, a velocity u = Σ cₖ wₖ + e that no other is built from gives way to its parts; with β = Σ ċₖ wₖ + ė
//!     G_kl += cₖ cₗ G_uu           G_kx += cₖ G_ux
//!     g_k += cₖ (g_u − G_uu β)     g_x −= G_ux β
//! ```
//!
//! Coupled velocities with common parts are replaced together, `u = C w + e`: with `B = G C` the form
//! becomes `Cᵀ B`, and common parts of its columns are computed once. If a coordinate's velocity `v`
//! enters only one velocity, `u = ±v + …`, then `u` takes its place: so the bars of a chain have angular
//! velocities of their own, whatever their angles are measured from.
//!
//! In space the accelerations that velocities have without accelerations of coordinates are computed
//! from the ground outwards and are among the loads; then `β = 0`.
//!
//! The accelerations follow in reverse order. On a chain of links this is the articulated-body
//! algorithm, linear in the number of links (R. Featherstone, *The calculation of robot dynamics
//! using articulated-body inertias*, Int. J. Robotics Res. 2 (1983) 13–30). A machine of free
//! bodies decouples, since the algebra simplifies the inertia that remains of a body in polar
//! coordinates to `m − m cos² − m sin² = 0`. Every `G` is positive semidefinite and every
//! elimination symmetric, so rounding errors stay as small as in Cholesky's method.

use std::collections::{BTreeMap, BTreeSet};

use lagrangian_symbolic::{
    Dag, Expr, Function, Id, Node, Rational, Stage, Symbol, Tangent, reachable, reverse,
};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::lower::bars::{self, Arm};
use crate::{InertialPair, Unprojected};
use lagrangian_program::EliminationStep;
use lagrangian_spec::identity;
use lagrangian_spec::model::Model;

/// The largest number of terms that may enter the form. Beyond it, elimination of the mass matrix is better.
const TERM_LIMIT: usize = 40_000;

/// The largest number of nodes and operands that may be created on the way. A machine that needs
/// more is coupled too densely to be eliminated along its structure.
const MOST_GROWTH: usize = 4_000_000;

/// The largest total number: the graph keeps what was tried and discarded, and this is half a gigabyte.
const MOST_SIZE: usize = 10_000_000;

/// The largest number of nodes between the velocity of a point on a bar and those of its joint and of the
/// bar. A velocity that is nested deeper is not treated as that of a point on a bar, since following each
/// of these to its end would take too long.
const LONGEST_ARM: usize = 64;

/// Accelerations in the order of the coordinates, and pivots with their coordinates in the order of elimination.
pub(super) struct ArticulatedSolution<'d> {
    pub(super) accelerations: Vec<Expr<'d>>,
    pub(super) pivots: Vec<(usize, Expr<'d>)>,
    /// Symbols in all of these with their meanings, values that are computed once.
    pub(super) names: Vec<(Expr<'d>, Expr<'d>)>,
    /// The steps, in order.
    pub(super) steps: Vec<EliminatedVelocity<'d>>,
    /// The values of the elimination of each coordinate, for comments.
    pub(super) labels: Vec<(Expr<'d>, EliminationStep)>,
    /// The coordinates by the nodes of their velocities.
    pub(super) coordinates: BTreeMap<Id, usize>,
}

/// Solves for the accelerations; `None` if that takes too much work, or if a coordinate has no inertia.
pub(super) fn solve<'d>(
    model: &Model<'d>,
    machine: &Unprojected<'d>,
    order: Order,
) -> Option<ArticulatedSolution<'d>> {
    within_bounds(model.dag, || eliminated(model, machine, order))
}

/// The result of `derive`; `None` if the graph grows too much on the way.
fn within_bounds<T>(dag: &Dag, derive: impl FnOnce() -> Option<T>) -> Option<T> {
    dag.set_limit((dag.size() + MOST_GROWTH).min(MOST_SIZE));
    let derived = derive();
    let is_whole = !dag.is_exhausted();
    dag.set_limit(usize::MAX);
    derived.filter(|_| is_whole)
}

fn eliminated<'d>(
    model: &Model<'d>,
    machine: &Unprojected<'d>,
    order: Order,
) -> Option<ArticulatedSolution<'d>> {
    let mut front = Front::of(model, machine, true);
    front.order = order;
    let mut steps = front.replaced_velocities();
    while let Some(mut left) = front.next()? {
        steps.append(&mut left);
    }
    let mut known: FxHashMap<Id, Expr<'d>> = FxHashMap::default();
    for EliminatedVelocity {
        of,
        offset: alone,
        parts,
        ..
    } in steps.iter().rev()
    {
        let terms = parts.iter().map(|(part, c)| *c * known[part]);
        let terms = std::iter::once(*alone).chain(terms);
        let total = match order {
            Order::Short => front.totals.total(terms.collect()),
            // Factoring out a common factor would make it wait for the other parts.
            Order::Ahead => model.dag.sum(terms),
        };
        known.insert(*of, total);
    }
    let pivots: Vec<_> = steps
        .iter()
        .filter_map(|step| Some((*front.coordinates.get(&step.of)?, step.pivot?)))
        .collect();
    // The inertia of a coordinate may be identically zero without looking so.
    let divisors: Vec<Expr<'d>> = steps.iter().filter_map(|step| step.pivot).collect();
    if !identity::are_divisors(model.dag, &divisors, &front.names) {
        return None;
    }
    let velocities: BTreeMap<Id, usize> = model
        .coordinates
        .iter()
        .enumerate()
        .map(|(index, c)| (c.v.id(), index))
        .collect();
    let labels = labels(&front.coordinates, &velocities, &steps, &known);
    let mut accelerations = vec![model.dag.zero(); velocities.len()];
    for (id, coordinate) in &velocities {
        accelerations[*coordinate] = *known.get(id)?;
    }
    Some(ArticulatedSolution {
        names: front.names,
        accelerations,
        pivots,
        labels,
        coordinates: velocities,
        steps,
    })
}

/// What the values of the elimination of each coordinate are, where `coordinates` are the coordinates by the velocities that
/// are eliminated, and `velocities` by their own.
fn labels<'d>(
    coordinates: &BTreeMap<Id, usize>,
    velocities: &BTreeMap<Id, usize>,
    steps: &[EliminatedVelocity<'d>],
    known: &FxHashMap<Id, Expr<'d>>,
) -> Vec<(Expr<'d>, EliminationStep)> {
    let mut labels = Vec::new();
    for step in steps {
        let (Some(&i), Some(pivot)) = (coordinates.get(&step.of), step.pivot) else {
            continue;
        };
        labels.push((pivot, EliminationStep::Inertia(i)));
        for (_, coupling) in &step.parts {
            labels.push((*coupling, EliminationStep::Coupling(i)));
        }
        if step.parts.is_empty() {
            continue;
        }
        labels.push((step.offset, EliminationStep::Free(i)));
        // Another velocity in its place has another acceleration.
        if velocities.contains_key(&step.of) {
            labels.push((known[&step.of], EliminationStep::Solution(i)));
        }
    }
    labels
}

/// The mass matrix in the same way, without eliminating anything: the lower triangle, row by row.
///
/// Once every velocity is replaced by those of coordinates, the form is that of `M`. A body adds its
/// inertia to that of the body it hangs on before the sum is passed on, so each entry takes the work
/// of one link: the composite rigid body algorithm (M. W. Walker and D. E. Orin, *Efficient dynamic
/// computer simulation of robotic mechanisms*, J. Dyn. Syst. Meas. Control 104 (1982) 205–211).
pub(super) fn mass_matrix<'d>(
    model: &Model<'d>,
    machine: &Unprojected<'d>,
) -> Option<Vec<Expr<'d>>> {
    within_bounds(model.dag, || composite_inertia(model, machine))
}

fn composite_inertia<'d>(model: &Model<'d>, machine: &Unprojected<'d>) -> Option<Vec<Expr<'d>>> {
    let unloaded = Unprojected {
        inertia: machine.inertia.clone(),
        loads: Vec::new(),
        has_bias_accelerations: false,
    };
    let mut front = Front::of(model, &unloaded, false);
    front.totals.expands = false;
    while let Some(id) = front.next_to_replace() {
        if front.is_too_long() {
            return None;
        }
        let group = front.group(id)?;
        front.replace(group);
    }
    let mut entries = Vec::new();
    for (i, row) in model.coordinates.iter().enumerate() {
        for column in &model.coordinates[..=i] {
            let row = front.form.get_mut(&row.v.id());
            let terms = row.and_then(|row| row.remove(&column.v.id()));
            entries.push(front.totals.total(terms.unwrap_or_default()));
        }
    }
    Some(entries)
}

/// A velocity that has left the front: its acceleration is `offset + Σ c·part`.
///
/// For another right-hand side at zero velocities, `Σ G ẍ = r`, it is `r/pivot + Σ c·part`, where
/// the first term is 0 without a pivot; and `c r` is added to the load on each part.
pub(super) struct EliminatedVelocity<'d> {
    pub(super) of: Id,
    offset: Expr<'d>,
    pub(super) parts: Vec<(Id, Expr<'d>)>,
    /// Its pivot, if it was eliminated.
    pub(super) pivot: Option<Expr<'d>>,
}

/// `u = Σ c·part + rest`, where `c` and the rest are free of velocities.
struct Composition<'d> {
    parts: Vec<(Id, Expr<'d>)>,
    rest: Expr<'d>,
}

/// A velocity that takes the place of a coordinate's: `u = ±v + Σ c·part + rest`, and nothing else
/// is built from `v`.
struct Substitute<'d> {
    id: Id,
    /// `v`.
    velocity: Id,
    sign: Rational,
    parts: Vec<(Id, Expr<'d>)>,
    rest: Expr<'d>,
}

/// The order of computations.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Order {
    /// One elimination after the other, with the fewest operations.
    Short,
    /// Computations that do not depend on the last division first: while an update `− w wᵀ/d` is pending,
    /// `Cᵀ G C` is computed from the old G, and `w` becomes `Cᵀ w`, so that the next pivot waits for only
    /// one multiplication and one subtraction. This is the same elimination, with more operations.
    Ahead,
}

/// A pending update `− w wᵀ/d` of the form.
struct Update<'d> {
    /// `w`, by row.
    column: BTreeMap<Id, Expr<'d>>,
    /// `d`.
    pivot: Expr<'d>,
}

/// The rows of a group of velocities.
struct TakenRows<'d> {
    /// By place in the group the entries within it.
    inner: Vec<Vec<(usize, Expr<'d>)>>,
    /// By place in the group the entries with other velocities.
    outer: Vec<Vec<(Id, Expr<'d>)>>,
    /// By place in the group the loads.
    loads: Vec<Vec<Expr<'d>>>,
}

struct Front<'d> {
    dag: &'d Dag,
    order: Order,
    /// Pending updates.
    pending: Vec<Update<'d>>,
    /// The coordinates by the nodes of their velocities, or of the velocities in their places.
    coordinates: BTreeMap<Id, usize>,
    /// The velocities that take the places of the coordinates' velocities.
    substitutes: Vec<Option<Substitute<'d>>>,
    /// The coordinates on whose velocities a node depends, if it is linear in them.
    coordinates_of_node: FxHashMap<Id, BTreeSet<usize>>,
    /// The number of nodes of which a node is a part.
    parents: FxHashMap<Id, usize>,
    /// `d/dt` of expressions in coordinates and time.
    rate: Tangent<'d>,
    /// Terms of G, row by row, both triangles.
    form: BTreeMap<Id, BTreeMap<Id, Vec<Expr<'d>>>>,
    /// Terms of g.
    loads: BTreeMap<Id, Vec<Expr<'d>>>,
    /// For each coordinate the number of velocities in the front, other than those of coordinates,
    /// that depend on its velocity.
    uses: Vec<usize>,
    /// Whether velocities have accelerations when all coordinate accelerations are zero.
    has_bias_accelerations: bool,
    /// The velocities that fall freely in the accelerated frame in which the machine is described,
    /// with their accelerations there.
    free_falls: FxHashMap<Id, Expr<'d>>,
    /// Whether coefficients may be given names.
    names_coefficients: bool,
    /// Named coefficients and their meanings.
    names: Vec<(Expr<'d>, Expr<'d>)>,
    totals: Totals<'d>,
    /// The number of terms that have entered G and g.
    terms: usize,
}

impl<'d> Front<'d> {
    /// The initial front. With `with_substitutes`, velocities may take the places of coordinates' velocities.
    fn of(model: &Model<'d>, machine: &Unprojected<'d>, with_substitutes: bool) -> Front<'d> {
        let dag = model.dag;
        let coordinates = model.coordinates.iter().enumerate();
        let rates = model
            .coordinates
            .iter()
            .filter_map(|c| Some((c.q.as_symbol()?, c.v)));
        let time = model.time.as_symbol().map(|t| (t, dag.one()));
        let mut front = Front {
            dag,
            order: Order::Short,
            pending: Vec::new(),
            coordinates: coordinates.map(|(index, c)| (c.v.id(), index)).collect(),
            substitutes: model.coordinates.iter().map(|_| None).collect(),
            coordinates_of_node: FxHashMap::default(),
            parents: FxHashMap::default(),
            rate: Tangent::new(dag, &rates.chain(time).collect::<Vec<_>>()),
            form: BTreeMap::new(),
            loads: BTreeMap::new(),
            uses: vec![0; model.coordinates.len()],
            has_bias_accelerations: machine.has_bias_accelerations,
            free_falls: FxHashMap::default(),
            names_coefficients: machine.has_bias_accelerations && with_substitutes,
            names: Vec::new(),
            totals: Totals {
                dag,
                own_sums: FxHashSet::default(),
                expands: true,
            },
            terms: 0,
        };
        front.find_linear(&front.roots(model, machine));
        let replaced = bars::replaced(machine, &front.arms(), &model.assumptions);
        let machine = replaced.as_ref().unwrap_or(machine);
        let roots = front.roots(model, machine);
        if replaced.is_some() {
            front.discard_linear();
            front.find_linear(&roots);
        }
        if with_substitutes {
            front.find_substitutes(&roots, machine);
        }
        for id in front.coordinates.keys().copied().collect::<Vec<_>>() {
            front.enter(id);
        }
        for &InertialPair { u, w, weight, .. } in &machine.inertia {
            front.add_inertia(u, w, weight);
        }
        let weights = front.gravity(machine);
        let loads = machine.loads.iter().copied().chain(weights);
        front.add_loads(&loads.collect::<Vec<_>>(), model);
        front
    }

    /// Finds velocities that may take the place of a coordinate's velocity: a sum with `±v` among
    /// its terms, if nothing else is built from `v` and `v` itself has no inertia.
    ///
    /// So each bar of a chain gets an angular velocity of its own, whatever its angle is measured
    /// from, and a joint in space the angular velocity about its axis.
    fn find_substitutes(&mut self, roots: &[Expr<'d>], machine: &Unprojected<'d>) {
        let inert: FxHashSet<Id> = machine
            .inertia
            .iter()
            .flat_map(|pair| [pair.u.id(), pair.w.id()])
            .collect();
        let mut candidates: BTreeMap<Id, Vec<usize>> = BTreeMap::new();
        for (&id, touched) in &self.coordinates_of_node {
            let Node::Sum(terms) = self.dag.node(id) else {
                continue;
            };
            for (term, c) in terms.iter() {
                let Some(&index) = self.coordinates.get(term) else {
                    continue;
                };
                let is_unit = c.is_one() || *c == Rational::MINUS_ONE;
                if is_unit && self.parents[term] == 1 && !inert.contains(term) && touched.len() > 1
                {
                    candidates.entry(id).or_default().push(index);
                }
            }
        }
        for (id, indices) in candidates {
            if !self.is_linear(id) {
                continue;
            }
            let Some(parts) = self.direct_parts(id) else {
                continue;
            };
            // If there are several, take the first.
            let index = *indices.iter().min().unwrap_or(&0);
            let of = |part: &Id| self.coordinates.get(part) == Some(&index);
            let Some((own, c)) = parts.iter().find(|(part, _)| of(part)) else {
                continue;
            };
            let sign = if *c == self.dag.one() {
                Rational::ONE
            } else {
                Rational::MINUS_ONE
            };
            let own = *own;
            let (moving, resting): (Vec<_>, Vec<_>) = parts
                .into_iter()
                .filter(|(part, _)| *part != own)
                .partition(|(part, _)| self.coordinates_of_node.contains_key(part));
            let resting = resting.into_iter().map(|(part, c)| c * self.dag.expr(part));
            self.substitutes[index] = Some(Substitute {
                id,
                velocity: own,
                sign,
                parts: moving,
                rest: self.dag.sum(resting),
            });
        }
        for (index, place) in self.substitutes.iter().enumerate() {
            if let Some(place) = place {
                self.coordinates.retain(|_, other| *other != index);
                self.coordinates.insert(place.id, index);
            }
        }
        self.discard_linear();
        self.find_linear(roots);
    }

    /// The velocities of inertia and loads, and those of the coordinates.
    fn roots(&self, model: &Model<'d>, machine: &Unprojected<'d>) -> Vec<Expr<'d>> {
        let inertial = machine.inertia.iter().flat_map(|pair| [pair.u, pair.w]);
        let loaded = machine.loads.iter().map(|(u, _)| *u);
        let velocities = model.coordinates.iter().map(|c| c.v);
        inertial.chain(loaded).chain(velocities).collect()
    }

    /// The velocity components of points on bars: the sum of a velocity and one rotation, at a
    /// distance across the bar.
    fn arms(&self) -> BTreeMap<Id, Arm<'d>> {
        let mut arms: BTreeMap<Id, Arm<'d>> = BTreeMap::new();
        let mut nodes: Vec<Id> = self.coordinates_of_node.keys().copied().collect();
        nodes.sort_unstable();
        // The parts of a node come before it, so each node is visited once.
        let mut linear: FxHashSet<Id> = FxHashSet::default();
        for id in nodes {
            if self.coordinates.contains_key(&id) {
                continue;
            }
            let is_settled = |(part, _): &(Id, Expr<'d>)| {
                !self.coordinates_of_node.contains_key(part)
                    || self.coordinates.contains_key(part)
                    || linear.contains(part)
            };
            let direct = self.direct_parts(id);
            if !direct.is_some_and(|parts| parts.iter().all(is_settled)) {
                continue;
            }
            linear.insert(id);
            let Some(Composition { parts, rest }) = self.composition_within(id, LONGEST_ARM) else {
                continue;
            };
            let mut parts = parts;
            parts.sort_by_key(|(_, c)| c.stage() > Stage::PARAMETER);
            let &[(joint, one), (turning, across)] = parts.as_slice() else {
                continue;
            };
            if one != self.dag.one() || across.stage() <= Stage::PARAMETER || !rest.is_zero() {
                continue;
            }
            // Measured from the joint, if it was given from another point of the bar.
            let arm = match arms.get(&joint) {
                Some(inner) if inner.angular_velocity == turning => Arm {
                    joint: inner.joint,
                    lever: inner.lever + across,
                    ..*inner
                },
                _ => Arm {
                    joint,
                    angular_velocity: turning,
                    lever: across,
                    has_dependents: false,
                },
            };
            let carries = self.parents.contains_key(&id);
            arms.insert(
                id,
                Arm {
                    has_dependents: carries,
                    ..arm
                },
            );
        }
        arms
    }

    /// Discards the results of [`find_linear`](Self::find_linear).
    fn discard_linear(&mut self) {
        self.coordinates_of_node.clear();
        self.parents.clear();
    }

    /// The velocities whose places others took, in terms of these: `v = ±(u − Σ c·part − rest)`.
    fn replaced_velocities(&mut self) -> Vec<EliminatedVelocity<'d>> {
        let places = std::mem::take(&mut self.substitutes);
        let steps = places.iter().flatten().map(|place| {
            let sign = self.dag.constant(place.sign.clone());
            let parts = place.parts.iter().map(|(part, c)| (*part, -(sign * *c)));
            EliminatedVelocity {
                of: place.velocity,
                offset: -(sign
                    * (self.bias_acceleration(&[], place.rest)
                        + self.free_fall(place.id, &place.parts))),
                parts: std::iter::once((place.id, sign)).chain(parts).collect(),
                pivot: None,
            }
        });
        steps.collect()
    }

    /// Finds the nodes that are linear in velocities, and the velocities that they contain.
    fn find_linear(&mut self, roots: &[Expr<'d>]) {
        for id in reachable(self.dag, roots) {
            let node = self.dag.node(id);
            let mut touched: BTreeSet<usize> =
                self.coordinates.get(&id).copied().into_iter().collect();
            if !touched.is_empty() {
                self.coordinates_of_node.insert(id, touched);
                continue;
            }
            node.for_each_child(|child| {
                touched.extend(self.coordinates_of_node.get(&child).into_iter().flatten())
            });
            if !touched.is_empty() {
                self.coordinates_of_node.insert(id, touched);
                node.for_each_child(|child| *self.parents.entry(child).or_default() += 1);
            }
        }
    }

    /// Adds `½ weight u w` to the energy.
    fn add_inertia(&mut self, u: Expr<'d>, w: Expr<'d>, weight: Expr<'d>) {
        let moves = |x: Expr<'d>| self.coordinates_of_node.contains_key(&x.id());
        match (moves(u), moves(w)) {
            (true, true) => {
                self.enter(u.id());
                self.enter(w.id());
                self.add(u.id(), w.id(), if u == w { weight } else { weight / 2 });
            }
            // The other one depends on time alone.
            (true, false) => {
                let load = -(weight / 2 * self.bias_acceleration(&[], w));
                self.enter(u.id());
                self.add_load(u.id(), load);
            }
            (false, true) => self.add_inertia(w, u, weight),
            (false, false) => {}
        }
    }

    /// Adds loads to velocities; those on nodes that are not linear in velocities go to the coordinates.
    fn add_loads(&mut self, loads: &[(Expr<'d>, Expr<'d>)], model: &Model<'d>) {
        let velocities: Vec<Symbol> = model
            .coordinates
            .iter()
            .filter_map(|c| c.v.as_symbol())
            .collect();
        let (linear, others): (Vec<_>, Vec<_>) = loads
            .iter()
            .copied()
            .partition(|(u, _)| self.is_linear(u.id()));
        let direct = reverse(self.dag, &others, &velocities);
        let direct = model.coordinates.iter().map(|c| c.v).zip(direct);
        // Several loads on one velocity become one, which stays a whole.
        let mut sums: BTreeMap<Id, Vec<Expr<'d>>> = BTreeMap::new();
        for (u, load) in linear.into_iter().chain(direct) {
            let place = self.substitutes.iter().zip(&model.coordinates);
            let place = place
                .filter(|(_, c)| c.v == u)
                .find_map(|(p, _)| p.as_ref());
            match place {
                // A load on `v = ±(u − Σ c·part − rest)` acts on all of these.
                Some(place) => {
                    let load = load * place.sign.clone();
                    sums.entry(place.id).or_default().push(load);
                    for (part, c) in &place.parts {
                        sums.entry(*part).or_default().push(-(*c * load));
                    }
                }
                None if self.coordinates_of_node.contains_key(&u.id()) => {
                    sums.entry(u.id()).or_default().push(load);
                }
                None => {}
            }
        }
        // Their accelerations are needed, with or without loads.
        let parts = self
            .substitutes
            .iter()
            .flatten()
            .flat_map(|place| &place.parts);
        for id in parts.map(|(part, _)| *part).collect::<Vec<_>>() {
            self.enter(id);
        }
        for (id, loads) in sums {
            let load = self.dag.sum(loads);
            if !load.is_zero() {
                self.enter(id);
                self.add_load(id, load);
            }
        }
    }

    fn enter(&mut self, id: Id) {
        if self.form.contains_key(&id) {
            return;
        }
        self.form.insert(id, BTreeMap::new());
        self.count_uses(id, |uses| *uses += 1);
    }

    fn count_uses(&mut self, id: Id, change: fn(&mut usize)) {
        if !self.coordinates.contains_key(&id) {
            for &coordinate in &self.coordinates_of_node[&id] {
                change(&mut self.uses[coordinate]);
            }
        }
    }

    /// `G_uw += value`, and `G_wu`.
    fn add(&mut self, u: Id, w: Id, value: Expr<'d>) {
        if value.is_zero() {
            return;
        }
        self.terms += 1;
        let mut add = |row: Id, column: Id| {
            self.form
                .entry(row)
                .or_default()
                .entry(column)
                .or_default()
                .push(value)
        };
        add(u, w);
        if u != w {
            add(w, u);
        }
    }

    /// `g_u += load`.
    fn add_load(&mut self, u: Id, load: Expr<'d>) {
        if !load.is_zero() {
            self.terms += 1;
            self.loads.entry(u).or_default().push(load);
        }
    }

    /// Removes a velocity from the front, and returns its diagonal entry of G, the others of its
    /// row, and the terms of its load.
    fn take(&mut self, id: Id) -> (Expr<'d>, Vec<(Id, Expr<'d>)>, Vec<Expr<'d>>) {
        let row = self.form.remove(&id).unwrap_or_default();
        let mut own = self.dag.zero();
        let mut others = Vec::new();
        for (other, terms) in row {
            let value = self.totals.total(terms);
            if other == id {
                own = value;
                continue;
            }
            if let Some(row) = self.form.get_mut(&other) {
                row.remove(&id);
            }
            if !value.is_zero() {
                others.push((other, value));
            }
        }
        self.count_uses(id, |uses| *uses -= 1);
        (own, others, self.loads.remove(&id).unwrap_or_default())
    }

    /// Whether the elimination has exceeded the size up to which it can be the better way.
    fn is_too_long(&self) -> bool {
        self.terms > TERM_LIMIT || self.dag.is_exhausted()
    }

    /// The next step; the inner `None` means that the front is empty.
    fn next(&mut self) -> Option<Option<Vec<EliminatedVelocity<'d>>>> {
        if self.is_too_long() {
            return None;
        }
        let is_free =
            |(id, index): &(&Id, &usize)| self.form.contains_key(id) && self.uses[**index] == 0;
        let free = self.coordinates.iter().filter(is_free).map(|(id, _)| *id);
        if let Some(id) = free.min_by_key(|id| (self.form[id].len(), *id)) {
            return self.eliminate(id).map(|step| Some(vec![step]));
        }
        match self.next_to_replace() {
            Some(id) => {
                let group = self.group(id)?;
                Some(Some(self.replace(group)))
            }
            None => Some(None),
        }
    }

    /// The velocity to replace by its parts. The coordinate on which the fewest velocities of the
    /// front depend is taken first, so that a chain is processed from its tip. Among these
    /// velocities it is the one built last, from which nothing else can be built.
    fn next_to_replace(&self) -> Option<Id> {
        let built = || {
            self.form
                .keys()
                .rev()
                .filter(|id| !self.coordinates.contains_key(id))
        };
        let used = self.uses.iter().enumerate().filter(|(_, uses)| **uses > 0);
        let (coordinate, _) =
            used.min_by_key(|(index, uses)| (**uses, std::cmp::Reverse(*index)))?;
        built()
            .find(|id| self.coordinates_of_node[*id].contains(&coordinate))
            .copied()
    }

    fn eliminate(&mut self, id: Id) -> Option<EliminatedVelocity<'d>> {
        let (mut pivot, mut row, load) = self.take(id);
        self.apply_pending_updates(id, &mut pivot, &mut row);
        if pivot.is_zero() {
            return None;
        }
        let load = self.totals.total(load);
        let ratios: Vec<(Id, Expr<'d>)> =
            row.iter().map(|(x, value)| (*x, *value / pivot)).collect();
        for (x, ratio) in &ratios {
            self.add_load(*x, -(*ratio * load));
        }
        let update = Update {
            column: row.into_iter().collect(),
            pivot,
        };
        match self.order {
            Order::Short => self.apply_update(&update),
            Order::Ahead => self.pending.push(update),
        }
        let parts = ratios.into_iter().map(|(x, ratio)| (x, -ratio)).collect();
        Some(EliminatedVelocity {
            of: id,
            offset: load / pivot,
            parts,
            pivot: Some(pivot),
        })
    }

    /// `G −= w wᵀ/d`.
    fn apply_update(&mut self, update: &Update<'d>) {
        for (position, (x, value)) in update.column.iter().enumerate() {
            let ratio = *value / update.pivot;
            for (y, other) in update.column.iter().take(position + 1) {
                self.add(*x, *y, -(ratio * *other));
            }
        }
    }

    /// Makes all pending updates that involve a row taken from the form; `own` and `row` receive its share.
    fn apply_pending_updates(&mut self, id: Id, own: &mut Expr<'d>, row: &mut Vec<(Id, Expr<'d>)>) {
        let (due, others) = std::mem::take(&mut self.pending)
            .into_iter()
            .partition::<Vec<_>, _>(|update| update.column.contains_key(&id));
        self.pending = others;
        let mut row_terms: BTreeMap<Id, Vec<Expr<'d>>> =
            row.drain(..).map(|(x, value)| (x, vec![value])).collect();
        let mut own_terms = vec![*own];
        for mut update in due {
            let Some(value) = update.column.remove(&id) else {
                continue;
            };
            own_terms.push(-(value.square() / update.pivot));
            for (x, other) in &update.column {
                let terms = row_terms.entry(*x).or_default();
                terms.push(-(value / update.pivot * *other));
            }
            self.apply_update(&update);
        }
        *own = self.dag.sum(own_terms);
        for (x, terms) in row_terms {
            let value = self.dag.sum(terms);
            if !value.is_zero() {
                row.push((x, value));
            }
        }
    }

    /// The velocities that are replaced together with a given one: those that share parts with it,
    /// and from which nothing else in the front is built.
    fn group(&self, first: Id) -> Option<Vec<(Id, Composition<'d>)>> {
        let own = self.composition(first)?;
        let parts: BTreeSet<Id> = own.parts.iter().map(|(part, _)| *part).collect();
        let touched = &self.coordinates_of_node[&first];
        let mut group = vec![(first, own)];
        let built = self.form.keys().rev().copied();
        let others: Vec<Id> = built
            .filter(|id| *id != first && !self.coordinates.contains_key(id))
            .filter(|id| !touched.is_disjoint(&self.coordinates_of_node[id]))
            .collect();
        let touches_both = |update: &Update<'d>, id: &Id| {
            update.column.contains_key(&first) && update.column.contains_key(id)
        };
        let coupled = |id: &&Id| {
            self.form[&first].contains_key(*id)
                || self.pending.iter().any(|update| touches_both(update, id))
        };
        for &id in others.iter().filter(coupled) {
            let composition = self.composition(id)?;
            let shares = composition
                .parts
                .iter()
                .any(|(part, _)| parts.contains(part));
            let mut above = others
                .iter()
                .copied()
                .take_while(|above| *above > id)
                .chain([first]);
            if shares && !parts.contains(&id) && !above.any(|above| self.is_built_from(above, id)) {
                group.push((id, composition));
            }
        }
        Some(group)
    }

    /// Whether one velocity is built from another.
    fn is_built_from(&self, id: Id, part: Id) -> bool {
        let mut open = vec![id];
        let mut seen = FxHashSet::default();
        while let Some(id) = open.pop() {
            if id == part {
                return true;
            }
            if id > part && !self.coordinates.contains_key(&id) && seen.insert(id) {
                self.dag.node(id).for_each_child(|child| {
                    if child >= part && self.coordinates_of_node.contains_key(&child) {
                        open.push(child);
                    }
                });
            }
        }
        false
    }

    /// Replaces velocities `u = C w + e` by their parts `w`, all at once: with `B = G C`, the rows
    /// and columns `G` become `Cᵀ B`, so that common parts of columns are computed once.
    fn replace(&mut self, mut group: Vec<(Id, Composition<'d>)>) -> Vec<EliminatedVelocity<'d>> {
        let mut drifts: Vec<Expr<'d>> = group
            .iter()
            .map(|(id, Composition { parts, rest })| {
                self.bias_acceleration(parts, *rest) + self.free_fall(*id, parts)
            })
            .collect();
        let position: BTreeMap<Id, usize> = group
            .iter()
            .enumerate()
            .map(|(k, (id, _))| (*id, k))
            .collect();
        let TakenRows {
            inner,
            outer,
            loads,
        } = self.take_rows(&group, &position);
        if self.names_coefficients && self.is_full(&group, &inner) {
            self.name_coefficients(&mut group, &mut drifts);
        }
        for (k, mut load) in loads.into_iter().enumerate() {
            let drifting = drifts
                .iter()
                .enumerate()
                .filter(|(_, drift)| !drift.is_zero());
            load.extend(
                drifting
                    .map(|(l, drift)| -(self.with_pending_updates(&group, &inner, k, l) * *drift)),
            );
            let load = self.totals.total(load);
            for (x, c) in &group[k].1.parts {
                self.enter(*x);
                self.add_load(*x, *c * load);
            }
            for (y, value) in &outer[k] {
                self.add_load(*y, -(*value * drifts[k]));
                for (x, c) in &group[k].1.parts {
                    // ẋ ẏ occurs twice in the form if y is x itself.
                    let factor = if x == y { 2 } else { 1 };
                    self.add(*x, *y, factor * (*c * *value));
                }
            }
        }
        self.congruence(&group, &inner);
        self.replace_in_pending(&group, &drifts, &position);
        let steps = group.into_iter().zip(drifts);
        steps
            .map(
                |((of, Composition { parts, .. }), alone)| EliminatedVelocity {
                    of,
                    offset: alone,
                    parts,
                    pivot: None,
                },
            )
            .collect()
    }

    /// Takes the rows of a group of velocities out of the form.
    fn take_rows(
        &mut self,
        group: &[(Id, Composition<'d>)],
        position: &BTreeMap<Id, usize>,
    ) -> TakenRows<'d> {
        let mut inner: Vec<Vec<(usize, Expr<'d>)>> = vec![Vec::new(); group.len()];
        let mut outer: Vec<Vec<(Id, Expr<'d>)>> = vec![Vec::new(); group.len()];
        let mut loads: Vec<Vec<Expr<'d>>> = Vec::with_capacity(group.len());
        for (k, (id, _)) in group.iter().enumerate() {
            let (own, row, load) = self.take(*id);
            if !own.is_zero() {
                inner[k].push((k, own));
            }
            for (other, value) in row {
                match position.get(&other) {
                    Some(&l) => {
                        inner[k].push((l, value));
                        inner[l].push((k, value));
                    }
                    None => outer[k].push((other, value)),
                }
            }
            loads.push(load);
        }
        TakenRows {
            inner,
            outer,
            loads,
        }
    }

    /// Replaces the velocities of a group in the updates that are not yet subtracted.
    fn replace_in_pending(
        &mut self,
        group: &[(Id, Composition<'d>)],
        drifts: &[Expr<'d>],
        position: &BTreeMap<Id, usize>,
    ) {
        for update in &mut self.pending {
            // The drift loads every velocity outside the group that the update couples to it.
            let drifting = group.iter().zip(drifts).filter_map(|((id, _), drift)| {
                let value = *update.column.get(id)?;
                (!drift.is_zero()).then(|| value * *drift)
            });
            let pull = self.dag.sum(drifting.collect::<Vec<_>>());
            if !pull.is_zero() {
                for (x, value) in &update.column {
                    if !position.contains_key(x) {
                        let load = *value / update.pivot * pull;
                        self.loads.entry(*x).or_default().push(load);
                    }
                }
            }
            let mut terms: BTreeMap<Id, Vec<Expr<'d>>> = BTreeMap::new();
            for (id, composition) in group {
                if let Some(value) = update.column.remove(id) {
                    for (x, c) in &composition.parts {
                        terms.entry(*x).or_default().push(*c * value);
                    }
                }
            }
            for (x, mut terms) in terms {
                terms.extend(update.column.remove(&x));
                update.column.insert(x, self.totals.total(terms));
            }
        }
    }

    /// Whether variable entries couple the velocities of a group: then no identity of sines and
    /// cosines shortens `Cᵀ G C`.
    fn is_full(&self, group: &[(Id, Composition<'d>)], inner: &[Vec<(usize, Expr<'d>)>]) -> bool {
        let couples = |(k, l): (usize, usize)| {
            k != l && self.with_pending_updates(group, inner, k, l).stage() > Stage::PARAMETER
        };
        (0..group.len()).any(|k| (0..k).any(|l| couples((k, l))))
    }

    /// Gives names to coefficients such as `l cos φ`, so that they are computed once and stay together: if
    /// `l` were taken out of sums and `cos φ` left inside, every use would have a multiplication of its own.
    fn name_coefficients(&mut self, group: &mut [(Id, Composition<'d>)], drifts: &mut [Expr<'d>]) {
        let first = self.names.len();
        for (_, composition) in group.iter() {
            for (_, c) in &composition.parts {
                let (_, factors) = factors_of(*c);
                let stage = |(factor, _): &(Id, i32)| self.dag.expr(*factor).stage();
                let known = factors
                    .iter()
                    .filter(|f| stage(f) <= Stage::PARAMETER)
                    .count();
                let product = self.product_of(&factors);
                let is_new = self.names.iter().all(|(_, meaning)| *meaning != product);
                if known > 0 && known < factors.len() && is_new {
                    let name = self.dag.symbol("coefficient", c.stage());
                    self.names.push((name, product));
                }
            }
        }
        let names = &self.names[first..];
        for (_, composition) in group.iter_mut() {
            for (_, c) in &mut composition.parts {
                *c = self.with_names(*c, names);
            }
        }
        for drift in drifts.iter_mut() {
            *drift = self.with_names(*drift, names);
        }
    }

    /// An expression with the coefficients that are factors of its terms replaced by their names.
    fn with_names(&self, e: Expr<'d>, names: &[(Expr<'d>, Expr<'d>)]) -> Expr<'d> {
        let named = |term: Expr<'d>| {
            let (_, factors) = factors_of(term);
            let is_factor = |meaning: Expr<'d>| {
                let (_, parts) = factors_of(meaning);
                parts.iter().all(|part| factors.contains(part))
            };
            let name = names.iter().find(|(_, meaning)| is_factor(*meaning));
            name.map_or(term, |(name, meaning)| term / *meaning * *name)
        };
        self.dag.sum(terms_of(e).into_iter().map(named))
    }

    fn product_of(&self, factors: &[(Id, i32)]) -> Expr<'d> {
        let powers = factors.iter();
        self.dag
            .product(powers.map(|(factor, power)| self.dag.expr(*factor).powi(*power)))
    }

    /// An entry of G for two velocities of a group, including pending updates.
    fn with_pending_updates(
        &self,
        group: &[(Id, Composition<'d>)],
        inner: &[Vec<(usize, Expr<'d>)>],
        k: usize,
        l: usize,
    ) -> Expr<'d> {
        let made = inner[k].iter().filter(|(other, _)| *other == l);
        let late = self.pending.iter().filter_map(|update| {
            let [w_k, w_l] = [k, l].map(|k| update.column.get(&group[k].0));
            Some(-(*w_k? * *w_l? / update.pivot))
        });
        self.dag.sum(made.map(|(_, value)| *value).chain(late))
    }

    /// Adds `Cᵀ G C`.
    fn congruence(&mut self, group: &[(Id, Composition<'d>)], inner: &[Vec<(usize, Expr<'d>)>]) {
        if let Some((parts, cos, sin)) = self.as_rotation(group) {
            return self.rotate_inertia(parts, cos, sin, inner);
        }
        let mut columns: BTreeMap<Id, Vec<(usize, Expr<'d>)>> = BTreeMap::new();
        for (k, (_, composition)) in group.iter().enumerate() {
            for (part, c) in &composition.parts {
                columns.entry(*part).or_default().push((k, *c));
            }
        }
        // Sparse columns first: Cᵀ is applied to the products with dense ones.
        let weight = |column: &[(usize, Expr<'d>)]| {
            let varies = |(_, c): &&(usize, Expr<'d>)| c.stage() > Stage::CONSTANT;
            (column.iter().filter(varies).count(), column.len())
        };
        let mut columns: Vec<(Id, Vec<(usize, Expr<'d>)>)> = columns.into_iter().collect();
        columns.sort_by_key(|(id, column)| (weight(column), *id));
        for (position, (x, column)) in columns.iter().enumerate() {
            let mut products: BTreeMap<usize, Vec<Expr<'d>>> = BTreeMap::new();
            for (l, c) in column {
                for (k, value) in &inner[*l] {
                    products.entry(*k).or_default().push(*c * *value);
                }
            }
            let products: BTreeMap<usize, Expr<'d>> = products
                .into_iter()
                .map(|(k, terms)| (k, self.totals.total(terms)))
                .collect();
            for (y, sparse) in &columns[..=position] {
                for (k, c) in sparse {
                    if let Some(product) = products.get(k) {
                        self.add(*x, *y, *c * *product);
                    }
                }
            }
        }
    }

    /// Recognizes two velocities that are two others in rotated axes: `u = c w + s w'`,
    /// `u' = c w' − s w`. Returns `w` and `w'`, the cosine, and the sine with its sign.
    fn as_rotation(
        &self,
        group: &[(Id, Composition<'d>)],
    ) -> Option<([Id; 2], Expr<'d>, Expr<'d>)> {
        let [(_, first), (_, second)] = group else {
            return None;
        };
        let &[(a, c), (b, s)] = first.parts.as_slice() else {
            return None;
        };
        let &[(a_again, s_again), (b_again, c_again)] = second.parts.as_slice() else {
            return None;
        };
        if (a, b) != (a_again, b_again) {
            return None;
        }
        let is_turn = |cos: Expr<'d>, sin: Expr<'d>| match cos.node() {
            Node::Function(Function::Cos, angle) => {
                let expected = self.dag.expr(angle[0]).sin();
                sin == expected || sin == -expected
            }
            _ => false,
        };
        if c == c_again && s == -s_again && is_turn(c, s) {
            return Some(([a, b], c, s));
        }
        let swapped = s == s_again && c == -c_again && is_turn(s, c);
        swapped.then_some(([b, a], s, c))
    }

    /// Adds `Cᵀ G C` for a rotation with fewer operations: for `G = [x z; z y]` and
    /// `α = s (y − x) − 2 c z` it is `[x + s α, −c α − z; ·, y − s α]`, since `c² + s² = 1`.
    fn rotate_inertia(
        &mut self,
        [a, b]: [Id; 2],
        cos: Expr<'d>,
        sin: Expr<'d>,
        inner: &[Vec<(usize, Expr<'d>)>],
    ) {
        let entry = |k: usize, l: usize| {
            let mut row = inner[k].iter();
            row.find(|(other, _)| *other == l)
                .map_or(self.dag.zero(), |(_, value)| *value)
        };
        let [x, y, z] = [entry(0, 0), entry(1, 1), entry(0, 1)];
        let alpha = self.totals.total(vec![sin * (y - x), -2 * (cos * z)]);
        for (u, w, terms) in [
            (a, a, [x, sin * alpha]),
            (b, b, [y, -(sin * alpha)]),
            (a, b, [-z, -(cos * alpha)]),
        ] {
            for term in terms {
                self.add(u, w, term);
            }
        }
    }

    /// `β = Σ ċ w + ė`: the part of the acceleration of `Σ c w + e` besides `Σ c ẇ`.
    fn bias_acceleration(&mut self, parts: &[(Id, Expr<'d>)], rest: Expr<'d>) -> Expr<'d> {
        if !self.has_bias_accelerations {
            return self.dag.zero();
        }
        let mut terms = vec![self.rate.of(rest)];
        for (part, c) in parts {
            let w = self.dag.expr(*part);
            let rate = self.rate.of(*c);
            // Multiplied out, because the parts have terms in common, such as 2 ṡ φ̇ cos φ, of
            // which each gives one half.
            terms.extend(terms_of(rate).into_iter().map(|term| term * w));
        }
        let drift = self.dag.sum(terms);
        self.totals.record_sum(drift);
        drift
    }

    /// The part of the acceleration of `Σ c w`, besides those of its parts, that arises because all of
    /// them are measured relative to [free fall](Front::falls).
    fn free_fall(&self, id: Id, parts: &[(Id, Expr<'d>)]) -> Expr<'d> {
        let of = |id: &Id| self.free_falls.get(id).copied().unwrap_or(self.dag.zero());
        let terms = parts.iter().map(|(part, c)| *c * of(part));
        self.dag.sum(terms.chain([-of(&id)]))
    }

    /// Accounts for gravity by describing the machine in a freely falling frame.
    ///
    /// There nothing has weight, and the ground accelerates upwards; no body carries a load of
    /// gravity, and no sum of weights that the ground bears anyway is rounded.
    fn gravity(&mut self, machine: &Unprojected<'d>) -> Vec<(Expr<'d>, Expr<'d>)> {
        for pair in &machine.inertia {
            let (id, Some(g)) = (pair.u.id(), pair.free_fall) else {
                continue;
            };
            let moves = self.coordinates_of_node.contains_key(&id) && self.is_linear(id);
            if moves && !self.coordinates.contains_key(&id) {
                self.free_falls.entry(id).or_insert(g);
            }
        }
        // The velocities from which these are built fall too.
        let mut open: BTreeSet<Id> = self.free_falls.keys().copied().collect();
        while let Some(id) = open.pop_last() {
            let Some(Composition { parts, .. }) = self.composition(id) else {
                continue;
            };
            let unit = |(part, c): &&(Id, Expr<'d>)| {
                *c == self.dag.one() && !self.coordinates.contains_key(part)
            };
            let carriers: Vec<Id> = parts.iter().filter(unit).map(|(part, _)| *part).collect();
            if let [carrier] = carriers.as_slice()
                && !self.free_falls.contains_key(carrier)
            {
                self.free_falls.insert(*carrier, self.free_falls[&id]);
                open.insert(*carrier);
            }
        }
        // The weights that remain in that frame, mostly none. Bodies that share a velocity may fall
        // differently along it, so each pair has its own.
        let zero = self.dag.zero();
        let load = |pair: &InertialPair<'d>| {
            let known = self.free_falls.get(&pair.u.id()).copied().unwrap_or(zero);
            (
                pair.u,
                pair.weight * (pair.free_fall.unwrap_or(zero) - known),
            )
        };
        machine.inertia.iter().map(load).collect()
    }

    /// The parts of a velocity: velocities of coordinates, nodes of the front, and nodes from which
    /// more than one other node is built. `None` if it is not linear.
    fn composition(&self, id: Id) -> Option<Composition<'d>> {
        self.composition_within(id, usize::MAX)
    }

    /// [`composition`](Self::composition), if at most `most` nodes lie between the velocity and its parts.
    fn composition_within(&self, id: Id, mut most: usize) -> Option<Composition<'d>> {
        let mut parts: BTreeMap<Id, Vec<Expr<'d>>> = BTreeMap::new();
        let mut rest = Vec::new();
        let mut open = self.direct_parts(id)?;
        while let Some((part, c)) = open.pop() {
            if !self.coordinates_of_node.contains_key(&part) {
                rest.push(c * self.dag.expr(part));
                continue;
            }
            let is_product = matches!(self.dag.node(part), Node::Product(_));
            let is_inner =
                !self.form.contains_key(&part) && (is_product || self.parents[&part] == 1);
            if is_inner {
                most = most.checked_sub(1)?;
                open.extend(
                    self.direct_parts(part)?
                        .into_iter()
                        .map(|(inner, d)| (inner, c * d)),
                );
            } else {
                parts.entry(part).or_default().push(c);
            }
        }
        let parts = parts
            .into_iter()
            .map(|(part, c)| (part, self.dag.sum(c)))
            .collect();
        Some(Composition {
            parts,
            rest: self.dag.sum(rest),
        })
    }

    /// The direct parts of a velocity, with their coefficients.
    fn direct_parts(&self, id: Id) -> Option<Vec<(Id, Expr<'d>)>> {
        match self.dag.node(id) {
            Node::Sum(terms) => Some(
                terms
                    .iter()
                    .map(|(term, c)| (*term, self.dag.constant(c.clone())))
                    .collect(),
            ),
            Node::Product(factors) => {
                let mut moving = factors
                    .iter()
                    .filter(|(factor, _)| self.coordinates_of_node.contains_key(factor));
                let (part, power) = *moving.next()?;
                if power != 1 || moving.next().is_some() {
                    return None;
                }
                let rest = factors.iter().filter(|(factor, _)| *factor != part);
                let c = self
                    .dag
                    .product(rest.map(|(factor, power)| self.dag.expr(*factor).powi(*power)));
                Some(vec![(part, c)])
            }
            _ => None,
        }
    }

    /// Whether a node is linear in velocities.
    fn is_linear(&self, id: Id) -> bool {
        let mut open = vec![id];
        let mut seen = FxHashSet::default();
        while let Some(id) = open.pop() {
            let is_built =
                self.coordinates_of_node.contains_key(&id) && !self.coordinates.contains_key(&id);
            if is_built && seen.insert(id) {
                match self.direct_parts(id) {
                    Some(parts) => open.extend(parts.into_iter().map(|(part, _)| part)),
                    None => return false,
                }
            }
        }
        true
    }
}

/// Sums are multiplied out up to this many terms; cancellations occur in short sums.
const LONGEST_EXPANSION: usize = 24;

/// The sums that are multiplied out.
#[derive(Clone, Copy)]
enum Expansion {
    /// Earlier totals that are factors of products.
    TotalsInProducts,
    /// Earlier totals that are factors of products, and those in the resulting products.
    Deep,
    /// Earlier totals.
    Totals,
    /// All sums.
    Sums,
}

impl Expansion {
    const ALL: [Expansion; 4] = [
        Expansion::TotalsInProducts,
        Expansion::Deep,
        Expansion::Totals,
        Expansion::Sums,
    ];
}

/// Adds up the remaining entries and loads.
struct Totals<'d> {
    dag: &'d Dag,
    /// The sums made here.
    own_sums: FxHashSet<Id>,
    /// Whether any are multiplied out.
    expands: bool,
}

impl<'d> Totals<'d> {
    /// The sum, with sums among its factors multiplied out if that makes it shorter: terms of
    /// several eliminations may cancel, but not while some of them are inside a product.
    fn total(&mut self, terms: Vec<Expr<'d>>) -> Expr<'d> {
        let mut shortest = self.dag.sum(terms.iter().copied());
        if !self.expands {
            return shortest;
        }
        if terms.len() > 1 {
            for reach in Expansion::ALL {
                if let Some(candidate) = self.partly_expanded(&terms, reach)
                    && work(candidate) < work(shortest)
                {
                    shortest = candidate;
                }
            }
        }
        self.without_content(shortest)
    }

    /// The sum with those terms multiplied out that can cancel something; `None` if there are none,
    /// or if it is long.
    fn partly_expanded(&self, terms: &[Expr<'d>], reach: Expansion) -> Option<Expr<'d>> {
        let mut parts: Vec<Vec<Expr<'d>>> = Vec::with_capacity(terms.len());
        let mut len = 0;
        for &term in terms {
            parts.push(self.expanded(term, reach)?);
            len += parts.last().map_or(0, Vec::len);
        }
        let sum = |parts: &[Vec<Expr<'d>>]| self.dag.sum(parts.iter().flatten().copied());
        let mut shortest = sum(&parts);
        if len > LONGEST_EXPANSION || len == terms.len() || terms_of(shortest).len() == len {
            return None;
        }
        for (position, &term) in terms.iter().enumerate() {
            let expanded = std::mem::replace(&mut parts[position], vec![term]);
            let candidate = sum(&parts);
            if work(candidate) <= work(shortest) {
                shortest = candidate;
            } else {
                parts[position] = expanded;
            }
        }
        Some(shortest)
    }

    /// The term with sums among its factors multiplied out, unless the result is long.
    fn expanded(&self, term: Expr<'d>, reach: Expansion) -> Option<Vec<Expr<'d>>> {
        let mut done = Vec::new();
        let mut open = vec![term];
        while let Some(term) = open.pop() {
            let (coefficient, factors) = factors_of(term);
            let alone = factors.len() == 1;
            let may_expand = |&(factor, power): &(Id, i32)| {
                let total = power == 1 && self.own_sums.contains(&factor);
                match reach {
                    Expansion::TotalsInProducts | Expansion::Deep => total && !alone,
                    Expansion::Totals => total,
                    Expansion::Sums => {
                        let is_sum = matches!(self.dag.node(factor), Node::Sum(_));
                        let varies = self.dag.expr(factor).stage() > Stage::PARAMETER;
                        (1..=2).contains(&power) && is_sum && varies
                    }
                }
            };
            let (sums, rest): (Vec<_>, Vec<_>) = factors.into_iter().partition(may_expand);
            let rest = rest
                .into_iter()
                .map(|(factor, power)| self.dag.expr(factor).powi(power));
            let mut products = vec![self.dag.product(rest) * coefficient];
            for (sum, power) in &sums {
                let right = terms_of(self.dag.expr(*sum));
                for _ in 0..*power {
                    let all = products
                        .iter()
                        .flat_map(|&x| right.iter().map(move |&y| x * y));
                    products = all.collect();
                    if done.len() + open.len() + products.len() > LONGEST_EXPANSION {
                        return None;
                    }
                }
            }
            let again = matches!(reach, Expansion::Deep) && !sums.is_empty();
            if again {
                open.append(&mut products)
            } else {
                done.append(&mut products)
            }
        }
        Some(done)
    }

    /// Takes the common factors of the terms out of a sum.
    fn without_content(&mut self, total: Expr<'d>) -> Expr<'d> {
        let terms = terms_of(total);
        let mut common: BTreeMap<Id, i32> = factors_of(terms[0]).1.into_iter().collect();
        for &term in &terms[1..] {
            let powers: BTreeMap<Id, i32> = factors_of(term).1.into_iter().collect();
            common.retain(|id, power| {
                let other = powers.get(id).copied().unwrap_or(0);
                *power = if *power > 0 {
                    other.clamp(0, *power)
                } else {
                    other.clamp(*power, 0)
                };
                *power != 0
            });
        }
        if terms.len() < 2 || common.is_empty() {
            self.record_sum(total);
            return total;
        }
        let common = self.dag.product(
            common
                .into_iter()
                .map(|(id, power)| self.dag.expr(id).powi(power)),
        );
        let rest = self.dag.sum(terms.into_iter().map(|term| term / common));
        self.record_sum(rest);
        common * rest
    }

    /// Records that a sum may be multiplied out again.
    fn record_sum(&mut self, sum: Expr<'d>) {
        if matches!(sum.node(), Node::Sum(terms) if terms.len() > 1) {
            self.own_sums.insert(sum.id());
        }
    }
}

/// The numerical coefficient and the factors of an expression.
fn factors_of(e: Expr<'_>) -> (Rational, Vec<(Id, i32)>) {
    match e.node() {
        Node::Constant(value) => (value, Vec::new()),
        Node::Product(factors) => (Rational::ONE, factors.to_vec()),
        Node::Sum(terms) if terms.len() == 1 => {
            let (_, factors) = factors_of(e.dag().expr(terms[0].0));
            (terms[0].1.clone(), factors)
        }
        _ => (Rational::ONE, vec![(e.id(), 1)]),
    }
}

/// The terms of a sum or of a multiple of a sum; any other expression is its only term.
fn terms_of(e: Expr<'_>) -> Vec<Expr<'_>> {
    let dag = e.dag();
    match e.node() {
        Node::Sum(terms) if terms.len() == 1 => {
            let inner = terms_of(dag.expr(terms[0].0));
            inner
                .into_iter()
                .map(|term| term * terms[0].1.clone())
                .collect()
        }
        Node::Sum(terms) => terms
            .iter()
            .map(|(id, c)| dag.expr(*id) * c.clone())
            .collect(),
        _ => vec![e],
    }
}

/// The number of multiplications and additions at the top of an expression, not counting those of its parts.
fn work(e: Expr<'_>) -> usize {
    if e.stage() <= Stage::PARAMETER {
        return 0;
    }
    match e.node() {
        Node::Sum(terms) => {
            let each = |(id, c): &(Id, Rational)| {
                let scaled = !c.is_one() && *c != Rational::MINUS_ONE;
                work(e.dag().expr(*id)) + 1 + usize::from(scaled)
            };
            terms.iter().map(each).sum::<usize>() - 1
        }
        Node::Product(factors) => {
            let (known, rest): (Vec<_>, Vec<_>) = factors
                .iter()
                .partition(|(id, _)| e.dag().expr(*id).stage() <= Stage::PARAMETER);
            rest.iter()
                .map(|(_, power)| power.unsigned_abs() as usize)
                .sum::<usize>()
                + usize::from(!known.is_empty())
                - 1
        }
        _ => 0,
    }
}
