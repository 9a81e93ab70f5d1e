//! Runs over a period or less, with their derivatives.

use std::f64::consts::TAU;

use super::{CLOSED, NoOrbit, Search};
use crate::across::{self, NoDerivatives};
use crate::chart::Chart;
use crate::varied::Direction;
use lagrangian::interpreted::{Named, Signals};
use lagrangian::{Crossing, Error, Machine, Sensitive, Simulation, State, System};
use nalgebra::{DMatrix, DVector};

impl Search<'_> {
    /// The state a period later, without derivatives.
    pub(super) fn end(
        &self,
        x: &DVector<f64>,
        period: f64,
        tolerance: f64,
    ) -> Result<DVector<f64>, NoOrbit> {
        let start = self.named(x);
        let run = Simulation::new(self.machine)
            .tolerance(tolerance)
            .until(start.t + period)
            .forget_steps()
            .run_interpreted(start);
        let run = run.map_err(|error| NoOrbit::Run(error.to_string()))?;
        let end = run.end();
        let all = end.q.values.iter().chain(&end.v.values).copied();
        let there = DVector::from_iterator(2 * self.n, all);
        let signs = self.signs(x, &there);
        Ok(there.component_mul(&signs))
    }

    /// The state a period later, with derivatives.
    pub(super) fn passage(
        &self,
        chart: &Chart,
        x: &DVector<f64>,
        period: f64,
        tolerance: f64,
    ) -> Result<Passage, NoOrbit> {
        let passage = self.unsigned_passage(chart, x, period, tolerance)?;
        let signs = self.signs(x, &passage.x);
        Ok(self.signed(chart, passage, &signs))
    }

    /// The state a period later, with derivatives, and with the signs of quaternions as the run produced them.
    pub(super) fn unsigned_passage(
        &self,
        chart: &Chart,
        x: &DVector<f64>,
        period: f64,
        tolerance: f64,
    ) -> Result<Passage, NoOrbit> {
        let failed = |error: lagrangian::Error| NoOrbit::Run(error.to_string());
        let n = self.n;
        let system = self.machine.prepare();
        if system.unilateral_contacts().len() > 0 {
            return self.passage_with_contacts(chart, x, period, tolerance);
        }
        let names: Vec<&str> = system.coordinates().map(|of| of.name).collect();
        let mut sensitive = Sensitive::new(self.machine).with_start_on_constraints();
        for &of in chart.indices() {
            sensitive = if of < n {
                sensitive.by_start(names[of])
            } else {
                sensitive.by_start_rate(names[of - n])
            }
            .map_err(failed)?;
        }
        let mut start = sensitive.start_from(self.named(x));
        let t = start.t + period;
        let spread = chart.spread(self.machine, start.t, x);
        let spread = spread.map_err(|_| NoOrbit::Constraints)?;
        for (k, column) in spread.column_iter().enumerate() {
            let (q, v) = (&mut start.q.by[k].values, &mut start.v.by[k].values);
            q.copy_from_slice(&column.as_slice()[..n]);
            v.copy_from_slice(&column.as_slice()[n..]);
        }
        let run = Simulation::new(&sensitive)
            .tolerance(tolerance)
            .until(t)
            .forget_steps()
            .run_interpreted(start)
            .map_err(failed)?;
        let (q, v) = (&run.end().q, &run.end().v);
        let there = q.value.values.iter().chain(&v.value.values).copied();
        let mut there = DVector::from_iterator(2 * n, there);
        let picked = chart.indices();
        let monodromy = DMatrix::from_fn(picked.len(), picked.len(), |i, j| match picked[i] {
            of if of < n => q.by[j].values[of],
            of => v.by[j].values[of - n],
        });
        if chart.rank() > 0 {
            // The values are taken from a run that is kept on the constraints.
            let end = self.end(x, period, tolerance)?;
            let signs = self.signs(&end, &there);
            there = end.component_mul(&signs);
        }
        let none = || NoOrbit::Run(format!("there are no accelerations at t = {t} s"));
        Ok(Passage {
            rate: chart.of(&self.rate(t, &there).ok_or_else(none)?),
            x: there,
            monodromy,
        })
    }

    /// The state a period later, with derivatives across impacts and other changes of contacts.
    pub(super) fn passage_with_contacts(
        &self,
        chart: &Chart,
        x: &DVector<f64>,
        period: f64,
        tolerance: f64,
    ) -> Result<Passage, NoOrbit> {
        let (n, t) = (self.n, self.sought.start.t);
        let spread = chart.spread(self.machine, t, x);
        let spread = spread.map_err(|_| NoOrbit::Constraints)?;
        let part = |rows: std::ops::Range<usize>| -> Vec<f64> {
            let own = x
                .rows_range(rows.clone())
                .iter()
                .copied()
                .collect::<Vec<_>>();
            let by = spread.column_iter();
            let by = by.flat_map(|column| {
                column
                    .rows_range(rows.clone())
                    .iter()
                    .copied()
                    .collect::<Vec<_>>()
            });
            own.into_iter().chain(by).collect()
        };
        let start = State {
            t,
            q: part(0..n),
            v: part(n..2 * n),
        };
        let signals = Signals::default();
        let wanted = across::Wanted {
            machine: self.machine,
            signals: &signals,
            directions: vec![Direction::of_start(self.machine); chart.size()],
            method: Default::default(),
            tolerance,
            until: t + period,
            most_steps: MOST_STEPS_OF_PART,
        };
        let run = across::run(&wanted, &start).map_err(|why| {
            NoOrbit::Run(match why {
                NoDerivatives::Run(Error::TooManySteps { steps, t, .. }) => format!(
                    "{steps} steps reach only t = {t} s of a period of {period} s: give a shorter period, or a start nearer to the orbit"
                ),
                why => why.to_string(),
            })
        })?;
        let end = run.end();
        let all = end.q[..n].iter().chain(&end.v[..n]).copied();
        let there = DVector::from_iterator(2 * n, all);
        let picked = chart.indices();
        let monodromy = DMatrix::from_fn(picked.len(), picked.len(), |i, j| match picked[i] {
            of if of < n => end.q[(j + 1) * n + of],
            of => end.v[(j + 1) * n + of - n],
        });
        self.check_open(&there)?;
        let none = || {
            NoOrbit::Run(format!(
                "there are no accelerations at t = {} s",
                t + period
            ))
        };
        Ok(Passage {
            rate: chart.of(&self.rate(t + period, &there).ok_or_else(none)?),
            x: there,
            monodromy,
        })
    }

    /// The period after which the motion from a start comes nearest to it while passing it in the direction
    /// in which it left.
    pub(super) fn first_return(&self, x: &DVector<f64>) -> Result<f64, NoOrbit> {
        let start = self.named(x);
        let rate = self.rate(start.t, x).ok_or(NoOrbit::NoReturn)?;
        // A rough time per radian, with which states are weighted; nothing depends on its exact value. States of first order are
        // as large as at the start.
        let n = self.n;
        let size = |part: &[f64], of_states: bool| {
            let own = part.iter().zip(&self.is_integral);
            let own = own.filter(|(_, is_integral)| **is_integral == of_states);
            own.map(|(x, _)| x * x).sum::<f64>().sqrt()
        };
        let [sizes, rates] = [&rate.as_slice()[..n], &rate.as_slice()[n..]];
        let ratio = |of_states: bool| {
            let (size, rate) = (size(sizes, of_states), size(rates, of_states));
            (size > 0.0 && rate > 0.0).then(|| rate / size)
        };
        if size(sizes, false) == 0.0 && rates.iter().all(|rate| *rate == 0.0) {
            return Err(NoOrbit::Rest);
        }
        let omega = ratio(false).or_else(|| ratio(true)).unwrap_or(1.0);
        let chart = &self.chart(x)?;
        let rate = chart.of(&rate);
        let scale = self.scale(chart, x, TAU / omega)?;
        let place = x + &self.advance;
        let normal = scale.transpose() * (&scale * &rate);
        let distance = {
            let (normal, place) = (normal.clone(), place.clone());
            let picked = chart.indices().to_vec();
            let fours = self.machine.program().quaternions.clone();
            move |state: &State<Named>| -> f64 {
                let sign = |k: usize| {
                    let four = fours.iter().find(|four| four.contains(&k));
                    let terms = four.into_iter().flatten();
                    let along: f64 = terms.map(|i| state.q.values[*i] * place[*i]).sum();
                    if along < 0.0 { -1.0 } else { 1.0 }
                };
                let number = |k: usize| {
                    if k < n {
                        sign(k) * state.q.values[k]
                    } else {
                        sign(k - n) * state.v.values[k - n]
                    }
                };
                let terms = picked.iter().zip(normal.iter());
                terms
                    .map(|(k, normal)| normal * (number(*k) - place[*k]))
                    .sum()
            }
        };
        let t = start.t;
        let (run, _) = Simulation::new(self.machine)
            .tolerance(self.sought.tolerance.max(1e-9))
            .max_steps(STEPS_OF_RETURN)
            .until(t + 1e9)
            .forget_steps()
            .until_nth_event(RETURNS, "return", Crossing::Rising, distance)
            .run_interpreted_as_far_as_possible(start)
            .map_err(|error| NoOrbit::Run(error.to_string()))?;
        let gaps: Vec<(f64, f64)> = run
            .events()
            .iter()
            .map(|event| {
                let all = event.state.q.values.iter().chain(&event.state.v.values);
                let there = DVector::from_iterator(2 * n, all.copied());
                let there = there.component_mul(&self.signs(&place, &there));
                let off = chart.of(&(there - &place));
                ((&scale * off).norm(), event.state.t - t)
            })
            .collect();
        let least = gaps
            .iter()
            .map(|(gap, _)| *gap)
            .fold(f64::INFINITY, f64::min);
        // The first of those that are about equally near. Within a thousandth of the way around counts as near: on an orbit all
        // returns are near but for round-off.
        let around = (&scale * &rate).norm() / omega;
        let near = (1.5 * least).max(1e-3 * around);
        let first = gaps.iter().find(|(gap, _)| *gap <= near);
        first.map(|(_, period)| *period).ok_or(NoOrbit::NoReturn)
    }

    /// Divides a period by the number of returns within it: a deviation that alternates about an orbit brings the motion nearer to
    /// its start at the second return than at the first. Returns whether the period was divided.
    pub(super) fn shorten(&self, x: &DVector<f64>, period: &mut f64) -> Result<bool, NoOrbit> {
        let tolerance = self.sought.tolerance;
        let whole = *period;
        while self.advance.amax() == 0.0 {
            let mut shorter = None;
            for part in [2.0, 3.0, 5.0] {
                let there = self.end(x, *period / part, tolerance)?;
                if self.largest_relative_entry(&self.gap(x, &there), x) <= CLOSED * tolerance {
                    shorter = Some(*period / part);
                }
            }
            match shorter {
                Some(shorter) => *period = shorter,
                None => break,
            }
        }
        Ok(*period < whole)
    }
}

/// The most steps between two changes of contacts.
const MOST_STEPS_OF_PART: usize = 10_000_000;

/// The most steps of a run that should return to its start.
const STEPS_OF_RETURN: usize = 20_000;

/// How many passages of the start such a run may make.
const RETURNS: usize = 24;

/// The result of integrating over one period.
pub(super) struct Passage {
    /// The state at the end.
    pub(super) x: DVector<f64>,
    /// M.
    pub(super) monodromy: DMatrix<f64>,
    /// The rate of the independent numbers at the end.
    pub(super) rate: DVector<f64>,
}
