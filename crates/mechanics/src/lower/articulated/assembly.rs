//! The initial front: the inertias and loads on velocities, and what each velocity is built from.

use std::collections::{BTreeMap, BTreeSet};

use super::totals::{Totals, terms_of};
use super::{Composition, EliminatedVelocity, Front, LONGEST_ARM, Order, Substitute};
use crate::lower::bars;
use crate::lower::bars::Arm;
use crate::{InertialPair, Unprojected};
use lagrangian_spec::model::Model;
use lagrangian_symbolic::sorting::sort_by_key;
use lagrangian_symbolic::{Expr, Id, Node, Rational, Stage, Symbol, Tangent, reachable, reverse};
use rustc_hash::{FxHashMap, FxHashSet};

impl<'d> Front<'d> {
    /// The initial front. With `with_substitutes`, velocities may take the places of coordinates' velocities.
    pub(super) fn of(
        model: &Model<'d>,
        machine: &Unprojected<'d>,
        with_substitutes: bool,
    ) -> Front<'d> {
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
    pub(super) fn find_substitutes(&mut self, roots: &[Expr<'d>], machine: &Unprojected<'d>) {
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
    pub(super) fn roots(&self, model: &Model<'d>, machine: &Unprojected<'d>) -> Vec<Expr<'d>> {
        let inertial = machine.inertia.iter().flat_map(|pair| [pair.u, pair.w]);
        let loaded = machine.loads.iter().map(|(u, _)| *u);
        let velocities = model.coordinates.iter().map(|c| c.v);
        inertial.chain(loaded).chain(velocities).collect()
    }

    /// The velocity components of points on bars: the sum of a velocity and one rotation, at a
    /// distance across the bar.
    pub(super) fn arms(&self) -> BTreeMap<Id, Arm<'d>> {
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
            sort_by_key(&mut parts, |(_, c)| c.stage() > Stage::PARAMETER);
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
    pub(super) fn discard_linear(&mut self) {
        self.coordinates_of_node.clear();
        self.parents.clear();
    }

    /// The velocities whose places others took, in terms of these: `v = ±(u − Σ c·part − rest)`.
    pub(super) fn replaced_velocities(&mut self) -> Vec<EliminatedVelocity<'d>> {
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
    pub(super) fn find_linear(&mut self, roots: &[Expr<'d>]) {
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
    pub(super) fn add_inertia(&mut self, u: Expr<'d>, w: Expr<'d>, weight: Expr<'d>) {
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
    pub(super) fn add_loads(&mut self, loads: &[(Expr<'d>, Expr<'d>)], model: &Model<'d>) {
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

    pub(super) fn enter(&mut self, id: Id) {
        if self.form.contains_key(&id) {
            return;
        }
        self.form.insert(id, BTreeMap::new());
        self.count_uses(id, |uses| *uses += 1);
    }

    /// `β = Σ ċ w + ė`: the part of the acceleration of `Σ c w + e` besides `Σ c ẇ`.
    pub(super) fn bias_acceleration(
        &mut self,
        parts: &[(Id, Expr<'d>)],
        rest: Expr<'d>,
    ) -> Expr<'d> {
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
    pub(super) fn free_fall(&self, id: Id, parts: &[(Id, Expr<'d>)]) -> Expr<'d> {
        let of = |id: &Id| self.free_falls.get(id).copied().unwrap_or(self.dag.zero());
        let terms = parts.iter().map(|(part, c)| *c * of(part));
        self.dag.sum(terms.chain([-of(&id)]))
    }

    /// Accounts for gravity by describing the machine in a freely falling frame.
    ///
    /// There nothing has weight, and the ground accelerates upwards; no body carries a load of
    /// gravity, and no sum of weights that the ground bears anyway is rounded.
    pub(super) fn gravity(&mut self, machine: &Unprojected<'d>) -> Vec<(Expr<'d>, Expr<'d>)> {
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
    pub(super) fn composition(&self, id: Id) -> Option<Composition<'d>> {
        self.composition_within(id, usize::MAX)
    }

    /// [`composition`](Self::composition), if at most `most` nodes lie between the velocity and its parts.
    pub(super) fn composition_within(&self, id: Id, mut most: usize) -> Option<Composition<'d>> {
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
    pub(super) fn direct_parts(&self, id: Id) -> Option<Vec<(Id, Expr<'d>)>> {
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
    pub(super) fn is_linear(&self, id: Id) -> bool {
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
