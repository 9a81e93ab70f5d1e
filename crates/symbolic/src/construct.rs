//! Constructors that build nodes in normal form (see [`crate::dag`]).

mod functions;

use std::collections::{BTreeMap, BTreeSet};

use crate::arena::{Arena, PARAMETER_FACTOR, SQUARED_SINE};
use crate::node::{Factor, Function, Id, Node, Term};
use crate::rational::Rational;

/// Products of more factors than this are built as products of products, so that a sequence of n
/// multiplications takes memory proportional to n and not to n².
const LONGEST_PRODUCT: usize = 64;

/// A step without a value, or without one within the limits on constants.
struct Undefined;

impl Arena {
    /// `Σ coefficient·term`.
    pub(crate) fn sum(&mut self, terms: &[Term]) -> Id {
        let mut work = core::mem::take(&mut self.spare_terms);
        work.extend_from_slice(terms);
        let sum = self.try_sum(&mut work).unwrap_or(Arena::UNDEFINED);
        work.clear();
        self.spare_terms = work;
        sum
    }

    /// The sum; the vector is used as a workspace.
    fn try_sum(&mut self, terms: &mut Vec<Term>) -> Result<Id, Undefined> {
        for term in terms.iter_mut() {
            // Taken out of its one-term sum, the multiple becomes an ordinary term.
            match self.node(term.0) {
                Node::Sum(inner) if inner.len() == 1 => {
                    let (id, coefficient) = &inner[0];
                    *term = (*id, coefficient.checked_mul(&term.1).ok_or(Undefined)?);
                }
                Node::Constant(value) => {
                    *term = (Arena::ONE, value.checked_mul(&term.1).ok_or(Undefined)?);
                }
                _ if term.0 == Arena::UNDEFINED => return Err(Undefined),
                _ => {}
            }
        }
        merge_terms(terms)?;
        loop {
            // The results of the rules below may contain multiples of π.
            self.lift_turns(terms)?;
            let before = terms.len();
            if before > 1 {
                self.join_squares(terms)?;
                self.collect_parameters(terms)?;
            }
            if terms.len() == before {
                break;
            }
        }
        Ok(match terms.as_slice() {
            [] => Arena::ZERO,
            [(Arena::ONE, value)] => self.constant(value.clone()),
            [(id, coefficient)] if coefficient.is_one() => *id,
            _ => self.sum_node(terms),
        })
    }

    /// Moves multiples of π out of the sums among the terms: the angles of a hanging chain are
    /// `q₁ − π/2`, `q₂ + (q₁ − π/2)`, …, and their sines should be those of `q₁`, `q₂ + q₁`, …. The
    /// terms are sorted afterwards.
    fn lift_turns(&mut self, terms: &mut Vec<Term>) -> Result<(), Undefined> {
        if let [(_, coefficient)] = terms.as_slice()
            && coefficient.is_one()
        {
            return Ok(());
        }
        for position in 0..terms.len() {
            // π is among the first two nodes of any sum that contains it; the other one is 1.
            let (id, coefficient) = &terms[position];
            let Node::Sum(inner) = self.node(*id) else {
                continue;
            };
            let Some(place) = inner.iter().take(2).position(|term| term.0 == Arena::PI) else {
                continue;
            };
            let turns = inner[place].1.checked_mul(coefficient).ok_or(Undefined)?;
            let mut rest = inner.to_vec();
            rest.remove(place);
            let rest = match rest.as_slice() {
                [(id, scale)] => (*id, scale.checked_mul(coefficient).ok_or(Undefined)?),
                _ => (self.sum_node(&rest), coefficient.clone()),
            };
            terms[position] = rest;
            terms.push((Arena::PI, turns));
        }
        merge_terms(terms)
    }

    /// `A·sin²x + A·cos²x = A`, for sorted terms; they are sorted afterwards.
    ///
    /// The pair with the first sine is joined, repeatedly, until there is none. A term is examined
    /// once, and again only when a new possible partner appears: the work grows like n log n with the
    /// number n of terms.
    fn join_squares(&mut self, terms: &mut Vec<Term>) -> Result<(), Undefined> {
        let is_sine = |(id, _): &&Term| self.has_flag(*id, SQUARED_SINE);
        let mut open: BTreeSet<Id> = terms.iter().filter(is_sine).map(|term| term.0).collect();
        // Usually there is nothing to join, and nothing needs to be moved.
        let partner_is_there = |id: &Id| {
            let of = |id: &Id| terms.binary_search_by_key(id, |term| term.0);
            let own = of(id).map(|place| &terms[place].1);
            let mut partners = self.square_partners(*id, [Function::Sin, Function::Cos]);
            partners.any(|(partner, _)| own == of(&partner).map(|place| &terms[place].1))
        };
        if !open.iter().any(partner_is_there) {
            return Ok(());
        }
        let mut left: BTreeMap<Id, Rational> = terms.drain(..).collect();
        let joined = self.join_open_squares(&mut open, &mut left);
        terms.extend(left);
        joined
    }

