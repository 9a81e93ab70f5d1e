//! Impacts: the rates after them.

use std::vec;
use std::vec::Vec;

use super::delassus::{Inertia, matrix, write_matrix};
use super::drives::{ActingContact, Drives, DrivesMemory};
use super::guides::Guides;
use super::kinematics::{ContactKinematics, ROUNDING};
use super::problem::{Answer, ContactUnknowns};
use super::routh::{self, Expansion, SingleImpact};
use super::touching::UnilateralState;
use super::undetermined;
use super::{ContactTrouble, ImpactLaw, ImpactOrder, Mode, Painleve};
use crate::at::At;
use crate::{Singular, StepError, System, Vector};

/// Inverse masses below this, relative to the terms that they are the sum of, are rounding.
const ROUNDING_OF_MASSES: f64 = 1e-11;

/// Contacts that share less than this of their inertia do not meet in one impact.
const COUPLED: f64 = 1e-12;

/// Contacts that bounce ever lower are closed where they open at less than this of the greatest rate at which any
/// closed so far.
const LEAST_BOUNCE: f64 = 1e-9;

/// A bounce is no higher than so many roundings of its gap.
const LEAST_HEIGHT: f64 = 64.0;

/// A gap is known up to so many of its roundings: less than a bounce that goes on.
const KNOWN_HEIGHT: f64 = 16.0;

/// A slip in space that is no more than so many of its roundings has stopped.
const STOPPED: f64 = 10.0;

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

/// How a contact bounces after an impact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounce {
    /// How fast it opens, and how fast it did after its impact before that, in m/s; 0 if there was none.
    pub opening: f64,
    before: f64,
    /// The round-off of its gap, in m.
    roundoff: f64,
    restitution: f64,
}

/// A way out of Painlevé's paradox.
pub(crate) enum ParadoxResolution {
    /// The contact opens.
    Opens(usize),
    /// An impact without a collision, and how it changes the rates.
    Impact { impact: Impact, change: Vec<f64> },
}

/// What is told of the contacts that change at an instant, besides their states.
#[derive(Clone, Debug, Default)]
pub(crate) struct Told {
    /// Contacts that share their load in another way than by the rule for undetermined forces, (E79), although the motion depends on it.
    pub shared_otherwise: Vec<usize>,
    /// Contacts whose friction permitted no rates with their restitution, or no motion with their slips: they met without restitution.
    pub jammed: Vec<usize>,
}

/// Contacts that meet, and what inertia makes of their impulses.
#[derive(Clone, Debug, Default)]
pub(super) struct Meeting {
    /// Which contacts, and their directions: two each.
    pub contacts: Vec<usize>,
    pub directions: Vec<usize>,
    pub inertia: Inertia,
    /// The images of these, and perhaps others that were needed before.
    pub images: Vec<Vec<f64>>,
    pub guides: Guides,
    /// The products of the images, row after row.
    pub g: Vec<f64>,
    /// The rates along the directions before they meet.
    pub before: Vec<f64>,
}

impl Meeting {
    pub fn new<S: System>(
        system: &S,
        (t, q): (f64, &S::Vector),
        here: &ContactKinematics,
        contacts: Vec<usize>,
    ) -> Result<Self, StepError> {
        let mut meeting = Self {
            contacts,
            ..Self::default()
        };
        let n = q.as_slice().len();
        let memory = (&mut S::Matrix::zeros(n * n), &mut Vec::new());
        meeting.evaluate(system, (t, q), here, memory)?;
        Ok(meeting)
    }

