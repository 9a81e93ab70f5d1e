//! Runs of compiled machines in lanes: the evaluation of their machines.

use std::boxed::Box;
use std::vec;
use std::vec::Vec;

use super::{RunAsFar, run_many_by};
use crate::inputs::InputLaw;
use crate::run::in_lanes::{Machines, run_tasks};
use crate::stepper::in_lanes::{Evaluate, LaneMask, WIDTH, Wide};
use crate::{Batch, Batched, Coordinates, Inputs, LaneVector, Machine, Simulation, State};
use lagrangian_native::Lanes;

impl<M, L> Simulation<'_, M, L>
where
    M: Machine<System: Batched<WIDTH>>,
    L: InputLaw<M::System>,
{
    /// Makes many runs like [`run_as_far_as_possible`](Self::run_as_far_as_possible), eight at a time in the lanes of vector registers:
    /// machines with the same equations and different parameters or starts. A lane whose run is over takes the next one, and each has its
    /// own steps, events, contacts and end. Returns the results in the order of the runs.
    ///
    /// Together are made runs by one explicit method or by [`TAYLOR`](crate::TAYLOR), with one relative tolerance and constant inputs; other runs are made alone, and runs
    /// that change their method go on with others that have changed to the same one. While a
    /// unilateral contact is closed or constraints depend on each other, the steps of a run are tried alone. Every run has the bits that it
    /// has alone. Callbacks are called by all runs alternately, and [`Statistics::seconds`](crate::Statistics::seconds) of each is the time
    /// of all. The powers of an [`energy_balance`](Self::energy_balance) are evaluated run by run.
    ///
    /// If only the ends of motions without constraints and contacts are asked for, [`Ensemble`](crate::Ensemble) is faster.
    ///
    /// ```
    /// use lagrangian::Simulation;
    ///
    /// lagrangian::machine! {
    ///     machine Ball in plane {
    ///         parameters { m: kg = 0.1, e: 1 = 0.8, g: m/s^2 = 9.81 }
    ///         coordinates { y: m = 1 }
    ///         bodies { ball { mass: m, at: (0, y) } }
    ///         gravity (0, -g);
    ///         contacts { floor { gap: y, restitution: e } }
    ///     }
    /// }
    ///
    /// // How often balls that lose more or less of their speed meet the floor within 3 s.
    /// let balls: Vec<_> = (0..40).map(|i| Ball { e: 0.5 + 0.01 * f64::from(i), ..Default::default() }).collect();
    /// let run = |ball| (Simulation::new(ball).until(3.0), Ball::start(ball));
    /// for (ball, made) in balls.iter().zip(Simulation::run_in_lanes(balls.iter().map(run).collect())) {
    ///     let (solution, error) = made?;
    ///     let alone = Simulation::new(ball).until(3.0).run(ball.start())?;
    ///     assert!(error.is_none() && solution.end() == alone.end());
    ///     assert_eq!(solution.contact_events().len(), alone.contact_events().len());
    /// }
    /// # Ok::<(), lagrangian::Error>(())
    /// ```
    pub fn run_in_lanes(simulations: Vec<(Self, State<Coordinates<M>>)>) -> Vec<RunAsFar<M, L>> {
        run_many_by(simulations, |tasks| {
            run_tasks(tasks, &mut CompiledMachines::<M::System>::new())
        })
    }
}

/// The machines of all lanes, as compiled code.
struct CompiledMachines<S: Batched<WIDTH>> {
    /// The system and the inputs of each lane, none before the first run. A lane without a run has those of the first one or of an earlier
    /// one, so that it holds a valid machine.
    lanes: Vec<(S, S::Inputs)>,
    /// These side by side, until one of them is replaced.
    side_by_side: Option<(Batch<S, WIDTH>, S::BatchInputs)>,
    /// Memory for expansions of the motions.
    lists: Box<S::SeriesLists>,
    coefficients: Vec<S::Vectors>,
}

impl<S: Batched<WIDTH>> CompiledMachines<S> {
    fn new() -> Self {
        Self {
            lanes: Vec::new(),
            side_by_side: None,
            lists: Box::default(),
            coefficients: Vec::new(),
        }
    }

