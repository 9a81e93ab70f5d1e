//! Derivatives across changes of contacts in which only accelerations jump.

use lagrangian::interpreted::Named;
use lagrangian::{ContactMode, PhaseCause, State};
use lagrangian_scalar::Dual;

use super::{Change, NoDerivatives, Number, Passing};
use crate::varied::{DualState, Phase};

/// Accelerations before and after a change that agree to this fraction are continuous, as far as a run of the usual
/// tolerance can resolve.
const GOES_ON: f64 = 1e-6;

/// An instant at which accelerations jump without an impact.
struct Instant<'i> {
    t: f64,
    cause: PhaseCause,
    /// The contact that changes.
    contact: usize,
    before: &'i Phase,
    a_before: &'i [f64],
}

impl Passing<'_, '_> {
    /// Carries the derivatives across a change without an impact, in which only accelerations jump.
    pub(super) fn cross_without_impact(
        &self,
        change: Change<'_>,
        state: &mut State<Vec<f64>>,
        here: &State<Named>,
    ) -> Result<(), NoDerivatives> {
        let Some(contact) = self.changing_contact(&change)? else {
            self.put_values(state, here);
            return Ok(());
        };
        let Change {
            t,
            before,
            after,
            cause,
            ..
        } = change;
        let shared = || {
            self.broken(
                t,
                contact,
                "shares its load with others, and the shares are not unique",
            )
        };
        let a_before = self.accelerations(state, before).ok_or_else(shared)?;
        self.put_values(state, here);
        // Where a layer begins to unload by itself its depth is at a maximum, so a shift of the instant does not
        // change it to first order.
        let still = |direction| self.moved(state, direction, 0.0, &vec![0.0; self.n]);
        let places: Vec<Vec<Number>> = (0..self.directions).map(still).collect();
        self.load_layers(after, &places);
        let a_after = self.accelerations(state, after).ok_or_else(shared)?;
        let jump = a_before.iter().zip(&a_after).map(|(a, b)| (a - b).abs());
        let jump = jump.fold(0.0, f64::max);
        let size = (a_before.iter().chain(&a_after)).fold(0.0_f64, |most, a| most.max(a.abs()));
        if jump <= GOES_ON * size {
            return Ok(());
        }
        let instant = Instant {
            t,
            cause,
            contact,
            before,
            a_before: &a_before,
        };
        let shifts = self.shifts(&instant, after, state)?;
        for (direction, by) in shifts.into_iter().enumerate() {
            let part = (direction + 1) * self.n;
            for i in 0..self.n {
                state.v[part + i] += (a_before[i] - a_after[i]) * by;
            }
        }
        Ok(())
    }

    /// The contact whose change this is; `None` if nothing changes.
    ///
    /// # Errors
    /// If the instant of the change has no derivative.
    fn changing_contact(&self, change: &Change<'_>) -> Result<Option<usize>, NoDerivatives> {
        let (before, after) = (change.before, &*change.after);
        let first = (0..before.modes.len()).find(|k| before.modes[*k] != after.modes[*k]);
        let contact = match change.cause {
            PhaseCause::Lifts(k)
            | PhaseCause::Stops(k)
            | PhaseCause::Breaks(k)
            | PhaseCause::Presses(k)
            | PhaseCause::Switches(k)
            | PhaseCause::Turns(k) => k,
            PhaseCause::Stepped => {
                return Err(self.broken(
                    change.t,
                    first.unwrap_or(0),
                    "was continued by time stepping, which does not locate instants",
                ));
            }
            _ => match first {
                Some(k) => k,
                None => return Ok(None),
            },
        };
        let grazes = before.modes[contact] == ContactMode::Open
            && after.is_closed(contact)
            && after.compliances[after.presses(contact)].is_none();
        if grazes {
            return Err(self.broken(change.t, contact, "closes with zero speed"));
        }
        Ok(Some(contact))
    }

