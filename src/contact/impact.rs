//! Impacts: the rates after them.

mod bounces;
mod meeting;
mod paradox;
mod slips;

pub(crate) use bounces::Bounce;
pub(super) use meeting::Meeting;
pub(crate) use paradox::ParadoxResolution;

use std::vec;
use std::vec::Vec;

use super::kinematics::ContactKinematics;
use super::problem::{Answer, ContactUnknowns};
use super::routh::{self, Expansion, GuidedImpact, SingleImpact};
use super::touching::UnilateralState;
use super::undetermined;
use super::{ContactTrouble, ImpactLaw, ImpactOrder, Mode};
use crate::{StepError, System, Vector};

/// Contacts that share less than this of their inertia do not meet in one impact.
const COUPLED: f64 = 1e-12;

/// A gap is known up to so many of its roundings: less than a bounce that goes on.
const KNOWN_HEIGHT: f64 = 16.0;

/// Whether impulses of the other one of two contacts change a rate or a reaction of the first, with the products of their images.
pub(super) fn acts_on((g, width): (&[f64], usize), [one, other]: [usize; 2]) -> bool {
    let pairs = [0, 1].map(|i| {
        [0, 1].map(|j| {
            let (i, j) = (2 * one + i, 2 * other + j);
            let own = (g[i * width + i] * g[j * width + j]).sqrt();
            g[i * width + j].abs() > COUPLED * own
        })
    });
    pairs.as_flattened().contains(&true)
}

/// What an impact did to a contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Impact {
    pub contact: usize,
    /// Rates of gap and slip, before and after.
    pub gap_rate: [f64; 2],
    pub slip: [f64; 2],
    /// Along normal and tangent, in N s.
    pub impulse: [f64; 2],
    /// In J.
    pub loss: f64,
    /// What prescribed motion did in it, in J.
    pub work: f64,
}

impl Impact {
    /// What of the loss friction takes, in J. In time stepping it is that of a contact that lasts.
    pub fn friction_loss(&self) -> f64 {
        -0.5 * self.impulse[1] * (self.slip[0] + self.slip[1])
    }
}

/// What is told of the contacts that change at an instant, besides their states.
#[derive(Clone, Debug, Default)]
pub(crate) struct Told {
    /// Contacts that share their load in another way than by the rule for undetermined forces, (E79), although the motion depends on it.
    pub shared_otherwise: Vec<usize>,
    /// Contacts whose friction permitted no rates with their restitution, or no motion with their slips: they met without restitution.
    pub jammed: Vec<usize>,
}

