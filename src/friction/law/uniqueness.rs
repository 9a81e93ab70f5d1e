//! Proofs that the law of friction permits one motion at most, (E80).
//!
//! Let `n` be the normal forces |N| of all contacts. With given `n` the law is that of forces `F` with `|Fᵢ| ≤ bᵢ nᵢ`, b the coefficients,
//! under which `½ F·W F + w₀·F` is least, where `W` are the slip rates by unit forces, symmetric and positive semidefinite. The accelerations
//! that belong to them are unique. If friction forces do not change `n`, this completes the proof.
//!
//! Otherwise `n` is a fixed point of `n ↦ |N₀ + K F(n)|`. If this is a contraction in any norm there is one fixed point (S. Banach), and with it
//! one motion. While some contacts `S` at rest stick and others `L` slide, `δF_L` follows `±b δn`, and `δF_S = −W_SS⁻¹ W_SL δF_L`.
//!
//! *In a maximum norm.* If there are weights `u > 0` with
//!
//! ```text
//! wᵢᵢ uᵢ > Σ_{j≠i} |wᵢⱼ| uⱼ   of contacts at rest,        uᵢ > bᵢ Σⱼ |Kᵢⱼ| uⱼ   of all,
//! ```
//!
//! then `⟨W_SS⟩⁻¹ |W_SL| u_L ≤ u_S` with the comparison matrix ⟨W⟩ (A. Berman, R. J. Plemmons, *Nonnegative Matrices in the Mathematical
//! Sciences*, 1979, chapter 6), hence `|δFᵢ|/uᵢ ≤ max bⱼ |δnⱼ|/uⱼ`, and the map is a contraction in the norm `max bᵢ |δnᵢ|/uᵢ`.
//!
//! *In the norm of energy.* The forces of sticking contacts are those with which `δF·W δF` is least, so that this is at most that of `±b δn` in the
//! sliding contacts alone, and `δF·W δF ≤ Σ dᵢ (bᵢ δnᵢ)²` where `W ≤ diag d`. On a surface the same holds, since a slip that turns only
//! takes energy. The map is a contraction in the norm `Σ dᵢ (bᵢ δnᵢ)²` if `W − Kᵀ diag(dᵢ bᵢ²) K` is positive definite.

use super::super::per_contact::{FEW_CONTACTS, Values};
use super::{Each, Mode, Motion, OpenStates, Parts};

/// How much conditions must be satisfied by, relative to their terms, for rounding not to matter.
const MORE_THAN_ROUNDING: f64 = 1e-9;

/// How many improvements of the weights are tried.
const MOST_IMPROVEMENTS: usize = 100;

impl OpenStates {
    /// Whether it is proved that no other motion is possible than one in these states.
    pub(in crate::friction) fn has_one_motion(&self, parts: &Parts<'_>, mode: &Mode) -> bool {
        let asked = || (0..parts.layout.contacts()).filter(|k| self.motion[*k].is_none());
        // Where some hold more at rest this shows that no other motion is possible in which all of these stick.
        let holds_more = asked().any(|k| parts.static_friction(k) > parts.friction(k));
        (!holds_more || asked().all(|k| mode.motion[k] == Motion::Sticks))
            && (parts.presses_regardless_of_friction()
                || self.contracts_greatest(parts)
                || self.contracts_energy(parts))
    }

    /// Whether a contact is at rest, as far as is known.
    fn rests(&self, contact: usize) -> bool {
        !matches!(
            self.motion[contact],
            Some(Motion::Slides(_) | Motion::SlidesAlong)
        )
    }

    /// The greatest coefficient of friction that a contact may have.
    fn coefficient(&self, parts: &Parts<'_>, contact: usize) -> f64 {
        if self.rests(contact) {
            parts.static_friction(contact)
        } else {
            parts.friction(contact)
        }
    }

