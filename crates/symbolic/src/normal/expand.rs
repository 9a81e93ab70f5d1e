//! Expands expressions into polynomials.

use std::rc::Rc;

use rustc_hash::FxHashMap;

use crate::arena::Arena;
use crate::node::Factor;
use crate::node::{Function, Id, Node};
use crate::normal::angles::Angles;
use crate::normal::polynomial::{self, Monomial, Polynomial};
use crate::rational::Rational;

/// The number of products of terms that may be formed for each term of the budget; a larger number
/// means a hopeless case.
const WORK_PER_TERM: usize = 50;

/// Expands nodes, each once.
pub(super) struct Expander<'a> {
    arena: &'a mut Arena,
    /// The largest number of terms of a polynomial.
    budget: usize,
    /// The number of products of terms that may still be formed.
    work: usize,
    known: FxHashMap<Id, Rc<Polynomial>>,
    /// Sine and cosine, by the node of the argument.
    circular: FxHashMap<Id, [Rc<Polynomial>; 2]>,
    /// The arguments of the nodes of roots and absolute values.
    radicands: FxHashMap<Id, Rc<Polynomial>>,
    angles: Angles,
    /// Whether a base angle became smaller, so that expansion has to start again.
    restart: bool,
}

impl<'a> Expander<'a> {
    pub(super) fn new(arena: &'a mut Arena, budget: usize) -> Expander<'a> {
        Expander {
            arena,
            budget,
            work: budget.saturating_mul(WORK_PER_TERM),
            known: FxHashMap::default(),
            circular: FxHashMap::default(),
            radicands: FxHashMap::default(),
            angles: Angles::default(),
            restart: false,
        }
    }

    pub(super) fn expand(&mut self, roots: &[Id]) -> Option<Vec<Polynomial>> {
        let needed = self.arena.reachable(roots.iter().copied(), |_| true);
        // A base angle only ever shrinks, and only to a divisor within bounds, so this terminates.
        loop {
            self.restart = false;
            for &id in &needed {
                let polynomial = self.node(id)?;
                if polynomial.len() > self.budget {
                    return None;
                }
                self.known.insert(id, Rc::new(polynomial));
                if self.restart {
                    break;
                }
            }
            if !self.restart {
                return roots
                    .iter()
                    .map(|root| Some((**self.known.get(root)?).clone()))
                    .collect();
            }
            self.known.clear();
            self.circular.clear();
        }
    }

    fn node(&mut self, id: Id) -> Option<Polynomial> {
        match self.arena.node(id).clone() {
            _ if id == Arena::UNDEFINED => None,
            Node::Constant(value) => Some(Polynomial::constant(value)),
            Node::Pi | Node::Symbol(_) => Some(Polynomial::atom(id)),
            Node::Sum(terms) => {
                let mut sum = Polynomial::default();
                for (x, c) in terms.iter() {
                    let x = self.known.get(x)?;
                    self.work = self.work.checked_sub(x.len())?;
                    sum.add_multiple(x, c);
                }
                Some(sum)
            }
            Node::Product(factors) => {
                let mut product = Polynomial::constant(Rational::ONE);
                for &(x, n) in factors.iter() {
                    let x = Rc::clone(self.known.get(&x)?);
                    let power = self.power(&x, n)?;
                    product = self.multiply(&product, &power)?;
                }
                Some(product)
            }
            Node::Function(function @ (Function::Sin | Function::Cos), arguments) => {
                let [sine, cosine] = self.circular_of(arguments[0])?;
                Some(
                    (*if function == Function::Sin {
                        sine
                    } else {
                        cosine
                    })
                    .clone(),
                )
            }
            Node::Function(function, arguments) => {
                let mut rebuilt = Vec::with_capacity(arguments.len());
                for x in arguments.iter() {
                    rebuilt.push(self.known.get(x)?.rebuild(self.arena));
                }
                let value = self.arena.function(function, &rebuilt);
                let (scale, atom) = self.split_scale(value);
                if matches!(function, Function::Sqrt | Function::Abs) {
                    // |−2x| became 2·|x|: the argument of the atom is x.
                    let mut radicand = Polynomial::default();
                    radicand.add_multiple(self.known.get(&arguments[0])?, &scale.recip()?);
                    self.radicands.insert(atom, Rc::new(radicand));
                }
                self.import(value)
            }
        }
    }

    /// A node returned by a constructor: a multiple of a product of atoms.
    fn import(&mut self, id: Id) -> Option<Polynomial> {
        match self.arena.node(id) {
            _ if id == Arena::UNDEFINED => return None,
            Node::Constant(value) => return Some(Polynomial::constant(value.clone())),
            _ => {}
        }
        let (scale, inner) = self.split_scale(id);
        let monomial = match self.arena.node(inner) {
            Node::Product(factors) => factors.to_vec(),
            _ => vec![(inner, 1)],
        };
        Some(Polynomial::term(monomial, scale))
    }

    /// The coefficient and the node of a multiple.
    fn split_scale(&self, id: Id) -> (Rational, Id) {
        match self.arena.node(id) {
            Node::Sum(terms) if terms.len() == 1 => (terms[0].1.clone(), terms[0].0),
            _ => (Rational::ONE, id),
        }
    }

    fn multiply(&mut self, a: &Polynomial, b: &Polynomial) -> Option<Polynomial> {
        self.work = self.work.checked_sub(a.len().checked_mul(b.len())?)?;
        let mut product = Polynomial::default();
        for (x, c) in a.iter() {
            for (y, d) in b.iter() {
                let coefficient = c.checked_mul(d)?;
                self.add_reduced(&mut product, polynomial::times(x, y)?, &coefficient)?;
            }
            if product.len() > self.budget {
                return None;
            }
        }
        Some(product)
    }

    /// Adds a term, with squares of sines, roots and absolute values reduced.
    fn add_reduced(
        &mut self,
        sum: &mut Polynomial,
        monomial: Monomial,
        coefficient: &Rational,
    ) -> Option<()> {
        let high = |&(_, n): &Factor| !(-1..=1).contains(&n);
        for (position, &(id, n)) in monomial
            .iter()
            .enumerate()
            .filter(|(_, factor)| high(factor))
        {
            let Some(reduced) = self.reduced_power(id, n)? else {
                continue;
            };
            self.work = self.work.checked_sub(reduced.len())?;
            let mut rest = monomial.clone();
            rest.remove(position);
            for (x, c) in reduced.iter() {
                let product = polynomial::times(&rest, x)?;
                self.add_reduced(sum, product, &coefficient.checked_mul(c)?)?;
            }
            return Some(());
        }
        sum.add(monomial, coefficient);
        Some(())
    }

    /// The reduced form of a power of an atom, if it has one; the outer `None` means that the
    /// budget is exhausted.
    fn reduced_power(&mut self, id: Id, n: i32) -> Option<Option<Polynomial>> {
        let Node::Function(function, arguments) = self.arena.node(id).clone() else {
            return Some(None);
        };
        let odd = if n % 2 == 0 {
            Monomial::new()
        } else {
            vec![(id, n % 2)]
        };
        let even = match function {
            // sin² = 1 − cos²
            Function::Sin if n >= 2 => {
                let cosine = self.arena.function(Function::Cos, &arguments);
                let mut square = Polynomial::constant(Rational::ONE);
                square.add(vec![(cosine, 2)], &Rational::MINUS_ONE);
                self.power(&square, n / 2)?
            }
            Function::Sqrt => match self.radicands.get(&id).cloned() {
                Some(radicand) => self.power(&radicand, n / 2)?,
                None => return Some(None),
            },
            Function::Abs if n >= 2 => match self.radicands.get(&id).cloned() {
                Some(radicand) => self.power(&radicand, n - n % 2)?,
                None => return Some(None),
            },
            _ => return Some(None),
        };
        let mut reduced = Polynomial::default();
        for (x, c) in even.iter() {
            reduced.add(polynomial::times(x, &odd)?, c);
        }
        Some(Some(reduced))
    }

    fn power(&mut self, base: &Polynomial, n: i32) -> Option<Polynomial> {
        if n < 0 {
            let inverse = self.reciprocal(base)?;
            return self.power_unsigned(&inverse, n.unsigned_abs());
        }
        self.power_unsigned(base, n.unsigned_abs())
    }

    fn power_unsigned(&mut self, base: &Polynomial, n: u32) -> Option<Polynomial> {
        if let (1, Some((monomial, coefficient))) = (base.len(), base.first()) {
            let n = i32::try_from(n).ok()?;
            let mut power = Polynomial::default();
            let (monomial, coefficient) = (polynomial::power(monomial, n)?, coefficient.pow(n)?);
            self.add_reduced(&mut power, monomial, &coefficient)?;
            return Some(power);
        }
        // The power of a sum has more terms than its exponent.
        if usize::try_from(n).is_ok_and(|n| n > self.budget) {
            return None;
        }
        let mut power = Polynomial::constant(Rational::ONE);
        for _ in 0..n {
            power = self.multiply(&power, base)?;
        }
        Some(power)
    }

    /// 1/(c·X·S) = c⁻¹·X⁻¹·S⁻¹: the coefficient and common factors are taken out, and the rest is one atom.
    fn reciprocal(&mut self, base: &Polynomial) -> Option<Polynomial> {
        let mut common: Option<Monomial> = None;
        for (monomial, _) in base.iter() {
            common = Some(common.map_or(monomial.clone(), |common| meet(&common, monomial)));
        }
        let inverse = polynomial::power(&common?, -1)?;
        let mut rest = Polynomial::default();
        for (monomial, coefficient) in base.iter() {
            rest.add(polynomial::times(monomial, &inverse)?, coefficient);
        }
        let scale = rest.first()?.1.recip()?;
        let mut result = Polynomial::default();
        if rest.len() == 1 {
            self.add_reduced(&mut result, inverse, &scale)?;
            return Some(result);
        }
        let mut unit = Polynomial::default();
        unit.add_multiple(&rest, &scale);
        let divisor = unit.rebuild(self.arena);
        let monomial = polynomial::times(&inverse, &[(divisor, -1)])?;
        self.add_reduced(&mut result, monomial, &scale)?;
        Some(result)
    }

    /// sin x and cos x by the addition theorem.
    fn circular_of(&mut self, x: Id) -> Option<[Rc<Polynomial>; 2]> {
        if let Some(known) = self.circular.get(&x) {
            return Some(known.clone());
        }
        let angle = Rc::clone(self.known.get(&x)?);
        let mut total = [Polynomial::default(), Polynomial::constant(Rational::ONE)];
        for (monomial, coefficient) in angle.iter() {
            let part = if *monomial == [(Arena::PI, 1)] {
                self.circular_of_base(coefficient, monomial)?
            } else {
                let (unit, n, changed) = self.angles.split(monomial, coefficient);
                self.restart |= changed;
                let base = self.circular_of_base(&unit, monomial)?;
                self.multiple_angle(&base, n)?
            };
            total = self.add_angles(&total, &part)?;
        }
        let result = total.map(Rc::new);
        self.circular.insert(x, result.clone());
        Some(result)
    }

    /// Sine and cosine of one term of an angle, as atoms.
    fn circular_of_base(
        &mut self,
        coefficient: &Rational,
        monomial: &Monomial,
    ) -> Option<[Polynomial; 2]> {
        let (scale, id) = self.arena.product_parts(monomial);
        let angle = self.arena.scaled(&scale * coefficient, id);
        let [sine, cosine] =
            [Function::Sin, Function::Cos].map(|f| self.arena.function(f, &[angle]));
        Some([self.import(sine)?, self.import(cosine)?])
    }

    /// sin nx and cos nx from sin x and cos x.
    fn multiple_angle(&mut self, base: &[Polynomial; 2], n: i64) -> Option<[Polynomial; 2]> {
        let mut total = base.clone();
        for _ in 1..n.unsigned_abs() {
            total = self.add_angles(&total, base)?;
        }
        if n < 0 {
            let mut opposite = Polynomial::default();
            opposite.add_multiple(&total[0], &Rational::MINUS_ONE);
            total[0] = opposite;
        }
        Some(total)
    }

    /// sin(a + b) = sin a cos b + cos a sin b, cos(a + b) = cos a cos b − sin a sin b.
    fn add_angles(&mut self, a: &[Polynomial; 2], b: &[Polynomial; 2]) -> Option<[Polynomial; 2]> {
        let mut sine = self.multiply(&a[0], &b[1])?;
        sine.add_multiple(&self.multiply(&a[1], &b[0])?, &Rational::ONE);
        let mut cosine = self.multiply(&a[1], &b[1])?;
        cosine.add_multiple(&self.multiply(&a[0], &b[0])?, &Rational::MINUS_ONE);
        Some([sine, cosine])
    }
}

/// The common factors of two monomials: the lower power of every atom, where an absent atom has power 0.
fn meet(a: &[Factor], b: &[Factor]) -> Monomial {
    let power_in = |monomial: &[Factor], id: Id| {
        monomial
            .binary_search_by_key(&id, |factor| factor.0)
            .map_or(0, |place| monomial[place].1)
    };
    let mut common: Monomial = a
        .iter()
        .map(|&(id, n)| (id, n.min(power_in(b, id))))
        .collect();
    common.extend(b.iter().filter(|(id, n)| *n < 0 && power_in(a, *id) == 0));
    common.retain(|&(_, n)| n != 0);
    common.sort_unstable();
    common
}
