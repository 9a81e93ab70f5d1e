//! By how much the states of closed contacts hold.

use std::vec::Vec;

use super::super::kinematics::ContactKinematics;
use super::reaction::{ContactMemory, Reaction};
use super::{Margin, Mode, ROUNDING_OF_FORCES, UnilateralState};
use crate::at::At;
use crate::{StepError, System, Vector};

/// The margins by which the states of closed contacts hold.
#[derive(Clone, Debug, Default)]
pub(crate) struct Margins {
    /// For each contact: that it presses, that it slips as it does or sticks, and that a layer is loaded or unloaded
    /// as it is; that a corner of a polygon is on its face.
    pub each: Vec<[Margin; 4]>,
    /// Which contacts have forces that the equations of motion leave undetermined.
    pub shares: Vec<bool>,
}

impl UnilateralState {
    /// The margins by which the states of closed contacts hold: that they press, that those that slip still do so, and that those that
    /// stick need less than their friction.
    pub fn margins<S: System>(&self, system: &S, at: At<'_, S>) -> Result<Margins, StepError> {
        let mut margins = Margins::default();
        self.write_margins(
            system,
            at,
            &mut ContactMemory::new(self, at.q),
            &mut margins,
        )?;
        Ok(margins)
    }

    /// Writes what [`margins`](Self::margins) says, in memory that is there.
    pub fn write_margins<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        memory: &mut ContactMemory<S::Vector, S::Matrix>,
        margins: &mut Margins,
    ) -> Result<(), StepError> {
        margins.each.clear();
        margins.each.resize(self.modes.len(), [Margin::ENDLESS; 4]);
        margins.shares.clear();
        margins.shares.resize(self.modes.len(), false);
        if self.is_free() {
            return Ok(());
        }
        self.react(system, at, memory)?;
        let (here, reaction) = (&memory.here, &memory.equations.reaction);
        // Rates up to those of `resting` are rest: a contact that is at rest there does not stop once more here.
        let is_closed = |k: usize| self.modes[k] != Mode::Open;
        let rest = self.rest(here, self.greatest_rate(), is_closed);
        let rest_of_turning = self.rest_of_turning(here, is_closed);
        for (k, margin) in margins.each.iter_mut().enumerate() {
            // The first tangent says what a contact does along both.
            if self.modes[k] != Mode::Open && !self.across[k] {
                let rest = if self.is_turning(k) {
                    rest_of_turning
                } else {
                    rest
                };
                *margin = self.margins_of(here, reaction, rest, k);
            }
        }
        self.write_sharing(reaction, &mut margins.shares);
        // A contact whose load others carry lifts when these do: its force is 0 until then, and says nothing.
        for (k, margin) in margins.each.iter_mut().enumerate() {
            if reaction.unloaded[k] && !margins.shares[k] {
                margin[0] = Margin::ENDLESS;
            }
        }
        if reaction.is_only {
            return Ok(());
        }
        self.share_margins(here, reaction, at.t, margins)
    }

    /// Whether no contact slips against friction while the equations leave its normal force undetermined.
    pub fn friction_is_known<S: System>(&self, system: &S, at: At<'_, S>) -> bool {
        let slips = |k: usize| {
            self.has_friction[k] && matches!(self.modes[k], Mode::Slides(_) | Mode::SlidesAlong(_))
        };
        let margins = self.margins(system, at);
        margins.is_ok_and(|of| (0..self.modes.len()).all(|k| !(slips(k) && of.shares[k])))
    }

    /// Whether a contact that slips in two directions is braked, and so slow that `error`, that of the rate of each coordinate, decides its direction. The state is
    /// the one at which margins were last computed with `memory`. `faster` marks the contacts that have slipped faster since they began to slip, and is updated: a
    /// contact that has just begun to slip from rest is slow as well.
    pub fn may_fade<V: Vector, M: Vector>(
        &self,
        memory: &ContactMemory<V, M>,
        error: impl Fn(usize) -> f64,
        faster: &mut Vec<bool>,
    ) -> bool {
        let ContactMemory {
            here, equations, ..
        } = memory;
        faster.resize(self.modes.len(), false);
        let mut fades = false;
        for (k, faster) in faster.iter_mut().enumerate() {
            let slides = self.first(k) == k && matches!(self.modes[k], Mode::SlidesAlong(_));
            if !slides {
                *faster = false;
                continue;
            }
            let rows = [1, 3].map(|part| 2 * k + part);
            let slip = rows.map(|row| here.rates[row]);
            let errors = rows.map(|row| {
                let terms = here.row(row).iter().enumerate();
                terms.map(|(i, w)| w.abs() * error(i)).sum::<f64>()
            });
            if slip[0].hypot(slip[1]) > errors[0].hypot(errors[1]) {
                *faster = true;
            } else if *faster {
                let change = rows.map(|row| here.acceleration(row, &equations.reaction.a)[0]);
                fades |= slip[0] * change[0] + slip[1] * change[1] < 0.0;
            }
        }
        fades
    }

    /// The margins of a closed contact with these forces. `rest` is the rate below which a contact is at rest.
    fn margins_of(
        &self,
        here: &ContactKinematics,
        reaction: &Reaction,
        rest: f64,
        k: usize,
    ) -> [Margin; 4] {
        // Where a torque resists rolling, the normal force is that of the contact, which says itself whether it presses.
        let pressed = self.carrier[k].unwrap_or(k);
        let normal = reaction.forces[pressed][0];
        let size = if pressed == k {
            reaction.sizes[k]
        } else {
            reaction.sizes[k].max(here.friction(k)[1] * reaction.sizes[pressed])
        };
        let rounding = ROUNDING_OF_FORCES * size;
        let stays = match here.on_face(k) {
            None => Margin::ENDLESS,
            Some(face) => Margin {
                value: -face.beyond,
                rounding: here.gap_rounding(k),
            },
        };
        let [presses, loads] = if self.is_guide(k) {
            [
                self.margin_of_side(here, (normal, rounding), k),
                Margin::ENDLESS,
            ]
        } else if pressed == k {
            self.margins_of_compliance(here, k).unwrap_or([
                Margin {
                    value: normal,
                    rounding,
                },
                Margin::ENDLESS,
            ])
        } else {
            [Margin::ENDLESS; 2]
        };
        let rounding_of_slip =
            |k: usize| here.rate_rounding_in_time(2 * k + 1, reaction.slip_terms[k]);
        let slips_or_sticks = match self.modes[k] {
            Mode::SlidesAlong(heading) => {
                let [slip, _] = self.slip(here, k);
                let rounding = [k, k + 1].map(rounding_of_slip);
                Margin {
                    value: heading[0] * slip[0] + heading[1] * slip[1],
                    rounding: rounding[0].hypot(rounding[1]).max(rest),
                }
            }
            Mode::Slides(sign) if sign != 0.0 => Margin {
                value: sign * here.rates[2 * k + 1],
                rounding: rounding_of_slip(k).max(rest),
            },
            Mode::Sticks if self.has_friction[k] => {
                let friction = here.friction(k)[1];
                let tangential = reaction.forces[k][1];
                let used = match self.second(k) {
                    Some(second) => tangential.hypot(reaction.forces[second][1]),
                    None => tangential.abs(),
                };
                Margin {
                    value: friction * self.pressing(k, normal) - used,
                    rounding: rounding * (1.0 + friction),
                }
            }
            Mode::Open | Mode::Slides(_) | Mode::Sticks => Margin::ENDLESS,
        };
        [presses, slips_or_sticks, loads, stays]
    }

    /// By how much a guide presses to its side, where that decides on its friction.
    fn margin_of_side(
        &self,
        here: &ContactKinematics,
        (normal, rounding): (f64, f64),
        k: usize,
    ) -> Margin {
        match self.modes[k] {
            Mode::Slides(_) if here.friction(k)[0] > 0.0 => Margin {
                value: self.sides[k] * normal,
                rounding,
            },
            _ => Margin::ENDLESS,
        }
    }

    /// Of contacts that share a load: they hold as long as all of them can hold with some distribution of the forces.
    fn share_margins(
        &self,
        here: &ContactKinematics,
        reaction: &Reaction,
        t: f64,
        Margins { each, shares }: &mut Margins,
    ) -> Result<(), StepError> {
        // These are the margins of a contact that depend on how the load is shared.
        let shared_kinds = |k: usize| {
            let kinds = [!self.is_compliant(k), self.modes[k] == Mode::Sticks];
            kinds.map(|is_shared| is_shared && shares[k])
        };
        let is_doubtful = |(k, margin): (usize, &[Margin; 4])| {
            let shared = match (shares[k], self.is_compliant(k)) {
                (false, _) => 0..0,
                (true, true) => 1..2,
                (true, false) => 0..2,
            };
            // A margin of 0 counts as well: the search for an instant would end where it is 0 with these forces.
            margin[shared].iter().any(|m| m.value <= m.rounding)
        };
        if !each.iter().enumerate().any(is_doubtful) {
            // Every contact holds with these forces. One whose share of them is 0 does not let go for that reason.
            for (k, margin) in each.iter_mut().enumerate() {
                let kinds = margin.iter_mut().zip(shared_kinds(k));
                for (margin, _) in kinds.filter(|(_, shared)| *shared) {
                    if margin.value <= margin.rounding {
                        *margin = Margin::ENDLESS;
                    }
                }
            }
            return Ok(());
        }
        let Some(load) = self.shared_load(here, reaction, t)? else {
            return Ok(());
        };
        for (k, (margin, shared)) in each.iter_mut().zip(load.margins).enumerate() {
            let Some(shared) = shared else {
                continue;
            };
            if shared.shares_normal && self.carrier[k].is_none() && !self.is_compliant(k) {
                margin[0] = shared.margin;
            }
            if self.modes[k] == Mode::Sticks && self.has_friction[k] && shared.shares_friction {
                margin[1] = shared.margin;
            }
        }
        Ok(())
    }
}
