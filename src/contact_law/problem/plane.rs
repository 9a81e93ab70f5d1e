//! Contacts with one tangent each, as a linear complementarity problem.

use std::vec::Vec;

use super::super::lcp::{self, Unsolved, from_guess, lemke_into};
use super::{Answer, ContactUnknowns, SATURATED};

/// A problem without second tangents, as a linear complementarity problem.
pub(super) struct PlaneProblem<'a> {
    contacts: &'a [ContactUnknowns],
    g: &'a [f64],
    b: &'a [f64],
    /// The unit of rates.
    rate: f64,
    pub vectors: PlaneVectors,
}

#[derive(Clone, Debug, Default)]
pub(super) struct PlaneVectors {
    /// What is unknown: of which contact, and its kind.
    unknowns: Vec<(usize, Kind)>,
    /// Which contact has which share of the normal force of another: the contact, the other one, and the share.
    shares_of_carriers: Vec<(usize, usize, f64)>,
    /// By what rates are multiplied along tangents: a rate of rotation becomes one in the units of the contact that rolls, with the same energy.
    along_tangents: Vec<f64>,
    /// The unit of the impulses of each contact.
    unit: Vec<f64>,
    /// The matrix, row after row, and the constants.
    matrix: Vec<f64>,
    q: Vec<f64>,
    /// For each contact the place of its normal force among the unknowns.
    normals: Vec<Option<usize>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Normal,
    Forward,
    Backward,
    Slip,
}

impl<'a> PlaneProblem<'a> {
    pub fn new(
        contacts: &'a [ContactUnknowns],
        (g, b): (&'a [f64], &'a [f64]),
        mut vectors: PlaneVectors,
    ) -> Self {
        vectors.unknowns.clear();
        vectors.shares_of_carriers.clear();
        for (k, contact) in contacts.iter().enumerate() {
            if contact.has_normal() {
                vectors.unknowns.push((k, Kind::Normal));
            }
            if let ContactUnknowns::ShareOfCarrier { share, on } = contact {
                vectors.shares_of_carriers.push((k, *on, *share));
            }
            if contact.has_friction() {
                let directions = match contact {
                    // Its friction acts backwards.
                    ContactUnknowns::SlidingGuide { forward: true, .. } => &[Kind::Backward][..],
                    ContactUnknowns::SlidingGuide { .. } => &[Kind::Forward],
                    _ => &[Kind::Forward, Kind::Backward],
                };
                let kinds = directions.iter().chain(&[Kind::Slip]);
                vectors.unknowns.extend(kinds.map(|kind| (k, *kind)));
            }
        }
        let mut problem = Self {
            contacts,
            g,
            b,
            rate: 0.0,
            vectors,
        };
        let places = 0..contacts.len();
        problem.vectors.along_tangents.clear();
        for k in places.clone() {
            let multiple = problem.multiple_along_tangent(k);
            problem.vectors.along_tangents.push(multiple);
        }
        problem.rate = (b.iter().enumerate()).fold(0.0_f64, |size, (row, b)| {
            size.max((problem.multiple(row) * b).abs())
        });
        problem.vectors.unit.clear();
        for k in places {
            let unit = problem.unit_of_contact(k);
            problem.vectors.unit.push(unit);
        }
        problem
    }

    /// Whether no forces are asked for, or none are needed.
    pub fn is_trivial(&self) -> bool {
        self.rate == 0.0 || self.vectors.unknowns.is_empty()
    }

