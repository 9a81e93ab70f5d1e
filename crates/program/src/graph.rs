//! The graph of all values of all functions of a machine, each once, with products and sums still whole.
//!
//! Here the *stages are split*: whatever depends on parameters alone is separated from the rest, so
//! that it becomes a prepared value. Every value is written `±p·x`, a [`Scaled`]: `p` depends on
//! parameters alone, `x` has no such factor. If the terms of a sum share `p`, it moves out of the
//! sum, and so on outwards, until it meets other parameters and costs nothing:
//!
//! ```text
//! m·(l·s₁ + l·s₂)·v²  =  (m·l)·((s₁ + s₂)·v²)
//! ```
//!
//! This never adds multiplications: it removes one for each term that loses its factor, and adds
//! one where the sum is used.

use lagrangian_scalar::Scalar;
use lagrangian_symbolic::sorting::sort_by_key;
use lagrangian_symbolic::{Function, Rational};
use rustc_hash::FxHashMap;

use super::Source;
use super::interpret::{binary, unary};

/// Products of at least this many factors remain whole as factors of other products. The derivatives of n nested functions
/// are products of up to n factors; flattened, they would have n² in all.
const LONGEST_PRODUCT: usize = 64;

/// A node of a [`Graph`]; operands have smaller ids.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Id(u32);

impl Id {
    /// The number 0.
    pub const ZERO: Id = Id(0);
    /// The number 1.
    pub const ONE: Id = Id(1);

    /// Its index among the nodes of the graph.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// The kinds of nodes.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A number.
    Constant(Rational),
    /// π.
    Pi,
    /// An argument.
    Read(Source),
    /// At least two terms, ordered by id, the first of them positive; or a single negative one.
    Sum(Box<[Term]>),
    /// Factors and their powers, ordered by id. No factor is a product, unless it depends on
    /// parameters alone or is long. There are two factors at least, or one with a power other than 1.
    Product(Box<[(Id, i32)]>),
    /// A function of its arguments.
    Function(Function, Box<[Id]>),
    /// A value that is computed on its own: it stays one factor, even if it is a product.
    Opaque(Id),
}

/// A term of a sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Term {
    /// The node that is added.
    pub id: Id,
    /// Whether it is subtracted.
    pub negative: bool,
}

/// `±factor·core`: the factor depends on parameters alone, the core is 1 or has no such factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scaled {
    /// Whether the sign is −.
    pub negative: bool,
    /// The part that depends on parameters alone.
    pub factor: Id,
    /// The rest.
    pub core: Id,
}

impl Scaled {
    /// The number 0.
    pub const ZERO: Scaled = Scaled {
        negative: false,
        factor: Id::ZERO,
        core: Id::ONE,
    };

    /// Whether it is the number 0.
    pub fn is_zero(self) -> bool {
        self.factor == Id::ZERO
    }

    /// Whether it depends on parameters alone.
    pub fn is_known(self) -> bool {
        self.core == Id::ONE
    }

    /// This value with the other sign.
    pub fn negated(self) -> Scaled {
        Scaled {
            negative: !self.negative,
            ..self
        }
    }
}

/// Hash-consed expressions: equal operations on equal operands are one node.
pub struct Graph {
    nodes: Vec<Node>,
    /// Whether the node depends on parameters alone.
    known: Vec<bool>,
    ids: FxHashMap<Node, Id>,
}

impl Default for Graph {
    /// The graph of the numbers 0 and 1.
    fn default() -> Graph {
        let mut graph = Graph {
            nodes: Vec::new(),
            known: Vec::new(),
            ids: FxHashMap::default(),
        };
        graph.intern(Node::Constant(Rational::ZERO));
        graph.intern(Node::Constant(Rational::ONE));
        graph
    }
}

impl Graph {
    /// The node of an id.
    pub fn node(&self, id: Id) -> &Node {
        &self.nodes[id.index()]
    }

    /// The number of nodes; the numbers 0 and 1 are always among them.
    pub fn size(&self) -> usize {
        self.nodes.len()
    }

    /// Whether the node depends on parameters alone.
    pub fn is_known(&self, id: Id) -> bool {
        self.known[id.index()]
    }

