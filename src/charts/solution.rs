//! Runs in Cartesian coordinates that are shown in polar ones.

use core::fmt::{self, Debug};
use std::sync::{Arc, Mutex, PoisonError};
use std::vec::Vec;

use super::{Charted, Turns, to_cartesian};
use crate::callbacks::Shared;
use crate::inputs::InputLaw;
use crate::names::rate_name;
use crate::settings::Subject;
use crate::solution::Solution;
use crate::stepper::in_lanes::WIDTH;
use crate::{
    Batched, ContactEvent, Coordinates, Error, Event, Machine, Simulation, State, StepMotion,
    System, Vector,
};

/// The result of a run that was made in Cartesian coordinates, in the polar ones of the description.
///
/// Everything else about it, its energies, outputs, warnings and cost, is that of the run in Cartesian coordinates,
/// [`cartesian`](Self::cartesian).
pub struct ChartedSolution<M: Charted, L> {
    system: M::System,
    run: Solution<M::Cartesian, L>,
    turns: Turns,
    start: Option<Start<M>>,
}

/// The start of a run as it was given, and in Cartesian coordinates, if polar ones have a meaning there.
type Start<M> = (
    State<Coordinates<M>>,
    State<VectorOf<<M as Charted>::Cartesian>>,
);

/// A run as far as it went, with the error that ended it early, if any; or an error if it could not begin.
type RunAsFarInCharts<M, L> = Result<(ChartedSolution<M, L>, Option<Error>), Error>;

/// What is known of a run in Cartesian coordinates before it is made.
struct Begun<M: Charted> {
    system: M::System,
    turns: Arc<Mutex<Turns>>,
    start: Option<Start<M>>,
}

impl<M: Charted> Begun<M> {
    fn solution<L>(self, run: Solution<M::Cartesian, L>) -> ChartedSolution<M, L> {
        let turns = self.turns.lock().unwrap_or_else(PoisonError::into_inner);
        ChartedSolution {
            turns: turns.clone(),
            system: self.system,
            start: self.start,
            run,
        }
    }
}

type VectorOf<M> = <<M as Machine>::System as System>::Vector;

impl<'a, C: Machine, L: InputLaw<C::System>> Simulation<'a, C, L> {
    /// Runs a machine in the Cartesian coordinates that its description names beside polar ones, from a start in the polar ones, and shows
    /// the run in these: a point may pass the centre or rest there. The simulation is that of the machine
    /// [in Cartesian coordinates](Charted::in_cartesian), and so are the states that events, inputs and observers see.
    ///
    /// A distance of the run is not negative. An angle is continuous, with all its turns, and jumps by π where the path goes exactly through
    /// the centre.
    ///
    /// # Errors
    /// Those of [`run`](Self::run), and if a distance is negative at the start.
    ///
    /// ```
    /// use lagrangian::{Charted, Machine, Simulation};
    ///
    /// lagrangian::machine! {
    ///     /// A free particle.
    ///     machine Particle in plane {
    ///         parameters { m: kg = 2 }
    ///         coordinates { s: m = 1, phi: rad, der(s): m/s = -1, der(phi): rad/s = 0.125 }
    ///         bodies { particle { mass: m, at: polar(s, phi) } }
    ///         gravity none;
    ///         charts { particle: polar(s, phi) | cartesian(x, y) }
    ///     }
    /// }
    ///
    /// fn main() -> Result<(), lagrangian::Error> {
    ///     let particle = Particle::default();
    ///     let cartesian = particle.in_cartesian();
    ///     let run = Simulation::new(&cartesian).until(2.0).run_in_charts(&particle, particle.start())?;
    ///     // It moves on the straight line x = 1 − t, y = t/8, and passes the centre at a distance of 0.12 m.
    ///     let state = run.at(1.5)?;
    ///     let (x, y) = (-0.5_f64, 0.1875_f64);
    ///     assert!((state.q.s - x.hypot(y)).abs() < 1e-12);
    ///     assert!((state.q.phi - y.atan2(x)).abs() < 1e-12);
    ///     Ok(())
    /// }
    /// ```
    pub fn run_in_charts<M: Charted<Cartesian = C>>(
        self,
        machine: &M,
        start: State<Coordinates<M>>,
    ) -> Result<ChartedSolution<M, L>, Error> {
        match self.run_in_charts_as_far_as_possible(machine, start)? {
            (_, Some(error)) => Err(error),
            (solution, None) => Ok(solution),
        }
    }

    /// [`run_in_charts`](Self::run_in_charts) that returns the run so far even if an error ends it early.
    ///
    /// # Errors
    /// Only if the run could not begin.
    pub fn run_in_charts_as_far_as_possible<M: Charted<Cartesian = C>>(
        mut self,
        machine: &M,
        start: State<Coordinates<M>>,
    ) -> RunAsFarInCharts<M, L> {
        let (charts, begun) = self.begin_in_charts(machine, start)?;
        let (run, error) = self.run_as_far_as_possible(begun)?;
        Ok((charts.solution(run), error))
    }

