//! How a contact meets what it touches within a step of time stepping.
//!
//! Without impulses the gap of a contact would be a parabola in the step, with the rate γ at its beginning and γ + h α at its end. Where it would be negative at the end, it
//! passes 0 at a rate −V at some instant, after which a part w of the step is left. If the contact was alone, an impact at that instant would open it at the rate e V, and α
//! would change this by w h α. Of an impulse Λ at that instant, the part w of the step is left to move what it pushes,
//!
//! ```text
//! q⁺ = q + h/2 (v + v⁺) + Σ (w − ½) h M⁻¹ Wᵀ Λ
//! ```
//!
//! and the energy changes, with forces, M and rows that are constant in the step, by
//!
//! ```text
//! ½ Σ Λ (γ + γ⁺ + (1 − 2 w) h α)
//! ```
//!
//! beside the work of the forces, however contacts depend on each other. With `γ⁺ ≥ b ⊥ Λ ≥ 0` each bracket is a number that is known before the impulses are; `b` and `w` are those of the
//! contact alone, whose energy does not increase, so that none of these numbers is positive, and impulses without friction never add energy.
//!
//! | a contact | b | the part of the step that is left |
//! | --- | --- | --- |
//! | bounces | e V + w h α | w |
//! | returns: it bounces, and would meet again within the step | −e V | that with which its gap ends at 0 |
//! | rests: all of its further bounces, which take 2 e V/(a (1 − e)) with a = −α, would be within the step | 0 | that with which its gap ends at 0 |
//! | stays beside what it touches | −2/h times its gap in the middle, as far as that is positive or due to the curvature of what is touched | ½ |
//!
//! Of contacts that inertia couples, a is the greatest one of all of them: what presses the lowest of a pile of bodies presses those above it, which without impulses fall together.
//!
//! What rests is pressed throughout the step, and then w = ½. Contacts that inertia couples all have w = ½: feet of one body would otherwise have to open at rates that no motion of it has, and
//! an impulse on one foot would turn the body into the floor under another that holds it. Of these, a contact that would bounce and return rests, and what rests comes to its gap as what stays beside it does: its rates are no more
//! than `h α`, which is the error of the method. If it closes in the second half of the step, it does so in the next one. A contact that bounces may then end beyond its gap, from where moving it out takes no more energy than is left.

use super::super::kinematics::ContactKinematics;

/// Gaps at the end of a step are known up to so many of their roundings: that of the displacements that close them, for each of some terms.
const KNOWN: f64 = 4.0;

/// What a contact does in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Manner {
    /// It does not close by itself, but is closed, or was.
    Beside,
    /// It closes for good.
    Rests,
    /// It bounces, and falls back to its gap.
    Returns,
    /// It bounces.
    Bounces,
}

/// How a contact meets what it touches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Approach {
    pub manner: Manner,
    /// The rate at which it opens at the end of the step if it presses: b.
    pub least: f64,
    /// The part of the step that is left after its impulse: w.
    pub left: f64,
    /// The rate at which it closes: V.
    pub arrival: f64,
}

/// What is known of a contact in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    /// The gap in the middle of the step.
    pub gap: f64,
    /// Its rates at both ends without impulses.
    pub rates: [f64; 2],
    /// The acceleration of the gap that rates alone cause.
    pub bias: f64,
    pub h: f64,
    /// Whether it was closed in the step before.
    pub lasts: bool,
    /// Whether inertia couples it with another contact that touches.
    pub is_coupled: bool,
    /// Within which the gap is closed.
    pub rounding: f64,
    /// Whether it is closed and at rest at the beginning of the step, up to rounding.
    pub is_at_rest: bool,
    /// The acceleration with which others press it together, or forces those that inertia couples with it, if that is known.
    pub pressed: f64,
    pub restitution: f64,
}

/// A fall to the gap: the rate at which it is reached, the part of the step that is left then, and the acceleration.
struct Fall {
    arrival: f64,
    left: f64,
    acceleration: f64,
}

impl Course {
    /// Of a contact, with the rate of its gap at the end without impulses.
    pub fn of(here: &ContactKinematics, contact: usize, free: f64, h: f64) -> Self {
        let before = here.rates[2 * contact];
        let gap = here.gaps[contact];
        let rounding = here.gap_rounding(contact);
        let at_start = (gap - 0.5 * h * before).abs() <= rounding;
        Self {
            gap,
            rates: [before, free],
            bias: here.biases[2 * contact],
            h,
            lasts: false,
            is_coupled: false,
            rounding,
            is_at_rest: at_start && before.abs() <= here.rate_rounding(2 * contact),
            pressed: 0.0,
            restitution: here.restitution(contact)[0],
        }
    }

    /// Whether the gap would be negative at the end of the step.
    pub fn closes(&self) -> bool {
        self.fall(0.0).is_some() && self.fall(self.bias).is_some()
    }

