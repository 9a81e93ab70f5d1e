//! What watches a run and acts on it: observers, events, conditions, sampled controllers.

use std::boxed::Box;

use super::Simulation;
use crate::callbacks::{Observe, Shared, Watched};
use crate::event::{Crossing, Watch};
use crate::inputs::InputLaw;
use crate::observation::Observation;
use crate::settings::{Progress, Sampled, StateStream};
use crate::{Coordinates, Error, Inputs, Machine, State, StepMotion};

impl<'a, M: Machine, L: InputLaw<M::System>> Simulation<'a, M, L> {
    /// Calls `observer` with every accepted step, in order, and the motion within it, so that results can be computed without keeping the
    /// motion. An error that it returns ends the run.
    ///
    /// ```
    /// # mod by_hand { include!("../../tests/by_hand/toy.rs"); }
    /// use lagrangian::Simulation;
    ///
    /// // The way that a ball falls, by the trapezoidal rule over the steps.
    /// let ball = by_hand::ball();
    /// let mut way = 0.0;
    /// Simulation::new(&ball)
    ///     .until(0.5)
    ///     .forget_steps()
    ///     .each_step(|step| {
    ///         let [from, to] = step.span();
    ///         let [before, after] = [from, to].map(|t| step.state(t));
    ///         way += 0.5 * (to - from) * (before?.v[0] + after?.v[0]);
    ///         Ok(())
    ///     })
    ///     .run(ball.start())?;
    /// assert!((way + 0.5 * 9.81 * 0.25).abs() < 1e-12);
    /// # Ok::<(), lagrangian::Error>(())
    /// ```
    pub fn each_step(
        mut self,
        observer: impl FnMut(&mut dyn StepMotion<M>) -> Result<(), Error> + Send + 'a,
    ) -> Self {
        self.callbacks.observer = Some(Shared::new(Box::new(observer)));
        self
    }

    /// Finds the instants at which `function` changes its sign. If it is 0 to rounding at the start, sign changes count only after it has
    /// left 0, relative to the sign that it has then.
    pub fn event(
        self,
        name: &str,
        crossing: Crossing,
        function: impl FnMut(&State<Coordinates<M>>) -> f64 + Clone + Send + 'a,
    ) -> Self {
        self.watch(name, crossing, None, of_state::<M>(function))
    }

    /// Finds the instants at which a function of observed quantities changes its sign: outputs, accelerations, multipliers, contact forces.
    /// It is evaluated at least seven times a step, each time with an evaluation of the accelerations.
    ///
    /// ```
    /// use lagrangian::{Crossing, Simulation};
    ///
    /// lagrangian::machine! {
    ///     machine Swing in plane {
    ///         parameters { m: kg = 1, l: m = 1, g: m/s^2 = 10 }
    ///         coordinates { theta: rad = pi/2 }
    ///         bodies { bob { mass: m, at: l*(sin(theta), -cos(theta)) } }
    ///         gravity (0, -g);
    ///         outputs { rope: N = m*(g*cos(theta) + l*der(theta)^2) }
    ///     }
    /// }
    ///
    /// // Let go from the horizontal, the force in the rope is 3 m g cos θ: it is 15 N at 60°.
    /// let swing = Swing::default();
    /// let run = Simulation::new(&swing)
    ///     .until(1.0)
    ///     .event_on("half of the most", Crossing::Rising, |seen| seen.outputs.rope - 15.0)
    ///     .run(swing.start())?;
    /// let angle = run.events()[0].state.q.theta;
    /// assert!((angle.to_degrees() - 60.0).abs() < 1e-6);
    /// # Ok::<(), lagrangian::Error>(())
    /// ```
    pub fn event_on(
        self,
        name: &str,
        crossing: Crossing,
        function: impl FnMut(&Observation<M>) -> f64 + Clone + Send + 'a,
    ) -> Self {
        self.watch(name, crossing, None, of_observation::<M>(function))
    }

    /// Ends the run when `function` changes its sign, at the state where it is 0 to the rounding of time and state. [`Solution::resume`](crate::Solution::resume)
    /// continues from there.
    pub fn until_event(
        self,
        name: &str,
        crossing: Crossing,
        function: impl FnMut(&State<Coordinates<M>>) -> f64 + Clone + Send + 'a,
    ) -> Self {
        self.until_nth_event(1, name, crossing, function)
    }

    /// Ends the run when `function` changes its sign for the `n`th time; `n = 0` counts as the first.
    pub fn until_nth_event(
        self,
        n: usize,
        name: &str,
        crossing: Crossing,
        function: impl FnMut(&State<Coordinates<M>>) -> f64 + Clone + Send + 'a,
    ) -> Self {
        self.watch(name, crossing, Some(n), of_state::<M>(function))
    }

    /// Ends the run when `function` of observed quantities changes its sign; see [`event_on`](Self::event_on).
    pub fn until_event_on(
        self,
        name: &str,
        crossing: Crossing,
        function: impl FnMut(&Observation<M>) -> f64 + Clone + Send + 'a,
    ) -> Self {
        self.until_nth_event_on(1, name, crossing, function)
    }

    /// Ends the run when `function` of observed quantities changes its sign for the `n`th time; `n = 0` counts as the first.
    pub fn until_nth_event_on(
        self,
        n: usize,
        name: &str,
        crossing: Crossing,
        function: impl FnMut(&Observation<M>) -> f64 + Clone + Send + 'a,
    ) -> Self {
        self.watch(name, crossing, Some(n), of_observation::<M>(function))
    }

