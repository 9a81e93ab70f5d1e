//! Events: instants at which a function of the state changes its sign.

use std::boxed::Box;
use std::string::String;
use std::vec::Vec;

use crate::piece::Piece;
use crate::run::made;
use crate::stepper::{InputLaw, Stepper};
use crate::{Alongside, Coordinates, Error, Machine, State, System};

/// Where in a step the sign is looked at: events that come and go between two of these are missed.
pub(crate) const LOOKS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// Which changes of sign count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// From below zero to above.
    Rising,
    /// From above zero to below.
    Falling,
    /// Either way.
    Any,
}

/// An event that happened.
#[derive(Clone, Debug, PartialEq)]
pub struct Event<C> {
    /// Which.
    pub name: String,
    /// Which way its function went through zero, forward in time: `Rising` or `Falling`.
    pub crossing: Crossing,
    /// Time and state, to roundoff of time within the dense output of the step.
    pub state: State<C>,
}

/// A function of the state that a user gave.
pub(crate) type OfState<'a, M, T> = Box<dyn FnMut(&State<Coordinates<M>>) -> T + 'a>;

/// An event to watch for.
pub(crate) struct Watch<'a, M: Machine> {
    pub name: String,
    pub crossing: Crossing,
    pub ends_run: bool,
    pub function: OfState<'a, M, f64>,
    /// The sign that the function has had last, 0 from where it was zero.
    pub side: f64,
}

/// A change of sign within the last step.
struct Found {
    watch: usize,
    theta: f64,
    side_before: f64,
}

impl<M: Machine> Watch<'_, M> {
    /// The function's value, which must be a number.
    fn value(&mut self, state: &State<Coordinates<M>>) -> Result<f64, Error> {
        let value = (self.function)(state);
        if value.is_nan() {
            return Err(Error::EventNotFinite {
                event: self.name.clone(),
                t: state.t,
            });
        }
        Ok(value)
    }

    /// Looks at the function at the start of a run.
    pub fn begin(&mut self, state: &State<Coordinates<M>>) -> Result<(), Error> {
        self.side = sign(self.value(state)?);
        Ok(())
    }

    /// Changes of sign between looks at the function, which `value_at` gives at fractions of the
    /// step.
    fn changes(
        &mut self,
        mut value_at: impl FnMut(&mut Self, f64) -> Result<f64, Error>,
        mut found: impl FnMut(&mut Self, f64, f64) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let mut side = self.side;
        let mut theta_before = 0.0;
        for theta in LOOKS {
            let now = sign(value_at(self, theta)?);
            if side != 0.0 && now != side {
                self.side = side;
                found(self, theta_before, theta)?;
            }
            side = now;
            theta_before = theta;
        }
        self.side = side;
        Ok(())
    }
}

/// Adds the events of the last step to `events`, in the order in which they happened. If one of
/// them ends the run, it is the last, and the answer is true.
pub(crate) fn find<M: Machine, L: InputLaw<M::System>, A: Alongside<M::System>>(
    watches: &mut [Watch<'_, M>],
    system: &M::System,
    stepper: &mut Stepper<'_, M::System, L, A>,
    piece: &mut Option<Piece<<M::System as System>::Vector>>,
    events: &mut Vec<Event<Coordinates<M>>>,
) -> Result<bool, Error> {
    let mut found = Vec::new();
    for (index, watch) in watches.iter_mut().enumerate() {
        let side = watch.side;
        let mut suspected = false;
        let look = |watch: &mut Watch<'_, M>, theta: f64| {
            watch.value(&state(system, glance_at(stepper, theta)))
        };
        watch.changes(look, |_, _, _| {
            suspected = true;
            Ok(())
        })?;
        if !suspected {
            continue;
        }

        // There may be something: look again, exactly.
        watch.side = side;
        let piece = made(piece, stepper, system)?;
        let exact = |watch: &mut Watch<'_, M>, theta: f64| {
            watch.value(&state(system, state_at(system, stepper, piece, theta)?))
        };
        watch.changes(exact, |watch, from, to| {
            let side_before = watch.side;
            let theta = root([from, to], theta_roundoff(stepper), |theta| {
                exact(watch, theta)
            })?;
            found.push(Found {
                watch: index,
                theta,
                side_before,
            });
            Ok(())
        })?;
    }
    found.sort_by(|one, other| one.theta.total_cmp(&other.theta));

    let forward = stepper.t() > stepper.t_before();
    for Found {
        watch: index,
        theta,
        side_before,
    } in found
    {
        let watch = &watches[index];
        let crossing = if (side_before < 0.0) == forward {
            Crossing::Rising
        } else {
            Crossing::Falling
        };
        if watch.crossing != Crossing::Any && watch.crossing != crossing {
            continue;
        }
        let Some(piece) = piece else { continue };
        let state = state(system, state_at(system, stepper, piece, theta)?);
        events.push(Event {
            name: watch.name.clone(),
            crossing,
            state,
        });
        if watch.ends_run {
            return Ok(true);
        }
    }
    Ok(false)
}