    /// Whether its gap is closed in the middle of the step.
    pub fn is_closed(&self) -> bool {
        self.gap <= self.rounding
    }

    /// Whether it meets what it touches in the next step only: one of coupled contacts that closes for good behind the middle of the step. It is moved out of what it penetrates, and stops in the
    /// next step at the same rate as the other feet of its body, 0.
    pub fn waits(&self) -> bool {
        let may_wait = self.is_coupled && !self.lasts && !self.is_closed();
        may_wait && self.approach().manner == Manner::Rests
    }

    /// The acceleration with which forces close it, if they do.
    pub fn acceleration(&self) -> f64 {
        let [before, after] = self.rates;
        (before - after) / self.h - self.bias
    }

    /// How it falls to its gap, with this acceleration beside that of the forces.
    fn fall(&self, bias: f64) -> Option<Fall> {
        let h = self.h;
        let [before, after] = self.rates;
        let [before, after] = [before - 0.5 * h * bias, after + 0.5 * h * bias];
        let depth = -(self.gap + 0.5 * h * self.rates[1] + 0.125 * h * h * bias);
        if !(depth > 0.0 && after < 0.0) {
            return None;
        }
        let (speed, acceleration) = (-after, (before - after) / h);
        let arrival = (speed * speed - 2.0 * acceleration * depth).max(0.0).sqrt();
        let left = (2.0 * depth / (arrival + speed) / h).min(1.0);
        Some(Fall {
            arrival,
            left,
            acceleration,
        })
    }

    /// How it meets what it touches.
    pub fn approach(&self) -> Approach {
        let (h, e) = (self.h, self.restitution);
        let beside = Approach {
            manner: Manner::Beside,
            least: self.least_beside(),
            left: 0.5,
            arrival: 0.0,
        };
        // What it does follows from the gap itself, and its rates from the rows in the middle of the step, with which energies are exact.
        let (Some(fall), Some(curved)) = (self.fall(0.0), self.fall(self.bias)) else {
            return beside;
        };
        let opening = e * curved.arrival;
        let acceleration = curved.acceleration.max(self.pressed);
        let time = curved.left * h;
        let rests = acceleration > 0.0 && 2.0 * opening <= (1.0 - e) * acceleration * time;
        let manner = if rests || self.is_at_rest {
            Manner::Rests
        } else if opening < 0.5 * curved.acceleration * time {
            Manner::Returns
        } else {
            Manner::Bounces
        };
        let is_pressed = match manner {
            Manner::Bounces => false,
            Manner::Rests => self.lasts || self.is_coupled,
            Manner::Returns | Manner::Beside => self.is_coupled,
        };
        if self.is_at_rest || is_pressed {
            return Approach {
                manner: Manner::Rests,
                ..beside
            };
        }
        if self.is_coupled {
            let [before, after] = self.rates;
            let arrival = -0.5 * (before + after);
            return Approach {
                manner,
                least: e * arrival + 0.5 * (after - before),
                left: 0.5,
                arrival,
            };
        }
        let least = match manner {
            Manner::Rests | Manner::Beside => 0.0,
            Manner::Returns => -e * fall.arrival,
            Manner::Bounces => e * fall.arrival - fall.acceleration * fall.left * h,
        };
        let left = match manner {
            Manner::Bounces => fall.left,
            _ => self.left_to_end_at_gap(least),
        };
        Approach {
            manner,
            least,
            left,
            arrival: fall.arrival,
        }
    }

    /// The rate at the end of a contact that is pressed throughout the step. A body that rolls into a bowl is beyond its gap in the middle of the step, and opens it along the row there
    /// at the end, by what its path is bent in half of the step: more would be a bounce, and less take energy. Feet of one body would have to do so by rates that no motion of it has.
    fn least_beside(&self) -> f64 {
        let to_gap = -2.0 / self.h * beyond_rounding(self.gap, self.rounding);
        let is_alone = self.lasts && !self.is_coupled;
        let bent = if is_alone {
            -0.5 * self.h * self.bias
        } else {
            0.0
        };
        to_gap.min(bent.max(0.0))
    }

    /// The part of the step that is left after an impulse with which the contact ends at its gap, and at this rate.
    fn left_to_end_at_gap(&self, rate: f64) -> f64 {
        let depth = -(self.gap + 0.5 * self.h * self.rates[1]);
        let change = rate - self.rates[1];
        if change > 0.0 {
            (depth / (self.h * change)).clamp(0.0, 1.0)
        } else {
            0.5
        }
    }
}

/// What of a gap is more than its rounding. Feet of a rigid body whose gaps are rounding could not all close them, and the motion would depend on which of them do.
pub(super) fn beyond_rounding(gap: f64, rounding: f64) -> f64 {
    gap.signum() * (gap.abs() - KNOWN * rounding).max(0.0)
}