    /// Joins squares among terms by their nodes; those of `open` are still to be examined.
    fn join_open_squares(
        &mut self,
        open: &mut BTreeSet<Id>,
        left: &mut BTreeMap<Id, Rational>,
    ) -> Result<(), Undefined> {
        while let Some(id) = open.pop_first() {
            #[cfg(test)]
            tests::LOOKED_AT.set(tests::LOOKED_AT.get() + 1);
            let Some(coefficient) = left.get(&id).cloned() else {
                continue;
            };
            let mut partners = self.square_partners(id, [Function::Sin, Function::Cos]);
            let joined = partners.find(|(partner, _)| left.get(partner) == Some(&coefficient));
            drop(partners);
            let Some((partner, mut factors)) = joined else {
                continue;
            };
            left.remove(&id);
            left.remove(&partner);
            let (inner, result) = self.try_product(&mut factors)?;
            let coefficient = inner.checked_mul(&coefficient).ok_or(Undefined)?;
            let (result, coefficient) = match self.node(result) {
                Node::Sum(inner) if inner.len() == 1 => {
                    let (id, scale) = &inner[0];
                    (*id, scale.checked_mul(&coefficient).ok_or(Undefined)?)
                }
                _ => (result, coefficient),
            };
            let sum = match left.get(&result) {
                Some(known) => known.checked_add(&coefficient).ok_or(Undefined)?,
                None => coefficient,
            };
            if sum.is_zero() {
                left.remove(&result);
                continue;
            }
            left.insert(result, sum);
            if self.has_flag(result, SQUARED_SINE) {
                open.insert(result);
            }
            // It may be the square of a cosine for which others wait.
            let sines = self.square_partners(result, [Function::Cos, Function::Sin]);
            open.extend(
                sines
                    .map(|(sine, _)| sine)
                    .filter(|sine| left.contains_key(sine)),
            );
        }
        Ok(())
    }

    /// For a product `A·sin²x`, the node `A·cos²x`, if it exists, and the factors of `A`, for every
    /// such x; or with sine and cosine exchanged.
    fn square_partners(
        &self,
        id: Id,
        [own, other]: [Function; 2],
    ) -> impl Iterator<Item = (Id, Vec<Factor>)> {
        let factors: &[Factor] = match self.node(id) {
            Node::Product(factors) => factors,
            _ => &[],
        };
        factors
            .iter()
            .filter(|(_, power)| *power >= 2)
            .filter_map(move |&(square, _)| {
                let angle = match self.node(square) {
                    Node::Function(function, angle) if *function == own => angle[0],
                    _ => return None,
                };
                let partner = self.find_function(other, angle)?;
                let with_powers = |changes: &[Factor]| {
                    let mut changed = factors.to_vec();
                    changed.extend_from_slice(changes);
                    merge_factors(&mut changed).ok().map(|()| changed)
                };
                let node = self.find_product(&with_powers(&[(square, -2), (partner, 2)])?)?;
                Some((node, with_powers(&[(square, -2)])?))
            })
    }

    /// `p₁·X + p₂·X = (p₁ + p₂)·X` for parameters p, for sorted terms; they are sorted afterwards.
    fn collect_parameters(&mut self, terms: &mut Vec<Term>) -> Result<(), Undefined> {
        if !terms
            .iter()
            .any(|&(id, _)| self.has_flag(id, PARAMETER_FACTOR))
        {
            return Ok(());
        }
        // Sorting by the hash of X groups the terms of the same X.
        let mut keys: Vec<(u32, Id)> = terms
            .iter()
            .filter(|(id, _)| !self.is_parameter(*id))
            .map(|(id, _)| (self.rest_hash(*id), *id))
            .collect();
        keys.sort_unstable();
        let (mut collected, mut used) = (Vec::new(), Vec::new());
        for run in keys.chunk_by(|a, b| a.0 == b.0).filter(|run| run.len() > 1) {
            let mut left: Vec<Id> = run.iter().map(|key| key.1).collect();
            // A second pass is needed only if two different X share a hash.
            while let [first, ..] = *left.as_slice() {
                let (group, others) = left.iter().partition(|&&id| self.same_rest(first, id));
                left = others;
                let group: Vec<Id> = group;
                if group.len() > 1 {
                    collected.push(self.collect_group(terms, &group)?);
                    used.extend(group);
                }
            }
        }
        if !collected.is_empty() {
            used.sort_unstable();
            terms.retain(|(id, _)| used.binary_search(id).is_err());
            terms.append(&mut collected);
            merge_terms(terms)?;
        }
        Ok(())
    }

