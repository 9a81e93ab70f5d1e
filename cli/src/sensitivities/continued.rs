//! Runs whose derivatives are continued across impacts and changes of contacts, and those in another chart.

use lagrangian::interpreted::{InterpretedMachine, Named, Signals};
use lagrangian::methods::Method;
use lagrangian::{Machine, State, System, Varied};
use lagrangian_linear::across::{self, NoDerivatives};
use lagrangian_linear::charts;
use lagrangian_linear::varied::Direction;
use lagrangian_sweep::verdict;

use super::asked::{By, Observed, Of, Variation};
use super::chart::Chart;
use super::{Column, SAMPLES, check_differences, check_drift, columns, sizes, with_values};
use crate::call;
use crate::failure::Failure;

/// The run of a machine with unilateral contacts or in another chart, with derivatives continued across each impact and each change of
/// closed contacts.
pub(super) fn run(
    call: &call::Sensitivities,
    (of_spec, chart): (&InterpretedMachine, Option<&Chart>),
    method: &'static Method,
    from: &State<Varied<Named>>,
    variations: &[Variation],
    observed: &[Observed],
) -> Result<(Vec<f64>, Vec<Column>), Failure> {
    // Derivatives by variables scaled to size 1, so that one tolerance suits all of them.
    let sizes = sizes(of_spec, variations);
    let machine = chart.map_or(of_spec, |chart| &chart.machine);
    let points = chart.map_or(&[][..], |chart| &chart.points);
    let turns = chart
        .map(|chart| chart.turns((call, method), from))
        .transpose()?;
    let n = machine.program().dimension();
    let scaled = Scaled { n, sizes: &sizes };
    let mut start = State {
        t: from.t,
        q: scaled.join(&from.q),
        v: scaled.join(&from.v),
    };
    charts::to_cartesian(points, n, [&mut start.q, &mut start.v]);
    let signals = Signals::default();
    let wanted = across::Wanted {
        machine,
        signals: &signals,
        directions: directions(machine, variations, &sizes),
        method,
        tolerance: call.tolerance,
        until: call.until,
        most_steps: call.max_steps,
    };
    let run = across::run(&wanted, &start).map_err(no_derivatives)?;
    let like = machine.start().q;
    let end = run.end();
    let [begun, end] = [&start, end].map(|state| State {
        t: state.t,
        q: scaled.split(&state.q, &like),
        v: scaled.split(&state.v, &like),
    });
    if machine.prepare().constraints().len() > 0 {
        check_drift(machine, &end, variations)?;
    }
    check_differences(call, (machine, method), variations, &begun, &end)?;
    let times = times(call, from.t);
    let system = machine.prepare();
    let mut columns = columns(variations, observed);
    for t in &times {
        let State { q, v, .. } = run.at(*t).map_err(failed)?;
        let there = run.observe(*t, (&q, &v)).map_err(failed)?;
        let (mut by_q, mut by_v) = (q.clone(), v.clone());
        charts::to_polar(points, n, [&mut by_q, &mut by_v]);
        let (mut own_q, mut own_v) = (q[..n].to_vec(), v[..n].to_vec());
        if let Some(turns) = &turns {
            turns.to_polar(*t, &mut own_q, &mut own_v);
        }
        let value = |observed: &Observed| match observed.of {
            Of::Coordinate(i) => own_q[i],
            Of::Rate(i) => own_v[i],
            Of::Output(i) => {
                let [q, v, a] = [&q, &v, &there.a].map(|list| list[..n].to_vec());
                system.output(i, *t, &q, &v, &a, &there.inputs.own.values)
            }
        };
        let by = |observed: &Observed| match observed.of {
            Of::Coordinate(i) => scaled.derivatives(&by_q, i),
            Of::Rate(i) => scaled.derivatives(&by_v, i),
            Of::Output(i) => {
                let by = (there.system).output(i, *t, [&q, &v, &there.a], &there.inputs);
                scaled.in_units(&by)
            }
        };
        let row = (observed.iter().map(value)).chain(observed.iter().flat_map(by));
        for (column, value) in columns.iter_mut().zip(row) {
            column.values.push(value);
        }
    }
    Ok((times, columns))
}

/// The failure of a run with derivatives, which may itself continue where its derivatives do not.
fn no_derivatives(why: NoDerivatives) -> Failure {
    match why {
        NoDerivatives::Run(error) => failed(error),
        broken => Failure::Run(format!(
            "{broken}; use differences of runs instead, by `lagrangian compare` with `--set-second`, or by `lagrangian sweep`"
        )),
    }
}

fn failed(error: lagrangian::Error) -> Failure {
    Failure::Run(verdict::message_of(&error))
}

/// Lists of `n` numbers, followed by their derivatives by each variable scaled to size 1.
struct Scaled<'s> {
    n: usize,
    /// The sizes of the variables, in their units.
    sizes: &'s [f64],
}

impl Scaled<'_> {
    fn join(&self, list: &Varied<Named>) -> Vec<f64> {
        let by = list.by.iter().zip(self.sizes);
        let by = by.flat_map(|(by, size)| by.values.iter().map(move |by| by * size));
        list.value.values.iter().copied().chain(by).collect()
    }

    /// The numbers under the names of `like`, with their derivatives by the variables in their units.
    fn split(&self, list: &[f64], like: &Named) -> Varied<Named> {
        let by = list[self.n..].chunks(self.n).zip(self.sizes);
        let by = by.map(|(by, size)| {
            let by: Vec<f64> = by.iter().map(|by| by / size).collect();
            with_values(like, &by)
        });
        Varied {
            value: with_values(like, &list[..self.n]),
            by: by.collect(),
        }
    }

    /// The derivatives of a number of a list, by the variables in their units.
    fn derivatives(&self, list: &[f64], i: usize) -> Vec<f64> {
        let scaled: Vec<f64> = list[self.n..].chunks(self.n).map(|by| by[i]).collect();
        self.in_units(&scaled)
    }

    /// Derivatives by the scaled variables as those by the variables in their units.
    fn in_units(&self, scaled: &[f64]) -> Vec<f64> {
        let by = scaled.iter().zip(self.sizes);
        by.map(|(by, size)| by / size).collect()
    }
}

/// The instants of the rows: at equal intervals from the start, and the end.
fn times(call: &call::Sensitivities, start: f64) -> Vec<f64> {
    if call.until == start {
        return vec![start];
    }
    let interval = call.every.unwrap_or(call.until.abs() / SAMPLES);
    let interval = interval.copysign(call.until - start);
    let count = ((call.until - start) / interval * (1.0 - 1e-9)).floor() as usize;
    let inside = (0..=count).map(|k| start + k as f64 * interval);
    inside.chain([call.until]).collect()
}

/// The directions of differentiation, each scaled to the size of its variable.
fn directions(
    machine: &InterpretedMachine,
    variations: &[Variation],
    sizes: &[f64],
) -> Vec<Direction> {
    let direction = |(variation, size): (&Variation, &f64)| {
        let mut direction = Direction::of_start(machine);
        match variation.by {
            By::Parameter(index) => direction.parameters[index] = *size,
            By::Input(index) => direction.inputs[index] = *size,
            By::Start(_) | By::StartRate(_) => {}
        }
        direction
    };
    variations.iter().zip(sizes).map(direction).collect()
}
