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

use std::vec::Vec;

use super::cone::{self, Part};
use super::lcp::{self, Unsolved, from_guess, lemke_into};

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

/// Memory for problems, which serves again from one to the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {
    plane: PlaneVectors,
    space: SpaceMemory,
    lcp: lcp::Memory,
    guess: Vec<bool>,
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
    let mut answer = Answer::default();
    let memory = &mut Memory::default();
    solve_into(contacts, (g, b), near, (&mut answer, memory))?;
    Ok(answer)
}

/// Like [`solve`], in memory that is there.
pub(crate) fn solve_into(
    contacts: &[ContactUnknowns],
    (g, b): (&[f64], &[f64]),
    near: Option<&[[f64; 2]]>,
    (answer, memory): (&mut Answer, &mut Memory),
) -> Result<(), Unsolved> {
    answer.forces.clear();
    answer.forces.resize(contacts.len(), [0.0; 2]);
    answer.residual = 0.0;
    answer.shared_otherwise.clear();
    if contacts
        .iter()
        .any(|contacts| matches!(contacts, ContactUnknowns::SecondTangent))
    {
        answer.residual = in_space(
            contacts,
            (g, b),
            near,
            (&mut answer.forces, &mut memory.space),
        )?;
        return Ok(());
    }
    let vectors = core::mem::take(&mut memory.plane);
    let mut problem = PlaneProblem::new(contacts, (g, b), vectors);
    let solved = if problem.rate == 0.0 || problem.vectors.unknowns.is_empty() {
        Ok(())
    } else {
        problem.solve(near, (answer, &mut memory.lcp, &mut memory.guess))
    };
    memory.plane = problem.vectors;
    solved
}

/// A problem without second tangents, as a linear complementarity problem.
struct PlaneProblem<'a> {
    contacts: &'a [ContactUnknowns],
    g: &'a [f64],
    b: &'a [f64],
    /// The unit of rates.
    rate: f64,
    vectors: PlaneVectors,
}

