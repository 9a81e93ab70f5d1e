//! The law of contact: normal forces and Coulomb friction, for guided contacts and unilateral contacts alike.
//!
//! ```text
//! unilateral contact   0 ≤ Λₙ ⊥ γₙ ≥ 0                   presses with Λₙ
//! guided contact       N = N⁺ − N⁻,  0 ≤ N⁺ ⊥ N⁻ ≥ 0     presses with |N| = N⁺ + N⁻
//! friction of both     −Λₜ ∈ μ · (normal force) · Sgn γₜ
//! ```
//!
//! A guide is a pair of opposite unilateral contacts without play, of which at most one presses. In the plane all of this is a linear
//! complementarity problem (`problem`), which is solved by pivoting (`lcp`); in space, where friction has two directions, it is a problem on
//! cones (`cone`). Forces that rigid bodies leave undetermined are distributed by the rule of `shares`, for contacts of either kind.

#[cfg(feature = "std")]
mod cone;
#[cfg(feature = "std")]
pub(crate) mod lcp;
#[cfg(feature = "std")]
pub(crate) mod problem;
mod revolution;
pub(crate) mod shares;

/// The margin by which the state of a contact holds, negative if it does not, and the round-off of that margin.
#[cfg(feature = "std")]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Margin {
    pub value: f64,
    pub rounding: f64,
}

#[cfg(feature = "std")]
impl Margin {
    /// The margin of a state that does not end.
    pub(crate) const ENDLESS: Margin = Margin {
        value: f64::INFINITY,
        rounding: 0.0,
    };

    /// Whether a state with this margin has ended, given its margin before: it is clearly lost now, or it was clearly there before. A
    /// margin that is zero to rounding throughout has not ended. The *time* at which a state ended depends on the value alone.
    pub fn is_lost_since(self, before: Margin) -> bool {
        self.value < -self.rounding || (self.value < 0.0 && before.value > before.rounding)
    }
}
