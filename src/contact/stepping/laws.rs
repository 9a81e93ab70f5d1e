//! The laws for the impulses of contacts in a step of time stepping.
//!
//! **Static friction.** A contact that rests when the step begins, because it stuck in the step before or because neither its gap nor its slip changes, may stick
//! with its static friction; any other one slips, or is stopped, with its kinetic friction:
//!
//! ```text
//! |Λₜ| ≤ μ₀ Λₙ  where ξ = γₜ⁺ + eₜ γₜ = 0,      Λₜ = −μ Λₙ ξ/|ξ|  elsewhere
//! ```
//!
//! For fixed normal impulses the values of this law are convex and its graph is closed, so that there always is a solution, and often there are two: one that sticks
//! and one that slips. Contacts begin with the cone of their static friction; those that slip with it get that of their kinetic friction, and all are solved for again.
//! If the slip of a contact that was closed reverses within the step, it has passed through rest, and may stick there with its static friction if all contacts then hold. Each cone
//! changes at most twice, so this ends after at most `2 n + 1` problems of fixed cones. (Laws with a friction that falls at rest: R. I. Leine, N. van de Wouw,
//! *Stability and Convergence of Mechanical Systems with Unilateral Constraints*, 2008, chapter 5.)
//!
//! **Laws of impact.** `newton` with all contacts at once is part of the problem of the step, as Moreau has it. Other laws define impulses at a single instant,
//! without forces that act meanwhile: with them a compression by the weight of a body at rest would be followed by an expansion. Therefore a step in which an open
//! contact closes is divided into half a step with the forces, the impact, and another half step:
//!
//! ```text
//! M (v' − v)   = h/2 f + W Λ'      for contacts closed in the previous step, without restitution
//! M (v* − v')  = W Λ*              by the law of impact
//! M (v⁺ − v*)  = h/2 f + W Λ''     for touching contacts, without restitution
//! ```
//!
//! and any other step is one problem without restitution. The impulses of the half steps dissipate energy, so that only the law of impact can add energy besides
//! the work of the forces. A law for one contact at a time, or that of a `sequence`, is applied to one contact after the other, the one that closes fastest first,
//! a limited number of times; a contact that is still closing then is stopped by the second half step, without restitution.

use std::vec;
use std::vec::Vec;

use super::super::impact::{Meeting, Told};
use super::super::kinematics::{ContactKinematics, ROUNDING};
use super::super::problem::{Answer, ContactUnknowns, SATURATED};
use super::super::{ContactTrouble, ImpactLaw, ImpactOrder, Mode, UnilateralState, undetermined};
use crate::StepError;

/// How large the residual of impulses may be.
const MOST_RESIDUAL: f64 = 1e-8;

/// Rates up to this, relative to the greatest rate, are those of contacts that are held.
const HELD: f64 = 1e-9;

/// How often a contact is hit in one step by a law that takes contacts one after the other, at most, for each of the contacts.
const MOST_HITS: usize = 32;

/// The contacts that touch in a step.
pub(super) struct ContactsOfStep<'a> {
    pub touching: &'a UnilateralState,
    pub here: &'a ContactKinematics,
    /// These contacts, and their rates at the beginning of the step.
    pub meeting: &'a Meeting,
    /// Time and length of the step.
    pub t: f64,
    pub h: f64,
    /// The rates that there would be at its end if nothing touched.
    pub free: &'a [f64],
    /// The rates at which contacts may close that are beside what they touch.
    pub ways_back: &'a [f64],
}

/// Impulses of the contacts that touch in a step.
#[derive(Clone, Debug, Default)]
pub(super) struct ImpulsesOfStep {
    pub all: Vec<[f64; 2]>,
    /// What of these acted last, from which follows what contacts do at the end of the step.
    pub last: Vec<[f64; 2]>,
    /// Which contacts are held by their static friction.
    pub rests: Vec<bool>,
    /// The places of contacts that share their impulses in another way than by the rule, and of those whose friction permitted no rates with their restitution.
    pub shared_otherwise: Vec<usize>,
    pub jammed: Vec<usize>,
}