    fn intern(&mut self, node: Node) -> Id {
        if let Some(&id) = self.ids.get(&node) {
            return id;
        }
        let known = match &node {
            Node::Constant(_) | Node::Pi => true,
            Node::Read(source) => matches!(source, Source::Parameter(_)),
            Node::Sum(terms) => terms.iter().all(|term| self.is_known(term.id)),
            Node::Product(factors) => factors.iter().all(|(id, _)| self.is_known(*id)),
            Node::Function(_, arguments) => arguments.iter().all(|id| self.is_known(*id)),
            Node::Opaque(id) => self.is_known(*id),
        };
        let id = Id(u32::try_from(self.nodes.len()).expect("memory ends before 2^32 nodes"));
        self.nodes.push(node.clone());
        self.known.push(known);
        self.ids.insert(node, id);
        id
    }

    /// A node as a scaled value, with its parameters in the factor.
    pub fn scaled(&self, id: Id) -> Scaled {
        if self.is_known(id) {
            Scaled {
                negative: false,
                factor: id,
                core: Id::ONE,
            }
        } else {
            Scaled {
                negative: false,
                factor: Id::ONE,
                core: id,
            }
        }
    }

    /// A number.
    pub fn constant(&mut self, value: &Rational) -> Scaled {
        let factor = self.intern(Node::Constant(value.abs()));
        Scaled {
            negative: value.is_negative(),
            factor,
            core: Id::ONE,
        }
    }

    /// π.
    pub fn pi(&mut self) -> Scaled {
        let id = self.intern(Node::Pi);
        self.scaled(id)
    }

    /// An argument.
    pub fn read(&mut self, source: Source) -> Scaled {
        let id = self.intern(Node::Read(source));
        self.scaled(id)
    }

    /// The function of its arguments.
    pub fn function(&mut self, function: Function, arguments: &[Scaled]) -> Scaled {
        // The sign of a sum may have been flipped when it was built, so that the angle is −x:
        // sin(−x) = −sin x, cos(−x) = cos x.
        if let ([x], Function::Sin | Function::Cos) = (arguments, function) {
            let argument = self.unsigned(*x);
            let id = self.intern(Node::Function(function, Box::new([argument])));
            let negative = x.negative && function == Function::Sin;
            return Scaled {
                negative,
                ..self.scaled(id)
            };
        }
        let arguments = arguments.iter().map(|x| self.signed(*x)).collect();
        let id = self.intern(Node::Function(function, arguments));
        self.scaled(id)
    }

    /// `Π factorᵢ^powerᵢ`.
    pub fn product(&mut self, factors: &[(Scaled, i32)]) -> Scaled {
        let negative = factors
            .iter()
            .filter(|(x, power)| x.negative && power % 2 != 0)
            .count()
            % 2
            != 0;
        let known: Vec<_> = factors
            .iter()
            .map(|(x, power)| (x.factor, *power))
            .collect();
        let rest: Vec<_> = factors.iter().map(|(x, power)| (x.core, *power)).collect();
        let factor = self.product_of(&known);
        if factor == Id::ZERO {
            return Scaled::ZERO;
        }
        Scaled {
            negative,
            factor,
            core: self.product_of(&rest),
        }
    }

    /// `numerator/denominator`.
    pub fn quotient(&mut self, numerator: Scaled, denominator: Scaled) -> Scaled {
        self.product(&[(numerator, 1), (denominator, -1)])
    }

    /// The product of nodes; products that are not long are flattened, and constants are multiplied.
    fn product_of(&mut self, list: &[(Id, i32)]) -> Id {
        let mut constant = Rational::ONE;
        let mut factors: Vec<(Id, i32)> = Vec::with_capacity(list.len() + 1);
        for &(id, power) in list {
            match self.node(id) {
                Node::Product(inner) if inner.len() < LONGEST_PRODUCT => {
                    factors.extend(
                        inner
                            .iter()
                            .map(|&(factor, p)| (factor, p.saturating_mul(power))),
                    );
                }
                _ => factors.push((id, power)),
            }
        }
        factors.retain(|&(id, power)| {
            // A factor without an exact value (1/0, or too many digits) stays a factor.
            let exact = match self.node(id) {
                Node::Constant(value) => value
                    .pow(power)
                    .and_then(|value| constant.checked_mul(&value)),
                _ => None,
            };
            exact.map(|value| constant = value).is_none()
        });
        factors.sort_unstable();
        let mut merged: Vec<(Id, i32)> = Vec::with_capacity(factors.len() + 1);
        for (id, power) in factors {
            match merged.last_mut() {
                Some(last) if last.0 == id => last.1 = last.1.saturating_add(power),
                _ => merged.push((id, power)),
            }
        }
        merged.retain(|(_, power)| *power != 0);
        if constant.is_zero() {
            return Id::ZERO;
        }
        if !constant.is_one() {
            merged.push((self.intern(Node::Constant(constant)), 1));
            merged.sort_unstable();
        }
        match *merged.as_slice() {
            [] => Id::ONE,
            [(id, 1)] => id,
            _ => self.intern(Node::Product(merged.into())),
        }
    }