    /// The equations of all lanes; `None` before the first run.
    fn equations(&mut self) -> Option<&(Batch<S, WIDTH>, S::BatchInputs)> {
        if self.side_by_side.is_none() {
            let lanes: &[(S, S::Inputs); WIDTH] = self.lanes.as_slice().try_into().ok()?;
            let batch = Batch::new(lanes.each_ref().map(|(system, _)| system));
            let inputs = S::batch_inputs(lanes.each_ref().map(|(_, inputs)| inputs));
            self.side_by_side = Some((batch, inputs));
        }
        self.side_by_side.as_ref()
    }
}

impl<M: Machine<System: Batched<WIDTH>>> Machines<M> for CompiledMachines<M::System> {
    fn put(&mut self, lane: usize, system: &M::System, inputs: &Inputs<M>) -> bool {
        let own = (*system, inputs.clone());
        if self.lanes.is_empty() {
            self.lanes = vec![own; WIDTH];
        } else {
            self.lanes[lane] = own;
        }
        self.side_by_side = None;
        true
    }
}

impl<S: Batched<WIDTH>> Evaluate for CompiledMachines<S> {
    fn accelerations(&mut self, (t, q, v): (Wide, &[Wide], &[Wide]), a: &mut [Wide]) -> LaneMask {
        let Some((batch, inputs)) = self.equations() else {
            return 0;
        };
        let rows = |numbers: &[Wide]| {
            let mut rows = S::Vectors::ZEROS;
            rows.as_mut().copy_from_slice(numbers);
            rows
        };
        let mut found = S::Vectors::ZEROS;
        let evaluated = batch.accelerations(t, &rows(q), &rows(v), inputs, &mut found);
        a.copy_from_slice(found.as_ref());
        let Err(some) = evaluated else {
            return LaneMask::MAX;
        };
        let lanes = some.lanes.iter().enumerate();
        lanes.fold(0, |fine, (lane, singular)| {
            fine | LaneMask::from(singular.is_none()) << lane
        })
    }

    fn powers(&mut self, (t, q, v): (Wide, &[Wide], &[Wide]), a: &[Wide]) -> ([Wide; 2], LaneMask) {
        let mut powers = [Lanes::splat(0.0); 2];
        let rows = |numbers: &[Wide]| {
            let mut rows = S::Vectors::ZEROS;
            rows.as_mut().copy_from_slice(numbers);
            rows
        };
        let (q, v, a) = (rows(q), rows(v), rows(a));
        for (lane, (system, u)) in self.lanes.iter().enumerate() {
            let (t, q, v) = (t[lane], q.lane(lane), v.lane(lane));
            powers[0][lane] = system.work_rate(t, &q, &v, &a.lane(lane), u);
            powers[1][lane] = system.dissipation_rate(t, &q, &v, u);
        }
        (powers, LaneMask::MAX)
    }

    fn series(
        &mut self,
        (t, q, v): ([Wide; 2], &[Wide], &[Wide]),
        coefficients: &mut [Vec<Wide>],
    ) -> LaneMask {
        self.equations();
        let Some((batch, inputs)) = &self.side_by_side else {
            return 0;
        };
        let rows = |numbers: &[Wide]| {
            let mut rows = S::Vectors::ZEROS;
            rows.as_mut().copy_from_slice(numbers);
            rows
        };
        let found = &mut self.coefficients;
        found.resize(coefficients.len(), S::Vectors::ZEROS);
        let expanded = batch.series(t, &rows(q), &rows(v), inputs, &mut self.lists, found);
        for (to, row) in coefficients.iter_mut().zip(&*found) {
            to.copy_from_slice(row.as_ref());
        }
        let Err(some) = expanded else {
            return LaneMask::MAX;
        };
        let lanes = some.lanes.iter().enumerate();
        lanes.fold(0, |fine, (lane, singular)| {
            fine | LaneMask::from(singular.is_none()) << lane
        })
    }
}