    /// Whether normal forces are the fixed point of a contraction in a maximum norm. On surfaces this is not asked.
    fn contracts_greatest(&self, parts: &Parts<'_>) -> bool {
        let layout = parts.layout;
        let count = layout.contacts();
        if layout.seconds != 0 {
            return false;
        }
        let is_smooth = |k: usize| self.coefficient(parts, k) == 0.0;
        // What the weights of the others require of the weight of a contact.
        let required = |k: usize, weights: &Each| {
            if is_smooth(k) {
                return 0.0;
            }
            let (mut by_slip, mut by_pressing) = (0.0, 0.0);
            for j in (0..count).filter(|j| !is_smooth(*j)) {
                if j != k {
                    by_slip += parts.at(1 + j, parts.slip_rate(k)).abs() * weights[j];
                }
                by_pressing += parts.presses_by_unit(k, j) * weights[j];
            }
            let by_pressing = self.coefficient(parts, k) * by_pressing;
            if !self.rests(k) {
                return by_pressing;
            }
            // A contact that friction does not move has any friction force.
            let own = parts.at(1 + k, parts.slip_rate(k)).abs();
            if own > 0.0 {
                f64::max(by_slip / own, by_pressing)
            } else {
                f64::INFINITY
            }
        };
        let mut weights = Each::new(count, 1.0);
        for _ in 0..MOST_IMPROVEMENTS {
            let needed = Each::from_fn(count, |k| required(k, &weights));
            let mut both = weights.iter().zip(&*needed);
            if both.all(|(weight, needed)| *needed <= weight * (1.0 - MORE_THAN_ROUNDING)) {
                return true;
            }
            if !needed.iter().all(|needed| *needed < 1e100) {
                return false;
            }
            weights = Each::from_fn(count, |k| 1.0 + needed[k]);
        }
        false
    }

    /// Whether normal forces are the fixed point of a contraction in the norm of energy.
    fn contracts_energy(&self, parts: &Parts<'_>) -> bool {
        let layout = parts.layout;
        let count = layout.contacts();
        let slip = |i: usize, j: usize| parts.at(1 + j, parts.slip_rate(i));
        let is_smooth = |k: usize| self.coefficient(parts, k) == 0.0;
        let own = Each::from_fn(count, |k| slip(k, k).abs());
        if (0..count).any(|k| !is_smooth(k) && own[k] == 0.0) {
            return false;
        }
        let rough = || (0..count).filter(|k| !is_smooth(*k));
        let mut matrix: Values<f64, { FEW_CONTACTS * FEW_CONTACTS }> =
            Values::new(count * count, 0.0);
        for i in rough() {
            for j in rough() {
                matrix[i * count + j] = 0.5 * (slip(i, j) + slip(j, i));
            }
        }
        // W ≤ diag d with dᵢ = Σⱼ |wᵢⱼ| √(wᵢᵢ/wⱼⱼ).
        let bound = |i: usize| {
            let terms = rough().map(|j| slip(i, j).abs() * crate::math::sqrt(own[i] / own[j]));
            terms.sum::<f64>()
        };
        for k in rough().filter(|k| !layout.is_second(*k)) {
            let most = if layout.has_second(k) {
                bound(k).max(bound(k + 1))
            } else {
                bound(k)
            };
            let coefficient = self.coefficient(parts, k);
            let factor = most * coefficient * coefficient;
            for i in rough() {
                let by_i = parts.unit_pressing(k, i);
                for j in rough() {
                    let by_j = parts.unit_pressing(k, j);
                    let product: f64 = by_i.iter().zip(by_j).map(|(x, y)| x * y).sum();
                    matrix[i * count + j] -= factor * product;
                }
            }
        }
        // Elimination of a symmetric matrix that is positive definite has positive pivots.
        for k in rough() {
            let pivot = matrix[k * count + k];
            if pivot.is_nan() || pivot <= MORE_THAN_ROUNDING * own[k] {
                return false;
            }
            for i in rough().filter(|i| *i > k) {
                let factor = matrix[i * count + k] / pivot;
                for j in k..count {
                    matrix[i * count + j] -= factor * matrix[k * count + j];
                }
            }
        }
        true
    }
}
