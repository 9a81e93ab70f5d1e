//! Published equations, as a spec quotes them.

use lagrangian_symbolic::Expr;

use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// A block of published equations, to be compared with the derived ones.
#[derive(Clone)]
pub struct Published<'d> {
    /// The title of the block.
    pub title: String,
    /// The printed formulas.
    pub items: Vec<PublishedItem<'d>>,
    /// The place of the block.
    pub span: Span,
}

/// One printed formula.
#[derive(Clone)]
pub struct PublishedItem<'d> {
    /// The quantity that the formula gives.
    pub quantity: PublishedQuantity,
    /// The printed value, or the components of a vector. An equation is its left side minus its right side.
    pub printed: Vec<Expr<'d>>,
    /// The terms of each, as printed; none for a vector that is not printed by its components.
    pub terms: Vec<Vec<PrintedTerm<'d>>>,
    /// The item, as the spec writes its head: `kinetic_energy mortar`.
    pub text: String,
    /// Additions of different units in the printed formula. The formula is compared nevertheless: a
    /// wrong unit means that a factor was lost in print, and the comparison shows which.
    pub remarks: Vec<Diagnostic>,
    /// Its place in the spec.
    pub span: Span,
}

/// A term of a printed formula, as printed.
#[derive(Clone, Debug)]
pub struct PrintedTerm<'d> {
    /// Whether it is subtracted, after everything is brought to the left of an equals sign.
    pub negative: bool,
    /// Whether it stands to the right of an equals sign.
    pub on_the_right: bool,
    /// Its factors, in printed order.
    pub factors: Vec<PrintedFactor<'d>>,
}

/// A factor of a printed term.
#[derive(Clone, Debug)]
pub struct PrintedFactor<'d> {
    /// Its text in the spec; a sum is in brackets.
    pub text: String,
    /// Whether it stands after a slash.
    pub divides: bool,
    /// Its value.
    pub value: Expr<'d>,
}

impl<'d> PrintedTerm<'d> {
    /// Its text in the spec.
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

    /// Its value; none for a term without factors.
    pub fn value(&self) -> Option<Expr<'d>> {
        let dag = self.factors.first()?.value.dag();
        let factors = self.factors.iter();
        let factors = factors.map(|factor| factor.value.powi(if factor.divides { -1 } else { 1 }));
        let product = dag.product(factors);
        Some(if self.negative { -product } else { product })
    }
}

/// The quantity that a printed formula gives; bodies and coordinates are given by their indices.
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
    /// The generalized friction on a coordinate, from contacts that slide along their directions
    /// and press on the sides of their normals.
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
