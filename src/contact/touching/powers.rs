//! The powers of contact forces: work and losses.

use super::super::drives::{ActingContact, Drives};
use super::reaction::ContactMemory;
use super::{Mode, UnilateralState};
use crate::at::At;
use crate::balance::ContactShare;
use crate::{System, Vector};

/// What contacts do and take, in W.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Powers<'a> {
    /// The work that what moves by itself does through them.
    pub work: f64,
    /// What friction takes, and what yields.
    pub lost: f64,
    /// The part of each contact; none where none has one.
    pub of_each: &'a [ContactShare],
}

impl UnilateralState {
    /// What the contacts do and take. Where the memory has the forces of this state already they are not asked for again.
    pub fn powers<'a, S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        memory: &'a mut ContactMemory<S::Vector, S::Matrix>,
    ) -> Powers<'a> {
        let At { t, q, v, .. } = at;
        // The work of impulses is booked with each step.
        if self.is_free() || self.stepped.is_some() {
            return Powers::default();
        }
        if self.react_or_recall(system, at, memory).is_err() {
            return Powers {
                work: f64::NAN,
                lost: f64::NAN,
                of_each: &[],
            };
        }
        let ContactMemory {
            here,
            equations,
            drives,
            shares,
            ..
        } = memory;
        // What the forces do to the coordinates, what they take from both sides of the contacts, and what of that is
        // lost and not stored.
        let (mut on_coordinates, mut taken, mut lost) = (0.0, 0.0, 0.0);
        shares.clear();
        shares.resize(self.modes.len(), ContactShare::default());
        let mut drives = Drives::new(system, (t, q), drives);
        for (k, own) in shares.iter_mut().enumerate() {
            if self.modes[k] == Mode::Open {
                continue;
            }
            let forces = equations.reaction.forces[k];
            let acting = ActingContact {
                contact: k,
                forces,
                rates: [here.rates[2 * k], here.rates[2 * k + 1]],
            };
            own.work = drives.work(here, &acting, v, || equations.response_to(k, forces));
            for (part, force) in forces.iter().enumerate() {
                let row = here.row(2 * k + part).iter().zip(v.as_slice());
                on_coordinates += force * row.map(|(w, v)| w * v).sum::<f64>();
            }
            if let Mode::Slides(_) | Mode::SlidesAlong(_) = self.modes[k] {
                own.friction = -forces[1] * here.rates[2 * k + 1];
                taken += own.friction;
            }
            if let Some(pressed) = self.compliant_force(here, k) {
                own.compliance_loss = pressed.lost;
                taken -= pressed.force * here.rates[2 * k];
            }
            lost += own.friction + own.compliance_loss;
        }
        Powers {
            // Where constraints move by themselves, the machine counts as work whatever changes its energy.
            work: if drives.constraints_move {
                taken
            } else {
                on_coordinates + taken
            },
            lost,
            of_each: shares,
        }
    }
}
