//! Many runs of machines of one type, several at a time in the lanes of vector registers.

use lagrangian_native::Lanes;

#[cfg(feature = "std")]
use super::in_series::InSeries;
use super::{Accelerate, Attempt, Outcome, Track, check};
use crate::control::{MAX_STEPS, Work};
use crate::methods::{Method, MethodKind};
use crate::stages::Point;
use crate::step_error::StepError;
use crate::tolerance::Tolerance;
use crate::{Batch, Batched, LaneVector, Machine, Singular, State, System, Vector};

/// Runs many trajectories of machines of one type, `W` at a time (2, 4 or 8) in the lanes of vector registers.
///
/// Each lane has its own time, steps and end, and takes the next trajectory as soon as its own is finished, so short and long ones
/// can be mixed. A trajectory has the bits that a [`Stepper`](crate::Stepper) with the same method gives it alone, whatever its
/// neighbours do. Nothing is allocated, except the coefficients of the lanes for [`Method::TAYLOR`], once.
///
/// It supports machines without constraints and contacts, with constant inputs for each trajectory; others, with their events, are run by
/// [`Simulation::run_in_lanes`](crate::Simulation::run_in_lanes). If a machine has its Taylor
/// series (`methods { taylor }` in its spec), that is the fastest method at tolerances below 10⁻⁵.
///
/// ```
/// use lagrangian::{Ensemble, Machine, State, Trajectory};
/// use lagrangian_machines::DoublePendulum;
///
/// // How fast the lower bob is after a second, let go from 100 angles.
/// let machine = DoublePendulum::default();
/// let trajectories = (0..100).map(|i| {
///     let mut start = Machine::start(&machine);
///     start.q.theta1 = 0.01 * f64::from(i);
///     Trajectory::new(machine.prepare(), start, 1.0)
/// });
/// let mut rates = [0.0; 100];
/// Ensemble::<4>::new().tolerance(1e-10).run(trajectories, |index, arrived| {
///     rates[index] = arrived.map_or(f64::NAN, |arrival| arrival.end.v.theta2);
/// });
/// assert!(rates.iter().all(|rate| rate.is_finite()));
/// ```
#[derive(Clone, Copy, Debug)]
#[must_use = "an ensemble does nothing until `run(trajectories, …)`"]
pub struct Ensemble<const W: usize> {
    method: &'static Method,
    tolerance: f64,
    longest_step: f64,
    max_steps: usize,
}

/// One run to be made: equations of motion with constant inputs, a start and an end.
#[derive(Clone, Debug)]
pub struct Trajectory<S: System> {
    /// The equations of motion.
    pub system: S,
    /// The inputs, which stay constant.
    pub inputs: S::Inputs,
    /// The state at the start.
    pub start: State<S::Coordinates>,
    /// The end, in s; a time before the start runs backward.
    pub end: f64,
}

/// How a trajectory ended.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Arrival<C> {
    /// The state at its end.
    pub end: State<C>,
    /// Number of steps and evaluations.
    pub work: Work,
}

impl<S: System> Trajectory<S> {
    /// A run with the inputs of the description.
    pub fn new(system: S, start: State<S::Coordinates>, end: f64) -> Self {
        Self {
            inputs: system.default_inputs(),
            system,
            start,
            end,
        }
    }

    /// A run of a machine from its own start.
    pub fn of<M: Machine<System = S>>(machine: &M, end: f64) -> Self {
        Self::new(machine.prepare(), machine.start(), end)
    }

    /// Replaces the inputs, in their units.
    pub fn inputs(self, inputs: S::Inputs) -> Self {
        Self { inputs, ..self }
    }
}

impl<const W: usize> Default for Ensemble<W> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const W: usize> Ensemble<W> {
    /// Runs with [`Method::DOP853`] at a tolerance of 10⁻⁹, with at most ten million steps each.
    pub fn new() -> Self {
        Self {
            method: Default::default(),
            tolerance: 1e-9,
            longest_step: f64::INFINITY,
            max_steps: MAX_STEPS,
        }
    }

    /// The method of integration, an explicit one or [`Method::TAYLOR`].
    pub fn method(mut self, method: &'static Method) -> Self {
        self.method = method;
        self
    }

    /// The tolerance of each step, relative and absolute: the error in a number `y` is kept below `tolerance · (1 + |y|)`.
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The length of the longest step, in s.
    pub fn longest_step(mut self, step: f64) -> Self {
        self.longest_step = step;
        self
    }

    /// The largest number of steps of a trajectory; one that needs more is an error.
    pub fn max_steps(mut self, steps: usize) -> Self {
        self.max_steps = steps;
        self
    }

