//! Derivatives and substitution, in one pass over the graph that visits each node once.
//!
//! No function here recurses into children: a chain of a hundred thousand nodes takes memory, not stack.

use crate::arena::{Arena, Places};
use crate::dag::{Dag, Expr};
use crate::node::{Factor, Function, Id, Node, Symbol, Term};
use crate::rational::Rational;

/// The derivative along one direction, by the forward sweep: `dE/dτ = Σ ∂E/∂s·ds/dτ`.
///
/// Derivatives are remembered across calls.
///
/// ```
/// use lagrangian_symbolic::{Dag, Stage, Tangent};
///
/// let dag = Dag::new();
/// let (q, v) = (dag.symbol("q", Stage(3)), dag.symbol("v", Stage(4)));
/// let mut d = Tangent::new(&dag, &[(q.as_symbol().expect("a symbol"), v)]);
/// assert_eq!(d.of(q.sin()), q.cos() * v);
/// ```
pub struct Tangent<'d> {
    dag: &'d Dag,
    /// The symbols of the direction, as bits; nodes that touch none of them are constant.
    mask: u64,
    memo: Memo,
    /// Second derivatives.
    twice: Memo,
}

impl<'d> Tangent<'d> {
    /// The direction in which each listed symbol changes at the given rate, and every other symbol stays constant.
    pub fn new(dag: &'d Dag, rates: &[(Symbol, Expr<'d>)]) -> Tangent<'d> {
        let arena = dag.arena.borrow();
        let mut tangent = Tangent {
            dag,
            mask: 0,
            memo: Memo::default(),
            twice: Memo::default(),
        };
        for (symbol, rate) in rates {
            tangent.mask |= Arena::symbol_mask(*symbol);
            tangent
                .memo
                .set(arena.symbols[symbol.index()].id, rate.id());
        }
        tangent
    }

    /// The derivative of an expression.
    pub fn of(&mut self, expression: Expr<'d>) -> Expr<'d> {
        let arena = &mut *self.dag.arena.borrow_mut();
        let derivative = derivative(arena, self.mask, &mut self.memo, expression.id());
        self.dag.expr(derivative)
    }

    /// The second derivative along the same direction, with the rates differentiated like
    /// everything else: `d²E/dτ²`.
    ///
    /// It equals `of` applied twice, but is one flat sum for each node, in which the two halves of
    /// a mixed term are combined: `(x y)″ = x″ y + 2 x′ y′ + x y″`.
    pub fn twice(&mut self, expression: Expr<'d>) -> Expr<'d> {
        let arena = &mut *self.dag.arena.borrow_mut();
        let mask = self.mask;
        derivative(arena, mask, &mut self.memo, expression.id());
        let unknown = |id: Id| arena.touches(id, mask) && self.twice.get(id).is_none();
        for id in arena.reachable([expression.id()].into_iter(), unknown) {
            let second = second_of_node(arena, id, mask, &mut self.memo, &self.twice);
            self.twice.set(id, second);
        }
        let second = self.twice.get(expression.id());
        self.dag.expr(second.unwrap_or(Arena::ZERO))
    }
}

impl<'d> Expr<'d> {
    /// The partial derivative with respect to a symbol.
    ///
    /// Use a [`Tangent`] for many expressions with common parts.
    pub fn diff(self, symbol: Symbol) -> Expr<'d> {
        Tangent::new(self.dag(), &[(symbol, self.dag().one())]).of(self)
    }
}

/// The derivative of a node, and those of all nodes below it.
fn derivative(arena: &mut Arena, mask: u64, memo: &mut Memo, root: Id) -> Id {
    let unknown = |id: Id| arena.touches(id, mask) && memo.get(id).is_none();
    for id in arena.reachable([root].into_iter(), unknown) {
        let derivative = tangent_of_node(arena, id, memo);
        memo.set(id, derivative);
    }
    memo.get(root).unwrap_or(Arena::ZERO)
}

