//! Equations as somebody printed them, held against the derived ones.
//!
//! Whether a printed formula agrees is decided in the prime field, at points that leave no doubt;
//! only one that does not is written out term by term, to say what to add and what to drop, and
//! which of these are one term with a slip in it. An equation of motion may be printed times or
//! over any factor of parameters, and a potential energy may differ by a constant: neither changes
//! the motion. Equations (E23), (E24) of `docs/equations.md`.

mod brackets;
mod changes;
mod wording;

use lagrangian_scalar::{DoubleDouble, Scalar};
use lagrangian_symbolic::normal::Difference;
use lagrangian_symbolic::{Dag, Expr, Function, Node, evaluate, reachable};

use lagrangian_mechanics::Equations;
use lagrangian_spec::diagnostic::Diagnostic;
use lagrangian_spec::identity;
use lagrangian_spec::model::{Model, PrintedTerm, PublishedItem, PublishedQuantity, stage};
use lagrangian_spec::source::Span;

/// The most terms that a formula is written out in, to say which of them are wrong; a longer one is
/// replaced as a whole.
const BUDGET: usize = 5000;

/// What became of one printed formula.
#[derive(Clone, Debug)]
pub struct Comparison<'d> {
    /// The title of the block.
    pub block: String,
    /// The item, as the spec writes its head: `kinetic_energy mortar`.
    pub item: String,
    /// Where the spec says it.
    pub span: Span,
    /// Whether it is right.
    pub agrees: bool,
    /// What mends it: one difference for each component of a vector, and one for everything else.
    pub mend: Vec<Difference<'d>>,
    /// Where the print adds what has different units.
    pub remarks: Vec<Diagnostic>,
    /// Rates of what has none, for which it is meant itself: `der(m0)` for `m0`. The other mends hold
    /// with these in place.
    pub undotted: Vec<Undotted>,
    /// The terms as they stand in the print, for each component.
    printed: Vec<Vec<PrintedTerm<'d>>>,
}

/// A term of a print, quoted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quoted {
    /// As the spec writes it, with the sign that it has on its side.
    pub text: String,
    /// Whether it stands, or is to stand, right of the equals sign.
    pub on_the_right: bool,
}

/// A dot too much, over what does not change, so that a term is zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Undotted {
    /// As printed: `der(m0)`.
    pub from: String,
    /// As it should be: `m0`.
    pub to: String,
    /// The term without the dot, all terms brought to the left of an equals sign.
    pub term: String,
}

impl<'d> Comparison<'d> {
    /// Whether something stands right of an equals sign, so that it is to be said where terms are.
    pub fn has_two_sides(&self) -> bool {
        let mut terms = self.printed.iter().flatten();
        terms.any(|term| term.on_the_right && term.value().is_some_and(|value| !value.is_zero()))
    }

    /// The terms to add and the terms to drop, each on the side of the equals sign on which it
    /// stands, or on which what it replaces does; any other on the left.
    pub fn terms(&self) -> [Vec<Quoted>; 2] {
        self.words(true)
    }

    /// The terms to add to what is printed, all brought to the left of an equals sign, as the spec
    /// writes them; terms of a vector as vectors: `(0, e*sin(phi))`.
    pub fn add(&self) -> Vec<String> {
        let [add, _] = self.words(false);
        add.into_iter().map(|term| term.text).collect()
    }

    /// The terms to drop from what is printed: as they stand there, where they do.
    pub fn drop(&self) -> Vec<String> {
        let [_, drop] = self.words(false);
        drop.into_iter().map(|term| term.text).collect()
    }

    /// Which of the terms to drop becomes which of the terms to add by a slip or two: their places
    /// in [`Self::drop`] and [`Self::add`], where they stand as well. By the rule in the
    /// documentation of `compare/changes.rs`.
    pub fn changes(&self) -> Vec<(usize, usize)> {
        let (mut dropped, mut added) = (0, 0);
        let mut all = Vec::new();
        for mend in &self.mend {
            let pairs = changes::pairs(&mend.drop, &mend.add).into_iter();
            all.extend(pairs.map(|(i, j)| (dropped + i, added + j)));
            dropped += mend.drop.len();
            added += mend.add.len();
        }
        all
    }

    fn words(&self, own_sides: bool) -> [Vec<Quoted>; 2] {
        let dimension = self.mend.len();
        let mut all = [Vec::new(), Vec::new()];
        for (position, mend) in self.mend.iter().enumerate() {
            let printed = self.printed.get(position).map_or(&[][..], Vec::as_slice);
            let pairs = changes::pairs(&mend.drop, &mend.add);
            let words = wording::words(mend, &pairs, printed, own_sides);
            for (all, words) in all.iter_mut().zip(words) {
                all.extend(words.into_iter().map(|mut term| {
                    if dimension > 1 {
                        let component = |k| {
                            if k == position {
                                term.text.as_str()
                            } else {
                                "0"
                            }
                        };
                        let components = (0..dimension).map(component).collect::<Vec<_>>();
                        term.text = format!("({})", components.join(", "));
                    }
                    term
                }));
            }
        }
        all
    }
}