    /// Runs all trajectories and calls `arrived` for each as soon as it is finished, with its index in the order of the input and its
    /// end. They arrive in a different order.
    ///
    /// A trajectory that cannot continue, or has constraints, passes an error to `arrived` and does not stop the others.
    pub fn run<S: Batched<W>>(
        &self,
        trajectories: impl IntoIterator<Item = Trajectory<S>>,
        arrived: impl FnMut(usize, Result<Arrival<S::Coordinates>, StepError>),
    ) {
        #[cfg(feature = "std")]
        if self.method.kind == MethodKind::Series {
            return self
                .run_by::<S, InSeries<S::Vectors, S::SeriesLists, W>>(trajectories, arrived);
        }
        self.run_by::<S, Track<Lanes<W>, S::Vectors>>(trajectories, arrived);
    }

    /// [`run`](Self::run) with steps of the kind `T`.
    fn run_by<S: Batched<W>, T: Steps<S, W>>(
        &self,
        trajectories: impl IntoIterator<Item = Trajectory<S>>,
        mut arrived: impl FnMut(usize, Result<Arrival<S::Coordinates>, StepError>),
    ) {
        let mut queue = trajectories.into_iter().enumerate().fuse();
        let mut next = |arrived: &mut dyn FnMut(usize, Result<_, _>)| loop {
            let (index, trajectory) = queue.next()?;
            match self.begin(index, trajectory) {
                Ok(begun) if begun.track.is_done(0) => arrived(index, Ok(begun.arrival())),
                Ok(begun) => return Some(begun),
                Err(error) => arrived(index, Err(error)),
            }
        };
        let Some(first) = next(&mut arrived) else {
            return;
        };
        let mut side_by_side = ActiveTrajectories::<S, T, W>::new(self, &first);
        side_by_side.insert(0, first);
        for lane in 1..W {
            match next(&mut arrived) {
                Some(begun) => side_by_side.insert(lane, begun),
                None => side_by_side.steps.stop(lane),
            }
        }
        let mut running = side_by_side.steps.count();
        while running > 0 {
            let outcomes = side_by_side.attempt();
            for (lane, outcome) in outcomes.into_iter().enumerate() {
                let work = side_by_side.steps.work(lane);
                let is_done = side_by_side.steps.is_done(lane);
                let end = match outcome {
                    Outcome::Taken if is_done => Ok(side_by_side.arrival(lane)),
                    Outcome::Taken if work.steps >= self.max_steps => {
                        Err(StepError::TooManySteps {
                            steps: self.max_steps,
                            t: side_by_side.steps.now().t[lane],
                        })
                    }
                    Outcome::Failed(error) => Err(error),
                    Outcome::Idle | Outcome::Taken | Outcome::GivenUp => continue,
                };
                side_by_side.steps.stop(lane);
                arrived(side_by_side.indices[lane], end);
                match next(&mut arrived) {
                    Some(begun) => side_by_side.insert(lane, begun),
                    None => running -= 1,
                }
            }
        }
    }

    /// Begins a trajectory at its start, alone.
    fn begin<S: System>(
        &self,
        index: usize,
        trajectory: Trajectory<S>,
    ) -> Result<PendingTrajectory<S>, StepError> {
        let Trajectory {
            system,
            inputs,
            start,
            end,
        } = trajectory;
        for t in [start.t, end] {
            if !t.is_finite() {
                return Err(StepError::NoTime { t });
            }
        }
        let held = system.constraints().len()
            + system.contacts().len()
            + system.unilateral_contacts().len();
        if held > 0 {
            return Err(StepError::NotFree { t: start.t });
        }
        let mut absolute = S::Vector::zeros(system.coordinates().len());
        absolute.as_mut_slice().fill(self.tolerance);
        let tolerance = Tolerance {
            relative: self.tolerance,
            absolute,
        };
        let at = (
            start.t,
            system.to_vector(&start.q),
            system.to_vector(&start.v),
        );
        let machine = OneSystem(&system, &inputs);
        let by_series = self.method.kind == MethodKind::Series && cfg!(feature = "std");
        if by_series && system.check_series().is_err() {
            let (inputs, t) = (false, start.t);
            return Err(StepError::NoSeries { inputs, t });
        }
        if !by_series {
            check::<f64>(self.method, start.t)?;
        }
        let mut track = Track::begin(self.method, tolerance, at, &machine)?;
        track.set_longest_step(self.longest_step);
        track.set_end(end);
        if !by_series {
            track.choose_first_step(&machine);
        }
        Ok(PendingTrajectory {
            index,
            system,
            inputs,
            track,
        })
    }
}

/// A trajectory at its start, not yet in a lane.
struct PendingTrajectory<S: System> {
    index: usize,
    system: S,
    inputs: S::Inputs,
    track: Track<f64, S::Vector>,
}

