//! Passes poses in which rows become dependent that are independent elsewhere, such as a parallelogram whose bars come into line.
//!
//! There more directions are free than elsewhere, and branches of the motion may cross. Let `ε` be the length of the component of
//! a row that is orthogonal to the others, relative to the greatest length of the row. It vanishes in the pose. The round-off `u`
//! of the constraint is an error `u/ε` of positions along that row, `u/ε²` of rates and `u/ε³` of accelerations. All of it is
//! across the motion, since the direction of a row is the direction of its reaction, so the next projection onto the constraints
//! removes it once `ε` is no longer small. Therefore, while a motion passes such a pose,
//!
//! * its stages are projected onto the constraints before their accelerations are evaluated;
//! * accelerations within [`INTERPOLATED_BELOW`] are interpolated between four states on the same branch, two before and two after, at
//!   which the rows are strong: an error of order `ε⁴`;
//! * a state with `ε` below [`WEAK`] is not moved along such weak rows: it continues as it came, and so does the branch;
//! * the error of a step is measured along the motion, as the error of the state after its projection (E. Hairer, G. Wanner,
//!   *Solving Ordinary Differential Equations II*, 2nd ed., section VII.2).

use super::algebra::{backward, remove};
use super::choice::Rank;
use super::workspace::{Workspace, in_workspace};
use super::{Changed, Constraints, Level, Unprojected};
use crate::at::At;
use crate::{Singular, StepError, System, Vector};

/// Below this strength, rows no longer move a state.
pub(super) const WEAK: f64 = 1e-4;

/// Below this strength, residuals are reduced to round-off: a residual `r` is an error `r/ε²` of the rates across the rows, and
/// the next projection, whose rows have turned by then, leaves a part of it along the motion.
pub(super) const TIGHT: f64 = 1e-2;

/// Below this strength, accelerations are interpolated from both sides of the pose.
pub(super) const INTERPOLATED_BELOW: f64 = 3e-4;

/// A step that fails may have failed because of such a pose if the strength is below this, and may vanish within the step.
const NEARLY_DEPENDENT: f64 = 0.5;

/// Below this strength such a pose is near, however long the step.
const NEAR: f64 = 0.1;

/// The strength may vanish within a step if it is at most this many times its change between two states of the step. It is proportional to
/// the distance from the pose, so if it vanishes between the states its change is at least twice the smaller of both; rates may vary.
const REACH: f64 = 2.0;

/// The number of steps without such a pose in reach after which the motion has left it.
const STEPS_AWAY: u32 = 8;

/// How far from the pose states are searched for, in units of the coordinates' sizes, or in rad.
const SEARCH_DISTANCE: f64 = 0.1;

/// Whether a strength may vanish that changes by this much within a step, or has nearly vanished.
fn is_in_reach(hold: f64, change: f64) -> bool {
    hold < NEAR || hold <= REACH * change.abs()
}

impl<V: Vector> Constraints<V> {
    /// The strength of the weakest chosen row at a pose: its component orthogonal to the others, relative to its greatest length;
    /// 0 if it has none.
    pub fn strength<S: System<Vector = V>>(&self, system: &S, t: f64, q: &V) -> f64 {
        if let Some(hold) = self.strength_by_function(system, t, q) {
            return hold;
        }
        let hold = in_workspace(system, t, q.as_slice().len(), |workspace| {
            self.prepare(system, workspace, (t, q), Level::Rates)?;
            Ok(self.factored_strength(workspace, q))
        });
        hold.unwrap_or(0.0)
    }

    /// [`strength`](Self::strength) after the rows were factorized.
    fn factored_strength<M: Vector>(&self, workspace: &Workspace<'_, M>, q: &V) -> f64 {
        let rank = self.choice.rank;
        let mut least: f64 = 1.0;
        for j in 0..rank {
            let entries = (0..=j).map(|i| workspace.triangle[i * rank + j]);
            let norm = crate::math::sqrt(entries.map(|x| x * x).sum());
            let k = self.choice.row(j);
            let row = &workspace.matrix[k * workspace.n..][..workspace.n];
            let own = workspace.triangle[j * rank + j] / norm * self.scales.strength(k, row, q);
            least = least.min(own);
        }
        least
    }

