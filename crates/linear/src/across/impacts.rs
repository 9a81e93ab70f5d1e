//! Derivatives across impacts: the law of impact over dual numbers, with those contacts pressing, sticking and slipping that the run has
//! found to do so.

use lagrangian::interpreted::Named;
use lagrangian::{ContactImpact, ContactMode, ImpactLaw, ImpactOrder, State};
use lagrangian_scalar::Dual;

use super::{Change, NoDerivatives, Number, Passing, ROUNDING, ReportedImpact, zero};
use crate::varied::{Acts, DualState, Phase, Sought, SoughtReaction};

/// The penetration depth that would follow without an impact must be at least this many tolerances of the preceding
/// gap. Below that the contact grazes, and it is not certain that the impact happens at all.
const GRAZES: f64 = 100.0;

/// Friction within this fraction of its limit is saturated.
const SATURATED: f64 = 1e-10;

/// A slip below this fraction of the terms that it sums is round-off: a few units of it for each of at most some dozens of terms.
const ROUND_OFF_OF_SLIP: f64 = 256.0 * f64::EPSILON;

/// Contacts whose impulses change each other's rates by less than this fraction are uncoupled.
const COUPLED: f64 = 1e-12;

impl Passing<'_, '_> {
    /// Carries the derivatives across the impacts of an instant. `here` is the state after them.
    pub(super) fn cross_impacts(
        &self,
        change: Change<'_>,
        state: &mut State<Vec<f64>>,
        here: &State<Named>,
    ) -> Result<(), NoDerivatives> {
        let one_after_the_other = self.closing_contacts(&change, state)?;
        let mut phase = change.before.clone();
        for (round, &contact) in one_after_the_other.iter().enumerate() {
            let is_last = round + 1 == one_after_the_other.len();
            let hits: Vec<ReportedImpact> = match one_after_the_other.len() {
                1 => change.hits.to_vec(),
                _ => (change.hits.iter())
                    .filter(|(k, _)| *k == contact)
                    .copied()
                    .collect(),
            };
            let mut next = phase.clone();
            if is_last {
                next = change.after.clone();
            } else {
                next.modes[contact] = change.after.modes[contact];
            }
            let ended: &[usize] = if is_last { change.ended } else { &[] };
            self.cross_impact(
                contact,
                (&phase, &mut next),
                (&hits, ended),
                change.excursions[contact],
                state,
            )?;
            phase = next;
        }
        let (t, hits) = (change.t, change.hits);
        *change.after = phase;
        if !has_rates(state, here, hits) {
            return Err(self.broken(
                t,
                one_after_the_other[0],
                "takes part in several rounds of impacts at one instant",
            ));
        }
        self.put_values(state, here);
        Ok(())
    }

    /// The contacts whose gaps close in an impact and whose impacts are evaluated one after the other: one, or several that are
    /// uncoupled, in any order.
    ///
    /// # Errors
    /// If it matters which comes first, or if there are none.
    fn closing_contacts(
        &self,
        change: &Change<'_>,
        state: &State<Vec<f64>>,
    ) -> Result<Vec<usize>, NoDerivatives> {
        let before = |k: usize| change.before.modes[k];
        let mut closing: Vec<usize> = (change.hits.iter())
            .filter(|(k, hit)| {
                let is_own = !change.before.rolls[*k];
                is_own && before(*k) == ContactMode::Open && hit.gap_rate[0] < 0.0
            })
            .map(|(k, _)| *k)
            .collect();
        closing.dedup();
        let is_sequence = self.laws[change.hits[0].0].1 == ImpactOrder::Sequence;
        match closing[..] {
            [] => Err(self.broken(
                change.t,
                change.hits[0].0,
                "has an impact without a gap that closes",
            )),
            [first, ..] if is_sequence => Ok(vec![first]),
            [_] => Ok(closing),
            [_, second, ..] => {
                let apart = (change.hits.len() == closing.len() && change.ended.is_empty())
                    .then(|| self.are_uncoupled(&closing, state, change.before))
                    .flatten();
                if apart != Some(true) {
                    return Err(self.broken(
                        change.t,
                        second,
                        "has an impact at the same instant as another, and it matters which of the two comes first",
                    ));
                }
                Ok(closing)
            }
        }
    }