impl<S: System> PendingTrajectory<S> {
    fn arrival(&self) -> Arrival<S::Coordinates> {
        Arrival {
            end: State {
                t: self.track.t(),
                q: self.system.to_coordinates(self.track.q()),
                v: self.system.to_coordinates(self.track.v()),
            },
            work: self.track.work(0),
        }
    }
}

/// A system with its inputs.
struct OneSystem<'s, S: System>(&'s S, &'s S::Inputs);

impl<S: System> Accelerate<f64, S::Vector> for OneSystem<'_, S> {
    #[inline(always)]
    fn accelerate(
        &self,
        t: f64,
        q: &S::Vector,
        v: &S::Vector,
        a: &mut S::Vector,
    ) -> Result<(), [Option<Singular>; 1]> {
        let Self(system, inputs) = self;
        let result = system.accelerations(t, q, v, inputs, a);
        result.map_err(|singular| [Some(singular)])
    }
}

/// Systems with their inputs.
struct SystemBatch<'s, S: Batched<W>, const W: usize>(&'s Batch<S, W>, &'s S::BatchInputs);

impl<S: Batched<W>, const W: usize> Accelerate<Lanes<W>, S::Vectors> for SystemBatch<'_, S, W> {
    #[inline(always)]
    fn accelerate(
        &self,
        t: Lanes<W>,
        q: &S::Vectors,
        v: &S::Vectors,
        a: &mut S::Vectors,
    ) -> Result<(), [Option<Singular>; W]> {
        let Self(batch, inputs) = self;
        let result = batch.accelerations(t, q, v, inputs, a);
        result.map_err(|some| some.lanes)
    }
}

/// Trajectories in parallel, with the steps of one kind of method.
trait Steps<S: Batched<W>, const W: usize>: Sized {
    /// Lanes that do not move, all at the start of `first`.
    fn resting(ensemble: &Ensemble<W>, first: &Track<f64, S::Vector>) -> Self;
    /// Puts a trajectory at its start into a lane.
    fn insert(&mut self, lane: usize, one: &Track<f64, S::Vector>);
    /// One attempt at a step of every trajectory.
    fn attempt(&mut self, batch: &Batch<S, W>, inputs: &S::BatchInputs) -> [Outcome; W];
    /// The present states.
    fn now(&self) -> &Point<S::Vectors, Lanes<W>>;
    /// Whether a trajectory is at its end.
    fn is_done(&self, lane: usize) -> bool;
    /// Steps and evaluations of a trajectory.
    fn work(&self, lane: usize) -> Work;
    /// Stops a trajectory.
    fn stop(&mut self, lane: usize);
    /// The number of trajectories under way.
    fn count(&self) -> usize;
}

/// A vector with the same numbers in all lanes.
fn in_all_lanes<V: LaneVector<W>, const W: usize>(vector: &V::Vector) -> V {
    let mut rows = V::ZEROS;
    for (row, number) in rows.as_mut().iter_mut().zip(vector.as_slice()) {
        *row = Lanes::splat(*number);
    }
    rows
}

/// Puts a vector into a lane.
fn put<V: LaneVector<W>, const W: usize>(rows: &mut V, lane: usize, vector: &V::Vector) {
    for (row, number) in rows.as_mut().iter_mut().zip(vector.as_slice()) {
        row[lane] = *number;
    }
}

/// Puts a state into a lane.
fn put_point<V: LaneVector<W>, const W: usize>(
    point: &mut Point<V, Lanes<W>>,
    lane: usize,
    one: &Point<V::Vector>,
) {
    (point.t[lane], point.t_low[lane]) = (one.t, one.t_low);
    put(&mut point.q, lane, &one.q);
    put(&mut point.q_low, lane, &one.q_low);
    put(&mut point.v, lane, &one.v);
    put(&mut point.v_low, lane, &one.v_low);
}

impl<S: Batched<W>, const W: usize> Steps<S, W> for Track<Lanes<W>, S::Vectors> {
    fn resting(ensemble: &Ensemble<W>, first: &Track<f64, S::Vector>) -> Self {
        let mut absolute = S::Vectors::ZEROS;
        absolute.as_mut().fill(Lanes::splat(ensemble.tolerance));
        let tolerance = Tolerance {
            relative: ensemble.tolerance,
            absolute,
        };
        let t = Lanes::splat(first.t());
        let at = (t, in_all_lanes(first.q()), in_all_lanes(first.v()));
        let mut track = Track::resting(ensemble.method, tolerance, at);
        track.set_longest_step(ensemble.longest_step);
        track.k[0] = in_all_lanes(first.a());
        track
    }