    /// Evaluates all of it for its contacts, which are known. `matrix` and `entries` are memory.
    pub fn evaluate<S: System>(
        &mut self,
        system: &S,
        (t, q): (f64, &S::Vector),
        here: &ContactKinematics,
        (matrix, entries): (&mut S::Matrix, &mut Vec<usize>),
    ) -> Result<(), StepError> {
        let Self {
            contacts,
            directions,
            inertia,
            images,
            guides,
            g,
            before,
        } = self;
        let singular = |singular: Singular| StepError::Singular { singular, t };
        inertia.evaluate(system, (t, q), matrix).map_err(singular)?;
        directions.clear();
        directions.extend(contacts.iter().flat_map(|k| [2 * k, 2 * k + 1]));
        if images.len() < directions.len() {
            images.resize_with(directions.len(), Vec::new);
        }
        for (direction, image) in directions.iter().zip(&mut *images) {
            inertia.write_image(here.row(*direction), image);
        }
        write_matrix(&images[..directions.len()], g, entries);
        (guides.evaluate(system, (t, q), |direction| here.row(direction))).map_err(singular)?;
        guides.complete(inertia, contacts, images, g);
        before.clear();
        before.extend(directions.iter().map(|d| here.rates[*d]));
        Ok(())
    }

    /// By how much impulses change the rate of a direction. A guide has none along its normal.
    pub fn change(&self, row: usize, impulses: &[[f64; 2]]) -> f64 {
        if row.is_multiple_of(2) && self.guides.has(self.contacts[row / 2]) {
            return 0.0;
        }
        let width = self.directions.len();
        let own = self.g[row * width..][..width].iter();
        let terms = own.zip(impulses.iter().flatten());
        terms.map(|(g, impulse)| g * impulse).sum()
    }

    /// These impulses, with the reactions of guides in place of what presses on their far sides.
    fn with_reactions(&self, impulses: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let mut all = impulses.to_vec();
        let width = self.directions.len();
        for (place, &k) in self.contacts.iter().enumerate() {
            if self.guides.has(k) {
                let row = &self.g[2 * place * width..][..width];
                let unit = row[2 * place];
                let terms = row.iter().zip(impulses.as_flattened()).enumerate();
                let others = terms.filter(|(column, _)| *column != 2 * place);
                all[place][0] = others.map(|(_, (g, impulse))| g * impulse).sum::<f64>() / unit;
            }
        }
        all
    }

    /// The impacts that these impulses are, and by how much they change the rates of coordinates.
    pub fn impacts<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        here: &ContactKinematics,
        impulses: &[[f64; 2]],
    ) -> (Vec<Impact>, Vec<f64>) {
        let with_reactions = if self.guides.are_there() {
            self.with_reactions(impulses)
        } else {
            Vec::new()
        };
        let impulses = if with_reactions.is_empty() {
            impulses
        } else {
            &with_reactions[..]
        };
        let change = (self.inertia).response(&self.images, impulses.iter().flatten().copied());
        let mean = between(v, &change);
        let mut memory = DrivesMemory::new(q);
        let mut drives = Drives::new(system, (t, q), &mut memory);
        let mut impacts = Vec::with_capacity(self.contacts.len());
        for (place, (&k, &impulse)) in self.contacts.iter().zip(impulses).enumerate() {
            let [gap_rate, slip] = [0, 1].map(|part| {
                let row = 2 * place + part;
                let before = self.before[row];
                [before, before + self.change(row, impulses)]
            });
            let loss = -0.5
                * (impulse[0] * (gap_rate[0] + gap_rate[1]) + impulse[1] * (slip[0] + slip[1]));
            let acting = ActingContact {
                contact: k,
                forces: impulse,
                rates: [gap_rate, slip].map(|[before, after]| 0.5 * (before + after)),
            };
            let response = || (self.inertia).response(&self.images[2 * place..][..2], impulse);
            impacts.push(Impact {
                contact: k,
                gap_rate,
                slip,
                impulse,
                loss,
                work: drives.work(here, &acting, &mean, response),
            });
        }
        impacts.sort_by_key(|impact| impact.contact);
        (impacts, change)
    }
}

