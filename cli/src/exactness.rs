//! Error bounds of the quantities of a run within a step.

use lagrangian::State;
use lagrangian::interpreted::Named;
use lagrangian_sweep::charts::{self, Charts};

use crate::recording::{Recording, Run};

/// The approximate number of evaluations of the quantities.
const EVALUATIONS: usize = 20_000;

/// A run, and the tolerance that it was made with.
pub struct Exactness {
    /// The run.
    pub run: Run,
    /// The relative and absolute tolerance of each step.
    pub tolerance: f64,
    /// How the run is shown in the coordinates of the spec, if it is in others.
    pub charts: Option<Charts>,
}

impl Exactness {
    fn record(&self, states: &[State<Named>]) -> Recording {
        charts::record(&self.run, states, self.charts.as_ref())
    }

    /// The error of the quantities of the run within a step, in their units.
    ///
    /// A step may have an error of the tolerance, absolute plus relative, in every coordinate and rate. Every other quantity
    /// depends on these, and its error is the sum of its changes where they change by so much. The sum of its changes to both
    /// sides, which for a smooth quantity is of second order, measures the round-off of its terms; it may exceed the quantity's
    /// value if these cancel. The residual of the energy balance is itself an error, so its own error is given as 0.
    ///
    /// Of the changes to both sides the smaller one is taken as first-order change, and the largest hundredth of the instants is
    /// ignored: a jump, such as that of friction where sliding reverses, is not an error.
    pub fn of_columns<'a>(&self, names: impl Iterator<Item = &'a str>) -> Vec<f64> {
        let run = &self.run;
        let bound = |x: f64| self.tolerance * (1.0 + x.abs());
        let n = run.start().q.values.len();
        let most = (EVALUATIONS / (4 * n).max(1)).clamp(50, 1000);
        let samples = run.samples();
        let stride = samples.len().div_ceil(most).max(1);
        let states: Vec<_> = samples.iter().step_by(stride).cloned().collect();
        let recorded = self.record(&states);
        // For each column and each state the sum of the changes.
        let mut sums = vec![vec![0.0; states.len()]; recorded.columns.len()];
        for place in 0..2 * n {
            let moved = |sign: f64| {
                let mut states = states.clone();
                for state in &mut states {
                    let number = if place < n {
                        &mut state.q.values[place]
                    } else {
                        &mut state.v.values[place - n]
                    };
                    *number += sign * bound(*number);
                }
                self.record(&states)
            };
            let (above, below) = (moved(1.0), moved(-1.0));
            for (column, sums) in sums.iter_mut().enumerate() {
                let [unchanged, above, below] =
                    [&recorded, &above, &below].map(|recording| &recording.columns[column].values);
                for (row, sum) in sums.iter_mut().enumerate() {
                    let changes = [above[row] - unchanged[row], below[row] - unchanged[row]];
                    let smaller = changes[0].abs().min(changes[1].abs());
                    let rounding = (changes[0] + changes[1]).abs();
                    if rounding.is_finite() {
                        *sum += smaller + rounding;
                    }
                }
            }
        }
        let mut of_one = |name: &str| {
            let Some(k) = recorded
                .columns
                .iter()
                .position(|column| column.name == name)
            else {
                return 0.0;
            };
            sums[k].sort_by(f64::total_cmp);
            let place = (states.len() * 99).div_ceil(100).saturating_sub(1);
            sums[k].get(place).copied().unwrap_or(0.0)
        };
        names.map(&mut of_one).collect()
    }
}
