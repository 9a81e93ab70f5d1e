//! What closed contacts do next: the state is brought onto them, and their forces decide whether they stick, slip or open.

use std::vec::Vec;

use super::super::Model;
use super::{Cause, ContactChanges};
use crate::at::At;
use crate::constraints::Constraints;
use crate::contact::{Mode, UnilateralState};
use crate::inputs::InputLaw;
use crate::stages::Point;
use crate::unilateral::ContactTrouble;
use crate::{StepError, System, Vector};

/// A slip that has stopped is removed without a further question if that changes the kinetic energy by at most this share: a slip is located to the
/// tolerance of the step, and its square is less.
const SHARE_OF_REST: f64 = 1e-9;

impl<S: System, L: InputLaw<S>> Model<'_, S, L> {
    /// Brings a state onto the contacts that are closed and sets what these do next. If their friction jams them, the slips that are in the way stop first. The
    /// answer is which contacts rest, and by how much that has changed the kinetic energy, in J.
    pub(super) fn settle_closed(
        &self,
        touching: &mut UnilateralState,
        now: &mut Point<S::Vector>,
        (cause, closed, mut stopped): (Cause, &mut [bool], Vec<bool>),
        changes: &mut ContactChanges,
    ) -> Result<(Vec<bool>, f64), StepError> {
        let system = self.system.get();
        let energy = |now: &Point<S::Vector>| system.kinetic_energy(now.t, &now.q, &now.v);
        let (mut jammed, mut is_hit) = (0.0, !changes.impacts.is_empty());
        // Each time at least one contact stops, turns or opens.
        for _ in 0..=2 * closed.len() {
            self.hold_closed(touching, now, (closed, &stopped, is_hit))?;
            let resting = resting_or_stopped(system, touching, now, (closed, &stopped));
            let settled = self.settle(touching, now, (cause, closed, &resting), changes);
            let Err(error) = settled else {
                return Ok((resting, jammed));
            };
            if !is_of_several(&error) {
                return Err(error);
            }
            let at = At {
                t: now.t,
                q: &now.q,
                v: &now.v,
                u: &self.inputs,
            };
            let jam = touching.resolve_jam(system, at, (closed, &resting))?;
            let Some(jam) = jam else {
                return Err(error);
            };
            let before = energy(now);
            for (v, by) in now.v.as_mut_slice().iter_mut().zip(&jam.change) {
                *v += by;
            }
            now.v_low.as_mut_slice().fill(0.0);
            let change = energy(now) - before;
            jammed += change;
            if change.abs() > SHARE_OF_REST * before {
                changes.told.jammed.extend(jam.stop.iter().chain(&jam.open));
                changes.impacts.extend(jam.impacts);
            } else {
                changes.slight_impacts.extend(jam.impacts);
            }
            for k in jam
                .stop
                .iter()
                .flat_map(|k| [Some(*k), touching.second(*k)])
            {
                k.into_iter().for_each(|k| stopped[k] = true);
            }
            jam.open.iter().for_each(|k| closed[*k] = false);
            touching.copy_from_carriers(closed);
            is_hit = true;
        }
        Err(StepError::Contact {
            contact: closed.iter().position(|closed| *closed).unwrap_or(0),
            trouble: ContactTrouble::Unsettled,
            t: now.t,
        })
    }

    /// Sets what closed contacts do next, with what the cause of the change says of one of them.
    fn settle(
        &self,
        touching: &mut UnilateralState,
        now: &Point<S::Vector>,
        (cause, closed, resting): (Cause, &[bool], &[bool]),
        changes: &mut ContactChanges,
    ) -> Result<(), StepError> {
        let known = match cause {
            Cause::Lifts(k) | Cause::Leaves(k) => Some((k, Mode::Open)),
            Cause::Breaks(k, direction) if touching.second(k).is_some() => {
                Some((k, Mode::SlidesAlong(direction)))
            }
            Cause::Breaks(k, [along, _]) => Some((k, Mode::Slides(along.signum()))),
            Cause::Unspecified
            | Cause::Stops(_)
            | Cause::Presses(_)
            | Cause::Switches(_)
            | Cause::Turns(_) => None,
        };
        let system = self.system.get();
        let at = At {
            t: now.t,
            q: &now.q,
            v: &now.v,
            u: &self.inputs,
        };
        let mut settled = touching.settled(system, at, closed, resting, known.as_slice());
        if known.is_some() && settled.as_ref().is_err_and(is_of_several) {
            // Several change at this instant: what is known of one does not go with what the others do.
            settled = touching.settled(system, at, closed, resting, &[]);
        }
        let mut settled = settled?;
        let is_same = |modes: &[Mode]| {
            let mut pairs = modes.iter().zip(touching.modes());
            pairs.all(|(after, before)| after.is_like(*before))
        };
        if cause == Cause::Unspecified && is_same(&settled.modes) {
            // Contacts that share a load may exceed what they hold together by so little that the forces above do not show it.
            let let_go = touching.let_go(system, at)?;
            if !let_go.is_empty() {
                settled = touching.settled(system, at, closed, resting, &let_go)?;
            }
        }
        touching.take_sides(
            &settled,
            match cause {
                // Impacts change reactions by more than what changes their signs.
                Cause::Switches(k) if changes.impacts.is_empty() => Some(k),
                _ => None,
            },
        );
        let mut modes = settled.modes;
        (changes.told.shared_otherwise).extend(settled.shared_otherwise);
        if matches!(cause, Cause::Lifts(_)) && changes.impacts.is_empty() {
            touching.keep_slipping(&mut modes, (&changes.before, &settled.at_limit));
        }
        if let Cause::Lifts(_) | Cause::Breaks(..) = cause {
            // Contacts that lift at the same instant, by symmetry or because what held them slips, would otherwise close each other again and again.
            let was_open = |k: usize| changes.before[k] == Mode::Open && !touching.is_compliant(k);
            modes = touching.without_unpressed(system, at, modes, was_open)?;
        }
        let as_found = modes.clone();
        modes = touching.without_contradictions(system, at, modes, (resting, &settled.at_limit));
        let mut pairs = modes.iter().zip(&changes.before);
        if let Cause::Breaks(k, _) = cause
            && changes.impacts.is_empty()
            && pairs.all(|(after, before)| after.is_like(*before))
            && touching.take_back(now.t, k)
        {
            // Nothing else happens, and its friction is used up again at this instant.
            modes = as_found;
        }
        touching.set_modes(modes);
        Ok(())
    }

    /// Brings a state onto the contacts that are closed, without the slips that have stopped, which sets what contacts do.
    fn hold_closed(
        &self,
        touching: &mut UnilateralState,
        now: &mut Point<S::Vector>,
        (closed, stopped, is_hit): (&[bool], &[bool], bool),
    ) -> Result<(), StepError> {
        let system = self.system.get();
        // A slip that has stopped is at rest, and so is one at a contact that has just closed.
        let rests = touching.resting(system, (now.t, &now.q, &now.v), closed);
        let mode = |k: usize| match touching.modes()[k] {
            _ if !closed[k] => Mode::Open,
            _ if stopped[k] => Mode::Sticks,
            Mode::Open => Mode::Slides(0.0),
            // An impact elsewhere may have made it slip, beyond what the impulse of its friction could prevent.
            _ if !rests[k] && is_hit => Mode::Slides(0.0),
            mode => mode,
        };
        let held: Vec<Mode> = (0..closed.len()).map(mode).collect();
        touching.set_modes(held.clone());
        let as_found = now.clone();
        let projected = project_onto_closed_contacts(system, touching, now);
        let energy = |now: &Point<S::Vector>| system.kinetic_energy(now.t, &now.q, &now.v);
        let is_held = projected.is_ok() && energy(now) >= (1.0 - SHARE_OF_REST) * energy(&as_found);
        if is_held
            || !stopped
                .iter()
                .zip(closed)
                .any(|(stops, closed)| *stops && *closed)
        {
            return projected.map(|_| ());
        }
        // Near a dead centre a slip stops whatever friction does, and to hold it there would stop the machine. So forces decide first.
        *now = as_found.clone();
        if self.goes_on(touching, now, (closed, stopped))? {
            return Ok(());
        }
        projected?;
        *now = as_found;
        touching.set_modes(held);
        project_onto_closed_contacts(system, touching, now)?;
        Ok(())
    }

    /// Whether slips that have stopped go on at once. The state is then on the closed contacts with these slips.
    fn goes_on(
        &self,
        touching: &mut UnilateralState,
        now: &mut Point<S::Vector>,
        (closed, stopped): (&[bool], &[bool]),
    ) -> Result<bool, StepError> {
        let system = self.system.get();
        let with_slip = (touching.modes().iter().zip(stopped))
            .map(|(mode, stops)| if *stops { Mode::Slides(0.0) } else { *mode })
            .collect();
        touching.set_modes(with_slip);
        project_onto_closed_contacts(system, touching, now)?;
        let resting = resting_or_stopped(system, touching, now, (closed, stopped));
        let at = At {
            t: now.t,
            q: &now.q,
            v: &now.v,
            u: &self.inputs,
        };
        let goes_on = match touching.settled(system, at, closed, &resting, &[]) {
            Err(error) if is_of_several(&error) => return Ok(false),
            other => other?,
        };
        let mut pairs = goes_on.modes.iter().zip(stopped);
        Ok(!pairs.any(|(mode, stops)| *stops && *mode == Mode::Sticks))
    }
}

