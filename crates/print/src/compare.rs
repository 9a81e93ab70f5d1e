//! Published equations, compared with the derived ones.
//!
//! Whether a printed formula agrees is decided in the prime field, at enough points to leave no doubt. Only one that
//! disagrees is expanded term by term, to report which terms to add and which to drop, and which pairs of these are one
//! term with a misprint. An equation of motion may be multiplied or divided by any factor of parameters, and a potential
//! energy may differ by a constant: neither changes the motion. Equations (E23), (E24) of `docs/equations.md`.

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

/// The most terms to which a formula is expanded to find wrong terms; a longer one is reported as a whole.
const BUDGET: usize = 5000;

/// The result of comparing one printed formula.
#[derive(Clone, Debug)]
pub struct Comparison<'d> {
    /// The title of the block.
    pub block: String,
    /// The item, as the spec writes its head: `kinetic_energy mortar`.
    pub item: String,
    /// Its place in the spec.
    pub span: Span,
    /// Whether it agrees.
    pub agrees: bool,
    /// The corrections: one difference for each component of a vector, and one for anything else.
    pub corrections: Vec<Difference<'d>>,
    /// Warnings about printed sums of different units.
    pub remarks: Vec<Diagnostic>,
    /// Dots that must be removed because the quantity is constant: `m0` for `der(m0)`. The other corrections assume
    /// that these have been removed.
    pub superfluous_dots: Vec<SuperfluousDot>,
    /// The terms as printed, for each component.
    printed: Vec<Vec<PrintedTerm<'d>>>,
}

/// A quoted term of a printed formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quoted {
    /// The term as the spec writes it, with the sign that it has on its side.
    pub text: String,
    /// Whether it is, or should be, right of the equals sign.
    pub on_the_right: bool,
}

/// A superfluous dot over a constant, which makes a term zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SuperfluousDot {
    /// As printed: `der(m0)`.
    pub from: String,
    /// The corrected form: `m0`.
    pub to: String,
    /// The term without the dot, with all terms on the left of the equals sign.
    pub term: String,
}

impl<'d> Comparison<'d> {
    /// Whether a term is right of an equals sign, so that reports must state the side of each term.
    pub fn has_two_sides(&self) -> bool {
        let mut terms = self.printed.iter().flatten();
        terms.any(|term| term.on_the_right && term.value().is_some_and(|value| !value.is_zero()))
    }

    /// The terms to add and the terms to drop. Each is given for the side of the equals sign on which it is
    /// printed, or on which the term that it replaces is printed; otherwise for the left side.
    pub fn terms(&self) -> [Vec<Quoted>; 2] {
        self.words(true)
    }

    /// The terms to add to the printed formula with all terms on the left of the equals sign, as the spec writes
    /// them; terms of a vector as vectors: `(0, e*sin(phi))`.
    pub fn add(&self) -> Vec<String> {
        let [add, _] = self.words(false);
        add.into_iter().map(|term| term.text).collect()
    }

    /// The terms to drop from the printed formula, quoted as printed where possible.
    pub fn drop(&self) -> Vec<String> {
        let [_, drop] = self.words(false);
        drop.into_iter().map(|term| term.text).collect()
    }

    /// Which terms to drop turn into which terms to add by one or two misprints: their indices in [`Self::drop`]
    /// and [`Self::add`], which contain them as well. The documentation of `compare/changes.rs` defines the rule.
    pub fn changes(&self) -> Vec<(usize, usize)> {
        let (mut dropped, mut added) = (0, 0);
        let mut all = Vec::new();
        for mend in &self.corrections {
            let pairs = changes::pairs(&mend.drop, &mend.add).into_iter();
            all.extend(pairs.map(|(i, j)| (dropped + i, added + j)));
            dropped += mend.drop.len();
            added += mend.add.len();
        }
        all
    }

    fn words(&self, own_sides: bool) -> [Vec<Quoted>; 2] {
        let dimension = self.corrections.len();
        let mut all = [Vec::new(), Vec::new()];
        for (position, mend) in self.corrections.iter().enumerate() {
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

/// Compares all published formulas of a machine with its equations, in the order of the spec.
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
                corrections: mend,
                superfluous_dots: undotted,
                remarks: item.remarks.clone(),
                printed: item.terms.clone(),
            }
        }));
    }
    comparisons
}

/// The corrections of a printed formula, after removing those dots over parameters whose removal leaves less to correct.
fn without_dots<'d>(
    model: &Model<'d>,
    equations: &Equations<'d>,
    item: &PublishedItem<'d>,
) -> (Vec<Difference<'d>>, Vec<SuperfluousDot>) {
    let mut item = item.clone();
    let mut mends = corrections(model, equations, &item);
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
            let fewer = corrections(model, equations, &candidate);
            if count(&fewer) < count(&mends) {
                undotted.push(found);
                (item, mends) = (candidate, fewer);
            }
        }
    }
    (mends, undotted)
}