    /// The sum.
    pub fn sum(&mut self, terms: &[Scaled]) -> Scaled {
        let mut by_core: Vec<Scaled> = terms
            .iter()
            .copied()
            .filter(|term| !term.is_zero())
            .collect();
        sort_by_key(&mut by_core, |term| term.core);
        // p₁·x + p₂·x = (p₁ + p₂)·x.
        let mut merged: Vec<Scaled> = Vec::with_capacity(by_core.len());
        for group in by_core.chunk_by(|a, b| a.core == b.core) {
            let core = group[0].core;
            let sum = if group.len() == 1 {
                group[0]
            } else {
                self.sum_of_known(group)
            };
            if !sum.is_zero() {
                merged.push(Scaled { core, ..sum });
            }
        }
        match merged.as_slice() {
            [] => return Scaled::ZERO,
            [single] => return *single,
            _ => {}
        }
        let negative = merged[0].negative;
        let common = merged[0].factor;
        let shared = merged
            .iter()
            .all(|term| term.factor == common && !term.is_known());
        let mut parts: Vec<Term> = Vec::with_capacity(merged.len());
        for term in &merged {
            let id = if shared {
                term.core
            } else {
                self.unsigned(*term)
            };
            parts.push(Term {
                id,
                negative: term.negative,
            });
        }
        let factor = if shared { common } else { Id::ONE };
        let (sum_negative, core) = self.sum_node(parts);
        debug_assert!(negative == sum_negative || !shared);
        Scaled {
            negative: sum_negative,
            factor,
            core,
        }
    }

    /// The sum of the factors of terms with equal cores; the core of the result is 1.
    fn sum_of_known(&mut self, terms: &[Scaled]) -> Scaled {
        // c₁·p + c₂·p = (c₁ + c₂)·p for numbers c.
        let mut multiples: Vec<(Id, Rational)> = Vec::with_capacity(terms.len());
        for term in terms {
            let (coefficient, rest) = self.split_constant(term.factor);
            multiples.push((
                rest,
                if term.negative {
                    -coefficient
                } else {
                    coefficient
                },
            ));
        }
        sort_by_key(&mut multiples, |(rest, _)| *rest);
        multiples.dedup_by(|next, sum| {
            let total = if next.0 == sum.0 {
                sum.1.checked_add(&next.1)
            } else {
                None
            };
            total.map(|total| sum.1 = total).is_some()
        });
        multiples.retain(|(_, coefficient)| !coefficient.is_zero());
        let mut parts: Vec<Term> = Vec::with_capacity(multiples.len());
        for (rest, coefficient) in multiples {
            let magnitude = self.intern(Node::Constant(coefficient.abs()));
            let id = self.product_of(&[(magnitude, 1), (rest, 1)]);
            parts.push(Term {
                id,
                negative: coefficient.is_negative(),
            });
        }
        match *parts.as_slice() {
            [] => Scaled::ZERO,
            [Term { id, negative }] => Scaled {
                negative,
                factor: id,
                core: Id::ONE,
            },
            _ => {
                let (negative, factor) = self.sum_node(parts);
                Scaled {
                    negative,
                    factor,
                    core: Id::ONE,
                }
            }
        }
    }

    /// A sum of at least two different terms, and whether it is the negative of the node.
    fn sum_node(&mut self, mut terms: Vec<Term>) -> (bool, Id) {
        terms.sort_unstable();
        let negative = terms[0].negative;
        for term in &mut terms {
            term.negative ^= negative;
        }
        (negative, self.intern(Node::Sum(terms.into())))
    }

    /// The numerical factor of a product, and the rest.
    fn split_constant(&mut self, id: Id) -> (Rational, Id) {
        let (coefficient, rest) = match self.node(id) {
            Node::Constant(value) => return (value.clone(), Id::ONE),
            Node::Product(factors) => {
                let constant =
                    factors
                        .iter()
                        .find_map(|&(factor, power)| match self.node(factor) {
                            Node::Constant(value) if power == 1 => Some((value.clone(), factor)),
                            _ => None,
                        });
                match constant {
                    Some((value, constant)) => {
                        let rest = factors
                            .iter()
                            .copied()
                            .filter(|(factor, _)| *factor != constant);
                        (value, rest.collect::<Vec<_>>())
                    }
                    None => return (Rational::ONE, id),
                }
            }
            _ => return (Rational::ONE, id),
        };
        (coefficient, self.product_of(&rest))
    }