pub(crate) type Triple<V> = (f64, V, V);

/// Time and state at a fraction of the last step, good enough to see an event.
pub(crate) fn glance_at<S: System, L: InputLaw<S>, A: Alongside<S>>(
    stepper: &Stepper<'_, S, L, A>,
    theta: f64,
) -> Triple<S::Vector> {
    if theta == 1.0 {
        return (stepper.t(), stepper.q().clone(), stepper.v().clone());
    }
    let (q, v) = stepper.glance(theta);
    (stepper.t_before() + theta * stepper.last_step(), q, v)
}

/// Time and state at a fraction of the last step, on the constraints.
pub(crate) fn state_at<S: System, L: InputLaw<S>, A: Alongside<S>>(
    system: &S,
    stepper: &Stepper<'_, S, L, A>,
    piece: &Piece<S::Vector>,
    theta: f64,
) -> Result<Triple<S::Vector>, Error> {
    if theta == 1.0 {
        return Ok((stepper.t(), stepper.q().clone(), stepper.v().clone()));
    }
    let (t, (mut q, mut v)) = (piece.time_at(theta), piece.state_at(theta));
    stepper
        .bring(t, &mut q, &mut v)
        .map_err(|error| Error::of_step(error, system))?;
    Ok((t, q, v))
}

pub(crate) fn state<S: System>(system: &S, (t, q, v): Triple<S::Vector>) -> State<S::Coordinates> {
    State {
        t,
        q: system.to_coordinates(&q),
        v: system.to_coordinates(&v),
    }
}

/// The roundoff of time, as a fraction of the last step.
pub(crate) fn theta_roundoff<S: System, L: InputLaw<S>, A: Alongside<S>>(
    stepper: &Stepper<'_, S, L, A>,
) -> f64 {
    let (from, to) = (stepper.t_before(), stepper.t());
    f64::EPSILON * (from.abs().max(to.abs()) / (to - from).abs()).max(1.0)
}

/// A zero of a function that has opposite signs, or is zero, at both ends, to within `roundoff`.
///
/// T. R. Chandrupatla, *A new hybrid quadratic/bisection algorithm for finding the zero of a
/// nonlinear function without using derivatives*, Adv. Eng. Software 28 (1997) 145–149: inverse
/// quadratic interpolation where that is safe, else bisection.
pub(crate) fn root(
    [mut a, mut b]: [f64; 2],
    roundoff: f64,
    mut f: impl FnMut(f64) -> Result<f64, Error>,
) -> Result<f64, Error> {
    let (mut f_a, mut f_b) = (f(a)?, f(b)?);
    // The newest point and the one on the other side are `b` and `a`; `c` was there before.
    let mut fraction = 0.5_f64;
    loop {
        if f_a == 0.0 {
            return Ok(a);
        }
        let nearest = if f_a.abs() < f_b.abs() { a } else { b };
        let tolerance = (roundoff / (b - a).abs()).min(0.5);
        if f_b == 0.0 || tolerance >= 0.5 || !(b - a).is_normal() {
            return Ok(if f_b == 0.0 { b } else { nearest });
        }
        let x = a + fraction.clamp(tolerance, 1.0 - tolerance) * (b - a);
        let f_x = f(x)?;
        let (c, f_c);
        if (f_x > 0.0) == (f_a > 0.0) {
            (c, f_c) = (a, f_a);
        } else {
            (c, f_c) = (b, f_b);
            (b, f_b) = (a, f_a);
        }
        (a, f_a) = (x, f_x);

        let xi = (a - b) / (c - b);
        let phi = (f_a - f_b) / (f_c - f_b);
        let safe = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
        fraction = if safe {
            f_a / (f_b - f_a) * f_c / (f_b - f_c)
                + (c - a) / (b - a) * f_a / (f_c - f_a) * f_b / (f_c - f_b)
        } else {
            0.5
        };
    }
}

fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}
