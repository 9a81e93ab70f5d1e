//! Forces in unilateral contacts at a state.

use std::vec::Vec;

use super::touching::Settled;
use super::{Mode, UnilateralState};
use crate::at::At;
use crate::{StepError, System};

/// A unilateral contact at a state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct UnilateralForce {
    /// How far it is open, in m.
    pub gap: f64,
    /// How fast it opens, in m/s.
    pub gap_rate: f64,
    /// How fast it slips, in m/s; 0 without friction. Of the [rolling](crate::UnilateralContact::is_rolling_resistance) of a contact how fast it turns,
    /// in rad/s.
    pub slip: f64,
    /// What presses, in N.
    pub normal: f64,
    /// The friction along the direction of the slip, in N; the torque that resists rolling, in N m.
    pub friction: f64,
    /// The work that has crushed its layer so far, in J; 0 where it is none.
    pub crushing_work: f64,
    /// Whether it is closed, and lasts.
    pub closed: bool,
    /// Whether it is closed and does not slip.
    pub sticks: bool,
}

/// Accelerations of a machine with unilateral contacts at a state, and the forces in these: what touches within
/// rounding and does not open is closed, and all that is closed is asked together whether it lifts, slips or sticks.
/// What is about to collide is open until it does. What yields is pressed where it is penetrated and its force is
/// positive; a layer is taken to be pressed for the first time.
///
/// A run knows more: there a contact stays closed until its force vanishes.
///
/// # Errors
/// Where the machine has no accelerations, or the friction of the contacts leaves none.
pub fn unilateral_forces<S: System>(
    system: &S,
    at: At<'_, S>,
    a: &mut S::Vector,
) -> Result<Vec<UnilateralForce>, StepError> {
    let At { t, q, v, .. } = at;
    let (mut touching, settled) = settled_at(system, at)?;
    touching.take_sides(&settled, None);
    touching.set_modes(settled.modes);
    touching.load_layers(system, t, q, v);
    touching.forces_shared(system, at, a, Some(&settled.forces))
}

/// The contacts that share their load at a state otherwise than equally stiff contacts would, although the motion depends on it, because the distribution by this
/// rule, (E79), could not be computed there: the accelerations of [`unilateral_forces`] are then some of several that are possible. Usually there are none.
///
/// # Errors
/// As [`unilateral_forces`].
pub fn loads_shared_otherwise<S: System>(
    system: &S,
    at: At<'_, S>,
) -> Result<Vec<usize>, StepError> {
    if system.unilateral_contacts().len() == 0 {
        return Ok(Vec::new());
    }
    let (_, settled) = settled_at(system, at)?;
    let mut contacts = settled.shared_otherwise;
    contacts.sort_unstable();
    contacts.dedup();
    Ok(contacts)
}

/// What contacts that touch at a state do next, and these without that.
fn settled_at<S: System>(
    system: &S,
    at: At<'_, S>,
) -> Result<(UnilateralState, Settled), StepError> {
    let At { t, q, v, .. } = at;
    let touching = UnilateralState::new(system);
    let (touches, _) = touching.near(system, (t, q, v), true, &[]);
    let closed = touching.persisting(system, (t, q, v), &touches, true);
    let resting = touching.resting(system, (t, q, v), &closed);
    let settled = touching.settled(system, at, &closed, &resting, &[])?;
    Ok((touching, settled))
}

/// The rigid contacts that are penetrated at a state by more than rounding, each with the depth in m. No run can start there, and
/// [`unilateral_forces`] takes them to touch.
pub fn penetrations<S: System>(
    system: &S,
    (t, q, v): (f64, &S::Vector, &S::Vector),
) -> Vec<(usize, f64)> {
    if system.unilateral_contacts().len() == 0 {
        return Vec::new();
    }
    let here = UnilateralState::new(system).kinematics_of_all(system, (t, q, v));
    let contacts = system.unilateral_contacts().enumerate();
    let rigid = contacts.filter(|(_, contact)| {
        contact.compliance.is_none() && !contact.is_rolling_resistance && !contact.is_second_tangent
    });
    rigid
        .map(|(k, _)| (k, -here.gaps[k]))
        .filter(|&(k, depth)| depth > 0.0 && depth > here.gap_rounding(k))
        .collect()
}

impl UnilateralState {
    /// Accelerations and forces while everything stays as it is.
    pub(crate) fn forces<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        a: &mut S::Vector,
    ) -> Result<Vec<UnilateralForce>, StepError> {
        self.forces_shared(system, at, a, None)
    }

    /// The same, with the forces of contacts that may share their load in several ways.
    fn forces_shared<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        a: &mut S::Vector,
        shares: Option<&[[f64; 2]]>,
    ) -> Result<Vec<UnilateralForce>, StepError> {
        use crate::Vector;
        let At { t, q, v, .. } = at;
        let here = self.kinematics_of_all(system, (t, q, v));
        let mut reaction = self.reaction(system, at)?;
        a.as_mut_slice().copy_from_slice(&reaction.a);
        if let (false, Some(shares)) = (reaction.is_only, shares) {
            reaction.forces.copy_from_slice(shares);
        }
        let of_contact = |(k, mode): (usize, &Mode)| UnilateralForce {
            gap: here.gaps[k],
            gap_rate: here.rates[2 * k],
            slip: here.rates[2 * k + 1],
            normal: reaction.forces[self.carrier(k).unwrap_or(k)][0],
            friction: reaction.forces[k][1],
            crushing_work: self.crushing_work(&here, k),
            closed: *mode != Mode::Open,
            sticks: *mode == Mode::Sticks,
        };
        Ok(self.modes().iter().enumerate().map(of_contact).collect())
    }
}
