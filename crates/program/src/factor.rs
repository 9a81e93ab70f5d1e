//! Takes common factors out of sums: `x·y + x·z·w + u` becomes `x·(y + z·w) + u`.
//!
//! The algorithm is greedy: the factor that occurs in most terms is taken out of them, and so on
//! with the remaining terms inside and outside. Among factors that occur equally often, the one
//! known last is taken, so that what remains inside is known early. Products that are also used
//! elsewhere are left alone, since they would have to be computed twice.
//!
//! This is Horner's rule for several variables, with the order of variables chosen on the way (J.
//! Carnicer and M. Gasca, *Evaluation of multivariate polynomials and their derivatives*, Math.
//! Comp. 54 (1990) 231–243, analyse its savings). It competes with [common pairs](super::pairs): a
//! factor that is taken out can no longer be shared. So a program is made both ways, and the
//! cheaper one is taken.

use std::cmp::Reverse;

use rustc_hash::FxHashMap;

use super::net::{Index, Item, Net, Signed};

/// Longer sums are left as they are, since every search for a factor counts all of them.
const LONGEST_SUM: usize = 512;

/// The largest depth of nested sums from which factors are taken out.
const DEEPEST: usize = 48;

/// The largest number of factors that are counted in one function, anew for each factor taken out.
/// After that the remaining sums stay as they are.
const FACTORS_COUNTED: usize = 2_000_000;

/// A term of a sum.
struct Monomial {
    /// Its factors by index, repeated for powers; if the term is not a product of its own, the term itself.
    factors: Vec<Index>,
    negative: bool,
    /// Its item, unless it was changed.
    item: Option<Index>,
}

impl Monomial {
    /// Whether a factor may be taken out: a term that is only a factor stays.
    fn is_product(&self) -> bool {
        self.factors.len() > 1
    }

    /// Takes a factor out.
    fn divide(&mut self, factor: Index) {
        if let Ok(position) = self.factors.binary_search(&factor) {
            self.factors.remove(position);
        }
        self.item = None;
    }
}

impl Net {
    /// Takes common factors out of all sums; returns whether there were any.
    pub fn factor(&mut self) -> bool {
        let uses = self.uses();
        let mut changed = false;
        let mut looks = FACTORS_COUNTED;
        for index in 0..self.items.len() {
            let Item::Sum(terms) = &self.items[index] else {
                continue;
            };
            let monomials: Vec<Monomial> = terms
                .iter()
                .map(|&term| self.monomial(term, &uses))
                .collect();
            if monomials.len() > LONGEST_SUM || self.most_common(&monomials, &mut looks).is_none() {
                continue;
            }
            changed = true;
            let terms = self.factored(monomials, 0, &mut looks);
            let terms: Vec<Signed> = terms.into_iter().map(|term| self.item_of(term)).collect();
            self.items[index] = match *terms.as_slice() {
                // The whole sum is one product, and nothing else uses its item.
                [(product, false)] => self.items[product as usize].clone(),
                _ => Item::Sum(terms),
            };
        }
        if changed {
            self.clear_unused();
        }
        changed
    }

    /// Empties the items that no root needs any more, so that nothing is shared with them.
    fn clear_unused(&mut self) {
        let mut needed = vec![false; self.items.len()];
        let mut open: Vec<Index> = self.roots.iter().map(|(root, _)| *root).collect();
        while let Some(index) = open.pop() {
            if !std::mem::replace(&mut needed[index as usize], true) {
                super::net::operands(&self.items[index as usize], |operand| open.push(operand));
            }
        }
        for (item, needed) in self.items.iter_mut().zip(needed) {
            if !needed {
                *item = Item::Sum(vec![]);
            }
        }
    }

    /// How often each item is used, by items and as a result.
    pub fn uses(&self) -> Vec<u32> {
        let mut uses = vec![0; self.items.len()];
        let mut count = |index: Index| uses[index as usize] += 1;
        for item in &self.items {
            super::net::operands(item, &mut count);
        }
        self.roots.iter().for_each(|(root, _)| count(*root));
        uses
    }

    fn monomial(&self, (item, negative): Signed, uses: &[u32]) -> Monomial {
        let mut factors = match &self.items[item as usize] {
            Item::Product {
                factors: up,
                divisors: down,
            } if down.is_empty() && uses[item as usize] == 1 => up.clone(),
            _ => vec![item],
        };
        factors.sort_unstable();
        Monomial {
            factors,
            negative,
            item: Some(item),
        }
    }

    /// The sum with common factors taken out.
    fn factored(
        &mut self,
        mut terms: Vec<Monomial>,
        depth: usize,
        looks: &mut usize,
    ) -> Vec<Monomial> {
        while depth < DEEPEST
            && let Some(factor) = self.most_common(&terms, looks)
        {
            let has = |term: &Monomial| term.is_product() && term.factors.contains(&factor);
            let (mut inside, outside) = terms.into_iter().partition::<Vec<_>, _>(has);
            let mut common = vec![factor];
            inside.iter_mut().for_each(|term| term.divide(factor));
            // Further factors that all of them have in common.
            while let Some(&next) = inside[0].factors.iter().find(|next| {
                inside
                    .iter()
                    .all(|term| term.is_product() && term.factors.contains(next))
            }) {
                inside.iter_mut().for_each(|term| term.divide(next));
                common.push(next);
            }
            let negative = inside.iter().all(|term| term.negative);
            inside.iter_mut().for_each(|term| term.negative ^= negative);
            let inside = self.factored(inside, depth + 1, looks);
            match <[Monomial; 1]>::try_from(inside) {
                Ok([product]) => {
                    common.extend(product.factors);
                    terms = outside;
                    terms.push(Monomial::new(common, negative ^ product.negative));
                }
                Err(inside) => {
                    let sum = inside.into_iter().map(|term| self.item_of(term)).collect();
                    common.push(self.add(Item::Sum(sum)));
                    terms = outside;
                    terms.push(Monomial::new(common, negative));
                }
            }
        }
        terms
    }

    /// The factor that occurs in most products among the terms, if it occurs in two or more: in case of
    /// a tie, the one known last, then the oldest. None once the limit of counted factors is reached.
    fn most_common(&self, terms: &[Monomial], looks: &mut usize) -> Option<Index> {
        let factors: usize = terms.iter().map(|term| term.factors.len()).sum();
        *looks = looks.checked_sub(factors)?;
        let mut counts: FxHashMap<Index, u32> = FxHashMap::default();
        for term in terms.iter().filter(|term| term.is_product()) {
            for group in term.factors.chunk_by(|a, b| a == b) {
                *counts.entry(group[0]).or_default() += 1;
            }
        }
        let common = counts.into_iter().filter(|(_, count)| *count > 1);
        let best = common
            .max_by_key(|&(factor, count)| (count, self.stages[factor as usize], Reverse(factor)));
        best.map(|(factor, _)| factor)
    }

    /// A term as an item.
    fn item_of(&mut self, term: Monomial) -> Signed {
        let item = match (term.item, term.factors.as_slice()) {
            (Some(item), _) => item,
            (None, &[factor]) => factor,
            (None, _) => self.add(Item::Product {
                factors: term.factors,
                divisors: vec![],
            }),
        };
        (item, term.negative)
    }
}

impl Monomial {
    fn new(mut factors: Vec<Index>, negative: bool) -> Monomial {
        factors.sort_unstable();
        Monomial {
            factors,
            negative,
            item: None,
        }
    }
}
