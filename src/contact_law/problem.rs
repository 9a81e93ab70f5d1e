//! The complementarity problem of contacts with friction.
//!
//! ```text
//! γ = G Λ + b,    0 ≤ Λₙ ⊥ γₙ ≥ 0,    −Λₜ ∈ μ (Λₙ + Λ₀) Sgn γₜ
//! ```
//!
//! With `Λₜ = β₊ − β₋` and the speed of slip σ = |γₜ|:
//!
//! ```text
//! 0 ≤ β₊ ⊥ σ + γₜ ≥ 0,   0 ≤ β₋ ⊥ σ − γₜ ≥ 0,   0 ≤ σ ⊥ μ (Λₙ + Λ₀) − β₊ − β₋ ≥ 0
//! ```
//!
//! What resists rolling leans on the contact that rolls: its torque is `|τ| ≤ ρ Λₙ` of that contact's normal, against the rate of
//! rotation, in the same form.
//!
//! (D. E. Stewart, J. C. Trinkle, Int. J. Numer. Methods Eng. 39 (1996) 2673–2691.) Where it is known how a contact
//! slips, `Λₜ = κ Λₙ` and there is no question of β and σ.
//!
//! A guide is a pair of opposite contacts without play, of which at most one presses. Its reaction is known as an affine function of the friction
//! forces, `N = N₀ + K Λₜ`, and the pair is one contact whose force is that on the far side and whose "rate" is that on the near side, times any
//! positive `c = G_nn`:
//!
//! ```text
//! γₙ = c N⁺,  Λₙ = N⁻,    γₙ = G_nn Λₙ + c (N₀ + K Λₜ),    0 ≤ Λₙ ⊥ γₙ ≥ 0,    −Λₜ ∈ μ (Λₙ + γₙ/c) Sgn γₜ
//! ```
//!
//! In space a contact has two tangents, and friction a disc: that problem is not linear, and `cone` solves it.

use std::vec;
use std::vec::Vec;

use super::cone::{self, Part};
use super::lcp::{Unsolved, from_guess, lemke};

/// Friction within this of the greatest that there is, relative to that, is used up.
pub(crate) const SATURATED: f64 = 1e-10;

/// What is asked of a contact.
#[derive(Clone, Copy, Debug)]
pub(crate) enum ContactUnknowns {
    /// Both directions, with friction `μ`, and a normal impulse `Λ₀` that counts beside its own.
    Both { friction: f64, known_normal: f64 },
    /// The normal; the tangential force is `κ` times the normal one.
    Normal { share: f64 },
    /// The tangent, with friction `μ` of a normal force that is known.
    Tangent { friction: f64, normal: f64 },
    /// Nothing: both forces are known.
    Nothing,
    /// The tangent, with a friction of `μ` times the normal of another contact, and of an impulse `Λ₀` beside that.
    OnCarrier {
        friction: f64,
        known_normal: f64,
        on: usize,
    },
    /// The tangent, whose force is `κ` times the normal one of another contact.
    ShareOfCarrier { share: f64, on: usize },
    /// The second tangent of the contact before it, whose friction limits both together.
    SecondTangent,
    /// The reaction on the far side of a guide in the plane, and its friction.
    Guide { friction: f64 },
    /// The same of a guide that slides forwards or backwards.
    SlidingGuide { friction: f64, forward: bool },
}

impl ContactUnknowns {
    /// Whether a normal force is unknown. What a guide without friction presses does not matter.
    fn has_normal(&self) -> bool {
        matches!(self, Self::Both { .. } | Self::Normal { .. })
            || (self.is_guide() && self.has_friction())
    }

    /// Whether it presses from both sides.
    fn is_guide(&self) -> bool {
        matches!(self, Self::Guide { .. } | Self::SlidingGuide { .. })
    }

    /// Whether its slip is known, so that the friction force is the greatest one against it.
    fn slides(&self) -> bool {
        matches!(self, Self::SlidingGuide { .. })
    }