impl UnilateralState {
    /// Which contacts touch, and which of these close.
    ///
    /// What is held is at rest, whatever rounding makes of its rate, as long as the rates are `as_held`: no impact has
    /// changed them at this instant. What has `touched` at this instant before an impact still does after it: the gap is as it was, but without the rate
    /// at which it closed its rounding would be less, down to nothing for a gap that is a coordinate.
    pub fn near<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        as_held: bool,
        touched: &[bool],
    ) -> (Vec<bool>, Vec<bool>) {
        let here = self.kinematics(system, (t, q, v));
        let touches: Vec<bool> = (0..here.gaps.len())
            .map(|k| {
                let has_touched = touched.get(k).copied().unwrap_or(false);
                let touches = has_touched || self.modes()[k] != Mode::Open || here.is_gap_closed(k);
                touches && here.is_within(k, q.as_slice())
            })
            .collect();
        let rest = self.rest(&here, self.speed, |k| touches[k]);
        let closes = touches
            .iter()
            .enumerate()
            .map(|(k, touches)| {
                let may = *touches
                    && !self.is_compliant(k)
                    && self.carrier(k).is_none()
                    && !(as_held && self.modes()[k] != Mode::Open);
                may && here.rates[2 * k] < -here.rate_rounding(2 * k).max(rest)
            })
            .collect();
        (touches, closes)
    }

    /// Whether the gap of an open contact is closed and at rest, up to rounding: whether it opens there is for forces to say.
    pub fn rests_at_gap<S: System>(
        &self,
        system: &S,
        place: (f64, &S::Vector, &S::Vector),
        contact: usize,
    ) -> bool {
        let here = self.kinematics(system, place);
        let touches = |k: usize| k == contact || self.modes()[k] != Mode::Open;
        let rest = self.rest(&here, self.speed, touches);
        let rate = here.rates[2 * contact].abs();
        here.is_gap_closed(contact) && rate <= here.rate_rounding(2 * contact).max(rest)
    }

    /// The gap that is negative by more than rounding, if there is one, and by how much.
    pub fn penetrated<S: System>(
        &self,
        system: &S,
        t: f64,
        q: &S::Vector,
        v: &S::Vector,
    ) -> Option<usize> {
        let here = self.kinematics(system, (t, q, v));
        // What yields may be pressed at the start, but for a layer: what it went through is not known.
        let is_free =
            |k: usize| self.carrier(k).is_some() || self.is_compliant(k) && !self.is_layer(k);
        let is_deep = |k: usize| here.gaps[k] < 0.0 && here.gaps[k] < -here.gap_rounding(k);
        (0..here.gaps.len()).find(|&k| !is_free(k) && is_deep(k))
    }

    /// Within which the sign of a gap is round-off.
    pub fn gap_rounding<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        contact: usize,
    ) -> f64 {
        KNOWN_HEIGHT * self.kinematics(system, (t, q, v)).gap_roundoff(contact)
    }

    /// Which of the contacts that touch take part in the next impact: all, or the one that closes fastest.
    pub fn next<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        touches: &[bool],
    ) -> Vec<bool> {
        if self.order == ImpactOrder::AtOnce {
            return touches.to_vec();
        }
        let here = self.kinematics(system, (t, q, v));
        let rate = |k: &usize| here.rates[2 * k];
        let may = |k: &usize| touches[*k] && !self.is_compliant(*k) && self.carrier(*k).is_none();
        let may = |k: &usize| may(k) && !self.is_guide(*k);
        let closing = self.in_order().filter(may);
        let fastest = closing.min_by(|a, b| rate(a).total_cmp(&rate(b)));
        // A guide takes part in whatever loads it.
        let mut next: Vec<bool> = (0..touches.len())
            .map(|k| Some(k) == fastest || self.is_guide(k))
            .collect();
        self.copy_from_carriers(&mut next);
        next
    }

    /// Changes the rates by an impact of the contacts that touch.
    pub fn impact<S: System>(
        &mut self,
        system: &S,
        t: f64,
        q: &S::Vector,
        v: &mut S::Vector,
        (touches, as_held): (&[bool], bool),
        told: &mut Told,
    ) -> Result<Vec<Impact>, StepError> {
        let here = self.kinematics(system, (t, q, v));
        // Contacts that open already take no part, nor do those that yield, whose force is finite.
        let colliding: Vec<usize> = self
            .in_order()
            .filter(|&k| touches[k] && !self.is_compliant(self.carrier(k).unwrap_or(k)))
            .filter(|&k| {
                let is_held = as_held && self.modes()[k] != Mode::Open;
                is_held || here.rates[2 * k] <= here.rate_rounding(2 * k)
            })
            .collect();
        let meeting = Meeting::new(system, (t, q), &here, colliding)?;
        let asked = (&meeting.contacts[..], &meeting.g[..], &meeting.before[..]);
        let impulses = self.impulses((t, &here), asked, told)?;
        let (impacts, change) = meeting.impacts(system, (t, q, v), &here, &impulses);
        for impact in &impacts {
            self.speed = self.speed.max(-impact.gap_rate[0]);
        }
        for (v, by) in v.as_mut_slice().iter_mut().zip(change) {
            *v += by;
        }
        Ok(impacts)
    }

    /// What is asked of a contact that has this place among those that meet.
    pub(super) fn unknowns_of_impact(
        &self,
        here: &ContactKinematics,
        (place, contact): (usize, usize),
        known_normal: &[f64],
    ) -> ContactUnknowns {
        let friction = here.friction(contact)[0];
        match self.carrier(contact) {
            Some(_) if self.first(contact) != contact => ContactUnknowns::SecondTangent,
            None if self.is_guide(contact) => ContactUnknowns::Guide { friction },
            None => ContactUnknowns::Both {
                friction,
                known_normal: known_normal[place],
            },
            // The contact on which it depends comes before it.
            Some(_) => ContactUnknowns::OnCarrier {
                friction,
                known_normal: known_normal[place - 1],
                on: place - 1,
            },
        }
    }

    /// The impulses of contacts that meet, with the products of the images of their directions and the rates along these before.
    pub(super) fn impulses(
        &self,
        (t, here): (f64, &ContactKinematics),
        (colliding, g, before): (&[usize], &[f64], &[f64]),
        told: &mut Told,
    ) -> Result<Vec<[f64; 2]>, StepError> {
        let unsolved = || self.unsolved(colliding, t);
        let width = before.len();
        let mut solved = |known_normal: &[f64], b: &[f64]| -> Result<Answer, StepError> {
            let unknowns: Vec<ContactUnknowns> = (colliding.iter().enumerate())
                .map(|(place, &k)| self.unknowns_of_impact(here, (place, k), known_normal))
                .collect();
            let answer = undetermined::solve(&unknowns, g, b).map_err(|_| unsolved())?;
            if answer.residual > 1e-8 {
                return Err(unsolved());
            }
            let places = answer.shared_otherwise.iter();
            (told.shared_otherwise).extend(places.map(|place| colliding[*place]));
            Ok(answer)
        };
        let after = |b: &[f64], impulses: &[[f64; 2]]| -> Vec<f64> {
            let row = |(i, b): (usize, &f64)| {
                let terms = g[i * width..][..width].iter();
                let terms = terms.zip(impulses.iter().flatten());
                b + terms.map(|(g, impulse)| g * impulse).sum::<f64>()
            };
            b.iter().enumerate().map(row).collect()
        };
        let none = vec![0.0; colliding.len()];
        match self.law {
            ImpactLaw::Newton => {
                let mut b = before.to_vec();
                for (b, &k) in b.chunks_exact_mut(2).zip(colliding) {
                    let [normal, tangential] = here.restitution(k);
                    b[0] *= 1.0 + normal;
                    b[1] *= 1.0 + tangential;
                }
                if let Ok(answer) = solved(&none, &b) {
                    return Ok(answer.forces);
                }
                // Where bodies are wedged in, friction may permit no rates with restitution. Impacts of one contact at a time, of which there is an endless
                // sequence, would take all the rates at which the gaps close.
                let plastic = solved(&none, before)?.forces;
                told.jammed.extend_from_slice(colliding);
                Ok(plastic)
            }
            ImpactLaw::PoissonGlocker => {
                let compression = solved(&none, before)?.forces;
                let mut middle = after(before, &compression);
                for (middle, &k) in middle.chunks_exact_mut(2).zip(colliding) {
                    if self.is_guide(k) {
                        // The reaction of the expansion is that of its own impulses.
                        middle[0] = 0.0;
                    }
                }
                // The expansion gives at least this, and the solution is what it adds to that.
                let given: Vec<[f64; 2]> = (colliding.iter().zip(&compression))
                    .map(|(&k, impulse)| [here.restitution(k)[0] * impulse[0], 0.0])
                    .collect();
                // Nothing is given along the normal of a contact that depends on another one: it has no impulse there.
                let known_normal: Vec<f64> = given.iter().map(|given| given[0]).collect();
                let Ok(expansion) = solved(&known_normal, &after(&middle, &given)) else {
                    told.jammed.extend_from_slice(colliding);
                    return Ok(compression);
                };
                let expansion = expansion.forces;
                let sum = |((c, g), e): ((&[f64; 2], &[f64; 2]), &[f64; 2])| {
                    [c[0] + g[0] + e[0], c[1] + g[1] + e[1]]
                };
                Ok((compression.iter().zip(&given))
                    .zip(&expansion)
                    .map(sum)
                    .collect())
            }
            ImpactLaw::Poisson | ImpactLaw::Stronge => {
                self.single_impulses((t, here), (colliding, g, before))
            }
        }
    }

    /// The impulses of contacts that meet by themselves, along Routh's path.
    fn single_impulses(
        &self,
        (t, here): (f64, &ContactKinematics),
        (colliding, g, before): (&[usize], &[f64], &[f64]),
    ) -> Result<Vec<[f64; 2]>, StepError> {
        let trouble = |place: usize, trouble| StepError::Contact {
            contact: colliding[place],
            trouble,
            t,
        };
        let width = before.len();
        let expansion = match self.law {
            ImpactLaw::Poisson => Expansion::Impulse,
            _ => Expansion::Work,
        };
        let mut impulses = vec![[0.0; 2]; colliding.len()];
        let mut guided = Vec::new();
        for (place, impulse) in impulses.iter_mut().enumerate() {
            let k = colliding[place];
            let entry = |i: usize, j: usize| g[(2 * place + i) * width + 2 * place + j];
            let is_coupled = |other: usize| other != place && acts_on((g, width), [place, other]);
            if before[2 * place] >= -here.rate_rounding(2 * k) {
                continue;
            }
            if self.has_guides() {
                guided.push(place);
                continue;
            }
            if (0..colliding.len()).any(is_coupled) {
                return Err(trouble(place, ContactTrouble::SeveralAtOnce));
            }
            let single_impact = SingleImpact {
                inverse_masses: [entry(0, 0), entry(0, 1), entry(1, 1)],
                rates: [before[2 * place], before[2 * place + 1]],
                restitution: here.restitution(k)[0],
                friction: here.friction(k),
            };
            *impulse = routh::impulse(single_impact, expansion)
                .ok_or_else(|| trouble(place, ContactTrouble::Paradox))?;
        }
        for place in guided {
            let places = self.guides_loaded((here, place), (colliding, g), |trouble_at| {
                trouble(trouble_at, ContactTrouble::SeveralAtOnce)
            })?;
            let directions = || places.iter().flat_map(|place| [2 * place, 2 * place + 1]);
            let g: Vec<f64> = directions()
                .flat_map(|i| directions().map(move |j| g[i * width + j]))
                .collect();
            let k = colliding[place];
            let guided_impact = GuidedImpact {
                g: &g,
                rates: directions().map(|direction| before[direction]).collect(),
                restitution: here.restitution(k)[0],
                friction: (places.iter())
                    .map(|place| here.friction(colliding[*place]))
                    .collect(),
            };
            let found = guided_impact
                .impulses(expansion)
                .map_err(|at| trouble(places[at], ContactTrouble::Paradox))?;
            for (place, found) in places.iter().zip(found) {
                impulses[*place] = found;
            }
        }
        Ok(impulses)
    }

    /// The place of a contact that meets, and those of the guides with friction that its impact loads, directly or by others.
    ///
    /// # Errors
    /// What `several` says where another contact that touches is among what it acts on.
    fn guides_loaded(
        &self,
        (here, place): (&ContactKinematics, usize),
        (colliding, g): (&[usize], &[f64]),
        several: impl Fn(usize) -> StepError,
    ) -> Result<Vec<usize>, StepError> {
        let width = 2 * colliding.len();
        let mut places = vec![place];
        let mut known = 0;
        while known < places.len() {
            let from = places[known];
            known += 1;
            for (other, k) in colliding.iter().enumerate() {
                let is_coupled =
                    acts_on((g, width), [from, other]) || acts_on((g, width), [other, from]);
                if !is_coupled || places.contains(&other) {
                    continue;
                }
                if !self.is_guide(*k) {
                    return Err(several(place));
                }
                if here.friction(*k) != [0.0; 2] {
                    places.push(other);
                }
            }
        }
        Ok(places)
    }

    /// Which contacts neither open nor close; of those that yield, which are pressed.
    pub fn persisting<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        touches: &[bool],
        as_held: bool,
    ) -> Vec<bool> {
        let here = self.kinematics(system, (t, q, v));
        let rest = self.rest(&here, self.speed, |k| touches[k]);
        let mut persisting: Vec<bool> = (touches.iter().enumerate())
            .map(|(k, touches)| {
                if self.is_compliant(k) {
                    let deep = -self.clearance(&here, k).value > here.gap_rounding(k);
                    return self.modes()[k] != Mode::Open || deep;
                }
                if !here.is_within(k, q.as_slice()) {
                    return false;
                }
                if as_held && self.modes()[k] != Mode::Open {
                    return true;
                }
                *touches && here.rates[2 * k].abs() <= here.rate_rounding(2 * k).max(rest)
            })
            .collect();
        self.copy_from_carriers(&mut persisting);
        persisting
    }
}
