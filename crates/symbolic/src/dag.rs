//! The graph of expressions, and the simplifications during its construction.
//!
//! One arena holds every node once, however often it is used. A node's children are older than
//! the node, so the order of [`Id`]s is a topological order, and everything computed in that
//! order is deterministic.
//!
//! # Normal form
//!
//! Simplifications that are made when a node is built, because they are cheap and always a gain:
//!
//! - exact arithmetic on constants; `0·x = 0`, `x^0 = 1`;
//! - like terms are merged among the *direct* terms of a sum, like factors in a product:
//!   `x/x = 1`, as rational functions, that is except at `x = 0`;
//! - `p₁·X + p₂·X = (p₁ + p₂)·X` if `p` is of parameter stage, so that composite masses form by
//!   themselves; common factors of the `p` stay outside: `(m₁ + m₂)·l·X`;
//! - multiples of π are moved out of sums in a sum: `q₂ + (q₁ − π/2) = (q₂ + q₁) − π/2`;
//! - `A·sin²x + A·cos²x = A`; signs are moved out of odd and even functions: `sin(−x) = −sin x`,
//!   `cos(−x) = cos x`; quarter turns out of angles: `sin(x + π/2) = cos x`; `tan x = sin x/cos x`;
//! - exact values: `sin(π/6) = 1/2`, `sqrt(4/9) = 2/3`, `exp(0) = 1`; and `sqrt(x)² = x`,
//!   `|x|² = x²`, where the left side is defined;
//! - terms and factors are in order of age.
//!
//! Simplifications that are never made here: flattening a sum into a sum (only a one-term multiple
//! is absorbed), distributing a product, expanding or joining angles, `sqrt(x²) = x`. A chain of
//! links is short as long as the position of one link is *one* term in the position of the next;
//! expanding would destroy that.
//!
//! # What has no value
//!
//! Constructors do not panic. `1/0`, `ln(0)`, `sqrt(−1)` and constants beyond
//! [`MAX_BITS`](crate::MAX_BITS) give the single node [`Dag::undefined`]. Everything built from it
//! is that node again, so a caller only needs to check [`Expr::is_undefined`] on a result.

use core::cell::RefCell;
use core::fmt;
use core::hash::{Hash, Hasher};
use std::collections::BTreeSet;

use crate::arena::Arena;
use crate::node::{Function, Id, Node, Stage, Symbol};
use crate::rational::Rational;

/// A graph of expressions.
pub struct Dag {
    pub(crate) arena: RefCell<Arena>,
}

impl Dag {
    /// An empty graph.
    pub fn new() -> Dag {
        Dag {
            arena: RefCell::new(Arena::new()),
        }
    }

    /// A new symbol, different from all others, even from those with the same name.
    pub fn symbol(&self, name: &str, stage: Stage) -> Expr<'_> {
        self.expr(self.arena.borrow_mut().symbol(name, stage))
    }

    /// A rational constant.
    pub fn constant(&self, value: Rational) -> Expr<'_> {
        self.expr(self.arena.borrow_mut().constant(value))
    }

    /// An integer constant.
    pub fn int(&self, value: i64) -> Expr<'_> {
        self.constant(Rational::from(value))
    }

    /// π.
    pub fn pi(&self) -> Expr<'_> {
        self.expr(Arena::PI)
    }

    /// 0.
    pub fn zero(&self) -> Expr<'_> {
        self.expr(Arena::ZERO)
    }

    /// 1.
    pub fn one(&self) -> Expr<'_> {
        self.expr(Arena::ONE)
    }

    /// The undefined value: `1/0`, and everything built from it.
    pub fn undefined(&self) -> Expr<'_> {
        self.expr(Arena::UNDEFINED)
    }

    /// The sum; like terms are merged among these terms. Prefer it to a sequence of `+`, which nests.
    pub fn sum<'d>(&'d self, terms: impl IntoIterator<Item = Expr<'d>>) -> Expr<'d> {
        let terms: Vec<_> = terms
            .into_iter()
            .map(|term| (term.id(), Rational::ONE))
            .collect();
        self.expr(self.arena.borrow_mut().sum(&terms))
    }

    /// The product; like factors are merged. Prefer it to a sequence of `*` for many factors.
    pub fn product<'d>(&'d self, factors: impl IntoIterator<Item = Expr<'d>>) -> Expr<'d> {
        let factors: Vec<_> = factors.into_iter().map(|factor| (factor.id(), 1)).collect();
        self.expr(self.arena.borrow_mut().product(&factors))
    }

    /// A function of its arguments; undefined if their number is not [`Function::arity`].
    pub fn function(&self, function: Function, arguments: &[Expr<'_>]) -> Expr<'_> {
        let arguments: Vec<Id> = arguments.iter().map(|argument| argument.id()).collect();
        self.expr(self.arena.borrow_mut().function(function, &arguments))
    }

    /// The name that the symbol was declared with.
    pub fn name(&self, symbol: Symbol) -> String {
        self.arena.borrow().symbols[symbol.index()].name.clone()
    }

    /// The stage that the symbol was declared with.
    pub fn stage_of(&self, symbol: Symbol) -> Stage {
        self.arena.borrow().symbols[symbol.index()].stage
    }

    /// The expression that is this symbol.
    pub fn expr_of(&self, symbol: Symbol) -> Expr<'_> {
        self.expr(self.arena.borrow().symbols[symbol.index()].id)
    }

    /// The number of nodes.
    #[expect(clippy::len_without_is_empty, reason = "a graph always holds 0 and 1")]
    pub fn len(&self) -> usize {
        self.arena.borrow().len()
    }

    /// The number of nodes and of their operands, to which memory and the work of one pass over the
    /// graph are proportional.
    pub fn size(&self) -> usize {
        self.arena.borrow().size()
    }

    /// Bounds the [size](Dag::size): every new node beyond it is undefined, and
    /// [`is_exhausted`](Dag::is_exhausted) is true from then on. Existing nodes stay. A later call
    /// replaces the bound; `usize::MAX` lifts it.
    ///
    /// ```
    /// use lagrangian_symbolic::{Dag, Stage};
    ///
    /// let dag = Dag::new();
    /// let mut x = dag.symbol("x", Stage(3));
    /// dag.set_limit(dag.size() + 100);
    /// for _ in 0..1000 {
    ///     x = x.sin();
    /// }
    /// assert!(dag.is_exhausted() && x.is_undefined());
    /// ```
    pub fn set_limit(&self, limit: usize) {
        self.arena.borrow_mut().set_limit(limit);
    }

    /// Whether a node was requested beyond the [limit](Dag::set_limit).
    pub fn is_exhausted(&self) -> bool {
        self.arena.borrow().exhausted
    }

    /// Every node, in order of construction.
    pub fn ids(&self) -> impl Iterator<Item = Id> + use<> {
        (0..self.len()).map(|index| Id(index as u32))
    }

    /// A handle on a node of this graph.
    pub fn expr(&self, id: Id) -> Expr<'_> {
        Expr::new(self, id)
    }

    /// The content of a node.
    pub fn node(&self, id: Id) -> Node {
        self.arena.borrow().node(id).clone()
    }
}

