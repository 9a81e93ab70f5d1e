//! The ways out of Painlevé's paradox.

use std::vec::Vec;

use super::super::delassus::{Inertia, matrix};
use super::super::drives::{ActingContact, Drives, DrivesMemory};
use super::super::routh::{self, Expansion, SingleImpact};
use super::super::touching::UnilateralState;
use super::super::{ContactTrouble, Painleve};
use super::Impact;
use super::meeting::between;
use crate::at::At;
use crate::{Singular, StepError, System};

/// Inverse masses below this, relative to the terms that they are the sum of, are rounding.
const ROUNDING_OF_MASSES: f64 = 1e-11;

/// A way out of Painlevé's paradox.
pub(crate) enum ParadoxResolution {
    /// The contact opens.
    Opens(usize),
    /// An impact without a collision, and how it changes the rates.
    Impact { impact: Impact, change: Vec<f64> },
}

impl UnilateralState {
    /// Whether any contact is to have a way out of Painlevé's paradox.
    pub fn may_have_paradox(&self) -> bool {
        self.painleve.contains(&Painleve::Impact)
    }

    /// The way out of Painlevé's paradox of a contact that slips and whose friction leaves no motion, or several. None
    /// if there is no such contact.
    pub fn resolve_paradox<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        closed: &[bool],
        resting: &[bool],
    ) -> Result<Option<ParadoxResolution>, StepError> {
        let may = |k: usize| closed[k] && self.has_friction(k) && !self.is_compliant(k);
        let may = |k: usize| may(k) && !resting[k] && self.painleve[k] == Painleve::Impact;
        let At { t, q, v, .. } = at;
        let Some(first) = (0..closed.len()).find(|k| may(*k)) else {
            return Ok(None);
        };
        let here = self.kinematics(system, (t, q, v));
        let singular = |singular: Singular| StepError::Singular { singular, t };
        let inertia = Inertia::new(system, t, q).map_err(singular)?;
        let free = Self::free(system, at)?;
        for k in (first..closed.len()).filter(|k| may(*k)) {
            let images = [2 * k, 2 * k + 1].map(|direction| inertia.image(here.row(direction)));
            let g = matrix(&images);
            let slip = here.rates[2 * k + 1];
            let pressed = g[0] - slip.signum() * here.friction(k)[0] * g[1];
            let opens = here.acceleration(2 * k, &free)[0];
            if pressed > ROUNDING_OF_MASSES * g[0] {
                continue;
            }
            if opens >= 0.0 {
                return Ok(Some(ParadoxResolution::Opens(k)));
            }
            let trouble = |trouble| StepError::Contact {
                contact: k,
                trouble,
                t,
            };
            if (0..closed.len()).any(|other| other != k && closed[other]) {
                return Err(trouble(ContactTrouble::Paradox));
            }
            let single_impact = SingleImpact {
                inverse_masses: [g[0], g[1], g[3]],
                rates: [0.0, slip],
                restitution: here.restitution(k)[0],
                friction: here.friction(k),
            };
            let impulse = routh::impulse(single_impact, Expansion::Impulse)
                .ok_or_else(|| trouble(ContactTrouble::Paradox))?;
            let change = inertia.response(&images, impulse);
            let by = |row: usize| g[2 * row] * impulse[0] + g[2 * row + 1] * impulse[1];
            let gap_rate = [0.0, by(0)];
            let slip = [slip, slip + by(1)];
            let loss = -0.5 * (impulse[0] * gap_rate[1] + impulse[1] * (slip[0] + slip[1]));
            let acting = ActingContact {
                contact: k,
                forces: impulse,
                rates: [0.5 * gap_rate[1], 0.5 * (slip[0] + slip[1])],
            };
            let mean = between(v, &change);
            let impact = Impact {
                contact: k,
                gap_rate,
                slip,
                impulse,
                loss,
                work: Drives::new(system, (t, q), &mut DrivesMemory::new(q)).work(
                    &here,
                    &acting,
                    &mean,
                    || &change,
                ),
            };
            return Ok(Some(ParadoxResolution::Impact { impact, change }));
        }
        Ok(None)
    }
}
