//! Forces that closed contacts share, and how to distribute them so that all hold as long as any distribution permits it.

use std::vec;
use std::vec::Vec;

use super::super::ContactTrouble;
use super::super::kinematics::ContactKinematics;
use super::reaction::{OpenEquations, Reaction};
use super::{Margin, Mode, ROUNDING_OF_FORCES, UnilateralState};
use crate::StepError;
use crate::contact_law::shares::{self, Limit, PARTS, Sharer};

/// The most guides of which both sides are tried.
const MOST_SIDES: usize = 6;

/// The distribution of forces among contacts at which the least margin is greatest.
pub(super) struct SharedLoad {
    /// The margin of each contact that shares forces, and nothing for the others. Both tangents of a contact have that of the first.
    pub margins: Vec<Option<ShareOfLoad>>,
    /// Along normal and tangent, of every contact.
    pub forces: Vec<[f64; 2]>,
}

impl SharedLoad {
    fn least_margin(&self) -> f64 {
        let margins = self.margins.iter().flatten();
        margins.fold(f64::INFINITY, |least, share| least.min(share.margin.value))
    }
}

/// The margin of a contact that shares forces with others.
pub(super) struct ShareOfLoad {
    pub margin: Margin,
    /// Whether its normal force is undetermined.
    pub shares_normal: bool,
    /// Whether the margin is that of its friction as well.
    pub shares_friction: bool,
    /// Whether and how this contact limits the margin.
    pub limit: Option<Limit>,
}

impl UnilateralState {
    /// Sets which contacts have forces that the equations of motion leave undetermined; none is set before.
    pub(super) fn write_sharing(&self, reaction: &Reaction, shares: &mut [bool]) {
        let Some(equations) = &reaction.open_equations else {
            return;
        };
        let of_unit = &equations.of_unit;
        for (unknown, (place, _)) in equations.unknowns.iter().enumerate() {
            shares[equations.closed[*place]] |= of_unit.iter().any(|own| own[unknown] != 0.0);
        }
        // The normal force of a contact limits what it carries, and friction along both of its tangents.
        for (k, on) in self.carrier.iter().enumerate() {
            if let Some(on) = *on {
                shares[k] |= shares[on];
                shares[on] |= shares[k] && self.across[k];
            }
        }
    }

    /// The distribution of undetermined forces at which the least margin of the contacts is greatest, (E78); nothing if none is undetermined. A guide that sticks
    /// may press to either side: each combination of the sides of those whose reactions are undetermined is tried, of the first few.
    pub(super) fn shared_load(
        &self,
        here: &ContactKinematics,
        reaction: &Reaction,
        t: f64,
    ) -> Result<Option<SharedLoad>, StepError> {
        let Some(equations) = &reaction.open_equations else {
            return Ok(None);
        };
        let may_turn = |&(place, k): &(usize, &usize)| {
            self.modes[*k] == Mode::Sticks
                && equations.of_reactions.iter().any(|by| by[place] != 0.0)
        };
        let turning = equations.closed.iter().enumerate().filter(may_turn);
        let turning: Vec<usize> = turning.take(MOST_SIDES).map(|(_, k)| *k).collect();
        let mut sides = self.sides.clone();
        for k in (0..sides.len()).filter(|k| self.is_guide(*k) && self.modes[*k] == Mode::Sticks) {
            sides[k] = reaction.forces[k][0].signum();
        }
        let first = self.shared_load_with(here, reaction, (equations, &sides), t);
        let mut best = first;
        for pattern in 1..1_usize << turning.len() {
            let mut sides = sides.clone();
            for (place, k) in turning.iter().enumerate() {
                if pattern >> place & 1 != 0 {
                    sides[*k] = -sides[*k];
                }
            }
            let other = self.shared_load_with(here, reaction, (equations, &sides), t);
            let margin = |load: &Result<SharedLoad, StepError>| {
                load.as_ref()
                    .map_or(f64::NEG_INFINITY, SharedLoad::least_margin)
            };
            if margin(&other) > margin(&best) {
                best = other;
            }
        }
        best.map(Some)
    }