    /// Writes forces that solve the problem.
    pub fn solve(
        &mut self,
        near: Option<&[[f64; 2]]>,
        (answer, memory, guess): (&mut Answer, &mut lcp::Memory, &mut Vec<bool>),
    ) -> Result<(), Unsolved> {
        self.write_complementarity();
        let (contacts, of_problem) = (self.contacts, (self.g, self.b));
        let PlaneVectors {
            unknowns,
            matrix,
            q,
            normals,
            ..
        } = &mut self.vectors;
        let near = near.filter(|_| !contacts.iter().any(ContactUnknowns::is_guide));
        let guessed = near.and_then(|near| {
            write_positive_near(contacts, unknowns, of_problem, near, guess);
            let correct = |wrong: &[bool], guess: &mut [bool]| {
                correct(contacts, unknowns, wrong, guess, normals);
            };
            from_guess(matrix, q, guess, correct, memory)
        });
        answer.residual = match guessed {
            Some(residual) => residual,
            None => lemke_into(&self.vectors.matrix, &self.vectors.q, memory)?,
        };
        self.write_forces(&memory.z, &mut answer.forces);
        Ok(())
    }

    /// `G` in the given units.
    fn product(&self, i: usize, j: usize) -> f64 {
        self.g[i * self.b.len() + j]
    }

    fn multiple_along_tangent(&self, k: usize) -> f64 {
        match self.contacts[k] {
            ContactUnknowns::OnCarrier { on, .. } | ContactUnknowns::ShareOfCarrier { on, .. } => {
                let own = self.product(2 * k + 1, 2 * k + 1);
                let of_carrier = self.product(2 * on, 2 * on);
                if own > 0.0 && of_carrier > 0.0 {
                    (of_carrier / own).sqrt()
                } else {
                    1.0
                }
            }
            _ => 1.0,
        }
    }

    /// By what the rate of a direction is multiplied.
    fn multiple(&self, row: usize) -> f64 {
        if row.is_multiple_of(2) {
            1.0
        } else {
            self.vectors.along_tangents[row / 2]
        }
    }

    /// A contact and its tangent have one unit; rolling resistance has a direction of its own.
    fn unit_of_contact(&self, k: usize) -> f64 {
        let own = match self.contacts[k] {
            ContactUnknowns::OnCarrier { .. } => {
                self.vectors.along_tangents[k] * self.product(2 * k + 1, 2 * k + 1)
            }
            _ => self.product(2 * k, 2 * k),
        };
        if own > 0.0 { 1.0 / own } else { 1.0 }
    }

    /// What a unit of an unknown does to the rate of a direction.
    fn effect(&self, row: usize, (k, kind): (usize, Kind)) -> f64 {
        let entry = |j: usize| self.multiple(row) * self.product(row, j);
        match kind {
            Kind::Normal => {
                let share = match self.contacts[k] {
                    ContactUnknowns::Normal { share } => share,
                    _ => 0.0,
                };
                let carried = self.vectors.shares_of_carriers.iter();
                let carried = carried.filter(|(_, on, _)| *on == k);
                let carried = carried.fold(0.0, |sum, (other, _, share)| {
                    sum + share * entry(2 * other + 1)
                });
                self.vectors.unit[k] * (entry(2 * k) + share * entry(2 * k + 1) + carried)
            }
            Kind::Forward => self.vectors.unit[k] * entry(2 * k + 1),
            Kind::Backward => -self.vectors.unit[k] * entry(2 * k + 1),
            Kind::Slip => 0.0,
        }
    }

    /// The friction of a contact, the normal impulse that is known, in its unit, and of an impulse on another contact that one and how many of its units
    /// are one of these.
    fn limit(&self, k: usize) -> (f64, f64, Option<(usize, f64)>) {
        let in_units = |normal: f64| normal / (self.vectors.unit[k] * self.rate);
        match self.contacts[k] {
            ContactUnknowns::Both {
                friction,
                known_normal,
            } => (friction, in_units(known_normal), None),
            // Its own normal impulse is none, and the known one stands beside that.
            ContactUnknowns::Tangent { friction, normal } => (friction, in_units(normal), None),
            ContactUnknowns::OnCarrier {
                friction,
                known_normal,
                on,
            } => {
                let carrier = Some((on, self.vectors.unit[on] / self.vectors.unit[k]));
                (friction, in_units(known_normal), carrier)
            }
            // What presses without unknown forces, in the same unit: that of a guide is 1/c.
            ContactUnknowns::Guide { friction }
            | ContactUnknowns::SlidingGuide { friction, .. } => {
                (friction, self.b[2 * k] / self.rate, None)
            }
            ContactUnknowns::Normal { .. }
            | ContactUnknowns::Nothing
            | ContactUnknowns::ShareOfCarrier { .. }
            | ContactUnknowns::SecondTangent => (0.0, 0.0, None),
        }
    }

