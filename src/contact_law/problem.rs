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
//! Rolling resistance depends on the contact that rolls: its torque is `|τ| ≤ ρ Λₙ` of that contact's normal, against the rate of
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

mod plane;
mod space;

use std::vec::Vec;

use super::lcp::{self, Unsolved};
use plane::{PlaneProblem, PlaneVectors};
use space::{SpaceMemory, in_space};

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
    let solved = if problem.is_trivial() {
        Ok(())
    } else {
        problem.solve(near, (answer, &mut memory.lcp, &mut memory.guess))
    };
    memory.plane = problem.vectors;
    solved
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
