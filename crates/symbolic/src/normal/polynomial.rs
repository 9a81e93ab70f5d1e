//! Polynomials with rational coefficients over nodes of the graph.

use std::collections::BTreeMap;

use crate::arena::Arena;
use crate::node::Factor;
use crate::node::Id;
use crate::rational::Rational;

/// Powers of nodes, ordered by id, none of them 0.
pub(super) type Monomial = Vec<Factor>;

/// `Σ coefficient·monomial`, without zero coefficients.
#[derive(Clone, Default, PartialEq, Debug)]
pub(super) struct Polynomial(BTreeMap<Monomial, Rational>);

impl Polynomial {
    pub(super) fn constant(value: Rational) -> Polynomial {
        Polynomial::term(Monomial::new(), value)
    }

    pub(super) fn atom(id: Id) -> Polynomial {
        Polynomial::term(vec![(id, 1)], Rational::ONE)
    }

    pub(super) fn term(monomial: Monomial, coefficient: Rational) -> Polynomial {
        let mut polynomial = Polynomial::default();
        polynomial.add(monomial, &coefficient);
        polynomial
    }

    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = (&Monomial, &Rational)> {
        self.0.iter()
    }

    pub(super) fn first(&self) -> Option<(&Monomial, &Rational)> {
        self.0.first_key_value()
    }

    pub(super) fn coefficient(&self, monomial: &Monomial) -> Option<&Rational> {
        self.0.get(monomial)
    }

    pub(super) fn remove(&mut self, monomial: &Monomial) {
        self.0.remove(monomial);
    }

    /// Adds a term.
    pub(super) fn add(&mut self, monomial: Monomial, coefficient: &Rational) {
        use std::collections::btree_map::Entry;
        match self.0.entry(monomial) {
            Entry::Vacant(entry) => {
                if !coefficient.is_zero() {
                    entry.insert(coefficient.clone());
                }
            }
            Entry::Occupied(mut entry) => {
                *entry.get_mut() = entry.get() + coefficient;
                if entry.get().is_zero() {
                    entry.remove();
                }
            }
        }
    }

    /// Adds a multiple of another polynomial.
    pub(super) fn add_multiple(&mut self, other: &Polynomial, factor: &Rational) {
        for (monomial, coefficient) in other.iter() {
            self.add(monomial.clone(), &(coefficient * factor));
        }
    }

    /// The number of factors when written out, the length in print.
    pub(super) fn weight(&self) -> usize {
        self.0.keys().map(|monomial| 1 + monomial.len()).sum()
    }

    /// The terms grouped by those of their factors for which `outer` holds; the remaining factors
    /// are in the polynomials.
    pub(super) fn grouped(&self, outer: impl Fn(Id) -> bool) -> BTreeMap<Monomial, Polynomial> {
        let mut groups: BTreeMap<Monomial, Polynomial> = BTreeMap::new();
        for (monomial, coefficient) in self.iter() {
            let key = monomial
                .iter()
                .copied()
                .filter(|&(id, _)| outer(id))
                .collect();
            groups
                .entry(key)
                .or_default()
                .add(monomial.clone(), coefficient);
        }
        groups
    }

    /// The node.
    pub(super) fn rebuild(&self, arena: &mut Arena) -> Id {
        let mut terms = Vec::with_capacity(self.len());
        for (monomial, coefficient) in self.iter() {
            let (scale, id) = arena.product_parts(monomial);
            terms.push((id, &scale * coefficient));
        }
        arena.sum(&terms)
    }
}

/// The product of two monomials; `None` if a power overflows.
pub(super) fn times(a: &[Factor], b: &[Factor]) -> Option<Monomial> {
    let mut product = Monomial::with_capacity(a.len() + b.len());
    let (mut a, mut b) = (a.iter().copied().peekable(), b.iter().copied().peekable());
    loop {
        let next = match (a.peek(), b.peek()) {
            (Some(x), Some(y)) if x.0 == y.0 => {
                let power = x.1.checked_add(y.1)?;
                let id = x.0;
                a.next();
                b.next();
                (id, power)
            }
            (Some(x), Some(y)) if x.0 < y.0 => a.next()?,
            (Some(_), None) => a.next()?,
            (_, Some(_)) => b.next()?,
            (None, None) => return Some(product),
        };
        if next.1 != 0 {
            product.push(next);
        }
    }
}

/// The monomial to an integer power; `None` if a power overflows.
pub(super) fn power(monomial: &[Factor], n: i32) -> Option<Monomial> {
    monomial
        .iter()
        .map(|&(id, power)| Some((id, power.checked_mul(n)?)))
        .collect()
}