    /// Makes many runs like [`run_in_charts_as_far_as_possible`](Self::run_in_charts_as_far_as_possible), together in lanes like
    /// [`run_in_lanes`](Self::run_in_lanes). Returns the results in the order of the runs.
    pub fn run_in_charts_and_lanes<M: Charted<Cartesian = C>>(
        runs: Vec<(Self, &M, State<Coordinates<M>>)>,
    ) -> Vec<RunAsFarInCharts<M, L>>
    where
        C: Machine<System: Batched<WIDTH>>,
    {
        let (mut begun, mut simulations) = (Vec::new(), Vec::new());
        for (mut simulation, machine, start) in runs {
            begun.push(
                simulation
                    .begin_in_charts(machine, start)
                    .map(|(charts, start)| {
                        simulations.push((simulation, start));
                        charts
                    }),
            );
        }
        let mut made = Self::run_in_lanes(simulations).into_iter();
        let solution = |charts: Result<Begun<M>, Error>| {
            let charts = charts?;
            // There is one for each run that could begin.
            let (run, error) = made.next().unwrap_or(Err(Error::NoEnd))?;
            Ok((charts.solution(run), error))
        };
        begun.into_iter().map(solution).collect()
    }

    /// Prepares a run in Cartesian coordinates, and returns its start in these.
    fn begin_in_charts<M: Charted<Cartesian = C>>(
        &mut self,
        machine: &M,
        start: State<Coordinates<M>>,
    ) -> Result<(Begun<M>, State<Coordinates<C>>), Error> {
        let (system, points) = (machine.prepare(), machine.points());
        let (q, v) = (system.to_vector(&start.q), system.to_vector(&start.v));
        check_start(&system, points, [&q, &v])?;
        if let Subject::Machine(cartesian) = &self.subject {
            check_parameters(*cartesian, machine)?;
        }
        // Only its names are used, which depend on no parameter.
        let of_names = machine.in_cartesian().prepare();
        let n = q.as_slice().len();
        let [mut to_q, mut to_v] = [(); 2].map(|()| VectorOf::<C>::zeros(n));
        to_q.as_mut_slice().copy_from_slice(q.as_slice());
        to_v.as_mut_slice().copy_from_slice(v.as_slice());
        to_cartesian(points, to_q.as_mut_slice(), to_v.as_mut_slice());
        let turns = Turns::begin(points, start.t, q.as_slice());
        let turns = Arc::new(Mutex::new(turns));
        self.follow(
            Arc::clone(&turns),
            of_names.unilateral_contacts().len() != 0,
        );
        let begun = State {
            t: start.t,
            q: of_names.to_coordinates(&to_q),
            v: of_names.to_coordinates(&to_v),
        };
        let is_stated = points.iter().all(|[s, _]| q.as_slice()[*s] > 0.0);
        let in_cartesian = State {
            t: start.t,
            q: to_q,
            v: to_v,
        };
        let charts = Begun {
            start: is_stated.then_some((start, in_cartesian)),
            system,
            turns,
        };
        Ok((charts, begun))
    }

    /// Follows the angles through every step, besides an observer of steps that there may be.
    fn follow(&mut self, turns: Arc<Mutex<Turns>>, may_collide: bool) {
        let settings = &self.settings;
        let has_events =
            !self.callbacks.watches.is_empty() || (may_collide && settings.keep_contact_events);
        let interval = if settings.keep_steps || has_events {
            0.0
        } else {
            settings.every.unwrap_or(f64::INFINITY)
        };
        let other = self.callbacks.observer.take();
        let observer = move |step: &mut dyn StepMotion<C>| {
            let mut turns = turns.lock().unwrap_or_else(PoisonError::into_inner);
            turns.follow(step, interval)?;
            match &other {
                Some(other) => (other.lock())(step),
                None => Ok(()),
            }
        };
        self.callbacks.observer = Some(Shared::new(std::boxed::Box::new(observer)));
    }
}

/// Checks that two machines have the same parameters. Those that are not finite are refused when the run begins.
fn check_parameters<C: Machine, M: Machine>(cartesian: &C, machine: &M) -> Result<(), Error> {
    let mut pairs = cartesian.parameters().zip(machine.parameters());
    let differs = pairs.find(|((_, value), (_, other))| value != other && !value.is_nan());
    match differs {
        None => Ok(()),
        Some(((of, value), (_, other))) => Err(Error::OtherParameters {
            parameter: of.name.into(),
            value,
            other,
        }),
    }
}