    /// The derivative in each direction of the instant at which forces jump.
    fn shifts(
        &self,
        instant: &Instant<'_>,
        after: &Phase,
        state: &State<Vec<f64>>,
    ) -> Result<Vec<f64>, NoDerivatives> {
        let &Instant {
            cause,
            contact,
            before,
            ..
        } = instant;
        let broken = |contact: usize, why| self.broken(instant.t, contact, why);
        if cause == PhaseCause::Asked {
            return Err(broken(
                contact,
                "changes where forces jump, from an unknown cause",
            ));
        }
        if matches!(cause, PhaseCause::Breaks(_) | PhaseCause::Lifts(_))
            && !self.wanted.signals.is_empty()
        {
            return Err(broken(
                contact,
                "changes where forces jump, by a force that depends on a driven input",
            ));
        }
        // Several slips that stop at the same instant count as one event only if they always stop together.
        let stops = |k: &usize| match (before.modes[*k], after.modes[*k]) {
            (ContactMode::Slides(from), ContactMode::Sticks) => from != 0.0,
            (ContactMode::Slides(from), ContactMode::Slides(to)) => from != to && from != 0.0,
            _ => false,
        };
        let others = (0..before.modes.len()).filter(stops);
        let others: Vec<usize> = others.filter(|k| *k != contact).collect();
        let mut shifts = Vec::new();
        for direction in 0..self.directions {
            let shift = |contact| self.shift(instant, contact, state, direction);
            let by = shift(contact).filter(|by| by.is_finite()).ok_or_else(|| {
                broken(
                    contact,
                    "changes at an instant whose derivative is infinite",
                )
            })?;
            for &other in &others {
                let together = shift(other).is_some_and(|of_other| {
                    (of_other - by).abs() <= 1e-6 * (by.abs() + of_other.abs())
                });
                if !together {
                    return Err(broken(
                        other,
                        "happens to stop slipping at the same instant as another",
                    ));
                }
            }
            shifts.push(by);
        }
        Ok(shifts)
    }

    /// δt in a direction, eq. (E66), if this contact triggers the change.
    fn shift(
        &self,
        instant: &Instant<'_>,
        contact: usize,
        state: &State<Vec<f64>>,
        direction: usize,
    ) -> Option<f64> {
        let margin = |by: f64| {
            let there = self.moved(state, direction, by, instant.a_before);
            self.place(there, direction, instant.before, |place| {
                self.margin(place, (instant.before, instant.cause), contact, direction)
            })
        };
        // The derivative along the motion, ḣ, is the change of the margin with a shift of the instant.
        let changes = margin(0.0)?.derivative;
        let with_time = margin(1.0)?.derivative;
        Some(-changes / (with_time - changes))
    }

    /// The function whose zero triggers a change of a contact.
    fn margin(
        &self,
        place: &mut DualState<'_>,
        (before, cause): (&Phase, PhaseCause),
        contact: usize,
        direction: usize,
    ) -> Option<Number> {
        match cause {
            PhaseCause::Presses(_) => Some(place.gaps[contact]),
            PhaseCause::Lifts(_) | PhaseCause::Breaks(_) => {
                let [.., most] = place.coefficients(contact);
                let reaction = place.reaction(before, direction).ok()?;
                let [normal, tangential] = reaction.forces[contact];
                let normal = if before.rolls[contact] {
                    reaction.forces[contact - 1][0]
                } else {
                    normal
                };
                let side = before
                    .guide(contact)
                    .map_or(1.0, |guide| before.sides[guide]);
                let normal = Dual::constant(side) * normal;
                match cause {
                    PhaseCause::Lifts(_) => Some(normal),
                    _ => {
                        let sign = Dual::constant(tangential.value.signum());
                        Some(most * normal - sign * tangential)
                    }
                }
            }
            PhaseCause::Switches(_) => {
                let reaction = place.reaction(before, direction).ok()?;
                Some(reaction.forces[contact][0])
            }
            _ => Some(place.rates[2 * contact + 1]),
        }
    }
}