    /// [`strength`](Self::strength) after an attempt to factorize the rows; 1 if that failed for another reason.
    pub(super) fn strength_after<M: Vector>(
        &self,
        prepared: &Result<(), StepError>,
        workspace: &Workspace<'_, M>,
        q: &V,
    ) -> f64 {
        match prepared {
            Ok(()) => self.factored_strength(workspace, q),
            Err(StepError::Singular { singular, .. })
                if matches!(singular.at, crate::Pivot::Constraint(_)) =>
            {
                0.0
            }
            Err(_) => 1.0,
        }
    }

    /// Called after a step failed, with the [strengths](Self::strength) at its beginning, its middle and its end; returns whether such a pose
    /// may be the cause, unless that was known before. `at_last` says that no shorter step is possible.
    pub fn notice_fork(&mut self, holds: [f64; 3], at_last: bool) -> bool {
        if self.at_fork {
            return false;
        }
        let least = holds
            .iter()
            .fold(f64::INFINITY, |least, hold| hold.min(least));
        let is_in_reach = holds
            .windows(2)
            .any(|pair| is_in_reach(least, pair[1] - pair[0]));
        self.at_fork = least < NEARLY_DEPENDENT && (at_last || is_in_reach);
        [self.strength, ..] = holds;
        self.steps_away = 0;
        self.at_fork
    }

    /// Called at the end of a step; updates whether the motion is still near the pose.
    pub fn update_fork<S: System<Vector = V>>(&mut self, system: &S, t: f64, q: &V) {
        if !self.at_fork {
            return;
        }
        let hold = self.strength(system, t, q);
        if is_in_reach(hold, hold - self.strength) {
            self.steps_away = 0;
        } else {
            self.steps_away += 1;
        }
        self.strength = hold;
        self.at_fork = hold < NEARLY_DEPENDENT && self.steps_away < STEPS_AWAY;
    }

    /// Accelerations of a state after its projection onto the constraints: the error of a stage would otherwise grow as
    /// `1/ε²` as well.
    pub(super) fn accelerations_at_fork<S: System<Vector = V>>(
        &self,
        system: &S,
        At { t, q, v, u }: At<'_, S>,
        a: &mut V,
    ) -> Result<(), StepError> {
        if self.strength(system, t, q) < INTERPOLATED_BELOW {
            return self.accelerations_across(system, At { t, q, v, u }, a);
        }
        let (mut q, mut v) = (q.clone(), v.clone());
        self.project_onto_chosen(system, t, &mut q, &mut v)?;
        self.accelerations_here(system, At { t, q: &q, v: &v, u }, a)
    }

    /// Accelerations interpolated between states on both sides of a pose, two before and two after it.
    ///
    /// They are a smooth function of the position on the line through the state along its rates, projected onto the constraints,
    /// so the error of the cubic through four values is of the fourth power of their distance.
    fn accelerations_across<S: System<Vector = V>>(
        &self,
        system: &S,
        At { t, q, v, u }: At<'_, S>,
        a: &mut V,
    ) -> Result<(), StepError> {
        let mut times = [0.0; 4];
        let mut beside: [V; 4] = a.several_zeros_like();
        for (pair, direction) in [1.0, -1.0].into_iter().enumerate() {
            let mut far = INTERPOLATED_BELOW;
            for k in [2 * pair, 2 * pair + 1] {
                let at = At { t, q, v, u };
                let (by, was) =
                    self.accelerations_beside(system, at, (direction, far), &mut beside[k])?;
                times[k] = by;
                // The second state is as far from the first as the first is from the pose.
                far = 2.0 * was;
            }
        }
        let a = a.as_mut_slice();
        a.fill(0.0);
        for (k, beside) in beside.iter().enumerate() {
            let others = times.iter().enumerate().filter(|(j, _)| *j != k);
            let weight: f64 = others.map(|(_, t)| t / (t - times[k])).product();
            for (a, beside) in a.iter_mut().zip(beside.as_slice()) {
                *a += weight * beside;
            }
        }
        Ok(())
    }