/// The second derivative of one node, given the first derivatives, and the nonzero second
/// derivatives of its children.
fn second_of_node(arena: &mut Arena, id: Id, mask: u64, first: &mut Memo, twice: &Memo) -> Id {
    let nonzero = |memo: &Memo, id: Id| memo.get(id).filter(|&found| found != Arena::ZERO);
    match arena.node(id).clone() {
        Node::Constant(_) | Node::Pi => Arena::ZERO,
        // s″ is the derivative of the rate of s
        Node::Symbol(_) => match nonzero(first, id) {
            Some(rate) => derivative(arena, mask, first, rate),
            None => Arena::ZERO,
        },
        // (Σ c·x)″ = Σ c·x″
        Node::Sum(terms) => {
            let second = |(x, c): &Term| Some((nonzero(twice, *x)?, c.clone()));
            let sum: Vec<Term> = terms.iter().filter_map(second).collect();
            arena.sum(&sum)
        }
        // (Π xⁿ)″ = Σ ∂ᵢ·xᵢ″ + Σ ∂ᵢᵢ·xᵢ′² + 2 Σ_{i<j} ∂ᵢⱼ·xᵢ′ xⱼ′
        Node::Product(factors) => {
            let mut sum = Vec::new();
            for (i, (x, _)) in factors.iter().enumerate() {
                if let Some(second) = nonzero(twice, *x) {
                    sum.push(partial_product(arena, &factors, i, second));
                }
                let Some(rate) = nonzero(first, *x) else {
                    continue;
                };
                for (j, (y, _)) in factors.iter().enumerate().skip(i) {
                    if let Some(other) = nonzero(first, *y) {
                        sum.extend(mixed_product(arena, &factors, (i, rate), (j, other)));
                    }
                }
            }
            arena.sum(&sum)
        }
        // f(x, y)″ = Σ ∂ᵢ·xᵢ″ + Σ (∂ᵢ)′·xᵢ′
        Node::Function(function, arguments) => {
            let mut sum = Vec::new();
            for (position, &x) in arguments.iter().enumerate() {
                let (second, rate) = (nonzero(twice, x), nonzero(first, x));
                if second.is_none() && rate.is_none() {
                    continue;
                }
                let partial = partial_function(arena, function, &arguments, id, position);
                let change = derivative(arena, mask, first, partial);
                for (a, b) in [(Some(partial), second), (Some(change), rate)] {
                    if let (Some(a), Some(b)) = (a, b) {
                        let (c, term) = arena.product_parts(&[(a, 1), (b, 1)]);
                        sum.push((term, c));
                    }
                }
            }
            arena.sum(&sum)
        }
    }
}

/// The derivative of one node, given those of its children, or 0.
fn tangent_of_node(arena: &mut Arena, id: Id, known: &Memo) -> Id {
    let derivative_of = |child: Id| {
        known
            .get(child)
            .filter(|&derivative| derivative != Arena::ZERO)
    };
    match arena.node(id).clone() {
        Node::Constant(_) | Node::Pi | Node::Symbol(_) => Arena::ZERO,
        // d Σ c·x = Σ c·dx
        Node::Sum(terms) => {
            let derivative = |(x, c): &Term| Some((derivative_of(*x)?, c.clone()));
            let sum: Vec<Term> = terms.iter().filter_map(derivative).collect();
            arena.sum(&sum)
        }
        // d Π xⁿ = Σ n·xⁿ⁻¹·dx·(the other factors)
        Node::Product(factors) => {
            let mut sum = Vec::new();
            for (position, (x, _)) in factors.iter().enumerate() {
                if let Some(derivative) = derivative_of(*x) {
                    sum.push(partial_product(arena, &factors, position, derivative));
                }
            }
            arena.sum(&sum)
        }
        // d f(x, y) = ∂f/∂x·dx + ∂f/∂y·dy
        Node::Function(function, arguments) => {
            let mut sum = Vec::new();
            for (position, &x) in arguments.iter().enumerate() {
                if let Some(derivative) = derivative_of(x) {
                    let partial = partial_function(arena, function, &arguments, id, position);
                    let (c, term) = arena.product_parts(&[(partial, 1), (derivative, 1)]);
                    sum.push((term, c));
                }
            }
            arena.sum(&sum)
        }
    }
}