    fn insert(&mut self, lane: usize, one: &Track<f64, S::Vector>) {
        for point in [&mut self.now, &mut self.before] {
            put_point(point, lane, &one.now);
        }
        self.end[lane] = one.end;
        put(&mut self.k[0], lane, &one.k[0]);
        self.lanes[lane] = one.lanes[0];
    }

    fn attempt(&mut self, batch: &Batch<S, W>, inputs: &S::BatchInputs) -> [Outcome; W] {
        S::Vectors::run(Attempt(self, &SystemBatch(batch, inputs)))
    }

    fn now(&self) -> &Point<S::Vectors, Lanes<W>> {
        &self.now
    }

    fn is_done(&self, lane: usize) -> bool {
        Track::is_done(self, lane)
    }

    fn work(&self, lane: usize) -> Work {
        Track::work(self, lane)
    }

    fn stop(&mut self, lane: usize) {
        Track::stop(self, lane);
    }

    fn count(&self) -> usize {
        self.lanes.iter().filter(|lane| lane.is_running).count()
    }
}

#[cfg(feature = "std")]
impl<S: Batched<W>, const W: usize> Steps<S, W> for InSeries<S::Vectors, S::SeriesLists, W> {
    fn resting(ensemble: &Ensemble<W>, first: &Track<f64, S::Vector>) -> Self {
        let t = Lanes::splat(first.t());
        let now = Point::new(t, in_all_lanes(first.q()), in_all_lanes(first.v()));
        let Ensemble {
            tolerance,
            longest_step,
            ..
        } = *ensemble;
        InSeries::resting(tolerance, longest_step, now)
    }

    fn insert(&mut self, lane: usize, one: &Track<f64, S::Vector>) {
        put_point(self.now_mut(), lane, &one.now);
        self.begin(lane, one.end, one.work(0));
    }

    fn attempt(&mut self, batch: &Batch<S, W>, inputs: &S::BatchInputs) -> [Outcome; W] {
        InSeries::attempt(self, batch, inputs)
    }

    fn now(&self) -> &Point<S::Vectors, Lanes<W>> {
        InSeries::now(self)
    }

    fn is_done(&self, lane: usize) -> bool {
        InSeries::is_done(self, lane)
    }

    fn work(&self, lane: usize) -> Work {
        InSeries::work(self, lane)
    }

    fn stop(&mut self, lane: usize) {
        InSeries::stop(self, lane);
    }

    fn count(&self) -> usize {
        InSeries::count(self)
    }
}

/// The trajectories that are under way.
struct ActiveTrajectories<S: Batched<W>, T, const W: usize> {
    indices: [usize; W],
    systems: [S; W],
    inputs: [S::Inputs; W],
    batch: Batch<S, W>,
    batch_inputs: S::BatchInputs,
    /// Whether systems were replaced since the batch was made.
    changed: bool,
    steps: T,
}

impl<S: Batched<W>, T: Steps<S, W>, const W: usize> ActiveTrajectories<S, T, W> {
    /// Lanes that are all at the start of `first`; those into which nothing is put stay there.
    fn new(ensemble: &Ensemble<W>, first: &PendingTrajectory<S>) -> Self {
        let inputs: [S::Inputs; W] = core::array::from_fn(|_| first.inputs.clone());
        Self {
            indices: [first.index; W],
            systems: [first.system; W],
            batch: Batch::of(&first.system),
            batch_inputs: S::batch_inputs(inputs.each_ref()),
            inputs,
            changed: false,
            steps: T::resting(ensemble, &first.track),
        }
    }

    /// Puts a trajectory into a lane.
    fn insert(&mut self, lane: usize, begun: PendingTrajectory<S>) {
        let PendingTrajectory {
            index,
            system,
            inputs,
            track,
        } = begun;
        self.indices[lane] = index;
        self.systems[lane] = system;
        self.inputs[lane] = inputs;
        self.changed = true;
        self.steps.insert(lane, &track);
    }

    /// One attempt at a step of every trajectory.
    fn attempt(&mut self) -> [Outcome; W] {
        if self.changed {
            self.batch = Batch::new(self.systems.each_ref());
            self.batch_inputs = S::batch_inputs(self.inputs.each_ref());
            self.changed = false;
        }
        self.steps.attempt(&self.batch, &self.batch_inputs)
    }

    /// The present state of a trajectory as its arrival.
    fn arrival(&self, lane: usize) -> Arrival<S::Coordinates> {
        let system = &self.systems[lane];
        let now = self.steps.now();
        Arrival {
            end: State {
                t: now.t[lane],
                q: system.to_coordinates(&now.q.lane(lane)),
                v: system.to_coordinates(&now.v.lane(lane)),
            },
            work: self.steps.work(lane),
        }
    }
}