    /// `(Σ cᵢ pᵢ)·X` for terms `cᵢ·pᵢ·X` of one X; common factors of the cᵢ and of the pᵢ stay outside.
    fn collect_group(&mut self, terms: &[Term], group: &[Id]) -> Result<Term, Undefined> {
        let mut parts: Vec<(Vec<Factor>, Rational)> = Vec::with_capacity(group.len());
        let mut factors = Vec::new();
        for &id in group {
            let found = terms.binary_search_by_key(&id, |term| term.0);
            let coefficient = found.map_or(Rational::ZERO, |position| terms[position].1.clone());
            let mut parameters = Vec::new();
            factors.clear();
            for &(factor, power) in self.factors(&[(id, 1)]) {
                let list = if self.is_parameter(factor) {
                    &mut parameters
                } else {
                    &mut factors
                };
                list.push((factor, power));
            }
            parts.push((parameters, coefficient));
        }
        let mut common = parts[0].0.clone();
        let mut content = parts[0].1.clone();
        for (parameters, coefficient) in &parts[1..] {
            common = common_factors(&common, parameters);
            content = content.gcd(coefficient);
        }
        let mut sum = Vec::with_capacity(parts.len());
        for (mut parameters, coefficient) in parts {
            parameters.extend(common.iter().map(|&(factor, power)| (factor, -power)));
            let (scale, parameter) = self.try_product(&mut parameters)?;
            let share = coefficient.checked_div(&content).ok_or(Undefined)?;
            sum.push((parameter, scale.checked_mul(&share).ok_or(Undefined)?));
        }
        factors.push((self.try_sum(&mut sum)?, 1));
        factors.append(&mut common);
        let (scale, id) = self.try_product(&mut factors)?;
        Ok((id, scale.checked_mul(&content).ok_or(Undefined)?))
    }

    /// Whether two nodes are products of parameters and the same rest.
    fn same_rest(&self, a: Id, b: Id) -> bool {
        let (a, b) = (&[(a, 1)], &[(b, 1)]);
        let rest = |&&(factor, _): &&Factor| !self.is_parameter(factor);
        self.factors(a)
            .iter()
            .filter(rest)
            .eq(self.factors(b).iter().filter(rest))
    }

    /// The factors of a product; for any other node the node itself, which the caller passes as `alone`.
    fn factors<'a>(&'a self, alone: &'a [Factor; 1]) -> &'a [Factor] {
        match self.node(alone[0].0) {
            Node::Product(factors) => factors,
            _ => alone,
        }
    }

    /// `Π factor^power`.
    pub(crate) fn product(&mut self, factors: &[Factor]) -> Id {
        let (coefficient, id) = self.product_parts(factors);
        self.scaled(coefficient, id)
    }

    /// `Π factor^power` as a coefficient and a node.
    pub(crate) fn product_parts(&mut self, factors: &[Factor]) -> (Rational, Id) {
        let mut work = core::mem::take(&mut self.spare_factors);
        work.extend_from_slice(factors);
        let product = self.try_product(&mut work);
        work.clear();
        self.spare_factors = work;
        product.unwrap_or((Rational::ONE, Arena::UNDEFINED))
    }

    /// The product as a coefficient and a node; the vector is used as a workspace.
    fn try_product(&mut self, factors: &mut Vec<Factor>) -> Result<(Rational, Id), Undefined> {
        let mut coefficient = Rational::ONE;
        loop {
            self.split_factors(factors, &mut coefficient)?;
            merge_factors(factors)?;
            if !self.reduce_roots(factors) && !self.cancel_roots(factors, &mut coefficient) {
                break;
            }
        }
        if coefficient.is_zero() {
            return Ok((Rational::ZERO, Arena::ONE));
        }
        while factors.len() > LONGEST_PRODUCT {
            let parts = factors.chunks(LONGEST_PRODUCT).map(<[Factor]>::to_vec);
            *factors = parts
                .collect::<Vec<_>>()
                .iter()
                .map(|part| (self.product_node(part), 1))
                .collect();
        }
        let id = match factors.as_slice() {
            [] => Arena::ONE,
            [(id, 1)] => *id,
            _ => self.product_node(factors),
        };
        Ok((coefficient, id))
    }