    /// Whether the impulses of these contacts leave each other's rates unchanged.
    fn are_uncoupled(
        &self,
        contacts: &[usize],
        state: &State<Vec<f64>>,
        phase: &Phase,
    ) -> Option<bool> {
        let still = self.moved(state, 0, 0.0, &vec![0.0; self.n]);
        self.place(still, 0, phase, |place| {
            // The friction of guides couples what they carry.
            let mut apart = phase.sides.is_empty();
            for &k in contacts {
                for part in [0, 1] {
                    let one = [(2 * k + part, Dual::constant(1.0))];
                    let change = place.respond(&[], &one, &[])?.change;
                    let by = |direction: usize| {
                        let terms = place.row(direction).iter().zip(&change);
                        terms.fold([0.0; 2], |[sum, size], (w, by)| {
                            let term = w.value * by.value;
                            [sum + term, size + term.abs()]
                        })
                    };
                    for &other in contacts.iter().filter(|other| **other != k) {
                        for direction in [2 * other, 2 * other + 1] {
                            let [sum, size] = by(direction);
                            apart &= sum.abs() <= COUPLED * size;
                        }
                    }
                }
            }
            Some(apart)
        })
    }

    /// Carries the derivatives across an impact that one closing gap triggers.
    fn cross_impact(
        &self,
        contact: usize,
        (before, after): (&Phase, &mut Phase),
        (hits, ended): (&[ReportedImpact], &[usize]),
        excursion: f64,
        state: &mut State<Vec<f64>>,
    ) -> Result<(), NoDerivatives> {
        let t = state.t;
        let broken = |contact: usize, why| self.broken(t, contact, why);
        let no_forces = || {
            broken(
                contact,
                "shares its load with others, and the shares are not unique",
            )
        };
        let a_before = self.accelerations(state, before).ok_or_else(no_forces)?;
        let (mut moved, mut shifts) = (Vec::new(), Vec::new());
        for direction in 0..self.directions {
            let still = self.moved(state, direction, 0.0, &a_before);
            let [gap, rate, bend] = self
                .place(still, direction, before, |place| {
                    let a: Vec<Number> = a_before.iter().map(|a| Dual::constant(*a)).collect();
                    let bend = place.acceleration(2 * contact, &a);
                    Some([place.gaps[contact], place.rates[2 * contact], bend])
                })
                .ok_or_else(no_forces)?;
            // The penetration depth that would follow without the impact.
            let depth = 0.5 * rate.value * rate.value / bend.value.abs();
            if rate.value >= 0.0 || depth < GRAZES * self.wanted.tolerance * excursion {
                return Err(broken(
                    contact,
                    "is grazed: whether it touches at all depends on the variation",
                ));
            }
            let by = -gap.derivative / rate.value;
            let there = self.moved(state, direction, by, &a_before);
            let v = self.place(there.clone(), direction, before, |place| {
                Some(self.rates_after(place, (before, &*after), (hits, ended)))
            });
            let v = v
                .ok_or_else(no_forces)?
                .map_err(|(contact, why)| broken(contact, why))?;
            moved.push((there, v));
            shifts.push(by);
        }
        let n = self.n;
        for (i, v) in moved[0].1.iter().enumerate() {
            state.v[i] = v.value;
        }
        let places: Vec<Vec<Number>> = moved.iter().map(|(there, _)| there.clone()).collect();
        self.load_layers(after, &places);
        let a_after = self.accelerations(state, after).ok_or_else(|| {
            broken(
                contact,
                "shares its load with others, and the shares are not unique",
            )
        })?;
        for (direction, ((there, v), by)) in moved.into_iter().zip(shifts).enumerate() {
            let part = (direction + 1) * n;
            for i in 0..n {
                state.q[part + i] = there[1 + i].derivative - v[i].value * by;
                state.v[part + i] = v[i].derivative - a_after[i] * by;
            }
        }
        Ok(())
    }