impl Default for Dag {
    fn default() -> Dag {
        Dag::new()
    }
}

impl fmt::Debug for Dag {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Dag({} nodes)", self.len())
    }
}

/// An expression: a node of a [`Dag`]. Two expressions are equal exactly if they are the same node.
///
/// An operation takes expressions of the same graph only.
#[derive(Clone, Copy)]
pub struct Expr<'d> {
    dag: &'d Dag,
    id: Id,
}

impl<'d> Expr<'d> {
    pub(crate) fn new(dag: &'d Dag, id: Id) -> Expr<'d> {
        Expr { dag, id }
    }

    /// The node.
    pub fn id(self) -> Id {
        self.id
    }

    /// The graph.
    pub fn dag(self) -> &'d Dag {
        self.dag
    }

    /// The content of the node.
    pub fn node(self) -> Node {
        self.dag.node(self.id)
    }

    /// The stage at which the value becomes known.
    pub fn stage(self) -> Stage {
        self.dag.arena.borrow().stage(self.id)
    }

    /// The symbol, if the expression is one.
    pub fn as_symbol(self) -> Option<Symbol> {
        match self.dag.arena.borrow().node(self.id) {
            Node::Symbol(symbol) => Some(*symbol),
            _ => None,
        }
    }

    /// The value, if it is a rational constant.
    pub fn as_constant(self) -> Option<Rational> {
        match self.dag.arena.borrow().node(self.id) {
            Node::Constant(value) => Some(value.clone()),
            _ => None,
        }
    }

    /// Whether it is the constant 0.
    pub fn is_zero(self) -> bool {
        self.id == Arena::ZERO
    }

    /// Whether it is the constant 1.
    pub fn is_one(self) -> bool {
        self.id == Arena::ONE
    }

    /// Whether it is undefined: something in it divides by 0, takes a root or a logarithm that does
    /// not exist, or needs a constant of more than [`MAX_BITS`](crate::MAX_BITS) bits.
    pub fn is_undefined(self) -> bool {
        self.id == Arena::UNDEFINED
    }

    /// Whether the symbol occurs in it.
    pub fn depends_on(self, symbol: Symbol) -> bool {
        let arena = self.dag.arena.borrow();
        let mask = Arena::symbol_mask(symbol);
        let target = arena.symbols[symbol.index()].id;
        let mut below = arena.reachable([self.id].into_iter(), |id| arena.touches(id, mask));
        below.retain(|&id| id == target);
        !below.is_empty()
    }

    /// Every symbol that occurs in it.
    pub fn symbols(self) -> BTreeSet<Symbol> {
        let arena = self.dag.arena.borrow();
        let below = arena.reachable([self.id].into_iter(), |id| arena.touches(id, u64::MAX));
        let symbol = |id: Id| match arena.node(id) {
            Node::Symbol(symbol) => Some(*symbol),
            _ => None,
        };
        below.into_iter().filter_map(symbol).collect()
    }

    /// The expression that `build` creates in the arena of the graph.
    pub(crate) fn with(self, build: impl FnOnce(&mut Arena) -> Id) -> Expr<'d> {
        Expr {
            dag: self.dag,
            id: build(&mut self.dag.arena.borrow_mut()),
        }
    }
}

impl PartialEq for Expr<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id && core::ptr::eq(self.dag, other.dag)
    }
}

impl Eq for Expr<'_> {}

impl Hash for Expr<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.id.hash(state);
    }
}

/// Every node that the roots are built from, themselves included, children before parents.
pub fn reachable(dag: &Dag, roots: &[Expr<'_>]) -> Vec<Id> {
    let arena = dag.arena.borrow();
    arena.reachable(roots.iter().map(|root| root.id()), |_| true)
}
