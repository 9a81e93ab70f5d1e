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
//! without forces that act meanwhile: with them a compression by the weight of a body at rest would be followed by an expansion. Therefore a step in which a
//! contact closes and bounces is divided at the first such instant, after the part θ of the step:
//!
//! ```text
//! M (v' − v)   = θ h f + W Λ'             for contacts closed in the previous step, without restitution
//! M (v* − v')  = W Λ*                     by the law of impact
//! M (v⁺ − v*)  = (1 − θ) h f + W Λ''      for touching contacts, without restitution
//! q⁺ − q = θ h (v + v')/2 + (1 − θ) h (v* + v⁺)/2
//! ```
//!
//! and any other step is one problem without restitution. In both parts contacts are kept from passing their gaps, `γ⁺ ≥ −2 g/h` with the gap in the middle of the part. The impulses of the parts
//! dissipate energy, so that only the law of impact can add energy besides
//! the work of the forces. A law for one contact at a time, or that of a `sequence`, is applied to one contact after the other, the one that closes fastest first,
//! a limited number of times; a contact that is still closing then is stopped in the rest of the step, without restitution.

use std::vec;
use std::vec::Vec;

use super::super::impact::{Meeting, Told};
use super::super::kinematics::{ContactKinematics, ROUNDING};
use super::super::problem::{Answer, ContactUnknowns, SATURATED};
use super::super::{ContactTrouble, ImpactLaw, ImpactOrder, Mode, UnilateralState, undetermined};
use super::approach::{Approach, Course, Manner, beyond_rounding};
use crate::StepError;

/// How large the residual of impulses may be.
const MOST_RESIDUAL: f64 = 1e-8;

/// Rates up to this, relative to the greatest rate, are those of contacts that are held.
const HELD: f64 = 1e-9;

/// A part of a step that is shorter than this part of it is none.
const LEAST_PART: f64 = 1e-9;

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
    /// The impulses of the reactions of guides to forces alone, over the whole step and each times `G_nn` of its guide, with two numbers for each contact; nothing without guides.
    pub loads: &'a [f64],
    /// The courses of their gaps without impulses; of what depends on another contact, that one's.
    pub courses: &'a [Course],
}

/// Impulses of the contacts that touch in a step.
#[derive(Clone, Debug, Default)]
pub(super) struct ImpulsesOfStep {
    pub all: Vec<[f64; 2]>,
    /// How they move what they push beside changing its rates: the impulses times how much earlier than in the middle of the step they would act at once, in N s².
    pub shifts: Vec<[f64; 2]>,
    /// The rates before and after the impact of each contact, of gap and slip, and what each of both directions took, in J.
    pub rates: Vec<[[f64; 2]; 2]>,
    pub losses: Vec<[f64; 2]>,
    /// How contacts met.
    pub approaches: Vec<Approach>,
    /// What of these acted last, from which follows what contacts do at the end of the step.
    pub last: Vec<[f64; 2]>,
    /// Which contacts are held by their static friction.
    pub rests: Vec<bool>,
    /// The places of contacts that share their impulses in another way than by the rule, and of those whose friction permitted no rates with their restitution.
    pub shared_otherwise: Vec<usize>,
    pub jammed: Vec<usize>,
    /// The places of contacts that touched and gave no impulse because none of all contacts together were found.
    pub left_out: Vec<usize>,
}

/// How impulses obey the laws that the search for those of all contacts did not find.
#[derive(Clone, Copy, Debug, Default)]
struct FoundOtherwise {
    /// Whether they are without restitution.
    is_inelastic: bool,
    /// Whether they are those of contacts alone that are closed in the middle of the step.
    is_of_closed: bool,
}