/// `Σ weight·∂node/∂symbol` over all seeds `(node, weight)`, for every symbol of `wrt`, by one
/// reverse sweep.
///
/// The weights are not differentiated.
///
/// ```
/// use lagrangian_symbolic::{Dag, Stage, reverse};
///
/// let dag = Dag::new();
/// let (q, force) = (dag.symbol("q", Stage(3)), dag.symbol("F", Stage(5)));
/// let seeds = [(q.cos(), force)];
/// let generalized = reverse(&dag, &seeds, &[q.as_symbol().expect("a symbol")]);
/// assert_eq!(generalized, [-force * q.sin()]);
/// ```
pub fn reverse<'d>(dag: &'d Dag, seeds: &[(Expr<'d>, Expr<'d>)], wrt: &[Symbol]) -> Vec<Expr<'d>> {
    let arena = &mut *dag.arena.borrow_mut();
    let mask = wrt
        .iter()
        .fold(0, |mask, &symbol| mask | Arena::symbol_mask(symbol));
    let roots = seeds.iter().map(|(node, _)| node.id());
    let mut needed = arena.reachable(roots, |id| arena.touches(id, mask));
    keep_dependent(arena, &mut needed, wrt);
    let mut adjoints = Adjoints::new(&needed);
    for (node, weight) in seeds {
        adjoints.add(node.id(), (weight.id(), Rational::ONE));
    }
    // Parents before children: when a node is processed, all contributions to it are complete.
    for &id in needed.iter().rev() {
        let adjoint = arena.sum(&adjoints.take(id));
        adjoints.set_total(id, adjoint);
        if adjoint == Arena::ZERO {
            continue;
        }
        match arena.node(id).clone() {
            Node::Constant(_) | Node::Pi | Node::Symbol(_) => {}
            Node::Sum(terms) => {
                for (x, c) in terms.iter() {
                    adjoints.add(*x, (adjoint, c.clone()));
                }
            }
            Node::Product(factors) => {
                for (position, &(x, _)) in factors.iter().enumerate() {
                    if adjoints.are_for(x) {
                        let term = partial_product(arena, &factors, position, adjoint);
                        adjoints.add(x, term);
                    }
                }
            }
            Node::Function(function, arguments) => {
                for (position, &x) in arguments.iter().enumerate() {
                    if adjoints.are_for(x) {
                        let partial = partial_function(arena, function, &arguments, id, position);
                        let (c, term) = arena.product_parts(&[(partial, 1), (adjoint, 1)]);
                        adjoints.add(x, (term, c));
                    }
                }
            }
        }
    }
    let total = |symbol: &Symbol| adjoints.total(arena.symbols[symbol.index()].id);
    wrt.iter()
        .map(|symbol| dag.expr(total(symbol).unwrap_or(Arena::ZERO)))
        .collect()
}

/// Keeps the nodes, given in order, in which some of the symbols occur. The bits of many symbols
/// coincide, so [`Arena::touches`] alone would keep far too many.
fn keep_dependent(arena: &Arena, nodes: &mut Vec<Id>, symbols: &[Symbol]) {
    let mut dependent = arena.empty_set();
    let symbols = symbols.iter();
    let symbols = symbols.map(|symbol| arena.symbols[symbol.index()].id);
    for symbol in symbols.clone() {
        dependent.insert(symbol);
    }
    nodes.retain(|&id| {
        let mut found = dependent.contains(id);
        let node = arena.node(id);
        node.for_each_child(|child| found |= dependent.contains(child));
        if found {
            dependent.insert(id);
        }
        found
    });
    arena.clear(dependent, symbols.chain(nodes.iter().copied()));
}

/// `weight·∂(Π xⁿ)/∂x` for the factor at `position`.
fn partial_product(arena: &mut Arena, factors: &[Factor], position: usize, weight: Id) -> Term {
    let (_, n) = factors[position];
    let mut partial = factors.to_vec();
    partial[position].1 = match n.checked_sub(1) {
        Some(power) => power,
        None => return (Arena::UNDEFINED, Rational::ONE),
    };
    partial.push((weight, 1));
    let (c, id) = arena.product_parts(&partial);
    match c.checked_mul(&Rational::from(i64::from(n))) {
        Some(c) => (id, c),
        None => (Arena::UNDEFINED, Rational::ONE),
    }
}

