//! Contacts in time stepping: their impulses in a step of a fixed length.
//!
//! ```text
//! qₘ = q + h/2 v        M (v⁺ − v) = h f + Σ wₙ Λₙ + Σ wₜ Λₜ        q⁺ = qₘ + h/2 v⁺
//! 0 ≤ Λₙ ⊥ γₙ⁺ + e min(γₙ, 0) ≥ 0,   −Λₜ ∈ μ Λₙ Sgn(γₜ⁺ + eₜ γₜ)          for contacts with g(qₘ) ≤ 0
//! ```
//!
//! with everything in the middle of the step; for those that were closed, and are beside it there, by
//! `0 ≤ Λₙ ⊥ γₙ⁺ + e min(γₙ, 0) + 2/h g ≥ 0`. With `e γₙ` a contact on its gap that opens by γₙ would come back beyond it, by `−(1 + e) γₙ`, and in the next step open
//! by `e (1 + e) γₙ`: ever faster if e > 0.618. (J. J. Moreau, *Unilateral contact and dry friction in finite freedom dynamics*, 1988,
//! section 8.) This is the law `newton`, with all contacts at once; `laws` has the step for other laws and for static friction. A penetration at the end of a
//! step is removed by the smallest displacement in the metric of inertia (V. Acary,
//! *Projected event-capturing time-stepping schemes for nonsmooth mechanical systems with unilateral contact and Coulomb's
//! friction*, Comput. Methods Appl. Mech. Eng. 256 (2013) 224–250).

mod laws;
mod penetration;

use std::vec::Vec;

use super::drives::{ActingContact, Drives, DrivesMemory};
use super::impact::Meeting;
use super::kinematics::ContactKinematics;
use super::problem::SATURATED;
use super::{ContactTrouble, Impact, Mode, UnilateralState};
use crate::{StepError, System, Vector};
use laws::{ContactsOfStep, ImpulsesOfStep, LawsMemory};
use penetration::PenetrationMemory;

/// What contacts did in a step.
#[derive(Debug, Default)]
pub(crate) struct SteppedContacts {
    /// The impulses that they gave.
    pub impacts: Vec<Impact>,
    /// The work that what moves by itself did through them, and what they took, in J.
    pub work: f64,
    pub lost: f64,
    /// Contacts that were penetrated at the end of the step, and the energy that moving out of them has added, in J: impacts
    /// a little late have taken so much less.
    pub penetrated: Vec<usize>,
    pub energy_added: f64,
    /// Contacts that shared their impulses in another way than by the rule for undetermined forces, (E79), although the motion depends on it.
    pub shared_otherwise: Vec<usize>,
    /// Contacts whose friction permitted no rates with their restitution: they met without.
    pub jammed: Vec<usize>,
}

clone_into_memory!(SteppedContacts {
    impacts,
    work,
    lost,
    penetrated,
    energy_added,
    shared_otherwise,
    jammed,
});

impl SteppedContacts {
    /// Nothing has happened.
    pub fn clear(&mut self) {
        self.impacts.clear();
        self.penetrated.clear();
        self.shared_otherwise.clear();
        self.jammed.clear();
        (self.work, self.lost, self.energy_added) = (0.0, 0.0, 0.0);
    }
}

/// Memory of steps, which serves again from one to the next: they allocate only where they meet more contacts than ever before, where contacts share a load and
/// slip, and in impacts by a law for an instant.
#[derive(Clone, Debug)]
pub(crate) struct SteppingMemory<V, M> {
    /// The rates of all contacts at the end of the step without impulses.
    free: Vec<f64>,
    /// What the contacts do after the step, and their mean forces in it.
    modes: Vec<Mode>,
    forces: Vec<[f64; 2]>,
    meeting: Meeting,
    entries: Vec<usize>,
    matrix: M,
    /// The same rates of those that touch, those at which they may close that are beside what they touch, and the rates with impulses.
    free_of_touching: Vec<f64>,
    ways_back: Vec<f64>,
    after: Vec<f64>,
    impulses: ImpulsesOfStep,
    laws: LawsMemory,
    /// The change of the rates of coordinates by impulses, by those of one contact, and the mean of the rates.
    change: Vec<f64>,
    of_contact: Vec<f64>,
    mean: V,
    drives: DrivesMemory<V>,
    penetration: PenetrationMemory,
}

