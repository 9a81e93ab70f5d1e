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
    /// The coordinates, of which only the residuals of positions are needed for now: the matrix and the rates remain those of the pose before, until
    /// they are evaluated as those of another [`Pose`](Self::Pose).
    Positions,
    /// The coordinates, whose residuals of positions are known.
    Pose,
    Rates,
    Nothing,
}

/// The largest residuals of rows, each with its row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Residuals {
    /// Of the chosen rows, of positions and of rates, relative to their scale.
    pub chosen: [(f64, usize); 2],
    /// Of any row and level, relative to the scale of the guaranteed bound.
    pub guaranteed: (f64, usize),
}

impl<V: Vector> Constraints<V> {
    /// The largest residuals of the rows at a state. Leaves all residuals and the constraint matrix in the workspace, and evaluates only those
    /// of what has changed since it was called last.
    pub(super) fn residuals<S: System<Vector = V>>(
        &self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        place: &Unprojected<'_, V>,
        changed: Changed,
    ) -> Residuals {
        self.evaluate(system, workspace, place, changed);
        let (q, v) = (&*place.q[0], &*place.v[0]);
        let mut most = Residuals {
            chosen: [(0.0, 0); 2],
            guaranteed: (0.0, 0),
        };
        for k in 0..workspace.m {
            let relative = self.relative(workspace, k, q, v);
            for (chosen, now) in most.chosen.iter_mut().zip(relative) {
                self.count_residual(chosen, k, now.now);
                // NaN counts as the largest.
                if !(now.guaranteed <= most.guaranteed.0 || most.guaranteed.0.is_nan()) {
                    most.guaranteed = (now.guaranteed, k);
                }
            }
        }
        most
    }

    /// The largest residual of positions or of rates alone, by the level, and its row.
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
        if !(now <= most.0 || most.0.is_nan()) {
            *most = (now, k);
        }
    }

    /// Evaluates the residuals and the constraint matrix, as far as they have changed.
    pub(super) fn evaluate<S: System<Vector = V>>(
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
        if let Changed::All | Changed::Positions = changed {
            system.constraint_positions(place.t, q, workspace.positions);
        }
        if let Changed::All | Changed::Pose = changed {
            system.constraint_matrix(place.t, q, workspace.matrix);
        }
        if let Changed::All | Changed::Pose | Changed::Rates = changed {
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

    /// Checks that the rows that were not chosen agree with the chosen ones, given the largest residual relative to the scale of the guaranteed
    /// bound; records this residual and the size of the terms.
    pub(super) fn check_redundant_rows<S: System<Vector = V>>(
        &mut self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        place: &Unprojected<'_, V>,
        mut most: (f64, usize),
    ) -> Result<(), StepError> {
        let (q, v) = (&*place.q[0], &*place.v[0]);
        if !(most.0 <= CONTRADICTION) && self.scales.record_drive(system, place.t, q) {
            let again = self.residuals(system, workspace, place, Changed::Nothing);
            most = again.guaranteed;
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