    /// Accelerations at the nearest state in a direction of time, from some distance on, at which the rows are strong enough;
    /// returns its relative time and its distance.
    fn accelerations_beside<S: System<Vector = V>>(
        &self,
        system: &S,
        At { t, q, v, u }: At<'_, S>,
        (direction, mut far): (f64, f64),
        a: &mut V,
    ) -> Result<(f64, f64), StepError> {
        let rate = self.scales.rate(v);
        // A machine at rest in such a pose may leave it on any branch.
        while rate > 0.0 && far < SEARCH_DISTANCE {
            let by = direction * far / rate;
            let mut ahead = q.clone();
            for (q, v) in ahead.as_mut_slice().iter_mut().zip(v.as_slice()) {
                *q += by * v;
            }
            if self.strength(system, t + by, &ahead) >= 2.0 * INTERPOLATED_BELOW {
                let mut rates = v.clone();
                self.project_onto_chosen(system, t + by, &mut ahead, &mut rates)?;
                self.accelerations_here(
                    system,
                    At {
                        t: t + by,
                        q: &ahead,
                        v: &rates,
                        u,
                    },
                    a,
                )?;
                return Ok((by, far));
            }
            far *= 1.5;
        }
        let singular = Singular::constraint(self.choice.row(0), 0.0, 1.0);
        Err(StepError::Singular { singular, t })
    }

    /// Projects a state at which rows may be weak, but do not vanish, onto all chosen rows.
    pub(super) fn project_onto_chosen<S: System<Vector = V>>(
        &self,
        system: &S,
        t: f64,
        q: &mut V,
        v: &mut V,
    ) -> Result<(), StepError> {
        let mut own = self.clone();
        own.reduces_to_roundoff = true;
        let mut low = [q.zeros_like(), v.zeros_like()];
        let [q_low, v_low] = &mut low;
        let place = &mut Unprojected {
            t,
            q: [q, q_low],
            v: [v, v_low],
        };
        in_workspace(system, t, place.q[0].as_slice().len(), |workspace| {
            own.prepare(system, workspace, (t, place.q[0]), Level::Positions)?;
            let [left, _] = own.residuals(system, workspace, place, Changed::All).chosen;
            own.newton(system, workspace, place, Level::Positions, left)?;
            own.prepare(system, workspace, (t, place.q[0]), Level::Rates)?;
            let [_, left] = own.residuals(system, workspace, place, Changed::All).chosen;
            own.newton(system, workspace, place, Level::Rates, left)
        })
    }

    /// Removes the part across the constraints at a pose from a change of coordinates or of rates.
    pub fn keep_along<S: System<Vector = V>>(
        &self,
        system: &S,
        t: f64,
        q: &V,
        change: &mut V,
    ) -> Result<(), StepError> {
        let choice = self
            .choice
            .choose(system, (t, q), Rank::Known, (&self.scales, None))?;
        in_workspace(system, t, q.as_slice().len(), |workspace| {
            super::prepare(system, workspace, (t, q), (&choice, None))?;
            let (n, l) = (workspace.n, workspace.metric.as_slice());
            let change = change.as_mut_slice();
            // z = Lᵀ x
            for i in 0..n {
                change[i] = (i..n).map(|k| l[k * n + i] * change[k]).sum();
            }
            for along in workspace.basis.chunks_exact(n).take(choice.rank) {
                remove(along, change);
            }
            backward(l, change);
            Ok(())
        })
    }
}
