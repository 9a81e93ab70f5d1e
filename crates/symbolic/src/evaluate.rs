//! Evaluation of expressions in numbers.

use lagrangian_scalar::{DoubleDouble, Scalar};

use crate::arena::Places;
use crate::dag::{Dag, Expr};
use crate::node::{Function, Id, Node, Symbol};

/// The values of expressions, over any type of number; `value` is called once for each symbol that occurs.
///
/// ```
/// use lagrangian_symbolic::{Dag, Stage, evaluate};
///
/// let dag = Dag::new();
/// let x = dag.symbol("x", Stage(3));
/// assert_eq!(evaluate(&dag, &[x.square() + 1, x / 2], |_| 3.0), [10.0, 1.5]);
/// ```
pub fn evaluate<S: Scalar>(
    dag: &Dag,
    roots: &[Expr<'_>],
    value: impl FnMut(Symbol) -> S,
) -> Vec<S> {
    Evaluation::new(dag, roots).values(value)
}

/// Expressions that are evaluated repeatedly: the nodes that they are built from are found only once.
///
/// ```
/// use lagrangian_symbolic::{Dag, Evaluation, Stage};
///
/// let dag = Dag::new();
/// let x = dag.symbol("x", Stage(3));
/// let square = Evaluation::new(&dag, &[x.square()]);
/// assert_eq!([2.0, 3.0].map(|x| square.values(|_| x)[0]), [4.0, 9.0]);
/// ```
#[derive(Clone, Debug)]
pub struct Evaluation<'d> {
    dag: &'d Dag,
    /// The nodes that the expressions are built from, children first.
    needed: Vec<Id>,
    /// The symbols among these nodes.
    symbols: Vec<Symbol>,
    /// The index of each node among these.
    place: Places,
    /// The indices of the expressions among these.
    roots: Vec<usize>,
}

impl<'d> Evaluation<'d> {
    /// Prepares the evaluation of these expressions.
    pub fn new(dag: &'d Dag, roots: &[Expr<'_>]) -> Evaluation<'d> {
        let needed = crate::reachable(dag, roots);
        let place = Places::of(&needed);
        let roots = roots.iter();
        let roots = roots.map(|root| place.get(root.id()).unwrap_or_default());
        let symbols = needed.iter().filter_map(|&id| dag.expr(id).as_symbol());
        Evaluation {
            dag,
            symbols: symbols.collect(),
            roots: roots.collect(),
            needed,
            place,
        }
    }

    /// The symbols that occur, in the order in which [`values`](Self::values) asks for their values.
    pub fn symbols(&self) -> &[Symbol] {
        &self.symbols
    }

    /// The values of the expressions; `value` is called once for each symbol that occurs.
    pub fn values<S: Scalar>(&self, value: impl FnMut(Symbol) -> S) -> Vec<S> {
        // The symbols come first, since `value` may ask the graph for their names.
        let symbols: Vec<S> = self.symbols.iter().copied().map(value).collect();
        self.values_given(&symbols)
    }

    /// The values of the expressions, given those of the symbols. Generic over the number alone, it is compiled once for each type of
    /// number and not for each meaning of the symbols.
    fn values_given<S: Scalar>(&self, symbols: &[S]) -> Vec<S> {
        let arena = self.dag.arena.borrow();
        let mut next_symbol = 0;
        let mut values: Vec<S> = Vec::with_capacity(self.needed.len());
        for &id in &self.needed {
            let at = |child: Id| values[self.place.get(child).unwrap_or_default()];
            let value = match arena.node(id) {
                Node::Constant(value) => value.evaluate(),
                Node::Pi => S::pi(),
                Node::Symbol(_) => {
                    next_symbol += 1;
                    symbols[next_symbol - 1]
                }
                Node::Sum(terms) => {
                    let mut sum: Option<S> = None;
                    for (x, c) in terms.iter() {
                        let x = at(*x);
                        sum = Some(match (sum, c.as_integer()) {
                            (Some(sum), Some(1)) => sum + x,
                            (Some(sum), Some(-1)) => sum - x,
                            (Some(sum), _) => sum + c.evaluate::<S>() * x,
                            (None, Some(1)) => x,
                            (None, Some(-1)) => -x,
                            (None, _) => c.evaluate::<S>() * x,
                        });
                    }
                    sum.unwrap_or(S::ZERO)
                }
                Node::Product(factors) => {
                    let (mut numerator, mut denominator) = (None, None);
                    for &(x, n) in factors.iter() {
                        let power = power(at(x), n.unsigned_abs());
                        let product = match n {
                            0 => continue,
                            1.. => &mut numerator,
                            _ => &mut denominator,
                        };
                        *product = Some(match *product {
                            Some(product) => product * power,
                            None => power,
                        });
                    }
                    match (numerator, denominator) {
                        (Some(numerator), Some(denominator)) => numerator / denominator,
                        (Some(numerator), None) => numerator,
                        (None, Some(denominator)) => S::ONE / denominator,
                        (None, None) => S::ONE,
                    }
                }
                Node::Function(function, arguments) => {
                    let x = at(arguments[0]);
                    let y = if arguments.len() > 1 {
                        at(arguments[1])
                    } else {
                        x
                    };
                    apply(*function, x, y)
                }
            };
            values.push(value);
        }
        let mut results = Vec::with_capacity(self.roots.len());
        for &root in &self.roots {
            results.push(values[root]);
        }
        results
    }
}