    fn watch(
        mut self,
        name: &str,
        crossing: Crossing,
        left: Option<usize>,
        function: Box<dyn Watched<'a, M> + 'a>,
    ) -> Self {
        self.callbacks.watches.push(Watch {
            name: name.into(),
            crossing,
            left,
            function,
            side: 0.0,
            touched: 0.0,
            leave: 0.0,
            latest: None,
            at_end: f64::NAN,
            begun: false,
            at_zero: false,
        });
        self
    }

    /// Calls `observer` with the states at the start, every `interval` seconds after it and at the end while the run goes on; none of them
    /// is kept. There may be several observers.
    ///
    /// ```
    /// # mod by_hand { include!("../../tests/by_hand/toy.rs"); }
    /// use lagrangian::Simulation;
    ///
    /// let ball = by_hand::ball();
    /// let mut heights = Vec::new();
    /// let run = Simulation::new(&ball).until(0.5).forget_steps();
    /// run.observe(0.25, |state| heights.push(state.q[0])).run(ball.start())?;
    /// assert_eq!(heights.len(), 3);
    /// # Ok::<(), lagrangian::Error>(())
    /// ```
    pub fn observe(
        mut self,
        interval: f64,
        observer: impl FnMut(&State<Coordinates<M>>) + Send + 'a,
    ) -> Self {
        self.settings.observed_every.push(interval);
        self.callbacks.streams.push(StateStream {
            interval,
            count: 0,
            last: f64::NAN,
            observer: Shared::new(Box::new(observer)),
        });
        self
    }

    /// Calls a controller at the start and every `period` seconds after it. It reads the state and sets the inputs, which hold until its
    /// next call, like a digital controller; the result is one run with one solution. It is called once per sample, in the order of time,
    /// so it may have a state of its own: a filter, an integral. `inputs` holds what it set before, initially the defaults.
    ///
    /// A step ends at each sample. The run must go forward in time and have no other [`inputs`](Simulation::inputs); a
    /// [`table`](Simulation::table) is allowed and takes precedence if both set the same input.
    ///
    /// ```
    /// # mod by_hand { include!("../../tests/by_hand/toy.rs"); }
    /// # use by_hand::Toy;
    /// use lagrangian::Simulation;
    ///
    /// // A mass of 1 kg on which a computer pushes against its velocity, ten times a second: each time a tenth of it is left.
    /// let mass = Toy::new(([0.0], [1.0]), |_, _, _, u, _| [u]);
    /// let run = Simulation::new(&mass)
    ///     .until(0.5)
    ///     .sampled(0.1, |state, force| *force = -9.0 * state.v[0])
    ///     .run(mass.start())?;
    /// assert!((run.end().v[0] - 1e-5).abs() < 1e-12);
    /// // x = Σ (v₀ + v₁)/2 · 0.1 s
    /// assert!((run.at(0.1)?.q[0] - 0.055).abs() < 1e-12);
    /// # Ok::<(), lagrangian::Error>(())
    /// ```
    pub fn sampled(
        mut self,
        period: f64,
        controller: impl FnMut(&State<Coordinates<M>>, &mut Inputs<M>) + Clone + Send + 'a,
    ) -> Self {
        self.callbacks.sampled = Some(Sampled {
            period,
            delay: 0.0,
            reads_end: false,
            controller: Box::new(controller),
        });
        self
    }

    /// A controller like [`sampled`](Self::sampled) whose inputs take effect `delay` seconds after it has read the state, to model
    /// computation and transmission. The delay may exceed the period. Until the first inputs take effect, the inputs have their defaults.
    pub fn sampled_with_delay(
        self,
        period: f64,
        delay: f64,
        controller: impl FnMut(&State<Coordinates<M>>, &mut Inputs<M>) + Clone + Send + 'a,
    ) -> Self {
        let mut simulation = self.sampled(period, controller);
        if let Some(sampled) = &mut simulation.callbacks.sampled {
            sampled.delay = delay;
        }
        simulation
    }

    /// States that the sampled controller, if there is one, has no state of its own.
    #[cfg(feature = "interpreter")]
    pub(crate) fn sampled_without_memory(mut self) -> Self {
        if let Some(sampled) = &mut self.callbacks.sampled {
            sampled.reads_end = true;
        }
        self
    }

    /// Calls `callback` after every step.
    pub fn progress(mut self, callback: impl FnMut(Progress) + Send + 'a) -> Self {
        self.callbacks.progress = Some(Shared::new(Box::new(callback)));
        self
    }

    /// Ends the run after the first step at whose end `condition` holds. To end at the exact instant,
    /// use [`until_event`](Self::until_event). Where a search for the zeros of a function takes long within a step, as of one that oscillates thousands of
    /// times, it is asked again for the state at the beginning of this step, and the run ends there.
    pub fn stop_if(
        mut self,
        condition: impl FnMut(&State<Coordinates<M>>) -> bool + Clone + Send + 'a,
    ) -> Self {
        self.callbacks.stop = Some(Box::new(condition));
        self
    }
}

/// Boxes a function of the state as an event function.
fn of_state<'a, M: Machine>(
    mut function: impl FnMut(&State<Coordinates<M>>) -> f64 + Clone + Send + 'a,
) -> Box<dyn Watched<'a, M> + 'a> {
    Box::new(move |state: &State<Coordinates<M>>, _: Observe<'_, M>| Ok(function(state)))
}

/// Boxes a function of observed quantities as an event function.
fn of_observation<'a, M: Machine>(
    mut function: impl FnMut(&Observation<M>) -> f64 + Clone + Send + 'a,
) -> Box<dyn Watched<'a, M> + 'a> {
    Box::new(move |_: &State<Coordinates<M>>, observe: Observe<'_, M>| Ok(function(&observe()?)))
}
