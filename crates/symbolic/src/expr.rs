//! Handles on expressions, with the usual operators.

use core::fmt;
use core::hash::{Hash, Hasher};
use core::ops::{Add, Div, Mul, Neg, Sub};
use std::collections::BTreeSet;

use crate::arena::Arena;
use crate::calculus::Tangent;
use crate::dag::{Dag, Function, Id, Node, Stage, Symbol};
use crate::rational::Rational;

/// An expression: a node of a [`Dag`]. Two of them are equal exactly if they are one node.
///
/// An operation takes expressions of one graph only.
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

    /// What the node is.
    pub fn node(self) -> Node {
        self.dag.node(self.id)
    }

    /// When the value becomes known.
    pub fn stage(self) -> Stage {
        self.dag.arena.borrow().stage(self.id)
    }

    /// The symbol, if that is all.
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

    /// Whether it has no value: something in it divides by 0, takes a root or a logarithm that does
    /// not exist, or needs a constant of more than [`MAX_BITS`](crate::MAX_BITS) bits.
    pub fn is_undefined(self) -> bool {
        self.id == Arena::UNDEFINED
    }

    /// The quotient; `None` if it has no value.
    pub fn checked_div(self, divisor: Expr<'d>) -> Option<Expr<'d>> {
        let quotient = self / divisor;
        (!quotient.is_undefined()).then_some(quotient)
    }

    /// Sine.
    pub fn sin(self) -> Expr<'d> {
        self.apply(Function::Sin)
    }
    /// Cosine.
    pub fn cos(self) -> Expr<'d> {
        self.apply(Function::Cos)
    }
    /// Tangent.
    pub fn tan(self) -> Expr<'d> {
        self.apply(Function::Tan)
    }
    /// Inverse sine.
    pub fn asin(self) -> Expr<'d> {
        self.apply(Function::Asin)
    }
    /// Inverse cosine.
    pub fn acos(self) -> Expr<'d> {
        self.apply(Function::Acos)
    }
    /// Inverse tangent.
    pub fn atan(self) -> Expr<'d> {
        self.apply(Function::Atan)
    }
    /// Hyperbolic sine.
    pub fn sinh(self) -> Expr<'d> {
        self.apply(Function::Sinh)
    }
    /// Hyperbolic cosine.
    pub fn cosh(self) -> Expr<'d> {
        self.apply(Function::Cosh)
    }
    /// Hyperbolic tangent.
    pub fn tanh(self) -> Expr<'d> {
        self.apply(Function::Tanh)
    }
    /// e to this power.
    pub fn exp(self) -> Expr<'d> {
        self.apply(Function::Exp)
    }
    /// Natural logarithm.
    pub fn ln(self) -> Expr<'d> {
        self.apply(Function::Ln)
    }
    /// Square root.
    pub fn sqrt(self) -> Expr<'d> {
        self.apply(Function::Sqrt)
    }
    /// Absolute value.
    pub fn abs(self) -> Expr<'d> {
        self.apply(Function::Abs)
    }
    /// −1, 0 or 1.
    pub fn sign(self) -> Expr<'d> {
        self.apply(Function::Sign)
    }
    /// The angle of the point (`x`, `self`).
    pub fn atan2(self, x: Expr<'d>) -> Expr<'d> {
        self.apply_with(Function::Atan2, x)
    }
    /// The smaller of the two.
    pub fn min(self, other: Expr<'d>) -> Expr<'d> {
        self.apply_with(Function::Min, other)
    }
    /// The larger of the two.
    pub fn max(self, other: Expr<'d>) -> Expr<'d> {
        self.apply_with(Function::Max, other)
    }
    /// A power with any exponent.
    pub fn pow(self, exponent: Expr<'d>) -> Expr<'d> {
        self.apply_with(Function::Pow, exponent)
    }
    /// An integer power.
    pub fn powi(self, exponent: i32) -> Expr<'d> {
        self.with(|arena| arena.product(&[(self.id, exponent)]))
    }
    /// `self²`.
    pub fn square(self) -> Expr<'d> {
        self.powi(2)
    }

    /// The partial derivative with respect to a symbol.
    ///
    /// A [`Tangent`] is better where many expressions share their parts.
    pub fn diff(self, symbol: Symbol) -> Expr<'d> {
        Tangent::new(self.dag, &[(symbol, self.dag.one())]).of(self)
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

    fn apply(self, function: Function) -> Expr<'d> {
        self.with(|arena| arena.function(function, &[self.id]))
    }

    fn apply_with(self, function: Function, second: Expr<'d>) -> Expr<'d> {
        self.with(|arena| arena.function(function, &[self.id, second.id]))
    }

    fn with(self, build: impl FnOnce(&mut Arena) -> Id) -> Expr<'d> {
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

/// The node and, unless it fills pages, what it stands for.
impl fmt::Debug for Expr<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.size() {
            0..200 => write!(f, "#{}: {self}", self.id.index()),
            size => write!(
                f,
                "#{}: {size} symbols, numbers and operations",
                self.id.index()
            ),
        }
    }
}

impl<'d> Add for Expr<'d> {
    type Output = Expr<'d>;
    fn add(self, other: Expr<'d>) -> Expr<'d> {
        self.with(|arena| arena.sum(&[(self.id, Rational::ONE), (other.id, Rational::ONE)]))
    }
}

impl<'d> Sub for Expr<'d> {
    type Output = Expr<'d>;
    fn sub(self, other: Expr<'d>) -> Expr<'d> {
        self.with(|arena| arena.sum(&[(self.id, Rational::ONE), (other.id, Rational::MINUS_ONE)]))
    }
}

impl<'d> Mul for Expr<'d> {
    type Output = Expr<'d>;
    fn mul(self, other: Expr<'d>) -> Expr<'d> {
        self.with(|arena| arena.product(&[(self.id, 1), (other.id, 1)]))
    }
}

impl<'d> Div for Expr<'d> {
    type Output = Expr<'d>;
    fn div(self, other: Expr<'d>) -> Expr<'d> {
        self.with(|arena| arena.product(&[(self.id, 1), (other.id, -1)]))
    }
}

impl<'d> Neg for Expr<'d> {
    type Output = Expr<'d>;
    fn neg(self) -> Expr<'d> {
        self.with(|arena| arena.scaled(Rational::MINUS_ONE, self.id))
    }
}

// Constants on either side, by the operators above.
macro_rules! with_constants {
    ($($Operator:ident $operator:ident),*) => { $(
        impl<'d> $Operator<Rational> for Expr<'d> {
            type Output = Expr<'d>;
            fn $operator(self, other: Rational) -> Expr<'d> {
                self.$operator(self.dag.constant(other))
            }
        }
        impl<'d> $Operator<i64> for Expr<'d> {
            type Output = Expr<'d>;
            fn $operator(self, other: i64) -> Expr<'d> {
                self.$operator(self.dag.int(other))
            }
        }
        impl<'d> $Operator<Expr<'d>> for Rational {
            type Output = Expr<'d>;
            fn $operator(self, other: Expr<'d>) -> Expr<'d> {
                other.dag.constant(self).$operator(other)
            }
        }
        impl<'d> $Operator<Expr<'d>> for i64 {
            type Output = Expr<'d>;
            fn $operator(self, other: Expr<'d>) -> Expr<'d> {
                other.dag.int(self).$operator(other)
            }
        }
    )* };
}
with_constants!(Add add, Sub sub, Mul mul, Div div);
