//! The graph of expressions, and what is simplified while it is built.
//!
//! One arena holds every node once, however often it is used. A node's children are older than the
//! node, so the order of [`Id`]s is a topological order and everything computed in that order is
//! deterministic.
//!
//! # Normal form
//!
//! Done when a node is built, because it is cheap and always a gain:
//!
//! - exact arithmetic on constants; `0·x = 0`, `x^0 = 1`;
//! - like terms among the *direct* terms of a sum, like factors of a product: `x/x = 1`, as
//!   rational functions, that is away from `x = 0`;
//! - `p₁·X + p₂·X = (p₁ + p₂)·X` where `p` is of parameter stage, so that composite masses appear
//!   by themselves; what the `p` have in common stays outside: `(m₁ + m₂)·l·X`;
//! - multiples of π out of the sums in a sum: `q₂ + (q₁ − π/2) = (q₂ + q₁) − π/2`;
//! - `A·sin²x + A·cos²x = A`; signs out of odd and even functions: `sin(−x) = −sin x`, `cos(−x) =
//!   cos x`; quarter turns out of angles: `sin(x + π/2) = cos x`; `tan x = sin x/cos x`;
//! - exact values: `sin(π/6) = 1/2`, `sqrt(4/9) = 2/3`, `exp(0) = 1`; and `sqrt(x)² = x`, `|x|² =
//!   x²`, where the left side is defined;
//! - terms and factors in order of age.
//!
//! Never done here: flattening a sum into a sum (only a one-term multiple is absorbed),
//! distributing a product, expanding or joining angles, `sqrt(x²) = x`. A chain of links is short
//! as long as the position of one link is *one* term in the position of the next; expanding would
//! destroy that.
//!
//! # What has no value
//!
//! Constructors do not panic. `1/0`, `ln(0)`, `sqrt(−1)` and constants beyond
//! [`MAX_BITS`](crate::MAX_BITS) give the one node [`Dag::undefined`]. Whatever is built from it is
//! that node again, so that [`Expr::is_undefined`] on a result is all a caller has to ask.

use core::cell::RefCell;
use core::fmt;
use std::rc::Rc;

use crate::arena::{Arena, BitSet};
use crate::expr::Expr;
use crate::rational::Rational;

/// A node of a [`Dag`]. Children have smaller ids than what is built from them.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Id(pub(crate) u32);

impl Id {
    /// The position in the arena: 0, 1, 2, … in order of construction.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A symbol of a [`Dag`]: an index into its table of symbols.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Symbol(pub(crate) u32);

impl Symbol {
    /// The position in the table: 0, 1, 2, … in order of declaration.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// When a value becomes known. The stage of an expression is the latest stage of its parts.
///
/// The algebra gives meaning to two of them only; later ones belong to who uses it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Stage(pub u8);

impl Stage {
    /// Known while deriving.
    pub const CONSTANT: Stage = Stage(0);
    /// Known before anything runs, and the same all the time.
    pub const PARAMETER: Stage = Stage(1);
}

/// A function of one or two arguments.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Function {
    /// Sine.
    Sin,
    /// Cosine.
    Cos,
    /// Tangent; rewritten to sin/cos when built.
    Tan,
    /// Inverse sine.
    Asin,
    /// Inverse cosine.
    Acos,
    /// Inverse tangent.
    Atan,
    /// `atan2(y, x)`: the angle of the point (x, y).
    Atan2,
    /// Hyperbolic sine.
    Sinh,
    /// Hyperbolic cosine.
    Cosh,
    /// Hyperbolic tangent.
    Tanh,
    /// e to a power.
    Exp,
    /// Natural logarithm.
    Ln,
    /// Square root.
    Sqrt,
    /// Absolute value.
    Abs,
    /// −1, 0 or 1.
    Sign,
    /// The smaller of two.
    Min,
    /// The larger of two.
    Max,
    /// `pow(x, y)` with an exponent that is no integer constant.
    Pow,
}

impl Function {
    /// Every function.
    pub const ALL: [Function; 18] = [
        Function::Sin,
        Function::Cos,
        Function::Tan,
        Function::Asin,
        Function::Acos,
        Function::Atan,
        Function::Atan2,
        Function::Sinh,
        Function::Cosh,
        Function::Tanh,
        Function::Exp,
        Function::Ln,
        Function::Sqrt,
        Function::Abs,
        Function::Sign,
        Function::Min,
        Function::Max,
        Function::Pow,
    ];