impl<V: Vector, M: Vector> SteppingMemory<V, M> {
    pub fn new(q: &V) -> Self {
        let n = q.as_slice().len();
        Self {
            free: Vec::new(),
            modes: Vec::new(),
            forces: Vec::new(),
            meeting: Meeting::default(),
            entries: Vec::new(),
            matrix: M::zeros(n * n),
            free_of_touching: Vec::new(),
            ways_back: Vec::new(),
            after: Vec::new(),
            impulses: ImpulsesOfStep::default(),
            laws: LawsMemory::default(),
            change: Vec::new(),
            of_contact: Vec::new(),
            mean: q.zeros_like(),
            drives: DrivesMemory::new(q),
            penetration: PenetrationMemory::default(),
        }
    }
}

impl UnilateralState {
    /// Whether time stepping knows the laws of the contacts: all rigid ones.
    ///
    /// # Errors
    /// The first contact that yields.
    pub fn check_stepping(&self, t: f64) -> Result<(), StepError> {
        let is_not_stepped = |k: &usize| self.is_compliant(*k) || self.is_guide(*k);
        match (0..self.modes().len()).find(is_not_stepped) {
            Some(contact) => Err(StepError::Contact {
                contact,
                trouble: if self.is_guide(contact) {
                    ContactTrouble::GuideNotStepped
                } else {
                    ContactTrouble::NotStepped
                },
                t,
            }),
            None => Ok(()),
        }
    }

    /// Adds the impulses of the contacts in a step of length `h` to `v`, which on entry is what the rates would be at its
    /// end without them. `middle` are time and place in the middle of the step, and `before` the rates at its beginning. What the contacts did is written to
    /// `stepped`, which on entry says nothing.
    ///
    /// # Errors
    /// Where the mass matrix is singular, or no impulses obey the law.
    pub fn step<S: System>(
        &mut self,
        system: &S,
        (t, q): (f64, &S::Vector),
        (before, v): (&S::Vector, &mut S::Vector),
        h: f64,
        (stepped, memory): (
            &mut SteppedContacts,
            &mut SteppingMemory<S::Vector, S::Matrix>,
        ),
    ) -> Result<(), StepError> {
        let SteppingMemory {
            free,
            modes,
            forces,
            meeting,
            entries,
            matrix,
            free_of_touching,
            ways_back,
            after,
            impulses,
            laws,
            change,
            of_contact,
            mean,
            drives,
            ..
        } = memory;
        let here = self.kinematics(system, (t, q, before));
        let count = self.modes().len();
        free.clear();
        free.resize(2 * count, 0.0);
        system.contact_rates(t, q, v, free);
        // What was closed stays so until it opens, though a disc that rolls over a hump is beside it in the middle of a
        // step, by the square of its length: it may come back by as much.
        let lasts = |k: usize| self.modes()[k] != Mode::Open;
        let is_active = |k: &usize| {
            let touches = lasts(*k) || here.is_gap_closed(*k);
            touches && here.is_within(*k, q.as_slice())
        };
        let way_back = |k: usize| {
            if lasts(k) {
                2.0 / h * here.gaps[k].max(0.0)
            } else {
                0.0
            }
        };
        meeting.contacts.clear();
        meeting.contacts.extend(self.in_order().filter(is_active));
        modes.clear();
        modes.resize(count, Mode::Open);
        forces.clear();
        forces.resize(count, [0.0; 2]);
        if meeting.contacts.is_empty() {
            self.set_stepped(modes, forces);
            return Ok(());
        }
        meeting.evaluate(system, (t, q), &here, (matrix, entries))?;
        free_of_touching.clear();
        free_of_touching.extend(meeting.directions.iter().map(|d| free[*d]));
        ways_back.clear();
        ways_back.extend(meeting.contacts.iter().map(|k| way_back(*k)));
        let contacts_of_step = ContactsOfStep {
            touching: self,
            here: &here,
            meeting,
            t,
            h,
            free: free_of_touching,
            ways_back,
        };
        contacts_of_step.write_impulses(impulses, laws)?;
        let ImpulsesOfStep {
            all: impulses,
            last,
            rests,
            shared_otherwise,
            jammed,
        } = &*impulses;
        let Meeting {
            contacts: active,
            directions,
            inertia,
            images,
            g,
            ..
        } = &*meeting;

        let energy_free = system.kinetic_energy(t, q, v);
        // This is the work of the impulses along the changes of the rates that are not theirs.
        let mut known_normal = 0.0;
        for (&direction, impulse) in directions.iter().zip(impulses.as_flattened()) {
            let row = here.row(direction).iter();
            let terms = row.zip(before.as_slice().iter().zip(v.as_slice()));
            known_normal += impulse
                * terms
                    .map(|(w, (before, free))| w * (before - free))
                    .sum::<f64>();
        }
        inertia.write_response(images, impulses.iter().flatten().copied(), change);
        for (v, by) in v.as_mut_slice().iter_mut().zip(&*change) {
            *v += by;
        }

        mean.clone_from(before);
        for (mean, after) in mean.as_mut_slice().iter_mut().zip(v.as_slice()) {
            *mean = 0.5 * (*mean + after);
        }
        let mut drives = Drives::new(system, (t, q), drives);
        let contacts_at = |places: &[usize], contacts: &mut Vec<usize>| {
            contacts.clear();
            contacts.extend(places.iter().map(|place| active[*place]));
        };
        contacts_at(shared_otherwise, &mut stepped.shared_otherwise);
        contacts_at(jammed, &mut stepped.jammed);
        // These are the rates of all directions with the impulses.
        after.clear();
        after.extend(
            (free_of_touching
                .iter()
                .zip(g.chunks_exact(directions.len())))
            .map(|(free, row)| {
                let by = row.iter().zip(impulses.as_flattened());
                free + by.map(|(g, i)| g * i).sum::<f64>()
            }),
        );
        for (place, (&k, &impulse)) in active.iter().zip(impulses).enumerate() {
            let [gap_rate, slip] =
                [0, 1].map(|part| [here.rates[2 * k + part], after[2 * place + part]]);
            // Of contacts that share a load some may press and some not, from step to step: what does not open is closed.
            let opens =
                impulse == [0.0; 2] && gap_rate[1] + way_back(k) > here.rate_rounding(2 * k);
            if self.carrier(k).map_or(opens, |on| modes[on] == Mode::Open) {
                continue;
            }
            let loss = -0.5
                * (impulse[0] * (gap_rate[0] + gap_rate[1]) + impulse[1] * (slip[0] + slip[1]));
            modes[k] = if self.first(k) != k {
                modes[k - 1]
            } else if rests[place] {
                Mode::Sticks
            } else {
                self.mode_after_step(&here, (k, place), (last, after))
            };
            forces[k] = impulse.map(|impulse| impulse / h);
            stepped.lost += loss;
            let acting = ActingContact {
                contact: k,
                forces: impulse,
                rates: [gap_rate, slip].map(|[before, after]| 0.5 * (before + after)),
            };
            let of_contact = &mut *of_contact;
            let response = move || {
                let by = of_contact;
                inertia.write_response(&images[2 * place..][..2], impulse, by);
                &by[..]
            };
            stepped.impacts.push(Impact {
                contact: k,
                gap_rate,
                slip,
                impulse,
                loss,
                work: drives.work(&here, &acting, mean, response),
            });
        }
        (stepped.impacts).sort_unstable_by_key(|impact| impact.contact);
        if !stepped.impacts.is_empty() {
            // The impulses changed the energy by this with the mean rates of the step; what it is beyond the losses is done by what moves.
            let gained = system.kinetic_energy(t, q, v) - energy_free + 0.5 * known_normal;
            stepped.work = gained + stepped.lost;
        }
        self.set_stepped(modes, forces);
        Ok(())
    }

