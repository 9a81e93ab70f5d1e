//! Residuals of the rows of constraints at a state.
#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "what is not a number passes no test here"
)]

use super::algebra::dot;
use super::workspace::Workspace;
use super::{CONTRADICTION, Constraints, Level, Unprojected, scale};
use crate::{StepError, System, Vector};

/// What of a state has changed since its residuals were evaluated.
#[derive(Clone, Copy, Debug)]
pub(super) enum Changed {
    All,
    Rates,
    Nothing,
}

impl<V: Vector> Constraints<V> {
    /// The largest residuals of the rows at a state, relative to their scale, and their rows. Leaves all residuals and the constraint
    /// matrix in the workspace, and evaluates only those of what has changed since it was called last.
    pub(super) fn residuals<S: System<Vector = V>>(
        &self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        place: &Unprojected<'_, V>,
        changed: Changed,
    ) -> [(f64, usize); 2] {
        self.evaluate(system, workspace, place, changed);
        let (q, v) = (&*place.q[0], &*place.v[0]);
        let mut most = [(0.0, 0), (0.0, 0)];
        for k in 0..workspace.m {
            let relative = self.relative(workspace, k, q, v);
            for (most, now) in most.iter_mut().zip(relative) {
                self.count_residual(most, k, now.now);
            }
        }
        most
    }

    /// The same on one level alone.
    pub(super) fn residual<S: System<Vector = V>>(
        &self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        place: &Unprojected<'_, V>,
        level: Level,
        changed: Changed,
    ) -> (f64, usize) {
        self.evaluate(system, workspace, place, changed);
        let (q, v) = (&*place.q[0], &*place.v[0]);
        let mut most = (0.0, 0);
        for k in 0..workspace.m {
            let row = &workspace.matrix[k * workspace.n..][..workspace.n];
            let of_row = match level {
                Level::Positions => {
                    let left = workspace.positions[k];
                    self.scales.relative_of_positions(k, row, left, q)
                }
                Level::Rates => {
                    let left = workspace.rates[k];
                    self.scales.relative_of_rates(k, row, left, v)
                }
            };
            self.count_residual(&mut most, k, of_row.now);
        }
        most
    }

    /// Replaces the largest residual by that of a row if this is larger.
    #[inline(always)]
    fn count_residual(&self, most: &mut (f64, usize), k: usize, now: f64) {
        // Rows that were not chosen approach together with the chosen ones, unless they contradict them.
        if !self.choice.has(k) && !(now <= CONTRADICTION) {
            return;
        }
        // NaN counts as the largest.
        if !(now <= most.0) {
            *most = (now, k);
        }
    }

    /// Evaluates the residuals and the constraint matrix, as far as they have changed.
    fn evaluate<S: System<Vector = V>>(
        &self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        place: &Unprojected<'_, V>,
        changed: Changed,
    ) {
        let (q, v) = (&*place.q[0], &*place.v[0]);
        // Columns of fixed coordinates may have been cleared since.
        let changed = match self.kept {
            Some(_) => Changed::All,
            None => changed,
        };
        if let Changed::All = changed {
            system.constraint_positions(place.t, q, workspace.positions);
            system.constraint_matrix(place.t, q, workspace.matrix);
        }
        if let Changed::All | Changed::Rates = changed {
            system.constraint_rates(place.t, q, v, workspace.rates);
        }
    }

    /// The largest residual of the chosen rows on one level, relative to the scale of the guaranteed bound, and its row.
    pub(super) fn guaranteed_residual<M>(
        &self,
        workspace: &Workspace<'_, M>,
        place: &Unprojected<'_, V>,
        level: Level,
    ) -> (f64, usize) {
        let mut most = (0.0, 0);
        for chosen in 0..self.choice.rank {
            let k = self.choice.row(chosen);
            let now = self.relative(workspace, k, place.q[0], place.v[0])[level as usize];
            if !(now.guaranteed <= most.0) {
                most = (now.guaranteed, k);
            }
        }
        most
    }

    pub(super) fn relative<M>(
        &self,
        workspace: &Workspace<'_, M>,
        k: usize,
        q: &V,
        v: &V,
    ) -> [scale::Relative; 2] {
        let row = &workspace.matrix[k * workspace.n..][..workspace.n];
        let left = [workspace.positions[k], workspace.rates[k]];
        self.scales.relative(k, row, left, q, v)
    }

    /// The largest residual of any row, of positions or rates, relative to the scale of the guaranteed bound, and its row.
    pub(super) fn largest_guaranteed<S: System<Vector = V>>(
        &self,
        system: &S,
        workspace: &Workspace<'_, S::Matrix>,
        (q, v): (&V, &V),
    ) -> (f64, usize) {
        let mut most = (0.0, 0);
        for (k, _) in system.constraints().enumerate() {
            let [positions, rates] = self.relative(workspace, k, q, v).map(|of| of.guaranteed);
            let now = if positions > rates { positions } else { rates };
            if !(now <= most.0) {
                most = (now, k);
            }
        }
        most
    }

    /// Checks that the rows that were not chosen agree with the chosen ones; records the residual and the size of the terms.
    pub(super) fn check_redundant_rows<S: System<Vector = V>>(
        &mut self,
        system: &S,
        workspace: &Workspace<'_, S::Matrix>,
        place: &Unprojected<'_, V>,
    ) -> Result<(), StepError> {
        let (q, v) = (&*place.q[0], &*place.v[0]);
        let mut most = self.largest_guaranteed(system, workspace, (q, v));
        if !(most.0 <= CONTRADICTION) && self.scales.record_drive(system, place.t, q) {
            most = self.largest_guaranteed(system, workspace, (q, v));
        }
        self.residual = most.0;
        if !(most.0 <= CONTRADICTION) {
            return Err(StepError::Inconsistent {
                constraint: most.1,
                residual: most.0,
                t: place.t,
            });
        }
        for (k, row) in workspace
            .matrix
            .chunks_exact(workspace.n.max(1))
            .enumerate()
        {
            let by_rates = dot(row, v.as_slice());
            self.scales
                .record_terms(k, row, (workspace.rates[k] - by_rates).abs());
        }
        Ok(())
    }
}
