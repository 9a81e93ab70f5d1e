//! How much a search may do, counted and not timed: the same search does the same on any computer.

use std::cell::Cell;

use lagrangian_scalar::Scalar;

use super::Terrain;
use crate::solution::Contact;

/// What a search may still do, in evaluations of inertia or resistance; over dual numbers an evaluation counts once for each
/// real number in them.
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

    /// From now on this much may be done in all.
    pub fn allow(&self, most: u64) {
        self.most.set(most);
    }

    /// How much was done.
    pub fn spent(&self) -> u64 {
        self.spent.get()
    }

    /// Whether nothing more is to be begun.
    pub fn is_spent(&self) -> bool {
        self.spent() >= self.most.get()
    }

    fn take<N>(&self) {
        let numbers = core::mem::size_of::<N>() / core::mem::size_of::<f64>();
        self.spent.set(self.spent() + numbers.max(1) as u64);
    }
}

/// A machine whose evaluations are counted.
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