/// The term of `xᵢ′ xⱼ′` in `(Π xⁿ)″`, if it exists, for the factors at two positions, equal or not.
fn mixed_product(
    arena: &mut Arena,
    factors: &[Factor],
    (i, rate): (usize, Id),
    (j, other): (usize, Id),
) -> Option<Term> {
    let (n, m) = (i64::from(factors[i].1), i64::from(factors[j].1));
    let coefficient = if i == j { n * (n - 1) } else { 2 * n * m };
    if coefficient == 0 {
        return None;
    }
    let mut partial = factors.to_vec();
    for position in [i, j] {
        match partial[position].1.checked_sub(1) {
            Some(power) => partial[position].1 = power,
            None => return Some((Arena::UNDEFINED, Rational::ONE)),
        }
    }
    partial.extend([(rate, 1), (other, 1)]);
    let (c, id) = arena.product_parts(&partial);
    match c.checked_mul(&Rational::from(coefficient)) {
        Some(c) => Some((id, c)),
        None => Some((Arena::UNDEFINED, Rational::ONE)),
    }
}

/// `∂f/∂(argument at position)`, where `value` is the node `f(arguments)` itself.
fn partial_function(
    arena: &mut Arena,
    function: Function,
    arguments: &[Id],
    value: Id,
    position: usize,
) -> Id {
    let x = arguments[0];
    let y = arguments.get(1).copied().unwrap_or(x);
    let one = (Arena::ONE, Rational::ONE);
    let minus = |id: Id| (id, Rational::MINUS_ONE);
    match function {
        // (sin x)′ = cos x
        Function::Sin => arena.function(Function::Cos, &[x]),
        // (cos x)′ = −sin x
        Function::Cos => {
            let sine = arena.function(Function::Sin, &[x]);
            arena.scaled(Rational::MINUS_ONE, sine)
        }
        // (tan x)′ = 1 + tan²x
        Function::Tan => {
            let square = arena.product(&[(value, 2)]);
            arena.sum(&[one, (square, Rational::ONE)])
        }
        // (asin x)′ = 1/√(1 − x²) = −(acos x)′
        Function::Asin | Function::Acos => {
            let square = arena.product(&[(x, 2)]);
            let radicand = arena.sum(&[one, minus(square)]);
            let root = arena.function(Function::Sqrt, &[radicand]);
            let slope = arena.product(&[(root, -1)]);
            let sign = if function == Function::Asin {
                Rational::ONE
            } else {
                Rational::MINUS_ONE
            };
            arena.scaled(sign, slope)
        }
        // (atan x)′ = 1/(1 + x²)
        Function::Atan => {
            let square = arena.product(&[(x, 2)]);
            let divisor = arena.sum(&[one, (square, Rational::ONE)]);
            arena.product(&[(divisor, -1)])
        }
        Function::Atan2 => partial_of_angle(arena, [x, y], position),
        // (sinh x)′ = cosh x
        Function::Sinh => arena.function(Function::Cosh, &[x]),
        // (cosh x)′ = sinh x
        Function::Cosh => arena.function(Function::Sinh, &[x]),
        // (tanh x)′ = 1 − tanh²x
        Function::Tanh => {
            let square = arena.product(&[(value, 2)]);
            arena.sum(&[one, minus(square)])
        }
        // (eˣ)′ = eˣ
        Function::Exp => value,
        // (ln x)′ = 1/x
        Function::Ln => arena.product(&[(x, -1)]),
        // (√x)′ = 1/(2√x)
        Function::Sqrt => {
            let slope = arena.product(&[(value, -1)]);
            arena.half(slope)
        }
        // |x|′ = sign x, except at 0
        Function::Abs => arena.function(Function::Sign, &[x]),
        // sign′ = 0, except at 0
        Function::Sign => Arena::ZERO,
        Function::Min => partial_of_extreme(arena, Rational::ONE, [x, y], position),
        Function::Max => partial_of_extreme(arena, Rational::MINUS_ONE, [x, y], position),
        Function::Pow => partial_of_power(arena, [x, y], value, position),
    }
}

