//! Proofs that the law of friction permits one motion at most.
//!
//! Let `n` be the normal forces |N| of all contacts. With given `n` the law is that of forces `F` with `|Fᵢ| ≤ bᵢ nᵢ`, b the coefficients,
//! under which `½ F·W F + w₀·F` is least, where `W` are the slip rates by unit forces, symmetric and positive semidefinite. The accelerations
//! that go with it are unique. If friction forces change no `n`, this is all. (E80)
//!
//! Otherwise `n` is a fixed point of `n ↦ |N₀ + K F(n)|`. While some contacts `S` at rest stick and others `L` slide,
//! `δF_S = −W_SS⁻¹ W_SL δF_L`. If there are weights `u > 0` with
//!
//! ```text
//! wᵢᵢ uᵢ > Σ_{j≠i} |wᵢⱼ| uⱼ   of contacts at rest,        uᵢ > bᵢ Σⱼ |Kᵢⱼ| uⱼ   of all,
//! ```
//!
//! then `⟨W_SS⟩⁻¹ |W_SL| u_L ≤ u_S` with the comparison matrix ⟨W⟩ (A. Berman, R. J. Plemmons, *Nonnegative Matrices in the Mathematical
//! Sciences*, 1979, chapter 6), hence `|δFᵢ|/uᵢ ≤ max bⱼ |δnⱼ|/uⱼ`, and the map is a contraction in the norm `max bᵢ |δnᵢ|/uᵢ`: there is one
//! fixed point (S. Banach), and with it one motion.

use super::{Each, Mode, Motion, OpenStates, Parts};

/// How much the conditions on the weights must be satisfied by, relative to their terms, for rounding not to matter.
const MORE_THAN_ROUNDING: f64 = 1e-9;

/// How many improvements of the weights are tried.
const MOST_IMPROVEMENTS: usize = 400;

impl OpenStates {
    /// Whether it is proved that no other motion is possible than one in these states.
    pub(in crate::friction) fn has_one_motion(&self, parts: &Parts<'_>, mode: &Mode) -> bool {
        let mut asked = (0..parts.layout.contacts()).filter(|k| self.motion[*k].is_none());
        // With more friction at rest this holds for what sticks, since it would hold with the friction of sticking throughout.
        let holds = |k: usize| {
            mode.motion[k] == Motion::Sticks || parts.static_friction(k) <= parts.friction(k)
        };
        asked.all(holds) && (parts.presses_regardless_of_friction() || self.is_contraction(parts))
    }

    /// Whether normal forces are the fixed point of a contraction.
    fn is_contraction(&self, parts: &Parts<'_>) -> bool {
        let layout = parts.layout;
        let count = layout.contacts();
        if layout.seconds != 0 {
            return false;
        }
        let rests = |k: usize| !matches!(self.motion[k], Some(Motion::Slides(_)));
        let coefficient = |k: usize| {
            if rests(k) {
                parts.static_friction(k)
            } else {
                parts.friction(k)
            }
        };
        // What the weights of the others require of the weight of a contact.
        let required = |k: usize, weights: &Each| {
            let smooth = |j: usize| coefficient(j) == 0.0;
            if smooth(k) {
                return 0.0;
            }
            let (mut by_slip, mut by_pressing) = (0.0, 0.0);
            for j in (0..count).filter(|j| !smooth(*j)) {
                if j != k {
                    by_slip += parts.at(1 + j, parts.slip_rate(k)).abs() * weights[j];
                }
                by_pressing += parts.presses_by_unit(k, j) * weights[j];
            }
            let by_pressing = coefficient(k) * by_pressing;
            if rests(k) && by_slip > 0.0 {
                let own = parts.at(1 + k, parts.slip_rate(k)).abs();
                f64::max(by_slip / own, by_pressing)
            } else {
                by_pressing
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
}
