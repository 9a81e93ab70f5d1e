//! Projects states that are nearly on the constraints, such as the ends of steps, with few evaluations, by the metric of one pose.
#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "what is not a number passes no test here"
)]

use super::algebra::{backward, share};
use super::workspace::Workspace;
use super::{Changed, Constraints, Level, NEAR, Unprojected, find_basis};
use crate::compensated::two_sum;
use crate::{StepError, System, Vector};

/// A correction by the matrices of another pose leaves about the relative change of the rows, and that of the coordinates is about their residual. If
/// that is above this, the residuals of rates would fall more slowly than if the basis is found once more.
const CHANGES_ROWS: f64 = 1e-6;

/// The factor to which each correction must reduce the residuals.
pub(super) const CONTRACTION: f64 = 0.1;

impl<V: Vector> Constraints<V> {
    /// Newton's method on both levels for a state with these residuals of the chosen rows, relative to their scale, by the metric and the basis in the
    /// workspace. Returns whether the residuals are reduced; if not, the state may have moved, and the workspace holds residuals and factors there.
    ///
    /// It does so only if all rows are chosen. So near to the constraints, what residuals are relative to stays the same while the state moves, and another metric
    /// would differ in the direction of the move by no more than the length of the move.
    pub(super) fn approach_nearby<S: System<Vector = V>>(
        &mut self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        place: &mut Unprojected<'_, V>,
        residuals: [f64; 2],
    ) -> Result<bool, StepError> {
        let is_near = residuals.iter().all(|residual| *residual < NEAR);
        if !is_near || self.kept.is_some() || self.choice.rank < workspace.m {
            return Ok(false);
        }
        let threshold = self.reduction_threshold();
        let mut is_done = true;
        basis_in_coordinates(workspace);
        if residuals[0] > threshold {
            is_done = self.correct(system, workspace, place, Level::Positions);
            self.evaluate(system, workspace, place, Changed::Pose);
            if is_done && residuals[0] > CHANGES_ROWS {
                is_done = find_basis(workspace, &self.choice).is_ok();
                basis_in_coordinates(workspace);
            }
        }
        is_done = is_done && self.correct(system, workspace, place, Level::Rates);
        if !is_done {
            self.factor(system, workspace, (place.t, place.q[0]), Level::Positions)?;
        }
        Ok(is_done)
    }

    /// Corrects one level until its residuals are reduced. Returns `false` if a correction does not reduce them to a tenth.
    fn correct<S: System<Vector = V>>(
        &mut self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        place: &mut Unprojected<'_, V>,
        level: Level,
    ) -> bool {
        let (at, threshold) = (level as usize, self.reduction_threshold());
        let changed = match level {
            Level::Positions => Changed::Positions,
            Level::Rates => Changed::Rates,
        };
        self.write_scales(workspace, place, level);
        let mut left = largest_share(workspace, level);
        // The negation is true of NaN.
        while !(left <= threshold) {
            self.correction_in_coordinates(workspace, level);
            let [y, low] = place.level(level);
            let (y, low) = (y.as_mut_slice(), low.as_mut_slice());
            let moved = self.moved[at].as_mut_slice();
            for (j, by) in workspace.column.iter().enumerate() {
                (y[j], low[j]) = two_sum(y[j], low[j] + by);
                moved[j] += by;
            }
            self.evaluate(system, workspace, place, changed);
            let before = left;
            left = largest_share(workspace, level);
            if !(left <= threshold.max(CONTRACTION * before)) {
                return false;
            }
        }
        true
    }

    /// The smallest move, in the metric of inertia, that removes the residual of the constraints to first order, by a basis in coordinates.
    fn correction_in_coordinates<M: Vector>(&self, workspace: &mut Workspace<'_, M>, level: Level) {
        let count = self.along_basis(workspace, level);
        workspace.column.fill(0.0);
        let basis = workspace.basis.chunks_exact(workspace.n.max(1));
        for (along, left) in basis.zip(&workspace.row[..count]) {
            for (x, along) in workspace.column.iter_mut().zip(along) {
                *x -= left * along;
            }
        }
    }

    /// Writes the reciprocals of the scales of the residuals of the rows on a level to `workspace.lengths`, which has room since there are no more
    /// rows than coordinates.
    fn write_scales<M>(
        &self,
        workspace: &mut Workspace<'_, M>,
        place: &Unprojected<'_, V>,
        level: Level,
    ) {
        let inertial = self.scales.roundoff_of_rates(place.v[0]);
        for k in 0..workspace.m {
            let row = &workspace.matrix[k * workspace.n..][..workspace.n];
            let scale = match level {
                Level::Positions => self.scales.of_positions(k, row, place.q[0]),
                Level::Rates => {
                    let at = (&*place.v[0], inertial);
                    self.scales.of_rates(k, row, workspace.rates[k], at)
                }
            };
            workspace.lengths[k] = share(1.0, scale.now);
        }
    }
}

/// Turns the orthonormal vectors of the basis into moves of the coordinates, `L⁻ᵀ Q`: each correction then is a sum of them.
fn basis_in_coordinates<M: Vector>(workspace: &mut Workspace<'_, M>) {
    for along in workspace.basis.chunks_exact_mut(workspace.n.max(1)) {
        backward(workspace.metric.as_slice(), along);
    }
}

/// The largest residual on a level relative to the scales in the workspace; NaN if one is not a number.
fn largest_share<M>(workspace: &Workspace<'_, M>, level: Level) -> f64 {
    let residuals = match level {
        Level::Positions => &workspace.positions,
        Level::Rates => &workspace.rates,
    };
    let mut most = 0.0_f64;
    for (left, reciprocal) in residuals.iter().zip(&*workspace.lengths) {
        let share = left.abs() * reciprocal;
        if !(share <= most || most.is_nan()) {
            most = share;
        }
    }
    most
}