    /// The distribution with guides that press to these sides.
    fn shared_load_with(
        &self,
        here: &ContactKinematics,
        reaction: &Reaction,
        (equations, sides): (&OpenEquations, &[f64]),
        t: f64,
    ) -> Result<SharedLoad, StepError> {
        let closed = &equations.closed;
        let free = equations.of_unit.len();
        let (sharers, by) = self.sharers(here, reaction, (equations, sides));
        let mut groups = vec![0; free];
        shares::group(&by, &mut groups);
        let mut load = SharedLoad {
            margins: self.modes.iter().map(|_| None).collect(),
            forces: reaction.forces.clone(),
        };
        let mut numbers = vec![0.0; shares::numbers_length(closed.len(), free)];
        let mut places = vec![0; shares::places_length(closed.len(), free)];
        let (mut undetermined, mut limits) = (vec![0.0; free], vec![None; closed.len()]);
        for group in (0..free).filter(|group| groups[*group] == *group) {
            let by_place = |place: usize| &by[PARTS * free * place..][..PARTS * free];
            let of_group = |place: &usize| shares::is_in(by_place(*place), &groups, group);
            let members = || (0..closed.len()).filter(of_group);
            undetermined.fill(0.0);
            let shared = shares::share(
                &sharers,
                (&by, &groups, group),
                (&mut numbers, &mut places),
                (&mut undetermined, &mut limits),
            );
            let Some(shared) = shared else {
                return Err(StepError::Contact {
                    contact: self.first(members().next().map_or(closed[0], |place| closed[place])),
                    trouble: ContactTrouble::Unsolved,
                    t,
                });
            };
            let size = |place: usize| {
                let own = reaction.sizes[closed[place]];
                match sharers[place].static_friction {
                    Some(friction) if friction > 0.0 => own * (1.0 + 1.0 / friction),
                    _ => own,
                }
            };
            let size = members().map(size).fold(0.0, f64::max);
            let margin = Margin {
                value: shared.value,
                rounding: (ROUNDING_OF_FORCES * size).max(shared.residual),
            };
            for place in members() {
                let k = closed[place];
                let added = |part: usize| {
                    let own = &by_place(place)[part * free..][..free];
                    let terms = own.iter().zip(&undetermined);
                    terms.map(|(x, y)| x * y).sum::<f64>()
                };
                let normal = sides[k] * added(0);
                if self.carrier[k].is_none() {
                    load.forces[k][0] += normal;
                }
                load.forces[k][1] += added(1) + self.share(here, k) * normal;
                if let Some(second) = self.second(k) {
                    load.forces[second][1] += added(2) + self.share(here, second) * normal;
                }
                let depends = |part: usize| {
                    by_place(place)[part * free..][..free]
                        .iter()
                        .any(|x| *x != 0.0)
                };
                load.margins[k] = Some(ShareOfLoad {
                    margin,
                    shares_normal: depends(0),
                    // A friction force of a contact without friction that depends on nothing shared has a margin of its own.
                    shares_friction: here.friction(k)[1] > 0.0 || depends(1) || depends(2),
                    limit: limits[place],
                });
            }
        }
        Ok(load)
    }

    /// The closed contacts as those that may share forces, and what each undetermined force adds to theirs. The second tangent of a contact
    /// belongs to the first.
    fn sharers(
        &self,
        here: &ContactKinematics,
        reaction: &Reaction,
        (equations, sides): (&OpenEquations, &[f64]),
    ) -> (Vec<Sharer>, Vec<f64>) {
        let OpenEquations {
            closed,
            unknowns,
            of_unit,
            of_reactions,
        } = equations;
        let free = of_unit.len();
        let mut by = vec![0.0; PARTS * free * closed.len()];
        let mut sharers = vec![Sharer::default(); closed.len()];
        for (place, (&k, own)) in (closed.iter().zip(by.chunks_exact_mut(PARTS * free))).enumerate()
        {
            if self.across[k] {
                continue;
            }
            // A contact with a carrier has the normal force of its carrier, which precedes it.
            let pressing = place - usize::from(self.carrier[k].is_some());
            let second = self.second(k);
            let across = second.map(|_| (place + 1, 1));
            let parts = [Some((pressing, 0)), Some((place, 1)), across];
            for (row, part) in own.chunks_exact_mut(free).zip(parts) {
                let unknown = part.and_then(|part| unknowns.iter().position(|u| *u == part));
                if let Some(unknown) = unknown {
                    for (x, of_unit) in row.iter_mut().zip(of_unit) {
                        *x = of_unit[unknown];
                    }
                }
            }
            if self.is_guide(k) {
                for (x, of_reactions) in own.iter_mut().zip(of_reactions) {
                    *x = sides[k] * of_reactions[place];
                }
            }
            let sticks = self.modes[k] == Mode::Sticks && self.has_friction[k];
            sharers[place] = Sharer {
                static_friction: sticks.then(|| here.friction(k)[1]),
                presses: self.carrier[k].is_none() && !self.is_compliant(k),
                normal: sides[k] * reaction.forces[closed[pressing]][0],
                tangential: [
                    reaction.forces[k][1],
                    second.map_or(0.0, |second| reaction.forces[second][1]),
                ],
            };
        }
        (sharers, by)
    }
}