    /// The rates after an impact.
    fn rates_after(
        &self,
        place: &mut DualState<'_>,
        (before, after): (&Phase, &Phase),
        (hits, ended): (&[ReportedImpact], &[usize]),
    ) -> Result<Vec<Number>, (usize, &'static str)> {
        let is_sequence = hits.len() > 1 && self.laws[hits[0].0].1 == ImpactOrder::Sequence;
        let guide = hits.iter().find(|(k, _)| before.guide(*k).is_some());
        if let (true, Some((guide, _))) = (is_sequence, guide) {
            return Err((
                *guide,
                "takes part as a guide in impacts one after the other, for which there are no derivatives",
            ));
        }
        let rounds: Vec<&[ReportedImpact]> = if is_sequence {
            hits.chunks(1).collect()
        } else {
            vec![hits]
        };
        for round in rounds {
            self.impact(place, (before, after), round)?;
        }
        if !ended.is_empty() {
            // Without friction, the remaining rates at the end of a bouncing sequence are set to zero.
            let mut sought = Vec::new();
            for k in (0..after.modes.len()).filter(|k| after.is_closed(*k)) {
                let rigid = after.compliances[after.presses(k)].is_none();
                let is_guide = after.guide(k).is_some();
                let sticks = |phase: &Phase| phase.modes[k] == ContactMode::Sticks;
                let stuck = after.has_friction[k] && sticks(before) && sticks(after);
                let is_pressed = rigid && !is_guide && !after.rolls[k];
                for (part, is_held) in [(0, is_pressed), (1, rigid && stuck)] {
                    if is_held {
                        let row = place.row(2 * k + part).to_vec();
                        sought.push(Sought {
                            acts: vec![(2 * k + part, Dual::constant(1.0))],
                            row,
                            change: zero() - place.rates[2 * k + part],
                        });
                    }
                }
            }
            let guides = vec![SoughtReaction::default(); after.sides.len()];
            self.impulses_for(place, &sought, &guides, &after.modes)
                .ok_or((
                    ended[0],
                    "stops bouncing where several contacts share a load",
                ))?;
        }
        Ok(place.v.clone())
    }

    /// Applies the impulses that bring about the sought changes of rates; returns these impulses.
    fn impulses_for(
        &self,
        place: &mut DualState<'_>,
        sought: &[Sought],
        guides: &[SoughtReaction],
        modes: &[ContactMode],
    ) -> Option<Vec<Number>> {
        let response = place.respond(sought, &[], guides)?;
        let change = response.change;
        for (v, by) in place.v.iter_mut().zip(&change) {
            *v = *v + *by;
        }
        for direction in 0..2 * modes.len() {
            let row = place.row(direction).to_vec();
            let by = row.iter().zip(&change);
            let by = by.fold(zero(), |sum, (w, by)| sum + *w * *by);
            place.rates[direction] = place.rates[direction] + by;
        }
        Some(response.forces)
    }