    /// The name, as in a spec; `pow` stands for the operator `^`.
    pub fn name(self) -> &'static str {
        match self {
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Tan => "tan",
            Function::Asin => "asin",
            Function::Acos => "acos",
            Function::Atan => "atan",
            Function::Atan2 => "atan2",
            Function::Sinh => "sinh",
            Function::Cosh => "cosh",
            Function::Tanh => "tanh",
            Function::Exp => "exp",
            Function::Ln => "ln",
            Function::Sqrt => "sqrt",
            Function::Abs => "abs",
            Function::Sign => "sign",
            Function::Min => "min",
            Function::Max => "max",
            Function::Pow => "pow",
        }
    }

    /// How many arguments it takes.
    pub fn arity(self) -> usize {
        match self {
            Function::Atan2 | Function::Min | Function::Max | Function::Pow => 2,
            _ => 1,
        }
    }
}

/// What a node is. Cheap to clone.
#[derive(Clone, PartialEq, Debug)]
pub enum Node {
    /// A rational number.
    Constant(Rational),
    /// π.
    Pi,
    /// A symbol.
    Symbol(Symbol),
    /// `Σ coefficient·term`, by id, coefficients not 0; the constant term is a multiple of the node
    /// `1`. A single term with a coefficient other than 1 is a rational multiple.
    Sum(Rc<[(Id, Rational)]>),
    /// `Π factor^power`, by id, powers not 0, no constants among the factors; quotients are
    /// negative powers. The one product with a constant in it is `0^-1`, the undefined value.
    Product(Rc<[(Id, i32)]>),
    /// A function of its arguments.
    Function(Function, Rc<[Id]>),
}

impl Node {
    /// What it holds: its children, and the machine words of numbers that do not fit into one.
    pub(crate) fn operands(&self) -> usize {
        match self {
            Node::Constant(value) => value.words(),
            Node::Pi | Node::Symbol(_) => 0,
            Node::Sum(terms) => terms.iter().map(|(_, c)| 1 + c.words()).sum(),
            Node::Product(factors) => factors.len(),
            Node::Function(_, arguments) => arguments.len(),
        }
    }

    /// Calls `visit` with every child.
    pub fn for_each_child(&self, mut visit: impl FnMut(Id)) {
        match self {
            Node::Constant(_) | Node::Pi | Node::Symbol(_) => {}
            Node::Sum(terms) => terms.iter().for_each(|&(id, _)| visit(id)),
            Node::Product(factors) => factors.iter().for_each(|&(id, _)| visit(id)),
            Node::Function(_, arguments) => arguments.iter().for_each(|&id| visit(id)),
        }
    }
}

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

    /// A new symbol, different from all others, even of the same name.
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

    /// What has no value: `1/0`, and everything built from it.
    pub fn undefined(&self) -> Expr<'_> {
        self.expr(Arena::UNDEFINED)
    }

    /// The sum; like terms merge among these terms. Prefer it to a row of `+`, which nests.
    pub fn sum<'d>(&'d self, terms: impl IntoIterator<Item = Expr<'d>>) -> Expr<'d> {
        let terms: Vec<_> = terms
            .into_iter()
            .map(|term| (term.id(), Rational::ONE))
            .collect();
        self.expr(self.arena.borrow_mut().sum(&terms))
    }

    /// The product; like factors merge. Prefer it to a row of `*` where there are many factors.
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

    /// The number of nodes and of their operands: what memory, and the work of one pass over the
    /// graph, are proportional to.
    pub fn size(&self) -> usize {
        self.arena.borrow().size()
    }

    /// Bounds the [size](Dag::size): whatever new node is asked for beyond it is undefined, and
    /// [`is_exhausted`](Dag::is_exhausted) says so from then on. What stands already stays as it is.
    /// A later call replaces the bound; `usize::MAX` lifts it.
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

    /// Whether a node was asked for beyond the [limit](Dag::set_limit).
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

    /// What a node is.
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

/// Every node that the roots are built from, themselves included, children before parents.
pub fn reachable(dag: &Dag, roots: &[Expr<'_>]) -> Vec<Id> {
    let arena = dag.arena.borrow();
    arena.reachable(roots.iter().map(|root| root.id()), |_| true)
}

impl Arena {
    /// What the roots are built from, in order of age, without what lies below a node that is not
    /// to be entered.
    pub(crate) fn reachable(
        &self,
        roots: impl Iterator<Item = Id>,
        enter: impl Fn(Id) -> bool,
    ) -> Vec<Id> {
        let mut seen = BitSet::new(self.len());
        let mut found: Vec<Id> = roots
            .filter(|&root| enter(root) && seen.insert(root))
            .collect();
        let mut next = 0;
        while let Some(&id) = found.get(next) {
            next += 1;
            self.node(id).for_each_child(|child| {
                if enter(child) && seen.insert(child) {
                    found.push(child);
                }
            });
        }
        found.sort_unstable();
        found
    }
}