    /// Whether it has a friction force that is unknown and can be more than 0.
    fn has_friction(&self) -> bool {
        match self {
            Self::Both { friction, .. } | Self::OnCarrier { friction, .. } => *friction > 0.0,
            Self::Tangent { friction, normal } => friction * normal > 0.0,
            Self::Guide { friction } | Self::SlidingGuide { friction, .. } => *friction > 0.0,
            Self::Normal { .. }
            | Self::Nothing
            | Self::ShareOfCarrier { .. }
            | Self::SecondTangent => false,
        }
    }
}

/// Solves for normal and tangential forces or impulses of each contact: finds one solution where there are several. `g` has two rows and columns
/// for each, its normal and its tangent, and so has `b`. The search begins `near` these forces, if they are given: in the plane with the states
/// that they imply, which contacts press, slip and stick.
pub(crate) fn solve(
    contacts: &[ContactUnknowns],
    g: &[f64],
    b: &[f64],
    near: Option<&[[f64; 2]]>,
) -> Result<Answer, Unsolved> {
    if contacts
        .iter()
        .any(|contacts| matches!(contacts, ContactUnknowns::SecondTangent))
    {
        return in_space(contacts, g, b, near);
    }
    let problem = PlaneProblem::new(contacts, g, b);
    if problem.rate == 0.0 || problem.unknowns.is_empty() {
        return Ok(Answer::new(vec![[0.0; 2]; contacts.len()], 0.0));
    }
    let (matrix, q) = problem.complementarity();
    let near = near.filter(|_| !contacts.iter().any(ContactUnknowns::is_guide));
    let guessed = near.and_then(|near| {
        let guess = positive_near(contacts, &problem.unknowns, (g, b), near);
        from_guess(&matrix, &q, guess, |wrong, guess| {
            correct(contacts, &problem.unknowns, wrong, guess);
        })
    });
    let solution = match guessed {
        Some(solution) => solution,
        None => lemke(&matrix, &q)?,
    };
    Ok(Answer::new(problem.forces(&solution.z), solution.residual))
}

/// A problem without second tangents, as a linear complementarity problem.
struct PlaneProblem<'a> {
    contacts: &'a [ContactUnknowns],
    g: &'a [f64],
    b: &'a [f64],
    /// What is unknown: of which contact, and its kind.
    unknowns: Vec<(usize, Kind)>,
    /// Which contact has which share of the normal force of another: the contact, the other one, and the share.
    shares_of_carriers: Vec<(usize, usize, f64)>,
    /// By what rates are multiplied along tangents: a rate of rotation becomes one in the units of the contact that rolls, with the same energy.
    along_tangents: Vec<f64>,
    /// The unit of rates, and of the impulses of each contact.
    rate: f64,
    unit: Vec<f64>,
}