/// Checks that polar coordinates can be replaced by Cartesian ones at the start.
fn check_start<S: System>(
    system: &S,
    points: &[[usize; 2]],
    [q, v]: [&S::Vector; 2],
) -> Result<(), Error> {
    let name = |index: usize| {
        let coordinate = system.coordinates().nth(index);
        coordinate.map_or("?", |coordinate| coordinate.name)
    };
    for &[s, phi] in points {
        for place in [s, phi] {
            let (value, rate) = (q.as_slice()[place], v.as_slice()[place]);
            if !value.is_finite() {
                let name = name(place).into();
                return Err(Error::StartNotFinite { name, value });
            }
            if !rate.is_finite() {
                let (name, value) = (rate_name(name(place)), rate);
                return Err(Error::StartNotFinite { name, value });
            }
        }
        let value = q.as_slice()[s];
        if value < 0.0 {
            return Err(Error::NegativeDistance {
                distance: name(s).into(),
                value,
                angle: name(phi).into(),
            });
        }
    }
    Ok(())
}

impl<M: Charted, L> Debug for ChartedSolution<M, L> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ChartedSolution")
            .field("start", &self.start())
            .field("end", &self.end())
            .field("cartesian", &self.run)
            .finish_non_exhaustive()
    }
}

impl<M: Charted, L> ChartedSolution<M, L> {
    /// The run in Cartesian coordinates.
    pub fn cartesian(&self) -> &Solution<M::Cartesian, L> {
        &self.run
    }

    /// The state at the beginning.
    pub fn start(&self) -> State<Coordinates<M>> {
        self.shown(self.run.start())
    }

    /// The state at the end.
    pub fn end(&self) -> State<Coordinates<M>> {
        self.shown(self.run.end())
    }

    /// The states requested by `every` of the simulation.
    pub fn samples(&self) -> impl ExactSizeIterator<Item = State<Coordinates<M>>> {
        self.run.samples().iter().map(|state| self.shown(state))
    }

    /// The states at the beginning and at the end of every step; empty if the steps were forgotten.
    pub fn steps(&self) -> impl Iterator<Item = State<Coordinates<M>>> {
        self.run.steps().map(|state| self.shown(&state))
    }

    /// The events, in order.
    pub fn events(&self) -> impl ExactSizeIterator<Item = Event<Coordinates<M>>> {
        self.run.events().iter().map(|event| Event {
            name: event.name.clone(),
            crossing: event.crossing,
            state: self.shown(&event.state),
        })
    }

    /// The events of the unilateral contacts, in order.
    pub fn contact_events(&self) -> impl ExactSizeIterator<Item = ContactEvent<Coordinates<M>>> {
        self.run.contact_events().iter().map(|event| ContactEvent {
            contact: event.contact.clone(),
            kind: event.kind,
            state: self.shown(&event.state),
            direction: event.direction,
            across: event.across,
            time_error: event.time_error,
            impact: event.impact,
        })
    }

    /// A state of the run in Cartesian coordinates, in polar ones. At the centre itself, where these have no other value, the angle is that
    /// of the last direction, the rate of the distance is the speed, and that of the angle is 0.
    pub fn shown(&self, state: &State<Coordinates<M::Cartesian>>) -> State<Coordinates<M>> {
        let of_run = self.run.system();
        let (q, v) = (of_run.to_vector(&state.q), of_run.to_vector(&state.v));
        if let Some((stated, begun)) = &self.start
            && begun.t == state.t
            && begun.q == q
            && begun.v == v
        {
            return stated.clone();
        }
        let n = q.as_slice().len();
        let [mut to_q, mut to_v] = [(); 2].map(|()| VectorOf::<M>::zeros(n));
        to_q.as_mut_slice().copy_from_slice(q.as_slice());
        to_v.as_mut_slice().copy_from_slice(v.as_slice());
        self.turns
            .to_polar(state.t, to_q.as_mut_slice(), to_v.as_mut_slice());
        State {
            t: state.t,
            q: self.system.to_coordinates(&to_q),
            v: self.system.to_coordinates(&to_v),
        }
    }
}

impl<M: Charted, L: InputLaw<<M::Cartesian as Machine>::System>> ChartedSolution<M, L> {
    /// The state at time `t`, from the beginning of the run to its end.
    ///
    /// # Errors
    /// Those of [`Solution::at`].
    pub fn at(&self, t: f64) -> Result<State<Coordinates<M>>, Error> {
        self.run.at(t).map(|state| self.shown(&state))
    }

    /// The states at several times; cheapest if the times are sorted.
    ///
    /// # Errors
    /// Those of [`Solution::at_each`].
    pub fn at_each(
        &self,
        times: impl IntoIterator<Item = f64>,
    ) -> Result<Vec<State<Coordinates<M>>>, Error> {
        let states = self.run.at_each(times)?;
        Ok(states.iter().map(|state| self.shown(state)).collect())
    }

    /// The states at the beginning, every `interval` seconds after it, and at the end.
    ///
    /// # Errors
    /// Those of [`Solution::every`].
    pub fn every(&self, interval: f64) -> Result<Vec<State<Coordinates<M>>>, Error> {
        let states = self.run.every(interval)?;
        Ok(states.iter().map(|state| self.shown(state)).collect())
    }
}
