//! Unilateral contacts close, open, stick and slip at the end of a step.

use std::vec;
use std::vec::Vec;

use super::{Model, Stepper};
use crate::balance::Quadratures;
use crate::constraints::Constraints;
use crate::contact::{ContactTrouble, Impact, Mode, Touching};
use crate::inputs::InputLaw;
use crate::stages::Point;
use crate::{StepError, System, Vector};

/// How many impacts may follow each other at one instant.
const MOST_IMPACTS_AT_ONCE: usize = 100;

/// A step is no longer than so many of the flight that follows: it is to be seen in it.
const FLIGHTS: f64 = 8.0;

/// Why contacts are asked what they do next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Cause {
    /// A gap has closed, or nothing is known but that something changes.
    Asked,
    /// The force of a contact has vanished.
    Lifts(usize),
    /// The slip of a contact has stopped.
    Stops(usize),
    /// The friction of a contact is used up.
    Breaks(usize),
}

/// What happened at an instant.
#[derive(Clone, Debug, Default)]
pub(crate) struct Happened {
    pub impacts: Vec<Impact>,
    /// What contacts did before, and what they do now.
    pub before: Vec<Mode>,
    pub after: Vec<Mode>,
    /// Contacts whose bounces came to their end, with how long these would have gone on, in s.
    pub ended: Vec<(usize, f64)>,
    /// What was lost in impacts that no impulse tells: the last bounces, in J.
    pub lost_at_end: f64,
    /// The length of the flight that follows, if there is one and it is known.
    flight: Option<f64>,
}

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// What is known of the unilateral contacts.
    pub(crate) fn touching(&self) -> &Option<Touching> {
        &self.model.touching
    }

    /// Lets contacts that touch meet, and goes on to `end` with whatever then is closed.
    pub(crate) fn meet(
        &mut self,
        cause: Cause,
        end: f64,
        step: f64,
    ) -> Result<Happened, StepError> {
        let Self { model, now, .. } = self;
        let mut happened = Happened::default();
        let energy = |model: &Model<'_, S, L>, now: &Point<S::Vector>| {
            model.system.kinetic_energy(now.t, &now.q, &now.v)
        };
        let (t, energy_before) = (now.t, energy(model, now));
        let Some(mut touching) = model.touching.clone() else {
            return Ok(happened);
        };
        happened.before = touching.modes().to_vec();
        model.set_inputs(t, &now.q, &now.v);
        let known = match cause {
            Cause::Lifts(k) => Some((k, Mode::Open)),
            Cause::Breaks(k) => {
                let at = (t, &now.q, &now.v, &model.inputs);
                let friction = touching.reaction(model.system.get(), at)?.forces[k][1];
                Some((k, Mode::Slides(-friction.signum())))
            }
            Cause::Asked | Cause::Stops(_) => None,
        };
        let stops = |k: usize| cause == Cause::Stops(k);

        let (mut touches, _) = touching.near(model.system.get(), t, &now.q, &now.v);
        for round in 0.. {
            let (near, closes) = touching.near(model.system.get(), t, &now.q, &now.v);
            touches = near;
            let Some(contact) = closes.iter().position(|closes| *closes) else {
                break;
            };
            if round == MOST_IMPACTS_AT_ONCE {
                let trouble = ContactTrouble::Unsettled;
                return Err(StepError::Contact {
                    contact,
                    trouble,
                    t,
                });
            }
            let impacts = touching.impact(model.system.get(), t, &now.q, &mut now.v, &touches)?;
            now.v_low.as_mut_slice().fill(0.0);
            happened.impacts.extend(impacts);
        }
        let told: f64 = happened.impacts.iter().map(|impact| impact.loss).sum();
        let energy_after = energy(model, now);

        model.set_inputs(t, &now.q, &now.v);
        let mut closed = touching.lasting(model.system.get(), t, &now.q, &now.v, &touches);
        let mut free = now.v.zeros_like();
        if !happened.impacts.is_empty() {
            // What the machine does with all open that has been hit: how long the next flight is.
            let mut flying = touching.clone();
            let modes = (closed.iter().zip(touching.modes()))
                .map(|(closed, mode)| if *closed { *mode } else { Mode::Open })
                .collect();
            flying.set_modes(modes);
            flying.accelerations(
                model.system.get(),
                (t, &now.q, &now.v, &model.inputs),
                &mut free,
            )?;
        }
        let mut hit: Vec<usize> = happened.impacts.iter().map(|i| i.contact).collect();
        hit.sort_unstable();
        hit.dedup();
        for contact in hit.into_iter().filter(|k| !closed[*k]).collect::<Vec<_>>() {
            let place = (t, &now.q, &now.v);
            let falls = Touching::falls(model.system.get(), place, contact, free.as_slice());
            if let Some(left) = touching.ends_bouncing(model.system.get(), place, contact, falls) {
                closed[contact] = true;
                happened.ended.push((contact, left));
            } else if falls < 0.0 {
                let rate = touching.openings[contact];
                let flight = 2.0 * rate / -falls;
                happened.flight = Some(happened.flight.map_or(flight, |known| known.min(flight)));
            }
        }

        // A slip that has stopped is at rest, and so is what was closed at last.
        let mut held = vec![Mode::Open; closed.len()];
        for (k, _) in closed.iter().enumerate().filter(|(_, closed)| **closed) {
            held[k] = match touching.modes()[k] {
                _ if stops(k) => Mode::Sticks,
                Mode::Open => Mode::Slides(0.0),
                mode => mode,
            };
        }
        touching.set_modes(held);
        hold(model.system.get(), &touching, now)?;
        let mut resting = touching.resting(model.system.get(), t, &now.q, &now.v);
        for (k, resting) in resting.iter_mut().enumerate() {
            *resting |= stops(k) || touching.modes()[k] == Mode::Sticks;
        }
        let modes = touching.settled(
            model.system.get(),
            (t, &now.q, &now.v, &model.inputs),
            &closed,
            &resting,
            known,
        )?;
        touching.set_modes(modes);
        model.constraints = hold(model.system.get(), &touching, now)?;
        happened.after = touching.modes().to_vec();
        model.touching = Some(touching);

        if !happened.ended.is_empty() {
            happened.lost_at_end = energy_after - energy(model, now);
        }
        let lost = told + happened.lost_at_end;
        // What impulses do beyond losses is work of what moves by itself.
        let gained = energy(model, now) - energy_before;
        if !happened.impacts.is_empty() {
            self.quadratures.add_at_once(gained + lost, lost);
        }
        self.begin_again(end, step, happened.flight)?;
        Ok(happened)
    }

    /// Goes on with the accelerations of now.
    fn begin_again(&mut self, end: f64, step: f64, flight: Option<f64>) -> Result<(), StepError> {
        let Self { model, now, k, .. } = self;
        let newest = self.newest;
        model.accelerations(now.t, &now.q, &now.v, &mut k[newest], &mut self.work)?;
        model.take_rates(
            &mut self.quadratures,
            0,
            (now.t, &now.q, &now.v, &k[newest]),
        );
        self.end = end;
        self.step = match flight {
            Some(flight) if flight > 0.0 => step.min(FLIGHTS * flight),
            _ => step,
        };
        self.error_before = 1e-4;
        if let Some(implicit) = &mut self.implicit {
            implicit.forget();
        }
        Ok(())
    }
}

impl<S: System, L: InputLaw<S>> Model<'_, S, L> {
    /// Takes note of the end of a step.
    pub(super) fn accept_contacts(&mut self, now: &Point<S::Vector>) {
        let Some(touching) = &self.touching else {
            return;
        };
        if let Some(constraints) = &mut self.constraints {
            constraints.accept(&now.q, &now.v);
            if constraints.redundant {
                // Where that fails, the rows of before will do, or the next step will say why not.
                let held = touching.machine(self.system.get());
                let _ = constraints.choose_again(&held, now.t, &now.q);
            }
        }
    }
}

/// Brings a state onto what is held; what is known of these constraints.
fn hold<S: System>(
    system: &S,
    touching: &Touching,
    now: &mut Point<S::Vector>,
) -> Result<Option<Constraints<S::Vector>>, StepError> {
    let held = touching.machine(system);
    if held.constraints().len() == 0 {
        return Ok(None);
    }
    let mut constraints = Constraints::new(&held, &now.q, &now.v);
    constraints.begin(&held, &mut now.place(), None)?;
    // Contacts that share a load depend on each other for as long as they last.
    constraints.at_fork = false;
    Ok(Some(constraints))
}