/// Memory for the impulses of a step.
#[derive(Clone, Debug, Default)]
pub(super) struct LawsMemory {
    /// The rates without impulses, and with them.
    b: Vec<f64>,
    rates: Vec<f64>,
    near: Vec<[f64; 2]>,
    none: Vec<f64>,
    may_stop: Vec<bool>,
    unknowns: Vec<ContactUnknowns>,
    answer: Answer,
    undetermined: undetermined::Memory,
}

impl ContactsOfStep<'_> {
    /// Writes the impulses by the laws of the machine.
    ///
    /// # Errors
    /// Where none obey the law.
    pub fn write_impulses(
        &self,
        impulses: &mut ImpulsesOfStep,
        memory: &mut LawsMemory,
    ) -> Result<(), StepError> {
        let at_once = self.touching.order == ImpactOrder::AtOnce;
        let in_one_problem = at_once && self.touching.law == ImpactLaw::Newton;
        if !in_one_problem && self.meets() {
            *impulses = self.in_halves(memory)?;
            return Ok(());
        }
        let rests = &mut impulses.rests;
        let mut has_impulses = self.whole(in_one_problem, rests, memory);
        let is_jammed = !has_impulses && in_one_problem;
        if is_jammed {
            has_impulses = self.whole(false, rests, memory);
        }
        if !has_impulses {
            return Err(self.unsettled());
        }
        let answer = &memory.answer;
        impulses.all.clone_from(&answer.forces);
        impulses.last.clone_from(&answer.forces);
        (impulses.shared_otherwise).clone_from(&answer.shared_otherwise);
        impulses.jammed.clear();
        if is_jammed {
            impulses.jammed.extend(0..self.meeting.contacts.len());
        }
        Ok(())
    }

    fn unsettled(&self) -> StepError {
        StepError::Contact {
            contact: self.meeting.contacts[0],
            trouble: ContactTrouble::Unsettled,
            t: self.t,
        }
    }

    fn width(&self) -> usize {
        self.meeting.directions.len()
    }

    fn was_closed(&self, place: usize) -> bool {
        self.touching.modes()[self.meeting.contacts[place]] != Mode::Open
    }

    /// Whether a contact is that whose gap another one has too.
    fn is_own(&self, place: usize) -> bool {
        self.touching
            .carrier(self.meeting.contacts[place])
            .is_none()
    }

    /// The place of the contact whose normal impulse one leans on.
    fn carrier(&self, place: usize) -> usize {
        place - usize::from(!self.is_own(place))
    }

    /// Whether something that was open closes.
    fn meets(&self) -> bool {
        (0..self.meeting.contacts.len()).any(|place| {
            let closes = self.meeting.before[2 * place] < -self.rate_rounding(place);
            self.is_own(place) && !self.was_closed(place) && closes
        })
    }

    fn rate_rounding(&self, place: usize) -> f64 {
        let own = self.here.rate_rounding(2 * self.meeting.contacts[place]);
        own.max(ROUNDING * self.touching.greatest_rate())
    }

    /// Writes rates changed by impulses.
    fn write_after(&self, rates: &[f64], impulses: &[[f64; 2]], after: &mut Vec<f64>) {
        let rows = self.meeting.g.chunks_exact(self.width());
        after.clear();
        after.extend((rates.iter().zip(rows)).map(|(rate, row)| {
            let by = row.iter().zip(impulses.as_flattened());
            rate + by.map(|(g, impulse)| g * impulse).sum::<f64>()
        }));
    }

    /// Rates changed by impulses.
    fn after(&self, rates: &[f64], impulses: &[[f64; 2]]) -> Vec<f64> {
        let mut after = Vec::new();
        self.write_after(rates, impulses, &mut after);
        after
    }

    /// The slip of a contact along both of its tangents.
    fn slip(&self, rates: &[f64], place: usize) -> [f64; 2] {
        let is_double = self.touching.second(self.meeting.contacts[place]).is_some();
        let across = if is_double { rates[2 * place + 3] } else { 0.0 };
        [rates[2 * place + 1], across]
    }

    /// Writes which contacts have more static than kinetic friction and rest when the step begins.
    fn write_resting(&self, resting: &mut Vec<bool>) {
        let rests = |place: usize| {
            let k = self.meeting.contacts[place];
            let [kinetic, at_rest] = self.here.friction(k);
            if at_rest <= kinetic || self.touching.first(k) != k {
                return false;
            }
            match self.touching.modes()[k] {
                Mode::Sticks => true,
                // The contact touches and does not move.
                Mode::Open => {
                    let rest = self.rate_rounding(place);
                    let slip = self.slip(&self.meeting.before, place);
                    let still = self.here.rate_rounding(2 * k + 1).max(rest);
                    self.meeting.before[2 * place].abs() <= rest && slip[0].hypot(slip[1]) <= still
                }
                Mode::Slides(_) | Mode::SlidesAlong(_) => false,
            }
        };
        resting.clear();
        resting.extend((0..self.meeting.contacts.len()).map(rests));
    }

    /// Writes the impulses of the whole step in one problem; whether there are any that obey the law.
    fn whole(&self, has_restitution: bool, rests: &mut Vec<bool>, memory: &mut LawsMemory) -> bool {
        let share = f64::from(u8::from(has_restitution));
        let directions = self.meeting.directions.iter();
        let mut b = core::mem::take(&mut memory.b);
        b.clear();
        b.extend((directions.zip(self.free).zip(&self.meeting.before)).map(
            |((d, free), before)| {
                // What opens has not met: with restitution a contact that comes back to its gap would go beyond it by as much, step after step.
                let before = if d % 2 == 0 { before.min(0.0) } else { *before };
                free + share * self.here.restitution(d / 2)[d % 2] * before
            },
        ));
        for (normal, way_back) in b.iter_mut().step_by(2).zip(self.ways_back) {
            *normal += way_back;
        }
        self.write_resting(rests);
        let has_impulses = self.held(&b, (&self.meeting.before, 1.0), rests, |_| true, memory);
        memory.b = b;
        has_impulses
    }

    /// The impulses of a step in which something meets by a law for an instant.
    fn in_halves(&self, memory: &mut LawsMemory) -> Result<ImpulsesOfStep, StepError> {
        let meeting = self.meeting;
        let of_forces: Vec<f64> = (self.free.iter().zip(&meeting.before))
            .map(|(free, before)| 0.5 * (free - before))
            .collect();
        let with_forces = |rates: &[f64]| -> Vec<f64> {
            let pairs = rates.iter().zip(&of_forces);
            pairs.map(|(rate, by)| rate + by).collect()
        };
        let mut rests = Vec::new();
        self.write_resting(&mut rests);
        let was_closed = |place: usize| self.was_closed(self.carrier(place));
        let b = with_forces(&meeting.before);
        if !self.held(&b, (&meeting.before, 0.5), &mut rests, was_closed, memory) {
            return Err(self.unsettled());
        }
        let first = memory.answer.clone();
        let rates = self.after(&b, &first.forces);

        let mut told = Told::default();
        let of_impact = self.impact(&rates, &mut told)?;
        let rates = self.after(&rates, &of_impact);

        let mut b = with_forces(&rates);
        for (normal, way_back) in b.iter_mut().step_by(2).zip(self.ways_back) {
            *normal += way_back;
        }
        // A contact that the impact made slip does not rest any more.
        let still = HELD * greatest(&rates);
        for (place, rests) in rests.iter_mut().enumerate() {
            let slip = self.slip(&rates, place);
            *rests &= slip[0].hypot(slip[1]) <= still;
        }
        if !self.held(&b, (&rates, 0.5), &mut rests, |_| true, memory) {
            return Err(self.unsettled());
        }
        let last = memory.answer.clone();

        let parts = (first.forces.iter().zip(&of_impact)).zip(&last.forces);
        let all = parts.map(|((a, b), c)| [a[0] + b[0] + c[0], a[1] + b[1] + c[1]]);
        let place_of = |k: &usize| meeting.contacts.iter().position(|own| own == k);
        let mut shared_otherwise: Vec<usize> =
            told.shared_otherwise.iter().filter_map(place_of).collect();
        shared_otherwise.extend(first.shared_otherwise);
        shared_otherwise.extend(last.shared_otherwise);
        shared_otherwise.sort_unstable();
        shared_otherwise.dedup();
        Ok(ImpulsesOfStep {
            all: all.collect(),
            last: last.forces,
            rests,
            shared_otherwise,
            jammed: told.jammed.iter().filter_map(place_of).collect(),
        })
    }

    /// The impulses of an impact at these rates.
    fn impact(&self, rates: &[f64], told: &mut Told) -> Result<Vec<[f64; 2]>, StepError> {
        let Self {
            touching,
            here,
            meeting,
            t,
            ..
        } = *self;
        let is_single = matches!(touching.law, ImpactLaw::Poisson | ImpactLaw::Stronge);
        if touching.order == ImpactOrder::AtOnce && !is_single {
            let all = (&meeting.contacts[..], &meeting.g[..], rates);
            return Ok(match touching.impulses((t, here), all, told) {
                Ok(impulses) => impulses,
                // They are stopped without restitution, by the second half.
                Err(_) => {
                    told.jammed.extend_from_slice(&meeting.contacts);
                    vec![[0.0; 2]; meeting.contacts.len()]
                }
            });
        }
        let (width, count) = (self.width(), meeting.contacts.len());
        let mut impulses = vec![[0.0; 2]; count];
        let mut rates = rates.to_vec();
        let mut has_failed = vec![false; count];
        for _ in 0..MOST_HITS * count {
            let closes = |place: &usize| {
                let is_own = self.is_own(*place) && !has_failed[*place];
                is_own && rates[2 * place] < -self.rate_rounding(*place)
            };
            let closing = (0..count).filter(closes);
            let fastest = closing.min_by(|a, b| rates[2 * a].total_cmp(&rates[2 * b]));
            let Some(place) = fastest else {
                break;
            };
            // The contacts that lean on it follow it, and are asked with it.
            let end = (place + 1..count).find(|next| self.is_own(*next));
            let own = 2 * place..2 * end.unwrap_or(count);
            let g: Vec<f64> = (own.clone())
                .flat_map(|i| &meeting.g[i * width..][own.clone()])
                .copied()
                .collect();
            let contacts = &meeting.contacts[own.start / 2..own.end / 2];
            let hit = (contacts, &g[..], &rates[own.clone()]);
            let Ok(found) = touching.impulses((t, here), hit, told) else {
                told.jammed.push(meeting.contacts[place]);
                has_failed[place] = true;
                continue;
            };
            for (row, rate) in rates.iter_mut().enumerate() {
                let by = meeting.g[row * width..][own.clone()].iter();
                let by = by.zip(found.as_flattened());
                *rate += by.map(|(g, impulse)| g * impulse).sum::<f64>();
            }
            for (sum, found) in impulses[own.start / 2..].iter_mut().zip(found) {
                (sum[0], sum[1]) = (sum[0] + found[0], sum[1] + found[1]);
            }
        }
        Ok(impulses)
    }

    /// Writes the impulses of the contacts that take part, with the rates `b` without these, over a part of the step; `before` are the rates before the forces that
    /// act in it. `rests` says which contacts may stick with their static friction, and then which do. Whether there are impulses that obey the law.
    fn held(
        &self,
        b: &[f64],
        (before, part): (&[f64], f64),
        rests: &mut [bool],
        takes_part: impl Fn(usize) -> bool,
        memory: &mut LawsMemory,
    ) -> bool {
        let Self {
            touching,
            here,
            meeting,
            h,
            ..
        } = *self;
        let LawsMemory {
            rates,
            near,
            none,
            may_stop,
            unknowns,
            answer,
            undetermined,
            ..
        } = memory;
        let contacts = &meeting.contacts;
        let places = || 0..contacts.len();
        // Most contacts do what they did in the step before.
        near.clear();
        near.extend(contacts.iter().map(|k| match touching.stepped() {
            Some(forces) => forces[*k].map(|force| part * h * force),
            None => [0.0; 2],
        }));
        none.clear();
        none.resize(contacts.len(), 0.0);
        // These contacts slip, have more static friction, and may come to rest within the step.
        may_stop.clear();
        may_stop.extend(places().map(|place| {
            let k = contacts[place];
            let [kinetic, at_rest] = here.friction(k);
            let is_first = touching.first(k) == k;
            is_first && at_rest > kinetic && self.was_closed(place) && !rests[place]
        }));
        let still = HELD * greatest(b);
        loop {
            unknowns.clear();
            unknowns.extend(places().map(|place| {
                let contact = contacts[place];
                if !takes_part(place) {
                    return ContactUnknowns::Nothing;
                }
                let own = touching.unknowns_of_impact(here, (place, contact), none);
                if rests[place] {
                    with_friction(own, here.friction(contact)[1])
                } else {
                    own
                }
            }));
            let of_motion = (&meeting.g[..], b);
            let solved =
                undetermined::solve_for_motion(unknowns, of_motion, near, answer, undetermined);
            if solved.is_err() || answer.residual > MOST_RESIDUAL {
                return false;
            }
            if !rests.contains(&true) && !may_stop.contains(&true) {
                return true;
            }
            self.write_after(b, &answer.forces, rates);
            let mut changes = false;
            for (place, rests) in rests.iter_mut().enumerate().filter(|(_, rests)| **rests) {
                let slip = self.slip(rates, place);
                if slip[0].hypot(slip[1]) > still && self.is_used_up(answer, place) {
                    *rests = false;
                    changes = true;
                }
            }
            if !changes {
                let slipping = may_stop.iter_mut().enumerate();
                for (place, may_stop) in slipping.filter(|(_, may_stop)| **may_stop) {
                    let was = self.slip(before, place);
                    let is = self.slip(rates, place);
                    if was[0] * is[0] + was[1] * is[1] < 0.0 {
                        (rests[place], *may_stop, changes) = (true, false, true);
                    }
                }
            }
            if !changes {
                return true;
            }
        }
    }

    /// Whether the static friction of a contact is used up.
    fn is_used_up(&self, answer: &Answer, place: usize) -> bool {
        let k = self.meeting.contacts[place];
        let [_, at_rest] = self.here.friction(k);
        let most = at_rest * answer.forces[self.carrier(place)][0];
        let across = match self.touching.second(k) {
            Some(_) => answer.forces[place + 1][1],
            None => 0.0,
        };
        answer.forces[place][1].hypot(across) >= most * (1.0 - SATURATED)
    }
}

/// The same unknowns with another coefficient of friction.
fn with_friction(unknowns: ContactUnknowns, coefficient: f64) -> ContactUnknowns {
    match unknowns {
        ContactUnknowns::Both { known_normal, .. } => ContactUnknowns::Both {
            friction: coefficient,
            known_normal,
        },
        ContactUnknowns::OnCarrier {
            known_normal, on, ..
        } => ContactUnknowns::OnCarrier {
            friction: coefficient,
            known_normal,
            on,
        },
        other => other,
    }
}

fn greatest(rates: &[f64]) -> f64 {
    rates.iter().fold(0.0, |most, rate| most.max(rate.abs()))
}