/// The work of [`evaluate`]: nodes, operands, and the digits of numbers that do not fit into a
/// machine word, in units of about one arithmetic operation.
pub fn evaluation_work(dag: &Dag, roots: &[Expr<'_>]) -> usize {
    /// The cost of a machine word of a large coefficient, which is reduced to lowest terms.
    const WORD: usize = 20;
    let needed = crate::reachable(dag, roots);
    let arena = dag.arena.borrow();
    let digits = |value: &crate::rational::Rational| WORD * value.words();
    let each = |id: &Id| match arena.node(*id) {
        Node::Constant(value) => 1 + digits(value),
        Node::Pi | Node::Symbol(_) => 1,
        Node::Sum(terms) => terms.iter().map(|(_, c)| 1 + digits(c)).sum(),
        Node::Product(factors) => factors.len(),
        Node::Function(_, arguments) => 1 + arguments.len(),
    };
    needed.iter().map(each).sum()
}

/// The `f64` nearest to a constant, computed in twice the precision: `50*pi`, `1 - cos(0.01)`. NaN
/// if a symbol occurs or if the constant has no value.
///
/// ```
/// use lagrangian_symbolic::{Dag, nearest};
///
/// let dag = Dag::new();
/// let cube = dag.pi() * dag.pi() * dag.pi();
/// assert_eq!(nearest(cube), 31.00627668029982); // 31.006276680299820175…; in f64 alone it ends in 16
/// ```
pub fn nearest(constant: Expr<'_>) -> f64 {
    if let Some(rational) = constant.as_constant() {
        return rational.to_f64();
    }
    let value = evaluate(constant.dag(), &[constant], |_| {
        DoubleDouble::from(f64::NAN)
    })[0];
    if value.is_finite() {
        return value.to_f64();
    }
    // Beyond 2⁹⁹⁶ products of double-doubles overflow before those of f64 do.
    evaluate(constant.dag(), &[constant], |_| f64::NAN)[0]
}

/// x to a positive power.
fn power<S: Scalar>(x: S, n: u32) -> S {
    match (n, i32::try_from(n)) {
        (1, _) => x,
        (2, _) => x * x,
        (_, Ok(n)) => x.powi(n),
        // 2³¹, which does not fit into an i32.
        (_, Err(_)) => x.powi(i32::MAX) * x,
    }
}

/// The function of x, or of x and y.
fn apply<S: Scalar>(function: Function, x: S, y: S) -> S {
    match function {
        Function::Sin => x.sin(),
        Function::Cos => x.cos(),
        Function::Tan => x.tan(),
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
    }
}
