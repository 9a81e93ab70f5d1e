//! The budget of a search, counted in evaluations and not timed, so that a search gives the same result on any computer.

use std::cell::Cell;

use lagrangian_scalar::Scalar;

use super::Terrain;
use crate::solution::Contact;

/// The remaining budget of a search, in evaluations of inertia or resistance. An evaluation over dual numbers counts once
/// for each real component of such a number.
#[derive(Debug)]
pub struct Budget {
    most: Cell<u64>,
    spent: Cell<u64>,
}

impl Budget {
    pub fn new(most: u64) -> Budget {
        Budget {
            most: Cell::new(most),
            spent: Cell::new(0),
        }
    }

    /// Sets the total budget.
    pub fn allow(&self, most: u64) {
        self.most.set(most);
    }

    /// The budget spent so far.
    pub fn spent(&self) -> u64 {
        self.spent.get()
    }

    /// Whether the budget is exhausted, so that no further work may start.
    pub fn is_spent(&self) -> bool {
        self.spent() >= self.most.get()
    }

    fn take<N>(&self) {
        let numbers = core::mem::size_of::<N>() / core::mem::size_of::<f64>();
        self.spent.set(self.spent() + numbers.max(1) as u64);
    }
}

/// A machine that counts its evaluations.
#[derive(Debug)]
pub struct Counted<'a, T> {
    terrain: &'a T,
    pub budget: &'a Budget,
}

impl<'a, T> Counted<'a, T> {
    pub fn new(terrain: &'a T, budget: &'a Budget) -> Self {
        Counted { terrain, budget }
    }

    /// The machine itself.
    pub fn uncounted(&self) -> &'a T {
        self.terrain
    }
}

impl<T> Clone for Counted<'_, T> {
    fn clone(&self) -> Self {
        Counted { ..*self }
    }
}

impl<T: Terrain> Terrain for Counted<'_, T> {
    fn coordinates(&self) -> usize {
        self.terrain.coordinates()
    }

    fn inertia<N: Scalar>(&self, q: &[N]) -> Vec<N> {
        self.budget.take::<N>();
        self.terrain.inertia(q)
    }

    fn resistance<N: Scalar>(&self, q: &[N], v: &[N]) -> Vec<N> {
        self.budget.take::<N>();
        self.terrain.resistance(q, v)
    }

    fn mass(&self, q: &[f64]) -> Vec<f64> {
        self.terrain.mass(q)
    }

    fn guides(&self) -> Vec<String> {
        self.terrain.guides()
    }

    fn contacts(&self, q: &[f64], v: &[f64], a: &[f64]) -> (Vec<Contact>, f64) {
        self.terrain.contacts(q, v, a)
    }
}