    /// What a contact did in a step that is not the second tangent of another one, with the impulses of those that touched, among which it has this place, and
    /// the rates along their directions at the end of the step.
    fn mode_after_step(
        &self,
        here: &ContactKinematics,
        (k, place): (usize, usize),
        (impulses, after): (&[[f64; 2]], &[f64]),
    ) -> Mode {
        if !self.has_friction(k) {
            return Mode::Slides(0.0);
        }
        let impulse = impulses[place];
        let pressing = match self.carrier(k) {
            Some(_) => impulses[place - 1][0],
            None => impulse[0],
        };
        let most = here.friction(k)[0] * pressing;
        if self.second(k).is_some() {
            let used = [0, 1].map(|part| impulses[place + part][1]);
            let size = used[0].hypot(used[1]);
            let slips = [0, 1].map(|part| after[2 * (place + part) + 1]);
            let speed = slips[0].hypot(slips[1]);
            let [_, rounding] = self.slip(here, k);
            return if size < most * (1.0 - SATURATED) {
                Mode::Sticks
            } else if size > 0.0 {
                Mode::SlidesAlong(used.map(|used| -used / size))
            } else if speed > rounding[0].hypot(rounding[1]) {
                Mode::SlidesAlong(slips.map(|slip| slip / speed))
            } else {
                Mode::Sticks
            };
        }
        let slip = after[2 * place + 1];
        if impulse[1].abs() < most * (1.0 - SATURATED) {
            Mode::Sticks
        } else if impulse[1] != 0.0 {
            Mode::Slides(-impulse[1].signum())
        } else if slip.abs() > here.rate_rounding(2 * k + 1) {
            Mode::Slides(slip.signum())
        } else {
            Mode::Sticks
        }
    }
}
