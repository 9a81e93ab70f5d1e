//! Information about the constraints for the messages of a run.

use super::choice::Rank;
use super::workspace::in_workspace;
use super::{Constraints, INDEPENDENT, Level};
use crate::{Pivot, StepError, System, Vector};

impl<V: Vector> Constraints<V> {
    /// For each row that was not chosen, its index and the indices of the chosen rows that it depends
    /// on, at a state at which the rows were chosen.
    pub fn dependences<S: System<Vector = V>>(
        &self,
        system: &S,
        t: f64,
        q: &V,
    ) -> Result<std::vec::Vec<(usize, std::vec::Vec<usize>)>, StepError> {
        use std::vec::Vec;

        // Coefficients below this are round-off of 0, relative to 1.
        const NOTHING: f64 = 1e-6;
        if self.choice.rank == system.constraints().len() {
            return Ok(Vec::new());
        }
        in_workspace(system, t, q.as_slice().len(), |workspace| {
            self.prepare(system, workspace, (t, q), Level::Rates)?;
            workspace.combine(|j| self.choice.row(j), self.choice.rank);
            let others = workspace.matrix.chunks_exact(workspace.n).enumerate();
            let others = others.filter(|(k, _)| !self.choice.has(*k));
            let others = others.map(|(k, x)| {
                let on = (0..self.choice.rank).filter(|&j| x[j].abs() > NOTHING);
                let mut on: Vec<usize> = on.map(|j| self.choice.row(j)).collect();
                on.sort_unstable();
                (k, on)
            });
            Ok(others.collect())
        })
    }

    /// The row that has lost most of its strength on the way from one pose to another, and its strength
    /// at the end relative to that at the beginning; `None` if it had none.
    ///
    /// If it is 0, rows are dependent that were not before: more directions are free there than
    /// elsewhere, and branches of the motion may meet.
    pub fn weakest<S: System<Vector = V>>(
        &mut self,
        system: &S,
        before: (f64, &V),
        now: (f64, &V),
    ) -> Result<Option<(usize, f64)>, StepError> {
        self.choose(system, before.0, before.1, Rank::Revealed(INDEPENDENT))?;
        let mut held = before.1.zeros_like();
        let held = held.as_mut_slice();
        in_workspace(system, before.0, before.1.as_slice().len(), |workspace| {
            self.prepare(system, workspace, before, Level::Rates)?;
            for (j, held) in held.iter_mut().take(self.choice.rank).enumerate() {
                *held = workspace.triangle[j * self.choice.rank + j];
            }
            let prepared = self.prepare(system, workspace, now, Level::Rates);
            if let Err(StepError::Singular { singular, .. }) = prepared
                && let Pivot::Constraint(k) = singular.at
            {
                return Ok(Some((k, 0.0)));
            }
            prepared?;
            let left = (0..self.choice.rank).map(|j| {
                let left = workspace.triangle[j * self.choice.rank + j] / held[j];
                (self.choice.row(j), left)
            });
            Ok(left.min_by(|a, b| a.1.total_cmp(&b.1)))
        })
    }

    /// The reference sizes of a coordinate and of its rate.
    pub fn sizes(&self, coordinate: usize) -> [f64; 2] {
        [0, 1].map(|of: usize| self.scales.sizes[of].as_slice()[coordinate])
    }
}