/// A term that vanishes because of one dot over a parameter, with that dot removed.
fn without_dot<'d>(
    model: &Model<'d>,
    term: &PrintedTerm<'d>,
) -> Option<(SuperfluousDot, PrintedTerm<'d>)> {
    let mut zeros = term.factors.iter().enumerate();
    let (place, factor) = zeros.find(|(_, factor)| factor.value.is_zero())?;
    let name = factor.text.strip_prefix("der(")?.strip_suffix(')')?;
    let mut parameters = model.parameters.iter();
    let parameter = parameters.find(|parameter| parameter.name.to_string() == name)?;
    let mut mended = term.clone();
    mended.factors[place].value = parameter.symbol;
    name.clone_into(&mut mended.factors[place].text);
    let undotted = SuperfluousDot {
        from: factor.text.clone(),
        to: name.to_owned(),
        term: mended.text(),
    };
    let is_zero = mended.value().is_none_or(|value| value.is_zero());
    (!factor.divides && !is_zero).then_some((undotted, mended))
}

/// The corrections of a printed formula, component by component.
fn corrections<'d>(
    model: &Model<'d>,
    equations: &Equations<'d>,
    item: &PublishedItem<'d>,
) -> Vec<Difference<'d>> {
    let right = match item.quantity {
        PublishedQuantity::KineticEnergy(None) => vec![equations.kinetic_energy],
        PublishedQuantity::KineticEnergy(Some(body)) => vec![equations.bodies[body].kinetic_energy],
        PublishedQuantity::PotentialEnergy => {
            return vec![potential_correction(
                equations.potential_energy,
                item.printed[0],
            )];
        }
        PublishedQuantity::Dissipation => vec![equations.dissipation],
        PublishedQuantity::Force(coordinate) => vec![equations.applied[coordinate]],
        PublishedQuantity::Friction(coordinate) => {
            vec![equations.sliding_friction(model, coordinate)]
        }
        PublishedQuantity::Position(body) => equations.bodies[body].position.clone(),
        PublishedQuantity::Velocity(body) => equations.bodies[body].velocity.clone(),
        PublishedQuantity::Equation(coordinate) => {
            return vec![equation_correction(
                model,
                equations,
                coordinate,
                item.printed[0],
            )];
        }
    };
    let pairs = right.into_iter().zip(&item.printed);
    pairs
        .map(|(right, &printed)| formula_correction(right, printed))
        .collect()
}

/// The correction of a formula that must agree exactly.
fn formula_correction<'d>(right: Expr<'d>, printed: Expr<'d>) -> Difference<'d> {
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

/// The correction of a potential energy, which may differ by a constant, eq. (E24).
fn potential_correction<'d>(right: Expr<'d>, printed: Expr<'d>) -> Difference<'d> {
    if identity::is_free_of_motion(printed - right) {
        return Difference {
            add: Vec::new(),
            drop: Vec::new(),
        };
    }
    let mut difference = formula_correction(right, printed);
    for terms in [&mut difference.add, &mut difference.drop] {
        terms.retain(|term| term.stage() > stage::PARAMETER);
    }
    difference
}

/// The correction of an equation `M a + h − Q = 0`, which may have any factor of parameters, eq. (E23).
fn equation_correction<'d>(
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
    formula_correction(factor * right, printed)
}

/// The factor between a printed equation and the derived one for which most accelerations agree.
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
            continue; // not printed, or not proportional
        };
        match factors.iter_mut().find(|(_, known)| equal(*known, ratio)) {
            Some((votes, _)) => *votes += 1,
            None => factors.push((1, ratio)),
        }
    }
    // The first of the factors with the most votes.
    let best = factors.into_iter().rev().max_by_key(|(votes, _)| *votes);
    let one = model.dag.one();
    match best {
        Some((_, factor)) if equal(factor, one) => one,
        Some((_, factor)) if equal(factor, -one) => -one,
        Some((_, factor)) => factor,
        None => one,
    }
}

/// Whether two formulas are equal: exactly, in the prime field, or numerically if they contain functions such as
/// logarithms, whose identities the field does not have.
fn equal(a: Expr<'_>, b: Expr<'_>) -> bool {
    match identity::equal(a, b) {
        Some(equal) => equal || (is_transcendental(a.dag(), &[a, b]) && nearly_equal(a, b)),
        None => nearly_equal(a, b),
    }
}

/// Whether the formulas contain functions that are opaque to the prime field.
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

/// Whether two formulas have the same values at some points, with all symbols between ½ and 1½, to 20 of 30 digits.
fn nearly_equal(a: Expr<'_>, b: Expr<'_>) -> bool {
    const POINTS: u32 = 64;
    let tolerance = DoubleDouble::from_f64(1e-20);
    let mut compared = 0;
    for point in 0..POINTS {
        let value = |symbol| DoubleDouble::from_f64(identity::sample_value(point, symbol));
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