/// Of `atan2(x, y)`, the angle of the point `(y, x)`: by x, `y/(x² + y²)`; by y, `−x/(x² + y²)`.
fn partial_of_angle(arena: &mut Arena, [x, y]: [Id; 2], position: usize) -> Id {
    let squares = [x, y].map(|id| arena.product(&[(id, 2)]));
    let divisor = arena.sum(&squares.map(|id| (id, Rational::ONE)));
    if position == 0 {
        arena.product(&[(y, 1), (divisor, -1)])
    } else {
        let slope = arena.product(&[(x, 1), (divisor, -1)]);
        arena.scaled(Rational::MINUS_ONE, slope)
    }
}

/// Of the smaller of two numbers, where `sign` is 1, or of the larger, where it is −1. The derivative by that argument is 1, by the other 0:
/// `(1 ± sign(y − x))/2`. If both are equal each gets one half, so that they still add up to 1.
fn partial_of_extreme(arena: &mut Arena, sign: Rational, [x, y]: [Id; 2], position: usize) -> Id {
    let (other, this) = if position == 0 { (y, x) } else { (x, y) };
    let difference = arena.sum(&[(other, Rational::ONE), (this, Rational::MINUS_ONE)]);
    let side = arena.function(Function::Sign, &[difference]);
    let double = arena.sum(&[(Arena::ONE, Rational::ONE), (side, sign)]);
    arena.half(double)
}

/// Of `x^y`, whose node is `value`: by x, `y·x^(y−1)`; by y, `x^y·ln x`.
fn partial_of_power(arena: &mut Arena, [x, y]: [Id; 2], value: Id, position: usize) -> Id {
    if position == 0 {
        let exponent = arena.sum(&[(y, Rational::ONE), (Arena::ONE, Rational::MINUS_ONE)]);
        let power = arena.function(Function::Pow, &[x, exponent]);
        arena.product(&[(y, 1), (power, 1)])
    } else {
        let logarithm = arena.function(Function::Ln, &[x]);
        arena.product(&[(value, 1), (logarithm, 1)])
    }
}