/// Whether an error says that several contacts together admit no motion.
fn is_of_several(error: &StepError) -> bool {
    let StepError::Contact { trouble, .. } = error else {
        return false;
    };
    matches!(trouble, ContactTrouble::Jammed | ContactTrouble::Unsolved)
}

/// Which contacts rest: by their rates, because they have just stopped, alone or with another one, or because they stick.
pub(super) fn resting_or_stopped<S: System>(
    system: &S,
    touching: &UnilateralState,
    now: &Point<S::Vector>,
    (closed, stopped): (&[bool], &[bool]),
) -> Vec<bool> {
    let place = (now.t, &now.q, &now.v);
    let mut resting = touching.resting(system, place, closed);
    if stopped.contains(&true) {
        let stopping = touching.stopping_with(system, place, stopped);
        for (k, stops) in stopping.into_iter().enumerate() {
            resting[k] |= stops && closed[k];
        }
    }
    for (k, resting) in resting.iter_mut().enumerate() {
        *resting |= stopped[k] || touching.modes()[k] == Mode::Sticks;
    }
    resting
}

/// Projects a state onto the closed contacts and the constraints; returns the state of these constraints.
pub(in crate::stepper) fn project_onto_closed_contacts<S: System>(
    system: &S,
    touching: &UnilateralState,
    now: &mut Point<S::Vector>,
) -> Result<Option<Constraints<S::Vector>>, StepError> {
    let constrained = touching.machine(system);
    if constrained.constraints().len() == 0 {
        return Ok(None);
    }
    let mut constraints = Constraints::new(&constrained, &now.q, &now.v);
    let as_found = now.q.clone();
    // The rates of contacts that close are known to the round-off of those with which they closed, however small they are now.
    let first = system.constraints().len();
    for (place, rate) in touching.rates_of_held().enumerate() {
        constraints.record_rate(first + place, rate);
    }
    let begun = constraints.begin(&constrained, &mut now.place(), None);
    begun.map_err(|error| touching.explain(system, error))?;
    touching.check_displacement(system, now.t, (&as_found, &now.q), &now.v)?;
    // Contacts that share a load stay dependent for as long as they are closed.
    constraints.at_fork = false;
    Ok(Some(constraints))
}