    /// Splits constants, multiples and products among the factors.
    fn split_factors(
        &mut self,
        factors: &mut Vec<Factor>,
        coefficient: &mut Rational,
    ) -> Result<(), Undefined> {
        let mut position = 0;
        while let Some(&(id, power)) = factors.get(position) {
            if id == Arena::UNDEFINED {
                return Err(Undefined);
            }
            let mut multiply = |value: &Rational| {
                let value = value.pow(power).ok_or(Undefined)?;
                *coefficient = coefficient.checked_mul(&value).ok_or(Undefined)?;
                Ok(())
            };
            match self.node(id) {
                _ if power == 0 => {
                    factors.swap_remove(position);
                }
                Node::Constant(value) => {
                    multiply(value)?;
                    factors.swap_remove(position);
                }
                Node::Sum(terms) if terms.len() == 1 => {
                    multiply(&terms[0].1)?;
                    // The multiplied node may be a product, so this position is examined again.
                    factors[position] = (terms[0].0, power);
                }
                Node::Product(inner) if inner.len() < LONGEST_PRODUCT => {
                    factors.swap_remove(position);
                    for &(factor, inner_power) in inner.iter() {
                        factors.push((factor, inner_power.checked_mul(power).ok_or(Undefined)?));
                    }
                }
                _ => position += 1,
            }
        }
        Ok(())
    }

    /// `sqrt(x)² = x` and `|x|² = x²`, in higher powers too; returns whether anything changed.
    fn reduce_roots(&mut self, factors: &mut Vec<Factor>) -> bool {
        let mut changed = false;
        for position in 0..factors.len() {
            let (id, power) = factors[position];
            if (-1..=1).contains(&power) {
                continue;
            }
            if let Node::Function(function @ (Function::Sqrt | Function::Abs), arguments) =
                self.node(id)
            {
                let even = power - power % 2;
                let inner = if *function == Function::Sqrt {
                    even / 2
                } else {
                    even
                };
                factors[position] = (id, power % 2);
                factors.push((arguments[0], inner));
                changed = true;
            }
        }
        changed
    }

    /// `x/sqrt(x) = sqrt(x)`, in higher powers of `x` too; returns whether anything changed.
    ///
    /// At `x = 0` the left side has no value and the right side is its limit: so the derivative of
    /// `x·sqrt(x)`, which the rules give as `sqrt(x) + x/(2 sqrt(x))`, exists at 0.
    fn cancel_roots(&self, factors: &mut Vec<Factor>, coefficient: &mut Rational) -> bool {
        for position in 0..factors.len() {
            let (root, -1) = factors[position] else {
                continue;
            };
            let Node::Function(Function::Sqrt, arguments) = self.node(root) else {
                continue;
            };
            let (scale, inner) = match self.node(arguments[0]) {
                Node::Constant(_) => continue,
                Node::Sum(terms) if terms.len() == 1 => (terms[0].1.clone(), terms[0].0),
                _ => (Rational::ONE, arguments[0]),
            };
            let Some(scale) = scale.recip() else { continue };
            let alone = [(inner, 1)];
            let parts = self.factors(&alone);
            let has = |&(part, power): &Factor| {
                let found = factors.binary_search_by_key(&part, |factor| factor.0);
                let found = found.map_or(0, |place| factors[place].1);
                found.signum() == power.signum() && found.abs() >= power.abs()
            };
            let Some(product) = coefficient.checked_mul(&scale) else {
                continue;
            };
            if parts.iter().all(has) {
                let taken = parts.iter().map(|&(part, power)| (part, -power));
                factors.extend(taken);
                factors[position].1 = 1;
                *coefficient = product;
                return true;
            }
        }
        false
    }

    /// `coefficient·node`.
    pub(crate) fn scaled(&mut self, coefficient: Rational, id: Id) -> Id {
        if coefficient.is_one() || id == Arena::UNDEFINED {
            return id;
        }
        if coefficient.is_zero() {
            return Arena::ZERO;
        }
        self.sum(&[(id, coefficient)])
    }
}