/// The expressions with all symbols replaced simultaneously: replacements are not substituted into again.
///
/// The results are in normal form; nodes in which nothing is replaced stay the same.
pub fn substitute<'d>(
    dag: &'d Dag,
    roots: &[Expr<'d>],
    map: &[(Symbol, Expr<'d>)],
) -> Vec<Expr<'d>> {
    let arena = &mut *dag.arena.borrow_mut();
    let mut memo = Memo::default();
    let mut mask = 0;
    for (symbol, replacement) in map {
        mask |= Arena::symbol_mask(*symbol);
        memo.set(arena.symbols[symbol.index()].id, replacement.id());
    }
    let unknown = |id: Id| arena.touches(id, mask) && memo.get(id).is_none();
    for id in arena.reachable(roots.iter().map(|root| root.id()), unknown) {
        let new = |child: Id| memo.get(child).unwrap_or(child);
        let node = arena.node(id).clone();
        let replaced = match node {
            Node::Constant(_) | Node::Pi | Node::Symbol(_) => id,
            Node::Sum(terms) => arena.sum(
                &terms
                    .iter()
                    .map(|(x, c)| (new(*x), c.clone()))
                    .collect::<Vec<_>>(),
            ),
            Node::Product(factors) => arena.product(
                &factors
                    .iter()
                    .map(|&(x, n)| (new(x), n))
                    .collect::<Vec<_>>(),
            ),
            Node::Function(function, arguments) => {
                let arguments: Vec<Id> = arguments.iter().map(|&x| new(x)).collect();
                arena.function(function, &arguments)
            }
        };
        memo.set(id, replaced);
    }
    roots
        .iter()
        .map(|root| dag.expr(memo.get(root.id()).unwrap_or(root.id())))
        .collect()
}

impl Arena {
    fn half(&mut self, id: Id) -> Id {
        let half = Rational::new(1, 2).unwrap_or(Rational::ZERO);
        self.scaled(half, id)
    }
}

/// A map from nodes to nodes; 0 means none, so that untouched pages are never even cleared.
#[derive(Default)]
struct Memo(Vec<u32>);

impl Memo {
    fn get(&self, id: Id) -> Option<Id> {
        Some(Id(self.0.get(id.index())?.checked_sub(1)?))
    }

    fn set(&mut self, id: Id, value: Id) {
        if self.0.len() <= id.index() {
            let len = (id.index() + 1).max(2 * self.0.len());
            let mut grown = vec![0; len];
            grown[..self.0.len()].copy_from_slice(&self.0);
            self.0 = grown;
        }
        self.0[id.index()] = value.0 + 1;
    }
}

/// Contributions to the adjoints of the needed nodes: one linked list for each, all in one vector.
struct Adjoints {
    /// From a node to its index among the needed ones.
    place: Places,
    heads: Vec<u32>,
    links: Vec<(Term, u32)>,
    totals: Vec<Id>,
}

const END: u32 = u32::MAX;

impl Adjoints {
    fn new(needed: &[Id]) -> Adjoints {
        Adjoints {
            place: Places::of(needed),
            heads: vec![END; needed.len()],
            links: Vec::new(),
            totals: vec![Arena::ZERO; needed.len()],
        }
    }

    /// Whether the adjoint of a node is needed.
    fn are_for(&self, id: Id) -> bool {
        self.place.get(id).is_some()
    }

    /// Adds to the adjoint of a node, if it is needed.
    fn add(&mut self, id: Id, term: Term) {
        if let Some(place) = self.place.get(id) {
            let head = &mut self.heads[place];
            let next = core::mem::replace(head, self.links.len() as u32);
            self.links.push((term, next));
        }
    }

    fn take(&mut self, id: Id) -> Vec<Term> {
        let mut terms = Vec::new();
        if let Some(place) = self.place.get(id) {
            let mut link = self.heads[place];
            while let Some((term, next)) = self.links.get(link as usize) {
                terms.push(term.clone());
                link = *next;
            }
        }
        terms
    }

    fn set_total(&mut self, id: Id, total: Id) {
        if let Some(place) = self.place.get(id) {
            self.totals[place] = total;
        }
    }

    fn total(&self, id: Id) -> Option<Id> {
        Some(self.totals[self.place.get(id)?])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::evaluate;
    use crate::node::Stage;
    use lagrangian_scalar::{Residue, Scalar};

    #[test]
    fn the_second_derivative_is_the_derivative_of_the_derivative() {
        let dag = Dag::new();
        let [x, y, u, w] = ["x", "y", "u", "w"].map(|name| dag.symbol(name, Stage(3)));
        let symbol = |e: Expr| e.as_symbol().expect("made as a symbol");
        // x′ = u, y′ = x w, u′ = y.
        let rates = [(symbol(x), u), (symbol(y), x * w), (symbol(u), y)];
        let expressions = [
            x * y,
            x.powi(3) / y,
            x * y.sin() * u.square(),
            (x * y + u).sqrt(),
            (x + 2 * y).cos().powi(-2),
            x.atan2(y) + x.atan(),
            (x * y).exp() + x.ln() * y.tanh(),
            x.pow(y),
            x * x.abs() + (x * u).max(y * y),
        ];
        for expression in expressions {
            let twice = Tangent::new(&dag, &rates).twice(expression);
            let mut d = Tangent::new(&dag, &rates);
            let first = d.of(expression);
            let of_of = d.of(first);
            let mut compared = 0;
            for seed in 0..40 {
                let value = |s: Symbol| Residue::random(seed, s.index() as u64);
                let [a, b] = evaluate(&dag, &[twice, of_of], value)[..] else {
                    unreachable!("two roots give two values");
                };
                if a.is_finite() && b.is_finite() {
                    assert_eq!(a, b, "{expression:?}");
                    compared += 1;
                }
            }
            assert!(compared >= 3, "{expression:?}");
        }
    }

    #[test]
    fn mixed_terms_of_a_second_derivative_meet() {
        let dag = Dag::new();
        let [s, phi, s_rate, w] = ["s", "φ", "ṡ", "ω"].map(|name| dag.symbol(name, Stage(3)));
        let symbol = |e: Expr| e.as_symbol().expect("made as a symbol");
        let mut d = Tangent::new(&dag, &[(symbol(s), s_rate), (symbol(phi), w)]);
        let expected = dag.sum([-2 * s_rate * w * phi.sin(), -s * w.square() * phi.cos()]);
        assert_eq!(d.twice(s * phi.cos()), expected);
    }
}