impl<'a> PlaneProblem<'a> {
    fn new(contacts: &'a [ContactUnknowns], g: &'a [f64], b: &'a [f64]) -> Self {
        let mut problem = Self {
            contacts,
            g,
            b,
            unknowns: Vec::new(),
            shares_of_carriers: Vec::new(),
            along_tangents: Vec::new(),
            rate: 0.0,
            unit: Vec::new(),
        };
        for (k, contact) in contacts.iter().enumerate() {
            if contact.has_normal() {
                problem.unknowns.push((k, Kind::Normal));
            }
            if let ContactUnknowns::ShareOfCarrier { share, on } = contact {
                problem.shares_of_carriers.push((k, *on, *share));
            }
            if contact.has_friction() {
                let directions = match contact {
                    // Its friction acts backwards.
                    ContactUnknowns::SlidingGuide { forward: true, .. } => &[Kind::Backward][..],
                    ContactUnknowns::SlidingGuide { .. } => &[Kind::Forward],
                    _ => &[Kind::Forward, Kind::Backward],
                };
                let kinds = directions.iter().chain(&[Kind::Slip]);
                problem.unknowns.extend(kinds.map(|kind| (k, *kind)));
            }
        }
        let places = 0..contacts.len();
        let along_tangents = places.clone().map(|k| problem.multiple_along_tangent(k));
        problem.along_tangents = along_tangents.collect();
        problem.rate = (b.iter().enumerate()).fold(0.0_f64, |size, (row, b)| {
            size.max((problem.multiple(row) * b).abs())
        });
        problem.unit = places.map(|k| problem.unit_of_contact(k)).collect();
        problem
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
            self.along_tangents[row / 2]
        }
    }

    /// A contact and its tangent have one unit; what leans has a direction of its own.
    fn unit_of_contact(&self, k: usize) -> f64 {
        let own = match self.contacts[k] {
            ContactUnknowns::OnCarrier { .. } => {
                self.along_tangents[k] * self.product(2 * k + 1, 2 * k + 1)
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
                let carried = self.shares_of_carriers.iter();
                let carried = carried.filter(|(_, on, _)| *on == k);
                let carried = carried.fold(0.0, |sum, (other, _, share)| {
                    sum + share * entry(2 * other + 1)
                });
                self.unit[k] * (entry(2 * k) + share * entry(2 * k + 1) + carried)
            }
            Kind::Forward => self.unit[k] * entry(2 * k + 1),
            Kind::Backward => -self.unit[k] * entry(2 * k + 1),
            Kind::Slip => 0.0,
        }
    }

    /// The friction of a contact, the normal impulse that is known, in its unit, and of an impulse on another contact that one and how many of its units
    /// are one of these.
    fn limit(&self, k: usize) -> (f64, f64, Option<(usize, f64)>) {
        let in_units = |normal: f64| normal / (self.unit[k] * self.rate);
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
                let carrier = Some((on, self.unit[on] / self.unit[k]));
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

    /// The matrix, row after row, and the constants.
    fn complementarity(&self) -> (Vec<f64>, Vec<f64>) {
        let n = self.unknowns.len();
        let (mut matrix, mut q) = (vec![0.0; n * n], vec![0.0; n]);
        for (i, &(k, kind)) in self.unknowns.iter().enumerate() {
            let (friction, known_normal, carrier) = self.limit(k);
            let row = &mut matrix[i * n..][..n];
            for (entry, &unknown) in row.iter_mut().zip(&self.unknowns) {
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
        (matrix, q)
    }

    /// The forces of each contact that belong to a solution.
    fn forces(&self, z: &[f64]) -> Vec<[f64; 2]> {
        let mut forces = vec![[0.0; 2]; self.contacts.len()];
        for (&(k, kind), value) in self.unknowns.iter().zip(z) {
            let value = value * self.unit[k] * self.rate;
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
        forces
    }
}

/// Which unknowns of a problem in the plane are positive if each contact does what it does with these forces.
fn positive_near(
    contacts: &[ContactUnknowns],
    unknowns: &[(usize, Kind)],
    (g, b): (&[f64], &[f64]),
    near: &[[f64; 2]],
) -> Vec<bool> {
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
    unknowns.iter().map(is_positive).collect()
}

/// Corrects a guess which unknowns of a problem in the plane are positive. As long as a contact sticks or slips, one of both directions is.
fn correct(
    contacts: &[ContactUnknowns],
    unknowns: &[(usize, Kind)],
    wrong: &[bool],
    guess: &mut [bool],
) {
    let mut normal_of = vec![None; contacts.len()];
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

/// As [`solve`], where some contacts have a second tangent.
fn in_space(
    contacts: &[ContactUnknowns],
    g: &[f64],
    b: &[f64],
    near: Option<&[[f64; 2]]>,
) -> Result<Answer, Unsolved> {
    // In space a guide has no sides.
    if contacts.iter().any(ContactUnknowns::is_guide) {
        return Err(Unsolved);
    }
    let (m, all_contacts) = (contacts.len(), contacts);
    let entry = |i: usize, j: usize| g[i * 2 * m + j];
    let rate = b.iter().fold(0.0_f64, |size, b| size.max(b.abs()));
    if rate == 0.0 {
        return Ok(Answer::new(vec![[0.0; 2]; m], 0.0));
    }
    // The unknown forces, by direction, and of each by what it is multiplied in other directions: what slips in a known
    // direction is a share of the normal force.
    let mut unknowns: Vec<Vec<(usize, f64)>> = Vec::new();
    let mut normals = vec![None; m];
    for (k, contacts) in contacts.iter().enumerate() {
        match *contacts {
            ContactUnknowns::Both { .. } => {
                normals[k] = Some(unknowns.len());
                unknowns.push(vec![(2 * k, 1.0)]);
            }
            ContactUnknowns::Normal { share } => {
                normals[k] = Some(unknowns.len());
                unknowns.push(vec![(2 * k, 1.0), (2 * k + 1, share)]);
            }
            ContactUnknowns::ShareOfCarrier { share, on } => {
                if let Some(normal) = normals[on] {
                    unknowns[normal].push((2 * k + 1, share));
                }
            }
            _ => {}
        }
    }
    let mut parts = Vec::new();
    for (k, contacts) in contacts.iter().enumerate() {
        let (friction, on, known_normal) = match *contacts {
            ContactUnknowns::Both {
                friction,
                known_normal,
            } => (friction, normals[k], known_normal),
            ContactUnknowns::Tangent { friction, normal } => (friction, None, normal),
            ContactUnknowns::OnCarrier {
                friction,
                known_normal,
                on,
            } => (friction, normals[on], known_normal),
            ContactUnknowns::Normal { .. }
            | ContactUnknowns::ShareOfCarrier { .. }
            | ContactUnknowns::Nothing
            | ContactUnknowns::Guide { .. }
            | ContactUnknowns::SlidingGuide { .. }
            | ContactUnknowns::SecondTangent => {
                parts.extend(normals[k].map(Part::Normal));
                continue;
            }
        };
        if matches!(contacts, ContactUnknowns::Both { .. }) {
            parts.extend(normals[k].map(Part::Normal));
        }
        if friction <= 0.0 || (on.is_none() && known_normal <= 0.0) {
            continue;
        }
        let is_across = |next: &usize| {
            matches!(
                all_contacts.get(*next),
                Some(ContactUnknowns::SecondTangent)
            )
        };
        let tangents = [k].into_iter().chain([k + 1].into_iter().filter(is_across));
        let mut places = Vec::new();
        for tangent in tangents {
            places.push(unknowns.len());
            unknowns.push(vec![(2 * tangent + 1, 1.0)]);
        }
        parts.push(Part::Disc {
            places,
            friction,
            on,
            known_normal,
        });
    }
    // Both tangents of a contact have one unit of impulse, so that its disc stays one.
    let own = |unknown: &[(usize, f64)]| {
        let (direction, _) = unknown[0];
        entry(direction, direction)
    };
    let mut units: Vec<f64> = unknowns.iter().map(|unknown| own(unknown)).collect();
    for part in &parts {
        if let Part::Disc { places, .. } = part {
            let greatest = places.iter().fold(0.0_f64, |most, i| most.max(units[*i]));
            places.iter().for_each(|i| units[*i] = greatest);
        }
    }
    for unit in &mut units {
        *unit = if *unit > 0.0 { 1.0 / *unit } else { 1.0 };
    }
    let n = unknowns.len();
    let mut problem = cone::Problem {
        matrix: vec![0.0; n * n],
        b: unknowns.iter().map(|u| b[u[0].0] / rate).collect(),
        parts,
    };
    for (i, row) in unknowns.iter().enumerate() {
        for (j, column) in unknowns.iter().enumerate() {
            let terms = column.iter().map(|(d, share)| share * entry(row[0].0, *d));
            problem.matrix[i * n + j] = units[j] * terms.sum::<f64>();
        }
    }
    for part in &mut problem.parts {
        if let Part::Disc {
            places,
            friction,
            on,
            known_normal,
        } = part
        {
            let own = units[places[0]];
            let pressing = on.map_or(own, |on| units[on]);
            *friction *= pressing / own;
            *known_normal /= pressing * rate;
        }
    }
    let start = match near {
        Some(near) => (unknowns.iter().zip(&units))
            .map(|(unknown, unit)| near[unknown[0].0 / 2][unknown[0].0 % 2] / (unit * rate))
            .collect(),
        None => vec![0.0; n],
    };
    let (z, residual) = cone::solve(&problem, start)?;
    let mut forces = vec![[0.0; 2]; m];
    for ((unknown, z), unit) in unknowns.iter().zip(&z).zip(&units) {
        for (direction, share) in unknown {
            forces[direction / 2][direction % 2] += share * z * unit * rate;
        }
    }
    Ok(Answer::new(forces, residual))
}

/// The forces or impulses of contacts, along normal and tangent.
#[derive(Clone, Debug)]
pub(crate) struct Answer {
    pub forces: Vec<[f64; 2]>,
    /// By how much they miss the conditions, relative to the size of the terms.
    pub residual: f64,
    /// Contacts that share their load in another way than by the rule for undetermined forces, (E79), although the motion depends on it; usually none.
    pub shared_otherwise: Vec<usize>,
}

impl Answer {
    fn new(forces: Vec<[f64; 2]>, residual: f64) -> Self {
        Self {
            forces,
            residual,
            shared_otherwise: Vec::new(),
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Normal,
    Forward,
    Backward,
    Slip,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers between −1 and 1 that look drawn at random.
    fn drawn(seed: &mut u64) -> f64 {
        *seed ^= *seed << 13;
        *seed ^= *seed >> 7;
        *seed ^= *seed << 17;
        (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Contacts in the plane are contacts in space that do not move across it: Lemke's method and that of cones say the same, whatever
    /// is known of how they slip and are pressed.
    #[test]
    fn in_a_plane_cones_agree_with_pivoting() {
        let mut seed = 11;
        for case in 0..400 {
            let n = 4;
            let rows: Vec<Vec<f64>> = (0..n)
                .map(|_| (0..n).map(|_| drawn(&mut seed)).collect())
                .collect();
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let mut g: Vec<f64> = (0..n * n)
                .map(|k| dot(&rows[k / n], &rows[k % n]))
                .collect();
            // Each with a mass of its own, as large as 0.1 to 3 times the other.
            for i in 0..n {
                g[i * n + i] += 1.55 + 1.45 * drawn(&mut seed);
            }
            let b: Vec<f64> = (0..n).map(|_| drawn(&mut seed)).collect();
            let both = ContactUnknowns::Both {
                friction: 0.3,
                known_normal: 0.2 * f64::from(u8::from(case % 4 == 3)),
            };
            let first = match case % 4 {
                1 => ContactUnknowns::Tangent {
                    friction: 0.3,
                    normal: 0.4,
                },
                2 => ContactUnknowns::Normal { share: 0.2 },
                _ => both,
            };
            let plane = solve(&[first, both], &g, &b, None).expect("solved by pivoting");
            // Behind each stands its second tangent, which nothing moves; that of one whose slip is known has no friction.
            let second = match first {
                ContactUnknowns::Normal { .. } => {
                    ContactUnknowns::ShareOfCarrier { share: 0.0, on: 0 }
                }
                _ => ContactUnknowns::SecondTangent,
            };
            let places = [0, 1, 4, 5];
            let mut wide = vec![0.0; 64];
            for i in 0..n {
                for j in 0..n {
                    wide[places[i] * 8 + places[j]] = g[i * n + j];
                }
            }
            (wide[3 * 8 + 3], wide[7 * 8 + 7]) = (1.0, 2.0);
            let mut rates = vec![0.0; 8];
            places.iter().zip(&b).for_each(|(i, b)| rates[*i] = *b);
            let contacts = [first, second, both, ContactUnknowns::SecondTangent];
            let space = solve(&contacts, &wide, &rates, None).expect("solved on cones");
            for (k, place) in [0, 2].into_iter().enumerate() {
                for (plane, space) in plane.forces[k].iter().zip(&space.forces[place]) {
                    assert!(
                        (plane - space).abs() < 1e-11,
                        "case {case}: {plane}, {space}"
                    );
                }
                assert!(space.forces[place + 1][1].abs() < 1e-11);
            }
        }
    }
}
