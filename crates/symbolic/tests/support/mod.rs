//! Random formulas kept as plain trees, with which the results of the graph are compared.
#![allow(dead_code, reason = "each test uses its part")]

pub mod markup;
pub mod parser;

use lagrangian_scalar::{Residue, Scalar};
use lagrangian_symbolic::{Dag, Expr, Function, Rational, Stage, Symbol};

/// G. L. Steele, D. Lea and C. H. Flood, *Fast splittable pseudorandom number generators*, OOPSLA
/// 2014.
pub struct SplitMix(pub u64);

impl SplitMix {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    /// Uniform in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn choose<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }
}

/// A formula as written, without simplification.
#[derive(Clone, Debug)]
pub enum Tree {
    Symbol(usize),
    Constant(i64, i64),
    Pi,
    Sum(Vec<(Tree, i64)>),
    Product(Vec<Tree>),
    Quotient(Box<Tree>, Box<Tree>),
    Power(Box<Tree>, i32),
    Call(Function, Vec<Tree>),
}

/// Two parameters, then four that change.
pub const SYMBOLS: [(&str, Stage); 6] = [
    ("m", Stage::PARAMETER),
    ("k", Stage::PARAMETER),
    ("x", Stage(3)),
    ("y", Stage(3)),
    ("u", Stage(4)),
    ("w", Stage(4)),
];

/// Functions for which [`Residue`] has equations.
pub const SMOOTH: [Function; 5] = [
    Function::Sin,
    Function::Cos,
    Function::Sin,
    Function::Cos,
    Function::Tan,
];

/// Every function, with the smooth ones twice as often.
pub fn all_functions() -> Vec<Function> {
    Function::ALL.into_iter().chain(SMOOTH).collect()
}

impl Tree {
    /// A random formula of at most this depth; it has few symbols, so that like terms occur.
    pub fn random(random: &mut SplitMix, depth: usize, functions: &[Function]) -> Tree {
        let below = |random: &mut SplitMix| Tree::random(random, depth - 1, functions);
        if depth == 0 || random.below(8) == 0 {
            return match random.below(10) {
                0 if !functions.is_empty() => Tree::Pi,
                1 | 2 => Tree::Constant(
                    random.choose(&[-2, -1, 0, 1, 2, 3]),
                    random.choose(&[1, 1, 2]),
                ),
                _ => Tree::Symbol(random.below(SYMBOLS.len())),
            };
        }
        match random.below(10) {
            0..=2 => {
                let count = 2 + random.below(4);
                let term = |_| (below(random), random.choose(&[1, 1, -1, 2]));
                Tree::Sum((0..count).map(term).collect())
            }
            3..=5 => {
                let count = 2 + random.below(3);
                Tree::Product((0..count).map(|_| below(random)).collect())
            }
            6 => Tree::Quotient(Box::new(below(random)), Box::new(below(random))),
            7 => Tree::Power(
                Box::new(below(random)),
                random.choose(&[2, 2, 3, -1, -2, 0]),
            ),
            8 if !functions.is_empty() => {
                // A·sin²x ± A·cos²x among other terms.
                let (a, x) = (below(random), Tree::random(random, depth - 1, &[]));
                let square = |f| Tree::Power(Box::new(Tree::Call(f, vec![x.clone()])), 2);
                let term = |f| Tree::Product(vec![a.clone(), square(f)]);
                let sign = random.choose(&[1, 1, -1]);
                Tree::Sum(vec![
                    (term(Function::Sin), 1),
                    (below(random), 1),
                    (term(Function::Cos), sign),
                ])
            }
            _ if functions.is_empty() => below(random),
            _ => {
                // A residue cannot be an angle if it contains sines or quotients by π, and treats
                // functions of constants as opaque.
                let function = random.choose(functions);
                let argument = |_| match function {
                    Function::Sin | Function::Cos | Function::Tan => {
                        let angle = Tree::random(random, depth - 1, &[]);
                        let half_turns = Tree::Constant(random.choose(&[0, 0, 0, -3, 1, 2]), 2);
                        Tree::Sum(vec![
                            (angle, 1),
                            (Tree::Product(vec![half_turns, Tree::Pi]), 1),
                        ])
                    }
                    _ => {
                        let symbol = Tree::Symbol(random.below(SYMBOLS.len()));
                        Tree::Sum(vec![(below(random), 1), (symbol, 5)])
                    }
                };
                Tree::Call(function, (0..function.arity()).map(argument).collect())
            }
        }
    }