#[derive(Clone, Debug, Default)]
struct PlaneVectors {
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

impl<'a> PlaneProblem<'a> {
    fn new(
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

    /// Writes forces that solve the problem.
    fn solve(
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

    /// A contact and its tangent have one unit; what leans has a direction of its own.
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

/// Memory for problems in space.
#[derive(Clone, Debug, Default)]
struct SpaceMemory {
    /// The direction of each unknown force.
    unknowns: Vec<usize>,
    /// For each contact the place of its normal force among the unknowns.
    normals: Vec<Option<usize>>,
    /// The directions in which unknown forces act: the place of the force, the direction, and by what it is multiplied there. What slips in a known direction is a
    /// share of the normal force.
    terms: Vec<(usize, usize, f64)>,
    problem: cone::Problem,
    z: Vec<f64>,
    work: cone::Workspace,
}

impl SpaceMemory {
    fn push_unknown(&mut self, direction: usize) -> usize {
        let place = self.unknowns.len();
        self.unknowns.push(direction);
        self.terms.push((place, direction, 1.0));
        place
    }
}

/// As [`solve_into`], where some contacts have a second tangent: adds to the forces, and says the residual.
fn in_space(
    contacts: &[ContactUnknowns],
    (g, b): (&[f64], &[f64]),
    near: Option<&[[f64; 2]]>,
    (forces, memory): (&mut [[f64; 2]], &mut SpaceMemory),
) -> Result<f64, Unsolved> {
    // In space a guide has no sides.
    if contacts.iter().any(ContactUnknowns::is_guide) {
        return Err(Unsolved);
    }
    let (m, all_contacts) = (contacts.len(), contacts);
    let entry = |i: usize, j: usize| g[i * 2 * m + j];
    let rate = b.iter().fold(0.0_f64, |size, b| size.max(b.abs()));
    if rate == 0.0 {
        return Ok(0.0);
    }
    memory.unknowns.clear();
    memory.terms.clear();
    memory.normals.clear();
    memory.normals.resize(m, None);
    memory.problem.parts.clear();
    for (k, contacts) in contacts.iter().enumerate() {
        match *contacts {
            ContactUnknowns::Both { .. } => {
                memory.normals[k] = Some(memory.push_unknown(2 * k));
            }
            ContactUnknowns::Normal { share } => {
                let place = memory.push_unknown(2 * k);
                memory.normals[k] = Some(place);
                memory.terms.push((place, 2 * k + 1, share));
            }
            ContactUnknowns::ShareOfCarrier { share, on } => {
                if let Some(normal) = memory.normals[on] {
                    memory.terms.push((normal, 2 * k + 1, share));
                }
            }
            _ => {}
        }
    }
    for (k, contacts) in contacts.iter().enumerate() {
        let (friction, on, known_normal) = match *contacts {
            ContactUnknowns::Both {
                friction,
                known_normal,
            } => (friction, memory.normals[k], known_normal),
            ContactUnknowns::Tangent { friction, normal } => (friction, None, normal),
            ContactUnknowns::OnCarrier {
                friction,
                known_normal,
                on,
            } => (friction, memory.normals[on], known_normal),
            ContactUnknowns::Normal { .. }
            | ContactUnknowns::ShareOfCarrier { .. }
            | ContactUnknowns::Nothing
            | ContactUnknowns::Guide { .. }
            | ContactUnknowns::SlidingGuide { .. }
            | ContactUnknowns::SecondTangent => {
                let normal = memory.normals[k].map(Part::Normal);
                memory.problem.parts.extend(normal);
                continue;
            }
        };
        if matches!(contacts, ContactUnknowns::Both { .. }) {
            let normal = memory.normals[k].map(Part::Normal);
            memory.problem.parts.extend(normal);
        }
        if friction <= 0.0 || (on.is_none() && known_normal <= 0.0) {
            continue;
        }
        let mut places = [memory.push_unknown(2 * k + 1); 2];
        let mut count = 1;
        if let Some(ContactUnknowns::SecondTangent) = all_contacts.get(k + 1) {
            places[1] = memory.push_unknown(2 * k + 3);
            count = 2;
        }
        memory.problem.parts.push(Part::Disc {
            places,
            count,
            friction,
            on,
            known_normal,
        });
    }
    let SpaceMemory {
        unknowns,
        terms,
        problem,
        z,
        work,
        ..
    } = memory;
    let n = unknowns.len();
    let units = &mut problem.units;
    units.clear();
    units.extend(
        unknowns
            .iter()
            .map(|direction| entry(*direction, *direction)),
    );
    // Both tangents of a contact have one unit of impulse, so that its disc stays one.
    for part in &problem.parts {
        if let Part::Disc { places, .. } = part {
            let greatest = places.iter().fold(0.0_f64, |most, i| most.max(units[*i]));
            places.iter().for_each(|i| units[*i] = greatest);
        }
    }
    for unit in units.iter_mut() {
        *unit = if *unit > 0.0 { 1.0 / *unit } else { 1.0 };
    }
    problem.b.clear();
    problem
        .b
        .extend(unknowns.iter().map(|direction| b[*direction] / rate));
    problem.matrix.clear();
    problem.matrix.resize(n * n, 0.0);
    for (&direction, row) in unknowns.iter().zip(problem.matrix.chunks_exact_mut(n)) {
        for &(place, along, share) in terms.iter() {
            row[place] += share * entry(direction, along);
        }
        for (entry, unit) in row.iter_mut().zip(&*units) {
            *entry *= unit;
        }
    }
    for part in &mut problem.parts {
        if let Part::Disc {
            places,
            friction,
            on,
            known_normal,
            ..
        } = part
        {
            let own = units[places[0]];
            let pressing = on.map_or(own, |on| units[on]);
            *friction *= pressing / own;
            *known_normal /= pressing * rate;
        }
    }
    z.clear();
    match near {
        Some(near) => z.extend(
            (unknowns.iter().zip(&*units))
                .map(|(direction, unit)| near[direction / 2][direction % 2] / (unit * rate)),
        ),
        None => z.resize(n, 0.0),
    }
    let residual = cone::solve(problem, z, work)?;
    for &(place, direction, share) in terms.iter() {
        forces[direction / 2][direction % 2] += share * z[place] * problem.units[place] * rate;
    }
    Ok(residual)
}

/// The forces or impulses of contacts, along normal and tangent.
#[derive(Clone, Debug, Default)]
pub(crate) struct Answer {
    pub forces: Vec<[f64; 2]>,
    /// By how much they miss the conditions, relative to the size of the terms.
    pub residual: f64,
    /// Contacts that share their load in another way than by the rule for undetermined forces, (E79), although the motion depends on it; usually none.
    pub shared_otherwise: Vec<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Normal,
    Forward,
    Backward,
    Slip,
}

#[cfg(test)]
mod tests {
    use std::vec;

    use super::*;

    /// Numbers between −1 and 1 that look drawn at random.
    fn drawn(seed: &mut u64) -> f64 {
        *seed ^= *seed << 13;
        *seed ^= *seed >> 7;
        *seed ^= *seed << 17;
        (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Bodies that stand on four feet each, one on the other, and meet with restitution, slip and turn: the problem of the impulses of such a pile. Its second
    /// tangents follow the first ones, as rows that are one contact more.
    fn pile(seed: &mut u64, case: usize) -> (Vec<ContactUnknowns>, Vec<f64>, Vec<f64>) {
        let bodies = 1 + case % 4;
        let friction = 0.65 + 0.55 * drawn(seed);
        let [a, b, c] = [0.3, 0.3, 0.2].map(|size| size * (1.0 + 0.6 * drawn(seed)));
        let masses: Vec<f64> = (0..bodies).map(|_| (1.5 * drawn(seed)).exp()).collect();
        let inverse = |i: usize| {
            let squares = [b * b + c * c, a * a + c * c, a * a + b * b];
            match i % 6 {
                axis @ 3.. => 3.0 / masses[i / 6] / squares[axis - 3],
                _ => 1.0 / masses[i / 6],
            }
        };
        let mut rows: Vec<Vec<f64>> = Vec::new();
        for k in 0..bodies {
            let (sin, cos) = (3.0 * drawn(seed)).sin_cos();
            for [x, y] in [[a, b], [a, -b], [-a, b], [-a, -b]] {
                let [x, y] = [cos * x - sin * y, sin * x + cos * y];
                // Along the normal and both tangents, at a height.
                let at = |z: f64| {
                    [
                        [0.0, 0.0, 1.0, y, -x, 0.0],
                        [1.0, 0.0, 0.0, 0.0, z, -y],
                        [0.0, 1.0, 0.0, -z, 0.0, x],
                    ]
                };
                for (own, below) in at(-c).into_iter().zip(at(c)) {
                    let mut row = vec![0.0; 6 * bodies];
                    row[6 * k..][..6].copy_from_slice(&own);
                    if k > 0 {
                        let below = below.map(|x| -x);
                        row[6 * (k - 1)..][..6].copy_from_slice(&below);
                    }
                    rows.push(row);
                }
            }
        }
        // All bodies move at random, or the uppermost one falls onto others that rest, with an edge ahead.
        let v: Vec<f64> = (0..6 * bodies)
            .map(|i| match (case / 4 % 2, i / 6 == bodies - 1, i % 6) {
                (0, ..) => drawn(seed),
                (_, true, 2) => -0.3,
                (_, true, _) => 0.2 * drawn(seed),
                (_, false, 2) => -0.01,
                (_, false, _) => 0.0,
            })
            .collect();
        let restitution = [0.0, 0.2, 0.8][case / 8 % 3];
        let place = |i: usize| 4 * (i / 3) + [0, 1, 3][i % 3];
        let width = 4 * rows.len() / 3;
        let (mut g, mut rates) = (vec![0.0; width * width], vec![0.0; width]);
        for (i, row) in rows.iter().enumerate() {
            for (j, other) in rows.iter().enumerate() {
                let terms = row.iter().zip(other).enumerate();
                g[place(i) * width + place(j)] = terms.map(|(l, (x, y))| x * y * inverse(l)).sum();
            }
            let rate: f64 = row.iter().zip(&v).map(|(x, v)| x * v).sum();
            let is_normal = f64::from(u8::from(i % 3 == 0));
            rates[place(i)] = rate + is_normal * restitution * rate.min(0.0);
        }
        let contact = [
            ContactUnknowns::Both {
                friction,
                known_normal: 0.0,
            },
            ContactUnknowns::SecondTangent,
        ];
        (contact.repeat(rows.len() / 3), g, rates)
    }

    /// Where some motion opens all contacts there are impulses that obey the law (V. Acary, F. Cadoux, C. Lemaréchal, J. Malick, Z. Angew. Math. Mech. 91 (2011)
    /// 155–175): they are found, however the feet depend on each other, and the conditions themselves hold.
    #[test]
    fn impulses_of_piles_on_four_feet_are_found() {
        let mut seed = 0x2545_f491_4f6c_dd1d;
        for case in 0..240 {
            let (contacts, g, b) = pile(&mut seed, case);
            let Ok(Answer { forces, .. }) = solve(&contacts, &g, &b, None) else {
                panic!("case {case} of {} feet was not solved", contacts.len() / 2);
            };
            check(case, &contacts, (&g, &b), &forces);
        }
    }

    /// The conditions themselves, and not Φ.
    fn check(
        case: usize,
        contacts: &[ContactUnknowns],
        (g, b): (&[f64], &[f64]),
        forces: &[[f64; 2]],
    ) {
        let rate = |i: usize| {
            let row = g[i * b.len()..][..b.len()].iter();
            let terms = row.zip(forces.as_flattened());
            b[i] + terms.map(|(g, force)| g * force).sum::<f64>()
        };
        let fastest = b.iter().fold(0.0_f64, |most, b| most.max(b.abs()));
        let hardest = forces
            .iter()
            .fold(0.0_f64, |most, force| most.max(force[0]));
        for k in (0..contacts.len()).step_by(2) {
            let ContactUnknowns::Both { friction, .. } = contacts[k] else {
                panic!("the first of two tangents");
            };
            let (normal, force) = (forces[k][0], [forces[k][1], forces[k + 1][1]]);
            let (opens, slip) = (rate(2 * k), [rate(2 * k + 1), rate(2 * k + 3)]);
            let size = force[0].hypot(force[1]);
            let power = force[0] * slip[0] + force[1] * slip[1];
            let lost = friction * normal * slip[0].hypot(slip[1]);
            // Φ is at most 1e-10, and a power is a product of two numbers of which each may be off by that.
            let within = 1e-9;
            assert!(normal >= -within * hardest, "case {case}: {normal}");
            assert!(opens >= -within * fastest, "case {case}: {opens}");
            let closed = (normal * opens).abs();
            assert!(
                closed <= within * hardest * fastest,
                "case {case}: {closed}"
            );
            let most = friction * normal + within * hardest;
            assert!(size <= most, "case {case}: {size} of {most}");
            let missed = (power + lost).abs();
            assert!(
                missed <= within * hardest * fastest,
                "case {case}: {missed}"
            );
        }
    }

    /// Bodies on four feet each that all but stop: some stick with less than all of their friction, and the rest slips as slowly as is asked, so that it uses all of
    /// it. The impulses that do so are known, and others may do the same.
    fn nearly_stopped_pile(
        seed: &mut u64,
        case: usize,
        slip: f64,
    ) -> (Vec<ContactUnknowns>, Vec<f64>, Vec<f64>) {
        let (contacts, g, mut b) = pile(seed, case);
        let width = b.len();
        let ContactUnknowns::Both { friction, .. } = contacts[0] else {
            panic!("the first of two tangents");
        };
        let (mut impulses, mut rates) = (vec![0.0; width], vec![0.0; width]);
        for body in 0..contacts.len() / 8 {
            let [x, y, turn] = [0; 3].map(|_| drawn(seed));
            let sticks = drawn(seed) > 0.7;
            for (foot, [side, front]) in
                ([[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].into_iter()).enumerate()
            {
                // As a body slips that moves and turns.
                let way = [x - 0.5 * turn * front, y + 0.5 * turn * side];
                let length = way[0].hypot(way[1]);
                let normal = 1.5 + drawn(seed);
                let used = friction * normal * if sticks { 0.9 } else { 1.0 };
                let first = 2 * (4 * body + foot);
                impulses[2 * first] = normal;
                for (part, way) in [1, 3].into_iter().zip(way) {
                    impulses[2 * first + part] = -used * way / length;
                    rates[2 * first + part] = if sticks { 0.0 } else { slip * way };
                }
            }
        }
        for ((b, rate), row) in b.iter_mut().zip(&rates).zip(g.chunks_exact(width)) {
            let terms = row.iter().zip(&impulses);
            *b = rate - terms.map(|(g, impulse)| g * impulse).sum::<f64>();
        }
        (contacts, g, b)
    }

    /// However slowly feet slip that use all of their friction, impulses are found.
    #[test]
    fn impulses_of_feet_that_all_but_stop_are_found() {
        let mut seed = 4711;
        for case in 0..260 {
            let slip = 10.0_f64.powi(-(case as i32 % 13));
            let (contacts, g, b) = nearly_stopped_pile(&mut seed, case / 13, slip);
            let Ok(answer) = solve(&contacts, &g, &b, None) else {
                panic!("case {case} with slips of {slip} was not solved");
            };
            check(case, &contacts, (&g, &b), &answer.forces);
        }
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
