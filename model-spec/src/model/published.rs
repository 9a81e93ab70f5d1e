//! Equations that somebody printed, as a spec quotes them.

use lagrangian_symbolic::Expr;

use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// Equations that somebody printed, to be held against the derived ones.
#[derive(Clone)]
pub struct Published<'d> {
    /// The title of the block.
    pub title: String,
    /// What was printed.
    pub items: Vec<PublishedItem<'d>>,
    /// Where the block stands.
    pub span: Span,
}

/// One printed formula.
#[derive(Clone)]
pub struct PublishedItem<'d> {
    /// What the formula is for.
    pub quantity: PublishedQuantity,
    /// What was printed: one value, or the components of a vector. An equation is its left side
    /// less its right side.
    pub printed: Vec<Expr<'d>>,
    /// The terms of each, as printed; none of a vector that is not printed by its components.
    pub terms: Vec<Vec<PrintedTerm<'d>>>,
    /// The item, as the spec writes its head: `kinetic_energy mortar`.
    pub text: String,
    /// Where the printed formula adds what cannot be added. The formula is compared all the same:
    /// whoever prints a wrong unit has lost a factor, and the comparison says which.
    pub remarks: Vec<Diagnostic>,
    /// Where the spec says it.
    pub span: Span,
}

/// A term of a printed formula, as it stands there.
#[derive(Clone, Debug)]
pub struct PrintedTerm<'d> {
    /// Whether it is subtracted, with everything brought to the left of an equals sign.
    pub negative: bool,
    /// Whether it stands right of an equals sign.
    pub on_the_right: bool,
    /// Its factors, in the order of the print.
    pub factors: Vec<PrintedFactor<'d>>,
}

/// A factor of a printed term.
#[derive(Clone, Debug)]
pub struct PrintedFactor<'d> {
    /// As the spec writes it, a sum in brackets.
    pub text: String,
    /// Whether it stands behind a slash.
    pub divides: bool,
    /// What it is.
    pub value: Expr<'d>,
}

impl<'d> PrintedTerm<'d> {
    /// As the spec writes it.
    pub fn text(&self) -> String {
        let factors = self.factors.iter();
        let factors = factors.map(|factor| (factor.text.as_str(), factor.divides));
        product(self.negative, factors)
    }

    /// This term with the other sign.
    pub fn opposite(&self) -> PrintedTerm<'d> {
        PrintedTerm {
            negative: !self.negative,
            ..self.clone()
        }
    }

    /// What it is; none for a term without factors.
    pub fn value(&self) -> Option<Expr<'d>> {
        let dag = self.factors.first()?.value.dag();
        let factors = self.factors.iter();
        let factors = factors.map(|factor| factor.value.powi(if factor.divides { -1 } else { 1 }));
        let product = dag.product(factors);
        Some(if self.negative { -product } else { product })
    }
}

/// What a printed formula is for; bodies and coordinates by their indices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PublishedQuantity {
    /// The kinetic energy of one body, or of the machine.
    KineticEnergy(Option<usize>),
    /// The potential energy.
    PotentialEnergy,
    /// The dissipation function.
    Dissipation,
    /// The applied generalized force on a coordinate.
    Force(usize),
    /// The generalized friction on a coordinate, of contacts that slide along their directions and
    /// press to their sides.
    Friction(usize),
    /// The position of a body's mass centre.
    Position(usize),
    /// The velocity of a body's mass centre.
    Velocity(usize),
    /// The equation of motion of a coordinate.
    Equation(usize),
}

/// `-a*b/c`.
pub fn product<'a>(negative: bool, factors: impl IntoIterator<Item = (&'a str, bool)>) -> String {
    let mut text = String::from(if negative { "-" } else { "" });
    for (k, (factor, divides)) in factors.into_iter().enumerate() {
        text += match (k, divides) {
            (0, false) => "",
            (0, true) => "1/",
            (_, false) => "*",
            (_, true) => "/",
        };
        text += factor;
    }
    text
}