    pub fn build<'d>(&self, dag: &'d Dag, symbols: &[Expr<'d>]) -> Expr<'d> {
        match self {
            Tree::Symbol(index) => symbols[*index],
            Tree::Constant(n, d) => dag.constant(Rational::new(*n, *d).expect("not over 0")),
            Tree::Pi => dag.pi(),
            // Alternates between chains of operators and n-ary constructors.
            Tree::Sum(terms) if terms.len() % 2 == 0 => {
                dag.sum(terms.iter().map(|(x, c)| *c * x.build(dag, symbols)))
            }
            Tree::Sum(terms) => terms.iter().fold(dag.zero(), |sum, (x, c)| {
                let x = x.build(dag, symbols);
                if *c == -1 { sum - x } else { sum + *c * x }
            }),
            Tree::Product(factors) => dag.product(factors.iter().map(|x| x.build(dag, symbols))),
            Tree::Quotient(a, b) => a.build(dag, symbols) / b.build(dag, symbols),
            Tree::Power(x, n) => x.build(dag, symbols).powi(*n),
            Tree::Call(f, arguments) => {
                let arguments: Vec<_> = arguments.iter().map(|x| x.build(dag, symbols)).collect();
                dag.function(*f, &arguments)
            }
        }
    }

    pub fn value<N: Number>(&self, symbols: &[N]) -> N {
        match self {
            Tree::Symbol(index) => symbols[*index],
            Tree::Constant(n, d) => N::ratio(*n, *d),
            Tree::Pi => N::pi(),
            Tree::Sum(terms) => {
                let term = |(x, c): &(Tree, i64)| N::ratio(*c, 1).times(x.value(symbols));
                terms.iter().map(term).fold(N::ratio(0, 1), N::plus)
            }
            Tree::Product(factors) => factors
                .iter()
                .map(|x| x.value(symbols))
                .fold(N::ratio(1, 1), N::times),
            Tree::Quotient(a, b) => a.value(symbols).over(b.value(symbols)),
            Tree::Power(x, n) => {
                let x = x.value(symbols);
                // 1 + 0·x: an undefined value is undefined also to the power 0.
                let one = N::ratio(1, 1).plus(N::ratio(0, 1).times(x));
                let power = (0..n.abs()).fold(one, |power, _| power.times(x));
                if *n < 0 {
                    N::ratio(1, 1).over(power)
                } else {
                    power
                }
            }
            Tree::Call(f, arguments) => {
                let x = arguments[0].value(symbols);
                N::call(*f, x, arguments.get(1).map_or(x, |y| y.value(symbols)))
            }
        }
    }
}

/// The numbers over which a tree is evaluated.
pub trait Number: Copy {
    fn ratio(n: i64, d: i64) -> Self;
    fn pi() -> Self;
    fn plus(self, other: Self) -> Self;
    fn times(self, other: Self) -> Self;
    fn over(self, other: Self) -> Self;
    fn call(f: Function, x: Self, y: Self) -> Self;
}

/// Makes the result undefined if an intermediate value is infinite: 1/(1/0) is not 0.
fn settle<S: Scalar>(x: S) -> S {
    if x.is_finite() { x } else { x * S::ZERO }
}

impl<S: Scalar> Number for S {
    fn ratio(n: i64, d: i64) -> S {
        S::from_ratio(n, d)
    }
    fn pi() -> S {
        S::pi()
    }
    fn plus(self, other: S) -> S {
        settle(self + other)
    }
    fn times(self, other: S) -> S {
        settle(self * other)
    }
    fn over(self, other: S) -> S {
        settle(self / other)
    }
    fn call(f: Function, x: S, y: S) -> S {
        settle(match f {
            Function::Sin => x.sin(),
            Function::Cos => x.cos(),
            Function::Tan => x.sin() / x.cos(),
            Function::Asin => x.asin(),
            Function::Acos => x.acos(),
            Function::Atan => x.atan(),
            Function::Atan2 => x.atan2(y),
            Function::Sinh => x.sinh(),
            Function::Cosh => x.cosh(),
            Function::Tanh => x.tanh(),
            Function::Exp => x.exp(),
            Function::Ln => x.ln(),
            Function::Sqrt => x.sqrt(),
            Function::Abs => x.abs(),
            Function::Sign => x.sign(),
            Function::Min => x.min(y),
            Function::Max => x.max(y),
            Function::Pow => x.powf(y),
        })
    }
}

/// A value and its derivative, by the textbook rules.
#[derive(Clone, Copy, Debug)]
pub struct Slope {
    pub value: Residue,
    pub slope: Residue,
}

impl Number for Slope {
    fn ratio(n: i64, d: i64) -> Slope {
        Slope {
            value: Residue::from_ratio(n, d),
            slope: Residue::ZERO,
        }
    }
    fn pi() -> Slope {
        Slope {
            value: <Residue as Number>::pi(),
            slope: Residue::ZERO,
        }
    }
    fn plus(self, b: Slope) -> Slope {
        Slope {
            value: self.value + b.value,
            slope: self.slope + b.slope,
        }
    }
    fn times(self, b: Slope) -> Slope {
        Slope {
            value: self.value * b.value,
            slope: self.slope * b.value + self.value * b.slope,
        }
    }
    fn over(self, b: Slope) -> Slope {
        let value = self.value / b.value;
        Slope {
            value,
            slope: (self.slope - value * b.slope) / b.value,
        }
    }
    fn call(f: Function, x: Slope, y: Slope) -> Slope {
        let one = Residue::ONE;
        let value = <Residue as Number>::call(f, x.value, y.value);
        let slope = match f {
            Function::Sin => x.value.cos() * x.slope,
            Function::Cos => -x.value.sin() * x.slope,
            Function::Tan => (one + value * value) * x.slope,
            Function::Asin => x.slope / (one - x.value * x.value).sqrt(),
            Function::Acos => -x.slope / (one - x.value * x.value).sqrt(),
            Function::Atan => x.slope / (one + x.value * x.value),
            Function::Atan2 => {
                let square = x.value * x.value + y.value * y.value;
                (y.value * x.slope - x.value * y.slope) / square
            }
            Function::Sinh => x.value.cosh() * x.slope,
            Function::Cosh => x.value.sinh() * x.slope,
            Function::Tanh => (one - value * value) * x.slope,
            Function::Exp => value * x.slope,
            Function::Ln => x.slope / x.value,
            Function::Sqrt => x.slope / (value + value),
            _ => panic!("no smooth function: {f:?}"),
        };
        Slope { value, slope }
    }
}

pub fn symbols(dag: &Dag) -> Vec<Expr<'_>> {
    SYMBOLS
        .iter()
        .map(|(name, stage)| dag.symbol(name, *stage))
        .collect()
}

/// The value of every symbol in one trial.
pub fn residues(seed: u64) -> Vec<Residue> {
    (0..SYMBOLS.len())
        .map(|index| Residue::random(seed, index as u64))
        .collect()
}

pub fn residue(dag: &Dag, e: Expr<'_>, seed: u64) -> Residue {
    lagrangian_symbolic::evaluate(dag, &[e], |s: Symbol| {
        Residue::random(seed, s.index() as u64)
    })[0]
}

/// Whether two expressions have the same value at a point where both have one.
pub fn same(dag: &Dag, a: Expr<'_>, b: Expr<'_>) -> Option<bool> {
    (0..40).find_map(|seed| {
        let (a, b) = (residue(dag, a, seed), residue(dag, b, seed));
        (a.is_finite() && b.is_finite()).then_some(a == b)
    })
}
