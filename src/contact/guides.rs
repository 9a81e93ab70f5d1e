//! Guides beside unilateral contacts: their reactions.
//!
//! A guide is a pair of opposite contacts without play, of which at most one presses. It has no displacement along its normal, so no row of `W` gives its normal
//! force. Instead its reaction is known as a linear form of the accelerations, the forces and the multipliers `λ` of the constraints:
//!
//! ```text
//! N = ν + ρ·a + χ·λ + κ·F,      M a = f + Wᵀ F + Gᵀ λ
//! ```
//!
//! With `G z = χ`, the multipliers can be eliminated: `χ·λ = z·(M a − f − Wᵀ F)`, and
//!
//! ```text
//! N = ν − z·f + (ρ + M z)·a + (κ − W z)·F
//! ```
//!
//! In problems of contacts the row of its normal is that of `c N`, where c is the inverse mass along its tangent, so that it is an acceleration like all others;
//! nothing acts along the normal itself, whose column has only the `c` of the far side, see [`problem`](super::problem). For impulses the same holds
//! without ν and f: `N` of an impact is `ρ·Δv + χ·Λ_G + κ·Λ`.

use std::vec::Vec;

use super::delassus::Inertia;
use super::lcp;
use crate::at::At;
use crate::constraints::algebra::dot;
use crate::{Pivot, Singular, System, Vector};

/// The largest residual of the coefficients of multipliers in the rows of the constraints, relative to the largest coefficient, and the largest change of a reaction by
/// undetermined forces, relative to its terms, with which a reaction counts as determined. Otherwise it depends on how constraints or contacts share their load.
const DETERMINED: f64 = 1e-9;

/// What the reactions of guides are made of at a state.
#[derive(Clone, Debug, Default)]
pub(super) struct Guides {
    /// The index of the first one among the contacts; the others follow it.
    first: usize,
    count: usize,
    /// Twice the number of contacts, and the number of coordinates.
    directions: usize,
    coordinates: usize,
    /// For each guide `ρ + M z`, `κ − W z` and `z`, row after row; `z` only with constraints.
    by_accelerations: Vec<f64>,
    by_forces: Vec<f64>,
    of_constraints: Vec<f64>,
    /// `ν − z·f`.
    loads: Vec<f64>,
    /// Memory for the matrix of the machine, and for an image.
    numbers: Vec<f64>,
    image: Vec<f64>,
}

