//! Nodes of expressions, with their symbols, functions and stages.

use std::rc::Rc;

use crate::rational::Rational;

/// A node of a [`Dag`](crate::Dag). Children have smaller ids than their parents.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Id(pub(crate) u32);

impl Id {
    /// The position in the arena: 0, 1, 2, … in order of construction.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A symbol of a [`Dag`](crate::Dag): an index into its table of symbols.
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
/// The algebra gives meaning to two stages only; the meaning of later ones is up to the user of the crate.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Stage(pub u8);

impl Stage {
    /// Known when the equations are derived.
    pub const CONSTANT: Stage = Stage(0);
    /// Known before a run starts, and constant during it.
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
    /// `pow(x, y)` with an exponent that is not an integer constant.
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

    /// The number of its arguments.
    pub fn arity(self) -> usize {
        match self {
            Function::Atan2 | Function::Min | Function::Max | Function::Pow => 2,
            _ => 1,
        }
    }
}

/// The content of a node. Cheap to clone.
#[derive(Clone, PartialEq, Debug)]
pub enum Node {
    /// A rational number.
    Constant(Rational),
    /// π.
    Pi,
    /// A symbol.
    Symbol(Symbol),
    /// `Σ coefficient·term`, ordered by id, with nonzero coefficients; the constant term is a multiple
    /// of the node `1`. A single term with a coefficient other than 1 is a rational multiple.
    Sum(Rc<[(Id, Rational)]>),
    /// `Π factor^power`, ordered by id, with nonzero powers and no constants among the factors; quotients
    /// are negative powers. The only product with a constant in it is `0^-1`, the undefined value.
    Product(Rc<[(Id, i32)]>),
    /// A function of its arguments.
    Function(Function, Rc<[Id]>),
}

impl Node {
    /// The number of its children, and of the machine words of numbers that do not fit into one.
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

/// A term of a sum: a node and its coefficient.
pub(crate) type Term = (Id, Rational);
/// A factor of a product: a node and its power.
pub(crate) type Factor = (Id, i32);
