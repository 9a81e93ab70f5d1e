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

mod assembly;
mod elimination;
mod totals;

use std::collections::{BTreeMap, BTreeSet};

use lagrangian_symbolic::{Dag, Expr, Id, Node, Rational, Stage, Tangent};
use rustc_hash::FxHashMap;

use crate::Unprojected;
use lagrangian_program::EliminationStep;
use lagrangian_spec::identity;
use lagrangian_spec::model::Model;
use totals::Totals;

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