impl Guides {
    /// Evaluates what accelerations and forces do. `rows` are those of all directions of contacts.
    ///
    /// # Errors
    /// If a reaction depends on how constraints that depend on each other share their load.
    pub fn evaluate<'r, S: System>(
        &mut self,
        system: &S,
        (t, q): (f64, &S::Vector),
        row: impl Fn(usize) -> &'r [f64],
    ) -> Result<(), Singular> {
        self.count = system.guides();
        if self.count == 0 {
            return Ok(());
        }
        let (n, m) = (q.as_slice().len(), system.constraints().len());
        let contacts = system.unilateral_contacts().len();
        self.first = contacts - self.count.min(contacts);
        (self.coordinates, self.directions) = (n, 2 * contacts);
        let width = n + m + self.directions;
        self.numbers.clear();
        self.numbers.resize(self.count * width, 0.0);
        system.guide_matrix(t, q, &mut self.numbers);
        self.by_accelerations.clear();
        self.by_forces.clear();
        for own in self.numbers.chunks_exact(width) {
            self.by_accelerations.extend_from_slice(&own[..n]);
            self.by_forces.extend_from_slice(&own[n + m..]);
        }
        if m > 0 {
            self.leave_out_multipliers(system, (t, q), row)?;
        }
        Ok(())
    }

    /// Replaces the multipliers by the forces that they balance.
    fn leave_out_multipliers<'r, S: System>(
        &mut self,
        system: &S,
        (t, q): (f64, &S::Vector),
        row: impl Fn(usize) -> &'r [f64],
    ) -> Result<(), Singular> {
        let (n, m) = (self.coordinates, system.constraints().len());
        let width = n + m + self.directions;
        let mut constraints = std::vec![0.0; m * n];
        system.constraint_matrix(t, q, &mut constraints);
        let mut mass = S::Matrix::zeros(n * n);
        system.mass_matrix(t, q, &mut mass);
        let of = |k: usize| &constraints[k * n..][..n];
        self.of_constraints.clear();
        for guide in 0..self.count {
            let by_multipliers = &self.numbers[guide * width + n..][..m];
            let mut products: Vec<f64> = (0..m * m).map(|k| dot(of(k / m), of(k % m))).collect();
            let (shares, _) = lcp::solve(&mut products, &mut by_multipliers.to_vec());
            let mut z = std::vec![0.0; n];
            for (k, share) in shares.iter().enumerate() {
                z.iter_mut().zip(of(k)).for_each(|(z, g)| *z += share * g);
            }
            let most = by_multipliers
                .iter()
                .fold(0.0_f64, |most, x| most.max(x.abs()));
            let is_met = |k: usize| (dot(of(k), &z) - by_multipliers[k]).abs() <= DETERMINED * most;
            if !(0..m).all(is_met) {
                return Err(Singular {
                    at: Pivot::Contact(self.first + guide),
                    ratio: f64::INFINITY,
                });
            }
            let own = &mut self.by_accelerations[guide * n..][..n];
            for (own, row) in own.iter_mut().zip(mass.as_slice().chunks_exact(n)) {
                *own += dot(row, &z);
            }
            let own = &mut self.by_forces[guide * self.directions..][..self.directions];
            for (direction, own) in own.iter_mut().enumerate() {
                *own -= dot(row(direction), &z);
            }
            self.of_constraints.extend(z);
        }
        Ok(())
    }

    /// Evaluates what there is without accelerations and forces of contacts, after the rest.
    pub fn evaluate_loads<S: System>(&mut self, system: &S, At { t, q, v, u }: At<'_, S>) {
        self.loads.clear();
        self.loads.resize(self.count, 0.0);
        if self.count == 0 {
            return;
        }
        system.guide_loads(t, q, v, u, &mut self.loads);
        if system.constraints().len() == 0 {
            return;
        }
        let mut forces = q.zeros_like();
        system.forces(t, q, v, u, &mut forces);
        let of_each = self.of_constraints.chunks_exact(self.coordinates);
        for (load, z) in self.loads.iter_mut().zip(of_each) {
            *load -= dot(z, forces.as_slice());
        }
    }

    /// Whether there are any.
    pub fn are_there(&self) -> bool {
        self.count > 0
    }

    /// Whether this contact is one.
    pub fn has(&self, contact: usize) -> bool {
        self.guide(contact).is_some()
    }

    /// The number of a guide among the guides, if this contact is one.
    fn guide(&self, contact: usize) -> Option<usize> {
        let guide = contact.checked_sub(self.first)?;
        (guide < self.count).then_some(guide)
    }

    /// Writes the rows of the normals of guides among `contacts` into the products `g` of their images, which are the rows that nothing acts along.
    pub fn complete(
        &mut self,
        inertia: &Inertia,
        contacts: &[usize],
        images: &[Vec<f64>],
        g: &mut [f64],
    ) {
        let width = 2 * contacts.len();
        for (place, &k) in contacts.iter().enumerate() {
            let Some(guide) = self.guide(k) else {
                continue;
            };
            let n = self.coordinates;
            let own = &self.by_accelerations[guide * n..][..n];
            inertia.write_image(own, &mut self.image);
            let by_forces = &self.by_forces[guide * self.directions..][..self.directions];
            let tangent = g[(2 * place + 1) * width + 2 * place + 1];
            let unit = if tangent > 0.0 { tangent } else { 1.0 };
            for (column, entry) in g[2 * place * width..][..width].iter_mut().enumerate() {
                let direction = 2 * contacts[column / 2] + column % 2;
                let by_force = dot(&self.image, &images[column]) + by_forces[direction];
                *entry = unit * by_force;
            }
            g[2 * place * width + 2 * place] = unit;
        }
    }

    /// The impulse of the reaction of a guide over a step of length `h` in which forces alone change the rates of coordinates by `change`, in N s; 0 of other
    /// contacts.
    pub fn impulse_of_forces(&self, contact: usize, change: &[f64], h: f64) -> f64 {
        let Some(guide) = self.guide(contact) else {
            return 0.0;
        };
        let n = self.coordinates;
        h * self.loads[guide] + dot(&self.by_accelerations[guide * n..][..n], change)
    }

    /// By how much forces of some contacts that change no acceleration change the reaction of a guide, in N; 0 of other contacts.
    pub fn change(&self, contact: usize, contacts: &[usize], forces: &[[f64; 2]]) -> f64 {
        let Some(guide) = self.guide(contact) else {
            return 0.0;
        };
        let own = &self.by_forces[guide * self.directions..][..self.directions];
        let of_contact = contacts.iter().flat_map(|k| &own[2 * k..2 * k + 2]);
        let terms = of_contact.zip(forces.as_flattened()).map(|(x, y)| x * y);
        let [sum, size] = terms.fold([0.0; 2], |[sum, size], term: f64| {
            [sum + term, size + term.abs()]
        });
        if sum.abs() > DETERMINED * size {
            sum
        } else {
            0.0
        }
    }

    /// The reaction of a guide with these accelerations and these forces of all contacts, along normals and tangents, and the size of its terms, in N.
    pub fn reaction(&self, contact: usize, a: &[f64], forces: &[[f64; 2]]) -> [f64; 2] {
        let Some(guide) = self.guide(contact) else {
            return [0.0; 2];
        };
        let load = self.loads[guide];
        let n = self.coordinates;
        let by_accelerations = self.by_accelerations[guide * n..][..n].iter().zip(a);
        let by_forces = self.by_forces[guide * self.directions..][..self.directions].iter();
        let by_forces = by_forces.zip(forces.as_flattened());
        let terms = by_accelerations.chain(by_forces).map(|(x, y)| x * y);
        let start = [load, load.abs()];
        terms.fold(start, |[sum, size], term| [sum + term, size + term.abs()])
    }
}