    /// One impact of contacts that take part simultaneously, by Newton's law, with pressing, sticking and slipping
    /// as the run found them.
    fn impact(
        &self,
        place: &mut DualState<'_>,
        (before, after): (&Phase, &Phase),
        hits: &[ReportedImpact],
    ) -> Result<(), (usize, &'static str)> {
        let greatest = hits.iter().fold(0.0_f64, |most, (_, hit)| {
            most.max(hit.impulse[0].abs()).max(hit.impulse[1].abs())
        });
        let one = Dual::constant(1.0);
        let mut sought = Vec::new();
        let mut idle = Vec::new();
        let guides = self.guides_in_impact(place, after, hits, (greatest, &mut sought))?;
        let pressed = |k: &usize| !after.rolls[*k] && after.guide(*k).is_none();
        for (k, hit) in hits.iter().filter(|(k, _)| pressed(k)) {
            let is_idle = hit.impulse[0] <= 1e-12 * greatest;
            // Contacts at rest that receive no impulse press as well, but only if they stay closed.
            let stays_closed = before.is_closed(*k) && after.is_closed(*k);
            if !(hit.impulse[0] > 1e-12 * greatest || stays_closed) {
                continue;
            }
            if is_idle {
                idle.push((sought.len(), *k));
            }
            let mut acts: Acts = vec![(2 * k, one)];
            let mut tangents = Vec::new();
            for (j, own) in [*k, k + 1].into_iter().filter_map(|j| impact_of(hits, j)) {
                if after.presses(j) != *k || !after.has_friction[j] {
                    continue;
                }
                if self.laws[*k].0 != ImpactLaw::Newton {
                    return Err((
                        *k,
                        "has impacts with friction by a law other than `newton`, for which there are no derivatives",
                    ));
                }
                let tangent = Tangent {
                    contact: j,
                    own,
                    is_idle,
                    most: place.coefficients(j)[2].value * hit.impulse[0],
                };
                let friction = tangent.friction(place, after);
                match friction.map_err(|why| (*k, why))? {
                    ImpactFriction::Sticks(tangent) => tangents.push(tangent),
                    ImpactFriction::Slips(friction) => acts.push((2 * j + 1, friction)),
                }
            }
            if self.laws[*k].0 != ImpactLaw::Newton && hits.len() > 1 && !self.is_alone(hits, *k) {
                return Err((
                    *k,
                    "has an impact together with others by a law other than `newton`, for which there are no derivatives",
                ));
            }
            // The gap of a contact that stays closed without an impulse does not open before the impact, nor does it in any variation: what round-off
            // leaves of its rate would count where the impact itself is as weak.
            let change = if is_idle {
                zero()
            } else {
                let [restitution, ..] = place.coefficients(*k);
                zero() - (one + restitution) * place.rates[2 * k]
            };
            sought.push(Sought {
                acts,
                row: place.row(2 * k).to_vec(),
                change,
            });
            sought.append(&mut tangents);
        }
        let impulses = self
            .impulses_for(place, &sought, &guides, &after.modes)
            .ok_or((
                hits[0].0,
                "shares its impact with others, and the shares are not unique",
            ))?;
        check_idle(&impulses, &idle)
    }

    /// The guides in an impact: the friction of those that slip in it is in proportion to their reactions; those that stop slipping are added to what is sought.
    fn guides_in_impact(
        &self,
        place: &DualState<'_>,
        after: &Phase,
        hits: &[ReportedImpact],
        (greatest, sought): (f64, &mut Vec<Sought>),
    ) -> Result<Vec<SoughtReaction>, (usize, &'static str)> {
        let mut guides = vec![SoughtReaction::default(); after.sides.len()];
        for (k, hit) in hits {
            let Some(guide) = after.guide(*k) else {
                continue;
            };
            // Without a reaction it has no friction.
            if hit.impulse[0].abs() <= 1e-12 * greatest {
                continue;
            }
            if self.laws[*k].0 != ImpactLaw::Newton {
                return Err((
                    *k,
                    "has impacts with friction by a law other than `newton`, for which there are no derivatives",
                ));
            }
            let tangent = Tangent {
                contact: *k,
                own: hit,
                is_idle: false,
                most: place.coefficients(*k)[2].value * hit.impulse[0].abs(),
            };
            match tangent.friction(place, after).map_err(|why| (*k, why))? {
                ImpactFriction::Sticks(tangent) => sought.push(tangent),
                ImpactFriction::Slips(friction) => {
                    let side = Dual::constant(hit.impulse[0].signum());
                    guides[guide].acts.push((2 * k + 1, side * friction));
                }
            }
        }
        Ok(guides)
    }

    /// Whether a contact is the only one with an impulse.
    fn is_alone(&self, hits: &[ReportedImpact], contact: usize) -> bool {
        hits.iter()
            .all(|(k, hit)| *k == contact || hit.impulse == [0.0; 2])
    }
}

