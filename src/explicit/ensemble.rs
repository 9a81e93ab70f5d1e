//! Many runs of one kind of machine, several at a time in the lanes of the processor.

use lagrangian_native::Lanes;

use super::{Accelerate, Outcome, Track};
use crate::control::{MAX_STEPS, Work};
use crate::methods::Method;
use crate::stages::Point;
use crate::step_error::StepError;

use crate::tolerance::Tolerance;
use crate::{Batch, Batched, LaneVector, Machine, Singular, State, System, Vector};

/// Runs many trajectories of one kind of machine, `W` at a time, in the lanes of the processor's registers: 2, 4 or 8.
///
/// Each lane has its own time, its own steps and its own end, and takes the next trajectory as soon as its own is over; so short
/// and long ones go together. A trajectory has the bits that a [`Stepper`](crate::Stepper) by the same method gives it alone,
/// whatever its neighbours do. Nothing is allocated.
///
/// It is for machines without constraints and contacts, with inputs that each trajectory holds.
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

/// One run to be made: equations of motion with their inputs, from a state to an end.
#[derive(Clone, Debug)]
pub struct Trajectory<S: System> {
    /// The equations of motion.
    pub system: S,
    /// The inputs, which it holds.
    pub inputs: S::Inputs,
    /// Where it starts.
    pub start: State<S::Coordinates>,
    /// When it ends, in s; before its start to run backward in time.
    pub end: f64,
}

/// How a trajectory ended.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Arrival<C> {
    /// The state at its end.
    pub end: State<C>,
    /// What it took.
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

    /// The same with other inputs.
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
    /// Runs by [`Method::DOP853`] with a tolerance of 10⁻⁹, of ten million steps at the most.
    pub fn new() -> Self {
        Self {
            method: Default::default(),
            tolerance: 1e-9,
            longest_step: f64::INFINITY,
            max_steps: MAX_STEPS,
        }
    }

    /// The method of integration, an explicit one.
    pub fn method(mut self, method: &'static Method) -> Self {
        self.method = method;
        self
    }

    /// How exact each step shall be, relative and absolute: the error in a number `y` is kept below `tolerance · (1 + |y|)`.
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The greatest length of a step, in s.
    pub fn longest_step(mut self, step: f64) -> Self {
        self.longest_step = step;
        self
    }

    /// How many steps a trajectory may take; one that would take more is an error.
    pub fn max_steps(mut self, steps: usize) -> Self {
        self.max_steps = steps;
        self
    }

    /// Runs all trajectories, and tells `arrived` of each as soon as it is over: its number, in the order in which they come, and
    /// its end. They arrive in another order.
    ///
    /// A trajectory that cannot go on, or has constraints, is an error to `arrived`, and does not stop the others.
    pub fn run<S: Batched<W>>(
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
        let mut side_by_side = match SideBySide::new(self, &first) {
            Ok(side_by_side) => side_by_side,
            Err(error) => return arrived(first.index, Err(error)),
        };
        side_by_side.insert(0, first);
        for lane in 1..W {
            match next(&mut arrived) {
                Some(begun) => side_by_side.insert(lane, begun),
                None => side_by_side.track.stop(lane),
            }
        }
        let mut running = side_by_side.count();
        while running > 0 {
            let outcomes = side_by_side.attempt();
            for (lane, outcome) in outcomes.into_iter().enumerate() {
                let work = side_by_side.track.work(lane);
                let is_done = side_by_side.track.is_done(lane);
                let end = match outcome {
                    Outcome::Taken if is_done => Ok(side_by_side.arrival(lane)),
                    Outcome::Taken if work.steps >= self.max_steps => {
                        Err(StepError::TooManySteps {
                            steps: self.max_steps,
                            t: side_by_side.track.t()[lane],
                        })
                    }
                    Outcome::Failed(error) => Err(error),
                    Outcome::Idle | Outcome::Taken | Outcome::GivenUp => continue,
                };
                side_by_side.track.stop(lane);
                arrived(side_by_side.indices[lane], end);
                match next(&mut arrived) {
                    Some(begun) => side_by_side.insert(lane, begun),
                    None => running -= 1,
                }
            }
        }
    }

    /// A trajectory at its start, alone.
    fn begin<S: System>(
        &self,
        index: usize,
        trajectory: Trajectory<S>,
    ) -> Result<Begun<S>, StepError> {
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
        let machine = Alone(&system, &inputs);
        let mut track = Track::begin(self.method, tolerance, at, &machine)?;
        track.set_longest_step(self.longest_step);
        track.set_end(end);
        track.choose_first_step(&machine);
        Ok(Begun {
            index,
            system,
            inputs,
            track,
        })
    }
}

/// A trajectory at its start, alone.
struct Begun<S: System> {
    index: usize,
    system: S,
    inputs: S::Inputs,
    track: Track<f64, S::Vector>,
}