/// The mean of rates before a change and after it.
fn between<V: Vector>(v: &V, change: &[f64]) -> V {
    let mut mean = v.clone();
    for (v, by) in mean.as_mut_slice().iter_mut().zip(change) {
        *v += 0.5 * by;
    }
    mean
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
            // The contact that it leans on comes before it.
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
                // Nothing is given along the normal of a contact that leans on another one: it has no impulse there.
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
        for (place, impulse) in impulses.iter_mut().enumerate() {
            let k = colliding[place];
            let entry = |i: usize, j: usize| g[(2 * place + i) * width + 2 * place + j];
            let is_coupled = |other: usize| {
                let pairs = [0, 1].map(|i| {
                    [0, 1].map(|j| {
                        let (i, j) = (2 * place + i, 2 * other + j);
                        let own = (g[i * width + i] * g[j * width + j]).sqrt();
                        g[i * width + j].abs() > COUPLED * own
                    })
                });
                other != place && pairs.as_flattened().contains(&true)
            };
            if before[2 * place] >= -here.rate_rounding(2 * k) {
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
        Ok(impulses)
    }

    /// The bounce of a contact that touches and opens with the rates that impacts have left. If it `is_hit`, its next bounce is compared with this one; if not,
    /// it may be left from an impact before, when other bodies flew with it.
    pub fn bounce<S: System>(
        &mut self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        (contact, is_hit): (usize, bool),
    ) -> Bounce {
        let here = self.kinematics(system, (t, q, v));
        let opening = here.rates[2 * contact];
        let before = if is_hit {
            core::mem::replace(&mut self.openings[contact], opening)
        } else {
            0.0
        };
        Bounce {
            opening,
            before,
            roundoff: here.gap_roundoff(contact),
            restitution: here.restitution(contact)[0],
        }
    }

    /// Whether bounces of a contact have become so low that they are at their end: how long the rest of them takes, in s. `gap_acceleration` is what its
    /// rate changes by while it is open.
    pub fn remaining_bounce_time(&self, bounce: &Bounce, gap_acceleration: f64) -> Option<f64> {
        let &Bounce {
            opening,
            before,
            roundoff,
            restitution,
        } = bounce;
        if opening <= 0.0 || gap_acceleration >= 0.0 {
            return None;
        }
        let rate_to = |height: f64| (2.0 * -gap_acceleration * height * roundoff).sqrt();
        // A bounce in which the gap stays unknown cannot be followed, whether or not other bodies have made it higher than the one before.
        let known_share = if before > 0.0 {
            opening / before
        } else {
            f64::INFINITY
        };
        let share = if opening <= rate_to(KNOWN_HEIGHT) {
            known_share.min(restitution)
        } else {
            known_share
        };
        if share >= 1.0 {
            return None;
        }
        let limit = rate_to(LEAST_HEIGHT).max(LEAST_BOUNCE * self.speed);
        (opening <= limit).then(|| 2.0 * opening / -gap_acceleration / (1.0 - share))
    }

    /// How fast the rates of all gaps change while the machine has these accelerations; 0 where that is rounding beside the greatest one, as between bodies that
    /// fall together.
    pub fn gap_accelerations<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        a: &[f64],
    ) -> Vec<f64> {
        let here = self.kinematics(system, (t, q, v));
        let all: Vec<[f64; 2]> = (0..here.gaps.len())
            .map(|contact| here.acceleration(2 * contact, a))
            .collect();
        let greatest = all
            .iter()
            .fold(0.0, |most, [_, terms]| f64::max(most, *terms));
        let is_rounding = |value: f64| value.abs() <= ROUNDING * greatest;
        let values = all.into_iter().map(|[value, _]| value);
        values
            .map(|value| if is_rounding(value) { 0.0 } else { value })
            .collect()
    }

    /// Which of the contacts that are closed are at rest along their tangents.
    pub fn resting<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        closed: &[bool],
    ) -> Vec<bool> {
        let here = self.kinematics(system, (t, q, v));
        let rest = self.rest(&here, self.greatest_rate(), |k| closed[k]);
        let rest_of_turning = self.rest_of_turning(&here, |k| closed[k]);
        let rests = |k: usize| {
            if !closed[k] {
                return false;
            }
            let rest = if self.is_turning(k) {
                rest_of_turning
            } else {
                rest
            };
            if self.has_two_tangents(k) {
                let [slip, rounding] = self.slip(&here, k);
                return slip[0].hypot(slip[1]) <= rounding[0].hypot(rounding[1]).max(rest);
            }
            here.rates[2 * k + 1].abs() <= here.rate_rounding(2 * k + 1).max(rest)
        };
        (0..here.gaps.len()).map(rests).collect()
    }

    /// Takes note of how fast what is closed slips: slips that are rounding of it are rest, and several that stop at one instant stop
    /// together.
    pub fn record_slips<S: System>(&mut self, system: &S, t: f64, q: &S::Vector, v: &S::Vector) {
        let slides = |mode: &Mode| match mode {
            Mode::Slides(sign) => *sign != 0.0,
            Mode::SlidesAlong(_) => true,
            _ => false,
        };
        if !self.modes().iter().any(slides) {
            return;
        }
        let here = self.kinematics(system, (t, q, v));
        let turns = |k: &usize| slides(&self.modes()[*k]) && self.is_turning(*k);
        let turning = (0..self.modes().len()).filter(turns);
        let turning = turning.map(|k| here.rates[2 * k + 1].abs());
        let turning = turning.fold(self.turning, f64::max);
        let own = self.modes().iter().enumerate();
        let own = own.filter(|(k, mode)| slides(mode) && self.carrier(*k).is_none());
        let slips = own.map(|(k, mode)| match mode {
            Mode::SlidesAlong(_) => {
                let [slip, _] = self.slip(&here, k);
                slip[0].hypot(slip[1])
            }
            _ => here.rates[2 * k + 1].abs(),
        });
        self.slip = slips.fold(self.slip, f64::max);
        self.turning = turning;
    }

    /// Whether the slip of a contact is rounding, if that has two directions.
    pub fn is_slow<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        contact: usize,
    ) -> bool {
        if !self.has_two_tangents(contact) {
            return true;
        }
        let here = self.kinematics(system, (t, q, v));
        let [slip, rounding] = self.slip(&here, contact);
        let least = rounding[0]
            .hypot(rounding[1])
            .max(1e-12 * self.greatest_rate());
        slip[0].hypot(slip[1]) <= STOPPED * least
    }

    /// Which contacts slip in two directions so slowly that `errors` of the rates of coordinates decide where to, and are braked. Such a slip misses 0 by these
    /// errors and would be followed around it in ever shorter steps.
    pub fn fading_slips<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        errors: &[f64],
    ) -> Result<Vec<bool>, StepError> {
        let mut fading = vec![false; self.modes().len()];
        let slides = |k: usize| matches!(self.modes()[k], Mode::SlidesAlong(_));
        if !(0..fading.len()).any(slides) {
            return Ok(fading);
        }
        let here = self.kinematics(system, (at.t, at.q, at.v));
        let slip = |k: usize| self.slip(&here, k)[0];
        let is_slow = |k: &usize| {
            if self.first(*k) != *k {
                return false;
            }
            let [along, across] = slip(*k);
            let [own, other] = [1, 3].map(|part| here.rate_error(2 * k + part, errors));
            slides(*k) && along.hypot(across) <= own.hypot(other)
        };
        let slow: Vec<usize> = (0..fading.len()).filter(is_slow).collect();
        if slow.is_empty() {
            return Ok(fading);
        }
        let a = self.reaction(system, at)?.a;
        for k in slow {
            let change = [1, 3].map(|part| here.acceleration(2 * k + part, &a)[0]);
            let [along, across] = slip(k);
            fading[k] = along * change[0] + across * change[1] < 0.0;
        }
        Ok(fading)
    }

    /// Whether a contact that slides has come to rest where its slip is at right angles to what it was when the step began: then it
    /// is what the step has left of it, and not a turn.
    pub fn has_stopped<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        contact: usize,
    ) -> Result<bool, StepError> {
        let Mode::SlidesAlong(_) = self.modes()[contact] else {
            return Ok(true);
        };
        let At { t, q, v, .. } = at;
        let here = self.kinematics(system, (t, q, v));
        if self.is_slow(system, (t, q, v), contact) {
            return Ok(true);
        }
        let [slip, _] = self.slip(&here, contact);
        let speed = slip[0].hypot(slip[1]);
        // The contact has stopped if it does so before time goes on.
        let a = self.reaction(system, at)?.a;
        let braked = [1, 3].map(|part| here.acceleration(2 * self.first(contact) + part, &a)[0]);
        let left = speed / braked[0].hypot(braked[1]);
        Ok(left <= 64.0 * f64::EPSILON * t.abs())
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