    /// Writes the matrix and the constants.
    fn write_complementarity(&mut self) {
        let mut matrix = core::mem::take(&mut self.vectors.matrix);
        let mut q = core::mem::take(&mut self.vectors.q);
        let unknowns = &self.vectors.unknowns;
        let n = unknowns.len();
        matrix.clear();
        matrix.resize(n * n, 0.0);
        q.clear();
        q.resize(n, 0.0);
        for (i, &(k, kind)) in unknowns.iter().enumerate() {
            let (friction, known_normal, carrier) = self.limit(k);
            let row = &mut matrix[i * n..][..n];
            for (entry, &unknown) in row.iter_mut().zip(unknowns) {
                let is_own = unknown.0 == k;
                *entry = match (kind, unknown.1) {
                    (Kind::Normal, _) => self.effect(2 * k, unknown),
                    (Kind::Slip, of) if self.contacts[k].is_guide() => {
                        // It presses on both sides: Λₙ + γₙ/c.
                        let (own_side, own_friction) = match of {
                            Kind::Normal => (f64::from(u8::from(is_own)), 0.0),
                            Kind::Slip => (0.0, 0.0),
                            _ => (0.0, f64::from(u8::from(is_own))),
                        };
                        friction * (own_side + self.effect(2 * k, unknown)) - own_friction
                    }
                    // Whatever its slip does, it slides on.
                    (
                        Kind::Forward | Kind::Backward,
                        Kind::Normal | Kind::Forward | Kind::Backward,
                    ) if self.contacts[k].slides() => 0.0,
                    (Kind::Forward | Kind::Backward, Kind::Slip) => f64::from(u8::from(is_own)),
                    (Kind::Forward, _) => self.effect(2 * k + 1, unknown),
                    (Kind::Backward, _) => -self.effect(2 * k + 1, unknown),
                    (Kind::Slip, Kind::Normal) => match carrier {
                        Some((on, units)) if on == unknown.0 => friction * units,
                        None if is_own => friction,
                        _ => 0.0,
                    },
                    (Kind::Slip, Kind::Forward | Kind::Backward) if is_own => -1.0,
                    (Kind::Slip, _) => 0.0,
                };
            }
            let along_tangent = || self.multiple(2 * k + 1) * self.b[2 * k + 1] / self.rate;
            q[i] = match kind {
                Kind::Normal => self.b[2 * k] / self.rate,
                Kind::Forward | Kind::Backward if self.contacts[k].slides() => -1.0,
                Kind::Forward => along_tangent(),
                Kind::Backward => -along_tangent(),
                Kind::Slip => friction * known_normal,
            };
        }
        (self.vectors.matrix, self.vectors.q) = (matrix, q);
    }

    /// Adds the forces of each contact that belong to a solution.
    fn write_forces(&self, z: &[f64], forces: &mut [[f64; 2]]) {
        for (&(k, kind), value) in self.vectors.unknowns.iter().zip(z) {
            let value = value * self.vectors.unit[k] * self.rate;
            match kind {
                Kind::Normal => {
                    forces[k][0] += value;
                    if let ContactUnknowns::Normal { share } = self.contacts[k] {
                        forces[k][1] += share * value;
                    }
                }
                Kind::Forward => forces[k][1] += value,
                Kind::Backward => forces[k][1] -= value,
                Kind::Slip => {}
            }
        }
        for (k, contact) in self.contacts.iter().enumerate() {
            if let ContactUnknowns::ShareOfCarrier { share, on } = contact {
                forces[k][1] = share * forces[*on][0];
            }
        }
    }
}

