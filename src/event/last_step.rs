//! The state at fractions of the last step.

use crate::inputs::InputLaw;
use crate::interpolant::Interpolant;
use crate::roots;
use crate::stepper::Stepper;
use crate::{Error, Quadratures, State, System, Vector};

/// A coordinate that turns by more than this in a step, in rad, may have returned to the same angle between two of the eight points. Functions of the
/// motion are then interpolated to convergence.
const FARTHEST_TURN: f64 = core::f64::consts::PI;

/// With a greater tolerance steps may be too long for eight values to decide.
const LOOSEST: f64 = 1e-3;

/// Time, coordinates and rates.
pub(crate) type Triple<V> = (f64, V, V);

/// Time and state at a fraction of the last step, good enough to see an event.
pub(crate) fn interpolated_at<S: System, L: InputLaw<S>, A: Quadratures<S>>(
    stepper: &Stepper<'_, S, L, A>,
    theta: f64,
) -> Triple<S::Vector> {
    if theta == 1.0 {
        return (stepper.t(), stepper.q().clone(), stepper.v().clone());
    }
    let (q, v) = stepper.hermite(theta);
    (stepper.t_before() + theta * stepper.last_step(), q, v)
}

/// Whether the last step is too long for eight values to decide whether functions of the motion change their sign.
pub(crate) fn is_long<S: System, L: InputLaw<S>, A: Quadratures<S>>(
    system: &S,
    stepper: &Stepper<'_, S, L, A>,
) -> bool {
    stepper.relative_tolerance() > LOOSEST || turn(system, stepper, |_| true) > FARTHEST_TURN
}

/// The greatest angle in rad by which one of these coordinates turned in the last step.
///
/// A body that turns uniformly needs no short steps: it may turn many times in one.
pub(crate) fn turn<S: System, L: InputLaw<S>, A: Quadratures<S>>(
    system: &S,
    stepper: &Stepper<'_, S, L, A>,
    counts: impl Fn(usize) -> bool,
) -> f64 {
    let h = stepper.last_step();
    let of = |vector: &S::Vector, i: usize| vector.as_slice()[i];
    let mut greatest = 0.0_f64;
    for (i, coordinate) in system.coordinates().enumerate() {
        // An angle may be written as a pure number, too.
        if !matches!(coordinate.unit, "rad" | "1") || !counts(i) {
            continue;
        }
        let between = of(stepper.q(), i) - of(stepper.q_before(), i);
        let by_rates = [stepper.v(), stepper.v_before()].map(|v| (h * of(v, i)).abs());
        greatest = greatest
            .max(between.abs())
            .max(by_rates[0])
            .max(by_rates[1]);
    }
    greatest
}

/// Time and state at the [fractions](roots::FRACTIONS) of the last step, good enough to see an event: those of implicit methods on their dense output, since
/// accelerations at the ends of their steps may know of more than the motion.
pub(crate) fn at_fractions<S: System, L: InputLaw<S>, A: Quadratures<S>>(
    system: &S,
    stepper: &mut Stepper<'_, S, L, A>,
    interpolant: &mut Option<Interpolant<S::Vector>>,
) -> Result<[Triple<S::Vector>; roots::FRACTIONS.len()], Error> {
    if stepper.is_implicit() {
        step_motion(interpolant, stepper, system)?;
    }
    let along = interpolant.as_ref().filter(|_| stepper.is_implicit());
    Ok(roots::FRACTIONS.map(|theta| match along {
        _ if theta == 0.0 => {
            let (q, v) = (stepper.q_before().clone(), stepper.v_before().clone());
            (stepper.t_before(), q, v)
        }
        Some(along) if theta != 1.0 => {
            let (q, v) = along.state_at(theta);
            (along.time_at(theta), q, v)
        }
        _ => interpolated_at(stepper, theta),
    }))
}

/// Time and state at a fraction of the last step, on the constraints.
pub(crate) fn state_at<S: System, L: InputLaw<S>, A: Quadratures<S>>(
    system: &S,
    stepper: &Stepper<'_, S, L, A>,
    interpolant: &Interpolant<S::Vector>,
    theta: f64,
) -> Result<Triple<S::Vector>, Error> {
    let (mut q, mut v) = (stepper.q().clone(), stepper.v().clone());
    let t = state_into(system, stepper, interpolant, theta, [&mut q, &mut v])?;
    Ok((t, q, v))
}

/// [`state_at`], into vectors that are there; returns the time.
pub(crate) fn state_into<S: System, L: InputLaw<S>, A: Quadratures<S>>(
    system: &S,
    stepper: &Stepper<'_, S, L, A>,
    interpolant: &Interpolant<S::Vector>,
    theta: f64,
    [q, v]: [&mut S::Vector; 2],
) -> Result<f64, Error> {
    if theta == 1.0 {
        q.clone_from(stepper.q());
        v.clone_from(stepper.v());
        return Ok(stepper.t());
    }
    let t = interpolant.time_at(theta);
    interpolant.state_into(theta, [&mut *q, &mut *v]);
    stepper
        .project(t, q, v)
        .map_err(|error| Error::of_step(error, system))?;
    Ok(t)
}

pub(crate) fn state<S: System>(system: &S, (t, q, v): Triple<S::Vector>) -> State<S::Coordinates> {
    State {
        t,
        q: system.to_coordinates(&q),
        v: system.to_coordinates(&v),
    }
}

/// The roundoff of time, as a fraction of the last step.
pub(crate) fn theta_roundoff<S: System, L: InputLaw<S>, A: Quadratures<S>>(
    stepper: &Stepper<'_, S, L, A>,
) -> f64 {
    let (from, to) = (stepper.t_before(), stepper.t());
    f64::EPSILON * (from.abs().max(to.abs()) / (to - from).abs()).max(1.0)
}

/// The motion within the last step.
pub(crate) fn step_motion<'p, S: System, L: InputLaw<S>, A: Quadratures<S>>(
    interpolant: &'p mut Option<Interpolant<S::Vector>>,
    stepper: &mut Stepper<'_, S, L, A>,
    system: &S,
) -> Result<&'p Interpolant<S::Vector>, Error> {
    match interpolant {
        Some(interpolant) => Ok(interpolant),
        None => {
            let step_motion = stepper
                .interpolant()
                .map_err(|error| Error::of_step(error, system))?;
            Ok(interpolant.insert(step_motion))
        }
    }
}
