//! Prints expressions as a person would write them.
//!
//! [`text`] is valid in the spec language, and reading it back gives the same node. [`math`] is for
//! the page, and may rearrange: it gives `cos(φ₂ − φ₁)` if the graph has the products. Its result is
//! a [`Math`], which [`latex`] and [`mathml`] print.
//!
//! Order of factors: numbers, parameters, coordinates, functions, rates; on the page functions come
//! last, since `sin φ ṡ` may be read as the sine of a product. Order of terms: by the latest symbols
//! in them, higher powers first, in the order in which the symbols were declared; a positive term
//! comes first if there is one.
//!
//! Shared parts of the graph are written out every time they occur, so a long chain gives a very long
//! text; [`Expr::size`] tells its length beforehand. No function here is recursive in the children.

mod latex;
mod layout;
mod lines;
mod math;
mod mathml;
mod names;
mod number;
mod text;
mod typeset;

use core::fmt;

use crate::dag::{Dag, Expr};
use crate::node::Symbol;
use crate::normal;

pub use latex::latex_words;
pub use math::{Form, Mark, Math, Sign};
pub use mathml::markup_words;
pub use names::{latex_name, math_name, mathml_name};

/// The names of symbols.
pub trait Names {
    /// The name in a text: an identifier, or `der(x)`.
    fn text(&self, symbol: Symbol) -> String;
    /// The name on a page, without superscripts: a power may follow.
    fn math(&self, symbol: Symbol) -> Math;
}

/// The names that the symbols were declared with; `theta1` is θ₁, see [`math_name`].
impl Names for Dag {
    fn text(&self, symbol: Symbol) -> String {
        self.name(symbol)
    }

    fn math(&self, symbol: Symbol) -> Math {
        math_name(&self.name(symbol))
    }
}

/// The expression in the spec language, exactly as it was built.
///
/// ```
/// use lagrangian_symbolic::{Dag, Stage, text};
///
/// let dag = Dag::new();
/// let (m, v) = (dag.symbol("m", Stage::PARAMETER), dag.symbol("der(x)", Stage(4)));
/// assert_eq!(text(m * v.square() / 2, &dag), "1/2*m*der(x)^2");
/// ```
pub fn text(expression: Expr<'_>, names: &dyn Names) -> String {
    let symbols = symbol_names(expression, |symbol| names.text(symbol));
    let arena = expression.dag().arena.borrow();
    text::Writer::new(&arena, &symbols).write(expression.id())
}

/// The expression for a page, with angles joined and terms collected if that makes it shorter.
pub fn math(expression: Expr<'_>, names: &dyn Names) -> Math {
    math_as_built(normal::readable(expression, normal::READABLE_BUDGET), names)
}

/// The expression for a page, exactly as it was built.
pub fn math_as_built(expression: Expr<'_>, names: &dyn Names) -> Math {
    let symbols = symbol_names(expression, |symbol| names.math(symbol));
    let arena = expression.dag().arena.borrow();
    typeset::Writer::new(&arena, &symbols).write(expression.id())
}

/// [`math()`] in LaTeX, for math mode.
///
/// ```
/// use lagrangian_symbolic::{Dag, Stage, latex};
///
/// let dag = Dag::new();
/// let (a, b) = (dag.symbol("phi1", Stage(3)), dag.symbol("phi2", Stage(3)));
/// let e = a.cos() * b.cos() + a.sin() * b.sin();
/// assert_eq!(latex(e, &dag), r"\cos\left(\varphi_{2} - \varphi_{1}\right)");
/// ```
pub fn latex(expression: Expr<'_>, names: &dyn Names) -> String {
    math(expression, names).latex()
}

/// [`math()`] as presentation MathML: an element `math` for a line of text.
///
/// ```
/// use lagrangian_symbolic::{Dag, Stage, mathml};
///
/// let dag = Dag::new();
/// let (m, v) = (dag.symbol("m", Stage::PARAMETER), dag.symbol("der(x)", Stage(4)));
/// let momentum = "<math><mi>m</mi><mo>&#x2062;</mo><mover><mi>x</mi><mo>˙</mo></mover></math>";
/// assert_eq!(mathml(m * v, &dag), momentum);
/// ```
pub fn mathml(expression: Expr<'_>, names: &dyn Names) -> String {
    math(expression, names).mathml()
}

/// As by [`text`], with the declared names.
impl fmt::Display for Expr<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&text(*self, self.dag()))
    }
}

/// The names of the symbols in an expression, by index. They are collected before the graph is
/// borrowed, since `name` may use the graph.
fn symbol_names<T: Clone + Default>(expression: Expr<'_>, name: impl Fn(Symbol) -> T) -> Vec<T> {
    let mut names = Vec::new();
    for symbol in expression.symbols() {
        names.resize(symbol.index(), T::default());
        names.push(name(symbol));
    }
    names
}