/// Memory for the impulses of a step.
#[derive(Clone, Debug, Default)]
pub(super) struct LawsMemory {
    /// The rates without impulses, and with them.
    b: Vec<f64>,
    rates: Vec<f64>,
    near: Vec<[f64; 2]>,
    /// The forces with which a search begins, if these are not those of the step before.
    start: Option<Vec<[f64; 2]>>,
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
        self.write_approaches(true, &mut impulses.approaches);
        let in_one_problem = self.touching.steps_in_one_problem();
        if !in_one_problem && self.first_impact(&impulses.approaches).is_some() {
            return self.write_divided(impulses, memory);
        }
        let found = if self.whole(impulses, |_| true, memory) {
            FoundOtherwise::default()
        } else {
            (self.whole_otherwise(impulses, memory)).ok_or_else(|| self.unsettled())?
        };
        let answer = &memory.answer;
        impulses.all.clone_from(&answer.forces);
        impulses.last.clone_from(&answer.forces);
        (impulses.shared_otherwise).clone_from(&answer.shared_otherwise);
        impulses.jammed.clear();
        if found.is_inelastic {
            impulses.jammed.extend(0..self.meeting.contacts.len());
        }
        impulses.left_out.clear();
        if found.is_of_closed {
            let is_left_out = |place: &usize| self.is_own(*place) && !self.is_closed(*place);
            (impulses.left_out).extend((0..self.meeting.contacts.len()).filter(is_left_out));
        }
        self.write_effects_of_whole(impulses, &mut memory.rates);
        Ok(())
    }

    /// Solves for the impulses of the whole step where the search for them has failed; how they were found, if they were. The search begins at those without restitution. If that
    /// fails too, only those contacts press that are closed in the middle of the step, as Moreau has it: feet of a body that stay beside what they touch do so at rates of their gaps, which others
    /// that are beyond theirs do not have, and so no motion of the body.
    fn whole_otherwise(
        &self,
        impulses: &mut ImpulsesOfStep,
        memory: &mut LawsMemory,
    ) -> Option<FoundOtherwise> {
        let is_closed = |place: usize| self.is_closed(place);
        let found = |is_inelastic: bool, is_of_closed: bool| FoundOtherwise {
            is_inelastic,
            is_of_closed,
        };
        self.write_approaches(false, &mut impulses.approaches);
        if self.whole(impulses, |_| true, memory) {
            memory.start = Some(memory.answer.forces.clone());
        }
        self.write_approaches(true, &mut impulses.approaches);
        let has_impulses = memory.start.is_some() && self.whole(impulses, |_| true, memory);
        memory.start = None;
        if has_impulses {
            return Some(found(false, false));
        }
        if self.whole(impulses, is_closed, memory) {
            return Some(found(false, true));
        }
        self.write_approaches(false, &mut impulses.approaches);
        if self.whole(impulses, |_| true, memory) {
            return Some(found(true, false));
        }
        (self.whole(impulses, is_closed, memory)).then_some(found(true, true))
    }

    /// Whether a contact is closed in the middle of the step.
    fn is_closed(&self, place: usize) -> bool {
        self.courses[place].is_closed()
    }

    /// Writes how contacts meet, with their restitution or without.
    fn write_approaches(&self, has_restitution: bool, approaches: &mut Vec<Approach>) {
        approaches.clear();
        approaches.extend(self.courses.iter().map(|course| {
            let restitution = if has_restitution {
                course.restitution
            } else {
                0.0
            };
            Course {
                restitution,
                ..*course
            }
            .approach()
        }));
    }

    /// After which part of the step a contact first bounces, if any does.
    fn first_impact(&self, approaches: &[Approach]) -> Option<f64> {
        let bounces = |approach: &&Approach| {
            matches!(approach.manner, Manner::Bounces | Manner::Returns) && approach.arrival > 0.0
        };
        let parts = approaches.iter().filter(bounces);
        let first = parts.map(|approach| 1.0 - approach.left);
        first.min_by(f64::total_cmp)
    }

    /// Writes what the impulses of the whole step do beside changing rates.
    fn write_effects_of_whole(&self, impulses: &mut ImpulsesOfStep, after: &mut Vec<f64>) {
        let ImpulsesOfStep {
            all,
            shifts,
            rates,
            losses,
            approaches,
            ..
        } = impulses;
        self.write_after(self.free, all, after);
        shifts.clear();
        rates.clear();
        losses.clear();
        for (place, (impulse, approach)) in all.iter().zip(&*approaches).enumerate() {
            let [before, free, after] = [&self.meeting.before[..], self.free, &after[..]]
                .map(|rates| [rates[2 * place], rates[2 * place + 1]]);
            let left = approach.left;
            shifts.push(impulse.map(|impulse| (left - 0.5) * self.h * impulse));
            losses.push([0, 1].map(|part| {
                let of_forces = (1.0 - 2.0 * left) * (free[part] - before[part]);
                -0.5 * impulse[part] * (before[part] + after[part] + of_forces)
            }));
            let of_part = |part: usize| match approach.manner {
                Manner::Bounces => {
                    let of_forces = free[part] - before[part];
                    [
                        before[part] + (1.0 - left) * of_forces,
                        after[part] - left * of_forces,
                    ]
                }
                Manner::Rests | Manner::Returns if part == 0 && !self.was_closed(place) => {
                    [-approach.arrival, after[0]]
                }
                _ => [before[part], after[part]],
            };
            rates.push([of_part(0), of_part(1)]);
        }
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

    /// Whether a contact sticks, and inertia couples it with no other one.
    fn sticks_alone(&self, place: usize) -> bool {
        let mode = self.touching.modes()[self.meeting.contacts[place]];
        mode == Mode::Sticks && !self.courses[place].is_coupled
    }

    /// Whether a contact is that whose gap another one has too.
    fn is_own(&self, place: usize) -> bool {
        self.touching
            .carrier(self.meeting.contacts[place])
            .is_none()
    }

    /// The place of the contact whose normal impulse one depends on.
    fn carrier(&self, place: usize) -> usize {
        place - usize::from(!self.is_own(place))
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
        self.meeting.clear_rates_of_guides(after);
    }

    /// Adds the loads of guides in a part of the step to what rates would be at its end without impulses.
    fn add_loads(&self, part: f64, b: &mut [f64]) {
        for (b, load) in b.iter_mut().zip(self.loads) {
            *b += part * load;
        }
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

    /// Solves for the impulses of the whole step in one problem, of the contacts that take part; whether there are any that obey the law.
    fn whole(
        &self,
        impulses: &mut ImpulsesOfStep,
        takes_part: impl Fn(usize) -> bool,
        memory: &mut LawsMemory,
    ) -> bool {
        let ImpulsesOfStep {
            rests, approaches, ..
        } = impulses;
        let mut b = core::mem::take(&mut memory.b);
        b.clear();
        let before = self.meeting.before.chunks_exact(2);
        let rates = before.zip(self.free.chunks_exact(2));
        for ((place, approach), (before, free)) in approaches.iter().enumerate().zip(rates) {
            let of_tangent = match approach.manner {
                Manner::Bounces => {
                    let [_, restitution] = self.here.restitution(self.meeting.contacts[place]);
                    let slip = before[1] + (1.0 - approach.left) * (free[1] - before[1]);
                    (1.0 + restitution) * slip
                }
                // What sticks where it turns, slips along the row in the middle of the step as much after it as before: with a slip of 0 it would gain energy, or lose some.
                _ if self.sticks_alone(place) => {
                    let bent =
                        0.5 * self.h * self.here.biases[2 * self.meeting.contacts[place] + 1];
                    free[1] + bent.clamp(before[1].min(0.0), before[1].max(0.0))
                }
                _ => free[1],
            };
            b.extend([free[0] - approach.least, of_tangent]);
        }
        self.add_loads(1.0, &mut b);
        self.write_resting(rests);
        let has_impulses = self.held(&b, (&self.meeting.before, 1.0), rests, takes_part, memory);
        memory.b = b;
        has_impulses
    }

    /// Writes the impulses of a step in which something meets by a law for an instant.
    fn write_divided(
        &self,
        impulses: &mut ImpulsesOfStep,
        memory: &mut LawsMemory,
    ) -> Result<(), StepError> {
        let meeting = self.meeting;
        let first_part = self.first_impact(&impulses.approaches).unwrap_or(0.5);
        let parts = [first_part, 1.0 - first_part];
        impulses.jammed.clear();
        impulses.left_out.clear();
        impulses.shared_otherwise.clear();
        let mut rests = core::mem::take(&mut impulses.rests);
        self.write_resting(&mut rests);
        let start: Vec<f64> = (0..meeting.contacts.len())
            .map(|place| {
                let course = &self.courses[place];
                (course.gap - 0.5 * self.h * course.rates[0]).max(0.0)
            })
            .collect();
        let was_closed = |place: usize| self.was_closed(self.carrier(place));
        let of_first = (parts[0], &start[..], &meeting.before[..]);
        let (first, at_impact) =
            self.write_part(of_first, (&mut rests, impulses), was_closed, memory)?;

        let mut told = Told::default();
        let mut of_impact = self.impact(&at_impact, &mut told)?;
        meeting.write_reactions(&[], &mut of_impact);
        let after_impact = self.after(&at_impact, &of_impact);
        // A contact that the impact made slip does not rest any more.
        let still = HELD * greatest(&after_impact);
        for (place, rests) in rests.iter_mut().enumerate() {
            let slip = self.slip(&after_impact, place);
            *rests &= slip[0].hypot(slip[1]) <= still;
        }
        let gaps: Vec<f64> = (start.iter().enumerate())
            .map(|(place, gap)| {
                let mean = 0.5 * (meeting.before[2 * place] + at_impact[2 * place]);
                (gap + parts[0] * self.h * mean).max(0.0)
            })
            .collect();
        let of_last = (parts[1], &gaps[..], &after_impact[..]);
        let (last, at_end) = self.write_part(of_last, (&mut rests, impulses), |_| true, memory)?;

        impulses.rests = rests;
        let place_of = |k: &usize| meeting.contacts.iter().position(|own| own == k);
        (impulses.shared_otherwise).extend(told.shared_otherwise.iter().filter_map(place_of));
        impulses.shared_otherwise.sort_unstable();
        impulses.shared_otherwise.dedup();
        (impulses.jammed).extend(told.jammed.iter().filter_map(place_of));
        self.write_effects_of_parts(
            impulses,
            first_part,
            [&first, &of_impact, &last],
            [&meeting.before, &at_impact, &after_impact, &at_end],
        );
        impulses.last = last;
        Ok(())
    }

    /// The impulses in a part of the step, without restitution, that begins with these gaps and rates, and the rates at its end.
    fn write_part(
        &self,
        (part, gaps, before): (f64, &[f64], &[f64]),
        (rests, impulses): (&mut [bool], &mut ImpulsesOfStep),
        takes_part: impl Fn(usize) -> bool,
        memory: &mut LawsMemory,
    ) -> Result<(Vec<[f64; 2]>, Vec<f64>), StepError> {
        if part < LEAST_PART {
            return Ok((vec![[0.0; 2]; gaps.len()], before.to_vec()));
        }
        let length = part * self.h;
        let forces = self.free.iter().zip(&self.meeting.before);
        let free: Vec<f64> = (before.iter().zip(forces))
            .map(|(before, (free, start))| before + part * (free - start))
            .collect();
        let mut b = free.clone();
        for (place, gap) in gaps.iter().enumerate() {
            let in_middle = gap + 0.5 * length * before[2 * place];
            let in_middle = beyond_rounding(in_middle, self.courses[place].rounding);
            b[2 * place] += 2.0 / length * in_middle.max(0.0);
        }
        self.add_loads(part, &mut b);
        if !self.held(&b, (before, part), rests, takes_part, memory) {
            return Err(self.unsettled());
        }
        let found = memory.answer.forces.clone();
        (impulses.shared_otherwise).extend_from_slice(&memory.answer.shared_otherwise);
        let after = self.after(&free, &found);
        Ok((found, after))
    }

    /// Writes what the impulses of a divided step do, with the rates between them.
    fn write_effects_of_parts(
        &self,
        effects: &mut ImpulsesOfStep,
        first_part: f64,
        impulses: [&[[f64; 2]]; 3],
        rates: [&[f64]; 4],
    ) {
        let earlier = [0.5 - 0.5 * first_part, 0.5 - first_part, -0.5 * first_part];
        effects.all.clear();
        effects.shifts.clear();
        effects.losses.clear();
        effects.rates.clear();
        for place in 0..self.meeting.contacts.len() {
            let (mut all, mut shift, mut loss) = ([0.0; 2], [0.0; 2], [0.0; 2]);
            for (stage, earlier) in earlier.into_iter().enumerate() {
                for part in 0..2 {
                    let impulse = impulses[stage][place][part];
                    let sum = rates[stage][2 * place + part] + rates[stage + 1][2 * place + part];
                    all[part] += impulse;
                    shift[part] += earlier * self.h * impulse;
                    loss[part] -= 0.5 * impulse * sum;
                }
            }
            effects.all.push(all);
            effects.shifts.push(shift);
            effects.losses.push(loss);
            let [before, after] = if impulses[1][place] == [0.0; 2] {
                [rates[0], rates[3]]
            } else {
                [rates[1], rates[2]]
            };
            effects
                .rates
                .push([0, 1].map(|part| [before[2 * place + part], after[2 * place + part]]));
        }
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
            // The contacts that depend on it follow it, and are asked with it, and so are guides, which take part in whatever loads them.
            let end = (place + 1..count).find(|next| self.is_own(*next));
            let own = place..end.unwrap_or(count);
            let is_asked =
                |other: &usize| own.contains(other) || touching.is_guide(meeting.contacts[*other]);
            let asked: Vec<usize> = (0..count).filter(is_asked).collect();
            let directions = || asked.iter().flat_map(|place| [2 * place, 2 * place + 1]);
            let contacts: Vec<usize> = asked.iter().map(|place| meeting.contacts[*place]).collect();
            let g: Vec<f64> = directions()
                .flat_map(|i| directions().map(move |j| meeting.g[i * width + j]))
                .collect();
            let before: Vec<f64> = directions().map(|direction| rates[direction]).collect();
            let hit = (&contacts[..], &g[..], &before[..]);
            let Ok(found) = touching.impulses((t, here), hit, told) else {
                told.jammed.push(meeting.contacts[place]);
                has_failed[place] = true;
                continue;
            };
            for (row, rate) in rates.iter_mut().enumerate() {
                let by = directions().map(|column| meeting.g[row * width + column]);
                let by = by.zip(found.as_flattened());
                *rate += by.map(|(g, impulse)| g * impulse).sum::<f64>();
            }
            meeting.clear_rates_of_guides(&mut rates);
            for (place, found) in asked.iter().zip(found) {
                let sum = &mut impulses[*place];
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
            meeting,
            h,
            ..
        } = *self;
        let LawsMemory {
            rates,
            near,
            start,
            none,
            may_stop,
            unknowns,
            answer,
            undetermined,
            ..
        } = memory;
        near.clear();
        // Most contacts do what they did in the step before.
        near.extend(meeting.contacts.iter().map(|k| match touching.stepped() {
            Some(forces) => forces[*k].map(|force| part * h * force),
            None => [0.0; 2],
        }));
        if let Some(start) = start {
            near.clone_from(start);
        }
        none.clear();
        none.resize(rests.len(), 0.0);
        may_stop.clear();
        may_stop.extend((0..rests.len()).map(|place| self.may_stop(place, rests[place])));
        let still = HELD * greatest(b);
        loop {
            self.write_unknowns((rests, none), &takes_part, unknowns);
            let of_motion = (&meeting.g[..], b);
            let solved =
                undetermined::solve_for_motion(unknowns, of_motion, near, answer, undetermined);
            if solved.is_err() || answer.residual > MOST_RESIDUAL {
                return false;
            }
            meeting.write_reactions(b, &mut answer.forces);
            if !rests.contains(&true) && !may_stop.contains(&true) {
                return true;
            }
            self.write_after(b, &answer.forces, rates);
            let changes = self.lets_slip((rates, answer), still, rests)
                || self.lets_stop((before, rates), may_stop, rests);
            if !changes {
                return true;
            }
        }
    }

    /// Whether a contact slips, has more static friction, and may come to rest within the step.
    fn may_stop(&self, place: usize, rests: bool) -> bool {
        let k = self.meeting.contacts[place];
        let [kinetic, at_rest] = self.here.friction(k);
        let is_first = self.touching.first(k) == k;
        is_first && at_rest > kinetic && self.was_closed(place) && !rests
    }

    /// Writes what is asked of contacts, of which some may stick with their static friction.
    fn write_unknowns(
        &self,
        (rests, none): (&[bool], &[f64]),
        takes_part: impl Fn(usize) -> bool,
        unknowns: &mut Vec<ContactUnknowns>,
    ) {
        unknowns.clear();
        unknowns.extend(rests.iter().enumerate().map(|(place, rests)| {
            let contact = self.meeting.contacts[place];
            if !takes_part(place) {
                return ContactUnknowns::Nothing;
            }
            let own = self
                .touching
                .unknowns_of_impact(self.here, (place, contact), none);
            if *rests {
                with_friction(own, self.here.friction(contact)[1])
            } else {
                own
            }
        }));
    }

    /// Lets contacts slip whose static friction is used up; whether there are any.
    fn lets_slip(
        &self,
        (rates, answer): (&[f64], &Answer),
        still: f64,
        rests: &mut [bool],
    ) -> bool {
        let mut changes = false;
        for (place, rests) in rests.iter_mut().enumerate().filter(|(_, rests)| **rests) {
            let slip = self.slip(rates, place);
            if slip[0].hypot(slip[1]) > still && self.is_used_up(answer, place) {
                *rests = false;
                changes = true;
            }
        }
        changes
    }

    /// Lets contacts stick whose slip reverses, each once; whether there are any.
    fn lets_stop(
        &self,
        (before, after): (&[f64], &[f64]),
        may_stop: &mut [bool],
        rests: &mut [bool],
    ) -> bool {
        let mut changes = false;
        let slipping = may_stop.iter_mut().enumerate();
        for (place, may_stop) in slipping.filter(|(_, may_stop)| **may_stop) {
            let [was, is] = [before, after].map(|rates| self.slip(rates, place));
            if was[0] * is[0] + was[1] * is[1] < 0.0 {
                (rests[place], *may_stop, changes) = (true, false, true);
            }
        }
        changes
    }

    /// Whether the static friction of a contact is used up.
    fn is_used_up(&self, answer: &Answer, place: usize) -> bool {
        let k = self.meeting.contacts[place];
        let [_, at_rest] = self.here.friction(k);
        let normal = answer.forces[self.carrier(place)][0];
        let most = at_rest * self.touching.pressing(k, normal);
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
        ContactUnknowns::Guide { .. } => ContactUnknowns::Guide {
            friction: coefficient,
        },
        other => other,
    }
}

fn greatest(rates: &[f64]) -> f64 {
    rates.iter().fold(0.0, |most, rate| most.max(rate.abs()))
}