/// Writes which unknowns of a problem in the plane are positive if each contact does what it does with these forces.
fn write_positive_near(
    contacts: &[ContactUnknowns],
    unknowns: &[(usize, Kind)],
    (g, b): (&[f64], &[f64]),
    near: &[[f64; 2]],
    guess: &mut Vec<bool>,
) {
    let width = b.len();
    // The direction of the friction force, and whether it is used up.
    let friction = |k: usize| {
        let force = near[k][1];
        let most = match contacts[k] {
            ContactUnknowns::Both {
                friction,
                known_normal,
            } => friction * (near[k][0] + known_normal),
            ContactUnknowns::Tangent { friction, normal } => friction * normal,
            ContactUnknowns::OnCarrier {
                friction,
                known_normal,
                on,
            } => friction * (near[on][0] + known_normal),
            _ => 0.0,
        };
        let row = &g[(2 * k + 1) * width..][..width];
        let is_forward = if force == 0.0 {
            let by = row
                .iter()
                .zip(near.as_flattened())
                .map(|(g, force)| g * force);
            b[2 * k + 1] + by.sum::<f64>() < 0.0
        } else {
            force > 0.0
        };
        (is_forward, force.abs() >= most * (1.0 - SATURATED))
    };
    let is_positive = |&(k, kind): &(usize, Kind)| match kind {
        Kind::Normal => near[k][0] > 0.0,
        Kind::Forward => friction(k).0,
        Kind::Backward => !friction(k).0,
        Kind::Slip => friction(k).1,
    };
    guess.clear();
    guess.extend(unknowns.iter().map(is_positive));
}

/// Corrects a guess which unknowns of a problem in the plane are positive. As long as a contact sticks or slips, one of both directions is.
fn correct(
    contacts: &[ContactUnknowns],
    unknowns: &[(usize, Kind)],
    wrong: &[bool],
    guess: &mut [bool],
    normal_of: &mut Vec<Option<usize>>,
) {
    normal_of.clear();
    normal_of.resize(contacts.len(), None);
    for (i, &(k, kind)) in unknowns.iter().enumerate() {
        match kind {
            Kind::Normal => {
                guess[i] ^= wrong[i];
                normal_of[k] = Some(i);
            }
            Kind::Forward => {
                let (normal, known_normal) = match contacts[k] {
                    ContactUnknowns::OnCarrier {
                        on, known_normal, ..
                    } => (normal_of[on], known_normal),
                    ContactUnknowns::Both { known_normal, .. } => (normal_of[k], known_normal),
                    _ => (None, 1.0),
                };
                let opens = known_normal == 0.0 && normal.is_some_and(|normal| !guess[normal]);
                correct_friction(opens, &wrong[i..i + 3], &mut guess[i..i + 3]);
            }
            Kind::Backward | Kind::Slip => {}
        }
    }
}

/// Corrects the guess of a contact in the plane: whether its friction acts forwards, backwards, and is used up so that it slips. `opens` if it presses nothing.
fn correct_friction(opens: bool, wrong: &[bool], guess: &mut [bool]) {
    let (forward, backward, slip) = (0, 1, 2);
    let turns = if !guess[slip] {
        // It sticks, and does not any more if it opens or its friction exceeds the limit.
        guess[slip] = opens || wrong[slip];
        (guess[forward] && wrong[forward]) || (guess[backward] && wrong[backward])
    } else if opens {
        // It slips backwards, without friction that could stop it.
        wrong[slip]
    } else {
        // It slips; if that is wrong, it sticks, and its friction acts as before.
        guess[slip] = !wrong[slip];
        false
    };
    guess[forward] ^= turns;
    guess[backward] = !guess[forward];
}