/// Holds everything that a machine publishes against its equations, in the order of the spec.
pub fn compare<'d>(model: &Model<'d>, equations: &Equations<'d>) -> Vec<Comparison<'d>> {
    let mut comparisons = Vec::new();
    for block in &model.published {
        comparisons.extend(block.items.iter().map(|item| {
            let (mend, undotted) = without_dots(model, equations, item);
            Comparison {
                block: block.title.clone(),
                item: item.text.clone(),
                span: item.span,
                agrees: undotted.is_empty() && mend.iter().all(Difference::is_empty),
                mend,
                undotted,
                remarks: item.remarks.clone(),
                printed: item.terms.clone(),
            }
        }));
    }
    comparisons
}

/// What mends a printed formula, after those dots over parameters are taken away without which less
/// is to be mended.
fn without_dots<'d>(
    model: &Model<'d>,
    equations: &Equations<'d>,
    item: &PublishedItem<'d>,
) -> (Vec<Difference<'d>>, Vec<Undotted>) {
    let mut item = item.clone();
    let mut mends = mend(model, equations, &item);
    let mut undotted = Vec::new();
    let count = |mends: &[Difference<'d>]| -> usize {
        mends.iter().map(|m| m.add.len() + m.drop.len()).sum()
    };
    for component in 0..item.terms.len() {
        for place in 0..item.terms[component].len() {
            let Some((found, term)) = without_dot(model, &item.terms[component][place]) else {
                continue;
            };
            let mut candidate = item.clone();
            let Some(value) = term.value() else { continue };
            candidate.printed[component] = candidate.printed[component] + value;
            let fewer = mend(model, equations, &candidate);
            if count(&fewer) < count(&mends) {
                undotted.push(found);
                (item, mends) = (candidate, fewer);
            }
        }
    }
    (mends, undotted)
}

/// A term that is zero because of one dot over a parameter, without that dot.
fn without_dot<'d>(
    model: &Model<'d>,
    term: &PrintedTerm<'d>,
) -> Option<(Undotted, PrintedTerm<'d>)> {
    let mut zeros = term.factors.iter().enumerate();
    let (place, factor) = zeros.find(|(_, factor)| factor.value.is_zero())?;
    let name = factor.text.strip_prefix("der(")?.strip_suffix(')')?;
    let mut parameters = model.parameters.iter();
    let parameter = parameters.find(|parameter| parameter.name.to_string() == name)?;
    let mut mended = term.clone();
    mended.factors[place].value = parameter.symbol;
    name.clone_into(&mut mended.factors[place].text);
    let undotted = Undotted {
        from: factor.text.clone(),
        to: name.to_owned(),
        term: mended.text(),
    };
    let is_zero = mended.value().is_none_or(|value| value.is_zero());
    (!factor.divides && !is_zero).then_some((undotted, mended))
}

/// What mends a printed formula, component by component.
fn mend<'d>(
    model: &Model<'d>,
    equations: &Equations<'d>,
    item: &PublishedItem<'d>,
) -> Vec<Difference<'d>> {
    let right = match item.quantity {
        PublishedQuantity::KineticEnergy(None) => vec![equations.kinetic_energy],
        PublishedQuantity::KineticEnergy(Some(body)) => vec![equations.bodies[body].kinetic_energy],
        PublishedQuantity::PotentialEnergy => {
            return vec![mend_potential(equations.potential_energy, item.printed[0])];
        }
        PublishedQuantity::Dissipation => vec![equations.dissipation],
        PublishedQuantity::Force(coordinate) => vec![equations.applied[coordinate]],
        PublishedQuantity::Friction(coordinate) => {
            vec![equations.sliding_friction(model, coordinate)]
        }
        PublishedQuantity::Position(body) => equations.bodies[body].position.clone(),
        PublishedQuantity::Velocity(body) => equations.bodies[body].velocity.clone(),
        PublishedQuantity::Equation(coordinate) => {
            return vec![mend_equation(model, equations, coordinate, item.printed[0])];
        }
    };
    let pairs = right.into_iter().zip(&item.printed);
    pairs
        .map(|(right, &printed)| mend_formula(right, printed))
        .collect()
}

/// A formula is what it is.
fn mend_formula<'d>(right: Expr<'d>, printed: Expr<'d>) -> Difference<'d> {
    if equal(right, printed) {
        return Difference {
            add: Vec::new(),
            drop: Vec::new(),
        };
    }
    match brackets::difference(printed, right, BUDGET) {
        Some(difference) if !difference.is_empty() => difference,
        _ => Difference {
            add: vec![right],
            drop: vec![printed],
        },
    }
}