    /// The node of a value without its sign.
    pub fn unsigned(&mut self, x: Scaled) -> Id {
        if x.factor == Id::ONE || x.is_known() {
            return self.product_of(&[(x.factor, 1), (x.core, 1)]);
        }
        // The factor stays one factor, since all of it is known earlier.
        let mut factors = vec![(x.factor, 1)];
        match self.node(x.core) {
            Node::Product(inner) if inner.len() < LONGEST_PRODUCT => {
                factors.extend_from_slice(inner);
            }
            _ => factors.push((x.core, 1)),
        }
        factors.sort_unstable();
        self.intern(Node::Product(factors.into()))
    }

    /// The node of a value with its sign.
    pub fn signed(&mut self, x: Scaled) -> Id {
        let id = self.unsigned(x);
        if x.negative {
            let term = Term { id, negative: true };
            self.intern(Node::Sum(Box::new([term])))
        } else {
            id
        }
    }

    /// A value whose sign is moved into the factor.
    pub fn with_signed_factor(&mut self, x: Scaled) -> Scaled {
        let factor = match self.node(x.factor) {
            Node::Constant(value) if x.negative => {
                let value = -value;
                self.intern(Node::Constant(value))
            }
            _ => self.signed(Scaled { core: Id::ONE, ..x }),
        };
        Scaled {
            negative: false,
            factor,
            core: x.core,
        }
    }

    /// Evaluates values over any type of number, given the values of the arguments.
    pub fn evaluate<S: Scalar>(&self, roots: &[Scaled], read: impl Fn(Source) -> S) -> Vec<S> {
        let mut needed = vec![false; self.nodes.len()];
        for root in roots {
            needed[root.factor.index()] = true;
            needed[root.core.index()] = true;
        }
        for index in (0..self.nodes.len()).rev() {
            if !needed[index] {
                continue;
            }
            let mut need = |id: Id| needed[id.index()] = true;
            match &self.nodes[index] {
                Node::Constant(_) | Node::Pi | Node::Read(_) => {}
                Node::Sum(terms) => terms.iter().for_each(|term| need(term.id)),
                Node::Product(factors) => factors.iter().for_each(|(id, _)| need(*id)),
                Node::Function(_, arguments) => arguments.iter().for_each(|id| need(*id)),
                Node::Opaque(id) => need(*id),
            }
        }
        let mut values = vec![S::ZERO; self.nodes.len()];
        for index in (0..self.nodes.len()).filter(|&index| needed[index]) {
            let at = |id: Id| values[id.index()];
            values[index] = match &self.nodes[index] {
                Node::Constant(value) => value.evaluate(),
                Node::Pi => S::pi(),
                Node::Read(source) => read(*source),
                Node::Sum(terms) => terms.iter().fold(S::ZERO, |sum, term| {
                    let value = at(term.id);
                    if term.negative {
                        sum - value
                    } else {
                        sum + value
                    }
                }),
                Node::Product(factors) => factors.iter().fold(S::ONE, |product, (id, power)| {
                    let factor = at(*id).powi(power.saturating_abs());
                    if *power < 0 {
                        product / factor
                    } else {
                        product * factor
                    }
                }),
                Node::Function(function, arguments) => match **arguments {
                    [x] => unary(*function, at(x)),
                    [x, y] => binary(*function, at(x), at(y)),
                    _ => unreachable!("functions have one argument or two"),
                },
                Node::Opaque(id) => at(*id),
            };
        }
        let value = |root: &Scaled| {
            let value = values[root.factor.index()] * values[root.core.index()];
            if root.negative { -value } else { value }
        };
        roots.iter().map(value).collect()
    }

    /// A value that is computed on its own wherever it is used, and never multiplied out.
    pub fn opaque(&mut self, x: Scaled) -> Scaled {
        if x.is_known() {
            return x;
        }
        let id = self.unsigned(x);
        let core = match self.node(id) {
            Node::Product(_) => self.intern(Node::Opaque(id)),
            _ => id,
        };
        Scaled {
            negative: x.negative,
            factor: Id::ONE,
            core,
        }
    }
}