/// A tangent of a contact in an impact.
struct Tangent<'t> {
    /// The contact whose slip is along it.
    contact: usize,
    own: &'t ContactImpact,
    /// Whether the contact presses without an impulse.
    is_idle: bool,
    /// The greatest impulse of friction.
    most: f64,
}

/// The friction along a tangent in an impact.
enum ImpactFriction {
    /// The slip after the impact is that before it times −eₜ, the tangential restitution.
    Sticks(Sought),
    /// Friction is this multiple of the size of the normal impulse.
    Slips(Number),
}

impl Tangent<'_> {
    /// Whether it sticks or slips, as the run found it.
    fn friction(
        &self,
        place: &DualState<'_>,
        after: &Phase,
    ) -> Result<ImpactFriction, &'static str> {
        let &Tangent {
            contact: j,
            own,
            is_idle,
            most,
        } = self;
        let [_, tangential, friction, _] = place.coefficients(j);
        let row = place.row(2 * j + 1).to_vec();
        let left = own.slip[1] + tangential.value * own.slip[0];
        let size = own.slip[0].abs() + own.slip[1].abs();
        let sticks = if is_idle {
            after.modes[j] == ContactMode::Sticks
        } else {
            // The friction of an impact that is far weaker than its slip is fast is known only to the round-off of that slip, and so
            // whether it is saturated. What still slips has not stuck. A slip that an earlier impact has stopped is rounding alone,
            // and is so small only beside the rates of the gap, from which that impact computed it.
            let terms = row.iter().zip(&place.v);
            let terms = terms.map(|(w, v)| (w.value * v.value).abs());
            let terms: f64 = terms.chain(own.gap_rate.map(f64::abs)).sum();
            let goes_on = left.abs() > (ROUNDING * size).max(ROUND_OFF_OF_SLIP * terms);
            !goes_on && own.impulse[1].abs() < most * (1.0 - SATURATED)
        };
        if sticks {
            let one = Dual::constant(1.0);
            return Ok(ImpactFriction::Sticks(Sought {
                acts: vec![(2 * j + 1, one)],
                change: zero() - (one + tangential) * place.rates[2 * j + 1],
                row,
            }));
        }
        let sign = match after.modes[j] {
            ContactMode::Slides(sign) if is_idle => -sign,
            _ => own.impulse[1].signum(),
        };
        if !is_idle && most > 0.0 && left.abs() <= ROUNDING * size {
            return Err("is on the boundary between slipping and sticking in its impact");
        }
        Ok(ImpactFriction::Slips(Dual::constant(sign) * friction))
    }
}

/// A contact's part in an impact, if it takes part.
fn impact_of(hits: &[ReportedImpact], contact: usize) -> Option<(usize, &ContactImpact)> {
    let found = hits.iter().find(|(other, _)| *other == contact);
    found.map(|(k, hit)| (*k, hit))
}

/// Checks that contacts without an impulse, given by the indices of their impulses, have none under the variation: one of one
/// sign would press such a contact, one of the other sign would open it.
fn check_idle(impulses: &[Number], idle: &[(usize, usize)]) -> Result<(), (usize, &'static str)> {
    let size = impulses
        .iter()
        .fold(0.0_f64, |most, x| most.max(x.derivative.abs()));
    for &(index, contact) in idle {
        if impulses[index].derivative.abs() > ROUNDING * size {
            return Err((
                contact,
                "touches without an impulse while others have impacts, and would have one, or open, under the variation",
            ));
        }
    }
    Ok(())
}

/// Whether the law of impact over dual numbers has given the same rates as the run.
fn has_rates(state: &State<Vec<f64>>, run: &State<Named>, hits: &[ReportedImpact]) -> bool {
    let jump: f64 = (hits.iter())
        .map(|(_, hit)| hit.gap_rate[0].abs() + hit.gap_rate[1].abs())
        .fold(0.0, f64::max);
    let rates = &run.v.values;
    let size = rates.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    let is_other = |(found, v): (&f64, &f64)| (found - v).abs() > 1e-3 * size.max(jump);
    !state.v.iter().zip(rates).any(is_other)
}
