//! Runs with derivatives in the Cartesian coordinates that a spec names for polar ones.

use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::methods::Method;
use lagrangian::{Machine, Simulation, State, Turns, Varied, to_cartesian};
use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::Model;
use lagrangian_sweep::charts::ChartedPoints;
use lagrangian_sweep::verdict;

use crate::call;
use crate::failure::Failure;
use crate::reading;

/// The machine in the Cartesian coordinates that the spec names, in which its run is made.
pub(super) struct Chart {
    pub machine: InterpretedMachine,
    /// For each point the indices of its distance and its angle.
    pub points: Vec<[usize; 2]>,
}

impl Chart {
    /// The machine in the other chart; `None` if the call cannot be made in it, since it keeps a polar coordinate or begins at a negative
    /// distance.
    pub fn of(
        compiled: &Compiled<'_>,
        model: Model<'_>,
        (call, start): (&call::Sensitivities, &State<Named>),
    ) -> Result<Option<Chart>, Failure> {
        let mut report = Report::new();
        let cartesian = Compiled::new(model, &mut report);
        let is_same = |other: &Compiled<'_>| compiled.check_chart(other, &mut report).is_some();
        let points = ChartedPoints::of(&compiled.model);
        let Some(cartesian) = cartesian
            .filter(is_same)
            .filter(|_| points.check_kept(&call.keep.names).is_ok())
        else {
            return Ok(None);
        };
        let points = compiled.chart_points();
        if points.iter().any(|[s, _]| start.q.values[*s] < 0.0) {
            return Ok(None);
        }
        let machine = reading::machine(&cartesian, &call.start.parameters_alone())?;
        Ok(Some(Chart { machine, points }))
    }

    /// The turns of the angles in a run from a start in polar coordinates, and the start in Cartesian ones.
    pub fn turns(
        &self,
        (call, method): (&call::Sensitivities, &'static Method),
        stated: &State<Varied<Named>>,
    ) -> Result<Turns, Failure> {
        let mut start = self.machine.start();
        start.t = stated.t;
        start.q.values.clone_from(&stated.q.value.values);
        start.v.values.clone_from(&stated.v.value.values);
        let mut turns = Turns::begin(&self.points, stated.t, &start.q.values);
        to_cartesian(&self.points, &mut start.q.values, &mut start.v.values);
        let followed = &mut turns;
        Simulation::new(&self.machine)
            .tolerance(call.tolerance)
            .method(method)
            .until(call.until)
            .max_steps(call.max_steps)
            .forget_steps()
            .each_step(move |step| followed.follow(step, 0.0))
            .run_interpreted(start)
            .map_err(|error| Failure::Run(verdict::message_of(&error)))?;
        Ok(turns)
    }
}