impl<S: System> Begun<S> {
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
struct Alone<'s, S: System>(&'s S, &'s S::Inputs);

impl<S: System> Accelerate<f64, S::Vector> for Alone<'_, S> {
    #[inline(always)]
    fn accelerate(
        &self,
        t: f64,
        q: &S::Vector,
        v: &S::Vector,
        a: &mut S::Vector,
    ) -> Result<(), [Option<Singular>; 1]> {
        let Self(system, inputs) = self;
        let found = system.accelerations(t, q, v, inputs, a);
        found.map_err(|singular| [Some(singular)])
    }
}

/// Systems with their inputs.
struct Together<'s, S: Batched<W>, const W: usize>(&'s Batch<S, W>, &'s S::BatchInputs);

impl<S: Batched<W>, const W: usize> Accelerate<Lanes<W>, S::Vectors> for Together<'_, S, W> {
    #[inline(always)]
    fn accelerate(
        &self,
        t: Lanes<W>,
        q: &S::Vectors,
        v: &S::Vectors,
        a: &mut S::Vectors,
    ) -> Result<(), [Option<Singular>; W]> {
        let Self(batch, inputs) = self;
        let found = batch.accelerations(t, q, v, inputs, a);
        found.map_err(|some| some.lanes)
    }
}

/// The trajectories that are under way.
struct SideBySide<S: Batched<W>, const W: usize> {
    indices: [usize; W],
    systems: [S; W],
    inputs: [S::Inputs; W],
    batch: Batch<S, W>,
    batch_inputs: S::BatchInputs,
    /// Whether the systems have changed since the batch was made.
    changed: bool,
    track: Track<Lanes<W>, S::Vectors>,
}

impl<S: Batched<W>, const W: usize> SideBySide<S, W> {
    /// As many lanes, all at the start of `first`: those which nothing is put into stay there.
    fn new(ensemble: &Ensemble<W>, first: &Begun<S>) -> Result<Self, StepError> {
        let spread = |vector: &S::Vector| {
            let mut rows = S::Vectors::ZEROS;
            for (row, number) in rows.as_mut().iter_mut().zip(vector.as_slice()) {
                *row = Lanes::splat(*number);
            }
            rows
        };
        let mut absolute = S::Vectors::ZEROS;
        absolute.as_mut().fill(Lanes::splat(ensemble.tolerance));
        let tolerance = Tolerance {
            relative: ensemble.tolerance,
            absolute,
        };
        let one = &first.track;
        let at = (Lanes::splat(one.t()), spread(one.q()), spread(one.v()));
        let mut track = Track::resting(ensemble.method, tolerance, at)?;
        track.set_longest_step(ensemble.longest_step);
        track.k[0] = spread(one.a());
        let inputs: [S::Inputs; W] = core::array::from_fn(|_| first.inputs.clone());
        Ok(Self {
            indices: [first.index; W],
            systems: [first.system; W],
            batch: Batch::of(&first.system),
            batch_inputs: S::batch_inputs(inputs.each_ref()),
            inputs,
            changed: false,
            track,
        })
    }

    /// Puts a trajectory into a lane.
    fn insert(&mut self, lane: usize, begun: Begun<S>) {
        let Begun {
            index,
            system,
            inputs,
            track: one,
        } = begun;
        self.indices[lane] = index;
        self.systems[lane] = system;
        self.inputs[lane] = inputs;
        self.changed = true;
        let track = &mut self.track;
        let put = |rows: &mut S::Vectors, vector: &S::Vector| {
            for (row, number) in rows.as_mut().iter_mut().zip(vector.as_slice()) {
                row[lane] = *number;
            }
        };
        for point in [&mut track.now, &mut track.before] {
            let Point {
                t,
                t_low,
                q,
                q_low,
                v,
                v_low,
            } = point;
            (t[lane], t_low[lane]) = (one.now.t, one.now.t_low);
            put(q, &one.now.q);
            put(q_low, &one.now.q_low);
            put(v, &one.now.v);
            put(v_low, &one.now.v_low);
        }
        track.end[lane] = one.end;
        put(&mut track.k[0], &one.k[0]);
        track.lanes[lane] = one.lanes[0];
    }

    /// How many trajectories are under way.
    fn count(&self) -> usize {
        let running = self.track.lanes.iter();
        running.filter(|lane| lane.is_running).count()
    }

    /// One try of every trajectory.
    fn attempt(&mut self) -> [Outcome; W] {
        if self.changed {
            self.batch = Batch::new(self.systems.each_ref());
            self.batch_inputs = S::batch_inputs(self.inputs.each_ref());
            self.changed = false;
        }
        let machine = Together(&self.batch, &self.batch_inputs);
        self.track.attempt(&machine)
    }

    /// Where a trajectory is.
    fn arrival(&self, lane: usize) -> Arrival<S::Coordinates> {
        let system = &self.systems[lane];
        Arrival {
            end: State {
                t: self.track.t()[lane],
                q: system.to_coordinates(&self.track.q().lane(lane)),
                v: system.to_coordinates(&self.track.v().lane(lane)),
            },
            work: self.track.work(lane),
        }
    }
}
