//! Elimination and replacement of the velocities of a front.

use std::collections::{BTreeMap, BTreeSet};

use super::totals::{factors_of, terms_of};
use super::{Composition, EliminatedVelocity, Front, Order, TakenRows, Update};
use lagrangian_symbolic::sorting::sort_by_key;
use lagrangian_symbolic::{Expr, Function, Id, Node, Stage};
use rustc_hash::FxHashSet;

impl<'d> Front<'d> {
    /// The next step; the inner `None` means that the front is empty.
    pub(super) fn next(&mut self) -> Option<Option<Vec<EliminatedVelocity<'d>>>> {
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
    pub(super) fn next_to_replace(&self) -> Option<Id> {
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

    pub(super) fn eliminate(&mut self, id: Id) -> Option<EliminatedVelocity<'d>> {
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
    pub(super) fn apply_update(&mut self, update: &Update<'d>) {
        for (position, (x, value)) in update.column.iter().enumerate() {
            let ratio = *value / update.pivot;
            for (y, other) in update.column.iter().take(position + 1) {
                self.add(*x, *y, -(ratio * *other));
            }
        }
    }

    /// Makes all pending updates that involve a row taken from the form; `own` and `row` receive its share.
    pub(super) fn apply_pending_updates(
        &mut self,
        id: Id,
        own: &mut Expr<'d>,
        row: &mut Vec<(Id, Expr<'d>)>,
    ) {
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
    pub(super) fn group(&self, first: Id) -> Option<Vec<(Id, Composition<'d>)>> {
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
    pub(super) fn is_built_from(&self, id: Id, part: Id) -> bool {
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
    pub(super) fn replace(
        &mut self,
        mut group: Vec<(Id, Composition<'d>)>,
    ) -> Vec<EliminatedVelocity<'d>> {
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
    pub(super) fn take_rows(
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
    pub(super) fn replace_in_pending(
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
    pub(super) fn is_full(
        &self,
        group: &[(Id, Composition<'d>)],
        inner: &[Vec<(usize, Expr<'d>)>],
    ) -> bool {
        let couples = |(k, l): (usize, usize)| {
            k != l && self.with_pending_updates(group, inner, k, l).stage() > Stage::PARAMETER
        };
        (0..group.len()).any(|k| (0..k).any(|l| couples((k, l))))
    }

    /// Gives names to coefficients such as `l cos φ`, so that they are computed once and stay together: if
    /// `l` were taken out of sums and `cos φ` left inside, every use would have a multiplication of its own.
    pub(super) fn name_coefficients(
        &mut self,
        group: &mut [(Id, Composition<'d>)],
        drifts: &mut [Expr<'d>],
    ) {
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
    pub(super) fn with_names(&self, e: Expr<'d>, names: &[(Expr<'d>, Expr<'d>)]) -> Expr<'d> {
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

    pub(super) fn product_of(&self, factors: &[(Id, i32)]) -> Expr<'d> {
        let powers = factors.iter();
        self.dag
            .product(powers.map(|(factor, power)| self.dag.expr(*factor).powi(*power)))
    }

    /// An entry of G for two velocities of a group, including pending updates.
    pub(super) fn with_pending_updates(
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
    pub(super) fn congruence(
        &mut self,
        group: &[(Id, Composition<'d>)],
        inner: &[Vec<(usize, Expr<'d>)>],
    ) {
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
        sort_by_key(&mut columns, |(id, column)| (weight(column), *id));
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
    pub(super) fn as_rotation(
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
    pub(super) fn rotate_inertia(
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
}