/// A potential energy is what it is up to a constant, eq. (E24).
fn mend_potential<'d>(right: Expr<'d>, printed: Expr<'d>) -> Difference<'d> {
    if identity::is_free_of_motion(printed - right) {
        return Difference {
            add: Vec::new(),
            drop: Vec::new(),
        };
    }
    let mut difference = mend_formula(right, printed);
    for terms in [&mut difference.add, &mut difference.drop] {
        terms.retain(|term| term.stage() > stage::PARAMETER);
    }
    difference
}

/// An equation `M a + h − Q = 0` is what it is, times any factor of parameters, eq. (E23).
fn mend_equation<'d>(
    model: &Model<'d>,
    equations: &Equations<'d>,
    coordinate: usize,
    printed: Expr<'d>,
) -> Difference<'d> {
    let dag = model.dag;
    let inertia = model.coordinates.iter().enumerate();
    let inertia = inertia.map(|(j, c)| *equations.mass_matrix.get(coordinate, j) * c.a);
    let others = [
        equations.bias[coordinate],
        -equations.applied[coordinate],
        -equations.sliding_friction(model, coordinate),
    ];
    let right = dag.sum(inertia.chain(others));
    let factor = printed / right;
    if identity::is_free_of_motion(factor) && !equal(printed, dag.zero()) {
        return Difference {
            add: Vec::new(),
            drop: Vec::new(),
        };
    }
    let factor = common_factor(model, equations, coordinate, printed);
    mend_formula(factor * right, printed)
}

/// The factor by which most accelerations of a printed equation differ from the derived one.
fn common_factor<'d>(
    model: &Model<'d>,
    equations: &Equations<'d>,
    coordinate: usize,
    printed: Expr<'d>,
) -> Expr<'d> {
    let mut factors: Vec<(usize, Expr<'d>)> = Vec::new();
    for (j, c) in model.coordinates.iter().enumerate() {
        let right = *equations.mass_matrix.get(coordinate, j);
        let ratio = c.a.as_symbol().map(|a| printed.diff(a) / right);
        let ratio = ratio.and_then(identity::as_function_of_parameters);
        let Some(ratio) = ratio.filter(|&ratio| !equal(ratio, model.dag.zero())) else {
            continue; // not printed, or not in proportion
        };
        match factors.iter_mut().find(|(_, known)| equal(*known, ratio)) {
            Some((votes, _)) => *votes += 1,
            None => factors.push((1, ratio)),
        }
    }
    // The first of those with the most votes.
    let best = factors.into_iter().rev().max_by_key(|(votes, _)| *votes);
    let one = model.dag.one();
    match best {
        Some((_, factor)) if equal(factor, one) => one,
        Some((_, factor)) if equal(factor, -one) => -one,
        Some((_, factor)) => factor,
        None => one,
    }
}

/// Whether two formulas are equal: exactly, in the prime field; or, for logarithms and the like, of
/// which the field knows no theorems, numerically.
fn equal(a: Expr<'_>, b: Expr<'_>) -> bool {
    match identity::equal(a, b) {
        Some(equal) => equal || (is_transcendental(a.dag(), &[a, b]) && nearly_equal(a, b)),
        None => nearly_equal(a, b),
    }
}

/// Whether functions stand in the formulas that are opaque to the prime field.
fn is_transcendental(dag: &Dag, formulas: &[Expr<'_>]) -> bool {
    use Function::{Cosh, Exp, Ln, Pow, Sinh, Sqrt, Tanh};
    reachable(dag, formulas)
        .into_iter()
        .any(|id| match dag.node(id) {
            Node::Function(function, _) => {
                matches!(function, Cosh | Exp | Ln | Pow | Sinh | Sqrt | Tanh)
            }
            _ => false,
        })
}

/// Whether two formulas have the same values at some points, all symbols between ½ and 1½, to 20 of
/// 30 digits.
fn nearly_equal(a: Expr<'_>, b: Expr<'_>) -> bool {
    const POINTS: u32 = 64;
    let tolerance = DoubleDouble::from_f64(1e-20);
    let mut compared = 0;
    for point in 0..POINTS {
        let value = |symbol| DoubleDouble::from_f64(identity::number(point, symbol));
        let values = evaluate(a.dag(), &[a, b], value);
        if !values.iter().all(|value| value.is_finite()) {
            continue;
        }
        let (a, b) = (values[0], values[1]);
        if (a - b).abs().exceeds(tolerance * (a.abs() + b.abs())) {
            return false;
        }
        compared += 1;
    }
    2 * compared > POINTS
}