/// The common factors of two products, by id; for powers of the same sign the smaller one.
fn common_factors(a: &[Factor], b: &[Factor]) -> Vec<Factor> {
    let smaller = |&(factor, n): &Factor| {
        let position = b.binary_search_by_key(&factor, |other| other.0).ok()?;
        let m = b[position].1;
        (n.signum() == m.signum()).then_some((factor, if n > 0 { n.min(m) } else { n.max(m) }))
    };
    a.iter().filter_map(smaller).collect()
}

/// Sorts terms, merges equal ones, drops zeros.
fn merge_terms(terms: &mut Vec<Term>) -> Result<(), Undefined> {
    terms.sort_unstable_by_key(|term| term.0);
    let mut kept = 0;
    for next in 0..terms.len() {
        if kept > 0 && terms[kept - 1].0 == terms[next].0 {
            terms[kept - 1].1 = terms[kept - 1]
                .1
                .checked_add(&terms[next].1)
                .ok_or(Undefined)?;
        } else {
            terms.swap(kept, next);
            kept += 1;
        }
    }
    terms.truncate(kept);
    terms.retain(|term| !term.1.is_zero());
    Ok(())
}

/// Sorts factors, merges equal ones, drops powers of 0.
fn merge_factors(factors: &mut Vec<Factor>) -> Result<(), Undefined> {
    factors.sort_unstable_by_key(|factor| factor.0);
    let mut kept = 0;
    for next in 0..factors.len() {
        if kept > 0 && factors[kept - 1].0 == factors[next].0 {
            factors[kept - 1].1 = factors[kept - 1]
                .1
                .checked_add(factors[next].1)
                .ok_or(Undefined)?;
        } else {
            factors.swap(kept, next);
            kept += 1;
        }
    }
    factors.truncate(kept);
    factors.retain(|factor| factor.1 != 0);
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use crate::{Dag, Expr, Stage};

    thread_local! {
        /// The number of terms that were examined for a square to join with.
        pub(super) static LOOKED_AT: Cell<usize> = const { Cell::new(0) };
    }

    /// `Σ aₖ sin²xₖ + aₖ cos²xₖ`, with the terms in an order that differs from that of their construction.
    fn sum_of_squares(dag: &Dag, pairs: usize) -> (Expr<'_>, Expr<'_>) {
        let symbol = |name: &str, k: usize, stage| dag.symbol(&format!("{name}{k}"), stage);
        let mut terms = Vec::new();
        let mut sum = Vec::new();
        for k in 0..pairs {
            let (a, x) = (symbol("a", k, Stage(3)), symbol("x", k, Stage(3)));
            terms.push((7 * k % pairs, a * x.sin().square()));
            terms.push((5 * k % pairs, a * x.cos().square()));
            sum.push(a);
        }
        terms.sort_by_key(|(place, _)| *place);
        LOOKED_AT.set(0);
        (
            dag.sum(terms.into_iter().map(|(_, term)| term)),
            dag.sum(sum),
        )
    }

    #[test]
    fn each_square_of_a_sine_is_looked_at_once() {
        for pairs in [50, 400] {
            let dag = Dag::new();
            let (joined, expected) = sum_of_squares(&dag, pairs);
            assert_eq!(joined, expected);
            // Each sum is processed until nothing changes: twice.
            assert!(
                LOOKED_AT.get() <= 2 * pairs,
                "{} of {pairs}",
                LOOKED_AT.get()
            );
        }
    }

    #[test]
    fn squares_that_only_joining_makes_are_joined_too() {
        // sin²a sin²b + sin²a cos²b + cos²a sin²b + cos²a cos²b, and so on for more angles.
        let dag = Dag::new();
        let angles: Vec<Expr<'_>> = (0..6)
            .map(|k| dag.symbol(&format!("x{k}"), Stage(3)))
            .collect();
        let m = dag.symbol("m", Stage(3));
        let mut terms = vec![m];
        for x in &angles {
            let with = |f: Expr<'_>| -> Vec<Expr<'_>> {
                terms
                    .iter()
                    .map(|&term| dag.expr(f.id()) * dag.expr(term.id()))
                    .collect()
            };
            terms = [with(x.sin().square()), with(x.cos().square())].concat();
        }
        LOOKED_AT.set(0);
        assert_eq!(dag.sum(terms.iter().copied()), m);
        // 64 terms; each join removes one.
        assert!(LOOKED_AT.get() <= 4 * terms.len(), "{}", LOOKED_AT.get());
    }
}
