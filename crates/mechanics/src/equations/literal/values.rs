//! The values of expressions along a motion.

use lagrangian_scalar::{Dual, Scalar};
use lagrangian_symbolic::{Expr, Id};
use rustc_hash::FxHashMap;

/// The values of expressions along a motion, with their rates.
///
/// The equations ask for values by a type of their own, and not by closures: they would be compiled again for each closure.
pub(super) struct Values<'m, S> {
    /// The index of each expression.
    pub places: &'m FxHashMap<Id, usize>,
    pub values: Vec<Dual<S>>,
}

impl<S: Scalar> Values<'_, S> {
    /// The value of an expression, with its rate.
    pub fn at(&self, e: Expr<'_>) -> Dual<S> {
        self.values[self.places[&e.id()]]
    }

    /// The value of an expression.
    pub fn value(&self, e: Expr<'_>) -> S {
        self.at(e).value
    }

    /// The rate of an expression.
    pub fn rate(&self, e: Expr<'_>) -> S {
        self.at(e).derivative
    }

    /// The components of a vector, with their rates.
    pub fn vector<const N: usize>(&self, e: &[Expr<'_>]) -> [Dual<S>; N] {
        let mut vector = [Dual::<S>::ZERO; N];
        for (k, &e) in e.iter().enumerate() {
            vector[k] = self.at(e);
        }
        vector
    }
}
