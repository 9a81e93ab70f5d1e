//! The complementarity problem of contacts with friction in the plane.
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

use std::vec;
use std::vec::Vec;

use super::lcp::{Unsolved, lemke};

/// What is asked of a contact.
#[derive(Clone, Copy, Debug)]
pub(super) enum Asked {
    /// Both directions, with friction `μ`, and a normal impulse `Λ₀` that counts beside its own.
    Both { friction: f64, beside: f64 },
    /// The normal; the tangential force is `κ` times the normal one.
    Normal { share: f64 },
    /// The tangent, with friction `μ` of a normal force that is known.
    Tangent { friction: f64, normal: f64 },
    /// Nothing: both forces are known.
    Nothing,
    /// The tangent, with a friction of `μ` times the normal of another contact, and of an impulse `Λ₀` beside that.
    Leaning {
        friction: f64,
        beside: f64,
        on: usize,
    },
    /// The tangent, whose force is `κ` times the normal one of another contact.
    Carried { share: f64, on: usize },
}

/// Solves for normal and tangential forces or impulses of each contact. `g` has two rows and columns for each, its
/// normal and its tangent, and so has `b`.
pub(super) fn solve(asked: &[Asked], g: &[f64], b: &[f64]) -> Result<Answer, Unsolved> {
    let m = asked.len();
    let entry = |i: usize, j: usize| g[i * 2 * m + j];
    // What is unknown: for each contact its kind, and in which units of impulse.
    let mut unknowns: Vec<(usize, Kind)> = Vec::new();
    for (k, asked) in asked.iter().enumerate() {
        let rubs = match asked {
            Asked::Both { friction, .. } => *friction > 0.0,
            Asked::Tangent { friction, normal } => friction * normal > 0.0,
            Asked::Leaning { friction, .. } => *friction > 0.0,
            Asked::Normal { .. } | Asked::Nothing | Asked::Carried { .. } => false,
        };
        if matches!(asked, Asked::Both { .. } | Asked::Normal { .. }) {
            unknowns.push((k, Kind::Normal));
        }
        if rubs {
            unknowns.extend([(k, Kind::Forward), (k, Kind::Backward), (k, Kind::Slip)]);
        }
    }
    let rate = b.iter().fold(0.0_f64, |size, b| size.max(b.abs()));
    if rate == 0.0 || unknowns.is_empty() {
        return Ok(Answer {
            forces: vec![[0.0; 2]; m],
            residual: 0.0,
        });
    }
    let unit: Vec<f64> = (0..m)
        .map(|k| {
            // A contact and its tangent have one unit; what leans has a direction of its own.
            let own = match asked[k] {
                Asked::Leaning { .. } => entry(2 * k + 1, 2 * k + 1),
                _ => entry(2 * k, 2 * k),
            };
            if own > 0.0 { 1.0 / own } else { 1.0 }
        })
        .collect();
    // What a unit of an unknown does to the rate of a direction.
    let effect = |row: usize, (k, kind): (usize, Kind)| match kind {
        Kind::Normal => {
            let share = match asked[k] {
                Asked::Normal { share } => share,
                _ => 0.0,
            };
            let carried = (asked.iter().enumerate()).map(|(other, asked)| match asked {
                Asked::Carried { share, on } if *on == k => share * entry(row, 2 * other + 1),
                _ => 0.0,
            });
            let carried: f64 = carried.sum();
            unit[k] * (entry(row, 2 * k) + share * entry(row, 2 * k + 1) + carried)
        }
        Kind::Forward => unit[k] * entry(row, 2 * k + 1),
        Kind::Backward => -unit[k] * entry(row, 2 * k + 1),
        Kind::Slip => 0.0,
    };
    let n = unknowns.len();
    let (mut matrix, mut q) = (vec![0.0; n * n], vec![0.0; n]);
    for (i, &(k, kind)) in unknowns.iter().enumerate() {
        let row = &mut matrix[i * n..][..n];
        let (friction, beside) = match asked[k] {
            Asked::Both { friction, beside } => (friction, beside / (unit[k] * rate)),
            // Its own normal impulse is none, and the known one stands beside that.
            Asked::Tangent { friction, normal } => (friction, normal / (unit[k] * rate)),
            Asked::Leaning {
                friction, beside, ..
            } => (friction, beside / (unit[k] * rate)),
            Asked::Normal { .. } | Asked::Nothing | Asked::Carried { .. } => (0.0, 0.0),
        };
        // Where what presses is another contact, which, and how many of its units are one of these.
        let leans = match asked[k] {
            Asked::Leaning { on, .. } => Some((on, unit[on] / unit[k])),
            _ => None,
        };
        for (entry, &unknown) in row.iter_mut().zip(&unknowns) {
            let is_own = unknown.0 == k;
            *entry = match (kind, unknown.1) {
                (Kind::Normal, _) => effect(2 * k, unknown),
                (Kind::Forward | Kind::Backward, Kind::Slip) => f64::from(u8::from(is_own)),
                (Kind::Forward, _) => effect(2 * k + 1, unknown),
                (Kind::Backward, _) => -effect(2 * k + 1, unknown),
                (Kind::Slip, Kind::Normal) => match leans {
                    Some((on, units)) if on == unknown.0 => friction * units,
                    None if is_own => friction,
                    _ => 0.0,
                },
                (Kind::Slip, Kind::Forward | Kind::Backward) if is_own => -1.0,
                (Kind::Slip, _) => 0.0,
            };
        }
        q[i] = match kind {
            Kind::Normal => b[2 * k] / rate,
            Kind::Forward => b[2 * k + 1] / rate,
            Kind::Backward => -b[2 * k + 1] / rate,
            Kind::Slip => friction * beside,
        };
    }
    let solution = lemke(&matrix, &q)?;
    let mut forces = vec![[0.0; 2]; m];
    for (&(k, kind), value) in unknowns.iter().zip(&solution.z) {
        let value = value * unit[k] * rate;
        match kind {
            Kind::Normal => {
                forces[k][0] += value;
                if let Asked::Normal { share } = asked[k] {
                    forces[k][1] += share * value;
                }
            }
            Kind::Forward => forces[k][1] += value,
            Kind::Backward => forces[k][1] -= value,
            Kind::Slip => {}
        }
    }
    for (k, asked) in asked.iter().enumerate() {
        if let Asked::Carried { share, on } = asked {
            forces[k][1] = share * forces[*on][0];
        }
    }
    Ok(Answer {
        forces,
        residual: solution.residual,
    })
}

/// The forces or impulses of contacts, along normal and tangent.
#[derive(Clone, Debug)]
pub(super) struct Answer {
    pub forces: Vec<[f64; 2]>,
    /// By how much they miss the conditions, relative to the size of the terms.
    pub residual: f64,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Normal,
    Forward,
    Backward,
    Slip,
}
